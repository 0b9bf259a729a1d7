// SPDX-License-Identifier: Apache-2.0
#include "report_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "obvid/pipeline/internal/carrier_names.h"

namespace obvid::batch {
namespace {

using pipeline_detail::kFormedCarriers;
using ReportJson = nlohmann::json;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kTolerances = 8;  // rows of a table of tolerances

double number_at(const ReportJson& object, const char* name, double otherwise) {
  if (!object.is_object()) return otherwise;
  const auto at = object.find(name);
  return at != object.end() && at->is_number() ? at->get<double>() : otherwise;
}

int count_at(const ReportJson& object, const char* name) {
  return static_cast<int>(number_at(object, name, kUnknownCount));
}

int size_at(const ReportJson& object, const char* name) {
  const auto at = object.find(name);
  return at != object.end() && at->is_array() ? static_cast<int>(at->size()) : -1;
}

double largest_at(const ReportJson& object, const char* rows, const char* name) {
  double out = kUnknown;
  const auto at = object.find(rows);
  if (at == object.end() || !at->is_array()) return out;
  for (const ReportJson& row : *at) out = std::fmax(out, number_at(row, name, kUnknown));
  return out;
}

std::vector<std::string> warnings_in(const ReportJson& report) {
  std::vector<std::string> out;
  const auto at = report.find("warnings");
  if (at == report.end() || !at->is_array()) return out;
  for (const ReportJson& one : *at) {
    if (one.is_string()) out.push_back(one.get<std::string>());
  }
  return out;
}

std::vector<double> of_compare(const ReportJson& report, obvid_figures& figures) {
  std::vector<double> out(5 * kFormedCarriers.size(), kUnknown);
  const auto rows = report.find("carriers");
  if (rows == report.end()) return out;
  for (const ReportJson& row : *rows) {
    const auto name =
        std::find(kFormedCarriers.begin(), kFormedCarriers.end(), row.value("carrier", ""));
    if (name == kFormedCarriers.end()) continue;
    const std::size_t first = 5 * static_cast<std::size_t>(name - kFormedCarriers.begin());
    const std::string code = row.contains("refusal") && row["refusal"].is_object()
                                 ? row["refusal"].value("code", "E0")
                                 : "E0";
    out[first] = std::stod(code.substr(1));
    out[first + 1] = count_at(row, "vertices");
    out[first + 2] = count_at(row, "pieces");
    out[first + 3] = number_at(row, "error_bound", kUnknown);
    out[first + 4] = number_at(row, "deviation", kUnknown);
    if (name != kFormedCarriers.begin()) continue;
    figures.vertices = count_at(row, "vertices");
    figures.inflections = count_at(row, "inflections");
    figures.pieces = count_at(row, "pieces");
    figures.error = number_at(row, "error_bound", kUnknown);
    figures.proved = row.contains("monotone") ? (row.value("monotone", false) ? 1 : 0) : -1;
  }
  return out;
}

std::vector<double> of_suggest(const ReportJson& report, std::vector<double> out,
                               obvid_figures& figures) {
  const auto rows = report.find("rows");
  if (rows == report.end()) return out;
  for (std::size_t i = 0; i < std::min(kTolerances, rows->size()); ++i) {
    const ReportJson& row = (*rows)[i];
    out[2 * i] = number_at(row, "tolerance", kUnknown);
    out[2 * i + 1] = row.value("formed", false) ? count_at(row, "vertices") : kUnknownCount;
  }
  const int taken = count_at(report, "recommended");
  if (taken >= 0 && static_cast<std::size_t>(taken) < rows->size()) {
    const ReportJson& row = (*rows)[static_cast<std::size_t>(taken)];
    figures.vertices = count_at(row, "vertices");
    figures.bound = count_at(row, "vertices_lower_bound");
    figures.inflections = count_at(row, "inflections");
    figures.pieces = count_at(row, "pieces");
    figures.move = number_at(row, "largest_move", kUnknown);
    figures.proved = row.value("proved", false) ? 1 : 0;
  }
  return out;
}

void of_analyse(const ReportJson& report, obvid_figures& figures) {
  // of a drawing the points are one part of the report
  const auto within = report.find("points");
  const ReportJson& points = within != report.end() && within->is_object() ? *within : report;
  figures.points = size_at(points, "points");
  figures.vertices = count_at(points, "vertices");
  figures.bound = count_at(points, "vertices_lower_bound");
  figures.inflections = count_at(points, "inflections");
  figures.error = largest_at(points, "segments", "points_only_error");
}

void of_region(const ReportJson& report, obvid_figures& figures) {
  figures.points = size_at(report, "points");
  figures.width = largest_at(report, "segments", "width");
}

int proved_at(const ReportJson& row) {
  return row.contains("proved") ? (row.value("proved", false) ? 1 : 0) : -1;
}

std::vector<double> of_alignment(const ReportJson& report, obvid_figures& figures) {
  figures.points = size_at(report, "deviations");
  figures.pieces = size_at(report, "elements");
  std::array<double, 3> kinds{};
  for (const ReportJson& element : report.value("elements", ReportJson::array())) {
    const std::string kind = element.value("kind", "");
    ++kinds[kind == "line" ? 0 : kind == "arc" ? 1 : 2];
  }
  for (const ReportJson& one : report.value("deviations", ReportJson::array())) {
    figures.move = std::fmax(figures.move, std::abs(number_at(one, "offset", kUnknown)));
  }
  return {kinds[0], kinds[1], kinds[2], number_at(report, "length", kUnknown),
          number_at(report, "rms", kUnknown)};
}

std::vector<double> of_cut(const ReportJson& report) {
  const ReportJson made = report.value("report", ReportJson::object());
  std::vector<double> out{static_cast<double>(size_at(report, "outlines"))};
  for (const char* name : {"blocks", "arc_blocks"}) out.push_back(count_at(made, name));
  for (const char* name :
       {"cut_length", "rapid_length", "minutes", "beyond", "short_of", "left_in_corners"}) {
    out.push_back(number_at(made, name, kUnknown));
  }
  return out;
}

/// Of the one curve that is laid over the other: as both lie, and with both chords on one line.
std::vector<double> of_compared_curves(const ReportJson& report, obvid_figures& figures) {
  const ReportJson curves = report.value("curves", ReportJson::array());
  if (curves.size() > 1) {
    const ReportJson& one = curves[1];
    figures.points = count_at(one, "points");
    figures.vertices = count_at(one, "vertices");
    figures.proved = proved_at(one);
  }
  std::vector<double> out;
  for (const char* laid : {"as_they_lie", "on_one_chord"}) {
    const ReportJson rows = report.value(laid, ReportJson::array());
    const ReportJson row = rows.empty() ? ReportJson::object() : rows[0];
    const ReportJson largest = row.value("largest", ReportJson::object());
    for (const char* name : {"deviation", "x", "y"}) {
      out.push_back(number_at(largest, name, kUnknown));
    }
    out.push_back(number_at(row, "root_mean_square", kUnknown));
  }
  return out;
}

std::vector<double> of_spline(const ReportJson& report, obvid_figures& figures) {
  const ReportJson rows = report.value("rows", ReportJson::array());
  const ReportJson row = rows.empty() ? ReportJson::object() : rows[0];
  figures.points = size_at(report, report.contains("nodes") ? "nodes" : "values");
  figures.move = number_at(row, "largest_move", kUnknown);
  return {number_at(row, "integral", kUnknown), number_at(row, "largest_error", kUnknown),
          number_at(row, "rms_error", kUnknown), static_cast<double>(count_at(row, "blocks"))};
}

std::vector<double> of_nurbs(const ReportJson& report, obvid_figures& figures) {
  figures.points = size_at(report, "points");
  return {static_cast<double>(count_at(report, "degree")),
          static_cast<double>(count_at(report, "degree_v"))};
}

}  // namespace

obvid_figures unknown_figures() {
  return {-1, -1, -1, -1, -1, -1, -1, kUnknown, kUnknown, kUnknown};
}

std::vector<Column> report_columns(const JobKind& kind) {
  using enum Column::Type;
  std::vector<Column> out;
  if (kind.name == "compare" && kind.against) {
    for (const std::string laid : {"", "chord_"}) {
      out.push_back({laid + "deviation", kNumber, "largest from the curve of --against, units"});
      out.push_back({laid + "x", kNumber, "where that is"});
      out.push_back({laid + "y", kNumber, ""});
      out.push_back({laid + "rms", kNumber, "root mean square of the deviations, units"});
    }
  } else if (kind.name == "compare") {
    for (const std::string_view carrier : kFormedCarriers) {
      const std::string name(carrier);
      out.push_back({name + "_code", kNumber, "number of the error of this carrier, 0 none"});
      out.push_back({name + "_vertices", kNumber, ""});
      out.push_back({name + "_pieces", kNumber, ""});
      out.push_back({name + "_error", kNumber, "as error, of this carrier, units"});
      out.push_back({name + "_deviation", kNumber, "largest distance from the spirals, units"});
    }
  } else if (kind.name == "suggest") {
    for (std::size_t i = 1; i <= kTolerances; ++i) {
      out.push_back({"tolerance_" + std::to_string(i), kNumber, "units"});
      out.push_back({"vertices_" + std::to_string(i), kCount, "with this tolerance; -1 none"});
    }
  } else if (kind.name == "alignment") {
    out = {{"lines", kCount, "elements that are lines"},
           {"arcs", kCount, ""},
           {"transitions", kCount, "clothoids and other transitions"},
           {"length", kNumber, "units"},
           {"rms", kNumber, "root mean square of the offsets of points, units"}};
  } else if (kind.name == "cut") {
    out = {{"outlines", kCount, "that are cut"},
           {"blocks", kCount, "at feed"},
           {"arc_blocks", kCount, "of them arcs"},
           {"cut_length", kNumber, "at feed, units"},
           {"rapid_length", kNumber, "units"},
           {"minutes", kNumber, "with acceleration"},
           {"beyond", kNumber, "of an outline, read back, units"},
           {"short_of", kNumber, "of an outline, read back, units"},
           {"left_in_corners", kNumber, "by a round tool, units"}};
  } else if (kind.name == "spline") {
    out = {{"integral", kNumber, "over all"},
           {"largest_error", kNumber, "against the file of --against"},
           {"rms_error", kNumber, ""},
           {"moves", kCount, "straight ones within the tolerance"}};
  } else if (kind.name == "nurbs") {
    out = {{"degree", kCount, ""}, {"degree_v", kCount, "of a surface; -1: a curve"}};
  }
  return out;
}

TakenReport take_report(const JobKind& kind, const char* text, obvid_figures& figures) {
  TakenReport out;
  for (const Column& column : report_columns(kind)) {
    out.values.push_back(column.type == Column::Type::kNumber ? kUnknown : kUnknownCount);
  }
  if (text == nullptr || !kind.reports || kind.name == "verify") return out;
  const ReportJson report = ReportJson::parse(text, nullptr, false);
  if (!report.is_object()) return out;
  out.warnings = warnings_in(report);
  if (kind.name == "compare") {
    out.values = kind.against ? of_compared_curves(report, figures) : of_compare(report, figures);
  } else if (kind.name == "suggest") {
    out.values = of_suggest(report, std::move(out.values), figures);
  } else if (kind.name == "alignment") {
    out.values = of_alignment(report, figures);
  } else if (kind.name == "cut") {
    out.values = of_cut(report);
  } else if (kind.name == "spline") {
    out.values = of_spline(report, figures);
  } else if (kind.name == "nurbs") {
    out.values = of_nurbs(report, figures);
  } else if (kind.name == "analyse") {
    of_analyse(report, figures);
  } else if (kind.name == "region") {
    of_region(report, figures);
  }
  return out;
}

}  // namespace obvid::batch
