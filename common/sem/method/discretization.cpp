#include "sem/method/discretization.h"

#include <algorithm>
#include <utility>

#include "sem/base/error.h"
#include "sem/base/stopwatch.h"
#include "sem/method/material_weights.h"
#include "sem/method/resolved_rule.h"
#include "sem/method/sided_weight.h"

namespace sem {
namespace {

// Runs one stage and notes its time.
template <class Stage>
auto timed(std::vector<StageCost>& cost, const char* name, const Stage& stage) {
  const Stopwatch watch;
  auto result = stage();
  cost.push_back({name, watch.seconds()});
  return result;
}

template <int Dim>
struct Theta {
  Distances<Dim> distances;
  DistanceWeights<Dim> theta;
};

template <int Dim>
Theta<Dim> measure_theta(const Discretization<Dim>& d, const Points<Dim>& position) {
  const MethodOptions& options = d.options;
  const double longest =
      options.weights.sparsity ? std::numeric_limits<double>::infinity() : options.weights.cutoff;
  auto distances = measure_distances(d.boundary, d.loops, position, options.weights.variant, longest,
                                     options.n_threads);
  auto theta = distance_weights(distances, options.weights);
  if (options.formulation == Formulation::condensed)
    distance_weight_gradients(d.boundary, position, distances, theta);
  add_joint_patches(d.patches, d.boundary, distances, position, theta);
  add_part_layers(d.layers, d.boundary, distances, position, theta);
  keep_out_of_stiffer(options.stiffness, d.boundary, theta);
  return {std::move(distances), std::move(theta)};
}

// The samples' rows of J in terms of leaders and differences from them.
template <int Dim>
Samples<Dim> by_differences(Samples<Dim> samples, const std::vector<int>& leader) {
  const std::vector<int> column = std::move(samples.column), row = std::move(samples.row);
  const std::vector<double> value = std::move(samples.value);
  samples.row = {0};
  samples.column.clear();
  samples.value.clear();
  for (int s = 0; s < samples.size(); ++s) {
    for (int e = row[s]; e < row[s + 1]; ++e)
      for (int c = column[e];; c = leader[c]) {
        samples.column.push_back(c);
        samples.value.push_back(value[e]);
        if (c == leader[c]) break;
      }
    samples.row.push_back(int(samples.column.size()));
  }
  return samples;
}

// The paper's formulation: origins, projection, control points as unknowns.
template <int Dim>
void project_controls(Discretization<Dim>& d) {
  d.origins = timed(d.cost, "origins", [&] {
    return choose_origins(d.options.origins, d.weights, d.quadrature.weight, d.samples);
  });
  const auto leader = d.options.near_differences && d.followers.empty() ? leaders_of_near_controls(d.boundary) : std::vector<int>();
  d.projection = timed(d.cost, "projection", [&] {
    return project(leader.empty() ? d.samples : by_differences(d.samples, leader), d.origins, d.options.projection);
  });
  if (!leader.empty()) {
    d.unknowns = difference_unknowns(d.boundary, leader);
    return;
  }
  if (d.followers.empty()) {
    d.unknowns = control_point_unknowns(d.boundary);
    return;
  }
  std::vector<int> unknown_of;
  d.unknowns = leading_unknowns(d.boundary, d.followers, unknown_of);
  for (auto& fit : d.projection.parts)
    for (int& column : fit.columns) column = unknown_of[column];
  for (auto& group : d.projection.shared)
    for (int& column : group.columns) column = unknown_of[column];
}

// At a re-entrant joint the solution turns through more than half a circle, in every ring around it: levels do not
// help against that, two degrees more do (an L of two limbs, n = 3: 2.1 % off, with them 0.7 %, for 14 % more unknowns).
// Held joints gain nothing from it.
int degree_of(const JointPatch& patch, int n) { return patch.reentrant ? n + 2 : n; }

// Of the polynomials of all parts, patches and layers.
template <int Dim>
std::vector<int> degrees(const Discretization<Dim>& d) {
  std::vector<int> degree(size_t(d.boundary.n_parts()), d.options.projection.degree);
  for (const auto& patch : d.patches) degree.push_back(degree_of(patch, d.options.projection.degree));
  degree.insert(degree.end(), d.layers.size(), d.options.projection.degree);
  return degree;
}

// The condensed one: the coefficients are the unknowns.
template <int Dim>
void choose_coefficients(Discretization<Dim>& d) {
  // A function whose energy is below the rule's error is one that the rule cannot tell from none. Nor can rounding
  // beside a stiffness against changes of volume lambda / mu times that against shear; up to 10 (nu = 0.4545) is none.
  const double rounding = std::max(1e-10, 1e-9 * (d.options.volume_stiffness - 10));
  const bool resolved = d.options.interior_rule.rule == InteriorRule::resolved;
  const double tolerance = std::max(rounding, resolved ? 0.1 * d.options.interior_rule.weight_tolerance : 0.0);
  auto free = timed(d.cost, "coefficients", [&] {
    return free_coefficients(d.quadrature.position, d.quadrature.weight, d.weights,
                             degrees(d), tolerance);
  });
  d.origins = std::move(free.origins);
  d.projection = std::move(free.projection);
  d.unknowns = std::move(free.unknowns);
}

// Patches and layers with fewer points than twice the coefficients of a polynomial are left out.
template <int Dim>
void drop_unresolved(Discretization<Dim>& d) {
  if (d.patches.empty() && d.layers.empty()) return;
  const auto theta = measure_theta(d, d.quadrature.position).theta;
  std::vector<int> n_points(theta.n_parts, 0);
  for (const int part : theta.part) ++n_points[part];
  const auto degree = degrees(d);
  size_t part = size_t(d.boundary.n_parts());
  const auto drop_from = [&](auto& list) {
    std::erase_if(list, [&](const auto&) {
      const bool drop = n_points[part] < 2 * (Monomials<Dim>(degree[part]).size() + 1);
      ++part;
      return drop;
    });
  };
  drop_from(d.patches);
  drop_from(d.layers);
}

// 1 + the squares of the Legendre polynomials P_n of each coordinate on the box, of mean 1: what products of
// the polynomials of degree n vary like there.
template <int Dim>
double polynomial_variation(const Box<Dim>& box, int n, const Vec<Dim>& X) {
  double sum = 1;
  for (int a = 0; a < Dim; ++a) {
    const double t = (2 * X[a] - box.lower[a] - box.upper[a]) / (box.upper[a] - box.lower[a]);
    double before = 1, P = t;
    for (int k = 2; k <= n; ++k) before = std::exchange(P, ((2 * k - 1) * t * P - (k - 1) * before) / k);
    sum += (2 * n + 1) * P * P;
  }
  return sum;
}

// Where a part's weight can act: its box, larger by the cutoff on all sides, cut by that of all parts.
template <int Dim>
std::vector<Box<Dim>> support_boxes(const Discretization<Dim>& d) {
  std::vector<Box<Dim>> boxes;
  const auto add = [&](const Box<Dim>& part, double reach) {
    Box<Dim> box;
    box.lower = (part.lower.array() - reach).matrix().cwiseMax(d.boundary.box.lower);
    box.upper = (part.upper.array() + reach).matrix().cwiseMin(d.boundary.box.upper);
    boxes.push_back(box);
  };
  for (const auto& part : d.boundary.parts) add(part.box, d.options.weights.cutoff);
  for (const auto& patch : d.patches) boxes.push_back(support_of(patch, d.boundary));
  for (const auto& layer : d.layers) add(d.boundary.parts[layer.part].box, layer.reach);
  return boxes;
}

// What the interior rule has to resolve of every weight: w^2 and rho^2 |grad w|^2, rho the distance
// to the part, at most a quarter of its reach: at the joint of two parts grad w grows like 1 /
// distance, where their polynomials agree.
template <int Dim>
Indicators weight_indicators(const Discretization<Dim>& d, const Points<Dim>& position) {
  const auto [distances, theta] = measure_theta(d, position);
  const auto weights = blending_weights(theta, d.boundary, position);
  const auto supports = support_boxes(d);
  const auto degree = degrees(d);
  Indicators values;
  values.n = 2 * theta.n_parts;
  values.begin.push_back(0);
  for (int k = 0; k < weights.n_points(); ++k) {
    const auto first_pair = distances.part.begin() + distances.begin[k], last_pair = distances.part.begin() + distances.begin[k + 1];
    for (int e = weights.begin[k]; e < weights.begin[k + 1]; ++e) {
      const int i = weights.part[e], patch = i - d.boundary.n_parts(), layer = patch - int(d.patches.size());
      double rho = 0;
      if (patch >= 0 && layer < 0) {
        rho = d.patches[patch].radius;
      } else {
        const auto pair = std::find(first_pair, last_pair, layer >= 0 ? d.layers[layer].part : i);
        const double reach = layer >= 0 ? d.layers[layer].reach : theta.cutoff;
        if (pair != last_pair) rho = std::min(distances.closest[pair - distances.part.begin()], reach / 4);
      }
      const double variation = polynomial_variation<Dim>(supports[i], degree[i], position.col(k));
      values.index.push_back(2 * i);
      values.value.push_back(variation * weights.w[e] * weights.w[e]);
      if (weights.gradient.empty()) continue;
      values.index.push_back(2 * i + 1);
      values.value.push_back(variation * rho * rho * weights.gradient[e].squaredNorm());
    }
    values.begin.push_back(int(values.index.size()));
  }
  return values;
}

template <int Dim>
Quadrature<Dim> resolve_weights(Discretization<Dim>& d) {
  ResolvedOptions options;
  options.axis = d.options.rays.axis;
  options.points = std::max(3, d.options.projection.degree + 1);
  options.tolerance = d.options.interior_rule.weight_tolerance;
  // Where weights are smooth a few points would do for them, but not for all the functions they carry. With 2 to 8 a
  // function an L of two limbs is up to 0.9 % off (n = 4), with 12 its error falls with the degree and the parts.
  constexpr int points_per_function = 12;
  if (d.options.formulation == Formulation::condensed)
    for (const int degree : degrees(d)) options.min_points += points_per_function * (Monomials<Dim>(degree).size() + 1);
  auto rule = resolved_rule<Dim>(
      d.boundary, d.loops, [&](const Points<Dim>& X) { return weight_indicators(d, X); }, options,
      d.options.n_threads);
  d.interior_report.error = rule.error;
  return std::move(rule.quadrature);
}

// Positions are rounded to 1e-16 of the size: nothing is left of strains across less than this.
template <int Dim>
void require_thickness(const Boundary<Dim>& boundary) {
  constexpr double least = 1e-10;
  const double share = (boundary.box.upper - boundary.box.lower).minCoeff() / boundary.box.diagonal();
  if (share < least)
    throw InputError("", "solids", "no interior: a body thinner than 1e-10 of its size",
                     "parts that enclose an interior");
}

}  // namespace

template <int Dim>
Discretization<Dim> discretize(const std::vector<std::vector<Nurbs<Dim - 1, Dim>>>& solids,
                               const MethodOptions& options, const std::vector<TrimLoops>& trims) {
  Discretization<Dim> d;
  const int n_threads = options.n_threads;
  d.options = options;
  d.boundary = timed(d.cost, "parts", [&] { return make_boundary<Dim>(solids, trims); });
  require_thickness(d.boundary);
  d.loops = timed(d.cost, "loops", [&] { return find_loops(d.boundary); });
  d.samples = timed(d.cost, "boundary samples",
                    [&] { return sample_boundary(d.boundary, options.sampling); });
  d.followers = find_followers(d.boundary, d.samples);
  substitute(d.followers, d.samples);
  d.rays = timed(d.cost, "rays",
                 [&] { return cast_rays(d.boundary, d.loops, options.rays, n_threads); });
  const bool resolved = options.interior_rule.rule == InteriorRule::resolved;
  if (resolved && options.weights.sparsity)
    throw InputError("", "method.weights.sparsity", "a sparsity with quadrature 'resolved'", "a cutoff");
  if (resolved && (options.interior_rule.fit > 0 || options.interior_rule.compress > 0))
    throw InputError("", "method.quadrature.method", "'resolved' with fit or compress",
                     "one of the other rules: moments do not tell where weights have kinks");
  if (options.formulation == Formulation::condensed)
    d.patches = find_joint_patches(d.boundary, d.loops, options.condition, options.weights.cutoff, options.patch_levels);
  if (options.formulation == Formulation::condensed && options.weights.variant == DistanceWeight::sided)
    d.layers = find_part_layers(d.boundary, options.weights.cutoff, options.layers);
  d.quadrature = timed(d.cost, "interior quadrature", [&] {
    return resolved ? resolve_weights(d)
                    : interior_rule(d.boundary, d.loops, d.rays, options.interval,
                                    options.interior_rule, d.interior_report);
  });
  drop_unresolved(d);
  d.theta = timed(d.cost, "distance weights", [&] {
    return measure_theta(d, d.quadrature.position).theta;
  });
  // From here on the cutoff is a length, also where a sparsity was asked for.
  d.options.weights.cutoff = d.theta.cutoff;
  d.options.weights.sparsity.reset();
  d.weights = timed(d.cost, "blending weights",
                    [&] { return blending_weights(d.theta, d.boundary, d.quadrature.position); });
  if (options.formulation == Formulation::condensed)
    choose_coefficients(d);
  else
    project_controls(d);
  d.interior = timed(d.cost, "interior map", [&] {
    return blended_map(d.quadrature.position, d.weights, d.origins, d.projection, d.unknowns.size(),
                       true, n_threads);
  });
  d.on_boundary =
      timed(d.cost, "boundary map", [&] { return map_at(d, d.samples.position, false); });
  if (options.formulation == Formulation::condensed)
    d.unknowns.S = boundary_output(d.samples, d.on_boundary, d.boundary.n_controls());
  if (options.formulation == Formulation::condensed) follow(d.followers, d.unknowns.S);
  if (options.kept_columns < 0)
    throw InputError("", "method.kept_columns", std::to_string(options.kept_columns),
                     "0 (all) or more");
  if (options.kept_columns > 0)
    d.pruning = timed(d.cost, "pruning",
                      [&] { return prune(d.interior, options.kept_columns, options.renormalise); });
  return d;
}

template <int Dim>
BoundaryRule<Dim> boundary_rule(const Discretization<Dim>& d) {
  SamplingOptions options{DimTraits<Dim>::boundary_points, SampleWeight::measure, SampleRule::gauss};
  for (const auto& patch : d.patches) options.end_halvings = std::max(options.end_halvings, patch.level + 2);
  if (d.options.formulation == Formulation::projected) {
    int highest = 1;
    for (const auto& part : d.boundary.parts)
      for (const int degree : part.nurbs.degree) highest = std::max(highest, degree);
    options = {highest + 5, SampleWeight::measure, SampleRule::gauss_lobatto, 0};
  }
  BoundaryRule<Dim> rule;
  rule.samples = sample_boundary(d.boundary, options);
  if (d.boundary_factor.size() > 0) rule.samples.weight.array() *= d.boundary_factor.array();
  rule.normal.resize(Dim, rule.samples.size());
  for (int s = 0; s < rule.samples.size(); ++s) {
    const int part = rule.samples.part[s];
    rule.normal.col(s) = d.loops.orientation[part] * unit_normal(d.boundary.parts[part].nurbs, rule.samples.u[s]);
  }
  return rule;
}

template <int Dim>
int append_columns(Discretization<Dim>& d, int n) {
  auto& unknowns = d.unknowns;
  const int first = unknowns.size(), size = first + n;
  unknowns.rest.conservativeResizeLike(Points<Dim>::Zero(Dim, size));
  unknowns.one.conservativeResizeLike(Eigen::VectorXd::Zero(size));
  if (unknowns.S.size() > 0)
    unknowns.S.conservativeResizeLike(Eigen::MatrixXd::Zero(unknowns.S.rows(), size));
  d.interior.n_columns = d.on_boundary.n_columns = size;
  return first;
}

template <int Dim>
Map<Dim> map_at(const Discretization<Dim>& d, const Points<Dim>& position, bool with_gradient) {
  const auto theta = measure_theta(d, position).theta;
  return blended_map(position, blending_weights(theta, d.boundary, position), d.origins,
                     d.projection, d.unknowns.size(), with_gradient, d.options.n_threads);
}

template <int Dim>
Eigen::MatrixXd field_at(const Discretization<Dim>& d, const BlendedField<Dim>& field,
                         const Points<Dim>& position) {
  const auto theta = measure_theta(d, position).theta;
  return dense_value(blended_map(position, blending_weights(theta, d.boundary, position), field.origins,
                                 field.projection, field.n_functions, false, d.options.n_threads));
}

template Discretization<2> discretize<2>(const std::vector<std::vector<Nurbs<1, 2>>>&,
                                         const MethodOptions&, const std::vector<TrimLoops>&);
template Discretization<3> discretize<3>(const std::vector<std::vector<Nurbs<2, 3>>>&,
                                         const MethodOptions&, const std::vector<TrimLoops>&);
template BoundaryRule<2> boundary_rule<2>(const Discretization<2>&);
template BoundaryRule<3> boundary_rule<3>(const Discretization<3>&);
template int append_columns<2>(Discretization<2>&, int);
template int append_columns<3>(Discretization<3>&, int);
template Eigen::MatrixXd field_at<2>(const Discretization<2>&, const BlendedField<2>&, const Points<2>&);
template Eigen::MatrixXd field_at<3>(const Discretization<3>&, const BlendedField<3>&, const Points<3>&);
template Map<2> map_at<2>(const Discretization<2>&, const Points<2>&, bool);
template Map<3> map_at<3>(const Discretization<3>&, const Points<3>&, bool);

}  // namespace sem
