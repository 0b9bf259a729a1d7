// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

#include "obvid/alignment/internal/transition_law.h"
#include "obvid/core/internal/format_into.h"
#include "obvid/curve/internal/clothoid.h"
#include "obvid/exchange/internal/road/landxml.h"
#include "obvid/exchange/internal/road/road_elements.h"
#include "road/landxml_units.h"
#include "xml_text.h"

namespace obvid {
namespace {

// What turns by more than this (150 degrees) is cut: beyond, tangents meet at an angle whose sine
// is below one half, so that the rounding of an end moves the PI by more than twice as much, and at
// half a turn they meet nowhere.
constexpr double kMostTangentTurn = 5.0 / 6.0 * std::numbers::pi;
// An arc has a centre in place of them: its ends and its sense tell it up to half a turn.
constexpr double kMostCurveTurn = std::numbers::pi;
constexpr double kMostElementParts = 10000.0;  // of one element: what turns more often is no road

// Grades that differ by more, as part of the steepest, meet in a corner.
constexpr double kSameGrade = 1e-9;

// Tangents that turn by less (rad) meet in the middle of the chord, to the square of this.
constexpr double kParallel = 1e-6;

/// Part [from, to] of an element, both in [0, 1].
RoadElement part_of_element(const RoadElement& e, double from, double to) {
  const double rate = e.kappa1 - e.kappa0;
  RoadElement part;
  part.s = e.s + from * e.length;
  part.kappa0 = e.kappa0 + from * rate;
  part.kappa1 = to == 1.0 ? e.kappa1 : e.kappa0 + to * rate;
  part.length = (to - from) * e.length;
  part.theta = e.theta + 0.5 * (e.kappa0 + part.kappa0) * from * e.length;
  const auto at = [&](double t) {
    return e.start + clothoid_step(e.theta, e.kappa0, e.kappa0 + t * rate, t * e.length);
  };
  part.start = from == 0.0 ? e.start : at(from);
  part.end = to == 1.0 ? e.end : at(to);
  return part;
}

/// Where on the way a piece whose curvature goes from k0 to k1, of one sign, has turned by a part
/// of its turn: of its length.
double at_part_of_turn(double k0, double k1, double part) {
  const double root = std::sqrt(k0 * k0 + part * (k1 * k1 - k0 * k0));
  return part * std::abs(k0 + k1) / (std::abs(k0) + root);
}

/// Parts between two parameters that turn alike, and little enough. No inflection lies within.
void cut_turns(const RoadElement& e, double from, double to, std::vector<RoadElement>& out) {
  const double k0 = e.kappa0 + from * (e.kappa1 - e.kappa0);
  const double k1 = e.kappa0 + to * (e.kappa1 - e.kappa0);
  const double turn = 0.5 * std::abs(k0 + k1) * (to - from) * e.length;
  const double most = e.kappa0 == e.kappa1 ? kMostCurveTurn : kMostTangentTurn;
  const int count = static_cast<int>(std::clamp(std::ceil(turn / most), 1.0, kMostElementParts));
  double a = from;
  for (int k = 1; k <= count; ++k) {
    const double b =
        k == count ? to
                   : from + (to - from) * at_part_of_turn(k0, k1, static_cast<double>(k) / count);
    out.push_back(part_of_element(e, a, b));
    a = b;
  }
}

std::vector<RoadElement> parts_of(const RoadElement& e) {
  std::vector<RoadElement> out;
  if (e.kappa0 * e.kappa1 < 0.0) {
    const double inflection = e.kappa0 / (e.kappa0 - e.kappa1);
    cut_turns(e, 0.0, inflection, out);
    out.back().kappa1 = 0.0;
    const std::size_t second = out.size();
    cut_turns(e, inflection, 1.0, out);
    out[second].kappa0 = 0.0;
  } else {
    cut_turns(e, 0.0, 1.0, out);
  }
  return out;
}

/// Where the tangents at both ends meet.
Vec2 tangents_meet(const RoadElement& e, Transition kind) {
  const double share = TransitionLaw(kind, e.kappa0, e.kappa1, e.length).turn(1.0);
  const double turn = (e.kappa0 + share * (e.kappa1 - e.kappa0)) * e.length;
  const Vec2 a = unit_at(e.theta), b = unit_at(e.theta + turn);
  if (std::abs(cross(a, b)) < kParallel) return 0.5 * (e.start + e.end);
  return e.start + cross(e.end - e.start, b) / cross(a, b) * a;
}

constexpr double kNoCoordinate = 1e-15;  // of the length: of sums along an alignment

class LandXmlWriter {
 public:
  /// `ratio`: units of the format in one of the contour.
  LandXmlWriter(const std::vector<RoadLine>& lines, std::string_view unit, double ratio,
                const LandXmlOptions& options)
      : lines_(lines), unit_(unit), ratio_(ratio), options_(options) {}

