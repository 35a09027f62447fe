// Reading IGES and STEP with OpenCASCADE.
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <IGESCAFControl_Reader.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <Quantity_Color.hxx>
#include <STEPCAFControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <StepShape_FaceSurface.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TDF_LabelSequence.hxx>
#include <TDataStd_Name.hxx>
#include <TDocStd_Document.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Iterator.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XCAFApp_Application.hxx>
#include <XCAFDoc_ColorTool.hxx>
#include <XCAFDoc_DocumentTool.hxx>
#include <XCAFDoc_ShapeTool.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "sem/base/error.h"
#include "sem/scene/files.h"
#include "src3d/cad/cad.h"
#include "src3d/cad/occt.h"

namespace sem {
namespace {

constexpr const char* readable = "an IGES or STEP file with surfaces";

// Files that were cut off have no end mark; OpenCASCADE would read what there is.
void require_whole(const std::string& file, bool iges) {
  const std::string text = read_file(file);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos)
    throw InputError(file, "", "an empty file", readable);
  bool whole = false;
  if (iges) {
    // The last line has the section's letter T in column 73.
    const size_t end = text.find_last_not_of(" \t\r\n"), begin = text.rfind('\n', end) + 1;
    const std::string last = text.substr(begin, end + 1 - begin);
    whole = last.size() >= 73 && last[72] == 'T';
  } else {
    whole = text.find("END-ISO-10303-21") != std::string::npos;
  }
  if (!whole)
    throw InputError(
        file, "", std::string("a file without its end: cut off, or no ") + (iges ? "IGES" : "STEP"),
        readable);
}

struct Document {
  Handle(TDocStd_Document) document;
  std::string unit;
  std::vector<TopoDS_Shape> faces;  // STEP: as the file orients them
};

// Every face of the file, oriented as the file says.
std::vector<TopoDS_Shape> oriented_faces(const Handle(XSControl_WorkSession) & session) {
  const auto process = session->TransferReader()->TransientProcess();
  const auto model = session->Model();
  std::vector<TopoDS_Shape> faces;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto face = Handle(StepShape_FaceSurface)::DownCast(model->Value(i));
    if (face.IsNull()) continue;
    const TopoDS_Shape shape = TransferBRep::ShapeResult(process, face);
    if (!shape.IsNull() && shape.ShapeType() == TopAbs_FACE)
      faces.push_back(shape.Oriented(face->SameSense() ? TopAbs_FORWARD : TopAbs_REVERSED));
  }
  return faces;
}

Document read_document(const std::string& file, bool iges) {
  Document result;
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
  XCAFApp_Application::GetApplication()->NewDocument("MDTV-XCAF", result.document);
  const auto transfer = [&](auto& reader) {
    reader.SetColorMode(true);
    reader.SetNameMode(true);
    if (reader.ReadFile(file.c_str()) != IFSelect_RetDone)
      throw InputError(file, "", "no readable CAD file", readable);
    if (reader.NbRootsForTransfer() == 0)
      throw InputError(file, "", "a CAD file without shapes", readable);
    if (!reader.Transfer(result.document))
      throw InputError(file, "", "shapes that cannot be made", readable);
  };
  if (iges) {
    IGESCAFControl_Reader reader;
    Interface_Static::SetIVal("read.surfacecurve.mode", 2);  // curves in the parameter plane count
    transfer(reader);
    const auto name = reader.IGESModel()->GlobalSection().UnitName();
    result.unit = name.IsNull() ? "" : name->ToCString();
  } else {
    STEPCAFControl_Reader reader;
    transfer(reader);
    TColStd_SequenceOfAsciiString lengths, angles, solid_angles;
    reader.ChangeReader().FileUnits(lengths, angles, solid_angles);
    if (lengths.Length() > 0) result.unit = lengths.First().ToCString();
    result.faces = oriented_faces(reader.Reader().WS());
  }
  return result;
}

std::string name_of(const TDF_Label& label) {
  Handle(TDataStd_Name) name;
  if (!label.FindAttribute(TDataStd_Name::GetID(), name)) return "";
  const TCollection_ExtendedString& text = name->Get();
  std::string bytes(size_t(text.LengthOfCString()) + 1, '\0');
  char* begin = bytes.data();
  bytes.resize(size_t(text.ToUTF8CString(begin)));
  return bytes;
}

