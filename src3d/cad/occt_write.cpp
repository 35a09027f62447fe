// Writing IGES and STEP with OpenCASCADE.
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepLib.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <IGESCAFControl_Writer.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESData_IGESWriter.hxx>
#include <IGESData_Protocol.hxx>
#include <IGESSelect_WorkLibrary.hxx>
#include <Interface_FloatWriter.hxx>
#include <Interface_Static.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Writer.hxx>
#include <ShapeFix_Face.hxx>
#include <Standard_Failure.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XSControl_WorkSession.hxx>
#include <cmath>
#include <cstdio>
#include <fstream>

#include "sem/base/error.h"
#include "sem/method/loops.h"
#include "sem/nurbs/refine.h"
#include "src3d/cad/cad.h"
#include "src3d/cad/occt.h"

namespace sem {
namespace {

constexpr int highest_degree = 25;

// Distinct knots and how often each is repeated.
struct Knots {
  std::vector<double> value;
  std::vector<int> times;

  explicit Knots(const std::vector<double>& knots) {
    for (const double u : knots) {
      if (value.empty() || u > value.back()) {
        value.push_back(u);
        times.push_back(0);
      }
      ++times.back();
    }
  }
  TColStd_Array1OfReal values() const {
    TColStd_Array1OfReal array(1, int(value.size()));
    for (size_t k = 0; k < value.size(); ++k) array(int(k) + 1) = value[k];
    return array;
  }
  TColStd_Array1OfInteger multiplicities() const {
    TColStd_Array1OfInteger array(1, int(times.size()));
    for (size_t k = 0; k < times.size(); ++k) array(int(k) + 1) = times[k];
    return array;
  }
};

template <int ParamDim, int Dim>
Nurbs<ParamDim, Dim> writable(Nurbs<ParamDim, Dim> shape, const std::string& field) {
  for (int axis = 0; axis < ParamDim; ++axis) {
    shape = clamped(shape, axis);
    const int p = shape.degree[axis];
    if (p > highest_degree)
      throw InputError("", field, "degree " + std::to_string(p),
                       "at most " + std::to_string(highest_degree) + " in a CAD file");
    const Knots knots(shape.knots[axis]);
    for (size_t k = 1; k + 1 < knots.times.size(); ++k)
      if (knots.times[k] > p)
        throw InputError("", field,
                         "a knot repeated " + std::to_string(knots.times[k]) + " times inside",
                         "at most the degree in a CAD file");
  }
  return shape;
}

Handle(Geom_BSplineSurface) surface_of(const Nurbs<2, 3>& part, const std::string& field) {
  const auto shape = writable(part, field);
  const int n_u = n_control(shape, 0), n_v = n_control(shape, 1);
  TColgp_Array2OfPnt poles(1, n_u, 1, n_v);
  TColStd_Array2OfReal weights(1, n_u, 1, n_v);
  for (int j = 0; j < n_v; ++j)
    for (int i = 0; i < n_u; ++i) {
      const Vec<3> X = 1 / metres * shape.control_points.col(i + n_u * j);
      poles(i + 1, j + 1) = gp_Pnt(X[0], X[1], X[2]);
      weights(i + 1, j + 1) = shape.weights[i + n_u * j];
    }
  const Knots u(shape.knots[0]), v(shape.knots[1]);
  return new Geom_BSplineSurface(poles, weights, u.values(), v.values(), u.multiplicities(),
                                 v.multiplicities(), shape.degree[0], shape.degree[1]);
}

Handle(Geom2d_BSplineCurve) curve_of(const Nurbs<1, 2>& curve, const std::string& field) {
  const auto shape = writable(curve, field);
  const int n = n_control(shape, 0);
  TColgp_Array1OfPnt2d poles(1, n);
  TColStd_Array1OfReal weights(1, n);
  for (int i = 0; i < n; ++i) {
    poles(i + 1) = gp_Pnt2d(shape.control_points(0, i), shape.control_points(1, i));
    weights(i + 1) = shape.weights[i];
  }
  const Knots knots(shape.knots[0]);
  return new Geom2d_BSplineCurve(poles, weights, knots.values(), knots.multiplicities(),
                                 shape.degree[0]);
}

// The curves of a loop head to tail, whatever their order and orientation.
std::vector<Nurbs<1, 2>> in_order(std::vector<Nurbs<1, 2>> curves) {
  std::vector<Nurbs<1, 2>> ordered = {curves.front()};
  curves.erase(curves.begin());
  const auto end = [](const Nurbs<1, 2>& c, bool last) {
    const Interval range = domain(c, 0);
    return point(c, Param<1>(last ? range.upper : range.lower));
  };
  while (!curves.empty()) {
    const Vec<2> at = end(ordered.back(), true);
    size_t best = 0;
    bool backwards = false;
    double least = std::numeric_limits<double>::infinity();
    for (size_t c = 0; c < curves.size(); ++c)
      for (const bool last : {false, true})
        if (const double distance = (end(curves[c], last) - at).norm(); distance < least) {
          least = distance;
          best = c;
          backwards = last;
        }
    ordered.push_back(backwards ? reversed(curves[best], 0) : curves[best]);
    curves.erase(curves.begin() + long(best));
  }
  return ordered;
}

TopoDS_Wire wire_of(const std::vector<Nurbs<1, 2>>& loop,
                    const Handle(Geom_BSplineSurface) & surface, const std::string& field) {
  BRepBuilderAPI_MakeWire wire;
  for (const auto& curve : in_order(loop)) {
    const TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(curve_of(curve, field), surface);
    BRepLib::BuildCurve3d(edge, 1e-7, GeomAbs_C1, 9, 500);  // mm
    wire.Add(edge);
    if (!wire.IsDone())
      throw InputError("", field, "a loop that OpenCASCADE cannot join", "closed loops");
  }
  return wire.Wire();
}

TopoDS_Face face_of(const CadPart& part, const std::string& field) {
  const auto surface = surface_of(part.shape, field);
  if (part.trims.empty()) return BRepBuilderAPI_MakeFace(surface, 1e-7);
  TopoDS_Face face;
  BRep_Builder builder;
  builder.MakeFace(face, surface, 1e-7);
  for (const auto& loop : part.trims) builder.Add(face, wire_of(loop, surface, field));
  ShapeFix_Face fix(face);
  fix.FixOrientation();
  return fix.Face();
}

Handle(TDocStd_Document) document_of(const std::vector<CadPart>& parts) {
  Handle(TDocStd_Document) document;
  XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", document);
  const auto shapes = XCAFDoc_DocumentTool::ShapeTool(document->Main());
  const auto colors = XCAFDoc_DocumentTool::ColorTool(document->Main());
  const bool several = std::any_of(parts.begin(), parts.end(), [&](const CadPart& part) {
    return part.solid != parts[0].solid;
  });
  for (size_t i = 0; i < parts.size(); ++i) {
    const std::string field = "part '" + parts[i].name + "'",
                      solid = several ? "solid." + std::to_string(parts[i].solid + 1) + "/" : "";
    check(parts[i].shape, "", field);
    TopoDS_Face face = face_of(parts[i], field);
    if (parts[i].reversed) face.Reverse();
    const TDF_Label label = shapes->AddShape(face, false);
    TDataStd_Name::Set(label, TCollection_ExtendedString((solid + parts[i].name).c_str(), true));
    if (const auto& c = parts[i].color)
      colors->SetColor(label, Quantity_Color((*c)[0], (*c)[1], (*c)[2], Quantity_TOC_RGB),
                       XCAFDoc_ColorSurf);
  }
  return document;
}

// OpenCASCADE's writers round to 9 (IGES) and 12 digits (STEP) if nothing is said; they have room
// for 19 characters a number, which is 13 digits. Its suppression of zeros loses exponents of such
// formats: off.
void print_many_digits(Interface_FloatWriter& writer) { writer.SetFormat("%.12E"); }

bool print_iges(IGESCAFControl_Writer& from, const std::string& file) {
  from.ComputeModel();
  IGESData_IGESWriter writer(from.Model());
  print_many_digits(writer.FloatWriter());
  writer.SendModel(IGESSelect_WorkLibrary::DefineProtocol());
  std::ofstream out(file, std::ios::binary);
  return writer.Print(out) && out.flush();
}

bool print_step(STEPCAFControl_Writer& from, const std::string& file) {
  const Handle(StepData_StepModel) model = from.ChangeWriter().Model();
  StepData_StepWriter writer(model);
  print_many_digits(writer.FloatWriter());
  writer.SendModel(Handle(StepData_Protocol)::DownCast(model->Protocol()));
  std::ofstream out(file, std::ios::binary);
  return writer.Print(out) && out.flush();
}

}  // namespace

void write_cad(const std::string& file, const std::vector<CadPart>& parts) {
  const bool iges = is_iges(file);
  if (parts.empty()) throw InputError(file, "", "no part to write", "at least one");
  quiet_occt();
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  // Complete or not at all: under another name first.
  const std::string temporary = file + (iges ? ".part.igs" : ".part.stp");
  bool written = false;
  try {
    const auto document = document_of(parts);
    const auto transfer = [&](auto& writer) {
      writer.SetColorMode(true);
      writer.SetNameMode(true);
    };
    if (iges) {
      Interface_Static::SetCVal("write.iges.unit", "MM");
      Interface_Static::SetIVal("write.surfacecurve.mode", 1);
      IGESCAFControl_Writer writer;
      transfer(writer);
      written = writer.Transfer(document) && print_iges(writer, temporary);
    } else {
      Interface_Static::SetCVal("write.step.unit", "MM");
      STEPCAFControl_Writer writer;
      transfer(writer);
      written = writer.Transfer(document) && print_step(writer, temporary);
    }
  } catch (const InputError& error) {
    throw InputError(file, error);
  } catch (const Standard_Failure& failure) {
    std::remove(temporary.c_str());
    throw InputError(
        file, "", std::string("what OpenCASCADE cannot write (") + failure.GetMessageString() + ")",
        "valid parts");
  }
  if (!written || std::rename(temporary.c_str(), file.c_str()) != 0) {
    std::remove(temporary.c_str());
    throw InputError(file, "", "a file that cannot be written", "a writable folder with room");
  }
}

}  // namespace sem
