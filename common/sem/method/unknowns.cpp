#include "sem/method/unknowns.h"

namespace sem {

template <int Dim>
Unknowns<Dim> control_point_unknowns(const Boundary<Dim>& boundary) {
  return {rest_controls(boundary), Eigen::VectorXd::Ones(boundary.n_controls()), {}};
}

template <int Dim>
Points<Dim> control_points(const Unknowns<Dim>& unknowns, const Eigen::VectorXd& z) {
  const Eigen::Map<const Points<Dim>> vectors(z.data(), Dim, unknowns.size());
  if (unknowns.S.size() == 0) return vectors;
  return vectors * unknowns.S.transpose();
}

template <int Dim>
std::optional<int> unknown_of_control(const Unknowns<Dim>& unknowns, int control) {
  if (unknowns.S.size() == 0) return control;
  int column = 0;
  const auto row = unknowns.S.row(control);
  const bool unit = row.maxCoeff(&column) == 1 && (row.array() != 0).count() == 1;
  return unit ? std::optional(column) : std::nullopt;
}

template <int Dim>
Eigen::VectorXd affine_field(const Unknowns<Dim>& unknowns, const Mat<Dim>& A, const Vec<Dim>& b) {
  const Points<Dim> z = A * unknowns.rest + b * unknowns.one.transpose();
  return Eigen::Map<const Eigen::VectorXd>(z.data(), z.size());
}

#define SEM_INSTANTIATE(Dim)                                                                 \
  template Unknowns<Dim> control_point_unknowns<Dim>(const Boundary<Dim>&);                  \
  template Points<Dim> control_points<Dim>(const Unknowns<Dim>&, const Eigen::VectorXd&);    \
  template std::optional<int> unknown_of_control<Dim>(const Unknowns<Dim>&, int);            \
  template Eigen::VectorXd affine_field<Dim>(const Unknowns<Dim>&, const Mat<Dim>&, const Vec<Dim>&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
