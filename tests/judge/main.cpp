// SPDX-License-Identifier: Apache-2.0
// The judge: see docs/methods/judge.md.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "checks.h"
#include "process.h"
#include "sentences.h"
#include "texts.h"
#include "trial.h"

namespace judge {
namespace {

constexpr const char* kUsage =
    "usage: judge --series N [--of fit|scan|space|nurbs|spline|region] [--seed S] [--first I]\n"
    "             [--jobs J] [--obvid PROGRAM] [--keep FOLDER] [--json FILE] [--limit SECONDS] "
    "[--most "
    "FINDINGS]\n"
    "       judge CONTOUR.json [--points FILE] [--options \"OPTIONS OF fit\"] [--text FILE]\n"
    "             [--verify FILE] [--export FILE]... [--json FILE]\n"
    "Exit code 0: nothing false; 1: something is; 2: wrong usage.\n";

struct Settings {
  TrialOptions trial;
  std::uint64_t series = 0, first = 0;
  int jobs = 2;
  std::size_t most = 12;  ///< findings shown per claim
  std::string keep, json, contour, points, options, text, verify;
  std::vector<std::string> exports;
  bool wrong = false;
};

Settings settings_of(int argc, char** argv) {
  Settings out;
  out.trial.obvid = "./obvid";
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    if (!name.starts_with("--")) {
      out.contour = name;
      continue;
    }
    if (++i == argc) {
      out.wrong = true;
      return out;
    }
    const std::string value = argv[i];
    if (name == "--series")
      out.series = std::strtoull(value.c_str(), nullptr, 10);
    else if (name == "--of")
      out.trial.of = value;
    else if (name == "--seed")
      out.trial.seed = std::strtoull(value.c_str(), nullptr, 10);
    else if (name == "--first")
      out.first = std::strtoull(value.c_str(), nullptr, 10);
    else if (name == "--jobs")
      out.jobs = std::max(1, std::atoi(value.c_str()));
    else if (name == "--most")
      out.most = std::strtoull(value.c_str(), nullptr, 10);
    else if (name == "--limit")
      out.trial.limit = std::atof(value.c_str());
    else if (name == "--obvid")
      out.trial.obvid = value;
    else if (name == "--keep")
      out.keep = value;
    else if (name == "--json")
      out.json = value;
    else if (name == "--points")
      out.points = value;
    else if (name == "--options")
      out.options = value;
    else if (name == "--text")
      out.text = value;
    else if (name == "--verify")
      out.verify = value;
    else if (name == "--export")
      out.exports.push_back(value);
    else
      out.wrong = true;
  }
  const std::set<std::string> kinds = {"fit", "scan", "space", "nurbs", "spline", "region"};
  out.wrong =
      out.wrong || (out.series == 0) == out.contour.empty() || !kinds.contains(out.trial.of);
  return out;
}

void print_table(const Sheet& sheet) {
  fmt::print("{:<44}{:>10}{:>8}{:>10}{:>9}\n", "claim", "judged", "false", "unjudged", "missing");
  Counts all;
  for (const auto& [claim, n] : sheet.counts()) {
    fmt::print("{:<44}{:>10}{:>8}{:>10}{:>9}\n", claim, n.judged, n.wrong, n.unjudged, n.missing);
    all.judged += n.judged;
    all.wrong += n.wrong;
    all.unjudged += n.unjudged;
    all.missing += n.missing;
  }
  fmt::print("{:<44}{:>10}{:>8}{:>10}{:>9}\n", "all", all.judged, all.wrong, all.unjudged,
             all.missing);
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return out;
}

std::string finding_json(const Finding& f) {
  constexpr const char* kKinds[] = {"false", "unjudged", "missing"};
  return fmt::format(
      R"({{"kind": "{}", "claim": "{}", "stated": "{}", "found": "{}", "where": "{}"}})",
      kKinds[static_cast<int>(f.kind)], escaped(f.claim), escaped(f.stated), escaped(f.found),
      escaped(f.where));
}

std::string counts_json(const Sheet& sheet) {
  std::string out;
  for (const auto& [claim, n] : sheet.counts()) {
    out += fmt::format(
        R"({}    "{}": {{"judged": {}, "false": {}, "unjudged": {}, "missing": {}}})",
        out.empty() ? "\n" : ",\n", escaped(claim), n.judged, n.wrong, n.unjudged, n.missing);
  }
  return out;
}

void print_finding(const Finding& f) {
  if (f.kind == Finding::Kind::kFalse) {
    fmt::print("  false  {}: stated {}, found {}{}\n", f.claim, f.stated, f.found,
               f.where.empty() ? "" : " (" + f.where + ")");
  } else if (f.kind == Finding::Kind::kUnjudged) {
    fmt::print("  not judged  {}: {}{}\n", f.claim, f.found,
               f.where.empty() ? "" : " (" + f.where + ")");
  }
}

/// No exit code is known of a stored report, but its verdict; widths have none.
int code_said_by(const std::string& report, const ContourFile& file) {
  const std::vector<std::string> lines = lines_of(report);
  return file.too_wide() || (!lines.empty() && lines.back().starts_with("NOT proved")) ? 5 : 0;
}

int judge_file(const Settings& settings) {
  Sheet sheet;
  const std::string stored = text_of_file(settings.contour);
  const ReadContour read = read_contour(stored);
  if (stored.find("obvid-space-c") != std::string::npos) {
    judge_space(stored, settings.text.empty() ? "" : text_of_file(settings.text), sheet);
  } else if (!read.fault.empty()) {
    sheet.fails("file", settings.contour, read.fault, "");
  } else {
    const Course course(read.contour);
    if (settings.points.empty()) {
      judge_course(course, sheet);
    } else {
      const Input input = read_input(text_of_file(settings.points), words_of(settings.options));
      if (input.construction.empty()) {
        judge_course(course, sheet);
        check_input(course, input, sheet);
      } else {
        judge_constructed(course, input, sheet);
      }
    }
    Run run;
    run.input_name = std::filesystem::path(settings.points).filename().string();
    if (!settings.text.empty()) {
      run.out = text_of_file(settings.text);
      check_fit_text(course, run, sheet);
    }
    if (!settings.verify.empty()) {
      const int fit_code = settings.text.empty() ? -1 : code_said_by(run.out, read.contour);
      run.out = text_of_file(settings.verify);
      run.code = code_said_by(run.out, read.contour);
      check_verify_text(course, run, sheet, fit_code);
    }
    const std::string report = settings.text.empty() ? "" : text_of_file(settings.text);
    for (const std::string& file : settings.exports) {
      check_export(course, std::filesystem::path(file).filename().string(), text_of_file(file),
                   notes_of(report, file), sheet);
    }
  }
  print_table(sheet);
  for (const Finding& f : sheet.findings()) print_finding(f);
  if (!settings.json.empty()) {
    std::string list;
    for (const Finding& f : sheet.findings()) {
      list += (list.empty() ? "\n    " : ",\n    ") + finding_json(f);
    }
    write_file(settings.json,
               fmt::format("{{\n  \"claims\": {{{}\n  }},\n  \"findings\": [{}]\n}}\n",
                           counts_json(sheet), list));
  }
  return sheet.wrong() == 0 ? 0 : 1;
}

/// What a run over many series has seen.
class Ledger {
 public:
  explicit Ledger(const Settings& settings) : settings_(settings) {}

