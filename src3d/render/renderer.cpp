#include "src3d/render/renderer.h"

#include "sem/base/error.h"
#include "src3d/render/passes.h"

namespace sem::render {
namespace {

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
