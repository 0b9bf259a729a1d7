// SPDX-License-Identifier: Apache-2.0
// Pieces of drawings that stay as they are: docs/methods/drawings.md, section 2.
#include "files/drawn_pieces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "obvid/contour/conics.h"
#include "obvid/geom/element.h"
#include "obvid/series/internal/straight_rows.h"

namespace obvid::pipeline_detail {
namespace {

constexpr double kPi = std::numbers::pi;
/// Arcs are cut into parts that turn by no more: half a turn is the limit of what is proved.
constexpr double kMostTurn = 0.9 * kPi;
/// A control point that lies no farther from the chord is on it, of the chord: the digits that CAD
/// systems print.
constexpr double kStraight = 1e-12;
/// A vertex this near to the end of an arc of an ellipse is its end, rad: rounding of printed
/// angles.
constexpr double kAtVertex = 1e-6;
/// Axes that agree so far are those of a circle, of the larger one.
constexpr double kRound = 1e-12;
/// Pieces meet when their ends are no farther apart, of the size of the curve: six digits are what
/// the coarser programs print.
constexpr double kMeet = 1e-6;

bool draws_a_line(const RationalBezier& b) {
  const auto last = static_cast<std::size_t>(b.degree);
  const Vec2 chord = b.offset[last] - b.offset[0];
  const double square = dot(chord, chord);
  double before = 0.0;
  for (std::size_t j = 1; j <= last; ++j) {
    const Vec2 way = b.offset[j] - b.offset[0];
    const double along = dot(way, chord);
    if (std::abs(cross(chord, way)) > kStraight * square || along < before) return false;
    before = along;
  }
  return square > 0.0;
}

void add_parts(const ArcPiece& arc, std::vector<DrawnPiece>& out) {
  const double turn = std::abs(arc.kappa * arc.length);
  const int parts = std::max(1, static_cast<int>(std::ceil(turn / kMostTurn)));
  Vec2 from = arc.start;
  for (int k = 0; k < parts; ++k) {
    const double share = static_cast<double>(k) / parts;
    const Vec2 to =
        k + 1 == parts ? arc.end : evaluate(arc, static_cast<double>(k + 1) / parts).point;
    out.push_back({ArcPiece{from, to, arc.theta0 + share * arc.kappa * arc.length, arc.kappa,
                            arc.length / parts},
                   true});
    from = to;
  }
}

void add_parts(const ClothoidPiece& c, std::vector<DrawnPiece>& out) {
  const double most = std::max(std::abs(c.kappa0), std::abs(c.kappa1)) * c.length;
  const int parts = std::max(1, static_cast<int>(std::ceil(most / kMostTurn)));
  if (parts == 1) {
    out.push_back({c, true});
    return;
  }
  Vec2 from = c.start;
  for (int k = 0; k < parts; ++k) {
    const double a = static_cast<double>(k) / parts, b = static_cast<double>(k + 1) / parts;
    const auto kappa_at = [&](double part) { return c.kappa0 + part * (c.kappa1 - c.kappa0); };
    const double turned = 0.5 * (c.kappa0 + kappa_at(a)) * a * c.length;
    const Vec2 to = k + 1 == parts ? c.end : evaluate(c, b).point;
    out.push_back(
        {ClothoidPiece{from, to, c.theta0 + turned, kappa_at(a), kappa_at(b), c.length / parts},
         true});
    from = to;
  }
}

Vec2 point_at(const Ellipse& e, double angle) {
  const Vec2 u = unit_at(e.rotation);
  return e.centre + (e.semi_major * std::cos(angle)) * u +
         (e.semi_minor * std::sin(angle)) * left_normal(u);
}

/// Arc between two eccentric angles, less than half a turn apart, seen from its start.
RationalBezier elliptic_arc(const Ellipse& e, double from, double to, Vec2 start, Vec2 end) {
  const double half = 0.5 * (to - from), weight = std::cos(half);
  RationalBezier out;
  out.degree = 2;
  out.origin = start;
  const Vec2 middle = point_at(e, 0.5 * (from + to)) - e.centre;
  out.offset[1] = (e.centre - start) + middle / weight;
  out.offset[2] = end - start;
  out.weight[0] = out.weight[2] = 1.0;
  out.weight[1] = weight;
  return out;
}

/// Angles at which an arc is cut: its ends, and the vertices between. Ends that are vertices but
/// for rounding become vertices.
std::vector<double> cut_angles(const Ellipse& e) {
  constexpr double kQuarter = 0.5 * kPi;
  const auto snapped = [](double angle) {
    const double vertex = kQuarter * std::round(angle / kQuarter);
    return std::abs(angle - vertex) <= kAtVertex ? vertex : angle;
  };
  const double low = snapped(std::min(e.from, e.to)), high = snapped(std::max(e.from, e.to));
  std::vector<double> cuts{low};
  for (double k = std::floor(low / kQuarter + 0.5); k * kQuarter < high; k += 1.0) {
    if (k * kQuarter > low) cuts.push_back(k * kQuarter);
  }
  cuts.push_back(high);
  if (e.to < e.from) std::reverse(cuts.begin(), cuts.end());
  return cuts;
}

/// False when it is no ellipse.
bool add_ellipse(const RationalBezier& conic, std::vector<DrawnPiece>& out) {
  if (conic.degree != 2 || conic.weight[0] * conic.weight[2] == conic.weight[1] * conic.weight[1]) {
    return false;  // a parabola: somebody's spline
  }
  const auto e = ellipse_of(conic);
  if (!e) return false;
  const Piece whole{conic};
  const Vec2 start = start_point(whole), end = end_point(whole);
  if (e->semi_major - e->semi_minor <= kRound * e->semi_major) {
    const double sweep = e->to - e->from, side = sweep > 0.0 ? 1.0 : -1.0;
    const double theta = heading(evaluate(whole, 0.0).d1);
    add_parts(ArcPiece{start, end, theta, side / e->semi_major, std::abs(sweep) * e->semi_major},
              out);
    return true;
  }
  const std::vector<double> cuts = cut_angles(*e);
  Vec2 from = cuts.front() == e->from ? start : point_at(*e, cuts.front());
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const Vec2 to = cuts[k + 1] == e->to ? end : point_at(*e, cuts[k + 1]);
    out.push_back({elliptic_arc(*e, cuts[k], cuts[k + 1], from, to), true});
    from = to;
  }
  return true;
}

/// What a piece is, whatever it was drawn as.
Piece plain(const Piece& piece) {
  const auto* bezier = std::get_if<RationalBezier>(&piece);
  if (bezier != nullptr && draws_a_line(*bezier)) {
    return LinePiece{start_point(piece), end_point(piece)};
  }
  if (const auto* c = std::get_if<ClothoidPiece>(&piece); c != nullptr && c->kappa0 == c->kappa1) {
    if (c->kappa0 == 0.0) return LinePiece{c->start, c->end};
    return ArcPiece{c->start, c->end, c->theta0, c->kappa0, c->length};
  }
  return piece;
}

bool is_line(const Piece& piece) { return std::holds_alternative<LinePiece>(piece); }

/// Whether lines first ... last - 1 of a curve are edges that somebody drew.
bool are_edges(const std::vector<Piece>& pieces, std::size_t first, std::size_t last, bool closed) {
  std::vector<Vec2> points;
  for (std::size_t i = first; i < last; ++i) points.push_back(start_point(pieces[i]));
  const bool whole = closed && first == 0 && last == pieces.size();
  if (!whole) points.push_back(end_point(pieces[last - 1]));
  return !chords_of_curve(points, whole);
}

/// Which pieces stay, before they are cut.
std::vector<bool> staying(const std::vector<Piece>& pieces, bool closed, bool all_lines) {
  std::vector<bool> stays(pieces.size(), false);
  for (std::size_t i = 0; i < pieces.size();) {
    if (!is_line(pieces[i])) {
      stays[i] = std::holds_alternative<ArcPiece>(pieces[i]) ||
                 std::holds_alternative<ClothoidPiece>(pieces[i]);
      ++i;
      continue;
    }
    std::size_t last = i;
    while (last < pieces.size() && is_line(pieces[last])) ++last;
    const bool edges = all_lines || are_edges(pieces, i, last, closed);
    for (; i < last; ++i) stays[i] = edges;
  }
  return stays;
}

}  // namespace

