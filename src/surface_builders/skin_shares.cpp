// SPDX-License-Identifier: Apache-2.0
#include "skin_shares.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "obvid/numeric/internal/banded_cholesky.h"

namespace obvid {
namespace {

constexpr std::size_t kMarks = kFreeMarks + 2;
/// Steps between two places by which the turn of a tangent is added up.
constexpr std::size_t kTurnSteps = 1024;
/// Weights of second differences of shares along, beside lines of the body's own length.
constexpr double kSmoothTwist = 1e-3, kSmoothBending = 1e-2;
/// Of the mean of the matrix: shares that no line depends on stay where they are.
constexpr double kAnchor = 1e-9;
constexpr int kMostNewtonSteps = 12, kMostHalvings = 5;
/// Least gap between places, of their mean gap; and least fall of the sum that goes on.
constexpr double kLeastGap = 0.05, kLeastFall = 1e-4;

using Shares = std::vector<std::array<double, kMarks>>;

struct Stencil {
  std::size_t first = 0;  ///< section
  std::array<double, 3> weight{};
};

class SharedLines {
 public:
  SharedLines(const std::vector<MeasuredSection>& sections,
              const std::vector<std::vector<double>>& ends)
      : sections_(sections), ends_(ends), shares_(sections.size()) {
    for (auto& row : shares_) {
      for (std::size_t j = 0; j < kMarks; ++j) row[j] = static_cast<double>(j) / (kMarks - 1);
    }
  }

  Result<void> least(std::size_t order, double smooth, const RunContext& run) {
    if (sections_.size() < order + 1) return {};
    points_ = placed(shares_);
    for (int step = 0; step < kMostNewtonSteps; ++step) {
      const std::vector<Stencil> rows = stencils(order);
      const double sum = sum_of(rows, points_.at, shares_, smooth);
      const auto by = newton(rows, smooth, run);
      OBVID_TRY(by);
      if (by->empty()) return {};
      double length = 1.0;
      bool fell = false;
      for (int k = 0; k < kMostHalvings && !fell; ++k, length /= 2.0) {
        OBVID_TRY(may_go_on(run));
        const Shares trial = moved(*by, length);
        Placed there = placed(trial);
        const double now = sum_of(rows, there.at, trial, smooth);
        if (!(now < sum)) continue;
        fell = now < (1.0 - kLeastFall) * sum;
        shares_ = trial;
        points_ = std::move(there);
        if (!fell) return {};
      }
      if (!fell) return {};
    }
    return {};
  }

  [[nodiscard]] std::vector<std::vector<double>> marks() const {
    std::vector<std::vector<double>> out(sections_.size());
    for (std::size_t k = 0; k < out.size(); ++k) {
      if (ends_[k].empty()) continue;
      for (const double share : shares_[k]) out[k].push_back(place(k, share));
      out[k].back() = ends_[k].back();
    }
    return out;
  }

 private:
  using Row = std::array<Vec3, kMarks>;
  struct Placed {
    std::vector<Row> at, by_share;
  };

  [[nodiscard]] double place(std::size_t k, double share) const {
    return ends_[k].front() + share * (ends_[k].back() - ends_[k].front());
  }
  [[nodiscard]] Placed placed(const Shares& shares) const {
    Placed out{std::vector<Row>(shares.size()), std::vector<Row>(shares.size())};
    for (std::size_t k = 0; k < shares.size(); ++k) {
      const SkinSection& section = *sections_[k].section;
      for (std::size_t j = 0; j < kMarks; ++j) {
        if (ends_[k].empty()) {
          out.at[k][j] = section.points.front();
          continue;
        }
        const ContourPath::Place here = sections_[k].path->at(place(k, shares[k][j]));
        out.at[k][j] = section.frame.at(here.point);
        out.by_share[k][j] =
            (ends_[k].back() - ends_[k].front()) * section.frame.direction(here.tangent);
      }
    }
    return out;
  }

