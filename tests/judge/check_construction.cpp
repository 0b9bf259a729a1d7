// SPDX-License-Identifier: Apache-2.0
// Constructions of the papers over the segments of a worksheet, each from its definition.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "region_checks.h"
#include "sentences.h"

namespace judge {
namespace {

constexpr Real kSameCurve = 1e-9L;
constexpr Real kNearlyFarthest = 2e-3L;
constexpr Real kWholeTurn = 2.0L * std::numbers::pi_v<Real>;
constexpr Real kUlp = 0x1p-53L;

struct ConstructionRow {
  std::size_t row = 0;
  std::vector<std::optional<double>> values;
  std::string remark;
};

/// What both checks need of a table and its columns.
class Rows {
 public:
  Rows(const Worksheet& worksheet, const Input& input, const std::string& name, Sheet& sheet)
      : p_(worksheet.last()), input_(input), claim_("region " + name + "."), sheet_(sheet) {
    const Json& made = member(worksheet.json, "construction");
    for (const Json& column : member(made, "columns")) columns_.push_back(column.text);
    for (const Json& one : member(made, "segments")) {
      rows_.push_back(read_row(one));
    }
    for (const Json& one : member(made, "steps")) steps_.push_back(read_row(one));
    for (const Json& remark : member(made, "remarks")) remarks_.push_back(remark.text);
    sound_ = rows_.size() == p_.rows.size();
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      sound_ = sound_ && rows_[k].row == k && rows_[k].values.size() == columns_.size();
    }
    sheet_.expect(sound_, claim_ + "rows", static_cast<Real>(rows_.size()),
                  static_cast<Real>(p_.rows.size()), "one row to a segment, in order");
  }

 protected:
  static ConstructionRow read_row(const Json& one) {
    ConstructionRow row;
    row.row = one.at("segment").index() - 1;
    for (const Json& value : one.at("values")) {
      row.values.push_back(value.is_number() ? std::optional(value.number) : std::nullopt);
    }
    row.remark = text_of(one, "remark");
    return row;
  }
  [[nodiscard]] std::optional<double> value(std::size_t k, const char* column) const {
    return value(rows_[k], column);
  }
  [[nodiscard]] std::optional<double> value(const ConstructionRow& row, const char* column) const {
    const auto at = std::find(columns_.begin(), columns_.end(), column);
    const auto place = static_cast<std::size_t>(at - columns_.begin());
    return place < row.values.size() ? row.values[place] : std::nullopt;
  }
  /// A radius that is not told is that of a line.
  [[nodiscard]] Real kappa(std::size_t k, const char* column) const {
    const auto radius = value(k, column);
    return radius ? 1.0L / static_cast<Real>(*radius) : 0.0L;
  }
  [[nodiscard]] bool has_remark(const char* words) const {
    return std::any_of(remarks_.begin(), remarks_.end(), [words](const std::string& remark) {
      return remark.find(words) != std::string::npos;
    });
  }
  [[nodiscard]] std::string where(std::size_t k) const { return "points " + p_.name(p_.rows[k]); }
  [[nodiscard]] const SheetPoint& from(std::size_t k) const { return p_.points[p_.rows[k].from]; }
  [[nodiscard]] const SheetPoint& to(std::size_t k) const { return p_.points[p_.rows[k].to]; }
  [[nodiscard]] Vec chord(std::size_t k) const { return to(k).point - from(k).point; }

  void near(const char* name, std::optional<double> stated, Real found, Real slack, std::size_t k) {
    if (std::isnan(found)) return sheet_.unjudged(claim_ + name, "not known", where(k));
    sheet_.expect(stated && std::abs(*stated - found) <= slack, claim_ + name,
                  stated ? shown(*stated) : std::string("-"), shown(found), where(k));
  }

  /// The largest distance of spans from the farther boundary, and how far they leave the region.
  void placed(std::size_t k, const std::vector<Span>& spans, const char* farther,
              const char* outside) {
    const auto region = p_.region(p_.rows[k], input_);
    if (!region) return;
    Real most = 0.0L, out = 0.0L;
    for (const Span& span : spans) {
      const auto away = [&](Real t) { return region->farther(span.point(t)); };
      const auto off = [&](Real t) { return region->outside(span.point(t)); };
      most = std::max(most, away(largest_place(away, 0.0L, 1.0L, 72)));
      // a curve that bends a little too much at its end is outside on a short part there
      if (outside == nullptr) continue;
      constexpr std::array<Real, 10> kParts{0.0L, 1e-4L, 1e-3L, 1e-2L, 0.1L,
                                            0.9L, 0.99L, 0.999L, 0.9999L, 1.0L};
      for (std::size_t i = 0; i + 1 < kParts.size(); ++i) {
        out = std::max(out, off(largest_place(off, kParts[i], kParts[i + 1], 72)));
      }
    }
    const Real blur = kSameCurve * norm(chord(k)) + 64.0L * kUlp * p_.coordinate;
    near(farther, value(k, farther), most, kNearlyFarthest * most + blur, k);
    if (outside != nullptr) {
      near(outside, value(k, outside), out, 10.0L * kNearlyFarthest * out + blur, k);
    }
  }

