// SPDX-License-Identifier: Apache-2.0
#include "read_streamsurfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "number_rows.h"
#include "obvid/core/internal/questions.h"
#include "obvid/core/units.h"
#include "text_digits.h"
#include "text_lines.h"
#include "text_number.h"

namespace obvid {
namespace {

using std::string_view;

constexpr std::array<string_view, 5> kCounts = {"JM", "NS", "NB", "JLE", "JTE"};
constexpr double kMostPlaces = 1e6;
constexpr string_view kUnitPhrase = "dimensions are in ";

/// What is told of a surface, in this order: a word of the title, and one that is not in it.
struct Told {
  string_view word, never;
};
constexpr std::array<Told, 4> kTold = {
    {{"axial", "theta"}, {"theta", "thickness"}, {"thickness", "axial"}, {"radius", "theta"}}};
enum : std::size_t { kAxial, kArc, kThickness, kRadius };

std::string small(string_view line) {
  std::string out(line);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

bool is_title_of(string_view line, const Told& told) {
  const std::string title = small(line);
  return title.find(told.word) != std::string::npos && title.find(told.never) == std::string::npos;
}

bool names_counts(const text::Fields& fields) {
  return fields.count == kCounts.size() &&
         std::equal(kCounts.begin(), kCounts.end(), fields.cell.begin());
}

struct Counts {
  std::size_t places = 0, surfaces = 0, first = 0, last = 0;  ///< first, last: of the blade, from 1
};

class StreamsurfaceReader {
 public:
  /// Where the watch says stop, the text seems to end there.
  StreamsurfaceReader(string_view text, string_view name, Watch* watch)
      : name_(name), cursor_(text), watch_(watch), questions_(watch) {}

  /// Moves behind the next line of counts; nothing: there is none.
  [[nodiscard]] std::optional<std::array<double, 5>> next_counts() {
    while (next()) {
      if (!names_counts(fields_)) continue;
      std::array<double, 5> counts{};
      if (!next() || fields_.count != counts.size()) continue;
      bool good = true;
      for (std::size_t k = 0; k < counts.size(); ++k) {
        const auto number = number_at(k);
        good = good && number;
        counts[k] = number.value_or(0.0);
      }
      if (good) return counts;
    }
    return std::nullopt;
  }

  /// Likewise, of the last ones.
  [[nodiscard]] std::optional<std::array<double, 5>> last_counts() {
    std::optional<std::array<double, 5>> found;
    text::LineCursor behind = cursor_;
    while (const auto counts = next_counts()) {
      found = counts;
      behind = cursor_;
    }
    cursor_ = behind;
    return found;
  }

  /// The next line that begins with a word; numbers before it are an error.
  [[nodiscard]] Result<string_view> title() {
    if (!next()) return ended();
    if (number_at(0)) return wrong(ErrorCode::kBadCount, "more numbers than places stand here");
    return line_;
  }

  [[nodiscard]] Result<std::vector<double>> numbers(std::size_t count) {
    std::vector<double> out;
    while (out.size() < count) {
      if (!next()) return ended();
      for (std::size_t k = 0; k < fields_.count; ++k) {
        const auto number = number_at(k);
        if (!number) {
          return wrong(ErrorCode::kBadNumber, text::shown(fields_.cell[k]) + " is not a number");
        }
        digits_.add(text::digits_of(fields_.cell[k]));
        out.push_back(*number);
      }
    }
    if (out.size() > count) {
      return wrong(ErrorCode::kBadCount,
                   fmt::format("{} numbers where {} places are told", out.size(), count));
    }
    return out;
  }

  [[nodiscard]] tl::unexpected<Error> wrong(ErrorCode code, std::string what) const {
    return fail(error_at(code, std::move(what), name_, line_number_));
  }
  /// Half a unit of the last digit of what was read since it was asked last.
  [[nodiscard]] double rounding() {
    return 0.5 * std::pow(10.0, std::exchange(digits_, {}).unit());
  }

 private:
  /// The next line that is not empty.
  bool next() {
    while (!cursor_.at_end() && !questions_.end()) {
      const string_view whole = cursor_.peek();
      line_number_ = cursor_.line_number();
      cursor_.skip(whole);
      line_ = text::trim(whole);
      text::split(line_, text::Separator::kWhite, fields_);
      if (fields_.count > 0 && !line_.empty()) return true;
    }
    return false;
  }

  [[nodiscard]] std::optional<double> number_at(std::size_t k) const {
    const text::ParsedNumber number = text::parse_number(fields_.cell[k], false);
    if (number.kind != text::NumberKind::kNumber) return std::nullopt;
    return number.value;
  }

  [[nodiscard]] tl::unexpected<Error> ended() const {
    if (has_ended(watch_)) return fail(cancelled_error());
    return wrong(ErrorCode::kBadCount, "the text ends before all surfaces are told");
  }

  string_view name_;
  text::LineCursor cursor_;
  string_view line_;
  text::Fields fields_;
  std::size_t line_number_ = 0;
  text::ColumnDigits digits_;
  Watch* watch_;
  Questions questions_;
};

std::optional<Counts> counts_of(const std::array<double, 5>& numbers) {
  for (const double n : numbers) {
    if (!(n >= 1.0 && n <= kMostPlaces && n == std::floor(n))) return std::nullopt;
  }
  const auto count = [&](std::size_t k) { return static_cast<std::size_t>(numbers[k]); };
  const Counts out{count(0), count(1), count(3), count(4)};
  if (!(out.first < out.last && out.last <= out.places)) return std::nullopt;
  return out;
}

struct ToldSurface {
  std::array<std::vector<double>, kTold.size()> values;
  std::array<double, kTold.size()> rounding{};  ///< of each block, by its digits and its scale
};

/// Lines of words before the first title belong to the surface: its number.
Result<ToldSurface> surface_in(StreamsurfaceReader& reader, std::size_t places) {
  ToldSurface out;
  for (std::size_t k = 0; k < kTold.size(); ++k) {
    auto title = reader.title();
    OBVID_TRY(title);
    while (k == kAxial && !is_title_of(*title, kTold[k])) {
      title = reader.title();
      OBVID_TRY(title);
    }
    if (!is_title_of(*title, kTold[k])) {
      return reader.wrong(ErrorCode::kBadCount,
                          fmt::format("{} stands where the {} is due", text::shown(*title),
                                      k == kArc ? "arc radius * theta" : kTold[k].word));
    }
    const auto scale = reader.numbers(1);
    OBVID_TRY(scale);
    (void)reader.rounding();  // the scale is exact
    auto values = reader.numbers(places);
    OBVID_TRY(values);
    out.rounding[k] = std::abs(scale->front()) * reader.rounding();
    for (double& v : *values) v *= scale->front();
    out.values[k] = std::move(*values);
  }
  return out;
}

std::string first_word(string_view rest) {
  const auto end =
      std::find_if(rest.begin(), rest.end(), [](unsigned char c) { return std::isalpha(c) == 0; });
  return {rest.begin(), end};
}

Units units_told(string_view text) {
  const std::string all = small(text);
  const std::size_t at = all.find(kUnitPhrase);
  if (at == std::string::npos) return {};
  auto unit = canonical_unit(first_word(string_view(all).substr(at + kUnitPhrase.size())));
  return unit ? Units(std::move(*unit)) : Units{};
}

}  // namespace

bool is_on_streamsurfaces(string_view text) {
  if (text.find(kCounts.back()) == string_view::npos) return false;
  return StreamsurfaceReader(text, "", nullptr).next_counts().has_value();
}

Result<std::vector<SpaceSeries>> parse_streamsurfaces(string_view text, string_view name,
                                                      const RunContext& run) {
  Watch watch(run);
  StreamsurfaceReader reader(text, name, &watch);
  const auto numbers = reader.last_counts();
  if (watch.was_cancelled()) return fail(cancelled_error());
  const auto counts = numbers ? counts_of(*numbers) : std::nullopt;
  if (!counts) {
    return error(ErrorCode::kBadCount, "JM NS NB JLE JTE are no counts of a blade on surfaces")
        .where(std::string(name))
        .hint("the blade lies from place JLE to JTE of JM on each of NS surfaces");
  }
  const Units units = units_told(text);
  std::vector<SpaceSeries> sections;
  for (std::size_t k = 0; k < counts->surfaces; ++k) {
    const auto told = surface_in(reader, counts->places);
    OBVID_TRY(told);
    SpaceSeries section{fmt::format("surface {}", k + 1), {}};
    section.units = units;
    const auto& values = told->values;
    double most_arc = 0.0;  // over the radius: rad
    const auto point = [&](std::size_t i, double arc) {
      const double r = values[kRadius][i], theta = arc / r;
      most_arc = std::max(most_arc, std::abs(theta));
      return Vec3{values[kAxial][i], r * std::sin(theta), r * std::cos(theta)};
    };
    for (std::size_t i = counts->first - 1; i < counts->last; ++i) {
      if (!(values[kRadius][i] > 0.0)) {
        return reader.wrong(ErrorCode::kBadNumber,
                            fmt::format("the radius of place {} is not greater than 0", i + 1));
      }
    }
    for (std::size_t i = counts->last; i-- > counts->first - 1;) {
      section.points.push_back(point(i, values[kArc][i]));
    }
    for (std::size_t i = counts->first - 1; i < counts->last; ++i) {
      const double thick = values[kThickness][i];
      if (i + 1 == counts->first && thick == 0.0) continue;  // both sides begin in one point
      section.points.push_back(point(i, values[kArc][i] - thick));
    }
    // arc, thickness and radius are rounded; the angle is the arc over the radius
    const auto& half = told->rounding;
    const double across = half[kArc] + half[kThickness] + half[kRadius] * (1.0 + most_arc);
    section.rounding = {half[kAxial], across, across};
    sections.push_back(std::move(section));
  }
  return sections;
}

}  // namespace obvid
