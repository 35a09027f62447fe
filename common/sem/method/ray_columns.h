#pragma once
// Internal: the inside along the rays of one plane, cut into columns in which intervals move
// smoothly.

#include <array>

#include "sem/method/components.h"
#include "sem/method/rays.h"
#include "sem/method/strands.h"

namespace sem {

/// Parallel rays: the plane (2D), or those of one plane in space.
template <int Dim>
struct RayPlane {
  int axis, across;  ///< along the rays, from ray to ray
  Vec<Dim> origin = Vec<Dim>::Zero();
};

/// Interval number `interval` of all rays between two transverse coordinates, on which there are
/// n_intervals.
struct RayBand {
  double lower, upper;
  int interval, n_intervals;
};

/// Bands one above the other whose intervals continue each other.
struct RayColumn {
  std::vector<RayBand> bands;
  EndKind lower_end, upper_end;
};

/// How the ends of an interval move near a critical value, from the interval on rays at distances
/// d, 4 d and 16 d from it. Changes up to `rounding` (m) tell nothing.
EndKind end_kind_of(const std::array<RayInterval, 3>& at, double rounding);

template <int Dim>
class RayColumns {
 public:
  RayColumns(const Component<Dim>& component, const RayPlane<Dim>& plane)
      : component_(component), plane_(plane), size_(component.boundary.box.diagonal()) {}

  double size() const { return size_; }
  /// Chains of bands, from below, whose intervals meet: between the values, ascending, and what
  /// else changes the number of intervals (gaps' caps, rounding).
  std::vector<std::vector<RayBand>> chains(const std::vector<double>& values) const;
  /// How an interval's ends move near an end of its band.
  EndKind end_kind(const RayBand& band, bool at_upper) const;
  /// A column for every interval between neighbours of the values, ascending, and of the places
  /// between them where parts that bound intervals cross; nothing else may change in between.
  std::vector<RayColumn> columns_between(const std::vector<double>& values) const;
  /// n rays' stretches in the column, at points of the rule for its ends; empty if one of them has
  /// other intervals than the bands say.
  Strands<Dim> strands(const RayColumn& column, int n) const;

 private:
  std::vector<Ray<Dim>> cast_at(const std::vector<double>& transverse) const;
  int n_intervals_at(double y) const { return int(cast_at({y})[0].intervals.size()); }
  std::vector<EndKind> end_kinds(double lower, double upper, int n_intervals, bool at_upper,
                                 double share) const;
  std::vector<double> band_ends(const std::vector<double>& values) const;
  // The parts on a ray: what bounds its intervals, in order, and all that it meets, sorted.
  struct PartsOnRay {
    std::vector<int> bounds, met;
  };
  PartsOnRay parts_on_ray(double y) const;
  std::vector<double> with_crossings(const std::vector<double>& values) const;
  bool continues(const RayInterval& a, const RayInterval& b) const;

  const Component<Dim>& component_;
  RayPlane<Dim> plane_;
  double size_;
};

}  // namespace sem
