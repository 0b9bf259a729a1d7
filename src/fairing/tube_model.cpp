// SPDX-License-Identifier: Apache-2.0
#include "tube_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace obvid::fairing_detail {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// The cone of mere existence keeps this much more than the bare condition.
constexpr double kExistenceReserve = 1.0001;

/// atan2(sine, cosine) for a unit vector, by its series where the angle is small.
double angle_of(double sine, double cosine) {
  constexpr double kSmall = 0.1;  // rad: the first term left out is below 1e-16
  if (cosine > 0.0 && std::abs(sine) < kSmall) {
    const double y = sine * sine;
    return sine *
           (1.0 + y * (1.0 / 6 +
                       y * (3.0 / 40 +
                            y * (15.0 / 336 + y * (105.0 / 3456 +
                                                   y * (945.0 / 42240 + y * 10395.0 / 599040))))));
  }
  return std::atan2(sine, cosine);
}

/// Hermite's quintic polynomials of both slopes and second derivatives, with derivatives. Before
/// and behind the link the curve goes on along its end tangents.
struct Quintic {
  double h1 = 0.0, h2 = 0.0, h4 = 0.0, h5 = 0.0, d1 = 0.0, d2 = 0.0, d4 = 0.0, d5 = 0.0;
};

Quintic quintic(double u) {
  Quintic q;
  if (u < 0.0) {
    q.h1 = u;
    q.d1 = 1.0;
    return q;
  }
  if (u > 1.0) {
    q.h4 = u - 1.0;
    q.d4 = 1.0;
    return q;
  }
  const double v = u * u, c = v * u;
  q.h1 = u + c * (-6.0 + u * (8.0 - 3.0 * u));
  q.h4 = c * (-4.0 + u * (7.0 - 3.0 * u));
  q.h2 = 0.5 * v * (1.0 + u * (-3.0 + u * (3.0 - u)));
  q.h5 = 0.5 * c * (1.0 + u * (-2.0 + u));
  q.d1 = 1.0 + v * (-18.0 + u * (32.0 - 15.0 * u));
  q.d4 = v * (-12.0 + u * (28.0 - 15.0 * u));
  q.d2 = u * (1.0 + u * (-4.5 + u * (6.0 - 2.5 * u)));
  q.d5 = v * (1.5 + u * (-4.0 + 2.5 * u));
  return q;
}

}  // namespace

TubeModel::TubeModel(const Tube& tube, const std::vector<std::int8_t>& direction, Cone cone,
                     const LinkEnergy& energy)
    : tube_(tube), direction_(direction), cone_(cone), energy_(energy), nodes_(tube.nodes.size()) {
  state_.resize(nodes_);
}

void TubeModel::place_nodes(const State& x) {
  for (std::size_t i = 0; i < nodes_; ++i) state_[i] = place(node(i), &x[kPerNode * i]);
}

TubeModel::LinkJet TubeModel::link_jet(std::size_t i) const {
  const std::size_t j = next(i);
  const EndJet a = end_jet(node(i), state_[i], node(i).after);
  const EndJet b = end_jet(node(j), state_[j], -node(j).before);
  LinkJet out;
  for (std::size_t k = 0; k < kPerNode; ++k) {
    out.start[k] = a.position[k];
    out.chord[k] = -a.position[k];
    out.chord[kPerNode + k] = b.position[k];
    out.theta_a[k] = a.theta[k];
    out.kappa_a[k] = a.kappa[k];
    out.theta_b[kPerNode + k] = b.theta[k];
    out.kappa_b[kPerNode + k] = b.kappa[k];
  }
  return out;
}

TubeModel::LinkView TubeModel::link_view(std::size_t i) const {
  const NodeEnd& a = state_[i].out;
  const NodeEnd& b = state_[next(i)].in;
  LinkView s;
  const Vec2 chord = b.position - a.position;
  s.h = norm(chord);
  s.along = (1.0 / s.h) * chord;
  s.sin_alpha = cross(s.along, a.tangent);
  s.cos_alpha = dot(s.along, a.tangent);
  s.sin_beta = cross(s.along, b.tangent);
  s.cos_beta = dot(s.along, b.tangent);
  const double A = 0.5 * s.h * a.kappa + s.sin_alpha;
  const double B = 0.5 * s.h * b.kappa - s.sin_beta;
  ConeVariables& v = s.cone;
  v.m = B - A;
  v.q = A + B;
  v.sin_sigma = s.sin_alpha * s.cos_beta + s.cos_alpha * s.sin_beta;
  v.cos_sigma = s.cos_alpha * s.cos_beta - s.sin_alpha * s.sin_beta;
  v.sigma = angle_of(v.sin_sigma, v.cos_sigma);
  return s;
}

