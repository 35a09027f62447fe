#include "sem/nurbs/merge_hits.h"

#include <algorithm>
#include <cmath>

#include "sem/nurbs/basis.h"

namespace sem::detail {
namespace {

// The same point found from neighbouring patches.
bool same_hit(const Hit<3>& a, const Hit<3>& b, const Vec<2>& domain_size, double t_tolerance) {
  return std::abs(a.t - b.t) <= t_tolerance &&
         ((a.u - b.u).cwiseAbs().array() <= 1e-7 * domain_size.array()).all();
}

}  // namespace

void append_merged(const PreparedNurbs<2, 3>& part, double speed, std::vector<Candidate>& found,
                   std::vector<Hit<3>>& out) {
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
    return a.hit.t != b.hit.t ? a.hit.t < b.hit.t : a.hit.u[0] < b.hit.u[0];
  });
  const double size = part.box.diagonal();
  Vec<2> domain_size;
  for (int a = 0; a < 2; ++a)
    domain_size[a] = domain(part.nurbs, a).upper - domain(part.nurbs, a).lower;
  const size_t first_out = out.size();
  const auto append = [&](const Hit<3>& hit) {
    for (size_t k = out.size(); k-- > first_out;)
      if (same_hit(out[k], hit, domain_size, 1e-9 * size / speed)) return;
    out.push_back(hit);
  };
  for (const auto& candidate : found)
    if (candidate.reach == 0) append(candidate.hit);
  const auto degenerate = [](const Candidate& c) { return c.reach > 0; };
  for (auto first = std::find_if(found.begin(), found.end(), degenerate); first != found.end();) {
    auto last = first, next = first;
    while ((next = std::find_if(next + 1, found.end(), degenerate)) != found.end() &&
           (next->hit.t - last->hit.t) * speed <= 2.5 * std::max(next->reach, last->reach))
      last = next;
    Hit<3> start = first->hit, end = last->hit;
    if ((end.t - start.t) * speed > 1e-5 * size) {
      start.along = end.along = true;
      append(start);
      append(end);
    } else {
      const bool near_simple =
          std::any_of(out.begin() + first_out, out.end(), [&](const auto& hit) {
            return same_hit(hit, start, 10 * domain_size, 1e-5 * size / speed);
          });
      if (!near_simple) append((first + (last - first) / 2)->hit);
    }
    first = next;
  }
}

}  // namespace sem::detail
