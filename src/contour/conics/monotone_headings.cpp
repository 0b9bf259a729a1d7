// SPDX-License-Identifier: Apache-2.0
// Headings for which a monotone elliptic chain exists: docs/methods/conics.md, section 4.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "links.h"
#include "obvid/contour/conics.h"

namespace obvid {
namespace {

constexpr int kMostSteps = 60;
constexpr int kMostHalvings = 30;
/// Weights of equal curvatures at a joint against weights in the middle of their ranges, one after
/// the other. Chains are long and what is left at each joint adds up, so the last one is large; to
/// begin with it the search would have to creep along a narrow valley.
constexpr std::array<double, 4> kJointWeights = {1.0, 10.0, 100.0, 1000.0};
/// Pull towards the given headings, tried one after the other: less of it finds more.
constexpr std::array<double, 4> kPulls = {1.0, 0.1, 1e-2, 1e-3};
constexpr double kSmallStep = 1e-12;  // of an angle at a chord: rounding
constexpr std::size_t kReach = 3;     // farthest nonzero entry from the diagonal

/// One segment: given data and what stays the same through the search.
struct Segment {
  double omega = 0.0;  ///< heading of the chord, near those of the elements
  double half_chord_log = 0.0;
  int turning = 0;
  bool falls = false;  ///< |kappa| from start to end
  double room = 0.0;   ///< half width of the range of log w^2 at the start: unit of its residuals
  double angle = 0.0;  ///< smaller angle at the chord at the start
};

/// Logarithms that the equations of a segment are made of.
struct Logs {
  double curvature_ratio = 0.0;  ///< |kappa| at the end over that at the start
  double weighted = 0.0;         ///< |kappa| w^2 at the start
  double middle = 0.0;           ///< middle of the range of w^2
};

std::array<double, 2> square_range(const Segment& s, double phi, double psi) {
  const auto squares = conics::monotone_squares(phi, psi);
  return s.falls ? std::array{squares.at_end, std::min(0.0, squares.at_start)}
                 : std::array{squares.at_start, std::min(0.0, squares.at_end)};
}

Logs logs_of(const Segment& s, double phi, double psi) {
  const double sin_phi = std::log(std::sin(phi)), sin_psi = std::log(std::sin(psi));
  const double sin_turn = std::log(std::sin(phi + psi));
  const auto range = square_range(s, phi, psi);
  return {3.0 * (sin_psi - sin_phi),
          sin_phi - 2.0 * (sin_psi - sin_turn) - s.half_chord_log - 2.0 * std::log(2.0),
          0.5 * (range[0] + range[1])};
}

/// Symmetric positive definite system with a narrow band.
class BandedNormal {
 public:
  explicit BandedNormal(std::size_t n) : rows_(n), right_(n) {}

  /// Adds the square of a residual with its slopes by the unknowns first, first + 1, ....
  template <std::size_t Count>
  void add(std::size_t first, const std::array<double, Count>& slopes, double residual) {
    for (std::size_t i = 0; i < Count; ++i) {
      for (std::size_t j = i; j < Count; ++j) rows_[first + i][j - i] += slopes[i] * slopes[j];
      right_[first + i] -= slopes[i] * residual;
    }
  }

  /// Leaves an unknown where it is.
  void keep(std::size_t j) {
    for (std::size_t k = 0; k <= kReach; ++k) {
      rows_[j][k] = 0.0;
      if (k <= j) rows_[j - k][k] = 0.0;
    }
    rows_[j][0] = 1.0;
    right_[j] = 0.0;
  }

  std::vector<double> solve() {
    const std::size_t n = right_.size();
    for (std::size_t c = 0; c < n; ++c) {
      for (std::size_t r = c + 1; r < n && r <= c + kReach; ++r) {
        const double f = rows_[c][r - c] / rows_[c][0];
        for (std::size_t k = r; k < n && k <= c + kReach; ++k) {
          rows_[r][k - r] -= f * rows_[c][k - c];
        }
        right_[r] -= f * right_[c];
      }
    }
    for (std::size_t c = n; c-- > 0;) {
      for (std::size_t k = c + 1; k < n && k <= c + kReach; ++k) {
        right_[c] -= rows_[c][k - c] * right_[k];
      }
      right_[c] /= rows_[c][0];
    }
    return right_;
  }