std::vector<DrawnPiece> drawn_pieces(const DrawnCurve& curve, bool all_lines) {
  std::vector<Piece> pieces;
  pieces.reserve(curve.pieces.size());
  for (const Piece& piece : curve.pieces) pieces.push_back(plain(piece));
  if (curve.closed && !pieces.empty()) {  // no row of lines is cut by the seam
    const auto other = std::find_if(pieces.begin(), pieces.end(),
                                    [](const Piece& piece) { return !is_line(piece); });
    if (other != pieces.end() && is_line(pieces.front()) && is_line(pieces.back())) {
      std::rotate(pieces.begin(), other, pieces.end());
    }
  }
  const std::vector<bool> stays = staying(pieces, curve.closed, all_lines);
  std::vector<DrawnPiece> out;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const auto* arc = std::get_if<ArcPiece>(&pieces[i]);
    const auto* clothoid = std::get_if<ClothoidPiece>(&pieces[i]);
    const auto* bezier = std::get_if<RationalBezier>(&pieces[i]);
    if (arc != nullptr) {
      add_parts(*arc, out);
    } else if (clothoid != nullptr) {
      add_parts(*clothoid, out);
    } else if (bezier == nullptr || !add_ellipse(*bezier, out)) {
      out.push_back({pieces[i], stays[i]});
    }
  }
  return out;
}

