// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/audit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "obvid/certify/certify.h"
#include "obvid/certify/internal/loose_slopes.h"
#include "obvid/core/internal/questions.h"
#include "obvid/core/internal/watch.h"
#include "obvid/curve/internal/contour_path.h"
#include "obvid/curve/internal/curvature_extent.h"
#include "obvid/curve/internal/end_curvatures.h"
#include "obvid/curve/internal/piece_box.h"
#include "obvid/curve/internal/runs.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/numeric/internal/halving.h"
#include "obvid/series/analysis.h"
#include "verify/report.h"

namespace obvid {
namespace {

constexpr double kLargestGap = 1e-9;   // of the size
constexpr double kLargestTurn = 1e-6;  // rad
constexpr double kOneJoint = 1e-9;     // of the length: rows of one joint
constexpr int kPieceSamples = 200;     // of each piece
constexpr double kVisible = 0.01;      // of the range of the curvature
/// Swings below this part of the largest curvature are what rounding leaves on lines and circles.
constexpr double kRippleRounding = 1e-9;

/// Roundings of a double in the coordinates of a piece that computing and printing may have cost.
constexpr double kFlatRoundings = 8.0;

/// Curvature below which a piece of this length cannot be told from a straight one: its height over
/// the chord is what rounding makes of its coordinates, 1/unit.
double flat_curvature(const Piece& piece) {
  double extent = 0.0;
  for (const Vec2 p : {start_point(piece), end_point(piece)}) {
    extent = std::max({extent, std::abs(p.x), std::abs(p.y)});
  }
  const Vec2 chord = end_point(piece) - start_point(piece);
  const double square = dot(chord, chord);
  // height of an arc: kappa length^2 / 8
  return square > 0.0 ? 8.0 * kFlatRoundings * 0x1p-53 * extent / square : 0.0;
}

struct Sample {
  std::size_t piece = 0;
  double t = 0.0;
  double s = 0.0;
  double kappa = 0.0;
};

constexpr std::size_t kItemsBetweenQuestions = 1000;  ///< pieces, joints or samples

class Auditor {
 public:
  Auditor(const DrawnCurve& curve, const Units& units, const RunContext& run) : watch_(run) {
    out_.label = curve.label;
    out_.name = curve.name;
    out_.station = curve.station;
    out_.transitions = curve.transitions;
    out_.arcs_more = curve.arcs_more;
    out_.profile = curve.profile;
    out_.contour.units = units;
    out_.contour.carrier = Carrier::kImported;
    out_.contour.closed = curve.closed;
    out_.contour.pieces = curve.pieces;
    if (!straighten_all()) return;  // whoever asked to stop is told so by `run`
    size_ = about_size(out_.contour.pieces);
  }

  /// What needs joints alone.
  Contour joined() {
    path_.emplace(out_.contour.pieces);
    if (!out_.contour.pieces.empty()) (void)lay_joints();  // nobody can stop it
    return std::move(out_.contour);
  }

  Result<CurveAudit> run() {
    OBVID_TRY(not_ended());
    if (out_.contour.pieces.empty()) return std::move(out_);
    OBVID_TRY(take_samples());
    OBVID_TRY(lay_joints());
    OBVID_TRY(lay_runs());
    out_.certificate = certify(out_.contour, watch_);
    OBVID_TRY(goes_on());
    OBVID_TRY(compare_slopes());
    out_.vertices = out_.certificate.vertices;
    out_.inflections = out_.certificate.inflections;
    out_.counted =
        !unbounded_ &&
        std::none_of(out_.certificate.pieces.begin(), out_.certificate.pieces.end(),
                     [](const PieceProof& piece) { return piece.verdict == Verdict::kUndecided; });
    place_vertices();
    OBVID_TRY(not_ended());
    place_inflections();
    OBVID_TRY(not_ended());
    out_.visible_vertices = swings(kVisible * (out_.largest_kappa - out_.least_kappa));
    OBVID_TRY(not_ended());
    if (unbounded_) out_.least_kappa = out_.largest_kappa = std::nan("");
    std::stable_sort(out_.places.begin(), out_.places.end(),
                     [](const AuditPlace& a, const AuditPlace& b) { return a.s < b.s; });
    keep_one_of_a_joint();
    return std::move(out_);
  }