  const SheetPart& p_;
  const Input& input_;
  std::string claim_;
  Sheet& sheet_;
  std::vector<std::string> columns_, remarks_;
  std::vector<ConstructionRow> rows_, steps_;
  bool sound_ = false;
};

/// Two arcs with these radii touch each other and both tangents: A B = -sin^2(sigma/2).
class ArcRows : public Rows {
 public:
  using Rows::Rows;

  void run() {
    if (!sound_) return;
    bool grows = true;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const auto d = p_.direction(p_.rows[k]);
      if (rows_[k].remark == "one arc") {
        one(k);
        continue;
      }
      if (!d || *d == 0) {
        sheet_.fails(claim_ + "rows", "two arcs", "no region of monotone curves", where(k));
        continue;
      }
      two(k, *d);
      const Real k0 = *d * kappa(k, "R"), k1 = *d * kappa(k, "R'");
      grows = grows && k0 < k1;
      const bool one_run = k > 0 && p_.rows[k - 1].to == p_.rows[k].from &&
                           p_.direction(p_.rows[k - 1]) == d;
      if (one_run) grows = grows && *d * kappa(k - 1, "R'") <= k0 + 4.0L * kUlp * std::abs(k0);
    }
    const bool told = has_remark("the radii go one way along every run");
    sheet_.expect(told == grows, claim_ + "one way", std::string(told ? "go" : "do not go"),
                  std::string(grows ? "go" : "do not go"), "");
  }

 private:
  struct Angles {
    Real h, alpha, beta;
  };
  [[nodiscard]] Angles angles(std::size_t k, int d) const {
    const Vec c = chord(k);
    const Real omega = std::atan2(c.y, c.x);
    return {norm(c), d * std::remainder(from(k).heading - omega, kWholeTurn),
            d * std::remainder(to(k).heading - omega, kWholeTurn)};
  }

  void one(std::size_t k) {
    const auto [h, alpha, beta] = angles(k, 1);
    const Real blur = 1e-11L + 8.0L * kUlp * p_.coordinate / h;
    sheet_.expect(std::abs(alpha + beta) <= blur, claim_ + "one arc", 0.0L, alpha + beta, where(k));
    const Real bend = 2.0L * std::sin(beta) / h;
    for (const char* name : {"R", "R'"}) {
      sheet_.expect(std::abs(kappa(k, name) - bend) <= 4.0L * blur / h + kSameCurve * std::abs(bend),
                    claim_ + "one arc radius", kappa(k, name), bend, where(k));
    }
    near("H", value(k, "H"), 0.5L * h * std::abs(std::tan(0.5L * beta)), h * blur, k);
  }

  void two(std::size_t k, int d) {
    const auto [h, alpha, beta] = angles(k, d);
    const Real k0 = d * kappa(k, "R"), k1 = d * kappa(k, "R'");
    const Real a = 0.5L * k0 * h + std::sin(alpha), b = 0.5L * k1 * h - std::sin(beta);
    const Real half = std::sin(0.5L * (alpha + beta)), square = half * half;
    const Real blur = 16.0L * kUlp;
    const Real blur_a = blur * (std::abs(0.5L * k0 * h) + std::abs(std::sin(alpha)) + 1.0L),
               blur_b = blur * (std::abs(0.5L * k1 * h) + std::abs(std::sin(beta)) + 1.0L);
    const Real slack = std::abs(a) * blur_b + std::abs(b) * blur_a + std::abs(half) * blur +
                       blur_a * blur_b + 1e-9L * square;
    sheet_.expect(a < blur_a && b > -blur_b && std::abs(a * b + square) <= slack,
                  claim_ + "R and R' touch", -a * b, square, where(k));
    // the boundary from the start, whatever lies at the end, is the pair with this first circle
    const Element start{from(k).point, from(k).heading, kappa(k, "R")},
        any{to(k).point, to(k).heading, d * HUGE_VALL};
    const auto pair = Region::of(start, any, d);
    if (!pair || !(-a > 1e3L * blur_a)) return sheet_.unjudged(claim_ + "H", "rounding", where(k));
    const auto y = pair->over_middle();
    const Real blur_y = h * (blur + blur_a * (1.0L + square / (a * a)));
    if (y) {
      near("H", value(k, "H"), std::abs((*y)[0]), 100.0L * kSameCurve * std::abs((*y)[0]) + blur_y, k);
    }
    const auto arcs = pair->arcs(0);
    placed(k, {arcs[0], arcs[1]}, "error", nullptr);
  }
};

