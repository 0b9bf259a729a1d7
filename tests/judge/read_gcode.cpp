// SPDX-License-Identifier: Apache-2.0
// An interpreter of the G-code that contours are written in: G0 to G3 and G5 in the plane XY.
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "drawing.h"

namespace judge {
namespace {

class Interpreter {
 public:
  Interpreter(Point origin, const std::string& unit) : origin_(origin), unit_(unit) {}

  void block(const std::string& text) {
    const std::map<char, std::vector<Real>> words = words_of(text);
    for (const Real g : of(words, 'G')) modal(g);
    const bool moves = words.contains('X') || words.contains('Y');
    if (!moves) return;
    if (!metres_known_) throw std::runtime_error("a move before G20 or G21");
    if (!absolute_) throw std::runtime_error("G91 is not expected");
    const Vec to{first(words, 'X', at_.x), first(words, 'Y', at_.y)};
    if (motion_ == 1) line(to);
    if (motion_ == 2 || motion_ == 3) arc(words, to);
    if (motion_ == 5) spline(words, to);
    if (motion_ != 0) ++out.blocks;
    at_ = to;
  }
  Drawing out;

 private:
  static std::map<char, std::vector<Real>> words_of(const std::string& text) {
    std::map<char, std::vector<Real>> out;
    int depth = 0;
    for (std::size_t i = 0; i < text.size();) {
      const char c = text[i];
      if (c == ';' || c == '%') break;
      depth += c == '(' ? 1 : c == ')' ? -1 : 0;
      if (depth > 0 || std::isalpha(static_cast<unsigned char>(c)) == 0) {
        ++i;
        continue;
      }
      char* end = nullptr;
      const Real value = std::strtold(text.c_str() + i + 1, &end);
      if (end == text.c_str() + i + 1) throw std::runtime_error("a letter without number");
      const std::string number(text, i + 1, static_cast<std::size_t>(end - text.c_str()) - i - 1);
      constexpr std::size_t kMostDecimals = 6;  // what controllers take
      const std::size_t point = number.find('.');
      if (point != std::string::npos && number.size() > point + 1 + kMostDecimals) {
        throw std::runtime_error("a number with too many digits: " + number);
      }
      out[static_cast<char>(std::toupper(static_cast<unsigned char>(c)))].push_back(value);
      i = static_cast<std::size_t>(end - text.c_str());
    }
    return out;
  }
  static std::vector<Real> of(const std::map<char, std::vector<Real>>& words, char letter) {
    const auto found = words.find(letter);
    return found == words.end() ? std::vector<Real>{} : found->second;
  }
  static Real first(const std::map<char, std::vector<Real>>& words, char letter, Real otherwise) {
    const auto found = words.find(letter);
    return found == words.end() ? otherwise : found->second.front();
  }

  void modal(Real g) {
    if (g == 0.0L || g == 1.0L || g == 2.0L || g == 3.0L || g == 5.0L) {
      motion_ = static_cast<int>(g);
    } else if (g == 20.0L || g == 21.0L) {
      out.metres = g == 20.0L ? 0.0254 : 1e-3;
      metres_known_ = true;
      if (const auto mine = metres_of(unit_)) scale_ = *out.metres / *mine;
    } else if (g == 90.0L || g == 91.0L) {
      absolute_ = g == 90.0L;
    } else if (g != 17.0L && g != 94.0L && g != 91.1L && g != 40.0L && g != 49.0L && g != 80.0L &&
               g != 54.0L && g != 64.0L && g != 61.0L) {
      throw std::runtime_error("G" + std::to_string(static_cast<double>(g)) + " is not known");
    }
  }

  [[nodiscard]] Vec seen_here(Vec p) const {
    return {p.x * scale_ - origin_.x, p.y * scale_ - origin_.y};
  }

  void line(Vec to) {
    const Vec a = seen_here(at_), chord = seen_here(to) - a;
    out.spans.emplace_back(a, std::atan2(chord.y, chord.x), 0.0L, norm(chord));
  }

  void arc(const std::map<char, std::vector<Real>>& words, Vec to) {
    ++out.arc_blocks;
    if (words.contains('R')) throw std::runtime_error("arcs by radius are not expected");
    const Vec centre = at_ + Vec{first(words, 'I', 0.0L), first(words, 'J', 0.0L)};
    const Vec from = at_ - centre, then = to - centre;
    const Real r0 = norm(from), r1 = norm(then);
    out.worst_radius_mismatch =
        std::max(out.worst_radius_mismatch, static_cast<double>(std::abs(r0 - r1)));
    Real turn = std::atan2(cross(from, then), dot(from, then));
    constexpr Real kFull = 2.0L * std::numbers::pi_v<Real>;
    if (motion_ == 3 && turn <= 0.0L) turn += kFull;
    if (motion_ == 2 && turn >= 0.0L) turn -= kFull;
    // controllers go round with the radius of the start
    out.spans.push_back(arc_span(seen_here(centre), r0 * scale_, std::atan2(from.y, from.x), turn));
  }

  void spline(const std::map<char, std::vector<Real>>& words, Vec to) {
    const Vec a = seen_here(at_), d = seen_here(to);
    const Vec b = a + scale_ * Vec{first(words, 'I', 0.0L), first(words, 'J', 0.0L)};
    const Vec c = d + scale_ * Vec{first(words, 'P', 0.0L), first(words, 'Q', 0.0L)};
    out.spans.emplace_back(std::vector<Vec>{a, b, c, d}, std::vector<Real>(4, 1.0L));
  }

  Point origin_;
  std::string unit_;
  Vec at_;
  Real scale_ = 1.0L;
  int motion_ = 0;
  bool absolute_ = true, metres_known_ = false;
};

}  // namespace

Drawing read_gcode(const std::string& text, Point origin, const std::string& unit) {
  Interpreter interpreter(origin, unit);
  try {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) interpreter.block(line);
  } catch (const std::exception& error) {
    interpreter.out.fault = error.what();
  }
  if (interpreter.out.spans.empty() && interpreter.out.fault.empty()) {
    interpreter.out.fault = "no motion";
  }
  return std::move(interpreter.out);
}

}  // namespace judge
