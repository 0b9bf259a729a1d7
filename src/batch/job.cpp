// SPDX-License-Identifier: Apache-2.0
#include "job.h"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <string_view>
#include <utility>

#include "obvid/core/files.h"
#include "obvid/core/internal/name_pattern.h"
#include "obvid/obvid.h"
#include "report_figures.h"
#include "source.h"

namespace obvid::batch {
namespace {

using Clock = std::chrono::steady_clock;

struct FreeHandle {
  void operator()(obvid_input* handle) const { obvid_input_free(handle); }
  void operator()(obvid_contour* handle) const { obvid_contour_free(handle); }
  void operator()(obvid_space* handle) const { obvid_space_free(handle); }
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

bool has_report(std::string_view job) { return job != "fit" && job != "convert" && job != "space"; }

constexpr std::array<std::string_view, 8> kJobs{"fit",     "space",   "analyse", "region",
                                                "compare", "suggest", "verify",  "convert"};

using ReportJob = int (*)(const obvid_input*, const char*, const obvid_run*, char**, obvid_error**);

ReportJob report_job(std::string_view job) {
  if (job == "analyse") return &obvid_analyse;
  if (job == "region") return &obvid_region;
  if (job == "compare") return &obvid_compare;
  return &obvid_suggest;
}

/// What the callback of a run asks: whether to stop, and whether the time of the item is over.
struct Asked {
  const std::function<bool()>* stopped = nullptr;
  Clock::time_point until = Clock::time_point::max();
  static int ask(void* user) {
    const auto* self = static_cast<const Asked*>(user);
    return (*self->stopped)() || Clock::now() >= self->until ? 1 : 0;
  }
};

/// One item at work.
struct Work {
  const JobSpec& spec;
  const obvid_run& run;
  Owned<obvid_input> input{};
  Owned<obvid_contour> contour{};
  Owned<obvid_space> space{};
  Owned<char> report{};
  Owned<obvid_error> error{};
};

bool z_changes(const Item& item) {
  for (std::size_t i = 5; i < item.numbers.size(); i += 3) {
    if (item.numbers[i] != item.numbers[2]) return true;
  }
  return false;
}

/// Points of the plane of an item; of three coordinates the first two.
std::vector<double> plane_points(const Item& item) {
  if (item.dimension == 2) return item.numbers;
  std::vector<double> out;
  for (std::size_t i = 0; i + 2 < item.numbers.size(); i += 3) {
    out.push_back(item.numbers[i]);
    out.push_back(item.numbers[i + 1]);
  }
  return out;
}

std::vector<double> space_points(const Item& item) {
  if (item.dimension == 3) return item.numbers;
  std::vector<double> out;
  for (std::size_t i = 0; i + 1 < item.numbers.size(); i += 2) {
    out.insert(out.end(), {item.numbers[i], item.numbers[i + 1], 0.0});
  }
  return out;
}

/// A failure that the library does not know of, as a row has it.
struct Trouble {
  int code = 0;
  std::string what;
};

Trouble read_points_of(const Item& item, Work& work) {
  if (work.spec.job == "space") {
    const std::vector<double> xyz = space_points(item);
    obvid_space_points(xyz.data(), xyz.size() / 3, Out(work.input), Out(work.error));
    return {};
  }
  if (item.dimension == 3 && z_changes(item)) {
    return {static_cast<int>(ErrorCode::kBadOption),
            "z changes: the job `space` forms curves in space"};
  }
  const std::vector<double> xy = plane_points(item);
  obvid_points(xy.data(), xy.size() / 2, Out(work.input), Out(work.error));
  return {};
}

Trouble read_item(const Item& item, Work& work) {
  const Trouble too_large{static_cast<int>(ErrorCode::kUnsupported),
                          "larger than an item of a batch may be (64 MB)"};
  switch (item.kind) {
    case Item::Kind::kPoints:
      return read_points_of(item, work);
    case Item::Kind::kText:
      if (item.text.size() > kMostItemBytes) return too_large;
      obvid_read_text(item.text.data(), item.text.size(), item.name.c_str(), Out(work.input),
                      Out(work.error));
      return {};
    case Item::Kind::kFile:
      break;
  }
  struct stat found {};
  if (::stat(item.name.c_str(), &found) == 0) {
    if (!S_ISREG(found.st_mode)) {  // a pipe would be waited for
      return {static_cast<int>(ErrorCode::kCannotOpen), "this is no plain file"};
    }
    if (static_cast<std::size_t>(found.st_size) > kMostItemBytes) return too_large;
  }
  obvid_read_file(item.name.c_str(), Out(work.input), Out(work.error));
  return {};
}

void do_job(Work& work) {
  const std::string& job = work.spec.job;
  const char* const options = work.spec.options.c_str();
  const bool reported = !work.spec.reports.empty() || has_report(job);
  Out<char> report(work.report);
  char** const to_report = reported ? static_cast<char**>(report) : nullptr;
  if (job == "fit") {
    obvid_fit(work.input.get(), options, &work.run, Out(work.contour), to_report, Out(work.error));
  } else if (job == "space") {
    obvid_fit_space(work.input.get(), options, &work.run, Out(work.space), to_report,
                    Out(work.error));
  } else if (job == "verify" || job == "convert") {
    obvid_stored(work.input.get(), options, &work.run, Out(work.contour), Out(work.error));
    if (work.contour && job == "verify") {
      obvid_verify(work.contour.get(), &work.run, to_report, Out(work.error));
    }
  } else {
    report_job(job)(work.input.get(), options, &work.run, to_report, Out(work.error));
  }
}

/// Writes a text into a folder that is made when it is missing.
Result<void> write_made(const std::string& path, std::string_view text) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code ignored;  // the writing says what is wrong
  if (!folder.empty()) std::filesystem::create_directories(folder, ignored);
  return write_file(path, text);
}

/// "name.step" with "-2" between name and ending.
std::string with_suffix(const std::string& path, const std::string& suffix) {
  const std::filesystem::path name(path);
  return (name.parent_path() / (name.stem().string() + suffix + name.extension().string()))
      .string();
}

Result<void> write_each(Work& work, const std::string& id, std::size_t number) {
  for (const std::string& pattern : work.spec.each) {
    const std::string path = name_of_file(pattern, id, number);
    const std::string ending = std::filesystem::path(path).extension().string();
    const std::string format = ending.empty() ? "" : ending.substr(1);
    Owned<obvid_files> files;
    if (work.contour) {
      obvid_export(work.contour.get(), format.c_str(), work.spec.formats.c_str(), Out(files),
                   Out(work.error));
    } else if (work.space) {
      obvid_space_export(work.space.get(), format.c_str(), work.spec.formats.c_str(), Out(files),
                         Out(work.error));
    }
    for (std::size_t k = 0; files && k < obvid_files_count(files.get()); ++k) {
      std::size_t size = 0;
      const char* const data = obvid_files_data(files.get(), k, &size);
      const char* const suffix = obvid_files_suffix(files.get(), k);
      auto done = write_made(with_suffix(path, suffix == nullptr ? "" : suffix), {data, size});
      if (!done) return done;
    }
  }
  if (!work.spec.reports.empty() && work.report) {
    return write_made(name_of_file(work.spec.reports, id, number), work.report.get());
  }
  return {};
}

obvid_figures figures_of_work(const Work& work) {
  obvid_figures out{};
  if (work.contour) {
    obvid_contour_figures(work.contour.get(), &out);
  } else if (work.space) {
    obvid_space_figures(work.space.get(), &out);
  } else {
    out = unknown_figures();
  }
  if (work.spec.job == "convert" && work.contour)
    out.proved = -1;  // the file's claim, not looked at
  return out;
}

std::string message_of(const Work& work, const Trouble& trouble) {
  if (trouble.code != 0) return trouble.what;
  if (!work.error) return {};
  std::string out = work.error->message;
  if (*work.error->where != '\0') out += " (" + std::string(work.error->where) + ")";
  return out;
}

/// Texts of rows are one line of bounded length: a file may put anything into a message.
std::string one_line(std::string text, std::size_t most) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  }
  if (text.size() <= most) return text;
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0U) == 0x80U) --most;
  return text.substr(0, most);
}

