// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <string>
#include <utility>
#include <variant>

#include "obvid/core/internal/figures.h"
#include "obvid/pipeline/internal/job_files.h"
#include "obvid/pipeline/internal/page_text.h"
#include "obvid/pipeline/internal/promise.h"
#include "obvid/pipeline/internal/report_json.h"

namespace obvid {
namespace {

constexpr double kWorthTelling = 2.0;  // trouble of a proof from which its parameters are told

std::string verdict_counts(const Certificate& certificate) {
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

const char* yes_or_no(bool flag) { return flag ? "yes" : "no"; }

/// The claims of the file beside what was found now.
void add_claims(FigureRows& facts, const StoredContour& stored, const Certificate& found) {
  if (stored.report) {
    facts.emplace_back(
        "report claims",
        fmt::format(
            "{}, {}, largest width {}",
            counted(static_cast<std::size_t>(stored.report->vertices), "vertex", "vertices"),
            counted(static_cast<std::size_t>(stored.report->inflections), "inflection",
                    "inflections"),
            known_length(stored.report->largest_width, stored.contour.units.text())));
  } else {
    facts.emplace_back("report claims", "the file holds no report");
  }
  if (stored.certificate) {
    facts.emplace_back("file claims", verdict_line(stored.contour.carrier, *stored.certificate));
  } else {
    facts.emplace_back("file claims", "the file holds no certificate");
  }
  facts.emplace_back("curvature", verdict_counts(found));
  facts.emplace_back("joint gaps", gaps_text(stored.contour.carrier, found));
  facts.emplace_back("gaps within bounds", yes_or_no(found.gaps_within_bounds));
  facts.emplace_back("through all points", yes_or_no(found.through_points));
  facts.emplace_back("inside the region", yes_or_no(found.inside_region));
  if (found.corners > 0) facts.emplace_back("corners", std::to_string(found.corners));
  facts.emplace_back("vertices", std::to_string(found.vertices));
  facts.emplace_back("inflections", std::to_string(found.inflections));
  facts.emplace_back("self-intersections", std::to_string(found.self_intersections));
}

Result<std::string> verification_page(const StoredContour& stored, const Verification& found,
                                      const ReportTitles& titles, const RunContext& run) {
  ReportPage page;
  page.title = titles.title;
  page.verdict = verification_verdict(stored, found);
  page.kind =
      broken_promise(stored, found) ? ReportPage::Verdict::kBroken : ReportPage::Verdict::kKept;
  ExportOptions titled;
  titled.picture.name = titles.title;
  const auto drawn = export_contour(stored, FileFormat::kPicture, titled, run);
  OBVID_TRY(drawn);
  page.pictures.push_back(drawn->files.front().text);
  if (!titles.asked.empty()) page.figures.emplace_back("asked for", titles.asked);
  page.figures.emplace_back("lengths in", stored.contour.units.text());
  const FigureRows facts = verification_figures(stored, found);
  page.figures.insert(page.figures.end(), facts.begin(), facts.end());
  page.tables.push_back(
      table_of_page("pieces", "Pieces", proof_rows(stored.contour, found.certificate)));
  return page_text(page);
}

}  // namespace

const char* piece_type(const Piece& piece) {
  struct Names {
    const char* operator()(const LinePiece&) const { return "line"; }
    const char* operator()(const ArcPiece&) const { return "arc"; }
    const char* operator()(const RationalBezier&) const { return "bezier"; }
    const char* operator()(const ClothoidPiece&) const { return "clothoid"; }
  };
  return std::visit(Names{}, piece);
}

double proof_trouble(const PieceProof& proof) {
  if (proof.verdict == Verdict::kUndecided) return 3.0;
  if (proof.verdict == Verdict::kHasVertex) return 2.0;
  return proof.exact_arithmetic ? 1.0 : 0.0;
}

DataTable proof_rows(const Contour& contour, const Certificate& certificate) {
  DataTable out{heads_of("piece,type,curvature,arithmetic,from,to")};
  for (std::size_t i = 0; i < certificate.pieces.size(); ++i) {
    const PieceProof& proof = certificate.pieces[i];
    out.rows.push_back({i + 1, i < contour.pieces.size() ? piece_type(contour.pieces[i]) : "",
                        to_string(proof.verdict), proof.exact_arithmetic ? "exact" : "fast"});
    if (proof_trouble(proof) < kWorthTelling) continue;
    out.rows.back().emplace_back(proof.t0);
    out.rows.back().emplace_back(proof.t1);
  }
  return out;
}

FigureRows verification_figures(const StoredContour& stored, const Verification& found) {
  FigureRows facts;
  add_claims(facts, stored, found.certificate);
  facts.emplace_back("not checked", listed(found.not_checked));
  return facts;
}

std::string verification_verdict(const StoredContour& stored, const Verification& found) {
  return found.false_claim ? "NOT as claimed: " + found.false_claim->what
                           : verdict_line(stored.contour.carrier, found.certificate);
}

Result<std::string> verification_file(FileFormat format, const StoredContour& stored,
                                      const Verification& found, const ReportTitles& titles,
                                      const RunContext& run) {
  OBVID_TRY(may_go_on(run));
  switch (format) {
    case FileFormat::kContour:
      return verification_json(stored, found);
    case FileFormat::kSamples:
      return csv_text(proof_rows(stored.contour, found.certificate));
    case FileFormat::kPage:
      return verification_page(stored, found, titles, run);
    default:
      return fail(no_such_answer());
  }
}

Error no_such_answer() {
  return {ErrorCode::kUnknownFormat, "answers are JSON, a page or a table of pieces", "",
          "name a .json, .html or .csv"};
}

}  // namespace obvid
