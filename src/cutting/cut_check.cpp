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
/// Places that are looked at: of the tool, or of a path that is followed, how far apart.
constexpr double kApart = 0.1, kApartAlong = 0.01;

double distance_from_chord(Vec2 a, Vec2 b, Vec2 p) {
  return distance_from(Piece{LinePiece{a, b}}, p);
}

class Check {
 public:
  Check(const std::vector<Track>& tracks, const BlockRules& rules, Watch& watch)
      : tracks_(tracks), rules_(rules), watch_(watch), ways_(tracks.size()) {}

  Result<Checked> run(const exchange::NcProgram& program, const std::vector<std::size_t>& motions) {
    if (program.motions.size() != motions.size()) {
      return error(ErrorCode::kInternal, "the printed program has other motions than were planned")
          .hint("please report this");
    }
    for (std::size_t i = 0; i < motions.size(); ++i) {
      if (!program.motions[i].rapid) add(program.motions[i], motions[i]);
    }
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      if (watch_.cancelled()) return fail(cancelled_error());
      tracks_[i].side == CutSide::kOn ? followed(i) : compensated(i);
    }
    return out_;
  }

 private:
  void add(const exchange::NcMotion& motion, std::size_t track) {
    const bool mill = rules_.process == CutProcess::kMill;
    for (std::size_t k = 0; k + 1 < motion.points.size(); ++k) {
      const Vec3 a = motion.points[k], b = motion.points[k + 1];
      if (mill && !(std::min(a.z, b.z) < 0.0)) continue;
      ways_[track].emplace_back(Vec2{a.x, a.y}, Vec2{b.x, b.y});
    }
  }

  template <class Look>
  static void places(Vec2 a, Vec2 b, double apart, const Look& look) {
    const int parts = std::max(1, static_cast<int>(std::ceil(norm(b - a) / apart)));
    for (int k = 0; k <= parts; ++k) {
      look(a + (static_cast<double>(k) / parts) * (b - a));
    }
  }

  [[nodiscard]] double nearest_way(std::size_t track, Vec2 p) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [a, b] : ways_[track]) {
      if (norm(p - a) - norm(b - a) < nearest)
        nearest = std::min(nearest, distance_from_chord(a, b, p));
    }
    return nearest;
  }

  void compensated(std::size_t i) {
    const double radius = 0.5 * rules_.tool_diameter, apart = kApart * rules_.tool_diameter;
    for (const auto& [a, b] : ways_[i]) {
      places(a, b, apart, [&](Vec2 p) {
        out_.beyond = std::max(out_.beyond, radius - distance_from_edges(tracks_, p));
      });
    }
    const Track& track = tracks_[i];
    const auto in_corner = [&](Vec2 p) {
      return std::any_of(track.corners.begin(), track.corners.end(), [&](const auto& corner) {
        return norm(p - corner.at) <= corner.reach + apart;
      });
    };
    edge_places(track, apart, [&](Vec2 p) {
      if (!in_corner(p)) out_.short_of = std::max(out_.short_of, nearest_way(i, p) - radius);
    });
  }

  void followed(std::size_t i) {
    const Track& track = tracks_[i];
    const double apart = kApartAlong * length_of(track.edge);
    for (const auto& [a, b] : ways_[i]) {
      places(a, b, apart, [&](Vec2 p) {
        double away = std::numeric_limits<double>::infinity();
        for (const Piece& piece : track.edge.pieces) away = std::min(away, distance_from(piece, p));
        out_.beyond = std::max(out_.beyond, away);
      });
    }
    edge_places(track, apart,
                [&](Vec2 p) { out_.short_of = std::max(out_.short_of, nearest_way(i, p)); });
  }

  template <class Look>
  static void edge_places(const Track& track, double apart, const Look& look) {
    for (const Piece& piece : track.edge.pieces) {
      const int parts = std::max(2, static_cast<int>(std::ceil(length_of(piece) / apart)));
      for (int k = 0; k <= parts; ++k) look(evaluate(piece, static_cast<double>(k) / parts).point);
    }
  }

  const std::vector<Track>& tracks_;
  const BlockRules& rules_;
  Watch& watch_;
  std::vector<std::vector<std::pair<Vec2, Vec2>>> ways_;
  Checked out_;
};

}  // namespace

Result<Checked> checked(std::string_view text, const std::vector<Track>& tracks,
                        const std::vector<std::size_t>& motions, const BlockRules& rules,
                        double tolerance, Watch& watch) {
  const bool mill = rules.process == CutProcess::kMill;
  const auto program = exchange::read_program(text, kChordDepth * tolerance,
                                              mill ? std::nullopt : std::optional<double>(0.0));
  OBVID_TRY(program);
  return Check(tracks, rules, watch).run(*program, motions);
}

}  // namespace obvid::cutting
