// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <map>
#include <utility>
#include <vector>

#include "obvid/pipeline/internal/alignment_values.h"
#include "obvid/pipeline/internal/construction_values.h"
#include "obvid/pipeline/internal/format_values.h"
#include "obvid/pipeline/internal/job_values.h"
#include "obvid/pipeline/internal/space_values.h"
#include "setters.h"

namespace obvid::capi {
namespace {

/// Values as they stand, before they are checked.
struct Written {
  TypedValues typed;
  TypedConstruction construction;
  FormatValues formats;
  std::string carrier = "spiral";
  std::string along;
  std::optional<double> tolerance;
  CutValues cut;
  AlignmentValues alignment;
  std::string align;
  std::optional<std::string> units;
};

std::map<std::string, Setter> setters(Written& w, Request& out, const Known& known) {
  std::map<std::string, Setter> all{{"units", text(w.units)}};
  TypedValues& t = w.typed;
  FormatValues& f = w.formats;
  if (known.fit) {
    all.insert({{"carrier", text(w.carrier)},
                {"tolerance", number(w.tolerance)},
                {"convex", flag(out.job.convex)},
                {"noise", text(t.noise)},
                {"primitives", flag(out.job.primitives)},
                {"closed", flag(t.closed)},
                {"open", flag(t.open)},
                {"corner-angle", number(t.corner_angle_deg)},
                {"no-corners", flag(t.no_corners)},
                {"start-heading", text(t.start_heading)},
                {"end-heading", text(t.end_heading)},
                {"start-radius", text(t.start_radius)},
                {"end-radius", text(t.end_radius)},
                {"heading-at", at_points(t.heading_at)},
                {"radius-at", at_points(t.radius_at)},
                {"kappa-at", at_points(t.kappa_at)},
                {"corner-at", points(t.corner_at)},
                {"continuity", text(t.continuity)},
                {"prefer", text(t.prefer)}});
  }
  if (known.construction) {
    all.insert({{"construction", text(w.construction.name)},
                {"fixation", count(w.construction.fixation)}});
  }
  if (known.space) all.insert({{"along", text(w.along)}});
  if (known.worksheet) all.insert({{"insert", counts(w.construction.insert)}});
  if (known.import) {
    all.insert({{"curve", text(f.curve)},
                {"chord-tolerance", number(f.chord_tolerance)},
                {"drawing", text(f.drawing)},
                {"cut", points(f.cut)},
                {"unordered", flag(f.unordered)},
                {"drop-outliers", flag(f.drop_outliers)}});
  }
  if (known.import || known.points) {
    all.insert({{"columns", text(f.columns)},
                {"skip", count(f.skip)},
                {"scale", number(f.scale)},
                {"rotate", number(f.rotate_deg)},
                {"move", text(f.move)},
                {"mirror", text(f.mirror)}});
  }
  if (known.curves) {
    all.insert({{"align", text(w.align)}, {"enlarge", number(out.enlarge)}});
  }
  if (known.cut) {
    CutOptions& plan = out.cut.plan;
    all.insert({{"diameter", number(plan.diameter)},
                {"side", text(w.cut.side)},
                {"direction", text(w.cut.direction)},
                {"spindle", number(plan.spindle)},
                {"laser", number(w.cut.laser)},
                {"plasma", number(w.cut.plasma)},
                {"depth", number(plan.depth)},
                {"pass-depth", number(plan.pass_depth)},
                {"passes", count(w.cut.passes)},
                {"ramp", number(plan.ramp_deg)},
                {"safe-z", number(plan.safe_z)},
                {"tabs", count(w.cut.tabs)},
                {"tab-width", number(plan.tabs.width)},
                {"tab-height", number(plan.tabs.height)},
                {"lead-in", number(plan.lead_in)},
                {"start", text(w.cut.start)},
                {"tolerance", number(out.cut.tolerance)},
                {"feed", number(plan.feed)},
                {"plunge-feed", number(plan.plunge_feed)},
                {"rapid-feed", number(plan.rapid_feed)},
                {"centripetal", number(plan.centripetal)},
                {"acceleration", number(plan.acceleration)},
                {"controller", text(w.cut.controller)},
                {"motion", text(w.cut.motion)},
                {"decimals", count(w.cut.decimals)}});
  }
  if (known.alignment) {
    AlignmentJob& job = out.alignment;
    all.insert({{"noise", text(w.alignment.noise)},
                {"closed", flag(w.alignment.closed)},
                {"open", flag(w.alignment.open)},
                {"min-length", number(job.least_length)},
                {"min-radius", number(job.least_radius)},
                {"station", number(job.first_station)},
                {"lateral-acceleration", number(job.acceleration)},
                {"joints", text(w.alignment.joints)},
                {"transitions", text(w.alignment.transitions)},
                {"profile-noise", text(w.alignment.profile_noise)},
                {"profile-curves", text(w.alignment.profile_curves)},
                {"min-vertical-length", number(job.profile.least_length)}});
  }
  if (known.formats) {
    all.insert({{"output-tolerance", number(f.tolerance)},
                {"for", text(f.profile)},
                {"controller", text(f.controller)},
                {"motion", text(f.motion)},
                {"feed", number(f.feed)},
                {"decimals", count(f.decimals)},
                {"samples", count(f.samples)},
                {"sample-step", number(f.sample_step)},
                {"airfoil", text(f.airfoil)},
                {"spacing", text(f.spacing)},
                {"trailing-edge", number(f.trailing_edge)},
                {"trailing-edge-form", text(f.trailing_form)},
                {"unit-chord", flag(f.unit_chord)},
                {"thickness", text(f.thickness)},
                {"camber", text(f.camber)},
                {"svg", text(f.svg)},
                {"step", text(f.step)},
                {"dxf", text(f.dxf)},
                {"face", number(f.face_width)}});
  }
  const bool plots = known.formats || known.plots;
  if (plots) all.insert({"plot", text(f.plot)});
  if (plots || known.shown) all.insert({"curvature-range", text(f.curvature_range)});
  return all;
}

/// A construction takes the place of the carrier, and `prefer` then has the worksheet's names.
Result<void> take_construction(Written& w, const Known& known, Request& out) {
  TypedConstruction& typed = w.construction;
  const bool asked = !typed.name.empty() || typed.fixation;
  if (!known.worksheet && !asked) return {};
  typed.prefer = std::exchange(w.typed.prefer, "fair");
  auto made = construction_values(typed);
  OBVID_TRY(made);
  if (asked && w.carrier != "spiral") {
    return fail(bad_option("a construction is its own carrier", "--carrier",
                           "leave --carrier out, or --construction"));
  }
  out.worksheet = std::move(*made);
  return {};
}

Result<void> check(Written& w, const Known& known, Request& out) {
  return take_construction(w, known, out)
      .and_then([&] { return set_tolerance(w.tolerance, out.job); })
      .and_then([&] { return set_values(w.typed, out.job); })
      .and_then(
          [&] { return carrier_named(w.carrier).map([&](Carrier one) { out.job.carrier = one; }); })
      .and_then([&] { return set_formats(w.formats, out.formats, out.profile); })
      .and_then([&] { return set_import(w.formats, out.import); })
      .and_then([&] { return set_cut(w.cut, out.cut); })
      .and_then([&] { return set_alignment(w.alignment, out.alignment); })
      .and_then([&]() -> Result<void> {
        out.worksheet = with_job(out.worksheet, out.job);
        if (has_both_headings(out.job)) out.import.list.two = TwoPoints::kDo;
        const auto along = direction_named(w.along);
        OBVID_TRY(along);
        out.along = *along;
        const auto curves = curves_job(w.align);
        OBVID_TRY(curves);
        out.curves = *curves;
        OBVID_TRY(check_enlarge(out.enlarge));
        if (!w.units) return {};
        return given_units(*w.units, "units").map([&](Units given) { out.units = given; });
      });
}

}  // namespace

Result<Request> request_of(const char* options, const Known& known) {
  Request out;
  const auto object = options_in(options);
  OBVID_TRY(object);
  if (object->empty()) return out;
  Written written;
  OBVID_TRY(take(*object, setters(written, out, known)));
  OBVID_TRY(check(written, known, out));
  return out;
}

Result<FileFormat> format_of_ending(const char* ending) {
  const std::string name = ending == nullptr ? "" : ending;
  const auto format = format_of("file." + name);
  if (format) return *format;
  return error(ErrorCode::kUnknownFormat, "no format is known for the file extension ." + name)
      .hint("contours have " + known_endings() + "; other jobs some of them");
}

}  // namespace obvid::capi
