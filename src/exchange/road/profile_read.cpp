// SPDX-License-Identifier: Apache-2.0
#include "road/profile_read.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "obvid/alignment/internal/profile_figures.h"
#include "obvid/core/internal/figures.h"

namespace obvid::exchange {
namespace {

constexpr double kTouching = 1e-9;    ///< of the whole length: no grade is shorter
constexpr double kOverlap = 1e-6;     ///< of the whole length: what rounded stations overlap
constexpr double kSameHeight = 1e-6;  ///< of length and height: what the digits of a file leave

/// Where two grades meet, and what rounds it.
struct Corner {
  Vec2 at;                     ///< station, height
  double in = 0.0, out = 0.0;  ///< lengths of a parabola before and behind
  double radius = 0.0;         ///< of an arc, without sign
};

ProfileElement element_between(ProfileKind kind, Vec2 from, double length, double grade0,
                               double grade1, double radius) {
  return {kind, from.x, length, from.y, grade0, grade1, radius};
}

class Builder {
 public:
  explicit Builder(const std::vector<Corner>& corners) : corners_(corners) {
    length_ = corners.back().at.x - corners.front().at.x;
  }

  /// Why there is none, or nothing.
  std::optional<VerticalProfile> run(std::string& why) {
    for (std::size_t k = 1; k < corners_.size(); ++k) {
      if (corners_[k].at.x > corners_[k - 1].at.x) continue;
      why = "a profile whose stations do not ascend is not used";
      return std::nullopt;
    }
    at_ = corners_.front().at;
    for (std::size_t k = 1; k + 1 < corners_.size(); ++k) {
      if (!round(k)) {
        why = "a profile whose vertical curves overlap is not used";
        return std::nullopt;
      }
    }
    if (!go_to(corners_.back().at, grade_before(corners_.size() - 1))) {
      why = "a profile whose vertical curves overlap is not used";
      return std::nullopt;
    }
    if (arcs_ && parabolas_) {
      why = "a profile with both arcs and parabolas is not used";
      return std::nullopt;
    }
    out_.curves = arcs_ ? ProfileCurves::kArcs : ProfileCurves::kParabolas;
    out_.end_station = corners_.back().at.x;
    out_.end_height = corners_.back().at.y;
    return std::move(out_);
  }

 private:
  [[nodiscard]] double grade_before(std::size_t k) const {
    const Vec2 way = corners_[k].at - corners_[k - 1].at;
    return way.y / way.x;
  }

  /// A grade up to there; false where that lies behind.
  bool go_to(Vec2 place, double grade) {
    const double length = place.x - at_.x;
    if (length < -kOverlap * length_) return false;
    if (length > kTouching * length_) {
      out_.elements.push_back(element_between(ProfileKind::kGrade, at_, length, grade, grade, 0.0));
    }
    at_ = place;
    return true;
  }

  void bend(double length, double grade0, double grade1, double radius, Vec2 end) {
    const ProfileKind kind = grade1 > grade0 ? ProfileKind::kSag : ProfileKind::kCrest;
    out_.elements.push_back(element_between(kind, at_, length, grade0, grade1, radius));
    at_ = end;
  }

  bool round(std::size_t k) {
    const Corner& c = corners_[k];
    const double g0 = grade_before(k), g1 = grade_before(k + 1);
    if (g0 == g1) return true;
    if (c.radius > 0.0) {
      arcs_ = true;
      const double a0 = std::atan(g0), a1 = std::atan(g1);
      const double tangent = c.radius * std::tan(0.5 * std::abs(a1 - a0));
      const Vec2 from = c.at - tangent * unit_at(a0), to = c.at + tangent * unit_at(a1);
      if (!go_to(from, g0)) return false;
      bend(to.x - from.x, g0, g1, std::copysign(c.radius, g1 - g0), to);
      return true;
    }
    if (!(c.in > 0.0 && c.out > 0.0)) return go_to(c.at, g0);
    parabolas_ = true;
    const Vec2 from = c.at - c.in * Vec2{1.0, g0}, to = c.at + c.out * Vec2{1.0, g1};
    if (!go_to(from, g0)) return false;
    const double whole = c.in + c.out;
    if (c.in == c.out) {
      bend(whole, g0, g1, whole / (g1 - g0), to);
      return true;
    }
    // two parabolas meet with a common tangent above or below the corner
    const double middle = g0 + (g1 - g0) * c.out / whole;
    const Vec2 meeting = c.at + Vec2{0.0, 0.5 * (g1 - g0) * c.in * c.out / whole};
    bend(c.in, g0, middle, c.in / (middle - g0), meeting);
    bend(c.out, middle, g1, c.out / (g1 - middle), to);
    return true;
  }

