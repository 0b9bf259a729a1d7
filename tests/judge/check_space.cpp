// SPDX-License-Identifier: Apache-2.0
// A curve in space against its own two contours: docs/methods/judge.md.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "checks.h"
#include "command_checks.h"
#include "sentences.h"

namespace judge {
namespace {

constexpr int kPlacesBetweenJoints = 32;  // docs/formats.md: torsion_places
constexpr Real kCurvatureRounding = 1e-9L;

/// Least eigenvalue of the matrix of second moments about the middle, by Jacobi's rotations.
Real least_moment(const std::vector<Vec3>& points) {
  Vec3 middle;
  for (const Vec3& p : points) middle = middle + p;
  middle = (1.0L / static_cast<Real>(points.size())) * middle;
  std::array<std::array<Real, 3>, 3> m{};
  for (const Vec3& p : points) {
    const Vec3 d = p - middle;
    const std::array<Real, 3> v = {d.x, d.y, d.z};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) m[i][j] += v[i] * v[j];
    }
  }
  constexpr int kSweeps = 40;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t p = 0; p < 3; ++p) {
      const std::size_t q = (p + 1) % 3;
      if (m[p][q] == 0.0L) continue;
      const Real angle = 0.5L * std::atan2(2.0L * m[p][q], m[q][q] - m[p][p]);
      const Real c = std::cos(angle), s = std::sin(angle);
      for (std::size_t k = 0; k < 3; ++k) {
        const Real a = m[k][p], b = m[k][q];
        m[k][p] = c * a - s * b;
        m[k][q] = s * a + c * b;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const Real a = m[p][k], b = m[q][k];
        m[p][k] = c * a - s * b;
        m[q][k] = s * a + c * b;
      }
    }
  }
  return std::min({m[0][0], m[1][1], m[2][2]});
}

struct TorsionPlaces {
  long count = 0;
  Real least = std::numeric_limits<Real>::max(), largest = -std::numeric_limits<Real>::max();
  Real step = 0.0L;
  Real blur = 0.0L;    ///< how much these are rounding
  Real change = 0.0L;  ///< over a length that joints are known to
};

class SpaceCheck {
 public:
  SpaceCheck(const SpaceCourse& curve, const Json& json, Sheet& sheet, bool part)
      : c_(curve), json_(json), sheet_(sheet), part_(part) {}

  void run() {
    frame();
    judge_course(c_.plan->course, sheet_);
    if (c_.heights) judge_course(c_.heights->course, sheet_);
    parts();
    if (c_.planar) {
      plane();
    } else {
      heights();
      curvature();
      torsion();
    }
    moves();
    nurbs();
  }

 private:
  void expect(bool ok, const char* claim, Real stated, Real found, const std::string& where = "") {
    sheet_.expect(ok, claim, stated, found, where);
  }
  Real figure_of(const char* name) {
    const Figure f = figure(json_, name);
    if (!f.known()) sheet_.fails(fmt::format("space.{}", name), "a figure", "none", "");
    return f.value.value_or(std::numeric_limits<double>::quiet_NaN());
  }

  void frame() {
    const SpaceFrame& f = c_.frame;
    const Real off = std::max({std::abs(norm(f.x) - 1.0L), std::abs(norm(f.y) - 1.0L),
                               std::abs(dot(f.x, f.y)), norm(cross(f.x, f.y) - f.normal)});
    expect(off <= 1e-14L, "space.frame", 0.0L, off, "unit vectors, right-handed");
  }

  /// Both contours are those of the points.
  void parts() {
    const std::vector<Point>& flat = c_.plan->file.points;
    const bool last_is_first = c_.plan->file.closed && flat.size() + 1 == c_.points.size();
    if (flat.size() != c_.points.size() && !last_is_first) {
      return sheet_.fails("space.points", std::to_string(c_.points.size()),
                          std::to_string(flat.size()), "points of the projection");
    }
    for (std::size_t i = 0; i < flat.size(); ++i) {
      const Vec p = c_.frame.in_plane(c_.points[i]);
      const Real off = norm(p - Vec{flat[i].x, flat[i].y});
      expect(off <= c_.resolution(), "space.points", 0.0L, off, fmt::format("point {}", i + 1));
    }
    for (const OwnedCourse* part : {c_.plan.get(), c_.heights.get()}) {
      if (part == nullptr) continue;
      sheet_.expect(part->file.units == c_.units, "space.units", c_.units, part->file.units, "");
    }
  }

