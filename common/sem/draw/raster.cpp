#include "sem/draw/raster.h"

#include <GL/gl.h>
#include <backends/imgui_impl_opengl2.h>
#include <imgui.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <deque>
#include <map>
#include <utility>

#include "sem/base/error.h"
#include "sem/draw/font.h"
#include "sem/draw/offscreen.h"
#include "sem/draw/stroker.h"

namespace sem {
namespace {

static_assert(sizeof(ImDrawIdx) == 2, "draw lists are split for 16-bit indices");
constexpr int max_vertices = 65535;

/// Draw callbacks. Areas whose triangles overlap are first marked in the stencil buffer, then
/// covered once by a rectangle: even-odd areas by inverting the mark, unions by setting it.
enum StencilUse : std::intptr_t { mark_even_odd, mark_union, cover_marked, no_stencil };

void set_stencil(const ImDrawList*, const ImDrawCmd* command) {
  const auto use = StencilUse(reinterpret_cast<std::intptr_t>(command->UserCallbackData));
  const bool marking = use == mark_even_odd || use == mark_union;
  const GLboolean paint = !marking;
  glColorMask(paint, paint, paint, paint);
  (use == no_stencil ? glDisable : glEnable)(GL_STENCIL_TEST);
  if (marking) {
    glStencilFunc(GL_ALWAYS, 1, 1);
    const GLenum mark = use == mark_even_odd ? GL_INVERT : GL_REPLACE;
    glStencilOp(mark, mark, mark);
  } else {
    glStencilFunc(GL_EQUAL, 1, 1);
    glStencilOp(GL_KEEP, GL_ZERO, GL_ZERO);  // leaves the buffer unmarked
  }
}

/// Clips to a rectangle in pixels of the large picture. Not by scissor: llvmpipe's scissor lets
/// samples of neighbouring pixels through when there are several samples a pixel.
void set_clip(const ImDrawList*, const ImDrawCmd* command) {
  const auto& clip = *static_cast<const ImVec4*>(command->UserCallbackData);
  const double planes[4][4] = {
      {1, 0, 0, -clip.x}, {0, 1, 0, -clip.y}, {-1, 0, 0, clip.z}, {0, -1, 0, clip.w}};
  for (int i = 0; i < 4; ++i) {
    glClipPlane(GL_CLIP_PLANE0 + i, planes[i]);
    glEnable(GL_CLIP_PLANE0 + i);
  }
}

/// A polygon that a fan of triangles from its first corner covers without overlap: it turns to one
/// side only, and once around (x changes its direction at most twice).
bool is_convex(const Polyline& loop) {
  const std::size_t n = loop.size();
  bool left = false, right = false;
  int n_reversals = 0;
  double last_dx = 0, first_dx = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec<2> a = loop[(i + 1) % n] - loop[i], b = loop[(i + 2) % n] - loop[(i + 1) % n];
    const double turn = a[0] * b[1] - a[1] * b[0];
    left = left || turn > 0;
    right = right || turn < 0;
    if (turn == 0 && a.dot(b) < 0) return false;
    if (a[0] == 0) continue;
    if (first_dx == 0) first_dx = a[0];
    n_reversals += last_dx * a[0] < 0;
    last_dx = a[0];
  }
  n_reversals += last_dx * first_dx < 0;
  return !(left && right) && n_reversals <= 2;
}

ImU32 pack(const Color& c) {
  return ImGui::ColorConvertFloat4ToU32({float(c.r), float(c.g), float(c.b), float(c.a)});
}

GLuint make_texture(GLenum format, int width, int height, const void* data, GLint filter) {
  GLuint id = 0;
  glGenTextures(1, &id);
  glBindTexture(GL_TEXTURE_2D, id);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  for (GLenum wrap : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T})
    glTexParameteri(GL_TEXTURE_2D, wrap, 0x812F);  // GL_CLAMP_TO_EDGE
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GLint(format), width, height, 0, format, GL_UNSIGNED_BYTE, data);
  return id;
}

/// RGBA bytes: the colour left out is transparent, all others opaque.
std::vector<std::uint8_t> with_opacity(const Image& image) {
  std::vector<std::uint8_t> rgba;
  rgba.reserve(image.rgb.size() / 3 * 4);
  for (auto at = image.rgb.begin(); at != image.rgb.end(); at += 3) {
    rgba.insert(rgba.end(), at, at + 3);
    rgba.push_back(std::equal(at, at + 3, image.left_out->begin()) ? 0 : 255);
  }
  return rgba;
}

