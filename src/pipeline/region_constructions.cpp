// SPDX-License-Identifier: Apache-2.0
#include "region_constructions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "form.h"
#include "obvid/certify/certify.h"
#include "obvid/chain/series_chain.h"
#include "obvid/contour/arcs.h"
#include "obvid/contour/beziers.h"
#include "obvid/contour/bsplines.h"
#include "obvid/contour/clothoids.h"
#include "obvid/contour/conics.h"
#include "obvid/curve/bspline.h"
#include "obvid/geom/value_range.h"
#include "obvid/region/boundary_distance.h"

namespace obvid::pipeline_detail {
namespace {

/// A knot of a spline stands at a point when it is so near, in spans.
constexpr double kSameParameter = 1e-9;
constexpr double kParabolasOfLink = 4.0;
constexpr double kNoFigure = std::numeric_limits<double>::quiet_NaN();

Element element_of(const RegionPoint& p, double theta, double kappa) {
  return {p.point, theta, kappa};
}

class Constructions {
 public:
  Constructions(const RegionPart& part, std::optional<int> fixation)
      : part_(part), fixation_(fixation) {}

  Result<ConstructionTable> run(Construction which) {
    out_.construction = which;
    Result<void> done = which == Construction::kArcs        ? arcs()
                        : which == Construction::kEllipses  ? ellipses()
                        : which == Construction::kClothoids ? clothoids()
                        : which == Construction::kSpline    ? spline()
                                                            : parabolas();
    if (!done) return fail(done.error());
    return std::move(out_);
  }

 private:
  [[nodiscard]] std::string segment(const RegionRow& row) const {
    return fmt::format("points {} to {}", part_.points[row.from].number + 1,
                       part_.points[row.to].number + 1);
  }

  [[nodiscard]] Error no_region(const RegionRow& row) const {
    return {ErrorCode::kNoSpiral,
            "a segment has no region of monotone curves",
            segment(row),
            "choose headings inside the ranges of `obvid region`",
            static_cast<std::ptrdiff_t>(part_.points[row.from].number),
            0.0};
  }

  [[nodiscard]] Element start_of(const RegionRow& row) const {
    return element_of(part_.points[row.from], row.theta_start, part_.points[row.from].kappa);
  }
  [[nodiscard]] Element end_of(const RegionRow& row) const {
    return element_of(part_.points[row.to], row.theta_end, part_.points[row.to].kappa);
  }
  /// With the curvatures that bound the region.
  [[nodiscard]] static std::pair<Element, Element> bounded(Element a, Element b,
                                                           const RegionRow& row) {
    a.kappa = row.region->frame.kappa_start;
    b.kappa = row.region->frame.kappa_end;
    return {a, b};
  }

  /// Curvatures at the points, one each, between which arcs go one way along the whole contour:
  /// from point to point in the middle of what is left.
  [[nodiscard]] Result<std::vector<double>> common_curvatures() const {
    std::vector<RangeLink> links;
    std::vector<RangeNode> nodes;
    for (std::size_t i = 0; i < part_.points.size(); ++i) {
      const RegionPoint& p = part_.points[i];
      RangeNode node;
      node.theta = p.theta;
      if (p.kappa_given) node.kappa = p.kappa;
      if (p.curvatures && p.curvatures->low >= 0.0) node.curvature_sign = 1;
      if (p.curvatures && p.curvatures->high <= 0.0) node.curvature_sign = -1;
      nodes.push_back(node);
    }
    for (const RegionRow& row : part_.rows) {
      if (!row.region || row.from + 1 != row.to) return fail(no_region(row));
      const double omega = heading(row.region->along);
      const double alpha = std::remainder(row.theta_start - omega, 2.0 * std::numbers::pi);
      links.push_back({row.chord, row.theta_start - alpha, row.direction});
    }
    const auto central = central_data(links, nodes);
    if (!central) return fail(no_region(part_.rows.front()));
    std::vector<double> out;
    for (const RangeNode& node : *central) out.push_back(*node.kappa);
    return out;
  }