class ClothoidRows : public Rows {
 public:
  using Rows::Rows;

  void run() {
    if (!sound_) return;
    Real largest = 0.0L;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      curve(k);
      largest = std::max(largest, step(k));
    }
    constexpr Real kNoStep = 2e-12L;
    if (has_remark("the curvature goes on at every point")) {
      sheet_.expect(largest <= kNoStep, claim_ + "largest step", 0.0L, largest, "");
    }
    for (const std::string& remark : remarks_) {
      const std::size_t at = remark.find("steps by up to ");
      if (at == std::string::npos) continue;
      const std::string told = words_of(remark.substr(at + 15)).front();
      sheet_.expect(prints(told, static_cast<double>(100.0L * largest)), claim_ + "largest step",
                    told, shown(100.0L * largest), "");
    }
  }

 private:
  void curve(std::size_t k) {
    const Real k0 = kappa(k, "R"), k1 = kappa(k, "R'"), length = value(k, "length").value_or(0.0);
    const Clothoid one{{}, {}, static_cast<double>(from(k).heading), static_cast<double>(k0),
                       static_cast<double>(k1), static_cast<double>(length)};
    const Real h = norm(chord(k));
    const Vec end = Span(one, {}).point(1.0L);
    const Real sharp = std::max(std::abs(k0), std::abs(k1)) * length;
    const Real blur = length * (1e-11L + 64.0L * kUlp * sharp) + 4.0L * kUlp * p_.coordinate;
    sheet_.expect(norm(end - chord(k)) <= blur, claim_ + "end", norm(end), h, where(k));
    const Real off = std::remainder(
        from(k).heading + 0.5L * (k0 + k1) * length - to(k).heading, kWholeTurn);
    sheet_.expect(std::abs(off) <= 1e-9L + 64.0L * kUlp * sharp, claim_ + "end heading", 0.0L, off,
                  where(k));
    const bool turns = k0 * k1 < 0.0L, told = rows_[k].remark == "inflection inside";
    sheet_.expect(turns == told, claim_ + "inflection", rows_[k].remark,
                  std::string(turns ? "inflection inside" : ""), where(k));
  }

  /// Of the larger curvature.
  Real step(std::size_t k) {
    const auto [first, behind] = p_.section(k);
    const bool last = k + 1 == behind;
    const auto stated = value(k, "step");
    if (last && !p_.loop) {
      sheet_.expect(!stated, claim_ + "step", stated ? shown(*stated) : std::string("-"),
                    std::string("none"), where(k));
      return 0.0L;
    }
    const std::size_t next = last ? first : k + 1;
    const Real before = kappa(k, "R'"), after = kappa(next, "R");
    Real scale = 0.0L;
    for (const Real one : {kappa(k, "R"), before, after, kappa(next, "R'")}) {
      scale = std::max(scale, std::abs(one));
    }
    near("step", stated, after - before, 1e-12L * scale, k);
    return scale > 0.0L ? std::abs(after - before) / scale : 0.0L;
  }
};

/// One conic with the weights 1, w, 1 in the triangle of the tangents.
class EllipseRows : public Rows {
 public:
  using Rows::Rows;

