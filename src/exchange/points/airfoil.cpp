// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/points/airfoil.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "obvid/core/internal/format_into.h"
#include "obvid/curve/internal/contour_path.h"

namespace obvid {
namespace {

constexpr std::size_t kFewestPoints = 5, kMostPoints = 100'000;  // points that are written
constexpr std::size_t kLooks = 32;  // of a piece, where a largest or a first one is sought
constexpr int kHalvings = 200;      // more than doubles have
constexpr double kCorner = 1e-6;    // rad: no corner below, as in samples
constexpr double kFinest = 1e-8;    // of the chord: a unit of the last digit is no larger
constexpr double kGolden = 0.6180339887498949;

double product(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
double across(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

/// Place in [a, b] at which a function that changes its sign there does so.
template <class Function>
double crossing(double a, double b, const Function& f) {
  const bool rises = f(b) > 0.0;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (a + b);
    if (!(middle > a && middle < b)) break;
    ((f(middle) > 0.0) == rises ? b : a) = middle;
  }
  return 0.5 * (a + b);
}

/// Place of the largest value near the middle of [a, b].
template <class Function>
double highest(double a, double b, const Function& f) {
  double c = b - kGolden * (b - a), d = a + kGolden * (b - a);
  double at_c = f(c), at_d = f(d);
  for (int k = 0; k < kHalvings && c < d; ++k) {
    if (at_c >= at_d) {
      b = d, d = c, at_d = at_c;
      c = b - kGolden * (b - a), at_c = f(c);
    } else {
      a = c, c = d, at_c = at_d;
      d = a + kGolden * (b - a), at_d = f(d);
    }
  }
  return 0.5 * (a + b);
}

/// The contour from one end of its trailing edge around to the other, upper side first.
class Airfoil {
 public:
  static Result<Airfoil> of(const Contour& contour) {
    if (contour.pieces.empty()) return error(ErrorCode::kNothingThere, "there is no airfoil");
    auto path = ContourPath::without_cusps(contour.pieces);
    OBVID_TRY(path);
    Airfoil out(std::move(*path));
    out.to_ = out.path_.length();
    if (contour.closed && !out.open_at_corner()) {
      return error(
                 ErrorCode::kNothingThere,
                 "the closed contour has no trailing edge: one corner, or two with a base between")
          .hint("fit the airfoil with --open, or name its corner by --corner-at");
    }
    OBVID_TRY(out.measure_chord());
    return out;
  }

  /// Arc length along the sides is counted from the upper end of the trailing edge.
  [[nodiscard]] double length() const { return to_ - from_; }
  [[nodiscard]] double nose() const { return nose_; }
  [[nodiscard]] ContourPath::Place at(double s) const {
    double along = reversed_ ? to_ - s : from_ + s;
    const double all = path_.length();
    const bool end = s >= length();
    // the last place belongs to the piece that ends there
    bool before = end != reversed_;
    while (along > all || (along == all && !before)) {
      if (along == all && !wraps_) break;
      along -= all;
    }
    if (along <= 0.0 && before && wraps_) along += all;
    ContourPath::Place place = path_.at(std::clamp(along, 0.0, all), before);
    if (reversed_) place.tangent = -1.0 * place.tangent, place.kappa = -place.kappa;
    return place;
  }
  /// Along the chord from the leading edge and to the left of it, units.
  [[nodiscard]] Vec2 local(Vec2 p) const {
    const Vec2 d = p - leading_;
    return {product(along_, d), across(along_, d)};
  }
  [[nodiscard]] Vec2 back(Vec2 q) const {
    return leading_ + q.x * along_ + q.y * Vec2{-along_.y, along_.x};
  }
  [[nodiscard]] double chord() const { return chord_; }
  [[nodiscard]] Vec2 leading() const { return leading_; }
  [[nodiscard]] Vec2 along() const { return along_; }

  /// Arc length on a side from the leading edge, to its end.
  [[nodiscard]] double side_length(bool upper) const { return upper ? nose_ : length() - nose_; }
  [[nodiscard]] ContourPath::Place on_side(bool upper, double s) const {
    return at(upper ? nose_ - s : nose_ + s);
  }
  [[nodiscard]] double x_on(bool upper, double s) const { return local(on_side(upper, s).point).x; }
  /// Whether x rises all along a side.
  [[nodiscard]] bool runs_along(bool upper) const {
    double before = 0.0;
    const std::size_t n = looks();
    for (std::size_t k = 1; k <= n; ++k) {
      const double x =
          x_on(upper, side_length(upper) * static_cast<double>(k) / static_cast<double>(n));
      if (!(x > before)) return false;
      before = x;
    }
    return true;
  }
  /// Height of a side at x, which must run along.
  [[nodiscard]] double height(bool upper, double x) const {
    return local(on_side(upper, place_of(upper, x)).point).y;
  }
  [[nodiscard]] double place_of(bool upper, double x) const {
    const double end = side_length(upper);
    if (!(x > 0.0)) return 0.0;
    if (!(x < x_on(upper, end))) return end;
    return crossing(0.0, end, [&](double s) { return x_on(upper, s) - x; });
  }
  [[nodiscard]] std::size_t looks() const { return kLooks * path_.pieces().size(); }

 private:
  explicit Airfoil(ContourPath path) : path_(std::move(path)) {}

  /// Corners of the closed contour; false where they do not tell the trailing edge.
  bool open_at_corner() {
    std::vector<double> corners;
    const double all = path_.length();
    for (std::size_t k = 0; k < path_.pieces().size(); ++k) {
      const Vec2 in = path_.at(k == 0 ? all : path_.joint(k), true).tangent;
      const Vec2 out = path_.at(path_.joint(k), false).tangent;
      if (std::abs(std::atan2(across(in, out), product(in, out))) > kCorner) {
        corners.push_back(path_.joint(k));
      }
    }
    if (corners.empty() || corners.size() > 2) return false;
    wraps_ = true;
    from_ = corners.front();
    to_ = from_ + all;
    if (corners.size() == 1) return true;
    const double first = corners[1] - corners[0];
    if (first < 0.5 * all) {
      from_ = corners[1];  // the base runs from the first to the second
      to_ = corners[0] + all;
    } else {
      to_ = corners[1];
    }
    return true;
  }

  Result<void> measure_chord() {
    const Vec2 a = at(0.0).point, b = at(length()).point;
    const Vec2 edge = 0.5 * (a + b);
    const std::size_t n = looks();
    const double step = length() / static_cast<double>(n);
    double farthest = -1.0, area = 0.0;
    std::size_t where = 0;
    Vec2 before = a;
    for (std::size_t k = 0; k <= n; ++k) {
      const Vec2 p = at(static_cast<double>(k) * step).point;
      area += across(before - edge, p - edge);
      before = p;
      const Vec2 d = p - edge;
      if (product(d, d) > farthest) farthest = product(d, d), where = k;
    }
    if (area == 0.0 || where == 0 || where == n) {
      return error(ErrorCode::kNothingThere, "the contour is no airfoil: it goes around nothing");
    }
    const auto receding = [&](double s) {
      const auto place = at(s);
      return product(place.point - edge, place.tangent);
    };
    nose_ = crossing(static_cast<double>(where - 1) * step, static_cast<double>(where + 1) * step,
                     receding);
    if (area < 0.0) {
      nose_ = length() - nose_;
      reversed_ = true;
    }
    leading_ = at(nose_).point;
    const Vec2 d = edge - leading_;
    chord_ = std::hypot(d.x, d.y);
    along_ = {d.x / chord_, d.y / chord_};
    return {};
  }

  ContourPath path_;
  double from_ = 0.0, to_ = 0.0;
  bool wraps_ = false, reversed_ = false;
  double nose_ = 0.0, chord_ = 0.0;
  Vec2 leading_{}, along_{};
};

AirfoilFigures figures_of(const Airfoil& foil) {
  AirfoilFigures out;
  const double c = foil.chord();
  out.chord = c;
  out.turn = std::atan2(foil.along().y, foil.along().x);
  out.leading_edge = foil.leading();
  const auto thickness = [&](double x) { return foil.height(true, x) - foil.height(false, x); };
  const auto camber = [&](double x) {
    return 0.5 * (foil.height(true, x) + foil.height(false, x));
  };
  constexpr int kPlaces = 200;
  const auto place = [&](int k) { return c * std::clamp(k, 0, kPlaces) / kPlaces; };
  int thick = 0, high = 0;
  double most = -1.0, highest_camber = -1.0;
  for (int k = 0; k <= kPlaces; ++k) {
    const double t = thickness(place(k));
    const double h = std::abs(camber(place(k)));
    if (t > most) {
      most = t;
      thick = k;
    }
    if (h > highest_camber) {
      highest_camber = h;
      high = k;
    }
  }
  const double sign = camber(place(high)) < 0.0 ? -1.0 : 1.0;
  const double at = highest(place(thick - 1), place(thick + 1), thickness);
  const double top =
      highest(place(high - 1), place(high + 1), [&](double x) { return sign * camber(x); });
  out.thickness = thickness(at) / c;
  out.thickness_at = at / c;
  out.camber = camber(top) / c;
  out.camber_at = top / c;
  out.nose_radius = 1.0 / std::abs(foil.at(foil.nose()).kappa) / c;
  const auto first = foil.at(0.0), last = foil.at(foil.length());
  const Vec2 gap = first.point - last.point;
  out.trailing_thickness = std::hypot(gap.x, gap.y) / c;
  const Vec2 upper = -1.0 * first.tangent, lower = last.tangent;  // both towards the edge
  out.trailing_angle = std::atan2(across(upper, lower), product(upper, lower));
  return out;
}

/// Arc lengths from the leading edge along a side in m steps, both ends among them.
std::vector<double> places(const Airfoil& foil, bool upper, std::size_t m, AirfoilSpacing spacing) {
  const double end = foil.side_length(upper), all = static_cast<double>(m);
  std::vector<double> out;
  std::vector<double> sums;
  const std::size_t looks = foil.looks();
  const double step = end / static_cast<double>(looks);
  if (spacing == AirfoilSpacing::kCurvature) {
    sums.push_back(0.0);
    for (std::size_t k = 0; k < looks; ++k) {
      const double s = (static_cast<double>(k) + 0.5) * step;
      sums.push_back(sums.back() + std::sqrt(std::abs(foil.on_side(upper, s).kappa)) * step);
    }
    const double sum = sums.back();
    for (std::size_t k = 0; k <= looks; ++k) {
      const double even = static_cast<double>(k) / static_cast<double>(looks);
      sums[k] = sum > 0.0 ? 0.5 * (even + sums[k] / sum) : even;
    }
  }
  for (std::size_t k = 0; k <= m; ++k) {
    const double part = static_cast<double>(k) / all;
    if (k == 0 || k == m) {
      out.push_back(k == 0 ? 0.0 : end);
    } else if (spacing == AirfoilSpacing::kUniform) {
      out.push_back(part * end);
    } else if (spacing == AirfoilSpacing::kCosine) {
      const double x = 0.5 * (1.0 - std::cos(std::numbers::pi * part));
      out.push_back(foil.place_of(upper, x * foil.x_on(upper, end)));
    } else {
      const auto above = std::upper_bound(sums.begin(), sums.end(), part);
      const auto i = static_cast<std::size_t>(above - sums.begin()) - 1;
      out.push_back((static_cast<double>(i) + (part - sums[i]) / (sums[i + 1] - sums[i])) * step);
    }
  }
  return out;
}

}  // namespace

Result<AirfoilText> airfoil_text(const Contour& contour, const AirfoilOptions& options) {
  if (options.count < kFewestPoints || options.count > kMostPoints) {
    return error(ErrorCode::kBadOption, "an airfoil has 5 to 100,000 points")
        .hint("for example 161")
        .value(static_cast<double>(options.count));
  }
  const auto made = Airfoil::of(contour);
  OBVID_TRY(made);
  const Airfoil& foil = *made;
  for (const bool upper : {true, false}) {
    if (foil.runs_along(upper)) continue;
    return error(ErrorCode::kNothingThere,
                 fmt::format("the {} side folds back along the chord: no airfoil",
                             upper ? "upper" : "lower"))
        .hint("write .csv samples");
  }
  AirfoilText out;
  out.figures = figures_of(foil);
  const double c = foil.chord();
  double more = 0.0;  // of the trailing edge
  if (options.trailing_thickness) {
    const Vec2 a = foil.local(foil.at(0.0).point), b = foil.local(foil.at(foil.length()).point);
    more = *options.trailing_thickness * c - (a.y - b.y);
  }
  const auto moved = [&](bool upper, double s) {
    const Vec2 p = foil.on_side(upper, s).point;
    if (more == 0.0) return p;
    Vec2 q = foil.local(p);
    q.y += (upper ? 0.5 : -0.5) * more * (q.x / c) * (q.x / c);
    return foil.back(q);
  };
  if (more < 0.0) {
    constexpr int kPlaces = 1000;
    for (int k = 1; k < kPlaces; ++k) {
      const double x = c * k / kPlaces;
      if (foil.height(true, x) - foil.height(false, x) + more * (x / c) * (x / c) > 0.0) continue;
      return error(ErrorCode::kBadOption,
                   fmt::format("with this trailing edge the sides cross at {:.3f} chords", x / c))
          .hint("choose a thicker one")
          .value(*options.trailing_thickness);
    }
  }
  const std::size_t below = (options.count - 1) / 2, above = options.count - 1 - below;
  std::vector<Vec2> sides[2];
  for (const bool upper : {true, false}) {
    for (const double s : places(foil, upper, upper ? above : below, options.spacing)) {
      Vec2 p = moved(upper, s);
      if (options.unit_chord) {
        const Vec2 q = foil.local(p);
        p = {q.x / c, q.y / c};
      }
      sides[upper ? 0 : 1].push_back(p);
    }
  }
  out.upper = sides[0].size();
  out.lower = sides[1].size();
  const double size = options.unit_chord ? 1.0 : c;
  const int digits = std::clamp(static_cast<int>(std::ceil(-std::log10(kFinest * size))), 0, 17);
  out.last_digit = std::pow(10.0, -digits);
  const auto add = [&](Vec2 p) {
    // no "-0.000"
    const double least = 0.5 * out.last_digit;
    const double x = std::abs(p.x) < least ? 0.0 : p.x, y = std::abs(p.y) < least ? 0.0 : p.y;
    format_into(out.text, " {:.{}f} {:.{}f}\n", x, digits, y, digits);
  };
  out.text = options.name + "\n";
  if (options.layout == AirfoilLayout::kSelig) {
    std::for_each(sides[0].rbegin(), sides[0].rend(), add);
    std::for_each(sides[1].begin() + 1, sides[1].end(), add);
    return out;
  }
  format_into(out.text, " {}. {}.\n\n", out.upper, out.lower);
  std::for_each(sides[0].begin(), sides[0].end(), add);
  out.text += "\n";
  std::for_each(sides[1].begin(), sides[1].end(), add);
  return out;
}

}  // namespace obvid
