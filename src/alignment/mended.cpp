// SPDX-License-Identifier: Apache-2.0
#include "mended.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "fewest_pieces.h"
#include "rounded_corners.h"

namespace obvid::alignment {
namespace {

constexpr double kAhead = 0.4;  ///< of the way to the first point: straight on, then to that
/// Of the length of an element: what is shorter is no part of it.
constexpr double kNoPart = 1e-6;

/// Where a chain is cut.
struct Cut {
  std::size_t element = 0;
  double s = 0.0;
  Element at;
};

class Mender {
 public:
  Mender(const Chain& chain, const std::vector<Foot>& feet, const PointRow& row,
         const PointStretch& stretch)
      : chain_(chain),
        feet_(feet),
        row_(row),
        stretch_(stretch),
        joints_(chain.joints()),
        begins_(stretch.first == 0),
        ends_(stretch.last + 1 == row.points.size()) {}

  std::optional<FootedChain> run() {
    if (!begins_) before_ = cut_between(stretch_.first - 1);
    if (!ends_) behind_ = cut_between(stretch_.last);
    const bool linear = (begins_ || chain_.law[before_.element] == Transition::kClothoid) &&
                        (ends_ || chain_.law[behind_.element] == Transition::kClothoid);
    if (!linear || !is_in_order()) return std::nullopt;
    take_path();
    const std::vector<Node> nodes = rounded_corners(path_, allowed_);
    out_.chain.plane = chain_.plane;
    out_.chain.kappa = chain_.kappa;
    out_.chain.start = begins_ ? nodes.front().point : chain_.start;
    out_.chain.theta = begins_ ? nodes.front().theta : chain_.theta;
    out_.feet = feet_;
    if (!begins_) {
      for (std::size_t k = 0; k < before_.element; ++k) take_part(k, 0.0, chain_.length[k]);
      take_part(before_.element, 0.0, before_.s);
    }
    if (!take_chords(nodes)) return std::nullopt;
    if (!ends_) take_rest();
    return std::move(out_);
  }

 private:
  /// Whether the feet of all points before the cuts lie before them, and those behind behind them:
  /// where a chain winds they may not.
  [[nodiscard]] bool is_in_order() const {
    const auto place_of = [](const auto& at) { return std::pair(at.element, at.s); };
    if (!begins_ && !ends_ && place_of(behind_) < place_of(before_)) return false;
    for (std::size_t i = 0; i < feet_.size(); ++i) {
      if (i < stretch_.first && place_of(before_) < place_of(feet_[i])) return false;
      if (i > stretch_.last && place_of(feet_[i]) < place_of(behind_)) return false;
    }
    return true;
  }

  /// Half way between the feet of points i and i + 1.
  [[nodiscard]] Cut cut_between(std::size_t i) const {
    const Foot &a = feet_[i], &b = feet_[i + 1];
    double way = b.s - a.s;
    for (std::size_t k = a.element; k < b.element; ++k) way += chain_.length[k];
    Cut out{a.element, a.s + 0.5 * way, {}};
    while (out.s > chain_.length[out.element] && out.element + 1 < chain_.size()) {
      out.s -= chain_.length[out.element++];
    }
    out.s = std::clamp(out.s, 0.0, chain_.length[out.element]);
    const double k0 = chain_.curvature(out.element, 0), k1 = chain_.curvature(out.element, 1);
    const Element start{joints_[out.element].point, joints_[out.element].theta, k0};
    out.at = element_behind(chain_.plane, start, (k1 - k0) / chain_.length[out.element], out.s);
    return out;
  }

  /// The points between the cuts, and places straight on from these.
  void take_path() {
    const auto first = static_cast<std::ptrdiff_t>(stretch_.first);
    const auto last = static_cast<std::ptrdiff_t>(stretch_.last) + 1;
    path_.assign(row_.points.begin() + first, row_.points.begin() + last);
    allowed_.assign(row_.tolerance.begin() + first, row_.tolerance.begin() + last);
    if (!begins_) {
      const Vec2 at = before_.at.point;
      const double ahead = kAhead * norm(path_.front() - at);
      path_.insert(path_.begin(), {at, at + ahead * unit_at(before_.at.theta)});
      allowed_.insert(allowed_.begin(), 2, allowed_.front());
      skipped_ = 2;
    }
    if (!ends_) {
      const Vec2 at = behind_.at.point;
      const double back = kAhead * norm(path_.back() - at);
      path_.insert(path_.end(), {at - back * unit_at(behind_.at.theta), at});
      allowed_.insert(allowed_.end(), 2, allowed_.back());
    }
  }

