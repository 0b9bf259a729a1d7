// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_cut/internal/plane_section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "branches.h"
#include "inside_trims.h"
#include "meeting_ends.h"
#include "obvid/geom/internal/box.h"
#include "obvid/geom/internal/chord.h"
#include "obvid/surface/internal/topology.h"

namespace obvid {

struct ModelCutter::Parts {
  const SurfaceModel& model;
  std::vector<CutPatch> patches;
  Topology topology;
  double size = 0.0, largest = 0.0;  ///< units: of the model, and its largest coordinate
  double heaviest = 1.0;             ///< weight
};

namespace {

constexpr double kBesidePlane = 1e-12;   ///< of the size
constexpr double kRoundingsBeside = 64;  ///< of the largest coordinate, where that is more
constexpr double kForBetween =
    0.8;  ///< of the tolerance: what lies between the places that are measured
constexpr double kTouching = 4e-6;   ///< of the size: branches smaller or narrower than this
constexpr double kEndsMeet = 1e-6;   ///< of the size
constexpr double kSamePlace = 1e-4;  ///< of the size: places that are told once
constexpr double kTangent = 1e-5;    ///< rad: where branches beside the plane run along it
constexpr double kParallel = 1e-2;   ///< rad: of tangent planes where a plane touches

template <class Parts>
class Section {
 public:
  Section(const Parts& parts, const CutPlane& plane, const PlaneSectionOptions& options)
      : parts_(parts),
        plane_(plane),
        beside_(std::max(kBesidePlane * parts.size, kRoundingsBeside * rounding())),
        foot_(plane_, rounding()),
        tolerance_(kForBetween * options.tolerance),
        trimmed_(is_trimmed(parts.model)) {}

  Result<PlaneSection> made(const RunContext& run) {
    find_borders_in_plane();
    CutPlane cut = plane_;
    cut.offset += side() * beside_;
    for (std::size_t i = 0; i < parts_.patches.size(); ++i) {
      OBVID_TRY(may_go_on(run));
      auto found = strands_of(parts_.patches[i], i, cut, 4.0 * rounding() * parts_.heaviest, run);
      OBVID_TRY(found);
      const std::size_t before = 2 * strands_.size();
      strands_.insert(strands_.end(), found->strands.begin(), found->strands.end());
      for (const EndNumber end : found->mate) mate_.push_back(end == kNoEnd ? end : end + before);
      for (const SectionCell& cell : found->undecided) take_undecided(cell, i);
      for (const SectionCell& cell : found->near) take_near(cell, i);
    }
    settle_ends();
    join_at_borders();
    join_nearest();
    OBVID_TRY(may_go_on(run));
    walk_all();
    add_borders_in_plane();
    if (trimmed_) {
      out_.branches = inside_trims(out_.branches, parts_.model, plane_, kEndsMeet * parts_.size);
      drop_what_trims_only_touch();
    }
    for (SectionBranch& branch : out_.branches) tidy(branch);
    tell_touching();
    return std::move(out_);
  }

 private:
  [[nodiscard]] double rounding() const {
    return std::numeric_limits<double>::epsilon() *
           std::max(parts_.largest, std::abs(plane_.offset));
  }

  /// Free borders that lie in the plane, and patches that do.
  void find_borders_in_plane() {
    for (std::size_t i = 0; i < parts_.patches.size(); ++i) {
      if (in_plane(parts_.patches[i].surface->points)) out_.in_plane.push_back(i);
    }
    for (std::size_t e = 0; e < parts_.topology.edges.size(); ++e) {
      const TopologyEdge& edge = parts_.topology.edges[e];
      if (!edge.point && in_plane(edge.curve.points)) borders_.push_back(e);
    }
  }
  [[nodiscard]] bool in_plane(const std::vector<Vec3>& points) const {
    return std::all_of(points.begin(), points.end(),
                       [&](Vec3 p) { return std::abs(foot_.height(p)) <= beside_; });
  }

