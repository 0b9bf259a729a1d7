// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "newton_system.h"
#include "obvid/chain/internal/chain.h"
#include "obvid/chain/internal/cone.h"

namespace obvid::chain_detail {

/// Energy and barriers of a chain as functions of the deviations from the adjacent circles.
///
/// Unknowns per node: phi, the heading minus that of the adjacent circle's tangent, and
/// p = (kappa - kappa of the adjacent circle) * local length. For points of one circle all of them
/// and all A, B, sigma are zero, so nearly circular data lose no digits (docs/methods/chain.md).
class LinkModel {
 public:
  explicit LinkModel(const ChainProblem& problem);

  [[nodiscard]] std::vector<double> starting_guess() const;
  [[nodiscard]] std::vector<double> from_elements(const std::vector<Element>& elements) const;

  /// energy * E + barrier * B at x, with gradient and Gauss-Newton Hessian in `system`. Infinity
  /// outside the cones, where the system is of no use.
  double assemble(const std::vector<double>& x, double slack, double energy, double barrier,
                  NewtonSystem& system) const;

  /// The same value alone; infinity outside the cones.
  [[nodiscard]] double merit(const std::vector<double>& x, double slack, double energy,
                             double barrier) const;
  [[nodiscard]] bool inside(const std::vector<double>& x, double slack) const;
  /// Sum of the weights of all links: the scale of the merit function.
  [[nodiscard]] double total_weight() const { return total_weight_; }

  [[nodiscard]] std::vector<Element> elements(const std::vector<Vec2>& points,
                                              const std::vector<double>& x) const;
  [[nodiscard]] std::vector<LinkState> links(const std::vector<double>& x) const;
  /// A link at x with the derivatives of its A, B by the unknowns of its nodes; sigma grows with
  /// both headings.
  struct LinkJet {
    LinkState state;
    double A_by_phi = 0.0, A_by_p = 0.0;  ///< of the node at its start
    double B_by_phi = 0.0, B_by_p = 0.0;  ///< of the node at its end
  };
  [[nodiscard]] LinkJet jet(std::size_t link, const std::vector<double>& x) const;
  /// Expected B - A of a link: the unit of the unknowns beside it.
  [[nodiscard]] double link_size(std::size_t link) const { return links_[link].size; }
  [[nodiscard]] bool heading_fixed(std::size_t node) const { return nodes_[node].fix_phi; }
  [[nodiscard]] bool curvature_fixed(std::size_t node) const { return nodes_[node].fix_p; }
  /// Curvature at x in units of the node's length, positive where it has the wanted sign; 1 where
  /// none is wanted.
  [[nodiscard]] double curvature_room(std::size_t node, const std::vector<double>& x) const;
  [[nodiscard]] double wanted_sign(std::size_t node) const { return nodes_[node].sign; }
  /// Force of each link's barrier against the common slack: who keeps it from closing.
  [[nodiscard]] std::vector<double> link_forces(const std::vector<double>& x, double slack) const;
  /// Move of a point, in units, that changes a link's cone by its own size.
  [[nodiscard]] double point_move(std::size_t link) const;

 private:
  struct Link {
    double h = 0.0, omega = 0.0;
    double alpha = 0.0, beta = 0.0;  // of the adjacent circles
    double sa = 0.0, ca = 1.0, sb = 0.0, cb = 1.0;
    double ka = 0.0, kb = 0.0;  // dA/dp at the start, dB/dp at the end
    double sigma = 0.0;         // alpha + beta
    double sin_sigma = 0.0, cos_sigma = 1.0;
    double size = 0.0;  // expected B - A
    double inverse_size = 0.0;
    double energy = 0.0;  // weight of the energy: 1 / size^2
    double direction = 0.0;
    Cone cone = Cone::kNone;
  };
  struct Node {
    double length = 0.0;     // local scale
    double kappa = 0.0;      // of the adjacent circle
    double sign = 0.0;       // wanted sign of the curvature, 0 = free
    double sign_size = 0.0;  // of the slack, in units of p
    double rate = 0.0;       // estimate of d kappa / d s, for the start
    bool fix_phi = false, fix_p = false;
    double phi = 0.0, p = 0.0;  // values of the fixed variables
    double fixed_kappa = 0.0;   // as given, to the last bit
  };
  struct Trig {
    double sin = 0.0, versin = 0.0, cos = 1.0;  // of phi; versin = 1 - cos without cancellation
  };
  struct State {
    double A, B, sigma, sin_sigma, cos_sigma, dA,
        dB;  // dA = dA/dphi at the start, dB = -dB/dphi at the end
  };

  [[nodiscard]] static ConeVariables variables(const State& state);
  [[nodiscard]] static ConeRoom room(const Link& link, const ConeVariables& variables,
                                     double slack);
  static void scatter(const ConeTerms& terms, const Link& link, const State& state,
                      NewtonSystem::Block& a, NewtonSystem::Block& b);
  double add_nodes(const std::vector<double>& x, double slack, double barrier,
                   NewtonSystem& system) const;
  [[nodiscard]] static double signed_curvature(const Node& node, double p, double slack);
  [[nodiscard]] double tangent(std::size_t node) const;  ///< heading of the adjacent circle
  [[nodiscard]] static Trig trig(double phi);
  [[nodiscard]] static State state(const Link& link, const Trig& a, const Trig& b, double phi_a,
                                   double p_a, double phi_b, double p_b);
  void set_lengths(const ChainProblem& problem);
  void set_sizes(const ChainProblem& problem);
  void weigh_by_change();
  void set_fixed(const ChainProblem& problem);

  std::vector<Link> links_;
  std::vector<Node> nodes_;
  double total_weight_ = 0.0;
};

}  // namespace obvid::chain_detail
