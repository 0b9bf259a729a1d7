// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/gcode/nc_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "obvid/core/internal/inch.h"
#include "obvid/core/units.h"

namespace obvid::exchange {
namespace {

/// What controllers take for one radius: LinuxCNC's limits, others are no stricter.
constexpr double kSameNcRadius = 0.002;  // mm
constexpr double kSameNcRadiusPart = 1e-3;

class Reader {
 public:
  Reader(double within, std::optional<double> level) : within_(within) {
    known_[2] = level.has_value();
    at_[2] = level.value_or(0.0);
  }

  Result<NcProgram> run(std::string_view text) {
    for (std::size_t number = 1; !text.empty(); ++number) {
      const std::size_t end = text.find('\n');
      const std::string_view line = text.substr(0, end);
      if (!block(line)) {
        return error(ErrorCode::kInternal, "a printed block is not understood: " + fault_)
            .where(fmt::format("block {}: {}", number, line))
            .hint("please report this")
            .point(number);
      }
      text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    }
    return std::move(program_);
  }

 private:
  using Places = std::array<double, 3>;  // x, y, z

  bool bad(std::string why) {
    fault_ = std::move(why);
    return false;
  }

  bool block(std::string_view line) {
    ends_ = {};
    to_centre_ = {};
    to_second_ = {};
    blends_ = false;
    while (!line.empty()) {
      const char word = line.front();
      line.remove_prefix(1);
      if (word == ' ' || word == '%' || word == '\r') continue;
      if (word == ';') break;  // a remark up to the end of the line
      if (word == '(') {
        const std::size_t end = line.find(')');
        if (end == std::string_view::npos) return bad("a comment without an end");
        line.remove_prefix(end + 1);
        continue;
      }
      double value = 0.0;
      const auto [stop, code] = std::from_chars(line.data(), line.data() + line.size(), value);
      if (code != std::errc() || !std::isfinite(value)) return bad("a word without a number");
      line.remove_prefix(static_cast<std::size_t>(stop - line.data()));
      if (!take(word, value)) return false;
    }
    const bool moves = std::any_of(ends_.begin(), ends_.end(), [](const auto& e) { return e; });
    return !moves || move();
  }

  bool take(char word, double value) {
    switch (word) {
      case 'X':
      case 'Y':
      case 'Z':
        ends_[static_cast<std::size_t>(word - 'X')] = value;
        return true;
      case 'I':
      case 'J':
      case 'K':
        to_centre_[static_cast<std::size_t>(word - 'I')] = value;
        return true;
      case 'G':
        return general(value);
      case 'P':
      case 'Q':
        if (word == 'Q' && motion_ != 5 && !blends_) return bad("the word Q");
        to_second_[static_cast<std::size_t>(word - 'P')] = value;
        return true;
      case 'F':
      case 'M':
      case 'O':
      case 'S':
        return true;
      default:
        return bad(std::string("the word ") + word);
    }
  }

  bool general(double value) {
    const int tenths = static_cast<int>(std::lround(10.0 * value));
    switch (tenths) {
      case 0:
      case 10:
      case 20:
      case 30:
        motion_ = tenths / 10;
        return true;
      case 50:
        motion_ = 5;
        return true;
      case 40:   // a dwell
      case 400:  // no compensation of radius or length, no cycle
      case 490:
      case 800:
        return true;
      case 640:
        blends_ = true;
        return true;
      case 170:
      case 180:
      case 190:
        plane_ = tenths / 10;
        return true;
      case 200:
      case 210:
        program_.inches = tenths == 200;
        return true;
      case 900:
      case 911:
      case 940:
        return true;
      default:
        return bad(fmt::format("G{:g}", value));
    }
  }

  bool move() {
    for (std::size_t k = 0; k < 3; ++k) known_[k] = known_[k] || ends_[k].has_value();
    Places end = at_;
    for (std::size_t k = 0; k < 3; ++k) end[k] = ends_[k].value_or(at_[k]);
    // nobody knows where it comes from
    if (!placed_ && motion_ != 0) return bad("it cuts before the tip is placed");
    if (!(known_[0] && known_[1] && known_[2])) {
      at_ = end;
      return true;
    }
    NcMotion out;
    out.rapid = motion_ == 0;
    out.arc = motion_ == 2 || motion_ == 3;
    if (placed_) out.points.push_back({at_[0], at_[1], at_[2]});
    if (out.arc && !arc(end, out)) return false;
    if (motion_ == 5 && !cubic(end, out)) return false;
    out.points.push_back({end[0], end[1], end[2]});
    placed_ = true;
    at_ = end;
    program_.motions.push_back(std::move(out));
    return true;
  }

