// References of figures: what a check notices and what it does not.
#include <doctest/doctest.h>

#include <cmath>

#include "figures/check.h"
#include "folder.h"
#include "sem/base/error.h"

using namespace sem;
using namespace sem::figures;
using sem::test::Folder;
namespace fs = std::filesystem;

namespace {

// A curve with a value per row and a time.
Data curve(int n_rows, double height = 1, double seconds = 0.1) {
  Data data;
  auto& table = data.add("curve", {"x", "y", "step_seconds"});
  for (int i = 0; i < n_rows; ++i)
    table.add({double(i), height * std::sin(0.1 * i), seconds * (1 + i % 3)});
  return data;
}

const Figure probe{"probe",
                    "a probe",
                    2,
                    1.5,
                    [] { return curve(40); },
                    [](Plot& plot, const Data& data) {
                      const DataTable& table = data["curve"];
                      plot.panel().curve(table["x"], table["y"]);
                      plot.panel(0, 1).curve(table["x"], table["step_seconds"]);
                    }};

Data changed(const Data& data, int row, double factor) {
  Data result;
  for (const auto& [name, table] : data.tables()) {
    auto& copy = result.add(name, table.columns());
    for (int k = 0; k < table.n_rows(); ++k)
      copy.add({table.value("x", k), table.value("y", k) * (k == row ? factor : 1),
                table.value("step_seconds", k)});
  }
  return result;
}

}  // namespace

TEST_CASE("a check passes with the same numbers, and notices one that changed by 1e-5") {
  const Folder references("check_references"), out("check_out");
  update_reference(probe, curve(40), references.path());
  CHECK(check_figure(probe, curve(40), references.path(), out.path()).empty());
  const auto differences =
      check_figure(probe, changed(curve(40), 15, 1 + 1e-5), references.path(), out.path());
  REQUIRE(differences.size() == 1);  // the picture is the same
  CHECK(differences[0].find("curve.y: row 15") == 0);
  CHECK(check_figure(probe, changed(curve(40), 15, 1 + 1e-8), references.path(), out.path())
            .empty());
  CHECK(fs::is_empty(out.path()));
}

TEST_CASE("times are not compared, neither in numbers nor in the picture, but must be there") {
  const Folder references("check_times"), out("check_times_out");
  update_reference(probe, curve(40), references.path());
  CHECK(check_figure(probe, curve(40, 1, 0.7), references.path(), out.path()).empty());
  CHECK(!check_figure(probe, curve(39), references.path(), out.path()).empty());
  Figure declared = probe;
  declared.measured = {"y"};
  CHECK(check_figure(declared, changed(curve(40), 15, 2), references.path(), out.path()).empty());
}

TEST_CASE(
    "a changed picture is noticed and written beside the expected one; a good one removes them") {
  const Folder references("check_picture"), out("check_picture_out");
  update_reference(probe, curve(40), references.path());
  Figure thick = probe;
  thick.draw = [](Plot& plot, const Data& data) {
    const DataTable& table = data["curve"];
    plot.panel().curve(table["x"], table["y"], {.width = 4});
    plot.panel(0, 1).curve(table["x"], table["step_seconds"]);
  };
  const auto differences = check_figure(thick, curve(40), references.path(), out.path());
  REQUIRE(!differences.empty());
  CHECK(differences[0].find("the picture differs") == 0);
  const char* const written[] = {"probe_expected.png", "probe_actual.png", "probe_difference.png"};
  for (const char* file : written) CHECK(fs::exists(out / file));
  CHECK(read_png(out / "probe_expected.png").rgb == read_png(references / "probe.png").rgb);
  CHECK(read_png(out / "probe_expected.png").rgb != read_png(out / "probe_actual.png").rgb);
  CHECK(check_figure(probe, curve(40), references.path(), out.path()).empty());
  for (const char* file : written) CHECK(!fs::exists(out / file));
}

TEST_CASE("a change of one pixel's shade is tolerated, a moved mark is not") {
  Image a(80, 60), b(80, 60), c(80, 60);
  for (Image* image : {&a, &b, &c}) std::fill(image->rgb.begin(), image->rgb.end(), 255);
  b.pixel(40, 30)[0] = 200;
  for (int row = 20; row < 26; ++row)
    for (int column = 20; column < 26; ++column) c.set(column, row, colors::black);
  CHECK(compare_pictures(a, b).empty());
  CHECK(!compare_pictures(a, c).empty());
  CHECK(!compare_pictures(a, Image(80, 61)).empty());
}

TEST_CASE("large tables are thinned below 100 kB, and a change in a row left out still counts") {
  const Data large = curve(20000);
  const Data kept = thinned(large);
  CHECK(to_csv(kept).size() < 100000);
  CHECK(kept["curve"].n_rows() > 500);
  CHECK(kept["curve"].value("x", 1) > 1);
  CHECK(kept.has("curve mean of 20000"));
  const int left_out = 1;
  const auto differences = compare_numbers(kept, thinned(changed(large, left_out, 100)), probe);
  REQUIRE(differences.size() == 1);
  CHECK(differences[0].find("curve mean of 20000.y") == 0);
  CHECK(compare_numbers(kept, thinned(curve(19999)), probe).size() > 0);
  CHECK(thinned(curve(40))["curve"].n_rows() == 40);
}

TEST_CASE("a missing reference is an error that names its file") {
  const Folder out("check_missing");
  CHECK_THROWS_WITH_AS(check_figure(probe, curve(40), out / "none", out.path()),
                       doctest::Contains("probe.csv"), InputError);
}