constexpr std::size_t kLongestMessage = 300;  // bytes
constexpr std::size_t kLongestId = 1000;

class RowMaker {
 public:
  explicit RowMaker(Columns& rows) : rows_(rows) {}
  void text(std::string value) { rows_.all[next_++].texts.push_back(std::move(value)); }
  void number(double value) { rows_.all[next_++].numbers.push_back(value); }

 private:
  Columns& rows_;
  std::size_t next_ = 0;
};

void add_row(const std::string& id, const Work& work, const Trouble& trouble, double seconds,
             Columns& rows) {
  const int code = trouble.code != 0 ? trouble.code : work.error ? work.error->code : 0;
  obvid_figures figures = figures_of_work(work);
  std::vector<double> more = take_report(work.spec.job, work.report.get(), figures);
  const bool formed = work.contour || work.space || work.report;
  Status status = code == 0 ? Status::kDone : Status::kFailed;
  if (code != 0 && formed && code / 100 == OBVID_NOT_PROVED) status = Status::kNotKept;
  if (status == Status::kNotKept) figures.proved = std::min(figures.proved, 0);
  RowMaker row(rows);
  row.text(one_line(id, kLongestId));
  row.number(static_cast<double>(status));
  row.number(code);
  row.text(one_line(message_of(work, trouble), kLongestMessage));
  for (const int count : {figures.points, figures.pieces, figures.vertices, figures.bound,
                          figures.inflections, figures.corners, figures.proved}) {
    row.number(count);
  }
  for (const double length : {figures.error, figures.move, figures.width}) row.number(length);
  for (const double one : more) row.number(one);
  row.number(seconds);
}

