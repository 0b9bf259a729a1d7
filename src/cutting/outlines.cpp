// SPDX-License-Identifier: Apache-2.0
#include "outlines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "common_edges.h"
#include "edge_arcs.h"
#include "joined_curves.h"
#include "obvid/contour/arcs/arcs_along.h"
#include "obvid/core/internal/figures.h"
#include "obvid/numeric/internal/halving.h"

namespace obvid::cutting {
namespace {

/// Of the tolerance, for arcs whose place cubics take: these take the rest of the share.
constexpr double kUnderSplines = 0.1;
/// Of the tolerance, what drawings whose pieces meet with small turns may cost.
constexpr double kSmallTurns = 0.1;
/// Places on a path that are looked at: of the tool's radius, how far apart; of all, at most.
constexpr double kOfRadius = 0.2, kMostPlaces = 1e6;
/// Places of an outline that are compared with another one.
constexpr int kPlacesCompared = 8;
/// A tool that is so many times larger than the drawing is a mistake.
constexpr double kLargestTool = 1e3;
constexpr std::size_t kPlacesBetweenQuestions = 256;

Box2 box_around(const ArcPath& path) {
  Box2 out;
  for (const Piece& piece : path.pieces) {
    const Box2 box = box_of(piece);
    out.add(box.low);
    out.add(box.high);
  }
  return out;
}

bool holds(const Box2& outer, const Box2& inner) {
  return outer.low.x <= inner.low.x && outer.low.y <= inner.low.y && inner.high.x <= outer.high.x &&
         inner.high.y <= outer.high.y;
}

bool is_near(Vec2 a, Vec2 b, double within) { return norm(a - b) <= within; }

/// Angle that a piece turns around a point, rad: chords so short that the point is on the same side
/// of chord and arc.
double turn_around(const Piece& piece, Vec2 point) {
  constexpr double kShortestChord = 1e-3;  // rad
  constexpr double kOfDistance = 0.5;
  const double kappa = std::abs(curvature_of(piece)), turn = kappa * length_of(piece);
  const double depth = std::min(1.0, kOfDistance * distance_from(piece, point) * kappa);
  const double widest = std::max(kShortestChord, 2.0 * std::acos(1.0 - depth));
  const int parts =
      std::max(turn > 0.0 ? kPlacesCompared : 1, static_cast<int>(std::ceil(turn / widest)));
  double sum = 0.0;
  Vec2 last = start_point(piece);
  for (int k = 1; k <= parts; ++k) {
    const Vec2 next =
        k == parts ? end_point(piece) : evaluate(piece, static_cast<double>(k) / parts).point;
    sum += turning(last - point, next - point);
    last = next;
  }
  return sum;
}

class TrackMaker {
 public:
  TrackMaker(const std::vector<CutOutline>& outlines, const CutOptions& options, double scale,
             double share, Watch& watch)
      : outlines_(outlines),
        options_(options),
        scale_(scale),
        share_(share),
        radius_(0.5 * options.diameter * scale),
        watch_(watch) {}

  Result<Tracks> run() {
    for (std::size_t i = 0; i < outlines_.size(); ++i) {
      if (watch_.cancelled()) return fail(cancelled_error());
      OBVID_TRY(add(i));
    }
    OBVID_TRY(check_tool());
    leave_doubles_out();
    join_open_curves();
    nest();
    keep_what_is_cut();
    for (Track& track : out_.all) OBVID_TRY(compensate(track));
    tell_short_edges();
    tell_deep_corners();
    for (std::size_t i = 0; i < out_.all.size(); ++i) {
      if (out_.all[i].side != CutSide::kOn) out_.edges.add(out_.all[i].edge, i);
    }
    out_.edges.finish();
    spacing_ = spacing_of(out_.all, radius_);
    for (std::size_t i = 0; i < out_.all.size(); ++i) OBVID_TRY(keeps_clear(i));
    tell_common_edges();
    if (watch_.was_cancelled()) return fail(cancelled_error());
    return std::move(out_);
  }