  // Axes of the plane in cyclic order: XY, ZX, YZ; G3 turns the first into the second.
  bool arc(const Places& end, NcMotion& out) {
    const std::size_t a = plane_ == 17 ? 0 : plane_ == 18 ? 2 : 1, b = (a + 1) % 3;
    const std::size_t c = (a + 2) % 3;
    const double ca = at_[a] + to_centre_[a], cb = at_[b] + to_centre_[b];
    const double r0 = std::hypot(at_[a] - ca, at_[b] - cb);
    const double r1 = std::hypot(end[a] - ca, end[b] - cb);
    const double same = program_.inches ? kSameNcRadius / kMmPerInch : kSameNcRadius;
    if (!(r0 > 0.0)) return bad("an arc without a radius");
    if (std::abs(r0 - r1) > std::max(same, kSameNcRadiusPart * r0)) {
      return bad("its ends are not equally far from the centre");
    }
    const double whole = kFullTurn;
    const double from = std::atan2(at_[b] - cb, at_[a] - ca);
    double turn = std::atan2(end[b] - cb, end[a] - ca) - from;
    if (motion_ == 3 && turn <= 0.0) turn += whole;
    if (motion_ == 2 && turn >= 0.0) turn -= whole;
    // a chord over the angle w lies r (1 - cos(w / 2)) under its arc
    const double depth = std::min(1.0, within_ / std::max(r0, r1));
    const double chord = 2.0 * std::acos(1.0 - depth);
    const double parts = std::max(1.0, std::ceil(std::abs(turn) / chord));
    for (double k = 1.0; k < parts; k += 1.0) {
      const double part = k / parts, angle = from + turn * part, r = r0 + (r1 - r0) * part;
      Places p{};
      p[a] = ca + r * std::cos(angle);
      p[b] = cb + r * std::sin(angle);
      p[c] = at_[c] + (end[c] - at_[c]) * part;
      out.points.push_back({p[0], p[1], p[2]});
    }
    return true;
  }

  // I and J lead from the start to the first inner control point, P and Q from the end to the
  // second one.
  bool cubic(const Places& end, NcMotion& out) {
    if (plane_ != 17 || ends_[2]) return bad("a spline runs in the plane XY alone");
    if (!to_second_[0] || !to_second_[1]) return bad("a spline without P and Q");
    const Vec2 a{at_[0], at_[1]}, d{end[0], end[1]};
    const Vec2 b = a + Vec2{to_centre_[0], to_centre_[1]},
               c = d + Vec2{*to_second_[0], *to_second_[1]};
    // chords lie no deeper than a eighth of the second derivative times the square of the step
    const double bend = 6.0 * std::max(norm(a - 2.0 * b + c), norm(b - 2.0 * c + d));
    const double parts = std::max(1.0, std::ceil(std::sqrt(0.125 * bend / within_)));
    for (double k = 1.0; k < parts; k += 1.0) {
      const double t = k / parts, s = 1.0 - t;
      const Vec2 p = s * s * s * a + 3.0 * s * s * t * b + 3.0 * s * t * t * c + t * t * t * d;
      out.points.push_back({p.x, p.y, at_[2]});
    }
    return true;
  }

  double within_;
  NcProgram program_;
  std::string fault_;
  std::array<std::optional<double>, 3> ends_;
  Places to_centre_{}, at_{};
  std::array<std::optional<double>, 2> to_second_;
  std::array<bool, 3> known_{};
  bool placed_ = false;
  bool blends_ = false;  ///< the line says how far (G64)
  int motion_ = 0, plane_ = 17;
};

}  // namespace

Result<NcProgram> read_program(std::string_view text, double within, std::optional<double> level) {
  return Reader(within, level).run(text);
}

}  // namespace obvid::exchange
