// SPDX-License-Identifier: Apache-2.0
// Condensed triangles of [001] with their steps: docs/methods/beziers.md, sections 2 to 5.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "obvid/contour/beziers.h"
#include "obvid/pipeline/internal/region_files.h"
#include "obvid/region/internal/boundary_distance.h"
#include "region/construction_section.h"

namespace obvid::pipeline_detail {
namespace {

constexpr std::size_t kParabolasOfLink = 4;

/// A part of a segment without inflection, to be condensed.
struct Bend {
  Element start, end;
};

/// Condensations of one part, one behind the other.
using Links = std::vector<Condensation>;

Element end_of_parabola(const RationalBezier& parabola, double t) {
  const Jet jet = evaluate(parabola, t);
  return {jet.point, std::atan2(jet.d1.y, jet.d1.x), curvature(jet)};
}

/// Elements of the spiral between both ends, each part between two of which can be condensed.
Result<std::vector<Element>> elements_along(const Bend& bend, int direction) {
  const auto spirals = spirals_between(bend.start, bend.end, direction);
  if (!spirals) return fail(spirals.error());
  std::vector<Element> out{bend.start};
  for (std::size_t k = 0; k < spirals->size(); ++k) {
    const Piece& piece = (*spirals)[k];
    const Element end = k + 1 == spirals->size() ? bend.end : element_at(piece, 1.0);
    const auto chain =
        condense_piece(piece, out.back(), end, direction, std::numeric_limits<double>::max());
    if (!chain) return fail(chain.error());
    for (std::size_t i = 1; i + 1 < chain->at.size(); ++i) {
      out.push_back(element_at(piece, chain->at[i]));
    }
    out.push_back(end);
  }
  return out;
}

/// In one condensation; where none is monotone in several, of the spiral between the elements.
Result<Links> condensed(const Bend& bend, int direction) {
  if (const auto one = condense(bend.start, bend.end, direction)) return Links{*one};
  const auto along = elements_along(bend, direction);
  if (!along) return fail(along.error());
  Links out;
  for (std::size_t i = 0; i + 1 < along->size(); ++i) {
    const auto link = condense((*along)[i], (*along)[i + 1], direction);
    if (!link) {
      return fail({ErrorCode::kToleranceNotReached,
                   "rounding decides whether a chain of parabolas is monotone", "",
                   "curvature hardly changes there: an arc or another carrier does it", -1, 0.0});
    }
    out.push_back(*link);
  }
  return out;
}

class CondensedTriangles {
 public:
  explicit CondensedTriangles(bool by_triangles) : by_triangles_(by_triangles) {
    out_.construction = Construction::kParabolas;
    out_.columns = {"links", "parabolas", "k1", "k2", "d", "x", "y", "R", "R'", "error"};
  }

  Result<void> add(const ConstructionSection& section) {
    std::vector<std::optional<double>> wanted;
    if (by_triangles_) {
      auto means = triangle_curvatures(section);
      if (!means) return fail(means.error());
      wanted = std::move(*means);
    }
    const ConstructionTable before = out_;
    while (true) {
      const auto failed = form(section, wanted);
      if (!failed) return {};
      out_ = before;
      if (!let_go(wanted, failed->segment)) return fail(failed->why);
    }
  }

  /// Whether the triangles' radii did everywhere.
  [[nodiscard]] bool as_wanted() const { return moved_.empty(); }

  ConstructionTable told() {
    out_.remarks.emplace_back(
        by_triangles_ ? "points and tangents are met (order of fixation 1); the radii are the "
                        "means of those that the parabolas of both neighbouring triangles have"
                      : "points, tangents and radii are met (order of fixation 2); radii that are "
                        "not given stand in the middle of their ranges");
    if (!moved_.empty()) {
      out_.remarks.push_back(fmt::format(
          "at {} {} the mean is missing or was given up so that all segments have monotone "
          "parabolas: the radius is taken inside its range",
          moved_.size() == 1 ? "point" : "points", fmt::join(moved_, ", ")));
    }
    if (inflection_) {
      out_.remarks.emplace_back(
          "no parabola has curvature 0: at an inflection the curvature steps (G1), by half of what "
          "the tangents allow on each side");
    }
    return std::move(out_);
  }

 private:
  /// A segment that was not condensed; nothing: radii for all points were not found.
  struct Failure {
    std::optional<std::size_t> segment;  ///< counted from the first of the section
    Error why;
  };

  std::optional<Failure> form(const ConstructionSection& section,
                              const std::vector<std::optional<double>>& wanted) {
    const auto kappa = common_curvatures(section, wanted);
    if (!kappa) return Failure{std::nullopt, kappa.error()};
    for (std::size_t k = section.first; k < section.last; ++k) {
      const std::size_t i = k - section.first;
      const auto done = add_segment(section, k, (*kappa)[i], (*kappa)[i + 1]);
      if (!done) return Failure{i, done.error()};
    }
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (section.loop && i + 1 == wanted.size()) break;
      if (wanted[i] == (*kappa)[i]) continue;
      moved_.push_back(region_point_name(section.point(section.first_point() + i)));
    }
    return std::nullopt;
  }

