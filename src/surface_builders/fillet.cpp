// SPDX-License-Identifier: Apache-2.0
// Blends of a rolling ball: its ways between two faces, skinned from exact arcs.
#include "obvid/surface_builders/internal/fillet.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "obvid/curve/internal/basis.h"
#include "obvid/geom/internal/chord.h"
#include "obvid/geom/internal/directions.h"
#include "obvid/numeric/internal/golden.h"
#include "obvid/surface_builders/internal/check.h"
#include "obvid/surface_builders/internal/deviation.h"
#include "rolling_ball.h"

namespace obvid {
namespace {

constexpr std::size_t kWayRaster = 48;  // cells in each direction where ways are looked for
constexpr double kSameBallWay = 0.2;    // of the radius: a place nearer to a way lies on it
constexpr double kMostArcPiece = 2.0;   // rad in one rational piece across
constexpr double kWidestArc = 3.1;      // rad across: near a half circle the faces are parallel
constexpr double kCoarseTurn = 0.5;     // rad: turn between the first sections
constexpr std::size_t kFewestAround = 16;
constexpr std::size_t kMostBlendSections = 2'000;
constexpr std::size_t kWrappedSections = 12;  // sections beyond the seam of a closed blend: what a
                                              // C2 cubic makes of its end there is 0.27^12 of it,
                                              // 1e-7 of a part of the tolerance
constexpr double kBlendShare = 0.5;           // of the tolerance
constexpr double kSameBlendEnd = 1e-9;  // of the size: ends of contacts nearer than this are one
constexpr double kTangentFaces = 1e-6;  // sine: faces that bend less to each other are tangent

/// The arc of a ball's characteristic circle between its two contacts.
struct BallArc {
  Vec3 middle;  ///< of the circle
  double radius = 0.0, angle = 0.0;
  std::vector<Vec3> points;
  std::vector<double> weights;

  /// The point at a share of the angle in the middle of whose pieces shares are those of u.
  [[nodiscard]] Vec3 at(double u) const {
    const std::size_t pieces = points.size() / 2;
    const double all = u * static_cast<double>(pieces);
    const std::size_t k = std::min(static_cast<std::size_t>(all), pieces - 1);
    const double t = all - static_cast<double>(k), q = 1.0 - t;
    const double a = q * q, b = 2.0 * q * t * weights[2 * k + 1], c = t * t;
    return (a * points[2 * k] + b * points[2 * k + 1] + c * points[2 * k + 2]) / (a + b + c);
  }
};

double angle_across(const BallPlace& place) {
  return angle_between(place.touch[0].inwards, place.touch[1].inwards);
}

BallArc ball_arc_of(const BallPlace& place, double slope, std::size_t pieces) {
  BallArc arc;
  arc.middle = place.centre - (place.radius * slope) * place.along;
  arc.radius = place.radius * std::sqrt(1.0 - slope * slope);
  const Vec3 a = place.touch[0].point - arc.middle, b = place.touch[1].point - arc.middle;
  arc.angle = angle_between(a, b);
  std::vector<Vec3> ends{place.touch[0].point, place.touch[1].point};
  if (pieces == 2) {
    ends.insert(ends.begin() + 1, arc.middle + arc.radius * unit(a + b));
  }
  const double weight = std::cos(arc.angle / static_cast<double>(2 * pieces));
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    arc.points.push_back(ends[k]);
    arc.weights.push_back(1.0);
    const Vec3 half = ends[k] + ends[k + 1] - 2.0 * arc.middle;
    arc.points.push_back(arc.middle + (arc.radius / weight) * unit(half));
    arc.weights.push_back(weight);
  }
  arc.points.push_back(ends.back());
  arc.weights.push_back(1.0);
  return arc;
}

/// Makes the blend along one way.
class BlendMaker {
 public:
  BlendMaker(const RollingBall& ball, const BallWay& way, const FilletOptions& options,
             const RunContext& run)
      : ball_(ball), way_(way), options_(options), run_(run) {
    all_ = {way.places.front().s, way.places.back().s};
  }

