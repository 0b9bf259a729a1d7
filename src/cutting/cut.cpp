// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "cut_blocks.h"
#include "cut_check.h"
#include "cut_options.h"
#include "cut_order.h"
#include "cut_splines.h"
#include "cut_text.h"
#include "cut_time.h"
#include "obvid/core/internal/figures.h"
#include "obvid/core/internal/inch.h"
#include "obvid/core/version.h"
#include "obvid/cutting/cutting.h"
#include "obvid/exchange/internal/gcode/dialect.h"
#include "outlines.h"

namespace obvid {
namespace {

using namespace cutting;

constexpr double kHalfTurn = 180.0;  // degrees

/// In mm and minutes; in inches.
struct Defaults {
  double plunge, rapid, safe_z, clear_z;
};
constexpr Defaults kMillimetres{300.0, 3000.0, 5.0, 1.0}, kInches{12.0, 120.0, 0.2, 0.04};
/// Of the tolerance, for arcs in place of curves: printing and small turns take the rest. What is
/// tried where that was too much.
constexpr double kOfTolerance = 0.8, kSafeOfTolerance = 0.5;
/// Last digits: how far ends are printed off (half of one in x and in y) and centres of arcs; what
/// a tolerance of curves is at least.
constexpr double kDigitsOfPrinting = 1.7, kFewestDigits = 1.25;
constexpr double kForReadingBack = 0.04;  // of the tolerance: chords of what is read back
constexpr double kMostBlocks = 3e5;
constexpr int kMoreDecimals = 3;           // of lengths that are told: beyond those of places
constexpr double kTooLittleToTell = 1e-9;  // of the tolerance: rounding
constexpr double kLeftIsRounding = 1e-6;   // of the tolerance: corners of no angle
constexpr double kOrderAt = 0.4, kReadBackAt = 0.7;  // of the work

class Cutting {
 public:
  Cutting(const std::vector<CutOutline>& outlines, const CutOptions& options, const RunContext& run)
      : outlines_(outlines),
        options_(options),
        watch_(run),
        units_(outlines.front().contour.units),
        inches_(exchange::in_inches(units_)),
        scale_(*exchange::machine_units_in(units_)),
        defaults_(inches_ ? kInches : kMillimetres) {}

  Result<CutProgram> run() {
    decimals_ = options_.decimals.value_or(exchange::decimals_of_digit(
        exchange::kDigitOfTolerance * (options_.tolerance * scale_), inches_));
    OBVID_TRY(check_lengths());
    blending_ = exchange::blending_of(options_.controller, options_.tolerance * scale_);
    OBVID_TRY(check_digits());
    auto out = with_share(kOfTolerance - blending_ / (options_.tolerance * scale_));
    // coarse digits, and drawings whose pieces meet with small turns, take more than their part
    if (out || out.error().code != ErrorCode::kToleranceNotReached) return out;
    return with_share(kSafeOfTolerance);
  }

 private:
  Result<CutProgram> with_share(double share) {
    watch_.tell("outlines", 0.0);
    auto tracks = tracks_of(outlines_, options_, scale_, share, watch_);
    OBVID_TRY(tracks);
    tracks_ = std::move(*tracks);
    rules_ = rules();
    OBVID_TRY(check_work());
    watch_.tell("order", kOrderAt);
    const Leads leads(tracks_.edges, options_.lead_in * scale_, 0.5 * rules_.tool_diameter,
                      options_.direction == CutDirection::kClimb);
    const std::vector<Visit> visits = ordered(tracks_, scaled(options_.start), leads, watch_);
    if (watch_.cancelled()) return fail(cancelled_error());
    CutBlocks blocks = blocks_of(tracks_.all, visits, rules_, leads);
    if (options_.motion == GcodeMotion::kSplines) {
      const SplineRules splines{spline_tolerance(options_.tolerance, share) * scale_,
                                std::pow(10.0, -decimals_)};
      blocks.blocks = with_splines(std::move(blocks.blocks), rules_, splines, watch_);
      if (watch_.was_cancelled()) return fail(cancelled_error());
    }
    CutText text(options_, rules_, inches_, decimals_);
    for (const CutBlock& block : blocks.blocks) {
      const bool cuts = block.kind == CutBlock::Kind::kCut;
      if ((cuts || block.kind == CutBlock::Kind::kDown) && block.feed < exchange::kLeastFeed) {
        return fail(no_feed(!cuts                  ? "--plunge-feed"
                            : options_.centripetal ? "--centripetal"
                                                   : "--feed"));
      }
      text.add(block);
    }
    if (text.path().lost_arcs()) return fail(too_few_digits("centres of arcs are too far away"));
    OBVID_TRY(everything_is_cut(text));
    return finished(visits, blocks, text);
  }

