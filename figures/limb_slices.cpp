// Weights sliced through a solid with limbs: does one arm feel the next?
#include <algorithm>
#include <cmath>

#include "figures/interior.h"
#include "figures/solid_view.h"
#include "figures/starfish.h"
#include "sem/nurbs/refine.h"
#include "src3d/render/tessellate.h"
#include "src3d/shapes/solids.h"

namespace sem::figures {
namespace {

constexpr double height = 0.6, level = 0.3;  // m: of the solid, of the slice
constexpr int n_cells = 60;
// As fine as can be seen: the stored reference has all of them.
constexpr double step_of_w = 1e-4, step_of_position = 1e-5;
struct Variant {
  DistanceWeight weight;
  const char *column, *title;
};
const Variant variants[] = {{DistanceWeight::published, "w_published", "published"},
                            {DistanceWeight::draft, "w_draft", "draft"},
                            {DistanceWeight::distance_only, "w_distance_only", "distance only"},
                            {DistanceWeight::sided, "w_sided", "sided distance"}};

// The starfish of the teaser with two curves an arm, made thick.
Discretization<3> thick_starfish() {
  shapes3d::Profile profile;
  const auto scene = starfish_scene();
  for (const auto& part : scene.solids[0].parts) {
    const Interval range = domain(part.shape, 0);
    for (const auto& half : split_at(part.shape, 0, (range.lower + range.upper) / 2))
      profile.push_back(ScenePart<2>{part.name, half, {}});
  }
  std::vector<Nurbs<2, 3>> parts;
  for (const auto& part : make_parts(shapes3d::Extrusion{profile, {0, 0, height}}))
    parts.push_back(part.shape);
  Discretization<3> body;
  body.options.weights.cutoff = 1;
  body.boundary = make_boundary<3>({parts});
  body.loops = find_loops(body.boundary);
  return body;
}

// The side whose middle is farthest to the right of the lower side of its arm.
int shown_part(const Boundary<3>& boundary) {
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < boundary.n_parts(); ++i) {
    const auto& box = boundary.parts[i].box;
    if (box.upper[2] - box.lower[2] < height) continue;
    const Vec<3> middle = (box.lower + box.upper) / 2;
    const double score = (middle - Vec<3>(0.95, -0.75, middle[2])).norm();
    if (score < least) {
      least = score;
      best = i;
    }
  }
  return best;
}

Data compute() {
  const auto body = thick_starfish();
  const int part = shown_part(body.boundary);
  std::vector<Nurbs<2, 3>> parts;
  for (const auto& prepared : body.boundary.parts) parts.push_back(prepared.nurbs);
  Data data;
  add_surfaces(data, parts);
  data.add("shown", {"part", "level"}).add({double(part), level});
  const Slice slice = slice_inside(body, level, n_cells);
  std::vector<std::string> columns = {"x", "y", "z"};
  Eigen::MatrixXd w(slice.position.cols(), 4);
  for (int v = 0; v < 4; ++v) {
    columns.push_back(variants[v].column);
    w.col(v) = weight_field(body, slice.position, variants[v].weight).col(part);
  }
  auto& points = data.add("slice", columns);
  for (Eigen::Index k = 0; k < w.rows(); ++k) {
    std::vector<double> row;
    for (const double x : slice.position.col(k))
      row.push_back(std::round(x / step_of_position) * step_of_position);
    for (const double value : w.row(k)) row.push_back(std::round(value / step_of_w) * step_of_w);
    points.add(row);
  }
  auto& triangles = data.add("triangles", {"a", "b", "c"});
  for (const auto& t : slice.triangles) triangles.add({double(t[0]), double(t[1]), double(t[2])});
  return data;
}

render::RenderScene scene_of(const Data& data, int variant, const ColorScale& scale, double point) {
  const auto parts = surfaces_of(data);
  const int shown = int(data["shown"].value("part"));
  render::RenderScene scene;
  scene.meshes = meshes_of(parts, [&](int part) {
    return part == shown ? colors::okabe_ito[1] : Color{0.82, 0.83, 0.86};
  });
  for (auto& mesh : scene.meshes)
    mesh.kept = render::HalfSpace{Vec<3>(0, 0, 1), data["shown"].value("level")};
  const DataTable &points = data["slice"], &triangles = data["triangles"];
  render::Mesh slice;
  slice.lit = false;
  for (int k = 0; k < points.n_rows(); ++k) {
    slice.position.emplace_back(points["x"][k], points["y"][k], points["z"][k]);
    slice.normal.emplace_back(0, 0, 1);
    slice.colors.push_back(scale(points[variants[variant].column][k]));
  }
  for (int t = 0; t < triangles.n_rows(); ++t)
    slice.triangles.push_back(
        {int(triangles["a"][t]), int(triangles["b"][t]), int(triangles["c"][t])});
  scene.meshes.push_back(std::move(slice));
  // Where the shown part meets the slice: its line of half height.
  const auto side = prepare(parts[shown]);
  render::Lines edge{{}, colors::okabe_ito[1], 1.6 * point};
  for (auto& chain : render::isoparametric_lines(side, 1, false, {1e-3})) {
    const bool level_line = std::all_of(
        chain.begin(), chain.end(), [](const Vec<3>& X) { return std::abs(X[2] - level) < 1e-9; });
    if (level_line) edge.chains.push_back(std::move(chain));
  }
  scene.lines.push_back(edge);
  scene.ground = 0;
  return scene;
}

void draw(Plot& plot, const Data& data) {
  plot.letters = true;
  const ColorScale scale{0, 0.5};
  const DataTable& points = data["slice"];
  Box<3> box;
  for (int k = 0; k < points.n_rows(); ++k)
    for (const double z : {0.0, points["z"][k]})
      box.include(Vec<3>(points["x"][k], points["y"][k], z));
  for (int v = 0; v < 4; ++v) {
    Panel& panel = plot.panel(v / 2, v % 2);
    panel.title = variants[v].title;
    draw_view(panel, {[data, v, scale](double point) { return scene_of(data, v, scale, point); },
                      render::corners(box),
                      {.from = {0.15, -1, 1.5}}});
  }
  plot.color_bar(scale, "w of the orange part");
}

}  // namespace

Figure limb_slices() {
  Figure figure{"limb_slices",
                "Blending weight of one side of an arm (orange) of a thick starfish, on a slice "
                "half-way up, the upper half removed. With the secondary ray (published, draft) it "
                "jumps where the closest point or what the ray hits does; plain distance is "
                "continuous, but reaches across the gap into the next arm; sided distance does "
                "neither",
                7,
                5.2,
                compute,
                draw};
  figure.slow = true;
  return figure;
}

}  // namespace sem::figures
