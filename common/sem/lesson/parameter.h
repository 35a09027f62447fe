#pragma once
// What a reader can change in a lesson: by slider or mouse, or by --set name=value.

#include <functional>
#include <string>
#include <vector>

#include "sem/base/dim.h"

namespace sem {

/// A named value of one of five kinds, bound to a variable of the program.
struct Parameter {
  enum class Kind { integer, real, toggle, choice, point };

  std::string name = {}, help = {};
  Kind kind = Kind::real;
  int step = 0;  ///< it belongs to, from 0
  // Allowed range; of a point: box. Numbers use the first component.
  Vec<2> lower = Vec<2>::Zero(), upper = Vec<2>::Zero();
  bool drawn_only = false;   ///< no step depends on it, only pictures
  bool logarithmic = false;  ///< slider of a real
  std::vector<std::string> choices = {};
  // A number is the first component; a toggle is 0 or 1; a choice is its index.
  std::function<Vec<2>()> get = {};
  std::function<void(const Vec<2>&)> set = {};
};

/// The value as --set takes it: "3", "0.25", "on", "published", "1.5,0.25". Reading it back gives
/// the same value.
std::string value_text(const Parameter& parameter, const Vec<2>& value);

/// What --set accepts, e.g. "1 to 5", "on or off".
std::string allowed_text(const Parameter& parameter);

/// Reads a value. Throws InputError (field: the parameter's name) if it is not of the parameter's
/// kind or out of range.
Vec<2> read_value(const Parameter& parameter, const std::string& text);

}  // namespace sem
