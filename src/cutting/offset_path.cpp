// SPDX-License-Identifier: Apache-2.0
#include "offset_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <variant>

#include "obvid/core/internal/figures.h"
#include "obvid/cutting/cutting.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/geom/internal/circle.h"

namespace obvid::cutting {
namespace {

/// Neighbours that turn by less have a common tangent, rad: what `arcs_along` leaves is rounding.
constexpr double kSmooth = 1e-7;
/// A parallel arc shorter than this part of its own is none.
constexpr double kVanishes = 1e-12;

std::string place_text(Vec2 at) {
  return fmt::format("at {}, {}", significant(at.x, 6), significant(at.y, 6));
}

Piece line(Vec2 from, Vec2 to) { return LinePiece{from, to}; }

/// The arc of a curvature over the chord between two places, with the heading that it starts with.
Piece arc(Vec2 from, Vec2 to, double theta, double kappa, double length) {
  return ArcPiece{from, to, theta, kappa, length};
}

const ArcPiece& arc_of(const Piece& piece) { return std::get<ArcPiece>(piece); }
bool is_line(const Piece& piece) { return std::holds_alternative<LinePiece>(piece); }

Vec2 centre_of(const ArcPiece& a) {
  return a.start + (1.0 / a.kappa) * left_normal(unit_at(a.theta0));
}

/// Places on an arc of a point of its circle: the turn from its start, over its own. None on what
/// was cut off to nothing.
std::optional<double> place_on(const Piece& piece, Vec2 point) {
  constexpr double kBeyond = 1e-9;  // of a piece: rounding of places at its ends
  double place = 0.0;
  if (is_line(piece)) {
    const Vec2 along = end_point(piece) - start_point(piece);
    const double square = dot(along, along);
    if (!(square > 0.0)) return std::nullopt;
    place = dot(point - start_point(piece), along) / square;
  } else {
    const ArcPiece& a = arc_of(piece);
    const Vec2 centre = centre_of(a);
    double turn = turning(a.start - centre, point - centre);
    const double whole = a.kappa * a.length, full = kFullTurn;
    if (whole == 0.0) return std::nullopt;
    if (whole > 0.0 && turn < -kBeyond * whole) turn += full;
    if (whole < 0.0 && turn > -kBeyond * whole) turn -= full;
    place = turn / whole;
  }
  if (place < -kBeyond || place > 1.0 + kBeyond) return std::nullopt;
  return std::clamp(place, 0.0, 1.0);
}

/// Of a line (through `at` along `along`) with a circle.
std::vector<Vec2> line_circle(Vec2 at, Vec2 along, Vec2 centre, double radius) {
  const Vec2 u = along / norm(along);
  const double foot = dot(centre - at, u), away = cross(u, centre - at);
  const double square = radius * radius - away * away;
  if (square < 0.0) return {};
  const double half = std::sqrt(square);
  return {at + (foot - half) * u, at + (foot + half) * u};
}

std::vector<Vec2> circle_circle(Vec2 a, double ra, Vec2 b, double rb) {
  const Vec2 between = b - a;
  const double d = norm(between);
  if (!(d > 0.0)) return {};
  const double along = 0.5 * (d + (ra - rb) * (ra + rb) / d);
  const double square = ra * ra - along * along;
  if (square < 0.0) return {};
  const Vec2 u = between / d, foot = a + along * u;
  const double half = std::sqrt(square);
  return {foot + half * left_normal(u), foot - half * left_normal(u)};
}

std::vector<Vec2> crossings(const Piece& a, const Piece& b) {
  if (is_line(a) && is_line(b)) {
    const Vec2 u = end_point(a) - start_point(a), v = end_point(b) - start_point(b);
    const double area = cross(u, v);
    if (area == 0.0) return {};
    return {start_point(a) + (cross(start_point(b) - start_point(a), v) / area) * u};
  }
  if (is_line(a)) {
    return line_circle(start_point(a), end_point(a) - start_point(a), centre_of(arc_of(b)),
                       std::abs(1.0 / arc_of(b).kappa));
  }
  if (is_line(b)) return crossings(b, a);
  return circle_circle(centre_of(arc_of(a)), std::abs(1.0 / arc_of(a).kappa), centre_of(arc_of(b)),
                       std::abs(1.0 / arc_of(b).kappa));
}

double turn_at_joint(const Piece& before, const Piece& behind) {
  return turn_between(heading_at_end(before), heading_at_start(behind));
}

/// Parallels of the pieces, with the places where neighbours do not meet.
class ParallelOf {
 public:
  ParallelOf(const ArcPath& path, double by) : path_(path), by_(by) {}

