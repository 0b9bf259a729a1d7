// SPDX-License-Identifier: Apache-2.0
// A correction of few control points along, found by a convex program: docs/methods/skin.md.
#include "fair_across.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "across_lines.h"
#include "banded_program.h"
#include "obvid/core/internal/parallel.h"
#include "obvid/numeric/internal/halving.h"
#include "obvid/surface_builders/internal/lighten.h"
#include "ripple_meter.h"
#include "skin_breaks.h"

namespace obvid {
namespace {

/// Control points along of the correction, how often normals, signs and runs are taken anew, at how
/// many places of a section its run is asked for, and the weight of that. Run that is lost between
/// the places costs the section a share of its whole correction. The second, for what the first
/// leaves, has more freedom and asks less for runs; it takes twice the time.
struct Along {
  std::size_t points, rounds, run_places;
  double soft_runs;
  bool narrows;  ///< less room for sections that rows of runs do not help
};
constexpr std::array<Along, 2> kAlong = {Along{16, 2, 1000, 1e4, true},
                                         Along{24, 2, 300, 1e3, false}};
/// Waves beyond the forced ones, of those: few enough to end, and not to try the second.
constexpr double kFew = 0.01, kFewForMore = 0.08;
/// Of the lines: shallow waves that are worth moving sections for, where no high ones are.
constexpr double kMany = 0.1;
/// Between the tolerances that are tried: half a decade; and the least of them, of the largest.
constexpr double kToleranceStep = 3.1622776601683795, kLeastTolerance = 1e-3;
/// Half widths of the boxes: normal, along, across. Their corners lie in the ball of 1.
constexpr std::array<double, 3> kBox = {0.98, 0.1, 0.1}, kEvenBox = {0.55, 0.55, 0.55};
/// The string keeps away from the bounds by what smoothness needs.
constexpr double kStringShare = 0.87;
/// Of a section's length: what is left of its shape.
constexpr double kMostOfLength = 0.01;
/// Of the section's largest curvature: what may be lost against its run.
constexpr double kMostAgainstRun = 0.9e-3;
/// Of that curvature: what turns back by less has not turned.
constexpr double kNoTurn = 1e-4;
/// Of that: a run that lost more gets a row of its own in the next round, which asks for this.
constexpr double kRowShare = 0.5;
/// Of the section's largest curvature: a fall that rows of first order are no guide for; and the
/// share of its room that a section keeps in the round after that at least.
constexpr double kNoGuide = 0.1, kLeastShare = 0.2;
/// Knots beside a smooth border that stays, where the correction rises as the cube of the distance:
/// each half as far from it as the one before.
constexpr std::size_t kKnotsBesideSeam = 2;
constexpr std::size_t kLinesOfNarrowSpan = 2;
/// Of a box: where nothing may move, until it is set to 0; and half widths are this at least.
constexpr double kHeld = 1e-3, kLeastHalf = 1e-9;
constexpr double kSmoothAlong = 1e-2;
constexpr double kSoft = 1e3;
/// Lines of the program at least.
constexpr std::size_t kLeastLines = 40, kLinesPerSpan = 3;
/// In the few knots of a light skin, which are as few as those of the correction or fewer: changes
/// between the lines cost nothing, so there are more of them.
constexpr std::size_t kLeastLinesOfLight = 120;
/// Weights of lost runs there, one solution each: first runs count, and where more is beyond the
/// forced changes than `kFewOfLight` of them, hardly.
constexpr std::array<double, 2> kLightRuns = {30.0, 1.0};
constexpr std::size_t kLightRunPlaces = 1000;
constexpr double kFewOfLight = 0.05;
/// Of the forced changes: where more is left beyond them it is not for want of knots.
constexpr double kFewForKnots = 0.15;
/// Shares of the light tolerance that knots are chosen by: more knots where fewer are too stiff.
constexpr std::array<double, 2> kLightShares = {1.0, 1.0 / 3.0};
/// Multiplications of one factorisation: more take longer than the fairing of the exact skin.
constexpr double kMostLightWork = 1e9;
constexpr std::size_t kMostMeterPlaces = 32000;
constexpr double kMovedRounding = 64.0 * std::numeric_limits<double>::epsilon();

/// Coefficients of one derivative along: for points with three coordinates side by side.
void add_basis(const BasisValues& basis, std::size_t derivative, Vec3 factor,
               std::size_t first_column, std::vector<double>& row) {
  for (std::size_t i = 0; i <= kSkinDegree; ++i) {
    const double share = basis.value[derivative][i];
    double* at = row.data() + 3 * (basis.first + i) - first_column;
    at[0] += share * factor.x;
    at[1] += share * factor.y;
    at[2] += share * factor.z;
  }
}

/// Places spread half by the parameter, half by the breaks: these stand close where sections are
/// bent, and so do the lines that are counted.
class Density {
 public:
  explicit Density(const std::vector<double>& breaks) : breaks_(breaks) {}
  /// From 0 to 1.
  [[nodiscard]] double at(double part) const {
    double low = breaks_.front(), high = breaks_.back();
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2.0;
      (share(middle) < part ? low : high) = middle;
    }
    return high;
  }

