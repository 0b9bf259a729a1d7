// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/surface_values.h"

#include <cmath>
#include <map>

#include "obvid/core/internal/near_name.h"
#include "obvid/core/internal/typed_numbers.h"
#include "obvid/exchange/internal/gcode/dialect.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/pipeline/internal/job_values.h"

namespace obvid {
namespace {

const std::map<std::string, SurfaceKind>& surface_kinds() {
  static const std::map<std::string, SurfaceKind> all = {
#define OBVID_SURFACE_KIND(kind, name, ...) {name, kind{}},
#include "obvid/pipeline/surface_kinds.inc"
#undef OBVID_SURFACE_KIND
  };
  return all;
}

/// "1,2,3" as a vector.
Result<Vec3> vector_of(const std::string& typed, const char* option) {
  const auto value = typed_numbers(typed);
  if (value && value->size() == 3) return Vec3{(*value)[0], (*value)[1], (*value)[2]};
  return fail(bad_option("'" + typed + "' is no vector", option, "give X,Y,Z, for example 0,0,1"));
}

Result<void> set_stock(const std::string& typed, ToolpathOptions& plan) {
  if (typed.empty()) return {};
  const auto v = typed_numbers(typed);
  if (!v || v->size() != 6) {
    return fail(bad_option("'" + typed + "' is no box", "--stock",
                           "give X0,Y0,Z0,X1,Y1,Z1: its lowest and its highest corner"));
  }
  plan.stock = {Vec3{(*v)[0], (*v)[1], (*v)[2]}, Vec3{(*v)[3], (*v)[4], (*v)[5]}};
  return {};
}

Result<void> positive(const std::optional<double>& value, const char* option) {
  if (!value || (*value > 0.0 && std::isfinite(*value))) return {};
  return fail(bad_option("the value must be greater than 0", option, ""));
}

// One function for each kind: its values out of what was typed.

Result<void> set_kind(const SurfaceValues& raw, SkinKind& kind) {
  const auto matching = value_named<SkinMatching>({{"auto", SkinMatching::kAutomatic},
                                                   {"points", SkinMatching::kByPoints},
                                                   {"length", SkinMatching::kByLength},
                                                   {"angle", SkinMatching::kByAngle},
                                                   {"optimised", SkinMatching::kOptimised}},
                                                  raw.matching, "--match");
  OBVID_TRY(matching);
  kind.matching = *matching;
  kind.straight_across = kind.straight_across || raw.straight;
  kind.spacing = raw.spacing;
  OBVID_TRY(positive(raw.light, "--light"));
  kind.light = raw.light;
  OBVID_TRY(positive(raw.fair_across, "--fair-across"));
  if (raw.fair_across && raw.light && !(*raw.light < *raw.fair_across)) {
    return fail(bad_option("light and fair across: the light skin takes a part of the tolerance",
                           "--light", "give --light less than --fair-across"));
  }
  if (raw.fair_across && kind.straight_across) {
    return fail(bad_option("ruled strips have no bending across that could be fair",
                           "--fair-across", "leave out --straight or --fair-across"));
  }
  kind.fair_across = raw.fair_across;
  return {};
}

Result<void> set_kind(const SurfaceValues& raw, RuledKind& kind) {
  if (!raw.direction.empty() && !raw.apex.empty()) {
    return fail(bad_option("--direction and --apex contradict each other", "", "give one of them"));
  }
  if (!raw.direction.empty()) {
    const auto direction = vector_of(raw.direction, "--direction");
    OBVID_TRY(direction);
    kind.direction = *direction;
  }
  if (!raw.apex.empty()) {
    const auto apex = vector_of(raw.apex, "--apex");
    OBVID_TRY(apex);
    kind.apex = *apex;
  }
  return set_kind(raw, kind.strips);
}

/// "x", "Y", ... as 0, 1, 2.
std::optional<std::size_t> axis_number(const std::string& typed) {
  if (typed.size() != 1) return std::nullopt;
  const std::size_t at = std::string("xyzXYZ").find(typed);
  return at == std::string::npos ? std::nullopt : std::optional(at % 3);
}

/// "x", "y", "z" or "X,Y,Z".
Result<Vec3> direction_of(const std::string& typed, const char* option) {
  const std::map<std::string, Vec3> axes = {{"x", {1, 0, 0}}, {"y", {0, 1, 0}}, {"z", {0, 0, 1}}};
  const auto at = axes.find(typed);
  auto direction = at != axes.end() ? Result<Vec3>(at->second) : vector_of(typed, option);
  if (direction && !(norm(*direction) > 0.0)) {
    return fail(bad_option("the axis has no direction", option, "give x, y, z or X,Y,Z"));
  }
  return direction;
}

Result<void> set_kind(const SurfaceValues& raw, RevolveKind& kind) {
  const auto direction = direction_of(raw.axis, "--axis");
  OBVID_TRY(direction);
  kind.axis_direction = *direction;
  if (!raw.axis_point.empty()) {
    const auto point = vector_of(raw.axis_point, "--axis-point");
    OBVID_TRY(point);
    kind.axis_point = *point;
  }
  if (raw.angle_deg) {
    if (!(std::abs(*raw.angle_deg) > 0.0 && std::abs(*raw.angle_deg) <= 360.0)) {
      return fail(bad_option("the angle must lie in -360 to 360 and not be 0", "--angle", ""));
    }
    kind.angle = *raw.angle_deg * kOneDegree;
  }
  return {};
}

Result<void> set_kind(const SurfaceValues&, CoonsKind&) { return {}; }
Result<void> set_kind(const SurfaceValues&, GordonKind&) { return {}; }
Result<void> set_kind(const SurfaceValues&, ConvertKind&) { return {}; }

Result<void> set_kind(const SurfaceValues& raw, GridReading& reading) {
  const auto spread = value_named<Spread>({{"chord", Spread::kChord},
                                           {"centripetal", Spread::kCentripetal},
                                           {"uniform", Spread::kUniform}},
                                          raw.spread, "--spread");
  OBVID_TRY(spread);
  reading.spread = *spread;
  reading.spacing = raw.spacing;
  if (raw.row) {
    if (*raw.row < 1) return fail(bad_option("rows have points", "--row", "give 2 or more"));
    reading.row = static_cast<std::size_t>(*raw.row);
  }
  return {};
}

Result<void> set_kind(const SurfaceValues& raw, GridKind& kind) {
  if (raw.near && raw.control) {
    return fail(bad_option("--near and --control contradict each other", "", "give one of them"));
  }
  kind.use = raw.near ? GridUse::kNear : raw.control ? GridUse::kControl : GridUse::kThrough;
  return set_kind(raw, kind.reading);
}

Result<void> set_kind(const SurfaceValues& raw, IdKind& kind) {
  kind.smooth = raw.smooth;
  return set_kind(raw, kind.reading);
}

Result<void> set_kind(const SurfaceValues& raw, OffsetKind& kind) {
  kind.distance = raw.distance.value_or(std::nan(""));
  if (std::isfinite(kind.distance)) return {};
  return fail(bad_option("an offset needs its distance", "--distance", "give a number"));
}

Result<void> set_kind(const SurfaceValues& raw, ScatterKind& kind) {
  if (!raw.tolerance) {
    return fail(bad_option("scattered points need a tolerance", "--tolerance",
                           "give the largest distance of a point, not below their noise"));
  }
  if (raw.up != "best") {
    const auto up = direction_of(raw.up, "--up");
    OBVID_TRY(up);
    kind.up = *up;
  }
  if (raw.steepest_deg) {
    if (!(*raw.steepest_deg > 0.0 && *raw.steepest_deg < 90.0)) {
      return fail(bad_option("the angle must lie between 0 and 90 degrees", "--steepest", ""));
    }
    kind.steepest = *raw.steepest_deg * kOneDegree;
  }
  kind.drop_outliers = raw.drop_outliers;
  return {};
}

/// "NX,NY,NZ,D" as sections have it, or "z=1.5".
Result<CutPlane> trimming_plane(const std::string& typed) {
  const std::size_t equals = typed.find('=');
  if (equals == std::string::npos) return plane_of(typed, "--plane");
  const auto axis = axis_number(typed.substr(0, equals));
  const auto offset = typed_number(typed.substr(equals + 1));
  if (!axis || !offset || !std::isfinite(*offset)) {
    return fail(bad_option("'" + typed + "' is no plane", "--plane",
                           "give z=1.5, or NX,NY,NZ,D: all points with NX x + NY y + NZ z = D"));
  }
  return CutPlane{{*axis == 0 ? 1.0 : 0.0, *axis == 1 ? 1.0 : 0.0, *axis == 2 ? 1.0 : 0.0},
                  *offset};
}

Result<void> set_kind(const SurfaceValues& raw, TrimKind& kind) {
  if (raw.planes.empty() == !raw.contour) {
    return fail(bad_option("a trim needs planes or a contour, and not both", "",
                           "give --plane z=1.5 or --contour FILE"));
  }
  for (const std::string& typed : raw.planes) {
    const auto plane = trimming_plane(typed);
    OBVID_TRY(plane);
    kind.planes.push_back(*plane);
  }
  const std::string keep = raw.keep.value_or("");
  const char* sides =
      raw.contour ? "give --keep inside or --keep outside" : "give --keep above or --keep below";
  if (keep != (raw.contour ? "inside" : "above") && keep != (raw.contour ? "outside" : "below")) {
    return fail(
        bad_option(keep.empty() ? "a trim keeps one side" : "'" + keep + "' is no side of it",
                   "--keep", sides));
  }
  kind.keep_positive = keep == "inside" || keep == "above";
  if (raw.contour) {
    if (raw.contour->empty()) return fail(bad_option("no file is named", "--contour", ""));
    kind.contour = SurfaceInput(*raw.contour);
  }
  if (!raw.along) return {};
  if (!raw.contour) {
    return fail(
        bad_option("planes are not projected", "--along", "leave it out, or give --contour FILE"));
  }
  const auto along = axis_number(*raw.along);
  if (!along)
    return fail(bad_option("'" + *raw.along + "' is no axis", "--along", "give x, y or z"));
  kind.along = *along;
  return {};
}

/// "a,b" as two names.
Result<std::array<std::string, 2>> two_of(const std::string& typed, const char* option,
                                          const char* hint) {
  const std::size_t comma = typed.find(',');
  if (comma != std::string::npos && typed.find(',', comma + 1) == std::string::npos && comma > 0 &&
      comma + 1 < typed.size()) {
    return std::array{typed.substr(0, comma), typed.substr(comma + 1)};
  }
  return fail(
      bad_option(typed.empty() ? "two are needed" : "'" + typed + "' are not two", option, hint));
}

Result<void> set_kind(const SurfaceValues& raw, FilletKind& kind) {
  const auto faces = two_of(raw.faces, "--faces",
                            "give both names with a comma between them, or their numbers: 1,2");
  OBVID_TRY(faces);
  kind.faces = *faces;
  if (!raw.radius) {
    return fail(bad_option("a blend needs its radius", "--radius", "give a number"));
  }
  OBVID_TRY(positive(raw.radius, "--radius"));
  OBVID_TRY(positive(raw.radius_end, "--radius-end"));
  kind.radius = *raw.radius;
  kind.radius_end = raw.radius_end;
  kind.whole = raw.whole;
  if (raw.sides == "auto") return {};
  const auto sides = two_of(raw.sides, "--sides", "give auto, or front,back and so on");
  OBVID_TRY(sides);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto side = value_named<BallSide>(
        {{"auto", BallSide::kAutomatic}, {"front", BallSide::kFront}, {"back", BallSide::kBack}},
        (*sides)[i], "--sides");
    OBVID_TRY(side);
    kind.sides[i] = *side;
  }
  return {};
}

/// "A:u0" as the side of a face.
Result<FaceBorder> border_named(const std::string& typed, const char* option) {
  const std::map<std::string, PatchSide> sides = {
      {"u0", kUStart}, {"u1", kUEnd}, {"v0", kVStart}, {"v1", kVEnd}};
  const std::size_t colon = typed.rfind(':');
  const auto side = colon == std::string::npos ? sides.end() : sides.find(typed.substr(colon + 1));
  if (side == sides.end() || colon == 0) {
    return fail(bad_option(typed.empty() ? "a border is needed" : "'" + typed + "' is no border",
                           option,
                           "give FACE:SIDE, the side u0, u1, v0 or v1: where u or v begins "
                           "or ends"));
  }
  return FaceBorder{typed.substr(0, colon), side->second};
}

Result<void> set_kind(const SurfaceValues& raw, MatchKind& kind) {
  const auto border = border_named(raw.border, "--border");
  OBVID_TRY(border);
  const auto to = border_named(raw.to, "--to");
  OBVID_TRY(to);
  const auto order = value_named<int>({{"G0", 0}, {"G1", 1}, {"G2", 2}}, raw.join, "--join");
  OBVID_TRY(order);
  kind = {*border, *to, *order, raw.within};
  return positive(raw.within, "--within");
}

template <class Value>
Result<void> pick(const std::map<std::string, Value>& values, const std::string& typed,
                  const char* option, Value& into) {
  return value_named(values, typed, option).map([&](Value value) { into = value; });
}

}  // namespace

