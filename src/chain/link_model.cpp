// SPDX-License-Identifier: Apache-2.0
#include "link_model.h"
#include "obvid/geom/internal/angle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace obvid::chain_detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Mere existence needs -A B > sin^2(sigma/2); the cone keeps this much more.
constexpr double kExistenceReserve = 1.05;
/// Up to this angle the Taylor polynomials below are exact to rounding (0.2^13/13! < 2^-60); most
/// headings differ less from the adjacent circle's, and the library's sine costs three times more.
constexpr double kTaylorReach = 0.2;
}  // namespace

LinkModel::LinkModel(const ChainProblem& problem)
    : links_(problem.chords.size()), nodes_(problem.circles.size()) {
  set_lengths(problem);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    Link& l = links_[i];
    l.h = problem.chords[i].length;
    l.omega = problem.chords[i].omega;
    l.alpha = -problem.circles[i].eta_out;
    l.beta = problem.circles[i + 1].eta_in;
    l.sa = std::sin(l.alpha);
    l.ca = std::cos(l.alpha);
    l.sb = std::sin(l.beta);
    l.cb = std::cos(l.beta);
    l.ka = 0.5 * l.h / nodes_[i].length;
    l.kb = 0.5 * l.h / nodes_[i + 1].length;
    l.sigma = l.alpha + l.beta;
    l.sin_sigma = std::sin(l.sigma);
    l.cos_sigma = std::cos(l.sigma);
    l.direction = problem.direction[i];
    l.cone = problem.cone[i];
  }
  set_sizes(problem);
  set_fixed(problem);
}

void LinkModel::set_lengths(const ChainProblem& problem) {
  const std::size_t n = nodes_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double before = problem.chords[i > 0 ? i - 1 : 0].length;
    const double after = problem.chords[i + 1 < n ? i : n - 2].length;
    nodes_[i].length = 0.5 * (before + after);
    nodes_[i].kappa = problem.circles[i].kappa;
  }
}

/// Expected rates of curvature from differences of the adjacent circles, and from them the size
/// and weight of every link.
void LinkModel::set_sizes(const ChainProblem& problem) {
  const std::size_t m = links_.size();
  std::vector<double> rate(m, 0.0);
  for (std::size_t i = 1; i + 1 < m; ++i) {
    const double reach = (links_[i - 1].h + links_[i].h + links_[i + 1].h) / 3.0;
    rate[i] = (nodes_[i + 1].kappa - nodes_[i].kappa) / reach;
  }
  if (m >= 3) {
    rate[0] = rate[1];
    rate[m - 1] = rate[m - 2];
  }
  const auto magnitude = [&](std::size_t i) { return std::abs(rate[i]); };
  double largest_rate = 0.0;
  for (std::size_t i = 0; i < m; ++i) largest_rate = std::max(largest_rate, magnitude(i));
  for (std::size_t i = 0; i < m; ++i) {
    Link& l = links_[i];
    const double around = 0.5 * (magnitude(i > 0 ? i - 1 : i) + magnitude(i + 1 < m ? i + 1 : i));
    // a vertex inside the link can make its own difference vanish by accident
    double typical = std::max(magnitude(i), around);
    if (typical == 0.0) typical = largest_rate > 0.0 ? largest_rate : 1.0 / (l.h * l.h);
    l.size = typical * l.h * l.h / 3.0;
    l.inverse_size = 1.0 / l.size;
    l.energy = l.inverse_size * l.inverse_size;
    total_weight_ += l.cone == Cone::kNone ? 0.0 : 1.0;
  }
  if (problem.least_change) weigh_by_change();
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    Node& n = nodes_[i];
    const bool first = i == 0, last = i == m;
    const bool monotone = first || last || problem.direction[i - 1] == problem.direction[i];
    const double before = rate[first ? 0 : i - 1], after = rate[last ? m - 1 : i];
    // harmonic mean: never steeper than the gentler side
    n.rate = monotone && before * after > 0.0 ? 2.0 * before * after / (before + after) : 0.0;
    n.sign = problem.nodes[i].curvature_sign;
    n.sign_size = links_[first ? 0 : i - 1].size + links_[last ? m - 1 : i].size;
    if (n.sign != 0.0) total_weight_ += kSignWeight;
  }
}

