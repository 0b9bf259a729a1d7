// SPDX-License-Identifier: Apache-2.0
#include "height_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "obvid/curve/internal/basis.h"
#include "obvid/numeric/internal/banded_cholesky.h"
#include "obvid/numeric/internal/gauss.h"

namespace obvid {
namespace {

constexpr int kDegree = 3;

}  // namespace

double HeightSpline::at(double u, double v) const {
  const BasisValues a = basis_at(kDegree, knots_u, u, 0), b = basis_at(kDegree, knots_v, v, 0);
  double sum = 0.0;
  for (std::size_t j = 0; j <= kDegree; ++j) {
    const double* row = value.data() + (b.first + j) * count_u() + a.first;
    double line = 0.0;
    for (std::size_t i = 0; i <= kDegree; ++i) line += a.value[0][i] * row[i];
    sum += b.value[0][j] * line;
  }
  return sum;
}

HeightFit::HeightFit(const std::vector<HeightPoint>& points, std::vector<double> knots_u,
                     std::vector<double> knots_v, double width, double depth)
    : knots_u_(std::move(knots_u)), knots_v_(std::move(knots_v)), width_(width), depth_(depth) {
  const auto gram = [](const std::vector<double>& knots, std::size_t derivative) {
    Gram out(knots.size() - kWidth);
    for (std::size_t k = kDegree; k + kWidth < knots.size(); ++k) {
      if (!(knots[k + 1] > knots[k])) continue;
      const double middle = 0.5 * (knots[k] + knots[k + 1]), half = 0.5 * (knots[k + 1] - knots[k]);
      for (std::size_t g = 0; g < 4; ++g) {  // exact: products are of degree 6
        const double sign = g % 2 == 0 ? -1.0 : 1.0;
        const double at = middle + sign * half * GaussRule<4>::kNode[g / 2];
        const double share = half * GaussRule<4>::kWeight[g / 2];
        const BasisValues b = basis_at(kDegree, knots, at, static_cast<int>(derivative));
        for (std::size_t i = 0; i < kWidth; ++i) {
          for (std::size_t j = i; j < kWidth; ++j) {
            out[b.first + i][j - i] += share * b.value[derivative][i] * b.value[derivative][j];
          }
        }
      }
    }
    return out;
  };
  for (std::size_t r = 0; r < 3; ++r) {
    along_u_[r] = gram(knots_u_, r);
    along_v_[r] = gram(knots_v_, r);
  }
  const std::size_t nu = knots_u_.size() - kWidth, nv = knots_v_.size() - kWidth;
  normal_.assign(nu * nv, Stencil{});
  right_.assign(nu * nv, 0.0);
  for (const HeightPoint& p : points) {
    const BasisValues a = basis_at(kDegree, knots_u_, p.u, 0);
    const BasisValues b = basis_at(kDegree, knots_v_, p.v, 0);
    for (std::size_t j = 0; j < kWidth; ++j) {
      for (std::size_t i = 0; i < kWidth; ++i) {
        const std::size_t k = (b.first + j) * nu + a.first + i;
        const double here = a.value[0][i] * b.value[0][j];
        right_[k] += here * p.height;
        for (std::size_t j2 = j; j2 < kWidth; ++j2) {
          for (std::size_t i2 = 0; i2 < kWidth; ++i2) {
            normal_[k][(j2 - j) * kHalf + i2 + kDegree - i] +=
                here * a.value[0][i2] * b.value[0][j2];
          }
        }
      }
    }
  }
  double data = 0.0, plates = 0.0;
  for (std::size_t j = 0; j < nv; ++j) {
    for (std::size_t i = 0; i < nu; ++i) {
      data += normal_[j * nu + i][kDegree];
      plates += plate(i, j, i, j);
    }
  }
  balance_ = data / plates;
}

double HeightFit::plate(std::size_t i, std::size_t j, std::size_t i2, std::size_t j2) const {
  const std::size_t a = std::min(i, i2), k = std::max(i, i2) - a;
  const std::size_t b = std::min(j, j2), m = std::max(j, j2) - b;
  const double w = width_ * width_, d = depth_ * depth_;
  const double sum = along_u_[2][a][k] * along_v_[0][b][m] / (w * w) +
                     2.0 * along_u_[1][a][k] * along_v_[1][b][m] / (w * d) +
                     along_u_[0][a][k] * along_v_[2][b][m] / (d * d);
  return width_ * depth_ * sum;
}

Result<std::optional<HeightSpline>> HeightFit::solved(double weight, const RunContext& run) const {
  const std::size_t nu = knots_u_.size() - kWidth, nv = knots_v_.size() - kWidth;
  // unknowns one after the other along the direction that has fewer of them
  const bool u_first = nu <= nv;
  const std::size_t fast = std::min(nu, nv);
  const auto place = [&](std::size_t i, std::size_t j) {
    return u_first ? j * fast + i : i * fast + j;
  };
  BandedCholesky matrix(nu * nv, kDegree * fast + kDegree);
  std::vector<double> right(nu * nv, 0.0);
  for (std::size_t j = 0; j < nv; ++j) {
    for (std::size_t i = 0; i < nu; ++i) {
      right[place(i, j)] = right_[j * nu + i];
      for (std::size_t dj = 0; dj < kWidth && j + dj < nv; ++dj) {
        for (std::size_t c = 0; c < kHalf; ++c) {
          const std::size_t i2 = i + c - kDegree;  // wraps below 0: then it is not below nu
          if (i2 >= nu || (dj == 0 && i2 < i)) continue;
          const std::size_t a = place(i, j), b = place(i2, j + dj);
          matrix.at(std::min(a, b), std::max(a, b)) =
              normal_[j * nu + i][dj * kHalf + c] + weight * plate(i, j, i2, j + dj);
        }
      }
    }
  }
  bool cancelled = false;
  const auto go_on = [&] { return !(cancelled = !may_go_on(run)); };
  const bool factored = matrix.factor(go_on);
  if (cancelled) return fail(cancelled_error());
  if (!factored) return std::optional<HeightSpline>();
  const std::vector<double> solution = matrix.solve(std::move(right));
  HeightSpline spline{knots_u_, knots_v_, std::vector<double>(nu * nv)};
  for (std::size_t j = 0; j < nv; ++j) {
    for (std::size_t i = 0; i < nu; ++i) spline.value[j * nu + i] = solution[place(i, j)];
  }
  return std::optional(std::move(spline));
}

double HeightFit::bending(const HeightSpline& spline) const {
  const std::size_t nu = spline.count_u(), nv = spline.count_v();
  constexpr double kDigit = std::numeric_limits<double>::epsilon();
  const double height = kDigit * std::max(width_, depth_);  // rounding of the points
  double sum = 0.0, terms = 0.0, all = 0.0, rounding = 0.0;
  for (std::size_t j = 0; j < nv; ++j) {
    for (std::size_t i = 0; i < nu; ++i) {
      for (std::size_t j2 = j; j2 < std::min(nv, j + kWidth); ++j2) {
        const std::size_t first = j2 == j ? i : i - std::min<std::size_t>(i, kDegree);
        for (std::size_t i2 = first; i2 < std::min(nu, i + kWidth); ++i2) {
          const double twice = i2 == i && j2 == j ? 1.0 : 2.0;
          const double a = spline.value[j * nu + i], b = spline.value[j2 * nu + i2];
          const double form = twice * plate(i, j, i2, j2);
          sum += a * b * form;
          terms += 1.0;
          all += std::abs(a * b * form);
          rounding += height * (std::abs(a) + std::abs(b) + height) * std::abs(form);
        }
      }
    }
  }
  return sum <= rounding + terms * kDigit * all ? 0.0 : sum;
}

}  // namespace obvid