// Without what names of parts use for other ends.
std::string plain_name(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '/' || c == '~' || (c >= 0 && c < ' '); },
      '_');
  return name;
}

// What labels say about shapes: of faces, or of what contains them.
struct Labels {
  std::map<Standard_Integer, std::vector<std::pair<TopoDS_Shape, std::string>>> names;

  void add(const TopoDS_Shape& shape, const std::string& name) {
    if (!name.empty()) names[shape.HashCode(1 << 20)].push_back({shape, name});
  }
  std::string of(const TopoDS_Shape& shape) const {
    const auto found = names.find(shape.HashCode(1 << 20));
    if (found != names.end())
      for (const auto& [other, name] : found->second)
        if (other.IsSame(shape)) return name;
    return "";
  }
};

// A face of the file, as the file has it, with the name and colour found on the way down.
struct FoundFace {
  TopoDS_Face face;
  std::string name;
  std::optional<std::array<double, 3>> color;
  int solid;
};

class FaceFinder {
 public:
  explicit FaceFinder(const Handle(TDocStd_Document) & document)
      : shapes_(XCAFDoc_DocumentTool::ShapeTool(document->Main())),
        colors_(XCAFDoc_DocumentTool::ColorTool(document->Main())) {
    TDF_LabelSequence free;
    shapes_->GetFreeShapes(free);
    for (int i = 1; i <= free.Length(); ++i) {
      const TDF_Label label = free.Value(i);
      collect_names(label);
      const TopoDS_Shape shape = XCAFDoc_ShapeTool::GetShape(label);
      descend(shape, name_of(label), color_of(shape), -1);
    }
  }

  std::vector<FoundFace> faces;
  int n_solids = 0;

 private:
  void collect_names(const TDF_Label& label) {
    TDF_Label referred;
    if (XCAFDoc_ShapeTool::GetReferredShape(label, referred)) collect_names(referred);
    TopoDS_Shape shape;
    if (XCAFDoc_ShapeTool::GetShape(label, shape)) labels_.add(shape, name_of(label));
    TDF_LabelSequence below;
    XCAFDoc_ShapeTool::GetSubShapes(label, below);
    XCAFDoc_ShapeTool::GetComponents(label, below);
    for (int i = 1; i <= below.Length(); ++i) collect_names(below.Value(i));
  }

  std::optional<std::array<double, 3>> color_of(const TopoDS_Shape& shape) const {
    Quantity_Color color;
    for (const auto type : {XCAFDoc_ColorSurf, XCAFDoc_ColorGen})
      if (colors_->GetColor(shape, type, color) || colors_->GetInstanceColor(shape, type, color))
        return std::array{double(color.Red()), double(color.Green()), double(color.Blue())};
    return {};
  }

  void descend(const TopoDS_Shape& shape, const std::string& name,
               const std::optional<std::array<double, 3>>& color, int solid) {
    if (shape.ShapeType() == TopAbs_FACE) {
      // A name "solid.2/side.1" is that of write_cad for a face of one of several solids.
      const size_t end =
          solid < 0 && name.starts_with("solid.") ? name.find('/') : std::string::npos;
      if (solid < 0) solid = loose_solid(end == std::string::npos ? "" : name.substr(0, end));
      faces.push_back({TopoDS::Face(shape), end == std::string::npos ? name : name.substr(end + 1),
                       color, solid});
      return;
    }
    // Open shells are no solids of their own.
    const bool shell = shape.ShapeType() == TopAbs_SHELL && solid < 0 && BRep_Tool::IsClosed(shape);
    const bool closes = shape.ShapeType() == TopAbs_SOLID || shell;
    if (closes) solid = n_solids++;
    for (TopoDS_Iterator it(shape); it.More(); it.Next()) {
      const std::string own = labels_.of(it.Value());
      const auto own_color = color_of(it.Value());
      descend(it.Value(), own.empty() ? name : own, own_color ? own_color : color, solid);
    }
  }

  int loose_solid(const std::string& name) {
    const auto [at, is_new] = loose_.emplace(name, n_solids);
    n_solids += is_new;
    return at->second;
  }

  Handle(XCAFDoc_ShapeTool) shapes_;
  Handle(XCAFDoc_ColorTool) colors_;
  Labels labels_;
  std::map<std::string, int> loose_;
};

