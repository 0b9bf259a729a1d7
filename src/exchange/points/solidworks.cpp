// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/points/solidworks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "obvid/contour/conics.h"
#include "obvid/core/internal/format_into.h"

namespace obvid {
namespace {

/// Runs as ranges of pieces; the whole contour where it has none.
std::vector<Run> runs_of(const Contour& contour) {
  if (!contour.runs.empty()) return contour.runs;
  return {{0, contour.pieces.size() - 1, 0}};
}

std::span<const Piece> pieces_of(const Contour& contour, const Run& run) {
  return std::span(contour.pieces).subspan(run.first_piece, run.last_piece - run.first_piece + 1);
}

/// Statements of the macro.
class Macro {
 public:
  Macro(const Contour& contour, const SampleOptions& options, double metres, Watch* watch)
      : contour_(contour), options_(options), scale_(metres), watch_(watch) {}

  Result<std::string> run() {
    out_ =
        "' Draws an Obvid contour into the active sketch. Tools > Macro > Edit, take this file\n"
        "' (.swb; a .bas is imported in the editor: File > Import File), then Run (F5).\n"
        "Dim swApp As Object\nDim model As Object\nDim sketch As Object\nDim item As Object\n"
        "Dim points() As Double\n\nSub main()\n"
        "  Set swApp = Application.SldWorks\n  Set model = swApp.ActiveDoc\n"
        "  Set sketch = model.SketchManager\n  sketch.AddToDB = True\n";
    for (const Run& run : runs_of(contour_)) {
      OBVID_TRY(add(run));
    }
    return out_ + "  sketch.AddToDB = False\n  model.GraphicsRedraw2\nEnd Sub\n";
  }

 private:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    format_into(out_, format, std::forward<Args>(args)...);
  }
  [[nodiscard]] std::string xyz(Vec2 p) const {
    return fmt::format("{}, {}, 0#", scale_ * p.x, scale_ * p.y);
  }

  Result<void> add(const Run& run) {
    std::vector<Piece> splines;  // neighbours that become one spline
    for (const Piece& piece : pieces_of(contour_, run)) {
      if (!exact(piece)) {
        splines.push_back(piece);
        continue;
      }
      OBVID_TRY(spline(splines));
      splines.clear();
      draw(piece);
    }
    return spline(splines);
  }

  [[nodiscard]] static bool exact(const Piece& piece) {
    const auto* bezier = std::get_if<RationalBezier>(&piece);
    if (bezier != nullptr) return bezier->degree == 2 && ellipse_of(*bezier).has_value();
    return !std::holds_alternative<ClothoidPiece>(piece);
  }

  void draw(const Piece& piece) {
    if (const auto* line = std::get_if<LinePiece>(&piece)) {
      add("  Set item = sketch.CreateLine({}, {})\n", xyz(line->start), xyz(line->end));
    } else if (const auto* arc = std::get_if<ArcPiece>(&piece)) {
      const Vec2 centre = arc->start + left_normal(unit_at(arc->theta0)) / arc->kappa;
      add("  Set item = sketch.CreateArc({}, {}, {}, {})\n", xyz(centre), xyz(arc->start),
          xyz(arc->end), arc->kappa > 0.0 ? 1 : -1);
    } else {
      const Ellipse e = *ellipse_of(std::get<RationalBezier>(piece));
      const Vec2 axis = unit_at(e.rotation);
      // arcs of ellipses run counter-clockwise
      const bool forward = e.to > e.from;
      const Vec2 start = start_point(piece), end = end_point(piece);
      add("  Set item = sketch.CreateEllipticalArc({}, {}, {}, {}, {}, 1)\n", xyz(e.centre),
          xyz(e.centre + e.semi_major * axis), xyz(e.centre + e.semi_minor * left_normal(axis)),
          xyz(forward ? start : end), xyz(forward ? end : start));
    }
  }

  Result<void> spline(const std::vector<Piece>& pieces) {
    if (pieces.empty()) return {};
    const auto samples = sample(pieces, options_, watch_);
    OBVID_TRY(samples);
    add("  ReDim points({})\n", 3 * samples->size() - 1);
    for (std::size_t i = 0; i < samples->size(); ++i) {
      const Vec2 p = (*samples)[i].point;
      add("  points({}) = {}: points({}) = {}: points({}) = 0#\n", 3 * i, scale_ * p.x, 3 * i + 1,
          scale_ * p.y, 3 * i + 2);
    }
    out_ += "  Set item = sketch.CreateSpline2(points, True)\n";
    return {};
  }

  const Contour& contour_;
  const SampleOptions& options_;
  double scale_;
  Watch* watch_;
  std::string out_;
};

}  // namespace

Result<std::vector<SldcrvFile>> sldcrv_files(const Contour& contour, const SampleOptions& options,
                                             Watch* watch) {
  if (contour.pieces.empty()) {
    return error(ErrorCode::kNothingThere, "the contour has no pieces");
  }
  std::vector<SldcrvFile> out;
  const std::vector<Run> runs = runs_of(contour);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const auto samples = sample(pieces_of(contour, runs[r]), options, watch);
    OBVID_TRY(samples);
    SldcrvFile file{runs.size() == 1 ? "" : "-" + std::to_string(r + 1), {}};
    const CurveSample* before = nullptr;
    for (const CurveSample& one : *samples) {
      if (before != nullptr && before->point == one.point) continue;
      format_into(file.text, "{} {} 0\n", one.point.x, one.point.y);
      before = &one;
    }
    out.push_back(std::move(file));
  }
  return out;
}

Result<std::string> solidworks_macro(const Contour& contour, const SampleOptions& options,
                                     Watch* watch) {
  if (contour.pieces.empty()) {
    return error(ErrorCode::kNothingThere, "the contour has no pieces");
  }
  const auto metres = unit_ratio(contour.units, "m", "macros of SolidWorks");
  OBVID_TRY(metres);
  return Macro(contour, options, *metres, watch).run();
}

}  // namespace obvid
