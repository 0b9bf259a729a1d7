// SPDX-License-Identifier: Apache-2.0
// Loads the plugin on demand: a program linked to the kernel itself would take 50 ms to start.
#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "obvid/cad/plugin.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;

/// Folders in which the plugin may lie: named by the user, beside the program, installed with it.
std::vector<fs::path> folders() {
  std::vector<fs::path> out;
  if (const char* named = std::getenv("OBVID_PLUGINS")) out.emplace_back(named);
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored);
  if (!program.empty()) {
    const fs::path folder = program.parent_path();
    out.push_back(folder);
    out.push_back(folder.parent_path());  // test programs lie one folder deeper
    out.push_back(folder.parent_path() / "lib" / "obvid");
  }
  return out;
}

Error missing(std::string what, std::string where) {
  return {
      ErrorCode::kUnsupported,
      std::move(what),
      std::move(where),
      "install libocct-data-exchange-dev and libtbb-dev and build with -DOBVID_CAD=ON, or write "
      ".dxf or .svg instead",
      -1,
      0.0};
}

Result<const CadPlugin*> load() {
  std::string reason;
  for (const fs::path& folder : folders()) {
    const fs::path file = folder / kCadPluginFile;
    std::error_code ignored;
    if (!fs::exists(file, ignored)) continue;
    void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
      const char* text = ::dlerror();
      reason = text != nullptr ? text : "unknown reason";
      continue;
    }
    using Entry = const CadPlugin* (*)();
    const auto entry = reinterpret_cast<Entry>(::dlsym(library, kCadPluginSymbol));
    const CadPlugin* plugin = entry != nullptr ? entry() : nullptr;
    if (plugin != nullptr && plugin->built == build_mark()) return plugin;
    reason = file.string() + " was built with another version of the program";
    ::dlclose(library);
  }
  if (reason.empty()) {
    return fail(missing("STEP, IGES and BREP need the plugin " + std::string(kCadPluginFile) +
                            ", which is not installed",
                        ""));
  }
  return fail(missing("the plugin for STEP, IGES and BREP cannot be loaded", reason));
}

const Result<const CadPlugin*>& plugin() {
  static const Result<const CadPlugin*> loaded = load();  // once: it stays in memory
  return loaded;
}

}  // namespace

Result<std::string> cad_text(const std::vector<CadCurve>& curves, const CadWriteOptions& options) {
  const auto& loaded = plugin();
  if (!loaded) return fail(loaded.error());
  return (*loaded)->write(curves, options);
}

Result<Drawing> read_cad(const std::string& path) {
  const auto& loaded = plugin();
  if (!loaded) return fail(loaded.error());
  return (*loaded)->read(path);
}

Result<std::string> cad_surface_text(const SurfaceModel& model, const CadWriteOptions& options) {
  const auto& loaded = plugin();
  if (!loaded) return fail(loaded.error());
  return (*loaded)->write_surfaces(model, options);
}

Result<CadSurfaces> read_cad_surfaces(const std::string& path) {
  const auto& loaded = plugin();
  if (!loaded) return fail(loaded.error());
  return (*loaded)->read_surfaces(path);
}

bool is_cad_text(std::string_view text) {
  constexpr std::size_t kHead = 4096;
  const std::string_view head = text.substr(0, kHead);
  if (head.find("ISO-10303-21") != std::string_view::npos) return true;
  if (head.find("DBRep_DrawableShape") != std::string_view::npos) return true;
  if (head.find("CASCADE Topology") != std::string_view::npos) return true;
  // IGES: column 73 of the first line says S, then the number 1
  const std::string_view line = head.substr(0, head.find('\n'));
  constexpr std::size_t kColumn = 72;
  return line.size() > kColumn && line[kColumn] == 'S' &&
         line.substr(kColumn + 1).find('1') != std::string_view::npos;
}

}  // namespace obvid
