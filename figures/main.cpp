// sem_figures: every figure from one command, its numbers (CSV) before its picture (PNG).
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <iostream>

#include "figures/figure.h"
#include "sem/base/error.h"
#include "sem/scene/fields.h"
#include "sem/scene/files.h"

namespace {

using namespace sem;
using namespace sem::figures;

std::vector<Figure> select(const std::vector<std::string>& names) {
  if (names.empty()) return all_figures();
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

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"sem_figures: draws the figures, each from a CSV file of its numbers",
               "sem_figures"};
  std::vector<std::string> names;
  std::string folder = "out/figures";
  bool list = false;
  app.add_option("NAME", names, "figures to draw; all if none is named");
  app.add_option("--out", folder, "output folder")->capture_default_str();
  app.add_flag("--list", list, "list the figures");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    if (list) {
      for (const auto& figure : all_figures())
        std::printf("%-24s %s\n", figure.name.c_str(), figure.caption.c_str());
      return 0;
    }
    const auto selected = select(names);
    make_folder(folder);
    for (const auto& figure : selected) {
      make_figure(figure, folder);
      std::cout << folder << "/" << figure.name << ".png  " << figure.caption << std::endl;
    }
  } catch (const InputError& error) {
    std::cerr << "sem_figures: " << error.what() << "\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "sem_figures: " << error.what() << "\n";
    return 1;
  }
}
