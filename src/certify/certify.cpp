// SPDX-License-Identifier: Apache-2.0
#include "obvid/certify/certify.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "joints.h"
#include "known_pieces.h"
#include "obvid/certify/internal/crossings.h"
#include "obvid/certify/internal/limits.h"
#include "obvid/numeric/internal/strict_arithmetic.h"
#include "piece_facts.h"
#include "point_places.h"

namespace obvid {
namespace {

const char* word(int direction) {
  return direction > 0 ? "increasing" : (direction < 0 ? "decreasing" : "constant");
}

/// Counts changes of direction along a sequence of signs; zeros are passed over.
class DirectionChanges {
 public:
  void add(int sign) {
    if (sign == 0) return;
    if (last_ != 0 && sign != last_) ++count_;
    if (first_ == 0) first_ = sign;
    last_ = sign;
  }
  /// Along a closed contour the end meets the start.
  void close() { add(first_); }
  [[nodiscard]] int count() const { return count_; }

 private:
  int first_ = 0;
  int last_ = 0;
  int count_ = 0;
};

/// Collects the claims of a contour one after the other; the first that fails is the reason.
class Certifier {
 public:
  Certifier(const Contour& contour, Watch& watch, PieceMemory::Pieces* known = nullptr)
      : contour_(contour), watch_(watch), known_(known) {}

  Certificate run() {
    if (std::string reason = unfit(); !reason.empty()) {
      certificate_.pieces.resize(contour_.pieces.size());  // undecided, all of them
      certificate_.reason = std::move(reason);
      return std::move(certificate_);
    }
    if (known_ != nullptr) known_->learn(contour_, watch_);
    if (watch_.was_cancelled()) return {};
    examine_pieces();
    if (watch_.was_cancelled()) return {};
    joints_ = survey_joints(contour_, bends_, known_ != nullptr ? &known_->list : nullptr);
    if (watch_.cancelled()) return {};
    check_joints();
    check_points();
    if (watch_.cancelled()) return {};
    check_runs();
    count_singular_points();
    certificate_.inside_region = monotone_ && forward_ && joints_.within_bounds;
    certificate_.proved = monotone_ && forward_ && certificate_.gaps_within_bounds &&
                          certificate_.through_points && certificate_.inside_region;
    certificate_.self_intersections = self_intersections();
    if (certificate_.reason.empty()) certificate_.reason = std::move(inside_);
    return std::move(certificate_);
  }

 private:
  [[nodiscard]] int self_intersections() const {
    std::vector<std::size_t> turning;
    for (std::size_t i = 0; i < certificate_.pieces.size(); ++i) {
      const Verdict verdict = certificate_.pieces[i].verdict;
      if (verdict == Verdict::kHasVertex || verdict == Verdict::kUndecided) turning.push_back(i);
    }
    if (turning.empty() && contour_.runs.size() < 2) return 0;
    return count_crossings(contour_, turning);
  }

  /// Why nothing can be proved of this contour here and now.
  [[nodiscard]] std::string unfit() const {
    if (const char* fault = fault_of_arithmetic()) {
      return std::string("no proof is possible: ") + fault;
    }
    if (contour_.pieces.empty()) return "the contour has no pieces";
    const auto number = out_of_range(contour_);
    if (!number) {
      const auto joint = joint_without_curvature(contour_);
      return joint ? fmt::format("element {} has no curvature", *joint + 1) : "";
    }
    return number->list.empty()
               ? number->what
               : fmt::format("{} ({} {})", number->what, number->list, number->index);
  }

  void fail(std::string reason) {
    if (certificate_.reason.empty()) certificate_.reason = std::move(reason);
  }

  /// What happens inside pieces: of carriers that promise nothing there it comes after the rest.
  void fail_inside(std::string reason) {
    if (promises_monotone(contour_.carrier)) return fail(std::move(reason));
    if (inside_.empty()) inside_ = std::move(reason);
  }

  void fail_monotone(std::string reason) {
    monotone_ = false;
    fail_inside(std::move(reason));
  }

