#include "src2d/picture/frame.h"

#include <algorithm>
#include <cmath>

#include "sem/draw/image.h"
#include "sem/draw/view.h"
#include "sem/picture/notes.h"
#include "sem/picture/scales.h"

namespace sem {
namespace {

using Horizontal = TextStyle::Horizontal;
using Vertical = TextStyle::Vertical;

using picture::ink, picture::label_ink, picture::pin_color;

constexpr Color hairline{0.9, 0.9, 0.92};

}  // namespace

// One frame on its canvas. Lengths are in units of a canvas of 800 x 600.
class FramePainter::Drawing {
 public:
  Drawing(Canvas& canvas, const Scene<2>& scene, const Model<2>& model, const Setup& setup,
          const State& state)
      : canvas_(canvas),
        scene_(scene),
        model_(model),
        setup_(setup),
        p_(control_points(model.discretization.unknowns, state.z)),
        state_(state),
        unit_(picture::unit(canvas)),
        area_(area(canvas)),
        view_(setup.view, area_) {}

  void draw() {
    axes();
    canvas_.push_clip(area_);
    const Points<2> rest = rest_controls(model_.discretization.boundary);
    for (int i = 0; i < setup_.outline.n_parts(); ++i)
      canvas_.stroke(view_.map(setup_.outline.part(i, rest)),
                     {.color = {0.62, 0.63, 0.66}, .width = unit_, .dash = {5 * unit_, 4 * unit_}});
    solids();
    const double limit = stresses();
    controls();
    boundary();
    pins();
    canvas_.pop_clip();
    canvas_.stroke_box(area_, {.color = label_ink, .width = unit_});
    picture::draw_titles(canvas_, area_, scene_.name, scene_.analysis, scene_.output, state_,
                         scale_.n_inverted);
    if (limit > 0) picture::draw_stress_bar(canvas_, area_, limit, scale_.largest, scene_.analysis);
  }

 private:
  TextStyle text(double size, const Color& color, Horizontal horizontal, Vertical vertical) const {
    return {.size = size * unit_, .color = color, .horizontal = horizontal, .vertical = vertical};
  }

  void axes() {
    // The world that the whole area shows.
    const Vec<2> half = (area_.upper - area_.lower) / (2 * view_.scale());
    const Vec<2> center = (setup_.view.lower + setup_.view.upper) / 2;
    for (int a = 0; a < 2; ++a) {
      const double lower = center[a] - half[a], upper = center[a] + half[a],
                   step = nice_step(lower, upper, 7);
      for (const double tick : nice_ticks(lower, upper, 7)) {
        Vec<2> world = center;
        world[a] = tick;
        const double at = std::floor(view_.map(world)[a]) + 0.5;
        Vec<2> from(area_.lower), to(area_.upper);
        from[a] = to[a] = at;
        canvas_.line(from, to, {.color = hairline, .width = 1});
        if (a == 0)
          canvas_.text({at, area_.upper[1] + 6 * unit_}, tick_label(tick, step),
                       text(13, label_ink, Horizontal::center, Vertical::top));
        else
          canvas_.text({area_.lower[0] - 6 * unit_, at}, tick_label(tick, step),
                       text(13, label_ink, Horizontal::right, Vertical::middle));
      }
    }
    const Vec<2> middle = (area_.lower + area_.upper) / 2;
    canvas_.text({middle[0], area_.upper[1] + 28 * unit_}, "x (m)",
                 text(14, label_ink, Horizontal::center, Vertical::top));
    TextStyle upward = text(14, label_ink, Horizontal::center, Vertical::middle);
    upward.upward = true;
    canvas_.text({18 * unit_, middle[1]}, "y (m)", upward);
  }

  void solids() {
    for (const auto& region : setup_.outline.regions(p_)) {
      std::vector<Polyline> loops;
      for (const auto& loop : region.loops) loops.push_back(view_.map(loop));
      canvas_.fill(loops, picture::tint(region.solid));
    }
  }

