// SPDX-License-Identifier: Apache-2.0
#include "short_tour.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <numeric>
#include <random>
#include <utility>

namespace obvid::cutting {
namespace {

/// Stops next to which one is tried.
constexpr std::size_t kNeighbours = 10;
/// Stops that are moved together.
constexpr std::size_t kMostTogether = 3;
/// Exchanges at random: so many for each stop, and at least, but in long tours, whose copies cost
/// time, fewer; of parts of so many stops.
constexpr std::size_t kExchangesEach = 20, kFewestExchanges = 1000, kStopsCopied = 4'000'000,
                      kLongestPart = 30;
/// Of a mean way between stops, how much longer a tour may become by them, less and less.
constexpr double kMayBeLonger = 0.5;
/// Of the whole way: rounding.
constexpr double kRoundingOfWay = 1e-12;

class Search {
 public:
  Search(const std::vector<Stop>& stops, std::vector<Turn> tour, Watch& watch)
      : stops_(stops),
        tour_(std::move(tour)),
        at_(stops.size()),
        waits_(stops.size()),
        watch_(watch) {
    place(0, tour_.size());
    least_gain_ = kRoundingOfWay * way_between(stops_, tour_);
    ordered_ = std::any_of(stops_.begin(), stops_.end(),
                           [](const Stop& stop) { return !stop.first.empty(); });
    find_neighbours();
  }

  std::vector<Turn> run() {
    if (tour_.size() < 2) return tour_;
    for (const Turn& turn : tour_) ask_for(turn.stop);
    improve();
    exchange_at_random();
    return tour_;
  }

 private:
  using Index = std::ptrdiff_t;  ///< of the tour; -1 is the origin

  [[nodiscard]] Index size() const { return static_cast<Index>(tour_.size()); }

  [[nodiscard]] Turn turn(Index i) const { return tour_[static_cast<std::size_t>(i)]; }

  [[nodiscard]] Vec2 entered(Turn t) const {
    return t.turned ? stops_[t.stop].end : stops_[t.stop].begin;
  }

  [[nodiscard]] Vec2 left(Turn t) const {
    return t.turned ? stops_[t.stop].begin : stops_[t.stop].end;
  }

  [[nodiscard]] Turn round(Turn t) const { return {t.stop, t.turned != stops_[t.stop].may_turn}; }

  [[nodiscard]] Vec2 left(Index i) const { return i < 0 ? Vec2{} : left(turn(i)); }

  /// Of the way from a place to a stop of the tour; behind the last one there is none.
  [[nodiscard]] double to(Vec2 from, Index i) const {
    return i < size() ? norm(entered(turn(i)) - from) : 0.0;
  }

  [[nodiscard]] double link(Index i, Index j) const { return to(left(i), j); }

  /// From the stop before a part to the one behind it.
  [[nodiscard]] double length(Index from, Index end) const {
    double sum = 0.0;
    for (Index i = from; i <= end; ++i) sum += link(i - 1, i);
    return sum;
  }

  void place(std::size_t from, std::size_t end) {
    for (std::size_t i = from; i < end; ++i) at_[tour_[i].stop] = i;
  }

  void find_neighbours() {
    const std::size_t count = std::min(kNeighbours, stops_.size() - 1);
    std::vector<std::pair<double, std::size_t>> near;
    for (const Stop& stop : stops_) {
      near.clear();
      for (std::size_t k = 0; k < stops_.size(); ++k) {
        const Stop& other = stops_[k];
        if (&other == &stop) continue;
        near.emplace_back(std::min({norm(other.begin - stop.end), norm(other.end - stop.begin),
                                    stop.may_turn ? norm(other.begin - stop.begin) : HUGE_VAL,
                                    stop.may_turn ? norm(other.end - stop.end) : HUGE_VAL}),
                          k);
      }
      std::partial_sort(near.begin(), near.begin() + static_cast<Index>(count), near.end());
      neighbours_.emplace_back();
      for (std::size_t k = 0; k < count; ++k) {
        neighbours_.back().push_back({near[k].first, near[k].second});
      }
    }
  }

