// SPDX-License-Identifier: Apache-2.0
// Monotone polynomial B-spline along a contour of spirals: docs/methods/monotone_bspline.md.
#include "obvid/contour/bsplines/monotone.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "contour_length.h"
#include "quintic_span.h"

namespace obvid {
namespace {

using bsplines::ContourLength;
using bsplines::Quintic;

/// Places at which a span is measured, at least; its error s^3 (L - s)^3 has no finer features.
constexpr int kErrorSamples = 24;
constexpr int kLeastPerPiece = 2;
/// What the largest of these may be, so that nothing between them exceeds the tolerance.
constexpr double kOfMonotoneTolerance = 0.98;

/// Where no span goes on, the one before it is shortened to this part, so many times in a run.
constexpr double kRetreat = 0.6;
constexpr int kMostRetreats = 24;

/// A span that was tried.
struct Span {
  double from = 0.0, to = 0.0;  ///< places on the contour
  Element start, end;
  Quintic points{};
  double length = 0.0;
  double deviation = 0.0;
};

class SplineBuilder {
 public:
  SplineBuilder(const Contour& contour, double tolerance, Watch& watch)
      : contour_(contour), tolerance_(tolerance), watch_(watch), length_(contour, watch) {}

  Result<MonotoneSpline> build() {
    for (const Run& run : contour_.runs) {
      if (watch_.cancelled()) return fail(cancelled_error());
      if (!append_run(run)) {
        const auto piece = static_cast<std::size_t>(failed_at_);
        return error(ErrorCode::kRoundingDecides, "no polynomial span is monotone there in doubles")
            .where("piece " + std::to_string(piece + 1))
            .hint("take the spirals themselves")
            .point(piece)
            .value(failed_at_);
      }
    }
    return assemble();
  }

 private:
  bool append_run(const Run& run) {
    const auto first = static_cast<double>(run.first_piece);
    const auto last = static_cast<double>(run.last_piece) + 1.0;
    if (run.direction == 0) {  // straight: every piece is a span, exactly
      for (double at = first; at < last; at += 1.0) keep(make(at, at + 1.0), 0);
      return true;
    }
    // from the whole run downwards: rounding may spoil short spans where long ones are monotone
    const std::size_t before = spans_.size();
    double at = first, step = last - first, until = last;
    for (int retreats = 0; at < last;) {
      const auto span = longest(at, until, step, run.direction);
      if (span) {
        keep(*span, run.direction);
        step = 2.0 * (span->to - at);
        at = span->to;
        until = last;
      } else if (spans_.size() > before && retreats++ < kMostRetreats) {
        // a span that goes as far as it can may leave no room for the next one
        at = spans_.back().from;
        until = at + kRetreat * (spans_.back().to - at);
        step = until - at;
        spans_.pop_back();
        direction_.pop_back();
      } else {
        failed_at_ = at;
        return false;
      }
    }
    return true;
  }

  /// The longest span from `at` that does, nearly: doubled while it does, halved until it does, and
  /// then cut between the two. `step` is where to begin.
  std::optional<Span> longest(double at, double last, double step, int direction) const {
    constexpr double kShortest = 1e-4;  // of a piece
    constexpr int kCuts = 5;            // the rest is 3 % of the span
    std::optional<Span> good;
    double high = 0.0;  // least step that failed
    while (!good && step > kShortest) {
      good = attempt(at, std::min(at + step, last), direction);
      if (!good) {
        high = step;
        step *= 0.5;
      }
    }
    while (good && high == 0.0 && good->to < last) {
      const double further = 2.0 * (good->to - at);
      const auto next = attempt(at, std::min(at + further, last), direction);
      if (next) {
        good = next;
      } else {
        high = further;
      }
    }
    for (int k = 0; good && high > 0.0 && k < kCuts; ++k) {
      const double middle = 0.5 * (good->to - at + std::min(high, last - at));
      if (const auto next = attempt(at, at + middle, direction)) {
        good = next;
      } else {
        high = middle;
      }
    }
    return good;
  }

  Span make(double from, double to) const {
    Span s{from, to, length_.element(from), length_.element(to), {}, 0.0, 0.0};
    if (!spans_.empty()) s.start = spans_.back().end;
    s.length = length_.at(to) - length_.at(from);
    s.points = bsplines::hermite_quintic(s.start, s.end, s.length);
    return s;
  }