  Result<Fillet> made() {
    OBVID_TRY(choose_pieces());
    OBVID_TRY(refine());
    OBVID_TRY(does_not_fold());
    Fillet out;
    out.surface = surface_;
    out.closed = way_.closed;
    out.length = all_.length();
    out.deviation = deviation_;
    out.from = way_.places.front().centre;
    out.to = way_.places.back().centre;
    out.radius_from = way_.places.front().radius;
    out.radius_to = way_.places.back().radius;
    std::array<Range, 2> on = way_.on;
    const double same = kSameBlendEnd * ball_.size();
    if (std::abs(on[0].from - on[1].from) <= same) on[0].from = on[1].from = all_.from;
    if (std::abs(on[0].to - on[1].to) <= same) on[0].to = on[1].to = all_.to;
    for (std::size_t i = 0; i < 2; ++i) {
      out.contacts[i].along = {share_of(on[i].from), share_of(on[i].to)};
      OBVID_TRY(add_places(i, on[i], out.contacts[i]));
      OBVID_TRY(measure(i, out));
    }
    const Range a = out.contacts[0].along, b = out.contacts[1].along;
    if (a.from != b.from || a.to != b.to) {
      const std::array<Vec2, 4> corner{Vec2{0.0, a.from}, Vec2{1.0, b.from}, Vec2{1.0, b.to},
                                       Vec2{0.0, a.to}};
      TrimLoop loop;
      for (std::size_t k = 0; k < 4; ++k) {
        loop.curves.push_back(parameter_line(corner[k], corner[(k + 1) % 4]));
      }
      out.trims.push_back(std::move(loop));
    }
    return out;
  }

 private:
  [[nodiscard]] double share_of(double s) const {
    return s >= all_.to ? 1.0 : s <= all_.from ? 0.0 : (s - all_.from) / all_.length();
  }
  [[nodiscard]] Error lost(double s) const {
    return error(ErrorCode::kSurfaceFolds, "the ball cannot be followed between the faces")
        .where(fmt::format("{:.4g} along the spine", s - all_.from))
        .hint("take another radius");
  }

  Result<void> choose_pieces() {
    double widest = 0.0;
    for (const BallPlace& place : way_.places) widest = std::max(widest, angle_across(place));
    if (widest > kWidestArc) {
      return error(ErrorCode::kUnsupported, "the blend is a half circle: the faces are parallel")
          .where(near_text(way_.places.front().centre))
          .value(widest);
    }
    pieces_ = widest > kMostArcPiece ? 2 : 1;
    return {};
  }

  const BallArc* arc_at(double s) {
    const auto known = arcs_.find(s);
    if (known != arcs_.end()) return &known->second;
    const auto place = place_at(ball_, way_, s);
    if (!place) return nullptr;
    return &arcs_.emplace(s, ball_arc_of(*place, ball_.slope(), pieces_)).first->second;
  }

  [[nodiscard]] std::vector<double> first_sections() const {
    std::vector<double> out{all_.from};
    if (way_.closed) {
      for (std::size_t k = 1; k < kFewestAround; ++k) {
        out.push_back(all_.at(static_cast<double>(k) / kFewestAround));
      }
    } else {
      const BallPlace* before = &way_.places.front();
      for (const BallPlace& place : way_.places) {
        double turn = 0.0;
        for (std::size_t i = 0; i < 2; ++i) {
          turn = std::max(turn, norm(place.touch[i].inwards - before->touch[i].inwards));
        }
        if (std::max(turn, norm(place.along - before->along)) < kCoarseTurn) continue;
        out.push_back(place.s);
        before = &place;
      }
      if (out.size() > 1 && all_.to - out.back() <= kSameBlendEnd * all_.length()) out.pop_back();
    }
    out.push_back(all_.to);
    return out;
  }

