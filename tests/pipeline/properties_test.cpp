// SPDX-License-Identifier: Apache-2.0
// What must not matter does not matter: where the drawing lies, how large it is, which way round
// and in which mirror it is read, and whether a point of the contour is named once more.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "../common/angles.h"
#include "../common/oracle_curves.h"
#include "obvid/io/contour_json.h"
#include "obvid/pipeline/fit.h"
#include "obvid/region/internal/boundary_distance.h"
#include "obvid/region/internal/segment_region.h"

namespace obvid {
namespace {

using namespace test;

constexpr int kPropertySeries = 300;

// What may differ is bounded by theory, not by what was found. Two spirals through the same points
// stay within the points-only error of each other; two between the same elements stay in the region
// of these elements (docs/methods/region.md).

constexpr double kUnitRoundoff = 0x1p-53;
/// The shortest chord of the series, of their size.
constexpr double kShortestChord = 1e-3;
/// Where the points are only rounded differently. A curvature is a second difference of them: four
/// roundings over the square of the shortest chord. A neighbour as long as the series takes it
/// over.
constexpr double kRoundedOfChord = 4.0 * kUnitRoundoff / (kShortestChord * kShortestChord);
/// Headings, and curvatures relative to the largest of both neighbours: Newton's last step.
constexpr double kConvergedHeading = 1e-9;
constexpr double kConvergedCurvature = 1e-8;

/// Point of a piece relative to an anchor, without rounding to the anchor's coordinates.
Vec2 point_from(const Piece& piece, double t, Vec2 anchor) {
  const auto* bezier = std::get_if<RationalBezier>(&piece);
  if (bezier == nullptr) return evaluate(piece, t).point - anchor;
  RationalBezier local = *bezier;
  local.origin = {};
  for (std::size_t j = 0; j <= static_cast<std::size_t>(local.degree); ++j) {
    local.offset[j] = (bezier->origin - anchor) + bezier->offset[j];
  }
  return evaluate(local, t).point;
}

/// A contour with its pieces sorted by the chord that they stand on.
class ByChord {
 public:
  explicit ByChord(const Contour& contour) : contour_(contour) {
    for (std::size_t k = 0; k < contour.pieces.size(); ++k) {
      if (k == 0 || contour.joints[k].source) first_.push_back(k);
    }
    first_.push_back(contour.pieces.size());
  }
  [[nodiscard]] std::size_t chords() const { return first_.size() - 1; }
  [[nodiscard]] std::size_t first(std::size_t chord) const { return first_[chord]; }
  [[nodiscard]] std::size_t end(std::size_t chord) const { return first_[chord + 1]; }
  [[nodiscard]] const Contour& contour() const { return contour_; }

  /// Ordinate of the contour over the abscissa x of a chord's frame (chord = 1).
  [[nodiscard]] double ordinate(std::size_t chord, double x) const {
    const Vec2 p = contour_.points[chord], d = contour_.points[chord + 1] - p;
    const auto local = [&](std::size_t k, double t) {
      const Vec2 v = point_from(contour_.pieces[k], t, p);
      return Vec2{dot(d, v) / dot(d, d), cross(d, v) / dot(d, d)};
    };
    std::size_t k = first(chord);
    while (k + 1 < end(chord) && local(k, 1.0).x < x) ++k;
    double low = 0.0, high = 1.0;
    constexpr int kBisections = 54;
    for (int i = 0; i < kBisections; ++i) {
      const double t = 0.5 * (low + high);
      (local(k, t).x < x ? low : high) = t;
    }
    return local(k, 0.5 * (low + high)).y;
  }