  Result<void> arcs() {
    out_.columns = {"R", "R'", "H", "error"};
    const auto kappa = common_curvatures();
    if (!kappa) return fail(kappa.error());
    bool grows = true;
    double before = kNoFigure;
    for (std::size_t k = 0; k < part_.rows.size(); ++k) {
      const RegionRow& row = part_.rows[k];
      Element a = start_of(row), b = end_of(row);
      a.kappa = (*kappa)[row.from];
      b.kappa = (*kappa)[row.to];
      const auto chosen = choose_biarc(chord_frame(a, b), *row.direction);
      if (!chosen) return fail(no_region(row));
      const auto pair = biarc(a, b, *chosen);
      const double d = *row.direction;
      grows = grows && d * chosen->first < d * chosen->second &&
              (std::isnan(before) || part_.rows[k - 1].direction != row.direction ||
               d * before <= d * chosen->first);
      before = chosen->second;
      ChordFrame own = chord_frame(a, b);
      own.kappa_start = chosen->first;
      own.kappa_end = chosen->second;
      const auto height = height_over_middle(own, pair);
      double error = 0.0;
      const auto [first, last] = bounded(a, b, row);
      for (const Piece& piece : pair) {
        if (const auto placed = place_in_region(piece, first, last, *row.direction)) {
          error = std::max(error, placed->farther);
        }
      }
      add(k, {1.0 / chosen->first, 1.0 / chosen->second, height, error}, "");
      for (const Piece& piece : pair) put(k, piece);
    }
    out_.remarks.emplace_back(grows ? "the radii go one way along every run"
                                    : "the radii do NOT go one way along every run");
    return {};
  }

  /// Of the arc that stands over the middle of the chord.
  [[nodiscard]] static double height_over_middle(const ChordFrame& frame,
                                                 const std::array<Piece, 2>& pair) {
    const Vec2 start = start_point(pair[0]), chord = end_point(pair[1]) - start;
    const Vec2 u = chord / frame.h;
    for (const Piece& piece : pair) {
      double low = 0.0, high = 1.0;
      const auto along = [&](double t) {
        return dot(u, evaluate(piece, t).point - start) - 0.5 * frame.h;
      };
      if (along(low) > 0.0 || along(high) < 0.0) continue;
      constexpr int kHalvings = 60;
      for (int n = 0; n < kHalvings; ++n) {
        const double t = 0.5 * (low + high);
        (along(t) < 0.0 ? low : high) = t;
      }
      return std::abs(cross(u, evaluate(piece, low).point - start));
    }
    return kNoFigure;
  }

  Result<void> ellipses() {
    out_.columns = {"w", "R", "R'", "f", "outside"};
    std::vector<Element> elements;
    for (const RegionRow& row : part_.rows) {
      if (!row.region) return fail(no_region(row));
      if (elements.empty()) elements.push_back(start_of(row));
      elements.push_back(end_of(row));
    }
    const RegionRow& first = part_.rows.front();
    const auto [a, b] = bounded(start_of(first), end_of(first), first);
    const auto weight = median_weight(a, b);
    if (!weight) return fail(no_region(first));
    const auto chain = conic_chain(elements, {weight});
    if (!chain) return fail(chain.error());
    for (std::size_t k = 0; k < part_.rows.size(); ++k) {
      const RegionRow& row = part_.rows[k];
      const auto [start, end] = bounded(start_of(row), end_of(row), row);
      const auto placed = place_in_region(Piece{chain->pieces[k]}, start, end, *row.direction);
      const int direction = conic_direction(chain->pieces[k]);
      const char* kind = chain->weights[k] < 1.0   ? "ellipse"
                         : chain->weights[k] > 1.0 ? "hyperbola"
                                                   : "parabola";
      const auto allowed = monotone_weights(start_of(row), end_of(row));
      std::string remark =
          fmt::format("{}, {}", kind, direction != 0 ? "monotone" : "vertex inside");
      if (direction == 0 && allowed) {
        remark += fmt::format("; none for w in {:.4g}..{:.4g}", allowed->low, allowed->high);
      } else if (direction == 0) {
        remark += "; with these tangents every ellipse arc has one";
      }
      add(k,
          {chain->weights[k], 1.0 / chain->elements[k].kappa, 1.0 / chain->elements[k + 1].kappa,
           placed ? placed->farther : kNoFigure, placed ? placed->outside : kNoFigure},
          std::move(remark));
      put(k, chain->pieces[k]);
    }
    out_.remarks.emplace_back(
        "the first arc passes K, in the middle of what the region cuts out of the median; equal "
        "curvature decides all others");
    return {};
  }

