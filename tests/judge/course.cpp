// SPDX-License-Identifier: Apache-2.0
#include "course.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <set>

namespace judge {
namespace {

Path path_of(const ContourFile& contour, Point origin) {
  std::vector<Span> spans;
  for (const Piece& piece : contour.pieces) spans.emplace_back(piece, origin);
  return Path(std::move(spans));
}

Vec seen_from(const BallVec& p, Point origin) {
  return {(p.x - Ball(origin.x)).middle(), (p.y - Ball(origin.y)).middle()};
}

bool is_joint(Real order) { return order == std::floor(order); }

/// Stations in the order of the contour: place, and the points as which parts end and begin there.
/// At a corner that stands on no point these are the points before and behind it.
struct Station {
  std::size_t ends = 0, begins = 0;
  Real order = 0.0L;
};

/// The nearest place behind `from`, up to where a piece leads away (docs/claims.md).
Real place_behind(const Path& path, Vec p, Real from, Real to) {
  constexpr Real kAway = 8.0L;  // times the least distance so far
  Place best;
  best.distance = std::numeric_limits<Real>::max();
  for (Real at = from; at < to; at = std::floor(at) + 1.0L) {
    const Place here = path.nearest(p, at, std::min(to, std::floor(at) + 1.0L));
    if (here.distance < best.distance) {
      best = here;
    } else if (here.distance > kAway * best.distance) {
      break;
    }
  }
  return best.distance < std::numeric_limits<Real>::max() ? best.order() : from;
}

/// The points at which a row of the report ends and the next one begins; nothing: rows name none.
/// Only those are stations: points with tolerances need not have a place of their own that follows
/// those before it. Where a row ends as one point and the next begins as another there is a corner.
std::optional<std::set<std::size_t>> named_by_rows(const ContourFile& contour) {
  std::set<std::size_t> named;
  std::vector<std::array<std::size_t, 2>> rows;
  for (const Json& row : member(contour.report, "segments")) {
    std::vector<std::size_t> both;
    for (const Json& point : member(row, "points")) {
      if (point.is_number() && point.number >= 0.0) {
        both.push_back(static_cast<std::size_t>(point.number));
      }
    }
    if (both.size() == 2) rows.push_back({both[0], both[1]});
  }
  if (rows.empty()) return std::nullopt;
  const auto meet = [&](std::size_t before, std::size_t behind) {
    if (before == behind) named.insert(before);
  };
  for (std::size_t k = 0; k + 1 < rows.size(); ++k) meet(rows[k][1], rows[k + 1][0]);
  if (contour.closed) {
    meet(rows.back()[1], rows.front()[0]);
  } else {
    named.insert(rows.front()[0]);
    named.insert(rows.back()[1]);
  }
  return named;
}

std::vector<Station> stations_of(const ContourFile& contour, const Path& path, Point origin) {
  std::vector<Station> out;
  const std::size_t n = contour.points.size();
  if (n < 2 || contour.pieces.empty()) return out;
  std::vector<std::optional<Real>> known(n), corner(n);  // corner: behind the point
  for (std::size_t j = 0; j < contour.elements.size(); ++j) {
    const auto source = contour.elements[j].source;
    if (source && *source < n && !known[*source]) known[*source] = static_cast<Real>(j);
    const auto between = contour.elements[j].between;
    if (between && between->first < n) corner[between->first] = static_cast<Real>(j);
  }
  std::size_t first = 0;
  bool begins_at_corner = false;
  if (contour.closed) {
    for (std::size_t i = 0; i < n; ++i) {
      if (known[i] == 0.0L) first = i;
      if (corner[i] != 0.0L) continue;
      first = (i + 1) % n;
      begins_at_corner = true;
      corner[i] = path.end();
    }
  }
  const auto named = named_by_rows(contour);
  const auto is_named = [&](std::size_t i) { return !named || named->contains(i); };
  Real before = 0.0L;
  if (begins_at_corner) out.push_back({first, first, 0.0L});
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (first + k) % n;
    if (k > 0 && corner[(i + n - 1) % n]) {
      before = std::max(before, *corner[(i + n - 1) % n]);
      out.push_back({(i + n - 1) % n, i, before});
    }
    if (!is_named(i)) continue;
    Real order = before;
    if (known[i]) {
      order = *known[i];
    } else if (k == 0 && !begins_at_corner) {
      order = 0.0L;
    } else if (k + 1 == n && !contour.closed) {
      order = path.end();
    } else {
      Real to = corner[i].value_or(path.end());
      for (std::size_t m = k + 1; m < n && !corner[(first + m - 1) % n]; ++m) {
        if (corner[(first + m) % n]) to = *corner[(first + m) % n];
        if (known[(first + m) % n]) {
          to = *known[(first + m) % n];
          break;
        }
      }
      order = place_behind(path, seen(contour.points[i], origin), before, to);
    }
    out.push_back({i, i, std::max(order, before)});
    before = out.back().order;
  }
  if (begins_at_corner) {
    const std::size_t last = (first + n - 1) % n;
    out.push_back({last, last, path.end()});
  } else if (contour.closed && is_named(first)) {
    out.push_back({first, first, path.end()});
  }
  return out;
}

}  // namespace

