// sem2d as a user calls it: what it prints, its files and its exit codes.
#include <doctest/doctest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "folder.h"

using sem::test::content;
using sem::test::Folder;
using Json = nlohmann::json;
namespace fs = std::filesystem;

namespace {

struct Outcome {
  int code;  // exit code, -1: ended by a signal
  std::string out, err;
};

// Calls sem2d in the folder.
Outcome call(const Folder& folder, const std::string& arguments) {
  const std::string out = folder / ".stdout", err = folder / ".stderr";
  const std::string command = "cd '" + folder.path() + "' && '" + SEM2D + "' " + arguments +
                              " > '" + out + "' 2> '" + err + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out), content(err)};
}

long n_lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

// Exit code 2, nothing on standard output, one line that has all the pieces.
void check_rejected(const Folder& folder, const std::string& arguments,
                    const std::vector<std::string>& pieces) {
  CAPTURE(arguments);
  const Outcome outcome = call(folder, arguments);
  CAPTURE(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.out.empty());
  for (const auto& piece : pieces) {
    CAPTURE(piece);
    CHECK(outcome.err.find(piece) != std::string::npos);
  }
}

const std::string quick = " --set analysis.duration=0.1 --set output.error_estimate=false ";

}  // namespace

TEST_CASE("sem2d without arguments says in a dozen lines what it can do") {
  const Folder folder("program_overview");
  const Outcome outcome = call(folder, "");
  CHECK(outcome.code == 0);
  CHECK(n_lines(outcome.out) <= 12);
  for (const char* word : {"run SCENE", "info SCENE", "scenes", "export NAME", "--set", "--resume"})
    CHECK(outcome.out.find(word) != std::string::npos);
}

TEST_CASE("sem2d run writes frames, history, summary, final state and checkpoint") {
  const Folder folder("program_run");
  const Outcome outcome =
      call(folder, "run square" + quick + "--set output.width=64 --set output.height=48 --out out");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(outcome.out.find("10 steps to t = 0.1 s") != std::string::npos);
  CHECK(outcome.out.find("free_corner_y_m = ") != std::string::npos);
  CHECK(n_lines(content(folder / "out/history.csv")) == 1 + 11);
  const Json summary = Json::parse(content(folder / "out/summary.json"));
  CHECK(summary["status"] == "converged");
  CHECK(summary["sizes"]["unknowns"] == 44);
  CHECK(summary["sizes"]["frames"] == 4);  // at 0, 1/30, 2/30, 3/30 s
  CHECK(fs::exists(folder / "out/final_state.json"));
  CHECK(fs::exists(folder / "out/checkpoint.bin"));
  for (const char* frame : {"frame_00000.png", "frame_00003.png"})
    CHECK(content(folder / "out/frames/" + frame).starts_with("\x89PNG"));
  CHECK(!fs::exists(folder / "out/frames/frame_00004.png"));
  // A shorter run into the same folder leaves no frame of the longer one.
  CHECK(call(folder,
             "run square --out out --set analysis.duration=0.04 --set output.error_estimate=false")
            .code == 0);
  CHECK(fs::exists(folder / "out/frames/frame_00001.png"));
  CHECK(!fs::exists(folder / "out/frames/frame_00002.png"));
}

TEST_CASE("sem2d run --no-frames draws nothing; the folder is out/SCENE by default") {
  const Folder folder("program_no_frames");
  CHECK(call(folder, "run square --no-frames" + quick).code == 0);
  CHECK(n_lines(content(folder / "out/square/history.csv")) == 12);
  CHECK(!fs::exists(folder / "out/square/frames"));
  CHECK(Json::parse(content(folder / "out/square/summary.json"))["sizes"]["frames"] == 0);
}

TEST_CASE("sem2d run: several overrides may follow one --set, in any place") {
  const Folder folder("program_set");
  CHECK(call(folder,
             "run square --no-frames --out out --set analysis.duration=0.1 "
             "output.error_estimate=false")
            .code == 0);
  CHECK(n_lines(content(folder / "out/history.csv")) == 12);
  CHECK(call(folder, "run --set analysis.duration=0.05 --out out --no-frames square").code == 0);
  CHECK(n_lines(content(folder / "out/history.csv")) == 7);
}