/// The form of a link over h^3 is its integral of (d kappa / d s)^2; all together weigh as much as
/// they did.
void LinkModel::weigh_by_change() {
  double sum = 0.0, cubes = 0.0;
  for (const Link& l : links_) {
    sum += l.energy;
    cubes += 1.0 / (l.h * l.h * l.h);
  }
  for (Link& l : links_) l.energy = sum / cubes / (l.h * l.h * l.h);
}

void LinkModel::set_fixed(const ChainProblem& problem) {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    Node& n = nodes_[i];
    const NodeData& data = problem.nodes[i];
    if (data.theta) {
      n.fix_phi = true;
      n.phi = turn_between(tangent(i), *data.theta);
    }
    if (data.kappa) {
      n.fix_p = true;
      n.p = (*data.kappa - n.kappa) * n.length;
      n.fixed_kappa = *data.kappa;
      n.sign = 0.0;
    }
  }
}

/// A cubic with constant rate of curvature through the neighbours: its curvature and heading
/// against the circle through the three points (docs/methods/chain.md).
std::vector<double> LinkModel::starting_guess() const {
  const std::size_t n = nodes_.size();
  std::vector<double> x(2 * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const Node& node = nodes_[i];
    const double a = links_[i > 0 ? i - 1 : 0].h, b = links_[i + 1 < n ? i : n - 2].h;
    double phi = -node.rate * a * b / 6.0;
    double change = -node.rate * (b - a) / 3.0;
    if (i == 0 && n > 2) {
      const double b1 = links_[1].h;
      phi = node.rate * a * (a + b1) / 6.0;
      change = -node.rate * (2.0 * a + b1) / 3.0;
    } else if (i + 1 == n && n > 2) {
      const double a1 = links_[n - 3].h;
      phi = node.rate * b * (a1 + b) / 6.0;
      change = node.rate * (2.0 * b + a1) / 3.0;
    }
    if (node.sign != 0.0 && node.sign * (node.kappa + change) <= 0.0) {
      const double kept = -0.8 * node.kappa / change;  // four fifths of the way to zero curvature
      phi *= kept;
      change *= kept;
    }
    x[2 * i] = node.fix_phi ? node.phi : phi;
    x[2 * i + 1] = node.fix_p ? node.p : change * node.length;
  }
  return x;
}

std::vector<double> LinkModel::from_elements(const std::vector<Element>& elements) const {
  std::vector<double> x(2 * nodes_.size());
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    x[2 * i] = node.fix_phi ? node.phi : turn_between(tangent(i), elements[i].theta);
    x[2 * i + 1] = node.fix_p ? node.p : (elements[i].kappa - node.kappa) * node.length;
  }
  return x;
}

double LinkModel::tangent(std::size_t node) const {
  return node < links_.size() ? links_[node].omega + links_[node].alpha
                              : links_[node - 1].omega + links_[node - 1].beta;
}

LinkModel::Trig LinkModel::trig(double phi) {
  const double x = 0.5 * phi, y = x * x;
  double s = 0.0, c = 1.0;
  if (std::abs(x) < kTaylorReach) {
    s = x * (1.0 + y * (-1.0 / 6 +
                        y * (1.0 / 120 + y * (-1.0 / 5040 + y * (1.0 / 362880 - y / 39916800)))));
    c = 1.0 +
        y * (-0.5 + y * (1.0 / 24 + y * (-1.0 / 720 + y * (1.0 / 40320 +
                                                           y * (-1.0 / 3628800 + y / 479001600)))));
  } else {
    s = std::sin(x);
    c = std::cos(x);
  }
  return {2.0 * s * c, 2.0 * s * s, 1.0 - 2.0 * s * s};
}

LinkModel::State LinkModel::state(const Link& l, const Trig& a, const Trig& b, double phi_a,
                                  double p_a, double phi_b, double p_b) {
  State s{};
  s.A = l.ka * p_a + l.ca * a.sin - l.sa * a.versin;
  s.B = l.kb * p_b - l.cb * b.sin + l.sb * b.versin;
  s.sigma = l.sigma + phi_a + phi_b;
  const double sine = a.sin * b.cos + a.cos * b.sin, cosine = a.cos * b.cos - a.sin * b.sin;
  s.sin_sigma = l.sin_sigma * cosine + l.cos_sigma * sine;
  s.cos_sigma = l.cos_sigma * cosine - l.sin_sigma * sine;
  s.dA = l.ca * a.cos - l.sa * a.sin;
  s.dB = l.cb * b.cos - l.sb * b.sin;
  return s;
}