  Result<void> refine() {
    std::vector<double> nodes = first_sections();
    for (;;) {
      OBVID_TRY(skin(nodes));
      std::vector<double> more;
      deviation_ = 0.0;
      for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        OBVID_TRY(may_go_on(run_));
        const Range span{nodes[i], nodes[i + 1]};
        double worst = 0.0;
        for (const double part : {0.25, 0.5, 0.75}) {
          const double s = span.at(part);
          const BallArc* arc = arc_at(s);
          if (arc == nullptr) return fail(lost(s));
          for (const double u : kAcross) {
            worst = std::max(worst, norm(evaluate(surface_, u, share_of(s)).point - arc->at(u)));
          }
        }
        deviation_ = std::max(deviation_, worst);
        if (worst > kBlendShare * options_.tolerance) more.push_back(span.at(0.5));
      }
      if (more.empty()) return {};
      if (nodes.size() + more.size() > kMostBlendSections) {
        return error(ErrorCode::kToleranceNotReached,
                     "the blend needs more than 2,000 sections to come within the tolerance")
            .hint("allow more")
            .value(deviation_);
      }
      const auto middle = static_cast<std::ptrdiff_t>(nodes.size());
      nodes.insert(nodes.end(), more.begin(), more.end());
      std::inplace_merge(nodes.begin(), nodes.begin() + middle, nodes.end());
    }
  }

  /// C2 through the sections in homogeneous coordinates.
  Result<void> skin(const std::vector<double>& nodes) {
    std::vector<double> at;
    std::vector<const BallArc*> arcs;
    for (const double s : nodes) {
      const BallArc* arc = arc_at(s);
      if (arc == nullptr) return fail(lost(s));
      at.push_back(share_of(s));
      arcs.push_back(arc);
    }
    if (way_.closed) wrap(at, arcs);
    const Vec3 origin = arcs.front()->middle;  // far from 0 weighted points would round
    const std::size_t across = arcs.front()->points.size();
    std::vector<SpaceCurve> places, weights;
    for (std::size_t row = 0; row < across; ++row) {
      std::vector<Vec3> p, w;
      for (const BallArc* arc : arcs) {
        const double weight = arc->weights[row];
        p.push_back(weight * (arc->points[row] - origin));
        w.push_back({weight, 0.0, 0.0});
      }
      auto place = interpolated(p, at);
      OBVID_TRY(place);
      auto weight = interpolated(w, at);
      OBVID_TRY(weight);
      places.push_back(std::move(*place));
      weights.push_back(std::move(*weight));
    }
    NurbsSurface s;
    s.degree_u = 2;
    s.degree_v = places.front().degree;
    s.knots_u = {0, 0, 0, 1, 1, 1};
    if (pieces_ == 2) s.knots_u.insert(s.knots_u.begin() + 3, 2, 0.5);
    s.knots_v = places.front().knots;
    for (std::size_t j = 0; j < places.front().points.size(); ++j) {
      for (std::size_t row = 0; row < across; ++row) {
        // the borders have weight 1
        const double weight = row % 2 == 0 ? 1.0 : weights[row].points[j].x;
        s.weights.push_back(weight);
        s.points.push_back(origin + places[row].points[j] / weight);
      }
    }
    if (way_.closed) {
      s = split_v(split_v(s, 0.0)[1], 1.0)[0];
      s.knots_v.front() = 0.0;
      const std::size_t last = (s.count_v() - 1) * across;
      std::copy_n(s.points.begin(), across, s.points.begin() + static_cast<std::ptrdiff_t>(last));
      std::copy_n(s.weights.begin(), across, s.weights.begin() + static_cast<std::ptrdiff_t>(last));
    }
    surface_ = std::move(s);
    return check(surface_);
  }

  static void wrap(std::vector<double>& at, std::vector<const BallArc*>& arcs) {
    const std::size_t n = at.size();  // the last is the first
    std::vector<double> all_at;
    std::vector<const BallArc*> all;
    for (std::size_t k = n - 1 - kWrappedSections; k + 1 < n; ++k) {
      all_at.push_back(at[k] - 1.0);
      all.push_back(arcs[k]);
    }
    all_at.insert(all_at.end(), at.begin(), at.end());
    all.insert(all.end(), arcs.begin(), arcs.end());
    all[kWrappedSections + n - 1] = arcs.front();
    for (std::size_t k = 1; k <= kWrappedSections; ++k) {
      all_at.push_back(at[k] + 1.0);
      all.push_back(arcs[k]);
    }
    at = std::move(all_at);
    arcs = std::move(all);
  }

