#pragma once
// The test bench of step 12: a beam, three loads, a reference by finite elements, and what is asked
// of every method.

#include <array>
#include <string>
#include <vector>

#include "sem/lesson/picture.h"
#include "sem/mechanics/material.h"
#include "sem/method/discretization.h"

namespace sem::tutorial {

/// [0, 4] x [0, 1] m, linear elasticity, plane strain.
struct Beam {
  Material material{MaterialModel::linear, 1e5, 0.3, 0};
  double length = 4, height = 1;
  Discretization<2> body;  ///< ten parts: four below, one right, four above, one left; cubic
  Points<2> X;  ///< 2 by N: nodes on the boundary, ten to a part, anticlockwise, each once
  Eigen::VectorXd weight;  ///< N: share of the boundary, m
  Eigen::MatrixXd J;       ///< N by #control points: X = p_0 J^T, eq. 9
  std::vector<int> left;   ///< nodes at x = 0, which are held
};
Beam make_beam(const MethodOptions& options);

/// A method: x_a(X) = sum_j N_j(X) z_{j,a}, energy 1/2 u^T K u for displacements u of z.
struct Method {
  std::string name;
  Eigen::MatrixXd boundary;  ///< N by n: N_j at the nodes
  Eigen::MatrixXd inside;    ///< #points by n: N_j at the body's quadrature points, or empty
  Eigen::MatrixXd K;         ///< 2n by 2n for (z_1x, z_1y, z_2x, ...)
  bool fitted = false;       ///< K has a factor without meaning: ask() fits it to the pull
};

/// integral of B^T C B for a basis with these gradients (#points by n) and weights: 2n by 2n.
Eigen::MatrixXd galerkin(const Material& material, const Eigen::MatrixXd& Gx,
                         const Eigen::MatrixXd& Gy, const Eigen::VectorXd& weight);

/// Quadratic elements on a grid of n_x by n_y.
Method finite_elements(const Beam& beam, int n_x, int n_y);

constexpr int n_loads = 3;
const std::string load_names[] = {"pull", "bend", "pinch"};

struct Answer {
  std::string name;
  int n_unknowns = 0;
  std::array<Points<2>, n_loads> u;     ///< displacement of the nodes, m
  std::array<double, n_loads> work{};   ///< of the load, by the reference's
  std::array<double, n_loads> error{};  ///< |u - reference| / |reference| over the boundary
  std::array<bool, n_loads> holds{};  ///< false: nothing resists it, or there was no pull to fit to
  std::array<double, 3> field{};      ///< worst relative error of fits to monomials, degree 1 to 3
  double rotation = 0;                ///< energy / (1/2 E angle^2 area)
  double stretch = 0;                 ///< energy / the exact one of u = (X, 0)
};

/// Puts the method to all tests. Without a reference the answer is its own.
Answer ask(const Beam& beam, const Method& method, const Answer* reference);

/// The share in %, without the sign, with 2 digits, all that are before the point up to 4.
std::string percent(double share);

/// A line of a table, and its headings. Loads: the work in % (the error in %).
std::vector<std::string> headings();
std::vector<std::string> row(const Answer& answer);

/// The deformed boundary over the reference's in gray, enlarged: all three loads under each other,
/// with what was measured.
void draw_answers(Picture& picture, const Beam& beam, const Answer& answer, const Answer& reference,
                  const Color& color);
/// All answers, a row a method, a column a load.
void draw_table(Picture& picture, const Beam& beam, const std::vector<Answer>& answers,
                const Answer& reference);

}  // namespace sem::tutorial
