// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "obvid/core/internal/figures.h"
#include "obvid/core/internal/near_name.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/pipeline/internal/job_values.h"
#include "obvid/surface_builders/internal/deviation.h"
#include "obvid/surface_builders/internal/fillet.h"
#include "obvid/surface_cut/internal/trim.h"
#include "surface/surface_kinds.h"

namespace obvid::pipeline_detail {
namespace {

/// So near that CAD systems sew the borders: half of what counts as one border.
constexpr double kBlendTolerance = 5e-8;  // of the size

std::string place_text(Vec3 p) { return fmt::format("at {:.6g} {:.6g} {:.6g}", p.x, p.y, p.z); }

void add_facts(const std::vector<Fillet>& blends, const std::array<std::string, 2>& names,
               MadeSurface& made) {
  const std::string unit = made.model.units.text();
  made.facts.emplace_back(
      "found", fmt::format("{}, of those that cross a cell between 49 x 49 places of either face",
                           counted(blends.size(), "blend", "blends")));
  for (std::size_t k = 0; k < blends.size(); ++k) {
    const Fillet& one = blends[k];
    const std::string which = blends.size() > 1 ? fmt::format(" {}", k + 1) : "";
    made.facts.emplace_back(
        "blend" + which,
        fmt::format("{} x {} control points, spine {} {}, {}", one.surface.count_u(),
                    one.surface.count_v(), significant(one.length, 6), unit,
                    one.closed ? std::string("closed")
                               : fmt::format("from {:.6g} {:.6g} {:.6g} (radius {:g}) to {:.6g} "
                                             "{:.6g} {:.6g} (radius {:g})",
                                             one.from.x, one.from.y, one.from.z, one.radius_from,
                                             one.to.x, one.to.y, one.to.z, one.radius_to)));
    for (std::size_t i = 0; i < 2; ++i) {
      const FilletContact& c = one.contacts[i];
      made.facts.emplace_back(
          fmt::format("on {}", names[i]),
          fmt::format("up to {} {} off it ({}), {} degrees between tangent planes ({}), as "
                      "measured at {} places and beside the worst of them",
                      significant_above(c.distance, 3), unit, place_text(c.distance_at),
                      significant_above(c.angle / kOneDegree, 3), place_text(c.angle_at),
                      c.measured));
    }
  }
}

/// What stays of a face beside the blends.
Result<std::vector<SurfacePatch>> left_of(const SurfacePatch& face,
                                          const std::vector<Fillet>& blends, std::size_t i,
                                          double tolerance, MadeSurface& made,
                                          const RunContext& run) {
  std::vector<LineAlong> lines;
  for (const Fillet& one : blends) {
    LineAlong line;
    line.curve = contact_curve(one, i);
    line.kept = [&one, i](double v) {
      const Vec3 across = evaluate(one.surface, i == 0 ? 0.0 : 1.0, v).du;
      return i == 0 ? -across : across;
    };
    line.places = one.contacts[i].places;
    line.closed = one.closed;
    lines.push_back(std::move(line));
  }
  auto left = trimmed(face, lines, {tolerance, true}, run);
  if (!left) {
    Error error = left.error();
    if (error.code == ErrorCode::kUnsupported) error.hint = "--whole leaves the faces as they are";
    return fail(std::move(error));
  }
  made.deviation = std::max(made.deviation, left->deviation);
  return std::move(left->model.patches);
}

/// Other faces that a blend of two reaches with an end: those keep the corner that it rounds.
std::vector<std::string> faces_at_ends(const SurfaceModel& model,
                                       const std::array<std::size_t, 2>& own,
                                       const std::vector<Fillet>& blends, double tolerance) {
  std::vector<Vec3> corners;
  for (const Fillet& one : blends) {
    if (one.closed) continue;
    for (const double v : {0.0, 1.0}) {
      for (const double u : {0.0, 1.0}) corners.push_back(evaluate(one.surface, u, v).point);
    }
  }
  std::vector<std::string> out;
  for (std::size_t p = 0; p < model.patches.size(); ++p) {
    if (p == own[0] || p == own[1]) continue;
    SurfaceModel alone;
    alone.patches.push_back(model.patches[p]);
    const NearestOnModel face(alone);
    const auto meets = [&](Vec3 corner) { return face.at(corner).distance <= tolerance; };
    if (std::any_of(corners.begin(), corners.end(), meets)) out.push_back(model.patches[p].name);
  }
  return out;
}

/// As `face_named` takes them.
std::string numbers_of(const std::vector<std::size_t>& faces) {
  constexpr std::size_t kMostNumbers = 8;
  std::string out;
  for (std::size_t k = 0; k < std::min(faces.size(), kMostNumbers); ++k) {
    out += fmt::format("{}#{}", k == 0 ? "" : ", ", faces[k] + 1);
  }
  return faces.size() > kMostNumbers ? out + ", ..." : out;
}

}  // namespace

Result<std::size_t> face_named(const SurfaceModel& model, const std::string& name,
                               const char* option) {
  std::vector<std::string> names;
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < model.patches.size(); ++i) {
    names.push_back(model.patches[i].name);
    if (names.back() == name) found.push_back(i);
  }
  if (found.size() == 1) return found.front();
  const bool by_number = !name.empty() && name.front() == '#';  // whatever names there are
  const auto number = typed_number(by_number ? name.substr(1) : name);
  const auto count = static_cast<double>(names.size());
  if (found.empty() && number && *number >= 1.0 && *number <= count &&
      std::floor(*number) == *number) {
    return static_cast<std::size_t>(*number) - 1;
  }
  return error(ErrorCode::kBadOption,
               found.empty() ? fmt::format("there is no face '{}'", name)
                             : fmt::format("{} faces are called '{}'", found.size(), name))
      .where(option)
      .hint(found.empty()
                ? did_you_mean(name, names,
                               fmt::format("give a name, or a number from 1 to {}", names.size()))
                : "give its number: " + numbers_of(found));
}

