#pragma once
// Dear ImGui's widgets as an image: one ImGui context on one off-screen frame buffer.

#include <memory>

#include "sem/draw/image.h"
#include "sem/draw/offscreen.h"

struct ImGuiContext;
struct ImFont;

namespace sem {

struct Input;

class ImguiScreen {
 public:
  /// Throws InputError if there is no off-screen context or no font.
  ImguiScreen(int width, int height);
  ~ImguiScreen();

  /// Makes ImGui calls of this thread go here: first in every frame, and again after any other
  /// canvas was used.
  void activate();
  /// ImGui::NewFrame with this input.
  void begin(const Input& input);
  /// Renders the frame; valid until the next call.
  const Image& end();
  /// Replaces the image that picture_id() stands for in ImGui::Image. Between begin and end too.
  void upload(const Image& picture);
  void* picture_id() const;

  ImFont *text_font = nullptr, *large_font = nullptr, *mono_font = nullptr;

 private:
  struct Delete {
    void operator()(ImGuiContext* context) const;
  };
  OffscreenContext offscreen_;
  std::unique_ptr<ImGuiContext, Delete> imgui_;
  unsigned picture_texture_ = 0;
  Image image_;
};

}  // namespace sem
