// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/construction_fit.h"
#include "fit/waviness.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "fit/given.h"
#include "fit/keep_joints.h"
#include "fit/prepare.h"
#include "obvid/certify/certify.h"
#include "obvid/curve/internal/runs.h"
#include "obvid/geom/internal/angle.h"
#include "region/region_constructions.h"
#include "verify/report.h"

namespace obvid {
namespace {

using namespace pipeline_detail;

/// Neighbouring pieces that agree so far are one curve: rad.
constexpr double kSameAtJoint = 1e-9;
/// And of the larger curvature: a tenth of the gap that certificates allow, beyond the rounding of
/// short parabolas.
constexpr double kSameCurvatureAtJoint = 1e-7;

/// Conics of a contour are arcs of ellipses.
Result<void> only_ellipses(const ConstructionTable& made, const RegionPart& part) {
  for (std::size_t k = 0; k < made.pieces.size(); ++k) {
    const auto* conic = std::get_if<RationalBezier>(&made.pieces[k]);
    if (made.construction != Construction::kEllipses || conic == nullptr) return {};
    const double w2 = conic->weight[1] * conic->weight[1] / (conic->weight[0] * conic->weight[2]);
    if (w2 < 1.0) continue;
    const RegionRow& row = part.rows[made.piece_row[k]];
    const std::size_t from = part.points[row.from].number, to = part.points[row.to].number;
    return error(ErrorCode::kNoSpiral,
                 "no ellipse arc there lies in the region of monotone curves: it would be a "
                 "parabola or "
                 "hyperbola")
        .where(fmt::format("points {} to {}", from + 1, to + 1))
        .hint("change the tangents there; `obvid region --construction ellipses` shows the weights")
        .point(from)
        .value(std::sqrt(w2));
  }
  return {};
}

/// Pieces of a construction as a contour.
class ConstructionContour {
 public:
  ConstructionContour(const RegionTable& table, const Prepared& prepared)
      : part_(table.last()), made_(*table.construction), closed_(table.closed) {
    out_.carrier = carrier_of(made_.construction);
    out_.points = prepared.points;
    out_.given = prepared.asked;
  }

  Contour run() {
    double theta = part_.points.front().theta;
    for (std::size_t k = 0; k < made_.pieces.size(); ++k) {
      Joint joint{element(k, 0.0, theta), source_before(k), {}};
      stand_on_point(joint);
      if (k > 0) part_at(joint, k);
      theta = element(k, 1.0, joint.leaving.value_or(joint.element).theta).theta;
      out_.joints.push_back(joint);
    }
    out_.pieces = made_.pieces;
    const std::size_t last = made_.pieces.size() - 1;
    out_.joints.push_back({element(last, 1.0, theta), source_of(row_of(last).to), {}});
    stand_on_point(out_.joints.back());
    if (closed_) close();
    out_.runs = collect_runs(directions(), [this](std::size_t piece) {
      return piece > 0 && out_.joints[piece].leaving.has_value();
    });
    return std::move(out_);
  }

 private:
  [[nodiscard]] const RegionRow& row_of(std::size_t piece) const {
    return part_.rows[made_.piece_row[piece]];
  }

  /// The first piece of a segment starts at its point.
  [[nodiscard]] std::optional<std::size_t> source_before(std::size_t k) const {
    if (k > 0 && made_.piece_row[k] == made_.piece_row[k - 1]) return std::nullopt;
    return source_of(row_of(k).from);
  }
  [[nodiscard]] std::optional<std::size_t> source_of(std::size_t point) const {
    const RegionPoint& p = part_.points[point];
    return p.inserted > 0 ? std::nullopt : std::optional(p.number);
  }

  /// Pieces end there but for the rounding of their own coordinates.
  void stand_on_point(Joint& joint) const {
    if (joint.source) joint.element.point = out_.points[*joint.source % out_.points.size()];
  }

  [[nodiscard]] Element element(std::size_t piece, double t, double near) const {
    Element e = element_at(made_.pieces[piece], t);
    e.theta = nearest_angle(e.theta, near);
    return e;
  }

