// SPDX-License-Identifier: Apache-2.0
#include "plane/region.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "obvid/series/analysis.h"

namespace obvid {
namespace {

/// Beyond this many points a chord is on the average below a quarter of a px: nothing to see.
constexpr std::size_t kMostRegionPoints = 4000;
/// Turn of one cubic, rad: it then stays within 5e-6 radii of the circle.
constexpr double kCubicTurn = std::numbers::pi / 4.0;

/// Common direction of two neighbouring parts; a constant part goes with either.
int merged(int a, int b) {
  if (a == 0 || a == b) return b;
  return b == 0 ? a : kNoRun;
}

/// Direction of the contour from each point to the next; kNoRun where it changes or is not known.
std::vector<int> chord_directions(const PictureTrack& track, const Contour& contour) {
  std::vector<int> direction(contour.points.size() - 1, kNoRun);
  const std::size_t joints = contour.joints.size();
  if (joints != track.pieces.size() + 1 && !(contour.closed && joints == track.pieces.size())) {
    return direction;
  }
  std::optional<std::size_t> chord;
  int common = 0;
  for (std::size_t j = 0; j < track.pieces.size(); ++j) {
    if (is_station(contour.joints[j])) {
      chord = contour.joints[j].source;
      common = 0;
    }
    common = merged(common, track.direction[j]);
    const auto next = contour.joints[(j + 1) % joints].source;
    if (chord && next && *next == *chord + 1 && *chord < direction.size()) {
      direction[*chord] = common;
    }
  }
  return direction;
}

/// Per point, whether the contour turns there at once: three points around it lie on no circle that
/// says anything.
std::vector<bool> corner_marks(const Contour& contour) {
  std::vector<bool> corner(contour.points.size(), false);
  for (const Joint& joint : contour.joints) {
    if (joint.leaving && joint.source && *joint.source < corner.size())
      corner[*joint.source] = true;
  }
  return corner;
}

/// Point at the part `f` of an arc; exact for a straight one too.
Vec2 point_of_arc(Vec2 start, Vec2 chord, double half_turn, double f) {
  const double part = half_turn == 0.0 ? f : std::sin(f * half_turn) / std::sin(half_turn);
  return start + part * complex_product(chord, unit_at((f - 1.0) * half_turn));
}

/// Cubics along an arc from `start` (where the pen is) over `chord`.
void add_arc(PicturePath& path, Vec2 start, Vec2 chord, double half_turn, const PictureView& view) {
  const auto count = static_cast<int>(std::floor(2.0 * std::fabs(half_turn) / kCubicTurn)) + 1;
  const double turn = 2.0 * half_turn / count;
  const double cosine = std::cos(0.25 * turn);
  const double handle = 1.0 / (3.0 * cosine * cosine);  // of the chord of one cubic
  Vec2 from = start;
  for (int i = 1; i <= count; ++i) {
    const Vec2 to = i == count ? start + chord
                               : point_of_arc(start, chord, half_turn,
                                              static_cast<double>(i) / static_cast<double>(count));
    const Vec2 a = handle * complex_product(to - from, unit_at(-0.5 * turn));
    const Vec2 b = handle * complex_product(to - from, unit_at(0.5 * turn));
    path.cubic(view(from + a), view(to - b), view(to));
    from = to;
  }
}

/// Chords of which the report says an error from the points alone; all where there is no report.
std::vector<bool> reported_chords(const FitReport* report, std::size_t points) {
  std::vector<bool> out(points, report == nullptr);
  if (report == nullptr) return out;
  for (const SegmentReport& s : report->segments) {
    const bool known = s.from && s.to && *s.from < points && !std::isnan(s.points_only_error);
    if (known && *s.to == *s.from + 1) out[*s.from] = true;
  }
  return out;
}

}  // namespace

std::vector<PictureLens> points_only_region(const PictureTrack& track, const Contour& contour,
                                            const FitReport* report) {
  std::vector<PictureLens> region;
  const std::vector<Vec2>& points = track.points;
  if (!contour.point_tolerance.empty()) return region;  // the contour need not meet the points
  if (points.size() < 4 || points.size() > kMostRegionPoints) return region;
  if (std::adjacent_find(points.begin(), points.end()) != points.end()) return region;
  const Result<Analysis> analysis = analyse(points);
  if (!analysis) return region;
  const std::vector<int> direction = chord_directions(track, contour);
  const std::vector<bool> corner = corner_marks(contour);
  const std::vector<bool> told = reported_chords(report, points.size());
  for (std::size_t i = 1; i + 1 < direction.size(); ++i) {
    if (corner[i] || corner[i + 1] || !told[i]) continue;
    // The circles of both points bound a curve only where it is monotone as far as these circles
    // reach, which is one chord further on either side.
    const int common = merged(merged(direction[i - 1], direction[i]), direction[i + 1]);
    if ((common != 1 && common != -1) || common != analysis->direction[i]) continue;
    if (std::isnan(analysis->points_only_error[i])) continue;
    region.push_back({points[i],
                      points[i + 1],
                      {analysis->circles[i].eta_out, analysis->circles[i + 1].eta_in},
                      analysis->points_only_error[i]});
  }
  return region;
}

void add_lens(PicturePath& path, const PictureLens& lens, const PictureView& view) {
  const Vec2 chord = lens.end - lens.start;
  path.move(view(lens.start));
  add_arc(path, lens.start, chord, lens.half_turn[0], view);
  add_arc(path, lens.end, -chord, -lens.half_turn[1], view);
}

}  // namespace obvid