 private:
  [[nodiscard]] double share(double u) const {
    const auto above = std::upper_bound(breaks_.begin() + 1, breaks_.end() - 1, u);
    const double from = *(above - 1), to = *above;
    const double number =
        static_cast<double>(above - 1 - breaks_.begin()) + (u - from) / (to - from);
    return 0.5 * number / static_cast<double>(breaks_.size() - 1) +
           0.5 * (u - breaks_.front()) / (breaks_.back() - breaks_.front());
  }
  const std::vector<double>& breaks_;
};

/// The knots of the correction along: simple, at breaks of the surface.
std::vector<double> even_knots(const std::vector<double>& breaks, std::size_t count) {
  std::vector<double> knots(kSkinDegree + 1, breaks.front());
  const std::size_t inner = count > kSkinDegree + 1 ? count - kSkinDegree - 1 : 0;
  if (inner + 2 >= breaks.size()) {
    knots.insert(knots.end(), breaks.begin() + 1, breaks.end() - 1);
    knots.insert(knots.end(), kSkinDegree + 1, breaks.back());
    return knots;
  }
  const Density density(breaks);
  for (std::size_t k = 1; k <= inner; ++k) {
    const double at = density.at(static_cast<double>(k) / static_cast<double>(inner + 1));
    const auto above = std::lower_bound(breaks.begin() + 1, breaks.end() - 1, at);
    const bool before = above != breaks.begin() + 1 && at - *(above - 1) < *above - at;
    const double chosen = before ? *(above - 1) : *above;
    if (chosen > knots.back() && chosen < breaks.back()) knots.push_back(chosen);
  }
  knots.insert(knots.end(), kSkinDegree + 1, breaks.back());
  return knots;
}

/// More knots, at breaks, beside borders that stay with their derivatives.
std::vector<double> with_knots_beside_seams(std::vector<double> knots,
                                            const std::vector<double>& breaks,
                                            const FairAcross& how, std::size_t count) {
  const std::vector<double> even = distinct(knots);
  for (const bool last : {false, true}) {
    const std::size_t side = last ? 1 : 0;
    if (!how.fixed[side] || !how.smooth[side]) continue;
    const double end = last ? even.back() : even.front();
    double step = last ? *(even.end() - 2) - end : even[1] - end;
    for (std::size_t k = 0; k < count; ++k) {
      step /= 2.0;
      const auto above = std::lower_bound(breaks.begin() + 1, breaks.end() - 1, end + step);
      const bool before =
          above != breaks.begin() + 1 && end + step - *(above - 1) < *above - (end + step);
      const double chosen = before ? *(above - 1) : *above;
      const auto at = std::lower_bound(knots.begin(), knots.end(), chosen);
      if (chosen < breaks.back() && *at != chosen) knots.insert(at, chosen);
    }
  }
  return knots;
}

/// A stretch of one section where curvature falls against the run of the contour.
struct RunFall {
  double from = 0.0, to = 0.0;  ///< parameters: the extreme before, the deepest place behind it
  int direction = 0;            ///< of the run
  double by = 0.0;              ///< units of curvature: how deep, or what may be left
};

/// The deepest fall of each run, of those deeper than `least`.
std::vector<RunFall> falls_of(const std::vector<double>& wanted, const std::vector<double>& found,
                              const std::vector<double>& at, double least) {
  std::vector<RunFall> out;
  RunFall worst;
  int direction = 0;
  std::size_t extreme = 0;
  const auto finish = [&] {
    if (worst.by > least) out.push_back(worst);
    worst = {};
  };
  for (std::size_t i = 1; i < wanted.size(); ++i) {
    const double change = wanted[i] - wanted[i - 1];
    const int now = change > 0.0 ? 1 : change < 0.0 ? -1 : direction;
    if (now != direction) {
      finish();
      extreme = i - 1;
      direction = now;
    }
    const double fall = direction * (found[extreme] - found[i]);
    if (fall < 0.0) extreme = i;
    if (direction != 0 && fall > worst.by) worst = {at[extreme], at[i], direction, fall};
  }
  finish();
  return out;
}

/// Runs that the curvature of a section keeps to, and by how much it may fall against them, of the
/// largest curvature there.
struct RunGuide {
  std::vector<double> run;
  double allowed = 0.0;
};

/// Where curvature along one section is looked at: whose runs it keeps to (the contour's, and the
/// given surface's own where that has lost those), and what it is made of.
struct RunPlaces {
  std::vector<RunGuide> guides;
  std::vector<Vec2> d1, d2;      ///< of the given surface, in the plane of the section
  std::vector<double> rounding;  ///< of its curvature
};

Vec2 in_plane(const Frame& frame, Vec3 v) { return {dot(v, frame.x), dot(v, frame.y)}; }

double ripple_of(const std::vector<double>& run, const std::vector<double>& found,
                 const std::vector<double>& rounding) {
  RippleMeter meter;
  for (std::size_t i = 0; i < run.size(); ++i) meter.add(run[i], found[i], rounding[i]);
  return meter.ripple();
}

double curvature_of(Vec2 d1, Vec2 d2) {
  const double speed = norm(d1);
  return speed > 0.0 ? cross(d1, d2) / (speed * speed * speed) : 0.0;
}

/// A surface with as many knots along as both have.
NurbsSurface with_knots_of(const NurbsSurface& surface, const NurbsSurface& other) {
  std::vector<double> missing;
  std::set_difference(other.knots_u.begin(), other.knots_u.end(), surface.knots_u.begin(),
                      surface.knots_u.end(), std::back_inserter(missing));
  return with_knots_u(surface, missing);
}

/// How far a section may move: one so short that the tolerance would be all of it moves less, a
/// point stays.
double most_of(const SectionCurve& section, double tolerance) {
  if (section.is_point()) return 0.0;
  return std::min(tolerance, kMostOfLength * (section.length_at(1.0).s - section.length_at(0.0).s));
}

/// What two surfaces differ by along one section: pieces between the knots of both, as Bezier
/// curves.
class Difference {
 public:
  Difference(const NurbsSurface& a, const NurbsSurface& b, double v) {
    const SpaceCurve one = isocurve_at_v(a, v), other = isocurve_at_v(b, v);
    std::vector<double> all = one.knots;
    all.insert(all.end(), other.knots.begin(), other.knots.end());
    std::sort(all.begin(), all.end());
    breaks_ = distinct(std::move(all));
    const SpaceCurve p = in_pieces(one), q = in_pieces(other);
    for (std::size_t i = 0; i < p.points.size(); ++i) points_.push_back(p.points[i] - q.points[i]);
  }
  /// Bound of the components in some directions over a part of the parameters.
  [[nodiscard]] std::array<double, 3> most(double from, double to,
                                           const std::array<Vec3, 3>& directions) const {
    std::array<double, 3> out{};
    each(from, to, [&](Vec3 p) {
      for (std::size_t c = 0; c < 3; ++c)
        out[c] = std::max(out[c], std::abs(dot(p, directions[c])));
    });
    return out;
  }
  [[nodiscard]] double longest() const {
    double out = 0.0;
    for (const Vec3& p : points_) out = std::max(out, norm(p));
    return out;
  }

 private:
  [[nodiscard]] SpaceCurve in_pieces(const SpaceCurve& curve) const {
    std::vector<double> missing;
    for (std::size_t i = 1; i + 1 < breaks_.size(); ++i) {
      const auto has = std::equal_range(curve.knots.begin(), curve.knots.end(), breaks_[i]);
      missing.insert(missing.end(),
                     static_cast<std::size_t>(curve.degree - (has.second - has.first)), breaks_[i]);
    }
    return with_knots(curve, missing);
  }
  template <class Use>
  void each(double from, double to, const Use& use) const {
    for (std::size_t s = 0; s + 1 < breaks_.size(); ++s) {
      if (breaks_[s + 1] <= from || breaks_[s] >= to) continue;
      for (std::size_t k = 0; k <= kSkinDegree; ++k) use(points_[s * kSkinDegree + k]);
    }
  }
  std::vector<double> breaks_;
  std::vector<Vec3> points_;
};

class Correction {
 public:
  /// `knots`: along; and `beside` more at each border that stays with its derivatives.
  Correction(const SkinStretch& stretch, const NurbsSurface& given, const FairAcross& wanted,
             const Along& along, const std::vector<double>& knots, std::size_t beside)
      : stretch_(stretch),
        along_(along),
        given_(given),
        how_(wanted),
        light_(&given != &stretch.surface),
        whole_(distinct(knots)),
        knots_(with_knots_beside_seams(knots, stretch.breaks, wanted, beside)),
        count_(knots_.size() - kSkinDegree - 1),
        degree_(static_cast<std::size_t>(given_.degree_v)),
        at_sections_(bases_across(given_, wanted.v, 2)),
        moved_(wanted.v.size() * count_),
        box_(wanted.v.size(), 1.0),
        current_(given_),
        wished_(given_),
        falls_(wanted.v.size()) {
    limit_sections();
    place_lines();
    frame_boxes();
    hold_borders();
    if (light_) narrow_boxes();
  }

  [[nodiscard]] Result<void> improve(const std::vector<RunPlaces>& runs,
                                     const std::vector<double>& meter_at, const RunContext& run,
                                     double from, double to) {
    BandedProgram program{how_.v.size(), 3 * count_, {}, light_};
    add_aim(program);
    add_signs(program);
    add_sections(program);
    const auto solution = solved(program, run, from, to);
    OBVID_TRY(solution);
    take(*solution);
    rebuild();
    wished_ = current_;
    if (light_) return {};
    OBVID_TRY(keep_runs(runs, meter_at, run));
    rebuild();
    return {};
  }