  [[nodiscard]] std::optional<Vec2> scaled(std::optional<Vec2> place) const {
    if (place) *place = scale_ * *place;
    return place;
  }

  [[nodiscard]] static Error no_feed(const char* option) {
    return error(ErrorCode::kBadOption, "the feed would be printed as 0")
        .where(option)
        .hint("give a larger one");
  }

  [[nodiscard]] double last_digit() const { return std::pow(10.0, -decimals_); }

  /// A tolerance that the digits leave room for, units of the drawing: with arcs in place of curves
  /// in the share that is tried last, and a controller that blends.
  [[nodiscard]] double enough_tolerance() const {
    const double blended = blending_ / (options_.tolerance * scale_);
    const double rest = 1.0 - kSafeOfTolerance - kForReadingBack - blended;
    return kDigitsOfPrinting * last_digit() / (rest * scale_);
  }

  [[nodiscard]] Error too_few_digits(std::string what) const {
    const bool most = decimals_ >= exchange::kMostGcodeDecimals;
    return error(ErrorCode::kToleranceNotReached, std::move(what))
        .hint(fmt::format("printed with {}{}: give {}--tolerance {} or more",
                          counted(static_cast<std::size_t>(decimals_), "decimal", "decimals"),
                          most ? ", the most there are" : "", most ? "" : "more --decimals, or ",
                          significant_above(enough_tolerance(), 2)));
  }

  /// Arcs in place of curves end anywhere: some ends are printed nearly as far off as rounding
  /// goes. Lines and arcs as drawn may have ends that print as they are.
  [[nodiscard]] Result<void> check_digits() const {
    const auto is_given = [](const Piece& piece) {
      return std::holds_alternative<LinePiece>(piece) || std::holds_alternative<ArcPiece>(piece);
    };
    const bool any = std::any_of(outlines_.begin(), outlines_.end(), [&](const CutOutline& one) {
      const auto& pieces = one.contour.pieces;
      return one.is_cut && !std::all_of(pieces.begin(), pieces.end(), is_given);
    });
    if (!any || options_.tolerance * scale_ >= kFewestDigits * last_digit()) return {};
    Error refused = too_few_digits(fmt::format(
        "the last digit of places is worth {} {}, and the tolerance is {}",
        significant(last_digit() / scale_, 2), units_.text(), significant(options_.tolerance, 3)));
    refused.value = options_.tolerance;
    return fail(std::move(refused));
  }

  [[nodiscard]] BlockRules rules() const {
    BlockRules out;
    out.process = options_.process;
    out.depth = options_.depth * scale_;
    out.pass_depth = options_.pass_depth.value_or(options_.depth) * scale_;
    out.passes = options_.passes;
    out.fall =
        options_.ramp_deg ? std::tan(*options_.ramp_deg * std::numbers::pi / kHalfTurn) : 0.0;
    out.tabs = {options_.tabs.count, options_.tabs.width * scale_, options_.tabs.height * scale_};
    out.tool_diameter = options_.diameter * scale_;
    out.safe_z = options_.safe_z ? *options_.safe_z * scale_ : defaults_.safe_z;
    out.clear_z = std::min(out.safe_z, defaults_.clear_z);
    out.feed = options_.feed.value_or(default_feed(units_));
    out.plunge_feed = options_.plunge_feed.value_or(defaults_.plunge);
    out.across = options_.centripetal.value_or(0.0) / (inches_ ? kMmPerInch : 1.0);
    out.pierce_seconds = options_.pierce_seconds;
    return out;
  }

