// SPDX-License-Identifier: Apache-2.0
// The curves of one kind of a net, with the places where they cross those of the other kind.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/surface/space_curve.h"

namespace obvid {

struct NetSide {
  std::string kind;                     ///< "of the first kind"
  std::vector<SpaceCurve> curves;       ///< on [0, 1]
  std::vector<std::size_t> number;      ///< as given, from 0
  std::vector<char> is_pole;            ///< shrunk to a point: crossed anywhere
  std::vector<std::vector<double>> at;  ///< [curve][curve of the other kind]: parameter of crossing

  [[nodiscard]] std::string name(std::size_t i) const;
};

/// Closed curves begin on one curve of the other kind, which is made to stand twice: as the first
/// and as the last one. Nothing happens unless all curves are closed. Errors: E203.
[[nodiscard]] Result<void> open_at_seam(NetSide& side, NetSide& other, double tolerance);

/// Sorts the other kind along the curves of this one and turns these to agree with the first of
/// them. Errors: E203.
[[nodiscard]] Result<void> put_in_order(NetSide& side, NetSide& other);

/// Cuts off what lies before the first and behind the last crossing, or moves these to the ends
/// when they are no further away than the tolerance; [0, 1] again.
void trim(NetSide& side, double tolerance);

/// Means of the parameters at the crossings; poles take them over.
[[nodiscard]] std::vector<double> mean_parameters(NetSide& side);

/// Places where curves have to go through: [curve][curve of the other kind].
using CrossingPoints = std::vector<std::vector<Vec3>>;

/// Curves near the given ones that pass the points at the parameters, the same for all: C2 cubics
/// over common knots. Errors: E502 not within the tolerance.
[[nodiscard]] Result<std::vector<SpaceCurve>> rebuilt(const NetSide& side,
                                                      const std::vector<double>& parameters,
                                                      const CrossingPoints& points,
                                                      double tolerance);

}  // namespace obvid
