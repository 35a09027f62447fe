#pragma once
// The table of hard cases as a picture.

#include "sem/plot/plot.h"
#include "tests/hard_cases/case.h"

namespace sem::stability {

/// A matrix of the rows and of nothing else: a line for each name, under its group with the group's counts, and
/// a column for each variant; a case without a variant covers all columns. Solved cells are shaded by error / bound,
/// refused ones are gray, failed ones hold error / bound, or a cross where they have no number.
Plot picture(const std::vector<Row>& rows);

/// Throws InputError unless the name ends in .png or .svg.
void check_picture_name(const std::string& file);
void write_picture(const std::string& file, const std::vector<Row>& rows);

}  // namespace sem::stability
