// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/job_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>

#include "obvid/core/internal/near_name.h"
#include "obvid/geom/internal/angle.h"

namespace obvid {
namespace {

using std::string_view;

constexpr const char* kRadiusHint = "positive turns left, negative right, inf is straight";
constexpr const char* kHeadingHint = "degrees counter-clockwise from +x, or natural";

std::string in_quotes(string_view text) {
  std::string result(1, '\'');
  result.append(text);
  result.push_back('\'');
  return result;
}

}  // namespace

std::string with_point(std::string typed) {
  const auto comma = typed.find(',');
  if (comma == std::string::npos) return "";
  typed[comma] = '.';
  if (!typed_number(typed)) return "";
  return "write it with a decimal point: " + typed + "; ";
}

std::optional<double> typed_number(string_view text) {
  if (text.starts_with("+")) text.remove_prefix(1);
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  if (text.empty() || code != std::errc() || stop != end) return std::nullopt;
  return value;
}

namespace {

/// Number of a point from 1, as tables print it, to its index.
std::optional<std::size_t> point_index(string_view text) {
  std::size_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  if (code != std::errc() || stop != end || value == 0) return std::nullopt;
  return value - 1;
}

Result<double> heading_of(string_view text, const char* option) {
  const auto deg = typed_number(text);
  if (!deg || !std::isfinite(*deg)) {
    return fail(bad_option(in_quotes(text) + " is no heading", option, kHeadingHint));
  }
  return *deg * kOneDegree;
}

Result<double> curvature_of_radius(double radius, const char* option) {
  const bool fits = !std::isnan(radius) && std::isfinite(1.0 / radius);
  if (!fits) return fail(bad_option("the radius must not be 0", option, kRadiusHint));
  return 1.0 / radius;
}

/// One value, or the range of those that do.
struct ValueOrRange {
  std::optional<double> value;
  std::optional<ValueRange> range;
};

constexpr string_view kTo = "..";

bool is_range(string_view text) { return text.find(kTo) != string_view::npos; }

}  // namespace

std::optional<ValueRange> typed_range(string_view text) {
  if (!is_range(text)) return std::nullopt;
  const std::size_t at = text.find(kTo);
  const string_view from = text.substr(0, at), to = text.substr(at + kTo.size());
  ValueRange out;
  if (!from.empty()) {
    const auto low = typed_number(from);
    if (!low) return std::nullopt;
    out.low = *low;
  }
  if (!to.empty()) {
    const auto high = typed_number(to);
    if (!high) return std::nullopt;
    out.high = *high;
  }
  const bool none = from.empty() && to.empty();
  if (none || out.empty() || std::isnan(out.low) || std::isnan(out.high)) return std::nullopt;
  return out;
}

namespace {

Error no_range(string_view text, const char* option, const char* hint) {
  return bad_option(in_quotes(text) + " is no range", option, hint);
}

Result<ValueOrRange> headings_of(string_view text, const char* option) {
  if (!is_range(text)) {
    return heading_of(text, option).map([](double value) { return ValueOrRange{value, {}}; });
  }
  const auto degrees = typed_range(text);
  if (!degrees || !(degrees->high - degrees->low <= 180.0)) {
    return fail(no_range(text, option, "write LOW..HIGH in degrees, at most 180 apart"));
  }
  return ValueOrRange{{}, ValueRange{degrees->low * kOneDegree, degrees->high * kOneDegree}};
}

Result<double> radius_value(string_view text, const char* option) {
  const auto radius = typed_number(text);
  if (!radius) return fail(bad_option(in_quotes(text) + " is no radius", option, kRadiusHint));
  return curvature_of_radius(*radius, option);
}

Result<ValueOrRange> radii_of(string_view text, const char* option) {
  if (!is_range(text)) {
    return radius_value(text, option).map([](double value) { return ValueOrRange{value, {}}; });
  }
  const auto radii = typed_range(text);
  const auto kappas = radii ? curvatures_of_radii(*radii) : std::nullopt;
  if (!kappas) {
    return fail(no_range(text, option, "write LOW..HIGH, LOW.. or ..HIGH, ends of one sign"));
  }
  return ValueOrRange{{}, kappas};
}

Result<void> set_end_heading(const std::string& typed, const char* option,
                             std::optional<double>& theta, std::optional<ValueRange>& thetas) {
  // The natural end is what nothing fixes.
  if (typed.empty() || typed == "natural") return {};
  return headings_of(typed, option).map([&](const ValueOrRange& one) {
    theta = one.value;
    thetas = one.range;
  });
}

Result<void> set_end_radius(const std::string& typed, const char* option,
                            std::optional<double>& kappa, std::optional<ValueRange>& kappas) {
  if (typed.empty()) return {};
  return radii_of(typed, option).map([&](const ValueOrRange& one) {
    kappa = one.value;
    kappas = one.range;
  });
}

Result<void> set_noise(const std::string& typed, FitJob& job) {
  if (typed.empty()) return {};
  if (typed == "rounding") {
    job.noise_from_rounding = true;
    return {};
  }
  if (typed == "auto") {
    job.noise_from_scatter = true;
    return {};
  }
  const auto noise = typed_number(typed);
  if (!noise || !std::isfinite(*noise) || *noise < 0.0) {
    return fail(bad_option(
        "the noise must be a length, rounding or auto, not " + in_quotes(typed), "--noise",
        with_point(typed) + "give how far a point may move in input units; rounding is half a "
                            "unit of the last printed digit, auto is estimated from the points"));
  }
  if (*noise > 0.0) job.noise = noise;
  return {};
}

Result<void> set_closing(const TypedValues& typed, FitJob& job) {
  if (typed.closed && typed.open) {
    return fail(bad_option("--closed and --open contradict each other", "", "give one of them"));
  }
  const bool ends = job.start_heading || job.end_heading || job.start_kappa || job.end_kappa ||
                    job.start_thetas || job.end_thetas || job.start_kappas || job.end_kappas;
  if (typed.closed && ends) {
    return fail(bad_option("a closed contour has no ends to fix", "--closed",
                           "use --heading-at, --radius-at or --kappa-at"));
  }
  if (typed.closed) job.closing = Closing::kClosed;
  if (typed.open) job.closing = Closing::kOpen;
  return {};
}

Result<void> set_corners(const TypedValues& typed, FitJob& job) {
  job.find_corners = !typed.no_corners;
  if (!typed.corner_angle_deg) return {};
  if (typed.no_corners) {
    return fail(bad_option("--no-corners and --corner-angle contradict each other", "",
                           "give one of them"));
  }
  if (!(*typed.corner_angle_deg > 0.0 && *typed.corner_angle_deg < 180.0)) {
    return fail(bad_option("the angle must lie between 0 and 180 degrees", "--corner-angle",
                           "20 degrees is usual"));
  }
  job.corner_angle = *typed.corner_angle_deg * kOneDegree;
  return {};
}

PointConstraint& constraint_at(std::vector<PointConstraint>& constraints, std::size_t index) {
  const auto place = std::lower_bound(
      constraints.begin(), constraints.end(), index,
      [](const PointConstraint& constraint, std::size_t i) { return constraint.index < i; });
  if (place != constraints.end() && place->index == index) return *place;
  PointConstraint constraint;
  constraint.index = index;
  return *constraints.insert(place, constraint);
}

/// Where a value, and where a range belongs.
struct ConstraintField {
  std::optional<double> PointConstraint::*value;
  std::optional<ValueRange> PointConstraint::*range;
};
constexpr ConstraintField kHeadingField{&PointConstraint::theta, &PointConstraint::thetas};
constexpr ConstraintField kCurvatureField{&PointConstraint::kappa, &PointConstraint::kappas};

/// "I=VALUE" at each point; `read` makes a value or range of the text.
template <class Read>
Result<void> set_at(const std::vector<std::string>& typed, const char* option,
                    ConstraintField field, FitJob& job, Read&& read) {
  for (const std::string& text : typed) {
    const std::size_t equals = std::min(text.find('='), text.size());
    const auto index = point_index(string_view(text).substr(0, equals));
    if (!index || equals == text.size()) {
      return fail(bad_option(in_quotes(text) + " does not name a point and its value", option,
                             "write I=VALUE, points count from 1, as in 5=90"));
    }
    const Result<ValueOrRange> one = read(string_view(text).substr(equals + 1));
    OBVID_TRY(one);
    PointConstraint& constraint = constraint_at(job.constraints, *index);
    if (constraint.*(field.value) || constraint.*(field.range)) {
      return fail(bad_option("point " + std::to_string(*index + 1) + " is given twice", option,
                             "give each point one heading and one radius or curvature"));
    }
    constraint.*(field.value) = one->value;
    constraint.*(field.range) = one->range;
  }
  return {};
}

Result<ValueOrRange> kappas_of(string_view text) {
  if (is_range(text)) {
    const auto kappas = typed_range(text);
    if (kappas) return ValueOrRange{{}, kappas};
    return fail(no_range(text, "--kappa-at", "write LOW..HIGH, LOW.. or ..HIGH"));
  }
  const auto kappa = typed_number(text);
  if (kappa && std::isfinite(*kappa)) return ValueOrRange{kappa, {}};
  return fail(bad_option(in_quotes(text) + " is no curvature", "--kappa-at",
                         "one over the radius, positive turns left, 0 is straight"));
}

Result<void> set_corner_at(const std::vector<std::string>& typed, FitJob& job) {
  for (const std::string& text : typed) {
    const auto index = point_index(text);
    if (!index) {
      return fail(bad_option(in_quotes(text) + " is no number of a point", "--corner-at",
                             "points count from 1"));
    }
    constraint_at(job.constraints, *index).corner = true;
  }
  return {};
}

Result<void> set_constraints(const TypedValues& typed, FitJob& job) {
  return set_at(typed.heading_at, "--heading-at", kHeadingField, job,
                [](string_view text) { return headings_of(text, "--heading-at"); })
      .and_then([&] {
        return set_at(typed.radius_at, "--radius-at", kCurvatureField, job,
                      [](string_view text) { return radii_of(text, "--radius-at"); });
      })
      .and_then(
          [&] { return set_at(typed.kappa_at, "--kappa-at", kCurvatureField, job, kappas_of); })
      .and_then([&] { return set_corner_at(typed.corner_at, job); });
}

}  // namespace

Error bad_option(std::string what, std::string where, std::string hint) {
  return {ErrorCode::kBadOption, std::move(what), std::move(where), std::move(hint)};
}

Error unknown_name(const std::string& typed, const std::vector<std::string>& names,
                   const char* option) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "available are " : ", ") + name;
  return bad_option("unknown name '" + typed + "'", option, did_you_mean(typed, names, all));
}

