// SPDX-License-Identifier: Apache-2.0
#include "part.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace obvid::toolpath {
namespace {

/// Normals at the ends of an edge; the cutter's place follows normals.
constexpr double kEdgeAngle = std::numbers::pi / 6.0;
constexpr int kSteps = 8;              // of Newton, from places that are near
constexpr double kSettled = 1e-12;     // of the radius
constexpr double kLevelNormal = 1e-6;  // below, the rim's point is not defined by the normal
constexpr double kAgree = 1.0;         // shares of triangles, between exact and triangles' height

Vec2 direction(Vec2 a) {
  const double size = norm(a);
  return size > 0.0 ? a / size : Vec2{};
}

Vec3 upwards(Vec3 n) { return n.z < 0.0 ? -n : n; }

/// The feature of a triangle that holds a cutter at a point: at the ends of edges the corner.
int feature_at(const Triangle& t, int feature, Vec3 contact) {
  constexpr double kAtCorner = 1e-9;  // of the longest edge
  const double longest = std::max({norm(t[1] - t[0]), norm(t[2] - t[1]), norm(t[0] - t[2])});
  for (int k = 0; k < 3; ++k) {
    if (norm(contact - t[static_cast<std::size_t>(k)]) <= kAtCorner * longest) return 4 + k;
  }
  return feature;
}

/// Across the border that a cutter rests on, away from its triangle; 0 at corners and on walls.
Vec2 outwards_of(const Triangle& t, int feature) {
  if (feature < 1 || feature > 3) return {};
  const auto k = static_cast<std::size_t>(feature - 1);
  const auto level = [](Vec3 p) { return Vec2{p.x, p.y}; };
  const Vec2 a = level(t[k]), across = direction(left_normal(level(t[(k + 1) % 3]) - a));
  const double inside = dot(across, level(t[(k + 2) % 3]) - a);
  if (inside == 0.0) return {};
  return inside > 0.0 ? -across : across;
}

std::shared_ptr<const std::vector<std::optional<TrimRegion>>> regions_of(
    const SurfaceModel& model) {
  auto out = std::make_shared<std::vector<std::optional<TrimRegion>>>();
  out->reserve(model.patches.size());
  for (const SurfacePatch& patch : model.patches) {
    out->emplace_back();
    if (!patch.trims.empty()) out->back().emplace(patch);
  }
  return out;
}

std::array<double, 3> weights_at(const Triangle& t, Vec3 p) {
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  const double area = dot(n, n);
  if (!(area > 0.0)) return {1.0, 0.0, 0.0};
  const double b = std::clamp(dot(cross(p - t[0], t[2] - t[0]), n) / area, 0.0, 1.0);
  const double c = std::clamp(dot(cross(t[1] - t[0], p - t[0]), n) / area, 0.0, 1.0);
  return {1.0 - b - c, b, c};
}

/// The normal and how it turns with u and v.
struct TurningNormal {
  Vec3 n, du, dv;
};

TurningNormal normal_of(const SurfaceJet& jet) {
  const Vec3 across = cross(jet.du, jet.dv);
  const double size = norm(across);
  if (!(size > 0.0)) return {};
  const Vec3 n = across / size;
  const auto turned = [&](Vec3 d) { return (d - dot(n, d) * n) / size; };
  TurningNormal out{n, turned(cross(jet.duu, jet.dv) + cross(jet.du, jet.duv)),
                    turned(cross(jet.duv, jet.dv) + cross(jet.du, jet.dvv))};
  if (n.z < 0.0) out = {-n, -out.du, -out.dv};
  return out;
}

/// Derivative of `CutterShape::offset` along a change of the normal.
Vec2 offset_change(const CutterShape& cutter, Vec3 n, Vec3 dn) {
  Vec2 out{cutter.corner * dn.x, cutter.corner * dn.y};
  if (cutter.flat() > 0.0) {
    const double level = std::hypot(n.x, n.y);
    const Vec2 h{n.x / level, n.y / level}, d{dn.x, dn.y};
    out = out + (cutter.flat() / level) * (d - dot(h, d) * h);
  }
  return out;
}

}  // namespace

double level_spacing(const Part& part) {
  const double round = std::max(part.cutter().corner, part.cutter().flat());
  return std::sqrt(8.0 * round * kStepShare * part.tolerance());
}

Result<Part> Part::make(const SurfaceModel& model, const CutterShape& cutter, double tolerance,
                        double allowance, std::size_t threads, const RunContext& run) {
  TessellationOptions options;
  options.chord_tolerance = kTriangleShare * tolerance;
  options.angle = kEdgeAngle;
  options.threads = threads;
  auto meshes = tessellate(model, options, run);
  if (!meshes && meshes.error().code == ErrorCode::kToleranceNotReached) {
    Error error = meshes.error();
    error.hint = "allow a larger --tolerance";
    return fail(std::move(error));
  }
  OBVID_TRY(meshes);
  return Part(model, cutter, tolerance, allowance, std::move(*meshes), threads);
}

Part::Part(const SurfaceModel& model, CutterShape cutter, double tolerance, double allowance,
           std::vector<Mesh> meshes, std::size_t threads)
    : model_(model),
      regions_(regions_of(model)),
      tolerance_(tolerance),
      allowance_(allowance),
      meshes_(std::move(meshes)),
      field_(meshes_, threads) {
  take(cutter);
}

