// SPDX-License-Identifier: Apache-2.0
#include "series.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>

namespace judge {

std::uint64_t Dice::next() {
  state_ += 0x9E3779B97F4A7C15ULL;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBULL;
  return z ^ (z >> 31U);
}

double Dice::unit() { return static_cast<double>(next() >> 11U) * 0x1p-53; }

double Dice::logarithmic(double a, double b) { return std::exp(between(std::log(a), std::log(b))); }

int Dice::whole(int a, int b) {
  return a + static_cast<int>(next() % static_cast<std::uint64_t>(b - a + 1));
}

double Dice::normal() {
  double sum = -6.0;
  for (int i = 0; i < 12; ++i) sum += unit();
  return sum;
}

namespace {

/// Size, place, direction and sense of a shape.
struct Motion {
  Real scale = 1.0L, angle = 0.0L, side = 1.0L;
  Vec offset;

  [[nodiscard]] Vec of(Vec p) const {
    const Vec q{p.x, side * p.y}, u = unit_at(angle);
    return scale * Vec{u.x * q.x - u.y * q.y, u.y * q.x + u.x * q.y} + offset;
  }
};

Real size_of(const std::vector<Vec>& points) {
  Vec low = points.front(), high = low;
  for (const Vec p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return std::max(norm(high - low), 1e-30L);
}

Motion make_motion(Dice& dice, Real shape_size) {
  Motion out;
  const double wanted =
      dice.chance(0.5) ? dice.logarithmic(1.0, 1000.0) : dice.logarithmic(1e-9, 1e9);
  out.scale = wanted / shape_size;
  out.angle = dice.chance(0.3) ? 0.0L : dice.between(0.0, 6.28);
  out.side = dice.chance(0.5) ? 1.0L : -1.0L;
  if (dice.chance(0.15)) {
    const double away = dice.chance(0.7) ? 1e6 : 1e9;
    out.offset = {wanted * away * dice.unit(), wanted * away * dice.unit()};
  }
  return out;
}

constexpr std::array kUnits = {"mm", "m",    "in", "cm", "ft",  "um", "km",   "yd",
                               "mi", "usft", "nm", "dm", "mil", "px", "chord"};
constexpr int kLastUnit = static_cast<int>(kUnits.size()) - 1;

class SeriesMaker {
 public:
  SeriesMaker(std::uint64_t seed, std::uint64_t index)
      : dice_(seed * 0x100000001B3ULL ^ index),
        thinning_(~seed * 0x100000001B3ULL ^ index),
        naming_((seed + 1) * 0x100000001B3ULL ^ ~index) {
    for (int i = 0; i < 4; ++i) {
      dice_.next();
      thinning_.next();
      naming_.next();
    }
  }

  Series run() {
    Shape shape = make_shape(dice_);
    while (shape.points.size() < 3 && !keeps_what_is_refused()) shape = make_shape(dice_);
    const Motion motion = make_motion(dice_, size_of(shape.points));
    std::vector<Vec> points;
    for (const Vec p : shape.points) points.push_back(motion.of(p));
    size_ = static_cast<double>(size_of(points));
    out_.family = shape.family;
    choose_options(shape);
    drop_contradictions(shape);
    if (shape.truth) move_truth(*shape.truth, motion);
    if (dice_.chance(0.1)) disturb(points);
    write(points);
    out_.points = points.size();
    place(points);
    fix_data(points);
    return std::move(out_);
  }

 private:
  void add(const std::string& option) { out_.options.push_back(option); }
  void add(const std::string& option, const std::string& value) {
    out_.options.push_back(option);
    out_.options.push_back(value);
  }
  static std::string digits(double value) { return fmt::format("{:.17g}", value); }
  static std::string few(double value) { return fmt::format("{:.4g}", value); }

  static const char* unit_of(Dice& dice) {
    return kUnits[static_cast<std::size_t>(dice.whole(0, kLastUnit))];
  }

  void choose_options(const Shape& shape) {
    static const char* kCarriers[] = {"arcs",    "conics", "beziers", "clothoids",
                                      "bspline", "cubic",  "baseline"};
    if (dice_.chance(0.65))
      add("--carrier", kCarriers[dice_.whole(0, static_cast<int>(std::size(kCarriers)) - 1)]);
    if (dice_.chance(0.35)) add("--units", unit_of(dice_));
    if (dice_.chance(0.2)) {
      const double part = dice_.chance(0.02) ? 1e-300 : dice_.logarithmic(1e-9, 0.1);
      add("--tolerance", few(part * size_));
    }
    if (dice_.chance(0.25)) add("--noise", few(dice_.logarithmic(1e-9, 1e-2) * size_));
    if (!has("--noise") && dice_.chance(0.04)) add("--noise", "auto");
    if (shape.closed ? dice_.chance(0.7) : dice_.chance(0.04)) {
      add("--closed");
    } else if (dice_.chance(0.05)) {
      add("--open");
    }
    if (dice_.chance(0.05)) add("--convex");
    if (dice_.chance(0.07)) add("--primitives");
    if (dice_.chance(0.05)) add("--no-corners");
    if (dice_.chance(0.1)) add("--corner-angle", few(dice_.between(5.0, 90.0)));
    choose_what_is_fair();
  }

  /// Mostly together with what they go with.
  void choose_what_is_fair() {
    static const char* kPrefer[] = {"fair", "centre", "least-change", "least-curvature"};
    const bool spirals = carrier_of_options() == "spiral";
    if ((spirals || keeps_what_is_refused()) && dice_.chance(0.1)) {
      add("--continuity", dice_.chance(0.5) ? "G2" : "G3");
    } else if (dice_.chance(0.05)) {
      add("--prefer", kPrefer[dice_.whole(0, 3)]);
    }
  }

  /// Scaled, turned, moved, mirrored: options that come later speak of the placed points.
  void place(std::vector<Vec>& points) {
    if (!dice_.chance(0.08)) return;
    Motion motion;
    if (dice_.chance(0.3)) {
      const bool across_x = dice_.chance(0.5);
      add("--mirror", across_x ? "x" : "y");
      motion.side = -1.0L;
      if (!across_x) motion.angle = std::numbers::pi_v<Real>;
    }
    if (dice_.chance(0.5)) {
      const double scale = std::stod(few(dice_.logarithmic(0.3, 3.0)));
      add("--scale", digits(scale));
      motion.scale = scale;
    }
    if (dice_.chance(0.5)) {
      const double degrees =
          dice_.chance(0.3) ? 90.0 * dice_.whole(-2, 2) : dice_.between(-180.0, 180.0);
      add("--rotate=" + digits(degrees));
      motion.angle += Real{degrees} * std::numbers::pi_v<Real> / 180.0L;
    }
    if (dice_.chance(0.5)) {
      const double x = size_ * dice_.between(-2.0, 2.0), y = size_ * dice_.between(-2.0, 2.0);
      add("--move=" + digits(x) + "," + digits(y));
      motion.offset = {x, y};
    }
    for (Vec& p : points) p = motion.of(p);
    size_ = static_cast<double>(size_of(points));
    if (out_.truth) move_truth(Truth(*out_.truth), motion);
  }

  /// What no contour can keep must be refused, which one in three such series shows.
  bool keeps_what_is_refused() { return thinning_.chance(1.0 / 3.0); }

  /// Options that the shape itself contradicts.
  void drop_contradictions(const Shape& shape) {
    const bool bends = !turns_one_way(shape.points);
    const bool closed = has("--closed") || (shape.closed && !has("--open"));
    const std::string carrier = carrier_of_options();
    const bool no_chain =
        (carrier == "beziers" && bends) || (carrier == "conics" && (bends || closed));
    if (no_chain && !keeps_what_is_refused()) drop("--carrier", 2);
    if (has("--convex") && bends && !keeps_what_is_refused()) drop("--convex", 1);
  }
  [[nodiscard]] bool has(const std::string& option) const {
    return std::find(out_.options.begin(), out_.options.end(), option) != out_.options.end();
  }
  [[nodiscard]] std::string carrier_of_options() const {
    const auto at = std::find(out_.options.begin(), out_.options.end(), "--carrier");
    return at == out_.options.end() ? "spiral" : *(at + 1);
  }
  void drop(const std::string& option, std::ptrdiff_t words) {
    const auto at = std::find(out_.options.begin(), out_.options.end(), option);
    if (at != out_.options.end()) out_.options.erase(at, at + words);
  }
  static bool turns_one_way(const std::vector<Vec>& points) {
    int side = 0;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
      const Real turn = cross(points[i] - points[i - 1], points[i + 1] - points[i]);
      const int now = turn > 0.0L ? 1 : turn < 0.0L ? -1 : 0;
      if (now * side < 0) return false;
      if (now != 0) side = now;
    }
    return true;
  }

  void move_truth(const Truth& truth, const Motion& motion) {
    Truth moved = truth;
    moved.at = [at = truth.at, motion](Real t) { return motion.of(at(t)); };
    out_.truth = std::move(moved);
  }

  /// Noise of known size, or repeats of points.
  void disturb(std::vector<Vec>& points) {
    out_.truth.reset();
    if (dice_.chance(0.3)) {
      const auto i = static_cast<std::size_t>(dice_.whole(0, static_cast<int>(points.size()) - 1));
      points.insert(points.begin() + static_cast<std::ptrdiff_t>(i), points[i]);
      return;
    }
    const double noise = dice_.logarithmic(1e-9, 1e-3) * size_;
    for (Vec& p : points) p = p + Vec{noise * dice_.normal(), noise * dice_.normal()};
  }

  void write(const std::vector<Vec>& points) {
    const bool rounded = dice_.chance(0.15);
    const int decimals = 6 - static_cast<int>(std::floor(std::log10(size_)));
    if (rounded && decimals >= 0 && decimals < 15) {
      const bool wanted = dice_.chance(0.6);
      // twice is an error
      if (wanted && (!has("--noise") || keeps_what_is_refused())) add("--noise", "rounding");
      out_.truth.reset();
    }
    const bool tolerances = dice_.chance(0.05);
    const std::string unit = unit_of_names();
    out_.text = fmt::format("x{0},y{0}{1}\n", unit, tolerances ? ",tol" : "");
    for (const Vec p : points) {
      const auto x = static_cast<double>(p.x), y = static_cast<double>(p.y);
      out_.text += rounded && decimals >= 0 && decimals < 15
                       ? fmt::format("{:.{}f},{:.{}f}", x, decimals, y, decimals)
                       : fmt::format("{:.17g},{:.17g}", x, y);
      if (tolerances) out_.text += "," + few(dice_.logarithmic(1e-8, 1e-3) * size_);
      out_.text += "\n";
    }
  }

  /// Behind the names of the columns: "_mm", " [mm]", mostly nothing. An option goes before.
  std::string unit_of_names() {
    if (!naming_.chance(has("--units") ? 0.05 : 0.25)) return "";
    const char* unit = unit_of(naming_);
    return naming_.chance(0.5) ? fmt::format("_{}", unit) : fmt::format(" [{}]", unit);
  }

  /// Headings and radii: of the known curve, or random and mostly contradictory.
  void fix_data(const std::vector<Vec>& points) {
    if (!dice_.chance(0.18) || points.size() < 2) return;
    const bool closed =
        std::find(out_.options.begin(), out_.options.end(), "--closed") != out_.options.end();
    const auto n = static_cast<int>(points.size());
    const int constraints = dice_.whole(1, 3);
    for (int k = 0; k < constraints; ++k) {
      const int kind = dice_.whole(closed ? 4 : 0, 6);
      const int i = kind < 4 ? (kind % 2 == 0 ? 1 : n) : dice_.whole(1, n);
      const bool honest = out_.truth.has_value() && dice_.chance(0.7);
      const auto [heading, kappa] = honest ? true_data(i) : random_data(points, i);
      if (!honest && !keeps_what_is_refused()) continue;  // mostly contradictory
      if (wished_[static_cast<std::size_t>(kind)] && !keeps_what_is_refused()) continue;  // twice
      wished_[static_cast<std::size_t>(kind)] = true;
      if (dice_.chance(0.3)) {
        add_range(kind, i, heading, kappa);
        continue;
      }
      const std::string radius = kappa == 0.0 ? "inf" : digits(1.0 / kappa);
      if (kind == 0) add("--start-heading=" + digits(heading));
      if (kind == 1) add("--end-heading=" + digits(heading));
      if (kind == 2) add("--start-radius=" + radius);
      if (kind == 3) add("--end-radius=" + radius);
      if (kind == 4) add(fmt::format("--heading-at={}={}", i, digits(heading)));
      if (kind == 5) add(fmt::format("--radius-at={}={}", i, radius));
      if (kind == 6) add(fmt::format("--kappa-at={}={}", i, digits(kappa)));
    }
  }

  /// The value anywhere in a range, mostly a narrow one.
  void add_range(int kind, int i, double heading, double kappa) {
    const auto width = [&](double size) { return size * std::pow(10.0, -dice_.between(0.0, 3.0)); };
    if (kind == 0 || kind == 1 || kind == 4) {
      const std::string range =
          digits(heading - width(20.0)) + ".." + digits(heading + width(20.0));
      if (kind == 0) add("--start-heading=" + range);
      if (kind == 1) add("--end-heading=" + range);
      if (kind == 4) add(fmt::format("--heading-at={}={}", i, range));
      return;
    }
    const double low = kappa - width(std::abs(kappa)), high = kappa + width(std::abs(kappa));
    if (kind == 6 || low * high <= 0.0) {
      if (kind >= 4) add(fmt::format("--kappa-at={}={}..{}", i, digits(low), digits(high)));
      return;
    }
    const std::string range = digits(1.0 / high) + ".." + digits(1.0 / low);
    if (kind == 2) add("--start-radius=" + range);
    if (kind == 3) add("--end-radius=" + range);
    if (kind == 5) add(fmt::format("--radius-at={}={}", i, range));
  }

  struct Data {
    double heading_deg, kappa;
  };
  /// By differences of the known curve, seven digits or so: as a user would have them.
  [[nodiscard]] Data true_data(int i) const {
    const Truth& truth = *out_.truth;
    const std::vector<Real>& t = truth.parameters;
    const auto at = static_cast<std::size_t>(i - 1);
    const Real step = 1e-4L * (t.back() - t.front()) / static_cast<Real>(t.size());
    const Vec a = truth.at(t[at] - step), b = truth.at(t[at]), c = truth.at(t[at] + step);
    const Vec along = c - a;
    const Real kappa = 2.0L * cross(b - a, c - b) / (norm(b - a) * norm(c - b) * norm(along));
    return {static_cast<double>(std::atan2(along.y, along.x) * 180.0L / std::numbers::pi_v<Real>),
            std::stod(few(static_cast<double>(kappa)))};
  }
  Data random_data(const std::vector<Vec>& points, int i) {
    const auto at = static_cast<std::size_t>(i - 1);
    const Vec chord =
        at + 1 < points.size() ? points[at + 1] - points[at] : points[at] - points[at - 1];
    const double along =
        static_cast<double>(std::atan2(chord.y, chord.x)) * 180.0 / std::numbers::pi;
    const double kappa = dice_.chance(0.3) ? 0.0 : dice_.normal() * 4.0 / size_;
    return {along + (dice_.chance(0.6) ? 5.0 * dice_.normal() : dice_.between(-180.0, 180.0)),
            kappa};
  }

  Dice dice_;
  Dice thinning_, naming_;  // of their own: the series that stay are the same
  std::array<bool, 7> wished_{};
  Series out_;
  double size_ = 1.0;
};

}  // namespace

Series make_series(std::uint64_t seed, std::uint64_t index) {
  return SeriesMaker(seed, index).run();
}

}  // namespace judge
