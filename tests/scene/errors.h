#pragma once
// What an InputError says.

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "sem/base/error.h"

namespace sem::test {

/// The text of the InputError that the call throws; empty if it throws none.
template <class Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// The text names the file first, then has all the pieces.
inline void check_names(const std::string& text, const std::string& file,
                        const std::vector<std::string>& pieces) {
  CAPTURE(text);
  CHECK(text.starts_with(file + ": "));
  for (const auto& piece : pieces) {
    CAPTURE(piece);
    CHECK(text.find(piece) != std::string::npos);
  }
}

}  // namespace sem::test
