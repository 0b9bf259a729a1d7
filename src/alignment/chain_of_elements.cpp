// SPDX-License-Identifier: Apache-2.0
#include "chain_of_elements.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "obvid/alignment/internal/transition_law.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/numeric/internal/banded.h"
#include "obvid/numeric/internal/gauss.h"
#include "winding.h"

namespace obvid::alignment {
namespace {

constexpr int kSteps = 30;  ///< of Levenberg and Marquardt's method, for each power
/// Of the offsets, summed: the higher, the nearer is the least sum to the least largest offset.
constexpr double kPowers[] = {4.0, 8.0, 16.0, 32.0, 64.0};
constexpr double kClosed = 1e-9;      ///< of the tolerance: a gap that counts as none
constexpr double kLeastShare = 1e-3;  ///< of the largest offset: what weighs at least
/// Of the tolerance, or of the largest offset where that is more: a gap that steps may leave, on
/// the way.
constexpr double kLoose = 0.1;
constexpr double kCloser = 0.7;      ///< a gap has to become this share of itself
constexpr int kClosing = 40;         ///< steps that close what is left, at the most
constexpr double kRounding = 1e-13;  ///< of the size: what rounding makes of a gap
constexpr double kSettled = 1e-9;    ///< growth of the fit, of itself, at which it is done
/// Likewise for higher powers: the largest offset changes by a share of it.
constexpr double kSettledPower = 1e-5;
/// Of offsets over tolerances: a mean of higher powers that is least leaves one that is larger, and
/// steps that ended early are not farther from the least.
constexpr double kHopelessMean = 1.02;
constexpr double kAtTheLeast = 1e-3;  ///< of the least length: what is no longer is held there
constexpr double kShorter = 0.5;      ///< of what it is longer than the least: lost in one step
constexpr double kTurn = 0.3;         ///< rad: an element turns by no more in one step
/// Of the scaled normal equations: at first, before the search gives up, so that they can be
/// solved, so that they are solved exactly enough for steps that close gaps.
constexpr double kDampingStart = 1e-6, kDampingMost = 1e6, kDampingLeast = 1e-12,
                 kDampingClosing = 1.0;
/// Of a condition's row, squared: what others leave of it is rounding.
constexpr double kSameCondition = 1e-22;

std::vector<TransitionLaw> laws_of(const Chain& chain) {
  std::vector<TransitionLaw> out;
  out.reserve(chain.size());
  for (std::size_t k = 0; k < chain.size(); ++k) {
    out.emplace_back(chain.law[k], chain.curvature(k, 0), chain.curvature(k, 1), chain.length[k]);
  }
  return out;
}

/// Element at s behind the start of element k.
Element place_on(const Chain& chain, const std::vector<TransitionLaw>& laws,
                 const std::vector<Element>& joints, std::size_t k, double s) {
  const double k0 = chain.curvature(k, 0), k1 = chain.curvature(k, 1);
  const Element start{joints[k].point, joints[k].theta, k0};
  if (chain.law[k] != Transition::kClothoid) {
    return transition_at(laws[k], start, k1, chain.length[k], s);
  }
  return element_behind(chain.plane, start, (k1 - k0) / chain.length[k], s);
}

/// Derivatives of the point and heading at a place on an element by its own numbers.
struct OwnDerivatives {
  Vec2 kappa0, kappa1, length;
  double theta_kappa0 = 0.0, theta_kappa1 = 0.0, theta_length = 0.0;
};

/// These of one element, from its start on: integrals that go on where the place before ended. The
/// law of a cubic parabola is held: what its own change adds is smaller by the square of its
/// turning.
class DerivativesAlong {
 public:
  DerivativesAlong(Plane plane, const TransitionLaw& law, double theta, double k0, double k1,
                   double length)
      : plane_(plane), law_(law), theta_(theta), k0_(k0), k1_(k1), length_(length) {}

