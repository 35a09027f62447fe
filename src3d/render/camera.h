#pragma once
// From space to pixels: a camera that frames what it shows by itself.

#include <span>

#include "sem/base/dim.h"

namespace sem::render {

/// A pinhole camera, or parallel projection. Pixels have their origin at the top left corner of the
/// picture, y down, as on a Canvas.
struct Camera {
  Vec<3> eye;              ///< m; in parallel projection any point in front of what is shown
  Vec<3> right, up, back;  ///< orthonormal; the camera looks along -back
  double focal;            ///< pixels per metre at distance 1 m; in parallel projection at any
  Vec<2> center;           ///< pixels: where `eye - back` is seen
  bool parallel = false;

  /// Distance from the camera's plane along the direction of view, m.
  double depth(const Vec<3>& X) const { return back.dot(eye - X); }
  /// Position on the picture, pixels; X is in front of the camera.
  Vec<2> project(const Vec<3>& X) const;
  /// Pixels per metre at the point.
  double scale(const Vec<3>& X) const { return parallel ? focal : focal / depth(X); }
  /// Unit vector from X to the camera.
  Vec<3> toward(const Vec<3>& X) const;
};

struct ViewDirection {
  Vec<3> from = Vec<3>(-0.55, -1, 0.55);  ///< from what is shown to the camera; any length > 0
  Vec<3> up = Vec<3>(0, 0, 1);            ///< what is up in the picture; not along `from`
  double field_of_view = 24;  ///< degrees that the area's diagonal spans; 0: parallel projection
};

/// The camera nearest to the points that sees all of them in the area (pixels): their projections
/// touch its left and right or its upper and lower edge, and are centred in the other direction.
/// Throws InputError if there is no point or the direction is not one.
Camera framing(std::span<const Vec<3>> points, const ViewDirection& direction, const Box<2>& area);

/// The corners of a box, to be framed.
std::vector<Vec<3>> corners(const Box<3>& box);

}  // namespace sem::render
