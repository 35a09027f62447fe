#include "sem/lesson/workbench.h"

#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <map>
#include <optional>

#include "sem/base/error.h"
#include "sem/draw/raster.h"
#include "sem/lesson/imgui_screen.h"
#include "sem/lesson/lesson.h"

namespace sem {
namespace {

using Kind = Parameter::Kind;

double steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

constexpr double ring_radius = 9, grab_radius = 14;  // pixels, of handles
constexpr ImGuiWindowFlags fixed_window = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                          ImGuiWindowFlags_NoBringToFrontOnFocus |
                                          ImGuiWindowFlags_NoSavedSettings;

}  // namespace

struct Workbench::Impl {
  Lesson& lesson;
  std::function<double()> clock;
  ImguiScreen screen{width, height};
  RasterCanvas fine{picture_width, picture_height, 2}, quick{picture_width, picture_height, 1};
  Image picture;
  std::optional<Picture> drawn;  // the picture's view and texts; none while the step has an error
  bool outdated = true;          // the picture
  bool drawn_quick = false;
  double compute_seconds = 0, draw_seconds = 0;
  std::string error, hover_text;
  std::map<std::string, Box<2>> places;
  int dragged = -1;   // parameter
  Vec<2> grab{0, 0};  // from the mouse to the dragged handle, pixels
  std::optional<Vec<2>> orbit_from;  // the mouse, while it turns the camera
  bool was_down = false, quit = false;

  Impl(Lesson& l, std::function<double()> c) : lesson(l), clock(std::move(c)) {
    act([&] { lesson.show(std::max(0, lesson.current())); });
  }

  /// Does something to the lesson: measures it, keeps its error, lets the picture follow.
  void act(const std::function<void()>& what) {
    const double start = clock();
    error.clear();
    try {
      what();
    } catch (const std::exception& e) {
      error = e.what();
    }
    compute_seconds = clock() - start;
    outdated = true;
  }

  void go(int step) {
    if (step >= 0 && step < lesson.n_steps()) act([&] { lesson.show(step); });
  }
  void next() { go(lesson.current() + 1); }
  void back() { go(lesson.current() - 1); }
  void reset() {
    act([&] { lesson.reset(); });
  }

  void press(Input::Key key) {
    using Key = Input::Key;
    switch (key) {
      case Key::right:
      case Key::n:
        return next();
      case Key::left:
      case Key::b:
        return back();
      case Key::r:
        return reset();
      case Key::escape:
        quit = true;
    }
  }

  /// Remembers where the widget made last is.
  void place(const std::string& name) {
    const ImVec2 lower = ImGui::GetItemRectMin(), upper = ImGui::GetItemRectMax();
    places[name] = {{lower.x, lower.y}, {upper.x, upper.y}};
  }

  bool button(const char* name, bool enabled) {
    ImGui::BeginDisabled(!enabled);
    const bool pressed = ImGui::Button(name, {120, 34});
    ImGui::EndDisabled();
    place(name);
    return pressed;
  }

  /// Whether the reader changed the value.
  bool widget(const Parameter& p, Vec<2>& value) {
    const char* const name = p.name.c_str();
    switch (p.kind) {
      case Kind::integer: {
        int v = int(value[0]);
        const bool changed = ImGui::SliderInt(name, &v, int(p.lower[0]), int(p.upper[0]), "%d",
                                              ImGuiSliderFlags_NoInput);
        value[0] = v;
        return changed;
      }
      case Kind::real:
        return ImGui::SliderScalar(
            name, ImGuiDataType_Double, &value[0], &p.lower[0], &p.upper[0], "%.4g",
            ImGuiSliderFlags_NoInput | (p.logarithmic ? ImGuiSliderFlags_Logarithmic : 0));
      case Kind::toggle: {
        bool v = value[0] != 0;
        const bool changed = ImGui::Checkbox(name, &v);
        value[0] = v;
        return changed;
      }
      case Kind::choice: {
        bool changed = false;
        if (!ImGui::BeginCombo(name, p.choices[int(value[0])].c_str())) break;
        for (int i = 0; i < int(p.choices.size()); ++i) {
          if (ImGui::Selectable(p.choices[i].c_str(), i == int(value[0]))) {
            value[0] = i;
            changed = true;
          }
          place(p.name + "=" + p.choices[i]);
        }
        ImGui::EndCombo();
        return changed;
      }
      case Kind::point:
        break;
    }
    return false;
  }

