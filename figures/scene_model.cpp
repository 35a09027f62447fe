#include "figures/scene_model.h"

#include <algorithm>
#include <limits>

#include "sem/base/stopwatch.h"

namespace sem::figures {

long StiffnessPattern::n_nonzeros() const {
  const long alone = (stability.array() && !elastic.array()).count();
  return dimension * (dimension * elastic.count() + alone);
}

template <int Dim>
StiffnessPattern stiffness_pattern(const Discretization<Dim>& d) {
  const int n = d.unknowns.size();
  const Eigen::MatrixX<bool> none = Eigen::MatrixX<bool>::Constant(n, n, false);
  StiffnessPattern pattern{none, none, Dim};
  const auto couple = [](Eigen::MatrixX<bool>& matrix, const std::vector<int>& columns) {
    for (const int i : columns)
      for (const int j : columns) matrix(i, j) = true;
  };
  for (const auto& block : d.interior.blocks)
    couple(pattern.elastic, unknowns_of(d.interior, block));
  for (const auto& block : d.on_boundary.blocks)
    for (const int s : block.points) {
      std::vector<int> columns = unknowns_of(d.on_boundary, block);
      columns.insert(columns.end(), d.samples.column.begin() + d.samples.row[s],
                     d.samples.column.begin() + d.samples.row[s + 1]);
      couple(pattern.stability, columns);
    }
  return pattern;
}

template StiffnessPattern stiffness_pattern(const Discretization<2>&);
template StiffnessPattern stiffness_pattern(const Discretization<3>&);

double fastest_of(int n_calls, const std::function<void()>& call) {
  double fastest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < n_calls; ++i) {
    const Stopwatch watch;
    call();
    fastest = std::min(fastest, watch.seconds());
  }
  return fastest;
}

}  // namespace sem::figures