  void plane() {
    Real largest = 0.0L, squares = 0.0L;
    for (const Vec3& p : c_.points) {
      const Real h = c_.frame.height(p);
      largest = std::max(largest, std::abs(h));
      squares += h * h;
    }
    const Real stated = figure_of("flatness"), near = c_.resolution();
    expect(std::abs(stated - largest) <= near, "space.flatness", stated, largest);
    if (part_) {
      for (const Vec3& end : {c_.points.front(), c_.points.back()}) {
        const Real off = std::abs(c_.frame.height(end));
        expect(off <= near, "space.plane", 0.0L, off, "plane through both ends");
      }
      return;
    }
    // the plane of least squares, though rounding decides where all but lie in it
    const Real best = std::sqrt(std::max(0.0L, least_moment(c_.points)));
    const Real most = best * (1.0L + 1e-6L) + near * std::sqrt(Real(c_.points.size()));
    expect(std::sqrt(squares) <= most, "space.plane", std::sqrt(squares), best,
           "plane of least squares");
  }

  /// The second contour stands on the arc length of the first.
  void heights() {
    const OwnedCourse& up = *c_.heights;
    expect(figure_of("flatness") == 0.0L, "space.flatness", 0.0L, figure_of("flatness"));
    if (up.file.points.size() < c_.points.size()) {
      return sheet_.fails("space.heights", std::to_string(c_.points.size()),
                          std::to_string(up.file.points.size()), "points of the heights");
    }
    const Real whole = c_.plan->lengths.whole();
    const std::size_t count = c_.plan->file.points.size() + (c_.plan->file.closed ? 1 : 0);
    if (up.file.points.size() != count) {
      return sheet_.fails("space.heights", std::to_string(count),
                          std::to_string(up.file.points.size()), "points of the heights");
    }
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = c_.point_below(k);
      const Real high = c_.frame.height(c_.points[i]);
      expect(std::abs(high - up.file.points[k].y) <= c_.resolution(), "space.heights.height",
             up.file.points[k].y, high, fmt::format("point {}", i + 1));
      // so far along the projection lies what the point stands for
      const Real far = up.file.points[k].x;
      if (c_.plan->file.closed && k + 1 == count) {
        expect(std::abs(far - whole) <= 1e-11L * whole, "space.heights.length", far, whole, "turn");
      }
      expect(far >= -1e-11L * whole && far <= (1.0L + 1e-11L) * whole, "space.heights.length", far,
             whole, fmt::format("point {}", i + 1));
      const Place place = c_.plan->lengths.place(far, false);
      const Vec at = c_.plan->course.path.spans()[place.span].point(place.t);
      const Real off = norm(at - seen(c_.plan->file.points[i], c_.plan->course.origin));
      const Real most = figure_of("largest_move");
      expect(off <= most + 1e-10L * whole + c_.resolution(), "space.heights.length", most, off,
             fmt::format("point {}", i + 1));
    }
    const Vec end = up.course.path.at(up.course.path.end());
    const Real last = end.x + up.course.origin.x;
    expect(std::abs(last - whole) <= 1e-10L * whole, "space.heights.length", whole, last, "end");
    if (c_.plan->file.closed) seam();
  }

  /// Where a closed curve ends it begins: as a curve in space, not as two contours.
  void seam() {
    const SpaceJet end = c_.at(c_.heights->course.path.end(), true), begin = c_.at(0.0L, false);
    const Json& stated = member(json_, "seam");
    for (const char* name : {"position", "heading", "curvature"}) {
      const Figure f = figure(stated, name);
      const Real most = name[0] == 'p' ? 1e-10L : 1e-6L;
      expect(f.known() && std::abs(*f.value) <= most, fmt::format("space.seam.{}", name).c_str(),
             f.value.value_or(-1.0), most);
    }
    expect(norm(end.p - begin.p) <= c_.resolution(), "space.seam", 0.0L, norm(end.p - begin.p),
           "place");
    const auto unit = [](Vec3 v) { return (1.0L / norm(v)) * v; };
    const Real turn = norm(unit(end.d) - unit(begin.d));
    expect(turn <= 2e-6L, "space.seam", 0.0L, turn, "tangent");
    const auto bend = [&](const SpaceJet& jet) {
      const Vec3 t = unit(jet.d);
      return (1.0L / dot(jet.d, jet.d)) * (jet.dd - dot(jet.dd, t) * t);
    };
    const Real step = norm(bend(end) - bend(begin)), scale = figure_of("largest_curvature");
    expect(step <= 4e-6L * scale, "space.seam", 0.0L, step, "curvature");
    const Real apart = norm(c_.nurbs.at(c_.nurbs.from()).p - c_.nurbs.at(c_.nurbs.to()).p);
    expect(apart <= c_.resolution(), "space.seam", 0.0L, apart, "NURBS curve");
  }

  void curvature() {
    const Real least = figure_of("least_curvature"), largest = figure_of("largest_curvature");
    Real low = std::numeric_limits<Real>::max(), high = 0.0L, low_at = 0.0L, high_at = 0.0L;
    constexpr int kLooks = 96;
    const std::vector<Real> joints = c_.joints();
    for (std::size_t k = 0; k + 1 < joints.size(); ++k) {
      for (int j = 0; j <= kLooks; ++j) {
        const Real order = joints[k] + (joints[k + 1] - joints[k]) * j / kLooks;
        const Real here = c_.at(order, j == kLooks).curvature();
        if (here < low) low = here, low_at = order;
        if (here > high) high = here, high_at = order;
      }
    }
    const Real blur = kCurvatureRounding * high;
    expect(least <= low + blur, "space.least_curvature", least, low,
           fmt::format("order {:.6Lf}", low_at));
    expect(largest >= high - blur, "space.largest_curvature", largest, high,
           fmt::format("order {:.6Lf}", high_at));
  }

  /// Order of the unrolled contour at an arc length.
  [[nodiscard]] Real order_at(Real length, bool before) const {
    const Place place = c_.heights->lengths.place(length, before);
    return static_cast<Real>(place.span) + place.t;
  }

  TorsionPlaces torsion_places() const {
    TorsionPlaces out;
    const std::vector<Real> joints = c_.joints();
    const Lengths& along = c_.heights->lengths;
    const auto look = [&](Real order, bool before) {
      const SpaceJet jet = c_.at(order, before);
      const Real value = jet.torsion();
      if (!std::isfinite(value)) return std::optional<Real>();
      out.least = std::min(out.least, value);
      out.largest = std::max(out.largest, value);
      // near a straight place the torsion is a quotient of small numbers
      const Real bend = jet.curvature();
      out.blur = std::max(
          out.blur,
          1e-9L * (std::abs(value) + norm(jet.ddd) / (norm(jet.d) * norm(jet.d) * norm(jet.d)) /
                                         std::max(bend, 1e-300L)));
      const Real step = std::min(1e-3L, 1e-11L * along.whole() / norm(jet.d));
      const Real beside = c_.at(before ? order - step : order + step, before).torsion();
      if (std::isfinite(beside)) out.change = std::max(out.change, std::abs(beside - value));
      return std::optional(value);
    };
    std::optional<Real> last;
    for (std::size_t k = 0; k + 1 < joints.size(); ++k) {
      const Real a = along.of(joints[k]), b = along.of(joints[k + 1]);
      for (int j = 0; j <= kPlacesBetweenJoints; ++j) {
        const bool end = j == kPlacesBetweenJoints;
        const Real order = j == 0 ? joints[k]
                           : end  ? joints[k + 1]
                                  : order_at(a + (b - a) * j / kPlacesBetweenJoints, false);
        last = look(order, end);
      }
      out.count += 2L * kPlacesBetweenJoints;
      const bool whole = k + 2 == joints.size();
      if (whole && !c_.plan->file.closed) continue;
      const auto next = look(whole ? joints.front() : joints[k + 1], false);
      if (last && next) out.step = std::max(out.step, std::abs(*next - *last));
    }
    if (out.least > out.largest) out.least = out.largest = 0.0L;  // straight: it has none
    return out;
  }

  void torsion() {
    const TorsionPlaces found = torsion_places();
    const Real scale = std::max(std::abs(found.least), std::abs(found.largest));
    const Real near = 1e-6L * scale + 1e3L * found.blur + found.change;
    const Figure places = figure(json_, "torsion_places");
    expect(places.known() && static_cast<long>(*places.value) == found.count,
           "space.torsion_places", places.value.value_or(-1.0), static_cast<Real>(found.count));
    for (const auto& [name, value] :
         {std::pair{"least_torsion", found.least}, std::pair{"largest_torsion", found.largest},
          std::pair{"torsion_step", found.step}}) {
      const Real stated = figure_of(name);
      expect(std::abs(stated - value) <= near, fmt::format("space.{}", name).c_str(), stated,
             value);
    }
  }

  /// No point is farther from the curve than this.
  void moves() {
    const Real stated = figure_of("largest_move");
    for (std::size_t i = 0; i < c_.points.size(); ++i) {
      Real away = 0.0L;
      if (c_.planar) {
        const Vec p = c_.frame.in_plane(c_.points[i]) -
                      Vec{c_.plan->course.origin.x, c_.plan->course.origin.y};
        away = std::hypot(c_.plan->course.path.nearest(p).distance, c_.frame.height(c_.points[i]));
      } else {
        away = from_curve(i);
      }
      expect(away <= stated + c_.resolution(), "space.largest_move", stated, away,
             fmt::format("point {}", i + 1));
    }
  }

  [[nodiscard]] Real from_curve(std::size_t i) const {
    const OwnedCourse& up = *c_.heights;
    const Path& path = up.course.path;
    const Real guess =
        path.nearest(seen(up.file.points[c_.height_of(i)], up.course.origin)).order();
    const auto nearness = [&](Real order) { return -norm(c_.at(order, false).p - c_.points[i]); };
    const Real from = std::max(0.0L, guess - 0.25L), to = std::min(path.end(), guess + 0.25L);
    return std::min(-nearness(guess), -nearness(largest_place(nearness, from, to, 8)));
  }

  void nurbs() {
    if (const std::string fault = c_.nurbs.fault(); !fault.empty()) {
      return sheet_.fails("space.curve", "a NURBS curve", fault, "");
    }
    const Figure stated = figure(member(json_, "curve"), "deviation");
    if (!stated.known()) return sheet_.fails("space.curve.deviation", "a figure", "none", "");
    const Real most = *stated.value + c_.resolution();
    constexpr std::size_t kPlaces = 1500;
    std::size_t spans = 0;
    for (std::size_t k = 0; k + 1 < c_.nurbs.knots.size(); ++k) {
      spans += c_.nurbs.knots[k] < c_.nurbs.knots[k + 1] ? 1 : 0;
    }
    const std::size_t per = std::max<std::size_t>(3, kPlaces / spans);
    Real largest = 0.0L, at = 0.0L;
    for (std::size_t k = 0; k + 1 < c_.nurbs.knots.size(); ++k) {
      const Real a = c_.nurbs.knots[k], b = c_.nurbs.knots[k + 1];
      for (std::size_t j = 0; a < b && j <= per; ++j) {
        const Real u = a + (b - a) * static_cast<Real>(j) / static_cast<Real>(per);
        const Real off = from_nurbs(u);
        if (off > largest) largest = off, at = u;
      }
    }
    expect(largest <= most, "space.curve.deviation", *stated.value, largest,
           fmt::format("u = {:.6Lg}", at));
    for (const bool last : {false, true}) {
      const Real off = norm(c_.nurbs.at(last ? c_.nurbs.to() : c_.nurbs.from()).p - end(last));
      expect(off <= most, "space.curve.ends", *stated.value, off, last ? "end" : "start");
    }
  }

  [[nodiscard]] Vec3 end(bool last) const {
    if (!c_.planar) return c_.at(last ? c_.heights->course.path.end() : 0.0L, last).p;
    const Path& path = c_.plan->course.path;
    const Vec p = path.at(last ? path.end() : 0.0L);
    return c_.frame.at(p + Vec{c_.plan->course.origin.x, c_.plan->course.origin.y});
  }

  /// Of a place of the NURBS curve: a planar one from the nearest place, others from the place at
  /// the same arc length, or the nearest around it.
  [[nodiscard]] Real from_nurbs(Real u) const {
    const Vec3 p = c_.nurbs.at(u).p;
    if (c_.planar) {
      const Vec flat =
          c_.frame.in_plane(p) - Vec{c_.plan->course.origin.x, c_.plan->course.origin.y};
      return std::hypot(c_.plan->course.path.nearest(flat).distance, c_.frame.height(p));
    }
    return norm(c_.at(order_at(u, u >= c_.nurbs.to()), u >= c_.nurbs.to()).p - p);
  }

  const SpaceCourse& c_;
  const Json& json_;
  Sheet& sheet_;
  bool part_;
};

}  // namespace

