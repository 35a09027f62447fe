// Step 7: origins: which parts move together
//
//   build/release/bin/sem2d_step_07_origins --out out/step_07         numbers, pictures
//   build/release/bin/sem2d_step_07_origins --set alpha=0.6           other groups; 5: only one
//   build/release/bin/sem2d_step_07_origins --interactive             drag the corners
//
// New here: the polynomial of part i is x_i(X) = m(X - Xbar) c_i + t_i. About which origin Xbar,
// and where is it after the deformation, t_i? The draft has one for all:
//
//   (4)   xbar = 1/n sum_k x_k                 over all n boundary samples
//
// The published method has several: quadrature points are grouped by the set of parts that have
// weight there; each set of two or more is a candidate, with all its parts' samples:
//
//   (4')  xbar_g = sum_{k in g} a_k x_k / sum_{k in g} a_k,   a_k: length that sample k stands for
//   (a)   part i takes the candidate with the largest score s_ig = sum_{k in group g} v_k w_i(X_k)
//
// Errata of the draft: (4) is called "center of mass" but is neither the centroid of the solid nor,
// without the lengths a_k, that of its boundary, see [3].
//
// Things to try: alpha=1: what couples the ends now? corner2=1.4,0: the tie of parts 2 and 6 is
// broken, they follow both ends, and still it costs nothing. alpha=0.55: three free pieces.
#include <algorithm>
#include <map>

#include "sem/lesson/lesson.h"
#include "sem/method/discretization.h"
#include "src2d/shapes/shapes.h"
#include "src2d/tutorials/matrices.h"
#include "src2d/tutorials/pictures.h"

using namespace sem;
using namespace sem::tutorial;

namespace {
using Set = std::vector<int>;

// A candidate: the quadrature points that see the same parts.
struct Group {
  Set parts;
  double area = 0;
  Vec<2> center = Vec<2>::Zero();  // of its points
  VectorXd score;                  // #parts
};

// Groups by falling area, and the group of each point.
std::vector<Group> group(const BlendingWeights<2>& w, const Quadrature<2>& rule,
                         std::vector<int>& of_point) {
  std::map<Set, Group> by_set;
  std::vector<Set> seen(w.n_points());
  for (int k = 0; k < w.n_points(); ++k) {
    for (int e = w.begin[k]; e < w.begin[k + 1]; ++e)
      if (w.w[e] > 1e-4) seen[k].push_back(w.part[e]);
    Group& g = by_set[seen[k]];
    if (g.parts.empty()) g = {.parts = seen[k], .score = VectorXd::Zero(w.n_parts)};
    g.area += rule.weight[k];
    g.center += rule.weight[k] * rule.position.col(k);
    for (int e = w.begin[k]; e < w.begin[k + 1]; ++e)
      g.score[w.part[e]] += rule.weight[k] * w.w[e];  // s_ig = sum_k v_k w_i(X_k)
  }
  std::vector<Group> groups;
  for (auto& [set, g] : by_set) g.center /= g.area, groups.push_back(g);
  std::stable_sort(groups.begin(), groups.end(),
                   [](const Group& a, const Group& b) { return a.area > b.area + 1e-9; });
  of_point.resize(seen.size());
  for (std::size_t k = 0; k < seen.size(); ++k)
    for (std::size_t g = 0; g < groups.size(); ++g)
      if (groups[g].parts == seen[k]) of_point[k] = int(g);
  return groups;
}

}  // namespace

