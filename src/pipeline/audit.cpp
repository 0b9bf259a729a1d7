// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/audit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "obvid/certify/certify.h"
#include "obvid/region/refine.h"
#include "report.h"

namespace obvid {
namespace {

constexpr double kLargestGap = 1e-9;   // of the size
constexpr double kLargestTurn = 1e-6;  // rad
constexpr double kLargestJump = 1e-6;  // of the larger curvature
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

double size_of_pieces(const std::vector<Piece>& pieces) {
  std::vector<Vec2> points;
  for (const Piece& piece : pieces) {
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) points.push_back(evaluate(piece, t).point);
  }
  return pipeline_detail::size_of(points);
}

class Auditor {
 public:
  Auditor(const DrawnCurve& curve, const Units& units) {
    out_.label = curve.label;
    out_.contour.units = units;
    out_.contour.carrier = Carrier::kBaseline;
    out_.contour.closed = curve.closed;
    out_.contour.pieces = curve.pieces;
    for (Piece& piece : out_.contour.pieces) straighten(piece);
    size_ = size_of_pieces(out_.contour.pieces);
  }

  CurveAudit run() {
    if (out_.contour.pieces.empty()) return std::move(out_);
    take_samples();
    lay_joints();
    lay_runs();
    out_.certificate = certify(out_.contour);
    out_.vertices = out_.certificate.vertices;
    out_.inflections = out_.certificate.inflections;
    out_.counted =
        !unbounded_ &&
        std::none_of(out_.certificate.pieces.begin(), out_.certificate.pieces.end(),
                     [](const PieceProof& piece) { return piece.verdict == Verdict::kUndecided; });
    place_vertices();
    place_inflections();
    out_.visible_vertices = swings(kVisible * (out_.largest_kappa - out_.least_kappa));
    std::stable_sort(out_.places.begin(), out_.places.end(),
                     [](const AuditPlace& a, const AuditPlace& b) { return a.s < b.s; });
    return std::move(out_);
  }

 private:
  /// Curvature that rounding alone explains is none: left in, its signs would be counted.
  void straighten(Piece& piece) {
    const double flat = flat_curvature(piece);
    if (auto* c = std::get_if<ClothoidPiece>(&piece)) {
      for (double* kappa : {&c->kappa0, &c->kappa1}) {
        if (*kappa == 0.0 || std::abs(*kappa) > flat) continue;
        *kappa = 0.0;
        note_flat(flat);
      }
      if (c->kappa0 == 0.0 && c->kappa1 == 0.0) piece = LinePiece{c->start, c->end};
      return;
    }
    if (std::holds_alternative<LinePiece>(piece) || !is_flat(piece, flat)) return;
    piece = LinePiece{start_point(piece), end_point(piece)};
    note_flat(flat);
  }

  void note_flat(double flat) {
    ++out_.straightened;
    out_.flat_curvature = std::max(out_.flat_curvature, flat);
  }

  /// An arc, or a curve of the chord's length, that nowhere is more curved than that.
  static bool is_flat(const Piece& piece, double flat) {
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

  void take_samples() {
    const std::vector<Piece>& pieces = out_.contour.pieces;
    out_.least_kappa = HUGE_VAL;
    out_.largest_kappa = -HUGE_VAL;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      starts_.push_back(out_.length);
      Vec2 before = start_point(pieces[i]);
      for (int k = 0; k <= kPieceSamples; ++k) {
        const double t = static_cast<double>(k) / kPieceSamples;
        const Element e = element_at(pieces[i], t);
        out_.length += norm(e.point - before);
        before = e.point;
        samples_.push_back({i, t, out_.length, e.kappa});
        out_.least_kappa = std::min(out_.least_kappa, e.kappa);
        out_.largest_kappa = std::max(out_.largest_kappa, e.kappa);
      }
    }
    rounding_ =
        kRippleRounding * std::max(std::abs(out_.least_kappa), std::abs(out_.largest_kappa));
  }

  [[nodiscard]] Element end_of(std::size_t piece, double t) const {
    return element_at(out_.contour.pieces[piece], t);
  }

  void lay_joints() {
    const std::size_t n = out_.contour.pieces.size();
    const bool closed = out_.contour.closed;
    double theta = 0.0;
    for (std::size_t j = 0; j < (closed ? n : n + 1); ++j) {
      const bool first = j == 0 && !closed, last = j == n;
      const Element before = first ? end_of(0, 0.0) : end_of((j + n - 1) % n, 1.0);
      const Element after = last ? before : end_of(j, 0.0);
      Joint joint{before, std::nullopt, {}};
      joint.element.theta = theta + std::remainder(before.theta - theta, 2.0 * std::numbers::pi);
      theta = joint.element.theta;
      const bool bounded = std::isfinite(before.kappa) && std::isfinite(after.kappa);
      unbounded_ = unbounded_ || !bounded;
      // no more is known there than that the pieces meet: they have no tangent of their own either
      if (!bounded) out_.continuity = std::min(out_.continuity, 0);
      if (!first && !last && compare(j, before, after)) joint.leaving = after;
      joint.source = j;  // a drawn curve passes the ends of its pieces
      out_.contour.points.push_back(before.point);
      out_.contour.joints.push_back(joint);
    }
  }

