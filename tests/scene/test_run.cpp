// Whole runs: their files, resuming, failing, and the error estimate.
#include <cmath>
#include <nlohmann/json.hpp>

#include "bodies.h"
#include "dims.h"
#include "errors.h"
#include "folder.h"
#include "sem/scene/estimate.h"
#include "sem/scene/info.h"
#include "sem/scene/read_scene.h"

using namespace sem;
using Json = nlohmann::json;

namespace {

// A box that swings from one face.
template <int Dim>
Scene<Dim> swing(MaterialModel model = MaterialModel::neo_log) {
  auto scene = test::box_scene<Dim>(model);
  scene.gravity[1] = -10;
  scene.pins.push_back(test::face_pin<Dim>(0));
  scene.probes.push_back({"corner", ProbeKind::displacement, Vec<Dim>::Ones(), 0});
  scene.probes.push_back({"inside", ProbeKind::stress, Vec<Dim>::Constant(0.4), 0});
  scene.probes.push_back({"held", ProbeKind::reaction, Vec<Dim>::Zero(), 0});
  scene.analysis.duration = 0.4;
  return scene;
}

template <int Dim>
RunResult run(const Scene<Dim>& scene, const test::Folder& folder, bool resume = false) {
  return run_scene<Dim>(scene, {"my.json", folder.path(), resume, {}}, {});
}

// Every number of the summary is one: JSON has no NaN, so that it would show as null.
void check_numbers(const Json& json) {
  for (const auto& [key, value] : json.items()) {
    CAPTURE(key);
    CHECK(!value.is_null());
    if (value.is_structured()) check_numbers(value);
  }
}

void check_files(const test::Folder& folder, const RunResult& result) {
  const Json summary = Json::parse(test::content(folder / "summary.json"));
  CHECK(summary == Json::parse(result.summary_json));
  for (const char* key :
       {"program", "status", "message", "sizes", "stages", "solver", "accuracy", "settings"})
    CHECK(summary.contains(key));
  if (result.ok) check_numbers(summary);
  const std::string history = test::content(folder / "history.csv");
  CHECK(history.size() > 20);
  CHECK(history.find("nan") == std::string::npos);
  CHECK(history.find("inf") == std::string::npos);
  CHECK(Json::parse(test::content(folder / "final_state.json"))["solids"].size() == 1);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    CHECK(entry.path().extension() != ".part");
}

long n_lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

}  // namespace

TEST_CASE_TEMPLATE("a dynamic run writes history, summary, final state and checkpoint", T, D2, D3) {
  constexpr int Dim = T::value;
  const auto scene = swing<Dim>();
  const test::Folder folder("run_dynamic" + std::to_string(Dim));
  const RunResult result = run(scene, folder);
  CHECK(result.ok);
  check_files(folder, result);
  CHECK(n_lines(test::content(folder / "history.csv")) == 1 + 1 + 40);
  const Json summary = Json::parse(result.summary_json);
  CHECK(summary["status"] == "converged");
  CHECK(summary["solver"]["steps"] == 40);
  CHECK(summary["accuracy"].contains("energy"));
  CHECK(!summary["accuracy"].contains("solution"));  // not asked for
  CHECK(summary["sizes"]["frames"] == 0);            // nobody drew any
  // The settings are the scene, to run it again.
  CHECK(write_scene(read_scene<Dim>(summary["settings"].dump(), "", {})) == write_scene(scene));
  // The final state is a scene's solids, to start from.
  const Json state = Json::parse(test::content(folder / "final_state.json"));
  CHECK(state["step"] == 40);
  CHECK_NOTHROW(read_scene<Dim>(Json{{"solids", state["solids"]}}.dump(), "", {}));
}

TEST_CASE_TEMPLATE("a resumed run ends in the files of an uninterrupted one, bit for bit", T, D2,
                   D3) {
  constexpr int Dim = T::value;
  for (const auto integrator :
       {Integrator::linearly_implicit_euler, Integrator::implicit_midpoint}) {
    auto scene = swing<Dim>();
    scene.analysis.integrator = integrator;
    const std::string id = std::to_string(Dim);
    const test::Folder whole("run_whole" + id), parts("run_parts" + id);
    run(scene, whole);
    auto first = scene;
    first.analysis.duration = 0.2;
    first.output.checkpoint_interval = 0.07;  // outputs do not matter
    first.method.n_threads = 2;
    run(first, parts);
    CHECK(test::content(parts / "history.csv") != test::content(whole / "history.csv"));
    const RunResult result = run(scene, parts, true);
    CHECK(result.ok);
    for (const char* file : {"history.csv", "final_state.json", "checkpoint.bin"}) {
      CAPTURE(file);
      CHECK(test::content(parts / file) == test::content(whole / file));
    }
    // A run that is done is done.
    run(scene, parts, true);
    CHECK(test::content(parts / "history.csv") == test::content(whole / "history.csv"));
  }
}

