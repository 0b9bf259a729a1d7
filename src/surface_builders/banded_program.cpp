// SPDX-License-Identifier: Apache-2.0
#include "banded_program.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "banded_halves.h"
#include "obvid/core/internal/parallel.h"
#include "obvid/numeric/internal/banded_cholesky.h"

namespace obvid {
namespace {

using Form = FormGroup::Form;

constexpr int kMostIterations = 45;
/// Complementarity where the steps end: shares of a box of 1.
constexpr double kSolved = 1e-2;
constexpr double kBegin = 1.0;
/// A step goes this far towards the nearest bound.
constexpr double kStep = 0.95;
/// Of a whole step: shorter ones move nothing that shows in a box of 1.
constexpr double kShortestStep = 1e-6;
/// Rows that a group sees.
constexpr std::size_t kSeen = std::tuple_size_v<decltype(FormGroup::share)>;

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
/// What the two products of a bound, or of a box, are aimed at: over and dual, missing and the rest
/// of the dual; both distances in the box and their duals.
using Aims = std::array<double, 2>;

class Steps {
 public:
  explicit Steps(const BandedProgram& program)
      : p_(program),
        x_(p_.rows * p_.columns, 0.0),
        right_(x_.size(), 0.0),
        width_(widths(p_)),
        order_(orders(p_, *std::max_element(width_.begin(), width_.end()))),
        matrix_(x_.size(), order_.band),
        quadratic_(matrix_),
        seen_by_(p_.rows),
        part_(p_.groups.size()),
        length_(p_.groups.size()),
        soft_(p_.groups.size()),
        soft_step_(p_.groups.size()),
        box_(p_.groups.size()),
        box_step_(p_.groups.size()),
        soft_aim_(p_.groups.size()),
        box_aim_(p_.groups.size()) {
    for (std::size_t k = 0; k < p_.groups.size(); ++k) {
      const FormGroup& g = p_.groups[k];
      for (std::size_t a = 0; a < seen(g); ++a) seen_by_[g.first_row + a].push_back(k);
      for (const Form& f : g.at_least) {
        const double root = std::hypot(f.wanted, 2.0 * kBegin);
        State s{(root - f.wanted) / 2.0, (root + f.wanted) / 2.0, 0.0};
        s.dual = f.weight * s.missing / (s.over + s.missing);
        soft_[k].push_back(s);
      }
      for (const Form& f : g.box) box_[k].push_back({kBegin / f.wanted, kBegin / f.wanted});
      soft_aim_[k].resize(g.at_least.size());
      soft_step_[k].resize(g.at_least.size());
      box_aim_[k].resize(g.box.size());
      box_step_[k].resize(g.box.size());
    }
  }

  /// The squares of the aim, which stay. Error: E103.
  [[nodiscard]] Result<void> begin(const RunContext& run) {
    OBVID_TRY(in_parallel(part_.size(), run, [&](std::size_t k) {
      Part& part = part_[k];
      part.square.assign(p_.groups[k].near.empty() ? 0 : p_.columns * width_[k], 0.0);
      for (const Form& f : p_.groups[k].near) add_square(f, f.weight, width_[k], part.square);
    }));
    return in_parallel(p_.rows, run, [&](std::size_t a) {
      for (const std::size_t k : seen_by_[a]) add_to(quadratic_, k, a);
    });
  }

