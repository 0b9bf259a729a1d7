// SPDX-License-Identifier: Apache-2.0
#include "skin_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "skin_shares.h"

namespace obvid {
namespace {

constexpr double kUnknown = -1.0;

/// Arc lengths of the contour's points: at joints that stand on them, else the nearest places, in
/// order.
std::vector<double> contour_points_at(const Contour& contour, const ContourPath& path) {
  std::vector<double> at(contour.points.size(), kUnknown);
  for (std::size_t k = 0; k < contour.joints.size(); ++k) {
    const auto& source = contour.joints[k].source;
    if (source && *source < at.size()) at[*source] = path.joint(k);
  }
  std::vector<double> limit(at.size() + 1, path.length());  // what the next known place allows
  for (std::size_t i = at.size(); i-- > 0;) limit[i] = at[i] >= 0.0 ? at[i] : limit[i + 1];
  double from = 0.0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    if (at[i] < 0.0) {
      const double guess = i > 0 ? from + norm(contour.points[i] - contour.points[i - 1]) : 0.0;
      at[i] = path.nearest(contour.points[i], guess, from, limit[i]);
    }
    from = std::max(from, at[i]);
    at[i] = from;
  }
  return at;
}

/// Number of the point that stands at an arc length.
std::size_t point_at(const MeasuredSection& section, double s) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < section.point_at.size(); ++i) {
    if (std::abs(section.point_at[i] - s) < std::abs(section.point_at[best] - s)) best = i;
  }
  return best;
}

/// Shares of arc length between the first and the last mark, averaged over the sections.
std::vector<double> averaged_marks(const std::vector<std::vector<double>>& marks) {
  std::vector<double> sum;
  double counted = 0.0;
  for (const std::vector<double>& s : marks) {
    if (s.empty() || !(s.back() > s.front())) continue;
    sum.resize(s.size(), 0.0);
    counted += 1.0;
    for (std::size_t i = 0; i < s.size(); ++i)
      sum[i] += (s[i] - s.front()) / (s.back() - s.front());
  }
  for (double& t : sum) t /= counted;
  if (!sum.empty()) sum.back() = 1.0;
  return sum;
}

/// A stretch is nothing where no section has a length; marks that stand together in all sections
/// are one.
std::optional<MatchedStretch> stretch_of(std::vector<std::vector<double>> marks) {
  MatchedStretch stretch{std::move(marks), {}};
  stretch.at = averaged_marks(stretch.marks);
  if (stretch.at.empty()) return std::nullopt;
  std::vector<std::size_t> kept = {0};
  for (std::size_t i = 1; i < stretch.at.size(); ++i) {
    if (stretch.at[i] > stretch.at[kept.back()]) kept.push_back(i);
  }
  const auto only_kept = [&](std::vector<double>& list) {
    if (list.empty()) return;
    std::vector<double> few;
    for (const std::size_t i : kept) few.push_back(list[i]);
    few.back() = list.back();
    list = std::move(few);
  };
  for (std::vector<double>& list : stretch.marks) only_kept(list);
  only_kept(stretch.at);
  return stretch;
}

/// "section 5 (name) has a corner at its point 12 that its neighbours do not have".
void tell_single_corners(const std::vector<MeasuredSection>& sections, Matched& out) {
  std::vector<std::set<std::size_t>> corners;
  std::vector<std::size_t> numbers;  // of sections that are no points
  for (std::size_t k = 0; k < sections.size(); ++k) {
    if (!sections[k].path) continue;
    numbers.push_back(k);
    corners.emplace_back();
    for (const double s : corners_of(sections[k])) corners.back().insert(point_at(sections[k], s));
  }
  for (std::size_t k = 0; k < numbers.size() && numbers.size() > 1; ++k) {
    for (const std::size_t i : corners[k]) {
      if (k > 0 && corners[k - 1].count(i) > 0) continue;
      if (k + 1 < numbers.size() && corners[k + 1].count(i) > 0) continue;
      out.warnings.push_back(fmt::format(
          "section {} ({}) has a corner at its point {} that no section beside it has: it cuts the "
          "whole skin into patches there",
          numbers[k] + 1, sections[numbers[k]].section->name, i + 1));
    }
  }
}

