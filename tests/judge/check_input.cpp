// SPDX-License-Identifier: Apache-2.0
// Whether the contour is what was asked for: points, unit, closing, tolerances, given data.
#include <fmt/format.h>
#include <cstdlib>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "checks.h"

namespace judge {

double rounding_of(const std::vector<GivenPoint>& points, int most_decimals) {
  // from here on numbers are written with an exponent: their last digit may stand before the point
  constexpr double kWithExponent = 1e16;
  constexpr int kFewest = -300;
  const bool any = std::any_of(points.begin(), points.end(), [](const GivenPoint& p) {
    return std::max(std::abs(p.point.x), std::abs(p.point.y)) >= kWithExponent;
  });
  for (int decimals = any ? kFewest : 0; decimals < most_decimals; ++decimals) {
    const auto shows = [decimals](double x) {
      if (decimals >= 0 || x == 0.0) {
        return std::strtod(fmt::format("{:.{}f}", x, std::max(decimals, 0)).c_str(), nullptr) == x;
      }
      const int digits = static_cast<int>(std::floor(std::log10(std::abs(x)))) + decimals;
      return std::abs(x) >= kWithExponent && digits >= 0 &&
             std::strtod(fmt::format("{:.{}e}", x, digits).c_str(), nullptr) == x;
    };
    const auto both = [&](const GivenPoint& p) { return shows(p.point.x) && shows(p.point.y); };
    if (std::all_of(points.begin(), points.end(), both)) return 0.5 * std::pow(10.0, -decimals);
  }
  return 0.0;
}

namespace {

constexpr double kGivenHeading = 1e-6;      // rad (docs/claims.md)
constexpr double kGivenCurvature = 1e-6;    // of the curvature, or of the largest around where 0
constexpr double kDefaultTolerance = 3e-6;  // of the size (docs/cli.md)

struct Expected {
  std::vector<GivenPoint> points;
  bool closed = false;
  bool joined = false;  ///< the last point became the first one
};

double reach_of(const GivenPoint& p, const Input& input) {
  return p.tolerance.value_or(input.noise.value_or(0.0));
}

/// Where the ends are as far apart as their tolerances reach, to the last digits, rounding decides.
Expected expected_of(const Input& input, const ContourFile& file) {
  Expected out{input.points, input.closed, false};
  if (out.points.size() < 3 || input.open) return out;
  const GivenPoint first = out.points.front(), last = out.points.back();
  const double apart = std::hypot(first.point.x - last.point.x, first.point.y - last.point.y);
  // the first point again, as sums and products of doubles give it
  const bool exact = apart <= 16.0 * 0x1p-53 * (std::abs(first.point.x) + std::abs(first.point.y));
  const double rounding = input.rounding ? rounding_of(input.points) : 0.0;
  double reach = std::max(2.0 * rounding, reach_of(first, input) + reach_of(last, input));
  // so little is left to the rounding of coordinates (docs/methods/series.md)
  constexpr double kToldFromRounding = 64.0 * 0x1p-53;
  double largest = 0.0;
  for (const GivenPoint& p : input.points) {
    largest = std::max(largest, std::abs(p.point.x) + std::abs(p.point.y));
  }
  if (file.tolerance.empty() && reach < 2.0 * kToldFromRounding * largest) reach = 0.0;
  constexpr double kLastDigits = 1.0 + 1e-9;
  const bool one_less = file.closed && file.points.size() + 1 == out.points.size();
  const bool leaves_a_loop = out.points.size() > 3;
  const bool near =
      leaves_a_loop && (apart * kLastDigits < reach || (apart <= reach * kLastDigits && one_less));
  if (!exact && !near) return out;
  out.closed = true;
  out.joined = !exact;
  GivenPoint& kept = out.points.front();
  if (!kept.heading) kept.heading = last.heading;
  if (!kept.kappa) kept.kappa = last.kappa;
  narrow(kept.headings, last.headings);
  narrow(kept.kappas, last.kappas);
  out.points.pop_back();
  return out;
}

double norm_of(Point p) { return std::hypot(p.x, p.y); }

/// `--noise auto`: no point may move farther than the scatter of all says; one median is as good as
/// the other, and the last digits are those of the program's own sum.
constexpr double kScatterDigits = 1.0 + 1e-6;

/// A placed point is rounded a few times on its way.
double rounding_of_place(const Course& course, Point p) {
  constexpr double kRoundings = 16.0 * 0x1p-53;
  return kRoundings * (course.ends.coordinate + norm_of(p));
}

/// Neighbours that a few roundings can make one point: placed points that are equal are merged.
std::size_t count_what_may_coincide(const Course& course, const std::vector<GivenPoint>& points) {
  std::size_t out = 0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point a = points[i - 1].point, b = points[i].point;
    if (std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) <= rounding_of_place(course, b)) ++out;
  }
  return out;
}

