#pragma once
// Internal: a body cut into blocks of parallel rays, each in coordinates [0, 1] in which the intervals inside
// move as smoothly as is known.

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "sem/method/components.h"
#include "sem/method/rays.h"

namespace sem {

/// A ray's place in a block, and what its weight is to be multiplied with.
template <int Dim>
struct BlockRay {
  int block;
  std::array<double, Dim - 1> at;  ///< in [0, 1]: across a column; 3D: then from section to section
  double weight;                   ///< of the rule on [0, 1]^(Dim - 1)
};

/// 2D: columns of rays between the critical values (critical_values.h) of the body. 3D: sections between critical
/// heights, each cut into columns. Where parts are curved and untrimmed the heights are those at which a plane that
/// sweeps a component sees it change, and the columns' borders move with the height (sweep_3d.h); otherwise, or where
/// that takes more than twice (or, if more, 64) as many blocks or finds another volume, both are critical values.
/// Coordinates are bent at both ends as t^2 (3 - 2 t), which takes a square root, as a chord has it where a
/// section closes, to a smooth function.
template <int Dim>
class RayBlocks {
 public:
  RayBlocks(const Boundary<Dim>& boundary, const Loops<Dim>& loops, int axis, int n_threads);

  int size() const { return int(blocks_.size()); }
  /// With their intervals in the component that the block is of, and weights in m (2D), m^2 (3D).
  std::vector<Ray<Dim>> cast(const std::vector<BlockRay<Dim>>& rays);

 private:
  // All of the body or a component of it.
  struct Region {
    std::shared_ptr<const Component<Dim>> component = {};
    int across = 1;                    // axis from ray to ray in a section
    int height = -1;                   // 3D: axis from section to section
    std::vector<double> heights = {};  // 3D: ascending
    std::function<std::vector<double>(double)> columns_at = {};  // borders along `across` at a height, ascending
  };
  // A column of a region's sections between two neighbouring heights.
  struct Block {
    int region, column, n_columns;
    Interval height;
  };

  static Region fixed_columns(const Boundary<Dim>& boundary, const Loops<Dim>& loops, int axis);
  static std::vector<Region> swept_columns(const Boundary<Dim>& boundary, const Loops<Dim>& loops, int axis);
  static std::vector<Block> blocks_of(const std::vector<Region>& regions);
  double volume();
  void cut_sections(const std::vector<BlockRay<Dim>>& rays);
  Interval column_at(const Block& block, double height) const;

  int axis_, n_threads_;
  std::vector<Region> regions_;
  std::vector<Block> blocks_;
  std::map<std::pair<int, double>, std::vector<double>> sections_;  // columns by region and height
};

}  // namespace sem