void check_space(const SpaceCourse& curve, const Json& json, Sheet& sheet, bool part) {
  SpaceCheck(curve, json, sheet, part).run();
}

void check_space_input(const SpaceCourse& curve, const std::vector<Vec3>& points,
                       const std::optional<Vec3>& along, Sheet& sheet) {
  sheet.expect(points.size() == curve.points.size(), "space.points as read",
               static_cast<Real>(points.size()), static_cast<Real>(curve.points.size()), "");
  for (std::size_t i = 0; i < std::min(points.size(), curve.points.size()); ++i) {
    const Real off = norm(points[i] - curve.points[i]);
    sheet.expect(off == 0.0L, "space.points as read", 0.0L, off, fmt::format("point {}", i + 1));
  }
  if (!along) return;
  const Real off = norm(cross(*along, curve.frame.normal)) / norm(*along);
  sheet.expect(off <= 1e-14L, "space.along", 0.0L, off, "");
  sheet.expect(!curve.planar, "space.along", "a curve in space", "planar", "");
}

namespace {

bool same_figure(const std::string& printed, Real value) {
  return printed == "-" || prints(printed, static_cast<double>(value));
}

/// The joint that stands on a point, or the nearest place.
Real order_of_point(const OwnedCourse& part, std::size_t i) {
  for (std::size_t k = 0; k < part.file.elements.size(); ++k) {
    if (part.file.elements[k].source == i) return static_cast<Real>(k);
  }
  return part.course.path.nearest(seen(part.file.points[i], part.course.origin)).order();
}

/// Figures of a text in order, signs and exponents with them.
std::vector<std::string> figures_of(const std::string& text) {
  return sentence_of(text, "").figures;
}

}  // namespace

