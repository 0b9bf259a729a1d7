// SPDX-License-Identifier: Apache-2.0
#include "helper_file.h"

#include <stdlib.h>

#include <string>

#include "cad_build_mark.h"
#include "obvid/core/internal/named_builder.h"

namespace obvid::cad {
namespace {

namespace fs = std::filesystem;

Result<fs::path> installed_helper() {
  const fs::path own = own_file();
  const auto found =
      find_part(helper_folders(own), own, helper_with("obvid-cad " OBVID_CAD_BUILD_MARK));
  if (!found) return fail(found.error());
  if (*found) return **found;
  return fail(
      {ErrorCode::kUnsupported,
       "this needs the helper program " + std::string(kHelperFile) + ", which is not installed", "",
       "install libocct-data-exchange-dev and libtbb-dev and build with -DOBVID_CAD=ON; "
       "contours leave as .step, .dxf or .svg without it",
       -1, 0.0});
}

}  // namespace

PartProgram helper_with(std::string_view mark) {
  return {"the helper for STEP, IGES and BREP", kHelperFile, mark};
}

std::vector<fs::path> helper_folders(const fs::path& own) {
  std::vector<fs::path> out = part_folders(own);
  if (const char* named = ::secure_getenv("OBVID_PLUGINS"); named != nullptr && *named != '\0') {
    out.insert(out.begin(), named);
  }
  return out;
}

Result<fs::path> helper_file() {
  auto helper = installed_helper();
  return helper || !run_named_builder("OBVID_CAD_BUILDER") ? helper : installed_helper();
}

}  // namespace obvid::cad