ConeVariables LinkModel::variables(const State& s) {
  return {s.B - s.A, s.A + s.B, s.sigma, s.sin_sigma, s.cos_sigma};
}

ConeRoom LinkModel::room(const Link& l, const ConeVariables& v, double slack) {
  return cone_room(v, cone_width(l.cone, v, kExistenceReserve), l.direction, l.size, slack);
}

/// From m, q, sigma to heading and curvature at both ends of a link.
void LinkModel::scatter(const ConeTerms& v, const Link& l, const State& s, NewtonSystem::Block& a,
                        NewtonSystem::Block& b) {
  const double ca = s.dA, cb = s.dB, ka = l.ka, kb = l.kb;
  const double gA = v.gq - v.gm, gB = v.gq + v.gm;  // by A and B, as m = B - A, q = A + B
  const double hAA = v.hmm - 2.0 * v.hmq + v.hqq, hBB = v.hmm + 2.0 * v.hmq + v.hqq;
  const double hAB = v.hqq - v.hmm, hAs = v.hqs - v.hms, hBs = v.hqs + v.hms;
  const double zA = v.zq - v.zm, zB = v.zq + v.zm;
  a.g0 += ca * gA + v.gs;
  a.g1 += ka * gA;
  b.g0 += -cb * gB + v.gs;
  b.g1 += kb * gB;
  a.a00 += ca * ca * hAA + 2.0 * ca * hAs + v.hss;
  a.a10 += ka * (ca * hAA + hAs);
  a.a11 += ka * ka * hAA;
  b.a00 += cb * cb * hBB - 2.0 * cb * hBs + v.hss;
  b.a10 += kb * (hBs - cb * hBB);
  b.a11 += kb * kb * hBB;
  a.o00 += -ca * cb * hAB + ca * hAs - cb * hBs + v.hss;
  a.o01 += kb * (ca * hAB + hBs);
  a.o10 += ka * (hAs - cb * hAB);
  a.o11 += ka * kb * hAB;
  a.c0 += ca * zA + v.zs;
  a.c1 += ka * zA;
  b.c0 += -cb * zB + v.zs;
  b.c1 += kb * zB;
}

/// Barrier of the curvature's sign at the nodes; returns its sum of logarithms, minus infinity
/// where a sign is wrong. Fixed variables are taken out of the system.
double LinkModel::add_nodes(const std::vector<double>& x, double slack, double barrier,
                            NewtonSystem& system) const {
  LogSum signs;
  const double w = barrier * kSignWeight;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& node = nodes_[i];
    if (node.sign != 0.0) {
      const double v = signed_curvature(node, x[2 * i + 1], slack);
      if (!(v > 0.0)) return -kInfinity;
      const double rv = w / v, rvv = rv / v;
      signs.add(v / node.sign_size);
      system[i].g1 -= rv * node.sign;
      system[i].a11 += rvv;
      system[i].c1 += rvv * node.sign * node.sign_size;
      system.slack_gradient -= rv * node.sign_size;
      system.slack_hessian += rvv * node.sign_size * node.sign_size;
    }
    // a node between links without cones takes part in nothing: keep its block regular
    if (node.fix_phi || system[i].a00 <= 0.0) system.fix(i, 0);
    if (node.fix_p || system[i].a11 <= 0.0) system.fix(i, 1);
  }
  return signs.value();
}

double LinkModel::signed_curvature(const Node& node, double p, double slack) {
  return node.sign * (node.kappa * node.length + p) + slack * node.sign_size;
}

double LinkModel::assemble(const std::vector<double>& x, double slack, double energy,
                           double barrier, NewtonSystem& system) const {
  const std::size_t n = nodes_.size();
  system.reset(n);
  double value = 0.0;
  LogSum cones, sigmas;
  Trig ta = trig(x[0]);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Link& l = links_[i];
    const Trig tb = trig(x[2 * i + 2]);
    const State s = state(l, ta, tb, x[2 * i], x[2 * i + 1], x[2 * i + 2], x[2 * i + 3]);
    ta = tb;
    if (l.cone == Cone::kNone) continue;
    const ConeVariables v = variables(s);
    const ConeRoom c = room(l, v, slack);
    if (!c.inside()) return kInfinity;
    value += energy * l.energy * kFairEnergy.of(v);
    cones.add(c.f * l.inverse_size * l.inverse_size);
    sigmas.add(c.u * l.inverse_size);
    const ConeTerms terms =
        cone_terms(v, c, l.direction, l.size, kFairEnergy, energy * l.energy, barrier);
    scatter(terms, l, s, system[i], system[i + 1]);
    system.slack_gradient += terms.slack_gradient;
    system.slack_hessian += terms.slack_hessian;
  }
  const double signs = add_nodes(x, slack, barrier, system);
  return value - barrier * (cones.value() + kSigmaWeight * sigmas.value() + kSignWeight * signs);
}

