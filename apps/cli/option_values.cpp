// SPDX-License-Identifier: Apache-2.0
#include "option_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>

#include "obvid/geom/angle.h"

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

/// The whole text as a number; nothing for anything else.
std::optional<double> number(string_view text) {
  if (text.starts_with("+")) text.remove_prefix(1);
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  if (text.empty() || code != std::errc() || stop != end) return std::nullopt;
  return value;
}

/// Number of a point from 1, as tables print it, to its index.
std::optional<std::size_t> point_index(string_view text) {
  std::size_t value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, code] = std::from_chars(text.data(), end, value);
  if (code != std::errc() || stop != end || value == 0) return std::nullopt;
  return value - 1;
}

Result<double> heading_of(string_view text, const char* option) {
  const auto deg = number(text);
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

Result<void> set_end_heading(const std::string& typed, const char* option,
                             std::optional<double>& theta) {
  // The natural end is what nothing fixes.
  if (typed.empty() || typed == "natural") return {};
  return heading_of(typed, option).map([&](double value) { theta = value; });
}

Result<void> set_end_radius(std::optional<double> radius, const char* option,
                            std::optional<double>& kappa) {
  if (!radius) return {};
  return curvature_of_radius(*radius, option).map([&](double value) { kappa = value; });
}

Result<void> set_noise(const std::string& typed, FitJob& job) {
  if (typed.empty()) return {};
  if (typed == "rounding") {
    job.noise_from_rounding = true;
    return {};
  }
  const auto noise = number(typed);
  if (!noise || !std::isfinite(*noise) || *noise < 0.0) {
    return fail(bad_option(
        "the noise must be a length or the word rounding, not " + in_quotes(typed), "--noise",
        "give how far a point may move in input units; rounding is half a unit "
        "of the last printed digit"));
  }
  if (*noise > 0.0) job.noise = noise;
  return {};
}

Result<void> set_closing(const TypedValues& typed, FitJob& job) {
  if (typed.closed && typed.open) {
    return fail(bad_option("--closed and --open contradict each other", "", "give one of them"));
  }
  const bool ends = job.start_heading || job.end_heading || job.start_kappa || job.end_kappa;
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

PointWish& wish_at(std::vector<PointWish>& wishes, std::size_t index) {
  const auto place =
      std::lower_bound(wishes.begin(), wishes.end(), index,
                       [](const PointWish& wish, std::size_t i) { return wish.index < i; });
  if (place != wishes.end() && place->index == index) return *place;
  PointWish wish;
  wish.index = index;
  return *wishes.insert(place, wish);
}

/// "I=VALUE" at each point; `read` makes a value of the text, `field` says where it belongs.
template <class Read>
Result<void> set_at(const std::vector<std::string>& typed, const char* option,
                    std::optional<double> PointWish::*field, FitJob& job, Read&& read) {
  for (const std::string& text : typed) {
    const std::size_t equals = std::min(text.find('='), text.size());
    const auto index = point_index(string_view(text).substr(0, equals));
    if (!index || equals == text.size()) {
      return fail(bad_option(in_quotes(text) + " does not name a point and its value", option,
                             "write I=VALUE, points count from 1, as in 5=90"));
    }
    const Result<double> value = read(string_view(text).substr(equals + 1));
    if (!value) return fail(value.error());
    std::optional<double>& place = wish_at(job.wishes, *index).*field;
    if (place) {
      return fail(bad_option("point " + std::to_string(*index + 1) + " is given twice", option,
                             "give each point one heading and one radius or curvature"));
    }
    place = *value;
  }
  return {};
}

Result<double> radius_value(string_view text) {
  const auto radius = number(text);
  if (!radius) {
    return fail(bad_option(in_quotes(text) + " is no radius", "--radius-at", kRadiusHint));
  }
  return curvature_of_radius(*radius, "--radius-at");
}

Result<double> kappa_value(string_view text) {
  const auto kappa = number(text);
  if (kappa && std::isfinite(*kappa)) return *kappa;
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
    wish_at(job.wishes, *index).corner = true;
  }
  return {};
}

Result<void> set_wishes(const TypedValues& typed, FitJob& job) {
  return set_at(typed.heading_at, "--heading-at", &PointWish::theta, job,
                [](string_view text) { return heading_of(text, "--heading-at"); })
      .and_then([&] {
        return set_at(typed.radius_at, "--radius-at", &PointWish::kappa, job, radius_value);
      })
      .and_then(
          [&] { return set_at(typed.kappa_at, "--kappa-at", &PointWish::kappa, job, kappa_value); })
      .and_then([&] { return set_corner_at(typed.corner_at, job); });
}

}  // namespace

Error bad_option(std::string what, std::string where, std::string hint) {
  return {ErrorCode::kBadOption, std::move(what), std::move(where), std::move(hint)};
}

Result<void> set_values(const TypedValues& typed, FitJob& job) {
  return set_end_heading(typed.start_heading, "--start-heading", job.start_heading)
      .and_then(
          [&] { return set_end_heading(typed.end_heading, "--end-heading", job.end_heading); })
      .and_then(
          [&] { return set_end_radius(typed.start_radius, "--start-radius", job.start_kappa); })
      .and_then([&] { return set_end_radius(typed.end_radius, "--end-radius", job.end_kappa); })
      .and_then([&] { return set_noise(typed.noise, job); })
      .and_then([&] { return set_closing(typed, job); })
      .and_then([&] { return set_corners(typed, job); })
      .and_then([&] { return set_wishes(typed, job); });
}

}  // namespace obvid
