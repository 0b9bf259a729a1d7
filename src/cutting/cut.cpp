// SPDX-License-Identifier: Apache-2.0
#include "obvid/cutting/cutting.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "cut_blocks.h"
#include "cut_check.h"
#include "cut_order.h"
#include "cut_time.h"
#include "obvid/core/internal/figures.h"
#include "obvid/core/version.h"
#include "obvid/exchange/internal/gcode/dialect.h"
#include "obvid/exchange/internal/gcode/path.h"
#include "outlines.h"

namespace obvid {
namespace {

using namespace cutting;
using exchange::fixed;

constexpr double kMmPerInch = 25.4;
constexpr double kDegrees = 180.0;

/// In mm and minutes; in inches.
struct Defaults {
  double plunge, rapid, safe_z, clear_z;
};
constexpr Defaults kMillimetres{300.0, 3000.0, 5.0, 1.0}, kInches{12.0, 120.0, 0.2, 0.04};
constexpr double kAcceleration = 500.0;  // mm/s^2

Error bad_value(const char* what, const char* option, double value) {
  Error error{ErrorCode::kBadOption, what, option, "", -1, value};
  return error;
}

Result<void> check_sizes(const CutOptions& o) {
  const auto positive = [](double v) { return v > 0.0 && std::isfinite(v); };
  const auto none_or_positive = [&](const std::optional<double>& v) { return !v || positive(*v); };
  const auto not_negative = [](double v) { return v >= 0.0 && std::isfinite(v); };
  if (!positive(o.tolerance))
    return fail(bad_value("the tolerance must be greater than 0", "--tolerance", o.tolerance));
  if (!not_negative(o.diameter))
    return fail(bad_value("the diameter must not be negative", "--diameter", o.diameter));
  if (o.process == CutProcess::kMill && !positive(o.depth)) {
    Error error = bad_value("a mill has to know how deep it cuts", "--depth", o.depth);
    error.hint = "give --depth, or --laser or --plasma";
    return fail(std::move(error));
  }
  if (!none_or_positive(o.pass_depth))
    return fail(bad_value("a pass must go down", "--pass-depth", *o.pass_depth));
  if (o.passes < 1) return fail(bad_value("there must be a pass", "--passes", o.passes));
  if (o.ramp_deg && !(*o.ramp_deg > 0.0 && *o.ramp_deg < 90.0))
    return fail(bad_value("a ramp lies between 0 and 90 degrees", "--ramp", *o.ramp_deg));
  if (!not_negative(o.lead_in))
    return fail(bad_value("the radius of leads must not be negative", "--lead-in", o.lead_in));
  if (o.tabs.count < 0 ||
      (o.tabs.count > 0 && !(positive(o.tabs.width) && positive(o.tabs.height)))) {
    return fail(bad_value("tabs have a number, a width and a height", "--tabs", o.tabs.count));
  }
  if (o.tabs.count > 0 && !(o.tabs.height < o.depth))
    return fail(bad_value("tabs are lower than the cut is deep", "--tab-height", o.tabs.height));
  for (const auto& [value, option] : {std::pair{o.feed, "--feed"},
                                      {o.plunge_feed, "--plunge-feed"},
                                      {o.rapid_feed, "--rapid-feed"},
                                      {o.safe_z, "--safe-z"},
                                      {o.centripetal, "--centripetal"},
                                      {o.acceleration, "--acceleration"}}) {
    if (!none_or_positive(value))
      return fail(bad_value("this must be greater than 0", option, *value));
  }
  if (o.spindle && !not_negative(*o.spindle))
    return fail(bad_value("this must not be negative", "--spindle", *o.spindle));
  if (!not_negative(o.pierce_seconds))
    return fail(bad_value("this must not be negative", "--pierce", o.pierce_seconds));
  if (o.decimals && (*o.decimals < 1 || *o.decimals > exchange::kMostGcodeDecimals)) {
    return fail(bad_value("decimals must be 1 to 6", "--decimals", *o.decimals));
  }
  return {};
}

/// The text of blocks.
class CutText {
 public:
  CutText(const CutOptions& options, bool inches, int decimals)
      : options_(options), inches_(inches), decimals_(decimals), path_(1.0, decimals) {}

