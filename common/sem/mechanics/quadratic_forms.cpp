#include "sem/mechanics/quadratic_forms.h"

#include "sem/method/least_squares.h"

namespace sem {

template <int Dim>
Eigen::MatrixXd mass_matrix(const Map<Dim>& interior, const Eigen::VectorXd& point_mass) {
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(interior.n_columns, interior.n_columns);
  for (const auto& block : interior.blocks) {
    const Eigen::VectorXd mass = point_mass(block.points);
    M(block.columns, block.columns) += gram_matrix(block.value, mass);
  }
  return M;
}

template <int Dim>
Eigen::MatrixXd stability_matrix(const Map<Dim>& on_boundary, const Samples<Dim>& samples,
                                 const Unknowns<Dim>& unknowns) {
  if (unknowns.S.size() > 0) {
    const Eigen::MatrixXd D = dense_value(on_boundary) -
                              sample_jacobian(samples, unknowns.n_controls()) * unknowns.S;
    return gram_matrix(D, samples.weight);
  }
  // S = I: a sample depends on the control points of its own part, which are among the block's columns.
  Eigen::MatrixXd form = Eigen::MatrixXd::Zero(on_boundary.n_columns, on_boundary.n_columns);
  std::vector<int> local(on_boundary.n_columns);
  for (const auto& block : on_boundary.blocks) {
    for (size_t c = 0; c < block.columns.size(); ++c) local[block.columns[c]] = int(c);
    Eigen::MatrixXd D = block.value;
    for (size_t k = 0; k < block.points.size(); ++k) {
      const int s = block.points[k];
      for (int e = samples.row[s]; e < samples.row[s + 1]; ++e)
        D(k, local[samples.column[e]]) -= samples.value[e];
    }
    const Eigen::VectorXd weight = samples.weight(block.points);
    form(block.columns, block.columns) += gram_matrix(D, weight);
  }
  return form;
}

Eigen::MatrixXd expand(const Eigen::MatrixXd& scalar, int dim) {
  Eigen::MatrixXd full = Eigen::MatrixXd::Zero(dim * scalar.rows(), dim * scalar.cols());
  for (int j = 0; j < scalar.cols(); ++j)
    for (int i = 0; i < scalar.rows(); ++i)
      for (int a = 0; a < dim; ++a) full(dim * i + a, dim * j + a) = scalar(i, j);
  return full;
}

template Eigen::MatrixXd mass_matrix<2>(const Map<2>&, const Eigen::VectorXd&);
template Eigen::MatrixXd mass_matrix<3>(const Map<3>&, const Eigen::VectorXd&);
template Eigen::MatrixXd stability_matrix<2>(const Map<2>&, const Samples<2>&, const Unknowns<2>&);
template Eigen::MatrixXd stability_matrix<3>(const Map<3>&, const Samples<3>&, const Unknowns<3>&);

}  // namespace sem
