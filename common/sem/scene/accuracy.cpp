#include "sem/scene/accuracy.h"

#include <nlohmann/json.hpp>

#include "sem/method/least_squares.h"

namespace sem {
namespace {

constexpr int highest_moment = 6;

// Largest difference of the rule's moments from the boundary's.
template <int Dim>
double high_moment_error(const Discretization<Dim>& d, const Vec<Dim>& center) {
  const double size = (d.boundary.box.upper - d.boundary.box.lower).maxCoeff();
  const auto truth = boundary_moments_to_degree(d.boundary, d.loops, highest_moment, center, size);
  if (!truth) return 0;
  return moment_error(d.quadrature, highest_moment, center, size, *truth);
}

// z whose control points are these, as nearly as the unknowns allow.
template <int Dim>
Points<Dim> unknowns_for(const Unknowns<Dim>& unknowns, const Points<Dim>& controls) {
  if (unknowns.S.size() == 0) return controls;
  return least_squares(unknowns.S, controls.transpose()).transpose();
}

}  // namespace

template <int Dim>
double test_energy(const Model<Dim>& model, const Quadrature<Dim>& rule) {
  const auto& d = model.discretization;
  const Vec<Dim> middle = (d.boundary.box.lower + d.boundary.box.upper) / 2;
  const double size = (d.boundary.box.upper - d.boundary.box.lower).maxCoeff();
  Points<Dim> p = rest_controls(d.boundary);
  for (int c = 0; c < p.cols(); ++c) {
    const Vec<Dim> xi = (p.col(c) - middle) / (size / 2);
    for (int a = 0; a < Dim; ++a) {
      const double next = xi[(a + 1) % Dim];
      p(a, c) += size / 40 * (next * next + xi[a] * next);
    }
  }
  const Points<Dim> vectors = unknowns_for(d.unknowns, p);
  const Eigen::VectorXd z = vectors.reshaped();
  double energy = 0;
  const Map<Dim> map = map_at(d, rule.position, true);
  const Points<Dim> y = coefficients(map, z);
  for (const auto& block : map.blocks) {
    for (size_t k = 0; k < block.points.size(); ++k) {
      const Mat<Dim> F = deformation_gradient(block, int(k), y);
      Material material = model.materials.materials[rule.solid[block.points[k]]];
      material.model = MaterialModel::linear;
      energy += rule.weight[block.points[k]] * energy_density<Dim>(material, F);
    }
  }
  return energy;
}

template <int Dim>
Accuracy<Dim> measure_accuracy(const Model<Dim>& model) {
  const auto& d = model.discretization;
  Accuracy<Dim> a;
  a.about = (d.boundary.box.lower + d.boundary.box.upper) / 2;
  a.boundary = boundary_moments<Dim>(d.boundary, d.loops, a.about);
  a.quadrature = quadrature_moments<Dim>(d.quadrature.position, d.quadrature.weight, a.about);
  const double size = d.boundary.box.diagonal(), volume = std::abs(a.boundary.volume);
  if (a.boundary.available && volume > 0) {
    a.volume_error = std::abs(a.quadrature.volume - a.boundary.volume) / volume;
    a.first_moment_error = (a.quadrature.first - a.boundary.first).norm() / (volume * size);
    a.second_moment_error = (a.quadrature.second - a.boundary.second).norm() / (volume * size * size);
  }
  a.high_moment_error = high_moment_error<Dim>(d, a.about);
  a.report = d.interior_report;
  if (d.interior_report.original.size() > 0) {
    const double before = test_energy(model, d.interior_report.original);
    a.energy_change = std::abs(test_energy(model, d.quadrature) / before - 1);
  }
  double uncovered = 0;
  for (const int k : d.weights.uncovered) uncovered += d.quadrature.weight[k];
  a.uncovered_share = uncovered / a.quadrature.volume;
  a.gap_share = d.rays.capped_length / a.quadrature.volume;
  const Points<Dim> x = evaluate(d.interior, model.system.rest);
  a.identity_error = (x - d.quadrature.position).colwise().norm().maxCoeff() / size;
  const Points<Dim> y = coefficients(d.interior, model.system.rest);
  for (const auto& block : d.interior.blocks)
    for (size_t k = 0; k < block.points.size(); ++k) {
      const Mat<Dim> F = deformation_gradient(block, int(k), y);
      a.identity_gradient_error =
          std::max(a.identity_gradient_error, (F - Mat<Dim>::Identity()).cwiseAbs().maxCoeff());
    }
  for (int k = 0; k < d.weights.n_points(); ++k) {
    double sum = 0;
    for (int e = d.weights.begin[k]; e < d.weights.begin[k + 1]; ++e) sum += d.weights.w[e];
    a.partition_error = std::max(a.partition_error, std::abs(sum - 1));
  }
  const Points<Dim> on_boundary = evaluate(d.on_boundary, model.system.rest);
  a.boundary_map_error = (on_boundary - d.samples.position).colwise().norm().maxCoeff() / size;
  if (!d.rays.rays.empty()) a.unpaired_share = double(d.rays.n_unpaired) / double(d.rays.rays.size());
  for (const auto& fit : d.projection.parts) {
    a.worst_fit_condition = std::max(a.worst_fit_condition, fit.condition);
    a.n_borrowed += fit.borrowed;
  }
  a.pruning_error = d.pruning.relative_error;
  a.divergence_defect = model.divergence_defect;
  return a;
}

template <int Dim>
double folded_share(const Model<Dim>& model, const Eigen::VectorXd& z) {
  const auto& d = model.discretization;
  const Points<Dim>& X = d.quadrature.position;
  std::vector<Mat<Dim>> F(size_t(d.quadrature.size()));
  if (d.options.formulation == Formulation::condensed) {
    const Points<Dim> y = coefficients(d.interior, z);
    for (const auto& block : d.interior.blocks)
      for (size_t k = 0; k < block.points.size(); ++k)
        F[size_t(block.points[k])] = deformation_gradient(block, int(k), y);
  } else {
    const double step = 1e-7 * d.boundary.box.diagonal();
    const Points<Dim> x = evaluate(d.interior, z);
    for (int a = 0; a < Dim; ++a) {
      const Points<Dim> ahead = X.colwise() + step * Vec<Dim>::Unit(a);
      const Points<Dim> change = evaluate(map_at(d, ahead, false), z) - x;
      for (int k = 0; k < X.cols(); ++k) F[size_t(k)].col(a) = change.col(k) / step;
    }
  }
  double folded = 0;
  for (int k = 0; k < X.cols(); ++k)
    if (!(F[size_t(k)].determinant() > 0)) folded += d.quadrature.weight[k];
  return folded / d.quadrature.weight.sum();
}

template <int Dim>
std::vector<StageError> stage_errors(const std::vector<StageCost>& cost, const Accuracy<Dim>& a) {
  const std::vector<StageError> all = {
      {"loops", a.gap_share, "share of the inside that ends at closed gaps"},
      {"rays", a.unpaired_share, "share of rays with a hit that found no partner"},
      a.report.error > 0 ? StageError{"interior quadrature", a.report.error, "estimated, of what the rule must integrate"}
                         : StageError{"interior quadrature", a.high_moment_error, "largest of the moments to degree 6"},
      {"distance weights", a.uncovered_share, "share of the inside that no part reaches"},
      {"blending weights", a.partition_error, "largest |sum of weights - 1|"},
      {"projection", a.identity_error, "largest |x(X) - X| of the body at rest, by its size"},
      {"coefficients", a.identity_error, "largest |x(X) - X| of the body at rest, by its size"},
      {"interior map", a.identity_gradient_error, "largest |F - 1| of the body at rest"},
      {"boundary map", a.boundary_map_error, "largest |x(X) - X| of the boundary at rest, by the size"},
      {"divergence theorem", a.divergence_defect, "largest defect before weights were adjusted, by its terms"},
      {"pruning", a.pruning_error, "of the map, by its norm"}};
  std::vector<StageError> done;
  for (const auto& line : all)
    for (const auto& stage : cost)
      if (stage.stage == line.stage) done.push_back(line);
  return done;
}

namespace {

template <int Dim>
nlohmann::ordered_json moments_json(const Moments<Dim>& moments, const Vec<Dim>& about) {
  nlohmann::ordered_json json;
  json[DimTraits<Dim>::volume_name] = moments.volume;
  const Vec<Dim> centroid = about + moments.first / moments.volume;
  const Mat<Dim> central = moments.second - moments.first * moments.first.transpose() / moments.volume;
  json["centroid_m"] = std::vector<double>(centroid.begin(), centroid.end());
  json["central_second_moments"] = nlohmann::ordered_json::array();
  for (int i = 0; i < Dim; ++i)
    for (int j = i; j < Dim; ++j) json["central_second_moments"].push_back(central(i, j));
  return json;
}

nlohmann::ordered_json moment_report_json(const MomentReport& report) {
  return {{"degree", report.degree},
          {"points_before", report.points_before},
          {"points_after", report.points_after},
          {"moment_error_before", report.error_before},
          {"moment_error_after", report.error_after}};
}

}  // namespace

template <int Dim>
nlohmann::ordered_json to_json(const Accuracy<Dim>& a) {
  nlohmann::ordered_json json;
  auto& rule = json["quadrature"];
  rule["rule"] = moments_json(a.quadrature, a.about);
  if (a.boundary.available) {
    rule["boundary_truth"] = moments_json(a.boundary, a.about);
    rule["relative_error"] = {{DimTraits<Dim>::volume_name, a.volume_error},
                              {"first_moments", a.first_moment_error},
                              {"second_moments", a.second_moment_error},
                              {"moments_to_degree_6", a.high_moment_error}};
  } else {
    rule["boundary_truth"] = "not available: the boundary does not determine the body (gaps, undecided "
                             "orientation or overlapping solids)";
  }
  if (a.report.error > 0) rule["estimated_error"] = a.report.error;
  if (std::isinf(a.divergence_defect))
    rule["divergence_defect"] = "not removed: gaps, overlaps or too few points";
  else if (a.divergence_defect > 0)
    rule["divergence_defect"] = a.divergence_defect;
  if (!a.report.components.empty()) {
    for (const auto& component : a.report.components)
      rule["components"].push_back({{"rule", component.rule},
                                    {"cells", component.n_cells},
                                    {"points", component.n_points},
                                    {"estimated_error", component.error}});
  }
  if (a.report.fit.degree > 0) rule["fit"] = moment_report_json(a.report.fit);
  if (!a.report.fit_has_truth) rule["fit"] = "not done: the boundary's moments are not available";
  if (a.report.compression.degree > 0) rule["compression"] = moment_report_json(a.report.compression);
  if (a.report.fit.degree > 0 || a.report.compression.degree > 0)
    rule["strain_energy_change"] = a.energy_change;
  json["uncovered_share"] = a.uncovered_share;
  json["gap_share"] = a.gap_share;
  json["identity_error"] = a.identity_error;
  json["identity_gradient_error"] = a.identity_gradient_error;
  json["worst_fit_condition"] = a.worst_fit_condition;
  json["parts_with_borrowed_directions"] = a.n_borrowed;
  json["pruning_error"] = a.pruning_error;
  return json;
}

template double test_energy<2>(const Model<2>&, const Quadrature<2>&);
template double test_energy<3>(const Model<3>&, const Quadrature<3>&);
template Accuracy<2> measure_accuracy<2>(const Model<2>&);
template Accuracy<3> measure_accuracy<3>(const Model<3>&);
template double folded_share<2>(const Model<2>&, const Eigen::VectorXd&);
template double folded_share<3>(const Model<3>&, const Eigen::VectorXd&);
template std::vector<StageError> stage_errors<2>(const std::vector<StageCost>&, const Accuracy<2>&);
template std::vector<StageError> stage_errors<3>(const std::vector<StageCost>&, const Accuracy<3>&);
template nlohmann::ordered_json to_json<2>(const Accuracy<2>&);
template nlohmann::ordered_json to_json<3>(const Accuracy<3>&);

}  // namespace sem
