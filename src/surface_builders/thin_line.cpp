// SPDX-License-Identifier: Apache-2.0
#include "thin_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace obvid {
namespace {

constexpr std::size_t kThinOrder = kMostLineDegree + 1;
/// Coefficients on each side of those that the knot itself changes, which follow as well.
constexpr std::size_t kFollowing = 4;
constexpr int kMostPasses = 3;
/// How often weights change before a knot is left where it is, and the error, as a share of the
/// aim, beyond which they are not asked.
constexpr int kWeightings = 3;
constexpr double kHopeless = 1.6;
/// How much nearer the knots beside one come that goes away in the last pass.
constexpr double kNearer = 1.0 / 3.0;
/// Weights grow by 1 + 2 (q - 0.7) q where the error is q of the aim, from 0.7 on.
constexpr double kLoud = 0.7, kGrowth = 2.0, kMostWeight = 1e6;
/// Of the diagonal of the normal equations: below it a coefficient has no data of its own.
constexpr double kLeastThinPivot = 1e-11;

std::vector<double> flat(const Vec3* points, std::size_t count) {
  std::vector<double> out;
  out.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i)
    out.insert(out.end(), {points[i].x, points[i].y, points[i].z});
  return out;
}

class Thinning {
 public:
  Thinning(const ThinLine& line, const ThinData& given, double aim)
      : given_(given),
        aim_(aim),
        degree_(line.degree),
        p_(static_cast<std::size_t>(line.degree)),
        knots_(line.knots),
        width_(3 * line.coefficients.width),
        data_(flat(given.data.points.data(), given.data.points.size())),
        coefficients_(flat(line.coefficients.points.data(), line.coefficients.points.size())),
        weights_(given.at.size(), 1.0) {}

  /// How many knots went away. `moving`: the knots beside one come nearer, too.
  std::size_t pass(bool moving, Watch& watch) {
    std::vector<std::pair<double, double>> candidates;  // need, knot
    const std::vector<double> needs = knot_needs(degree_, knots_, rows());
    for (std::size_t k = 0; k < needs.size(); ++k) {
      candidates.emplace_back(needs[k], knots_[p_ + 1 + k]);
    }
    std::sort(candidates.begin(), candidates.end());
    std::size_t gone = 0;
    for (const auto& [need, knot] : candidates) {
      if (watch.cancelled()) break;
      const auto at = std::lower_bound(knots_.begin(), knots_.end(), knot);
      if (*at != knot) continue;  // it was moved
      const auto q = static_cast<std::size_t>(at - knots_.begin());
      const bool inside = q > p_ + 1 && q + p_ + 2 < knots_.size();
      if (moving && !inside) continue;
      gone += without(q, moving) ? 1 : 0;
    }
    return gone;
  }

  /// Whether the errors near a place are small, or become so.
  bool nearer_at(double place) {
    constexpr int kMoreWeightings = 12;
    constexpr std::size_t kFarther = 8;  // coefficients on each side
    const std::size_t q = span_at(degree_, knots_, place);
    Trial trial;
    trial.knots = knots_;
    trial.coefficients = coefficients_;
    const std::size_t low = q - p_ - std::min(q - p_, kFarther);
    return open(low, q + 1 + kFarther, place, trial) && improved(std::move(trial), kMoreWeightings);
  }

  [[nodiscard]] ThinLine line() const { return {degree_, knots_, rows()}; }

 private:
  [[nodiscard]] std::size_t count() const { return knots_.size() - p_ - 1; }
  [[nodiscard]] Rows rows() const {
    Rows out{width_ / 3, {}};
    for (std::size_t i = 0; i < coefficients_.size(); i += 3) {
      out.points.push_back({coefficients_[i], coefficients_[i + 1], coefficients_[i + 2]});
    }
    return out;
  }

  /// The spline without one knot, as far as it changes.
  struct Trial {
    std::vector<double> knots, coefficients;
    std::size_t from = 0, to = 0;    ///< coefficients that are free
    std::size_t begin = 0, end = 0;  ///< parameters
    std::size_t middle = 0;          ///< that nearest to the knot
    std::vector<BasisValues> basis;  ///< at the parameters
    std::vector<double> rest;        ///< data less the spline, at the parameters
    std::vector<double> weights, errors;
  };

  /// Takes away the knot number `q` of all, if errors allow it.
  bool without(std::size_t q, bool moving) {
    Trial trial;
    return begin(q, moving, trial) && improved(std::move(trial), kWeightings);
  }

