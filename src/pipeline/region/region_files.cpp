// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/region_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "obvid/core/internal/figures.h"
#include "obvid/curve/internal/flatten.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/pipeline/internal/page_text.h"
#include "obvid/pipeline/internal/region_boundaries.h"
#include "obvid/pipeline/internal/report_json.h"
#include "obvid/region/internal/boundary_distance.h"
#include "obvid/region/internal/convex_triangle.h"

namespace obvid {
namespace {

std::optional<double> radius_of(std::optional<double> kappa) {
  if (!kappa) return std::nullopt;
  return std::isinf(*kappa) ? 0.0 : 1.0 / *kappa;  // infinite for a line
}

/// Least and greatest radius of a range of curvatures, each with its sign; a line has any.
std::pair<std::optional<double>, std::optional<double>> radii(
    const std::optional<CurvatureRange>& range) {
  if (!range) return {};
  const auto [least, greatest] = extreme_radii(*range);
  return {radius_of(least), radius_of(greatest)};
}

/// Ranges of headings are known to this (`feasible_data`), rad: only what is farther is outside.
constexpr double kRangeKnownTo = 1e-6;

constexpr int kMarkedDigits = 10;
constexpr const char* kOpenEnd = "*";  // of a range of headings, on pages

/// Whether ends of ranges that nothing limits have their mark: on pages, where it is explained.
enum class OpenEnds { kPlain, kMarked };

void add_rows_of(const RegionPart& part, const char* series, OpenEnds ends, DataTable& out) {
  const auto range_end = [ends](double degrees, bool open) {
    if (ends == OpenEnds::kPlain) return DataCell(degrees);
    return DataCell(DataCell(degrees).text(kMarkedDigits) + (open ? kOpenEnd : ""));
  };
  for (std::size_t i = 0; i < part.points.size(); ++i) {
    const RegionPoint& p = part.points[i];
    const auto [least, greatest] = radii(p.curvatures);
    const HeadingDegrees degrees(p.theta);
    DataRow& cells = out.rows.emplace_back(DataRow{
        series, p.inserted > 0 ? "inserted" : "point", region_point_name(p), p.point.x, p.point.y,
        radius_of(p.adjacent_kappa), degrees(p.theta),
        ends == OpenEnds::kMarked ? heading_came_by(p)
                                  : std::string(p.theta_given ? "given" : "chosen"),
        p.headings ? range_end(degrees(p.headings->low), p.headings->low_is_open) : DataCell(),
        p.headings ? range_end(degrees(p.headings->high), p.headings->high_is_open) : DataCell(),
        least, greatest});
    const auto row = std::find_if(part.rows.begin(), part.rows.end(),
                                  [i](const RegionRow& r) { return r.from == i; });
    if (row == part.rows.end()) continue;
    const DataRow segment = {region_segment_name(part, *row),
                             row->chord,
                             row->points_only_error,
                             row->to_apex,
                             row->from_apex,
                             row->lower_height,
                             row->width,
                             row->apex_height,
                             row->tangent_height,
                             row->apex_gap,
                             row->tangent_gap,
                             row->tangent_bound,
                             row->spline_distance};
    cells.insert(cells.end(), segment.begin(), segment.end());
  }
}

std::string tex_number(std::optional<double> value, int decimals) {
  if (!value || std::isnan(*value)) return "--";
  if (std::isinf(*value)) return "$\\infty$";
  return fmt::format("{:.{}f}", *value, decimals);
}

std::string tex_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '_' || c == '&' || c == '%' || c == '#' || c == '$') out += '\\';
    out += c;
  }
  return out;
}

/// Decimals that tell a millionth of the longest chord: four for some hundred millimetres.
int decimals_of(const RegionPart& part) {
  double largest = 0.0;
  for (const RegionRow& row : part.rows) largest = std::max(largest, row.chord);
  return largest > 0.0 ? std::max(6 - static_cast<int>(std::floor(std::log10(largest))), 0) : 0;
}

