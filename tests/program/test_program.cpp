// sem2d and sem3d as a user calls them: what they print, their files and their exit codes.
#include <doctest/doctest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "dims.h"
#include "folder.h"

using sem::test::content;
using sem::test::Folder;
using Json = nlohmann::json;
namespace fs = std::filesystem;

namespace {

// A program, with a scene of its own that runs at once.
template <int Dim>
struct Sem;
template <>
struct Sem<2> {
  static constexpr const char* path = SEM2D;
  static constexpr const char* name = "sem2d";
  static constexpr const char* scene = "square";
  static constexpr const char* misspelt = "sqare";
  static constexpr const char* probe = "free_corner_y_m = ";
  static constexpr const char* other_gravity = "gravity=[0,-5]";
  static constexpr const char* schema_word = "inner_radius: ";
  static constexpr int n_unknowns = 44;
  static constexpr const char* thrown = "initial.velocity=[-1e7,0]";
  static constexpr const char* open_part =
      R"({"degree": 1, "knots": [0, 0, 1, 1], "control_points": [[0, 0], [1, 0.3]]})";
  static constexpr bool draws = true;
};
template <>
struct Sem<3> {
  static constexpr const char* path = SEM3D;
  static constexpr const char* name = "sem3d";
  static constexpr const char* scene = "cube";
  static constexpr const char* misspelt = "cbe";
  static constexpr const char* probe = "free_corner_z_m = ";
  static constexpr const char* other_gravity = "gravity=[0,0,-5]";
  static constexpr const char* schema_word = "tube_radius: ";
  static constexpr int n_unknowns = 63;
  static constexpr const char* thrown = "initial.velocity=[-1e7,0,0]";
  static constexpr const char* open_part =
      R"({"degree_u": 1, "degree_v": 1, "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1],
    "control_points": [[0, 0, 0], [1, 0, 0.3], [0, 1, 0], [1, 1, 0]]})";
  static constexpr bool draws = true;
};

struct Outcome {
  int code;  // exit code, -1: ended by a signal
  std::string out, err;
};

// "@" stands for the program's scene, "%" for its name misspelt.
template <int Dim>
std::string named(std::string text) {
  for (size_t at; (at = text.find('@')) != std::string::npos;) text.replace(at, 1, Sem<Dim>::scene);
  for (size_t at; (at = text.find('%')) != std::string::npos;)
    text.replace(at, 1, Sem<Dim>::misspelt);
  return text;
}

// Calls the program in the folder.
template <int Dim>
Outcome call(const Folder& folder, const std::string& arguments) {
  const std::string out = folder / ".stdout", err = folder / ".stderr";
  const std::string command = "cd '" + folder.path() + "' && '" + Sem<Dim>::path + "' " +
                              named<Dim>(arguments) + " > '" + out + "' 2> '" + err + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content(out), content(err)};
}

long n_lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

// Exit code 2, nothing on standard output, one line that has all the pieces.
template <int Dim>
void check_rejected(const Folder& folder, const std::string& arguments,
                    const std::vector<std::string>& pieces) {
  CAPTURE(arguments);
  const Outcome outcome = call<Dim>(folder, arguments);
  CAPTURE(outcome.err);
  CHECK(outcome.code == 2);
  CHECK(outcome.out.empty());
  for (const auto& piece : pieces) {
    CAPTURE(piece);
    CHECK(outcome.err.find(named<Dim>(piece)) != std::string::npos);
  }
}

const std::string quick = " --set analysis.duration=0.1 --set output.error_estimate=false ";

}  // namespace

TEST_CASE_TEMPLATE("program without arguments says in a dozen lines what it can do", T, D2, D3) {
  constexpr int Dim = T::value;
  const Folder folder("program_overview");
  const Outcome outcome = call<Dim>(folder, "");
  CHECK(outcome.code == 0);
  CHECK(n_lines(outcome.out) <= 12);
  for (const char* word : {"run SCENE", "info SCENE", "scenes", "export NAME", "--set", "--resume"})
    CHECK(outcome.out.find(word) != std::string::npos);
}

