#pragma once
// Stored references of the figures: numbers compared tightly, pictures loosely.

#include <string>
#include <vector>

#include "figures/figure.h"
#include "sem/draw/image.h"

namespace sem::figures {

/// Differences beyond these are reported.
struct Tolerance {
  double numbers = 1e-6;  ///< of the largest magnitude in the stored column of the table
  double mean = 0.6;      ///< mean difference of the pixels' components, of 255
  double local = 24;      ///< the same within any 8 x 8 pixels of the stored picture
};

/// What a reference keeps of the numbers: 9 significant digits; if the figure has more than
/// `most_cells` numbers, every k-th row (k the least that suffices) of each table with more than 50
/// rows, and a table "NAME mean of N" of one row with the means of its columns, so that the other
/// rows count too.
Data thinned(const Data& data, int most_cells = 6000);

/// Differences of the numbers, a sentence each; measured columns are not compared, but their size
/// is.
std::vector<std::string> compare_numbers(const Data& expected, const Data& actual,
                                         const Figure& figure, const Tolerance& tolerance = {});
/// The same of the pictures: sizes, mean and local difference.
std::vector<std::string> compare_pictures(const Image& expected, const Image& actual,
                                          const Tolerance& tolerance = {});

/// The figure's picture as it is stored: 75 dots per inch from pixels at 300, or half as many as
/// often as it takes for a PNG below 100 kB.
Image stored_picture(const Plot& plot);

/// What update_reference stores of a figure's numbers: thinned, but all of them if it is slow.
Data stored_form(const Figure& figure, const Data& data);

/// The stored reference's numbers. Throws InputError if there is none.
Data stored_numbers(const Figure& figure, const std::string& references);

/// Writes NAME.csv and NAME.png into the folder of references, replacing what is there.
void update_reference(const Figure& figure, const Data& data, const std::string& references);

/// Compares the figure's numbers, and the picture drawn from them (with the stored values of
/// measured columns), with the reference. Where the picture differs, writes NAME_expected.png,
/// NAME_actual.png and NAME_difference.png into the folder; where it does not, removes them. Throws
/// InputError if there is no reference.
std::vector<std::string> check_figure(const Figure& figure, const Data& data,
                                      const std::string& references, const std::string& folder);

}  // namespace sem::figures
