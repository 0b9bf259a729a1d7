// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "obvid/core/format_into.h"
#include "obvid/region/refine.h"

namespace obvid {
namespace {

constexpr std::size_t kMostSamples = 10'000'000;
constexpr double kDefaultChord = 1e-4;  // of the length
constexpr int kMostChords = 1 << 20;    // of a piece
constexpr double kNoCorner = 1e-6;      // rad: no corner

Error bad(const char* what, double value) {
  return {ErrorCode::kBadOption, what, "", "give a positive number", -1, value};
}

/// Pieces by their lengths, and places on them by arc length.
class Track {
 public:
  explicit Track(std::span<const Piece> pieces) : pieces_(pieces) {
    starts_.push_back(0.0);
    double rough = 0.0;
    for (const Piece& piece : pieces) rough += norm(end_point(piece) - start_point(piece));
    constexpr double kExact = 1e-13;
    for (const Piece& piece : pieces) {
      starts_.push_back(starts_.back() + arc_length(piece, kExact * rough));
    }
    tolerance_ = kExact * rough;
  }

  [[nodiscard]] double length() const { return starts_.back(); }
  [[nodiscard]] double start(std::size_t piece) const { return starts_[piece]; }

  /// Sample at a parameter of a piece, its heading near `theta`.
  [[nodiscard]] CurveSample at(std::size_t piece, double t, double s, double theta) const {
    const Element e = element_at(pieces_[piece], t);
    return {e.point, s, theta + std::remainder(e.theta - theta, 2.0 * std::numbers::pi), e.kappa};
  }

  [[nodiscard]] CurveSample at_length(double s, double theta) const {
    const auto next = std::upper_bound(starts_.begin() + 1, starts_.end() - 1, s);
    const auto piece = static_cast<std::size_t>(next - starts_.begin()) - 1;
    return at(piece, parameter(piece, s - starts_[piece]), s, theta);
  }

  /// Arc length of the first part of a piece.
  [[nodiscard]] double partial(std::size_t piece, double t) const {
    if (t <= 0.0) return 0.0;
    if (const auto* bezier = std::get_if<RationalBezier>(&pieces_[piece])) {
      return t >= 1.0 ? starts_[piece + 1] - starts_[piece]
                      : arc_length(Piece{split(*bezier, t)[0]}, tolerance_);
    }
    return t * (starts_[piece + 1] - starts_[piece]);  // lines, arcs, clothoids run evenly
  }

 private:
  /// Newton's method for the parameter at which a piece has this length, kept between bounds.
  [[nodiscard]] double parameter(std::size_t piece, double length) const {
    const double whole = starts_[piece + 1] - starts_[piece];
    if (!(length > 0.0) || whole == 0.0) return 0.0;
    if (length >= whole) return 1.0;
    double low = 0.0, high = 1.0, t = length / whole;
    if (!std::holds_alternative<RationalBezier>(pieces_[piece])) return t;
    constexpr int kSteps = 40;
    for (int k = 0; k < kSteps; ++k) {
      const double error = partial(piece, t) - length;
      if (std::abs(error) <= 4.0 * tolerance_) break;
      (error > 0.0 ? high : low) = t;
      const double newton = t - error / norm(evaluate(pieces_[piece], t).d1);
      t = newton > low && newton < high ? newton : 0.5 * (low + high);
    }
    return t;
  }

  std::span<const Piece> pieces_;
  std::vector<double> starts_;
  double tolerance_ = 0.0;
};

std::vector<CurveSample> at_lengths(const Track& track, std::size_t count, double step) {
  std::vector<CurveSample> out;
  out.reserve(count);
  double theta = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double s = i + 1 == count ? track.length() : static_cast<double>(i) * step;
    out.push_back(track.at_length(s, theta));
    theta = out.back().theta;
  }
  return out;
}

/// Equal steps of the parameter so many that each chord is near enough, measured at its middle.
int chords_of(const Piece& piece, double tolerance) {
  int n = std::holds_alternative<LinePiece>(piece) ? 1 : 2;
  for (; n < kMostChords; n *= 2) {
    double most = 0.0;
    Vec2 before = start_point(piece);
    for (int k = 1; k <= n && most <= tolerance; ++k) {
      const Vec2 here = evaluate(piece, static_cast<double>(k) / n).point;
      const Vec2 middle = evaluate(piece, (k - 0.5) / n).point, chord = here - before;
      const double length = norm(chord);
      most = std::max(most, length > 0.0 ? std::abs(cross(chord, middle - before)) / length
                                         : norm(middle - before));
      before = here;
    }
    if (n == 1 || most <= tolerance) break;
  }
  return n;
}

Result<std::vector<CurveSample>> by_chords(std::span<const Piece> pieces, const Track& track,
                                           double tolerance) {
  std::vector<CurveSample> out;
  double theta = 0.0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const int n = chords_of(pieces[i], tolerance);
    if (out.size() + static_cast<std::size_t>(n) > kMostSamples) {
      return fail({ErrorCode::kBadOption, "this tolerance asks for more than ten million samples",
                   "", "choose a larger one", -1, tolerance});
    }
    for (int k = 0; k <= n; ++k) {
      const double t = static_cast<double>(k) / n;
      const CurveSample one = track.at(i, t, track.start(i) + track.partial(i, t), theta);
      theta = one.theta;
      const bool joint = k == 0 && !out.empty();
      const bool corner = joint && std::abs(one.theta - out.back().theta) > kNoCorner;
      if (!joint || corner) out.push_back(one);
    }
  }
  return out;
}

