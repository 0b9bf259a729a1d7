// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "drop_field.h"
#include "obvid/surface/internal/trim.h"
#include "obvid/surface/surface.h"

namespace obvid::toolpath {

/// How the tolerance is shared out.
inline constexpr double kTriangleShare = 0.2;  ///< surface to triangles
inline constexpr double kStepShare = 0.25;     ///< between neighbouring points of a pass
inline constexpr double kPrintShare = 0.3;     ///< points to printed blocks, with rounding
/// By so much the radius is taken smaller when the cutter comes down, so that rounding does not
/// lift it onto walls that it runs along.
inline constexpr double kWallShare = 0.02;

class Part;

/// On a level no part can hide between two places of the tip that are so near to each other.
[[nodiscard]] double level_spacing(const Part& part);

/// Bends of a surface where a cutter touches it.
struct Bends {
  Vec3 normal;  ///< upwards
  Vec3 direction1;
  double k1 = 0.0, k2 = 0.0;  ///< principal curvatures, positive where the part bulges upwards
};

/// A place of the cutter on the part.
struct Place {
  Vec3 tip;
  Vec3 contact;
  Vec3 normal;        ///< of the surface at the contact, upwards
  bool open = false;  ///< rests on an open border
  Vec2 outwards;      ///< there, seen from above, across the border, length 1; 0: on a corner of it
  std::uint32_t patch = 0;
  double u = 0.0, v = 0.0;
};

/// A model ready to be cut: triangles within their share of the tolerance, and the surface itself.
class Part {
 public:
  static Result<Part> make(const SurfaceModel& model, const CutterShape& cutter, double tolerance,
                           double allowance, std::size_t threads, const RunContext& run);

  /// The same for another cutter.
  [[nodiscard]] Part with(const CutterShape& cutter) const;

  [[nodiscard]] const CutterShape& cutter() const { return cutter_; }
  /// What stays on the part everywhere: a cutter rests where its body, wider by that all around,
  /// touches the part.
  [[nodiscard]] double allowance() const { return allowance_; }
  /// From the axis to the contact, turned round, and the tip over a contact.
  [[nodiscard]] Vec2 offset(Vec3 normal) const { return wide_.offset(normal); }
  [[nodiscard]] Vec3 tip(Vec3 contact, Vec3 normal) const {
    return wide_.tip(contact, normal) + Vec3{0.0, 0.0, allowance_};
  }
  /// Height of the tip when the body touches a point that lies this far from the axis.
  [[nodiscard]] double tip_over(Vec3 contact, double from_axis) const {
    return contact.z - wide_.height(std::min(from_axis, wide_.radius)) + allowance_;
  }
  /// How far the axis of a cutter that rests on an open border lies out over it, beyond where it
  /// still touches the surface with its side; `outwards` as of the place.
  [[nodiscard]] double beyond_border(const Place& place, Vec2 outwards) const;
  /// Height of the tip where it does not go down there.
  [[nodiscard]] double kept_up(const Place& place, Vec2 outwards, double beyond) const;
  /// Whether that place of a patch is there, and not trimmed away.
  [[nodiscard]] bool is_there(std::size_t patch, double u, double v) const {
    const auto& region = (*regions_)[patch];
    return !region || region->contains(u, v);
  }
  [[nodiscard]] double tolerance() const { return tolerance_; }
  [[nodiscard]] const DropField& field() const { return field_; }
  [[nodiscard]] const SurfaceModel& model() const { return model_; }
  [[nodiscard]] const std::vector<Mesh>& meshes() const { return meshes_; }

  /// Where the cutter comes to rest; on triangles, then made exact on the surface where the contact
  /// lies inside a patch.
  [[nodiscard]] std::optional<Place> drop(Vec2 axis) const;
  /// Highest point of the part over a place, with the normal.
  [[nodiscard]] std::optional<Place> surface_over(Vec2 place) const;
  [[nodiscard]] Bends bends(const Place& place) const;
  [[nodiscard]] Place on_triangle(std::uint32_t triangle, const std::array<double, 3>& w) const;

 private:
  Part(const SurfaceModel& model, CutterShape cutter, double tolerance, double allowance,
       std::vector<Mesh> meshes, std::size_t threads);
  void take(const CutterShape& cutter);
  void polish(Vec2 axis, Place& place) const;

  const SurfaceModel& model_;
  std::shared_ptr<const std::vector<std::optional<TrimRegion>>> regions_;  ///< of trimmed patches
  CutterShape cutter_;
  CutterShape wide_;  ///< by the allowance
  CutterShape slim_;
  double tolerance_, allowance_;
  std::vector<Mesh> meshes_;
  DropField field_;
};

}  // namespace obvid::toolpath
