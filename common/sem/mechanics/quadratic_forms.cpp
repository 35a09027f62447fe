#include "sem/mechanics/quadratic_forms.h"

#include <algorithm>
#include <set>

#include "sem/method/least_squares.h"

namespace sem {

using Eigen::MatrixXd;
using Eigen::VectorXd;

template <int Dim>
SymmetricMatrix mass_matrix(const Map<Dim>& interior, const VectorXd& point_mass,
                            const std::shared_ptr<const Elimination>& plan) {
  SymmetricMatrix M(plan, 1);
  Assembly<Dim> assembly(interior, plan, 1);
  for (size_t b = 0; b < interior.blocks.size(); ++b) {
    const auto& block = interior.blocks[b];
    const MatrixXd value = block.value(Eigen::all, assembly.order(int(b)));
    const VectorXd mass = point_mass(block.points);
    assembly.add(int(b), gram_matrix(value, mass), M);
  }
  assembly.finish(M);
  return M;
}

template <int Dim>
MatrixXd mass_matrix(const Map<Dim>& interior, const VectorXd& point_mass) {
  return mass_matrix(interior, point_mass, dense_elimination(interior.n_columns)).dense();
}

template <int Dim>
Map<Dim> mismatch_map(const Map<Dim>& on_boundary, const Samples<Dim>& samples, const Unknowns<Dim>& unknowns) {
  Map<Dim> mismatch = on_boundary;
  if (unknowns.S.size() > 0) {
    MapBlock<Dim> all;
    for (int s = 0; s < samples.size(); ++s) all.points.push_back(s);
    for (int c = 0; c < on_boundary.n_columns; ++c) all.columns.push_back(c);
    all.value = dense_value(on_boundary) - sample_jacobian(samples, unknowns.n_controls()) * unknowns.S;
    mismatch.shared.clear();
    mismatch.blocks = {all};
    return mismatch;
  }
  // S = I: a sample also depends on the control points of its own part.
  for (auto& block : mismatch.blocks) {
    std::set<int> columns(block.columns.begin(), block.columns.end());
    for (const int s : block.points)
      columns.insert(samples.column.begin() + samples.row[s], samples.column.begin() + samples.row[s + 1]);
    const std::vector<int> all(columns.begin(), columns.end());
    const auto at = [&](int column) { return std::lower_bound(all.begin(), all.end(), column) - all.begin(); };
    MatrixXd D = MatrixXd::Zero(block.points.size(), all.size());
    for (size_t c = 0; c < block.columns.size(); ++c) D.col(at(block.columns[c])) = block.value.col(c);
    for (size_t k = 0; k < block.points.size(); ++k) {
      const int s = block.points[k];
      for (int e = samples.row[s]; e < samples.row[s + 1]; ++e) D(k, at(samples.column[e])) -= samples.value[e];
    }
    block.columns = all;
    block.value = std::move(D);
  }
  return mismatch;
}

template <int Dim>
MatrixXd stability_matrix(const Map<Dim>& on_boundary, const Samples<Dim>& samples, const Unknowns<Dim>& unknowns) {
  return mass_matrix(mismatch_map(on_boundary, samples, unknowns), samples.weight);
}

MatrixXd expand(const MatrixXd& scalar, int dim) {
  MatrixXd full = MatrixXd::Zero(dim * scalar.rows(), dim * scalar.cols());
  for (int j = 0; j < scalar.cols(); ++j)
    for (int i = 0; i < scalar.rows(); ++i)
      for (int a = 0; a < dim; ++a) full(dim * i + a, dim * j + a) = scalar(i, j);
  return full;
}

#define SEM_INSTANTIATE(Dim)                                                                                \
  template SymmetricMatrix mass_matrix<Dim>(const Map<Dim>&, const VectorXd&,                               \
                                            const std::shared_ptr<const Elimination>&);                     \
  template MatrixXd mass_matrix<Dim>(const Map<Dim>&, const VectorXd&);                                     \
  template Map<Dim> mismatch_map<Dim>(const Map<Dim>&, const Samples<Dim>&, const Unknowns<Dim>&);          \
  template MatrixXd stability_matrix<Dim>(const Map<Dim>&, const Samples<Dim>&, const Unknowns<Dim>&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
