// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "obvid/geom/vec3.h"

namespace obvid::exchange {

inline constexpr double kSecondsOfMinute = 60.0;  ///< feeds are lengths a minute

/// Beyond these no machine works: what is given is a typing error. Lengths in mm, mm a minute;
/// speeds of spindles and powers of beams, the word S.
inline constexpr double kLongestWay = 1e6, kLeastFeed = 1e-3, kGreatestFeed = 1e7,
                        kGreatestSpeed = 1e7;
/// mm/s^2. Below the first no time comes of a program, above the second it is that of no limit.
inline constexpr double kLeastAcceleration = 1e-3, kGreatestAcceleration = 1e12;

/// What a machine is thought to do. Lengths in its units, mm or inches.
struct MotionRules {
  double rapid_feed = 0.0;    ///< a minute
  double acceleration = 0.0;  ///< along the way, length/s^2
  double corner = 0.0;        ///< how far a controller may cut corners: sets the speed there
};

/// In units of the machine, length/s^2, of what is given in mm/s^2; nothing: 500 mm/s^2.
[[nodiscard]] double machine_acceleration(std::optional<double> given, bool inches);

/// Seconds that a program takes, block by block: along each with the least time that its feed, the
/// acceleration and the speeds at its ends allow. At a corner the speed is that of a circle tangent
/// to both sides that stays `corner` away from it (the rule of grbl and LinuxCNC's G64 P). An
/// estimate: controllers look so many blocks ahead as they can.
class MotionTime {
 public:
  explicit MotionTime(const MotionRules& rules) : rules_(rules) {}

  /// A block that goes on where the last one ended, without a stop. `feed`: a minute; `begin`,
  /// `end`: its directions there, of length 1. A length of 0 is no block.
  void goes_on(double length, double feed, Vec3 begin, Vec3 end);
  /// A block that begins and ends at rest.
  void alone(double length, double feed);
  void rapid(double length) { alone(length, rules_.rapid_feed); }
  /// At rest.
  void waits(double seconds);
  /// Of all blocks so far, with a stop at the end.
  [[nodiscard]] double seconds();

 private:
  struct Stretch {
    double length = 0.0, most = 0.0;  ///< most: length/s
    double corner = 0.0;              ///< speed at the corner before it, at most
  };
  [[nodiscard]] double corner_speed(Vec3 arriving, Vec3 leaving, double most) const;
  void stop();

  MotionRules rules_;
  double seconds_ = 0.0;
  std::vector<Stretch> row_;
  Vec3 heading_;
};

}  // namespace obvid::exchange
