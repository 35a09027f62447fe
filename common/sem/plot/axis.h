#pragma once
// An axis as it is asked for, and as it is laid out on the canvas.

#include <optional>
#include <string>
#include <vector>

#include "sem/plot/ticks.h"

namespace sem {

/// An axis of a panel. Limits that are not given follow from the data: the data and a small margin
/// on linear axes, the next 1, 2 or 5 times a decade on logarithmic ones.
struct Axis {
  std::string label = {};
  std::optional<double> lower = {}, upper = {};
  bool logarithmic = false;      ///< values that are not positive are left out
  bool reversed = false;         ///< larger values at the left or bottom
  std::vector<Tick> ticks = {};  ///< in place of the computed ones, e.g. names of categories
  bool tick_labels = true;       ///< false: ticks without numbers, e.g. shared with the panel below
};

/// Smallest and largest of the data along an axis, and the smallest positive one.
struct DataRange {
  double lower, upper, least_positive;
  DataRange();
  void include(double value);  ///< ignores what is not finite
};

/// The limits that the axis has with these data; finite, lower < upper, positive if logarithmic.
std::pair<double, double> axis_limits(const Axis& axis, const DataRange& data);

/// From data to pixels along one axis.
struct AxisScale {
  double lower = 0, upper = 1;  ///< limits in data
  double begin = 0, end = 1;    ///< where they are on the canvas
  bool logarithmic = false;
  /// Pixel of a value; not a number for a value <= 0 on a logarithmic axis.
  double operator()(double value) const;
};

}  // namespace sem