std::vector<std::string> surface_kind_names() {
  std::vector<std::string> names;
  for (const auto& [name, kind] : surface_kinds()) names.push_back(name);
  return names;
}

Result<SurfaceKind> surface_kind_named(const std::string& name) {
  const auto at = surface_kinds().find(name);
  if (at != surface_kinds().end()) return at->second;
  return error(ErrorCode::kUsage, "unknown kind of surface '" + name + "'")
      .hint(did_you_mean(name, surface_kind_names(), "available are skin, ruled, ..."));
}

Result<void> set_surface(const SurfaceValues& typed, SurfaceJob& job) {
  job.tolerance = typed.tolerance;
  return std::visit([&](auto& kind) { return set_kind(typed, kind); }, job.kind)
      .and_then([&] { return positive(typed.tolerance, "--tolerance"); })
      .and_then([&] { return positive(typed.spacing, "--spacing"); });
}

Result<SurfaceView> view_named(const std::string& name) {
  if (const auto view = surface_view_named(name)) return *view;
  return fail(bad_option("unknown view '" + name + "'", "--view",
                         "available are iso, front, top, side, back, bottom"));
}

Result<void> set_surface_formats(const SurfaceFormatValues& typed, SurfaceExportOptions& formats) {
  formats.chord_tolerance = typed.chord_tolerance;
  if (typed.mesh_angle_deg) formats.angle = *typed.mesh_angle_deg * kOneDegree;
  OBVID_TRY(positive(typed.chord_tolerance, "--chord-tolerance"));
  OBVID_TRY(positive(typed.mesh_angle_deg, "--mesh-angle"));
  const auto step = value_named<CadFormat>(
      {{"ap214", CadFormat::kStepAp214}, {"ap242", CadFormat::kStepAp242}}, typed.step, "--step");
  OBVID_TRY(step);
  formats.step = *step;
  const auto colouring = colouring_named(typed.colour);
  if (!colouring) {
    return fail(bad_option("unknown colouring '" + typed.colour + "'", "--colour",
                           "available are shaded, isolines, gaussian, mean, k1, k2, zebra, "
                           "isophotes, reflection, deviation"));
  }
  formats.colouring = *colouring;
  formats.longitudinals = typed.view == "longitudinals";
  if (formats.longitudinals) return {};
  const auto view = view_named(typed.view);
  if (!view) {
    Error error = view.error();
    error.hint += ", longitudinals";
    return fail(std::move(error));
  }
  formats.view = *view;
  return {};
}

