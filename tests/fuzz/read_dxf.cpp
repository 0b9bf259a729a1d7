// SPDX-License-Identifier: Apache-2.0
// Any bytes give a drawing or an error, and drawings hold numbers that others can work with.
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "obvid/exchange/internal/dxf/read.h"
#include "promise.h"

namespace {

bool sound(obvid::Vec2 p) { return std::abs(p.x) <= 1e100 && std::abs(p.y) <= 1e100; }

}  // namespace

using obvid::require;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto drawing = obvid::parse_dxf({reinterpret_cast<const char*>(data), size}, "fuzz");
  if (!drawing) {
    require(obvid::exit_code(drawing.error().code) == 3);
    require(!drawing.error().what.empty() && !drawing.error().where.empty());
    return 0;
  }
  require(!drawing->curves.empty() || !drawing->series.empty());
  for (const obvid::DrawnCurve& curve : drawing->curves) {
    require(!curve.pieces.empty() && !curve.label.empty());
    for (const obvid::Piece& piece : curve.pieces) {
      require(sound(obvid::start_point(piece)) && sound(obvid::end_point(piece)));
      require(std::isfinite(obvid::evaluate(piece, 0.5).point.x));
    }
  }
  for (const obvid::PointSeries& series : drawing->series) {
    require(!series.points.empty());
    for (const obvid::Vec2 p : series.points) require(sound(p));
  }
  return 0;
}