void check_space_text(const SpaceCourse& curve, const Json& json, const std::string& text,
                      Sheet& sheet) {
  const auto value = [&](const char* name) { return figure(json, name).value.value_or(0.0); };
  if (curve.planar) return;  // its report is that of a contour
  const auto figures = [&](const std::string& line, const char* claim,
                           const std::vector<Real>& wanted) {
    const std::vector<std::string> found = figures_of(line);
    if (found.size() < wanted.size()) return sheet.fails(claim, line, "too few figures", "");
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      sheet.expect(same_figure(found[i], wanted[i]), claim, found[i],
                   fmt::format("{:.8Lg}", wanted[i]), line);
    }
  };
  const auto count = [](const OwnedCourse& part, const char* name) {
    return static_cast<Real>(
        figure(member(part.file.report, "report"), name)
            .value.value_or(figure(part.file.report, name).value.value_or(0.0)));
  };
  std::size_t rows = 0, facts = 0;
  for (const std::string& line : lines_of(text)) {
    const auto fact = fact_of(line);
    const std::vector<std::string> words = words_of(line);
    const std::size_t i = rows;
    if (words.size() >= 8 && i < curve.points.size() && words[0] == std::to_string(i + 1)) {
      ++rows;
      const Vec3& p = curve.points[i];
      const OwnedCourse& up = *curve.heights;
      const Real at = order_of_point(up, curve.height_of(i));
      const bool seam = curve.plan->file.closed && at == 0.0L;
      const SpaceJet before = seam ? curve.at(up.course.path.end(), true) : curve.at(at, at > 0.0L),
                     after = curve.at(at, at >= up.course.path.end());
      const Vec unrolled = up.course.path.at(at) + Vec{up.course.origin.x, up.course.origin.y};
      const std::vector<Real> wanted = {p.x, p.y, p.z, unrolled.x, unrolled.y, after.curvature()};
      for (std::size_t k = 0; k < wanted.size(); ++k) {
        const bool zero = std::abs(wanted[k]) < 1e-5L * curve.size && k < 5;
        sheet.expect(zero || same_figure(words[k + 1], wanted[k]), "text: row of a point in space",
                     words[k + 1], fmt::format("{:.8Lg}", wanted[k]), line);
      }
      const bool two = words.size() >= 10;
      for (const auto& [word, jet] :
           {std::pair{words[7], &before}, std::pair{two ? words[9] : words[7], &after}}) {
        const Real torsion = jet->torsion();
        const Real blur = 1e-9L / std::max(jet->curvature() * curve.size, 1e-30L);
        const bool known =
            std::isfinite(torsion) && blur < 1e-4L && std::abs(torsion) > 1e-9L / curve.size;
        sheet.expect(!known || same_figure(word, torsion), "text: torsion at a point", word,
                     fmt::format("{:.8Lg}", torsion), line);
      }
      continue;
    }
    if (!fact) continue;
    if (fact->label == "curvature") {
      ++facts;
      figures(fact->value, "text: curvature in space",
              {value("least_curvature"), value("largest_curvature")});
    } else if (fact->label == "torsion") {
      ++facts;
      const std::vector<std::string> found = figures_of(fact->value);
      figures(fact->value, "text: torsion", {value("least_torsion"), value("largest_torsion")});
      sheet.expect(fact->value.find(fmt::format("at {} places", value("torsion_places"))) !=
                       std::string::npos,
                   "text: torsion", fact->value, fmt::format("{}", value("torsion_places")), "");
      sheet.expect(!found.empty() && same_figure(found.back(), value("torsion_step")),
                   "text: torsion", found.empty() ? "" : found.back(),
                   fmt::format("{}", value("torsion_step")), "steps");
    } else if (fact->label == "projection" || fact->label == "heights") {
      ++facts;
      const OwnedCourse& part = fact->label == "heights" ? *curve.heights : *curve.plan;
      figures(fact->value, "text: projection and heights",
              {static_cast<Real>(part.file.pieces.size()), count(part, "vertices"),
               count(part, "vertices_lower_bound"), count(part, "inflections")});
    } else if (fact->label == "largest move") {
      figures(fact->value, "text: largest move", {value("largest_move")});
    }
  }
  sheet.expect(rows == curve.points.size(), "text: row of a point in space",
               static_cast<Real>(curve.points.size()), static_cast<Real>(rows), "rows");
  sheet.expect(facts == 4, "text: facts of a curve in space", 4.0L, static_cast<Real>(facts), "");
}

