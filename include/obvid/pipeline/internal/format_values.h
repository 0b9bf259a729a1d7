// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/pipeline/export.h"
#include "obvid/pipeline/import.h"

namespace obvid {

/// Options of the formats as they were typed.
struct FormatValues {
  std::optional<std::string> curve;  ///< number from 1, or a name
  std::optional<double> chord_tolerance;
  std::string drawing = "auto";
  std::vector<std::string> cut;  ///< planes that cut a mesh, "z=12"
  std::string columns;           ///< "2,3", from 1
  std::optional<long> skip;
  std::optional<double> scale, rotate_deg;
  std::string move;    ///< "DX,DY" or "DX,DY,DZ"
  std::string mirror;  ///< x or y
  bool unordered = false;
  bool drop_outliers = false;
  std::optional<double> tolerance;
  std::optional<double> face_width;
  std::optional<std::string> profile;
  std::optional<std::string> step;
  std::optional<std::string> dxf;
  std::optional<std::string> controller;
  std::optional<std::string> motion;
  std::optional<double> feed;
  std::optional<long> decimals;  ///< of places of G-code
  std::optional<long> samples;
  std::optional<double> sample_step;
  std::optional<std::string> airfoil, spacing;
  std::optional<double> trailing_edge;  ///< thickness, chords
  std::optional<std::string> trailing_form;
  bool unit_chord = false;
  std::optional<std::string> thickness, camber;  ///< chords, or with % behind
  std::optional<std::string> svg;
  std::optional<std::string> plot;
  std::optional<std::string> curvature_range;  ///< of pictures: auto, all or LOW..HIGH
};

/// Error: E203.
[[nodiscard]] Result<void> set_import(const FormatValues& typed, ImportOptions& options);
/// Error: E203.
[[nodiscard]] Result<void> set_shown(const FormatValues& typed, ShownCurvatures& shown);
/// Error: E203.
[[nodiscard]] Result<void> set_plots(const FormatValues& typed, PicturePlots& plots);
/// A profile first, then what was typed beside it. `profile_text` gets what the profile chose.
[[nodiscard]] Result<void> set_formats(const FormatValues& typed, ExportOptions& options,
                                       std::string& profile_text);

/// Sentences about options that none of these files asks for: a feed without G-code.
[[nodiscard]] std::vector<std::string> idle_options(const FormatValues& typed,
                                                    const std::vector<std::string>& files);

}  // namespace obvid