  [[nodiscard]] const NurbsSurface& surface() const { return current_; }

  /// What is added to the given surface, on its own knots along.
  [[nodiscard]] NurbsSurface alone() const {
    std::vector<Vec3> rows = moved_;
    how_.across.matrix.solve_rows(rows, count_);
    for (Vec3& p : rows) p = how_.tolerance * p;
    return {kSkinDegree, given_.degree_v, knots_, given_.knots_v, std::move(rows), {}};
  }

  /// Bound for each section, units.
  [[nodiscard]] std::vector<double> moved() const {
    double largest = 0.0;
    for (const Vec3& p : given_.points) {
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    std::vector<double> out;
    for (std::size_t k = 0; k < how_.v.size(); ++k) {
      if (light_) {
        out.push_back(Difference(stretch_.surface, current_, how_.v[k]).longest() +
                      kMovedRounding * largest);
        continue;
      }
      double most = 0.0;
      for (std::size_t i = 0; i < count_; ++i) most = std::max(most, norm(moved_[k * count_ + i]));
      out.push_back(most > 0.0 ? most * how_.tolerance + kMovedRounding * largest : 0.0);
    }
    return out;
  }

 private:
  [[nodiscard]] std::array<double, 4> share(const BasisValues& basis, std::size_t derivative,
                                            double factor) const {
    std::array<double, 4> out{};
    for (std::size_t j = 0; j <= degree_; ++j) out[j] = factor * basis.value[derivative][j];
    return out;
  }
  [[nodiscard]] FormGroup group(const BasisValues& basis, std::size_t derivative,
                                double factor) const {
    return {basis.first, share(basis, derivative, factor), {}, {}, {}};
  }

  void limit_sections() {
    for (std::size_t k = 0; k < box_.size(); ++k) {
      const SectionCurve& section = stretch_.sections[k];
      if (!section.is_point()) box_[k] = most_of(section, how_.tolerance) / how_.tolerance;
      still_.push_back(section.is_point() || !(box_[k] > kHeld));
    }
  }

  void place_lines() {
    const std::vector<double> breaks = distinct(knots_);
    const std::size_t spans = breaks.size() - 1;
    const Density density(stretch_.breaks);
    const std::size_t least = light_ ? kLeastLinesOfLight : kLeastLines;
    const std::size_t lines = std::max(least, kLinesPerSpan * spans);
    for (std::size_t l = 0; l < lines; ++l) {
      line_at_.push_back(density.at((static_cast<double>(l) + 0.5) / static_cast<double>(lines)));
    }
    if (spans + 1 > whole_.size()) add_lines_of_narrow_spans(breaks);
    for (const double u : line_at_) {
      line_basis_.push_back(basis_at(kSkinDegree, knots_, u, 0));
      lines_.emplace_back(given_, u);
    }
    const std::vector<double> across = distinct(given_.knots_v);
    std::vector<double> all = across;
    for (std::size_t j = 0; j + 1 < across.size(); ++j) {
      middle_.push_back((across[j] + across[j + 1]) / 2.0);
      step_.push_back(across[j + 1] - across[j]);
    }
    all.insert(all.end(), middle_.begin(), middle_.end());
    all.insert(all.end(), how_.v.begin(), how_.v.end());
    std::sort(all.begin(), all.end());
    place_ = distinct(std::move(all));
    at_places_ = bases_across(given_, place_, 2);
    at_middle_ = bases_across(given_, middle_, 3);
    along_middle_.clear();
    for (std::size_t s = 0; s < spans; ++s) {
      along_middle_.push_back(basis_at(kSkinDegree, knots_, (breaks[s] + breaks[s + 1]) / 2.0, 3));
      along_step_.push_back(breaks[s + 1] - breaks[s]);
      along_weight_.push_back(std::sqrt(along_step_.back()));
    }
    // a span that is narrow for a seam counts as much as the whole that it was cut from
    for (std::size_t s = 0; s < spans; ++s) {
      const auto above =
          std::upper_bound(whole_.begin() + 1, whole_.end() - 1, (breaks[s] + breaks[s + 1]) / 2.0);
      const double share = along_step_[s] / (*above - *(above - 1));
      along_weight_[s] *= share * share * std::sqrt(share);
    }
  }

  /// No span without lines: nothing would hold the control points there.
  void add_lines_of_narrow_spans(const std::vector<double>& breaks) {
    std::vector<double> more;
    for (std::size_t s = 0; s + 1 < breaks.size(); ++s) {
      const auto has = std::upper_bound(line_at_.begin(), line_at_.end(), breaks[s + 1]) -
                       std::lower_bound(line_at_.begin(), line_at_.end(), breaks[s]);
      if (static_cast<std::size_t>(has) >= kLinesOfNarrowSpan) continue;
      for (std::size_t k = 0; k < kLinesOfNarrowSpan; ++k) {
        const double part = (static_cast<double>(k) + 0.5) / kLinesOfNarrowSpan;
        more.push_back(breaks[s] + part * (breaks[s + 1] - breaks[s]));
      }
    }
    line_at_.insert(line_at_.end(), more.begin(), more.end());
    std::sort(line_at_.begin(), line_at_.end());
  }

  struct Axes {
    std::array<Vec3, 3> direction;
    std::array<double, 3> half;
  };

  /// A box in the ball of 1 for each control point along of each section: along the normal, the
  /// section and the third direction.
  void frame_boxes() {
    for (std::size_t k = 0; k < how_.v.size(); ++k) {
      for (std::size_t i = 0; i < count_; ++i) {
        const double u =
            std::accumulate(knots_.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                            knots_.begin() + static_cast<std::ptrdiff_t>(i) + 1 + kSkinDegree,
                            0.0) /
            kSkinDegree;
        const SurfaceJet jet = evaluate(given_, u, how_.v[k]);
        const Vec3 normal = unit(cross(jet.du, jet.dv)), along = unit(jet.du);
        Axes axes{{normal, along, cross(normal, along)}, kBox};
        if (!(norm(normal) > 0.5) || !(norm(along) > 0.5)) {
          axes.direction = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
          axes.half = kEvenBox;
        }
        axes_.push_back(axes);
      }
    }
  }

  /// A surface of few knots is not quite where that of the stretch is: by as much boxes are less.
  void narrow_boxes() {
    for (std::size_t k = 0; k < how_.v.size(); ++k) {
      const Difference off(stretch_.surface, given_, how_.v[k]);
      for (std::size_t i = 0; i < count_; ++i) {
        Axes& axes = axes_[k * count_ + i];
        const std::array<double, 3> most =
            off.most(knots_[i], knots_[i + kSkinDegree + 1], axes.direction);
        std::array<double, 3> used{};
        for (std::size_t c = 0; c < 3; ++c) used[c] = most[c] / (how_.tolerance * box_[k]);
        constexpr double kRoundings = 1e-9;  // of the square of the tolerance: corners stay inside
        double rest = 1.0 - kRoundings;
        for (std::size_t c = 1; c < 3; ++c) {
          const double with = used[c] + axes.half[c];
          rest -= with * with;
        }
        if (axes.half == kEvenBox) {
          for (std::size_t c = 0; c < 3; ++c) axes.half[c] -= used[c];
        } else {
          axes.half[0] = rest > 0.0 ? std::sqrt(rest) - used[0] : 0.0;
        }
        for (double& half : axes.half) half = std::max(half, kHeld);
      }
    }
  }

  /// Borders that others share stay, smooth ones with two derivatives; borders in a coordinate
  /// plane stay in it, so that mirrored halves still meet.
  void hold_borders() {
    held_.assign(axes_.size(), {});
    double size = size_of(given_);
    for (std::size_t side = 0; side < 2; ++side) {
      const std::size_t rows = !how_.fixed[side] ? 0 : how_.smooth[side] ? 3 : 1;
      for (std::size_t k = 0; k < how_.v.size(); ++k) {
        for (std::size_t r = 0; r < std::min(rows, count_); ++r) {
          held_[k * count_ + (side == 0 ? r : count_ - 1 - r)] = {true, true, true};
        }
      }
      if (rows > 0) continue;
      const std::size_t column = side == 0 ? 0 : given_.count_u() - 1;
      std::array<Range, 3> extent;
      extent.fill(
          {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()});
      for (std::size_t j = 0; j < given_.count_v(); ++j) {
        const Vec3 p = given_.points[j * given_.count_u() + column];
        const std::array<double, 3> x = {p.x, p.y, p.z};
        for (std::size_t c = 0; c < 3; ++c) {
          extent[c] = {std::min(extent[c].from, x[c]), std::max(extent[c].to, x[c])};
        }
      }
      for (std::size_t c = 0; c < 3; ++c) {
        constexpr double kPlane = 1e-12;  // of the size: rounding
        if (extent[c].to - extent[c].from > kPlane * size) continue;
        for (std::size_t k = 0; k < how_.v.size(); ++k) {
          const std::size_t at = k * count_ + (side == 0 ? 0 : count_ - 1);
          held_[at][c] = true;
          axes_[at].direction = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
          axes_[at].half = kEvenBox;
        }
      }
    }
    for (std::size_t k = 0; k < how_.v.size(); ++k) {
      if (!still_[k]) continue;
      for (std::size_t i = 0; i < count_; ++i) held_[k * count_ + i] = {true, true, true};
    }
  }

  /// Smooth across: third derivatives of the sum by v, local; and of the correction by u.
  void add_aim(BandedProgram& program) const {
    std::vector<FormGroup> across, along;
    double square = 0.0;
    for (std::size_t m = 0; m < middle_.size(); ++m) {
      const double h3 = step_[m] * step_[m] * step_[m];
      FormGroup g = group(at_middle_[m], 3, h3);
      double shares = 0.0;
      for (const double s : g.share) shares += s * s;
      for (std::size_t l = 0; l < lines_.size(); ++l) {
        const Vec3 third = (-h3 / how_.tolerance) * lines_[l].derivative(at_middle_[m], 3);
        const std::array<double, 3> goal = {third.x, third.y, third.z};
        for (std::size_t c = 0; c < 3; ++c) {
          FormGroup::Form f = along_form(line_basis_[l], 0, c);
          f.wanted = goal[c];
          for (const double a : f.coefficient) square += shares * a * a;
          g.near.push_back(std::move(f));
        }
      }
      across.push_back(std::move(g));
    }
    const auto unknowns = static_cast<double>(how_.v.size() * 3 * count_);
    append(program, std::move(across), square > 0.0 ? unknowns / square : 0.0);
    square = 0.0;
    for (const BasisValues& basis : at_sections_) {
      FormGroup g = group(basis, 0, 1.0);
      double shares = 0.0;
      for (const double s : g.share) shares += s * s;
      for (std::size_t s = 0; s < along_middle_.size(); ++s) {
        for (std::size_t c = 0; c < 3; ++c) {
          FormGroup::Form f = along_form(along_middle_[s], 3, c);
          for (double& a : f.coefficient) a *= along_weight_[s];
          for (const double a : f.coefficient) square += shares * a * a;
          g.near.push_back(std::move(f));
        }
      }
      along.push_back(std::move(g));
    }
    append(program, std::move(along), kSmoothAlong * unknowns / square);
  }
  static void append(BandedProgram& program, std::vector<FormGroup> groups, double weight) {
    for (FormGroup& g : groups) {
      for (FormGroup::Form& f : g.near) f.weight = weight;
      program.groups.push_back(std::move(g));
    }
  }
  static FormGroup::Form along_form(const BasisValues& basis, std::size_t derivative,
                                    std::size_t c) {
    FormGroup::Form f;
    f.first_column = 3 * basis.first + c;
    f.coefficient.assign(3 * kSkinDegree + 1, 0.0);
    for (std::size_t i = 0; i <= kSkinDegree; ++i) {
      f.coefficient[3 * i] = basis.value[derivative][i];
    }
    return f;
  }

  /// Bending of the sign that the string has, everywhere across.
  void add_signs(BandedProgram& program) const {
    const std::size_t places = place_.size();
    std::vector<FormGroup> groups;
    for (std::size_t q = 0; q < places; ++q)
      groups.push_back(group(at_places_[q], 2, weight_of(q)));
    const AcrossPlaces at = places_across(given_, how_.v);
    std::vector<double> string;  // sections that may move by less hold it by less
    for (const double box : box_) string.push_back(kStringShare * box * how_.tolerance);
    for (std::size_t l = 0; l < lines_.size(); ++l) {
      const Isoline now(wished_, line_at_[l]);
      std::vector<Vec3> normal;
      std::vector<double> bend;
      for (const BasisValues& basis : at_places_) {
        const Isoline::Place here = now.at(basis);
        normal.push_back(unit(cross(here.du, here.dv)));
        bend.push_back(dot(normal.back(), here.dvv));
      }
      if (light_) {
        for (std::size_t k = 0; k < box_.size(); ++k) string[k] = kStringShare * reach_at(l, k);
      }
      const std::vector<int> sign = signs(developed(lines_[l], at, string), bend);
      for (std::size_t q = 0; q < places; ++q) {
        if (sign[q] == 0 || !(norm(normal[q]) > 0.5)) continue;
        const Vec3 n = static_cast<double>(sign[q]) * normal[q];
        FormGroup::Form f;
        f.first_column = 3 * line_basis_[l].first;
        f.coefficient.assign(3 * (kSkinDegree + 1), 0.0);
        add_basis(line_basis_[l], 0, n, f.first_column, f.coefficient);
        f.wanted = -weight_of(q) / how_.tolerance * dot(n, lines_[l].derivative(at_places_[q], 2));
        f.weight = kSoft;
        groups[q].at_least.push_back(std::move(f));
      }
    }
    for (FormGroup& g : groups) program.groups.push_back(std::move(g));
  }
  /// How far the boxes let a section move along the normal at a line, units.
  [[nodiscard]] double reach_at(std::size_t l, std::size_t k) const {
    const BasisValues& basis = line_basis_[l];
    double sum = 0.0;
    for (std::size_t i = 0; i <= kSkinDegree; ++i) {
      sum += basis.value[0][i] * axes_[k * count_ + basis.first + i].half[0];
    }
    return std::max(sum * box_[k], kLeastHalf) * how_.tolerance;
  }
  /// Bending by this is about the height of the bulge between two places.
  [[nodiscard]] double weight_of(std::size_t q) const {
    const std::size_t places = place_.size();
    const double gap = (place_[std::min(q + 1, places - 1)] - place_[q > 0 ? q - 1 : 0]) /
                       (q > 0 && q + 1 < places ? 2.0 : 1.0);
    return gap * gap / 2.0;
  }

  /// Wanted sign at each place of a line, 0 where it is free: that of the contacts of the string;
  /// between contacts of unlike kind it changes where the surface is bent wrongly least by that.
  [[nodiscard]] std::vector<int> signs(const DevelopedLine& line,
                                       const std::vector<double>& bend) const {
    const std::vector<StringContact> contacts = taut_string(line.tube);
    std::vector<int> out(place_.size(), 0);
    if (contacts.empty()) {
      double sum = 0.0;
      for (const double b : bend) sum += b;
      std::fill(out.begin(), out.end(), sum >= 0.0 ? 1 : -1);
      return out;
    }
    std::size_t from = 0;
    int sign = contacts.front().bend;
    const auto v_of = [&](const StringContact& c) { return how_.v[line.section[c.node]]; };
    for (std::size_t k = 0; k + 1 < contacts.size(); ++k) {
      if (contacts[k + 1].bend == contacts[k].bend) continue;
      // behind the change before, which may lie at the contact itself
      const auto first = std::max(
          from,
          static_cast<std::size_t>(
              std::lower_bound(place_.begin(), place_.end(), v_of(contacts[k])) - place_.begin()));
      const auto last = static_cast<std::size_t>(
          std::lower_bound(place_.begin(), place_.end(), v_of(contacts[k + 1])) - place_.begin());
      std::size_t best = first;
      double least = std::numeric_limits<double>::infinity(), behind = 0.0, ahead = 0.0;
      for (std::size_t q = first; q <= last; ++q) {
        ahead += std::max(0.0, sign * bend[q]) * weight_of(q);
      }
      for (std::size_t q = first; q <= last; ++q) {
        ahead -= std::max(0.0, sign * bend[q]) * weight_of(q);
        if (behind + ahead < least) {
          least = behind + ahead;
          best = q;
        }
        behind += std::max(0.0, -sign * bend[q]) * weight_of(q);
      }
      std::fill(out.begin() + static_cast<std::ptrdiff_t>(from),
                out.begin() + static_cast<std::ptrdiff_t>(best), sign);
      out[best] = 0;
      from = best + 1;
      sign = -sign;
    }
    std::fill(out.begin() + static_cast<std::ptrdiff_t>(from), out.end(), sign);
    return out;
  }

  /// Boxes of control points along, and runs of curvature.
  void add_sections(BandedProgram& program) const {
    std::vector<double> at;
    const std::vector<double>& breaks = stretch_.breaks;  // where the contours have joints, too
    const std::size_t spans = breaks.size() - 1;
    const std::size_t each =
        std::max<std::size_t>(1, std::min<std::size_t>(6, along_.run_places / spans));
    const std::size_t stride = std::max<std::size_t>(1, spans * each / along_.run_places);
    for (std::size_t s = 0; s < spans; ++s) {
      for (std::size_t k = 0; k < each; ++k) {
        if ((s * each + k) % stride != 0) continue;
        const double part = static_cast<double>(k) / static_cast<double>(each);
        at.push_back(breaks[s] + part * (breaks[s + 1] - breaks[s]));
      }
    }
    at.push_back(breaks.back());
    std::vector<BasisValues> basis;
    for (const double u : at) basis.push_back(basis_at(kSkinDegree, knots_, u, 2));
    for (std::size_t k = 0; k < how_.v.size(); ++k) {
      FormGroup g = group(at_sections_[k], 0, 1.0);
      for (std::size_t i = 0; i < count_; ++i) {
        const Axes& axes = axes_[k * count_ + i];
        for (std::size_t c = 0; c < 3; ++c) {
          const Vec3 d = axes.direction[c];
          const double half = held(k * count_ + i, d) ? kHeld * box_[k] : box_[k] * axes.half[c];
          g.box.push_back({3 * i, {d.x, d.y, d.z}, std::max(half, kLeastHalf), 0.0});
        }
      }
      if (!still_[k]) add_runs(k, at, basis, g);
      program.groups.push_back(std::move(g));
    }
  }
  /// Whether a direction of a box belongs to what is held there.
  [[nodiscard]] bool held(std::size_t at, Vec3 d) const {
    const std::array<bool, 3>& h = held_[at];
    if (h[0] && h[1] && h[2]) return true;
    return (h[0] && d.x == 1.0) || (h[1] && d.y == 1.0) || (h[2] && d.z == 1.0);
  }

  /// Curvature of a section as a linear form of the correction, true to first order at what the
  /// round before wished for.
  struct RunForm {
    double kappa;   ///< of the given curve, by the form
    Vec3 by1, by2;  ///< derivatives by those of the curve
  };
  struct RunCurves {
    SpaceCurve given, now;
    const Frame& frame;
    [[nodiscard]] RunForm at(double u) const {
      const SpaceJet a = evaluate(now, u), b = evaluate(given, u);
      const Vec2 d1 = in_plane(frame, a.d1), d2 = in_plane(frame, a.d2);
      const double speed = norm(d1), kappa = curvature_of(d1, d2);
      if (!(speed > 0.0)) return {0.0, {}, {}};
      const double cube = speed * speed * speed;
      const Vec2 p = (1.0 / cube) * Vec2{d2.y, -d2.x} - (3.0 * kappa / (speed * speed)) * d1;
      const Vec2 r = (1.0 / cube) * Vec2{-d1.y, d1.x};
      const Vec3 by1 = p.x * frame.x + p.y * frame.y, by2 = r.x * frame.x + r.y * frame.y;
      return {kappa - dot(by1, a.d1 - b.d1) - dot(by2, a.d2 - b.d2), by1, by2};
    }
  };

  /// Curvature at a place behind another is not to be less by more than `slack`, in the direction
  /// of the run.
  void add_run(const RunForm& from, const BasisValues& basis_from, const RunForm& to,
               const BasisValues& basis_to, int direction, double slack, FormGroup& g) const {
    FormGroup::Form f;
    f.first_column = 3 * basis_from.first;
    f.coefficient.assign(3 * (basis_to.first - basis_from.first + kSkinDegree + 1), 0.0);
    const double sign = direction;
    add_basis(basis_to, 1, sign * to.by1, f.first_column, f.coefficient);
    add_basis(basis_to, 2, sign * to.by2, f.first_column, f.coefficient);
    add_basis(basis_from, 1, -sign * from.by1, f.first_column, f.coefficient);
    add_basis(basis_from, 2, -sign * from.by2, f.first_column, f.coefficient);
    double square = 0.0;
    for (const double x : f.coefficient) square += x * x;
    const double length = std::sqrt(square);
    if (!(length > 0.0)) return;
    for (double& x : f.coefficient) x /= length;
    f.wanted = -(sign * (to.kappa - from.kappa) + slack) / (length * how_.tolerance);
    f.weight = along_.soft_runs;
    g.at_least.push_back(std::move(f));
  }

  void add_runs(std::size_t k, const std::vector<double>& at, const std::vector<BasisValues>& basis,
                FormGroup& g) const {
    const SectionCurve& section = stretch_.sections[k];
    const RunCurves curves{isocurve_at_v(given_, how_.v[k]), isocurve_at_v(wished_, how_.v[k]),
                           section.frame()};
    std::vector<RunForm> forms;
    std::vector<double> wanted;
    double largest = 0.0;
    for (const double u : at) {
      wanted.push_back(plane_curvature(section.at(u), section.frame()));
      largest = std::max(largest, std::abs(wanted.back()));
      forms.push_back(curves.at(u));
    }
    for (const RunFall& fall : falls_[k]) {
      add_run(curves.at(fall.from), basis_at(kSkinDegree, knots_, fall.from, 2), curves.at(fall.to),
              basis_at(kSkinDegree, knots_, fall.to, 2), fall.direction, fall.by, g);
    }
    std::vector<int> direction(at.size() - 1, 0);
    constexpr double kNoise = 1e-5;  // of the largest curvature: no run, or circular
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
      const double change = wanted[i + 1] - wanted[i];
      if (std::abs(change) > kNoise * largest) direction[i] = change > 0.0 ? 1 : -1;
    }
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
      const bool turns = (i > 0 && direction[i - 1] != direction[i]) ||
                         (i + 2 < at.size() && direction[i + 1] != direction[i]);
      if (direction[i] == 0 || (turns && !light_)) continue;
      add_run(forms[i], basis[i], forms[i + 1], basis[i + 1], direction[i], 0.0, g);
    }
  }

