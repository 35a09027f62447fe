#pragma once
// Values on a grid of cells: heat maps, contour lines and their colours.

#include <vector>

#include "sem/base/dim.h"
#include "sem/draw/colors.h"

namespace sem {

/// From values to colours: viridis, or `colors::diverging` for values about a meaningful middle.
struct ColorScale {
  double lower = 0, upper = 1;
  Color (*map)(double) = colors::viridis;  ///< colour at t in [0, 1]
  bool logarithmic = false;                ///< 0 < lower
  Color operator()(double value) const;    ///< limits clamp
};

/// The scale from the least to the largest finite value.
ColorScale scale_of(const std::vector<double>& values);
/// The diverging scale from -m to m, m being the largest finite magnitude.
ColorScale diverging_scale_of(const std::vector<double>& values);

/// n_x by n_y cells that fill a box, values row by row from the lower left cell; not a number where
/// there is nothing.
struct CellGrid {
  Box<2> box;
  int n_x = 0, n_y = 0;
  std::vector<double> values = {};

  double& at(int i, int j) { return values[std::size_t(j) * n_x + i]; }
  double at(int i, int j) const { return values[std::size_t(j) * n_x + i]; }
  Vec<2> center(int i, int j) const;
};

/// An empty grid of cells (not a number) of about the given size that covers the box.
CellGrid empty_grid(const Box<2>& box, double cell_size);

/// The grid from the centres of its cells in any order, e.g. columns of a table. The spacing is the
/// least distance of two columns or rows of centres; cells that are not listed are not a number.
/// Throws InputError if the centres lie on no such grid.
CellGrid grid_of(const std::vector<double>& x, const std::vector<double>& y,
                 const std::vector<double>& values);

/// Lines where the field, interpolated between the centres of cells, has the level (marching
/// squares; saddles by the mean of the four). Pieces of one line are joined; a closed line ends
/// where it begins. Squares with a corner that is not a number are left out.
std::vector<std::vector<Vec<2>>> contour_lines(const CellGrid& grid, double level);

}  // namespace sem
