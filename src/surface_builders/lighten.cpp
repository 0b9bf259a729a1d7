// SPDX-License-Identifier: Apache-2.0
// Fewer knots within a tolerance, one direction after the other: docs/methods/skin.md.
#include "obvid/surface_builders/internal/lighten.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "approximate_line.h"
#include "network_curves.h"
#include "obvid/core/internal/parallel.h"
#include "obvid/core/internal/watch.h"
#include "obvid/curve/internal/basis.h"
#include "obvid/surface_builders/internal/grid.h"
#include "row_hull.h"
#include "thin_line.h"

namespace obvid {
namespace {

/// Samples in a span of the given spline. Exact skins have many more spans than positions need:
/// first there are about as many samples as `kFewSamples`, and where the spline that is found has
/// less than `kSamplesEach` for each of its coefficients, or none is found, the most.
constexpr std::size_t kMostSamplesPerSpan = 4, kFewSamples = 600, kSamplesEach = 5;
constexpr double kEvenSamples = 400.0;
/// Of the aim: knots are taken away from a spline that is nearer.
constexpr double kStart = 0.5;
/// What the first direction may take; the second has what is left.
constexpr double kShareAlong = 0.75;
/// The samples see nearly all of the largest difference: where the bound exceeds the tolerance, the
/// aim is lowered by as much, and a little more.
constexpr int kTrials = 6;
constexpr double kFirstAim = 0.98, kLower = 0.99, kMostStricter = 1.5;
/// Of the largest coordinate: rounding of the difference and of its control points.
constexpr double kHullRounding = 512.0 * std::numeric_limits<double>::epsilon();
constexpr std::size_t kMostOrder = kMostLineDegree + 1;

/// A spline with rows of coefficients: one for each B-spline.
struct Spline {
  int degree = 0;
  std::vector<double> knots;
  Rows coefficients;

  void add(double t, double factor, int derivative, std::vector<Vec3>& sum) const {
    const BasisValues basis = basis_at(degree, knots, t, derivative);
    for (std::size_t k = 0; k <= static_cast<std::size_t>(degree); ++k) {
      const double share = factor * basis.value[static_cast<std::size_t>(derivative)][k];
      if (share == 0.0) continue;
      const Vec3* row = coefficients.row(basis.first + k);
      for (std::size_t j = 0; j < sum.size(); ++j) sum[j] = sum[j] + share * row[j];
    }
  }
};

/// So many in each span, and at least `kEvenSamples` in equal steps over all.
std::vector<double> samples_of(const std::vector<double>& knots, std::size_t per_span) {
  const std::vector<double> breaks = distinct(knots);
  const double whole = breaks.back() - breaks.front();
  std::vector<double> out;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double length = breaks[i + 1] - breaks[i];
    const double even = std::ceil(kEvenSamples * length / whole);
    const auto parts = std::max(per_span, static_cast<std::size_t>(even));
    for (std::size_t k = 0; k < parts; ++k) {
      const double part = static_cast<double>(k) / static_cast<double>(parts);
      out.push_back(breaks[i] + part * length);
    }
  }
  out.push_back(breaks.back());
  return distinct(std::move(out));
}

Rows values_of(const Spline& spline, const std::vector<double>& at) {
  Rows out{spline.coefficients.width, {}};
  std::vector<Vec3> row(out.width);
  for (const double t : at) {
    std::fill(row.begin(), row.end(), Vec3{});
    spline.add(t, 1.0, 0, row);
    out.points.insert(out.points.end(), row.begin(), row.end());
  }
  return out;
}

/// Point and the first derivatives at a parameter.
Rows jet_of(const Spline& spline, double at, int derivatives) {
  Rows out{spline.coefficients.width, {}};
  std::vector<Vec3> row(out.width);
  for (int d = 0; d <= derivatives; ++d) {
    std::fill(row.begin(), row.end(), Vec3{});
    spline.add(at, 1.0, d, row);
    out.points.insert(out.points.end(), row.begin(), row.end());
  }
  return out;
}

/// Control points of a polynomial over [0, 1] from its values at equal steps: the inverse of the
/// matrix of Bernstein polynomials there.
class FromValues {
 public:
  explicit FromValues(std::size_t order) : order_(order) {
    std::array<std::array<double, 2 * kMostOrder>, kMostOrder> a{};
    for (std::size_t i = 0; i < order; ++i) {
      const double x = place(i);
      double binomial = 1.0;
      for (std::size_t k = 0; k < order; ++k) {
        const auto up = static_cast<double>(k), down = static_cast<double>(order - 1 - k);
        a[i][k] = binomial * std::pow(x, up) * std::pow(1.0 - x, down);
        binomial *= down / (up + 1.0);
      }
      a[i][order + i] = 1.0;
    }
    for (std::size_t k = 0; k < order; ++k) {  // totally positive: no pivots are needed
      const double pivot = a[k][k];
      for (std::size_t c = 0; c < 2 * order; ++c) a[k][c] /= pivot;
      for (std::size_t i = 0; i < order; ++i) {
        const double factor = i == k ? 0.0 : a[i][k];
        for (std::size_t c = 0; c < 2 * order; ++c) a[i][c] -= factor * a[k][c];
      }
    }
    for (std::size_t i = 0; i < order; ++i) {
      for (std::size_t k = 0; k < order; ++k) inverse_[i][k] = a[i][order + k];
    }
  }

