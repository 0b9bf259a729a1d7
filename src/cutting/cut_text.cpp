// SPDX-License-Identifier: Apache-2.0
#include "cut_text.h"

#include <algorithm>
#include <cmath>

#include "obvid/exchange/internal/gcode/dialect.h"

namespace obvid::cutting {
namespace {

using exchange::fixed;

constexpr double kMilliseconds = 1000.0;  // in a second

/// Few decimals, but not 0.
int decimals_of(double value) {
  constexpr double kLarge = 10.0;
  constexpr int kFew = 1, kMore = 4;
  return value >= kLarge ? kFew : kMore;
}

std::string few_decimals(double value) { return fixed(value, decimals_of(value)); }

/// Rounded down: no faster than meant.
std::string feed_text(double feed) {
  constexpr double kRounding = 1e-12;  // of the feed: 0.3 is 3000 digits, not 2999.9999999999995
  const int decimals = decimals_of(feed);
  const double digits = std::pow(10.0, decimals);
  return fixed(std::floor(feed * digits * (1.0 + kRounding)) / digits, decimals);
}

/// Revolutions are whole numbers; power on a scale of 1 is not.
std::string power_text(double value) {
  return value == std::round(value) ? fixed(value, 0) : few_decimals(value);
}

}  // namespace

int CutText::height_decimals(int decimals, bool inches) {
  return std::max(decimals, exchange::kLeastGcodeDecimals + (inches ? 1 : 0));
}

CutText::CutText(const CutOptions& options, const BlockRules& rules, bool inches, int decimals)
    : options_(options),
      rules_(rules),
      height_decimals_(height_decimals(decimals, inches)),
      path_(1.0, decimals) {}

void CutText::add(const CutBlock& block) {
  using enum CutBlock::Kind;
  switch (block.kind) {
    case kRapidAcross:
      path_.start_at(block.to);
      path_.say("G0 " + path_.start() + "\n");
      placed_ = true;
      motions_.push_back(block.track);
      break;
    case kRapidLevel:
      path_.say("G0" + height_words(block.z) + "\n");
      if (placed_) motions_.push_back(block.track);
      break;
    case kDown:
      path_.say("G1" + height_words(block.z) + feed_words(block.feed) + "\n");
      motions_.push_back(block.track);
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

void CutText::cut(const CutBlock& block) {
  const bool is_cubic = std::holds_alternative<RationalBezier>(block.piece);
  if (is_cubic && block.z != z_) {  // G5 has no word Z: a change that rounded away before it
    path_.say("G1" + height_words(block.z) + feed_words(block.feed) + "\n");
    motions_.push_back(block.track);
  }
  const std::string feed_before = feed_;
  const double z_before = z_;
  const std::string level = block.z == z_ ? "" : height_words(block.z);
  path_.say_behind(level + feed_words(printed_feed(block)));
  const std::size_t printed = path_.pieces().size();
  if (const auto* arc = std::get_if<ArcPiece>(&block.piece)) {
    path_.follow_arc(*arc);
  } else if (const auto* cubic = std::get_if<RationalBezier>(&block.piece)) {
    path_.follow_cubic(*cubic);
  } else {
    path_.line_to(end_point(block.piece));
  }
  if (path_.pieces().size() == printed) {  // it rounded away: the next one says it
    feed_ = feed_before;
    z_ = z_before;
    return;
  }
  for (std::size_t k = printed; k < path_.pieces().size(); ++k) {
    motions_.push_back(block.track);
    cut_tracks_.push_back(block.track);
    first_pass_.push_back(block.first_pass);
    over_tab_.push_back(block.over_tab);
  }
}

double CutText::printed_feed(const CutBlock& block) const {
  const auto* arc = std::get_if<ArcPiece>(&block.piece);
  if (arc == nullptr || !(rules_.across > 0.0)) return block.feed;
  exchange::GcodePath printed = path_.from_here();
  printed.follow_arc(*arc);
  double feed = block.feed;
  for (const Piece& piece : printed.pieces()) {
    const auto* one = std::get_if<ArcPiece>(&piece);
    if (one != nullptr) feed = std::min(feed, feed_for(one->kappa, rules_));
  }
  return feed;
}

std::string CutText::height_words(double z) {
  z_ = z;
  return " Z" + fixed(z, height_decimals_);
}

std::string CutText::feed_words(double feed) {
  const std::string words = " F" + feed_text(feed);
  if (words == feed_) return "";
  feed_ = words;
  return words;
}

std::string CutText::on_words() const {
  const bool by_speed =
      options_.process == CutProcess::kLaser && options_.controller == GcodeController::kGrbl;
  return std::string(by_speed ? "M4" : "M3") +
         (options_.spindle ? " S" + power_text(*options_.spindle) : "") + "\n";
}

std::string CutText::dwell_words() const {
  const bool milliseconds = options_.controller == GcodeController::kFanuc ||
                            options_.controller == GcodeController::kMarlin;
  return "G4 P" +
         (milliseconds ? fixed(options_.pierce_seconds * kMilliseconds, 0)
                       : fixed(options_.pierce_seconds, exchange::kLeastGcodeDecimals)) +
         "\n";
}

std::string CutText::start() const {
  return options_.process == CutProcess::kMill && options_.spindle ? on_words() : "";
}

std::string CutText::end() const {
  const bool spins = options_.process == CutProcess::kMill && options_.spindle.has_value();
  return (spins ? "M5\n" : "") + exchange::gcode_end(options_.controller);
}

}  // namespace obvid::cutting
