// A user of the library without scenes: a curve, a square hung by its left side.
#include <cstdio>

#include "sem/base/version.h"
#include "sem/mechanics/internal_energy.h"
#include "sem/mechanics/loads.h"
#include "sem/mechanics/quadratic_forms.h"
#include "sem/method/discretization.h"
#include "sem/nurbs/basis.h"
#include "sem/nurbs/bezier_curve.h"
#include "sem/solve/statics.h"

using namespace sem;

namespace {

std::vector<Nurbs<1, 2>> unit_square() {
  Points<2> corners(2, 5);
  corners << 0, 1, 1, 0, 0,  //
      0, 0, 1, 1, 0;
  std::vector<Nurbs<1, 2>> sides;
  for (int s = 0; s < 4; ++s) {
    Points<2> points(2, 3);
    points << corners.col(s), (corners.col(s) + corners.col(s + 1)) / 2, corners.col(s + 1);
    sides.push_back(bezier_curve<2>(points, Eigen::VectorXd::Ones(points.cols())));
  }
  return sides;
}

void print(const char* name, double value) { std::printf("%s %.9g\n", name, value); }

}  // namespace

int main() {
  std::printf("version %s, alignment %d %d %d\n", version, EIGEN_DEFAULT_ALIGN_BYTES,
              int(alignof(Eigen::Vector4d)), int(alignof(StressDerivative<2>)));

  Points<2> corner(2, 3);
  corner << 1, 1, 0,  //
      0, 1, 1;
  Nurbs<1, 2> arc = bezier_curve<2>(corner, Eigen::VectorXd::Ones(corner.cols()));  // a quarter of the unit circle
  arc.weights[1] = std::sqrt(0.5);
  const Vec<2> X = point(arc, Param<1>(0.3));
  print("arc.x", X[0]);
  print("arc.radius", X.norm());

  MethodOptions options;
  options.origins = OriginChoice::one;
  options.rays.n_rays = 10;
  const Discretization<2> body = discretize<2>({unit_square()}, options);
  print("area", body.quadrature.weight.sum());

  const Material material{MaterialModel::neo_log, 1e5, 0.3, 1000};
  const MaterialField field{{material}, std::vector<int>(body.quadrature.size(), 0)};
  const Eigen::MatrixXd stability = stability_matrix(body.on_boundary, body.samples, body.unknowns);
  InternalEnergy<2> energy(body.interior, body.quadrature.weight, field, 1e5 * stability);
  const Eigen::VectorXd mass = material.density * body.quadrature.weight;
  const Points<2> rest = rest_controls(body.boundary);
  System system;
  system.potential = &energy;
  system.mass = expand(mass_matrix(body.interior, mass), 2);
  system.rest = Eigen::Map<const Eigen::VectorXd>(rest.data(), rest.size());
  system.load = Eigen::VectorXd::Zero(system.size());
  add_body_force<2>(body.interior, mass, {0, -1}, system.load);
  for (int entry = 0; entry < system.size(); ++entry)
    if (rest(0, entry / 2) > 0) system.free.push_back(entry);

  State state{system.rest, Eigen::VectorXd::Zero(system.size())};
  const StaticReport report = solve_static(system, state);
  std::printf("status %s\n", name(report.status));
  const Eigen::VectorXd force = reaction(system, state.z);
  double upward = 0;
  for (int entry = 1; entry < system.size(); entry += 2) upward += force[entry];
  print("weight carried by the pins", upward);
  print("lowest", Eigen::Map<const Points<2>>(state.z.data(), 2, rest.cols()).row(1).minCoeff());
  print("energy", energy.energy(state.z));
  return report.status == Status::converged ? 0 : 1;
}
