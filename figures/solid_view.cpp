#include "figures/solid_view.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include "sem/method/trims.h"
#include "src3d/render/renderer.h"
#include "src3d/render/tessellate.h"

namespace sem::figures {
namespace {

Box<3> control_box(const std::vector<Nurbs<2, 3>>& parts) {
  Box<3> box;
  for (const auto& part : parts)
    for (Eigen::Index c = 0; c < part.control_points.cols(); ++c)
      box.include(Vec<3>(part.control_points.col(c)));
  return box;
}

PreparedNurbs<2, 3> prepared(const Nurbs<2, 3>& part, const Trims& trims, std::size_t i) {
  auto result = prepare(part);
  if (i < trims.size()) result.region = make_region<3>(result, trims[i]);
  return result;
}

// One for all figures: programs are compiled once.
render::Renderer& renderer() {
  static render::Renderer instance;
  return instance;
}

void draw_label(const Pen& pen, const render::Camera& camera, const SolidLabel& label) {
  const Vec<2> at = pen.box().lower + camera.project(label.at),
               to = at + pen.point * Vec<2>(label.offset[0], -label.offset[1]);
  if (label.leader) pen.canvas.line(at, to, pen.stroke({0.35, 0.35, 0.35}, 0.6));
  using Horizontal = TextStyle::Horizontal;
  const Horizontal side = label.offset[0] > 2    ? Horizontal::left
                          : label.offset[0] < -2 ? Horizontal::right
                                                 : Horizontal::center;
  const double gap = side == Horizontal::left ? 2 : side == Horizontal::right ? -2 : 0;
  pen.canvas.text(to + Vec<2>(gap * pen.point, 0), label.text, pen.text(side));
}

}  // namespace

void add_surfaces(Data& data, const std::vector<Nurbs<2, 3>>& parts, const std::string& prefix) {
  auto& surfaces = data.add(prefix + "surfaces", {"part", "degree_u", "degree_v"});
  for (std::size_t i = 0; i < parts.size(); ++i)
    surfaces.add({double(i), double(parts[i].degree[0]), double(parts[i].degree[1])});
  auto& knots = data.add(prefix + "knots", {"part", "axis", "knot"});
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (int axis = 0; axis < 2; ++axis)
      for (const double knot : parts[i].knots[axis]) knots.add({double(i), double(axis), knot});
  auto& controls = data.add(prefix + "controls", {"part", "x", "y", "z", "w"});
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (Eigen::Index c = 0; c < parts[i].control_points.cols(); ++c) {
      const Vec<3> X = parts[i].control_points.col(c);
      controls.add({double(i), X[0], X[1], X[2], parts[i].weights[c]});
    }
}

std::vector<Nurbs<2, 3>> surfaces_of(const Data& data, const std::string& prefix) {
  std::vector<Nurbs<2, 3>> parts;
  const DataTable& surfaces = data[prefix + "surfaces"];
  const auto knots = data[prefix + "knots"].runs("part"),
             controls = data[prefix + "controls"].runs("part");
  for (int i = 0; i < surfaces.n_rows(); ++i) {
    Nurbs<2, 3> part;
    part.degree = {int(surfaces["degree_u"][i]), int(surfaces["degree_v"][i])};
    for (int axis = 0; axis < 2; ++axis) part.knots[axis] = knots[i].where("axis", axis)["knot"];
    const int n = controls[i].n_rows();
    part.control_points.resize(3, n);
    part.weights.resize(n);
    for (int c = 0; c < n; ++c) {
      part.control_points.col(c) << controls[i]["x"][c], controls[i]["y"][c], controls[i]["z"][c];
      part.weights[c] = controls[i]["w"][c];
    }
    parts.push_back(part);
  }
  return parts;
}

void add_trims(Data& data, const Trims& trims, const std::string& prefix) {
  if (std::all_of(trims.begin(), trims.end(), [](const auto& loops) { return loops.empty(); }))
    return;
  DataTable curves({"part", "loop", "curve", "degree"}), knots({"curve", "knot"}),
      controls({"curve", "u", "v", "w"});
  int number = 0;
  for (std::size_t i = 0; i < trims.size(); ++i)
    for (std::size_t loop = 0; loop < trims[i].size(); ++loop)
      for (const auto& curve : trims[i][loop]) {
        curves.add({double(i), double(loop), double(number), double(curve.degree[0])});
        for (const double knot : curve.knots[0]) knots.add({double(number), knot});
        for (Eigen::Index c = 0; c < curve.control_points.cols(); ++c)
          controls.add({double(number), curve.control_points(0, c), curve.control_points(1, c),
                        curve.weights[c]});
        ++number;
      }
  data.add(prefix + "trims", curves.columns()) = curves;
  data.add(prefix + "trim knots", knots.columns()) = knots;
  data.add(prefix + "trim controls", controls.columns()) = controls;
}

Trims trims_of(const Data& data, int n_parts, const std::string& prefix) {
  if (!data.has(prefix + "trims")) return {};
  Trims trims(n_parts);
  const DataTable& curves = data[prefix + "trims"];
  const auto knots = data[prefix + "trim knots"].runs("curve"),
             controls = data[prefix + "trim controls"].runs("curve");
  for (int k = 0; k < curves.n_rows(); ++k) {
    Nurbs<1, 2> curve;
    curve.degree = {int(curves["degree"][k])};
    curve.knots[0] = knots[k]["knot"];
    const int n = controls[k].n_rows();
    curve.control_points.resize(2, n);
    curve.weights.resize(n);
    for (int c = 0; c < n; ++c) {
      curve.control_points.col(c) << controls[k]["u"][c], controls[k]["v"][c];
      curve.weights[c] = controls[k]["w"][c];
    }
    auto& loops = trims[int(curves["part"][k])];
    loops.resize(std::size_t(curves["loop"][k]) + 1);
    loops.back().push_back(curve);
  }
  return trims;
}

void draw_view(Panel& panel, SolidView view) {
  panel.frame = false;
  panel.include({0, 0});
  panel.include({1, 1});
  // A plot is laid out, then drawn; both ask for the same picture.
  const auto pictures = std::make_shared<std::map<std::pair<int, int>, Image>>();
  panel.draw([view = std::move(view), pictures](const Pen& pen) {
    const Box<2> box = pen.box();
    const int width = int(std::lround(box.upper[0] - box.lower[0])),
              height = int(std::lround(box.upper[1] - box.lower[1]));
    if (width < 1 || height < 1) return;
    const double margin = 2 * pen.point;
    const auto camera =
        render::framing(view.framed, view.direction,
                        {Vec<2>::Constant(margin), Vec<2>(width - margin, height - margin)});
    auto& picture = (*pictures)[{width, height}];
    auto options = render::paper_quality(width, height);
    if (view.even_light) {
      options.lighting.ambient = 0.66;
      options.lighting.key = 0.42;
      options.lighting.gloss = 0.03;
    }
    if (picture.width == 0) picture = renderer().render(view.scene(pen.point), camera, options);
    const Vec<2> corner = box.lower.array().round();
    pen.canvas.image(picture, {corner, corner + Vec<2>(width, height)});
    for (const auto& label : view.labels) draw_label(pen, camera, label);
  });
}

std::vector<render::Mesh> meshes_of(const std::vector<Nurbs<2, 3>>& parts,
                                    const std::function<Color(int part)>& color, int least_cells,
                                    const Trims& trims) {
  const render::Flatness flatness{control_box(parts).diagonal() / 3000, least_cells};
  std::vector<render::Mesh> meshes;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    meshes.push_back(tessellate(prepared(parts[i], trims, i), flatness));
    meshes.back().color = color(int(i));
  }
  return meshes;
}

