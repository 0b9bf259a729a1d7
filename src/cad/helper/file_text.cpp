// SPDX-License-Identifier: Apache-2.0
#include "file_text.h"

#include <fmt/format.h>

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepTools.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESData_IGESWriter.hxx>
#include <IGESSelect_WorkLibrary.hxx>
#include <Interface_FloatWriter.hxx>
#include <Interface_Static.hxx>
#include <STEPConstruct.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <StepBasic_Product.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TransferBRep.hxx>
#include <Transfer_FinderProcess.hxx>
#include <XSControl_TransferWriter.hxx>
#include <XSControl_WorkSession.hxx>
#include <sstream>

#include "obvid/core/version.h"
#include "obvid/exchange/internal/step/letters.h"
#include "units.h"

namespace obvid::cad {
namespace {

/// Dates would make the same contour another file every time.
constexpr const char* kNoDate = "1970-01-01T00:00:00";
constexpr const char* kNoIgesDate = "19700101.000000";
constexpr const char* kProgram = "Obvid";

/// The kernel cuts numbers off at 9 digits behind the point (IGES) or 15 characters (STEP), too few
/// for curvature. Its buffer has room for 23 characters: 16 digits with sign, point and exponent.
constexpr const char* kAllDigits = "%#.16G";

Error failed(const char* what) {
  return error(ErrorCode::kInternal, std::string("the CAD kernel could not write ") + what)
      .hint("look at the geometry with `obvid verify` or `obvid surface check`");
}

Handle(TCollection_HAsciiString) word(const char* text) {
  return new TCollection_HAsciiString(text);
}

/// The kernel numbers the products of one process; the same content shall give the same file.
void name_products(const std::string& name, const Handle(StepData_StepModel) & model) {
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const auto product = Handle(StepBasic_Product)::DownCast(model->Value(i));
    if (product.IsNull()) continue;
    product->SetId(word(name.c_str()));
    product->SetName(word(name.c_str()));
  }
}

void name_faces(const FileContent& content, const STEPControl_Writer& writer) {
  const Handle(Transfer_FinderProcess) made = writer.WS()->TransferWriter()->FinderProcess();
  for (std::size_t i = 0; i < content.faces.size(); ++i) {
    const Handle(StepRepr_RepresentationItem) item =
        STEPConstruct::FindEntity(made, content.faces[i]);
    if (!item.IsNull()) item->SetName(word(content.names[i].c_str()));
  }
}

Result<std::string> step_text(const FileContent& content, const Unit& unit, bool ap242) {
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("write.step.schema", ap242 ? "AP242DIS" : "AP214IS");
  Interface_Static::SetCVal("write.step.unit", unit.kernel);
  Interface_Static::SetCVal("write.step.product.name", content.name.c_str());
  Interface_Static::SetIVal("write.surfacecurve.mode", 0);
  // of what the kernel repairs before it writes, faces need nothing; copies would lose their names
  Interface_Static::SetCVal("write.step.sequence", "Nothing");
  STEPControl_Writer writer;
  if (writer.Transfer(content.shape, STEPControl_AsIs) != IFSelect_RetDone) {
    return fail(failed("STEP"));
  }
  name_products(content.name, writer.Model());
  name_faces(content, writer);
  APIHeaderSection_MakeHeader header(writer.Model());
  header.SetName(word(content.name.c_str()));
  header.SetTimeStamp(word(kNoDate));
  header.SetOriginatingSystem(word(kProgram));
  header.SetPreprocessorVersion(word((std::string(kProgram) + " " + kVersion).c_str()));
  header.Apply(writer.Model());
  StepData_StepWriter out(writer.Model());
  out.FloatWriter().SetFormat(kAllDigits);
  out.SendModel(Handle(StepData_Protocol)::DownCast(writer.WS()->Protocol()));
  std::ostringstream text;
  if (!out.Print(text) || text.str().empty()) return fail(failed("STEP"));
  return in_step_letters(text.str());
}

/// IGES knows ASCII only; a letter of several bytes becomes one question mark.
std::string in_ascii(const std::string& name, std::size_t most) {
  std::string out;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0U) == 0x80 || out.size() == most) continue;
    out += byte < 0x80 ? c : '?';
  }
  return out;
}

/// IGES labels have 8 characters.
void label_faces(const FileContent& content, const IGESControl_Writer& writer) {
  constexpr std::size_t kLabel = 8;
  for (std::size_t i = 0; i < content.faces.size(); ++i) {
    const Handle(IGESData_IGESEntity) entity = Handle(IGESData_IGESEntity)::DownCast(
        TransferBRep::TransientFromShape(writer.TransferProcess(), content.faces[i]));
    if (!entity.IsNull()) entity->SetLabel(word(in_ascii(content.names[i], kLabel).c_str()));
  }
}

Result<std::string> iges_text(const FileContent& content, const Unit& unit) {
  constexpr std::size_t kFileName = 60;  // within one line of the global section
  IGESControl_Controller::Init();
  Interface_Static::SetIVal("write.iges.brep.mode", 0);
  IGESControl_Writer writer(unit.kernel == std::string("INCH") ? "IN" : unit.kernel, 0);
  if (!writer.AddShape(content.shape)) return fail(failed("IGES"));
  writer.ComputeModel();
  label_faces(content, writer);
  IGESData_GlobalSection global = writer.Model()->GlobalSection();
  global.SetDate(word(kNoIgesDate));
  global.SetLastChangeDate(word(kNoIgesDate));
  global.SetSystemId(word(kProgram));
  global.SetAuthorName(word(kProgram));
  global.SetFileName(
      word(content.faces.empty() ? "contour" : in_ascii(content.name, kFileName).c_str()));
  writer.Model()->SetGlobalSection(global);
  IGESData_IGESWriter out(writer.Model());
  out.FloatWriter().SetFormat(kAllDigits);
  out.SendModel(IGESSelect_WorkLibrary::DefineProtocol());
  std::ostringstream text;
  if (!out.Print(text) || text.str().empty()) return fail(failed("IGES"));
  return text.str();
}

}  // namespace

Result<double> scale_of(CadFormat format, const std::string& unit) {
  if (format == CadFormat::kBrep) return 1.0;  // these files have no unit
  const auto known = unit_of(unit);
  OBVID_TRY(known);
  return known->millimetres;  // the kernel thinks in mm and writes the unit that it is told
}

Result<std::string> text_of(const FileContent& content, CadFormat format, const std::string& unit) {
  if (format == CadFormat::kBrep) {
    std::ostringstream text;
    BRepTools::Write(content.shape, text);
    return text.str();
  }
  const auto known = unit_of(unit);
  OBVID_TRY(known);
  if (format == CadFormat::kIges) return iges_text(content, *known);
  return step_text(content, *known, format == CadFormat::kStepAp242);
}

}  // namespace obvid::cad
