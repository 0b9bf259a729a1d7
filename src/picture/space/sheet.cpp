// SPDX-License-Identifier: Apache-2.0
#include "space/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string_view>

#include "obvid/core/internal/picture_mark.h"
#include "obvid/core/internal/shown_text.h"
#include "obvid/picture/internal/styles.h"

namespace obvid::picture {
namespace {

constexpr double kAxis = 26.0;            // px, an axis parallel to the sheet
constexpr double kAxisName = 37.0;        // px, its letter
constexpr double kShortAxis = 5.0;        // px, shorter ones have no letter
constexpr double kSheetScaleBar = 130.0;  // px, widest
constexpr double kLegend = 330.0;         // px, at most
constexpr int kTicks = 6;                 // wanted
constexpr int kSheetDigits = 3;           // of numbers
/// A tick this part of a step beyond the range lies on its end.
constexpr double kSlack = 1e-9;

std::string text_at(double x, double y, std::string_view css, std::string_view anchor,
                    const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"{}\" text-anchor=\"{}\">{}</text>\n",
                     x, y, css, anchor, escaped_xml(text));
}

/// Smallest of 1, 2, 5 times a power of ten that is not less than `value` > 0.
double round_up(double value) {
  const double base = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (value <= factor * base * (1.0 + kSlack)) return factor * base;
  }
  return 10.0 * base;
}

/// Largest such number that is not greater.
double round_down(double value) {
  const double base = std::pow(10.0, std::floor(std::log10(value)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * base <= value * (1.0 + kSlack)) return factor * base;
  }
  return base;
}

std::string axes(const PictureCamera& camera, double height) {
  static constexpr std::array<const char*, 3> kInks = {"#c0392b", "#3f8a3a", "#1b6ec2"};
  static constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
  const std::array<Vec3, 3> seen = {camera.seen({1, 0, 0}), camera.seen({0, 1, 0}),
                                    camera.seen({0, 0, 1})};
  std::array<std::size_t, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return seen[a].z < seen[b].z; });
  const double x = kSheetMargin + 34.0, y = height - 38.0;
  std::string out;
  for (const std::size_t k : order) {
    const Vec3 s = seen[k];
    out += fmt::format("<path class=\"axis\" stroke=\"{}\" d=\"M{:.1f} {:.1f}l{:.1f} {:.1f}\"/>\n",
                       kInks[k], x, y, kAxis * s.x, -kAxis * s.y);
    if (kAxis * std::hypot(s.x, s.y) > kShortAxis) {
      out += text_at(x + kAxisName * s.x, y - kAxisName * s.y + 4.0, "name", "middle", kNames[k]);
    }
  }
  return out;
}

/// Its line at y.
std::string scale_bar(const SheetTexts& texts, double scale, double width, double y) {
  const double length = round_down(kSheetScaleBar / scale);
  const double right = width - kSheetMargin, left = right - length * scale;
  return fmt::format(
             "<path class=\"bar\" d=\"M{0:.1f} {1:.1f}v8M{0:.1f} {2:.1f}H{3:.1f}M{3:.1f} "
             "{1:.1f}v8\"/>\n",
             left, y - 4.0, y, right) +
         text_at(0.5 * (left + right), y - 9.0, "", "middle",
                 readable(length, kSheetDigits) + " " + texts.units);
}

/// Infinite where the quantity has no bound on that side.
std::string end_of_scale(double end) {
  return std::isfinite(end) ? readable(end, kSheetDigits) : std::string("no bound");
}

/// Bands of the colours with round numbers below.
std::string legend_bar(const ValueScale& scale, double left, double width, double y) {
  std::string out;
  for (int k = 0; k < kBands; ++k) {
    const double step = width / kBands;
    out += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"11\" fill=\"{}\"/>\n",
        left + k * step, y, step + (k + 1 < kBands ? 0.4 : 0.0),
        hex(palette(scale.diverging, (k + 0.5) / kBands)));
  }
  const double step = round_up((scale.high - scale.low) / kTicks);
  for (double k = std::ceil(scale.low / step - kSlack); k * step <= scale.high + kSlack * step;
       k += 1.0) {
    const double x = left + width * (k * step - scale.low) / (scale.high - scale.low);
    out += fmt::format("<path class=\"bar\" d=\"M{:.1f} {:.1f}v4\"/>\n", x, y + 11.0);
    out += text_at(x, y + 27.0, "", "middle", readable(k * step, kSheetDigits));
  }
  return out;
}

