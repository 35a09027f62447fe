#include "sem/lesson/part_canvas.h"

namespace sem {

PartCanvas::PartCanvas(Canvas& whole, const Box<2>& rectangle)
    : whole_(whole),
      origin_(rectangle.lower.array().round()),
      size_((rectangle.upper - origin_).array().round()) {
  whole_.push_clip({origin_, origin_ + size_});
}

PartCanvas::~PartCanvas() { whole_.pop_clip(); }

Polyline PartCanvas::moved(std::span<const Vec<2>> points) const {
  Polyline there(points.begin(), points.end());
  for (auto& x : there) x += origin_;
  return there;
}

void PartCanvas::fill(std::span<const Polyline> loops, const Color& color) {
  std::vector<Polyline> there;
  for (const auto& loop : loops) there.push_back(moved(loop));
  whole_.fill(there, color);
}

void PartCanvas::stroke(std::span<const Vec<2>> points, const Stroke& style) {
  whole_.stroke(moved(points), style);
}

void PartCanvas::text(const Vec<2>& position, const std::string& utf8, const TextStyle& style) {
  whole_.text(position + origin_, utf8, style);
}

double PartCanvas::text_width(const std::string& utf8, double size) {
  return whole_.text_width(utf8, size);
}

void PartCanvas::image(const Image& image, const Box<2>& rectangle) {
  whole_.image(image, moved(rectangle));
}

void PartCanvas::push_clip(const Box<2>& rectangle) { whole_.push_clip(moved(rectangle)); }

void PartCanvas::pop_clip() { whole_.pop_clip(); }

}  // namespace sem