/// Mean of each block of S x S pixels, rounded.
template <int S>
Image box_filter(const std::uint8_t* rgba, int width, int height) {
  Image image(width, height);
  const std::size_t row_bytes = std::size_t(4) * S * width;
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      unsigned sum[3] = {S * S / 2, S * S / 2, S * S / 2};
      const std::uint8_t* block = rgba + row * S * row_bytes + std::size_t(4) * S * column;
      for (int y = 0; y < S; ++y)
        for (int x = 0; x < S; ++x)
          for (int i = 0; i < 3; ++i) sum[i] += block[y * row_bytes + 4 * x + i];
      for (int i = 0; i < 3; ++i) image.pixel(column, row)[i] = std::uint8_t(sum[i] / (S * S));
    }
  return image;
}

struct ImGuiContextDeleter {
  void operator()(ImGuiContext* context) const { ImGui::DestroyContext(context); }
};

struct UV {
  float u = 0, v = 0;
};

}  // namespace

struct RasterCanvas::Impl {
  int width, height, scale;
  OffscreenContext offscreen;
  std::unique_ptr<ImGuiContext, ImGuiContextDeleter> imgui;
  GLuint white = 0;                    // texture of all that is not text or image
  std::map<int, Font> fonts;           // by size in quarter pixels of the large picture
  std::vector<GLuint> image_textures;  // of the pending draw lists
  std::vector<std::unique_ptr<ImDrawList>> lists;
  std::vector<ImVec4> clips;      // nested; the innermost last
  std::deque<ImVec4> sent_clips;  // of the pending draw lists

  GLuint texture = 0;

  Impl(int w, int h, int s) : width(w), height(h), scale(s), offscreen(w * s, h * s) {
    imgui.reset(ImGui::CreateContext());
    activate();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().LogFilename = nullptr;
    ImGui_ImplOpenGL2_Init();
    const std::uint8_t one = 255;
    white = make_texture(GL_ALPHA, 1, 1, &one, GL_NEAREST);
    start_over();
  }

  ~Impl() {
    activate();
    lists.clear();
    ImGui_ImplOpenGL2_Shutdown();
  }

  void activate() {
    ImGui::SetCurrentContext(imgui.get());
    offscreen.make_current();
  }

  void start_over() {
    lists.clear();
    if (!image_textures.empty())
      glDeleteTextures(GLsizei(image_textures.size()), image_textures.data());
    image_textures.clear();
    sent_clips.clear();
    clips = {ImVec4(0, 0, float(width * scale), float(height * scale))};
  }

  /// The list that takes n more vertices of the given texture.
  ImDrawList& reserve(int n_vertices, int n_indices, GLuint id) {
    assert(n_vertices <= max_vertices);
    if (lists.empty() || lists.back()->VtxBuffer.Size + n_vertices > max_vertices) {
      lists.push_back(std::make_unique<ImDrawList>(ImGui::GetDrawListSharedData()));
      lists.back()->_ResetForNewFrame();
      lists.back()->PushClipRect({0, 0}, {float(width * scale), float(height * scale)});
      lists.back()->PushTextureID(ImTextureID(std::intptr_t(id)));
      texture = id;
    } else if (id != texture) {
      lists.back()->PopTextureID();
      lists.back()->PushTextureID(ImTextureID(std::intptr_t(id)));
      texture = id;
    }
    lists.back()->PrimReserve(n_indices, n_vertices);
    return *lists.back();
  }

  /// Sends the innermost clip rectangle to the pending lists.
  void send_clip() {
    sent_clips.push_back(clips.back());
    reserve(0, 0, white).AddCallback(set_clip, &sent_clips.back());
  }

  void vertex(ImDrawList& list, const Vec<2>& x, UV uv, ImU32 color) {
    list.PrimVtx({float(x[0] * scale), float(x[1] * scale)}, {uv.u, uv.v}, color);
  }

  void stencil(StencilUse use) {
    reserve(0, 0, white).AddCallback(set_stencil, reinterpret_cast<void*>(std::intptr_t(use)));
  }

