#pragma once
// Rendered solids in the pictures of the 3D tutorials, from a camera that the reader turns.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sem/lesson/lesson.h"
#include "sem/lesson/plots.h"
#include "sem/method/rays.h"
#include "src3d/picture/frame.h"
#include "src3d/render/render_scene.h"

namespace sem::render {
class Renderer;
}

namespace sem::tutorial {

/// What a picture shows of space, besides a RenderScene: texts beside points, and points that the
/// mouse reads.
struct SpaceNotes {
  struct Label {
    Vec<3> at;
    std::string text;
    Color color = colors::black;
    Vec<2> offset = {9, -9};       ///< pixels, y down
    Vec<3> side = Vec<3>::Zero();  ///< shown only where the camera is on this side; 0: always
  };
  std::vector<Label> labels = {};
  Points<3> points = {};                      ///< 3 by #points
  std::function<std::string(int)> text = {};  ///< of a point; none: they are not read
};

class SolidView {
 public:
  /// Gives the lesson the camera's angles, degrees; before its first step. turn = 0 looks along y,
  /// turn = 90 from +x against x.
  explicit SolidView(Lesson& lesson, double turn = -30, double lift = 25);
  ~SolidView();

  /// Renders the scene in a rectangle of the picture (pixels; none: all below the first note), as
  /// large as all of it fits. Coarser while the reader drags.
  void draw(Picture& picture, const render::RenderScene& scene, const SpaceNotes& notes = {},
            const std::optional<Box<2>>& rectangle = {});

  /// The program's frame of a state, from the camera's direction.
  void draw_frame(Picture& picture, SolidPainter& painter, const Model<3>& model,
                  const State& state);

 private:
  Vec<3> from() const;

  const Lesson& lesson_;
  Vec<2> angles_;
  std::unique_ptr<render::Renderer> renderer_;  // made when needed
};

inline const Color ink{0.12, 0.12, 0.15}, clay{0.80, 0.81, 0.84};

/// The NURBS of parts, and their trims if any has some.
std::vector<Nurbs<2, 3>> surfaces_of(const std::vector<ScenePart<3>>& parts);

/// The boundary with other control points (3 by n_controls), for drawing; trims stay.
Boundary<3> moved(const Boundary<3>& boundary, const Points<3>& controls);

/// Adds the parts of a boundary, a colour each, and lines along their ends.
void add_parts(render::RenderScene& scene, const Boundary<3>& boundary,
               const std::function<Color(int part)>& color, double line_width = 2);
/// Their ends alone.
void add_ends(render::RenderScene& scene, const Boundary<3>& boundary, const Color& color,
              double width, double hidden = 0);
/// Balls at points (3 by #points).
void add_balls(render::RenderScene& scene, const Points<3>& points, double radius,
               const std::function<Color(int point)>& color);
/// A straight line.
void add_line(render::RenderScene& scene, const Vec<3>& a, const Vec<3>& b, const Color& color,
              double width, double hidden = 0.3);

/// The stretches of rays that are inside.
void add_stretches(render::RenderScene& scene, const Rays<3>& rays, const Color& color,
                   double width);

/// A flat picture of a function in the plane through `corner` with the sides `a` and `b`: squares
/// of n by n cells whose middles lie inside, colours as given.
void add_slice(render::RenderScene& scene, const Vec<3>& corner, const Vec<3>& a, const Vec<3>& b,
               const std::array<int, 2>& n, const std::function<bool(int cell)>& shown,
               const std::function<Color(int cell)>& color);
/// The middles of its cells, a's direction running fastest: 3 by n[0] n[1].
Points<3> slice_points(const Vec<3>& corner, const Vec<3>& a, const Vec<3>& b,
                       const std::array<int, 2>& n);

}  // namespace sem::tutorial
