// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_builders/internal/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "check_joints.h"
#include "check_lines.h"
#include "check_trims.h"
#include "climb.h"
#include "obvid/numeric/internal/gauss.h"
#include "obvid/surface/internal/topology.h"
#include "obvid/surface/internal/trim.h"

namespace obvid {
namespace {

/// Order of continuity that the multiplicities of inner knots leave.
int order_of(const std::vector<double>& knots, int degree) {
  int order = degree;
  const auto p = static_cast<std::ptrdiff_t>(degree);
  for (auto at = knots.begin() + p + 1; at < knots.end() - p - 1;) {
    const auto next = std::upper_bound(at, knots.end() - p - 1, *at);
    order = std::min(order, degree - static_cast<int>(next - at));
    at = next;
  }
  return order;
}

/// What is looked for: the place where a quantity is greatest (`sign` 1) or least (-1).
struct Extreme {
  double SurfaceCurvature::*quantity;
  double sign;
};

/// The extreme near that place. Not to where du x dv shrinks to less than half: the surface ends in
/// a point there, its curvature may have no bound, and nothing but the steps would decide it.
Peak climbed_on(const NurbsSurface& s, const TrimRegion* region, const Extreme& one,
                const Peak& from) {
  constexpr double kLeastArea = 0.5;
  const auto area_of = [](const SurfaceJet& jet) { return norm(cross(jet.du, jet.dv)); };
  const double least = kLeastArea * area_of(evaluate(s, from.u.at, from.v.at));
  return climbed(
      [&](double u, double v) {
        if (region != nullptr && !region->contains(u, v)) return std::nan("");
        const SurfaceJet jet = evaluate(s, u, v);
        if (!(area_of(jet) >= least)) return std::nan("");
        return one.sign * curvature(jet).*(one.quantity);
      },
      from);
}

/// From a place beside a border towards it, each step half as far away as the one before.
constexpr int kApproach = 8;

/// A way to the border of a patch: straight at it, or into a corner.
struct Way {
  double u = 0.0, v = 0.0;    ///< the place on the border
  double du = 0.0, dv = 0.0;  ///< from there to the beginning of the way

