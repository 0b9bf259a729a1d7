// SPDX-License-Identifier: Apache-2.0
// What `obvid nurbs` says, against the control points, weights and knots that it was given.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "command_checks.h"

namespace judge {
namespace {

constexpr Real kExactly = 1e-12L;  // of what a figure is compared with

std::vector<Real> uniform(std::size_t points, int degree) {
  const auto p = static_cast<std::size_t>(degree);
  std::vector<Real> out;
  for (std::size_t k = 0; k <= points + p; ++k) {
    out.push_back(static_cast<Real>(std::clamp(k, p, points) - p));
  }
  return out;
}

/// The curve from which one weight is looked at: without the point, with weight 1, with another.
class OneWeight {
 public:
  OneWeight(const SpaceNurbs& curve, std::size_t i) : curve_(curve), i_(i) { find(); }

  [[nodiscard]] Real u() const { return u_; }
  [[nodiscard]] Real top() const { return curve_.basis(i_, u_); }
  /// The same curve with another weight of the point, there.
  [[nodiscard]] Vec3 with(Real weight) const {
    SpaceNurbs other = curve_;
    other.weights[i_] = weight;
    return other.at(u_).p;
  }
  /// Weight with which the curve goes a part of the way from `with(0)` to the point.
  [[nodiscard]] Real leading(Real part) const {
    Real rest = 0.0L;
    for (std::size_t j = 0; j < curve_.points.size(); ++j) {
      if (j != i_) rest += curve_.weights[j] * curve_.basis(j, u_);
    }
    return part * rest / ((1.0L - part) * top());
  }
  [[nodiscard]] bool alone() const { return top() > 1.0L - 1e-12L; }

 private:
  /// Basis functions rise to one top: the best of equal steps of every span, then thirds.
  void find() {
    const auto p = static_cast<std::size_t>(curve_.degree);
    if (i_ == 0 || i_ + 1 == curve_.points.size()) {
      u_ = i_ == 0 ? curve_.from() : curve_.to();
      return;
    }
    Real low = curve_.knots[i_], high = curve_.knots[i_ + p + 1], best = -1.0L;
    constexpr int kSteps = 64;
    Real from = low, to = high;
    for (std::size_t k = i_; k <= i_ + p; ++k) {
      const Real a = curve_.knots[k], b = curve_.knots[k + 1];
      for (int j = 0; a < b && j <= kSteps; ++j) {
        const Real u = a + (b - a) * j / kSteps, value = curve_.basis(i_, u);
        if (value <= best) continue;
        best = value;
        u_ = u;
        from = std::max(low, u - (high - low) / kSteps);
        to = std::min(high, u + (high - low) / kSteps);
      }
    }
    constexpr int kThirds = 90;
    for (int k = 0; k < kThirds; ++k) {
      const Real a = from + (to - from) / 3.0L, b = to - (to - from) / 3.0L;
      (curve_.basis(i_, a) < curve_.basis(i_, b) ? from : to) =
          curve_.basis(i_, a) < curve_.basis(i_, b) ? a : b;
    }
    if (curve_.basis(i_, 0.5L * (from + to)) > best) u_ = 0.5L * (from + to);
  }

  const SpaceNurbs& curve_;
  std::size_t i_;
  Real u_ = 0.0L;
};

class NurbsCheck {
 public:
  NurbsCheck(const Json& json, const NurbsInput& input, Sheet& sheet)
      : json_(json), in_(input), sheet_(sheet) {}

