// SPDX-License-Identifier: Apache-2.0
#include "step/faces.h"

#include <fmt/format.h>

namespace obvid::exchange {
namespace {

class StepShell {
 public:
  StepShell(const StepChain& chain, double width, StepFile& file, StepCurves& curves)
      : chain_(chain), width_(width), file_(file), curves_(curves) {}

  StepId run() {
    const std::size_t n = chain_.shapes.size();
    for (const StepShape& shape : chain_.shapes) posts_.push_back(post(shape.start));
    if (!chain_.closed) posts_.push_back(post(chain_.shapes.back().end));
    std::vector<StepId> faces;
    for (std::size_t i = 0; i < n; ++i) {
      faces.push_back(face(chain_.shapes[i], posts_[i], posts_[(i + 1) % posts_.size()]));
    }
    return file_.add(fmt::format("OPEN_SHELL('',{})", step_list<StepId>(faces)));
  }

 private:
  /// The edge along z between two faces.
  struct Post {
    StepId low, high, edge;
  };

  StepId vertex(Vec2 p, double z) {
    return file_.add(fmt::format("VERTEX_POINT('',{})", step_value(curves_.point(p, z))));
  }
  StepId edge(StepId from, StepId to, StepId curve) {
    return file_.add(fmt::format("EDGE_CURVE('',{},{},{},.T.)", step_value(from), step_value(to),
                                 step_value(curve)));
  }
  /// In a loop, forwards or backwards.
  StepId oriented(StepId edge, bool forwards) {
    return file_.add(
        fmt::format("ORIENTED_EDGE('',*,*,{},{})", step_value(edge), forwards ? ".T." : ".F."));
  }

  Post post(Vec2 p) {
    const StepId low = vertex(p, 0.0), high = vertex(p, width_);
    const StepId line = file_.add(
        fmt::format("LINE('',{},{})", step_value(curves_.point(p, 0.0)), step_value(upwards())));
    return {low, high, edge(low, high, line)};
  }
  StepId upwards() { return file_.add(fmt::format("VECTOR('',{},1.)", step_value(curves_.up()))); }

  /// Whether its normal lies to the right of the curve is told in `right`.
  StepId surface(const StepShape& shape, bool& right) {
    right = true;
    if (const auto* line = std::get_if<StepLine>(&shape.curve)) {
      const StepId along = curves_.direction(line->direction);
      const StepId out = curves_.direction(-left_normal(line->direction));
      const StepId at = curves_.axes(curves_.point(shape.start, 0.0), out, along);
      return file_.add(fmt::format("PLANE('',{})", step_value(at)));
    }
    const auto* conic = std::get_if<StepConic>(&shape.curve);
    if (conic != nullptr && conic->major == conic->minor) {
      right = conic->left;  // its normals point away from the axis
      const StepId at = curves_.axes(curves_.point(conic->centre, 0.0), curves_.up(),
                                     curves_.direction(conic->axis));
      return file_.add(
          fmt::format("CYLINDRICAL_SURFACE('',{},{})", step_value(at), step_value(conic->major)));
    }
    const StepId swept = curves_.basis(shape, 0.0);
    return file_.add(fmt::format("SURFACE_OF_LINEAR_EXTRUSION('',{},{})", step_value(swept),
                                 step_value(upwards())));
  }

  StepId face(const StepShape& shape, const Post& start, const Post& end) {
    const StepId low = edge(start.low, end.low, curves_.basis(shape, 0.0));
    const StepId high = edge(start.high, end.high, curves_.basis(shape, width_));
    const std::vector<StepId> edges = {oriented(low, true), oriented(end.edge, true),
                                       oriented(high, false), oriented(start.edge, false)};
    const StepId loop = file_.add(fmt::format("EDGE_LOOP('',{})", step_list<StepId>(edges)));
    const StepId bound = file_.add(fmt::format("FACE_OUTER_BOUND('',{},.T.)", step_value(loop)));
    bool right = true;
    const StepId on = surface(shape, right);
    return file_.add(fmt::format("ADVANCED_FACE('',({}),{},{})", step_value(bound), step_value(on),
                                 right ? ".T." : ".F."));
  }

  const StepChain& chain_;
  double width_;
  StepFile& file_;
  StepCurves& curves_;
  std::vector<Post> posts_;
};

}  // namespace

StepId step_shell(const StepChain& chain, double width, StepFile& file, StepCurves& curves) {
  return StepShell(chain, width, file, curves).run();
}

}  // namespace obvid::exchange
