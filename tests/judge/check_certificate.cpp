// SPDX-License-Identifier: Apache-2.0
// The certificate: verdicts, gaps, counts, flags.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "checks.h"
#include "counts.h"

namespace judge {
namespace {

/// What the flags call continuous (docs/claims.md).
constexpr double kPositionBound = 1e-12;  // of the size
constexpr double kAngleBound = 1e-6;      // rad
constexpr double kCurvatureBound = 1e-6;  // of the larger curvature
constexpr double kSlopeBound = 1e-6;      // of the largest slope of both pieces
/// Figures stated as bounds may be this much below in the last digits of their own text.
constexpr double kLastDigit = 1e-12;

struct Gaps {
  double position = 0.0, heading = 0.0, curvature = 0.0,
         slope = 0.0;  // lower bounds of the true ones
  std::size_t at_position = 0, at_heading = 0, at_curvature = 0, at_slope = 0;
};

void meet(double& most, std::size_t& at, double value, std::size_t joint) {
  if (value > most) {
    most = value;
    at = joint;
  }
}

/// The gaps at all joints; also between a piece's stored end and where its numbers lead.
Gaps gaps_of(const Course& course) {
  Gaps out;
  const std::size_t first = course.file.closed ? 0 : 1;
  for (std::size_t j = first; j < course.joints.size(); ++j) {
    const JointFacts& joint = course.joints[j];
    meet(out.position, out.at_position, joint.position.lower() / course.ends.size, j);
    if (joint.corner) continue;
    meet(out.heading, out.at_heading, joint.heading.lower(), j);
    meet(out.curvature, out.at_curvature, joint.curvature.lower(), j);
    meet(out.slope, out.at_slope, joint.slope.lower(), j);
  }
  for (std::size_t i = 0; i < course.file.pieces.size(); ++i) {
    const Point stored = stored_end(course.file.pieces[i]);
    if (std::holds_alternative<Bezier>(course.file.pieces[i])) continue;
    const BallVec off = course.ends.end[i].point - BallVec{stored.x, stored.y};
    meet(out.position, out.at_position, norm(off).lower() / course.ends.size, i + 1);
  }
  return out;
}

/// What rounding of coordinates and headings explains as a position gap, of the size.
double position_rounding(const Course& course) {
  constexpr double kUnit = 0x1p-53, kRoundings = 16.0;
  double heading = 0.0;
  for (const Piece& piece : course.file.pieces) {
    if (const auto* arc = std::get_if<Arc>(&piece)) {
      heading = std::max(heading, (1.0 + std::abs(arc->theta0)) * arc->length);
    } else if (const auto* one = std::get_if<Clothoid>(&piece)) {
      heading = std::max(heading, (1.0 + std::abs(one->theta0)) * one->length);
    }
  }
  return kRoundings * kUnit * (course.ends.coordinate + heading) / course.ends.size;
}

std::string verdict_of(const CurvatureLaw& law) {
  if (!law.decided || !law.regular) return "undecided";
  if (law.signs.size() > 1) return "has-vertex";
  return law.signs.front() > 0 ? "increasing" : law.signs.front() < 0 ? "decreasing" : "constant";
}

bool vertex_inside(const Course& course, std::size_t piece, double t0, double t1) {
  for (const Turn& turn : course.laws[piece].turns) {
    if (turn.to >= t0 && turn.from <= t1) {
      const auto* bezier = std::get_if<Bezier>(&course.file.pieces[piece]);
      if (turn.from >= t0 && turn.to <= t1) return true;
      if (bezier == nullptr) return true;
      return slope_sign(*bezier, t0) != slope_sign(*bezier, t1);
    }
  }
  return false;
}

void check_verdicts(const Course& course, Sheet& sheet) {
  const Json& list = member(course.file.certificate, "monotone");
  const char* claim = "certificate.monotone";
  if (!list.is_array()) return sheet.missing(claim);
  sheet.expect(list.size() == course.laws.size(), claim, list.size(), course.laws.size(),
               "number of verdicts");
  for (std::size_t k = 0; k < list.size(); ++k) {
    const Figure index = figure(list[k], "piece");
    const auto i = static_cast<std::size_t>(index.value.value_or(static_cast<double>(k)));
    if (i >= course.laws.size()) {
      sheet.fails(claim, fmt::format("piece {}", i), "no such piece", "");
      continue;
    }
    const CurvatureLaw& law = course.laws[i];
    const std::string stated = text_of(list[k], "verdict"), found = verdict_of(law);
    const std::string where = fmt::format("piece {}", i);
    if (!law.decided) {
      sheet.unjudged(claim, "sign not decided with 5,000 digits", where);
    } else if (stated == "undecided") {
      sheet.holds(claim);  // claims nothing
    } else {
      sheet.expect(stated == found, claim, stated, found, where);
    }
    if (stated == "has-vertex" && found == stated && list[k].contains("t0")) {
      const double t0 = *figure(list[k], "t0").value, t1 = *figure(list[k], "t1").value;
      sheet.expect(vertex_inside(course, i, t0, t1), "certificate.t0,t1",
                   fmt::format("{:.17g}..{:.17g}", t0, t1),
                   fmt::format("{:.17g}..{:.17g}", law.turns[0].from, law.turns[0].to), where);
    }
  }
}

void check_gaps(const Course& course, const Gaps& gaps, Sheet& sheet) {
  const Json& stated = member(course.file.certificate, "joint_gaps");
  const auto one = [&](const char* name, double found, std::size_t at) {
    const std::string claim = std::string("certificate.joint_gaps.") + name;
    const Figure value = figure(stated, name);
    if (!value.present) return sheet.missing(claim);
    if (!value.known()) return sheet.unjudged(claim, "null");
    sheet.expect(*value.value >= found * (1.0 - kLastDigit), claim, *value.value, found,
                 fmt::format("joint {}", at));
  };
  one("position", gaps.position, gaps.at_position);
  one("heading", gaps.heading, gaps.at_heading);
  one("curvature", gaps.curvature, gaps.at_curvature);
  if (course.file.continuity == "G3") one("slope", gaps.slope, gaps.at_slope);
}

/// A flag that is stated true must be true; one stated false must not be plainly true.
void check_flag(const Course& course, const char* name, bool can_hold, bool plainly_holds,
                const std::string& why, Sheet& sheet) {
  const std::string claim = std::string("certificate.") + name;
  const auto stated = flag(course.file.certificate, name);
  if (!stated) return sheet.missing(claim);
  if (*stated) {
    sheet.expect(can_hold, claim, std::string("true"), why, "");
  } else {
    sheet.expect(!plainly_holds, claim, std::string("false"), std::string("it holds"), "");
  }
}

void check_bounds_flag(const Course& course, const Gaps& gaps, Sheet& sheet) {
  const double position = std::max(kPositionBound, position_rounding(course));
  const bool arcs = course.file.carrier == "arcs";
  const bool can = gaps.position <= position && gaps.heading <= kAngleBound &&
                   (arcs || gaps.curvature <= kCurvatureBound) &&
                   (course.file.continuity != "G3" || gaps.slope <= kSlopeBound);
  const bool plainly = gaps.position <= 0.1 * kPositionBound && gaps.heading <= 1e-10 &&
                       (arcs || gaps.curvature <= 1e-10) &&
                       (course.file.continuity != "G3" || gaps.slope <= 0.1 * kSlopeBound);
  // elements may disagree with the pieces; that is judged on its own and also makes the flag false
  const bool elements_fit = worst_element_gap(course).heading < 1e-10;
  check_flag(course, "gaps_within_bounds", can, plainly && elements_fit,
             fmt::format("position {:.3g} of the size, heading {:.3g}, curvature {:.3g}",
                         gaps.position, gaps.heading, gaps.curvature),
             sheet);
}

void check_region_flag(const Course& course, Sheet& sheet) {
  const char* claim = "certificate.inside_region";
  const auto stated = flag(course.file.certificate, "inside_region");
  if (!stated) return sheet.missing(claim);
  if (!*stated) return sheet.holds(claim);  // claims nothing
  for (const Part& part : course.parts) {
    for (std::size_t k = 0; k + 1 < part.cuts.size(); ++k) {
      const Real a = part.cuts[k], b = part.cuts[k + 1];
      if (course.monotone(a, b) && course.turning(a, b) < std::numbers::pi_v<Real>) continue;
      const std::string where = fmt::format("points {}-{}", part.from_point + 1, part.to_point + 1);
      const Real out = outside_region(course, a, b);
      if (out > course.resolution() + 1e-9L * course.ends.size) {
        return sheet.fails(claim, "true", fmt::format("outside by {:.3Lg}", out), where);
      }
      return sheet.unjudged(claim, "part that is not monotone or turns by half a turn or more",
                            where);
    }
  }
  sheet.holds(claim);
}

void check_points_flag(const Course& course, Sheet& sheet) {
  const std::string why = missed_point(course);
  check_flag(course, "through_points", why.empty(), false, why, sheet);
}

void check_counts(const Course& course, Sheet& sheet) {
  const auto one = [&](const std::string& claim, const Figure& stated, const CountRange& range) {
    if (!stated.present) return sheet.missing(claim);
    if (!range.known) return sheet.unjudged(claim, "a law of curvature is not decided");
    const double value = stated.value.value_or(-1.0);
    const bool ok = value >= range.least && value <= range.most;
    sheet.expect(ok, claim, shown(value), fmt::format("{}..{}", range.least, range.most), "");
  };
  const CountRange vertices = count_vertices(course), inflections = count_inflections(course);
  for (const auto& [group, object] : {std::pair{"certificate", &course.file.certificate},
                                      std::pair{"report", &course.file.report}}) {
    if (object->is_null()) continue;
    one(std::string(group) + ".vertices", figure(*object, "vertices"), vertices);
    one(std::string(group) + ".inflections", figure(*object, "inflections"), inflections);
  }
  int corners = 0, steps = 0;
  for (std::size_t j = course.file.closed ? 0 : 1; j < course.joints.size(); ++j) {
    corners += course.joints[j].corner ? 1 : 0;
    steps += course.joints[j].step ? 1 : 0;
  }
  const Figure stated = figure(course.file.certificate, "corners");
  if (!stated.present) return sheet.missing("certificate.corners");
  sheet.expect(stated.value == corners, "certificate.corners", stated.value.value_or(-1), corners,
               "");
  if (course.file.continuity == "G3") {
    int slope_steps = 0;
    for (const JointFacts& joint : course.joints) slope_steps += joint.slope_step ? 1 : 0;
    const Figure stepped = figure(course.file.certificate, "slope_steps");
    sheet.expect(stepped.value.value_or(-1.0) == slope_steps, "certificate.slope_steps",
                 stepped.value.value_or(-1.0), slope_steps, "");
  }
  const Figure said = figure(course.file.certificate, "curvature_steps");
  sheet.expect(said.value.value_or(0.0) == steps, "certificate.curvature_steps",
               said.value.value_or(0.0), steps, "");
}

void check_crossings(const Course& course, Sheet& sheet) {
  const char* claim = "certificate.self_intersections";
  const Figure stated = figure(course.file.certificate, "self_intersections");
  if (!stated.present) return sheet.missing(claim);
  const auto found = count_crossings(course);
  if (!found) return sheet.unjudged(claim, "too many pieces");
  if (stated.value == *found) return sheet.holds(claim);
  sheet.unjudged(
      claim, fmt::format("stated {}, polylines cross {} times", stated.value.value_or(-1), *found));
}

/// proved = every other claim of the certificate.
void check_proved(const Course& course, const Gaps& gaps, Sheet& sheet) {
  const Json& certificate = course.file.certificate;
  const char* claim = "certificate.proved";
  const auto stated = flag(certificate, "proved");
  if (!stated) return sheet.missing(claim);
  if (!*stated) {
    sheet.expect(!text_of(certificate, "reason").empty(), "certificate.reason", std::string("none"),
                 std::string("not proved without a reason"), "");
    return sheet.holds(claim);
  }
  for (const char* name : {"gaps_within_bounds", "inside_region", "through_points"}) {
    if (flag(certificate, name) == false) {
      return sheet.fails(claim, "true", std::string(name) + " is false", "");
    }
  }
  for (std::size_t i = 0; i < course.laws.size(); ++i) {
    const CurvatureLaw& law = course.laws[i];
    if (law.decided && !law.one_way()) {
      return sheet.fails(claim, "true", "curvature turns", fmt::format("piece {}", i));
    }
  }
  const bool smooth = course.file.carrier == "arcs" || gaps.curvature <= kCurvatureBound;
  sheet.expect(smooth && gaps.heading <= kAngleBound, claim, std::string("true"),
               fmt::format("gaps: heading {:.3g}, curvature {:.3g}", gaps.heading, gaps.curvature),
               fmt::format("joint {}", gaps.at_curvature));
}

}  // namespace

void check_certificate(const Course& course, Sheet& sheet) {
  if (course.file.certificate.is_null()) return sheet.missing("certificate");
  const Gaps gaps = gaps_of(course);
  check_verdicts(course, sheet);
  check_gaps(course, gaps, sheet);
  check_bounds_flag(course, gaps, sheet);
  check_region_flag(course, sheet);
  check_points_flag(course, sheet);
  check_counts(course, sheet);
  check_crossings(course, sheet);
  check_proved(course, gaps, sheet);
}

}  // namespace judge