  /// One step with a corrector (Mehrotra, SIAM J. Optim. 2 (1992)): how far a step towards no
  /// complementarity at all would come says what to aim at, and what it leaves out of the products
  /// is put right, with the same factors. False: at the end. Error: E103.
  [[nodiscard]] Result<bool> step(const RunContext& run) {
    const double mean = complementarity(0.0);
    if (!(mean > kSolved)) return false;
    aim_at(0.0, false);
    OBVID_TRY(assemble(run));
    BandedHalves factors(matrix_);
    const auto factored = factors.factor(run);
    OBVID_TRY(factored);
    if (!*factored) return false;
    auto length = steps_by(factors.solve(right_), run);
    OBVID_TRY(length);
    const double left = complementarity(*length) / mean;
    aim_at(left * left * left * mean, true);
    OBVID_TRY(pull(run));
    length = steps_by(factors.solve(right_), run);
    OBVID_TRY(length);
    // where the corrected step is short, one towards the middle comes farther
    constexpr double kShort = 0.3, kCentred = 0.5;
    if (p_.centred && *length < kShort) {
      aim_at(kCentred * mean, false);
      OBVID_TRY(pull(run));
      length = steps_by(factors.solve(right_), run);
      OBVID_TRY(length);
    }
    for (const double d : dx_) {
      if (!std::isfinite(d)) return false;
    }
    move(*length);
    return *length > kShortestStep;
  }

  /// Duals of the boxes such that all products are about alike.
  void centre() {
    double sum = 0.0, many = 0.0;
    for (std::size_t k = 0; k < p_.groups.size(); ++k) {
      for (std::size_t i = 0; i < soft_[k].size(); ++i) {
        sum += soft_[k][i].over * soft_[k][i].dual;
        many += 1.0;
      }
    }
    if (!(many > 0.0)) return;
    for (std::size_t k = 0; k < p_.groups.size(); ++k) {
      for (std::size_t i = 0; i < box_[k].size(); ++i) {
        const double dual = sum / many / p_.groups[k].box[i].wanted;
        box_[k][i] = {dual, dual};
      }
    }
  }

  [[nodiscard]] std::vector<double> take() const {
    std::vector<double> out(x_.size());
    for (std::size_t a = 0; a < p_.rows; ++a) {
      for (std::size_t i = 0; i < p_.columns; ++i) out[a * p_.columns + i] = x_[order_.at(a, i)];
    }
    return out;
  }

 private:
  /// What one group adds to Newton's step: a symmetric band over one row of unknowns, entries
  /// [i][j - i], and the right side.
  struct Part {
    std::vector<double> square, pull;
  };
  [[nodiscard]] static std::vector<std::size_t> widths(const BandedProgram& program) {
    std::vector<std::size_t> out;
    for (const FormGroup& g : program.groups) {
      std::size_t most = 1;
      for (const auto* list : {&g.near, &g.at_least, &g.box}) {
        for (const Form& f : *list) most = std::max(most, f.coefficient.size());
      }
      out.push_back(most);
    }
    return out;
  }
  /// Place of the unknown of a row and a column in the system.
  struct Order {
    std::size_t of_row, of_column, band;
    [[nodiscard]] std::size_t at(std::size_t row, std::size_t column) const {
      return row * of_row + column * of_column;
    }
  };
  /// Row after row, or column after column where that makes the band narrower.
  [[nodiscard]] static Order orders(const BandedProgram& program, std::size_t width) {
    const Order by_rows{program.columns, 1, (kSeen - 1) * program.columns + width - 1};
    const Order by_columns{1, program.rows, (width - 1) * program.rows + kSeen - 1};
    return program.centred && by_columns.band < by_rows.band ? by_columns : by_rows;
  }
  [[nodiscard]] std::size_t seen(const FormGroup& g) const {
    return std::min<std::size_t>(kSeen, p_.rows - g.first_row);
  }
  static void add_square(const Form& f, double weight, std::size_t width,
                         std::vector<double>& square) {
    const std::size_t n = f.coefficient.size();
    for (std::size_t i = 0; i < n; ++i) {
      double* row = square.data() + (f.first_column + i) * width;
      const double factor = weight * f.coefficient[i];
      for (std::size_t j = i; j < n; ++j) row[j - i] += factor * f.coefficient[j];
    }
  }
  /// The square of group k into the entries of one of the rows it sees.
  void add_to(BandedCholesky& matrix, std::size_t k, std::size_t a) const {
    const FormGroup& g = p_.groups[k];
    const std::vector<double>& square = part_[k].square;
    if (square.empty()) return;
    const std::size_t width = width_[k];
    for (std::size_t b = a; b < g.first_row + seen(g); ++b) {
      const double share = g.share[a - g.first_row] * g.share[b - g.first_row];
      if (share == 0.0) continue;
      for (std::size_t i = 0; i < p_.columns; ++i) {
        const double* from = square.data() + i * width;
        const std::size_t many = std::min(width, p_.columns - i);
        const std::size_t here = order_.at(a, i), there = order_.at(b, i);
        double* row = matrix.row(here) + (there - here);
        for (std::size_t d = 0; d < many; ++d) row[d * order_.of_column] += share * from[d];
        if (a == b) continue;
        // the other half of the symmetric square: row b before column i + d of row a
        for (std::size_t d = 1; d < many; ++d) {
          const std::size_t one = order_.at(a, i + d), first = std::min(one, there);
          matrix.row(first)[std::max(one, there) - first] += share * from[d];
        }
      }
    }
  }
  [[nodiscard]] std::vector<double> combined(const FormGroup& g,
                                             const std::vector<double>& x) const {
    std::vector<double> y(p_.columns, 0.0);
    for (std::size_t a = 0; a < seen(g); ++a) {
      const double* row = x.data() + order_.at(g.first_row + a, 0);
      for (std::size_t i = 0; i < p_.columns; ++i) y[i] += g.share[a] * row[i * order_.of_column];
    }
    return y;
  }

