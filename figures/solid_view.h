#pragma once
// Solids in figures: their surfaces as tables, and panels that show them rendered.

#include <functional>

#include "figures/figure.h"
#include "sem/nurbs/nurbs.h"
#include "sem/nurbs/region.h"
#include "src3d/render/camera.h"
#include "src3d/render/render_scene.h"

namespace sem::figures {

/// Adds the tables `surfaces` (part, degree_u, degree_v), `knots` (part, axis, knot) and `controls`
/// (part, x, y, z, w), their names led by the prefix.
void add_surfaces(Data& data, const std::vector<Nurbs<2, 3>>& parts,
                  const std::string& prefix = "");
/// What they hold.
std::vector<Nurbs<2, 3>> surfaces_of(const Data& data, const std::string& prefix = "");

/// What each part is trimmed to; empty: no part is.
using Trims = std::vector<TrimLoops>;
/// Adds the tables `trims` (part, loop, curve, degree), `trim knots` (curve, knot) and `trim
/// controls` (curve, u, v, w), curves of all parts counted from 0, their names led by the prefix;
/// no table if no part is trimmed.
void add_trims(Data& data, const Trims& trims, const std::string& prefix = "");
/// What they hold, for so many parts.
Trims trims_of(const Data& data, int n_parts, const std::string& prefix = "");

/// A text beside a point of the scene; offset in points, y up.
struct SolidLabel {
  Vec<3> at;
  std::string text;
  Vec<2> offset = Vec<2>::Zero();
  bool leader = false;
};

/// What a panel shows of space. `scene` is called with the number of pixels to a point (1/72 inch),
/// for the widths of lines.
struct SolidView {
  std::function<render::RenderScene(double point)> scene;
  std::vector<Vec<3>> framed;  ///< what the camera has in view
  render::ViewDirection direction = {};
  std::vector<SolidLabel> labels = {};
  bool even_light = false;  ///< mostly from everywhere: colours can be compared with a colour bar
};

/// Fills the panel with the view; it has neither axes nor frame.
void draw_view(Panel& panel, SolidView view);

/// The parts as meshes of a colour each, flat to 1/3000 of their common size; at least so many
/// cells along u and v (a power of two), for colours.
std::vector<render::Mesh> meshes_of(const std::vector<Nurbs<2, 3>>& parts,
                                    const std::function<Color(int part)>& color,
                                    int least_cells = 1, const Trims& trims = {});
/// Lines along the sides of all parts; `between` lines inside every knot span as well. Of trimmed
/// parts their borders alone.
render::Lines lines_of(const std::vector<Nurbs<2, 3>>& parts, int between, const Color& color,
                       double width, const Trims& trims = {});
/// Lines along the sides at rest of the parts that have moved by a hundredth of the solid's size.
render::Lines rest_lines(const std::vector<Nurbs<2, 3>>& rest, const std::vector<Nurbs<2, 3>>& now,
                         double width, const Trims& trims = {});
/// Points of the surfaces as close as outlines need them, to be framed.
std::vector<Vec<3>> seen_points(const std::vector<Nurbs<2, 3>>& parts, const Trims& trims = {});
/// Corners of the box of all control points, to be framed.
std::vector<Vec<3>> framed(const std::vector<Nurbs<2, 3>>& parts);

}  // namespace sem::figures
