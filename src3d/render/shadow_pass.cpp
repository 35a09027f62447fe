// Which share of the lights every pixel sees: shadow maps of many lights, summed up on the screen.
#include <algorithm>
#include <cmath>

#include "src3d/render/passes.h"

namespace sem::render {
namespace {

using Eigen::Matrix4f;
using Eigen::Vector2f;
using Eigen::Vector4f;

constexpr int tiles = 4, lights_at_once = tiles * tiles;  // shadow maps of one texture

}  // namespace

// Which share of the lights every pixel sees, at a lower resolution.
void Picture::look_up_visibility() {
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

void Picture::draw_shadow_maps(const Target& maps, std::span<const Light> lights, int first) const {
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

void Picture::add_visibility(const Target& geometry, const Target& seen, const Target& maps,
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

void Picture::set_visibility(const Program& program) const {
  if (visibility_) visibility_->bind_color(0, 0);
  program.set("visibility", 0);
  program.set("depth_row", depth_row());
  program.set("to_visibility",
              Vector2f(1.f / float(options_.supersample * options_.occlusion_step),
                       1.f / float(options_.supersample * options_.occlusion_step)));
}

}  // namespace sem::render