  Result<Parallel> run() {
    for (std::size_t i = 0; i < path_.pieces.size(); ++i) {
      OBVID_TRY(add(path_.pieces[i]));
      const bool last = i + 1 == path_.pieces.size();
      if (last && !path_.closed) break;
      turn_at(path_.pieces[i], path_.pieces[last ? 0 : i + 1]);
    }
    OBVID_TRY(close_gaps());
    Parallel out;
    out.path.closed = path_.closed;
    joints_.resize(corners_.size());
    for (const Link& link : links_) {
      for (const std::size_t corner : link.closes) joints_[corner] = out.path.pieces.size();
      out.path.pieces.push_back(link.piece);
    }
    join(out.path);
    out.corners = std::move(corners_);
    measure_corners(out);
    for (std::size_t i = 0; i < links_.size(); ++i) tell_untouched(i, out);
    return out;
  }

 private:
  struct Link {
    Piece piece;
    bool gap_behind = false;            ///< an inner corner: it crosses what comes behind
    Vec2 corner;                        ///< of the outline there
    std::vector<std::size_t> closes{};  ///< inner corners that the joint behind it stands for
    bool around_corner = false;         ///< the arc around one that turns away from the tool
    std::size_t lost_corners = 0;       ///< such ones that the joint behind it stands for
    double lost = 0.0;                  ///< length of pieces that it stands for
    double own = 0.0;                   ///< length of the outline's piece
  };

  Result<void> add(const Piece& piece) {
    auto beside = parallel_piece(piece, by_);
    if (!beside) {
      const double radius = 1.0 / std::abs(curvature_of(piece));
      return error(ErrorCode::kToolTooLarge,
                   fmt::format("the tool is larger than a hollow of radius {} there",
                               significant(radius, 4)))
          .where(place_text(start_point(piece)))
          .hint(fmt::format("only a cutter of less than {} can go there",
                            significant(2.0 * radius, 4)))
          .value(radius);
    }
    links_.push_back({std::move(*beside), false, end_point(piece)});
    links_.back().own = length_of(piece);
    return {};
  }

  void turn_at(const Piece& before, const Piece& behind) {
    const double theta = heading_at_end(before);
    const double turn = turn_at_joint(before, behind);
    if (std::abs(turn) <= kSmooth) return;
    if (turn * by_ > 0.0) {  // towards the tool
      links_.back().gap_behind = true;
      links_.back().closes = {corners_.size()};
      const double half = 0.5 * (std::numbers::pi - std::abs(turn)), radius = std::abs(by_);
      const double reach = radius / std::tan(half);
      corners_.push_back({end_point(before), reach, radius * (1.0 / std::sin(half) - 1.0)});
      const auto straight = [](const Piece& piece) {
        return std::holds_alternative<LinePiece>(piece) ? length_of(piece) : 0.0;
      };
      straight_.push_back(std::min(straight(before), straight(behind)));
      turns_.push_back(std::abs(turn));
      return;
    }
    const Vec2 corner = end_point(before);
    links_.push_back({arc(corner + by_ * left_normal(unit_at(theta)),
                          corner + by_ * left_normal(unit_at(theta + turn)), theta, -1.0 / by_,
                          std::abs(turn * by_)),
                      false, corner});
    links_.back().around_corner = true;
  }

  /// What the formula of two long lines says is so where both are as long as the tool's reaches in
  /// their two corners; else what the tool leaves is how far its way is.
  void measure_corners(Parallel& parallel) const {
    double longest = 0.0;
    for (const Parallel::InnerCorner& one : parallel.corners)
      longest = std::max(longest, one.reach);
    for (std::size_t k = 0; k < parallel.corners.size(); ++k) {
      Parallel::InnerCorner& corner = parallel.corners[k];
      if (straight_[k] < corner.reach + longest) measure_corner(parallel.path, joints_[k], corner);
    }
  }