// What OpenCASCADE makes of the faces when it sews them, each closed shell by itself.
void find_volume(const std::vector<FoundFace>& faces, CadModel& model) {
  Bnd_Box box;
  for (const auto& face : faces) BRepBndLib::Add(face.face, box);
  BRepBuilderAPI_Sewing sewing(1e-4 * std::sqrt(box.SquareExtent()));
  for (const auto& face : faces) sewing.Add(face.face);
  sewing.Perform();
  model.n_free_edges = sewing.NbFreeEdges();
  if (model.n_free_edges > 0) return;
  double volume = 0;
  for (TopExp_Explorer shell(sewing.SewedShape(), TopAbs_SHELL); shell.More(); shell.Next()) {
    GProp_GProps inside;
    BRepGProp::VolumeProperties(shell.Current(), inside, 1e-9);
    volume += std::abs(inside.Mass());
  }
  model.volume = volume * metres * metres * metres;
}

// For each face found whether OpenCASCADE turned it about: where loops on a closed surface bound
// two regions, as circles on a sphere do, its reader may take the wrong one, and then turns the
// face so that the solid closes. Solids most of whose faces are turned are turned as a whole.
std::vector<bool> find_wrong_sides(const std::vector<FoundFace>& found, int n_solids,
                                   const std::vector<TopoDS_Shape>& oriented) {
  std::vector<bool> wrong(found.size(), false);
  std::vector<int> n_faces(n_solids, 0), n_wrong(n_solids, 0);
  for (size_t f = 0; f < found.size(); ++f) {
    const auto as_in_file = std::find_if(oriented.begin(), oriented.end(), [&](const auto& face) {
      return face.IsSame(found[f].face);
    });
    wrong[f] =
        as_in_file != oriented.end() && as_in_file->Orientation() != found[f].face.Orientation();
    ++n_faces[found[f].solid];
    n_wrong[found[f].solid] += wrong[f];
  }
  for (size_t f = 0; f < found.size(); ++f)
    if (2 * n_wrong[found[f].solid] >= n_faces[found[f].solid]) wrong[f] = false;
  return wrong;
}

double area_of(const TopoDS_Face& face) {
  GProp_GProps surface;
  BRepGProp::SurfaceProperties(face, surface, 1e-9);
  return surface.Mass() * metres * metres;
}

}  // namespace

bool has_cad() { return true; }

CadModel read_cad(const std::string& file, bool measure) {
  const bool iges = is_iges(file);
  require_whole(file, iges);
  quiet_occt();
  try {
    const Document document = read_document(file, iges);
    const FaceFinder found(document.document);
    if (found.faces.empty()) throw InputError(file, "", "a CAD file without faces", readable);
    CadModel model;
    model.unit = document.unit;
    model.n_solids = found.n_solids;
    std::map<std::string, int> count;
    for (const auto& face : found.faces) ++count[plain_name(face.name)];
    std::set<std::string> used;
    const auto wrong_side = find_wrong_sides(found.faces, found.n_solids, document.faces);
    for (size_t f = 0; f < found.faces.size(); ++f) {
      const auto& face = found.faces[f];
      std::string name = plain_name(face.name);
      const std::string group = name.empty() ? "part" : name;
      for (int k = 1; name.empty() || count[name] > 1 || used.count(name) > 0; ++k)
        name = group + "." + std::to_string(k);
      used.insert(name);
      if (wrong_side[f])
        throw InputError("", "face '" + name + "'",
                         "loops of which OpenCASCADE takes the wrong side, on a closed surface",
                         "such a face in smaller pieces, or the model as IGES");
      CadPart part = part_of_face(face.face, name, model.notes);
      part.color = face.color;
      part.solid = face.solid;
      model.parts.push_back(std::move(part));
      if (!measure) continue;
      model.area.push_back(area_of(face.face));
    }
    if (measure) find_volume(found.faces, model);
    return model;
  } catch (const InputError& error) {
    if (std::string(error.what()).starts_with(file)) throw;
    throw InputError(file, error);
  } catch (const Standard_Failure& failure) {
    throw InputError(
        file, "", std::string("what OpenCASCADE cannot read (") + failure.GetMessageString() + ")",
        readable);
  }
}

}  // namespace sem
