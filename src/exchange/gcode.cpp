// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/gcode.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "obvid/contour/arcs/arcs_along.h"
#include "obvid/contour/bsplines/cubic_along.h"
#include "obvid/core/version.h"

namespace obvid {
namespace {

constexpr double kMostTurn = 1.5707963;  // of one block, rad
constexpr double kForCurve = 0.78;  // of the tolerance; the rest is for straightening and rounding
constexpr double kForCurveOfLines = 0.1;  // likewise where chords stand for the arcs
constexpr double kStraightened = 0.1;     // of the tolerance: height of arcs that become lines
constexpr int kDecimalsMm = 4, kDecimalsInch = 5;
/// A chord of fewer last digits than this is a line: its arc would be made of rounding.
constexpr double kShortestArc = 50.0;

/// Millimetres of the units that are converted; 0: not known, taken as millimetres.
double millimetres(const std::string& units) {
  static constexpr std::pair<const char*, double> kUnits[] = {
      {"um", 1e-3}, {"mm", 1.0}, {"cm", 10.0}, {"m", 1000.0}, {"km", 1e6}, {"ft", 304.8}};
  for (const auto& [name, value] : kUnits) {
    if (units == name) return value;
  }
  return 1.0;
}

/// Comments end at ")": nothing of the kind in a name.
std::string comment_of(const std::string& name) {
  std::string out;
  for (const char c : name) {
    const bool plain =
        static_cast<unsigned char>(c) >= 0x20 && static_cast<unsigned char>(c) < 0x7F;
    if (plain && c != '(' && c != ')') out += c;
  }
  return out;
}

class Program {
 public:
  Program(const Contour& contour, const GcodeOptions& options)
      : contour_(contour), options_(options), inches_(contour.units == "in") {
    scale_ = inches_ ? 1.0 : millimetres(contour.units);
    decimals_ = inches_ ? kDecimalsInch : kDecimalsMm;
    unit_ = std::pow(10.0, -decimals_);
    tolerance_ = options.tolerance * scale_;
  }

  Result<GcodeText> run() {
    if (tolerance_ < 2.0 * unit_) {
      return fail({ErrorCode::kBadOption,
                   fmt::format("{} decimals do not keep this tolerance", decimals_), "",
                   fmt::format("choose at least {:g} {}", 2.0 * unit_, inches_ ? "in" : "mm"), -1,
                   options_.tolerance});
    }
    start(rounded(scale_ * start_point(contour_.pieces.front())));
    const Result<void> done =
        options_.motion == GcodeMotion::kSplines ? splines() : arcs_or_lines();
    if (!done) return fail(done.error());
    result_.deviation = (curve_deviation_ + print_deviation_) / scale_;
    result_.text = head() + body_ + tail();
    return std::move(result_);
  }

 private:
  [[nodiscard]] Vec2 rounded(Vec2 p) const {
    return {unit_ * std::round(p.x / unit_), unit_ * std::round(p.y / unit_)};
  }

  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(body_), format, std::forward<Args>(args)...);
  }

  /// Never "-0.0000".
  [[nodiscard]] std::string number(double value, int decimals) const {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    return text.find_first_not_of("-0.") == std::string::npos && text[0] == '-' ? text.substr(1)
                                                                                : text;
  }
  [[nodiscard]] std::string place(Vec2 p) const {
    return "X" + number(p.x, decimals_) + " Y" + number(p.y, decimals_);
  }

  void start(Vec2 p) {
    at_ = p;
    add("G0 {}\nF{:g}\n", place(p), options_.feed);
  }

  [[nodiscard]] std::string head() const {
    const bool fanuc = options_.controller == GcodeController::kFanuc;
    std::string out = fanuc ? "%\nO0001\n" : "";
    out += fmt::format("(Obvid {}: {})\n", kVersion, comment_of(options_.name));
    out += fmt::format("(path within {:.2g} {} of the contour, {} blocks)\n",
                       curve_deviation_ + print_deviation_, inches_ ? "in" : "mm", result_.blocks);
    out += inches_ ? "G20 " : "G21 ";
    out += fanuc ? "G90 G17 G94\n" : "G90 G91.1 G17 G94\n";
    return out;
  }
  [[nodiscard]] std::string tail() const {
    return options_.controller == GcodeController::kFanuc ? "M30\n%\n" : "M2\n";
  }

  Result<void> arcs_or_lines() {
    const bool lines = options_.motion == GcodeMotion::kLines;
    const auto along =
        arcs_along(contour_, (lines ? kForCurveOfLines : kForCurve) * options_.tolerance);
    if (!along) return fail(along.error());
    curve_deviation_ = along->deviation * scale_;
    for (const Piece& piece : along->pieces) {
      const auto* arc = std::get_if<ArcPiece>(&piece);
      if (arc == nullptr) {
        line(rounded(scale_ * end_point(piece)));
        print_deviation_ = std::max(print_deviation_, unit_);
        continue;
      }
      const int parts = parts_of(*arc);
      for (int k = 0; k < parts; ++k) {
        const double from = static_cast<double>(k) / parts, to = static_cast<double>(k + 1) / parts;
        block(piece, from, to);
      }
    }
    return {};
  }

