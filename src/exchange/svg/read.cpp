// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/svg/read.h"
#include "obvid/core/internal/picture_mark.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "geo/projection_series.h"
#include "obvid/core/internal/inch.h"
#include "obvid/series/internal/straight_rows.h"
#include "svg/read_shapes.h"
#include "svg/style_sheet.h"

namespace obvid {
namespace {

using exchange::Affine;
using exchange::attribute_of;
using exchange::local_name;
using exchange::SvgAxis;
using exchange::SvgProperty;
using exchange::SvgShape;
using exchange::SvgStyle;
using exchange::SvgStyleSheet;
using exchange::SvgViewport;
using exchange::XmlFile;
using exchange::XmlWarnings;
using std::string_view;

constexpr double kMillimetresPerPixel = kMmPerInch / 96.0;
constexpr int kMaxGroupDepth = 200;  // of groups in groups; what people draw has less than 50

// What may be drawn through `use`, bytes of data and so many for each element, about what it takes
// in memory: uses of uses grow as a power of their depth. Room for honest drawings, and so many
// times the file.
constexpr std::size_t kUseRoom = 4U << 20U;
constexpr std::size_t kUseGrowth = 16;
constexpr std::size_t kElementCost = 256;

/// Elements that draw nothing by themselves, by definition.
bool is_silent(string_view name) {
  static constexpr std::array<string_view, 16> kSilent = {
      "defs",           "symbol",         "clipPath", "mask",  "marker", "pattern",
      "linearGradient", "radialGradient", "filter",   "style", "script", "title",
      "desc",           "metadata",       "view",     "cursor"};
  return std::find(kSilent.begin(), kSilent.end(), name) != kSilent.end();
}

/// What of an element shows: these are handed down to those inside.
struct Paint {
  bool visible = true, filled = true, stroked = false;

  /// `sure`: no style sheet says more than was read.
  [[nodiscard]] Paint inside(const SvgStyle& style, bool sure) const {
    Paint out = *this;
    const auto given = [&](SvgProperty one) {
      return !style[one].empty() && style[one] != "inherit";
    };
    const std::string &visibility = style[SvgProperty::kVisibility],
                      &fill = style[SvgProperty::kFill], &stroke = style[SvgProperty::kStroke];
    if (given(SvgProperty::kVisibility)) {
      out.visible = visibility != "hidden" && visibility != "collapse";
    }
    if (given(SvgProperty::kFill)) out.filled = fill != "none" && fill != "transparent";
    if (given(SvgProperty::kStroke)) out.stroked = stroke != "none" && stroke != "transparent";
    if (!sure) out.filled = true;
    return out;
  }
};

bool is_transparent(const SvgStyle& style) {
  const std::string& opacity = style[SvgProperty::kOpacity];
  return !opacity.empty() && opacity.find_first_not_of("0.%") == std::string::npos;
}

/// Where an element is drawn.
struct State {
  Affine to_sheet;
  SvgViewport viewport;
  int depth = 0;
  std::string layer{};  ///< those around it, from the outermost one: "Part/Holes"
  Paint paint{};
};

class SvgReader {
 public:
  SvgReader(const XmlFile& file, std::size_t bytes)
      : file_(file), warnings_(file), budget_(kUseRoom + kUseGrowth * bytes) {
    const string_view root = file.root().name();
    prefix_ = root.substr(0, root.size() - local_name(root).size());
  }

  Result<Drawing> run() {
    collect_ids();
    collect_styles();
    children(file_.root(), sheet());
    drawing_.name = file_.name();
    drawing_.units = "mm";
    drawing_.left_out = warnings_.left_out();
    if (empty_segments_ > 0) {
      drawing_.warnings.push_back(
          fmt::format("{} segments of no length left out", empty_segments_));
    }
    for (std::string& warning : warnings_.take()) drawing_.warnings.push_back(std::move(warning));
    if (drawing_.curves.empty() && drawing_.series.empty()) {
      const std::string why = drawing_.warnings.empty() ? "" : ": " + drawing_.warnings.front();
      return error(ErrorCode::kNothingThere, "the file draws nothing" + why).where(file_.name());
    }
    return std::move(drawing_);
  }

 private:
  void collect_ids() {
    std::vector<pugi::xml_node> open = {file_.root()};
    while (!open.empty()) {
      const pugi::xml_node node = open.back();
      open.pop_back();
      for (const pugi::xml_node child : node.children()) open.push_back(child);
      if (const auto id = node.attribute("id")) ids_.try_emplace(id.value(), node);
      has_layers_ = has_layers_ || is_layer(node);
    }
  }

