// Faces of OpenCASCADE as NURBS with trims.
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepTools.hxx>
#include <BRepTools_WireExplorer.hxx>
#include <BRep_Tool.hxx>
#include <Geom2dConvert.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_TrimmedCurve.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>

#include "sem/base/error.h"
#include "sem/method/trims.h"
#include "sem/nurbs/bezier_curve.h"
#include "sem/nurbs/refine.h"
#include "sem/scene/files.h"
#include "src3d/cad/occt.h"

namespace sem {
namespace {

constexpr double joined = 1e-9;  // of the domain: gaps of trims above this get a segment
constexpr double beside = 1e-6;  // of the domain: trims on its border, or outside by rounding

template <class Array>
std::vector<double> repeated(const Array& knots, const TColStd_Array1OfInteger& multiplicities) {
  std::vector<double> result;
  for (int k = knots.Lower(); k <= knots.Upper(); ++k)
    result.insert(result.end(), multiplicities(k), knots(k));
  return result;
}

Nurbs<2, 3> surface_of(Handle(Geom_BSplineSurface) surface) {
  if (surface->IsUPeriodic()) surface->SetUNotPeriodic();
  if (surface->IsVPeriodic()) surface->SetVNotPeriodic();
  Nurbs<2, 3> shape;
  shape.degree = {surface->UDegree(), surface->VDegree()};
  shape.knots = {repeated(surface->UKnots(), surface->UMultiplicities()),
                 repeated(surface->VKnots(), surface->VMultiplicities())};
  const int n_u = surface->NbUPoles(), n_v = surface->NbVPoles();
  shape.control_points.resize(3, n_u * n_v);
  shape.weights.resize(n_u * n_v);
  for (int j = 0; j < n_v; ++j)
    for (int i = 0; i < n_u; ++i) {
      const gp_Pnt P = surface->Pole(i + 1, j + 1);
      shape.control_points.col(i + n_u * j) = metres * Vec<3>(P.X(), P.Y(), P.Z());
      shape.weights[i + n_u * j] = surface->Weight(i + 1, j + 1);
    }
  if ((shape.weights.array() - shape.weights[0]).abs().maxCoeff() <= 1e-14 * shape.weights[0])
    shape.weights.setOnes();
  return shape;
}

Nurbs<1, 2> curve_of(Handle(Geom2d_BSplineCurve) curve) {
  if (curve->IsPeriodic()) curve->SetNotPeriodic();
  Nurbs<1, 2> shape;
  shape.degree = {curve->Degree()};
  shape.knots = {repeated(curve->Knots(), curve->Multiplicities())};
  const int n = curve->NbPoles();
  shape.control_points.resize(2, n);
  shape.weights.resize(n);
  for (int i = 0; i < n; ++i) {
    const gp_Pnt2d P = curve->Pole(i + 1);
    shape.control_points.col(i) = Vec<2>(P.X(), P.Y());
    shape.weights[i] = curve->Weight(i + 1);
  }
  return shape;
}

Vec<2> end_point(const Nurbs<1, 2>& curve, bool last) {
  const Interval range = domain(curve, 0);
  return point(curve, Param<1>(last ? range.upper : range.lower));
}

class FaceConverter {
 public:
  explicit FaceConverter(const std::string& name) : name_(name) {}

  // One part; notes what had to be mended.
  CadPart convert(const TopoDS_Face& original, std::vector<std::string>& notes) {
    // What is a NURBS already stays as it is: the conversion approximates curves in the parameter
    // plane.
    TopoDS_Face face = original;
    Handle(Geom_BSplineSurface) surface =
        Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(face));
    if (surface.IsNull()) {
      face = TopoDS::Face(BRepBuilderAPI_NurbsConvert(original).Shape());
      surface = GeomConvert::SurfaceToBSplineSurface(BRep_Tool::Surface(face));
    }
    double u0, u1, v0, v1;
    BRepTools::UVBounds(face, u0, u1, v0, v1);
    surface = Handle(Geom_BSplineSurface)::DownCast(surface->Copy());
    // A face across the seam of a periodic surface: cut there, so that its parameters are within
    // the domain.
    double su0, su1, sv0, sv1;
    surface->Bounds(su0, su1, sv0, sv1);
    const double near_u = beside * (su1 - su0), near_v = beside * (sv1 - sv0);
    if ((surface->IsUPeriodic() && (u0 < su0 - near_u || u1 > su1 + near_u)) ||
        (surface->IsVPeriodic() && (v0 < sv0 - near_v || v1 > sv1 + near_v)))
      surface->Segment(u0, u1, v0, v1);
    CadPart part;
    part.name = name_;
    part.shape = surface_of(surface);
    part.reversed = original.Orientation() == TopAbs_REVERSED;
    check(part.shape, "", "face '" + name_ + "'");
    find_trims(face, part, notes);
    return part;
  }

 private:
  void find_trims(const TopoDS_Face& face, CadPart& part, std::vector<std::string>& notes) {
    surface_ = part.shape;
    for (int axis = 0; axis < 2; ++axis) {
      box_.lower[axis] = domain(part.shape, axis).lower;
      box_.upper[axis] = domain(part.shape, axis).upper;
    }
    for (TopoDS_Iterator it(TopoDS::Face(face.Oriented(TopAbs_FORWARD))); it.More(); it.Next()) {
      if (it.Value().ShapeType() != TopAbs_WIRE) continue;
      auto loop =
          loop_of(TopoDS::Wire(it.Value()), TopoDS::Face(face.Oriented(TopAbs_FORWARD)), notes);
      if (!loop.empty()) part.trims.push_back(std::move(loop));
    }
    if (is_natural(part.trims)) part.trims.clear();
    check_trims<3>(part.shape, part.trims, "", "face '" + name_ + "'.trims");
  }