  void run() {
    sheet_.expect(text_of(json_, "format") == "obvid-nurbs", "nurbs.format",
                  text_of(json_, "format"), "obvid-nurbs", "");
    const bool net = in_.rows > 1;
    sheet_.expect(text_of(json_, "kind") == (net ? "surface" : "curve"), "nurbs.kind",
                  text_of(json_, "kind"), net ? "surface" : "curve", "");
    points();
    const std::size_t along = in_.points.size() / in_.rows;
    const int degree = std::min(in_.degree, static_cast<int>(along) - 1);
    number("degree", degree);
    list("knots", in_.knots.empty() ? uniform(along, degree) : in_.knots);
    if (net) {
      const int across = std::min(in_.degree_v, static_cast<int>(in_.rows) - 1);
      number("degree_v", across);
      number("rows", static_cast<Real>(in_.rows));
      list("knots_v", in_.knots_v.empty() ? uniform(in_.rows, across) : in_.knots_v);
      list("weights", in_.weights);
      sheet_.expect(member(json_, "rows_of_weights").size() == 0, "nurbs.rows_of_weights", 0.0L,
                    static_cast<Real>(member(json_, "rows_of_weights").size()), "of a surface");
      return;
    }
    SpaceNurbs curve{degree, in_.knots.empty() ? uniform(along, degree) : in_.knots, in_.weights,
                     in_.points};
    for (const auto& [i, weight] : in_.at) curve.weights[i] = weight;
    for (const auto& [i, part] : in_.move) {
      const OneWeight one(curve, i);
      curve.weights[i] = one.leading(part);
    }
    // where a basis function is greatest, it is flat: its place is known to half the digits
    list("weights", curve.weights, in_.move.empty() ? kExactly : 1e-6L);
    rows(nurbs_of(json_));
    if (in_.move.empty()) return;
    const auto& [i, part] = in_.move.back();
    const Real b = json_.at("rows_of_weights")[i].at("b").real();
    sheet_.expect(std::abs(b - part) <= kExactly, "nurbs.row.b as asked for", b, part, "");
  }

 private:
  void number(const char* name, Real wanted) {
    const Figure f = figure(json_, name);
    sheet_.expect(f.known() && *f.value == wanted, fmt::format("nurbs.{}", name),
                  f.value.value_or(-1.0), wanted, "");
  }
  void list(const char* name, const std::vector<Real>& wanted, Real part = kExactly) {
    const std::string claim = fmt::format("nurbs.{}", name);
    const std::vector<double> stated = json_.at(name).reals();
    if (stated.size() != wanted.size()) {
      return sheet_.fails(claim, std::to_string(stated.size()), std::to_string(wanted.size()),
                          "how many");
    }
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      sheet_.expect(std::abs(stated[i] - wanted[i]) <= part * std::abs(wanted[i]), claim, stated[i],
                    wanted[i], std::to_string(i + 1));
    }
  }
  void points() {
    const std::vector<Vec3> stated = vec3s_of(json_.at("points"));
    if (stated.size() != in_.points.size()) {
      return sheet_.fails("nurbs.points", std::to_string(stated.size()),
                          std::to_string(in_.points.size()), "how many");
    }
    for (std::size_t i = 0; i < stated.size(); ++i) {
      const Real off = norm(stated[i] - in_.points[i]);
      sheet_.expect(off == 0.0L, "nurbs.points", 0.0L, off, std::to_string(i + 1));
    }
  }

  void rows(const SpaceNurbs& curve) {
    if (const std::string fault = curve.fault(); !fault.empty()) {
      return sheet_.fails("nurbs.curve", "a NURBS curve", fault, "");
    }
    const Json& rows = json_.at("rows_of_weights");
    sheet_.expect(rows.size() == curve.points.size(), "nurbs.rows_of_weights",
                  static_cast<Real>(rows.size()), static_cast<Real>(curve.points.size()), "");
    for (std::size_t i = 0; i < std::min(rows.size(), curve.points.size()); ++i) {
      row(curve, rows[i], i);
    }
  }