  Result<void> clothoids() {
    out_.columns = {"R", "R'", "length", "step"};
    std::vector<ClothoidPiece> made;
    for (std::size_t k = 0; k < part_.rows.size(); ++k) {
      const RegionRow& row = part_.rows[k];
      const auto one = clothoid_between(part_.points[row.from].point, row.theta_start,
                                        part_.points[row.to].point, row.theta_end);
      if (!one) return fail(no_region(row));
      made.push_back(*one);
    }
    double largest = 0.0;
    for (std::size_t k = 0; k < made.size(); ++k) {
      const double start = curvature(evaluate(Piece{made[k]}, 0.0));
      const double end = curvature(evaluate(Piece{made[k]}, 1.0));
      double step = kNoFigure;
      if (k + 1 < made.size()) {
        const double next = curvature(evaluate(Piece{made[k + 1]}, 0.0));
        step = next - end;
        largest = std::max(largest, std::abs(step) / std::max(std::abs(next), std::abs(end)));
      }
      const bool turns = start * end < 0.0;
      add(k, {1.0 / start, 1.0 / end, made[k].length, step}, turns ? "inflection inside" : "");
      put(k, made[k]);
    }
    out_.remarks.push_back(
        fmt::format("common tangents; curvature steps by up to {:.3g} % of the larger one: "
                    "`fit --carrier clothoids` joins three to a segment without steps",
                    100.0 * largest));
    return {};
  }

  /// The places of the points on the spline: summed chords, as it is made.
  Result<void> spline() {
    out_.columns = {"spans", "R", "R'", "f", "outside"};
    std::vector<Vec2> points;
    std::vector<double> headings, at;
    for (const RegionPoint& p : part_.points) {
      at.push_back(points.empty() ? 0.0 : at.back() + norm(p.point - points.back()));
      points.push_back(p.point);
      headings.push_back(p.theta);
    }
    const auto curve = spline_through_tangents(points, headings);
    if (!curve) return fail(curve.error());
    std::vector<BezierSpan> spans = bezier_spans(*curve);
    std::size_t vertices = 0;
    for (std::size_t k = 0, next = 0; k < part_.rows.size(); ++k) {
      const RegionRow& row = part_.rows[k];
      std::vector<RationalBezier> here;
      while (next < spans.size() && here.size() <= spans.size()) {
        const BezierSpan& span = spans[next];
        const double end = at[row.to], size = span.to - span.from;
        if (span.to <= end + kSameParameter * size) {
          here.push_back(span.piece);
          ++next;
          if (span.to >= end - kSameParameter * size) break;
          continue;
        }
        const auto halves = split(span.piece, (end - span.from) / size);
        here.push_back(halves[0]);
        spans[next] = {end, span.to, halves[1]};
        break;
      }
      if (here.empty()) return fail(no_region(row));
      vertices += add_spans(k, here);
    }
    out_.remarks.push_back(fmt::format(
        "C2 through all points and tangents; {} of its pieces have a vertex inside", vertices));
    return {};
  }