 private:
  /// What a corner, a jump or a gap makes of the curvature there is told by it alone. The counts
  /// are those of the proof.
  void keep_one_of_a_joint() {
    std::vector<AuditPlace>& all = out_.places;
    const auto of_joint = [](const AuditPlace& one) {
      return one.kind != AuditPlace::Kind::kVertex && one.kind != AuditPlace::Kind::kInflection;
    };
    std::vector<double> joints;
    for (const AuditPlace& one : all) {
      if (of_joint(one)) joints.push_back(one.s);
    }
    if (joints.empty()) return;
    const double whole = path_->length(), room = kOneJoint * whole;
    const auto at_joint = [&](const AuditPlace& one) {
      if (of_joint(one)) return false;
      const auto near = [&](double s) {
        const auto next = std::lower_bound(joints.begin(), joints.end(), s - room);
        return next != joints.end() && *next <= s + room;
      };
      const bool seam = out_.contour.closed;
      return near(one.s) || (seam && (near(one.s - whole) || near(one.s + whole)));
    };
    all.erase(std::remove_if(all.begin(), all.end(), at_joint), all.end());
  }

  /// Curvature at an end of a piece, and whether it is more than rounding.
  struct FlatEnd {
    double kappa = 0.0;
    bool meant = false;
  };

  /// Curvature that rounding alone explains is none: left in, its signs would be counted. What goes
  /// on continuously from a curvature that is more, without falling to a rounding of that, is
  /// meant, however short the piece.
  [[nodiscard]] bool straighten_all() {
    std::vector<Piece>& pieces = out_.contour.pieces;
    std::vector<FlatEnd> ends;  // two of each piece
    for (const Piece& piece : pieces) {
      if (questions_.end()) return false;
      const double flat = flat_curvature(piece);
      for (const double t : {0.0, 1.0}) {
        const double kappa = accurate_curvature(piece, t);
        ends.push_back({kappa, std::abs(kappa) > flat});
      }
    }
    const std::size_t n = ends.size();
    const auto pass_on = [&](std::size_t from, std::size_t to) {
      const FlatEnd &known = ends[from], &next = ends[to];
      if (!known.meant || next.meant) return;
      const bool same_piece = from / 2 == to / 2;
      const double most = std::max(std::abs(known.kappa), std::abs(next.kappa));
      ends[to].meant = same_piece ? std::abs(next.kappa) > kMostCurvatureStep * most
                                  : std::abs(next.kappa - known.kappa) <= kMostCurvatureStep * most;
    };
    for (std::size_t k = 0; k < 2 * n; ++k) {  // twice around: a closed curve has no start
      if (k % n + 1 < n || out_.contour.closed) pass_on(k % n, (k + 1) % n);
    }
    for (std::size_t k = 2 * n; k-- > 0;) {
      if (k % n + 1 < n || out_.contour.closed) pass_on((k + 1) % n, k % n);
    }
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (questions_.end()) return false;
      straighten(pieces[i], ends[2 * i].meant, ends[2 * i + 1].meant);
    }
    return true;
  }

  void straighten(Piece& piece, bool start_meant, bool end_meant) {
    const double flat = flat_curvature(piece);
    if (auto* c = std::get_if<ClothoidPiece>(&piece)) {
      for (const auto& [kappa, meant] :
           {std::pair{&c->kappa0, start_meant}, std::pair{&c->kappa1, end_meant}}) {
        if (*kappa == 0.0 || meant) continue;
        *kappa = 0.0;
        note_flat(flat);
      }
      if (c->kappa0 == 0.0 && c->kappa1 == 0.0) piece = LinePiece{c->start, c->end};
      return;
    }
    if (start_meant || end_meant || std::holds_alternative<LinePiece>(piece)) return;
    if (!is_flat(piece, flat)) return;
    piece = LinePiece{start_point(piece), end_point(piece)};
    note_flat(flat);
  }

