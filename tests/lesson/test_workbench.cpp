// The panel, driven by made-up mouse and keys.
#include <doctest/doctest.h>

#include "sem/draw/raster.h"
#include "sem/lesson/workbench.h"
#include "small_lesson.h"

using namespace sem;
using sem::test::SmallLesson;
using Key = Input::Key;

namespace {

bool shown(const Box<2>& box) { return box.lower[0] < box.upper[0]; }

/// A workbench with a clock that stands still, and a hand on mouse and keyboard.
struct Desk {
  SmallLesson small;
  Workbench workbench{small.lesson, [] { return 0.0; }};
  Input input;

  Desk() { frame(); }

  const Image& frame() {
    const Image& image = workbench.frame(input);
    input.keys.clear();
    input.wheel = 0;
    return image;
  }
  void press(Key key) {
    input.keys = {key};
    frame();
    frame();
  }
  Vec<2> center(const std::string& widget) {
    const Box<2> box = workbench.place(widget);
    REQUIRE(shown(box));
    return (box.lower + box.upper) / 2;
  }
  void move(const Vec<2>& to) {
    input.mouse = to;
    frame();
  }
  void button(bool down) {
    input.button = down;
    frame();
  }
  void click(const std::string& widget) {
    move(center(widget));
    button(true);
    button(false);
    frame();
  }
  /// Presses at one place, moves, releases at the other.
  void drag(const Vec<2>& from, const Vec<2>& to) {
    move(from);
    button(true);
    move((from + to) / 2);
    move(to);
    button(false);
  }
  int n_runs() {
    int n = 0;
    for (int i = 0; i < small.lesson.n_steps(); ++i) n += small.lesson.n_runs(i);
    return n;
  }
};

bool same(const Image& a, const Image& b) { return a.width == b.width && a.rgb == b.rgb; }

Image crop(const Image& image, int left) {
  Image part(image.width - left, image.height);
  for (int row = 0; row < part.height; ++row)
    std::copy_n(image.pixel(left, row), 3 * part.width, part.pixel(0, row));
  return part;
}

}  // namespace

TEST_CASE("buttons and keys step forth and back and stop at the ends") {
  Desk desk;
  Lesson& lesson = desk.small.lesson;
  CHECK(lesson.current() == 0);
  desk.click("Back");
  CHECK(lesson.current() == 0);
  desk.click("Next");
  CHECK(lesson.current() == 1);
  desk.press(Key::right);
  CHECK(lesson.current() == 2);
  desk.press(Key::n);
  desk.click("Next");
  CHECK(lesson.current() == 2);
  desk.press(Key::left);
  CHECK(lesson.current() == 1);
  desk.press(Key::b);
  CHECK(lesson.current() == 0);
  CHECK(desk.n_runs() == 3);
  CHECK(!desk.workbench.quit());
  desk.press(Key::escape);
  CHECK(desk.workbench.quit());
}

TEST_CASE("the panel shows the parameters of the steps up to the current one") {
  Desk desk;
  CHECK(shown(desk.workbench.place("a")));
  CHECK(!shown(desk.workbench.place("k")));
  CHECK(!shown(desk.workbench.place("method")));
  desk.click("Next");
  desk.frame();
  CHECK(shown(desk.workbench.place("a")));
  CHECK(shown(desk.workbench.place("k")));
  CHECK(!shown(desk.workbench.place("method")));
}

TEST_CASE("dragging a slider reruns only what depends on it") {
  Desk desk;
  const Lesson& lesson = desk.small.lesson;
  desk.press(Key::n);
  const Box<2> k = desk.workbench.place("k");
  desk.drag({k.lower[0] + 20, desk.center("k")[1]}, {k.lower[0] + 225, desk.center("k")[1]});
  CHECK(desk.small.k == 5);
  CHECK(lesson.numbers(1) == "sum 7\n");
  CHECK(lesson.n_runs(0) == 1);
  const int before = lesson.n_runs(1);
  CHECK(before > 1);
  const Box<2> a = desk.workbench.place("a");
  desk.drag({a.lower[0] + 115, desk.center("a")[1]}, {a.lower[0] - 50, desk.center("a")[1]});
  CHECK(desk.small.a == 0);
  CHECK(lesson.numbers(1) == "sum 5\n");
  CHECK(lesson.n_runs(1) - before == lesson.n_runs(0) - 1);
  CHECK(lesson.n_runs(2) == 0);
}

TEST_CASE("a logarithmic slider has the geometric mean in its middle") {
  Desk desk;
  const Box<2> b = desk.workbench.place("b");
  desk.drag({b.lower[0] + 10, desk.center("b")[1]}, {b.lower[0] + 115, desk.center("b")[1]});
  CHECK(desk.small.b == doctest::Approx(10).epsilon(0.1));
}

TEST_CASE("a choice is made from its list, a switch by a click") {
  Desk desk;
  desk.press(Key::n);
  desk.press(Key::n);
  desk.click("method");
  desk.frame();
  desk.click("method=second");
  CHECK(desk.small.method == 2);
  CHECK(desk.small.lesson.numbers(2) == "method 2\n");
}

