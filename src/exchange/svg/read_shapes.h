// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "svg/path_builder.h"
#include "svg/read_values.h"
#include "xml_text.h"

namespace obvid::exchange {

/// Draws one basic shape or path in user units. What is wrong with it goes to `warnings`.
class SvgShape {
 public:
  SvgShape(pugi::xml_node node, const SvgViewport& viewport, SvgPathBuilder& builder,
           XmlWarnings& warnings)
      : node_(node), viewport_(viewport), out_(builder), warnings_(warnings) {}

  /// Whether elements of this name are shapes.
  [[nodiscard]] static bool knows(std::string_view name);
  void draw(std::string_view name);
  /// Points of a polyline or polygon, as drawn.
  [[nodiscard]] const std::vector<Vec2>& points() const { return points_; }

 private:
  void path();
  void line();
  void polyline(bool closed);
  void rectangle();
  void rounded(double x, double y, double w, double h, double rx, double ry);
  void circle();
  void ellipse();
  void whole_ellipse(Vec2 centre, double rx, double ry);
  std::optional<double> given(const char* name, SvgAxis axis);
  double length(const char* name, SvgAxis axis) { return given(name, axis).value_or(0.0); }

  pugi::xml_node node_;
  const SvgViewport& viewport_;
  SvgPathBuilder& out_;
  XmlWarnings& warnings_;
  std::vector<Vec2> points_;
};

}  // namespace obvid::exchange
