// SPDX-License-Identifier: Apache-2.0
#include "cut_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "obvid/exchange/internal/whole_arcs.h"
#include "short_tour.h"

namespace obvid::cutting {
namespace {

/// Up to so many tracks each order is measured with places chosen for it; more would take long.
constexpr std::size_t kMostPlacedAnew = 40;
/// Places where tracks begin change with the order of visits, which changes with them: so often.
constexpr int kMostRounds = 6;
/// Of the lead's radius, room between the tool and what stays where it goes down, where some place
/// has it: beside a straight side all of it.
constexpr double kRoomToPlunge = 0.5;
/// Of the tool's radius and of the way: rounding.
constexpr double kLittle = 1e-9;

/// Places of a closed track at which leads are tried: this many around it, and on every piece one.
constexpr double kLeadsAround = 64.0;
/// A lead is moved along its piece by halved steps, so many times.
constexpr int kHalvedSteps = 24;

/// Where a track may begin.
struct Start {
  std::size_t piece = 0;
  double place = 0.0;   ///< of the piece, 0 to 1
  double step = 0.0;    ///< to the next place that was tried
  bool turned = false;  ///< an open one, from its other end
  bool free = true;     ///< nothing that stays is near where the tool goes down
  Vec2 begin, end;      ///< of the tool's way, leads included
};

/// A circle around a piece.
struct Around {
  Vec2 centre;
  double radius = 0.0;
};

Around circle_around(const Piece& piece) {
  const Box2 box = box_of(piece);
  return {0.5 * (box.low + box.high), 0.5 * norm(box.high - box.low)};
}

class Ordering {
 public:
  Ordering(const Tracks& tracks, std::optional<Vec2> near, const Leads& leads, Watch& watch)
      : tracks_(tracks.all), edges_(tracks.edges), near_(near), leads_(leads), watch_(watch) {
    for (const Track& track : tracks_) {
      if (watch_.cancelled()) return;
      starts_.push_back(starts_of(track));
      around_.emplace_back();
      for (const Piece& piece : track.axis.pieces) around_.back().push_back(circle_around(piece));
    }
  }

  std::vector<Visit> run() {
    if (watch_.was_cancelled()) return {};
    nearest_first();
    shorten();
    std::vector<Visit> out;
    for (const Planned& planned : tour_) out.push_back(visit_of(planned));
    return out;
  }

 private:
  /// A track that is visited, and where it begins.
  struct Planned {
    std::size_t track = 0;
    Start start;
  };
  using Tour = std::vector<Planned>;

  /// What a start is to be near to: the way to it, and from its end on where anything follows.
  struct Neighbours {
    Vec2 from;
    std::optional<Vec2> next;

    [[nodiscard]] double way(const Start& start) const {
      return norm(start.begin - from) + (next ? norm(*next - start.end) : 0.0);
    }
  };

  [[nodiscard]] bool wants_lead(const Track& track) const {
    return leads_.radius() > 0.0 && track.side != CutSide::kOn && track.axis.closed;
  }

  /// The ends of an open track, places for leads of a closed one; none: it may begin anywhere.
  [[nodiscard]] std::vector<Start> starts_of(const Track& track) const {
    std::vector<Start> out;
    const ArcPath& axis = track.axis;
    if (!axis.closed) {
      const Vec2 first = start_point(axis.pieces.front()), last = end_point(axis.pieces.back());
      return {{0, 0.0, 0.0, false, true, first, last}, {0, 0.0, 0.0, true, true, last, first}};
    }
    if (!wants_lead(track)) return out;
    const double whole = length_of(axis);
    for (std::size_t k = 0; k < axis.pieces.size(); ++k) {
      const double wanted = std::ceil(kLeadsAround * length_of(axis.pieces[k]) / whole);
      const int places = static_cast<int>(std::clamp(wanted, 1.0, kLeadsAround));
      for (int place = 0; place < places; ++place) {
        const double step = 1.0 / places;
        const auto start = start_with_lead(track, k, (place + 0.5) * step);
        if (!start) continue;
        out.push_back(*start);
        out.back().step = step;
      }
    }
    if (std::any_of(out.begin(), out.end(), [](const Start& start) { return start.free; })) {
      out.erase(
          std::remove_if(out.begin(), out.end(), [](const Start& start) { return !start.free; }),
          out.end());
    }
    return out;
  }