  Result<void> does_not_fold() {
    double sign = 0.0;
    for (const auto& [s, arc] : arcs_) {
      for (const double u : kAcross) {
        const SurfaceJet jet = evaluate(surface_, u, share_of(s));
        const double turn = dot(cross(jet.du, jet.dv), jet.point - arc.middle);
        if (sign == 0.0) sign = turn;
        if (turn * sign > 0.0) continue;
        return error(ErrorCode::kSurfaceFolds, "the blend folds back on itself")
            .where(near_text(jet.point))
            .hint("the edge bends more than the ball there; take a smaller radius")
            .value(arc.radius);
      }
    }
    return {};
  }

  Result<void> add_places(std::size_t i, const Range& on, FilletContact& out) const {
    const auto add = [&](double s) -> Result<void> {
      const auto place = place_at(ball_, way_, s);
      if (!place) return fail(lost(s));
      out.places.push_back(place->touch[i].at);
      return {};
    };
    OBVID_TRY(add(on.from));
    const double same = kSameBlendEnd * ball_.size();
    for (const BallPlace& place : way_.places) {
      if (place.s > on.from + same && place.s < on.to - same)
        out.places.push_back(place.touch[i].at);
    }
    if (way_.closed) {
      out.places.push_back(way_.places.back().touch[i].at);
      return {};
    }
    return add(on.to);
  }

  /// Border against face: at places in every span, and climbed to beside the greatest.
  Result<void> measure(std::size_t i, Fillet& fillet) const {
    constexpr std::size_t kPlaces = 4;
    FilletContact& out = fillet.contacts[i];
    SurfaceModel face;
    face.patches.push_back({"", ball_.face(i).patch().surface});
    const NearestOnModel nearest(face);
    const double u = i == 0 ? 0.0 : 1.0;
    struct MeasuredAlong {
      double distance = 0.0, angle = 0.0;
      Vec3 point;
    };
    const auto at = [&](double v) {
      const SurfaceJet jet = evaluate(surface_, u, v);
      const NearestPlace foot = nearest.at(jet.point);
      const SurfaceJet there = evaluate(face.patches[0].surface, foot.u, foot.v);
      const Vec3 a = cross(jet.du, jet.dv), b = cross(there.du, there.dv);
      return MeasuredAlong{foot.distance, angle_between_lines(a, b), jet.point};
    };
    std::vector<double> places{out.along.from};
    const std::vector<double> knots = distinct(surface_.knots_v);
    for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
      for (std::size_t n = 0; n < kPlaces; ++n) {
        const double v = Range{knots[k], knots[k + 1]}.at(static_cast<double>(n) / kPlaces);
        if (v > places.back() && v < out.along.to) places.push_back(v);
      }
    }
    places.push_back(out.along.to);
    std::vector<MeasuredAlong> found;
    for (const double v : places) {
      OBVID_TRY(may_go_on(run_));
      found.push_back(at(v));
    }
    out.measured = places.size();
    const auto climb = [&](double MeasuredAlong::*figure, double& value, Vec3& where) {
      const auto best = std::max_element(
          found.begin(), found.end(),
          [&](const MeasuredAlong& a, const MeasuredAlong& b) { return a.*figure < b.*figure; });
      const auto k = static_cast<std::size_t>(best - found.begin());
      const double low = places[k > 0 ? k - 1 : k],
                   high = places[std::min(k + 1, places.size() - 1)];
      const MeasuredAlong top =
          at(highest_place(low, high, [&](double v) { return at(v).*figure; }));
      const MeasuredAlong& most = top.*figure > (*best).*figure ? top : *best;
      value = most.*figure;
      where = most.point;
    };
    climb(&MeasuredAlong::distance, out.distance, out.distance_at);
    climb(&MeasuredAlong::angle, out.angle, out.angle_at);
    return {};
  }

  static constexpr std::array<double, 5> kAcross{0.0, 0.25, 0.5, 0.75, 1.0};
  const RollingBall& ball_;
  const BallWay& way_;
  const FilletOptions& options_;
  const RunContext& run_;
  Range all_;
  std::size_t pieces_ = 1;
  std::map<double, BallArc> arcs_;
  NurbsSurface surface_;
  double deviation_ = 0.0;
};

