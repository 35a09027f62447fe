#pragma once
// What is rendered: plain data in metres and sRGB colours. Triangles exist only here, for drawing.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "sem/base/dim.h"
#include "sem/draw/colors.h"

namespace sem::render {

/// The half space where normal . X <= offset.
struct HalfSpace {
  Vec<3> normal;
  double offset;
};

/// Triangles with a normal at every corner; corners of a triangle run anticlockwise seen from where
/// its normals point. Both sides are shown alike.
struct Mesh {
  std::vector<Vec<3>> position;
  std::vector<Vec<3>> normal;  ///< unit, one a position
  std::vector<std::array<int, 3>> triangles;
  std::vector<Param<2>> uv = {};  ///< parameters of the positions on their surface; empty: none
  Color color = {0.8, 0.8, 0.8};  ///< opacity below 1: translucent, more opaque at grazing angles
  std::vector<Color> colors =
      {};                    ///< one a position, in place of color (whose opacity still counts)
  bool lit = true;           ///< false: the colours as given, e.g. a field with a colour bar
  bool casts_shadow = true;  ///< translucent ones cast a shadow as much weaker as they let through
  std::optional<HalfSpace> kept = {};  ///< only this part of it is shown
};

/// Chains of straight segments, round about `width` pixels of the picture wide.
struct Lines {
  std::vector<std::vector<Vec<3>>> chains;
  Color color = colors::black;
  double width = 1;
  double hidden = 0;  ///< opacity where something opaque is in front, as a share of the colour's
};

struct Sphere {
  Vec<3> center;
  double radius;  ///< m
  Color color;
};

struct RenderScene {
  std::vector<Mesh> meshes;
  std::vector<Lines> lines;
  std::vector<Sphere> spheres;   ///< lit, without shadows: points and markers
  Vec<3> up = Vec<3>(0, 0, 1);   ///< unit: more light comes from there
  std::optional<double> ground;  ///< X . up of a white plane that shows nothing but shadows
};

/// Box of all there is, without the ground.
Box<3> bounding_box(const RenderScene& scene);

}  // namespace sem::render
