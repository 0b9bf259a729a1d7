// SPDX-License-Identifier: Apache-2.0
#include "cut_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "obvid/exchange/internal/whole_arcs.h"

namespace obvid::cutting {
namespace {

/// Visits that are moved about; more would take long.
constexpr std::size_t kMostMoved = 120;
/// Quarters of circles lead in and out.
constexpr double kLeadTurn = 0.5 * std::numbers::pi;
/// Places on a lead that are looked at: of the tool's radius, how far apart.
constexpr double kApartOnLead = 0.2, kFewestOnLead = 16.0, kMostOnLead = 512.0;
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
  Ordering(const Tracks& tracks, const VisitRules& rules, Watch& watch)
      : tracks_(tracks.all), edges_(tracks.edges), rules_(rules), watch_(watch) {
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
    if (turns_.size() <= kMostMoved) shorten();
    std::vector<Visit> out;
    Vec2 at{};
    for (const std::size_t i : turns_) {
      out.push_back(visit_of(i, moved_along(i, nearest(i, at), at)));
      at = end_of(out.back());
    }
    return out;
  }

 private:
  using Turns = std::vector<std::size_t>;

  [[nodiscard]] bool wants_lead(const Track& track) const {
    return rules_.lead_radius > 0.0 && track.side != CutSide::kOn && track.axis.closed;
  }