ConeRoom TubeModel::room(std::size_t i, const LinkView& s, double slack) const {
  return cone_room(s.cone, cone_width(cone_, s.cone, kExistenceReserve), direction_[i],
                   tube_.size[i], slack);
}

/// Headings farther from the chord than this are no spirals' any more; between nodes with points to
/// pass the curve must be a graph over its chord.
double TubeModel::least_cosine(std::size_t link) const {
  constexpr double kFarthest = -0.95;
  return tube_.first_row[link] == tube_.first_row[link + 1] ? kFarthest : 0.0;
}

double TubeModel::row_weight(std::size_t link) const {
  return 1.0 / static_cast<double>(tube_.first_row[link + 1] - tube_.first_row[link]);
}

double TubeModel::barrier_parameter() const {
  constexpr double kCone = 2.0, kTube = 2.0;
  return static_cast<double>(link_count()) * (kCone + kSigmaWeight) +
         kTube * static_cast<double>(nodes_ + link_count()) + kSignWeight;
}

void TubeModel::add_cone(std::size_t i, const LinkView& s, double slack, const Weights& w,
                         LinkTerms& out) const {
  const double z = tube_.size[i];
  const ConeRoom c = w.cone > 0.0 ? room(i, s, slack) : ConeRoom{};
  const ConeTerms v = cone_terms(s.cone, c, direction_[i], z, energy_, w.energy / (z * z), w.cone);
  out.slack_gradient = v.slack_gradient;
  out.slack_hessian = v.slack_hessian;
  const LinkJet jet = link_jet(i);
  const Vec2 normal = left_normal(s.along);
  const double ka = state_[i].out.kappa, kb = state_[next(i)].in.kappa;
  double M[6], Q[6], S[6], wm[6], wq[6], ws[6];
  for (std::size_t k = 0; k < 6; ++k) {
    const double turn = dot(jet.chord[k], normal) / s.h;   // of the chord's heading
    const double half = 0.5 * dot(jet.chord[k], s.along);  // of half its length
    const double A = ka * half + 0.5 * s.h * jet.kappa_a[k] + s.cos_alpha * (jet.theta_a[k] - turn);
    const double B = kb * half + 0.5 * s.h * jet.kappa_b[k] - s.cos_beta * (jet.theta_b[k] - turn);
    M[k] = B - A;
    Q[k] = A + B;
    S[k] = jet.theta_a[k] + jet.theta_b[k] - 2.0 * turn;
    wm[k] = v.hmm * M[k] + v.hmq * Q[k] + v.hms * S[k];
    wq[k] = v.hmq * M[k] + v.hqq * Q[k] + v.hqs * S[k];
    ws[k] = v.hms * M[k] + v.hqs * Q[k] + v.hss * S[k];
  }
  for (std::size_t k = 0; k < 6; ++k) {
    out.gradient[k] += v.gm * M[k] + v.gq * Q[k] + v.gs * S[k];
    out.slack_column[k] += v.zm * M[k] + v.zq * Q[k] + v.zs * S[k];
    for (std::size_t l = 0; l <= k; ++l) {
      out.hessian[k][l] += M[k] * wm[l] + Q[k] * wq[l] + S[k] * ws[l];
    }
  }
}

/// Lateral distance of a measured point from the quintic Hermite curve with the link's data.
TubeModel::RowValue TubeModel::row_value(const TubeRow& row, const LinkView& s, const NodeEnd& a,
                                         const NodeEnd& b) const {
  const Vec2 from_start = row.point - a.position;
  const double x = dot(s.along, from_start), y = cross(s.along, from_start);
  RowValue out{};
  out.u = x / s.h;
  const Quintic q = quintic(out.u);
  out.h1 = q.h1;
  out.h2 = q.h2;
  out.h4 = q.h4;
  out.h5 = q.h5;
  const double ca = 1.0 / s.cos_alpha, cb = 1.0 / s.cos_beta;
  const double ta = s.sin_alpha * ca, tb = s.sin_beta * cb;
  const double ka = a.kappa * ca * ca * ca, kb = b.kappa * cb * cb * cb;
  const double bend = s.h * (out.h2 * ka + out.h5 * kb);
  const double curve = s.h * (out.h1 * ta + out.h4 * tb + bend);
  out.by_h = out.h1 * ta + out.h4 * tb + 2.0 * bend;
  out.slope = q.d1 * ta + q.d4 * tb + s.h * (q.d2 * ka + q.d5 * kb);
  out.x = x;
  out.y = y;
  out.residual = (y - curve) / row.reach;
  return out;
}