void check_points(const Course& course, const Expected& expected, const Input& input,
                  Sheet& sheet) {
  const ContourFile& file = course.file;
  if (input.placed && file.points.size() < expected.points.size() &&
      expected.points.size() - file.points.size() <=
          count_what_may_coincide(course, expected.points)) {
    return sheet.unjudged("points", "placed points became equal");
  }
  if (!sheet.expect(file.points.size() == expected.points.size(), "points",
                    static_cast<long double>(file.points.size()),
                    static_cast<long double>(expected.points.size()), "number of points")) {
    return;
  }
  for (std::size_t i = 0; i < file.points.size(); ++i) {
    const Point a = file.points[i], b = expected.points[i].point;
    const bool moved = expected.joined && i == 0;
    const double off = std::max(std::abs(a.x - b.x), std::abs(a.y - b.y));
    const bool placed = input.placed && off <= rounding_of_place(course, b);
    if (a == b || moved || placed) continue;
    return sheet.fails("points", fmt::format("[{}, {}]", a.x, a.y),
                       fmt::format("[{}, {}]", b.x, b.y), fmt::format("point {}", i + 1));
  }
  sheet.holds("points");
  if (input.rounding) return;
  for (std::size_t i = 0; i < file.points.size(); ++i) {
    const double stated = file.tolerance.empty() ? 0.0 : file.tolerance[i];
    double asked = reach_of(expected.points[i], input);
    // these follow the spirals within the tolerance (docs/carriers.md)
    if (file.carrier == "bspline" || file.carrier == "cubic") {
      asked += figure(file.report, "tolerance").value.value_or(0.0);
    }
    if (input.automatic) asked *= kScatterDigits;
    if (stated <= asked || (expected.joined && i == 0)) continue;
    return sheet.fails("point_tolerance", shown(stated), shown(asked),
                       fmt::format("point {}", i + 1));
  }
  sheet.holds("point_tolerance");
}

/// The ends that meet at a point: of the contour, by the file's stations.
struct Sides {
  std::vector<std::pair<double, double>> heading_kappa;
  double largest_kappa = 0.0;
};

Sides sides_at(const Course& course, std::size_t point) {
  Sides out;
  const auto add = [&](Real order, bool behind) {
    const Element e = course.element(order, behind);
    double kappa = static_cast<double>(e.kappa);
    if (order == std::floor(order)) {
      const auto j = static_cast<std::size_t>(order);
      const std::size_t piece = behind ? j : j - 1;
      kappa = static_cast<double>(
          (behind ? course.ends.start[piece] : course.ends.end[piece]).kappa.middle());
      out.largest_kappa =
          std::max({out.largest_kappa,
                    static_cast<double>(std::abs(course.ends.start[piece].kappa.middle())),
                    static_cast<double>(std::abs(course.ends.end[piece].kappa.middle()))});
    }
    out.heading_kappa.emplace_back(static_cast<double>(e.theta), kappa);
  };
  for (const Part& part : course.parts) {
    if (part.from_point == point) add(part.from, true);
    if (part.to_point == point) add(part.to, false);
  }
  return out;
}

