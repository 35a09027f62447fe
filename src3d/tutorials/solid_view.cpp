#include "src3d/tutorials/solid_view.h"

#include <cmath>

#include "sem/lesson/part_canvas.h"
#include "src3d/render/renderer.h"
#include "src3d/render/tessellate.h"

namespace sem::tutorial {
namespace {

render::Flatness flatness(const Boundary<3>& boundary) { return {boundary.box.diagonal() / 2000}; }

render::RenderOptions options(int width, int height, bool quick) {
  auto result = render::frame_quality(width, height);
  result.lighting.ambient = 0.6;
  result.lighting.key = 0.5;
  result.lighting.gloss = 0.03;
  if (!quick) return result;
  result.supersample = 1;
  result.lighting.n_key = 2;
  result.lighting.n_ambient = 6;
  return result;
}

std::vector<Vec<3>> framed(const render::RenderScene& scene) {
  std::vector<Vec<3>> points;
  for (const auto& mesh : scene.meshes)
    points.insert(points.end(), mesh.position.begin(), mesh.position.end());
  for (const auto& lines : scene.lines)
    for (const auto& chain : lines.chains) points.insert(points.end(), chain.begin(), chain.end());
  for (const auto& ball : scene.spheres) points.push_back(ball.center);
  return points;
}

}  // namespace

SolidView::SolidView(Lesson& lesson, double turn, double lift)
    : lesson_(lesson), angles_(turn, lift) {
  lesson.orbit(angles_);
}

SolidView::~SolidView() = default;

Vec<3> SolidView::from() const {
  const double turn = angles_[0] * M_PI / 180, lift = angles_[1] * M_PI / 180;
  return {std::sin(turn) * std::cos(lift), -std::cos(turn) * std::cos(lift), std::sin(lift)};
}

void SolidView::draw_frame(Picture& picture, SolidPainter& painter, const Model<3>& model,
                           const State& state) {
  PartCanvas part(picture.canvas(), picture.area());
  painter.look_from(from());
  painter.draw(part, model, state);
}

void SolidView::draw(Picture& picture, const render::RenderScene& scene, const SpaceNotes& notes,
                     const std::optional<Box<2>>& rectangle) {
  if (!renderer_) renderer_ = std::make_unique<render::Renderer>();
  const Box<2> place = rectangle.value_or(picture.part({0.01, 0.06}, {0.99, 0.99}));
  const Vec<2> corner = place.lower.array().round();
  const int width = int(place.upper[0] - corner[0]), height = int(place.upper[1] - corner[1]);
  const render::ViewDirection direction{.from = from()};
  const double margin = 0.04 * std::min(width, height);
  auto camera =
      render::framing(framed(scene), direction,
                      {Vec<2>::Constant(margin), Vec<2>(width - margin, height - margin)});
  picture.canvas().image(renderer_->render(scene, camera, options(width, height, lesson_.quick())),
                         {corner, corner + Vec<2>(width, height)});
  camera.center += corner;
  for (const auto& label : notes.labels)
    if (label.side.isZero(0) || label.side.dot(camera.toward(label.at)) > 0)
      picture.label_at(camera.project(label.at), label.text, label.color, label.offset);
  if (!notes.text) return;
  Points<2> pixels(2, notes.points.cols());
  for (int k = 0; k < pixels.cols(); ++k) pixels.col(k) = camera.project(notes.points.col(k));
  picture.hover(place, [pixels, text = notes.text](const Vec<2>& at) -> std::string {
    int k = 0;
    if (pixels.cols() == 0) return "";
    const double square = (pixels.colwise() - at).colwise().squaredNorm().minCoeff(&k);
    return square < 15 * 15 ? text(k) : "";
  });
}

std::vector<Nurbs<2, 3>> surfaces_of(const std::vector<ScenePart<3>>& parts) {
  std::vector<Nurbs<2, 3>> surfaces;
  for (const auto& part : parts) surfaces.push_back(part.shape);
  return surfaces;
}

Boundary<3> moved(const Boundary<3>& boundary, const Points<3>& controls) {
  Boundary<3> result = boundary;
  result.box = {};
  for (int i = 0; i < boundary.n_parts(); ++i) {
    Nurbs<2, 3> nurbs = boundary.parts[i].nurbs;
    nurbs.control_points = controls.middleCols(boundary.first_control[i], nurbs.weights.size());
    result.parts[i] = prepare(nurbs);
    result.parts[i].region = boundary.parts[i].region;
    result.box.include(result.parts[i].box);
  }
  return result;
}

void add_parts(render::RenderScene& scene, const Boundary<3>& boundary,
               const std::function<Color(int part)>& color, double line_width) {
  for (int i = 0; i < boundary.n_parts(); ++i) {
    scene.meshes.push_back(render::tessellate(boundary.parts[i], flatness(boundary)));
    scene.meshes.back().color = color(i);
  }
  if (line_width > 0) add_ends(scene, boundary, ink, line_width);
}

void add_ends(render::RenderScene& scene, const Boundary<3>& boundary, const Color& color,
              double width, double hidden) {
  render::Lines lines{{}, color, width, hidden};
  for (const auto& part : boundary.parts)
    for (auto& chain : render::outline(part, flatness(boundary)))
      lines.chains.push_back(std::move(chain));
  scene.lines.push_back(std::move(lines));
}

void add_balls(render::RenderScene& scene, const Points<3>& points, double radius,
               const std::function<Color(int point)>& color) {
  for (int k = 0; k < points.cols(); ++k)
    scene.spheres.push_back({points.col(k), radius, color(k)});
}

void add_line(render::RenderScene& scene, const Vec<3>& a, const Vec<3>& b, const Color& color,
              double width, double hidden) {
  scene.lines.push_back({{{a, b}}, color, width, hidden});
}

void add_stretches(render::RenderScene& scene, const Rays<3>& rays, const Color& color,
                   double width) {
  for (const auto& ray : rays.rays)
    for (const auto& inside : ray.intervals) {
      const Vec<3> along = Vec<3>::Unit(rays.axis);
      add_line(scene, ray.origin + inside.begin * along, ray.origin + inside.end * along, color,
               width, 0.8);
    }
}

Points<3> slice_points(const Vec<3>& corner, const Vec<3>& a, const Vec<3>& b,
                       const std::array<int, 2>& n) {
  Points<3> points(3, n[0] * n[1]);
  for (int j = 0; j < n[1]; ++j)
    for (int i = 0; i < n[0]; ++i)
      points.col(i + n[0] * j) = corner + (i + 0.5) / n[0] * a + (j + 0.5) / n[1] * b;
  return points;
}

void add_slice(render::RenderScene& scene, const Vec<3>& corner, const Vec<3>& a, const Vec<3>& b,
               const std::array<int, 2>& n, const std::function<bool(int cell)>& shown,
               const std::function<Color(int cell)>& color) {
  render::Mesh mesh;
  mesh.lit = false;
  mesh.casts_shadow = false;
  const Vec<3> normal = a.cross(b).normalized(), da = a / n[0], db = b / n[1];
  for (int j = 0; j < n[1]; ++j)
    for (int i = 0; i < n[0]; ++i) {
      const int cell = i + n[0] * j, base = int(mesh.position.size());
      if (!shown(cell)) continue;
      const Vec<3> lower = corner + i * da + j * db;
      for (const Vec<3>& X :
           {lower, Vec<3>(lower + da), Vec<3>(lower + da + db), Vec<3>(lower + db)}) {
        mesh.position.push_back(X);
        mesh.normal.push_back(normal);
        mesh.colors.push_back(color(cell));
      }
      mesh.triangles.push_back({base, base + 1, base + 2});
      mesh.triangles.push_back({base, base + 2, base + 3});
    }
  scene.meshes.push_back(std::move(mesh));
}

}  // namespace sem::tutorial
