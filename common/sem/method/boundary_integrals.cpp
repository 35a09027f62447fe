#include "sem/method/boundary_integrals.h"

#include <algorithm>

#include "sem/method/line_rules.h"
#include "sem/method/monomials.h"
#include "sem/nurbs/basis.h"

namespace sem {
namespace {

constexpr int n_gauss = 32;

template <int Dim>
using FluxVisitor = std::function<void(const Vec<Dim>& X, double flux)>;

// Calls visit(point, area normal times weight) at the Gauss points of a box of parameters.
template <int Dim, class Visit>
void visit_normals(const Nurbs<Dim - 1, Dim>& shape, const Param<Dim - 1>& lower,
                   const Param<Dim - 1>& upper, const Visit& visit) {
  static const LineRule rule = gauss_legendre(n_gauss);
  int n = 1;
  for (int a = 0; a < Dim - 1; ++a) n *= n_gauss;
  for (int k = 0; k < n; ++k) {
    Param<Dim - 1> u;
    double weight = 1;
    for (int a = 0, rest = k; a < Dim - 1; ++a, rest /= n_gauss) {
      const double half = (upper[a] - lower[a]) / 2;
      u[a] = lower[a] + half * (1 + rule.node[rest % n_gauss]);
      weight *= half * rule.weight[rest % n_gauss];
    }
    const auto at = derivatives(shape, u, 1);
    visit(at.point, Vec<Dim>(weight * DimTraits<Dim>::area_normal(at.first)));
  }
}

// The same for a part as it is trimmed, or all of it.
template <int Dim, class Visit>
void visit_normals(const PreparedNurbs<Dim - 1, Dim>& part, const Visit& visit) {
  if (!part.region) {
    for (const auto& piece : part.pieces) visit_normals<Dim>(part.nurbs, piece.lower, piece.upper, visit);
    return;
  }
  const auto rule = part.region->rule(n_gauss);
  for (size_t k = 0; k < rule.u.size(); ++k) {
    const auto at = derivatives(part.nurbs, rule.u[k], 1);
    visit(at.point, Vec<Dim>(rule.weight[k] * DimTraits<Dim>::area_normal(at.first)));
  }
}

// sign * flux of the first unit vector, for those visits.
template <int Dim>
auto flux_of(int sign, const FluxVisitor<Dim>& visit) {
  return [sign, &visit](const Vec<Dim>& X, const Vec<Dim>& normal) { visit(X, sign * normal[0]); };
}

// +1 / -1: the body is behind / before the normal at u; 0: on both sides or on neither.
template <int Dim>
int side(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
         const PreparedNurbs<Dim - 1, Dim>& shape, const Param<Dim - 1>& u) {
  const auto at = derivatives(shape.nurbs, u, 1);
  const Vec<Dim> normal = DimTraits<Dim>::area_normal(at.first).normalized();
  if (!normal.allFinite()) return 0;
  const Vec<Dim> step = 1e-7 * shape.box.diagonal() * normal;
  return int(inside(boundary, loops, Vec<Dim>(at.point - step))) -
         int(inside(boundary, loops, Vec<Dim>(at.point + step)));
}

// The parameters at which side() changes, between two where it differs.
double change(const Boundary<2>& boundary, const Loops<2>& loops, const PreparedNurbs<1, 2>& shape,
              double a, double b) {
  const int side_a = side<2>(boundary, loops, shape, Param<1>(a));
  for (int bisection = 0; bisection < 60 && a != (a + b) / 2 && b != (a + b) / 2; ++bisection) {
    const double middle = (a + b) / 2;
    (side<2>(boundary, loops, shape, Param<1>(middle)) == side_a ? a : b) = middle;
  }
  return (a + b) / 2;
}

// A curve of which only some stretches bound the body. Returns whether that can be told.
bool visit_visible(const Boundary<2>& boundary, const Loops<2>& loops,
                   const PreparedNurbs<1, 2>& shape, const FluxVisitor<2>& visit) {
  constexpr int n_scan = 64;
  for (const auto& piece : shape.pieces) {
    double begin = piece.lower[0], previous = begin;
    int previous_side = 0;
    for (int k = 0; k < n_scan; ++k) {
      const double u = piece.lower[0] + (k + 0.5) / n_scan * (piece.upper[0] - piece.lower[0]);
      const int here = side<2>(boundary, loops, shape, Param<1>(u));
      if (k > 0 && here != previous_side) {
        const double end = change(boundary, loops, shape, previous, u);
        if (previous_side != 0)
          visit_normals<2>(shape.nurbs, Param<1>(begin), Param<1>(end), flux_of<2>(previous_side, visit));
        begin = end;
      }
      previous = u;
      previous_side = here;
    }
    if (previous_side != 0)
      visit_normals<2>(shape.nurbs, Param<1>(begin), piece.upper, flux_of<2>(previous_side, visit));
  }
  return true;
}

// Surfaces that overlap other solids would have to be trimmed first.
bool visit_visible(const Boundary<3>&, const Loops<3>&, const PreparedNurbs<2, 3>&,
                   const FluxVisitor<3>&) {
  return false;
}

template <int Dim>
bool boxes_meet(const Box<Dim>& a, const Box<Dim>& b) {
  return (a.lower.array() <= b.upper.array()).all() && (b.lower.array() <= a.upper.array()).all();
}

template <int Dim>
struct Crowding {
  std::vector<Box<Dim>> box;  // per loop
  std::vector<int> loop_of_part, loop_of_cap;
  std::vector<bool> crowded;  // per loop: may meet a loop of another solid or one that crosses it
};

// Loops whose parts may be hidden in other solids or cut by other loops.
template <int Dim>
Crowding<Dim> find_crowding(const Boundary<Dim>& boundary, const Loops<Dim>& loops) {
  const int n = int(loops.loops.size());
  Crowding<Dim> result;
  result.box.resize(n);
  result.crowded.assign(n, false);
  result.loop_of_part.resize(boundary.n_parts());
  result.loop_of_cap.resize(loops.caps.size());
  for (int l = 0; l < n; ++l) {
    for (const int i : loops.loops[l].parts) {
      result.loop_of_part[i] = l;
      result.box[l].include(boundary.parts[i].box);
    }
    for (const int c : loops.loops[l].caps) result.loop_of_cap[c] = l;
  }
  for (int l = 0; l < n; ++l)
    for (int m = 0; m < n; ++m)
      // Loops at different depths of one solid are nested: no part of one hides in the other.
      if (l != m && boxes_meet(result.box[l], result.box[m]) &&
          (loops.loops[l].solid != loops.loops[m].solid ||
           loops.loops[l].depth == loops.loops[m].depth))
        result.crowded[l] = true;
  return result;
}

}  // namespace

template <int Dim>
bool visit_boundary_flux(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                         const FluxVisitor<Dim>& visit) {
  bool available = true;
  const Crowding<Dim> crowding = find_crowding(boundary, loops);
  const auto add = [&](const PreparedNurbs<Dim - 1, Dim>& shape, int loop, int sign) {
    if (crowding.crowded[loop]) {
      available &= visit_visible(boundary, loops, shape, visit);
    } else {
      if (sign == 0) available = false;
      visit_normals<Dim>(shape, flux_of<Dim>(sign, visit));
    }
  };
  for (int i = 0; i < boundary.n_parts(); ++i)
    add(boundary.parts[i], crowding.loop_of_part[i], loops.orientation[i]);
  for (int c = 0; c < int(loops.caps.size()); ++c)
    if (loops.cap_length[c] > boundary.tolerance())
      add(loops.caps[c], crowding.loop_of_cap[c], loops.cap_orientation[c]);
  return available;
}

template <int Dim>
std::vector<double> part_measures(const Boundary<Dim>& boundary) {
  std::vector<double> measures;
  for (const auto& part : boundary.parts) {
    double& measure = measures.emplace_back(0);
    visit_normals<Dim>(part, [&](const Vec<Dim>&, const Vec<Dim>& normal) { measure += normal.norm(); });
  }
  return measures;
}

template <int Dim>
Moments<Dim> boundary_moments(const Boundary<Dim>& boundary, const Loops<Dim>& loops,
                              const Vec<Dim>& about) {
  Moments<Dim> moments;
  const Vec<Dim> center = (boundary.box.lower + boundary.box.upper) / 2;
  moments.available =
      visit_boundary_flux<Dim>(boundary, loops, [&](const Vec<Dim>& X, double flux) {
        const Vec<Dim> x = X - center;
        // Primitive along X_0 of X_0^m (rest): X_0^(m+1)/(m+1) (rest).
        moments.volume += flux * x[0];
        for (int i = 0; i < Dim; ++i) {
          moments.first[i] += flux * x[0] * x[i] / (i == 0 ? 2 : 1);
          for (int j = 0; j < Dim; ++j)
            moments.second(i, j) += flux * x[0] * x[i] * x[j] / (1 + (i == 0) + (j == 0));
        }
      });
  // From the center of the box to the point asked for.
  const Vec<Dim> shift = center - about;
  moments.second += moments.first * shift.transpose() + shift * moments.first.transpose() +
                    moments.volume * shift * shift.transpose();
  moments.first += moments.volume * shift;
  return moments;
}

template <int Dim>
std::optional<Eigen::VectorXd> boundary_moments_to_degree(const Boundary<Dim>& boundary,
                                                          const Loops<Dim>& loops, int degree,
                                                          const Vec<Dim>& center, double size) {
  const Monomials<Dim> monomials(degree);
  Eigen::VectorXd moments = Eigen::VectorXd::Zero(1 + monomials.size());
  Eigen::RowVectorXd values(monomials.size());
  const bool available =
      visit_boundary_flux<Dim>(boundary, loops, [&](const Vec<Dim>& X, double flux) {
        const Vec<Dim> xi = (X - center) / (size / 2);
        const double primitive = flux * (X - center)[0];
        monomials.values(xi, values);
        moments[0] += primitive;
        for (int m = 0; m < monomials.size(); ++m)
          moments[1 + m] += primitive * values[m] / (monomials.exponent(m)[0] + 1);
      });
  if (!available) return {};
  return moments;
}

template <int Dim>
Moments<Dim> quadrature_moments(const Points<Dim>& position, const Eigen::VectorXd& weight,
                                const Vec<Dim>& about) {
  const Points<Dim> r = position.colwise() - about;
  Moments<Dim> moments;
  moments.volume = weight.sum();
  moments.first = r * weight;
  moments.second = r * weight.asDiagonal() * r.transpose();
  return moments;
}

template bool visit_boundary_flux<2>(const Boundary<2>&, const Loops<2>&, const FluxVisitor<2>&);
template bool visit_boundary_flux<3>(const Boundary<3>&, const Loops<3>&, const FluxVisitor<3>&);
template std::optional<Eigen::VectorXd> boundary_moments_to_degree<2>(const Boundary<2>&,
                                                                      const Loops<2>&, int,
                                                                      const Vec<2>&, double);
template std::optional<Eigen::VectorXd> boundary_moments_to_degree<3>(const Boundary<3>&,
                                                                      const Loops<3>&, int,
                                                                      const Vec<3>&, double);
template std::vector<double> part_measures<2>(const Boundary<2>&);
template std::vector<double> part_measures<3>(const Boundary<3>&);
template Moments<2> boundary_moments<2>(const Boundary<2>&, const Loops<2>&, const Vec<2>&);
template Moments<3> boundary_moments<3>(const Boundary<3>&, const Loops<3>&, const Vec<3>&);
template Moments<2> quadrature_moments<2>(const Points<2>&, const Eigen::VectorXd&, const Vec<2>&);
template Moments<3> quadrature_moments<3>(const Points<3>&, const Eigen::VectorXd&, const Vec<3>&);

}  // namespace sem