  void add(const CutBlock& block) {
    using enum CutBlock::Kind;
    switch (block.kind) {
      case kRapidAcross:
        path_.start_at(block.to);
        path_.say("G0 " + path_.start() + "\n");
        told_ = true;
        count(block);
        break;
      case kRapidLevel:
        path_.say("G0 Z" + fixed(block.z, decimals_) + "\n");
        z_ = block.z;
        if (told_) count(block);
        break;
      case kDown:
        path_.say("G1 Z" + fixed(block.z, decimals_) + feed_words(block.feed) + "\n");
        z_ = block.z;
        count(block);
        break;
      case kOn:
        path_.say(on_words());
        break;
      case kOff:
        path_.say("M5\n");
        break;
      case kDwell:
        path_.say(dwell_words());
        break;
      case kCut:
        cut(block);
    }
  }

  [[nodiscard]] const exchange::GcodePath& path() const { return path_; }
  [[nodiscard]] const std::vector<std::size_t>& motions() const { return motions_; }
  [[nodiscard]] const std::vector<bool>& first_pass() const { return first_pass_; }

  [[nodiscard]] std::string on_words() const {
    const bool dynamic =
        options_.process == CutProcess::kLaser && options_.controller == GcodeController::kGrbl;
    return std::string(dynamic ? "M4" : "M3") +
           (options_.spindle ? " S" + fixed(*options_.spindle, 0) : "") + "\n";
  }

 private:
  void count(const CutBlock& block) { motions_.push_back(block.track); }

  [[nodiscard]] std::string feed_words(double feed) {
    const std::string words = " F" + fixed(feed, inches_ ? 2 : 1);
    if (words == feed_) return "";
    feed_ = words;
    return words;
  }

  [[nodiscard]] std::string dwell_words() const {
    const bool milliseconds = options_.controller == GcodeController::kFanuc ||
                              options_.controller == GcodeController::kMarlin;
    constexpr double kMilliseconds = 1000.0;
    return "G4 P" +
           (milliseconds ? fixed(options_.pierce_seconds * kMilliseconds, 0)
                         : fixed(options_.pierce_seconds, 3)) +
           "\n";
  }

  void cut(const CutBlock& block) {
    const std::string before = feed_;
    const std::string level = block.z == z_ ? "" : " Z" + fixed(block.z, decimals_);
    path_.say_behind(level + feed_words(block.feed));
    const std::size_t printed = path_.pieces().size();
    if (const auto* arc = std::get_if<ArcPiece>(&block.piece)) {
      path_.follow_arc(*arc);
    } else {
      path_.line_to(end_point(block.piece));
    }
    if (path_.pieces().size() == printed) {  // it rounded away: the next one says it
      feed_ = before;
      return;
    }
    z_ = block.z;
    for (std::size_t k = printed; k < path_.pieces().size(); ++k) {
      count(block);
      first_pass_.push_back(block.first_pass);
    }
  }

  const CutOptions& options_;
  bool inches_;
  int decimals_;
  exchange::GcodePath path_;
  bool told_ = false;
  double z_ = 0.0;
  std::string feed_;
  std::vector<std::size_t> motions_;
  std::vector<bool> first_pass_;
};

class Cutting {
 public:
  Cutting(const std::vector<CutOutline>& outlines, const CutOptions& options, const RunContext& run)
      : outlines_(outlines),
        options_(options),
        watch_(run),
        units_(outlines.front().contour.units),
        inches_(units_.name == "in"),
        scale_(*unit_ratio(units_.name, inches_ ? "in" : "mm")),
        defaults_(inches_ ? kInches : kMillimetres) {}

  Result<CutProgram> run() {
    watch_.tell("outlines", 0.0);
    auto tracks = tracks_of(outlines_, options_, scale_, watch_);
    OBVID_TRY(tracks);
    tracks_ = std::move(*tracks);
    watch_.tell("order", 0.4);
    const VisitRules visiting{scaled(options_.start), options_.lead_in * scale_,
                              0.5 * options_.diameter * scale_,
                              options_.direction == CutDirection::kClimb};
    const std::vector<Visit> visits = ordered(tracks_, visiting, watch_);
    if (watch_.cancelled()) return fail(cancelled_error());
    rules_ = rules();
    const CutBlocks blocks = blocks_of(tracks_, visits, rules_);
    decimals_ =
        options_.decimals.value_or(exchange::gcode_decimals(options_.tolerance * scale_, inches_));
    CutText text(options_, inches_, decimals_);
    for (const CutBlock& block : blocks.blocks) text.add(block);
    if (text.path().lost_arcs()) return fail(too_few_digits());
    return finished(visits, blocks, text);
  }

