#include "sem/draw/svg.h"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <cmath>

#include "sem/draw/font.h"
#include "sem/draw/image.h"
#include "sem/draw/stroker.h"

namespace sem {
namespace {

/// To 1/`per_unit`, without trailing zeros.
std::string number(double value, double per_unit = 100) {
  const double rounded = std::round(value * per_unit) / per_unit;
  char digits[40];
  const auto end = std::to_chars(digits, digits + sizeof digits, rounded + 0.0,  // no negative zero
                                 std::chars_format::fixed);
  return std::string(digits, end.ptr);
}

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}
std::string attribute(const char* name, double value) { return attribute(name, number(value)); }

/// fill or stroke, with opacity where it is not 1.
std::string paint(const std::string& what, const Color& color, bool with_opacity = true) {
  const auto byte = [](double part) { return int(std::lround(255 * std::clamp(part, 0.0, 1.0))); };
  char hex[8];
  std::snprintf(hex, sizeof hex, "#%02x%02x%02x", byte(color.r), byte(color.g), byte(color.b));
  std::string text = attribute(what.c_str(), hex);
  if (with_opacity && color.a < 1)
    text += attribute((what + "-opacity").c_str(), number(color.a, 1000));
  return text;
}

std::string escaped(const std::string& utf8) {
  std::string text;
  for (const char c : utf8) switch (c) {
      case '&':
        text += "&amp;";
        break;
      case '<':
        text += "&lt;";
        break;
      case '>':
        text += "&gt;";
        break;
      case '"':
        text += "&quot;";
        break;
      default:
        text += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;  // XML has no control characters
    }
  return text;
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
  static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? bytes[i + k] : 0);
    for (int shift = 18; shift >= 0; shift -= 6) text += digits[group >> shift & 63];
  }
  const std::size_t n_missing = (3 - bytes.size() % 3) % 3;
  text.replace(text.size() - n_missing, n_missing, n_missing, '=');
  return text;
}

/// Repeats pixels until none is larger than about 3 pixels of the canvas: viewers that interpolate
/// between pixels still show cells with sharp edges.
Image repeated(const Image& image, const Vec<2>& size) {
  const auto times = [](double pixels, int n) {
    return std::clamp(int(std::ceil(std::abs(pixels) / n / 3)), 1, std::max(1, 2048 / n));
  };
  const int nx = times(size[0], image.width), ny = times(size[1], image.height);
  Image large(nx * image.width, ny * image.height);
  large.left_out = image.left_out;
  for (int row = 0; row < large.height; ++row)
    for (int column = 0; column < large.width; ++column)
      std::copy_n(image.pixel(column / nx, row / ny), 3, large.pixel(column, row));
  return large;
}

/// Path commands through the points. Coordinates that are equal when rounded are dropped.
std::string path(const std::vector<Vec<2>>& points, bool closed) {
  std::string text, last;
  bool first = true;
  for (const auto& x : points) {
    std::string at = number(x[0]) + " " + number(x[1]);
    if (at == last) continue;
    text += (first ? "M" : "L") + at;
    last = std::move(at);
    first = false;
  }
  if (closed) text += "Z";
  return text;
}

/// Corners sharper than 60 degrees, which are rounded.
std::vector<Vec<2>> sharp_corners(const Chain& chain) {
  std::vector<Vec<2>> corners;
  const std::size_t n = chain.points.size();
  for (std::size_t i = chain.closed ? 0 : 1; i + (chain.closed ? 0 : 1) < n; ++i) {
    const Vec<2>&a = chain.points[(i + n - 1) % n], &b = chain.points[i],
          &c = chain.points[(i + 1) % n];
    const double cosine = (a - b).normalized().dot((c - b).normalized());
    // 1 / sin(half angle) > limit
    if ((1 - cosine) / 2 * miter_limit * miter_limit < 1) corners.push_back(b);
  }
  return corners;
}

}  // namespace

struct SvgCanvas::Impl {
  int width, height;
  double dots_per_inch;
  Font font{32};  // for its metrics
  std::string definitions = {}, body = {};
  int n_clips = 0, n_open = 0;
};

SvgCanvas::SvgCanvas(int width, int height, double dots_per_inch)
    : impl_(new Impl{width, height, dots_per_inch}) {
  assert(width > 0 && height > 0 && dots_per_inch > 0);
}

SvgCanvas::~SvgCanvas() = default;

std::string SvgCanvas::finish() const {
  const auto inches = [&](int pixels) { return number(pixels / impl_->dots_per_inch, 1e6) + "in"; };
  const std::string w = number(impl_->width), h = number(impl_->height);
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\""
      " xmlns:xlink=\"http://www.w3.org/1999/xlink\"" +
      attribute("width", inches(impl_->width)) + attribute("height", inches(impl_->height)) +
      attribute("viewBox", "0 0 " + w + " " + h) +
      " font-family=\"DejaVu Sans, sans-serif\" "
      "style=\"font-kerning:none;font-variant-ligatures:none\">\n";
  if (!impl_->definitions.empty()) text += "<defs>\n" + impl_->definitions + "</defs>\n";
  text += "<rect" + attribute("width", w) + attribute("height", h) + paint("fill", colors::white) +
          "/>\n";
  text += impl_->body;
  for (int i = 0; i < impl_->n_open; ++i) text += "</g>\n";
  return text + "</svg>\n";
}

