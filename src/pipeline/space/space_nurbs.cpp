// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "obvid/contour/bsplines/nurbs_of.h"
#include "obvid/io/contour_json.h"
#include "obvid/io/internal/json_text.h"
#include "obvid/pipeline/space_fit.h"
#include "space/space_shape.h"

namespace obvid {
namespace {

using pipeline_detail::SpacePlace;
using pipeline_detail::SpaceShape;

constexpr std::size_t kMostSpans = 100'000;
/// Of the tolerance, for what happens between the places that are looked at.
constexpr double kBetweenPart = 0.25;
/// Shortest span, of the mean one.
constexpr double kLeastSpanPart = 1e-2;
/// Of a cubic beyond the seam of a closed curve: what happens at its ends fades by 2 - sqrt 3 a
/// span.
constexpr std::ptrdiff_t kSpansBeyond = 40;

/// The C2 cubic through places of a curve, and how far it is from it.
class CubicOfSpace {
 public:
  CubicOfSpace(const SpaceShape& shape, bool closed, double tolerance, Watch* watch)
      : shape_(shape),
        closed_(closed),
        tolerance_(tolerance),
        watch_(watch),
        joints_(apart(shape.joints())) {}

  Result<SpaceNurbs> run() const {
    for (std::size_t parts = 1; parts * joints_.size() < kMostSpans; parts *= 2) {
      const std::vector<double> nodes = nodes_of(parts);
      std::vector<Vec3> points;
      for (const double sigma : nodes) points.push_back(shape_.at(sigma).point);
      auto curve = closed_ ? round_the_seam(std::move(points), nodes) : interpolated(points, nodes);
      OBVID_TRY(curve);
      const double deviation =
          pipeline_detail::distance_bound(shape_, *curve, kBetweenPart * tolerance_, watch_);
      if (has_ended(watch_)) return fail(cancelled_error());
      if (deviation <= tolerance_) return SpaceNurbs{std::move(*curve), deviation};
    }
    return error(ErrorCode::kToleranceNotReached,
                 fmt::format("no cubic of {} spans follows the curve within {:.3g}", kMostSpans,
                             tolerance_))
        .hint("give a larger --output-tolerance")
        .value(tolerance_);
  }

 private:
  /// Joints of both contours that are meant to be one lie beside each other: differences of places
  /// so near would be rounding. The cubic need not have a knot at a joint; how far it is from the
  /// curve is looked at afterwards.
  static std::vector<double> apart(const std::vector<double>& joints) {
    const double least =
        kLeastSpanPart * (joints.back() - joints.front()) / static_cast<double>(joints.size());
    std::vector<double> out{joints.front()};
    for (const double joint : joints) {
      if (joint - out.back() >= least && joints.back() - joint >= least) out.push_back(joint);
    }
    out.push_back(joints.back());
    return out;
  }

  /// One turn of the cubic through more of them, so far that its ends do not tell; it ends where it
  /// begins.
  static Result<SpaceCurve> round_the_seam(std::vector<Vec3> points,
                                           const std::vector<double>& nodes) {
    const auto spans = static_cast<std::ptrdiff_t>(nodes.size() - 1);
    const double length = nodes.back();
    points.back() = points.front();
    std::vector<Vec3> longer;
    std::vector<double> at;
    for (std::ptrdiff_t k = -kSpansBeyond; k <= spans + kSpansBeyond; ++k) {
      const std::ptrdiff_t turns = (k < 0 ? k - spans + 1 : k) / spans;
      const auto i = static_cast<std::size_t>(k - turns * spans);
      longer.push_back(points[i]);
      at.push_back(k == spans ? length : nodes[i] + static_cast<double>(turns) * length);
    }
    auto curve = interpolated(longer, at);
    if (!curve) return curve;
    SpaceCurve turn = split(split(*curve, 0.0)[1], length)[0];
    turn.points.front() = turn.points.back() = points.front();
    return turn;
  }

  [[nodiscard]] std::vector<double> nodes_of(std::size_t parts) const {
    std::vector<double> out;
    for (std::size_t k = 0; k + 1 < joints_.size(); ++k) {
      for (std::size_t j = 0; j < parts; ++j) {
        const double t = static_cast<double>(j) / static_cast<double>(parts);
        out.push_back(joints_[k] + t * (joints_[k + 1] - joints_[k]));
      }
    }
    out.push_back(joints_.back());
    return out;
  }