  void note_flat(double flat) {
    ++out_.straightened;
    out_.flat_curvature = std::max(out_.flat_curvature, flat);
  }

  /// A curve with a control point on its end is straight when its polygon is, never more beside its
  /// chord than an arc of the curvature that cannot be told from none.
  static bool has_flat_polygon(const RationalBezier& piece, double flat) {
    const auto n = static_cast<std::size_t>(piece.degree);
    const Vec2 chord = piece.offset[n] - piece.offset[0];
    const double length = norm(chord);
    const double height = flat * length * length / 8.0;
    for (std::size_t j = 0; j < n; ++j) {
      if (!(dot(piece.offset[j + 1] - piece.offset[j], chord) >= 0.0)) return false;
      const double beside = cross(piece.offset[j] - piece.offset[0], chord) / length;
      if (!(std::abs(beside) <= height)) return false;
    }
    return true;
  }

  /// An arc, or a curve of the chord's length, that nowhere is more curved than that.
  static bool is_flat(const Piece& piece, double flat) {
    if (is_singular_end(piece, 0.0) || is_singular_end(piece, 1.0)) {
      return has_flat_polygon(std::get<RationalBezier>(piece), flat);
    }
    if (const auto* arc = std::get_if<ArcPiece>(&piece)) {
      const double most = std::abs(arc->kappa * arc->length);
      return std::abs(arc->kappa) <= flat && most < 1.0;
    }
    const Vec2 chord = end_point(piece) - start_point(piece);
    for (int k = 0; k <= kPieceSamples; ++k) {
      const Jet jet = evaluate(piece, static_cast<double>(k) / kPieceSamples);
      if (!(dot(jet.d1, chord) > 0.0) || !(std::abs(curvature(jet)) <= flat)) return false;
    }
    return true;
  }

  /// Asks. Error: E103.
  Result<void> goes_on() {
    if (watch_.cancelled()) return fail(cancelled_error());
    return {};
  }
  /// Whether the answer was to go on, wherever it was asked. Error: E103.
  [[nodiscard]] Result<void> not_ended() const {
    if (watch_.was_cancelled()) return fail(cancelled_error());
    return {};
  }

  Result<void> take_samples() {
    const std::vector<Piece>& pieces = out_.contour.pieces;
    out_.least_kappa = HUGE_VAL;
    out_.largest_kappa = -HUGE_VAL;
    path_.emplace(pieces);
    out_.length = path_->length();
    std::vector<double> many;
    for (int k = 0; k <= kPieceSamples; ++k) many.push_back(static_cast<double>(k) / kPieceSamples);
    const std::vector<double> few{0.0, 0.5, 1.0};  // of lines and arcs: nothing changes along them
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      OBVID_TRY(goes_on());
      const bool constant = std::holds_alternative<LinePiece>(pieces[i]) ||
                            std::holds_alternative<ArcPiece>(pieces[i]);
      const std::vector<double>& at = constant ? few : many;
      for (const double t : at) {
        const double kappa = accurate_curvature(pieces[i], t);
        samples_.push_back({i, t, path_->length_at(i, t), kappa});
        out_.least_kappa = std::min(out_.least_kappa, kappa);
        out_.largest_kappa = std::max(out_.largest_kappa, kappa);
      }
      const double known = std::max(-out_.least_kappa, out_.largest_kappa);
      const CurvatureExtent range = curvature_extent(pieces[i], at, known);
      out_.least_kappa = std::min(out_.least_kappa, range.least);
      out_.largest_kappa = std::max(out_.largest_kappa, range.largest);
    }
    rounding_ =
        kRippleRounding * std::max(std::abs(out_.least_kappa), std::abs(out_.largest_kappa));
    return {};
  }

