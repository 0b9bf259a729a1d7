// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <tuple>
#include <variant>
#include <vector>

namespace obvid::alignment {

/// Number of unknowns of the linear programs below.
inline constexpr std::size_t kUnknowns = 4;
using Unknowns = std::array<double, kUnknowns>;

/// a . x <= b.
template <std::size_t N>
struct HalfSpaceOf {
  std::array<double, N> a{};
  double b = 0.0;
};
using HalfSpace = HalfSpaceOf<kUnknowns>;

/// Linear programs of four unknowns, with memory that is used again from one to the next.
class SmallProgram {
 public:
  void clear() { std::get<kUnknowns>(rows_).clear(); }
  /// Scaled so that its unknowns are of the order of 1: kept to 1e-9 of its largest coefficient.
  void add(const HalfSpace& row);
  void add(const std::vector<HalfSpace>& rows) {
    for (const HalfSpace& row : rows) add(row);
  }
  /// In a fixed shuffled order, in which few rows change the maximum: once, when all are there.
  void shuffle();

  /// The x that maximises `goal` . x with all rows kept and every |x_k| <= `box`; nothing when
  /// there is none. Seidel's incremental method (1991): expected time linear in the number of rows.
  [[nodiscard]] std::optional<Unknowns> maximum(const Unknowns& goal, double box);

 private:
  template <std::size_t N>
  bool maximum_of(const std::array<double, N>& goal, double box, std::array<double, N>& x);

  /// rows_[n]: those left with n unknowns.
  std::tuple<std::monostate, std::vector<HalfSpaceOf<1>>, std::vector<HalfSpaceOf<2>>,
             std::vector<HalfSpaceOf<3>>, std::vector<HalfSpaceOf<4>>>
      rows_;
};

}  // namespace obvid::alignment
