// SPDX-License-Identifier: Apache-2.0
#include "obvid/picture/surface_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "obvid/geom/internal/box.h"
#include "space/facets.h"
#include "space/lines.h"
#include "space/sheet.h"

namespace obvid {
namespace {

using namespace picture;

constexpr double kLeastSheet = 200.0, kMostSheet = 2000.0;  // px
constexpr int kMostIsolines = 200, kMostStripes = 100;
constexpr std::size_t kLeastFacets = 16, kMostFacets = 40'000;
/// Files beyond this (bytes) are drawn again with fewer facets, but not with fewer than so many.
constexpr std::size_t kMostFileText = 1'450'000, kFewestFacets = 1500;
/// Sizes beyond these leave the range of doubles when they are multiplied.
constexpr double kLeastSize = 1e-60, kMostSize = 1e60;

Error bad_option(const char* what, double value) {
  return error(ErrorCode::kBadOption, what).value(value);
}

Result<void> check_picture_options(const SurfacePictureOptions& o) {
  const auto sheet = [](double a) { return a >= kLeastSheet && a <= kMostSheet; };
  if (!sheet(o.width)) return fail(bad_option("a picture is 200 to 2000 px wide", o.width));
  if (!sheet(o.height)) return fail(bad_option("a picture is 200 to 2000 px high", o.height));
  for (const int n : {o.isolines_u, o.isolines_v}) {
    if (n < 1 || n > kMostIsolines) return fail(bad_option("isolines are 1 to 200", n));
  }
  if (o.zebra_stripes < 1 || o.zebra_stripes > kMostStripes) {
    return fail(bad_option("stripes are 1 to 100", o.zebra_stripes));
  }
  if (o.most_facets < kLeastFacets || o.most_facets > kMostFacets) {
    return fail(bad_option("a picture has 16 to 40000 facets", static_cast<double>(o.most_facets)));
  }
  if (o.range && !(std::isfinite(o.range->length()) && o.range->length() > 0.0)) {
    return fail(bad_option("a range of colours ascends", o.range->length()));
  }
  OBVID_TRY(check_deviation(o.colouring, o.deviation));
  for (const auto& angle : {o.azimuth_deg, o.elevation_deg}) {
    if (angle && !std::isfinite(*angle)) return fail(bad_option("an angle is finite", *angle));
  }
  return {};
}

Result<void> check_scene(const SurfaceModel& model, const SurfacePictureOptions& options) {
  if (model.patches.empty()) {
    return error(ErrorCode::kNothingThere, "there are no patches to draw");
  }
  if (model.patches.size() > options.most_facets) {
    return fail(bad_option("more patches than facets in a picture",
                           static_cast<double>(model.patches.size())));
  }
  for (const SurfacePatch& patch : model.patches) {
    OBVID_TRY(check(patch));
  }
  for (std::size_t i = 0; i < options.lines.size(); ++i) {
    for (const Vec3 p : options.lines[i].points) {
      if (!is_finite(p)) {
        return error(ErrorCode::kNotFinite, "a point of a line is not finite")
            .where(fmt::format("line {}", i + 1))
            .point(i);
      }
    }
  }
  return {};
}

Box3 box_of_patches(const std::vector<DrawnPatch>& patches) {
  Box3 box;
  for (const DrawnPatch& patch : patches) {
    for (const Vec3 p : patch.points) box.add(p);
  }
  return box;
}

/// The camera of the options so that everything fills the middle of the sheet.
PictureCamera fitted(const std::vector<DrawnPatch>& patches, const SurfacePictureOptions& options) {
  PictureCamera camera = camera_of(options);
  camera.centre = box_of_patches(patches).middle();
  Box3 seen;
  const auto see = [&](Vec3 p) { seen.add(camera.seen(p - camera.centre)); };
  for (const DrawnPatch& patch : patches) {
    for (const Vec3 p : patch.points) see(p);
  }
  for (const ScenePolyline& line : options.lines) {
    for (const Vec3 p : line.points) see(p);
  }
  if (options.colouring == SurfaceColouring::kDeviation) {
    for (const SceneDot& dot : shown_dots(options.deviation->dots)) see(dot.point);
  }
  const double width = options.width - 2.0 * kSheetMargin;
  const double height = options.height - kSheetTop - kSheetBottom - kSheetMargin;
  const Vec3 size = seen.size(), middle = seen.middle();
  const double least = kLeastSize;  // a line seen from its end
  camera.scale = std::min(width / std::max(size.x, least), height / std::max(size.y, least));
  camera.middle = {0.5 * options.width - camera.scale * middle.x,
                   kSheetTop + 0.5 * height + camera.scale * middle.y};
  return camera;
}

SheetTexts texts_of(const SurfaceModel& model, const std::vector<DrawnPatch>& patches,
                    const SurfacePictureOptions& options) {
  SheetTexts texts;
  texts.title = plain_text(options.title.empty() ? model.name : options.title);
  texts.units = plain_text(model.units.text());
  texts.facts = size_text(box_of_patches(patches).size(), texts.units);
  if (model.patches.size() > 1) {
    texts.facts += " · " + std::to_string(model.patches.size()) + " patches";
  }
  return texts;
}

Colours colours_of(const std::vector<DrawnPatch>& patches, const SurfacePictureOptions& options) {
  Colours colours{options.colouring, {}, options.zebra_stripes, 1.0, {}};
  const Box3 box = box_of_patches(patches);
  colours.ceiling = std::max(box.diagonal(), kLeastSize);
  colours.title = std::string(title_of(options.colouring));
  if (options.colouring == SurfaceColouring::kDeviation) {
    colours.title = plain_text(options.deviation->title);
    colours.scale = options.deviation->dots.empty()
                        ? scale_of(patches, options.colouring)
                        : scale_of_dots(options.deviation->dots, colours.ceiling);
    colours.scale.least = options.deviation->told.from;
    colours.scale.most = options.deviation->told.to;
  }
  if (!is_curvature(options.colouring)) return colours;
  colours.scale = scale_of(patches, options.colouring);
  if (options.extremes) {
    colours.scale.least = options.extremes->of(options.colouring).from;
    colours.scale.most = options.extremes->of(options.colouring).to;
  }
  if (options.range) {
    colours.scale.low = options.range->from;
    colours.scale.high = options.range->to;
    colours.scale.diverging = options.range->from == -options.range->to;
  }
  return colours;
}

/// Measured points in the colours of the scale; those far behind the surface are hidden.
std::string dots(const Scene& scene, const Colours& colours, const SurfacePictureOptions& options) {
  if (options.colouring != SurfaceColouring::kDeviation) return {};
  constexpr double kRadius = 2.0, kBefore = 8.0;  // px
  const ValueScale& scale = colours.scale;
  std::string out;
  for (const SceneDot& dot : shown_dots(options.deviation->dots)) {
    Vec3 at = scene.camera.project(dot.point);
    const Vec2 place{at.x, at.y};
    at.z += kBefore;
    if (!scene.depth.sees(at)) continue;
    const double part = scale.constant() ? 0.5 : (dot.value - scale.low) / (scale.high - scale.low);
    out += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.0f}\" fill=\"{}\"/>\n", place.x,
                       place.y, kRadius, hex(palette(scale.diverging, part)));
  }
  return out.empty() ? out : "<g stroke=\"#1c2733\" stroke-width=\"0.3\">\n" + out + "</g>\n";
}

