// SPDX-License-Identifier: Apache-2.0
#include "obvid/picture/internal/longitudinals_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "obvid/core/internal/figures.h"
#include "obvid/curve/internal/basis.h"
#include "plane/axis.h"
#include "plane/canvas.h"
#include "plane/frame.h"
#include "plane/panels.h"
#include "plane/sheet.h"

namespace obvid {
namespace {

constexpr double kFirstLongitudinal = 122.0;  // px
constexpr double kLongitudinalHeight = 84.0;
constexpr double kLongitudinalsApart = 40.0;  // with the line's name
constexpr double kLongitudinalsFoot = 62.0;
constexpr double kSectionTick = 5.0;    // half of it
constexpr double kSampleLength = 26.0;  // of the legend
/// Of the curvatures by size: towards points in which lines end a few grow without bound.
constexpr double kShownShare = 0.98;
constexpr double kRoomBeyond = 1.15;

/// What is shown of the curvatures, and 0.
Range shown_curvatures(const Longitudinal& line) {
  std::vector<double> all = line.now.k;
  if (line.before) all.insert(all.end(), line.before->k.begin(), line.before->k.end());
  if (all.empty()) return {-1.0, 1.0};
  std::vector<double> sizes(all.size());
  std::transform(all.begin(), all.end(), sizes.begin(), [](double k) { return std::abs(k); });
  const auto at = static_cast<std::ptrdiff_t>(kShownShare * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), sizes.begin() + at, sizes.end());
  const double most = sizes[static_cast<std::size_t>(at)] * kRoomBeyond;
  const auto [low, high] = std::minmax_element(all.begin(), all.end());
  const Range out{std::clamp(*low, -most, 0.0), std::clamp(*high, 0.0, most)};
  return out.length() > 0.0 ? out : Range{-1.0, 1.0};
}

bool leaves_the_plot(const Longitudinal& line, const PictureAxis& y) {
  const auto beyond = [&](const LineCurvature& one) {
    return std::any_of(one.k.begin(), one.k.end(),
                       [&](double k) { return k < y.low || k > y.high; });
  };
  return beyond(line.now) || (line.before && beyond(*line.before));
}

/// What is larger runs along the edge of the plot.
void draw_longitudinal(PictureCanvas& canvas, const PictureFrame& frame, const LineCurvature& line,
                       const char* css) {
  PicturePath path;
  for (std::size_t i = 0; i < line.s.size(); ++i) {
    const Vec2 at{frame.px_x(line.s[i]),
                  std::clamp(frame.px_y(line.k[i]), frame.top, frame.bottom)};
    path.empty() ? path.move(at) : path.thin_line(at, 0.3);
  }
  if (!path.empty()) canvas.add("<path class=\"{}\" d=\"{}\"/>\n", css, path.text());
}

std::string name_of_line(const Longitudinal& line, bool cut) {
  std::string out = line.name + " · changes of sign: ";
  out += line.before ? fmt::format("{} before, {} now", line.before->changes, line.now.changes)
                     : std::to_string(line.now.changes);
  return cut ? out + " · larger curvatures along the edge" : out;
}

void draw_longitudinal_plot(PictureCanvas& canvas, const Longitudinal& line, PictureFrame frame,
                            bool last) {
  const Range shown = shown_curvatures(line);
  frame.y = round_axis(shown.from, shown.to, 4);
  canvas.label({kPictureMargin, frame.top - 12.0}, "start", "small",
               name_of_line(line, leaves_the_plot(line, frame.y)));
  const std::string power = power_prefix(frame.y.exponent);
  if (!power.empty()) {
    canvas.label({frame.right, frame.top - 12.0}, "end", "note", "in " + power);
  }
  draw_grid(canvas, frame, last);
  const double zero = frame.px_y(0.0);
  canvas.line({frame.left, zero}, {frame.right, zero}, "axis");
  PicturePath ticks;
  for (const double s : line.sections) {
    ticks.move({frame.px_x(s), zero - kSectionTick});
    ticks.line({frame.px_x(s), zero + kSectionTick});
  }
  if (!ticks.empty()) canvas.add("<path class=\"joint\" d=\"{}\"/>\n", ticks.text());
  if (line.before) draw_longitudinal(canvas, frame, *line.before, "teeth");
  draw_longitudinal(canvas, frame, line.now, "graph up");
}

void draw_longitudinals_key(PictureCanvas& canvas, const LongitudinalsPicture& picture, double y) {
  double x = kPictureMargin;
  const auto entry = [&](const char* css, const std::string& text, double room) {
    canvas.line({x, y - 4.0}, {x + kSampleLength, y - 4.0}, css);
    canvas.label({x + kSampleLength + 8.0, y}, "start", "small", text);
    x += room;
  };
  const bool compared = std::any_of(picture.lines.begin(), picture.lines.end(),
                                    [](const Longitudinal& line) { return line.before; });
  if (compared) entry("teeth", "exact skin", 150.0);
  entry("graph up", compared ? "as made" : "normal curvature", 190.0);
  canvas.line({x + 4.0, y - 4.0 - kSectionTick}, {x + 4.0, y - 4.0 + kSectionTick}, "joint");
  canvas.label({x + 16.0, y}, "start", "small", picture.of_sections ? "sections" : "knots across");
}

std::string all_changes(const LongitudinalsPicture& picture) {
  std::size_t now = 0, before = 0;
  bool compared = false;
  for (const Longitudinal& line : picture.lines) {
    now += line.now.changes;
    before += line.before ? line.before->changes : 0;
    compared = compared || line.before;
  }
  const std::string of = fmt::format("on {} lines u = const", picture.lines.size());
  return compared ? fmt::format("Changes of sign {}: {} before, {} now", of, before, now)
                  : fmt::format("Changes of sign {}: {}", of, now);
}

}  // namespace

std::string longitudinals_svg(const LongitudinalsPicture& picture) {
  const std::string title = "Normal curvature of longitudinals · " + picture.title;
  const std::string fact =
      all_changes(picture) + ", of any height but rounding (1e-6 of the line's largest)";
  double longest = 0.0;
  for (const Longitudinal& line : picture.lines) {
    for (const LineCurvature* one : {&line.now, line.before ? &*line.before : nullptr}) {
      if (one != nullptr && !one->s.empty()) longest = std::max(longest, one->s.back());
    }
  }
  PictureCanvas body;
  body.label({kPictureMargin, 40.0}, "start", "title", title);
  body.label({kPictureMargin, 62.0}, "start", "fact", fact);
  draw_longitudinals_key(body, picture, 88.0);
  PictureFrame frame;
  frame.x = tight_axis(0.0, longest > 0.0 ? longest : 1.0, 8);
  double top = kFirstLongitudinal;
  for (std::size_t i = 0; i < picture.lines.size(); ++i) {
    frame.top = top;
    frame.bottom = top + kLongitudinalHeight;
    draw_longitudinal_plot(body, picture.lines[i], frame, i + 1 == picture.lines.size());
    top += kLongitudinalHeight + kLongitudinalsApart;
  }
  const double foot = top - kLongitudinalsApart;
  body.label({kPictureWidth - kPictureMargin, 88.0}, "end", "axis-title",
             "Curvature, 1/" + (picture.units.empty() ? std::string("unit") : picture.units));
  body.label({0.5 * (frame.left + frame.right), foot + 38.0}, "middle", "axis-title",
             "Arc length, " + power_prefix(frame.x.exponent) + picture.units);
  return picture_sheet(title, fact, body.take(), foot + kLongitudinalsFoot);
}

}  // namespace obvid
