#pragma once
// Stage 10: the internal energy of the body in the unknowns z,
//   V(z) = sum_k v_k Psi(F_k) + gamma/2 z^T (S (x) I) z,  F = B z  (draft eq. 18-19),
// with its gradient and Hessian. Knows z, B and S only: not what z stands for.

#include <vector>

#include "sem/mechanics/pressure.h"
#include "sem/method/map.h"
#include "sem/solve/system.h"

namespace sem {

/// Material of every quadrature point.
struct MaterialField {
  std::vector<Material> materials;
  std::vector<int> of_point;  ///< #points: index into materials
};

/// Implements the solvers' Potential. All workspaces are allocated once.
///
/// The Hessian uses that every component of z has the same scalar basis: with
/// C = dP/dF the block of components (a, c) is
///   sum_{b,d} G_b^T diag(v C_{ab,cd}) G_d,   G_b = gradient[b] of a map block,
/// Dim (Dim+1)/2 times Dim matrix products of #columns by #points by #columns.
template <int Dim>
class InternalEnergy : public Potential {
 public:
  /// map: B at the quadrature points (kept by reference); weight: v_k;
  /// stability: gamma S, scalar, n_columns by n_columns, Pa (2D) or Pa m; empty: none. clamps: V_D, added to V.
  /// pressure: of the materials that have one of their own (pressure.h); empty: none.
  InternalEnergy(const Map<Dim>& map, const Eigen::VectorXd& weight, const MaterialField& materials,
                 const Eigen::MatrixXd& stability, Clamps<Dim> clamps = {}, Pressure<Dim> pressure = {});

  int size() const override { return Dim * map_.n_columns; }
  double energy(const Eigen::VectorXd& z) override;
  void gradient(const Eigen::VectorXd& z, Eigen::VectorXd& g) override;
  void hessian(const Eigen::VectorXd& z, bool project_psd, Eigen::MatrixXd& H) override;
  /// True if every material in use is linear.
  bool quadratic() const override { return quadratic_; }

  /// The summands of V, J, without that of the clamps.
  double elastic_energy(const Eigen::VectorXd& z);
  double stability_energy(const Eigen::VectorXd& z);

  /// Coefficients y of the materials' own pressure at z (pressure.h); empty if none has one.
  Eigen::VectorXd pressure_coefficients(const Eigen::VectorXd& z);

 private:
  // Work space of one map block, sized once.
  struct Workspace {
    Points<Dim> nodes;                   // z of the block's columns, Dim by #columns
    std::array<Points<Dim>, Dim> F;      // column axis of F at each point, Dim by #points each
    Eigen::MatrixXd scaled;              // #points by #columns
    std::vector<StressDerivative<Dim>> tangent;  // v_k dP/dF at each point
  };

  void set_stability_force(const Eigen::Map<const Points<Dim>>& nodes);
  void deformation_gradients(const Eigen::VectorXd& z, const MapBlock<Dim>& block, Workspace& work);
  // Solves for the pressure at z; false where g is not defined (J <= 0).
  bool update_pressure(const Eigen::VectorXd& z);
  double mixed_energy(const Eigen::VectorXd& z);  // at that pressure
  void add_pressure_hessian(const Eigen::VectorXd& z, Eigen::MatrixXd& H);
  const double* pressure(int point) const { return pressure_.empty() ? nullptr : pressure_.at(point); }
  const double* clamp_pressure() const { return pressure_.empty() ? nullptr : pressure_.on_clamps(); }
  const Material& material(int point) const { return materials_.materials[materials_.of_point[point]]; }

  const Map<Dim>& map_;
  Eigen::VectorXd weight_;
  MaterialField materials_;
  Eigen::MatrixXd stability_;
  Clamps<Dim> clamps_;
  Pressure<Dim> pressure_;
  bool quadratic_;
  std::vector<Workspace> work_;
  Eigen::MatrixXd product_;  // of a block's columns, #columns by #columns: room for the largest block
  Points<Dim> stability_nodes_, stability_force_;  // Dim by n_columns
};

}  // namespace sem