  void ask_for(std::size_t stop) {
    if (std::exchange(waits_[stop], std::uint8_t{1}) != 0) return;
    queue_.push_back(stop);
  }

  void ask_around(Index i) {
    for (Index k = std::max<Index>(i - 1, 0); k <= std::min(i + 1, size() - 1); ++k)
      ask_for(turn(k).stop);
  }

  void improve() {
    while (!queue_.empty() && !watch_.cancelled()) {
      const std::size_t stop = queue_.front();
      queue_.pop_front();
      waits_[stop] = 0;
      while (improve_at(stop)) {
      }
    }
  }

  bool improve_at(std::size_t stop) {
    const auto here = static_cast<Index>(at_[stop]);
    if (turn_if_shorter(here, size() - 1) || turn_if_shorter(here, here)) return true;
    const double longest = std::max(link(here - 1, here), link(here, here + 1));
    for (const auto& [away, other] : neighbours_[stop]) {
      if (!(away < longest)) break;  // what gains brings some stop nearer to another one
      const auto there = static_cast<Index>(at_[other]);
      const auto [low, high] = std::minmax(here, there);
      if (turn_if_shorter(low + 1, high) || turn_if_shorter(low, high - 1)) return true;
      if (move_if_shorter(here, there) || move_if_shorter(there, here)) return true;
    }
    return turn_if_shorter(0, here);
  }

  /// The part from one stop to another one, both included, is run the other way.
  bool turn_if_shorter(Index from, Index to_last) {
    if (from > to_last) return false;
    const double before = link(from - 1, from) + link(to_last, to_last + 1);
    const double after = norm(entered(round(turn(to_last))) - left(from - 1)) +
                         to(left(round(turn(from))), to_last + 1);
    if (!(after < before - least_gain_)) return false;
    return change(from, to_last, [&](auto begin, auto end) {
      std::reverse(begin, end);
      std::transform(begin, end, begin, [&](Turn t) { return round(t); });
      return begin;
    });
  }

  /// A stop, alone or with up to two on either side of it, goes to either side of another one.
  bool move_if_shorter(Index moved, Index beside) {
    for (Index together = 1; together <= static_cast<Index>(kMostTogether); ++together) {
      for (const Index from : {moved, moved - together + 1}) {
        const Index end = from + together;
        if (from < 0 || end > size() || (from <= beside && beside < end)) continue;
        if (move_if_shorter(from, end, beside - 1) || move_if_shorter(from, end, beside))
          return true;
      }
    }
    return false;
  }

  /// [from, end) goes behind `behind`, either way round.
  bool move_if_shorter(Index from, Index end, Index behind) {
    if (behind >= from - 1 && behind < end) return false;
    const Turn first = turn(from), last = turn(end - 1);
    const double gain = link(from - 1, from) + link(end - 1, end) -
                        (end < size() ? to(left(from - 1), end) : 0.0) + link(behind, behind + 1);
    const Vec2 comes_from = left(behind);
    const double as_it_is = norm(entered(first) - comes_from) + to(left(last), behind + 1);
    const double turned =
        norm(entered(round(last)) - comes_from) + to(left(round(first)), behind + 1);
    if (!(std::min(as_it_is, turned) < gain - least_gain_)) return false;
    const bool turns = turned < as_it_is;
    const Index low = std::min(from, behind + 1), high = std::max(end - 1, behind);
    return change(low, high, [&](auto begin, auto stop) {
      const auto middle = behind < from ? begin + (from - low) : begin + (end - low);
      const auto joint = std::rotate(begin, middle, stop);
      if (!turns) return joint;
      const auto part_begin = behind < from ? begin : stop - (end - from);
      const auto part_end = part_begin + (end - from);
      std::reverse(part_begin, part_end);
      std::transform(part_begin, part_end, part_begin, [&](Turn t) { return round(t); });
      return joint;
    });
  }