int main(int argc, char** argv) {
  Lesson lesson("Step 7: origins", {{-0.6, -0.9}, {5.1, 2.1}});

  // [1] Eight straight parts, 1 to 8 from the lower left corner on.
  Points<2> corner(2, 8);
  corner << 0, 1.5, 3, 4.5, 4.5, 3, 1.5, 0,  //
      0, 0, 0, 0, 1, 1, 1, 1;
  double alpha = 0.75;
  Curves parts;
  Discretization<2> body;
  std::vector<Group> groups;
  std::vector<int> of_point;
  lesson.handles("corner", corner, "where two parts meet");
  lesson.slider("alpha", alpha, 0.2, 5, "cutoff, m", Lesson::Scale::logarithmic);
  lesson.step(
      "Groups of quadrature points that see the same parts",
      [&](std::ostream& out) {
        parts.clear();
        for (const auto& part : shapes2d::make_parts(shapes2d::Polygon{corner, {}, 1}))
          parts.push_back(part.shape);
        MethodOptions options;
        options.sampling.points_per_span = 4;
        options.rays = {.axis = 1, .n_rays = 54};
        options.interval.points = 12;
        options.weights.cutoff = alpha;
        body = discretize<2>({parts}, options);
        groups = group(body.weights, body.quadrature, of_point);
        out << groups.size() << " groups; the largest, m^2:\n";
        for (std::size_t g = 0; g < std::min<std::size_t>(7, groups.size()); ++g)
          out << "  " << text(groups[g].parts) << "  " << rounded(groups[g].area, 3) << "\n";
      },
      [&](Picture& picture) {
        draw_groups(picture, body.quadrature.position, of_point);
        draw_parts(picture, parts, "12345678");
        for (int g = 0; g < std::min(7, int(groups.size())); ++g)
          picture.label(groups[g].center, text(groups[g].parts), colors::black, {0, 0});
      },
      [&](auto& X) { return text(groups[of_point[nearest(body.quadrature.position, X)]].parts); });
  // [2] Every part takes the candidate with its largest score. The published min-cost flow, one
  // unit from each part to some candidate, says the same: candidates take any number of units. The
  // library skips sets with all samples on one line, {1 2}: a linear fit could not see across it.
  Origins<2> origins;
  std::vector<int> taken(8);
  MatrixXd score;
  lesson.step(
      "Scores, and which part takes which candidate",
      [&](std::ostream& out) {
        origins = choose_origins(OriginChoice::shared_parts, body.weights, body.quadrature.weight,
                                 body.samples);
        std::vector<std::vector<std::string>> rows;
        score.resize(8, groups.size());
        for (std::size_t g = 0; g < groups.size(); ++g) score.col(g) = groups[g].score;
        for (int i = 0; i < 8; ++i) {
          int best = 0, g = 0;
          for (int other = 1; other < int(groups.size()); ++other)
            if (score(i, other) > score(i, best) + 1e-9) best = other;
          const Set& set = origins.members[origins.of_part[i]];
          while (g < int(groups.size()) && groups[g].parts != set) ++g;
          rows.push_back({std::to_string(i + 1), text(groups[best].parts),
                          rounded(score(i, best), 4), text(set),
                          g < int(groups.size()) ? rounded(score(i, g), 4) : "fallback"});
          taken[i] = g;
        }
        out << table({"part", "best score", "m^2", "library takes", "m^2"}, rows)
            << "ties: " << (origins.ties.empty() ? "none" : text(origins.ties)) << "\n";
      },
      [&](Picture& picture) {
        std::vector<std::string> names;
        for (const auto& g : groups) names.push_back(g.parts.size() > 1 ? text(g.parts) : "");
        draw_network(picture, score, names, taken);
      });

  // [3] (4'): the centroid of all samples of the set's parts, also of those that take another set.
  lesson.step(
      "The origin of a set: a centroid of its boundary",
      [&](std::ostream& out) {
        const Samples<2>& q = body.samples;
        double difference = 0;
        std::vector<std::vector<std::string>> rows;
        for (std::size_t o = 0; o < origins.members.size(); ++o) {
          Vec<2> sum = Vec<2>::Zero(), mean = Vec<2>::Zero();
          double length = 0, n = 0;
          for (const int i : origins.members[o])
            for (int k = q.first[i]; k < q.first[i + 1]; ++k) {
              sum += q.weight[k] * q.position.col(k);  // a_k X_k
              length += q.weight[k];
              mean += q.position.col(k);
              ++n;
            }
          difference = std::max(difference, (sum / length - origins.position.col(o)).norm());
          rows.push_back({text(origins.members[o]), list(mean / n, 3), list(sum / length, 3)});
          for (const auto& g : groups)
            if (g.parts == origins.members[o]) rows.back().push_back(list(g.center, 3));
          rows.back().resize(4, "no group");
        }
        out << table({"set", "mean, (4)", "with lengths, (4')", "centroid of its group"}, rows)
            << "library's - ours: " << error_text(difference) << "\n";
      },
      [&](Picture& picture) { draw_origins(picture, parts, origins); });

  // [4] t_i of part i is the mean of all parts j of its set: S_ij is the share of part j in it. If
  // the parts move by u_i with u = S u, then every polynomial is a translation and F = I: no
  // energy. The solutions besides u = const are pieces of the solid that nothing couples.
  const auto shares = [&](const Origins<2>& o) {
    const auto& first = body.samples.first;
    MatrixXd S = MatrixXd::Zero(8, 8);
    for (int i = 0; i < 8; ++i) {
      for (const int j : o.members[o.of_part[i]])
        S(i, j) = body.samples.weight(Eigen::seq(first[j], first[j + 1] - 1)).sum();
      S.row(i) /= S.row(i).sum();
    }
    return S;
  };
  const std::vector<std::string> kinds = {"one origin", "shared sets"};
  std::vector<MatrixXd> S(2);
  lesson.step(
      "Who moves with whom",
      [&](std::ostream& out) {
        const auto one =
            choose_origins(OriginChoice::one, body.weights, body.quadrature.weight, body.samples);
        for (const int kind : {0, 1}) {
          const auto& o = kind == 0 ? one : origins;
          S[kind] = shares(o);
          out << kinds[kind] << ": origins " << o.members.size() << ", free pieces "
              << 8 - rank(MatrixXd::Identity(8, 8) - S[kind]) << "\n";
        }
      },
      [&](Picture& picture) {
        draw_shares(picture, S, kinds);
        picture.note("row i: the parts that carry part i along");
      });

  // [5] Part 4 is moved by 1, part 8 stays, the others satisfy u = S u as well as they can. Joints
  // may open: only the stability term (step 11) holds them, and grad w (step 8).
  VectorXd u;
  MatrixXd z;
  double strain = 0;
  lesson.step(
      "Pulling the right end off",
      [&](std::ostream& out) {
        const MatrixXd A = MatrixXd::Identity(8, 8) - S[1];
        const std::vector<int> free = {0, 1, 2, 4, 5, 6};
        u = VectorXd::Unit(8, 3);
        u(free) = least_squares(A(Eigen::all, free), -A.col(3));
        out << "u = " << list(u, 3) << "\nu - S u: " << error_text((A * u).cwiseAbs().maxCoeff());
        z = rest_controls(body.boundary).transpose();
        for (int i = 0; i < 8; ++i)
          z.middleRows(2 * i, 2).col(1).array() += 0.5 * u[i];  // both ends of part i
        strain = 0;
        for (const int b : {0, 1}) {  // F e_b - e_b at all points
          const MatrixXd Fe = dense_gradient(body.interior, b) * z;
          const auto e = Eigen::RowVector2d::Unit(b);
          strain = std::max(strain, (Fe.rowwise() - e).cwiseAbs().maxCoeff());
        }
        out << "\nlargest F - I in the solid: " << error_text(strain, 1e-9) << "\n";
      },
      [&](Picture& picture) {
        const Points<2> x = (dense_value(body.interior) * z).transpose();
        draw_groups(picture, x, of_point);
        read_motion(picture, body.quadrature.position, x);
        Curves moved = parts;
        for (int i = 0; i < 8; ++i) moved[i].control_points = z.middleRows(2 * i, 2).transpose();
        draw_parts(picture, moved, "12345678");
        picture.note("largest F − I: " + error_text(strain, 1e-9) + "; F = I costs no energy");
      });
  return lesson.run(argc, argv);
}
// Next: step_08_map, one map for the whole solid.