Result<Matched> by_points(const std::vector<MeasuredSection>& sections, std::size_t count) {
  std::set<std::size_t> fences = {0, count - 1};
  for (const MeasuredSection& section : sections) {
    if (!section.path) continue;
    for (const double s : corners_of(section)) fences.insert(point_at(section, s));
  }
  Matched result;
  tell_single_corners(sections, result);
  for (auto from = fences.begin(), to = std::next(from); to != fences.end(); from = to++) {
    std::vector<std::vector<double>> marks;
    for (const MeasuredSection& section : sections) {
      marks.emplace_back();
      if (!section.path) continue;
      const auto first = section.point_at.begin() + static_cast<std::ptrdiff_t>(*from);
      const auto last = section.point_at.begin() + static_cast<std::ptrdiff_t>(*to);
      marks.back().assign(first, last + 1);
    }
    // a closed contour ends where it began, which its last point does not repeat
    if (auto stretch = stretch_of(std::move(marks))) {
      result.stretches.push_back(std::move(*stretch));
    }
  }
  return result;
}

/// Ends of runs strictly between two arc lengths, and the directions of the runs there.
struct Runs {
  std::vector<double> ends;
  std::vector<int> directions;
};

Runs runs_between(const MeasuredSection& section, double from, double to) {
  Runs runs;
  for (const Run& run : section.section->contour.runs) {
    const double start = section.path->joint(run.first_piece);
    const double end = section.path->joint(run.last_piece + 1);
    if (std::min(end, to) > std::max(start, from)) {
      if (start > from) runs.ends.push_back(start);
      runs.directions.push_back(run.direction);
    }
  }
  return runs;
}

/// Corners (and ends) of each section as arc lengths; empty for points.
Result<std::vector<std::vector<double>>> fences_by_length(
    const std::vector<MeasuredSection>& sections) {
  std::vector<std::vector<double>> fences;
  const std::vector<double>* first = nullptr;
  for (std::size_t k = 0; k < sections.size(); ++k) {
    fences.emplace_back();
    if (!sections[k].path) continue;
    fences.back() = corners_of(sections[k]);
    fences.back().insert(fences.back().begin(), 0.0);
    fences.back().push_back(sections[k].path->length());
  }
  for (std::size_t k = 0; k < fences.size(); ++k) {
    if (fences[k].empty()) continue;
    if (first != nullptr && fences[k].size() != first->size()) {
      return error(ErrorCode::kBadOption,
                   fmt::format("section {} ({}) has {} corners where those before have {}", k + 1,
                               sections[k].section->name, fences[k].size() - 2, first->size() - 2))
          .hint(
              "give all sections equally many points, or mark the same corners in each, or "
              "allow none")
          .point(k)
          .value(static_cast<double>(fences[k].size() - 2));
    }
    first = &fences[k];
  }
  return fences;
}

/// Between corners; all sections that have a length have as many.
std::size_t stretches_of(const std::vector<std::vector<double>>& fences) {
  std::size_t most = 1;
  for (const auto& list : fences) most = std::max(most, list.size());
  return most - 1;
}

Result<Matched> by_length(const std::vector<MeasuredSection>& sections) {
  const auto fences = fences_by_length(sections);
  OBVID_TRY(fences);
  Matched result;
  for (std::size_t f = 0; f < stretches_of(*fences); ++f) {
    std::vector<std::vector<double>> marks(sections.size());
    std::optional<std::vector<int>> directions;
    bool same_runs = true;
    for (std::size_t k = 0; k < sections.size(); ++k) {
      if ((*fences)[k].empty()) continue;
      const double from = (*fences)[k][f], to = (*fences)[k][f + 1];
      Runs runs = runs_between(sections[k], from, to);
      same_runs = same_runs && (!directions || *directions == runs.directions);
      directions = runs.directions;
      marks[k] = std::move(runs.ends);
      marks[k].insert(marks[k].begin(), from);
      marks[k].push_back(to);
    }
    if (!same_runs) {
      for (auto& list : marks) {
        if (!list.empty()) list = {list.front(), list.back()};
      }
      result.warnings.push_back(fmt::format(
          "stretch {}: the sections have different runs of curvature, matched by arc length alone",
          f + 1));
    }
    if (auto stretch = stretch_of(std::move(marks))) {
      result.stretches.push_back(std::move(*stretch));
    }
  }
  return result;
}