std::vector<std::vector<std::optional<Real>>> csv_rows(const std::string& text,
                                                       std::string& names) {
  std::vector<std::vector<std::optional<Real>>> out;
  std::vector<std::string> lines = lines_of(text);
  while (!lines.empty() && lines.back().empty()) lines.pop_back();
  names = lines.empty() ? "" : lines.front();
  for (std::size_t i = 1; i < lines.size(); ++i) {
    out.emplace_back();
    for (const std::string& cell : split(lines[i], ",")) {
      out.back().push_back(cell.empty() ? std::nullopt
                                        : std::optional(std::strtold(cell.c_str(), nullptr)));
    }
  }
  return out;
}

void check_space_samples(const SpaceCourse& curve, const std::string& text, std::size_t count,
                         bool points_only, Sheet& sheet) {
  std::string names = "x,y,z";
  std::vector<std::vector<std::optional<Real>>> rows;
  if (points_only) {
    for (const std::string& line : lines_of(text)) {
      if (line.empty()) continue;
      rows.emplace_back();
      for (const std::string& word : words_of(line)) {
        rows.back().emplace_back(std::strtold(word.c_str(), nullptr));
      }
    }
  } else {
    rows = csv_rows(text, names);
    sheet.expect(names == "s,x,y,z,curvature,torsion", "space samples", names, "", "names");
  }
  const char* claim = points_only ? "space points file" : "space samples";
  sheet.expect(rows.size() == count, claim, static_cast<Real>(count),
               static_cast<Real>(rows.size()), "rows");
  const Lengths& along = curve.planar ? curve.plan->lengths : curve.heights->lengths;
  const std::size_t shift = points_only ? 0 : 1;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto& row = rows[k];
    const std::string where = fmt::format("row {}", k + 1);
    if (row.size() < 3 + shift || !row[shift] || !row[shift + 1] || !row[shift + 2]) {
      sheet.fails(claim, "a place", "an empty cell", where);
      continue;
    }
    const bool last = k + 1 == rows.size();
    const Real s = along.whole() * static_cast<Real>(k) / static_cast<Real>(rows.size() - 1);
    if (!points_only) {
      const Real stated = row[0].value_or(-1.0L);
      sheet.expect(std::abs(stated - s) <= 1e-10L * along.whole(), "space samples.s", stated, s,
                   where);
    }
    const Place place = along.place(s, last);
    const Vec3 p{*row[shift], *row[shift + 1], *row[shift + 2]};
    if (curve.planar) {
      const Course& plan = curve.plan->course;
      const Jet jet = plan.path.spans()[place.span].at(place.t);
      const Real off = norm(curve.frame.at(jet.p + Vec{plan.origin.x, plan.origin.y}) - p);
      sheet.expect(off <= curve.resolution() + 1e-10L * along.whole(), claim, 0.0L, off, where);
      if (points_only || plan.file.carrier == "arcs") continue;
      const Real stated = row[4].value_or(-1.0L), kappa = std::abs(jet.kappa());
      const bool corner = place.t < 1e-9L || place.t > 1.0L - 1e-9L;
      sheet.expect(corner || std::abs(stated - kappa) <= 1e-6L * kappa + 1e-9L / curve.size,
                   "space samples.curvature", stated, kappa, where);
      sheet.expect(row[5] == 0.0L, "space samples.torsion", row[5].value_or(-1.0L), 0.0L, where);
      continue;
    }
    const Real order = static_cast<Real>(place.span) + place.t;
    const SpaceJet jet = curve.at(order, last);
    const Real off = norm(jet.p - p);
    sheet.expect(off <= curve.resolution() + 1e-10L * along.whole(), claim, 0.0L, off, where);
    if (points_only) continue;
    const Real stated = row[4].value_or(-1.0L), bend = jet.curvature();
    sheet.expect(std::abs(stated - bend) <= 1e-6L * bend + 1e-9L / curve.size,
                 "space samples.curvature", stated, bend, where);
    const Real turn = jet.torsion();
    // torsion steps at joints, and is a quotient of small numbers where the curve is straight
    const bool joint = place.t < 1e-6L || place.t > 1.0L - 1e-6L;
    if (joint || !row[5] || !std::isfinite(turn) || bend * curve.size < 1e-4L) continue;
    const Real before = curve.at(order - 1e-7L, false).torsion();
    const Real blur = 10.0L * std::abs(before - turn);
    sheet.expect(std::abs(*row[5] - turn) <= 1e-6L * std::abs(turn) + blur + 1e-7L / curve.size,
                 "space samples.torsion", *row[5], turn, where);
  }
}

