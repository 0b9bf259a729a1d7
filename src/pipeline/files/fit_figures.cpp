// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/fit_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "obvid/core/internal/figures.h"
#include "obvid/pipeline/internal/promise.h"

namespace obvid {
namespace {

std::string fairness_text(const FitReport& report) {
  return fmt::format(
      "{} ({}), {}", counted(static_cast<std::size_t>(report.vertices), "vertex", "vertices"),
      vertex_bound_text(report.vertices_lower_bound),
      counted(static_cast<std::size_t>(report.inflections), "inflection", "inflections"));
}

std::string time_text(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.0f} us", seconds * 1e6);
  if (seconds < 1.0) return fmt::format("{:.1f} ms", seconds * 1e3);
  return fmt::format("{:.2f} s", seconds);
}

struct LargestError {
  double value = 0.0;
  bool known = false;                      // on any segment
  const SegmentReport* segment = nullptr;  // none: not known on any segment, or 0 on all

  void meet(double other, const SegmentReport& at) {
    known = known || !std::isnan(other);
    if (!(other > value)) return;  // unknown ones are not met
    value = other;
    segment = &at;
  }
};

/// A coordinate with so many digits that a thousandth of the chord there shows: far from the origin
/// that is more than usual.
std::string beside(double value, double chord) {
  constexpr int kUsual = 5, kMost = 15;
  constexpr double kShown = 1e-3;
  if (!(chord > 0.0) || value == 0.0) return significant(value);
  const double digits = std::ceil(std::log10(std::abs(value) / (kShown * chord)));
  return significant(value, static_cast<int>(std::clamp<double>(digits, kUsual, kMost)));
}

/// What the points alone leave open, and what is left once tangents and curvatures are chosen.
std::string error_text(const FitReport& report, const std::string& units) {
  LargestError points_only;
  LargestError chosen;
  std::size_t unknown = 0;  // segments of which the points alone say nothing
  for (const SegmentReport& segment : report.segments) {
    points_only.meet(segment.points_only_error, segment);
    chosen.meet(segment.deviation, segment);
    unknown += std::isnan(segment.points_only_error) ? 1 : 0;
  }
  // lines and circles alone say nothing of what lies between them
  if (points_only.segment == nullptr && unknown > 0) points_only.known = false;
  const auto text_of = [&units](const LargestError& error) {
    return error.known ? known_length(error.value, units) : "unknown";
  };
  std::string text = text_of(points_only) + " from the points alone";
  if (points_only.segment != nullptr) {
    text += fmt::format(" (points {}", points_of_segment(*points_only.segment));
    text += unknown > 0 ? fmt::format(", unknown over {})", counted(unknown, "segment", "segments"))
                        : ")";
  }
  text += fmt::format("; {} with these tangents and curvatures", text_of(chosen));
  if (chosen.segment != nullptr) {
    const Vec2 at = chosen.segment->deviation_at;
    text += fmt::format(" (points {}, at {}, {})", points_of_segment(*chosen.segment),
                        beside(at.x, chosen.segment->chord), beside(at.y, chosen.segment->chord));
  }
  return text;
}

std::string given_text(const GivenReport& given) {
  std::vector<std::string> kinds;
  if (given.headings > 0) kinds.push_back(counted(given.headings, "heading", "headings"));
  if (given.curvatures > 0) kinds.push_back(counted(given.curvatures, "radius", "radii"));
  if (given.corners > 0) kinds.push_back(counted(given.corners, "corner", "corners"));
  const std::size_t ranges = given.heading_ranges + given.curvature_ranges;
  if (ranges > 0) kinds.push_back(counted(ranges, "range", "ranges"));
  std::string text = listed(kinds) + " met";
  std::vector<std::string> misses;
  if (given.headings + given.heading_ranges > 0)
    misses.push_back(significant(given.heading_miss, 2) + " rad");
  if (given.curvatures + given.curvature_ranges > 0) {
    misses.push_back(significant(given.curvature_miss, 2) + " of the curvature");
  }
  return misses.empty() ? text : text + "; largest miss " + listed(misses);
}

/// "at point 5 the greatest heading, at point 10 the least curvature"; "none" where the contour
/// lies inside all ranges.
std::string active_text(const std::vector<ActiveRange>& active) {
  std::string text;
  for (const ActiveRange& one : active) {
    text += fmt::format("{}at point {} the {} {}", text.empty() ? "" : ", ", one.point + 1,
                        one.high ? "greatest" : "least", one.heading ? "heading" : "curvature");
  }
  return text.empty() ? "none: the contour lies inside all ranges" : text;
}

void add_bounds(const Contour& contour, const FitReport& report, FigureRows& facts) {
  facts.emplace_back("largest error", error_text(report, contour.units.text()));
  facts.emplace_back(
      "largest width",
      fmt::format("{} (tolerance {})", known_length(report.largest_width, contour.units.text()),
                  significant(report.tolerance, 4)));
  facts.emplace_back("bound needed",
                     counted(report.inserted_points, "inserted element", "inserted elements"));
}

/// What stays of a drawing, and what stands between; empty for points.
std::string kept_text(const Contour& contour, const Certificate& certificate) {
  std::string text = as_drawn_text(contour);
  if (text.empty()) return text;
  const std::size_t made = contour.pieces.size() - contour.kept.size();
  text += "; " + counted(static_cast<std::size_t>(certificate.corners), "corner", "corners");
  if (certificate.curvature_steps > 0) {
    text += fmt::format(", {} with a step of the curvature",
                        counted(static_cast<std::size_t>(certificate.curvature_steps),
                                "common tangent", "common tangents"));
  }
  if (made > 0) text += "; " + counted(made, "other piece", "other pieces") + " through points";
  return text;
}

/// Where joints of a G3 contour are G2 only: the points at or before them.
std::string stepping_points_text(const Contour& contour) {
  constexpr std::size_t kMostNamed = 8;
  std::vector<std::size_t> beside;
  std::optional<std::size_t> last = contour.joints.front().source;
  for (const Joint& joint : contour.joints) {
    if (is_station(joint)) last = joint.source ? joint.source : joint.after;
    if (!joint.slope_step || !last) continue;
    if (beside.empty() || beside.back() != *last) beside.push_back(*last);
  }
  if (beside.empty()) return {};
  std::string out = beside.size() == 1 ? "beside point " : "beside points ";
  for (std::size_t i = 0; i < std::min(beside.size(), kMostNamed); ++i) {
    out += fmt::format("{}{}", i > 0 ? ", " : "", beside[i] + 1);
  }
  return out + and_more(beside.size(), kMostNamed);
}

/// Corners that stand on no point: the points before and behind them.
std::string corners_between_text(const Contour& contour) {
  constexpr std::size_t kMostNamed = 8;
  std::size_t count = 0;
  std::string places;
  for (const Joint& joint : contour.joints) {
    if (joint.source || !joint.after) continue;
    if (++count > kMostNamed) continue;
    places += fmt::format("{}{} and {}", count > 1 ? ", " : "", *joint.after + 1,
                          (*joint.after + 1) % contour.points.size() + 1);
  }
  if (count == 0) return places;
  return fmt::format("{} where lines and arcs meet, points {}{}",
                     counted(count, "corner", "corners"), places, and_more(count, kMostNamed));
}

}  // namespace

