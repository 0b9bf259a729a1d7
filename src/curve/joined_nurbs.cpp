// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/internal/joined_nurbs.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "obvid/core/internal/questions.h"
#include "obvid/numeric/internal/halving.h"

namespace obvid {
namespace {

constexpr double kLargestWeight = 10.0;  // and the least is its inverse
constexpr int kMostCuts = 12;            // halvings of a piece, one after the other
/// Legs that turn by more are no common tangent, whatever the contour says of its joint: a curve
/// that is C1 there would leave the joint. The bound of a certificate, rad.
constexpr double kSmoothTurn = 1e-6;
constexpr double kMostDrift = 20.0;  // of the speed along the curve, against that at its start
constexpr int kRaisedEven = 3;       // likewise where it makes the speeds equal
constexpr int kRaised = 2;           // degrees that the factor adds
constexpr double kMostTurn = 1.3;    // of one conic that stands for an arc, rad: weights near 1

/// Homogeneous Bezier curve whose weight is 1 and stands still at both ends.
struct Segment {
  std::vector<Vec2> points;
  std::vector<double> weights;
  bool corner_before = false;
};

/// Speeds at the ends, in units of the degree: 0 where a control point stands on the end.
double start_speed(const Segment& s) { return norm(s.points[1] - s.points[0]); }
double end_speed(const Segment& s) {
  const std::size_t last = s.points.size() - 1;
  return norm(s.points[last] - s.points[last - 1]);
}

tl::unexpected<Error> refuse(ErrorCode code, const char* what, std::size_t piece,
                             const char* hint) {
  return error(code, what).where("piece " + std::to_string(piece + 1)).hint(hint).point(piece);
}

/// Whether a curve that is C1 where `b` begins would leave that point, by more than rounding.
bool would_leave_joint(const Segment& a, const Segment& b) {
  constexpr double kJointRoundings = 16.0 * 0x1p-53;
  const std::size_t last = a.points.size() - 1;
  const Vec2 joint = b.points[0];
  const Vec2 in = a.points[last] - a.points[last - 1], out = b.points[1] - joint;
  const double turn = std::abs(cross(in, out)) / (norm(in) * norm(out));
  const double away = turn * std::min(norm(in), norm(out));
  return turn > kSmoothTurn && away > kJointRoundings * (std::abs(joint.x) + std::abs(joint.y));
}

double polygon_length(const Segment& s) {
  double length = 0.0;
  for (std::size_t j = 1; j < s.points.size(); ++j) length += norm(s.points[j] - s.points[j - 1]);
  return length;
}

/// Ratios of weight and of its rate at both ends, after the parameter t -> t / (t + (1-t) /
/// lambda).
struct Factor {
  double middle = 1.0;  ///< Bernstein coefficients of the factor: 1, middle, end
  double end = 1.0;
};

std::optional<Factor> factor_for(const RationalBezier& b, double lambda) {
  const auto n = static_cast<std::size_t>(b.degree);
  const double degree = b.degree;
  const double start_rate = degree * (lambda * b.weight[1] / b.weight[0] - 1.0);
  const double end_rate = degree * (1.0 - b.weight[n - 1] / (lambda * b.weight[n]));
  const double middle = 1.0 - 0.5 * start_rate, below = 1.0 + 0.5 * end_rate;
  if (!(middle > 0.0 && below > 0.0)) return std::nullopt;
  return Factor{middle, middle / below};
}

/// The end weight over the start weight, as a logarithm, at x = log lambda.
std::optional<double> imbalance(const RationalBezier& b, double x) {
  const auto factor = factor_for(b, std::exp(x));
  if (!factor) return std::nullopt;
  const auto n = static_cast<std::size_t>(b.degree);
  return std::log(b.weight[n] / b.weight[0]) + b.degree * x + std::log(factor->end);
}

/// Every log lambda that makes the end weights equal. Between the ends of the interval in which the
/// factor is positive the imbalance falls from +infinity to -infinity, nearly flat in its middle:
/// there is one at least, unless the interval is empty.
std::vector<double> balances(const RationalBezier& b) {
  constexpr int kCells = 32;
  constexpr int kHalvings = 60;
  const auto n = static_cast<std::size_t>(b.degree);
  const double reach = std::log1p(2.0 / b.degree);
  const double low = std::log(b.weight[n - 1] / b.weight[n]) - reach;
  const double high = std::log(b.weight[0] / b.weight[1]) + reach;
  std::vector<double> out;
  if (!(low < high)) return out;
  // at the ends themselves: + and -
  const auto positive = [&](double x) {
    const auto f = imbalance(b, x);
    return f ? *f > 0.0 : x < 0.5 * (low + high);
  };
  for (int k = 0; k < kCells; ++k) {
    const double from = low + (high - low) * k / kCells, to = low + (high - low) * (k + 1) / kCells;
    if (positive(from) == positive(to)) continue;
    const bool sign = positive(from);
    const auto as_before = [&](double x) { return positive(x) == sign; };
    out.push_back(end_of_condition(from, to, as_before, kHalvings).middle());
  }
  return out;
}

/// Product of a rational Bezier with weights w_k lambda^k and a factor with the Bernstein
/// coefficients `factor`. Homogeneous points w P, in Bernstein form.
Segment product(const RationalBezier& b, double lambda, const std::vector<double>& factor);

/// Control points as coordinates relative to the start of the piece.
std::vector<Vec2> points_of(const RationalBezier& b) {
  std::vector<Vec2> out;
  for (int j = 0; j <= b.degree; ++j) {
    out.push_back(b.offset[static_cast<std::size_t>(j)] - b.offset[0]);
  }
  return out;
}

double binomial_of(std::size_t n, std::size_t k) {
  double out = 1.0;
  for (std::size_t j = 1; j <= k; ++j) {
    out = out * static_cast<double>(n - k + j) / static_cast<double>(j);
  }
  return out;
}

Segment product(const RationalBezier& b, double lambda, const std::vector<double>& factor) {
  const std::vector<Vec2> local = points_of(b);
  const std::size_t n = local.size() - 1, d = factor.size() - 1, m = n + d;
  Segment out;
  out.points.assign(m + 1, {});
  out.weights.assign(m + 1, 0.0);
  double power = 1.0 / b.weight[0];
  for (std::size_t j = 0; j <= n; ++j) {
    const double w = binomial_of(n, j) * b.weight[j] * power;
    for (std::size_t k = 0; k <= d; ++k) {
      const double part = w * binomial_of(d, k) * factor[k];
      out.weights[j + k] += part;
      out.points[j + k] = out.points[j + k] + part * local[j];
    }
    power *= lambda;
  }
  for (std::size_t j = 0; j <= m; ++j) {
    out.points[j] = out.points[j] / out.weights[j];
    out.weights[j] /= binomial_of(m, j);
  }
  // what the equations say, to the last bit
  for (const std::size_t j : {std::size_t{0}, std::size_t{1}, m - 1, m}) out.weights[j] = 1.0;
  return out;
}

/// Largest ratio of a weight to 1 or of 1 to a weight; infinite when one is not positive.
double spread(const Segment& s) {
  double most = 1.0;
  for (const double w : s.weights) most = std::max({most, w, w > 0.0 ? 1.0 / w : HUGE_VAL});
  return most;
}

/// Of all products with equal end weights the one with weights nearest to 1. Nothing when they are
/// not within their range.
std::optional<Segment> best_segment(const RationalBezier& bezier) {
  std::optional<Segment> best;
  double least = kLargestWeight;
  for (const double x : balances(bezier)) {
    const auto factor = factor_for(bezier, std::exp(x));
    if (!factor) continue;
    Segment segment = product(bezier, std::exp(x), {1.0, factor->middle, factor->end});
    if (!(spread(segment) <= least)) continue;
    least = spread(segment);
    best = std::move(segment);
  }
  return best;
}

/// The product with a cubic factor that leaves lambda free, which then makes the speeds at both
/// ends equal. Nothing when weights leave their range.
std::optional<Segment> even_segment(const RationalBezier& b) {
  const auto n = static_cast<std::size_t>(b.degree);
  const double degree = b.degree;
  const double first = norm(b.offset[1] - b.offset[0]) * b.weight[1] / b.weight[0];
  const double last = norm(b.offset[n] - b.offset[n - 1]) * b.weight[n - 1] / b.weight[n];
  const double lambda = std::sqrt(last / first);
  const double start_rate = degree * (lambda * b.weight[1] / b.weight[0] - 1.0);
  const double end_rate = degree * (1.0 - b.weight[n - 1] / (lambda * b.weight[n]));
  const double end = b.weight[0] / (b.weight[n] * std::pow(lambda, degree));
  const double second = 1.0 - start_rate / 3.0, third = end * (1.0 + end_rate / 3.0);
  if (!(second > 0.0 && third > 0.0 && std::isfinite(end))) return std::nullopt;
  Segment out = product(b, lambda, {1.0, second, third, end});
  if (!(spread(out) <= kLargestWeight)) return std::nullopt;
  return out;
}

Segment raised(const Segment& s) {
  const std::size_t n = s.points.size() - 1;
  Segment out;
  out.corner_before = s.corner_before;
  for (std::size_t j = 0; j <= n + 1; ++j) {
    const double a = static_cast<double>(j) / static_cast<double>(n + 1);
    const double before = j > 0 ? a * s.weights[j - 1] : 0.0;
    const double here = j <= n ? (1.0 - a) * s.weights[j] : 0.0;
    const Vec2 sum =
        (j > 0 ? before * s.points[j - 1] : Vec2{}) + (j <= n ? here * s.points[j] : Vec2{});
    out.weights.push_back(before + here);
    out.points.push_back(sum / (before + here));
  }
  return out;
}

/// Whether the weight is the same at both ends and its rate 0, as far as files keep digits.
bool stands_still(const RationalBezier& b) {
  constexpr double kSame = 1e-9;  // of a weight
  const auto n = static_cast<std::size_t>(b.degree);
  for (const std::size_t j : {std::size_t{1}, n - 1, n}) {
    if (std::abs(b.weight[j] - b.weight[0]) > kSame * b.weight[0]) return false;
  }
  return true;
}

/// All segments of a contour, in plain coordinates.
class Joiner {
 public:
  Joiner(const Contour& contour, Watch* watch) : contour_(contour), watch_(watch) {}

