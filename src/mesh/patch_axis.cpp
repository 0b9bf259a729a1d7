// SPDX-License-Identifier: Apache-2.0
#include "patch_axis.h"

#include <algorithm>
#include <cmath>

namespace obvid::mesh {
namespace {

/// B-splines of degree r from those of degree r - 1; knots[0] is the one above the span's begin.
void raise(SpanBasis& b, const double* knots, std::size_t r, double t) {
  double carry = 0.0;
  for (std::size_t j = 0; j < r; ++j) {
    const double low = *(knots + j - r), high = knots[j];
    const double share = b.value[j] / (high - low);
    b.value[j] = carry + (high - t) * share;
    carry = (t - low) * share;
  }
  b.value[r] = carry;
}

}  // namespace

PatchAxis::PatchAxis(int degree, const std::vector<double>& knots)
    : degree_(degree), knots_(knots) {
  const auto p = static_cast<std::size_t>(degree);
  const std::size_t end = knots.size() - p - 1;
  // spans that are shorter than knots may differ by rounding belong to their neighbours
  const double shortest = kSameKnot * (knots[end] - knots[p]);
  std::size_t run = 0;  // knots at the begin of the span
  for (std::size_t k = p; k < end; ++k) {
    ++run;
    if (!(knots[k + 1] - knots[k] > shortest)) continue;
    knot_of_.push_back(k);
    ends_.push_back(knots[k]);
    may_bend_.push_back(knot_of_.size() > 1 && run >= p);
    run = 0;
  }
  ends_.front() = knots[p];
  ends_.push_back(knots[end]);
}

double PatchAxis::at(Line line) const {
  const std::size_t k = span_of(line);
  const Line part = line & (kSpan - 1);
  if (part == 0) return ends_[k];
  return ends_[k] +
         std::ldexp(static_cast<double>(part), -kFractionBits) * (ends_[k + 1] - ends_[k]);
}

Place PatchAxis::locate(double t) const {
  // knots mostly stand evenly: a guess saves the search
  const double part = (t - from()) / (to() - from()) * static_cast<double>(spans());
  if (part > 0.0 && part < static_cast<double>(spans())) {
    const auto guess = static_cast<std::size_t>(part);
    if (t >= ends_[guess] && t < ends_[guess + 1]) return {guess, t};
  }
  const auto above = std::upper_bound(ends_.begin() + 1, ends_.end() - 1, t);
  return {static_cast<std::size_t>(above - ends_.begin()) - 1, t};
}

// The recurrence of Cox and de Boor; the row below the last gives the derivatives.
SpanBasis PatchAxis::basis(const Place& place) const {
  SpanBasis b;
  const auto p = static_cast<std::size_t>(degree_);
  const std::size_t k = knot_of_[place.span];
  const double* knots = knots_.data() + k + 1;
  b.first = k - p;
  b.value[0] = 1.0;
  for (std::size_t r = 1; r < p; ++r) raise(b, knots, r, place.t);
  double slope = 0.0;
  for (std::size_t j = 0; j < p; ++j) {
    const double share = static_cast<double>(p) * b.value[j] / (knots[j] - *(knots + j - p));
    b.slope[j] = slope - share;
    slope = share;
  }
  b.slope[p] = slope;
  raise(b, knots, p, place.t);
  return b;
}

}  // namespace obvid::mesh