/// How far the contour is from a given heading or curvature at a point: on its worst side, at a
/// corner on its best one.
struct Miss {
  double off = 0.0, stated = 0.0;
};

Miss heading_miss(const Sides& sides, double given, bool corner) {
  Miss worst, best{std::numeric_limits<double>::max(), 0.0};
  for (const auto& [heading, kappa] : sides.heading_kappa) {
    const double off = std::abs(std::remainder(heading - given, 2.0 * std::numbers::pi));
    if (off >= worst.off) worst = {off, heading};
    if (off < best.off) best = {off, heading};
  }
  return corner ? best : worst;
}

/// Of the curvature, or of the largest one around where 0 was given.
Miss curvature_miss(const Course& course, const Sides& sides, double given, bool corner) {
  const double scale = given != 0.0 ? std::abs(given) : std::max(sides.largest_kappa, 1e-300);
  Miss worst, best{std::numeric_limits<double>::max(), 0.0};
  double low = std::numeric_limits<double>::max(), high = -low;
  for (const auto& [heading, kappa] : sides.heading_kappa) {
    const double off = std::abs(kappa - given) / scale;
    if (off >= worst.off) worst = {off, kappa};
    if (off < best.off) best = {off, kappa};
    low = std::min(low, kappa);
    high = std::max(high, kappa);
  }
  // arcs: any curvature between both arcs belongs to their common point
  if (course.file.carrier == "arcs") {
    const double nearest = std::clamp(given, low, high);
    return {std::abs(nearest - given) / scale, nearest};
  }
  return corner ? best : worst;
}

bool is_corner(const ContourFile& file, std::size_t point) {
  return std::any_of(file.elements.begin(), file.elements.end(),
                     [point](const FileElement& e) { return e.corner && e.source == point; });
}

struct GivenCounts {
  int headings = 0, curvatures = 0, corners = 0, heading_ranges = 0, curvature_ranges = 0;
  double heading_miss = 0.0, curvature_miss = 0.0;
};

constexpr double kLastDigits = 1.0 + 1e-6;

/// How far a value lies beyond a range.
double beyond(double value, const Ends& ends) {
  return std::max({0.0, ends.least - value, value - ends.greatest});
}

/// Headings that may be a whole turn away.
double turned_into(double heading, const Ends& ends) {
  const double middle = 0.5 * (ends.least + ends.greatest);
  return middle + std::remainder(heading - middle, 2.0 * std::numbers::pi);
}

/// A range that is given at a point: kept by the contour, and named when it lies at an end.
class RangeCheck {
 public:
  RangeCheck(const Course& course, const Json& active, Sheet& sheet)
      : course_(course), active_(active), sheet_(sheet) {}

  void headings(std::size_t point, const Ends& ends, double& worst) {
    const Sides sides = sides_at(course_, point);
    const std::string where = fmt::format("point {}", point + 1);
    if (sides.heading_kappa.empty())
      return sheet_.unjudged("given.heading_range", "no station", where);
    constexpr double kFar = std::numeric_limits<double>::max();
    double from_least = kFar, from_greatest = kFar;
    for (const auto& [heading, kappa] : sides.heading_kappa) {
      const double here = turned_into(heading, ends);
      sheet_.expect(beyond(here, ends) <= kGivenHeading * kLastDigits, "given.heading_range",
                    heading, here < ends.least ? ends.least : ends.greatest, where);
      worst = std::max(worst, beyond(here, ends));
      from_least = std::min(from_least, std::abs(here - ends.least));
      from_greatest = std::min(from_greatest, std::abs(here - ends.greatest));
    }
    named("heading", point, "least", from_least, kGivenHeading);
    named("heading", point, "greatest", from_greatest, kGivenHeading);
  }

