#pragma once
// Solids of the hard cases: plane shapes of known area, as they are in 2D and as prisms in 3D.

#include <functional>
#include <vector>

#include "sem/nurbs/bezier_curve.h"

namespace sem::stability {

using Curve = Nurbs<1, 2>;

/// Lower and upper edge of a piece of the plane, run through alike; the sides join their ends.
struct Cell {
  Curve lower, upper;
};

/// A plane solid: what bounds it, and cells that make it up (or overlap it nowhere): the prism's ends.
struct PlaneSolid {
  std::vector<Curve> boundary;
  std::vector<Cell> cells;  ///< empty: there is no prism
};

struct PlaneShape {
  std::vector<PlaneSolid> solids;
  double area = 0;        ///< m^2, closed form
  bool connected = true;  ///< false: a pin on one part does not hold all of it
};

/// What the method gets, and what is known of it.
template <int Dim>
struct Body {
  std::vector<std::vector<Nurbs<Dim - 1, Dim>>> solids;
  double volume = 0;  ///< closed form
  double size = 1;    ///< m: lengths of its method and bounds scale with it
  bool connected = true;
};

/// 2D: the shape itself. 3D: the prism over it of height 1 along z.
template <int Dim>
Body<Dim> body_of(const PlaneShape& shape);

/// Changes every NURBS, or its control points, of a body.
template <int Dim>
Body<Dim> changed(Body<Dim> body,
                  const std::function<void(Nurbs<Dim - 1, Dim>&, int index)>& change);
template <int Dim>
Body<Dim> scaled(const Body<Dim>& body, double factor);
template <int Dim>
Body<Dim> moved(const Body<Dim>& body, const Vec<Dim>& by);
template <int Dim>
Body<Dim> elevated(const Body<Dim>& body, int times);
/// Every second NURBS runs backwards.
template <int Dim>
Body<Dim> with_mixed_orientation(const Body<Dim>& body);

/// Pieces of shapes. Polygons are closed; a quad's corners are in order around it.
std::vector<Curve> polygon(const std::vector<Vec<2>>& corners);
Cell quad(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c, const Vec<2>& d);
Curve bezier(const std::vector<Vec<2>>& points, const std::vector<double>& weights = {});
/// The arc of a circle, less than half a turn, as a rational quadratic whose parameter runs unevenly: the
/// weights are 1, ..., stretch^2.
Curve arc(const Vec<2>& center, double radius, double from, double to, double stretch = 1);

PlaneShape rectangle(const Vec<2>& lower, const Vec<2>& upper, int n_parts = 1);
/// Between two curves; sides where their ends differ.
PlaneShape ruled(const Curve& lower, const Curve& upper, double area);
/// A ruled disc of two or more arcs on each side.
PlaneShape disc(const Vec<2>& center, double radius, double stretch = 1);
/// All solids of both, as they are.
PlaneShape together(PlaneShape a, const PlaneShape& b, double area, bool connected);
/// All solids made one.
PlaneShape as_one_solid(const PlaneShape& shape);

}  // namespace sem::stability
