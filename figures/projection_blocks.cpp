// Block structure of the projection p -> (c, t): parts by control points, and its degree blocks.
#include "figures/blob.h"
#include "figures/projection_pattern.h"

namespace sem::figures {
namespace {

Data compute() {
  const auto shared =
      builtin_body("cantilever", {"method.origins=shared_parts", "method.weights.cutoff=1.01"});
  const auto one = builtin_body("cantilever", {"method.origins=one", "method.fit=pseudo_inverse"});
  Data data;
  add_projection_size(data, one);
  add_projection(data, "entries_draft", one.projection);
  add_projection(data, "entries_published", shared.projection);
  return data;
}

void draw(Plot& plot, const Data& data) {
  plot.letters = true;
  plot.shared_legend = true;
  Panel &draft = plot.panel(0, 0), &published = plot.panel(0, 1);
  draft.title = "draft: one origin, pseudo-inverse";
  published.title = "published: shared origins, by degree";
  draw_projection(draft, data, "entries_draft");
  draw_projection(published, data, "entries_published");
}

}  // namespace

Figure projection_blocks() {
  return {
      "projection_blocks",
      "Which control points the polynomials of a cantilever's ten parts depend on: with one origin "
      "on nearly all, with shared origins on those of the origin's parts, in degree 2 on the own",
      7,
      3.6,
      compute,
      draw};
}

}  // namespace sem::figures
