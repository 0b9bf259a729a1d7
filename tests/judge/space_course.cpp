// SPDX-License-Identifier: Apache-2.0
#include "space_course.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace judge {
namespace {

// Gauss-Legendre on [-1, 1], 5 points (Abramowitz and Stegun, table 25.4).
constexpr std::array<Real, 3> kFive = {0.0L, 0.53846931010568309103631442070020880497L,
                                       0.90617984593866399279762687829939296513L};
constexpr std::array<Real, 3> kFiveWeight = {0.56888888888888888888888888888888888889L,
                                             0.47862867049936646804129151483563819291L,
                                             0.23692688505618908751426404071991736264L};

Real speed_between(const Span& span, Real a, Real b) {
  const Real middle = 0.5L * (a + b), half = 0.5L * (b - a);
  Real sum = kFiveWeight[0] * norm(span.at(middle).d);
  for (std::size_t j = 1; j < kFive.size(); ++j) {
    sum += kFiveWeight[j] *
           (norm(span.at(middle - half * kFive[j]).d) + norm(span.at(middle + half * kFive[j]).d));
  }
  return half * sum;
}

ContourFile contour_in(const Json& json) {
  ReadContour read = read_contour(json);
  if (!read.fault.empty()) throw std::runtime_error(read.fault);
  if (read.contour.pieces.empty()) throw std::runtime_error("a contour without pieces");
  return std::move(read.contour);
}

}  // namespace

OwnedCourse::OwnedCourse(const Json& json)
    : file(contour_in(json)), course(file), lengths(course.path) {}

Lengths::Lengths(const Path& path) : path_(path), at_joint_{0.0L} {
  for (const Span& span : path.spans()) {
    cells_.emplace_back(1, Cell{0.0L, at_joint_.back()});
    constexpr int kHalvings = 16;
    at_joint_.push_back(
        lay(span, 0.0L, 1.0L, speed_between(span, 0.0L, 1.0L), kHalvings, at_joint_.back()));
  }
}

/// Halved until both halves give what the whole did.
Real Lengths::lay(const Span& span, Real a, Real b, Real whole, int left, Real before) {
  const Real middle = 0.5L * (a + b), one = speed_between(span, a, middle),
             two = speed_between(span, middle, b);
  constexpr Real kAgree = 1e-14L;
  if (left > 0 && std::abs(one + two - whole) > kAgree * whole) {
    const Real half = lay(span, a, middle, one, left - 1, before);
    return lay(span, middle, b, two, left - 1, half);
  }
  cells_.back().push_back({b, before + one + two});
  return before + one + two;
}

Real Lengths::inside(std::size_t span, Real t) const {
  const std::vector<Cell>& cells = cells_[span];
  std::size_t k = 0;
  while (k + 2 < cells.size() && cells[k + 1].t <= t) ++k;
  return cells[k].length - at_joint_[span] + speed_between(path_.spans()[span], cells[k].t, t);
}

Real Lengths::of(Real order) const {
  const auto last = path_.spans().size() - 1;
  const auto k = std::min(static_cast<std::size_t>(std::max(order, 0.0L)), last);
  return at_joint_[k] + inside(k, order - static_cast<Real>(k));
}

Place Lengths::place(Real length, bool before) const {
  constexpr Real kOneJoint = 1e-12L;  // of the whole: joints of both contours at one point
  const Real near = kOneJoint * whole();
  std::size_t k = 0;
  while (k + 1 < path_.spans().size() &&
         (before ? length > at_joint_[k + 1] + near : length >= at_joint_[k + 1] - near)) {
    ++k;
  }
  const Real wanted = std::clamp(length - at_joint_[k], 0.0L, at_joint_[k + 1] - at_joint_[k]);
  const Span& span = path_.spans()[k];
  Real t = wanted / (at_joint_[k + 1] - at_joint_[k]);
  constexpr int kMost = 12;
  for (int i = 0; i < kMost; ++i) {
    const Real step = (wanted - inside(k, t)) / norm(span.at(t).d);
    t = std::clamp(t + step, 0.0L, 1.0L);
    if (std::abs(step) < 1e-15L) break;
  }
  return {k, t, 0.0L};
}

