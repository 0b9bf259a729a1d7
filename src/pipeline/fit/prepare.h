// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "fit/taken_back.h"
#include "obvid/core/result.h"
#include "obvid/pipeline/fit.h"
#include "obvid/series/internal/sections.h"

namespace obvid::pipeline_detail {

/// A line or arc from the beginning to the end of a section.
struct WholePiece {
  Element start, end;
  double turn = 0.0;  ///< from end to end, rad

  bool operator==(const WholePiece& other) const {
    const auto same = [](const Element& a, const Element& b) {
      return a.point == b.point && a.theta == b.theta && a.kappa == b.kappa;
    };
    return same(start, other.start) && same(end, other.end) && turn == other.turn;
  }
};

/// A series ready to be formed: cleaned, its tolerances known, cut at its corners.
struct Prepared {
  std::vector<Vec2> points;
  std::vector<double> reach;  ///< how far each point may be moved; 0: not at all
  std::vector<double>
      tolerance;  ///< how far the contour may pass it; empty when all are met exactly
  std::vector<FixedData> fixed;   ///< empty, or one entry per point
  std::vector<GivenDatum> asked;  ///< the same headings and curvatures, and the marked corners
  std::vector<GivenDatum> given;  ///< those that carriers are to meet: `asked`, and ends of ranges
  /// Empty, or per point the piece that leaves it and stays as it is.
  std::vector<std::optional<Piece>> kept;
  bool convex = false;
  Prefer prefer = Prefer::kFair;
  double above_least = 0.0;  ///< as in the job, with its default
  bool central = false;      ///< each in the middle of what is left to it, when ranges ask for it
  bool primitives = false;
  bool thin = true;   ///< fewer joints than points where points with tolerances are dense
  double part = 1.0;  ///< of the tolerances that `reach` uses
  bool closed = false;
  std::optional<Vec2> period{};  ///< as in the job
  SplitSeries split;
  /// What `lay_whole_sections` found: where each point that is a corner lies, and of each section
  /// the line or arc that it is. Empty without any.
  std::vector<Vec2> placed{};
  std::vector<std::optional<WholePiece>> whole{};
  /// Corners that lie between two measured points stand behind all of these in `points`: of each
  /// the measured point before it. `split` has them in their places.
  std::vector<std::size_t> after{};
  TakenBack taken_back{};
  std::vector<std::string> warnings;
  std::string polygon;  ///< what is said when the points may be corners of a polygon; mostly empty

  [[nodiscard]] bool exact() const { return tolerance.empty(); }
  /// How many points were measured: the first ones.
  [[nodiscard]] std::size_t measured() const { return points.size() - after.size(); }
  [[nodiscard]] bool is_between(std::size_t i) const { return i >= measured(); }
  /// The measured point that a point is, or that lies before a corner between two.
  [[nodiscard]] std::size_t named(std::size_t i) const {
    return is_between(i) ? after[i - measured()] : i;
  }
  /// The line or arc that a section is.
  [[nodiscard]] std::optional<WholePiece> whole_of(const Section& section) const {
    for (std::size_t k = 0; k < whole.size(); ++k) {
      if (split.sections[k].first == section.first) return whole[k];
    }
    return std::nullopt;
  }
};

/// Merges equal neighbours, gathers fixed data and tolerances from series and job, decides whether
/// the series is closed, and finds its corners.
/// Errors: E203 for constraints at points that do not exist, or where something else is fixed
/// already; E303, E304; E403 where the series fixes two headings or curvatures at one point.
[[nodiscard]] Result<Prepared> prepare(const PointSeries& series, const FitJob& job);

/// E203 where the noise of points in space is to be estimated.
[[nodiscard]] Result<void> check_noise_in_space(const FitJob& job);

}  // namespace obvid::pipeline_detail
