// SPDX-License-Identifier: Apache-2.0
#include "joined_curves.h"

#include <algorithm>
#include <utility>

#include "obvid/numeric/internal/disjoint_sets.h"

namespace obvid::cutting {
namespace {

/// Of a chain's length: ends nearer to each other look as if they were meant to meet.
constexpr double kSmallGap = 0.01;

/// Ends by their numbers: 2 i where curve i begins, 2 i + 1 where it ends.
Vec2 end_of(const std::vector<ArcPath>& curves, std::size_t end) {
  const ArcPath& curve = curves[end / 2];
  return end % 2 == 0 ? start_point(curve.pieces.front()) : end_point(curve.pieces.back());
}

/// Calls `look(a, b, distance)` for all ends nearer than `reach` to each other.
template <class Look>
void near_ends(const std::vector<ArcPath>& curves, double reach, const Look& look) {
  std::vector<std::pair<Vec2, std::size_t>> ends;
  for (std::size_t i = 0; i < 2 * curves.size(); ++i) ends.emplace_back(end_of(curves, i), i);
  std::sort(ends.begin(), ends.end(),
            [](const auto& a, const auto& b) { return a.first.x < b.first.x; });
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t j = i + 1; j < ends.size() && ends[j].first.x - ends[i].first.x <= reach;
         ++j) {
      const double distance = norm(ends[j].first - ends[i].first);
      if (distance <= reach) look(ends[i].second, ends[j].second, distance);
    }
  }
}

/// The same line or arc, turned and scaled to other ends.
Piece between(const Piece& piece, Vec2 start, Vec2 end) {
  const auto* arc = std::get_if<ArcPiece>(&piece);
  if (arc == nullptr) return LinePiece{start, end};
  const Vec2 before = arc->end - arc->start, now = end - start;
  const double scale = norm(now) / norm(before);
  return ArcPiece{start, end, arc->theta0 + turning(before, now), arc->kappa / scale,
                  arc->length * scale};
}

struct Met {
  ClosedGap gap;
  std::optional<Piece> line;  ///< that has to lead from one to the other
};

/// Lets a piece end where the other one starts.
Met meet(Piece& piece, Piece& next) {
  constexpr double kLonger =
      10.0;  // times the gap: ends then turn by less than a tenth of a radian
  const Vec2 from = end_point(piece), to = start_point(next);
  Met out;
  out.gap.width = norm(to - from);
  if (out.gap.width == 0.0) return out;
  const auto is_long = [&](const Piece& one) {
    return norm(end_point(one) - start_point(one)) >= kLonger * out.gap.width;
  };
  if (!is_long(piece) || !is_long(next)) {
    out.line = LinePiece{from, to};
    return out;
  }
  const Vec2 middle = 0.5 * (from + to);
  piece = between(piece, start_point(piece), middle);
  next = between(next, middle, end_point(next));
  out.gap.moved = 0.5 * out.gap.width;
  return out;
}

void count_in(JoinedCurves::Chain& chain, const ClosedGap& gap) {
  chain.largest_gap = std::max(chain.largest_gap, gap.width);
  chain.moved = std::max(chain.moved, gap.moved);
}

void append(JoinedCurves::Chain& chain, ArcPath next) {
  std::vector<Piece>& pieces = chain.path.pieces;
  if (!pieces.empty()) {
    const Met met = meet(pieces.back(), next.pieces.front());
    count_in(chain, met.gap);
    if (met.line) pieces.push_back(*met.line);
  }
  pieces.insert(pieces.end(), next.pieces.begin(), next.pieces.end());
}

}  // namespace

ClosedGap close_gap(ArcPath& path) {
  const Met met = meet(path.pieces.back(), path.pieces.front());
  if (met.line) path.pieces.push_back(*met.line);
  path.closed = true;
  return met.gap;
}

JoinedCurves joined_curves(const std::vector<ArcPath>& open, double within) {
  const std::size_t ends = 2 * open.size();
  numeric::DisjointSets places(ends);
  near_ends(open, within, [&](std::size_t a, std::size_t b, double) { places.join(a, b); });
  std::vector<std::vector<std::size_t>> at(ends);  // ends that meet, by the first of them
  for (std::size_t i = 0; i < ends; ++i) at[places.find(i)].push_back(i);
  const auto partner = [&](std::size_t end) -> std::optional<std::size_t> {
    const auto& here = at[places.find(end)];
    if (here.size() != 2 || here[0] / 2 == here[1] / 2) return std::nullopt;
    return here[0] == end ? here[1] : here[0];
  };

  JoinedCurves out;
  std::vector<bool> taken(open.size(), false);
  std::vector<std::size_t> begins, finishes;  // ends of chains
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (taken[i]) continue;
    // back to where the chain of this curve begins
    std::size_t first = 2 * i;
    for (auto before = partner(first); before && *before / 2 != i; before = partner(first)) {
      first = *before ^ 1U;
    }
    const bool loop = partner(first).has_value();
    JoinedCurves::Chain chain;
    std::size_t end = loop ? 2 * i : first;
    const std::size_t begin = end;
    while (true) {
      const std::size_t curve = end / 2;
      taken[curve] = true;
      chain.members.push_back(curve);
      append(chain, end % 2 == 0 ? open[curve] : reversed(open[curve]));
      const auto following = partner(end ^ 1U);
      end ^= 1U;
      if (!following || *following == begin) break;
      end = *following;
    }
    if (loop) count_in(chain, close_gap(chain.path));
    begins.push_back(begin);
    finishes.push_back(end);
    out.chains.push_back(std::move(chain));
  }

  numeric::DisjointSets parts(ends);
  for (std::size_t k = 0; k < out.chains.size() && !out.enclosing; ++k) {
    if (out.chains[k].path.closed) continue;
    if (!parts.join(places.find(begins[k]), places.find(finishes[k]))) out.enclosing = k;
  }

  std::vector<ArcPath> left;
  std::vector<std::size_t> numbers;
  double longest = 0.0;
  for (std::size_t k = 0; k < out.chains.size(); ++k) {
    if (out.chains[k].path.closed) continue;
    left.push_back(out.chains[k].path);
    numbers.push_back(k);
    longest = std::max(longest, length_of(left.back()));
  }
  near_ends(left, kSmallGap * longest, [&](std::size_t a, std::size_t b, double distance) {
    const std::size_t one = std::min(a, b) / 2, other = std::max(a, b) / 2;
    const double length = std::min(length_of(left[one]), length_of(left[other]));
    if (distance <= within || distance > kSmallGap * length) return;
    if (one == other && left[one].pieces.size() < 2) return;
    out.gaps.push_back({numbers[one], numbers[other], distance});
  });
  std::sort(out.gaps.begin(), out.gaps.end(), [](const auto& a, const auto& b) {
    return std::pair(a.one, a.other) < std::pair(b.one, b.other);
  });
  return out;
}

}  // namespace obvid::cutting
