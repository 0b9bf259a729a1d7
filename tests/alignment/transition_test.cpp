// SPDX-License-Identifier: Apache-2.0
#include "obvid/alignment/transition.h"
#include "../common/shared_data.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "obvid/alignment/alignment.h"
#include "obvid/alignment/internal/transition_law.h"
#include "obvid/curve/internal/clothoid.h"

namespace obvid {
namespace {

constexpr double kPi = std::numbers::pi;

/// The laws as textbooks print them.
struct Law {
  Transition kind;
  AlignmentKind element;
  std::function<double(double)> share;
};
const std::vector<Law> kLaws = {
    {Transition::kBloss, AlignmentKind::kBloss, [](double u) { return 3 * u * u - 2 * u * u * u; }},
    {Transition::kSine, AlignmentKind::kSine,
     [](double u) { return u - std::sin(2 * kPi * u) / (2 * kPi); }},
    {Transition::kCosine, AlignmentKind::kCosine,
     [](double u) { return (1 - std::cos(kPi * u)) / 2; }},
    {Transition::kHelmert, AlignmentKind::kHelmert,
     [](double u) { return u < 0.5 ? 2 * u * u : -1 + 4 * u - 2 * u * u; }}};

/// The cubic parabola y = c x^3 between two abscissas, as textbooks print it.
struct Parabola {
  double c, x0, x1;

  [[nodiscard]] Vec2 point(double x) const { return {x, c * x * x * x}; }
  [[nodiscard]] double heading(double x) const { return std::atan(3 * c * x * x); }
  [[nodiscard]] double kappa(double x) const {
    return 6 * c * x / std::pow(1 + 9 * c * c * x * x * x * x, 1.5);
  }
  /// Simpson's rule.
  [[nodiscard]] double arc(double x) const {
    constexpr int kSlices = 400;
    const double h = (x - x0) / kSlices;
    double sum = 0.0;
    for (int i = 0; i <= kSlices; ++i) {
      const double slope = 3 * c * (x0 + i * h) * (x0 + i * h);
      sum += (i == 0 || i == kSlices ? 1 : i % 2 == 1 ? 4 : 2) * std::sqrt(1 + slope * slope);
    }
    return sum * h / 3;
  }
  /// Abscissa at a length behind x0, by bisection.
  [[nodiscard]] double at(double length) const {
    double low = x0, high = x0 + length;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (arc(middle) < length ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
};

/// The parabola from its inflection that has the curvature `kappa` behind `length`, by bisection.
Parabola parabola_to(double kappa, double length) {
  double low = 0.0, high = kappa / length;  // 6 c x = kappa for small ones: c = kappa/(6 length)
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const Parabola one{middle, 0.0, 0.0};
    (one.kappa(one.at(length)) < kappa ? low : high) = middle;
  }
  Parabola out{0.5 * (low + high), 0.0, 0.0};
  out.x1 = out.at(length);
  return out;
}

/// Shares of a cubic parabola's curvature, between places so close that lines between them do.
std::function<double(double)> share_of_parabola(double kappa, double length) {
  constexpr int kPlaces = 300;
  const Parabola curve = parabola_to(kappa, length);
  std::vector<double> share;
  for (int i = 0; i <= kPlaces; ++i) {
    share.push_back(curve.kappa(curve.at(length * i / kPlaces)) / kappa);
  }
  return [share](double u) {
    const double place = std::clamp(u, 0.0, 1.0) * kPlaces;
    const auto i = std::min(static_cast<std::size_t>(place), share.size() - 2);
    return share[i] + (place - static_cast<double>(i)) * (share[i + 1] - share[i]);
  };
}

/// Walks along a curvature by the middle rule on slices of a millimetre's order: the heading is
/// exact to the square of a slice, the place too.
class Walk {
 public:
  void along(double length, const std::function<double(double)>& kappa, double step,
             std::vector<Vec2>& out) {
    const int slices = static_cast<int>(std::lround(length / kSlice));
    const double h = length / slices;
    for (int i = 0; i < slices; ++i) {
      if (s_ >= next_ - 0.5 * h) {
        out.push_back(at_);
        next_ += step;
      }
      const double k0 = kappa(i * h), k1 = kappa((i + 0.5) * h), k2 = kappa((i + 1) * h);
      const double middle = theta_ + h / 24 * (5 * k0 + 8 * k1 - k2);
      const double end = theta_ + h / 6 * (k0 + 4 * k1 + k2);
      const auto simpson = [&](auto f) { return h / 6 * (f(theta_) + 4 * f(middle) + f(end)); };
      at_ = at_ + Vec2{simpson([](double a) { return std::cos(a); }),
                       simpson([](double a) { return std::sin(a); })};
      theta_ = end;
      s_ += h;
    }
  }
  [[nodiscard]] Vec2 at() const { return at_; }
  [[nodiscard]] double theta() const { return theta_; }