  /// Control points along of each section out of the program's; what is held is exactly 0.
  void take(const std::vector<double>& x) {
    for (std::size_t k = 0; k < how_.v.size(); ++k) {
      const BasisValues& basis = at_sections_[k];
      for (std::size_t i = 0; i < count_; ++i) {
        Vec3 sum;
        for (std::size_t j = 0; j <= degree_; ++j) {
          const double* p = x.data() + ((basis.first + j) * count_ + i) * 3;
          sum = sum + basis.value[0][j] * Vec3{p[0], p[1], p[2]};
        }
        const std::array<bool, 3>& h = held_[k * count_ + i];
        sum = {h[0] ? 0.0 : sum.x, h[1] ? 0.0 : sum.y, h[2] ? 0.0 : sum.z};
        const double length = norm(sum);
        moved_[k * count_ + i] = length > 1.0 ? sum / length : sum;
      }
    }
  }

  /// A section whose curvature goes against its run takes a share of its correction that does not:
  /// none never does. Where it went so the next round has rows.
  [[nodiscard]] Result<void> keep_runs(const std::vector<RunPlaces>& runs,
                                       const std::vector<double>& meter_at, const RunContext& run) {
    std::vector<BasisValues> basis;
    for (const double u : meter_at) basis.push_back(basis_at(kSkinDegree, knots_, u, 2));
    return in_parallel(how_.v.size(), run, [&](std::size_t k) {
      if (still_[k]) return;
      const Frame& frame = stretch_.sections[k].frame();
      std::vector<Vec2> d1, d2;
      for (const BasisValues& b : basis) {
        Vec3 first, second;
        for (std::size_t i = 0; i <= kSkinDegree; ++i) {
          const Vec3 p = moved_[k * count_ + b.first + i];
          first = first + b.value[1][i] * p;
          second = second + b.value[2][i] * p;
        }
        d1.push_back(how_.tolerance * in_plane(frame, first));
        d2.push_back(how_.tolerance * in_plane(frame, second));
      }
      // 1: as much as is allowed
      const auto against = [&](double part) {
        std::vector<double> found;
        for (std::size_t i = 0; i < meter_at.size(); ++i) {
          found.push_back(curvature_of(runs[k].d1[i] + part * d1[i], runs[k].d2[i] + part * d2[i]));
        }
        double worst = 0.0;
        for (const RunGuide& guide : runs[k].guides) {
          worst = std::max(worst, ripple_of(guide.run, found, runs[k].rounding) / guide.allowed);
        }
        return worst;
      };
      const double whole = against(1.0);
      if (whole <= kRowShare) return;
      remember_falls(k, runs[k], d1, d2, meter_at);
      if (whole <= 1.0) return;
      constexpr int kHalvingsOfShare = 10;  // to a thousandth of the correction
      const auto keeps = [&](double part) { return against(part) <= 1.0; };
      const double share = end_of_condition(0.0, 1.0, keeps, kHalvingsOfShare).holds;
      for (std::size_t i = 0; i < count_; ++i) {
        moved_[k * count_ + i] = share * moved_[k * count_ + i];
      }
      // so deep a fall that rows of first order are no guide: less room in the next round
      if (along_.narrows && whole * kMostAgainstRun > kNoGuide)
        box_[k] *= std::max(share, kLeastShare);
    });
  }

