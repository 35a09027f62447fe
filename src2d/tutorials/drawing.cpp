#include "src2d/tutorials/drawing.h"

#include <algorithm>
#include <cmath>

#include "sem/draw/image.h"
#include "sem/lesson/numbers.h"
#include "sem/nurbs/basis.h"
#include "sem/nurbs/bezier_curve.h"

namespace sem::tutorial {
namespace {

Points<2> points_of(const std::vector<Vec<2>>& list) {
  Points<2> points(2, list.size());
  for (std::size_t k = 0; k < list.size(); ++k) points.col(k) = list[k];
  return points;
}

}  // namespace

Points<2> three_points() {
  Points<2> p(2, 9);
  p << 0.2, 0.3, 1.5, 2.5, 4.2, 3.2, 3.6, 2.2, 0.4,  //
      1.7, 3.9, 0.9, 2.7, 3.2, 1.4, 0.4, -0.6, 1.2;
  return p;
}

Curves three_curves(const Points<2>& points) {
  Curves curves;
  for (int part = 0; part < 3; ++part) {
    Points<2> p(2, 4);
    for (int j = 0; j < 4; ++j) p.col(j) = points.col((3 * part + j) % 9);
    curves.push_back(bezier_curve<2>(p, Eigen::VectorXd::Ones(4)));
  }
  return curves;
}

Points<2> controls_of(const Points<2>& nine) {
  Points<2> twelve(2, 12);
  for (int k = 0; k < 12; ++k) twelve.col(k) = nine.col(point_of_control(k));
  return twelve;
}

Points<2> pulled_points() {
  Points<2> p = three_points();
  p.col(4) += Vec<2>(0.4, 0.5);
  p.col(5) += Vec<2>(1.1, 0.3);
  p.col(6) += Vec<2>(0.5, -0.4);
  return p;
}

Points<2> polyline(const Nurbs<1, 2>& curve, int n) {
  const Interval u = domain(curve, 0);
  Points<2> points(2, n + 1);
  for (int k = 0; k <= n; ++k)
    points.col(k) = point(curve, Param<1>(u.lower + (u.upper - u.lower) * k / n));
  return points;
}

void draw_parts(Picture& picture, const Curves& parts, const std::string& names, double width) {
  Vec<2> middle = Vec<2>::Zero();
  for (const auto& part : parts) middle += polyline(part, 2).col(1) / double(parts.size());
  for (int i = 0; i < int(parts.size()); ++i) {
    Stroke stroke{.color = part_color(i), .width = width};
    stroke.cap = Stroke::Cap::round;
    picture.curve(polyline(parts[i]), stroke);
    if (i >= int(names.size())) continue;
    const Points<2> points = polyline(parts[i], 100);
    picture.hover(
        [points, name = names.substr(i, 1), reach = 8 / picture.view().scale()](const Vec<2>& X) {
          const int k = nearest(points, X);
          return (points.col(k) - X).norm() < reach ? name + ", u = " + rounded(k / 100.0, 2) : "";
        });
    const Points<2> near = polyline(parts[i], 40).middleCols(19, 3);
    Vec<2> out = DimTraits<2>::area_normal(near.col(2) - near.col(0)).normalized();
    if (out.dot(near.col(1) - middle) < 0) out = -out;
    picture.label(near.col(1), names.substr(i, 1), part_color(i), {22 * out[0], -22 * out[1]}, 22);
  }
}

Eigen::MatrixXd dense(const std::vector<int>& begin, const std::vector<int>& column,
                      const std::vector<double>& value, int n_columns) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(Eigen::Index(begin.size()) - 1, n_columns);
  for (int k = 0; k < m.rows(); ++k)
    for (int e = begin[k]; e < begin[k + 1]; ++e) m(k, column[e]) = value[e];
  return m;
}

Cells cells_inside(const Boundary<2>& boundary, const Loops<2>& loops, int n) {
  Cells cells;
  // Tighter than boundary.box, which holds the control points too.
  for (const auto& part : boundary.parts) {
    const Points<2> points = polyline(part.nurbs);
    cells.box.include(Box<2>{points.rowwise().minCoeff(), points.rowwise().maxCoeff()});
  }
  const Vec<2> extent = cells.box.upper - cells.box.lower;
  cells.size = extent.maxCoeff() / n;
  cells.n_x = std::max(1, int(std::ceil(extent[0] / cells.size - 1e-9)));
  cells.n_y = std::max(1, int(std::ceil(extent[1] / cells.size - 1e-9)));
  cells.box.upper = cells.box.lower + cells.size * Vec<2>(cells.n_x, cells.n_y);
  std::vector<Vec<2>> centers;
  for (int row = 0; row < cells.n_y; ++row)
    for (int column = 0; column < cells.n_x; ++column) {
      const Vec<2> X(cells.box.lower[0] + (column + 0.5) * cells.size,
                     cells.box.upper[1] - (row + 0.5) * cells.size);
      if (!inside(boundary, loops, X)) continue;
      centers.push_back(X);
      cells.place.push_back(column + cells.n_x * row);
    }
  std::vector<Vec<2>> around;
  bool in_order = true;
  for (const auto& part : boundary.parts) {
    const Points<2> points = polyline(part.nurbs);
    in_order &= around.empty() || (around.back() - points.col(0)).norm() <= boundary.tolerance();
    for (int k = 0; k < points.cols(); ++k) around.push_back(points.col(k));
  }
  if (in_order) cells.outline = points_of(around);
  cells.center = points_of(centers);
  return cells;
}

