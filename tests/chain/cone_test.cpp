// SPDX-License-Identifier: Apache-2.0
// The shared cone: its width and the derivatives of its barrier against formulas written once more
// in extended precision, and differences of them.
#include "obvid/chain/internal/cone.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>

#include "../common/merit_by_hand.h"

namespace obvid {
namespace {

using test::Long;

constexpr double kReserve = 1.05;

ConeVariables at(double m, double q, double sigma) {
  return {m, q, sigma, std::sin(sigma), std::cos(sigma)};
}

TEST(Cone, WidthIsThePublishedConditionAndItsSlopeTheDerivative) {
  for (const Cone cone : {Cone::kSpiral, Cone::kClosedForm}) {
    for (int i = -150; i <= 150; ++i) {
      const double sigma = 0.01 * i;
      const ConeWidth w = cone_width(cone, at(0.0, 0.0, sigma), kReserve);
      const auto by_hand = [&](Long s) { return test::width_by_hand(cone, s, kReserve); };
      EXPECT_NEAR(w.value, static_cast<double>(by_hand(sigma)), 1e-12) << sigma;
      if (std::abs(std::abs(sigma) - 1.3) < 1e-6) continue;  // the second derivative jumps there
      EXPECT_NEAR(w.slope, static_cast<double>(test::slope_of(by_hand, sigma)), 1e-9) << sigma;
    }
  }
}

/// All first derivatives are those of the merit; the second ones those of the merit with S taken as
/// linear in sigma.
TEST(Cone, TermsAreTheDerivativesOfTheMerit) {
  constexpr double kSize = 0.3, kWeight = 0.7, kBarrier = 0.4;
  constexpr LinkEnergy kForm{24.0, 2.0, 1.5, 6.0};
  int checked = 0;
  for (const Cone cone : {Cone::kSpiral, Cone::kClosedForm}) {
    for (const double d : {-1.0, 1.0}) {
      for (int i = -15; i <= 15; ++i) {
        if (std::abs(i) == 13) continue;
        const double sigma = 0.1 * i, slack = 25.0;
        for (const auto& [m, q] : {std::array{0.4, -0.2}, {-0.9, 0.5}, {2.0, 1.0}}) {
          const ConeVariables v = at(m, q, sigma);
          const ConeRoom room = cone_room(v, cone_width(cone, v, kReserve), d, kSize, slack);
          ASSERT_TRUE(room.inside());
          const ConeTerms t = cone_terms(v, room, d, kSize, kForm, kWeight, kBarrier);
          const test::ConeMerit merit{cone, kReserve, d, kSize, kForm, kWeight, kBarrier};
          const std::array<Long, 4> x = {m, q, sigma, slack};
          const std::string what = "cone " + std::to_string(static_cast<int>(cone)) + ", sigma " +
                                   std::to_string(sigma) + ", direction " + std::to_string(d);
          const std::array g = {t.gm, t.gq, t.gs, t.slack_gradient};
          for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_NEAR(g[k], static_cast<double>(test::partial(merit, x, k)),
                        1e-8 * (1.0 + std::abs(g[k])))
                << what << ", unknown " << k;
          }
          const auto linear = merit.with_linear_width_at(sigma);
          const double h[4][4] = {{t.hmm, t.hmq, t.hms, t.zm},
                                  {t.hmq, t.hqq, t.hqs, t.zq},
                                  {t.hms, t.hqs, t.hss, t.zs},
                                  {t.zm, t.zq, t.zs, t.slack_hessian}};
          for (std::size_t k = 0; k < 4; ++k) {
            for (std::size_t l = 0; l < 4; ++l) {
              const auto by_k = [&](const std::array<Long, 4>& y) {
                return test::partial(linear, y, k);
              };
              EXPECT_NEAR(h[k][l], static_cast<double>(test::partial(by_k, x, l)),
                          1e-6 * (1.0 + std::abs(h[k][l])))
                  << what << ", entry " << k << ", " << l;
              ++checked;
            }
          }
        }
      }
    }
  }
  EXPECT_GT(checked, 4000);
}

}  // namespace
}  // namespace obvid
