#include "src3d/picture/frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "sem/draw/raster.h"
#include "sem/picture/notes.h"
#include "sem/picture/scales.h"
#include "src3d/picture/surface_stress.h"
#include "src3d/render/renderer.h"
#include "src3d/render/tessellate.h"

namespace sem {
namespace {

using Horizontal = TextStyle::Horizontal;
using Vertical = TextStyle::Vertical;

constexpr Color inverted_color{0.55, 0.55, 0.55};

// Against gravity; without it z.
Vec<3> up_of(const Scene<3>& scene) {
  return scene.gravity.norm() > 0 ? Vec<3>(-scene.gravity.normalized()) : Vec<3>(0, 0, 1);
}

double lowest(const std::vector<Vec<3>>& points, const Vec<3>& up) {
  double height = std::numeric_limits<double>::infinity();
  for (const auto& X : points) height = std::min(height, up.dot(X));
  return height;
}

// Where a control point's basis function has its middle: the means of its knots (Greville), u and
// v.
Vec<2> middle_parameters(const Nurbs<2, 3>& nurbs, int control) {
  const int n_u = int(nurbs.knots[0].size()) - nurbs.degree[0] - 1,
            index[] = {control % n_u, control / n_u};
  Vec<2> u;
  for (int a = 0; a < 2; ++a) {
    const int p = nurbs.degree[a];
    const auto first = nurbs.knots[a].begin() + index[a] + 1;
    u[a] = std::accumulate(first, first + p, 0.0) / p;
  }
  return u;
}

// From the front, a little from the right and from above.
render::ViewDirection direction_of(const Vec<3>& up) {
  const Vec<3> axis = std::abs(up[0]) < 0.9 ? Vec<3>(1, 0, 0) : Vec<3>(0, 1, 0);
  const Vec<3> side = (axis - up.dot(axis) * up).normalized(), front = side.cross(up);
  return {.from = 0.5 * side + front + 0.42 * up, .up = up};
}

}  // namespace

// What is the same in all frames.
struct SolidPainter::Setup {
  render::Renderer renderer;
  Vec<3> up;
  Box<3> box;                            // visited, a little wider: of what the camera frames
  double ground;                         // height along `up` of the lowest place visited, m
  double stress_limit;                   // Pa, 0: the frame's own
  std::vector<Points<3>> points;         // #solids: quadrature points at rest
  std::vector<std::vector<int>> number;  // #solids: which ones

  Setup(const Scene<3>& scene, const Model<3>& model)
      : up(up_of(scene)),
        box(visited_box(scene, model)),
        ground(lowest(render::corners(box), up)),
        stress_limit(sem::stress_limit(scene, model)) {
    const Vec<3> margin = Vec<3>::Constant(0.03 * model.discretization.boundary.box.diagonal());
    box = {box.lower - margin, box.upper + margin};
    const auto& d = model.discretization;
    number.resize(d.boundary.n_solids);
    for (int k = 0; k < d.quadrature.size(); ++k) number[d.quadrature.solid[k]].push_back(k);
    for (const auto& list : number) points.push_back(d.quadrature.position(Eigen::all, list));
  }
};

// One frame. Lengths are in units of a canvas of 800 x 600.
class SolidPainter::Drawing {
 public:
  Drawing(Canvas& canvas, const Scene<3>& scene, const Model<3>& model, Setup& setup,
          const State& state, const std::optional<Vec<3>>& from)
      : direction_(direction_of(setup.up)),
        canvas_(canvas),
        scene_(scene),
        model_(model),
        setup_(setup),
        state_(state),
        p_(control_points(model.discretization.unknowns, state.z)),
        unit_(picture::unit(canvas)),
        area_(area(canvas)),
        flatness_{setup.box.diagonal() / 2000,
                  model.discretization.boundary.n_parts() > 100 ? 4 : 8} {
    result_.up = setup.up;
    if (from) direction_.from = *from;
  }