  std::vector<Nurbs<1, 2>> loop_of(const TopoDS_Wire& wire, const TopoDS_Face& face,
                                   std::vector<std::string>& notes) {
    std::vector<Nurbs<1, 2>> loop;
    int n_edges = 0;
    for (TopoDS_Iterator it(wire); it.More(); it.Next()) ++n_edges;
    const auto add = [&](const TopoDS_Edge& edge) {
      double first, last;
      const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, face, first, last);
      if (curve.IsNull())
        throw InputError("", "face '" + name_ + "'",
                         "an edge without a curve in the parameter plane",
                         "faces with all of them");
      if (!(last > first)) return;
      auto shape =
          curve_of(Geom2dConvert::CurveToBSplineCurve(new Geom2d_TrimmedCurve(curve, first, last)));
      if (edge.Orientation() == TopAbs_REVERSED) shape = reversed(shape, 0);
      if (prepare(shape).box.diagonal() > 1e-12 * box_.diagonal())
        loop.push_back(
            within_domain(std::move(shape), BRep_Tool::Degenerated(edge) || is_point(shape)));
    };
    BRepTools_WireExplorer ordered(wire, face);
    int n_ordered = 0;
    for (; ordered.More(); ordered.Next(), ++n_ordered) add(ordered.Current());
    if (n_ordered < n_edges) {  // what cannot be put in order is taken as it comes
      loop.clear();
      for (TopoDS_Iterator it(wire); it.More(); it.Next()) add(TopoDS::Edge(it.Value()));
    }
    return closed(std::move(loop), notes);
  }

  // Whether the image of a curve is a point, at a pole.
  bool is_point(const Nurbs<1, 2>& curve) const {
    const Interval range = domain(curve, 0);
    const auto image = [&](double t) {
      return point(surface_,
                   Param<2>(point(curve, Param<1>(range.lower + t * (range.upper - range.lower)))));
    };
    const double size = (surface_.control_points.rowwise().maxCoeff() -
                         surface_.control_points.rowwise().minCoeff())
                            .norm();
    return (image(0) - image(1)).norm() + (image(0) - image(0.4)).norm() < beside * size;
  }

  // Control points outside of the domain by rounding, or of an edge that is a point in space, are
  // moved onto its border.
  Nurbs<1, 2> within_domain(Nurbs<1, 2> curve, bool degenerate) const {
    const double near = (degenerate ? 1 : 10 * beside) * box_.diagonal();
    for (int i = 0; i < curve.control_points.cols(); ++i)
      for (int a = 0; a < 2; ++a) {
        double& u = curve.control_points(a, i);
        if (u < box_.lower[a] && u > box_.lower[a] - near) u = box_.lower[a];
        if (u > box_.upper[a] && u < box_.upper[a] + near) u = box_.upper[a];
      }
    return curve;
  }

  std::vector<Nurbs<1, 2>> closed(std::vector<Nurbs<1, 2>> loop,
                                  std::vector<std::string>& notes) const {
    std::vector<Nurbs<1, 2>> result;
    double largest = 0;
    for (size_t c = 0; c < loop.size(); ++c) {
      const Vec<2> from = end_point(loop[c], true),
                   to = end_point(loop[(c + 1) % loop.size()], false);
      result.push_back(loop[c]);
      if ((to - from).norm() <= joined * box_.diagonal()) continue;
      largest = std::max(largest, (to - from).norm() / box_.diagonal());
      result.push_back(segment<2>(from, to));
    }
    if (largest > beside)
      notes.push_back("face '" + name_ + "': a gap of " + exact_text(largest) +
                      " of the domain in a trim closed");
    return result;
  }

  // True if the loops do nothing but run once around the domain.
  bool is_natural(const TrimLoops& trims) const {
    double twice_area = 0;
    const Vec<2> size = box_.upper - box_.lower;
    for (const auto& loop : trims)
      for (const auto& curve : loop) {
        constexpr int n = 32;
        Vec<2> last = end_point(curve, false);
        const Interval range = domain(curve, 0);
        for (int k = 0; k <= n; ++k) {
          const Vec<2> u =
              point(curve, Param<1>(range.lower + (range.upper - range.lower) * k / n));
          const auto off = ((u - box_.lower).array() / size.array())
                               .min((box_.upper - u).array() / size.array());
          if (off.abs().minCoeff() > beside) return false;
          twice_area += last[0] * u[1] - last[1] * u[0];
          last = u;
        }
      }
    return std::abs(std::abs(twice_area) / 2 - size.prod()) < 1e-4 * size.prod();
  }

  std::string name_;
  Nurbs<2, 3> surface_;
  Box<2> box_;
};

}  // namespace

CadPart part_of_face(const TopoDS_Face& face, const std::string& name,
                     std::vector<std::string>& notes) {
  return FaceConverter(name).convert(face, notes);
}

}  // namespace sem