  const std::vector<Corner>& corners_;
  double length_ = 0.0;
  VerticalProfile out_;
  Vec2 at_;
  bool arcs_ = false, parabolas_ = false;
};

std::optional<Corner> corner_of(pugi::xml_node node) {
  const auto numbers = numbers_of(node.child_value(), 2);
  if (!numbers || numbers->size() < 2) return std::nullopt;
  Corner out;
  out.at = {(*numbers)[0], (*numbers)[1]};
  const auto attribute = [&](const char* name) {
    return number_of(node.attribute(name).value()).value_or(0.0);
  };
  const std::string_view kind = local_name(node);
  if (kind == "ParaCurve") out.in = out.out = 0.5 * attribute("length");
  if (kind == "UnsymParaCurve") {
    out.in = attribute("lengthIn");
    out.out = attribute("lengthOut");
  }
  if (kind == "CircCurve") out.radius = attribute("radius");
  const bool bends = kind != "PVI";
  if (bends && !(out.radius > 0.0) && !(out.in > 0.0 && out.out > 0.0)) return std::nullopt;
  return out;
}

/// A height by a cubic from the station `s` on, over a length.
struct ElevationCubic {
  double s = 0.0, a = 0.0, b = 0.0, c = 0.0, d = 0.0;
  double length = 0.0;

  [[nodiscard]] double height(double x) const { return a + x * (b + x * (c + x * d)); }
  [[nodiscard]] double grade(double x) const { return b + x * (2.0 * c + 3.0 * x * d); }
  /// Second derivative.
  [[nodiscard]] double bend(double x) const { return 2.0 * c + 6.0 * x * d; }
  [[nodiscard]] double end_height() const { return height(length); }
  [[nodiscard]] double end_grade() const { return grade(length); }
  [[nodiscard]] double end() const { return s + length; }
  /// Whether what makes it no parabola is below the rounding of its heights.
  [[nodiscard]] bool is_parabola() const {
    constexpr double kRounding = 16.0 * 0x1p-53;  // of the heights
    const double cubed = std::abs(d) * length * length * length;
    return cubed <= kRounding * (std::abs(a) + std::abs(end_height()) + std::abs(b) * length);
  }
  [[nodiscard]] bool is_grade() const { return c == 0.0 && is_parabola(); }
};

std::optional<ElevationCubic> cubic_of(pugi::xml_node node) {
  ElevationCubic out;
  for (const auto& [name, value] :
       {std::pair{"s", &out.s}, std::pair{"a", &out.a}, std::pair{"b", &out.b},
        std::pair{"c", &out.c}, std::pair{"d", &out.d}}) {
    const auto number = number_of(node.attribute(name).value());
    if (!number) return std::nullopt;
    *value = *number;
  }
  return out;
}

/// The parabola or grade that a cubic is.
ProfileElement plain_element(const ElevationCubic& one) {
  const Vec2 from{one.s, one.a};
  if (one.is_grade()) {
    return element_between(ProfileKind::kGrade, from, one.length, one.b, one.b, 0.0);
  }
  return element_between(kind_between(0.0, one.c), from, one.length, one.b,
                         one.b + 2.0 * one.c * one.length, 0.5 / one.c);
}

/// An arc of a circle over the station with the grades of cubics at both ends, and how far they are
/// from it.
class ArcOfCubics {
 public:
  ArcOfCubics(const ElevationCubic* first, const ElevationCubic* last)
      : first_(first), last_(last), length_(last->end() - first->s) {
    sine0_ = sine_of(first->b);
    curvature_ = (sine_of(last->end_grade()) - sine0_) / length_;
  }

