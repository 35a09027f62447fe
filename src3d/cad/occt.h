#pragma once
// Internal: what reading and writing with OpenCASCADE share.

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <TopoDS_Face.hxx>
#include <algorithm>
#include <cctype>
#include <string>

#include "sem/base/error.h"
#include "src3d/cad/cad.h"

namespace sem {

constexpr double metres = 1e-3;  ///< OpenCASCADE's lengths are mm

/// A face as a part of this name, in m. Adds what had to be mended to the notes. Throws InputError,
/// without the file.
CadPart part_of_face(const TopoDS_Face& face, const std::string& name,
                     std::vector<std::string>& notes);

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