TEST_CASE("sem2d run twice gives the same bits") {
  const Folder folder("program_twice");
  CHECK(call(folder, "run square --no-frames --out a" + quick).code == 0);
  CHECK(call(folder, "run square --no-frames --out b --set method.threads=2" + quick).code == 0);
  for (const std::string file : {"history.csv", "final_state.json"})
    CHECK(content(folder / "a/" + file) == content(folder / "b/" + file));
}

TEST_CASE("sem2d run --resume ends where a run without a break ends") {
  const Folder folder("program_resume");
  const std::string common = " --no-frames --set output.error_estimate=false ";
  CHECK(call(folder, "run square --out whole --set analysis.duration=0.2" + common).code == 0);
  CHECK(call(folder, "run square --out parts --set analysis.duration=0.1" + common).code == 0);
  CHECK(call(folder, "run square --out parts --resume --set analysis.duration=0.2" + common).code ==
        0);
  for (const std::string file : {"history.csv", "final_state.json", "checkpoint.bin"})
    CHECK(content(folder / "whole/" + file) == content(folder / "parts/" + file));
  check_rejected(folder, "run square --out parts --resume --set gravity=[0,-5]" + common,
                 {"parts/checkpoint.bin", "other settings"});
  check_rejected(folder, "run square --out none --resume" + common,
                 {"none/checkpoint.bin", "no readable file"});
  sem::test::write(folder / "parts/checkpoint.bin",
                   content(folder / "whole/checkpoint.bin").substr(0, 500));
  check_rejected(folder, "run square --out parts --resume" + common,
                 {"parts/checkpoint.bin", "damaged"});
}

TEST_CASE("sem2d export prints a scene that runs to the same history") {
  const Folder folder("program_export");
  const Outcome exported = call(folder, "export square");
  CHECK(exported.code == 0);
  fs::create_directory(folder / "my scenes");
  sem::test::write(folder / "my scenes/mine.json", exported.out);
  CHECK(call(folder, "run 'my scenes/mine.json' --no-frames" + quick).code == 0);
  CHECK(call(folder, "run square --no-frames" + quick).code == 0);
  CHECK(content(folder / "out/mine/history.csv") == content(folder / "out/square/history.csv"));
  check_rejected(folder, "export sqare", {"NAME", "'sqare'", "'square' (did you mean that?)"});
}

TEST_CASE("sem2d scenes lists a line for each; each has info") {
  const Folder folder("program_scenes");
  const Outcome scenes = call(folder, "scenes");
  CHECK(scenes.code == 0);
  CHECK(("\n" + scenes.out).find("\nsquare ") != std::string::npos);
  CHECK(n_lines(scenes.out) >= 9);
  std::istringstream lines(scenes.out);
  for (std::string line; std::getline(lines, line);) {
    CHECK(line.size() < 120);
    const std::string name = line.substr(0, line.find(' '));
    CAPTURE(name);
    const Outcome info = call(folder, "info " + name + " --json");
    CHECK(info.code == 0);
    const Json json = Json::parse(info.out);
    CHECK(json["name"] == name);
    CHECK(json["unknowns"] > 0);
    CHECK(json["settings"]["analysis"].contains("type"));
  }
}

TEST_CASE("sem2d info for people, schema, version and help") {
  const Folder folder("program_info");
  const Outcome info = call(folder, "info square");
  CHECK(info.code == 0);
  CHECK(info.out.find("unknowns: 44\n") != std::string::npos);
  CHECK(info.out.find("checkpoint_interval: ") != std::string::npos);  // a default
  const Outcome schema = call(folder, "schema");
  CHECK(schema.code == 0);
  for (const char* key : {"solids: ", "youngs_modulus: ", "shape: ", "inner_radius: ", "Pa"})
    CHECK(schema.out.find(key) != std::string::npos);
  CHECK(call(folder, "--version").out.starts_with("sem2d "));
  CHECK(call(folder, "--help").code == 0);
  CHECK(call(folder, "run --help").code == 0);
  CHECK(!fs::exists(folder / "out"));
}

