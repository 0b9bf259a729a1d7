// SPDX-License-Identifier: Apache-2.0
#include "track.h"

namespace obvid::arcs {
bool is_circular(const Piece& piece) {
  if (const auto* clothoid = std::get_if<ClothoidPiece>(&piece)) {
    return clothoid->kappa0 == clothoid->kappa1;
  }
  return std::holds_alternative<LinePiece>(piece) || std::holds_alternative<ArcPiece>(piece);
}

Piece as_circular(const Piece& piece) {
  const auto* c = std::get_if<ClothoidPiece>(&piece);
  if (c == nullptr) return piece;
  if (c->kappa0 == 0.0) return LinePiece{c->start, c->end};
  return ArcPiece{c->start, c->end, c->theta0, c->kappa0, c->length};
}

bool Track::corner_before(std::size_t piece) const {
  return piece < contour_.joints.size() && contour_.joints[piece].leaving.has_value();
}

std::vector<SmoothPart> Track::stretches() const {
  const std::size_t n = contour_.pieces.size();
  std::vector<SmoothPart> out;
  for (std::size_t i = 0; i < n;) {
    SmoothPart stretch = {i, i + 1, is_circular(piece(i)), false};
    if (!stretch.exact) {
      while (stretch.end < n && !is_circular(piece(stretch.end)) && !corner_before(stretch.end)) {
        ++stretch.end;
      }
    }
    stretch.closed = contour_.closed && !stretch.exact && stretch.first == 0 && stretch.end == n &&
                     !corner_before(0);
    out.push_back(stretch);
    i = stretch.end;
  }
  return out;
}

std::vector<double> Track::vertices(const SmoothPart& stretch) const {
  std::vector<double> out;
  int before = 0;
  for (const Run& run : contour_.runs) {
    if (run.direction == 0) continue;
    if (before == -run.direction && run.first_piece > stretch.first &&
        run.first_piece < stretch.end) {
      out.push_back(start_of(run.first_piece));
    }
    before = run.direction;
  }
  return out;
}

}  // namespace obvid::arcs