Result<Carrier> carrier_named(const std::string& typed) {
  const auto carrier = carrier_of(typed);
  if (carrier && info_of(*carrier).needs != CarrierNeeds::kDrawing) return *carrier;
  std::vector<std::string> names;
  std::string all;
  for (const Carrier one : kAllCarriers) {
    names.emplace_back(to_string(one));
    all += (all.empty() ? "available are " : ", ") + names.back();
  }
  return fail(
      bad_option("unknown carrier '" + typed + "'", "--carrier", did_you_mean(typed, names, all)));
}

Result<void> set_tolerance(const std::optional<double>& tolerance, FitJob& job) {
  if (tolerance && !(*tolerance > 0.0 && std::isfinite(*tolerance))) {
    return fail(bad_option("the tolerance must be a positive length", "--tolerance",
                           "give it in the units of the input"));
  }
  job.tolerance = tolerance;
  return {};
}

namespace {

Result<void> set_prefer(const std::string& typed, FitJob& job) {
  static const std::map<std::string, Prefer> kNames{{"fair", Prefer::kFair},
                                                    {"centre", Prefer::kCentre},
                                                    {"least-change", Prefer::kLeastChange},
                                                    {"least-curvature", Prefer::kLeastCurvature}};
  return value_named(kNames, typed, "--prefer").map([&](Prefer one) { job.prefer = one; });
}

Result<void> set_continuity(const std::string& typed, FitJob& job) {
  if (typed.empty()) return {};
  const auto continuity = continuity_of(typed);
  if (!continuity) return fail(unknown_name(typed, {"G2", "G3"}, "--continuity"));
  job.continuity = *continuity;
  return {};
}

}  // namespace