TEST_CASE("resuming needs a checkpoint of the same scene that is not yet past the end") {
  auto scene = swing<2>();
  const test::Folder folder("run_resume");
  const auto error = [&] { return test::error_of([&] { run(scene, folder, true); }); };
  test::check_names(error(), folder / "checkpoint.bin", {"no readable file"});
  run(scene, folder);
  const std::string history = test::content(folder / "history.csv");
  scene.analysis.duration = 0.1;
  test::check_names(error(), folder / "checkpoint.bin", {"step", "found 40", "at most the 10"});
  scene = swing<2>();
  scene.gravity[1] = -9;
  test::check_names(error(), folder / "checkpoint.bin", {"other settings"});
  scene = swing<2>();
  scene.analysis.kind = AnalysisKind::statics;
  test::check_names(error(), "my.json", {"--resume", "dynamic"});
  CHECK(test::content(folder / "history.csv") == history);
}

TEST_CASE_TEMPLATE("a run that cannot go on keeps the last good state and writes its files", T, D2,
                   D3) {
  constexpr int Dim = T::value;
  auto scene = swing<Dim>();
  scene.velocity[0] = -1e6;  // into the pinned face
  scene.analysis.time_step = 1;
  scene.analysis.duration = 3;
  scene.output.error_estimate = true;
  const test::Folder folder("run_fail" + std::to_string(Dim));
  const RunResult result = run(scene, folder);
  CHECK(!result.ok);
  CHECK(result.message.starts_with("stopped: "));
  CHECK(result.message.find("step 1") != std::string::npos);
  check_files(folder, result);
  const Json summary = Json::parse(result.summary_json);
  CHECK(summary["status"] != "converged");
  CHECK(!summary["accuracy"].contains("solution"));
  CHECK(n_lines(test::content(folder / "history.csv")) == 2);
  const auto& state = Json::parse(test::content(folder / "final_state.json"));
  CHECK(state["step"] == 0);
  CHECK(state["solids"] == Json::parse(write_scene(scene))["solids"]);
}

TEST_CASE_TEMPLATE("statics and modes write their files too", T, D2, D3) {
  constexpr int Dim = T::value;
  const test::Folder folder("run_others" + std::to_string(Dim));
  auto scene = swing<Dim>();
  scene.analysis.kind = AnalysisKind::statics;
  RunResult result = run(scene, folder);
  CHECK(result.ok);
  check_files(folder, result);
  CHECK(n_lines(test::content(folder / "history.csv")) == 2);
  scene.analysis.kind = AnalysisKind::modes;
  scene.analysis.n_modes = 3;
  result = run(scene, folder);
  CHECK(result.ok);
  check_files(folder, result);
  CHECK(n_lines(test::content(folder / "history.csv")) == 4);
  CHECK(test::content(folder / "history.csv")
            .starts_with("mode,omega_rad_s,frequency_Hz,residual\n1,"));
}

TEST_CASE_TEMPLATE("the probes come with an estimate of their error", T, D2, D3) {
  constexpr int Dim = T::value;
  auto scene = swing<Dim>(MaterialModel::linear);
  scene.analysis.duration = 0.05;
  scene.output.error_estimate = true;
  const test::Folder folder("run_estimate" + std::to_string(Dim));
  const RunResult result = run(scene, folder);
  check_files(folder, result);
  const Json solution = Json::parse(result.summary_json)["accuracy"]["solution"];
  constexpr size_t n_columns = Dim + Dim * (Dim + 1) / 2 + Dim;
  CHECK(solution["probes"].size() == n_columns);
  CHECK(solution["variations"].size() == 6);
  double largest = 0;
  for (const auto& probe : solution["probes"])
    largest = std::max(largest, probe["estimated_error"].get<double>());
  CHECK(largest > 0);
  for (const auto& variation : solution["variations"]) {
    CAPTURE(variation.dump());
    CHECK(!variation.contains("no_result"));
    CHECK(variation["largest_change"].size() == n_columns);
  }
  // The time step's share: the same run with half of it, by hand.
  auto half = scene;
  half.output.error_estimate = false;
  half.analysis.time_step /= 2;
  const ErrorEstimate estimate = estimate_error(scene, "");
  CHECK(estimate.variations.back().setting == "half the time step");
  const Json finer = Json::parse(run_scene<Dim>(half, {}, {}).summary_json);
  CHECK(finer["solver"]["steps"] == 10);
}