  /// `s` in [0, length]; cheap where it lies behind the last one.
  OwnDerivatives at(double s) {
    if (s < s_) {
      s_ = 0.0;
      sum_ = {};
    }
    go_on_to(s);
    OwnDerivatives out = sum_;
    const auto [square, stretched] = of_law(s);
    out.theta_kappa0 = s - square;
    out.theta_kappa1 = square;
    out.theta_length = -(k1_ - k0_) * stretched;
    return out;
  }

  /// At the end, which moves on as the element grows.
  OwnDerivatives at_end() {
    OwnDerivatives out = at(length_);
    out.length =
        out.length + forward(plane_, theta_ + k0_ * length_ + (k1_ - k0_) * of_law(length_).square);
    out.theta_length += k1_;
    return out;
  }

 private:
  static constexpr std::size_t kNodes = 4;
  static constexpr double kTurnOfPart = 0.5;  ///< rad: four nodes are exact to 1e-11 up to here
  /// Parts of an element whose law waves, or has a corner in its middle; of a cubic parabola.
  static constexpr double kPartsOfLaw = 16.0, kPartsOfCubic = 2.0;

  /// Parts that the law asks for, of a whole element.
  [[nodiscard]] double parts_of_law() const {
    if (law_.is_linear()) return 0.0;
    return law_.kind() == Transition::kCubic ? kPartsOfCubic : kPartsOfLaw;
  }

  /// What the heading changes by with the end's curvature, and what that does as the element grows.
  struct OfLaw {
    double square, stretched;
  };
  [[nodiscard]] OfLaw of_law(double u) const {
    if (law_.is_linear()) {
      const double square = u * u / (2.0 * length_);
      return {square, square / length_};
    }
    const TransitionLaw::Place place = law_.at(u / length_);
    return {length_ * place.turn, u / length_ * place.share - place.turn};
  }

  void go_on_to(double s) {
    const double way = s - s_;
    if (!(way > 0.0)) return;
    const double turn = (std::abs(k0_) + std::abs(k1_)) * way;
    const int parts = 1 + static_cast<int>(turn / kTurnOfPart + parts_of_law() * way / length_);
    const double h = way / parts;
    for (int part = 0; part < parts; ++part) {
      const double middle = s_ + (part + 0.5) * h;
      for (std::size_t i = 0; i < kNodes; ++i) {
        const double node = GaussRule<kNodes>::kNode[i / 2] * (i % 2 == 0 ? 0.5 : -0.5);
        const double u = middle + node * h;
        const double weight = 0.5 * h * GaussRule<kNodes>::kWeight[i / 2];
        const auto [square, stretched] = of_law(u);
        const Vec2 side = sideways(plane_, theta_ + k0_ * u + (k1_ - k0_) * square);
        sum_.kappa0 = sum_.kappa0 + weight * (u - square) * side;
        sum_.kappa1 = sum_.kappa1 + weight * square * side;
        sum_.length = sum_.length - weight * (k1_ - k0_) * stretched * side;
      }
    }
    s_ = s;
  }

  Plane plane_;
  TransitionLaw law_;
  double theta_, k0_, k1_, length_;
  double s_ = 0.0;
  OwnDerivatives sum_;
};

class Fitter {
 public:
  Fitter(Chain& chain, const std::vector<Vec2>& points, const std::vector<double>& tolerance,
         std::vector<Foot>& feet, const Held& held)
      : chain_(chain), points_(points), tolerance_(tolerance), feet_(feet), held_(held) {
    set_unknowns();
    double size = 0.0;
    for (const double l : chain.length) size += l;
    for (const Vec2 p : points) size = std::max({size, std::abs(p.x), std::abs(p.y)});
    closed_ = kClosed * *std::min_element(tolerance.begin(), tolerance.end()) + kRounding * size;
    const PointRow row{points, tolerance};
    for (std::size_t i = 0; i < row.intervals() && chain.plane == Plane::kMap; ++i) {
      passages_.push_back(passage_of(row, i));
    }
  }

