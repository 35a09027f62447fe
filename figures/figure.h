#pragma once
// A figure: its numbers first, then a picture drawn only from them.

#include <functional>
#include <string>
#include <vector>

#include "sem/draw/canvas.h"

namespace sem::figures {

/// Rows of numbers with named columns, as they stand in the figure's CSV file.
struct Data {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;

  /// A column by name; asserts that it exists.
  std::vector<double> column(const std::string& name) const;
  /// The rows in which a column has a value.
  Data where(const std::string& name, double value) const;
};

/// Comma separated, a line of names first; numbers read back as the same bits.
std::string to_csv(const Data& data);
/// Throws InputError, naming `file` and the line, for anything but a table of numbers.
Data from_csv(const std::string& text, const std::string& file);

/// Sizes are in inches; text is 8 pt at the final size of 300 dots per inch.
struct Figure {
  std::string name;
  std::string caption;
  double width, height;
  std::function<Data()> compute;
  std::function<void(Canvas&, const Data&)> draw;
};

inline constexpr double dots_per_inch = 300;
/// Points (1/72 inch) in pixels.
inline constexpr double point = dots_per_inch / 72;
inline constexpr double text_size = 8 * point;

/// All figures, in the order of the draft.
const std::vector<Figure>& all_figures();

/// Writes NAME.csv into the folder, then draws NAME.png from what the file holds. Throws InputError
/// if a file cannot be written.
void make_figure(const Figure& figure, const std::string& folder);

Figure distance_construction();
Figure distance_weights();
Figure raycast_quadrature();
Figure quadrature_convergence();

}  // namespace sem::figures
