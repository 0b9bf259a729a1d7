// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "batch_build_mark.h"
#include "help/help_lines.h"
#include "index.h"
#include "job_options.h"
#include "merge.h"
#include "obvid/core/internal/data_table.h"
#include "obvid/core/internal/file_ending.h"
#include "obvid/core/version.h"
#include "progress_line.h"
#include "share.h"
#include "work.h"

/// What the program looks for in this file before it starts it; not folded into other code.
extern "C" {
extern const char obvid_batch_mark[];
const char obvid_batch_mark[] = "obvid-batch " OBVID_BATCH_BUILD_MARK;
}

namespace obvid::batch {
namespace {

constexpr std::size_t kHelpColumn = 30;

volatile std::sig_atomic_t interrupted = 0;

void note_interrupt(int signal) {
  interrupted = 1;
  std::signal(signal, SIG_DFL);  // a second one ends at once
}

bool stopped() { return interrupted != 0; }

int report(const Error& error) {
  fmt::print(stderr, "{}\n", to_line(error));
  return exit_code(error.code);
}

/// What the command line said.
struct Asked {
  SourceOptions sources;
  std::vector<std::string> cuts;
  std::string out;
  JobSpec job;
  JobOptions options;
  std::size_t jobs = 0, shard_size = 1000;
  std::string shard;
  bool merge = false, quiet = false;
};

struct AskedQuery {
  std::string table, where, order;
  std::vector<std::string> columns;
  std::size_t most = 0;
  bool csv = false;
};

void say_end(const Names& names, const Summary& summary) {
  fmt::print("{}", summary_text(summary));
  if (!summary.twice.empty()) {
    fmt::print(stderr, "obvid: warning: several items are called '{}'\n", summary.twice);
  }
  fmt::print("written  {}, {}, {}, {}\n", names.table, names.seconds, names.index, names.picture);
}

int end_of(const Names& names, const Result<Summary>& summary, bool quiet) {
  if (!summary) return report(summary.error());
  if (!quiet) say_end(names, *summary);
  return std::fflush(stdout) == 0 ? 0 : exit_code(ErrorCode::kWriteFailed);
}

int merge_only(const Asked& asked, const Names& names) {
  auto store = Store::existing(names);
  if (!store) return report(store.error());
  return end_of(names, merge(names, *store), asked.quiet);
}

/// Without a place for what differs between items.
bool is_one_file(const std::string& pattern) { return pattern.find('{') == std::string::npos; }

Manifest manifest_of_run(const Asked& asked, const Job& job, const Source& source) {
  Manifest out;
  const JobSpec& spec = job.spec();
  out.job = spec.job;
  out.options = spec.options;
  out.formats = spec.formats;
  out.each = spec.each;
  out.reports = spec.reports;
  out.most_seconds = spec.most_seconds;
  out.program = kVersion;
  out.sources = source.mark();
  if (!spec.against.empty()) out.sources += "; " + spec.against + " " + mark_of_file(spec.against);
  if (!spec.profile.empty()) {
    out.sources += "; " + spec.profile;
    if (is_one_file(spec.profile)) out.sources += " " + mark_of_file(spec.profile);
  }
  out.remark = source.remark();
  out.items = source.size();
  out.shard_size = asked.shard_size;
  return out;
}

void say_begin(const Store& store, const Share& share, std::size_t missing) {
  const Manifest& m = store.manifest();
  if (!m.remark.empty()) fmt::print(stderr, "obvid: {}\n", m.remark);
  if (!share.from.empty()) {
    fmt::print(stderr, "obvid: shard {} of {} ({})\n", share.part.part + 1, share.part.parts,
               share.from);
  }
  if (missing < m.shards()) {
    fmt::print(stderr, "obvid: goes on, {} of {} shards are there\n", m.shards() - missing,
               m.shards());
  }
}

int run_batch(Asked& asked) {
  const Names names = names_of(asked.out);
  if (auto named = check_table_name(asked.out); !named) return report(named.error());
  const auto share = share_of(asked.shard);
  if (!share) return report(share.error());
  if (asked.merge) return merge_only(asked, names);
  for (const std::string& text : asked.cuts) {
    const auto cut = plane_row_named(text);
    if (!cut) return report(cut.error());
    asked.sources.cuts.push_back(*cut);
  }
  asked.job.options = options_json(asked.options.job);
  asked.job.formats = options_json(asked.options.files);
  const auto job = Job::make(asked.job);
  if (!job) return report(job.error());
  asked.sources.threads = asked.jobs;
  const auto source = open_sources(asked.sources);
  if (!source) return report(source.error());
  const Manifest manifest = manifest_of_run(asked, *job, **source);
  if (is_complete(names, manifest)) {
    if (!asked.quiet) fmt::print(stderr, "obvid: this batch is done, nothing is left to do\n");
    return end_of(names, summary_of(names), asked.quiet);
  }
  auto store = Store::open(names, manifest);
  if (!store) return report(store.error());
  if (auto mine = store->lock_part(share->part.part + 1, share->part.parts); !mine) {
    return report(mine.error());
  }
  if (!asked.quiet) say_begin(*store, *share, store->missing().size());
  Pace pace;
  Result<void> done;
  {
    const ProgressLine line(pace, !asked.quiet);
    done = work(**source, *job, *store, share->part, asked.jobs, pace, &stopped);
  }
  if (!done) return report(done.error());
  if (!share->from.empty()) {  // others are at work on the rest
    const std::size_t left = store->missing().size();
    if (!asked.quiet) {
      fmt::print(
          "{} items done here, {} of {} shards are missing yet; then obvid batch -o {} --merge\n",
          pace.done.load(), left, manifest.shards(), asked.out);
    }
    return 0;
  }
  return end_of(names, merge(names, *store), asked.quiet);
}

void print_answer(const Answer& answer, bool csv) {
  std::vector<std::size_t> widths;
  for (const std::string& name : answer.names) widths.push_back(name.size());
  for (const auto& row : answer.rows) {
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  }
  const auto print = [&](const std::vector<std::string>& row) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k) {
      line += csv ? (k == 0 ? "" : ",") + csv_cell(row[k])
                  : fmt::format("{}{:<{}}", k == 0 ? "" : "  ", row[k], widths[k]);
    }
    while (!csv && line.ends_with(' ')) line.pop_back();
    fmt::print("{}\n", line);
  };
  print(answer.names);
  for (const auto& row : answer.rows) print(row);
  if (!csv) fmt::print("{} items\n", answer.rows.size());
}

