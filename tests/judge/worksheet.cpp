// SPDX-License-Identifier: Apache-2.0
#include "worksheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <numbers>
#include <utility>

namespace judge {
namespace {

constexpr Real kTurnAround = 2.0L * std::numbers::pi_v<Real>;
/// Headings that are told apart, rad.
constexpr Real kSameHeading = 1e-9L;
/// Curvatures at both ends of one arc, relative.
constexpr Real kSameArc = 1e-6L;

Real angle_of(Vec v) { return std::atan2(v.y, v.x); }

std::optional<Limits> range_between(const Json& object, const char* low, const char* high) {
  const Figure a = figure(object, low), b = figure(object, high);
  if (!a.known() && !b.known()) return std::nullopt;
  Limits out;
  if (a.known()) out.low = *a.value;
  if (b.known()) out.high = *b.value;
  return out;
}

SheetPart read_part(const Json& json) {
  SheetPart out;
  const Json &points = json.at("points"), &rows = json.at("segments");
  if (points.size() < 2 || rows.size() == 0) throw std::runtime_error("no points");
  for (const Json& one : points) {
    SheetPoint p;
    const std::vector<double> at = one.at("point").reals();
    if (out.points.empty()) out.origin = {at.at(0), at.at(1)};
    p.stored = {at.at(0), at.at(1)};
    p.point = seen(p.stored, out.origin);
    out.coordinate = std::max({out.coordinate, std::abs(Real{at.at(0)}), std::abs(Real{at.at(1)})});
    p.index = one.at("index").index();
    p.inserted = one.at("inserted").index();
    p.heading = one.at("heading").real();
    p.heading_given = one.at("heading_given").truth();
    p.curvature_given = one.at("curvature_given").truth();
    p.adjacent_kappa = figure(one, "adjacent_kappa").value;
    p.headings = range_between(one, "heading_low", "heading_high");
    p.low_is_open = one.at("heading_low_open").truth();
    p.high_is_open = one.at("heading_high_open").truth();
    p.kappas = range_between(one, "kappa_low", "kappa_high");
    out.points.push_back(p);
  }
  for (const Json& one : rows) {
    SheetRow row;
    row.from = one.at("from").index();
    row.to = one.at("to").index();
    if (row.to != row.from + 1 || row.to >= out.points.size()) {
      throw std::runtime_error("a segment between other points");
    }
    row.start = range_between(one, "kappa_start_low", "kappa_start_high");
    row.end = range_between(one, "kappa_end_low", "kappa_end_high");
    row.figures = &one;
    out.rows.push_back(row);
  }
  const SheetPoint &first = out.points.front(), &last = out.points.back();
  const bool one_section = out.rows.size() + 1 == out.points.size();
  const Real turned = std::remainder(last.heading - first.heading, kTurnAround);
  out.loop = one_section && out.points.size() > 2 && last.index == first.index &&
             last.inserted == 0 && std::abs(turned) < kSameHeading;
  return out;
}

/// What may be at a point; empty where `low` is not below `high`.
Limits crossing(const Limits& a, const Limits& b) {
  return {std::max(a.low, b.low), std::min(a.high, b.high)};
}
Limits mirrored(const Limits& range, int d) {
  return d > 0 ? range : Limits{-range.high, -range.low};
}

/// A segment in the mirror image where curvature grows.
struct Link {
  Real h = 0.0L, alpha = 0.0L, beta = 0.0L;

  /// Least curvature at the end, for the least one at the start: one biarc. NaN: none.
  [[nodiscard]] Real next_low(Real low) const {
    const Real a = 0.5L * low * h + std::sin(alpha), half = std::sin(0.5L * (alpha + beta));
    const Real rest = std::isinf(low) ? 0.0L : a < 0.0L ? half * half / -a : NAN;
    return 2.0L / h * (std::sin(beta) + rest);
  }
  /// The same backwards: the greatest one at the start.
  [[nodiscard]] Real previous_high(Real high) const {
    const Real b = 0.5L * high * h - std::sin(beta), half = std::sin(0.5L * (alpha + beta));
    const Real rest = std::isinf(high) ? 0.0L : b > 0.0L ? half * half / b : NAN;
    return 2.0L / h * (-std::sin(alpha) - rest);
  }
};

class RangeMaker {
 public:
  RangeMaker(const SheetPart& part, const Input& input, Real turned)
      : part_(part), input_(input), turned_(turned) {}

  std::vector<std::optional<Limits>> run(const std::map<std::size_t, int>& ways) {
    const std::size_t n = part_.points.size();
    for (const SheetRow& row : part_.rows) direction_.push_back(part_.direction(row));
    for (const auto& [row, way] : ways) direction_[row] = way;
    for (std::size_t i = 0; i < n; ++i) own_.push_back(own(i));
    out_.assign(n, Limits{});
    for (std::size_t row = 0; row < part_.rows.size();) {
      const auto [first, behind] = part_.section(row);
      section(first, behind);
      row = behind;
    }
    return out_;
  }