  void draw() {
    const double limit = surfaces();
    pins();
    const Vec<2> size = area_.upper - area_.lower;
    const int width = int(std::lround(size[0])), height = int(std::lround(size[1]));
    const auto corners = render::corners(setup_.box);
    result_.ground = std::min(setup_.ground, lowest_now());
    const auto camera =
        render::framing(corners, direction_, Box<2>{Vec<2>::Zero(), Vec<2>(width, height)});
    auto options = render::frame_quality(width, height);
    // Mostly light from everywhere, so that colours can be compared with the bar.
    options.lighting.ambient = 0.66;
    options.lighting.key = 0.42;
    options.lighting.gloss = 0.03;
    canvas_.image(setup_.renderer.render(result_, camera, options), area_);
    triad(camera);
    picture::draw_titles(canvas_, area_, scene_.name, scene_.analysis, scene_.output, state_,
                         scale_.n_inverted);
    if (limit > 0) picture::draw_stress_bar(canvas_, area_, limit, scale_.largest, scene_.analysis);
  }

 private:
  // A part with other control points, prepared.
  PreparedNurbs<2, 3> part(int i, const Points<3>& p) const {
    const auto& b = model_.discretization.boundary;
    Nurbs<2, 3> nurbs = b.parts[i].nurbs;
    nurbs.control_points =
        p.middleCols(b.first_control[i], b.first_control[i + 1] - b.first_control[i]);
    auto prepared = prepare(nurbs);
    prepared.region = b.parts[i].region;  // in the parameter plane as at rest
    return prepared;
  }

  // Height of the body's lowest drawn point.
  double lowest_now() const {
    double height = std::numeric_limits<double>::infinity();
    for (const auto& mesh : result_.meshes)
      height = std::min(height, lowest(mesh.position, setup_.up));
    return height;
  }

  // Far enough for its lines at rest to be told from those now.
  bool has_moved(const PreparedNurbs<2, 3>& now, const PreparedNurbs<2, 3>& rest) const {
    const double way = (now.nurbs.control_points - rest.nurbs.control_points).colwise().norm().maxCoeff();
    return way > 0.01 * setup_.box.diagonal();
  }

  // Adds the parts. Returns where the colour scale ends.
  double surfaces() {
    const Eigen::VectorXd stress = von_mises(model_, state_.z);
    scale_ = stress_scale(stress, setup_.stress_limit);
    const double limit = scale_.limit;
    const auto& b = model_.discretization.boundary;
    render::Lines ends{{}, picture::ink, 1.2 * unit_},
        rest{{}, {0.7, 0.7, 0.72}, 0.7 * unit_};
    for (int i = 0; i < b.n_parts(); ++i) {
      deformed_.push_back(part(i, p_));
      const auto& deformed = deformed_.back();
      render::Mesh mesh = tessellate(deformed, flatness_);
      mesh.color = picture::tint(b.solid[i]).with_alpha(1);
      if (limit > 0) mesh.colors = colors_of(mesh, i, stress, limit);
      result_.meshes.push_back(std::move(mesh));
      for (auto& chain : outline(deformed, flatness_)) ends.chains.push_back(std::move(chain));
      if (has_moved(deformed, b.parts[i]))
        for (auto& chain : outline(b.parts[i], flatness_)) rest.chains.push_back(std::move(chain));
    }
    result_.lines = {rest, ends};
    return limit;
  }

  std::vector<Color> colors_of(const render::Mesh& mesh, int i, const Eigen::VectorXd& stress,
                               double limit) const {
    const auto& b = model_.discretization.boundary;
    Points<3> rest(3, mesh.uv.size());
    for (std::size_t k = 0; k < mesh.uv.size(); ++k)
      rest.col(Eigen::Index(k)) = point(b.parts[i], mesh.uv[k]);
    const int solid = b.solid[i];
    const Eigen::VectorXd values =
        near_mean(rest, setup_.points[solid], stress(setup_.number[solid]));
    std::vector<Color> colors;
    for (const double value : values)
      colors.push_back(std::isnan(value) ? inverted_color : colors::viridis(value / limit));
    return colors;
  }