int run_query(const AskedQuery& asked) {
  const std::string index =
      has_ending(asked.table, ".sqlite") ? asked.table : names_of(asked.table).index;
  const auto answer = ask_index(index, {asked.where, asked.columns, asked.order, asked.most});
  if (!answer) return report(answer.error());
  print_answer(*answer, asked.csv);
  return std::fflush(stdout) == 0 ? 0 : exit_code(ErrorCode::kWriteFailed);
}

void add_batch(CLI::App& app, Asked& asked) {
  app.add_option("SOURCE", asked.sources.paths,
                 "Files, folders, zip archives, tables with an id column, HDF5 files; meshes with "
                 "--cut");
  app.add_option("-o,--output", asked.out, "Table to write, out.h5; others get names beside it")
      ->required()
      ->option_text("OUT");
  app.add_option("--jobs", asked.jobs, "Items at work at once [as many as there are processors]")
      ->option_text("N");
  app.add_option("--job", asked.job.job, known_jobs() + " [fit]; --job NAME --help has its options")
      ->option_text("NAME");
  app.add_option("--against", asked.job.against,
                 "compare: curve that every item is laid over; spline: more of the same function")
      ->option_text("FILE");
  app.add_option(
         "--profile", asked.job.profile,
         "alignment: stations and heights of every item, 'levels/{name}'; {name} is that of "
         "its file [a column z]")
      ->option_text("FILE");
  app.add_option("--list", asked.sources.list, "File with a path on each line, - standard input")
      ->option_text("FILE");
  app.add_option("--pattern", asked.sources.pattern, "Of names in folders and archives: '*.dat'")
      ->option_text("GLOB");
  app.add_option("--id", asked.sources.id_column, "Column that names the series of a table [id]")
      ->option_text("NAME");
  app.add_option("--cut", asked.cuts, "Planes that cut meshes, z=FROM:STEP:TO; may be repeated")
      ->allow_extra_args(false)
      ->option_text("PLANES");
  app.add_option("--each", asked.job.each,
                 "File of every item, 'curves/{id}.step'; {number} counts from 0; may be repeated")
      ->allow_extra_args(false)
      ->option_text("NAME");
  app.add_option("--reports", asked.job.reports, "Report of every item, 'reports/{id}.json'")
      ->option_text("NAME");
  app.add_option("--item-timeout", asked.job.most_seconds,
                 "An item that takes longer fails with E103, s; which ones may differ from run to "
                 "run [no limit]")
      ->option_text("S")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--shard", asked.shard,
                 "This process does part i of n [SLURM_ARRAY_TASK_ID, OMPI_COMM_WORLD_RANK where "
                 "they are set, else all]")
      ->option_text("I/N");
  app.add_option("--shard-size", asked.shard_size, "Items of a shard [1000]")
      ->option_text("N")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}));
  app.add_flag("--merge", asked.merge, "Only put the shards together");
  app.add_flag("-q,--quiet", asked.quiet, "No progress and no summary");
  add_job_options(app, asked.options);
}

