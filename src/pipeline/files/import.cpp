// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/import.h"

#include <fmt/format.h>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <system_error>

#include "files/cad_of_text.h"
#include "files/drawn_series.h"
#include "obvid/cad/internal/cad.h"
#include "obvid/core/files.h"
#include "obvid/core/internal/figures.h"
#include "obvid/core/internal/near_name.h"
#include "obvid/core/internal/typed_numbers.h"
#include "obvid/exchange/internal/dxf/read.h"
#include "obvid/exchange/internal/geo/geojson.h"
#include "obvid/exchange/internal/geo/gpx.h"
#include "obvid/exchange/internal/road/landxml.h"
#include "obvid/exchange/internal/road/opendrive.h"
#include "obvid/exchange/internal/svg/read.h"
#include "obvid/io/contour_json.h"
#include "obvid/io/internal/file_kind.h"
#include "obvid/io/internal/mesh_kind.h"
#include "obvid/io/internal/private_copy.h"
#include "obvid/io/read_points.h"
#include "obvid/numeric/internal/median.h"
#include "obvid/pipeline/internal/mesh_sections.h"
#include "obvid/series/internal/order.h"
#include "obvid/series/internal/outliers.h"
#include "obvid/series/internal/scatter.h"
#include "obvid/series/internal/strays.h"