 private:
  Result<void> add(std::size_t i) {
    const Contour& contour = outlines_[i].contour;
    const double part = options_.motion == GcodeMotion::kSplines ? kUnderSplines : share_;
    auto along = arcs_along(contour, part * options_.tolerance, &watch_);
    if (!along) return fail(named(along.error(), outlines_[i].name));
    Track track;
    track.outline = i;
    track.name = outlines_[i].name;
    track.deviation = along->deviation * scale_;
    for (const Piece& piece : along->pieces) track.edge.pieces.push_back(scaled(piece, scale_));
    track.edge.closed = contour.closed;
    if (outlines_[i].edges_of_curve) {
      EdgeArcs fewer = arcs_over_edges(track.edge, part * options_.tolerance * scale_);
      track.edge = std::move(fewer.path);
      track.deviation += fewer.deviation;
    }
    track.is_cut = outlines_[i].is_cut;
    if (!contour.closed) close_by_tolerance(track);
    track.room = box_around(track.edge);
    out_.all.push_back(std::move(track));
    return {};
  }

  /// Distance of ends that meet, of outlines that are one. A gap of just the tolerance, in digits.
  [[nodiscard]] double within() const {
    constexpr double kRounding = 1e-9;
    return (1.0 + kRounding) * options_.tolerance * scale_;
  }

  [[nodiscard]] std::string told(double length) const {
    return fmt::format("{} {}", significant(length / scale_, 3),
                       outlines_.front().contour.units.text());
  }

  /// Whether sides of curves matter: else open ones are followed like all others.
  [[nodiscard]] bool has_sides() const { return radius_ > 0.0 && options_.side != CutSide::kOn; }

  /// Ends of one curve that are as near as the tolerance meet.
  void close_by_tolerance(Track& track) {
    const std::vector<Piece>& pieces = track.edge.pieces;
    const double gap = norm(start_point(pieces.front()) - end_point(pieces.back()));
    if (pieces.size() < 2 || gap > within()) return;
    if (gap > 0.0) {
      out_.warnings.push_back(fmt::format(
          "{}: its ends are {} apart, within the tolerance: it is closed", track.name, told(gap)));
    }
    track.deviation += close_gap(track.edge).moved;
  }

  /// Open curves whose ends are as near as the tolerance are one curve; where three and more ends
  /// meet nobody knows which belong together.
  void join_open_curves() {
    std::vector<ArcPath> open;
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < out_.all.size(); ++i) {
      if (out_.all[i].edge.closed) continue;
      open.push_back(out_.all[i].edge);
      numbers.push_back(i);
    }
    if (open.empty()) return;
    const JoinedCurves joined = joined_curves(open, within());
    std::vector<Track> all;
    for (Track& track : out_.all) {
      if (track.edge.closed) all.push_back(std::move(track));
    }
    std::vector<Track> chains;
    for (const JoinedCurves::Chain& chain : joined.chains) {
      Track track = std::move(out_.all[numbers[chain.members.front()]]);
      bool half_chosen = false;
      for (std::size_t k = 1; k < chain.members.size(); ++k) {
        const Track& other = out_.all[numbers[chain.members[k]]];
        track.deviation = std::max(track.deviation, other.deviation);
        if (track.is_cut != other.is_cut) half_chosen = true;
        track.is_cut = track.is_cut || other.is_cut;
      }
      track.deviation += chain.moved;
      if (chain.members.size() > 1) join_into(track, chain, numbers);
      if (half_chosen) {
        out_.warnings.push_back(track.name +
                                ": --curve names a part of this curve alone; all of it is cut");
      }
      chains.push_back(std::move(track));
    }
    tell_enclosing(joined, chains);
    tell_small_gaps(joined, chains);
    for (Track& track : chains) all.push_back(std::move(track));
    std::sort(all.begin(), all.end(),
              [](const Track& a, const Track& b) { return a.outline < b.outline; });
    out_.all = std::move(all);
  }

