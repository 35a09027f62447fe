// The manufactured solution, and what both formulations make of it, in both dimensions.
#include "bodies.h"
#include "dims.h"
#include "sem/scene/manufactured.h"

using namespace sem;

namespace {

template <int Dim>
std::vector<ScenePart<Dim>> unit_box(int m) {
  return test::box_scene<Dim>(MaterialModel::linear, m).solids[0].parts;
}

// Sided weights, a fixed Gauss rule of n points an axis.
MethodOptions condensed(int degree, int n) {
  MethodOptions method;
  method.formulation = Formulation::condensed;
  method.weights = {.variant = DistanceWeight::sided, .cutoff = 1};
  method.projection.degree = degree;
  method.rays = {.axis = 0, .n_rays = n, .grid = RayGrid::gauss};
  method.interval = {.rule = IntervalRule::gauss, .points = n};
  return method;
}

// Loaded by the exact stress.
template <int Dim>
ManufacturedSolution nearest(const std::vector<ScenePart<Dim>>& parts, const MethodOptions& method,
                             const Manufactured<Dim>& exact) {
  Scene<Dim> scene;
  scene.solids.push_back({"body", exact.material, parts});
  scene.method = method;
  const auto model = build_model(scene, "");
  return solve_manufactured(model->discretization, *model->energy,
                            manufactured_stress(model->discretization, exact), exact);
}

}  // namespace

TEST_CASE_TEMPLATE(
    "gradient and body force are the derivatives of displacement and stress: finite differences", T,
    D2, D3) {
  constexpr int Dim = T::value;
  const double h = 1e-4;
  for (const auto model : {MaterialModel::linear, MaterialModel::neo_iso})
    for (const int taylor : {0, 1, 2}) {
      const Manufactured<Dim> exact{{model, 1, 0.3, 0}, 0.4, taylor};
      const Vec<Dim> X = Vec<Dim>(0.3 * Vec<Dim>::Ones() + 0.4 * Vec<Dim>::Unit(1));
      Mat<Dim> gradient;
      Vec<Dim> divergence = Vec<Dim>::Zero();
      for (int b = 0; b < Dim; ++b) {
        const Vec<Dim> step = h * Vec<Dim>::Unit(b);
        gradient.col(b) = (exact.displacement(X + step) - exact.displacement(X - step)) / (2 * h);
        divergence += (exact.stress(X + step) - exact.stress(X - step)).col(b) / (2 * h);
      }
      CAPTURE(int(model));
      CAPTURE(taylor);
      CHECK((gradient - exact.gradient(X)).norm() < 1e-7 * gradient.norm());
      CHECK((divergence + exact.body_force(X)).norm() < 1e-7);
      CHECK((exact.body_force(X).norm() > 1e-3) == (taylor != 1));
    }
}

TEST_CASE_TEMPLATE(
    "patch tests: a degree holds its affine and quadratic fields to rounding, one less does not", T,
    D2, D3) {
  constexpr int Dim = T::value;
  const auto parts = unit_box<Dim>(1);
  Manufactured<Dim> exact;
  for (const int order : {1, 2}) {
    exact.taylor = order;
    CAPTURE(order);
    const auto held = nearest<Dim>(parts, condensed(order, 6), exact);
    CHECK(held.energy < 1e-8);
    CHECK(held.displacement < 1e-8);
  }
  CHECK(nearest<Dim>(parts, condensed(1, 6), exact).energy > 1e-2);
  // The load itself: affine by the divergence theorem.
  exact.taylor = 1;
  CHECK(solve_manufactured(parts, condensed(2, 8), exact).energy < 1e-8);
}

TEST_CASE_TEMPLATE("condensed, loaded by the exact stress: the energy error falls with the degree and as parts are split", T,
                   D2, D3) {
  constexpr int Dim = T::value;
  double before = 1;
  for (const int degree : {1, 2, 3}) {
    const auto error = nearest<Dim>(unit_box<Dim>(1), condensed(degree, 8), {});
    CAPTURE(degree);
    CAPTURE(error.energy);
    CHECK(error.energy < before / 2);
    CHECK(error.displacement < error.energy);
    before = error.energy;
  }
  const double whole = nearest<Dim>(unit_box<Dim>(1), condensed(2, 8), {}).energy;
  CHECK(nearest<Dim>(unit_box<Dim>(2), condensed(2, 8), {}).energy < 0.8 * whole);
}