 private:
  static constexpr double kSlice = 0.02;
  Vec2 at_{};
  double theta_ = 0.0, s_ = 0.0, next_ = 0.0;
};

TEST(Transition, PlacesAreThoseOfTheLawIntegrated) {
  for (const Law& law : kLaws) {
    for (const double kappa0 : {0.0, -1 / 400.0}) {
      const double kappa1 = 1 / 90.0, length = 120.0;
      for (const double part : {0.3, 0.5, 1.0}) {
        Walk walk;
        std::vector<Vec2> unused;
        walk.along(
            part * length,
            [&](double s) { return kappa0 + (kappa1 - kappa0) * law.share(s / length); }, 1e9,
            unused);
        const Element end =
            transition_at(law.kind, {{}, 0.0, kappa0}, kappa1, length, part * length);
        EXPECT_NEAR(end.point.x, walk.at().x, 1e-10) << name_of(law.kind) << part;
        EXPECT_NEAR(end.point.y, walk.at().y, 1e-10) << name_of(law.kind) << part;
        EXPECT_NEAR(end.theta, walk.theta(), 1e-12);
        EXPECT_NEAR(end.kappa, kappa0 + (kappa1 - kappa0) * law.share(part), 1e-15);
      }
    }
  }
}

TEST(Transition, TurnsHalfOfTheChangeOverItsLength) {
  for (const Law& law : kLaws) {
    const TransitionLaw own(law.kind, 0.0, 0.01, 30.0);
    EXPECT_TRUE(own.exists());
    EXPECT_NEAR(own.turn(1.0), 0.5, 1e-15);
    EXPECT_EQ(own.turn(0.0), 0.0);
    EXPECT_NEAR(own.share(1.0), 1.0, 1e-15);
    EXPECT_EQ(transition_named(name_of(law.kind)), law.kind);
  }
  EXPECT_EQ(transition_named("cubic"), Transition::kCubic);
}

TEST(Transition, ACubicOneIsTheParabolaBetweenItsCurvatures) {
  // from the inflection (up to where it turns by 21 degrees), between two curvatures, through the
  // inflection, towards it; of nearly no turning
  for (const Parabola& curve :
       {Parabola{2e-5, 0.0, 80.0}, Parabola{2e-5, 30.0, 75.0}, Parabola{2e-5, -40.0, 70.0},
        Parabola{2e-5, -70.0, -10.0}, Parabola{-2e-5, 5.0, 70.0}, Parabola{1e-9, 0.0, 100.0},
        Parabola{2e-5, -85.0, 86.0}}) {  // up to 23.9 degrees on both sides
    const double length = curve.arc(curve.x1);
    const Element start{curve.point(curve.x0), curve.heading(curve.x0), curve.kappa(curve.x0)};
    const TransitionLaw law(Transition::kCubic, start.kappa, curve.kappa(curve.x1), length);
    EXPECT_TRUE(law.exists()) << curve.x0;
    for (const double share : {0.0, 0.2, 0.5, 0.9, 1.0}) {
      const double x = curve.at(share * length);
      const Element found =
          transition_at(Transition::kCubic, start, curve.kappa(curve.x1), length, share * length);
      EXPECT_NEAR(found.point.x, curve.point(x).x, 1e-9) << curve.x0 << ' ' << share;
      EXPECT_NEAR(found.point.y, curve.point(x).y, 1e-9) << curve.x0 << ' ' << share;
      EXPECT_NEAR(found.theta, curve.heading(x), 1e-11);
      EXPECT_NEAR(found.kappa, curve.kappa(x), 1e-12);
    }
  }
}

TEST(Transition, NoCubicOneLeadsToMoreThanItsGreatestCurvature) {
  // x^4 = 1/5 of y = x^3/3, by its formulas: curvature 1.0174, arc length 0.68178
  EXPECT_TRUE(TransitionLaw(Transition::kCubic, 0.0, 1.0174, 0.6815).exists());
  EXPECT_FALSE(TransitionLaw(Transition::kCubic, 0.0, 1.0174, 0.6825).exists());
  EXPECT_FALSE(TransitionLaw(Transition::kCubic, 1.0, 1.01, 1.0).exists());
  for (const double kappa1 : {0.69, 0.7, 1.0, 30.0}) {  // whatever is asked for is finite
    const TransitionLaw law(Transition::kCubic, -0.1, kappa1, 1.0);
    EXPECT_NEAR(law.share(1.0), 1.0, 1e-12);
    EXPECT_GT(law.turn(1.0), 0.3);
    EXPECT_LT(law.turn(1.0), 0.7);
  }
}

/// The closed forms are monotone, and so is the curvature of clothoids in their place: from the one
/// end's to the other's, without a step where two meet.
void expect_monotone(const std::vector<ClothoidPiece>& pieces, double kappa0, double kappa1) {
  const double side = kappa1 > kappa0 ? 1.0 : -1.0;
  EXPECT_EQ(pieces.front().kappa0, kappa0);
  EXPECT_EQ(pieces.back().kappa1, kappa1);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    EXPECT_GE(side * (pieces[k].kappa1 - pieces[k].kappa0), 0.0) << k;
    if (k == 0) continue;
    EXPECT_EQ(pieces[k].kappa0, pieces[k - 1].kappa1) << k;
    EXPECT_EQ(pieces[k].start, pieces[k - 1].end) << k;
    const ClothoidPiece& before = pieces[k - 1];
    const double turned = before.theta0 + 0.5 * (before.kappa0 + before.kappa1) * before.length;
    EXPECT_NEAR(pieces[k].theta0, turned, 1e-12) << k;  // rounding of places
    const Vec2 step = clothoid_step(before.theta0, before.kappa0, before.kappa1, before.length);
    EXPECT_NEAR(norm(before.start + step - before.end), 0.0, 1e-11) << k;
  }
}

TEST(Transition, ClothoidsAlongItStayWithinTheTolerance) {
  std::vector<Law> laws = kLaws;
  laws.push_back({Transition::kCubic, AlignmentKind::kCubic, {}});
  struct Ends {
    double kappa0, kappa1, length;
  };
  // from straight, between arcs of one side, back, through an inflection, and half a turn; of a
  // parabola that ends where it bends most
  const std::vector<Ends> all = {{0.0, 1 / 300.0, 100.0},   {1 / 900.0, 1 / 200.0, 80.0},
                                 {-1 / 250.0, 0.0, 60.0},   {-1 / 400.0, 1 / 300.0, 120.0},
                                 {0.0, 0.0625, 100.0},      {0.0, 1e-7, 30.0},
                                 {0.0, 1.0174 / 100, 68.15}};
  for (const Law& law : laws) {
    for (const Ends& ends : all) {
      const Element start{{5.0, 7.0}, 0.4, ends.kappa0};
      const TransitionLaw own(law.kind, ends.kappa0, ends.kappa1, ends.length);
      if (!own.exists()) continue;
      const std::string what =
          std::string(name_of(law.kind)) + " to " + std::to_string(ends.kappa1);
      SCOPED_TRACE(what);
      for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
        const auto made = clothoids_along(law.kind, start, ends.kappa1, ends.length, tolerance);
        ASSERT_TRUE(made.has_value());
        const std::vector<ClothoidPiece>& pieces = *made;
        EXPECT_LE(pieces.size(), tolerance == 1e-9 ? 1024U : 256U);
        expect_monotone(pieces, ends.kappa0, ends.kappa1);
        double s = 0.0;
        for (const ClothoidPiece& piece : pieces) {
          for (const double t : {0.1, 0.35, 0.6, 0.85}) {
            const Element near =
                transition_at(law.kind, start, ends.kappa1, ends.length, s + t * piece.length);
            EXPECT_NEAR(cross(unit_at(near.theta), evaluate(piece, t).point - near.point), 0.0,
                        1.2 * tolerance);
          }
          s += piece.length;
        }
        EXPECT_NEAR(s, ends.length, tolerance);
      }
    }
  }
}

/// A law with the shares of transitions from straight: `kappa`, length.
using SharesOf = std::function<std::function<double(double)>(double, double)>;
std::vector<std::pair<Law, SharesOf>> all_laws() {
  std::vector<std::pair<Law, SharesOf>> out;
  for (const Law& law : kLaws) {
    out.emplace_back(law, [law](double, double) { return law.share; });
  }
  out.emplace_back(Law{Transition::kCubic, AlignmentKind::kCubic, {}}, share_of_parabola);
  return out;
}

TEST(Alignment, FindsTransitionsOfOtherKindsBetweenLinesAndArcs) {
  for (const auto& [law, shares_of] : all_laws()) {
    std::vector<Vec2> points;
    Walk walk;
    const auto straight = [](double) { return 0.0; };
    const double arc = 1 / 320.0;
    const auto in = shares_of(arc, 90), behind = shares_of(arc, 70);
    walk.along(150, straight, 5, points);
    walk.along(
        90, [&](double s) { return arc * in(s / 90); }, 5, points);
    walk.along(
        160, [&](double) { return arc; }, 5, points);
    walk.along(
        70, [&](double s) { return arc * behind(1 - s / 70); }, 5, points);
    walk.along(120, straight, 5, points);
    points.push_back(walk.at());
    for (const double tolerance : {1e-3, 8e-3}) {
      AlignmentOptions options;
      options.transitions = law.kind;
      const auto found =
          fit_alignment(points, std::vector<double>(points.size(), tolerance), options);
      ASSERT_TRUE(found) << found.error().what;
      EXPECT_EQ(found->elements.size(), 5U) << name_of(law.kind) << tolerance;
      if (found->elements.size() != 5) continue;
      EXPECT_EQ(found->elements[0].kind, AlignmentKind::kLine);
      EXPECT_EQ(found->elements[1].kind, law.element);
      EXPECT_EQ(found->elements[2].kind, AlignmentKind::kArc);
      EXPECT_EQ(found->elements[3].kind, law.element);
      EXPECT_LE(found->largest_share, 1.0);
      EXPECT_NEAR(found->elements[1].length, 90.0, 5.0);
      EXPECT_NEAR(found->elements[3].length, 70.0, 5.0);
      EXPECT_NEAR(1 / found->elements[2].start.kappa, 320.0, 1.0);
      for (std::size_t k = 1; k < 5; ++k) EXPECT_FALSE(found->elements[k].step);
    }
  }
}

TEST(Alignment, ATransitionAloneIsOneElementOfItsKind) {
  for (const auto& [law, shares_of] : all_laws()) {
    std::vector<Vec2> points;
    Walk walk;
    const auto share = shares_of(1 / 300.0, 100);
    walk.along(
        100, [&](double s) { return share(s / 100) / 300; }, 1, points);
    points.push_back(walk.at());
    AlignmentOptions options;
    options.transitions = law.kind;
    const auto found = fit_alignment(points, std::vector<double>(points.size(), 1e-4), options);
    ASSERT_TRUE(found) << found.error().what;
    ASSERT_EQ(found->elements.size(), 1U) << name_of(law.kind);
    EXPECT_EQ(found->elements[0].kind, law.element);
    EXPECT_NEAR(found->elements[0].kappa1, 1 / 300.0, 1e-6);
  }
}

/// Length, x and y of a file of the public data set; one of its sources has parentheses.
std::vector<Vec2> curve_of_file(const std::filesystem::path& path) {
  std::vector<Vec2> out;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || std::isdigit(static_cast<unsigned char>(line[0])) == 0) continue;
    for (char& c : line) {
      if (c == '(' || c == ')') c = ' ';
    }
    std::istringstream row(line);
    double s = 0.0;
    Vec2 p;
    if (row >> s >> p.x >> p.y) out.push_back(p);
  }
  return out;
}