TEST_CASE("sem2d: bad calls and bad input exit with 2 and leave no files") {
  const Folder folder("program_bad");
  check_rejected(folder, "walk", {"COMMAND", "'walk'"});
  check_rejected(folder, "inof square", {"COMMAND", "'inof'", "run, info"});
  check_rejected(folder, "run", {"SCENE"});
  check_rejected(folder, "run square --fast", {"--fast"});
  check_rejected(folder, "run sqare", {"SCENE", "'sqare'", "'square' (did you mean that?)"});
  check_rejected(folder, "run no/such/scene.json", {"'no/such/scene.json'", "a JSON file"});
  check_rejected(folder, "run .", {"'.'"});
  check_rejected(folder, "run ''", {"''"});
  check_rejected(folder, "run " + std::string(5000, 'x'), {"neither a file nor"});
  check_rejected(folder, "run square nonsense", {"--set", "nonsense", "key=value"});
  check_rejected(folder, "run square --set analysis.time_step=0",
                 {"square", "analysis.time_step", "found 0"});
  check_rejected(folder, "run square --set solids[0].material.poisson_ratio=0.5",
                 {"poisson_ratio", "0.5"});
  check_rejected(folder, "run square --set output.width=0",
                 {"output.width", "found 0", "16 to 8192"});
  check_rejected(folder,
                 "run square --set method.quadrature.rays=100000 method.quadrature.points=10000",
                 {"at most 1e+07"});
  check_rejected(folder, "run square --set pins=[{}]", {"pins", "leave something free"});
  check_rejected(folder, "info square --set gravty=[0,0]",
                 {"gravty", "'gravity' (did you mean that?)"});
  sem::test::write(folder / "broken.json", "{ \"solids\": [ }");
  check_rejected(folder, "run broken.json", {"broken.json", "line 1, column 15"});
  sem::test::write(folder / "open.json", R"({"solids": [{"parts": [
    {"degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0], [1, 0.3]]}]}]})");
  check_rejected(folder, "run open.json", {"open.json", "no interior"});
  sem::test::write(folder / "empty.json", "");
  check_rejected(folder, "run empty.json", {"empty.json", "line 1"});
  CHECK(!fs::exists(folder / "out"));
}

TEST_CASE("sem2d: an output folder that cannot be one") {
  const Folder folder("program_out");
  sem::test::write(folder / "file", "x");
  check_rejected(folder, "run square --out file" + quick, {"--out", "'file'", "a writable folder"});
  check_rejected(folder, "run square --out file/sub" + quick, {"--out", "'file/sub'"});
  check_rejected(folder, "run square --out /proc/sem2d" + quick, {"--out", "'/proc/sem2d'"});
  CHECK(content(folder / "file") == "x");
  fs::create_directory(folder / "taken");
  sem::test::write(folder / "taken/frames", "x");
  check_rejected(folder, "run square --out taken" + quick, {"taken/frames"});
}

TEST_CASE("sem2d: names of scenes do not leave the output folder") {
  const Folder folder("program_names");
  const std::string text = call(folder, "export square").out;
  sem::test::write(folder / "a.b.json", text);
  CHECK(call(folder, "run a.b.json --no-frames --set name=../../evil/\xFF" + quick).code == 0);
  CHECK(fs::exists(folder / "out/a.b/summary.json"));
  sem::test::write(folder / "\xE4.json", text);  // a file name that is no UTF-8
  CHECK(call(folder, "run \xE4.json --no-frames --set name=" + quick).code == 0);
}

TEST_CASE("sem2d: a run that fails exits with 1 and still writes its files") {
  const Folder folder("program_fails");
  const Outcome outcome =
      call(folder,
           "run square --no-frames --out out --set initial.velocity=[-1e7,0] analysis.time_step=1");
  CAPTURE(outcome.out);
  CHECK(outcome.code == 1);
  CHECK(outcome.out.find("stopped: ") != std::string::npos);
  CHECK(Json::parse(content(folder / "out/summary.json"))["status"] != "converged");
  CHECK(content(folder / "out/history.csv").find("nan") == std::string::npos);
}
