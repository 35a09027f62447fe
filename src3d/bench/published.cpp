#include "published.h"

#include "src3d/shapes/box.h"

namespace sem {
namespace {

// The block's patches along x, y and z; n[2] is the largest.
Scene<3> block(const std::string& name, const std::array<int, 3>& n, int degree) {
  const Vec<3> upper = Vec<3>(0.5 * n[0], 0.5 * n[1], 0.5 * n[2]).cwiseMax(1);
  auto parts = make_parts(shapes3d::Box{Vec<3>::Zero(), upper, n});
  shapes3d::elevate(parts, degree);
  Scene<3> scene;
  scene.name = name;
  scene.solids.push_back({name, {MaterialModel::neo_ref, 1e6, 0.45, 1000}, parts});
  scene.method.n_threads = 1;
  scene.method.projection.degree = 2;
  scene.method.weights.cutoff = 0.501;  // the published one of blocks a metre thick
  scene.method.rays = {.axis = 2, .n_rays = 6};
  scene.method.interval.points = 25;
  scene.gravity = {0, 0, -10};
  scene.pins.resize(1);
  scene.pins[0].where.part = "bottom";
  scene.pins[0].axes = every_axis<3>();
  scene.analysis.kind = AnalysisKind::dynamics;
  return scene;
}

}  // namespace

std::vector<PublishedTime> time_published() {
  struct Size {
    PublishedTime published;
    std::array<int, 3> n;
    int degree;
  };
  const Size sizes[] = {{{"rocket", 648, 1.26, 100}, {1, 1, 13}, 1},
                        {{"beam twist", 756, 3.95, 100}, {1, 2, 4}, 2},
                        {{"lamppost", 942, 2.2, 100}, {1, 1, 19}, 1},
                        {{"mug", 1800, 11.9, 100}, {1, 3, 18}, 1},
                        {{"castle", 1872, 8.0, 100}, {1, 5, 12}, 1},
                        {{"astronaut", 3609, 14.1, 20, 49}, {1, 3, 16}, 2},
                        {{"squid", 4347, 6.7, 20, 25}, {1, 2, 26}, 2},
                        {{"b10", 1134, 0.697, 40, 0, 4.9, 20}, {1, 1, 10}, 2}};
  std::vector<PublishedTime> times;
  for (const auto& [published, n, degree] : sizes) {
    times.push_back(published);
    times.back().own = time_scene(block(published.name, n, degree));
  }
  return times;
}

}  // namespace sem
