// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/element_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "alignment/profile_table.h"
#include "obvid/curve/internal/contour_path.h"
#include "obvid/curve/pieces.h"
#include "obvid/geom/internal/angle.h"

namespace obvid {
namespace {

DataCell radius_cell(double kappa) {
  return kappa == 0.0 || !std::isfinite(kappa) ? DataCell() : DataCell(1.0 / kappa);
}

std::optional<AlignmentKind> kind_of_element(const Piece& piece) {
  if (std::holds_alternative<LinePiece>(piece)) return AlignmentKind::kLine;
  if (std::holds_alternative<ArcPiece>(piece)) return AlignmentKind::kArc;
  if (std::holds_alternative<ClothoidPiece>(piece)) return AlignmentKind::kClothoid;
  const auto& bezier = std::get<RationalBezier>(piece);
  constexpr int kCubicDegree = 3;
  if (bezier.degree > kCubicDegree || !is_polynomial(bezier)) return std::nullopt;
  return AlignmentKind::kPolynomial;
}

/// Of a cubic what its table of lengths tells; of others it is exact.
double length_of_element(const Piece& piece, AlignmentKind kind) {
  return kind == AlignmentKind::kPolynomial ? PieceLength(piece, kFinestLength).length()
                                            : arc_length(piece, 0.0);
}

}  // namespace

std::optional<std::vector<AlignmentElement>> elements_of(
    const Contour& contour, double first_station,
    const std::vector<PlacedTransition>& transitions) {
  std::vector<AlignmentElement> out;
  double station = first_station;
  auto next = transitions.begin();
  for (std::size_t k = 0; k < contour.pieces.size(); ++k) {
    const Piece& piece = contour.pieces[k];
    const auto kind = kind_of_element(piece);
    if (!kind) return std::nullopt;
    while (next != transitions.end() && next->first_piece < k) ++next;
    const bool stands_for = next != transitions.end() && next->first_piece == k;
    AlignmentElement& e = out.emplace_back();
    e.kind = *kind;
    e.station = station;
    e.start = element_at(piece, 0.0);
    e.kappa1 = element_at(piece, 1.0).kappa;
    e.length = length_of_element(piece, *kind);
    if (stands_for) {
      e.kind = static_cast<AlignmentKind>(static_cast<int>(AlignmentKind::kClothoid) +
                                          static_cast<int>(next->kind));
      e.start.kappa = next->kappa0;
      e.kappa1 = next->kappa1;
      e.length = next->length;
      k += next->pieces - 1;
    }
    const double before = out.size() > 1   ? out[out.size() - 2].kappa1
                          : contour.closed ? element_at(contour.pieces.back(), 1.0).kappa
                                           : e.start.kappa;
    const double larger = std::max(std::abs(before), std::abs(e.start.kappa));
    e.step = std::abs(e.start.kappa - before) > kMostCurvatureStep * larger;
    station += e.length;
  }
  return out;
}

std::optional<std::vector<AlignmentElement>> elements_of(const CurveAudit& audit) {
  return audit.station ? elements_of(audit.contour, *audit.station, audit.transitions)
                       : std::nullopt;
}

std::optional<double> speed_kmh(const AlignmentElement& element, const SpeedLimit& limit) {
  constexpr double kKmhPerMs = 3.6;
  const double kappa = std::max(std::abs(element.start.kappa), std::abs(element.kappa1));
  if (kappa == 0.0) return std::nullopt;
  return kKmhPerMs * std::sqrt(limit.acceleration * limit.metres / kappa);
}

DataTable element_rows(const std::vector<AlignmentElement>& elements,
                       const std::optional<SpeedLimit>& limit) {
  DataTable out{heads_of("kind,station,length,radius_start,radius_end,A,azimuth_deg,x,y")};
  if (limit) out.heads.emplace_back("speed_kmh");
  for (const AlignmentElement& e : elements) {
    const double parameter = clothoid_parameter(e);
    out.rows.push_back({to_string(e.kind), e.station, e.length, radius_cell(e.start.kappa),
                        radius_cell(e.kappa1), parameter > 0.0 ? DataCell(parameter) : DataCell(),
                        azimuth_deg(e.start.theta), e.start.point.x, e.start.point.y});
    if (limit) out.rows.back().emplace_back(speed_kmh(e, *limit));
  }
  return out;
}

void add_elements(JsonText& json, const std::vector<AlignmentElement>& elements,
                  const std::optional<SpeedLimit>& limit) {
  json.begin_array();
  for (const AlignmentElement& e : elements) {
    json.begin_object().pair("kind", to_string(e.kind)).pair("station", e.station);
    json.pair("length", e.length).pair("x", e.start.point.x).pair("y", e.start.point.y);
    json.pair("heading", e.start.theta).pair("curvature_start", e.start.kappa);
    json.pair("curvature_end", e.kappa1).pair("step", e.step);
    if (const auto speed = limit ? speed_kmh(e, *limit) : std::nullopt) {
      json.pair("speed_kmh", *speed);
    }
    json.end_object();
  }
  json.end_array();
}

void add_profile(JsonText& json, const VerticalProfile& profile) {
  json.begin_object();
  json.pair("curves", name_of(profile.curves));
  pipeline_detail::add_profile_elements(json, profile);
  json.end_object();
}

namespace pipeline_detail {

void add_profile_elements(JsonText& json, const VerticalProfile& profile) {
  json.pair("end_station", profile.end_station).pair("end_height", profile.end_height);
  json.key("elements").begin_array();
  for (const ProfileElement& e : profile.elements) {
    json.begin_object().pair("kind", to_string(e.kind)).pair("station", e.station);
    json.pair("length", e.length).pair("height", e.height);
    json.pair("grade_start", e.grade0).pair("grade_end", e.grade1);
    if (e.kind != ProfileKind::kGrade) {
      const Vec2 meeting = grades_meet(e, profile.curves);
      json.pair("radius", e.radius);
      json.pair("pvi_station", meeting.x).pair("pvi_height", meeting.y);
    }
    json.end_object();
  }
  json.end_array();
}

}  // namespace pipeline_detail

const char* to_string(ProfileKind kind) {
  return kProfileKindNames[static_cast<std::size_t>(kind)].data();
}

const char* to_string(AlignmentKind kind) {
  static constexpr std::array<const char*, kAlignmentKinds> kNames = {
      "line", "arc", "clothoid", "bloss", "sine", "cosine", "helmert", "cubic", "cubic curve"};
  return kNames[static_cast<std::size_t>(kind)];
}

double clothoid_parameter(const AlignmentElement& element) {
  const double change = std::abs(element.kappa1 - element.start.kappa);
  if (element.kind != AlignmentKind::kClothoid) return 0.0;
  return change > 0.0 ? std::sqrt(element.length / change) : 0.0;
}

double azimuth_deg(double theta) {
  const double angle = turn_between(theta, 0.5 * std::numbers::pi) / kOneDegree;
  const double turned = angle < 0.0 ? angle + 360.0 : angle;
  return turned < 360.0 ? turned : 0.0;  // a rounding below north
}

std::size_t curvature_steps(const std::vector<AlignmentElement>& elements) {
  return static_cast<std::size_t>(
      std::count_if(elements.begin(), elements.end(), [](const auto& e) { return e.step; }));
}

}  // namespace obvid