  [[nodiscard]] Element end_of(std::size_t piece, double t) const {
    Element end = element_at(out_.contour.pieces[piece], t);
    end.kappa = accurate_curvature(out_.contour.pieces[piece], t);
    return end;
  }

  Result<void> lay_joints() {
    const std::size_t n = out_.contour.pieces.size();
    const bool closed = out_.contour.closed;
    double theta = 0.0;
    for (std::size_t j = 0; j < (closed ? n : n + 1); ++j) {
      if (questions_.end()) return fail(cancelled_error());
      const bool first = j == 0 && !closed, last = j == n;
      const Element before = first ? end_of(0, 0.0) : end_of((j + n - 1) % n, 1.0);
      const Element after = last ? before : end_of(j, 0.0);
      Joint joint{before, std::nullopt, {}};
      joint.element.theta = nearest_angle(before.theta, theta);
      theta = joint.element.theta;
      const bool bounded = std::isfinite(before.kappa) && std::isfinite(after.kappa);
      unbounded_ = unbounded_ || !bounded;
      if (!bounded) out_.continuity = std::min(out_.continuity, 1);
      if (!first && !last && compare(j, before, after)) joint.leaving = after;
      joint.source = j;  // a drawn curve passes the ends of its pieces
      out_.contour.points.push_back(before.point);
      out_.contour.joints.push_back(joint);
    }
    return {};
  }

  /// Whether a joint lies between clothoids that stand for one transition.
  [[nodiscard]] bool in_transition(std::size_t j) const {
    return std::any_of(out_.transitions.begin(), out_.transitions.end(), [j](const auto& one) {
      return one.first_piece < j && j < one.first_piece + one.pieces;
    });
  }

  /// Whether the slope of curvature of the element that a piece is of vanishes at its end or start:
  /// that of all transitions does, but for clothoids and cubic parabolas.
  [[nodiscard]] bool slope_vanishes(std::size_t piece, bool at_end) const {
    const Piece& one = out_.contour.pieces[piece];
    if (std::holds_alternative<LinePiece>(one) || std::holds_alternative<ArcPiece>(one))
      return true;
    return std::any_of(out_.transitions.begin(), out_.transitions.end(), [&](const auto& t) {
      return t.kind != Transition::kClothoid && t.kind != Transition::kCubic &&
             piece == (at_end ? t.first_piece + t.pieces - 1 : t.first_piece);
    });
  }

  /// Whether the slope of curvature goes on at a joint, by what the elements are.
  [[nodiscard]] bool slope_goes_on(std::size_t j) const {
    const std::size_t n = out_.contour.pieces.size();
    return in_transition(j) ||
           (slope_vanishes((j + n - 1) % n, true) && slope_vanishes(j % n, false));
  }

  /// Whether slopes of curvature go on; nothing is known of them where nothing can be proved.
  Result<void> compare_slopes() {
    const bool measured = out_.certificate.joints > 0 || out_.contour.pieces.size() == 1;
    if (!measured) {
      out_.continuity = std::min(out_.continuity, 2);
      return {};
    }
    for (const std::size_t j : joints_with_loose_slopes(out_.contour)) {
      if (questions_.end()) return fail(cancelled_error());
      if (!slope_goes_on(j)) out_.continuity = std::min(out_.continuity, 2);
    }
    return {};
  }

  /// Notes what is not continuous at a joint; true at a corner and where the curvature jumps, or is
  /// not defined on a side.
  bool compare(std::size_t j, const Element& before, const Element& after) {
    const double gap = norm(after.point - before.point);
    const double turn = std::abs(turn_between(before.theta, after.theta));
    const double jump = std::abs(after.kappa - before.kappa);
    const double larger = std::max(std::abs(after.kappa), std::abs(before.kappa));
    AuditPlace place{AuditPlace::Kind::kGap, path_->joint(j), before.point,
                     before.kappa,           after.kappa,     gap};
    if (gap > kLargestGap * size_) add(place, -1);
    place.kind = AuditPlace::Kind::kCorner;
    place.size = turn;
    const bool corner = turn > kLargestTurn;
    if (corner) add(place, 0);
    place.kind = AuditPlace::Kind::kCurvatureJump;
    place.size = 0.0;
    const bool jumps = !corner && jump > std::max(kMostCurvatureStep * larger, rounding_);
    if (jumps) add(place, 1);
    return corner || jumps || !std::isfinite(jump);
  }

