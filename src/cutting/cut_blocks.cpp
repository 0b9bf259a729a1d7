// SPDX-License-Identifier: Apache-2.0
#include "cut_blocks.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "obvid/curve/internal/contour_path.h"
#include "obvid/exchange/internal/gcode/motion_time.h"
#include "obvid/exchange/internal/gcode/path.h"

namespace obvid::cutting {
namespace {

/// Shares of a length that are rounding.
constexpr double kNothing = 1e-12;
/// What tabs may take of a path.
constexpr double kMostOfPath = 0.5;
/// To and fro behind a tab; a ramp that asks for more is a mistake.
constexpr double kMostWays = 100.0;
/// Places of a closed path at which a tool that came down a ramp may leave it, at least.
constexpr double kPlacesToLeave = 64.0;

/// A path by its length, around and around when it is closed.
class Along {
 public:
  explicit Along(const ArcPath& path) : path_(path.pieces), closed_(path.closed) {}
  [[nodiscard]] double length() const { return path_.length(); }

  /// The place at a length, 0 or more.
  [[nodiscard]] Vec2 at(double length) const {
    return path_.jet(std::fmod(length, path_.length())).point;
  }

  /// The way off the path from there, as `at`.
  [[nodiscard]] ArcPiece lead_at(double length, const Leads& leads) const {
    const auto [k, t] = path_.parameter(std::fmod(length, path_.length()));
    return leads.at(path_.pieces()[k], t, false);
  }

  /// The pieces between two lengths, 0 <= from < to; beyond its end a closed path begins again.
  [[nodiscard]] std::vector<Piece> between(double from, double to) const {
    std::vector<Piece> out;
    const std::span<const Piece> pieces = path_.pieces();
    const double whole = length();
    const double turns = closed_ ? std::floor(from / whole) : 0.0;
    double at = from - turns * whole, left = to - from;
    std::size_t k = path_.parameter(at).piece;
    while (left > kNothing * whole) {
      const double own = path_.joint(k + 1) - path_.joint(k);
      const double begin = std::max(0.0, at - path_.joint(k)), end = std::min(own, begin + left);
      if (end - begin > kNothing * whole) {
        out.push_back(part_of(pieces[k], begin <= kNothing * whole ? 0.0 : begin / own,
                              own - end <= kNothing * whole ? 1.0 : end / own));
      }
      left -= end - begin;
      if (++k == pieces.size()) {
        if (!closed_) break;
        k = 0;
      }
      at = path_.joint(k);
    }
    return out;
  }

 private:
  ContourPath path_;
  bool closed_;
};

class Blocks {
 public:
  Blocks(const std::vector<Track>& tracks, const BlockRules& rules, const Leads& leads)
      : tracks_(tracks), rules_(rules), leads_(leads) {}

  CutBlocks run(const std::vector<Visit>& visits) {
    const bool mill = rules_.process == CutProcess::kMill;
    out_.levels = mill ? static_cast<int>(levels_of(rules_)) : rules_.passes;
    if (mill) level(rules_.safe_z);
    for (const Visit& visit : visits) {
      track_ = visit.track;
      mill ? milled(visit) : burnt(visit);
    }
    return std::move(out_);
  }

 private:
  CutBlock& add(CutBlock::Kind kind) {
    CutBlock block;
    block.kind = kind;
    block.track = track_;
    block.z = z_;
    out_.blocks.push_back(block);
    return out_.blocks.back();
  }
  void across(Vec2 to) { add(CutBlock::Kind::kRapidAcross).to = to; }
  void level(double z) {
    z_ = z;
    add(CutBlock::Kind::kRapidLevel).z = z;
  }
  void down(double z) {
    if (z == z_) return;
    z_ = z;
    CutBlock& block = add(CutBlock::Kind::kDown);
    block.z = z;
    block.feed = rules_.plunge_feed;
  }

