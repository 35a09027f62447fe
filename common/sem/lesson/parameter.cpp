#include "sem/lesson/parameter.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "sem/base/error.h"
#include "sem/scene/fields.h"

namespace sem {
namespace {

using Kind = Parameter::Kind;

/// The shortest text that reads back as x.
std::string shortest(double x) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, x == 0 ? 0.0 : x).ptr;
  return {text, end};
}

[[noreturn]] void reject(const Parameter& parameter, const std::string& text) {
  throw InputError("", parameter.name, "'" + text + "'", allowed_text(parameter));
}

double read_number(const Parameter& parameter, const std::string& text, const std::string& all) {
  double x = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, x);
  if (error != std::errc() || stop != end || !std::isfinite(x)) reject(parameter, all);
  return x;
}

/// Position of the text in the list; rejects others, naming the closest.
int find_name(const Parameter& parameter, const std::vector<std::string>& names,
              const std::string& text) {
  const auto found = std::find(names.begin(), names.end(), text);
  if (found != names.end()) return int(found - names.begin());
  const std::string close = closest_name(text, names);
  throw InputError(
      "", parameter.name, "'" + text + "'",
      allowed_text(parameter) + (close.empty() ? "" : " (did you mean '" + close + "'?)"));
}

const std::vector<std::string> off_on{"off", "on"};

}  // namespace

std::string value_text(const Parameter& parameter, const Vec<2>& value) {
  switch (parameter.kind) {
    case Kind::toggle:
      return off_on[value[0] != 0];
    case Kind::choice:
      return parameter.choices[int(value[0])];
    case Kind::point:
      return shortest(value[0]) + "," + shortest(value[1]);
    case Kind::integer:
    case Kind::real:
      break;
  }
  return shortest(value[0]);
}

std::string allowed_text(const Parameter& parameter) {
  const auto range = [&](int i) {
    return shortest(parameter.lower[i]) + " to " + shortest(parameter.upper[i]);
  };
  switch (parameter.kind) {
    case Kind::toggle:
      return "on or off";
    case Kind::choice: {
      std::string text;
      for (std::size_t i = 0; i < parameter.choices.size(); ++i)
        text += (i == 0                              ? ""
                 : i + 1 == parameter.choices.size() ? " or "
                                                     : ", ") +
                parameter.choices[i];
      return text;
    }
    case Kind::point:
      return "x,y with x in " + range(0) + ", y in " + range(1);
    case Kind::integer:
      return "whole numbers from " + range(0);
    case Kind::real:
      break;
  }
  return range(0);
}

Vec<2> read_value(const Parameter& parameter, const std::string& text) {
  if (parameter.kind == Kind::toggle) return {find_name(parameter, off_on, text), 0};
  if (parameter.kind == Kind::choice) return {find_name(parameter, parameter.choices, text), 0};
  Vec<2> value(0, 0);
  if (parameter.kind == Kind::point) {
    const auto comma = text.find(',');
    if (comma == std::string::npos) reject(parameter, text);
    value = {read_number(parameter, text.substr(0, comma), text),
             read_number(parameter, text.substr(comma + 1), text)};
  } else {
    value[0] = read_number(parameter, text, text);
    if (parameter.kind == Kind::integer && value[0] != std::round(value[0]))
      reject(parameter, text);
  }
  for (int i = 0; i < (parameter.kind == Kind::point ? 2 : 1); ++i)
    if (value[i] < parameter.lower[i] || value[i] > parameter.upper[i]) reject(parameter, text);
  return value;
}

}  // namespace sem