  void kappas(std::size_t point, const Ends& ends, double& worst) {
    const Sides sides = sides_at(course_, point);
    const std::string where = fmt::format("point {}", point + 1);
    if (sides.heading_kappa.empty())
      return sheet_.unjudged("given.kappa_range", "no station", where);
    double low = std::numeric_limits<double>::max(), high = -low;
    for (const auto& [heading, kappa] : sides.heading_kappa) {
      low = std::min(low, kappa);
      high = std::max(high, kappa);
    }
    double value = beyond(low, ends) > beyond(high, ends) ? low : high;
    // arcs: any curvature between both belongs to their common point
    const bool arcs = course_.file.carrier == "arcs";
    if (arcs)
      value =
          std::clamp(0.5 * (std::max(low, ends.least) + std::min(high, ends.greatest)), low, high);
    const double end = value < ends.least ? ends.least : ends.greatest;
    const double past = beyond(value, ends);
    const double off = past > 0.0 ? past / scale_of(end, sides) : 0.0;
    sheet_.expect(off <= kGivenCurvature * kLastDigits, "given.kappa_range", value, end, where);
    worst = std::max(worst, off);
    if (arcs) return;
    for (const bool greatest : {false, true}) {
      const double at = greatest ? ends.greatest : ends.least;
      double away = std::numeric_limits<double>::max();
      for (const auto& [heading, kappa] : sides.heading_kappa) {
        away = std::min(away, std::abs(kappa - at));
      }
      if (away > 0.0) away = std::isfinite(at) ? away / scale_of(at, sides) : HUGE_VAL;
      named("curvature", point, greatest ? "greatest" : "least", away, kGivenCurvature);
    }
  }

 private:
  /// What curvatures are told apart by a part of: the end, or the largest around where it is 0.
  static double scale_of(double end, const Sides& sides) {
    return end != 0.0 ? std::abs(end) : sides.largest_kappa;
  }

  /// What lies at an end stands in the list, and nothing else; both do where rounding decides.
  void named(const char* datum, std::size_t point, const char* end, double away, double kept) {
    if (active_.is_null()) return;
    bool listed = false;
    for (const Json& one : active_) {
      listed = listed || (figure(one, "point").value == static_cast<double>(point) &&
                          text_of(one, "datum") == datum && text_of(one, "end") == end);
    }
    if (away > 0.5 * kept && away < 2.0 * kept) return;
    sheet_.expect(listed == (away <= kept), "given.active", std::string(listed ? "listed" : "not"),
                  fmt::format("{:.3g} away", away),
                  fmt::format("{} {} at point {}", end, datum, point + 1));
  }

  const Course& course_;
  const Json& active_;
  Sheet& sheet_;
};

/// Two numbers, null where a range has no end.
std::optional<Ends> listed_range(const Json& one, const char* name) {
  const Json& list = member(one, name);
  if (!list.is_array() || list.size() != 2) return std::nullopt;
  const double none = std::numeric_limits<double>::infinity();
  return Ends{list[0].is_number() ? list[0].real() : -none,
              list[1].is_number() ? list[1].real() : none};
}

bool same_range(const std::optional<Ends>& one, const std::optional<Ends>& other, bool turns) {
  if (!one || !other) return one.has_value() == other.has_value();
  constexpr double kSameText = 1e-12;
  const auto same = [&](double a, double b) {
    if (a == b) return true;
    const double off =
        turns ? std::abs(std::remainder(a - b, 2.0 * std::numbers::pi)) : std::abs(a - b);
    return off <= kSameText * (turns ? 1.0 : std::max(std::abs(a), std::abs(b)));
  };
  return same(one->least, other->least) && same(one->greatest, other->greatest);
}

