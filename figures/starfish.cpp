#include "figures/starfish.h"

#include <cmath>
#include <numbers>

#include "sem/base/error.h"
#include "sem/scene/analysis.h"
#include "src2d/shapes/shapes.h"

namespace sem::figures {
namespace {

constexpr int n_arms = 5;
constexpr double arm_angle = 2 * std::numbers::pi / n_arms;
// The arm that it hangs by points to the upper left.
constexpr double first_arm = 0.75 * std::numbers::pi;

// The control polygon of the arms, anticlockwise. The loop's first curve begins at the second
// point, the valley after the first arm.
Points<2> control_polygon() {
  struct Corner {
    double along, across;  // m, of the arm's axis
  };
  constexpr Corner arm[] = {{0.9, -0.253}, {1.42, -0.22}, {1.58, 0}, {1.42, 0.22}, {0.9, 0.253}};
  constexpr double valley = 0.55;  // m from the centre
  std::vector<Vec<2>> polygon;
  const auto add = [&](double angle, const Corner& corner) {
    const Vec<2> axis(std::cos(angle), std::sin(angle));
    polygon.push_back(corner.along * axis + corner.across * Vec<2>(-axis[1], axis[0]));
  };
  for (int k = 0; k < n_arms; ++k) {
    const double angle = first_arm + k * arm_angle;
    add(angle, arm[4]);
    add(angle + arm_angle / 2, {valley, 0});
    for (int c = 0; c < 4; ++c) add(angle + arm_angle, arm[c]);
  }
  Points<2> points(2, polygon.size());
  for (size_t k = 0; k < polygon.size(); ++k) points.col(k) = polygon[k];
  return points;
}

}  // namespace

Scene<2> starfish_scene() {
  Scene<2> scene;
  scene.name = "starfish";
  scene.solids = {{"starfish",
                   {MaterialModel::neo_log, 1.5e5, 0.4, 400},
                   shapes2d::make_parts(shapes2d::SplineLoop{control_polygon(), n_arms})}};
  scene.method.projection.degree = 2;
  scene.method.rays.n_rays = 40;
  scene.method.interval.spacing = 0.08;
  scene.method.weights.cutoff = 1;
  scene.gravity = {0, -10};
  const Vec<2> tip = 1.5 * Vec<2>(std::cos(first_arm), std::sin(first_arm));
  Pin<2> pin{{}, {true, true}};
  pin.where.box = Box<2>{tip - Vec<2>::Constant(0.3), tip + Vec<2>::Constant(0.3)};
  scene.pins = {pin};
  scene.analysis.time_step = 0.01;
  return scene;
}

std::vector<State> states_at(const Scene<2>& scene, Model<2>& model,
                             const std::vector<double>& times) {
  std::vector<State> states;
  State state = model.initial;
  Analysis analysis = scene.analysis;
  for (const double time : times) {
    analysis.duration = time;
    const auto report = march(model.system, analysis, state, [](const State&, const StepInfo&) {});
    if (report.status != Status::converged)
      throw InputError(scene.name, "analysis", describe(report.status), "steps that converge");
    states.push_back(state);
  }
  return states;
}

}  // namespace sem::figures