/// Barrier -log(T^2 - r^2) of a residual in a tube of half width T: derivatives by r and T.
TubeModel::WallTerms TubeModel::wall(double r, double weight) const {
  const double t = half_width_, f = 1.0 / (t * t - r * r);
  const double g = 2.0 * weight * f, gg = 2.0 * g * f;
  return {g * r, g + gg * r * r, -g * t, gg * t * t - g, -gg * r * t};
}

void TubeModel::add_rows(std::size_t i, const LinkView& s, double weight, LinkTerms& out) const {
  const std::size_t first = tube_.first_row[i], last = tube_.first_row[i + 1];
  if (first == last) return;
  const LinkJet jet = link_jet(i);
  const Vec2 normal = left_normal(s.along);
  const double ca = 1.0 / s.cos_alpha, cb = 1.0 / s.cos_beta;
  const double w = weight * row_weight(i);
  for (std::size_t k = first; k < last; ++k) {
    const TubeRow& row = tube_.rows[k];
    const RowValue v = row_value(row, s, state_[i].out, state_[next(i)].in);
    // by both angles to the chord, both curvatures, the chord itself and the place along it
    const NodeEnd& from = state_[i].out;
    const NodeEnd& to = state_[next(i)].in;
    const double h2 = s.h * s.h;
    const double ka = h2 * v.h2 * ca * ca * ca, kb = h2 * v.h5 * cb * cb * cb;
    const double da = s.h * v.h1 * ca * ca + 3.0 * ka * from.kappa * s.sin_alpha * ca;
    const double db = s.h * v.h4 * cb * cb + 3.0 * kb * to.kappa * s.sin_beta * cb;
    const double scale = -1.0 / row.reach;
    double J[6];
    for (std::size_t p = 0; p < 6; ++p) {
      const double turn = dot(jet.chord[p], normal) / s.h, longer = dot(jet.chord[p], s.along);
      const double ahead = turn * v.y - dot(jet.start[p], s.along) - v.u * longer;
      const double lift = dot(jet.start[p], normal) + turn * v.x;
      J[p] =
          scale * (lift + da * (jet.theta_a[p] - turn) + db * (jet.theta_b[p] - turn) +
                   ka * jet.kappa_a[p] + kb * jet.kappa_b[p] + v.by_h * longer + v.slope * ahead);
    }
    const WallTerms t = wall(v.residual, w);
    for (std::size_t p = 0; p < 6; ++p) {
      out.gradient[p] += t.g * J[p];
      const double hp = t.h * J[p];
      for (std::size_t q = 0; q <= p; ++q) out.hessian[p][q] += hp * J[q];
      if (slack_widens_) out.slack_column[p] += t.mixed * J[p];
    }
    if (slack_widens_) {
      out.slack_gradient += t.width_g;
      out.slack_hessian += t.width_h;
    }
  }
}

/// Points on a primitive: their distances from its circle.
void TubeModel::add_primitive(std::size_t i, double weight, bool with_slack,
                              BorderedSystem& system) const {
  const TubeNode& n = node(i);
  const double w = weight / static_cast<double>(n.last_on - n.first_on);
  Vec3 gradient{};
  Mat3 hessian{};
  for (std::size_t k = n.first_on; k < n.last_on; ++k) {
    const TubeRow& row = tube_.on_primitives[k];
    const CircleDistance d = circle_distance(n, state_[i], row.point);
    const double unit = 1.0 / row.reach;
    const WallTerms t = wall(d.value * unit, w);
    for (std::size_t p = 0; p < kPerNode; ++p) {
      const double slope = unit * d.slope[p];
      gradient[p] += t.g * slope;
      for (std::size_t q = 0; q <= p; ++q) hessian[p][q] += t.h * slope * unit * d.slope[q];
      if (with_slack && slack_widens_) system.add_to_slack_column(i, p, t.mixed * slope);
    }
    if (with_slack && slack_widens_) system.add_slack(t.width_g, t.width_h);
  }
  system.add(i, gradient, hessian);
}