double SvgCanvas::width() const { return impl_->width; }
double SvgCanvas::height() const { return impl_->height; }

void SvgCanvas::fill(std::span<const Polyline> loops, const Color& color) {
  std::string d;
  for (const auto& loop : loops)
    if (loop.size() >= 3 &&
        std::all_of(loop.begin(), loop.end(), [](const Vec<2>& x) { return x.allFinite(); }))
      d += path(loop, true);
  if (d.empty()) return;
  impl_->body += "<path" + attribute("d", d) + paint("fill", color) +
                 (loops.size() > 1 || loops[0].size() > 3 ? " fill-rule=\"evenodd\"" : "") + "/>\n";
}

void SvgCanvas::stroke(std::span<const Vec<2>> points, const Stroke& style) {
  if (!(style.width > 0)) return;
  const bool round = style.cap == Stroke::Cap::round;
  std::string d, discs;
  for (const auto& chain : split_at_gaps(points, style.closed)) {
    if (chain.points.size() == 1) {
      if (round) d += path(chain.points, false) + "h0";
      continue;
    }
    d += path(chain.points, chain.closed);
    if (style.dash.empty())
      for (const auto& corner : sharp_corners(chain))
        discs += "<circle" + attribute("cx", corner[0]) + attribute("cy", corner[1]) +
                 attribute("r", style.width / 2) + paint("fill", style.color, false) + "/>";
  }
  if (d.empty()) return;
  std::string dash;
  double total = 0;
  for (const double length : style.dash) {
    dash += (dash.empty() ? "" : " ") + number(length);
    total += length;
  }
  const bool grouped = !discs.empty() && style.color.a < 1;  // overlaps must not add up
  if (grouped) impl_->body += "<g" + attribute("opacity", number(style.color.a, 1000)) + ">";
  impl_->body += "<path" + attribute("d", d) + " fill=\"none\"" +
                 paint("stroke", style.color, !grouped) + attribute("stroke-width", style.width) +
                 attribute("stroke-miterlimit", "2") + (round ? " stroke-linecap=\"round\"" : "") +
                 (total > 0 ? attribute("stroke-dasharray", dash) : "") + "/>" + discs +
                 (grouped ? "</g>\n" : "\n");
}

double SvgCanvas::text_width(const std::string& utf8, double size) {
  return impl_->font.width(utf8) * size / impl_->font.size();
}

void SvgCanvas::text(const Vec<2>& position, const std::string& utf8, const TextStyle& style) {
  if (!position.allFinite() || !(style.size > 0) || utf8.empty()) return;
  // The anchor stays with the viewer, so that a text in a substitute font keeps its place.
  const int across = style.upward ? 0 : 1;
  Vec<2> at = position;
  at[across] = text_origin(position, style, 0)[across];
  const char* const anchors[] = {"", "middle", "end"};
  const int anchor = int(style.horizontal);
  impl_->body +=
      "<text" + attribute("x", at[0]) + attribute("y", at[1]) + attribute("font-size", style.size) +
      paint("fill", style.color) + (anchor ? attribute("text-anchor", anchors[anchor]) : "") +
      (style.upward
           ? attribute("transform", "rotate(-90 " + number(at[0]) + " " + number(at[1]) + ")")
           : "") +
      " xml:space=\"preserve\">" + escaped(utf8) + "</text>\n";
}

void SvgCanvas::image(const Image& image, const Box<2>& rectangle) {
  const Vec<2> size = rectangle.upper - rectangle.lower;
  if (image.width == 0 || image.height == 0 || !size.allFinite()) return;
  impl_->body +=
      "<image" + attribute("x", rectangle.lower[0]) + attribute("y", rectangle.lower[1]) +
      attribute("width", size[0]) + attribute("height", size[1]) +
      " preserveAspectRatio=\"none\" image-rendering=\"optimizeSpeed\"" +  // SVG 1.1's word
      " style=\"image-rendering:pixelated\"" + " xlink:href=\"data:image/png;base64," +
      base64(encode_png(repeated(image, size))) + "\"/>\n";
}

void SvgCanvas::push_clip(const Box<2>& rectangle) {
  const std::string id = "clip" + std::to_string(++impl_->n_clips);
  const Vec<2> size = (rectangle.upper - rectangle.lower).cwiseMax(0);
  impl_->definitions += "<clipPath" + attribute("id", id) + "><rect" +
                        attribute("x", rectangle.lower[0]) + attribute("y", rectangle.lower[1]) +
                        attribute("width", size[0]) + attribute("height", size[1]) +
                        "/></clipPath>\n";
  impl_->body += "<g" + attribute("clip-path", "url(#" + id + ")") + ">\n";
  ++impl_->n_open;
}

void SvgCanvas::pop_clip() {
  assert(impl_->n_open > 0);
  --impl_->n_open;
  impl_->body += "</g>\n";
}

}  // namespace sem
