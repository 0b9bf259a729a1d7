// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/compare_curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <utility>
#include <variant>

#include "obvid/core/files.h"
#include "obvid/core/internal/figures.h"
#include "obvid/curve/internal/contour_path.h"
#include "obvid/exchange/internal/points/airfoil.h"
#include "obvid/io/internal/file_kind.h"
#include "obvid/pipeline/internal/airfoil_file.h"
#include "obvid/pipeline/internal/drawn_contour.h"
#include "obvid/pipeline/stored.h"
#include "verify/curve_deviation.h"

namespace obvid {
namespace {

using pipeline_detail::FirstCurve;
using pipeline_detail::Similarity;

constexpr std::size_t kStepsForArea = 16;  // of a piece: only the sign of the area counts

/// Of the curve and the chord between its ends; positive where it goes around to the left.
double area_of(std::span<const Piece> pieces) {
  double area = 0.0;
  const Vec2 origin = start_point(pieces.front());
  Vec2 before = origin;
  for (const Piece& piece : pieces) {
    for (std::size_t k = 1; k <= kStepsForArea; ++k) {
      const double t = static_cast<double>(k) / static_cast<double>(kStepsForArea);
      const Vec2 p = evaluate(piece, t).point;
      area += cross(before - origin, p - origin);
      before = p;
    }
  }
  return area;
}

/// Takes the chord of one airfoil to that of another.
Similarity chord_to_chord(const AirfoilFigures& from, const AirfoilFigures& to) {
  return {from.leading_edge, to.leading_edge, unit_at(to.turn - from.turn), to.chord / from.chord};
}

Result<void> one_unit(CurveComparison& out) {
  std::vector<Units> all;
  for (const ComparedCurve& curve : out.curves) all.push_back(curve.contour.units);
  auto units = common_units(all, "compare");
  OBVID_TRY(units);
  out.units = *units;
  for (ComparedCurve& curve : out.curves) curve.contour.units = out.units;
  return {};
}

Result<void> take_figures(ComparedCurve& curve) {
  const auto path = ContourPath::without_cusps(curve.contour.pieces);
  if (!path) {
    Error told = path.error();
    told.where = curve.name;
    return fail(std::move(told));
  }
  curve.length = path->length();
  auto figures = airfoil_figures(curve.contour);
  if (figures) {
    curve.airfoil = *figures;
  } else {
    curve.no_airfoil = figures.error().what;
  }
  return {};
}

Error at_input(Error told, const std::string& name) {
  if (told.where.find(name) != 0) told.where = told.where.empty() ? name : name + ": " + told.where;
  return told;
}

/// Where an input comes from, and what it is read as.
struct CurveFile {
  std::string name;
  bool drawn = false;
  std::function<Result<Drawing>()> drawing;
  std::function<Result<PointSeries>()> series;
  std::function<Result<std::string>()> text;
};

/// Points of the series that a stored contour was formed through; 0 for other drawings. Error:
/// E103.
Result<std::size_t> points_behind(const CurveFile& source, const RunContext& run) {
  const auto text = source.text();
  if (!text || file_kind(*text) != FileKind::kContour) return 0;
  const auto stored = parse_stored(*text, source.name, run);
  if (!stored && stored.error().code == ErrorCode::kCancelled) return fail(stored.error());
  if (!stored || !std::holds_alternative<StoredContour>(*stored)) return 0;
  return std::get<StoredContour>(*stored).contour.points.size();
}

Result<CurveInput> curve_from(const CurveFile& source, const ReadCurveOptions& how,
                              const RunContext& run) {
  if (source.drawn && how.import.use != DrawnUse::kPoints) {
    auto drawing = source.drawing();
    OBVID_TRY(drawing);
    const auto chosen = chosen_curve(*drawing, how.import.curve, source.name);
    OBVID_TRY(chosen);
    if (*chosen < drawing->curves.size()) {
      auto made = drawn_curve(std::move(*drawing), how, run);
      if (!made) return fail(at_input(made.error(), source.name));
      const auto points = points_behind(source, run);
      OBVID_TRY(points);
      made->curve.points = *points;
      return made;
    }
  }
  auto series = source.series();
  OBVID_TRY(series);
  auto made = formed_curve(*series, how.fit, run);
  if (!made) return fail(at_input(made.error(), source.name));
  return made;
}

}  // namespace

Result<CurveInput> formed_curve(const PointSeries& series, const FitJob& job,
                                const RunContext& run) {
  auto made = fit(series, job, run);
  OBVID_TRY(made);
  CurveInput out;
  out.curve.name = series.name;
  out.curve.formed = true;
  out.curve.proved = made->certificate.proved;
  out.curve.vertices = made->certificate.vertices;
  out.curve.contour = std::move(made->contour);
  out.curve.points = out.curve.contour.points.size();
  out.warnings = std::move(made->warnings);
  return out;
}

Result<CurveInput> drawn_curve(Drawing drawing, const ReadCurveOptions& how,
                               const RunContext& run) {
  const std::string name = drawing.name;
  if (how.units) {
    if (auto told = take_units(drawing.units, *how.units)) drawing.warnings.push_back(*told);
  }
  auto drawn = drawn_contour(std::move(drawing), how.import, name, without_progress(run));
  OBVID_TRY(drawn);
  CurveInput out;
  out.curve.name = name;
  out.curve.contour = std::move(drawn->stored.contour);
  if (drawn->stored.certificate) {
    const auto& pieces = drawn->stored.certificate->pieces;
    out.curve.vertices = drawn->stored.certificate->vertices;
    out.curve.counted = std::none_of(pieces.begin(), pieces.end(), [](const PieceProof& piece) {
      return piece.verdict == Verdict::kUndecided;
    });
  }
  return out;
}

Result<CurveInput> read_curve(const std::string& path, const ReadCurveOptions& how,
                              const RunContext& run) {
  const CurveFile source{path, is_drawing(path),
                         [&] { return read_drawing(path, how.import.planes, run); },
                         [&] { return read_series(path, in_units(how.import, how.units), run); },
                         [&] { return read_file(path); }};
  return curve_from(source, how, run);
}

Result<CurveInput> parse_curve(const std::string& text, const std::string& name,
                               const ReadCurveOptions& how, const RunContext& run) {
  const CurveFile source{
      name, is_drawing_text(text, name),
      [&] { return parse_drawing(text, name, how.import.planes, run); },
      [&] { return parse_series(text, name, in_units(how.import, how.units), run); },
      [&] { return Result<std::string>(text); }};
  return curve_from(source, how, run);
}

void name_curves(const std::vector<std::string>& files, std::vector<ComparedCurve>& curves) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    names.push_back(std::filesystem::path(files[i]).filename().string());
    if (!names[i].empty()) curves[i].name = names[i];
  }
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (names[i].empty()) continue;
    if (std::count(names.begin(), names.end(), names[i]) > 1) curves[i].name = files[i];
  }
}