  void run() {
    if (!sound_) return;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      if (value(k, "w")) conic(k);
      if (k + 1 < rows_.size() && p_.rows[k].to == p_.rows[k + 1].from) carried(k, k + 1);
    }
    if (p_.loop) carried(rows_.size() - 1, 0);
  }

 private:
  void conic(std::size_t k) {
    const Vec a = from(k).point, b = to(k).point, u = unit_at(from(k).heading),
              v = unit_at(to(k).heading), c = b - a;
    const Real turn = cross(u, v), to_apex = cross(c, v) / turn, from_apex = cross(u, c) / turn;
    if (!(to_apex > 0.0L && from_apex > 0.0L)) {
      return sheet_.fails(claim_ + "w", shown(*value(k, "w")), "the tangents make no triangle",
                          where(k));
    }
    const Vec apex = a + to_apex * u;
    const Real w = *value(k, "w"), area = 0.5L * cross(u, c) * to_apex;
    // the apex is rounded like the coordinates
    const Real blur = apex_blur(k);
    const auto bend = [&](const char* name, Real side) {
      const Real found = area / (w * w * side * side * side), stated = kappa(k, name);
      sheet_.expect(std::abs(stated - found) <= 8.0L * blur * std::abs(found), claim_ + name, stated,
                    found, where(k));
    };
    bend("R", to_apex);
    bend("R'", from_apex);
    const Span span({a, apex, b}, {1.0L, w, 1.0L});
    placed(k, {span}, "f", "outside");
    kind(k, w, span, apex);
    const bool opens = k == p_.section(k)[0] && !p_.loop && !has_remark("K was moved");
    if (opens) through_k(k, apex, w);
  }

  /// Of the sides of the triangle, relative.
  [[nodiscard]] Real apex_blur(std::size_t k) const {
    const Real turn = std::abs(std::sin(to(k).heading - from(k).heading));
    return kSameCurve + 64.0L * kUlp * (1.0L + p_.coordinate / norm(chord(k))) / turn;
  }

  void kind(std::size_t k, Real w, const Span& span, Vec apex) {
    const std::string& remark = rows_[k].remark;
    const char* found = w < 1.0L ? "ellipse" : w > 1.0L ? "hyperbola" : "parabola";
    sheet_.expect(remark.starts_with(found), claim_ + "kind", remark, std::string(found), where(k));
    const Vec p = apex - from(k).point, q = to(k).point - apex;
    const Real A = dot(p, p), B = dot(q, q), D = dot(p, q), s = w * w;
    // of d kappa/dt: |kappa| falls where none is negative
    const Real coefficient[] = {2.0L * w * (A + D - 2.0L * s * A),
                                0.5L * (A + 2.0L * D + B - 4.0L * s * A), w * (B - A),
                                0.5L * (4.0L * s * B - A - 2.0L * D - B),
                                2.0L * w * (2.0L * s * B - B - D)};
    const Real rounding = 1e-10L * (A + B);
    bool up = true, down = true;
    for (const Real one : coefficient) {
      up = up && one > rounding;
      down = down && one < -rounding;
    }
    const bool monotone = remark.find("monotone") != std::string::npos &&
                          remark.find("vertex inside") == std::string::npos;
    if (up || down) {
      sheet_.expect(monotone, claim_ + "monotone", remark, std::string("monotone"), where(k));
      return;
    }
    if (!monotone) return sheet_.unjudged(claim_ + "monotone", "signs differ", where(k));
    Real before = span.at(0.0L).kappa();
    bool rises = false, falls = false;
    constexpr int kStepsAlong = 200;
    for (int i = 1; i <= kStepsAlong; ++i) {
      const Real now = span.at(static_cast<Real>(i) / kStepsAlong).kappa();
      rises = rises || now - before > 1e-12L * std::abs(now);
      falls = falls || before - now > 1e-12L * std::abs(now);
      before = now;
    }
    sheet_.expect(!(rises && falls), claim_ + "monotone", remark, std::string("a vertex inside"),
                  where(k));
  }

  /// K: in the middle of what both boundaries cut out of the median.
  void through_k(std::size_t k, Vec apex, Real w) {
    const auto region = p_.region(p_.rows[k], input_);
    if (!region) return;
    const Vec middle = 0.5L * (from(k).point + to(k).point), median = apex - middle;
    Real sum = 0.0L, apart = 0.0L;
    for (const std::size_t boundary : {std::size_t{0}, std::size_t{1}}) {
      const auto near_it = [&](Real s) { return -region->distance(middle + s * median, boundary); };
      const Real s = largest_place(near_it, 0.0L, 1.0L, 128);
      sum += s;
      apart = std::abs(2.0L * s - sum);
    }
    const Real passed = w / (1.0L + w);  // of the median at half the parameter
    sheet_.expect(std::abs(passed - 0.5L * sum) <= 1e-2L * apart + 1e-7L, claim_ + "K", passed,
                  0.5L * sum, where(k));
  }

  /// The curvature goes on but where the remarks name the point, or an inflection lies there.
  void carried(std::size_t before, std::size_t behind) {
    const Real one = kappa(before, "R'"), other = kappa(behind, "R");
    const Real blur = 10.0L * (apex_blur(before) + apex_blur(behind));
    const bool same = std::abs(one - other) <= blur * std::max(std::abs(one), std::abs(other));
    if (same || one * other < 0.0L) return sheet_.holds(claim_ + "curvature goes on");
    const std::string name = from(behind).name();
    bool told = false;
    for (const std::string& remark : remarks_) {
      const std::size_t at = remark.find("the curvature steps (G1) at point");
      if (at == std::string::npos) continue;
      const std::string list = remark.substr(at, remark.find(':') - at) + ",";
      told = told || list.find(" " + name + ",") != std::string::npos;
    }
    sheet_.expect(told, claim_ + "curvature goes on", one, other, "point " + name);
  }
};

/// Orders of fixation of parabolas: what stands for radii that are not given.
class ParabolaRows : public Rows {
 public:
  using Rows::Rows;

  void run() {
    if (!sound_) return;
    const bool one = has_remark("(order of fixation 1)"), two = has_remark("(order of fixation 2)");
    sheet_.expect(one != two, claim_ + "order", std::string("one order"),
                  std::string(one ? "both" : "none"), "");
    for (std::size_t k = 0; k + 1 < rows_.size(); ++k) {
      if (p_.rows[k].to != p_.rows[k + 1].from) continue;
      if (two) given_radius(k);
      if (one) mean_radius(k);
    }
  }