  void examine_pieces() {
    const std::size_t n = contour_.pieces.size();
    certificate_.pieces.reserve(n);
    for (std::size_t i = 0; i < n && !watch_.cancelled(); ++i) {
      const PieceFacts facts =
          known_ != nullptr ? known_->list[i].facts : examine_piece(contour_.pieces[i]);
      certificate_.pieces.push_back(facts.proof);
      certificate_.pieces.back().turns_below_half = facts.turns_below_pi;
      before_.push_back(static_cast<std::int8_t>(facts.first_change));
      after_.push_back(static_cast<std::int8_t>(facts.last_change));
      report_verdict(i, facts.proof);
      if (facts.proof.verdict == Verdict::kHasVertex) follow_inside(i);
      if (!facts.turns_below_pi) {
        forward_ = false;
        fail_inside(fmt::format("piece {} is not proved to turn by less than half a turn", i + 1));
      }
    }
  }

  /// The proof of one vertex does not say how many there are.
  void follow_inside(std::size_t i) {
    const auto* bezier = std::get_if<RationalBezier>(&contour_.pieces[i]);
    if (bezier == nullptr) return;
    bends_.emplace(i, curvature_signs(*bezier));
    changes_.emplace(i, curvature_changes(*bezier));
  }

  static std::string place_of(const PieceProof& proof) {
    const std::string from = fmt::format("{:.6g}", proof.t0), to = fmt::format("{:.6g}", proof.t1);
    return from == to ? "at t = " + from : fmt::format("between t = {} and {}", from, to);
  }

  void report_verdict(std::size_t i, const PieceProof& proof) {
    const bool vertex = proof.verdict == Verdict::kHasVertex;
    if (!vertex && proof.verdict != Verdict::kUndecided) return;
    fail_monotone(vertex ? fmt::format("piece {} has a vertex {}", i + 1, place_of(proof))
                         : fmt::format("the curvature of piece {} could not be decided", i + 1));
  }

  void check_joints() {
    const std::size_t n = contour_.pieces.size();
    const std::size_t expected = contour_.closed ? n : n + 1;
    certificate_.gaps = joints_.gaps;
    certificate_.inflections = joints_.inflections;
    certificate_.joints = joints_.joints;
    certificate_.corners = joints_.corners;
    certificate_.curvature_steps = joints_.curvature_steps;
    certificate_.slope_steps = joints_.slope_steps;
    certificate_.loose_slopes = joints_.loose_slopes;
    certificate_.gaps_within_bounds = joints_.within_bounds;
    certificate_.loose_joint = joints_.loose_joint;
    if (contour_.joints.size() != expected) {
      certificate_.gaps_within_bounds = joints_.within_bounds = joints_.meeting = false;
      fail(fmt::format("{} pieces need {} joints, not {}", n, expected, contour_.joints.size()));
    }
    if (!joints_.within_bounds) fail(joints_.reason);
  }

  /// Points with tolerances: the contour passes each of them near enough, one after the other.
  [[nodiscard]] std::string too_far() {
    if (contour_.point_tolerance.empty()) return {};
    if (contour_.point_tolerance.size() != contour_.points.size()) {
      return "there is not one tolerance for every point";
    }
    const std::vector<Nearest> places = nearest_places(contour_, watch_);
    std::string reason;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double distance = places[i].distance;
      certificate_.largest_move = std::max(certificate_.largest_move, distance);
      if (distance <= allowed_distance(contour_, i) || !reason.empty()) continue;
      reason = fmt::format("the contour passes point {} at {:.9g}, its tolerance is {:.9g}", i + 1,
                           distance, contour_.point_tolerance[i]);
    }
    if (!reason.empty()) return reason;
    const std::vector<std::size_t> disorder = out_of_order(contour_, places);
    if (disorder.empty()) return {};
    return fmt::format("the contour does not pass point {} after the points before it",
                       disorder.front() + 1);
  }

  void check_points() {
    std::string missed = missed_point(contour_);
    if (std::string far = too_far(); missed.empty()) missed = std::move(far);
    certificate_.through_points = missed.empty() && joints_.meeting;
    if (!missed.empty()) fail(missed);
  }