  void parameters() {
    for (const auto& p : lesson.parameters()) {
      if (p.kind == Kind::point || p.step > lesson.current()) continue;
      Vec<2> value = p.get();
      const bool changed = widget(p, value);
      if (p.kind != Kind::choice || !ImGui::IsPopupOpen(p.name.c_str())) place(p.name);
      if (!p.help.empty() && ImGui::IsItemHovered() && !ImGui::IsItemActive())
        ImGui::SetTooltip("%s (step %d)", p.help.c_str(), p.step + 1);
      lesson.set_quick(ImGui::IsItemActive());
      if (changed) act([&] { lesson.change(p, value); });
    }
  }

  void numbers() {
    const float height = std::max(160.0f, ImGui::GetContentRegionAvail().y - 28);
    ImGui::PushFont(screen.mono_font);
    ImGui::BeginChild("numbers", {0, height}, true, ImGuiWindowFlags_HorizontalScrollbar);
    const int step = lesson.current();
    if (!error.empty()) {
      ImGui::PushStyleColor(ImGuiCol_Text, {0.75f, 0, 0, 1});
      ImGui::TextWrapped("%s", error.c_str());
      ImGui::PopStyleColor();
    } else {
      ImGui::TextUnformatted(lesson.numbers(step).c_str());
    }
    ImGui::EndChild();
    ImGui::PopFont();
    place("numbers");
  }

  void panel() {
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({panel_width, height});
    ImGui::Begin("panel", nullptr, fixed_window & ~ImGuiWindowFlags_NoScrollbar);
    ImGui::PushFont(screen.large_font);
    ImGui::TextWrapped("%s", lesson.title().c_str());
    ImGui::PopFont();
    ImGui::Spacing();
    const int step = lesson.current();
    ImGui::TextWrapped("%d of %d   %s", step + 1, lesson.n_steps(),
                       lesson.step_title(step).c_str());
    ImGui::Spacing();
    const bool to_next = button("Next", step + 1 < lesson.n_steps());
    ImGui::SameLine();
    const bool to_back = button("Back", step > 0);
    ImGui::SameLine();
    const bool to_reset = button("Reset", true);
    ImGui::Spacing();
    ImGui::PushItemWidth(230);
    parameters();
    ImGui::PopItemWidth();
    ImGui::Spacing();
    if (to_next) next();
    if (to_back) back();
    if (to_reset) reset();
    numbers();
    ImGui::Text("computed in %.1f ms, drawn in %.0f ms", 1e3 * compute_seconds, 1e3 * draw_seconds);
    ImGui::End();
  }

  Vec<2> ring(const Parameter& p) { return Vec<2>(panel_width, 0) + drawn->view().map(p.get()); }

  /// Handles that the picture shows.
  std::vector<int> handles() {
    std::vector<int> shown;
    if (!drawn || !drawn->has_view()) return shown;
    const auto& all = lesson.parameters();
    for (int i = 0; i < int(all.size()); ++i)
      if (all[i].kind == Kind::point && all[i].step <= lesson.current()) shown.push_back(i);
    return shown;
  }

  int handle_near(const Vec<2>& mouse) {
    int best = -1;
    double least = grab_radius;
    for (int i : handles()) {
      const double distance = (ring(lesson.parameters()[i]) - mouse).norm();
      if (distance < least) {
        least = distance;
        best = i;
      }
    }
    return best;
  }

  void drag(const Vec<2>& mouse, bool pressed, bool down) {
    if (pressed) {
      dragged = handle_near(mouse);
      if (dragged >= 0) grab = ring(lesson.parameters()[dragged]) - mouse;
    }
    if (!down) dragged = -1;
    if (dragged < 0 || !drawn) return;
    const Parameter& p = lesson.parameters()[dragged];
    const Vec<2> target = mouse + grab;
    // A still mouse leaves the point where it is, to the last bit.
    if ((target - ring(p)).norm() < 0.25) return;
    // Few decimals, about half a pixel, so that --set can repeat the value.
    const double unit = std::pow(10, std::ceil(std::log10(2 * drawn->view().scale())));
    const Vec<2> X = drawn->to_world(target - Vec<2>(panel_width, 0));
    lesson.set_quick(true);
    act([&] { lesson.change(p, (X * unit).array().round() / unit); });
  }

