// SPDX-License-Identifier: Apache-2.0
#include "plane/canvas.h"

#include <algorithm>
#include <cmath>

#include "obvid/core/internal/shown_text.h"

namespace obvid {
namespace {

/// Coordinates are kept within this many px, so that no viewer meets an overflow.
constexpr double kFarthestPx = 1e6;

void append_px(std::string& text, double value) {
  const double kept = std::isfinite(value) ? std::clamp(value, -kFarthestPx, kFarthestPx) : 0.0;
  long hundredths = std::lround(kept * 100.0);
  if (hundredths < 0) {
    text += '-';
    hundredths = -hundredths;
  }
  const long rest = hundredths % 100;
  text += std::to_string(hundredths / 100);
  if (rest == 0) return;
  text += '.';
  text += static_cast<char>('0' + rest / 10);
  if (rest % 10 != 0) text += static_cast<char>('0' + rest % 10);
}

}  // namespace

std::string px(double value) {
  std::string text;
  append_px(text, value);
  return text;
}

void PictureCanvas::label(Vec2 at, std::string_view anchor, std::string_view css,
                          std::string_view text) {
  add("<text x=\"{}\" y=\"{}\" class=\"{}\"", px(at.x), px(at.y), css);
  if (anchor != "start") add(" text-anchor=\"{}\"", anchor);
  add(">{}</text>\n", escaped_xml(text));
}

void PictureCanvas::verdict(Vec2 at, std::string_view css, std::string_view text, double room) {
  constexpr double kSize = 14.0;        // px, as the style of the sheet says
  constexpr double kBoldLetter = 0.62;  // of it: no sentence in bold letters is wider a letter
  const double width = kBoldLetter * kSize * static_cast<double>(text.size());
  if (width <= room) return label(at, "start", fmt::format("verdict {}", css), text);
  add("<text x=\"{}\" y=\"{}\" class=\"verdict {}\" style=\"font-size:{}px\">{}</text>\n", px(at.x),
      px(at.y), css, px(kSize * room / width), escaped_xml(text));
}

void PictureCanvas::line(Vec2 a, Vec2 b, std::string_view css) {
  add("<path class=\"{}\" d=\"M{} {}L{} {}\"/>\n", css, px(a.x), px(a.y), px(b.x), px(b.y));
}

void PicturePath::number(double value) { append_px(text_, value); }

void PicturePath::pair(char command, Vec2 p) {
  text_ += command;
  number(p.x);
  text_ += ' ';
  number(p.y);
}

void PicturePath::move(Vec2 p) {
  pair('M', p);
  at_ = p;
}

void PicturePath::line(Vec2 p) {
  pair('L', p);
  at_ = p;
}

void PicturePath::cubic(Vec2 a, Vec2 b, Vec2 end) {
  pair('C', a);
  pair(' ', b);
  pair(' ', end);
  at_ = end;
}

void PicturePath::thin_line(Vec2 p, double step) {
  if (std::fabs(p.x - at_.x) + std::fabs(p.y - at_.y) >= step) line(p);
}

}  // namespace obvid