  void triangles(std::span<const Vec<2>> corners, ImU32 color) {
    constexpr std::size_t n_max = max_vertices / 3 * 3;
    for (std::size_t begin = 0; begin < corners.size(); begin += n_max) {
      const auto part = corners.subspan(begin, std::min(n_max, corners.size() - begin));
      auto& list = reserve(int(part.size()), int(part.size()), white);
      for (const auto& x : part) vertex(list, x, {}, color);
    }
  }

  /// The triangles (first corner, edge) of a loop: each point is covered as often as the loop winds
  /// around it, in parity. Long loops go in pieces.
  void fan(const Polyline& loop, ImU32 color) {
    constexpr std::size_t piece = 16384;
    for (std::size_t begin = 1; begin + 1 < loop.size(); begin += piece) {
      const int n = int(std::min(piece, loop.size() - 1 - begin));  // triangles
      auto& list = reserve(n + 2, 3 * n, white);
      const unsigned first = list._VtxCurrentIdx;
      const auto point = [&](const Vec<2>& x) {
        list.PrimWriteVtx({float(x[0] * scale), float(x[1] * scale)}, {0, 0}, color);
      };
      point(loop[0]);
      for (int i = 0; i <= n; ++i) point(loop[begin + i]);
      for (int i = 1; i <= n; ++i)
        for (unsigned corner : {first, first + i, first + i + 1})
          list.PrimWriteIdx(ImDrawIdx(corner));
    }
  }

  void quad(const Vec<2> (&corners)[4], const UV (&uv)[4], GLuint id, ImU32 color) {
    auto& list = reserve(6, 6, id);
    for (int i : {0, 1, 2, 0, 2, 3}) vertex(list, corners[i], uv[i], color);
  }

  void cover(const Box<2>& box, ImU32 color) {
    stencil(cover_marked);
    const Vec<2> corners[4] = {
        box.lower, {box.upper[0], box.lower[1]}, box.upper, {box.lower[0], box.upper[1]}};
    quad(corners, {}, white, color);
    stencil(no_stencil);
  }

  void render() {
    if (lists.empty()) return;
    std::vector<ImDrawList*> pointers;
    ImDrawData data;
    for (const auto& list : lists) {
      pointers.push_back(list.get());
      data.TotalVtxCount += list->VtxBuffer.Size;
      data.TotalIdxCount += list->IdxBuffer.Size;
    }
    data.Valid = true;
    data.CmdLists = pointers.data();
    data.CmdListsCount = int(pointers.size());
    data.DisplaySize = {float(width * scale), float(height * scale)};
    data.FramebufferScale = {1, 1};
    ImGui_ImplOpenGL2_RenderDrawData(&data);
  }

  Font& font(double size) {
    constexpr double largest = 160;  // em in the texture; larger text is magnified
    const int key = int(std::lround(4 * std::clamp(size * scale, 0.25, largest)));
    const auto found = fonts.find(key);
    if (found != fonts.end()) return found->second;
    Font& made = fonts.try_emplace(key, key / 4.0).first->second;
    activate();
    int w = 0, h = 0;
    const unsigned char* coverage = made.texture(&w, &h);
    made.texture_id = make_texture(GL_ALPHA, w, h, coverage, GL_LINEAR);
    return made;
  }
};

RasterCanvas::RasterCanvas(int width, int height, int supersample) {
  const auto in_range = [](int value, int hi, const char* field) {
    if (value < 1 || value > hi)
      throw InputError("", field, std::to_string(value), "1 to " + std::to_string(hi));
  };
  in_range(width, 8192, "picture width");
  in_range(height, 8192, "picture height");
  in_range(supersample, 4, "supersampling");
  impl_ = std::make_unique<Impl>(width, height, supersample);
  clear();
}

RasterCanvas::~RasterCanvas() = default;

double RasterCanvas::width() const { return impl_->width; }
double RasterCanvas::height() const { return impl_->height; }

