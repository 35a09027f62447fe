// The hard cases of sem_stability as a matrix: cases by dimension and formulation, coloured by verdict.
#include <algorithm>

#include "figures/figure.h"
#include "tests/hard_cases/case.h"

namespace sem::figures {
namespace {

using stability::Case;
using stability::Outcome;
using stability::Result;
using stability::Rule;

const std::vector<std::string> variants = {"2D projected", "2D condensed", "3D projected", "3D condensed"};
constexpr double none = 4;  // neither plays a part

double column_of(const std::string& variant) {
  const auto at = std::find(variants.begin(), variants.end(), variant);
  return at == variants.end() ? none : double(at - variants.begin());
}

// One table per case, "group: name".
Data compute() {
  std::vector<Case> cases = stability::all_cases();
  std::erase_if(cases, [](const Case& one) { return !one.fast; });
  std::vector<Result> results;
  stability::run_isolated(cases, 120, 2, [&](size_t, const Result& result, double) { results.push_back(result); });
  std::vector<std::string> names;
  for (const auto& one : cases)
    if (std::find(names.begin(), names.end(), one.group + ": " + one.name) == names.end())
      names.push_back(one.group + ": " + one.name);
  Data data;
  for (const auto& name : names) {
    auto& table = data.add(name, {"variant", "may_refuse", "outcome", "error_by_bound"});
    for (size_t k = 0; k < cases.size(); ++k)
      if (cases[k].group + ": " + cases[k].name == name)
        table.add({column_of(cases[k].variant), double(cases[k].rule == Rule::may_refuse), double(results[k].outcome),
                   results[k].error});
  }
  return data;
}

struct Verdict {
  std::string label;
  Color color;
};
const Verdict verdicts[] = {{"solved", colors::okabe_ito[2]},
                            {"refused with a reason (allowed)", colors::okabe_ito[6]},
                            {"failed", colors::okabe_ito[1]}};

int verdict(double outcome, double may_refuse) {
  if (outcome == double(Outcome::solved)) return 0;
  return outcome == double(Outcome::refused) && may_refuse > 0 ? 1 : 2;
}

std::vector<Vec<2>> cell(double column, double row) {
  const double x = column, y = -row, half = 0.44;
  return {{x - half, y - half}, {x + half, y - half}, {x + half, y + half}, {x - half, y + half}};
}

// Rows [begin, end) of all cases in one panel; a line of its own names their group.
void draw_rows(Panel& panel, const Data& data, size_t begin, size_t end, size_t n_rows) {
  panel.legend = LegendPlace::none;
  std::string group;
  double row = 0;
  std::vector<std::vector<Vec<2>>> cells[3];
  for (size_t k = begin; k < end; ++k) {
    const auto& [name, table] = data.tables()[k];
    const size_t colon = name.find(": ");
    if (name.substr(0, colon) != group) {
      group = name.substr(0, colon);
      panel.note({1.5, -row}, group);
      ++row;
    }
    panel.y.ticks.push_back({-row, name.substr(colon + 2)});
    for (int i = 0; i < table.n_rows(); ++i) {
      const double column = table["variant"][i] == none ? 0 : table["variant"][i];
      cells[verdict(table["outcome"][i], table["may_refuse"][i])].push_back(cell(column, row));
    }
    ++row;
  }
  for (int v = 0; v < 3; ++v) panel.area(cells[v], verdicts[v].color, verdicts[v].label);
  panel.x.ticks = {{0.5, "2D"}, {2.5, "3D"}};
  panel.x.lower = -0.6;
  panel.x.upper = 3.6;
  panel.y.lower = -double(n_rows) + 0.4;
  panel.y.upper = 0.6;
}

void draw(Plot& plot, const Data& data) {
  constexpr int n_columns = 3;
  plot.shared_legend = true;
  const size_t n = data.tables().size(), share = (n + n_columns - 1) / n_columns;
  for (int c = 0; c < n_columns; ++c)
    draw_rows(plot.panel(0, c), data, c * share, std::min(n, (c + 1) * share), share + 4);
}

}  // namespace

Figure stability_matrix() {
  return {"stability_matrix",
          "The fast ones among the hard cases (`sem_stability --fast`), each in a process of its own, against dimension and formulation (of two "
          "columns the left one projected, the right one condensed)",
          7,
          6.5,
          compute,
          draw,
          {"error_by_bound"}};
}

}  // namespace sem::figures