  const SpaceShape& shape_;
  bool closed_;
  double tolerance_;
  Watch* watch_;
  std::vector<double> joints_;
};

/// Second derivative at the end of a span, where the next one begins: it is continuous there, and
/// at the end of the domain linear from the middle on.
double second_before(const SpaceCurve& curve, double to, double from) {
  if (to < domain(curve).to) return norm(evaluate(curve, to).d2);
  const double middle = 0.5 * (from + to);
  const SpaceJet jet = evaluate(curve, middle);
  return norm(jet.d2 + (to - middle) * jet.d3);
}

void add_vec3(JsonText& json, const char* name, Vec3 v) {
  json.key(name).begin_array().value(v.x).value(v.y).value(v.z).end_array();
}

/// Places of a curve at arc lengths, ascending or not, as `lengths_of` its length gives them.
template <class LengthsOf>
std::vector<std::pair<double, SpacePlace>> places_at(const SpaceFit& fit, LengthsOf&& lengths_of) {
  std::vector<std::pair<double, SpacePlace>> out;
  if (fit.unrolled) {
    const SpaceShape shape(fit.frame, fit.plan.contour, fit.unrolled->contour);
    for (const double s : lengths_of(shape.length())) {
      out.emplace_back(s, shape.at(s, s >= shape.length()));
    }
    return out;
  }
  const ContourPath path(fit.plan.contour.pieces);
  for (const double s : lengths_of(path.length())) {
    const auto place = path.at(s, s >= path.length());
    out.emplace_back(s, SpacePlace{fit.frame.at(place.point), s, 0.0, std::abs(place.kappa), 0.0,
                                   place.tangent.x * fit.frame.x + place.tangent.y * fit.frame.y});
  }
  return out;
}

/// At equal steps.
std::vector<std::pair<double, SpacePlace>> equal_places(const SpaceFit& fit, std::size_t count) {
  return places_at(fit, [&](double length) {
    std::vector<double> at;
    const std::size_t steps = std::max<std::size_t>(count, 2) - 1;
    for (std::size_t k = 0; k <= steps; ++k) {
      at.push_back(length * static_cast<double>(k) / static_cast<double>(steps));
    }
    return at;
  });
}

}  // namespace

namespace pipeline_detail {

double distance_bound(const SpaceShape& shape, const SpaceCurve& cubic, double between,
                      Watch* watch) {
  // the second derivative of the cubic is linear between knots, and that of the curve is bounded by
  // the curvatures of both contours, which are monotone on their pieces
  std::vector<double> nodes = shape.joints();
  nodes.insert(nodes.end(), cubic.knots.begin(), cubic.knots.end());
  for (double& node : nodes) node = std::clamp(node, 0.0, shape.length());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  double largest = 0.0;
  for (std::size_t k = 0; k + 1 < nodes.size() && !is_to_end(watch); ++k) {
    const double from = nodes[k], to = nodes[k + 1], width = to - from;
    const auto a = shape.curvatures(from, false), b = shape.curvatures(to, true);
    const double bend = std::hypot(std::max(std::abs(a.plan), std::abs(b.plan)),
                                   std::max(std::abs(a.unrolled), std::abs(b.unrolled))) +
                        std::max(norm(evaluate(cubic, from).d2), second_before(cubic, to, from));
    constexpr double kNoBend = 1e-300;  // 1/unit: straight
    const double wanted = std::sqrt(8.0 * between / std::max(bend, kNoBend));
    const double steps = std::clamp(std::ceil(width / wanted), 2.0, 1e6);
    const double step = width / steps;
    double here = 0.0;
    for (int j = 0; j <= static_cast<int>(steps); ++j) {
      const double sigma = j < static_cast<int>(steps) ? from + step * j : to;
      const Vec3 place = shape.at(sigma, sigma >= to).point;
      here = std::max(here, norm(evaluate(cubic, sigma).point - place));
    }
    largest = std::max(largest, here + bend * step * step / 8.0);
  }
  return largest;
}

}  // namespace pipeline_detail

Result<SpaceNurbs> space_nurbs(const SpaceFit& fit, double tolerance, Watch* watch) {
  if (!(tolerance > 0.0 && std::isfinite(tolerance))) {
    return error(ErrorCode::kBadOption, "the tolerance must be a positive length").value(tolerance);
  }
  if (fit.unrolled) {
    const SpaceShape shape(fit.frame, fit.plan.contour, fit.unrolled->contour);
    return CubicOfSpace(shape, fit.plan.contour.closed, tolerance, watch).run();
  }
  const auto made = nurbs_of(fit.plan.contour, {true, tolerance}, watch);
  OBVID_TRY(made);
  return SpaceNurbs{placed(made->curve, fit.frame), made->deviation};
}

std::string space_fit_json(const SpaceFit& fit, const SpaceNurbs& nurbs) {
  JsonText json;
  json.begin_object().pair("format", "obvid-space-curve").pair("version", 1);
  json.pair("name", fit.name);
  add_units(json, fit.units);
  json.pair("planar", !fit.unrolled);
  json.key("frame").begin_object();
  add_vec3(json, "origin", fit.frame.origin);
  add_vec3(json, "x", fit.frame.x);
  add_vec3(json, "y", fit.frame.y);
  add_vec3(json, "normal", fit.frame.normal());
  json.end_object().pair("flatness", fit.flatness).pair("largest_move", fit.largest_move);
  json.key("points").begin_array();
  for (const Vec3& p : fit.points) {
    json.begin_array().value(p.x).value(p.y).value(p.z).end_array();
  }
  json.end_array();
  const auto contour = [](const Fit& part) {
    return contour_to_json({part.contour, part.report, part.certificate});
  };
  json.key(fit.unrolled ? "projection" : "contour").raw(contour(fit.plan));
  if (fit.unrolled) {
    json.key("heights").raw(contour(*fit.unrolled));
    json.pair("least_curvature", fit.least_curvature);
    json.pair("largest_curvature", fit.largest_curvature);
    json.pair("torsion_places", fit.torsion_places).pair("least_torsion", fit.least_torsion);
    json.pair("largest_torsion", fit.largest_torsion).pair("torsion_step", fit.torsion_step);
    if (fit.seam) {
      json.key("seam").begin_object().pair("position", fit.seam->position);
      json.pair("heading", fit.seam->heading).pair("curvature", fit.seam->curvature).end_object();
    }
  }
  json.key("curve").begin_object().pair("degree", nurbs.curve.degree);
  json.pair("deviation", nurbs.deviation).key("knots").begin_array();
  for (const double knot : nurbs.curve.knots) json.value(knot);
  json.end_array().key("points").begin_array();
  for (const Vec3& p : nurbs.curve.points) {
    json.begin_array().value(p.x).value(p.y).value(p.z).end_array();
  }
  json.end_array().key("weights").begin_array();
  for (const double weight : nurbs.curve.weights) json.value(weight);
  json.end_array().end_object().end_object();
  return json.take() + "\n";
}

double length_of(const SpaceFit& fit) {
  return ContourPath(fit.unrolled ? fit.unrolled->contour.pieces : fit.plan.contour.pieces)
      .length();
}

Result<std::vector<SpaceSample>> sample_space(const SpaceFit& fit, std::span<const double> at) {
  const double length = length_of(fit);
  for (std::size_t k = 0; k < at.size(); ++k) {
    if (at[k] >= 0.0 && at[k] <= length) continue;
    return error(ErrorCode::kBadOption, "a place is beyond the curve")
        .where(fmt::format("place {}", k + 1))
        .value(at[k]);
  }
  std::vector<SpaceSample> out;
  for (const auto& [s, place] : places_at(fit, [&](double) { return at; })) {
    out.push_back({place.point, place.tangent, place.curvature, place.torsion});
  }
  return out;
}

std::string space_samples_csv(const SpaceChain& chain, std::size_t count) {
  const bool one = chain.corners.empty();
  std::string out = one ? "s,x,y,z,curvature,torsion\n" : "s,x,y,z,curvature,torsion,part\n";
  double before = 0.0;
  for (std::size_t k = 0; k < chain.parts.size(); ++k) {
    const auto places = equal_places(chain.parts[k], count);
    for (const auto& [s, place] : places) {
      const Vec3 p = place.point;
      out += fmt::format("{},{},{},{},{},", before + s, p.x, p.y, p.z, place.curvature);
      if (place.torsion) out += fmt::format("{}", *place.torsion);
      out += one ? "\n" : fmt::format(",{}\n", k + 1);
    }
    before += places.back().first;
  }
  return out;
}

std::string space_points_text(const SpaceFit& fit, std::size_t count) {
  std::string out;
  for (const auto& [s, place] : equal_places(fit, count)) {
    out += fmt::format("{} {} {}\n", place.point.x, place.point.y, place.point.z);
  }
  return out;
}

}  // namespace obvid
