// SPDX-License-Identifier: Apache-2.0
#include "draft.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "build_tube.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/series/analysis.h"

namespace obvid::fairing_detail {
namespace {

template <class Vector>
auto at(Vector& v, std::size_t i) {
  return v.begin() + static_cast<std::ptrdiff_t>(i);
}

State on_adjacent_circles(const Tube& tube, const ExactSeries& series) {
  const std::size_t n = series.points.size();
  const std::vector<Chord> chords = measure_chords(series.points);
  const std::vector<AdjacentCircle> circles = measure_circles(series.points, chords);
  State out(kPerNode * n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const TubeNode& node = tube.nodes[i];
    const double theta =
        i + 1 == n ? chords[i - 1].omega + circles[i].eta_in : chords[i].omega - circles[i].eta_out;
    if (!node.fix_theta) {
      out[kPerNode * i + 1] = turn_between(node.theta, theta);
    }
    if (!node.fix_kappa) out[kPerNode * i + 2] = (circles[i].kappa - node.kappa) * node.length;
  }
  return out;
}

/// Puts a free node into the middle of a link, with a direction for each half.
void insert(Draft& draft, std::size_t link, std::int8_t first, std::int8_t second) {
  constexpr double kQuarter = 0.25;  // half the chord, and the size goes with its square
  Tube& tube = draft.tube;
  const NodeEnd a = place(tube.nodes[link], &draft.x[kPerNode * link]).out;
  const NodeEnd b = place(tube.nodes[link + 1], &draft.x[kPerNode * (link + 1)]).in;
  tube.nodes.insert(at(tube.nodes, link + 1), middle_node(a, b));
  tube.size[link] *= kQuarter;
  tube.size.insert(at(tube.size, link), tube.size[link]);
  tube.first_row.push_back(0);  // exact points are nodes, all of them: no rows anywhere
  draft.x.insert(at(draft.x, kPerNode * (link + 1)), kPerNode, 0.0);
  draft.plain.insert(at(draft.plain, kPerNode * (link + 1)), kPerNode, 0.0);
  draft.source.insert(at(draft.source, link + 1), std::nullopt);
  draft.direction[link] = second;
  draft.direction.insert(at(draft.direction, link), first);
}

}  // namespace

Draft draft_of(const ExactSeries& series, Watch& watch) {
  MeasuredSeries measured;
  measured.points = series.points;
  measured.reach.assign(series.points.size(), 0.0);
  measured.nodes = series.nodes;
  measured.thin = false;
  SmoothTube smooth = build_tube(measured, {}, watch);
  Draft out;
  out.tube = std::move(smooth.tube);
  out.x = std::move(smooth.state);
  out.plain = on_adjacent_circles(out.tube, series);
  out.direction = series.direction;
  out.source.assign(smooth.source.begin(), smooth.source.end());
  return out;
}

Draft part_of(const Draft& draft, Window window) {
  Draft out;
  out.tube.origin = draft.tube.origin;
  out.tube.nodes.assign(at(draft.tube.nodes, window.first), at(draft.tube.nodes, window.last + 1));
  out.tube.size.assign(at(draft.tube.size, window.first), at(draft.tube.size, window.last));
  out.tube.first_row.assign(window.last - window.first + 1, 0);
  out.x.assign(at(draft.x, kPerNode * window.first), at(draft.x, kPerNode * (window.last + 1)));
  out.plain.assign(at(draft.plain, kPerNode * window.first),
                   at(draft.plain, kPerNode * (window.last + 1)));
  out.direction.assign(at(draft.direction, window.first), at(draft.direction, window.last));
  out.source.assign(at(draft.source, window.first), at(draft.source, window.last + 1));
  return out;
}

void splice(Draft& draft, Window window, Draft part) {
  const auto replace = [](auto& all, const auto& by, std::size_t first, std::size_t last) {
    all.erase(at(all, first), at(all, last));
    all.insert(at(all, first), by.begin(), by.end());
  };
  replace(draft.tube.nodes, part.tube.nodes, window.first, window.last + 1);
  replace(draft.tube.size, part.tube.size, window.first, window.last);
  replace(draft.x, part.x, kPerNode * window.first, kPerNode * (window.last + 1));
  replace(draft.plain, part.plain, kPerNode * window.first, kPerNode * (window.last + 1));
  replace(draft.direction, part.direction, window.first, window.last);
  replace(draft.source, part.source, window.first, window.last + 1);
  draft.tube.first_row.assign(draft.links() + 1, 0);
}

std::vector<Draft> changed(const Draft& draft, Change change, std::size_t link) {
  const std::int8_t one = draft.direction[link], other = static_cast<std::int8_t>(-one);
  if (change == Change::kTurn) {
    Draft out = draft;
    out.direction[link] = other;
    return {std::move(out)};
  }
  Draft falls = draft;
  insert(falls, link, one, other);
  if (change == Change::kSplitTwice) {
    Draft early = draft;
    insert(early, link, one, one);
    Draft late = early;
    insert(early, link, one, other);     // one, other | one
    insert(late, link + 1, other, one);  // one | other, one
    return {std::move(early), std::move(late)};
  }
  Draft rises = draft;
  insert(rises, link, other, one);
  return {std::move(falls), std::move(rises)};
}

int vertices_of(const std::vector<std::int8_t>& direction) {
  int n = 0;
  for (std::size_t i = 1; i < direction.size(); ++i) n += direction[i - 1] != direction[i] ? 1 : 0;
  return n;
}

}  // namespace obvid::fairing_detail
