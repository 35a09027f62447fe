// Interior rules as a scene switches them on, and what the summary says of them.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "bodies.h"
#include "scene_texts.h"
#include "sem/scene/accuracy.h"

using namespace sem;

namespace {

std::unique_ptr<Model<2>> sail(const std::string& quadrature) {
  return build_model(
      test::read(test::triangle(R"("method": {"weights": {"cutoff": 0.8}, "quadrature": )" +
                                quadrature + "}")),
      "");
}

}  // namespace

TEST_CASE(
    "quadrature.method chooses the rule; the summary names it and its error against the boundary") {
  const auto grid = sail(R"({"rays": 20})"), exact = sail(R"({"method": "exact"})");
  const auto of_grid = measure_accuracy(*grid), of_exact = measure_accuracy(*exact);
  CHECK(of_grid.high_moment_error > 1e-4);
  CHECK(of_exact.volume_error < 1e-13);
  CHECK(of_exact.high_moment_error < 1e-10);
  CHECK(exact->discretization.quadrature.size() < 150);
  const auto json = to_json(of_exact)["quadrature"];
  CHECK(json["relative_error"]["moments_to_degree_6"] == of_exact.high_moment_error);
  CHECK(json["components"][0]["points"] == exact->discretization.quadrature.size());
  CHECK(json["estimated_error"].get<double>() <= 1e-10);
  CHECK(!to_json(of_grid)["quadrature"].contains("components"));
}

TEST_CASE("quadrature.fit and compress report points, moments and the change in strain energy") {
  const auto model = sail(R"({"rays": 20, "points": 20, "fit": 6, "compress": 6})");
  const auto accuracy = measure_accuracy(*model);
  CHECK(model->discretization.quadrature.size() <= 28);
  CHECK(accuracy.high_moment_error < 1e-11);
  CHECK(accuracy.energy_change < 0.2);
  const auto json = to_json(accuracy)["quadrature"];
  CHECK(json["fit"]["moment_error_before"].get<double>() > 1e-4);
  CHECK(json["fit"]["moment_error_after"].get<double>() < 1e-11);
  CHECK(json["compression"]["points_before"] == 400);
  CHECK(json["compression"]["points_after"] == model->discretization.quadrature.size());
  CHECK(json["strain_energy_change"] == accuracy.energy_change);
  // Too few moments change the energy, and the report says so.
  double previous = 10;
  for (const int degree : {1, 12}) {
    Scene<2> scene = test::box_scene<2>(MaterialModel::linear, 2);
    scene.method.rays.n_rays = scene.method.interval.points = 20;
    scene.method.interior_rule.compress = degree;
    const double change = measure_accuracy(*build_model(scene, "")).energy_change;
    CHECK(change > 1e-9);
    CHECK(change < previous / 5);
    previous = change;
  }
}

TEST_CASE("bad rules of a scene are refused by name") {
  const auto error = [](const std::string& quadrature) {
    return test::error_of(test::triangle(R"("method": {"quadrature": )" + quadrature + "}"));
  };
  CHECK(error(R"({"method": "gauss"})").find("method.quadrature.method") != std::string::npos);
  CHECK(error(R"({"tolerance": 0})").find("method.quadrature.tolerance") != std::string::npos);
  CHECK(error(R"({"compress": -1})").find("method.quadrature.compress") != std::string::npos);
}