  /// The tool touches both sides of the corner from the joint of its way that stands for it; other
  /// pieces may be nearer, on the other side of a thin wall.
  void measure_corner(const ArcPath& path, std::size_t joint, Parallel::InnerCorner& corner) const {
    const Piece &before = path.pieces[joint],
                &behind = path.pieces[(joint + 1) % path.pieces.size()];
    const Vec2 at = end_point(before);
    const Vec2 one = at - by_ * left_normal(unit_at(heading_at_end(before)));
    const Vec2 other = at - by_ * left_normal(unit_at(heading_at_start(behind)));
    corner.reach = std::max(norm(one - corner.at), norm(other - corner.at));
    const double nearest =
        std::min(distance_from(before, corner.at), distance_from(behind, corner.at));
    corner.left = std::max(0.0, nearest - std::abs(by_));
  }

  /// What the joint behind a link stands for, where whole edges are among it: smooth pieces are
  /// one.
  void tell_untouched(std::size_t i, Parallel& parallel) const {
    const Link &before = links_[i], &behind = links_[(i + 1) % links_.size()];
    const int mouth = (before.around_corner ? 1 : 0) + (behind.around_corner ? 1 : 0);
    const std::size_t inner = before.closes.size();
    const bool edges = inner + before.lost_corners + static_cast<std::size_t>(mouth) > 1;
    if (inner == 0 || !(before.lost > 0.0) || !edges) return;
    Parallel::Untouched out;
    out.length = before.lost;
    double turn = 0.0;
    for (const std::size_t k : before.closes) {
      const Parallel::InnerCorner& corner = parallel.corners[k];
      turn += turns_[k];
      if (corner.left < out.left) continue;
      out.at = corner.at;
      out.left = corner.left;
    }
    out.slot =
        mouth == 2 || before.lost_corners > 0 || (inner > 1 && turn >= std::numbers::pi - kSmooth);
    parallel.untouched.push_back(out);
  }

  /// Cuts both sides of every gap off where they meet.
  Result<void> close_gaps() {
    for (bool any = true; any;) {
      any = false;
      for (std::size_t i = 0; i < links_.size(); ++i) {
        if (!links_[i].gap_behind) continue;
        OBVID_TRY(close_gap(i));
        any = true;
        break;
      }
    }
    return {};
  }

  /// Pieces nearest to the corner are tried first.
  Result<void> close_gap(std::size_t at) {
    const std::size_t n = links_.size();
    const std::size_t most = path_.closed ? n - 1 : n;
    for (std::size_t apart = 0; apart + 1 < most; ++apart) {
      for (std::size_t back = 0; back <= apart; ++back) {
        const std::size_t ahead = apart - back;
        if (!path_.closed && (back > at || at + 1 + ahead >= n)) continue;
        const std::size_t a = (at + n - back % n) % n, b = (at + 1 + ahead) % n;
        if (a == b) continue;
        if (const auto meeting = meeting_of(links_[a].piece, links_[b].piece)) {
          cut_off(a, b, back, ahead, at, *meeting);
          return {};
        }
      }
    }
    return error(ErrorCode::kToolTooLarge, "the tool does not fit beside the corner there")
        .where(place_text(links_[at].corner))
        .hint("choose a smaller cutter");
  }

  void cut_off(std::size_t a, std::size_t b, std::size_t back, std::size_t ahead, std::size_t at,
               const Meeting& meeting) {
    links_[a].piece = part_of(links_[a].piece, 0.0, meeting.on_first);
    links_[b].piece = part_of(links_[b].piece, meeting.on_second, 1.0);
    links_[a].gap_behind = false;
    const std::size_t n = links_.size();
    std::vector<bool> gone(n);
    for (std::size_t k = 0; k < back; ++k) gone[(at + n - k) % n] = true;
    for (std::size_t k = 0; k < ahead; ++k) gone[(at + 1 + k) % n] = true;
    std::vector<Link> kept;
    for (std::size_t k = 0; k < n; ++k) {
      if (!gone[k]) continue;
      links_[a].closes.insert(links_[a].closes.end(), links_[k].closes.begin(),
                              links_[k].closes.end());
      links_[a].lost_corners += links_[k].lost_corners + (links_[k].around_corner ? 1 : 0);
      links_[a].lost += links_[k].lost + links_[k].own;
    }
    for (std::size_t k = 0; k < n; ++k) {
      if (!gone[k]) kept.push_back(std::move(links_[k]));
    }
    links_ = std::move(kept);
  }