  [[nodiscard]] SurfaceJet jet(const NurbsSurface& s, int step) const {
    const double part = std::ldexp(1.0, -step);
    return evaluate(s, u + part * du, v + part * dv);
  }
};

/// Ways from the outermost nodes to the border and into the corners.
std::vector<Way> ways_out(const NurbsSurface& s, const std::vector<Node>& us,
                          const std::vector<Node>& vs) {
  const Range u = domain_u(s), v = domain_v(s);
  const std::array u_ends{Way{u.from, 0.0, us.front().at - u.from, 0.0},
                          Way{u.to, 0.0, us.back().at - u.to, 0.0}};
  const std::array v_ends{Way{0.0, v.from, 0.0, vs.front().at - v.from},
                          Way{0.0, v.to, 0.0, vs.back().at - v.to}};
  std::vector<Way> ways;
  for (const Way& end : u_ends) {
    for (const Node& node : vs) ways.push_back({end.u, node.at, end.du, 0.0});
    for (const Way& other : v_ends) ways.push_back({end.u, other.v, end.du, other.dv});
  }
  for (const Way& end : v_ends) {
    for (const Node& node : us) ways.push_back({node.at, end.v, 0.0, end.dv});
  }
  return ways;
}

/// Whether the surface ends in a point there: du x dv shrinks with the distance.
bool vanishes(const NurbsSurface& s, const Way& way) {
  constexpr double kShrunk = 0.02;  // five times what a simple pole leaves
  const auto area_of = [](const SurfaceJet& jet) { return norm(cross(jet.du, jet.dv)); };
  return area_of(way.jet(s, kApproach)) < kShrunk * area_of(way.jet(s, 0));
}

/// What moving control points by their last digits makes of curvatures at the end of a way, 1/unit:
/// as much as a bump of that height on the disc that is left there.
double rounding_on(const NurbsSurface& s, const Way& way) {
  constexpr double kDigits = 2e-12;  // of the coordinates: files have twelve digits or more
  const Vec3 end = evaluate(s, way.u, way.v).point;
  const double distance = norm(way.jet(s, kApproach).point - end);
  const double coordinate = std::max({std::abs(end.x), std::abs(end.y), std::abs(end.z)});
  const double height = kDigits * std::max(coordinate, size_of(s));
  return height / (distance * distance);
}

/// Where a quantity leads on such a way: its last value, or infinity when its steps do not shrink.
/// (Towards a bound as a power p of the distance they shrink by 2^-p; logarithms step evenly.)
/// `rounding`: what the digits of the control points may make of a curvature there, 1/unit.
double led_to(const std::array<SurfaceCurvature, kApproach + 1>& along, const Extreme& one,
              double rounding) {
  constexpr double kShrinks = 0.9;
  constexpr double kRounding = 1e-9;  // of the largest curvature there: of its evaluation
  constexpr std::size_t kLast = kApproach, kMiddle = kLast / 2;
  std::array<double, kApproach + 1> value{};
  for (std::size_t k = 0; k <= kLast; ++k) value[k] = one.sign * along[k].*(one.quantity);
  double largest = std::max(std::abs(along[kLast].k1), std::abs(along[kLast].k2));
  double least = std::max(kRounding * largest, rounding);
  if (one.quantity == &SurfaceCurvature::gaussian) least *= largest;
  bool grows = value[kLast] - value[kMiddle] > least;
  for (std::size_t k = kMiddle; k + 1 < kLast; ++k) {
    const double step = value[k + 1] - value[k];
    grows = grows && step > 0.0 && value[k + 2] - value[k + 1] > kShrinks * step;
  }
  return grows ? std::numeric_limits<double>::infinity() : value[kLast];
}

constexpr std::size_t kWaysUnasked = 64;  // before whoever waits is asked whether to go on

/// Curvature of a patch.
struct Measured {
  CurvatureExtents curvature;
};

SurfacePlace place_of(const NurbsSurface& s, double u, double v) {
  return {u, v, evaluate(s, u, v).point};
}

/// Ends below the rounding of the largest curvature (of its square, for Gaussian curvature) are 0:
/// a cone has none along its lines.
void take_rounding_away(CurvatureExtents& found) {
  // sums of some ten products for each derivative, and as many for the forms of them
  constexpr double kRounding = 64.0 * std::numeric_limits<double>::epsilon();
  const double largest = std::max(std::abs(found.k1.most), std::abs(found.k2.least));
  if (!std::isfinite(largest)) return;
  const auto rounded = [](Extent& extent, double rounding) {
    for (double* end : {&extent.least, &extent.most}) {
      if (std::abs(*end) <= rounding) *end = 0.0;
    }
  };
  rounded(found.gaussian, kRounding * largest * largest);
  for (Extent* extent : {&found.mean, &found.k1, &found.k2}) rounded(*extent, kRounding * largest);
}

/// `region`: what of the surface is there; nothing: all.
Result<Measured> measured(const NurbsSurface& s, const TrimRegion* region, std::size_t n,
                          const RunContext& run) {
  const auto is_there = [&](double u, double v) {
    return region == nullptr || region->contains(u, v);
  };
  constexpr std::array kQuantities{&SurfaceCurvature::gaussian, &SurfaceCurvature::mean,
                                   &SurfaceCurvature::k1, &SurfaceCurvature::k2};
  std::vector<Extreme> extremes;
  for (const auto quantity : kQuantities) {
    extremes.push_back({quantity, -1.0});
    extremes.push_back({quantity, 1.0});
  }
  Measured out;
  const std::vector<Node> along_u = nodes_of(s.knots_u, domain_u(s), n);
  const std::vector<Node> along_v = nodes_of(s.knots_v, domain_v(s), n);
  std::vector<Peaks> peaks(extremes.size(), Peaks(along_u.size(), along_v.size()));
  bool any = false;
  for (std::size_t j = 0; j < along_v.size(); ++j) {
    OBVID_TRY(may_go_on(run));
    const Node& v = along_v[j];
    for (std::size_t i = 0; i < along_u.size(); ++i) {
      const Node& u = along_u[i];
      if (!is_there(u.at, v.at)) continue;
      const SurfaceJet jet = evaluate(s, u.at, v.at);
      const SurfaceCurvature k = curvature(jet);
      if (k.normal == Vec3{}) {
        ++out.curvature.without_normal;
        continue;
      }
      any = true;
      for (std::size_t q = 0; q < extremes.size(); ++q) {
        peaks[q].look_at(extremes[q].sign * k.*(extremes[q].quantity), i, j, u, v);
      }
    }
  }
  if (!any) return out;  // no tangent plane anywhere
  std::vector<double> most(extremes.size(), -std::numeric_limits<double>::infinity());
  std::vector<SurfacePlace> at(extremes.size());
  for (std::size_t q = 0; q < extremes.size(); ++q) {
    for (const Peak& start : peaks[q].highest()) {
      OBVID_TRY(may_go_on(run));
      const Peak top = climbed_on(s, region, extremes[q], start);
      if (!(top.value > most[q])) continue;
      most[q] = top.value;
      at[q] = place_of(s, top.u.at, top.v.at);
    }
  }
  std::size_t ways = 0;
  for (const Way& way : ways_out(s, along_u, along_v)) {
    if (++ways % kWaysUnasked == 0) OBVID_TRY(may_go_on(run));
    if (!is_there(way.u + way.du, way.v + way.dv) || !is_there(way.u, way.v)) continue;
    if (!vanishes(s, way)) continue;
    std::array<SurfaceCurvature, kApproach + 1> along;
    bool tangent = true;
    for (int k = 0; k <= kApproach; ++k) {
      SurfaceCurvature& there = along[static_cast<std::size_t>(k)];
      there = curvature(way.jet(s, k));
      tangent = tangent && !(there.normal == Vec3{});
    }
    const double rounding = rounding_on(s, way);
    for (std::size_t q = 0; tangent && q < most.size(); ++q) {
      const double end = led_to(along, extremes[q], rounding);
      if (!(end > most[q])) continue;
      most[q] = end;
      at[q] = place_of(s, way.u, way.v);
    }
  }
  const auto extent = [&](std::size_t q) {
    return Extent{-most[2 * q], most[2 * q + 1], at[2 * q], at[2 * q + 1]};
  };
  out.curvature.gaussian = extent(0);
  out.curvature.mean = extent(1);
  out.curvature.k1 = extent(2);
  out.curvature.k2 = extent(3);
  take_rounding_away(out.curvature);
  return out;
}

/// Area of a whole patch: Gauss's rule with 8 points in each direction over the cells between
/// knots, compared with the one with 4 and divided where they differ.
class WholeArea {
 public:
  WholeArea(const NurbsSurface& s, const RunContext& run) : s_(s), run_(run) {
    const double size = size_of(s);
    small_ = kSmall * size * size;
  }

