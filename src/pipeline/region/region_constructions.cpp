// SPDX-License-Identifier: Apache-2.0
#include "region/region_constructions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "obvid/certify/certify.h"
#include "obvid/contour/arcs.h"
#include "obvid/contour/bsplines.h"
#include "obvid/contour/clothoids.h"
#include "obvid/curve/nurbs.h"
#include "obvid/numeric/internal/halving.h"
#include "obvid/region/internal/boundary_distance.h"
#include "obvid/series/analysis.h"
#include "region/construction_section.h"

namespace obvid::pipeline_detail {
namespace {

/// A knot of a spline stands at a point when it is so near, in spans.
constexpr double kSameParameter = 1e-9;
/// Points of a loop that its spline runs on over, on both sides: what an end does to it has died
/// down to rounding by then.
constexpr std::size_t kSplineOverlap = 32;

/// Two arcs per segment.
class TwoArcs {
 public:
  TwoArcs() { out_.columns = {"R", "R'", "H", "error"}; }

  Result<void> add(const ConstructionSection& section) {
    const auto kappa = common_curvatures(section);
    OBVID_TRY(kappa);
    double before = kNoFigure;
    for (std::size_t k = section.first; k < section.last; ++k) {
      const RegionRow& row = section.row(k);
      Element a = section.start_of(k), b = section.end_of(k);
      if (const auto one = one_arc(a, b)) {
        const double radius = 1.0 / one->kappa;
        add_row(out_, k, {radius, radius, height_over_chord(*one), 0.0}, "one arc");
        put_piece(out_, k, *one);
        before = one->kappa;
        continue;
      }
      a.kappa = (*kappa)[k - section.first];
      b.kappa = (*kappa)[k - section.first + 1];
      const auto chosen = choose_biarc(chord_frame(a, b), *row.direction);
      if (!chosen) return fail(section.no_region(k));
      const auto pair = biarc(a, b, *chosen);
      if (!std::all_of(pair.begin(), pair.end(), is_an_arc)) return fail(turns_back(section, k));
      const double d = *row.direction;
      const bool one_run = k > section.first && section.row(k - 1).direction == row.direction;
      grows_ = grows_ && d * chosen->first < d * chosen->second &&
               (!one_run || d * before <= d * chosen->first);
      before = chosen->second;
      ChordFrame own = chord_frame(a, b);
      own.kappa_start = chosen->first;
      own.kappa_end = chosen->second;
      const auto height = height_over_middle(own, pair, *row.direction);
      double error = 0.0;
      const auto [first, last] = section.bounded(k);
      for (const Piece& piece : pair) {
        if (const auto placed = place_in_region(piece, first, last, *row.direction)) {
          error = std::max(error, placed->farther);
        }
      }
      add_row(out_, k, {1.0 / chosen->first, 1.0 / chosen->second, height, error}, "");
      for (const Piece& piece : pair) put_piece(out_, k, piece);
    }
    return {};
  }

  ConstructionTable told() {
    out_.remarks.emplace_back(grows_ ? "the radii go one way along every run"
                                     : "the radii do NOT go one way along every run");
    return std::move(out_);
  }

 private:
  /// Headings alike on both sides of the chord.
  [[nodiscard]] static std::optional<ArcPiece> one_arc(const Element& a, const Element& b) {
    constexpr double kAlike = 1e-12;  // rad: what the coordinates leave of their sum
    const Vec2 chord = b.point - a.point;
    const double alpha = turning(chord, unit_at(a.theta)), beta = turning(chord, unit_at(b.theta));
    const double kappa = 2.0 * std::sin(beta) / norm(chord);
    if (std::abs(alpha + beta) > kAlike || kappa == 0.0) return std::nullopt;
    return ArcPiece{a.point, b.point, a.theta, kappa, 2.0 * beta / kappa};
  }

  /// Of an arc over the middle of its chord, whatever it turns.
  [[nodiscard]] static double height_over_chord(const ArcPiece& arc) {
    return 0.5 * norm(arc.end - arc.start) * std::abs(std::tan(0.25 * arc.kappa * arc.length));
  }

  static bool is_an_arc(const Piece& piece) {
    const auto* arc = std::get_if<ArcPiece>(&piece);
    return arc == nullptr || (std::isfinite(arc->kappa) && arc->length > 0.0);
  }