Result<void> set_toolpath(const ToolpathValues& typed, ToolpathJob& job) {
  ToolpathOptions& plan = job.plan;
  return pick<CutterKind>({{"ball", CutterKind::kBall},
                           {"flat", CutterKind::kFlat},
                           {"bull", CutterKind::kBullNose}},
                          typed.cutter, "--cutter", plan.cutter.kind)
      .and_then([&] {
        return pick<ToolpathStrategy>({{"zigzag", ToolpathStrategy::kZigzag},
                                       {"isoparametric", ToolpathStrategy::kIsoparametric},
                                       {"scallop", ToolpathStrategy::kConstantScallop},
                                       {"z-level", ToolpathStrategy::kZLevel},
                                       {"rough", ToolpathStrategy::kRough}},
                                      typed.strategy, "--strategy", plan.strategy);
      })
      .and_then([&] {
        const auto& all = exchange::kGcodeControllers;
        return pick<GcodeController>({all.begin(), all.end()}, typed.controller, "--controller",
                                     plan.gcode.controller);
      })
      .and_then([&] {
        return pick<bool>({{"arcs", true}, {"lines", false}}, typed.motion, "--motion",
                          plan.gcode.arcs);
      })
      .and_then([&]() -> Result<void> {
        if (!typed.entry) return {};
        plan.entry = ToolpathEntry::kRamp;
        return pick<ToolpathEntry>(
            {{"ramp", ToolpathEntry::kRamp}, {"helix", ToolpathEntry::kHelix}}, *typed.entry,
            "--entry", *plan.entry);
      })
      .and_then([&] {
        constexpr std::array kAll = {UpAxis::kX,      UpAxis::kY,      UpAxis::kZ,
                                     UpAxis::kMinusX, UpAxis::kMinusY, UpAxis::kMinusZ};
        std::map<std::string, UpAxis> names;
        for (const UpAxis up : kAll) names.emplace(to_string(up), up);
        return pick<UpAxis>(names, typed.up, "--up", job.up);
      })
      .and_then([&] { return set_stock(typed.stock, plan); });
}

Result<void> set_surface_check(const SurfaceCheckValues& typed, SurfaceCheckJob& job) {
  constexpr long kLeast = 3, kMost = 2000;
  if (typed.samples) {
    if (*typed.samples < kLeast || *typed.samples > kMost) {
      return fail(bad_option("the number of samples must lie in 3 to 2000", "--samples", ""));
    }
    job.check.samples = static_cast<std::size_t>(*typed.samples);
  }
  if (typed.against) {
    if (typed.against->empty()) return fail(bad_option("no file is named", "--against", ""));
    job.against = SurfaceInput(*typed.against);
  }
  job.check.meeting = typed.meeting;
  return positive(typed.meeting, "--meeting");
}

}  // namespace obvid