  void enter(Trial trial) {
    const std::lock_guard<std::mutex> only(lock_);
    ++outcomes_[name_of(trial.outcome)];
    program_ += trial.program_seconds;
    judge_ += trial.judge_seconds;
    if (trial.slowest > slowest_) {
      slowest_ = trial.slowest;
      slowest_index_ = trial.index;
    }
    trials_.push_back(std::move(trial));
  }

  int report() {
    std::sort(trials_.begin(), trials_.end(),
              [](const Trial& a, const Trial& b) { return a.index < b.index; });
    Sheet all;
    for (const Trial& trial : trials_) all.add(trial.sheet);
    print_table(all);
    fmt::print("\n");
    for (const auto& [name, count] : outcomes_) fmt::print("{:<24}{:>8}\n", name, count);
    fmt::print(
        "program {:.1f} s, judge {:.1f} s ({:.2f} ms a series), slowest run {:.2f} s (#{})\n",
        program_, judge_, 1e3 * judge_ / static_cast<double>(trials_.size()), slowest_,
        slowest_index_);
    examples(Finding::Kind::kFalse, "false");
    examples(Finding::Kind::kUnjudged, "not judged");
    if (!settings_.json.empty()) write_file(settings_.json, json(all));
    return all.wrong() == 0 ? 0 : 1;
  }

