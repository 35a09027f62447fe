#include "sem/nurbs/surface_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sem/nurbs/bernstein.h"

namespace sem::detail {
namespace {

constexpr int n_levels = 2;
constexpr double flat = 1e-2;  // thickness of a box that is cut no further

// A box about the coefficients of a patch: along its first corner's way, across its plane.
void set_box(const Vec4* c, const std::array<int, 2>& degree, SurfaceCell& cell) {
  const int p = degree[0], n = (p + 1) * (degree[1] + 1);
  const auto position = [&](int i) -> Vec<3> { return c[i].head<3>() / c[i][3]; };
  const Vec<3> corner[4] = {position(0), position(p), position(n - 1 - p), position(n - 1)};
  const Vec<3> u = corner[1] + corner[3] - corner[0] - corner[2],
               v = corner[2] + corner[3] - corner[0] - corner[1];
  const Vec<3> normal = u.cross(v);
  cell.axes.setIdentity();
  if (normal.norm() > 1e-6 * u.norm() * v.norm()) {
    cell.axes.row(0) = u.normalized();
    cell.axes.row(2) = normal.normalized();
    cell.axes.row(1) = cell.axes.row(2).cross(cell.axes.row(0));
  }
  Box<3> box;
  for (int i = 0; i < n; ++i) box.include(Vec<3>(cell.axes * position(i)));
  cell.half = (box.upper - box.lower) / 2;
  cell.centre = cell.axes.transpose() * ((box.upper + box.lower) / 2);
}

using Vec5 = Eigen::Matrix<double, 5, 1>;

// The ranges of a cell with centre, from the coefficients of its patch.
void set_ranges(const Vec4* c, const std::array<int, 2>& degree, SurfaceCell& cell) {
  const int p = degree[0], q = degree[1], n = (p + 1) * (q + 1), row = 2 * p + 1;
  const double *Bp = binomials(p), *Bq = binomials(q), *B2p = binomials(2 * p),
               *B2q = binomials(2 * q);
  std::vector<Vec4> scaled(c, c + n);
  for (int j = 0, a = 0; j <= q; ++j)
    for (int i = 0; i <= p; ++i, ++a) {
      scaled[a].head<3>() -= scaled[a][3] * cell.centre;
      scaled[a] *= Bp[i] * Bq[j];
    }
  std::vector<Vec5> product(size_t(row) * (2 * q + 1), Vec5::Zero());
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b) {
      Vec5& sum = product[(a / (p + 1) + b / (p + 1)) * row + a % (p + 1) + b % (p + 1)];
      sum[0] += scaled[a].head<3>().dot(scaled[b].head<3>());
      sum.segment<3>(1) += scaled[b][3] * scaled[a].head<3>();
      sum[4] += scaled[a][3] * scaled[b][3];
    }
  cell.least_v = std::numeric_limits<double>::infinity();
  cell.largest_v = 0;
  for (int j = 0, i = 0; j <= 2 * q; ++j)
    for (int k = 0; k <= 2 * p; ++k, ++i) {
      product[i] /= B2p[k] * B2q[j];
      cell.least_v = std::min(cell.least_v, product[i][4]);
      cell.largest_v = std::max(cell.largest_v, product[i][4]);
    }
  const double infinity = std::numeric_limits<double>::infinity();
  Vec5 lower[3], upper[3];
  for (int d = 0; d < 3; ++d) lower[d].setConstant(infinity), upper[d].setConstant(-infinity);
  const auto include = [&](int d, const Vec5& value) {
    lower[d] = lower[d].cwiseMin(value);
    upper[d] = upper[d].cwiseMax(value);
  };
  for (int j = 0; j <= 2 * q; ++j)
    for (int k = 0; k <= 2 * p; ++k) {
      const Vec5* at = &product[j * row + k];
      if (k + 2 <= 2 * p) include(0, at[0] - 2 * at[1] + at[2]);
      if (j + 2 <= 2 * q) include(1, at[0] - 2 * at[row] + at[2 * row]);
      if (k < 2 * p && j < 2 * q) include(2, at[0] - at[1] - at[row] + at[row + 1]);
    }
  const double scale[3] = {2. * p * (2 * p - 1), 2. * q * (2 * q - 1), 4. * p * q};
  for (int d = 0; d < 3; ++d)
    for (int term = 0; term < 5; ++term)
      cell.second[d][term] = {scale[d] * lower[d][term], scale[d] * upper[d][term]};
}

struct Builder {
  const PreparedNurbs<2, 3>& part;
  SurfaceCells& result;

  // Makes cell `index` of this patch with the coefficients c, and those below it.
  void make(int index, const SurfacePatch& patch, int piece, std::vector<Vec4> c) {
    const auto& degree = part.pieces[piece].degree;
    SurfaceCell cell;
    cell.patch = patch;
    cell.piece = piece;
    set_box(c.data(), degree, cell);
    set_ranges(c.data(), degree, cell);
    if (patch.halvings == n_levels || cell.half[2] < flat * cell.half.norm()) {
      cell.first_coefficient = long(result.coefficients.size());
      result.coefficients.insert(result.coefficients.end(), c.begin(), c.end());
      result.cells[index] = cell;
      return;
    }
    cell.first_child = int(result.cells.size());
    result.cells[index] = cell;
    result.cells.resize(result.cells.size() + 4);
    std::array<std::vector<Vec4>, 4> quarter;
    quarter.fill(c);
    std::array<SurfacePatch, 4> patches;
    split(patch, Vec<2>::Constant(0.5), degree, result.rational[piece],
          {quarter[0].data(), quarter[1].data(), quarter[2].data(), quarter[3].data()}, patches);
    for (int k = 0; k < 4; ++k)
      make(cell.first_child + k, patches[k], piece, std::move(quarter[k]));
  }
};

}  // namespace

DistanceCurvature SurfaceCell::curvature(const Vec<3>& X, double m) const {
  const Vec<3> R = X - centre;
  const double factor[4] = {-2 * R[0], -2 * R[1], -2 * R[2], R.squaredNorm() - m};
  double least[3], largest_uv = second[2][0].upper;
  for (int d = 0; d < 3; ++d) {
    least[d] = second[d][0].lower;
    for (int term = 0; term < 4; ++term) {
      const Range& range = second[d][1 + term];
      least[d] += std::min(factor[term] * range.lower, factor[term] * range.upper);
    }
  }
  for (int term = 0; term < 4; ++term) {
    const Range& range = second[2][1 + term];
    largest_uv += std::max(factor[term] * range.lower, factor[term] * range.upper);
  }
  return {least[0], least[1], std::max(largest_uv, -least[2]), least_v, largest_v};
}

std::shared_ptr<const SurfaceCells> make_surface_cells(const PreparedNurbs<2, 3>& part) {
  auto result = std::make_shared<SurfaceCells>();
  result->origin = (part.box.lower + part.box.upper) / 2;
  const int n_pieces = int(part.pieces.size());
  result->cells.resize(n_pieces);
  for (int k = 0; k < n_pieces; ++k) {
    const auto& piece = part.pieces[k];
    result->rational.push_back(piece.weights.minCoeff() < piece.weights.maxCoeff());
    std::vector<Vec4> c(piece.weights.size());
    for (int i = 0; i < int(c.size()); ++i)
      c[i] << piece.weights[i] * (piece.points.col(i) - result->origin), piece.weights[i];
    SurfacePatch patch;
    if (result->rational[k]) balance(patch, c.data(), piece.degree);
    Builder{part, *result}.make(k, patch, k, std::move(c));
  }
  return result;
}

}  // namespace sem::detail
