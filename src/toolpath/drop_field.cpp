// SPDX-License-Identifier: Apache-2.0
#include "drop_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "obvid/core/internal/parallel.h"

namespace obvid::toolpath {
namespace {

constexpr std::uint32_t kLeaf = 4;  // triangles
/// Boxes whose trees are built side by side: enough that threads end at about the same time.
constexpr std::size_t kBoxesSharedOut = 64;
constexpr std::size_t kTakenTogether = 4096;  // triangles, for the thread that takes them
/// Boxes halve what they hold: 2^32 triangles are 32 deep, and each leaves one waiting.
constexpr std::size_t kDeepestBox = 64;
constexpr double kLeastLid = 0.1;  // z of unit normals: steeper lids gain nothing
constexpr double kNone = -std::numeric_limits<double>::infinity();

double middle_of(const FieldTriangle& t, bool of_x) {
  const auto& c = t.corners;
  return of_x ? c[0].x + c[1].x + c[2].x : c[0].y + c[1].y + c[2].y;
}

double top_of(const Triangle& t) { return std::max({t[0].z, t[1].z, t[2].z}); }

double apart(double p, double low, double high) { return std::max({low - p, p - high, 0.0}); }

/// Of a tip over the top of a flat lid whose nearest place lies that far from the axis.
double under_top(const CutterShape& cutter, double top, double apart2) {
  if (apart2 > cutter.radius * cutter.radius) return kNone;
  const double flat = cutter.flat();
  return apart2 <= flat * flat ? top : top - cutter.height(std::sqrt(apart2));
}

/// Greatest tip height that a triangle can cause, at least.
double ceiling(const CutterShape& cutter, Vec2 axis, const Triangle& t) {
  const double dx =
      apart(axis.x, std::min({t[0].x, t[1].x, t[2].x}), std::max({t[0].x, t[1].x, t[2].x}));
  const double dy =
      apart(axis.y, std::min({t[0].y, t[1].y, t[2].y}), std::max({t[0].y, t[1].y, t[2].y}));
  return under_top(cutter, top_of(t), dx * dx + dy * dy);
}

}  // namespace

double DropField::Box::apart2(Vec2 p) const {
  const double dx = apart(p.x, low.x, high.x), dy = apart(p.y, low.y, high.y);
  return dx * dx + dy * dy;
}

// A cutter rests on a plane of slope s by corner * (sqrt(1 + s^2) - 1) + flat * s above it.
double DropField::Box::ceiling(const CutterShape& cutter, Vec2 axis) const {
  const double by_top = under_top(cutter, top, apart2(axis));
  const double by_lid =
      lid + lean_x * axis.x + lean_y * axis.y + cutter.corner * stretch + cutter.flat() * slope;
  return std::min(by_top, by_lid);
}

DropField::DropField(const std::vector<Mesh>& meshes, std::size_t threads) {
  take(meshes, threads);
  mark_sides(meshes, triangles_);
  build(threads);
}

void DropField::take(const std::vector<Mesh>& meshes, std::size_t threads) {
  std::size_t count = 0;
  for (const Mesh& mesh : meshes) count += mesh.triangles.size();
  triangles_ = large_list<FieldTriangle>(count, {}, threads);
  box_ = {};
  std::size_t first = 0;
  for (std::uint32_t m = 0; m < meshes.size(); ++m) {
    const Mesh& mesh = meshes[m];
    std::vector<Box3> boxes((mesh.triangles.size() + kTakenTogether - 1) / kTakenTogether);
    in_lots(mesh.triangles.size(), kTakenTogether, threads, [&](std::size_t from, std::size_t to) {
      Box3 box;
      for (std::size_t i = from; i < to; ++i) {
        FieldTriangle& t = triangles_[first + i];
        for (std::size_t k = 0; k < 3; ++k) {
          t.corners[k] = mesh.vertices[mesh.triangles[i][k]].point;
          box.add(t.corners[k]);
        }
        t.mesh = m;
        t.number = static_cast<std::uint32_t>(i);
      }
      boxes[from / kTakenTogether] = box;
    });
    for (const Box3& box : boxes) {
      box_.add_box(box);
    }
    first += mesh.triangles.size();
  }
}

void DropField::bound(Box& box, std::uint32_t first, std::uint32_t count) const {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  box.low = {kFar, kFar};
  box.high = {-kFar, -kFar};
  box.top = -kFar;
  Vec3 upwards;
  for (std::uint32_t i = first; i < first + count; ++i) {
    const Triangle& t = triangles_[i].corners;
    for (const Vec3 p : t) {
      box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
      box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
      box.top = std::max(box.top, p.z);
    }
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
    upwards = n.z < 0.0 ? upwards - n : upwards + n;
  }
  box.lid = box.top;
  if (!(upwards.z > kLeastLid * norm(upwards))) return;
  box.lean_x = -upwards.x / upwards.z;
  box.lean_y = -upwards.y / upwards.z;
  box.slope = std::sqrt(box.lean_x * box.lean_x + box.lean_y * box.lean_y);
  box.stretch = std::sqrt(1.0 + box.slope * box.slope) - 1.0;
  box.lid = -kFar;
  for (std::uint32_t i = first; i < first + count; ++i) {
    for (const Vec3 p : triangles_[i].corners) {
      box.lid = std::max(box.lid, p.z - box.lean_x * p.x - box.lean_y * p.y);
    }
  }
}

// The first boxes are divided one round after another until there are enough of them to be shared
// out; each is then a tree of its own.
void DropField::build(std::size_t threads) {
  if (triangles_.empty()) return;
  std::vector<Undivided> waiting{{0, 0, static_cast<std::uint32_t>(triangles_.size())}};
  boxes_.emplace_back();
  while (!waiting.empty() && waiting.size() < kBoxesSharedOut) {
    std::vector<Undivided> next;
    for (const Undivided& work : waiting) divide(work, boxes_, next);
    waiting = std::move(next);
  }
  std::vector<std::vector<Box>> trees(waiting.size());
  in_parallel(trees.size(), threads, [&](std::size_t k) {
    std::vector<Undivided> own{{0, waiting[k].first, waiting[k].count}};
    trees[k].emplace_back();
    while (!own.empty()) {
      const Undivided work = own.back();
      own.pop_back();
      divide(work, trees[k], own);
    }
  });
  for (std::size_t k = 0; k < trees.size(); ++k) {  // its first box has a place already
    const auto moved = static_cast<std::uint32_t>(boxes_.size()) - 1;
    for (Box& box : trees[k]) box.first += box.count == 0 ? moved : 0;
    boxes_[waiting[k].box] = trees[k].front();
    boxes_.insert(boxes_.end(), trees[k].begin() + 1, trees[k].end());
  }
}

void DropField::divide(const Undivided& work, std::vector<Box>& boxes,
                       std::vector<Undivided>& waiting) {
  Box box;
  bound(box, work.first, work.count);
  if (work.count <= kLeaf) {
    box.first = work.first;
    box.count = work.count;
    boxes[work.box] = box;
    return;
  }
  const bool of_x = box.high.x - box.low.x > box.high.y - box.low.y;
  const std::uint32_t half = work.count / 2;
  const auto begin = triangles_.begin() + work.first;
  std::nth_element(begin, begin + half, begin + work.count, [of_x](const auto& a, const auto& b) {
    return middle_of(a, of_x) < middle_of(b, of_x);
  });
  box.first = static_cast<std::uint32_t>(boxes.size());
  boxes[work.box] = box;
  boxes.resize(boxes.size() + 2);
  waiting.push_back({box.first, work.first, half});
  waiting.push_back({box.first + 1, work.first + half, work.count - half});
}

std::optional<FieldRest> DropField::drop(const CutterShape& cutter, Vec2 axis) const {
  struct Waiting {
    std::uint32_t box;
    double ceiling;
  };
  const auto ceiling_of = [&](std::uint32_t b) { return boxes_[b].ceiling(cutter, axis); };
  FieldRest best;
  best.rest.tip_z = kNone;
  std::array<Waiting, kDeepestBox> stack;
  std::size_t size = 0;
  if (!boxes_.empty()) stack[size++] = {0, ceiling_of(0)};
  while (size > 0) {
    const Waiting next = stack[--size];
    if (next.ceiling <= best.rest.tip_z) continue;
    const Box& box = boxes_[next.box];
    if (box.count == 0) {
      Waiting a{box.first, ceiling_of(box.first)}, b{box.first + 1, ceiling_of(box.first + 1)};
      const auto mid = [&](const Waiting& w) {  // ties: the nearer box first
        return boxes_[w.box].apart2(axis);
      };
      if (a.ceiling > b.ceiling || (a.ceiling == b.ceiling && mid(a) < mid(b))) std::swap(a, b);
      stack[size++] = a;
      stack[size++] = b;
      continue;
    }
    for (std::uint32_t i = box.first; i < box.first + box.count; ++i) {
      const Triangle& t = triangles_[i].corners;
      if (ceiling(cutter, axis, t) <= best.rest.tip_z) continue;
      if (drop_on(cutter, axis, t, triangles_[i].skipped, best.rest)) best.triangle = i;
    }
  }
  if (best.rest.tip_z == kNone) return std::nullopt;
  return best;
}

std::optional<FieldHeight> DropField::height(Vec2 place) const {
  std::optional<FieldHeight> best;
  std::array<std::uint32_t, kDeepestBox> stack;
  std::size_t size = 0;
  if (!boxes_.empty()) stack[size++] = 0;
  while (size > 0) {
    const Box& box = boxes_[stack[--size]];
    if (box.apart2(place) > 0.0 || (best && box.top <= best->z)) continue;
    if (box.count == 0) {
      stack[size++] = box.first;
      stack[size++] = box.first + 1;
      continue;
    }
    for (std::uint32_t i = box.first; i < box.first + box.count; ++i) {
      FieldHeight found;
      found.triangle = i;
      if (!height_over(triangles_[i].corners, place, found.z, found.weights)) continue;
      if (!best || found.z > best->z) best = found;
    }
  }
  return best;
}

}  // namespace obvid::toolpath
