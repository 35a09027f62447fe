#include "sem/nurbs/foot_cells.h"

#include "sem/nurbs/bernstein.h"
#include "sem/nurbs/power_form.h"

namespace sem::detail {
namespace {

constexpr int max_halvings = 3;
constexpr double largest_reach = 1e-3;  // of the part's size

using PlaneCoefficients = Eigen::Matrix<double, 3, Eigen::Dynamic>;

// C = A / W, so C' = E / W^2 with E = A' W - A W', and (C - X).C' has the sign
// of (A - W X).E. Products are convolutions of coefficients times binomials.
PlaneCoefficients foot_polynomial(const BezierPiece<1, 2>& piece) {
  const int p = piece.degree[0];
  const bool polynomial = (piece.weights.array() == piece.weights[0]).all();
  const Vec<2> centre = 0.5 * (piece.box.lower + piece.box.upper);
  const double* b0 = binomials(p);
  const double* b1 = binomials(p - 1);
  Points<2> A = piece.points.colwise() - centre;
  for (int i = 0; i <= p; ++i) A.col(i) *= piece.weights[i] * b0[i];
  const Eigen::VectorXd W =
      piece.weights.cwiseProduct(Eigen::Map<const Eigen::VectorXd>(b0, p + 1));
  Points<2> E = Points<2>::Zero(2, polynomial ? p : 2 * p);
  for (int i = 0; i < p; ++i) {
    const double dw = b1[i] * (piece.weights[i + 1] - piece.weights[i]);
    // Slope of A from differences of positions, which are exact for equal ones.
    const Vec<2> a0 = piece.points.col(i) - centre, a1 = piece.points.col(i + 1) - centre;
    const Vec<2> dA = b1[i] * (piece.weights[i + 1] * (a1 - a0)) + dw * a0;
    if (polynomial)
      E.col(i) = dA;
    else
      for (int j = 0; j <= p; ++j) E.col(i + j) += dA * W[j] - A.col(j) * dw;
  }
  const int n = p + int(E.cols()) - 1;  // degree of the product
  PlaneCoefficients foot = PlaneCoefficients::Zero(3, n + 1);
  for (int i = 0; i <= p; ++i)
    for (int j = 0; j < E.cols(); ++j) {
      foot(0, i + j) += A.col(i).dot(E.col(j));
      foot.col(i + j).tail<2>() += W[i] * E.col(j);
    }
  const double* b = binomials(n);
  for (int k = 0; k <= n; ++k) foot.col(k) /= b[k];
  return foot;
}

// How far the control points, and with them the curve, are from the chord of their ends.
double reach(const PlaneCoefficients& homogeneous) {
  const Points<2> P = homogeneous.topRows<2>().array().rowwise() / homogeneous.row(2).array();
  const Vec<2> start = P.col(0), step = P.rightCols<1>() - start;
  double largest = 0;
  for (int i = 1; i + 1 < P.cols(); ++i) {
    const Vec<2> offset = P.col(i) - start;
    const double square = step.squaredNorm();
    const double t = square > 0 ? std::clamp(offset.dot(step) / square, 0.0, 1.0) : 0;
    largest = std::max(largest, (offset - t * step).norm());
  }
  return largest;
}

struct Builder {
  const PreparedNurbs<1, 2>& part;
  FootCells& result;
  std::vector<std::array<double, 6>> chords;