/// Into a patch from a side, in its tangent plane and across the side; and its normal.
struct FaceAtBorder {
  Vec3 into, normal;
};
FaceAtBorder at_border(const NurbsSurface& s, PatchSide side, double part) {
  const Range u = domain_u(s), v = domain_v(s);
  const bool far = is_far_end(side);
  const SurfaceJet jet = runs_along_u(side) ? evaluate(s, u.at(part), far ? v.to : v.from)
                                            : evaluate(s, far ? u.to : u.from, v.at(part));
  const Vec3 along = unit(runs_along_u(side) ? jet.du : jet.dv);
  const Vec3 across = (far ? -1.0 : 1.0) * (runs_along_u(side) ? jet.dv : jet.du);
  return {unit(across - dot(across, along) * along), unit(cross(jet.du, jet.dv))};
}

/// Sides on which the faces bend to each other along a border that they share.
Result<std::array<double, 2>> ball_sides_of(const std::array<const SurfacePatch*, 2>& faces,
                                            const FilletOptions& options, double size) {
  std::array<double, 2> out{};
  for (std::size_t i = 0; i < 2; ++i) {
    if (options.sides[i] != BallSide::kAutomatic) {
      out[i] = options.sides[i] == BallSide::kFront ? 1.0 : -1.0;
    }
  }
  if (out[0] != 0.0 && out[1] != 0.0) return out;
  const auto to_be_told = [](const char* what) {
    return error(ErrorCode::kBadOption, what)
        .where("--sides")
        .hint(
            "say on which sides the ball is: --sides front,back and so on; front is where du x "
            "dv points to");
  };
  const Topology topology = topology_of({&faces[0]->surface, &faces[1]->surface}, kMeeting * size);
  for (const TopologyEdge& edge : topology.edges) {
    const auto use = [&](std::size_t patch) {
      return std::find_if(edge.uses.begin(), edge.uses.end(),
                          [&](const EdgeUse& one) { return one.patch == patch; });
    };
    const auto a = use(0), b = use(1);
    if (edge.point || a == edge.uses.end() || b == edge.uses.end()) continue;
    constexpr double kPart = 0.5;  // the middle; sides with other parameters have others there
    const FaceAtBorder first = at_border(faces[0]->surface, a->side, kPart);
    double part = kPart;
    if (b->other_parameters || a->other_parameters) {
      const SpaceCurve one = border_of(faces[0]->surface, a->side),
                       two = border_of(faces[1]->surface, b->side);
      const Range range = domain(two);
      part = (nearest_parameter(two, evaluate(one, domain(one).at(kPart)).point) - range.from) /
             range.length();
    }
    const FaceAtBorder second = at_border(faces[1]->surface, b->side, part);
    const double up = dot(second.into, first.normal), over = dot(first.into, second.normal);
    if (std::abs(up) < kTangentFaces || std::abs(over) < kTangentFaces) {
      return to_be_told("the faces are tangent to each other along their border");
    }
    if (out[0] == 0.0) out[0] = up > 0.0 ? 1.0 : -1.0;
    if (out[1] == 0.0) out[1] = over > 0.0 ? 1.0 : -1.0;
    return out;
  }
  return to_be_told("the faces share no border from corner to corner");
}

/// Places where the ball touches both faces, one for each crossing of a line of a raster on either.
class WaySearch {
 public:
  WaySearch(const RollingBall& ball, const RunContext& run) : ball_(ball), run_(run) {}

  template <class Take>
  Result<void> each(const Take& take) {
    for (const std::size_t own : {std::size_t{0}, std::size_t{1}}) {
      OBVID_TRY(each_from(own, take));
    }
    return {};
  }

 private:
  /// A place of one face, its centre's foot on the other one, and how far outside the ball that is.
  struct Node {
    Vec2 at, other;
    double off = std::nan("");
  };

