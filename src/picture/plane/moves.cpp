// SPDX-License-Identifier: Apache-2.0
#include "plane/moves.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "obvid/picture/internal/styles.h"
#include "plane/axis.h"
#include "plane/frame.h"

namespace obvid {
namespace {

/// The contour reaches the next point within this many times their distance of arc length; further
/// on it belongs to later points.
constexpr double kReach = 3.0;
/// The strip ends beyond the tolerance, so that its lines and what breaks them are seen.
constexpr double kBeyond = 1.25;
/// Teeth are thinned to the extremes of columns this wide, px.
constexpr double kToothColumn = 0.5;
/// Points at least this far apart, px, on the average get dots.
constexpr double kDotsApart = 5.0;
constexpr double kDot = 1.8;  // radius, px

/// Sample at the joint that stands for each point, where there is one.
std::vector<std::optional<std::size_t>> samples_of_joints(const PictureTrack& track,
                                                          const Contour& contour) {
  std::vector<std::optional<std::size_t>> found(track.points.size());
  for (std::size_t i = 0; i < contour.joints.size() && i <= track.pieces.size(); ++i) {
    const auto source = contour.joints[i].source;
    if (!source || *source >= found.size() || found[*source]) continue;
    found[*source] = i < track.pieces.size() ? track.first[i] : track.samples.size() - 1;
  }
  return found;
}

/// A closed contour may begin at any of its points: the walk begins where its place is known.
std::size_t first_to_visit(const PictureTrack& track,
                           const std::vector<std::optional<std::size_t>>& joints) {
  if (!track.closed) return 0;
  const auto known = std::find_if(joints.begin(), joints.end(),
                                  [](const auto& sample) { return sample.has_value(); });
  return known == joints.end() ? 0 : static_cast<std::size_t>(known - joints.begin());
}

/// Walks along the samples from point to point.
class Walk {
 public:
  explicit Walk(const PictureTrack& track) : track_(track) {}

  void jump(std::size_t sample, Vec2 point) {
    at_ = sample;
    point_ = point;
  }
  /// Nearest sample that is not before the last one; along closed contours it goes round.
  std::size_t next(Vec2 point) {
    const double reach =
        kReach * (norm(point - point_) + distance(at_, point_) + distance(at_, point));
    std::size_t best = at_;
    double travelled = 0.0;
    std::size_t j = at_;
    for (std::size_t step = 0; step < track_.samples.size(); ++step) {
      if (distance(j, point) < distance(best, point)) best = j;
      if (j + 1 == track_.samples.size() && !track_.closed) break;
      const std::size_t after = (j + 1) % track_.samples.size();
      if (after != 0) travelled += track_.samples[after].s - track_.samples[j].s;
      if (travelled > reach) break;
      j = after;
    }
    jump(best, point);
    return best;
  }

 private:
  [[nodiscard]] double distance(std::size_t sample, Vec2 point) const {
    return norm(point - track_.samples[sample].point);
  }

  const PictureTrack& track_;
  std::size_t at_ = 0;
  Vec2 point_;
};

bool any_tolerance(const Contour& contour) {
  const auto& list = contour.point_tolerance;
  return list.size() == contour.points.size() &&
         std::any_of(list.begin(), list.end(), [](double t) { return t > 0.0; });
}

PictureMove move_at(const PictureTrack& track, std::size_t at, Vec2 point, double distance,
                    double tolerance) {
  const PictureSample& sample = track.samples[at];
  PictureMove move;
  move.s = sample.s;
  move.sample = at;
  const Vec2 aside = point - sample.point;
  if (!(tolerance > 0.0) || !std::isfinite(distance)) return move;
  move.part = distance / tolerance;
  if (dot(aside, left_normal(sample.tangent)) < 0.0) move.part = -move.part;
  return move;
}

/// Distance from the line of the sample: between two samples the contour is nearer than they are.
double distance_from(const PictureSample& sample, Vec2 point) {
  return std::fabs(dot(point - sample.point, left_normal(sample.tangent)));
}

/// Teeth, thinned where they stand dense.
std::string teeth_of(const PictureFrame& frame, const std::vector<PictureMove>& moves) {
  PicturePath path;
  const double zero = frame.px_y(0.0);
  double low = zero, high = zero, x = 0.0;
  bool open = false;
  const auto flush = [&] {
    if (!open) return;
    path.move({x, low});
    path.line({x, high});
  };
  for (const PictureMove& move : moves) {
    const double at = frame.px_x(move.s);
    const double y = frame.px_y(std::clamp(move.part, frame.y.low, frame.y.high));
    if (!open || std::floor(at / kToothColumn) != std::floor(x / kToothColumn)) {
      flush();
      low = high = zero;
      x = at;
      open = true;
    }
    low = std::min(low, y);
    high = std::max(high, y);
  }
  flush();
  return path.text();
}

std::string dots_of(const PictureFrame& frame, const std::vector<PictureMove>& moves,
                    std::size_t all) {
  const double room = frame.right - frame.left;
  if (static_cast<double>(all) * kDotsApart > room) return {};
  std::string dots;
  for (const PictureMove& move : moves) {
    const double y = frame.px_y(std::clamp(move.part, frame.y.low, frame.y.high));
    dots += fmt::format("M{} {}h.01", px(frame.px_x(move.s)), px(y));
  }
  return dots;
}

std::vector<PictureMove> of_class(const std::vector<PictureMove>& moves, MoveClass kind) {
  std::vector<PictureMove> out;
  std::copy_if(moves.begin(), moves.end(), std::back_inserter(out),
               [kind](const PictureMove& move) { return class_of(move) == kind; });
  return out;
}

/// `all`: points of the strip, of which `moves` may be some.
void add_teeth(PictureCanvas& canvas, const PictureFrame& frame,
               const std::vector<PictureMove>& moves, std::size_t all, const std::string& css) {
  if (moves.empty()) return;
  canvas.add("<path class=\"move{}\" d=\"{}\"/>\n", css, teeth_of(frame, moves));
  const std::string dots = dots_of(frame, moves, all);
  if (dots.empty()) return;
  canvas.add("<path class=\"dot{}\" stroke-width=\"{}\" d=\"{}\"/>\n", css, px(2.0 * kDot), dots);
}

}  // namespace

PictureMoves make_moves(const PictureTrack& track, const StoredContour& stored, double allowed) {
  PictureMoves moves;
  const Contour& contour = stored.contour;
  if (allowed > 0.0) moves.limit = fmt::format("{} {}", allowed, contour.units.text());
  if (track.samples.empty() || !(allowed > 0.0 || any_tolerance(contour))) return moves;
  const auto joints = samples_of_joints(track, contour);
  const std::size_t count = track.points.size();
  const bool known = stored.report && stored.report->moves.size() == count;
  moves.points.resize(count);
  double squares = 0.0;
  Walk walk(track);
  walk.jump(0, track.samples.front().point);
  const std::size_t start = first_to_visit(track, joints);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = (start + k) % count;
    const Vec2 point = track.points[i];
    if (joints[i]) walk.jump(*joints[i], point);
    const std::size_t at = joints[i] ? *joints[i] : walk.next(point);
    const double distance =
        known ? stored.report->moves[i] : distance_from(track.samples[at], point);
    moves.points[i] =
        move_at(track, at, point, distance, allowed > 0.0 ? allowed : contour.point_tolerance[i]);
    moves.largest = std::max(moves.largest, distance);
    squares += distance * distance;
  }
  moves.root_mean_square = std::sqrt(squares / static_cast<double>(count));
  return moves;
}