 private:
  /// Order 2 meets the radii that the user has.
  void given_radius(std::size_t k) {
    const SheetPoint& p = to(k);
    if (p.inserted > 0 || p.index >= input_.points.size()) return chosen_radius(k);
    const std::optional<double> given = input_.points[p.index].kappa;
    if (!given) return chosen_radius(k);
    if (*given == 0.0) return;
    for (const Real found : {kappa(k, "R'"), kappa(k + 1, "R")}) {
      sheet_.expect(std::abs(found - *given) <= 1e-6L * std::abs(*given), claim_ + "given radius",
                    found, static_cast<Real>(*given), "point " + p.name());
    }
  }

  /// Those that it takes itself lie in their ranges; on both sides of a point they are the same.
  void chosen_radius(std::size_t k) {
    const SheetPoint& p = to(k);
    if (!p.kappas) return;
    const Real before = kappa(k, "R'"), behind = kappa(k + 1, "R");
    Real scale = std::abs(before);
    for (const Real end : {p.kappas->low, p.kappas->high}) {
      if (std::isfinite(end)) scale = std::max(scale, std::abs(end));
    }
    Real slack = 1e-6L * scale;
    for (const std::size_t row : {k, k + 1}) {  // rounding of the sides of short triangles
      const Real sine = std::abs(cross(unit_at(from(row).heading), unit_at(to(row).heading)));
      slack += 64.0L * kUlp * (1.0L + p_.coordinate / norm(chord(row))) / sine * scale;
    }
    for (const Real found : {before, behind}) {
      sheet_.expect(found >= p.kappas->low - slack && found <= p.kappas->high + slack,
                    claim_ + "radius in its range", found,
                    found < p.kappas->low ? p.kappas->low : p.kappas->high, "point " + p.name());
    }
    sheet_.expect(std::abs(before - behind) <= slack, claim_ + "one radius", before, behind,
                  "point " + p.name());
  }

  /// Curvatures of the parabola in the triangle of the tangents, at both ends, signed.
  struct Parabola {
    Real start = 0.0L, end = 0.0L, blur = 0.0L;
  };
  [[nodiscard]] std::optional<Parabola> alone(std::size_t k) const {
    const Vec u = unit_at(from(k).heading), v = unit_at(to(k).heading), c = chord(k);
    const Real turn = cross(u, v), a = cross(c, v) / turn, b = cross(u, c) / turn;
    if (!(a > 0.0L && b > 0.0L)) return std::nullopt;
    const Real area = 0.5L * cross(u, c) * a;
    const Real blur = kSameCurve + 64.0L * kUlp * (1.0L + p_.coordinate / norm(c)) / std::abs(turn);
    return Parabola{area / (a * a * a), area / (b * b * b), blur};
  }

  /// Order 1 takes the geometric mean of both neighbours' where no remark names the point.
  void mean_radius(std::size_t k) {
    const std::string claim = claim_ + "mean radius", name = to(k).name();
    for (const std::string& remark : remarks_) {
      const std::size_t at = remark.find("the mean is missing or was given up");
      if (at == std::string::npos) continue;
      std::string list = remark.substr(0, at);
      std::replace(list.begin(), list.end(), ',', ' ');
      if ((list + " ").find(" " + name + " ") != std::string::npos) return;
    }
    const auto before = alone(k), behind = alone(k + 1);
    if (!before || !behind || !(before->end * behind->start > 0.0L)) {
      return sheet_.unjudged(claim, "an inflection, or no triangle", "point " + name);
    }
    const Real mean = std::copysign(std::sqrt(before->end * behind->start), behind->start);
    const Real blur = 8.0L * (before->blur + behind->blur) + 1e-6L;
    for (const Real found : {kappa(k, "R'"), kappa(k + 1, "R")}) {
      sheet_.expect(std::abs(found - mean) <= blur * std::abs(mean), claim, found, mean,
                    "point " + name);
    }
  }
};

/// A link of four parabolas as the pieces of a contour have it, seen from its start.
class ParabolaLink {
 public:
  static std::optional<ParabolaLink> of(const Piece* pieces) {
    ParabolaLink out;
    const auto* first = std::get_if<Bezier>(pieces);
    if (first == nullptr) return std::nullopt;
    out.start = Vec{first->origin.x, first->origin.y} +
                Vec{first->offset.front().x, first->offset.front().y};
    for (int i = 0; i < 4; ++i) {
      const auto* one = std::get_if<Bezier>(pieces + i);
      const bool same = one != nullptr && one->offset.size() == 3 &&
                        one->origin.x == first->origin.x && one->origin.y == first->origin.y;
      if (!same) return std::nullopt;
      for (std::size_t j = 0; j < 3; ++j) {
        out.p[static_cast<std::size_t>(i)][j] = seen(one->offset[j], first->offset.front());
      }
    }
    out.measure();
    return out;
  }

