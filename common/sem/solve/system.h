#pragma once
// What the solvers know of a solid: an energy V of its unknowns z, a mass
// matrix, a dead load, and which unknowns are free. No geometry, no dimension.
//
//   M z'' + grad V(z) = f   on the free entries; the others are pinned: they stay, or are led.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "sem/solve/symmetric_matrix.h"
#include "sem/solve/work.h"

namespace sem {

/// Energy V(z) in J of n unknowns. Implemented by the mechanics layer; by
/// springs in the tests. Not const: implementations keep workspaces.
class Potential {
 public:
  virtual ~Potential() = default;
  /// n.
  virtual int size() const = 0;
  /// V(z), J; +infinity where z is inadmissible (an inverted element, say).
  virtual double energy(const Eigen::VectorXd& z) = 0;
  /// g = dV/dz, n. g has the right size on entry. Only called where V is finite.
  virtual void gradient(const Eigen::VectorXd& z, Eigen::VectorXd& g) = 0;
  /// H = d2V/dz2; with project_psd a positive semi-definite approximation of it. H is one
  /// that new_hessian made.
  virtual void hessian(const Eigen::VectorXd& z, bool project_psd, SymmetricMatrix& H) = 0;
  /// Room for a Hessian: which entries it has and how they are eliminated. Here all, in their
  /// order.
  virtual SymmetricMatrix new_hessian() const;
  /// The Hessian as a dense matrix, for small problems.
  Eigen::MatrixXd dense_hessian(const Eigen::VectorXd& z, bool project_psd = false);
  /// What each of these calls costs; zero: not counted.
  virtual PotentialWork work() const { return {}; }
  /// True if V is quadratic: H does not depend on z. Solvers then ask for it
  /// once, and for no gradient in the step loop.
  virtual bool quadratic() const = 0;
};

/// Where pinned entries stand at a load factor (statics.h) or at a time, s; n, free ones ignored.
using PinPath = std::function<Eigen::VectorXd(double)>;

/// M, f, pins. The potential is not owned. All vectors have size n.
struct System {
  Potential* potential = nullptr;
  SymmetricMatrix
      mass;  ///< M, kg, positive semi-definite; in the plan of the potential's Hessian, or dense
  Eigen::VectorXd load;   ///< f, N: constant dead load; total potential V(z) - f . z
  std::vector<int> free;  ///< indices of the unknowns that are not pinned, ascending
  Eigen::VectorXd rest;   ///< z of the rest shape
  PinPath motion = {};    ///< of the pinned entries in time (integrators.h); empty: they stay

  int size() const { return int(rest.size()); }
};

struct State {
  Eigen::VectorXd z;  ///< unknowns, n
  Eigen::VectorXd v;  ///< their rate, n; zero for pinned entries that stay
  double time = 0;    ///< s
  long step = 0;
};

/// How a solver ended. Anything but converged is a failure.
enum class Status { converged, max_iterations, line_search_failed, singular, not_finite };

/// "converged", "max_iterations", ...
const char* name(Status status);

/// A sentence for people: what happened, and what usually causes it.
const char* describe(Status status);

/// J. total = kinetic + potential + load, constant in a conservative motion.
struct Energies {
  double kinetic = 0;    ///< 1/2 v . M v
  double potential = 0;  ///< V(z)
  double load = 0;       ///< -f . z
  double total = 0;
};
Energies energies(const System& system, const State& state);

/// Forces that the pins exert, N: M a + grad V(z) - f on pinned entries, zero
/// on free ones; size n. `acceleration` has size n, or 0 in statics.
Eigen::VectorXd reaction(const System& system, const Eigen::VectorXd& z,
                         const Eigen::VectorXd& acceleration = {});

}  // namespace sem
