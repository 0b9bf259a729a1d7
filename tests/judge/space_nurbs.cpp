// SPDX-License-Identifier: Apache-2.0
#include "space_nurbs.h"

#include <algorithm>
#include <stdexcept>

namespace judge {

Vec3 vec3_of(const Json& json) {
  if (!json.is_array() || json.size() != 3) throw std::runtime_error("a point is no [x, y, z]");
  return {json[0].real(), json[1].real(), json[2].real()};
}

std::vector<Vec3> vec3s_of(const Json& json) {
  std::vector<Vec3> out;
  for (const Json& one : json) out.push_back(vec3_of(one));
  return out;
}

Real extent_of(const std::vector<Vec3>& points) {
  Real out = 0.0L;
  for (const Vec3& p : points) out = std::max(out, norm(p - points.front()));
  return out;
}

Real largest_coordinate(const std::vector<Vec3>& points) {
  Real out = 0.0L;
  for (const Vec3& p : points) {
    out = std::max({out, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return out;
}

std::string SpaceNurbs::fault() const {
  if (degree < 1 || points.size() < 2) return "no curve";
  const auto p = static_cast<std::size_t>(degree);
  if (knots.size() != points.size() + p + 1) return "the number of knots";
  if (weights.size() != points.size()) return "the number of weights";
  if (!std::is_sorted(knots.begin(), knots.end())) return "knots that descend";
  if (knots[p] != knots.front() || knots[points.size()] != knots.back()) return "not clamped";
  for (const Real w : weights) {
    if (!(w > 0.0L)) return "a weight that is not positive";
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (knots[i] == knots[i + p]) return "a knot inside more often than the degree";
  }
  return "";
}

std::size_t SpaceNurbs::span_of(Real u) const {
  const auto p = static_cast<std::size_t>(degree);
  std::size_t span = p;
  for (std::size_t k = p; k < points.size(); ++k) {
    if (knots[k] < knots[k + 1] && knots[k] <= u) span = k;
  }
  return span;
}

Real SpaceNurbs::basis(std::size_t i, Real u, int order) const {
  return basis(i, degree, u, span_of(u), order);
}

Real SpaceNurbs::basis(std::size_t i, int of_degree, Real u, std::size_t span, int order) const {
  const auto p = static_cast<std::size_t>(of_degree);
  if (span < i || span > i + p) return 0.0L;
  if (of_degree == 0) return order == 0 ? 1.0L : 0.0L;
  const Real left = knots[i + p] - knots[i], right = knots[i + p + 1] - knots[i + 1];
  Real out = 0.0L;
  if (order > 0) {
    const auto times = static_cast<Real>(of_degree);
    if (left > 0.0L) out += times / left * basis(i, of_degree - 1, u, span, order - 1);
    if (right > 0.0L) out -= times / right * basis(i + 1, of_degree - 1, u, span, order - 1);
    return out;
  }
  if (left > 0.0L) out += (u - knots[i]) / left * basis(i, of_degree - 1, u, span, 0);
  if (right > 0.0L) {
    out += (knots[i + p + 1] - u) / right * basis(i + 1, of_degree - 1, u, span, 0);
  }
  return out;
}

SpaceJet SpaceNurbs::at(Real u) const {
  const std::size_t span = span_of(u), first = span - static_cast<std::size_t>(degree);
  Vec3 h[4];
  Real w[4] = {};
  for (std::size_t i = first; i <= span; ++i) {
    for (int r = 0; r < 4; ++r) {
      const Real part = weights[i] * basis(i, degree, u, span, r);
      w[r] += part;
      h[r] = h[r] + part * points[i];
    }
  }
  SpaceJet out;
  const Real whole = 1.0L / w[0];
  out.p = whole * h[0];
  out.d = whole * (h[1] - w[1] * out.p);
  out.dd = whole * (h[2] - 2.0L * w[1] * out.d - w[2] * out.p);
  out.ddd = whole * (h[3] - 3.0L * w[1] * out.dd - 3.0L * w[2] * out.d - w[3] * out.p);
  return out;
}

SpaceNurbs nurbs_of(const Json& json) {
  SpaceNurbs out;
  out.degree = static_cast<int>(json.at("degree").real());
  for (const double knot : json.at("knots").reals()) out.knots.push_back(knot);
  out.points = vec3s_of(json.at("points"));
  for (const double weight : json.at("weights").reals()) out.weights.push_back(weight);
  if (out.weights.empty()) out.weights.assign(out.points.size(), 1.0L);
  return out;
}

}  // namespace judge
