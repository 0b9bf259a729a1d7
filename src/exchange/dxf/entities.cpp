// SPDX-License-Identifier: Apache-2.0
#include "dxf/entities.h"

#include <fmt/format.h>

#include <array>
#include <numbers>
#include <optional>
#include <utility>

#include "dxf/text.h"
#include "obvid/core/units.h"

namespace obvid::dxf {
namespace {

constexpr std::array kKinds = {
    std::pair{std::string_view("LINE"), Kind::kLine},
    std::pair{std::string_view("ARC"), Kind::kArc},
    std::pair{std::string_view("CIRCLE"), Kind::kCircle},
    std::pair{std::string_view("ELLIPSE"), Kind::kEllipse},
    std::pair{std::string_view("SPLINE"), Kind::kSpline},
    std::pair{std::string_view("LWPOLYLINE"), Kind::kPolyline},
    std::pair{std::string_view("POLYLINE"), Kind::kPolyline},
    std::pair{std::string_view("POINT"), Kind::kPoint},
    std::pair{std::string_view("INSERT"), Kind::kInsert},
    std::pair{std::string_view("VERTEX"), Kind::kVertex},
    std::pair{std::string_view("SEQEND"), Kind::kEnd},
};

Kind kind_of(std::string_view type) {
  for (const auto& [name, kind] : kKinds) {
    if (name == type) return kind;
  }
  return Kind::kOther;
}

constexpr const char* kBadNumberReason = "a number of it cannot be read";
constexpr const char* kBadCountReason = "its counts contradict its lists";
constexpr int kFirstExtended = 1000;  // group codes of data that applications add

/// Reads the tags of one entity.
class EntityReader {
 public:
  explicit EntityReader(Entity& entity) : e_(entity) {}

  void read(const Tag& tag) {
    if (tag.code >= kFirstExtended) return;
    if (common(tag)) return;
    switch (e_.kind) {
      case Kind::kSpline:
        return spline(tag);
      case Kind::kPolyline:
        return e_.type == "POLYLINE" ? simple(tag) : light_polyline(tag);
      case Kind::kInsert:
        return insert(tag);
      case Kind::kEnd:
      case Kind::kOther:
        return;
      default:
        return simple(tag);
    }
  }

  void finish() {
    if (!e_.points.empty() && !e_.bulges.empty()) e_.bulges.resize(e_.points.size(), 0.0);
    check(points_, e_.points.size(), "points");
    check(knots_, e_.knots.size(), "knots");
    check(fit_, e_.fit.size(), "fit points");
  }

 private:
  void check(std::optional<int> stated, std::size_t found, const char* what) {
    if (!stated || e_.fault.reason != nullptr) return;
    if (*stated >= 0 && static_cast<std::size_t>(*stated) == found) return;
    e_.fault = {kBadCountReason, fmt::format("{} {} stated, {} found", *stated, what, found)};
  }

  void real(const Tag& tag, double& target) {
    if (const auto value = number(tag)) {
      target = *value;
    } else {
      bad(tag);
    }
  }
  void whole(const Tag& tag, int& target) {
    if (const auto value = integer(tag)) {
      target = *value;
    } else {
      bad(tag);
    }
  }
  void count(const Tag& tag, std::optional<int>& target) {
    int value = 0;
    whole(tag, value);
    target = value;
  }
  void bad(const Tag& tag) {
    if (e_.fault.reason != nullptr) return;
    e_.fault = {kBadNumberReason, fmt::format("group {} is \"{}\"", tag.code, to_label(tag.text))};
  }

  bool common(const Tag& tag) {
    switch (tag.code) {
      case 5:
        e_.handle = tag.text;
        return true;
      case 8:
        e_.layer = tag.text;
        return true;
      case 60:
        e_.invisible = number(tag).value_or(0.0) != 0.0;
        return true;
      case 67:
        e_.paper = number(tag).value_or(0.0) != 0.0;
        return true;
      case 210:
        real(tag, e_.normal.x);
        return true;
      case 220:
        real(tag, e_.normal.y);
        return true;
      case 230:
        real(tag, e_.normal.z);
        return true;
      default:
        return false;
    }
  }

