#pragma once
// Shapes in space as named parts with exact geometry. Control points that neighbouring parts share
// are the same bit for bit, and so are edges. Unless said otherwise du x dv points out of the
// solid.

#include <array>

#include "src3d/shapes/parts.h"
#include "src3d/shapes/surfaces.h"

namespace sem::shapes3d {

using Profile = std::vector<ScenePart<2>>;

/// How the ends of a profile swept through space are closed.
enum class Caps {
  none,
  fan,    ///< a patch for each part of the profile, to the mean of its control points: star-shaped
          ///< profiles
  coons,  ///< one Coons patch; profiles of four parts in a loop
  ring    ///< ruled from part k of the first half to part k of the second: an annulus
};

/// Cylinder or cone frustum along z: rational quadratic x linear patches "side.1", ..., of equal
/// angle from +x; ends "bottom.1", ..., "top.1", ..., one a side part, to the middle.
struct Cylinder {
  Vec<3> center{0, 0, 0};             ///< m, of the bottom
  double radius = 1, top_radius = 1;  ///< m, > 0
  double height = 1;                  ///< m, > 0
  int n_arcs = 4;                     ///< >= 3
  bool caps = true;
};
Parts make_parts(const Cylinder& cylinder);

/// Sphere as the six faces of a cube blown up, "left", "right" (x), "front", "back" (y), "bottom",
/// "top" (z): rational biquartic patches without poles (Cobb, Tiling the sphere with rational
/// Bezier patches, 1988), each the inverse stereographic image of a plane patch between four
/// circular arcs.
struct Sphere {
  Vec<3> center{0, 0, 0};
  double radius = 1;  ///< m, > 0
};
Parts make_parts(const Sphere& sphere);

/// Torus about z: rational biquadratic patches "torus.1", ..., the number around the axis running
/// fastest; u around the axis, v around the tube, both from +x. With one part around, parts close
/// on themselves.
struct Torus {
  Vec<3> center{0, 0, 0};
  double radius = 2, tube_radius = 1;   ///< m, 0 < tube_radius < radius
  std::array<int, 2> n_parts = {4, 4};  ///< around the axis, around the tube; >= 1
};
Parts make_parts(const Torus& torus);

/// A plane profile in z = 0 moved by a vector. Parts keep their names; ends "start", "end"
/// (numbered if several). Outward for loops that run anticlockwise about the material and by[2] >
/// 0.
struct Extrusion {
  Profile profile;
  Vec<3> by{0, 0, 1};  ///< m, by[2] != 0
  Caps caps = Caps::fan;
};
Parts make_parts(const Extrusion& extrusion);

/// A profile whose x is the distance from the z axis and whose y is z, turned about that axis from
/// +x. Each part is cut into n_parts of equal angle, "name.1", ...; a part on the axis makes none,
/// one that ends there a pole. Ends of less than a whole turn: "start", "end". Outward for a
/// profile that runs anticlockwise about the material (up, if open from axis to axis).
struct Revolution {
  Profile profile;          ///< x >= 0
  double angle = 2 * M_PI;  ///< rad, 0 < angle <= 2 pi
  int n_parts = 4;          ///< >= 1
  Caps caps = Caps::none;
};
Parts make_parts(const Revolution& revolution);

/// Profiles placed in space, of as many parts each: part k of all, one surface through them in
/// order (lofted), named as in the first. Ends "start" and "end". Outward if the profiles
/// run anticlockwise seen against the way from the first to the last.
struct Loft {
  struct Section {
    Profile profile;
    Placement placement;  ///< of the profile in z = 0
  };
  std::vector<Section> sections;  ///< >= 2
  int degree = 3;                 ///< along the way, at most #sections - 1 is used
  Caps caps = Caps::fan;
};
Parts make_parts(const Loft& loft);

}  // namespace sem::shapes3d
