#pragma once
// Stage 4: distance weights theta_i(X) (draft eq. 25, figure 4).

#include <optional>
#include <vector>

#include "sem/method/boundary.h"
#include "sem/method/loops.h"

namespace sem {

enum class DistanceWeight {
  published,      ///< 1 - |X - X*| / min(d_total, alpha), d_total = |X* to hit|
  draft,          ///< 1 - |X - X*| / min(d2, alpha), d2 = |X to hit|
  distance_only,  ///< 1 - |X - X*| / alpha, no rays
  sided,          ///< smooth, of the distance and of the side of the part that X lies on (sided_weight.h), no rays
};

struct WeightOptions {
  DistanceWeight variant = DistanceWeight::published;
  double cutoff = 1;               ///< alpha, m
  std::optional<double> sparsity = {};  ///< T in (0, 1]: alpha so that this share of the weights is non-zero
  double side_ramp = 0.5;  ///< s in (0, 1]: the sided weight falls to 0 where the cosine to the inner normal is -s
};

/// What the weights of one part at one point are made of; alpha-free. Stored
/// for the pairs that can have theta > 0 for some alpha <= max_distance, with all
/// that a gradient of theta on its smooth piece needs.
template <int Dim>
struct Distances {
  DistanceWeight variant = DistanceWeight::published;
  int n_points = 0, n_parts = 0;
  std::vector<int> outward;      ///< #parts: Loops::orientation
  std::vector<int> begin;        ///< #points + 1: pairs of a point
  std::vector<int> part;         ///< #pairs
  std::vector<double> closest;   ///< #pairs: |X - X*|
  std::vector<double> reach;     ///< #pairs: what min(., alpha) takes beside alpha; infinity: no hit
  std::vector<Vec<Dim>> foot;    ///< #pairs: X*
  std::vector<Param<Dim - 1>> foot_u;  ///< #pairs: its parameter on the part
  std::vector<int> hit_part;     ///< #pairs: the part hit by the ray, -1: none. With the choice between
                                 ///< reach and alpha it labels the smooth piece that X lies in.
  std::vector<Param<Dim - 1>> hit_u;   ///< #pairs: parameter of the hit, where there is one
  std::vector<double> side;      ///< #pairs: cosine between X - X* and the part's inner normal at X* (sided);
                                 ///< empty for the other variants. 1 on the part, and where the loops
                                 ///< could not decide the part's orientation.
};

/// Closest points and rays.
///
/// Rules. X on parts (within Boundary::tolerance()): theta = 1 for these (X =
/// X*: no direction, no ray), 0 for all others: the Kronecker property; at a
/// joint its parts share. Elsewhere the ray starts at X* and runs through X.
/// Hits of other parts within 1e-7 of the model's size of X* are the joint that
/// X* lies in and do not count. A hit between X* and X makes theta_i = 0
/// (published): what another part hides is out of reach; the draft's formula
/// looks from X on and does not see it. A ray that runs along a straight
/// neighbour hits it where the overlap begins, or at its end if it begins at
/// the joint. No hit: reach is infinite, only alpha counts. Inside a closed
/// part that is a loop by itself theta_i = 1 (the published text's rule, for
/// the variants with a ray): reach and alpha are ignored, closest is set to 0.
/// Distance only and sided: no Kronecker property; on a part all others keep their theta, so that theta is continuous
/// up to the boundary. Sided: a part does not reach what lies behind it: nothing is seen through a gap that
/// is thinner than the limb beside it, as long as alpha is below the width of limb and gap.
template <int Dim>
Distances<Dim> measure_distances(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                                 const Points<Dim>& position, DistanceWeight variant,
                                 double max_distance, int n_threads = 1);

/// theta > 0 of every point, in rows.
template <int Dim>
struct DistanceWeights {
  double cutoff = 0;             ///< the alpha used
  double side_ramp = 0;          ///< s of the sided variant
  std::vector<int> begin;        ///< #points + 1
  std::vector<int> part;         ///< #entries
  std::vector<double> theta;     ///< #entries, in (0, 1]
  std::vector<Vec<Dim>> gradient;  ///< #entries: grad theta, 1/m; empty: not asked for (distance_weight_gradients)
  std::vector<int> piece;        ///< #entries: smooth piece: the part whose hit decides, -1: the cutoff does
  int n_parts = 0;

  /// Another's row k at the end of the last row.
  void append_row(const DistanceWeights& other, int k) {
    const auto append = [&](auto& to, const auto& from) {
      to.insert(to.end(), from.begin() + other.begin[size_t(k)], from.begin() + other.begin[size_t(k) + 1]);
    };
    append(part, other.part);
    append(theta, other.theta);
    append(piece, other.piece);
    if (!other.gradient.empty()) append(gradient, other.gradient);
  }
};

/// theta from distances. With options.sparsity the cutoff is the distance at
/// which the share of non-zero weights among #points * #parts reaches T.
/// Throws InputError (field `method.weights`) for alpha <= 0 or T outside (0, 1].
template <int Dim>
DistanceWeights<Dim> distance_weights(const Distances<Dim>& distances, const WeightOptions& options);

/// Sets theta.gradient: grad theta on the smooth piece that X lies in, in closed form; `distances` are
/// those that theta was made of. With n = (X - X*) / d and m = min(reach, alpha)
///   grad theta = -n / m + d / m^2 grad m.
/// X* moves by C = T A^-1 T^T with the tangents T of the directions in which the foot is free to move and
/// A_ab = X_a . X_b - (X - X*) . X_ab (zero for a foot at a corner or an end of its part); the hit Y =
/// X* + r n stays on the surface with normal N, hence grad r = -(C + r dn/dX)^T N / (N . n), and
/// reach = r (published) or r - d (draft). Zero where theta is 1 by a rule: on a part and inside a closed part. Distance only
/// and sided (sided_weight.h): on a part n is its inner normal, the limit from inside.
template <int Dim>
void distance_weight_gradients(const Boundary<Dim>& boundary, const Points<Dim>& position,
                               const Distances<Dim>& distances, DistanceWeights<Dim>& theta);

/// grad theta of a pair of `distances` (sided), which belongs to `part` and X, for a reach in place of alpha, 1/m.
template <int Dim>
Vec<Dim> sided_gradient(const PreparedNurbs<Dim - 1, Dim>& part, const Distances<Dim>& distances, int pair,
                        const Vec<Dim>& X, double reach, double ramp);

/// h(side) of a sided weight and its gradient, 1/m.
template <int Dim>
struct SideStep {
  double value;
  Vec<Dim> gradient;
};
/// h of a pair of `distances` (sided), which belongs to `part` and X; the gradient is zero on the part.
template <int Dim>
SideStep<Dim> side_at(const PreparedNurbs<Dim - 1, Dim>& part, const Distances<Dim>& distances, int pair,
                      const Vec<Dim>& X, double ramp);

}  // namespace sem
