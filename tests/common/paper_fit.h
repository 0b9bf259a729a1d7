// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "paper_series.h"
#include "rounding_fit.h"

namespace obvid::paper {

constexpr double kHalfOfTwoDecimals = 0.005;     // mm: chords, sides, coordinates
constexpr double kHalfOfFourDecimals = 0.00005;  // mm: heights, widths, errors
constexpr std::size_t kInserted = 9;             // index of the intermediate point of Table 3
/// |7,8| prints 36.29, the difference of the abscissas alone; the points give 36.36.
constexpr std::size_t kMisprintedChord = 6;
/// Width of segment 8 in Table 2 prints 0.2257; Table 3 prints 0.2857.
constexpr std::size_t kMisprintedWidth = 7;

/// The eleven elements behind Tables 2 to 4: coordinates and headings as one vector.
struct Hidden {
  static std::vector<Element> elements(const Unknowns& x) {
    const std::size_t n = x.size() / 3;
    std::vector<Element> e(n);
    for (std::size_t i = 0; i < n; ++i) e[i] = {{x[2 * i], x[2 * i + 1]}, x[2 * n + i], 0.0};
    return e;
  }
  static std::vector<Element> without_inserted(std::vector<Element> e) {
    e.erase(e.begin() + kInserted);
    return e;
  }
};

/// A figure with the way to compute it from the segments of both tables.
struct Claim {
  Figure figure;
  std::function<double(const std::vector<Segment>& ten, const std::vector<Segment>& eleven)> value;
};

/// Everything that Tables 2 and 3 print, misprints left out.
class Tables {
 public:
  Tables() : printed2_(read_columns("region10.txt")), printed3_(read_columns("region11.txt")) {
    const auto points = read_point_columns("points11.txt");
    for (const Vec2 p : points) {
      start_.push_back(p.x);
      start_.push_back(p.y);
    }
    const auto headings = headings_from_sides(points, printed3_[1], printed3_[2]);
    start_.insert(start_.end(), headings.begin(), headings.end());
    constexpr double kTypicalTurn = 1e-3;  // rad: a rounding seen over the shortest side
    step_.assign(2 * points.size(), kHalfOfTwoDecimals);
    step_.resize(start_.size(), kTypicalTurn);
  }

  [[nodiscard]] const std::vector<std::vector<double>>& printed2() const { return printed2_; }
  [[nodiscard]] const std::vector<std::vector<double>>& printed3() const { return printed3_; }
  [[nodiscard]] const Unknowns& start() const { return start_; }

  /// Chords and sides of one table (2 or 3): figures with two decimals.
  void add_triangles(int table) {
    const auto& printed = table == 2 ? printed2_ : printed3_;
    for (std::size_t i = 0; i < printed[0].size(); ++i) {
      if (i != kMisprintedChord) add(table, i, "chord", printed[0][i], &Segment::chord);
      add(table, i, "|i,T|", printed[1][i], &Segment::to_apex);
      add(table, i, "|T,i+1|", printed[2][i], &Segment::from_apex);
    }
  }
  void add(int table, std::size_t i, const char* name, double printed, double Segment::*member) {
    const auto pick = [=](const Segment& s) { return s.*member; };
    add(table, i, name, printed, kHalfOfTwoDecimals, pick);
  }
  void add(int table, std::size_t i, const char* name, double printed, double half_unit,
           std::function<double(const Segment&)> pick) {
    claims_.push_back({{fmt::format("Table {} row {} {}", table, i + 1, name), printed, half_unit},
                       [=](const auto& ten, const auto& eleven) {
                         return pick(table == 2 ? ten[i] : eleven[i]);
                       }});
  }
  void add_lower(int table, std::size_t i, double printed) {
    add(table, i, "h", printed, kHalfOfFourDecimals,
        [](const Segment& s) { return s.lower_middle; });
  }
  void add_width(int table, std::size_t i, double printed) {
    add(table, i, "width", printed, kHalfOfFourDecimals,
        [](const Segment& s) { return s.upper_middle - s.lower_middle; });
  }

  /// How many roundings explain all figures added so far, coordinates included.
  [[nodiscard]] RoundingFit fit() const {
    std::vector<Figure> figures;
    const std::size_t coordinates = 2 * start_.size() / 3;
    for (std::size_t j = 0; j < coordinates; ++j) {
      figures.push_back({fmt::format("coordinate {}", j), start_[j], kHalfOfTwoDecimals});
    }
    for (const Claim& c : claims_) figures.push_back(c.figure);
    const Model model = [this, coordinates](const Unknowns& x) {
      std::vector<double> values(x.begin(), x.begin() + static_cast<std::ptrdiff_t>(coordinates));
      const auto elements = Hidden::elements(x);
      const auto eleven = segments_of(elements);
      const auto ten = segments_of(Hidden::without_inserted(elements));
      for (const Claim& c : claims_) values.push_back(c.value(ten, eleven));
      return values;
    };
    return fewest_roundings(model, figures, start_, step_);
  }

 private:
  std::vector<std::vector<double>> printed2_, printed3_;
  Unknowns start_, step_;
  std::vector<Claim> claims_;
};

/// Table 2 as printed, with the width of segment 8 that Table 3 prints.
inline Tables table2() {
  Tables t;
  t.add_triangles(2);
  for (std::size_t i = 0; i < t.printed2()[0].size(); ++i) {
    t.add_lower(2, i, t.printed2()[3][i]);
    t.add_width(2, i, i == kMisprintedWidth ? t.printed3()[4][i] : t.printed2()[4][i]);
  }
  return t;
}

}  // namespace obvid::paper