  void join_into(Track& track, const JoinedCurves::Chain& chain,
                 const std::vector<std::size_t>& numbers) {
    std::string others = out_.all[numbers[chain.members[1]]].name;
    const std::size_t more = chain.members.size() - 2;
    if (more > 0) others += fmt::format(" and {} other{}", more, more == 1 ? "" : "s");
    if (chain.largest_gap > 0.0) {
      out_.warnings.push_back(
          fmt::format("{} and {}: their ends are up to {} apart, within the tolerance: they are "
                      "one curve",
                      track.name, others, told(chain.largest_gap)));
    }
    track.name += " with " + others;
    track.edge = chain.path;
    track.room = box_around(track.edge);
  }

  void tell_enclosing(const JoinedCurves& joined, const std::vector<Track>& chains) {
    if (!joined.enclosing || !has_sides()) return;
    const Track& one = chains[*joined.enclosing];
    const Vec2 at = start_point(one.edge.pieces.front());
    out_.warnings.push_back(fmt::format(
        "{}, at {}, {}: open curves of which three and more meet there close around something "
        "together, and which of them is an outline is not clear: the tool follows them on the "
        "line, parts become smaller by its radius; draw each outline as a closed curve of its own, "
        "or choose --side on if that is meant",
        one.name, significant(at.x / scale_, 6), significant(at.y / scale_, 6)));
  }

  /// Of a small gap it is told that it stays.
  void tell_small_gaps(const JoinedCurves& joined, const std::vector<Track>& chains) {
    if (!has_sides()) return;
    for (const JoinedCurves::Gap& gap : joined.gaps) {
      const bool own = gap.one == gap.other;
      const std::string names = own ? chains[gap.one].name + ": its ends are "
                                    : fmt::format("{} and {}: their ends are ",
                                                  chains[gap.one].name, chains[gap.other].name);
      out_.warnings.push_back(
          names + told(gap.distance) +
          (own ? " apart: it is an open curve, the tool follows it on the line and nothing lies "
                 "inside; close it in the drawing, or allow more (--tolerance)"
               : " apart: they are open curves, the tool follows them on the line and nothing lies "
                 "inside; join them in the drawing, or allow more (--tolerance)"));
    }
  }

  static Error named(Error error, const std::string& name) {
    error.where = error.where.empty() ? name : name + ", " + error.where;
    return error;
  }

  Result<void> check_tool() const {
    Box2 all;
    for (const Track& track : out_.all) {
      all.add(track.room.low);
      all.add(track.room.high);
    }
    const double size = all.diagonal();
    const auto too_large = [](const char* what, const char* option, double value) -> Result<void> {
      return error(ErrorCode::kBadOption, what)
          .where(option)
          .hint("check the units of the drawing: --units")
          .value(value);
    };
    if (2.0 * radius_ > kLargestTool * size) {
      return too_large("the tool is a thousand times larger than the drawing", "--diameter",
                       options_.diameter);
    }
    if (options_.lead_in * scale_ > size + 2.0 * radius_) {
      return too_large("the lead-in is larger than the drawing", "--lead-in", options_.lead_in);
    }
    if (options_.tolerance * scale_ > size) {
      return too_large("the tolerance is larger than the drawing", "--tolerance",
                       options_.tolerance);
    }
    return {};
  }

  /// Whether two outlines are one, drawn twice.
  [[nodiscard]] bool are_one(const Track& a, const Track& b) const {
    const double within = this->within();
    if (a.edge.closed != b.edge.closed || !is_near(a.room.low, b.room.low, within) ||
        !is_near(a.room.high, b.room.high, within)) {
      return false;
    }
    const auto lies_on = [&](const Track& one, const Track& other) {
      return std::all_of(one.edge.pieces.begin(), one.edge.pieces.end(), [&](const Piece& piece) {
        for (int k = 0; k < kPlacesCompared; ++k) {
          const Vec2 p = evaluate(piece, static_cast<double>(k) / kPlacesCompared).point;
          const bool near =
              std::any_of(other.edge.pieces.begin(), other.edge.pieces.end(),
                          [&](const Piece& its) { return distance_from(its, p) <= within; });
          if (!near) return false;
        }
        return true;
      });
    };
    return lies_on(a, b) && lies_on(b, a);
  }

