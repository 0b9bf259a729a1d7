// SPDX-License-Identifier: Apache-2.0
#include "points/airfoil_shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "obvid/exchange/internal/points/airfoil.h"
#include "obvid/numeric/internal/golden.h"

namespace obvid {
namespace {

constexpr std::size_t kLooks = 32;       // of a piece, where a largest or a first one is sought
constexpr double kCorner = 1e-6;         // rad: no corner below, as in samples
constexpr std::size_t kMostCorners = 3;  // of a base, and of a kink at the nose
constexpr double kLongestBase = 0.2;     // of the whole length
constexpr double kNoseReach = 0.01;      // chords around the leading edge
constexpr double kNoseWindow = 4.0;  // of it in arc length: a nose that is bent sharply is longer
constexpr double kBeside = 1e-6;     // of a look
constexpr double kSameBend = 1e-3;   // of the largest curvature: what counts as turning back
constexpr double kWidestEdge = 0.5;  // chords: beyond it is no airfoil
/// A round edge: its largest radius, how near its ends are, how far from it the contour may begin,
/// all in chords; and the cosine between the directions of both sides at its ends, at most.
constexpr double kLargestEdge = 0.05, kSameEnd = 1e-4, kBeginsNear = 0.02, kTurnedBack = -0.98;
/// Chords: a side that ends farther before the other one lacks more than its last point.
constexpr double kMostGoneOn = 0.1;

}  // namespace

Result<Airfoil> Airfoil::of(const Contour& contour) {
  if (contour.pieces.empty()) return error(ErrorCode::kNothingThere, "there is no airfoil");
  auto path = ContourPath::without_cusps(contour.pieces);
  OBVID_TRY(path);
  Airfoil out(std::move(*path));
  out.to_ = out.path_.length();
  if (contour.closed && !out.open_at_corner() && !out.open_at_round_edge()) {
    return error(
               ErrorCode::kNothingThere,
               "the closed contour has no trailing edge: one corner, two with a base between, or a "
               "round edge at which it begins")
        .hint("fit the airfoil with --open, or name its corner by --corner-at");
  }
  OBVID_TRY(out.measure_chord());
  return out;
}

ContourPath::Place Airfoil::at(double s) const {
  double along = reversed_ ? to_ - s : from_ + s;
  const double all = path_.length();
  const bool end = s >= length();
  // the last place belongs to the piece that ends there
  bool before = end != reversed_;
  while (along > all || (along == all && !before)) {
    if (along == all && !wraps_) break;
    along -= all;
  }
  if (along <= 0.0 && before && wraps_) along += all;
  ContourPath::Place place = path_.at(std::clamp(along, 0.0, all), before);
  if (reversed_) place.tangent = -1.0 * place.tangent, place.kappa = -place.kappa;
  return place;
}

Vec2 Airfoil::local(Vec2 p) const {
  const Vec2 d = p - leading_;
  return {dot(along_, d), cross(along_, d)};
}

ContourPath::Place Airfoil::on_side(bool upper, double s) const {
  const double own = of_contour(upper);
  if (s <= own) return at(upper ? nose_ - s : nose_ + s);
  ContourPath::Place place = at(upper ? 0.0 : length());
  place.point = place.point + (s - own) * outward(upper);
  place.kappa = 0.0;
  return place;
}

Vec2 Airfoil::end(bool upper) const {
  return at(upper ? 0.0 : length()).point + goes_on(upper) * outward(upper);
}

Result<void> Airfoil::level_ends() {
  constexpr int kSteps = 60;            // each leaves a small part: the chord turns little
  constexpr double kLevelEnds = 1e-15;  // chords
  constexpr double kLeastAlong = 0.5;   // of the straight, along the chord
  const double before = local(end(true)).x - local(end(false)).x;
  const bool upper = before < 0.0;
  double& on = goes_on_[upper ? 0 : 1];
  const char* why = nullptr;
  for (int step = 0; step < kSteps && why == nullptr; ++step) {
    const double gap = local(end(!upper)).x - local(end(upper)).x;
    if (std::abs(gap) <= kLevelEnds * chord_) break;
    const double along = dot(along_, outward(upper));
    on = std::max(0.0, on + gap / along);
    if (!(along > kLeastAlong)) why = "its end does not point along the chord";
    if (on > kMostGoneOn * chord_) why = "that is more than a tenth of the chord";
    if (why == nullptr && !measure_chord()) why = "there would be no chord";
  }
  if (why == nullptr) return {};
  on = 0.0;
  OBVID_TRY(measure_chord());
  return error(ErrorCode::kNothingThere, why);
}

bool Airfoil::runs_along(bool upper) const {
  double before = 0.0;
  const std::size_t n = looks();
  for (std::size_t k = 1; k <= n; ++k) {
    const double x =
        x_on(upper, side_length(upper) * static_cast<double>(k) / static_cast<double>(n));
    if (!(x > before)) return false;
    before = x;
  }
  return true;
}

double Airfoil::place_of(bool upper, double x) const {
  return place_with_x(x, side_length(upper), [&](double s) { return x_on(upper, s); });
}

std::size_t Airfoil::looks() const { return kLooks * path_.pieces().size(); }

/// Corners of the closed contour tell the trailing edge: two that lie near each other have the base
/// between them, else the sharpest one is it (the other may be a kink of the nose). False where
/// they do not tell.
bool Airfoil::open_at_corner() {
  std::vector<double> corners, turns;
  const double all = path_.length();
  for (std::size_t k = 0; k < path_.pieces().size(); ++k) {
    const Vec2 in = path_.at(k == 0 ? all : path_.joint(k), true).tangent;
    const Vec2 out = path_.at(path_.joint(k), false).tangent;
    const double turn = std::abs(turning(in, out));
    if (!(turn > kCorner)) continue;
    corners.push_back(path_.joint(k));
    turns.push_back(turn);
  }
  const std::size_t n = corners.size();
  if (n == 0 || n > kMostCorners) return false;
  wraps_ = true;
  const auto to_next = [&](std::size_t k) {
    const double gap = corners[(k + 1) % n] - corners[k];
    return gap > 0.0 ? gap : gap + all;
  };
  std::size_t base = 0;
  for (std::size_t k = 1; k < n; ++k) {
    if (to_next(k) < to_next(base)) base = k;
  }
  if (n > 1 && to_next(base) < kLongestBase * all) {
    from_ = corners[(base + 1) % n];
    to_ = from_ + all - to_next(base);
    return true;
  }
  if (n > 2) return false;
  const std::size_t edge = n == 2 && turns[1] > turns[0] ? 1 : 0;
  from_ = corners[edge];
  to_ = from_ + all;
  return true;
}

/// Place of the whole path that is farthest from a point.
double Airfoil::farthest_from(Vec2 p) const {
  const std::size_t n = looks();
  const double step = path_.length() / static_cast<double>(n);
  std::size_t where = 0;
  double farthest = -1.0;
  for (std::size_t k = 0; k < n; ++k) {
    const double far = norm(path_.at(static_cast<double>(k) * step, false).point - p);
    if (far > farthest) farthest = far, where = k;
  }
  // beyond the seam the places are those from the other end on
  const auto around = [&](double s) {
    return s < 0.0 ? s + path_.length() : s > path_.length() ? s - path_.length() : s;
  };
  const double middle = static_cast<double>(where) * step;
  return around(sign_change(middle - step, middle + step, [&](double s) {
    const auto place = path_.at(around(s), false);
    return dot(place.point - p, place.tangent);
  }));
}

/// A closed contour without corners that begins at one of the two places farthest apart, bent
/// there as a round trailing edge is.
bool Airfoil::open_at_round_edge() {
  constexpr int kRounds = 20;  // each gains digits: both ends are bent more than the chord is long
  const Vec2 start = path_.at(0.0, false).point;
  double edge = 0.0, chord = 0.0;
  for (int k = 0; k < kRounds; ++k) {
    const Vec2 nose = path_.at(farthest_from(path_.at(edge, false).point), false).point;
    edge = farthest_from(nose);
    chord = norm(path_.at(edge, false).point - nose);
  }
  const auto place = path_.at(edge, false);
  if (norm(place.point - start) > kBeginsNear * chord ||
      !(std::abs(place.kappa) * kLargestEdge * chord >= 1.0)) {
    return false;
  }
  wraps_ = true;
  from_ = edge;
  to_ = edge + path_.length();
  return true;
}

double Airfoil::edge_radius() const {
  const auto first = at(0.0), last = at(length());
  if (norm(first.point - last.point) > kSameEnd * chord_ || goes_on(true) + goes_on(false) > 0.0 ||
      -dot(first.tangent, last.tangent) > kTurnedBack) {
    return 0.0;
  }
  const double bent = 0.5 * (std::abs(first.kappa) + std::abs(last.kappa));
  return bent * kLargestEdge * chord_ >= 1.0 ? 1.0 / bent : 0.0;
}

Result<void> Airfoil::measure_chord() {
  const Vec2 a = end(true), b = end(false);
  const Vec2 edge = 0.5 * (a + b);
  const std::size_t n = looks();
  const double step = length() / static_cast<double>(n);
  double farthest = -1.0, area = 0.0;
  std::size_t where = 0;
  Vec2 before = a;
  for (std::size_t k = 0; k <= n; ++k) {
    const Vec2 p = at(static_cast<double>(k) * step).point;
    area += cross(before - edge, p - edge);
    before = p;
    const Vec2 d = p - edge;
    if (dot(d, d) > farthest) farthest = dot(d, d), where = k;
  }
  if (area == 0.0 || where == 0 || where == n) {
    return error(ErrorCode::kNothingThere, "the contour is no airfoil: it goes around nothing");
  }
  const auto receding = [&](double s) {
    const auto place = at(s);
    return dot(place.point - edge, place.tangent);
  };
  nose_ = sign_change(static_cast<double>(where - 1) * step, static_cast<double>(where + 1) * step,
                      receding);
  if (area < 0.0) {
    nose_ = length() - nose_;
    reversed_ = true;
  }
  leading_ = at(nose_).point;
  const Vec2 d = edge - leading_;
  chord_ = std::hypot(d.x, d.y);
  along_ = {d.x / chord_, d.y / chord_};
  return {};
}

AirfoilFigures Airfoil::figures() const {
  AirfoilFigures out;
  const double c = chord_;
  out.chord = c;
  out.turn = std::atan2(along_.y, along_.x);
  out.leading_edge = leading_;
  const auto thickness = [&](double x) { return height(true, x) - height(false, x); };
  const auto camber = [&](double x) { return 0.5 * (height(true, x) + height(false, x)); };
  constexpr int kPlaces = 200;
  const auto place = [&](int k) { return c * std::clamp(k, 0, kPlaces) / kPlaces; };
  int thick = 0, high = 0;
  double most = -1.0, highest_camber = -1.0;
  for (int k = 0; k <= kPlaces; ++k) {
    const double t = thickness(place(k));
    const double h = std::abs(camber(place(k)));
    if (t > most) {
      most = t;
      thick = k;
    }
    if (h > highest_camber) {
      highest_camber = h;
      high = k;
    }
  }
  const double sign = camber(place(high)) < 0.0 ? -1.0 : 1.0;
  const double thickest = highest_place(place(thick - 1), place(thick + 1), thickness);
  const double top =
      highest_place(place(high - 1), place(high + 1), [&](double x) { return sign * camber(x); });
  out.thickness = thickness(thickest) / c;
  out.thickness_at = thickest / c;
  out.camber = camber(top) / c;
  out.camber_at = top / c;
  out.nose_radius = 1.0 / std::abs(at(nose_).kappa) / c;
  const auto first = at(0.0), last = at(length());
  const Vec2 apart = local(end(true)) - local(end(false));
  out.trailing_round = edge_radius() > 0.0;
  out.trailing_thickness = out.trailing_round ? 2.0 * edge_radius() / c : std::abs(apart.y) / c;
  out.trailing_gap = std::abs(apart.x) / c;
  const Vec2 upper = -1.0 * first.tangent, lower = last.tangent;  // both towards the edge
  out.trailing_angle = turning(upper, lower);
  look_at_nose(out);
  return out;
}

/// Corners, and how often the curvature turns back, near the leading edge.
void Airfoil::look_at_nose(AirfoilFigures& figures) const {
  const double reach = kNoseReach * chord_;
  const std::size_t n = looks();
  const double from = std::max(nose_ - kNoseWindow * reach, 0.0);
  const double to = std::min(nose_ + kNoseWindow * reach, length());
  // each piece of the window by itself: its samples begin and end at its joints
  std::vector<double> stops{from};
  for (std::size_t k = 0; k <= path_.pieces().size(); ++k) {
    double s = reversed_ ? to_ - path_.joint(k) : path_.joint(k) - from_;
    if (wraps_ && s < 0.0) s += path_.length();
    if (wraps_ && s > path_.length()) s -= path_.length();
    if (s > from && s < to) stops.push_back(s);
  }
  stops.push_back(to);
  std::sort(stops.begin(), stops.end());
  const auto near = [&](Vec2 p) { return std::hypot(p.x - leading_.x, p.y - leading_.y) <= reach; };
  // at a joint the places just before and behind it
  const double beside = kBeside * (to - from) / static_cast<double>(n);
  std::vector<double> kappas;
  double largest = 0.0;
  for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
    const double a = stops[k] + beside, b = stops[k + 1] - beside;
    if (!(a < b)) continue;
    if (k > 0) {
      const auto in = at(stops[k] - beside), out = at(stops[k] + beside);
      const double turn = std::abs(turning(in.tangent, out.tangent));
      const double bent = 2.0 * beside * std::max(std::abs(in.kappa), std::abs(out.kappa));
      if (near(in.point) && turn > kCorner + bent) {
        figures.nose_corner = std::max(figures.nose_corner, turn);
      }
    }
    for (std::size_t i = 0; i <= kLooks; ++i) {
      const auto place = at(a + (b - a) * static_cast<double>(i) / kLooks);
      if (!near(place.point)) continue;
      kappas.push_back(place.kappa);
      largest = std::max(largest, std::abs(place.kappa));
    }
  }
  int way = 0;
  double last = kappas.empty() ? 0.0 : kappas.front();
  for (const double kappa : kappas) {
    if (std::abs(kappa - last) <= kSameBend * largest) continue;
    const int now = kappa > last ? 1 : -1;
    if (way != 0 && now != way) ++figures.nose_turns;
    way = now;
    last = kappa;
  }
}

Result<Airfoil> airfoil_of(const Contour& contour) {
  auto made = Airfoil::of(contour);
  OBVID_TRY(made);
  for (const bool upper : {true, false}) {
    if (made->runs_along(upper)) continue;
    return error(ErrorCode::kNothingThere,
                 fmt::format("the {} side folds back along the chord: no airfoil",
                             upper ? "upper" : "lower"))
        .hint("write .csv samples");
  }
  return made;
}

Result<AirfoilFigures> airfoil_figures(const Contour& contour) {
  const auto foil = airfoil_of(contour);
  OBVID_TRY(foil);
  const AirfoilFigures out = foil->figures();
  const double apart = norm(foil->at(0.0).point - foil->at(foil->length()).point) / out.chord;
  if (apart < kWidestEdge) return out;
  return error(ErrorCode::kNothingThere,
               "the ends lie farther apart than half of the chord: no airfoil")
      .value(apart);
}

}  // namespace obvid