  template <class Take>
  Result<void> each_from(std::size_t own, const Take& take) {
    const BallFace& face = ball_.face(own);
    const NurbsSurface& s = face.patch().surface;
    SurfaceModel other;
    other.patches.push_back({"", ball_.face(1 - own).patch().surface});
    const NearestOnModel nearest(other);
    const auto node = [&](Vec2 at) {
      Node out{at, {}, std::nan("")};
      const Vec3 centre = centre_at(own, at);
      if (!is_finite(centre) || !face.inside(at)) return out;
      const NearestPlace foot = nearest.at(centre);
      out.other = {foot.u, foot.v};
      out.off = ball_.face(1 - own).side() * foot.off - ball_.radius_at(0.0);
      return out;
    };
    const Range u = domain_u(s), v = domain_v(s);
    std::vector<Node> before, here;
    for (std::size_t j = 0; j <= kWayRaster; ++j) {
      OBVID_TRY(may_go_on(run_));
      here.clear();
      for (std::size_t i = 0; i <= kWayRaster; ++i) {
        here.push_back(node({u.at(static_cast<double>(i) / kWayRaster),
                             v.at(static_cast<double>(j) / kWayRaster)}));
        for (const Node* to : {i > 0 ? &here[i - 1] : nullptr, j > 0 ? &before[i] : nullptr}) {
          const Node& from = here[i];
          if (to == nullptr || !((from.off < 0.0) != (to->off < 0.0))) continue;
          if (std::isnan(from.off) || std::isnan(to->off)) continue;
          const double part = from.off / (from.off - to->off);
          const Vec2 at = from.at + part * (to->at - from.at);
          OBVID_TRY(found(own, at, part < 0.5 ? from.other : to->other, take));
        }
      }
      std::swap(before, here);
    }
    return {};
  }

  [[nodiscard]] Vec3 centre_at(std::size_t own, Vec2 at) const {
    const BallFace& face = ball_.face(own);
    const SurfaceJet jet = face.jet(at);
    return jet.point + (ball_.radius_at(0.0) * face.side()) * unit(cross(jet.du, jet.dv));
  }

  template <class Take>
  Result<void> found(std::size_t own, Vec2 at, Vec2 other, const Take& take) {
    const std::array<Vec2, 2> places = own == 0 ? std::array{at, other} : std::array{other, at};
    const SurfaceJet a = ball_.face(0).jet(places[0]), b = ball_.face(1).jet(places[1]);
    const Vec3 normal = unit(cross(cross(a.du, a.dv), cross(b.du, b.dv)));
    if (!(norm(normal) > 0.0)) return {};
    const auto place = ball_.in_plane({places[0], places[1]}, 0.0, centre_at(own, at), normal);
    if (!place || !ball_.face(0).inside(place->touch[0].at) ||
        !ball_.face(1).inside(place->touch[1].at)) {
      return {};
    }
    return take(*place);
  }

  const RollingBall& ball_;
  const RunContext& run_;
};

double distance_from_way(const BallWay& way, Vec3 p) {
  double least = HUGE_VAL;
  for (std::size_t i = 0; i + 1 < way.places.size(); ++i) {
    const Vec3 a = way.places[i].centre, b = way.places[i + 1].centre;
    least = std::min(least, distance_from_chord(p, a, b));
  }
  return least;
}

Result<void> check_fillet(const FilletOptions& options) {
  for (const double value : {options.radius, options.radius_end, options.tolerance}) {
    if (value > 0.0 && std::isfinite(value)) continue;
    return error(ErrorCode::kBadOption, "radii and tolerance of a blend have to be greater than 0")
        .value(value);
  }
  return {};
}