 private:
  /// What is given at a point, the arc on it, and the sign that is kept where a range ends with 0.
  [[nodiscard]] Limits own(std::size_t i) const {
    const SheetPoint& p = part_.points[i];
    Limits out;
    if (p.inserted == 0 && p.index < input_.points.size()) {
      const GivenPoint& given = input_.points[p.index];
      if (given.kappas) out = {given.kappas->least, given.kappas->greatest};
      if (given.kappa) out = {*given.kappa, *given.kappa};
    }
    if (p.kappas && p.kappas->low == 0.0L) out = crossing(out, {0.0L});
    if (p.kappas && p.kappas->high == 0.0L) {
      out = crossing(out, {-HUGE_VALL, 0.0L});
    }
    for (std::size_t k = 0; k < part_.rows.size(); ++k) {
      const SheetRow& row = part_.rows[k];
      if (!part_.touches(row, i) || direction_[k] != 0) continue;
      const Vec chord = part_.chord(row);
      const Real turn = std::remainder(
          part_.points[row.to].heading - part_.points[row.from].heading, kTurnAround);
      const Real kappa = 2.0L * std::sin(0.5L * turn) / norm(chord);
      if (p.kappas && p.kappas->low == p.kappas->high) out = *p.kappas;  // judged with the segment
      if (!p.kappas) out = {kappa, kappa};
    }
    return out;
  }

  [[nodiscard]] Link link(std::size_t k) const {
    const SheetPoint &a = part_.points[part_.rows[k].from], &b = part_.points[part_.rows[k].to];
    const Vec chord = part_.chord(part_.rows[k]);
    const Real omega = angle_of(chord), d = *direction_[k];
    return {norm(chord), d * std::remainder(a.heading - omega, kTurnAround) + turned_,
            d * std::remainder(b.heading - omega, kTurnAround) + turned_};
  }

  [[nodiscard]] Limits ahead(std::size_t k, const Limits& from) const {
    if (direction_[k].value_or(0) == 0) return {};
    const int d = *direction_[k];
    return mirrored({link(k).next_low(mirrored(from, d).low), HUGE_VALL}, d);
  }
  [[nodiscard]] Limits back(std::size_t k, const Limits& from) const {
    if (direction_[k].value_or(0) == 0) return {};
    const int d = *direction_[k];
    return mirrored({-HUGE_VALL, link(k).previous_high(mirrored(from, d).high)}, d);
  }

  void section(std::size_t first, std::size_t behind) {
    const std::size_t count = behind - first, start = part_.rows[first].from;
    std::vector<Limits> left(count + 1), right(count + 1);
    // twice around a loop: what comes over its seam is known then
    for (int round = 0; round < (part_.loop ? 2 : 1); ++round) {
      if (round > 0) {
        left[0] = left[count];
        right[count] = right[0];
      }
      for (std::size_t k = 0; k < count; ++k) {
        left[k + 1] = ahead(first + k, crossing(left[k], own_[start + k]));
      }
      for (std::size_t k = count; k-- > 0;) {
        right[k] = back(first + k, crossing(right[k + 1], own_[start + k + 1]));
      }
    }
    for (std::size_t k = 0; k <= count; ++k) {
      const bool known = !std::isnan(left[k].low) && !std::isnan(left[k].high) &&
                         !std::isnan(right[k].low) && !std::isnan(right[k].high);
      const Limits all = crossing(crossing(left[k], right[k]), own_[start + k]);
      out_[start + k] = known && !all.empty() ? std::optional(all) : std::nullopt;
    }
  }

  const SheetPart& part_;
  const Input& input_;
  Real turned_;
  std::vector<std::optional<int>> direction_;
  std::vector<Limits> own_;
  std::vector<std::optional<Limits>> out_;
};

/// Solves a banded system in place by elimination with pivots.
std::vector<Real> solved(std::vector<std::vector<Real>> rows, std::vector<Real> right) {
  const std::size_t n = right.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t best = k;
    for (std::size_t i = k + 1; i < n; ++i) {
      if (std::abs(rows[i][k]) > std::abs(rows[best][k])) best = i;
    }
    std::swap(rows[k], rows[best]);
    std::swap(right[k], right[best]);
    for (std::size_t i = k + 1; i < n; ++i) {
      if (rows[i][k] == 0.0L) continue;
      const Real factor = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j < n; ++j) rows[i][j] -= factor * rows[k][j];
      right[i] -= factor * right[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) right[k] -= rows[k][j] * right[j];
    right[k] /= rows[k][k];
  }
  return right;
}

/// Slopes at the knots of the C2 cubic through ordinates.
std::vector<Real> slopes_of(const std::vector<Real>& h, const std::vector<Real>& f) {
  const std::size_t n = f.size();
  std::vector<std::vector<Real>> rows(n, std::vector<Real>(n, 0.0L));
  std::vector<Real> right(n, 0.0L);
  const auto step = [&](std::size_t i) { return (f[i + 1] - f[i]) / h[i]; };
  for (std::size_t i = 1; i + 1 < n; ++i) {
    rows[i][i - 1] = h[i];
    rows[i][i] = 2.0L * (h[i - 1] + h[i]);
    rows[i][i + 1] = h[i - 1];
    right[i] = 3.0L * (h[i] * step(i - 1) + h[i - 1] * step(i));
  }
  // equal third derivatives on both sides of the second knot and of the last but one
  const auto third = [&](std::size_t row, std::size_t i) {
    // as large as the other rows, or pivots would push it behind all of them
    const Real both = h[i] + h[i + 1];
    const Real a = h[i + 1] * h[i + 1] / both, b = h[i] * h[i] / both;
    rows[row][i] += a;
    rows[row][i + 1] += a - b;
    rows[row][i + 2] -= b;
    right[row] = 2.0L * (a * step(i) - b * step(i + 1));
  };
  third(0, 0);
  third(n - 1, n - 3);
  return solved(std::move(rows), std::move(right));
}

}  // namespace

