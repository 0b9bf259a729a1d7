// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/curve/pieces.h"
#include "obvid/geom/element.h"

namespace obvid {

/// An ellipse arc: centre + semi_major cos(E) u + semi_minor sin(E) v, with u the unit vector of
/// heading `rotation` and v its left normal, E running from `from` to `to` (either way).
struct Ellipse {
  Vec2 centre;
  double semi_major = 0.0;
  double semi_minor = 0.0;
  double rotation = 0.0;  ///< heading of the major axis, rad, in (-pi/2, pi/2]
  double from = 0.0;      ///< eccentric angle at the start, rad
  double to = 0.0;        ///< eccentric angle at the end, rad
};

/// The ellipse of a rational quadratic Bezier piece. Nothing unless its weights are positive and it
/// is part of an ellipse, and its control points span a triangle. Relative error some 1e-16 over
/// 1 - w^2, w the middle weight when those at the ends are 1: a parabola is an ellipse without end.
[[nodiscard]] std::optional<Ellipse> ellipse_of(const RationalBezier& conic);

/// How the curvature of a rational quadratic changes: +1 and -1 its signed curvature increases or
/// decreases strictly on the open interval, 0 when it has a vertex inside or is a circle. By the
/// Bernstein coefficients of its derivative, which for a conic decide always
/// (docs/methods/conics.md, section 2); as good as their rounding. Weights must be positive.
[[nodiscard]] int conic_direction(const RationalBezier& conic);

/// Weights between two bounds, excluded.
struct WeightRange {
  double low = 0.0;
  double high = 0.0;
};

/// Middle weights with which the conic over one segment, tangents given, is an ellipse arc with
/// monotone curvature. Nothing when none is, or chord and tangents make no triangle. Curvatures of
/// the elements are not used.
[[nodiscard]] std::optional<WeightRange> monotone_weights(const Element& start, const Element& end);

/// Middle weight of the conic through the point K of [003]: on the median of the triangle, in the
/// middle of what the region of a spiral with these elements cuts out of it. Curvatures may be
/// infinite or 0 as in `segment_region`. Nothing where there is no such region or triangle.
[[nodiscard]] std::optional<double> median_weight(const Element& start, const Element& end);

/// Middle weights of the conics through both ends of what the region cuts out of the median, as
/// `median_weight` has it. The larger may be infinite.
[[nodiscard]] std::optional<WeightRange> region_weights(const Element& start, const Element& end);

/// Why a chain of conics is not all that it could be.
enum class ConicObstacle {
  kNone,
  kNoTriangle,       ///< segment `first` has no triangle: an inflection, or it turns by half a turn
  kNoMonotoneConic,  ///< segment `first` alone admits no monotone ellipse arc with its headings
  kNoCommonWeight,   ///< segment `first` wants a larger first weight than segment `second` admits
};

/// The obstacle with the segments that make it (counted from 0).
struct ConicWhyNot {
  ConicObstacle obstacle = ConicObstacle::kNone;
  std::size_t first = 0;
  std::size_t second = 0;
  double excess = 0.0;  ///< kNoCommonWeight: wanted over admitted weight, less 1
};

/// How to choose the first weight, which decides all others.
struct ConicOptions {
  std::optional<double> first_weight;  ///< given; [003] takes `median_weight` of the first segment
  std::optional<std::size_t>
      curvature_of{};  ///< the element whose own curvature is met: it decides the first weight
};

/// One conic per segment, curvature continuous.
struct ConicChain {
  std::vector<Element> elements;  ///< given points and headings with the curvatures that follow
  std::vector<double> weights;    ///< of the middle control points
  std::vector<RationalBezier> pieces;  ///< weights 1, w, 1
  bool elliptic = false;               ///< all of them are ellipse arcs
  bool monotone = false;               ///< all of them, by `conic_direction`
  ConicWhyNot why_not;                 ///< why it is not both, when it is not
};

/// Conics over a convex series with headings given, joined with equal curvature: the weights of all
/// others follow from the first ([003]; docs/methods/conics.md). Unless it is given, the first
/// weight is such that all arcs are elliptic and monotone, if there is one, and that no arc is
/// farther from the middle of its region than need be, measured in widths of the region. Curvatures
/// of the elements say what those regions are and nothing else; segments without a region do not
/// count. Cost O(n). Errors: E304 fewer than two elements; E401 a segment without triangle; E203 a
/// given weight that is not positive.
[[nodiscard]] Result<ConicChain> conic_chain(const std::vector<Element>& elements,
                                             const ConicOptions& options = {});

/// What the search for headings leaves alone.
struct KeptByConics {
  std::vector<bool> headings;            ///< empty, or one entry per element
  std::optional<std::size_t> curvature;  ///< as `ConicOptions::curvature_of`
};

/// Frees the headings: elements at the same points, as near to the given ones as was found, over
/// which `conic_chain` is elliptic and monotone, curvature growing and falling where that of the
/// given elements does. For elements of a convex spiral contour. Gauss-Newton, O(n) per step.
/// Errors: E304, E401 as above (an inflection is one); E501 no such headings were found, or `watch`
/// ended the search: each step is work of one unit per element.
[[nodiscard]] Result<std::vector<Element>> headings_for_conics(const std::vector<Element>& elements,
                                                               const KeptByConics& kept = {},
                                                               Watch* watch = nullptr);

}  // namespace obvid
