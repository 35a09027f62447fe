#pragma once
// From a scene to what the solvers need.

#include <memory>

#include "sem/mechanics/internal_energy.h"
#include "sem/scene/scene.h"
#include "sem/solve/system.h"

namespace sem {

/// What a pin holds.
struct Held {
  std::vector<int> controls;  ///< control points, ascending
  std::vector<int> entries;   ///< of z: those of the held components, ascending
};

/// The discretised body of a scene with its energy, mass, loads and pins.
template <int Dim>
struct Model {
  Model() = default;
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  Discretization<Dim> discretization;
  MaterialField materials;
  Eigen::VectorXd point_mass;       ///< #points, kg: density times v_k
  Eigen::MatrixXd mass;             ///< scalar mass matrix, kinetic stability term included
  Eigen::MatrixXd stability;        ///< scalar error form, without gamma
  double stability_stiffness = 0;   ///< gamma used, Pa/m
  BlendedField<Dim> pressure;       ///< functions of the materials' own pressure; none: 0 functions
  std::unique_ptr<InternalEnergy<Dim>> energy;
  System system;                    ///< refers to energy
  State initial;
  Eigen::VectorXd target;           ///< z with the prescribed displacements of the pins
  std::vector<Held> held;           ///< per pin
  std::vector<StageCost> cost;      ///< all stages, those of the discretisation first

  double total_mass() const { return point_mass.sum(); }
  int n_unknowns() const { return int(system.free.size()); }
};

/// True if the material has a pressure of its own (mechanics/pressure.h) under these options.
bool has_own_pressure(const MethodOptions& options, const Material& material);

/// Runs the pipeline on the scene. Throws InputError, naming `file` and the
/// field, for what only shows now: an empty interior, a pin or load that
/// matches nothing, nothing left free, a probe outside of the body.
template <int Dim>
std::unique_ptr<Model<Dim>> build_model(const Scene<Dim>& scene, const std::string& file);

/// True if the name, one of its groups (the text before a dot) or "solid/" and any of these is the selector's part.
bool matches_part(const std::string& selected, const std::string& solid, const std::string& part);

}  // namespace sem
