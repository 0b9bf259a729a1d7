// SPDX-License-Identifier: Apache-2.0
#include "banded_program.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace obvid {
namespace {

using Form = FormGroup::Form;

constexpr int kMostIterations = 45;
/// Complementarity where the steps end: shares of a box of 1.
constexpr double kSolved = 1e-2;
constexpr double kBegin = 1.0;
/// A step goes this far towards the nearest bound.
constexpr double kStep = 0.95;

/// Symmetric positive definite, factored in place: entries right of the diagonal, row by row.
class BandedSquare {
 public:
  BandedSquare(std::size_t n, std::size_t beside)
      : n_(n), width_(beside + 1), entry_(n * width_, 0.0) {}

  void clear() { std::fill(entry_.begin(), entry_.end(), 0.0); }
  /// Entries (i, i), (i, i + 1), ...
  [[nodiscard]] double* row(std::size_t i) { return entry_.data() + i * width_; }

  void factor() {
    for (std::size_t k = 0; k < n_; ++k) {
      const double* from = row(k);
      const std::size_t last = std::min(width_, n_ - k);
      for (std::size_t i = 1; i < last; ++i) {
        const double share = from[i] / from[0];
        if (share == 0.0) continue;
        double* to = row(k + i);
        for (std::size_t j = i; j < last; ++j) to[j - i] -= share * from[j];
      }
    }
  }
  void solve(std::vector<double>& x) {
    for (std::size_t k = 0; k < n_; ++k) {
      const double* from = row(k);
      const std::size_t last = std::min(width_, n_ - k);
      const double share = x[k] / from[0];
      for (std::size_t j = 1; j < last; ++j) x[k + j] -= share * from[j];
    }
    for (std::size_t k = n_; k-- > 0;) {
      const double* from = row(k);
      const std::size_t last = std::min(width_, n_ - k);
      double sum = x[k];
      for (std::size_t j = 1; j < last; ++j) sum -= from[j] * x[k + j];
      x[k] = sum / from[0];
    }
  }

 private:
  std::size_t n_, width_;
  std::vector<double> entry_;
};

double value(const Form& form, const std::vector<double>& y) {
  double sum = 0.0;
  const double* at = y.data() + form.first_column;
  for (std::size_t k = 0; k < form.coefficient.size(); ++k) sum += form.coefficient[k] * at[k];
  return sum;
}

void add(const Form& form, double factor, std::vector<double>& y) {
  double* at = y.data() + form.first_column;
  for (std::size_t k = 0; k < form.coefficient.size(); ++k) at[k] += factor * form.coefficient[k];
}

/// What belongs to a soft bound (over, short of it, its dual) or a box (two duals).
struct State {
  double over = 0.0, missing = 0.0, dual = 0.0;
};
struct BoxState {
  double upper = 0.0, lower = 0.0;
};

class Steps {
 public:
  explicit Steps(const BandedProgram& program)
      : p_(program),
        x_(p_.rows * p_.columns, 0.0),
        matrix_(x_.size(), 3 * p_.columns + widest() - 1),
        quadratic_(x_.size(), 3 * p_.columns + widest() - 1) {
    for (const FormGroup& g : p_.groups) {
      Square square = square_of();
      for (const Form& f : g.near) add_square(f, f.weight, square);
      if (!g.near.empty()) add_to(quadratic_, g, square);
      auto& soft = soft_.emplace_back();
      for (const Form& f : g.at_least) {
        const double root = std::hypot(f.wanted, 2.0 * kBegin);
        State s{(root - f.wanted) / 2.0, (root + f.wanted) / 2.0, 0.0};
        s.dual = f.weight * s.missing / (s.over + s.missing);
        soft.push_back(s);
      }
      auto& box = box_.emplace_back();
      for (const Form& f : g.box) box.push_back({kBegin / f.wanted, kBegin / f.wanted});
    }
  }

  /// False: at the end.
  bool step() {
    const double mean = complementarity();
    if (!(mean > kSolved)) return false;
    const double aim = 0.15 * mean;
    assemble(aim);
    matrix_.factor();
    std::vector<double> dx = right_;
    matrix_.solve(dx);
    for (const double d : dx) {
      if (!std::isfinite(d)) return false;
    }
    const double length = move_duals(dx, aim);
    for (std::size_t i = 0; i < x_.size(); ++i) x_[i] += length * dx[i];
    return length > 1e-6;
  }

  [[nodiscard]] std::vector<double> take() { return std::move(x_); }