  /// Beside the handles the mouse turns the camera: half a degree a pixel.
  void orbit(const Vec<2>& mouse, bool pressed, bool down) {
    if (pressed && dragged < 0) orbit_from = mouse;
    if (!down) orbit_from.reset();
    if (!orbit_from || mouse == *orbit_from) return;
    const Vec<2> moved = mouse - *orbit_from;
    orbit_from = mouse;
    int axis = 0;
    for (const auto& p : lesson.parameters()) {
      if (!p.drawn_only) continue;
      Vec<2> value = p.get();
      value[0] += (axis == 0 ? -0.5 : 0.5) * moved[axis];
      if (axis++ == 0) value[0] = std::remainder(value[0], 360);
      act([&] { lesson.change(p, value); });
    }
  }

  void draw_picture(bool use_quick) {
    const double start = clock();
    RasterCanvas& canvas = use_quick ? quick : fine;
    canvas.clear();
    if (error.empty()) {
      drawn.emplace(lesson.draw(canvas));
    } else {
      if (dragged < 0) drawn.reset();  // a drag goes on, so that it can be led out of the error
      canvas.text({14, 14}, "No picture: see the message on the left",
                  {.size = 21, .vertical = TextStyle::Vertical::top});
    }
    picture = canvas.finish();
    screen.upload(picture);
    draw_seconds = clock() - start;
    outdated = false;
    drawn_quick = use_quick;
  }

  void rings(const Vec<2>& mouse) {
    const int near = dragged >= 0 ? dragged : handle_near(mouse);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (int i : handles()) {
      const Parameter& p = lesson.parameters()[i];
      const Vec<2> at = ring(p), r(ring_radius, ring_radius);
      places[p.name] = {at - r, at + r};
      const ImU32 color = i == near ? IM_COL32(213, 94, 0, 255) : IM_COL32(128, 128, 128, 255);
      list.AddCircle({float(at[0]), float(at[1])}, float(ring_radius), color, 32,
                     i == near ? 3.0f : 1.5f);
    }
  }

  void picture_window(const Input& input) {
    ImGui::SetNextWindowPos({panel_width, 0});
    ImGui::SetNextWindowSize({picture_width, picture_height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::Begin("picture", nullptr, fixed_window | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleVar();
    ImGui::InvisibleButton("picture", {picture_width, picture_height});
    place("picture");
    const bool hovered = ImGui::IsItemHovered();
    drag(input.mouse, input.button && !was_down && hovered, input.button);
    orbit(input.mouse, input.button && !was_down && hovered, input.button);
    const bool moving = input.button && (dragged >= 0 || ImGui::IsAnyItemActive());
    lesson.set_quick(moving);
    if (!moving && lesson.coarse()) act([&] { lesson.refine(); });
    if (outdated || (drawn_quick && !moving)) draw_picture(moving);
    screen.activate();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddImage(screen.picture_id(), {panel_width, 0}, {width, height});
    rings(input.mouse);
    hover_text.clear();
    if (hovered && drawn && error.empty())
      hover_text = drawn->text_at(input.mouse - Vec<2>(panel_width, 0));
    ImGui::End();
    if (!hover_text.empty()) ImGui::SetTooltip("%s", hover_text.c_str());
  }

  const Image& frame(const Input& input) {
    for (auto key : input.keys) press(key);
    places.clear();
    screen.begin(input);
    panel();
    picture_window(input);
    was_down = input.button;
    return screen.end();
  }
};

Workbench::Workbench(Lesson& lesson) : Workbench(lesson, steady_seconds) {}
Workbench::Workbench(Lesson& lesson, std::function<double()> clock)
    : impl_(new Impl(lesson, std::move(clock))) {}
Workbench::~Workbench() = default;

const Image& Workbench::frame(const Input& input) { return impl_->frame(input); }
bool Workbench::quit() const { return impl_->quit; }
const Image& Workbench::picture() const { return impl_->picture; }
const std::string& Workbench::error() const { return impl_->error; }
const std::string& Workbench::hover_text() const { return impl_->hover_text; }

Box<2> Workbench::place(const std::string& widget) const {
  const auto found = impl_->places.find(widget);
  return found == impl_->places.end() ? Box<2>{} : found->second;
}

}  // namespace sem
