// sem_figures: every figure from one command, its numbers (CSV) before its pictures (PNG, SVG).
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "figures/check.h"
#include "figures/gallery.h"
#include "sem/base/stopwatch.h"
#include "sem/base/error.h"
#include "sem/scene/fields.h"
#include "sem/scene/files.h"

namespace {

using namespace sem;
using namespace sem::figures;

struct Options {
  std::vector<std::string> names;
  std::string out = "out/figures", references = SEM_FIGURE_REFERENCES;
  bool list = false, check = false, update = false;
};

// Those named; or all, the slow ones with the numbers that are stored unless they are to be new.
std::vector<Figure> select(const Options& options) {
  const auto& names = options.names;
  if (names.empty()) {
    std::vector<Figure> all = all_figures();
    for (Figure& figure : all)
      if (figure.slow && !options.update)
        figure.compute = [figure, from = options.references] {
          return stored_numbers(figure, from);
        };
    return all;
  }
  std::vector<std::string> known;
  for (const auto& figure : all_figures()) known.push_back(figure.name);
  std::vector<Figure> selected;
  for (const auto& name : names) {
    const auto at = std::find(known.begin(), known.end(), name);
    if (at == known.end()) {
      const std::string close = closest_name(name, known);
      throw InputError(
          "", "NAME", "'" + name + "'",
          close.empty() ? "a figure that --list shows" : "'" + close + "' (did you mean that?)");
    }
    selected.push_back(all_figures()[at - known.begin()]);
  }
  return selected;
}

// The page shows every figure that is in the folder, also from earlier calls.
void write_gallery(const std::string& folder) {
  std::vector<Figure> present;
  for (const auto& figure : all_figures())
    if (std::filesystem::exists(folder + "/" + figure.name + ".png")) present.push_back(figure);
  write_file(folder + "/index.html", gallery_html(present));
}

// False if a reference differs.
bool check(const std::vector<Figure>& figures, const Options& options) {
  int n_differing = 0;
  for (const auto& figure : figures) {
    const auto differences =
        check_figure(figure, figure.compute(), options.references, options.out);
    std::cout << figure.name << (differences.empty() ? ": as stored" : ": DIFFERS") << std::endl;
    for (const auto& text : differences) std::cout << "  " << text << std::endl;
    n_differing += !differences.empty();
  }
  if (n_differing > 0)
    std::cout << n_differing << " of " << figures.size() << " figures differ from "
              << options.references << "; pictures that differ are in " << options.out
              << "; --update stores the new ones" << std::endl;
  return n_differing == 0;
}

bool run(const Options& options) {
  const auto selected = select(options);
  if (options.list) {
    for (const auto& figure : selected)
      std::printf("%-24s %s\n", figure.name.c_str(), figure.caption.c_str());
    return true;
  }
  make_folder(options.out);
  if (options.check) return check(selected, options);
  if (options.update) make_folder(options.references);
  for (const auto& figure : selected) {
    const sem::Stopwatch watch;
    const std::string path = options.out + "/" + figure.name;
    make_figure(figure, options.out);
    if (options.update)
      update_reference(figure, from_csv(read_file(path + ".csv"), path + ".csv"),
                       options.references);
    const bool stored = figure.slow && options.names.empty() && !options.update;
    std::printf("%s.png  %s (%.1f s%s)\n", path.c_str(), figure.caption.c_str(), watch.seconds(),
                stored ? ", numbers as stored: name it to compute them" : "");
    std::fflush(stdout);
  }
  write_gallery(options.out);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"sem_figures: draws the figures, each from a CSV file of its numbers",
               "sem_figures"};
  Options options;
  app.add_option("NAME", options.names, "figures to draw; all if none is named");
  app.add_option("--out", options.out, "output folder")->capture_default_str();
  app.add_flag("--list", options.list, "list the figures");
  auto* check_flag = app.add_flag("--check", options.check,
                                  "compare with the stored references; exit code 1 if one differs");
  app.add_flag("--update", options.update, "replace the stored references")->excludes(check_flag);
  app.add_option("--references", options.references, "folder of the stored references")
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    return run(options) ? 0 : 1;
  } catch (const InputError& error) {
    std::cerr << "sem_figures: " << error.what() << "\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "sem_figures: " << error.what() << "\n";
    return 1;
  }
}
