// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include "obvid/core/internal/parallel.h"
#include "pass_families.h"

namespace obvid::toolpath {
namespace {

constexpr double kSpacingOfStep = 0.25;     // of the level step, between places of a front
constexpr std::size_t kMostPlaces = 20000;  // of a front

/// Greatest b that a step form reaches at a distance `da` along the passes; nothing: too far.
std::optional<double> reach(const StepForm& f, double da) {
  const double root = f.xy * f.xy * da * da - f.yy * (f.xx * da * da - 1.0);
  if (root < 0.0) return std::nullopt;
  return (std::sqrt(root) - f.xy * da) / f.yy;
}

/// A pass as heights b over places a; the next one is where steps from all of it end together.
class Front {
 public:
  Front(const Part& part, const StepRule& rule, const PassFrame& frame, std::size_t threads)
      : part_(part), rule_(rule), frame_(frame), threads_(threads) {
    const double spacing = kSpacingOfStep * rule.level();
    const double places = std::ceil((frame.a1 - frame.a0) / spacing) + 1.0;
    const auto count =
        static_cast<std::size_t>(std::clamp(places, 3.0, static_cast<double>(kMostPlaces)));
    spacing_ = (frame.a1 - frame.a0) / static_cast<double>(count - 1);
    b_.assign(count, frame.b0);
  }

  [[nodiscard]] double lowest() const { return *std::min_element(b_.begin(), b_.end()); }

  [[nodiscard]] Rail rail() const {
    Rail rail;
    for (std::size_t i = 0; i < b_.size(); ++i) rail.axis.push_back(frame_.at(a(i), b_[i]));
    return rail;
  }

  void advance() {
    const auto here = forms(b_);
    std::vector<double> ahead(b_.size());
    for (std::size_t i = 0; i < b_.size(); ++i) ahead[i] = b_[i] + *reach(here[i], 0.0);
    const auto there = forms(ahead);
    std::vector<double> next(b_.size());
    for (std::size_t i = 0; i < b_.size(); ++i) next[i] = furthest(i, here, there[i]);
    b_ = std::move(next);
  }

 private:
  [[nodiscard]] double a(std::size_t i) const {
    return i + 1 == b_.size() ? frame_.a1 : frame_.a0 + static_cast<double>(i) * spacing_;
  }

  /// In coordinates a and b.
  [[nodiscard]] std::vector<StepForm> forms(const std::vector<double>& b) const {
    std::vector<StepForm> out(b.size(), rule_.level_form());
    const Vec2 x = frame_.along, y = frame_.across();
    in_parallel(b.size(), threads_, [&](std::size_t i) {
      const auto place = part_.drop(frame_.at(a(i), b[i]));
      if (!place) return;
      const StepForm f = rule_.form(part_, *place);
      const auto form = [&](Vec2 p, Vec2 q) {
        return f.xx * p.x * q.x + f.xy * (p.x * q.y + p.y * q.x) + f.yy * p.y * q.y;
      };
      out[i] = {form(x, x), form(x, y), form(y, y)};
    });
    return out;
  }

  [[nodiscard]] double furthest(std::size_t i, const std::vector<StepForm>& here,
                                const StepForm& there) const {
    const auto window = static_cast<std::size_t>(rule_.level() / spacing_) + 1;
    const std::size_t end = std::min(b_.size(), i + window + 1);
    double best = b_[i] + std::min(*reach(here[i], 0.0), *reach(there, 0.0));
    for (std::size_t j = i > window ? i - window : 0; j < end; ++j) {
      const auto first = reach(here[j], a(i) - a(j)), second = reach(there, a(i) - a(j));
      if (first && second) best = std::max(best, b_[j] + std::min(*first, *second));
    }
    return best;
  }

  const Part& part_;
  const StepRule& rule_;
  const PassFrame& frame_;
  std::size_t threads_;
  double spacing_ = 0.0;
  std::vector<double> b_;
};

}  // namespace

Result<Family> constant_scallop(const Part& part, const ToolpathOptions& options,
                                const StepRule& rule, Walker& walker, const Leftover* left,
                                const RunContext& run) {
  PassFrame frame = pass_frame(part, options.angle_deg);
  Front front(part, rule, frame, walker.threads());
  Family family;
  while (front.lowest() <= frame.b1) {
    auto pass = walk_where_left(walker, front.rail(), left);
    OBVID_TRY(pass);
    if (!pass->empty()) family.push_back(std::move(*pass));
    front.advance();
    const double share = (front.lowest() - frame.b0) / (frame.b1 - frame.b0);
    OBVID_TRY(tell(run, "passes", share));
  }
  return family;
}

}  // namespace obvid::toolpath