  /// Mean of all products when everything has gone so far along its step.
  [[nodiscard]] double complementarity(double part) const {
    double sum = 0.0, many = 0.0;
    for (std::size_t k = 0; k < p_.groups.size(); ++k) {
      const FormGroup& g = p_.groups[k];
      if (g.at_least.empty() && g.box.empty()) continue;
      const std::vector<double> y = combined(g, x_);
      const std::vector<double> dy = part > 0.0 ? combined(g, dx_) : y;
      for (std::size_t i = 0; i < g.at_least.size(); ++i) {
        const State &s = soft_[k][i], &d = soft_step_[k][i];
        const double dual = s.dual + part * d.dual;
        sum += (s.over + part * d.over) * dual +
               (s.missing + part * d.missing) * (g.at_least[i].weight - dual);
      }
      for (std::size_t i = 0; i < g.box.size(); ++i) {
        const double q = value(g.box[i], y) + part * value(g.box[i], dy), half = g.box[i].wanted;
        const BoxState &s = box_[k][i], &d = box_step_[k][i];
        sum += (half - q) * (s.upper + part * d.upper) + (half + q) * (s.lower + part * d.lower);
      }
      many += static_cast<double>(2 * (g.at_least.size() + g.box.size()));
    }
    return many > 0.0 ? sum / many : 0.0;
  }

  /// What all products are aimed at; less what the step at hand leaves out of them.
  void aim_at(double aim, bool corrected) {
    const double part = corrected ? 1.0 : 0.0;
    for (std::size_t k = 0; k < p_.groups.size(); ++k) {
      const FormGroup& g = p_.groups[k];
      for (std::size_t i = 0; i < g.at_least.size(); ++i) {
        const State& d = soft_step_[k][i];
        soft_aim_[k][i] = {aim - part * d.over * d.dual, aim + part * d.missing * d.dual};
      }
      if (g.box.empty()) continue;
      const std::vector<double> dy = corrected ? combined(g, dx_) : std::vector<double>{};
      for (std::size_t i = 0; i < g.box.size(); ++i) {
        const double dq = corrected ? value(g.box[i], dy) : 0.0;
        const BoxState& d = box_step_[k][i];
        box_aim_[k][i] = {aim + dq * d.upper, aim - dq * d.lower};
      }
    }
  }

