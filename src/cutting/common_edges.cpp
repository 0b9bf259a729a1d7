// SPDX-License-Identifier: Apache-2.0
#include "common_edges.h"

#include <algorithm>
#include <set>
#include <utility>

namespace obvid::cutting {
namespace {

using Stretch = std::pair<double, double>;  // places of a piece

class CommonSearch {
 public:
  CommonSearch(const std::vector<Track>& tracks, double within)
      : tracks_(tracks), within_(within) {}

  CommonEdges run(Watch& watch) {
    Edges all;
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      if (tracks_[i].side == CutSide::kOn) all.add(tracks_[i].edge, i);
    }
    all.finish();
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      if (tracks_[i].side != CutSide::kOn) continue;
      for (const Piece& piece : tracks_[i].edge.pieces) {
        if (watch.cancelled()) return out_;
        look(i, piece, all);
      }
    }
    out_.crossings = crossing_.size();
    return out_;
  }

 private:
  void look(std::size_t i, const Piece& piece, const Edges& all) {
    std::vector<Stretch> shared;
    for (const Edges::Named& other : all.near_to(piece, within_)) {
      if (other.name >= i) continue;
      const std::size_t known = shared.size();
      share(piece, *other.piece, shared);
      if (shared.size() > known && !out_.first_again) {
        const Stretch& one = shared.back();
        out_.first_again = {other.name, i, evaluate(piece, 0.5 * (one.first + one.second)).point};
      }
      if (shared.size() == known && tracks_[i].edge.closed && tracks_[other.name].edge.closed) {
        cross(i, piece, other);
      }
    }
    std::sort(shared.begin(), shared.end());
    double done = 0.0, sum = 0.0;
    for (const Stretch& one : shared) {
      sum += std::max(0.0, one.second - std::max(done, one.first));
      done = std::max(done, one.second);
    }
    out_.again += sum * length_of(piece);
  }

  /// Between places beside its own ends and those of the other piece.
  void share(const Piece& piece, const Piece& other, std::vector<Stretch>& shared) const {
    std::vector<double> ends{0.0, 1.0, nearest_place(piece, start_point(other)),
                             nearest_place(piece, end_point(other))};
    std::sort(ends.begin(), ends.end());
    const double length = length_of(piece);
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      const double a = ends[k], b = ends[k + 1];
      // what is shorter may be two that cross
      if (!((b - a) * length > kShortest * within_)) continue;
      bool on = true;
      for (int j = 0; on && j <= kParts; ++j) {
        on = distance_from(other, evaluate(piece, a + (b - a) * j / kParts).point) <= within_;
      }
      if (on) shared.emplace_back(a, b);
    }
  }

  void cross(std::size_t i, const Piece& piece, const Edges::Named& other) {
    if (crossing_.contains({other.name, i})) return;
    const auto met = meeting_of(piece, *other.piece);
    if (!met || is_at_end(piece, met->on_first) || is_at_end(*other.piece, met->on_second)) return;
    crossing_.insert({other.name, i});
    if (!out_.first_crossing) {
      out_.first_crossing = {other.name, i, evaluate(piece, met->on_first).point};
    }
  }

  [[nodiscard]] bool is_at_end(const Piece& piece, double place) const {
    return std::min(place, 1.0 - place) * length_of(piece) <= within_;
  }

  static constexpr int kParts = 4;
  static constexpr double kShortest = 10.0;  // of `within`: a stretch on another piece

  const std::vector<Track>& tracks_;
  double within_;
  std::set<std::pair<std::size_t, std::size_t>> crossing_;
  CommonEdges out_;
};

}  // namespace

CommonEdges common_edges(const std::vector<Track>& tracks, double within, Watch& watch) {
  return CommonSearch(tracks, within).run(watch);
}

}  // namespace obvid::cutting
