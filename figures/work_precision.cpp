// What accuracy costs in statics: the error of a displacement against the time of preparation and
// solution, for both formulations, for finite elements of our own and for those of another program.
#include <algorithm>
#include <cmath>

#include "figures/figure.h"
#include "figures/measured.h"
#include "figures/scene_model.h"
#include "sem/scene/files.h"
#include "src2d/baseline/finite_elements.h"
#include "sem/base/timing.h"

namespace sem::figures {
namespace {

// A quadrilateral clamped on the left. Its displacement is singular at the ends of the left side
// and, if the right one is loaded, of that, too.
struct Body {
  std::string title;
  baseline::Corners corners;  // m
  Material material;
  Vec<2> gravity, traction;  // m/s^2; Pa, on the right
  Vec<2> probe;              // m, whose u_y is compared
  double truth;              // m, independent graded finite elements of high degree
  double projected_cutoff, condensed_cutoff;  // m, both cover the body
  std::array<int, 2> cells;                   // of the coarsest mesh
  std::vector<int> parts;                     // along

  bool loaded() const { return traction.norm() > 0; }
};

const std::vector<Body>& bodies() {
  static const std::vector<Body> all = {
      {"Cantilever",
       {Vec<2>(0, 0), Vec<2>(4, 0), Vec<2>(4, 1), Vec<2>(0, 1)},
       {MaterialModel::neo_log, 1e5, 0.3, 10},
       {0, -10},
       {0, 0},
       {4, 0.5},
       -0.3684452,
       0.51,
       0.75,
       {8, 2},
       {1, 2, 4, 8}},
      {"Cook's membrane",
       {Vec<2>(0, 0), Vec<2>(48, 44), Vec<2>(48, 60), Vec<2>(0, 44)},
       {MaterialModel::neo_log, 240.565, 0.3, 0},
       {0, 0},
       {0, 20. / 16},
       {48, 60},
       1.840498,
       30,
       30,
       {4, 4},
       {1, 2, 4, 8}}};
  return all;
}

std::string text(const Vec<2>& v) { return "[" + exact_text(v[0]) + "," + exact_text(v[1]) + "]"; }

// The body as a scene: its parts are n pieces of each side, but one of a beam's ends.
std::vector<std::string> overrides(const Body& body, int n, int degree, double cutoff) {
  const int ends = body.loaded() ? n : 1;
  const int counts[] = {n, ends, n, ends};
  std::string vertices, pins, loads;
  int part = 0;
  for (int side = 0; side < 4; ++side)
    for (int k = 0; k < counts[side]; ++k) {
      const double s = double(k) / counts[side];
      const std::string name = "{\"part\":\"side" + std::to_string(++part) + "\"";
      vertices += text((1 - s) * body.corners[side] + s * body.corners[(side + 1) % 4]) + ",";
      if (side == 3) pins += name + "},";
      if (side == 1)
        loads += name + ",\"type\":\"boundary\",\"traction\":" + text(body.traction) + "},";
    }
  for (auto* list : {&vertices, &pins, &loads}) list->pop_back();
  return {"solids[0].shape={\"type\":\"polygon\",\"degree\":3,\"vertices\":[" + vertices + "]}",
          "solids[0].material.youngs_modulus=" + exact_text(body.material.youngs_modulus),
          "solids[0].material.density=" + exact_text(body.material.density),
          "gravity=" + text(body.gravity),
          "pins=[" + pins + "]",
          "loads=[" + loads + "]",
          "probes=[]",
          "analysis.load_steps=1",
          "method.degree=" + std::to_string(degree),
          "method.weights.cutoff=" + exact_text(cutoff),
          "method.threads=1"};
}

Measured run_scene(const Body& body, const std::string& scene,
                   const std::vector<std::string>& settings) {
  const double start = thread_seconds();
  const SceneModel model(scene, settings);
  const double prepared = thread_seconds();
  const auto state = model.equilibrium();
  const double solved = thread_seconds();
  return {double(model.model->n_unknowns()),
          state ? model.displacement(*state, body.probe)[1] : NAN, prepared - start,
          solved - prepared};
}

Measured run_triangles(const Body& body, int n, double grading) {
  baseline::Problem problem;
  problem.material = body.material;
  problem.gravity = body.gravity;
  problem.traction[baseline::right] = body.traction;
  const double start = thread_seconds();
  const auto mesh = baseline::quadrilateral_mesh(body.corners, n * body.cells[0], n * body.cells[1],
                                                 grading, body.loaded());
  const double meshed = thread_seconds() - start;
  const auto solution = solve_static(mesh, problem);
  int probe;
  (mesh.nodes.colwise() - body.probe).colwise().norm().minCoeff(&probe);
  return {double(solution.n_unknowns), solution.converged ? solution.displacement(1, probe) : NAN,
          meshed + solution.preparation_seconds, solution.solve_seconds};
}

// The curves; the condensed ones are of degree 2, 3, 4.
enum Method {
  projected,
  condensed_2,
  condensed_3,
  condensed_4,
  triangles,
  graded_triangles,
  n_methods
};
constexpr double graded = 2;  // exponent of the triangles' grading towards singular ends

Measured run(const Body& body, int method, int n) {
  if (method == triangles) return run_triangles(body, n, 1);
  if (method == graded_triangles) return run_triangles(body, n, graded);
  if (method == projected)
    return run_scene(body, "cantilever", overrides(body, n, 2, body.projected_cutoff));
  return run_scene(body, "cantilever_condensed",
                   overrides(body, n, 2 + method - condensed_2, body.condensed_cutoff));
}

// A row per run, and the first run of each curve that reaches an error.
void measure(Data& data) {
  const std::vector<double> goals = {1e-2, 1e-3, 3e-4, 1e-4};
  DataTable runs(
      {"body", "method", "size", "unknowns", "uy", "preparation_seconds", "solution_seconds"});
  DataTable reached({"body", "method", "goal", "unknowns", "total_seconds"});
  for (int b = 0; b < 2; ++b)
    for (int method = 0; method < n_methods; ++method) {
      const Body& body = bodies()[b];
      std::size_t n_reached = 0;
      for (const int n : method < triangles ? body.parts : std::vector{1, 2, 4, 8}) {
        const Measured m = fastest([&] { return run(body, method, n); });
        runs.add(
            {double(b), double(method), double(n), m.unknowns, m.value, m.preparation, m.solution});
        for (; n_reached < goals.size() && std::abs(m.value / body.truth - 1) <= goals[n_reached];
             ++n_reached)
          reached.add({double(b), double(method), goals[n_reached], m.unknowns, m.seconds()});
      }
    }
  data.add("runs", runs.columns()) = runs;
  data.add("reached", reached.columns()) = reached;
}

Data compute() {
  Data data;
  measure(data);
  // Given from elsewhere: DOLFINx, one thread of another machine: quadratic triangles, graded
  // quartic quadrilaterals.
  auto& peers =
      data.add("peers", {"body", "quartic", "unknowns", "relative_error", "given_seconds"});
  peers.add({0, 0, 594, 4e-3, 0.006});
  peers.add({0, 0, 2210, 1.5e-3, 0.019});
  peers.add({0, 0, 8514, 5.6e-4, 0.077});
  peers.add({0, 1, 1050, 3.4e-5, 0.016});
  peers.add({1, 0, 578, 0.016, 0.007});
  peers.add({1, 0, 8450, 3e-3, 0.082});
  peers.add({1, 1, 1250, 3.5e-4, 0.021});
  return data;
}

Series style_of(int method) {
  struct Style {
    const char* label;
    Color color;
    MarkerShape marker;
  };
  using namespace colors;
  using enum MarkerShape;
  const Style styles[] = {{"projected (the paper's), n = 2", gray, circle},
                          {"condensed, n = 2", okabe_ito[5], square},
                          {"condensed, n = 3", okabe_ito[0], triangle},
                          {"condensed, n = 4", okabe_ito[2], diamond},
                          {"quadratic triangles", okabe_ito[1], square},
                          {"quadratic triangles, graded", okabe_ito[1], square}};
  const bool dashed = method == graded_triangles;
  return {.label = styles[method].label,
          .color = styles[method].color,
          .dash = dashed ? std::vector<double>{4, 2} : std::vector<double>{},
          .marker = styles[method].marker};
}

void draw_body(Panel& panel, const Data& data, int b) {
  for (int method = 0; method < n_methods; ++method) {
    const DataTable line = data["runs"].where("body", b).where("method", method);
    std::vector<double> seconds, error;
    for (int k = 0; k < line.n_rows(); ++k) {
      seconds.push_back(line.value("preparation_seconds", k) + line.value("solution_seconds", k));
      error.push_back(std::abs(line.value("uy", k) / bodies()[b].truth - 1));
    }
    panel.curve(seconds, error, style_of(method));
  }
  const char* const labels[] = {"DOLFINx, quadratic triangles", "DOLFINx, quartic, graded"};
  for (const int quartic : {0, 1}) {
    const DataTable given = data["peers"].where("body", b).where("quartic", quartic);
    panel.curve(given["given_seconds"], given["relative_error"],
                {.label = labels[quartic],
                 .width = 0,
                 .marker = quartic ? MarkerShape::plus : MarkerShape::cross,
                 .marker_size = 6});
  }
}

void draw(Plot& plot, const Data& data) {
  plot.shared_legend = true;
  for (int b = 0; b < 2; ++b) {
    Panel& panel = plot.panel(0, b);
    panel.title = bodies()[b].title;
    panel.x = {.label = "time of one thread (s)", .lower = 1e-4, .upper = 5, .logarithmic = true};
    panel.y = {.label = b == 0 ? "relative error of the tip" : "",
               .lower = 1e-6,
               .upper = 5,
               .logarithmic = true,
               .tick_labels = b == 0};
    draw_body(panel, data, b);
  }
}

}  // namespace

Figure work_precision() {
  return {
      "work_precision",
      "Statics, error against time of preparation and solution: the paper's formulation does not "
      "converge; the condensed one does: plain quadratic triangles are overtaken at errors of 1e-3, graded "
      "ones at 1e-4. Black: given from another machine, for comparison",
      7,
      3.6,
      compute,
      draw};
}

}  // namespace sem::figures
