#include "sem/plot/layout.h"

#include <algorithm>
#include <cmath>

namespace sem {
namespace {

// Points.
constexpr double page_margin = 2.5, column_gap = 9, row_gap = 7, title_room = 13, bar_gap = 9;
constexpr double legend_gap = 6;

}  // namespace

PlotLayout::PlotLayout(const Plot& plot, Canvas& canvas)
    : plot_(plot), canvas_(canvas), point_(canvas.width() / plot.width() / 72) {
  int n_rows = 1, n_columns = 1;
  for (const auto& cell : plot.cells_) {
    n_rows = std::max(n_rows, cell.row + cell.n_rows);
    n_columns = std::max(n_columns, cell.column + cell.n_columns);
    const bool several = plot.letters;
    const std::string letter =
        several ? "(" + std::string(1, char('a' + int(panels_.size()) % 26)) + ")" : "";
    panels_.emplace_back(*cell.panel, canvas, point_, letter,
                         plot.shared_legend ? LegendPlace::none : cell.panel->legend);
  }
  columns_.resize(n_columns);
  rows_.resize(n_rows);
  arrange();
}

std::vector<LegendEntry> PlotLayout::shared_entries() const {
  std::vector<LegendEntry> entries;
  if (!plot_.shared_legend) return entries;
  for (const auto& panel : panels_)
    for (const auto& entry : panel.entries())
      if (std::none_of(entries.begin(), entries.end(),
                       [&](const auto& e) { return e.style.label == entry.style.label; }))
        entries.push_back(entry);
  return entries;
}

void PlotLayout::arrange() {
  const double edge = page_margin * point_;
  page_ = {Vec<2>(edge, edge), Vec<2>(canvas_.width() - edge, canvas_.height() - edge)};
  if (!plot_.row_titles.empty()) page_.lower[0] += title_room * point_;
  if (!plot_.column_titles.empty()) page_.lower[1] += title_room * point_;
  const auto entries = shared_entries();
  if (!entries.empty())
    page_.upper[1] -= Legend(entries, canvas_, point_, page_.upper[0] - page_.lower[0]).size()[1] +
                      legend_gap * point_;
  if (plot_.bar_)
    page_.upper[0] -= bar_gap * point_ + color_bar_width(*plot_.bar_, canvas_, point_,
                                                         page_.upper[1] - page_.lower[1]);
  // Ticks depend on the boxes, margins on the ticks.
  constexpr int n_rounds = 4;
  const auto settle = [&] {
    for (int round = 0; round < n_rounds; ++round) {
      set_boxes();
      collect_margins();
    }
    set_boxes();
  };
  settle();
  // A legend that moves out takes room from other panels, whose own may then fit no more; each moves once.
  for (bool moved = true; moved;) {
    moved = false;
    for (auto& panel : panels_) moved = panel.move_legend() || moved;
    if (moved) settle();
  }
}

void PlotLayout::place_tracks(std::vector<Track>& tracks, const std::vector<double>& shares,
                              double begin, double end, double gap) {
  double room = end - begin - gap * (double(tracks.size()) - 1), total = 0;
  const auto share = [&](std::size_t i) { return i < shares.size() ? shares[i] : 1.0; };
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    room -= tracks[i].before + tracks[i].after;
    total += share(i);
  }
  room = std::max(room, double(tracks.size()));  // labels that leave no room: a pixel each
  double at = begin;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    tracks[i].begin = at + tracks[i].before;
    tracks[i].size = room * share(i) / total;
    at = tracks[i].begin + tracks[i].size + tracks[i].after + gap;
  }
}

void PlotLayout::set_boxes() {
  place_tracks(columns_, plot_.column_shares, page_.lower[0], page_.upper[0], column_gap * point_);
  place_tracks(rows_, plot_.row_shares, page_.lower[1], page_.upper[1], row_gap * point_);
  for (std::size_t k = 0; k < panels_.size(); ++k) {
    const auto& cell = plot_.cells_[k];
    const Track &left = columns_[cell.column], &right = columns_[cell.column + cell.n_columns - 1],
                &top = rows_[cell.row], &bottom = rows_[cell.row + cell.n_rows - 1];
    panels_[k].set_box({Vec<2>(left.begin, top.begin),
                        Vec<2>(right.begin + right.size, bottom.begin + bottom.size)});
  }
}

void PlotLayout::collect_margins() {
  for (auto* tracks : {&columns_, &rows_})
    for (auto& track : *tracks) track.before = track.after = 0;
  const auto raise = [](double& value, double to) { value = std::max(value, to); };
  for (std::size_t k = 0; k < panels_.size(); ++k) {
    const auto& cell = plot_.cells_[k];
    const Margins m = panels_[k].margins();
    raise(columns_[cell.column].before, m.left);
    raise(columns_[cell.column + cell.n_columns - 1].after, m.right);
    raise(rows_[cell.row].before, m.top);
    raise(rows_[cell.row + cell.n_rows - 1].after, m.bottom);
  }
}

void PlotLayout::draw() {
  TextStyle style{.size = lettering * point_,
                  .horizontal = TextStyle::Horizontal::center,
                  .vertical = TextStyle::Vertical::top};
  const double edge = page_margin * point_;
  for (std::size_t i = 0; i < std::min(columns_.size(), plot_.column_titles.size()); ++i)
    canvas_.text({columns_[i].begin + columns_[i].size / 2, edge + 1 * point_},
                 plot_.column_titles[i], style);
  style.upward = true;
  for (std::size_t i = 0; i < std::min(rows_.size(), plot_.row_titles.size()); ++i)
    canvas_.text({edge + 1 * point_, rows_[i].begin + rows_[i].size / 2}, plot_.row_titles[i],
                 style);
  for (std::size_t k = 0; k < panels_.size(); ++k) {
    const Track& column = columns_[plot_.cells_[k].column];
    panels_[k].draw(column.begin - column.before);
  }
  if (plot_.bar_) {
    const double top = std::round(rows_.front().begin),
                 bottom = std::round(rows_.back().begin + rows_.back().size);
    draw_color_bar(*plot_.bar_, canvas_, point_, page_.upper[0] + bar_gap * point_, top, bottom);
  }
  const auto entries = shared_entries();
  if (entries.empty()) return;
  const double room = canvas_.width() - 2 * edge;
  const Legend legend(entries, canvas_, point_, page_.upper[0] - page_.lower[0]);
  const Vec<2> size = legend.size();
  const Pen pen(canvas_, point_, {}, {});
  legend.draw(pen, {edge + std::max(0.0, (room - size[0]) / 2), canvas_.height() - edge - size[1]});
}

}  // namespace sem
