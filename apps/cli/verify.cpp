// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>

#include "commands.h"
#include "fit_report.h"
#include "obvid/core/files.h"
#include "obvid/core/internal/data_table.h"
#include "obvid/core/internal/file_ending.h"
#include "obvid/pipeline/export.h"
#include "obvid/pipeline/internal/fit_figures.h"
#include "obvid/pipeline/internal/page_text.h"
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

const char* type_of(const Piece& piece) {
  struct Names {
    const char* operator()(const LinePiece&) const { return "line"; }
    const char* operator()(const ArcPiece&) const { return "arc"; }
    const char* operator()(const RationalBezier&) const { return "bezier"; }
    const char* operator()(const ClothoidPiece&) const { return "clothoid"; }
  };
  return std::visit(Names{}, piece);
}

/// What is wrong with a piece, as a figure for choosing rows: the undecided come first.
double trouble(const PieceProof& proof) {
  if (proof.verdict == Verdict::kUndecided) return 3.0;
  if (proof.verdict == Verdict::kHasVertex) return 2.0;
  return proof.exact_arithmetic ? 1.0 : 0.0;
}

std::string piece_table(const Contour& contour, const Certificate& certificate) {
  Table table;
  table.column("piece");
  table.column("type", Table::Align::kLeft);
  table.column("curvature", Table::Align::kLeft);
  table.column("arithmetic", Table::Align::kLeft);
  table.column("parameters in question", Table::Align::kLeft);
  std::vector<double> troubles;
  for (const PieceProof& proof : certificate.pieces) troubles.push_back(trouble(proof));
  const std::vector<std::size_t> shown = rows_worth_showing(troubles);
  std::size_t before = 0;
  for (const std::size_t i : shown) {
    if (i > before) table.gap();
    before = i + 1;
    const PieceProof& proof = certificate.pieces[i];
    const bool open = trouble(proof) >= 2.0;
    table.row({std::to_string(i + 1), i < contour.pieces.size() ? type_of(contour.pieces[i]) : "-",
               to_string(proof.verdict), proof.exact_arithmetic ? "exact" : "fast",
               open ? fmt::format("{}..{}", significant(proof.t0), significant(proof.t1)) : ""});
  }
  return table.text() +
         shown_note(shown.size(), certificate.pieces.size(), "most difficult", "pieces");
}

std::string counts_text(const Certificate& certificate) {
  std::array<std::size_t, 5> counts{};
  for (const PieceProof& proof : certificate.pieces)
    ++counts[static_cast<std::size_t>(proof.verdict)];
  std::string text;
  for (std::size_t v = 0; v < counts.size(); ++v) {
    if (counts[v] == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counts[v],
                        to_string(static_cast<Verdict>(v)));
  }
  return text;
}

DataTable proof_rows(const Contour& contour, const Certificate& certificate) {
  DataTable out{heads_of("piece,type,curvature,arithmetic,from,to")};
  for (std::size_t i = 0; i < certificate.pieces.size(); ++i) {
    const PieceProof& proof = certificate.pieces[i];
    out.rows.push_back({i + 1, i < contour.pieces.size() ? type_of(contour.pieces[i]) : "",
                        to_string(proof.verdict), proof.exact_arithmetic ? "exact" : "fast"});
    if (trouble(proof) < 2.0) continue;
    out.rows.back().emplace_back(proof.t0);
    out.rows.back().emplace_back(proof.t1);
  }
  return out;
}

const char* yes_no(bool flag) { return flag ? "yes" : "no"; }

/// The claims of the file beside what was found now.
void add_claims(Facts& facts, const StoredContour& stored, const Certificate& found) {
  if (stored.report) {
    facts.add("report claims",
              fmt::format(
                  "{}, {}, largest width {}",
                  counted(static_cast<std::size_t>(stored.report->vertices), "vertex", "vertices"),
                  counted(static_cast<std::size_t>(stored.report->inflections), "inflection",
                          "inflections"),
                  known_length(stored.report->largest_width, stored.contour.units.text())));
  } else {
    facts.add("report claims", "the file holds no report");
  }
  if (stored.certificate) {
    facts.add("file claims", verdict_line(stored.contour.carrier, *stored.certificate));
  } else {
    facts.add("file claims", "the file holds no certificate");
  }
  facts.add("curvature", counts_text(found));
  add_gaps(facts, found, stored.contour.carrier);
  facts.add("gaps within bounds", yes_no(found.gaps_within_bounds));
  facts.add("through all points", yes_no(found.through_points));
  facts.add("inside the region", yes_no(found.inside_region));
  if (found.corners > 0) facts.add("corners", std::to_string(found.corners));
  facts.add("vertices", std::to_string(found.vertices));
  facts.add("inflections", std::to_string(found.inflections));
  facts.add("self-intersections", std::to_string(found.self_intersections));
}