  /// Means beside the failed segment give way to the middles of ranges, or else all; false when
  /// there are none.
  static bool let_go(std::vector<std::optional<double>>& wanted,
                     std::optional<std::size_t> segment) {
    const auto given = [](const std::optional<double>& kappa) { return kappa.has_value(); };
    if (std::none_of(wanted.begin(), wanted.end(), given)) return false;
    const bool beside = segment && (wanted[*segment] || wanted[*segment + 1]);
    if (beside) {
      wanted[*segment] = wanted[*segment + 1] = std::nullopt;
    } else {
      std::fill(wanted.begin(), wanted.end(), std::nullopt);
    }
    return true;
  }

  static Result<std::vector<std::optional<double>>> triangle_curvatures(
      const ConstructionSection& section) {
    std::vector<Vec2> points;
    std::vector<double> headings;
    for (std::size_t i = 0; i < section.points(); ++i) {
      const RegionPoint& p = section.point(section.first_point() + i);
      if (p.kappa_given) {
        return fail({ErrorCode::kBadOption, "a given radius is not free for order of fixation 1",
                     fmt::format("point {}", p.number + 1), "use --fixation 2",
                     static_cast<std::ptrdiff_t>(p.number), 0.0});
      }
      points.push_back(p.point);
      headings.push_back(p.theta);
    }
    return curvatures_of_triangles(points, headings, section.loop);
  }

  /// One or two parts without inflection.
  static Result<std::vector<Bend>> bends(const Element& a, const Element& b, int direction) {
    const double chord = norm(b.point - a.point);
    Element start = a, end = b;
    if (is_straight(start.kappa, chord)) start.kappa = 0.0;
    if (is_straight(end.kappa, chord)) end.kappa = 0.0;
    if (start.kappa == 0.0 && end.kappa == 0.0) {
      return fail({ErrorCode::kNoSpiral, "a segment is straight within rounding: no parabola is",
                   "", "leave points of the line out, or use `fit` without --construction", -1,
                   0.0});
    }
    if (start.kappa * end.kappa > 0.0) return std::vector<Bend>{{start, end}};
    const auto middle = inflection_between(start, end, direction);
    if (!middle) return fail(middle.error());
    std::vector<Bend> out;
    if (start.kappa != 0.0) {
      out.push_back({start, *middle});
      out.back().end.kappa = towards_inflection(out.back(), direction, true);
    }
    if (end.kappa != 0.0) {
      out.push_back({*middle, end});
      out.back().start.kappa = towards_inflection(out.back(), direction, false);
    }
    return out;
  }

  /// Curvature of the end without one: half of what a biarc from the other end has there, which is
  /// the most that a spiral may have ([Kurnosenko 2013]; docs/methods/region.md).
  static double towards_inflection(const Bend& bend, int direction, bool at_end) {
    const Vec2 chord = bend.end.point - bend.start.point;
    const double d = direction, half = 0.5 * norm(chord);
    const double alpha = d * turning(chord, unit_at(bend.start.theta));
    const double beta = d * turning(chord, unit_at(bend.end.theta));
    const double sine = std::sin(0.5 * (alpha + beta));
    const double a = d * bend.start.kappa * half + std::sin(alpha);
    const double b = d * bend.end.kappa * half - std::sin(beta);
    const double most =
        at_end ? std::sin(beta) - sine * sine / a : -std::sin(alpha) - sine * sine / b;
    return 0.5 * d * most / half;
  }

  Result<void> add_segment(const ConstructionSection& section, std::size_t k, double start,
                           double end) {
    const RegionRow& row = section.row(k);
    const int direction = *row.direction;
    Element a = section.start_of(k), b = section.end_of(k);
    a.kappa = start;
    b.kappa = end;
    const auto named = [&](Error error) {
      error.where = section.segment(k);
      error.index = static_cast<std::ptrdiff_t>(section.point(row.from).number);
      return fail(std::move(error));
    };
    const auto parts = bends(a, b, direction);
    if (!parts) return named(parts.error());
    Links links;
    std::string remark;
    for (std::size_t n = 0; n < parts->size(); ++n) {
      const auto made = condensed((*parts)[n], direction);
      if (!made) return named(made.error());
      links.insert(links.end(), made->begin(), made->end());
      if (n > 0) remark = step_text((*parts)[n - 1].end.kappa, (*parts)[n].start.kappa);
    }
    if (parts->front().start.kappa != start || parts->back().end.kappa != end) inflection_ = true;
    if (!remark.empty()) inflection_ = true;
    put_segment(section, k, links, std::move(remark));
    return {};
  }

