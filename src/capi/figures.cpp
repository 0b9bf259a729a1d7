// SPDX-License-Identifier: Apache-2.0
#include "figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "handles.h"

namespace obvid::capi {
namespace {

constexpr int kNotCounted = -1;

void add_count(int& sum, int one) {
  if (one != kNotCounted) sum = std::max(sum, 0) + one;
}

/// The largest of all parts; unknown where it is unknown of one.
void add_largest(double& sum, double one, bool first) {
  sum = first ? one : (std::isnan(sum) ? sum : std::isnan(one) ? one : std::max(sum, one));
}

}  // namespace

obvid_figures no_figures() {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  return {kNotCounted, kNotCounted, kNotCounted, kNotCounted, kNotCounted,
          kNotCounted, kNotCounted, kUnknown,    kUnknown,    kUnknown};
}

obvid_figures figures_of(const Contour& contour, const FitReport* report,
                         const Certificate* certificate) {
  obvid_figures out = no_figures();
  out.points = static_cast<int>(contour.points.size());
  out.pieces = static_cast<int>(contour.pieces.size());
  if (report != nullptr) {
    out.vertices = report->vertices;
    out.inflections = report->inflections;
    out.bound = report->vertices_lower_bound;
    out.error = report->largest_deviation;
    out.move = report->largest_move;
    out.width = report->largest_width;
  }
  if (certificate != nullptr) {
    out.proved = certificate->proved ? 1 : 0;
    out.vertices = certificate->vertices;
    out.inflections = certificate->inflections;
    out.corners = certificate->corners;
  }
  return out;
}

void add_figures(obvid_figures& sum, const obvid_figures& one) {
  const bool first = sum.pieces == kNotCounted;
  add_count(sum.points, one.points);
  add_count(sum.pieces, one.pieces);
  add_count(sum.vertices, one.vertices);
  add_count(sum.inflections, one.inflections);
  add_count(sum.bound, one.bound);
  add_count(sum.corners, one.corners);
  add_largest(sum.error, one.error, first);
  add_largest(sum.move, one.move, first);
  add_largest(sum.width, one.width, first);
  sum.proved = sum.proved == kNotCounted ? one.proved : std::min(sum.proved, one.proved);
}

}  // namespace obvid::capi

using namespace obvid;
using namespace obvid::capi;

extern "C" {

void obvid_contour_figures(const obvid_contour* contour, obvid_figures* figures) {
  const StoredContour& stored = contour->stored;
  *figures = figures_of(stored.contour, stored.report ? &*stored.report : nullptr,
                        stored.certificate ? &*stored.certificate : nullptr);
}

void obvid_space_figures(const obvid_space* space, obvid_figures* figures) {
  *figures = no_figures();
  const auto add = [&](const Fit& fit) {
    add_figures(*figures, figures_of(fit.contour, &fit.report, &fit.certificate));
  };
  for (const SpaceFit& part : space->chain.parts) {
    add(part.plan);
    if (part.unrolled) add(*part.unrolled);
  }
}
}
