#pragma once
// The numbers that a run writes over time.

#include <optional>
#include <string>
#include <vector>

#include "sem/scene/model.h"

namespace sem {

/// What a row of the history holds: step, time_s, energies in J (kinetic,
/// elastic, stability, load = -f . z, total), iterations, residual, substeps,
/// centroid (m), linear and angular momentum (about the coordinate origin),
/// boundary mismatch, then the probes.
template <int Dim>
class Monitor {
 public:
  /// Both must outlive the monitor.
  Monitor(const Scene<Dim>& scene, const Model<Dim>& model);

  /// Column names, units in them.
  std::vector<std::string> columns() const;
  /// A row; `acceleration` has size n, or 0 in statics.
  std::vector<double> row(const State& state, const Eigen::VectorXd& acceleration, int iterations,
                          double residual, int n_substeps) const;

  /// Columns of the probes alone, and their values.
  const std::vector<std::string>& probe_columns() const { return probe_columns_; }
  /// The scene's truths, if any, in the order of probe_columns().
  const std::vector<std::optional<double>>& probe_truths() const { return probe_truths_; }
  std::vector<double> probes(const State& state, const Eigen::VectorXd& acceleration) const;

  /// Root mean square of |x(X(u)) - J p| over the boundary, by the size of the model.
  double boundary_mismatch(const State& state) const;

 private:
  const Scene<Dim>& scene_;
  const Model<Dim>& model_;
  std::vector<Map<Dim>> probe_maps_;
  std::vector<int> probe_material_;
  std::vector<Eigen::RowVectorXd> probe_pressure_;  // functions of the own pressure at stress probes, or empty
  std::vector<std::string> probe_columns_;
  std::vector<std::optional<double>> probe_truths_;
  Eigen::VectorXd centroid_;  ///< n_columns: centroid = nodes * centroid_
};

}  // namespace sem