render::Lines lines_of(const std::vector<Nurbs<2, 3>>& parts, int between, const Color& color,
                       double width, const Trims& trims) {
  const render::Flatness flatness{control_box(parts).diagonal() / 3000};
  render::Lines lines{{}, color, width};
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto part = prepared(parts[i], trims, i);
    for (auto& chain : part.region ? outline(part, flatness)
                                   : isoparametric_lines(part, between, between > 0, flatness))
      lines.chains.push_back(std::move(chain));
  }
  return lines;
}

render::Lines rest_lines(const std::vector<Nurbs<2, 3>>& rest, const std::vector<Nurbs<2, 3>>& now,
                         double width, const Trims& trims) {
  render::Lines lines{{}, {0.55, 0.55, 0.58}, width};
  const double least = control_box(rest).diagonal() / 100;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if ((now[i].control_points - rest[i].control_points).colwise().norm().maxCoeff() < least) continue;
    auto of_part = lines_of({rest[i]}, 0, lines.color, width, trims.empty() ? Trims{} : Trims{trims[i]});
    for (auto& chain : of_part.chains) lines.chains.push_back(std::move(chain));
  }
  return lines;
}

std::vector<Vec<3>> seen_points(const std::vector<Nurbs<2, 3>>& parts, const Trims& trims) {
  const render::Flatness flatness{control_box(parts).diagonal() / 200};
  std::vector<Vec<3>> points;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto mesh = tessellate(prepared(parts[i], trims, i), flatness);
    points.insert(points.end(), mesh.position.begin(), mesh.position.end());
  }
  return points;
}

std::vector<Vec<3>> framed(const std::vector<Nurbs<2, 3>>& parts) {
  return render::corners(control_box(parts));
}

}  // namespace sem::figures