  [[nodiscard]] double place(std::size_t i) const {
    return order_ == 1 ? 0.0 : static_cast<double>(i) / static_cast<double>(order_ - 1);
  }
  [[nodiscard]] double share(std::size_t control_point, std::size_t value) const {
    return inverse_[control_point][value];
  }

 private:
  std::size_t order_;
  std::array<std::array<double, kMostOrder>, kMostOrder> inverse_{};
};

/// Where the difference of two splines may be larger than allowed.
struct Excess {
  double from, to, bound;
};

/// Bound of the distance of two tensor products over the same parameters, whose other direction has
/// the hull: between the knots of both the difference is a polynomial in both, which lies in the
/// hull of its control points. Spans are halved where that is more than `allowed`.
class Bound {
 public:
  Bound(const Spline& a, const Spline& b, const OtherWay& other, double allowed)
      : a_(a),
        b_(b),
        other_(other),
        allowed_(allowed),
        order_(static_cast<std::size_t>(std::max(a.degree, b.degree)) + 1),
        from_values_(order_),
        values_(order_, std::vector<Vec3>(a.coefficients.width)),
        row_(3 * a.coefficients.width) {
    double largest = 0.0;
    for (const Vec3& p : a.coefficients.points) {
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    }
    rounding_ = kHullRounding * largest;
    std::vector<double> knots(a.knots.size() + b.knots.size());
    std::merge(a.knots.begin(), a.knots.end(), b.knots.begin(), b.knots.end(), knots.begin());
    const std::vector<double> breaks = distinct(std::move(knots));
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      add(breaks[i], breaks[i + 1], kBoundHalvings);
    }
  }

  [[nodiscard]] double most() const { return most_; }
  [[nodiscard]] const std::vector<Excess>& excess() const { return excess_; }

 private:
  static constexpr int kBoundHalvings = 3;

  void add(double from, double to, int halvings) {
    const double bound = over(from, to);
    const double middle = from + 0.5 * (to - from);
    if (bound > allowed_ && halvings > 0 && from < middle && middle < to) {
      add(from, middle, halvings - 1);
      add(middle, to, halvings - 1);
      return;
    }
    if (bound > allowed_) excess_.push_back({from, to, bound});
    most_ = std::max(most_, bound);
  }

  [[nodiscard]] double over(double from, double to) {
    for (std::size_t k = 0; k < order_; ++k) {
      const double t = from + from_values_.place(k) * (to - from);
      std::fill(values_[k].begin(), values_[k].end(), Vec3{});
      a_.add(t, 1.0, 0, values_[k]);
      b_.add(t, -1.0, 0, values_[k]);
    }
    double most = 0.0;
    for (std::size_t c = 0; c < order_; ++c) {
      for (std::size_t j = 0; j < values_[0].size(); ++j) {
        Vec3 point;
        for (std::size_t k = 0; k < order_; ++k) {
          point = point + from_values_.share(c, k) * values_[k][j];
        }
        row_[3 * j] = point.x;
        row_[3 * j + 1] = point.y;
        row_[3 * j + 2] = point.z;
      }
      double squared = other_.hull.longest_squared(row_.data());
      if (std::sqrt(squared) + rounding_ > allowed_) {
        squared = other_.close_hull.longest_squared(row_.data());
      }
      most = std::max(most, squared);
    }
    return std::sqrt(most) + rounding_;
  }