  Result<PatchArea> found() {
    const std::vector<Range> us = spans(s_.knots_u, domain_u(s_)),
                             vs = spans(s_.knots_v, domain_v(s_));
    for (const Range& v : vs) {
      OBVID_TRY(may_go_on(run_));
      for (const Range& u : us) add(u, v, 0);
    }
    return out_;
  }

 private:
  static constexpr double kSmall = 1e-13;  // of the size squared, for each cell
  static constexpr double kSame = 1e-11;   // of the area of a cell
  static constexpr int kMostQuarterings = 8;
  static constexpr std::size_t kMostCells = 20'000;  // divided; some seconds, then as it is

  static std::vector<Range> spans(const std::vector<double>& knots, const Range& domain) {
    std::vector<Range> out;
    double from = domain.from;
    for (const double knot : knots) {
      const double to = std::min(knot, domain.to);
      if (!(to > from)) continue;
      out.push_back({from, to});
      from = to;
    }
    return out;
  }
  template <std::size_t N>
  [[nodiscard]] double by(const Range& u, const Range& v) const {
    return gauss_integral<N>(v.from, v.to, [&](double at_v) {
      return gauss_integral<N>(u.from, u.to, [&](double at_u) {
        const SurfaceJet jet = evaluate(s_, at_u, at_v);
        return norm(cross(jet.du, jet.dv));
      });
    });
  }
  void add(const Range& u, const Range& v, int halvings) {
    const double rough = by<4>(u, v), fine = by<8>(u, v), step = std::abs(fine - rough);
    if (step <= std::max(small_, kSame * fine) || halvings >= kMostQuarterings ||
        divided_ >= kMostCells) {
      out_.value += fine;
      out_.error += step;
      return;
    }
    ++divided_;
    const double mu = u.at(0.5), mv = v.at(0.5);
    for (const Range& half_v : {Range{v.from, mv}, Range{mv, v.to}}) {
      for (const Range& half_u : {Range{u.from, mu}, Range{mu, u.to}}) {
        add(half_u, half_v, halvings + 1);
      }
    }
  }

