#pragma once
// One frame of a run: the deformed body, what it carries, when.

#include "sem/draw/canvas.h"
#include "sem/scene/model.h"

namespace sem {

/// Draws the states of one scene, all in the same view. The interior shows the
/// von Mises stress at the quadrature points, in discs of the area they stand
/// for; its colour scale ends at a round number that holds the largest stress
/// drawn so far, so it changes seldom and is written beside the bar.
class FramePainter {
 public:
  explicit FramePainter(const Scene<2>& scene) : scene_(scene) {}
  void draw(Canvas& canvas, const Model<2>& model, const State& state);

 private:
  // A part as points on its curve: position k is sum_e value[e] p[column[e]].
  struct Curve {
    std::vector<std::vector<std::pair<int, double>>> rows;
  };
  // Parts of a loop in their order along it.
  struct Outline {
    int solid;
    std::vector<std::pair<int, bool>> parts;  // part, drawn from its end to its start
  };

  void prepare(const Model<2>& model, const State& first);
  Polyline positions(int part, const Eigen::VectorXd& z) const;

  const Scene<2>& scene_;
  bool ready_ = false;
  Box<2> view_;
  std::vector<Curve> curves_;
  std::vector<Outline> outlines_;
  double stress_limit_ = 0;
};

/// Von Mises stress of plane strain at every quadrature point, Pa.
Eigen::VectorXd von_mises(const Model<2>& model, const Eigen::VectorXd& z);

}  // namespace sem