  void leave_doubles_out() {
    std::vector<Track> kept;
    for (Track& track : out_.all) {
      const auto same = std::find_if(kept.begin(), kept.end(),
                                     [&](const Track& other) { return are_one(other, track); });
      if (same == kept.end()) {
        kept.push_back(std::move(track));
      } else {
        out_.warnings.push_back(
            fmt::format("{} lies on {} and is cut once", track.name, same->name));
      }
    }
    out_.all = std::move(kept);
  }

  void nest() {
    for (std::size_t i = 0; i < out_.all.size(); ++i) {
      Track& one = out_.all[i];
      const Vec2 p = evaluate(one.edge.pieces.front(), 0.5).point;
      for (std::size_t j = 0; j < out_.all.size(); ++j) {
        const Track& other = out_.all[j];
        if (i == j || !other.edge.closed || !holds(other.room, one.room) ||
            !is_inside(other.edge, p)) {
          continue;
        }
        ++one.around;
        out_.all[j].first.push_back(i);
      }
    }
  }

  /// The others were there to say what lies in what.
  void keep_what_is_cut() {
    std::vector<std::size_t> now(out_.all.size(), out_.all.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < out_.all.size(); ++i) {
      if (out_.all[i].is_cut) now[i] = count++;
    }
    std::vector<Track> kept;
    for (std::size_t i = 0; i < out_.all.size(); ++i) {
      if (now[i] == out_.all.size()) continue;
      Track& track = out_.all[i];
      std::vector<std::size_t> first;
      for (const std::size_t k : track.first) {
        if (now[k] != out_.all.size()) first.push_back(now[k]);
      }
      track.first = std::move(first);
      kept.push_back(std::move(track));
    }
    out_.all = std::move(kept);
  }

  Result<void> compensate(Track& track) {
    const bool wanted = radius_ > 0.0 && options_.side != CutSide::kOn;
    if (wanted && track.edge.closed) {
      const double area = area_of(track.edge);
      if (area == 0.0) {
        return error(ErrorCode::kToolTooLarge, "the outline crosses itself: it has no inside")
            .where(track.name)
            .hint("draw it as several outlines, or cut along it (--side on)");
      }
      const bool outside = options_.side == CutSide::kOutside ||
                           (options_.side == CutSide::kAuto && track.around % 2 == 0);
      track.side = outside ? CutSide::kOutside : CutSide::kInside;
      // what stays lies to the right
      if ((area < 0.0) != outside) track.edge = reversed(track.edge);
    } else if (wanted && options_.side != CutSide::kAuto) {
      return error(ErrorCode::kBadOption, "an open curve has no inside")
          .where(track.name)
          .hint("leave --side out, or close the curve in the drawing");
    }
    const bool compensated = track.side != CutSide::kOn;
    auto parallel = parallel_of(track.edge, compensated ? radius_ : 0.0);
    if (!parallel) return fail(in_drawing(parallel.error(), track.name));
    if (const Parallel::Untouched* slot = deepest_slot(*parallel, radius_)) {
      return fail(does_not_enter(track, *slot));
    }
    for (const Parallel::Untouched& one : parallel->untouched) {
      if (one.left > within()) short_edges_.push_back({&track, one});
    }
    track.axis = std::move(parallel->path);
    track.corners = std::move(parallel->corners);
    if (compensated && options_.direction == CutDirection::kConventional) {
      track.axis = reversed(track.axis);
    }
    return {};
  }

  /// Of what a slot or notch keeps the tool out of, more than the tolerance and than a right-angled
  /// corner does.
  [[nodiscard]] const Parallel::Untouched* deepest_slot(const Parallel& parallel,
                                                        double radius) const {
    const double most = std::max(within(), (std::numbers::sqrt2 - 1.0) * radius);
    const Parallel::Untouched* out = nullptr;
    for (const Parallel::Untouched& one : parallel.untouched) {
      if (one.slot && one.left > most && (!out || one.left > out->left)) out = &one;
    }
    return out;
  }