  void add(const AuditPlace& place, int continuity) {
    out_.places.push_back(place);
    out_.continuity = std::min(out_.continuity, continuity);
  }

  Result<void> lay_runs() {
    const auto direction = pipeline_detail::proved_directions(out_.contour.pieces, watch_);
    OBVID_TRY(direction);
    out_.contour.runs = collect_runs(
        *direction, [this](std::size_t i) { return out_.contour.joints[i].leaving.has_value(); });
    return {};
  }

  void place(AuditPlace::Kind kind, const Sample& at) {
    out_.places.push_back(
        {kind, at.s, evaluate(out_.contour.pieces[at.piece], at.t).point, at.kappa, at.kappa, 0.0});
  }

  /// Calls `find` with larger and larger limits until no more is found than the proof counts: what
  /// there is more are ripples of rounding.
  template <class Find>
  void find_proved(int proved, Find find) {
    constexpr double kCoarser = 10.0;
    const std::size_t before = out_.places.size();
    for (double least = rounding_;; least *= kCoarser) {
      out_.places.erase(out_.places.begin() + static_cast<std::ptrdiff_t>(before),
                        out_.places.end());
      find(least);
      const std::size_t found = out_.places.size() - before;
      if (!out_.counted || found <= static_cast<std::size_t>(proved) || !(least > 0.0)) return;
      if (watch_.was_cancelled()) return;
    }
  }

  /// Extrema of the sampled curvature that stand out of the rounding.
  void place_vertices() {
    find_proved(out_.vertices, [this](double least) {
      extrema(least, [this](const Level& level) {
        const Sample& at = extreme_of(level);
        if (beside_singular_end(at)) return;  // no extremum: it grows without bound
        const Sample there = is_plateau(level) ? middle_of(level) : refined(at);
        out_.least_kappa = std::min(out_.least_kappa, there.kappa);
        out_.largest_kappa = std::max(out_.largest_kappa, there.kappa);
        place(AuditPlace::Kind::kVertex, there);
      });
    });
  }

  [[nodiscard]] int swings(double least) {
    int count = 0;
    extrema(std::max(least, rounding_), [&](const Level&) { ++count; });
    return count;
  }

  /// Neighbouring samples of one curvature but for what is rounding beside the largest of the
  /// curve, the first and the last; counted on past the seam.
  struct Level {
    std::size_t first, last;
    bool high = false;  ///< a maximum
  };

  [[nodiscard]] const Sample& sample(std::size_t i) const { return samples_[i % samples_.size()]; }

  /// Its largest curvature, or its least one; of several the middle.
  [[nodiscard]] const Sample& extreme_of(const Level& level) const {
    std::size_t best = (level.first + level.last) / 2;
    for (std::size_t i = level.first; i <= level.last; ++i) {
      const double beyond = sample(i).kappa - sample(best).kappa;
      if (level.high ? beyond > 0.0 : beyond < 0.0) best = i;
    }
    return sample(best);
  }