  void cut(const Piece& whole, double z) {
    const double turn = std::abs(curvature_of(whole)) * length_of(whole), from = z_;
    const auto parts = static_cast<int>(exchange::blocks_of_turn(turn));
    for (int k = 0; k < parts; ++k) {
      CutBlock& block = add(CutBlock::Kind::kCut);
      block.piece = parts == 1 ? whole
                               : part_of(whole, static_cast<double>(k) / parts,
                                         static_cast<double>(k + 1) / parts);
      block.z = k + 1 == parts ? z : from + (z - from) * (k + 1) / parts;
      block.feed = feed_for(curvature_of(block.piece), rules_);
      block.first_pass = first_pass_;
      block.over_tab = over_tab_;
    }
    z_ = z;
  }
  void cut(const std::optional<ArcPiece>& lead) {
    if (lead) cut(Piece{*lead}, z_);
  }

  void burnt(const Visit& visit) {
    across(begin_of(visit));
    add(CutBlock::Kind::kOn);
    if (rules_.pierce_seconds > 0.0) add(CutBlock::Kind::kDwell);
    cut(visit.lead_in);
    for (int pass = 0; pass < out_.levels; ++pass) {
      first_pass_ = pass == 0;
      const bool back = !visit.path.closed && pass % 2 == 1;
      for (const Piece& piece : back ? reversed(visit.path).pieces : visit.path.pieces)
        cut(piece, z_);
    }
    cut(visit.lead_out);
    add(CutBlock::Kind::kOff);
  }

  void milled(const Visit& visit) {
    const Along along(visit.path);
    plan_tabs(visit, along);
    across(begin_of(visit));
    level(rules_.clear_z);
    visit.path.closed ? milled_around(visit, along) : milled_along(visit, along);
    level(rules_.safe_z);
  }

  [[nodiscard]] double bottom(int pass) const {
    return pass + 1 == out_.levels ? -rules_.depth : -rules_.pass_depth * (pass + 1);
  }

  void milled_around(const Visit& visit, const Along& along) {
    double at = 0.0;
    for (int pass = 0; pass < out_.levels; ++pass) {
      first_pass_ = pass == 0;
      const double z = bottom(pass);
      if (rules_.fall > 0.0) {
        if (pass == 0) {
          down(0.0);
          cut(visit.lead_in);
        }
        const double ramp = (z_ramp_ - z) / rules_.fall;
        walk(along, at, at + ramp, z_ramp_, z);
        at += ramp;
        // where a turn falls by no more than this pass and the next one, that goes on from here
        const double next = pass + 1 < out_.levels ? (z - bottom(pass + 1)) / rules_.fall : 0.0;
        if (std::min(ramp, next) >= along.length() * (1.0 - kNothing)) {
          z_ramp_ = z;
          continue;
        }
      } else {
        if (pass > 0 && visit.lead_in) {  // where the tool goes down, it leaves no mark
          level(rules_.safe_z);
          across(begin_of(visit));
          level(rules_.clear_z);
        }
        down(z);
        cut(visit.lead_in);
      }
      walk(along, at, at + along.length(), z, z);
      z_ramp_ = z;
      if (rules_.fall == 0.0) cut(visit.lead_out);
    }
    z_ramp_ = 0.0;
    if (rules_.fall > 0.0 && visit.lead_out) lead_away(visit, along, at + along.length());
  }

  /// Behind ramps the tool ends at another place than it began: on along the way at the bottom to
  /// the first one with room for a lead; where it began there is.
  void lead_away(const Visit& visit, const Along& along, double end) {
    const double whole = along.length(), start = std::ceil(end / whole - kNothing) * whole;
    const double step = std::min(leads_.radius(), whole / kPlacesToLeave);
    for (double at = end; at < start - kNothing * whole; at += step) {
      const double place = std::fmod(at, whole);
      if (inside_of_tab(place) || room_behind(place, whole) < leads_.radius()) continue;
      const ArcPiece lead = along.lead_at(place, leads_);
      if (!leads_.has_room(lead)) continue;
      if (at > end) walk(along, end, at, -rules_.depth, -rules_.depth);
      return cut(std::optional(lead));
    }
    if (start - end > kNothing * whole) {
      walk(along, end, start, -rules_.depth, -rules_.depth);
    }
    cut(visit.lead_out);
  }

  [[nodiscard]] bool inside_of_tab(double place) const {
    return std::any_of(tabs_.begin(), tabs_.end(),
                       [&](const Tab& tab) { return place > tab.from && place < tab.to; });
  }