  /// Differences across of the wanted order over mean chords, without units.
  [[nodiscard]] std::vector<Stencil> stencils(std::size_t order) const {
    const std::size_t n = sections_.size();
    std::vector<double> chord;
    double whole = 0.0, length = 0.0;
    for (std::size_t k = 0; k + 1 < n; ++k) {
      double mean = 0.0;
      for (std::size_t j = 0; j < kMarks; ++j) {
        mean += norm(points_.at[k + 1][j] - points_.at[k][j]) / kMarks;
      }
      chord.push_back(mean);
      whole += mean;
    }
    for (const auto& end : ends_) {
      if (!end.empty()) length = std::max(length, end.back() - end.front());
    }
    std::vector<Stencil> out;
    constexpr double kLeastChord = 1e-9;  // of the whole
    for (double& c : chord) c = std::max(c / whole, kLeastChord);
    for (std::size_t k = 0; k + order < n; ++k) {
      const double a = chord[k];
      if (order == 1) {
        const double w = 1.0 / (std::sqrt(a) * length);
        out.push_back({k, {-w, w, 0.0}});
      } else {
        const double b = chord[k + 1], w = std::sqrt(2.0 / (a + b)) / length;
        out.push_back({k, {w / a, -w * (1.0 / a + 1.0 / b), w / b}});
      }
    }
    return out;
  }

  [[nodiscard]] static double bend_along(const std::array<double, kMarks>& row, std::size_t j) {
    return row[j - 1] - 2.0 * row[j] + row[j + 1];
  }
  [[nodiscard]] static double weight_along(double smooth) {
    return smooth * smooth * std::pow(static_cast<double>(kMarks - 1), 3.0);
  }
  [[nodiscard]] static double sum_of(const std::vector<Stencil>& rows, const std::vector<Row>& at,
                                     const Shares& shares, double smooth) {
    double sum = 0.0;
    for (const Stencil& row : rows) {
      for (std::size_t j = 0; j < kMarks; ++j) {
        const Vec3 r = residual(row, at, j);
        sum += dot(r, r);
      }
    }
    for (const auto& row : shares) {
      for (std::size_t j = 1; j + 1 < kMarks; ++j) {
        sum += weight_along(smooth) * bend_along(row, j) * bend_along(row, j);
      }
    }
    return sum;
  }
  [[nodiscard]] static Vec3 residual(const Stencil& row, const std::vector<Row>& at,
                                     std::size_t j) {
    Vec3 out;
    for (std::size_t q = 0; q < 3 && row.first + q < at.size(); ++q) {
      out = out + row.weight[q] * at[row.first + q][j];
    }
    return out;
  }

  /// Step of the inner shares, section after section; empty where there is none.
  [[nodiscard]] Result<std::vector<double>> newton(const std::vector<Stencil>& rows, double smooth,
                                                   const RunContext& run) const {
    const std::size_t n = sections_.size();
    BandedCholesky matrix(n * kFreeMarks, 2 * kFreeMarks);
    std::vector<double> right(n * kFreeMarks, 0.0);
    const auto index = [](std::size_t k, std::size_t j) { return k * kFreeMarks + j - 1; };
    for (const Stencil& row : rows) {
      for (std::size_t j = 1; j + 1 < kMarks; ++j) {
        const Vec3 r = residual(row, points_.at, j);
        for (std::size_t p = 0; p < 3 && row.first + p < n; ++p) {
          const Vec3 a = row.weight[p] * points_.by_share[row.first + p][j];
          right[index(row.first + p, j)] -= dot(a, r);
          for (std::size_t q = p; q < 3 && row.first + q < n; ++q) {
            matrix.at(index(row.first + p, j), index(row.first + q, j)) +=
                row.weight[q] * dot(a, points_.by_share[row.first + q][j]);
          }
        }
      }
    }
    const double along = weight_along(smooth);
    constexpr std::array<double, 3> kSecond = {1.0, -2.0, 1.0};
    for (std::size_t k = 0; k < n; ++k) {
      for (std::size_t j = 1; j + 1 < kMarks; ++j) {
        const double bend = bend_along(shares_[k], j);
        for (std::size_t p = 0; p < 3; ++p) {
          const std::size_t a = j + p - 1;
          if (a == 0 || a + 1 == kMarks) continue;
          right[index(k, a)] -= along * kSecond[p] * bend;
          for (std::size_t q = p; q < 3; ++q) {
            const std::size_t b = j + q - 1;
            if (b == 0 || b + 1 == kMarks) continue;
            matrix.at(index(k, a), index(k, b)) += along * kSecond[p] * kSecond[q];
          }
        }
      }
    }
    double mean = 0.0;
    for (std::size_t i = 0; i < matrix.size(); ++i) {
      mean += matrix.row(i)[0] / static_cast<double>(matrix.size());
    }
    for (std::size_t i = 0; i < matrix.size(); ++i) matrix.row(i)[0] += kAnchor * mean;
    bool stopped = false;
    const bool factored = matrix.factor([&] {
      stopped = !may_go_on(run);
      return !stopped;
    });
    if (stopped) return fail(cancelled_error());
    if (!factored) return std::vector<double>{};
    return matrix.solve(std::move(right));
  }