  /// Whether the curvature stays as it is there, but for rounding of its own: along a line, an arc,
  /// or for three samples.
  [[nodiscard]] bool is_plateau(const Level& level) const {
    const Sample& most = extreme_of(level);
    const Piece& piece = out_.contour.pieces[most.piece];
    if (std::holds_alternative<LinePiece>(piece) || std::holds_alternative<ArcPiece>(piece)) {
      return true;
    }
    if (level.last <= level.first + 1) return false;
    const double own = std::max(kRippleRounding * std::abs(most.kappa), flat_curvature(piece));
    return std::abs(sample(level.first).kappa - most.kappa) <= own &&
           std::abs(sample(level.last).kappa - most.kappa) <= own;
  }
  /// Half way along it.
  [[nodiscard]] Sample middle_of(const Level& level) const {
    const double length = path_->length(), from = sample(level.first).s;
    double to = sample(level.last).s;
    if (to < from) to += length;  // past the seam
    double middle = 0.5 * (from + to);
    if (middle > length) middle -= length;
    const ContourPath::Parameter found = path_->parameter(middle);
    return {found.piece, found.t, middle,
            accurate_curvature(out_.contour.pieces[found.piece], found.t)};
  }

  /// Calls `found` for each extremum that the curvature leaves by more than `least` on both sides:
  /// with all samples where the curvature stays as it is. A closed curve is followed from its
  /// least curvature around to it.
  template <class Found>
  void extrema(double least, Found found) {
    const bool closed = out_.contour.closed;
    const auto below = [](const Sample& a, const Sample& b) { return a.kappa < b.kappa; };
    const std::size_t from =
        closed ? static_cast<std::size_t>(
                     std::min_element(samples_.begin(), samples_.end(), below) - samples_.begin())
               : 0;
    Level low{from, from}, high{from, from, true};
    std::optional<Level> start;  // what a closed curve comes back to
    int direction = 0;
    for (std::size_t i = from; i < from + samples_.size() + (closed ? 1 : 0); ++i) {
      const double now = sample(i).kappa;
      const auto follow = [&](Level& level, double beyond) {
        if (beyond > rounding_) level = {i, i, level.high};
        if (std::abs(beyond) <= rounding_ && level.last + 1 == i) level.last = i;
      };
      if (questions_.end()) return;
      follow(low, sample(low.first).kappa - now);
      follow(high, now - sample(high.first).kappa);
      const bool falls = direction >= 0 && now < sample(high.first).kappa - least;
      if (!falls && !(direction <= 0 && now > sample(low.first).kappa + least)) continue;
      const Level& left = falls ? high : low;
      if (direction != 0) found(left);
      if (direction == 0) start = left;
      direction = falls ? -1 : 1;
      (falls ? low : high) = {i, i, !falls};
    }
    if (closed && start) found(*start);
  }

  [[nodiscard]] bool beside_singular_end(const Sample& at) const {
    const Piece& piece = out_.contour.pieces[at.piece];
    constexpr double kStep = 1.0 / kPieceSamples;
    return (at.t <= kStep && is_singular_end(piece, 0.0)) ||
           (at.t >= 1.0 - kStep && is_singular_end(piece, 1.0));
  }

  static constexpr int kHalvings = 50;  // to rounding: a piece has parameters of about 1

  /// The extremum nearest to a sample inside its piece, where the rate of curvature is 0.
  [[nodiscard]] Sample refined(Sample at) const {
    const Piece& piece = out_.contour.pieces[at.piece];
    const auto rate = [&](double t) { return curvature_rate(evaluate(piece, t)); };
    const double low = std::max(0.0, at.t - 1.0 / kPieceSamples),
                 high = std::min(1.0, at.t + 1.0 / kPieceSamples);
    const bool rises = rate(low) > 0.0;
    if (rises == (rate(high) > 0.0)) return at;
    const auto before = [&](double t) { return (rate(t) > 0.0) == rises; };
    at.t = end_of_condition(low, high, before, kHalvings).holds;
    at.kappa = curvature(evaluate(piece, at.t));
    at.s = path_->length_at(at.piece, at.t);
    return at;
  }

  void place_inflections() {
    find_proved(out_.inflections, [this](double least) { sign_changes(least); });
  }

  void sign_changes(double least) {
    std::optional<std::size_t> last;
    std::size_t first = 0;
    for (std::size_t k = 0; k < samples_.size(); ++k) {
      if (questions_.end()) return;
      if (std::abs(samples_[k].kappa) <= least) continue;
      if (!last) first = k;
      if (last && samples_[*last].kappa * samples_[k].kappa < 0.0) place_inflection(*last, k);
      last = k;
    }
    if (!out_.contour.closed || !last) return;
    if (samples_[*last].kappa * samples_[first].kappa < 0.0) {
      place_inflection(*last, first + samples_.size());  // past the seam
    }
  }