  Fitted run() {
    Fitted out;
    find_feet(chain_, points_, feet_);  // those given may belong to what the chain was before
    if (chain_.plane == Plane::kMap && turning(chain_, feet_) > most_turning(points_.size())) {
      out.squares = out.largest = std::numeric_limits<double>::infinity();
      return out;
    }
    improve(2.0);
    out.squares = objective(2.0);
    out.largest = largest();
    if (!is_closed() || is_cancelled()) {
      out.largest = std::numeric_limits<double>::infinity();
      return out;
    }
    if (out.largest > held_.hopeless) return out;
    Chain best = chain_;
    std::vector<Foot> best_feet = feet_;
    for (const double power : kPowers) {
      if (out.largest <= 1.0) break;
      improve(power);
      if (is_closed() && largest() < out.largest) {
        out.largest = largest();
        best = chain_;
        best_feet = feet_;
      }
      if (mean(power) > kHopelessMean) break;
    }
    chain_ = std::move(best);
    feet_ = std::move(best_feet);
    return out;
  }

  double growth(int a, int b) {
    assemble(2.0);
    BandedMatrix matrix = damped(kDampingLeast);
    if (!matrix.factor()) return std::numeric_limits<double>::infinity();
    std::vector<double> row(unknowns_, 0.0);
    double step = 0.0;
    for (const auto& [number, sign] : {std::pair{a, 1.0}, std::pair{b, -1.0}}) {
      if (number == Chain::kStraight) continue;
      step += sign * chain_.kappa[static_cast<std::size_t>(number)];
      const std::size_t column = column_of(number);
      if (column != kNone) row[column] = sign * scale_[column];
    }
    const std::vector<double> solved = matrix.solve(row);
    double variance = 0.0;
    for (std::size_t k = 0; k < unknowns_; ++k) variance += row[k] * solved[k];
    return variance > 0.0 ? step * step / variance : std::numeric_limits<double>::infinity();
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

  void set_unknowns() {
    std::size_t next = held_.start ? 0 : 3;
    first_length_ = next;
    next += chain_.size();
    column_.assign(chain_.kappa.size(), kNone);
    for (std::size_t k = 0; k < chain_.kappa.size(); ++k) {
      if (std::find(held_.kappa.begin(), held_.kappa.end(), static_cast<int>(k)) ==
          held_.kappa.end()) {
        column_[k] = next++;
      }
    }
    unknowns_ = next;
    set_largest_steps();
  }

  /// What each unknown may change that no point tells anything about: by its whole size.
  void set_largest_steps() {
    double size = 0.0;
    for (const double length : chain_.length) size += length;
    largest_steps_.assign(unknowns_, 1.0 / size);  // curvatures
    if (!held_.start) {
      largest_steps_[0] = largest_steps_[1] = size;
      largest_steps_[2] = 1.0;
    }
    std::fill_n(largest_steps_.begin() + static_cast<std::ptrdiff_t>(first_length_), chain_.size(),
                size);
  }

  [[nodiscard]] bool is_cancelled() const { return held_.cancelled && held_.cancelled(); }

  [[nodiscard]] std::size_t column_of(int kappa) const {
    return kappa == Chain::kStraight ? kNone : column_[static_cast<std::size_t>(kappa)];
  }

  /// Within what steps from there on would undo.
  [[nodiscard]] bool is_closed() const { return gap_of(chain_) <= 10.0 * closed_; }

  [[nodiscard]] double ratio(std::size_t i) const { return feet_[i].offset / tolerance_[i]; }

  [[nodiscard]] double largest() const {
    double out = 0.0;
    for (std::size_t i = 0; i < feet_.size(); ++i) out = std::max(out, std::abs(ratio(i)));
    return out;
  }

  /// Sum of powers of the offsets over the tolerances, and of the squares along at the ends.
  [[nodiscard]] double objective(double power) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < feet_.size(); ++i) {
      sum += power == 2.0 ? ratio(i) * ratio(i) : std::pow(std::abs(ratio(i)), power);
    }
    return sum;
  }

  /// Mean of a power of the offsets over the tolerances, its root: no largest offset is smaller.
  [[nodiscard]] double mean(double power) const {
    return std::pow(objective(power) / static_cast<double>(feet_.size()), 1.0 / power);
  }

