// SPDX-License-Identifier: Apache-2.0
#include "span_net.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "obvid/curve/internal/basis.h"

namespace obvid::nearest_detail {
namespace {

struct Interval {
  double low = 0.0, high = 0.0;
};

Interval product_of(const VectorBall& a, const VectorBall& b) {
  const double middle = dot(a.middle, b.middle);
  const double off = norm(a.middle) * b.radius + a.radius * b.most();
  return {middle - off, middle + off};
}

/// Rows of a matrix that makes control points of a part of a span from those of the span: values
/// of the polar form where some arguments are the part's first parameter and the rest its last.
struct PartMatrix {
  std::size_t first = 0;
  std::size_t order = 0;
  std::vector<double> share;  ///< row by row

  PartMatrix(int degree, const std::vector<double>& knots, const Range& part)
      : order(static_cast<std::size_t>(degree) + 1) {
    const std::size_t n = order - 1, k = span_at(degree, knots, part.at(0.5));
    first = k - n;
    share.resize(order * order);
    std::vector<double> d(order * order);
    for (std::size_t row = 0; row < order; ++row) {
      std::fill(d.begin(), d.end(), 0.0);
      for (std::size_t j = 0; j < order; ++j) d[j * order + j] = 1.0;
      for (std::size_t r = 1; r <= n; ++r) {
        const double at = r <= n - row ? part.from : part.to;
        for (std::size_t j = n; j >= r; --j) {
          const double low = knots[j + k - n], high = knots[j + 1 + k - r];
          const double to = (at - low) / (high - low);
          for (std::size_t i = 0; i < order; ++i) {
            d[j * order + i] = (1.0 - to) * d[(j - 1) * order + i] + to * d[j * order + i];
          }
        }
      }
      for (std::size_t i = 0; i < order; ++i) share[row * order + i] = d[n * order + i];
    }
  }
};

/// Quotients by weights that are up to `off` < 1 from 1.
VectorBall divided(const VectorBall& by_weight, double off) {
  const double most = norm(by_weight.middle);
  return {by_weight.middle, (by_weight.radius + most * off) / (1.0 - off)};
}

VectorBall around(const std::vector<Vec3>& vectors) {
  if (vectors.empty()) return {};
  Vec3 sum{};
  for (const Vec3& v : vectors) sum = sum + v;
  VectorBall out{(1.0 / static_cast<double>(vectors.size())) * sum, 0.0};
  for (const Vec3& v : vectors) out.radius = std::max(out.radius, norm(v - out.middle));
  return out;
}

struct NumberBall {
  double middle = 0.0, radius = 0.0;
};

NumberBall around(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {0.5 * (*least + *most), 0.5 * (*most - *least)};
}

VectorBall operator*(const NumberBall& a, const VectorBall& b) {
  return {a.middle * b.middle, std::abs(a.middle) * b.radius + a.radius * b.most()};
}

VectorBall operator-(const VectorBall& a, const VectorBall& b) {
  return {a.middle - b.middle, a.radius + b.radius};
}

/// Differences of a net in one direction, times the degree: control values of the derivative.
template <class T>
struct ValueNet {
  std::size_t columns = 0, rows = 0;
  std::vector<T> at;