  std::optional<Span> attempt(double from, double to, int direction) const {
    Span s = make(from, to);
    if (bsplines::curvature_direction(s.points) != direction || !measure(s)) return std::nullopt;
    return s;
  }

  /// Distance between points of equal arc length. False as soon as one exceeds the tolerance.
  bool measure(Span& s) const {
    const double start = length_.at(s.from);
    for (double piece = std::floor(s.from); piece < s.to; piece += 1.0) {
      const double low = std::max(s.from, piece), high = std::min(s.to, piece + 1.0);
      // pieces of uneven length share the places by their lengths
      const double part = (length_.at(high) - length_.at(low)) / s.length;
      const int each = std::max(kLeastPerPiece, static_cast<int>(std::ceil(part * kErrorSamples)));
      for (int i = 0; i < each; ++i) {
        const double place = low + (high - low) * i / each;  // joints are input points, mostly
        const double t = (length_.at(place) - start) / s.length;
        s.deviation =
            std::max(s.deviation, norm(bsplines::point_at(s.points, t) - length_.point(place)));
        if (!(s.deviation <= kOfMonotoneTolerance * tolerance_)) return false;
      }
    }
    return true;
  }

  void keep(const Span& s, int direction) {
    spans_.push_back(s);
    direction_.push_back(static_cast<std::int8_t>(direction));
  }

  /// Knots of multiplicity 3: of a span [u, v] the blossoms (uuuvv), (uuvvv) are its own control
  /// points 2 and 3, (uvvvw) with the next knot w lies on the line from 3 to 4.
  MonotoneSpline assemble() {
    MonotoneSpline out;
    out.direction = std::move(direction_);
    NurbsCurve& curve = out.curve;
    curve.degree = 5;
    const Quintic& first = spans_.front().points;
    curve.points = {first[0], first[1]};
    curve.knots.assign(6, 0.0);
    out.elements.push_back(spans_.front().start);
    double u = 0.0;
    for (std::size_t i = 0; i < spans_.size(); ++i) {
      const Span& s = spans_[i];
      const bool last = i + 1 == spans_.size();
      const double on = last ? 0.0 : spans_[i + 1].length / s.length;
      curve.points.insert(curve.points.end(), {s.points[2], s.points[3]});
      curve.points.push_back(s.points[4] + on * (s.points[4] - s.points[3]));
      u += s.length;
      curve.knots.insert(curve.knots.end(), last ? 6 : 3, u);
      out.elements.push_back(s.end);
      out.deviation = std::max(out.deviation, s.deviation);
      RationalBezier piece;
      piece.degree = 5;
      std::copy(s.points.begin(), s.points.end(), piece.offset.begin());
      std::fill_n(piece.weight.begin(), 6, 1.0);
      out.spans.push_back(piece);
    }
    curve.points.push_back(spans_.back().points[5]);
    curve.weights.assign(curve.points.size(), 1.0);
    return out;
  }

  const Contour& contour_;
  double tolerance_;
  Watch& watch_;
  ContourLength length_;
  std::vector<Span> spans_;
  std::vector<std::int8_t> direction_;
  double failed_at_ = 0.0;
};

tl::unexpected<Error> unsupported(const char* what, std::size_t piece) {
  return error(ErrorCode::kUnsupported, what)
      .where("piece " + std::to_string(piece + 1))
      .hint("take the spirals themselves")
      .point(piece);
}

}  // namespace

Result<MonotoneSpline> monotone_spline(const Contour& spiral, double tolerance) {
  Watch nobody;
  return monotone_spline(spiral, tolerance, nobody);
}

Result<MonotoneSpline> monotone_spline(const Contour& spiral, double tolerance, Watch& watch) {
  if (!(tolerance > 0.0)) {
    return error(ErrorCode::kBadOption, "the tolerance must be greater than 0").value(tolerance);
  }
  if (spiral.pieces.empty()) {
    return error(ErrorCode::kNothingThere, "the contour has no pieces");
  }
  for (std::size_t i = 0; i < spiral.pieces.size(); ++i) {
    if (std::holds_alternative<ArcPiece>(spiral.pieces[i])) {
      return unsupported("no polynomial has the constant curvature of an arc", i);
    }
  }
  for (std::size_t i = 0; i < spiral.joints.size(); ++i) {
    if (spiral.joints[i].leaving) return unsupported("the contour has a corner", i);
  }
  return SplineBuilder(spiral, tolerance, watch).build();
}

}  // namespace obvid