  /// On which side of the plane it is decided how branches run.
  [[nodiscard]] double side() const {
    const auto lies_above = [&](std::size_t patch) {
      const auto& points = parts_.patches[patch].surface->points;
      return std::any_of(points.begin(), points.end(),
                         [&](Vec3 p) { return foot_.height(p) > beside_; });
    };
    for (const std::size_t e : borders_) {
      const TopologyEdge& edge = parts_.topology.edges[e];
      const std::size_t patch = edge.uses.front().patch;
      if (edge.uses.size() == 1) return lies_above(patch) ? -1.0 : 1.0;
    }
    for (std::size_t i = 0; i < parts_.patches.size(); ++i) {
      if (lies_above(i)) return 1.0;
    }
    return -1.0;
  }

  // ------------------------------------------------------------------ places that are not crossed
  struct CellPlace {
    Vec3 point;
    bool parallel = false;  ///< tangent plane and plane
  };
  [[nodiscard]] CellPlace middle_of(const SectionCell& cell, std::size_t patch) const {
    const CutPatch& p = parts_.patches[patch];
    const Range a = cell.shares_u(), b = cell.shares_v();
    const SurfaceJet jet =
        evaluate(*p.surface, p.u.at(cell.span_u, a.at(0.5)), p.v.at(cell.span_v, b.at(0.5)));
    const Vec3 normal = cross(jet.du, jet.dv);
    return {jet.point, norm(cross(normal, plane_.normal)) <= kParallel * norm(normal)};
  }
  void take_undecided(const SectionCell& cell, std::size_t patch) {
    ++out_.undecided;
    const CellPlace place = middle_of(cell, patch);
    if (place.parallel) near_.push_back(place.point);
  }
  void take_near(const SectionCell& cell, std::size_t patch) {
    const CellPlace place = middle_of(cell, patch);
    if (place.parallel) near_.push_back(place.point);
  }
  void tell_touching() {
    // a place a cluster, in the order found; few, or else the line is told by `undecided`
    constexpr std::size_t kMostPlaces = 16;
    const double same = kSamePlace * parts_.size;
    for (const Vec3 p : near_) {
      const bool new_one = std::none_of(out_.touching.begin(), out_.touching.end(),
                                        [&](Vec3 q) { return norm(p - q) <= same; });
      if (new_one && out_.touching.size() < kMostPlaces) out_.touching.push_back(p);
    }
  }

  // ------------------------------------------------------------------------------------- joining
  void settle_ends() {
    for (const Strand& strand : strands_) {
      for (const StrandEnd& end : strand.end) {
        const CutPatch& patch = parts_.patches[strand.patch];
        at_.push_back(foot_.slid(patch, strand.patch, end.u, end.v, !end.on_u_line));
        const SectionPoint here = at_.back();
        if (foot_.is_there(here.point) || border_side(at_.size() - 1)) continue;
        // the branch runs along the line: across it, then; the other strand's end goes likewise
        at_.back() = foot_.slid(patch, strand.patch, here.u, here.v, end.on_u_line);
      }
    }
  }

