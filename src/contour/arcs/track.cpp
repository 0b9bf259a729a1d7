// SPDX-License-Identifier: Apache-2.0
#include "track.h"

#include <algorithm>

namespace obvid::arcs {
namespace {

/// Length between two parameters, by Simpson's rule.
double cell_length(const Piece& piece, double t0, double t1) {
  const double sum = norm(evaluate(piece, t0).d1) +
                     4.0 * norm(evaluate(piece, 0.5 * (t0 + t1)).d1) + norm(evaluate(piece, t1).d1);
  return (t1 - t0) * sum / 6.0;
}

}  // namespace

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

Track::Track(const Contour& contour) : contour_(contour), cell_(1, 0.0) {
  cell_.reserve(kCells * contour.pieces.size() + 1);
  constexpr double kStep = 1.0 / kCells;
  for (const Piece& piece : contour.pieces) {
    for (std::size_t k = 0; k < kCells; ++k) {
      const double t = static_cast<double>(k) * kStep;
      cell_.push_back(cell_.back() + cell_length(piece, t, t + kStep));
    }
  }
}

Track::Place Track::place(double s, bool from_left) const {
  const auto inner_begin = cell_.begin() + 1, inner_end = cell_.end() - 1;
  const auto after = from_left ? std::lower_bound(inner_begin, inner_end, s)
                               : std::upper_bound(inner_begin, inner_end, s);
  const auto cell = static_cast<std::size_t>(after - inner_begin);
  const double length = cell_[cell + 1] - cell_[cell];
  const double part = length > 0.0 ? std::clamp((s - cell_[cell]) / length, 0.0, 1.0) : 0.0;
  return {cell / kCells, (static_cast<double>(cell % kCells) + part) / kCells};
}

Jet Track::jet(double s, bool from_left) const {
  const Place p = place(s, from_left);
  return evaluate(contour_.pieces[p.piece], p.t);
}

bool Track::corner_before(std::size_t piece) const {
  return piece < contour_.joints.size() && contour_.joints[piece].leaving.has_value();
}

std::vector<Stretch> Track::stretches() const {
  const std::size_t n = contour_.pieces.size();
  std::vector<Stretch> out;
  for (std::size_t i = 0; i < n;) {
    Stretch stretch = {i, i + 1, is_circular(piece(i)), false};
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

std::vector<double> Track::vertices(const Stretch& stretch) const {
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
