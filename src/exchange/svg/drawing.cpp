// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/svg/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "obvid/core/internal/format_into.h"
#include "obvid/curve/internal/path_distance.h"
#include "obvid/geom/internal/box.h"

namespace obvid {
namespace {

constexpr int kMostHalvings = 24;  // of one piece
constexpr int kCubicSamples = 16;  // of a cubic
constexpr double kOfCubicTolerance = 0.95;
/// A flag of SVG's arcs cannot tell half a turn from its complement: arcs are cut below it.
constexpr double kMostArcTurn = 3.0;

/// A contour as a path.
struct SvgPath {
  std::string data;
  Box2 box;
  double deviation = 0.0;  ///< units
  std::size_t curves = 0;
};

class SvgDrawer {
 public:
  SvgDrawer(const Contour& contour, double tolerance, double within, Watch* watch)
      : contour_(contour), tolerance_(tolerance), within_(within), watch_(watch) {}

  Result<SvgPath> run() {
    move(start_point(contour_.pieces.front()));
    for (std::size_t i = 0; i < contour_.pieces.size(); ++i) {
      if (is_to_end(watch_)) return fail(cancelled_error());
      if (!add(contour_.pieces[i])) {
        return error(ErrorCode::kToleranceNotReached, "no cubic is near enough to a piece")
            .where("piece " + std::to_string(i + 1))
            .hint("allow a larger tolerance")
            .point(i)
            .value(tolerance_);
      }
    }
    if (contour_.closed) path_ += "Z";
    if (inexact_) result_.deviation = path_distance(contour_.pieces, drawn_, watch_);
    if (has_ended(watch_)) return fail(cancelled_error());
    result_.data = std::move(path_);
    result_.box = box_;
    return std::move(result_);
  }

 private:
  template <class... Args>
  void put(fmt::format_string<Args...> format, Args&&... args) {
    format_into(path_, format, std::forward<Args>(args)...);
  }
  void see(Vec2 p) { box_.add(p); }
  void move(Vec2 p) {
    put("M{} {}", p.x, p.y);
    see(p);
  }

  bool add(const Piece& piece) {
    if (const auto* line = std::get_if<LinePiece>(&piece)) {
      put("L{} {}", line->end.x, line->end.y);
      drawn_.push_back(piece);
      see(line->end);
      ++result_.curves;
      return true;
    }
    if (const auto* arc = std::get_if<ArcPiece>(&piece)) {
      add_arc(piece, *arc);
      drawn_.push_back(piece);
      return true;
    }
    const auto* bezier = std::get_if<RationalBezier>(&piece);
    if (bezier != nullptr && is_polynomial(*bezier) && bezier->degree <= 3) {
      exact(*bezier);
      drawn_.push_back(piece);
      return true;
    }
    return cubics(piece, 0.0, 1.0, kMostHalvings);
  }

  void add_arc(const Piece& piece, const ArcPiece& arc) {
    const double turn = std::abs(arc.kappa * arc.length);
    const int parts = std::max(1, static_cast<int>(std::ceil(turn / kMostArcTurn)));
    const double radius = 1.0 / std::abs(arc.kappa);
    for (int k = 1; k <= parts; ++k) {
      const Vec2 end = k == parts ? arc.end : evaluate(piece, static_cast<double>(k) / parts).point;
      put("A{0} {0} 0 0 {1} {2} {3}", radius, arc.kappa > 0.0 ? 1 : 0, end.x, end.y);
      ++result_.curves;
    }
    for (int k = 0; k <= kCubicSamples; ++k)
      see(evaluate(piece, static_cast<double>(k) / kCubicSamples).point);
  }

  void exact(const RationalBezier& b) {
    static constexpr std::array kCommands = {'M', 'L', 'Q', 'C'};
    path_ += kCommands[static_cast<std::size_t>(b.degree)];
    for (int j = 1; j <= b.degree; ++j) {
      const Vec2 p = b.origin + b.offset[static_cast<std::size_t>(j)];
      put("{}{} {}", j > 1 ? " " : "", p.x, p.y);
      see(p);
    }
    ++result_.curves;
  }

