// SPDX-License-Identifier: Apache-2.0
// The nearest place of many patches: a tree of boxes around the spans, Newton's steps inside, and
// spans divided until none can hold a nearer place.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <utility>

#include "obvid/curve/internal/basis.h"
#include "obvid/geom/internal/box.h"
#include "obvid/numeric/internal/golden.h"
#include "obvid/surface/internal/trim.h"
#include "obvid/surface_builders/internal/deviation.h"
#include "span_net.h"

namespace obvid {
namespace nearest_detail {

/// Cells of a model with few patches, about; and how often a direction is divided at most and
/// least.
constexpr double kCells = 20'000.0;
constexpr double kMostParts = 24.0, kLeastParts = 4.0;
constexpr std::uint32_t kLeafCells = 4;
/// A residual that turns from the normal by more than this (sine) does not stand on the surface.
constexpr double kAlongNormal = 1e-6;
/// Of the coordinates: shorter residuals are rounding and have no direction.
constexpr double kRounding = 1e-12;
/// Of the model's size: how much nearer a place may be that is not looked for.
constexpr double kNotNearer = 1e-10;
/// Parts that are divided for one point: far more than are needed but beside centres of curvature,
/// where many places are equally near.
constexpr int kMostDivided = 1'000;

struct Cell {
  Box3 box;
  std::uint32_t patch = 0;
  Range u, v;
};

static double square_from(const Box3& box, Vec3 p) {
  const auto outside = [](double x, double low, double high) {
    return std::max({low - x, x - high, 0.0});
  };
  const Vec3 d{outside(p.x, box.low.x, box.high.x), outside(p.y, box.low.y, box.high.y),
               outside(p.z, box.low.z, box.high.z)};
  return dot(d, d);
}

/// Knots that divide a domain into about `parts`, where the spans are longer.
static std::vector<double> dividing(const std::vector<double>& knots, const Range& domain,
                                    double parts) {
  std::vector<double> out;
  const std::vector<double> ends = distinct(knots);
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const Range span{ends[k], ends[k + 1]};
    const double cells = std::ceil(parts * span.length() / domain.length());
    for (double i = 1.0; i < cells; i += 1.0) out.push_back(span.at(i / cells));
  }
  return out;
}

/// A span lies in the box of its control points: the weights are positive.
static void add_cells(const NurbsSurface& surface, std::uint32_t patch, double parts,
                      std::vector<Cell>& cells) {
  NurbsSurface fine = with_knots_u(surface, dividing(surface.knots_u, domain_u(surface), parts));
  fine = with_knots_v(fine, dividing(fine.knots_v, domain_v(fine), parts));
  const auto p = static_cast<std::size_t>(fine.degree_u),
             q = static_cast<std::size_t>(fine.degree_v);
  for (std::size_t j = q; j < fine.count_v(); ++j) {
    if (!(fine.knots_v[j] < fine.knots_v[j + 1])) continue;
    for (std::size_t i = p; i < fine.count_u(); ++i) {
      if (!(fine.knots_u[i] < fine.knots_u[i + 1])) continue;
      Cell cell;
      cell.patch = patch;
      cell.u = {fine.knots_u[i], fine.knots_u[i + 1]};
      cell.v = {fine.knots_v[j], fine.knots_v[j + 1]};
      for (std::size_t l = j - q; l <= j; ++l) {
        for (std::size_t k = i - p; k <= i; ++k) cell.box.add(fine.points[l * fine.count_u() + k]);
      }
      cells.push_back(cell);
    }
  }
}

/// Place and squared distance while one is looked for.
struct Found {
  double square = HUGE_VAL;
  std::uint32_t patch = 0;
  double u = 0.0, v = 0.0;
};

/// What of a trimmed patch is there, and its trims in short pieces.
class Trimmed {
 public:
  explicit Trimmed(const SurfacePatch& patch) : patch_(patch), region_(patch) {
    for (const TrimLoop& loop : patch.trims) {
      for (const NurbsCurve& curve : loop.curves) add(curve);
    }
  }

  enum class Side { kThere, kGone, kAcross };
  [[nodiscard]] Side side_of(const Cell& cell) const {
    for (const Piece& piece : pieces_) {
      const bool meets = piece.u.from <= cell.u.to && piece.u.to >= cell.u.from &&
                         piece.v.from <= cell.v.to && piece.v.to >= cell.v.from;
      if (meets) return Side::kAcross;
    }
    return contains(cell.u.at(0.5), cell.v.at(0.5)) ? Side::kThere : Side::kGone;
  }
  [[nodiscard]] bool contains(double u, double v) const { return region_.contains(u, v); }

