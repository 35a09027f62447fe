#pragma once
// The interactive panel of a lesson, without a window: input in, image out. A window only
// translates its events to Input and shows the image; tests make up the Input.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sem/base/dim.h"
#include "sem/draw/image.h"

namespace sem {

class Lesson;

/// The state of mouse and keyboard in one frame. A click takes two frames: pressed, released.
struct Input {
  enum class Key { right, left, n, b, r, escape };
  Vec<2> mouse{-1, -1};   ///< pixels of the image, from its top left corner
  bool button = false;    ///< left mouse button is down
  double wheel = 0;       ///< notches since the last frame, up is positive
  std::vector<Key> keys;  ///< pressed since the last frame
};

/// Left the panel (Dear ImGui): Next, Back, Reset, parameters of the steps shown so far, numbers;
/// right the picture of the current step, the pixels that a headless run writes. Hovering the
/// picture shows the step's hover text; a handle follows the mouse while the button is down, drawn
/// without supersampling. Keys: right or n next, left or b back, r reset, escape quits.
class Workbench {
 public:
  static constexpr int panel_width = 420, picture_width = 900, picture_height = 600;
  static constexpr int width = panel_width + picture_width, height = picture_height;

  /// Shows the first step (or the current one). `clock` gives seconds; its differences are shown as
  /// the cost of the last recompute and picture.
  explicit Workbench(Lesson& lesson);
  Workbench(Lesson& lesson, std::function<double()> clock);
  ~Workbench();

  /// Handles the input and draws a frame. The same inputs give the same images (costs apart).
  const Image& frame(const Input& input);
  /// Whether escape was pressed.
  bool quit() const;
  /// The pixels that a widget took in the last frame: "Next", "Back", "Reset", "numbers",
  /// "picture", a parameter's name (handles: the ring). Not shown there: an empty box.
  Box<2> place(const std::string& widget) const;
  /// The picture alone, as drawn last.
  const Image& picture() const;
  /// Error of the current step or empty; and the hover text shown in the last frame or empty.
  const std::string& error() const;
  const std::string& hover_text() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sem
