#pragma once
// Fewer, larger blocks of a map for the work of a Hessian.

#include "sem/method/map.h"

namespace sem {

/// Lists of blocks to take as one. A block of n points and N columns costs about (n + 10) N^2, for
/// its matrix is written, copied and added besides the products at its points (measured on beams of
/// 42 biquadratic parts). So a block goes to another that has all its columns where that costs
/// less, to the narrowest such. Never adds a column to any, so what meets in the energy stays.
/// Every block is in one list, the one that has all columns first.
template <int Dim>
std::vector<std::vector<int>> blocks_to_join(const Map<Dim>& map);

/// The map with the blocks of each list as one, with all their columns; zeros where a point does
/// not depend on one.
template <int Dim>
Map<Dim> joined(const Map<Dim>& map, const std::vector<std::vector<int>>& lists);

}  // namespace sem