/// Between corners by angle, or optimised.
Result<Matched> by_shape(const std::vector<MeasuredSection>& sections, SkinMatching matching,
                         const RunContext& run) {
  const auto fences = fences_by_length(sections);
  OBVID_TRY(fences);
  Matched result;
  for (std::size_t f = 0; f < stretches_of(*fences); ++f) {
    std::vector<std::vector<double>> marks(sections.size());
    for (std::size_t k = 0; k < sections.size(); ++k) {
      const std::vector<double>& fence = (*fences)[k];
      if (fence.empty()) continue;
      marks[k] = matching == SkinMatching::kByAngle
                     ? marks_by_angle(sections[k], fence[f], fence[f + 1])
                     : std::vector<double>{fence[f], fence[f + 1]};
    }
    OBVID_TRY(may_go_on(run));
    if (matching == SkinMatching::kOptimised) {
      auto least = marks_of_least_bending(sections, marks, run);
      OBVID_TRY(least);
      marks = std::move(*least);
    }
    if (auto stretch = stretch_of(std::move(marks))) {
      result.stretches.push_back(std::move(*stretch));
    }
  }
  return result;
}

}  // namespace

std::vector<double> corners_of(const MeasuredSection& section) {
  std::vector<double> corners;
  const std::vector<Joint>& joints = section.section->contour.joints;
  for (std::size_t k = 1; k < joints.size(); ++k) {
    const bool end = !section.section->contour.closed && k + 1 == joints.size();
    if (joints[k].leaving && !end) corners.push_back(section.path->joint(k));
  }
  return corners;
}

Result<MeasuredSection> measured(const SkinSection& section) {
  MeasuredSection result{&section, std::nullopt, {}};
  if (section.contour.pieces.empty()) return result;
  auto path = ContourPath::without_cusps(section.contour.pieces);
  OBVID_TRY(path);
  result.path = std::move(*path);
  const std::vector<double> at = contour_points_at(section.contour, *result.path);
  for (const std::size_t i : section.on_contour) result.point_at.push_back(at[i]);
  const bool returns = section.contour.closed && section.on_contour.size() > 1 &&
                       section.on_contour.back() == section.on_contour.front();
  if (returns) result.point_at.back() = result.path->length();
  return result;
}

Result<Matched> matched(const std::vector<MeasuredSection>& sections, SkinMatching matching,
                        const RunContext& run) {
  bool equal = true;
  const std::size_t count = sections.front().section->points.size();
  std::size_t odd = 0;
  for (std::size_t k = 0; k < sections.size(); ++k) {
    if (sections[k].section->points.size() == count) continue;
    if (equal) odd = k;
    equal = false;
  }
  if (matching == SkinMatching::kByPoints && !equal) {
    return error(ErrorCode::kUsage,
                 fmt::format("section {} ({}) has {} points where the first has {}", odd + 1,
                             sections[odd].section->name, sections[odd].section->points.size(),
                             count))
        .hint("match by length")
        .point(odd);
  }
  const bool points =
      matching == SkinMatching::kByPoints || (matching == SkinMatching::kAutomatic && equal);
  const bool shape = matching == SkinMatching::kByAngle || matching == SkinMatching::kOptimised;
  Result<Matched> result = points  ? by_points(sections, count)
                           : shape ? by_shape(sections, matching, run)
                                   : by_length(sections);
  if (!result) return result;
  result->matching = points ? SkinMatching::kByPoints : shape ? matching : SkinMatching::kByLength;
  if (result->stretches.empty()) {
    return error(ErrorCode::kNothingThere, "no section has a length");
  }
  return result;
}

}  // namespace obvid
