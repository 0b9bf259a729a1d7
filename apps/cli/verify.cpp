// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "commands.h"
#include "interrupt.h"
#include "obvid/core/files.h"
#include "obvid/core/internal/data_table.h"
#include "obvid/pipeline/file_formats.h"
#include "obvid/pipeline/internal/job_files.h"
#include "obvid/pipeline/internal/promise.h"
#include "obvid/pipeline/internal/report_json.h"
#include "obvid/pipeline/space_fit.h"
#include "obvid/pipeline/stored.h"
#include "outputs.h"
#include "several.h"
#include "space_fit.h"
#include "table.h"
#include "terminal.h"
#include "text.h"

namespace obvid {
namespace {

std::string piece_table(const Contour& contour, const Certificate& certificate) {
  Table table;
  table.column("piece");
  table.column("type", Table::Align::kLeft);
  table.column("curvature", Table::Align::kLeft);
  table.column("arithmetic", Table::Align::kLeft);
  table.column("parameters in question", Table::Align::kLeft);
  std::vector<double> troubles;
  for (const PieceProof& proof : certificate.pieces) troubles.push_back(proof_trouble(proof));
  const std::size_t shown = add_rows_worth_showing(troubles, table, [&](std::size_t i) {
    const PieceProof& proof = certificate.pieces[i];
    const bool open = proof_trouble(proof) >= 2.0;
    table.row({std::to_string(i + 1),
               i < contour.pieces.size() ? piece_type(contour.pieces[i]) : "-",
               to_string(proof.verdict), proof.exact_arithmetic ? "exact" : "fast",
               open ? fmt::format("{}..{}", significant(proof.t0), significant(proof.t1)) : ""});
  });
  return table.text() + shown_note(shown, certificate.pieces.size(), "most difficult", "pieces");
}

std::string verification_text(const StoredContour& stored, const Verification& found) {
  const bool holds = !broken_promise(stored, found);
  Facts facts;
  for (auto& [label, value] : verification_figures(stored, found)) {
    facts.add(std::move(label), std::move(value));
  }
  const std::string verdict = verification_verdict(stored, found);
  return piece_table(stored.contour, found.certificate) + "\n" + facts.text() +
         (holds ? good(verdict) : bad(verdict)) + "\n";
}

/// What the file says wrongly comes before what could not be proved.
int judge_contour_file(const StoredContour& stored, const Verification& found,
                       const std::string& input) {
  if (auto error = broken_promise(stored, found)) {
    if (error->where.empty()) error->where = input;
    return report(*error);
  }
  return 0;
}

Summary summary_of_stored(const OneOf& one) {
  Summary out;
  const Result<std::string> text = read_file(one.input);
  const Result<Stored> read =
      text.and_then([&](const std::string& content) { return parse_stored(content, one.input); });
  if (!read) {
    out.error = read.error();
    return out;
  }
  if (const auto* chain = std::get_if<StoredSpaceChain>(&*read)) {
    out.error = broken_promise(*chain, verify(*chain));
  } else {
    const auto& stored = std::get<StoredContour>(*read);
    const Verification found = verify(stored);
    out.cells = summary_cells(stored.contour, found.certificate);
    out.error = broken_promise(stored, found);
  }
  out.verdict = "as claimed";
  return out;
}

int verify_several(const VerifyOptions& options) {
  if (!options.outputs.empty()) {
    return report({ErrorCode::kBadOption, "an answer is of one file", options.outputs.front(),
                   "verify one file, or leave -o out: --json has a line for each"});
  }
  return run_each(options, {}, false, {}, [](const OneOf& one, const std::vector<std::string>&) {
    return summary_of_stored(one);
  });
}

}  // namespace

int run(const VerifyOptions& options) {
  if (!options.inputs.empty()) return verify_several(options);
  for (const std::string& path : options.outputs) {
    if (!proof_format_of(path)) return report(of_file(no_such_answer(), path));
  }
  if (auto free = check_outputs(options.outputs, {&options.input, 1}); !free) {
    return report(free.error());
  }
  const Result<std::string> text = read_file(options.input);
  if (!text) return report(text.error());
  const std::string name = options.input == "-" ? "standard input" : options.input;
  const Interrupt interrupt;
  const RunContext context({}, [&interrupt] { return interrupt.asked(); });
  const Result<Stored> read = parse_stored(*text, name, context);
  if (!read) return report(read.error());
  if (const auto* chain = std::get_if<StoredSpaceChain>(&*read)) {
    return verify_in_space(*chain, name, options);
  }
  const auto* stored = &std::get<StoredContour>(*read);
  const Result<Verification> made = verify(*stored, context);
  if (!made) return report(made.error());
  const Verification& found = *made;
  std::string shown;
  std::vector<Output> files;
  for (const std::string& path : options.outputs) {
    auto answer =
        verification_file(*proof_format_of(path), *stored, found, {name, options.asked}, context);
    if (!answer) return report(answer.error());
    files.push_back({path, {}, std::move(*answer)});
  }
  if (auto done = write_files(files); !done) return report(done.error());
  if (options.json) {
    shown = verification_json(*stored, found);
  } else if (options.csv) {
    shown = csv_text(proof_rows(stored->contour, found.certificate));
  } else if (!options.quiet) {
    shown = verification_text(*stored, found);
  }
  if (auto done = put(shown); !done) return report(done.error());
  return judge_contour_file(*stored, found, name);
}

}  // namespace obvid
