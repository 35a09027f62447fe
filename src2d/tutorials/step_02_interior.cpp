// Step 2: points inside, from the boundary alone
//
//   build/release/bin/sem2d_step_02_interior --out out/step_02       numbers, pictures
//   build/release/bin/sem2d_step_02_interior --until 3 --set axis=y  rays along y
//   build/release/bin/sem2d_step_02_interior --interactive           drag the ray and the boundary
//
// New here: integrals over the inside, by points on rays between their hits with the boundary.
//
//   (a)   0 = sum_i w_i (y_i - y_0) B_i(u)     where a curve meets the ray y = y_0
//   (b)   inside a loop = after an odd number of crossings
//   (c)   integral f dX = sum_k f(X_k) v_k     v_k = width of strip * length inside * share
//   (d)   area = 1/2 integral of x dy - y dx   along the boundary: the divergence theorem
//
// (d) is the truth for (c). Errata: the draft's section 1.9 is only a picture (figure 5); it leaves
// open rays that touch or pass a joint, holes, overlaps, accuracy.
//
// Things to try: drag p5 until B bends back. rays = 1, points = 1. axis = y: what gets better?
#include <numeric>

#include "sem/lesson/lesson.h"
#include "sem/method/boundary_integrals.h"
#include "sem/method/line_rules.h"
#include "sem/method/quadrature.h"
#include "sem/nurbs/basis.h"
#include "src2d/shapes/shapes.h"
#include "src2d/tutorials/matrices.h"
#include "src2d/tutorials/pictures.h"

using namespace sem;
using namespace sem::tutorial;

