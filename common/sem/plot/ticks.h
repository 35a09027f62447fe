#pragma once
// Where an axis has its ticks, and what stands there.

#include <string>
#include <vector>

namespace sem {

/// A mark on an axis; without a label it is drawn shorter.
struct Tick {
  double value = 0;
  std::string label = {};
};

/// The ticks of an axis. Where the numbers are very large or small, labels show them divided by a
/// power of ten and `factor` is that power, e.g. "10⁻⁶"; else it is empty.
struct Ticks {
  std::vector<Tick> ticks;
  std::string factor = {};
};

/// Steps of 1, 2 or 5 times a power of ten, at most n intervals; lower < upper, n >= 1.
Ticks linear_ticks(double lower, double upper, int n);

/// Decades as powers of ten, at most about n labelled, the others and (up to six decades) 2...9
/// times a decade unlabelled. Less than two decades: 1, 2, 5 times a decade with plain numbers. 0 <
/// lower < upper.
Ticks log_ticks(double lower, double upper, int n);

/// The label of an axis with the ticks' factor in its unit: "energy (J)" becomes "energy (10⁻⁶ J)".
std::string axis_label(const std::string& label, const Ticks& ticks);

/// "10⁻³" for -3.
std::string power_of_ten(int exponent);

/// A number for a text, with n significant digits, U+2212 as the minus and, where it is shorter, a
/// power of ten: "0.25", "−3.1", "2.5×10⁻⁶"; "–" if it is not a number.
std::string number_text(double value, int n_digits = 3);

}  // namespace sem
