// SPDX-License-Identifier: Apache-2.0
#include "ends.h"

#include <cmath>
#include <utility>
#include <vector>

namespace judge {
namespace {

/// rad: pieces that wind more often than 1,600 times are not followed.
constexpr double kMostTurning = 1e4;

BallVec exact(Point p) { return {p.x, p.y}; }

BallVec direction(const Ball& theta) {
  BallVec out;
  sin_cos(theta, out.y, out.x);
  return out;
}

/// The chord vector of curvature k0 + (k1 - k0) u over a length, seen from heading theta.
/// Taylor series of exp(i (a u + b u^2)) on panels with |a| + |b| below 1.
BallVec clothoid_chord(const Ball& theta, const Ball& k0, const Ball& k1, const Ball& length) {
  const double most = std::max(abs(k0).upper(), abs(k1).upper()) * length.upper();
  if (!(most < kMostTurning)) {  // nothing is known of such a piece
    BallVec nothing{0.0, 0.0};
    nothing.x.widen(length);
    nothing.y.widen(length);
    return nothing;
  }
  const int panels = std::max(1, static_cast<int>(std::ceil(most)));
  const Ball step = length / Ball(panels);
  const Ball rate = (k1 - k0) / length;
  const int terms = 24 + static_cast<int>(working_bits() / 6);
  BallVec sum{0.0, 0.0};
  for (int panel = 0; panel < panels; ++panel) {
    const Ball s = Ball(panel) * step;
    const Ball kappa = k0 + rate * s;
    const Ball heading = theta + k0 * s + Ball(0.5) * rate * s * s;
    const Ball a = kappa * step, b = rate * step * step;  // phase a u + b u^2 / 2
    // c_n of exp(i(a u + b u^2/2)): (n+1) c_{n+1} = i (a c_n + b c_{n-1})
    BallVec before{0.0, 0.0}, now{1.0, 0.0};
    BallVec part = now;  // integral over u from 0 to 1: c_n / (n + 1)
    for (int n = 0; n < terms; ++n) {
      const BallVec mixed = a * now + b * before;
      const Ball over = Ball(1.0) / Ball(n + 1);
      before = now;
      now = {-(over * mixed.y), over * mixed.x};
      part.x.add_product(now.x, Ball(1.0) / Ball(n + 2));
      part.y.add_product(now.y, Ball(1.0) / Ball(n + 2));
    }
    // |c_n| <= coefficients of exp(|a| u + |b| u^2/2); far beyond these terms they at least halve
    const Ball rest = Ball(4.0) * (abs(now.x) + abs(now.y) + abs(before.x) + abs(before.y));
    part.x.widen(rest);
    part.y.widen(rest);
    const BallVec u = direction(heading);
    sum.x += step * (u.x * part.x - u.y * part.y);
    sum.y += step * (u.x * part.y + u.y * part.x);
  }
  return sum;
}

/// The chord vector of a circle arc, in closed form where it turns far enough.
BallVec arc_chord(const Ball& theta, const Ball& kappa, const Ball& length) {
  const Ball turn = kappa * length;
  if (abs(turn).upper() < 1.0) return clothoid_chord(theta, kappa, kappa, length);
  const BallVec from = direction(theta), to = direction(theta + turn);
  return {(to.y - from.y) / kappa, (from.x - to.x) / kappa};
}

BallVec relative(const Bezier& bezier, std::size_t of, std::size_t from) {
  return exact(bezier.offset[of]) - exact(bezier.offset[from]);
}

/// d kappa/ds at the start of a curve of degree n, 2 or more, by the quotient rule: derivatives of
/// the weighted points, seen from the start, and of the weights give those of the curve.
Ball slope_by_quotient(std::size_t n, std::vector<BallVec> weighted, std::vector<Ball> weight) {
  if (n == 2) {  // a third difference that the degree does not have
    weight.emplace_back(0.0);
    weighted.push_back({0.0, 0.0});
  }
  const auto d = static_cast<double>(n);
  const Ball one(d), two(d * (d - 1.0)), three(d * (d - 1.0) * (d - 2.0));
  const Ball w = weight[0], w1 = one * (weight[1] - weight[0]),
             w2 = two * (weight[2] - Ball(2.0) * weight[1] + weight[0]);
  const BallVec q1 = one * weighted[1], q2 = two * (weighted[2] - Ball(2.0) * weighted[1]);
  const BallVec q3 = three * (weighted[3] - Ball(3.0) * weighted[2] + Ball(3.0) * weighted[1]);
  const Ball over = Ball(1.0) / w;
  const BallVec c1 = over * q1;
  const BallVec c2 = over * (q2 - Ball(2.0) * w1 * c1);
  const BallVec c3 = over * (q3 - Ball(3.0) * w1 * c2 - Ball(3.0) * w2 * c1);
  const Ball speed2 = dot(c1, c1), speed4 = speed2 * speed2;
  return (cross(c1, c3) * speed2 - Ball(3.0) * cross(c1, c2) * dot(c1, c2)) / (speed4 * speed2);
}

/// Backwards the curvature changes its sign and the arc length too.
Ball bezier_slope(const Bezier& bezier, bool at_start) {
  const std::size_t n = bezier.offset.size() - 1;
  if (n < 2) return 0.0;
  const auto at = [&](std::size_t j) { return at_start ? j : n - j; };
  std::vector<BallVec> weighted;
  std::vector<Ball> weight;
  for (std::size_t j = 0; j <= std::min<std::size_t>(n, 3); ++j) {
    weight.emplace_back(bezier.weight[at(j)]);
    weighted.push_back(weight[j] * relative(bezier, at(j), at(0)));
  }
  return slope_by_quotient(n, std::move(weighted), std::move(weight));
}

/// Of the part behind t, by de Casteljau's construction.
Ball bezier_slope_at(const Bezier& bezier, const Ball& t) {
  const std::size_t n = bezier.offset.size() - 1;
  if (n < 2) return 0.0;
  std::vector<BallVec> q;
  std::vector<Ball> w;
  for (std::size_t j = 0; j <= n; ++j) {
    w.emplace_back(bezier.weight[j]);
    q.push_back(w[j] * relative(bezier, j, 0));
  }
  const Ball rest = Ball(1.0) - t;
  // place j is blended n - j times: the control points of the part behind t
  for (std::size_t last = n; last-- > 0;) {
    for (std::size_t j = 0; j <= last; ++j) {
      q[j] = rest * q[j] + t * q[j + 1];
      w[j] = rest * w[j] + t * w[j + 1];
    }
  }
  const BallVec start = (Ball(1.0) / w[0]) * q[0];
  const std::size_t kept = std::min<std::size_t>(n, 3) + 1;
  for (std::size_t j = 0; j < kept; ++j) q[j] = q[j] - w[j] * start;
  q.resize(kept);
  w.resize(kept);
  return slope_by_quotient(n, std::move(q), std::move(w));
}

End bezier_end(const Bezier& bezier, bool at_start) {
  const std::size_t n = bezier.offset.size() - 1;
  const auto at = [&](std::size_t j) { return at_start ? j : n - j; };
  End end;
  end.point = exact(bezier.origin) + exact(bezier.offset[at(0)]);
  const BallVec leg = relative(bezier, at(1), at(0));
  end.tangent = at_start ? leg : Ball(-1.0) * leg;
  end.kappa = Ball(0.0);
  if (n < 2) return end;
  const Ball w0 = bezier.weight[at(0)], w1 = bezier.weight[at(1)], w2 = bezier.weight[at(2)];
  const Ball length = norm(leg);
  const auto degree = static_cast<double>(n);
  const Ball factor = Ball(degree - 1.0) / Ball(degree) * w0 * w2 / (w1 * w1);
  const Ball area = cross(leg, relative(bezier, at(2), at(0)));
  end.kappa = factor * area / (length * length * length);
  if (!at_start) end.kappa = -end.kappa;
  end.slope = bezier_slope(bezier, at_start);
  return end;
}

Ball clothoid_slope(const Clothoid& c) {
  return (Ball(c.kappa1) - Ball(c.kappa0)) / Ball(c.length);
}

}  // namespace

Ball angle_between(const BallVec& from, const BallVec& to) {
  return atan2(cross(from, to), dot(from, to));
}

Ball turning_of(const Clothoid& c) {
  return Ball(0.5) * (Ball(c.kappa0) + Ball(c.kappa1)) * Ball(c.length);
}

Ball slope_at(const Piece& piece, double t) {
  if (const auto* bezier = std::get_if<Bezier>(&piece)) {
    return t == 1.0 ? bezier_slope(*bezier, false) : bezier_slope_at(*bezier, Ball(t));
  }
  const auto* clothoid = std::get_if<Clothoid>(&piece);
  return clothoid != nullptr ? clothoid_slope(*clothoid) : Ball(0.0);
}

End start_of(const Piece& piece) {
  if (const auto* bezier = std::get_if<Bezier>(&piece)) return bezier_end(*bezier, true);
  if (const auto* arc = std::get_if<Arc>(&piece)) {
    return {exact(arc->start), direction(arc->theta0), arc->kappa};
  }
  if (const auto* one = std::get_if<Clothoid>(&piece)) {
    return {exact(one->start), direction(one->theta0), one->kappa0, clothoid_slope(*one)};
  }
  const auto& line = std::get<Line>(piece);
  return {exact(line.start), exact(line.end) - exact(line.start), 0.0};
}

End end_of(const Piece& piece) {
  if (const auto* bezier = std::get_if<Bezier>(&piece)) return bezier_end(*bezier, false);
  if (const auto* arc = std::get_if<Arc>(&piece)) {
    const Ball theta(arc->theta0), k(arc->kappa), s(arc->length);
    return {exact(arc->start) + arc_chord(theta, k, s), direction(theta + k * s), k};
  }
  if (const auto* one = std::get_if<Clothoid>(&piece)) {
    const Ball theta(one->theta0), k0(one->kappa0), k1(one->kappa1), s(one->length);
    return {exact(one->start) + clothoid_chord(theta, k0, k1, s),
            direction(theta + turning_of(*one)), k1, clothoid_slope(*one)};
  }
  const auto& line = std::get<Line>(piece);
  return {exact(line.end), exact(line.end) - exact(line.start), 0.0};
}

}  // namespace judge
