// SPDX-License-Identifier: Apache-2.0
#include "obvid/alignment/transition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "obvid/contour/clothoids.h"
#include "obvid/curve/internal/clothoid.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/numeric/internal/gauss.h"

namespace obvid {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::array<std::string_view, 5> kNames = {"clothoid", "bloss", "sine", "cosine",
                                                    "helmert"};
/// Rad that a part of Gauss's rule turns, and parts of the length that it covers, at the most.
constexpr double kPartTurn = 0.5;
constexpr double kPartShare = 0.125;  // the middle, where Helmert's law has a corner, is a joint
constexpr int kMostClothoids = 1024;
constexpr int kLooks = 4;  ///< places of a clothoid that are compared

}  // namespace

std::string_view name_of(Transition kind) { return kNames[static_cast<std::size_t>(kind)]; }

std::optional<Transition> transition_named(std::string_view name) {
  const auto at = std::find(kNames.begin(), kNames.end(), name);
  if (at == kNames.end()) return std::nullopt;
  return static_cast<Transition>(at - kNames.begin());
}

double transition_share(Transition kind, double u) {
  switch (kind) {
    case Transition::kClothoid:
      break;
    case Transition::kBloss:
      return u * u * (3.0 - 2.0 * u);
    case Transition::kSine:
      return u - std::sin(2.0 * kPi * u) / (2.0 * kPi);
    case Transition::kCosine:
      return 0.5 * (1.0 - std::cos(kPi * u));
    case Transition::kHelmert:
      return u < 0.5 ? 2.0 * u * u : 1.0 - 2.0 * (1.0 - u) * (1.0 - u);
  }
  return u;
}

double transition_turn(Transition kind, double u) {
  switch (kind) {
    case Transition::kClothoid:
      break;
    case Transition::kBloss:
      return u * u * u * (1.0 - 0.5 * u);
    case Transition::kSine: {
      const double sine = std::sin(kPi * u);  // cos(2 pi u) - 1 = -2 sin^2(pi u)
      return 0.5 * u * u - 0.5 * sine * sine / (kPi * kPi);
    }
    case Transition::kCosine:
      return 0.5 * u - 0.5 * std::sin(kPi * u) / kPi;
    case Transition::kHelmert: {
      const double v = 1.0 - u;
      return u < 0.5 ? 2.0 / 3.0 * u * u * u : u - 0.5 + 2.0 / 3.0 * v * v * v;
    }
  }
  return 0.5 * u * u;
}

Element transition_at(Transition kind, const Element& start, double kappa1, double length,
                      double s) {
  const double change = kappa1 - start.kappa;
  if (kind == Transition::kClothoid || change == 0.0) {
    return clothoid_at(start, change / length, s);
  }
  if (s < 0.0) return clothoid_at(start, 0.0, s);
  if (s > length) {
    return clothoid_at(transition_at(kind, start, kappa1, length, length), 0.0, s - length);
  }
  const auto theta_at = [&](double u) {
    return start.theta + start.kappa * length * u + change * length * transition_turn(kind, u);
  };
  const double turn = (std::abs(start.kappa) + std::abs(change)) * length;
  const double share = std::min(kPartShare, std::exp2(std::floor(std::log2(kPartTurn / turn))));
  const double whole = s / length;
  Vec2 step;
  for (double from = 0.0; from < whole; from += share) {  // powers of two: exact
    const double to = std::min(from + share, whole);
    const double middle = 0.5 * (from + to), width = to - from;
    for (std::size_t i = 0; i < 8; ++i) {
      const double node = GaussRule<8>::kNode[i / 2] * (i % 2 == 0 ? 0.5 : -0.5);
      const double weight = 0.5 * width * length * GaussRule<8>::kWeight[i / 2];
      step = step + weight * unit_at(theta_at(middle + node * width));
    }
  }
  return {start.point + step, theta_at(whole),
          start.kappa + change * transition_share(kind, whole)};
}

std::vector<ClothoidPiece> clothoids_along(Transition kind, const Element& start, double kappa1,
                                           double length, double tolerance) {
  for (int count = 1;; count *= 2) {
    std::vector<ClothoidPiece> out;
    double largest = 0.0;
    Element from = start;
    for (int k = 0; k < count; ++k) {
      const double s1 = length * (k + 1) / count;
      const Element to = transition_at(kind, start, kappa1, length, s1);
      const auto piece = clothoid_between(from.point, from.theta, to.point, to.theta);
      if (!piece) break;
      for (int look = 1; look < kLooks; ++look) {
        const double part = static_cast<double>(look) / kLooks;
        const Element there =
            transition_at(kind, start, kappa1, length, length * (k + part) / count);
        const Vec2 away = evaluate(*piece, part).point - there.point;
        largest = std::max(largest, std::abs(cross(unit_at(there.theta), away)));
      }
      out.push_back(*piece);
      from = to;
    }
    if (static_cast<int>(out.size()) == count &&
        (largest <= tolerance || count >= kMostClothoids)) {
      return out;
    }
    if (count >= kMostClothoids) return out;
  }
}

}  // namespace obvid
