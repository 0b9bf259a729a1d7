// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "obvid/numeric/internal/small_system.h"

namespace obvid::idspline {

/// Square matrix of one to three rows, a block of a tridiagonal system.
template <class Real, std::size_t K>
struct SmallMatrix {
  std::array<std::array<Real, K>, K> row{};
};

template <class Real, std::size_t K>
SmallMatrix<Real, K> operator*(const SmallMatrix<Real, K>& a, const SmallMatrix<Real, K>& b) {
  SmallMatrix<Real, K> out;
  for (std::size_t i = 0; i < K; ++i) {
    for (std::size_t j = 0; j < K; ++j) {
      for (std::size_t l = 0; l < K; ++l) out.row[i][j] += a.row[i][l] * b.row[l][j];
    }
  }
  return out;
}

template <class Real, std::size_t K>
SmallMatrix<Real, K> operator-(SmallMatrix<Real, K> a, const SmallMatrix<Real, K>& b) {
  for (std::size_t i = 0; i < K; ++i) {
    for (std::size_t j = 0; j < K; ++j) a.row[i][j] -= b.row[i][j];
  }
  return a;
}

/// Unknowns of one node. A struct of its own, so that its operators are found by name.
template <class Real, std::size_t K>
struct SmallColumn {
  std::array<Real, K> at{};
};

template <class Real, std::size_t K>
SmallColumn<Real, K> operator*(const SmallMatrix<Real, K>& a, const SmallColumn<Real, K>& b) {
  SmallColumn<Real, K> out;
  for (std::size_t i = 0; i < K; ++i) {
    for (std::size_t j = 0; j < K; ++j) out.at[i] += a.row[i][j] * b.at[j];
  }
  return out;
}

template <class Real, std::size_t K>
SmallColumn<Real, K> operator*(const Real& a, SmallColumn<Real, K> b) {
  for (std::size_t i = 0; i < K; ++i) b.at[i] = a * b.at[i];
  return b;
}

template <class Real, std::size_t K>
SmallColumn<Real, K> operator-(SmallColumn<Real, K> a, const SmallColumn<Real, K>& b) {
  for (std::size_t i = 0; i < K; ++i) a.at[i] -= b.at[i];
  return a;
}

/// Inverse; not finite when there is none.
template <class Real, std::size_t K>
SmallMatrix<Real, K> inverse_of(const SmallMatrix<Real, K>& a) {
  std::array<SmallColumn<Real, K>, K> rows;
  for (std::size_t i = 0; i < K; ++i) rows[i].at[i] = Real(1);
  SmallMatrix<Real, K> out;
  const bool regular = solve_small(a.row, rows);
  for (std::size_t i = 0; i < K; ++i) {
    for (std::size_t j = 0; j < K; ++j) {
      out.row[i][j] = regular ? rows[i].at[j] : Real(std::nan(""));
    }
  }
  return out;
}

}  // namespace obvid::idspline