Result<std::string> drawn(const SurfaceModel& model, const SurfacePictureOptions& options,
                          std::size_t facets, const RunContext& run) {
  Watch watch(run);
  auto patches = drawn_patches(model, options.colouring, facets, &watch);
  if (watch.was_cancelled()) return fail(cancelled_error());
  for (const DrawnPatch& patch : patches) {
    if (!std::all_of(patch.points.begin(), patch.points.end(),
                     [](Vec3 p) { return is_finite(p); })) {
      return error(ErrorCode::kNotFinite, "a point of the surface is not finite")
          .hint("change the unit");
    }
  }
  if (options.colouring == SurfaceColouring::kDeviation && options.deviation->of_place) {
    for (DrawnPatch& patch : patches) {
      auto offs = offs_at(
          *options.deviation, patch.points.size(), [&](std::size_t i) { return patch.points[i]; },
          run);
      OBVID_TRY(offs);
      patch.values = std::move(*offs);
    }
  }
  const double size = box_of_patches(patches).diagonal();
  if (!(size >= kLeastSize && size <= kMostSize)) {
    return error(ErrorCode::kSizeOutOfRange, "the size of the surface cannot be drawn")
        .hint("change the unit")
        .value(size);
  }
  const Colours colours = colours_of(patches, options);
  const PictureCamera camera = fitted(patches, options);
  DepthBuffer depth(options.width, options.height);
  const auto quads = projected(patches, camera);
  for (const auto& quad : quads) depth.add(quad);
  const Scene scene{model, patches, camera, depth};
  if (watch.cancelled()) return fail(cancelled_error());
  const std::string facet_text = facet_paths(patches, quads, depth, camera, colours, &watch);
  if (watch.cancelled()) return fail(cancelled_error());
  const SheetTexts texts = texts_of(model, patches, options);
  return sheet(texts, options,
               facet_text + surface_lines(scene, options) + extra_lines(scene, options.lines) +
                   dots(scene, colours, options) +
                   sheet_furniture(texts, camera, colours, options));
}

}  // namespace

Result<std::string> surface_svg(const SurfaceModel& model, const SurfacePictureOptions& options,
                                const RunContext& run) {
  OBVID_TRY(check_picture_options(options));
  OBVID_TRY(check_scene(model, options));
  std::size_t facets = options.most_facets;
  for (;;) {
    auto svg = drawn(model, options, facets, run);
    const std::size_t fewer = facets * 2 / 3;
    if (!svg || svg->size() <= kMostFileText || fewer < kFewestFacets + model.patches.size()) {
      return svg;
    }
    facets = fewer;
  }
}

}  // namespace obvid
