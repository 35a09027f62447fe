// Figures: numbers before pictures, and that the numbers are what the figures say.
#include <doctest/doctest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "builtin.h"
#include "figures/figure.h"
#include "folder.h"
#include "sem/base/error.h"
#include "sem/draw/raster.h"
#include "sem/method/boundary_integrals.h"

using namespace sem;
using namespace sem::figures;
using sem::test::content;
using sem::test::Folder;
namespace fs = std::filesystem;

namespace {

// The figure's numbers, computed once.
const Data& data_of(const std::string& name) {
  static std::map<std::string, Data> computed;
  if (!computed.count(name))
    for (const auto& figure : all_figures())
      if (figure.name == name) computed[name] = figure.compute();
  return computed.at(name);
}

int call(const Folder& folder, const std::string& arguments) {
  const std::string command =
      "cd '" + folder.path() + "' && '" + SEM_FIGURES + "' " + arguments + " > stdout 2> stderr";
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

TEST_CASE("every figure has a name of its own, a caption and a journal's width") {
  std::vector<std::string> names;
  for (const auto& figure : all_figures()) {
    names.push_back(figure.name);
    CHECK(!figure.caption.empty());
    CHECK((figure.width == 3.3 || figure.width == 7));
  }
  std::sort(names.begin(), names.end());
  CHECK(std::adjacent_find(names.begin(), names.end()) == names.end());
}

TEST_CASE("the numbers of every figure read back as the same bits") {
  for (const auto& figure : all_figures()) {
    CAPTURE(figure.name);
    const Data& data = data_of(figure.name);
    CHECK(!data.rows.empty());
    const Data back = from_csv(to_csv(data), "");
    CHECK(back.columns == data.columns);
    CHECK(back.rows == data.rows);
  }
}

TEST_CASE("a table with a word or a missing value is refused, with file and line") {
  for (const char* text : {"a,b\n1,2\n3,x\n", "a,b\n1,2\n3\n", "a,b\n1,2\n3,\n"})
    CHECK_THROWS_WITH_AS(from_csv(text, "f.csv"), doctest::Contains("f.csv: line 3"), InputError);
}

TEST_CASE("a picture is drawn from what the CSV file holds") {
  // A figure whose computed numbers differ from those that it draws would show here.
  Data drawn;
  Figure figure{"probe",
                "",
                0.2,
                0.1,
                [] {
                  return Data{{"x"}, {{1.0 / 3}, {2}}};
                },
                [&](Canvas&, const Data& data) { drawn = data; }};
  const Folder folder("figures_order");
  figure.draw = [&](Canvas&, const Data& data) {
    drawn = data;
    CHECK(content(folder / "probe.csv") == to_csv(data));
    CHECK(!fs::exists(folder / "probe.png"));
  };
  make_figure(figure, folder.path());
  CHECK(drawn.rows == figure.compute().rows);
  CHECK(fs::exists(folder / "probe.png"));
}

TEST_CASE("figures have the same bytes twice") {
  const Folder folder("figures_twice");
  for (const auto& figure : all_figures()) {
    if (figure.width > 4) continue;  // the small ones use all that the large one does
    CAPTURE(figure.name);
    Figure stored = figure;
    stored.compute = [&] { return data_of(figure.name); };
    make_figure(stored, folder.path());
    const std::string png = content(folder / (figure.name + ".png"));
    make_figure(stored, folder.path());
    CHECK(png == content(folder / (figure.name + ".png")));
    // 300 dots per inch: 11811 pixels per metre, in the pHYs chunk.
    const size_t chunk = png.find("pHYs");
    REQUIRE(chunk != std::string::npos);
    CHECK(png.substr(chunk + 4, 4) == std::string("\0\0\x2e\x23", 4));
  }
}

TEST_CASE("raycast figure: rays that miss, points on intervals, weights that sum to the area") {
  const Data& data = data_of("raycast_quadrature");
  const Data rays = data.where("kind", 1), intervals = data.where("kind", 2),
             points = data.where("kind", 4);
  int n_missing = 0;
  for (const auto& ray : rays.rows) n_missing += intervals.where("y", ray[2]).rows.empty();
  CHECK(n_missing >= 2);
  CHECK(n_missing < int(rays.rows.size()) / 2);
  double area = 0;
  for (const auto& point : points.rows) {
    area += point[4];
    const auto on_ray = intervals.where("y", point[2]).rows;
    CHECK(std::any_of(on_ray.begin(), on_ray.end(), [&](const auto& stretch) {
      return stretch[1] < point[1] && point[1] < stretch[3];
    }));
  }
  const test::Body blob("blob");
  const auto& d = blob.model->discretization;
  CHECK(area == doctest::Approx(boundary_moments(d.boundary, d.loops).volume).epsilon(0.03));
}

TEST_CASE("weights figure: every weight in [0, 1], the blending weights sum to 1") {
  const Data cells = data_of("distance_weights").where("kind", 1);
  CHECK(cells.rows.size() > 1000);
  double worst_sum = 0;
  bool in_range = true;
  for (const auto& row : cells.rows) {
    worst_sum = std::max(worst_sum, std::abs(row[11] + row[12] + row[13] - 1));
    in_range = in_range &&
               std::all_of(row.begin() + 5, row.end(), [](double w) { return w >= 0 && w <= 1; });
  }
  CHECK(worst_sum < 1e-14);
  CHECK(in_range);
}

TEST_CASE(
    "construction figure: its distances are those between its points, theta follows from them") {
  const Data& data = data_of("distance_construction");
  const auto row = [&](double kind) { return data.where("kind", kind).rows.at(0); };
  const auto at = [&](double kind) { return Vec<2>(row(kind)[1], row(kind)[2]); };
  const Vec<2> X = at(1), foot = at(2), hit = at(3);
  const double alpha = row(1)[3], d1 = row(2)[3], d = row(3)[3];
  CHECK((X - foot).norm() == doctest::Approx(d1));
  CHECK((hit - foot).norm() == doctest::Approx(d));
  CHECK((hit - X).norm() == doctest::Approx(d - d1));  // X lies between them
  CHECK(row(4)[3] == doctest::Approx(1 - d1 / std::min(d, alpha)));
  CHECK(row(4)[1] == doctest::Approx(1 - d1 / std::min(d - d1, alpha)));
  // No point of the green curve is closer than X*; the hit lies on another curve.
  double closest_green = 1e9, closest_other = 1e9;
  for (const auto& curve : data.where("kind", 0).rows) {
    const Vec<2> on_curve(curve[1], curve[2]);
    if (curve[3] == 2)
      closest_green = std::min(closest_green, (on_curve - X).norm());
    else
      closest_other = std::min(closest_other, (on_curve - hit).norm());
  }
  CHECK(closest_green >= d1 * (1 - 1e-12));
  CHECK(closest_green < d1 * 1.001);
  CHECK(closest_other < 0.02);
}

TEST_CASE("convergence figure: on the disc midpoint rays have order 3/2, Gauss rays order 3") {
  const Data disc = data_of("quadrature_convergence").where("body", 0);
  for (const int gauss : {0, 1}) {
    const auto error = disc.where("gauss", gauss).column("relative_error_of_area");
    const size_t n = error.size();
    CHECK(std::log2(error[n - 3] / error[n - 1]) / 2 ==
          doctest::Approx(gauss ? 3 : 1.5).epsilon(0.05));
  }
}

TEST_CASE("the program lists the figures, draws the one asked for, and refuses others") {
  const Folder folder("figures_program");
  CHECK(call(folder, "--list") == 0);
  const std::string list = content(folder / "stdout");
  for (const auto& figure : all_figures()) CHECK(list.find(figure.name) != std::string::npos);
  CHECK(call(folder, "distance_construction --out pictures") == 0);
  std::vector<std::string> written;
  for (const auto& entry : fs::directory_iterator(folder / "pictures"))
    written.push_back(entry.path().filename().string());
  std::sort(written.begin(), written.end());
  CHECK(written ==
        std::vector<std::string>{"distance_construction.csv", "distance_construction.png"});

  CHECK(call(folder, "raycast_quadratur") == 2);
  CHECK(content(folder / "stderr").find("raycast_quadrature") != std::string::npos);
  CHECK(call(folder, "--no-such-option") == 2);
  test::write(folder / "file", "");
  CHECK(call(folder, "--out file/inside") == 2);
  CHECK(!fs::exists(folder / "out"));
}
