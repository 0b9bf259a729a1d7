// SPDX-License-Identifier: Apache-2.0
#include "obvid/picture/internal/surface_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "obvid/core/internal/shown_text.h"
#include "page/data.h"
#include "page/parts.h"

namespace obvid {
namespace {

using nlohmann::json;
using picture::plain_text;

constexpr int kMostSliderCells = 60;  // of the sliders
constexpr int kLeastStripes = 2;
/// Sizes beyond these leave the range of single precision, or their squares do.
constexpr double kLeastRadius = 1e-15, kMostRadius = 1e15;
constexpr std::size_t kPaletteStops = 33;

Result<void> check_page_options(const PageOptions& options) {
  const auto within = [](int n, int least) { return n >= least && n <= kMostSliderCells; };
  if (within(options.isolines_u, 1) && within(options.isolines_v, 1) &&
      within(options.zebra_stripes, kLeastStripes)) {
    return {};
  }
  return error(
      ErrorCode::kBadOption,
      fmt::format("isolines and stripes of a page are numbers up to {}", kMostSliderCells));
}

std::string patch_place(const SurfaceModel& model, std::size_t i) {
  return fmt::format("patch {} '{}'", i + 1, shortened(model.patches[i].name));
}

Result<void> check_page_mesh(const Mesh& mesh, const std::string& where) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    const MeshVertex& v = mesh.vertices[i];
    if (!is_finite(v.point) || !std::isfinite(v.u) || !std::isfinite(v.v)) {
      return error(ErrorCode::kNotFinite, "a vertex of the triangles is not finite")
          .where(where)
          .point(i);
    }
  }
  for (const auto& triangle : mesh.triangles) {
    const std::uint32_t last = *std::max_element(triangle.begin(), triangle.end());
    if (last >= mesh.vertices.size()) {
      return error(ErrorCode::kBadCount, "a triangle names a vertex that is not there")
          .where(where)
          .point(last)
          .value(static_cast<double>(last));
    }
  }
  return {};
}

Result<void> check_lines(const std::vector<ScenePolyline>& lines) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!std::all_of(lines[i].points.begin(), lines[i].points.end(),
                     [](Vec3 p) { return is_finite(p); })) {
      return error(ErrorCode::kNotFinite, "a point of a line is not finite")
          .where(fmt::format("line {}", i + 1))
          .point(i);
    }
  }
  return {};
}

Result<std::size_t> count_triangles(const SurfaceModel& model, const std::vector<Mesh>& meshes,
                                    std::size_t most) {
  if (meshes.size() != model.patches.size()) {
    return error(ErrorCode::kBadCount,
                 fmt::format("{} meshes for {} patches", meshes.size(), model.patches.size()))
        .value(static_cast<double>(meshes.size()));
  }
  std::size_t triangles = 0;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    OBVID_TRY(check(model.patches[i].surface));
    OBVID_TRY(check_page_mesh(meshes[i], patch_place(model, i)));
    triangles += meshes[i].triangles.size();
  }
  if (triangles == 0) {
    return error(ErrorCode::kNothingThere, "there are no triangles to show");
  }
  if (triangles > most) {
    return error(ErrorCode::kToleranceNotReached,
                 fmt::format("a page of {} triangles is too much for a browser, {} are allowed",
                             triangles, most))
        .hint("allow a larger chord tolerance or angle")
        .value(static_cast<double>(triangles));
  }
  return triangles;
}

json vector_json(Vec3 v) { return json::array({v.x, v.y, v.z}); }

json palette_json(bool diverging) {
  json stops = json::array();
  for (std::size_t i = 0; i < kPaletteStops; ++i) {
    stops.push_back(
        picture::hex(picture::palette(diverging, static_cast<double>(i) / (kPaletteStops - 1))));
  }
  return stops;
}

json scale_json(const picture::ValueScale& s, const std::string& title, const std::string& unit) {
  return {{"title", title},          {"unit", unit},     {"low", s.low},
          {"high", s.high},          {"least", s.least}, {"most", s.most},
          {"diverging", s.diverging}};
}

json scales_json(const picture::PageData& data, const std::optional<ShownDeviation>& deviation,
                 const std::string& units) {
  json scales;
  if (deviation) {
    scales["deviation"] = scale_json(data.deviation, plain_text(deviation->title), units);
  }
  for (std::size_t q = 0; q < data.scales.size(); ++q) {
    const SurfaceColouring c = picture::kPageQuantities[q];
    const picture::ValueScale& s = data.scales[q];
    scales[std::string(name_of(c))] =
        scale_json(s, std::string(picture::title_of(c)), picture::unit_of(c, units));
  }
  return scales;
}

json raster_json(const std::array<picture::RasterSide, 2>& sides) {
  json out = json::array();
  for (const picture::RasterSide& side : sides) out.push_back({side.spans(), side.cells});
  return out;
}

json patches_json(const SurfaceModel& model, const std::vector<Mesh>& meshes,
                  const picture::PageData& data) {
  json patches = json::array();
  const auto real = picture::real_borders(model);
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const SurfacePatch& patch = model.patches[i];
    const Range u = domain_u(patch.surface), v = domain_v(patch.surface);
    std::string name = plain_text(patch.name);
    if (name.empty()) name = fmt::format("patch {}", i + 1);
    json borders = json::array();
    for (const bool drawn : real[i]) borders.push_back(drawn ? 1 : 0);
    patches.push_back({{"name", std::move(name)},
                       {"borders", std::move(borders)},
                       {"vertices", meshes[i].vertices.size()},
                       {"triangles", meshes[i].triangles.size()},
                       {"raster", raster_json(data.rasters[i])},
                       {"domain", {u.from, u.to, v.from, v.to}}});
  }
  return patches;
}

