#include "sem/method/discretization.h"

#include <chrono>

#include "sem/base/error.h"

namespace sem {
namespace {

// Runs one stage and notes its time.
template <class Stage>
auto timed(std::vector<StageCost>& cost, const char* name, const Stage& stage) {
  const auto start = std::chrono::steady_clock::now();
  auto result = stage();
  cost.push_back({name, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()});
  return result;
}

template <int Dim>
DistanceWeights<Dim> measure_theta(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                                   const Points<Dim>& position, const WeightOptions& options,
                                   int n_threads) {
  const double longest = options.sparsity ? std::numeric_limits<double>::infinity() : options.cutoff;
  return distance_weights(
      measure_distances(boundary, loops, position, options.variant, longest, n_threads), options);
}

}  // namespace

template <int Dim>
Discretization<Dim> discretize(const std::vector<std::vector<Nurbs<Dim - 1, Dim>>>& solids,
                               const MethodOptions& options) {
  Discretization<Dim> d;
  const int n_threads = options.n_threads;
  d.options = options;
  d.boundary = timed(d.cost, "parts", [&] { return make_boundary<Dim>(solids); });
  d.loops = timed(d.cost, "loops", [&] { return find_loops(d.boundary); });
  d.samples = timed(d.cost, "boundary samples", [&] { return sample_boundary(d.boundary, options.sampling); });
  d.rays = timed(d.cost, "rays", [&] { return cast_rays(d.boundary, d.loops, options.rays, n_threads); });
  d.quadrature = timed(d.cost, "interior quadrature", [&] { return quadrature_on_rays(d.rays, options.interval); });
  d.theta = timed(d.cost, "distance weights", [&] {
    return measure_theta(d.boundary, d.loops, d.quadrature.position, options.weights, n_threads);
  });
  // From here on the cutoff is a length, also where a sparsity was asked for.
  d.options.weights.cutoff = d.theta.cutoff;
  d.options.weights.sparsity.reset();
  d.weights = timed(d.cost, "blending weights", [&] {
    return blending_weights(d.theta, d.boundary, d.quadrature.position);
  });
  d.origins = timed(d.cost, "origins", [&] {
    return choose_origins(options.origins, d.weights, d.quadrature.weight, d.samples);
  });
  d.projection = timed(d.cost, "projection", [&] { return project(d.samples, d.origins, options.projection); });
  d.unknowns = control_point_unknowns(d.boundary);
  d.interior = timed(d.cost, "interior map", [&] {
    return blended_map(d.quadrature.position, d.weights, d.origins, d.projection,
                       d.unknowns.size(), true, n_threads);
  });
  d.on_boundary = timed(d.cost, "boundary map", [&] { return map_at(d, d.samples.position, false); });
  if (options.kept_columns < 0)
    throw InputError("", "method.kept_columns", std::to_string(options.kept_columns), "0 (all) or more");
  if (options.kept_columns > 0)
    d.pruning = timed(d.cost, "pruning", [&] { return prune(d.interior, options.kept_columns, options.renormalise); });
  return d;
}

template <int Dim>
Map<Dim> map_at(const Discretization<Dim>& d, const Points<Dim>& position, bool with_gradient) {
  const auto theta =
      measure_theta(d.boundary, d.loops, position, d.options.weights, d.options.n_threads);
  return blended_map(position, blending_weights(theta, d.boundary, position), d.origins,
                     d.projection, d.unknowns.size(), with_gradient, d.options.n_threads);
}

template Discretization<2> discretize<2>(const std::vector<std::vector<Nurbs<1, 2>>>&, const MethodOptions&);
template Discretization<3> discretize<3>(const std::vector<std::vector<Nurbs<2, 3>>>&, const MethodOptions&);
template Map<2> map_at<2>(const Discretization<2>&, const Points<2>&, bool);
template Map<3> map_at<3>(const Discretization<3>&, const Points<3>&, bool);

}  // namespace sem