 private:
  [[nodiscard]] std::optional<Vec2> scaled(std::optional<Vec2> place) const {
    if (place) *place = scale_ * *place;
    return place;
  }

  [[nodiscard]] Error too_few_digits() const {
    return {ErrorCode::kToleranceNotReached,
            fmt::format("{} decimals do not hold the program within the tolerance", decimals_),
            "",
            "move the drawing near the origin, give more --decimals, or a larger --tolerance",
            -1,
            0.0};
  }

  [[nodiscard]] BlockRules rules() const {
    BlockRules out;
    out.process = options_.process;
    out.depth = options_.depth * scale_;
    out.pass_depth = options_.pass_depth.value_or(options_.depth) * scale_;
    out.passes = options_.passes;
    out.fall = options_.ramp_deg ? std::tan(*options_.ramp_deg * std::acos(-1.0) / kDegrees) : 0.0;
    out.tabs = {options_.tabs.count, options_.tabs.width * scale_, options_.tabs.height * scale_};
    out.tool_diameter = options_.diameter * scale_;
    out.safe_z = options_.safe_z ? *options_.safe_z * scale_ : defaults_.safe_z;
    out.clear_z = std::min(out.safe_z, defaults_.clear_z);
    out.feed = options_.feed.value_or(default_feed(units_.name));
    out.plunge_feed = options_.plunge_feed.value_or(defaults_.plunge);
    out.across = options_.centripetal.value_or(0.0) / (inches_ ? kMmPerInch : 1.0);
    out.pierce_seconds = options_.pierce_seconds;
    return out;
  }

  Result<CutProgram> finished(const std::vector<Visit>& visits, const CutBlocks& blocks,
                              const CutText& text) {
    CutProgram out;
    for (const Visit& visit : visits) out.steps.push_back(step_of(visit));
    add_moves(blocks, text, out);
    const double acceleration =
        options_.acceleration.value_or(kAcceleration) / (inches_ ? kMmPerInch : 1.0);
    const TimeRules times{options_.rapid_feed.value_or(defaults_.rapid), acceleration,
                          options_.tolerance * scale_, options_.pierce_seconds};
    constexpr double kMinute = 60.0;
    out.report.minutes = seconds_of(blocks.blocks, times) / kMinute;
    out.report.levels = blocks.levels;
    out.text = head(out) + start_words(text) + text.path().text() + end_words();
    watch_.tell("reading it back", 0.7);
    OBVID_TRY(check(out, text));
    for (const std::size_t track : blocks.without_tabs) {
      out.warnings.push_back(tracks_[track].name + " is too short for its tabs: it has none");
    }
    for (const Visit& visit : visits) {
      if (!visit.lead_left_out) continue;
      out.warnings.push_back(tracks_[visit.track].name +
                             " has no room for a lead-in: the tool goes down on its path");
    }
    watch_.tell("done", 1.0);
    return out;
  }

  Result<void> check(CutProgram& out, const CutText& text) {
    const auto found =
        checked(out.text, tracks_, text.motions(), rules_, options_.tolerance * scale_, watch_);
    OBVID_TRY(found);
    double off = text.path().radius_mismatch();
    for (const Track& track : tracks_) off = std::max(off, track.deviation);
    out.report.beyond = (found->beyond + off) / scale_;
    out.report.short_of = (found->short_of + off) / scale_;
    if (std::max(out.report.beyond, out.report.short_of) <= options_.tolerance) return {};
    return fail(too_few_digits());
  }