  std::string run() {
    double length = 0.0;
    for (const RoadLine& line : lines_) length += line.length;
    nothing_ = kNoCoordinate * length;
    const std::string name = escaped_xml(options_.name);
    put("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<LandXML xmlns=\"http://www.landxml.org/schema/LandXML-1.2\" version=\"1.2\" date=\"{}\" "
        "time=\"{}\">\n"
        "  <Units>\n    {}/>\n  </Units>\n",
        escaped_xml(options_.date), escaped_xml(options_.time), units());
    put("  <Alignments name=\"{}\">\n    <Alignment name=\"{}\" length=\"{}\" staStart=\"{}\">\n"
        "      <CoordGeom>\n",
        name, name, length, ratio_ * options_.first_station);
    std::size_t piece = 0;
    auto next = options_.transitions.begin();
    for (const RoadLine& line : lines_) {
      for (std::size_t k = 0; k < line.elements.size(); ++k, ++piece) {
        while (next != options_.transitions.end() && next->first_piece < piece) ++next;
        if (next != options_.transitions.end() && next->first_piece == piece &&
            k + next->pieces <= line.elements.size() && can_be_stated(*next)) {
          transition(*next, line.elements[k], line.elements[k + next->pieces - 1]);
          k += next->pieces - 1;
          piece += next->pieces - 1;
          continue;
        }
        const std::vector<RoadElement> parts = parts_of(line.elements[k]);
        // parts of one element have its number as their name: reading makes them one again
        const std::string name_of_parts =
            parts.size() > 1 ? fmt::format(" name=\"{}\"", piece + 1) : "";
        for (const RoadElement& part : parts) write(part, name_of_parts);
      }
    }
    put("      </CoordGeom>\n");
    if (options_.profile) profile(*options_.profile, name);
    put("    </Alignment>\n  </Alignments>\n</LandXML>\n");
    return std::move(out_);
  }

 private:
  template <class... Args>
  void put(fmt::format_string<Args...> text, Args&&... args) {
    format_into(out_, text, std::forward<Args>(args)...);
  }

  /// A coordinate; what rounding leaves of 0 is 0.
  [[nodiscard]] double place_of(double value) const {
    return std::abs(value) <= nothing_ ? 0.0 : value;
  }

  /// Northing first.
  void point(const char* kind, Vec2 p) {
    put("          <{0}>{1} {2}</{0}>\n", kind, place_of(p.y), place_of(p.x));
  }

  static std::string radius(double kappa) {
    return kappa == 0.0 ? "INF" : fmt::format("{}", 1.0 / std::abs(kappa));
  }

  void write(const RoadElement& e, const std::string& named) {
    if (e.is_line()) {
      put("        <Line length=\"{}\">\n", e.length);
      point("Start", e.start);
      point("End", e.end);
      put("        </Line>\n");
    } else if (e.is_arc()) {
      put("        <Curve{} rot=\"{}\" crvType=\"arc\" radius=\"{}\" length=\"{}\">\n", named,
          e.kappa0 > 0.0 ? "ccw" : "cw", radius(e.kappa0), e.length);
      point("Start", e.start);
      point("Center", e.start + left_normal(unit_at(e.theta)) / e.kappa0);
      point("End", e.end);
      put("        </Curve>\n");
    } else {
      spiral(e, Transition::kClothoid, named);
    }
  }

  void spiral(const RoadElement& e, Transition kind, const std::string& named = {}) {
    put("        <Spiral{} length=\"{}\" radiusStart=\"{}\" radiusEnd=\"{}\" rot=\"{}\" "
        "spiType=\"{}\">\n",
        named, e.length, radius(e.kappa0), radius(e.kappa1),
        e.kappa0 + e.kappa1 > 0.0 ? "ccw" : "cw",
        exchange::kLandXmlSpirals[static_cast<std::size_t>(kind)]);
    point("Start", e.start);
    point("PI", tangents_meet(e, kind));
    point("End", e.end);
    put("        </Spiral>\n");
  }

  /// A Spiral has one sense of rotation. Halves of a transition through an inflection are
  /// transitions of their kind only where that is a cubic parabola.
  static bool can_be_stated(const PlacedTransition& t) {
    return t.kappa0 * t.kappa1 >= 0.0 ||
           TransitionLaw(t.kind, t.kappa0, t.kappa1, t.length).inflection().has_value();
  }