  [[nodiscard]] Error does_not_enter(const Track& track, const Parallel::Untouched& slot) const {
    const auto fits = diameter_that_enters(track.edge);
    return error(
               ErrorCode::kToolTooLarge,
               fmt::format("the tool is wider than a slot or notch there: {} of the outline would "
                           "not be touched, and up to {} left",
                           told(slot.length), told(slot.left)))
        .where(fmt::format("{}, {}", track.name, place_text(slot.at)))
        .hint(fits ? fmt::format("a cutter of {} enters it", *fits)
                   : "choose a smaller cutter, or cut along the outline (--side on)")
        .value(slot.left / scale_);
  }

  /// In digits: halved until one enters all slots of an outline, then the largest that was found
  /// to.
  [[nodiscard]] std::optional<std::string> diameter_that_enters(const ArcPath& edge) const {
    constexpr int kTimesHalved = 12, kTimesBisected = 12;
    constexpr std::size_t kMostPieces = 20000;  // of an outline: seconds
    if (edge.pieces.size() > kMostPieces) return std::nullopt;
    const auto enters = [&](double radius) {
      const auto made = parallel_of(edge, radius);
      return made && !deepest_slot(*made, radius);
    };
    double fits = radius_, wide = radius_;
    for (int k = 0; !enters(fits); ++k) {
      if (k == kTimesHalved || watch_.cancelled()) return std::nullopt;
      wide = fits;
      fits *= 0.5;
    }
    fits = end_of_condition(fits, wide, enters, kTimesBisected).holds;
    constexpr int kDigits = 3;
    const double diameter = 2.0 * fits / scale_;
    const double unit = std::pow(10.0, std::floor(std::log10(diameter)) - (kDigits - 1));
    const double rounded = std::floor(diameter / unit) * unit;
    if (!enters(0.5 * rounded * scale_)) return std::nullopt;
    return significant(rounded, kDigits);
  }

  [[nodiscard]] std::string place_text(Vec2 at) const {
    return fmt::format("at {}, {}", significant(at.x / scale_, 6), significant(at.y / scale_, 6));
  }

  /// Chamfers and steps.
  void tell_short_edges() {
    if (short_edges_.empty()) return;
    const auto worst =
        std::max_element(short_edges_.begin(), short_edges_.end(),
                         [](const auto& a, const auto& b) { return a.what.left < b.what.left; });
    const std::size_t count = short_edges_.size();
    out_.warnings.push_back(fmt::format(
        "edges in {} are too short for the round tool to touch them: {} of {}, {}, where {} stay",
        counted(count, "inner corner", "inner corners"), told(worst->what.length),
        worst->track->name, place_text(worst->what.at), told(worst->what.left)));
  }

  void tell_deep_corners() {
    std::size_t count = 0;
    const Track* where = nullptr;
    Parallel::InnerCorner worst;
    for (const Track& track : out_.all) {
      for (const Parallel::InnerCorner& corner : track.corners) {
        if (!(corner.left > radius_)) continue;
        ++count;
        if (where && corner.left <= worst.left) continue;
        where = &track;
        worst = corner;
      }
    }
    if (!where) return;
    out_.warnings.push_back(
        fmt::format("the round tool leaves more than its radius in {}: up to {}, of {}, {}",
                    counted(count, "inner corner", "inner corners"), told(worst.left), where->name,
                    place_text(worst.at)));
  }

  /// Lengths in messages are those of the machine, which are other ones for a drawing in metres.
  [[nodiscard]] Error in_drawing(Error error, const std::string& name) const {
    if (scale_ != 1.0) error.hint += error.hint.empty() ? "" : " (lengths as in the program)";
    return named(std::move(error), name);
  }