  /// Those of the file, in its order.
  void collect_styles() {
    const pugi::xml_node root = file_.root();
    for (pugi::xml_node node = root; node;) {
      if (local_name(node) == "style") style_sheet(node);
      if (const pugi::xml_node inner = node.first_child()) {
        node = inner;
        continue;
      }
      while (node != root && !node.next_sibling()) node = node.parent();
      node = node == root ? pugi::xml_node{} : node.next_sibling();
    }
  }

  void style_sheet(pugi::xml_node node) {
    const string_view type = exchange::trimmed(node.attribute("type").value()),
                      media = exchange::trimmed(node.attribute("media").value());
    if ((!type.empty() && type != "text/css") ||
        (!media.empty() && media != "all" && media != "screen")) {
      return warnings_.add("style sheets of other types or media are not applied", node);
    }
    std::string text;
    for (const pugi::xml_node part : node.children()) text += part.value();
    const std::size_t before = styles_.not_understood().size();
    styles_.add(text);
    for (std::size_t k = before; k < styles_.not_understood().size(); ++k) {
      warnings_.add(
          fmt::format("the style sheet's \"{}\" is not understood: what it hides or shows "
                      "is read as if it did not",
                      shortened(styles_.not_understood()[k])),
          node);
    }
  }

  [[nodiscard]] Paint paint_inside(const Paint& outer, pugi::xml_node node,
                                   const SvgStyle& style) const {
    const bool sure = !styles_.is_empty() && styles_.not_understood().empty();
    return outer.inside(style, sure || !node.attribute("class"));
  }

  /// What Inkscape calls a layer.
  static bool is_layer(pugi::xml_node node) {
    return string_view(attribute_of(node, "groupmode").value()) == "layer";
  }

  /// Groups with a name are layers where the file has none of Inkscape's: of other programs.
  [[nodiscard]] std::string layer_inside(pugi::xml_node group, const std::string& outer) const {
    if (has_layers_ && !is_layer(group)) return outer;
    string_view name = has_layers_ ? attribute_of(group, "label").value() : "";
    if (name.empty()) name = group.attribute("id").value();
    constexpr std::size_t kLongestPath = 200;  // of groups that lie in each other without end
    if (name.empty() || outer.size() > kLongestPath) return outer;
    return (outer.empty() ? "" : outer + "/") + shortened(name);
  }

  /// Pixels of the sheet to millimetres with y up.
  State sheet() {
    const pugi::xml_node root = file_.root();
    const auto box = exchange::svg_view_box(root.attribute("viewBox").value());
    if (!box && root.attribute("viewBox")) {
      warnings_.add("the viewBox is none and not used", root);
    }
    const SvgViewport whole = box ? SvgViewport{box->width, box->height} : SvgViewport{};
    const SvgViewport size = sheet_size(whole);
    const Affine to_pixels =
        box ? exchange::svg_fit(*box, {}, size, root.attribute("preserveAspectRatio").value())
            : Affine{};
    const double k = kMillimetresPerPixel;
    const Affine up = {k, 0.0, 0.0, -k, 0.0, k * size.height};
    const SvgStyle style = styles_.of(root);
    return {up * to_pixels * own_transform(root, style), box ? whole : size, 0, "",
            paint_inside({}, root, style)};
  }

  /// Pixels. What is not given follows from the view box and its shape.
  SvgViewport sheet_size(const SvgViewport& box) {
    const pugi::xml_node root = file_.root();
    const auto given = [&](const char* name, SvgAxis axis) {  // 0: not given
      return std::max(0.0,
                      exchange::svg_length(root.attribute(name).value(), axis, box).value_or(0.0));
    };
    double width = given("width", SvgAxis::kX), height = given("height", SvgAxis::kY);
    const bool relative = string_view(root.attribute("width").value()).ends_with('%');
    if ((width == 0.0 && height == 0.0) || relative) {
      warnings_.add("the sheet has no size of its own; its unit is taken as 1 px = 1/96 in", root);
    }
    if (box.width > 0.0) {
      if (width == 0.0) width = height > 0.0 ? height * (box.width / box.height) : box.width;
      if (height == 0.0) height = width * (box.height / box.width);
    } else if (height == 0.0) {
      warnings_.add("the sheet has no height; y is measured from its upper edge", root);
    }
    return {width, height};
  }

  /// Transform of an element; the identity where it has an error.
  Affine own_transform(pugi::xml_node node, const SvgStyle& style) {
    const string_view text = node.attribute("transform").value();
    const auto transform = exchange::svg_transform(text);
    if (!transform) {
      warnings_.leave_out(
          fmt::format("transform \"{}\" has an error and is not used", shortened(text)), node);
    }
    if (string_view(node.attribute("style").value()).find("transform") != string_view::npos ||
        style[SvgProperty::kTransform] != exchange::trimmed(text)) {
      warnings_.leave_out("a transform in a style is not followed", node);
    }
    return transform.value_or(Affine{});
  }

