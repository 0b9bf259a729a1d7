// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <TopoDS_Edge.hxx>
#include <string>
#include <vector>

#include "obvid/exchange/drawing.h"

namespace obvid::cad {

/// Connected edges of a file, in order.
struct EdgeChain {
  std::string label;
  std::vector<TopoDS_Edge> edges;
  bool closed = false;
};

/// The chain in its plane. What cannot be taken is said in `warnings`, and the chain left out.
void add_flat(const EdgeChain& chain, Drawing& drawing);

}  // namespace obvid::cad