Columns columns_of_job(const std::string& job) {
  using enum Column::Type;
  Columns out;
  out.all = {
      {"id", kText, "name of the item"},
      {"status", kSmall, "0 done, 1 formed but a promise is not kept, 2 failed"},
      {"code", kCount, "number of the error, 401 for E401; 0 none"},
      {"message", kText, "what is wrong"},
      {"points", kCount, "of the item; here and below -1 or NaN: not known"},
      {"pieces", kCount, "of the contour"},
      {"vertices", kCount, "extrema of the curvature"},
      {"bound", kCount, "no curve that follows the points has fewer vertices"},
      {"inflections", kCount, "changes of sign of the curvature"},
      {"corners", kCount, "joints that are continuous in position only"},
      {"proved", kSmall, "1 every claim is proved, 0 not, -1 nothing was to be proved"},
      {"error", kNumber, "largest distance to a monotone curve with the same elements, units"},
      {"move", kNumber, "largest distance of a point from the contour, upper bound, units"},
      {"width", kNumber, "largest width of the region, units"},
  };
  for (Column& column : report_columns(job)) out.all.push_back(std::move(column));
  out.all.push_back({"seconds", kNumber, "on the clock of the machine that did it"});
  return out;
}

/// Points that no option is foreign to: an arc of a spiral with many of them.
Item trial_item() {
  Item item;
  item.id = item.name = "trial";
  constexpr int kPoints = 400;
  for (int i = 0; i < kPoints; ++i) {
    const double turn = 3.0 * i / kPoints;
    const double radius = 100.0 * std::exp(0.2 * turn);
    item.numbers.push_back(radius * std::cos(turn));
    item.numbers.push_back(radius * std::sin(turn));
  }
  return item;
}

}  // namespace