  /// From s0 to s1 of an element, with what is nearly none left out.
  void take_part(std::size_t k, double s0, double s1) {
    const double length = chain_.length[k];
    if (!(s1 - s0 > kNoPart * length)) return;
    std::array<int, 2> ends = chain_.ends[k];
    const double k0 = chain_.curvature(k, 0), k1 = chain_.curvature(k, 1);
    const auto cut_off = [&](std::size_t end, double s) {
      if (ends[0] == ends[1]) return;
      ends[end] = static_cast<int>(out_.chain.kappa.size());
      out_.chain.kappa.push_back(k0 + (k1 - k0) * s / length);
    };
    const bool bends = ends[0] != ends[1];
    if (bends && s0 > 0.0) cut_off(0, s0);
    if (bends && s1 < length) cut_off(1, s1);
    out_.chain.length.push_back(s1 - s0);
    out_.chain.ends.push_back(ends);
    out_.chain.law.push_back(chain_.law[k]);
  }

  bool take_chords(const std::vector<Node>& nodes) {
    std::size_t point = stretch_.first;
    for (std::size_t n = 0; n + 1 < nodes.size(); ++n) {
      const Node &a = nodes[n], &b = nodes[n + 1];
      const auto piece = piece_between(chain_.plane, a.point, a.theta, b.point, b.theta);
      if (!piece || !(piece->length > 0.0)) return false;
      const int number = static_cast<int>(out_.chain.kappa.size());
      out_.chain.kappa.insert(out_.chain.kappa.end(), {piece->kappa0, piece->kappa1});
      const std::size_t element = out_.chain.size();
      for (; point <= stretch_.last; ++point) {
        const auto place = static_cast<double>(point - stretch_.first + skipped_);
        if (place > b.place) break;
        out_.feet[point].element = element;
        out_.feet[point].s = piece->length * (place - a.place) / (b.place - a.place);
      }
      out_.chain.length.push_back(piece->length);
      out_.chain.ends.push_back({number, number + 1});
      out_.chain.law.push_back(Transition::kClothoid);
    }
    return true;
  }

  /// What lies behind, and the feet on it.
  void take_rest() {
    const std::size_t begin = out_.chain.size();
    take_part(behind_.element, behind_.s, chain_.length[behind_.element]);
    const bool cut_away = out_.chain.size() == begin;
    for (std::size_t k = behind_.element + 1; k < chain_.size(); ++k) {
      take_part(k, 0.0, chain_.length[k]);
    }
    for (std::size_t i = stretch_.last + 1; i < feet_.size(); ++i) {
      Foot& foot = out_.feet[i];
      const std::size_t on = foot.element - behind_.element;
      if (on == 0) foot.s = cut_away ? 0.0 : foot.s - behind_.s;
      foot.element = begin + on - (cut_away && on > 0 ? 1 : 0);
      if (foot.element < out_.chain.size()) continue;
      foot.element = out_.chain.size() - 1;  // nothing of the last element was left
      foot.s = out_.chain.length.back();
    }
  }

  const Chain& chain_;
  const std::vector<Foot>& feet_;
  const PointRow& row_;
  const PointStretch& stretch_;
  const std::vector<Element> joints_;
  bool begins_, ends_;
  Cut before_, behind_;
  std::vector<Vec2> path_;
  std::vector<double> allowed_;
  std::size_t skipped_ = 0;  ///< places of the path before the first point
  FootedChain out_;
};

}  // namespace

std::optional<FootedChain> with_rounded_chords(const Chain& chain, const std::vector<Foot>& feet,
                                               const PointRow& row, const PointStretch& stretch) {
  return Mender(chain, feet, row, stretch).run();
}

}  // namespace obvid::alignment