  /// To and fro.
  void milled_along(const Visit& visit, const Along& forward) {
    const ArcPath other = reversed(visit.path);
    const Along backward(other);
    const double length = forward.length();
    bool back = false;
    const auto leg = [&](double from_z, double to_z) {
      const Along& way = back ? backward : forward;
      const double ramp = rules_.fall > 0.0 ? std::min(length, (from_z - to_z) / rules_.fall) : 0.0;
      if (ramp > 0.0) walk(way, 0.0, ramp, from_z, to_z);
      if (length - ramp > kNothing * length) walk(way, ramp, length, to_z, to_z);
      back = !back;
    };
    double above = 0.0;
    for (int pass = 0; pass < out_.levels; ++pass) {
      first_pass_ = pass == 0;
      const double z = bottom(pass);
      if (rules_.fall > 0.0) {
        down(above);
        while (above > z) {
          const double next = std::max(z, above - length * rules_.fall);
          leg(above, next);
          above = next;
        }
      } else {
        down(z);
        above = z;
      }
      leg(z, z);
    }
  }

  struct Tab {
    double from, to;
  };

  void plan_tabs(const Visit& visit, const Along& along) {
    tabs_.clear();
    const CutTabs& tabs = rules_.tabs;
    if (tabs.count == 0 || !visit.path.closed || tracks_[visit.track].side == CutSide::kOn) return;
    const double apart = along.length() / tabs.count;
    for (int k = 0; k < tabs.count; ++k) {
      const double middle = on_a_line(visit.path, (k + 0.5) * apart, apart);
      const auto half = half_of_tab(along, middle, 0.5 * kMostOfPath * apart);
      if (!half) {
        tabs_.clear();
        out_.without_tabs.push_back(visit.track);
        return;
      }
      tabs_.push_back({middle - *half, middle + *half});
    }
  }

  /// Where a tab goes that is wanted at a place: the nearest one on a line, away from its ends,
  /// where there is one near enough that tabs keep their order; a corner is hard to file.
  [[nodiscard]] double on_a_line(const ArcPath& path, double wanted, double apart) const {
    constexpr double kMostAway = 0.25;  // of the distance of tabs
    const double width = rules_.tabs.width + rules_.tool_diameter;
    double best = wanted, away = kMostAway * apart, begin = 0.0;
    for (const Piece& piece : path.pieces) {
      const double length = length_of(piece), room = 0.5 * (length - width);
      if (std::holds_alternative<LinePiece>(piece) && room > 0.0) {
        const double inside = 0.5 * width + std::min(room, width);
        const double place = std::clamp(wanted, begin + inside, begin + length - inside);
        if (std::abs(place - wanted) < away) {
          best = place;
          away = std::abs(place - wanted);
        }
      }
      begin += length;
    }
    return best;
  }

  /// Half of the gap in the path that leaves a bridge of the width of a tab: both ends of the cut
  /// are so far from each other, and a diameter more. Around corners that takes a longer gap.
  [[nodiscard]] std::optional<double> half_of_tab(const Along& along, double middle,
                                                  double most) const {
    const double width = rules_.tabs.width + rules_.tool_diameter;
    constexpr double kLonger = 1.01;
    for (double half = 0.5 * width; half <= most; half *= kLonger) {
      if (norm(along.at(middle + half) - along.at(middle - half)) >= width * (1.0 - kNothing))
        return half;
    }
    return std::nullopt;
  }

  /// Along pieces, down or level to a height.
  void follow(const std::vector<Piece>& pieces, double z) {
    double length = 0.0, done = 0.0;
    for (const Piece& piece : pieces) length += length_of(piece);
    const double from = z_;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      done += length_of(pieces[i]);
      cut(pieces[i], i + 1 == pieces.size() ? z : from + (z - from) * (done / length));
    }
  }

  /// How far the path goes on from a place before the next tab.
  [[nodiscard]] double room_behind(double place, double whole) const {
    double out = whole;
    for (const Tab& tab : tabs_) {
      const double way = std::fmod(tab.from - place, whole);
      out = std::min(out, way < 0.0 ? way + whole : way);
    }
    return out;
  }