namespace {

/// Numbers of one kind of group of a DXF spline.
struct SplineTags {
  std::vector<Real> knots, weights, x, y, z;
  int degree = 0;
};

std::vector<SplineTags> dxf_splines(const std::string& text) {
  std::vector<SplineTags> out;
  const std::vector<std::string> lines = lines_of(text);
  bool inside = false;
  for (std::size_t i = 0; i + 1 < lines.size(); i += 2) {
    const int code = std::atoi(lines[i].c_str());
    const std::vector<std::string> words = words_of(lines[i + 1]);
    const std::string value = words.empty() ? "" : words[0];
    if (code == 0) {
      inside = value == "SPLINE";
      if (inside) out.emplace_back();
    }
    if (!inside) continue;
    const Real number = std::strtold(value.c_str(), nullptr);
    SplineTags& tags = out.back();
    if (code == 71) tags.degree = static_cast<int>(number);
    if (code == 40) tags.knots.push_back(number);
    if (code == 41) tags.weights.push_back(number);
    if (code == 10) tags.x.push_back(number);
    if (code == 20) tags.y.push_back(number);
    if (code == 30) tags.z.push_back(number);
  }
  return out;
}

}  // namespace

std::vector<SpaceNurbs> dxf_curves(const std::string& text) {
  std::vector<SpaceNurbs> out;
  for (const SplineTags& one : dxf_splines(text)) {
    SpaceNurbs read{one.degree, one.knots, one.weights, {}};
    const std::size_t n = std::min({one.x.size(), one.y.size(), one.z.size()});
    for (std::size_t i = 0; i < n; ++i) read.points.push_back({one.x[i], one.y[i], one.z[i]});
    if (read.weights.empty()) read.weights.assign(n, 1.0L);
    out.push_back(std::move(read));
  }
  return out;
}

