// SPDX-License-Identifier: Apache-2.0
// One item at work over the C interface.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "item.h"
#include "job.h"
#include "job_kinds.h"
#include "obvid/obvid.h"

namespace obvid::batch {

struct FreeHandle {
  void operator()(obvid_input* handle) const { obvid_input_free(handle); }
  void operator()(obvid_contour* handle) const { obvid_contour_free(handle); }
  void operator()(obvid_space* handle) const { obvid_space_free(handle); }
  void operator()(obvid_surface* handle) const { obvid_surface_free(handle); }
  void operator()(obvid_files* handle) const { obvid_files_free(handle); }
  void operator()(obvid_error* handle) const { obvid_error_free(handle); }
  void operator()(char* text) const { obvid_free(text); }
};
template <class Handle>
using Owned = std::unique_ptr<Handle, FreeHandle>;

/// Takes what a function of the C interface hands out.
template <class Handle>
class Out {
 public:
  explicit Out(Owned<Handle>& to) : to_(to) {}
  Out(const Out&) = delete;
  Out& operator=(const Out&) = delete;
  ~Out() {
    if (made_ != nullptr) to_.reset(made_);
  }
  operator Handle**() { return &made_; }  // NOLINT: as the C interface takes it

 private:
  Owned<Handle>& to_;
  Handle* made_ = nullptr;
};

struct Work {
  const JobSpec& spec;
  const JobKind& kind;
  const obvid_run& run;
  const obvid_input* against = nullptr;  ///< of --against
  Owned<obvid_input> input{};
  Owned<obvid_input> heights{};  ///< of --profile
  Owned<obvid_contour> contour{};
  Owned<obvid_space> space{};
  Owned<obvid_surface> surface{};
  Owned<obvid_files> files{};
  Owned<char> report{};
  Owned<obvid_error> error{};
};

/// A failure that the library does not know of, as a row has it.
struct Trouble {
  int code = 0;
  std::string what;
};

[[nodiscard]] Trouble read_item(const Item& item, Work& work);
/// The heights of an alignment.
[[nodiscard]] Trouble read_heights(const std::string& path, Work& work);
void do_job(Work& work);
/// Paths and bytes of what a file of --each is to hold; what hinders it is in `work.error`.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> files_at(Work& work,
                                                                        const std::string& path);

}  // namespace obvid::batch
