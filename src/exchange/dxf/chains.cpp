// SPDX-License-Identifier: Apache-2.0
// Entities that meet end to end: docs/methods/dxf.md, section 4.
#include "dxf/chains.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "obvid/geom/internal/box.h"

namespace obvid::dxf {
namespace {

/// Ends meet within this part of the size of the drawing: six digits are what the coarser programs
/// print.
constexpr double kMeet = 1e-6;
/// Ends that are the same but for rounding, of centre, radius and angles where an arc gives them:
/// part of the largest coordinate.
constexpr double kSameButRounding = 16.0 * std::numeric_limits<double>::epsilon();
constexpr std::size_t kNoPlace = std::numeric_limits<std::size_t>::max();

struct GridCell {
  std::int64_t x = 0, y = 0;
  std::size_t layer = 0;
  friend bool operator==(const GridCell&, const GridCell&) = default;
};

struct CellHash {
  std::size_t operator()(const GridCell& c) const {
    std::uint64_t h = static_cast<std::uint64_t>(c.x) * 0x9E3779B97F4A7C15ULL;
    h = (h ^ (h >> 32U) ^ static_cast<std::uint64_t>(c.y)) * 0xC2B2AE3D27D4EB4FULL;
    h = (h ^ (h >> 29U) ^ c.layer) * 0x165667B19E3779F9ULL;
    return static_cast<std::size_t>(h ^ (h >> 32U));
  }
};

/// Numbers places: points no farther apart than the tolerance share one. The first point of a cell
/// stands for all of them, so the time does not depend on how they crowd.
class Places {
 public:
  Places(Vec2 low, double tolerance) : low_(low), tolerance_(tolerance) {}

  std::size_t of(Vec2 p, std::size_t layer) {
    const GridCell here = {index(p.x - low_.x), index(p.y - low_.y), layer};
    for (std::int64_t dx = -1; dx <= 1; ++dx) {
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        const auto found = cells_.find({here.x + dx, here.y + dy, layer});
        if (found == cells_.end()) continue;
        const auto& [place, point] = found->second;
        if ((dx == 0 && dy == 0) || norm(p - point) <= tolerance_) return place;
      }
    }
    cells_.emplace(here, std::pair(count_, p));
    return count_++;
  }

 private:
  [[nodiscard]] std::int64_t index(double distance) const {
    return tolerance_ > 0.0 ? static_cast<std::int64_t>(std::floor(distance / tolerance_)) : 0;
  }

  Vec2 low_;
  double tolerance_;
  std::unordered_map<GridCell, std::pair<std::size_t, Vec2>, CellHash> cells_;
  std::size_t count_ = 0;
};

/// A point that is the same from both directions.
Vec2 place_half_way(const std::vector<Piece>& pieces) {
  const std::size_t half = pieces.size() / 2;
  return pieces.size() % 2 == 0 ? start_point(pieces[half]) : evaluate(pieces[half], 0.5).point;
}

class Joiner {
 public:
  explicit Joiner(const std::vector<Link>& links) : links_(links) {}

  Chains run() {
    measure();
    place_ = places_within(out_.tolerance);
    drop_duplicates();
    other_.assign(place_.size(), kNoPlace);
    pair_ends(places_within(same_));
    pair_ends(place_);
    for (std::size_t i = 0; i < links_.size(); ++i) {
      if (!used_[i]) out_.chains.push_back(chain_from(i));
    }
    return std::move(out_);
  }

 private:
  void measure() {
    Box2 box;
    for (const Link& link : links_) {
      for (const Piece& piece : link.pieces) {
        for (const double t : {0.0, 0.5, 1.0}) box.add(evaluate(piece, t).point);
      }
    }
    if (links_.empty()) return;
    out_.tolerance = kMeet * box.diagonal();
    low_ = box.low;
    same_ = kSameButRounding * std::max({std::abs(box.low.x), std::abs(box.low.y),
                                         std::abs(box.high.x), std::abs(box.high.y)});
  }

  /// Of the two ends of each link, below the number of ends; kNoPlace of what is closed by itself.
  [[nodiscard]] std::vector<std::size_t> places_within(double tolerance) const {
    Places places(low_, tolerance);
    std::vector<std::size_t> out(2 * links_.size(), kNoPlace);
    for (std::size_t i = 0; i < links_.size(); ++i) {
      if (links_[i].closed) continue;
      out[2 * i] = places.of(start_point(links_[i].pieces.front()), links_[i].layer);
      out[2 * i + 1] = places.of(end_point(links_[i].pieces.back()), links_[i].layer);
    }
    return out;
  }

