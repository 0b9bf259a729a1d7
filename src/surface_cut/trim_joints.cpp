// SPDX-License-Identifier: Apache-2.0
#include "trim_joints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "obvid/curve/internal/basis.h"
#include "obvid/geom/internal/box.h"
#include "obvid/geom/internal/chord.h"
#include "obvid/geom/internal/polygon.h"
#include "obvid/surface/internal/trim.h"

namespace obvid::afloat {
namespace {

constexpr int kChordsOfSpan = 16;
constexpr double kMeetsAtTrims = 1e-6;     ///< of the size, beside what the trims are known within
constexpr double kAlongEachOther = 0.866;  ///< cosine
constexpr double kNoChord = 1e-9;          ///< of the size: poles have no direction

/// A short part of a boundary.
struct BoundaryChord {
  std::size_t patch = 0, curve = 0;
  Range t;
  Vec3 from, to, middle;
  Vec3 along;            ///< length 1
  double bent = 0.0;     ///< units: how far the curve may be from the chord
  std::size_t next = 0;  ///< index of the chord that goes on
};

struct Boundary {
  std::size_t patch = 0;
  const NurbsCurve* curve = nullptr;
};

Vec3 on_patch(const NurbsSurface& s, const NurbsCurve& curve, double t) {
  const Vec2 p = evaluate(curve, t).point;
  return evaluate(s, p.x, p.y).point;
}

/// Polygon through a loop in the plane of the parameters.
std::vector<Vec2> polygon_of(const TrimLoop& loop) {
  std::vector<Vec2> out;
  for (const NurbsCurve& curve : loop.curves) {
    const std::vector<double> spans = distinct(curve.knots);
    for (std::size_t s = 1; s < spans.size(); ++s) {
      for (int k = 0; k < kChordsOfSpan; ++k) {
        const double part = static_cast<double>(k) / kChordsOfSpan;
        out.push_back(evaluate(curve, Range{spans[s - 1], spans[s]}.at(part)).point);
      }
    }
  }
  return out;
}

/// What is there lies to the left, whatever a file says: outer loops run counter-clockwise.
std::vector<TrimLoop> oriented_loops(const SurfacePatch& patch) {
  if (patch.trims.empty()) return {outline_of(patch.surface)};
  std::vector<TrimLoop> out = patch.trims;
  std::vector<std::vector<Vec2>> polygons;
  for (const TrimLoop& loop : out) polygons.push_back(polygon_of(loop));
  for (std::size_t i = 0; i < out.size(); ++i) {
    // loops may touch: what most of some places say
    constexpr std::size_t kPlaces = 9;
    std::size_t within = 0;
    for (std::size_t k = 0; k < kPlaces; ++k) {
      const Vec2 p = polygons[i][k * polygons[i].size() / kPlaces];
      bool odd = false;
      for (std::size_t j = 0; j < out.size(); ++j) {
        if (j != i && is_in_polygon(polygons[j], p)) odd = !odd;
      }
      within += odd ? 1 : 0;
    }
    const bool hole = 2 * within > kPlaces;
    if ((area_of_polygon(polygons[i]) < 0.0) == hole) continue;
    std::reverse(out[i].curves.begin(), out[i].curves.end());
    for (NurbsCurve& curve : out[i].curves) curve = reversed(curve);
  }
  return out;
}

/// Chords by the cells of a raster that their boxes are in.
class ChordRaster {
 public:
  ChordRaster(const std::vector<BoundaryChord>& chords, const Box3& box, double more) {
    constexpr double kMostCells = 64.0;  // along a side: of some thousand chords few a cell
    step_ = std::max(box.diagonal() / kMostCells, 4.0 * more);
    low_ = box.low - Vec3{more, more, more};
    for (std::size_t i = 0; i < chords.size(); ++i) {
      Box3 own;
      own.add(chords[i].from);
      own.add(chords[i].to);
      const double wide = more + chords[i].bent;
      const Cell a = cell_of(own.low - Vec3{wide, wide, wide});
      const Cell b = cell_of(own.high + Vec3{wide, wide, wide});
      for (int x = a[0]; x <= b[0]; ++x) {
        for (int y = a[1]; y <= b[1]; ++y) {
          for (int z = a[2]; z <= b[2]; ++z) cells_[{x, y, z}].push_back(i);
        }
      }
    }
  }
  [[nodiscard]] const std::vector<std::size_t>& near(Vec3 p) const {
    static const std::vector<std::size_t> kNone;
    const auto found = cells_.find(cell_of(p));
    return found == cells_.end() ? kNone : found->second;
  }