std::string SheetPoint::name() const {
  return inserted > 0 ? fmt::format("{}.{}", index + 1, inserted) : fmt::format("{}", index + 1);
}

std::optional<int> SheetPart::direction(const SheetRow& row) const {
  if (!row.start || !row.end) return std::nullopt;
  const auto alike = [](Real a, Real b) {
    return std::isfinite(a) && std::abs(a - b) <= kSameArc * std::abs(a);
  };
  const bool one = row.start->low == row.start->high && row.end->low == row.end->high &&
                   alike(row.start->low, row.end->low);
  if (one && figure(*row.figures, "width").value == 0.0) return 0;
  const Real sigma = bending(row);
  if (std::abs(sigma) > kRoundedBending) return sigma > 0.0L ? 1 : -1;
  // a circle fits both headings: the ranges tell
  return row.start->low <= row.end->low && row.start->high <= row.end->high ? 1 : -1;
}

/// Both angles between the chord and the headings.
Real SheetPart::bending(const SheetRow& row) const {
  const Real omega = angle_of(chord(row));
  return std::remainder(points[row.from].heading - omega, kTurnAround) +
         std::remainder(points[row.to].heading - omega, kTurnAround);
}

std::array<Element, 2> SheetPart::bounding(const SheetRow& row, const Input& input) const {
  const bool grows = direction(row) == 1;
  const auto at = [&](std::size_t i, const Limits& range, bool low) {
    const SheetPoint& p = points[i];
    Real kappa = low ? range.low : range.high;
    if (p.inserted == 0 && p.index < input.points.size() && input.points[p.index].kappa) {
      kappa = *input.points[p.index].kappa;
    }
    return Element{p.point, p.heading, kappa};
  };
  return {at(row.from, *row.start, grows), at(row.to, *row.end, !grows)};
}

std::optional<Region> SheetPart::region(const SheetRow& row, const Input& input) const {
  const std::optional<int> d = direction(row);
  if (!d || *d == 0 || std::abs(bending(row)) >= kStraightAngle) return std::nullopt;
  const auto [a, b] = bounding(row, input);
  return Region::of(a, b, *d);
}

std::array<std::size_t, 2> SheetPart::section(std::size_t row) const {
  std::size_t first = row, behind = row + 1;
  while (first > 0 && rows[first - 1].to == rows[first].from) --first;
  while (behind < rows.size() && rows[behind - 1].to == rows[behind].from) ++behind;
  return {first, behind};
}

void read_worksheet(const std::string& text, Worksheet& sheet) {
  ReadJson read = read_json(text);
  if (!read.fault.empty()) {
    sheet.fault = read.fault;
    return;
  }
  sheet.json = std::move(read.value);
  try {
    sheet.user = read_part(sheet.json);
    for (const Json& one : sheet.json.at("elements")) {
      sheet.user.kappas.push_back(one.at("kappa").real());
    }
    if (sheet.json.contains("refined")) sheet.refined = read_part(sheet.json.at("refined"));
  } catch (const std::exception& e) {
    sheet.fault = e.what();
  }
}

std::vector<std::optional<Limits>> curvature_ranges(const SheetPart& part, const Input& input,
                                                    Real turned,
                                                    const std::map<std::size_t, int>& ways) {
  return RangeMaker(part, input, turned).run(ways);
}

std::vector<Span> cubic_through(const std::vector<Vec>& points) {
  std::vector<Real> h, x, y;
  for (std::size_t i = 0; i < points.size(); ++i) {
    x.push_back(points[i].x);
    y.push_back(points[i].y);
    if (i > 0) h.push_back(norm(points[i] - points[i - 1]));
  }
  const std::vector<Real> dx = slopes_of(h, x), dy = slopes_of(h, y);
  std::vector<Span> out;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Real third = h[i] / 3.0L;
    out.emplace_back(
        std::vector<Vec>{points[i], points[i] + third * Vec{dx[i], dy[i]},
                         points[i + 1] - third * Vec{dx[i + 1], dy[i + 1]}, points[i + 1]},
        std::vector<Real>{1.0L, 1.0L, 1.0L, 1.0L});
  }
  return out;
}

}  // namespace judge