  /// Notes what is not continuous at a joint; true at a corner and where the curvature jumps.
  bool compare(std::size_t j, const Element& before, const Element& after) {
    const double gap = norm(after.point - before.point);
    const double turn =
        std::abs(std::remainder(after.theta - before.theta, 2.0 * std::numbers::pi));
    const double jump = std::abs(after.kappa - before.kappa);
    const double larger = std::max(std::abs(after.kappa), std::abs(before.kappa));
    AuditPlace place{AuditPlace::Kind::kGap, starts_[j],  before.point,
                     before.kappa,           after.kappa, gap};
    if (gap > kLargestGap * size_) add(place, -1);
    place.kind = AuditPlace::Kind::kCorner;
    place.size = turn;
    const bool corner = turn > kLargestTurn;
    if (corner) add(place, 0);
    place.kind = AuditPlace::Kind::kCurvatureJump;
    place.size = 0.0;
    const bool jumps = !corner && jump > std::max(kLargestJump * larger, rounding_);
    if (jumps) add(place, 1);
    return corner || jumps;
  }

  void add(const AuditPlace& place, int continuity) {
    out_.places.push_back(place);
    out_.continuity = std::min(out_.continuity, continuity);
  }

  void lay_runs() {
    for (std::size_t i = 0; i < out_.contour.pieces.size(); ++i) {
      const Verdict verdict = prove_piece(out_.contour.pieces[i]).verdict;
      const int direction = verdict == Verdict::kIncreasing   ? 1
                            : verdict == Verdict::kDecreasing ? -1
                                                              : 0;
      std::vector<Run>& runs = out_.contour.runs;
      const bool goes_on = !out_.contour.joints[i].leaving;
      if (!runs.empty() && goes_on && runs.back().direction == direction) {
        runs.back().last_piece = i;
      } else {
        runs.push_back({i, i, direction});
      }
    }
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
    }
  }

  /// Extrema of the sampled curvature that stand out of the rounding.
  void place_vertices() {
    find_proved(out_.vertices, [this](double least) {
      extrema(least, [this](const Sample& at) {
        const Sample there = refined(at);
        out_.least_kappa = std::min(out_.least_kappa, there.kappa);
        out_.largest_kappa = std::max(out_.largest_kappa, there.kappa);
        place(AuditPlace::Kind::kVertex, there);
      });
    });
  }

  [[nodiscard]] int swings(double least) {
    int count = 0;
    extrema(std::max(least, rounding_), [&](const Sample&) { ++count; });
    return count;
  }

  /// Calls `found` for each extremum that the curvature leaves by more than `least` on both sides,
  /// around the seam of a closed curve too.
  template <class Found>
  void extrema(double least, Found found) {
    Sample low = samples_.front(), high = low;
    Sample first = low;  // the extremum that the first swing leaves
    int direction = 0, first_direction = 0;
    for (const Sample& now : samples_) {
      if (now.kappa < low.kappa) low = now;
      if (now.kappa > high.kappa) high = now;
      const bool falls = direction >= 0 && now.kappa < high.kappa - least;
      if (!falls && !(direction <= 0 && now.kappa > low.kappa + least)) continue;
      const Sample& left = falls ? high : low;
      if (direction != 0) found(left);
      if (direction == 0) first = left;
      direction = falls ? -1 : 1;
      if (first_direction == 0) first_direction = direction;
      (falls ? low : high) = now;
    }
    if (!out_.contour.closed || direction == first_direction) return;
    found(direction > 0 ? (high.kappa > first.kappa ? high : first)
                        : (low.kappa < first.kappa ? low : first));
  }

  /// The extremum nearest to a sample inside its piece, where the rate of curvature is 0.
  [[nodiscard]] Sample refined(Sample at) const {
    const Piece& piece = out_.contour.pieces[at.piece];
    const auto rate = [&](double t) { return curvature_rate(evaluate(piece, t)); };
    double low = std::max(0.0, at.t - 1.0 / kPieceSamples),
           high = std::min(1.0, at.t + 1.0 / kPieceSamples);
    const bool rises = rate(low) > 0.0;
    if (rises == (rate(high) > 0.0)) return at;
    constexpr int kHalvings = 50;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (low + high);
      ((rate(middle) > 0.0) == rises ? low : high) = middle;
    }
    at.kappa = curvature(evaluate(piece, low));
    at.s += norm(evaluate(piece, low).point - evaluate(piece, at.t).point) * (low < at.t ? -1 : 1);
    at.t = low;
    return at;
  }

  void place_inflections() {
    find_proved(out_.inflections, [this](double least) { sign_changes(least); });
  }

  void sign_changes(double least) {
    const Sample *last = nullptr, *first = nullptr;
    for (const Sample& now : samples_) {
      if (std::abs(now.kappa) <= least) continue;
      if (first == nullptr) first = &now;
      if (last != nullptr && last->kappa * now.kappa < 0.0) {
        const double part = last->kappa / (last->kappa - now.kappa);
        Sample at = now;
        if (last->piece == now.piece) at.t = last->t + part * (now.t - last->t);
        at.s = last->s + part * (now.s - last->s);
        at.kappa = 0.0;
        place(AuditPlace::Kind::kInflection, at);
      }
      last = &now;
    }
    if (!out_.contour.closed || last == nullptr || !(last->kappa * first->kappa < 0.0)) return;
    Sample seam = samples_.front();
    seam.kappa = 0.0;
    place(AuditPlace::Kind::kInflection, seam);
  }

  CurveAudit out_;
  double size_ = 0.0, rounding_ = 0.0;
  bool unbounded_ = false;      // some end of a piece has no curvature
  std::vector<double> starts_;  // arc length at the start of each piece
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
  return Auditor(curve, units).run();
}

}  // namespace obvid
