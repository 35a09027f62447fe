// The real window, on a display in memory.
#include <doctest/doctest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <thread>

#include "folder.h"
#include "sem/lesson/window.h"
#include "sem/lesson/workbench.h"
#include "small_lesson.h"

using namespace sem;
using sem::test::content;

namespace {

constexpr int screen_width = 1400, screen_height = 700;

/// Xvfb on a free display, with its screen in a file of the folder; ended on destruction.
class Display {
 public:
  explicit Display(const std::string& folder) : folder_(folder) {
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    process_ = fork();
    if (process_ == 0) {
      const std::string file = std::to_string(ends[1]);
      execl(SEM_XVFB, "Xvfb", "-displayfd", file.c_str(), "-screen", "0", "1400x700x24",
            "-nolisten", "tcp", "-fbdir", folder.c_str(), static_cast<char*>(nullptr));
      _exit(127);
    }
    close(ends[1]);
    char number[16] = {};
    started = read(ends[0], number, sizeof number - 1) > 0;  // waits until it is ready
    close(ends[0]);
    name = ":" + std::to_string(std::atoi(number));
  }
  ~Display() {
    kill(process_, SIGTERM);
    waitpid(process_, nullptr, 0);
  }
  /// What the screen shows (an X window dump: 100 bytes of big-endian numbers, a name, a colour
  /// map, then 4 bytes a pixel: blue, green, red, nothing).
  Image screen() const {
    const std::string dump = content(folder_ + "/Xvfb_screen0");
    const auto number = [&](int i) {
      unsigned value = 0;
      for (int k = 0; k < 4; ++k) value = 256 * value + std::uint8_t(dump[4 * i + k]);
      return value;
    };
    const std::size_t size = std::size_t(4) * screen_width * screen_height;
    REQUIRE(dump.size() >= size);
    const std::size_t start = number(0) + 12 * number(19);
    REQUIRE(dump.size() >= start + size);
    Image image(screen_width, screen_height);
    for (std::size_t i = 0; i < size / 4; ++i)
      for (int channel = 0; channel < 3; ++channel)
        image.rgb[3 * i + channel] = std::uint8_t(dump[start + 4 * i + 2 - channel]);
    return image;
  }

  std::string name;
  bool started = false;

 private:
  std::string folder_;
  pid_t process_ = 0;
};

/// The middle of the screen, where the window is put.
Image middle(const Image& screen) {
  Image image(Workbench::width, Workbench::height);
  const int left = (screen.width - image.width) / 2, top = (screen.height - image.height) / 2;
  for (int row = 0; row < image.height; ++row)
    std::copy_n(screen.pixel(left, top + row), 3 * image.width, image.pixel(0, row));
  return image;
}

}  // namespace

TEST_CASE("the window shows the workbench's pixels, all of them the same") {
  if (!SEM_HAS_WINDOW || std::string(SEM_XVFB).empty()) {
    MESSAGE("skipped: needs libsdl2-dev at build time and Xvfb");
    return;
  }
  const test::Folder folder("lesson_window");
  const Display display(folder.path());
  REQUIRE(display.started);
  setenv("DISPLAY", display.name.c_str(), 1);
  setenv("SDL_VIDEODRIVER", "x11", 1);
  const auto still = [] { return 0.0; };
  Image expected;
  {
    test::SmallLesson small;
    Workbench workbench(small.lesson, still);
    // The display's pointer starts in the middle of the screen, so the workbench tells its place.
    Input input;
    input.mouse = {Workbench::width / 2., Workbench::height / 2.};
    for (int frame = 0; frame < 6; ++frame) expected = workbench.frame(input);
  }
  std::string error;
  std::atomic<bool> closed = false;
  std::thread window([&] {
    try {
      test::SmallLesson small;
      Workbench workbench(small.lesson, still);
      show_window(workbench, "A small lesson", 100);
    } catch (const std::exception& e) {
      error = e.what();
    }
    closed = true;
  });
  bool seen = false;
  while (!closed && !seen) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    seen = middle(display.screen()).rgb == expected.rgb;
  }
  window.join();
  CHECK(error == "");
  CHECK(seen);
}

#if SEM_HAS_WINDOW
TEST_CASE("without a display the window says so") {
  test::SmallLesson small;
  Workbench workbench(small.lesson);
  setenv("DISPLAY", ":987654", 1);
  setenv("SDL_VIDEODRIVER", "x11", 1);
  CHECK_THROWS_WITH_AS(show_window(workbench, "title", 1),
                       doctest::Contains("without one leave --interactive away"),
                       std::runtime_error);
}
#endif
