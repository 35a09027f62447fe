#pragma once
// One picture in passes over its triangles, for renderer.cpp alone: shadows and visibility
// (shadow_pass.cpp), what is opaque, spheres and lines (passes.cpp), translucent layers
// (layer_pass.cpp).

#include <memory>
#include <span>
#include <vector>

#include "sem/draw/offscreen.h"
#include "src3d/render/geometry.h"
#include "src3d/render/gl.h"
#include "src3d/render/lights.h"
#include "src3d/render/renderer.h"

namespace sem::render {

/// The context with all that does not depend on the scene.
struct Programs {
  OffscreenContext context{16, 16, OffscreenContext::Buffer::plain};  // all is drawn into textures
  std::unique_ptr<Program> depth, geometry, visibility, pack, surface, ground, layer, copy, sphere,
      line;
  std::unique_ptr<VertexArray> empty;

  Programs();
  ~Programs() { context.make_current(); }
};

/// One picture; refers to all that it is made of. The context is current while it lives.
class Picture {
 public:
  Picture(Programs& gl, const RenderScene& scene, const Camera& camera,
          const RenderOptions& options);
  Image draw();

 private:
  std::vector<float> ground_vertices() const;
  Eigen::Vector3f ground_center(double height) const;
  bool has_ground() const;
  bool receives_shadows() const;

  void draw_batches(const Program& program, bool translucent) const;
  static void draw_batch(const Program& program, const Batch& batch);
  void draw_ground() const;
  void draw_screen() const;
  void set_light(const Program& program) const;
  Eigen::Vector4f depth_row() const;

  void look_up_visibility();
  void draw_shadow_maps(const Target& maps, std::span<const Light> lights, int first) const;
  void add_visibility(const Target& geometry, const Target& seen, const Target& maps,
                      std::span<const Light> lights) const;
  void set_visibility(const Program& program) const;

  void draw_opaque() const;
  void draw_spheres() const;
  void draw_lines() const;
  void draw(const Lines& lines, float opacity) const;

  void draw_translucent(const Target& picture) const;
  void limit_to_translucent() const;
  void draw_layer(const Target& now, const Target& last, const Target& picture) const;
  void blend(const Target& from, GLenum source, GLenum destination) const;

  Programs& gl_;
  const RenderScene& scene_;
  const Camera& camera_;
  const RenderOptions& options_;
  const int width_, height_;  // of what is drawn, before averaging
  const Ball ball_;
  const Triangles triangles_;
  const Eigen::Matrix4f to_clip_;
  const Eigen::Vector3f key_;
  const VertexArray mesh_, ground_;
  std::unique_ptr<Target> visibility_;
};

}  // namespace sem::render