  void row(const SpaceNurbs& curve, const Json& row, std::size_t i) {
    const std::string where = fmt::format("point {}", i + 1);
    const auto expect = [&](bool ok, const char* claim, Real stated, Real found) {
      sheet_.expect(ok, claim, stated, found, where);
    };
    const auto real = [&](const char* name) { return static_cast<Real>(row.at(name).real()); };
    expect(real("point") == static_cast<Real>(i + 1), "nurbs.row.point", real("point"),
           static_cast<Real>(i + 1));
    expect(real("w") == curve.weights[i], "nurbs.row.w", real("w"), curve.weights[i]);
    const OneWeight one(curve, i);
    const Real top = curve.basis(i, real("u"));
    expect(std::abs(top - one.top()) <= kExactly, "nurbs.row.u", top, one.top());
    // around the top basis functions are flat: places of one height to twelve digits are a
    // millionth apart, and what the curve does there is that of the place that is stated
    const Real size = extent_of(curve.points) + kExactly * largest_coordinate(curve.points);
    const Real near = 1e-5L * size;
    const auto vector = [&](const char* name, Vec3 wanted) {
      const Real off = norm(vec3_of(row.at(name)) - wanted);
      expect(off <= near, fmt::format("nurbs.row.{}", name).c_str(), 0.0L, off);
    };
    const Vec3 p = curve.points[i], now = vec3_of(row.at("C"));
    const Real there = norm(curve.at(real("u")).p - now);
    expect(there <= 1e-11L * size, "nurbs.row.C", 0.0L, there);
    vector("C", one.with(curve.weights[i]));
    const Real a = real("a"), b = real("b");
    if (one.alone()) {  // the curve passes the point, whatever its weight
      vector("B", p);
      vector("N", p);
      expect(a == 1.0L && b == 1.0L, "nurbs.row.a and b where the curve passes the point", a, 1.0L);
      return;
    }
    vector("B", one.with(0.0L));
    vector("N", one.with(1.0L));
    const Vec3 without = vec3_of(row.at("B"));
    for (const auto& [name, part] : {std::pair{"N", a}, std::pair{"C", b}}) {
      const Real off = norm(without + part * (p - without) - vec3_of(row.at(name)));
      expect(off <= 1e-11L * size, "nurbs.row on the line from B to P", 0.0L, off);
    }
    const Real weight = (1.0L - a) / a / ((1.0L - b) / b);
    expect(std::abs(weight - curve.weights[i]) <= 1e-9L * curve.weights[i],
           "nurbs.row w of a and b", curve.weights[i], weight);
  }

  const Json& json_;
  const NurbsInput& in_;
  Sheet& sheet_;
};

}  // namespace

void check_nurbs(const Json& json, const NurbsInput& input, Sheet& sheet) {
  try {
    NurbsCheck(json, input, sheet).run();
  } catch (const std::exception& error) {
    sheet.fails("nurbs", "the fields of docs/formats.md", error.what(), "");
  }
}

void check_nurbs_samples(const Json& json, const std::string& text, std::size_t count,
                         Sheet& sheet) {
  const SpaceNurbs curve = nurbs_of(json);
  std::string names;
  const auto rows = csv_rows(text, names);
  sheet.expect(names == "u,x,y,z,curvature", "nurbs samples", names, "", "names");
  sheet.expect(rows.size() == count, "nurbs samples", static_cast<Real>(rows.size()),
               static_cast<Real>(count), "rows");
  const Real size = extent_of(curve.points) + kExactly * largest_coordinate(curve.points);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::string where = fmt::format("row {}", k + 1);
    if (rows[k].size() != 5) {
      sheet.fails("nurbs samples", "5 cells", std::to_string(rows[k].size()), where);
      continue;
    }
    const Real wanted = curve.from() + (curve.to() - curve.from()) * static_cast<Real>(k) /
                                           static_cast<Real>(rows.size() - 1);
    const Real u = rows[k][0].value_or(-1.0L);
    const Real range = std::abs(curve.from()) + std::abs(curve.to());
    sheet.expect(std::abs(u - wanted) <= 1e-14L * range, "nurbs samples.u", u, wanted, where);
    const SpaceJet jet = curve.at(u);
    const Vec3 p{rows[k][1].value_or(0.0L), rows[k][2].value_or(0.0L), rows[k][3].value_or(0.0L)};
    sheet.expect(norm(p - jet.p) <= kExactly * size, "nurbs samples", 0.0L, norm(p - jet.p), where);
    const Real bend = jet.curvature();
    // a place that is a knot to rounding has two curvatures where the curve is not C2 there
    const bool knot = std::any_of(curve.knots.begin(), curve.knots.end(),
                                  [&](Real one) { return std::abs(one - u) <= 1e-12L * range; });
    if (!rows[k][4] || !std::isfinite(bend) || norm(jet.d) < 1e-6L * size || knot) continue;
    sheet.expect(std::abs(*rows[k][4] - bend) <= 1e-8L * (bend + 1.0L / size),
                 "nurbs samples.curvature", *rows[k][4], bend, where);
  }
}

}  // namespace judge