Course::Course(const ContourFile& contour)
    : file(contour),
      origin(contour.points.empty() ? Point{} : contour.points.front()),
      ends(ends_of(contour)),
      joints(joints_of(contour, ends)),
      path(path_of(contour, origin)) {
  for (const Piece& piece : contour.pieces) laws.push_back(curvature_law(piece));
  const std::vector<Station> stations = stations_of(contour, path, origin);
  for (std::size_t k = 0; k + 1 < stations.size(); ++k) {
    Part part{
        stations[k].begins, stations[k + 1].ends, stations[k].order, stations[k + 1].order, {}, {}};
    // over half a turn or more a region is none: there all joints count (docs/claims.md)
    const bool far = turning_both_ways(part.from, part.to) >= std::numbers::pi_v<Real>;
    part.turns = cuts_of(part.from, part.to, false);
    part.cuts = cuts_of(part.from, part.to, far);
    parts.push_back(std::move(part));
  }
  for (const Point p : contour.points) away.push_back(path.nearest(seen(p, origin)).distance);
  stations_known = !parts.empty();
}

Real Course::resolution() const {
  constexpr Real kOfSize = 1e-13L, kUlps = 16.0L * 0x1p-52L;
  return kOfSize * ends.size + kUlps * ends.coordinate;
}

/// Joints inside a part where a new direction begins, corners too. The vertex of arcs is a whole
/// arc: there the runs of the file say which of its ends counts (the runs are judged on their own;
/// one of constant curvature turns nothing).
std::vector<Real> Course::cuts_of(Real from, Real to, bool all_joints) const {
  std::vector<Real> out{from};
  int before = 0, run_before = 0;
  const auto run_direction = [&](std::size_t piece) {
    const auto run = std::find_if(file.runs.begin(), file.runs.end(), [piece](const FileRun& r) {
      return r.first <= piece && piece <= r.last;
    });
    return run == file.runs.end() ? 0 : run->direction;
  };
  for (auto i = static_cast<std::size_t>(from); static_cast<Real>(i) < to; ++i) {
    const bool inner = static_cast<Real>(i) > from;
    bool turns = inner && file.parted_at(i);
    if (turns) before = 0;
    for (const int sign :
         {inner && joints[i].clear_jump ? joints[i].jump : 0, laws[i].direction()}) {
      if (sign == 0) continue;
      turns = turns || (inner && before != 0 && sign != before);
      before = sign;
    }
    if (file.carrier == "arcs") {
      const int run = run_direction(i);
      if (inner && !file.parted_at(i)) turns = run * run_before < 0;
      if (file.parted_at(i)) run_before = 0;
      if (run != 0) run_before = run;
    }
    if (turns || (all_joints && inner)) out.push_back(static_cast<Real>(i));
  }
  out.push_back(to);
  return out;
}

