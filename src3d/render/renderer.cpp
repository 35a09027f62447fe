#include "src3d/render/renderer.h"

#include <algorithm>
#include <cmath>

#include "sem/base/error.h"
#include "sem/draw/offscreen.h"
#include "src3d/render/geometry.h"
#include "src3d/render/gl.h"
#include "src3d/render/lights.h"
#include "src3d/render/shaders.h"

namespace sem::render {
namespace {

using Eigen::Matrix4f;
using Eigen::Vector2f;
using Eigen::Vector4f;

constexpr int tiles = 4, lights_at_once = tiles * tiles;  // shadow maps of one texture
constexpr float ground_reach = 3.3f;                      // radii of the scene
constexpr int most_layers = 16;  // of translucent surfaces behind each other

void check_options(const RenderOptions& options) {
  const auto in_range = [](int value, int lower, int upper, const char* field) {
    if (value < lower || value > upper)
      throw InputError("", field, std::to_string(value),
                       std::to_string(lower) + " to " + std::to_string(upper));
  };
  in_range(options.width, 1, 4096, "picture width");
  in_range(options.height, 1, 4096, "picture height");
  in_range(options.supersample, 1, 4, "supersampling");
  in_range(options.occlusion_step, 1, 4, "occlusion step");
  in_range(options.shadow_size, 16, 2048, "shadow map size");
}

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

// The context with all that does not depend on the scene.
struct Programs {
  OffscreenContext context{16, 16, OffscreenContext::Buffer::plain};  // all is drawn into textures
  std::unique_ptr<Program> depth, geometry, visibility, pack, surface, ground, layer, copy, sphere,
      line;
  std::unique_ptr<VertexArray> empty;