  /// Parts of an arc: of at most a quarter turn, or chords within the tolerance.
  [[nodiscard]] int parts_of(const ArcPiece& arc) const {
    const double turn = std::abs(arc.kappa * arc.length);
    double most = kMostTurn;
    if (options_.motion == GcodeMotion::kLines) {
      const double room = (1.0 - kForCurveOfLines) * tolerance_ - 1.5 * unit_;
      const double height = std::max(room, unit_) * std::abs(arc.kappa) / scale_;
      most = 2.0 * std::acos(1.0 - std::min(height, 1.0));
    }
    return std::max(1, static_cast<int>(std::ceil(turn / most)));
  }

  void line(Vec2 to) {
    if (to == at_) return;  // shorter than the last digit: the next block starts here
    add("G1 {}\n", place(to));
    at_ = to;
    ++result_.blocks;
  }

  /// One part of an arc as G2 or G3 through the printed ends and the part's own height.
  void block(const Piece& piece, double from, double to) {
    const auto& arc = std::get<ArcPiece>(piece);
    const Vec2 end = rounded(scale_ * evaluate(piece, to).point), chord = end - at_;
    const Vec2 middle = scale_ * evaluate(piece, 0.5 * (from + to)).point;
    const double length = norm(chord);
    if (length == 0.0) return;
    const Vec2 across = left_normal(chord) / length;
    const double height = dot(middle - 0.5 * (at_ + end), across);
    const bool lines = options_.motion == GcodeMotion::kLines;
    if (lines || std::abs(height) < kStraightened * tolerance_ || length < kShortestArc * unit_) {
      print_deviation_ = std::max(print_deviation_, std::abs(height) + unit_);
      return line(end);
    }
    // circle through both ends, of that height over the chord
    const double centre_height = 0.5 * (height - 0.25 * length * length / height);
    const Vec2 centre = 0.5 * (at_ + end) + centre_height * across - at_;
    const double fine = 0.1 * unit_;
    const Vec2 printed = {fine * std::round(centre.x / fine), fine * std::round(centre.y / fine)};
    add("{} {} I{} J{}\n", arc.kappa > 0.0 ? "G3" : "G2", place(end),
        number(printed.x, decimals_ + 1), number(printed.y, decimals_ + 1));
    measure(piece, from, to, at_ + printed, norm(printed));
    at_ = end;
    ++result_.blocks;
    ++result_.arc_blocks;
  }

  /// Distance of the printed circle from the part of the arc that it stands for.
  void measure(const Piece& piece, double from, double to, Vec2 centre, double radius) {
    constexpr int kPlaces = 4;
    for (int k = 0; k <= kPlaces; ++k) {
      const Vec2 p = scale_ * evaluate(piece, from + (to - from) * k / kPlaces).point;
      print_deviation_ = std::max(print_deviation_, std::abs(norm(p - centre) - radius));
    }
  }

  Result<void> splines() {
    const auto along = cubic_along(contour_, kForCurve * options_.tolerance);
    if (!along) return fail(along.error());
    curve_deviation_ = along->deviation * scale_;
    print_deviation_ = unit_;  // of control points, and so of the curve
    for (const RationalBezier& span : bezier_pieces(along->spline)) {
      const auto point = [&](std::size_t j) {
        return rounded(scale_ * (span.origin + span.offset[j]));
      };
      const Vec2 p1 = point(1) - at_, end = point(3), p2 = point(2) - end;
      add("G5 I{} J{} P{} Q{} {}\n", number(p1.x, decimals_), number(p1.y, decimals_),
          number(p2.x, decimals_), number(p2.y, decimals_), place(end));
      at_ = end;
      ++result_.blocks;
    }
    return {};
  }

  const Contour& contour_;
  const GcodeOptions& options_;
  bool inches_;
  double scale_ = 1.0, unit_ = 1e-4, tolerance_ = 0.0;
  int decimals_ = kDecimalsMm;
  Vec2 at_;
  std::string body_;
  double curve_deviation_ = 0.0, print_deviation_ = 0.0;
  GcodeText result_;
};

}  // namespace

Result<GcodeText> gcode_text(const Contour& contour, const GcodeOptions& options) {
  if (!(options.tolerance > 0.0) || !(options.feed > 0.0)) {
    return fail({ErrorCode::kBadOption, "tolerance and feed must be greater than 0", "", "", -1,
                 options.tolerance});
  }
  if (contour.pieces.empty()) {
    return fail({ErrorCode::kTooFewPoints, "the contour has no pieces", "", "", -1, 0.0});
  }
  if (options.motion == GcodeMotion::kSplines && options.controller != GcodeController::kLinuxCnc) {
    return fail({ErrorCode::kBadOption, "only LinuxCNC knows G5", "",
                 "choose arcs, or the controller linuxcnc", -1, 0.0});
  }
  return Program(contour, options).run();
}

}  // namespace obvid