/// Sum of the logarithms of the room that points on a primitive have; -infinity outside.
double TubeModel::primitive_room(std::size_t i) const {
  const TubeNode& n = node(i);
  LogSum sum;
  for (std::size_t k = n.first_on; k < n.last_on; ++k) {
    const TubeRow& row = tube_.on_primitives[k];
    const double r = circle_distance(n, state_[i], row.point).value / row.reach;
    if (!(std::abs(r) < half_width_)) return -kInfinity;
    sum.add(half_width_ * half_width_ - r * r);
  }
  return sum.value() / static_cast<double>(n.last_on - n.first_on);
}

void TubeModel::add_nodes(const State& x, double slack, const Weights& w, bool with_slack,
                          BorderedSystem& system) const {
  for (std::size_t i = 0; i < nodes_; ++i) {
    const TubeNode& n = node(i);
    const WallTerms t = wall(x[kPerNode * i], w.tube);
    system.add(i, 0, t.g, t.h);
    if (with_slack && slack_widens_) {
      system.add_slack(t.width_g, t.width_h);
      system.add_to_slack_column(i, 0, t.mixed);
    }
    if (n.sign != 0.0 && w.cone > 0.0) {
      const double v = n.sign * (n.kappa * n.length + x[kPerNode * i + 2]) + slack;
      system.add(i, 2, -kSignWeight * w.cone * n.sign / v, kSignWeight * w.cone / (v * v));
      if (with_slack) {
        system.add_slack(-kSignWeight * w.cone / v, kSignWeight * w.cone / (v * v));
        system.add_to_slack_column(i, 2, kSignWeight * w.cone * n.sign / (v * v));
      }
    }
    if (n.is_primitive()) add_primitive(i, w.tube, with_slack, system);
    if (n.bounds_heading()) {
      const double up = 1.0 / (n.turn_high - x[kPerNode * i + 1]);
      const double down = 1.0 / (x[kPerNode * i + 1] - n.turn_low);
      system.add(i, 1, w.tube * (up - down), w.tube * (up * up + down * down));
    }
    if (n.reach == 0.0) system.fix(i, 0);
    if (n.fix_theta) system.fix(i, 1);
    if (n.fix_kappa || !(system.diagonal(i, 2) > 0.0)) system.fix(i, 2);
  }
}

void TubeModel::assemble(const State& x, double slack, const Weights& w, bool with_slack,
                         BorderedSystem& system) {
  system.reset(nodes_, tube_.closed, with_slack);
  place_nodes(x);
  half_width_ = slack_widens_ ? 1.0 + slack : 1.0;
  for (std::size_t i = 0; i < link_count(); ++i) {
    const LinkView s = link_view(i);
    LinkTerms terms;
    add_cone(i, s, slack, w, terms);
    add_rows(i, s, w.tube, terms);
    system.add(i, terms);
  }
  add_nodes(x, slack, w, with_slack, system);
}

