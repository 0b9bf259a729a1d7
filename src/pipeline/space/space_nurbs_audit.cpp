// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "obvid/core/internal/watch.h"
#include "obvid/geom/internal/directions.h"
#include "obvid/io/internal/json_text.h"
#include "obvid/numeric/internal/golden.h"
#include "obvid/pipeline/internal/region_boundaries.h"
#include "obvid/pipeline/internal/space_audit.h"
#include "obvid/surface/space_curve.h"

namespace obvid {
namespace {

constexpr int kStepsOfSpan = 64;
constexpr double kSwing = 1e-9;           // of the largest curvature: less is rounding
constexpr double kVertexFoundTo = 1e-12;  // of the steps beside it

struct CurvaturePlace {
  std::size_t span = 0;
  double u = 0.0;
  double curvature = 0.0;
};

class SpaceAuditor {
 public:
  SpaceAuditor(const SpaceCurve& curve, const RunContext& run)
      : spans_(spans(curve)), watch_(run) {}

  Result<SpaceAudit> run() {
    for (std::size_t k = 0; k < spans_.size(); ++k) {
      if (watch_.cancelled()) return fail(cancelled_error());
      look_at(k);
    }
    for (const CurvaturePlace& place : places_) {
      out_.largest_curvature = std::max(out_.largest_curvature, place.curvature);
    }
    find_vertices();
    for (const SpaceExtremum& one : out_.vertices) {
      out_.largest_curvature = std::max(out_.largest_curvature, one.curvature);
    }
    measure_joints();
    return std::move(out_);
  }

 private:
  [[nodiscard]] double curvature_at(std::size_t span, double u) const {
    return curvature(evaluate(spans_[span], u));
  }

  void look_at(std::size_t span) {
    const Range range = domain(spans_[span]);
    for (int i = 0; i <= kStepsOfSpan; ++i) {
      const double u = range.at(static_cast<double>(i) / kStepsOfSpan);
      places_.push_back({span, u, curvature_at(span, u)});
    }
  }

  void measure_joints() {
    const double scale = out_.largest_curvature > 0.0 ? out_.largest_curvature : 1.0;
    for (std::size_t k = 1; k < spans_.size(); ++k) {
      const SpaceJet before = evaluate(spans_[k - 1], domain(spans_[k - 1]).to);
      const SpaceJet behind = evaluate(spans_[k], domain(spans_[k]).from);
      const double turn = angle_between(before.d1, behind.d1);
      const double step = std::abs(curvature(behind) - curvature(before)) / scale;
      out_.largest_turn = std::max(out_.largest_turn, turn);
      out_.largest_step = std::max(out_.largest_step, step);
      ++out_.joints;
      out_.steps += turn > joint_limit() || step > joint_limit() ? 1 : 0;
    }
  }

  /// The extreme place between its neighbours in its own span.
  [[nodiscard]] SpaceExtremum narrowed(const CurvaturePlace& place, double sign) const {
    const Range range = domain(spans_[place.span]);
    const double step = range.length() / kStepsOfSpan;
    const double from = std::max(range.from, place.u - step),
                 to = std::min(range.to, place.u + step);
    const auto height = [&](double u) { return sign * curvature_at(place.span, u); };
    double u = highest_place(from, to, height, kVertexFoundTo * step);
    if (!(height(u) >= sign * place.curvature)) u = place.u;
    return {u, evaluate(spans_[place.span], u).point, curvature_at(place.span, u)};
  }

  void find_vertices() {
    if (places_.empty()) return;
    const double least = kSwing * out_.largest_curvature;
    int direction = 0;
    CurvaturePlace extreme = places_.front();
    for (const CurvaturePlace& place : places_) {
      const double step = place.curvature - extreme.curvature;
      if (direction == 0) {
        direction = (step > least ? 1 : 0) - (step < -least ? 1 : 0);
      } else if (direction * step < -least) {
        out_.vertices.push_back(narrowed(extreme, direction));
        direction = -direction;
        extreme = place;
        continue;
      }
      if (direction * step >= 0.0) extreme = place;
    }
  }

  std::vector<SpaceCurve> spans_;
  Watch watch_;
  std::vector<CurvaturePlace> places_;
  SpaceAudit out_;
};

}  // namespace

Result<SpaceAudit> audit_in_space(const SpaceCurve& curve, const RunContext& run) {
  OBVID_TRY(check(curve));
  return SpaceAuditor(curve, run).run();
}

std::string space_audit_json(const SpaceAudit& found) {
  JsonText json;
  json.begin_object().pair("vertices", found.vertices.size()).pair("joints", found.joints);
  json.pair("steps", found.steps).pair("largest_turn", found.largest_turn);
  json.pair("largest_step", found.largest_step);
  json.pair("largest_curvature", found.largest_curvature).key("places").begin_array();
  for (const SpaceExtremum& one : found.vertices) {
    json.begin_object().pair("parameter", one.parameter).key("point").begin_array();
    json.value(one.point.x).value(one.point.y).value(one.point.z).end_array();
    json.pair("curvature", one.curvature).end_object();
  }
  json.end_array().end_object();
  return json.take() + "\n";
}

}  // namespace obvid
