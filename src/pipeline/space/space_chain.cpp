// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "fit/prepare.h"
#include "obvid/geom/internal/box.h"
#include "obvid/geom/internal/directions.h"
#include "obvid/io/internal/json_text.h"
#include "obvid/numeric/internal/median.h"
#include "obvid/pipeline/internal/promise.h"
#include "obvid/pipeline/internal/report_json.h"
#include "obvid/pipeline/space_fit.h"
#include "space/space_corners.h"
#include "space/space_shape.h"
#include "verify/false_claim.h"

namespace obvid {
namespace {

using namespace pipeline_detail;

constexpr double kChainTolerance = 1e-6;  ///< of NURBS curves, of the size
/// Angles at corners follow again from the same numbers; lengths but for rounding.
constexpr double kSameTurn = 1e-9;
constexpr double kChainRoundedPart = 1e-12, kRoundingsOfChain = 64.0;
/// Printed digits that are few beside the chords belong to nominal sizes (as in the plane).
constexpr double kLargestPrintedPart = 0.05;

/// Lengths below this are rounding.
double chain_rounding(const std::vector<Vec3>& points) {
  double coordinate = 0.0;
  for (const Vec3& p : points) {
    coordinate = std::max({coordinate, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return kChainRoundedPart * farthest_from_first(points) + kRoundingsOfChain * 0x1p-53 * coordinate;
}

/// How far points may lie from where they belong.
double blur_of(const SpaceSeries& series, const FitJob& job) {
  std::vector<double> chords;
  for (std::size_t i = 1; i < series.points.size(); ++i) {
    chords.push_back(norm(series.points[i] - series.points[i - 1]));
  }
  const double middle = median_of(std::move(chords));
  const double print = std::max({series.rounding.x, series.rounding.y, series.rounding.z});
  const double printed = print <= kLargestPrintedPart * middle ? print : 0.0;
  return std::max({job.noise.value_or(0.0), job.noise_from_rounding ? print : 0.0, printed,
                   chain_rounding(series.points)});
}

/// Whether points are met as they are.
bool meets_points(const SpaceJob& job) {
  const auto moves = [](const FixedData& f) { return f.tolerance.value_or(0.0) > 0.0; };
  return !(job.fit.noise.value_or(0.0) > 0.0) && !job.fit.noise_from_rounding &&
         std::none_of(job.fixed.begin(), job.fixed.end(), moves);
}

/// End of a curve: its place and tangent.
struct SpaceEnd {
  Vec3 point, tangent;
};

SpaceEnd end_of(const SpaceFit& fit, bool last) {
  const auto element = [&](const Contour& contour) {
    return element_at(last ? contour.pieces.back() : contour.pieces.front(), last ? 1.0 : 0.0);
  };
  const Element flat = element(fit.plan.contour);
  const Vec3 along = std::cos(flat.theta) * fit.frame.x + std::sin(flat.theta) * fit.frame.y;
  const Vec3 below = fit.frame.at(flat.point);
  if (!fit.unrolled) return {below, along};
  const Element up = element(fit.unrolled->contour);
  const Vec3 normal = fit.frame.normal();
  return {below + up.point.y * normal, std::cos(up.theta) * along + std::sin(up.theta) * normal};
}

/// Parts before and behind corner `k`.
std::pair<std::size_t, std::size_t> parts_at(const SpaceChain& chain, std::size_t k) {
  if (!chain.closed) return {k, k + 1};
  return {(k + chain.corners.size() - 1) % chain.corners.size(), k};
}

double turn_at(const SpaceChain& chain, std::size_t k) {
  const auto [before, behind] = parts_at(chain, k);
  return angle_between(end_of(chain.parts[before], true).tangent,
                       end_of(chain.parts[behind], false).tangent);
}

std::vector<std::size_t> chain_part(const SpaceChain& chain, std::size_t k) {
  return points_of_part(chain.corners, chain.closed, chain.points.size(), k);
}

std::string part_words(const SpaceChain& chain, std::size_t k) {
  const std::vector<std::size_t> at = chain_part(chain, k);
  return fmt::format("points {} to {}", at.front() + 1, at.back() + 1);
}

Error chain_error(std::string what, std::string hint) {
  return error(ErrorCode::kBadOption, std::move(what)).hint(std::move(hint));
}

class ChainForming {
 public:
  ChainForming(const SpaceSeries& series, const SpaceJob& job, const RunContext& run)
      : series_(series), job_(job), run_(run) {}

  Result<SpaceChain> run() {
    chain_.name = series_.name;
    chain_.units = series_.units;
    chain_.points = series_.points;
    const bool no_direction = job_.along && !(is_finite(*job_.along) && norm(*job_.along) > 0.0);
    if (chain_.points.size() < 3 || no_direction) return whole();
    const bool returns = returns_in_space(series_, job_.fit);
    chain_.closed = job_.fit.closing == Closing::kClosed ||
                    (job_.fit.closing == Closing::kAutomatic && returns);
    if (chain_.closed && returns) {
      gap_ = norm(chain_.points.back() - chain_.points.front());
      chain_.points.pop_back();
    }
    if (plane_of_space(series_, job_, {}).holds) return whole();
    find();
    if (chain_.corners.empty()) return whole();
    OBVID_TRY(check_data());
    for (std::size_t k = 0; k < chain_.corners.size() + (chain_.closed ? 0 : 1); ++k) {
      auto made = part(k);
      OBVID_TRY(made);
      for (const std::string& one : made->warnings) {
        chain_.warnings.push_back(part_words(chain_, k) + ": " + one);
      }
      chain_.largest_move = std::max(chain_.largest_move, made->largest_move + gap_);
      chain_.parts.push_back(std::move(*made));
    }
    for (std::size_t k = 0; k < chain_.corners.size(); ++k) {
      chain_.corners[k].turn = turn_at(chain_, k);
    }
    if (gap_ > 0.0) {
      chain_.warnings.emplace_back(
          "the last point is the first one again but for noise: the first one stands for both");
    }
    return std::move(chain_);
  }

 private:
  Result<SpaceChain> whole() {
    auto made = fit_space(series_, job_, run_);
    OBVID_TRY(made);
    chain_.closed = false;
    chain_.corners.clear();
    chain_.points = made->points;
    chain_.largest_move = made->largest_move;
    chain_.warnings = made->warnings;
    chain_.parts.push_back(std::move(*made));
    return std::move(chain_);
  }

  void find() {
    CornerConstraints constraints;
    constraints.find = job_.fit.find_corners;
    if (job_.fit.corner_angle) constraints.angle = *job_.fit.corner_angle;
    constraints.exact = meets_points(job_);
    const std::size_t n = chain_.points.size();
    std::vector<std::size_t> marked;
    for (const PointConstraint& constraint : job_.fit.constraints) {
      if (constraint.corner) marked.push_back(constraint.index % n);
    }
    for (std::size_t i = 0; i < job_.fixed.size(); ++i) {
      if (job_.fixed[i].corner) marked.push_back(i % n);
    }
    const auto found = corners_in_space(chain_.points, chain_.closed, blur_of(series_, job_.fit),
                                        marked, constraints);
    for (const std::size_t i : found) chain_.corners.push_back({i, 0.0});
  }

  [[nodiscard]] bool is_corner(std::size_t point) const {
    return std::any_of(chain_.corners.begin(), chain_.corners.end(),
                       [&](const SpaceCorner& c) { return c.point == point; });
  }

  /// What is given at points belongs to one part each, and to a direction.
  Result<void> check_data() const {
    if (!fixes_space_data(job_)) return {};
    if (!job_.along) {
      return fail(
          chain_error("headings, radii and corners of points in space are those of a projection",
                      "--along Z takes them as seen in the plane of x and y, --flat forms the "
                      "contour in that plane alone"));
    }
    const FitJob& fit = job_.fit;
    const bool at_start =
                   fit.start_heading || fit.start_kappa || fit.start_thetas || fit.start_kappas,
               at_end = fit.end_heading || fit.end_kappa || fit.end_thetas || fit.end_kappas;
    if (chain_.closed && (at_start || at_end)) {
      return fail(chain_error("a closed curve has no ends", "--heading-at, --radius-at"));
    }
    if ((at_start && chain_part(chain_, 0).size() == 2) ||
        (at_end && chain_part(chain_, chain_.corners.size()).size() == 2)) {
      return fail(chain_error("a line between two points has its heading", "leave it out"));
    }
    for (const PointConstraint& constraint : fit.constraints) {
      const bool more =
          constraint.theta || constraint.kappa || constraint.thetas || constraint.kappas;
      if (more && is_corner(constraint.index)) return fail(at_corner(constraint.index));
    }
    for (std::size_t i = 0; i < job_.fixed.size(); ++i) {
      if (job_.fixed[i].says_how() && is_corner(i)) return fail(at_corner(i));
    }
    return {};
  }

  static Error at_corner(std::size_t point) {
    return chain_error(
        fmt::format(
            "point {} is a corner in space: a heading or radius there is that of two curves",
            point + 1),
        "give it at a point beside, or leave it out");
  }

  Result<SpaceFit> part(std::size_t k) const {
    const std::vector<std::size_t> at = chain_part(chain_, k);
    SpaceSeries series;
    series.name = fmt::format("{}, {}", series_.name, part_words(chain_, k));
    series.units = series_.units;
    series.rounding = series_.rounding;
    for (const std::size_t i : at) series.points.push_back(chain_.points[i]);
    SpaceJob job = job_;
    job.fit.closing = Closing::kOpen;
    job.fit.find_corners = false;
    job.fit.constraints.clear();
    job.fixed.clear();
    for (std::size_t j = 0; j < at.size(); ++j) {
      for (PointConstraint constraint : job_.fit.constraints) {
        if (constraint.index != at[j] || constraint.corner) continue;
        constraint.index = j;
        job.fit.constraints.push_back(constraint);
      }
      if (job_.fixed.empty()) continue;
      job.fixed.push_back(job_.fixed[at[j]]);
      job.fixed.back().corner = false;
    }
    const SpaceEnds ends{chain_.closed || k > 0, chain_.closed || k < chain_.corners.size()};
    if (ends.first_is_corner) {
      job.fit.start_heading = job.fit.start_kappa = std::nullopt;
      job.fit.start_thetas = job.fit.start_kappas = std::nullopt;
    }
    if (ends.last_is_corner) {
      job.fit.end_heading = job.fit.end_kappa = std::nullopt;
      job.fit.end_thetas = job.fit.end_kappas = std::nullopt;
    }
    auto made = form_in_space(series, job, ends, run_);
    if (made) return made;
    Error error = made.error();
    error.what = part_words(chain_, k) + ": " + error.what;
    if (error.index >= 0) error.index = global(at, error.index);
    if (error.last >= 0) error.last = global(at, error.last);
    return fail(std::move(error));
  }

  static std::ptrdiff_t global(const std::vector<std::size_t>& at, std::ptrdiff_t local) {
    const auto j = static_cast<std::size_t>(local);
    return j < at.size() ? static_cast<std::ptrdiff_t>(at[j]) : -1;
  }

  const SpaceSeries& series_;
  const SpaceJob& job_;
  const RunContext& run_;
  SpaceChain chain_;
  double gap_ = 0.0;
};

/// What the file of a chain says beside its parts.
class ChainClaims {
 public:
  explicit ChainClaims(const StoredSpaceChain& stored)
      : stored_(stored), chain_(space_chain_of(stored)), near_(chain_rounding(stored.points)) {}

  std::optional<Error> run() {
    double move = 0.0;
    for (std::size_t k = 0; k < stored_.parts.size() && !refused_; ++k) {
      points(k);
      move = std::max(move, stored_.parts[k].largest_move);
    }
    if (!(stored_.largest_move >= move)) refuse("largest_move", stored_.largest_move, move);
    for (std::size_t k = 0; k < stored_.corners.size() && !refused_; ++k) corner(k);
    return refused_;
  }

 private:
  void refuse(const std::string& name, double claimed, double found) {
    if (!refused_) refused_ = pipeline_detail::false_claim_in_space(name, claimed, found);
  }

  void points(std::size_t k) {
    const std::vector<std::size_t> at = chain_part(chain_, k);
    const StoredSpace& part = stored_.parts[k];
    const std::string name = fmt::format("parts/{}/points", k);
    if (part.points.size() != at.size()) {
      return refuse(name, static_cast<double>(part.points.size()), static_cast<double>(at.size()));
    }
    for (std::size_t j = 0; j < at.size(); ++j) {
      const double off = norm(part.points[j] - stored_.points[at[j]]);
      if (off != 0.0) return refuse(fmt::format("{}/{}", name, j), 0.0, off);
    }
  }

  void corner(std::size_t k) {
    const auto [before, behind] = parts_at(chain_, k);
    const Vec3 place = stored_.points[stored_.corners[k].point];
    for (const Vec3& end :
         {end_of(chain_.parts[before], true).point, end_of(chain_.parts[behind], false).point}) {
      const double off = norm(end - place);
      if (!(off <= near_)) return refuse(fmt::format("corners/{}/point", k), 0.0, off);
    }
    const double turn = turn_at(chain_, k);
    if (!(std::abs(turn - stored_.corners[k].turn) <= kSameTurn)) {
      refuse(fmt::format("corners/{}/turn", k), stored_.corners[k].turn, turn);
    }
  }

  const StoredSpaceChain& stored_;
  SpaceChain chain_;
  double near_;
  std::optional<Error> refused_;
};

}  // namespace

Result<SpaceChain> fit_space_chain(const SpaceSeries& series, const SpaceJob& job,
                                   const RunContext& run) {
  OBVID_TRY(pipeline_detail::check_noise_in_space(job.fit));
  return ChainForming(series, job, run).run();
}

double size_of(const SpaceChain& chain) { return farthest_from_first(chain.points); }

Result<std::vector<SpaceNurbs>> chain_nurbs(const SpaceChain& chain,
                                            std::optional<double> tolerance,
                                            const RunContext& run) {
  Watch watch(run);
  std::vector<SpaceNurbs> out;
  for (const SpaceFit& part : chain.parts) {
    auto made = space_nurbs(part, tolerance.value_or(kChainTolerance * size_of(chain)), &watch);
    OBVID_TRY(made);
    out.push_back(std::move(*made));
  }
  return out;
}

std::string space_chain_json(const SpaceChain& chain, const std::vector<SpaceNurbs>& nurbs) {
  if (chain.corners.empty()) return space_fit_json(chain.parts.front(), nurbs.front());
  JsonText json;
  json.begin_object().pair("format", "obvid-space-chain").pair("version", 1);
  json.pair("name", chain.name);
  add_units(json, chain.units);
  json.pair("closed", chain.closed).pair("largest_move", chain.largest_move);
  json.key("points").begin_array();
  for (const Vec3& p : chain.points) {
    json.begin_array().value(p.x).value(p.y).value(p.z).end_array();
  }
  json.end_array().key("corners").begin_array();
  for (const SpaceCorner& corner : chain.corners) {
    json.begin_object().pair("point", corner.point).pair("turn", corner.turn).end_object();
  }
  json.end_array().key("parts").begin_array();
  for (std::size_t k = 0; k < chain.parts.size(); ++k) {
    json.raw(space_fit_json(chain.parts[k], nurbs[k]));
  }
  json.end_array().end_object();
  return json.take() + "\n";
}

SpaceChain space_chain_of(const StoredSpaceChain& stored) {
  SpaceChain out;
  out.name = stored.name;
  out.units = stored.units;
  out.closed = stored.closed;
  out.points = stored.points;
  out.corners = stored.corners;
  out.largest_move = stored.largest_move;
  for (const StoredSpace& part : stored.parts) out.parts.push_back(space_fit_of(part));
  return out;
}

std::optional<std::string> take_units(SpaceChain& chain, const Units& given) {
  auto told = take_units(chain.units, given);
  for (SpaceFit& part : chain.parts) {
    part.units = part.plan.contour.units = chain.units;
    if (part.unrolled) part.unrolled->contour.units = chain.units;
  }
  return told;
}

SpaceChainVerification verify(const StoredSpaceChain& stored) {
  return *verify(stored, RunContext{});
}

Result<SpaceChainVerification> verify(const StoredSpaceChain& stored, const RunContext& run) {
  SpaceChainVerification out;
  for (const StoredSpace& part : stored.parts) {
    auto found = verify(part, run);
    OBVID_TRY(found);
    out.parts.push_back(std::move(*found));
  }
  if (stored.corners.empty()) return out;
  out.false_claim = ChainClaims(stored).run();
  out.not_checked = {"/name", "/units", "/units_source",
                     "/largest_move (only that no part has a larger one)"};
  out.not_checked.insert(out.not_checked.end(), stored.unread.begin(), stored.unread.end());
  return out;
}

std::optional<Error> broken_promise(const StoredSpaceChain& stored,
                                    const SpaceChainVerification& found) {
  if (found.false_claim) return found.false_claim;
  for (std::size_t k = 0; k < stored.parts.size(); ++k) {
    auto broken = broken_promise(stored.parts[k], found.parts[k]);
    if (!broken) continue;
    if (!stored.corners.empty()) broken->where = fmt::format("/parts/{}{}", k, broken->where);
    return broken;
  }
  return std::nullopt;
}

std::optional<Error> broken_promise(const SpaceChain& chain) {
  for (const SpaceFit& part : chain.parts) {
    if (auto broken = broken_promise(part.plan)) return broken;
    if (!part.unrolled) continue;
    if (auto broken = broken_promise(*part.unrolled)) return broken;
  }
  return std::nullopt;
}

std::string space_verification_json(const StoredSpaceChain& stored,
                                    const SpaceChainVerification& found) {
  if (stored.corners.empty()) {
    return space_verification_json(stored.parts.front(), found.parts.front());
  }
  JsonText json;
  json.begin_object().pair("holds", !broken_promise(stored, found));
  pipeline_detail::add_false_claim(json, found.false_claim ? &*found.false_claim : nullptr);
  json.key("not_checked").begin_array();
  for (const std::string& one : found.not_checked) json.value(one);
  json.end_array().key("parts").begin_array();
  for (std::size_t k = 0; k < stored.parts.size(); ++k) {
    json.raw(space_verification_json(stored.parts[k], found.parts[k]));
  }
  json.end_array().end_object();
  return json.take();
}

}  // namespace obvid
