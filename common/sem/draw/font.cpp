#include "sem/draw/font.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <cmath>
#include <filesystem>

#include "sem/base/error.h"

namespace sem {
namespace {

/// Dear ImGui counts the size from ascender to descender; this over the em, in DejaVu Sans.
constexpr double line_height_per_em = 2384.0 / 2048.0;

/// Latin, Greek, dashes and quotes, super- and subscripts, arrows, mathematical operators (with
/// U+2212).
constexpr ImWchar ranges[] = {0x0020, 0x00ff, 0x0370, 0x03ff, 0x1d62, 0x1d6a,
                              0x2010, 0x2026, 0x2070, 0x209c, 0x2190, 0x2195,
                              0x2200, 0x22ff, 0x2c7c, 0x2c7c, 0};

/// SEM_FONT_FILE is set by the build.
std::string font_file() {
  if (std::filesystem::exists(SEM_FONT_FILE)) return SEM_FONT_FILE;
  throw InputError(SEM_FONT_FILE, "font", "no such file",
                   "DejaVu Sans (package fonts-dejavu-core) where it was at build time");
}

}  // namespace

Vec<2> text_origin(const Vec<2>& position, const TextStyle& style, double width) {
  using Horizontal = TextStyle::Horizontal;
  using Vertical = TextStyle::Vertical;
  // In the frame of the text: x along the baseline, y down from the anchor.
  double left = 0, baseline = 0;
  if (style.horizontal != Horizontal::left)
    left = -width * (style.horizontal == Horizontal::center ? 0.5 : 1);
  if (style.vertical == Vertical::top) baseline = font_cap_height * style.size;
  if (style.vertical == Vertical::middle) baseline = font_cap_height * style.size / 2;
  if (style.vertical == Vertical::bottom) baseline = -font_descent * style.size;
  const Vec<2> along = style.upward ? Vec<2>(0, -1) : Vec<2>(1, 0);
  const Vec<2> down = style.upward ? Vec<2>(1, 0) : Vec<2>(0, 1);
  Vec<2> origin = position + left * along + baseline * down;
  const int across = style.upward ? 0 : 1;
  origin[across] = std::round(origin[across]);
  return origin;
}

Font::Font(double size) : size_(size), atlas_(new ImFontAtlas) {
  atlas_->Flags |= ImFontAtlasFlags_NoMouseCursors | ImFontAtlasFlags_NoBakedLines;
  ImFontConfig config;
  config.OversampleH = 2;
  config.OversampleV = 1;
  atlas_->AddFontFromFileTTF(font_file().c_str(), float(size * line_height_per_em), &config,
                             ranges);
  atlas_->Build();
}

Font::~Font() = default;

double Font::ascent() const { return atlas_->Fonts[0]->Ascent; }

unsigned char* Font::texture(int* width, int* height) const {
  unsigned char* coverage = nullptr;
  atlas_->GetTexDataAsAlpha8(&coverage, width, height);
  return coverage;
}

void Font::for_each_glyph(const std::string& utf8,
                          const std::function<void(const ImFontGlyph&, double x)>& visit) const {
  double x = 0;
  const char* const end = utf8.data() + utf8.size();
  for (const char* at = utf8.data(); at < end;) {
    unsigned int character = 0;
    at += ImTextCharFromUtf8(&character, at, end);
    const ImFontGlyph* glyph = atlas_->Fonts[0]->FindGlyph(ImWchar(character));
    if (!glyph) continue;
    visit(*glyph, x);
    x += glyph->AdvanceX;
  }
}

double Font::width(const std::string& utf8) const {
  double width = 0;
  for_each_glyph(utf8, [&](const ImFontGlyph& glyph, double x) { width = x + glyph.AdvanceX; });
  return width;
}

}  // namespace sem