/// A way found with one radius, with a radius that changes along it.
struct ChangedWay {
  RollingBall ball;
  BallWay way;
};
Result<ChangedWay> changing_way(const RollingBall& constant, const BallWay& way, double radius_end,
                                const RunContext& run) {
  if (way.closed) {
    return error(ErrorCode::kBadOption, "a blend that closes has one radius")
        .where("--radius-end")
        .hint("leave it out");
  }
  const auto start = place_at(constant, way, std::max(way.on[0].from, way.on[1].from));
  if (!start)
    return error(ErrorCode::kSurfaceFolds, "the ball cannot be followed between the faces");
  BallPlace from = *start;
  from.s = 0.0;
  const double radius = from.radius;
  double length = std::min(way.on[0].to, way.on[1].to) - std::max(way.on[0].from, way.on[1].from);
  constexpr int kMostTries = 60;
  constexpr double kSettled = 1e-12;
  constexpr double kLonger = 1.05;  // than a way on which the radius runs out
  constexpr int kMostLonger = 20;   // times that, together 2.7
  double too_short = 0.0, long_enough = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kMostTries; ++k) {
    const double slope = (radius_end - radius) / length;
    if (!(std::abs(slope) < 1.0)) {
      return error(ErrorCode::kBadOption, "the radius changes by more than the length of the edge")
          .where("--radius-end")
          .value(length);
    }
    RollingBall ball(constant.face(0), constant.face(1), radius, slope, constant.size());
    const auto first =
        ball.in_plane({from.touch[0].at, from.touch[1].at}, 0.0, from.centre, from.along);
    if (!first) return error(ErrorCode::kSurfaceFolds, "the radius changes too fast for the faces");
    auto changed = way_of(ball, *first, run);
    const bool may_run_out = radius_end < radius && (k < kMostLonger || std::isfinite(long_enough));
    if (!changed && may_run_out && changed.error().code == ErrorCode::kSurfaceFolds) {
      too_short = length;  // on a longer way the radius falls slower
      length = std::isfinite(long_enough) ? 0.5 * (length + long_enough) : kLonger * length;
      continue;
    }
    OBVID_TRY(changed);
    const double now = std::min(changed->on[0].to, changed->on[1].to);
    if (std::abs(now - length) <= kSettled * length) return ChangedWay{ball, std::move(*changed)};
    if (now < length) long_enough = std::min(long_enough, length);
    length = now > too_short ? now : 0.5 * (too_short + long_enough);
  }
  return error(ErrorCode::kToleranceNotReached, "the length of the spine does not settle")
      .hint("take radii that differ less");
}

}  // namespace

Result<std::vector<Fillet>> fillets_between(const std::array<const SurfacePatch*, 2>& faces,
                                            const FilletOptions& options, const RunContext& run) {
  OBVID_TRY(check_fillet(options));
  for (const SurfacePatch* face : faces) OBVID_TRY(check(*face));
  const double size = size_of({&faces[0]->surface, &faces[1]->surface});
  const auto sides = ball_sides_of(faces, options, size);
  OBVID_TRY(sides);
  const BallFace first(*faces[0], (*sides)[0], size), second(*faces[1], (*sides)[1], size);
  const RollingBall ball(first, second, options.radius, 0.0, size);
  std::vector<BallWay> ways;
  const auto follow = [&](const BallPlace& place) -> Result<void> {
    for (const BallWay& way : ways) {
      if (distance_from_way(way, place.centre) <= kSameBallWay * options.radius) return {};
    }
    auto way = way_of(ball, place, run);
    OBVID_TRY(way);
    ways.push_back(std::move(*way));
    return {};
  };
  OBVID_TRY(tell(run, "blends", 0.0));
  const auto searched = WaySearch(ball, run).each(follow);
  OBVID_TRY(searched);
  if (ways.empty()) {
    return error(ErrorCode::kNothingThere,
                 fmt::format("no ball of radius {:g} touches both {} and {} on these sides",
                             options.radius, faces[0]->name, faces[1]->name))
        .hint("take a smaller radius, or other --sides")
        .value(options.radius);
  }
  std::vector<Fillet> out;
  for (const BallWay& way : ways) {
    OBVID_TRY(
        tell(run, "blends", static_cast<double>(out.size()) / static_cast<double>(ways.size())));
    if (options.radius_end == options.radius) {
      auto made = BlendMaker(ball, way, options, run).made();
      OBVID_TRY(made);
      out.push_back(std::move(*made));
      continue;
    }
    const auto changed = changing_way(ball, way, options.radius_end, run);
    OBVID_TRY(changed);
    auto made = BlendMaker(changed->ball, changed->way, options, run).made();
    OBVID_TRY(made);
    out.push_back(std::move(*made));
  }
  return out;
}

SpaceCurve contact_curve(const Fillet& fillet, std::size_t face) {
  SpaceCurve curve = isocurve_at_u(fillet.surface, face == 0 ? 0.0 : 1.0);
  const Range on = fillet.contacts[face].along, all = domain(curve);
  if (on.to < all.to) curve = split(curve, on.to)[0];
  if (on.from > all.from) curve = split(curve, on.from)[1];
  return curve;
}

}  // namespace obvid
