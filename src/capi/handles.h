// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "obvid/obvid.h"
#include "obvid/picture/surface_svg.h"
#include "obvid/pipeline/export.h"
#include "obvid/pipeline/internal/titled_contour.h"
#include "obvid/pipeline/space_fit.h"
#include "obvid/report/stored_contour.h"
#include "obvid/series/point_series.h"
#include "obvid/surface/surface.h"

// What stands behind the opaque types of obvid.h.

/// What jobs read: points as they were given, or a text, or the path of a file that only the helper
/// of the CAD kernel reads.
struct obvid_input {
  std::string name;
  std::optional<obvid::PointSeries> points;
  std::optional<obvid::SpaceSeries> space;
  std::string text;
  bool is_file = false;  ///< `name` is its path
  bool by_path = false;
};

struct obvid_contour : obvid::TitledContour {
  obvid_contour() = default;
  explicit obvid_contour(obvid::TitledContour made) : obvid::TitledContour(std::move(made)) {}
};

struct obvid_space {
  obvid::SpaceChain chain;
  std::optional<obvid::StoredSpaceChain> stored;  ///< what a file says of it
};

struct obvid_surface {
  obvid::SurfaceModel model;
  std::string source;                              ///< its only input, as it was named
  std::vector<obvid::ScenePolyline> lines;         ///< inputs, drawn on pages and pictures
  obvid::ShownLongitudinals beside_longitudinals;  ///< of pictures of longitudinals
  std::vector<std::string> warnings;
};

struct obvid_files {
  std::vector<obvid::ExportedFile> files;
  std::vector<std::string> remarks;
};