std::string name_of_file(const std::string& pattern, const std::string& id, std::size_t number) {
  std::string safe;
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  for (std::size_t i = 0; i < id.size(); ++i) {
    const auto c = static_cast<unsigned char>(id[i]);
    const bool hides = c == '.' && i == 0;
    if (c < ' ' || c == 0x7f || c == '/' || c == '\\' || c == '%' || hides) {
      safe += {'%', kDigits[c >> 4U], kDigits[c & 15U]};
    } else {
      safe += id[i];
    }
  }
  return filled(pattern, {{kPlaceOfId, safe}, {kPlaceOfNumber, std::to_string(number)}});
}

Job::Job(JobSpec spec) : spec_(std::move(spec)), columns_(columns_of_job(spec_.job)) {}

Result<Job> Job::make(JobSpec spec) {
  if (std::find(kJobs.begin(), kJobs.end(), spec.job) == kJobs.end()) {
    return fail({ErrorCode::kUsage, "there is no job '" + spec.job + "'", "--job",
                 "jobs are fit, space, analyse, region, compare, suggest, verify, convert"});
  }
  const bool draws = spec.job == "fit" || spec.job == "space" || spec.job == "convert";
  if (!spec.each.empty() && !draws) {
    return fail({ErrorCode::kBadOption, "the job " + spec.job + " makes no curves", "--each",
                 "--reports keeps its reports"});
  }
  if (spec.job == "convert" && spec.each.empty()) {
    return fail({ErrorCode::kUsage, "convert needs files to write", "--each",
                 "write --each 'curves/{id}.step'"});
  }
  if (!spec.reports.empty() && spec.job == "convert") {
    return fail({ErrorCode::kBadOption, "convert makes no report", "--reports", ""});
  }
  for (const std::string* pattern : {&spec.reports, spec.each.empty() ? nullptr : &spec.each[0]}) {
    if (pattern == nullptr || pattern->empty()) continue;
    if (!has_place(*pattern, kPlaceOfId) && !has_place(*pattern, kPlaceOfNumber)) {
      return fail({ErrorCode::kBadOption, "all items would be the same file", *pattern,
                   "put {id} or {number} into the name"});
    }
  }
  Job job(std::move(spec));
  if (job.spec_.job == "verify" || job.spec_.job == "convert") return job;
  JobSpec trial = job.spec_;
  trial.reports.clear();
  const obvid_run run{};
  Work work{trial, run};
  read_item(trial_item(), work);
  do_job(work);
  for (const std::string& pattern : trial.each) {
    if (!work.contour) break;
    Owned<obvid_files> files;
    const std::string ending = std::filesystem::path(pattern).extension().string();
    const std::string format = ending.empty() ? "" : ending.substr(1);
    obvid_export(work.contour.get(), format.c_str(), trial.formats.c_str(), Out(files),
                 Out(work.error));
    if (work.error) break;
  }
  if (work.error && work.error->category == OBVID_USAGE) {
    return fail({static_cast<ErrorCode>(work.error->code), work.error->message, work.error->where,
                 work.error->advice});
  }
  return job;
}

Result<bool> Job::run(const Item& item, std::size_t number, Columns& rows,
                      const std::function<bool()>& stopped) const {
  const auto begin = Clock::now();
  Asked asked{&stopped};
  if (spec_.most_seconds > 0.0) {
    asked.until = begin + std::chrono::duration_cast<Clock::duration>(
                              std::chrono::duration<double>(spec_.most_seconds));
  }
  const obvid_run run{&asked, nullptr, &Asked::ask};
  Work work{spec_, run};
  const Trouble trouble = read_item(item, work);
  if (work.input && trouble.code == 0) do_job(work);
  if (stopped()) return false;
  if (trouble.code == 0) {
    OBVID_TRY(write_each(work, item.id, number));
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  add_row(item.id, work, trouble, seconds, rows);
  return true;
}

}  // namespace obvid::batch
