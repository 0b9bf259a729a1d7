// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "bordered_system.h"
#include "node_ends.h"
#include "obvid/chain/internal/cone.h"
#include "tube.h"

namespace obvid::fairing_detail {

/// What the merit function is made of.
struct Weights {
  double energy = 0.0;
  double cone = 0.0;  ///< 0: no cones at all
  double tube = 0.0;
};

/// Energy and barriers of a tube, as functions of its nodes' unknowns
/// (docs/methods/fairing.md).
class TubeModel {
 public:
  TubeModel(const Tube& tube, const std::vector<std::int8_t>& direction, Cone cone,
            const LinkEnergy& energy);

  [[nodiscard]] std::size_t node_count() const { return nodes_; }
  [[nodiscard]] std::size_t link_count() const { return tube_.links(); }
  /// Work of one step: a node is one unit, points between and on primitives are less.
  [[nodiscard]] double step_work() const {
    constexpr double kPerPoint = 0.25;
    return static_cast<double>(nodes_) +
           kPerPoint * static_cast<double>(tube_.rows.size() + tube_.on_primitives.size());
  }

  /// Gradient and Gauss-Newton Hessian of the merit at x (3 per node).
  void assemble(const State& x, double slack, const Weights& weights, bool with_slack,
                BorderedSystem& system);
  /// The same value alone; infinity outside the cones or the tube.
  double merit(const State& x, double slack, const Weights& weights);
  /// Least slack (at least 0) with which all cones hold at x, and the link that needs it.
  double needed_slack(const State& x);
  /// Barrier force of each link's cone.
  std::vector<double> link_forces(const State& x, double slack);
  /// Values of (m, q, sigma) per link.
  struct LinkValue {
    double m, q, sigma;
  };
  std::vector<LinkValue> link_values(const State& x);
  [[nodiscard]] double barrier_parameter() const;
  /// Largest |residual| / reach of each node, its primitive and the rows behind it.
  std::vector<double> node_uses(const State& x);
  /// The largest of all.
  double tube_use(const State& x);
  /// From now on the slack widens the tube, to 1 + slack reaches, instead of the cones.
  void let_slack_widen_the_tube() { slack_widens_ = true; }

 private:
  struct LinkView {
    double h = 0.0;
    ConeVariables cone;
    double cos_alpha = 1.0, cos_beta = 1.0, sin_alpha = 0.0, sin_beta = 0.0;
    Vec2 along;
  };

  [[nodiscard]] const TubeNode& node(std::size_t i) const { return tube_.nodes[i]; }
  void place_nodes(const State& x);
  [[nodiscard]] LinkView link_view(std::size_t i) const;
  [[nodiscard]] ConeRoom room(std::size_t i, const LinkView& s, double slack) const;
  [[nodiscard]] double least_cosine(std::size_t link) const;
  [[nodiscard]] double row_weight(std::size_t link) const;
  void add_cone(std::size_t i, const LinkView& s, double slack, const Weights& w,
                LinkTerms& terms) const;
  void add_rows(std::size_t i, const LinkView& s, double weight, LinkTerms& terms) const;
  struct WallTerms {
    double g, h, width_g, width_h, mixed;
  };
  [[nodiscard]] WallTerms wall(double r, double weight) const;
  struct RowValue {
    double residual;  // over reach
    double h1, h2, h4, h5, u;
    double x, y;         // of the point along and across the chord
    double by_h, slope;  // of the curve's height by the chord's length and by x
  };
  [[nodiscard]] RowValue row_value(const TubeRow& row, const LinkView& s, const NodeEnd& a,
                                   const NodeEnd& b) const;
  /// Derivatives of both ends of a link, first by the unknowns of its first node, then of its
  /// second.
  struct LinkJet {
    std::array<Vec2, 6> chord;  ///< position of the end minus that of the start
    std::array<Vec2, 6> start;
    std::array<double, 6> theta_a{}, theta_b{}, kappa_a{}, kappa_b{};
  };
  [[nodiscard]] LinkJet link_jet(std::size_t i) const;
  [[nodiscard]] double primitive_room(std::size_t i) const;
  void add_primitive(std::size_t i, double weight, bool with_slack, BorderedSystem& system) const;
  [[nodiscard]] std::size_t next(std::size_t i) const { return i + 1 == nodes_ ? 0 : i + 1; }
  void add_nodes(const State& x, double slack, const Weights& w, bool with_slack,
                 BorderedSystem& system) const;

  const Tube& tube_;
  const std::vector<std::int8_t>& direction_;
  Cone cone_;
  LinkEnergy energy_;
  std::size_t nodes_ = 0;
  bool slack_widens_ = false;
  double half_width_ = 1.0;  ///< of the tube, in reaches
  std::vector<PlacedNode> state_;
};

}  // namespace obvid::fairing_detail
