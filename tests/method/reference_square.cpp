// Stage by stage against the public reference code's square (data/reference_square).
#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

#include "sem/method/discretization.h"
#include "solids.h"

using namespace sem;

namespace {

using Rows = std::vector<std::vector<double>>;

Rows read_csv(const std::string& name) {
  std::ifstream in(std::string(SEM_TEST_DATA) + "/reference_square/" + name);
  Rows rows;
  for (std::string line; std::getline(in, line);) {
    rows.emplace_back();
    std::istringstream fields(line);
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(std::stod(field));
  }
  return rows;
}

// The 12 straight parts as the reference has them.
test::Parts<2> reference_parts() {
  const Rows x0 = read_csv("sim2d_x0.csv");
  REQUIRE(x0.size() == 24);
  test::Parts<2> parts;
  for (size_t i = 0; i < 24; i += 2)
    parts.push_back(segment<2>({x0[i][0], x0[i][1]}, {x0[i + 1][0], x0[i + 1][1]}));
  return parts;
}

struct Stages {
  Boundary<2> boundary = make_boundary<2>({reference_parts()});
  Loops<2> loops = find_loops(boundary);
  Samples<2> samples = sample_boundary(boundary, {});
};

BlendingWeights<2> weights_at(const Stages& stages, const Points<2>& position) {
  const auto distances = measure_distances(stages.boundary, stages.loops, position,
                                           DistanceWeight::published, 1.0);
  return blending_weights(distance_weights(distances, {}), stages.boundary, position);
}

Points<2> reference_points(const Rows& w) {
  Points<2> position(2, w.size());
  for (size_t k = 0; k < w.size(); ++k) position.col(k) << w[k][0], w[k][1];
  return position;
}

}  // namespace

TEST_CASE("reference square: blending weights at interior points agree to 1e-7") {
  const Stages stages;
  const Rows w = read_csv("sim2d_w.csv");
  REQUIRE(w.size() == 100);
  const Points<2> position = reference_points(w);
  const auto weights = weights_at(stages, position);
  int n_interior = 0;
  for (int k = 0; k < 100; ++k) {
    const Vec<2> X = position.col(k);
    if (X.minCoeff() < 1e-6 || X.maxCoeff() > 2 - 1e-6) continue;
    ++n_interior;
    Eigen::VectorXd ours = Eigen::VectorXd::Zero(12);
    for (int e = weights.begin[k]; e < weights.begin[k + 1]; ++e) ours[weights.part[e]] = weights.w[e];
    for (int i = 0; i < 12; ++i) CHECK(std::abs(ours[i] - w[k][2 + i]) < 1e-7);
  }
  CHECK(n_interior == 64);
}

TEST_CASE("reference square: with its clamp of 1/theta the weights agree to 1e-14") {
  const Stages stages;
  const Rows w = read_csv("sim2d_w.csv");
  const Points<2> position = reference_points(w);
  const auto theta = distance_weights(
      measure_distances(stages.boundary, stages.loops, position, DistanceWeight::published, 1.0), {});
  for (int k = 0; k < 100; ++k) {
    const Vec<2> X = position.col(k);
    if (X.minCoeff() < 1e-6 || X.maxCoeff() > 2 - 1e-6) continue;
    Eigen::VectorXd clamped = Eigen::VectorXd::Constant(12, 1e-8);
    for (int e = theta.begin[k]; e < theta.begin[k + 1]; ++e)
      clamped[theta.part[e]] = std::max(1e-8, theta.theta[e]);
    for (int i = 0; i < 12; ++i) CHECK(std::abs(clamped[i] / clamped.sum() - w[k][2 + i]) < 1e-14);
  }
}

TEST_CASE("reference square: the origins are those of the reference where it has no tie") {
  const Stages stages;
  const Rows com = read_csv("sim2d_com.csv"), w = read_csv("sim2d_w.csv");
  const Points<2> position = reference_points(w);
  // Its quadrature: 10 by 10 points, ends included, all with the same weight; its weights as stored.
  BlendingWeights<2> weights;
  weights.n_parts = 12;
  weights.begin.push_back(0);
  for (const auto& row : w) {
    for (int i = 0; i < 12; ++i)
      if (row[2 + i] > 1e-6) {
        weights.part.push_back(i);
        weights.w.push_back(row[2 + i]);
      }
    weights.begin.push_back(int(weights.part.size()));
  }
  const auto origins = choose_origins(OriginChoice::shared_parts, weights,
                                      Eigen::VectorXd::Constant(100, 0.04).eval(), stages.samples);
  for (int i = 0; i < 12; ++i) {
    if (i % 3 == 1) continue;  // parts 2, 5, 8, 11 are exact ties
    const Vec<2> ours = origins.position.col(origins.of_part[i]);
    CHECK(std::abs(ours[0] - com[i][1]) < 1e-12);
    CHECK(std::abs(ours[1] - com[i][2]) < 1e-12);
  }
}

TEST_CASE("reference square: the linear projection agrees to 1e-10, given its assignment") {
  const Stages stages;
  const Rows com = read_csv("sim2d_com.csv"), L = read_csv("sim2d_L.csv");
  REQUIRE(L.size() == 64);
  // Its origins as sets of parts: read off its translation rows (columns x of both samples of a part).
  std::vector<std::vector<int>> members(8);
  for (int o = 0; o < 8; ++o)
    for (int i = 0; i < 12; ++i)
      if (L[48 + 2 * o][4 * i] != 0) members[o].push_back(i);
  std::vector<int> of_part;
  for (int i = 0; i < 12; ++i) of_part.push_back(int(com[i][0]) - 1);
  const auto origins = origins_from_sets<2>(members, of_part, stages.samples);
  for (int i = 0; i < 12; ++i) {
    CHECK(std::abs(origins.position(0, of_part[i]) - com[i][1]) < 1e-12);
    CHECK(std::abs(origins.position(1, of_part[i]) - com[i][2]) < 1e-12);
  }
  for (const FitKind fit : {FitKind::degree_by_degree, FitKind::degree_by_degree_raw}) {
    ProjectionOptions options;
    options.fit = fit;
    const auto projection = project(stages.samples, origins, options);
    double worst = 0;
    for (int i = 0; i < 12; ++i) {
      const PartFit part = fit_on_controls(projection, i);
      for (int m = 0; m < 2; ++m)
        for (int component = 0; component < 2; ++component) {
          Eigen::VectorXd row = Eigen::VectorXd::Zero(48);
          for (size_t c = 0; c < part.columns.size(); ++c)
            row[2 * part.columns[c] + component] = part.coefficients(m, c) / part.scale;
          const auto& expected = L[4 * i + 2 * component + m];
          for (int j = 0; j < 48; ++j) worst = std::max(worst, std::abs(row[j] - expected[j]));
        }
    }
    CHECK(worst < 1e-10);
  }
}
