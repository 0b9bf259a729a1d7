// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <string>

#include "obvid/certify/certify.h"
#include "obvid/pipeline/fit.h"
#include "obvid/series/analysis.h"
#include "report.h"

namespace obvid {
namespace {

/// Figures of a report are computed again from the same numbers; they may differ in the last
/// digits when another library rounds sines differently. Not larger: beside a line the weights of
/// a piece may change without any other claim becoming false, and only these figures show it.
constexpr double kSameFigure = 1e-9;
/// Widths far below the contour's size are differences of its coordinates.
constexpr double kNegligible = 1e-13;

class ClaimCheck {
 public:
  explicit ClaimCheck(double size) : size_(size) {}

  void length(const std::string& name, double claimed, double found) {
    if (std::isnan(claimed) && std::isnan(found)) return;
    const double allowed = kSameFigure * std::abs(found) + kNegligible * size_;
    if (!(std::abs(claimed - found) <= allowed)) refuse(name, claimed, found);
  }
  void count(const std::string& name, double claimed, double found) {
    if (claimed != found) refuse(name, claimed, found);
  }
  [[nodiscard]] const std::optional<Error>& refused() const { return refused_; }
  void refuse(const std::string& name, double claimed, double found) {
    if (refused_) return;
    refused_ = Error{ErrorCode::kFalseClaim,
                     fmt::format("the file claims {} = {:.9g}, found {:.9g}", name, claimed, found),
                     "report",
                     "form the contour again",
                     -1,
                     found};
  }

