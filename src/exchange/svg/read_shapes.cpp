// SPDX-License-Identifier: Apache-2.0
#include "svg/read_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "svg/path_data.h"

namespace obvid::exchange {

bool SvgShape::knows(std::string_view name) {
  static constexpr std::array<std::string_view, 7> kShapes = {
      "path", "line", "polyline", "polygon", "rect", "circle", "ellipse"};
  return std::find(kShapes.begin(), kShapes.end(), name) != kShapes.end();
}

void SvgShape::draw(std::string_view name) {
  if (name == "path") path();
  if (name == "line") line();
  if (name == "polyline") polyline(false);
  if (name == "polygon") polyline(true);
  if (name == "rect") rectangle();
  if (name == "circle") circle();
  if (name == "ellipse") ellipse();
}

std::optional<double> SvgShape::given(const char* name, SvgAxis axis) {
  const std::string_view text = trimmed(node_.attribute(name).value());
  if (text.empty() || text == "auto") return std::nullopt;
  const auto value = svg_length(text, axis, viewport_);
  if (!value) {
    warnings_.leave_out(
        fmt::format("{} {}=\"{}\" is no length that can be used; taken as not given",
                    local_name(node_), name, shortened(text)),
        node_);
  }
  return value;
}

void SvgShape::path() {
  const std::string_view data = node_.attribute("d").value();
  const auto wrong = draw_path(data, out_);
  if (wrong) {
    warnings_.leave_out(fmt::format("path data have an error near \"{}\"; drawn up to there",
                                    shortened(data.substr(*wrong, 20))),
                        node_);
  }
}

void SvgShape::line() {
  out_.move_to({length("x1", SvgAxis::kX), length("y1", SvgAxis::kY)});
  out_.line_to({length("x2", SvgAxis::kX), length("y2", SvgAxis::kY)});
}

void SvgShape::polyline(bool closed) {
  const std::string_view text = node_.attribute("points").value();
  SvgScanner in(text);
  in.skip_blanks();
  while (!in.at_end()) {
    const std::size_t place = in.place();
    const auto x = in.number();
    in.skip_separator();
    const auto y = x ? in.number() : std::nullopt;
    if (!y) {
      warnings_.leave_out(fmt::format("points of a {} have an error near \"{}\"; drawn up to there",
                                      local_name(node_), shortened(text.substr(place, 20))),
                          node_);
      break;
    }
    points_.push_back({*x, *y});
    in.skip_separator();
  }
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (i == 0) out_.move_to(points_[i]);
    if (i > 0) out_.line_to(points_[i]);
  }
  if (closed && !points_.empty()) {
    out_.close();
    points_.push_back(points_.front());
  }
}

void SvgShape::rectangle() {
  const double x = length("x", SvgAxis::kX), y = length("y", SvgAxis::kY);
  const double w = length("width", SvgAxis::kX), h = length("height", SvgAxis::kY);
  const auto rx = given("rx", SvgAxis::kX), ry = given("ry", SvgAxis::kY);
  if (!(w > 0.0) || !(h > 0.0)) return;
  const double a = rx.value_or(ry.value_or(0.0)), b = ry.value_or(rx.value_or(0.0));
  if (a > 0.0 && b > 0.0) return rounded(x, y, w, h, std::min(a, 0.5 * w), std::min(b, 0.5 * h));
  out_.move_to({x, y});
  out_.line_to({x + w, y});
  out_.line_to({x + w, y + h});
  out_.line_to({x, y + h});
  out_.close();
}

/// In the order that SVG gives. Where the rounding takes a whole side, it has no straight line.
void SvgShape::rounded(double x, double y, double w, double h, double rx, double ry) {
  const auto side = [&](Vec2 p) {
    if (p != out_.here()) out_.line_to(p);
  };
  const auto corner = [&](Vec2 p) { out_.arc_to({rx, ry, 0.0, false, true, p}); };
  out_.move_to({x + rx, y});
  side({x + w - rx, y});
  corner({x + w, y + ry});
  side({x + w, y + h - ry});
  corner({x + w - rx, y + h});
  side({x + rx, y + h});
  corner({x, y + h - ry});
  side({x, y + ry});
  corner({x + rx, y});
  out_.close();
}

void SvgShape::circle() {
  const double r = length("r", SvgAxis::kDiagonal);
  whole_ellipse({length("cx", SvgAxis::kX), length("cy", SvgAxis::kY)}, r, r);
}

void SvgShape::ellipse() {
  const auto rx = given("rx", SvgAxis::kX), ry = given("ry", SvgAxis::kY);
  whole_ellipse({length("cx", SvgAxis::kX), length("cy", SvgAxis::kY)},
                rx.value_or(ry.value_or(0.0)), ry.value_or(rx.value_or(0.0)));
}

void SvgShape::whole_ellipse(Vec2 c, double rx, double ry) {
  if (!(rx > 0.0) || !(ry > 0.0)) return;
  const auto quarter = [&](double x, double y) {
    out_.arc_to({rx, ry, 0.0, false, true, c + Vec2{x, y}});
  };
  out_.move_to(c + Vec2{rx, 0.0});
  quarter(0.0, ry);
  quarter(-rx, 0.0);
  quarter(0.0, -ry);
  quarter(rx, 0.0);
  out_.close();
}

}  // namespace obvid::exchange
