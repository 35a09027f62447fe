#pragma once
// CAD files in and out: IGES and STEP through OpenCASCADE, where the build has it.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sem/scene/scene.h"

namespace sem {

/// A face: a NURBS surface and what it is trimmed to.
struct CadPart {
  std::string name;      ///< unique in the model; from the file where it names the face
  Nurbs<2, 3> shape;     ///< control points in m
  TrimLoops trims = {};  ///< none where they are the border of the domain
  std::optional<std::array<double, 3>> color = {};  ///< red, green, blue in [0, 1], linear
  int solid = 0;  ///< faces of one solid or shell of the file; loose faces are one solid together,
                  ///< or those that a name "solid.2/NAME" leads with the same solid
  bool reversed =
      false;  ///< the file has the outside against the surface's normal; for information
};

struct CadModel {
  std::vector<CadPart> parts;
  int n_solids = 0;
  std::string unit;                ///< of the file
  std::vector<std::string> notes;  ///< what had to be mended
  // OpenCASCADE's own, for comparison.
  std::vector<double> area;      ///< m^2, of each part
  std::optional<double> volume;  ///< m^3, sum over the shells that faces make when joined to 1e-4
                                 ///< of the size; none: edges stay free
  int n_free_edges = 0;
};

/// True if CAD files can be read and written.
bool has_cad();

/// True if the file's name ends as those of CAD files do: .igs, .iges, .stp, .step, in any case.
bool is_cad_file(const std::string& file);

/// Every face as NURBS with its trims, in metres whatever the file's unit. Throws InputError for a
/// file that is not there, not readable, empty, cut off, without faces or with one that
/// OpenCASCADE takes from the wrong side, and if the build has no OpenCASCADE. `measure`: also
/// OpenCASCADE's own areas, volume and free edges.
CadModel read_cad(const std::string& file, bool measure = true);

/// Writes the parts, each as a face with its name and colour, in mm; read_cad gives the same back,
/// control points to 1e-12 of the size. Parts of several solids are named "solid.2/NAME" in the
/// file. STEP or IGES by the name's ending. Throws InputError as read_cad, and for parts that these
/// formats cannot hold (jumps inside, degree above 25).
void write_cad(const std::string& file, const std::vector<CadPart>& parts);

/// The solids of a scene from a model, all of one material, named by the file's solids.
std::vector<SceneSolid<3>> solids_of(const CadModel& model, const Material& material);

/// The parts of a scene's solids with the control points of a state (Dim by all control points;
/// none: at rest), as CAD parts.
std::vector<CadPart> cad_parts(const std::vector<SceneSolid<3>>& solids,
                               const Points<3>* controls = nullptr);

}  // namespace sem
