#include "sem/lesson/lesson.h"

#include <algorithm>
#include <cassert>
#include <sstream>

#include "sem/base/error.h"
#include "sem/scene/fields.h"

namespace sem {

using Kind = Parameter::Kind;

Lesson::Lesson(std::string title, const Box<2>& world) : title_(std::move(title)), world_(world) {}

void Lesson::add(Parameter parameter) {
  assert(!parameter.name.empty() &&
         std::all_of(parameter.name.begin(), parameter.name.end(),
                     [](unsigned char c) { return std::isalnum(c) || c == '_'; }));
  assert(std::none_of(parameters_.begin(), parameters_.end(),
                      [&](const Parameter& other) { return other.name == parameter.name; }));
  parameter.step = n_steps();
  if (parameter.kind == Kind::toggle || parameter.kind == Kind::choice) {
    parameter.lower = Vec<2>::Zero();
    parameter.upper = Vec<2>(std::max(1, int(parameter.choices.size()) - 1), 0);
  }
  defaults_.push_back(parameter.get());
  parameters_.push_back(std::move(parameter));
}

void Lesson::slider(const std::string& name, int& value, int lower, int upper,
                    const std::string& help) {
  Parameter p{.name = name, .help = help, .kind = Kind::integer};
  p.lower = Vec<2>(lower, 0);
  p.upper = Vec<2>(upper, 0);
  p.get = [&value] { return Vec<2>(value, 0); };
  p.set = [&value](const Vec<2>& v) { value = int(v[0]); };
  add(std::move(p));
}

void Lesson::slider(const std::string& name, double& value, double lower, double upper,
                    const std::string& help, Scale scale) {
  assert(scale == Scale::linear || lower > 0);
  Parameter p{.name = name, .help = help, .kind = Kind::real};
  p.lower = Vec<2>(lower, 0);
  p.upper = Vec<2>(upper, 0);
  p.logarithmic = scale == Scale::logarithmic;
  p.get = [&value] { return Vec<2>(value, 0); };
  p.set = [&value](const Vec<2>& v) { value = v[0]; };
  add(std::move(p));
}

void Lesson::toggle(const std::string& name, bool& value, const std::string& help) {
  Parameter p{.name = name, .help = help, .kind = Kind::toggle};
  p.get = [&value] { return Vec<2>(value, 0); };
  p.set = [&value](const Vec<2>& v) { value = v[0] != 0; };
  add(std::move(p));
}

void Lesson::choice(const std::string& name, int& value, const std::vector<std::string>& names,
                    const std::string& help) {
  Parameter p{.name = name, .help = help, .kind = Kind::choice};
  p.choices = names;
  p.get = [&value] { return Vec<2>(value, 0); };
  p.set = [&value](const Vec<2>& v) { value = int(v[0]); };
  add(std::move(p));
}

void Lesson::handles(const std::string& name, Points<2>& points, const std::string& help) {
  for (int i = 0; i < points.cols(); ++i) {
    Parameter p{.name = name + std::to_string(i + 1), .help = help, .kind = Kind::point};
    p.lower = world_.lower;
    p.upper = world_.upper;
    p.get = [&points, i]() -> Vec<2> { return points.col(i); };
    p.set = [&points, i](const Vec<2>& v) { points.col(i) = v; };
    add(std::move(p));
  }
}

void Lesson::handle(const std::string& name, Vec<2>& point, const std::string& help) {
  Parameter p{.name = name, .help = help, .kind = Kind::point};
  p.lower = world_.lower;
  p.upper = world_.upper;
  p.get = [&point] { return point; };
  p.set = [&point](const Vec<2>& v) { point = v; };
  add(std::move(p));
}

void Lesson::orbit(Vec<2>& angles) {
  const char* const names[] = {"turn", "lift"};
  const char* const help[] = {"of the camera about the vertical, degrees",
                              "of the camera above the horizon, degrees"};
  for (const int i : {0, 1}) {
    Parameter p{.name = names[i], .help = help[i], .kind = Kind::real};
    p.lower = Vec<2>(i == 0 ? -180 : -89, 0);
    p.upper = -p.lower;
    p.drawn_only = true;
    p.get = [&angles, i] { return Vec<2>(angles[i], 0); };
    p.set = [&angles, i](const Vec<2>& v) { angles[i] = v[0]; };
    add(std::move(p));
  }
}

void Lesson::step(const std::string& title, Compute compute, Draw draw, Hover hover) {
  steps_.push_back({title, std::move(compute), std::move(draw), std::move(hover)});
}

void Lesson::show(int step) {
  assert(step >= 0 && step < n_steps());
  current_ = step;
  for (int i = 0; i <= step; ++i) {
    Step& s = steps_[i];
    if (s.fresh) continue;
    for (int later = i; later < n_steps(); ++later) steps_[later].fresh = false;
    std::ostringstream out;
    ++s.n_runs;
    asked_quick_ = false;
    s.compute(out);
    s.coarse = quick_ && asked_quick_;
    s.numbers = out.str();
    s.fresh = true;
  }
}

void Lesson::reset() {
  for (std::size_t i = 0; i < parameters_.size(); ++i) parameters_[i].set(defaults_[i]);
  for (auto& s : steps_) s.fresh = false;
  show(0);
}

void Lesson::change(const Parameter& parameter, const Vec<2>& value) {
  const Vec<2> allowed = value.cwiseMax(parameter.lower).cwiseMin(parameter.upper);
  if (allowed == parameter.get()) return;
  parameter.set(allowed);
  if (parameter.drawn_only) return;
  for (int i = parameter.step; i < n_steps(); ++i) steps_[i].fresh = false;
  if (current_ >= 0) show(current_);
}

void Lesson::set(const std::string& assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string::npos)
    throw InputError("", "--set", "'" + assignment + "'", "name=value");
  const std::string name = assignment.substr(0, equals);
  std::vector<std::string> names;
  for (const auto& p : parameters_) {
    if (p.name == name) return change(p, read_value(p, assignment.substr(equals + 1)));
    names.push_back(p.name);
  }
  const std::string close = closest_name(name, names);
  throw InputError("", "--set", "'" + name + "', no parameter of this lesson",
                   (close.empty() ? "" : "'" + close + "' (did you mean that?), or ") +
                       std::string("a name that --list shows"));
}