TEST_CASE("the estimate of modes judges the frequencies") {
  auto scene = test::box_scene<2>(MaterialModel::linear);
  scene.pins.push_back(test::face_pin<2>(0));
  scene.analysis.kind = AnalysisKind::modes;
  scene.analysis.n_modes = 2;
  const ErrorEstimate estimate = estimate_error(scene, "");
  CHECK(estimate.columns == std::vector<std::string>{"mode_1_rad_s", "mode_2_rad_s"});
  CHECK(estimate.variations.size() == 5);
}

TEST_CASE("frames belong to the first step at or after their time, also when resumed") {
  auto scene = swing<2>();
  scene.output.frame_rate = 30;
  const test::Folder folder("run_frames");
  std::vector<std::pair<long, int>> frames;
  const FrameCallback<2> record = [&](const Model<2>&, const State& state, int frame) {
    frames.push_back({state.step, frame});
  };
  scene.analysis.duration = 0.2;
  CHECK(run_scene<2>(scene, {"", folder.path(), false, {}}, record).n_frames == 7);
  scene.analysis.duration = 0.4;
  CHECK(run_scene<2>(scene, {"", folder.path(), true, {}}, record).n_frames == 13);
  const std::vector<std::pair<long, int>> expected = {{0, 0},   {4, 1},   {7, 2},  {10, 3}, {14, 4},
                                                      {17, 5},  {20, 6},  {24, 7}, {27, 8}, {30, 9},
                                                      {34, 10}, {37, 11}, {40, 12}};
  CHECK(frames == expected);
  frames.clear();
  scene.output.frame_rate = 1000;  // more than there are steps
  CHECK(run_scene<2>(scene, {}, record).n_frames == 41);
  frames.clear();
  scene.output.frame_rate = 0;
  CHECK(run_scene<2>(scene, {}, record).n_frames == 0);
  CHECK(frames.empty());
}

TEST_CASE("a scene that makes no model leaves no folder behind") {
  const test::Folder folder("run_invalid");
  auto scene = swing<2>();
  scene.probes[0].at = Vec<2>(5, 5);
  const std::string out = folder / "out";
  CHECK_THROWS_AS(run_scene<2>(scene, {"my.json", out, false, {}}, {}), InputError);
  CHECK(!std::filesystem::exists(out));
}

TEST_CASE_TEMPLATE("info is JSON for programs and lines for people", T, D2, D3) {
  constexpr int Dim = T::value;
  auto scene = swing<Dim>();
  scene.output.error_estimate = true;
  const auto model = build_model(scene, "");
  const Json info = Json::parse(model_info(scene, *model, true));
  check_numbers(info);
  CHECK(info["parts"] == 2 * Dim);
  CHECK(info["mass_kg"].get<double>() == doctest::Approx(100));
  const double error =
      info["accuracy"]["quadrature"]["relative_error"][DimTraits<Dim>::volume_name];
  CHECK(error < 1e-12);
  CHECK(info["settings"]["output"]["width"] == 800);  // a default
  CHECK(info["stages"]["rays"]["error"] == 0);
  CHECK(info["stages"]["interior map"]["error"].get<double>() < 1e-10);
  // 40 implicit steps, one factorisation each.
  CHECK(info["predicted"]["factorizations"] == 40);
  CHECK(info["predicted"]["analysis_seconds"].get<double>() > 0);
  const double predicted = info["predicted"]["relative_error_of_linear_response"];
  CHECK(predicted > 1e-6);
  scene.output.error_estimate = false;
  CHECK(Json::parse(model_info(scene, *model, true))["predicted"]["relative_error_of_linear_response"].is_string());
  const std::string text = model_info(scene, *model, false);
  for (const char* said : {"doubts:    none\n", "mass 100 kg", "(40 factorisations)", "  outward\n"}) {
    CAPTURE(said);
    CHECK(text.find(said) != std::string::npos);
  }
}
