#pragma once
// Steps beside the times that the paper prints.

#include "scenes.h"

namespace sem {

/// One of the paper's scenes, and a body of our own of its size. The last is the beam b10 of the
/// public reference implementation, measured on this kind of machine.
struct PublishedTime {
  std::string name;
  int n_unknowns;            ///< theirs
  double step;               ///< theirs, s
  double aim;                ///< theirs over ours
  double fill = 0;           ///< theirs, % of the stiffness; 0: not told
  double preprocessing = 0;  ///< theirs, s; 0: not told
  double preprocessing_aim = 0;
  SceneTime own = {};
};

/// Blocks of half a metre a patch and a metre thick or more, clamped at one face, under gravity: as
/// many control points as theirs but for 2 % (those clamped included), about 900 points; projected,
/// quadratic, linearly implicit Euler, one thread. Shapes differ from theirs; of the stiffness more
/// is non-zero where theirs is told.
std::vector<PublishedTime> time_published();

}  // namespace sem