  /// Curvature has one sign up to a sample and the other one from a later one on: where it is
  /// straight in between, the middle of that, else the place where the sign changes.
  void place_inflection(std::size_t from, std::size_t to) {
    const double sign = sample(from).kappa > 0.0 ? 1.0 : -1.0;
    while (from + 1 < to && sign * sample(from + 1).kappa > 0.0) ++from;
    while (to > from + 1 && sign * sample(to - 1).kappa < 0.0) --to;
    const double end = where_it_turns(from, [&](double kappa) { return sign * kappa > 0.0; });
    const double begin = where_it_turns(to - 1, [&](double kappa) { return sign * kappa >= 0.0; });
    const double length = path_->length();
    double middle = 0.5 * (end + begin);
    if (middle > length) middle -= length;
    const ContourPath::Parameter found = path_->parameter(middle);
    place(AuditPlace::Kind::kInflection, {found.piece, found.t, middle, 0.0});
  }

  /// Length at which what holds at a sample and not at the next one ends.
  template <class Holds>
  [[nodiscard]] double where_it_turns(std::size_t k, const Holds& holds) const {
    const Sample &one = sample(k), &next = sample(k + 1);
    const double before = k >= samples_.size() ? path_->length() : 0.0;
    if (k + 1 == samples_.size()) return path_->length();
    if (one.piece != next.piece) return before + next.s;
    const Piece& piece = out_.contour.pieces[one.piece];
    const auto still_holds = [&](double t) { return holds(curvature(evaluate(piece, t))); };
    return before + path_->length_at(one.piece,
                                     end_of_condition(one.t, next.t, still_holds, kHalvings).fails);
  }

  Watch watch_;
  Questions questions_{&watch_, kItemsBetweenQuestions};
  CurveAudit out_;
  double size_ = 0.0, rounding_ = 0.0;
  bool unbounded_ = false;  // some end of a piece has no curvature
  std::optional<ContourPath> path_;
  std::vector<Sample> samples_;
};

}  // namespace

const char* to_string(AuditPlace::Kind kind) {
  constexpr const char* names[] = {"vertex", "inflection", "curvature jump", "corner", "gap"};
  return names[static_cast<int>(kind)];
}

std::string as_drawn(const CurveAudit& a) {
  const auto counted = [](int count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
  };
  int corners = 0, jumps = 0, gaps = 0;
  for (const AuditPlace& place : a.places) {
    corners += place.kind == AuditPlace::Kind::kCorner ? 1 : 0;
    jumps += place.kind == AuditPlace::Kind::kCurvatureJump ? 1 : 0;
    gaps += place.kind == AuditPlace::Kind::kGap ? 1 : 0;
  }
  std::string text = "as drawn: ";
  text += a.counted ? counted(a.vertices, "vertex", "vertices") + ", " +
                          counted(a.inflections, "inflection", "inflections")
                    : "vertices not counted, the curvature has no bound";
  if (corners > 0) text += ", " + counted(corners, "corner", "corners");
  if (jumps > 0) text += ", " + counted(jumps, "jump", "jumps") + " of the curvature";
  if (gaps > 0) text += ", " + counted(gaps, "gap", "gaps");
  return text;
}

CurveAudit audit(const DrawnCurve& curve, const Units& units) {
  return std::move(*Auditor(curve, units, {}).run());  // nobody stops it
}

Result<CurveAudit> audit(const DrawnCurve& curve, const Units& units, const RunContext& run) {
  return Auditor(curve, units, run).run();
}

Contour contour_as_drawn(const DrawnCurve& curve, const Units& units) {
  return Auditor(curve, units, {}).joined();
}

}  // namespace obvid