  /// Row of derivatives of n . C at the foot, for the end e of the chain or a foot.
  void row_of(std::size_t element, double s, const Element& at, Vec2 direction,
              std::vector<double>& row) {
    std::fill(row.begin(), row.end(), 0.0);
    if (!held_.start) {
      row[0] = direction.x;
      row[1] = direction.y;
      row[2] = dot(direction, turned(chain_.plane, at.point - joints_[0].point));
    }
    const auto add = [&](std::size_t k, const OwnDerivatives& d, Vec2 arm) {
      const auto put = [&](std::size_t column, Vec2 move, double turn) {
        if (column != kNone) row[column] += dot(direction, move + turn * turned(chain_.plane, arm));
      };
      put(column_of(chain_.ends[k][0]), d.kappa0, d.theta_kappa0);
      put(column_of(chain_.ends[k][1]), d.kappa1, d.theta_kappa1);
      put(first_length_ + k, d.length, d.theta_length);
    };
    for (std::size_t k = 0; k < element; ++k) {
      add(k, whole_[k], at.point - joints_[k + 1].point);
    }
    if (element < chain_.size()) add(element, along_[element].at(s), Vec2{});
  }

  void set_whole() {
    joints_ = chain_.joints();
    laws_ = laws_of(chain_);
    whole_.clear();
    along_.clear();
    for (std::size_t k = 0; k < chain_.size(); ++k) {
      const DerivativesAlong along(chain_.plane, laws_[k], joints_[k].theta, chain_.curvature(k, 0),
                                   chain_.curvature(k, 1), chain_.length[k]);
      along_.push_back(along);
      whole_.push_back(DerivativesAlong(along).at_end());
    }
  }

  /// Normal equations of the weighted offsets.
  void assemble(double power) {
    set_whole();
    matrix_.assign(unknowns_ * unknowns_, 0.0);
    right_.assign(unknowns_, 0.0);
    const double top = largest();
    std::vector<double> row(unknowns_);
    const auto take = [&](double residual, double weight) {
      for (std::size_t a = 0; a < unknowns_; ++a) {
        if (row[a] == 0.0) continue;
        right_[a] += weight * row[a] * residual;
        double* line = matrix_.data() + a * unknowns_;
        const double factor = weight * row[a];
        for (std::size_t b = 0; b <= a; ++b) line[b] += factor * row[b];
      }
    };
    for (std::size_t i = 0; i < feet_.size(); ++i) {
      const Foot& foot = feet_[i];
      const Element at = place_on(chain_, laws_, joints_, foot.element, foot.s);
      row_of(foot.element, foot.s, at, left_normal(forward(chain_.plane, at.theta)), row);
      double weight = 1.0 / (tolerance_[i] * tolerance_[i]);
      if (power > 2.0)
        weight *= std::pow(std::max(std::abs(ratio(i)) / top, kLeastShare), power - 2.0);
      take(foot.offset, weight);
    }
    // Newton's step for a sum of powers: the second derivative has this factor more
    for (double& r : right_) r *= power > 0.0 ? 1.0 / (power - 1.0) : 0.0;
    scale_ = largest_steps_;  // elements without points depend on what must hold alone
    for (std::size_t a = 0; a < unknowns_; ++a) {
      const double d = matrix_[a * unknowns_ + a];
      if (d > 0.0) scale_[a] = 1.0 / std::sqrt(d);
    }
    set_conditions();
  }

