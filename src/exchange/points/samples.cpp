// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/points/samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "obvid/core/internal/format_into.h"
#include "obvid/core/internal/questions.h"
#include "obvid/curve/internal/contour_path.h"
#include "obvid/curve/internal/flatten.h"
#include "obvid/geom/internal/angle.h"

namespace obvid {
namespace {

constexpr std::size_t kMostSamples = 10'000'000;
constexpr double kDefaultChord = 1e-4;  // of the length
constexpr int kMostChords = 1 << 20;    // of a piece
constexpr double kNoCorner = 1e-6;      // rad: no corner

Error bad(const char* what, double value) {
  return error(ErrorCode::kBadOption, what).hint("give a positive number").value(value);
}

/// Sample at a parameter of a piece, its heading near `theta`.
CurveSample sample_at(const ContourPath& path, ContourPath::Parameter at, double s, double theta) {
  const Element e = element_at(path.pieces()[at.piece], at.t);
  return {e.point, s, nearest_angle(e.theta, theta), e.kappa};
}

Result<std::vector<CurveSample>> at_lengths(const ContourPath& path, std::size_t count, double step,
                                            Questions questions) {
  std::vector<CurveSample> out;
  out.reserve(count);
  double theta = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    if (questions.end()) return fail(cancelled_error());
    const double s = i + 1 == count ? path.length() : static_cast<double>(i) * step;
    out.push_back(sample_at(path, path.parameter(s), s, theta));
    theta = out.back().theta;
  }
  return out;
}

Result<std::vector<CurveSample>> by_chords(const ContourPath& path, double tolerance,
                                           Questions questions) {
  std::vector<CurveSample> out;
  double theta = 0.0;
  for (std::size_t i = 0; i < path.pieces().size(); ++i) {
    if (questions.end()) return fail(cancelled_error());
    const Piece& piece = path.pieces()[i];
    const int fewest = std::holds_alternative<LinePiece>(piece) ? 1 : 2;
    const int n = chord_steps(piece, tolerance, fewest, fewest == 1 ? 1 : kMostChords);
    if (out.size() + static_cast<std::size_t>(n) > kMostSamples) {
      return error(ErrorCode::kBadOption, "this tolerance asks for more than ten million samples")
          .hint("choose a larger one")
          .value(tolerance);
    }
    for (int k = 0; k <= n; ++k) {
      const double t = static_cast<double>(k) / n;
      const CurveSample one = sample_at(path, {i, t}, path.length_at(i, t), theta);
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

/// An empty cell for a figure that is not defined.
std::string figure_or_nothing(double value) {
  return std::isnan(value) ? std::string() : fmt::format("{}", value);
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

namespace {

Error no_pieces() { return error(ErrorCode::kNothingThere, "the contour has no pieces"); }

Error beyond_the_curve(double place, double end) {
  return error(ErrorCode::kBadOption, fmt::format("the place {} is not in 0 to {}", place, end))
      .hint("ask for places on the contour")
      .value(place);
}

}  // namespace

Result<std::vector<CurveSample>> sample_at_lengths(std::span<const Piece> pieces,
                                                   std::span<const double> lengths) {
  if (pieces.empty()) return fail(no_pieces());
  const ContourPath path(pieces);
  std::vector<CurveSample> out;
  double theta = 0.0;
  for (const double s : lengths) {
    if (!(s >= 0.0 && s <= path.length())) return fail(beyond_the_curve(s, path.length()));
    out.push_back(sample_at(path, path.parameter(s), s, theta));
    theta = out.back().theta;
  }
  return out;
}

Result<std::vector<CurveSample>> sample_at_parameters(std::span<const Piece> pieces,
                                                      std::span<const double> parameters) {
  if (pieces.empty()) return fail(no_pieces());
  const ContourPath path(pieces);
  const auto end = static_cast<double>(pieces.size());
  std::vector<CurveSample> out;
  double theta = 0.0;
  for (const double place : parameters) {
    if (!(place >= 0.0 && place <= end)) return fail(beyond_the_curve(place, end));
    const auto piece = std::min(static_cast<std::size_t>(place), pieces.size() - 1);
    const double t = place - static_cast<double>(piece);
    out.push_back(sample_at(path, {piece, t}, path.length_at(piece, t), theta));
    theta = out.back().theta;
  }
  return out;
}

Result<std::vector<CurveSample>> sample(std::span<const Piece> pieces, const SampleOptions& options,
                                        Watch* watch) {
  if (pieces.empty()) {
    return error(ErrorCode::kNothingThere, "there is no curve to sample");
  }
  const ContourPath path(pieces, kFinestLength, watch);
  const Questions questions(watch);
  if (has_ended(watch)) return fail(cancelled_error());
  if (options.count) {
    if (*options.count < 2 || *options.count > kMostSamples) {
      return fail(
          bad("two to ten million samples are possible", static_cast<double>(*options.count)));
    }
    return at_lengths(path, *options.count, path.length() / static_cast<double>(*options.count - 1),
                      questions);
  }
  if (options.step) {
    constexpr double kRounding = 1e-12;  // of the length: a whole number of steps stays one
    const double count = std::ceil(path.length() / *options.step * (1.0 - kRounding)) + 1.0;
    if (!(*options.step > 0.0) || !(count <= static_cast<double>(kMostSamples))) {
      return fail(bad("the step must be positive, and not for more than ten million samples",
                      *options.step));
    }
    return at_lengths(path, std::max<std::size_t>(2, static_cast<std::size_t>(count)),
                      *options.step, questions);
  }
  const double tolerance = options.chord_tolerance.value_or(kDefaultChord * path.length());
  if (!(tolerance > 0.0)) return fail(bad("the chord tolerance must be positive", tolerance));
  return by_chords(path, tolerance, questions);
}

Result<std::string> samples_csv(const Contour& contour, const SampleOptions& options,
                                Watch* watch) {
  const auto samples = sample(contour.pieces, options, watch);
  OBVID_TRY(samples);
  const std::string unit = plain(contour.units);
  std::string out =
      contour.units.known()
          ? fmt::format("s_{0},x_{0},y_{0},heading_deg,curvature_1_per_{0},normal_x,normal_y\n",
                        unit)
          : "s,x,y,heading_deg,curvature,normal_x,normal_y\n";
  Questions questions(watch);
  for (const CurveSample& one : *samples) {
    if (questions.end()) return fail(cancelled_error());
    const Vec2 normal = left_normal(unit_at(one.theta));
    format_into(out, "{},{},{},{},{},{},{}\n", one.s, one.point.x, one.point.y,
                one.theta * 180.0 / std::numbers::pi, figure_or_nothing(one.kappa), normal.x,
                normal.y);
  }
  return out;
}

Result<std::string> obj_text(const Contour& contour, const SampleOptions& options, Watch* watch) {
  const auto samples = sample(contour.pieces, options, watch);
  OBVID_TRY(samples);
  const std::vector<Vec2> points = distinct(*samples, contour.closed);
  std::string out = "# Obvid contour, lengths in " + plain(contour.units) + "\n";
  for (const Vec2 p : points) format_into(out, "v {} {} 0\n", p.x, p.y);
  out += "l";
  for (std::size_t i = 1; i <= points.size(); ++i) {
    format_into(out, " {}", i);
  }
  return out + (contour.closed ? " 1\n" : "\n");
}

Result<std::string> ply_text(const Contour& contour, const SampleOptions& options, Watch* watch) {
  const auto samples = sample(contour.pieces, options, watch);
  OBVID_TRY(samples);
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
