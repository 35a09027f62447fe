#pragma once
// What a scene is asked for that a program makes of a file with nothing but solids in it.

#include <string>

namespace sem {

struct BareScene {
  std::string pin = "bottom";  ///< what is held: a side, a box "x0,y0,z0,x1,y1,z1" (m), or none
  std::string material = "rubber";  ///< rubber, jelly or steel
  double scale = 1;                 ///< of the file's lengths in m, > 0
};

}  // namespace sem