  /// Matrix and right side of Newton's step towards the aims. Error: E103.
  [[nodiscard]] Result<void> assemble(const RunContext& run) {
    OBVID_TRY(in_parallel(part_.size(), run, [&](std::size_t k) { square_of(k); }));
    OBVID_TRY(in_parallel(p_.rows, run, [&](std::size_t a) {
      for (std::size_t i = 0; i < p_.columns; ++i) {
        const std::size_t at = order_.at(a, i);
        std::copy_n(quadratic_.row(at), quadratic_.band() + 1, matrix_.row(at));
      }
    }));
    // each entry belongs to one pair of rows; column after column, it may stand in a row of another
    OBVID_TRY(in_parallel(p_.rows, run, [&](std::size_t a) {
      for (const std::size_t k : seen_by_[a]) add_to(matrix_, k, a);
    }));
    double largest = 0.0;
    for (std::size_t i = 0; i < x_.size(); ++i) largest = std::max(largest, matrix_.row(i)[0]);
    constexpr double kRegular = 1e-13;  // of the largest entry: what no form sees stays where it is
    for (std::size_t i = 0; i < x_.size(); ++i) matrix_.row(i)[0] += kRegular * largest;
    return pull(run);
  }
  /// Right side alone. Error: E103.
  [[nodiscard]] Result<void> pull(const RunContext& run) {
    OBVID_TRY(in_parallel(part_.size(), run, [&](std::size_t k) { pull_of(k); }));
    std::fill(right_.begin(), right_.end(), 0.0);
    for (std::size_t k = 0; k < part_.size(); ++k) {
      const FormGroup& g = p_.groups[k];
      for (std::size_t a = 0; a < seen(g); ++a) {
        double* row = right_.data() + order_.at(g.first_row + a, 0);
        for (std::size_t i = 0; i < p_.columns; ++i) {
          row[i * order_.of_column] += g.share[a] * part_[k].pull[i];
        }
      }
    }
    return {};
  }
  void square_of(std::size_t k) {
    const FormGroup& g = p_.groups[k];
    std::vector<double>& square = part_[k].square;
    square.assign(g.at_least.empty() && g.box.empty() ? 0 : p_.columns * width_[k], 0.0);
    const std::vector<double> y = combined(g, x_);
    for (std::size_t i = 0; i < g.at_least.size(); ++i) {
      const Form& f = g.at_least[i];
      add_square(f, 1.0 / stiffness(f, soft_[k][i]), width_[k], square);
    }
    for (std::size_t i = 0; i < g.box.size(); ++i) {
      const Form& f = g.box[i];
      const double q = value(f, y);
      add_square(f, box_[k][i].upper / (f.wanted - q) + box_[k][i].lower / (f.wanted + q),
                 width_[k], square);
    }
  }
  void pull_of(std::size_t k) {
    const FormGroup& g = p_.groups[k];
    const std::vector<double> y = combined(g, x_);
    std::vector<double>& pull = part_[k].pull;
    pull.assign(p_.columns, 0.0);
    for (const Form& f : g.near) add(f, -f.weight * (value(f, y) - f.wanted), pull);
    for (std::size_t i = 0; i < g.at_least.size(); ++i) {
      const Form& f = g.at_least[i];
      const State& s = soft_[k][i];
      add(f, s.dual + off(f, s, value(f, y), soft_aim_[k][i]) / stiffness(f, s), pull);
    }
    for (std::size_t i = 0; i < g.box.size(); ++i) {
      const Form& f = g.box[i];
      const double q = value(f, y);
      const Aims& aim = box_aim_[k][i];
      add(f, aim[1] / (f.wanted + q) - aim[0] / (f.wanted - q), pull);
    }
  }
  static double stiffness(const Form& f, const State& s) {
    return s.over / s.dual + s.missing / (f.weight - s.dual);
  }
  static double off(const Form& f, const State& s, double q, const Aims& aim) {
    return (aim[0] / s.dual - s.over) - (aim[1] / (f.weight - s.dual) - s.missing) -
           (q - f.wanted - s.over + s.missing);
  }

