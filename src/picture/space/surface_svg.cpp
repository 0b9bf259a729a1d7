// SPDX-License-Identifier: Apache-2.0
#include "obvid/picture/surface_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

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

/// Bodies so many times as long as they are wide, in space and on the sheet, are turned level on a
/// wide one, and those longer there have their parts drawn larger, each about so long for its
/// width.
constexpr double kLong = 6.0, kThinBody = 12.0, kPartLong = 8.0;
constexpr long kFewestParts = 3, kMostParts = 6;
/// Width of their sheet, of that of others; room over and under a strip, px.
constexpr double kWide = 1.4, kStripRoom = 8.0;

/// From end to end of a body along its longest axis of inertia, through the middle of its points.
struct LongWay {
  Vec3 from, to;
  double wide = 0.0;  ///< units across it: a plate is as wide as it is
};
template <class Visit>
void each_point(const std::vector<DrawnPatch>& patches, const Visit& visit) {
  for (const DrawnPatch& patch : patches) {
    for (const Vec3 p : patch.points) visit(p);
  }
}
LongWay long_way(const std::vector<DrawnPatch>& patches) {
  constexpr int kTurns = 60;  // of the power iteration: exact to 1e-9 where it is twice as long
  const Box3 box = box_of_patches(patches);
  Vec3 middle;
  double count = 0.0;
  each_point(patches, [&](Vec3 p) {
    middle = middle + p;
    count += 1.0;
  });
  middle = (1.0 / count) * middle;
  std::array<Vec3, 3> moments;
  each_point(patches, [&](Vec3 p) {
    const Vec3 q = (1.0 / box.diagonal()) * (p - middle);
    moments[0] = moments[0] + q.x * q;
    moments[1] = moments[1] + q.y * q;
    moments[2] = moments[2] + q.z * q;
  });
  Vec3 axis = *std::max_element(moments.begin(), moments.end(),
                                [](Vec3 a, Vec3 b) { return norm(a) < norm(b); });
  for (int i = 0; i < kTurns; ++i) {
    const Vec3 next{dot(moments[0], axis), dot(moments[1], axis), dot(moments[2], axis)};
    if (!(norm(next) > 0.0)) break;
    axis = unit(next);
  }
  axis = unit(axis);
  const Vec3 aside = unit(cross(axis, std::abs(axis.z) < 0.5 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}));
  Box3 along;
  each_point(patches, [&](Vec3 p) {
    const Vec3 q = p - middle;
    along.add({dot(q, axis), dot(q, aside), dot(q, cross(axis, aside))});
  });
  return {middle + along.low.x * axis, middle + along.high.x * axis,
          std::max(along.size().y, along.size().z)};
}

/// How many times as long as it is wide.
double slenderness(const LongWay& way) {
  return norm(way.to - way.from) / std::max(way.wide, std::numeric_limits<double>::min());
}

/// Coordinate along which most of the way runs.
std::size_t most_along(const LongWay& way) {
  const Vec3 d = way.to - way.from;
  const std::array<double, 3> size = {std::abs(d.x), std::abs(d.y), std::abs(d.z)};
  return static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
}
double coordinate(Vec3 p, std::size_t k) { return k == 0 ? p.x : k == 1 ? p.y : p.z; }

/// Turned about the direction of view so that the way lies level; by 90 degrees at most but where
/// it stood about upright: there its coordinate grows to the right.
PictureCamera levelled(PictureCamera camera, const LongWay& way) {
  constexpr double kUpright = 0.2;  // of the length: within some 10 degrees
  const std::size_t k = most_along(way);
  Vec3 seen = camera.seen(way.to - way.from);
  if (coordinate(way.to, k) < coordinate(way.from, k)) seen = -1.0 * seen;
  const double length = std::hypot(seen.x, seen.y);
  if (!(length > 0.0)) return camera;
  if (seen.x < -kUpright * length) seen = -1.0 * seen;
  const double c = seen.x / length, s = seen.y / length;
  const Vec3 right = camera.right, up = camera.up;
  camera.right = c * right + s * up;
  camera.up = c * up - s * right;
  return camera;
}