  void join_at_borders() {
    struct OnEdge {
      double part;
      EndNumber end;
    };
    std::map<std::size_t, std::map<std::pair<std::size_t, std::size_t>, std::vector<OnEdge>>> edges;
    for (EndNumber e = 0; e < mate_.size(); ++e) {
      if (mate_[e] != kNoEnd) continue;
      const auto side = border_side(e);
      if (!side) continue;
      const std::size_t patch = strands_[e / 2].patch;
      const EdgeUse& use = parts_.topology.use(patch, *side);
      const NurbsSurface& s = *parts_.patches[patch].surface;
      const bool along_u = runs_along_u(*side);
      const Range range = along_u ? domain_u(s) : domain_v(s);
      const StrandEnd& end = strands_[e / 2].end[e % 2];
      const double part = ((along_u ? end.u : end.v) - range.from) / range.length();
      edges[parts_.topology.edge_of[patch][*side]][{patch, *side}].push_back(
          {use.along ? part : 1.0 - part, e});
    }
    for (auto& [edge, sides] : edges) {
      if (sides.size() != 2 || parts_.topology.edges[edge].uses.size() != 2) continue;
      auto& a = sides.begin()->second;
      auto& b = std::next(sides.begin())->second;
      if (a.size() != b.size()) continue;
      for (auto* some : {&a, &b}) {
        std::sort(some->begin(), some->end(),
                  [](const OnEdge& x, const OnEdge& y) { return x.part < y.part; });
      }
      for (std::size_t i = 0; i < a.size(); ++i) join(a[i].end, b[i].end);
    }
  }
  [[nodiscard]] std::optional<PatchSide> border_side(EndNumber e) const {
    const Strand& strand = strands_[e / 2];
    const StrandEnd& end = strand.end[e % 2];
    const CutPatch& patch = parts_.patches[strand.patch];
    const std::size_t spans = end.on_u_line ? patch.u.spans() : patch.v.spans();
    if (end.share != 0.0) return std::nullopt;
    if (end.span == 0) return end.on_u_line ? kUStart : kVStart;
    if (end.span == spans) return end.on_u_line ? kUEnd : kVEnd;
    return std::nullopt;
  }
  void join(EndNumber a, EndNumber b) {
    mate_[a] = b;
    mate_[b] = a;
  }

  /// What is left: the two nearest ends first.
  void join_nearest() {
    std::vector<EndNumber> left;
    for (EndNumber e = 0; e < mate_.size(); ++e) {
      if (mate_[e] == kNoEnd) left.push_back(e);
    }
    const auto mates = meeting_ends(
        std::move(left), kEndsMeet * parts_.size, [&](EndNumber e) { return at_[e].point; },
        [](EndNumber a, EndNumber b) { return a / 2 != b / 2; });
    for (const auto& [a, b] : mates) join(a, b);
  }

  // ------------------------------------------------------------------------------------- walking
  void walk_all() {
    std::vector<bool> seen(strands_.size(), false);
    for (EndNumber e = 0; e < mate_.size(); ++e) {
      if (mate_[e] == kNoEnd && !seen[e / 2]) walk(e, seen);
    }
    for (std::size_t i = 0; i < strands_.size(); ++i) {
      if (!seen[i]) walk(2 * i, seen);
    }
  }

  void walk(EndNumber start, std::vector<bool>& seen) {
    SectionBranch branch;
    EndNumber here = start;
    for (;;) {
      const std::size_t number = here / 2;
      seen[number] = true;
      const Strand& strand = strands_[number];
      const EndNumber out = here ^ 1U;
      auto places = sampled(foot_, parts_.patches[strand.patch], strand, at_[here], at_[out],
                            tolerance_, branch.deviation);
      const EndNumber next = mate_[out];
      if (next != kNoEnd) {
        branch.gap = std::max(branch.gap, norm(at_[out].point - at_[next].point));
        leave(places);
      }
      branch.points.insert(branch.points.end(), places.begin(), places.end());
      branch.closed = next == start;
      if (next == kNoEnd || next == start) break;
      here = next;
    }
    Box3 box;
    for (const SectionPoint& p : branch.points) box.add(p.point);
    if (branch.closed && box.diagonal() <= kTouching * parts_.size) {
      near_.push_back(branch.points.front().point);
      return;
    }
    std::size_t touching = 0;
    for (const SectionPoint& p : branch.points) {
      if (!touches(p)) continue;
      ++touching;
      near_.push_back(p.point);
    }
    const bool sliver =
        branch.closed && touching > 0 && mean_width(branch.points) <= kTouching * parts_.size;
    if (touching == branch.points.size() || sliver) {
      add_touching_line(branch);
      return;
    }
    out_.branches.push_back(std::move(branch));
  }

