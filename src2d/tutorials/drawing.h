#pragma once
// What several tutorials draw in the plane: the three-curve solid, the parts of a boundary, fields in its
// inside, marks. Nothing of the method is computed here.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sem/lesson/plots.h"
#include "sem/method/blending_weights.h"

namespace sem::tutorial {

using Curves = std::vector<Nurbs<1, 2>>;

/// The solid of the draft's figures 4 and 5 as three cubic Bezier curves around nine points: A from
/// point 1 to 4, B from 4 to 7, C from 7 back to 1. `three_points` is a choice of them, m.
Points<2> three_points();
Curves three_curves(const Points<2>& points);
/// The joints of three_points() belong to two parts: the 12 control points of three_curves from
/// the 9.
constexpr int point_of_control(int control) { return (3 * (control / 4) + control % 4) % 9; }
Points<2> controls_of(const Points<2>& nine);
/// three_points(), with part B pulled to the right.
Points<2> pulled_points();

/// Points along a curve, 2 by n + 1.
Points<2> polyline(const Nurbs<1, 2>& curve, int n = 60);
/// Draws the curves in the colours of part_color and, unless empty, one name beside each; then the
/// mouse reads name and u on a curve.
void draw_parts(Picture& picture, const Curves& parts, const std::string& names = "",
                double width = 4);

/// Values stored in rows (as theta and w are) with their zeros: #rows by n_columns.
Eigen::MatrixXd dense(const std::vector<int>& begin, const std::vector<int>& column,
                      const std::vector<double>& value, int n_columns);
inline Eigen::MatrixXd dense(const DistanceWeights<2>& t) {
  return dense(t.begin, t.part, t.theta, t.n_parts);
}
inline Eigen::MatrixXd dense(const BlendingWeights<2>& w) {
  return dense(w.begin, w.part, w.w, w.n_parts);
}

/// Square cells whose centres lie inside the body.
struct Cells {
  Box<2> box;
  int n_x = 0, n_y = 0;
  Points<2> center;        ///< 2 by #cells
  std::vector<int> place;  ///< #cells: column + n_x * row, rows from the top
  double size = 0;         ///< m, length of an edge
  Points<2> outline;       ///< of a body whose parts follow each other around it; else empty
};
/// About `n` cells along the longer side of the body's box.
Cells cells_inside(const Boundary<2>& boundary, const Loops<2>& loops, int n);
/// Colours the cells, cut off at the outline if it is known.
void draw_cells(Picture& picture, const Cells& cells, const std::function<Color(int cell)>& color);
/// Colours from 0 to 1 by viridis; the mouse reads the values.
void draw_field(Picture& picture, const Cells& cells, const Eigen::VectorXd& values,
                const std::string& label);
/// The colours of the parts, mixed by the weights w (#cells by #parts); pale where listed. The
/// mouse reads w.
void draw_weights(Picture& picture, const Cells& cells, const Eigen::MatrixXd& w,
                  const std::vector<int>& pale = {});

/// "(1.2, 3)", for hovering.
std::string coordinates(const Vec<2>& X);
int nearest(const Points<2>& points, const Vec<2>& X);  ///< column
/// The mouse reads the label and the value of the nearest of some points.
void read_values(Picture& picture, const Points<2>& points, const Eigen::VectorXd& values,
                 const std::string& label);
/// Of points that moved from X to x (both 2 by #points) it reads both.
void read_motion(Picture& picture, const Points<2>& X, const Points<2>& x);

/// An outline; the mouse reads, with a label, how far its points are from those of another one.
void draw_outline(Picture& picture, const Points<2>& outline, const Color& color,
                  const Points<2>& other = {}, const std::string& label = "");
/// Lines from X to points, as wide as their values, blue > 0, red < 0; the mouse reads the values.
void draw_influence(Picture& picture, const Vec<2>& X, const Points<2>& points,
                    const Eigen::VectorXd& values, const std::string& symbol);
/// A dot with its name.
void draw_mark(Picture& picture, const Vec<2>& at, const std::string& name, const Color& color,
               const Vec<2>& offset = {12, -12});
/// A text beside the middle of the line from a to b; from b to a it is on the other side.
void draw_measure(Picture& picture, const Vec<2>& a, const Vec<2>& b, const std::string& text,
                  const Color& color);

}  // namespace sem::tutorial
