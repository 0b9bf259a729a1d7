// SPDX-License-Identifier: Apache-2.0
#include "region/construction_section.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "fit/form.h"
#include "obvid/chain/internal/series_chain.h"
#include "obvid/contour/spirals/over_chain.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/numeric/internal/halving.h"
#include "obvid/pipeline/internal/region_files.h"
#include "obvid/region/internal/feasible_data.h"

namespace obvid::pipeline_detail {
namespace {

/// Turning over a chord below which its curvature is rounding: rad.
constexpr double kStraightTurn = 1e-9;
constexpr int kInflectionHalvings = 60;  // to the last bit of the parameter

RangeNode range_node(const RegionPoint& p) {
  RangeNode node;
  node.theta = p.theta;
  if (p.kappa_given) node.kappa = p.kappa;
  if (p.curvatures && p.curvatures->low >= 0.0) node.curvature_sign = 1;
  if (p.curvatures && p.curvatures->high <= 0.0) node.curvature_sign = -1;
  return node;
}

double middle_omega(const RegionRow& row) {
  const double omega = heading(row.region->along);
  return nearest_angle(omega, row.theta_start);
}

}  // namespace

Element ConstructionSection::start_of(std::size_t k) const {
  const RegionPoint& p = point(row(k).from);
  return {p.point, row(k).theta_start, p.kappa};
}

Element ConstructionSection::end_of(std::size_t k) const {
  const RegionPoint& p = point(row(k).to);
  return {p.point, row(k).theta_end, p.kappa};
}

std::pair<Element, Element> ConstructionSection::bounded(std::size_t k) const {
  Element a = start_of(k), b = end_of(k);
  a.kappa = row(k).region->frame.kappa_start;
  b.kappa = row(k).region->frame.kappa_end;
  return {a, b};
}

std::string ConstructionSection::segment(std::size_t k) const {
  return fmt::format("points {} to {}", region_point_name(point(row(k).from)),
                     region_point_name(point(row(k).to)));
}

Error ConstructionSection::no_region(std::size_t k) const {
  const char *what = "a segment has no region of monotone curves",
             *hint = "choose headings inside the ranges of `obvid region`";
  if (!row(k).direction) {
    what = "a vertex lies inside a segment: it has no region of monotone curves";
    hint = "put a point where the curvature is largest or least there, or mark a corner";
  } else if (*row(k).direction == 0) {
    what = "the points lie on one circle there: a segment has an arc, and no region";
    hint = row(k).kappa_start
               ? "use `fit` without --construction, or leave points of the circle out"
               : "give a heading at one of them that is not the circle's, as "
                 "--start-heading, or use `fit` without --construction";
  }
  return error(ErrorCode::kNoSpiral, what)
      .where(segment(k))
      .hint(hint)
      .point(point(row(k).from).number);
}

std::vector<ConstructionSection> sections_of(const RegionPart& part) {
  std::vector<ConstructionSection> out;
  for (std::size_t k = 0; k < part.rows.size(); ++k) {
    if (k == 0 || part.rows[k - 1].to != part.rows[k].from) {
      out.push_back({&part, k, k, part.loop});
    }
    out.back().last = k + 1;
  }
  return out;
}

Result<std::vector<double>> common_curvatures(const ConstructionSection& section,
                                              const std::vector<std::optional<double>>& wanted) {
  std::vector<RangeLink> links;
  std::vector<RangeNode> nodes;
  for (std::size_t k = section.first; k < section.last; ++k) {
    const RegionRow& row = section.row(k);
    if (!row.region) return fail(section.no_region(k));
    links.push_back({row.chord, middle_omega(row), row.direction});
    nodes.push_back(range_node(section.point(row.from)));
  }
  if (!section.loop) nodes.push_back(range_node(section.point(section.row(section.last - 1).to)));
  const auto central =
      section.loop ? central_loop(links, nodes, wanted) : central_data(links, nodes, wanted);
  if (!central) {
    const RegionPoint& from = section.point(section.first_point());
    const RegionPoint& to = section.point(section.row(section.last - 1).to);
    return error(ErrorCode::kNoSpiral,
                 "with these headings no radii at the points leave monotone curves on all segments")
        .where(fmt::format("points {} to {}", from.number + 1, to.number + 1))
        .hint("choose headings inside the ranges of `obvid region`")
        .point(from.number);
  }
  std::vector<double> out;
  for (const RangeNode& node : *central) out.push_back(*node.kappa);
  return out;
}

Result<std::vector<Piece>> spirals_between(const Element& start, const Element& end,
                                           int direction) {
  DirectedSeries link;
  link.points = {start.point, end.point};
  link.source = {std::size_t{0}, std::size_t{1}};
  link.direction = {static_cast<std::int8_t>(direction)};
  link.nodes = {{start.theta, start.kappa, 0}, {end.theta, end.kappa, 0}};
  link.start = {start, end};
  link.to_the_edge = true;
  Watch nobody;
  const std::vector<Vec2> points = link.points;
  const auto chain = follow_directions(std::move(link), nobody);
  OBVID_TRY(chain);
  auto spirals = spirals_over(points, *chain);
  OBVID_TRY(spirals);
  return std::move(spirals->pieces);
}

Result<Element> inflection_between(const Element& start, const Element& end, int direction) {
  if (start.kappa == 0.0) return start;
  if (end.kappa == 0.0) return end;
  const auto spirals = spirals_between(start, end, direction);
  OBVID_TRY(spirals);
  const auto kappa = [](const Piece& piece, double t) { return curvature(evaluate(piece, t)); };
  for (const Piece& piece : *spirals) {
    if (kappa(piece, 1.0) * end.kappa < 0.0) continue;
    const auto before = [&](double t) { return !(kappa(piece, t) * end.kappa > 0.0); };
    Element found =
        element_at(piece, end_of_condition(0.0, 1.0, before, kInflectionHalvings).holds);
    found.theta = nearest_angle(found.theta, start.theta);
    found.kappa = 0.0;
    return found;
  }
  return end;
}

bool is_straight(double kappa, double chord) { return std::abs(kappa) * chord <= kStraightTurn; }

void put_piece(ConstructionTable& table, std::size_t row, Piece piece) {
  table.pieces.push_back(std::move(piece));
  table.piece_row.push_back(row);
}

void add_row(ConstructionTable& table, std::size_t row, std::vector<double> values,
             std::string remark) {
  table.rows.push_back({row, false, std::move(values), std::move(remark)});
}

}  // namespace obvid::pipeline_detail