  void children(pugi::xml_node node, const State& state) {
    if (state.depth >= kMaxGroupDepth) {
      warnings_.leave_out(fmt::format("groups nested more than {} deep left out", kMaxGroupDepth),
                          node);
      return;
    }
    for (const pugi::xml_node child : node.children()) {
      if (child.type() != pugi::node_element) continue;
      element(child, state);
      if (local_name(node) == "switch") break;  // one alternative is drawn
    }
  }

  /// Whether the element may still be drawn: everything may outside of `use`.
  bool afford(pugi::xml_node node) {
    if (active_.empty()) return true;
    const std::size_t cost = kElementCost + string_view(node.attribute("d").value()).size() +
                             string_view(node.attribute("points").value()).size() +
                             string_view(node.attribute("style").value()).size() +
                             string_view(node.attribute("class").value()).size();
    if (cost > budget_) {
      warnings_.leave_out("more is drawn through use than 16 times the file; the rest left out",
                          node);
      budget_ = 0;
      return false;
    }
    budget_ -= cost;
    return true;
  }

  void element(pugi::xml_node node, const State& outer) {
    const string_view whole = node.name(), name = local_name(whole);
    if (whole.substr(0, whole.size() - name.size()) != prefix_ || is_silent(name)) return;
    if (!afford(node)) return;
    const SvgStyle style = styles_.of(node);
    if (!styles_.looked_at_all()) {
      warnings_.leave_out("the style sheet has too many rules for so many elements", node);
    }
    if (style[SvgProperty::kDisplay] == "none") {
      return warnings_.add("hidden elements (display: none) left out", node);
    }
    if (is_transparent(style)) return warnings_.add("elements with opacity 0 left out", node);
    State state = {outer.to_sheet * own_transform(node, style), outer.viewport, outer.depth + 1,
                   outer.layer, paint_inside(outer.paint, node, style)};
    if (!state.to_sheet.is_finite() || state.to_sheet.determinant() == 0.0) {
      return warnings_.leave_out("elements with a transform that flattens them left out", node);
    }
    const std::string &clip = style[SvgProperty::kClipPath], &mask = style[SvgProperty::kMask];
    if ((!clip.empty() && clip != "none") || (!mask.empty() && mask != "none")) {
      warnings_.add("clip paths and masks are not applied: what they cut off is read too", node);
    }
    if (SvgShape::knows(name)) {
      if (!state.paint.visible) {
        return warnings_.add("hidden elements (visibility: hidden) left out", node);
      }
      if (!state.paint.filled && !state.paint.stroked) {
        warnings_.add("shapes without fill and stroke, which do not show, are read as they are",
                      node);
      }
      return shape(node, name, state);
    }
    if (name == "g") state.layer = layer_inside(node, outer.layer);
    if (name == "g" || name == "a" || name == "switch") return children(node, state);
    if (name == "svg") return nested(node, state, {}, node);
    if (name == "use") return use(node, state);
    warnings_.add(
        fmt::format("elements '{}' are not drawn{}", shortened(name),
                    name == "text" ? ": text is a curve where it is converted to paths" : ""),
        node);
  }

  void shape(pugi::xml_node node, string_view name, const State& state) {
    const string_view id = node.attribute("id").value();
    std::string label = id.empty() ? fmt::format("{} {}", name, ++numbers_[std::string(name)])
                                   : fmt::format("{} {}", name, shortened(id));
    if (!state.layer.empty()) label += " on layer " + state.layer;
    exchange::SvgPathBuilder builder(state.to_sheet, label);
    SvgShape drawn(node, state.viewport, builder, warnings_);
    drawn.draw(name);
    empty_segments_ += builder.empty_segments();
    if (!builder.all_finite()) {
      return warnings_.leave_out("shapes beyond the range of numbers left out", node);
    }
    auto curves = builder.take();
    if (curves.empty()) {
      return warnings_.add(fmt::format("{} draws nothing", label), node);
    }
    // vertices of a polyline are points of a curve, or its edges are what is drawn
    if (is_sampled(drawn.points())) {
      series(drawn.points(), state.to_sheet, label);
      drawing_.series.back().layer = state.layer;
      drawing_.series.back().id = id;
      return;
    }
    for (DrawnCurve& curve : curves) {
      curve.layer = state.layer;
      curve.id = id;
    }
    std::move(curves.begin(), curves.end(), std::back_inserter(drawing_.curves));
  }

  static bool is_sampled(const std::vector<Vec2>& points) {
    const bool closed = points.size() > 1 && points.front() == points.back();
    return !points.empty() &&
           chords_of_curve(std::span(points).first(points.size() - (closed ? 1 : 0)), closed);
  }