/// One fixed point: met, or found false.
void check_datum(const Course& course, std::size_t i, const std::optional<double>& heading,
                 const std::optional<double>& kappa, GivenCounts& counts, Sheet& sheet) {
  const std::string where = fmt::format("point {}", i + 1);
  const Sides sides = sides_at(course, i);
  if (sides.heading_kappa.empty()) return sheet.unjudged("given.heading", "no station", where);
  const bool corner = is_corner(course.file, i);
  if (heading) {
    const Miss miss = heading_miss(sides, *heading, corner);
    sheet.expect(miss.off <= kGivenHeading * kLastDigits, "given.heading", miss.stated, *heading,
                 where);
    ++counts.headings;
    counts.heading_miss = std::max(counts.heading_miss, miss.off);
  }
  if (kappa) {
    const Miss miss = curvature_miss(course, sides, *kappa, corner);
    sheet.expect(miss.off <= kGivenCurvature * kLastDigits, "given.curvature", miss.stated, *kappa,
                 where);
    ++counts.curvatures;
    counts.curvature_miss = std::max(counts.curvature_miss, miss.off);
  }
}

/// What the file lists as given must be what was asked for.
void check_list(const ContourFile& file, const Expected& expected, Sheet& sheet) {
  std::vector<bool> heading(expected.points.size()), kappa(expected.points.size());
  std::vector<bool> ranged(expected.points.size());
  for (const Json& one : file.given) {
    const auto i = static_cast<std::size_t>(figure(one, "point").value.value_or(-1.0));
    if (i >= expected.points.size()) {
      sheet.fails("given", "point " + std::to_string(i), "no such point", "");
      continue;
    }
    const GivenPoint& p = expected.points[i];
    const Figure h = figure(one, "heading"), k = figure(one, "kappa");
    heading[i] = h.known();
    kappa[i] = k.known();
    constexpr double kSameText = 1e-12;
    const bool ok = (!h.known() ||
                     (p.heading && std::abs(std::remainder(*h.value - *p.heading,
                                                           2.0 * std::numbers::pi)) < kSameText)) &&
                    (!k.known() ||
                     (p.kappa && std::abs(*k.value - *p.kappa) <= kSameText * std::abs(*p.kappa)));
    const bool ranges = same_range(listed_range(one, "heading_range"), p.headings, true) &&
                        same_range(listed_range(one, "kappa_range"), p.kappas, false);
    ranged[i] = true;
    sheet.expect(ok && ranges, "given", std::string("listed"),
                 std::string("not what was asked for"), fmt::format("point {}", i + 1));
  }
  for (std::size_t i = 0; i < expected.points.size(); ++i) {
    const GivenPoint& p = expected.points[i];
    const bool listed = (!p.heading || heading[i]) && (!p.kappa || kappa[i]) &&
                        (!(p.headings || p.kappas) || ranged[i]);
    if (!listed) {
      sheet.fails("given", "not listed", "asked for", fmt::format("point {}", i + 1));
    }
  }
}

void check_given(const Course& course, const Expected& expected, Sheet& sheet) {
  GivenCounts counts;
  for (std::size_t i = 0; i < expected.points.size(); ++i) {
    const GivenPoint& p = expected.points[i];
    if (p.heading || p.kappa) check_datum(course, i, p.heading, p.kappa, counts, sheet);
    RangeCheck range(course, member(member(course.file.report, "given"), "active"), sheet);
    if (p.headings) range.headings(i, *p.headings, counts.heading_miss);
    if (p.kappas) range.kappas(i, *p.kappas, counts.curvature_miss);
    counts.heading_ranges += p.headings ? 1 : 0;
    counts.curvature_ranges += p.kappas ? 1 : 0;
  }
  if (!course.file.given.is_null()) return check_list(course.file, expected, sheet);
  const int ranges = counts.heading_ranges + counts.curvature_ranges;
  if (counts.headings + counts.curvatures + ranges > 0)
    sheet.missing("given", "list of what was fixed");
}

