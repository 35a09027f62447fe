#include "sem/method/join_blocks.h"

#include <algorithm>
#include <numeric>

namespace sem {
namespace {

using Eigen::MatrixXd;

constexpr double overhead_points = 10;

bool has_all(const std::vector<int>& columns, const std::vector<int>& some) {
  return std::includes(columns.begin(), columns.end(), some.begin(), some.end());
}

}  // namespace

template <int Dim>
std::vector<std::vector<int>> blocks_to_join(const Map<Dim>& map) {
  const auto& blocks = map.blocks;
  const int n_blocks = int(blocks.size());
  std::vector<int> by_width(n_blocks);
  std::iota(by_width.begin(), by_width.end(), 0);
  std::stable_sort(by_width.begin(), by_width.end(), [&](int a, int b) {
    return blocks[a].columns.size() < blocks[b].columns.size();
  });
  std::vector<std::vector<int>> with_column(map.n_columns +
                                            map.n_shared());  // blocks, narrowest first
  for (const int b : by_width)
    for (const int column : blocks[b].columns) with_column[column].push_back(b);

  std::vector<std::vector<int>> lists(n_blocks);
  std::vector<double> n_points(n_blocks);
  for (int b = 0; b < n_blocks; ++b) {
    lists[b] = {b};
    n_points[b] = double(blocks[b].points.size());
  }
  for (const int b : by_width) {
    const auto& columns = blocks[b].columns;
    if (columns.empty()) continue;
    const auto fewest = std::min_element(columns.begin(), columns.end(), [&](int i, int j) {
      return with_column[i].size() < with_column[j].size();
    });
    const double width = double(columns.size()),
                 own = (n_points[b] + overhead_points) * width * width;
    for (const int wider : with_column[*fewest]) {
      const double N = double(blocks[wider].columns.size());
      if (n_points[b] * N * N >= own) break;  // so do those after it
      if (wider == b || lists[wider].empty() || !has_all(blocks[wider].columns, columns)) continue;
      lists[wider].insert(lists[wider].end(), lists[b].begin(), lists[b].end());
      n_points[wider] += n_points[b];
      lists[b].clear();
      break;
    }
  }
  std::erase_if(lists, [](const auto& list) { return list.empty(); });
  return lists;
}

template <int Dim>
Map<Dim> joined(const Map<Dim>& map, const std::vector<std::vector<int>>& lists) {
  Map<Dim> result{map.n_points, map.n_columns, {}, map.shared};
  for (const auto& list : lists) {
    MapBlock<Dim>& block = result.blocks.emplace_back();
    for (const int b : list) {
      const auto& source = map.blocks[b];
      block.points.insert(block.points.end(), source.points.begin(), source.points.end());
      block.columns.insert(block.columns.end(), source.columns.begin(), source.columns.end());
    }
    std::sort(block.columns.begin(), block.columns.end());
    block.columns.erase(std::unique(block.columns.begin(), block.columns.end()),
                        block.columns.end());
    const auto gather = [&](const auto& rows_of) {
      MatrixXd rows = MatrixXd::Zero(block.points.size(), block.columns.size());
      int first = 0;
      for (const int b : list) {
        const MatrixXd& source = rows_of(map.blocks[b]);
        if (source.size() == 0) return source;
        for (int c = 0; c < source.cols(); ++c) {
          const auto at = std::lower_bound(block.columns.begin(), block.columns.end(),
                                           map.blocks[b].columns[c]);
          rows.col(at - block.columns.begin()).segment(first, source.rows()) = source.col(c);
        }
        first += int(source.rows());
      }
      return rows;
    };
    using Block = MapBlock<Dim>;
    block.value = gather([](const Block& b) -> const MatrixXd& { return b.value; });
    for (int axis = 0; axis < Dim; ++axis)
      block.gradient[axis] =
          gather([axis](const Block& b) -> const MatrixXd& { return b.gradient[axis]; });
  }
  return result;
}

#define SEM_INSTANTIATE(Dim)                                                   \
  template std::vector<std::vector<int>> blocks_to_join<Dim>(const Map<Dim>&); \
  template Map<Dim> joined<Dim>(const Map<Dim>&, const std::vector<std::vector<int>>&);
SEM_INSTANTIATE(2)
SEM_INSTANTIATE(3)
#undef SEM_INSTANTIATE

}  // namespace sem