 private:
  const Contour& contour_;
  std::vector<std::size_t> first_;
};

/// How another contour relates to the first one.
struct Relation {
  std::function<std::size_t(std::size_t)> chord;  ///< of the first contour, for one of the other
  std::function<std::size_t(std::size_t)> point;  ///< of the other contour, for one of the first
  std::function<Vec2(Vec2)> back;                 ///< turns differences of points back
};

struct Difference {
  double of_chord = 0.0;        ///< largest distance over the chord
  double of_points_only = 0.0;  ///< largest distance over the points-only error, where defined
  double outside_region =
      0.0;          ///< how far the other lies outside the first's regions, of the chord
  int regions = 0;  ///< in how many places there is such a region
};

/// Element of a contour at a point of its series.
Element element_at_point(const Contour& contour, std::size_t point) {
  const auto there = std::find_if(contour.joints.begin(), contour.joints.end(),
                                  [&](const Joint& j) { return j.source == point; });
  return there->element;
}

/// Ordinates, of the chord, between which all spirals of a segment's elements pass at the abscissa
/// x (of the chord). Unknown where the ends have one curvature, or no ordinate tells.
std::optional<std::pair<double, double>> region_over(const Contour& contour, std::size_t chord,
                                                     double x) {
  const Element start = element_at_point(contour, chord);
  const Element end = element_at_point(contour, chord + 1);
  if (start.kappa == end.kappa) return std::nullopt;
  const ChordFrame frame = chord_frame(start, end);
  const auto region = segment_region(frame, start.kappa < end.kappa ? 1 : -1);
  if (!region) return std::nullopt;
  const auto a = ordinate_over_chord(frame, region->from_start, x * frame.h);
  const auto b = ordinate_over_chord(frame, region->to_end, x * frame.h);
  if (!a || !b) return std::nullopt;
  const double low = std::min(*a, *b) / frame.h, high = std::max(*a, *b) / frame.h;
  return std::pair(low, high);
}

Difference difference(const Fit& a, const Fit& b, const Relation& r) {
  const ByChord first(a.contour), other(b.contour);
  Difference out;
  for (std::size_t c = 0; c < other.chords(); ++c) {
    const std::size_t chord = r.chord(c);
    const Vec2 p = a.contour.points[chord], d = a.contour.points[chord + 1] - p;
    const Vec2 anchor = b.contour.points[r.point(chord)];
    const double h = norm(d);
    const double rounding = 8.0 * kUnitRoundoff * (std::abs(p.x) + std::abs(p.y) + h);
    for (std::size_t k = other.first(c); k < other.end(c); ++k) {
      for (const double t : {0.2, 0.5, 0.8}) {
        const Vec2 v = r.back(point_from(b.contour.pieces[k], t, anchor));
        const double x = dot(d, v) / (h * h), y = cross(d, v) / (h * h);
        const double gap = std::max(0.0, std::abs(y - first.ordinate(chord, x)) * h - rounding);
        const double bound = a.report.segments[chord].points_only_error;
        out.of_chord = std::max(out.of_chord, gap / h);
        if (const auto region = region_over(a.contour, chord, x)) {
          const double beyond = std::max(region->first - y, y - region->second) - rounding / h;
          out.outside_region = std::max(out.outside_region, beyond);
          ++out.regions;
        }
        if (std::isnan(bound)) continue;
        out.of_points_only = std::max(out.of_points_only, gap / bound);
      }
    }
  }
  return out;
}

Result<Fit> fit_points(const std::vector<Vec2>& points) {
  PointSeries series;
  series.points = points;
  return fit(series, FitJob{});
}

Relation same_order(std::function<Vec2(Vec2)> back) {
  const auto same = [](std::size_t i) { return i; };
  return {same, same, std::move(back)};
}

/// Runs a transformation over random series. It returns the other points and the relation.
struct Changed {
  std::vector<Vec2> points;
  Relation relation;
};
using ChangeOfSeries = std::function<Changed(const Sampled&, const Fit&, std::mt19937_64&)>;

/// Series whose coordinates hold the curve well: near the origin.
Sampled near_series(int i, std::mt19937_64& rng) {
  for (;;) {
    Sampled s = random_series(static_cast<Oracle>(i % kOracleCount), rng, kRightAngle);
    if (s.offset_sizes == 0.0) return s;
  }
}

std::vector<Difference> differences(unsigned seed, const ChangeOfSeries& change) {
  std::mt19937_64 rng(seed);
  std::vector<Difference> out;
  for (int i = 0; i < kPropertySeries; ++i) {
    const Sampled s = near_series(i, rng);
    const auto a = fit_points(s.points);
    if (!a || !a->certificate.proved || a->certificate.vertices != 0) continue;
    const Changed changed = change(s, *a, rng);
    const auto b = fit_points(changed.points);
    const std::string what = std::to_string(i) + ": " + name_of(s.curve.kind) + ", " +
                             std::to_string(s.points.size()) + " points";
    if (!b) {
      ADD_FAILURE() << what << ": " << to_line(b.error());
      continue;
    }
    EXPECT_TRUE(b->certificate.proved) << what << ": " << b->certificate.reason;
    EXPECT_EQ(b->certificate.vertices, 0) << what;
    out.push_back(difference(*a, *b, changed.relation));
  }
  return out;
}

Difference largest(const char* name, const std::vector<Difference>& all) {
  Difference out;
  for (const Difference& d : all) {
    out.of_chord = std::max(out.of_chord, d.of_chord);
    out.of_points_only = std::max(out.of_points_only, d.of_points_only);
  }
  std::printf("%s: %zu series, largest change %.2e of the chord, %.2e of the points-only error\n",
              name, all.size(), out.of_chord, out.of_points_only);
  EXPECT_GE(all.size(), static_cast<std::size_t>(kPropertySeries) * 95 / 100) << name;
  return out;
}

Vec2 rounded(long double x, long double y) {
  return {static_cast<double>(x), static_cast<double>(y)};
}

/// Similarity z -> scale e^{i angle} z + shift of every point, rounded once.
Changed similarity(const Sampled& s, double scale, double angle, Vec2 shift) {
  const long double c = std::cos(static_cast<long double>(angle));
  const long double n = std::sin(static_cast<long double>(angle));
  Changed out;
  for (const Vec2 p : s.points) {
    out.points.push_back(
        rounded(scale * (c * p.x - n * p.y) + shift.x, scale * (n * p.x + c * p.y) + shift.y));
  }
  out.relation = same_order(
      [=](Vec2 v) { return rounded((c * v.x + n * v.y) / scale, (c * v.y - n * v.x) / scale); });
  return out;
}

TEST(Properties, ARigidMotionLeavesTheContourTheSame) {
  const auto all = differences(401, [](const Sampled& s, const Fit&, std::mt19937_64& rng) {
    const Vec2 shift = {s.size * uniform(rng, -1.0, 1.0), s.size * uniform(rng, -1.0, 1.0)};
    return similarity(s, 1.0, uniform(rng, 0.0, 6.28), shift);
  });
  const Difference d = largest("rigid motion", all);
  EXPECT_LE(d.of_chord, kRoundedOfChord);
  EXPECT_LE(d.of_points_only, 1.0);
}

TEST(Properties, AScaleLeavesTheContourTheSame) {
  const auto all = differences(402, [](const Sampled& s, const Fit&, std::mt19937_64& rng) {
    return similarity(s, std::pow(10.0, uniform(rng, -6.0, 6.0)), 0.0, {});
  });
  const Difference d = largest("scale", all);
  EXPECT_LE(d.of_chord, kRoundedOfChord);
  EXPECT_LE(d.of_points_only, 1.0);
}

TEST(Properties, AMirrorLeavesTheContourTheSame) {
  const auto all = differences(403, [](const Sampled& s, const Fit&, std::mt19937_64&) {
    Changed out;
    for (const Vec2 p : s.points) out.points.push_back({p.x, -p.y});
    out.relation = same_order([](Vec2 v) { return Vec2{v.x, -v.y}; });
    return out;
  });
  const Difference d = largest("mirror", all);
  EXPECT_EQ(d.of_chord, 0.0);  // only signs change, so not one bit may
}

TEST(Properties, TheOtherWayRoundTheContourIsTheSame) {
  const auto all = differences(404, [](const Sampled& s, const Fit&, std::mt19937_64&) {
    Changed out;
    out.points.assign(s.points.rbegin(), s.points.rend());
    const std::size_t last = s.points.size() - 1;
    out.relation = {[=](std::size_t c) { return last - 1 - c; },
                    [=](std::size_t p) { return last - p; }, [](Vec2 v) { return v; }};
    return out;
  });
  EXPECT_LE(largest("reversal", all).of_chord, kRoundedOfChord);
  int regions = 0;
  for (const Difference& d : all) {
    EXPECT_LE(d.outside_region, kConvergedHeading);
    regions += d.regions;
  }
  EXPECT_GT(regions, 3 * kPropertySeries);
}

/// The middle of a piece inside the contour, inserted between the points beside it.
Changed with_inserted(const Fit& f, std::size_t chord) {
  const ByChord pieces(f.contour);
  const std::size_t k = (pieces.first(chord) + pieces.end(chord)) / 2;
  const Vec2 point = evaluate(f.contour.pieces[k], 0.5).point;
  Changed out;
  out.points = f.contour.points;
  out.points.insert(out.points.begin() + static_cast<std::ptrdiff_t>(chord) + 1, point);
  out.relation = {[=](std::size_t c) { return c <= chord ? c : c - 1; },
                  [=](std::size_t p) { return p <= chord ? p : p + 1; }, [](Vec2 v) { return v; }};
  return out;
}

TEST(Properties, APointOfTheContourInsertedChangesLittle) {
  const auto all = differences(405, [](const Sampled& s, const Fit& f, std::mt19937_64& rng) {
    const std::size_t interior = s.points.size() - 3;
    return with_inserted(f, 1 + rng() % interior);
  });
  const Difference d = largest("insertion", all);
  EXPECT_LE(d.of_points_only, 1.0);
}

TEST(Properties, ElementsDoNotDependOnTheWayRound) {
  std::mt19937_64 rng(6);
  int compared = 0;
  for (int i = 0; i < kPropertySeries; ++i) {
    const Sampled s = near_series(i, rng);
    const auto a = fit_points(s.points);
    const auto b = fit_points({s.points.rbegin(), s.points.rend()});
    if (!a || !b || a->report.chain.free_elements != 0) continue;
    const auto of_points = [](const Contour& contour) {
      std::vector<Element> out;
      for (const Joint& j : contour.joints) {
        if (j.source) out.push_back(j.element);
      }
      return out;
    };
    const auto there = of_points(a->contour), back = of_points(b->contour);
    ASSERT_EQ(there.size(), back.size());
    const std::size_t last = there.size() - 1;
    for (std::size_t j = 0; j <= last; ++j) {
      const Element &e = there[j], &f = back[last - j];
      const double turn = e.theta - f.theta - std::numbers::pi;
      EXPECT_NEAR(std::remainder(turn, 2.0 * std::numbers::pi), 0.0, kConvergedHeading)
          << i << ", " << j;
      const double scale = std::max({std::abs(e.kappa), std::abs(there[j > 0 ? j - 1 : 1].kappa),
                                     std::abs(there[j < last ? j + 1 : last - 1].kappa)});
      EXPECT_NEAR(e.kappa, -f.kappa, kConvergedCurvature * scale) << i << ", " << j;
    }
    ++compared;
  }
  EXPECT_GE(compared, kPropertySeries * 9 / 10);
}

TEST(Properties, AScaleByAPowerOfTwoChangesNothingButExponents) {
  std::mt19937_64 rng(7);
  int compared = 0;
  for (int i = 0; i < kPropertySeries / 3; ++i) {
    const Sampled s = near_series(i, rng);
    const int power = static_cast<int>(rng() % 81) - 40;
    std::vector<Vec2> scaled;
    for (const Vec2 p : s.points)
      scaled.push_back({std::ldexp(p.x, power), std::ldexp(p.y, power)});
    const auto a = fit_points(s.points), b = fit_points(scaled);
    ASSERT_EQ(a.has_value(), b.has_value()) << i;
    if (!a) continue;
    ASSERT_EQ(a->contour.pieces.size(), b->contour.pieces.size()) << i;
    for (std::size_t k = 0; k < a->contour.pieces.size(); ++k) {
      const auto* p = std::get_if<RationalBezier>(&a->contour.pieces[k]);
      const auto* q = std::get_if<RationalBezier>(&b->contour.pieces[k]);
      if (p == nullptr || q == nullptr) continue;
      for (std::size_t j = 0; j <= static_cast<std::size_t>(p->degree); ++j) {
        EXPECT_EQ(std::ldexp(p->offset[j].x, power), q->offset[j].x) << i << ", piece " << k;
        EXPECT_EQ(std::ldexp(p->offset[j].y, power), q->offset[j].y) << i << ", piece " << k;
        EXPECT_EQ(p->weight[j], q->weight[j]) << i << ", piece " << k;
      }
      ++compared;
    }
    for (std::size_t j = 0; j < a->contour.joints.size(); ++j) {
      const Element &e = a->contour.joints[j].element, &f = b->contour.joints[j].element;
      EXPECT_EQ(e.theta, f.theta) << i << ", joint " << j;
      EXPECT_EQ(std::ldexp(e.kappa, -power), f.kappa) << i << ", joint " << j;
    }
    EXPECT_EQ(std::ldexp(a->report.largest_width, power), b->report.largest_width) << i;
    EXPECT_EQ(a->report.inserted_points, b->report.inserted_points) << i;
  }
  EXPECT_GT(compared, 1000);
}

TEST(Properties, FarFromTheOriginTheContourStaysWithinThePointsOnlyError) {
  std::mt19937_64 rng(8);
  int compared = 0;
  double worst = 0.0;
  for (int i = 0; i < kPropertySeries; ++i) {
    const Sampled s = near_series(i, rng);
    const double far = s.size * std::pow(10.0, uniform(rng, 0.0, 3.0));
    const Changed changed = similarity(s, 1.0, 0.0, {far, -far});
    const auto a = fit_points(s.points), b = fit_points(changed.points);
    if (!a || !b || a->certificate.vertices != 0 || b->certificate.vertices != 0) continue;
    // only where the moved coordinates still hold the curve
    const double moved = 0x1p-52 * far;
    bool wide = true;
    for (const SegmentReport& seg : a->report.segments) {
      wide = wide && !(seg.points_only_error < 1e3 * moved);
    }
    if (!wide) continue;
    worst = std::max(worst, difference(*a, *b, changed.relation).of_points_only);
    ++compared;
  }
  std::printf("far away: %d series, largest change %.2e of the points-only error\n", compared,
              worst);
  EXPECT_GT(compared, kPropertySeries / 4);
  EXPECT_LE(worst, 1.0);
}

/// The file without the line that says how long the computation took.
std::string without_time(const Fit& f) {
  Fit timeless = f;
  timeless.report.seconds = 0.0;
  return contour_to_json({timeless.contour, timeless.report, timeless.certificate});
}

TEST(Properties, TheSameInputGivesTheSameBytes) {
  std::mt19937_64 rng(9);
  for (int i = 0; i < 40; ++i) {
    const Sampled s = random_series(static_cast<Oracle>(i % kOracleCount), rng, kRightAngle);
    PointSeries series;
    series.points = s.points;
    FitJob job;
    job.carrier = i % 2 == 0 ? Carrier::kSpiral : Carrier::kArcs;
    const auto a = fit(series, job), b = fit(series, job);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (a) {
      EXPECT_EQ(without_time(*a), without_time(*b)) << i;
    } else {
      EXPECT_EQ(to_line(a.error()), to_line(b.error())) << i;
    }
  }
}

}  // namespace
}  // namespace obvid
