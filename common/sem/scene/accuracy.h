#pragma once
// What a model knows of its own errors before anything is solved.

#include <nlohmann/json_fwd.hpp>

#include "sem/method/boundary_integrals.h"
#include "sem/scene/model.h"

namespace sem {

/// What a stage may have got wrong.
struct StageError {
  std::string stage;    ///< as in the cost
  double error;         ///< dimensionless; 0: exact
  std::string meaning;
};

template <int Dim>
struct Accuracy {
  Vec<Dim> about = Vec<Dim>::Zero();  ///< point of the moments: the middle of the model's box
  Moments<Dim> boundary, quadrature;  ///< the boundary integral's truth and the rule's own
  double volume_error = 0;            ///< relative
  double first_moment_error = 0;      ///< relative to volume times size
  double second_moment_error = 0;     ///< relative to volume times size squared
  double high_moment_error = 0;       ///< largest of all moments to degree 6, relative to the integral of the magnitude
  double energy_change = 0;           ///< by fit and compression: relative change of a test deformation's strain energy
  InteriorReport<Dim> report;         ///< how the rule came about
  double uncovered_share = 0;         ///< volume share of points where all theta vanish
  double gap_share = 0;               ///< share of the inside whose ends are closed gaps
  double identity_error = 0;          ///< largest |x(X) - X| of the undeformed map, by the size
  double identity_gradient_error = 0; ///< largest |F - I| of the undeformed map
  double partition_error = 0;         ///< largest |sum of a point's weights - 1|
  double boundary_map_error = 0;      ///< largest |x(X) - X| at the boundary samples at rest, by the size
  double unpaired_share = 0;          ///< of the rays
  double worst_fit_condition = 0;     ///< over the parts' linear fits
  int n_borrowed = 0;                 ///< parts whose linear fit borrowed from their origin's set
  double divergence_defect = 0;       ///< condensed: Model::divergence_defect
  double pruning_error = 0;           ///< draft eq. 14, 0 without
};

/// Linear strain energy of a test deformation by a rule, with the map evaluated at its points and the solids' own
/// materials, J (2D: per thickness). The control points are bent: with xi = (X - middle of the box) / (size / 2),
/// u_a = size / 40 (xi_b^2 + xi_a xi_b), b = a + 1 (cyclic); other unknowns follow them in the least-squares sense.
template <int Dim>
double test_energy(const Model<Dim>& model, const Quadrature<Dim>& rule);

template <int Dim>
Accuracy<Dim> measure_accuracy(const Model<Dim>& model);

/// Volume share of the quadrature points where the map turns over in the state z: det dx/dX <= 0 of x(X) itself. The
/// paper's F leaves the weights' gradients out and does not see it; there dx/dX comes from differences of x.
template <int Dim>
double folded_share(const Model<Dim>& model, const Eigen::VectorXd& z);

/// One line for each stage that has run and can err; stages that are exact or that nothing measures have none.
template <int Dim>
std::vector<StageError> stage_errors(const std::vector<StageCost>& cost, const Accuracy<Dim>& accuracy);

/// As it stands in summary.json and `info --json`.
template <int Dim>
nlohmann::ordered_json to_json(const Accuracy<Dim>& accuracy);

}  // namespace sem
