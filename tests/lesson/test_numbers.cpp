#include <doctest/doctest.h>

#include <limits>

#include "sem/lesson/numbers.h"

using namespace sem;

TEST_CASE("rounded() hides rounding errors: noise below the scale, signed zeros, ties") {
  CHECK(rounded(0.1 + 0.2) == "0.3");
  CHECK(rounded(-0.0) == "0");
  CHECK(rounded(-1e-16) == "0");
  CHECK(rounded(1e-9, 3, 1e5) == "0");
  CHECK(rounded(1e-9, 3) == "1e-09");
  // A tie, and what rounding errors make of it.
  CHECK(rounded(0.125, 2) == "0.13");
  CHECK(rounded(0.125 * (1 - 1e-15), 2) == "0.13");
  CHECK(rounded(-0.125 * (1 - 1e-15), 2) == "-0.13");
  CHECK(rounded(0.12499, 2) == "0.12");
  CHECK(rounded(1234567.0, 3) == "1.23e+06");
  CHECK(rounded(std::numeric_limits<double>::quiet_NaN()) == "nan");
  CHECK(rounded(-std::numeric_limits<double>::infinity()) == "-inf");
}

TEST_CASE("error_text() names the bound below it and two digits above it") {
  CHECK(error_text(0) == "< 1e-12");
  CHECK(error_text(-9e-13) == "< 1e-12");
  CHECK(error_text(-1.234e-9) == "1.2e-09");
  CHECK(error_text(3e-10, 1e-9) == "< 1e-09");
  CHECK(error_text(std::numeric_limits<double>::quiet_NaN()) == "nan");
}

TEST_CASE("matrices and tables are aligned, by characters and not by bytes") {
  Eigen::MatrixXd A(2, 2);
  A << 1, -0.5, 1e-17, 12.25;
  CHECK(rounded(A) == "  1   -0.5\n  0  12.25\n");
  CHECK(table({"name", "θ"}, {{"p₁", "0.5"}, {"long", "10"}}, "") ==
        "name    θ\n"
        "p₁    0.5\n"
        "long   10\n");
  CHECK(table({"h"}, {}) == "  h\n");
}