  /// The nearest place of the trims, where that is nearer.
  void nearest(Vec3 p, std::uint32_t patch, Found& best) const {
    for (const Piece& piece : pieces_) {
      if (square_from(piece.box, p) < best.square) keep(piece, piece.t.at(0.5), p, patch, best);
    }
    for (const Piece& piece : pieces_) {
      if (square_from(piece.box, p) < best.square) keep(piece, least_on(piece, p), p, patch, best);
    }
  }

 private:
  struct Piece {
    const NurbsCurve* curve = nullptr;
    Range t, u, v;
    Box3 box;
  };

  [[nodiscard]] Vec2 place(const NurbsCurve& curve, double t) const {
    const Range u = domain_u(patch_.surface), v = domain_v(patch_.surface);
    const Vec2 at = evaluate(curve, t).point;
    return {std::clamp(at.x, u.from, u.to), std::clamp(at.y, v.from, v.to)};
  }
  [[nodiscard]] Vec3 point(Vec2 at) const { return evaluate(patch_.surface, at.x, at.y).point; }

  void add(const NurbsCurve& curve) {
    constexpr int kPieces = 16, kPlaces = 4;  // of a span, of a piece
    constexpr double kMargin = 0.25;          // of a piece: what lies between its places
    const std::vector<double> spans = distinct(curve.knots);
    for (std::size_t s = 0; s + 1 < spans.size(); ++s) {
      const Range span{spans[s], spans[s + 1]};
      for (int k = 0; k < kPieces; ++k) {
        Piece piece{&curve,
                    {span.at(static_cast<double>(k) / kPieces),
                     span.at(static_cast<double>(k + 1) / kPieces)},
                    {HUGE_VAL, -HUGE_VAL},
                    {HUGE_VAL, -HUGE_VAL},
                    {}};
        for (int i = 0; i <= kPlaces; ++i) {
          const Vec2 at = place(curve, piece.t.at(static_cast<double>(i) / kPlaces));
          piece.u = {std::min(piece.u.from, at.x), std::max(piece.u.to, at.x)};
          piece.v = {std::min(piece.v.from, at.y), std::max(piece.v.to, at.y)};
          piece.box.add(point(at));
        }
        const double du = kMargin * piece.u.length(), dv = kMargin * piece.v.length();
        piece.u = {piece.u.from - du, piece.u.to + du};
        piece.v = {piece.v.from - dv, piece.v.to + dv};
        const double d = kMargin * piece.box.diagonal();
        piece.box.low = piece.box.low - Vec3{d, d, d};
        piece.box.high = piece.box.high + Vec3{d, d, d};
        pieces_.push_back(piece);
      }
    }
  }

  void keep(const Piece& piece, double t, Vec3 p, std::uint32_t patch, Found& best) const {
    const Vec2 at = place(*piece.curve, t);
    const Vec3 away = point(at) - p;
    if (dot(away, away) < best.square) best = {dot(away, away), patch, at.x, at.y};
  }

  /// Golden sections: a piece is so short that it has one valley.
  [[nodiscard]] double least_on(const Piece& piece, Vec3 p) const {
    constexpr double kFoundTo = 1e-8;  // of a piece: distances are as exact as their rounding
    const auto f = [&](double t) {
      const Vec3 away = point(place(*piece.curve, t)) - p;
      return dot(away, away);
    };
    const double least = lowest_place(piece.t.from, piece.t.to, f, kFoundTo * piece.t.length());
    const double ends = f(piece.t.from) < f(piece.t.to) ? piece.t.from : piece.t.to;
    return f(ends) < f(least) ? ends : least;
  }

  const SurfacePatch& patch_;
  TrimRegion region_;
  std::vector<Piece> pieces_;
};

/// Half of a node's cells each; leaves have none.
struct Branch {
  Box3 box;
  std::uint32_t first = 0, count = 0;  ///< cells
  std::uint32_t left = 0, right = 0;   ///< branches; 0: a leaf
};

/// A cell, or a part of one, that may hold a nearer place than was found: at least that far off.
struct Undecided {
  double least = 0.0;
  Cell cell;
  bool longer_along_u = false;  ///< where it is divided

  friend bool operator<(const Undecided& a, const Undecided& b) { return a.least > b.least; }
};

struct Looked {
  Found best;
  std::vector<Undecided> undecided;
};

/// Newton's step inside the cell, downhill: to where the parabola is least that the squared
/// distance looks like, or that of the distances along the tangents where that has no least place.
static std::array<double, 2> step_of(const SurfaceJet& jet, Vec3 r, const Cell& cell, double u,
                                     double v) {
  const double uu = dot(jet.du, jet.du), vv = dot(jet.dv, jet.dv), uv = dot(jet.du, jet.dv);
  Bowl bowl{uu + dot(r, jet.duu), uv + dot(r, jet.duv), vv + dot(r, jet.dvv), dot(r, jet.du),
            dot(r, jet.dv)};
  if (!(bowl.a > 0.0 && bowl.a * bowl.c - bowl.b * bowl.b > 0.0)) {
    bowl.a = uu;
    bowl.b = uv;
    bowl.c = vv;
  }
  return bowl.lowest_in({cell.u.from - u, cell.u.to - u}, {cell.v.from - v, cell.v.to - v});
}

}  // namespace nearest_detail