TEST_CASE_TEMPLATE("program run writes frames, history, summary, final state and checkpoint", T, D2,
                   D3) {
  constexpr int Dim = T::value;
  const Folder folder("program_run");
  const Outcome outcome =
      call<Dim>(folder, "run @" + quick + "--set output.width=64 --set output.height=48 --out out");
  CAPTURE(outcome.err);
  CHECK(outcome.code == 0);
  CHECK(outcome.out.find("10 steps to t = 0.1 s") != std::string::npos);
  CHECK(outcome.out.find(Sem<Dim>::probe) != std::string::npos);
  CHECK(n_lines(content(folder / "out/history.csv")) == 1 + 11);
  const Json summary = Json::parse(content(folder / "out/summary.json"));
  CHECK(summary["status"] == "converged");
  CHECK(summary["sizes"]["unknowns"] == Sem<Dim>::n_unknowns);
  CHECK(fs::exists(folder / "out/final_state.json"));
  CHECK(fs::exists(folder / "out/checkpoint.bin"));
  CHECK(summary["sizes"]["frames"] == (Sem<Dim>::draws ? 4 : 0));  // at 0, 1/30, 2/30, 3/30 s
  CHECK((outcome.out.find("does not draw") == std::string::npos) == Sem<Dim>::draws);
}

TEST_CASE("sem2d run: frames are PNG files; a shorter run leaves none of a longer one") {
  const Folder folder("program_frames");
  CHECK(call<2>(folder, "run @" + quick + "--set output.width=64 --set output.height=48 --out out")
            .code == 0);
  for (const char* frame : {"frame_00000.png", "frame_00003.png"})
    CHECK(content(folder / "out/frames/" + frame).starts_with("\x89PNG"));
  CHECK(!fs::exists(folder / "out/frames/frame_00004.png"));
  CHECK(call<2>(folder,
                "run @ --out out --set analysis.duration=0.04 --set output.error_estimate=false")
            .code == 0);
  CHECK(fs::exists(folder / "out/frames/frame_00001.png"));
  CHECK(!fs::exists(folder / "out/frames/frame_00002.png"));
}

TEST_CASE_TEMPLATE("program run --no-frames draws nothing; the folder is out/SCENE by default", T,
                   D2, D3) {
  constexpr int Dim = T::value;
  const Folder folder("program_no_frames");
  CHECK(call<Dim>(folder, "run @ --no-frames" + quick).code == 0);
  CHECK(n_lines(content(folder / named<Dim>("out/@/history.csv"))) == 12);
  CHECK(!fs::exists(folder / named<Dim>("out/@/frames")));
  CHECK(Json::parse(content(folder / named<Dim>("out/@/summary.json")))["sizes"]["frames"] == 0);
}

TEST_CASE_TEMPLATE("program run: several overrides may follow one --set, in any place", T, D2, D3) {
  constexpr int Dim = T::value;
  const Folder folder("program_set");
  CHECK(call<Dim>(folder,
                  "run @ --no-frames --out out --set analysis.duration=0.1 "
                  "output.error_estimate=false")
            .code == 0);
  CHECK(n_lines(content(folder / "out/history.csv")) == 12);
  CHECK(call<Dim>(folder, "run --set analysis.duration=0.05 --out out --no-frames @").code == 0);
  CHECK(n_lines(content(folder / "out/history.csv")) == 7);
}

TEST_CASE_TEMPLATE("program run twice gives the same bits", T, D2, D3) {
  constexpr int Dim = T::value;
  const Folder folder("program_twice");
  CHECK(call<Dim>(folder, "run @ --no-frames --out a" + quick).code == 0);
  CHECK(call<Dim>(folder, "run @ --no-frames --out b --set method.threads=2" + quick).code == 0);
  for (const std::string file : {"history.csv", "final_state.json"})
    CHECK(content(folder / "a/" + file) == content(folder / "b/" + file));
}

TEST_CASE_TEMPLATE("program run --resume ends where a run without a break ends", T, D2, D3) {
  constexpr int Dim = T::value;
  const Folder folder("program_resume");
  const std::string common = " --no-frames --set output.error_estimate=false ";
  CHECK(call<Dim>(folder, "run @ --out whole --set analysis.duration=0.2" + common).code == 0);
  CHECK(call<Dim>(folder, "run @ --out parts --set analysis.duration=0.1" + common).code == 0);
  CHECK(call<Dim>(folder, "run @ --out parts --resume --set analysis.duration=0.2" + common).code ==
        0);
  for (const std::string file : {"history.csv", "final_state.json", "checkpoint.bin"})
    CHECK(content(folder / "whole/" + file) == content(folder / "parts/" + file));
  check_rejected<Dim>(
      folder, "run @ --out parts --resume --set " + std::string(Sem<Dim>::other_gravity) + common,
      {"parts/checkpoint.bin", "other settings"});
  check_rejected<Dim>(folder, "run @ --out none --resume" + common,
                      {"none/checkpoint.bin", "no readable file"});
  CHECK(!fs::exists(folder / "none"));
  sem::test::write(folder / "parts/checkpoint.bin",
                   content(folder / "whole/checkpoint.bin").substr(0, 500));
  check_rejected<Dim>(folder, "run @ --out parts --resume" + common,
                      {"parts/checkpoint.bin", "damaged"});
}