 private:
  using Cell = std::array<int, 3>;
  [[nodiscard]] Cell cell_of(Vec3 p) const {
    const auto at = [&](double x) { return static_cast<int>(std::floor(x / step_)); };
    return {at(p.x - low_.x), at(p.y - low_.y), at(p.z - low_.z)};
  }
  Vec3 low_;
  double step_ = 1.0;
  std::map<Cell, std::vector<std::size_t>> cells_;
};

class JointFinder {
 public:
  explicit JointFinder(const SurfaceModel& model) : model_(model), size_(size_of(model)) {}

  Result<TrimJoints> found(const RunContext& run) {
    for (const SurfacePatch& patch : model_.patches) out_.loops.push_back(oriented_loops(patch));
    for (std::size_t i = 0; i < model_.patches.size(); ++i) {
      for (const TrimLoop& loop : out_.loops[i]) add_chords(i, loop);
    }
    double widest = 0.0;
    for (const SurfacePatch& patch : model_.patches) widest = std::max(widest, patch.trims_within);
    Box3 box;
    for (const BoundaryChord& chord : chords_) {
      box.add(chord.from);
      box.add(chord.to);
    }
    const ChordRaster raster(chords_, box, kMeetsAtTrims * size_ + 2.0 * widest);
    std::vector<bool> meets(chords_.size(), false);
    constexpr std::size_t kBetweenQuestions = 1024;
    for (std::size_t i = 0; i < chords_.size(); ++i) {
      if (i % kBetweenQuestions == 0) OBVID_TRY(may_go_on(run));
      meets[i] = look_at(i, raster.near(chords_[i].middle));
    }
    turn();
    add_open(meets);
    return std::move(out_);
  }

 private:
  void add_chords(std::size_t patch, const TrimLoop& loop) {
    const NurbsSurface& s = model_.patches[patch].surface;
    const std::size_t first = chords_.size();
    for (const NurbsCurve& curve : loop.curves) {
      const std::vector<double> spans = distinct(curve.knots);
      for (std::size_t i = 1; i < spans.size(); ++i) {
        for (int k = 0; k < kChordsOfSpan; ++k) {
          BoundaryChord chord;
          const Range span{spans[i - 1], spans[i]};
          chord.patch = patch;
          chord.curve = boundaries_.size();
          chord.t = {span.at(static_cast<double>(k) / kChordsOfSpan),
                     span.at(static_cast<double>(k + 1) / kChordsOfSpan)};
          chord.from = on_patch(s, curve, chord.t.from);
          chord.to = on_patch(s, curve, chord.t.to);
          chord.middle = on_patch(s, curve, chord.t.at(0.5));
          const Vec3 way = chord.to - chord.from;
          if (!(norm(way) > kNoChord * size_)) continue;
          chord.along = unit(way);
          chord.bent = 2.0 * norm(chord.middle - 0.5 * (chord.from + chord.to));
          chord.next = chords_.size() + 1;
          chords_.push_back(chord);
        }
      }
      boundaries_.push_back({patch, &curve});
    }
    if (chords_.size() > first) chords_.back().next = first;
  }

  /// How far a place is from the curve of a chord, from the chord on.
  [[nodiscard]] double distance(const BoundaryChord& chord, Vec3 p) const {
    const NurbsCurve& curve = *boundaries_[chord.curve].curve;
    const NurbsSurface& s = model_.patches[chord.patch].surface;
    const Range all{curve.knots.front(), curve.knots.back()};
    double t = chord.t.at(part_of_chord(p, chord.from, chord.to));
    double least = std::numeric_limits<double>::infinity();
    constexpr int kSteps = 6;
    for (int k = 0; k < kSteps; ++k) {
      const auto at = evaluate(curve, t);
      const SurfaceJet jet = evaluate(s, at.point.x, at.point.y);
      const Vec3 off = p - jet.point, d = at.d1.x * jet.du + at.d1.y * jet.dv;
      least = std::min(least, norm(off));
      const double square = dot(d, d);
      if (!(square > 0.0)) break;
      t = std::clamp(t + dot(off, d) / square, all.from, all.to);
    }
    return least;
  }

