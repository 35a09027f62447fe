// Frames of runs in space.
#include <doctest/doctest.h>

#include "sem/draw/raster.h"
#include "sem/picture/scales.h"
#include "sem/scene/builtin.h"
#include "sem/scene/read_scene.h"
#include "sem/solve/integrators.h"
#include "src3d/picture/frame.h"
#include "src3d/picture/surface_stress.h"
#include "src3d/shapes/shape_fields.h"

using namespace sem;

namespace {

Scene<3> beam(const std::vector<std::string>& overrides = {}) {
  for (const auto& scene : builtin_scenes<3>())
    if (scene.name == "beam")
      return read_scene<3>(scene.text, "beam", shapes3d::describe_shape, overrides);
  return {};
}

const std::vector<std::string> coarse = {"method.quadrature.rays=3", "method.quadrature.points=9",
                                         "output.width=320", "output.height=240"};

Image frame(SolidPainter& painter, const Model<3>& model, const State& state) {
  RasterCanvas canvas(320, 240, 1);
  painter.draw(canvas, model, state);
  return canvas.finish();
}

}  // namespace

TEST_CASE("3D frames: the same state gives the same pixels, whatever was drawn before") {
  const auto scene = beam(coarse);
  const auto model = build_model(scene, "beam");
  State bent = model->initial;
  for (Eigen::Index k = 0; k < bent.z.size(); k += 3) {
    bent.z[k + 2] -= 0.05 * bent.z[k] * bent.z[k];
  }
  bent.time = 0.5;
  SolidPainter first(scene), second(scene);
  const Image at_rest = frame(first, *model, model->initial), later = frame(first, *model, bent);
  CHECK(later.rgb == frame(second, *model, bent).rgb);
  CHECK(later.rgb != at_rest.rgb);
  CHECK(at_rest.rgb == frame(first, *model, model->initial).rgb);
  const Image framed = make_solid_painter(scene)(*model, bent);
  CHECK(framed.width == 320);
  CHECK(framed.height == 240);
}

TEST_CASE("3D frames have room for a beam that falls as far as it is long, not for more") {
  const auto scene = beam(coarse);
  const auto model = build_model(scene, "beam");
  const Box<3> box = motion_box(scene, *model);
  CHECK(box.lower[2] < -4.595);  // the true lowest point of the statics
  CHECK(box.lower[2] > -7);
  CHECK(box.upper[2] < 2);
  CHECK(expected_stress(*model) > 1e4);
}

TEST_CASE("the box visited: under small loads that come and go it is that of the run itself") {
  auto overrides = coarse;
  overrides.insert(overrides.end(),
                   {"gravity=[0,0,-0.01]", "analysis.time_step=0.02", "analysis.duration=2",
                    R"(loads=[{"type":"body","force":[0,8,0],"amplitude":3,"period":0.7}])"});
  const auto scene = beam(overrides);
  const auto model = build_model(scene, "beam");
  const Box<3> expected = visited_box(scene, *model), rest = model->discretization.boundary.box;
  Box<3> box = rest;
  State state = model->initial;
  const auto set_load = model->set_load();
  TimeStepper stepper(model->system, 0.02, Integrator::linearly_implicit_euler);
  for (int step = 1; step <= 100; ++step) {
    set_load(0.02 * step);
    REQUIRE(stepper.step(state).status == Status::converged);
    const Points<3> p = control_points(model->discretization.unknowns, state.z);
    for (int c = 0; c < p.cols(); ++c) box.include(Vec<3>(p.col(c)));
  }
  for (const int a : {1, 2}) {
    CAPTURE(a);
    const double down = rest.lower[a] - box.lower[a], up = box.upper[a] - rest.upper[a];
    REQUIRE(std::max(down, up) > 0.005);
    CHECK(std::abs(expected.lower[a] - box.lower[a]) < 0.02 * std::max(down, up));
    CHECK(std::abs(expected.upper[a] - box.upper[a]) < 0.02 * std::max(down, up));
  }
}

TEST_CASE("von Mises stress in space: a pull along x gives its axial stress") {
  const auto scene = beam({"solids[0].material.model=linear", "method.quadrature.rays=3"});
  const auto model = build_model(scene, "beam");
  Mat<3> pull = Mat<3>::Identity();
  const auto& material = scene.solids[0].material;
  const double e = 1e-3;
  pull.diagonal() << 1 + e, 1 - material.poisson_ratio * e, 1 - material.poisson_ratio * e;
  const auto z = affine_field<3>(model->discretization.unknowns, pull, Vec<3>(1, 2, 3));
  const Eigen::VectorXd stress = von_mises(*model, z);
  CHECK((stress.array() / (material.youngs_modulus * e) - 1).abs().maxCoeff() < 1e-8);
}

TEST_CASE(
    "values near a surface: constants stay, a point keeps its own, what is unknown stays so") {
  Points<3> points(3, 27);
  Eigen::VectorXd values(27);
  for (int k = 0; k < 27; ++k) {
    points.col(k) << k % 3, k / 3 % 3, k / 9;
    values[k] = k;
  }
  Points<3> places(3, 3);
  places << 0.3, 1, 2.1, 0.2, 1, 2.2, -0.4, 1, 2.3;
  const auto constant = near_mean(places, points, Eigen::VectorXd::Constant(27, 3.5));
  CHECK((constant.array() - 3.5).abs().maxCoeff() < 1e-12);
  CHECK(near_mean(places, points, values)[1] == 13);
  values[26] = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(near_mean(places, points, values)[2]));
  CHECK(std::isfinite(near_mean(places, points, values)[1]));
}
