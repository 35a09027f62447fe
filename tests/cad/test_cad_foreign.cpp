// Files as other programs write them: analytic faces, booleans, fillets.
#ifdef SEM_TEST_OCCT
#include <doctest/doctest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <GProp_GProps.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <STEPControl_Writer.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <sstream>

#include "folder.h"
#include "scene/errors.h"
#include "sem/method/boundary_integrals.h"
#include "src3d/cad/cad.h"

using namespace sem;

namespace {

constexpr double cubic_mm = 1e-9;

double volume_of(const TopoDS_Shape& shape) {
  GProp_GProps inside;
  BRepGProp::VolumeProperties(shape, inside, 1e-9);
  return cubic_mm * inside.Mass();
}

// As faces alone, or as a solid (mode 1).
void write_iges(const TopoDS_Shape& shape, const std::string& file, int mode) {
  IGESControl_Controller::Init();
  IGESControl_Writer writer("MM", mode);
  writer.AddShape(shape);
  writer.ComputeModel();
  REQUIRE(writer.Write(file.c_str()));
}

void write_step(const TopoDS_Shape& shape, const std::string& file) {
  STEPControl_Writer writer;
  writer.Transfer(shape, STEPControl_AsIs);
  REQUIRE(writer.Write(file.c_str()) == IFSelect_RetDone);
}

double our_volume(const std::string& file) {
  const CadModel model = read_cad(file, false);
  std::vector<std::vector<Nurbs<2, 3>>> solids(1);
  std::vector<TrimLoops> trims;
  for (const auto& part : model.parts) {
    solids[0].push_back(part.shape);
    trims.push_back(part.trims);
  }
  const auto boundary = make_boundary<3>(solids, trims);
  const auto loops = find_loops(boundary);
  CHECK(loops.loops.size() == 1);
  const auto moments = boundary_moments(boundary, loops);
  CHECK(moments.available);
  return moments.volume;
}

void check_volumes(const TopoDS_Shape& shape, const std::string& name, double tolerance) {
  const test::Folder folder("cad_foreign_" + name);
  CAPTURE(name);
  const double truth = volume_of(shape);
  write_step(shape, folder / "a.step");
  CHECK(our_volume(folder / "a.step") == doctest::Approx(truth).epsilon(tolerance));
  for (const int mode : {0, 1}) {
    CAPTURE(mode);
    write_iges(shape, folder / "a.igs", mode);
    CHECK(our_volume(folder / "a.igs") == doctest::Approx(truth).epsilon(tolerance));
  }
}

const TopoDS_Shape box = BRepPrimAPI_MakeBox(100., 100., 100.);
TopoDS_Shape ball(double x, double y, double z) {
  return BRepPrimAPI_MakeSphere(gp_Pnt(x, y, z), 30.);
}

}  // namespace

TEST_CASE("a box fused with a ball or a cylinder, cut or filleted by OpenCASCADE has its volume") {
  check_volumes(BRepAlgoAPI_Fuse(box, ball(100, 50, 50)), "ball", 1e-6);
  check_volumes(BRepAlgoAPI_Fuse(box, ball(120, 50, 50)), "ball_far", 1e-6);
  check_volumes(BRepAlgoAPI_Cut(box, ball(50, 50, 100)), "hollow", 1e-6);
  check_volumes(BRepAlgoAPI_Fuse(box, BRepPrimAPI_MakeCylinder(
                                          gp_Ax2(gp_Pnt(50, 50, 50), gp_Dir(1, 0, 0)), 20., 100.)),
                "cylinder", 1e-6);
  BRepFilletAPI_MakeFillet fillet(box);
  for (TopExp_Explorer edge(box, TopAbs_EDGE); edge.More(); edge.Next())
    fillet.Add(10., TopoDS::Edge(edge.Current()));
  check_volumes(fillet.Shape(), "fillet", 1e-6);
}

TEST_CASE("a face that OpenCASCADE reads from its wrong side is refused, or is right") {
  // Its STEP reader takes the eighth of the ball inside the box for the seven outside.
  const TopoDS_Shape fused = BRepAlgoAPI_Fuse(box, ball(100, 100, 100));
  const test::Folder folder("cad_foreign_corner");
  write_iges(fused, folder / "a.igs", 0);
  CHECK(our_volume(folder / "a.igs") == doctest::Approx(volume_of(fused)).epsilon(1e-6));
  write_step(fused, folder / "a.step");
  double volume = 0;
  const std::string error = test::error_of([&] { volume = our_volume(folder / "a.step"); });
  if (error.empty())
    CHECK(volume == doctest::Approx(volume_of(fused)).epsilon(1e-6));
  else
    test::check_names(error, folder / "a.step", {"face '", "the wrong side", "IGES"});
}
#endif
