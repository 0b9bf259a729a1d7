// SPDX-License-Identifier: Apache-2.0
// The weight chain and its first weight: docs/methods/conics.md, section 3.
#include <algorithm>
#include <cmath>
#include <string>

#include "links.h"
#include "median.h"
#include "obvid/contour/conics.h"
#include "obvid/numeric/internal/halving.h"

namespace obvid {
namespace {

using conics::Link;

/// Largest weight that still counts as an ellipse: beyond, 1 - w^2 has lost half its digits.
constexpr double kLargestWeight = 1.0 - 1e-8;

/// Logarithms of the first weight.
struct LogRange {
  double low = -INFINITY;
  double high = INFINITY;
};

/// First weights with which every link keeps inside its own range.
LogRange common_range(const std::vector<Link>& links, ConicWhyNot& why_not) {
  LogRange common;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const auto range = conics::monotone_range(links[i].triangle);
    if (!(range.low < range.high)) {
      why_not = {ConicObstacle::kNoMonotoneConic, i, i, 0.0};
      return {INFINITY, -INFINITY};
    }
    if (range.low - links[i].from_first > common.low) {
      common.low = range.low - links[i].from_first;
      why_not.first = i;
    }
    if (range.high - links[i].from_first < common.high) {
      common.high = range.high - links[i].from_first;
      why_not.second = i;
    }
  }
  if (common.low < common.high) {
    why_not = {};
  } else {
    why_not.obstacle = ConicObstacle::kNoCommonWeight;
    why_not.excess = std::expm1(common.low - common.high);
  }
  return common;
}

/// First weights with which every link is an ellipse arc.
LogRange elliptic_range(const std::vector<Link>& links) {
  LogRange range;
  for (const Link& l : links)
    range.high = std::min(range.high, std::log(kLargestWeight) - l.from_first);
  return range;
}

/// First weights whose conics all pass the median within `widths` half widths of the region's
/// middle.
LogRange near_middle(const std::vector<Link>& links,
                     const std::vector<std::optional<conics::MedianCut>>& cuts, double widths,
                     LogRange range) {
  const auto logit = [](double s) {
    return s <= 0.0 ? -INFINITY : s >= 1.0 ? INFINITY : std::log(s / (1.0 - s));
  };
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (!cuts[i]) continue;
    const double middle = 0.5 * (cuts[i]->low + cuts[i]->high);
    const double half = 0.5 * (cuts[i]->high - cuts[i]->low);
    range.low = std::max(range.low, logit(middle - widths * half) - links[i].from_first);
    range.high = std::min(range.high, logit(middle + widths * half) - links[i].from_first);
  }
  return range;
}

/// The first weight in `range` with the least largest distance from the regions' middles.
double nearest_to_middle(const std::vector<Link>& links, const std::vector<Element>& elements,
                         LogRange range) {
  std::vector<std::optional<conics::MedianCut>> cuts(links.size());
  bool any = false;
  for (std::size_t i = 0; i < links.size(); ++i) {
    cuts[i] = conics::median_cut(elements[i], elements[i + 1]);
    if (cuts[i] && !(cuts[i]->high > cuts[i]->low)) cuts[i].reset();
    any = any || cuts[i];
  }
  const auto middle_of = [](LogRange r) {
    if (std::isinf(r.low)) return std::isinf(r.high) ? 0.0 : r.high - std::log(2.0);
    return std::isinf(r.high) ? r.low : 0.5 * (r.low + r.high);
  };
  if (!any) return middle_of(range);
  const auto possible = [&](double widths) {
    const LogRange r = near_middle(links, cuts, widths, range);
    return r.low <= r.high;
  };
  double high = 1.0;
  constexpr int kDoublings = 1000, kBisections = 60;  // any double; to the last bit
  for (int i = 0; i < kDoublings && !possible(high); ++i) high *= 2.0;
  high = end_of_condition(high, 0.0, possible, kBisections).holds;
  return middle_of(near_middle(links, cuts, high, range));
}

/// A range without its ends: there curvature's rate is 0 at a joint, up to rounding.
LogRange inside(LogRange range) {
  constexpr double kPart = 1e-3;  // of the range
  const double margin = kPart * (range.high - range.low);
  return {range.low + margin, range.high - margin};
}

double choose_first(const std::vector<Link>& links, const std::vector<Element>& elements,
                    ConicWhyNot& why_not) {
  const LogRange monotone = common_range(links, why_not);
  if (monotone.low < monotone.high) return nearest_to_middle(links, elements, inside(monotone));
  return nearest_to_middle(links, elements, elliptic_range(links));
}

/// Logarithm of the first weight with which an element has its own curvature.
std::optional<double> first_for_curvature(const std::vector<Link>& links,
                                          const std::vector<Element>& elements, std::size_t e) {
  if (e >= elements.size() || elements[e].kappa == 0.0) return std::nullopt;
  const bool last = e == links.size();
  const Link& link = links[last ? e - 1 : e];
  const double weighted =
      last ? log_end_curvature(link.triangle) : log_start_curvature(link.triangle);
  return 0.5 * (weighted - std::log(std::abs(elements[e].kappa))) - link.from_first;
}

ConicChain form(const std::vector<Element>& elements, const std::vector<Link>& links,
                double log_first) {
  ConicChain chain;
  chain.elements = elements;
  chain.elliptic = chain.monotone = true;
  for (std::size_t i = 0; i < links.size(); ++i) {
    const auto& t = links[i].triangle;
    const double log_weight = log_first + links[i].from_first, weight = std::exp(log_weight);
    chain.weights.push_back(weight);
    chain.pieces.push_back(conics::conic(elements[i], elements[i + 1], t, weight));
    chain.elliptic = chain.elliptic && weight < 1.0;
    chain.monotone = chain.monotone && conic_direction(chain.pieces.back()) != 0;
    const double squared = 2.0 * log_weight;
    if (i == 0) chain.elements[0].kappa = t.turning * std::exp(log_start_curvature(t) - squared);
    chain.elements[i + 1].kappa = t.turning * std::exp(log_end_curvature(t) - squared);
  }
  return chain;
}

}  // namespace

Result<ConicChain> conic_chain(const std::vector<Element>& elements, const ConicOptions& options) {
  if (options.first_weight && !(*options.first_weight > 0.0)) {
    return error(ErrorCode::kBadOption, "the first weight must be positive")
        .value(*options.first_weight);
  }
  const auto links = conics::links_over(elements);
  OBVID_TRY(links);
  ConicWhyNot why_not;
  const double free_choice = choose_first(*links, elements, why_not);
  const auto met = options.curvature_of
                       ? first_for_curvature(*links, elements, *options.curvature_of)
                       : std::nullopt;
  const double first =
      options.first_weight ? std::log(*options.first_weight) : met.value_or(free_choice);
  ConicChain chain = form(elements, *links, first);
  if (!chain.elliptic || !chain.monotone) chain.why_not = why_not;
  return chain;
}

}  // namespace obvid
