#pragma once
// All stages of a rest shape in one call.

#include <string>
#include <vector>

#include "sem/method/blending_weights.h"
#include "sem/method/map.h"
#include "sem/method/origins.h"
#include "sem/method/projection.h"
#include "sem/method/quadrature.h"
#include "sem/method/samples.h"
#include "sem/method/unknowns.h"

namespace sem {

/// The options of every stage.
struct MethodOptions {
  SamplingOptions sampling;
  RayOptions rays;
  IntervalOptions interval;
  WeightOptions weights;
  OriginChoice origins = OriginChoice::shared_parts;
  ProjectionOptions projection;
  int kept_columns = 0;     ///< draft eq. 14: columns of B kept per point, 0: all
  bool renormalise = true;  ///< after pruning
  int n_threads = 2;        ///< the results do not depend on it
};

/// Time that a stage took.
struct StageCost {
  std::string stage;
  double seconds = 0;
};

/// What every stage made of the rest shape.
template <int Dim>
struct Discretization {
  MethodOptions options;
  Boundary<Dim> boundary;
  Loops<Dim> loops;
  Samples<Dim> samples;
  Rays<Dim> rays;
  Quadrature<Dim> quadrature;
  DistanceWeights<Dim> theta;
  BlendingWeights<Dim> weights;
  Origins<Dim> origins;
  Projection<Dim> projection;
  Unknowns<Dim> unknowns;
  Map<Dim> interior;     ///< value and gradient at the quadrature points
  Map<Dim> on_boundary;  ///< value at the boundary samples
  PruneReport pruning;   ///< kept = 0: not asked for
  std::vector<StageCost> cost;
};

/// Runs the pipeline: parts -> samples -> quadrature -> weights -> origins ->
/// projection -> map. Throws InputError as its stages do.
template <int Dim>
Discretization<Dim> discretize(const std::vector<std::vector<Nurbs<Dim - 1, Dim>>>& solids,
                               const MethodOptions& options);

/// The map at other rest points, inside or on the boundary, by the same weights.
template <int Dim>
Map<Dim> map_at(const Discretization<Dim>& discretization, const Points<Dim>& position,
                bool with_gradient);

}  // namespace sem
