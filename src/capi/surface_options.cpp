// SPDX-License-Identifier: Apache-2.0
#include "surface_options.h"

#include <map>
#include <utility>

#include "obvid/pipeline/internal/job_values.h"
#include "obvid/pipeline/internal/surface_values.h"
#include "setters.h"

namespace obvid::capi {
namespace {

/// Values as they stand, before they are checked.
struct SurfaceWritten {
  TypedValues typed;
  SurfaceValues surface;
  SurfaceFormatValues formats;
  ToolpathValues toolpath;
  SurfaceCutValues cut;
  SurfaceCheckValues check;
  std::optional<std::string> units;
};

std::map<std::string, Setter> setters_of(SurfaceWritten& w, SurfaceRequest& out,
                                         const SurfaceKnown& known) {
  std::map<std::string, Setter> all;
  SurfaceValues& s = w.surface;
  if (known.kind) {
    TypedValues& t = w.typed;
    all.insert({{"units", text(w.units)}});
    all.insert({{"noise", text(t.noise)},
                {"closed", flag(t.closed)},
                {"open", flag(t.open)},
                {"corner-angle", number(t.corner_angle_deg)},
                {"no-corners", flag(t.no_corners)},
                {"continuity", text(t.continuity)}});
  }
  if (known.kind) {
    all.insert({{"tolerance", number(s.tolerance)},
                {"spacing", number(s.spacing)},
                {"light", number(s.light)},
                {"fair-across", number(s.fair_across)},
                {"match", text(s.matching)},
                {"straight", flag(s.straight)},
                {"plain", flag(out.make.curves.plain_when_refused)},
                {"direction", text(s.direction)},
                {"apex", text(s.apex)},
                {"axis", text(s.axis)},
                {"axis-point", text(s.axis_point)},
                {"angle", number(s.angle_deg)},
                {"near", flag(s.near)},
                {"control", flag(s.control)},
                {"spread", text(s.spread)},
                {"smooth", flag(s.smooth)},
                {"distance", number(s.distance)},
                {"row", count(s.row)},
                {"up", text(s.up)},
                {"steepest", number(s.steepest_deg)},
                {"drop-outliers", flag(s.drop_outliers)},
                {"plane", texts(s.planes)},
                {"keep", text(s.keep)},
                {"contour", text(s.contour)},
                {"along", text(s.along)},
                {"faces", text(s.faces)},
                {"radius", number(s.radius)},
                {"radius-end", number(s.radius_end)},
                {"sides", text(s.sides)},
                {"whole", flag(s.whole)},
                {"border", text(s.border)},
                {"to", text(s.to)},
                {"join", text(s.join)},
                {"within", number(s.within)}});
  }
  if (known.formats) {
    SurfaceFormatValues& f = w.formats;
    all.insert({{"chord-tolerance", number(f.chord_tolerance)},
                {"mesh-angle", number(f.mesh_angle_deg)},
                {"colour", text(f.colour)},
                {"view", text(f.view)},
                {"step", text(f.step)}});
  }
  if (known.toolpath) all.insert({{"view", text(w.formats.view)}});
  if (known.check || known.formats) {
    all.insert({{"against", text(w.check.against)}, {"samples", count(w.check.samples)}});
  }
  if (known.check) all.insert({{"meeting", number(w.check.meeting)}});
  if (known.cut) {
    SurfaceCutValues& c = w.cut;
    all.insert({{"plane", texts(c.planes)},
                {"stations", text(c.stations)},
                {"waterlines", text(c.waterlines)},
                {"buttocks", text(c.buttocks)},
                {"tolerance", number(c.tolerance)},
                {"fair", number(c.fair)},
                {"draught", number(c.draught)},
                {"half", flag(c.half)},
                {"density", number(c.density)}});
  }
  if (known.toolpath) {
    ToolpathJob& job = out.toolpath;
    all.insert({{"cutter", text(w.toolpath.cutter)},
                {"diameter", number(job.diameter)},
                {"corner-radius", number(job.corner_radius)},
                {"rest-of", number(job.rest_of)},
                {"rest-corner", number(job.rest_corner)},
                {"strategy", text(w.toolpath.strategy)},
                {"scallop", number(job.plan.scallop)},
                {"step-over", number(job.plan.step_over)},
                {"angle", number(job.plan.angle_deg)},
                {"along-v", flag(job.plan.along_v)},
                {"one-way", flag(job.plan.one_way)},
                {"tolerance", number(job.tolerance)},
                {"safe-z", number(job.plan.safe_z)},
                {"allowance", number(job.plan.allowance)},
                {"step-down", number(job.plan.step_down)},
                {"steep-angle", number(job.plan.steep_deg)},
                {"up", text(w.toolpath.up)},
                {"stock", text(w.toolpath.stock)},
                {"entry", text(w.toolpath.entry)},
                {"ramp", number(job.plan.ramp_deg)},
                {"ramp-height", number(job.plan.ramp_height)},
                {"spindle", number(job.plan.spindle)},
                {"rapid-feed", number(job.plan.rapid_feed)},
                {"acceleration", number(job.plan.acceleration)},
                {"feed", number(job.plan.feed)},
                {"plunge-feed", number(job.plan.plunge_feed)},
                {"controller", text(w.toolpath.controller)},
                {"motion", text(w.toolpath.motion)}});
  }
  return all;
}

Result<void> check_written(SurfaceWritten& w, const SurfaceKnown& known, SurfaceRequest& out) {
  if (known.kind) {
    out.make.kind = *known.kind;
    if (w.units) {
      auto given = given_units(*w.units, "units");
      OBVID_TRY(given);
      out.make.units = std::move(*given);
    }
    OBVID_TRY(set_surface(w.surface, out.make));
    OBVID_TRY(set_values(w.typed, out.make.curves.sections));
  }
  if (known.toolpath) OBVID_TRY(view_named(w.formats.view));  // a view of the paths
  OBVID_TRY(set_surface_formats(w.formats, out.formats));
  OBVID_TRY(set_surface_check(w.check, out.check));
  if (known.cut) OBVID_TRY(set_surface_cut(w.cut, out.cut));
  return set_toolpath(w.toolpath, out.toolpath);
}

}  // namespace

Result<SurfaceRequest> surface_request_of(const char* options, const SurfaceKnown& known) {
  SurfaceRequest out;
  const auto object = options_in(options);
  OBVID_TRY(object);
  SurfaceWritten written;
  OBVID_TRY(take(*object, setters_of(written, out, known)));
  OBVID_TRY(check_written(written, known, out));
  return out;
}

}  // namespace obvid::capi