  static std::string step_text(double before, double behind) {
    return fmt::format("at the inflection the curvature steps from {:.4g} to {:.4g}", before,
                       behind);
  }

  void put_segment(const ConstructionSection& section, std::size_t k, const Links& links,
                   std::string remark) {
    const auto [first, last] = section.bounded(k);
    const int direction = *section.row(k).direction;
    double error = 0.0;
    for (const Condensation& link : links) {
      for (const RationalBezier& parabola : link.parabolas) {
        const auto placed = place_in_region(Piece{parabola}, first, last, direction);
        if (placed) error = std::max(error, placed->farther);
        put_piece(out_, k, parabola);
      }
    }
    const bool one = links.size() == 1;
    if (!one) remark = range_text(links) + (remark.empty() ? "" : "; " + remark);
    const auto count = static_cast<double>(links.size());
    const Condensation& only = links.front();
    add_row(out_, k,
            {count, count * kParabolasOfLink, one ? only.k1 : kNoFigure, one ? only.k2 : kNoFigure,
             one ? only.shift : kNoFigure, kNoFigure, kNoFigure,
             1.0 / end_of_parabola(links.front().parabolas.front(), 0.0).kappa,
             1.0 / end_of_parabola(links.back().parabolas.back(), 1.0).kappa, error},
            std::move(remark));
    for (std::size_t n = 0; n < links.size(); ++n) put_steps(k, links[n], one ? 0 : n + 1);
  }

  /// The point of each step; `number` of the link, 0 when it is the only one.
  void put_steps(std::size_t k, const Condensation& link, std::size_t number) {
    const std::string of = number > 0 ? fmt::format("link {}, ", number) : "";
    if (number > 1) {
      const Element start = end_of_parabola(link.parabolas[0], 0.0);
      add_step(k, kNoFigure, kNoFigure, kNoFigure, start.point, 1.0 / start.kappa,
               1.0 / start.kappa, of + "its start");
    }
    // the second step has k1 times the radii of the first on one side, k2 times on the other
    const Element touch = end_of_parabola(link.parabolas[1], 1.0);
    const double radius = 1.0 / touch.kappa;
    add_step(k, kNoFigure, kNoFigure, link.shift, touch.point, radius / link.k1, radius / link.k2,
             of + "step 1");
    const Element before = end_of_parabola(link.parabolas[0], 1.0);
    add_step(k, link.k1, kNoFigure, kNoFigure, before.point, 1.0 / before.kappa, 1.0 / before.kappa,
             of + "step 2, before it");
    const Element behind = end_of_parabola(link.parabolas[2], 1.0);
    add_step(k, kNoFigure, link.k2, kNoFigure, behind.point, 1.0 / behind.kappa, 1.0 / behind.kappa,
             of + "step 2, behind it");
  }

  void add_step(std::size_t k, double k1, double k2, double shift, Vec2 p, double radius_before,
                double radius_behind, std::string remark) {
    add_row(
        out_, k,
        {kNoFigure, kNoFigure, k1, k2, shift, p.x, p.y, radius_before, radius_behind, kNoFigure},
        std::move(remark));
    out_.rows.back().detail = true;
  }

  static std::string range_text(const Links& links) {
    const auto range = [&](double Condensation::*factor) {
      double low = links.front().*factor, high = low;
      for (const Condensation& link : links) {
        low = std::min(low, link.*factor);
        high = std::max(high, link.*factor);
      }
      return fmt::format("{:.4g} to {:.4g}", low, high);
    };
    return fmt::format("{} condensations: k1 {}, k2 {}", links.size(), range(&Condensation::k1),
                       range(&Condensation::k2));
  }

  bool by_triangles_;
  std::vector<std::string> moved_;  // points whose radius is not that of the triangles
  bool inflection_ = false;
  ConstructionTable out_;
};

}  // namespace

Result<ConstructionTable> condensed_triangles(const std::vector<ConstructionSection>& sections,
                                              std::optional<int> fixation) {
  const auto made = [&](bool by_triangles) -> Result<CondensedTriangles> {
    CondensedTriangles maker(by_triangles);
    for (const ConstructionSection& section : sections) {
      if (auto done = maker.add(section); !done) return fail(done.error());
    }
    return maker;
  };
  if (fixation.value_or(1) == 1) {
    auto by_triangles = made(true);
    if (by_triangles && (fixation || by_triangles->as_wanted())) return by_triangles->told();
    if (fixation) return fail(by_triangles.error());
  }
  auto by_ranges = made(false);
  if (!by_ranges) return fail(by_ranges.error());
  return by_ranges->told();
}

}  // namespace obvid::pipeline_detail
