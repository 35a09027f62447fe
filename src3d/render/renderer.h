#pragma once
// Pictures of solids: off-screen OpenGL with soft shadows and ambient occlusion.

#include <memory>

#include "sem/draw/image.h"
#include "src3d/render/camera.h"
#include "src3d/render/render_scene.h"

namespace sem::render {

/// Light on a surface of albedo a: a (ambient A + key V max(n . l, 0)) + gloss V (n . h)^32,
/// linear, clamped and then sRGB. A: share of the sky that is seen from there, weighted by the
/// cosine, 1 for a free surface that faces up; V: share of the key light that is seen.
struct Lighting {
  std::optional<Vec<3>> key_direction =
      {};  ///< from the scene to the light; none: over the viewer's left shoulder
  double key = 0.72, ambient = 0.42, gloss = 0.06;
  double key_radius =
      5;  ///< degrees that the light extends about its direction: softness of shadows
  double from_below = 0.45;        ///< light from straight below, as a share of that from above
  int n_key = 32, n_ambient = 80;  ///< directions that stand for them: a shadow map each
};

struct RenderOptions {
  int width = 800, height = 600;  ///< pixels
  int supersample = 2;            ///< 1 to 4: drawn so many times larger, then averaged
  int shadow_size = 512;          ///< pixels of a shadow map
  int occlusion_step = 2;         ///< shadows are looked up once in so many pixels each way
  Lighting lighting = {};
};
/// For films: about 60 shadow maps of half the size.
RenderOptions frame_quality(int width, int height);
/// For print.
RenderOptions paper_quality(int width, int height);

/// Expensive to make, serves any number of pictures. One thread at a time, as RasterCanvas. The
/// same scene gives the same pixels, on any number of threads; the order of its meshes does not
/// matter but where surfaces coincide.
class Renderer {
 public:
  /// Throws InputError if there is no off-screen context; std::runtime_error with the compiler's
  /// log if a GLSL program is rejected.
  Renderer();
  ~Renderer();

  /// The scene on white. Throws InputError for sizes out of range (1 to 4096 pixels; supersample
  /// and occlusion_step 1 to 4; shadow_size 16 to 2048), std::runtime_error on an OpenGL error.
  Image render(const RenderScene& scene, const Camera& camera, const RenderOptions& options);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sem::render