  [[nodiscard]] ValueNet along_u() const {
    ValueNet out{columns - 1, rows, {}};
    const auto degree = static_cast<double>(columns - 1);
    for (std::size_t j = 0; j < rows; ++j) {
      for (std::size_t i = 0; i + 1 < columns; ++i) {
        out.at.push_back(degree * (at[j * columns + i + 1] - at[j * columns + i]));
      }
    }
    return out;
  }
  [[nodiscard]] ValueNet along_v() const {
    ValueNet out{columns, rows - 1, {}};
    const auto degree = static_cast<double>(rows - 1);
    for (std::size_t k = 0; k + columns < at.size(); ++k) {
      out.at.push_back(degree * (at[k + columns] - at[k]));
    }
    return out;
  }
};

}  // namespace

std::array<double, 2> Bowl::lowest_in(const Range& x, const Range& y) const {
  std::array<double, 2> best{0.0, 0.0};
  double least = 0.0;
  const auto look = [&](double p, double q) {
    const double value = at(p, q);
    if (!(value < least)) return;
    least = value;
    best = {p, q};
  };
  constexpr double kOneDirection = 1e-14;  // of a c: lowest along a line, which ends at a border
  const double det = a * c - b * b;
  if (det > kOneDirection * a * c) {
    const double p = -(c * g - b * h) / det, q = -(a * h - b * g) / det;
    if (p >= x.from && p <= x.to && q >= y.from && q <= y.to) look(p, q);
  }
  const auto lowest = [](double slope, double bend, const Range& range) {
    if (bend > 0.0) return std::clamp(-slope / bend, range.from, range.to);
    return slope > 0.0 ? range.from : range.to;
  };
  for (const double p : {x.from, x.to}) look(p, lowest(h + b * p, c, y));
  for (const double q : {y.from, y.to}) look(lowest(g + b * q, a, x), q);
  return best;
}

SpanNet::SpanNet(const NurbsSurface& surface, const Range& u, const Range& v)
    : columns_(static_cast<std::size_t>(surface.degree_u) + 1),
      rows_(static_cast<std::size_t>(surface.degree_v) + 1),
      points_(columns_ * rows_),
      weights_(columns_ * rows_, 1.0) {
  const PartMatrix in_u(surface.degree_u, surface.knots_u, u);
  const PartMatrix in_v(surface.degree_v, surface.knots_v, v);
  const bool rational = !surface.weights.empty();
  // first along u, row by row of the span
  std::vector<Vec3> half(points_.size());
  std::vector<double> half_weights(points_.size(), 0.0);
  const auto from = [&](std::size_t i, std::size_t j) {
    return (in_v.first + j) * surface.count_u() + in_u.first + i;
  };
  const Vec3 origin = surface.points[from(0, 0)];
  for (std::size_t j = 0; j < rows_; ++j) {
    for (std::size_t i = 0; i < columns_; ++i) {
      const std::size_t to = j * columns_ + i;
      for (std::size_t k = 0; k < columns_; ++k) {
        const double weight = rational ? surface.weights[from(k, j)] : 1.0;
        const double share = weight * in_u.share[i * columns_ + k];
        half[to] = half[to] + share * (surface.points[from(k, j)] - origin);
        half_weights[to] += share;
      }
    }
  }
  double sum = 0.0;
  for (std::size_t j = 0; j < rows_; ++j) {
    for (std::size_t i = 0; i < columns_; ++i) {
      const std::size_t to = j * columns_ + i;
      Vec3 point{};
      double weight = 0.0;
      for (std::size_t k = 0; k < rows_; ++k) {
        const double share = in_v.share[j * rows_ + k];
        point = point + share * half[k * columns_ + i];
        weight += share * half_weights[k * columns_ + i];
      }
      points_[to] = origin + (1.0 / weight) * point;
      weights_[to] = rational ? weight : 1.0;
      sum += weights_[to];
    }
  }
  for (double& w : weights_) w *= static_cast<double>(weights_.size()) / sum;
  bound();
}

void SpanNet::bound() {
  const Vec3 a = points_.front(), b = points_[columns_ - 1];
  const Vec3 c = points_[points_.size() - columns_], d = points_.back();
  middle_ = a + 0.25 * ((b - a) + (c - a) + (d - a));
  along_u_ = 0.5 * ((b - a) + (d - c));
  along_v_ = 0.5 * ((c - a) + (d - b));
  for (std::size_t j = 0; j < rows_; ++j) {
    const double y = static_cast<double>(j) / static_cast<double>(rows_ - 1) - 0.5;
    for (std::size_t i = 0; i < columns_; ++i) {
      const double x = static_cast<double>(i) / static_cast<double>(columns_ - 1) - 0.5;
      const Vec3 r = points_[j * columns_ + i] - middle_;
      uneven_ = std::max(uneven_, norm(r - (x * along_u_ + y * along_v_)));
      reach_ = std::max(reach_, norm(r));
      weight_off_ = std::max(weight_off_, std::abs(weights_[j * columns_ + i] - 1.0));
    }
  }
}

SpanSlopes SpanNet::slopes() const {
  ValueNet<Vec3> homogeneous{columns_, rows_, {}};
  for (std::size_t k = 0; k < points_.size(); ++k) {
    homogeneous.at.push_back(weights_[k] * (points_[k] - middle_));
  }
  SpanSlopes out;
  const ValueNet<Vec3> u = homogeneous.along_u(), v = homogeneous.along_v();
  const ValueNet<Vec3> uv = u.along_v();
  out.du = around(u.at);
  out.dv = around(v.at);
  out.duv = around(uv.at);
  out.duu = columns_ > 2 ? around(u.along_u().at) : VectorBall{};
  out.dvv = rows_ > 2 ? around(v.along_v().at) : VectorBall{};
  if (!(weight_off_ > 0.0) || !(weight_off_ < 1.0)) return out;
  // S = C / w about the middle: S_u = (C_u - S w_u) / w, and so on
  const ValueNet<double> w{columns_, rows_, weights_};
  const ValueNet<double> wu_net = w.along_u(), wv_net = w.along_v();
  const NumberBall wu = around(wu_net.at), wv = around(wv_net.at);
  const NumberBall wuv = around(wu_net.along_v().at);
  const NumberBall wuu = columns_ > 2 ? around(wu_net.along_u().at) : NumberBall{};
  const NumberBall wvv = rows_ > 2 ? around(wv_net.along_v().at) : NumberBall{};
  const VectorBall place{{}, reach_};
  out.du = divided(out.du - wu * place, weight_off_);
  out.dv = divided(out.dv - wv * place, weight_off_);
  out.duu = divided(out.duu - wu * out.du - wu * out.du - wuu * place, weight_off_);
  out.dvv = divided(out.dvv - wv * out.dv - wv * out.dv - wvv * place, weight_off_);
  out.duv = divided(out.duv - wu * out.dv - wv * out.du - wuv * place, weight_off_);
  return out;
}

FlatFoot SpanNet::flat_foot(Vec3 from) const {
  const Vec3 r = middle_ - from;
  const Bowl bowl{dot(along_u_, along_u_), dot(along_u_, along_v_), dot(along_v_, along_v_),
                  dot(r, along_u_), dot(r, along_v_)};
  const Range whole{-0.5, 0.5};
  const auto [x, y] = bowl.lowest_in(whole, whole);
  return {norm(r + x * along_u_ + y * along_v_) - uneven_, x + 0.5, y + 0.5};
}

bool SpanNet::longer_along_u() const {
  const SpanSlopes slope = slopes();
  return slope.du.most() > slope.dv.most();
}

bool SpanNet::one_valley(Vec3 from) const {
  if (!(weight_off_ < 1.0)) return false;
  const SpanSlopes slope = slopes();
  const VectorBall r{middle_ - from, reach_};
  const auto sum = [](const Interval& a, const Interval& b) {
    return Interval{a.low + b.low, a.high + b.high};
  };
  const Interval uu = sum(product_of(slope.du, slope.du), product_of(r, slope.duu));
  const Interval vv = sum(product_of(slope.dv, slope.dv), product_of(r, slope.dvv));
  const Interval uv = sum(product_of(slope.du, slope.dv), product_of(r, slope.duv));
  const double across = std::max(std::abs(uv.low), std::abs(uv.high));
  return uu.low > 0.0 && vv.low > 0.0 && uu.low * vv.low > across * across;
}

}  // namespace obvid::nearest_detail
