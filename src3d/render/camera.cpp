#include "src3d/render/camera.h"

#include <cmath>

#include "sem/base/error.h"

namespace sem::render {
namespace {

// Along one direction of the picture: a point is seen at slope (s - eye_s) / (d - eye_d) times the
// focal length; d is the coordinate along the direction of view.
struct Bounds {
  double above = -std::numeric_limits<double>::infinity();  // of s - slope d
  double below = std::numeric_limits<double>::infinity();   // of s + slope d
  void include(double s, double d, double slope) {
    above = std::max(above, s - slope * d);
    below = std::min(below, s + slope * d);
  }
  // eye_d at which both edges are touched, eye_s at which the room on both sides is the same.
  double farthest(double slope) const { return (below - above) / (2 * slope); }
  double middle() const { return (above + below) / 2; }
};

}  // namespace

Vec<2> Camera::project(const Vec<3>& X) const {
  const Vec<3> d = X - eye;
  return center + scale(X) * Vec<2>(right.dot(d), -up.dot(d));
}

Vec<3> Camera::toward(const Vec<3>& X) const {
  return parallel ? back : Vec<3>((eye - X).normalized());
}

std::vector<Vec<3>> corners(const Box<3>& box) {
  std::vector<Vec<3>> points;
  for (int k = 0; k < 8; ++k)
    points.push_back({k & 1 ? box.upper[0] : box.lower[0], k & 2 ? box.upper[1] : box.lower[1],
                      k & 4 ? box.upper[2] : box.lower[2]});
  return points;
}

Camera framing(std::span<const Vec<3>> points, const ViewDirection& direction, const Box<2>& area) {
  Camera camera;
  camera.back = direction.from.normalized();
  camera.right = direction.up.cross(camera.back);
  if (points.empty() || !(camera.right.norm() > 1e-9 * direction.up.norm()))
    throw InputError("", "camera", points.empty() ? "nothing to show" : "a view along its own up",
                     "points, and a direction that is not along 'up'");
  camera.right.normalize();
  camera.up = camera.back.cross(camera.right);
  camera.center = (area.lower + area.upper) / 2;
  const Vec<2> half = (area.upper - area.lower) / 2;
  camera.parallel = direction.field_of_view <= 0;
  // A parallel view is one from very far away as far as framing is concerned: slopes of 0.
  const double focal =
      camera.parallel ? 1 : half.norm() / std::tan(direction.field_of_view * M_PI / 360);
  const Vec<2> slope = camera.parallel ? Vec<2>(0, 0) : Vec<2>(half / focal);
  Bounds x, y;
  double nearest = std::numeric_limits<double>::infinity(), size = 0;
  for (const auto& X : points) {
    const double d = -camera.back.dot(X);
    x.include(camera.right.dot(X), d, slope[0]);
    y.include(camera.up.dot(X), d, slope[1]);
    nearest = std::min(nearest, d);
    size = std::max(size, (X - points[0]).norm());
  }
  if (!(size > 0)) size = 1;
  double eye_d = nearest - size;
  if (camera.parallel) {
    const Vec<2> extent(x.above - x.below, y.above - y.below);
    camera.focal = std::min(half[0] / std::max(extent[0] / 2, 1e-12 * size),
                            half[1] / std::max(extent[1] / 2, 1e-12 * size));
  } else {
    camera.focal = focal;
    eye_d = std::min({x.farthest(slope[0]), y.farthest(slope[1]), nearest - 1e-3 * size});
  }
  camera.eye = x.middle() * camera.right + y.middle() * camera.up - eye_d * camera.back;
  return camera;
}

}  // namespace sem::render