  [[nodiscard]] static Error turns_back(const ConstructionSection& section, std::size_t k) {
    return error(ErrorCode::kNoSpiral, "two arcs would turn by half a turn or more there")
        .where(section.segment(k))
        .hint("put a point between them, or choose other headings")
        .point(section.point(section.row(k).from).number);
  }

  /// Of the arc that stands over the middle of the chord: from angles and curvatures, free of the
  /// rounding of coordinates, where both arcs are graphs over it.
  [[nodiscard]] static double height_over_middle(const ChordFrame& frame,
                                                 const std::array<Piece, 2>& pair, int direction) {
    if (const auto region = segment_region(frame, direction)) {
      const auto y = boundary_ordinate(frame, region->from_start, 0.5 * frame.h);
      if (y) return std::abs(*y);
    }
    const Vec2 start = start_point(pair[0]), chord = end_point(pair[1]) - start;
    const Vec2 u = chord / frame.h;
    for (const Piece& piece : pair) {
      const auto along = [&](double t) {
        return dot(u, evaluate(piece, t).point - start) - 0.5 * frame.h;
      };
      if (along(0.0) > 0.0 || along(1.0) < 0.0) continue;
      constexpr int kHalvings = 60;
      const auto before = [&](double t) { return along(t) < 0.0; };
      const double t = end_of_condition(0.0, 1.0, before, kHalvings).holds;
      return std::abs(cross(u, evaluate(piece, t).point - start));
    }
    return kNoFigure;
  }

  bool grows_ = true;
  ConstructionTable out_;
};

/// One clothoid per segment.
class OneClothoid {
 public:
  OneClothoid() {
    out_.construction = Construction::kClothoids;
    out_.columns = {"R", "R'", "length", "step"};
  }

  Result<void> add(const ConstructionSection& section) {
    std::vector<Ends> made;
    const std::size_t before = out_.pieces.size();
    for (std::size_t k = section.first; k < section.last; ++k) {
      const Element a = section.start_of(k), b = section.end_of(k);
      const auto one = clothoid_between(a.point, a.theta, b.point, b.theta);
      if (!one) return fail(section.no_region(k));
      put_piece(out_, k, *one);
      made.push_back({curvature(evaluate(Piece{*one}, 0.0)), curvature(evaluate(Piece{*one}, 1.0)),
                      one->length});
    }
    for (std::size_t i = 0; i < made.size(); ++i) {
      const bool last = i + 1 == made.size();
      double step = kNoFigure;
      if (!last || section.loop) step = note_step(made[i], made[last ? 0 : i + 1]);
      const bool turns = made[i].start * made[i].end < 0.0;
      add_row(out_, out_.piece_row[before + i],
              {1.0 / made[i].start, 1.0 / made[i].end, made[i].length, step},
              turns ? "inflection inside" : "");
    }
    return {};
  }

  ConstructionTable told() {
    constexpr double kNoStep = 1e-12;  // of the curvature: what rounding leaves
    if (largest_ <= kNoStep) {
      out_.remarks.emplace_back("common tangents; the curvature goes on at every point");
      return std::move(out_);
    }
    out_.remarks.push_back(
        fmt::format("common tangents; curvature steps by up to {:.3g} % of the largest on the two "
                    "segments: `fit --carrier clothoids` joins three to a segment without steps",
                    100.0 * largest_));
    return std::move(out_);
  }

 private:
  struct Ends {
    double start = 0.0, end = 0.0, length = 0.0;
  };

  double note_step(const Ends& before, const Ends& behind) {
    const double step = behind.start - before.end;
    const double scale = std::max({std::abs(before.start), std::abs(before.end),
                                   std::abs(behind.start), std::abs(behind.end)});
    if (scale > 0.0) largest_ = std::max(largest_, std::abs(step) / scale);
    return step;
  }

  double largest_ = 0.0;
  ConstructionTable out_;
};

/// Cubic B-spline through points and tangents, places of the points on it: summed chords.
class TangentSpline {
 public:
  TangentSpline() {
    out_.construction = Construction::kSpline;
    out_.columns = {"spans", "R", "R'", "f", "outside"};
  }

