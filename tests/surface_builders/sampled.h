// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "obvid/surface_builders/internal/grid.h"

namespace obvid {

template <class Function>
PointGrid sampled(std::size_t nu, std::size_t nv, const Function& f) {
  PointGrid grid{nu, nv, {}, "sampled"};
  for (std::size_t j = 0; j < nv; ++j) {
    for (std::size_t i = 0; i < nu; ++i) {
      grid.points.push_back(f(static_cast<double>(i) / static_cast<double>(nu - 1),
                              static_cast<double>(j) / static_cast<double>(nv - 1)));
    }
  }
  return grid;
}

}  // namespace obvid