  /// What must hold exactly: ends of windows and closing; the ends at the end points.
  void set_conditions() {
    conditions_.clear();
    const Element end = joints_.back();
    std::vector<double> row(unknowns_);
    const auto along = [&](std::size_t i, bool at_end) {
      const Element at = at_end ? end : joints_.front();
      const Vec2 direction = lengthwise(chain_.plane, at.theta);
      row_of(at_end ? chain_.size() : 0, 0.0, at, direction, row);
      conditions_.push_back({row, dot(direction, points_[i] - at.point)});
    };
    if (!held_.start) along(0, false);
    if (held_.end) {
      const Element goal = *held_.end;
      for (const Vec2 axis : {Vec2{1.0, 0.0}, Vec2{0.0, 1.0}}) {
        row_of(chain_.size(), 0.0, end, axis, row);
        conditions_.push_back({row, dot(axis, goal.point - end.point)});
      }
      std::fill(row.begin(), row.end(), 0.0);
      if (!held_.start) row[2] = 1.0;
      for (std::size_t k = 0; k < chain_.size(); ++k) {
        const auto put = [&](std::size_t column, double turn) {
          if (column != kNone) row[column] += turn;
        };
        put(column_of(chain_.ends[k][0]), whole_[k].theta_kappa0);
        put(column_of(chain_.ends[k][1]), whole_[k].theta_kappa1);
        put(first_length_ + k, whole_[k].theta_length);
      }
      conditions_.push_back({row, turn_between(chain_.plane, end.theta, goal.theta)});
    } else {
      along(points_.size() - 1, true);
    }
  }

  [[nodiscard]] BandedMatrix damped(double damping) const {
    BandedMatrix out(unknowns_, unknowns_ - 1, unknowns_ - 1);
    for (std::size_t a = 0; a < unknowns_; ++a) {
      for (std::size_t b = 0; b <= a; ++b) {
        const double entry = matrix_[a * unknowns_ + b] * scale_[a] * scale_[b];
        out.at(a, b) = entry;
        out.at(b, a) = entry;
      }
      out.at(a, a) += damping;
    }
    return out;
  }

  /// The step, in scaled unknowns; nothing when the matrix is not positive.
  std::optional<std::vector<double>> step(double damping) const {
    BandedMatrix matrix = damped(damping);
    if (!matrix.factor()) return std::nullopt;
    std::vector<double> right(unknowns_);
    for (std::size_t a = 0; a < unknowns_; ++a) right[a] = right_[a] * scale_[a];
    std::vector<double> move = matrix.solve(right);
    keep_conditions(matrix, move);
    return move;
  }

  /// Moves a step to where it keeps the conditions, by as little as the matrix makes of it. Their
  /// rows are made orthogonal one after the other: the length of the last element, which no point
  /// tells, is so large a part of several that what they do not have in common would be rounding in
  /// a matrix of their products.
  void keep_conditions(const BandedMatrix& matrix, std::vector<double>& move) const {
    const auto product = [&](const std::vector<double>& a, const std::vector<double>& b) {
      double sum = 0.0;
      for (std::size_t k = 0; k < unknowns_; ++k) sum += a[k] * b[k];
      return sum;
    };
    struct Apart {
      std::vector<double> row, solved;
      double gap = 0.0;
    };
    std::vector<Apart> apart;
    for (const auto& c : conditions_) {
      Apart one{c.row, {}, c.gap};
      for (std::size_t a = 0; a < unknowns_; ++a) one.row[a] *= scale_[a];
      one.solved = matrix.solve(one.row);
      const double whole = product(one.row, one.solved);
      for (int pass = 0; pass < 2; ++pass) {  // what the first one leaves is rounding of the row
        for (const Apart& other : apart) {
          const double common = product(one.row, other.solved);
          for (std::size_t a = 0; a < unknowns_; ++a) {
            one.row[a] -= common * other.row[a];
            one.solved[a] -= common * other.solved[a];
          }
          one.gap -= common * other.gap;
        }
      }
      const double own = product(one.row, one.solved);
      if (!(own > kSameCondition * whole)) continue;
      const double size = 1.0 / std::sqrt(own);
      for (std::size_t a = 0; a < unknowns_; ++a) {
        one.row[a] *= size;
        one.solved[a] *= size;
      }
      one.gap *= size;
      const double pull = one.gap - product(one.row, move);
      for (std::size_t a = 0; a < unknowns_; ++a) move[a] += pull * one.solved[a];
      apart.push_back(std::move(one));
    }
  }

