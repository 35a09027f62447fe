// Figures: numbers before pictures, and that the numbers are what the figures say.
#include <doctest/doctest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "figures/blob.h"
#include "figures/check.h"
#include "figures/gallery.h"
#include "figures/solid_view.h"
#include "folder.h"
#include "plot/recording.h"
#include "sem/base/error.h"
#include "sem/method/boundary_integrals.h"
#include "trimmed.h"

using namespace sem;
using namespace sem::figures;
using sem::test::content;
using sem::test::Folder;
namespace fs = std::filesystem;

namespace {

// The figure's numbers, computed once; the stored ones if that takes long.
const Data& data_of(const std::string& name) {
  static std::map<std::string, Data> computed;
  if (!computed.count(name))
    for (const auto& figure : all_figures())
      if (figure.name == name)
        computed[name] =
            figure.slow ? stored_numbers(figure, SEM_FIGURE_REFERENCES) : figure.compute();
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

TEST_CASE("trims come back from a figure's file as they were, parts without any among them") {
  Trims trims(4);
  trims[1] = {test::polygon({{-0.9, -0.8}, {0.9, -0.8}, {0.8, 0.9}}),
              test::circle({0.2, 0.3}, 0.25)};
  trims[3] = {test::circle({0.1, -0.3}, 0.2, 3)};
  Data data;
  add_trims(data, trims, "plate ");
  const Data read = from_csv(to_csv(data), "trims.csv");
  const Trims back = trims_of(read, 4, "plate ");
  REQUIRE(back.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    REQUIRE(back[i].size() == trims[i].size());
    for (std::size_t loop = 0; loop < trims[i].size(); ++loop) {
      REQUIRE(back[i][loop].size() == trims[i][loop].size());
      for (std::size_t k = 0; k < trims[i][loop].size(); ++k) {
        const auto &one = trims[i][loop][k], &other = back[i][loop][k];
        CHECK(one.degree == other.degree);
        CHECK(one.knots == other.knots);
        CHECK(one.control_points == other.control_points);
        CHECK(one.weights == other.weights);
      }
    }
  }
  CHECK(trims_of(read, 4, "another ").empty());
  Data none;
  add_trims(none, Trims(3));
  CHECK(none.tables().empty());
}

TEST_CASE("the numbers of every figure read back as the same bits") {
  for (const auto& figure : all_figures()) {
    CAPTURE(figure.name);
    const Data& data = data_of(figure.name);
    REQUIRE(!data.tables().empty());
    const std::string text = to_csv(data);
    const Data back = from_csv(text, "");
    CHECK(to_csv(back) == text);
    for (const auto& [name, table] : data.tables()) {
      CHECK(table.n_rows() > 0);
      if (figure.slow) continue;  // from a file: every table has all columns, most without values
      for (const auto& column : table.columns()) CHECK(back[name][column] == table[column]);
    }
  }
}

TEST_CASE("tables share one file: missing columns and values that are not finite are empty cells") {
  Data data;
  data.add("curve", {"x", "y"}).add({1, 2.5});
  auto& errors = data.add("errors", {"x", "error"});
  errors.add({3, std::nan("")});
  errors.add({4, 1e-300});
  const std::string text = to_csv(data);
  CHECK(text == "table,x,y,error\ncurve,1,2.5,\nerrors,3,,\nerrors,4,,1e-300\n");
  const Data back = from_csv(text, "");
  CHECK(back["errors"].value("error", 1) == 1e-300);
  CHECK(std::isnan(back["errors"].value("error", 0)));
  CHECK(back["errors"].where("x", 4).n_rows() == 1);
  CHECK(back["errors"].runs("x").size() == 2);
}

TEST_CASE("unknown tables, columns and rows are refused by name") {
  Data data;
  data.add("curve", {"x", "y"}).add({1, 2});
  CHECK_THROWS_WITH_AS(data["curves"], doctest::Contains("'curves'"), InputError);
  CHECK_THROWS_WITH_AS(data["curve"]["z"], doctest::Contains("'z'; allowed: x, y"), InputError);
  CHECK_THROWS_AS(data["curve"].value("x", 1), InputError);
}

TEST_CASE("a file with a word, a missing cell or a torn table is refused, with file and line") {
  for (const char* text :
       {"table,a,b\nt,1,2\nt,3,x\n", "table,a,b\nt,1,2\nt,3\n", "table,a,b\nt,1,2\n,3,1\n"})
    CHECK_THROWS_WITH_AS(from_csv(text, "f.csv"), doctest::Contains("f.csv: line 3"), InputError);
  CHECK_THROWS_WITH_AS(from_csv("table,a\nt,1\nu,1\nt,1\n", "f.csv"),
                       doctest::Contains("f.csv: line 4"), InputError);
  CHECK_THROWS_WITH_AS(from_csv("a,b\n1,2\n", "f.csv"), doctest::Contains("line 1"), InputError);
}

TEST_CASE("a picture is drawn from what the CSV file holds") {
  const Folder folder("figures_order");
  Data computed;
  computed.add("t", {"x"}).add({1.0 / 3});
  std::string drawn;
  const Figure figure{"probe",
                      "a probe",
                      0.4,
                      0.3,
                      [&] { return computed; },
                      [&](Plot& plot, const Data& data) {
                        CHECK(content(folder / "probe.csv") == to_csv(data));
                        CHECK(!fs::exists(folder / "probe.png"));
                        drawn = to_csv(data);
                        plot.panel().frame = false;
                      }};
  make_figure(figure, folder.path());
  CHECK(drawn == to_csv(computed));
  CHECK(fs::exists(folder / "probe.png"));
  CHECK(fs::exists(folder / "probe.svg"));
}

TEST_CASE("figures have the same bytes twice, 300 dots per inch") {
  const Folder folder("figures_twice");
  for (const auto& figure : all_figures()) {
    if (figure.width > 4) continue;  // the small ones use all that the large one does
    CAPTURE(figure.name);
    Figure stored = figure;
    stored.compute = [&] { return data_of(figure.name); };
    make_figure(stored, folder.path());
    const std::string png = content(folder / (figure.name + ".png")),
                      svg = content(folder / (figure.name + ".svg"));
    make_figure(stored, folder.path());
    CHECK(png == content(folder / (figure.name + ".png")));
    CHECK(svg == content(folder / (figure.name + ".svg")));
    // 300 dots per inch: 11811 pixels per metre, in the pHYs chunk.
    const size_t chunk = png.find("pHYs");
    REQUIRE(chunk != std::string::npos);
    CHECK(png.substr(chunk + 4, 4) == std::string("\0\0\x2e\x23", 4));
  }
}

TEST_CASE("every text of every figure lies on the page") {
  for (const auto& figure : all_figures()) {
    CAPTURE(figure.name);
    test::RecordingCanvas canvas(std::round(300 * figure.width), std::round(300 * figure.height));
    plot_of(figure, from_csv(to_csv(data_of(figure.name)), "")).draw(canvas);
    CHECK(!canvas.texts.empty());
    for (const auto& text : canvas.texts) {
      CAPTURE(text.utf8);
      CHECK((text.box.lower.array() >= 0).all());
      CHECK(text.box.upper[0] <= canvas.width());
      CHECK(text.box.upper[1] <= canvas.height());
    }
  }
}

TEST_CASE("raycast figure: rays that miss, points on intervals, weights that sum to the area") {
  const Data& data = data_of("raycast_quadrature");
  const DataTable &rays = data["rays"], &intervals = data["intervals"], &points = data["points"];
  int n_missing = 0;
  for (const double y : rays["y"]) n_missing += intervals.where("y", y).n_rows() == 0;
  CHECK(n_missing >= 2);
  CHECK(n_missing < rays.n_rows() / 2);
  double area = 0;
  for (int k = 0; k < points.n_rows(); ++k) {
    area += points.value("weight", k);
    const DataTable on_ray = intervals.where("y", points.value("y", k));
    bool inside = false;
    for (int i = 0; i < on_ray.n_rows(); ++i)
      inside = inside || (on_ray.value("x_begin", i) < points.value("x", k) &&
                          points.value("x", k) < on_ray.value("x_end", i));
    CHECK(inside);
  }
  const auto blob = builtin_body("blob");
  CHECK(area == doctest::Approx(boundary_moments(blob.boundary, blob.loops).volume).epsilon(0.03));
}

TEST_CASE("weights figure: every weight in [0, 1], the blending weights sum to 1") {
  const DataTable& cells = data_of("distance_weights")["cells"];
  CHECK(cells.n_rows() > 1000);
  double worst_sum = 0;
  bool in_range = true;
  for (int k = 0; k < cells.n_rows(); ++k) {
    double sum = 0;
    for (const std::string i : {"0", "1", "2"}) {
      sum += cells.value("w_" + i, k);
      for (const std::string field : {"theta_", "theta_draft_", "w_"}) {
        const double value = cells.value(field + i, k);
        in_range = in_range && value >= 0 && value <= 1;
      }
    }
    worst_sum = std::max(worst_sum, std::abs(sum - 1));
  }
  CHECK(worst_sum < 1e-14);
  CHECK(in_range);
}

TEST_CASE(
    "construction figure: its distances are those between its points, theta follows from them") {
  const Data& data = data_of("distance_construction");
  const auto points = zip(data["points"]["x"], data["points"]["y"]);
  const Vec<2>&X = points[0], &foot = points[1], &hit = points[2];
  const DataTable& values = data["values"];
  const double alpha = values.value("alpha"), d1 = values.value("d1"), d = values.value("d");
  CHECK((X - foot).norm() == doctest::Approx(d1));
  CHECK((hit - foot).norm() == doctest::Approx(d));
  CHECK((hit - X).norm() == doctest::Approx(d - d1));  // X lies between them
  CHECK(values.value("theta_published") == doctest::Approx(1 - d1 / std::min(d, alpha)));
  CHECK(values.value("theta_draft") == doctest::Approx(1 - d1 / std::min(d - d1, alpha)));
  // No point of the green curve is closer than X*; the hit lies on another curve.
  double closest_green = 1e9, closest_other = 1e9;
  const DataTable& curves = data["curves"];
  for (int k = 0; k < curves.n_rows(); ++k) {
    const Vec<2> on_curve(curves.value("x", k), curves.value("y", k));
    if (curves.value("part", k) == 2)
      closest_green = std::min(closest_green, (on_curve - X).norm());
    else
      closest_other = std::min(closest_other, (on_curve - hit).norm());
  }
  CHECK(closest_green >= d1 * (1 - 1e-12));
  CHECK(closest_green < d1 * 1.001);
  CHECK(closest_other < 0.02);
}

TEST_CASE("convergence figure: on the disc midpoint rays have order 3/2, Gauss rays order 3") {
  const DataTable disc = data_of("quadrature_convergence")["errors"].where("body", 0);
  for (const int gauss : {0, 1}) {
    const DataTable line = disc.where("rule", gauss);
    const auto &error = line["relative_error_of_area"], &rays = line["setting"];
    const size_t last = rays.size() - 1, first = last / 2;
    CHECK(std::log(error[first] / error[last]) / std::log(rays[last] / rays[first]) ==
          doctest::Approx(gauss ? 3 : 1.5).epsilon(0.05));
  }
}

TEST_CASE("convergence figure: exact rules keep the tolerance that they were given") {
  const DataTable errors = data_of("quadrature_convergence")["errors"];
  for (const int rule : {2, 3}) {
    const DataTable line = errors.where("rule", rule);
    for (int k = 0; k < line.n_rows(); ++k)
      CHECK(line.value("relative_error_of_smooth_integrals", k) <=
            std::max(1e-13, 1.5 * line.value("setting", k)));
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
  CHECK(written == std::vector<std::string>{"distance_construction.csv",
                                            "distance_construction.png",
                                            "distance_construction.svg", "index.html"});
  const std::string page = content(folder / "pictures/index.html");
  CHECK(page.find("sem_figures distance_construction") != std::string::npos);
  CHECK(page.find("raycast_quadrature") == std::string::npos);  // not in this folder
  CHECK(page.find("<script") == std::string::npos);
  CHECK(page.find(machine_text()) != std::string::npos);

  CHECK(call(folder, "raycast_quadratur") == 2);
  CHECK(content(folder / "stderr").find("raycast_quadrature") != std::string::npos);
  CHECK(call(folder, "--no-such-option") == 2);
  CHECK(call(folder, "--check --update") == 2);
  test::write(folder / "file", "");
  CHECK(call(folder, "--out file/inside") == 2);
  CHECK(call(folder, "distance_construction --check --references nowhere") == 2);
  CHECK(content(folder / "stderr").find("nowhere/distance_construction.csv") != std::string::npos);
  CHECK(!fs::exists(folder / "nowhere"));
}

TEST_CASE("the program stores a reference on --update only, and --check compares with it") {
  const Folder folder("figures_references");
  const std::string name = "quadrature_convergence", rest = " --out o --references r";
  CHECK(call(folder, name + rest) == 0);
  CHECK(!fs::exists(folder / "r"));
  CHECK(call(folder, name + " --update" + rest) == 0);
  CHECK(fs::exists(folder / "r/quadrature_convergence.csv"));
  CHECK(call(folder, name + " --check" + rest) == 0);
  std::string csv = content(folder / "r/quadrature_convergence.csv");
  const size_t digit = csv.find_first_of("123456789", csv.find('.'));
  csv.insert(digit, "9");
  test::write(folder / "r/quadrature_convergence.csv", csv);
  CHECK(call(folder, name + " --check" + rest) == 1);
  CHECK(content(folder / "stdout").find("  errors.") != std::string::npos);
  CHECK(content(folder / "r/quadrature_convergence.csv") == csv);
}
