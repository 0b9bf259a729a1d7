// SPDX-License-Identifier: Apache-2.0
#include "known_pieces.h"

#include <algorithm>

namespace obvid {

PieceMemory::PieceMemory() : pieces_(std::make_unique<Pieces>()) {}
PieceMemory::~PieceMemory() = default;
PieceMemory::PieceMemory(PieceMemory&&) noexcept = default;
PieceMemory& PieceMemory::operator=(PieceMemory&&) noexcept = default;

void PieceMemory::clear() { pieces_->list.clear(); }

void PieceMemory::replace(std::size_t first, std::size_t end, std::size_t count) {
  std::vector<KnownPiece>& list = pieces_->list;
  if (end > list.size() || first > end) return clear();
  const auto at = [&](std::size_t i) { return list.begin() + static_cast<std::ptrdiff_t>(i); };
  if (count < end - first) list.erase(at(first + count), at(end));
  if (count > end - first) list.insert(at(end), count - (end - first), KnownPiece{});
  for (std::size_t i = first; i < first + count; ++i) list[i].known = false;
}

void PieceMemory::Pieces::learn(const Contour& contour, Watch& watch) {
  const bool wanted = contour.continuity == Continuity::kG3;
  if (list.size() != contour.pieces.size() || slopes != wanted) list.clear();
  slopes = wanted;
  list.resize(contour.pieces.size());
  for (std::size_t i = 0; i < list.size() && !watch.cancelled(); ++i) {
    if (list[i].known) continue;
    const Piece& piece = contour.pieces[i];
    list[i] = {examine_piece(piece), ends_of(piece, slopes), evaluate(piece, 0.5).point, true};
  }
}

}  // namespace obvid
