#pragma once
// Stage 3, first half: rays through the body and the intervals inside it.

#include <vector>

#include "sem/method/loops.h"
#include "sem/nurbs/hits.h"

namespace sem {

enum class RayGrid {
  midpoint,  ///< equally spaced, at the middle of their strips (the paper's)
  gauss,     ///< at Gauss-Legendre points of the body's extent
};

struct RayOptions {
  int axis = 0;      ///< direction of the rays: 0 = x, 1 = y, 2 = z
  int n_rays = 32;   ///< rays per transverse direction
  RayGrid grid = RayGrid::midpoint;
};

/// A hit of a ray with a part or a cap.
struct RayHit {
  double t;       ///< coordinate along the ray's axis, m
  int part;       ///< index of the part; n_parts + index of a cap
  bool crosses;   ///< counts for the parity
};

/// A stretch of a ray inside the body.
struct RayInterval {
  double begin, end;  ///< coordinates along the axis, m
  int solid;          ///< the first solid that contains it
};

/// One ray: the line {X : X_b = offset_b for the transverse axes b}.
template <int Dim>
struct Ray {
  Vec<Dim> origin;     ///< on the ray; its coordinate along the axis is 0
  double weight;       ///< m (2D), m^2 (3D): strip that the ray stands for
  std::vector<RayHit> hits;            ///< sorted by t
  std::vector<RayInterval> intervals;  ///< sorted, disjoint, touching stretches of one solid merged
};

/// All rays, and what the inside rule could not decide.
template <int Dim>
struct Rays {
  int axis = 0;
  std::vector<Ray<Dim>> rays;
  int n_unpaired = 0;         ///< rays on which a loop was crossed an odd number of times
  double capped_length = 0;   ///< weighted length of intervals that begin or end at a gap's cap
};

/// Casts the rays and unites the solids along each (rule: loops.h). A loop
/// that a ray crosses an odd number of times is closed at its last hit: the
/// unpaired hit is dropped and counted. 3D: a ray through an edge that patches share is cast
/// some 1e-8 of the model's size beside it.
/// Throws InputError (field `method.quadrature`) for n_rays < 1 or a bad axis.
template <int Dim>
Rays<Dim> cast_rays(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                    const RayOptions& options, int n_threads = 1);

/// The same for rays that are given: fills hits and intervals, and adds to the doubts.
template <int Dim>
void cast(const Boundary<Dim>& boundary, const Loops<Dim>& loops, Rays<Dim>& rays,
          int n_threads = 1);

}  // namespace sem