namespace obvid {
namespace {

constexpr std::size_t kMostPointsNamed = 8;  // points in one sentence; the others are counted

std::string head_of(const std::string& path) { return head_of_file(path, kHeadOfKind); }

std::string name_of(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

Result<Drawing> drawing_of_contour(const std::string& text, const std::string& path,
                                   const RunContext& run) {
  Watch watch(without_progress(run));
  auto stored = contour_from_json(text, path, &watch);
  OBVID_TRY(stored);
  Contour& contour = stored->contour;
  Drawing out;
  out.name = name_of(path);
  out.units = contour.units;
  DrawnCurve curve{"contour", std::move(contour.pieces), contour.closed};
  if (stored->alignment) {
    curve.station = stored->alignment->first_station;
    curve.transitions = std::move(stored->alignment->transitions);
    curve.profile = std::move(stored->alignment->profile);
  }
  out.curves.push_back(std::move(curve));
  return out;
}

/// Planes, and the file is no mesh. Error: E203.
Result<void> check_no_planes(const std::vector<PlaneRow>& planes, const std::string& path) {
  if (planes.empty()) return {};
  return error(ErrorCode::kBadOption, "planes cut meshes (STL, PLY, OBJ), and " + path + " is none")
      .where("--cut")
      .hint("leave it out");
}

/// What has curves, or series of points that are told apart.
bool is_drawn(FileKind kind) { return kind != FileKind::kPoints && kind != FileKind::kOther; }

Result<Drawing> parsed_by_kind(const std::string& text, const std::string& path,
                               const std::vector<PlaneRow>& planes, const RunContext& run) {
  const FileKind kind = file_kind(std::string_view(text).substr(0, kHeadOfKind));
  if (!is_drawn(kind) && is_mesh(text, text.size(), path)) {
    return pipeline_detail::sections_of_mesh(text, path, planes, run);
  }
  OBVID_TRY(check_no_planes(planes, path));
  switch (kind) {
    case FileKind::kContour:
      return drawing_of_contour(text, path, run);
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
      return error(ErrorCode::kUnsupported, "this kind of file is not read")
          .where(path)
          .hint(
              "give a list of points, a contour, STEP, IGES, BREP, DXF, SVG, GPX, GeoJSON, "
              "LandXML, OpenDRIVE, or a mesh (STL, PLY, OBJ) with --cut");
  }
}

/// Its name is the file's, wherever that lies: pictures have it as title.
Result<Drawing> from_text(const std::string& text, const std::string& path,
                          const std::vector<PlaneRow>& planes, const RunContext& run) {
  OBVID_TRY(may_go_on(run));
  auto drawing = parsed_by_kind(text, path, planes, run);
  OBVID_TRY(drawing);
  if (drawing->name == path) drawing->name = name_of(path);
  return drawing;
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

double length_of(const std::vector<Vec2>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += norm(points[i] - points[i - 1]);
  return length;
}

/// What comes first is what a drawing is about; among equals the longest, curves before series.
std::size_t foremost(const Drawing& drawing) {
  std::size_t best = 0;
  SeriesKind first = SeriesKind::kWaypoints;
  double most = -1.0;
  const auto offer = [&](std::size_t i, SeriesKind kind, const std::vector<Vec2>& points) {
    const double length = length_of(points);
    if (kind > first || (kind == first && length <= most)) return;
    first = kind;
    most = length;
    best = i;
  };
  for (std::size_t i = 0; i < drawing.curves.size(); ++i) {
    offer(i, SeriesKind::kLine, ends_of(drawing.curves[i]));
  }
  for (std::size_t i = 0; i < drawing.series.size(); ++i) {
    const PointSeries& series = drawing.series[i];
    offer(drawing.curves.size() + i, series.kind, series.points);
  }
  return best;
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

const std::string& label_of(const Drawing& drawing, std::size_t i) {
  const std::size_t curves = drawing.curves.size();
  return i < curves ? drawing.curves[i].label : drawing.series[i - curves].name;
}

const std::string& layer_of(const Drawing& drawing, std::size_t i) {
  const std::size_t curves = drawing.curves.size();
  return i < curves ? drawing.curves[i].layer : drawing.series[i - curves].layer;
}

/// Whether a layer is the one of that name, or lies in it: layers of SVG files lie in each other,
/// "Part/Holes".
bool is_on_layer(const std::string& layer, const std::string& name) {
  return layer == name || layer.starts_with(name + "/") || layer.ends_with("/" + name) ||
         layer.find("/" + name + "/") != std::string::npos;
}

/// Whether `word` stands in `text` between blanks, commas or the ends; upper and lower case are
/// the same.
bool has_word(const std::string& text, const std::string& word) {
  const auto ends = [&](std::size_t at) {
    return at >= text.size() || text[at] == ' ' || text[at] == ',';
  };
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    if ((at == 0 || ends(at - 1)) && ends(at + word.size())) return true;
  }
  return false;
}

/// The curve whose label it is; else the only one in whose label it is a word (a handle, a layer).
Result<std::size_t> curve_named(const Drawing& drawing, const std::string& name,
                                const std::string& path) {
  constexpr std::size_t kMostTold = 8;
  const std::size_t count = drawing.curves.size() + drawing.series.size();
  std::vector<std::size_t> same, holding;
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < count; ++i) {
    labels.push_back(label_of(drawing, i));
    if (labels.back() == name) same.push_back(i);
    if (has_word(lower(labels.back()), lower(name))) holding.push_back(i);
  }
  const std::vector<std::size_t>& found = same.empty() ? holding : same;
  if (found.size() == 1) return found.front();
  if (found.empty()) {
    return error(ErrorCode::kBadOption, fmt::format("no curve is called '{}'", name))
        .where(path)
        .hint(did_you_mean(name, labels, "`obvid analyse FILE` lists them"));
  }
  std::string numbers;
  for (std::size_t i = 0; i < std::min(found.size(), kMostTold); ++i) {
    numbers += fmt::format("{}{}", i == 0 ? "" : ", ", found[i] + 1);
  }
  return error(ErrorCode::kBadOption,
               fmt::format("{} curves are called '{}': {}{}", found.size(), name, numbers,
                           found.size() > kMostTold ? ", ..." : ""))
      .where(path)
      .hint("give the number of one of them");
}

/// One flag per point.
void leave_out(const std::vector<bool>& flagged, PointSeries& series) {
  std::size_t stay = 0;
  for (std::size_t i = 0; i < flagged.size(); ++i) {
    if (flagged[i]) continue;
    series.points[stay] = series.points[i];
    if (!series.fixed.empty()) series.fixed[stay] = series.fixed[i];
    ++stay;
  }
  series.points.resize(stay);
  if (!series.fixed.empty()) series.fixed.resize(stay);
}

/// Every point once, where a list in no order has it twice; the first of them stays. Indices of
/// those that are left.
std::vector<std::size_t> drop_repeated_points(PointSeries& series) {
  std::vector<std::size_t> sorted(series.points.size());
  std::iota(sorted.begin(), sorted.end(), std::size_t{0});
  const auto place_of = [&](std::size_t i) {
    return std::pair{series.points[i].x, series.points[i].y};
  };
  std::sort(sorted.begin(), sorted.end(), [&](std::size_t a, std::size_t b) {
    return std::tuple(place_of(a), a) < std::tuple(place_of(b), b);
  });
  std::vector<bool> repeated(sorted.size(), false);
  for (std::size_t k = 1; k < sorted.size(); ++k) {
    repeated[sorted[k]] = series.points[sorted[k]] == series.points[sorted[k - 1]];
  }
  leave_out(repeated, series);
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < repeated.size(); ++i) {
    if (!repeated[i]) left.push_back(i);
  }
  return left;
}

/// What stands in a list in no order.
struct InOrder {
  PointSeries series;
  std::vector<std::size_t> numbers;  ///< of the points in the list, from 0; none: as they stand
  std::size_t strays = 0;            ///< that were left out
  std::size_t strays_warning = 0;    ///< which warning says so
};

std::string order_text(const PointSeries& series, const CurveOrder& found) {
  constexpr double kMayClose = 2.0;  // steps
  const std::string unit = series.units.text();
  std::string text = fmt::format(
      "--unordered: {} points were put in the order of their shortest row; neighbours are at most "
      "{} {} apart, the ends {}",
      found.order.size(), significant(found.largest_step, 4), unit, significant(found.gap, 4));
  if (found.gap <= kMayClose * found.largest_step) text += ", which --closed makes neighbours";
  if (found.thinned > 0) {
    text += fmt::format(
        "; it is the row of {} of them that are {} {} or more apart: the others stand beside it, "
        "and neighbours nearer than they scatter may follow each other the wrong way round",
        found.thinned, significant(found.apart, 3), unit);
  }
  if (found.is_outline) {
    text +=
        "; it is the shortest closed way that was found, begun behind its longest step: look at it "
        "before you rely on it";
  }
  return text;
}

std::string deviations_text(const Outliers& found, const std::string& unit) {
  return fmt::format("{} {} ({} deviations of the others)",
                     significant(found.limit * found.deviation, 3), unit,
                     significant(found.limit, 3));
}

/// Points by their numbers in the list and their places.
std::string strays_text(const PointSeries& series, const std::vector<Outlier>& strays,
                        const std::vector<std::size_t>& numbers) {
  const std::string unit = series.units.text();
  std::string text = strays.size() == 1 ? "point" : fmt::format("{} points:", strays.size());
  for (std::size_t k = 0; k < std::min(strays.size(), kMostPointsNamed); ++k) {
    const Vec2 at = series.points[strays[k].index];
    text += fmt::format("{} {} of the list (at {}, {}, {} {} off the curve of the others)",
                        k > 0 ? "," : "", numbers[strays[k].index] + 1, significant(at.x),
                        significant(at.y), significant(strays[k].off, 4), unit);
  }
  return text + and_more(strays.size(), kMostPointsNamed);
}

/// An order, of all points or without those that stray.
Result<CurveOrder> order_of(const PointSeries& series, const std::vector<std::size_t>& numbers,
                            const ImportOptions& options, InOrder& out) {
  auto whole = order_beside_row(series.points);
  if (!whole && whole.error().code != ErrorCode::kOutOfOrder) return whole;
  const bool is_row = whole && !whole->is_outline;
  std::optional<OrderBesideStrays> found;
  if (!is_row || options.drop_outliers) found = order_beside_strays(series.points);
  if (const CurveOrder* row = found ? &found->order : is_row ? &*whole : nullptr) {
    auto shorter = without_end_strays(series.points, *row);
    if (shorter && found) {
      auto& strays = shorter->strays.points;
      strays.insert(strays.begin(), found->strays.points.begin(), found->strays.points.end());
    }
    if (shorter) found = std::move(shorter);
  }
  if (!found) return whole;
  const std::string strays = strays_text(series, found->strays.points, numbers);
  if (whole && !options.drop_outliers) {
    out.series.warnings.push_back("--unordered: " + strays + ": --drop-outliers leaves " +
                                  (found->strays.points.size() == 1 ? "it" : "them") + " out");
    return whole;
  }
  if (!options.drop_outliers) {
    whole.error().hint = fmt::format(
        "without {} the points have an order: --drop-outliers leaves "
        "{} out",
        strays, found->strays.points.size() == 1 ? "it" : "them");
    return whole;
  }
  out.strays = found->strays.points.size();
  out.series.warnings.push_back(
      fmt::format("--drop-outliers: left out {} before the points were put in order", strays));
  out.strays_warning = out.series.warnings.size() - 1;
  return std::move(found->order);
}

Result<InOrder> in_order(Result<PointSeries> series, const ImportOptions& options) {
  OBVID_TRY(series);
  InOrder whole;
  if (!options.unordered) {
    whole.series = std::move(*series);
    return whole;
  }
  if (!series->kept.empty()) {
    return error(ErrorCode::kBadOption, "pieces of a drawing have their order")
        .where("--unordered")
        .hint("leave it out, or take points alone with --drawing points");
  }
  const std::vector<std::size_t> numbers = drop_repeated_points(*series);
  whole.series = std::move(*series);
  PointSeries& out = whole.series;
  const auto found = order_of(out, numbers, options, whole);
  OBVID_TRY(found);
  const std::vector<Vec2> points = std::move(out.points);
  const std::vector<FixedData> fixed = std::move(out.fixed);
  out.points.clear();
  out.fixed.clear();
  for (const std::size_t i : found->order) {
    out.points.push_back(points[i]);
    if (!fixed.empty()) out.fixed.push_back(fixed[i]);
    whole.numbers.push_back(numbers[i]);
  }
  out.warnings.push_back(order_text(out, *found));
  return whole;
}

/// Why none goes.
template <class Number>
std::string staying_text(const Outliers& found, const std::string& unit, const Number& number) {
  const std::string limit = deviations_text(found, unit);
  if (!found.staying.empty()) {
    const auto farthest =
        std::max_element(found.staying.begin(), found.staying.end(),
                         [](const Outlier& a, const Outlier& b) { return a.off < b.off; });
    const bool one = found.staying.size() == 1;
    return fmt::format(
        "{} {} {} or more off the curve of {} neighbours ({}point {}, {} {}), but without {} the "
        "others do not follow each other, as at a corner, or {} data",
        found.staying.size(), one ? "lies" : "lie", limit, one ? "its" : "their",
        one ? "" : "farthest: ", number(farthest->index), significant(farthest->off, 4), unit,
        one ? "it" : "them", one ? "it has" : "they have");
  }
  std::string text = fmt::format("none lies {} or more off the curve of its neighbours", limit);
  if (!found.untold.empty()) {
    text += fmt::format(" ({} cannot be told, at ends or where the curve turns back)",
                        counted(found.untold.size(), "point", "points"));
  }
  return text;
}

/// `numbers`: of the points in the list where they were put in order, from 0.
std::string outliers_text(const PointSeries& series, const Outliers& found,
                          const std::vector<std::size_t>& numbers) {
  const std::string unit = series.units.text();
  const std::size_t count = found.points.size();
  const auto number = [&](std::size_t index) {
    return fmt::format("{}{}", (numbers.empty() ? index : numbers[index]) + 1,
                       numbers.empty() ? "" : " of the list");
  };
  if (count == 0) {
    return "--drop-outliers: all points stay: " + staying_text(found, unit, number);
  }
  std::string text =
      fmt::format("--drop-outliers: left out {}",
                  count == 1 ? "point"
                             : fmt::format("{} points that lie off the curve of their "
                                           "neighbours:",
                                           count));
  for (std::size_t k = 0; k < std::min(count, kMostPointsNamed); ++k) {
    const std::size_t index = found.points[k].index;
    text += fmt::format("{} {} ({} {}{})", k > 0 ? "," : "", number(index),
                        significant(found.points[k].off, 4), unit,
                        count == 1 ? " off the curve of its neighbours" : "");
  }
  return text + and_more(count, kMostPointsNamed);
}

/// Of points that are left, for what they are told beside. Where `--noise auto` has a scatter it is
/// that one; elsewhere their curve shows in it. Empty where there are too few.
std::string scatter_of_others(const PointSeries& series) {
  constexpr int kScatterDigits = 4;  // as `--noise auto` prints
  if (const auto seen = scatter_of(series.points)) {
    return fmt::format(
        "the others scatter by {} {} about cubics through four neighbours each (1.4826 times the "
        "median residual, without the curve's part)",
        significant(seen->deviation, kScatterDigits), series.units.text());
  }
  const auto seen = middle_deviation(series.points);
  if (!seen) return {};
  return fmt::format(
      "the others lie {} {} off cubics through four neighbours each (1.4826 times the median "
      "residual, the curve's part with it)",
      significant(*seen, kScatterDigits), series.units.text());
}

/// Points that go once around, the first one not again, as far as they tell: the ends are not much
/// farther apart than neighbours, and the curve does not turn back there.
std::optional<std::size_t> points_of_loop(const std::vector<Vec2>& points) {
  constexpr std::size_t kFewest = 20;                   // that outliers are told among
  constexpr double kFarther = 3.0, kLeastCosine = 0.5;  // middle chords: an end may be the outlier;
                                                        // of the turn over the seam: 60 degrees
  const std::size_t n =
      points.size() > 1 && points.front() == points.back() ? points.size() - 1 : points.size();
  if (n < kFewest) return std::nullopt;
  std::vector<double> chords;
  for (std::size_t i = 1; i < n; ++i) chords.push_back(norm(points[i] - points[i - 1]));
  if (norm(points[0] - points[n - 1]) > kFarther * median_of(std::move(chords))) {
    return std::nullopt;
  }
  // an end may be what is wrong: the chords beside it tell
  const Vec2 before = points[n - 2] - points[n - 4], behind = points[3] - points[1];
  if (dot(before, behind) < kLeastCosine * norm(before) * norm(behind)) return std::nullopt;
  return n;
}

/// `outliers_of` with neighbours over the seam where the points go around.
Result<Outliers> outliers_around(const std::vector<Vec2>& points, const std::vector<bool>& given) {
  const auto around = points_of_loop(points);
  if (!around) return outliers_of(points, given);
  constexpr std::size_t kBeyond = 8;  // points beyond the seam: two neighbours, of three in a row
  const std::size_t n = *around;
  std::vector<Vec2> unrolled;
  std::vector<bool> kept;
  for (std::size_t k = 0; k < n + 2 * kBeyond; ++k) {
    const std::size_t i = (k + n - kBeyond) % n;
    unrolled.push_back(points[i]);
    kept.push_back(i < given.size() && given[i]);
  }
  auto found = outliers_of(unrolled, kept);
  OBVID_TRY(found);
  Outliers out{{}, found->deviation, found->limit};
  const auto is_own = [&](std::size_t i) { return i >= kBeyond && i < n + kBeyond; };
  for (const Outlier& one : found->staying) {
    if (is_own(one.index)) out.staying.push_back({one.index - kBeyond, one.off});
  }
  for (const std::size_t i : found->untold) {
    if (is_own(i)) out.untold.push_back(i - kBeyond);
  }
  for (Outlier one : found->points) {
    if (!is_own(one.index)) continue;
    one.index -= kBeyond;
    out.points.push_back(one);
    if (one.index == 0 && n < points.size()) out.points.push_back({n, one.off});
  }
  std::sort(out.points.begin(), out.points.end(),
            [](const Outlier& a, const Outlier& b) { return a.index < b.index; });
  return out;
}

Result<PointSeries> without_outliers(Result<InOrder> ordered, const ImportOptions& options) {
  OBVID_TRY(ordered);
  PointSeries& out = ordered->series;
  if (!options.drop_outliers) return std::move(out);
  if (!out.kept.empty()) {
    return error(ErrorCode::kBadOption, "a drawing's pieces are not measured points")
        .where("--drop-outliers")
        .hint("leave it out, or take points alone with --drawing points");
  }
  std::vector<bool> given;
  for (const FixedData& data : out.fixed) {
    given.push_back(data.theta || data.kappa || data.thetas || data.kappas || data.corner);
  }
  const auto found = outliers_around(out.points, given);
  OBVID_TRY(found);
  std::size_t told = ordered->strays_warning;
  if (ordered->strays == 0 || !found->points.empty()) {
    told = out.warnings.size();
    out.warnings.push_back(outliers_text(out, *found, ordered->numbers));
  }
  std::vector<bool> off(out.points.size(), false);
  for (const Outlier& one : found->points) off[one.index] = true;
  leave_out(off, out);
  if (ordered->strays > 0 || !found->points.empty()) {
    const std::string others = scatter_of_others(out);
    if (!others.empty()) out.warnings[told] += "; " + others;
  }
  return std::move(out);
}

Result<PointSeries> placed(Result<PointSeries> series, const ImportOptions& options) {
  if (series) place(options.placement, *series);
  if (series && options.units) take_units(*series, *options.units);
  return without_outliers(in_order(std::move(series), options), options);
}

Result<PointSeries> points_of_drawing(const Drawing& drawing, const ImportOptions& options,
                                      const std::string& path) {
  const auto found = chosen_curve(drawing, options.curve, path);
  OBVID_TRY(found);
  const std::size_t chosen = *found;
  PointSeries out;
  if (chosen < drawing.curves.size()) {
    out = pipeline_detail::series_of(drawing.curves[chosen], options.use, options.tolerance);
    const DrawnCurve& curve = drawing.curves[chosen];
    out.label = curve.name.empty() ? curve.label : curve.name;
    out.id = curve.id;
    out.layer = curve.layer;
  } else {
    out = drawing.series[chosen - drawing.curves.size()];
    if (!options.list.heights) out.fixed.clear();  // of maps: heights, which alignments take
    out.label = out.name;
    const bool edges = options.use == DrawnUse::kExact && out.kind == SeriesKind::kLine;
    if (edges) {
      out = pipeline_detail::series_of(edges_of(out), options.use, options.tolerance);
      out.label = drawing.series[chosen - drawing.curves.size()].name;
      out.id = drawing.series[chosen - drawing.curves.size()].id;
      out.layer = drawing.series[chosen - drawing.curves.size()].layer;
    }
  }
  out.name = drawing.name + (out.label.empty() ? "" : ": " + out.label);
  out.units = drawing.units;
  out.warnings.insert(out.warnings.begin(), drawing.warnings.begin(), drawing.warnings.end());
  if (is_guessed(drawing, options.curve)) {
    out.warnings.push_back(chosen_text(drawing, chosen, options.curve.asked()));
  }
  return placed(std::move(out), options);
}

DrawnRoad drawn_road(const DrawnCurve& curve, const ImportOptions& options) {
  if ((!curve.station && !curve.profile) || options.unordered || options.drop_outliers) return {};
  Drawing alone;
  alone.curves.push_back(curve);
  place(options.placement, alone);
  DrawnCurve& placed_curve = alone.curves.front();
  DrawnRoad out{placed_curve.station, 0.0, std::move(placed_curve.profile)};
  for (const Piece& piece : placed_curve.pieces) out.length += arc_length(piece, 0.0);
  return out;
}

}  // namespace

Result<std::vector<std::size_t>> chosen_curves(const Drawing& drawing, const CurveChoice& asked,
                                               const std::string& path) {
  std::vector<std::string> items = asked.several;
  if (!asked.name.empty()) items.push_back(asked.name);
  std::set<std::size_t> out;
  const auto take = [&](const CurveChoice& one) -> Result<void> {
    const auto found = chosen_curve(drawing, one, path);
    OBVID_TRY(found);
    out.insert(*found);
    return {};
  };
  if (asked.number) OBVID_TRY(take({asked.number, {}, false, {}}));
  const std::size_t count = drawing.curves.size() + drawing.series.size();
  for (const std::string& item : items) {
    bool any = false;
    for (std::size_t i = 0; i < count; ++i) {
      if (label_of(drawing, i) != item && !is_on_layer(layer_of(drawing, i), item)) continue;
      out.insert(i);
      any = true;
    }
    if (any) continue;
    const auto number = typed_numbers<long>(item);
    if (number && number->size() == 1 && number->front() >= 1) {
      OBVID_TRY(take({static_cast<std::size_t>(number->front() - 1), {}, false, {}}));
    } else {
      OBVID_TRY(take({{}, item, false, {}}));
    }
  }
  return std::vector<std::size_t>(out.begin(), out.end());
}

Result<std::size_t> chosen_curve(const Drawing& drawing, const CurveChoice& asked,
                                 const std::string& path) {
  const std::size_t count = drawing.curves.size() + drawing.series.size();
  if (count == 0) {
    return error(ErrorCode::kNothingThere, "the file holds no curve and no points").where(path);
  }
  if (asked.all) {
    return error(ErrorCode::kBadOption, "all curves at once are not for this command")
        .where("--curve")
        .hint("give the number of one");
  }
  if (!asked.several.empty()) {
    return error(ErrorCode::kBadOption, "several curves at once are for cut")
        .where("--curve")
        .hint("give the number of one, or all");
  }
  Result<std::size_t> found = asked.number.value_or(0);
  if (!asked.name.empty()) {
    found = curve_named(drawing, asked.name, path);
    OBVID_TRY(found);
  } else if (!asked.number) {
    found = foremost(drawing);
  }
  const std::size_t chosen = *found;
  if (chosen >= count) {
    return error(ErrorCode::kBadOption, fmt::format("the drawing has {}, no curve {}",
                                                    counted(count, "curve", "curves"), chosen + 1))
        .where(path)
        .hint("`obvid analyse FILE` lists them");
  }
  const bool waypoints =
      chosen >= drawing.curves.size() &&
      drawing.series[chosen - drawing.curves.size()].kind == SeriesKind::kWaypoints;
  if (asked.asked() || !waypoints) return chosen;
  return error(ErrorCode::kNothingThere,
               "the file holds waypoints only, no track and no route: places are no curve")
      .where(path)
      .hint(fmt::format("--curve {} takes them in the order of the file", chosen + 1));
}

std::string chosen_text(const Drawing& drawing, std::size_t chosen, bool asked) {
  const std::size_t curves = drawing.curves.size(), count = curves + drawing.series.size();
  const std::string& name =
      chosen < curves ? drawing.curves[chosen].label : drawing.series[chosen - curves].name;
  std::string text = fmt::format("curve {} of {} was taken, {}", chosen + 1, count, name);
  if (asked || count == 1) return text;
  return text +
         fmt::format(", the longest of its kind; --curve N takes one of the other {}", count - 1);
}

bool is_guessed(const Drawing& drawing, const CurveChoice& asked) {
  return drawing.curves.size() + drawing.series.size() > 1 && !asked.asked();
}

DrawnCurve edges_of(const PointSeries& series) {
  DrawnCurve out{series.name, {}, false};
  const std::vector<Vec2>& points = series.points;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (points[i] != points[i + 1]) out.pieces.emplace_back(LinePiece{points[i], points[i + 1]});
  }
  out.closed = out.pieces.size() > 2 && points.front() == points.back();
  return out;
}