  void remember_falls(std::size_t k, const RunPlaces& runs, const std::vector<Vec2>& d1,
                      const std::vector<Vec2>& d2, const std::vector<double>& meter_at) {
    std::vector<double> found;
    for (std::size_t i = 0; i < meter_at.size(); ++i) {
      found.push_back(curvature_of(runs.d1[i] + d1[i], runs.d2[i] + d2[i]));
    }
    for (const RunGuide& guide : runs.guides) {
      double largest = 0.0;
      for (const double kappa : guide.run) largest = std::max(largest, std::abs(kappa));
      const double least = kRowShare * guide.allowed * largest;
      for (RunFall& fall : falls_of(guide.run, found, meter_at, least)) {
        fall.by = least;
        falls_[k].push_back(fall);
      }
    }
  }

  /// The sum on the knots of the given surface, among which those of the correction are.
  void rebuild() { current_ = sum_of(given_, alone()); }

  const SkinStretch& stretch_;
  Along along_;
  const NurbsSurface& given_;
  const FairAcross& how_;
  bool light_;  ///< the given surface is not that of the stretch, but has its few knots
  std::vector<double> whole_, knots_;  ///< breaks without those beside seams; all knots
  std::size_t count_, degree_;
  std::vector<BasisValues> at_sections_;
  std::vector<Vec3> moved_;  ///< [section][control point along], shares of the tolerance
  std::vector<double> box_;
  std::vector<bool> still_;
  NurbsSurface current_, wished_;  ///< as it is; before sections took shares for their runs
  std::vector<std::vector<RunFall>> falls_;
  std::vector<double> line_at_, place_, middle_, step_, along_step_, along_weight_;
  std::vector<BasisValues> line_basis_, at_places_, at_middle_, along_middle_;
  std::vector<Isoline> lines_;
  std::vector<Axes> axes_;
  std::vector<std::array<bool, 3>> held_;
};