  const Spline& a_;
  const Spline& b_;
  const OtherWay& other_;
  double allowed_;
  std::size_t order_;
  FromValues from_values_;
  std::vector<std::vector<Vec3>> values_;
  std::vector<double> row_;
  double rounding_ = 0.0, most_ = 0.0;
  std::vector<Excess> excess_;
};

struct Lighter {
  Spline spline;
  double moved = 0.0;
};

/// One direction of splines that live as long, beside the hull of the other: few knots such that
/// samples lie within an aim.
class FewKnots {
 public:
  FewKnots(const Spline& given, OtherWay other, int kept_derivatives)
      : given_(given), other_(std::move(other)) {
    kept_ = {jet_of(given, given.knots.front(), kept_derivatives),
             jet_of(given, given.knots.back(), kept_derivatives)};
  }

  /// Nothing where the given spline stays, and when it is to end.
  [[nodiscard]] std::optional<Lighter> within(double tolerance, Watch& watch) const {
    const std::size_t spans = distinct(given_.knots).size() - 1;
    const std::size_t few = std::clamp(kFewSamples / spans, std::size_t{1}, kMostSamplesPerSpan);
    for (const std::size_t per_span : {few, kMostSamplesPerSpan}) {
      Samples samples(given_, per_span);
      auto found = lighter(samples, tolerance, watch);
      if (samples.most || watch.was_cancelled()) return found;
      if (found && samples.enough_for(found->spline.coefficients.count())) return found;
    }
    return std::nullopt;
  }

  /// Whether it may have fewer knots within a tolerance: found without a look between the samples.
  [[nodiscard]] bool may_be_lighter(double tolerance, Watch& watch) const {
    const Samples samples(given_, kMostSamplesPerSpan);
    const auto line = refined(samples, tolerance, watch);
    return line && line->coefficients.count() < given_.coefficients.count();
  }

 private:
  struct Samples {
    Samples(const Spline& given, std::size_t per_span)
        : at(samples_of(given.knots, per_span)),
          data(values_of(given, at)),
          strictness(at.size(), 1.0),
          most(per_span == kMostSamplesPerSpan) {}
    [[nodiscard]] bool enough_for(std::size_t coefficients) const {
      return at.size() >= kSamplesEach * coefficients;
    }
    /// Looks closer where the bound is too large.
    void refine(const Spline& given, const std::vector<Excess>& places, double allowed) {
      std::vector<double> more = at;
      for (const Excess& place : places) {
        for (const double part : {0.0, 0.5, 1.0}) {
          more.push_back(place.from + part * (place.to - place.from));
        }
      }
      std::sort(more.begin(), more.end());
      more = distinct(std::move(more));
      std::vector<double> strict;
      for (const double t : more) {
        const auto next = std::lower_bound(at.begin(), at.end(), t);
        strict.push_back(strictness[static_cast<std::size_t>(next - at.begin())]);
      }
      for (const Excess& place : places) {
        const auto first = std::lower_bound(more.begin(), more.end(), place.from);
        const auto last = std::lower_bound(first, more.end(), place.to);
        for (auto i = first; i <= last; ++i) {
          double& here = strict[static_cast<std::size_t>(i - more.begin())];
          here = std::max(here, std::min(place.bound / (kLower * allowed), kMostStricter));
        }
      }
      at = std::move(more);
      strictness = std::move(strict);
      data = values_of(given, at);
    }

    std::vector<double> at;
    Rows data;
    std::vector<double> strictness;  ///< by which errors are multiplied
    bool most;                       ///< there are no more
  };

