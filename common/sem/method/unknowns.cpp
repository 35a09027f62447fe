#include "sem/method/unknowns.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace sem {

template <int Dim>
Unknowns<Dim> control_point_unknowns(const Boundary<Dim>& boundary) {
  return {rest_controls(boundary), Eigen::VectorXd::Ones(boundary.n_controls()), {}};
}

template <int Dim>
std::vector<int> leaders_of_near_controls(const Boundary<Dim>& boundary) {
  constexpr double near = 1e-5, same = 1e-12;  // of the size
  const Points<Dim> p = rest_controls(boundary);
  const int n = int(p.cols());
  const double size = boundary.box.diagonal();
  std::vector<int> order(n), leader(n);
  std::iota(order.begin(), order.end(), 0);
  std::iota(leader.begin(), leader.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return p(0, a) < p(0, b); });
  const auto first = [&](int c) {
    while (leader[c] != c) c = leader[c];
    return c;
  };
  std::vector<char> apart(n, false);
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n && p(0, order[j]) - p(0, order[i]) <= near * size; ++j) {
      const double distance = (p.col(order[j]) - p.col(order[i])).norm();
      if (distance > near * size) continue;
      const int a = first(order[i]), b = first(order[j]);
      leader[std::max(a, b)] = std::min(a, b);
      apart[std::min(a, b)] = apart[a] || apart[b] || distance > same * size;
    }
  // Within a part first: the way across a thin part is the stiff one, to its neighbours' coincident
  // ends the soft one.
  std::vector<int> root(n);
  bool any = false;
  for (int c = 0; c < n; ++c) root[c] = first(c);
  for (int i = 0; i < boundary.n_parts(); ++i) {
    std::map<int, int> first_of_part;  // by root
    for (int c = boundary.first_control[i]; c < boundary.first_control[i + 1]; ++c) {
      const auto [at, is_new] = first_of_part.try_emplace(root[c], c);
      leader[c] = !apart[root[c]] ? c : is_new ? root[c] : at->second;
      any = any || leader[c] != c;
    }
  }
  return any ? leader : std::vector<int>();
}

template <int Dim>
Unknowns<Dim> difference_unknowns(const Boundary<Dim>& boundary, const std::vector<int>& leader) {
  Unknowns<Dim> unknowns = control_point_unknowns(boundary);
  const Points<Dim> p = unknowns.rest;
  const int n = unknowns.size();
  unknowns.S = Eigen::MatrixXd::Identity(n, n);
  for (int c = 0; c < n; ++c) {
    for (int at = c; leader[at] != at; at = leader[at]) unknowns.S(c, leader[at]) = 1;
    if (leader[c] == c) continue;
    unknowns.rest.col(c) = p.col(c) - p.col(leader[c]);
    unknowns.one[c] = 0;
  }
  return unknowns;
}

template <int Dim>
Points<Dim> control_points(const Unknowns<Dim>& unknowns, const Eigen::VectorXd& z) {
  const Eigen::Map<const Points<Dim>> vectors(z.data(), Dim, unknowns.size());
  if (unknowns.S.size() == 0) return vectors;
  return vectors * unknowns.S.transpose();
}

template <int Dim>
std::optional<int> unknown_of_control(const Unknowns<Dim>& unknowns, int control) {
  if (unknowns.S.size() == 0) return control;
  int column = 0;
  const auto row = unknowns.S.row(control);
  const bool unit = row.maxCoeff(&column) == 1 && (row.array() != 0).count() == 1;
  return unit ? std::optional(column) : std::nullopt;
}

template <int Dim>
Eigen::VectorXd affine_field(const Unknowns<Dim>& unknowns, const Mat<Dim>& A, const Vec<Dim>& b) {
  const Points<Dim> z = A * unknowns.rest + b * unknowns.one.transpose();
  return Eigen::Map<const Eigen::VectorXd>(z.data(), z.size());
}

#define SEM_INSTANTIATE(Dim)                                                                      \
  template Unknowns<Dim> control_point_unknowns<Dim>(const Boundary<Dim>&);                       \
  template std::vector<int> leaders_of_near_controls<Dim>(const Boundary<Dim>&);                  \
  template Unknowns<Dim> difference_unknowns<Dim>(const Boundary<Dim>&, const std::vector<int>&); \
  template Points<Dim> control_points<Dim>(const Unknowns<Dim>&, const Eigen::VectorXd&);         \
  template std::optional<int> unknown_of_control<Dim>(const Unknowns<Dim>&, int);                 \
  template Eigen::VectorXd affine_field<Dim>(const Unknowns<Dim>&, const Mat<Dim>&,               \
                                             const Vec<Dim>&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