  bool coordinate(const Tag& tag, int first, Point3& target) {
    if (tag.code == first) real(tag, target.x);
    if (tag.code == first + 10) real(tag, target.y);
    if (tag.code == first + 20) real(tag, target.z);
    return tag.code == first || tag.code == first + 10 || tag.code == first + 20;
  }

  /// x opens a new point of the list, y and z belong to the last one.
  bool listed(const Tag& tag, int first, std::vector<Point3>& list) {
    if (tag.code == first) list.emplace_back();
    if (list.empty()) return false;
    return coordinate(tag, first, list.back());
  }

  void simple(const Tag& tag) {
    if (coordinate(tag, 10, e_.at) || coordinate(tag, 11, e_.second)) return;
    const bool ellipse = e_.kind == Kind::kEllipse;
    if (tag.code == 40) real(tag, e_.size);
    if (tag.code == (ellipse ? 41 : 50)) real(tag, e_.from);
    if (tag.code == (ellipse ? 42 : 51)) real(tag, e_.to);
    if (tag.code == 70) whole(tag, e_.flags);
    if (e_.kind == Kind::kVertex && tag.code == 42) {
      e_.bulges.assign(1, 0.0);
      real(tag, e_.bulges[0]);
    }
  }

  /// A direction whose first coordinate stands first.
  bool direction(const Tag& tag, int first, std::optional<Point3>& target) {
    if (tag.code == first) target.emplace();
    return target && coordinate(tag, first, *target);
  }

  void light_polyline(const Tag& tag) {
    if (listed(tag, 10, e_.points)) return;
    if (tag.code == 38) real(tag, e_.at.z);
    if (tag.code == 70) whole(tag, e_.flags);
    if (tag.code == 90) count(tag, points_);
    if (tag.code == 42 && !e_.points.empty()) {
      e_.bulges.resize(e_.points.size(), 0.0);
      real(tag, e_.bulges.back());
    }
  }

  void spline(const Tag& tag) {
    if (listed(tag, 10, e_.points) || listed(tag, 11, e_.fit)) return;
    if (direction(tag, 12, e_.start) || direction(tag, 13, e_.end)) return;
    if (tag.code == 40) real(tag, e_.knots.emplace_back());
    if (tag.code == 41) real(tag, e_.weights.emplace_back());
    if (tag.code == 70) whole(tag, e_.flags);
    if (tag.code == 71) whole(tag, e_.degree);
    if (tag.code == 72) count(tag, knots_);
    if (tag.code == 73) count(tag, points_);
    if (tag.code == 74) count(tag, fit_);
  }

  void insert(const Tag& tag) {
    if (coordinate(tag, 10, e_.at)) return;
    if (tag.code == 2) e_.block = tag.text;
    if (tag.code == 41) real(tag, e_.scale.x);
    if (tag.code == 42) real(tag, e_.scale.y);
    if (tag.code == 43) real(tag, e_.scale.z);
    if (tag.code == 44) real(tag, e_.column_step);
    if (tag.code == 45) real(tag, e_.row_step);
    if (tag.code == 50) real(tag, e_.from);
    if (tag.code == 70) whole(tag, e_.columns);
    if (tag.code == 71) whole(tag, e_.rows);
  }

  Entity& e_;
  std::optional<int> points_, knots_, fit_;
};

}  // namespace

Entity entity_of(std::span<const Tag> tags) {
  Entity entity;
  entity.type = tags.front().text;
  entity.kind = kind_of(entity.type);
  entity.line = tags.front().line;
  if (entity.kind == Kind::kEllipse) entity.to = kFullTurn;
  EntityReader reader(entity);
  for (const Tag& tag : tags.subspan(1)) reader.read(tag);
  reader.finish();
  return entity;
}

void add_vertex(Entity& polyline, const Entity& vertex) {
  if (polyline.fault.reason == nullptr) polyline.fault = vertex.fault;
  // The frame of a spline-fitted polyline stands among its vertices.
  if ((vertex.flags & kFrameVertexFlag) != 0) return;
  polyline.points.push_back(vertex.at);
  const double bulge = vertex.bulges.empty() ? 0.0 : vertex.bulges[0];
  if (bulge == 0.0 && polyline.bulges.empty()) return;
  polyline.bulges.resize(polyline.points.size(), 0.0);
  polyline.bulges.back() = bulge;
}

}  // namespace obvid::dxf
