// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "obvid/core/near_name.h"
#include "obvid/pipeline/construction_values.h"
#include "obvid/pipeline/format_values.h"
#include "obvid/pipeline/job_values.h"
#include "obvid/pipeline/space_values.h"
#include "obvid/pipeline/surface_values.h"

namespace obvid::capi {
namespace {

using Json = nlohmann::json;
using Setter = std::function<bool(const Json&)>;  // false: another type of value is meant

Setter flag(bool& to) {
  return [&to](const Json& value) {
    if (value.is_boolean()) to = value.get<bool>();
    return value.is_boolean();
  };
}

template <class To>
Setter number(To& to) {
  return [&to](const Json& value) {
    if (value.is_number()) to = value.get<double>();
    return value.is_number();
  };
}

Setter count(std::optional<long>& to) {
  return [&to](const Json& value) {
    if (value.is_number_integer()) to = static_cast<long>(value.get<std::int64_t>());
    return value.is_number_integer();
  };
}

/// A text, or a number in its place; dumped numbers read back to the same double.
std::string typed(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

bool is_typed(const Json& value) { return value.is_string() || value.is_number(); }

template <class To>
Setter text(To& to) {
  return [&to](const Json& value) {
    if (is_typed(value)) to = typed(value);
    return is_typed(value);
  };
}

/// {"5": 90}: a value for each of some points.
Setter at_points(std::vector<std::string>& to) {
  return [&to](const Json& value) {
    if (!value.is_object()) return false;
    for (const auto& [point, one] : value.items()) {
      if (!is_typed(one)) return false;
      to.push_back(point + "=" + typed(one));
    }
    return true;
  };
}

/// [3, 7]
Setter points(std::vector<std::string>& to) {
  return [&to](const Json& value) {
    if (!value.is_array()) return false;
    for (const Json& one : value) {
      if (!is_typed(one)) return false;
      to.push_back(typed(one));
    }
    return true;
  };
}

/// [9, 9]
Setter counts(std::vector<long>& to) {
  return [&to](const Json& value) {
    if (!value.is_array()) return false;
    for (const Json& one : value) {
      if (!one.is_number_integer()) return false;
      to.push_back(static_cast<long>(one.get<std::int64_t>()));
    }
    return true;
  };
}

/// Values as they stand, before they are checked.
struct Written {
  TypedValues typed;
  TypedConstruction construction;
  FormatValues formats;
  std::string carrier = "spiral";
  std::string along;
  std::optional<double> tolerance;
  std::optional<std::string> units;
  SurfaceValues surface;
  SurfaceFormatValues surface_formats;
  ToolpathValues toolpath;
  std::optional<long> samples, row;
};

void add_surface_setters(Written& w, Request& out, const Known& known,
                         std::map<std::string, Setter>& all) {
  SurfaceValues& s = w.surface;
  if (known.contours) {
    TypedValues& t = w.typed;
    all.insert({{"noise", text(t.noise)},
                {"closed", flag(t.closed)},
                {"open", flag(t.open)},
                {"corner-angle", number(t.corner_angle_deg)},
                {"no-corners", flag(t.no_corners)},
                {"continuity", text(t.continuity)}});
  }
  if (known.surface) {
    all.insert({{"tolerance", number(s.tolerance)},
                {"spacing", number(s.spacing)},
                {"match", text(s.matching)},
                {"straight", flag(out.surface.straight_across)},
                {"plain", flag(out.surface.plain_when_refused)},
                {"direction", text(s.direction)},
                {"apex", text(s.apex)},
                {"axis", text(s.axis)},
                {"axis-point", text(s.axis_point)},
                {"angle", number(s.angle_deg)},
                {"near", flag(s.near)},
                {"control", flag(s.control)},
                {"spread", text(s.spread)},
                {"smooth", flag(out.surface.smooth)},
                {"distance", number(s.distance)},
                {"row", count(w.row)}});
  }
  if (known.surface_formats) {
    SurfaceFormatValues& f = w.surface_formats;
    all.insert({{"chord-tolerance", number(f.chord_tolerance)},
                {"mesh-angle", number(f.mesh_angle_deg)},
                {"colour", text(f.colour)},
                {"view", text(f.view)},
                {"step", text(f.step)}});
  }
  if (known.check) all.insert({{"samples", count(w.samples)}});
  if (known.toolpath) {
    ToolpathJob& job = out.toolpath;
    all.insert({{"cutter", text(w.toolpath.cutter)},
                {"diameter", number(job.diameter)},
                {"corner-radius", number(job.corner_radius)},
                {"strategy", text(w.toolpath.strategy)},
                {"scallop", number(job.plan.scallop)},
                {"step-over", number(job.plan.step_over)},
                {"angle", number(job.plan.angle_deg)},
                {"along-v", flag(job.plan.along_v)},
                {"one-way", flag(job.plan.one_way)},
                {"tolerance", number(job.tolerance)},
                {"safe-z", number(job.plan.safe_z)},
                {"feed", number(job.plan.feed)},
                {"plunge-feed", number(job.plan.plunge_feed)},
                {"controller", text(w.toolpath.controller)},
                {"motion", text(w.toolpath.motion)}});
  }
}

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
    all.insert({{"curve", count(f.curve)},
                {"chord-tolerance", number(f.chord_tolerance)},
                {"drawing", text(f.drawing)}});
  }
  if (known.formats) {
    all.insert({{"output-tolerance", number(f.tolerance)},
                {"for", text(f.profile)},
                {"controller", text(f.controller)},
                {"motion", text(f.motion)},
                {"feed", number(f.feed)},
                {"samples", count(f.samples)},
                {"sample-step", number(f.sample_step)},
                {"svg", text(f.svg)},
                {"plot", text(f.plot)},
                {"step", text(f.step)},
                {"dxf", text(f.dxf)},
                {"face", number(f.face_width)}});
  }
  add_surface_setters(w, out, known, all);
  return all;
}

Result<void> take(const Json& object, const std::map<std::string, Setter>& known) {
  for (const auto& [name, value] : object.items()) {
    const auto at = known.find(name);
    if (at == known.end()) {
      std::vector<std::string> names;
      std::string all;
      for (const auto& [one, setter] : known) {
        names.push_back(one);
        all += (all.empty() ? "available are " : ", ") + one;
      }
      return fail({ErrorCode::kUsage, "unknown option '" + name + "'", "options",
                   did_you_mean(name, names, all)});
    }
    if (!at->second(value)) {
      return fail(bad_option("another type of value is expected", name, "docs/c.md has the types"));
    }
  }
  return {};
}

/// A construction takes the place of the carrier, and `prefer` then has the worksheet's names.
Result<void> take_construction(Written& w, const Known& known, Request& out) {
  TypedConstruction& typed = w.construction;
  const bool asked = !typed.name.empty() || typed.fixation;
  if (!known.worksheet && !asked) return {};
  typed.prefer = std::exchange(w.typed.prefer, "fair");
  auto made = construction_values(typed);
  if (!made) return fail(made.error());
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
      .and_then([&]() -> Result<void> {
        out.worksheet = with_job(out.worksheet, out.job);
        if (has_both_headings(out.job)) out.import.two_points = TwoPoints::kDo;
        const auto along = direction_named(w.along);
        if (!along) return fail(along.error());
        out.along = *along;
        if (!w.units) return {};
        return given_units(*w.units, "units").map([&](Units given) { out.units = given; });
      });
}

Result<void> check_surface(Written& w, const Known& known, Request& out) {
  if (known.surface) {
    out.surface.kind = *known.surface;
    out.surface.units = out.units;
    if (w.row) {
      if (*w.row < 1) return fail(bad_option("rows have points", "row", "give 2 or more"));
      out.surface.row = static_cast<std::size_t>(*w.row);
    }
    if (auto done = set_surface(w.surface, out.surface); !done) return done;
    if (auto done = set_values(w.typed, out.surface.sections); !done) return done;
  }
  if (auto done = set_surface_formats(w.surface_formats, out.surface_formats); !done) return done;
  if (w.samples) {
    const auto samples = checked_samples(*w.samples);
    if (!samples) return fail(samples.error());
    out.samples = *samples;
  }
  return set_toolpath(w.toolpath, out.toolpath);
}

}  // namespace

Result<Request> request_of(const char* options, const Known& known) {
  Request out;
  const bool none = options == nullptr || *options == '\0';
  const Json object = none ? Json::object() : Json::parse(options, nullptr, false);
  if (!object.is_object()) {
    return fail({ErrorCode::kBadJson, "the options are no JSON object", "options",
                 "write {\"noise\": 0.01}"});
  }
  Written written;
  if (auto done = take(object, setters(written, out, known)); !done) return fail(done.error());
  if (none && !known.surface) return out;
  const bool of_surfaces = known.surface || known.surface_formats || known.toolpath || known.check;
  if (of_surfaces) {
    if (written.units) {
      auto given = given_units(*written.units, "units");
      if (!given) return fail(given.error());
      out.units = std::move(*given);
    }
    if (auto done = check_surface(written, known, out); !done) return fail(done.error());
    return out;
  }
  if (auto done = check(written, known, out); !done) return fail(done.error());
  return out;
}

}  // namespace obvid::capi