  Result<NurbsCurve> run() {
    OBVID_TRY(add_all());
    if (speed_drift() > kMostDrift) {  // kernels take small derivatives for singular points
      std::vector<Segment> uneven = std::exchange(segments_, {});
      even_ = true;
      // beside an end that is nearly singular no cut makes the speeds equal
      if (!add_all()) segments_ = std::move(uneven);
    }
    raise_all();
    if (is_to_end(watch_)) return fail(cancelled_error());
    return assemble();
  }

 private:
  Result<void> add_all() {
    Questions questions(watch_);
    for (std::size_t i = 0; i < contour_.pieces.size(); ++i) {
      if (questions.end()) return fail(cancelled_error());
      const std::size_t first = segments_.size();
      OBVID_TRY(add(i, contour_.pieces[i]));
      const bool corner = i > 0 && i < contour_.joints.size() && is_corner(contour_.joints[i]);
      segments_[first].corner_before = corner;
    }
    // no ratio of speeds joins what stands still: there the curve is continuous in position only
    for (std::size_t i = 1; i < segments_.size(); ++i) {
      if (!(end_speed(segments_[i - 1]) > 0.0 && start_speed(segments_[i]) > 0.0) ||
          would_leave_joint(segments_[i - 1], segments_[i])) {
        segments_[i].corner_before = true;
      }
    }
    return {};
  }