Result<MadeSurface> made_fillet(const RolledBall& by, const SurfaceJob& job,
                                const RunContext& run) {
  auto read = as_read(job, run);
  OBVID_TRY(read);
  MadeSurface made = std::move(*read);
  std::array<std::size_t, 2> at{};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto face = face_named(made.model, by.faces[i], "--faces");
    OBVID_TRY(face);
    at[i] = *face;
  }
  if (at[0] == at[1]) {
    return error(ErrorCode::kBadOption, "a blend needs two faces").where("--faces");
  }
  const double tolerance = job.tolerance.value_or(kBlendTolerance * size_of(made.model));
  const std::array<const SurfacePatch*, 2> faces{&made.model.patches[at[0]],
                                                 &made.model.patches[at[1]]};
  const std::array<std::string, 2> names{faces[0]->name, faces[1]->name};
  const auto blends = fillets_between(faces, {by.radius, by.radius_end, by.sides, tolerance}, run);
  OBVID_TRY(blends);
  std::vector<SurfacePatch> patches;
  std::size_t trims = 0;
  for (std::size_t p = 0; p < made.model.patches.size(); ++p) {
    if (by.whole || (p != at[0] && p != at[1])) {
      patches.push_back(made.model.patches[p]);
      continue;
    }
    auto left = left_of(made.model.patches[p], *blends, p == at[0] ? 0 : 1, tolerance, made, run);
    OBVID_TRY(left);
    for (SurfacePatch& one : *left) {
      trims += one.trims.size();
      patches.push_back(std::move(one));
    }
  }
  const double trimmed_within = made.deviation;
  for (std::size_t k = 0; k < blends->size(); ++k) {
    const Fillet& one = (*blends)[k];
    made.deviation = std::max(made.deviation, one.deviation);
    const std::string which = blends->size() > 1 ? fmt::format(" {}", k + 1) : "";
    patches.push_back(
        {fmt::format("blend{} of {} and {}", which, names[0], names[1]), one.surface, one.trims});
  }
  const auto beside = faces_at_ends(made.model, at, *blends, tolerance);
  if (!by.whole && !beside.empty()) {
    made.warnings.push_back(fmt::format(
        "the blend ends at {} {}, which {} the corner that it rounds: the body is open there "
        "until {} trimmed, as by hand in CAD",
        beside.size() == 1 ? "face" : "faces", listed(beside),
        beside.size() == 1 ? "keeps" : "keep", beside.size() == 1 ? "it is" : "they are"));
  }
  made.model.patches = std::move(patches);
  made.kind = fmt::format("blend of {} and {} by a ball", names[0], names[1]);
  add_facts(*blends, names, made);
  if (!by.whole) {
    made.facts.emplace_back(
        "trims", fmt::format("{}, within {} {} of the blend's borders, as measured",
                             counted(trims, "loop", "loops"), significant_above(trimmed_within, 3),
                             made.model.units.text()));
  }
  return made;
}

}  // namespace obvid::pipeline_detail