std::string known_length(double value, const std::string& unit, int digits) {
  return std::isnan(value) ? "unknown" : significant(value, digits) + " " + unit;
}

std::string points_of_segment(const SegmentReport& segment) {
  return fmt::format("{}-{}", segment.from.value_or(0) + 1, segment.to.value_or(0) + 1);
}

std::string as_drawn_text(const Contour& contour) {
  const KeptPieces kept = kept_pieces(contour);
  std::string text;
  const auto add = [&](std::size_t count, const char* one, const char* many) {
    if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, one, many);
  };
  add(kept.lines, "line", "lines");
  add(kept.arcs, "arc", "arcs");
  add(kept.ellipses, "arc of an ellipse", "arcs of ellipses");
  add(kept.clothoids, "clothoid", "clothoids");
  return text.empty() ? text : text + " as drawn";
}

FigureRows fit_figures(const Contour& contour, const FitReport& report,
                       const Certificate& certificate) {
  FigureRows facts;
  std::string pieces = counted(contour.pieces.size(), "piece", "pieces") + " through " +
                       counted(contour.points.size(), "point", "points");
  if (report.chain.free_elements > 0) {
    pieces += fmt::format(", {} free between them",
                          counted(report.chain.free_elements, "joint", "joints"));
  }
  facts.emplace_back("contour",
                     fmt::format("{} in {}", pieces, counted(contour.runs.size(), "run", "runs")));
  if (const std::string kept = kept_text(contour, certificate); !kept.empty()) {
    facts.emplace_back("taken over", kept);
  }
  if (std::string between = corners_between_text(contour); !between.empty()) {
    facts.emplace_back("corners between", std::move(between));
  }
  facts.emplace_back("fairness", fairness_text(report));
  if (const int crossings = certificate.self_intersections; crossings > 0) {
    facts.emplace_back("self-intersections", std::to_string(crossings));
  }
  if (promises_monotone(contour.carrier)) add_bounds(contour, report, facts);
  const GivenReport& given = report.given;
  const std::size_t ranges = given.heading_ranges + given.curvature_ranges;
  if (given.headings + given.curvatures + given.corners + ranges > 0) {
    facts.emplace_back("given data", given_text(given));
  }
  if (ranges > 0) facts.emplace_back("at an end", active_text(given.active));
  if (report.carrier_deviation && report.outside_spirals_region) {
    const double outside = *report.outside_spirals_region;
    facts.emplace_back("from the spirals",
                       fmt::format("{} {} as measured, {}",
                                   significant(*report.carrier_deviation, 4), contour.units.text(),
                                   outside > 0.0 ? significant(outside, 4) + " outside their region"
                                                 : "inside their region"));
  }
  if (report.largest_move > 0.0) {
    facts.emplace_back("largest move",
                       significant(report.largest_move, 4) + " " + contour.units.text());
  }
  facts.emplace_back("joint gaps", gaps_text(contour.carrier, certificate));
  if (report.waviness) {
    facts.emplace_back("waviness", fmt::format("{} hills of the slope of curvature on a run",
                                               significant(*report.waviness, 4)));
  }
  if (const auto before = report.chain.slope_step_g2) {
    std::string text =
        fmt::format("the slope of curvature would step by {} of the largest beside it",
                    significant(*before, 2));
    if (const auto waviness = report.chain.waviness_g2) {
      text += fmt::format(", waviness {}", significant(*waviness, 4));
    }
    facts.emplace_back("as G2 contour", text);
  }
  if (!report.chain.g2_because.empty()) facts.emplace_back("G2 because", report.chain.g2_because);
  if (const std::string steps = stepping_points_text(contour); !steps.empty()) {
    facts.emplace_back("slope steps", steps);
  }
  facts.emplace_back("time", time_text(report.seconds));
  return facts;
}

}  // namespace obvid