/// Corners that nobody marked are points where the series turns by the least angle: told of points
/// that are met exactly.
void check_corners(const Course& course, const Expected& expected, const Input& input,
                   Sheet& sheet) {
  const ContourFile& file = course.file;
  constexpr double kDefaultAngle = 20.0;  // degrees (docs/cli.md)
  constexpr double kNearly = 0.9;  // of lines and arcs, the points nearest to the corner decide
  const double least = input.corner_angle.value_or(kDefaultAngle) * std::numbers::pi / 180.0;
  const std::size_t n = expected.points.size();
  for (const FileElement& e : file.elements) {
    if (e.between) {  // of lines and arcs, where corners are searched
      const double turn =
          std::abs(std::remainder(e.heading_out - e.heading, 2.0 * std::numbers::pi));
      sheet.expect(input.primitives && input.searches_corners && turn >= kNearly * least,
                   "corners between", least, turn, fmt::format("point {}", e.between->first + 1));
    }
    if (!e.corner || !e.source || *e.source >= n || expected.points[*e.source].corner) continue;
    const std::string where = fmt::format("point {}", *e.source + 1);
    if (!input.searches_corners) {
      sheet.fails("corners", "a corner", "none was to be searched", where);
      continue;
    }
    if (!file.tolerance.empty()) continue;
    const auto at = [&](std::size_t i) {
      return seen(expected.points[i % n].point, course.origin);
    };
    const std::size_t i = *e.source + n;
    if (!file.closed && (*e.source == 0 || *e.source + 1 == n)) continue;
    const Vec in = at(i) - at(i - 1), out = at(i + 1) - at(i);
    const auto turn = static_cast<double>(std::abs(std::atan2(cross(in, out), dot(in, out))));
    sheet.expect(turn >= least * (1.0 - 1e-9), "corners", least, turn, where);
  }
}

void check_convex(const Course& course, Sheet& sheet) {
  double low = 0.0, high = 0.0;
  for (std::size_t i = 0; i < course.ends.start.size(); ++i) {
    for (const End* end : {&course.ends.start[i], &course.ends.end[i]}) {
      low = std::min(low, end->kappa.upper());
      high = std::max(high, end->kappa.lower());
    }
  }
  constexpr double kConvexRounding = 1e-9;
  const double most = std::max(-low, high);
  sheet.expect(std::min(-low, high) <= kConvexRounding * most, "convex",
               std::string("no inflection"),
               fmt::format("curvature from {:.6g} to {:.6g}", low, high), "");
}

}  // namespace

/// The list of given data in the file, and the report's line on them.
void check_given_list(const Course& course, Sheet& sheet) {
  GivenCounts counts;
  for (const Json& one : course.file.given) {
    const auto i = static_cast<std::size_t>(figure(one, "point").value.value_or(0.0));
    check_datum(course, i, figure(one, "heading").value, figure(one, "kappa").value, counts, sheet);
    counts.corners += flag(one, "corner").value_or(false) ? 1 : 0;
  }
  const Json& report = member(course.file.report, "given");
  RangeCheck range(course, member(report, "active"), sheet);
  for (const Json& one : course.file.given) {
    const auto i = static_cast<std::size_t>(figure(one, "point").value.value_or(0.0));
    const auto headings = listed_range(one, "heading_range");
    const auto kappas = listed_range(one, "kappa_range");
    if (headings) range.headings(i, *headings, counts.heading_miss);
    if (kappas) range.kappas(i, *kappas, counts.curvature_miss);
    counts.heading_ranges += headings ? 1 : 0;
    counts.curvature_ranges += kappas ? 1 : 0;
  }
  if (report.is_null()) return;
  const auto count = [&](const char* name, int found) {
    sheet.expect(figure(report, name).value == found, std::string("report.given.") + name,
                 figure(report, name).value.value_or(-1.0), found, "in the list");
  };
  count("headings", counts.headings);
  count("curvatures", counts.curvatures);
  count("corners", counts.corners);
  if (counts.heading_ranges + counts.curvature_ranges > 0) {
    count("heading_ranges", counts.heading_ranges);
    count("curvature_ranges", counts.curvature_ranges);
  }
  const auto miss = [&](const char* name, double found) {
    constexpr double kNoise = 1e-15;  // the list's own last digits
    const double stated = figure(report, name).value.value_or(0.0);
    sheet.expect(stated >= found * (1.0 - 1e-6) - kNoise, std::string("report.given.") + name,
                 stated, found, "");
  };
  miss("heading_miss", counts.heading_miss);
  miss("curvature_miss", counts.curvature_miss);
}

