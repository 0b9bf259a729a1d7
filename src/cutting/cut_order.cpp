// SPDX-License-Identifier: Apache-2.0
#include "cut_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "obvid/exchange/internal/gcode/path.h"

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

/// Where a track may begin.
struct Start {
  std::size_t piece = 0;
  bool turned = false;  ///< an open one, from its other end
  Vec2 begin, end;      ///< of the tool's way, leads included
};

class Ordering {
 public:
  Ordering(const Tracks& tracks, const VisitRules& rules, Watch& watch)
      : tracks_(tracks.all), edges_(tracks.edges), rules_(rules), watch_(watch) {
    for (const Track& track : tracks_) {
      if (watch_.cancelled()) return;
      starts_.push_back(starts_of(track));
    }
  }

  std::vector<Visit> run() {
    if (watch_.was_cancelled()) return {};
    nearest_first();
    if (turns_.size() <= kMostMoved) shorten();
    std::vector<Visit> out;
    Vec2 at{};
    for (const std::size_t i : turns_) {
      out.push_back(visit_of(i, nearest(i, at)));
      at = end_of(out.back());
    }
    return out;
  }

 private:
  using Turns = std::vector<std::size_t>;

  [[nodiscard]] bool wants_lead(const Track& track) const {
    return rules_.lead_radius > 0.0 && track.side != CutSide::kOn && track.axis.closed;
  }

  [[nodiscard]] std::vector<Start> starts_of(const Track& track) const {
    std::vector<Start> all, with_leads;
    const ArcPath& axis = track.axis;
    if (!axis.closed) {
      const Vec2 first = start_point(axis.pieces.front()), last = end_point(axis.pieces.back());
      return {{0, false, first, last}, {0, true, last, first}};
    }
    for (std::size_t k = 0; k < axis.pieces.size(); ++k) {
      const Vec2 p = evaluate(axis.pieces[k], 0.5).point;
      all.push_back({k, false, p, p});
      if (!wants_lead(track)) continue;
      const ArcPiece in = lead(axis.pieces[k], true), out = lead(axis.pieces[k], false);
      if (!has_room(in) || !has_room(out)) continue;
      with_leads.push_back({k, false, in.start, out.end});
    }
    return with_leads.empty() ? all : with_leads;
  }

  /// A quarter of a circle on the side of the waste, tangent to the middle of a piece.
  [[nodiscard]] ArcPiece lead(const Piece& piece, bool in) const {
    const Jet jet = evaluate(piece, 0.5);
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

  [[nodiscard]] const Start& nearest(std::size_t i, Vec2 at) const {
    const Vec2 wish = tracks_[i].axis.closed ? rules_.near.value_or(at) : at;
    return *std::min_element(starts_[i].begin(), starts_[i].end(),
                             [&](const Start& a, const Start& b) {
                               return norm(a.begin - wish) < norm(b.begin - wish);
                             });
  }

  [[nodiscard]] Visit visit_of(std::size_t i, const Start& start) const {
    const Track& track = tracks_[i];
    if (!track.axis.closed)
      return {i, start.turned ? reversed(track.axis) : track.axis, {}, {}, false};
    const ArcPath around = begun_at(track.axis, start.piece, 0.5);
    Visit out{i, {exchange::whole_arcs(around.pieces), true}, {}, {}, false};
    if (!wants_lead(track)) return out;
    out.lead_left_out = start.begin == start_point(out.path.pieces.front());
    if (out.lead_left_out) return out;
    out.lead_in = lead(track.axis.pieces[start.piece], true);
    out.lead_out = lead(track.axis.pieces[start.piece], false);
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
      const Start& start = nearest(i, at);
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
