// Origin candidates and the parts' choice among them as a network, beside the body.
#include <algorithm>
#include <cmath>
#include <map>

#include "figures/blob.h"
#include "figures/interior.h"

namespace sem::figures {
namespace {

// The reference's square with two straight parts a side: few enough to read.
const std::string scene = "square", parts = "solids[0].shape.parts=[2,2,2,2]";
constexpr double shared_weight =
    1e-4;  // a part belongs to a point's set above this weight (origins.h)

using Set = std::vector<int>;

// The set of parts with a share in a point; a row of w.
Set set_of(const Eigen::RowVectorXd& w) {
  Set set;
  for (int i = 0; i < w.size(); ++i)
    if (w[i] > shared_weight) set.push_back(i);
  return set;
}

// Candidates with the score of each of their parts: sum of v_k w_i over the points of the set.
std::map<Set, std::map<int, double>> scores(const Discretization<2>& body) {
  std::map<Set, std::map<int, double>> result;
  const Eigen::MatrixXd w =
      weight_field(body, body.quadrature.position, body.options.weights.variant);
  for (int k = 0; k < w.rows(); ++k) {
    const Set set = set_of(w.row(k));
    if (set.size() < 2) continue;
    for (const int i : set) result[set][i] += body.quadrature.weight[k] * w(k, i);
  }
  return result;
}

Data compute() {
  const auto body = builtin_body(scene, {parts});
  const auto candidates = scores(body);
  Data data;
  add_curves(data, body.boundary, 1);
  // Every candidate by the parts in it; chosen: the library's answer for that part.
  auto& edges = data.add("edges", {"candidate", "part", "score", "chosen"});
  std::vector<Set> sets;
  for (const auto& [set, score] : candidates) {
    for (const auto& [part, value] : score)
      edges.add({double(sets.size()), double(part), value,
                 double(body.origins.members[body.origins.of_part[part]] == set)});
    sets.push_back(set);
  }
  auto& origins = data.add("origins", {"candidate", "x", "y"});
  for (size_t o = 0; o < body.origins.members.size(); ++o) {
    const auto at = std::find(sets.begin(), sets.end(), body.origins.members[o]);
    origins.add(
        {double(at - sets.begin()), body.origins.position(0, o), body.origins.position(1, o)});
  }
  const Points<2> cells = cells_inside(body, 150);
  const Eigen::MatrixXd w = weight_field(body, cells, body.options.weights.variant);
  auto& regions = data.add("cells", {"x", "y", "candidate"});
  for (int k = 0; k < cells.cols(); ++k) {
    const auto at = std::find(sets.begin(), sets.end(), set_of(w.row(k)));
    regions.add({cells(0, k), cells(1, k), at == sets.end() ? -1 : double(at - sets.begin())});
  }
  return data;
}

// Colours of candidates: those that parts take, then grays.
constexpr int n_colors = 4, n_grays = 3;
constexpr Color palette[n_colors + n_grays] = {
    colors::okabe_ito[5], colors::okabe_ito[4], colors::okabe_ito[3], {0.45, 0.8, 0.65},
    {0.93, 0.93, 0.93},   {0.86, 0.86, 0.86},   {0.79, 0.79, 0.79}};
Color palette_color(double t) { return palette[std::lround(t * (std::size(palette) - 1))]; }

// What the figure shows of a candidate.
struct Candidate {
  int shade = 0;     // of the palette
  double order = 0;  // mean of its parts' numbers
  std::string name, text;
  bool chosen = false;
};

std::vector<Candidate> candidates_of(const DataTable& edges) {
  std::vector<Candidate> list;
  int n_chosen = 0, n_other = 0;
  for (const auto& set : edges.runs("candidate")) {
    Candidate candidate;
    candidate.name = std::string(1, char('A' + list.size()));
    for (int e = 0; e < set.n_rows(); ++e) {
      candidate.order += set["part"][e] / set.n_rows();
      candidate.text += (e > 0 ? ", " : "{") + number_text(set["part"][e] + 1);
      candidate.chosen = candidate.chosen || set["chosen"][e] > 0;
    }
    candidate.text += "}";
    candidate.shade = candidate.chosen ? n_chosen++ % n_colors : n_colors + n_other++ % n_grays;
    list.push_back(candidate);
  }
  return list;
}

// The part's colour: that of the candidate it takes.
Color color_of_part(const DataTable& edges, const std::vector<Candidate>& candidates, int part) {
  for (int e = 0; e < edges.n_rows(); ++e)
    if (edges["part"][e] == part && edges["chosen"][e] > 0)
      return palette[candidates[int(edges["candidate"][e])].shade];
  return colors::light_gray;
}

void draw_body(Panel& panel, const Data& data, const std::vector<Candidate>& candidates) {
  panel.equal = true;
  panel.frame = false;
  panel.title = "quadrature points by their set of parts";
  const DataTable &cells = data["cells"], &edges = data["edges"], &origins = data["origins"];
  std::vector<double> shade;
  for (const double c : cells["candidate"]) shade.push_back(c < 0 ? NAN : candidates[int(c)].shade);
  panel.heat_map(grid_of(cells["x"], cells["y"], shade),
                 {0, std::size(palette) - 1.0, palette_color});
  for (size_t c = 0; c < candidates.size(); ++c) {
    const DataTable region = cells.where("candidate", double(c));
    if (region.n_rows() == 0) continue;
    Vec<2> middle = Vec<2>::Zero();
    for (int k = 0; k < region.n_rows(); ++k)
      middle += Vec<2>(region["x"][k], region["y"][k]) / region.n_rows();
    // The origin of a chosen one is marked there too.
    panel.note(middle, candidates[c].name, {.offset = {0, candidates[c].chosen ? 6.0 : 0.0}});
  }
  for (const auto& part : data["curves"].runs("part")) {
    const int i = int(part.value("part"));
    panel.curve(part["x"], part["y"], {.color = color_of_part(edges, candidates, i), .width = 3});
    const Vec<2> a(part["x"].front(), part["y"].front()), b(part["x"].back(), part["y"].back());
    panel.node((a + b) / 2, std::to_string(i + 1), 11, color_of_part(edges, candidates, i));
  }
  panel.curve(origins["x"], origins["y"],
              {.width = 0, .marker = MarkerShape::cross, .marker_size = 6});
}

void draw_network(Panel& panel, const Data& data, const std::vector<Candidate>& candidates) {
  panel.frame = false;
  panel.title = "parts and candidates";
  const DataTable& edges = data["edges"];
  int n_parts = 0;
  double largest = 0;
  for (int e = 0; e < edges.n_rows(); ++e) {
    n_parts = std::max(n_parts, int(edges["part"][e]) + 1);
    largest = std::max(largest, edges["score"][e]);
  }
  // Candidates from the top by the mean of their parts, so that few lines cross.
  std::vector<int> rank(candidates.size());
  for (size_t c = 0; c < candidates.size(); ++c)
    for (size_t other = 0; other < candidates.size(); ++other)
      rank[c] += std::pair(candidates[other].order, other) < std::pair(candidates[c].order, c);
  const auto part_place = [&](int i) { return Vec<2>(0, 1 - (i + 0.5) / n_parts); };
  const auto candidate_place = [&](int c) {
    return Vec<2>(1, 1 - (rank[c] + 0.5) / candidates.size());
  };
  for (const double chosen : {0.0, 1.0}) {
    const DataTable lines = edges.where("chosen", chosen);
    for (int e = 0; e < lines.n_rows(); ++e) {
      const int c = int(lines["candidate"][e]);
      panel.curve({part_place(int(lines["part"][e])), candidate_place(c)},
                  {.color = chosen > 0 ? palette[candidates[c].shade] : Color{0.6, 0.6, 0.6},
                   .width = 6 * lines["score"][e] / largest});
    }
  }
  for (int i = 0; i < n_parts; ++i)
    panel.node(part_place(i), std::to_string(i + 1), 11, color_of_part(edges, candidates, i));
  for (size_t c = 0; c < candidates.size(); ++c) {
    panel.node(candidate_place(int(c)), candidates[c].name, 11, palette[candidates[c].shade]);
    panel.note(candidate_place(int(c)), candidates[c].text, {.offset = {10, 0}});
  }
  panel.include({1.45, 0});
  panel.lines_below = {"width of a line: score; the widest " + number_text(largest) + " m²"};
}

void draw(Plot& plot, const Data& data) {
  plot.letters = true;
  const auto candidates = candidates_of(data["edges"]);
  draw_body(plot.panel(0, 0), data, candidates);
  draw_network(plot.panel(0, 1), data, candidates);
}

}  // namespace

Figure origin_network() {
  return {"origin_network",
          "Origins of a square of eight parts: each part takes the set of parts with which it "
          "shares the "
          "most (bold); the four sets taken give the four origins (crosses)",
          7,
          3.4,
          compute,
          draw};
}

}  // namespace sem::figures
