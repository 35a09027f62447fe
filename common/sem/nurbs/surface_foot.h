#pragma once
// Internal: local minima of the distance of a point from a piece of a surface.

#include <vector>

#include "sem/nurbs/surface_patch.h"

namespace sem::detail {

/// C - X and the derivatives of C at a point of the piece.
struct SurfaceJet {
  Vec<3> offset;
  Eigen::Matrix<double, 3, 2> first;
  Vec<3> second[3];  ///< uu, uv, vv

  Vec<2> gradient() const { return first.transpose() * offset; }  ///< of half the squared distance
  Mat<2> hessian() const;
};

/// A point of a patch on the way to a local minimum; `fixed` where it is held by a side of the
/// patch.
struct SurfaceFoot {
  Vec<2> s, gradient;
  bool fixed[2];
  SurfaceJet jet;
  bool settled = false;
};

/// A point X and a piece of the part.
class SurfaceFeet {
 public:
  /// `room` is kept between calls so that nothing is allocated in the steady state.
  SurfaceFeet(const PreparedNurbs<2, 3>& part, const Vec<3>& X, std::vector<Vec4>& room)
      : part_(part), X_(X), coefficients_(room) {}

  void set_piece(const BezierPiece<2, 3>& piece);
  const BezierPiece<2, 3>& piece() const { return *piece_; }

  SurfaceJet evaluate(const Vec<2>& s) const;
  SurfaceFoot start(const Vec<2>& s, const SurfacePatch& patch) const;
  /// A step of Newton's, where that is none downhill of Gauss-Newton, kept inside the patch. False
  /// if there is none to make.
  bool step(SurfaceFoot& foot, const SurfacePatch& patch) const;
  /// One of Newton's steps inside the piece; false, and s as it was, unless it is short and finds a
  /// minimum.
  bool polish(Vec<2>& s) const;

 private:
  void evaluate_powers(const Vec<2>& s, Vec4* A) const;
  void evaluate_bernstein(const Vec<2>& s, Vec4* A) const;

  const PreparedNurbs<2, 3>& part_;
  const Vec<3> X_;
  const BezierPiece<2, 3>* piece_ = nullptr;
  std::vector<Vec4>& coefficients_;  // w (P - X), w where powers lose digits
};

}  // namespace sem::detail