  void add(int piece, double a, double b, const PlaneCoefficients& homogeneous, const PlaneCoefficients& foot,
           int halvings) {
    const double size = part.box.diagonal(), distance = reach(homogeneous);
    if (distance > largest_reach * size && halvings < max_halvings) {
      PlaneCoefficients halves[2][2];
      for (int which = 0; which < 2; ++which) {
        const PlaneCoefficients& c = which ? foot : homogeneous;
        halves[which][0] = halves[which][1] = c;
        halve(halves[which][0], halves[which][1]);
      }
      const double middle = 0.5 * (a + b);
      add(piece, a, middle, halves[0][0], halves[1][0], halvings + 1);
      add(piece, middle, b, halves[0][1], halves[1][1], halvings + 1);
      return;
    }
    result.cells.push_back({piece,
                            a,
                            b,
                            foot,
                            foot.row(0).cwiseAbs().maxCoeff(),
                            foot.bottomRows<2>().cwiseAbs().colwise().sum().maxCoeff(),
                            {}});
    const auto start = homogeneous.col(0), end = homogeneous.rightCols<1>();
    const Vec<2> centre = 0.5 * (part.pieces[piece].box.lower + part.pieces[piece].box.upper);
    const Vec<2> from = start.head<2>() / start[2], step = Vec<2>(end.topRows<2>() / end(2)) - from;
    const double square = step.squaredNorm();
    const double rounding = 1e-14 * (size + centre.cwiseAbs().maxCoeff());
    chords.push_back({from[0] + centre[0], from[1] + centre[1], step[0], step[1],
                      square > 0 ? 1 / square : 0, distance + rounding});
  }

  // de Casteljau at the middle; both hold the coefficients.
  static void halve(PlaneCoefficients& left, PlaneCoefficients& right) {
    const int n = int(right.cols());
    for (int j = 0; j < n; ++j) {
      left.col(j) = right.col(0);
      for (int i = 0; i + 1 < n - j; ++i)
        right.col(i) = (0.5 * (right.col(i) + right.col(i + 1))).eval();
    }
  }
};

void make_forms(FootCells& feet) {
  constexpr int max_degree = 15;
  // The whole block first: pointers into it stay.
  size_t size = 0;
  const auto n_lanes = [](const FootCell& cell) { return int(cell.foot.cols() + 3) / 4 * 4; };
  for (const auto& cell : feet.cells) size += 6 * n_lanes(cell) / 4 + 1;
  feet.form_storage.assign(size, {});
  double* next = feet.form_storage[0].value;
  for (auto& cell : feet.cells) {
    const int degree = int(cell.foot.cols()) - 1, lanes = n_lanes(cell);
    if (degree > max_degree) continue;
    const PlaneCoefficients power = cell.foot * powers_of_bernstein(degree).transpose();
    for (int row = 0; row < 3; ++row)
      for (int i = 0; i <= degree; ++i) {
        next[row * lanes + i] = cell.foot(row, i);
        next[(3 + row) * lanes + i] = power(row, i);
      }
    cell.form = {next, degree, lanes};
    next += 6 * lanes;
  }
}

}  // namespace

std::shared_ptr<const FootCells> make_foot_cells(const PreparedNurbs<1, 2>& part) {
  auto result = std::make_shared<FootCells>();
  Builder builder{part, *result, {}};
  for (int k = 0; k < int(part.pieces.size()); ++k) {
    const auto& piece = part.pieces[k];
    const Vec<2> centre = 0.5 * (piece.box.lower + piece.box.upper);
    PlaneCoefficients homogeneous(3, piece.weights.size());
    homogeneous << (piece.points.colwise() - centre) * piece.weights.asDiagonal(),
        piece.weights.transpose();
    builder.add(k, 0, 1, homogeneous, foot_polynomial(piece), 0);
  }
  const auto& chords = builder.chords;
  const int n = (int(chords.size()) + 3) / 4 * 4;
  result->chord_storage.resize(6 * n / 4);
  double* const data = result->chord_storage[0].value;
  for (int k = 0; k < n; ++k)
    for (int row = 0; row < 6; ++row)
      data[row * n + k] = chords[std::min<size_t>(k, chords.size() - 1)][row];
  result->chords = {data, data + n, data + 2 * n, data + 3 * n, data + 4 * n, data + 5 * n, n};
  make_forms(*result);
  return result;
}

}  // namespace sem::detail
