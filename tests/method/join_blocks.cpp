// Blocks joined for the Hessian: the same map, nothing meets that did not meet before.
#include "sem/method/join_blocks.h"

#include <algorithm>
#include <random>

#include "dims.h"

using namespace sem;

namespace {

// Blocks with random columns out of `wide` sets and of subsets of these, each of a few points.
template <int Dim>
Map<Dim> random_map(int n_wide, int n_narrow) {
  std::mt19937 random(7);
  const auto below = [&](int n) { return int(random() % unsigned(n)); };
  Map<Dim> map{0, 40, {}, {}};
  std::vector<std::vector<int>> sets;
  for (int s = 0; s < n_wide + n_narrow; ++s) {
    std::vector<int> columns;
    if (s < n_wide) {
      for (int c = 0; c < 40; ++c)
        if (below(2)) columns.push_back(c);
    } else {
      for (const int c : sets[below(n_wide)])
        if (below(8)) columns.push_back(c);
    }
    sets.push_back(columns);
    auto& block = map.blocks.emplace_back();
    block.columns = columns;
    for (int k = 1 + below(s < n_wide ? 6 : 3); k > 0; --k) block.points.push_back(map.n_points++);
    block.value = Eigen::MatrixXd::Random(block.points.size(), columns.size());
    for (auto& gradient : block.gradient)
      gradient = Eigen::MatrixXd::Random(block.points.size(), columns.size());
  }
  return map;
}

template <int Dim>
double cost(const Map<Dim>& map) {
  double sum = 0;
  for (const auto& block : map.blocks)
    sum += (block.points.size() + 10.0) * block.columns.size() * block.columns.size();
  return sum;
}

}  // namespace

TEST_CASE_TEMPLATE("joined blocks are the same map with the same couplings", T, D2, D3) {
  constexpr int Dim = T::value;
  const Map<Dim> map = random_map<Dim>(4, 60);
  const auto lists = blocks_to_join(map);
  const Map<Dim> result = joined(map, lists);
  CHECK(result.blocks.size() < 20);
  CHECK(cost(result) < 0.5 * cost(map));
  CHECK(dense_value(result) == dense_value(map));
  for (int axis = 0; axis < Dim; ++axis)
    CHECK(dense_gradient(result, axis) == dense_gradient(map, axis));
  std::vector<int> points;
  for (const auto& block : result.blocks) {
    points.insert(points.end(), block.points.begin(), block.points.end());
    CHECK(std::any_of(map.blocks.begin(), map.blocks.end(),
                      [&](const auto& b) { return b.columns == block.columns; }));
  }
  std::sort(points.begin(), points.end());
  REQUIRE(int(points.size()) == map.n_points);
  for (int k = 0; k < map.n_points; ++k) CHECK(points[k] == k);
}

TEST_CASE(
    "a block of many points joins none much wider; blocks that share no whole set stay apart") {
  Map<2> map{0, 40, {}, {}};
  const auto add = [&](int first, int last, int n_points) {
    auto& block = map.blocks.emplace_back();
    for (int c = first; c < last; ++c) block.columns.push_back(c);
    for (int k = 0; k < n_points; ++k) block.points.push_back(map.n_points++);
    block.value = Eigen::MatrixXd::Ones(n_points, last - first);
  };
  add(0, 20, 5);
  add(0, 10, 4);   // 4 x 400 zeros and all against 14 x 100: stays
  add(5, 19, 5);   // 5 x 400 against 15 x 196: joins the first
  add(15, 30, 1);  // not within the first
  const auto lists = blocks_to_join(map);
  CHECK(lists == std::vector<std::vector<int>>{{0, 2}, {1}, {3}});
  CHECK(joined(map, lists).blocks[0].gradient[0].size() == 0);  // asked for none
}
