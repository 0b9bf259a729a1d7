// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/surface_cut_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "obvid/core/internal/figures.h"
#include "obvid/core/internal/parallel.h"
#include "obvid/geom/internal/box.h"
#include "obvid/pipeline/fit.h"

namespace obvid {
namespace {

constexpr double kDefaultChords = 1e-5;  ///< of the size
constexpr std::size_t kMostPlanes = 10'000;

/// What sets apart stations, waterlines and buttocks.
struct Family {
  SectionKind kind;
  const PlacesAcross& places;
  Vec3 normal, x, y;  ///< axes in the plane
  double low = 0.0, high = 0.0;
};

/// Places as they are printed: six digits, of those that were given as many as they have, and more
/// where other places would be called the same.
std::vector<std::string> labels_of(const std::vector<double>& places, std::size_t given) {
  constexpr int kDigits = 6, kAllDigits = std::numeric_limits<double>::max_digits10;
  std::vector<std::string> out;
  for (std::size_t i = 0; i < places.size(); ++i) {
    int digits = kDigits;
    const auto tells_all = [&] { return std::stod(significant(places[i], digits)) == places[i]; };
    while (i < given && digits < kAllDigits && !tells_all()) ++digits;
    out.push_back(significant(places[i], digits));
  }
  std::map<std::string, double> called;
  bool clear = true;
  for (std::size_t i = 0; i < places.size() && clear; ++i) {
    clear = called.emplace(out[i], places[i]).first->second == places[i];
  }
  if (clear) return out;
  for (std::size_t i = 0; i < places.size(); ++i) out[i] = significant(places[i], kAllDigits);
  return out;
}

Result<std::vector<double>> places_across(const Family& family) {
  std::vector<double> out = family.places.at;
  const double low = family.low, high = family.high;
  const double rounding =
      4.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(low), std::abs(high));
  if (const auto step = family.places.every) {
    if (!(*step > 0.0)) {
      return error(ErrorCode::kBadOption, "the distance of sections has to be greater than 0");
    }
    const double first = std::floor(low / *step) + 1.0, last = std::ceil(high / *step) - 1.0;
    if (last - first >= static_cast<double>(kMostPlanes)) {
      return error(ErrorCode::kBadOption,
                   fmt::format("that would be more than {} sections", kMostPlanes))
          .hint("give a greater distance")
          .value(last - first + 1.0);
    }
    for (double k = first; k <= last; ++k) out.push_back(k * *step);
  }
  if (const auto count = family.places.count) {
    for (std::size_t k = 1; k <= *count; ++k) {
      const double at =
          low + (high - low) * static_cast<double>(k) / static_cast<double>(*count + 1);
      out.push_back(std::abs(at) <= rounding ? 0.0 : at);
    }
  }
  return out;
}

/// The axes of any plane: the first one horizontal.
Frame frame_of(const CutPlane& plane) {
  const Vec3 up{0.0, 0.0, 1.0};
  const Vec3 across = cross(up, plane.normal);
  Frame frame;
  frame.origin = plane.offset * plane.normal;
  frame.x = norm(across) > 0.0 ? unit(across) : Vec3{1.0, 0.0, 0.0};
  frame.y = cross(plane.normal, frame.x);
  return frame;
}

Result<std::vector<MadeSection>> asked_sections(const SurfaceCutJob& job, const Box3& box) {
  std::vector<MadeSection> out;
  for (const CutPlane& plane : job.planes) {
    MadeSection one;
    one.plane = plane;
    one.frame = frame_of(plane);
    one.id = fmt::format("plane-{}", out.size() + 1);
    one.name = fmt::format("plane {}", out.size() + 1);
    out.push_back(std::move(one));
  }
  const Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const std::array<Family, 3> families = {
      Family{SectionKind::kStation, job.stations, x, y, z, box.low.x, box.high.x},
      Family{SectionKind::kWaterline, job.waterlines, z, x, y, box.low.z, box.high.z},
      Family{SectionKind::kButtock, job.buttocks, y, x, z, box.low.y, box.high.y}};
  for (const Family& family : families) {
    const auto places = places_across(family);
    OBVID_TRY(places);
    const std::vector<std::string> labels = labels_of(*places, family.places.at.size());
    std::size_t number = 0;
    for (const double at : *places) {
      MadeSection one;
      one.kind = family.kind;
      one.at = at;
      one.plane = {family.normal, at};
      one.frame = {at * family.normal, family.x, family.y};
      one.name = fmt::format("{} {}", to_string(family.kind), labels[number]);
      one.id = fmt::format("{}-{}", to_string(family.kind), ++number);
      out.push_back(std::move(one));
    }
  }
  if (out.size() > kMostPlanes) {
    return error(ErrorCode::kBadOption, fmt::format("these are more than {} sections", kMostPlanes))
        .value(static_cast<double>(out.size()));
  }
  if (out.empty() && !job.draught) {
    return error(ErrorCode::kUsage, "nothing says where to cut")
        .hint("give --plane, --stations, --waterlines, --buttocks or --draught");
  }
  return out;
}

FairBranch fair_branch(const MadeSection& section, const SectionBranch& branch, double noise,
                       const Units& units, const RunContext& run) {
  PointSeries series;
  series.name = section.name;
  series.units = units;
  for (const SectionPoint& p : branch.points) {
    series.points.push_back(section.frame.in_plane(p.point));
  }
  FitJob job;
  job.noise = noise;
  job.closing = branch.closed ? Closing::kClosed : Closing::kOpen;
  FairBranch out;
  auto made = fit(series, job, run);
  if (!made) {
    out.error = made.error();
    return out;
  }
  out.proved = made->certificate.proved;
  out.stored = {std::move(made->contour), made->report, made->certificate};
  return out;
}

void add_warnings(MadeSurfaceCut& made) {
  for (const MadeSection& section : made.sections) {
    const PlaneSection& s = section.section;
    const auto say = [&](std::string text) {
      made.warnings.push_back(section.name + ": " + std::move(text));
    };
    if (!s.touching.empty()) {
      const Vec3 p = s.touching.front();
      say(fmt::format("the surface touches the plane or nearly does at {}{}, the first at {} {} {}",
                      s.touching.size() < 16 ? "" : "at least ",
                      counted(s.touching.size(), "place", "places"), significant(p.x, 6),
                      significant(p.y, 6), significant(p.z, 6)));
    }
    if (s.touching_lines > 0) {
      say(fmt::format("the surface touches the plane along {}, which are no branches",
                      counted(s.touching_lines, "line", "lines")));
    }
    if (s.undecided > 0) {
      say(fmt::format(
          "{} left undecided where the surface touches the plane along a line; what lies "
          "there is left out",
          counted(s.undecided, "cell was", "cells were")));
    }
    if (!s.in_plane.empty()) {
      say(fmt::format("{} in the plane; only borders of that are there",
                      counted(s.in_plane.size(), "patch lies", "patches lie")));
    }
  }
}

/// units: how far a model reaches on that side of y = 0 where it reaches less far, at places of a
/// raster in each span; 0 where its control points show that it is no more than `enough`.
double lesser_reach_across(const SurfaceModel& model, double enough) {
  constexpr std::size_t kPlaces = 8;  // a span
  const auto less = [](const Box3& box) { return std::max(0.0, std::min(-box.low.y, box.high.y)); };
  const auto raster = [](const std::vector<double>& knots, Range all) {
    std::vector<double> out{all.from};
    for (std::size_t i = 1; i < knots.size(); ++i) {
      if (!(knots[i] > knots[i - 1]) || knots[i - 1] < all.from || knots[i] > all.to) continue;
      for (std::size_t k = 1; k <= kPlaces; ++k) {
        out.push_back(Range{knots[i - 1], knots[i]}.at(static_cast<double>(k) / kPlaces));
      }
    }
    return out;
  };
  Box3 hull, there;
  for (const NurbsSurface* surface : surfaces_of(model)) hull.add_all(surface->points);
  if (less(hull) <= enough) return 0.0;
  for (const NurbsSurface* surface : surfaces_of(model)) {
    for (const SurfacePoint& p :
         evaluate_raster(*surface, raster(surface->knots_u, domain_u(*surface)),
                         raster(surface->knots_v, domain_v(*surface)))) {
      there.add(p.point);
    }
  }
  return less(there);
}

Result<void> measure(const SurfaceModel& model, const SurfaceCutJob& job, const RunContext& run,
                     MadeSurfaceCut& made) {
  if (job.half) {
    const double reach = lesser_reach_across(model, made.tolerance);
    if (reach > made.tolerance) {
      made.warnings.push_back(
          fmt::format("the half reaches {} {} beyond y = 0 on either side, as measured; the two "
                      "halves overlap there, and what they have in common counts twice (a whole "
                      "body is measured without --half)",
                      significant_above(reach, 3), made.units.text()));
    }
  }
  auto found = displaced(model, {*job.draught, job.half}, run);
  OBVID_TRY(found);
  if (!(found->volume.value > 0.0)) {
    made.warnings.push_back("nothing of the surface encloses water below the draught");
  }
  if (found->open_width > made.tolerance) {
    const std::string unit = made.units.text();
    const Vec3 at = found->open_at;
    made.warnings.push_back(fmt::format(
        "the surface is open below the draught, {} {} wide at {}, {}, {} {}: upright walls from "
        "its borders to the draught close it in these figures; closed level, to {}, the volume "
        "would be another by some {} {}^3",
        significant(found->open_width, 3), unit, significant(at.x), significant(at.y),
        significant(at.z), unit, job.half ? "y = 0" : "other borders or one plane",
        significant(found->open_volume, 3), unit));
  }
  if (found->parts > 1) {
    made.warnings.push_back(
        fmt::format("the surfaces are {} parts that do not meet at their borders; each counts as "
                    "positive, and gaps between them are not noticed",
                    found->parts));
  }
  if (found->twisted > 0) {
    made.warnings.push_back(fmt::format(
        "at {} the patches cannot be turned to one side: volume and centres mean nothing",
        counted(found->twisted, "border", "borders")));
  }
  if (found->undecided > 0) {
    made.warnings.push_back(
        "the surface touches the waterplane along a line; the areas are those "
        "without what lies within a thousandth of a span of it");
  }
  if (job.density) made.displacement = *job.density * found->volume.value;
  made.displaced = *found;
  return {};
}

}  // namespace