  /// A length as programs hold it; nothing is none.
  [[nodiscard]] Result<void> check_length(const char* option, std::optional<double> given,
                                          int decimals) const {
    if (!given || *given == 0.0) return {};
    const double printed = *given * scale_, unit = std::pow(10.0, -decimals);
    const auto bad = [&](const char* what, const std::string& hint) -> Result<void> {
      return error(ErrorCode::kBadOption, what).where(option).hint(hint).value(*given);
    };
    if (printed > exchange::kLongestWay / (inches_ ? kMmPerInch : 1.0)) {
      return bad("no machine is a kilometre long", "check the units of the drawing: --units");
    }
    if (printed >= unit) return {};
    return bad("this is less than programs print",
               fmt::format("at least {} {} with {}", significant(unit / scale_, 2), units_.text(),
                           counted(static_cast<std::size_t>(decimals), "decimal", "decimals")));
  }

  [[nodiscard]] Result<void> check_lengths() const {
    const int heights = CutText::height_decimals(decimals_, inches_);
    OBVID_TRY(check_length("--diameter", options_.diameter, decimals_));
    OBVID_TRY(check_length("--lead-in", options_.lead_in, decimals_));
    if (options_.process != CutProcess::kMill) return {};
    OBVID_TRY(check_length("--depth", options_.depth, heights));
    OBVID_TRY(check_length("--pass-depth", options_.pass_depth, heights));
    OBVID_TRY(check_length("--safe-z", options_.safe_z, heights));
    if (options_.tabs.count > 0) {
      OBVID_TRY(check_length("--tab-width", options_.tabs.width, decimals_));
      OBVID_TRY(check_length("--tab-height", options_.tabs.height, heights));
    }
    const double depth = options_.depth * scale_, unit = std::pow(10.0, -heights);
    const double printed = std::round(depth / unit) * unit;
    if (std::abs(printed - depth) <= kPrintedDepth * depth) return {};
    return error(ErrorCode::kBadOption,
                 fmt::format("this depth would be printed as {}", significant(printed, 3)))
        .where("--depth")
        .hint("give more --decimals, or a depth that has no more places")
        .value(options_.depth);
  }

  /// Refuses work without end: a typing error in a length, most likely.
  [[nodiscard]] Result<void> check_work() const {
    double pieces = 0.0, shortest = std::numeric_limits<double>::infinity();
    for (const Track& track : tracks_.all) {
      pieces += static_cast<double>(track.axis.pieces.size());
      shortest = std::min(shortest, length_of(track.axis));
    }
    const bool mill = options_.process == CutProcess::kMill;
    const double levels = mill ? levels_of(rules_) : options_.passes;
    const double around = mill && rules_.fall > 0.0 ? rules_.depth / (rules_.fall * shortest) : 0.0;
    const double blocks =
        (pieces + 2.0 * options_.tabs.count) * (levels + around * (1.0 + options_.tabs.count));
    if (blocks <= kMostBlocks) return {};
    return error(ErrorCode::kBadOption, fmt::format("that would be some {:.2g} blocks", blocks))
        .hint("check the units of the drawing, --pass-depth, --ramp, --passes and --tabs")
        .value(blocks);
  }

  /// A hole as wide as the tool is a place, not a way.
  [[nodiscard]] Result<void> everything_is_cut(const CutText& text) const {
    std::vector<bool> cut(tracks_.all.size());
    for (const std::size_t track : text.cut_tracks()) cut[track] = true;
    const auto none = std::find(cut.begin(), cut.end(), false);
    if (none == cut.end()) return {};
    return error(ErrorCode::kToolTooLarge, "the tool fills it: there is no way to cut along")
        .where(tracks_.all[static_cast<std::size_t>(none - cut.begin())].name)
        .hint("drill it, or choose a smaller cutter");
  }