TEST_CASE_TEMPLATE("program export prints a scene that runs to the same history", T, D2, D3) {
  constexpr int Dim = T::value;
  const Folder folder("program_export");
  const Outcome exported = call<Dim>(folder, "export @");
  CHECK(exported.code == 0);
  fs::create_directory(folder / "my scenes");
  sem::test::write(folder / "my scenes/mine.json", exported.out);
  CHECK(call<Dim>(folder, "run 'my scenes/mine.json' --no-frames" + quick).code == 0);
  CHECK(call<Dim>(folder, "run @ --no-frames" + quick).code == 0);
  CHECK(content(folder / "out/mine/history.csv") ==
        content(folder / named<Dim>("out/@/history.csv")));
  check_rejected<Dim>(folder, "export %", {"NAME", "'%'", "'@' (did you mean that?)"});
}

TEST_CASE_TEMPLATE(
    "program scenes lists a line for each; each of the plane and the small one in space have info",
    T, D2, D3) {
  constexpr int Dim = T::value;
  const Folder folder("program_scenes");
  const Outcome scenes = call<Dim>(folder, "scenes");
  CHECK(scenes.code == 0);
  CHECK(("\n" + scenes.out).find(named<Dim>("\n@ ")) != std::string::npos);
  CHECK(n_lines(scenes.out) >= 7);
  std::istringstream lines(scenes.out);
  for (std::string line; std::getline(lines, line);) {
    CHECK(line.size() < 120);
    const std::string name = line.substr(0, line.find(' '));
    CAPTURE(name);
    if (Dim == 3 && name != Sem<Dim>::scene)
      continue;  // takes minutes for all; test_shapes reads them
    const Outcome info = call<Dim>(folder, "info " + name + " --json");
    CHECK(info.code == 0);
    const Json json = Json::parse(info.out);
    CHECK(json["name"] == name);
    CHECK(json["unknowns"] > 0);
    CHECK(json["settings"]["analysis"].contains("type"));
  }
}

TEST_CASE_TEMPLATE("program info for people, schema, version and help", T, D2, D3) {
  constexpr int Dim = T::value;
  const Folder folder("program_info");
  const Outcome info = call<Dim>(folder, "info @");
  CHECK(info.code == 0);
  CHECK(info.out.find("unknowns:  " + std::to_string(Sem<Dim>::n_unknowns) + ", ") !=
        std::string::npos);
  CHECK(info.out.find("predicted: analysis ") != std::string::npos);
  const Outcome schema = call<Dim>(folder, "schema");
  CHECK(schema.code == 0);
  for (const char* key : {"solids: ", "youngs_modulus: ", "shape: ", Sem<Dim>::schema_word, "Pa"})
    CHECK(schema.out.find(key) != std::string::npos);
  CHECK(call<Dim>(folder, "--version").out.starts_with(Sem<Dim>::name + std::string(" ")));
  CHECK(call<Dim>(folder, "--help").code == 0);
  CHECK(call<Dim>(folder, "run --help").code == 0);
  CHECK(!fs::exists(folder / "out"));
}