 private:
  /// Of each claim the examples with the fewest points.
  void examples(Finding::Kind kind, const char* title) const {
    struct Example {
      const Trial* trial;
      const Finding* finding;
    };
    std::map<std::string, std::vector<Example>> by_claim;
    std::map<std::string, long> series;
    for (const Trial& trial : trials_) {
      std::map<std::string, bool> met;
      for (const Finding& f : trial.sheet.findings()) {
        if (f.kind != kind || met[f.claim]) continue;
        met[f.claim] = true;
        by_claim[f.claim].push_back({&trial, &f});
        ++series[f.claim];
      }
    }
    for (auto& [claim, list] : by_claim) {
      fmt::print("\n{}: {} in {} series\n", title, claim, series[claim]);
      std::stable_sort(list.begin(), list.end(), [](const Example& a, const Example& b) {
        return a.trial->points < b.trial->points;
      });
      for (std::size_t k = 0; k < std::min(settings_.most, list.size()); ++k) {
        fmt::print("  #{} ({}, {} points): stated {}, found {} ({})\n    {}\n",
                   list[k].trial->index, list[k].trial->family, list[k].trial->points,
                   list[k].finding->stated, list[k].finding->found, list[k].finding->where,
                   list[k].trial->command);
      }
    }
  }

  [[nodiscard]] std::string json(const Sheet& all) const {
    std::string list;
    for (const Trial& trial : trials_) {
      if (trial.sheet.findings().empty()) continue;
      std::string findings;
      for (const Finding& f : trial.sheet.findings()) {
        if (f.kind == Finding::Kind::kMissing) continue;
        findings += (findings.empty() ? "" : ", ") + finding_json(f);
      }
      if (findings.empty()) continue;
      list += fmt::format(
          R"({}    {{"series": {}, "family": "{}", "outcome": "{}", "command": "{}", "findings": [{}]}})",
          list.empty() ? "\n" : ",\n", trial.index, trial.family, name_of(trial.outcome),
          escaped(trial.command), findings);
    }
    return fmt::format("{{\n  \"seed\": {},\n  \"claims\": {{{}\n  }},\n  \"series\": [{}]\n}}\n",
                       settings_.trial.seed, counts_json(all), list);
  }

  const Settings& settings_;
  std::mutex lock_;
  std::vector<Trial> trials_;
  std::map<std::string, long> outcomes_;
  double program_ = 0.0, judge_ = 0.0, slowest_ = 0.0;
  std::uint64_t slowest_index_ = 0;
};

void keep_files(const Settings& settings, const Trial& trial, const std::string& folder) {
  if (settings.keep.empty()) return;
  const bool wanted = settings.series == 1 || trial.sheet.wrong() > 0;
  if (!wanted) return;
  const auto to =
      std::filesystem::path(settings.keep) / fmt::format("{}_{}", settings.trial.seed, trial.index);
  std::filesystem::remove_all(to);
  std::filesystem::create_directories(to.parent_path());
  std::filesystem::copy(folder, to, std::filesystem::copy_options::recursive);
  std::string text = trial.command + "\n";
  for (const Finding& f : trial.sheet.findings()) text += finding_json(f) + "\n";
  write_file((to / "findings.txt").string(), text);
}

int judge_series(Settings settings) {
  settings.trial.obvid = std::filesystem::absolute(settings.trial.obvid).string();
  const auto base = std::filesystem::temp_directory_path() /
                    fmt::format("obvid-judge-{}", static_cast<long>(getpid()));
  Ledger ledger(settings);
  std::atomic<std::uint64_t> next{settings.first};
  const auto work = [&](int job) {
    TrialOptions options = settings.trial;
    options.folder = (base / std::to_string(job)).string();
    while (true) {
      const std::uint64_t index = next++;
      if (index >= settings.first + settings.series) return;
      Trial trial = run_trial(options, index);
      keep_files(settings, trial, options.folder);
      ledger.enter(std::move(trial));
    }
  };
  std::vector<std::thread> threads;
  for (int job = 1; job < settings.jobs; ++job) threads.emplace_back(work, job);
  work(0);
  for (std::thread& thread : threads) thread.join();
  std::filesystem::remove_all(base);
  return ledger.report();
}

}  // namespace
}  // namespace judge

int main(int argc, char** argv) {
  const judge::Settings settings = judge::settings_of(argc, argv);
  if (settings.wrong) {
    fmt::print(stderr, "{}", judge::kUsage);
    return 2;
  }
  return settings.series > 0 ? judge::judge_series(settings) : judge::judge_file(settings);
}
