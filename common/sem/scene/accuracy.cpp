#include "sem/scene/accuracy.h"

#include <nlohmann/json.hpp>

namespace sem {

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
  double uncovered = 0;
  for (const int k : d.weights.uncovered) uncovered += d.quadrature.weight[k];
  a.uncovered_share = uncovered / a.quadrature.volume;
  a.gap_share = d.rays.capped_length / a.quadrature.volume;
  const Points<Dim> x = evaluate(d.interior, model.system.rest);
  a.identity_error = (x - d.quadrature.position).colwise().norm().maxCoeff() / size;
  const Points<Dim> p = rest_controls(d.boundary);
  for (int axis = 0; axis < Dim; ++axis)
    for (const auto& block : d.interior.blocks) {
      Points<Dim> column = p(Eigen::all, block.columns) * block.gradient[axis].transpose();
      column.row(axis).array() -= 1;
      a.identity_gradient_error = std::max(a.identity_gradient_error, column.cwiseAbs().maxCoeff());
    }
  for (const auto& fit : d.projection.parts) {
    a.worst_fit_condition = std::max(a.worst_fit_condition, fit.condition);
    a.n_borrowed += fit.borrowed;
  }
  a.pruning_error = d.pruning.relative_error;
  return a;
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
                              {"second_moments", a.second_moment_error}};
  } else {
    rule["boundary_truth"] = "not available: the boundary does not determine the body (gaps, undecided "
                             "orientation or overlapping solids)";
  }
  json["uncovered_share"] = a.uncovered_share;
  json["gap_share"] = a.gap_share;
  json["identity_error"] = a.identity_error;
  json["identity_gradient_error"] = a.identity_gradient_error;
  json["worst_fit_condition"] = a.worst_fit_condition;
  json["parts_with_borrowed_directions"] = a.n_borrowed;
  json["pruning_error"] = a.pruning_error;
  return json;
}

template Accuracy<2> measure_accuracy<2>(const Model<2>&);
template Accuracy<3> measure_accuracy<3>(const Model<3>&);
template nlohmann::ordered_json to_json<2>(const Accuracy<2>&);
template nlohmann::ordered_json to_json<3>(const Accuracy<3>&);

}  // namespace sem