double LinkModel::merit(const std::vector<double>& x, double slack, double energy,
                        double barrier) const {
  const std::size_t n = nodes_.size();
  double value = 0.0;
  LogSum cones, sigmas, signs;
  Trig ta = trig(x[0]);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Link& l = links_[i];
    const Trig tb = trig(x[2 * i + 2]);
    const State s = state(l, ta, tb, x[2 * i], x[2 * i + 1], x[2 * i + 2], x[2 * i + 3]);
    ta = tb;
    if (l.cone == Cone::kNone) continue;
    const ConeVariables v = variables(s);
    const ConeRoom c = room(l, v, slack);
    if (!c.inside()) return kInfinity;
    value += energy * l.energy * kFairEnergy.of(v);
    cones.add(c.f * l.inverse_size * l.inverse_size);
    sigmas.add(c.u * l.inverse_size);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Node& node = nodes_[i];
    if (node.sign == 0.0) continue;
    const double v = signed_curvature(node, x[2 * i + 1], slack);
    if (!(v > 0.0)) return kInfinity;
    signs.add(v / node.sign_size);
  }
  return value -
         barrier * (cones.value() + kSigmaWeight * sigmas.value() + kSignWeight * signs.value());
}

bool LinkModel::inside(const std::vector<double>& x, double slack) const {
  return std::isfinite(merit(x, slack, 0.0, 1.0));
}

std::vector<Element> LinkModel::elements(const std::vector<Vec2>& points,
                                         const std::vector<double>& x) const {
  std::vector<Element> out(nodes_.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Node& n = nodes_[i];
    out[i] = {points[i], tangent(i) + x[2 * i],
              n.fix_p ? n.fixed_kappa : n.kappa + x[2 * i + 1] / n.length};
  }
  return out;
}

std::vector<LinkState> LinkModel::links(const std::vector<double>& x) const {
  std::vector<LinkState> out(links_.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Link& l = links_[i];
    const double pa = x[2 * i], pb = x[2 * i + 2];
    const State s = state(l, trig(pa), trig(pb), pa, x[2 * i + 1], pb, x[2 * i + 3]);
    out[i] = {l.h, l.omega, l.alpha + pa, l.beta + pb, s.A, s.B, s.sigma};
  }
  return out;
}

LinkModel::LinkJet LinkModel::jet(std::size_t link, const std::vector<double>& x) const {
  const Link& l = links_[link];
  const double pa = x[2 * link], pb = x[2 * link + 2];
  const State s = state(l, trig(pa), trig(pb), pa, x[2 * link + 1], pb, x[2 * link + 3]);
  return {{l.h, l.omega, l.alpha + pa, l.beta + pb, s.A, s.B, s.sigma}, s.dA, l.ka, -s.dB, l.kb};
}

double LinkModel::curvature_room(std::size_t node, const std::vector<double>& x) const {
  const Node& n = nodes_[node];
  return n.sign == 0.0 ? 1.0 : signed_curvature(n, x[2 * node + 1], 0.0);
}

std::vector<double> LinkModel::link_forces(const std::vector<double>& x, double slack) const {
  std::vector<double> force(links_.size(), 0.0);
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& l = links_[i];
    if (l.cone == Cone::kNone) continue;
    const double pa = x[2 * i], pb = x[2 * i + 2];
    const State s = state(l, trig(pa), trig(pb), pa, x[2 * i + 1], pb, x[2 * i + 3]);
    const ConeRoom c = room(l, variables(s), slack);
    force[i] = 2.0 * c.t * l.size / c.f;
  }
  return force;
}

double LinkModel::point_move(std::size_t link) const {
  const Link& l = links_[link];
  return 0.25 * l.h * l.size;
}

}  // namespace obvid::chain_detail
