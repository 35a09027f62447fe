#include "kernels.h"

#include <cmath>
#include <map>
#include <random>
#include <stdexcept>

#include "sem/nurbs/basis.h"
#include "sem/nurbs/closest.h"
#include "sem/nurbs/hits.h"
#include "textbook.h"
#include "sem/base/timing.h"

namespace sem {
namespace {

class Random {
 public:
  double between(double lower, double upper) {
    return lower + (upper - lower) * double(bits_()) / 0x1p32;
  }
  template <int Dim>
  Vec<Dim> in(double lower, double upper) {
    Vec<Dim> x;
    for (double& value : x) value = between(lower, upper);
    return x;
  }

 private:
  std::mt19937 bits_{1};
};

std::vector<double> clamped_knots(int degree, int n_control) {
  std::vector<double> knots(degree, 0);
  for (int k = 0; k <= n_control - degree; ++k) knots.push_back(double(k) / (n_control - degree));
  knots.insert(knots.end(), degree, 1);
  return knots;
}

// A wavy ring around the origin, in [-1.3, 1.3]^2.
Nurbs<1, 2> sample_curve(Random& random) {
  const int n = 16;
  Nurbs<1, 2> curve;
  curve.degree = {3};
  curve.knots = {clamped_knots(3, n)};
  curve.control_points.resize(2, n);
  curve.weights.resize(n);
  for (int c = 0; c < n; ++c) {
    const double angle = 2 * M_PI * c / n, radius = random.between(0.7, 1.3);
    curve.control_points.col(c) << radius * std::cos(angle), radius * std::sin(angle);
    curve.weights[c] = random.between(0.5, 2);
  }
  return curve;
}

// A bumpy sheet over [-1, 1]^2.
Nurbs<2, 3> sample_surface(Random& random) {
  const int n = 8;
  Nurbs<2, 3> surface;
  surface.degree = {3, 3};
  surface.knots = {clamped_knots(3, n), clamped_knots(3, n)};
  surface.control_points.resize(3, n * n);
  surface.weights.resize(n * n);
  for (int c = 0; c < n * n; ++c) {
    surface.control_points.col(c) << 2. * (c % n) / (n - 1) - 1, 2. * (c / n) / (n - 1) - 1,
        random.between(-0.3, 0.3);
    surface.weights[c] = random.between(0.5, 2);
  }
  return surface;
}

void require_equal(double difference) {
  if (!(std::abs(difference) < 1e-12))
    throw std::logic_error("evaluation differs from the textbook's by " +
                           std::to_string(difference));
}

constexpr int n_evaluations = 4096, n_queries = 1024, n_repeats = 25;

// Aims for the rows that have one, s.
double target_of(const std::string& name) {
  static const std::map<std::string, double> targets = {
      {"curve point, 1st derivative", 45e-9},
      {"curve point, prepared", 3e-9},
      {"curve point, 1st derivative, prepared", 5e-9},
      {"curve, all hits of a line", 100e-9},
      {"curve, closest point", 300e-9},
      {"surface point, 1st derivatives", 95e-9},
      {"surface point, prepared", 6e-9},
      {"surface point, 1st derivatives, prepared", 12e-9},
      {"surface, all hits of a line", 1e-6},
      {"surface, closest point", 2e-6}};
  const auto found = targets.find(name);
  return found == targets.end() ? 0 : found->second;
}

template <class Own>
KernelTime measure(const char* name, int n, int n_passes, const Own& own) {
  return {name, seconds_per_call(n, n_passes, own)[0], 0, target_of(name)};
}

template <class Own, class Textbook>
KernelTime compare(const char* name, const Own& own, const Textbook& textbook) {
  const auto [seconds, textbook_seconds] =
      seconds_per_call(n_evaluations, n_repeats, own, textbook);
  return {name, seconds, textbook_seconds, target_of(name)};
}

// What the textbook's basis functions are written to: bicubic at most.
struct TextbookBasis {
  int column[16];
  double R[16], R_u[16], R_v[16];
};

void time_curve(Random& random, std::vector<KernelTime>& times) {
  const Nurbs<1, 2> curve = sample_curve(random);
  const PreparedNurbs<1, 2> prepared = prepare(curve);
  std::vector<Param<1>> u(n_evaluations);
  for (auto& value : u) value = random.in<1>(0, 1);
  BasisValues<1> basis;
  TextbookBasis book;
  for (const auto& value : u) {
    Vec<2> slope;
    const Vec<2> X = textbook::curve(curve, value[0], &slope);
    const auto d = derivatives(curve, value, 1);
    require_equal((point(curve, value) - X).norm());
    require_equal((d.first - slope).norm() / slope.norm());
    const auto fast = point_slopes(prepared, value);
    require_equal((fast.point - X).norm());
    require_equal((fast.first - slope).norm() / slope.norm());
    textbook::curve_basis(curve, value[0], book.column, book.R, book.R_u);
    evaluate_basis(curve, value, 1, basis);
    for (int k = 0; k < 4; ++k) {
      require_equal(basis.column[k] - book.column[k]);
      require_equal(basis.value[k] - book.R[k]);
      require_equal((basis.first[0][k] - book.R_u[k]) / slope.norm());
    }
  }
  times.push_back(compare(
      "curve point", [&](int i) { return point(curve, u[i]).sum(); },
      [&](int i) { return textbook::curve(curve, u[i][0]).sum(); }));
  times.push_back(compare(
      "curve point, 1st derivative",
      [&](int i) {
        const auto d = derivatives(curve, u[i], 1);
        return d.point.sum() + d.first.sum();
      },
      [&](int i) {
        Vec<2> slope;
        return textbook::curve(curve, u[i][0], &slope).sum() + slope.sum();
      }));
  times.push_back(compare(
      "curve point, prepared", [&](int i) { return point(prepared, u[i]).sum(); },
      [&](int i) { return textbook::curve(curve, u[i][0]).sum(); }));
  times.push_back(compare(
      "curve point, 1st derivative, prepared",
      [&](int i) {
        const auto d = point_slopes(prepared, u[i]);
        return d.point.sum() + d.first.sum();
      },
      [&](int i) {
        Vec<2> slope;
        return textbook::curve(curve, u[i][0], &slope).sum() + slope.sum();
      }));
  times.push_back(compare(
      "curve basis, 1st derivative",
      [&](int i) {
        evaluate_basis(curve, u[i], 1, basis);
        return basis.value[0] + basis.first[0][0];
      },
      [&](int i) {
        textbook::curve_basis(curve, u[i][0], book.column, book.R, book.R_u);
        return book.R[0] + book.R_u[0];
      }));
  times.push_back(
      measure("curve point, 1st and 2nd derivative", n_evaluations, n_repeats, [&](int i) {
        const auto d = derivatives(curve, u[i]);
        return d.point[0] + d.first(0, 0) + d.second[0][0];
      }));

  std::vector<Vec<2>> from(n_queries), to(n_queries);
  for (int i = 0; i < n_queries; ++i)
    from[i] = random.in<2>(-1.3, 1.3), to[i] = random.in<2>(-1.3, 1.3);
  std::vector<Hit<2>> hits;
  times.push_back(measure("curve, all hits of a line", n_queries, n_repeats, [&](int i) {
    hits.clear();
    append_hits<2>(prepared, {from[i], to[i] - from[i]}, -1e3, 1e3, hits);
    return double(hits.size());
  }));
  times.push_back(measure("curve, closest point", n_queries, n_repeats,
                          [&](int i) { return closest_point<2>(prepared, from[i]).distance; }));
}

void time_surface(Random& random, std::vector<KernelTime>& times) {
  const Nurbs<2, 3> surface = sample_surface(random);
  const PreparedNurbs<2, 3> prepared = prepare(surface);
  std::vector<Param<2>> u(n_evaluations);
  for (auto& value : u) value = random.in<2>(0, 1);
  BasisValues<2> basis;
  TextbookBasis book;
  for (const auto& value : u) {
    Eigen::Matrix<double, 3, 2> first;
    const Vec<3> X = textbook::surface(surface, value, &first);
    const auto d = derivatives(surface, value, 1);
    require_equal((point(surface, value) - X).norm());
    require_equal((d.first - first).norm() / first.norm());
    const auto fast = point_slopes(prepared, value);
    require_equal((fast.point - X).norm());
    require_equal((fast.first - first).norm() / first.norm());
    textbook::surface_basis(surface, value, book.column, book.R, book.R_u, book.R_v);
    evaluate_basis(surface, value, 1, basis);
    for (int k = 0; k < 16; ++k) {
      require_equal(basis.column[k] - book.column[k]);
      require_equal(basis.value[k] - book.R[k]);
      require_equal((basis.first[0][k] - book.R_u[k]) / first.norm());
      require_equal((basis.first[1][k] - book.R_v[k]) / first.norm());
    }
  }
  times.push_back(compare(
      "surface point", [&](int i) { return point(surface, u[i]).sum(); },
      [&](int i) { return textbook::surface(surface, u[i]).sum(); }));
  times.push_back(compare(
      "surface point, 1st derivatives",
      [&](int i) {
        const auto d = derivatives(surface, u[i], 1);
        return d.point.sum() + d.first.sum();
      },
      [&](int i) {
        Eigen::Matrix<double, 3, 2> first;
        return textbook::surface(surface, u[i], &first).sum() + first.sum();
      }));
  times.push_back(compare(
      "surface point, prepared", [&](int i) { return point(prepared, u[i]).sum(); },
      [&](int i) { return textbook::surface(surface, u[i]).sum(); }));
  times.push_back(compare(
      "surface point, 1st derivatives, prepared",
      [&](int i) {
        const auto d = point_slopes(prepared, u[i]);
        return d.point.sum() + d.first.sum();
      },
      [&](int i) {
        Eigen::Matrix<double, 3, 2> first;
        return textbook::surface(surface, u[i], &first).sum() + first.sum();
      }));
  times.push_back(compare(
      "surface basis, 1st derivatives",
      [&](int i) {
        evaluate_basis(surface, u[i], 1, basis);
        return basis.value[0] + basis.first[0][0] + basis.first[1][0];
      },
      [&](int i) {
        textbook::surface_basis(surface, u[i], book.column, book.R, book.R_u, book.R_v);
        return book.R[0] + book.R_u[0] + book.R_v[0];
      }));
  times.push_back(
      measure("surface point, 1st and 2nd derivatives", n_evaluations, n_repeats, [&](int i) {
        const auto d = derivatives(surface, u[i]);
        return d.point[0] + d.first(0, 0) + d.second[0][0];
      }));

  std::vector<Vec<3>> from(n_queries), to(n_queries);
  for (int i = 0; i < n_queries; ++i) from[i] = random.in<3>(-1, 1), to[i] = random.in<3>(-1, 1);
  std::vector<Hit<3>> hits;
  times.push_back(measure("surface, all hits of a line", n_queries, 5, [&](int i) {
    hits.clear();
    append_hits<3>(prepared, {from[i], to[i] - from[i]}, -1e3, 1e3, hits);
    return double(hits.size());
  }));
  times.push_back(measure("surface, closest point", n_queries, 3,
                          [&](int i) { return closest_point<3>(prepared, from[i]).distance; }));
}

}  // namespace

std::vector<KernelTime> time_kernels() {
  Random random;
  std::vector<KernelTime> times;
  time_curve(random, times);
  time_surface(random, times);
  return times;
}

}  // namespace sem
