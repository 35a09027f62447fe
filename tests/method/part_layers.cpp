// Further weights of parts that are small beside the cutoff: which there are, and that theta and gradient are those of
// a part with that reach.
#include <algorithm>
#include <random>

#include "dims.h"
#include "sem/method/part_layers.h"
#include "solids.h"

using namespace sem;

namespace {

std::vector<double> reaches(const std::vector<PartLayer>& layers, int part) {
  std::vector<double> found;
  for (const auto& layer : layers)
    if (layer.part == part) found.push_back(layer.reach);
  return found;
}

}  // namespace

TEST_CASE_TEMPLATE("layers: twice the extent, doubled up to half of the cutoff, in larger steps beyond the number", T, D2, D3) {
  const auto boundary = make_boundary<T::value>({test::unit_box<T::value>()});  // extents 1
  CHECK(find_part_layers(boundary, 3.9, 4).empty());
  CHECK(find_part_layers(boundary, 40, 0).empty());
  const auto two = reaches(find_part_layers(boundary, 8, 4), 1);
  REQUIRE(two.size() == 2);
  CHECK(two[0] == doctest::Approx(2));
  CHECK(two[1] == doctest::Approx(4));
  const auto three = reaches(find_part_layers(boundary, 64, 3), 0);
  REQUIRE(three.size() == 3);
  CHECK(three[0] == doctest::Approx(2));
  CHECK(three[1] == doctest::Approx(8));
  CHECK(three[2] == doctest::Approx(32));
  CHECK(reaches(find_part_layers(boundary, 640, 8), 0)[0] == doctest::Approx(10));  // no shorter than a 64th
}

TEST_CASE_TEMPLATE("layers: theta and its gradient are those of the part with the layer's reach for a cutoff", T, D2, D3) {
  constexpr int Dim = T::value;
  const auto boundary = make_boundary<Dim>({test::unit_box<Dim>()});
  const auto loops = find_loops(boundary);
  const std::vector<PartLayer> layers = {{0, 0.3}, {0, 0.6}, {2, 0.5}};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> inside(0, 1);
  Points<Dim> X = Points<Dim>::NullaryExpr(Dim, 50, [&] { return inside(random); });
  X(0, 0) = 0;  // on a part
  const auto weights = [&](double cutoff) {
    const auto distances = measure_distances(boundary, loops, X, DistanceWeight::sided, 2);
    WeightOptions options;
    options.variant = DistanceWeight::sided;
    options.cutoff = cutoff;
    auto theta = distance_weights(distances, options);
    distance_weight_gradients(boundary, X, distances, theta);
    if (cutoff == 2) add_part_layers(layers, boundary, distances, X, theta);
    return theta;
  };
  const auto all = weights(2);
  CHECK(all.n_parts == boundary.n_parts() + 3);
  int n_found = 0;
  for (size_t l = 0; l < layers.size(); ++l) {
    const auto alone = weights(layers[l].reach);
    for (int k = 0; k < X.cols(); ++k) {
      const auto entry = [&](const auto& theta, int part) {
        const auto end = theta.part.begin() + theta.begin[k + 1];
        const auto at = std::find(theta.part.begin() + theta.begin[k], end, part);
        return at == end ? -1 : int(at - theta.part.begin());
      };
      const int of_layer = entry(all, boundary.n_parts() + int(l)), of_part = entry(alone, layers[l].part);
      CHECK((of_layer < 0) == (of_part < 0));
      if (of_layer < 0 || of_part < 0) continue;
      ++n_found;
      CHECK(all.theta[of_layer] == alone.theta[of_part]);
      CHECK(all.gradient[of_layer] == alone.gradient[of_part]);
    }
  }
  CHECK(n_found > 30);
}