std::string legend(const Colours& colours, const std::string& units, double width, double height) {
  const ValueScale& scale = colours.scale;
  const double wide = std::min(kLegend, width - 2.0 * (kSheetMargin + 165.0));
  const double left = 0.5 * (width - wide), y = height - 52.0;
  const std::string head = colours.title + ", " + unit_of(colours.colouring, units);
  if (scale.constant()) {
    return text_at(0.5 * width, y - 6.0, "name", "middle", head) +
           fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"22\" height=\"11\" fill=\"{}\"/>\n",
                       0.5 * width - 60.0, y, hex(palette(scale.diverging, 0.5))) +
           text_at(0.5 * width - 30.0, y + 10.0, "", "start",
                   readable(scale.low, kSheetDigits) + " everywhere");
  }
  std::string out = text_at(0.5 * width, y - 6.0, "name", "middle", head);
  out += legend_bar(scale, left, wide, y);
  if (scale.least < scale.low || scale.most > scale.high) {
    out += text_at(
        0.5 * width, y + 40.0, "note", "middle",
        "from " + end_of_scale(scale.least) + " to " + end_of_scale(scale.most) + " in all");
  }
  return out;
}

}  // namespace

namespace {

std::string around(const SheetTexts& texts, const PictureCamera& camera, const Colours& colours,
                   const SurfacePictureOptions& options) {
  std::string out = text_at(kSheetMargin, 32.0, "title", "start", texts.title) +
                    text_at(kSheetMargin, 52.0, "facts", "start", texts.facts) +
                    axes(camera, options.height);
  if (has_scale(colours.colouring)) {
    out += legend(colours, texts.units, options.width, options.height);
  }
  return out;
}

}  // namespace

std::string sheet_furniture(const SheetTexts& texts, const PictureCamera& camera,
                            const Colours& colours, const SurfacePictureOptions& options) {
  constexpr double kBarUp = 26.0;  // px
  return around(texts, camera, colours, options) +
         scale_bar(texts, camera.scale, options.width, options.height - kBarUp);
}

std::string sheet_furniture(const SheetTexts& texts, const PictureCamera& camera,
                            const Colours& colours, const SurfacePictureOptions& options,
                            double under, const std::vector<SheetPart>& parts) {
  constexpr double kGap = 3.0, kHook = 5.0, kNumberDown = 20.0, kBarUp = 9.0, kTextUp = 12.0;  // px
  constexpr double kFactsRow = 52.0;
  std::string out = around(texts, camera, colours, options) +
                    scale_bar(texts, camera.scale, options.width, kFactsRow);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const SheetPart& part = parts[i];
    const std::string number = std::to_string(i + 1);
    out += fmt::format("<path class=\"bar\" d=\"M{0:.1f} {1:.1f}v{2:.0f}H{3:.1f}v-{2:.0f}\"/>\n",
                       part.from + kGap, under, kHook, part.to - kGap);
    out += text_at(0.5 * (part.from + part.to), under + kNumberDown, "name", "middle", number);
    out += text_at(kSheetMargin, part.top - kTextUp, "name", "start", number + ": " + part.place);
    out += scale_bar(texts, part.scale, options.width, part.top - kBarUp);
  }
  return out;
}

std::string sheet(const SheetTexts& texts, const SurfacePictureOptions& options,
                  const std::string& body) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
      "width=\"{0:.0f}\" height=\"{1:.0f}\" role=\"img\" "
      "{6}=\"{7}\">\n<title>{2}</title>\n<desc>{3}</desc>\n"
      "{4}<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"#fff\"/>\n{5}</svg>\n",
      options.width, options.height, escaped_xml(texts.title), escaped_xml(texts.facts),
      style_element(space_sheet_style()), body, kPictureAttribute, kPictureValue);
}

}  // namespace obvid::picture