Facts verification_facts(const StoredContour& stored, const Verification& found) {
  Facts facts;
  add_claims(facts, stored, found.certificate);
  facts.add("not checked", listed(found.not_checked));
  return facts;
}

std::string verification_verdict(const StoredContour& stored, const Verification& found) {
  return found.false_claim ? "NOT as claimed: " + found.false_claim->what
                           : verdict_line(stored.contour.carrier, found.certificate);
}

std::string verification_text(const StoredContour& stored, const Verification& found) {
  const bool holds = !broken_promise(stored, found);
  const std::string verdict = verification_verdict(stored, found);
  return piece_table(stored.contour, found.certificate) + "\n" +
         verification_facts(stored, found).text() + (holds ? good(verdict) : bad(verdict)) + "\n";
}

Result<std::string> verification_page(const StoredContour& stored, const Verification& found,
                                      const std::string& name, const std::string& asked) {
  ReportPage page;
  page.title = name;
  page.verdict = verification_verdict(stored, found);
  page.kind =
      broken_promise(stored, found) ? ReportPage::Verdict::kBroken : ReportPage::Verdict::kKept;
  ExportOptions titled;
  titled.picture.name = name;
  const auto drawn = export_contour(stored, FileFormat::kPicture, titled);
  OBVID_TRY(drawn);
  page.pictures.push_back(drawn->files.front().text);
  page.figures = {{"asked for", asked}, {"lengths in", stored.contour.units.text()}};
  const Facts facts = verification_facts(stored, found);
  page.figures.insert(page.figures.end(), facts.lines().begin(), facts.lines().end());
  page.tables.push_back(
      table_of_page("pieces", "Pieces", proof_rows(stored.contour, found.certificate)));
  return page_text(page);
}

/// The text of an answer by the ending of its file.
Result<std::string> answer_for(const std::string& path, const StoredContour& stored,
                               const Verification& found, const std::string& name,
                               const std::string& asked) {
  if (has_ending(path, ".json")) return verification_json(stored, found);
  if (has_ending(path, ".csv")) return csv_text(proof_rows(stored.contour, found.certificate));
  return verification_page(stored, found, name, asked);
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
  const auto all = all_of_them(options.inputs, options.input, {}, false);
  if (!all) return report(all.error());
  Several several(*all, summary_form(options.csv, options.json, options.quiet));
  return several.run(
      {}, [](const OneOf& one, const std::vector<std::string>&) { return summary_of_stored(one); });
}

}  // namespace

int run(const VerifyOptions& options) {
  if (!options.inputs.empty()) return verify_several(options);
  for (const std::string& path : options.outputs) {
    if (has_ending(path, ".json .html .csv")) continue;
    return report({ErrorCode::kUnknownFormat, "answers are JSON, a page or a table of pieces", path,
                   "name a .json, .html or .csv"});
  }
  if (auto free = check_outputs(options.outputs, {&options.input, 1}); !free) {
    return report(free.error());
  }
  const Result<std::string> text = read_file(options.input);
  if (!text) return report(text.error());
  const std::string name = options.input == "-" ? "standard input" : options.input;
  const Result<Stored> read = parse_stored(*text, name);
  if (!read) return report(read.error());
  if (const auto* chain = std::get_if<StoredSpaceChain>(&*read)) {
    return verify_in_space(*chain, name, options);
  }
  const auto* stored = &std::get<StoredContour>(*read);
  const Verification found = verify(*stored);
  std::string shown;
  std::vector<Output> files;
  for (const std::string& path : options.outputs) {
    auto answer = answer_for(path, *stored, found, name, options.asked);
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
