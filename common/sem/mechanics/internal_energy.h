#pragma once
// Stage 10: the internal energy of the body in the unknowns z,
//   V(z) = sum_k v_k Psi(F_k) + gamma/2 z^T (S (x) I) z,  F = B z  (draft eq. 18-19),
// with its gradient and Hessian. Knows z, B and S only: not what z stands for.

#include <vector>

#include "sem/mechanics/assembly.h"
#include "sem/mechanics/pressure.h"
#include "sem/method/map.h"
#include "sem/solve/system.h"

namespace sem {

/// Material of every quadrature point.
struct MaterialField {
  std::vector<Material> materials;
  std::vector<int> of_point;  ///< #points: index into materials
};

/// Fields that S does not resist, in z: left out of S z, whose rounding would be that of their size.
struct Unresisted {
  Eigen::VectorXd one = {};   ///< n_columns: the scalar field 1; empty: all ones
  Eigen::VectorXd rest = {};  ///< Dim n_columns: the rest shape; empty: the map does not keep it
};

/// Implements the solvers' Potential. All workspaces are allocated once.
///
/// The Hessian uses that every component of y has the same scalar basis: with
/// C = dP/dF the block of components (a, c) is
///   sum_{b,d} G_b^T diag(v C_{ab,cd}) G_d,   G_b = gradient[b] of a map block,
/// a matrix product of #columns by Dim #points by #columns for each of the Dim (Dim+1)/2 pairs. What it has on
/// shared rows is carried over to z at the end (assembly.h).
template <int Dim>
class InternalEnergy : public Potential {
 public:
  /// map: B at the quadrature points; weight: v_k;
  /// stability: gamma S, scalar, n_columns by n_columns, Pa (2D) or Pa m; empty: none. clamps: V_D, added to V.
  /// pressure: of the materials that have one of their own (pressure.h); empty: none. plan: of the Hessian, with
  /// the couplings of the map, of the clamps and, if there is a pressure, of everything; that of a stability; null: dense.
  InternalEnergy(const Map<Dim>& map, const Eigen::VectorXd& weight, const MaterialField& materials,
                 const SymmetricMatrix& stability, Clamps<Dim> clamps = {}, Pressure<Dim> pressure = {},
                 std::shared_ptr<const Elimination> plan = nullptr, Unresisted unresisted = {});

  int size() const override { return Dim * map_.n_columns; }
  double energy(const Eigen::VectorXd& z) override;
  void gradient(const Eigen::VectorXd& z, Eigen::VectorXd& g) override;
  void hessian(const Eigen::VectorXd& z, bool project_psd, SymmetricMatrix& H) override;
  SymmetricMatrix new_hessian() const override { return {assembly_.plan(), Dim}; }
  /// Without clamps.
  PotentialWork work() const override { return work_of_; }
  /// True if every material in use is linear.
  bool quadratic() const override { return quadratic_; }

  /// The summands of V, J, without that of the clamps.
  double elastic_energy(const Eigen::VectorXd& z);
  double stability_energy(const Eigen::VectorXd& z);

  /// Coefficients y of the materials' own pressure at z (pressure.h); empty if none has one.
  Eigen::VectorXd pressure_coefficients(const Eigen::VectorXd& z);

 private:
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Dim>;  // vectors as rows

  // Work space of one map block, sized once.
  struct Workspace {
    std::vector<int> columns;            // the block's, in the order of the assembly
    Points<Dim> nodes;                   // y of these; Dim by #columns
    Eigen::MatrixXd gradient;            // the block's, axis below axis, these columns
    Rows F;                              // gradient times the nodes: row b #points + k is column b of F at point k
    std::array<Eigen::ArrayXd, Dim * Dim * Dim * Dim> tangent;  // v dP/dF at all points, entry by entry
  };

  void set_stability_force(const Eigen::VectorXd& z);
  void deformation_gradients(int block);  // from y_
  void set_tangents(const MapBlock<Dim>& block, bool project_psd, Workspace& work);
  Eigen::Map<const Eigen::MatrixXd> local_hessian(const Workspace& work);
  // Solves for the pressure at z; false where g is not defined (J <= 0).
  bool update_pressure(const Eigen::VectorXd& z);
  double mixed_energy(const Eigen::VectorXd& z);  // at that pressure
  void add_pressure_hessian(const Eigen::VectorXd& z, SymmetricMatrix& H);
  PotentialWork count_work(const Map<Dim>& map) const;
  const double* pressure(int point) const { return pressure_.empty() ? nullptr : pressure_.at(point); }
  const double* clamp_pressure() const { return pressure_.empty() ? nullptr : pressure_.on_clamps(); }
  const Material& material(int point) const { return materials_.materials[materials_.of_point[point]]; }

  Map<Dim> map_;  // blocks joined, without values and gradients
  Eigen::VectorXd weight_;
  MaterialField materials_;
  SymmetricMatrix stability_;
  Unresisted unresisted_;
  Assembly<Dim> assembly_;
  Clamps<Dim> clamps_;
  Pressure<Dim> pressure_;
  bool quadratic_;
  PotentialWork work_of_;  // before blocks are joined: zeros are no work asked for
  std::vector<Workspace> work_;
  Points<Dim> y_, forces_;                    // coefficients of the map, and forces on them
  Eigen::VectorXd scaled_, product_, local_;  // of a block: room for the largest
  Eigen::VectorXd stability_z_, stability_force_;
};

}  // namespace sem