  void series(const std::vector<Vec2>& points, const Affine& to_sheet, const std::string& label) {
    std::vector<Vec2> placed;
    exchange::LastDigit digit;
    for (const Vec2 p : points) {
      placed.push_back(to_sheet.point(p));
      digit.add(p.x);
      digit.add(p.y);
    }
    PointSeries one = exchange::plane_series(label, "mm", placed);
    const double half = std::sqrt(std::abs(to_sheet.determinant())) * digit.half_unit();
    one.rounding = {half, half};
    drawing_.series.push_back(std::move(one));
  }

  /// An svg or symbol with a viewport of its own. `sizes` has width and height: the element itself,
  /// or the use that refers to it.
  void nested(pugi::xml_node node, const State& state, Vec2 corner, pugi::xml_node sizes) {
    const auto size_of = [&](const char* name, SvgAxis axis, double all) {
      const pugi::xml_node giver = sizes.attribute(name) ? sizes : node;
      return exchange::svg_length(giver.attribute(name).value(), axis, state.viewport)
          .value_or(all);
    };
    const SvgViewport size = {size_of("width", SvgAxis::kX, state.viewport.width),
                              size_of("height", SvgAxis::kY, state.viewport.height)};
    const Vec2 own = {exchange::svg_length(node.attribute("x").value(), SvgAxis::kX, state.viewport)
                          .value_or(0.0),
                      exchange::svg_length(node.attribute("y").value(), SvgAxis::kY, state.viewport)
                          .value_or(0.0)};
    const auto box = exchange::svg_view_box(node.attribute("viewBox").value());
    State inner = state;
    if (box) {
      inner.to_sheet =
          state.to_sheet * exchange::svg_fit(*box, corner + own, size,
                                             node.attribute("preserveAspectRatio").value());
      inner.viewport = {box->width, box->height};
    } else {
      inner.to_sheet =
          state.to_sheet * Affine{1.0, 0.0, 0.0, 1.0, corner.x + own.x, corner.y + own.y};
      inner.viewport = size;
    }
    if (inner.to_sheet.determinant() == 0.0 || !inner.to_sheet.is_finite()) {
      return warnings_.add("viewports of no size left out", node);
    }
    children(node, inner);
  }

  void use(pugi::xml_node node, const State& state) {
    const string_view href = exchange::trimmed(attribute_of(node, "href").value());
    const auto found = href.starts_with('#') ? ids_.find(std::string(href.substr(1))) : ids_.end();
    if (found == ids_.end()) {
      return warnings_.leave_out(
          fmt::format("use of '{}', which is not in the file, left out", shortened(href)), node);
    }
    const pugi::xml_node target = found->second;
    if (std::find(active_.begin(), active_.end(), target) != active_.end() ||
        static_cast<int>(active_.size()) >= kMaxGroupDepth || state.depth >= kMaxGroupDepth) {
      return warnings_.leave_out("a use that contains itself left out", node);
    }
    const auto length = [&](const char* name, SvgAxis axis) {
      return exchange::svg_length(node.attribute(name).value(), axis, state.viewport).value_or(0.0);
    };
    const Vec2 corner = {length("x", SvgAxis::kX), length("y", SvgAxis::kY)};
    active_.push_back(target);
    const string_view kind = local_name(target);
    if (kind == "symbol") {
      nested(target, state, corner, node);
    } else {
      State moved = state;
      moved.to_sheet = state.to_sheet * Affine{1.0, 0.0, 0.0, 1.0, corner.x, corner.y};
      element(target, moved);
    }
    active_.pop_back();
  }

  const XmlFile& file_;
  XmlWarnings warnings_;
  std::string prefix_;  ///< of the names of this file's SVG elements, with the colon
  std::unordered_map<std::string, pugi::xml_node> ids_;
  SvgStyleSheet styles_;
  std::vector<pugi::xml_node> active_;  ///< targets of use that are being drawn
  std::size_t budget_;                  ///< of what is drawn through use
  std::size_t empty_segments_ = 0;
  bool has_layers_ = false;  ///< Inkscape's
  std::map<std::string, int> numbers_;
  Drawing drawing_;
};

}  // namespace

Result<Drawing> parse_svg(string_view text, string_view name) {
  XmlFile file(text, name);
  OBVID_TRY(file.parse("svg"));
  if (string_view(file.root().attribute(kPictureAttribute).value()) == kPictureValue) {
    return error(ErrorCode::kUnsupported, "a picture to look at is no drawing of a curve")
        .where(std::string(name))
        .hint(
            "read the .json that was written with it, or write the curve alone with "
            "--svg drawing");
  }
  return SvgReader(file, text.size()).run();
}

}  // namespace obvid