std::vector<double> meter_places(const std::vector<double>& breaks) {
  const std::size_t spans = breaks.size() - 1;
  const auto each = std::clamp<std::size_t>(kMostMeterPlaces / spans, 2, kReportSamplesPerSpan);
  std::vector<double> out;
  for (std::size_t s = 0; s < spans; ++s) {
    out.push_back(breaks[s]);  // where runs end
    for (std::size_t k = 0; k < each; ++k) {
      const double part = (static_cast<double>(k) + 0.5) / static_cast<double>(each);
      out.push_back(breaks[s] + part * (breaks[s + 1] - breaks[s]));
    }
  }
  out.push_back(breaks.back());
  return out;
}

/// Runs of a curvature: as it is where it turns, even between. Where it turns back by no more than
/// `kNoTurn` of the largest the run goes on.
std::vector<double> runs_between_turns(const std::vector<double>& kappa) {
  double largest = 0.0;
  for (const double one : kappa) largest = std::max(largest, std::abs(one));
  const double least = kNoTurn * largest;
  std::vector<std::size_t> turns{0};
  std::size_t low = 0, high = 0;
  int direction = 0;
  for (std::size_t i = 1; i < kappa.size(); ++i) {
    if (kappa[i] > kappa[high]) high = i;
    if (kappa[i] < kappa[low]) low = i;
    const bool falls = direction >= 0 && kappa[high] - kappa[i] > least;
    const bool rises = direction <= 0 && kappa[i] - kappa[low] > least;
    if (!falls && !rises) continue;
    if (direction != 0) turns.push_back(falls ? high : low);
    direction = falls ? -1 : 1;
    low = high = i;
  }
  turns.push_back(kappa.size() - 1);
  std::vector<double> out(kappa.size(), kappa.front());
  for (std::size_t k = 0; k + 1 < turns.size(); ++k) {
    const std::size_t from = turns[k], to = turns[k + 1];
    for (std::size_t i = from + 1; i <= to; ++i) {
      const double part = static_cast<double>(i - from) / static_cast<double>(to - from);
      out[i] = std::lerp(kappa[from], kappa[to], part);
    }
  }
  return out;
}