struct NearestOnModel::Tree {
  std::vector<const NurbsSurface*> patches;
  std::vector<std::unique_ptr<nearest_detail::Trimmed>> trimmed;  ///< of each patch; null: whole
  std::vector<nearest_detail::Cell> cells;
  std::vector<nearest_detail::Branch> branches;
  double model_size = 0.0;

  std::uint32_t build(std::uint32_t first, std::uint32_t count) {
    const auto number = static_cast<std::uint32_t>(branches.size());
    branches.push_back({{}, first, count, 0, 0});
    Box3 box, middles;
    for (std::uint32_t k = first; k < first + count; ++k) {
      box.add_box(cells[k].box);
      middles.add(cells[k].box.middle());
    }
    branches[number].box = box;
    if (count <= nearest_detail::kLeafCells) return number;
    const Vec3 size = middles.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto along = [axis](const nearest_detail::Cell& cell) {
      const Vec3 m = cell.box.middle();
      return axis == 0 ? m.x : axis == 1 ? m.y : m.z;
    };
    const std::uint32_t half = count / 2;
    std::nth_element(cells.begin() + first, cells.begin() + first + half,
                     cells.begin() + first + count,
                     [&](const nearest_detail::Cell& a, const nearest_detail::Cell& b) {
                       return along(a) < along(b);
                     });
    const std::uint32_t left = build(first, half);
    const std::uint32_t right = build(first + half, count - half);
    branches[number].left = left;
    branches[number].right = right;
    return number;
  }

  [[nodiscard]] nearest_detail::Trimmed::Side side_of(const nearest_detail::Cell& cell) const {
    const auto& cut = trimmed[cell.patch];
    return cut ? cut->side_of(cell) : nearest_detail::Trimmed::Side::kThere;
  }

  /// From a place of the cell downhill to a nearer one that is there. True: there is no nearer one
  /// in the cell, if it has one valley.
  bool go_down(const nearest_detail::Cell& cell, bool across, Vec3 p, double u, double v,
               nearest_detail::Found& best) const {
    struct Step {
      double u = 0.0, v = 0.0;
      SurfaceJet jet;
      double distance = 0.0;
    };
    const auto at_place = [&](double to_u, double to_v) {
      Step out{std::clamp(to_u, cell.u.from, cell.u.to),
               std::clamp(to_v, cell.v.from, cell.v.to),
               {},
               0.0};
      // derivatives of this span, not of one that begins at its end
      out.jet =
          evaluate(*patches[cell.patch], std::min(out.u, std::nextafter(cell.u.to, cell.u.from)),
                   std::min(out.v, std::nextafter(cell.v.to, cell.v.from)));
      out.distance = norm(out.jet.point - p);
      return out;
    };
    constexpr int kMostSteps = 30, kMostHalvings = 12;
    constexpr double kLastStep = 1e-8;  // of a cell: the next one is its square
    // what is no rise, but the rounding of coordinates
    const double rounding = 8.0 * std::numeric_limits<double>::epsilon() *
                            std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    Step here = at_place(u, v);
    bool arrived = false;
    for (int step = 0; step < kMostSteps && !arrived; ++step) {
      auto [du, dv] = nearest_detail::step_of(here.jet, here.jet.point - p, cell, here.u, here.v);
      const bool last = std::abs(du) <= kLastStep * cell.u.length() &&
                        std::abs(dv) <= kLastStep * cell.v.length();
      Step next;
      const auto risen = [&] { return !(next.distance <= here.distance + rounding); };
      for (int halving = 0; halving < kMostHalvings; ++halving) {
        next = at_place(here.u + du, here.v + dv);
        if (!risen()) break;
        du /= 2.0;
        dv /= 2.0;
      }
      if (risen()) break;
      here = next;
      arrived = last;
    }
    if (across && !trimmed[cell.patch]->contains(here.u, here.v)) return false;
    const double square = here.distance * here.distance;
    if (square < best.square) best = {square, cell.patch, here.u, here.v};
    return arrived;
  }

  [[nodiscard]] double decided_from(const nearest_detail::Found& best) const {
    return std::sqrt(best.square) - nearest_detail::kNotNearer * model_size;
  }

