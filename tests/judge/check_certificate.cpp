// SPDX-License-Identifier: Apache-2.0
// The certificate: verdicts, gaps, counts, flags.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <regex>

#include "checks.h"
#include "counts.h"

namespace judge {
namespace {

/// What the flags call continuous (docs/claims.md).
constexpr double kPositionBound = 1e-12;  // of the size
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

/// Stated gaps are upper bounds: when all of them are within theirs, so are the true ones.
bool stated_within_bounds(const Course& course) {
  const Json& stated = member(course.file.certificate, "joint_gaps");
  const auto within = [&](const char* name, double bound) {
    const Figure one = figure(stated, name);
    return one.known() && *one.value <= bound;
  };
  return within("position", kPositionBound) && within("heading", kAngleBound) &&
         (course.file.carrier == "arcs" || within("curvature", kCurvatureBound)) &&
         (course.file.continuity != "G3" || within("slope", kSlopeBound));
}

/// The largest of position, at joints and of elements, lies so clearly within its bound.
bool meets_plainly(const Course& course, const Gaps& gaps) {
  constexpr double kPlainly = 0.1;
  const double most = std::max(gaps.position, worst_element_gap(course).position);
  return most <= kPlainly * kPositionBound;
}

void check_bounds_flag(const Course& course, const Gaps& gaps, Sheet& sheet) {
  const double position = std::max(kPositionBound, position_rounding(course));
  const bool arcs = course.file.carrier == "arcs";
  const bool can = gaps.position <= position && gaps.heading <= kAngleBound &&
                   (arcs || gaps.curvature <= kCurvatureBound) &&
                   (course.file.continuity != "G3" || gaps.slope <= kSlopeBound);
  // elements may disagree with the pieces; that is judged on its own and also makes the flag false
  constexpr double kElementsFit = 1e-10;
  const ElementGap elements = worst_element_gap(course);
  const bool plainly = stated_within_bounds(course) && meets_plainly(course, gaps) &&
                       elements.heading < kElementsFit && elements.curvature < kElementsFit;
  check_flag(course, "gaps_within_bounds", can, plainly,
             fmt::format("position {:.3g} of the size, heading {:.3g}, curvature {:.3g}",
                         gaps.position, gaps.heading, gaps.curvature),
             sheet);
}

/// Jumps of the curvature: none against the run it lies in, or against both runs. Those that
/// rounding makes count where arcs meet alone.
bool jumps_fit_runs(const Course& course) {
  const ContourFile& file = course.file;
  for (std::size_t r = 0; r < file.runs.size(); ++r) {
    const FileRun& run = file.runs[r];
    const FileRun& before = file.runs[r > 0 ? r - 1 : file.runs.size() - 1];
    for (std::size_t i = run.first; i <= run.last && i < course.joints.size(); ++i) {
      const bool counts = file.carrier == "arcs" || course.joints[i].clear_jump;
      const int jump = counts ? course.joints[i].jump : 0;
      const bool parted = file.parted_at(i), begins = i == run.first;
      if (parted && !begins) return false;
      if (parted || jump == 0 || jump == run.direction) continue;
      if (!begins || jump != before.direction) return false;
    }
  }
  return true;
}

/// Nothing stands in the way of a proof: every piece is said to be monotone and is, turns by less
/// than half a turn, and agrees with its run.
bool plainly_monotone(const Course& course) {
  constexpr Real kLessThanHalfATurn =
      0.9L * std::numbers::pi_v<Real>;  // what proofs need not be fine for
  for (const Json& one : member(course.file.certificate, "monotone")) {
    const std::string verdict = text_of(one, "verdict");
    if (verdict == "undecided" || verdict == "has-vertex") return false;
  }
  for (std::size_t i = 0; i < course.laws.size(); ++i) {
    if (!course.laws[i].decided || !course.laws[i].one_way()) return false;
    if (course.path.spans()[i].turning_both_ways(0.0L, 1.0L) > kLessThanHalfATurn) return false;
  }
  if (run_fault(course, true)) return false;
  for (const FileRun& run : course.file.runs) {
    for (std::size_t i = run.first; i <= run.last; ++i) {
      const int sign = course.laws[i].direction();
      if (sign != 0 && sign != run.direction) return false;
    }
  }
  return jumps_fit_runs(course);
}

/// Monotone pieces, none of which turns by half a turn, with gaps within bounds: the definition.
void check_region_flag(const Course& course, Sheet& sheet) {
  const char* claim = "certificate.inside_region";
  const auto stated = flag(course.file.certificate, "inside_region");
  if (!stated) return sheet.missing(claim);
  const bool gaps = flag(course.file.certificate, "gaps_within_bounds").value_or(false);
  if (!*stated) {
    sheet.expect(!(gaps && plainly_monotone(course)), claim, std::string("false"),
                 std::string("pieces are monotone, turn little, and gaps are within bounds"), "");
    return;
  }
  if (!gaps) return sheet.fails(claim, "true", "gaps_within_bounds is false", "");
  for (std::size_t i = 0; i < course.laws.size(); ++i) {
    const bool turns = course.laws[i].decided && !course.laws[i].one_way();
    const bool far =
        std::abs(course.path.spans()[i].turning(0.0L, 1.0L)) > std::numbers::pi_v<Real>;
    if (!turns && !far) continue;
    return sheet.fails(claim, "true", turns ? "curvature turns" : "turns by half a turn or more",
                       fmt::format("piece {}", i));
  }
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

/// Points are met by joints where the pieces meet, or within their tolerances; gaps of heading and
/// curvature have no say.
void check_points_flag(const Course& course, const Gaps& gaps, Sheet& sheet) {
  std::string why = missed_point(course);
  const double apart = std::max(gaps.position, worst_element_gap(course).position);
  const double bound = std::max(kPositionBound, position_rounding(course));
  if (why.empty() && course.file.tolerance.empty() && apart > bound) {
    why = fmt::format("pieces are {:.3g} of the size away from a joint", apart);
  }
  const bool plainly = missed_point(course, Doubt::kHindersTheClaim).empty();
  check_flag(course, "through_points", why.empty(), plainly && meets_plainly(course, gaps), why,
             sheet);
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

/// The number behind words of the reason ("piece 6 has a vertex"), counted from 0.
std::optional<std::size_t> named_in(const std::string& reason, const std::string& before,
                                    const std::string& behind) {
  std::smatch found;
  if (!std::regex_search(reason, found, std::regex(before + "(\\d+)" + behind)))
    return std::nullopt;
  return static_cast<std::size_t>(std::strtoul(found[1].str().c_str(), nullptr, 10)) - 1;
}

/// The reason is one, and one that stands in the way of what the carrier promises.
void check_reason(const Course& course, bool proved, Sheet& sheet) {
  const Json& certificate = course.file.certificate;
  const char* claim = "certificate.reason";
  const std::string reason = text_of(certificate, "reason");
  if (proved) {
    sheet.expect(reason.empty(), claim, reason, std::string("it is proved"), "");
    return;
  }
  if (reason.empty()) return sheet.fails(claim, "none", "not proved without a reason", "");
  const bool gaps = flag(certificate, "gaps_within_bounds").value_or(false);
  const bool points = flag(certificate, "through_points").value_or(false);
  const bool names_gap = reason.find(" gap ") != std::string::npos;
  if (names_gap && gaps) return sheet.fails(claim, reason, "gaps are within bounds", "");
  if (const auto i = named_in(reason, "^piece ", " has a vertex")) {
    const bool there = *i < course.laws.size() && !course.laws[*i].one_way();
    if (!there) return sheet.fails(claim, reason, "no such vertex", "");
  }
  const auto missed = named_in(reason, "passes? point ", " (at|after)");
  if (missed && points) return sheet.fails(claim, reason, "all points are met", "");
  // a vertex breaks no promise of these
  const bool promised = course.file.promises_monotone() || (gaps && points);
  const bool serves =
      promised || (!gaps ? names_gap || reason.find(" joints, not ") != std::string::npos
                         : reason.find("point") != std::string::npos);
  sheet.expect(serves, claim, reason,
               gaps ? std::string("a point is missed") : std::string("a gap is beyond its bound"),
               "");
}

/// proved = every other claim of the certificate.
void check_proved(const Course& course, const Gaps& gaps, Sheet& sheet) {
  const Json& certificate = course.file.certificate;
  const char* claim = "certificate.proved";
  const auto stated = flag(certificate, "proved");
  if (!stated) return sheet.missing(claim);
  check_reason(course, *stated, sheet);
  std::string stands;
  for (const char* name : {"gaps_within_bounds", "inside_region", "through_points"}) {
    if (flag(certificate, name) == false) stands = std::string(name) + " is false";
  }
  if (!*stated) {
    sheet.expect(!stands.empty(), claim, std::string("false"),
                 std::string("gaps, region and points are as they have to be"), "");
    return;
  }
  if (!stands.empty()) return sheet.fails(claim, "true", stands, "");
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
  check_points_flag(course, gaps, sheet);
  check_counts(course, sheet);
  check_crossings(course, sheet);
  check_proved(course, gaps, sheet);
}

}  // namespace judge
