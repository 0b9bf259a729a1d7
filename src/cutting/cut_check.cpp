// SPDX-License-Identifier: Apache-2.0
#include "cut_check.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "obvid/exchange/internal/gcode/nc_program.h"

namespace obvid::cutting {
namespace {

/// Depth of chords under arcs, of the tolerance.
constexpr double kChordDepth = 0.02;
constexpr std::size_t kBetweenQuestions = 1024;

Error not_as_planned(const char* what) {
  return error(ErrorCode::kInternal, what).hint("please report this");
}

class Check {
 public:
  Check(const Tracks& tracks, const BlockRules& rules, double spacing, Watch& watch)
      : tracks_(tracks.all),
        edges_(tracks.edges),
        rules_(rules),
        spacing_(spacing),
        watch_(watch) {}

  Result<Checked> run(const exchange::NcProgram& program, const std::vector<std::size_t>& motions) {
    if (program.motions.size() != motions.size()) {
      return fail(not_as_planned("the printed program has other motions than were planned"));
    }
    find_own_edges();
    std::vector<Edges> ways(tracks_.size());
    std::vector<double> lowest(tracks_.size());
    for (std::size_t i = 0; i < motions.size(); ++i) {
      const exchange::NcMotion& motion = program.motions[i];
      if (motion.rapid && is_mill() && !is_in_air(motion)) {
        return fail(not_as_planned("a rapid move runs at or below Z0"));
      }
      if (motion.rapid) continue;
      lowest[motions[i]] = std::min(lowest[motions[i]], lowest_of(motion));
      OBVID_TRY(look(motion, motions[i], ways[motions[i]]));
    }
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      if (is_mill() && !(std::abs(lowest[i] + rules_.depth) <= kPrintedDepth * rules_.depth)) {
        return fail(not_as_planned("an outline is not cut to the depth"));
      }
      ways[i].finish();
      OBVID_TRY(edge_places(i, ways[i]));
    }
    return out_;
  }

 private:
  [[nodiscard]] bool is_mill() const { return rules_.process == CutProcess::kMill; }

  /// What a tool on its outline is held against.
  void find_own_edges() {
    own_.resize(tracks_.size());
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      if (tracks_[i].side != CutSide::kOn) continue;
      own_[i].add(tracks_[i].edge, i);
      own_[i].finish();
    }
  }

  /// Straight up out of a cut, or above the stock.
  [[nodiscard]] static bool is_in_air(const exchange::NcMotion& motion) {
    const Vec3 from = motion.points.front(), to = motion.points.back();
    const bool upright = from.x == to.x && from.y == to.y;
    return to.z > 0.0 && (upright || from.z > 0.0);
  }

  [[nodiscard]] static double lowest_of(const exchange::NcMotion& motion) {
    double low = std::numeric_limits<double>::infinity();
    for (const Vec3 p : motion.points) low = std::min(low, p.z);
    return low;
  }

  [[nodiscard]] bool may_go_on() {
    return ++looked_ % kBetweenQuestions != 0 || !watch_.cancelled();
  }

  /// Places of the tool's axis.
  Result<void> look(const exchange::NcMotion& motion, std::size_t i, Edges& ways) {
    const double radius = 0.5 * rules_.tool_diameter;
    for (std::size_t k = 0; k + 1 < motion.points.size(); ++k) {
      const Vec3 from = motion.points[k], to = motion.points[k + 1];
      if (is_mill() && !(std::min(from.z, to.z) < 0.0)) continue;
      const Vec2 a{from.x, from.y}, b{to.x, to.y};
      if (norm(b - a) > 0.0) ways.add({{LinePiece{a, b}}, false}, i);
      const auto parts = static_cast<std::size_t>(std::max(1.0, std::ceil(norm(b - a) / spacing_)));
      for (std::size_t j = 0; j <= parts; ++j) {
        if (!may_go_on()) return fail(cancelled_error());
        const Vec2 p = a + (static_cast<double>(j) / static_cast<double>(parts)) * (b - a);
        const double off = tracks_[i].side == CutSide::kOn ? own_[i].nearest(p).distance
                                                           : radius - edges_.nearest(p).room;
        out_.beyond = std::max(out_.beyond, off);
      }
    }
    return {};
  }

  /// Places of an outline: how far the tool stays from them.
  Result<void> edge_places(std::size_t i, const Edges& ways) {
    const Track& track = tracks_[i];
    const double radius = track.side == CutSide::kOn ? 0.0 : 0.5 * rules_.tool_diameter;
    const auto in_corner = [&](Vec2 p) {
      return std::any_of(track.corners.begin(), track.corners.end(), [&](const auto& corner) {
        return norm(p - corner.at) <= corner.reach + spacing_;
      });
    };
    for (const Piece& piece : track.edge.pieces) {
      const auto parts =
          static_cast<std::size_t>(std::max(2.0, std::ceil(length_of(piece) / spacing_)));
      for (std::size_t k = 0; k <= parts; ++k) {
        if (!may_go_on()) return fail(cancelled_error());
        const Vec2 p = evaluate(piece, static_cast<double>(k) / static_cast<double>(parts)).point;
        if (in_corner(p)) continue;
        out_.short_of = std::max(out_.short_of, ways.nearest(p).distance - radius);
      }
    }
    return {};
  }

  const std::vector<Track>& tracks_;
  const Edges& edges_;
  const BlockRules& rules_;
  std::vector<Edges> own_;
  double spacing_;
  Watch& watch_;
  std::size_t looked_ = 0;
  Checked out_;
};

}  // namespace

Result<Checked> checked(std::string_view text, const Tracks& tracks,
                        const std::vector<std::size_t>& motions, const BlockRules& rules,
                        double tolerance, double spacing, Watch& watch) {
  const bool mill = rules.process == CutProcess::kMill;
  const auto program = exchange::read_program(text, kChordDepth * tolerance,
                                              mill ? std::nullopt : std::optional<double>(0.0));
  OBVID_TRY(program);
  return Check(tracks, rules, spacing, watch).run(*program, motions);
}

}  // namespace obvid::cutting