  /// Nothing where the cubics are no such arc.
  [[nodiscard]] std::optional<double> distance() const {
    constexpr double kNoArc = 1e-4;  // of the arc's height over its chord: that its end is off
    constexpr double kFar = 0.01;    // of the same, anywhere
    if (curvature_ == 0.0 || !std::isfinite(curvature_)) return std::nullopt;
    const double height = std::abs(curvature_) * length_ * length_ / 8.0;
    const double end = height_at(length_);
    const double most = std::min(kNoArc * height, kSameHeight * length_);
    if (!(std::abs(end - last_->end_height()) <= most)) return std::nullopt;
    double largest = 0.0;
    for (const ElevationCubic* one = first_; one <= last_; ++one) {
      largest = std::max(largest, distance_of(*one));
    }
    if (!(largest <= kFar * height)) return std::nullopt;
    return largest;
  }

  [[nodiscard]] ProfileElement element() const {
    return element_between(kind_between(0.0, curvature_), {first_->s, first_->a}, length_,
                           first_->b, last_->end_grade(), 1.0 / curvature_);
  }

 private:
  static double sine_of(double grade) { return grade / std::hypot(1.0, grade); }

  [[nodiscard]] double sine_at(double along) const { return sine0_ + curvature_ * along; }

  [[nodiscard]] double height_at(double along) const {
    const double middle = 0.5 * (std::asin(sine0_) + std::asin(sine_at(along)));
    return first_->a + along * std::tan(middle);
  }

  /// Second derivative of the height.
  [[nodiscard]] double bend_at(double along) const {
    const double square = 1.0 - sine_at(along) * sine_at(along);
    return curvature_ / (square * std::sqrt(square));
  }

  /// A bound: the largest of places along it, and what the difference of second derivatives adds
  /// between two of them.
  [[nodiscard]] double distance_of(const ElevationCubic& one) const {
    constexpr int kPlaces = 64;
    const double from = one.s - first_->s, step = one.length / kPlaces;
    double largest = 0.0, bends = 0.0;
    for (int k = 0; k <= kPlaces; ++k) {
      const double x = k * step;
      largest = std::max(largest, std::abs(one.height(x) - height_at(from + x)));
      bends = std::max(bends, std::abs(one.bend(x) - bend_at(from + x)));
      if (k == 0) continue;
      const double before = x - step;  // both are monotone in between, but for the arc's least
      bends = std::max({bends, std::abs(one.bend(before) - bend_at(from + x)),
                        std::abs(one.bend(x) - bend_at(from + before))});
      if (sine_at(from + before) * sine_at(from + x) >= 0.0) continue;
      bends = std::max(
          {bends, std::abs(one.bend(before) - curvature_), std::abs(one.bend(x) - curvature_)});
    }
    return largest + step * step / 8.0 * bends;
  }