  /// One Spiral from the start of the first element to the end of the last, or two that meet in the
  /// inflection.
  void transition(const PlacedTransition& t, const RoadElement& first, const RoadElement& last) {
    RoadElement whole = first;
    whole.end = last.end;
    whole.kappa0 = t.kappa0 / ratio_;
    whole.kappa1 = t.kappa1 / ratio_;
    whole.length = t.length * ratio_;
    const TransitionLaw law(t.kind, whole.kappa0, whole.kappa1, whole.length);
    const auto inflection = t.kappa0 * t.kappa1 < 0.0 ? law.inflection() : std::nullopt;
    if (!inflection) return spiral(whole, t.kind);
    const double before = *inflection * whole.length;
    const Element middle = transition_at(law, {whole.start, whole.theta, whole.kappa0},
                                         whole.kappa1, whole.length, before);
    RoadElement half = whole;
    half.end = middle.point;
    half.kappa1 = 0.0;
    half.length = before;
    spiral(half, t.kind);
    half = whole;
    half.start = middle.point;
    half.theta = middle.theta;
    half.kappa0 = 0.0;
    half.length = whole.length - before;
    spiral(half, t.kind);
  }

  /// A PVI at both ends, where grades meet one with its curve, and at corners one without.
  void profile(const VerticalProfile& profile, const std::string& name) {
    put("      <Profile name=\"{0}\">\n        <ProfAlign name=\"{0}\">\n", name);
    const auto place = [&](const char* opening, const char* kind, Vec2 at) {
      put("          <{}>{} {}</{}>\n", opening, place_of(ratio_ * at.x), ratio_ * at.y, kind);
    };
    place("PVI", "PVI", {profile.elements.front().station, profile.elements.front().height});
    double steepest = 0.0;
    for (const ProfileElement& e : profile.elements) {
      steepest = std::max({steepest, std::abs(e.grade0), std::abs(e.grade1)});
    }
    for (std::size_t k = 0; k < profile.elements.size(); ++k) {
      const ProfileElement& e = profile.elements[k];
      if (k > 0 && std::abs(e.grade0 - profile.elements[k - 1].grade1) > kSameGrade * steepest) {
        place("PVI", "PVI", {e.station, e.height});
      }
      if (e.kind == ProfileKind::kGrade) continue;
      const bool arc = profile.curves == ProfileCurves::kArcs;
      const std::string opening = arc ? fmt::format("CircCurve length=\"{}\" radius=\"{}\"",
                                                    ratio_ * e.length, ratio_ * std::abs(e.radius))
                                      : fmt::format("ParaCurve length=\"{}\"", ratio_ * e.length);
      place(opening.c_str(), arc ? "CircCurve" : "ParaCurve", grades_meet(e, profile.curves));
    }
    place("PVI", "PVI", {profile.end_station, profile.end_height});
    put("        </ProfAlign>\n      </Profile>\n");
  }

  [[nodiscard]] std::string units() const {
    const auto* one = std::find_if(exchange::kLandXmlUnits.begin(), exchange::kLandXmlUnits.end(),
                                   [&](const auto& unit) { return unit.name == unit_; });
    return fmt::format(
        fmt::runtime(one->metric ? "<Metric areaUnit=\"squareMeter\" linearUnit=\"{}\" "
                                   "volumeUnit=\"cubicMeter\" temperatureUnit=\"celsius\" "
                                   "pressureUnit=\"HPA\""
                                 : "<Imperial areaUnit=\"squareFoot\" linearUnit=\"{}\" "
                                   "volumeUnit=\"cubicFeet\" temperatureUnit=\"fahrenheit\" "
                                   "pressureUnit=\"inHG\""),
        one->theirs);
  }

  const std::vector<RoadLine>& lines_;
  std::string_view unit_;  ///< one of the format's
  double ratio_;           ///< of these in one of the contour
  const LandXmlOptions& options_;
  double nothing_ = 0.0;  ///< below, a coordinate is 0
  std::string out_;
};

}  // namespace

std::string_view landxml_unit(std::string_view unit) {
  std::array<std::string_view, exchange::kLandXmlUnits.size()> names;
  std::transform(exchange::kLandXmlUnits.begin(), exchange::kLandXmlUnits.end(), names.begin(),
                 [](const auto& one) { return one.name; });
  return unit_for_file(unit, names);
}

Result<std::string> landxml_text(const Contour& contour, const LandXmlOptions& options) {
  // a unit that is not known gets its error from `road_lines`
  const std::string_view unit = landxml_unit(contour.units.name);
  const std::string_view known = unit.empty() ? "m" : unit;
  const auto lines = road_lines(contour, known);
  OBVID_TRY(lines);
  const auto ratio = unit_ratio(contour.units, known, "road formats");
  OBVID_TRY(ratio);
  return LandXmlWriter(*lines, unit, *ratio, options).run();
}

}  // namespace obvid