RunPlaces run_places(const SkinStretch& stretch, std::size_t k, double v,
                     const std::vector<double>& at) {
  RunPlaces out;
  const SectionCurve& section = stretch.sections[k];
  if (section.is_point()) return out;
  const SpaceCurve curve = isocurve_at_v(stretch.surface, v);
  std::vector<double> kappa, own;
  double largest = 0.0;
  for (const double u : at) {
    const Hermite wanted = section.at(u);
    kappa.push_back(plane_curvature(wanted, section.frame()));
    largest = std::max(largest, std::abs(kappa.back()));
    const auto above = std::upper_bound(stretch.breaks.begin() + 1, stretch.breaks.end() - 1, u);
    out.rounding.push_back(curvature_rounding(wanted, *above - *(above - 1), section));
    const SpaceJet jet = evaluate(curve, u);
    out.d1.push_back(in_plane(section.frame(), jet.d1));
    out.d2.push_back(in_plane(section.frame(), jet.d2));
    own.push_back(curvature_of(out.d1.back(), out.d2.back()));
  }
  // straight and circular stretches: rounding is no run, the one before goes on
  constexpr double kRoundingOfRuns = 1e-9;
  std::vector<double> run{kappa.front()};
  for (std::size_t i = 1; i < kappa.size(); ++i) {
    const double change = kappa[i] - kappa[i - 1];
    run.push_back(run.back() + (std::abs(change) > kRoundingOfRuns * largest ? change : 0.0));
  }
  const double lost = ripple_of(run, own, out.rounding);
  out.guides.push_back({std::move(run), std::max(lost, kMostAgainstRun)});
  if (lost > kMostAgainstRun) out.guides.push_back({runs_between_turns(own), kMostAgainstRun});
  return out;
}

/// Waves that need not be: high ones, and shallow ones with them; and how many are forced.
struct Waves {
  std::size_t found = 0, beyond = 0, all = 0, all_beyond = 0, forced = 0, lines = 0;
  [[nodiscard]] bool high_ones_few(double share = kFew) const {
    return static_cast<double>(beyond) <= share * static_cast<double>(forced);
  }
  [[nodiscard]] bool shallow_ones_many() const {
    return static_cast<double>(all_beyond) > kMany * static_cast<double>(lines);
  }
  /// High ones first.
  [[nodiscard]] bool less_than(const Waves& other) const {
    return beyond < other.beyond || (beyond == other.beyond && all_beyond < other.all_beyond);
  }
};

Result<Waves> waves_of(const SkinStretch& stretch, const NurbsSurface& surface,
                       const FairAcross& how, const RunContext& run) {
  AcrossReport report;
  OBVID_TRY(add_across_report(surface, stretch.breaks, how.v, how.forced, how.fine, run, report));
  return Waves{report.found,      report.beyond, report.all,
               report.all_beyond, report.forced, report.isolines};
}

}  // namespace

NurbsSurface sum_of(const NurbsSurface& surface, const NurbsSurface& added) {
  NurbsSurface out = with_knots_of(surface, added);
  const NurbsSurface other = with_knots_of(added, surface);
  for (std::size_t i = 0; i < out.points.size(); ++i)
    out.points[i] = out.points[i] + other.points[i];
  return out;
}

namespace {

/// What levels have in common: where runs are measured, and the runs there.
struct GivenRuns {
  std::vector<double> at;
  std::vector<RunPlaces> runs;
};

Result<GivenRuns> given_runs(const SkinStretch& stretch, const std::vector<double>& v,
                             const RunContext& run) {
  GivenRuns out{meter_places(stretch.breaks), std::vector<RunPlaces>(v.size())};
  OBVID_TRY(in_parallel(
      v.size(), run, [&](std::size_t k) { out.runs[k] = run_places(stretch, k, v[k], out.at); }));
  return out;
}

/// Puts the best of the rounds within one tolerance in the place of the best so far, of those that
/// have no more changes than that has, of high bulges or of all; whether there was any to try.
Result<bool> improve_within(const SkinStretch& stretch, const FairAcross& wanted,
                            const GivenRuns& kept, const RunContext& run, double from, double to,
                            FairedStretch& best) {
  const auto before = waves_of(stretch, best.surface, wanted, run);
  OBVID_TRY(before);
  Waves least = *before;
  constexpr double kParts = 3 * kAlong[0].rounds + kAlong[1].rounds;
  const bool high_ones = !before->high_ones_few();
  const auto goes_on = [&] {
    return high_ones ? !least.high_ones_few() : least.shallow_ones_many();
  };
  double begun = 0.0;  // rounds
  struct Try {
    Along along;
    std::size_t beside;  ///< knots at seams
  };
  const bool seams = (wanted.fixed[0] && wanted.smooth[0]) || (wanted.fixed[1] && wanted.smooth[1]);
  std::vector<Try> tries{{kAlong[0], kKnotsBesideSeam}, {kAlong[1], kKnotsBesideSeam}};
  if (seams) tries.insert(tries.begin() + 1, {{kAlong[0], 1}, {kAlong[0], 0}});
  bool taken = false;
  for (std::size_t n = 0; n < tries.size() && goes_on(); ++n) {
    const Along& along = tries[n].along;
    if (tries[n].beside == 0 && taken) continue;
    const bool for_many = tries[n].beside == 1 || n + 1 == tries.size();
    if (for_many && (!high_ones || least.high_ones_few(kFewForMore))) continue;
    Correction correction(stretch, stretch.surface, wanted, along,
                          even_knots(stretch.breaks, along.points), tries[n].beside);
    for (std::size_t round = 0; round < along.rounds && goes_on(); ++round) {
      const double start = from + (to - from) * begun / kParts;
      begun += 1.0;
      OBVID_TRY(correction.improve(kept.runs, kept.at, run, start, start + (to - from) / kParts));
      const auto left = waves_of(stretch, correction.surface(), wanted, run);
      OBVID_TRY(left);
      // shallow waves are waves, too
      if (left->found > before->found || left->all > before->all || !left->less_than(least)) {
        continue;
      }
      least = *left;
      taken = true;
      best.surface = correction.surface();
      best.correction = correction.alone();
      best.moved = correction.moved();
    }
  }
  return begun > 0.0;
}

/// Tolerances to try: what is wanted, or what any section may move by where that is less; and where
/// that is less or moves nothing, those of the shallowest bulges that count and more by steps, the
/// smallest first.
std::vector<double> levels(const FairAcross& wanted, double reach) {
  const double last = std::min(wanted.tolerance, reach);
  std::vector<double> out{last};
  for (double level = wanted.fine; level < last; level *= kToleranceStep) {
    if (level >= kLeastTolerance * last) out.push_back(level);
  }
  return out;
}

}  // namespace

