// SPDX-License-Identifier: Apache-2.0
#include "plane/track.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "obvid/core/internal/questions.h"
#include "obvid/curve/internal/contour_path.h"
#include "obvid/curve/internal/curvature_extent.h"

namespace obvid {
namespace {

/// Samples aimed at over the whole contour when it has few pieces.
constexpr std::size_t kSampleBudget = 20000;
constexpr std::size_t kFewestSteps = 2;
constexpr std::size_t kUsualSteps = 64;
constexpr std::size_t kMostSteps = 400;
/// Steps per box diagonal of chord: a step is then about 2 px wide.
constexpr double kStepsPerDiagonal = 400.0;
/// Curvatures below this part of the largest are straight to the eye and to the sign test.
constexpr double kStraightPart = 1e-9;
/// Curvatures below this, times the size, bend a line by less than coordinates can say.
constexpr double kStraightLineAngle = 1e-12;
/// Curvatures that differ by less, relatively, are the same on both sides of a corner.
constexpr double kSameCurvature = 1e-7;
constexpr double kLengthAccuracy = 1e-6;  // of a piece: far below a pixel
constexpr int kBisections = 48;

PictureSample sample_at(const Piece& piece, double t) {
  const Jet jet = evaluate(piece, t);
  const double speed = norm(jet.d1);
  const Vec2 tangent = speed > 0.0 ? jet.d1 / speed : Vec2{1.0, 0.0};
  const bool straight = std::holds_alternative<LinePiece>(piece);
  const double kappa = straight ? 0.0 : curvature(jet);
  const double slope = straight ? 0.0 : curvature_rate(jet);
  return {jet.point, tangent,
          0.0,       std::isfinite(kappa) ? kappa : 0.0,
          t,         std::isfinite(slope) ? slope : 0.0};
}

std::size_t steps_for(const Piece& piece, std::size_t pieces, double diagonal) {
  const std::size_t usual = std::clamp(kSampleBudget / pieces, kFewestSteps, kUsualSteps);
  const double chord = norm(end_point(piece) - start_point(piece));
  const double wanted = diagonal > 0.0 ? kStepsPerDiagonal * chord / diagonal : 0.0;
  const auto long_piece = static_cast<std::size_t>(std::min(wanted, double(kMostSteps)));
  return std::max(usual, long_piece);
}

void sample_pieces(PictureTrack& track, Watch* watch) {
  const double diagonal = track.box.diagonal();
  const ContourPath path(track.pieces, kLengthAccuracy, watch);
  Questions questions(watch);
  track.length = path.length();
  for (std::size_t i = 0; i < track.pieces.size(); ++i) {
    const Piece& piece = track.pieces[i];
    if (questions.end()) return;
    track.first.push_back(track.samples.size());
    const std::size_t steps = steps_for(piece, track.pieces.size(), diagonal);
    for (std::size_t j = 0; j <= steps; ++j) {
      PictureSample next = sample_at(piece, static_cast<double>(j) / static_cast<double>(steps));
      next.s = path.length_at(i, next.t);
      track.samples.push_back(next);
      track.box.add(next.point);
      track.largest_kappa = std::max(track.largest_kappa, std::fabs(next.kappa));
    }
  }
  track.first.push_back(track.samples.size());
}

/// The longest tooth is that of the curve, not of the sample beside it.
void refine_largest(PictureTrack& track, Watch* watch) {
  Questions questions(watch);
  for (std::size_t i = 0; i < track.pieces.size(); ++i) {
    if (questions.end()) return;
    std::vector<double> at;
    for (std::size_t k = track.first[i]; k < track.first[i + 1]; ++k) {
      at.push_back(track.samples[k].t);
    }
    const CurvatureExtent range = curvature_extent(track.pieces[i], at, track.largest_kappa);
    track.largest_kappa =
        std::max({track.largest_kappa, std::fabs(range.least), std::fabs(range.largest)});
  }
}

void set_directions(PictureTrack& track, const std::vector<Run>& runs) {
  track.direction.assign(track.pieces.size(), kNoRun);
  for (const Run& run : runs) {
    const std::size_t last = std::min(run.last_piece + 1, track.pieces.size());
    for (std::size_t i = run.first_piece; i < last; ++i) track.direction[i] = run.direction;
  }
}

void set_corners(PictureTrack& track, const Contour& contour) {
  track.closed = contour.closed;
  track.corner.assign(track.pieces.size(), false);
  for (std::size_t i = contour.closed ? 0 : 1; i < track.pieces.size(); ++i) {
    if (i >= contour.joints.size() || !contour.joints[i].leaving) continue;
    track.corner[i] = true;  // also where the curvature alone steps
    if (!is_corner(contour.joints[i])) continue;
    track.features.push_back({PictureFeature::Kind::kCorner, track.samples[track.first[i]]});
  }
}

/// Sign of the curvature's jump at the corner before a piece; 0 elsewhere.
int corner_jump(const PictureTrack& track, std::size_t piece) {
  if (!track.corner[piece]) return 0;
  const std::size_t after = track.first[piece];
  const double in = (after == 0 ? track.samples.back() : track.samples[after - 1]).kappa;
  const double out = track.samples[after].kappa;
  const double level =
      std::max({std::fabs(in), std::fabs(out), track.largest_kappa * kStraightPart});
  if (std::fabs(out - in) <= kSameCurvature * level) return 0;
  return out > in ? 1 : -1;
}

/// One step of the way of change along a contour: a piece, or the jump at a corner.
struct Change {
  int sign = 0;
  std::size_t first = 0;  // samples
  std::size_t last = 0;
};

/// The way of change from sample to sample of a piece, as far as it stands out of the rounding.
void add_steps(const PictureTrack& track, std::size_t piece, std::vector<Change>& changes) {
  for (std::size_t j = track.first[piece] + 1; j < track.first[piece + 1]; ++j) {
    const double step = track.samples[j].kappa - track.samples[j - 1].kappa;
    if (std::fabs(step) <= kSameCurvature * track.largest_kappa) continue;
    changes.push_back({step > 0.0 ? 1 : -1, j - 1, j});
  }
}

std::vector<Change> changes_of(const PictureTrack& track) {
  std::vector<Change> changes;
  for (std::size_t i = 0; i < track.pieces.size(); ++i) {
    const std::size_t start = track.first[i];
    if (const int jump = corner_jump(track, i)) changes.push_back({jump, start, start});
    if (!track.runs_tell) {
      add_steps(track, i, changes);
      continue;
    }
    const int now = track.direction[i];
    if (now == 1 || now == -1) changes.push_back({now, start, track.first[i + 1] - 1});
  }
  return changes;
}

/// Vertices stand where the direction of change turns round, jumps at corners included; a circle
/// between two opposite runs is one vertex, marked in its middle.
void find_vertices(PictureTrack& track) {
  const std::vector<Change> changes = changes_of(track);
  const auto mark = [&track](std::size_t sample) {
    track.features.push_back({PictureFeature::Kind::kVertex, track.samples[sample]});
  };
  for (std::size_t j = 1; j < changes.size(); ++j) {
    if (changes[j].sign == changes[j - 1].sign) continue;
    mark((changes[j - 1].last + 1 + changes[j].first) / 2);
  }
  if (!track.closed || changes.size() < 2 || changes.front().sign == changes.back().sign) return;
  // Across the seam: the circle in the middle may lie on both its sides.
  const std::size_t count = track.samples.size();
  const std::size_t between = count - changes.back().last - 1 + changes.front().first;
  mark((changes.back().last + 1 + between / 2) % count);
}

PictureSample refine_inflection(const Piece& piece, PictureSample a, PictureSample b) {
  for (int j = 0; j < kBisections && a.t < b.t; ++j) {
    const double t = 0.5 * (a.t + b.t);
    if (t <= a.t || t >= b.t) break;
    PictureSample middle = sample_at(piece, t);
    middle.s = 0.5 * (a.s + b.s);
    ((middle.kappa < 0.0) == (a.kappa < 0.0) ? a : b) = middle;
  }
  return a;
}

void find_inflections(PictureTrack& track) {
  const double diagonal = track.box.diagonal();
  const double straight = std::max(kStraightPart * track.largest_kappa,
                                   diagonal > 0.0 ? kStraightLineAngle / diagonal : 0.0);
  std::size_t last = track.samples.size();   // last sample with a sign
  std::size_t first = track.samples.size();  // first one
  std::size_t last_piece = 0;
  for (std::size_t i = 0; i < track.pieces.size(); ++i) {
    for (std::size_t j = track.first[i]; j < track.first[i + 1]; ++j) {
      const PictureSample& now = track.samples[j];
      if (std::fabs(now.kappa) <= straight) continue;
      if (last < track.samples.size() && (track.samples[last].kappa < 0.0) != (now.kappa < 0.0)) {
        const bool inside = last_piece == i && j == last + 1;
        const PictureSample at = inside
                                     ? refine_inflection(track.pieces[i], track.samples[last], now)
                                     : track.samples[(last + j) / 2];
        track.features.push_back({PictureFeature::Kind::kInflection, at});
      }
      if (last == track.samples.size()) first = j;
      last = j;
      last_piece = i;
    }
  }
  if (!track.closed || last == track.samples.size()) return;
  if ((track.samples[last].kappa < 0.0) == (track.samples[first].kappa < 0.0)) return;
  track.features.push_back({PictureFeature::Kind::kInflection, track.samples.front()});
}

/// Jump of the curvature at the start of a piece; 0 at both ends of the contour.
double jump_before(const PictureTrack& track, std::size_t piece) {
  if (piece == 0 || piece >= track.pieces.size()) return 0.0;
  const std::size_t j = track.first[piece];
  return std::fabs(track.samples[j].kappa - track.samples[j - 1].kappa);
}

/// Change of curvature that stands for the step to each sample from the one before. Jumps at
/// joints (arcs) are shared by both neighbours and spread over their whole length.
std::vector<double> curvature_change(const PictureTrack& track) {
  std::vector<double> change(track.samples.size(), 0.0);
  for (std::size_t i = 0; i < track.pieces.size(); ++i) {
    const std::size_t last = track.first[i + 1] - 1;
    const double length = track.samples[last].s - track.samples[track.first[i]].s;
    const double jumps = 0.5 * (jump_before(track, i) + jump_before(track, i + 1));
    for (std::size_t j = track.first[i] + 1; j <= last; ++j) {
      const PictureSample& a = track.samples[j - 1];
      const PictureSample& b = track.samples[j];
      change[j] = std::fabs(b.kappa - a.kappa);
      if (length > 0.0) change[j] += jumps * (b.s - a.s) / length;
    }
  }
  return change;
}

}  // namespace

PictureTrack make_track(const Contour& contour, Watch* watch) {
  PictureTrack track;
  if (!contour.pieces.empty()) {
    track.reference = start_point(contour.pieces.front());
  } else if (!contour.points.empty()) {
    track.reference = contour.points.front();
  }
  track.pieces.reserve(contour.pieces.size());
  for (const Piece& piece : contour.pieces) {
    track.pieces.push_back(moved(piece, -track.reference));
    track.box.add(start_point(track.pieces.back()));
    track.box.add(end_point(track.pieces.back()));
  }
  for (const Vec2 p : contour.points) {
    track.points.push_back(p - track.reference);
    track.box.add(track.points.back());
  }
  track.runs_tell = promises_monotone(contour.carrier);
  sample_pieces(track, watch);
  if (has_ended(watch)) return track;
  refine_largest(track, watch);
  set_directions(track, contour.runs);
  set_corners(track, contour);
  find_vertices(track);
  find_inflections(track);
  const auto earlier = [](const PictureFeature& a, const PictureFeature& b) {
    return a.at.s < b.at.s;
  };
  std::stable_sort(track.features.begin(), track.features.end(), earlier);
  track.counts = counts_of_marks(track);
  return track;
}

void take_counts(PictureTrack& track, const Certificate& certificate) {
  const auto open = [](const PieceProof& piece) { return piece.verdict == Verdict::kUndecided; };
  const bool counted = !certificate.pieces.empty() &&
                       std::none_of(certificate.pieces.begin(), certificate.pieces.end(), open);
  if (!counted) return;
  const auto count = [](int n) { return static_cast<std::size_t>(std::max(n, 0)); };
  track.counts.vertices = count(certificate.vertices);
  track.counts.inflections = count(certificate.inflections);
  std::erase_if(track.features, [&](const PictureFeature& f) {
    return (f.kind == PictureFeature::Kind::kVertex && track.counts.vertices == 0) ||
           (f.kind == PictureFeature::Kind::kInflection && track.counts.inflections == 0);
  });
}

PictureCounts counts_of_marks(const PictureTrack& track) {
  return {count_features(track, PictureFeature::Kind::kVertex),
          count_features(track, PictureFeature::Kind::kInflection),
          count_features(track, PictureFeature::Kind::kCorner)};
}

std::size_t count_features(const PictureTrack& track, PictureFeature::Kind kind) {
  const auto same = [kind](const PictureFeature& f) { return f.kind == kind; };
  return static_cast<std::size_t>(
      std::count_if(track.features.begin(), track.features.end(), same));
}

std::vector<PictureTooth> comb_teeth(const PictureTrack& track, int count) {
  std::vector<PictureTooth> teeth;
  if (track.length <= 0.0 || count < 1) return teeth;
  const std::vector<double> change = curvature_change(track);
  const double variation = std::accumulate(change.begin(), change.end(), 0.0);
  const bool varies = variation > kStraightPart * track.largest_kappa;
  const double even = varies && !track.even_teeth ? 0.5 : 1.0;
  double done = 0.0;
  double next = 0.0;  // measure at which the next tooth stands
  for (std::size_t i = 0; i < track.pieces.size(); ++i) {
    for (std::size_t j = track.first[i] + 1; j < track.first[i + 1]; ++j) {
      const PictureSample& a = track.samples[j - 1];
      const PictureSample& b = track.samples[j];
      const double bend = varies ? change[j] / variation : 0.0;
      const double part = even * (b.s - a.s) / track.length + (1.0 - even) * bend;
      for (; part > 0.0 && next <= done + part; next += 1.0 / count) {
        const double f = std::clamp((next - done) / part, 0.0, 1.0);
        PictureTooth tooth = sample_at(track.pieces[i], a.t + f * (b.t - a.t));
        tooth.s = a.s + f * (b.s - a.s);
        teeth.push_back(tooth);
      }
      done += part;
    }
  }
  teeth.push_back(track.samples.back());
  return teeth;
}

}  // namespace obvid