 private:
  /// Symmetric band of one row of unknowns.
  struct Square {
    std::size_t width = 0;
    std::vector<double> entry;  ///< [i][j - i]
  };
  [[nodiscard]] std::size_t widest() const {
    std::size_t most = 1;
    for (const FormGroup& g : p_.groups) {
      for (const auto* list : {&g.near, &g.at_least, &g.box}) {
        for (const Form& f : *list) most = std::max(most, f.coefficient.size());
      }
    }
    return most;
  }
  [[nodiscard]] Square square_of() const {
    const std::size_t width = widest();
    return {width, std::vector<double>(p_.columns * width, 0.0)};
  }
  static void add_square(const Form& f, double weight, Square& s) {
    const std::size_t n = f.coefficient.size();
    for (std::size_t i = 0; i < n; ++i) {
      double* row = s.entry.data() + (f.first_column + i) * s.width;
      const double factor = weight * f.coefficient[i];
      for (std::size_t j = i; j < n; ++j) row[j - i] += factor * f.coefficient[j];
    }
  }
  /// Into the rows that the group sees.
  void add_to(BandedSquare& matrix, const FormGroup& g, const Square& s) const {
    const std::size_t seen = std::min<std::size_t>(4, p_.rows - g.first_row);
    for (std::size_t a = 0; a < seen; ++a) {
      for (std::size_t b = a; b < seen; ++b) {
        const double share = g.share[a] * g.share[b];
        if (share == 0.0) continue;
        const std::size_t offset = (b - a) * p_.columns;
        for (std::size_t i = 0; i < p_.columns; ++i) {
          double* row = matrix.row((g.first_row + a) * p_.columns + i) + offset;
          const double* from = s.entry.data() + i * s.width;
          const std::size_t many = std::min(s.width, p_.columns - i);
          for (std::size_t d = 0; d < many; ++d) row[d] += share * from[d];
          if (a == b) continue;
          // the other half of the symmetric square stands left of its diagonal
          for (std::size_t d = 1; d < many; ++d) {
            matrix.row((g.first_row + a) * p_.columns + i + d)[offset - d] += share * from[d];
          }
        }
      }
    }
  }
  [[nodiscard]] std::vector<double> combined(const FormGroup& g,
                                             const std::vector<double>& x) const {
    std::vector<double> y(p_.columns, 0.0);
    const std::size_t seen = std::min<std::size_t>(4, p_.rows - g.first_row);
    for (std::size_t a = 0; a < seen; ++a) {
      const double* row = x.data() + (g.first_row + a) * p_.columns;
      for (std::size_t i = 0; i < p_.columns; ++i) y[i] += g.share[a] * row[i];
    }
    return y;
  }
  void spread(const FormGroup& g, const std::vector<double>& y, std::vector<double>& x) const {
    const std::size_t seen = std::min<std::size_t>(4, p_.rows - g.first_row);
    for (std::size_t a = 0; a < seen; ++a) {
      double* row = x.data() + (g.first_row + a) * p_.columns;
      for (std::size_t i = 0; i < p_.columns; ++i) row[i] += g.share[a] * y[i];
    }
  }

  [[nodiscard]] double complementarity() const {
    double sum = 0.0, many = 0.0;
    for (std::size_t k = 0; k < p_.groups.size(); ++k) {
      const FormGroup& g = p_.groups[k];
      const std::vector<double> y = combined(g, x_);
      for (std::size_t i = 0; i < g.at_least.size(); ++i) {
        const State& s = soft_[k][i];
        sum += s.over * s.dual + s.missing * (g.at_least[i].weight - s.dual);
      }
      for (std::size_t i = 0; i < g.box.size(); ++i) {
        const double q = value(g.box[i], y), half = g.box[i].wanted;
        sum += (half - q) * box_[k][i].upper + (half + q) * box_[k][i].lower;
      }
      many += static_cast<double>(2 * (g.at_least.size() + g.box.size()));
    }
    return many > 0.0 ? sum / many : 0.0;
  }

