#pragma once
// What is the same in all frames of a run: the box they show and the stress that ends the colour
// scale. Both follow from the scene alone, so a run that is resumed draws the same frames.

#include "sem/scene/model.h"

namespace sem {

/// The scene's output.view, or else room for the motion to be expected, m. Statics and modes: the
/// rest shape with a margin. Dynamics without pins: the rest shape along its ballistic path. With
/// pins that hold a region: a wide margin. Hung by a point: all that it can reach when it turns
/// about it, no higher than at rest.
Box<2> view_box(const Scene<2>& scene, const Model<2>& model);

/// A stress that most of the body stays below in a dynamic run, as long as it is not far from
/// linear, Pa: twice the von Mises stress that 2 % of the points exceed in the linear static answer
/// to loads and prescribed displacements, plus half the density times the velocity squared of an
/// initial spin. 0 if nothing acts.
double expected_stress(const Model<2>& model);

/// Von Mises stress of plane strain at every quadrature point, Pa; the stress across the plane is
/// taken to first order, nu (s_xx + s_yy). NaN where the material is inverted and has no stress.
Eigen::VectorXd von_mises(const Model<2>& model, const Eigen::VectorXd& z);

}  // namespace sem
