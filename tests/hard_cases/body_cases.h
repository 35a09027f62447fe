#pragma once
// Cases that are a body and the checks of body_checks.h, in both dimensions and formulations.

#include <tuple>

#include "tests/hard_cases/body_checks.h"

namespace sem::stability {

template <int Dim>
using BodyChange = std::function<Body<Dim>(const Body<Dim>&)>;

/// One definition of a case. `method` changes the options of scene_of, `change` the body.
struct BodyCase {
  std::string name;
  PlaneShape shape;
  Rule rule = Rule::must_solve;
  Bounds bounds = {};
  bool fast = false;     ///< in 2D
  bool fast_3d = false;
  std::function<void(MethodOptions&)> method = {};
  std::tuple<BodyChange<2>, BodyChange<3>> change = {};
  bool as_unchanged = false;  ///< the displacement by size has to be that of the body before the change
};

/// Appends the case for both dimensions (2D alone if the shape has no cells) and formulations.
void add_body_case(std::vector<Case>& cases, const std::string& group, const BodyCase& one);

/// The case with a body changed by a function for both dimensions; its size, scaled out, must not matter.
template <class Change>
BodyCase changed_by(BodyCase one, const Change& change) {
  one.change = {change, change};
  one.as_unchanged = true;
  return one;
}

}  // namespace sem::stability
