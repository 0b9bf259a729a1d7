// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/internal/part_program.h"

#include <link.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <string>
#include <utility>

#include "obvid/core/files.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;

/// Some megabytes are usual; what is larger is no part.
constexpr off_t kLargestPart = off_t{1} << 28;

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

Error unusable(const PartProgram& part, const std::string& why, std::string hint) {
  return error(ErrorCode::kUnsupported, std::string(part.what) + " is not started: " + why)
      .hint(std::move(hint));
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

std::vector<fs::path> part_folders(const fs::path& own) {
  if (own.empty()) return {};
  return {own.parent_path(), own.parent_path().parent_path() / "libexec" / "obvid"};
}

Result<void> check_part(const fs::path& file, const fs::path& own, const PartProgram& part) {
  const std::string rebuild = "build or install the program and its parts together";
  const std::string name = file.string();
  struct stat found {
  }, program{};
  if (::stat(file.c_str(), &found) != 0 || !S_ISREG(found.st_mode) ||
      found.st_size > kLargestPart) {
    return fail(unusable(part, name + " is no program", rebuild));
  }
  const bool programs_owner = ::stat(own.c_str(), &program) == 0 && found.st_uid == program.st_uid;
  if (found.st_uid != 0 && found.st_uid != ::geteuid() && !programs_owner) {
    return fail(unusable(part, name + " belongs to another user", rebuild));
  }
  if ((found.st_mode & S_IWOTH) != 0) {
    return fail(unusable(part, "everybody may write to " + name, "chmod o-w " + name));
  }
  const auto bytes = read_file(name);
  if (!bytes) return fail(unusable(part, name + " cannot be read", rebuild));
  if (bytes->find(part.mark) == std::string::npos) {
    return fail(unusable(part, name + " belongs to another build of the program", rebuild));
  }
  return {};
}

Result<std::optional<fs::path>> find_part(const std::vector<fs::path>& folders, const fs::path& own,
                                          const PartProgram& part) {
  for (const fs::path& folder : folders) {
    const fs::path file = folder / part.file;
    std::error_code ignored;
    if (!fs::exists(fs::symlink_status(file, ignored))) continue;
    OBVID_TRY(check_part(file, own, part));
    return file;
  }
  return std::nullopt;
}

}  // namespace obvid
