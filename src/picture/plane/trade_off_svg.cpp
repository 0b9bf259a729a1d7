// SPDX-License-Identifier: Apache-2.0
#include "obvid/picture/internal/trade_off_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plane/axis.h"
#include "plane/canvas.h"
#include "plane/frame.h"
#include "plane/panels.h"
#include "plane/sheet.h"

namespace obvid {
namespace {

constexpr double kTop = 108.0;  // px
constexpr double kTradeOffHeight = 300.0;
constexpr double kBelow = 92.0;
constexpr double kTradeOffRoom = 1.25;  // beyond the first and the last tolerance, as a ratio
constexpr double kMarkReach = 4.5;      // of the cross on a tolerance without contour, px
constexpr double kRecommended = 6.0;    // half a diagonal of the recommended row's mark, px
constexpr double kLegendLine = 26.0;    // px
constexpr double kLegendApart = 210.0;  // px
constexpr int kVertexTicks = 6;

PictureFrame frame_of(const TradeOff& t) {
  PictureFrame frame;
  frame.top = kTop;
  frame.bottom = kTop + kTradeOffHeight;
  int most = 1;
  for (const TradeOffRow& row : t.rows) {
    if (row.formed) most = std::max({most, row.vertices, row.vertices_lower_bound});
  }
  // whole vertices: no more ticks than there are, and room above the first step
  frame.y = round_axis(0.0, most + 0.5, std::min(kVertexTicks, most + 1));
  const double low = t.rows.empty() ? 1.0 : t.rows.front().tolerance;
  const double high = t.rows.empty() ? 1.0 : t.rows.back().tolerance;
  frame.x = log_axis(low / kTradeOffRoom, high * kTradeOffRoom);
  return frame;
}

/// What a tolerance brings holds until the next larger one was tried: steps.
void draw_steps(PictureCanvas& canvas, const PictureFrame& frame, const TradeOff& t,
                int TradeOffRow::*value, const char* css) {
  PicturePath path;
  bool open = false;
  for (std::size_t i = 0; i < t.rows.size(); ++i) {
    const TradeOffRow& row = t.rows[i];
    if (!row.formed) {
      open = false;
      continue;
    }
    const double y = frame.px_y(row.*value);
    const Vec2 from{frame.px_x(row.tolerance), y};
    if (open) {
      path.line(from);
    } else {
      path.move(from);
    }
    const bool last = i + 1 == t.rows.size();
    path.line({last ? frame.right : frame.px_x(t.rows[i + 1].tolerance), y});
    open = true;
  }
  if (!path.empty()) canvas.add("<path class=\"{}\" d=\"{}\"/>\n", css, path.text());
}

void draw_rows(PictureCanvas& canvas, const PictureFrame& frame, const TradeOff& t) {
  PicturePath crosses;
  for (std::size_t i = 0; i < t.rows.size(); ++i) {
    const TradeOffRow& row = t.rows[i];
    const double x = frame.px_x(row.tolerance), y = frame.px_y(row.formed ? row.vertices : 0.0);
    if (!row.kept) {
      crosses.move({x - kMarkReach, y - kMarkReach});
      crosses.line({x + kMarkReach, y + kMarkReach});
      crosses.move({x - kMarkReach, y + kMarkReach});
      crosses.line({x + kMarkReach, y - kMarkReach});
    } else if (t.recommended == i) {
      canvas.add("<path class=\"vertex\" d=\"M{0} {1}L{2} {3}L{0} {4}L{5} {3}Z\"/>\n", px(x),
                 px(y - kRecommended), px(x + kRecommended), px(y), px(y + kRecommended),
                 px(x - kRecommended));
    } else {
      canvas.add("<path class=\"dot\" stroke-width=\"6\" d=\"M{0} {1}h0\"/>\n", px(x), px(y));
    }
  }
  if (!crosses.empty()) canvas.add("<path class=\"limit\" d=\"{}\"/>\n", crosses.text());
}

void draw_legend(PictureCanvas& canvas, const TradeOff& t, double y) {
  double x = kPictureMargin;
  const auto entry = [&](const char* css, const char* text) {
    canvas.line({x, y - 4.0}, {x + kLegendLine, y - 4.0}, css);
    canvas.label({x + kLegendLine + 8.0, y}, "start", "small", text);
    x += kLegendApart;
  };
  entry("graph up", "vertices of the contour");
  entry("curve down", "at least, unless a curve winds");
  if (std::any_of(t.rows.begin(), t.rows.end(), [](const auto& row) { return !row.kept; })) {
    entry("limit", fmt::format("cross: no {}", kept_contour(t)).c_str());
  }
}

std::string recommendation(const TradeOff& t) {
  if (!t.recommended) return fmt::format("No tolerance gave a {}.", kept_contour(t));
  const TradeOffRow& row = t.rows[*t.recommended];
  return "Recommended (diamond): " + row.option + ", " + std::to_string(row.vertices) +
         (row.vertices == 1 ? " vertex" : " vertices");
}

}  // namespace

std::string trade_off_svg(const TradeOff& t) {
  const std::string title =
      "Tolerance and vertices" + (t.name.empty() ? std::string{} : " · " + t.name);
  PictureFrame frame = frame_of(t);
  PictureCanvas body;
  body.label({kPictureMargin, 40.0}, "start", "title", title);
  body.label({kPictureMargin, 62.0}, "start", "fact", recommendation(t));
  body.label({kPictureMargin, frame.top - 14.0}, "start", "axis-title", "Vertices");
  draw_grid(body, frame, true);
  draw_steps(body, frame, t, &TradeOffRow::vertices_lower_bound, "curve down");
  draw_steps(body, frame, t, &TradeOffRow::vertices, "graph up");
  draw_rows(body, frame, t);
  body.label({0.5 * (frame.left + frame.right), frame.bottom + 38.0}, "middle", "axis-title",
             "Tolerance of every point, " + power_prefix(frame.x.exponent) + t.units.text() +
                 ", logarithmic");
  draw_legend(body, t, frame.bottom + 66.0);
  return picture_sheet(title, recommendation(t), body.take(), frame.bottom + kBelow);
}

}  // namespace obvid
