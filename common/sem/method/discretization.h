#pragma once
// All stages of a rest shape in one call.

#include <string>
#include <vector>

#include "sem/method/blending_weights.h"
#include "sem/method/coefficients.h"
#include "sem/method/followers.h"
#include "sem/method/interior_rule.h"
#include "sem/method/joint_patches.h"
#include "sem/method/map.h"
#include "sem/method/origins.h"
#include "sem/method/part_layers.h"
#include "sem/method/projection.h"
#include "sem/method/samples.h"
#include "sem/method/unknowns.h"

namespace sem {

enum class Formulation {
  projected,  ///< the paper's: unknowns are the control points, c = Pi p, diffuse gradient
  condensed,  ///< unknowns are the coefficients, exact gradient, control points follow (coefficients.h)
};

/// Which materials get a pressure of its own in the condensed formulation, the means against locking
/// (mechanics/pressure.h).
enum class OwnPressure { automatic /* Poisson's ratio from 0.4 on */, always /* above 0 */, never };

/// Levels of patches that scenes of the condensed formulation have unless they say otherwise. 3D: along an edge they
/// need many more points, on request only.
template <int Dim>
inline constexpr int usual_patch_levels = 4;
template <>
inline constexpr int usual_patch_levels<3> = 0;

/// Layers that scenes of the condensed formulation have unless they say otherwise.
inline constexpr int usual_layers = 4;

/// The options of every stage.
struct MethodOptions {
  Formulation formulation = Formulation::projected;
  SamplingOptions sampling;
  RayOptions rays;
  IntervalOptions interval;
  InteriorOptions interior_rule;
  WeightOptions weights;
  std::vector<double> stiffness = {};  ///< #parts: of their materials (material_weights.h); empty: all alike
  double volume_stiffness = 1;  ///< condensed: largest lambda / mu of the materials (choose_coefficients)
  int patch_levels = 0;     ///< of patches at joints, condensed only (joint_patches.h)
  int layers = 0;           ///< at most, of parts that are small beside the cutoff; condensed, sided only (part_layers.h)
  std::vector<int> condition = {};  ///< #parts: as find_joint_patches has it; empty: all are held and loaded alike
  OwnPressure own_pressure = OwnPressure::automatic;
  OriginChoice origins = OriginChoice::shared_parts;
  bool near_differences = false;  ///< projected: control points across a sliver by differences (difference_unknowns)
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
  Samples<Dim> samples;      ///< J in terms of the control points that do not follow others
  Followers<Dim> followers;  ///< control points that trims leave without samples
  Rays<Dim> rays;
  Quadrature<Dim> quadrature;
  InteriorReport<Dim> interior_report;
  std::vector<JointPatch> patches;  ///< condensed: further parts of theta and weights
  std::vector<PartLayer> layers;    ///< and these after them
  DistanceWeights<Dim> theta;
  BlendingWeights<Dim> weights;
  Origins<Dim> origins;
  Projection<Dim> projection;
  Unknowns<Dim> unknowns;
  Map<Dim> interior;     ///< value and gradient at the quadrature points
  Map<Dim> on_boundary;  ///< value at the boundary samples
  Eigen::VectorXd boundary_factor;  ///< of boundary_rule's weights; empty: 1. See mechanics/consistent_weights.h
  PruneReport pruning;   ///< kept = 0: not asked for
  std::vector<StageCost> cost;
};

/// Runs the pipeline: parts -> samples -> quadrature -> weights -> origins ->
/// projection -> map. `trims` of the parts as in make_boundary. Throws InputError as its stages do.
template <int Dim>
Discretization<Dim> discretize(const std::vector<std::vector<Nurbs<Dim - 1, Dim>>>& solids,
                               const MethodOptions& options, const std::vector<TrimLoops>& trims = {});

/// Points of the boundary at which loads and clamps act on the map, and their outward unit normals.
template <int Dim>
struct BoundaryRule {
  Samples<Dim> samples;
  Points<Dim> normal;
};
/// Condensed: many Gauss points, as weights have kinks; projected: Gauss-Lobatto, NURBS degree + 5.
template <int Dim>
BoundaryRule<Dim> boundary_rule(const Discretization<Dim>& discretization);

/// Adds n columns to the unknowns that neither the map nor the boundary output depends on, rest value
/// 0: room for what else a formulation needs (the displacements of pins). Returns the first one.
template <int Dim>
int append_columns(Discretization<Dim>& discretization, int n);

/// The map at other rest points, inside or on the boundary, by the same weights.
template <int Dim>
Map<Dim> map_at(const Discretization<Dim>& discretization, const Points<Dim>& position,
                bool with_gradient);

/// Functions of a blended field at other rest points: values, dense, #points by #functions.
template <int Dim>
Eigen::MatrixXd field_at(const Discretization<Dim>& discretization, const BlendedField<Dim>& field,
                         const Points<Dim>& position);

}  // namespace sem
