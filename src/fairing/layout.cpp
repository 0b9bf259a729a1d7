// SPDX-License-Identifier: Apache-2.0
#include "layout.h"

#include <cmath>

#include "node_ends.h"

namespace obvid::fairing_detail {
namespace {

/// A free node may move by this part of its link to either side.
constexpr double kFreeReach = 0.1;

class Layer {
 public:
  Layer(const Tube& tube, const State& state, Window window, const Layout& layout)
      : tube_(tube), state_(state), window_(window), layout_(layout) {
    out_.tube.origin = tube.origin;
    out_.tube.on_primitives = tube.on_primitives;
    out_.tube.closed = tube.closed && window.first == 0 && window.last == tube.links();
  }

  LaidTube run() {
    const std::size_t n = tube_.nodes.size();
    for (std::size_t i = window_.first; i < window_.last; ++i) {
      add_node(i);
      add_link(i, (i + 1) % n);
    }
    if (!out_.tube.closed) add_node(window_.last % n);
    out_.tube.first_row.push_back(out_.tube.rows.size());
    return std::move(out_);
  }

 private:
  void add_node(std::size_t i) {
    out_.tube.nodes.push_back(tube_.nodes[i]);
    out_.node.emplace_back(i);
    for (std::size_t k = 0; k < kPerNode; ++k) out_.start.push_back(state_[kPerNode * i + k]);
  }

  void open_link(double size, std::int8_t direction) {
    out_.tube.first_row.push_back(out_.tube.rows.size());
    out_.tube.size.push_back(size);
    out_.direction.push_back(direction);
  }

  void add_link(std::size_t i, std::size_t next) {
    const Course c = layout_[i];
    const auto first = tube_.rows.begin() + static_cast<std::ptrdiff_t>(tube_.first_row[i]);
    const auto last = tube_.rows.begin() + static_cast<std::ptrdiff_t>(tube_.first_row[i + 1]);
    if (!is_split(c)) {
      open_link(tube_.size[i], first_direction(c));
      out_.tube.rows.insert(out_.tube.rows.end(), first, last);
      return;
    }
    const NodeEnd a = place(tube_.nodes[i], &state_[kPerNode * i]).out;
    const NodeEnd b = place(tube_.nodes[next], &state_[kPerNode * next]).in;
    const TubeNode middle = middle_node(a, b);
    constexpr double kQuarter = 0.25;  // half the chord, and the size goes with its square
    open_link(kQuarter * tube_.size[i], first_direction(c));
    auto row = first;
    const Vec2 chord = b.position - a.position;
    while (row != last && dot(row->point - a.position, chord) < 0.5 * dot(chord, chord)) {
      out_.tube.rows.push_back(*row++);
    }
    out_.tube.nodes.push_back(middle);
    out_.node.emplace_back(std::nullopt);
    out_.start.insert(out_.start.end(), kPerNode, 0.0);
    open_link(kQuarter * tube_.size[i], last_direction(c));
    out_.tube.rows.insert(out_.tube.rows.end(), row, last);
  }

  const Tube& tube_;
  const State& state_;
  Window window_;
  const Layout& layout_;
  LaidTube out_;
};

}  // namespace

TubeNode middle_node(const NodeEnd& a, const NodeEnd& b) {
  const Vec2 chord = b.position - a.position;
  const double h = norm(chord), omega = heading(chord);
  const double ta = std::tan(turning(chord, a.tangent)), tb = std::tan(turning(chord, b.tangent));
  const double sum = a.kappa + b.kappa;
  const double y = 5.0 / 32.0 * h * (ta - tb) + h * h * sum / 64.0;
  const double slope = -7.0 / 16.0 * (ta + tb) + h * (b.kappa - a.kappa) / 32.0;
  const double bend = 1.5 * (tb - ta) / h - 0.25 * sum;
  const double run = std::hypot(1.0, slope);
  TubeNode n;
  const Vec2 along = (1.0 / h) * chord;
  n.point = a.position + 0.5 * chord + y * left_normal(along);
  n.theta = omega + std::atan(slope);
  n.normal = left_normal(unit_at(n.theta));
  n.kappa = bend / (run * run * run);
  n.length = 0.5 * h;
  n.reach = kFreeReach * h;
  return n;
}

int count_vertices(const Layout& layout, bool closed) {
  int n = 0;
  for (std::size_t i = 0; i < layout.size(); ++i) {
    if (is_split(layout[i])) ++n;
    const bool seam = i == 0;
    if (seam && !closed) continue;
    const Course before = layout[seam ? layout.size() - 1 : i - 1];
    if (last_direction(before) != first_direction(layout[i])) ++n;
  }
  return n;
}

LaidTube lay_out(const Tube& tube, const State& state, Window window, const Layout& layout) {
  return Layer(tube, state, window, layout).run();
}

}  // namespace obvid::fairing_detail