void draw_moves(PictureCanvas& canvas, PictureFrame frame, const PictureTrack& track,
                const PictureMoves& moves, const std::string& units, bool coloured) {
  frame.y.low = -kBeyond;
  frame.y.high = kBeyond;
  frame.y.ticks = {{0.0, "0"}};
  canvas.label(
      {kPictureMargin, frame.top - 11.0}, "start", "axis-title",
      "Points beside the contour, in units of " + moves.limit + " (left +), at most " +
          readable_bound(moves.largest, 2) + " " + units +
          (coloured ? ", RMS " + readable_number(moves.root_mean_square, 2) + " " + units : ""));
  draw_grid(canvas, frame, false);
  draw_joints(canvas, frame, track);
  for (const double limit : {-1.0, 1.0}) {
    const double y = frame.px_y(limit);
    canvas.line({frame.left, y}, {frame.right, y}, "limit");
    canvas.label({frame.left - 8.0, y + 4.0}, "end", "small", limit < 0.0 ? "−1" : "+1");
  }
  if (!coloured) {
    add_teeth(canvas, frame, moves.points, moves.points.size(), "");
    return;
  }
  for (const MoveClass kind : kMoveClasses) {
    add_teeth(canvas, frame, of_class(moves.points, kind), moves.points.size(),
              std::string(" ") + move_css(kind));
  }
}

MoveClass class_of(const PictureMove& move) {
  constexpr double kRounding = 1e-9;  // points stand on the edge of their tolerance
  const double part = std::fabs(move.part);
  if (part > 1.0 + kRounding) return MoveClass::kBeyond;
  return part > 0.5 ? MoveClass::kWithin : MoveClass::kHalf;
}

const char* move_css(MoveClass kind) {
  switch (kind) {
    case MoveClass::kHalf:
      return "half";
    case MoveClass::kWithin:
      return "within";
    case MoveClass::kBeyond:
      break;
  }
  return "beyond";
}

void draw_deviations(PictureCanvas& canvas, const PictureTrack& track, const PictureMoves& moves,
                     const PictureView& view) {
  constexpr double kLongest = 2.0;    // tolerances
  constexpr double kLeastStep = 0.5;  // px; a tooth beside another one that is as long adds nothing
  canvas.add("{}", picture::style_element(picture::deviations_style()));
  for (const MoveClass kind : kMoveClasses) {
    PicturePath path;
    Vec2 last{HUGE_VAL, HUGE_VAL};
    double last_part = 0.0;
    for (const PictureMove& move : of_class(moves.points, kind)) {
      const PictureSample& sample = track.samples[move.sample];
      const Vec2 at = view(sample.point);
      const double part = std::clamp(move.part, -kLongest, kLongest);
      const bool beside = norm(at - last) < kLeastStep && part * last_part >= 0.0 &&
                          std::fabs(part) <= std::fabs(last_part);
      if (beside) continue;
      const Vec2 left = left_normal(sample.tangent);
      path.move(at);
      path.line(at + (kMoveTooth * part) * Vec2{left.x, -left.y});
      last = at;
      last_part = part;
    }
    if (path.empty()) continue;
    canvas.add("<path class=\"deviation {}\" d=\"{}\"/>\n", move_css(kind), path.text());
  }
}

}  // namespace obvid