double TubeModel::merit(const State& x, double slack, const Weights& w) {
  place_nodes(x);
  half_width_ = slack_widens_ ? 1.0 + slack : 1.0;
  if (!(half_width_ > 0.0)) return kInfinity;
  const double square = half_width_ * half_width_;
  double value = 0.0, primitives = 0.0;
  LogSum cones, sigmas, signs, nodes;
  for (std::size_t i = 0; i < nodes_; ++i) {
    const TubeNode& n = node(i);
    const double e = x[kPerNode * i];
    const double room = square - e * e;
    if (!(room > 0.0)) return kInfinity;
    nodes.add(room);
    if (n.is_primitive()) {
      primitives += primitive_room(i);
      if (!(primitives > -kInfinity)) return kInfinity;
    }
    if (n.bounds_heading()) {
      const double turn = x[kPerNode * i + 1], half = 0.5 * (n.turn_high - n.turn_low);
      if (!(turn > n.turn_low && turn < n.turn_high)) return kInfinity;
      nodes.add((turn - n.turn_low) * (n.turn_high - turn) / (half * half));
    }
    if (n.sign != 0.0 && w.cone > 0.0) {
      const double v = n.sign * (n.kappa * n.length + x[kPerNode * i + 2]) + slack;
      if (!(v > 0.0)) return kInfinity;
      signs.add(v);
    }
  }
  double rows = 0.0;
  for (std::size_t i = 0; i < link_count(); ++i) {
    const LinkView s = link_view(i);
    if (!(std::min(s.cos_alpha, s.cos_beta) > least_cosine(i))) return kInfinity;
    const double z = tube_.size[i];
    value += w.energy / (z * z) * energy_.of(s.cone);
    if (w.cone > 0.0) {
      const ConeRoom c = room(i, s, slack);
      if (!c.inside()) return kInfinity;
      cones.add(c.f / (z * z));
      sigmas.add(c.u / z);
    }
    const std::size_t first = tube_.first_row[i];
    const std::size_t last = tube_.first_row[i + 1];
    if (first == last) continue;
    LogSum link_rows;
    const NodeEnd& a = state_[i].out;
    const NodeEnd& b = state_[next(i)].in;
    for (std::size_t k = first; k < last; ++k) {
      const double r = row_value(tube_.rows[k], s, a, b).residual;
      const double room = square - r * r;
      if (!(room > 0.0)) return kInfinity;
      link_rows.add(room);
    }
    rows += row_weight(i) * link_rows.value();
  }
  return value -
         w.cone * (cones.value() + kSigmaWeight * sigmas.value() + kSignWeight * signs.value()) -
         w.tube * (nodes.value() + rows + primitives);
}

double TubeModel::needed_slack(const State& x) {
  place_nodes(x);
  double slack = 0.0;
  for (std::size_t i = 0; i < link_count(); ++i) {
    const LinkView s = link_view(i);
    const double d = direction_[i], z = tube_.size[i];
    const ConeVariables& v = s.cone;
    const double width = cone_width(cone_, v, kExistenceReserve).value;
    slack = std::max({slack, (std::hypot(v.q, width) - d * v.m) / z, -d * v.sigma / z});
  }
  for (std::size_t i = 0; i < nodes_; ++i) {
    const TubeNode& n = node(i);
    if (n.sign != 0.0) {
      slack = std::max(slack, -n.sign * (n.kappa * n.length + x[kPerNode * i + 2]));
    }
  }
  return slack;
}

std::vector<double> TubeModel::node_uses(const State& x) {
  place_nodes(x);
  std::vector<double> use(nodes_, 0.0);
  const auto take = [&](std::size_t i, double r) {
    if (!(std::abs(r) <= use[i])) use[i] = std::isnan(r) ? kInfinity : std::abs(r);
  };
  for (std::size_t i = 0; i < nodes_; ++i) {
    take(i, x[kPerNode * i]);
    for (std::size_t k = node(i).first_on; k < node(i).last_on; ++k) {
      const TubeRow& row = tube_.on_primitives[k];
      const double d = circle_distance(node(i), state_[i], row.point).value;
      take(i, d / row.reach);
    }
  }
  for (std::size_t i = 0; i < link_count(); ++i) {
    const LinkView s = link_view(i);
    for (std::size_t k = tube_.first_row[i]; k < tube_.first_row[i + 1]; ++k) {
      const double r = row_value(tube_.rows[k], s, state_[i].out, state_[next(i)].in).residual;
      take(i, r);
    }
  }
  return use;
}

double TubeModel::tube_use(const State& x) {
  const std::vector<double> use = node_uses(x);
  return *std::max_element(use.begin(), use.end());
}

std::vector<double> TubeModel::link_forces(const State& x, double slack) {
  place_nodes(x);
  std::vector<double> force(link_count());
  for (std::size_t i = 0; i < force.size(); ++i) {
    const ConeRoom c = room(i, link_view(i), slack);
    force[i] = 2.0 * c.t * tube_.size[i] / c.f;
  }
  return force;
}

std::vector<TubeModel::LinkValue> TubeModel::link_values(const State& x) {
  place_nodes(x);
  std::vector<LinkValue> out(link_count());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const ConeVariables v = link_view(i).cone;
    out[i] = {v.m, v.q, v.sigma};
  }
  return out;
}

}  // namespace obvid::fairing_detail
