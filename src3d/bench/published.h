#pragma once
// Steps beside the times that the paper prints.

#include "scenes.h"

namespace sem {

/// One of the paper's scenes, and a body of our own of its size.
struct PublishedTime {
  std::string name;
  int n_unknowns;  ///< the paper's
  double step;     ///< the paper's, s
  double aim;      ///< ours over the paper's
  SceneTime own;
};

/// Blocks of half a metre a patch, clamped at one face, under gravity: as many control points as
/// the paper's scenes but for 2 % (those clamped included), about 900 points; projected, quadratic,
/// linearly implicit Euler, one thread. Their shapes and the non-zeros of their stiffness differ
/// from the paper's.
std::vector<PublishedTime> time_published();

}  // namespace sem
