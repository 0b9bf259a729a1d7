// SPDX-License-Identifier: Apache-2.0
// What the tests measure of triangles, without the library's own measuring.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "obvid/mesh/mesh.h"

namespace obvid {

inline constexpr double kAnyAngle = 10.0;  // rad: only the chord tolerance counts

}  // namespace obvid

namespace obvid::checks {

using Key = std::array<double, 3>;
inline Key key(Vec3 p) { return {p.x + 0.0, p.y + 0.0, p.z + 0.0}; }  // -0 is 0

/// How often each directed edge occurs, by points, over all meshes.
inline std::map<std::pair<Key, Key>, int> directed_edges(const std::vector<Mesh>& meshes) {
  std::map<std::pair<Key, Key>, int> edges;
  for (const Mesh& mesh : meshes) {
    for (const auto& t : mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) {
        ++edges[{key(mesh.vertices[t[k]].point), key(mesh.vertices[t[(k + 1) % 3]].point)}];
      }
    }
  }
  return edges;
}

/// Edges that have no partner in the other direction: open borders, cracks, T-joints.
inline std::vector<std::pair<Key, Key>> open_edges(const std::vector<Mesh>& meshes) {
  const auto edges = directed_edges(meshes);
  std::vector<std::pair<Key, Key>> open;
  for (const auto& [edge, count] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (back == edges.end() || back->second != count) open.push_back(edge);
  }
  return open;
}

inline double volume(const std::vector<Mesh>& meshes, Vec3 from = {}) {
  double six = 0.0;
  for (const Mesh& mesh : meshes) {
    for (const auto& t : mesh.triangles) {
      six += dot(mesh.vertices[t[0]].point - from,
                 cross(mesh.vertices[t[1]].point - from, mesh.vertices[t[2]].point - from));
    }
  }
  return six / 6.0;
}

inline double area(const Mesh& mesh) {
  double two = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]].point;
    two += norm(cross(mesh.vertices[t[1]].point - a, mesh.vertices[t[2]].point - a));
  }
  return two / 2.0;
}

/// Smallest sine-like height of a triangle: twice the area over the square of the longest edge.
inline double slimmest(const Mesh& mesh) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]].point, b = mesh.vertices[t[1]].point,
               c = mesh.vertices[t[2]].point;
    const double longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
    least = std::min(least, norm(cross(b - a, c - a)) / (longest * longest));
  }
  return least;
}

/// Triangles whose own normal looks away from one of their vertices' normals.
inline std::size_t turned_over(const Mesh& mesh) {
  std::size_t count = 0;
  for (const auto& t : mesh.triangles) {
    const MeshVertex &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const Vec3 n = cross(b.point - a.point, c.point - a.point);
    if (!(dot(n, a.normal) > 0.0 && dot(n, b.normal) > 0.0 && dot(n, c.normal) > 0.0)) ++count;
  }
  return count;
}

/// Largest angle between the normals at the ends of an edge, rad.
inline double largest_angle(const Mesh& mesh) {
  double largest = 0.0;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = mesh.vertices[t[k]].normal, b = mesh.vertices[t[(k + 1) % 3]].normal;
      largest = std::max(largest, 2.0 * std::asin(std::min(1.0, norm(a - b) / 2.0)));
    }
  }
  return largest;
}

inline double distance_to_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 n = cross(b - a, c - a);
  const auto to_edge = [&](Vec3 from, Vec3 to) {
    const Vec3 way = to - from;
    const double part = std::clamp(dot(p - from, way) / dot(way, way), 0.0, 1.0);
    return norm(p - from - part * way);
  };
  const bool inside = dot(cross(b - a, p - a), n) >= 0.0 && dot(cross(c - b, p - b), n) >= 0.0 &&
                      dot(cross(a - c, p - c), n) >= 0.0;
  if (inside) return std::fabs(dot(p - a, n)) / norm(n);
  return std::min({to_edge(a, b), to_edge(b, c), to_edge(c, a)});
}

/// Largest distance of random points of the surface from the triangles: the other way round than
/// the library measures, all triangles against all points.
inline double distance_from_mesh(const NurbsSurface& surface, const Mesh& mesh, int points,
                                 unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  double worst = 0.0;
  for (int k = 0; k < points; ++k) {
    double u = part(random), v = part(random);
    if (k % 10 == 0) u = k % 20 == 0 ? 0.0 : 1.0;  // borders as well
    if (k % 10 == 5) v = k % 20 == 5 ? 0.0 : 1.0;
    const Vec3 p = evaluate(surface, domain_u(surface).at(u), domain_v(surface).at(v)).point;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& t : mesh.triangles) {
      least = std::min(least,
                       distance_to_triangle(p, mesh.vertices[t[0]].point, mesh.vertices[t[1]].point,
                                            mesh.vertices[t[2]].point));
    }
    worst = std::max(worst, least);
  }
  return worst;
}

}  // namespace obvid::checks
