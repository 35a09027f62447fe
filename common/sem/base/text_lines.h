#pragma once
#include <cstdio>
#include <string>

namespace sem {

/// Appends what printf would write, at most 399 characters.
template <class... Values>
void append_formatted(std::string& text, const char* format, const Values&... values) {
  char line[400];
  std::snprintf(line, sizeof line, format, values...);
  text += line;
}

}  // namespace sem
