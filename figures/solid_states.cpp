#include "figures/solid_states.h"

#include <algorithm>
#include <cmath>

#include "sem/picture/scales.h"
#include "src3d/picture/surface_stress.h"
#include "src3d/render/tessellate.h"

namespace sem::figures {
namespace {

constexpr int n_grid = 7;

Param<2> at_share(const Nurbs<2, 3>& part, double s, double t) {
  const Interval u = domain(part, 0), v = domain(part, 1);
  return {u.lower + s * (u.upper - u.lower), v.lower + t * (v.upper - v.lower)};
}

// Places of the grid on the rest shape of a part.
Points<3> grid_on(const PreparedNurbs<2, 3>& part) {
  Points<3> places(3, n_grid * n_grid);
  for (int j = 0; j < n_grid; ++j)
    for (int i = 0; i < n_grid; ++i)
      places.col(j * n_grid + i) =
          point(part, at_share(part.nurbs, i / (n_grid - 1.0), j / (n_grid - 1.0)));
  return places;
}

// Between the values of a grid; `share` in [0, 1].
double interpolated(const std::vector<double>& grid, const Vec<2>& share) {
  const Vec<2> at = (n_grid - 1) * share.cwiseMax(0).cwiseMin(1);
  const int i = std::min(int(at[0]), n_grid - 2), j = std::min(int(at[1]), n_grid - 2);
  const double s = at[0] - i, t = at[1] - j;
  const double* corner = &grid[j * n_grid + i];
  return (1 - t) * ((1 - s) * corner[0] + s * corner[1]) +
         t * ((1 - s) * corner[n_grid] + s * corner[n_grid + 1]);
}

double four_digits(double value) {
  if (!(std::abs(value) > 0)) return value;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - 3);
  return std::round(value / unit) * unit;
}

}  // namespace

std::vector<Nurbs<2, 3>> parts_of(const Model<3>& model, const State& state) {
  const auto& d = model.discretization;
  const Points<3> p = control_points(d.unknowns, state.z);
  std::vector<Nurbs<2, 3>> parts;
  for (int i = 0; i < d.boundary.n_parts(); ++i) {
    const int first = d.boundary.first_control[i];
    parts.push_back(d.boundary.parts[i].nurbs);
    parts.back().control_points = p.middleCols(first, d.boundary.first_control[i + 1] - first);
  }
  return parts;
}

void add_body(Data& data, const std::string& name, const Model<3>& model,
              const std::vector<SceneSolid<3>>& solids) {
  add_surfaces(data, parts_of(model, model.initial), name + " ");
  Trims trims;
  for (const auto& solid : solids)
    for (const auto& part : solid.parts) trims.push_back(part.trims);
  add_trims(data, trims, name + " ");
}

void add_state(Data& data, const std::string& name, const Model<3>& model, const State& state) {
  const auto& d = model.discretization;
  const Points<3> p = control_points(d.unknowns, state.z);
  auto& controls = data.add(name + " controls", {"x", "y", "z"});
  for (Eigen::Index c = 0; c < p.cols(); ++c) controls.add({p(0, c), p(1, c), p(2, c)});
  const Eigen::VectorXd stress = von_mises(model, state.z);
  auto& table = data.add(name + " stress", {"part", "von_mises"});
  for (int i = 0; i < d.boundary.n_parts(); ++i) {
    std::vector<int> own;
    for (int k = 0; k < d.quadrature.size(); ++k)
      if (d.quadrature.solid[k] == d.boundary.solid[i]) own.push_back(k);
    const Points<3> points = d.quadrature.position(Eigen::all, own);
    for (const double value : near_mean(grid_on(d.boundary.parts[i]), points, stress(own)))
      table.add({double(i), four_digits(value)});
  }
}

Box<3> box_of(const Data& data, const std::string& state) {
  const DataTable& controls = data[state + " controls"];
  Box<3> box;
  for (int c = 0; c < controls.n_rows(); ++c)
    box.include(Vec<3>(controls["x"][c], controls["y"][c], controls["z"][c]));
  return box;
}

SolidState solid_state_of(const Data& data, const std::string& body, const std::string& state) {
  SolidState result{surfaces_of(data, body + " "), {}};
  const DataTable& controls = data[state + " controls"];
  int next = 0;
  for (auto& part : result.parts)
    for (Eigen::Index c = 0; c < part.control_points.cols(); ++c, ++next)
      part.control_points.col(c) << controls["x"][next], controls["y"][next], controls["z"][next];
  for (const auto& run : data[state + " stress"].runs("part"))
    result.stress.push_back(run["von_mises"]);
  for (const double value : data[state + " stress"]["von_mises"])
    if (value > result.largest) result.largest = value;
  result.trims = trims_of(data, int(result.parts.size()), body + " ");
  return result;
}

render::RenderScene stressed(const SolidState& state, const ColorScale& scale, double point) {
  render::RenderScene scene;
  scene.meshes = meshes_of(
      state.parts, [](int) { return colors::gray; }, 8, state.trims);
  for (std::size_t i = 0; i < state.parts.size(); ++i) {
    const Param<2> lower = at_share(state.parts[i], 0, 0), upper = at_share(state.parts[i], 1, 1);
    auto& mesh = scene.meshes[i];
    for (const auto& u : mesh.uv)
      mesh.colors.push_back(scale(
          interpolated(state.stress[i], Vec<2>((u - lower).array() / (upper - lower).array()))));
  }
  scene.lines.push_back(lines_of(state.parts, 0, {0.1, 0.1, 0.12}, 0.5 * point, state.trims));
  return scene;
}

}  // namespace sem::figures