void check_space_curves(const std::vector<const SpaceNurbs*>& curves,
                        const std::vector<SpaceNurbs>& found, const std::string& name,
                        const std::string& claim, Sheet& sheet) {
  if (found.size() != curves.size()) {
    return sheet.fails(claim, std::to_string(curves.size()), std::to_string(found.size()),
                       name + ": curves");
  }
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const SpaceNurbs &nurbs = *curves[k], &read = found[k];
    const std::size_t n = nurbs.points.size();
    if (read.degree != nurbs.degree || read.points.size() != n ||
        read.knots.size() != nurbs.knots.size() || read.weights.size() != n) {
      sheet.fails(claim, "the numbers of the curve", "others", name);
      continue;
    }
    const Real allowed =
        4e-15L * largest_coordinate(nurbs.points) + 1e-12L * extent_of(nurbs.points);
    Real worst = 0.0L;
    constexpr int kPlaces = 200;
    for (int j = 0; j <= kPlaces; ++j) {
      const Real t = static_cast<Real>(j) / kPlaces;
      const Real at = nurbs.from() + t * (nurbs.to() - nurbs.from()),
                 there = read.from() + t * (read.to() - read.from());
      worst = std::max(worst, norm(nurbs.at(at).p - read.at(there).p));
    }
    sheet.expect(worst <= allowed, claim, 0.0L, worst, name);
  }
}

void check_space_spline(const SpaceNurbs& nurbs, const std::string& name, const std::string& text,
                        const std::string& claim, Sheet& sheet) {
  check_space_curves({&nurbs}, dxf_curves(text), name, claim, sheet);
}

}  // namespace judge