namespace {
using Root = std::pair<double, bool>;  // u, and whether the sign changes there; 0 counts as +

// Appends the roots of sum_i c_i B_i on [a, b]. Its values lie between the least and the largest
// c_i: no root if these have one sign. If the c_i rise (or fall) so does the function: bisection.
// Otherwise search both halves; where two roots are about to become one, the ray touches.
void find_roots(const Eigen::VectorXd& c, double a, double b, std::vector<Root>& roots) {
  const int n = int(c.size()) - 1;
  if (c.minCoeff() > 1e-14 || c.maxCoeff() < -1e-14) return;
  const Eigen::VectorXd slope = c.tail(n) - c.head(n);
  const bool monotone = slope.minCoeff() > 0 || slope.maxCoeff() < 0;
  const bool crosses = (c[0] < 0) != (c[n] < 0);
  if (monotone && !crosses) return;  // an end may touch: of no importance
  if (b - a < (monotone ? 1e-15 : 1e-7)) {
    if (crosses || roots.empty() || a - roots.back().first > 1e-6)
      roots.push_back({(a + b) / 2, crosses});
    return;
  }
  Eigen::VectorXd left = c, right = c;  // de Casteljau: the coefficients of both halves
  for (int k = 0; k <= n; ++k) {
    left[k] = right[0];
    for (int i = 0; i < n - k; ++i) right[i] = (right[i] + right[i + 1]) / 2;
  }
  find_roots(left, a, (a + b) / 2, roots);
  find_roots(right, (a + b) / 2, b, roots);
}

// (a) All hits of the ray at this height (across the axis), from left to right.
std::vector<RayHit> find_hits(const Boundary<2>& boundary, double height, int axis) {
  std::vector<RayHit> hits;
  for (int i = 0; i < boundary.n_parts(); ++i)
    for (const auto& piece : boundary.parts[i].pieces) {  // Bezier curves
      std::vector<Root> roots;
      find_roots(piece.weights.array() * (piece.points.row(1 - axis).transpose().array() - height),
                 0, 1, roots);
      for (const auto& [u, crosses] : roots)
        hits.push_back({point(piece, Param<1>(u))[axis], i, crosses});
    }
  std::sort(hits.begin(), hits.end(), [](auto& h, auto& k) { return h.t < k.t; });
  return hits;
}

// (b) The inside along a ray: a loop in a loop is a hole, solids are united.
std::vector<RayInterval> inside(const std::vector<RayHit>& hits, const Loops<2>& loops) {
  std::vector<RayInterval> result;
  std::vector<char> odd(loops.loops.size(), false);  // inside of the loop
  for (std::size_t k = 0; k + 1 < hits.size(); ++k) {
    int innermost[2] = {-1, -1};  // depth of the innermost loop of each solid: full if even
    for (std::size_t l = 0; l < odd.size(); ++l) {
      const auto& loop = loops.loops[l];
      odd[l] ^= hits[k].crosses && std::count(loop.parts.begin(), loop.parts.end(), hits[k].part);
      if (odd[l]) innermost[loop.solid] = std::max(innermost[loop.solid], loop.depth);
    }
    if (innermost[0] % 2 != 0 && innermost[1] % 2 != 0) continue;
    if (result.empty() || result.back().end != hits[k].t) result.push_back({hits[k].t, 0, 0});
    result.back().end = hits[k + 1].t;
  }
  return result;
}

double total(const std::vector<RayInterval>& intervals) {
  return std::accumulate(intervals.begin(), intervals.end(), 0.0,
                         [](double sum, auto& i) { return sum + i.end - i.begin; });
}
}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 2: points inside, from the boundary alone", {{-0.6, -0.8}, {4.6, 4.4}});

  // [1] First solid: three cubic curves around p1 ... p9 and a circle inside. Second solid: a disc.
  Points<2> p = three_points();
  Boundary<2> boundary;
  Loops<2> loops;
  Moments<2> truth;
  int axis = 0;
  const auto before = [&](const Vec<2>& X) {  // shown under the mouse: (b)
    int n = 0;
    const auto hits = find_hits(boundary, X[1 - axis], axis);
    for (const auto& h : hits) n += h.crosses && h.t < X[axis];
    return std::to_string(n) +
           " crossings up to here: " + (inside(boundary, loops, X) ? "inside" : "outside") +
           "\nlength inside on this ray: " + rounded(total(inside(hits, loops)), 4) + " m";
  };
  const auto draw = [&](Picture& picture, double height, double width) {
    const auto hits = find_hits(boundary, height, axis);
    draw_ray(picture, boundary.box, axis, height, hits, inside(hits, loops), width);
  };
  lesson.handles("p", p, "control point");
  lesson.step(
      "Solids are their boundaries: area by the divergence theorem",
      [&](std::ostream& out) {
        std::vector<Curves> solids = {three_curves(p), {}};
        for (auto& a : make_parts(shapes2d::Disc{{2.7, 1.7}, 0.4})) solids[0].push_back(a.shape);
        for (auto& a : make_parts(shapes2d::Disc{{0.4, 0.7}, 0.6})) solids[1].push_back(a.shape);
        boundary = make_boundary<2>(solids);
        loops = find_loops(boundary);  // which parts belong together, which loop lies in which
        const LineRule g = gauss_legendre(20);
        double sum = 0;  // (d) for both solids
        for (int i = 0; i < boundary.n_parts(); ++i)
          for (int k = 0; k < 20; ++k) {
            const auto x = derivatives(boundary.parts[i].nurbs, Param<1>((1 + g.node[k]) / 2), 1);
            sum +=
                loops.orientation[i] * g.weight[k] * DimTraits<2>::cross(x.point, x.first)[0] / 4;
          }
        truth = boundary_moments(boundary, loops);
        out << loops.loops.size() << " loops; area of the solids " << rounded(sum, 5)
            << ", of their union " << rounded(truth.volume, 5) << "\n";
      },
      [&](Picture& picture) {
        draw_boundary(picture, boundary);
        picture.curve(p, {.color = colors::light_gray, .width = 2, .closed = true});
        picture.dots(p, colors::gray, 11);
        picture.dot(truth.first / truth.volume, colors::black, 16, MarkerShape::plus);
        picture.note("+: the centroid, by integrals along the curves");
      },
      before);

  // [2] Single rays. 0 counts as + everywhere: then a touch is no crossing, and a joint is one.
  Vec<2> through(1.5, 1.6);
  std::vector<double> heights;
  const char* const names[] = {"touch", "joint", "miss", "ray"};
  lesson.choice("axis", axis, {"x", "y"}, "direction of all rays");
  lesson.handle("ray", through, "a point of one of the rays");
  lesson.step(
      "Four rays: hits, crossings, inside",
      [&](std::ostream& out) {
        const Eigen::VectorXd c = p.middleCols(3 * axis, 4).row(1 - axis);  // of A or B
        std::vector<Root> extrema;  // where the derivative, 3 sum_i (c_i+1 - c_i) B_i, vanishes
        find_roots(c.tail(3) - c.head(3), 0, 1, extrema);
        const auto& curve = boundary.parts[axis].nurbs;
        heights = {extrema.empty() ? c[0] : point(curve, Param<1>(extrema[0].first))[1 - axis],
                   p(1 - axis, 6), boundary.box.upper[1 - axis] - 0.4, through[1 - axis]};
        for (int r = 0; r < 4; ++r)
          out << names[r] << ": length inside "
              << rounded(total(inside(find_hits(boundary, heights[r], axis), loops)), 4) << "\n";
      },
      [&](Picture& picture) {
        draw_boundary(picture, boundary);
        for (int r = 0; r < 4; ++r) {
          draw(picture, heights[r], 7);
          const Vec<2> at = axis == 0 ? Vec<2>(-0.2, heights[r]) : Vec<2>(heights[r], -r / 5.0);
          picture.label(at, names[r], colors::black, {axis - 1.0, 0});
        }
        picture.note("green: inside, dots: crossings, crosses: touches");
      },
      before);

  // [3] Rays at the middles of strips of the box (the paper's), or at Gauss points: these gain
  // little, as the length inside has a kink at every joint and a vertical tangent at every touch.
  int n_rays = 24, rule = 0;
  Rays<2> rays;
  const auto cast = [&](int n, int grid) {
    return cast_rays(boundary, loops, {.axis = axis, .n_rays = n, .grid = RayGrid(grid)});
  };
  lesson.slider("rays", n_rays, 1, 200);
  lesson.choice("rule", rule, {"midpoint", "gauss"}, "of rays and points");
  lesson.step(
      "All rays, and how fast the area converges",
      [&](std::ostream& out) {
        rays = cast(n_rays, rule);
        double difference = 0;
        for (const auto& ray : rays.rays) {
          const double ours = total(inside(find_hits(boundary, ray.origin[1 - axis], axis), loops));
          difference = std::max(difference, std::abs(total(ray.intervals) - ours));
        }
        out << "library's lengths inside - ours: " << error_text(difference, 1e-11)
            << "\nerror of the area, (c):\n";
        const auto error = [&](int n, int grid) {
          double area = 0;
          for (const auto& ray : cast(n, grid).rays) area += ray.weight * total(ray.intervals);
          return error_text(area / truth.volume - 1);
        };
        for (int n = 8; n <= 512; n *= 4)
          out << n << " rays: midpoint " << error(n, 0) << ", gauss " << error(n, 1) << "\n";
      },
      [&](Picture& picture) {
        for (const auto& ray : rays.rays) draw(picture, ray.origin[1 - axis], 3);
        draw_boundary(picture, boundary);
      },
      before);

  // [4] Points in every stretch, and (c) for other f.
  int points = 6;
  Quadrature<2> quadrature;
  lesson.slider("points", points, 1, 30, "in each stretch");
  lesson.step(
      "Points and weights",
      [&](std::ostream& out) {
        quadrature = quadrature_on_rays(rays, {.rule = IntervalRule(rule), .points = points});
        const LineRule line = rule == 0 ? midpoint_rule(points) : gauss_legendre(points);
        int k = 0;
        double difference = 0;
        Eigen::Matrix3d m = Eigen::Matrix3d::Zero(), exact;
        for (const auto& ray : rays.rays)
          for (const auto& i : ray.intervals)
            for (int a = 0; a < points; ++a, ++k) {
              const double v = ray.weight * (i.end - i.begin) * line.weight[a] / 2;
              const Eigen::Vector3d f = quadrature.position.col(k).homogeneous();  // x, y, 1
              m += f * f.transpose() * v;                                          // (c)
              difference = std::max(difference, std::abs(v - quadrature.weight[k]));
            }
        exact << truth.second, truth.first, truth.first.transpose(), truth.volume;
        out << k << " points; library's weights - ours: " << error_text(difference) << "\n";
        print(out, "integral of (x, y, 1)^T (x, y, 1)", m);
        print(out, "its error", m - exact);
      },
      [&](Picture& picture) {
        const double most = quadrature.weight.maxCoeff();
        for (int k = 0; k < quadrature.size(); ++k)
          picture.dot(quadrature.position.col(k), colors::viridis(quadrature.weight[k] / most));
        draw_boundary(picture, boundary);
        color_bar(picture, "v = 0", rounded(most, 2), Vec<2>(560, 560));
        read_values(picture, quadrature.position, quadrature.weight, "v");
      });
  return lesson.run(argc, argv);
}
// Next: step_03_least_squares, polynomials that follow the boundary.