void add_latex(const RegionPart& part, std::string& out) {
  const int decimals = decimals_of(part);
  const int coarse = std::max(decimals - 2, 0);
  out +=
      "\\begin{tabular}{lrrrrrrrr}\n\\hline\n"
      "$i$ & $x_i$ & $y_i$ & $R_i^{AC}$ & heading & from & to & $R_{\\min}$ & $R_{\\max}$ \\\\\n"
      "\\hline\n";
  for (const RegionPoint& p : part.points) {
    const auto [least, greatest] = radii(p.curvatures);
    const HeadingDegrees degrees(p.theta);
    out +=
        fmt::format("{}{} & {} & {} & {} & {} & {} & {} & {} & {} \\\\\n", region_point_name(p),
                    p.inserted > 0 ? "$^+$" : "", tex_number(p.point.x, coarse),
                    tex_number(p.point.y, coarse), tex_number(radius_of(p.adjacent_kappa), coarse),
                    fmt::format("{:.3f}$^\\circ$", degrees(p.theta)),
                    p.headings ? fmt::format("{:.3f}$^\\circ$", degrees(p.headings->low)) : "--",
                    p.headings ? fmt::format("{:.3f}$^\\circ$", degrees(p.headings->high)) : "--",
                    tex_number(least, coarse), tex_number(greatest, coarse));
  }
  out +=
      "\\hline\n\\end{tabular}\n\n\\begin{tabular}{lrrrrrrrrrrr}\n\\hline\n"
      "$i$ & $|i,i{+}1|$ & $\\Delta^{AC}$ & $|i,T|$ & $|T,i{+}1|$ & $h$ & $\\delta$ & $H$ & $H^t$ "
      "& $\\Delta$ & $\\Delta^t$ & $f$ \\\\\n\\hline\n";
  for (const RegionRow& row : part.rows) {
    out += fmt::format("{} & {} & {} & {} & {} & {} & {} & {} & {} & {} & {} & {} \\\\\n",
                       region_segment_name(part, row), tex_number(row.chord, coarse),
                       tex_number(row.points_only_error, decimals), tex_number(row.to_apex, coarse),
                       tex_number(row.from_apex, coarse), tex_number(row.lower_height, decimals),
                       tex_number(row.width, decimals), tex_number(row.apex_height, decimals),
                       tex_number(row.tangent_height, decimals), tex_number(row.apex_gap, decimals),
                       tex_number(row.tangent_gap, decimals),
                       tex_number(row.spline_distance, decimals));
  }
  out += "\\hline\n\\end{tabular}\n";
}

void add_latex(const RegionTable& table, std::string& out) {
  const ConstructionTable& made = *table.construction;
  const int decimals = decimals_of(table.last());
  out += "\n\\begin{tabular}{l" + std::string(made.columns.size(), 'r') + "l}\n\\hline\n$i$";
  for (const std::string& column : made.columns) out += " & " + tex_text(column);
  out += " & \\\\\n\\hline\n";
  for (const ConstructionRow& row : made.rows) {
    out += region_segment_name(table.last(), table.last().rows[row.segment]);
    for (const double value : row.values) out += " & " + tex_number(value, decimals);
    out += " & " + tex_text(row.remark) + " \\\\\n";
  }
  out += "\\hline\n\\end{tabular}\n";
}

