// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "obvid/chain/internal/series_chain.h"
#include "obvid/curve/contour.h"

namespace obvid::pipeline_detail {

/// Makes the stored curvatures of neighbouring Bezier pieces agree at their joint: both become that
/// of the joint's element (`keep_end_curvatures`). Where a joint stands on no point its curvature
/// is the one that the piece before it stores. For contours of one section, before their proof.
void keep_joint_curvatures(Contour& contour);

/// Makes the stored slopes of curvature of spirals those of their links, which are equal on both
/// sides of a joint (`keep_end_slopes`). `contour` is formed from `chain`, its curvatures are kept
/// already. Pieces of links that came out in parts turn far and stay as they are.
void keep_joint_slopes(const SeriesChain& chain, Contour& contour);

/// Weights of conics, one after the other, such that the stored pieces have the same curvature on
/// both sides of each joint; the joints take it. A conic has no other freedom: its weight changes
/// both its end curvatures by one factor.
void chain_conic_weights(Contour& contour);

/// Elements of joints that lie outside what their pieces have there, heading and curvature each,
/// get the nearest of these: rounding of coordinates can turn a short piece by more than anything
/// that was sought.
void take_piece_ends(Contour& contour);

}  // namespace obvid::pipeline_detail
