// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "commands.h"
#include "cut_options.h"
#include "obvid/core/files.h"
#include "obvid/core/internal/figures.h"
#include "obvid/pipeline/cut_job.h"
#include "obvid/pipeline/file_formats.h"
#include "obvid/pipeline/internal/job_files.h"
#include "obvid/pipeline/internal/no_such_file.h"
#include "obvid/pipeline/internal/page_text.h"
#include "outputs.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

Result<std::vector<Output>> cut_outputs(const CutCommand& command) {
  OBVID_TRY(check_outputs(command.outputs, command.inputs));
  std::vector<Output> out;
  for (const std::string& path : command.outputs) {
    const auto format = cut_format_of(path);
    if (!format) return no_such_file("a cut", known_cut_endings()).where(path);
    out.push_back({path, *format, {}});
  }
  return out;
}

Result<Drawing> drawing_of(const std::string& input, const std::vector<PlaneRow>& planes) {
  const bool piped = input == "-";
  if (!piped && (is_drawing(input) || !std::filesystem::exists(input)))
    return read_drawing(input, planes);
  const auto text = read_file(input);
  OBVID_TRY(text);
  const std::string name = piped ? "standard input" : input;
  if (is_drawing_text(*text, name)) return parse_drawing(*text, name, planes);
  return error(ErrorCode::kNothingThere, "a list of points is no outline")
      .where(name)
      .hint("form one first: obvid fit " + input + " -o outline.json, then obvid cut outline.json");
}

Result<MadeCut> cut_from(const CutCommand& command, ProgressBar& bar) {
  std::vector<Drawing> drawings;
  for (const std::string& input : command.inputs) {
    bar.tell("reading", 0.0);
    auto drawing = drawing_of(input, command.import.planes);
    OBVID_TRY(drawing);
    drawings.push_back(std::move(*drawing));
  }
  return make_cut(std::move(drawings), command.import, command.job, bar.progress());
}

std::string lengths_in(const MadeCut& made) {
  return unit_of_program(made) + (made.units.known() ? "" : ", as assumed");
}

std::string steps_table(const MadeCut& made) {
  Table table;
  table.column("order");
  table.column("curve");
  table.column("outline", Table::Align::kLeft);
  table.column("tool", Table::Align::kLeft);
  table.column("start\nx");
  table.column("\ny");
  table.column("\nlength");
  table.column("left in\ncorners");
  std::size_t number = 0;
  for (const CutStep& step : made.program.steps) {
    table.row({std::to_string(++number), std::to_string(made.curves[step.outline] + 1), step.name,
               step.side == CutSide::kOn ? "on it" : to_string(step.side),
               significant(step.start.x), significant(step.start.y), significant(step.length),
               step.left_in_corners > 0.0 ? significant_above(step.left_in_corners, 4) : "-"});
  }
  return table.text();
}

Facts cut_facts(const MadeCut& made) {
  const CutReport& r = made.program.report;
  const std::string unit = unit_of_program(made);
  Facts facts;
  facts.add("program",
            fmt::format("{} blocks along the cut, {} of them arcs, {}in {}", r.blocks, r.arc_blocks,
                        r.spline_blocks > 0 ? fmt::format("{} splines, ", r.spline_blocks) : "",
                        counted(static_cast<std::size_t>(r.levels), "pass", "passes")));
  facts.add("length",
            fmt::format("{} {} along the cut, {} {} rapid, seen from above: the time counts "
                        "ways straight up and down, too",
                        significant(r.cut_length, 5), unit, significant(r.rapid_length, 5), unit));
  facts.add("time", fmt::format("about {} minutes, with acceleration", significant(r.minutes, 3)));
  facts.add(
      "read back",
      fmt::format(
          "at most {} {} beyond an outline and {} {} short of one, found at places {} {} apart",
          significant_above(r.beyond, kDigitsOfBounds), unit,
          significant_above(r.short_of, kDigitsOfBounds), unit, significant(r.spacing, 2), unit));
  if (r.blending > 0.0) {
    facts.add(
        "blending",
        fmt::format("the controller may round corners by {} {} more (G64 P): {} of a tolerance "
                    "of {} {} in all",
                    tolerance_text(r.blending), unit,
                    significant_above(std::max(r.beyond, r.short_of) + r.blending, kDigitsOfBounds),
                    tolerance_text(made.tolerance), unit));
  }
  if (r.left_in_corners > 0.0) {
    facts.add("inner corners", fmt::format("the round tool leaves up to {} {} in them",
                                           significant_above(r.left_in_corners, 3), unit));
  }
  return facts;
}

std::string cut_text(const MadeCut& made, const std::vector<std::string>& files) {
  Facts facts = cut_facts(made);
  if (!files.empty()) facts.add("written", listed(files));
  return facts.text();
}

std::string cut_page(const MadeCut& made, const CutCommand& command) {
  const Sketch sketch = cut_sketch(made, command.job);
  ReportPage page;
  page.title = command.job.plan.name;
  page.verdict = sketch.remarks.front();
  page.pictures.push_back(sketch_svg(sketch));
  page.figures = {{"asked for", command.asked}, {"lengths in", lengths_in(made)}};
  const Facts facts = cut_facts(made);
  page.figures.insert(page.figures.end(), facts.lines().begin(), facts.lines().end());
  page.warnings = made.warnings;
  page.tables.push_back(table_of_page("outlines", "Outlines", cut_rows(made)));
  return page_text(page);
}

}  // namespace

int run(const CutCommand& command) {
  auto outputs = cut_outputs(command);
  if (!outputs) return report(outputs.error());
  ProgressBar bar(command.progress);
  const auto made = cut_from(command, bar);
  bar.clear();
  if (!made) return report(made.error());
  for (Output& output : *outputs) {
    auto text = output.format == FileFormat::kPage ? Result<std::string>(cut_page(*made, command))
                                                   : cut_file(output.format, *made, command.job);
    if (!text) return report(text.error());
    output.text = std::move(*text);
  }
  const auto written = write_files(*outputs, command.inputs.front());
  if (!written) return report(written.error());
  warn(made->warnings);
  std::string text;
  if (command.json) {
    text = cut_json(*made);
  } else if (!command.quiet) {
    text = "lengths in " + lengths_in(*made) + "\n\n" + steps_table(*made) + "\n" +
           cut_text(*made, *written);
  }
  if (auto done = put(text); !done) return report(done.error());
  auto missing = not_cut(*made);
  if (!missing) return 0;
  if (!written->empty()) missing->hint = "the files were written; " + missing->hint;
  return report(*missing);
}

}  // namespace obvid