 private:
  std::vector<std::array<double, kReach + 1>> rows_;
  std::vector<double> right_;
};

class HeadingSearch {
 public:
  HeadingSearch(const std::vector<Element>& elements, const std::vector<conics::Link>& links,
                const KeptByConics& kept, Watch* watch)
      : given_(elements), kept_(2 * elements.size(), false), watch_(watch) {
    for (std::size_t i = 0; i < kept.headings.size(); ++i) kept_[2 * i] = kept.headings[i];
    if (kept.curvature) kept_[2 * *kept.curvature + 1] = true;
    for (std::size_t i = 0; i < links.size(); ++i) add_segment(i, links[i].triangle);
  }

  /// Elements with other headings. Nothing where the search has no place to begin.
  std::optional<std::vector<Element>> run(double pull) {
    pull_ = pull;
    unknowns_ = start();
    for (const double weight : kJointWeights) {
      joint_weight_ = weight;
      measure_rooms();
      if (!descend()) return std::nullopt;
    }
    std::vector<Element> found = given_;
    for (std::size_t i = 0; i < found.size(); ++i) found[i].theta = unknowns_[2 * i];
    return found;
  }

 private:
  /// Gauss-Newton steps, halved until they help. False where the start is outside all triangles,
  /// and where the watch says to stop.
  bool descend() {
    double merit = merit_of(unknowns_, INFINITY);
    if (!std::isfinite(merit)) return false;
    for (int step = 0; step < kMostSteps; ++step) {
      if (watch_ != nullptr && !watch_->spend(static_cast<double>(given_.size()))) return false;
      const std::vector<double> move = newton_move();
      double part = 1.0;
      int halvings = 0;
      for (; halvings < kMostHalvings; ++halvings, part *= 0.5) {
        const auto next = moved(move, part);
        const double there = merit_of(next, merit);
        if (!(there < merit)) continue;
        unknowns_ = next;
        merit = there;
        break;
      }
      if (halvings == kMostHalvings || part * largest_turn(move) < kSmallStep) break;
    }
    return true;
  }

  void add_segment(std::size_t i, const conics::Triangle& t) {
    Segment s;
    s.omega = given_[i].theta + t.turning * t.phi;
    s.half_chord_log = std::log(0.5 * t.h);
    s.turning = t.turning;
    s.falls = std::abs(given_[i + 1].kappa) < std::abs(given_[i].kappa);
    segments_.push_back(s);
  }

  /// Units of the residuals, for the headings as they are.
  void measure_rooms() {
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      Segment& s = segments_[i];
      const double p = phi(s, unknowns_[2 * i]), q = psi(s, unknowns_[2 * i + 2]);
      const auto range = square_range(s, p, q);
      s.angle = std::min(p, q);
      s.room = 0.5 * (range[1] - range[0]);
      // headings that fit no monotone conic at all: a turn of the same size tells the scale
      constexpr double kLeastRoom = 1e-9;
      if (!(s.room > kLeastRoom && std::isfinite(s.room))) s.room = std::max(kLeastRoom, p * p);
    }
  }

  [[nodiscard]] std::vector<double> start() const {
    std::vector<double> x;
    for (const Element& e : given_) {
      x.push_back(e.theta);
      x.push_back(std::log(std::abs(e.kappa)));
    }
    // an end without curvature takes that of its conic's other end
    const auto ratio = [&](std::size_t i) {
      const Segment& s = segments_[i];
      return logs_of(s, phi(s, x[2 * i]), psi(s, x[2 * i + 2])).curvature_ratio;
    };
    const std::size_t n = given_.size();
    if (!std::isfinite(x[1])) x[1] = x[3] - ratio(0);
    if (!std::isfinite(x[2 * n - 1])) x[2 * n - 1] = x[2 * n - 3] + ratio(n - 2);
    return x;
  }

  static double phi(const Segment& s, double theta) { return -s.turning * (theta - s.omega); }
  static double psi(const Segment& s, double theta) { return s.turning * (theta - s.omega); }

  struct Residuals {
    double joint = 0.0;
    double weight = 0.0;
  };

  [[nodiscard]] Residuals residuals(const Segment& s, const Logs& l, double k0, double k1) const {
    return {joint_weight_ / s.room * (k1 - k0 - l.curvature_ratio),
            (l.weighted - k0 - l.middle) / s.room};
  }

  [[nodiscard]] double pull_weight(std::size_t i) const {
    const Segment& s = segments_[std::min(i, segments_.size() - 1)];
    return pull_ / (s.room * s.angle);
  }

