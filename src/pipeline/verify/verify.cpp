// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "fit/parts.h"
#include "fit/waviness.h"
#include "obvid/alignment/internal/profile_figures.h"
#include "obvid/certify/certify.h"
#include "obvid/certify/internal/carrier_pieces.h"
#include "obvid/certify/internal/limits.h"
#include "obvid/curve/internal/nearest.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/pipeline/fit.h"
#include "obvid/series/analysis.h"
#include "verify/report.h"

namespace obvid {
namespace {

/// Figures of a report are computed again from the same numbers; they may differ in the last
/// digits when another library rounds sines differently. Not larger: beside a line the weights of
/// a piece may change without any other claim becoming false, and only these figures show it.
constexpr double kSameFigure = 1e-9;
/// Widths far below the contour's size are differences of its coordinates.
constexpr double kNegligible = 1e-13;

/// Where the profile of an alignment stands in a contour file.
constexpr const char* kProfilePath = "/alignment/profile";

std::string shown_figure(double value) {
  return std::isnan(value) ? "null" : fmt::format("{:.9g}", value);
}

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
  /// Beyond the contract's fields: a file need not claim it. NaN: said not to be known.
  void waviness(const std::optional<double>& claimed, const std::optional<double>& found) {
    constexpr double kSameWaviness = 1e-4;  // a tenth of what it is told to
    const double now = found.value_or(std::numeric_limits<double>::quiet_NaN());
    if (!claimed || (std::isnan(*claimed) && std::isnan(now))) return;
    if (!(std::abs(*claimed - now) <= kSameWaviness * now)) refuse("waviness", *claimed, now);
  }
  [[nodiscard]] const std::optional<Error>& refused() const { return refused_; }
  void refuse(const std::string& name, double claimed, double found) {
    if (refused_) return;
    refused_ =
        error(ErrorCode::kFalseClaim, fmt::format("the file claims {} = {}, found {}", name,
                                                  shown_figure(claimed), shown_figure(found)))
            .where("report")
            .hint("form the contour again")
            .value(found);
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
  c.count("given ranges of headings", static_cast<double>(claimed.heading_ranges),
          static_cast<double>(found.heading_ranges));
  c.count("given ranges of curvatures", static_cast<double>(claimed.curvature_ranges),
          static_cast<double>(found.curvature_ranges));
  c.count("ranges at an end of which the contour lies", static_cast<double>(claimed.active.size()),
          static_cast<double>(found.active.size()));
  for (std::size_t k = 0; k < std::min(claimed.active.size(), found.active.size()); ++k) {
    const ActiveRange &a = claimed.active[k], &b = found.active[k];
    if (a == b) continue;
    c.refuse("active range " + std::to_string(k), static_cast<double>(a.point),
             static_cast<double>(b.point));
  }
  constexpr double kRounding = 1e-13;  // rad, or of the curvature: a gap of nothing
  const auto miss = [&](const char* name, double a, double b) {
    if (!(b <= 2.0 * a + kRounding && a <= 2.0 * b + kRounding)) c.refuse(name, a, b);
  };
  miss("largest miss of a given heading", claimed.heading_miss, found.heading_miss);
  miss("largest miss of a given curvature", claimed.curvature_miss, found.curvature_miss);
}

/// Where a distance is largest it is flat: another search ends at another place of the contour
/// beside this one, where the distance is the same but for a millionth.
bool is_same_place(const Contour& contour, const pipeline_detail::Part& part, Vec2 claimed,
                   Vec2 found, double chord) {
  constexpr double kBeside = 1e-3;  // of the chord
  const double apart = norm(claimed - found);
  if (!(apart <= kBeside * chord)) return false;
  const double rounding = kSameFigure * chord + kNegligible * norm(found);
  if (apart <= rounding) return true;
  for (std::size_t k = part.first_piece; k <= part.last_piece; ++k) {
    const Piece& piece = contour.pieces[k];
    const Vec2 nearest = evaluate(piece, nearest_parameter(piece, claimed)).point;
    if (norm(nearest - claimed) <= rounding) return true;
  }
  return false;
}

void compare_report(const Contour& contour, const FitReport& claimed, const FitReport& found,
                    ClaimCheck& c) {
  c.count("the number of segments", static_cast<double>(claimed.segments.size()),
          static_cast<double>(found.segments.size()));
  if (claimed.segments.size() != found.segments.size()) return;
  const std::vector<pipeline_detail::Part> parts = pipeline_detail::parts_of(contour);
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
      if (!is_same_place(contour, parts[i], a.deviation_at, b.deviation_at, b.chord)) {
        c.length("deviation_at[0]" + at, a.deviation_at.x, b.deviation_at.x);
        c.length("deviation_at[1]" + at, a.deviation_at.y, b.deviation_at.y);
      }
    }
    c.count("inserted" + at, static_cast<double>(a.inserted), static_cast<double>(b.inserted));
  }
  c.length("largest_width", claimed.largest_width, found.largest_width);
  c.length("largest_deviation", claimed.largest_deviation, found.largest_deviation);
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
  c.waviness(claimed.waviness, found.waviness);
}