int run(int argc, char** argv) {
  Asked asked;
  AskedQuery query;
  const bool queries = argc > 1 && std::string(argv[1]) == "query";
  CLI::App app(queries ? "What the index of a batch says" : "One job for many inputs",
               queries ? "obvid batch query" : "obvid batch");
  shape_help(app, kHelpColumn, argc, argv);
  app.set_version_flag("--version", obvid_batch_mark);
  if (queries) {
    app.add_option("TABLE", query.table, "out.h5 of the batch, or its .sqlite")->required();
    app.add_option("WHERE", query.where, "Condition of SQL: \"vertices > bound\" [all]");
    app.add_option("--columns", query.columns, "Columns, a,b,c [the most useful]")->delimiter(',');
    app.add_option("--order", query.order, "Order of SQL: \"seconds DESC\" [number]");
    app.add_option("--limit", query.most, "Rows at most [all]");
    app.add_flag("--csv", query.csv, "Cells with commas between them");
  } else {
    const std::string job = typed_job(argc, argv);
    asked.options = known_options(help_as_lines() || !job.empty() ? job : asked.job.job);
    add_batch(app, asked);
    // understood apart: a source may be called query
    if (help_as_lines()) app.add_subcommand("query", "What the index of a batch says");
    app.footer(
        "\nExamples:\n"
        "  obvid batch sections/ -o out.h5 --noise rounding\n"
        "  obvid batch hull.stl --cut z=0:0.5:100 -o hull.h5 --each 'curves/{id}.json'\n"
        "  obvid batch parts/ -o parts.h5 --job cut --depth 3 --each 'nc/{id}.nc'\n"
        "  obvid batch query out.h5 \"vertices > bound\"");
  }
  try {
    app.parse(queries ? argc - 1 : argc, queries ? argv + 1 : argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    return report({ErrorCode::kUsage, error.what(), "obvid batch", "see obvid batch --help"});
  }
  if (queries) return run_query(query);
  std::signal(SIGINT, note_interrupt);
  std::signal(SIGTERM, note_interrupt);
  return run_batch(asked);
}

}  // namespace
}  // namespace obvid::batch

int main(int argc, char** argv) {
  try {
    return obvid::batch::run(argc, argv);
  } catch (const std::bad_alloc&) {
    return obvid::batch::report({obvid::ErrorCode::kInternal, "out of memory", "obvid batch", ""});
  } catch (const std::exception& error) {
    return obvid::batch::report(
        {obvid::ErrorCode::kInternal, error.what(), "obvid batch", "please report this"});
  }
}