  Result<CutProgram> finished(const std::vector<Visit>& visits, const CutBlocks& blocks,
                              const CutText& text) {
    CutProgram out;
    for (const Visit& visit : visits) out.steps.push_back(step_of(visit));
    add_moves(blocks, text, out);
    const exchange::MotionRules times{
        options_.rapid_feed.value_or(defaults_.rapid),
        exchange::machine_acceleration(options_.acceleration, inches_),
        blending_ > 0.0 ? blending_ : options_.tolerance * scale_};
    out.report.minutes =
        seconds_of(blocks.blocks, times, options_.pierce_seconds) / exchange::kSecondsOfMinute;
    out.report.levels = blocks.levels;
    out.text = head(out) + text.start() + text.path().text() + text.end();
    watch_.tell("reading it back", kReadBackAt);
    OBVID_TRY(read_back(out, text));
    out.warnings = tracks_.warnings;
    for (std::string& one : idle_cut_options(options_)) out.warnings.push_back(std::move(one));
    tell_followed(visits, out);
    for (const std::size_t track : blocks.without_tabs) {
      out.warnings.push_back(tracks_.all[track].name + " has no room for its tabs: it has none");
    }
    if (!blocks.straight_down.empty()) {
      const CutBlocks::Place& first = blocks.straight_down.front();
      out.warnings.push_back(fmt::format(
          "--ramp: straight down {} behind tabs, where there is no room for a ramp: first on {}, "
          "at "
          "{}, {}",
          blocks.straight_down.size() == 1 ? "once"
                                           : fmt::format("{} times", blocks.straight_down.size()),
          tracks_.all[first.track].name, significant(first.at.x / scale_, 6),
          significant(first.at.y / scale_, 6)));
    }
    for (const Visit& visit : visits) {
      if (!visit.lead_left_out) continue;
      out.warnings.push_back(tracks_.all[visit.track].name +
                             " has no room for a lead-in: the tool begins on its path");
    }
    watch_.tell("done", 1.0);
    return out;
  }

  /// Curves that the tool follows on the line have neither tabs nor leads.
  void tell_followed(const std::vector<Visit>& visits, CutProgram& out) const {
    constexpr std::size_t kMostNamed = 8;
    const bool beside =
        options_.diameter > 0.0 && options_.side != CutSide::kOn;  // else told above
    const bool tabs = options_.tabs.count > 0 && options_.process == CutProcess::kMill;
    if (!beside || (!tabs && options_.lead_in == 0.0)) return;
    std::vector<std::string> names;
    std::size_t count = 0;
    for (const Visit& visit : visits) {
      const Track& track = tracks_.all[visit.track];
      if (track.side == CutSide::kOn && ++count <= kMostNamed) names.push_back(track.name);
    }
    if (count == 0) return;
    const char* options = !tabs                     ? "--lead-in"
                          : options_.lead_in == 0.0 ? "--tabs"
                                                    : "--tabs, --lead-in";
    out.warnings.push_back(
        fmt::format("{}: for closed outlines alone; left out on open curves: {}{}", options,
                    listed(names), and_more(count, kMostNamed)));
  }

  Result<void> read_back(CutProgram& out, const CutText& text) {
    const double spacing = spacing_of(tracks_.all, 0.5 * rules_.tool_diameter, out.report.levels);
    const auto found =
        checked(out.text, tracks_, text.motions(), rules_,
                std::max(options_.tolerance * scale_, last_digit()), spacing, watch_);
    OBVID_TRY(found);
    double off = text.path().radius_mismatch();
    for (const Track& track : tracks_.all) off = std::max(off, track.deviation);
    const auto told = [&](double value) {
      const double sum = std::max(0.0, value) + off;
      return sum > kTooLittleToTell * options_.tolerance * scale_ ? sum / scale_ : 0.0;
    };
    out.report.beyond = told(found->beyond);
    out.report.short_of = told(found->short_of);
    out.report.spacing = spacing / scale_;
    out.report.blending = blending_ / scale_;
    const double worst = std::max(out.report.beyond, out.report.short_of) + out.report.blending;
    if (worst <= options_.tolerance) return {};
    return fail(too_few_digits(fmt::format("the printed program would be {} {} off the outlines",
                                           significant(worst, 3), units_.text())));
  }

  /// To the decimals of the program, never -0: what is finer is rounding of ours.
  [[nodiscard]] static double as_printed(double value, int decimals) {
    const double unit = std::pow(10.0, decimals);
    return std::round(value * unit) / unit + 0.0;
  }

