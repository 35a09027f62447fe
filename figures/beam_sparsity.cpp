// Which control points the stiffness matrix couples in space, as a beam grows.
#include "figures/figure.h"
#include "figures/growing_beam.h"
#include "figures/scene_model.h"

namespace sem::figures {
namespace {

const int slices[] = {5, 10, 22};

Data compute() {
  Data data;
  DataTable cases({"case", "parts", "unknowns", "nonzeros", "fill"});
  auto& runs = data.add("runs", {"case", "row", "first", "last"});
  for (int number = 0; number < 3; ++number) {
    const auto beam = growing_beam_of(slices[number]);
    const auto& body = beam->model->discretization;
    add_case(cases, runs, number, body.boundary.n_parts(), stiffness_pattern(body));
  }
  data.add("cases", cases.columns()) = cases;
  return data;
}

void draw(Plot& plot, const Data& data) {
  for (int number = 0; number < 3; ++number) {
    const DataTable info = data["cases"].where("case", number);
    const auto entries = entries_of(data["runs"].where("case", number));
    const int n = int(info.value("unknowns")) / 3;
    Panel& panel = plot.panel(0, number);
    panel.equal = true;
    panel.pattern(n, n, entries);
    panel.title = number_text(info.value("parts")) + " parts";
    panel.lines_below = {number_text(info.value("unknowns"), 4) +
                         " unknowns: " + number_text(100 * info.value("fill"), 2) + " % filled"};
  }
}

}  // namespace

Figure beam_sparsity() {
  return {"beam_sparsity",
          "Control points that the stiffness matrix couples in space: a beam that grows (half a "
          "metre and four parts a slice), its ends first, then its four sides one after the other",
          7,
          2.75,
          compute,
          draw};
}

}  // namespace sem::figures