namespace {

/// The piece turned and scaled so that it leads from `a` to `b`.
Piece led(const Piece& piece, Vec2 a, Vec2 b) {
  const Vec2 from = start_point(piece), to = end_point(piece);
  if (from == a && to == b) return piece;
  if (is_line(piece)) return LinePiece{a, b};
  const double ratio = norm(b - a) / norm(to - from), turn = turning(to - from, b - a);
  if (const auto* arc = std::get_if<ArcPiece>(&piece)) {
    return ArcPiece{a, b, arc->theta0 + turn, arc->kappa / ratio, arc->length * ratio};
  }
  if (const auto* c = std::get_if<ClothoidPiece>(&piece)) {
    return ClothoidPiece{
        a, b, c->theta0 + turn, c->kappa0 / ratio, c->kappa1 / ratio, c->length * ratio};
  }
  RationalBezier out = std::get<RationalBezier>(piece);
  const Vec2 spin = ratio * unit_at(turn);
  const Vec2 first = out.offset[0];
  for (int j = 0; j <= out.degree; ++j) {
    Vec2& offset = out.offset[static_cast<std::size_t>(j)];
    offset = complex_product(spin, offset - first);
  }
  out.origin = a;
  out.offset[static_cast<std::size_t>(out.degree)] = b - a;
  return out;
}

bool is_fixed(const DrawnPiece& piece) { return piece.kept && !is_line(piece.piece); }

}  // namespace

double join_ends(std::vector<DrawnPiece>& pieces, bool closed, double size) {
  const std::size_t n = pieces.size();
  std::vector<Vec2> joint(n + 1);
  double widest = 0.0;
  for (std::size_t j = 0; j <= n; ++j) {
    const bool first = j == 0 && !closed, last = j == n && !closed;
    const DrawnPiece& before = pieces[(j + n - 1) % n];
    const DrawnPiece& after = pieces[j % n];
    const Vec2 end = end_point(before.piece), start = start_point(after.piece);
    joint[j] = first || (!last && is_fixed(after) && !is_fixed(before)) ? start : end;
    if (!first && !last) widest = std::max(widest, norm(end - start));
  }
  if (widest > kMeet * size) return widest / size;
  for (std::size_t i = 0; i < n; ++i) {
    pieces[i].piece = led(pieces[i].piece, joint[i], joint[i + 1]);
  }
  return 0.0;
}

namespace {

/// How sure the two ends of a conic are that its curvature changes one way between them, of their
/// legs: negative where it does not (docs/methods/conics.md, section 2, divided by the legs).
struct ConicEnds {
  double leg_a = 0.0, leg_b = 0.0, product = 0.0;  ///< squares of the legs a and b, and a b
  double way = 1.0, first = 0.0, last = 0.0;
};

ConicEnds conic_ends(const RationalBezier& arc) {
  const Vec2 a = arc.offset[1] - arc.offset[0], b = arc.offset[2] - arc.offset[1];
  ConicEnds out{dot(a, a), dot(b, b), dot(a, b), 1.0, 0.0, 0.0};
  out.way = out.leg_b > out.leg_a ? 1.0 : -1.0;
  const double twice = 2.0 * arc.weight[1] * arc.weight[1] / (arc.weight[0] * arc.weight[2]);
  out.first = out.way * (1.0 + out.product / out.leg_a - twice);
  out.last = out.way * (twice - 1.0 - out.product / out.leg_b);
  return out;
}

/// An arc that ends in vertices of its ellipse has none inside, but rounding decides that. With
/// twice the squared weight 1 + e the curvature changes one way when a b lies between e A and e B,
/// A and B the squares of the legs: the middle control point and the weight are moved by the least
/// of e, a power of ten, that makes it sure. False where nothing does.
bool opened(RationalBezier& arc) {
  constexpr double kSure = 1e-14;                 // some fifty roundings
  constexpr double kLeast = 1e-13, kMost = 1e-8;  // e: how far the arc moves, of its size
  const RationalBezier given = arc;
  const ConicEnds at = conic_ends(given);
  const auto sure = [&] {
    const ConicEnds now = conic_ends(arc);
    return now.leg_a != now.leg_b && now.first >= kSure && now.last >= kSure;
  };
  for (double e = kLeast; !sure(); e *= 10.0) {
    if (e > kMost || arc.degree != 2) return false;
    arc = given;
    const bool first = at.first < e, last = at.last < e;
    if (first && last) {
      const Vec2 step = (arc.offset[2] - arc.offset[1]) - (arc.offset[1] - arc.offset[0]);
      const double wanted = 0.5 * e * (at.leg_a + at.leg_b);
      arc.offset[1] = arc.offset[1] + ((wanted - at.product) / dot(step, step)) * step;
      arc.weight[1] = std::sqrt(0.5 * (1.0 + e));
    } else {
      arc.weight[1] *= 1.0 + (first ? -at.way : at.way) * e;
    }
  }
  return true;
}

}  // namespace

void open_vertices(std::vector<DrawnPiece>& pieces) {
  for (DrawnPiece& one : pieces) {
    auto* conic = std::get_if<RationalBezier>(&one.piece);
    if (one.kept && conic != nullptr) one.kept = opened(*conic);
  }
}

}  // namespace obvid::pipeline_detail
