// Scenes that read well but make no model: what the errors say.
#include "bodies.h"
#include "dims.h"
#include "errors.h"

using namespace sem;

namespace {

template <int Dim>
void check_rejected(const Scene<Dim>& scene, const std::vector<std::string>& pieces) {
  test::check_names(test::error_of([&] { build_model(scene, "my.json"); }), "my.json", pieces);
}

template <int Dim>
Box<Dim> far_box() {
  return {Vec<Dim>::Constant(7), Vec<Dim>::Constant(8)};
}

}  // namespace

TEST_CASE_TEMPLATE("model: a part that encloses nothing has no interior", T, D2, D3) {
  auto scene = test::box_scene<T::value>();
  scene.solids[0].parts.resize(1);
  check_rejected(scene, {"solids", "no interior", "enclose"});
  // Not along the axes: the part and what closes it differ by rounding.
  Points<T::value>& p = scene.solids[0].parts[0].shape.control_points;
  p.row(1) += 0.3 * p.row(0);
  p.row(0) += 0.17 * p.row(T::value - 1);
  check_rejected(scene, {"solids", "no interior", "enclose"});
}

TEST_CASE_TEMPLATE("model: pins must match something and leave something free", T, D2, D3) {
  constexpr int Dim = T::value;
  auto scene = test::box_scene<Dim>();
  scene.pins.push_back(test::face_pin<Dim>(0));
  scene.pins.push_back(scene.pins[0]);
  scene.pins[1].where.box = far_box<Dim>();
  check_rejected(scene, {"pins[1]", "no control point", "matches at least one"});
  scene.pins[1].where.box.reset();
  check_rejected(scene, {"pins", "all ", "leave something free"});
  scene.pins[1].where.control_points = {0, 1000};
  check_rejected(scene, {"pins[1].control_points", "found 1000", "0 to "});
}

TEST_CASE_TEMPLATE("model: loads and probes must be on the body", T, D2, D3) {
  constexpr int Dim = T::value;
  auto scene = test::box_scene<Dim>();
  BoundaryLoad<Dim> load;
  load.where.box = far_box<Dim>();
  load.pressure = 1;
  scene.boundary_loads.push_back(load);
  check_rejected(scene, {"loads[0]", "no boundary", "matches"});
  scene.boundary_loads.clear();
  scene.point_loads.push_back({Vec<Dim>::Constant(2), Vec<Dim>::Ones(), 0});
  check_rejected(scene, {"loads[0].at", "outside of the body"});
  scene.point_loads.clear();
  scene.probes.push_back({"in", ProbeKind::displacement, Vec<Dim>::Constant(1), 0});  // a corner
  CHECK_NOTHROW(build_model(scene, "my.json"));
  scene.probes.push_back({"out", ProbeKind::stress, Vec<Dim>::Constant(1.01), 0});
  check_rejected(scene, {"probes[1].at", "1.01", "outside of the body"});
}