TEST_CASE("a handle follows the mouse, and the picture and the numbers follow it") {
  Desk desk;
  const Image before = desk.workbench.picture();
  const Vec<2> at = desk.center("corner");
  desk.move(at + Vec<2>(3, 2));  // not exactly in its middle: it must not jump
  desk.button(true);
  CHECK(desk.small.corner == Vec<2>(1, 1));
  desk.move(at + Vec<2>(103, 2));
  const double pixels_per_unit = 100 / (desk.small.corner[0] - 1);
  CHECK(desk.small.corner[1] == doctest::Approx(1).epsilon(1e-12));
  // 2 of the world's height fill the picture below its title.
  CHECK(pixels_per_unit == doctest::Approx((Workbench::height - 49) / 2.0).epsilon(0.01));
  CHECK(desk.small.lesson.numbers(0) == "product " + rounded(2 * desk.small.corner[0]) + "\n");
  CHECK(desk.center("corner")[0] == doctest::Approx(at[0] + 100).epsilon(0.001));
  const Image quick = desk.workbench.picture();
  desk.button(false);
  const Image fine = desk.workbench.picture();
  CHECK(!same(quick, before));
  CHECK(!same(fine, quick));  // supersampled again
  desk.drag(desk.center("corner"), {Workbench::width + 500, 300});
  CHECK(desk.small.corner[0] == 3);  // stays in the world box
  const int n_runs = desk.n_runs();
  desk.move({700, 500});
  CHECK(desk.n_runs() == n_runs);  // released
}

TEST_CASE("pressing a still handle changes nothing, beside it neither") {
  Desk desk;
  desk.drag(desk.center("corner"), desk.center("corner"));
  desk.drag(desk.center("corner") + Vec<2>(40, 0), desk.center("corner") + Vec<2>(90, 0));
  CHECK(desk.small.corner == Vec<2>(1, 1));
  CHECK(desk.n_runs() == 1);
}

TEST_CASE(
    "hovering a picture that has a view shows the value there; plots and the panel have none") {
  Desk desk;
  const Vec<2> at = desk.center("corner");
  const Image bare = desk.frame();
  desk.move(at);
  CHECK(desk.workbench.hover_text() == "at 1, 1");
  CHECK(!same(desk.frame(), bare));
  CHECK(same(desk.workbench.picture(), crop(bare, Workbench::panel_width)) == false);  // rings
  desk.move(desk.center("numbers"));
  CHECK(desk.workbench.hover_text() == "");
  desk.press(Key::n);  // its picture is drawn in pixels
  desk.move(at);
  CHECK(desk.workbench.hover_text() == "");
  CHECK(!shown(desk.workbench.place("corner")));
}

TEST_CASE("back and reset restore numbers and pixels exactly") {
  Desk desk;
  desk.move({5, 590});
  const Image first = desk.frame();
  const std::string numbers = desk.small.lesson.numbers(0);
  desk.press(Key::n);
  const Image second = desk.frame();
  desk.press(Key::n);
  desk.press(Key::b);
  CHECK(same(desk.frame(), second));
  desk.press(Key::b);
  CHECK(same(desk.frame(), first));
  desk.press(Key::n);
  const Box<2> k = desk.workbench.place("k");
  desk.drag({k.lower[0] + 20, desk.center("k")[1]}, {k.lower[0] + 225, desk.center("k")[1]});
  desk.press(Key::b);
  desk.drag(desk.center("corner"), desk.center("corner") + Vec<2>(40, 30));
  CHECK(!same(desk.frame(), first));
  desk.click("Reset");
  desk.move({5, 590});
  CHECK(same(desk.frame(), first));
  CHECK(desk.small.lesson.numbers(0) == numbers);
  desk.press(Key::n);
  CHECK(same(desk.frame(), second));
}

TEST_CASE("the same input gives the same pixels") {
  const auto play = [](Desk& desk) {
    desk.press(Key::n);
    desk.press(Key::b);
    desk.drag(desk.center("corner"), desk.center("corner") + Vec<2>(60, -30));
    desk.move(desk.center("corner"));
    return desk.frame();
  };
  Desk one, other;
  const Image a = play(one);
  CHECK(same(a, play(other)));
}

TEST_CASE("the panel shows the very pixels of a headless picture") {
  Desk desk;
  desk.press(Key::n);
  desk.press(Key::n);  // no handles drawn over it
  RasterCanvas canvas(Workbench::picture_width, Workbench::picture_height, 2);
  desk.small.lesson.draw(canvas);
  const Image headless = canvas.finish();
  CHECK(same(headless, desk.workbench.picture()));
  CHECK(same(headless, crop(desk.frame(), Workbench::panel_width)));
}

TEST_CASE("an error of a step is shown in place of its numbers, and can be left") {
  Desk desk;
  desk.press(Key::n);
  desk.click("fail");
  CHECK(desk.workbench.error() == "failed as asked");
  desk.press(Key::n);
  CHECK(desk.workbench.error() == "failed as asked");
  desk.press(Key::r);
  CHECK(desk.workbench.error() == "");
  CHECK(desk.small.lesson.current() == 0);
  CHECK(!desk.small.fail);
}

TEST_CASE("a drag beside the handles turns the camera and reruns no step") {
  Desk desk;
  Vec<2> angles(30, 20);
  desk.small.lesson.orbit(angles);
  const Vec<2> middle = desk.center("picture");
  const int n_runs = desk.n_runs(), n_draws = desk.small.n_draws;
  desk.drag(middle, middle + Vec<2>(40, -20));
  CHECK(angles == Vec<2>(10, 10));
  CHECK(desk.n_runs() == n_runs);
  CHECK(desk.small.n_draws > n_draws);
  CHECK(desk.small.lesson.settings() == "--set turn=10 --set lift=10");
  // A handle that is dragged does not.
  const Vec<2> handle = desk.center("corner");
  desk.drag(handle, handle + Vec<2>(30, 0));
  CHECK(angles == Vec<2>(10, 10));
  CHECK(desk.n_runs() > n_runs);
}