Result<FairedStretch> faired_across(const SkinStretch& stretch, const FairAcross& wanted,
                                    const RunContext& run, double from, double to) {
  FairedStretch best{stretch.surface, std::nullopt, std::vector<double>(wanted.v.size(), 0.0)};
  for (const SectionCurve& section : stretch.sections) {
    best.reach = std::max(best.reach, most_of(section, wanted.tolerance));
  }
  if (stretch.surface.degree_v < 2 || stretch.breaks.size() < 2 || !(best.reach > 0.0)) return best;
  const auto kept = given_runs(stretch, wanted.v, run);
  OBVID_TRY(kept);
  const std::vector<double> tolerances = levels(wanted, best.reach);
  for (std::size_t n = 0; n < tolerances.size(); ++n) {
    const auto part = [&](std::size_t k) {
      return from + (to - from) * static_cast<double>(k) / static_cast<double>(tolerances.size());
    };
    // the whole tolerance, of which something may be kept for what comes after
    const bool whole = tolerances[n] >= wanted.tolerance;
    const auto forced =
        whole ? Result<ForcedAcross>(wanted.forced)
              : forced_across(stretch.surface, stretch.breaks, wanted.v, tolerances[n], run);
    OBVID_TRY(forced);
    const FairAcross level{wanted.fine, tolerances[n], wanted.v,     wanted.across,
                           *forced,     wanted.fixed,  wanted.smooth};
    const auto any = improve_within(stretch, level, *kept, run, part(n), part(n + 1), best);
    OBVID_TRY(any);
    best.enough = best.enough || *any;
    if (n == 0 && best.correction && wanted.tolerance <= best.reach) break;
  }
  return best;
}

namespace {

/// Multiplications of one step of the program for so many sections and control points along.
double work_of(std::size_t sections, std::size_t along) {
  constexpr std::size_t kForms = 20;  // columns that a form of the runs sees, about
  const std::size_t columns = 3 * along;
  const auto band = static_cast<double>(std::min(4 * columns, kForms * sections));
  return static_cast<double>(sections * columns) * band * band;
}

/// Takes the place of the best so far where that has more changes.
void take_better(const Waves& waves, LightAndFair&& candidate, std::optional<Waves>& least,
                 LightAndFair& best) {
  if (least && !waves.less_than(*least)) return;
  least = waves;
  best = std::move(candidate);
}

/// The correction in the space of the few knots that the light skin has within a tolerance.
Result<void> improve_light(const SkinStretch& stretch, const FairAcross& wanted, double light,
                           const RunContext& run, double from, double to,
                           std::optional<Waves>& least, LightAndFair& best) {
  const auto few = lightened({stretch.surface}, light, run, LightWhere::kAlong);
  OBVID_TRY(few);
  const NurbsSurface& given = few->surfaces.front();
  if (given.points.size() >= stretch.surface.points.size()) return {};
  if (work_of(wanted.v.size(), given.count_u()) > kMostLightWork) return {};
  for (std::size_t n = 0; n < kLightRuns.size(); ++n) {
    if (least && least->high_ones_few(kFewOfLight)) return {};
    const auto part = [&](std::size_t k) {
      return from + (to - from) * static_cast<double>(k) / static_cast<double>(kLightRuns.size());
    };
    // each from the light skin: signs that runs have bent are no good ones
    Correction correction(stretch, given, wanted,
                          Along{0, 0, kLightRunPlaces, kLightRuns[n], false}, given.knots_u, 0);
    OBVID_TRY(correction.improve({}, {}, run, part(n), part(n + 1)));
    const std::vector<double> moved = correction.moved();
    if (*std::max_element(moved.begin(), moved.end()) > wanted.tolerance) continue;
    const auto waves = waves_of(stretch, correction.surface(), wanted, run);
    OBVID_TRY(waves);
    take_better(*waves, {{correction.surface(), {}, moved, 0.0, true}, few->moved}, least, best);
  }
  return {};
}

/// Fair within what is left, and then light: the knots that this needs.
Result<void> fair_then_light(const SkinStretch& stretch, const FairAcross& wanted, double light,
                             const RunContext& run, double from, double to,
                             std::optional<Waves>& least, LightAndFair& best) {
  const FairAcross rest{
      wanted.fine,  wanted.tolerance - light, wanted.v, wanted.across, wanted.forced, wanted.fixed,
      wanted.smooth};
  auto fair = faired_across(stretch, rest, run, from, to);
  OBVID_TRY(fair);
  auto few = lightened({fair->surface}, light, run, LightWhere::kAlong);
  OBVID_TRY(few);
  if (few->surfaces.front().points.size() < fair->surface.points.size()) {
    fair->surface = std::move(few->surfaces.front());
  } else {  // no lighter one: that of the exact one, and the correction as it is
    few = lightened({stretch.surface}, light, run, LightWhere::kAlong);
    OBVID_TRY(few);
    fair->surface = std::move(few->surfaces.front());
    if (fair->correction) fair->surface = sum_of(fair->surface, *fair->correction);
  }
  for (double& by : fair->moved) by += few->moved;
  best.fair.enough = best.fair.enough || fair->enough;
  const auto waves = waves_of(stretch, fair->surface, wanted, run);
  OBVID_TRY(waves);
  take_better(*waves, {std::move(*fair), few->moved}, least, best);
  return {};
}

}  // namespace

Result<LightAndFair> light_and_fair(const SkinStretch& stretch, const FairAcross& wanted,
                                    double light, const RunContext& run, double from, double to) {
  LightAndFair best{{stretch.surface, {}, std::vector<double>(wanted.v.size(), 0.0)}, 0.0};
  std::optional<Waves> least;
  constexpr std::size_t kParts = kLightShares.size() + 1;
  const auto part = [&](std::size_t k) {
    return from + (to - from) * static_cast<double>(k) / static_cast<double>(kParts);
  };
  const bool bends = stretch.surface.degree_v >= 2 && stretch.breaks.size() >= 2;
  for (std::size_t n = 0; n < kLightShares.size() && bends; ++n) {
    if (least && (least->high_ones_few(kFewOfLight) || !least->high_ones_few(kFewForKnots))) break;
    OBVID_TRY(improve_light(stretch, wanted, kLightShares[n] * light, run, part(n), part(n + 1),
                            least, best));
  }
  if (!least || !least->high_ones_few(kFewOfLight)) {
    OBVID_TRY(fair_then_light(stretch, wanted, light, run, part(kParts - 1), to, least, best));
  }
  for (const SectionCurve& section : stretch.sections) {
    best.fair.reach = std::max(best.fair.reach, most_of(section, wanted.tolerance));
  }
  return best;
}

}  // namespace obvid
