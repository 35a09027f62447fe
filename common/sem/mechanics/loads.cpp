#include "sem/mechanics/loads.h"


namespace sem {
namespace {

// f += sum_k forces.col(k) (x) Gamma_k.
template <int Dim>
void add_forces(const Map<Dim>& map, const Points<Dim>& forces, Eigen::VectorXd& f) {
  const Points<Dim> sum = evaluate_transposed(map, forces);
  for (int j = 0; j < map.n_columns; ++j) f.template segment<Dim>(Dim * j) += sum.col(j);
}

}  // namespace

template <int Dim>
void add_body_force(const Map<Dim>& interior, const Eigen::VectorXd& magnitude,
                    const Vec<Dim>& direction, Eigen::VectorXd& f) {
  add_forces<Dim>(interior, direction * magnitude.transpose(), f);
}

template <int Dim>
void add_point_force(const Discretization<Dim>& d, const Vec<Dim>& at, const Vec<Dim>& force,
                     Eigen::VectorXd& f) {
  add_forces<Dim>(map_at<Dim>(d, at, false), force, f);
}

template <int Dim>
double add_traction(const Discretization<Dim>& d, const Traction<Dim>& traction, Eigen::VectorXd& f) {
  const BoundaryRule<Dim> rule = boundary_rule(d);
  const Samples<Dim>& samples = rule.samples;
  double loaded = 0;
  Points<Dim> forces(Dim, samples.size());
  for (int s = 0; s < samples.size(); ++s) {
    const int part = samples.part[s];
    const Vec<Dim> t = traction(part, samples.position.col(s), rule.normal.col(s));
    forces.col(s) = samples.weight[s] * t;
    if (!t.isZero(0)) loaded += samples.weight[s];
  }
  add_forces(map_at(d, samples.position, false), forces, f);
  return loaded;
}

#define SEM_INSTANTIATE(Dim)                                                                     \
  template void add_body_force<Dim>(const Map<Dim>&, const Eigen::VectorXd&, const Vec<Dim>&,    \
                                    Eigen::VectorXd&);                                           \
  template void add_point_force<Dim>(const Discretization<Dim>&, const Vec<Dim>&,                \
                                     const Vec<Dim>&, Eigen::VectorXd&);                         \
  template double add_traction<Dim>(const Discretization<Dim>&, const Traction<Dim>&,            \
                                    Eigen::VectorXd&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
