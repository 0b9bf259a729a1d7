// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "cells.h"

namespace obvid {

/// An end of a strand: on a side of its cell.
struct StrandEnd {
  bool on_u_line = false;   ///< on a line of constant u, else of constant v
  bool low = false;         ///< the cell lies below that line
  std::size_t span = 0;     ///< of the line: the span before or at which it lies ...
  double share = 0.0;       ///< ... and where in it, in [0, 1), exactly
  double along = 0.0;       ///< span and share along the line
  double u = 0.0, v = 0.0;  ///< native parameters
};

/// A part of a branch within a cell: a function of u or of v.
struct Strand {
  std::size_t patch = 0;
  bool over_u = true;
  std::array<StrandEnd, 2> end{};
  double least = 0.0, most = 0.0;  ///< range of the other parameter in its cell
};

/// A strand that runs across a cell, by what the cell says of it.
struct StrandOfCell {
  Strand strand;             ///< without patch and ends
  std::vector<double> cuts;  ///< shares of the cell along it, 0 and 1 among them, ascending:
                             ///< between two of them the branch is there all along, or nowhere
};
/// `across`: range of the other parameter in the cell; degrees as of `side_of`.
[[nodiscard]] StrandOfCell strand_of_cell(const SectionCell& cell, int degree_u, int degree_v,
                                          bool over_u, Range across);

/// Ends of strands by number: 2 * strand + 0 or 1.
using EndNumber = std::size_t;
inline constexpr EndNumber kNoEnd = static_cast<EndNumber>(-1);

/// Halvings of a span after which a cell is `near`.
inline constexpr int kNearlyTouching = 16;

/// Strands of one patch, and which ends inside of it are the same.
struct PatchStrands {
  std::vector<Strand> strands;
  std::vector<EndNumber> mate;  ///< of each end; `kNoEnd`: on a border, or nobody's
  std::vector<SectionCell> undecided;
  std::vector<SectionCell>
      near;  ///< decided late: branches lie near each other, or the surface the plane
};

[[nodiscard]] Result<PatchStrands> strands_of(const CutPatch& patch, std::size_t number,
                                              const CutPlane& plane, double noise,
                                              const RunContext& run);

}  // namespace obvid
