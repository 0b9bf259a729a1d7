// SPDX-License-Identifier: Apache-2.0
#include "write.h"

#include <stdlib.h>  // mkdtemp

#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepTools.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TCollection_HAsciiString.hxx>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "obvid/core/version.h"
#include "shapes.h"
#include "units.h"

namespace obvid::cad {
namespace {

namespace fs = std::filesystem;

/// Dates would make the same contour another file every time.
constexpr const char* kNoDate = "1970-01-01T00:00:00";
constexpr const char* kNoIgesDate = "19700101.000000";
constexpr const char* kProgram = "Obvid";

/// A folder that goes with its object: the kernel's writers want a name of a file.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code error;
    std::string pattern = (fs::temp_directory_path(error) / "obvid-XXXXXX").string();
    if (::mkdtemp(pattern.data()) != nullptr) path_ = pattern;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  [[nodiscard]] bool exists() const { return !path_.empty(); }
  [[nodiscard]] std::string file(const char* name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

Error failed(const char* what) {
  return {ErrorCode::kInternal,
          std::string("the CAD kernel could not write ") + what,
          "",
          "check that the folder for temporary files has room",
          -1,
          0.0};
}

Result<std::string> content_of(const std::string& path, const char* what) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file || text.str().empty()) return fail(failed(what));
  return text.str();
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
  const TemporaryFolder folder;
  const std::string file = folder.file("contour.step");
  if (!folder.exists() || writer.Write(file.c_str()) != IFSelect_RetDone) {
    return fail(failed("STEP"));
  }
  auto text = content_of(file, "STEP");
  if (!text) return text;
  return without_numbers(std::move(*text), name);
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
  std::ostringstream text;
  if (!writer.Write(text)) return fail(failed("IGES"));
  return text.str();
}

}  // namespace

Result<std::string> write_text(const std::vector<CadCurve>& curves,
                               const CadWriteOptions& options) {
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