  /// The tool cuts into no edge; where it follows a curve, into none but that is said.
  Result<void> keeps_clear(std::size_t i) {
    const Track& track = out_.all[i];
    if (radius_ == 0.0) return {};
    const double slack = kSmallTurns * options_.tolerance * scale_;
    std::size_t looked = 0;
    Vec2 worst_at{};
    Edges::Nearest worst{};
    worst.room = radius_ - slack;
    bool fits = true;
    for (const Piece& piece : track.axis.pieces) {
      const auto parts =
          static_cast<std::size_t>(std::max(2.0, std::ceil(length_of(piece) / spacing_)));
      for (std::size_t k = 0; k <= parts; ++k) {
        if (++looked % kPlacesBetweenQuestions == 0 && watch_.cancelled())
          return fail(cancelled_error());
        const Vec2 p = evaluate(piece, static_cast<double>(k) / static_cast<double>(parts)).point;
        const Edges::Nearest found = out_.edges.nearest(p);
        if (track.side == CutSide::kOn) {
          if (found.distance >= radius_ - slack) continue;
          out_.warnings.push_back(
              fmt::format("{} is followed, and the tool cuts into {} there (at {}, {})", track.name,
                          out_.all[found.name].name, significant(p.x, 6), significant(p.y, 6)));
          return {};
        }
        if (found.room >= worst.room) continue;
        fits = false;
        worst = found;
        worst_at = p;
      }
    }
    if (fits) return {};
    OBVID_TRY(crosses_none(i));
    return error(ErrorCode::kToolTooLarge,
                 fmt::format("the tool does not fit: it would cut {} deep into what stays of {}",
                             significant(radius_ - worst.room, 3), out_.all[worst.name].name))
        .where(fmt::format("{}, at {}, {}", track.name, significant(worst_at.x, 6),
                           significant(worst_at.y, 6)))
        .hint("choose a smaller cutter, or another --side")
        .value(worst.room);
  }

  /// Of what is followed on the line nothing is refused.
  void tell_common_edges() {
    const CommonEdges found = common_edges(out_.all, within(), watch_);
    const auto where = [&](const CommonEdges::Place& place) {
      return fmt::format("{} and {}, {}", out_.all[place.one].name, out_.all[place.other].name,
                         place_text(place.at));
    };
    if (found.first_again && options_.process != CutProcess::kMill) {
      out_.warnings.push_back(
          fmt::format("{} are burnt once more, where outlines lie on each other: first {}; draw "
                      "common edges once",
                      told(found.again), where(*found.first_again)));
    }
    if (found.first_crossing && options_.side != CutSide::kOn) {
      const std::size_t more = found.crossings - 1;
      out_.warnings.push_back(fmt::format(
          "closed outlines cross and are cut as they are drawn: {}{}", where(*found.first_crossing),
          more == 0 ? "" : fmt::format(", and {} more", counted(more, "pair", "pairs"))));
    }
  }

  /// What the outlines themselves do not leave room for.
  Result<void> crosses_none(std::size_t i) const {
    for (const Piece& piece : out_.all[i].edge.pieces) {
      const auto other = out_.edges.met_by(piece, i);
      if (!other) continue;
      return error(ErrorCode::kToolTooLarge, fmt::format("two outlines cross or touch: {} and {}",
                                                         out_.all[i].name, out_.all[*other].name))
          .hint("choose curves with --curve, or cut along them (--side on)");
    }
    return {};
  }

  const std::vector<CutOutline>& outlines_;
  const CutOptions& options_;
  double scale_, share_, radius_, spacing_ = 0.0;
  Watch& watch_;
  Tracks out_;
  struct ShortEdge {
    const Track* track;
    Parallel::Untouched what;
  };
  std::vector<ShortEdge> short_edges_;
};

}  // namespace

bool is_inside(const ArcPath& path, Vec2 point) {
  double turn = 0.0;
  for (const Piece& piece : path.pieces) turn += turn_around(piece, point);
  return std::abs(turn) > std::numbers::pi;
}

double spline_tolerance(double tolerance, double share) {
  return (share - kUnderSplines) * tolerance;
}

double spacing_of(const std::vector<Track>& tracks, double tool_radius, double levels) {
  double length = 0.0;
  for (const Track& track : tracks) length += length_of(track.axis);
  return std::max(kOfRadius * tool_radius, levels * length / kMostPlaces);
}

Result<Tracks> tracks_of(const std::vector<CutOutline>& outlines, const CutOptions& options,
                         double scale, double share, Watch& watch) {
  return TrackMaker(outlines, options, scale, share, watch).run();
}

}  // namespace obvid::cutting
