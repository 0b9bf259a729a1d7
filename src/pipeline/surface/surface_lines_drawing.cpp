// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "obvid/core/internal/figures.h"
#include "obvid/geom/internal/box.h"
#include "obvid/pipeline/surface_cut_job.h"

namespace obvid {
namespace {

constexpr double kApart = 0.08;  ///< of the length: space between the views

/// Puts the views on one sheet: x to the right, z (and below, the half-breadth) up.
class LinesDrawing {
 public:
  LinesDrawing(const MadeSurfaceCut& made, const std::string& title) : made_(made) {
    out_.title = title;
    out_.units = made.units;
    for (const MadeSection& section : made.sections) {
      if (section.kind == SectionKind::kPlane) continue;
      for (const SectionBranch& branch : section.section.branches) {
        for (const SectionPoint& p : branch.points)
          box_.add({p.point.x, std::abs(p.point.y), p.point.z});
      }
    }
  }

  Sketch run() {
    if (!box_.empty()) {
      middle_ = 0.5 * (box_.low.x + box_.high.x);
      breadth_ = box_.high.y;
      space_ = kApart * std::max(box_.size().x, std::max(breadth_, box_.size().z));
      draw_grid();
      for (const MadeSection& section : made_.sections) draw(section);
      for (const SectionKind kind :
           {SectionKind::kStation, SectionKind::kWaterline, SectionKind::kButtock}) {
        label(kind);
      }
      label_views();
      draw_scale();
      out_.remarks.push_back(fmt::format("length {}, half breadth {}, height {} {}",
                                         significant(box_.size().x, 5), significant(breadth_, 5),
                                         significant(box_.size().z, 5), made_.units.text()));
    }
    draw_planes();
    out_.layers = {std::move(grid_), std::move(stations_), std::move(waterlines_),
                   std::move(buttocks_), std::move(planes_)};
    return std::move(out_);
  }

 private:
  // the three views
  [[nodiscard]] Vec2 in_profile(double x, double z) const { return {x, z}; }
  [[nodiscard]] Vec2 in_plan(double x, double y) const {
    return {x, box_.low.z - space_ - breadth_ + std::abs(y)};
  }
  [[nodiscard]] double body_centre() const { return box_.high.x + space_ + breadth_; }
  /// Sections before the middle to the right, behind it to the left.
  [[nodiscard]] Vec2 in_body(double x, double y, double z) const {
    return {body_centre() + (x >= middle_ ? std::abs(y) : -std::abs(y)), z};
  }

  void line(SketchLayer& layer, Vec2 a, Vec2 b) { layer.polylines.push_back({a, b}); }

  void draw_grid() {
    const double x0 = box_.low.x, x1 = box_.high.x, z0 = box_.low.z, z1 = box_.high.z;
    line(grid_, in_plan(x0, 0.0), in_plan(x1, 0.0));
    line(grid_, {body_centre(), z0}, {body_centre(), z1});
    for (const MadeSection& s : made_.sections) {
      if (s.section.branches.empty()) continue;
      if (s.kind == SectionKind::kStation) {
        line(grid_, in_profile(s.at, z0), in_profile(s.at, z1));
        line(grid_, in_plan(s.at, 0.0), in_plan(s.at, breadth_));
      } else if (s.kind == SectionKind::kWaterline) {
        line(grid_, in_profile(x0, s.at), in_profile(x1, s.at));
        line(grid_, {body_centre() - breadth_, s.at}, {body_centre() + breadth_, s.at});
      } else if (s.kind == SectionKind::kButtock) {
        line(grid_, in_plan(x0, s.at), in_plan(x1, s.at));
        for (const double side : {1.0, -1.0}) {
          const double y = body_centre() + side * std::abs(s.at);
          line(grid_, {y, z0}, {y, z1});
        }
      }
    }
  }

  void draw(const MadeSection& section) {
    if (section.kind == SectionKind::kPlane) return;
    SketchLayer& layer = section.kind == SectionKind::kStation     ? stations_
                         : section.kind == SectionKind::kWaterline ? waterlines_
                                                                   : buttocks_;
    for (const SectionBranch& branch : section.section.branches) {
      std::vector<Vec2> points;
      for (const SectionPoint& s : branch.points) {
        const Vec3 p = s.point;
        points.push_back(section.kind == SectionKind::kStation     ? in_body(section.at, p.y, p.z)
                         : section.kind == SectionKind::kWaterline ? in_plan(p.x, p.y)
                                                                   : in_profile(p.x, p.z));
      }
      if (branch.closed) points.push_back(points.front());
      layer.polylines.push_back(std::move(points));
    }
  }

