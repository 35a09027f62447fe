// The grid of parts near a point, against a look at all of them.
#include "sem/method/near_parts.h"

#include <random>

#include "dims.h"
#include "sem/nurbs/closest.h"
#include "solids.h"

using namespace sem;

namespace {

// 2D: a strip of n parts along each side. 3D: a box of n by n patches a face.
template <int Dim>
std::vector<Nurbs<Dim - 1, Dim>> pieces(int n);
template <>
std::vector<Nurbs<1, 2>> pieces<2>(int n) {
  std::vector<Nurbs<1, 2>> parts;
  for (int k = 0; k < n; ++k)
    for (const double y : {0.0, 1.0})
      parts.push_back(segment<2>(Vec<2>(k / 10.0, y), Vec<2>((k + 1) / 10.0, y)));
  return parts;
}
template <>
std::vector<Nurbs<2, 3>> pieces<3>(int n) {
  return test::unit_box<3>(n);
}

}  // namespace

TEST_CASE_TEMPLATE("near parts: all that are as near, none whose box is not, each once", T, D2,
                   D3) {
  constexpr int Dim = T::value;
  const auto boundary = make_boundary<Dim>({pieces<Dim>(Dim == 2 ? 30 : 3)});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.5, 1.5);
  for (const double distance : {1e-6, 0.05, 0.3, 2.0, std::numeric_limits<double>::infinity()}) {
    CAPTURE(distance);
    const NearParts<Dim> near(boundary, distance);
    for (int trial = 0; trial < 300; ++trial) {
      Vec<Dim> X;
      for (double& x : X) x = uniform(random);
      if (trial % 3 == 0) X[0] *= boundary.box.upper[0];  // along the strip
      if (trial % 4 == 0) X[Dim - 1] = 0;                 // on a side
      std::vector<int> found, must, may;
      near.visit(X, [&](int i) { found.push_back(i); });
      for (int i = 0; i < boundary.n_parts(); ++i) {
        const auto& box = boundary.parts[i].box;
        if (closest_point(boundary.parts[i], X).distance <= distance) must.push_back(i);
        if ((X - X.cwiseMax(box.lower).cwiseMin(box.upper)).norm() <= distance + 1e-9)
          may.push_back(i);
      }
      CHECK(std::is_sorted(found.begin(), found.end()));
      CHECK(std::adjacent_find(found.begin(), found.end()) == found.end());
      CHECK(std::includes(found.begin(), found.end(), must.begin(), must.end()));
      CHECK(std::includes(may.begin(), may.end(), found.begin(), found.end()));
    }
  }
}