json lines_json(const std::vector<ScenePolyline>& lines) {
  json out = json::array();
  for (const ScenePolyline& line : lines) {
    out.push_back({{"role", line.role.empty() ? "line" : plain_text(line.role)},
                   {"count", line.points.size()}});
  }
  return out;
}

/// JSON that may stand in a script element: ASCII, no character that could end the element.
std::string script_text(const json& value) {
  const std::string text = value.dump(-1, ' ', true, json::error_handler_t::replace);
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    if (c == '<' || c == '>' || c == '&') {
      out += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    } else {
      out += c;
    }
  }
  return out;
}

std::string header_json(const SurfaceModel& model, const std::vector<Mesh>& meshes,
                        const PageOptions& options, const picture::PageData& data,
                        const std::string& title) {
  const std::string units = plain_text(model.units.text());
  const json header = {
      {"name", title},
      {"units", units},
      {"centre", vector_json(data.centre)},
      {"radius", data.radius},
      {"patches", patches_json(model, meshes, data)},
      {"lines", lines_json(options.lines)},
      {"scales", scales_json(data, options.deviation, units)},
      {"off", options.deviation && options.deviation->of_place ? 1 : 0},
      {"dots", data.dots},
      {"palettes", {{"sequential", palette_json(false)}, {"diverging", palette_json(true)}}},
      {"start",
       {{"mode", name_of(options.colouring)},
        {"view", name_of(options.view)},
        {"orthographic", options.orthographic},
        {"u", options.isolines_u},
        {"v", options.isolines_v},
        {"stripes", options.zebra_stripes}}}};
  return script_text(header);
}

/// 1234567 as 1 234 567, with narrow blanks.
std::string grouped(std::size_t count) {
  std::string text = std::to_string(count);
  constexpr std::size_t kGroup = 3;
  for (std::size_t at = text.size(); at > kGroup;) {
    at -= kGroup;
    text.insert(at, "\u202F");
  }
  return text;
}

std::string facts(const SurfaceModel& model, const std::vector<Mesh>& meshes,
                  const picture::PageData& data, std::size_t triangles) {
  const std::string units = plain_text(model.units.text());
  double deviation = 0.0;
  for (const Mesh& mesh : meshes) deviation = std::max(deviation, mesh.deviation);
  std::string text = picture::size_text(data.size, units);
  if (meshes.size() > 1) text += " · " + grouped(meshes.size()) + " patches";
  text += " · " + grouped(triangles) + (triangles == 1 ? " triangle" : " triangles");
  if (deviation > 0.0) {
    text += ", at most " + picture::readable(deviation, 2) + " " + units + " off where measured";
  }
  return escaped_xml(text);
}

std::string markup(const std::string& title, const std::string& facts) {
  std::string text(picture::surface_page_markup()), out;
  const std::pair<std::string_view, const std::string&> marks[] = {{"@TITLE@", title},
                                                                   {"@FACTS@", facts}};
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t next = std::min(text.find('@', at), text.size());
    out.append(text, at, next - at);
    at = next;
    if (at == text.size()) break;
    const auto* mark = std::find_if(std::begin(marks), std::end(marks), [&](const auto& m) {
      return text.compare(at, m.first.size(), m.first) == 0;
    });
    if (mark == std::end(marks)) {
      out += text[at++];
    } else {
      out += mark->second;
      at += mark->first.size();
    }
  }
  return out;
}

std::string assembled(const std::string& title, const std::string& facts, const std::string& header,
                      const std::string& data) {
  std::string page;
  page.reserve(data.size() + header.size() + (std::size_t{1} << 17U));
  page += "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
  page += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
  // nothing is fetched: the browser refuses whatever would be
  page +=
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
      "'unsafe-inline'; script-src 'unsafe-inline'; img-src data: blob:\">\n";
  page += "<title>" + title + "</title>\n<style>";
  page += picture::surface_page_style();
  page += "</style>\n</head>\n<body>\n" + markup(title, facts);
  page += "<script type=\"application/json\" id=\"model\">" + header + "</script>\n";
  page += "<script type=\"application/octet-stream\" id=\"data\">" + data + "</script>\n<script>";
  page += picture::surface_page_script();
  page += "</script>\n</body>\n</html>\n";
  return page;
}

}  // namespace

Result<std::string> surface_page(const SurfaceModel& model, const std::vector<Mesh>& meshes,
                                 const PageOptions& options, const RunContext& run) {
  OBVID_TRY(check_page_options(options));
  OBVID_TRY(check_lines(options.lines));
  OBVID_TRY(picture::check_deviation(options.colouring, options.deviation));
  const auto triangles = count_triangles(model, meshes, options.most_triangles);
  OBVID_TRY(triangles);
  auto made = picture::page_data(model, meshes, options.lines, options.deviation, run);
  OBVID_TRY(made);
  picture::PageData& data = *made;
  for (std::size_t q = 0; options.extremes && q < data.scales.size(); ++q) {
    const Range& told = options.extremes->of(picture::kPageQuantities[q]);
    data.scales[q].least = told.from;
    data.scales[q].most = told.to;
  }
  if (!(data.radius >= kLeastRadius && data.radius <= kMostRadius)) {
    return error(ErrorCode::kSizeOutOfRange, "the size of the surface cannot be shown in a browser")
        .hint("change the unit")
        .value(data.radius);
  }
  std::string title = plain_text(options.title.empty() ? model.name : options.title);
  if (title.empty()) title = "surface";
  return assembled(escaped_xml(title), facts(model, meshes, data, *triangles),
                   header_json(model, meshes, options, data, title), picture::base64(data.bytes));
}

}  // namespace obvid
