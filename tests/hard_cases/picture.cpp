#include "tests/hard_cases/picture.h"

#include <algorithm>

#include "sem/base/error.h"
#include "sem/draw/image.h"
#include "sem/scene/files.h"

namespace sem::stability {
namespace {

constexpr double line_height = 9.5, heads_height = 62;  // points: a line; column heads and legend
constexpr size_t most_lines = 40;                       // of a picture that is one panel wide

// A heading (no cells), or all cases of one name.
struct Line {
  std::string text;
  std::vector<const Row*> cells;
};
using Lines = std::vector<Line>;

std::string heading(const std::string& group, const std::vector<Row>& rows) {
  size_t n = 0, n_refused = 0, n_failed = 0;
  for (const auto& row : rows) {
    if (row.one.group != group) continue;
    ++n;
    n_refused += row.refused();
    n_failed += row.failed();
  }
  return group + ": " + std::to_string(n - n_refused - n_failed) + " solved, " + std::to_string(n_refused) +
         " refused, " + std::to_string(n_failed) + " failed";
}

// The lines of every group, both in the order of the rows.
std::vector<Lines> lines_by_group(const std::vector<Row>& rows) {
  std::vector<std::string> names;
  std::vector<Lines> groups;
  for (const auto& row : rows) {
    auto g = size_t(std::find(names.begin(), names.end(), row.one.group) - names.begin());
    if (g == names.size()) {
      names.push_back(row.one.group);
      groups.push_back({{heading(row.one.group, rows), {}}});
    }
    Lines& lines = groups[g];
    auto line = std::find_if(lines.begin() + 1, lines.end(), [&](const Line& l) { return l.text == row.one.name; });
    if (line == lines.end()) line = lines.insert(line, {row.one.name, {}});
    line->cells.push_back(&row);
  }
  return groups;
}

// Groups stay whole: two panels where that is too long for one, the longer as short as can be.
std::vector<Lines> panels_of(const std::vector<Lines>& groups) {
  const auto joined = [&](size_t begin, size_t end) {
    Lines all;
    for (size_t g = begin; g < end; ++g) all.insert(all.end(), groups[g].begin(), groups[g].end());
    return all;
  };
  std::vector<Lines> best = {joined(0, groups.size())};
  if (best[0].size() <= most_lines) return best;
  size_t longest = best[0].size();
  for (size_t g = 1; g < groups.size(); ++g) {
    const Lines left = joined(0, g), right = joined(g, groups.size());
    if (std::max(left.size(), right.size()) >= longest) continue;
    longest = std::max(left.size(), right.size());
    best = {left, right};
  }
  return best;
}

// "2D projected" before "3D projected"; all that some row has.
std::vector<std::string> variants_of(const std::vector<Row>& rows) {
  std::vector<std::string> variants;
  for (const auto& row : rows)
    if (!row.one.variant.empty() && std::find(variants.begin(), variants.end(), row.one.variant) == variants.end())
      variants.push_back(row.one.variant);
  std::sort(variants.begin(), variants.end(), [](const auto& a, const auto& b) {
    return a.substr(0, 2) != b.substr(0, 2) ? a < b : a > b;
  });
  if (variants.empty()) variants.push_back("");
  return variants;
}

// From light to dark green.
const ColorScale solved_scale{
    1e-8, 1, [](double t) { return colors::mix({0.86, 0.95, 0.90}, {0.00, 0.33, 0.24}, t); }, true};

using Loop = std::vector<Vec<2>>;

// Cells of one panel by what came out.
struct Cells {
  std::vector<Loop> refused, failed, solved;
  std::vector<double> error;  // by its bound, of the solved ones
};

void draw_cells(Panel& panel, const Cells& cells) {
  for (size_t k = 0; k < cells.solved.size(); ++k)
    panel.area({cells.solved[k]}, solved_scale(std::max(cells.error[k], solved_scale.lower)));
  panel.area(cells.refused, colors::light_gray, "refused for a reason");
  panel.area(cells.failed, colors::okabe_ito[1], "failed (error / bound, or \u00d7: a limit, a crash, a refusal)");
}

Loop rectangle(double left, double right, double y) {
  constexpr double gap = 0.06;
  return {{left + gap, y - 0.5 + gap}, {right - gap, y - 0.5 + gap}, {right - gap, y + 0.5 - gap}, {left + gap, y + 0.5 - gap}};
}

void draw_row(Panel& panel, const Row& row, double left, double right, double y, Cells& cells) {
  const Loop cell = rectangle(left, right, y);
  if (row.failed()) {
    cells.failed.push_back(cell);
    const bool number = row.result.outcome == Outcome::failed && row.result.error > 0;
    panel.note({(left + right) / 2, y}, number ? number_text(row.result.error, 2) : "\u00d7",
               {.color = colors::white, .size = 6.5});
  } else if (row.refused()) {
    cells.refused.push_back(cell);
  } else {
    cells.solved.push_back(cell);
    cells.error.push_back(row.result.error);
  }
}

void draw_heads(Panel& panel, const std::vector<std::string>& variants) {
  for (size_t v = 0; v < variants.size(); ++v) {
    const size_t space = std::min(variants[v].find(' '), variants[v].size());
    const std::string second = space < variants[v].size() ? variants[v].substr(space + 1, 4) + "." : "";
    panel.note({v + 0.5, -0.5}, variants[v].substr(0, space), {.offset = {0, 11}});
    panel.note({v + 0.5, -0.5}, second, {.offset = {0, 2}});
  }
}

// Without frame and axes: the names are notes, so that headings may run over the cells' columns.
void draw_panel(Panel& panel, const Lines& lines, const std::vector<std::string>& variants, size_t n_lines) {
  const double n_columns = double(variants.size());
  panel.frame = false;
  panel.x.lower = 0;
  panel.x.upper = n_columns;
  panel.y.lower = -0.5;
  panel.y.upper = double(n_lines) - 0.5;
  panel.y.reversed = true;
  draw_heads(panel, variants);
  Cells cells;
  for (size_t k = 0; k < lines.size(); ++k) {
    const double y = double(k);
    if (lines[k].cells.empty())
      panel.note({n_columns, y}, lines[k].text, {.offset = {-1, 0}, .color = colors::okabe_ito[0]});
    else
      panel.note({0, y}, lines[k].text, {.offset = {-3, 0}});
    for (const Row* row : lines[k].cells) {
      const auto at = std::find(variants.begin(), variants.end(), row->one.variant);
      const bool own = at != variants.end();
      const double left = own ? double(at - variants.begin()) : 0;
      draw_row(panel, *row, left, own ? left + 1 : n_columns, y, cells);
    }
  }
  draw_cells(panel, cells);
}

}  // namespace

Plot picture(const std::vector<Row>& rows) {
  const auto panels = panels_of(lines_by_group(rows));
  const auto variants = variants_of(rows);
  size_t n_lines = 0;
  for (const auto& lines : panels) n_lines = std::max(n_lines, lines.size());
  Plot plot(3.5 * double(panels.size()) + 0.6, (double(n_lines) * line_height + heads_height) / 72);
  plot.shared_legend = true;
  plot.color_bar(solved_scale, "solved: error / bound");
  for (size_t c = 0; c < panels.size(); ++c) draw_panel(plot.panel(0, int(c)), panels[c], variants, n_lines);
  return plot;
}

void check_picture_name(const std::string& file) {
  if (!file.ends_with(".png") && !file.ends_with(".svg"))
    throw InputError("", "--picture", file, "a file that ends in .png or .svg");
}

void write_picture(const std::string& file, const std::vector<Row>& rows) {
  check_picture_name(file);
  if (file.ends_with(".svg"))
    write_file(file, plot_svg(picture(rows), 300));
  else
    write_png(file, plot_image(picture(rows), 300), 300);
}

}  // namespace sem::stability