  /// The same with curvatures that would get sharper than they may held at that, and elements that
  /// are as short as they may be held so.
  std::optional<std::vector<double>> step_within_limits(double damping) {
    const std::size_t conditions = conditions_.size();
    std::vector<bool> held(unknowns_, false);
    auto move = step(damping);
    for (bool added = true; move && added;) {
      added = false;
      const auto hold = [&](std::size_t column, double change) {
        std::vector<double> row(unknowns_, 0.0);
        row[column] = 1.0;
        conditions_.push_back({std::move(row), change});
        held[column] = added = true;
      };
      for (std::size_t k = 0; k < column_.size(); ++k) {
        if (column_[k] == kNone || held[column_[k]]) continue;
        const double next = chain_.kappa[k] + (*move)[column_[k]] * scale_[column_[k]];
        if (!(std::abs(next) > held_.largest_curvature)) continue;
        hold(column_[k], std::copysign(held_.largest_curvature, next) - chain_.kappa[k]);
      }
      for (std::size_t k = 0; k < chain_.size(); ++k) {
        const std::size_t column = first_length_ + k;
        const bool shortest = chain_.length[k] <= held_.least_length * (1.0 + kAtTheLeast);
        if (!shortest || held[column] || !((*move)[column] < 0.0)) continue;
        hold(column, 0.0);
      }
      if (added) move = step(damping);
    }
    conditions_.resize(conditions);
    return move;
  }

  [[nodiscard]] Chain moved(const std::vector<double>& move) const {
    Chain out = chain_;
    double share = 1.0;
    for (std::size_t k = 0; k < chain_.size(); ++k) {
      const auto change = [&](std::size_t column) {
        return column == kNone ? 0.0 : move[column] * scale_[column];
      };
      const double longer = change(first_length_ + k);
      const double most = kShorter * std::max(chain_.length[k] - held_.least_length, 0.0);
      if (-longer > most) share = std::min(share, most / -longer);
      const double turn =
          chain_.length[k] * std::max(std::abs(change(column_of(chain_.ends[k][0]))),
                                      std::abs(change(column_of(chain_.ends[k][1]))));
      if (turn > kTurn) share = std::min(share, kTurn / turn);
    }
    const auto value = [&](std::size_t column) { return share * move[column] * scale_[column]; };
    if (!held_.start) {
      out.start = out.start + Vec2{value(0), value(1)};
      out.theta += value(2);
    }
    for (std::size_t k = 0; k < chain_.size(); ++k) out.length[k] += value(first_length_ + k);
    for (std::size_t k = 0; k < column_.size(); ++k) {
      if (column_[k] != kNone) out.kappa[k] += value(column_[k]);
    }
    return out;
  }

  /// How far the ends are from where they have to be, units.
  [[nodiscard]] double gap_of(const Chain& chain) const {
    const std::vector<Element> joints = chain.joints();
    double gap = 0.0;
    const auto along = [&](const Element& at, Vec2 point) {
      const Vec2 direction = lengthwise(chain.plane, at.theta);
      gap = std::max(gap, std::abs(dot(direction, point - at.point)));
    };
    if (!held_.start) along(joints.front(), points_.front());
    if (!held_.end) {
      along(joints.back(), points_.back());
      return gap;
    }
    const Element goal = *held_.end;
    double length = 0.0;
    for (const double l : chain.length) length += l;
    const double turn = turn_between(chain.plane, joints.back().theta, goal.theta);
    return std::max({gap, norm(goal.point - joints.back().point), length * std::abs(turn)});
  }

  void improve(double power) {
    const double least = *std::min_element(tolerance_.begin(), tolerance_.end());
    double damping = kDampingStart;
    for (int i = 0; i < kSteps; ++i) {
      const double loose = kLoose * least * std::max(1.0, largest());
      const double before = objective(power), gap = gap_of(chain_);
      // what is far from closing closes first, whatever that costs
      const bool better = take_step(power, damping, [&](double gap_after, double after) {
        return gap > loose ? gap_after < kCloser * gap : after < before && gap_after <= loose;
      });
      const double settled = power == 2.0 ? kSettled : kSettledPower;
      if (!better || (before - objective(power) < settled * before && gap <= loose)) break;
    }
    damping = kDampingClosing;
    for (int i = 0; i < kClosing && gap_of(chain_) > closed_; ++i) {
      const double gap = gap_of(chain_);
      if (!take_step(0.0, damping, [&](double after, double) { return after < kCloser * gap; })) {
        break;
      }
    }
  }