  std::array<std::array<Vec, 3>, 4> p;
  Vec start;
  Real h = 0.0L;                ///< its chord
  Real k1 = 0.0L, k2 = 0.0L;    ///< radii at its ends over those of the first step
  Real shift = 0.0L;            ///< where the first tangent touches, from its middle
  Real off_parallel = 0.0L;     ///< of that tangent to the chord, rad
  Real blur = 0.0L;             ///< rounding of its radii, relative
  Real blur_shift = 0.0L;

  /// At an end of a parabola, signed.
  static Real bend(const std::array<Vec, 3>& q, bool at_start) {
    const Vec a = q[1] - q[0], b = q[2] - q[1];
    const Real leg = norm(at_start ? a : b);
    return 0.5L * cross(a, b) / (leg * leg * leg);
  }

 private:
  void measure() {
    const Vec touch = p[1][2], end = p[3][2], along = p[1][2] - p[1][1];
    const Vec u = p[0][1] - p[0][0], v = p[3][2] - p[3][1];
    h = norm(end);
    off_parallel = std::abs(cross(along, end)) / (norm(along) * h);
    const Vec c = (cross(touch, along) / cross(u, along)) * u;
    const Vec d = end - (cross(end - touch, along) / cross(v, along)) * v;
    const auto first = [](Vec a, Vec b) {  // curvature of the first step's parabola at its start
      const Real leg = norm(a);
      return 0.5L * std::abs(cross(a, b)) / (leg * leg * leg);
    };
    k1 = first(c, touch - c) / std::abs(bend(p[0], true));
    k2 = first(end - d, d - touch) / std::abs(bend(p[3], false));
    shift = 0.5L * (norm(touch - c) - norm(d - touch));
    Real area = HUGE_VALL, leg = HUGE_VALL;
    for (const auto& q : p) {
      area = std::min(area, std::abs(cross(q[1] - q[0], q[2] - q[1])));
      leg = std::min({leg, norm(q[1] - q[0]), norm(q[2] - q[1])});
    }
    blur = 1e-9L + 64.0L * kUlp * h * h / area;
    const Real turn = std::min(std::abs(cross(u, along)) / (norm(u) * norm(along)),
                               std::abs(cross(v, along)) / (norm(v) * norm(along)));
    blur_shift = h * (1e-12L + 64.0L * kUlp * h / (leg * turn));
  }
};

/// Spans of the contour that `fit --construction` made, segment by segment.
class ConstructedRows : public Rows {
 public:
  ConstructedRows(const Worksheet& worksheet, const Input& input, const std::string& name,
                  const Course& contour, Sheet& sheet)
      : Rows(worksheet, input, name, sheet), name_(name), contour_(contour) {
    claim_ = "fit --construction " + name + ".";
  }