/// Gaps are upper bounds: a claim below what is found is false, but for sines that another library
/// rounds differently. Their roundings are part of the bound, so it is at least half as large there
/// (docs/methods/certify.md, section 5). One far above is not what this contour was given.
void compare_certificate(const Certificate& claimed, const Certificate& found, ClaimCheck& c) {
  constexpr double kLooseBound = 2.0;
  constexpr double kOtherSines = 1e-14;  // rad, or relative: some twenty ulps
  constexpr double kOfOtherSines = 0.5;  // of the bound
  const auto gap = [&](const char* name, double a, double b) {
    const bool low = a < b * (1.0 - kSameFigure) - std::min(kOtherSines, kOfOtherSines * b);
    const bool high = a > kLooseBound * b + kOtherSines;
    if (low || high || std::isnan(a)) c.refuse(name, a, b);
  };
  gap("joint gap position", claimed.gaps.position, found.gaps.position);
  gap("joint gap heading", claimed.gaps.heading, found.gaps.heading);
  gap("joint gap curvature", claimed.gaps.curvature, found.gaps.curvature);
  if (claimed.gaps.slope && found.gaps.slope) {
    gap("joint gap slope", *claimed.gaps.slope, *found.gaps.slope);
  }
  c.count("a gap of slopes", claimed.gaps.slope.has_value(), found.gaps.slope.has_value());
  c.count("the number of verdicts", static_cast<double>(claimed.pieces.size()),
          static_cast<double>(found.pieces.size()));
  for (std::size_t i = 0; i < std::min(claimed.pieces.size(), found.pieces.size()); ++i) {
    const PieceProof &a = claimed.pieces[i], &b = found.pieces[i];
    const std::string of = " of piece " + std::to_string(i);
    c.count("verdict" + of, static_cast<double>(a.verdict), static_cast<double>(b.verdict));
    c.count("t0" + of, a.t0, b.t0);
    c.count("t1" + of, a.t1, b.t1);
  }
  c.count("gaps_within_bounds", claimed.gaps_within_bounds, found.gaps_within_bounds);
  c.count("through_points", claimed.through_points, found.through_points);
  c.count("inside_region", claimed.inside_region, found.inside_region);
  c.length("largest_move in the certificate", claimed.largest_move, found.largest_move);
  c.count("corners", claimed.corners, found.corners);
  c.count("curvature_steps", claimed.curvature_steps, found.curvature_steps);
  c.count("slope_steps", claimed.slope_steps, found.slope_steps);
  c.count("vertices in the certificate", claimed.vertices, found.vertices);
  c.count("inflections in the certificate", claimed.inflections, found.inflections);
  c.count("self_intersections", claimed.self_intersections, found.self_intersections);
  c.count("proved", claimed.proved, found.proved);
  if (claimed.proved && !claimed.reason.empty()) c.refuse("a reason beside proved", 1.0, 0.0);
}

/// No report may claim that all curves have more vertices than the proved one beside it has.
void compare_bound(const FitReport& claimed, const Certificate& found, ClaimCheck& c) {
  if (!found.proved || claimed.vertices_lower_bound <= found.vertices) return;
  c.refuse("vertices_lower_bound beyond the vertices of a proved contour",
           claimed.vertices_lower_bound, found.vertices);
}

/// Spirals follow nothing: no figure says how far from their spirals they are.
void compare_with_spirals(const Contour& contour, const FitReport& claimed, ClaimCheck& c) {
  if (follows_spirals(contour.carrier)) return;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (claimed.carrier_deviation) c.refuse("carrier_deviation", *claimed.carrier_deviation, kNone);
  if (claimed.outside_spirals_region) {
    c.refuse("outside_spirals_region", *claimed.outside_spirals_region, kNone);
  }
}