  [[nodiscard]] CutStep step_of(const Visit& visit) const {
    const Track& track = tracks_[visit.track];
    CutStep out;
    out.outline = track.outline;
    out.closed = track.edge.closed;
    out.around = track.around;
    out.side = track.side;
    out.start = (1.0 / scale_) * begin_of(visit);
    out.length = length_of(visit.path) / scale_;
    for (const auto& corner : track.corners) {
      out.left_in_corners = std::max(out.left_in_corners, corner.left / scale_);
    }
    return out;
  }

  void add_moves(const CutBlocks& blocks, const CutText& text, CutProgram& out) const {
    const std::vector<Piece>& printed = text.path().pieces();
    CutReport& report = out.report;
    report.blocks = printed.size();
    report.arc_blocks = text.path().arcs();
    for (const CutStep& step : out.steps) {
      report.left_in_corners = std::max(report.left_in_corners, step.left_in_corners);
    }
    for (std::size_t k = 0; k < printed.size(); ++k) {
      const Piece piece = cutting::scaled(printed[k], 1.0 / scale_);
      report.cut_length += length_of(piece);
      if (text.first_pass()[k]) out.moves.push_back({CutMoveKind::kCut, piece});
    }
    Vec2 at{};
    for (const CutBlock& block : blocks.blocks) {
      if (block.kind == CutBlock::Kind::kCut) at = end_point(block.piece);
      if (block.kind != CutBlock::Kind::kRapidAcross || norm(block.to - at) == 0.0) continue;
      const LinePiece way{(1.0 / scale_) * at, (1.0 / scale_) * block.to};
      out.moves.push_back({CutMoveKind::kRapid, way});
      report.rapid_length += norm(way.end - way.start);
      at = block.to;
    }
  }

  [[nodiscard]] std::string tool_text(int levels) const {
    const std::string unit = inches_ ? "in" : "mm";
    const double d = rules_.tool_diameter;
    switch (options_.process) {
      case CutProcess::kMill:
        return fmt::format("mill D{:.4g} {}, {:.4g} {} deep in {}", d, unit, rules_.depth, unit,
                           counted(static_cast<std::size_t>(levels), "pass", "passes"));
      case CutProcess::kLaser:
        return fmt::format("laser, kerf {:.4g} {}", d, unit);
      case CutProcess::kPlasma:
        break;
    }
    return fmt::format("plasma, kerf {:.4g} {}", d, unit);
  }

  [[nodiscard]] std::string head(const CutProgram& out) const {
    std::vector<std::string> remarks{
        fmt::format("Obvid {}: {}", kVersion, gcode_comment(options_.name)),
        tool_text(out.report.levels),
        fmt::format("{}, about {:.1f} min", counted(out.steps.size(), "outline", "outlines"),
                    out.report.minutes)};
    if (!units_.known()) remarks.emplace_back("the unit is assumed");
    if (!inches_ && scale_ != 1.0)
      remarks.push_back("converted from " + gcode_comment(units_.name));
    return exchange::gcode_head(options_.controller, inches_, remarks);
  }

  [[nodiscard]] std::string start_words(const CutText& text) const {
    return options_.process == CutProcess::kMill && options_.spindle ? text.on_words() : "";
  }
  [[nodiscard]] std::string end_words() const {
    const bool spins = options_.process == CutProcess::kMill && options_.spindle.has_value();
    return (spins ? "M5\n" : "") + exchange::gcode_end(options_.controller);
  }

  const std::vector<CutOutline>& outlines_;
  const CutOptions& options_;
  Watch watch_;
  Units units_;
  bool inches_;
  double scale_;
  Defaults defaults_;
  BlockRules rules_;
  int decimals_ = 0;
  std::vector<Track> tracks_;
};

}  // namespace

Result<CutProgram> cut(const std::vector<CutOutline>& outlines, const CutOptions& options,
                       const RunContext& run) {
  OBVID_TRY(check_sizes(options));
  if (outlines.empty()) return error(ErrorCode::kNothingThere, "there is no outline to cut");
  for (const CutOutline& one : outlines) {
    if (one.contour.pieces.empty()) {
      return error(ErrorCode::kNothingThere, "the outline has no pieces").where(one.name);
    }
  }
  OBVID_TRY(unit_ratio(outlines.front().contour.units, "mm", "machines"));
  return Cutting(outlines, options, run).run();
}

}  // namespace obvid
