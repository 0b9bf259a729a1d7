// SPDX-License-Identifier: Apache-2.0
#include "fewer_elements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "obvid/core/error.h"

namespace obvid::alignment {
namespace {

constexpr std::size_t kBridged = 3;    ///< elements that one vertical curve takes the place of
constexpr std::size_t kFewPoints = 4;  ///< on an element that may be left out: its numbers and one
constexpr std::size_t kLeastAround = 4;  ///< elements that a loop begins with
constexpr int kMoreAtSeam = 2;           ///< elements that may be added to close a loop
constexpr std::size_t kMostBeside = 12;  ///< elements to both sides of the seam

/// Element k and the next one as one: begun as the longer one, or from end to end.
bool merge(ChainOnPoints& chain, std::size_t k, bool constant) {
  const std::array<int, 2> a = chain.chain().ends[k], b = chain.chain().ends[k + 1];
  const bool longer = chain.chain().length[k] < chain.chain().length[k + 1];
  if (chain.take(as_one(chain.now(), k, longer ? b : a))) return true;
  const std::array<int, 2> other = longer ? a : b, from_end_to_end = {a[0], b[1]};
  return chain.take(as_one(chain.now(), k, constant ? other : from_end_to_end));
}

/// Leaves out element k where few points lie on it.
bool leave_out(ChainOnPoints& chain, std::size_t k) {
  if (k == 0 || k + 1 >= chain.size()) return false;
  const std::vector<Foot>& feet = chain.now().feet;
  const auto on_it = static_cast<std::size_t>(
      std::count_if(feet.begin(), feet.end(), [k](const Foot& foot) { return foot.element == k; }));
  return on_it <= kFewPoints && chain.take(without_element(chain.now(), k));
}

bool bridge(ChainOnPoints& chain, std::size_t k, std::size_t count) {
  const Plane plane = chain.chain().plane;
  const std::vector<Element> joints = chain.chain().joints();
  const Element &a = joints[k], &b = joints[k + count];
  const Vec2 before = forward(plane, a.theta), behind = forward(plane, b.theta);
  const Vec2 chord = b.point - a.point;
  const double to_corner = cross(chord, behind) / cross(before, behind);
  const double from_corner = cross(before, chord) / cross(before, behind);
  if (!(to_corner > 0.0 && from_corner > 0.0)) return false;
  // the points decide; it has to begin at a length from which the fit finds its own
  for (const double half : {std::min(to_corner, from_corner), std::sqrt(to_corner * from_corner),
                            0.5 * (to_corner + from_corner)}) {
    const CurveBetween curve{to_corner - half, from_corner - half, 2.0 * half};
    if (chain.take(with_curve(chain.now(), k, count, curve, chain.limits().least_length))) {
      return true;
    }
  }
  return false;
}

/// Element k and the next one, or the next two, of a profile as one curve between the tangents
/// before and behind, about where they meet: as one of the two it would begin too far off.
bool bridge(ChainOnPoints& chain, std::size_t k) {
  for (std::size_t count = 2; count <= kBridged; ++count) {
    if (k > 0 && k + count < chain.size() && bridge(chain, k, count)) return true;
  }
  return false;
}

void halve_element(ChainOnPoints& chain, std::size_t k, bool constant) {
  FootedChain halved = chain.now();
  halve(halved, k, constant);
  chain.set(std::move(halved));
}

}  // namespace

Result<void> take_fewer_elements(ChainOnPoints& chain, bool constant, const RunContext& run) {
  const bool profile = chain.limits().grades.has_value();
  for (std::size_t k = 0; k + 1 < chain.size();) {
    const double done = static_cast<double>(k) / static_cast<double>(chain.size());
    OBVID_TRY(tell(run, "fewer elements", done));
    const bool fewer = merge(chain, k, constant) || (!constant && leave_out(chain, k)) ||
                       (profile && bridge(chain, k));
    if (!fewer) ++k;
  }
  return {};
}

Result<void> close_loop(ChainOnPoints& chain, bool constant, const RunContext& run) {
  while (chain.size() < kLeastAround) halve_element(chain, chain.size() - 1, constant);
  const std::vector<Element> open = chain.chain().joints();
  const std::size_t half = chain.size() / 2;
  std::size_t seam = chain.size() - half;
  chain.close_at(half);
  for (int more = 0; more <= kMoreAtSeam; ++more) {
    for (std::size_t beside = kBeside; beside <= kMostBeside; beside *= 2) {
      OBVID_TRY(may_go_on(run));
      const std::size_t first = seam - std::min(seam, beside);
      const std::size_t last = std::min(seam + beside, chain.size());
      ChainWindow window = chain.cut(first, last);
      if (last < chain.size()) window.held.end = chain.a_lap_on(open[last - seam]);
      if (chain.fit(window).largest <= 1.0 && chain.commit(chain.now(), window)) return {};
      if (first == 0 && last == chain.size()) break;
    }
    halve_element(chain, seam - 1, constant);
    ++seam;
  }
  return fail(error(ErrorCode::kNoSpiral, "the ends of what was found could not be joined")
                  .hint("allow a larger tolerance, or leave the loop open (--open)"));
}

}  // namespace obvid::alignment