TEST_CASE_TEMPLATE("program: bad calls and bad input exit with 2 and leave no files", T, D2, D3) {
  constexpr int Dim = T::value;
  const Folder folder("program_bad");
  check_rejected<Dim>(folder, "walk", {"COMMAND", "'walk'"});
  check_rejected<Dim>(folder, "inof @", {"COMMAND", "'inof'", "run, info"});
  check_rejected<Dim>(folder, "run", {"SCENE"});
  check_rejected<Dim>(folder, "run @ --fast", {"--fast"});
  check_rejected<Dim>(folder, "run %", {"SCENE", "'%'", "'@' (did you mean that?)"});
  check_rejected<Dim>(folder, "run no/such/scene.json", {"'no/such/scene.json'", "a JSON file"});
  check_rejected<Dim>(folder, "run .", {"'.'"});
  check_rejected<Dim>(folder, "run ''", {"''"});
  check_rejected<Dim>(folder, "run " + std::string(5000, 'x'), {"neither a file nor"});
  check_rejected<Dim>(folder, "run @ nonsense", {"OVERRIDES", "nonsense", "key=value"});
  check_rejected<Dim>(folder, "run @ --set analysis.time_step=0",
                      {"@", "analysis.time_step", "found 0"});
  check_rejected<Dim>(folder, "run @ --set solids[0].material.poisson_ratio=0.5",
                      {"poisson_ratio", "0.5"});
  check_rejected<Dim>(folder, "run @ --set output.width=0",
                      {"output.width", "found 0", "16 to 8192"});
  check_rejected<Dim>(folder,
                      "run @ --set method.quadrature.rays=100000 method.quadrature.points=10000",
                      {"at most 1e+07"});
  check_rejected<Dim>(folder, "run @ --set pins=[{}]", {"pins", "leave something free"});
  check_rejected<Dim>(folder, "info @ --set gravty=[0,0]",
                      {"gravty", "'gravity' (did you mean that?)"});
  sem::test::write(folder / "broken.json", "{ \"solids\": [ }");
  check_rejected<Dim>(folder, "run broken.json", {"broken.json", "line 1, column 15"});
  sem::test::write(folder / "open.json",
                   std::string(R"({"solids": [{"parts": [)") + Sem<Dim>::open_part + "]}]}");
  check_rejected<Dim>(folder, "run open.json", {"open.json", "no interior"});
  if (Dim == 2) {
    sem::test::write(folder / "part.step", "ISO-10303-21;");
    check_rejected<Dim>(folder, "run part.step", {"part.step", "a CAD file", "sem3d"});
  }
  sem::test::write(folder / "empty.json", "");
  check_rejected<Dim>(folder, "run empty.json", {"empty.json", "line 1"});
  CHECK(!fs::exists(folder / "out"));
}

TEST_CASE_TEMPLATE("program: an output folder that cannot be one", T, D2, D3) {
  constexpr int Dim = T::value;
  const Folder folder("program_out");
  sem::test::write(folder / "file", "x");
  check_rejected<Dim>(folder, "run @ --out file" + quick, {"--out", "'file'", "a writable folder"});
  check_rejected<Dim>(folder, "run @ --out file/sub" + quick, {"--out", "'file/sub'"});
  check_rejected<Dim>(folder, "run @ --out /proc/sem2d" + quick, {"--out", "'/proc/sem2d'"});
  CHECK(content(folder / "file") == "x");
  if (!Sem<Dim>::draws) return;
  fs::create_directory(folder / "taken");
  sem::test::write(folder / "taken/frames", "x");
  check_rejected<Dim>(folder, "run @ --out taken" + quick, {"taken/frames"});
}

TEST_CASE_TEMPLATE("program: names of scenes do not leave the output folder", T, D2, D3) {
  constexpr int Dim = T::value;
  const Folder folder("program_names");
  const std::string text = call<Dim>(folder, "export @").out;
  sem::test::write(folder / "a.b.json", text);
  CHECK(call<Dim>(folder, "run a.b.json --no-frames --set name=../../evil/\xFF" + quick).code == 0);
  CHECK(fs::exists(folder / "out/a.b/summary.json"));
  sem::test::write(folder / "\xE4.json", text);  // a file name that is no UTF-8
  CHECK(call<Dim>(folder, "run \xE4.json --no-frames --set name=" + quick).code == 0);
}

TEST_CASE_TEMPLATE("program: a run that fails exits with 1 and still writes its files", T, D2, D3) {
  constexpr int Dim = T::value;
  const Folder folder("program_fails");
  const Outcome outcome =
      call<Dim>(folder, "run @ --no-frames --out out --set " + std::string(Sem<Dim>::thrown) +
                            " analysis.time_step=1");
  CAPTURE(outcome.out);
  CHECK(outcome.code == 1);
  CHECK(outcome.out.find("stopped: ") != std::string::npos);
  CHECK(Json::parse(content(folder / "out/summary.json"))["status"] != "converged");
  CHECK(content(folder / "out/history.csv").find("nan") == std::string::npos);
}

