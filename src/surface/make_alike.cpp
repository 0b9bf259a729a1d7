// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <iterator>

#include "kinds.h"
#include "obvid/curve/internal/knots.h"
#include "snap.h"

namespace obvid {
namespace {

/// Knots of all surfaces in one direction, rounding differences made equal, largest multiplicities.
std::vector<double> common(std::vector<NurbsSurface>& surfaces,
                           std::vector<double> NurbsSurface::*knots) {
  std::vector<double> all, kept;
  for (const NurbsSurface& s : surfaces) {
    all.insert(all.end(), (s.*knots).begin(), (s.*knots).end());
  }
  std::sort(all.begin(), all.end());
  for (const double u : all) {
    if (kept.empty() || u - kept.back() > kSameKnot) kept.push_back(u);
  }
  kept.back() = 1.0;
  for (NurbsSurface& s : surfaces) snap(s.*knots, kept);
  std::vector<double> repeated;
  for (const double u : kept) {
    std::size_t most = 0;
    for (const NurbsSurface& s : surfaces) most = std::max(most, multiplicity(s.*knots, u));
    repeated.insert(repeated.end(), most, u);
  }
  return repeated;
}

std::vector<double> missing(const std::vector<double>& have, const std::vector<double>& wanted) {
  std::vector<double> out;
  std::set_difference(wanted.begin(), wanted.end(), have.begin(), have.end(),
                      std::back_inserter(out));
  return out;
}

}  // namespace

void make_alike(std::vector<NurbsSurface>& surfaces) {
  int p = 1, q = 1;
  for (const NurbsSurface& s : surfaces) {
    p = std::max(p, s.degree_u);
    q = std::max(q, s.degree_v);
  }
  for (NurbsSurface& s : surfaces) s = with_degrees(with_domain(s, {0.0, 1.0}, {0.0, 1.0}), p, q);
  const std::vector<double> u = common(surfaces, &NurbsSurface::knots_u);
  const std::vector<double> v = common(surfaces, &NurbsSurface::knots_v);
  for (NurbsSurface& s : surfaces) {
    s = with_knots_v(with_knots_u(s, missing(s.knots_u, u)), missing(s.knots_v, v));
  }
}

}  // namespace obvid