  void look_inside(const nearest_detail::Cell& cell, Vec3 p, nearest_detail::Looked& looked) const {
    using Side = nearest_detail::Trimmed::Side;
    const Side side = side_of(cell);
    if (side == Side::kGone) return;
    const nearest_detail::SpanNet net(*patches[cell.patch], cell.u, cell.v);
    const auto [least, u, v] = net.flat_foot(p);
    if (least >= decided_from(looked.best)) return;
    const bool arrived =
        go_down(cell, side == Side::kAcross, p, cell.u.at(u), cell.v.at(v), looked.best);
    if (least >= decided_from(looked.best) || (arrived && net.one_valley(p))) return;
    looked.undecided.push_back({least, cell, net.longer_along_u()});
    std::push_heap(looked.undecided.begin(), looked.undecided.end());
  }

  /// Divides what may hold a nearer place, from the one that may hold the nearest on.
  void decide(Vec3 p, nearest_detail::Looked& looked) const {
    for (int divided = 0; !looked.undecided.empty(); ++divided) {
      std::pop_heap(looked.undecided.begin(), looked.undecided.end());
      const auto [least, cell, along_u] = looked.undecided.back();
      looked.undecided.pop_back();
      if (least >= decided_from(looked.best) || divided == nearest_detail::kMostDivided) return;
      nearest_detail::Cell first = cell, second = cell;
      Range& before = along_u ? first.u : first.v;
      Range& after = along_u ? second.u : second.v;
      before.to = after.from = before.at(0.5);
      if (!(before.length() > 0.0 && after.length() > 0.0)) continue;
      look_inside(first, p, looked);
      look_inside(second, p, looked);
    }
  }

  void search(std::uint32_t number, Vec3 p, nearest_detail::Looked& looked) const {
    const nearest_detail::Found& best = looked.best;
    const nearest_detail::Branch& branch = branches[number];
    if (branch.left == 0) {
      for (std::uint32_t k = branch.first; k < branch.first + branch.count; ++k) {
        if (nearest_detail::square_from(cells[k].box, p) < best.square)
          look_inside(cells[k], p, looked);
      }
      return;
    }
    double near = nearest_detail::square_from(branches[branch.left].box, p);
    double far = nearest_detail::square_from(branches[branch.right].box, p);
    std::uint32_t first = branch.left, second = branch.right;
    if (far < near) {
      std::swap(near, far);
      std::swap(first, second);
    }
    if (near < best.square) search(first, p, looked);
    if (far < best.square) search(second, p, looked);
  }
};

NearestOnModel::NearestOnModel(const SurfaceModel& model) : tree_(new Tree) {
  tree_->patches = surfaces_of(model);
  const double parts =
      std::clamp(std::sqrt(nearest_detail::kCells /
                           static_cast<double>(std::max<std::size_t>(model.patches.size(), 1))),
                 nearest_detail::kLeastParts, nearest_detail::kMostParts);
  for (std::size_t i = 0; i < tree_->patches.size(); ++i) {
    nearest_detail::add_cells(*tree_->patches[i], static_cast<std::uint32_t>(i), parts,
                              tree_->cells);
  }
  for (const SurfacePatch& patch : model.patches) {
    tree_->trimmed.push_back(
        patch.trims.empty() ? nullptr : std::make_unique<nearest_detail::Trimmed>(patch));
  }
  std::erase_if(tree_->cells, [&](const nearest_detail::Cell& cell) {
    return tree_->side_of(cell) == nearest_detail::Trimmed::Side::kGone;
  });
  if (tree_->cells.empty()) return;
  tree_->build(0, static_cast<std::uint32_t>(tree_->cells.size()));
  tree_->model_size = tree_->branches.front().box.diagonal();
}

NearestOnModel::~NearestOnModel() = default;

NearestPlace NearestOnModel::at(Vec3 point) const {
  nearest_detail::Looked looked;
  for (std::uint32_t i = 0; i < tree_->trimmed.size(); ++i) {
    if (tree_->trimmed[i]) tree_->trimmed[i]->nearest(point, i, looked.best);
  }
  if (!tree_->branches.empty()) {
    tree_->search(0, point, looked);
    tree_->decide(point, looked);
  }
  const nearest_detail::Found& found = looked.best;
  NearestPlace out;
  if (!std::isfinite(found.square)) return out;
  out.patch = found.patch;
  out.u = found.u;
  out.v = found.v;
  const SurfaceJet jet = evaluate(*tree_->patches[found.patch], found.u, found.v);
  out.point = jet.point;
  const Vec3 away = point - jet.point;
  out.distance = norm(away);
  const Vec3 normal = curvature(jet).normal;
  const double along = dot(away, normal);
  out.off = along < 0.0 ? -out.distance : out.distance;
  const double rounding = nearest_detail::kRounding *
                          std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)});
  out.beside = norm(normal) > 0.0 &&
               norm(cross(away, normal)) > nearest_detail::kAlongNormal * out.distance + rounding;
  return out;
}

}  // namespace obvid