  /// Behind a tab, down into what stands there: straight, or with ramps to and fro along the path,
  /// as often as its room asks for, back to where it began.
  void sink(const Along& along, double place, double z) {
    if (!(rules_.fall > 0.0) || tabs_.empty() || !(z < z_)) return down(z);
    const double length = (z_ - z) / rules_.fall, whole = along.length();
    const double room = room_behind(place, whole);
    const double ways = std::ceil(0.5 * length / room);
    if (!(ways <= kMostWays)) {
      out_.straight_down.push_back({track_, along.at(place)});
      return down(z);
    }
    const std::vector<Piece> forth = along.between(place, place + 0.5 * length / ways);
    std::vector<Piece> back;
    for (auto piece = forth.rbegin(); piece != forth.rend(); ++piece) {
      back.push_back(reversed(*piece));
    }
    const double from = z_;
    for (int k = 1; k <= static_cast<int>(ways); ++k) {
      follow(forth, from + (z - from) * ((k - 0.5) / ways));
      follow(back, from + (z - from) * (k / ways));
    }
  }

  /// Along the path between two lengths of it; the height changes evenly, but stays above tabs.
  void walk(const Along& along, double from, double to, double z_from, double z_to) {
    const double whole = along.length(), tab_z = -rules_.depth + rules_.tabs.height;
    const auto height = [&](double s) {
      return z_from + (z_to - z_from) * (s - from) / (to - from);
    };
    std::vector<double> cuts{from, to};
    std::vector<Tab> in_the_way;  // in lengths of the walk; what passes above a tab stays whole
    for (const Tab& tab : tabs_) {
      for (double turn = std::floor(from / whole) * whole; turn < to; turn += whole) {
        const double begin = std::max(turn + tab.from, from), end = std::min(turn + tab.to, to);
        if (!(begin < end) || !(std::min(height(begin), height(end)) < tab_z)) continue;
        in_the_way.push_back({begin, end});
        for (const double edge : {begin, end}) {
          if (edge > from && edge < to) cuts.push_back(edge);
        }
      }
    }
    std::sort(cuts.begin(), cuts.end());
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const double a = cuts[k], b = cuts[k + 1];
      if (!(b - a > kNothing * whole)) continue;
      const double middle = 0.5 * (a + b);
      const bool over = std::any_of(in_the_way.begin(), in_the_way.end(), [&](const Tab& tab) {
        return middle > tab.from && middle < tab.to;
      });
      const auto kept = [&](double z) { return over ? std::max(z, tab_z) : z; };
      sink(along, a, kept(height(a)));
      over_tab_ = over && z_from == z_to && z_to == -rules_.depth;
      const std::vector<Piece> pieces = along.between(a, b);
      double done = a;
      for (std::size_t i = 0; i < pieces.size(); ++i) {
        done += length_of(pieces[i]);
        const bool last = i + 1 == pieces.size();
        cut(pieces[i], kept(last && b == to ? z_to : height(last ? b : std::min(done, b))));
      }
      over_tab_ = false;
    }
  }

  const std::vector<Track>& tracks_;
  const BlockRules& rules_;
  const Leads& leads_;
  CutBlocks out_;
  std::size_t track_ = 0;
  double z_ = 0.0, z_ramp_ = 0.0;
  bool first_pass_ = false, over_tab_ = false;
  std::vector<Tab> tabs_;
};

}  // namespace

double feed_for(double kappa, const BlockRules& rules) {
  if (!(rules.across > 0.0) || kappa == 0.0) return rules.feed;
  return std::min(rules.feed,
                  exchange::kSecondsOfMinute * std::sqrt(rules.across / std::abs(kappa)));
}

double levels_of(const BlockRules& rules) {
  constexpr double kWhole = 1e-9;  // of a pass: 6 by 2 are 3 passes, not 3.0000000001
  return std::max(1.0, std::ceil(rules.depth / rules.pass_depth - kWhole));
}

CutBlocks blocks_of(const std::vector<Track>& tracks, const std::vector<Visit>& visits,
                    const BlockRules& rules, const Leads& leads) {
  return Blocks(tracks, rules, leads).run(visits);
}

}  // namespace obvid::cutting
