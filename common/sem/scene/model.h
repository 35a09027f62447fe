#pragma once
// From a scene to what the solvers need.

#include <memory>

#include "sem/mechanics/internal_energy.h"
#include "sem/scene/analysis.h"
#include "sem/scene/pins.h"
#include "sem/solve/system.h"

namespace sem {

/// The discretised body of a scene with its energy, mass, loads and pins.
template <int Dim>
struct Model {
  Model() = default;
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  Discretization<Dim> discretization;
  double divergence_defect = 0;     ///< condensed: that of the rule alone (consistent_weights.h); infinity: weights are as they were
  MaterialField materials;
  Eigen::VectorXd point_mass;       ///< #points, kg: density times v_k
  SymmetricMatrix stability;        ///< scalar error form, without gamma; empty if condensed
  double stability_stiffness = 0;   ///< gamma used, Pa/m
  BlendedField<Dim> pressure;       ///< functions of the materials' own pressure; none: 0 functions
  std::unique_ptr<InternalEnergy<Dim>> energy;
  System system;                    ///< refers to energy; its mass is scalar, kinetic stability term included
  State initial;
  LoadInTime load;                  ///< system.load is its mean, or in a dynamic analysis the present one
  Eigen::VectorXd target;           ///< z with the pins where they are led
  PinPath path;                     ///< of the pins to there; empty if none turns
  std::vector<Held> held;           ///< per pin
  std::vector<StageCost> cost;      ///< all stages, those of the discretisation first

  double total_mass() const { return point_mass.sum(); }
  int n_unknowns() const { return int(system.free.size()); }
  /// Of the maps, the projection and the matrices, 1e6 bytes; an estimate from the numbers of entries.
  double megabytes() const;
  /// What march() calls before a step; empty if the load is constant.
  std::function<void(double)> set_load() {
    if (load.periodic.empty()) return {};
    return [this](double time) { system.load = load.at(time); };
  }
};

/// True if the material has a pressure of its own (mechanics/pressure.h) under these options.
bool has_own_pressure(const MethodOptions& options, const Material& material);

/// Runs the pipeline on the scene. Throws InputError, naming `file` and the
/// field, for what only shows now: an empty interior, a pin or load that
/// matches nothing, nothing left free, a probe outside of the body.
template <int Dim>
std::unique_ptr<Model<Dim>> build_model(const Scene<Dim>& scene, const std::string& file);

}  // namespace sem