  const NurbsSurface& s_;
  const RunContext& run_;
  double small_ = 0.0;
  std::size_t divided_ = 0;
  PatchArea out_;
};

Result<PatchReport> report_of(const SurfacePatch& patch, std::size_t samples,
                              const RunContext& run) {
  const NurbsSurface& s = patch.surface;
  PatchReport report;
  report.name = patch.name;
  report.degree_u = s.degree_u;
  report.degree_v = s.degree_v;
  report.count_u = s.count_u();
  report.count_v = s.count_v();
  report.order_u = order_of(s.knots_u, s.degree_u);
  report.order_v = order_of(s.knots_v, s.degree_v);
  report.rational = !s.weights.empty();
  const bool trimmed = !patch.trims.empty();
  const TrimRegion region(patch);
  const auto measures = measured(s, trimmed ? &region : nullptr, samples, run);
  OBVID_TRY(measures);
  const Measured& found = *measures;
  report.trims = patch.trims.size();
  const auto area = trimmed ? area_of(patch, run) : WholeArea(s, run).found();
  OBVID_TRY(area);
  report.area = area->value;
  report.area_error = area->error;
  report.gaussian = found.curvature.gaussian;
  report.mean = found.curvature.mean;
  report.k1 = found.curvature.k1;
  report.k2 = found.curvature.k2;
  report.without_normal = found.curvature.without_normal;
  const auto along_u = check_lines(s, samples, run);
  OBVID_TRY(along_u);
  const auto along_v = check_lines(transposed(s), samples, run);
  OBVID_TRY(along_v);
  report.along_u = *along_u;
  report.along_v = *along_v;
  return report;
}

}  // namespace

CurvatureExtents curvature_extents(const NurbsSurface& surface, std::size_t samples) {
  return measured(surface, nullptr, samples, {})->curvature;  // nobody stops it
}

Result<CurvatureExtents> curvature_extents(const SurfacePatch& patch, const RunContext& run) {
  constexpr std::size_t kSamples = 65;
  const TrimRegion region(patch);
  const auto found =
      measured(patch.surface, patch.trims.empty() ? nullptr : &region, kSamples, run);
  OBVID_TRY(found);
  return found->curvature;
}

Result<SurfaceCheck> check_surface(const SurfaceModel& model, const CheckOptions& options,
                                   const RunContext& run) {
  SurfaceCheck result;
  result.size = size_of(model);
  for (const SurfacePatch& patch : model.patches) {
    const double part =
        static_cast<double>(result.patches.size()) / static_cast<double>(model.patches.size());
    OBVID_TRY(tell(run, "measuring", part));
    auto report = report_of(patch, options.samples, run);
    OBVID_TRY(report);
    result.patches.push_back(std::move(*report));
  }
  const Topology topology = topology_of(model);
  const double meeting = options.meeting.value_or(kMeeting * result.size);
  auto joints = joints_of(model, topology, meeting, run);
  OBVID_TRY(joints);
  const auto trimmed = [&](std::size_t i) { return !model.patches[i].trims.empty(); };
  std::copy_if(joints->begin(), joints->end(), std::back_inserter(result.joints),
               [&](const JointReport& joint) {
                 return !trimmed(joint.patch[0]) && !trimmed(joint.patch[1]);
               });
  auto trims = trim_joints_of(model, topology, meeting, result.size, run);
  OBVID_TRY(trims);
  result.trim_joints = std::move(trims->joints);
  result.trimmed_borders = trims->borders;
  std::vector<std::array<bool, 4>> met(model.patches.size());
  for (const JointReport& joint : result.joints) {
    for (const std::size_t k : {0u, 1u}) met[joint.patch[k]][joint.side[k]] = true;
  }
  for (const TopologyEdge& edge : topology.edges) {
    for (const EdgeUse& use : edge.uses) {
      if (edge.point || trimmed(use.patch)) continue;
      const bool alone = edge.uses.size() == 1;
      if (met[use.patch][use.side]) {
        ++result.met_borders;
        if (alone) ++result.apart_borders;
      } else if (trims->along[use.patch][use.side]) {
        ++result.met_borders;
      } else if (alone) {
        ++result.free_borders;
      }
    }
  }
  return result;
}

}  // namespace obvid
