// SPDX-License-Identifier: Apache-2.0
#include "helper_file.h"

#include <link.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <utility>

#include "cad_build_mark.h"
#include "obvid/core/named_builder.h"

namespace obvid::cad {
namespace {

namespace fs = std::filesystem;

/// Some megabytes are usual; what is larger is not the helper.
constexpr off_t kLargestHelper = off_t{1} << 28;

/// What the walk over the loaded programs and libraries looks for and finds.
struct Search {
  std::uintptr_t address = 0;
  bool found = false;
  std::string name;  ///< empty: the program itself
};

int look_at(dl_phdr_info* object, std::size_t, void* data) {
  auto& search = *static_cast<Search*>(data);
  for (int i = 0; i < object->dlpi_phnum; ++i) {
    const auto& part = object->dlpi_phdr[i];
    const std::uintptr_t from = object->dlpi_addr + part.p_vaddr;
    if (part.p_type != PT_LOAD || search.address - from >= part.p_memsz) continue;
    search.found = true;
    search.name = object->dlpi_name;
    return 1;
  }
  return 0;
}

Error unusable(std::string why, std::string hint) {
  return {ErrorCode::kUnsupported,
          "the helper for STEP, IGES and BREP is not started: " + std::move(why),
          "",
          std::move(hint),
          -1,
          0.0};
}

Result<fs::path> installed_helper() {
  const std::string mark = std::string(kHelperFile) + " " + OBVID_CAD_BUILD_MARK;
  const fs::path own = own_file();
  for (const fs::path& folder : helper_folders(own)) {
    const fs::path file = folder / kHelperFile;
    std::error_code ignored;
    if (!fs::exists(fs::symlink_status(file, ignored))) continue;
    if (auto good = check_helper(file, own, mark); !good) return fail(good.error());
    return file;
  }
  return fail(
      {ErrorCode::kUnsupported,
       "this needs the helper program " + std::string(kHelperFile) + ", which is not installed", "",
       "install libocct-data-exchange-dev and libtbb-dev and build with -DOBVID_CAD=ON; "
       "contours leave as .step, .dxf or .svg without it",
       -1, 0.0});
}

}  // namespace

fs::path own_file() {
  Search search;
  search.address = reinterpret_cast<std::uintptr_t>(&look_at);
  ::dl_iterate_phdr(&look_at, &search);
  std::error_code failed;
  const fs::path loaded = search.found && !search.name.empty() ? search.name : "/proc/self/exe";
  if (loaded.is_relative()) return {};  // to a folder that was left since, maybe
  const fs::path file = fs::canonical(loaded, failed);
  return failed ? fs::path() : file;
}

std::vector<fs::path> helper_folders(const fs::path& own) {
  std::vector<fs::path> out;
  if (const char* named = ::secure_getenv("OBVID_PLUGINS"); named != nullptr && *named != '\0') {
    out.emplace_back(named);
  }
  if (own.empty()) return out;
  out.push_back(own.parent_path());
  out.push_back(own.parent_path().parent_path() / "libexec" / "obvid");
  return out;
}

Result<void> check_helper(const fs::path& file, const fs::path& own, std::string_view mark) {
  const std::string rebuild = "build or install the program and its helper together";
  const std::string name = file.string();
  struct stat found {
  }, program{};
  if (::stat(file.c_str(), &found) != 0 || !S_ISREG(found.st_mode) ||
      found.st_size > kLargestHelper) {
    return fail(unusable(name + " is no program", rebuild));
  }
  const bool programs_owner = ::stat(own.c_str(), &program) == 0 && found.st_uid == program.st_uid;
  if (found.st_uid != 0 && found.st_uid != ::geteuid() && !programs_owner) {
    return fail(unusable(name + " belongs to another user", rebuild));
  }
  if ((found.st_mode & S_IWOTH) != 0) {
    return fail(unusable("everybody may write to " + name, "chmod o-w " + name));
  }
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  bytes << stream.rdbuf();
  if (!stream) return fail(unusable(name + " cannot be read", rebuild));
  if (bytes.str().find(mark) == std::string::npos) {
    return fail(unusable(name + " belongs to another build of the program", rebuild));
  }
  return {};
}

Result<fs::path> helper_file() {
  auto helper = installed_helper();
  return helper || !run_named_builder("OBVID_CAD_BUILDER") ? helper : installed_helper();
}

}  // namespace obvid::cad
