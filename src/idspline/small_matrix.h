// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

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
SmallColumn<Real, K> operator-(SmallColumn<Real, K> a, const SmallColumn<Real, K>& b) {
  for (std::size_t i = 0; i < K; ++i) a.at[i] -= b.at[i];
  return a;
}

/// Inverse by elimination with row exchanges; not finite when there is none.
template <class Real, std::size_t K>
SmallMatrix<Real, K> inverse_of(SmallMatrix<Real, K> a) {
  using std::abs;
  SmallMatrix<Real, K> out;
  for (std::size_t i = 0; i < K; ++i) out.row[i][i] = Real(1);
  for (std::size_t i = 0; i < K; ++i) {
    std::size_t largest = i;
    for (std::size_t j = i + 1; j < K; ++j) {
      if (abs(a.row[j][i]) > abs(a.row[largest][i])) largest = j;
    }
    std::swap(a.row[i], a.row[largest]);
    std::swap(out.row[i], out.row[largest]);
    const Real per = Real(1) / a.row[i][i];
    for (std::size_t l = 0; l < K; ++l) {
      a.row[i][l] *= per;
      out.row[i][l] *= per;
    }
    for (std::size_t j = 0; j < K; ++j) {
      if (j == i) continue;
      const Real factor = a.row[j][i];
      for (std::size_t l = 0; l < K; ++l) {
        a.row[j][l] -= factor * a.row[i][l];
        out.row[j][l] -= factor * out.row[i][l];
      }
    }
  }
  return out;
}

}  // namespace obvid::idspline
