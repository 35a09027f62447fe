#include "sem/plot/field.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>

#include "sem/base/error.h"

namespace sem {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Number of the edge of the lattice of centres that starts at centre (i, j) along x (0) or y (1).
using Edge = long;

struct Segment {
  Edge from, to;
};

/// The crossings of one level, by edge.
class Squares {
 public:
  Squares(const CellGrid& grid, double level) : grid_(grid), level_(level) {
    for (int j = 0; j + 1 < grid.n_y; ++j)
      for (int i = 0; i + 1 < grid.n_x; ++i) add(i, j);
  }

  std::vector<std::vector<Vec<2>>> lines() const;

 private:
  Edge edge(int i, int j, int axis) const { return 2 * (long(j) * grid_.n_x + i) + axis; }

  Vec<2> crossing(Edge e) const {
    const int axis = int(e % 2), i = int(e / 2 % grid_.n_x), j = int(e / 2 / grid_.n_x);
    const int i1 = i + (axis == 0), j1 = j + (axis == 1);
    const double a = grid_.at(i, j), b = grid_.at(i1, j1), t = (level_ - a) / (b - a);
    return (1 - t) * grid_.center(i, j) + t * grid_.center(i1, j1);
  }

  void add(int i, int j) {
    // Corners anticlockwise; edge k joins the corners k and k + 1.
    const double value[4] = {grid_.at(i, j), grid_.at(i + 1, j), grid_.at(i + 1, j + 1),
                             grid_.at(i, j + 1)};
    const Edge edges[4] = {edge(i, j, 0), edge(i + 1, j, 1), edge(i, j + 1, 0), edge(i, j, 1)};
    double mean = 0;
    for (const double v : value) mean += v / 4;
    if (!std::isfinite(mean)) return;
    // A line enters where the values rise past the level along the boundary and leaves where they
    // fall, so that neighbours agree. At a saddle the mean tells which corners are joined.
    std::vector<int> rising, falling;
    for (int k = 0; k < 4; ++k) {
      const bool a = value[k] >= level_, b = value[(k + 1) % 4] >= level_;
      if (!a && b) rising.push_back(k);
      if (a && !b) falling.push_back(k);
    }
    if (rising.size() == 2)
      for (int k = 0; k < 2; ++k) falling[k] = (rising[k] + (mean >= level_ ? 3 : 1)) % 4;
    for (std::size_t k = 0; k < rising.size(); ++k)
      segments_.push_back({edges[rising[k]], edges[falling[k]]});
  }

  const CellGrid& grid_;
  double level_;
  std::vector<Segment> segments_;
};

std::vector<std::vector<Vec<2>>> Squares::lines() const {
  // Every edge ends at most one segment and starts at most one.
  std::map<Edge, Edge> next;
  std::map<Edge, bool> has_before;
  for (const auto& s : segments_) {
    next[s.from] = s.to;
    has_before[s.to] = true;
  }
  std::vector<std::vector<Vec<2>>> result;
  const auto follow = [&](Edge start) {
    std::vector<Vec<2>> line{crossing(start)};
    for (auto at = next.find(start); at != next.end();) {
      const Edge to = at->second;
      line.push_back(crossing(to));
      next.erase(at);
      at = next.find(to);
    }
    result.push_back(std::move(line));
  };
  for (const auto& s : segments_)
    if (!has_before.count(s.from)) follow(s.from);  // open lines
  while (!next.empty()) follow(next.begin()->first);
  return result;
}

/// The least distance of neighbours among the distinct values.
double spacing_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double tiny = 1e-6 * (values.back() - values.front());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] - values[i - 1] > tiny) least = std::min(least, values[i] - values[i - 1]);
  return least;
}

}  // namespace

Color ColorScale::operator()(double value) const {
  if (logarithmic) return map(std::log(value / lower) / std::log(upper / lower));
  return map((value - lower) / (upper - lower));
}

ColorScale scale_of(const std::vector<double>& values) {
  ColorScale scale{std::numeric_limits<double>::infinity(),
                   -std::numeric_limits<double>::infinity()};
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    scale.lower = std::min(scale.lower, v);
    scale.upper = std::max(scale.upper, v);
  }
  if (!(scale.lower <= scale.upper)) return {};
  if (scale.lower == scale.upper)
    scale.upper = scale.lower + std::max(1e-300, std::abs(scale.lower));
  return scale;
}

ColorScale diverging_scale_of(const std::vector<double>& values) {
  const ColorScale range = scale_of(values);
  const double m = std::max(std::abs(range.lower), std::abs(range.upper));
  return {-m, m, colors::diverging};
}

Vec<2> CellGrid::center(int i, int j) const {
  const Vec<2> size = box.upper - box.lower;
  return box.lower + Vec<2>((i + 0.5) / n_x * size[0], (j + 0.5) / n_y * size[1]);
}

CellGrid empty_grid(const Box<2>& box, double cell_size) {
  const Vec<2> size = box.upper - box.lower;
  const auto n = [&](int axis) { return std::max(1, int(std::lround(size[axis] / cell_size))); };
  CellGrid grid{box, n(0), n(1)};
  grid.values.assign(std::size_t(grid.n_x) * grid.n_y, nan);
  return grid;
}

CellGrid grid_of(const std::vector<double>& x, const std::vector<double>& y,
                 const std::vector<double>& values) {
  assert(x.size() == y.size() && x.size() == values.size());
  if (x.empty()) throw InputError("", "grid", "no cells", "at least one");
  double dx = spacing_of(x), dy = spacing_of(y);
  if (!std::isfinite(dx)) dx = std::isfinite(dy) ? dy : 1;
  if (!std::isfinite(dy)) dy = dx;
  const auto [x_min, x_max] = std::minmax_element(x.begin(), x.end());
  const auto [y_min, y_max] = std::minmax_element(y.begin(), y.end());
  const Vec<2> half(dx / 2, dy / 2), lower(*x_min, *y_min);
  const int n_x = int(std::lround((*x_max - *x_min) / dx)) + 1,
            n_y = int(std::lround((*y_max - *y_min) / dy)) + 1;
  const Vec<2> upper = lower + Vec<2>((n_x - 1) * dx, (n_y - 1) * dy);
  CellGrid grid{{lower - half, upper + half}, n_x, n_y};
  grid.values.assign(std::size_t(n_x) * n_y, nan);
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double column = (x[k] - *x_min) / dx, row = (y[k] - *y_min) / dy;
    if (std::abs(column - std::round(column)) > 0.01 || std::abs(row - std::round(row)) > 0.01)
      throw InputError("", "grid",
                       "a cell at (" + std::to_string(x[k]) + ", " + std::to_string(y[k]) + ")",
                       "centres in rows and columns of one spacing");
    grid.at(int(std::lround(column)), int(std::lround(row))) = values[k];
  }
  return grid;
}

std::vector<std::vector<Vec<2>>> contour_lines(const CellGrid& grid, double level) {
  return Squares(grid, level).lines();
}

}  // namespace sem