  /// Closed within the tolerance, or as small as it.
  [[nodiscard]] bool is_small(std::size_t link) const {
    return place_[2 * link] == place_[2 * link + 1];
  }

  void drop_duplicates() {
    used_.assign(links_.size(), false);
    using Row = std::tuple<std::size_t, std::size_t, double, double, std::size_t>;
    std::vector<Row> rows;
    for (std::size_t i = 0; i < links_.size(); ++i) {
      const std::size_t a = place_[2 * i], b = place_[2 * i + 1];
      if (is_small(i)) continue;
      const Vec2 middle = place_half_way(links_[i].pieces);
      rows.emplace_back(std::min(a, b), std::max(a, b), middle.x, middle.y, i);
    }
    std::sort(rows.begin(), rows.end());
    for (std::size_t k = 1; k < rows.size(); ++k) {
      const auto& [a, b, x, y, i] = rows[k];
      const auto& [a0, b0, x0, y0, i0] = rows[k - 1];
      if (a != a0 || b != b0 || norm(Vec2{x - x0, y - y0}) > out_.tolerance) continue;
      used_[i] = true;
      ++out_.duplicates;
    }
  }

  /// The only other end at the place of each end that has none yet.
  void pair_ends(const std::vector<std::size_t>& place) {
    std::vector<std::array<std::size_t, 2>> ends(place.size());
    std::vector<std::size_t> count(place.size(), 0);
    for (std::size_t e = 0; e < place.size(); ++e) {
      const bool alone = place[e] == place[e ^ 1U] && other_[e ^ 1U] == kNoPlace;
      if (used_[e / 2] || other_[e] != kNoPlace || alone) continue;
      const std::size_t k = count[place[e]]++;
      if (k < 2) ends[place[e]][k] = e;
    }
    for (std::size_t p = 0; p < ends.size(); ++p) {
      if (count[p] != 2) continue;
      other_[ends[p][0]] = ends[p][1];
      other_[ends[p][1]] = ends[p][0];
    }
  }

  /// From the start of this link back as far as it goes, then forward. The link is the first one of
  /// the file, so it gives the direction.
  Chain chain_from(std::size_t link) {
    Chain chain;
    if (is_small(link) && other_[2 * link] == kNoPlace && other_[2 * link + 1] == kNoPlace) {
      const Vec2 gap =
          end_point(links_[link].pieces.back()) - start_point(links_[link].pieces.front());
      chain.closed = links_[link].closed || meets(link, gap);
      used_[link] = true;
      chain.members.push_back({link, false});
      return chain;
    }
    std::size_t first = 2 * link;  // the end that is entered
    while (other_[first] != kNoPlace) {
      first = other_[first] ^ 1U;
      chain.closed = first == 2 * link;
      if (chain.closed) break;
    }
    for (std::size_t e = first; e != kNoPlace;) {
      used_[e / 2] = true;
      chain.members.push_back({e / 2, e % 2 == 1});
      e = other_[e ^ 1U];
      if (e == first) break;
    }
    return chain;
  }

  /// Whether a link that begins and ends at one place is closed: against its own size, too.
  [[nodiscard]] bool meets(std::size_t link, Vec2 gap) const {
    Vec2 start = start_point(links_[link].pieces.front());
    double size = 0.0;
    for (const Piece& piece : links_[link].pieces) {
      size = std::max(
          {size, norm(evaluate(piece, 0.5).point - start), norm(end_point(piece) - start)});
    }
    return norm(gap) <= kMeet * size;
  }

  const std::vector<Link>& links_;
  Chains out_;
  Vec2 low_;
  double same_ = 0.0;               ///< ends so near each other are one
  std::vector<std::size_t> place_;  ///< of the two ends of each link, within the tolerance
  std::vector<std::size_t> other_;  ///< the end that meets each end; kNoPlace: none
  std::vector<bool> used_;
};

}  // namespace

Chains join(const std::vector<Link>& links) { return Joiner(links).run(); }

}  // namespace obvid::dxf
