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

/// A height by a cubic from a station on: a + b x + c x^2 + d x^3.
struct Elevation {
  double s = 0.0, a = 0.0, b = 0.0, c = 0.0, d = 0.0;
};

/// The cubic with heights and grades of both ends; of a parabola the parabola.
Elevation cubic_between(double s, const ProfilePlace& from, const ProfilePlace& to, double length) {
  const double rise = (to.height - from.height) / length;
  return {s, from.height, from.grade, (3.0 * rise - 2.0 * from.grade - to.grade) / length,
          (from.grade + to.grade - 2.0 * rise) / (length * length)};
}

/// Cubics for an arc: as many of equal length as keep the middle of each within the tolerance.
void add_arc(const VerticalProfile& profile, const ProfileElement& e, double first_station,
             double tolerance, std::vector<Elevation>& out) {
  constexpr int kMostCubics = 1024;  // an error shrinks to the fourth power with their length
  for (int count = 1;; count *= 2) {
    std::vector<Elevation> parts;
    double largest = 0.0;
    const double length = e.length / count;
    for (int k = 0; k < count; ++k) {
      const double station = e.station + k * length;
      const double end = k + 1 == count ? e.station + e.length : station + length;
      const Elevation one = cubic_between(station - first_station, profile_at(profile, station),
                                          profile_at(profile, end), length);
      const double x = 0.5 * length;
      const double height = one.a + x * (one.b + x * (one.c + x * one.d));
      largest = std::max(largest, std::abs(height - profile_at(profile, station + x).height));
      parts.push_back(one);
    }
    if (largest > tolerance && count < kMostCubics) continue;
    out.insert(out.end(), parts.begin(), parts.end());
    return;
  }
}

/// Elevations of a whole alignment, stations from its start on.
std::vector<Elevation> elevations_of(const OpenDriveOptions& options) {
  std::vector<Elevation> out;
  if (!options.profile) return out;
  const VerticalProfile& profile = *options.profile;
  const double before = profile.elements.front().station - options.first_station;
  if (before > 0.0) {
    const ProfilePlace start = profile_at(profile, options.first_station);
    out.push_back({0.0, start.height, start.grade, 0.0, 0.0});
  }
  for (const ProfileElement& e : profile.elements) {
    const double s = e.station - options.first_station;
    if (e.kind == ProfileKind::kGrade) {
      out.push_back({s, e.height, e.grade0, 0.0, 0.0});
    } else if (profile.curves == ProfileCurves::kParabolas) {
      out.push_back({s, e.height, e.grade0, 0.5 / e.radius, 0.0});
    } else {
      add_arc(profile, e, options.first_station, options.tolerance, out);
    }
  }
  if (profile.elements.back().kind != ProfileKind::kGrade) {
    out.push_back({profile.end_station - options.first_station, profile.end_height,
                   profile.elements.back().grade1, 0.0, 0.0});
  }
  return out;
}

/// The same cubic, from farther on.
Elevation moved_on(const Elevation& e, double by) {
  return {e.s + by, e.a + by * (e.b + by * (e.c + by * e.d)),
          e.b + by * (2.0 * e.c + 3.0 * by * e.d), e.c + 3.0 * by * e.d, e.d};
}

class OpenDriveWriter {
 public:
  /// `ratio`: metres in one unit of the contour.
  OpenDriveWriter(const std::vector<RoadLine>& lines, bool closed, const OpenDriveOptions& options,
                  double ratio)
      : lines_(lines),
        closed_(closed),
        options_(options),
        ratio_(ratio),
        elevations_(elevations_of(options)) {}

  std::string run() {
    const Box2 box = box_of_roads(lines_);
    put("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<OpenDRIVE>\n");
    put("  <header revMajor=\"1\" revMinor=\"6\" name=\"{}\" version=\"1.00\" north=\"{}\" "
        "south=\"{}\" east=\"{}\" west=\"{}\"/>\n",
        escaped_xml(options_.name), box.high.y, box.low.y, box.high.x, box.low.x);
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      road(i);
      before_ += lines_[i].length;
    }
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
    if (!elevations_.empty()) elevation_profile(lines_[i].length);
    lanes();
    put("  </road>\n");
  }

  /// Of the road that begins behind `before_`: the cubics over it, the first one from its start.
  void elevation_profile(double length) {
    put("    <elevationProfile>\n");
    for (std::size_t k = 0; k < elevations_.size(); ++k) {
      Elevation e = elevations_[k];
      const bool last = k + 1 == elevations_.size();
      if (ratio_ * e.s >= before_ + length) break;
      if (!last && ratio_ * elevations_[k + 1].s <= before_) continue;
      if (ratio_ * e.s < before_) e = moved_on(e, before_ / ratio_ - e.s);
      put("      <elevation s=\"{}\" a=\"{}\" b=\"{}\" c=\"{}\" d=\"{}\"/>\n",
          std::max(ratio_ * e.s - before_, 0.0), ratio_ * e.a, e.b, e.c / ratio_,
          e.d / (ratio_ * ratio_));
    }
    put("    </elevationProfile>\n");
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
  double ratio_;
  std::vector<Elevation> elevations_;  ///< units of the contour
  double before_ = 0.0;                ///< m: length of the roads before this one
  std::string out_;
};

}  // namespace

Result<std::string> opendrive_text(const Contour& contour, const OpenDriveOptions& options) {
  if (!(options.lane_width >= 0.0) || !std::isfinite(options.lane_width)) {
    return error(ErrorCode::kBadOption, "the width of the lane must not be negative")
        .value(options.lane_width);
  }
  const auto lines = road_lines(contour, "m");
  OBVID_TRY(lines);
  const auto ratio = unit_ratio(contour.units, "m", "road formats");
  OBVID_TRY(ratio);
  return OpenDriveWriter(*lines, contour.closed, options, *ratio).run();
}

}  // namespace obvid
