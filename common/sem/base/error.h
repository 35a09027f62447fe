#pragma once
// Two kinds of check: InputError for what a user can get wrong (files,
// scenes, arguments), assert for what only a programmer can.

#include <stdexcept>
#include <string>

namespace sem {

/// Bad input. The text names the file, the field, what was found there and
/// what is allowed; programs print it and exit with 2.
class InputError : public std::runtime_error {
 public:
  InputError(const std::string& file, const std::string& field,
             const std::string& found, const std::string& allowed)
      : std::runtime_error((file.empty() ? "" : file + ": ") +
                           (field.empty() ? "" : field + ": ") + "found " +
                           found + "; allowed: " + allowed) {}
  /// The same error, raised where the file was not known.
  InputError(const std::string& file, const InputError& error)
      : std::runtime_error(file + ": " + error.what()) {}
};

}  // namespace sem