  void check_runs() {
    std::size_t next = 0;
    for (std::size_t r = 0; r < contour_.runs.size(); ++r) {
      const Run& run = contour_.runs[r];
      if (run.first_piece != next || run.last_piece < run.first_piece ||
          run.last_piece >= contour_.pieces.size()) {
        return fail_monotone(fmt::format("run {} does not continue the run before it", r + 1));
      }
      for (std::size_t i = run.first_piece; i <= run.last_piece; ++i) check_piece_in_run(r, i);
      check_jump_before_run(r);
      next = run.last_piece + 1;
    }
    if (next != contour_.pieces.size()) {
      fail_monotone(fmt::format("no run covers piece {}", next + 1));
    }
  }

  [[nodiscard]] bool is_parted(std::size_t joint) const {
    return joint < contour_.joints.size() && contour_.joints[joint].leaving.has_value();
  }

  void check_piece_in_run(std::size_t r, std::size_t i) {
    const Run& run = contour_.runs[r];
    const auto against = [&run](int sign) { return sign != 0 && sign != run.direction; };
    if (against(before_[i]) || against(after_[i])) {
      fail_monotone(fmt::format("run {} claims {} curvature, piece {} is {}", r + 1,
                                word(run.direction), i + 1,
                                to_string(certificate_.pieces[i].verdict)));
    }
    if (i == run.first_piece) return;
    if (is_parted(i)) {
      fail_monotone(fmt::format("run {} continues over the {} at joint {}", r + 1,
                                is_corner(contour_.joints[i]) ? "corner" : "step of the curvature",
                                i + 1));
    }
    if (against(joints_.jump[i])) {
      fail_monotone(
          fmt::format("run {} claims {} curvature, which jumps the other way before piece {}",
                      r + 1, word(run.direction), i + 1));
    }
  }

  /// A jump between two runs (arcs) may belong to either, not to a third direction.
  void check_jump_before_run(std::size_t r) {
    const Run& run = contour_.runs[r];
    if (r == 0 && !contour_.closed) return;
    const Run& before = contour_.runs[r == 0 ? contour_.runs.size() - 1 : r - 1];
    const int jump = joints_.jump[run.first_piece];
    if (!is_parted(run.first_piece) && jump != 0 && jump != run.direction &&
        jump != before.direction) {
      fail_monotone(fmt::format("curvature jumps before piece {} against both its runs",
                                run.first_piece + 1));
    }
  }

  void count_singular_points() {
    DirectionChanges changes;
    for (std::size_t i = 0; i < contour_.pieces.size(); ++i) {
      changes.add(joints_.jump[i]);
      if (const auto found = changes_.find(i); found != changes_.end()) {
        for (const SignFrom& change : found->second) changes.add(change.sign);
        continue;
      }
      changes.add(before_[i]);
      changes.add(after_[i]);
    }
    if (contour_.closed) changes.close();
    certificate_.vertices = changes.count();
  }

  const Contour& contour_;
  Watch& watch_;
  PieceMemory::Pieces* known_;  ///< null: nothing
  Certificate certificate_;
  JointSurvey joints_;
  PieceBends bends_;                                      ///< of pieces with vertices
  std::map<std::size_t, std::vector<SignFrom>> changes_;  ///< of the same
  std::vector<std::int8_t> before_;  ///< sign of d kappa at the start of each piece
  std::vector<std::int8_t> after_;   ///< and at its end; they differ around a vertex
  std::string inside_;               ///< the first reason of fail_inside that is held back
  bool monotone_ = true;
  bool forward_ = true;
};

}  // namespace

Certificate certify(const Contour& contour) {
  Watch nobody;
  return certify(contour, nobody);
}

Certificate certify(const Contour& contour, Watch& watch) {
  return Certifier(contour, watch).run();
}

Certificate certify(const Contour& contour, PieceMemory& memory, Watch& watch) {
  return Certifier(contour, watch, memory.pieces_.get()).run();
}

}  // namespace obvid
