// Lesson::run: a lesson as a program.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>

#include "sem/base/error.h"
#include "sem/draw/raster.h"
#include "sem/lesson/lesson.h"
#include "sem/lesson/window.h"
#include "sem/lesson/workbench.h"

namespace sem {
namespace {

namespace fs = std::filesystem;

void list(const Lesson& lesson, std::ostream& out) {
  out << lesson.title() << "\n";
  for (int i = 0; i < lesson.n_steps(); ++i) {
    out << "\n" << i + 1 << "  " << lesson.step_title(i) << "\n";
    for (const auto& p : lesson.parameters()) {
      if (p.step != i) continue;
      std::string line = "     --set " + p.name + "=" + value_text(p, p.get());
      line.resize(std::max<std::size_t>(line.size() + 2, 32), ' ');
      out << line << allowed_text(p) << (p.help.empty() ? "" : "; " + p.help) << "\n";
    }
  }
}

/// "01_the_curve.png": letters and digits of the title, joined by underscores.
std::string picture_name(int step, const std::string& title) {
  std::string name = (step + 1 < 10 ? "0" : "") + std::to_string(step + 1) + "_";
  for (const unsigned char c : title) {
    if (std::isalnum(c))
      name += char(std::tolower(c));
    else if (name.back() != '_')
      name += '_';
  }
  while (name.back() == '_') name.pop_back();
  return name + ".png";
}

void print_step(const Lesson& lesson, int step, std::ostream& out) {
  out << "\n[" << step + 1 << "] " << lesson.step_title(step) << "\n";
  for (const auto& p : lesson.parameters())
    if (p.step == step && !p.drawn_only && p.kind != Parameter::Kind::point)
      out << "  " << p.name << " = " << value_text(p, p.get()) << "\n";
  out << lesson.numbers(step) << std::flush;
}

void run_headless(Lesson& lesson, int until, const std::string& folder) {
  std::unique_ptr<RasterCanvas> canvas;
  if (!folder.empty()) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) throw InputError(folder, "--out", error.message(), "a folder that can be written");
    canvas = std::make_unique<RasterCanvas>(Workbench::picture_width, Workbench::picture_height, 2);
  }
  std::cout << lesson.title() << "\n";
  for (int i = 0; i < until; ++i) {
    lesson.show(i);
    print_step(lesson, i, std::cout);
    if (!canvas) continue;
    canvas->clear();
    lesson.draw(*canvas);
    write_png((fs::path(folder) / picture_name(i, lesson.step_title(i))).string(),
              canvas->finish());
  }
}

int run_program(Lesson& lesson, int argc, char** argv) {
  const std::string program = fs::path(argv[0]).filename().string();
  CLI::App app{lesson.title() +
                   "\nWithout options: prints the numbers of every step. In the window: n or Right "
                   "next step, b or Left back, r reset, Escape quit.",
               program};
  std::vector<std::string> settings;
  std::string folder;
  int until = lesson.n_steps(), n_frames = 0;
  bool interactive = false, listing = false;
  app.add_option("--set", settings, "name=value of a parameter; any number of them")
      ->allow_extra_args(false);
  app.add_option("--out", folder, "folder for a picture of every step");
  app.add_option("--until", until, "stop after this step")->check(CLI::Range(1, lesson.n_steps()));
  app.add_flag("--list", listing, "list steps and parameters");
  app.add_flag("--interactive", interactive, "open a window");
  app.add_option("--frames", n_frames, "close the window after so many frames")
      ->check(CLI::NonNegativeNumber);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  for (const auto& assignment : settings) lesson.set(assignment);
  if (listing) {
    list(lesson, std::cout);
  } else if (interactive) {
    lesson.show(until == lesson.n_steps() ? 0 : until - 1);
    Workbench workbench(lesson);
    show_window(workbench, lesson.title(), n_frames);
    const std::string changed = lesson.settings();
    std::cout << "The same without the window: " << program << (changed.empty() ? "" : " ")
              << changed << " --until " << lesson.current() + 1 << "\n";
  } else {
    run_headless(lesson, until, folder);
  }
  return 0;
}

}  // namespace

int Lesson::run(int argc, char** argv) {
  try {
    return run_program(*this, argc, argv);
  } catch (const InputError& error) {
    std::cerr << argv[0] << ": " << error.what() << "\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << argv[0] << ": " << error.what() << "\n";
    return 1;
  }
}

}  // namespace sem