/// 1, 2 or 5 times a power of ten, not above a value.
double round_factor(double value) {
  if (!(value > 1.0) || !std::isfinite(value)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  const double rest = value / power;
  return power * (rest >= 5.0 ? 5.0 : rest >= 2.0 ? 2.0 : 1.0);
}

class WorksheetDrawing {
 public:
  WorksheetDrawing(const PointSeries& series, const RegionTable& table)
      : part_(table.last()), construction_(table.construction) {
    out_.sketch.title = series.name.empty() ? "region" : series.name;
    out_.sketch.units = series.units;
  }

  RegionDrawing run() {
    choose_factor();
    region_ = add("REGION", "region", "#e8a33d", 40, 0.6);
    region_->filled = true;
    out_.sketch.layers.front().title = fmt::format("region, {:g} times wider", out_.magnified);
    for (std::size_t i = 1; i + 1 < part_.points.size(); ++i) circle(i);
    for (const RegionRow& row : part_.rows) segment(row);
    if (construction_) add_construction();
    points();
    out_.sketch.remarks.push_back(fmt::format(
        "lengths in {}; the region is drawn {:g} times wider across its chords, all else in true "
        "scale",
        out_.sketch.units.text(), out_.magnified));
    return std::move(out_);
  }

 private:
  SketchLayer* add(const char* name, const char* title, const char* color, int dxf, double width) {
    constexpr std::size_t kLayers = 10;
    out_.sketch.layers.reserve(kLayers);  // so that pointers stay
    out_.sketch.layers.push_back(sketch_layer(name, title, color, dxf, width));
    return &out_.sketch.layers.back();
  }

  SketchLayer& layer(SketchLayer*& slot, const char* name, const char* title, const char* color,
                     int dxf, double width) {
    if (slot == nullptr) slot = add(name, title, color, dxf, width);
    return *slot;
  }

  /// So that the widest region takes a quarter of its chord. Rounding has no width.
  void choose_factor() {
    constexpr double kOfChord = 0.25;
    constexpr double kRoundings = 64.0 * 0x1p-53;  // of coordinates, and of what follows from them
    double widest = 0.0, coordinate = 0.0;
    for (const RegionPoint& p : part_.points) {
      coordinate = std::max({coordinate, std::abs(p.point.x), std::abs(p.point.y)});
    }
    for (const RegionRow& row : part_.rows) {
      if (!row.width || *row.width <= kRoundings * (coordinate + row.chord)) continue;
      widest = std::max(widest, *row.width / row.chord);
    }
    out_.magnified = widest > 0.0 ? round_factor(kOfChord / widest) : 1.0;
  }

  /// Arc of the adjacent circle from the point before to the point after.
  void circle(std::size_t i) {
    const RegionPoint& p = part_.points[i];
    if (!p.adjacent_kappa) return;
    const Vec2 a = part_.points[i - 1].point, b = part_.points[i + 1].point, m = p.point;
    auto& to = layer(circles_, "ADJACENT_CIRCLES", "adjacent circles", "#7a9cc6", 5, 0.7);
    const double kappa = *p.adjacent_kappa;
    if (kappa == 0.0) {
      to.pieces.emplace_back(LinePiece{a, b});
      return;
    }
    // the whole arc turns by twice as much as the chords do at the point
    const double turn = 2.0 * turning(m - a, b - m);
    to.pieces.emplace_back(ArcPiece{a, b, heading(b - a) - 0.5 * turn, kappa, turn / kappa});
  }

  void segment(const RegionRow& row) {
    const RegionPoint &a = part_.points[row.from], &b = part_.points[row.to];
    if (const auto t =
            tangent_triangle(a.point, unit_at(row.theta_start), b.point, unit_at(row.theta_end))) {
      auto& sides =
          layer(triangles_, "TRIANGLES", "triangles of tangents and chords", "#999999", 8, 0.7);
      sides.dashed = true;
      sides.polylines.push_back({a.point, t->apex, b.point, a.point});
    }
    if (!row.region) return;
    const PlacedBoundaries& r = *row.region;
    auto& first = layer(from_start_, "LIMIT_FROM_START", "limiting arcs: circle at the first point",
                        "#c0392b", 1, 1.2);
    add_arcs(first, r, r.region.from_start);
    auto& second = layer(to_end_, "LIMIT_TO_END", "limiting arcs: circle at the second point",
                         "#1e8449", 3, 1.2);
    add_arcs(second, r, r.region.to_end);
    add_magnified(r);
  }

  static Vec2 in_plane(const PlacedBoundaries& r, Vec2 local) {
    return r.start + local.x * r.along + local.y * left_normal(r.along);
  }

  static void add_arcs(SketchLayer& to, const PlacedBoundaries& r, const Boundary& b) {
    const std::vector<Piece> arcs = boundary_in_plane(r, b);
    to.pieces.insert(to.pieces.end(), arcs.begin(), arcs.end());
  }

  void add_magnified(const PlacedBoundaries& r) {
    constexpr int kStripSteps = 40;
    std::vector<Vec2> one, other;
    for (int k = 0; k <= kStripSteps; ++k) {
      const double x = r.frame.h * k / kStripSteps;
      const auto y0 = ordinate_over_chord(r.frame, r.region.from_start, x);
      const auto y1 = ordinate_over_chord(r.frame, r.region.to_end, x);
      if (!y0 || !y1) return;
      const double middle = 0.5 * (*y0 + *y1), half = 0.5 * out_.magnified * (*y1 - *y0);
      one.push_back(in_plane(r, {x, middle - half}));
      other.push_back(in_plane(r, {x, middle + half}));
    }
    one.insert(one.end(), other.rbegin(), other.rend());
    region_->polylines.push_back(std::move(one));
  }

  /// Lines and arcs as they are; other pieces as polylines.
  void add_construction() {
    auto* layer = add("CONSTRUCTION", "construction", "#6c3483", 4, 1.6);
    constexpr double kDrawnWithin = 1e-4;  // of the piece's chord: not seen in a picture
    constexpr int kFewestLines = 8, kMostLines = 64;
    for (const Piece& piece : construction_->pieces) {
      if (std::holds_alternative<ArcPiece>(piece) || std::holds_alternative<LinePiece>(piece)) {
        layer->pieces.push_back(piece);
        continue;
      }
      std::vector<Vec2> line;
      const double within = kDrawnWithin * norm(end_point(piece) - start_point(piece));
      const int lines = chord_steps(piece, within, kFewestLines, kMostLines);
      for (int k = 0; k <= lines; ++k) {
        line.push_back(evaluate(piece, static_cast<double>(k) / lines).point);
      }
      layer->polylines.push_back(std::move(line));
    }
  }

  void points() {
    auto* tangents = add("TANGENTS", "tangents", "#555555", 6, 0.9);
    auto* user = add("POINTS", "points", "#000000", 7, 1.0);
    SketchLayer* inserted = nullptr;
    for (std::size_t i = 0; i < part_.points.size(); ++i) {
      const RegionPoint& p = part_.points[i];
      double reach = 0.0;
      for (const std::size_t k : {i > 0 ? i - 1 : i, i + 1 < part_.points.size() ? i + 1 : i}) {
        reach = std::max(reach, norm(part_.points[k].point - p.point));
      }
      constexpr double kOfReach = 0.25;
      const Vec2 half = kOfReach * reach * unit_at(p.theta);
      tangents->pieces.emplace_back(LinePiece{p.point - half, p.point + half});
      if (p.inserted > 0) {
        layer(inserted, "INSERTED", "inserted points", "#c0392b", 1, 1.0).points.push_back(p.point);
      } else {
        user->points.push_back(p.point);
      }
      out_.sketch.words.push_back({p.point, region_point_name(p)});
    }
  }

  const RegionPart& part_;
  const std::optional<ConstructionTable>& construction_;
  RegionDrawing out_;
  SketchLayer *region_ = nullptr, *circles_ = nullptr, *triangles_ = nullptr,
              *from_start_ = nullptr, *to_end_ = nullptr;
};

}  // namespace

