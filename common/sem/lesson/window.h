#pragma once
// The only file pair that knows of SDL.

#include <string>

namespace sem {

class Workbench;

/// Shows the workbench in a window until it is closed, or for n_frames frames if that is positive.
/// Throws InputError if the program was built without a window (SEM_WINDOW) or no display is there.
void show_window(Workbench& workbench, const std::string& title, int n_frames = 0);

}  // namespace sem
