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

void add_case(DataTable& cases, DataTable& runs, int number, int n_parts, const StiffnessPattern& K) {
  const double unknowns = double(K.dimension) * K.size();
  cases.add({double(number), double(n_parts), unknowns, double(K.n_nonzeros()), K.n_nonzeros() / (unknowns * unknowns)});
  for (int i = 0; i < K.size(); ++i)
    for (int j = 0; j < K.size(); ++j) {
      if (!K.coupled(i, j)) continue;
      const int first = j;
      while (j + 1 < K.size() && K.coupled(i, j + 1)) ++j;
      runs.add({double(number), double(i), double(first), double(j)});
    }
}

std::vector<std::pair<int, int>> entries_of(const DataTable& runs) {
  std::vector<std::pair<int, int>> entries;
  for (int k = 0; k < runs.n_rows(); ++k)
    for (int j = int(runs["first"][k]); j <= int(runs["last"][k]); ++j) entries.push_back({int(runs["row"][k]), j});
  return entries;
}

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
