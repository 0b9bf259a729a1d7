// SPDX-License-Identifier: Apache-2.0
#include "svg/path_data.h"

#include <fast_float/fast_float.h>

#include <array>
#include <cmath>

namespace obvid::exchange {
namespace {

constexpr bool is_path_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
constexpr bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
constexpr char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; }

/// Draws one segment after the other until the data end or one is wrong.
class PathReader {
 public:
  PathReader(std::string_view data, SvgPathBuilder& builder) : in_(data), out_(builder) {}

  std::optional<std::size_t> run() {
    in_.skip_blanks();
    while (!in_.at_end()) {
      const std::size_t place = in_.place();
      const char letter = in_.peek();
      if (!is_letter(letter) || (!begun_ && upper(letter) != 'M')) return place;
      in_.skip();
      if (const auto wrong = segments(letter, place)) return wrong;
      in_.skip_blanks();
    }
    return std::nullopt;
  }

 private:
  /// One command and the segments that repeat it without its letter.
  std::optional<std::size_t> segments(char letter, std::size_t place) {
    if (upper(letter) == 'Z') {
      out_.close();
      last_ = 'Z';
      return std::nullopt;
    }
    for (bool first = true;; first = false) {
      if (first) in_.skip_blanks();
      if (!segment(letter, first)) return place;
      place = in_.place();
      const bool comma = in_.skip_separator();
      const char next = in_.peek();
      const bool more = is_digit(next) || next == '.' || next == '-' || next == '+';
      if (comma && !more) return place;
      if (!more) return std::nullopt;
      place = in_.place();
      if (letter == 'M') letter = 'L';
      if (letter == 'm') letter = 'l';
    }
  }

  bool segment(char letter, bool first) {
    const bool relative = letter >= 'a';
    const char kind = upper(letter);
    const Vec2 origin = relative ? out_.here() : Vec2{};
    bool good = true;
    switch (kind) {
      case 'M':
      case 'L':
        good = straight(kind, origin, first);
        break;
      case 'H':
      case 'V':
        good = along_axis(kind, relative);
        break;
      case 'C':
      case 'S':
        good = cubic(kind, origin);
        break;
      case 'Q':
      case 'T':
        good = quadratic(kind, origin);
        break;
      case 'A':
        good = arc(origin);
        break;
      default:
        return false;
    }
    if (good) last_ = kind;
    return good;
  }

  bool straight(char kind, Vec2 origin, bool first) {
    const auto p = points<1>(origin);
    if (!p) return false;
    if (kind == 'M' && first) {
      out_.move_to((*p)[0]);
      begun_ = true;
    } else {
      out_.line_to((*p)[0]);
    }
    return true;
  }

  bool along_axis(char kind, bool relative) {
    const auto value = in_.number();
    if (!value) return false;
    Vec2 p = out_.here();
    double& moved = kind == 'H' ? p.x : p.y;
    moved = (relative ? moved : 0.0) + *value;
    out_.line_to(p);
    return true;
  }

  bool cubic(char kind, Vec2 origin) {
    const Vec2 first = mirrored(last_ == 'C' || last_ == 'S');
    if (kind == 'C') {
      const auto p = points<3>(origin);
      if (!p) return false;
      draw_cubic((*p)[0], (*p)[1], (*p)[2]);
      return true;
    }
    const auto p = points<2>(origin);
    if (!p) return false;
    draw_cubic(first, (*p)[0], (*p)[1]);
    return true;
  }

  void draw_cubic(Vec2 q1, Vec2 q2, Vec2 p) {
    out_.cubic_to(q1, q2, p);
    control_ = q2;
  }

  bool quadratic(char kind, Vec2 origin) {
    const Vec2 smooth = mirrored(last_ == 'Q' || last_ == 'T');
    if (kind == 'Q') {
      const auto p = points<2>(origin);
      if (!p) return false;
      out_.quadratic_to((*p)[0], (*p)[1]);
      control_ = (*p)[0];
      return true;
    }
    const auto p = points<1>(origin);
    if (!p) return false;
    out_.quadratic_to(smooth, (*p)[0]);
    control_ = smooth;
    return true;
  }

  bool arc(Vec2 origin) {
    const auto rx = in_.number();
    in_.skip_separator();
    const auto ry = in_.number();
    in_.skip_separator();
    const auto rotation = in_.number();
    in_.skip_separator();
    const auto large = in_.flag();
    in_.skip_separator();
    const auto sweep = in_.flag();
    in_.skip_separator();
    const auto end = points<1>(origin);
    if (!rx || !ry || !rotation || !large || !sweep || !end) return false;
    out_.arc_to({*rx, *ry, *rotation, *large, *sweep, (*end)[0]});
    return true;
  }

  /// First control point of a smooth segment: the last one of its like, mirrored.
  [[nodiscard]] Vec2 mirrored(bool same_kind) const {
    return same_kind ? 2.0 * out_.here() - control_ : out_.here();
  }

  template <std::size_t count>
  std::optional<std::array<Vec2, count>> points(Vec2 origin) {
    std::array<Vec2, count> out;
    for (std::size_t i = 0; i < count; ++i) {
      if (i > 0) in_.skip_separator();
      const auto x = in_.number();
      in_.skip_separator();
      const auto y = in_.number();
      if (!x || !y) return std::nullopt;
      out[i] = origin + Vec2{*x, *y};
    }
    return out;
  }

  SvgScanner in_;
  SvgPathBuilder& out_;
  bool begun_ = false;
  char last_ = '\0';
  Vec2 control_;
};

}  // namespace

void SvgScanner::skip_blanks() {
  while (!at_end() && is_path_blank(text_[at_])) ++at_;
}

bool SvgScanner::skip_separator() {
  skip_blanks();
  if (peek() != ',') return false;
  ++at_;
  skip_blanks();
  return true;
}

/// End of the longest number that starts here, or here when none does.
std::size_t SvgScanner::number_end() const {
  std::size_t i = at_;
  const auto digits = [&] {
    const std::size_t from = i;
    while (i < text_.size() && is_digit(text_[i])) ++i;
    return i - from;
  };
  if (i < text_.size() && (text_[i] == '+' || text_[i] == '-')) ++i;
  std::size_t count = digits();
  if (i < text_.size() && text_[i] == '.') {
    ++i;
    count += digits();
  }
  if (count == 0) return at_;
  const std::size_t mantissa = i;
  if (i < text_.size() && (text_[i] == 'e' || text_[i] == 'E')) {
    ++i;
    if (i < text_.size() && (text_[i] == '+' || text_[i] == '-')) ++i;
    if (digits() == 0) i = mantissa;  // the unit em, for instance
  }
  return i;
}

std::optional<double> SvgScanner::number() {
  const std::size_t end = number_end();
  if (end == at_) return std::nullopt;
  const char* from = text_.data() + at_ + (text_[at_] == '+' ? 1 : 0);
  double value = 0.0;
  fast_float::from_chars(from, text_.data() + end, value);
  at_ = end;
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<bool> SvgScanner::flag() {
  const char c = peek();
  if (c != '0' && c != '1') return std::nullopt;
  ++at_;
  return c == '1';
}

std::string_view SvgScanner::word() {
  const std::size_t from = at_;
  while (!at_end() && is_letter(text_[at_])) ++at_;
  return text_.substr(from, at_ - from);
}

std::optional<std::size_t> draw_path(std::string_view data, SvgPathBuilder& builder) {
  return PathReader(data, builder).run();
}

}  // namespace obvid::exchange