/// Letters and digits of a unit: it becomes part of a column's name.
std::string plain(const Units& units) {
  std::string out;
  for (const char c : units.text()) {
    if ((c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')) out += c;
  }
  return out.empty() ? "unit" : out;
}

std::vector<Vec2> distinct(const std::vector<CurveSample>& samples, bool closed) {
  std::vector<Vec2> out;
  for (const CurveSample& one : samples) {
    if (out.empty() || !(one.point == out.back())) out.push_back(one.point);
  }
  if (closed && out.size() > 1) out.pop_back();
  return out;
}

}  // namespace

Result<std::vector<CurveSample>> sample(std::span<const Piece> pieces,
                                        const SampleOptions& options) {
  if (pieces.empty()) {
    return fail({ErrorCode::kTooFewPoints, "there is no curve to sample", "", "", -1, 0.0});
  }
  const Track track(pieces);
  if (options.count) {
    if (*options.count < 2 || *options.count > kMostSamples) {
      return fail(
          bad("two to ten million samples are possible", static_cast<double>(*options.count)));
    }
    return at_lengths(track, *options.count,
                      track.length() / static_cast<double>(*options.count - 1));
  }
  if (options.step) {
    const double count = std::ceil(track.length() / *options.step * (1.0 - 1e-12)) + 1.0;
    if (!(*options.step > 0.0) || !(count <= static_cast<double>(kMostSamples))) {
      return fail(bad("the step must be positive, and not for more than ten million samples",
                      *options.step));
    }
    return at_lengths(track, std::max<std::size_t>(2, static_cast<std::size_t>(count)),
                      *options.step);
  }
  const double tolerance = options.chord_tolerance.value_or(kDefaultChord * track.length());
  if (!(tolerance > 0.0)) return fail(bad("the chord tolerance must be positive", tolerance));
  return by_chords(pieces, track, tolerance);
}

Result<std::string> samples_csv(const Contour& contour, const SampleOptions& options) {
  const auto samples = sample(contour.pieces, options);
  if (!samples) return tl::unexpected(samples.error());
  const std::string unit = plain(contour.units);
  std::string out =
      contour.units.known()
          ? fmt::format("s_{0},x_{0},y_{0},heading_deg,curvature_1_per_{0},normal_x,normal_y\n",
                        unit)
          : "s,x,y,heading_deg,curvature,normal_x,normal_y\n";
  for (const CurveSample& one : *samples) {
    const Vec2 normal = left_normal(unit_at(one.theta));
    format_into(out, "{},{},{},{},{},{},{}\n", one.s, one.point.x, one.point.y,
                one.theta * 180.0 / std::numbers::pi, one.kappa, normal.x, normal.y);
  }
  return out;
}

Result<std::string> obj_text(const Contour& contour, const SampleOptions& options) {
  const auto samples = sample(contour.pieces, options);
  if (!samples) return tl::unexpected(samples.error());
  const std::vector<Vec2> points = distinct(*samples, contour.closed);
  std::string out = "# Obvid contour, lengths in " + plain(contour.units) + "\n";
  for (const Vec2 p : points) format_into(out, "v {} {} 0\n", p.x, p.y);
  out += "l";
  for (std::size_t i = 1; i <= points.size(); ++i) {
    format_into(out, " {}", i);
  }
  return out + (contour.closed ? " 1\n" : "\n");
}

Result<std::string> ply_text(const Contour& contour, const SampleOptions& options) {
  const auto samples = sample(contour.pieces, options);
  if (!samples) return tl::unexpected(samples.error());
  const std::vector<Vec2> points = distinct(*samples, contour.closed);
  const std::size_t edges = points.size() - (contour.closed ? 0 : 1);
  std::string out = fmt::format(
      "ply\nformat ascii 1.0\ncomment Obvid contour, lengths in {}\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\nelement edge {}\n"
      "property int vertex1\nproperty int vertex2\nend_header\n",
      plain(contour.units), points.size(), edges);
  for (const Vec2 p : points) format_into(out, "{} {} 0\n", p.x, p.y);
  for (std::size_t i = 0; i < edges; ++i) {
    format_into(out, "{} {}\n", i, (i + 1) % points.size());
  }
  return out;
}

}  // namespace obvid