  /// One step that `better` takes, with more damping where it does not. Power 0: the shortest step
  /// that closes the gaps.
  template <class Better>
  bool take_step(double power, double& damping, const Better& better) {
    if (is_cancelled()) return false;
    assemble(power);
    const std::size_t wound = winding(chain_, feet_);
    const double most = std::max(turning(chain_, feet_), most_turning(wound));
    for (; damping < kDampingMost; damping *= 10.0) {
      const auto move = step_within_limits(damping);
      if (!move) continue;
      Chain next = moved(*move);
      std::vector<Foot> feet = feet_;
      if (turning(next, {}) > most) continue;
      find_feet(next, points_, feet);
      if (turning(next, feet) > most) continue;
      if (winding(next, feet) > wound) continue;
      const double gap = gap_of(next);
      std::swap(chain_, next);
      std::swap(feet_, feet);
      const double after = objective(power);
      if (std::isfinite(after) && better(gap, after)) {
        damping = std::max(kDampingLeast, 0.01 * damping);
        return true;
      }
      std::swap(chain_, next);
      std::swap(feet_, feet);
    }
    return false;
  }

  /// rad: once around between two points each, which is more than a winding, and `wound` times
  /// more.
  [[nodiscard]] double most_turning(std::size_t wound) const {
    return kFullTurn * static_cast<double>(points_.size() + wound);
  }

  /// rad, of all elements together, either way, and of what they are extended by to the farthest
  /// foot.
  [[nodiscard]] static double turning(const Chain& chain, const std::vector<Foot>& feet) {
    double sum = 0.0, extended = 0.0;
    const auto sharper = [&](std::size_t k) {
      return std::max(std::abs(chain.curvature(k, 0)), std::abs(chain.curvature(k, 1)));
    };
    for (std::size_t k = 0; k < chain.size(); ++k) sum += chain.length[k] * sharper(k);
    for (const Foot& foot : feet) {
      const double length = chain.length[foot.element];
      const double beyond = std::max(-foot.s, foot.s - length);
      if (!(beyond > 0.0)) continue;
      const double change = chain.curvature(foot.element, 1) - chain.curvature(foot.element, 0);
      extended = std::max(extended,
                          beyond * (sharper(foot.element) + std::abs(change) * (beyond / length)));
    }
    return sum + extended;
  }

  [[nodiscard]] std::size_t winding(const Chain& chain, const std::vector<Foot>& feet) const {
    const PointRow row{points_, tolerance_, false, {}, &passages_};
    return windings(chain, row, feet, 0, row.intervals());
  }

  struct Fixed {
    std::vector<double> row;
    double gap = 0.0;
  };

  Chain& chain_;
  const std::vector<Vec2>& points_;
  const std::vector<double>& tolerance_;
  std::vector<Foot>& feet_;
  const Held& held_;
  std::size_t first_length_ = 0, unknowns_ = 0;
  double closed_ = 0.0;            ///< units: a gap that counts as none
  std::vector<Passage> passages_;  ///< of the intervals of points, on a map
  std::vector<std::size_t> column_;
  std::vector<Element> joints_;
  std::vector<TransitionLaw> laws_;
  std::vector<OwnDerivatives> whole_;
  std::vector<DerivativesAlong> along_;  ///< of each element
  std::vector<double> matrix_, right_, scale_, largest_steps_;
  std::vector<Fixed> conditions_;
};

}  // namespace