  /// Pieces of the spline over one segment; how many of them have a vertex.
  std::size_t add_spans(std::size_t k, const std::vector<RationalBezier>& spans) {
    const RegionRow& row = part_.rows[k];
    std::size_t vertices = 0;
    double farther = row.region ? 0.0 : kNoFigure, outside = farther;
    for (const RationalBezier& span : spans) {
      const Verdict verdict = prove_piece(Piece{span}).verdict;
      vertices += verdict == Verdict::kHasVertex ? 1 : 0;
      if (row.region) {
        const auto [a, b] = bounded(start_of(row), end_of(row), row);
        const auto placed = place_in_region(Piece{span}, a, b, *row.direction);
        farther = placed ? std::max(farther, placed->farther) : kNoFigure;
        outside = placed ? std::max(outside, placed->outside) : kNoFigure;
      }
      put(k, span);
    }
    const double start = curvature(evaluate(Piece{spans.front()}, 0.0));
    const double end = curvature(evaluate(Piece{spans.back()}, 1.0));
    add(k, {static_cast<double>(spans.size()), 1.0 / start, 1.0 / end, farther, outside},
        vertices > 0 ? "vertex inside" : "monotone");
    return vertices;
  }

  /// Curvatures by the mean of the triangles (order of fixation 1), where none are given and every
  /// segment has a curve with them; else those in the middle of what is left (order 2).
  Result<void> parabolas() {
    out_.columns = {"links", "parabolas", "k1", "k2", "d", "R", "R'", "error"};
    if (fixation_.value_or(1) == 1) {
      const auto by_triangles = triangle_curvatures().and_then(
          [&](const std::vector<double>& kappa) { return condensed(kappa); });
      if (by_triangles) {
        out_.remarks.emplace_back(
            "points and tangents are met (order of fixation 1); the radii are the means of those "
            "that the parabolas of both neighbouring triangles have");
        return {};
      }
      if (fixation_) return fail(by_triangles.error());
    }
    out_.rows.clear();
    out_.pieces.clear();
    out_.piece_row.clear();
    const auto kappa = common_curvatures();
    if (!kappa) return fail(kappa.error());
    if (auto done = condensed(*kappa); !done) return done;
    out_.remarks.emplace_back(
        "points, tangents and radii are met (order of fixation 2); radii that are not given stand "
        "in the middle of their ranges");
    return {};
  }

  /// Of a single run without given radii.
  [[nodiscard]] Result<std::vector<double>> triangle_curvatures() const {
    std::vector<Vec2> points;
    std::vector<double> headings;
    for (const RegionPoint& p : part_.points) {
      if (p.kappa_given) {
        return fail({ErrorCode::kBadOption, "a given radius is not free for order of fixation 1",
                     fmt::format("point {}", p.number + 1), "use --fixation 2",
                     static_cast<std::ptrdiff_t>(p.number), 0.0});
      }
      points.push_back(p.point);
      headings.push_back(p.theta);
    }
    for (const RegionRow& row : part_.rows) {
      if (!row.direction || row.direction != part_.rows.front().direction) {
        return fail({ErrorCode::kNoSpiral, "order of fixation 1 goes along one spiral",
                     segment(row), "use --fixation 2, or split the series there",
                     static_cast<std::ptrdiff_t>(part_.points[row.from].number), 0.0});
      }
    }
    const auto elements =
        elements_of_triangles(points, headings, part_.rows.front().direction.value_or(0));
    if (!elements) return fail(elements.error());
    std::vector<double> out;
    for (const Element& e : *elements) out.push_back(e.kappa);
    return out;
  }