  /// Cubics with the tangents of the part and legs that fit its middle.
  bool cubics(const Piece& piece, double from, double to, int halvings) {
    const Jet a = evaluate(piece, from), b = evaluate(piece, to);
    const auto legs = best_legs(piece, from, to, a, b);
    const double deviation = legs ? distance(piece, from, to, *legs) : HUGE_VAL;
    if (deviation <= within_) {
      const auto& c = *legs;
      put("C{} {} {} {} {} {}", c[1].x, c[1].y, c[2].x, c[2].y, c[3].x, c[3].y);
      for (int k = 1; k <= kCubicSamples; ++k) {
        see(evaluate(piece, from + (to - from) * k / kCubicSamples).point);
      }
      drawn_.emplace_back(RationalBezier{{}, 3, {c[0], c[1], c[2], c[3]}, {1.0, 1.0, 1.0, 1.0}});
      inexact_ = true;
      ++result_.curves;
      return true;
    }
    if (halvings == 0) return false;
    const double middle = 0.5 * (from + to);
    return cubics(piece, from, middle, halvings - 1) && cubics(piece, middle, to, halvings - 1);
  }

  using Cubic = std::array<Vec2, 4>;

  /// Legs such that the cubic's middle is that of the curve along both tangents; where the tangents
  /// are nearly parallel, a third of the chord.
  static std::optional<Cubic> best_legs(const Piece& piece, double from, double to, const Jet& a,
                                        const Jet& b) {
    const double la = norm(a.d1), lb = norm(b.d1);
    if (!(la > 0.0 && lb > 0.0)) return std::nullopt;
    const Vec2 ta = a.d1 / la, tb = b.d1 / lb, chord = b.point - a.point;
    const Vec2 middle = evaluate(piece, 0.5 * (from + to)).point;
    // 8 M = P0 + 3 P1 + 3 P2 + P3: 3 (p ta - q tb) = 8 M - 4 (P0 + P3)
    const Vec2 rest = (8.0 / 3.0) * (middle - 0.5 * (a.point + b.point));
    const double det = -cross(ta, tb);
    double p = norm(chord) / 3.0, q = p;
    constexpr double kParallelTangents = 1e-3;  // sine of the turn between both
    if (std::abs(det) > kParallelTangents) {
      const double p0 = -cross(rest, tb) / det, q0 = cross(ta, rest) / det * -1.0;
      if (p0 > 0.0 && q0 > 0.0) {
        p = p0;
        q = q0;
      }
    }
    return Cubic{a.point, a.point + p * ta, b.point - q * tb, b.point};
  }

  static Vec2 at(const Cubic& c, double t) {
    const double s = 1.0 - t;
    return (s * s * s) * c[0] + (3.0 * s * s * t) * c[1] + (3.0 * s * t * t) * c[2] +
           (t * t * t) * c[3];
  }
  static Vec2 slope(const Cubic& c, double t) {
    const double s = 1.0 - t;
    return (3.0 * s * s) * (c[1] - c[0]) + (6.0 * s * t) * (c[2] - c[1]) +
           (3.0 * t * t) * (c[3] - c[2]);
  }

  /// Largest distance of places of the part from the cubic.
  static double distance(const Piece& piece, double from, double to, const Cubic& cubic) {
    double most = 0.0;
    for (int k = 1; k < kCubicSamples; ++k) {
      const double part = static_cast<double>(k) / kCubicSamples;
      const Vec2 p = evaluate(piece, from + part * (to - from)).point;
      double t = part;
      constexpr int kSteps = 6;
      constexpr double kNoSpeed = 1e-300;  // units^2: the curve stands still there
      for (int step = 0; step < kSteps; ++step) {
        const Vec2 d = slope(cubic, t);
        t = std::clamp(t + dot(p - at(cubic, t), d) / std::max(dot(d, d), kNoSpeed), 0.0, 1.0);
      }
      most = std::max(most, norm(at(cubic, t) - p));
    }
    return most;
  }