  [[nodiscard]] std::optional<Lighter> lighter(Samples& samples, double tolerance,
                                               Watch& watch) const {
    const double aim = kFirstAim * tolerance;
    for (int trial = 0; trial < kTrials; ++trial) {
      auto line = refined(samples, kStart * aim, watch);
      if (!line || !(samples.most || samples.enough_for(line->coefficients.count() / 2))) {
        return std::nullopt;
      }
      const ThinData data{samples.at, samples.data, samples.strictness, kept_, other_.places};
      if (!thin_out(*line, data, aim, watch)) return std::nullopt;
      if (line->coefficients.count() >= given_.coefficients.count()) return std::nullopt;
      for (int k = 0; k < kTrials; ++k) {
        Lighter out{{line->degree, line->knots, line->coefficients}, 0.0};
        const Bound bound(given_, out.spline, other_, tolerance);
        out.moved = bound.most();
        if (bound.excess().empty()) return out;
        samples.refine(given_, bound.excess(), tolerance);
        std::vector<double> places;
        for (const Excess& place : bound.excess()) {
          places.push_back(0.5 * (place.from + place.to));
        }
        const ThinData finer{samples.at, samples.data, samples.strictness, kept_, other_.places};
        if (!come_nearer(*line, finer, places, aim)) break;
      }
    }
    return std::nullopt;
  }

  /// Error at each sample.
  [[nodiscard]] std::vector<double> errors_of(const Samples& samples, const SplineLine& line,
                                              const Rows& found) const {
    const Rows made = line.values(found);
    std::vector<double> out(samples.at.size(), 0.0), row(3 * made.width);
    for (std::size_t i = 0; i < out.size(); ++i) {
      for (std::size_t j = 0; j < made.width; ++j) {
        const Vec3 by = made.row(i)[j] - samples.data.row(i)[j];
        row[3 * j] = by.x;
        row[3 * j + 1] = by.y;
        row[3 * j + 2] = by.z;
      }
      out[i] = samples.strictness[i] * std::sqrt(other_.places.longest_squared(row.data()));
    }
    return out;
  }

  /// Knots by halving where the error is above the aim. Nothing where that is not reached.
  [[nodiscard]] std::optional<ThinLine> refined(const Samples& samples, double aim,
                                                Watch& watch) const {
    SplineLine line(samples.at, given_.degree, std::numeric_limits<double>::infinity());
    Rows found;
    while (!watch.cancelled()) {
      if (!line.fit(samples.data, kept_, found)) {
        // too few coefficients for what is kept: halves everywhere
        if (line.split(std::vector<double>(samples.at.size(), 1.0), 0.0) == 0) break;
        continue;
      }
      const std::vector<double> errors = errors_of(samples, line, found);
      const double worst = *std::max_element(errors.begin(), errors.end());
      if (worst <= aim) return ThinLine{line.degree(), line.knots(), std::move(found)};
      // where the worst spans have no more samples, those beside them may still give way
      constexpr double kAlso = 0.25;  // of the worst
      if (line.split(errors, std::max(aim, kAlso * worst)) == 0 && line.split(errors, 0.0) == 0) {
        break;
      }
    }
    return std::nullopt;
  }

  const Spline& given_;
  OtherWay other_;
  LineEnds kept_;
};

Result<void> check_given(const std::vector<NurbsSurface>& given, double tolerance) {
  OBVID_TRY(check_tolerance(tolerance));
  for (const NurbsSurface& s : given) {
    const bool alike = s.degree_v == given.front().degree_v && s.knots_v == given.front().knots_v;
    if (s.weights.empty() && alike && std::max(s.degree_u, s.degree_v) <= kMostLineDegree) continue;
    return error(ErrorCode::kBadOption,
                 "light surfaces are polynomial and have the same knots across");
  }
  return {};
}

/// Some rows across of the given surfaces, which are many: whether across anything is to be had.
Spline across_some(const std::vector<NurbsSurface>& surfaces) {
  constexpr std::size_t kRows = 64;  // about as many of each surface
  const NurbsSurface& first = surfaces.front();
  Spline out{first.degree_v, first.knots_v, {}};
  for (std::size_t j = 0; j < first.count_v(); ++j) {
    for (const NurbsSurface& s : surfaces) {
      const std::size_t count = s.count_u(), step = 1 + count / kRows;
      for (std::size_t i = 0; i < count; i += step) {
        out.coefficients.points.push_back(s.points[j * count + i]);
      }
    }
    if (j == 0) out.coefficients.width = out.coefficients.points.size();
  }
  return out;
}