std::vector<Element> Chain::joints() const {
  std::vector<Element> out = {{start, theta, size() > 0 ? curvature(0, 0) : 0.0}};
  for (std::size_t k = 0; k < size(); ++k) {
    const double k0 = curvature(k, 0), k1 = curvature(k, 1);
    const Element& from = out.back();
    const double next = k + 1 < size() ? curvature(k + 1, 0) : k1;
    if (law[k] == Transition::kClothoid) {
      out.push_back({from.point + step_along(plane, from.theta, k0, k1, length[k]),
                     from.theta + 0.5 * (k0 + k1) * length[k], next});
    } else {
      const Element end = transition_at(law[k], from, k1, length[k], length[k]);
      out.push_back({end.point, end.theta, next});
    }
  }
  return out;
}

std::vector<double> Chain::headings() const {
  std::vector<double> out = {theta};
  for (std::size_t k = 0; k < size(); ++k) {
    const double k0 = curvature(k, 0), k1 = curvature(k, 1);
    double turn = 0.5;
    if (law[k] != Transition::kClothoid) turn = TransitionLaw(law[k], k0, k1, length[k]).turn(1.0);
    out.push_back(out.back() + (k0 + (k1 - k0) * turn) * length[k]);
  }
  return out;
}

namespace {

/// What a step of Newton's method along an element leaves along it, at the most, and what it
/// changes the offset by: to the third power of the step.
struct FootStep {
  double left = 0.0, offset = 0.0;
};

FootStep step_of(const Chain& chain, const Foot& foot, double kappa, double step) {
  if (chain.law[foot.element] != Transition::kClothoid) return {HUGE_VAL, 0.0};
  const double change = chain.curvature(foot.element, 1) - chain.curvature(foot.element, 0);
  const double rate = std::abs(change) / chain.length[foot.element];
  return {0.5 * (rate * std::abs(foot.offset) + kappa * kappa * std::abs(foot.along)) * step * step,
          -0.5 * kappa * foot.along * step};
}

}  // namespace

void find_feet(const Chain& chain, const std::vector<Vec2>& points, std::vector<Foot>& feet) {
  constexpr int kNewton = 12;
  const std::vector<Element> joints = chain.joints();
  const std::vector<TransitionLaw> laws = laws_of(chain);
  const bool map = chain.plane == Plane::kMap;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Foot& foot = feet[i];
    for (int step = 0; step < kNewton; ++step) {
      while (foot.s > chain.length[foot.element] && foot.element + 1 < chain.size()) {
        foot.s -= chain.length[foot.element++];
      }
      while (foot.s < 0.0 && foot.element > 0) foot.s += chain.length[--foot.element];
      const Element at = place_on(chain, laws, joints, foot.element, foot.s);
      const Vec2 away = points[i] - at.point, ahead = forward(chain.plane, at.theta);
      foot.offset = cross(ahead, away);
      foot.along = map ? dot(ahead, away) : away.x;
      const double stretch = map ? std::max(0.2, 1.0 - at.kappa * foot.offset) : 1.0;
      const double rounding =
          kRounding * (norm(at.point - chain.start) + chain.length[foot.element]);
      if (std::abs(foot.along) <= rounding) break;
      const double way = foot.along / stretch, next = foot.s + way;
      const bool same = next >= 0.0 && next <= chain.length[foot.element];
      const FootStep taken = step_of(chain, foot, at.kappa, way);
      foot.s = next;
      if (!map || !same || !(taken.left <= rounding)) continue;
      foot.offset += taken.offset;
      foot.along = 0.0;
      break;
    }
  }
}

Fitted fit_chain(Chain& chain, const std::vector<Vec2>& points,
                 const std::vector<double>& tolerance, std::vector<Foot>& feet, const Held& held) {
  return Fitter(chain, points, tolerance, feet, held).run();
}

double growth_of(const Chain& chain, const std::vector<Vec2>& points,
                 const std::vector<double>& tolerance, const std::vector<Foot>& feet,
                 const Held& held, int a, int b) {
  Chain own = chain;
  std::vector<Foot> own_feet = feet;
  return Fitter(own, points, tolerance, own_feet, held).growth(a, b);
}

}  // namespace obvid::alignment