  Result<void> add(const ConstructionSection& section) {
    const std::size_t n = section.points(), rows = n - 1;
    const std::size_t overlap = section.loop ? kSplineOverlap : 0;
    std::vector<Vec2> points;
    std::vector<double> headings, at;
    for (std::size_t k = 0; k < n + 2 * overlap; ++k) {
      // some turns before the seam and behind it
      const std::size_t i = section.loop ? (k + kSplineOverlap * rows - overlap) % rows : k;
      const RegionPoint& p = section.point(section.first_point() + i);
      at.push_back(points.empty() ? 0.0 : at.back() + norm(p.point - points.back()));
      points.push_back(p.point);
      headings.push_back(p.theta);
    }
    const auto curve = spline_through_tangents(points, headings);
    OBVID_TRY(curve);
    const std::vector<BezierSpan> spans = bezier_spans(*curve);
    for (std::size_t j = 0; j < rows; ++j) {
      const auto here = between(spans, at[overlap + j], at[overlap + j + 1]);
      if (here.empty()) return fail(section.no_region(section.first + j));
      add_spans(section, section.first + j, here);
    }
    return {};
  }

  ConstructionTable told() {
    out_.remarks.push_back(fmt::format(
        "C2 through all points and tangents; {} of its pieces have a vertex inside", vertices_));
    return std::move(out_);
  }

 private:
  static std::vector<RationalBezier> between(const std::vector<BezierSpan>& spans, double from,
                                             double to) {
    std::vector<RationalBezier> out;
    for (const BezierSpan& span : spans) {
      const double same = kSameParameter * (span.to - span.from);
      if (span.to <= from + same || span.from >= to - same) continue;
      RationalBezier piece = span.piece;
      double start = span.from;
      if (start < from - same) {
        piece = split(piece, (from - start) / (span.to - start))[1];
        start = from;
      }
      if (span.to > to + same) piece = split(piece, (to - start) / (span.to - start))[0];
      out.push_back(piece);
    }
    return out;
  }

  void add_spans(const ConstructionSection& section, std::size_t k,
                 const std::vector<RationalBezier>& spans) {
    const RegionRow& row = section.row(k);
    std::size_t vertices = 0;
    double farther = row.region ? 0.0 : kNoFigure, outside = farther;
    for (const RationalBezier& span : spans) {
      vertices += prove_piece(Piece{span}).verdict == Verdict::kHasVertex ? 1 : 0;
      if (row.region) {
        const auto [a, b] = section.bounded(k);
        const auto placed = place_in_region(Piece{span}, a, b, *row.direction);
        farther = placed ? std::max(farther, placed->farther) : kNoFigure;
        outside = placed ? std::max(outside, placed->outside) : kNoFigure;
      }
      put_piece(out_, k, span);
    }
    const double start = curvature(evaluate(Piece{spans.front()}, 0.0));
    const double end = curvature(evaluate(Piece{spans.back()}, 1.0));
    add_row(out_, k, {static_cast<double>(spans.size()), 1.0 / start, 1.0 / end, farther, outside},
            vertices > 0 ? "vertex inside" : "monotone");
    vertices_ += vertices;
  }

  std::size_t vertices_ = 0;
  ConstructionTable out_;
};

template <class Maker>
Result<ConstructionTable> along_sections(Maker maker,
                                         const std::vector<ConstructionSection>& sections) {
  for (const ConstructionSection& section : sections) {
    OBVID_TRY(maker.add(section));
  }
  return maker.told();
}

}  // namespace

Carrier carrier_of(Construction which) {
  switch (which) {
    case Construction::kArcs:
      return Carrier::kArcs;
    case Construction::kEllipses:
      return Carrier::kConics;
    case Construction::kClothoids:
      return Carrier::kClothoids;
    case Construction::kParabolas:
      return Carrier::kBeziers;
    default:
      return Carrier::kBaseline;
  }
}

Result<ConstructionTable> construct(const RegionPart& part, Construction which,
                                    std::optional<int> fixation) {
  const auto sections = sections_of(part);
  switch (which) {
    case Construction::kArcs:
      return along_sections(TwoArcs(), sections);
    case Construction::kEllipses:
      return ellipse_arcs(sections);
    case Construction::kClothoids:
      return along_sections(OneClothoid(), sections);
    case Construction::kSpline:
      return along_sections(TangentSpline(), sections);
    default:
      return condensed_triangles(sections, fixation);
  }
}

}  // namespace obvid::pipeline_detail
