// SPDX-License-Identifier: Apache-2.0
#include "load.h"

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_IGESEntity.hxx>
#include <Interface_InterfaceModel.hxx>
#include <STEPControl_Reader.hxx>
#include <StepShape_Face.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopoDS.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <fstream>

#include "obvid/core/files.h"

namespace obvid::cad {
namespace {

Error unreadable(const std::string& path, const char* format) {
  return error(ErrorCode::kDamaged,
               std::string("the CAD kernel cannot read this ") + format + " file")
      .where(path)
      .hint("the file may be cut off or damaged; export it again");
}

/// Remembers the names of faces, as STEP (items) and IGES (labels) have them.
template <class Entity, class Name>
void collect_names(const XSControl_Reader& reader, Loaded& loaded, Name name_of) {
  const Handle(Transfer_TransientProcess) made = reader.WS()->TransferReader()->TransientProcess();
  const Handle(Interface_InterfaceModel) model = reader.Model();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Handle(Entity) entity = Handle(Entity)::DownCast(model->Value(i));
    if (entity.IsNull()) continue;
    const std::string name = name_of(entity);
    if (name.empty()) continue;
    const TopoDS_Shape shape = TransferBRep::ShapeResult(made, entity);
    if (shape.IsNull() || shape.ShapeType() != TopAbs_FACE) continue;
    TopLoc_Location place;
    const Handle(Geom_Surface) surface = BRep_Tool::Surface(TopoDS::Face(shape), place);
    if (!surface.IsNull()) loaded.name_of_surface.emplace(surface.get(), name);
  }
}

/// Without the blanks that IGES fills up with.
std::string trimmed(const Handle(TCollection_HAsciiString) & text) {
  if (text.IsNull()) return {};
  const std::string all = text->ToCString();
  const std::size_t first = all.find_first_not_of(' ');
  if (first == std::string::npos) return {};
  return all.substr(first, all.find_last_not_of(' ') - first + 1);
}

Result<Loaded> read_step(const std::string& path) {
  STEPControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone || reader.TransferRoots() == 0) {
    return fail(unreadable(path, "STEP"));
  }
  Loaded loaded;
  loaded.shape = reader.OneShape();
  collect_names<StepShape_Face>(
      reader, loaded, [](const Handle(StepShape_Face) & face) { return trimmed(face->Name()); });
  return loaded;
}

Result<Loaded> read_iges(const std::string& path) {
  IGESControl_Reader reader;
  if (reader.ReadFile(path.c_str()) != IFSelect_RetDone || reader.TransferRoots() == 0) {
    return fail(unreadable(path, "IGES"));
  }
  Loaded loaded;
  loaded.shape = reader.OneShape();
  collect_names<IGESData_IGESEntity>(
      reader, loaded, [](const Handle(IGESData_IGESEntity) & entity) {
        return entity->HasName() ? trimmed(entity->NameValue()) : std::string{};
      });
  return loaded;
}

Result<Loaded> read_brep(const std::string& path) {
  Loaded loaded;
  loaded.units = Units();
  BRep_Builder builder;
  std::ifstream file(path, std::ios::binary);
  file.exceptions(std::ios::failbit |
                  std::ios::badbit);  // behind the end the kernel goes on for ever
  try {
    BRepTools::Read(loaded.shape, file, builder);
  } catch (const std::ios_base::failure&) {
    return fail(unreadable(path, "BREP"));
  }
  if (loaded.shape.IsNull()) return fail(unreadable(path, "BREP"));
  return loaded;
}

}  // namespace

Result<Loaded> load(const std::string& path) {
  if (!std::ifstream(path)) {
    return error(ErrorCode::kCannotOpen, "cannot read the file")
        .where(path)
        .hint("check path and permissions");
  }
  constexpr std::size_t kHead = 4096;
  const std::string head = head_of_file(path, kHead);
  if (head.find("ISO-10303-21") != std::string::npos) return read_step(path);
  if (head.find("DBRep_DrawableShape") != std::string::npos ||
      head.find("CASCADE Topology") != std::string::npos) {
    return read_brep(path);
  }
  return read_iges(path);
}

}  // namespace obvid::cad
