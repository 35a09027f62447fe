// The draft's figure 3: the error energy as springs between the fitted and the actual boundary.
#include "figures/scene_model.h"
#include "figures/starfish.h"
#include "src2d/picture/outline.h"

namespace sem::figures {
namespace {

constexpr double moment = 0.5;  // s after its release
// A lower degree and softer springs than the scene has, so that the curves part visibly.
const std::vector<std::string> changes = {"stability.stiffness=2e4", "method.degree=2"};

// Points along the body's one part for control points p.
Points<2> curve(const Discretization<2>& body, const Points<2>& p) {
  const Polyline line = Outline(body).part(0, p);
  Points<2> points(2, line.size());
  for (size_t k = 0; k < line.size(); ++k) points.col(k) = line[k];
  return points;
}

Data compute() {
  const SceneModel built("closed_curve", changes);
  Model<2>& model = *built.model;
  const Discretization<2>& body = model.discretization;
  const Eigen::VectorXd z = states_at(built.scene, model, {moment}).back().z;
  const Points<2> p = control_points(body.unknowns, z);
  const Points<2> actual = curve(body, p);
  const Points<2> fitted =
      evaluate(map_at(body, curve(body, rest_controls(body.boundary)), false), z);
  Data data;
  auto& curves = data.add("curves", {"fitted_x", "fitted_y", "actual_x", "actual_y"});
  for (int k = 0; k < actual.cols(); ++k)
    curves.add({fitted(0, k), fitted(1, k), actual(0, k), actual(1, k)});
  // A spring per boundary sample, of the energy that the sample adds to V.
  const Points<2> map = evaluate(body.on_boundary, z);
  const Points<2> q = p * sample_jacobian(body.samples, body.boundary.n_controls()).transpose();
  auto& springs = data.add("springs", {"fitted_x", "fitted_y", "actual_x", "actual_y", "energy"});
  for (int s = 0; s < body.samples.size(); ++s)
    springs.add({map(0, s), map(1, s), q(0, s), q(1, s),
                 model.stability_stiffness / 2 * body.samples.weight[s] *
                     (map.col(s) - q.col(s)).squaredNorm()});
  data.add("values", {"time", "gamma", "stability_energy", "elastic_energy"})
      .add({moment, model.stability_stiffness, model.energy->stability_energy(z),
            model.energy->elastic_energy(z)});
  return data;
}

void draw(Plot& plot, const Data& data) {
  Panel& panel = plot.panel();
  panel.equal = true;
  panel.frame = false;
  panel.legend = LegendPlace::below;
  const DataTable &curves = data["curves"], &springs = data["springs"], &values = data["values"];
  panel.curve(curves["actual_x"], curves["actual_y"],
              {.label = "actual, J(u) p", .color = colors::okabe_ito[1], .width = 1.6});
  panel.curve(curves["fitted_x"], curves["fitted_y"],
              {.label = "fitted, x(X(u))", .color = colors::okabe_ito[2], .width = 1.6});
  const auto from = zip(springs["fitted_x"], springs["fitted_y"]);
  const auto to = zip(springs["actual_x"], springs["actual_y"]);
  const ColorScale scale = {0, scale_of(springs["energy"]).upper};
  panel.segments(from, to, springs["energy"], scale, 2);
  for (const auto& ends : {from, to}) panel.markers(ends, springs["energy"], scale, 3.2);
  panel.color_bar(scale, "energy of a spring (J)");
  panel.lines_below = {"t = " + number_text(values.value("time")) +
                           " s,  γ = " + number_text(values.value("gamma") / 1000) + " kPa/m",
                       "error energy " + number_text(values.value("stability_energy")) +
                           " J,  elastic energy " + number_text(values.value("elastic_energy")) +
                           " J"};
}

}  // namespace

Figure error_energy() {
  return {
      "error_energy",
      "Draft figure 3: a swinging body of one closed curve, its boundary as the fitted polynomial "
      "maps it and as the control points have it, with springs coloured by their error energy",
      3.3,
      3.6,
      compute,
      draw};
}

}  // namespace sem::figures
