#pragma once
// Colours, a perceptually uniform colour map and a colour-blind-safe palette.

#include <array>

namespace sem {

/// sRGB components and opacity, each in [0, 1].
struct Color {
  double r = 0, g = 0, b = 0, a = 1;

  constexpr Color with_alpha(double alpha) const { return {r, g, b, alpha}; }
};

namespace colors {

constexpr Color black{0, 0, 0}, white{1, 1, 1}, gray{0.5, 0.5, 0.5}, light_gray{0.85, 0.85, 0.85};

/// Colours that people with any common colour blindness tell apart (Okabe and Ito 2008, "Color
/// universal design"), black last. Figures add markers or dashes where colour carries meaning.
constexpr std::array<Color, 8> okabe_ito{{{0.000, 0.447, 0.698},    // blue
                                          {0.835, 0.369, 0.000},    // vermillion
                                          {0.000, 0.620, 0.451},    // bluish green
                                          {0.800, 0.475, 0.655},    // reddish purple
                                          {0.902, 0.624, 0.000},    // orange
                                          {0.337, 0.706, 0.914},    // sky blue
                                          {0.941, 0.894, 0.259},    // yellow
                                          {0.000, 0.000, 0.000}}};  // black

/// Colour number i of the palette, repeating after eight; i >= 0.
constexpr Color categorical(int i) { return okabe_ito[i % okabe_ito.size()]; }

/// The colour map viridis (Smith and van der Walt 2015, CC0) at t, clamped to [0, 1], interpolated
/// between eleven of its entries; gray if t is not a number.
Color viridis(double t);

/// Blue at 0, white at 1/2, red at 1, as light on one side as on the other; t as above.
Color diverging(double t);

/// (1 - t) a + t b.
constexpr Color mix(const Color& a, const Color& b, double t) {
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b),
          a.a + t * (b.a - a.a)};
}

}  // namespace colors
}  // namespace sem