  /// Takes what least squares make of the trial, as soon as its errors are small enough.
  bool improved(Trial trial, int weightings) {
    for (int k = 0; k <= weightings; ++k) {
      std::vector<double> by;
      if (!least_squares(trial, by)) return false;
      const double worst = measured_with(trial, by);
      if (worst <= aim_) {
        take(std::move(trial), by);
        return true;
      }
      if (worst > kHopeless * aim_) return false;
      for (std::size_t i = 0; i < trial.errors.size(); ++i) {
        const double share = trial.errors[i] / aim_;
        const double more = 1.0 + kGrowth * std::max(0.0, share - kLoud) * share;
        trial.weights[i] = std::min(trial.weights[i] * more, kMostWeight);
      }
    }
    return false;
  }

  bool begin(std::size_t q, bool moving, Trial& trial) const {
    const double knot = knots_[q];
    trial.knots = knots_;
    if (moving) {
      for (const std::size_t beside : {q - 1, q + 1}) {
        trial.knots[beside] += kNearer * (knot - knots_[beside]);
      }
    }
    trial.knots.erase(trial.knots.begin() + static_cast<std::ptrdiff_t>(q));
    const std::size_t n = count() - 1;
    if (n < p_ + 1) return false;
    // new coefficients q - p - 1 .. q - 1 depend on the knot: those of the old ones for a start
    trial.coefficients = coefficients_;
    const auto row = [this](std::size_t k) { return static_cast<std::ptrdiff_t>(k * width_); };
    const std::size_t half = q - p_ / 2 - 1;
    trial.coefficients.erase(trial.coefficients.begin() + row(half),
                             trial.coefficients.begin() + row(half + 1));
    return open(q - p_ - (moving ? 2 : 1), moving ? q + 1 : q, knot, trial);
  }

  /// Sets free the coefficients from number `low` to `high` and those beside them.
  bool open(std::size_t low, std::size_t high, double middle, Trial& trial) const {
    const std::size_t n = trial.knots.size() - p_ - 1;
    const auto row = [this](std::size_t k) { return static_cast<std::ptrdiff_t>(k * width_); };
    Rows first, last;
    if (!end_coefficients(degree_, trial.knots, given_.kept, first, last)) return false;
    const std::size_t ahead = first.width == 0 ? 0 : first.count();
    const std::size_t behind = last.width == 0 ? 0 : last.count();
    const auto put = [&](const Rows& ends, std::size_t at) {
      if (ends.width == 0) return;
      const std::vector<double> values = flat(ends.points.data(), ends.points.size());
      std::copy(values.begin(), values.end(), trial.coefficients.begin() + row(at));
    };
    put(first, 0);
    put(last, n - behind);
    trial.from = std::max(ahead, low - std::min(low, kFollowing));
    trial.to = std::min(n - behind, high + kFollowing);
    if (trial.from >= trial.to) return false;
    // what is kept at an end moves its neighbours with their knots
    const std::size_t left = trial.from == ahead ? 0 : trial.from;
    const std::size_t right = trial.to == n - behind ? n : trial.to;
    const std::vector<double>& at = given_.at;
    const auto place = [&](double t) {
      return static_cast<std::size_t>(std::lower_bound(at.begin(), at.end(), t) - at.begin());
    };
    trial.begin = place(trial.knots[left]);
    trial.end = right == n ? at.size() : place(trial.knots[right + p_]);
    if (trial.begin >= trial.end) return false;
    trial.middle = std::clamp(place(middle), trial.begin, trial.end - 1);
    trial.weights.assign(weights_.begin() + static_cast<std::ptrdiff_t>(trial.begin),
                         weights_.begin() + static_cast<std::ptrdiff_t>(trial.end));
    trial.errors.resize(trial.end - trial.begin);
    trial.rest.assign(data_.begin() + row(trial.begin), data_.begin() + row(trial.end));
    for (std::size_t i = trial.begin; i < trial.end; ++i) {
      trial.basis.push_back(basis_at(degree_, trial.knots, at[i], 0));
      add(trial.basis.back(), 0, n, -1.0, trial.coefficients,
          trial.rest.data() + row(i - trial.begin));
    }
    return true;
  }

  /// Adds a spline's value to a row; coefficients are given from number `from` to `to`.
  void add(const BasisValues& basis, std::size_t from, std::size_t to, double factor,
           const std::vector<double>& coefficients, double* sum) const {
    for (std::size_t k = 0; k <= p_; ++k) {
      const std::size_t number = basis.first + k;
      const double share = factor * basis.value[0][k];
      if (share == 0.0 || number < from || number >= to) continue;
      const double* given = coefficients.data() + (number - from) * width_;
      for (std::size_t j = 0; j < width_; ++j) sum[j] += share * given[j];
    }
  }

