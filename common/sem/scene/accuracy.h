#pragma once
// What a model knows of its own errors before anything is solved.

#include <nlohmann/json_fwd.hpp>

#include "sem/method/boundary_integrals.h"
#include "sem/scene/model.h"

namespace sem {

template <int Dim>
struct Accuracy {
  Vec<Dim> about = Vec<Dim>::Zero();  ///< point of the moments: the middle of the model's box
  Moments<Dim> boundary, quadrature;  ///< the boundary integral's truth and the rule's own
  double volume_error = 0;            ///< relative
  double first_moment_error = 0;      ///< relative to volume times size
  double second_moment_error = 0;     ///< relative to volume times size squared
  double uncovered_share = 0;         ///< volume share of points where all theta vanish
  double gap_share = 0;               ///< share of the inside whose ends are closed gaps
  double identity_error = 0;          ///< largest |x(X) - X| of the undeformed map, by the size
  double identity_gradient_error = 0; ///< largest |F - I| of the undeformed map
  double worst_fit_condition = 0;     ///< over the parts' linear fits
  int n_borrowed = 0;                 ///< parts whose linear fit borrowed from their origin's set
  double pruning_error = 0;           ///< draft eq. 14, 0 without
};

template <int Dim>
Accuracy<Dim> measure_accuracy(const Model<Dim>& model);

/// As it stands in summary.json and `info --json`.
template <int Dim>
nlohmann::ordered_json to_json(const Accuracy<Dim>& accuracy);

}  // namespace sem
