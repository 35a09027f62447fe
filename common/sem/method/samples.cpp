#include "sem/method/samples.h"

#include <algorithm>
#include <cmath>

#include "sem/base/error.h"
#include "sem/method/line_rules.h"
#include "sem/nurbs/basis.h"

namespace sem {
namespace {

// True if the curve may jump at u: the knot is repeated degree + 1 times.
template <int Dim>
bool may_jump(const Nurbs<Dim - 1, Dim>& nurbs, int axis, double u) {
  const auto& knots = nurbs.knots[axis];
  return std::count(knots.begin(), knots.end(), u) > nurbs.degree[axis];
}

// Spans, those at the domain's ends cut towards them.
template <int Dim>
std::vector<Interval> graded_spans(const Nurbs<Dim - 1, Dim>& nurbs, int axis, int halvings) {
  const std::vector<Interval> all = spans(nurbs, axis);
  if (halvings == 0) return all;
  const Interval range = domain(nurbs, axis);
  std::vector<double> cuts = {range.lower, range.upper};
  for (const auto& span : all) {
    cuts.push_back(span.upper);
    for (double length = (span.upper - span.lower) / 2, h = 0; h < halvings; ++h, length /= 2) {
      if (span.lower == range.lower) cuts.push_back(span.lower + length);
      if (span.upper == range.upper) cuts.push_back(span.upper - length);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  std::vector<Interval> graded;
  for (size_t k = 1; k < cuts.size(); ++k) graded.push_back({cuts[k - 1], cuts[k]});
  return graded;
}

// Points of all knot spans along one direction. A point shared by two spans is kept once, with both
// weights, but where the part may jump: there each side has its own, the left one as close as it gets.
template <int Dim>
LineRule span_points(const Nurbs<Dim - 1, Dim>& nurbs, int axis, int n, const SamplingOptions& options) {
  const bool ends = options.rule == SampleRule::gauss_lobatto;
  const LineRule reference = ends ? gauss_lobatto(n) : gauss_legendre(n);
  LineRule rule;
  for (const auto& [a, b] : graded_spans<Dim>(nurbs, axis, options.end_halvings)) {
    const bool jump = ends && b < domain(nurbs, axis).upper && may_jump<Dim>(nurbs, axis, b);
    for (int k = 0; k < n; ++k) {
      const double end = jump ? std::nextafter(b, a) : b;
      const double u = ends && k == n - 1 ? end : a + (b - a) * (1 + reference.node[k]) / 2;
      const double weight = reference.weight[k] * (b - a) / 2;
      if (k == 0 && !rule.node.empty() && rule.node.back() == u) {
        rule.weight.back() += weight;
      } else {
        rule.node.push_back(u);
        rule.weight.push_back(weight);
      }
    }
  }
  return rule;
}

// Tensor-product points of an untrimmed part.
template <int Dim>
ParameterRule<Dim - 1> points_of_spans(const Nurbs<Dim - 1, Dim>& nurbs, const std::array<int, Dim - 1>& n_points,
                                       const SamplingOptions& options) {
  std::array<LineRule, Dim - 1> rules;
  int n = 1;
  for (int a = 0; a < Dim - 1; ++a) {
    rules[a] = span_points<Dim>(nurbs, a, n_points[a], options);
    n *= int(rules[a].node.size());
  }
  ParameterRule<Dim - 1> result{std::vector<Param<Dim - 1>>(n), std::vector<double>(n, 1)};
  for (int k = 0; k < n; ++k)
    for (int a = 0, rest = k; a < Dim - 1; ++a) {
      const int size = int(rules[a].node.size());
      result.u[k][a] = rules[a].node[rest % size];
      result.weight[k] *= rules[a].weight[rest % size];
      rest /= size;
    }
  return result;
}

// Appends the samples of one part, some more than asked for per span and direction.
template <int Dim>
void append_part(const PreparedNurbs<Dim - 1, Dim>& shape, int part, int first_control,
                 const SamplingOptions& options, int n_more, Samples<Dim>& out, std::vector<Vec<Dim>>& position, std::vector<double>& weight) {
  constexpr int param_dim = Dim - 1;
  const auto& nurbs = shape.nurbs;
  std::array<int, param_dim> n_points;
  for (int a = 0; a < param_dim; ++a)
    n_points[a] = n_more + (options.points_per_span > 0 ? options.points_per_span : nurbs.degree[a] + 1);
  const auto rule = shape.region ? shape.region->rule(*std::max_element(n_points.begin(), n_points.end()))
                                 : points_of_spans<Dim>(nurbs, n_points, options);
  BasisValues<param_dim> basis;
  for (size_t k = 0; k < rule.u.size(); ++k) {
    evaluate_basis(nurbs, rule.u[k], 1, basis);
    Vec<Dim> X = Vec<Dim>::Zero();
    Eigen::Matrix<double, Dim, param_dim> tangents = Eigen::Matrix<double, Dim, param_dim>::Zero();
    for (size_t e = 0; e < basis.column.size(); ++e) {
      const Vec<Dim> p = nurbs.control_points.col(basis.column[e]);
      X += basis.value[e] * p;
      for (int a = 0; a < param_dim; ++a) tangents.col(a) += basis.first[a][e] * p;
      if (basis.value[e] == 0) continue;
      out.column.push_back(first_control + basis.column[e]);
      out.value.push_back(basis.value[e]);
    }
    out.row.push_back(int(out.column.size()));
    out.u.push_back(rule.u[k]);
    out.part.push_back(part);
    position.push_back(X);
    weight.push_back(rule.weight[k] * DimTraits<Dim>::area_normal(tangents).norm());
  }
}

// Takes the samples from number `size` on away again.
template <int Dim>
void truncate(Samples<Dim>& samples, std::vector<Vec<Dim>>& position, std::vector<double>& weight, size_t size) {
  samples.row.resize(size + 1);
  samples.column.resize(samples.row.back());
  samples.value.resize(samples.row.back());
  samples.u.resize(size);
  samples.part.resize(size);
  position.resize(size);
  weight.resize(size);
}

// True if some of the weights from number `begin` on are zero beside the others.
bool some_vanish(const std::vector<double>& weight, size_t begin) {
  const auto [least, largest] = std::minmax_element(weight.begin() + begin, weight.end());
  return *least <= 1e-9 * *largest;
}

}  // namespace

template <int Dim>
Samples<Dim> sample_boundary(const Boundary<Dim>& boundary, const SamplingOptions& options) {
  if (options.points_per_span < 0 || options.points_per_span == 1)
    throw InputError("", "method.samples.points_per_span", std::to_string(options.points_per_span),
                     "0 (NURBS degree + 1), or at least 2");
  Samples<Dim> samples;
  std::vector<Vec<Dim>> position;
  std::vector<double> weight;
  samples.row.push_back(0);
  for (int i = 0; i < boundary.n_parts(); ++i) {
    samples.first.push_back(samples.size());
    for (const int n_more : {0, 2}) {
      truncate(samples, position, weight, size_t(samples.first.back()));
      append_part<Dim>(boundary.parts[i], i, boundary.first_control[i], options, n_more, samples,
                       position, weight);
      // The ends of spans may not count: that leaves too few in directions that collapse there.
      if (options.points_per_span > 0 || !some_vanish(weight, size_t(samples.first.back()))) break;
    }
  }
  samples.first.push_back(samples.size());
  samples.position.resize(Dim, samples.size());
  samples.weight.resize(samples.size());
  for (int s = 0; s < samples.size(); ++s) {
    samples.position.col(s) = position[s];
    samples.weight[s] = weight[s];
  }
  if (options.weight == SampleWeight::uniform)
    samples.weight.setConstant(samples.weight.sum() / samples.size());
  return samples;
}

template <int Dim>
Eigen::MatrixXd sample_jacobian(const Samples<Dim>& samples, int n_controls) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(samples.size(), n_controls);
  for (int s = 0; s < samples.size(); ++s)
    for (int e = samples.row[s]; e < samples.row[s + 1]; ++e)
      J(s, samples.column[e]) += samples.value[e];
  return J;
}

template Samples<2> sample_boundary<2>(const Boundary<2>&, const SamplingOptions&);
template Samples<3> sample_boundary<3>(const Boundary<3>&, const SamplingOptions&);
template Eigen::MatrixXd sample_jacobian<2>(const Samples<2>&, int);
template Eigen::MatrixXd sample_jacobian<3>(const Samples<3>&, int);

}  // namespace sem
