#pragma once
// What is the same in all frames of a run: the box they show and the stress that ends the colour
// scale. Both follow from the scene alone, so a run that is resumed draws the same frames.

#include "sem/scene/model.h"

namespace sem {

/// The box that the body's control points are expected to visit, m. Modes: the rest shape. Statics:
/// also the linear answer and where pins are led. Dynamics without pins: the rest shape along its
/// ballistic path. With pins that hold a region: what a run of the linearised body visits, at most
/// 200 steps of it. Hung by a point: all that it can reach when it turns about it, no higher than
/// at rest, and farther down. Linear answers end a tenth beyond what the body reaches from its
/// pins.
template <int Dim>
Box<Dim> visited_box(const Scene<Dim>& scene, const Model<Dim>& model);

/// The visited_box with a margin, 12 % of the rest shape's diagonal on every side.
template <int Dim>
Box<Dim> motion_box(const Scene<Dim>& scene, const Model<Dim>& model);

/// What a frame in 2D shows: the scene's output.view, or else the motion_box.
Box<2> view_box(const Scene<2>& scene, const Model<2>& model);

/// A stress that most of the body stays below in a dynamic run, as long as it is not far from
/// linear, Pa: twice the von Mises stress that 2 % of the points exceed in the linear static answer
/// to loads and prescribed displacements, plus half the density times the velocity squared of an
/// initial spin. 0 if nothing acts.
template <int Dim>
double expected_stress(const Model<Dim>& model);

/// Von Mises stress at every quadrature point, Pa; in plane strain the stress across the plane is
/// taken to first order, nu (s_xx + s_yy). NaN where the material is inverted and has no stress.
template <int Dim>
Eigen::VectorXd von_mises(const Model<Dim>& model, const Eigen::VectorXd& z);

/// The stress that ends the colour scale of all frames of a dynamic run: a round number from
/// expected_stress; 0, the frame's own, in statics and modes and where nothing acts.
template <int Dim>
double stress_limit(const Scene<Dim>& scene, const Model<Dim>& model);

/// What a frame's colours stand for.
struct StressScale {
  double limit = 0;    ///< Pa, where they end; 0: no stress anywhere
  double largest = 0;  ///< Pa, of this frame
  int n_inverted = 0;  ///< points without a stress
};
/// Of the stresses of one frame; `limit`: that of all frames, 0: a round number from this one's
/// largest.
StressScale stress_scale(const Eigen::VectorXd& stress, double limit);

/// A round number not below the value, which is > 0: 1, 1.5, 2, 3, 4, 5, 6 or 8 times a power of
/// ten.
double round_up(double value);

}  // namespace sem