  /// What of a branch is inside where a trim touches it: smaller than what counts as one.
  void drop_what_trims_only_touch() {
    const auto is_small = [&](const SectionBranch& branch) {
      Box3 box;
      for (const SectionPoint& p : branch.points) box.add(p.point);
      if (box.diagonal() > kTouching * parts_.size) return false;
      near_.push_back(branch.points.front().point);
      return true;
    };
    out_.branches.erase(std::remove_if(out_.branches.begin(), out_.branches.end(), is_small),
                        out_.branches.end());
  }

  /// A line along which the surface touches the plane is met on both of its sides, and in each
  /// patch that it is a border of.
  void add_touching_line(const SectionBranch& branch) {
    const double same = kSamePlace * parts_.size;
    const auto lies_on = [&](Vec3 p, const SectionBranch& line) {
      const std::size_t count = line.points.size();
      if (count == 1) return norm(p - line.points.front().point) <= same;
      for (std::size_t i = line.closed ? 0 : 1; i < count; ++i) {
        const Vec3 before = line.points[(i + count - 1) % count].point;
        if (distance_from_chord(p, before, line.points[i].point) <= same + 2.0 * tolerance_)
          return true;
      }
      return false;
    };
    const bool told = std::any_of(lines_.begin(), lines_.end(), [&](const SectionBranch& line) {
      return std::all_of(branch.points.begin(), branch.points.end(),
                         [&](const SectionPoint& p) { return lies_on(p.point, line); });
    });
    if (told) return;
    lines_.push_back(branch);
    ++out_.touching_lines;
  }

  /// Of a closed branch: its area over half of its length.
  static double mean_width(const std::vector<SectionPoint>& points) {
    const Vec3 first = points.front().point;
    Vec3 area;
    double length = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec3 a = points[i].point, b = points[(i + 1) % points.size()].point;
      area = area + 0.5 * cross(a - first, b - first);
      length += norm(b - a);
    }
    return length > 0.0 ? 2.0 * norm(area) / length : 0.0;
  }

  /// The last place is the first one of what comes next: there once, but for trims, which need it
  /// with the parameters of both patches.
  void leave(std::vector<SectionPoint>& places) const {
    if (trimmed_) {
      places.back().stands_again = true;
    } else {
      places.pop_back();
    }
  }

  /// Whether the tangent plane is the cutting one, as far as a branch beside it can tell.
  [[nodiscard]] bool touches(const SectionPoint& p) const {
    const SurfaceJet jet = evaluate(*parts_.patches[p.patch].surface, p.u, p.v);
    const Vec3 normal = cross(jet.du, jet.dv);
    return norm(normal) > 0.0 && norm(cross(normal, plane_.normal)) <= kTangent * norm(normal);
  }

