// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/titled_contour.h"

#include <filesystem>
#include <utility>

namespace obvid {

std::string curve_name(const PointSeries& series, const std::string& input) {
  if (!series.label.empty()) return series.label;
  const std::string file = std::filesystem::path(input).filename().string();
  if (!series.name.empty() && series.name != file) return series.name;
  return TitledContour{}.name;
}

TitledContour titled_contour(Fit made, const PointSeries& series, const std::string& input) {
  TitledContour out;
  out.stored = {std::move(made.contour), std::move(made.report), std::move(made.certificate)};
  out.name = curve_name(series, input);
  out.id = series.id;
  out.layer = series.layer;
  out.source = input;
  out.picture.name = series.name;
  out.warnings = std::move(made.warnings);
  return out;
}

void set_titles(const TitledContour& contour, const std::string& profile, ExportOptions& formats) {
  formats.name = contour.name;
  formats.picture = contour.picture;
  formats.first_station = contour.first_station;
  formats.transitions = contour.transitions;
  formats.profile = contour.profile;
  formats.told = {contour.remarks, contour.warnings};
  if (!profile.empty()) formats.told.remarks.insert(formats.told.remarks.begin(), profile);
}

}  // namespace obvid
