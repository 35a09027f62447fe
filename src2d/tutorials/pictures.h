#pragma once
// Whole pictures that would hide a tutorial's recipe: steps 6 to 9 on the three-curve solid and its
// like, and the weights of step 13. The mouse reads the values that they show.

#include <utility>

#include "sem/method/discretization.h"
#include "sem/method/rays.h"
#include "sem/scene/model.h"
#include "src2d/tutorials/drawing.h"

namespace sem::tutorial {

void draw_boundary(Picture& picture, const Boundary<2>& boundary);
/// A ray along an axis through the box, the stretches inside and the hits: crosses touch only.
void draw_ray(Picture& picture, const Box<2>& box, int axis, double height,
              const std::vector<RayHit>& hits, const std::vector<RayInterval>& inside,
              double width);
/// A function on [-1, 1]^2 in a square of pixels, red > 0, blue < 0, with its name.
void draw_function(Picture& picture, const Box<2>& square, const std::string& name, bool pale,
                   const std::function<double(const Vec<2>& X)>& f);
/// The construction of figure 4: a line from the closest point `foot` of part i through X to the
/// hit at distance d2 from X (clamped), with their names and lengths.
void draw_construction(Picture& picture, const Curves& parts, int i, const Vec<2>& foot,
                       const Vec<2>& X, double d2);
/// Columns of matrices (one for each variant) over `at`, for these parts (-1: none): colours by
/// part, dashes by variant; the place of X is marked.
void draw_profiles(Picture& picture, const Eigen::VectorXd& at,
                   const std::vector<Eigen::MatrixXd>& variants, const std::vector<int>& parts,
                   const std::vector<std::string>& names, double X);
/// Rows of heat maps, one for each part: values in [0, 1], #cells by #parts, called `symbol`.
void draw_fields(Picture& picture, const Cells& cells, const Curves& parts,
                 const std::vector<std::pair<std::string, Eigen::MatrixXd>>& rows,
                 const std::string& symbol);
/// A colour, in [0, 1], and a text.
using TriangleValue = std::function<std::pair<double, std::string>(const Eigen::Vector3d& w)>;
/// In the right of the picture the triangle of all weights w >= 0, sum w = 1, of the parts A, B, C:
/// their values, a dot at the weights `w` of X; left X in the solid, in its view.
void draw_triangle(Picture& picture, const Curves& parts, const Box<2>& world, const Vec<2>& X,
                   const Eigen::Vector3d& w, const TriangleValue& value);
/// Squares at points in the colours of their groups; all from the eighth on are gray.
void draw_groups(Picture& picture, const Points<2>& points, const std::vector<int>& group);
/// Lines from the parts, numbered on the left, to the candidates named on the right: `score` is
/// #parts by #candidates and sets the widths; those taken (an index for each part) are coloured.
/// Shown are candidates with a name: the first nine, and all that are taken.
void draw_network(Picture& picture, const Eigen::MatrixXd& score,
                  const std::vector<std::string>& candidates, const std::vector<int>& taken);
/// "{1 2 5}": a set of parts, counted from 1.
std::string text(const std::vector<int>& set);
/// Parts with numbers, and lines from their middles to their origins, which are named by their
/// sets.
void draw_origins(Picture& picture, const Curves& parts, const Origins<2>& origins);
/// Matrices with entries in [0, 1] side by side, rows and columns numbered from 1, columns in the
/// colours of the parts, with their names below.
void draw_shares(Picture& picture, const std::vector<Eigen::MatrixXd>& matrices,
                 const std::vector<std::string>& names);
/// Squares of the solid at rest, `size` m wide, where the map takes them: `moved` are the cells'
/// images.
void draw_squares(Picture& picture, const Cells& cells, const Points<2>& moved, double size);

/// A point x and what A, B, C make of it, with bars of the widths |Gamma| to the nine points p.
void draw_opinions(Picture& picture, const Points<2>& p, const Eigen::RowVectorXd& Gamma,
                   const Points<2>& opinions, const Vec<2>& x);
/// Arrows at the nine points p for forces -dV/dp on the 12 control points (2 by 12); joints add up.
void draw_forces(Picture& picture, const Points<2>& p, const Points<2>& forces);
/// The image of a closed curve under x(X) and the walks along it by sums of F dX, with (12) and
/// (12').
void draw_walks(Picture& picture, const Points<2>& image, const Points<2>& diffuse,
                const Points<2>& exact);

/// FramePainter's picture of a state; the mouse reads the stress.
void draw_frame(Picture& picture, const Scene<2>& scene, const Model<2>& model, const State& state);
/// Quadrature points in the mean of the parts' colours by their weights; the parts themselves.
void draw_weights(Picture& picture, const Discretization<2>& body,
                  const std::vector<Color>& part_colors);

}  // namespace sem::tutorial