  /// Where the pieces differ the joint has both elements; arcs step anyway, and leave it one
  /// curvature.
  void part_at(Joint& joint, std::size_t k) const {
    const Element after = joint.element, before = element(k - 1, 1.0, after.theta);
    if (steps_at_joints(out_.carrier)) {
      joint.element.kappa = reached(k - 1, before.kappa, after.kappa);
    }
    const bool turns = std::abs(after.theta - before.theta) > kSameAtJoint;
    if (!turns && !steps(k - 1, before.kappa, k, after.kappa)) return;
    joint.element = before;
    joint.element.point = after.point;
    joint.leaving = after;
  }

  /// Between two arcs the curvature that the run before them comes to: on one run that of the arc
  /// behind, at a vertex that of the arc before, which is the sharper or the blunter one.
  [[nodiscard]] double reached(std::size_t piece, double before, double after) const {
    return row_of(piece).direction.value_or(0) * (after - before) < 0.0 ? before : after;
  }

  /// Measured by what both pieces have: at an inflection curvatures are rounding.
  [[nodiscard]] bool steps(std::size_t piece, double before, std::size_t next, double after) const {
    if (steps_at_joints(out_.carrier)) return false;
    const double larger =
        std::max({std::abs(before), std::abs(after), std::abs(element(piece, 0.0, 0.0).kappa),
                  std::abs(element(next, 1.0, 0.0).kappa)});
    return std::abs(after - before) > kSameCurvatureAtJoint * larger;
  }

  void close() {
    out_.closed = true;
    const Joint last = out_.joints.back();
    out_.joints.pop_back();
    Joint& first = out_.joints.front();
    const double turn = turn_between(first.element.theta, last.element.theta);
    const std::size_t piece = made_.pieces.size() - 1;
    if (std::abs(turn) <= kSameAtJoint &&
        !steps(piece, last.element.kappa, 0, first.element.kappa)) {
      if (steps_at_joints(out_.carrier)) {
        first.element.kappa = reached(piece, last.element.kappa, first.element.kappa);
      }
      return;
    }
    first.leaving = first.element;
    first.element = last.element;
    first.element.point = first.leaving->point;
  }

  /// Of arcs those of their segments, of others as they are proved.
  [[nodiscard]] std::vector<int> directions() const {
    Watch unwatched;
    if (!steps_at_joints(out_.carrier)) return *proved_directions(made_.pieces, unwatched);
    std::vector<int> out;
    for (std::size_t k = 0; k < made_.pieces.size(); ++k) {
      out.push_back(row_of(k).direction.value_or(0));
    }
    return out;
  }

  const RegionPart& part_;
  const ConstructionTable& made_;
  bool closed_;
  Contour out_;
};

}  // namespace

Result<Fit> fit_construction(const PointSeries& series, const RegionJob& job,
                             const RunContext& run) {
  const auto begin = std::chrono::steady_clock::now();
  Watch watch(run);
  const auto prepared = prepare(series, job.job);
  OBVID_TRY(prepared);
  const auto table = region_table(series, job, run);
  OBVID_TRY(table);
  OBVID_TRY(only_ellipses(*table->construction, table->last()));
  Fit out;
  out.contour = ConstructionContour(*table, *prepared).run();
  out.contour.units = series.units;
  take_piece_ends(out.contour);
  OBVID_TRY(keeps_given(out.contour));
  const double tolerance = job.job.tolerance.value_or(default_tolerance(prepared->points));
  auto report = measure(out.contour, tolerance, watch);
  OBVID_TRY(report);
  out.certificate = certify(out.contour, watch);
  out.report = std::move(*report);
  out.report.waviness = waviness(out.contour, watch);
  // nobody asked for the width that two arcs leave, or one piece over a long chord
  if (out.report.largest_width > tolerance) out.report.tolerance = out.report.largest_width;
  settle_with(out.certificate, out.contour, out.report, watch);
  out.warnings = series.warnings;
  out.warnings.insert(out.warnings.end(), table->warnings.begin(), table->warnings.end());
  const auto& remarks = table->construction->remarks;
  out.warnings.insert(out.warnings.end(), remarks.begin(), remarks.end());
  out.report.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (watch.was_cancelled()) return fail(cancelled_error());
  return out;
}

}  // namespace obvid
