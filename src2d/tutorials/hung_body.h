#pragma once
// The solid of steps 10 and 11: all that earlier steps taught, in one call each, and its pictures.

#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "sem/mechanics/internal_energy.h"
#include "sem/mechanics/quadratic_forms.h"
#include "sem/method/discretization.h"
#include "sem/solve/integrators.h"
#include "sem/solve/system.h"
#include "src2d/tutorials/drawing.h"

namespace sem::tutorial {

constexpr double rho = 400;     ///< density, kg/m^3
inline const Vec<2> g(0, -10);  ///< gravity, m/s^2

/// Four cubic curves around a body of 2.7 m by 1.5 m; published weights, 12
/// rays.
Discretization<2> make_body(int degree = 2);

/// The control points at the right end are pinned: entries of z that are not, ascending.
std::vector<int> free_entries(const Discretization<2>& body);
/// All entries.
std::vector<int> all_entries(const Discretization<2>& body);

/// V(z) of one material everywhere with the stability matrix gamma S (or zero), Pa.
std::unique_ptr<InternalEnergy<2>> make_energy(const Discretization<2>& body,
                                               const Material& material,
                                               const Eigen::MatrixXd& stability);

/// V, the scalar mass matrix M, the load of a gravity in m/s^2 on a density in kg/m^3, and z of the
/// rest shape; `energy` must outlive the system.
System make_system(const Discretization<2>& body, InternalEnergy<2>& energy,
                   const Eigen::MatrixXd& M, double density, const Vec<2>& gravity,
                   const std::vector<int>& free);

/// z at rest, and the motion v + spin x X (m/s, rad/s) of all of the body.
State rest_state(const Discretization<2>& body, const Vec<2>& v = {0, 0}, double spin = 0);

/// Of the motions that the columns of `motions` span and that are orthogonal to the rigid ones, the
/// one that moves most mass, with a largest entry of 0.7 m; zero if there is none. M2: mass matrix
/// of z.
Eigen::VectorXd heaviest_motion(const Discretization<2>& body, const Eigen::MatrixXd& M2,
                                const Eigen::MatrixXd& motions);

/// Eigenvalues of a symmetric matrix over the largest, from 1e-18 on, for a logarithmic axis.
Trace spectrum(const std::string& label, const Eigen::MatrixXd& matrix);
/// A run of the library's integrators: what every step left, the first state included.
struct Run {
  std::vector<double> time;      ///< s
  std::vector<double> energy;    ///< T + V - f z, J
  std::vector<double> momentum;  ///< |integral rho x' dX|, kg m/s
  std::vector<double> angular;   ///< integral rho x cross x' dX, kg m^2/s
  std::vector<Eigen::VectorXd> z;
  int n_cut = 0;  ///< steps that did not converge and were cut into substeps
  Status status = Status::converged;
};
/// M: the scalar mass matrix. Stops at `duration`, s, or at a step that fails.
Run simulate(const System& system, const Eigen::MatrixXd& M, State state, double dt,
             double duration, Integrator scheme);

/// The integrators, the paper's first, and their names.
constexpr Integrator schemes[] = {Integrator::linearly_implicit_euler, Integrator::implicit_euler,
                                  Integrator::implicit_midpoint};
const std::string scheme_names[] = {"linearly implicit Euler", "implicit Euler",
                                    "implicit midpoint"};
/// The largest |value - first value| of a run, by the scale or else by the first value: for output.
std::string change(const std::vector<double>& values, double scale = 0);

// Pictures; the mouse reads their values, of bodies how far points of the inside moved.

/// States of a body, the first thin, with their names in a legend.
void draw_states(Picture& picture, const Discretization<2>& body,
                 const std::vector<std::tuple<std::string, Color, Eigen::VectorXd>>& states);
/// A scalar mass matrix as cells, and its row sums as dots at the control points.
void draw_mass(Picture& picture, const Discretization<2>& body, const Eigen::MatrixXd& M);
/// Side by side, the last in blue: where a hung body's curves and points ended.
void draw_hung(Picture& picture, const Discretization<2>& body,
               const std::vector<std::pair<std::string, Eigen::VectorXd>>& ends);

/// Several states of a body, the first dark, the last light, with the last one's time, s.
void draw_motion(Picture& picture, const Discretization<2>& body,
                 const std::vector<Eigen::VectorXd>& z, double time);

/// On the right, a displacement of z from rest: the boundary in red, points inside as blue arrows.
void draw_displacement(Picture& picture, const Discretization<2>& body, const Eigen::VectorXd& u);

/// The body at rest and its control points with a force (entries as z's, N) each, `scale` m per N;
/// entries that are not `free` are marked as pinned.
void draw_vectors(Picture& picture, const Discretization<2>& body, const Eigen::VectorXd& vectors,
                  double scale, const std::vector<int>& free);

/// Springs between two sets of the boundary samples, red where `energy` is large; `map` in blue,
/// `curve` in gray.
void draw_springs(Picture& picture, const Samples<2>& samples, const Points<2>& map,
                  const Points<2>& curve, const Eigen::VectorXd& energy);

}  // namespace sem::tutorial