SpaceJet SpaceCourse::at(Real order, bool before) const {
  const Path& unrolled = heights->course.path;
  const auto last = static_cast<Real>(unrolled.spans().size() - 1);
  const Real k = std::clamp(before ? std::ceil(order) - 1.0L : std::floor(order), 0.0L, last);
  const Span& rolled = unrolled.spans()[static_cast<std::size_t>(k)];
  const Real t = order - k;
  const Jet h = rolled.at(t);
  const Vec h3 = rolled.third(t);
  const Real far = h.p.x + heights->course.origin.x;
  const Place below = plan->lengths.place(far, before);
  const Span& span = plan->course.path.spans()[below.span];
  const Jet jet = span.at(below.t);
  const Vec third = span.third(below.t);
  // by arc length: T, T' = kappa N, T'' = kappa' N - kappa^2 T
  const Real speed = norm(jet.d), kappa = jet.kappa();
  const Vec tangent = (1.0L / speed) * jet.d, normal = left_of(tangent);
  const Real rate = (cross(jet.d, third) / (speed * speed * speed) -
                     3.0L * kappa * dot(jet.d, jet.dd) / (speed * speed)) /
                    speed;
  const Vec c1 = tangent, c2 = kappa * normal, c3 = rate * normal - (kappa * kappa) * tangent;
  const auto in_space = [&](Vec p, Real up) {
    return p.x * frame.x + p.y * frame.y + up * frame.normal;
  };
  const Point o = plan->course.origin;
  SpaceJet out;
  out.p = frame.origin + in_space(jet.p + Vec{o.x, o.y}, h.p.y + heights->course.origin.y);
  out.d = in_space(h.d.x * c1, h.d.y);
  out.dd = in_space((h.d.x * h.d.x) * c2 + h.dd.x * c1, h.dd.y);
  out.ddd = in_space((h.d.x * h.d.x * h.d.x) * c3 + (3.0L * h.d.x * h.dd.x) * c2 + h3.x * c1, h3.y);
  return out;
}

std::vector<Real> SpaceCourse::joints() const {
  const Path& unrolled = heights->course.path;
  std::vector<Real> out;
  for (std::size_t k = 0; k <= unrolled.spans().size(); ++k) out.push_back(static_cast<Real>(k));
  constexpr Real kOneJoint = 1e-12L;  // of the length: joints of both contours at one point
  const Real near = kOneJoint * heights->lengths.whole();
  for (std::size_t k = 1; k < plan->course.path.spans().size(); ++k) {
    // the unrolled contour does not run back: halve
    const Real wanted = plan->lengths.joint(k) - heights->course.origin.x;
    Real low = 0.0L, high = unrolled.end();
    constexpr int kHalvings = 70;
    for (int i = 0; i < kHalvings; ++i) {
      const Real middle = 0.5L * (low + high);
      (unrolled.at(middle).x < wanted ? low : high) = middle;
    }
    const Real order = 0.5L * (low + high), joint = std::round(order);
    const auto nearest = static_cast<std::size_t>(joint);
    const Real away = std::abs(heights->lengths.of(order) - heights->lengths.joint(nearest));
    if (away > near) out.push_back(order);
  }
  std::sort(out.begin(), out.end());
  return out;
}

std::size_t SpaceCourse::point_below(std::size_t height) const {
  const std::size_t first = plan->file.closed ? plan->file.elements.front().source.value_or(0) : 0;
  return (first + height) % plan->file.points.size();
}

std::size_t SpaceCourse::height_of(std::size_t point) const {
  const std::size_t count = plan->file.points.size();
  for (std::size_t k = 0; k < count; ++k) {
    if (point_below(k) == point % count) return k;
  }
  return 0;
}

Real SpaceCourse::resolution() const {
  constexpr Real kOfSize = 1e-12L, kUlps = 32.0L * 0x1p-52L;
  return kOfSize * size + kUlps * coordinate;
}

ReadSpace read_space(const Json& json) {
  ReadSpace out;
  out.curve = std::make_unique<SpaceCourse>();
  SpaceCourse& curve = *out.curve;
  try {
    if (text_of(json, "format") != "obvid-space-curve" || json.at("version").real() != 1.0) {
      throw std::runtime_error("not a curve in space of version 1");
    }
    curve.planar = json.at("planar").truth();
    curve.units = json.at("units").string();
    curve.units_source = json.contains("units_source") ? json.at("units_source").string() : "file";
    const Json& frame = json.at("frame");
    curve.frame = {vec3_of(frame.at("origin")), vec3_of(frame.at("x")), vec3_of(frame.at("y")),
                   vec3_of(frame.at("normal"))};
    curve.points = vec3s_of(json.at("points"));
    if (curve.points.size() < 2) throw std::runtime_error("fewer than two points");
    curve.plan = std::make_unique<OwnedCourse>(json.at(curve.planar ? "contour" : "projection"));
    if (!curve.planar) curve.heights = std::make_unique<OwnedCourse>(json.at("heights"));
    curve.nurbs = nurbs_of(json.at("curve"));
  } catch (const std::exception& error) {
    out.fault = error.what();
    return out;
  }
  curve.size = extent_of(curve.points);
  curve.coordinate = largest_coordinate(curve.points);
  return out;
}

}  // namespace judge