/// An open contour leads from the first point to the last one.
void compare_ends(const Contour& contour, ClaimCheck& c) {
  if (contour.closed || contour.joints.empty() || contour.points.empty()) return;
  const auto end = [&](const char* name, const Joint& joint, std::size_t point) {
    const double claimed = joint.source ? static_cast<double>(*joint.source)
                                        : std::numeric_limits<double>::quiet_NaN();
    c.count(name, claimed, static_cast<double>(point));
  };
  end("source of the first element", contour.joints.front(), 0);
  end("source of the last element", contour.joints.back(), contour.points.size() - 1);
}

/// The proof looks at runs of carriers that promise monotone curvature; of all others the pieces
/// are to lie in runs too, each in one.
void compare_cover(const Contour& contour, ClaimCheck& c) {
  std::size_t next = 0;
  for (std::size_t r = 0; r < contour.runs.size(); ++r) {
    c.count("first piece of run " + std::to_string(r),
            static_cast<double>(contour.runs[r].first_piece), static_cast<double>(next));
    next = contour.runs[r].last_piece + 1;
  }
  c.count("pieces in runs", static_cast<double>(next), static_cast<double>(contour.pieces.size()));
}

/// A run that claims a direction has a piece whose curvature changes. (The certificate allows
/// lines and circles inside a run; arcs change at their joints only, by any amount.) Carriers that
/// promise no monotone curvature have runs of pieces that are proved, all others in runs of 0.
void compare_runs(const Contour& contour, const Certificate& found, ClaimCheck& c) {
  if (steps_at_joints(contour.carrier)) return;
  if (!promises_monotone(contour.carrier)) compare_cover(contour, c);
  for (std::size_t r = 0; r < contour.runs.size(); ++r) {
    const Run& run = contour.runs[r];
    if (!promises_monotone(contour.carrier)) {
      for (std::size_t i = run.first_piece; i <= run.last_piece && i < found.pieces.size(); ++i) {
        c.count("direction of run " + std::to_string(r), run.direction,
                pipeline_detail::direction_of(found.pieces[i].verdict));
      }
      continue;
    }
    bool changes = run.direction == 0;
    for (std::size_t i = run.first_piece; i <= run.last_piece && i < found.pieces.size(); ++i) {
      changes = changes || found.pieces[i].verdict != Verdict::kConstant;
    }
    if (!changes) c.refuse("direction of run " + std::to_string(r), run.direction, 0.0);
  }
}

/// A transition that clothoids stand for leads from the start of the first one to the end of the
/// last one.
void compare_transitions(const StoredContour& stored, ClaimCheck& c) {
  constexpr double kSameEnd = 1e-6;  // of the length, and rad
  if (!stored.alignment) return;
  std::size_t number = 0;
  for (const PlacedTransition& one : stored.alignment->transitions) {
    const auto& first = std::get<ClothoidPiece>(stored.contour.pieces[one.first_piece]);
    const auto& last =
        std::get<ClothoidPiece>(stored.contour.pieces[one.first_piece + one.pieces - 1]);
    const Element end = transition_at(one.kind, {first.start, first.theta0, one.kappa0}, one.kappa1,
                                      one.length, one.length);
    const double turned = last.theta0 + 0.5 * (last.kappa0 + last.kappa1) * last.length;
    const double off = std::max(norm(end.point - last.end) / one.length,
                                std::abs(turn_between(turned, end.theta)));
    if (!(off <= kSameEnd)) {
      c.refuse("distance of the end of transition " + std::to_string(number) +
                   " from its clothoids, of its length or rad",
               0.0, off);
    }
    ++number;
  }
}