  [[nodiscard]] std::optional<Start> start_with_lead(const Track& track, std::size_t piece,
                                                     double place) const {
    const ArcPiece in = leads_.at(track.axis.pieces[piece], place, true),
                   out = leads_.at(track.axis.pieces[piece], place, false);
    if (!leads_.has_room(in) || !leads_.has_room(out)) return std::nullopt;
    const double room = edges_.nearest(in.start).room - leads_.tool_radius();
    return Start{piece,    place,  0.0, false, room >= kRoomToPlunge * leads_.radius(),
                 in.start, out.end};
  }

  [[nodiscard]] Neighbours wanted(std::size_t i, const Neighbours& way) const {
    return tracks_[i].axis.closed && near_ ? Neighbours{*near_, {}} : way;
  }

  [[nodiscard]] Start best_start(std::size_t i, const Neighbours& way) const {
    const Neighbours near = wanted(i, way);
    std::vector<Start> beside;
    if (starts_[i].empty()) {
      beside.push_back(nearest_of_all(i, near.from));
      if (near.next) {
        beside.push_back(nearest_of_all(i, *near.next));
        beside.push_back(nearest_of_all(i, 0.5 * (near.from + *near.next)));
      }
    }
    const std::vector<Start>& all = starts_[i].empty() ? beside : starts_[i];
    return *std::min_element(all.begin(), all.end(), [&](const Start& a, const Start& b) {
      return near.way(a) < near.way(b);
    });
  }

  /// Of a closed track without leads.
  [[nodiscard]] Start nearest_of_all(std::size_t i, Vec2 near) const {
    const std::vector<Piece>& pieces = tracks_[i].axis.pieces;
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const Around& circle = around_[i][k];
      if (norm(circle.centre - near) - circle.radius >= least) continue;
      const double distance = distance_from(pieces[k], near);
      if (!(distance < least)) continue;
      least = distance;
      best = k;
    }
    double place = nearest_place(pieces[best], near);
    if (place >= 1.0) {  // the next one begins there
      best = (best + 1) % pieces.size();
      place = 0.0;
    }
    const Vec2 p = place == 0.0 ? start_point(pieces[best]) : evaluate(pieces[best], place).point;
    return {best, place, 0.0, false, true, p, p};
  }

  /// A start with a lead, moved along its piece to where it is nearest.
  [[nodiscard]] Start moved_along(std::size_t i, Start start, const Neighbours& way) const {
    const Neighbours near = wanted(i, way);
    double step = start.step;
    for (int k = 0; k < kHalvedSteps && step > 0.0; ++k) {
      step *= 0.5;
      for (const double place : {start.place - step, start.place + step}) {
        if (!(place > 0.0 && place < 1.0)) continue;
        const auto other = start_with_lead(tracks_[i], start.piece, place);
        if (other && other->free >= start.free && near.way(*other) < near.way(start)) {
          start = *other;
        }
      }
    }
    return start;
  }

  [[nodiscard]] Visit visit_of(const Planned& planned) const {
    const auto& [i, start] = planned;
    const Track& track = tracks_[i];
    if (!track.axis.closed)
      return {i, start.turned ? reversed(track.axis) : track.axis, {}, {}, false};
    const ArcPath begun = begun_at(track.axis, start.piece, start.place);
    Visit out{i, {exchange::whole_arcs(begun.pieces), true}, {}, {}, false};
    if (!wants_lead(track)) return out;
    out.lead_left_out = starts_[i].empty();
    if (out.lead_left_out) return out;
    out.lead_in = leads_.at(track.axis.pieces[start.piece], start.place, true);
    out.lead_out = leads_.at(track.axis.pieces[start.piece], start.place, false);
    return out;
  }

  void nearest_first() {
    std::vector<bool> done(tracks_.size());
    Vec2 at{};
    while (tour_.size() < tracks_.size() && !watch_.cancelled()) {
      Planned best;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < tracks_.size(); ++i) {
        if (done[i] || !may_be_next(i, done)) continue;
        const Start start = best_start(i, {at, {}});
        const double way = norm(start.begin - at);
        if (way < least) {
          least = way;
          best = {i, start};
        }
      }
      done[best.track] = true;
      tour_.push_back(best);
      at = best.start.end;
    }
  }

  [[nodiscard]] bool may_be_next(std::size_t i, const std::vector<bool>& done) const {
    const auto& first = tracks_[i].first;
    return std::all_of(first.begin(), first.end(), [&](std::size_t k) { return done[k]; });
  }

  [[nodiscard]] static double way(const Tour& tour) {
    double sum = 0.0;
    Vec2 at{};
    for (const Planned& planned : tour) {
      sum += norm(planned.start.begin - at);
      at = planned.start.end;
    }
    return sum;
  }

