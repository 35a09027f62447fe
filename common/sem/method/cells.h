#pragma once
// Cells: pieces of the inside that a family of strands fills smoothly, so that few strands at
// Gauss points integrate smooth functions over them. Each cell learns how many it needs.

#include <functional>
#include <optional>

#include "sem/method/smooth_integrands.h"
#include "sem/method/strands.h"

namespace sem {

/// n strands (3D: n in each of two directions) of a rule that fills the cell, n >= 1; empty where the family breaks down
/// (intervals that come and go, a fan that folds back).
template <int Dim>
using StrandFamily = std::function<Strands<Dim>(int n)>;

/// By what cells are measured.
template <int Dim>
struct Yardstick {
  SmoothIntegrands<Dim> integrands;
  Eigen::VectorXd scale;  ///< integrals over the component that errors are relative to; scale[0]:
                          ///< its area or volume
  double tolerance;       ///< relative error that the rule aims at
};

/// What n = 1, 2, ... strands make of a cell.
template <int Dim>
struct Cell {
  struct Trial {
    Strands<Dim> strands;  ///< of the family's n = 1, 2, ...
    Eigen::VectorXd deviation;  ///< integrals minus the reference, relative
    double error;               ///< the largest of them
  };
  Eigen::VectorXd reference;  ///< integrals of the integrands, to rounding
  std::vector<Trial> trials;  ///< trials[n - 1]: the family's n
  bool fitted = false;        ///< the last trial is accurate enough

  int n_strands() const { return int(trials.size()); }
};

/// A cell that is not fitted even with this many strands should be halved.
constexpr int most_strands = 16;

/// Tries 1, 2, ... strands, at most n_most, until the error is a fifth of the yardstick's
/// tolerance. `reference`: integrals that are known already; without, those with more strands than
/// are ever tried.
template <int Dim>
Cell<Dim> fit_cell(const StrandFamily<Dim>& strands, const Yardstick<Dim>& yardstick, int n_most,
                   const std::optional<Eigen::VectorXd>& reference = {});

/// Points and weights made of cells.
template <int Dim>
struct CellRule {
  Points<Dim> position;
  std::vector<double> weight;
  std::vector<int> solid;
  double error =
      std::numeric_limits<double>::infinity();  ///< measured against the references, relative
};

/// The cheapest rule found whose error in all integrands is at most the yardstick's tolerance.
/// Every cell has as many strands as one local tolerance asks for, every strand as many points as
/// another does; the two are traded against each other, and strands that turn out to be dispensable
/// are taken away.
template <int Dim>
CellRule<Dim> cheapest_rule(const std::vector<Cell<Dim>>& cells, const Yardstick<Dim>& yardstick);

}  // namespace sem