  /// `how` changes a part and returns where in it other stops meet now. Taken back where the whole
  /// is no shorter (ways inside of what is turned may differ) or what has to come first does not.
  template <typename Change>
  bool change(Index from, Index to_last, const Change& how) {
    const double before = length(from, to_last + 1);
    const auto begin = tour_.begin() + from, end = tour_.begin() + to_last + 1;
    const std::vector<Turn> kept(begin, end);
    const Index joint = how(begin, end) - tour_.begin();
    place(static_cast<std::size_t>(from), static_cast<std::size_t>(to_last) + 1);
    const double after = length(from, to_last + 1);
    if (!(after < before - least_gain_) || !is_allowed(from, to_last)) {
      std::copy(kept.begin(), kept.end(), begin);
      place(static_cast<std::size_t>(from), static_cast<std::size_t>(to_last) + 1);
      return false;
    }
    shortened_ += before - after;
    for (const Index i : {from, joint, to_last}) ask_around(i);
    return true;
  }

  [[nodiscard]] bool is_allowed(Index from, Index to_last) const {
    if (!ordered_) return true;
    for (Index i = from; i <= to_last; ++i) {
      for (const std::size_t k : stops_[turn(i).stop].first) {
        if (at_[k] > static_cast<std::size_t>(i)) return false;
      }
    }
    return true;
  }

  void exchange_at_random() {
    const std::size_t count = tour_.size();
    if (count < 4) return;
    std::mt19937_64 random(count);
    const auto below = [&](std::size_t n) { return static_cast<Index>(random() % n); };
    const std::size_t trials =
        std::min(std::max(kExchangesEach * count, kFewestExchanges), kStopsCopied / count);
    std::vector<Turn> best = tour_;
    double behind = 0.0;  // of this tour, how much longer than the best one it is
    const double link_of_mean = way_between(stops_, tour_) / static_cast<double>(count);
    for (std::size_t k = 0; k < trials && !watch_.cancelled(); ++k) {
      const std::vector<Turn> kept = tour_;
      const double left = 1.0 - static_cast<double>(k) / static_cast<double>(trials);
      const Index one = 1 + below(std::min(kLongestPart, count - 1));
      const Index other = 1 + below(std::min(kLongestPart, count - static_cast<std::size_t>(one)));
      const Index from = below(count - static_cast<std::size_t>(one + other) + 1);
      const Index middle = from + one, last = middle + other - 1;
      const double before = length(from, last + 1);
      std::rotate(tour_.begin() + from, tour_.begin() + middle, tour_.begin() + last + 1);
      place(static_cast<std::size_t>(from), static_cast<std::size_t>(last) + 1);
      shortened_ = before - length(from, last + 1);
      if (is_allowed(from, last)) {
        for (const Index i : {from, from + other, last}) ask_around(i);
        improve();
      } else {
        shortened_ = -HUGE_VAL;
      }
      if (behind - shortened_ < kMayBeLonger * left * link_of_mean) {
        behind -= shortened_;
        if (!(behind < -least_gain_)) continue;
        behind = 0.0;
        best = tour_;
      } else {
        tour_ = kept;
        place(0, count);
      }
    }
    tour_ = std::move(best);
  }

  const std::vector<Stop>& stops_;
  std::vector<Turn> tour_;
  std::vector<std::size_t> at_;  ///< where in the tour a stop is
  struct Neighbour {
    double away = 0.0;  ///< no way between both is shorter
    std::size_t stop = 0;
  };
  std::vector<std::vector<Neighbour>> neighbours_;
  std::deque<std::size_t> queue_;    ///< stops around which something changed
  std::vector<std::uint8_t> waits_;  ///< whether a stop is in it
  Watch& watch_;
  double shortened_ = 0.0, least_gain_ = 0.0;
  bool ordered_ = false;  ///< some stops have to come before others
};

}  // namespace

double way_between(const std::vector<Stop>& stops, const std::vector<Turn>& tour) {
  double sum = 0.0;
  Vec2 at{};
  for (const Turn& turn : tour) {
    const Stop& stop = stops[turn.stop];
    sum += norm((turn.turned ? stop.end : stop.begin) - at);
    at = turn.turned ? stop.begin : stop.end;
  }
  return sum;
}

std::vector<Turn> shorter_tour(const std::vector<Stop>& stops, std::vector<Turn> tour,
                               Watch& watch) {
  return Search(stops, std::move(tour), watch).run();
}

}  // namespace obvid::cutting
