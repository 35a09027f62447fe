#include "src2d/tutorials/mesh.h"

#include <algorithm>

#include "sem/nurbs/basis.h"

namespace sem::tutorial {

Mesh ring_mesh(const Curves& curves, const Vec<2>& middle, int rings) {
  const int per_curve = 2 * rings, n = int(curves.size()) * per_curve;
  Mesh mesh{Points<2>(2, 1 + n * rings), n, {}};
  mesh.node.col(0) = middle;
  for (int r = 0; r < rings; ++r)
    for (int s = 0; s < n; ++s) {
      const int a = 1 + n * r + s, b = 1 + n * r + (s + 1) % n;  // neighbours on the ring
      const Vec<2> X = point(curves[s / per_curve], Param<1>(double(s % per_curve) / per_curve));
      mesh.node.col(a) = middle + (r + 1.0) / rings * (X - middle);
      if (r == 0) {
        mesh.element.push_back({0, b, a});
      } else {
        mesh.element.push_back({a - n, b - n, a});
        mesh.element.push_back({b - n, b, a});
      }
    }
  return mesh;
}

void draw_mesh(Picture& picture, const Mesh& mesh, const Points<2>& x, const Color& color) {
  for (const auto& e : mesh.element)
    picture.curve(x(Eigen::all, e), {.color = color, .width = 1.5, .closed = true});
}

void read_elements(Picture& picture, const Mesh& mesh, const Points<2>& x,
                   const std::function<std::string(int)>& text) {
  picture.hover([=, elements = mesh.element](const Vec<2>& X) -> std::string {
    for (int e = 0; e < int(elements.size()); ++e) {
      double least = 1;
      for (int a = 0; a < 3; ++a) {
        const Vec<2> from = x.col(elements[e][a]), to = x.col(elements[e][(a + 1) % 3]);
        least = std::min(least, DimTraits<2>::cross(to - from, X - from)[0]);
      }
      if (least >= 0) return text(e);
    }
    return "";
  });
}

}  // namespace sem::tutorial
