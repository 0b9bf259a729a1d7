// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "columns.h"
#include "item.h"
#include "job_kinds.h"
#include "obvid/core/result.h"
#include "obvid/obvid.h"

namespace obvid::batch {

/// What is done with every item.
struct JobSpec {
  std::string job = "fit";        ///< of the table in job_kinds.h
  std::string options = "{}";     ///< JSON, names of the command line
  std::string formats = "{}";     ///< those of the files
  std::vector<std::string> each;  ///< names of a contour's files: "curves/{id}.step"
  std::string reports;            ///< of reports: "reports/{id}.json"; empty: none
  std::string against;            ///< file that items are held against; empty: none
  std::string profile;            ///< file of heights of an alignment: "levels/{name}"; empty: none
  double most_seconds = 0.0;      ///< of an item, E103 beyond; 0: as long as it takes
};

/// Values of `status`.
enum class Status { kDone = 0, kNotKept = 1, kFailed = 2 };

/// One job over the C interface, by many threads at once.
class Job {
 public:
  /// Tries the options on input of its own. Errors: E201, E202, E203 what no item could bear;
  /// those of reading the file `against`.
  static Result<Job> make(JobSpec spec);

  [[nodiscard]] const JobSpec& spec() const { return spec_; }
  /// The columns of its rows, without rows.
  [[nodiscard]] const Columns& columns() const { return columns_; }
  /// Works on one item and adds its row: whatever the item is, there is a row. Files are written
  /// whole. False, and no row: it was stopped. Error: E102 a file that cannot be written.
  [[nodiscard]] Result<bool> run(const Item& item, std::size_t number, Columns& rows,
                                 const std::function<bool()>& stopped) const;

 private:
  Job(JobSpec spec, const JobKind& kind);
  /// E201, E202, E203 of options on input that has nothing against them.
  [[nodiscard]] Result<void> try_options() const;
  JobSpec spec_;
  const JobKind* kind_;
  std::shared_ptr<const obvid_input> against_;
  Columns columns_;
};

/// The name of an item's file: {id} and {number} in the pattern, what no file name should hold
/// (separators, control characters, leading dots) as %XX.
[[nodiscard]] std::string name_of_file(const std::string& pattern, const std::string& id,
                                       std::size_t number);

/// The same of heights, where {name} is the last part of the id too: "a.csv" of "roads/a.csv".
[[nodiscard]] std::string heights_file(const std::string& pattern, const std::string& id,
                                       std::size_t number);

}  // namespace obvid::batch