  // ------------------------------------------------------------------------- borders in the plane
  void add_borders_in_plane() {
    std::vector<std::size_t> left;
    for (const std::size_t e : borders_) {
      const TopologyEdge& edge = parts_.topology.edges[e];
      if (is_side_of_trimmed(edge)) continue;
      // where patches meet the surface may only touch the plane, which is told already
      if (edge.uses.size() == 1 || !touches(middle_of(edge))) {
        if (!covered(edge)) left.push_back(e);
      }
    }
    while (!left.empty()) {
      SectionBranch branch;
      const std::size_t first = left.front();
      left.erase(left.begin());
      append(branch, first, true);
      std::size_t at = parts_.topology.edges[first].to;
      const std::size_t from = parts_.topology.edges[first].from;
      for (int turn = 0; turn < 2; ++turn) {  // on to the end, then back from the start
        for (;;) {
          const auto next = std::find_if(left.begin(), left.end(), [&](std::size_t e) {
            const TopologyEdge& edge = parts_.topology.edges[e];
            return edge.from == at || edge.to == at;
          });
          if (next == left.end() || (turn == 0 && at == from)) break;
          const TopologyEdge& edge = parts_.topology.edges[*next];
          const bool along = edge.from == at;
          append(branch, *next, along);
          at = along ? edge.to : edge.from;
          left.erase(next);
        }
        if (at == from && turn == 0) {
          branch.closed = true;
          leave(branch.points);
          break;
        }
        if (turn == 0) {
          turn_round(branch.points);
          at = from;
        }
      }
      out_.branches.push_back(std::move(branch));
    }
  }
  static void turn_round(std::vector<SectionPoint>& places) {
    std::reverse(places.begin(), places.end());
    for (std::size_t i = 0; i + 1 < places.size(); ++i) {
      places[i].stands_again = places[i + 1].stands_again;
    }
    places.back().stands_again = false;
  }
  [[nodiscard]] SectionPoint middle_of(const TopologyEdge& edge) const {
    const EdgeUse& use = crossing_use(edge);
    const NurbsSurface& s = *parts_.patches[use.patch].surface;
    const bool along_u = runs_along_u(use.side), far = is_far_end(use.side);
    const Range u = domain_u(s), v = domain_v(s);
    const double at_u = along_u ? u.at(0.5) : far ? u.to : u.from;
    const double at_v = along_u ? (far ? v.to : v.from) : v.at(0.5);
    return {evaluate(s, at_u, at_v).point, use.patch, at_u, at_v};
  }
  /// Of a trimmed patch that lies in the plane: no border of what is there.
  [[nodiscard]] bool is_side_of_trimmed(const TopologyEdge& edge) const {
    const std::size_t patch = edge.uses.front().patch;
    return edge.uses.size() == 1 && !parts_.model.patches[patch].trims.empty() &&
           std::find(out_.in_plane.begin(), out_.in_plane.end(), patch) != out_.in_plane.end();
  }
  /// The patch that the plane crosses there, not one that lies in it, where there is one.
  [[nodiscard]] const EdgeUse& crossing_use(const TopologyEdge& edge) const {
    const auto lies_in_plane = [&](const EdgeUse& use) {
      return std::find(out_.in_plane.begin(), out_.in_plane.end(), use.patch) !=
             out_.in_plane.end();
    };
    const auto found = std::find_if_not(edge.uses.begin(), edge.uses.end(), lies_in_plane);
    return found == edge.uses.end() ? edge.uses.front() : *found;
  }
  [[nodiscard]] bool covered(const TopologyEdge& edge) const {
    const Vec3 middle = evaluate(edge.curve, domain(edge.curve).at(0.5)).point;
    for (const SectionBranch& branch : out_.branches) {
      const std::size_t count = branch.points.size();
      for (std::size_t i = branch.closed ? 0 : 1; i < count; ++i) {
        const Vec3 before = branch.points[(i + count - 1) % count].point;
        if (distance_from_chord(middle, before, branch.points[i].point) <= 2.0 * tolerance_)
          return true;
      }
    }
    return false;
  }
  /// The places of a border, ends included; where the branch ends in its first one, that one once.
  void append(SectionBranch& branch, std::size_t number, bool along) {
    const EdgeUse& use = crossing_use(parts_.topology.edges[number]);
    const NurbsSurface& s = *parts_.patches[use.patch].surface;
    const bool along_u = runs_along_u(use.side), far = is_far_end(use.side);
    const Range range = along_u ? domain_u(s) : domain_v(s);
    const double fixed = along_u ? (far ? domain_v(s).to : domain_v(s).from)
                                 : (far ? domain_u(s).to : domain_u(s).from);
    const auto place = [&](double t) {
      const double u = along_u ? t : fixed, v = along_u ? fixed : t;
      return SectionPoint{evaluate(s, u, v).point, use.patch, u, v};
    };
    const auto t_of = [&](const SectionPoint& p) { return along_u ? p.u : p.v; };
    constexpr int kMostHalvings = 12;
    std::vector<SectionPoint> places;
    const auto refine = [&](const auto& self, const SectionPoint& a, const SectionPoint& b,
                            int halvings) -> void {
      const SectionPoint middle = place(0.5 * (t_of(a) + t_of(b)));
      double most = distance_from_chord(middle.point, a.point, b.point);
      for (const double part : {0.25, 0.75}) {
        const SectionPoint p = place(Range{t_of(a), t_of(b)}.at(part));
        most = std::max(most, distance_from_chord(p.point, a.point, b.point));
      }
      if (most <= tolerance_ || halvings >= kMostHalvings) {
        branch.deviation = std::max(branch.deviation, most);
        places.push_back(b);
        return;
      }
      self(self, a, middle, halvings + 1);
      self(self, middle, b, halvings + 1);
    };
    const std::vector<double> knots =
        (along_u ? parts_.patches[use.patch].u : parts_.patches[use.patch].v).knots;
    places.push_back(place(range.from));
    for (std::size_t i = 1; i < knots.size(); ++i) {
      refine(refine, place(knots[i - 1]), place(knots[i]), 0);
    }
    // of closed ones and joints the first place is there already
    if (along != use.along) std::reverse(places.begin(), places.end());
    if (!branch.points.empty()) leave(branch.points);
    branch.points.insert(branch.points.end(), places.begin(), places.end());
  }

