#pragma once
// Internal: what reading and writing with OpenCASCADE share.

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <algorithm>
#include <cctype>
#include <string>

#include "sem/base/error.h"
#include "src3d/cad/cad.h"

namespace sem {

/// Its progress and warnings do not go to the output.
inline void quiet_occt() { Message::DefaultMessenger()->ChangePrinters().Clear(); }

/// True for IGES, false for STEP. Throws InputError for other names.
inline bool is_iges(const std::string& file) {
  if (!is_cad_file(file))
    throw InputError(file, "", "a name that is no CAD file's", ".igs, .iges, .stp or .step");
  const char letter = char(std::tolower(static_cast<unsigned char>(file[file.rfind('.') + 1])));
  return letter == 'i';
}

}  // namespace sem
