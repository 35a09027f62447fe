#include "src2d/picture/frame.h"

#include <algorithm>
#include <cmath>

#include "sem/draw/image.h"
#include "sem/draw/view.h"
#include "sem/nurbs/basis.h"

namespace sem {
namespace {

constexpr int points_per_piece = 24;
constexpr double text_size = 14;
const Color outline_color{0.15, 0.15, 0.2, 1}, faint{0.6, 0.6, 0.6, 1};

// Round number at or above the value: 1, 2 or 5 times a power of ten.
double round_up(double value) {
  const double decade = std::pow(10, std::floor(std::log10(value)));
  for (const double factor : {1.0, 2.0, 5.0, 10.0})
    if (factor * decade >= value) return factor * decade;
  return 10 * decade;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

void draw_axes(Canvas& canvas, const View2& view, const Box<2>& world, const Box<2>& area) {
  const Stroke grid{.color = {0.9, 0.9, 0.92, 1}, .width = 1};
  const TextStyle below{.size = text_size, .color = faint, .horizontal = TextStyle::Horizontal::center,
                        .vertical = TextStyle::Vertical::top};
  const TextStyle beside{.size = text_size, .color = faint, .horizontal = TextStyle::Horizontal::right,
                         .vertical = TextStyle::Vertical::middle};
  for (int a = 0; a < 2; ++a) {
    const double step = nice_step(world.lower[a], world.upper[a], 7);
    for (const double tick : nice_ticks(world.lower[a], world.upper[a], 7)) {
      Vec<2> at = world.lower;
      at[a] = tick;
      const Vec<2> pixel = view.map(at);
      if (a == 0) {
        canvas.line({pixel[0], area.lower[1]}, {pixel[0], area.upper[1]}, grid);
        canvas.text({pixel[0], area.upper[1] + 6}, tick_label(tick, step), below);
      } else {
        canvas.line({area.lower[0], pixel[1]}, {area.upper[0], pixel[1]}, grid);
        canvas.text({area.lower[0] - 6, pixel[1]}, tick_label(tick, step), beside);
      }
    }
  }
}

void draw_color_bar(Canvas& canvas, const Box<2>& bar, double limit) {
  canvas.image(viridis_ramp(), bar);
  canvas.stroke_box(bar, {.color = faint, .width = 1});
  const TextStyle label{.size = text_size, .vertical = TextStyle::Vertical::middle};
  for (const double share : {0.0, 0.5, 1.0})
    canvas.text({bar.upper[0] + 6, bar.upper[1] + share * (bar.lower[1] - bar.upper[1])}, number(share * limit), label);
  canvas.text({bar.lower[0] - 8, (bar.lower[1] + bar.upper[1]) / 2}, "von Mises stress (Pa)",
              {.size = text_size, .horizontal = TextStyle::Horizontal::center, .upward = true});
}

}  // namespace

Eigen::VectorXd von_mises(const Model<2>& model, const Eigen::VectorXd& z) {
  const auto& map = model.discretization.interior;
  const Eigen::Map<const Points<2>> nodes(z.data(), 2, map.n_columns);
  Eigen::VectorXd result(map.n_points);
  for (const auto& block : map.blocks) {
    const Points<2> local = nodes(Eigen::all, block.columns);
    const Points<2> dx = local * block.gradient[0].transpose(), dy = local * block.gradient[1].transpose();
    for (size_t k = 0; k < block.points.size(); ++k) {
      Mat<2> F;
      F << dx.col(k), dy.col(k);
      const Material& material = model.materials.materials[model.materials.of_point[block.points[k]]];
      if (!std::isfinite(energy_density<2>(material, F))) {
        result[block.points[k]] = 0;  // inverted where the model has no stress
        continue;
      }
      const Mat<2> s = cauchy_stress<2>(material, F);
      // Plane strain: the stress across the plane, to first order nu (s_xx + s_yy).
      const double sz = material.poisson_ratio * (s(0, 0) + s(1, 1));
      result[block.points[k]] =
          std::sqrt(((s(0, 0) - s(1, 1)) * (s(0, 0) - s(1, 1)) + (s(1, 1) - sz) * (s(1, 1) - sz) +
                     (sz - s(0, 0)) * (sz - s(0, 0))) / 2 + 3 * s(0, 1) * s(0, 1));
    }
  }
  return result;
}

void FramePainter::prepare(const Model<2>& model, const State& first) {
  const auto& d = model.discretization;
  curves_.resize(d.boundary.n_parts());
  BasisValues<1> basis;
  for (int i = 0; i < d.boundary.n_parts(); ++i)
    for (const auto& piece : d.boundary.parts[i].pieces)
      for (int k = piece.lower == d.boundary.parts[i].pieces[0].lower ? 0 : 1; k <= points_per_piece; ++k) {
        const double s = double(k) / points_per_piece;
        evaluate_basis(d.boundary.parts[i].nurbs, Param<1>((1 - s) * piece.lower + s * piece.upper), 0, basis);
        auto& row = curves_[i].rows.emplace_back();
        for (size_t e = 0; e < basis.column.size(); ++e)
          row.push_back({d.boundary.first_control[i] + basis.column[e], basis.value[e]});
      }
  for (const auto& loop : d.loops.loops) {
    Outline outline{loop.solid, {}};
    const auto end = [&](size_t at, bool last) {
      const Polyline line = positions(loop.parts[at], model.system.rest);
      return last ? line.back() : line.front();
    };
    const size_t n = loop.parts.size();
    // A part runs backward if its start is closer to the next part than its end is.
    const auto gap = [&](size_t at, bool last) {
      return std::min((end(at, last) - end((at + 1) % n, false)).norm(), (end(at, last) - end((at + 1) % n, true)).norm());
    };
    bool backward = n > 1 && gap(0, false) < gap(0, true);
    for (size_t k = 0; k < n; ++k) {
      if (k > 0) {
        const Vec<2> previous = end(k - 1, !outline.parts.back().second);
        backward = (end(k, true) - previous).norm() < (end(k, false) - previous).norm();
      }
      outline.parts.push_back({loop.parts[k], backward});
    }
    outlines_.push_back(outline);
  }
  if (scene_.output.view) {
    view_ = *scene_.output.view;
  } else {
    view_ = d.boundary.box;
    const bool moving = scene_.analysis.kind == AnalysisKind::dynamics;
    const Vec<2> room = Vec<2>::Constant((moving ? 0.45 : 0.12) * view_.diagonal());
    for (const auto& z : {model.system.rest, first.z})
      for (int i = 0; i < d.boundary.n_parts(); ++i)
        for (const auto& x : positions(i, z)) view_.include(x);
    view_.lower -= room;
    view_.upper += room;
  }
  ready_ = true;
}

Polyline FramePainter::positions(int part, const Eigen::VectorXd& z) const {
  Polyline line;
  for (const auto& row : curves_[part].rows) {
    Vec<2> x = Vec<2>::Zero();
    for (const auto& [column, value] : row) x += value * z.segment<2>(2 * column);
    line.push_back(x);
  }
  return line;
}

void FramePainter::draw(Canvas& canvas, const Model<2>& model, const State& state) {
  if (!ready_) prepare(model, state);
  const auto& d = model.discretization;
  const Box<2> area{Vec<2>(60, 44), Vec<2>(canvas.width() - 140, canvas.height() - 44)};
  const View2 view(view_, area);
  // The world that the whole area shows, for its axes.
  const Vec<2> half = (area.upper - area.lower) / (2 * view.scale()), center = (view_.lower + view_.upper) / 2;
  const Box<2> world{center - half, center + half};
  draw_axes(canvas, view, world, area);
  canvas.push_clip(area);

  const Eigen::VectorXd& rest = model.system.rest;
  for (int i = 0; i < d.boundary.n_parts(); ++i)
    canvas.stroke(view.map(positions(i, rest)), {.color = faint, .width = 1, .dash = {5, 4}});

  for (int s = 0; s < d.boundary.n_solids; ++s) {
    std::vector<Polyline> loops;
    for (const auto& outline : outlines_) {
      if (outline.solid != s) continue;
      auto& loop = loops.emplace_back();
      for (const auto& [part, backward] : outline.parts) {
        Polyline line = view.map(positions(part, state.z));
        if (backward) std::reverse(line.begin(), line.end());
        loop.insert(loop.end(), line.begin(), line.end());
      }
    }
    canvas.fill(loops, colors::mix(colors::white, colors::categorical(s), 0.18));
  }

  const Eigen::VectorXd stress = von_mises(model, state.z);
  const double largest = stress.maxCoeff();
  if (largest > stress_limit_) stress_limit_ = round_up(largest);
  const Points<2> x = evaluate(d.interior, state.z);
  for (int k = 0; k < d.quadrature.size(); ++k) {
    const double size = std::clamp(0.8 * std::sqrt(d.quadrature.weight[k]) * view.scale(), 2.0, 14.0);
    canvas.marker(view.map(Vec<2>(x.col(k))), MarkerShape::circle, size,
                  colors::viridis(stress_limit_ > 0 ? stress[k] / stress_limit_ : 0));
  }

  for (int i = 0; i < d.boundary.n_parts(); ++i)
    canvas.stroke(view.map(positions(i, state.z)), {.color = outline_color, .width = 2.2, .cap = Stroke::Cap::round});
  std::vector<bool> held(d.boundary.n_controls(), false);
  for (const auto& pin : model.pinned)
    for (const int entry : pin) held[entry / 2] = true;
  for (int c = 0; c < d.boundary.n_controls(); ++c) {
    const Vec<2> at = view.map(Vec<2>(state.z.segment<2>(2 * c)));
    canvas.marker(at, MarkerShape::circle, 5, {0.5, 0.5, 0.5, 1});
    if (held[c]) canvas.marker(at, MarkerShape::triangle, 12, colors::okabe_ito[1]);
  }
  canvas.pop_clip();
  canvas.stroke_box(area, {.color = faint, .width = 1});

  const TextStyle title{.size = text_size + 2};
  canvas.text({area.lower[0], 28}, scene_.name, title);
  char when[64] = "";
  if (scene_.analysis.kind == AnalysisKind::dynamics) std::snprintf(when, sizeof when, "t = %.3f s", state.time);
  if (scene_.analysis.kind == AnalysisKind::modes) std::snprintf(when, sizeof when, "mode %ld", state.step);
  if (scene_.analysis.kind == AnalysisKind::statics) std::snprintf(when, sizeof when, "equilibrium");
  canvas.text({area.upper[0], 28}, when, {.size = text_size + 2, .horizontal = TextStyle::Horizontal::right});
  canvas.text({area.upper[0], area.upper[1] + 6}, "m",
              {.size = text_size, .color = faint, .horizontal = TextStyle::Horizontal::left, .vertical = TextStyle::Vertical::top});
  if (stress_limit_ > 0) {
    const double right = canvas.width();
    draw_color_bar(canvas, {Vec<2>(right - 92, area.lower[1] + 20), Vec<2>(right - 76, area.upper[1] - 20)}, stress_limit_);
  }
}

}  // namespace sem