ExtremeRadii extreme_radii(const CurvatureRange& range) {
  double least = range.low, greatest = range.high;
  if (std::abs(least) < std::abs(greatest)) std::swap(least, greatest);
  if (range.low <= 0.0 && range.high >= 0.0) greatest = 0.0;
  return {least, greatest};
}

std::string region_point_name(const RegionPoint& point) {
  return point.inserted > 0 ? fmt::format("{}.{}", point.number + 1, point.inserted)
                            : fmt::format("{}", point.number + 1);
}

std::string region_segment_name(const RegionPart& part, const RegionRow& row) {
  return region_point_name(part.points[row.from]) + "-" + region_point_name(part.points[row.to]);
}

std::string heading_came_by(const RegionPoint& point) {
  if (point.inserted > 0) return "inserted";
  std::string out = point.theta_given ? "given" : "chosen";
  if (point.kappa_given) out += point.theta_given ? ", radius too" : ", radius given";
  const auto beyond = [](double way, bool open) { return !open && way > kRangeKnownTo; };
  const auto& range = point.headings;
  const bool outside = range && (beyond(range->low - point.theta, range->low_is_open) ||
                                 beyond(point.theta - range->high, range->high_is_open));
  // on an arc there is one heading, and it is that
  if (outside && range->low < range->high) out += ", OUTSIDE its range";
  return out;
}

