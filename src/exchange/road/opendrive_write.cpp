// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "obvid/core/internal/format_into.h"
#include "obvid/curve/internal/clothoid.h"
#include "obvid/exchange/internal/road/opendrive.h"
#include "obvid/exchange/internal/road/road_elements.h"
#include "obvid/geom/internal/box.h"
#include "xml_text.h"

namespace obvid {
namespace {

constexpr int kBoxSamples =
    16;  // of each element, for the box in the header, which is information only

Box2 box_of_roads(const std::vector<RoadLine>& lines) {
  Box2 box;
  for (const RoadLine& line : lines) {
    for (const RoadElement& e : line.elements) {
      for (int k = 0; k <= kBoxSamples; ++k) {
        const double part = static_cast<double>(k) / kBoxSamples, s = part * e.length;
        const double kappa = e.kappa0 + part * (e.kappa1 - e.kappa0);
        box.add(e.start + clothoid_step(e.theta, e.kappa0, kappa, s));
      }
    }
  }
  return box;
}

class OpenDriveWriter {
 public:
  OpenDriveWriter(const std::vector<RoadLine>& lines, bool closed, const OpenDriveOptions& options)
      : lines_(lines), closed_(closed), options_(options) {}

  std::string run() {
    const Box2 box = box_of_roads(lines_);
    put("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<OpenDRIVE>\n");
    put("  <header revMajor=\"1\" revMinor=\"6\" name=\"{}\" version=\"1.00\" north=\"{}\" "
        "south=\"{}\" east=\"{}\" west=\"{}\"/>\n",
        escaped_xml(options_.name), box.high.y, box.low.y, box.high.x, box.low.x);
    for (std::size_t i = 0; i < lines_.size(); ++i) road(i);
    put("</OpenDRIVE>\n");
    return std::move(out_);
  }

 private:
  template <class... Args>
  void put(fmt::format_string<Args...> text, Args&&... args) {
    format_into(out_, text, std::forward<Args>(args)...);
  }

  void road(std::size_t i) {
    put("  <road name=\"{}\" length=\"{}\" id=\"{}\" junction=\"-1\">\n",
        escaped_xml(options_.name), lines_[i].length, i + 1);
    link(i);
    put("    <planView>\n");
    for (const RoadElement& element : lines_[i].elements) geometry(element);
    put("    </planView>\n");
    lanes();
    put("  </road>\n");
  }

  void link(std::size_t i) {
    const std::size_t count = lines_.size();
    const bool before = i > 0 || closed_, after = i + 1 < count || closed_;
    if (!before && !after) return put("    <link/>\n");
    put("    <link>\n");
    if (before) neighbour("predecessor", (i + count - 1) % count, "end");
    if (after) neighbour("successor", (i + 1) % count, "start");
    put("    </link>\n");
  }

  void neighbour(const char* kind, std::size_t i, const char* contact) {
    put("      <{} elementType=\"road\" elementId=\"{}\" contactPoint=\"{}\"/>\n", kind, i + 1,
        contact);
  }

  void geometry(const RoadElement& e) {
    put("      <geometry s=\"{}\" x=\"{}\" y=\"{}\" hdg=\"{}\" length=\"{}\">", e.s, e.start.x,
        e.start.y, e.theta, e.length);
    if (e.is_line()) {
      put("<line/>");
    } else if (e.is_arc()) {
      put("<arc curvature=\"{}\"/>", e.kappa0);
    } else {
      put("<spiral curvStart=\"{}\" curvEnd=\"{}\"/>", e.kappa0, e.kappa1);
    }
    put("</geometry>\n");
  }

  void lanes() {
    put("    <lanes>\n      <laneSection s=\"0\">\n        <center>\n"
        "          <lane id=\"0\" type=\"none\" level=\"false\"/>\n        </center>\n");
    if (options_.lane_width > 0.0) {
      put("        <right>\n          <lane id=\"-1\" type=\"driving\" level=\"false\">\n"
          "            <width sOffset=\"0\" a=\"{}\" b=\"0\" c=\"0\" d=\"0\"/>\n"
          "          </lane>\n        </right>\n",
          options_.lane_width);
    }
    put("      </laneSection>\n    </lanes>\n");
  }

  const std::vector<RoadLine>& lines_;
  bool closed_;
  const OpenDriveOptions& options_;
  std::string out_;
};

}  // namespace

Result<std::string> opendrive_text(const Contour& contour, const OpenDriveOptions& options) {
  if (!(options.lane_width >= 0.0) || !std::isfinite(options.lane_width)) {
    return fail({ErrorCode::kBadOption, "the width of the lane must not be negative", "", "", -1,
                 options.lane_width});
  }
  const auto lines = road_lines(contour, "m");
  if (!lines) return fail(lines.error());
  return OpenDriveWriter(*lines, contour.closed, options).run();
}

}  // namespace obvid
