#pragma once
// Numbers as text that is the same on every machine: for output that is compared with stored text.
// Rounding errors differ between processors and compilers; these functions hide them.

#include <Eigen/Core>
#include <string>
#include <vector>

namespace sem {

/// The number with `digits` significant digits (1 to 12), as short as %g writes it, e.g. "0.25",
/// "1.5e-07"; "0" if |x| < 1e-13 scale. Exact ties (0.125 to 2 digits) and what lies within 1e-11
/// of them, relatively, are rounded away from zero. "nan", "inf", "-inf".
std::string rounded(double x, int digits = 6, double scale = 1);

/// An error or another quantity that should vanish: "< 1e-12" if |x| is below the bound, else
/// |x| with 2 digits. Choose a bound well above the rounding errors to be expected. NaN: "nan".
std::string error_text(double x, double bound = 1e-12);

/// A matrix or vector, one line a row, columns aligned to the right, every number rounded() with
/// the largest of the matrix as its scale; each line begins with `indent` and ends with a newline.
std::string rounded(const Eigen::MatrixXd& matrix, int digits = 4,
                    const std::string& indent = "  ");

/// Columns aligned to the right under their headings (the first column to the left), two blanks
/// apart; every row has as many cells as there are headings (assert). UTF-8.
std::string table(const std::vector<std::string>& headings,
                  const std::vector<std::vector<std::string>>& rows,
                  const std::string& indent = "  ");

}  // namespace sem