  /// Matrix and right side of Newton's step towards complementarity `aim`.
  void assemble(double aim) {
    matrix_ = quadratic_;
    right_.assign(x_.size(), 0.0);
    for (std::size_t k = 0; k < p_.groups.size(); ++k) {
      const FormGroup& g = p_.groups[k];
      const std::vector<double> y = combined(g, x_);
      std::vector<double> pull(p_.columns, 0.0);
      for (const Form& f : g.near) add(f, -f.weight * (value(f, y) - f.wanted), pull);
      if (!g.at_least.empty() || !g.box.empty()) {
        Square square = square_of();
        for (std::size_t i = 0; i < g.at_least.size(); ++i) {
          const Form& f = g.at_least[i];
          const State& s = soft_[k][i];
          const auto [stiff, e] = newton(f, s, value(f, y), aim);
          add_square(f, 1.0 / stiff, square);
          add(f, s.dual + e / stiff, pull);
        }
        for (std::size_t i = 0; i < g.box.size(); ++i) {
          const Form& f = g.box[i];
          const BoxState& s = box_[k][i];
          const double q = value(f, y), up = f.wanted - q, down = f.wanted + q;
          add_square(f, s.upper / up + s.lower / down, square);
          add(f, aim / down - aim / up, pull);
        }
        add_to(matrix_, g, square);
      }
      spread(g, pull, right_);
    }
    double largest = 0.0;
    for (std::size_t i = 0; i < x_.size(); ++i) largest = std::max(largest, matrix_.row(i)[0]);
    constexpr double kRegular = 1e-13;  // of the largest entry: what no form sees stays where it is
    for (std::size_t i = 0; i < x_.size(); ++i) matrix_.row(i)[0] += kRegular * largest;
  }
  struct Newton {
    double stiff, e;
  };
  static Newton newton(const Form& f, const State& s, double q, double aim) {
    const double rest = f.weight - s.dual;
    const double off = q - f.wanted - s.over + s.missing;
    return {s.over / s.dual + s.missing / rest,
            (aim / s.dual - s.over) - (aim / rest - s.missing) - off};
  }

  /// Duals go along as far as they and all slacks stay positive; returns that length.
  double move_duals(const std::vector<double>& dx, double aim) {
    std::vector<std::vector<State>> soft_step(soft_.size());
    std::vector<std::vector<BoxState>> box_step(box_.size());
    double length = 1.0;
    const auto limit = [&](double at, double by) {
      if (by < 0.0) length = std::min(length, -kStep * at / by);
    };
    for (std::size_t k = 0; k < p_.groups.size(); ++k) {
      const FormGroup& g = p_.groups[k];
      if (g.at_least.empty() && g.box.empty()) continue;
      const std::vector<double> y = combined(g, x_), dy = combined(g, dx);
      for (std::size_t i = 0; i < g.at_least.size(); ++i) {
        const Form& f = g.at_least[i];
        const State& s = soft_[k][i];
        const auto [stiff, e] = newton(f, s, value(f, y), aim);
        const double rest = f.weight - s.dual;
        State d;
        d.dual = (e - value(f, dy)) / stiff;
        d.over = aim / s.dual - s.over - s.over / s.dual * d.dual;
        d.missing = aim / rest - s.missing + s.missing / rest * d.dual;
        limit(s.over, d.over);
        limit(s.missing, d.missing);
        limit(s.dual, d.dual);
        limit(rest, -d.dual);
        soft_step[k].push_back(d);
      }
      for (std::size_t i = 0; i < g.box.size(); ++i) {
        const Form& f = g.box[i];
        const BoxState& s = box_[k][i];
        const double q = value(f, y), dq = value(f, dy), up = f.wanted - q, down = f.wanted + q;
        const BoxState d{aim / up - s.upper + s.upper / up * dq,
                         aim / down - s.lower - s.lower / down * dq};
        limit(up, -dq);
        limit(down, dq);
        limit(s.upper, d.upper);
        limit(s.lower, d.lower);
        box_step[k].push_back(d);
      }
    }
    for (std::size_t k = 0; k < p_.groups.size(); ++k) {
      for (std::size_t i = 0; i < soft_step[k].size(); ++i) {
        soft_[k][i].over += length * soft_step[k][i].over;
        soft_[k][i].missing += length * soft_step[k][i].missing;
        soft_[k][i].dual += length * soft_step[k][i].dual;
      }
      for (std::size_t i = 0; i < box_step[k].size(); ++i) {
        box_[k][i].upper += length * box_step[k][i].upper;
        box_[k][i].lower += length * box_step[k][i].lower;
      }
    }
    return length;
  }

  const BandedProgram& p_;
  std::vector<double> x_, right_;
  BandedSquare matrix_, quadratic_;
  std::vector<std::vector<State>> soft_;
  std::vector<std::vector<BoxState>> box_;
};

}  // namespace

Result<std::vector<double>> solved(const BandedProgram& program, const RunContext& run, double from,
                                   double to) {
  Steps steps(program);
  for (int k = 0; k < kMostIterations; ++k) {
    OBVID_TRY(tell(run, "fairing across", from + (to - from) * k / kMostIterations));
    if (!steps.step()) break;
  }
  return steps.take();
}

}  // namespace obvid
