#include "sem/picture/notes.h"

#include <algorithm>
#include <cstdio>

#include "sem/draw/image.h"
#include "sem/draw/view.h"

namespace sem::picture {
namespace {

using Horizontal = TextStyle::Horizontal;
using Vertical = TextStyle::Vertical;

struct StressUnit {
  const char* name;
  double size;
};

// The unit in which a stress is a number from 1 to 1000, if there is one.
StressUnit stress_unit(double stress) {
  constexpr StressUnit units[] = {{"GPa", 1e9}, {"MPa", 1e6},  {"kPa", 1e3},
                                  {"Pa", 1},    {"mPa", 1e-3}, {"µPa", 1e-6}};
  for (const StressUnit& candidate : units)
    if (stress >= candidate.size) return candidate;
  return units[5];
}

std::string formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string moment(const Analysis& analysis, const OutputOptions& output, const State& state) {
  if (analysis.kind == AnalysisKind::modes) return formatted("mode %.0f", double(state.step));
  if (analysis.kind == AnalysisKind::statics) return "static equilibrium";
  const double step = std::min(0.01, analysis.time_step);
  return "t = " + tick_label(state.time, output.frame_rate > 100 ? step : 0.01) + " s";
}

}  // namespace

Color tint(int solid) {
  constexpr Color tints[] = {
      {0.72, 0.80, 0.90, 0.6}, {0.95, 0.80, 0.68, 0.6}, {0.86, 0.78, 0.88, 0.6}};
  return tints[solid % 3];
}

double unit(const Canvas& canvas) { return std::min(canvas.width() / 800, canvas.height() / 600); }

void draw_titles(Canvas& canvas, const Box<2>& area, const std::string& name,
                 const Analysis& analysis, const OutputOptions& output, const State& state,
                 int n_inverted) {
  const double u = unit(canvas), y = 26 * u;
  const auto write = [&](double x, const std::string& text, double size, const Color& color,
                         Horizontal side) {
    canvas.text({x, y}, text, {.size = size * u, .color = color, .horizontal = side});
  };
  write(area.lower[0], name, 17, ink, Horizontal::left);
  write(area.upper[0], moment(analysis, output, state), 17, ink, Horizontal::right);
  if (n_inverted > 0)
    write((area.lower[0] + area.upper[0]) / 2, formatted("%.0f points inverted (gray)", n_inverted),
          14, pin_color, Horizontal::center);
}

void draw_stress_bar(Canvas& canvas, const Box<2>& area, double limit, double largest,
                     const Analysis& analysis) {
  const double u = unit(canvas), left = area.upper[0] + 22 * u;
  const Box<2> bar{Vec<2>(left, area.lower[1] + 48 * u),
                   Vec<2>(left + 16 * u, area.upper[1] - 44 * u)};
  const StressUnit stress = stress_unit(limit);
  const auto write = [&](double x, double y, const std::string& text, double size,
                         const Color& color, Vertical vertical) {
    canvas.text({x, y}, text, {.size = size * u, .color = color, .vertical = vertical});
  };
  write(left, area.lower[1] + 2 * u, "von Mises", 14, ink, Vertical::top);
  write(left, area.lower[1] + 21 * u, std::string("stress (") + stress.name + ")", 14, ink,
        Vertical::top);
  canvas.image(viridis_ramp(), bar);
  canvas.stroke_box(bar, {.color = label_ink, .width = u});
  const double end = limit / stress.size, step = nice_step(0, end, 5);
  for (const double tick : nice_ticks(0, end, 5)) {
    const double y = bar.upper[1] + tick / end * (bar.lower[1] - bar.upper[1]);
    canvas.line({bar.upper[0], y}, {bar.upper[0] + 4 * u, y}, {.color = label_ink, .width = u});
    write(bar.upper[0] + 8 * u, y, tick_label(tick, step), 13, label_ink, Vertical::middle);
  }
  write(left, bar.upper[1] + 16 * u,
        analysis.kind == AnalysisKind::dynamics ? "maximum now" : "maximum", 12, label_ink,
        Vertical::top);
  write(left, bar.upper[1] + 32 * u,
        formatted("%.3g ", largest < 1e-9 * limit ? 0 : largest / stress.size) + stress.name, 13,
        ink, Vertical::top);
}

}  // namespace sem::picture
