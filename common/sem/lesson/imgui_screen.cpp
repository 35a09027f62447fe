#include "sem/lesson/imgui_screen.h"

#include <GL/gl.h>
#include <backends/imgui_impl_opengl2.h>
#include <imgui.h>

#include <cstdint>
#include <filesystem>

#include "sem/base/error.h"
#include "sem/lesson/workbench.h"

namespace sem {
namespace {

/// Latin, Greek, dashes, super- and subscripts, arrows, mathematical operators.
constexpr ImWchar characters[] = {0x0020, 0x00ff, 0x0370, 0x03ff, 0x2010, 0x2026, 0x2070,
                                  0x209c, 0x2190, 0x2195, 0x2200, 0x22ff, 0};

/// SEM_FONT_FOLDER is set by the build.
ImFont* load_font(const std::string& name, float size) {
  const std::string file = std::string(SEM_FONT_FOLDER) + "/" + name;
  if (!std::filesystem::exists(file))
    throw InputError(file, "font", "no such file",
                     "the DejaVu fonts (package fonts-dejavu-core) where they were at build time");
  return ImGui::GetIO().Fonts->AddFontFromFileTTF(file.c_str(), size, nullptr, characters);
}

}  // namespace

void ImguiScreen::Delete::operator()(ImGuiContext* context) const {
  ImGui::DestroyContext(context);
}

ImguiScreen::ImguiScreen(int width, int height)
    : offscreen_(width, height, OffscreenContext::Buffer::plain),
      imgui_(ImGui::CreateContext()),
      image_(width, height) {
  activate();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.DisplaySize = {float(width), float(height)};
  text_font = load_font("DejaVuSans.ttf", 16);
  large_font = load_font("DejaVuSans.ttf", 19);
  mono_font = load_font("DejaVuSansMono.ttf", 14);
  ImGui::StyleColorsLight();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = 0;
  style.WindowBorderSize = 0;
  style.FrameRounding = 3;
  style.FrameBorderSize = 1;
  style.GrabMinSize = 14;
  style.Colors[ImGuiCol_WindowBg] = {0.96f, 0.96f, 0.96f, 1};
  style.Colors[ImGuiCol_ChildBg] = {1, 1, 1, 1};
  style.Colors[ImGuiCol_PopupBg] = {1, 1, 0.94f, 1};
  ImGui_ImplOpenGL2_Init();
  ImGui_ImplOpenGL2_NewFrame();  // uploads the fonts
  glGenTextures(1, &picture_texture_);
}

ImguiScreen::~ImguiScreen() {
  activate();
  glDeleteTextures(1, &picture_texture_);
  ImGui_ImplOpenGL2_Shutdown();
}

void ImguiScreen::activate() {
  ImGui::SetCurrentContext(imgui_.get());
  offscreen_.make_current();
}

void ImguiScreen::begin(const Input& input) {
  activate();
  ImGuiIO& io = ImGui::GetIO();
  io.DeltaTime = 1.0f / 60;
  io.MousePos = {float(input.mouse[0]), float(input.mouse[1])};
  io.MouseDown[0] = input.button;
  io.MouseWheel = float(input.wheel);
  ImGui_ImplOpenGL2_NewFrame();
  ImGui::NewFrame();
}

void ImguiScreen::upload(const Image& picture) {
  activate();
  glBindTexture(GL_TEXTURE_2D, picture_texture_);
  for (GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER})
    glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB, picture.width, picture.height, 0, GL_RGB, GL_UNSIGNED_BYTE,
               picture.rgb.data());
}

void* ImguiScreen::picture_id() const {
  return reinterpret_cast<void*>(std::uintptr_t(picture_texture_));
}

const Image& ImguiScreen::end() {
  activate();
  ImGui::Render();
  glDisable(GL_SCISSOR_TEST);
  glClearColor(1, 1, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL2_RenderDrawData(ImGui::GetDrawData());
  const std::uint8_t* rgba = offscreen_.read();
  std::uint8_t* rgb = image_.rgb.data();
  for (int i = 0; i < image_.width * image_.height; ++i)
    for (int channel = 0; channel < 3; ++channel) rgb[3 * i + channel] = rgba[4 * i + channel];
  return image_;
}

}  // namespace sem