void draw_cells(Picture& picture, const Cells& cells, const std::function<Color(int)>& color) {
  // A ring of cells more, which repeat their neighbours, so that nothing is missing at the outline.
  const int n_x = cells.n_x + 2, n_y = cells.n_y + 2;
  Image image(n_x, n_y);
  std::fill(image.rgb.begin(), image.rgb.end(), 255);
  image.left_out = {255, 255, 255};
  std::vector<char> set(std::size_t(n_x) * n_y, 0);
  const auto paint = [&](int column, int row, const Color& value, char level) {
    char& taken = set[std::size_t(column) + std::size_t(n_x) * row];
    if (taken != 0 && taken <= level) return;
    taken = level;
    image.set(column, row, value);
  };
  for (std::size_t k = 0; k < cells.place.size(); ++k) {
    const int column = cells.place[k] % cells.n_x + 1, row = cells.place[k] / cells.n_x + 1;
    const Color value = color(int(k));
    paint(column, row, value, 1);
    if (cells.outline.size() == 0) continue;
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j) paint(column + i, row + j, value, char(1 + i * i + j * j));
  }
  const Vec<2> edge = Vec<2>::Constant(cells.size);
  const Vec<2> a = picture.view().map(cells.box.lower - edge),
               b = picture.view().map(cells.box.upper + edge);
  const Box<2> place{a.cwiseMin(b), a.cwiseMax(b)};
  picture.canvas().image(image, place);
  if (cells.outline.size() == 0) return;
  const Vec<2> lower = place.lower - Vec<2>(1, 1), upper = place.upper + Vec<2>(1, 1);
  Polyline outline;
  for (int k = 0; k < cells.outline.cols(); ++k)
    outline.push_back(picture.view().map(cells.outline.col(k)));
  const std::vector<Polyline> outside = {{lower, {upper[0], lower[1]}, upper, {lower[0], upper[1]}},
                                         outline};
  picture.canvas().fill(outside, colors::white);
}

void draw_field(Picture& picture, const Cells& cells, const Eigen::VectorXd& values,
                const std::string& label) {
  draw_cells(picture, cells, [&](int k) { return colors::viridis(values[k]); });
  read_values(picture, cells.center, values, label);
}

void draw_weights(Picture& picture, const Cells& cells, const Eigen::MatrixXd& w,
                  const std::vector<int>& pale) {
  draw_cells(picture, cells, [&](int k) {
    Color mixed{0, 0, 0};
    for (int j = 0; j < w.cols(); ++j) {
      const Color c = part_color(j);
      mixed = {mixed.r + w(k, j) * c.r, mixed.g + w(k, j) * c.g, mixed.b + w(k, j) * c.b};
    }
    const bool listed = std::binary_search(pale.begin(), pale.end(), k);
    return colors::mix(mixed, colors::white, listed ? 0.75 : 0.0);
  });
  picture.hover(cells.center, [=](int k) {
    const bool listed = std::binary_search(pale.begin(), pale.end(), k);
    return "w = " + list(w.row(k).transpose(), 3) + (listed ? ", uncovered" : "");
  });
}

void draw_outline(Picture& picture, const Points<2>& outline, const Color& color,
                  const Points<2>& other, const std::string& label) {
  picture.curve(outline, {.color = color, .width = 4});
  if (other.cols() == outline.cols())
    read_values(picture, outline, (outline - other).colwise().norm(), label);
}

void draw_influence(Picture& picture, const Vec<2>& X, const Points<2>& points,
                    const Eigen::VectorXd& values, const std::string& symbol) {
  for (int j = 0; j < points.cols(); ++j) {
    const Color color = (values[j] > 0 ? blue : red).with_alpha(0.7);
    picture.line(X, points.col(j), {.color = color, .width = 1 + 30 * std::abs(values[j])});
    picture.dot(points.col(j), colors::gray, 10);
  }
  picture.dot(X, colors::black, 13);
  read_values(picture, points, values, symbol);
}

void draw_mark(Picture& picture, const Vec<2>& at, const std::string& name, const Color& color,
               const Vec<2>& offset) {
  picture.dot(at, colors::white, 18);
  picture.dot(at, color, 14);
  picture.label(at, name, color, offset, 20);
}

void draw_measure(Picture& picture, const Vec<2>& a, const Vec<2>& b, const std::string& text,
                  const Color& color) {
  // Above a line to the right, left of a line upwards, and the other side for the other way.
  const Vec<2> along = b - a;
  Vec<2> offset(along[1] > 0 ? 14 : -14, 0);
  if (std::abs(along[0]) > std::abs(along[1])) offset = Vec<2>(0, along[0] > 0 ? -18 : 18);
  picture.label((a + b) / 2, text, color, offset, 20);
}

std::string coordinates(const Vec<2>& X) { return "(" + list(X, 3) + ")"; }

int nearest(const Points<2>& points, const Vec<2>& X) {
  int k = 0;
  (points.colwise() - X).colwise().squaredNorm().minCoeff(&k);
  return k;
}

void read_values(Picture& picture, const Points<2>& points, const Eigen::VectorXd& values,
                 const std::string& label) {
  picture.hover(points, [=](int k) { return reading(label, values[k]); });
}

void read_motion(Picture& picture, const Points<2>& X, const Points<2>& x) {
  picture.hover(x, [=](int k) {
    const Vec<2> u = x.col(k) - X.col(k);
    return "X = " + coordinates(X.col(k)) + "\nx = " + coordinates(x.col(k)) + "\nmoved by " +
           rounded(u.norm(), 3) + " m";
  });
}

}  // namespace sem::tutorial
