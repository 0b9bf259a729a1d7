// SPDX-License-Identifier: Apache-2.0
#include "job.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "item_work.h"
#include "obvid/core/files.h"
#include "obvid/core/internal/name_pattern.h"
#include "obvid/obvid.h"
#include "report_figures.h"

namespace obvid::batch {
namespace {

using Clock = std::chrono::steady_clock;

/// What the callback of a run asks: whether to stop, and whether the time of the item is over.
struct Asked {
  const std::function<bool()>* stopped = nullptr;
  Clock::time_point until = Clock::time_point::max();
  static int ask(void* user) {
    const auto* self = static_cast<const Asked*>(user);
    return (*self->stopped)() || Clock::now() >= self->until ? 1 : 0;
  }
};

/// Writes a text into a folder that is made when it is missing.
Result<void> write_made(const std::string& path, std::string_view text) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::error_code ignored;  // the writing says what is wrong
  if (!folder.empty()) std::filesystem::create_directories(folder, ignored);
  return write_file(path, text);
}

Result<void> write_each(Work& work, const std::string& id, std::size_t number) {
  for (const std::string& pattern : work.spec.each) {
    for (const auto& [path, data] : files_at(work, name_of_file(pattern, id, number))) {
      OBVID_TRY(write_made(path, data));
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

/// What the command would have warned of, one behind the other; `all`: what the report has.
std::string warnings_of(const Work& work, std::vector<std::string> all) {
  const auto add = [&](const auto& made, auto warning_at) {
    for (std::size_t k = 0; made && warning_at(made.get(), k) != nullptr; ++k) {
      all.emplace_back(warning_at(made.get(), k));
    }
  };
  add(work.contour, &obvid_contour_warning);
  add(work.space, &obvid_space_warning);
  add(work.surface, &obvid_surface_warning);
  std::string out;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto before = all.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::find(all.begin(), before, all[i]) != before) continue;  // report and result say it
    out += (out.empty() ? "" : "; ") + all[i];
  }
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
  TakenReport taken = take_report(work.kind, work.report.get(), figures);
  const bool formed = work.contour || work.space || work.report;
  Status status = code == 0 ? Status::kDone : Status::kFailed;
  if (code != 0 && formed && code / 100 == OBVID_NOT_PROVED) status = Status::kNotKept;
  if (status == Status::kNotKept) figures.proved = std::min(figures.proved, 0);
  RowMaker row(rows);
  row.text(one_line(id, kLongestId));
  row.number(static_cast<double>(status));
  row.number(code);
  row.text(one_line(message_of(work, trouble), kLongestMessage));
  row.text(one_line(warnings_of(work, std::move(taken.warnings)), kLongestMessage));
  for (const int count : {figures.points, figures.pieces, figures.vertices, figures.bound,
                          figures.inflections, figures.corners, figures.proved}) {
    row.number(count);
  }
  for (const double length : {figures.error, figures.move, figures.width}) row.number(length);
  for (const double one : taken.values) row.number(one);
  row.number(seconds);
}

Columns columns_of_job(const JobKind& kind) {
  using enum Column::Type;
  Columns out;
  out.all = {
      {"id", kText, "name of the item"},
      {"status", kSmall, "0 done, 1 formed but a promise is not kept, 2 failed"},
      {"code", kCount, "number of the error, 401 for E401; 0 none"},
      {"message", kText, "what is wrong"},
      {"warnings", kText, "what may be wrong: the warnings of the command, the first 300 bytes"},
      {"points", kCount, "of the item; here and below -1 or NaN: not known"},
      {"pieces", kCount, "of the contour"},
      {"vertices", kCount, "extrema of the curvature"},
      {"bound", kCount, "no curve that does not wind between the points has fewer vertices"},
      {"inflections", kCount, "changes of sign of the curvature"},
      {"corners", kCount, "joints that are continuous in position only"},
      {"proved", kSmall, "1 every claim is proved, 0 not, -1 nothing was to be proved"},
      {"error", kNumber, "largest distance to a monotone curve with the same elements, units"},
      {"move", kNumber, "largest distance of a point from the contour, upper bound, units"},
      {"width", kNumber, "largest width of the region, units"},
  };
  for (Column& column : report_columns(kind)) out.all.push_back(std::move(column));
  out.all.push_back({"seconds", kNumber, "on the clock of the machine that did it"});
  return out;
}

/// Points that no option is foreign to: an arc of a spiral with many of them.
Item trial_points(int count) {
  Item item;
  item.id = item.name = "trial";
  for (int i = 0; i < count; ++i) {
    const double turn = 3.0 * i / count;
    const double radius = 100.0 * std::exp(0.2 * turn);
    item.numbers.push_back(radius * std::cos(turn));
    item.numbers.push_back(radius * std::sin(turn));
  }
  return item;
}

Item trial_text(std::string name, std::string text) {
  Item item;
  item.id = "trial";
  item.name = std::move(name);
  item.kind = Item::Kind::kText;
  item.text = std::move(text);
  return item;
}

Item trial_circle(double diameter) {
  return trial_text(
      "trial.svg",
      fmt::format(R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}mm" height="{0}mm" )"
                  R"(viewBox="0 0 2 2"><circle cx="1" cy="1" r="1"/></svg>)",
                  diameter));
}

/// Points that say their unit, which some formats have to know.
Item trial_metres(int count) {
  const Item points = trial_points(count);
  std::string text = "x_m,y_m\n";
  for (std::size_t i = 0; i < points.numbers.size(); i += 2) {
    text += fmt::format("{},{}\n", points.numbers[i], points.numbers[i + 1]);
  }
  return trial_text("trial.csv", std::move(text));
}

Item trial_line(int count) {
  Item item;
  item.id = item.name = "trial";
  for (int i = 0; i < count; ++i) item.numbers.insert(item.numbers.end(), {1.0 * i, 1.0 * i});
  return item;
}

/// Input of each kind, of which one bears any option that some item could bear.
std::vector<Item> trial_items(const JobKind& kind) {
  constexpr int kPoints = 400, kFewPoints = 12;
  if (kind.name == "spline") return {trial_line(kFewPoints)};
  if (kind.name == "nurbs") return {trial_text("trial.csv", "")};  // points may be named by number
  if (kind.name == "cut") return {trial_circle(20.0), trial_circle(20000.0)};
  if (kind.name == "alignment") return {trial_line(kFewPoints), trial_metres(kFewPoints)};
  if (kind.name == "fit") return {trial_points(kPoints), trial_metres(kPoints)};
  return {trial_points(kPoints)};
}

/// Which curve of a drawing it is: of the trial there is one.
std::string without_curve(const std::string& options) {
  auto all = nlohmann::json::parse(options, nullptr, false);
  if (all.is_object()) all.erase("curve");
  return all.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Errors: E201, E202, E203 of names and of what is asked for.
Result<const JobKind*> checked_kind(const JobSpec& spec) {
  const JobKind* const kind = kind_named(spec.job, !spec.against.empty());
  if (kind == nullptr && kind_named(spec.job, false) == nullptr) {
    return fail({ErrorCode::kUsage, "there is no job '" + spec.job + "'", "--job",
                 "jobs are " + known_jobs()});
  }
  if (kind == nullptr) {
    return fail({ErrorCode::kBadOption, "the job " + spec.job + " holds items against nothing",
                 "--against", "compare and spline do"});
  }
  const bool draws = kind->draws != Draws::kNothing;
  if (!spec.each.empty() && !draws) {
    return fail({ErrorCode::kBadOption, "the job " + spec.job + " makes no curves", "--each",
                 spec.job == "compare" ? "with --against FILE it draws; --reports keeps its reports"
                                       : "--reports keeps its reports"});
  }
  for (const std::string& pattern : spec.each) {
    if (has_text_for(*kind, pattern)) continue;
    return fail(
        {ErrorCode::kUnknownFormat, "the job " + spec.job + " makes no such file", pattern,
         spec.job == "cut" ? "possible are .nc, .svg and .dxf" : "possible are .svg, .csv"});
  }
  if (!spec.profile.empty() && spec.job != "alignment") {
    return fail({ErrorCode::kBadOption, "the job " + spec.job + " has no heights", "--profile",
                 "alignment has"});
  }
  if (kind->needs_each && spec.each.empty()) {
    return fail({ErrorCode::kUsage, "convert needs files to write", "--each",
                 "write --each 'curves/{id}.step'"});
  }
  if (!spec.reports.empty() && kind->needs_each) {
    return fail({ErrorCode::kBadOption, "convert makes no report", "--reports", ""});
  }
  for (const std::string* pattern : {&spec.reports, spec.each.empty() ? nullptr : &spec.each[0]}) {
    if (pattern == nullptr || pattern->empty()) continue;
    if (!has_place(*pattern, kPlaceOfId) && !has_place(*pattern, kPlaceOfNumber)) {
      return fail({ErrorCode::kBadOption, "all items would be the same file", *pattern,
                   "put {id} or {number} into the name"});
    }
  }
  return kind;
}

Error error_of(const obvid_error& error) {
  return {static_cast<ErrorCode>(error.code), error.message, error.where, error.advice};
}

Result<std::shared_ptr<const obvid_input>> read_against(const std::string& path) {
  if (path.empty()) return std::shared_ptr<const obvid_input>();
  Owned<obvid_input> read;
  Owned<obvid_error> error;
  obvid_read_file(path.c_str(), Out(read), Out(error));
  if (error) return fail(error_of(*error));
  return std::shared_ptr<const obvid_input>(std::move(read));
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

std::string heights_file(const std::string& pattern, const std::string& id, std::size_t number) {
  const std::string name = std::filesystem::path(id).filename().string();
  return name_of_file(filled(pattern, {{"{name}", name}}), id, number);
}

Job::Job(JobSpec spec, const JobKind& kind)
    : spec_(std::move(spec)), kind_(&kind), columns_(columns_of_job(kind)) {}

Result<void> Job::try_options() const {
  if (spec_.job == "verify" || spec_.job == "convert") return {};
  JobSpec trial = spec_;
  trial.reports.clear();
  if (spec_.job == "cut") trial.options = without_curve(trial.options);
  Owned<obvid_error> found;
  for (const Item& item : trial_items(*kind_)) {
    const obvid_run run{nullptr, nullptr, nullptr, 1};
    Work work{trial, *kind_, run, against_.get()};
    (void)read_item(item, work);
    do_job(work);
    for (const std::string& pattern : trial.each) {
      if (kind_->draws == Draws::kByEnding) break;  // other tables make other files
      if (!work.error) (void)files_at(work, pattern);
    }
    if (!work.error || work.error->category != OBVID_USAGE) return {};
    found = std::move(work.error);
  }
  return fail(error_of(*found));
}

Result<Job> Job::make(JobSpec spec) {
  const auto kind = checked_kind(spec);
  OBVID_TRY(kind);
  Job job(std::move(spec), **kind);
  auto against = read_against(job.spec_.against);
  OBVID_TRY(against);
  job.against_ = std::move(*against);
  OBVID_TRY(job.try_options());
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
  const obvid_run run{&asked, nullptr, &Asked::ask, 1};  // others run beside it
  Work work{spec_, *kind_, run, against_.get()};
  Trouble trouble = read_item(item, work);
  if (work.input && trouble.code == 0 && !spec_.profile.empty()) {
    trouble = read_heights(heights_file(spec_.profile, item.id, number), work);
  }
  if (work.input && trouble.code == 0 && !work.error) do_job(work);
  if (stopped()) return false;
  if (trouble.code == 0) {
    OBVID_TRY(write_each(work, item.id, number));
  }
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  add_row(item.id, work, trouble, seconds, rows);
  return true;
}

}  // namespace obvid::batch
