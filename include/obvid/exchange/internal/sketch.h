// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/core/units.h"
#include "obvid/curve/pieces.h"
#include "obvid/geom/vec2.h"

namespace obvid {

/// Lines, arcs and words in named layers: a drawing that explains a construction.
struct SketchLayer {
  std::string name;    ///< letters, digits, - and _
  std::string title;   ///< for the legend of a picture
  std::string color;   ///< of a picture, #rrggbb
  int dxf_color = 7;   ///< AutoCAD colour index
  double width = 1.0;  ///< of lines in a picture, pixels
  bool dashed = false;
  bool filled = false;        ///< polylines are closed and filled in a picture
  std::vector<Piece> pieces;  ///< lines and arcs
  std::vector<std::vector<Vec2>> polylines;
  std::vector<Vec2> points;
};

/// An empty layer.
[[nodiscard]] SketchLayer sketch_layer(const char* name, const char* title, const char* color,
                                       int dxf_color, double width = 1.0);

struct SketchWord {
  Vec2 at;
  std::string text;
};

struct Sketch {
  std::string title;
  std::vector<std::string> remarks;  ///< below the title
  Units units;
  std::vector<SketchLayer> layers;
  std::vector<SketchWord> words;
};

/// R2000 DXF: LINE, ARC, LWPOLYLINE, POINT and TEXT in the plane z = 0, one layer each; unit as
/// `dxf_unit` says. Lines and arcs are exact. Under watch, a text that was cancelled is worth
/// nothing.
[[nodiscard]] std::string sketch_dxf(const Sketch& sketch, Watch* watch = nullptr);

/// Picture on a white sheet, y upward, with a legend; the same scale in both directions. Watch as
/// above.
[[nodiscard]] std::string sketch_svg(const Sketch& sketch, Watch* watch = nullptr);

}  // namespace obvid