  [[nodiscard]] CutStep step_of(const Visit& visit) const {
    const Track& track = tracks_.all[visit.track];
    CutStep out;
    out.outline = track.outline;
    out.name = track.name;
    out.closed = track.edge.closed;
    out.around = track.around;
    out.side = track.side;
    const Vec2 begin = begin_of(visit);
    out.start = Vec2{as_printed(begin.x, decimals_), as_printed(begin.y, decimals_)} / scale_;
    out.length = as_printed(length_of(visit.path), decimals_ + kMoreDecimals) / scale_;
    for (const auto& corner : track.corners) {
      out.left_in_corners = std::max(out.left_in_corners, corner.left / scale_);
    }
    if (out.left_in_corners <= kLeftIsRounding * options_.tolerance) out.left_in_corners = 0.0;
    return out;
  }

  void add_moves(const CutBlocks& blocks, const CutText& text, CutProgram& out) const {
    const std::vector<Piece>& printed = text.path().pieces();
    CutReport& report = out.report;
    report.blocks = printed.size();
    report.arc_blocks = text.path().arcs();
    report.spline_blocks = static_cast<std::size_t>(std::count_if(
        printed.begin(), printed.end(),
        [](const Piece& piece) { return std::holds_alternative<RationalBezier>(piece); }));
    for (const CutStep& step : out.steps) {
      report.left_in_corners = std::max(report.left_in_corners, step.left_in_corners);
    }
    for (std::size_t k = 0; k < printed.size(); ++k) {
      const Piece piece = cutting::scaled(printed[k], 1.0 / scale_);
      report.cut_length += length_of(piece);
      if (text.over_tab()[k]) {
        out.moves.push_back({CutMoveKind::kTab, piece});
      } else if (text.first_pass()[k]) {
        out.moves.push_back({CutMoveKind::kCut, piece});
      }
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
    const char* unit = inches_ ? "in" : "mm";
    const std::string passes = counted(static_cast<std::size_t>(levels), "pass", "passes");
    switch (options_.process) {
      case CutProcess::kMill:
        return fmt::format("mill D{:.4g} {}, {:.4g} {} deep in {}", rules_.tool_diameter, unit,
                           rules_.depth, unit, passes);
      case CutProcess::kLaser:
        return fmt::format("laser, kerf {:.4g} {}, {}", rules_.tool_diameter, unit, passes);
      case CutProcess::kPlasma:
        break;
    }
    return fmt::format("plasma, kerf {:.4g} {}, {}", rules_.tool_diameter, unit, passes);
  }

  [[nodiscard]] std::string head(const CutProgram& out) const {
    std::vector<std::string> remarks{
        fmt::format("Obvid {}: {}", kVersion, gcode_comment(options_.name)),
        tool_text(out.report.levels),
        fmt::format("{}, about {:.1f} min", counted(out.steps.size(), "outline", "outlines"),
                    out.report.minutes)};
    for (std::string& one : exchange::gcode_unit_remarks(units_)) {
      remarks.push_back(std::move(one));
    }
    return exchange::gcode_head(options_.controller, inches_, options_.tolerance * scale_, remarks);
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
  double blending_ = 0.0;  ///< by the controller
  Tracks tracks_;
};

}  // namespace

const char* to_string(CutSide side) {
  switch (side) {
    case CutSide::kAuto:
      return "auto";
    case CutSide::kOutside:
      return "outside";
    case CutSide::kInside:
      return "inside";
    case CutSide::kOn:
      break;
  }
  return "on";
}

Result<CutProgram> cut(const std::vector<CutOutline>& outlines, const CutOptions& options,
                       const RunContext& run) {
  OBVID_TRY(check_cut_options(options));
  const auto is_cut = [](const CutOutline& one) { return one.is_cut; };
  if (std::none_of(outlines.begin(), outlines.end(), is_cut)) {
    return error(ErrorCode::kNothingThere, "there is no outline to cut");
  }
  for (const CutOutline& one : outlines) {
    if (one.contour.pieces.empty()) {
      return error(ErrorCode::kNothingThere, "the outline has no pieces").where(one.name);
    }
  }
  OBVID_TRY(unit_ratio(outlines.front().contour.units, "mm", "machines"));
  return Cutting(outlines, options, run).run();
}

}  // namespace obvid