  const ElevationCubic *first_, *last_;
  double length_ = 0.0, sine0_ = 0.0, curvature_ = 0.0;
};

/// Whether the next cubic goes on where one ends, with its grade.
bool goes_on(const ElevationCubic& one, const ElevationCubic& next) {
  constexpr double kSmoothGrade = 1e-4;  // of what the grade changes by along both
  const double change = std::abs(next.end_grade() - one.b);
  return std::abs(next.b - one.end_grade()) <= kSmoothGrade * change;
}

/// Cubics as grades and arcs, as few arcs as they are; `off` grows to how far the farthest is.
/// Nothing where one is neither: `refused` is the first that is not.
std::optional<std::vector<ProfileElement>> as_arcs(const std::vector<ElevationCubic>& parts,
                                                   double& off, const ElevationCubic*& refused) {
  std::vector<ProfileElement> out;
  for (std::size_t k = 0; k < parts.size();) {
    if (parts[k].is_grade()) {
      out.push_back(plain_element(parts[k++]));
      continue;
    }
    const std::size_t first = k;
    std::optional<ArcOfCubics> longest;
    double far = 0.0;
    for (; k < parts.size() && !parts[k].is_grade(); ++k) {
      if (k > first && !goes_on(parts[k - 1], parts[k])) break;
      const ArcOfCubics arc(&parts[first], &parts[k]);
      const auto distance = arc.distance();
      if (!distance) break;
      longest = arc;
      far = *distance;
    }
    refused = &parts[first];
    if (!longest) return std::nullopt;
    off = std::max(off, far);
    out.push_back(longest->element());
  }
  return out;
}

}  // namespace

std::optional<VerticalProfile> landxml_profile(pugi::xml_node alignment, XmlWarnings& warnings) {
  const pugi::xml_node all = child_of(alignment, "Profile");
  const pugi::xml_node node = child_of(all, "ProfAlign");
  if (!node) return std::nullopt;
  std::vector<Corner> corners;
  bool more = false;
  for (const pugi::xml_node child : all.children()) {
    if (local_name(child) == "ProfAlign" && child != node) more = true;
  }
  if (more) warnings.add("profiles of an alignment behind its first one are not used", node);
  for (const pugi::xml_node child : node.children()) {
    const std::string_view kind = local_name(child);
    if (kind != "PVI" && kind != "ParaCurve" && kind != "UnsymParaCurve" && kind != "CircCurve") {
      continue;
    }
    const auto corner = corner_of(child);
    if (!corner) {
      warnings.add("a profile with a place or a curve that cannot be read is not used", child);
      return std::nullopt;
    }
    corners.push_back(*corner);
  }
  if (corners.size() < 2) return std::nullopt;
  std::string why;
  auto out = Builder(corners).run(why);
  if (!out) warnings.add(why, node);
  return out;
}

std::optional<VerticalProfile> opendrive_profile(pugi::xml_node road, XmlWarnings& warnings) {
  const pugi::xml_node all = child_of(road, "elevationProfile");
  const auto length = number_of(road.attribute("length").value());
  std::vector<ElevationCubic> parts;
  for (const pugi::xml_node child : all.children()) {
    if (local_name(child) != "elevation") continue;
    const auto one = cubic_of(child);
    if (!one || (!parts.empty() && !(one->s > parts.back().s))) {
      warnings.add("an elevation profile that cannot be read is not used", child);
      return std::nullopt;
    }
    parts.push_back(*one);
  }
  const bool flat = std::all_of(parts.begin(), parts.end(), [](const ElevationCubic& one) {
    return one.a == 0.0 && one.b == 0.0 && one.c == 0.0 && one.d == 0.0;
  });
  if (flat || !length || !(*length > 0.0)) return std::nullopt;
  if (parts.back().s > *length * (1.0 + kOverlap)) {
    warnings.add("elevations beyond the end of a road are not used", all);
  }
  for (std::size_t k = 0; k < parts.size(); ++k) {
    parts[k].length =
        (k + 1 < parts.size() ? std::min(parts[k + 1].s, *length) : *length) - parts[k].s;
  }
  parts.erase(std::remove_if(
                  parts.begin(), parts.end(),
                  [&](const ElevationCubic& one) { return !(one.length > kTouching * *length); }),
              parts.end());
  if (parts.empty()) return std::nullopt;
  for (std::size_t k = 1; k < parts.size(); ++k) {
    const double jump = std::abs(parts[k].a - parts[k - 1].end_height());
    if (jump <= kSameHeight * (*length + std::abs(parts[k].a))) continue;
    warnings.add("an elevation profile whose height jumps is not used", all);
    return std::nullopt;
  }
  VerticalProfile out;
  out.end_station = *length;
  out.end_height = parts.back().end_height();
  if (std::all_of(parts.begin(), parts.end(),
                  [](const ElevationCubic& one) { return one.is_parabola(); })) {
    for (const ElevationCubic& one : parts) out.elements.push_back(plain_element(one));
    return out;
  }
  double off = 0.0;
  const ElevationCubic* refused = nullptr;
  auto arcs = as_arcs(parts, off, refused);
  if (!arcs) {
    const char* const why = refused->is_parabola()
                                ? "is a parabola, and others of its are along arcs of circles"
                                : "is neither a parabola nor along an arc of a circle";
    warnings.add(fmt::format("an elevation profile is not used: its cubic at s = {:.6g} m {}",
                             refused->s, why),
                 all);
    return std::nullopt;
  }
  out.curves = ProfileCurves::kArcs;
  out.elements = std::move(*arcs);
  warnings.add(fmt::format("cubics of an elevation profile are taken as the arcs of circles that "
                           "they follow within {} m",
                           significant_above(off, 2)),
               all);
  return out;
}

}  // namespace obvid::exchange