std::vector<std::string> region_legend(const RegionTable& table) {
  return {table.closed ? "range of headings: a curve that keeps all else that is given has none "
                         "beyond; near the ends of the range there may be none that closes"
                       : "range of headings: with each of them there is a curve that keeps all "
                         "other given data",
          "radii: with the headings of the table",
          "T: where the tangents at points i and i+1 meet",
          "h: height of the lower boundary above the chord, delta: width of the region, both over "
          "the middle of the chord",
          "H, Ht: height of the triangle of the neighbouring chords, of the tangents; Delta, Delta "
          "t: the same above the lower boundary",
          "f: of the cubic spline through the points from the farther boundary"};
}

FigureRows region_figures(const RegionPart& part, const Units& units) {
  constexpr int kWidthDigits = 4;
  const auto [width, unknown] = widest_row(part);
  FigureRows out = {
      {"largest delta", width ? significant(*width, kWidthDigits) + " " + units.text() : "-"}};
  if (unknown > 0) {
    out.emplace_back("unknown",
                     fmt::format("over {}, where a vertex or half a turn lies between points, "
                                 "where the headings leave no curve, or where no more than three "
                                 "points say how the curve goes and one circle fits them",
                                 counted(unknown, "segment", "segments")));
  }
  const bool open = std::any_of(part.points.begin(), part.points.end(), [](const RegionPoint& p) {
    return p.headings && (p.headings->low_is_open || p.headings->high_is_open);
  });
  if (open) {
    out.emplace_back(kOpenEnd,
                     "nothing ends the range there: told up to a right angle from the chord at an "
                     "end of the series, up to half a turn between points elsewhere");
  }
  return out;
}

namespace {

DataTable rows_of_region(const RegionTable& table, OpenEnds ends) {
  DataTable out{heads_of(
      "series,row,point,x,y,adjacent_radius,heading_deg,heading,heading_min_deg,heading_max_deg,"
      "least_radius,greatest_radius,segment,chord,points_only_error,to_apex,from_apex,h,delta,H,Ht,"
      "Delta,Delta_t,Delta_t_bound,f")};
  add_rows_of(table.user, "points", ends, out);
  if (table.refined) add_rows_of(*table.refined, "refined", ends, out);
  return out;
}

}  // namespace

DataTable region_rows(const RegionTable& table) { return rows_of_region(table, OpenEnds::kPlain); }

DataTable construction_rows(const RegionTable& table) {
  DataTable out;
  if (!table.construction) return out;
  out.heads = {"segment"};
  const auto& columns = table.construction->columns;
  out.heads.insert(out.heads.end(), columns.begin(), columns.end());
  out.heads.emplace_back("remark");
  for (const ConstructionRow& row : table.construction->rows) {
    DataRow& cells = out.rows.emplace_back(
        DataRow{region_segment_name(table.last(), table.last().rows[row.segment])});
    cells.insert(cells.end(), row.values.begin(), row.values.end());
    cells.emplace_back(row.remark);
  }
  return out;
}

