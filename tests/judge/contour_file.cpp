// SPDX-License-Identifier: Apache-2.0
#include "contour_file.h"

#include <stdexcept>

namespace judge {
namespace {

Point point_of(const Json& json) {
  if (!json.is_array() || json.size() != 2) throw std::runtime_error("a point is no [x, y]");
  return {json[0].real(), json[1].real()};
}

std::vector<Point> points_of(const Json& json) {
  std::vector<Point> out;
  for (const Json& one : json) out.push_back(point_of(one));
  return out;
}

double number(const Json& json, const char* name) { return json.at(name).real(); }

Bezier bezier_of(const Json& json) {
  Bezier out;
  out.rounded = points_of(json.at("points"));
  out.offset = out.rounded;
  if (json.contains("exact")) {
    out.origin = point_of(json.at("exact").at("origin"));
    out.offset = points_of(json.at("exact").at("offsets"));
  }
  out.weight.assign(out.offset.size(), 1.0);
  if (json.contains("weights")) out.weight = json.at("weights").reals();
  if (out.offset.size() < 2 || out.offset.size() != out.rounded.size() ||
      out.weight.size() != out.offset.size()) {
    throw std::runtime_error("a Bezier piece has lists of different lengths");
  }
  return out;
}

Piece piece_of(const Json& json) {
  const std::string& type = json.at("type").string();
  if (type == "bezier") return bezier_of(json);
  const Point start = point_of(json.at("start")), end = point_of(json.at("end"));
  if (type == "line") return Line{start, end};
  if (type == "arc") {
    return Arc{start, end, number(json, "theta0"), number(json, "kappa"), number(json, "length")};
  }
  if (type == "clothoid") {
    return Clothoid{start,
                    end,
                    number(json, "theta0"),
                    number(json, "kappa0"),
                    number(json, "kappa1"),
                    number(json, "length")};
  }
  throw std::runtime_error("unknown type of piece: " + type);
}

FileElement element_of(const Json& json) {
  FileElement out;
  out.point = point_of(json.at("point"));
  out.heading = number(json, "heading");
  out.kappa = number(json, "kappa");
  const Json& source = member(json, "source");
  if (!source.is_null()) out.source = source.index();
  out.corner = flag(json, "corner").value_or(false);
  out.step = flag(json, "curvature_step").value_or(false);
  out.slope_step = flag(json, "slope_step").value_or(false);
  const Json& between = member(json, "between");
  if (!between.is_null()) {
    if (between.size() != 2) throw std::runtime_error("between names no two points");
    out.between = {between[0].index(), between[1].index()};
  }
  if (out.parted()) {
    out.heading_out = number(json, "heading_out");
    out.kappa_out = number(json, "kappa_out");
  }
  return out;
}

FileSpline spline_of(const Json& json) {
  FileSpline out;
  out.degree = static_cast<int>(json.at("degree").real());
  out.knots = json.at("knots").reals();
  out.points = points_of(json.at("points"));
  out.weights.assign(out.points.size(), 1.0);
  if (json.contains("weights")) out.weights = json.at("weights").reals();
  return out;
}

ContourFile contour_of(const Json& json) {
  ContourFile out;
  if (text_of(json, "format") != "obvid-contour" || json.at("version").real() != 1.0) {
    throw std::runtime_error("not a contour file of version 1");
  }
  out.units = json.at("units").string();
  out.units_source = json.contains("units_source") ? json.at("units_source").string() : "file";
  if (out.units_source != "file" && out.units_source != "given" && out.units_source != "assumed") {
    throw std::runtime_error("units_source is none of file, given, assumed");
  }
  out.carrier = json.at("carrier").string();
  out.continuity = json.contains("continuity") ? json.at("continuity").string() : "G2";
  out.closed = json.at("closed").truth();
  out.points = points_of(json.at("points"));
  if (json.contains("point_tolerance")) {
    out.tolerance = json.at("point_tolerance").reals();
  }
  for (const Json& one : json.at("elements")) out.elements.push_back(element_of(one));
  for (const Json& one : json.at("pieces")) out.pieces.push_back(piece_of(one));
  for (const Json& one : json.at("runs")) {
    out.runs.push_back({one.at("first_piece").index(), one.at("last_piece").index(),
                        static_cast<int>(one.at("direction").real())});
  }
  if (json.contains("bspline")) out.spline = spline_of(json.at("bspline"));
  out.report = member(json, "report");
  out.certificate = member(json, "certificate");
  out.given = member(json, "given");
  return out;
}

}  // namespace

const FileElement* ContourFile::joint(std::size_t i) const {
  if (elements.empty()) return nullptr;
  if (closed && i == pieces.size() && elements.size() == pieces.size()) return &elements.front();
  return i < elements.size() ? &elements[i] : nullptr;
}

bool ContourFile::corner_at(std::size_t joint_index) const {
  const FileElement* element = joint(joint_index);
  return element != nullptr && element->corner;
}

bool ContourFile::slope_step_at(std::size_t joint_index) const {
  const FileElement* element = joint(joint_index);
  return element != nullptr && element->slope_step;
}

bool ContourFile::parted_at(std::size_t joint_index) const {
  const FileElement* element = joint(joint_index);
  return element != nullptr && element->parted();
}

bool ContourFile::keeps_promise() const {
  const auto holds = [this](const char* name) { return flag(certificate, name).value_or(false); };
  const bool kept = promises_monotone() ? holds("proved")
                                        : holds("gaps_within_bounds") && holds("through_points");
  return kept && !too_wide();
}

bool ContourFile::too_wide() const {
  const Figure width = figure(report, "largest_width"), asked = figure(report, "tolerance");
  return width.known() && asked.known() && *width.value > *asked.value;
}

ReadContour read_contour(const std::string& text) {
  const ReadJson read = read_json(text);
  return read.fault.empty() ? read_contour(read.value) : ReadContour{{}, read.fault};
}

ReadContour read_contour(const Json& json) {
  ReadContour out;
  try {
    out.contour = contour_of(json);
  } catch (const std::exception& error) {
    out.fault = error.what();
  }
  return out;
}

}  // namespace judge
