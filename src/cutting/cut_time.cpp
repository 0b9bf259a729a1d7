// SPDX-License-Identifier: Apache-2.0
#include "cut_time.h"

#include <cmath>

namespace obvid::cutting {
namespace {

Vec3 direction(double heading, double across, double up) {
  return unit({across * std::cos(heading), across * std::sin(heading), up});
}

}  // namespace

double seconds_of(const std::vector<CutBlock>& blocks, const exchange::MotionRules& rules,
                  double pierce_seconds) {
  exchange::MotionTime time(rules);
  Vec2 at{};
  double z = 0.0;
  for (const CutBlock& block : blocks) {
    using enum CutBlock::Kind;
    switch (block.kind) {
      case kRapidAcross:
        time.rapid(norm(block.to - at));
        at = block.to;
        break;
      case kRapidLevel:
        time.rapid(std::abs(block.z - z));
        z = block.z;
        break;
      case kDown:
        time.alone(std::abs(block.z - z), block.feed);
        z = block.z;
        break;
      case kDwell:
        time.waits(pierce_seconds);
        break;
      case kOn:
      case kOff:
        time.waits(0.0);
        break;
      case kCut: {
        const double across = length_of(block.piece), up = block.z - z;
        time.goes_on(std::hypot(across, up), block.feed,
                     direction(heading_at_start(block.piece), across, up),
                     direction(heading_at_end(block.piece), across, up));
        at = end_point(block.piece);
        z = block.z;
      }
    }
  }
  return time.seconds();
}

}  // namespace obvid::cutting