  /// The ends of an open track, places for leads of a closed one; none: it may begin anywhere.
  [[nodiscard]] std::vector<Start> starts_of(const Track& track) const {
    std::vector<Start> out;
    const ArcPath& axis = track.axis;
    if (!axis.closed) {
      const Vec2 first = start_point(axis.pieces.front()), last = end_point(axis.pieces.back());
      return {{0, 0.0, 0.0, false, first, last}, {0, 0.0, 0.0, true, last, first}};
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
    return out;
  }

  [[nodiscard]] std::optional<Start> start_with_lead(const Track& track, std::size_t piece,
                                                     double place) const {
    const ArcPiece in = lead(track.axis.pieces[piece], place, true),
                   out = lead(track.axis.pieces[piece], place, false);
    if (!has_room(in) || !has_room(out)) return std::nullopt;
    return Start{piece, place, 0.0, false, in.start, out.end};
  }

  /// A quarter of a circle on the side of the waste, tangent to a piece at a place.
  [[nodiscard]] ArcPiece lead(const Piece& piece, double place, bool in) const {
    const Jet jet = evaluate(piece, place);
    const double theta = heading(jet.d1),
                 kappa = (rules_.waste_left ? 1.0 : -1.0) / rules_.lead_radius;
    const double length = kLeadTurn * rules_.lead_radius;
    const Vec2 centre = jet.point + (1.0 / kappa) * left_normal(unit_at(theta));
    const double other = theta + (in ? -1.0 : 1.0) * kappa * length;
    const Vec2 far = centre - (1.0 / kappa) * left_normal(unit_at(other));
    return in ? ArcPiece{far, jet.point, other, kappa, length}
              : ArcPiece{jet.point, far, theta, kappa, length};
  }

  /// It crosses no edge, and the tool fits beside all of them.
  [[nodiscard]] bool has_room(const ArcPiece& lead) const {
    if (edges_.met_by(lead)) return false;
    const double wanted = std::ceil(lead.length / (kApartOnLead * rules_.tool_radius));
    const int places = static_cast<int>(std::clamp(wanted, kFewestOnLead, kMostOnLead));
    for (int k = 0; k <= places; ++k) {
      const Vec2 p = evaluate(lead, static_cast<double>(k) / places).point;
      if (edges_.nearest(p).room < rules_.tool_radius * (1.0 - kLittle)) return false;
    }
    return true;
  }

  [[nodiscard]] Vec2 wanted_near(std::size_t i, Vec2 at) const {
    return tracks_[i].axis.closed ? rules_.near.value_or(at) : at;
  }

  [[nodiscard]] Start nearest(std::size_t i, Vec2 at) const {
    const Vec2 near = wanted_near(i, at);
    if (starts_[i].empty()) return nearest_of_all(i, near);
    return *std::min_element(starts_[i].begin(), starts_[i].end(),
                             [&](const Start& a, const Start& b) {
                               return norm(a.begin - near) < norm(b.begin - near);
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
    return {best, place, 0.0, false, p, p};
  }

  /// A start with a lead, moved along its piece to where it is nearest.
  [[nodiscard]] Start moved_along(std::size_t i, Start start, Vec2 at) const {
    const Vec2 near = wanted_near(i, at);
    double step = start.step;
    for (int k = 0; k < kHalvedSteps && step > 0.0; ++k) {
      step *= 0.5;
      for (const double place : {start.place - step, start.place + step}) {
        if (!(place > 0.0 && place < 1.0)) continue;
        const auto other = start_with_lead(tracks_[i], start.piece, place);
        if (other && norm(other->begin - near) < norm(start.begin - near)) start = *other;
      }
    }
    return start;
  }

  [[nodiscard]] Visit visit_of(std::size_t i, const Start& start) const {
    const Track& track = tracks_[i];
    if (!track.axis.closed)
      return {i, start.turned ? reversed(track.axis) : track.axis, {}, {}, false};
    const ArcPath begun = begun_at(track.axis, start.piece, start.place);
    Visit out{i, {exchange::whole_arcs(begun.pieces), true}, {}, {}, false};
    if (!wants_lead(track)) return out;
    out.lead_left_out = starts_[i].empty();
    if (out.lead_left_out) return out;
    out.lead_in = lead(track.axis.pieces[start.piece], start.place, true);
    out.lead_out = lead(track.axis.pieces[start.piece], start.place, false);
    return out;
  }

  void nearest_first() {
    std::vector<bool> done(tracks_.size());
    Vec2 at{};
    while (turns_.size() < tracks_.size()) {
      std::size_t best = tracks_.size();
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < tracks_.size(); ++i) {
        if (done[i] || !may_be_next(i, done)) continue;
        const double way = norm(nearest(i, at).begin - at);
        if (way < least) {
          least = way;
          best = i;
        }
      }
      done[best] = true;
      turns_.push_back(best);
      at = nearest(best, at).end;
    }
  }

  [[nodiscard]] bool may_be_next(std::size_t i, const std::vector<bool>& done) const {
    const auto& first = tracks_[i].first;
    return std::all_of(first.begin(), first.end(), [&](std::size_t k) { return done[k]; });
  }

  [[nodiscard]] bool is_allowed(const Turns& turns) const {
    std::vector<bool> done(tracks_.size());
    for (const std::size_t i : turns) {
      if (!may_be_next(i, done)) return false;
      done[i] = true;
    }
    return true;
  }

  [[nodiscard]] double way(const Turns& turns) const {
    double sum = 0.0;
    Vec2 at{};
    for (const std::size_t i : turns) {
      const Start start = nearest(i, at);
      sum += norm(start.begin - at);
      at = start.end;
    }
    return sum;
  }

  /// One visit at a time goes to another turn, as long as that helps.
  void shorten() {
    double best = way(turns_);
    for (bool better = true; better && !watch_.cancelled();) {
      better = false;
      for (std::size_t from = 0; from < turns_.size() && !watch_.cancelled(); ++from) {
        for (std::size_t to = 0; to < turns_.size(); ++to) {
          if (from == to) continue;
          Turns trial = turns_;
          const std::size_t moved = trial[from];
          trial.erase(trial.begin() + static_cast<std::ptrdiff_t>(from));
          trial.insert(trial.begin() + static_cast<std::ptrdiff_t>(to), moved);
          if (!is_allowed(trial)) continue;
          const double length = way(trial);
          if (!(length < best * (1.0 - kLittle))) continue;
          best = length;
          turns_ = std::move(trial);
          better = true;
        }
      }
    }
  }

  const std::vector<Track>& tracks_;
  const Edges& edges_;
  const VisitRules& rules_;
  Watch& watch_;
  std::vector<std::vector<Start>> starts_;
  std::vector<std::vector<Around>> around_;  ///< of the pieces of each track
  Turns turns_;
};

}  // namespace

Vec2 begin_of(const Visit& visit) {
  return visit.lead_in ? visit.lead_in->start : start_point(visit.path.pieces.front());
}

Vec2 end_of(const Visit& visit) {
  return visit.lead_out ? visit.lead_out->end : end_point(visit.path.pieces.back());
}

std::vector<Visit> ordered(const Tracks& tracks, const VisitRules& rules, Watch& watch) {
  return Ordering(tracks, rules, watch).run();
}

}  // namespace obvid::cutting