Box3 seen_by(const PictureCamera& camera, const std::vector<DrawnPatch>& patches,
             const SurfacePictureOptions& options) {
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
  return seen;
}

/// The camera so that everything seen fills the middle of the sheet.
PictureCamera fitted(PictureCamera camera, const Box3& seen, const SurfacePictureOptions& options) {
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

/// What is drawn, from any camera.
struct Drawing {
  const SurfaceModel& model;
  const std::vector<DrawnPatch>& patches;
  Colours colours;
  const SurfacePictureOptions& options;
  Watch& watch;

  /// On a sheet of this size, px.
  [[nodiscard]] Result<std::string> on(const PictureCamera& camera, double width,
                                       double height) const {
    DepthBuffer depth(width, height);
    const auto quads = projected(patches, camera);
    for (const auto& quad : quads) depth.add(quad);
    const Scene scene{model, patches, camera, depth};
    if (watch.cancelled()) return fail(cancelled_error());
    const std::string facets = facet_paths(patches, quads, depth, camera, colours, &watch);
    if (watch.cancelled()) return fail(cancelled_error());
    return facets + surface_lines(scene, options) + extra_lines(scene, options.lines) +
           dots(scene, colours, options);
  }

  /// A strip over the whole width of the sheet that shows [from, to] of what is level (units to the
  /// right of the centre) between the margins: its camera and its height.
  [[nodiscard]] std::pair<PictureCamera, double> strip(PictureCamera camera, Range shown,
                                                       const Range& else_heights,
                                                       double width) const {
    camera.scale = (width - 2.0 * kSheetMargin) / shown.length();
    const double room = kSheetMargin / camera.scale;
    Box3 box;
    for (const DrawnPatch& patch : patches) {
      for (const Vec3 p : patch.points) {
        const Vec3 seen = camera.seen(p - camera.centre);
        if (seen.x >= shown.from - room && seen.x <= shown.to + room) box.add(seen);
      }
    }
    const Range heights = box.empty() ? else_heights : Range{box.low.y, box.high.y};
    const double height = std::ceil(camera.scale * heights.length() + 2.0 * kStripRoom);
    camera.middle = {kSheetMargin - camera.scale * shown.from,
                     0.5 * height + camera.scale * 0.5 * (heights.from + heights.to)};
    return {camera, height};
  }
};

/// Where a part lies: the coordinate that most of the way runs along, or how far from its left end.
std::string place_of(const PictureCamera& camera, const LongWay& way, Range shown,
                     const std::string& units) {
  constexpr double kAlong = 0.9;
  constexpr int kDigits = 6;
  const double x0 = camera.seen(way.from - camera.centre).x;
  const double x1 = camera.seen(way.to - camera.centre).x;
  const Vec3 d = way.to - way.from;
  // a thousandth of the length or finer
  const double step = std::pow(10.0, std::floor(std::log10(norm(d))) - 3.0);
  const auto told = [step](double value) {
    return readable(step * std::round(value / step) + 0.0, kDigits);
  };
  const auto part = [&](double x) { return std::clamp((x - x0) / (x1 - x0), 0.0, 1.0); };
  const std::size_t k = most_along(way);
  if (std::abs(coordinate(d, k)) >= kAlong * norm(d)) {
    const auto at = [&](double x) { return told(coordinate(way.from + part(x) * d, k)); };
    return fmt::format("{} from {} to {} {}", "xyz"[k], at(shown.from), at(shown.to), units);
  }
  const double left = x0 < x1 ? 0.0 : 1.0;
  const auto at = [&](double x) { return told(std::abs(part(x) - left) * norm(d)); };
  return fmt::format("{} to {} {} from the left end", at(shown.from), at(shown.to), units);
}

std::string placed(const std::string& strip, double top, double width, double height) {
  return fmt::format(
      "<svg x=\"0\" y=\"{0:.0f}\" width=\"{1:.0f}\" height=\"{2:.0f}\" "
      "viewBox=\"0 0 {1:.0f} {2:.0f}\">\n{3}</svg>\n",
      top, width, height, strip);
}

/// A thin body as a whole, and below its equal parts drawn larger. Sets the height of the sheet.
Result<std::string> in_parts(const Drawing& drawing, const PictureCamera& level, const LongWay& way,
                             const Box3& seen, const SheetTexts& texts,
                             SurfacePictureOptions& sheet_options) {
  const double width = std::round(sheet_options.width);
  sheet_options.width = width;
  const Range all{seen.low.x, seen.high.x}, heights{seen.low.y, seen.high.y};
  const auto [whole, whole_height] = drawing.strip(level, all, heights, width);
  auto text = drawing.on(whole, width, whole_height);
  OBVID_TRY(text);
  std::string body = placed(*text, kSheetTop, width, whole_height);
  const double ratio =
      all.length() / std::max(heights.length(), std::numeric_limits<double>::min());
  const long count =
      std::clamp(std::lround(std::min(ratio / kPartLong, 100.0)), kFewestParts, kMostParts);
  const double under = kSheetTop + whole_height;
  double y = under + kPartNumbers;
  std::vector<SheetPart> parts;
  for (long i = 0; i < count; ++i) {
    const double n = static_cast<double>(count), k = static_cast<double>(i);
    const Range shown{all.at(k / n), all.at((k + 1.0) / n)};
    const auto [camera, height] = drawing.strip(level, shown, heights, width);
    y += kPartCaption;
    parts.push_back({whole.middle.x + whole.scale * shown.from,
                     whole.middle.x + whole.scale * shown.to, y, camera.scale,
                     place_of(level, way, shown, texts.units)});
    text = drawing.on(camera, width, height);
    OBVID_TRY(text);
    body += placed(*text, y, width, height);
    y += height;
  }
  sheet_options.height = std::ceil(y + kSheetBottom + kSheetMargin);
  return body + sheet_furniture(texts, whole, drawing.colours, sheet_options, under, parts);
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
  const Drawing drawing{model, patches, colours_of(patches, options), options, watch};
  PictureCamera camera = camera_of(options);
  camera.centre = box_of_patches(patches).middle();
  const LongWay way = long_way(patches);
  const PictureCamera level = levelled(camera, way);
  const Box3 seen_level = seen_by(level, patches, options);
  const double ratio =
      slenderness(way) < kLong
          ? 1.0
          : seen_level.size().x / std::max(seen_level.size().y, std::numeric_limits<double>::min());
  const SheetTexts texts = texts_of(model, patches, options);
  SurfacePictureOptions sheet_options = options;
  if (ratio >= kThinBody) {
    sheet_options.width = std::min(kWide * options.width, kMostSheet);
    auto text = in_parts(drawing, level, way, seen_level, texts, sheet_options);
    OBVID_TRY(text);
    return sheet(texts, sheet_options, *text);
  }
  if (ratio >= kLong) {
    camera = level;
    sheet_options.width = std::min(kWide * options.width, kMostSheet);
    const double wide = sheet_options.width - 2.0 * kSheetMargin;
    sheet_options.height = std::ceil(wide / ratio + kSheetTop + kSheetBottom + kSheetMargin);
  }
  const Box3 seen = ratio >= kLong ? seen_level : seen_by(camera, patches, options);
  camera = fitted(camera, seen, sheet_options);
  auto body = drawing.on(camera, sheet_options.width, sheet_options.height);
  OBVID_TRY(body);
  return sheet(texts, sheet_options,
               *body + sheet_furniture(texts, camera, drawing.colours, sheet_options));
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
