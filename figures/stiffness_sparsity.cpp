// Which control points the stiffness matrix couples: few and many parts, two cutoffs, and the
// draft's single origin.
#include "figures/figure.h"
#include "figures/scene_model.h"

namespace sem::figures {
namespace {

struct Method {
  const char *title, *origins;
  double cutoff;
};
const Method methods[] = {{"shared origins, cutoff 0.6 m", "shared_parts", 0.6},
                          {"shared origins, cutoff 1.01 m", "shared_parts", 1.01},
                          {"one origin, cutoff 0.6 m", "one", 0.6}};
const int part_counts[] = {16, 48};

Data compute() {
  Data data;
  DataTable cases({"case", "parts", "unknowns", "nonzeros", "fill"});
  auto& runs = data.add("runs", {"case", "row", "first", "last"});
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 3; ++column) {
      const int number = 3 * row + column;
      const std::string n = std::to_string(part_counts[row]);
      const SceneModel beam(
          "cantilever",
          {"solids[0].shape.parts=[" + n + ",1," + n + ",1]", "solids[0].shape.upper=[16,1]",
           "probes=[]", "method.quadrature.rays=" + std::to_string(5 * part_counts[row]),
           "method.weights.cutoff=" + std::to_string(methods[column].cutoff),
           "method.origins=\"" + std::string(methods[column].origins) + "\""});
      const auto& body = beam.model->discretization;
      add_case(cases, runs, number, body.boundary.n_parts(), stiffness_pattern(body));
    }
  data.add("cases", cases.columns()) = cases;
  return data;
}

void draw(Plot& plot, const Data& data) {
  for (int row = 0; row < 2; ++row)
    for (int column = 0; column < 3; ++column) {
      const int number = 3 * row + column;
      const DataTable info = data["cases"].where("case", number);
      const auto entries = entries_of(data["runs"].where("case", number));
      const int n = int(info.value("unknowns")) / 2;
      Panel& panel = plot.panel(row, column);
      panel.equal = true;
      panel.pattern(n, n, entries);
      panel.title = row == 0 ? methods[column].title : "";
      panel.lines_below = {number_text(info.value("parts")) + " parts, " +
                           number_text(info.value("unknowns")) +
                           " unknowns: " + number_text(100 * info.value("fill"), 2) + " % filled"};
    }
}

}  // namespace

Figure stiffness_sparsity() {
  return {"stiffness_sparsity",
          "Control points that the stiffness matrix of a 16 x 1 bar couples, along its boundary: "
          "the band reaches some four cutoffs to each side, or a few parts where these are long; "
          "one origin couples everything",
          7,
          5.4,
          compute,
          draw};
}

}  // namespace sem::figures