/// What stands in the file and is taken as it stands.
std::vector<std::string> not_checked(const StoredContour& stored) {
  std::vector<std::string> out = {"/units", "/units_source"};
  if (!stored.contour.point_tolerance.empty()) out.emplace_back("/point_tolerance");
  if (!stored.contour.kept.empty()) {
    if (keeps_foreign_pieces(stored.contour)) {
      out.emplace_back("/carrier (only the pieces that are not kept)");
    }
    out.emplace_back("/kept (only that such pieces are lines, arcs, ellipse arcs or clothoids)");
  }
  if (steps_at_joints(stored.contour.carrier)) {
    out.emplace_back("/elements/*/kappa (only that it lies between both arcs)");
  }
  if (!stored.name.empty()) out.emplace_back("/name");
  if (stored.alignment) {
    out.emplace_back("/alignment/first_station");
    if (const auto& profile = stored.alignment->profile) {
      for (const std::string& one : loose_figures(*profile))
        out.push_back(fmt::format("{}/{}", kProfilePath, one));
      out.push_back(fmt::format("{} (only that its elements agree with each other)", kProfilePath));
    }
    if (!stored.alignment->transitions.empty()) {
      out.emplace_back("/alignment/transitions (only that each ends where its clothoids do)");
    }
  }
  if (stored.report) {
    if (follows_spirals(stored.contour.carrier)) {  // the spirals are not in the file
      out.emplace_back("/report/carrier_deviation");
      out.emplace_back("/report/outside_spirals_region");
    }
    out.emplace_back("/report/tolerance (only that the widths keep it)");
    out.emplace_back("/report/seconds");
    out.emplace_back("/report/chain");
  }
  if (stored.certificate) {
    const std::vector<PieceProof>& pieces = stored.certificate->pieces;
    if (std::any_of(pieces.begin(), pieces.end(),
                    [](const PieceProof& proof) { return proof.exact_arithmetic; })) {
      out.emplace_back("/certificate/monotone/*/exact_arithmetic");
    }
    if (!stored.certificate->reason.empty()) out.emplace_back("/certificate/reason");
  }
  out.insert(out.end(), stored.unread.begin(), stored.unread.end());
  return out;
}

/// The curve that the file calls by its carrier's name.
std::optional<Error> wrong_carrier(const Contour& contour) {
  const auto foreign = foreign_piece(contour);
  if (!foreign) return std::nullopt;
  return error(ErrorCode::kFalseClaim, foreign->what)
      .where("/pieces/" + std::to_string(foreign->index))
      .hint("form the contour again");
}

/// Before any figure, since all of them are about other points then.
std::optional<Error> other_points(const StoredContour& stored, const Certificate& found) {
  if (!stored.certificate || !stored.certificate->through_points || found.through_points) {
    return std::nullopt;
  }
  return error(ErrorCode::kFalseClaim, "the file claims through_points, but " + found.reason)
      .where("/points")
      .hint("form the contour again");
}

Verification verified(const StoredContour& stored, Watch& watch) {
  Verification out;
  out.not_checked = not_checked(stored);
  out.false_claim = wrong_carrier(stored.contour);
  out.certificate = certify(stored.contour, watch);
  // the figures of a report are not looked for on a contour whose numbers make no sense
  if (out.false_claim || out_of_range(stored.contour) || joint_without_curvature(stored.contour)) {
    return out;
  }
  out.false_claim = other_points(stored, out.certificate);
  if (out.false_claim) return out;
  if (stored.alignment && stored.alignment->profile) {
    out.false_claim = contradiction_in(*stored.alignment->profile);
    if (out.false_claim) {
      out.false_claim->where = fmt::format("{}/{}", kProfilePath, out.false_claim->where);
      return out;
    }
  }
  ClaimCheck comparison(bounding_diagonal(stored.contour.points));
  if (stored.report) {
    auto measured = pipeline_detail::measure(stored.contour, stored.report->tolerance, watch);
    if (!measured) {
      out.false_claim = measured.error();
      return out;
    }
    FitReport found = std::move(*measured);
    found.waviness = pipeline_detail::waviness(stored.contour, watch);
    pipeline_detail::settle_with(out.certificate, stored.contour, found, watch);
    compare_bound(*stored.report, out.certificate, comparison);
    compare_report(stored.contour, *stored.report, found, comparison);
    compare_with_spirals(stored.contour, *stored.report, comparison);
    const bool bounded = promises_monotone(stored.contour.carrier);
    const bool said = stored.report->largest_width > stored.report->tolerance;
    if (bounded && !said && found.largest_width > stored.report->tolerance) {
      comparison.refuse("a tolerance above the largest width", stored.report->tolerance,
                        found.largest_width);
    }
  }
  if (out.certificate.through_points) compare_ends(stored.contour, comparison);
  compare_transitions(stored, comparison);
  compare_runs(stored.contour, out.certificate, comparison);
  if (stored.certificate) compare_certificate(*stored.certificate, out.certificate, comparison);
  out.false_claim = comparison.refused();
  return out;
}

}  // namespace

Verification verify(const StoredContour& stored) {
  Watch nobody;
  return verified(stored, nobody);
}

Result<Verification> verify(const StoredContour& stored, const RunContext& run) {
  Watch watch(run);
  watch.tell("proving", 0.0);
  Verification out = verified(stored, watch);
  if (watch.was_cancelled()) return fail(cancelled_error());
  return out;
}

}  // namespace obvid