void RasterCanvas::clear(const Color& background) {
  impl_->activate();
  impl_->start_over();
  glDisable(GL_SCISSOR_TEST);
  glColorMask(1, 1, 1, 1);
  glClearColor(float(background.r), float(background.g), float(background.b), 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
}

Image RasterCanvas::finish() {
  impl_->activate();
  impl_->render();
  auto clips = std::move(impl_->clips);
  impl_->start_over();
  impl_->clips = std::move(clips);
  impl_->send_clip();
  constexpr decltype(&box_filter<1>) filters[] = {box_filter<1>, box_filter<2>, box_filter<3>,
                                                  box_filter<4>};
  return filters[impl_->scale - 1](impl_->offscreen.read(), impl_->width, impl_->height);
}

void RasterCanvas::fill(std::span<const Polyline> loops, const Color& color) {
  std::vector<const Polyline*> valid;
  Box<2> box;
  for (const auto& loop : loops) {
    Box<2> loop_box;
    bool finite = loop.size() >= 3;
    for (const auto& x : loop) {
      finite = finite && x.allFinite();
      loop_box.include(x);
    }
    if (!finite) continue;
    valid.push_back(&loop);
    box.include(loop_box);
  }
  if (valid.empty()) return;
  const ImU32 packed = pack(color);
  if (valid.size() == 1 && is_convex(*valid[0])) return impl_->fan(*valid[0], packed);
  impl_->stencil(mark_even_odd);
  for (const auto* loop : valid) impl_->fan(*loop, packed);
  impl_->cover(box, packed);
}

void RasterCanvas::stroke(std::span<const Vec<2>> points, const Stroke& style) {
  const auto triangles = stroke_triangles(points, style);
  if (triangles.empty()) return;
  const ImU32 packed = pack(style.color);
  if (style.color.a >= 1) return impl_->triangles(triangles, packed);
  Box<2> box;
  for (const auto& x : triangles) box.include(x);
  impl_->stencil(mark_union);
  impl_->triangles(triangles, packed);
  impl_->cover(box, packed);
}

double RasterCanvas::text_width(const std::string& utf8, double size) {
  const Font& font = impl_->font(size);
  return font.width(utf8) * size / font.size();
}

void RasterCanvas::text(const Vec<2>& position, const std::string& utf8, const TextStyle& style) {
  if (!position.allFinite() || !(style.size > 0)) return;
  const Font& font = impl_->font(style.size);
  const double unit = style.size / font.size();  // output pixels per pixel of the texture
  const Vec<2> origin = text_origin(position, style, font.width(utf8) * unit);
  const Vec<2> along = style.upward ? Vec<2>(0, -1) : Vec<2>(1, 0);
  const Vec<2> down = style.upward ? Vec<2>(1, 0) : Vec<2>(0, 1);
  font.for_each_glyph(utf8, [&](const ImFontGlyph& glyph, double x) {
    if (!glyph.Visible) return;
    const auto at = [&](double gx, double gy) -> Vec<2> {
      return origin + unit * ((x + gx) * along + (gy - font.ascent()) * down);
    };
    const Vec<2> corners[4] = {at(glyph.X0, glyph.Y0), at(glyph.X1, glyph.Y0),
                               at(glyph.X1, glyph.Y1), at(glyph.X0, glyph.Y1)};
    const UV uv[4] = {
        {glyph.U0, glyph.V0}, {glyph.U1, glyph.V0}, {glyph.U1, glyph.V1}, {glyph.U0, glyph.V1}};
    impl_->quad(corners, uv, font.texture_id, pack(style.color));
  });
}

void RasterCanvas::image(const Image& image, const Box<2>& rectangle) {
  if (image.width == 0 || image.height == 0) return;
  impl_->activate();
  const GLuint id =
      image.left_out
          ? make_texture(GL_RGBA, image.width, image.height, with_opacity(image).data(), GL_NEAREST)
          : make_texture(GL_RGB, image.width, image.height, image.rgb.data(), GL_NEAREST);
  impl_->image_textures.push_back(id);
  const Vec<2>&a = rectangle.lower, &b = rectangle.upper;
  impl_->quad({a, {b[0], a[1]}, b, {a[0], b[1]}}, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, id,
              pack(colors::white));
}

void RasterCanvas::push_clip(const Box<2>& rectangle) {
  const auto snapped = [&](double x) { return float(std::round(x * impl_->scale)); };
  const ImVec4& outer = impl_->clips.back();
  ImVec4 clip(std::max(outer.x, snapped(rectangle.lower[0])),
              std::max(outer.y, snapped(rectangle.lower[1])),
              std::min(outer.z, snapped(rectangle.upper[0])),
              std::min(outer.w, snapped(rectangle.upper[1])));
  impl_->clips.push_back(clip);
  impl_->send_clip();
}

void RasterCanvas::pop_clip() {
  assert(impl_->clips.size() > 1);
  impl_->clips.pop_back();
  impl_->send_clip();
}

}  // namespace sem
