#include "sem/nurbs/prepared.h"

#include "sem/nurbs/axis_map.h"
#include "sem/nurbs/foot_cells.h"
#include "sem/nurbs/power_form.h"
#include "sem/nurbs/surface_cells.h"

namespace sem {
namespace {

// Bezier control points of all spans along an axis, one after the other;
// neighbours share a row unless the knot between them has multiplicity
// degree + 1. start[s] is the first row of span s.
detail::AxisMap bezier_map(const std::vector<double>& knots, int degree,
                           const std::vector<Interval>& spans, std::vector<int>& start) {
  detail::AxisMap map;
  std::vector<double> arguments(degree);
  for (const auto& [lower, upper] : spans) {
    const int k = detail::find_span(knots, degree, lower);
    const bool jump = map.first.empty() || knots[k - degree] == lower;
    start.push_back(int(map.first.size()) - (jump ? 0 : 1));
    for (int j = jump ? 0 : 1; j <= degree; ++j) {
      for (int a = 0; a < degree; ++a) arguments[a] = a < degree - j ? lower : upper;
      detail::append_polar_form(knots, degree, k, arguments.data(), map);
    }
  }
  return map;
}

std::shared_ptr<const detail::FootCells> feet_of(const PreparedNurbs<1, 2>& part) {
  return detail::make_foot_cells(part);
}
template <int ParamDim, int Dim>
std::shared_ptr<const detail::FootCells> feet_of(const PreparedNurbs<ParamDim, Dim>&) {
  return nullptr;
}

std::shared_ptr<const detail::SurfaceCells> cells_of(const PreparedNurbs<2, 3>& part) {
  return detail::make_surface_cells(part);
}
template <int ParamDim, int Dim>
std::shared_ptr<const detail::SurfaceCells> cells_of(const PreparedNurbs<ParamDim, Dim>&) {
  return nullptr;
}

}  // namespace

template <int ParamDim, int Dim>
PreparedNurbs<ParamDim, Dim> prepare(const Nurbs<ParamDim, Dim>& nurbs) {
  PreparedNurbs<ParamDim, Dim> result;
  result.nurbs = nurbs;
  Nurbs<ParamDim, Dim> bezier = nurbs;
  std::array<std::vector<int>, ParamDim> start;
  std::array<int, ParamDim> rows, index{};
  int n_per_piece = 1;
  for (int a = 0; a < ParamDim; ++a) {
    const int degree = nurbs.degree[a];
    result.spans[a] = spans(nurbs, a);
    const auto map = bezier_map(nurbs.knots[a], degree, result.spans[a], start[a]);
    detail::apply(map, a, bezier);
    rows[a] = int(map.first.size());
    bezier.knots[a].resize(rows[a] + degree + 1);  // n_control is all that is needed of it
    n_per_piece *= degree + 1;
  }
  for (int axis = 0; axis < ParamDim;) {
    BezierPiece<ParamDim, Dim> piece;
    piece.degree = nurbs.degree;
    piece.points.resize(Dim, n_per_piece);
    piece.weights.resize(n_per_piece);
    for (int a = 0; a < ParamDim; ++a) {
      piece.lower[a] = result.spans[a][index[a]].lower;
      piece.upper[a] = result.spans[a][index[a]].upper;
    }
    for (int i = 0; i < n_per_piece; ++i) {
      int rest = i, column = 0, stride = 1;
      for (int a = 0; a < ParamDim; ++a) {
        column += (start[a][index[a]] + rest % (nurbs.degree[a] + 1)) * stride;
        rest /= nurbs.degree[a] + 1;
        stride *= rows[a];
      }
      piece.points.col(i) = bezier.control_points.col(column);
      piece.weights[i] = bezier.weights[column];
      piece.box.include(Vec<Dim>(piece.points.col(i)));
    }
    result.box.include(piece.box);
    result.pieces.push_back(std::move(piece));
    for (axis = 0; axis < ParamDim; ++axis) {  // next span, u fastest
      if (++index[axis] < int(result.spans[axis].size())) break;
      index[axis] = 0;
    }
  }
  result.power = detail::make_power_form(result);
  result.feet = feet_of(result);
  result.cells = cells_of(result);
  return result;
}

template <int ParamDim, int Dim>
Vec<Dim> point(const BezierPiece<ParamDim, Dim>& piece, const Param<ParamDim>& s) {
  double basis[ParamDim][max_nurbs_degree + 1];
  for (int a = 0; a < ParamDim; ++a) {
    basis[a][0] = 1;
    for (int j = 1; j <= piece.degree[a]; ++j) {
      basis[a][j] = s[a] * basis[a][j - 1];
      for (int r = j - 1; r > 0; --r)
        basis[a][r] = (1 - s[a]) * basis[a][r] + s[a] * basis[a][r - 1];
      basis[a][0] *= 1 - s[a];
    }
  }
  Vec<Dim> sum = Vec<Dim>::Zero();
  double weight = 0;
  for (int i = 0; i < piece.weights.size(); ++i) {
    double product = piece.weights[i];
    for (int a = 0, rest = i; a < ParamDim; rest /= piece.degree[a] + 1, ++a)
      product *= basis[a][rest % (piece.degree[a] + 1)];
    sum += product * piece.points.col(i);
    weight += product;
  }
  return sum / weight;
}

#define SEM_INSTANTIATE(P, D)                               \
  template PreparedNurbs<P, D> prepare(const Nurbs<P, D>&); \
  template Vec<D> point(const BezierPiece<P, D>&, const Param<P>&);
SEM_INSTANTIATE(1, 2)
SEM_INSTANTIATE(1, 3)
SEM_INSTANTIATE(2, 3)
#undef SEM_INSTANTIATE

}  // namespace sem
