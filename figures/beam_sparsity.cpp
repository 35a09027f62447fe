// Which control points the stiffness matrix couples in space, as a beam grows.
#include "figures/figure.h"
#include "figures/growing_beam.h"
#include "figures/scene_model.h"

namespace sem::figures {
namespace {

const int slices[] = {5, 10, 22};

void add_case(DataTable& cases, DataTable& runs, int number, const Discretization<3>& body) {
  const auto K = stiffness_pattern(body);
  const double unknowns = 3.0 * K.size();
  cases.add({double(number), double(body.boundary.n_parts()), unknowns, double(K.n_nonzeros()),
             K.n_nonzeros() / (unknowns * unknowns)});
  for (int i = 0; i < K.size(); ++i)
    for (int j = 0; j < K.size(); ++j) {
      if (!K.coupled(i, j)) continue;
      const int first = j;
      while (j + 1 < K.size() && K.coupled(i, j + 1)) ++j;
      runs.add({double(number), double(i), double(first), double(j)});
    }
}

Data compute() {
  Data data;
  DataTable cases({"case", "parts", "unknowns", "nonzeros", "fill"});
  // Runs of non-zero columns in the rows of the control points' matrix.
  auto& runs = data.add("runs", {"case", "row", "first", "last"});
  for (int number = 0; number < 3; ++number)
    add_case(cases, runs, number, growing_beam_of(slices[number])->model->discretization);
  data.add("cases", cases.columns()) = cases;
  return data;
}

void draw(Plot& plot, const Data& data) {
  for (int number = 0; number < 3; ++number) {
    const DataTable info = data["cases"].where("case", number);
    const DataTable runs = data["runs"].where("case", number);
    std::vector<std::pair<int, int>> entries;
    for (int k = 0; k < runs.n_rows(); ++k)
      for (int j = int(runs["first"][k]); j <= int(runs["last"][k]); ++j)
        entries.push_back({int(runs["row"][k]), j});
    const int n = int(info.value("unknowns")) / 3;
    Panel& panel = plot.panel(0, number);
    panel.equal = true;
    panel.pattern(n, n, entries);
    panel.title = number_text(info.value("parts")) + " parts";
    panel.lines_below = {number_text(info.value("unknowns"), 4) +
                         " unknowns: " + number_text(100 * info.value("fill"), 2) + " % filled"};
  }
}

}  // namespace

Figure beam_sparsity() {
  return {"beam_sparsity",
          "Control points that the stiffness matrix couples in space: a beam that grows (half a "
          "metre and four parts a slice), its ends first, then its four sides one after the other",
          7,
          2.75,
          compute,
          draw};
}

}  // namespace sem::figures
