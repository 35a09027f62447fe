#include "sem/method/coefficients.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sem/base/error.h"
#include "sem/method/least_squares.h"

namespace sem {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A centre and a length per part: mean and root mean square distance of X under w_i.
template <int Dim>
struct Frames {
  Points<Dim> center;
  VectorXd length;
};

template <int Dim>
Frames<Dim> weight_frames(const Points<Dim>& position, const VectorXd& volume,
                          const BlendingWeights<Dim>& weights) {
  Frames<Dim> frames{Points<Dim>::Zero(Dim, weights.n_parts), VectorXd::Ones(weights.n_parts)};
  VectorXd total = VectorXd::Zero(weights.n_parts), second = total;
  const auto for_each = [&](const auto& add) {
    for (int k = 0; k < weights.n_points(); ++k)
      for (int e = weights.begin[k]; e < weights.begin[k + 1]; ++e)
        add(weights.part[e], volume[k] * weights.w[e], Vec<Dim>(position.col(k)));
  };
  for_each([&](int i, double v, const Vec<Dim>& X) {
    total[i] += v;
    frames.center.col(i) += v * X;
  });
  for (int i = 0; i < weights.n_parts; ++i)
    if (total[i] > 0) frames.center.col(i) /= total[i];
  for_each([&](int i, double v, const Vec<Dim>& X) {
    second[i] += v * (X - frames.center.col(i)).squaredNorm();
  });
  for (int i = 0; i < weights.n_parts; ++i)
    if (second[i] > 0) frames.length[i] = std::sqrt(second[i] / total[i]);
  return frames;
}

// Appends the kept ones among a part's own functions 1, m_1, m_2, ... as columns of their own;
// `column_of[f]` is the column of its f-th function, -1: left out.
void add_own_functions(PartFit& fit, int n_monomials, const std::vector<int>& column_of) {
  int c = int(fit.columns.size());
  for (const int column : column_of)
    if (column >= 0) fit.columns.push_back(column);
  fit.coefficients = MatrixXd::Zero(n_monomials, fit.columns.size());
  fit.translation = Eigen::RowVectorXd::Zero(fit.columns.size());
  for (int f = 0; f < int(column_of.size()); ++f) {
    if (column_of[f] < 0) continue;
    (f == 0 ? fit.translation[c] : fit.coefficients(f - 1, c)) = 1;
    ++c;
  }
}

// Every part has its own origin: the centre of its weight.
template <int Dim>
Origins<Dim> own_origins(const Frames<Dim>& frames) {
  Origins<Dim> origins;
  origins.position = frames.center;
  for (int i = 0; i < frames.length.size(); ++i) {
    origins.members.push_back({i});
    origins.of_part.push_back(i);
  }
  return origins;
}

// The columns of part i: the affine field (Dim + 1 of them), then the kept ones among its own
// functions.
template <int Dim>
PartFit fit_of_columns(const Monomials<Dim>& monomials, const Vec<Dim>& center, double length,
                       const Vec<Dim>& middle, double size, const std::vector<int>& column_of) {
  PartFit fit;
  fit.scale = length;
  for (int a = 0; a <= Dim; ++a) fit.columns.push_back(a);
  add_own_functions(fit, monomials.size(), column_of);
  // Column 0: the field 1. Column 1 + a: (X_a - middle_a) / size in the part's own monomials.
  fit.translation[0] = 1;
  for (int m = monomials.first(1); m < monomials.first(2); ++m)
    for (int a = 0; a < Dim; ++a)
      if (monomials.exponent(m)[a] == 1) fit.coefficients(m, 1 + a) = length / size;
  for (int a = 0; a < Dim; ++a) fit.translation[1 + a] = (center[a] - middle[a]) / size;
  return fit;
}

// Sum of grad . grad + value value / size^2 over the points.
template <int Dim>
MatrixXd gradient_gram_matrix(const Map<Dim>& map, const VectorXd& volume, double size) {
  MatrixXd G = MatrixXd::Zero(map.n_columns, map.n_columns);
  for (const auto& block : map.blocks) {
    const VectorXd v = volume(block.points);
    MatrixXd sum = gram_matrix(block.value, v / (size * size));
    for (const MatrixXd& gradient : block.gradient)
      if (gradient.size() > 0) sum += gram_matrix(gradient, v);
    G(block.columns, block.columns) += sum;
  }
  return G;
}

// Of functions by their Gram matrix, scaled to a unit diagonal.
std::vector<int> independent_functions(const MatrixXd& G, int n_first, double tolerance) {
  const VectorXd scale = G.diagonal().unaryExpr([](double g) { return g > 0 ? 1 / std::sqrt(g) : 0.0; });
  return independent_rows(scale.asDiagonal() * G * scale.asDiagonal(), n_first, tolerance);
}

}  // namespace

