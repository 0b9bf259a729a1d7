// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "obvid/geom/vec3.h"

namespace obvid::test {

/// A move of the machine as short straight steps.
struct NcMove {
  int code = 0;  ///< 0: rapid
  double feed = 0.0;
  std::vector<Vec3> points;
};

struct NcRun {
  std::vector<NcMove> moves;
  bool inches = false;
  std::vector<std::string> faults;  ///< words that it does not know, arcs whose radii differ
};

/// Reads programs as RS274 says: absolute ends, arcs by centres from the start, planes XY, ZX, YZ
/// whose arcs G3 turn counter-clockwise as seen from the positive end of the third axis.
class NcInterpreter {
 public:
  explicit NcInterpreter(double step) : step_(step) {}

  NcRun run(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) block(line);
    return run_;
  }

 private:
  void block(const std::string& line) {
    Vec3 end = at_, centre{};
    bool moves = false;
    for (std::size_t i = 0; i < line.size();) {
      const char word = line[i];
      if (word == '(') {
        i = line.find(')', i) + 1;
        continue;
      }
      if (word == ' ' || word == '%') {
        ++i;
        continue;
      }
      char* after = nullptr;
      const double value = std::strtod(line.c_str() + i + 1, &after);
      i = static_cast<std::size_t>(after - line.c_str());
      switch (word) {
        case 'X':
          end.x = value;
          moves = true;
          break;
        case 'Y':
          end.y = value;
          moves = true;
          break;
        case 'Z':
          end.z = value;
          moves = true;
          break;
        case 'I':
          centre.x = value;
          break;
        case 'J':
          centre.y = value;
          break;
        case 'K':
          centre.z = value;
          break;
        case 'F':
          feed_ = value;
          break;
        case 'G':
          general(value);
          break;
        case 'M':
        case 'O':
          break;
        default:
          run_.faults.push_back(line);
      }
    }
    if (moves) move(end, centre, line);
  }

  void general(double value) {
    const int code = static_cast<int>(std::lround(10.0 * value));
    if (code <= 30) code_ = code / 10;
    if (code >= 170 && code <= 190) plane_ = code / 10;
    if (code == 200) run_.inches = true;
    if (code == 910) run_.faults.emplace_back("relative ends");
  }

  void move(Vec3 end, Vec3 centre, const std::string& line) {
    NcMove out{code_, feed_, {at_}};
    if (code_ == 2 || code_ == 3) {
      arc(end, centre, out, line);
    } else {
      const int n = code_ == 0 ? 1 : 1 + static_cast<int>(norm(end - at_) / step_);
      for (int k = 1; k <= n; ++k) out.points.push_back(at_ + (k / double(n)) * (end - at_));
    }
    run_.moves.push_back(out);
    at_ = end;
  }

  // First and second axis of the plane, cyclic: XY, ZX, YZ.
  [[nodiscard]] double first(Vec3 p) const { return plane_ == 17 ? p.x : plane_ == 18 ? p.z : p.y; }
  [[nodiscard]] double second(Vec3 p) const {
    return plane_ == 17 ? p.y : plane_ == 18 ? p.x : p.z;
  }
  [[nodiscard]] Vec3 in_plane(double a, double b, Vec3 other) const {
    if (plane_ == 17) return {a, b, other.z};
    if (plane_ == 18) return {b, other.y, a};
    return {other.x, a, b};
  }

  void arc(Vec3 end, Vec3 to_centre, NcMove& out, const std::string& line) {
    const double ca = first(at_) + first(to_centre), cb = second(at_) + second(to_centre);
    const double r0 = std::hypot(first(at_) - ca, second(at_) - cb);
    const double r1 = std::hypot(first(end) - ca, second(end) - cb);
    if (std::abs(r0 - r1) > 0.002 || r0 == 0.0) run_.faults.push_back(line);
    const double from = std::atan2(second(at_) - cb, first(at_) - ca);
    double turn = std::atan2(second(end) - cb, first(end) - ca) - from;
    const double whole = 2.0 * std::numbers::pi;
    if (code_ == 3 && turn <= 0.0) turn += whole;
    if (code_ == 2 && turn >= 0.0) turn -= whole;
    const int n = 1 + static_cast<int>(std::abs(turn) * r0 / step_);
    for (int k = 1; k < n; ++k) {
      const double angle = from + turn * k / n, r = r0 + (r1 - r0) * k / n;
      out.points.push_back(in_plane(ca + r * std::cos(angle), cb + r * std::sin(angle), at_));
    }
    out.points.push_back(end);
  }

  double step_;
  Vec3 at_{0.0, 0.0, 1000.0};  // far above: no part of a program
  int code_ = 0, plane_ = 17;
  double feed_ = 0.0;
  NcRun run_;
};

}  // namespace obvid::test
