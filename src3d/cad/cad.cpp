#include "src3d/cad/cad.h"

#include <algorithm>
#include <cctype>

namespace sem {

bool is_cad_file(const std::string& file) {
  const size_t dot = file.rfind('.');
  if (dot == std::string::npos) return false;
  std::string ending = file.substr(dot + 1);
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return ending == "igs" || ending == "iges" || ending == "stp" || ending == "step";
}

std::vector<SceneSolid<3>> solids_of(const CadModel& model, const Material& material) {
  std::vector<SceneSolid<3>> solids(model.n_solids);
  for (int s = 0; s < model.n_solids; ++s) {
    solids[s].name = "solid." + std::to_string(s + 1);
    solids[s].material = material;
  }
  for (const auto& part : model.parts)
    solids[part.solid].parts.push_back({part.name, part.shape, {}, part.trims, part.color});
  return solids;
}

std::vector<CadPart> cad_parts(const std::vector<SceneSolid<3>>& solids,
                               const Points<3>* controls) {
  std::vector<CadPart> parts;
  Eigen::Index first = 0;
  for (size_t s = 0; s < solids.size(); ++s)
    for (const auto& part : solids[s].parts) {
      CadPart& made = parts.emplace_back();
      made.name = part.name;
      made.shape = part.shape;
      made.trims = part.trims;
      made.color = part.color;
      made.solid = int(s);
      const Eigen::Index n = part.shape.control_points.cols();
      if (controls) made.shape.control_points = controls->middleCols(first, n);
      first += n;
    }
  return parts;
}

}  // namespace sem
