// SPDX-License-Identifier: Apache-2.0
#include "cut_options.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "obvid/exchange/internal/gcode/dialect.h"
#include "obvid/exchange/internal/gcode/motion_time.h"

namespace obvid::cutting {
namespace {

tl::unexpected<Error> bad(const char* what, const char* option, double value,
                          const std::string& hint) {
  return fail(error(ErrorCode::kBadOption, what).where(option).hint(hint).value(value));
}

tl::unexpected<Error> bad(const char* what, const char* option, double value, double most) {
  return bad(what, option, value, fmt::format("at most {:g}", most));
}

constexpr double kLeastPrintedSpeed = 1e-4;  // four decimals: power on a scale of 1
constexpr double kLongestPierce = 3600.0;    // seconds: an hour

/// An option that is one number.
struct Size {
  std::optional<double> value;
  const char* option;
  bool may_be_none = false;  ///< 0 is none
  double most = std::numeric_limits<double>::max();
};

Result<void> check_numbers(const CutOptions& o) {
  const char* power = o.process == CutProcess::kLaser ? "--laser" : "--spindle";
  using namespace exchange;
  for (const Size& size :
       {Size{o.tolerance, "--tolerance"}, Size{o.diameter, "--diameter", true},
        Size{o.depth, "--depth", true}, Size{o.pass_depth, "--pass-depth"},
        Size{o.lead_in, "--lead-in", true}, Size{o.safe_z, "--safe-z"},
        Size{o.feed, "--feed", false, kGreatestFeed},
        Size{o.plunge_feed, "--plunge-feed", false, kGreatestFeed},
        Size{o.rapid_feed, "--rapid-feed", false, kGreatestFeed},
        Size{o.centripetal, "--centripetal", false, kGreatestAcceleration},
        Size{o.acceleration, "--acceleration", false, kGreatestAcceleration},
        Size{o.spindle, power, false, kGreatestSpeed},
        Size{o.pierce_seconds, "--plasma", true, kLongestPierce}, Size{o.ramp_deg, "--ramp"},
        Size{o.tabs.width, "--tab-width", true}, Size{o.tabs.height, "--tab-height", true}}) {
    if (!size.value) continue;
    const double v = *size.value;
    if (!std::isfinite(v)) return bad("this must be a number", size.option, v, "");
    if (size.may_be_none ? v < 0.0 : !(v > 0.0)) {
      return bad(size.may_be_none ? "this must not be negative" : "this must be greater than 0",
                 size.option, v, "");
    }
    if (v > size.most) return bad("no machine does that", size.option, v, size.most);
  }
  if (o.acceleration && *o.acceleration < kLeastAcceleration) {
    return bad("no time comes of so little", "--acceleration", *o.acceleration,
               fmt::format("at least {} mm/s^2", kLeastAcceleration));
  }
  if (o.spindle && *o.spindle < kLeastPrintedSpeed) {
    return bad("the word S would be printed as 0", power, *o.spindle,
               fmt::format("at least {}", kLeastPrintedSpeed));
  }
  return {};
}

Result<void> check_tabs(const CutOptions& o) {
  constexpr const char* kUnits = "give a length in units of the drawing";
  if (o.tabs.count < 0) return bad("this must not be negative", "--tabs", o.tabs.count, "");
  if (o.tabs.count == 0 || o.process != CutProcess::kMill) return {};
  if (!(o.tabs.width > 0.0)) return bad("tabs have a width", "--tab-width", 0.0, kUnits);
  if (!(o.tabs.height > 0.0)) return bad("tabs have a height", "--tab-height", 0.0, kUnits);
  if (o.tabs.height < o.depth) return {};
  return bad("tabs are lower than the cut is deep", "--tab-height", o.tabs.height, kUnits);
}

/// What is given, under one reason.
class Idle {
 public:
  Idle& add(bool given, const char* name) {
    if (given) names_ += (names_.empty() ? "" : ", ") + std::string(name);
    return *this;
  }
  void tell(const char* reason, std::vector<std::string>& out) const {
    if (!names_.empty()) out.push_back(names_ + ": " + reason + "; left out");
  }

 private:
  std::string names_;
};

}  // namespace

Result<void> check_cut_options(const CutOptions& o) {
  OBVID_TRY(check_numbers(o));
  OBVID_TRY(check_tabs(o));
  constexpr double kStraightDown = 90.0;
  if (o.process == CutProcess::kMill && o.depth == 0.0) {
    return bad("a mill has to know how deep it cuts", "--depth", 0.0,
               "give --depth, or --laser or --plasma");
  }
  if (o.ramp_deg && !(*o.ramp_deg < kStraightDown)) {
    return bad("a ramp is below 90 degrees", "--ramp", *o.ramp_deg,
               "leave it out to go straight down");
  }
  if (o.start && !is_finite(*o.start)) {
    return bad("a place is two numbers", "--start", 0.0, "for example --start 0,0");
  }
  if (o.passes < 1) return bad("there must be a pass", "--passes", o.passes, "");
  if (o.motion == GcodeMotion::kLines) {
    return bad("a cut runs along arcs or splines", "--motion", 0.0, "arcs, or splines");
  }
  if (o.motion == GcodeMotion::kSplines) OBVID_TRY(exchange::check_g5(o.controller));
  return exchange::check_gcode_decimals(o.decimals);
}

std::vector<std::string> idle_cut_options(const CutOptions& o) {
  std::vector<std::string> out;
  const bool mill = o.process == CutProcess::kMill;
  if (!mill) {
    Idle()
        .add(o.depth != 0.0, "--depth")
        .add(o.pass_depth.has_value(), "--pass-depth")
        .add(o.ramp_deg.has_value(), "--ramp")
        .add(o.tabs.count != 0, "--tabs")
        .add(o.safe_z.has_value(), "--safe-z")
        .add(o.plunge_feed.has_value(), "--plunge-feed")
        .tell("of mills alone", out);
  }
  if (mill && o.diameter == 0.0 && o.side != CutSide::kOn) {
    out.emplace_back(
        "no --diameter: the middle of the tool goes along the outlines, so that parts are smaller "
        "and openings larger by its radius (--side on says that this is meant)");
  }
  Idle().add(mill && o.passes != 1, "--passes").tell("of lasers and torches alone", out);
  if (o.diameter == 0.0 || o.side == CutSide::kOn) {
    Idle()
        .add(mill && o.tabs.count != 0, "--tabs")
        .add(o.lead_in != 0.0, "--lead-in")
        .add(o.side == CutSide::kInside || o.side == CutSide::kOutside, "--side")
        .add(o.direction != CutDirection::kClimb, "--direction")
        .tell("for tools with a diameter beside the outlines", out);
  }
  return out;
}

}  // namespace obvid::cutting