  void run() {
    if (!sound_) return;
    std::size_t piece = 0;
    const std::vector<Piece>& pieces = contour_.file.pieces;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      std::vector<Span> spans;
      std::size_t vertices = 0;
      const std::size_t first = piece;
      while (piece < pieces.size()) {
        spans.emplace_back(pieces[piece], p_.origin);
        vertices += contour_.laws[piece].one_way() ? 0 : 1;
        ++piece;
        if (contour_.file.elements[piece].source) break;
      }
      if (spans.empty()) {
        return sheet_.fails(claim_ + "pieces", std::to_string(first), "no pieces left", where(k));
      }
      const std::array<Real, 2> ends{bend_of(pieces[first], true), bend_of(pieces[piece - 1], false)};
      if (name_ == "parabolas") links(k, &pieces[first], piece - first);
      segment(k, spans, ends, vertices,
              contour_.curvature_rounding(static_cast<Real>(first)) +
                  contour_.curvature_rounding(static_cast<Real>(piece)));
    }
    sheet_.expect(piece == pieces.size(), claim_ + "pieces", static_cast<Real>(pieces.size()),
                  static_cast<Real>(piece), "pieces of all segments");
  }

 private:
  /// Curvature at an end, seen from the piece's own start: afar even long doubles are too short.
  static Real bend_of(const Piece& piece, bool at_start) {
    const Real t = at_start ? 0.0L : 1.0L;
    const auto* bezier = std::get_if<Bezier>(&piece);
    if (bezier == nullptr) return Span(piece, {}).at(t).kappa();
    std::vector<Vec> points;
    for (const Point p : bezier->offset) points.push_back(seen(p, bezier->offset.front()));
    const std::vector<Real> weights(bezier->weight.begin(), bezier->weight.end());
    return Span(std::move(points), weights).at(t).kappa();
  }

  void segment(std::size_t k, const std::vector<Span>& spans, const std::array<Real, 2>& ends,
               std::size_t vertices, Real blur) {
    const auto bend = [&](const char* column, Real found) {
      const Real stated = kappa(k, column), scale = std::max(std::abs(ends[0]), std::abs(ends[1]));
      sheet_.expect(std::abs(stated - found) <= 1e-6L * scale + blur, claim_ + column, stated, found,
                    where(k));
    };
    bend("R", ends[0]);
    bend("R'", ends[1]);
    const auto count = [&](const char* column) {
      near(column, value(k, column), static_cast<Real>(spans.size()), 0.0L, k);
    };
    if (name_ == "spline") {
      count("spans");
      const std::string found = vertices > 0 ? "vertex inside" : "monotone";
      sheet_.expect(rows_[k].remark == found, claim_ + "remark", rows_[k].remark, found, where(k));
      placed(k, spans, "f", "outside");
    } else if (name_ == "parabolas") {
      count("parabolas");
      near("links", value(k, "links"), 0.25L * static_cast<Real>(spans.size()), 0.0L, k);
      placed(k, spans, "error", nullptr);
    } else if (name_ == "arcs") {
      placed(k, spans, "error", nullptr);
    } else if (name_ == "ellipses") {
      placed(k, spans, "f", "outside");
    }
  }

  /// k1, k2, d and the steps of every link of a segment.
  void links(std::size_t k, const Piece* pieces, std::size_t count) {
    std::vector<const ConstructionRow*> told;
    for (const ConstructionRow& step : steps_) {
      if (step.row == k) told.push_back(&step);
    }
    const std::size_t n = count / 4;
    std::size_t at = 0;
    const auto next = [&]() -> const ConstructionRow* {
      return at < told.size() ? told[at++] : nullptr;
    };
    for (std::size_t link = 0; link < n; ++link) {
      const auto made = ParabolaLink::of(pieces + 4 * link);
      if (!made) return sheet_.unjudged(claim_ + "steps", "links of other pieces", where(k));
      if (link > 0) step(k, *made, next(), "its start", made->p[0][0], 0);
      const ConstructionRow* first = step(k, *made, next(), "step 1", made->p[1][2], 1);
      const ConstructionRow* before = step(k, *made, next(), "step 2, before it", made->p[0][2], 2);
      const ConstructionRow* behind = step(k, *made, next(), "step 2, behind it", made->p[2][2], 3);
      if (first == nullptr || before == nullptr || behind == nullptr) return;
      near("d", value(*first, "d"), made->shift, made->blur_shift, k);
      factor(k, "k1", value(*before, "k1"), made->k1, made->blur);
      factor(k, "k2", value(*behind, "k2"), made->k2, made->blur);
      if (n == 1) {
        near("d", value(k, "d"), made->shift, made->blur_shift, k);
        factor(k, "k1", value(k, "k1"), made->k1, made->blur);
        factor(k, "k2", value(k, "k2"), made->k2, made->blur);
      }
      sheet_.expect(made->off_parallel <= made->blur_shift / made->h, claim_ + "first tangent", 0.0L,
                    made->off_parallel, where(k));
    }
    sheet_.expect(at == told.size(), claim_ + "steps", static_cast<Real>(told.size()),
                  static_cast<Real>(at), where(k));
  }

    void factor(std::size_t k, const char* name, std::optional<double> stated, Real found, Real blur) {
    if (!(blur < 1e-3L)) return sheet_.unjudged(claim_ + name, "rounding", where(k));
    near(name, stated, found, blur * found, k);
  }

  /// Place and radii of a step. 0: a start; 1: both first parabolas where they touch; 2, 3: behind
  /// a parabola of the second step.
  const ConstructionRow* step(std::size_t k, const ParabolaLink& link, const ConstructionRow* row,
                              const char* remark, Vec place, int which) {
    if (row == nullptr || !row->remark.ends_with(remark)) {
      sheet_.fails(claim_ + "steps", row != nullptr ? row->remark : "no row", remark, where(k));
      return nullptr;
    }
    const Vec found = link.start + place;
    const Real slack = 1e-12L * link.h + 16.0L * kUlp * p_.coordinate;
    const auto x = value(*row, "x"), y = value(*row, "y");
    const bool there = x && y && std::abs(*x - found.x) <= slack && std::abs(*y - found.y) <= slack;
    sheet_.expect(there, claim_ + "step place", x.value_or(NAN), found.x, where(k));
    const std::array<Vec, 3>& q = link.p[which == 1 ? 1 : which == 3 ? 2 : 0];
    const Real bend = ParabolaLink::bend(q, which == 0);
    if (!(link.blur < 1e-3L)) {
      sheet_.unjudged(claim_ + "step R", "rounding", where(k));
      return row;
    }
    const Real slack_of_radius = 2.0L * link.blur / std::abs(bend);
    near("step R", value(*row, "R"), 1.0L / (bend * (which == 1 ? link.k1 : 1.0L)),
         slack_of_radius, k);
    near("step R'", value(*row, "R'"), 1.0L / (bend * (which == 1 ? link.k2 : 1.0L)),
         slack_of_radius, k);
    return row;
  }

  std::string name_;
  const Course& contour_;
};

}  // namespace

