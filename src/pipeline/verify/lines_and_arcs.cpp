// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/lines_and_arcs.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "obvid/geom/internal/circle.h"

namespace obvid {
namespace {

constexpr std::size_t kFewestPoints = 4;
constexpr double kSameCircle = 1e-12;  ///< curvatures of parts of one arc, of themselves

std::optional<LineOrArc> shape_of(const Piece& piece) {
  LineOrArc out;
  if (const auto* line = std::get_if<LinePiece>(&piece)) {
    const Vec2 along = line->end - line->start;
    out.theta = std::atan2(along.y, along.x);
    out.length = norm(along);
    return out;
  }
  const auto* arc = std::get_if<ArcPiece>(&piece);
  if (arc == nullptr) return std::nullopt;
  out.theta = arc->theta0;
  out.kappa = arc->kappa;
  out.length = arc->length;
  out.centre = arc->start + (1.0 / arc->kappa) * left_normal(unit_at(arc->theta0));
  return out;
}

/// Pieces of a contour that are one line or arc: neighbours of one curvature without a corner
/// between them, and what leads to the first point and on from the last one.
class Stretches {
 public:
  explicit Stretches(const Contour& contour) : c_(contour), pieces_(contour.pieces.size()) {}

  std::vector<LineOrArc> run() const {
    std::vector<LineOrArc> out;
    const std::size_t begin = beginning();
    for (std::size_t done = 0; done < pieces_;) {
      const std::size_t first = (begin + done) % pieces_;
      std::size_t count = 1;
      while (done + count < pieces_ && goes_on(joint_behind(first + count - 1))) ++count;
      if (const auto one = stretch(first, count)) out.push_back(*one);
      done += count;
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const LineOrArc& a, const LineOrArc& b) { return a.from < b.from; });
    return out;
  }

 private:
  /// A piece where none is cut by the start of a closed contour.
  [[nodiscard]] std::size_t beginning() const {
    if (!c_.closed) return 0;
    for (std::size_t k = 0; k < pieces_; ++k) {
      if (!goes_on(k)) return k;
    }
    return 0;
  }

  [[nodiscard]] std::size_t joint_behind(std::size_t piece) const {
    const std::size_t next = piece % pieces_ + 1;
    return c_.closed ? next % pieces_ : next;
  }

  [[nodiscard]] bool is_kept(std::size_t piece) const {
    return std::find(c_.kept.begin(), c_.kept.end(), piece) != c_.kept.end();
  }

  /// Whether both sides of a joint are parts of one line or arc.
  [[nodiscard]] bool goes_on(std::size_t joint) const {
    if (!c_.closed && (joint == 0 || joint == pieces_)) return false;
    const std::size_t before = (joint + pieces_ - 1) % pieces_, after = joint % pieces_;
    if (before == after || c_.joints[joint].leaving || is_kept(before) || is_kept(after)) {
      return false;
    }
    const auto a = shape_of(c_.pieces[before]), b = shape_of(c_.pieces[after]);
    if (!a || !b || (a->kappa == 0.0) != (b->kappa == 0.0)) return false;
    return std::abs(a->kappa - b->kappa) <= kSameCircle * std::abs(a->kappa);
  }

  [[nodiscard]] std::optional<LineOrArc> stretch(std::size_t first, std::size_t count) const {
    if (is_kept(first)) return std::nullopt;
    auto one = shape_of(c_.pieces[first]);
    if (!one) return std::nullopt;
    one->length = 0.0;
    std::optional<std::size_t> from, to;
    const auto take = [&](std::size_t joint) {
      const auto source = c_.joints[joint].source;
      const auto place = source ? source : c_.joints[joint].after;
      if (!place) return;
      (from ? to : from) = place;
    };
    take(first);
    if (from && !c_.joints[first].source) from = (*from + 1) % c_.points.size();
    std::size_t longest = first;
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t piece = (first + k) % pieces_;
      const double length = shape_of(c_.pieces[piece])->length;
      one->length += length;
      if (length > shape_of(c_.pieces[longest])->length) longest = piece;
      take(joint_behind(piece));
    }
    const std::size_t n = c_.points.size();
    if (!from || !to) return std::nullopt;
    if (!c_.closed && *to < *from) return std::nullopt;
    const std::size_t over = *to > *from ? *to - *from : *to + n - *from;
    if (std::min(over + 1, n) < kFewestPoints) return std::nullopt;
    one->from = *from;
    one->to = *to;
    const auto known = *shape_of(c_.pieces[longest]);  // best, of so many roundings
    one->kappa = known.kappa;
    one->centre = known.centre;
    if (one->kappa == 0.0) one->theta = known.theta;
    const Vec2 start = start_point(c_.pieces[longest]);
    for (std::size_t i = 0; i <= over; ++i) {
      one->off = std::max(one->off, distance_from_circle(start, known.theta, known.kappa,
                                                         c_.points[(*from + i) % n]));
    }
    return one;
  }

  const Contour& c_;
  std::size_t pieces_;
};

}  // namespace

std::vector<LineOrArc> lines_and_arcs(const Contour& contour) {
  if (follows_spirals(contour.carrier) || contour.pieces.empty()) return {};
  return Stretches(contour).run();
}

}  // namespace obvid
