// A tutorial as a user calls it, headless.
#include <doctest/doctest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>

#include "folder.h"

using sem::test::content;
using sem::test::Folder;
namespace fs = std::filesystem;

namespace {

struct Outcome {
  int code;  // exit code, -1: ended by a signal
  std::string out, err;
};

/// Calls the tutorial in the folder; `before` precedes it on the command line.
Outcome call(const Folder& folder, const std::string& arguments, const std::string& before = "") {
  const std::string out = folder / ".stdout", err = folder / ".stderr";
  const std::string command = "cd '" + folder.path() + "' && " + before + " '" + SEM_TUTORIAL +
                              "' " + arguments + " > '" + out + "' 2> '" + err + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out), content(err)};
}

bool has(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

}  // namespace

TEST_CASE("a tutorial prints every step, or those up to --until") {
  const Folder folder("lesson_until");
  const Outcome all = call(folder, ""), two = call(folder, "--until 2");
  CHECK(all.code == 0);
  CHECK(two.code == 0);
  CHECK(has(all.out, "\n[3] "));
  CHECK(!has(two.out, "\n[3] "));
  CHECK(has(two.out, "\n[2] "));
  CHECK(all.out.substr(0, two.out.size()) == two.out);
  CHECK(all.err.empty());
}

TEST_CASE("--list names every step and parameter with its range, and runs nothing") {
  const Folder folder("lesson_list");
  const Outcome outcome = call(folder, "--list --set degree=2");
  CHECK(outcome.code == 0);
  for (const char* piece : {"\n1  The curve", "degree=2", "whole numbers from 1 to 5", "p7=3.4,2.2",
                            "u=0.35", "0 to 1"}) {
    CAPTURE(piece);
    CHECK(has(outcome.out, piece));
  }
}

TEST_CASE("--set changes the numbers, --out writes a picture of each step, the same ones twice") {
  const Folder folder("lesson_out");
  const Outcome one = call(folder, "--set degree=2 --set p4=2,1 --until 2 --out one");
  CHECK(one.code == 0);
  CHECK(has(one.out, "degree = 2"));
  CHECK(call(folder, "--until 2").out != one.out);
  CHECK(call(folder, "--set degree=2 --set p4=2,1 --until 2 --out two").out == one.out);
  int n = 0;
  for (const auto& file : fs::directory_iterator(folder / "one")) {
    const std::string name = file.path().filename();
    CHECK(name.substr(0, 3) ==
          "0" + std::string(name == "01_the_curve_and_its_control_points.png" ? "1_" : "2_"));
    CHECK(content(file.path()) == content(folder / ("two/" + name)));
    ++n;
  }
  CHECK(n == 2);
}

TEST_CASE("bad arguments end with exit code 2, one line, and nothing on standard output") {
  const Folder folder("lesson_errors");
  const auto rejected = [&](const std::string& arguments, const std::string& piece) {
    CAPTURE(arguments);
    const Outcome outcome = call(folder, arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(outcome.out.empty());
    CHECK(has(outcome.err, piece));
  };
  rejected("--set degre=3", "'degree' (did you mean that?)");
  rejected("--set degree=6", "whole numbers from 1 to 5");
  rejected("--set degree", "name=value");
  rejected("--until 0", "--until");
  rejected("--until 99", "--until");
  rejected("--steps", "--steps");
  rejected("more", "more");
  sem::test::write(folder / "file", "in the way");
  rejected("--out file", "--out");
#if !SEM_HAS_WINDOW
  rejected("--interactive", "built without a window");
#endif
}