std::vector<std::string> comparison_notes(const CurveComparison& compared) {
  const auto is_airfoil = [](const ComparedCurve& curve) { return curve.airfoil.has_value(); };
  std::vector<std::string> out;
  if (!compared.airfoils &&
      std::any_of(compared.curves.begin(), compared.curves.end(), is_airfoil)) {
    for (const ComparedCurve& curve : compared.curves) {
      if (!curve.airfoil) out.push_back(curve.name + ": " + curve.no_airfoil);
    }
  }
  if (!compared.airfoils || !compared.on_one_chord.empty()) return out;
  constexpr double kOneChord = 1e-3;  // chords that differ by more are told
  const AirfoilFigures& first = *compared.curves.front().airfoil;
  for (const ComparedCurve& curve : compared.curves) {
    const double ratio = curve.airfoil->chord / first.chord;
    if (std::abs(ratio - 1.0) <= kOneChord) continue;
    out.push_back(
        fmt::format("the chord of {} is {} times that of {}; --align chord compares the shapes",
                    curve.name, significant(ratio, 4), compared.curves.front().name));
  }
  return out;
}

std::vector<std::string> comparison_warnings(const CurveComparison& compared) {
  std::vector<std::string> out;
  if (!compared.airfoils) return out;
  for (const ComparedCurve& curve : compared.curves) {
    const std::string told = side_ends_text("one", curve.airfoil->trailing_gap);
    if (told.empty()) continue;
    out.push_back(curve.name + ": " + told +
                  ": the thickness of the trailing edge is across the chord alone; add that point");
  }
  return out;
}

Result<CurveComparison> compare_curves(std::vector<ComparedCurve> curves, const CurvesJob& job,
                                       const RunContext& run) {
  if (curves.size() < 2) {
    return error(ErrorCode::kBadOption, "two curves at least are laid over each other")
        .hint("name another file");
  }
  CurveComparison out;
  out.curves = std::move(curves);
  OBVID_TRY(one_unit(out));
  for (ComparedCurve& curve : out.curves) OBVID_TRY(take_figures(curve));
  const auto bare = std::find_if(out.curves.begin(), out.curves.end(),
                                 [](const ComparedCurve& curve) { return !curve.airfoil; });
  out.airfoils = bare == out.curves.end();
  if (job.align_chord && !out.airfoils) {
    return error(ErrorCode::kBadOption, "only airfoils have chords: " + bare->no_airfoil)
        .where(bare->name)
        .hint("leave --align chord out");
  }
  const ComparedCurve& first = out.curves.front();
  out.outward = first.contour.closed || first.airfoil.has_value();
  const ContourPath path(first.contour.pieces);
  const bool left_is_inside = out.outward && area_of(first.contour.pieces) > 0.0;
  const FirstCurve from{path, left_is_inside ? -1.0 : 1.0,
                        out.airfoils ? &*first.airfoil : nullptr};
  for (std::size_t k = 1; k < out.curves.size(); ++k) {
    const ComparedCurve& other = out.curves[k];
    const auto measure = [&](const Similarity& by,
                             std::vector<CurveDeviation>& to) -> Result<void> {
      auto made = pipeline_detail::deviation_from(from, other.contour.pieces, by, run);
      OBVID_TRY(made);
      made->curve = k;
      to.push_back(std::move(*made));
      return {};
    };
    OBVID_TRY(tell(run, "measuring deviations",
                   static_cast<double>(k) / static_cast<double>(out.curves.size())));
    OBVID_TRY(measure({}, out.as_they_lie));
    if (!job.align_chord) continue;
    OBVID_TRY(measure(chord_to_chord(*first.airfoil, *other.airfoil), out.on_one_chord));
  }
  return out;
}

}  // namespace obvid
