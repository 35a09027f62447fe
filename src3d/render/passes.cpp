#include "src3d/render/passes.h"

#include <algorithm>

#include "src3d/render/shaders.h"

namespace sem::render {
namespace {

constexpr float ground_reach = 3.3f;  // radii of the scene

Vec<3> default_key(const Camera& camera, const Vec<3>& up) {
  return (0.55 * camera.back - 0.5 * camera.right + 1.1 * up).normalized();
}

// Mean of blocks of n x n pixels, rows from the bottom.
Image averaged(const std::vector<std::uint8_t>& rgba, int width, int height, int n) {
  Image image(width, height);
  const std::size_t row_bytes = std::size_t(4) * n * width;
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      unsigned sum[3] = {0, 0, 0};
      for (int y = 0; y < n; ++y) {
        const std::uint8_t* from = &rgba[(std::size_t(n) * (height - 1 - row) + y) * row_bytes +
                                         std::size_t(4) * n * column];
        for (int x = 0; x < n; ++x)
          for (int i = 0; i < 3; ++i) sum[i] += from[4 * x + i];
      }
      for (int i = 0; i < 3; ++i)
        image.pixel(column, row)[i] = std::uint8_t((sum[i] + n * n / 2) / (n * n));
    }
  return image;
}

}  // namespace

Programs::Programs() {
  context.make_current();
  using namespace shaders;
  const auto make = [](std::unique_ptr<Program>& program, const char* name, const char* vertex,
                       const std::string& fragment) {
    program = std::make_unique<Program>(name, vertex, fragment);
  };
  const std::string lit = std::string("#version 330\n") + light, shadowed = lit + visibility_lookup;
  make(depth, "depth", depth_vertex, depth_fragment);
  make(geometry, "geometry", surface_vertex, geometry_fragment);
  make(visibility, "visibility", screen_vertex, visibility_fragment);
  make(pack, "pack", screen_vertex, pack_fragment);
  make(surface, "surface", surface_vertex, shadowed + surface_fragment);
  make(ground, "ground", surface_vertex, shadowed + ground_fragment);
  make(layer, "layer", surface_vertex, lit + layer_fragment);
  make(copy, "copy", screen_vertex, copy_fragment);
  make(sphere, "sphere", sphere_vertex, lit + sphere_fragment);
  make(line, "line", line_vertex, line_fragment);
  empty = std::make_unique<VertexArray>(std::vector<float>(4), std::vector<int>{1});
  check_gl("compiling the programs");
}

Picture::Picture(Programs& gl, const RenderScene& scene, const Camera& camera,
                 const RenderOptions& options)
    : gl_(gl),
      scene_(scene),
      camera_(camera),
      options_(options),
      width_(options.width * options.supersample),
      height_(options.height * options.supersample),
      ball_(ball_of(scene)),
      triangles_(triangles_of(scene, ball_)),
      to_clip_(clip_matrix(camera, ball_, scene.ground ? ground_reach : 0.01, options.width,
                           options.height)),
      key_((options.lighting.key_direction ? options.lighting.key_direction->normalized()
                                           : default_key(camera, scene.up))
               .cast<float>()),
      mesh_(triangles_.vertices, {3, 3, 4, 1}, triangles_.indices),
      ground_(ground_vertices(), {3, 3, 4, 1}) {}

Image Picture::draw() {
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  if (receives_shadows()) look_up_visibility();
  const Target picture(width_, height_, {GL_RGBA8}, Target::Depth::plain);
  picture.bind();
  glClearColor(1, 1, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_LESS);
  draw_opaque();
  draw_spheres();
  draw_lines();
  draw_translucent(picture);
  std::vector<std::uint8_t> rgba(std::size_t(4) * width_ * height_);
  picture.bind();
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  check_gl("drawing a picture");
  return averaged(rgba, options_.width, options_.height, options_.supersample);
}

std::vector<float> Picture::ground_vertices() const {
  const double height = scene_.ground.value_or(0);
  const Eigen::Vector3f up = scene_.up.cast<float>(), middle = ground_center(height),
                        a = up.unitOrthogonal(), b = up.cross(a);
  std::vector<float> vertices;
  for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {-1, 1}, {1, 1}}) {
    const Eigen::Vector3f X = middle + ground_reach * (float(x) * a + float(y) * b);
    vertices.insert(vertices.end(), {X[0], X[1], X[2], up[0], up[1], up[2], 1, 1, 1, 1, 1});
  }
  return vertices;
}

Eigen::Vector3f Picture::ground_center(double height) const {
  return (scene_.up * (height - scene_.up.dot(ball_.center)) / ball_.radius).cast<float>();
}