TEST_CASE("sem3d: frames as CAD files run as scenes, have info, are exported, and give the same parts back") {
  const Folder folder("program_cad");
  const std::string quick_cad = " --no-frames --set analysis.duration=0.02 output.error_estimate=false output.frame_rate=50";
  const Outcome written = call<3>(folder, "run cube --cad step --out cube" + quick_cad);
  if (written.err.find("no OpenCASCADE") != std::string::npos) {
    CHECK(written.code == 2);
    return;
  }
  CHECK(written.code == 0);
  const std::string file = "cube/frames/frame_00001.step";
  REQUIRE(fs::exists(folder / file));
  CHECK(!fs::exists(folder / "cube/frames/frame_00002.step"));
  for (const auto& entry : fs::directory_iterator(folder / "cube/frames"))
    CHECK(entry.path().string().find(".part") == std::string::npos);
  const Outcome info = call<3>(folder, "info " + file + " --json --material jelly");
  CHECK(info.code == 0);
  const Json json = Json::parse(info.out);
  const Json cube = Json::parse(call<3>(folder, "info cube --json").out);
  CHECK(json["parts"] == cube["parts"]);
  CHECK(json["shells"][0]["closed"] == true);
  CHECK(json["boundary_area_m2"] == doctest::Approx(double(cube["boundary_area_m2"])).epsilon(0.1));
  CHECK(json["part_list"].size() == json["parts"]);
  CHECK(json["part_list"][0]["trim_loops"] == 0);
  CHECK(json["longest_gap_m"] < 0.01);  // parts of a deformed state need not meet exactly
  CHECK(json["settings"]["solids"][0]["material"]["youngs_modulus"] == 5e3);
  for (size_t i = 0; i < json["parts"]; ++i)
    CHECK(json["settings"]["solids"][0]["parts"][i]["name"] == cube["settings"]["solids"][0]["parts"][i]["name"]);
  // The scene that export prints runs to the same history as the file does.
  const Outcome exported = call<3>(folder, "export " + file + " --pin left");
  CHECK(exported.code == 0);
  sem::test::write(folder / "mine.json", exported.out);
  const Outcome bare = call<3>(folder, "run " + file + " --pin left" + quick_cad);
  CHECK(bare.out.find("--pin left") != std::string::npos);
  CHECK(bare.code == 0);
  CHECK(call<3>(folder, "run mine.json" + quick_cad).code == 0);
  CHECK(content(folder / "out/mine/history.csv") == content(folder / "out/frame_00001/history.csv"));

  // A checkpoint goes on with the file that it was made of and no other.
  const auto replace_model = [&](const std::string& frame) {
    fs::copy_file(folder / ("cube/frames/" + frame), folder / "model.step", fs::copy_options::overwrite_existing);
  };
  const std::string run_model = "run model.step --no-frames --set output.error_estimate=false analysis.duration=";
  replace_model("frame_00000.step");
  CHECK(call<3>(folder, run_model + "0.02").code == 0);
  CHECK(call<3>(folder, run_model + "0.03 --resume").code == 0);
  replace_model("frame_00001.step");
  const Outcome other = call<3>(folder, run_model + "0.04 --resume");
  CHECK(other.code == 2);
  CHECK(other.err.find("checkpoint.bin: settings: found a checkpoint of other settings") != std::string::npos);

  check_rejected<3>(folder, "run none.step", {"none.step", "no readable file"});
  check_rejected<3>(folder, "run cube --pin top", {"--pin", "the scene 'cube'", "only with a CAD file"});
  check_rejected<3>(folder, "info mine.json --material steel", {"--material", "'mine.json'"});
  check_rejected<3>(folder, "export cube --scale 2", {"--scale", "'cube'"});
  check_rejected<3>(folder, "run " + file + " --pin floor", {"--pin", "'floor'", "bottom"});
  check_rejected<3>(folder, "run " + file + " --material cheese", {"--material", "'cheese'", "jelly"});
  check_rejected<3>(folder, "run " + file + " --scale 0", {"--scale", "found 0"});
  check_rejected<3>(folder, "run " + file + " --scale two", {"--scale", "two"});
  check_rejected<3>(folder, "run cube --cad obj", {"--cad", "obj"});
  check_rejected<2>(folder, "run square --cad step", {"--cad"});
  check_rejected<2>(folder, "run none.step", {"SCENE", "'none.step'"});
}