  const Contour& contour_;
  double tolerance_;
  double within_;  ///< of places of a piece from their cubic
  Watch* watch_;
  std::string path_;
  std::vector<Piece> drawn_;
  bool inexact_ = false;
  Box2 box_;
  SvgPath result_;
};

Result<SvgPath> svg_path(const Contour& contour, double tolerance, Watch* watch) {
  if (!(tolerance > 0.0)) {
    return error(ErrorCode::kBadOption, "the tolerance must be greater than 0").value(tolerance);
  }
  if (contour.pieces.empty()) {
    return error(ErrorCode::kNothingThere, "the contour has no pieces");
  }
  constexpr int kTrials = 3;
  double within = kOfCubicTolerance * tolerance;
  for (int trial = 0;; ++trial) {
    auto made = SvgDrawer(contour, tolerance, within, watch).run();
    if (!made || made->deviation <= tolerance) return made;
    if (trial == kTrials) {
      return error(ErrorCode::kToleranceNotReached, "the drawing is not near enough")
          .hint("allow a larger tolerance")
          .value(made->deviation);
    }
    within *= kOfCubicTolerance * tolerance / made->deviation;
  }
}

/// `paths`: lines of markup. y is turned around the box: paths keep the contours' own coordinates.
std::string sheet(const Box2& box, double mm, const SvgDrawingOptions& options,
                  const char* namespaces, const std::string& paths) {
  const double margin = options.margin / mm;
  const Vec2 low = box.low - Vec2{margin, margin}, size = box.high + Vec2{margin, margin} - low;
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\"{} width=\"{}mm\" height=\"{}mm\" "
      "viewBox=\"{} {} {} {}\">\n"
      "<g transform=\"matrix(1 0 0 -1 0 {})\" fill=\"none\" stroke=\"#000\" stroke-width=\"{}\" "
      "stroke-linejoin=\"round\">\n{}</g>\n</svg>\n",
      namespaces, size.x * mm, size.y * mm, low.x, low.y, size.x, size.y, low.y + low.y + size.y,
      options.stroke_width / mm, paths);
}

/// As the value of an attribute; what XML 1.0 has no sign for becomes _ .
std::string quoted(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += static_cast<unsigned char>(c) < 0x20U ? '_' : c;
    }
  }
  return out;
}

/// Ids of a file, each of them once.
class SvgIds {
 public:
  /// `wanted`, what no id may hold as _ ; where it is taken with a number behind it.
  std::string of(std::string wanted) {
    for (char& c : wanted) {
      if (c == ' ' || static_cast<unsigned char>(c) < 0x20U) c = '_';
    }
    if (wanted.empty()) wanted = "curve";
    std::string given = wanted;
    for (int k = 2; !taken_.insert(given).second; ++k) given = fmt::format("{}-{}", wanted, k);
    return quoted(given);
  }

 private:
  std::set<std::string> taken_;
};

}  // namespace

Result<SvgDrawing> svg_drawing(const Contour& contour, const SvgDrawingOptions& options,
                               Watch* watch) {
  const auto millimetres = unit_ratio(contour.units, "mm", "drawings in true scale");
  OBVID_TRY(millimetres);
  const auto path = svg_path(contour, options.tolerance, watch);
  OBVID_TRY(path);
  const std::string markup = fmt::format("<path d=\"{}\"/>\n", path->data);
  return SvgDrawing{sheet(path->box, *millimetres, options, "", markup), path->deviation,
                    path->curves};
}

Result<SvgDrawing> svg_drawing(const std::vector<SvgCurve>& curves,
                               const SvgDrawingOptions& options, Watch* watch) {
  if (curves.empty()) return error(ErrorCode::kNothingThere, "there are no curves to write");
  const Units& units = curves.front().contour.units;
  const auto millimetres = unit_ratio(units, "mm", "drawings in true scale");
  OBVID_TRY(millimetres);
  SvgDrawing out;
  Box2 box;
  std::vector<std::string> layers;
  std::map<std::string, std::string> markup;
  SvgIds ids;
  for (const SvgCurve& curve : curves) {
    if (curve.contour.units.name != units.name) {
      return error(ErrorCode::kBadOption, "a drawing has one unit for all of its curves");
    }
    const auto path = svg_path(curve.contour, curve.tolerance, watch);
    OBVID_TRY(path);
    box.add(path->box.low);
    box.add(path->box.high);
    out.deviation = std::max(out.deviation, path->deviation);
    out.curves += path->curves;
    if (markup.find(curve.layer) == markup.end()) layers.push_back(curve.layer);
    markup[curve.layer] +=
        fmt::format("<path id=\"{}\" d=\"{}\"/>\n", ids.of(curve.id), path->data);
  }
  std::string all;
  for (const std::string& layer : layers) {
    if (layer.empty()) {
      all += markup[layer];
      continue;
    }
    all += fmt::format("<g id=\"{}\" inkscape:groupmode=\"layer\" inkscape:label=\"{}\">\n{}</g>\n",
                       ids.of("layer-" + layer), quoted(layer), markup[layer]);
  }
  const bool layered = layers.size() > 1 || !layers.front().empty();
  constexpr const char* kInkscape =
      " xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\"";
  out.text = sheet(box, *millimetres, options, layered ? kInkscape : "", all);
  return out;
}

}  // namespace obvid
