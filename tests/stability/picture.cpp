// The picture of sem_stability's table: what it shows is what the rows say.
#include <doctest/doctest.h>

#include "plot/recording.h"
#include "sem/base/error.h"
#include "tests/hard_cases/picture.h"

using namespace sem;
using namespace sem::stability;

namespace {

Row row(const std::string& group, const std::string& name, const std::string& variant, Rule rule, Outcome outcome,
        double error = 0) {
  return {{group, name, variant, rule, true, {}}, {outcome, "", error}, 1};
}

// Two groups; every verdict; a case without a variant, one with a single one.
std::vector<Row> some_rows() {
  return {row("shapes", "cusp", "2D projected", Rule::must_solve, Outcome::solved, 1e-5),
          row("shapes", "cusp", "2D condensed", Rule::must_solve, Outcome::failed, 28.4),
          row("shapes", "cusp", "3D projected", Rule::must_solve, Outcome::refused),
          row("shapes", "cusp", "3D condensed", Rule::may_refuse, Outcome::refused),
          row("shapes", "sliver", "2D condensed", Rule::may_refuse, Outcome::failed),
          row("solver", "barrier", "", Rule::may_refuse, Outcome::refused),
          row("solver", "no pins", "2D projected", Rule::may_refuse, Outcome::solved, 0.5)};
}

test::RecordingCanvas drawn(const std::vector<Row>& rows) {
  const Plot plot = picture(rows);
  test::RecordingCanvas canvas(300 * plot.width(), 300 * plot.height());
  plot.draw(canvas);
  return canvas;
}

}  // namespace

TEST_CASE("the picture names every group with its counts, every case and every variant, once") {
  const auto canvas = drawn(some_rows());
  for (const char* text : {"shapes: 1 solved, 1 refused, 3 failed", "solver: 1 solved, 1 refused, 0 failed", "cusp",
                           "sliver", "barrier", "no pins"}) {
    CAPTURE(text);
    CHECK(canvas.count(text) == 1);
  }
  CHECK(canvas.count("2D") == 2);
  CHECK(canvas.count("3D") == 2);
  CHECK(canvas.count("proj.") == 2);
  CHECK(canvas.count("cond.") == 2);
}

TEST_CASE("the picture has a cell a row; failed ones hold their error by its bound, or a cross") {
  const auto rows = some_rows();
  const auto canvas = drawn(rows);
  CHECK(canvas.count("28") == 1);
  CHECK(canvas.count("\u00d7") == 2);
  // Another row of the case remains: one cell less and nothing else.
  for (size_t k = 0; k < 3; ++k) {
    auto fewer = rows;
    fewer.erase(fewer.begin() + long(k));
    CHECK(drawn(fewer).fills.size() + 1 == canvas.fills.size());
  }
}

TEST_CASE("texts of the picture are apart and inside, also where it takes two panels") {
  std::vector<Row> rows;
  for (const char* group : {"first", "second"})
    for (int k = 0; k < 30; ++k)
      for (const char* variant : {"2D projected", "2D condensed", "3D projected", "3D condensed"})
        rows.push_back(row(group, std::string(group) + " case, a long name, " + std::to_string(k), variant,
                           Rule::must_solve, Outcome::failed, 1234));
  const auto canvas = drawn(rows);
  CHECK(canvas.count("first: 0 solved, 0 refused, 120 failed") == 1);
  CHECK(canvas.find("second: 0 solved, 0 refused, 120 failed").box.lower[0] > canvas.width() / 2);
  for (const auto& text : canvas.texts) {
    CAPTURE(text.utf8);
    CHECK(text.box.lower.minCoeff() >= 0);
    CHECK(text.box.upper[0] <= canvas.width());
    CHECK(text.box.upper[1] <= canvas.height());
  }
}

TEST_CASE("a picture is a .png or an .svg") {
  CHECK_THROWS_AS(check_picture_name("table.jpg"), InputError);
  check_picture_name("table.png");
  check_picture_name("table.svg");
}