  void shorten() {
    const Tour first = tour_;
    tour_ = with_better_starts(first);
    tour_ = shortened(tour_);
    if (tour_.size() > kMostPlacedAnew) return;
    for (const Tour& from : {tour_, first}) {
      const Tour other = shortened(with_better_starts(moved_one_by_one(from)));
      if (way(other) < way(tour_) * (1.0 - kLittle)) tour_ = other;
    }
  }

  /// With starts as they are tracks change places, then starts move to where the ways are short.
  [[nodiscard]] Tour shortened(Tour tour) const {
    for (int round = 0; round < kMostRounds && !watch_.cancelled(); ++round) {
      Tour other = with_better_starts(reordered(tour));
      if (!(way(other) < way(tour) * (1.0 - kLittle))) break;
      tour = std::move(other);
    }
    return tour;
  }

  /// Begun as near as they can to where the tool comes from.
  [[nodiscard]] Tour placed_anew(Tour tour) const {
    Vec2 at{};
    for (Planned& planned : tour) {
      planned.start = best_start(planned.track, {at, {}});
      at = planned.start.end;
    }
    return tour;
  }

  [[nodiscard]] bool is_allowed(const Tour& tour) const {
    std::vector<bool> done(tracks_.size());
    for (const Planned& planned : tour) {
      if (!may_be_next(planned.track, done)) return false;
      done[planned.track] = true;
    }
    return true;
  }

  /// One track at a time goes to another turn, all placed anew, as long as that helps.
  [[nodiscard]] Tour moved_one_by_one(const Tour& from_tour) const {
    Tour best = placed_anew(from_tour);
    for (bool better = true; better && !watch_.cancelled();) {
      better = false;
      for (std::size_t from = 0; from < best.size() && !watch_.cancelled(); ++from) {
        for (std::size_t to = 0; to < best.size(); ++to) {
          Tour trial = best;
          const Planned moved = trial[from];
          trial.erase(trial.begin() + static_cast<std::ptrdiff_t>(from));
          trial.insert(trial.begin() + static_cast<std::ptrdiff_t>(to), moved);
          if (from == to || !is_allowed(trial)) continue;
          trial = placed_anew(std::move(trial));
          if (!(way(trial) < way(best) * (1.0 - kLittle))) continue;
          best = std::move(trial);
          better = true;
        }
      }
    }
    return best;
  }

  [[nodiscard]] Tour reordered(const Tour& tour) const {
    std::vector<Stop> stops(tracks_.size());
    std::vector<Turn> turns;
    for (const Planned& planned : tour) {
      const Track& track = tracks_[planned.track];
      stops[planned.track] = {planned.start.begin, planned.start.end, !track.axis.closed,
                              track.first};
      turns.push_back({planned.track, false});
    }
    std::vector<Start> starts(tracks_.size());
    for (const Planned& planned : tour) starts[planned.track] = planned.start;
    Tour out;
    for (const Turn& turn : shorter_tour(stops, turns, watch_)) {
      Start start = starts[turn.stop];
      if (turn.turned) {
        std::swap(start.begin, start.end);
        start.turned = !start.turned;
      }
      out.push_back({turn.stop, start});
    }
    return out;
  }

  [[nodiscard]] Tour with_better_starts(Tour tour) const {
    Vec2 at{};
    for (std::size_t k = 0; k < tour.size(); ++k) {
      auto& [track, start] = tour[k];
      Neighbours way{at, {}};
      if (k + 1 < tour.size()) way.next = tour[k + 1].start.begin;
      const Start other = moved_along(track, best_start(track, way), way);
      if (wanted(track, way).way(other) < wanted(track, way).way(start)) start = other;
      at = start.end;
    }
    return tour;
  }

  const std::vector<Track>& tracks_;
  const Edges& edges_;
  std::optional<Vec2> near_;
  const Leads& leads_;
  Watch& watch_;
  std::vector<std::vector<Start>> starts_;
  std::vector<std::vector<Around>> around_;  ///< of the pieces of each track
  Tour tour_;
};

}  // namespace

Vec2 begin_of(const Visit& visit) {
  return visit.lead_in ? visit.lead_in->start : start_point(visit.path.pieces.front());
}

std::vector<Visit> ordered(const Tracks& tracks, std::optional<Vec2> near, const Leads& leads,
                           Watch& watch) {
  return Ordering(tracks, near, leads, watch).run();
}

}  // namespace obvid::cutting