  // Discs of the area that the points stand for. Returns where the colour scale ends.
  double stresses() {
    const auto& quadrature = model_.discretization.quadrature;
    const Eigen::VectorXd stress = von_mises(model_, state_.z);
    scale_ = stress_scale(stress, setup_.stress_limit);
    const double limit = scale_.limit;
    const Points<2> x = evaluate(model_.discretization.interior, state_.z);
    for (int k = 0; k < quadrature.size(); ++k) {
      const double size = std::clamp(0.8 * std::sqrt(quadrature.weight[k]) * view_.scale(),
                                     2.5 * unit_, 15 * unit_);
      canvas_.marker(view_.map(Vec<2>(x.col(k))), MarkerShape::circle, size,
                     colors::viridis(limit > 0 ? stress[k] / limit : 0));
    }
    return limit;
  }

  void boundary() {
    for (int i = 0; i < setup_.outline.n_parts(); ++i)
      canvas_.stroke(view_.map(setup_.outline.part(i, p_)),
                     {.color = ink, .width = 2 * unit_, .cap = Stroke::Cap::round});
    for (int i = 0; i < setup_.outline.n_parts(); ++i) {
      const Polyline line = setup_.outline.part(i, p_);
      for (const auto& end : {line.front(), line.back()})
        canvas_.marker(view_.map(end), MarkerShape::circle, 7 * unit_, ink);
    }
  }

  Vec<2> control(int c) const { return view_.map(Vec<2>(p_.col(c))); }

  void controls() {
    const auto& b = model_.discretization.boundary;
    for (int i = 0; i < b.n_parts(); ++i) {
      if (b.parts[i].nurbs.degree[0] == 1) continue;  // the control points are the ends of segments
      Polyline polygon;
      for (int c = b.first_control[i]; c < b.first_control[i + 1]; ++c)
        polygon.push_back(control(c));
      canvas_.stroke(polygon, {.color = {0.72, 0.72, 0.74}, .width = 0.8 * unit_});
      for (const auto& at : polygon)
        canvas_.marker(at, MarkerShape::circle, 4.5 * unit_, {0.5, 0.5, 0.5});
    }
  }

  void pins() {
    const int n_controls = model_.discretization.boundary.n_controls();
    std::vector<std::array<bool, 2>> held(n_controls, {false, false});
    for (size_t i = 0; i < model_.held.size(); ++i)
      for (const int c : model_.held[i].controls)
        for (int a = 0; a < 2; ++a) held[c][a] |= scene_.pins[i].axes[a];
    for (int c = 0; c < n_controls; ++c) pin(control(c), held[c][0], held[c][1]);
  }

  void pin(const Vec<2>& at, bool x, bool y) {
    if (x && y) {
      const double w = 6.5 * unit_, h = 12 * unit_;
      canvas_.fill(Polyline{at, at + Vec<2>(w, h), at + Vec<2>(-w, h)}, pin_color);
    } else if (x || y) {
      const Vec<2> free = 8 * unit_ * (x ? Vec<2>(0, 1) : Vec<2>(1, 0));
      canvas_.line(at - free, at + free,
                   {.color = pin_color, .width = 3.5 * unit_, .cap = Stroke::Cap::round});
    } else {
      return;
    }
    canvas_.marker(at, MarkerShape::circle, 5 * unit_, pin_color);
  }

  Canvas& canvas_;
  const Scene<2>& scene_;
  const Model<2>& model_;
  const Setup& setup_;
  const Points<2> p_;  // deformed control points
  const State& state_;
  const double unit_;  // pixels
  const Box<2> area_;  // of the world, in pixels
  const View2 view_;
  StressScale scale_;
};

Box<2> FramePainter::area(const Canvas& canvas) {
  const double u = picture::unit(canvas);
  return {Vec<2>(66, 40) * u, Vec<2>(canvas.width() - 124 * u, canvas.height() - 54 * u)};
}

void FramePainter::draw(Canvas& canvas, const Model<2>& model, const State& state) {
  if (!setup_)
    setup_.emplace(
        Setup{Outline(model.discretization), view_box(scene_, model), stress_limit(scene_, model)});
  Drawing(canvas, scene_, model, *setup_, state).draw();
}

}  // namespace sem
