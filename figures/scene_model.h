#pragma once
// What figures ask of the models of built-in scenes.

#include <functional>

#include "figures/data.h"
#include "src2d/baseline/scene_model.h"

namespace sem::figures {

using baseline::SceneModel;
using baseline::use_exact_gradient;

/// Which control points the stiffness matrix couples, found from the structure of the operators
/// alone.
struct StiffnessPattern {
  /// #unknowns / dimension squared: all components, each alone.
  Eigen::MatrixX<bool> elastic, stability;
  int dimension;

  int size() const { return int(elastic.rows()); }
  bool coupled(int i, int j) const { return elastic(i, j) || stability(i, j); }
  /// Of the matrix on z.
  long n_nonzeros() const;
};
template <int Dim>
StiffnessPattern stiffness_pattern(const Discretization<Dim>& discretization);

/// Appends a pattern to tables of the columns case, parts, unknowns, nonzeros, fill, and case, row, first, last: runs of
/// non-zero columns in the rows of the control points' matrix.
void add_case(DataTable& cases, DataTable& runs, int number, int n_parts, const StiffnessPattern& K);
/// Rows and columns of the non-zeros of a case.
std::vector<std::pair<int, int>> entries_of(const DataTable& runs);

/// Shortest of several calls, s.
double fastest_of(int n_calls, const std::function<void()>& call);

}  // namespace sem::figures
