// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "obvid/core/internal/format_into.h"
#include "obvid/core/internal/questions.h"
#include "obvid/io/internal/json_list.h"
#include "obvid/pipeline/surface_cut_job.h"

namespace obvid {
namespace {

/// "x_m", or "x" where the unit is merely assumed.
std::string column_in_units(const char* name, const Units& units) {
  return units.known() ? fmt::format("{}_{}", name, units.name) : std::string(name);
}

JsonText& add_point(JsonText& json, Vec3 p) {
  return json.begin_array().value(p.x).value(p.y).value(p.z).end_array();
}

void add_branch(JsonText& json, const MadeSection& section, std::size_t number, bool points) {
  const SectionBranch& branch = section.section.branches[number];
  json.begin_object().pair("closed", branch.closed).pair("count", branch.points.size());
  json.pair("gap", branch.gap).pair("deviation", branch.deviation);
  if (number < section.fair.size()) {
    const FairBranch& fair = section.fair[number];
    json.key("fair").begin_object().pair("proved", fair.proved);
    if (fair.error) {
      json.pair("error", to_line(*fair.error));
    } else {
      json.pair("pieces", fair.stored.contour.pieces.size());
    }
    json.end_object();
  }
  if (points) {
    json.key("points").begin_array();
    for (const SectionPoint& p : branch.points) add_point(json, p.point);
    json.end_array().key("in_plane").begin_array();
    for (const SectionPoint& p : branch.points) {
      const Vec2 q = section.frame.in_plane(p.point);
      json.begin_array().value(q.x).value(q.y).end_array();
    }
    json.end_array().key("parameters").begin_array();
    for (const SectionPoint& p : branch.points) {
      json.begin_array().value(p.patch).value(p.u).value(p.v).end_array();
    }
    json.end_array();
  }
  json.end_object();
}

void add_plane_section(JsonText& json, const MadeSection& section, bool points) {
  json.begin_object().pair("name", section.name).pair("id", section.id);
  json.pair("kind", to_string(section.kind));
  add_point(json.key("normal"), section.plane.normal);
  json.pair("offset", section.plane.offset);
  json.pair("residual", section.section.residual).pair("undecided", section.section.undecided);
  json.pair("touching_lines", section.section.touching_lines);
  json.key("touching").begin_array();
  for (const Vec3 p : section.section.touching) add_point(json, p);
  json.end_array().key("patches_in_plane").begin_array();
  for (const std::size_t i : section.section.in_plane) json.value(i);
  json.end_array().key("branches").begin_array();
  for (std::size_t i = 0; i < section.section.branches.size(); ++i) {
    add_branch(json, section, i, points);
  }
  json.end_array().end_object();
}

void add_displaced(JsonText& json, const MadeSurfaceCut& made) {
  if (!made.displaced) return;
  const Displaced& d = *made.displaced;
  json.key("hydrostatics").begin_object();
  const auto figure = [&](const char* name, const MeasuredFigure& f) {
    json.key(name).begin_object().pair("value", f.value).pair("error", f.error).end_object();
  };
  figure("volume", d.volume);
  figure("wetted_area", d.wetted);
  figure("waterplane_area", d.waterplane);
  figure("centre_x", d.centre_x);
  figure("centre_y", d.centre_y);
  figure("centre_z", d.centre_z);
  figure("waterplane_centre_x", d.plane_x);
  figure("waterplane_centre_y", d.plane_y);
  figure("waterplane_inertia", d.inertia_x);
  json.key("displacement");
  if (made.displacement) {
    json.value(*made.displacement);
  } else {
    json.null();
  }
  json.pair("parts", d.parts).pair("open_volume", d.open_volume);
  json.pair("open_width", d.open_width).end_object();
}

}  // namespace

std::string surface_cut_json(const MadeSurfaceCut& made, const Written& written, bool points,
                             Watch* watch) {
  JsonText json(watch);
  json.begin_object();
  add_units(json, made.units);
  json.pair("size", made.size).pair("tolerance", made.tolerance);
  json.key("sections").begin_array();
  for (const MadeSection& section : made.sections) add_plane_section(json, section, points);
  json.end_array();
  add_displaced(json, made);
  add_list(json, "warnings", made.warnings);
  add_list(json, "written", written.files);
  add_list(json, "remarks", written.remarks).end_object();
  return json.take();
}

std::string sections_csv(const MadeSurfaceCut& made, Watch* watch) {
  Questions questions(watch);
  std::string out = fmt::format("section,branch,{},{},{}\n", column_in_units("x", made.units),
                                column_in_units("y", made.units), column_in_units("z", made.units));
  for (const MadeSection& section : made.sections) {
    for (std::size_t i = 0; i < section.section.branches.size(); ++i) {
      const SectionBranch& branch = section.section.branches[i];
      for (const SectionPoint& p : branch.points) {
        if (questions.end()) return out;
        format_into(out, "{},{},{},{},{}\n", section.name, i + 1, p.point.x, p.point.y, p.point.z);
      }
    }
  }
  return out;
}

std::string branch_csv(const MadeSurfaceCut& made, std::size_t section, std::size_t branch) {
  const MadeSection& from = made.sections[section];
  const SectionBranch& one = from.section.branches[branch];
  std::string out =
      fmt::format("{},{}\n", column_in_units("x", made.units), column_in_units("y", made.units));
  const auto add = [&](const SectionPoint& p) {
    const Vec2 q = from.frame.in_plane(p.point);
    format_into(out, "{},{}\n", q.x, q.y);
  };
  for (const SectionPoint& p : one.points) add(p);
  if (one.closed) add(one.points.front());
  return out;
}

std::vector<BranchPlace> branches_of(const MadeSurfaceCut& made) {
  std::vector<BranchPlace> out;
  for (std::size_t i = 0; i < made.sections.size(); ++i) {
    const MadeSection& section = made.sections[i];
    for (std::size_t k = 0; k < section.section.branches.size(); ++k) {
      out.push_back({i, k, fmt::format("{}-{}", section.id, k + 1)});
    }
  }
  return out;
}

Result<FileFormat> branch_format_of(std::string_view path, bool fair) {
  const auto format = format_of(path);
  if (!fair) {
    if (format == FileFormat::kSamples) return *format;
    return error(ErrorCode::kUnknownFormat, "points of branches are written as .csv")
        .where(std::string(path))
        .hint("--fair EPS makes contours of them, in all formats of contours");
  }
  if (format) return *format;
  return error(ErrorCode::kUnknownFormat, "no format of contours has this file extension")
      .where(std::string(path))
      .hint("possible are " + known_endings());
}

Result<Exported> branch_file(const MadeSurfaceCut& made, const BranchPlace& place,
                             FileFormat format, const RunContext& run) {
  OBVID_TRY(may_go_on(run));
  const MadeSection& section = made.sections[place.section];
  if (section.fair.empty()) {
    return Exported{{{"", branch_csv(made, place.section, place.branch)}}, {}, {}};
  }
  const FairBranch& fair = section.fair[place.branch];
  if (fair.error) return Exported{};
  return export_contour(fair.stored, format, {}, run);
}

Result<std::string> sections_file(FileFormat format, const MadeSurfaceCut& made,
                                  const std::string& title, const RunContext& run) {
  Watch watch(run);
  std::string text;
  if (format == FileFormat::kContour) {
    text = surface_cut_json(made, {}, true, &watch);
  } else if (format == FileFormat::kSamples) {
    text = sections_csv(made, &watch);
  } else if (format == FileFormat::kPicture) {
    text = sketch_svg(lines_drawing(made, title), &watch);
  } else if (format == FileFormat::kDxf) {
    text = sketch_dxf(lines_drawing(made, title), &watch);
  } else {
    return fail(no_such_sections());
  }
  if (watch.cancelled()) return fail(cancelled_error());
  return text;
}

Error no_such_sections() {
  return {ErrorCode::kUnknownFormat, "sections are not written in this format", "",
          "possible are .json and .csv (points), .svg and .dxf (lines drawing), and names with "
          "{id}, a file for each branch"};
}

}  // namespace obvid