std::string region_latex(const PointSeries& series, const RegionTable& table) {
  std::string out =
      fmt::format("% {}, lengths in {}\n", tex_text(series.name), series.units.text());
  add_latex(table.user, out);
  if (table.refined) {
    out += "\n% with the inserted points\n";
    add_latex(*table.refined, out);
  }
  if (table.construction) add_latex(table, out);
  return out;
}

namespace {

std::string drawn_wider(const RegionDrawing& drawing) {
  return fmt::format("the region is drawn {:g} times wider across its chords", drawing.magnified);
}

RegionFile region_page(const PointSeries& series, const RegionTable& table,
                       const std::string& asked) {
  const RegionDrawing drawing = region_drawing(series, table);
  const FigureRows figures = region_figures(table.last(), series.units);
  ReportPage page;
  page.title = series.name;
  const std::string& widest = figures.front().second;
  page.verdict = widest == "-" ? "no width of the region is known"
                               : "largest known width of the region " + widest;
  page.pictures.push_back(sketch_svg(drawing.sketch));
  if (!asked.empty()) page.figures.emplace_back("asked for", asked);
  page.figures.emplace_back("lengths in", series.units.text());
  page.figures.emplace_back("points", std::to_string(series.points.size()));
  page.figures.emplace_back("picture", drawn_wider(drawing));
  const FigureRows first = table.refined ? region_figures(table.user, series.units) : figures;
  page.figures.insert(page.figures.end(), first.begin(), first.end());
  if (table.refined) {
    const std::size_t more = table.refined->points.size() - table.user.points.size();
    page.figures.emplace_back("with more points",
                              fmt::format("{} inserted", counted(more, "point", "points")));
    page.figures.insert(page.figures.end(), figures.begin(), figures.end());
  }
  page.warnings = series.warnings;
  page.warnings.insert(page.warnings.end(), table.warnings.begin(), table.warnings.end());
  page.notes = region_legend(table);
  if (table.construction) {
    const auto& more = table.construction->remarks;
    page.notes.insert(page.notes.end(), more.begin(), more.end());
  }
  page.tables.push_back(table_of_page("region", "Points and the segments that begin there",
                                      rows_of_region(table, OpenEnds::kMarked)));
  page.tables.push_back(table_of_page("construction", "Construction", construction_rows(table)));
  return {page_text(page), ""};
}

}  // namespace

RegionDrawing region_drawing(const PointSeries& series, const RegionTable& table) {
  return WorksheetDrawing(series, table).run();
}

Result<RegionFile> region_file(const std::string& ending, const PointSeries& series,
                               const RegionTable& table, const RunContext& run,
                               const std::string& asked) {
  std::string kind = ending;
  std::transform(kind.begin(), kind.end(), kind.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (kind == "csv") {
    return RegionFile{csv_text(table.construction ? construction_rows(table) : region_rows(table)),
                      ""};
  }
  if (kind == "tex") return RegionFile{region_latex(series, table), ""};
  if (kind == "json") {
    auto text = region_json(series, table, run);
    OBVID_TRY(text);
    return RegionFile{*text + "\n", ""};
  }
  if (kind == "svg" || kind == "dxf") {
    const RegionDrawing drawing = region_drawing(series, table);
    return RegionFile{kind == "svg" ? sketch_svg(drawing.sketch) : sketch_dxf(drawing.sketch),
                      drawn_wider(drawing)};
  }
  if (kind == "html") return region_page(series, table, asked);
  return error(ErrorCode::kUnknownFormat, "region writes no such file")
      .where(ending)
      .hint("possible are .csv, .tex, .json (tables), .svg and .dxf (drawings), .html (page)");
}

}  // namespace obvid