bool has_both_headings(const FitJob& job) {
  const auto at = [&](std::size_t point) {
    return std::any_of(
        job.constraints.begin(), job.constraints.end(), [&](const PointConstraint& constraint) {
          return constraint.index == point && (constraint.theta || constraint.thetas);
        });
  };
  return (job.start_heading || job.start_thetas || at(0)) &&
         (job.end_heading || job.end_thetas || at(1));
}

Result<void> set_values(const TypedValues& typed, FitJob& job) {
  return set_end_heading(typed.start_heading, "--start-heading", job.start_heading,
                         job.start_thetas)
      .and_then([&] {
        return set_end_heading(typed.end_heading, "--end-heading", job.end_heading, job.end_thetas);
      })
      .and_then([&] {
        return set_end_radius(typed.start_radius, "--start-radius", job.start_kappa,
                              job.start_kappas);
      })
      .and_then([&] {
        return set_end_radius(typed.end_radius, "--end-radius", job.end_kappa, job.end_kappas);
      })
      .and_then([&] { return set_noise(typed.noise, job); })
      .and_then([&] { return set_closing(typed, job); })
      .and_then([&] { return set_corners(typed, job); })
      .and_then([&] { return set_constraints(typed, job); })
      .and_then([&] { return set_continuity(typed.continuity, job); })
      .and_then([&] { return set_prefer(typed.prefer, job); });
}

}  // namespace obvid