/// The last one too: the search takes the square of their number.
std::vector<Vec2> every_fourth(const std::vector<Vec2>& points) {
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % 4 == 0 || i + 1 == points.size()) out.push_back(points[i]);
  }
  return out;
}

/// Curvature that a name like expert_BlossCurve_100.0_-1000_inf_1_Meter states there.
double stated_curvature(const std::string& name, int field) {
  std::istringstream words(name);
  std::string word;
  for (int i = 0; i <= field; ++i) std::getline(words, word, '_');
  return 1.0 / std::stod(word);
}

TEST(TransitionPublicFiles, EachIsOneElementWithItsRadii) {
  SKIP_WITHOUT("rail_transition_curves");
  const auto folder = shared_data() / "rail_transition_curves";
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    AlignmentOptions options;
    if (name.find("_BlossCurve_") != std::string::npos) options.transitions = Transition::kBloss;
    if (name.find("_SineCurve_") != std::string::npos) options.transitions = Transition::kSine;
    if (options.transitions == Transition::kClothoid) continue;
    const std::vector<Vec2> points = every_fourth(curve_of_file(entry.path()));
    ASSERT_GT(points.size(), 20U) << name;
    const auto found = fit_alignment(points, std::vector<double>(points.size(), 1e-4), options);
    ASSERT_TRUE(found) << name << found.error().what;
    ASSERT_EQ(found->elements.size(), 1U) << name;
    const AlignmentElement& e = found->elements[0];
    EXPECT_EQ(transition_of(e.kind), options.transitions) << name;
    EXPECT_NEAR(e.length, 100.0, 1e-3) << name;
    EXPECT_NEAR(e.start.kappa, stated_curvature(name, 3), 1e-6) << name;
    EXPECT_NEAR(e.kappa1, stated_curvature(name, 4), 1e-6) << name;
    ++count;
  }
  EXPECT_GT(count, 0);
}

// Of two turns and more: what is handed out is as near as was asked, whatever that is, or nothing
// is.
TEST(Transition, ClothoidsAlongManyTurnsAreWithinTheToleranceOrNone) {
  const Element start{{}, 0.0, 0.0};
  const double kappa1 = 0.03, length = 1000.0;
  bool refused = false;
  const Transition kind = Transition::kSine;
  for (const double tolerance : {1e-2, 1e-8, 1e-16}) {
    const auto made = clothoids_along(kind, start, kappa1, length, tolerance);
    if (!made) {
      EXPECT_EQ(made.error().code, ErrorCode::kUnsupported);
      refused = true;
      continue;
    }
    double s = 0.0;
    for (const ClothoidPiece& piece : *made) {
      for (const double t : {0.2, 0.5, 0.8}) {
        const Element at = transition_at(kind, start, kappa1, length, s + t * piece.length);
        const double beside = cross(unit_at(at.theta), evaluate(piece, t).point - at.point);
        EXPECT_LE(std::abs(beside), 1.2 * tolerance);
      }
      s += piece.length;
    }
  }
  EXPECT_TRUE(refused);  // no doubles are so near
}

}  // namespace
}  // namespace obvid