  /// Without places that lie on each other as far as the tolerance can tell.
  void tidy(SectionBranch& branch) {
    constexpr double kSame = 1e-3;  // tolerances
    std::vector<SectionPoint> kept;
    const std::size_t count = branch.points.size();
    for (std::size_t i = 0; i < count; ++i) {
      const SectionPoint& p = branch.points[i];
      const bool last = i + 1 == count && !branch.closed;
      const bool same = !kept.empty() && norm(p.point - kept.back().point) <= kSame * tolerance_;
      if (same && !last) continue;
      if (same && kept.size() > 1) kept.pop_back();
      kept.push_back(p);
    }
    while (branch.closed && kept.size() > 3 &&
           norm(kept.front().point - kept.back().point) <= kSame * tolerance_) {
      kept.pop_back();
    }
    branch.points = std::move(kept);
    for (const SectionPoint& p : branch.points) {
      out_.residual = std::max(out_.residual, std::abs(foot_.height(p.point)));
    }
  }

  const Parts& parts_;
  CutPlane plane_;
  double beside_;
  PlaneFoot foot_;
  double tolerance_;
  bool trimmed_;
  std::vector<Strand> strands_;
  std::vector<EndNumber> mate_;
  std::vector<SectionPoint> at_;  ///< of each end
  std::vector<std::size_t> borders_;
  std::vector<Vec3> near_;
  std::vector<SectionBranch> lines_;  ///< along which the surface touches the plane
  PlaneSection out_;
};

Result<void> check(const CutPlane& plane, const PlaneSectionOptions& options, double size) {
  constexpr double kUnit = 1e-12;
  if (!(std::abs(norm(plane.normal) - 1.0) <= kUnit)) {
    return error(ErrorCode::kBadOption, "the normal of the plane has not length 1");
  }
  if (!std::isfinite(plane.offset)) {
    return error(ErrorCode::kNotFinite, "the plane lies at no finite place");
  }
  if (!(options.tolerance > 0.0 && std::isfinite(options.tolerance))) {
    return error(ErrorCode::kBadOption, "the tolerance of a section has to be greater than 0");
  }
  if (!(size > 0.0)) return error(ErrorCode::kTooFewPoints, "the surface has no size");
  return {};
}

}  // namespace

ModelCutter::ModelCutter(const SurfaceModel& model) {
  auto parts = std::make_unique<Parts>(Parts{model, {}, topology_of(model)});
  parts->size = size_of(model);
  for (const SurfacePatch& patch : model.patches) {
    parts->patches.push_back(cut_patch(patch.surface));
    for (const Vec3 p : patch.surface.points) {
      parts->largest = std::max({parts->largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    for (const double w : patch.surface.weights) parts->heaviest = std::max(parts->heaviest, w);
  }
  parts_ = std::move(parts);
}
ModelCutter::~ModelCutter() = default;

Result<PlaneSection> ModelCutter::section(const CutPlane& plane, const PlaneSectionOptions& options,
                                          const RunContext& run) const {
  OBVID_TRY(check(plane, options, parts_->size));
  return Section<Parts>(*parts_, plane, options).made(run);
}

}  // namespace obvid