  /// Sum of squares; infinite where a segment has no triangle or no range, and once it is not less
  /// than `limit`.
  [[nodiscard]] double merit_of(const std::vector<double>& x, double limit) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      const Segment& s = segments_[i];
      const double p = phi(s, x[2 * i]), q = psi(s, x[2 * i + 2]);
      if (!(p > 0.0 && q > 0.0 && p + q < 0.5 * std::numbers::pi)) return INFINITY;
      const auto r = residuals(s, logs_of(s, p, q), x[2 * i + 1], x[2 * i + 3]);
      sum += r.joint * r.joint + r.weight * r.weight;
      if (!(sum < limit)) return INFINITY;
    }
    for (std::size_t i = 0; i < given_.size(); ++i) {
      const double away = pull_weight(i) * (x[2 * i] - given_[i].theta);
      sum += away * away;
    }
    return sum;
  }

  void add_equations(std::size_t i, BandedNormal& system) const {
    const Segment& s = segments_[i];
    const double p = phi(s, unknowns_[2 * i]), q = psi(s, unknowns_[2 * i + 2]);
    constexpr double kDifference = 1e-5;  // of the smaller angle: 1e-10 of a slope is left
    const double d = kDifference * std::min(p, q);
    const Logs here = logs_of(s, p, q);
    const auto slopes = [&](const Logs& above, const Logs& below, int side) {
      return Logs{side * (above.curvature_ratio - below.curvature_ratio) / (2.0 * d),
                  side * (above.weighted - below.weighted) / (2.0 * d),
                  side * (above.middle - below.middle) / (2.0 * d)};
    };
    const Logs by_start = slopes(logs_of(s, p + d, q), logs_of(s, p - d, q), -s.turning);
    const Logs by_end = slopes(logs_of(s, p, q + d), logs_of(s, p, q - d), s.turning);
    const auto r = residuals(s, here, unknowns_[2 * i + 1], unknowns_[2 * i + 3]);
    const double joint = joint_weight_ / s.room, weight = 1.0 / s.room;
    system.add<4>(
        2 * i, {-joint * by_start.curvature_ratio, -joint, -joint * by_end.curvature_ratio, joint},
        r.joint);
    system.add<3>(2 * i,
                  {weight * (by_start.weighted - by_start.middle), -weight,
                   weight * (by_end.weighted - by_end.middle)},
                  r.weight);
  }

  [[nodiscard]] std::vector<double> newton_move() const {
    BandedNormal system(unknowns_.size());
    for (std::size_t i = 0; i < segments_.size(); ++i) add_equations(i, system);
    for (std::size_t i = 0; i < given_.size(); ++i) {
      const double w = pull_weight(i);
      system.add<1>(2 * i, {w}, w * (unknowns_[2 * i] - given_[i].theta));
    }
    for (std::size_t j = 0; j < unknowns_.size(); ++j) {
      if (kept_[j]) system.keep(j);
    }
    return system.solve();
  }

  [[nodiscard]] std::vector<double> moved(const std::vector<double>& move, double part) const {
    std::vector<double> x = unknowns_;
    for (std::size_t j = 0; j < x.size(); ++j) x[j] += part * move[j];
    return x;
  }

  [[nodiscard]] static double largest_turn(const std::vector<double>& move) {
    double largest = 0.0;
    for (std::size_t j = 0; j < move.size(); j += 2) largest = std::max(largest, std::abs(move[j]));
    return largest;
  }

  const std::vector<Element>& given_;
  std::vector<bool> kept_;  // per unknown
  std::vector<Segment> segments_;
  std::vector<double> unknowns_;
  double pull_ = 0.0, joint_weight_ = 0.0;
  Watch* watch_;
};

/// Whether each conic's curvature changes as it does between the given elements.
bool same_directions(const std::vector<RationalBezier>& pieces,
                     const std::vector<Element>& elements) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const double change = elements[i + 1].kappa - elements[i].kappa;
    if (conic_direction(pieces[i]) * change < 0.0) return false;
  }
  return true;
}

}  // namespace

Result<std::vector<Element>> headings_for_conics(const std::vector<Element>& elements,
                                                 const KeptByConics& kept, Watch* watch) {
  const auto links = conics::links_over(elements);
  OBVID_TRY(links);
  const auto works = [&](const std::vector<Element>& e) {
    const auto chain = conic_chain(e, {std::nullopt, kept.curvature});
    return chain && chain->elliptic && chain->monotone && same_directions(chain->pieces, elements);
  };
  if (works(elements)) return elements;
  HeadingSearch search(elements, *links, kept, watch);
  for (const double pull : kPulls) {
    const auto found = search.run(pull);
    if (found && works(*found)) return *found;
  }
  const auto chain = conic_chain(elements);
  return error(ErrorCode::kNotProved, "no headings were found for a monotone chain of ellipse arcs")
      .hint("add points, or use another carrier")
      .point(chain ? chain->why_not.first : 0)
      .value(chain ? chain->why_not.excess : 0.0);
}

}  // namespace obvid