void check_input(const Course& course, const Input& input, Sheet& sheet) {
  const ContourFile& file = course.file;
  const Expected expected = expected_of(input, file);
  sheet.expect(file.units == input.units, "units", file.units, input.units, "");
  // the user says the unit, or names of columns do, or nobody does (docs/formats.md)
  const std::string source = input.units_given ? "given" : input.units_in_file ? "file" : "assumed";
  sheet.expect(file.units_source == source, "units_source", file.units_source, source, "");
  sheet.expect(file.carrier == input.carrier, "carrier", file.carrier, input.carrier, "");
  sheet.expect(file.closed == expected.closed, "closed", file.closed ? "true" : "false",
               expected.closed ? "true" : "false", "");
  if (file.closed != expected.closed) return;
  check_points(course, expected, input, sheet);
  if (file.points.size() == expected.points.size()) check_given(course, expected, sheet);
  check_corners(course, expected, input, sheet);
  if (input.convex) check_convex(course, sheet);
  if (input.continuity == "G2") {
    sheet.expect(file.continuity == "G2", "continuity", file.continuity, input.continuity, "");
  }
  const Figure tolerance = figure(file.report, "tolerance");
  if (!tolerance.known()) return;
  if (input.tolerance) {
    sheet.expect(*tolerance.value == *input.tolerance, "report.tolerance", *tolerance.value,
                 *input.tolerance, "as asked for");
    return;
  }
  double lx = 1e308, ly = 1e308, hx = -1e308, hy = -1e308;
  for (const Point p : file.points) {
    lx = std::min(lx, p.x);
    ly = std::min(ly, p.y);
    hx = std::max(hx, p.x);
    hy = std::max(hy, p.y);
  }
  const double found = kDefaultTolerance * std::hypot(hx - lx, hy - ly);
  sheet.expect(std::abs(*tolerance.value - found) <= 1e-9 * found, "report.tolerance",
               *tolerance.value, found, "3e-6 of the size");
}

void judge_constructed(const Course& course, Input input, Sheet& sheet) {
  const ContourFile& file = course.file;
  // nothing is refined: the largest width itself, where that is more than the tolerance
  const Figure width = figure(file.report, "largest_width"),
               tolerance = figure(file.report, "tolerance");
  if (width.known() && width.value == tolerance.value) input.tolerance = width.value;
  check_form(course, sheet);
  check_certificate(course, sheet);
  check_given_list(course, sheet);
  const auto on_point = [](const FileElement& e) { return e.source.has_value(); };
  const bool steps = std::any_of(file.elements.begin(), file.elements.end(),
                                 [](const FileElement& e) { return e.step && !e.source; });
  const auto segments = std::count_if(
      file.elements.begin(),
      file.elements.begin() + static_cast<std::ptrdiff_t>(file.pieces.size()), on_point);
  const bool whole =
      input.construction == "arcs" && file.pieces.size() < 2 * static_cast<std::size_t>(segments);
  if (steps || whole) {  // at an inflection, the way the run goes; an arc alone has one curvature
    sheet.unjudged("report", steps ? "the curvature steps inside of segments" : "one arc");
  } else {
    check_report(course, sheet);
  }
  check_input(course, input, sheet);
}

}  // namespace judge
