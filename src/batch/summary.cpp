// SPDX-License-Identifier: Apache-2.0
#include "summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "obvid/core/error.h"

namespace obvid::batch {
namespace {

void count_into(Histogram& histogram, const Column* column, std::size_t row, const Column* less) {
  const double value = column == nullptr ? kUnknownCount : column->numbers[row];
  const double other = less == nullptr ? 0.0 : less->numbers[row];
  if (value < 0.0 || other < 0.0) {
    ++histogram.unknown;
  } else {
    ++histogram.classes[static_cast<int>(value - other)];
  }
}

/// Classes of a tenth of a decade would be too many for a picture: thirds.
constexpr double kClassesOfDecade = 3.0;
constexpr int kZeroLength = -1000;  // the class of lengths that are 0

void length_into(Histogram& histogram, const Column* column, std::size_t row) {
  const double value = column == nullptr ? std::nan("") : column->numbers[row];
  if (std::isnan(value)) {
    ++histogram.unknown;
  } else if (value <= 0.0) {
    ++histogram.classes[kZeroLength];
  } else {
    ++histogram.classes[static_cast<int>(std::floor(kClassesOfDecade * std::log10(value)))];
  }
}

std::string share_of(std::size_t part, std::size_t all) {
  if (all == 0) return "";
  return fmt::format("{:.1f} %", 100.0 * static_cast<double>(part) / static_cast<double>(all));
}

std::string with_commas(std::size_t value) {
  std::string out = std::to_string(value);
  for (std::size_t at = out.size(); at > 3;) out.insert(at -= 3, ",");
  return out;
}

std::string line(const std::string& name, std::size_t count, std::size_t all,
                 const std::string& rest = "") {
  return fmt::format("{:<28}{:>12}{:>9}  {}\n", name, with_commas(count), share_of(count, all),
                     rest);
}

std::string_view title_of(int code) {
  for (const ErrorText& text : error_texts()) {
    if (static_cast<int>(text.code) == code) return text.title;
  }
  return "";
}

// Of the picture, px.
constexpr double kPanel = 300.0, kGap = 40.0, kTall = 200.0, kUp = 60.0, kMargin = 40.0;

std::string text_in_svg(double x, double y, const std::string& anchor, const std::string& text,
                        const char* size = "11") {
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\" font-size=\"{}\">{}</text>\n", x, y,
      anchor, size, text);
}

std::string class_name(int number, bool lengths) {
  if (!lengths) return std::to_string(number);
  if (number == kZeroLength) return "0";
  return fmt::format("{:.1g}", std::pow(10.0, number / kClassesOfDecade));
}

/// Bars of one histogram; far classes are gathered at both ends.
std::string panel(const Histogram& histogram, const std::string& title, bool lengths, double left) {
  constexpr std::size_t kMostBars = 24;
  std::string out = text_in_svg(left, kUp - 14, "start", title, "13");
  std::size_t most = 1, all = histogram.unknown;
  std::vector<std::pair<int, std::size_t>> bars(histogram.classes.begin(), histogram.classes.end());
  for (const auto& [number, count] : bars) all += count;
  bool gathered = false;
  while (bars.size() > kMostBars) {
    bars[bars.size() - 2].second += bars.back().second;
    bars.pop_back();
    gathered = true;
  }
  for (const auto& [number, count] : bars) most = std::max(most, count);
  const double wide = kPanel / static_cast<double>(std::max<std::size_t>(bars.size(), 1));
  for (std::size_t k = 0; k < bars.size(); ++k) {
    const double tall = kTall * static_cast<double>(bars[k].second) / static_cast<double>(most);
    const double x = left + wide * static_cast<double>(k);
    out += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
                       x + 1, kUp + kTall - tall, std::max(wide - 2, 1.0), tall);
    const bool last = k + 1 == bars.size();
    const std::size_t every = bars.size() / 8 + 1;
    if (k % every == 0 || (last && k % every > every / 2)) {
      out += text_in_svg(x + wide / 2, kUp + kTall + 16, "middle",
                         class_name(bars[k].first, lengths) + (last && gathered ? "+" : ""));
    }
  }
  out += fmt::format(
      "<line stroke=\"#1f2933\" x1=\"{0:.1f}\" y1=\"{1:.1f}\" x2=\"{2:.1f}\" y2=\"{1:.1f}\"/>\n",
      left, kUp + kTall, left + kPanel);
  out += text_in_svg(left, kUp + kTall + 36, "start",
                     fmt::format("highest {}; not known {} of {}", with_commas(most),
                                 with_commas(histogram.unknown), with_commas(all)));
  return out;
}

}  // namespace