template <int Dim>
FreeCoefficients<Dim> free_coefficients(const Points<Dim>& position, const VectorXd& volume,
                                        const BlendingWeights<Dim>& weights, const std::vector<int>& degree,
                                        double tolerance) {
  const auto [lowest, highest] = std::minmax_element(degree.begin(), degree.end());
  if (*lowest < 1 || *highest > 6)
    throw InputError("", "method.degree", std::to_string(*lowest < 1 ? *lowest : *highest), "1 to 4");
  FreeCoefficients<Dim> free;
  const auto& monomials = free.projection.monomials = Monomials<Dim>(*highest);
  const int n_parts = weights.n_parts, n_functions = monomials.size() + 1;
  const Frames<Dim> frames = weight_frames(position, volume, weights);
  free.origins = own_origins(frames);
  const Vec<Dim> lower = position.rowwise().minCoeff(), upper = position.rowwise().maxCoeff();
  const Vec<Dim> middle = (lower + upper) / 2;
  const double size = (upper - lower).norm();
  std::vector<int> column_of(n_parts * n_functions, -1);
  int n_candidates = Dim + 1;
  for (int i = 0; i < n_parts; ++i)
    for (int f = 0; f <= monomials.first(degree[i] + 1); ++f) column_of[i * n_functions + f] = n_candidates++;
  const auto set_columns = [&] {
    free.projection.parts.clear();
    for (int i = 0; i < n_parts; ++i)
      free.projection.parts.push_back(fit_of_columns<Dim>(
          monomials, frames.center.col(i), frames.length[i], middle, size,
          {column_of.begin() + i * n_functions, column_of.begin() + (i + 1) * n_functions}));
  };
  set_columns();
  MatrixXd G = gradient_gram_matrix(
      blended_map(position, weights, free.origins, free.projection, n_candidates, true),
      volume, size);
  std::vector<int> chosen = independent_functions(G, Dim + 1, tolerance);
  if (int(chosen.size()) <= Dim)  // not even 1 and X: only where something is not a number
    throw InputError("", "method.weights", "weights or gradients of weights that are not finite", "finite ones: a shape whose patches are less degenerate there");
  std::sort(chosen.begin(), chosen.end());
  std::vector<int> number(n_candidates, -1);
  for (int c = 0; c < int(chosen.size()); ++c) number[chosen[c]] = c;
  for (int& column : column_of)
    if (column >= 0) column = number[column];
  set_columns();

  const int n = int(chosen.size());
  free.unknowns.one = VectorXd::Unit(n, 0);
  free.unknowns.rest = Points<Dim>::Zero(Dim, n);
  free.unknowns.rest.col(0) = middle;
  for (int a = 0; a < Dim; ++a) free.unknowns.rest(a, 1 + a) = size;
  return free;
}

template <int Dim>
BlendedField<Dim> blended_field(const Points<Dim>& position, const VectorXd& volume,
                                const BlendingWeights<Dim>& weights, int degree, double tolerance) {
  BlendedField<Dim> field;
  // Monomials begin at degree 1; of degree 0 only the constants are kept.
  field.projection.monomials = Monomials<Dim>(std::max(degree, 1));
  const int n_own = degree == 0 ? 1 : field.projection.monomials.size() + 1;
  const Frames<Dim> frames = weight_frames(position, volume, weights);
  field.origins = own_origins(frames);
  std::vector<int> column_of(weights.n_parts * n_own);
  std::iota(column_of.begin(), column_of.end(), 0);
  const auto set_columns = [&] {
    field.projection.parts.clear();
    for (int i = 0; i < weights.n_parts; ++i) {
      PartFit fit;
      fit.scale = frames.length[i];
      add_own_functions(fit, field.projection.monomials.size(),
                        {column_of.begin() + i * n_own, column_of.begin() + (i + 1) * n_own});
      field.projection.parts.push_back(std::move(fit));
    }
  };
  set_columns();
  MatrixXd G = gradient_gram_matrix(blended_map(position, weights, field.origins, field.projection, int(column_of.size()), false),
                           volume, 1);
  std::vector<int> chosen = independent_functions(G, 0, tolerance);
  std::sort(chosen.begin(), chosen.end());
  std::fill(column_of.begin(), column_of.end(), -1);
  for (int c = 0; c < int(chosen.size()); ++c) column_of[chosen[c]] = c;
  set_columns();
  field.n_functions = int(chosen.size());
  return field;
}

template <int Dim>
MatrixXd boundary_output(const Samples<Dim>& samples, const Map<Dim>& on_boundary, int n_controls) {
  const MatrixXd gamma = dense_value(on_boundary);
  const MatrixXd J = sample_jacobian(samples, n_controls);
  MatrixXd S = MatrixXd::Zero(n_controls, on_boundary.n_columns);
  for (size_t i = 0; i + 1 < samples.first.size(); ++i) {
    const int first = samples.first[i], n = samples.first[i + 1] - first;
    std::vector<int> controls(samples.column.begin() + samples.row[first],
                              samples.column.begin() + samples.row[first + n]);
    std::sort(controls.begin(), controls.end());
    controls.erase(std::unique(controls.begin(), controls.end()), controls.end());
    const VectorXd root = samples.weight.segment(first, n).cwiseSqrt();
    const MatrixXd weighted = root.asDiagonal() * J(Eigen::seqN(first, n), controls);
    const MatrixXd image = root.asDiagonal() * gamma.middleRows(first, n);
    const MatrixXd fitted = least_squares(weighted, image);
    S(controls, Eigen::all) = fitted;
  }
  return S;
}

#define SEM_INSTANTIATE(Dim)                                                                       \
  template FreeCoefficients<Dim> free_coefficients<Dim>(const Points<Dim>&, const VectorXd&, const BlendingWeights<Dim>&, \
                                                        const std::vector<int>&, double); \
  template BlendedField<Dim> blended_field<Dim>(const Points<Dim>&, const VectorXd&,               \
                                                const BlendingWeights<Dim>&, int, double);         \
  template MatrixXd boundary_output<Dim>(const Samples<Dim>&, const Map<Dim>&, int);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