  Programs() {
    context.make_current();
    using namespace shaders;
    const auto make = [](std::unique_ptr<Program>& program, const char* name, const char* vertex,
                         const std::string& fragment) {
      program = std::make_unique<Program>(name, vertex, fragment);
    };
    const std::string lit = std::string("#version 330\n") + light,
                      shadowed = lit + visibility_lookup;
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
  ~Programs() { context.make_current(); }
};

// One picture.
class Picture {
 public:
  Picture(Programs& gl, const RenderScene& scene, const Camera& camera,
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

  Image draw() {
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

 private:
  std::vector<float> ground_vertices() const {
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

  Eigen::Vector3f ground_center(double height) const {
    return (scene_.up * (height - scene_.up.dot(ball_.center)) / ball_.radius).cast<float>();
  }

  // Seen from above only.
  bool has_ground() const {
    return scene_.ground && (camera_.parallel ? camera_.back.dot(scene_.up) > 0
                                              : camera_.eye.dot(scene_.up) > *scene_.ground);
  }

  bool receives_shadows() const {
    return has_ground() || std::any_of(scene_.meshes.begin(), scene_.meshes.end(),
                                       [](const Mesh& m) { return m.lit && m.color.a >= 1; });
  }

  void draw_batches(const Program& program, bool translucent) const {
    mesh_.bind();
    for (const auto& batch : triangles_.batches)
      if ((batch.opacity < 1) == translucent) draw_batch(program, batch);
  }

  static void draw_batch(const Program& program, const Batch& batch) {
    glEnable(GL_CLIP_DISTANCE0);
    program.set("kept", batch.kept);
    glDrawElements(GL_TRIANGLES, batch.count, GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(std::size_t(batch.first) * sizeof(unsigned)));
    glDisable(GL_CLIP_DISTANCE0);
  }

  void draw_ground() const {
    ground_.bind();
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }

  void draw_screen() const {
    gl_.empty->bind();
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  }

  void set_light(const Program& program) const {
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
  Vector4f depth_row() const {
    const Eigen::Vector3f back = camera_.back.cast<float>();
    return {-back[0], -back[1], -back[2], back.dot(ball_.map(camera_.eye))};
  }

  // Which share of the lights every pixel sees, at a lower resolution.
  void look_up_visibility() {
    const int w = (options_.width + options_.occlusion_step - 1) / options_.occlusion_step,
              h = (options_.height + options_.occlusion_step - 1) / options_.occlusion_step;
    const Target geometry(w, h, {GL_RGBA32F, GL_RGBA32F}, Target::Depth::plain);
    geometry.bind();
    glClearColor(0, 0, 0, 0);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    gl_.geometry->use();
    gl_.geometry->set("to_clip", to_clip_);
    gl_.geometry->set("is_ground", 0.f);
    draw_batches(*gl_.geometry, false);
    gl_.geometry->set("is_ground", 1.f);
    if (has_ground()) draw_ground();

    const Target seen(w, h, {GL_RGBA32F}, Target::Depth::none);
    seen.bind();
    glClear(GL_COLOR_BUFFER_BIT);
    const auto all = lights(options_.lighting, scene_.up, key_.cast<double>());
    const int size = options_.shadow_size;
    const Target maps(tiles * size, tiles * size, {}, Target::Depth::compared);
    for (std::size_t first = 0; first < all.size(); first += lights_at_once) {
      const std::size_t n = std::min<std::size_t>(lights_at_once, all.size() - first);
      draw_shadow_maps(maps, std::span(all).subspan(first, n), int(first));
      add_visibility(geometry, seen, maps, std::span(all).subspan(first, n));
    }
    visibility_ =
        std::make_unique<Target>(w, h, std::vector<GLenum>{GL_RGBA32F}, Target::Depth::none);
    visibility_->bind();
    gl_.pack->use();
    geometry.bind_color(0, 0);
    geometry.bind_color(1, 1);
    seen.bind_color(0, 2);
    gl_.pack->set("position", 0);
    gl_.pack->set("normal", 1);
    gl_.pack->set("seen", 2);
    gl_.pack->set("depth_row", depth_row());
    draw_screen();
  }

  void draw_shadow_maps(const Target& maps, std::span<const Light> lights, int first) const {
    maps.bind();
    glEnable(GL_DEPTH_TEST);
    glClear(GL_DEPTH_BUFFER_BIT);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.5f, 2);
    gl_.depth->use();
    mesh_.bind();
    const int size = options_.shadow_size;
    Matrix4f to_unit = Matrix4f::Identity();  // from [0, 1] to [-1, 1]
    to_unit.diagonal() << 2, 2, 2, 1;
    to_unit.col(3) << -1, -1, -1, 1;
    for (std::size_t i = 0; i < lights.size(); ++i) {
      glViewport(int(i % tiles) * size, int(i / tiles) * size, size, size);
      gl_.depth->set("to_clip", Matrix4f(to_unit * light_matrix(lights[i].toward)));
      // What lets light through is in the way of some of the lights.
      const double turn = std::fmod((first + double(i)) * 0.6180339887498949, 1);
      for (const auto& batch : triangles_.batches)
        if (batch.casts_shadow && turn < batch.opacity) draw_batch(*gl_.depth, batch);
    }
    glDisable(GL_POLYGON_OFFSET_FILL);
  }

  void add_visibility(const Target& geometry, const Target& seen, const Target& maps,
                      std::span<const Light> lights) const {
    std::vector<Matrix4f> to_light;
    std::vector<Vector4f> toward;
    for (const auto& light : lights) {
      to_light.push_back(light_matrix(light.toward));
      toward.emplace_back(light.toward[0], light.toward[1], light.toward[2], light.weight);
    }
    seen.bind();
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    const Program& program = *gl_.visibility;
    program.use();
    geometry.bind_color(0, 0);
    geometry.bind_color(1, 1);
    maps.bind_depth(2);
    program.set("position", 0);
    program.set("normal", 1);
    program.set("maps", 2);
    program.set("n_lights", int(lights.size()));
    program.set("to_light", to_light);
    program.set("toward", toward);
    program.set("key_weight", 1.f / float(std::max(options_.lighting.n_key, 1)));
    program.set("offset", 2.f / float(options_.shadow_size));
    program.set("tile_border", 1.f / float(options_.shadow_size));
    draw_screen();
    glDisable(GL_BLEND);
  }

  void set_visibility(const Program& program) const {
    if (visibility_) visibility_->bind_color(0, 0);
    program.set("visibility", 0);
    program.set("depth_row", depth_row());
    program.set("to_visibility",
                Vector2f(1.f / float(options_.supersample * options_.occlusion_step),
                         1.f / float(options_.supersample * options_.occlusion_step)));
  }

  void draw_opaque() const {
    set_light(*gl_.surface);
    set_visibility(*gl_.surface);
    draw_batches(*gl_.surface, false);
    if (!has_ground()) return;
    set_light(*gl_.ground);
    set_visibility(*gl_.ground);
    gl_.ground->set("ground_center", ground_center(*scene_.ground));
    draw_ground();
  }

  void draw_spheres() const {
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
  void draw_lines() const {
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

  void draw(const Lines& lines, float opacity) const {
    if (opacity <= 0) return;
    const auto vertices = widened(lines, camera_, ball_, to_clip_, options_.width, options_.height);
    if (vertices.empty()) return;
    const VertexArray array(vertices, {4, 4});
    array.bind();
    gl_.line->set("opacity", opacity);
    glDrawArrays(GL_TRIANGLES, 0, GLsizei(vertices.size() / 8));
  }

  // Depth peeling: layer by layer from the front, each under those before it.
  void draw_translucent(const Target& picture) const {
    const bool any = std::any_of(triangles_.batches.begin(), triangles_.batches.end(),
                                 [](const Batch& b) { return b.opacity < 1; });
    if (!any) return;
    limit_to_translucent();
    const Target sum(width_, height_, {GL_RGBA16F}, Target::Depth::none);
    const Target layers[2] = {{width_, height_, {GL_RGBA8}, Target::Depth::plain},
                              {width_, height_, {GL_RGBA8}, Target::Depth::plain}};
    glClearColor(0, 0, 0, 0);
    sum.bind();
    glClear(GL_COLOR_BUFFER_BIT);
    layers[1].bind();
    glClearDepth(0);
    glClear(GL_DEPTH_BUFFER_BIT);
    glClearDepth(1);
    GLuint query = 0;
    glGenQueries(1, &query);
    for (int k = 0; k < most_layers; ++k) {
      const Target &now = layers[k % 2], &last = layers[(k + 1) % 2];
      glBeginQuery(GL_ANY_SAMPLES_PASSED, query);
      draw_layer(now, last, picture);
      glEndQuery(GL_ANY_SAMPLES_PASSED);
      GLuint any_seen = 0;
      glGetQueryObjectuiv(query, GL_QUERY_RESULT, &any_seen);
      if (!any_seen) break;
      sum.bind();
      blend(now, GL_ONE_MINUS_DST_ALPHA, GL_ONE);
    }
    glDeleteQueries(1, &query);
    picture.bind();
    blend(sum, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glDisable(GL_SCISSOR_TEST);
  }

  // No pixel outside of the translucent meshes' projection is touched.
  void limit_to_translucent() const {
    Box<2> box;
    for (const auto& mesh : scene_.meshes)
      if (mesh.color.a < 1)
        for (const auto& X : mesh.position) box.include(camera_.project(X));
    const double n = options_.supersample;
    const Vec<2> lower = (n * box.lower).cwiseMax(0).array().floor(),
                 upper = (n * box.upper).cwiseMin(Vec<2>(width_, height_)).array().ceil();
    glEnable(GL_SCISSOR_TEST);
    glScissor(int(lower[0]), height_ - int(upper[1]), std::max(int(upper[0] - lower[0]), 0),
              std::max(int(upper[1] - lower[1]), 0));
  }

  void draw_layer(const Target& now, const Target& last, const Target& picture) const {
    now.bind();
    glEnable(GL_DEPTH_TEST);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    set_light(*gl_.layer);
    last.bind_depth(0);
    picture.bind_depth(1);
    gl_.layer->set("last_depth", 0);
    gl_.layer->set("opaque_depth", 1);
    draw_batches(*gl_.layer, true);
  }

  void blend(const Target& from, GLenum source, GLenum destination) const {
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(source, destination);
    gl_.copy->use();
    from.bind_color(0, 0);
    gl_.copy->set("source", 0);
    draw_screen();
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
  }

  Programs& gl_;
  const RenderScene& scene_;
  const Camera& camera_;
  const RenderOptions& options_;
  const int width_, height_;  // of what is drawn, before averaging
  const Ball ball_;
  const Triangles triangles_;
  const Matrix4f to_clip_;
  const Eigen::Vector3f key_;
  const VertexArray mesh_, ground_;
  std::unique_ptr<Target> visibility_;
};

}  // namespace

RenderOptions frame_quality(int width, int height) {
  RenderOptions options{.width = width, .height = height, .supersample = 2, .shadow_size = 256};
  options.lighting.n_key = 16;
  options.lighting.n_ambient = 48;
  return options;
}

RenderOptions paper_quality(int width, int height) {
  return {.width = width, .height = height, .supersample = 2};
}

struct Renderer::Impl {
  Programs programs;
};

Renderer::Renderer() : impl_(std::make_unique<Impl>()) {}

Renderer::~Renderer() = default;

Image Renderer::render(const RenderScene& scene, const Camera& camera,
                       const RenderOptions& options) {
  check_options(options);
  impl_->programs.context.make_current();
  return Picture(impl_->programs, scene, camera, options).draw();
}

}  // namespace sem::render
