// SPDX-License-Identifier: Apache-2.0
#include "road/profile_read.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

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

/// Coefficients of a height over the station from `s` on.
struct ElevationCubic {
  double s = 0.0, a = 0.0, b = 0.0, c = 0.0, d = 0.0;
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
    if (one->d != 0.0) {
      warnings.add("an elevation profile with cubics is not used", child);
      return std::nullopt;
    }
    parts.push_back(*one);
  }
  const bool flat = std::all_of(parts.begin(), parts.end(), [](const ElevationCubic& one) {
    return one.a == 0.0 && one.b == 0.0 && one.c == 0.0;
  });
  if (flat || !length || !(*length > 0.0)) return std::nullopt;
  if (parts.back().s > *length * (1.0 + kOverlap)) {
    warnings.add("elevations beyond the end of a road are not used", all);
  }
  VerticalProfile out;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const ElevationCubic& one = parts[k];
    const double end = k + 1 < parts.size() ? std::min(parts[k + 1].s, *length) : *length;
    const double along = end - one.s;
    if (!(along > kTouching * *length)) continue;
    const double jump = std::abs(one.a - out.end_height);
    if (!out.elements.empty() && jump > kSameHeight * (*length + std::abs(one.a))) {
      warnings.add("an elevation profile whose height jumps is not used", all);
      return std::nullopt;
    }
    const double grade1 = one.b + 2.0 * one.c * along;
    out.end_height = one.a + along * (one.b + along * one.c);
    if (one.c == 0.0) {
      out.elements.push_back(
          element_between(ProfileKind::kGrade, {one.s, one.a}, along, one.b, one.b, 0.0));
    } else {
      out.elements.push_back(element_between(one.c > 0.0 ? ProfileKind::kSag : ProfileKind::kCrest,
                                             {one.s, one.a}, along, one.b, grade1, 0.5 / one.c));
    }
  }
  if (out.elements.empty()) return std::nullopt;
  out.end_station = *length;
  return out;
}

}  // namespace obvid::exchange