  /// Ends that differ by rounding become one.
  static void join(ArcPath& path) {
    const std::size_t n = path.pieces.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (i + 1 == n && !path.closed) break;
      const Vec2 next = start_point(path.pieces[(i + 1) % n]);
      std::visit(
          [next](auto& piece) {
            if constexpr (requires { piece.end = next; }) piece.end = next;
          },
          path.pieces[i]);
    }
  }

  const ArcPath& path_;
  double by_;
  std::vector<Link> links_;
  std::vector<Parallel::InnerCorner> corners_;
  std::vector<std::size_t> joints_;  ///< of these: the piece whose end stands for it
  std::vector<double> turns_;        ///< of these: absolute, rad
  std::vector<double> straight_;  ///< of these: the shorter of two lines beside it; 0 beside an arc
};

}  // namespace

bool is_smooth(const Piece& before, const Piece& behind) {
  return std::abs(turn_at_joint(before, behind)) <= kSmooth;
}

double heading_at_start(const Piece& piece) {
  if (std::holds_alternative<RationalBezier>(piece)) return element_at(piece, 0.0).theta;
  return is_line(piece) ? heading(end_point(piece) - start_point(piece)) : arc_of(piece).theta0;
}

double heading_at_end(const Piece& piece) {
  if (std::holds_alternative<RationalBezier>(piece)) return element_at(piece, 1.0).theta;
  if (is_line(piece)) return heading_at_start(piece);
  return arc_of(piece).theta0 + arc_of(piece).kappa * arc_of(piece).length;
}

double curvature_of(const Piece& piece) { return is_line(piece) ? 0.0 : arc_of(piece).kappa; }

double length_of(const Piece& piece) {
  constexpr double kOfChord = 1e-9;  // to which lengths of cubics are found
  if (std::holds_alternative<RationalBezier>(piece)) {
    return arc_length(piece, kOfChord * norm(end_point(piece) - start_point(piece)));
  }
  return is_line(piece) ? norm(end_point(piece) - start_point(piece)) : arc_of(piece).length;
}

double length_of(const ArcPath& path) {
  double sum = 0.0;
  for (const Piece& piece : path.pieces) sum += length_of(piece);
  return sum;
}

Piece part_of(const Piece& piece, double from, double to) {
  const auto at = [&](double t) {
    return t == 0.0 ? start_point(piece) : t == 1.0 ? end_point(piece) : evaluate(piece, t).point;
  };
  if (is_line(piece)) return line(at(from), at(to));
  const ArcPiece& a = arc_of(piece);
  return arc(at(from), at(to), a.theta0 + a.kappa * a.length * from, a.kappa,
             a.length * (to - from));
}

ArcPath reversed(const ArcPath& path) {
  ArcPath out{{}, path.closed};
  for (auto piece = path.pieces.rbegin(); piece != path.pieces.rend(); ++piece) {
    out.pieces.push_back(obvid::reversed(*piece));
  }
  return out;
}

Piece scaled(const Piece& piece, double factor) {
  if (const auto* cubic = std::get_if<RationalBezier>(&piece)) {
    RationalBezier out = *cubic;
    out.origin = factor * out.origin;
    for (Vec2& offset : out.offset) offset = factor * offset;
    return out;
  }
  if (is_line(piece)) return line(factor * start_point(piece), factor * end_point(piece));
  const ArcPiece& a = arc_of(piece);
  return arc(factor * a.start, factor * a.end, a.theta0, a.kappa / factor, a.length * factor);
}

ArcPath begun_at(const ArcPath& path, std::size_t piece, double place) {
  ArcPath out{{}, true};
  const std::size_t n = path.pieces.size();
  if (place < 1.0) out.pieces.push_back(part_of(path.pieces[piece], place, 1.0));
  for (std::size_t k = 1; k < n; ++k) out.pieces.push_back(path.pieces[(piece + k) % n]);
  if (place > 0.0) out.pieces.push_back(part_of(path.pieces[piece], 0.0, place));
  return out;
}

