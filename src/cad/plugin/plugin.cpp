// SPDX-License-Identifier: Apache-2.0
#include "obvid/cad/plugin.h"

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <Standard_Failure.hxx>
#include <exception>
#include <new>

#include "isolated.h"
#include "message.h"
#include "read.h"
#include "read_faces.h"
#include "write.h"

namespace obvid {
namespace {

/// The kernel's chatter belongs neither into the report nor into the errors.
void be_quiet() { Message::DefaultMessenger()->ChangePrinters().Clear(); }

/// A file that cannot be read is the file's fault; geometry that cannot be written is ours.
Error fault(const std::string& text, const std::string& where) {
  const bool reading = !where.empty();
  return {reading ? ErrorCode::kNotText : ErrorCode::kInternal,
          "the CAD kernel gave up: " + text,
          where,
          reading ? "the file may be damaged; export it again"
                  : "look at it with `obvid verify` or `obvid surface check`",
          -1,
          0.0};
}

/// Nothing that the kernel throws leaves the plugin.
template <class Value, class Work>
Result<Value> guarded(const std::string& where, Work work) {
  try {
    be_quiet();
    return work();
  } catch (const Standard_Failure& failure) {
    const char* text = failure.GetMessageString();
    return fail(fault(text != nullptr && *text != '\0' ? text : "unknown reason", where));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    return fail(fault(error.what(), where));
  }
}

Result<std::string> write(const std::vector<CadCurve>& curves, const CadWriteOptions& options) {
  return guarded<std::string>("", [&] { return cad::write_text(curves, options); });
}

Result<Drawing> read(const std::string& path) {
  const std::string bytes = cad::isolated(
      [&] { return cad::packed(guarded<Drawing>(path, [&] { return cad::read_file(path); })); });
  return cad::unpacked(bytes, path);
}

Result<std::string> write_surfaces(const SurfaceModel& model, const CadWriteOptions& options) {
  return guarded<std::string>("", [&] { return cad::write_surfaces(model, options); });
}

Result<CadSurfaces> read_surfaces(const std::string& path) {
  const std::string bytes = cad::isolated([&] {
    return cad::packed(guarded<CadSurfaces>(path, [&] { return cad::read_faces(path); }));
  });
  return cad::unpacked_surfaces(bytes, path);
}

}  // namespace
}  // namespace obvid

extern "C" __attribute__((visibility("default"))) const obvid::CadPlugin* obvid_cad_plugin() {
  static const std::string built = obvid::build_mark();
  static const obvid::CadPlugin plugin = {built.c_str(), &obvid::write, &obvid::read,
                                          &obvid::write_surfaces, &obvid::read_surfaces};
  return &plugin;
}
