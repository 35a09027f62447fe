#pragma once
// Deformed solids with their stress in figures: as tables, and as what is rendered.

#include "figures/solid_model.h"
#include "figures/solid_view.h"
#include "sem/plot/field.h"

namespace sem::figures {

/// The parts of a state.
std::vector<Nurbs<2, 3>> parts_of(const Model<3>& model, const State& state);

/// Adds the rest shape's tables (add_surfaces, add_trims of a scene's parts), their names led by
/// `name` and a blank.
void add_body(Data& data, const std::string& name, const Model<3>& model,
              const std::vector<SceneSolid<3>>& solids = {});
/// Adds a state of a body: tables `NAME controls` (x, y, z, as many as the rest shape has) and
/// `NAME stress` (part, von_mises, Pa: on a grid of 7 x 7 equal steps of each part's parameters, u
/// running fastest; at each place the mean of the nearest quadrature points, as in the frames).
void add_state(Data& data, const std::string& name, const Model<3>& model, const State& state);

/// The box of all control points of a state.
Box<3> box_of(const Data& data, const std::string& state);

/// What they hold.
struct SolidState {
  std::vector<Nurbs<2, 3>> parts;
  std::vector<std::vector<double>> stress;  ///< per part, the grid
  double largest = 0;                       ///< of the stresses, Pa
  Trims trims = {};                         ///< of the parts
};
SolidState solid_state_of(const Data& data, const std::string& body, const std::string& state);

/// The state's parts coloured by stress, with lines along their ends. `point`: pixels a point.
render::RenderScene stressed(const SolidState& state, const ColorScale& scale, double point);

}  // namespace sem::figures
