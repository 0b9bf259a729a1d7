// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/spline_values.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "obvid/core/internal/typed_numbers.h"
#include "obvid/pipeline/internal/job_values.h"

namespace obvid {
namespace {

constexpr long kNurbsDegree = 3;  // where none is typed

Result<std::vector<double>> knot_list(const std::string& typed, const char* option) {
  if (typed.empty()) return std::vector<double>{};
  auto knots = typed_numbers(typed);
  if (!knots) return fail(bad_option("the list holds what is no number", option, "0,0,1,2,2"));
  return std::move(*knots);
}

Result<std::vector<std::pair<std::size_t, double>>> values_at_points(
    const std::vector<std::string>& typed, const char* option) {
  constexpr double kMostPoints = 1e9;
  std::vector<std::pair<std::size_t, double>> out;
  for (const std::string& one : typed) {
    const auto both = typed_numbers(one, '=');
    if (!both || both->size() != 2 || both->front() < 1.0 || both->front() > kMostPoints ||
        both->front() != std::floor(both->front())) {
      return fail(bad_option("'" + one + "' is no point and value", option, "as in 3=0.7"));
    }
    out.emplace_back(static_cast<std::size_t>(both->front()) - 1, both->back());
  }
  return out;
}

Result<int> nurbs_degree(const std::optional<long>& typed, const char* option) {
  const long degree = typed.value_or(kNurbsDegree);
  if (degree >= 1 && degree <= kMaxNurbsDegree) return static_cast<int>(degree);
  return fail(bad_option("degrees run from 1 to 9", option, ""));
}

}  // namespace

Result<void> set_spline(const SplineValues& typed, SplineJob& job) {
  const long degree = typed.degree.value_or(job.curve ? 4 : 2);
  constexpr long kMost = 100;  // what is no degree stays none: `id_spline` refuses it
  job.options.degree = static_cast<int>(std::clamp(degree, 0L, kMost));
  const std::string smooth =
      typed.smooth.empty() ? (job.curve && degree > 2 ? "values-kept" : "none") : typed.smooth;
  const auto smoothing = value_named<IdSmoothing>({{"none", IdSmoothing::kNone},
                                                   {"values-kept", IdSmoothing::kValuesKept},
                                                   {"values-free", IdSmoothing::kValuesFree}},
                                                  smooth, "--smooth");
  OBVID_TRY(smoothing);
  job.options.smoothing = *smoothing;
  if (typed.tolerance && !(*typed.tolerance > 0.0 && std::isfinite(*typed.tolerance))) {
    return fail(bad_option("the tolerance must be a positive length", "--tolerance",
                           "give it in the units of the table"));
  }
  job.tolerance = typed.tolerance;
  return {};
}

Result<void> set_nurbs(const NurbsValues& typed, NurbsJob& job) {
  const auto degree = nurbs_degree(typed.degree, "--degree");
  OBVID_TRY(degree);
  const auto degree_v = nurbs_degree(typed.degree_v, "--degree-v");
  OBVID_TRY(degree_v);
  auto knots = knot_list(typed.knots, "--knots");
  OBVID_TRY(knots);
  auto knots_v = knot_list(typed.knots_v, "--knots-v");
  OBVID_TRY(knots_v);
  auto weights = values_at_points(typed.weights, "--weight-at");
  OBVID_TRY(weights);
  auto moves = values_at_points(typed.moves, "--move");
  OBVID_TRY(moves);
  job = {*degree,          *degree_v, std::move(*knots), std::move(*knots_v), std::move(*weights),
         std::move(*moves)};
  return {};
}

Result<std::size_t> rows_of_samples(long rows) {
  constexpr long kMost = 10'000'000;
  if (rows >= 2 && rows <= kMost) return static_cast<std::size_t>(rows);
  return fail(bad_option("between 2 and 10,000,000 rows are possible", "--samples", ""));
}

}  // namespace obvid
