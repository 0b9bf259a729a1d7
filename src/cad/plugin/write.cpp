// SPDX-License-Identifier: Apache-2.0
#include "write.h"

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepTools.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESData_IGESWriter.hxx>
#include <IGESSelect_WorkLibrary.hxx>
#include <Interface_FloatWriter.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <StepData_Protocol.hxx>
#include <StepData_StepModel.hxx>
#include <StepData_StepWriter.hxx>
#include <TCollection_HAsciiString.hxx>
#include <XSControl_WorkSession.hxx>
#include <mutex>
#include <sstream>

#include "obvid/core/version.h"
#include "shapes.h"
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
  return {ErrorCode::kInternal,
          std::string("the CAD kernel could not write ") + what,
          "",
          "look at the contour with `obvid verify`",
          -1,
          0.0};
}

/// The kernel numbers the products of one process; the same contour shall give the same file.
std::string without_numbers(std::string text, const std::string& name) {
  const std::string begin = "'" + name + " ";
  for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at + 1)) {
    const std::size_t digits = at + begin.size();
    const std::size_t end = text.find_first_not_of("0123456789", digits);
    if (end == std::string::npos || end == digits || text[end] != '\'') continue;
    text.erase(digits - 1, end - digits + 1);
  }
  return text;
}

Handle(TCollection_HAsciiString) word(const char* text) {
  return new TCollection_HAsciiString(text);
}

Result<std::string> step_text(const TopoDS_Shape& shape, const Unit& unit, bool ap242,
                              const std::string& name) {
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("write.step.schema", ap242 ? "AP242DIS" : "AP214IS");
  Interface_Static::SetCVal("write.step.unit", unit.kernel);
  Interface_Static::SetCVal("write.step.product.name", name.c_str());
  Interface_Static::SetIVal("write.surfacecurve.mode", 0);
  STEPControl_Writer writer;
  if (writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone) return fail(failed("STEP"));
  APIHeaderSection_MakeHeader header(writer.Model());
  header.SetName(word(name.c_str()));
  header.SetTimeStamp(word(kNoDate));
  header.SetOriginatingSystem(word(kProgram));
  header.SetPreprocessorVersion(word((std::string(kProgram) + " " + kVersion).c_str()));
  header.Apply(writer.Model());
  StepData_StepWriter out(writer.Model());
  out.FloatWriter().SetFormat(kAllDigits);
  out.SendModel(Handle(StepData_Protocol)::DownCast(writer.WS()->Protocol()));
  std::ostringstream text;
  if (!out.Print(text) || text.str().empty()) return fail(failed("STEP"));
  return without_numbers(text.str(), name);
}

Result<std::string> iges_text(const TopoDS_Shape& shape, const Unit& unit) {
  IGESControl_Controller::Init();
  Interface_Static::SetIVal("write.iges.brep.mode", 0);
  IGESControl_Writer writer(unit.kernel == std::string("INCH") ? "IN" : unit.kernel, 0);
  if (!writer.AddShape(shape)) return fail(failed("IGES"));
  writer.ComputeModel();
  IGESData_GlobalSection global = writer.Model()->GlobalSection();
  global.SetDate(word(kNoIgesDate));
  global.SetLastChangeDate(word(kNoIgesDate));
  global.SetSystemId(word(kProgram));
  global.SetAuthorName(word(kProgram));
  global.SetFileName(word("contour"));
  writer.Model()->SetGlobalSection(global);
  IGESData_IGESWriter out(writer.Model());
  out.FloatWriter().SetFormat(kAllDigits);
  out.SendModel(IGESSelect_WorkLibrary::DefineProtocol());
  std::ostringstream text;
  if (!out.Print(text) || text.str().empty()) return fail(failed("IGES"));
  return text.str();
}

}  // namespace

Result<std::string> write_text(const std::vector<CadCurve>& curves,
                               const CadWriteOptions& options) {
  static std::mutex one_at_a_time;  // the kernel keeps its settings in global variables
  const std::lock_guard lock(one_at_a_time);
  const auto unit = unit_of(options.units);
  const bool brep = options.format == CadFormat::kBrep;
  if (!brep && !unit) return fail(unit.error());
  // the kernel thinks in mm and writes the unit that it is told
  const double scale = brep ? 1.0 : unit->millimetres;
  const auto shape = shape_of(curves, scale, options.face_width);
  if (!shape) return fail(shape.error());
  if (brep) {
    std::ostringstream text;
    BRepTools::Write(*shape, text);
    return text.str();
  }
  if (options.format == CadFormat::kIges) return iges_text(*shape, *unit);
  const std::string name =
      curves.empty() || curves.front().name.empty() ? "contour" : curves.front().name;
  return step_text(*shape, *unit, options.format == CadFormat::kStepAp242, name);
}

}  // namespace obvid::cad