  void pins() {
    const auto& b = model_.discretization.boundary;
    const int n_controls = b.n_controls();
    std::vector<std::array<bool, 3>> held(n_controls, {false, false, false});
    for (std::size_t i = 0; i < model_.held.size(); ++i)
      for (const int c : model_.held[i].controls)
        for (int a = 0; a < 3; ++a) held[c][a] |= scene_.pins[i].axes[a];
    const double size = 0.006 * setup_.box.diagonal();
    render::Lines bars{{}, picture::pin_color, 2.5 * unit_, 0.3};
    int i = 0;
    for (int c = 0; c < n_controls; ++c) {
      while (c >= b.first_control[i + 1]) ++i;
      const int n_held = held[c][0] + held[c][1] + held[c][2];
      if (n_held == 0) continue;
      Param<2> u = middle_parameters(b.parts[i].nurbs, c - b.first_control[i]);
      const auto& region = b.parts[i].region;
      if (region && !region->contains(u)) u = region->border_near(u).u;
      const Vec<3> X = point(deformed_[i], u);
      result_.spheres.push_back({X, size, picture::pin_color});
      for (int a = 0; a < 3; ++a) {
        if (held[c][a]) continue;
        const Vec<3> free = 3 * size * Vec<3>::Unit(a);
        bars.chains.push_back({X - free, X + free});
      }
    }
    result_.lines.push_back(bars);
  }

  // Directions of the axes in the lower left corner.
  void triad(const render::Camera& camera) {
    const Vec<2> middle(area_.lower[0] + 34 * unit_, area_.upper[1] - 34 * unit_);
    for (int a = 0; a < 3; ++a) {
      const Vec<3> axis = Vec<3>::Unit(a);
      const Vec<2> to = 26 * unit_ * Vec<2>(camera.right.dot(axis), -camera.up.dot(axis));
      canvas_.line(middle, middle + to, {.color = picture::label_ink, .width = 1.4 * unit_});
      if (to.norm() > 6 * unit_)
        canvas_.text(middle + to + 8 * unit_ * to.normalized(), std::string(1, "xyz"[a]),
                     {.size = 13 * unit_,
                      .color = picture::label_ink,
                      .horizontal = Horizontal::center,
                      .vertical = Vertical::middle});
    }
  }

  render::ViewDirection direction_;
  Canvas& canvas_;
  const Scene<3>& scene_;
  const Model<3>& model_;
  Setup& setup_;
  const State& state_;
  const Points<3> p_;  // deformed control points
  const double unit_;  // pixels
  const Box<2> area_;  // of the world, in pixels
  const render::Flatness flatness_;
  render::RenderScene result_;
  std::vector<PreparedNurbs<2, 3>> deformed_;  // the parts
  StressScale scale_;
};

SolidPainter::SolidPainter(const Scene<3>& scene) : scene_(scene) {}

SolidPainter::~SolidPainter() = default;

Box<2> SolidPainter::area(const Canvas& canvas) {
  const double u = picture::unit(canvas);
  const Vec<2> lower = (Vec<2>(12, 40) * u).array().round(),
               upper = Vec<2>(canvas.width() - 124 * u, canvas.height() - 12 * u).array().round();
  return {lower, upper};
}

void SolidPainter::draw(Canvas& canvas, const Model<3>& model, const State& state) {
  if (!setup_) setup_ = std::make_unique<Setup>(scene_, model);
  Drawing(canvas, scene_, model, *setup_, state, from_).draw();
}

std::function<Image(const Model<3>&, const State&)> make_solid_painter(const Scene<3>& scene) {
  struct Frames {
    SolidPainter painter;
    RasterCanvas canvas;
  };
  const auto frames = std::shared_ptr<Frames>(
      new Frames{SolidPainter(scene), RasterCanvas(scene.output.width, scene.output.height)});
  return [frames](const Model<3>& model, const State& state) {
    frames->canvas.clear();
    frames->painter.draw(frames->canvas, model, state);
    return frames->canvas.finish();
  };
}

}  // namespace sem