bool is_drawing(const std::string& path) {
  if (path == "-") return false;
  const std::string head = head_of(path);
  if (is_drawn(file_kind(head))) return true;
  std::error_code none;
  const std::uintmax_t size = std::filesystem::file_size(path, none);
  return !head.empty() && !none && is_mesh(head, size, path);
}

Result<Drawing> read_drawing(const std::string& path, const std::vector<PlaneRow>& planes,
                             const RunContext& run) {
  const FileKind kind = file_kind(head_of(path));
  if (is_cad(kind)) {
    OBVID_TRY(check_no_planes(planes, path));
    return read_cad(path, {{}, run.cancelled});
  }
  const auto text = read_file(path);
  OBVID_TRY(text);
  return from_text(*text, path, planes, run);
}

bool is_drawing_text(std::string_view text, std::string_view name) {
  return is_drawn(file_kind(text.substr(0, kHeadOfKind))) || is_mesh(text, text.size(), name);
}

bool needs_cad(std::string_view text) { return is_cad(file_kind(text.substr(0, kHeadOfKind))); }

Result<Drawing> parse_drawing(const std::string& text, const std::string& name,
                              const std::vector<PlaneRow>& planes, const RunContext& run) {
  if (!needs_cad(text)) return from_text(text, name, planes, run);
  OBVID_TRY(check_no_planes(planes, name));
  return pipeline_detail::cad_of_text(text, name, &read_cad, {{}, run.cancelled});
}