// Seen from above only.
bool Picture::has_ground() const {
  return scene_.ground && (camera_.parallel ? camera_.back.dot(scene_.up) > 0
                                            : camera_.eye.dot(scene_.up) > *scene_.ground);
}

bool Picture::receives_shadows() const {
  return has_ground() || std::any_of(scene_.meshes.begin(), scene_.meshes.end(),
                                     [](const Mesh& m) { return m.lit && m.color.a >= 1; });
}

void Picture::draw_batches(const Program& program, bool translucent) const {
  mesh_.bind();
  for (const auto& batch : triangles_.batches)
    if ((batch.opacity < 1) == translucent) draw_batch(program, batch);
}

void Picture::draw_batch(const Program& program, const Batch& batch) {
  glEnable(GL_CLIP_DISTANCE0);
  program.set("kept", batch.kept);
  glDrawElements(GL_TRIANGLES, batch.count, GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(std::size_t(batch.first) * sizeof(unsigned)));
  glDisable(GL_CLIP_DISTANCE0);
}

void Picture::draw_ground() const {
  ground_.bind();
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void Picture::draw_screen() const {
  gl_.empty->bind();
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void Picture::set_light(const Program& program) const {
  program.use();
  program.set("to_clip", to_clip_);
  program.set("to_key", key_);
  program.set("eye", ball_.map(camera_.eye));
  program.set("back", Eigen::Vector3f(camera_.back.cast<float>()));
  program.set("camera_up", Eigen::Vector3f(camera_.up.cast<float>()));
  program.set("up", Eigen::Vector3f(scene_.up.cast<float>()));
  program.set("is_parallel", camera_.parallel ? 1.f : 0.f);
  program.set("key", float(options_.lighting.key));
  program.set("ambient", float(options_.lighting.ambient));
  program.set("gloss", float(options_.lighting.gloss));
  program.set("from_below", float(options_.lighting.from_below));
}

// Distance from the camera in units of the ball, as a row that acts on (X, 1).
Eigen::Vector4f Picture::depth_row() const {
  const Eigen::Vector3f back = camera_.back.cast<float>();
  return {-back[0], -back[1], -back[2], back.dot(ball_.map(camera_.eye))};
}

void Picture::draw_opaque() const {
  set_light(*gl_.surface);
  set_visibility(*gl_.surface);
  draw_batches(*gl_.surface, false);
  if (!has_ground()) return;
  set_light(*gl_.ground);
  set_visibility(*gl_.ground);
  gl_.ground->set("ground_center", ground_center(*scene_.ground));
  gl_.ground->set("picture_size", Eigen::Vector2f(float(width_), float(height_)));
  draw_ground();
}

void Picture::draw_spheres() const {
  std::vector<float> vertices;
  for (const auto& sphere : scene_.spheres) {
    const Eigen::Vector3f x = ball_.map(sphere.center);
    const Color& c = sphere.color;
    vertices.insert(vertices.end(), {x[0], x[1], x[2], float(sphere.radius / ball_.radius),
                                     float(c.r), float(c.g), float(c.b), 1});
  }
  if (vertices.empty()) return;
  const VertexArray array(vertices, {4, 4}, {}, 1);
  set_light(*gl_.sphere);
  array.bind();
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(scene_.spheres.size()));
}

// First what is hidden, faint; then what is seen, later lines over earlier ones; then the depths
// of opaque ones, for what is translucent.
void Picture::draw_lines() const {
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  gl_.line->use();
  for (const auto& [depth_test, is_depth] :
       {std::pair(GL_GREATER, false), {GL_LESS, false}, {GL_LESS, true}}) {
    glDepthFunc(GLenum(depth_test));
    glDepthMask(is_depth);
    glColorMask(!is_depth, !is_depth, !is_depth, !is_depth);
    for (const auto& lines : scene_.lines)
      if (!is_depth || lines.color.a >= 1)
        draw(lines, depth_test == GL_GREATER ? float(lines.hidden) : 1.f);
  }
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthFunc(GL_LESS);
  glDisable(GL_BLEND);
}

void Picture::draw(const Lines& lines, float opacity) const {
  if (opacity <= 0) return;
  const auto vertices = widened(lines, camera_, ball_, to_clip_, options_.width, options_.height);
  if (vertices.empty()) return;
  const VertexArray array(vertices, {4, 4});
  array.bind();
  gl_.line->set("opacity", opacity);
  glDrawArrays(GL_TRIANGLES, 0, GLsizei(vertices.size() / 8));
}

}  // namespace sem::render