 private:
  double size_;
  std::optional<Error> refused_;
};

/// What is missed is rounding, which another library rounds otherwise.
void compare_given(const GivenReport& claimed, const GivenReport& found, ClaimCheck& c) {
  c.count("given headings", static_cast<double>(claimed.headings),
          static_cast<double>(found.headings));
  c.count("given curvatures", static_cast<double>(claimed.curvatures),
          static_cast<double>(found.curvatures));
  c.count("given corners", static_cast<double>(claimed.corners),
          static_cast<double>(found.corners));
  constexpr double kRounding = 1e-13;
  const auto miss = [&](const char* name, double a, double b) {
    if (!(b <= 2.0 * a + kRounding && a <= 2.0 * b + kRounding)) c.refuse(name, a, b);
  };
  miss("largest miss of a given heading", claimed.heading_miss, found.heading_miss);
  miss("largest miss of a given curvature", claimed.curvature_miss, found.curvature_miss);
}

void compare_report(const FitReport& claimed, const FitReport& found, ClaimCheck& c) {
  c.count("the number of segments", static_cast<double>(claimed.segments.size()),
          static_cast<double>(found.segments.size()));
  if (claimed.segments.size() != found.segments.size()) return;
  for (std::size_t i = 0; i < found.segments.size(); ++i) {
    const std::string at = " of segment " + std::to_string(i);
    const SegmentReport &a = claimed.segments[i], &b = found.segments[i];
    // beyond the contract's fields: a file need not claim them
    if (a.from && a.to) {
      c.count("points[0]" + at, static_cast<double>(*a.from), static_cast<double>(*b.from));
      c.count("points[1]" + at, static_cast<double>(*a.to), static_cast<double>(*b.to));
    }
    c.length("chord" + at, a.chord, b.chord);
    c.length("points_only_error" + at, a.points_only_error, b.points_only_error);
    c.length("width" + at, a.width, b.width);
    // beyond the contract's fields: a file need not claim them
    if (!std::isnan(a.width_unrefined)) {
      c.length("width_unrefined" + at, a.width_unrefined, b.width_unrefined);
    }
    c.length("deviation" + at, a.deviation, b.deviation);
    if (!std::isnan(a.deviation_at.x) || !std::isnan(a.deviation_at.y)) {
      c.length("deviation_at[0]" + at, a.deviation_at.x, b.deviation_at.x);
      c.length("deviation_at[1]" + at, a.deviation_at.y, b.deviation_at.y);
    }
    c.count("inserted" + at, static_cast<double>(a.inserted), static_cast<double>(b.inserted));
  }
  c.length("largest_width", claimed.largest_width, found.largest_width);
  if (!std::isnan(claimed.largest_deviation)) {
    c.length("largest_deviation", claimed.largest_deviation, found.largest_deviation);
  }
  compare_given(claimed.given, found.given, c);
  c.length("largest_move", claimed.largest_move, found.largest_move);
  if (!claimed.moves.empty()) {
    c.count("the number of moves", static_cast<double>(claimed.moves.size()),
            static_cast<double>(found.moves.size()));
    for (std::size_t i = 0; i < std::min(claimed.moves.size(), found.moves.size()); ++i) {
      c.length("move of point " + std::to_string(i), claimed.moves[i], found.moves[i]);
    }
  }
  c.count("vertices", claimed.vertices, found.vertices);
  c.count("vertices_lower_bound", claimed.vertices_lower_bound, found.vertices_lower_bound);
  c.count("inflections", claimed.inflections, found.inflections);
  c.count("inserted_points", static_cast<double>(claimed.inserted_points),
          static_cast<double>(found.inserted_points));
}

/// Gaps are rounding noise near zero: only a claim that is off by more than that is false.
void compare_certificate(const Certificate& claimed, const Certificate& found, ClaimCheck& c) {
  constexpr double kGapNoise = 2.0;
  constexpr double kSmallestGap = 1e-15;
  const auto gap = [&](const char* name, double a, double b) {
    if (!(b <= kGapNoise * a + kSmallestGap && a <= kGapNoise * b + kSmallestGap)) {
      c.refuse(name, a, b);
    }
  };
  gap("joint gap position", claimed.gaps.position, found.gaps.position);
  gap("joint gap heading", claimed.gaps.heading, found.gaps.heading);
  gap("joint gap curvature", claimed.gaps.curvature, found.gaps.curvature);
  c.count("the number of verdicts", static_cast<double>(claimed.pieces.size()),
          static_cast<double>(found.pieces.size()));
  for (std::size_t i = 0; i < std::min(claimed.pieces.size(), found.pieces.size()); ++i) {
    c.count("verdict of piece " + std::to_string(i), static_cast<double>(claimed.pieces[i].verdict),
            static_cast<double>(found.pieces[i].verdict));
  }
  c.count("gaps_within_bounds", claimed.gaps_within_bounds, found.gaps_within_bounds);
  c.count("through_points", claimed.through_points, found.through_points);
  c.count("inside_region", claimed.inside_region, found.inside_region);
  c.length("largest_move in the certificate", claimed.largest_move, found.largest_move);
  c.count("corners", claimed.corners, found.corners);
  c.count("curvature_steps", claimed.curvature_steps, found.curvature_steps);
  c.count("vertices in the certificate", claimed.vertices, found.vertices);
  c.count("inflections in the certificate", claimed.inflections, found.inflections);
  c.count("self_intersections", claimed.self_intersections, found.self_intersections);
  c.count("proved", claimed.proved, found.proved);
}

/// A run that claims a direction has a piece whose curvature changes. (The certificate allows
/// lines and circles inside a run; arcs change at their joints only, by any amount.)
void compare_runs(const Contour& contour, const Certificate& found, ClaimCheck& c) {
  if (contour.carrier == Carrier::kArcs) return;
  for (std::size_t r = 0; r < contour.runs.size(); ++r) {
    const Run& run = contour.runs[r];
    bool changes = run.direction == 0;
    for (std::size_t i = run.first_piece; i <= run.last_piece && i < found.pieces.size(); ++i) {
      changes = changes || found.pieces[i].verdict != Verdict::kConstant;
    }
    if (!changes) c.refuse("direction of run " + std::to_string(r), run.direction, 0.0);
  }
}

}  // namespace

Verification verify(const StoredContour& stored) {
  Verification out;
  out.certificate = certify(stored.contour);
  ClaimCheck comparison(pipeline_detail::size_of(stored.contour.points));
  if (stored.report) {
    auto measured = pipeline_detail::measure(stored.contour, stored.report->tolerance);
    if (!measured) {
      out.false_claim = measured.error();
      return out;
    }
    FitReport found = std::move(*measured);
    pipeline_detail::settle_with(out.certificate, stored.contour, found);
    compare_report(*stored.report, found, comparison);
    const bool bounded = promises_monotone(stored.contour.carrier);
    if (bounded && !(found.largest_width <= stored.report->tolerance)) {
      comparison.refuse("a tolerance above the largest width", stored.report->tolerance,
                        found.largest_width);
    }
  }
  compare_runs(stored.contour, out.certificate, comparison);
  if (stored.certificate) compare_certificate(*stored.certificate, out.certificate, comparison);
  out.false_claim = comparison.refused();
  return out;
}

}  // namespace obvid