  /// What is to be added to the free coefficients. False where they have no data.
  bool least_squares(const Trial& trial, std::vector<double>& by) const {
    const std::size_t n = trial.to - trial.from;
    std::vector<std::array<double, kThinOrder>> band(n);
    by.assign(n * width_, 0.0);
    for (std::size_t i = 0; i < trial.basis.size(); ++i) {
      const BasisValues& basis = trial.basis[i];
      const double* rest = trial.rest.data() + i * width_;
      for (std::size_t k = 0; k <= p_; ++k) {
        const std::size_t number = basis.first + k;
        if (number < trial.from || number >= trial.to) continue;
        const double share = trial.weights[i] * basis.value[0][k];
        const std::size_t here = number - trial.from;
        for (std::size_t j = k; j <= p_ && basis.first + j < trial.to; ++j) {
          band[here][j - k] += share * basis.value[0][j];
        }
        double* right = by.data() + here * width_;
        for (std::size_t j = 0; j < width_; ++j) right[j] += share * rest[j];
      }
    }
    return solved(band, by);
  }

  /// Cholesky without roots, in a band.
  bool solved(std::vector<std::array<double, kThinOrder>>& band, std::vector<double>& by) const {
    const std::size_t n = band.size();
    std::vector<double> diagonal;
    for (const auto& row : band) diagonal.push_back(row[0]);
    for (std::size_t k = 0; k < n; ++k) {
      if (!(band[k][0] > kLeastThinPivot * diagonal[k])) return false;
      for (std::size_t j = 1; j <= p_ && k + j < n; ++j) {
        const double factor = band[k][j] / band[k][0];
        if (factor == 0.0) continue;
        for (std::size_t i = j; i <= p_ && k + i < n; ++i)
          band[k + j][i - j] -= factor * band[k][i];
        subtract(factor, by.data() + k * width_, by.data() + (k + j) * width_);
      }
    }
    for (std::size_t k = n; k-- > 0;) {
      double* here = by.data() + k * width_;
      for (std::size_t j = 1; j <= p_ && k + j < n; ++j) {
        subtract(band[k][j], by.data() + (k + j) * width_, here);
      }
      const double inverse = 1.0 / band[k][0];
      for (std::size_t j = 0; j < width_; ++j) here[j] *= inverse;
    }
    return true;
  }
  void subtract(double factor, const double* what, double* from) const {
    for (std::size_t j = 0; j < width_; ++j) from[j] -= factor * what[j];
  }

  /// Largest error of the trial with `by` added, from the knot on outwards; ends where there is no
  /// hope.
  double measured_with(Trial& trial, const std::vector<double>& by) const {
    const double hopeless = kHopeless * aim_;
    std::vector<double> left(width_);
    double worst = 0.0;
    const std::size_t middle = trial.middle - trial.begin, all = trial.basis.size();
    for (std::size_t step = 0; step < all && worst <= hopeless; ++step) {
      const std::size_t i = step < all - middle ? middle + step : all - 1 - step;
      const double* rest = trial.rest.data() + i * width_;
      std::copy(rest, rest + width_, left.begin());
      add(trial.basis[i], trial.from, trial.to, -1.0, by, left.data());
      const double strictness = given_.strictness[trial.begin + i];
      const double quiet = kLoud * aim_ / strictness;  // weights do not ask for less
      trial.errors[i] = strictness * std::sqrt(given_.hull.longest_squared(left.data(), quiet));
      worst = std::max(worst, trial.errors[i]);
    }
    return worst;
  }

  void take(Trial trial, const std::vector<double>& by) {
    knots_ = std::move(trial.knots);
    coefficients_ = std::move(trial.coefficients);
    double* free = coefficients_.data() + trial.from * width_;
    for (std::size_t j = 0; j < by.size(); ++j) free[j] += by[j];
    std::copy(trial.weights.begin(), trial.weights.end(),
              weights_.begin() + static_cast<std::ptrdiff_t>(trial.begin));
  }

  const ThinData& given_;
  double aim_;
  int degree_;
  std::size_t p_;
  std::vector<double> knots_;
  std::size_t width_;  ///< numbers in a row
  std::vector<double> data_, coefficients_, weights_;
};

}  // namespace

bool come_nearer(ThinLine& line, const ThinData& given, const std::vector<double>& places,
                 double aim) {
  Thinning thinning(line, given, aim);
  for (const double place : places) {
    if (!thinning.nearer_at(place)) return false;
  }
  line = thinning.line();
  return true;
}

bool thin_out(ThinLine& line, const ThinData& given, double aim, Watch& watch) {
  Thinning thinning(line, given, aim);
  for (int k = 0; k < kMostPasses; ++k) {
    const bool moving = k + 1 == kMostPasses;
    const std::size_t gone = thinning.pass(moving, watch);
    if (watch.was_cancelled()) return false;
    if (gone == 0 && !moving) k = kMostPasses - 2;
  }
  line = thinning.line();
  return true;
}

}  // namespace obvid
