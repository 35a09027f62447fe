#pragma once
// A scene: solids, method, loads, pins, probes and one analysis. Plain data,
// filled from JSON (read_scene.h) or in code.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sem/mechanics/material.h"
#include "sem/method/discretization.h"
#include "sem/solve/integrators.h"

namespace sem {

/// All components, of what may be given for some.
template <int Dim>
constexpr std::array<bool, Dim> every_axis() {
  std::array<bool, Dim> axes{};
  for (bool& axis : axes) axis = true;
  return axes;
}

template <int Dim>
struct ScenePart {
  std::string name;  ///< "left.1"; the text before a dot is a group
  Nurbs<Dim - 1, Dim> shape;
  std::optional<Material> material = {};  ///< in place of the solid's, where this part's distance weight (theta) is the largest
  TrimLoops trims = {};  ///< 3D: what the shape is trimmed to (method/trims.h); none: all of it
  std::optional<std::array<double, 3>> color = {};  ///< red, green, blue in [0, 1], linear; for files that keep it
};

template <int Dim>
struct SceneSolid {
  std::string name;
  Material material;
  std::vector<ScenePart<Dim>> parts;
};

/// Which parts or control points: all that match every criterion given.
template <int Dim>
struct Selector {
  std::string part;               ///< part or group name, "solid/part" to tell solids apart; empty: any
  std::optional<Box<Dim>> box;    ///< control points (pins) or boundary points (loads) at rest in the box
  std::vector<int> control_points;  ///< indices within the part (pins only); empty: any
};

template <int Dim>
struct Pin {
  Selector<Dim> where;
  std::array<bool, Dim> axes;                  ///< components held
  /// Prescribed: at load factor s (statics), or at s = r^2 (3 - 2 r) with r = time / duration up to 1 (dynamics),
  /// a point X of the pin stands at center + R(s rotation) (X - center) + s displacement.
  Vec<Dim> displacement = Vec<Dim>::Zero();  ///< m
  Vec<DimTraits<Dim>::n_rotations> rotation = Vec<DimTraits<Dim>::n_rotations>::Zero();  ///< rad, angle times axis
  Vec<Dim> center = Vec<Dim>::Zero();        ///< m
  double duration = 0;                       ///< s, > 0 if it moves in a dynamic analysis, else 0
  bool moves() const { return !displacement.isZero(0) || !rotation.isZero(0); }
};

/// A load times 1 + amplitude sin(2 pi t / period) in a dynamic analysis, as it is in the others.
struct Oscillation {
  double amplitude = 0;  ///< 0: constant
  double period = 1;     ///< s, > 0
};

/// Dead loads; 2D: per unit thickness.
template <int Dim>
struct PointLoad {
  Vec<Dim> at, force;  ///< m, N: on the map at a rest point
  int index = 0;       ///< in the scene's list of loads, for messages
  Oscillation oscillation = {};
};
template <int Dim>
struct BoundaryLoad {
  Selector<Dim> where;
  Vec<Dim> traction = Vec<Dim>::Zero();  ///< N per m (2D) or m^2
  double pressure = 0;                   ///< Pa, pushes against the outward rest normal
  int index = 0;
  Oscillation oscillation = {};
};
template <int Dim>
struct BodyLoad {
  std::string solid;  ///< empty: all
  Vec<Dim> force;     ///< N/m^3
  int index = 0;
  Oscillation oscillation = {};
};

enum class ProbeKind { displacement, stress, reaction };
template <int Dim>
struct Probe {
  std::string name;
  ProbeKind kind = ProbeKind::displacement;
  Vec<Dim> at = Vec<Dim>::Zero();  ///< rest point (displacement, Cauchy stress)
  int pin = 0;                     ///< index into pins (reaction: force on the body by the pin, N)
  std::optional<Vec<Dim>> truth = {};  ///< m: the exact displacement at the end, if known; for the report
  std::array<bool, Dim> truth_axes = every_axis<Dim>();  ///< components of it that are known
};

enum class AnalysisKind { statics, dynamics, modes };
struct Analysis {
  AnalysisKind kind = AnalysisKind::dynamics;
  // dynamics
  Integrator integrator = Integrator::linearly_implicit_euler;
  double time_step = 0.01;  ///< s
  double duration = 1;      ///< s
  // statics
  int load_steps = 1;
  int max_iterations = 50;
  double tolerance = 1e-9;  ///< relative residual
  // modes
  int n_modes = 6;
};

struct OutputOptions {
  double frame_rate = 30;         ///< frames per second of simulated time; 0: none
  int width = 800, height = 600;  ///< pixels
  std::optional<Box<2>> view;     ///< m, what a frame shows; none: the rest shape with room around it
  bool error_estimate = true;     ///< repeats the run with varied settings (summary.json, accuracy)
  double checkpoint_interval = 1; ///< simulated seconds between checkpoints; 0: only at the end
};

template <int Dim>
struct Scene {
  std::string name, description;
  std::vector<SceneSolid<Dim>> solids;
  MethodOptions method;
  double stability_stiffness = 0;  ///< gamma, Pa/m; 0: 10 n^2 E / h, h: mean size of a part
  double clamp_penalty = 20;       ///< beta / n^2 of the condensed formulation's clamps (clamps.h)
  double kinetic_length = 0;       ///< l of the kinetic stability term, m; 0: off
  Vec<Dim> gravity = Vec<Dim>::Zero();  ///< m/s^2
  std::vector<PointLoad<Dim>> point_loads;
  std::vector<BoundaryLoad<Dim>> boundary_loads;
  std::vector<BodyLoad<Dim>> body_loads;
  std::vector<Pin<Dim>> pins;
  Vec<Dim> velocity = Vec<Dim>::Zero();  ///< m/s, initial
  double angular_velocity = 0;           ///< rad/s, initial, about the centroid (2D; about z in 3D)
  std::vector<Probe<Dim>> probes;
  double accuracy_seconds = 60;  ///< what refining to `accuracy` may take
  double accuracy = 0;  ///< relative error of the probes (frequencies) that the scene is refined to (accuracy_goal.h); 0: as given
  Analysis analysis;
  OutputOptions output;
};

}  // namespace sem
