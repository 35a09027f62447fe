#include "sem/scene/pins.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sem/base/error.h"
#include "sem/base/rotation.h"
#include "sem/mechanics/loads.h"
#include "sem/nurbs/closest.h"
#include "sem/nurbs/hits.h"

namespace sem {

using Eigen::VectorXd;

template <int Dim>
Pins<Dim>::Pins(const Scene<Dim>& scene, std::vector<PartInfo> parts, const std::string& file, Discretization<Dim>& d)
    : scene_(scene), parts_(std::move(parts)), d_(d) {
  for (size_t i = 0; i < scene.pins.size(); ++i) {
    const std::string field = "pins[" + std::to_string(i) + "]";
    held_.push_back({select_controls(d.boundary, parts_, scene.pins[i].where, file, field), {}});
    const auto& controls = held_.back().controls;
    if (std::all_of(controls.begin(), controls.end(), [&](int c) { return d.followers.follows(c); }))
      throw InputError(file, field, controls.empty() ? "no control point" : "only control points that are trimmed away",
                       "a part, box or index that matches at least one");
  }
  for (const auto& pin : scene.pins)
    if (condensed()) first_column_.push_back(append_columns(d, pin.rotation.isZero(0) ? 1 : 1 + Dim));
  for (size_t i = 0; i < scene.pins.size(); ++i)
    for (const auto& held : held_columns(int(i)))
      for (int a = 0; a < Dim; ++a)
        if (held.displaced != 0 && held.pin.axes[a]) held_[i].entries.push_back(Dim * held.column + a);
  if (free_entries().empty())
    throw InputError(file, "pins", "all " + std::to_string(Dim * d.unknowns.size()) + " unknowns pinned",
                     "pins that leave something free");
}

// Condensed: all components of the pin's own columns.
template <int Dim>
std::vector<typename Pins<Dim>::HeldColumn> Pins<Dim>::held_columns(int i) const {
  const auto& pin = scene_.pins[i];
  std::vector<HeldColumn> columns;
  if (condensed()) {
    std::array<bool, Dim> all;
    all.fill(true);
    columns.push_back({first_column_[i], pin, all, Vec<Dim>::Zero(), 1});
    for (int a = 0; a < Dim && !pin.rotation.isZero(0); ++a)
      columns.push_back({first_column_[i] + 1 + a, pin, all, Vec<Dim>::Unit(a), 0});
    return columns;
  }
  const Points<Dim> p = rest_controls(d_.boundary);
  for (const int control : held_[i].controls)
    if (!d_.followers.follows(control))
      columns.push_back({unknown_of_control(d_.unknowns, control).value(), pin, pin.axes, p.col(control) - pin.center, 1});
  return columns;
}

template <int Dim>
std::vector<std::array<bool, Dim>> Pins<Dim>::held_components() const {
  std::vector<std::array<bool, Dim>> held(d_.unknowns.size());
  for (auto& node : held) node.fill(false);
  for (size_t i = 0; i < scene_.pins.size(); ++i)
    for (const auto& column : held_columns(int(i)))
      for (int a = 0; a < Dim; ++a) held[column.column][a] |= column.axes[a];
  return held;
}

template <int Dim>
std::vector<int> Pins<Dim>::held_nodes() const {
  std::vector<int> nodes;
  const auto held = held_components();
  for (int node = 0; node < int(held.size()); ++node)
    if (std::find(held[node].begin(), held[node].end(), false) == held[node].end()) nodes.push_back(node);
  return nodes;
}

template <int Dim>
std::vector<int> Pins<Dim>::free_entries() const {
  std::vector<int> free;
  const auto held = held_components();
  for (int node = 0; node < int(held.size()); ++node)
    for (int a = 0; a < Dim; ++a)
      if (!held[node][a]) free.push_back(Dim * node + a);
  return free;
}

template <int Dim>
std::vector<typename Pins<Dim>::HeldColumn> Pins<Dim>::moving_columns() const {
  std::vector<HeldColumn> moving;
  for (size_t i = 0; i < scene_.pins.size(); ++i)
    for (auto& column : held_columns(int(i)))
      if (column.pin.moves()) moving.push_back(std::move(column));
  return moving;
}

// Where the columns stand when their pins have done a share s = share(pin) of their way.
template <int Dim>
template <class Share>
VectorXd Pins<Dim>::led_to(const VectorXd& rest, const std::vector<HeldColumn>& moving, const Share& share) {
  VectorXd z = rest;
  for (const auto& [column, pin, axes, arm, displaced] : moving) {
    const double s = share(pin);
    const Vec<Dim> motion = displaced * s * pin.displacement + (rotation<Dim>(s * pin.rotation) * arm - arm);
    for (int a = 0; a < Dim; ++a)
      if (pin.axes[a]) z[Dim * column + a] += motion[a];
  }
  return z;
}

template <int Dim>
VectorXd Pins<Dim>::target(const VectorXd& rest) const {
  return led_to(rest, moving_columns(), [](const Pin<Dim>&) { return 1.0; });
}

template <int Dim>
PinPath Pins<Dim>::path(const VectorXd& rest) const {
  const auto moving = moving_columns();
  if (std::none_of(moving.begin(), moving.end(), [](const auto& one) { return !one.pin.rotation.isZero(0); })) return {};
  return [rest, moving](double s) { return led_to(rest, moving, [s](const Pin<Dim>&) { return s; }); };
}

template <int Dim>
PinPath Pins<Dim>::motion(const VectorXd& rest) const {
  auto moving = moving_columns();
  std::erase_if(moving, [](const auto& one) { return one.pin.duration == 0; });
  if (moving.empty()) return {};
  return [rest, moving](double time) {
    return led_to(rest, moving, [time](const Pin<Dim>& pin) {
      const double r = std::min(1.0, time / pin.duration);
      return r * r * (3 - 2 * r);
    });
  };
}

template <int Dim>
Clamps<Dim> Pins<Dim>::clamps() const {
  if (!condensed()) return {};
  const BoundaryRule<Dim> rule = boundary_rule(d_);
  const auto coincident = coincident_controls(d_.boundary);
  std::vector<HeldSample> held_samples;
  std::vector<HeldControl<Dim>> springs;
  for (size_t i = 0; i < scene_.pins.size(); ++i) {
    std::set<int> covered = hold_samples(rule.samples, int(i), held_samples);
    for (const auto& group : coincident)
      if (std::any_of(group.begin(), group.end(), [&](int c) { return covered.count(c) > 0; }))
        covered.insert(group.begin(), group.end());
    for (const int control : held_[i].controls)
      if (!covered.count(control) && !d_.followers.follows(control)) springs.push_back(spring(control, int(i)));
  }
  return Clamps<Dim>(clamped_points(rule, held_samples), std::move(springs));
}

// Appends the samples that depend on held control points alone; returns these control points.
template <int Dim>
std::set<int> Pins<Dim>::hold_samples(const Samples<Dim>& samples, int pin, std::vector<HeldSample>& out) const {
  const auto& held = held_[pin].controls;
  std::set<int> covered;
  for (int s = 0; s < samples.size(); ++s) {
    const auto begin = samples.column.begin() + samples.row[s], end = samples.column.begin() + samples.row[s + 1];
    if (!std::all_of(begin, end, [&](int c) { return std::binary_search(held.begin(), held.end(), c); })) continue;
    covered.insert(begin, end);
    out.push_back({s, pin});
  }
  return covered;
}

template <int Dim>
ClampedPoints<Dim> Pins<Dim>::clamped_points(const BoundaryRule<Dim>& rule, const std::vector<HeldSample>& held) const {
  const Samples<Dim>& samples = rule.samples;
  const int n = int(held.size()), degree = d_.projection.monomials.degree();
  ClampedPoints<Dim> points;
  for (Points<Dim>* list : {&points.position, &points.normal, &points.held}) list->resize(Dim, n);
  points.weight.resize(n);
  points.penalty.resize(n);
  for (int k = 0; k < n; ++k) {
    const int s = held[k].sample, part = samples.part[s], first = samples.first[part];
    const double measure = samples.weight.segment(first, samples.first[part + 1] - first).sum();
    points.position.col(k) = samples.position.col(s);
    points.normal.col(k) = rule.normal.col(s);
    points.held.col(k) = held_axes(held[k].pin);
    points.weight[k] = samples.weight[s];
    const Vec<Dim> X = samples.position.col(s);
    const double size = std::min({std::pow(measure, 1.0 / (Dim - 1)), depth_below(X, rule.normal.col(s)), patch_size(X)});
    points.penalty[k] = scene_.clamp_penalty * degree * degree / size;
    points.material.push_back(*parts_[part].material);
  }
  points.map = map_at(d_, points.position, true);
  for (auto& block : points.map.blocks) subtract_pins(held, points.position, block);
  return points;
}

// The pins' displacement d0 + D (X - center) in their columns: d0, then the columns of D if the pin turns.
template <int Dim>
Eigen::RowVectorXd Pins<Dim>::pin_row(int pin, const Vec<Dim>& X) const {
  const bool turns = !scene_.pins[pin].rotation.isZero(0);
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Ones(turns ? 1 + Dim : 1);
  if (turns) row.template tail<Dim>() = (X - scene_.pins[pin].center).transpose();
  return row;
}

// Appends the columns of the pins that hold points of the block: its value becomes that of x - d_.
template <int Dim>
void Pins<Dim>::subtract_pins(const std::vector<HeldSample>& held, const Points<Dim>& position, MapBlock<Dim>& block) const {
  std::set<int> pins;
  for (const int s : block.points) pins.insert(held[s].pin);
  for (const int pin : pins) {
    const int first = int(block.columns.size()), n = int(pin_row(pin, position.col(0)).size());
    const int n_points = int(block.points.size());
    for (int j = 0; j < n; ++j) block.columns.push_back(first_column_[pin] + j);
    block.value.conservativeResize(n_points, first + n);
    for (int k = 0; k < n_points; ++k) {
      const int s = block.points[k];
      block.value.row(k).tail(n) = held[s].pin == pin ? Eigen::RowVectorXd(-pin_row(pin, position.col(s))) : Eigen::RowVectorXd::Zero(n);
    }
    for (auto& gradient : block.gradient) {
      gradient.conservativeResize(n_points, first + n);
      gradient.rightCols(n).setZero();
    }
  }
}

// How far the solid reaches below a point of its boundary, m: the inverse inequality that the penalty
// answers knows no length beyond that.
template <int Dim>
double Pins<Dim>::depth_below(const Vec<Dim>& X, const Vec<Dim>& normal) const {
  const auto& boundary = d_.boundary;
  const double infinity = std::numeric_limits<double>::infinity();
  double depth = infinity;
  std::vector<Hit<Dim>> hits;
  for (const auto& part : boundary.parts) {
    hits.clear();
    append_hits(part, Line<Dim>{X, -normal}, boundary.tolerance(), infinity, hits);
    for (const auto& hit : hits) depth = std::min(depth, hit.t);
  }
  return depth;
}

// The length over which the functions of patches vary at X, m: its distance to the joint, or the radius of the
// smallest patch there.
template <int Dim>
double Pins<Dim>::patch_size(const Vec<Dim>& X) const {
  double size = std::numeric_limits<double>::infinity();
  for (size_t p = 0; p < d_.patches.size(); ++p) {
    const auto& patch = d_.patches[p];
    // The smallest at a joint is the last one there.
    if (p + 1 < d_.patches.size() && d_.patches[p + 1].a == patch.a && d_.patches[p + 1].b == patch.b) continue;
    const double reach = patch.radius * std::ldexp(1, patch.level);
    const double r = std::hypot(closest_point(d_.boundary.parts[patch.a], X, reach).distance,
                                closest_point(d_.boundary.parts[patch.b], X, reach).distance);
    if (r < reach) size = std::min(size, std::max(r, patch.radius));
  }
  return size;
}

template <int Dim>
HeldControl<Dim> Pins<Dim>::spring(int control, int pin) const {
  const double size = std::pow(d_.boundary.box.diagonal(), Dim - 2);
  const Vec<Dim> X = rest_controls(d_.boundary).col(control);
  Eigen::RowVectorXd output = d_.unknowns.S.row(control);
  const Eigen::RowVectorXd row = pin_row(pin, X);
  output.segment(first_column_[pin], row.size()) -= row;
  return {output, X, held_axes(pin), 100 * size * parts_[part_of_control(control)].material->youngs_modulus};
}

template <int Dim>
Vec<Dim> Pins<Dim>::held_axes(int pin) const {
  Vec<Dim> axes;
  for (int a = 0; a < Dim; ++a) axes[a] = scene_.pins[pin].axes[a];
  return axes;
}

template <int Dim>
int Pins<Dim>::part_of_control(int control) const {
  const auto& first = d_.boundary.first_control;
  return int(std::upper_bound(first.begin(), first.end(), control) - first.begin()) - 1;
}

template class Pins<2>;
template class Pins<3>;

}  // namespace sem