void Part::take(const CutterShape& cutter) {
  cutter_ = cutter;
  wide_ = slim_ = {cutter.radius + allowance_, cutter.corner + allowance_};
  slim_.radius -= std::min(kWallShare * tolerance_, 0.5 * cutter.radius);
  slim_.corner = std::min(slim_.corner, slim_.radius);
}

Part Part::with(const CutterShape& cutter) const {
  Part out = *this;
  out.take(cutter);
  return out;
}

Place Part::on_triangle(std::uint32_t triangle, const std::array<double, 3>& w) const {
  const FieldTriangle& t = field_.triangles()[triangle];
  const Mesh& mesh = meshes_[t.mesh];
  Place place;
  place.patch = t.mesh;
  Vec3 normal;
  for (std::size_t k = 0; k < 3; ++k) {
    const MeshVertex& vertex = mesh.vertices[mesh.triangles[t.number][k]];
    normal = normal + w[k] * upwards(vertex.normal);
    place.contact = place.contact + w[k] * t.corners[k];
    place.u += w[k] * vertex.u;
    place.v += w[k] * vertex.v;
  }
  place.normal = unit(normal);
  return place;
}

std::optional<Place> Part::drop(Vec2 axis) const {
  const auto found = field_.drop(slim_, axis);
  if (!found) return std::nullopt;
  const FieldTriangle& t = field_.triangles()[found->triangle];
  Place place = on_triangle(found->triangle, weights_at(t.corners, found->rest.point));
  place.tip = {axis.x, axis.y, found->rest.tip_z};
  place.contact = found->rest.point;
  const int feature = feature_at(t.corners, found->rest.feature, found->rest.point);
  place.open = ((static_cast<unsigned>(t.open) >> feature) & 1U) != 0;
  if (place.open) {
    place.outwards = outwards_of(t.corners, feature);
  } else {
    polish(axis, place);
  }
  place.tip.z += allowance_;
  return place;
}

// Newton's method for the point of the patch that touches a cutter on this axis.
void Part::polish(Vec2 axis, Place& place) const {
  const NurbsSurface& surface = model_.patches[place.patch].surface;
  const Range us = domain_u(surface), vs = domain_v(surface);
  double u = place.u, v = place.v;
  for (int step = 0; step < kSteps; ++step) {
    const SurfaceJet jet = evaluate(surface, u, v);
    const TurningNormal n = normal_of(jet);
    const bool level = std::hypot(n.n.x, n.n.y) < kLevelNormal;
    if (!(n.n.z > 0.0) || (level && slim_.flat() > 0.0)) return;
    const Vec2 gap = axis - Vec2{jet.point.x, jet.point.y} - slim_.offset(n.n);
    if (norm(gap) <= kSettled * slim_.radius) {
      const double z = jet.point.z + slim_.corner * (n.n.z - 1.0);
      const double off = std::abs(z - place.tip.z) * n.n.z;
      if (off > kAgree * kTriangleShare * tolerance_) return;
      place.tip.z = z;
      place.contact = jet.point;
      place.normal = n.n;
      place.u = u;
      place.v = v;
      return;
    }
    const Vec2 by_u = Vec2{jet.du.x, jet.du.y} + offset_change(slim_, n.n, n.du);
    const Vec2 by_v = Vec2{jet.dv.x, jet.dv.y} + offset_change(slim_, n.n, n.dv);
    const double area = cross(by_u, by_v);
    if (area == 0.0) return;
    u += cross(gap, by_v) / area;
    v += cross(by_u, gap) / area;
    if (!(u >= us.from && u <= us.to && v >= vs.from && v <= vs.to)) return;
  }
}

double Part::beyond_border(const Place& place, Vec2 outwards) const {
  constexpr double kUprightSide = 1e-3;  // z of normals: either side of a wall is open
  const Vec2 away = Vec2{place.tip.x, place.tip.y} - Vec2{place.contact.x, place.contact.y};
  const double side = dot(offset(place.normal), outwards);
  const double touching = std::max(place.normal.z < kUprightSide ? std::abs(side) : side, 0.0);
  return dot(away, outwards) - touching;
}

double Part::kept_up(const Place& place, Vec2 outwards, double beyond) const {
  const Vec2 away = Vec2{place.tip.x, place.tip.y} - Vec2{place.contact.x, place.contact.y};
  return std::max(place.tip.z, tip_over(place.contact, norm(away - beyond * outwards)));
}

std::optional<Place> Part::surface_over(Vec2 at) const {
  const auto found = field_.height(at);
  if (!found) return std::nullopt;
  return on_triangle(found->triangle, found->weights);
}

Bends Part::bends(const Place& place) const {
  const SurfaceCurvature k =
      curvature(evaluate(model_.patches[place.patch].surface, place.u, place.v));
  Bends out{place.normal, k.direction1, 0.0, 0.0};
  if (k.normal == Vec3{}) return out;
  // curvature towards the normal is positive there: a bulge as seen from above is negative
  const double sign = k.normal.z < 0.0 ? 1.0 : -1.0;
  out.normal = upwards(k.normal);
  out.k1 = sign * k.k1;
  out.k2 = sign * k.k2;
  return out;
}

}  // namespace obvid::toolpath