  /// The places of one kind of sections beside their traces, where there is room for the words.
  void label(SectionKind kind) {
    std::vector<double> places;
    for (const MadeSection& section : made_.sections) {
      if (section.kind == kind && !section.section.branches.empty()) places.push_back(section.at);
    }
    std::sort(places.begin(), places.end());
    // letters as they come out in the picture, whose drawing is 900 wide or high
    constexpr double kDrawing = 900.0, kLetter = 8.0, kLine = 14.0;
    const double wide = body_centre() + breadth_ - box_.low.x;
    const double high = box_.size().z + 2.6 * space_ + breadth_;
    const double pixel = std::max(wide, high) / kDrawing;
    double free_from = -std::numeric_limits<double>::infinity();
    for (const double at : places) {
      const double shown = kind == SectionKind::kButtock ? std::abs(at) : at;
      if (shown < free_from) continue;
      const std::string text = significant(at, 4);
      const bool station = kind == SectionKind::kStation;
      free_from =
          shown + pixel * (station ? kLetter * static_cast<double>(text.size() + 1) : kLine);
      word(station                         ? in_profile(at, box_.low.z - 0.3 * space_)
           : kind == SectionKind::kButtock ? in_plan(box_.high.x, at)
                                           : in_profile(box_.high.x, at),
           text);
    }
  }

  void word(Vec2 at, std::string text) { out_.words.push_back({at, std::move(text)}); }

  void label_views() {
    const double above = box_.high.z + 0.3 * space_;
    word({box_.low.x, above}, "Profile");
    word({body_centre() - breadth_, above}, "Body plan: aft of the middle left, fore right");
    word({box_.low.x, box_.low.z - 0.75 * space_}, "Half-breadth plan");
  }

  /// A bar of a round length below the views.
  void draw_scale() {
    const double wanted = 0.2 * std::max(box_.size().x, breadth_);
    const double ten = std::pow(10.0, std::floor(std::log10(wanted)));
    const double length = ten * (wanted >= 5.0 * ten ? 5.0 : wanted >= 2.0 * ten ? 2.0 : 1.0);
    const double y = box_.low.z - 1.6 * space_ - breadth_, tick = 0.1 * space_;
    line(grid_, {box_.low.x, y}, {box_.low.x + length, y});
    for (const double x : {box_.low.x, box_.low.x + length})
      line(grid_, {x, y - tick}, {x, y + tick});
    word({box_.low.x, y}, "0");
    word({box_.low.x + length, y}, significant(length, 3) + " " + made_.units.text());
    lowest_ = y - space_;
  }

  /// Other planes, one beside the other below all, each in its own coordinates.
  void draw_planes() {
    double left = box_.empty() ? 0.0 : box_.low.x;
    for (const MadeSection& section : made_.sections) {
      if (section.kind != SectionKind::kPlane || section.section.branches.empty()) continue;
      Box2 own;
      for (const SectionBranch& branch : section.section.branches) {
        for (const SectionPoint& p : branch.points) own.add(section.frame.in_plane(p.point));
      }
      const Vec2 move{left - own.low.x, lowest_ - own.high.y};
      for (const SectionBranch& branch : section.section.branches) {
        std::vector<Vec2> points;
        for (const SectionPoint& p : branch.points) {
          points.push_back(section.frame.in_plane(p.point) + move);
        }
        if (branch.closed) points.push_back(points.front());
        planes_.polylines.push_back(std::move(points));
      }
      word({left, lowest_}, section.name);
      left += own.size().x + kApart * made_.size;
    }
  }

  const MadeSurfaceCut& made_;
  Sketch out_;
  Box3 box_;  ///< of lines; y without its sign
  double middle_ = 0.0, breadth_ = 0.0, space_ = 0.0, lowest_ = 0.0;
  SketchLayer grid_ =
      sketch_layer("GRID", "traces of the planes, centre line, scale", "#b9c2cc", 8, 0.6);
  SketchLayer stations_ = sketch_layer("STATIONS", "stations", "#1c2733", 7, 1.2);
  SketchLayer waterlines_ = sketch_layer("WATERLINES", "waterlines", "#1b6ec2", 5, 1.2);
  SketchLayer buttocks_ = sketch_layer("BUTTOCKS", "buttocks", "#cf5a12", 30, 1.2);
  SketchLayer planes_ = sketch_layer("PLANES", "other planes", "#a3209b", 6, 1.2);
};

}  // namespace

Sketch lines_drawing(const MadeSurfaceCut& made, const std::string& title) {
  return LinesDrawing(made, title).run();
}

}  // namespace obvid
