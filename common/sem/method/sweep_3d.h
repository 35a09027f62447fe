#pragma once
// What a plane that sweeps through a solid meets: heights at which its section changes, and in a
// section the places where rays see something new.

#include "sem/method/components.h"
#include "sem/method/line_rules.h"
#include "sem/nurbs/bivariate.h"

namespace sem {

/// A height at which the integral over the section may not be smooth, and how it behaves there:
/// smooth at extrema (a section that closes like an ellipse) and corners, else analytic in the
/// square root at best (at a saddle times a logarithm).
struct CriticalHeight {
  double value;
  EndKind kind;
};

/// Of the pieces and the borders of untrimmed ones, by the normals' components in Bernstein form:
/// complete but for places where surfaces cross, and borders that are trim curves alone.
class Sweep {
 public:
  /// Rays along `axis`, side by side along `across`, planes across `height`: the three axes.
  Sweep(const Component<3>& component, int axis, int across, int height);

  /// Ascending, from the lowest point to the highest.
  const std::vector<CriticalHeight>& heights() const { return heights_; }
  /// In the plane at a height, along `across`: where the section turns back or a border of pieces
  /// passes across which the boundary is not analytic, ascending.
  std::vector<double> across_at(double height) const;

 private:
  // A piece with what its normal's components vanish with.
  struct SweptPiece {
    const PreparedNurbs<2, 3>* shape;
    const BezierPiece<2, 3>* piece;
    detail::Bivariate height,
        weight;  // numerator and denominator of the height, in the normal's degrees
    std::array<detail::Bivariate, 3> normal;
    std::array<double, 3> rounding;  // of the normal's components
  };
  // A border of a piece; X(s) is monotone in height between the stops.
  struct SweptEdge {
    const BezierPiece<2, 3>* piece;
    int along;    // the parameter that runs
    double side;  // the other one, 0 or 1
    std::vector<double> stops;

    Vec<3> at(double s) const;
  };

  void add_piece(const PreparedNurbs<2, 3>& shape, const BezierPiece<2, 3>& piece);
  void add_edges(const PreparedNurbs<2, 3>& part, const BezierPiece<2, 3>& piece);
  bool is_smooth(const PreparedNurbs<2, 3>& part, const SweptEdge& edge) const;
  void find_heights();

  const Component<3>& component_;
  int axis_, across_, height_;
  double size_;
  std::vector<SweptPiece> pieces_;
  std::vector<SweptEdge> edges_;
  std::vector<CriticalHeight> heights_;
};

}  // namespace sem