  /// Steps of everything by one of the unknowns; returns how far they may be gone such that all
  /// that is positive stays so. Error: E103.
  [[nodiscard]] Result<double> steps_by(std::vector<double> dx, const RunContext& run) {
    dx_ = std::move(dx);
    OBVID_TRY(in_parallel(part_.size(), run, [&](std::size_t k) { step_of(k); }));
    return *std::min_element(length_.begin(), length_.end());
  }
  void step_of(std::size_t k) {
    const FormGroup& g = p_.groups[k];
    double length = 1.0;
    const auto limit = [&](double at, double by) {
      if (by < 0.0) length = std::min(length, -kStep * at / by);
    };
    const std::vector<double> y = combined(g, x_), dy = combined(g, dx_);
    for (std::size_t i = 0; i < g.at_least.size(); ++i) {
      const Form& f = g.at_least[i];
      const State& s = soft_[k][i];
      const Aims& aim = soft_aim_[k][i];
      const double rest = f.weight - s.dual;
      State& d = soft_step_[k][i];
      d.dual = (off(f, s, value(f, y), aim) - value(f, dy)) / stiffness(f, s);
      d.over = aim[0] / s.dual - s.over - s.over / s.dual * d.dual;
      d.missing = aim[1] / rest - s.missing + s.missing / rest * d.dual;
      limit(s.over, d.over);
      limit(s.missing, d.missing);
      limit(s.dual, d.dual);
      limit(rest, -d.dual);
    }
    for (std::size_t i = 0; i < g.box.size(); ++i) {
      const Form& f = g.box[i];
      const BoxState& s = box_[k][i];
      const Aims& aim = box_aim_[k][i];
      const double q = value(f, y), dq = value(f, dy), up = f.wanted - q, down = f.wanted + q;
      BoxState& d = box_step_[k][i];
      d = {aim[0] / up - s.upper + s.upper / up * dq,
           aim[1] / down - s.lower - s.lower / down * dq};
      limit(up, -dq);
      limit(down, dq);
      limit(s.upper, d.upper);
      limit(s.lower, d.lower);
    }
    length_[k] = length;
  }
  void move(double length) {
    for (std::size_t i = 0; i < x_.size(); ++i) x_[i] += length * dx_[i];
    for (std::size_t k = 0; k < part_.size(); ++k) {
      for (std::size_t i = 0; i < soft_[k].size(); ++i) {
        soft_[k][i].over += length * soft_step_[k][i].over;
        soft_[k][i].missing += length * soft_step_[k][i].missing;
        soft_[k][i].dual += length * soft_step_[k][i].dual;
      }
      for (std::size_t i = 0; i < box_[k].size(); ++i) {
        box_[k][i].upper += length * box_step_[k][i].upper;
        box_[k][i].lower += length * box_step_[k][i].lower;
      }
    }
  }

  const BandedProgram& p_;
  std::vector<double> x_, right_, dx_;
  std::vector<std::size_t> width_;  ///< of each group: the longest of its forms
  Order order_;
  BandedCholesky matrix_, quadratic_;
  std::vector<std::vector<std::size_t>> seen_by_;  ///< of each row: the groups that see it
  std::vector<Part> part_;
  std::vector<double> length_;  ///< of each group: how far its step may be gone
  std::vector<std::vector<State>> soft_, soft_step_;
  std::vector<std::vector<BoxState>> box_, box_step_;
  std::vector<std::vector<Aims>> soft_aim_, box_aim_;
};

}  // namespace

Result<std::vector<double>> solved(const BandedProgram& program, const RunContext& run, double from,
                                   double to) {
  Steps steps(program);
  if (program.centred) steps.centre();
  OBVID_TRY(steps.begin(run));
  for (int k = 0; k < kMostIterations; ++k) {
    OBVID_TRY(tell(run, "fairing across", from + (to - from) * k / kMostIterations));
    const auto goes_on = steps.step(run);
    OBVID_TRY(goes_on);
    if (!*goes_on) break;
  }
  return steps.take();
}

}  // namespace obvid
