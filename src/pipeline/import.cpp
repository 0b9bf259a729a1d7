// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/import.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "obvid/cad/cad.h"
#include "obvid/exchange/dxf_read.h"
#include "obvid/exchange/geojson.h"
#include "obvid/exchange/gpx.h"
#include "obvid/exchange/landxml.h"
#include "obvid/exchange/opendrive.h"
#include "obvid/exchange/svg_read.h"
#include "obvid/io/contour_json.h"
#include "obvid/io/file_kind.h"
#include "obvid/io/read_file.h"
#include "obvid/io/read_points.h"
#include "report.h"

namespace obvid {
namespace {

constexpr std::size_t kHead = 4096;       // bytes that tell the kind of a file
constexpr double kChordTolerance = 1e-4;  // of the size of a curve
constexpr int kMostSteps = 4096;          // chords of one piece

std::string head_of(const std::string& path) { return head_of_file(path, kHead); }

std::string name_of(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

Result<Drawing> drawing_of_contour(const std::string& text, const std::string& path) {
  auto stored = contour_from_json(text, path);
  if (!stored) return tl::unexpected(stored.error());
  Contour& contour = stored->contour;
  Drawing out;
  out.name = name_of(path);
  out.units = contour.units;
  out.curves.push_back({"contour", std::move(contour.pieces), contour.closed});
  return out;
}

Result<Drawing> from_text(FileKind kind, const std::string& text, const std::string& path) {
  switch (kind) {
    case FileKind::kContour:
      return drawing_of_contour(text, path);
    case FileKind::kSvg:
      return parse_svg(text, path);
    case FileKind::kGpx:
      return parse_gpx(text, path);
    case FileKind::kDxf:
      return parse_dxf(text, path);
    case FileKind::kLandXml:
      return parse_landxml(text, path);
    case FileKind::kOpenDrive:
      return parse_opendrive(text, path);
    case FileKind::kGeoJson:
      return parse_geojson(text, path);
    default:
      return fail({ErrorCode::kUnsupported, "this kind of file is not read", path,
                   "give a list of points, a contour, STEP, IGES, BREP, DXF, SVG, GPX, GeoJSON, "
                   "LandXML or OpenDRIVE",
                   -1, 0.0});
  }
}

bool is_cad(FileKind kind) {
  return kind == FileKind::kStep || kind == FileKind::kIges || kind == FileKind::kBrep;
}

// ---- points of a drawing ----------------------------------------------------------------------

std::vector<Vec2> ends_of(const DrawnCurve& curve) {
  std::vector<Vec2> out;
  for (const Piece& piece : curve.pieces) {
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) out.push_back(evaluate(piece, t).point);
  }
  return out;
}

/// Largest distance of the middles between equal steps from their chords.
double largest_sagitta(const Piece& piece, int steps) {
  double most = 0.0;
  Vec2 before = start_point(piece);
  for (int k = 1; k <= steps; ++k) {
    const Vec2 here = evaluate(piece, static_cast<double>(k) / steps).point;
    const Vec2 middle = evaluate(piece, (k - 0.5) / steps).point, chord = here - before;
    const double length = norm(chord);
    const double away =
        length > 0.0 ? std::abs(cross(chord, middle - before)) / length : norm(middle - before);
    most = std::max(most, away);
    before = here;
  }
  return most;
}

/// Points on the curve with chords within the tolerance, joints of its pieces among them.
std::vector<Vec2> samples_within(const DrawnCurve& curve, double tolerance) {
  std::vector<Vec2> out;
  for (const Piece& piece : curve.pieces) {
    int steps = std::holds_alternative<LinePiece>(piece) ? 1 : 2;
    while (steps < kMostSteps && largest_sagitta(piece, steps) > tolerance) steps *= 2;
    for (int k = out.empty() ? 0 : 1; k <= steps; ++k) {
      out.push_back(evaluate(piece, static_cast<double>(k) / steps).point);
    }
  }
  return out;
}

double length_of(const std::vector<Vec2>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += norm(points[i] - points[i - 1]);
  return length;
}

/// Curves come before series; the longest is what a drawing is about, mostly.
std::size_t longest(const Drawing& drawing) {
  std::size_t best = 0;
  double most = -1.0;
  const auto offer = [&](std::size_t i, const std::vector<Vec2>& points) {
    const double length = length_of(points);
    if (length > most) {
      most = length;
      best = i;
    }
  };
  for (std::size_t i = 0; i < drawing.curves.size(); ++i) offer(i, ends_of(drawing.curves[i]));
  for (std::size_t i = 0; i < drawing.series.size(); ++i) {
    offer(drawing.curves.size() + i, drawing.series[i].points);
  }
  return best;
}

Result<PointSeries> points_of_drawing(Drawing drawing, const ImportOptions& options,
                                      const std::string& path) {
  const auto found = chosen_curve(drawing, options.curve, path);
  if (!found) return tl::unexpected(found.error());
  const std::size_t count = drawing.curves.size() + drawing.series.size(), chosen = *found;
  PointSeries out;
  std::string label;
  if (chosen < drawing.curves.size()) {
    const DrawnCurve& curve = drawing.curves[chosen];
    const double size = pipeline_detail::size_of(ends_of(curve));
    out.points = samples_within(curve, options.tolerance.value_or(kChordTolerance * size));
    label = curve.label;
  } else {
    out = std::move(drawing.series[chosen - drawing.curves.size()]);
    label = out.name;
  }
  out.name = drawing.name;
  out.units = drawing.units;
  out.warnings.insert(out.warnings.begin(), drawing.warnings.begin(), drawing.warnings.end());
  if (count > 1) {
    out.warnings.push_back(fmt::format("of {} curves the {} was taken: number {}, {}", count,
                                       options.curve ? "asked one" : "longest", chosen + 1, label));
  }
  return out;
}

}  // namespace

Result<std::size_t> chosen_curve(const Drawing& drawing, const std::optional<std::size_t>& asked,
                                 const std::string& path) {
  const std::size_t count = drawing.curves.size() + drawing.series.size();
  if (count == 0) {
    return fail(
        {ErrorCode::kTooFewPoints, "the file holds no curve and no points", path, "", -1, 0.0});
  }
  const std::size_t chosen = asked.value_or(longest(drawing));
  if (chosen < count) return chosen;
  return fail({ErrorCode::kBadOption,
               fmt::format("there are {} curves, no curve {}", count, chosen + 1), path,
               "`obvid analyse FILE` lists them", -1, 0.0});
}

bool is_drawing(const std::string& path) {
  return path != "-" && file_kind(head_of(path)) != FileKind::kPoints &&
         file_kind(head_of(path)) != FileKind::kOther;
}

Result<Drawing> read_drawing(const std::string& path) {
  const FileKind kind = file_kind(head_of(path));
  if (is_cad(kind)) return read_cad(path);
  const auto text = read_file(path);
  if (!text) return tl::unexpected(text.error());
  return from_text(kind, *text, path);
}

Result<PointSeries> read_series(const std::string& path, const ImportOptions& options) {
  const FileKind kind = path == "-" ? FileKind::kPoints : file_kind(head_of(path));
  if (kind == FileKind::kPoints || kind == FileKind::kOther || kind == FileKind::kContour) {
    return read_points(path);
  }
  auto drawing = read_drawing(path);
  if (!drawing) return tl::unexpected(drawing.error());
  return points_of_drawing(std::move(*drawing), options, path);
}

}  // namespace obvid
