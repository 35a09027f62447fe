#pragma once
// Straight pieces of the inside: what an interior rule is made of. Stretches of rays that lie side
// by side, or of rays that fan out from a point.

#include <vector>

#include "sem/base/dim.h"
#include "sem/method/line_rules.h"

namespace sem {

/// A share of the area (volume), swept by a segment: the integral of f over it is
///   weight * integral over s in (0, 1) of density(s) f(from + s (to - from)),
/// with a density of mean 1 that grows like (start + (1 - start) s)^(Dim - 1).
template <int Dim>
struct Strand {
  Vec<Dim> from, to;  ///< m
  double weight;      ///< its area (m^2) or volume, > 0
  double
      start;  ///< 1: parallel strands; r(from) / r(to) if they fan out from a point at distance r
  int solid;  ///< the first solid that contains it
};

template <int Dim>
using Strands = std::vector<Strand<Dim>>;

/// The least number n of Gauss points with which the mean of a wave exp(i k x) over a segment has
/// an error of at most `tolerance` by Gauss' error term,
///   phase^(2n) (n!)^4 / ((2n + 1) ((2n)!)^3),   phase = k times the length of the segment.
int points_for_wave(double phase, double tolerance);

/// Gauss-Legendre rule on (0, 1), weights sum to 1; kept for reuse.
const LineRule& gauss_on_strand(int n);

/// Calls visit(X, weight) for as many Gauss points of a strand as waves of the wave number (1/m)
/// need for an error of `tolerance` (m^2, m^3), so that short strands of little weight have few.
template <int Dim, class Visit>
void for_each_point(const Strand<Dim>& strand, double wave_number, double tolerance,
                    const Visit& visit) {
  const Vec<Dim> along = strand.to - strand.from;
  const LineRule& rule =
      gauss_on_strand(points_for_wave(wave_number * along.norm(), tolerance / strand.weight));
  for (size_t k = 0; k < rule.node.size(); ++k) {
    const double s = rule.node[k];
    double power = 1, power_of_start = 1, sum = 1;
    for (int a = 1; a < Dim; ++a) {
      power *= strand.start + (1 - strand.start) * s;
      sum += power_of_start *= strand.start;
    }
    const double density = Dim * power / sum;
    visit(Vec<Dim>(strand.from + s * along), strand.weight * rule.weight[k] * density);
  }
}

}  // namespace sem