  /// Whether another boundary, or another part of the own one, runs there; notes which.
  bool look_at(std::size_t number, const std::vector<std::size_t>& others) {
    const BoundaryChord& own = chords_[number];
    std::vector<std::pair<std::size_t, double>> there;  // boundary, and 1 or -1
    for (const std::size_t k : others) {
      const BoundaryChord& other = chords_[k];
      if (k == number || k == own.next || other.next == number) continue;
      const double turn = dot(own.along, other.along);
      if (std::abs(turn) < kAlongEachOther) continue;
      const double enough = kMeetsAtTrims * size_ + model_.patches[own.patch].trims_within +
                            model_.patches[other.patch].trims_within;
      if (distance_from_chord(own.middle, other.from, other.to) > other.bent + enough) continue;
      if (other.curve == own.curve && turn > 0.0) continue;  // beside it on the same line
      if (distance(other, own.middle) > enough) continue;
      const std::pair<std::size_t, double> one{other.curve, turn > 0.0 ? 1.0 : -1.0};
      if (std::find(there.begin(), there.end(), one) == there.end()) there.push_back(one);
    }
    if (there.size() == 1) {
      const std::size_t patch = boundaries_[there[0].first].patch;
      along_[{own.patch, patch}] += there[0].second * norm(own.to - own.from);
    }
    return !there.empty();
  }

  void turn() {
    Turned& turned = out_.turned;
    const std::size_t count = model_.patches.size();
    turned = {std::vector<double>(count, 0.0), std::vector<std::size_t>(count, 0), 0, 0};
    for (std::size_t first = 0; first < count; ++first) {
      if (turned.sign[first] != 0.0) continue;
      std::vector<std::size_t> open{first};
      turned.sign[first] = 1.0;
      turned.part[first] = turned.parts;
      while (!open.empty()) {
        const std::size_t patch = open.back();
        open.pop_back();
        for (auto at = along_.lower_bound({patch, 0}); at != along_.end(); ++at) {
          const std::size_t other = at->first.second;
          if (at->first.first != patch) break;
          if (other == patch) continue;
          // neighbours on one side of a body run along their border in opposite directions
          const double wanted = at->second < 0.0 ? turned.sign[patch] : -turned.sign[patch];
          if (turned.sign[other] == 0.0) {
            turned.sign[other] = wanted;
            turned.part[other] = turned.parts;
            open.push_back(other);
          } else if (turned.sign[other] != wanted && patch < other) {
            ++turned.twisted;
          }
        }
      }
      ++turned.parts;
    }
  }

  /// Runs of chords that meet nothing.
  void add_open(const std::vector<bool>& meets) {
    const auto vertex = [&](Vec3 p) {
      for (std::size_t i = 0; i < out_.open.vertices.size(); ++i) {
        if (norm(out_.open.vertices[i].point - p) <= kMeetsAtTrims * size_) return i;
      }
      out_.open.vertices.push_back({p, 0.0});
      return out_.open.vertices.size() - 1;
    };
    std::vector<bool> done = meets;
    const auto add = [&](std::size_t first) {
      SpaceCurve line;
      line.degree = 1;
      line.points = {chords_[first].from};
      for (std::size_t i = first; !done[i]; i = chords_[i].next) {
        done[i] = true;
        line.points.push_back(chords_[i].to);
      }
      line.knots = {0.0};
      for (std::size_t k = 0; k < line.points.size(); ++k) {
        line.knots.push_back(static_cast<double>(k));
      }
      line.knots.push_back(static_cast<double>(line.points.size() - 1));
      TopologyEdge edge;
      edge.from = vertex(line.points.front());
      edge.to = vertex(line.points.back());
      edge.curve = std::move(line);
      edge.uses = {{chords_[first].patch, kUStart, true, false, 0.0}};
      out_.open.edges.push_back(std::move(edge));
    };
    // from the chord after one that meets something, then rings
    std::vector<bool> goes_on(chords_.size(), false);
    for (std::size_t i = 0; i < chords_.size(); ++i) {
      if (!meets[i]) goes_on[chords_[i].next] = true;
    }
    for (std::size_t i = 0; i < chords_.size(); ++i) {
      if (!done[i] && !goes_on[i]) add(i);
    }
    for (std::size_t i = 0; i < chords_.size(); ++i) {
      if (!done[i]) add(i);
    }
  }

  const SurfaceModel& model_;
  double size_;
  TrimJoints out_;
  std::vector<Boundary> boundaries_;
  std::vector<BoundaryChord> chords_;
  std::map<std::pair<std::size_t, std::size_t>, double> along_;
};

}  // namespace

Result<TrimJoints> trim_joints_of(const SurfaceModel& model, const RunContext& run) {
  return JointFinder(model).found(run);
}

}  // namespace obvid::afloat
