// Hard places for origins, weights and fits.
#include <cmath>
#include <cstdio>

#include "tests/hard_cases/body_cases.h"

namespace sem::stability {
namespace {

PlaneShape beam() {
  return {{{polygon({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {4, 1}, {3, 1}, {2, 1}, {1, 1}, {0, 1}}),
            {quad({0, 0}, {4, 0}, {4, 1}, {0, 1})}}}, 4};
}

// A U whose gap ends at the height of the centroid of its boundary, where one origin for all lies: with
// legs of height 3 and the gap's end at height b, sum of length times height is b times the length for
// b^2 - 17 b + 24 = 0.
PlaneShape balanced_u() {
  const double b = (17 - std::sqrt(193.0)) / 2;
  return {{{polygon({{0, 0}, {3, 0}, {3, 3}, {2, 3}, {2, b}, {1, b}, {1, 3}, {0, 3}}),
            {quad({0, 0}, {1, 0}, {1, 3}, {0, 3}), quad({2, 0}, {3, 0}, {3, 3}, {2, 3}), quad({1, 0}, {2, 0}, {2, b}, {1, b})}}},
          6 + b};
}

// A square whose bottom bulges out by `height` in the middle.
PlaneShape bulging(double height) {
  return ruled(bezier({{0, 0}, {0.5, -2 * height}, {1, 0}}), bezier({{0, 1}, {0.5, 1}, {1, 1}}), 1 + 2 * height / 3);
}

PlaneShape regular_polygon(int n) {
  std::vector<Vec<2>> corners;
  for (int k = 0; k < n; ++k) corners.push_back({std::cos(2 * M_PI * k / n), std::sin(2 * M_PI * k / n)});
  return {{{polygon(corners), {}}}, n * std::sin(2 * M_PI / n) / 2};
}

// The uniform cubic B-spline of a closed control polygon as one part whose knots run on beyond its ends.
// Area: x y' on each span is of degree 5, for which three Gauss points are exact.
PlaneShape closed_spline(const std::vector<Vec<2>>& control) {
  const int n = int(control.size());
  Curve curve;
  curve.degree = {3};
  for (int k = -3; k <= n + 3; ++k) curve.knots[0].push_back(k);
  curve.control_points.resize(2, n + 3);
  for (int k = 0; k < n + 3; ++k) curve.control_points.col(k) = control[size_t(k % n)];
  curve.weights.setOnes(n + 3);
  double area = 0;
  for (int k = 0; k < n; ++k)
    for (int g = -1; g <= 1; ++g) {
      const double t = 0.5 + g * std::sqrt(0.15), s = 1 - t, weight = g == 0 ? 4.0 / 9 : 5.0 / 18;
      const double value[] = {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * s * s * s - 6 * s * s + 4) / 6, t * t * t / 6};
      const double slope[] = {-s * s / 2, (9 * t * t - 12 * t) / 6, (12 * s - 9 * s * s) / 6, t * t / 2};
      Vec<2> X = Vec<2>::Zero(), along = Vec<2>::Zero();
      for (int j = 0; j < 4; ++j) {
        X += value[j] * control[size_t((k + j) % n)];
        along += slope[j] * control[size_t((k + j) % n)];
      }
      area += weight * X[0] * along[1];
    }
  return {{{{curve}, {}}}, std::abs(area), false};
}

// The unit circle as one rational quadratic of four arcs.
PlaneShape full_circle() {
  Curve curve;
  curve.degree = {2};
  curve.knots[0] = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
  curve.control_points.resize(2, 9);
  curve.control_points << 1, 1, 0, -1, -1, -1, 0, 1, 1,  //
      0, 1, 1, 1, 0, -1, -1, -1, 0;
  const double half = std::sqrt(0.5);
  curve.weights.resize(9);
  curve.weights << 1, half, 1, half, 1, half, 1, half, 1;
  return {{{{curve}, {}}}, M_PI, false};
}

void set_cutoff(BodyCase& one, double cutoff) {
  one.method = [cutoff](MethodOptions& method) { method.weights.cutoff = cutoff; };
}

void one_origin(BodyCase& one) {
  one.method = [](MethodOptions& method) { method.origins = OriginChoice::one; };
}

std::vector<BodyCase> body_cases() {
  std::vector<BodyCase> cases;
  const PlaneShape square = rectangle({0, 0}, {1, 1});
  cases.push_back({.name = "origin on a part's line", .shape = beam(), .fast = true});
  set_cutoff(cases.back(), 0.51);
  cases.push_back({.name = "all parts share one origin", .shape = beam()});
  one_origin(cases.back());
  cases.push_back({.name = "that origin on a part's line", .shape = balanced_u()});
  one_origin(cases.back());
  for (const double height : {1e-12, 1e-9, 1e-6, 1e-3}) {
    char name[64];
    std::snprintf(name, sizeof name, "part bulges by %.0e", height);
    cases.push_back({.name = name, .shape = bulging(height)});
  }
  cases.push_back({.name = "straight parts of degree 2", .shape = bulging(0), .fast = true});
  for (const double cutoff : {1e-3, 0.2}) {
    char name[64];
    std::snprintf(name, sizeof name, "cutoff %g: uncovered points", cutoff);
    cases.push_back({.name = name, .shape = square, .rule = Rule::may_refuse, .fast = cutoff == 0.2});
    set_cutoff(cases.back(), cutoff);
  }
  cases.push_back({.name = "cutoff 1e6 sizes", .shape = square});
  set_cutoff(cases.back(), 1e6);
  cases.push_back({.name = "one closed spline",
                   .shape = closed_spline({{1, 0}, {0.6, 0.9}, {-0.4, 1}, {-1, 0.1}, {-0.5, -0.8}, {0.5, -1}}),
                   .fast = true});
  cases.push_back({.name = "one closed circle", .shape = full_circle()});
  cases.push_back({.name = "exact ties: square of 8 parts", .shape = rectangle({0, 0}, {1, 1}, 2)});
  cases.push_back({.name = "exact ties: disc", .shape = disc({0, 0}, 1)});
  cases.back().bounds.volume = 1e-4;  // in 3D rays are not split where they touch the side
  cases.push_back({.name = "exact ties: hexagon", .shape = regular_polygon(6)});
  return cases;
}

}  // namespace

std::vector<Case> kinematics_cases() {
  std::vector<Case> cases;
  for (const auto& one : body_cases()) add_body_case(cases, "kinematics", one);
  return cases;
}

}  // namespace sem::stability
