// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/analyse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <variant>

#include "obvid/core/internal/figures.h"
#include "obvid/curve/internal/piece_box.h"
#include "obvid/pipeline/import.h"

namespace obvid {
namespace {

/// What the points of the chosen series say; a warning instead where they say nothing.
std::optional<AnalysedSeries> analysed(Drawing& drawing, std::size_t number) {
  PointSeries series = drawing.series[number];
  series.fixed.clear();  // of maps: heights, which alignments take
  series.units = drawing.units;
  auto analysis = analyse(series.points);
  if (!analysis) {
    drawing.warnings.push_back(fmt::format("{}: {}", series.name, analysis.error().what));
    return std::nullopt;
  }
  add_rounding_warning(series, *analysis);
  drawing.warnings.insert(drawing.warnings.end(), series.warnings.begin(), series.warnings.end());
  return AnalysedSeries{std::move(series), std::move(*analysis)};
}

bool is_circle(const std::vector<Piece>& pieces) {
  constexpr double kSame = 1e-9;  // of the curvature
  const auto* first = std::get_if<ArcPiece>(&pieces.front());
  return first != nullptr && std::all_of(pieces.begin(), pieces.end(), [&](const Piece& piece) {
           const auto* arc = std::get_if<ArcPiece>(&piece);
           return arc != nullptr &&
                  std::abs(arc->kappa - first->kappa) <= kSame * std::abs(first->kappa);
         });
}

/// "4 lines and 4 arcs"; what is alone has no number.
std::string kind_of(const std::vector<Piece>& pieces, bool closed,
                    const std::vector<PlacedTransition>& placed, std::size_t arcs_more) {
  if (pieces.empty()) return "nothing";
  if (closed && is_circle(pieces)) return "circle";
  std::size_t lines = 0, arcs = 0, clothoids = 0;
  for (const Piece& piece : pieces) {
    lines += std::holds_alternative<LinePiece>(piece) ? 1 : 0;
    arcs += std::holds_alternative<ArcPiece>(piece) ? 1 : 0;
    clothoids += std::holds_alternative<ClothoidPiece>(piece) ? 1 : 0;
  }
  const std::size_t splines = pieces.size() - lines - arcs - clothoids;
  arcs -= std::min(arcs, arcs_more);
  // clothoids that stand for other transitions are these
  std::map<Transition, std::size_t> transitions;
  for (const PlacedTransition& one : placed) {
    clothoids -= one.pieces;
    ++transitions[one.kind];
  }
  if (splines == pieces.size()) return "spline";
  std::vector<std::string> parts;
  const auto add = [&](std::size_t count, const char* one, const char* many) {
    if (count == 0) return;
    parts.push_back(pieces.size() == 1 + arcs_more ? one : counted(count, one, many));
  };
  add(lines, "line", "lines");
  add(arcs, "arc", "arcs");
  add(clothoids, "clothoid", "clothoids");
  for (const auto& [kind, count] : transitions) {
    const std::string name = std::string(name_of(kind)) + " transition";
    add(count, name.c_str(), (name + "s").c_str());
  }
  add(splines, "span of a spline", "spans of splines");
  std::string out;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    out += (i == 0 ? "" : i + 1 == parts.size() ? " and " : ", ") + parts[i];
  }
  return out;
}

}  // namespace

Result<AnalysedDrawing> analyse_drawing(Drawing drawing, const ImportOptions& options,
                                        const std::string& where, const RunContext& run) {
  place(options.placement, drawing);
  const auto chosen = chosen_curve(drawing, options.curve, where);
  if (!chosen && options.curve.asked()) return fail(chosen.error());
  AnalysedDrawing out{std::move(drawing), {}, {}, {}};
  if (options.curve.asked()) out.asked = *chosen;
  for (const DrawnCurve& one : out.drawing.curves) {
    OBVID_TRY(tell(
        run, "curves",
        static_cast<double>(out.audits.size()) / static_cast<double>(out.drawing.curves.size())));
    auto audited = audit(one, out.drawing.units, run);
    OBVID_TRY(audited);
    audited->layer = one.layer;
    out.audits.push_back(std::move(*audited));
  }
  const std::size_t curves = out.audits.size();
  if (chosen && *chosen >= curves) out.points = analysed(out.drawing, *chosen - curves);
  return out;
}

void add_rounding_warning(PointSeries& series, const Analysis& analysis) {
  if (analysis.rounding_decided.empty()) return;
  const std::size_t first = analysis.rounding_decided.front();
  series.warnings.push_back(fmt::format(
      "the rounding of the coordinates decides which way curvature changes on {}, first between "
      "points {} and {}",
      counted(analysis.rounding_decided.size(), "chord", "chords"), first + 1, first + 2));
}

DrawnFigures figures_of(const PointSeries& series) {
  constexpr const char* kSeriesKinds[] = {"points", "route", "single points", "waypoints"};
  const std::vector<Vec2>& points = series.points;
  DrawnFigures out;
  out.kind = kSeriesKinds[static_cast<int>(series.kind)];
  out.points = points.size();
  if (points.empty()) return out;
  for (std::size_t i = 1; i < points.size(); ++i) out.length += norm(points[i] - points[i - 1]);
  out.closed = points.size() > 2 && points.front() == points.back();
  Box2 box;
  for (const Vec2 p : points) box.add(p);
  out.low = box.low;
  out.high = box.high;
  return out;
}

DrawnFigures figures_of(const CurveAudit& audit) {
  const Contour& contour = audit.contour;
  DrawnFigures out;
  out.kind = kind_of(contour.pieces, contour.closed, audit.transitions, audit.arcs_more);
  out.pieces = elements_in(contour.pieces.size(), audit.transitions) - audit.arcs_more;
  out.points = out.pieces + (contour.closed ? 0 : 1);
  out.length = audit.length;
  out.closed = contour.closed;
  if (contour.pieces.empty()) return out;
  Box2 box;
  for (const Piece& piece : contour.pieces) add_piece(box, piece);
  out.low = box.low;
  out.high = box.high;
  return out;
}

}  // namespace obvid
