// Trimmed parts in scenes: the same body as without trims, control points that follow, files.
#include "bodies.h"
#include "errors.h"
#include "sem/scene/analysis.h"
#include "sem/scene/monitor.h"
#include "sem/scene/read_scene.h"
#include "trimmed.h"

using namespace sem;

namespace {

// A cantilever [0, 1]^3, clamped at x = 0, under its weight. The planes z = 0 and z = 1 are faces
// of the box or, trimmed to it, larger ones of a degree with some knot spans.
Scene<3> hung_box(Formulation formulation, bool trimmed, int degree, int n_spans) {
  Scene<3> scene = test::box_scene<3>(MaterialModel::linear);
  for (auto& part : scene.solids[0].parts) {
    const double z = part.shape.control_points(2, 0);
    const bool flat = (part.shape.control_points.row(2).array() == z).all();
    if (!trimmed || !flat) continue;
    auto plane = test::rectangle({-1.5, -1}, {2, 3}, z);
    for (const int axis : {0, 1}) {
      if (degree > 1) plane = elevate_degree(plane, axis, degree - 1);
      const Interval u = domain(plane, axis);
      for (int k = 1; k < n_spans; ++k)
        plane = insert_knot(plane, axis, u.lower + (u.upper - u.lower) * k / n_spans);
    }
    part.shape = plane;
    part.trims = {test::polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}})};
  }
  auto& method = scene.method;
  method.formulation = formulation;
  method.projection.degree = 2;
  method.sampling.points_per_span = 5;
  method.weights.cutoff = 0.8;
  if (formulation == Formulation::condensed) {
    method.weights.variant = DistanceWeight::sided;
    method.interior_rule.rule = InteriorRule::resolved;
    method.interior_rule.weight_tolerance = 5e-2;
  }
  scene.gravity = {0, 0, -1};
  Pin<3> pin;
  pin.where.part = "part.1";
  pin.axes.fill(true);
  scene.pins.push_back(pin);
  scene.probes.push_back({"tip", ProbeKind::displacement, {0.9, 0.4, 0.6}});
  scene.analysis.kind = AnalysisKind::statics;
  return scene;
}

struct Answer {
  Vec<3> tip;
  int n_unknowns, n_followers;
  double affine_error;  // of all control points under an affine motion
};

Answer solve(const Scene<3>& scene) {
  const auto model = build_model(scene, "");
  const auto& d = model->discretization;
  State state = model->initial;
  REQUIRE(equilibrium(model->system, scene.analysis, model->target, state).status ==
          Status::converged);
  const auto values = Monitor<3>(scene, *model).probes(state, {});
  Mat<3> A;
  A << 1.1, 0.2, -0.1, 0, 0.9, 0.3, 0.2, -0.1, 1.2;
  const Vec<3> b(0.3, -0.2, 0.5);
  const Points<3> moved = control_points(d.unknowns, affine_field<3>(d.unknowns, A, b));
  const Points<3> exact = (A * rest_controls(d.boundary)).colwise() + b;
  return {{values[0], values[1], values[2]},
          model->n_unknowns(),
          int(d.followers.control.size()),
          (moved - exact).cwiseAbs().maxCoeff()};
}

}  // namespace

TEST_CASE("a box with faces trimmed out of larger planes bends as the box") {
  for (const auto formulation : {Formulation::projected, Formulation::condensed}) {
    const bool condensed = formulation == Formulation::condensed;
    CAPTURE(condensed);
    const Answer plain = solve(hung_box(formulation, false, 1, 1)),
                 cut = solve(hung_box(formulation, true, 1, 1));
    CHECK(plain.tip.norm() > 1e-3);
    CHECK(cut.n_followers == 0);
    if (condensed) CHECK(cut.n_unknowns == plain.n_unknowns);
    // Projected: the clamped face also holds those control points of its neighbours that coincide
    // with its own; larger planes have none.
    CHECK((cut.tip - plain.tip).norm() < (condensed ? 1e-8 : 0.2) * plain.tip.norm());
  }
}

TEST_CASE("control points that trims leave without support follow, and no system is singular") {
  for (const auto formulation : {Formulation::projected, Formulation::condensed})
    for (const int n_spans : {1, 5}) {
      const bool condensed = formulation == Formulation::condensed;
      CAPTURE(condensed);
      CAPTURE(n_spans);
      const Answer plain = solve(hung_box(formulation, false, 1, 1)),
                   cut = solve(hung_box(formulation, true, 3, n_spans));
      if (n_spans > 1) CHECK(cut.n_followers > 2 * 20);
      CHECK(cut.affine_error < 1e-9);
      // Condensed: the control points are an output, only the points on the boundary differ, and the interior rule's
      // cells, which follow the parts' edges.
      // Projected: richer parts follow the map better.
      CHECK((cut.tip - plain.tip).norm() < (condensed ? 1e-3 : 0.3) * plain.tip.norm());
    }
}

TEST_CASE("pins of trimmed parts hold what follows, and what is trimmed away holds nothing") {
  for (const auto formulation : {Formulation::projected, Formulation::condensed}) {
    Scene<3> scene = hung_box(formulation, true, 2, 5);
    scene.pins[0].where.part = "part.5";  // the bottom, trimmed
    const Answer held = solve(scene);
    Scene<3> plain = hung_box(formulation, false, 1, 1);
    plain.pins[0].where.part = "part.5";
    const double exact = solve(plain).tip.norm();
    CHECK(held.tip.norm() == doctest::Approx(exact).epsilon(0.1));
    scene.pins[0].where.box = Box<3>{Vec<3>(-2, -2, -1), Vec<3>(-1, -0.9, 0)};
    CHECK(test::error_of([&] {
            build_model(scene, "a.json");
          }).find("a.json: pins[0]: found only control points that are trimmed away") == 0);
  }
}

TEST_CASE("trims are read and written, and bad ones named") {
  const Scene<3> scene = hung_box(Formulation::projected, true, 2, 2);
  const std::string text = write_scene(scene);
  const Scene<3> again = read_scene<3>(text, "a.json", {});
  CHECK(write_scene(again) == text);
  const auto& trims = again.solids[0].parts[4].trims;
  REQUIRE(trims.size() == 1);
  REQUIRE(trims[0].size() == 4);
  CHECK(trims[0][1].control_points == scene.solids[0].parts[4].trims[0][1].control_points);
  CHECK(again.solids[0].parts[0].trims.empty());
  CHECK(document_scene<3>({}).find("trims: a list of objects") != std::string::npos);
  CHECK(document_scene<2>({}).find("trims") == std::string::npos);
  const auto error = [&](const std::string& change) {
    return test::error_of([&] { read_scene<3>(text, "a.json", {}, {change}); });
  };
  const std::string part = "solids[0].parts[4].trims";
  test::check_names(error(part + "[0].curves[1].control_points=[[1,0],[1,5]]"), "a.json",
                    {part + "[0].curves[1]", "domain"});
  test::check_names(error(part + "[0].curves[1].control_points=[[1,0],[1,0.5]]"), "a.json",
                    {part + "[0]", "gap of 0.5"});
  test::check_names(error(part + "[0].curves[1].degree=0"), "a.json",
                    {part + "[0].curves[1].degree"});
  test::check_names(error(part + "[0].curves=[]"), "a.json", {part + "[0].curves", "no curve"});
  test::check_names(error(part + "=[[1]]"), "a.json", {part + "[0]", "an object"});
}