void check_construction(const Worksheet& worksheet, const Input& input, const std::string& name,
                        Sheet& sheet) {
  if (name == "arcs") return ArcRows(worksheet, input, name, sheet).run();
  if (name == "clothoids") return ClothoidRows(worksheet, input, name, sheet).run();
  if (name == "ellipses") return EllipseRows(worksheet, input, name, sheet).run();
  if (name == "parabolas") return ParabolaRows(worksheet, input, name, sheet).run();
}

namespace {

/// Rows as files have them: behind that of a segment those of its steps.
std::vector<std::pair<std::string, const Json*>> rows_in_order(const Worksheet& worksheet,
                                                               bool steps) {
  const Json& made = member(worksheet.json, "construction");
  const SheetPart& part = worksheet.last();
  std::vector<std::pair<std::string, const Json*>> out;
  for (const Json& one : member(made, "segments")) {
    const std::size_t k = one.at("segment").index();
    if (k < 1 || k > part.rows.size()) continue;
    out.emplace_back(part.name(part.rows[k - 1]), &one);
    for (const Json& step : member(made, "steps")) {
      if (steps && step.at("segment").index() == k) out.emplace_back(out.back().first, &step);
    }
  }
  return out;
}

/// In quotation marks, doubled inside, where it has to be (RFC 4180).
std::string quoted_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::optional<double> number_of(const Json& value) {
  return value.is_number() ? std::optional(value.number) : std::nullopt;
}

}  // namespace

void check_construction_csv(const Worksheet& worksheet, const std::string& csv, Sheet& sheet) {
  const std::vector<std::string> lines = lines_of(csv);
  const auto rows = rows_in_order(worksheet, true);
  sheet.expect(lines.size() == rows.size() + 1, "construction CSV rows",
               static_cast<Real>(lines.size()), static_cast<Real>(rows.size() + 1), "");
  for (std::size_t l = 1; l < std::min(lines.size(), rows.size() + 1); ++l) {
    const auto& [name, json] = rows[l - 1];
    const Json& values = json->at("values");
    const std::vector<std::string> cells = split(lines[l], ",");
    bool same = cells.size() > values.size() && cells[0] == name;
    for (std::size_t k = 0; same && k < values.size(); ++k) {
      const std::optional<double> value = number_of(values[k]);
      const bool straight = !value && cells[k + 1].ends_with("inf");
      const double stated = std::strtod(cells[k + 1].c_str(), nullptr);
      same = straight || (value ? !cells[k + 1].empty() && stated == *value : cells[k + 1].empty());
    }
    same = same && lines[l].ends_with("," + quoted_cell(text_of(*json, "remark")));
    sheet.expect(same, "construction CSV row", lines[l], name + " of the JSON", "");
  }
}

void check_construction_text(const Worksheet& worksheet, const std::string& text, Sheet& sheet) {
  const bool left_out = text.find(" rows of steps: in -o ") != std::string::npos;
  const auto rows = rows_in_order(worksheet, !left_out);
  std::size_t at = 0;
  bool here = false;
  for (const std::string& line : lines_of(text)) {
    const std::vector<std::string> words = words_of(line);
    if (words.empty()) continue;
    if (words[0] == "points" && words.size() > 1) here = words[1] != "chord" && words[1] != "x";
    if (!here || at >= rows.size() || words[0] != rows[at].first) continue;
    const Json& values = rows[at].second->at("values");
    bool same = words.size() > values.size();
    for (std::size_t k = 0; same && k < values.size(); ++k) {
      const std::optional<double> value = number_of(values[k]);
      same = (!value && words[k + 1].ends_with("inf")) || prints(words[k + 1], value);
    }
    same = same && line.ends_with(text_of(*rows[at].second, "remark"));
    sheet.expect(same, "text: construction row", line, rows[at].first + " of the JSON", "");
    ++at;
  }
  sheet.expect(at == rows.size(), "text: construction rows", static_cast<Real>(at),
               static_cast<Real>(rows.size()), "");
  for (const Json& remark : member(member(worksheet.json, "construction"), "remarks")) {
    const bool told = text.find(remark.text + "\n") != std::string::npos;
    sheet.expect(told, "text: construction remark", remark.text,
                 std::string(told ? "there" : "not there"), "");
  }
}

void check_constructed(const Worksheet& worksheet, const Input& input, const std::string& name,
                       const Course& contour, Sheet& sheet) {
  ConstructedRows(worksheet, input, name, contour, sheet).run();
}

}  // namespace judge