  /// Shares in order and apart from each other, whatever the step.
  [[nodiscard]] Shares moved(const std::vector<double>& by, double length) const {
    Shares out = shares_;
    for (std::size_t k = 0; k < out.size(); ++k) {
      for (std::size_t j = 1; j + 1 < kMarks; ++j) {
        out[k][j] += length * by[k * kFreeMarks + j - 1];
      }
      std::array<double, kMarks> gap{};
      double sum = 0.0;
      for (std::size_t j = 1; j < kMarks; ++j) {
        gap[j] = std::max(out[k][j] - out[k][j - 1], kLeastGap / (kMarks - 1));
        sum += gap[j];
      }
      for (std::size_t j = 1; j < kMarks; ++j) out[k][j] = out[k][j - 1] + gap[j] / sum;
      out[k].back() = 1.0;
    }
    return out;
  }

  const std::vector<MeasuredSection>& sections_;
  const std::vector<std::vector<double>>& ends_;
  Shares shares_;
  Placed points_;
};

}  // namespace

std::vector<double> marks_by_angle(const MeasuredSection& section, double from, double to) {
  std::vector<double> turned = {0.0};
  const auto at = [&](std::size_t i) {
    return from + (to - from) * static_cast<double>(i) / static_cast<double>(kTurnSteps);
  };
  Vec2 before = section.path->at(from).tangent;
  for (std::size_t i = 1; i <= kTurnSteps; ++i) {
    const Vec2 here = section.path->at(at(i), i == kTurnSteps).tangent;
    turned.push_back(turned.back() + std::abs(turning(before, here)));
    before = here;
  }
  constexpr double kStraight = 1e-9;  // radians
  const bool straight = !(turned.back() > kStraight);
  const auto share = [&](std::size_t i) {
    const double length = static_cast<double>(i) / static_cast<double>(kTurnSteps);
    return straight ? length : 0.5 * length + 0.5 * turned[i] / turned.back();
  };
  std::vector<double> out = {from};
  std::size_t i = 0;
  for (std::size_t j = 1; j + 1 < kMarks; ++j) {
    const double wanted = static_cast<double>(j) / (kMarks - 1);
    while (i + 1 < kTurnSteps && share(i + 1) < wanted) ++i;
    const double part = (wanted - share(i)) / (share(i + 1) - share(i));
    out.push_back(at(i) + part * (at(i + 1) - at(i)));
  }
  out.push_back(to);
  return out;
}

Result<std::vector<std::vector<double>>> marks_of_least_bending(
    const std::vector<MeasuredSection>& sections, const std::vector<std::vector<double>>& ends,
    const RunContext& run) {
  SharedLines lines(sections, ends);
  OBVID_TRY(lines.least(1, kSmoothTwist, run));
  OBVID_TRY(lines.least(2, kSmoothBending, run));
  return lines.marks();
}

}  // namespace obvid