  /// Largest ratio of two speeds along the curve between corners.
  [[nodiscard]] double speed_drift() const {
    double speed = 1.0, least = 1.0, most = 1.0, drift = 1.0;
    for (const Segment& s : segments_) {
      if (s.corner_before) speed = least = most = 1.0;
      if (!(start_speed(s) > 0.0 && end_speed(s) > 0.0)) continue;
      speed *= end_speed(s) / start_speed(s);
      least = std::min(least, speed);
      most = std::max(most, speed);
      drift = std::max(drift, most / least);
    }
    return drift;
  }

  Result<void> add(std::size_t i, const Piece& piece) {
    if (const auto* bezier = std::get_if<RationalBezier>(&piece)) return add(i, *bezier, 0);
    if (const auto* line = std::get_if<LinePiece>(&piece)) {
      segments_.push_back({{line->start, line->end}, {1.0, 1.0}});
      return {};
    }
    if (const auto* arc = std::get_if<ArcPiece>(&piece)) return add(i, *arc);
    return refuse(ErrorCode::kUnsupported, "a clothoid is no NURBS curve", i,
                  "form the contour with --carrier spiral or bspline");
  }

  /// Conics of equal turn; the last one ends where the arc's stored end is.
  Result<void> add(std::size_t i, const ArcPiece& arc) {
    const double turn = arc.kappa * arc.length;
    const int count = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / kMostTurn)));
    const double part = turn / count;
    Vec2 start = arc.start;
    for (int k = 0; k < count; ++k) {
      const double theta = arc.theta0 + k * part;
      const double chord = 2.0 * std::sin(0.5 * part) / arc.kappa;
      const Vec2 along = unit_at(theta + 0.5 * part);
      const Vec2 end = k + 1 == count ? arc.end : start + chord * along;
      RationalBezier conic;
      conic.degree = 2;
      conic.origin = start;
      conic.offset[1] = (0.5 * chord / std::cos(0.5 * part)) * unit_at(theta);
      conic.offset[2] = end - start;
      conic.weight = {1.0, std::cos(0.5 * part), 1.0};
      OBVID_TRY(add(i, conic, 0));
      segments_.back().points.back() = end;
      start = end;
    }
    return {};
  }

  Result<void> add(std::size_t i, const RationalBezier& bezier, int cuts) {
    if (is_polynomial(bezier)) {
      keep(bezier, {points_of(bezier), std::vector<double>(std::size_t(bezier.degree) + 1, 1.0)});
      return {};
    }
    // speeds of which one is 0 cannot be made equal
    const bool even =
        even_ && !is_singular_end(Piece{bezier}, 0.0) && !is_singular_end(Piece{bezier}, 1.0);
    const bool too_high = bezier.degree + kRaisedEven > kMaxBezierDegree;
    if (stands_still(bezier) && (!even || too_high)) {  // from here, through other systems
      Segment segment{points_of(bezier), {}, false};
      for (int j = 0; j <= bezier.degree; ++j) {
        segment.weights.push_back(bezier.weight[static_cast<std::size_t>(j)] / bezier.weight[0]);
      }
      if (spread(segment) <= kLargestWeight) {
        keep(bezier, std::move(segment));
        return {};
      }
    }
    const int raised = even ? kRaisedEven : kRaised;
    if (bezier.degree + raised > kMaxBezierDegree) {
      return refuse(ErrorCode::kUnsupported, "a rational piece has degree 6 or more", i,
                    "approximate it by a spline first");
    }
    if (const auto segment = even ? even_segment(bezier) : best_segment(bezier)) {
      keep(bezier, *segment);
      return {};
    }
    if (cuts == kMostCuts) {
      return refuse(ErrorCode::kNotProved, "the weights of a piece do not come into [0.1, 10]", i,
                    "look at the weights of this piece: all must be positive");
    }
    for (const RationalBezier& half : split(bezier, 0.5)) {
      OBVID_TRY(add(i, half, cuts + 1));
    }
    return {};
  }

  /// From coordinates relative to the start of the piece to plain ones. The end is the piece's own.
  void keep(const RationalBezier& bezier, Segment segment) {
    const Vec2 start = bezier.origin + bezier.offset[0];
    for (Vec2& p : segment.points) p = start + p;
    segment.points.back() = bezier.origin + bezier.offset[static_cast<std::size_t>(bezier.degree)];
    segments_.push_back(std::move(segment));
  }

  void raise_all() {
    constexpr std::size_t kLeastDegree = 2;  // one degree more than multiplicity 1
    std::size_t points = kLeastDegree + 1;
    for (const Segment& s : segments_) points = std::max(points, s.points.size());
    Questions questions(watch_);
    for (Segment& s : segments_) {
      if (questions.end()) return;
      while (s.points.size() < points) s = raised(s);
    }
  }

  /// Knot spans in the ratio of the speeds at each joint; the joint's own control point follows
  /// from its neighbours and is left out, but at corners.
  [[nodiscard]] Result<NurbsCurve> assemble() const {
    constexpr double kLeastSpan = 8.0 * 0x1p-53;  // of the knot: kernels take less for nothing
    NurbsCurve curve;
    const std::size_t degree = segments_.front().points.size() - 1;
    curve.degree = static_cast<int>(degree);
    curve.knots.assign(degree + 1, 0.0);
    double knot = 0.0, speed = 1.0;
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      const Segment& s = segments_[i];
      if (i == 0 || s.corner_before) speed = 1.0 / static_cast<double>(degree);
      const double at_start = start_speed(s);
      const double span = at_start > 0.0 ? at_start / speed : polygon_length(s);
      speed = end_speed(s) / span;
      knot += span;
      if (!(span > kLeastSpan * knot)) {
        return error(ErrorCode::kNotProved, "a piece is too short beside the others for a knot")
            .hint("merge the points that nearly coincide")
            .value(span / knot);
      }
      const bool last = i + 1 == segments_.size();
      const bool corner_after = !last && segments_[i + 1].corner_before;
      const std::size_t from = i == 0 ? 0 : 1;
      const std::size_t to = last || corner_after ? degree + 1 : degree;
      for (std::size_t j = from; j < to; ++j) {
        curve.points.push_back(s.points[j]);
        curve.weights.push_back(s.weights[j]);
      }
      const std::size_t multiplicity = last ? degree + 1 : corner_after ? degree : degree - 1;
      curve.knots.insert(curve.knots.end(), multiplicity, knot);
    }
    if (contour_.closed) curve.points.back() = curve.points.front();
    return curve;
  }

  const Contour& contour_;
  Watch* watch_;
  bool even_ = false;  // equal speeds at both ends of each segment, at the cost of a degree
  std::vector<Segment> segments_;
};

