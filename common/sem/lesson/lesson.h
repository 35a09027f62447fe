#pragma once
// A tutorial that one steps through: headless (text and a picture per step) or in a window.
//
//   int main(int argc, char** argv) {
//     Lesson lesson("Step 1: a NURBS curve and its Jacobian", world);
//     lesson.slider("degree", degree, 1, 5);   // belongs to the next step
//     lesson.handles("p", control_points);     // p1, p2, ...: can be dragged
//     lesson.step("The curve and its control points",
//                 [&](std::ostream& out) { ... compute; print the numbers with numbers.h ... },
//                 [&](Picture& picture) { ... draw what was computed ... },
//                 [&](const Vec<2>& X) { return "value at X: " + ...; });  // on hovering; or
//                 hover()
//     return lesson.run(argc, argv);
//   }
//
// A step is a function of its parameters and of what earlier steps left in captured variables. It
// computes its own variables anew each time it runs and leaves those of earlier steps (all that
// their pictures show) alone: then going back needs no computation and always shows the same.

#include <functional>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

#include "sem/lesson/numbers.h"
#include "sem/lesson/parameter.h"
#include "sem/lesson/picture.h"

namespace sem {

class Lesson {
 public:
  using Compute = std::function<void(std::ostream& out)>;
  using Draw = std::function<void(Picture& picture)>;
  using Hover = std::function<std::string(const Vec<2>& X)>;
  enum class Scale { linear, logarithmic };

  /// `world` is what pictures show unless a step sets another view.
  Lesson(std::string title, const Box<2>& world);
  Lesson(const Lesson&) = delete;
  Lesson& operator=(const Lesson&) = delete;

  // Parameters of the step registered next: changing one reruns that step and those after it. The
  // variable must outlive the lesson; the value it has now is the default. Names are what --set
  // takes: letters, digits, underscores, each once (assert). `help` is one short phrase with the
  // unit.
  void slider(const std::string& name, int& value, int lower, int upper,
              const std::string& help = "");
  void slider(const std::string& name, double& value, double lower, double upper,
              const std::string& help = "", Scale scale = Scale::linear);
  void toggle(const std::string& name, bool& value, const std::string& help = "");
  /// One of a few names; the value is the index of the name.
  void choice(const std::string& name, int& value, const std::vector<std::string>& names,
              const std::string& help = "");
  /// The same for an enumeration.
  template <class Enum>
  void choice(const std::string& name, Enum& value,
              const std::vector<std::pair<std::string, Enum>>& names, const std::string& help = "");
  /// Points that can be dragged in every picture from this step on that has a view: NAME1, NAME2,
  /// ... of the columns, or just NAME. They stay inside the lesson's world box. The number of
  /// columns is fixed.
  void handles(const std::string& name, Points<2>& points, const std::string& help = "");
  void handle(const std::string& name, Vec<2>& point, const std::string& help = "");

  /// Two angles in degrees that only pictures depend on, as sliders "turn" and "lift": where a
  /// camera stands. Changing them reruns nothing; dragging a picture beside its handles changes
  /// them too.
  void orbit(Vec<2>& angles);

  /// The next step. `compute` may throw InputError for parameters that make no sense together.
  /// `hover` is what the mouse reads in the picture's last view, as if given to Picture::hover
  /// last.
  void step(const std::string& title, Compute compute, Draw draw, Hover hover = nullptr);

  /// The program: reads the arguments (--help lists them), then steps through. Returns the exit
  /// code: 0, 2 for bad input, 1 for other errors; errors go to standard error.
  int run(int argc, char** argv);

  // The state of stepping, for panels and tests. Steps count from 0.
  const std::string& title() const { return title_; }
  const Box<2>& world() const { return world_; }
  int n_steps() const { return int(steps_.size()); }
  const std::string& step_title(int step) const { return steps_[step].title; }
  /// The step shown last; -1 before the first show(), or if only pictures depend on it.
  int current() const { return current_; }
  /// Makes the step current and runs what is out of date, from the first step to this one. If a
  /// step throws, the error passes through, the step is current and stays out of date.
  void show(int step);
  /// All parameters back to their defaults, first step shown; runs it anew.
  void reset();
  const std::vector<Parameter>& parameters() const { return parameters_; }
  /// Sets a parameter (clamped to its range) and runs its step and the later ones up to the current
  /// one; those after that run when they are shown next. Nothing runs if the value stays the same,
  /// or before the first show().
  void change(const Parameter& parameter, const Vec<2>& value);
  /// Sets "name=value". Throws InputError: no such name (with the closest one), or not allowed.
  void set(const std::string& assignment);
  /// The arguments --set that lead from the defaults to the present values.
  std::string settings() const;

  /// What the step printed, how often it ran, whether it is up to date.
  const std::string& numbers(int step) const { return steps_[step].numbers; }
  int n_runs(int step) const { return steps_[step].n_runs; }
  bool fresh(int step) const { return steps_[step].fresh; }
  /// Draws the current step with its title on a canvas and returns the picture, for its view and
  /// texts; the step is fresh.
  Picture draw(Canvas& canvas) const;

  /// Changes are quick while the reader drags: a step that takes long asks quick() and computes
  /// coarser. coarse(): whether a step did; refine() runs it and the later ones again.
  void set_quick(bool quick) { quick_ = quick; }
  bool quick() const;
  bool coarse() const;
  void refine();

 private:
  struct Step {
    std::string title;
    Compute compute;
    Draw draw;
    Hover hover;
    std::string numbers = {};
    int n_runs = 0;
    bool fresh = false, coarse = false;
  };
  void add(Parameter parameter);

  std::string title_;
  Box<2> world_;
  std::vector<Step> steps_;
  std::vector<Parameter> parameters_;
  std::vector<Vec<2>> defaults_;
  int current_ = -1;
  bool quick_ = false;
  mutable bool asked_quick_ = false;  ///< by the step that runs
};

template <class Enum>
void Lesson::choice(const std::string& name, Enum& value,
                    const std::vector<std::pair<std::string, Enum>>& names,
                    const std::string& help) {
  Parameter p;
  p.name = name;
  p.help = help;
  p.kind = Parameter::Kind::choice;
  for (const auto& [text, which] : names) p.choices.push_back(text);
  p.get = [&value, names] {
    int i = 0;
    while (i + 1 < int(names.size()) && names[i].second != value) ++i;
    return Vec<2>(i, 0);
  };
  p.set = [&value, names](const Vec<2>& v) { value = names[int(v[0])].second; };
  add(std::move(p));
}

}  // namespace sem
