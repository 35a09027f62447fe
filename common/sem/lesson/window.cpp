#include "sem/lesson/window.h"

#include "sem/base/error.h"
#include "sem/lesson/workbench.h"

#ifndef SEM_WINDOW

namespace sem {

void show_window(Workbench&, const std::string&, int) {
  throw InputError("", "--interactive", "a program built without a window",
                   "after installing libsdl2-dev and building again (CMake option SEM_WINDOW)");
}

}  // namespace sem

#else

#include <SDL.h>

namespace sem {
namespace {

/// SDL's video, the window and an image for its pixels; closed on destruction.
class Window {
 public:
  explicit Window(const std::string& title) {
    // Plain X11 or Wayland buffers: SDL's own OpenGL would meet the off-screen OpenGL.
    SDL_SetHint(SDL_HINT_FRAMEBUFFER_ACCELERATION, "0");
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    if (SDL_Init(SDL_INIT_VIDEO) != 0) fail(SDL_GetError());
    // Without a display SDL falls back to drivers that nobody sees; asked for, they are right.
    const std::string driver = SDL_GetCurrentVideoDriver();
    if (!SDL_getenv("SDL_VIDEODRIVER") && (driver == "offscreen" || driver == "dummy"))
      fail("no display found");
    window_ = SDL_CreateWindow(title.c_str(), SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                               Workbench::width, Workbench::height, 0);
    if (!window_) fail(SDL_GetError());
  }
  ~Window() {
    SDL_FreeSurface(pixels_);
    SDL_DestroyWindow(window_);
    SDL_Quit();
  }
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  void show(const Image& image) {
    SDL_FreeSurface(pixels_);
    pixels_ = SDL_CreateRGBSurfaceWithFormatFrom(const_cast<std::uint8_t*>(image.rgb.data()),
                                                 image.width, image.height, 24, 3 * image.width,
                                                 SDL_PIXELFORMAT_RGB24);
    SDL_Surface* const surface = SDL_GetWindowSurface(window_);
    if (!pixels_ || !surface) fail(SDL_GetError());
    SDL_SetSurfaceBlendMode(pixels_, SDL_BLENDMODE_NONE);
    if (SDL_BlitSurface(pixels_, nullptr, surface, nullptr) != 0) fail(SDL_GetError());
    if (SDL_UpdateWindowSurface(window_) != 0) fail(SDL_GetError());
  }

 private:
  [[noreturn]] static void fail(const std::string& what) {
    SDL_Quit();
    throw InputError("", "--interactive", "no window: " + what,
                     "a display (X11 or Wayland); without one leave --interactive away");
  }
  SDL_Window* window_ = nullptr;
  SDL_Surface* pixels_ = nullptr;
};

void translate_key(SDL_Keycode code, Input& input) {
  using Key = Input::Key;
  constexpr std::pair<SDL_Keycode, Key> keys[] = {
      {SDLK_RIGHT, Key::right}, {SDLK_LEFT, Key::left}, {SDLK_n, Key::n},
      {SDLK_b, Key::b},         {SDLK_r, Key::r},       {SDLK_ESCAPE, Key::escape}};
  for (const auto& [sdl, key] : keys)
    if (sdl == code) input.keys.push_back(key);
}

/// Takes one event over; false if a frame has to be made before the next one is taken.
bool translate(const SDL_Event& event, Input& input, bool& closed) {
  switch (event.type) {
    case SDL_QUIT:
      closed = true;
      return false;
    case SDL_KEYDOWN:
      translate_key(event.key.keysym.sym, input);
      return true;
    case SDL_MOUSEMOTION:
      input.mouse = {double(event.motion.x), double(event.motion.y)};
      return true;
    case SDL_MOUSEWHEEL:
      input.wheel += event.wheel.y;
      return true;
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP:
      if (event.button.button != SDL_BUTTON_LEFT) return true;
      input.mouse = {double(event.button.x), double(event.button.y)};
      input.button = event.type == SDL_MOUSEBUTTONDOWN;
      return false;
    case SDL_WINDOWEVENT:
      if (event.window.event == SDL_WINDOWEVENT_LEAVE) input.mouse = {-1, -1};
      return true;
    default:
      return true;
  }
}

}  // namespace

void show_window(Workbench& workbench, const std::string& title, int n_frames) {
  Window window(title);
  Input input;
  bool closed = false;
  int n_quiet = 0;
  for (int frame = 0; !closed && !workbench.quit() && (n_frames == 0 || frame < n_frames);
       ++frame) {
    window.show(workbench.frame(input));
    input.keys.clear();
    input.wheel = 0;
    // Tooltips and the picture after a drag take a few frames without an event; then it rests.
    SDL_Event event;
    if (!SDL_WaitEventTimeout(&event, n_frames > 0 || n_quiet < 4 ? 20 : -1)) {
      ++n_quiet;
      continue;
    }
    n_quiet = 0;
    while (translate(event, input, closed) && SDL_PollEvent(&event)) {
    }
  }
}

}  // namespace sem

#endif