Result<PointSeries> parse_series(const std::string& text, const std::string& name,
                                 const ImportOptions& options, const RunContext& run) {
  const FileKind kind = file_kind(std::string_view(text).substr(0, kHeadOfKind));
  if (!is_drawing_text(text, name) || kind == FileKind::kContour) {
    OBVID_TRY(check_no_planes(options.planes, name));
    return placed(parse_points(text, name, options.list), options);
  }
  auto drawing = parse_drawing(text, name, options.planes, run);
  OBVID_TRY(drawing);
  return points_of_drawing(*drawing, options, name);
}

Result<PointSeries> read_series(const std::string& path, const ImportOptions& options,
                                const RunContext& run) {
  if (path == "-") {  // read once
    const auto text = read_file(path);
    OBVID_TRY(text);
    return parse_series(*text, "standard input", options, run);
  }
  if (!is_drawing(path) || file_kind(head_of(path)) == FileKind::kContour) {
    OBVID_TRY(check_no_planes(options.planes, path));
    return placed(read_points(path, options.list), options);
  }
  auto drawing = read_drawing(path, options.planes, run);
  OBVID_TRY(drawing);
  return points_of_drawing(*drawing, options, path);
}

Result<RoadSeries> parse_road(const std::string& text, const std::string& name,
                              const ImportOptions& options, const RunContext& run) {
  RoadSeries out;
  if (!is_drawing_text(text, name)) {
    auto points = parse_series(text, name, options, run);
    OBVID_TRY(points);
    out.points = std::move(*points);
    return out;
  }
  auto drawing = parse_drawing(text, name, options.planes, run);
  OBVID_TRY(drawing);
  auto points = points_of_drawing(*drawing, options, name);
  OBVID_TRY(points);
  out.points = std::move(*points);
  const auto chosen = chosen_curve(*drawing, options.curve, name);
  OBVID_TRY(chosen);
  if (*chosen < drawing->curves.size()) out.road = drawn_road(drawing->curves[*chosen], options);
  return out;
}

Result<RoadSeries> read_road(const std::string& path, const ImportOptions& options,
                             const RunContext& run) {
  if (path != "-" && (!is_drawing(path) || is_cad(file_kind(head_of(path))))) {
    auto points = read_series(path, options, run);
    OBVID_TRY(points);
    return RoadSeries{std::move(*points), {}};
  }
  const auto text = read_file(path);
  OBVID_TRY(text);
  return parse_road(*text, path == "-" ? "standard input" : path, options, run);
}

Result<PointSeries> parse_point_list(const std::string& text, const std::string& name,
                                     const ImportOptions& options) {
  Result<PointSeries> list = parse_points(text, name, options.list);
  if (list) place(options.placement, *list);
  if (list && options.units) take_units(*list, *options.units);
  return list;
}

}  // namespace obvid