std::string Lesson::settings() const {
  std::string text;
  for (std::size_t i = 0; i < parameters_.size(); ++i) {
    const auto& p = parameters_[i];
    if (p.get() != defaults_[i]) text += " --set " + p.name + "=" + value_text(p, p.get());
  }
  return text.empty() ? text : text.substr(1);
}

Picture Lesson::draw(Canvas& canvas) const {
  assert(current_ >= 0 && steps_[current_].fresh);
  constexpr double margin = 14, title_size = 21;
  const Step& s = steps_[current_];
  canvas.text({margin, margin}, std::to_string(current_ + 1) + "  " + s.title,
              {.size = title_size, .vertical = TextStyle::Vertical::top});
  Picture picture(canvas, {{0, 2 * margin + title_size}, {canvas.width(), canvas.height()}},
                  world_);
  s.draw(picture);
  if (picture.has_view() && s.hover) picture.hover(s.hover);
  return picture;
}

bool Lesson::quick() const {
  asked_quick_ = true;
  return quick_;
}

bool Lesson::coarse() const {
  return std::any_of(steps_.begin(), steps_.end(), [](const Step& s) { return s.coarse; });
}

void Lesson::refine() {
  bool stale = false;
  for (auto& s : steps_) {
    stale = stale || s.coarse;
    if (stale) s.fresh = s.coarse = false;
  }
  if (stale && current_ >= 0) show(current_);
}

}  // namespace sem