Element Course::element(Real order, bool behind) const {
  Element out;
  const bool arcs = file.carrier == "arcs";
  if (!is_joint(order)) {
    const auto i = static_cast<std::size_t>(order);
    const Jet jet = path.spans()[i].at(order - std::floor(order));
    return {jet.p, std::atan2(jet.d.y, jet.d.x), jet.kappa()};
  }
  const auto joint = static_cast<std::size_t>(order);
  const bool next = behind ? joint < file.pieces.size() : joint == 0;
  const End& end = next ? ends.start[joint] : ends.end[joint - 1];
  out.point = seen_from(end.point, origin);
  out.theta = std::atan2(end.tangent.y.middle(), end.tangent.x.middle());
  out.kappa = end.kappa.middle();
  const FileElement* stored = file.joint(joint);
  if (arcs && stored != nullptr)
    out.kappa = behind && stored->parted() ? stored->kappa_out : stored->kappa;
  return out;
}

std::pair<Real, Real> Course::curvatures_near(Real order, Real length) const {
  constexpr int kPlaces = 16;
  std::pair<Real, Real> range{HUGE_VALL, -HUGE_VALL};
  const auto first = static_cast<std::size_t>(std::min(order, path.end() - 1.0L));
  for (const bool onward : {true, false}) {
    Real left = length, t = order - static_cast<Real>(first);
    for (std::size_t i = first; i < path.spans().size(); onward ? ++i : --i) {
      const Span& span = path.spans()[i];
      const Real side = onward ? 1.0L - t : t, step = std::min(left / norm(span.at(t).d), side);
      for (int k = 0; k <= kPlaces; ++k) {
        const Real kappa = span.at(t + (onward ? step : -step) * k / kPlaces).kappa();
        range = {std::min(range.first, kappa), std::max(range.second, kappa)};
      }
      if (step < side || (!onward && i == 0)) break;
      left -= side * norm(span.at(t).d);
      if (left < 0.0L) break;
      t = onward ? 0.0L : 1.0L;
    }
  }
  return range;
}

Real Course::curvature_rounding(Real order) const {
  constexpr Real kRoundings = 64.0L * 0x1p-53L;  // 4 n (n - 1) / 2 for degree 6, and a little more
  const Real start = std::min(std::floor(order), path.end() - 1.0L);
  const Span& span = path.spans()[static_cast<std::size_t>(start)];
  const Real speed = norm(span.at(order - start).d);
  const Real size = std::max(speed, norm(span.point(1.0L) - span.point(0.0L)));
  return kRoundings * size / (speed * speed);
}

bool Course::monotone(Real a, Real b) const {
  int direction = 0;
  const auto first = static_cast<std::size_t>(a);
  for (std::size_t i = first; static_cast<Real>(i) < b && i < laws.size(); ++i) {
    if (!laws[i].one_way()) return false;
    const bool inner_joint = i > first || static_cast<Real>(i) > a;
    if (inner_joint && file.parted_at(i)) return false;
    for (const int sign :
         {inner_joint && joints[i].clear_jump ? joints[i].jump : 0, laws[i].direction()}) {
      if (sign == 0) continue;
      if (direction != 0 && sign != direction) return false;
      direction = sign;
    }
  }
  return true;
}

Real Course::turning(Real a, Real b) const {
  Real sum = 0.0L;
  for (auto i = static_cast<std::size_t>(a); static_cast<Real>(i) < b && i < laws.size(); ++i) {
    const auto start = static_cast<Real>(i);
    sum += std::abs(path.spans()[i].turning(std::max(a - start, 0.0L), std::min(b - start, 1.0L)));
  }
  return sum;
}

Real Course::turning_both_ways(Real a, Real b) const {
  Real sum = 0.0L;
  for (auto i = static_cast<std::size_t>(a); static_cast<Real>(i) < b && i < laws.size(); ++i) {
    const auto start = static_cast<Real>(i);
    sum += path.spans()[i].turning_both_ways(std::max(a - start, 0.0L), std::min(b - start, 1.0L));
  }
  return sum;
}

}  // namespace judge
