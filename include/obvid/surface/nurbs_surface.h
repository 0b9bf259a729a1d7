// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <array>
#include <span>
#include <vector>

#include "obvid/surface/space_curve.h"

namespace obvid {

/// NURBS surface over [u] x [v], clamped knots as in `SpaceCurve`. Control point i along u in row j
/// along v is `points[j * count_u() + i]`; weights likewise, or empty when all are 1.
struct NurbsSurface {
  int degree_u = 0;
  int degree_v = 0;
  std::vector<double> knots_u;
  std::vector<double> knots_v;
  std::vector<Vec3> points;
  std::vector<double> weights;

  [[nodiscard]] std::size_t count_u() const {
    return knots_u.size() - static_cast<std::size_t>(degree_u) - 1;
  }
  [[nodiscard]] std::size_t count_v() const {
    return knots_v.size() - static_cast<std::size_t>(degree_v) - 1;
  }
  friend bool operator==(const NurbsSurface&, const NurbsSurface&) = default;
};

/// Position and partial derivatives.
struct SurfacePoint {
  Vec3 point;
  Vec3 du;
  Vec3 dv;
};
struct SurfaceJet {
  Vec3 point;
  Vec3 du, dv;
  Vec3 duu, duv, dvv;
};

/// Curvature of a surface at a point. Signs belong to the normal du x dv: a sphere seen from
/// outside, normal outwards, has negative principal curvatures.
struct SurfaceCurvature {
  Vec3 normal;  ///< length 1; zero vector where du x dv vanishes (poles, collapsed edges)
  double k1 = 0.0, k2 = 0.0;  ///< principal curvatures, k1 >= k2, 1/unit
  Vec3 direction1;            ///< of k1, length 1, tangential; the other is normal x direction1
  double gaussian = 0.0;      ///< k1 k2
  double mean = 0.0;          ///< (k1 + k2) / 2
};

/// As of `SpaceCurve`; points are as many as count_u() * count_v().
[[nodiscard]] Result<void> check(const NurbsSurface& surface);

[[nodiscard]] Range domain_u(const NurbsSurface& surface);
[[nodiscard]] Range domain_v(const NurbsSurface& surface);

/// One point; outside the domain the border spans go on. O(degree^2 + log n).
[[nodiscard]] SurfaceJet evaluate(const NurbsSurface& surface, double u, double v);
/// All points (us[i], vs[j]) with both partial derivatives, at out[j * us.size() + i]. Parameters
/// in any order (ascending is fastest); the fast way to draw a surface.
void evaluate_raster(const NurbsSurface& surface, std::span<const double> us,
                     std::span<const double> vs, std::span<SurfacePoint> out);
[[nodiscard]] std::vector<SurfacePoint> evaluate_raster(const NurbsSurface& surface,
                                                        std::span<const double> us,
                                                        std::span<const double> vs);

/// Normal, principal, Gaussian and mean curvature of a jet; where du x dv vanishes all are 0.
[[nodiscard]] SurfaceCurvature curvature(const SurfaceJet& jet);

/// The surface's own curves: exact.
[[nodiscard]] SpaceCurve isocurve_at_u(const NurbsSurface& surface, double u);  ///< runs along v
[[nodiscard]] SpaceCurve isocurve_at_v(const NurbsSurface& surface, double v);  ///< runs along u

// Operations that leave the shape as it is.
[[nodiscard]] NurbsSurface with_knots_u(const NurbsSurface& surface,
                                        const std::vector<double>& new_knots);
[[nodiscard]] NurbsSurface with_knots_v(const NurbsSurface& surface,
                                        const std::vector<double>& new_knots);
[[nodiscard]] NurbsSurface with_degrees(const NurbsSurface& surface, int degree_u, int degree_v);
[[nodiscard]] NurbsSurface with_domain(const NurbsSurface& surface, Range u, Range v);
[[nodiscard]] std::array<NurbsSurface, 2> split_u(const NurbsSurface& surface, double u);
[[nodiscard]] std::array<NurbsSurface, 2> split_v(const NurbsSurface& surface, double v);
/// u and v exchanged: the normal turns round.
[[nodiscard]] NurbsSurface transposed(const NurbsSurface& surface);
/// u runs backwards: the normal turns round.
[[nodiscard]] NurbsSurface reversed_u(const NurbsSurface& surface);

/// Diagonal of the box of the control points, units: what "relative to the size" refers to.
[[nodiscard]] double size_of(const NurbsSurface& surface);

}  // namespace obvid