/// Whether a piece goes on where the curve ends, as it stands.
bool joins(const RationalBezier& piece, const NurbsCurve& before) {
  const auto last = static_cast<std::size_t>(piece.degree);
  if (piece.origin != Vec2{} || piece.weight[0] != 1.0 || piece.weight[last] != 1.0) return false;
  if (before.points.empty()) return true;
  return piece.degree == before.degree && piece.offset[0] == before.points.back();
}

}  // namespace

Result<NurbsCurve> joined_nurbs(const Contour& contour, Watch* watch) {
  if (contour.pieces.empty()) {
    return error(ErrorCode::kNothingThere, "the contour has no pieces");
  }
  return Joiner(contour, watch).run();
}

std::optional<NurbsCurve> as_one_nurbs(const Contour& contour) {
  NurbsCurve curve;
  for (std::size_t i = 0; i < contour.pieces.size(); ++i) {
    const auto* piece = std::get_if<RationalBezier>(&contour.pieces[i]);
    if (piece == nullptr || !joins(*piece, curve)) return std::nullopt;
    curve.degree = piece->degree;
    const auto p = static_cast<std::size_t>(piece->degree);
    for (std::size_t j = i == 0 ? 0 : 1; j <= p; ++j) {
      curve.points.push_back(piece->offset[j]);
      curve.weights.push_back(piece->weight[j]);
    }
    curve.knots.insert(curve.knots.end(), i == 0 ? p + 1 : p, static_cast<double>(i));
  }
  if (curve.points.empty()) return std::nullopt;
  if (contour.closed && curve.points.back() != curve.points.front()) return std::nullopt;
  curve.knots.insert(curve.knots.end(), static_cast<std::size_t>(curve.degree) + 1,
                     static_cast<double>(contour.pieces.size()));
  return curve;
}

}  // namespace obvid
