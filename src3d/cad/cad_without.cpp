// Builds without OpenCASCADE.
#include "sem/base/error.h"
#include "src3d/cad/cad.h"

namespace sem {
namespace {

[[noreturn]] void refuse(const std::string& file) {
  throw InputError(
      file, "", "a CAD file, and this build has no OpenCASCADE",
      "a scene in JSON; or a build with Debian's libocct-data-exchange-dev and libocct-ocaf-dev");
}

}  // namespace

bool has_cad() { return false; }
CadModel read_cad(const std::string& file, bool) { refuse(file); }
void write_cad(const std::string& file, const std::vector<CadPart>&) { refuse(file); }

}  // namespace sem