/// The rows across of all surfaces side by side.
Spline across_all(const std::vector<NurbsSurface>& surfaces) {
  const NurbsSurface& first = surfaces.front();
  Spline out{first.degree_v, first.knots_v, {}};
  for (const NurbsSurface& s : surfaces) out.coefficients.width += s.count_u();
  for (std::size_t j = 0; j < first.count_v(); ++j) {
    for (const NurbsSurface& s : surfaces) {
      const auto row = s.points.begin() + static_cast<std::ptrdiff_t>(j * s.count_u());
      out.coefficients.points.insert(out.coefficients.points.end(), row,
                                     row + static_cast<std::ptrdiff_t>(s.count_u()));
    }
  }
  return out;
}

void take_across(const Spline& across, std::vector<NurbsSurface>& surfaces) {
  std::size_t at = 0;
  for (NurbsSurface& s : surfaces) {
    const std::size_t width = s.count_u();
    s.degree_v = across.degree;
    s.knots_v = across.knots;
    s.points.clear();
    for (std::size_t j = 0; j < across.coefficients.count(); ++j) {
      const Vec3* row = across.coefficients.row(j) + at;
      s.points.insert(s.points.end(), row, row + width);
    }
    at += width;
  }
}

}  // namespace

Result<LightSurfaces> lightened(const std::vector<NurbsSurface>& given, double tolerance,
                                const RunContext& run, LightWhere where) {
  OBVID_TRY(check_given(given, tolerance));
  Watch watch(run);
  const auto told = [&watch](double part) -> Result<void> {
    watch.tell("lightening", part);
    if (watch.cancelled()) return fail(cancelled_error());
    return {};
  };
  constexpr int kKeptAlong = 2, kKeptAcross = 0;  // derivatives at the ends
  constexpr int kLeastDegree = 3;                 // strips of straight lines have corners to keep
  LightSurfaces out{given, 0.0};
  const double parts = static_cast<double>(given.size() + 1);
  std::vector<Spline> rows;
  std::vector<FewKnots> along;
  rows.reserve(given.size());
  for (const NurbsSurface& s : given) {
    rows.push_back({s.degree_u, s.knots_u, transposed(Rows{s.count_u(), s.points})});
    OtherWay across;
    across.add(s.degree_v, s.knots_v);
    along.emplace_back(rows.back(), std::move(across), kKeptAlong);
  }
  // along first, with a share of the tolerance; with all of it where across nothing is lighter
  bool across_too =
      where == LightWhere::kBoth && !given.empty() && given.front().degree_v >= kLeastDegree;
  if (across_too) {
    const Spline some = across_some(given);
    OtherWay hull;
    hull.places.add_points(some.coefficients.width);
    across_too = FewKnots(some, std::move(hull), kKeptAcross)
                     .may_be_lighter((1.0 - kShareAlong) * tolerance, watch);
  }
  for (const double share : {kShareAlong, 1.0}) {
    if (!across_too && share != 1.0) continue;
    out = {given, 0.0};
    OBVID_TRY(told(0.0));
    std::vector<std::optional<Lighter>> light_along(given.size());
    OBVID_TRY(in_parallel(given.size(), run, [&](std::size_t k, const RunContext& part) {
      Watch own(part);
      if (given[k].degree_u < kLeastDegree) return;
      light_along[k] = along[k].within(share * tolerance, own);
    }));
    for (std::size_t k = 0; k < given.size(); ++k) {
      if (!light_along[k]) continue;
      NurbsSurface& s = out.surfaces[k];
      out.moved = std::max(out.moved, light_along[k]->moved);
      s.knots_u = light_along[k]->spline.knots;
      s.points = transposed(light_along[k]->spline.coefficients).points;
    }
    OBVID_TRY(told((parts - 1.0) / parts));
    if (share == 1.0) continue;
    const Spline across = across_all(out.surfaces);
    OtherWay hull;
    for (const NurbsSurface& s : out.surfaces) hull.add(s.degree_u, s.knots_u);
    const auto light =
        FewKnots(across, std::move(hull), kKeptAcross).within(tolerance - out.moved, watch);
    if (!light) continue;
    out.moved += light->moved;
    take_across(light->spline, out.surfaces);
    break;
  }
  OBVID_TRY(told(1.0));
  return out;
}

}  // namespace obvid
