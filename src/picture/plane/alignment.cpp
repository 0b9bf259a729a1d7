// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "obvid/picture/internal/alignment_svg.h"
#include "plane/axis.h"
#include "plane/frame.h"
#include "plane/panels.h"
#include "plane/plots.h"
#include "plane/sheet.h"

namespace obvid {
namespace {

constexpr double kDiagramHeight = 150.0;
constexpr double kDiagramTitleRoom = 30.0;
constexpr double kDiagramsApart = 10.0;
/// Room for stations that stand upright above a plot, px.
constexpr double kStationRoom = 58.0;
/// Titles stand that much above them, px.
constexpr double kTitleLift = 10.0;
/// Upright texts stand at least this far apart, px.
constexpr double kStationApart = 13.0;
/// Width of a character of small texts, px.
constexpr double kCharacter = 7.0;
/// Of the fastest bend, and of that which half of the length of bends allows: speeds beyond are not
/// shown.
constexpr double kFastest = 1.3, kBeyondHalf = 3.0;
/// Places of a vertical curve that are drawn.
constexpr int kCurvePlaces = 32;
/// Heights of more points than this would hide the profile.
constexpr std::size_t kMostHeights = 2000;

std::string path_through(const std::vector<Vec2>& places) {
  PicturePath graph;
  for (const Vec2 at : places) graph.empty() ? graph.move(at) : graph.line(at);
  return graph.text();
}

void begin_clip(PictureCanvas& canvas, const PictureFrame& frame, int id) {
  canvas.add(
      "<clipPath id=\"diagram{0}\"><rect x=\"{1}\" y=\"{2}\" width=\"{3}\" height=\"{4}\"/>"
      "</clipPath>\n<g clip-path=\"url(#diagram{0})\">\n",
      id, px(frame.left), px(frame.top - 1.0), px(frame.right - frame.left + 1.0),
      px(frame.bottom - frame.top + 2.0));
}

std::vector<double> boundaries_of(const AlignmentDiagram& diagram) {
  std::vector<double> out;
  for (const auto& part : diagram.parts) out.push_back(part.station);
  out.push_back(diagram.parts.back().station + diagram.parts.back().length);
  return out;
}

/// Lines where elements begin, and above them the stations, as many as have room.
void draw_boundaries(PictureCanvas& canvas, const PictureFrame& frame,
                     const std::vector<double>& stations, bool named) {
  PicturePath lines;
  double last = -HUGE_VAL;
  for (const double station : stations) {
    const double x = frame.px_x(station);
    lines.move({x, frame.top});
    lines.line({x, frame.bottom});
    if (!named || x - last < kStationApart) continue;
    canvas.add("<text class=\"small\" transform=\"translate({},{}) rotate(-90)\">{}</text>\n",
               px(x + 4.0), px(frame.top - 5.0), fmt::format("{:.2f}", station));
    last = x;
  }
  if (!lines.empty()) canvas.add("<path class=\"break\" d=\"{}\"/>\n", lines.text());
}

void draw_zero(PictureCanvas& canvas, const PictureFrame& frame) {
  const double zero = frame.px_y(0.0);
  if (zero > frame.bottom - 1.0 || zero < frame.top) return;
  canvas.line({frame.left, zero}, {frame.right, zero}, "axis");
}

/// Least and greatest height of a graph between two places, px.
std::array<double, 2> heights_between(const std::vector<Vec2>& graph, double from, double to) {
  std::array<double, 2> out{HUGE_VAL, -HUGE_VAL};
  for (std::size_t k = 0; k + 1 < graph.size(); ++k) {
    const Vec2 a = graph[k], b = graph[k + 1];
    if (b.x < from || a.x > to) continue;
    for (const double x : {std::max(a.x, from), std::min(b.x, to)}) {
      const double part = b.x > a.x ? (x - a.x) / (b.x - a.x) : 0.0;
      const double y = a.y + part * (b.y - a.y);
      out = {std::min(out[0], y), std::max(out[1], y)};
    }
    if (!(b.x > a.x)) out = {std::min(out[0], b.y), std::max(out[1], b.y)};
  }
  return out;
}

/// Base line of a text of that width about a place along a plot, px: at its bottom, or at its top
/// where the graph leaves more room there.
double label_base(const PictureFrame& frame, const std::vector<Vec2>& graph, double x,
                  double width) {
  constexpr double kLetters = 10.0;  // height, px
  constexpr double kFree = 4.0;      // of them to the graph, px
  const double low = frame.bottom - 6.0, high = frame.top + kLetters + 4.0;
  const auto [least, most] = heights_between(graph, x - 0.5 * width, x + 0.5 * width);
  const double below = low - kLetters - most, above = least - high;
  return below >= kFree || below >= above ? low : high;
}

/// Names of elements that are wide enough for them.
void draw_labels(PictureCanvas& canvas, const PictureFrame& frame, const AlignmentDiagram& diagram,
                 const std::vector<Vec2>& graph) {
  for (const auto& part : diagram.parts) {
    const double width = frame.px_x(part.station + part.length) - frame.px_x(part.station);
    const double room = kCharacter * static_cast<double>(part.label.size());
    if (part.label.empty() || width < room) continue;
    const double x = frame.px_x(part.station + 0.5 * part.length);
    canvas.label({x, label_base(frame, graph, x, room)}, "middle", "note", part.label);
  }
}

void curvature_panel(PictureCanvas& canvas, PictureFrame frame, const AlignmentDiagram& diagram,
                     double size, const std::string& units) {
  PictureRange range;
  for (const auto& part : diagram.parts) {
    for (const double kappa : part.curvatures) {
      range.low = std::min(range.low, kappa);
      range.high = std::max(range.high, kappa);
    }
  }
  frame.y = curvature_axis(range, size);
  canvas.label({kPictureMargin, frame.top - kStationRoom - kTitleLift}, "start", "axis-title",
               curvature_title(frame.y, PictureScale{range, false, 0.0}, units) +
                   ", stations of the elements");
  draw_grid(canvas, frame, false);
  draw_boundaries(canvas, frame, boundaries_of(diagram), true);
  draw_zero(canvas, frame);
  std::vector<Vec2> places;
  for (const auto& part : diagram.parts) {
    const auto steps = static_cast<double>(part.curvatures.size() - 1);
    for (std::size_t k = 0; k < part.curvatures.size(); ++k) {
      const double station = part.station + part.length * static_cast<double>(k) / steps;
      places.push_back({frame.px_x(station), frame.px_y(part.curvatures[k])});
    }
  }
  canvas.add("<path class=\"graph up\" d=\"{}\"/>\n", path_through(places));
  draw_labels(canvas, frame, diagram, places);
}

/// Speed up to which bends are told apart, km/h: that at the sharpest place of the fastest one, but
/// not where arcs that are nearly straight would press the others together. 0: all are straight.
double speeds_up_to(const AlignmentDiagram& diagram) {
  std::vector<std::pair<double, double>> bends;  // speed, length
  double length = 0.0;
  for (const auto& part : diagram.parts) {
    double kappa = 0.0;
    for (const double one : part.curvatures) kappa = std::max(kappa, std::abs(one));
    if (!(kappa > 0.0)) continue;
    bends.emplace_back(*diagram.speed_scale / std::sqrt(kappa), part.length);
    length += part.length;
  }
  if (bends.empty()) return 0.0;
  std::sort(bends.begin(), bends.end());
  double below = 0.0;
  const auto half = std::find_if(bends.begin(), bends.end(), [&](const auto& bend) {
    return (below += bend.second) >= 0.5 * length;
  });
  return std::min(kFastest * bends.back().first, kBeyondHalf * half->first);
}

void speed_panel(PictureCanvas& canvas, PictureFrame frame, const AlignmentDiagram& diagram,
                 double most_shown) {
  frame.y = round_axis(0.0, most_shown, 4);
  canvas.label({kPictureMargin, frame.top - 11.0}, "start", "axis-title",
               "Speed by the acceleration to the side, " + power_prefix(frame.y.exponent) +
                   "km/h (straight: not limited)");
  draw_grid(canvas, frame, false);
  draw_boundaries(canvas, frame, boundaries_of(diagram), false);
  begin_clip(canvas, frame, 1);
  const double most = 4.0 * frame.y.high;  // beyond the frame
  PicturePath graph;
  for (const auto& part : diagram.parts) {
    // enough places for the root of what is linear
    const std::size_t last = part.curvatures.size() - 1;
    constexpr std::size_t kBetween = 16;
    for (std::size_t k = 0; k <= last * kBetween; ++k) {
      const std::size_t a = std::min(k / kBetween, last - 1);
      const double t = static_cast<double>(k - a * kBetween) / kBetween;
      const double kappa = std::abs((1.0 - t) * part.curvatures[a] + t * part.curvatures[a + 1]);
      const double speed = kappa > 0.0 ? *diagram.speed_scale / std::sqrt(kappa) : most;
      const double station = part.station + part.length * static_cast<double>(k) /
                                                static_cast<double>(last * kBetween);
      const Vec2 at{frame.px_x(station), frame.px_y(std::min(speed, most))};
      graph.empty() ? graph.move(at) : graph.line(at);
    }
  }
  canvas.add("<path class=\"graph down\" d=\"{}\"/>\n</g>\n", graph.text());
}

std::string grade_label(const ProfileElement& e) {
  if (e.kind == ProfileKind::kGrade) return fmt::format("{:+.2f} %", 100.0 * e.grade0);
  return "R " + readable_number(std::abs(e.radius), 4);
}

void profile_panel(PictureCanvas& canvas, PictureFrame frame, const AlignmentDiagram& diagram,
                   const std::string& units) {
  const VerticalProfile& profile = *diagram.profile;
  std::vector<Vec2> places;
  for (const ProfileElement& e : profile.elements) {
    const int steps = e.kind == ProfileKind::kGrade ? 1 : kCurvePlaces;
    for (int k = places.empty() ? 0 : 1; k <= steps; ++k) {
      const double station = e.station + e.length * k / steps;
      places.push_back({station, profile_at(profile, station).height});
    }
  }
  double low = places.front().y, high = low;
  for (const std::vector<Vec2>* all :
       std::array<const std::vector<Vec2>*, 2>{&places, &diagram.heights}) {
    for (const Vec2 p : *all) {
      low = std::min(low, p.y);
      high = std::max(high, p.y);
    }
  }
  constexpr double kLeastHeights = 1e-3;  // of the stations: level ground is seen to be level
  const double least = kLeastHeights * (profile.end_station - places.front().x);
  if (high - low < least) {
    low -= 0.5 * least;
    high += 0.5 * least;
  }
  frame.y = round_axis(low, high, 4);
  canvas.label({kPictureMargin, frame.top - kStationRoom - kTitleLift}, "start", "axis-title",
               "Height, " + power_prefix(frame.y.exponent) + units +
                   ", stations of grades and vertical curves");
  draw_grid(canvas, frame, false);
  std::vector<double> stations;
  for (const ProfileElement& e : profile.elements) stations.push_back(e.station);
  stations.push_back(profile.end_station);
  draw_boundaries(canvas, frame, stations, true);
  begin_clip(canvas, frame, 2);
  for (Vec2& p : places) p = {frame.px_x(p.x), frame.px_y(p.y)};
  canvas.add("<path class=\"graph even\" d=\"{}\"/>\n", path_through(places));
  if (diagram.heights.size() <= kMostHeights) {
    PicturePath dots;
    for (const Vec2 p : diagram.heights) {
      const Vec2 at{frame.px_x(p.x), frame.px_y(p.y)};
      dots.move(at);
      dots.line(at);
    }
    canvas.add("<path class=\"dot\" stroke-width=\"2.4\" d=\"{}\"/>\n", dots.text());
  }
  canvas.add("</g>\n");
  for (const ProfileElement& e : profile.elements) {
    const std::string label = grade_label(e);
    const double width = frame.px_x(e.station + e.length) - frame.px_x(e.station);
    const double room = kCharacter * static_cast<double>(label.size());
    if (width < room) continue;
    const double x = frame.px_x(e.station + 0.5 * e.length);
    canvas.label({x, label_base(frame, places, x, room)}, "middle", "note", label);
  }
}

}  // namespace

std::string alignment_svg(const StoredContour& stored, const PictureTitles& titles,
                          const AlignmentDiagram& diagram) {
  PictureTrack track = make_track(stored.contour);
  track.even_teeth = true;  // else arcs have few beside clothoids
  const std::string units = stored.contour.units.text();
  PictureCanvas body;
  body.label({kPictureMargin, 40.0}, "start", "title", titles.name);
  body.verdict({kPictureMargin, 64.0}, "open", titles.verdict,
               kPictureWidth - 2.0 * kPictureMargin);
  const std::array<const PictureTrack*, 1> alone{&track};
  const PictureScale scale = curvature_scale(alone, {});
  const double below = shape_panel(body, track, stored, scale, nullptr, false, 78.0);
  const std::vector<double> stations = boundaries_of(diagram);
  PictureFrame frame;
  frame.x = tight_axis(stations.front(), stations.back(), 8);
  frame.top = below + kDiagramTitleRoom + kStationRoom;
  frame.bottom = frame.top + kDiagramHeight;
  curvature_panel(body, frame, diagram, track.box.diagonal(), units);
  if (const double most = diagram.speed_scale ? speeds_up_to(diagram) : 0.0; most > 0.0) {
    frame.top = frame.bottom + kDiagramTitleRoom + kDiagramsApart;
    frame.bottom = frame.top + kDiagramHeight;
    speed_panel(body, frame, diagram, most);
  }
  if (diagram.profile) {
    frame.top = frame.bottom + kDiagramTitleRoom + kStationRoom;
    frame.bottom = frame.top + kDiagramHeight;
    profile_panel(body, frame, diagram, units);
  }
  for (const PictureTick& tick : frame.x.ticks) {
    body.label({frame.px_x(tick.value), frame.bottom + 18.0}, "middle", "small", tick.label);
  }
  body.label({0.5 * (frame.left + frame.right), frame.bottom + 38.0}, "middle", "axis-title",
             "Station, " + power_prefix(frame.x.exponent) + units);
  return picture_sheet(titles.name, titles.verdict, body.take(), frame.bottom + 56.0);
}

}  // namespace obvid