const char* to_string(SectionKind kind) {
  constexpr std::array kNames = {"plane", "station", "waterline", "buttock"};
  return kNames[static_cast<std::size_t>(kind)];
}

Result<MadeSurfaceCut> cut_surface(const SurfaceModel& model, const SurfaceCutJob& job,
                                   const RunContext& run) {
  MadeSurfaceCut made;
  made.units = model.units;
  made.size = size_of(model);
  made.tolerance = job.tolerance.value_or(kDefaultChords * made.size);
  Box3 box;
  for (const NurbsSurface* surface : surfaces_of(model)) box.add_all(surface->points);
  auto sections = asked_sections(job, box);
  OBVID_TRY(sections);
  made.sections = std::move(*sections);
  OBVID_TRY(tell(run, "cutting", 0.0));
  const ModelCutter cutter(model);
  // sections in parts: between these the caller's thread tells how far the work is
  constexpr std::size_t kAtOnce = 16;
  for (std::size_t from = 0; from < made.sections.size(); from += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, made.sections.size() - from);
    OBVID_TRY(tell(run, "cutting",
                   static_cast<double>(from) / static_cast<double>(made.sections.size())));
    std::vector<std::optional<Error>> failed(count);
    const auto work = [&](std::size_t i, const RunContext& asked) {
      MadeSection& one = made.sections[from + i];
      auto found = cutter.section(one.plane, {made.tolerance}, asked);
      if (!found) {
        failed[i] = found.error();
        return;
      }
      one.section = std::move(*found);
      if (!job.fair) return;
      for (const SectionBranch& branch : one.section.branches) {
        one.fair.push_back(fair_branch(one, branch, *job.fair, made.units, asked));
      }
    };
    OBVID_TRY(in_parallel(count, run, work));
    for (const auto& one : failed) {
      if (one) return fail(*one);
    }
    OBVID_TRY(may_go_on(run));
  }
  add_warnings(made);
  if (job.draught) OBVID_TRY(measure(model, job, run, made));
  return made;
}

std::optional<Error> not_proved(const MadeSurfaceCut& made) {
  std::size_t all = 0, formed = 0, proved = 0;
  std::optional<Error> refused;
  for (const MadeSection& section : made.sections) {
    for (const FairBranch& branch : section.fair) {
      ++all;
      if (branch.error) {
        if (!refused) {
          refused = branch.error;
          refused->where = section.name + (refused->where.empty() ? "" : ", " + refused->where);
        }
        continue;
      }
      ++formed;
      if (branch.proved) ++proved;
    }
  }
  if (refused) return refused;
  if (proved == formed) return std::nullopt;
  return error(ErrorCode::kNotProved,
               fmt::format("{} of {} branches were formed but not proved", formed - proved, all));
}

}  // namespace obvid