void Summary::add(const Columns& rows) {
  const Column* const id = rows.named("id");
  const Column* const status = rows.named("status");
  const Column* const code = rows.named("code");
  const Column* const told = rows.named("warnings");
  const Column* const found = rows.named("vertices");
  const Column* const bound = rows.named("bound");
  const Column* const proof = rows.named("proved");
  const Column* const time = rows.named("seconds");
  for (std::size_t i = 0; i < rows.rows(); ++i) {
    ++items;
    ++statuses[std::min<std::size_t>(static_cast<std::size_t>(status->numbers[i]), 2)];
    if (const int number = static_cast<int>(code->numbers[i]); number != 0) {
      if (++codes[number] == 1) first_of[number] = id->texts[i];
    }
    if (proof->numbers[i] > 0.0) ++proved;
    if (!told->texts[i].empty() && ++warned == 1) first_warned = id->texts[i];
    if (found->numbers[i] >= 0.0 && bound->numbers[i] >= 0.0) {
      ++compared;
      if (found->numbers[i] <= bound->numbers[i]) ++at_bound;
    }
    seconds += time->numbers[i];
    if (time->numbers[i] > longest) {
      longest = time->numbers[i];
      longest_id = id->texts[i];
    }
    count_into(vertices, found, i, nullptr);
    count_into(above, found, i, bound);
    length_into(error, rows.named("error"), i);
  }
}

std::string summary_text(const Summary& s) {
  std::string out = line("items", s.items, s.items);
  out += line("done", s.statuses[0], s.items);
  if (s.proved > 0) out += line("  proved", s.proved, s.items);
  if (s.statuses[1] > 0) out += line("formed, promise not kept", s.statuses[1], s.items);
  if (s.statuses[2] > 0) out += line("failed", s.statuses[2], s.items);
  for (const auto& [code, count] : s.codes) {
    out += line("  E" + std::to_string(code), count, s.items,
                fmt::format("{}; first {}", title_of(code), s.first_of.at(code)));
  }
  if (s.warned > 0) {
    out += line("with warnings", s.warned, s.items, "first " + s.first_warned);
  }
  if (s.compared > 0) {
    out += line("vertices at the bound", s.at_bound, s.compared,
                "of those with one: no curve that does not wind between the points has fewer");
  }
  out += fmt::format("{:<28}{:>12.4g}{:>9}  of all items, one processor; longest {:.3g} s: {}\n",
                     "seconds", s.seconds, "", s.longest, s.longest_id);
  return out;
}

std::string histogram_svg(const Summary& s) {
  const double wide = 2 * kMargin + 3 * kPanel + 2 * kGap, tall = kUp + kTall + 60;
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" font-family=\"sans-serif\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n<g fill=\"#1f2933\">\n",
      wide, tall);
  out += text_in_svg(kMargin, 24, "start",
                     fmt::format("{} items: {} done, {} not kept, {} failed", with_commas(s.items),
                                 with_commas(s.statuses[0]), with_commas(s.statuses[1]),
                                 with_commas(s.statuses[2])),
                     "14");
  out += "</g>\n<g fill=\"#3b6ea5\" stroke=\"none\">\n";
  std::string bars =
      panel(s.vertices, "vertices", false, kMargin) +
      panel(s.above, "vertices above the bound (no winding)", false, kMargin + kPanel + kGap) +
      panel(s.error, "error bound, units", true, kMargin + 2 * (kPanel + kGap));
  // rects in one colour, words and axes in another
  std::string words;
  for (std::size_t at = 0; at < bars.size();) {
    const std::size_t end = bars.find('\n', at) + 1;
    (bars.compare(at, 5, "<rect") == 0 ? out : words) += bars.substr(at, end - at);
    at = end;
  }
  return out + "</g>\n<g fill=\"#1f2933\" stroke-width=\"1\">\n" + words + "</g>\n</svg>\n";
}

}  // namespace obvid::batch