Box2 box_of(const Piece& piece) {
  constexpr int kParts = 8;
  Box2 out;
  for (int k = 0; k <= kParts; ++k) out.add(evaluate(piece, static_cast<double>(k) / kParts).point);
  // an arc is no farther beyond its chords than this
  const double part = length_of(piece) / kParts,
               beyond = std::abs(curvature_of(piece)) * part * part / 8.0;
  out.low = out.low - Vec2{beyond, beyond};
  out.high = out.high + Vec2{beyond, beyond};
  return out;
}

double area_of(const ArcPath& path) {
  if (path.pieces.empty()) return 0.0;
  const Vec2 from = start_point(path.pieces.front());
  double area = 0.0;
  for (const Piece& piece : path.pieces) {
    area += 0.5 * cross(start_point(piece) - from, end_point(piece) - from);
    if (is_line(piece)) continue;
    const ArcPiece& a = arc_of(piece);
    const double turn = a.kappa * a.length, radius = 1.0 / a.kappa;
    area += 0.5 * radius * radius * (turn - std::sin(turn));
  }
  return area;
}

double distance_from(const Piece& piece, Vec2 point) {
  const double ends = std::min(norm(point - start_point(piece)), norm(point - end_point(piece)));
  if (is_line(piece)) {
    const Vec2 along = end_point(piece) - start_point(piece);
    const double square = dot(along, along), place = dot(point - start_point(piece), along);
    if (!(square > 0.0) || place <= 0.0 || place >= square) return ends;
    return std::abs(cross(along, point - start_point(piece))) / std::sqrt(square);
  }
  const ArcPiece& a = arc_of(piece);
  if (!place_on(piece, point)) return ends;
  return distance_from_circle(a.start, a.theta0, a.kappa, point);
}

double nearest_place(const Piece& piece, Vec2 point) {
  const double to_start = norm(point - start_point(piece)), to_end = norm(point - end_point(piece));
  const double end = to_end < to_start ? 1.0 : 0.0;
  if (is_line(piece) && start_point(piece) == end_point(piece)) return 0.0;
  if (is_line(piece)) return place_on(piece, point).value_or(end);
  const ArcPiece& a = arc_of(piece);
  const auto place = place_on(piece, point);
  if (!place) return end;
  // as far from its circle as from the nearer end: on the other side of the centre
  const double beside = distance_from_circle(a.start, a.theta0, a.kappa, point);
  return beside < std::min(to_start, to_end) ? *place : end;
}

std::vector<Vec2> crossings_of(const Piece& first, const Piece& second) {
  return crossings(first, second);
}

std::optional<Meeting> meeting_of(const Piece& first, const Piece& second) {
  std::optional<Meeting> best;
  for (const Vec2 p : crossings(first, second)) {
    const auto a = place_on(first, p), b = place_on(second, p);
    if (!a || !b) continue;
    if (!best || *a > best->on_first) best = Meeting{*a, *b};
  }
  return best;
}

Result<Parallel> parallel_of(const ArcPath& path, double by) {
  if (by == 0.0) return Parallel{path, {}, {}};
  return ParallelOf(path, by).run();
}

}  // namespace obvid::cutting

namespace obvid {

std::optional<Piece> parallel_piece(const Piece& piece, double by) {
  using namespace cutting;
  const bool is_arc = std::holds_alternative<ArcPiece>(piece);
  if (!is_arc && !std::holds_alternative<LinePiece>(piece)) return std::nullopt;
  const double kappa = curvature_of(piece), shrink = 1.0 - kappa * by,
               theta = heading_at_start(piece);
  if (!(shrink > kVanishes)) return std::nullopt;
  const Vec2 from = start_point(piece) + by * left_normal(unit_at(theta)),
             to = end_point(piece) + by * left_normal(unit_at(heading_at_end(piece)));
  if (!is_arc) return LinePiece{from, to};
  return ArcPiece{from, to, theta, kappa / shrink, length_of(piece) * shrink};
}

}  // namespace obvid
