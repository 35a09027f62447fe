#pragma once
// A checkpoint: all that a run needs to go on bit for bit.

#include <string>
#include <vector>

#include "sem/solve/system.h"

namespace sem {

struct Checkpoint {
  std::string settings;       ///< fingerprint of the scene that made it
  State state;
  std::vector<std::string> columns;            ///< of the history
  std::vector<std::vector<double>> history;    ///< all rows so far, as long as the columns
};

/// 16 hexadecimal digits (FNV-1a, 64 bits).
std::string fingerprint(const std::string& text);

/// Binary, little endian, with a checksum; written whole or not at all (files.h).
void write_checkpoint(const std::string& path, const Checkpoint& checkpoint);

/// Throws InputError for a file that is missing, damaged, of another version or
/// made by other settings than `settings`.
Checkpoint read_checkpoint(const std::string& path, const std::string& settings);

}  // namespace sem