  /// Each segment in one condensation; where none is monotone in parts: of the spiral between its
  /// elements.
  Result<void> condensed(const std::vector<double>& kappa) {
    for (std::size_t k = 0; k < part_.rows.size(); ++k) {
      const RegionRow& row = part_.rows[k];
      if (!row.region) return fail(no_region(row));
      Element a = start_of(row), b = end_of(row);
      a.kappa = kappa[row.from];
      b.kappa = kappa[row.to];
      std::vector<RationalBezier> made;
      double links = 1.0, k1 = kNoFigure, k2 = kNoFigure, shift = kNoFigure;
      if (const auto one = condense(a, b, *row.direction)) {
        made.assign(one->parabolas.begin(), one->parabolas.end());
        k1 = one->k1;
        k2 = one->k2;
        shift = one->shift;
      } else {
        auto parts = condensed_spiral(a, b, *row.direction);
        if (!parts) {
          Error error = parts.error();
          error.where = segment(row);
          error.index = static_cast<std::ptrdiff_t>(part_.points[row.from].number);
          return fail(std::move(error));
        }
        made = std::move(*parts);
        links = static_cast<double>(made.size()) / kParabolasOfLink;
      }
      double error = 0.0;
      const auto [first, last] = bounded(a, b, row);
      for (const RationalBezier& parabola : made) {
        const auto placed = place_in_region(Piece{parabola}, first, last, *row.direction);
        if (placed) error = std::max(error, placed->farther);
        put(k, parabola);
      }
      add(k,
          {links, static_cast<double>(made.size()), k1, k2, shift, 1.0 / a.kappa, 1.0 / b.kappa,
           error},
          links > 1.0 ? factors_text(made, *row.direction) : "");
    }
    return {};
  }

  /// Ranges of the factors k1 and k2 over a chain of condensations, each formed again between the
  /// elements that it meets.
  static std::string factors_text(const std::vector<RationalBezier>& made, int direction) {
    const auto element = [](const RationalBezier& parabola, double t) {
      const Jet jet = evaluate(parabola, t);
      return Element{jet.point, std::atan2(jet.d1.y, jet.d1.x), curvature(jet)};
    };
    std::optional<ValueRange> first, second;
    const auto widen = [](std::optional<ValueRange>& range, double value) {
      if (!range) range = ValueRange{value, value};
      range->low = std::min(range->low, value);
      range->high = std::max(range->high, value);
    };
    for (std::size_t i = 0; i + 3 < made.size(); i += 4) {
      const auto one = condense(element(made[i], 0.0), element(made[i + 3], 1.0), direction);
      if (!one) return "";
      widen(first, one->k1);
      widen(second, one->k2);
    }
    if (!first || !second) return "";
    return fmt::format("{} condensations: k1 {:.4g} to {:.4g}, k2 {:.4g} to {:.4g}",
                       made.size() / 4, first->low, first->high, second->low, second->high);
  }

  static Result<std::vector<RationalBezier>> condensed_spiral(const Element& a, const Element& b,
                                                              int direction) {
    DirectedSeries link;
    link.points = {a.point, b.point};
    link.source = {std::size_t{0}, std::size_t{1}};
    link.direction = {static_cast<std::int8_t>(direction)};
    link.nodes = {{a.theta, a.kappa, 0}, {b.theta, b.kappa, 0}};
    link.start = {a, b};
    link.to_the_edge = true;
    Watch nobody;
    const std::vector<Vec2> points = link.points;
    const auto chain = follow_directions(std::move(link), nobody);
    if (!chain) return fail(chain.error());
    const auto spirals = form_spirals(points, *chain);
    if (!spirals) return fail(spirals.error());
    std::vector<RationalBezier> out;
    for (const Piece& piece : spirals->pieces) {
      const auto parts = condense_piece(piece, direction, std::numeric_limits<double>::max());
      if (!parts) return fail(parts.error());
      out.insert(out.end(), parts->parabolas.begin(), parts->parabolas.end());
    }
    return out;
  }

  void put(std::size_t row, Piece piece) {
    out_.pieces.push_back(std::move(piece));
    out_.piece_row.push_back(row);
  }

  void add(std::size_t k, std::vector<double> values, std::string remark) {
    out_.rows.push_back({k, std::move(values), std::move(remark)});
  }

  const RegionPart& part_;
  std::optional<int> fixation_;
  ConstructionTable out_;
};

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
  return Constructions(part, fixation).run(which);
}

}  // namespace obvid::pipeline_detail
