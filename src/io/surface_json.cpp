// SPDX-License-Identifier: Apache-2.0
#include "obvid/io/surface_json.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "contour_json_values.h"
#include "obvid/core/internal/format_into.h"

namespace obvid {
namespace {

constexpr const char* kFormat = "obvid-surface";
constexpr int kVersion = 1;
constexpr int kVersionOfTrims = 2;  ///< who does not know trims must not take whole patches

void write_number(std::string& out, double value) {
  // "-0" would be read as the integer 0
  if (value == 0.0 && std::signbit(value)) {
    format_into(out, "-0.0");
  } else {
    format_into(out, "{}", value);
  }
}

void write_list(std::string& out, const std::vector<double>& values) {
  const char* comma = "[";
  for (const double value : values) {
    format_into(out, "{}", comma);
    write_number(out, value);
    comma = ", ";
  }
  format_into(out, "]");
}

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

void write_trims(std::string& out, const std::vector<TrimLoop>& trims) {
  format_into(out, ",\n   \"trims\": [");
  for (std::size_t l = 0; l < trims.size(); ++l) {
    format_into(out, "{}", l == 0 ? "\n    [" : ",\n    [");
    for (std::size_t c = 0; c < trims[l].curves.size(); ++c) {
      const NurbsCurve& curve = trims[l].curves[c];
      format_into(out, "{}{{\"degree\": {}, \"knots\": ", c == 0 ? "" : ",\n     ", curve.degree);
      write_list(out, curve.knots);
      format_into(out, ", \"points\": [");
      for (std::size_t i = 0; i < curve.points.size(); ++i) {
        format_into(out, "{}", i == 0 ? "" : ", ");
        write_list(out, {curve.points[i].x, curve.points[i].y});
      }
      format_into(out, "]");
      if (!curve.weights.empty()) {
        format_into(out, ", \"weights\": ");
        write_list(out, curve.weights);
      }
      format_into(out, "}}");
    }
    format_into(out, "]");
  }
  format_into(out, "]");
}

void write_patch(std::string& out, const SurfacePatch& patch) {
  const NurbsSurface& s = patch.surface;
  format_into(out, "  {{\"name\": {}, \"degree_u\": {}, \"degree_v\": {},\n", quoted(patch.name),
              s.degree_u, s.degree_v);
  format_into(out, "   \"knots_u\": ");
  write_list(out, s.knots_u);
  format_into(out, ",\n   \"knots_v\": ");
  write_list(out, s.knots_v);
  format_into(out, ",\n   \"points\": [");
  for (std::size_t i = 0; i < s.points.size(); ++i) {
    // a row along u on each line
    format_into(out, "{}", i == 0 ? "\n    " : i % s.count_u() == 0 ? ",\n    " : ", ");
    write_list(out, {s.points[i].x, s.points[i].y, s.points[i].z});
  }
  format_into(out, "]");
  if (!s.weights.empty()) {
    format_into(out, ",\n   \"weights\": ");
    write_list(out, s.weights);
  }
  if (!patch.trims.empty()) write_trims(out, patch.trims);
  if (!patch.trims.empty() && patch.trims_within > 0.0) {
    format_into(out, ",\n   \"trims_within\": {}", patch.trims_within);
  }
  format_into(out, "}}");
}

class SurfaceReader : private JsonValues {
 public:
  using JsonValues::JsonValues;

  Result<SurfaceModel> read(const nlohmann::json& document) {
    const Node root{&document, nullptr, {}, 0};
    const Node format = field(root, "format");
    if (!failed() && word(format) != kFormat) refuse(format, "this is no surface file");
    const Node version = field(root, "version");
    if (!failed()) has_trims_ = integer(version, 1, kMaxInteger) == kVersionOfTrims;
    if (!failed() && integer(version, 1, kMaxInteger) > kVersionOfTrims) {
      refuse(version, "this version of the format is not known");
    }
    if (const auto name = optional_field(root, "name")) model_.name = word(*name);
    if (const auto units = optional_field(root, "units")) model_.units = word(*units);
    if (const auto source = optional_field(root, "units_source")) units_source(*source);
    if (!failed()) {
      each(field(root, "patches"),
           [&](const Node& node) { model_.patches.push_back(patch(node)); });
      if (!failed() && model_.patches.empty()) refuse(root, "the surface has no patches");
    }
    if (error_) return fail(*error_);
    return std::move(model_);
  }

 private:
  std::vector<double> numbers(const Node& node) {
    std::vector<double> values;
    each(node, [&](const Node& one) { values.push_back(number(one)); });
    return values;
  }

  Vec3 point_of(const Node& node) {
    const std::vector<double> values = numbers(node);
    if (failed()) return {};
    if (values.size() != 3) {
      refuse(node, "a point has three coordinates");
      return {};
    }
    return {values[0], values[1], values[2]};
  }

  NurbsCurve trim_curve(const Node& node) {
    NurbsCurve out;
    out.degree = static_cast<int>(integer(field(node, "degree"), 1, kMaxNurbsDegree));
    if (!failed()) out.knots = numbers(field(node, "knots"));
    if (failed()) return out;
    each(field(node, "points"), [&](const Node& one) {
      const std::vector<double> values = numbers(one);
      if (failed()) return;
      if (values.size() != 2) return refuse(one, "a place of a trim has two parameters");
      out.points.push_back({values[0], values[1]});
    });
    if (failed()) return out;
    if (const auto weights = optional_field(node, "weights")) out.weights = numbers(*weights);
    return out;
  }

  TrimLoop trim_loop(const Node& node) {
    TrimLoop out;
    each(node, [&](const Node& one) { out.curves.push_back(trim_curve(one)); });
    return out;
  }

  SurfacePatch patch(const Node& node) {
    SurfacePatch out;
    NurbsSurface& s = out.surface;
    if (const auto name = optional_field(node, "name")) out.name = word(*name);
    s.degree_u = static_cast<int>(integer(field(node, "degree_u"), 1, kMaxNurbsDegree));
    if (!failed())
      s.degree_v = static_cast<int>(integer(field(node, "degree_v"), 1, kMaxNurbsDegree));
    if (!failed()) s.knots_u = numbers(field(node, "knots_u"));
    if (!failed()) s.knots_v = numbers(field(node, "knots_v"));
    if (!failed())
      each(field(node, "points"), [&](const Node& one) { s.points.push_back(point_of(one)); });
    if (!failed()) {
      if (const auto weights = optional_field(node, "weights")) s.weights = numbers(*weights);
    }
    if (failed()) return out;
    if (const auto trims = optional_field(node, "trims")) {
      if (!has_trims_) refuse(*trims, "version 1 of the format has no trims");
      each(*trims, [&](const Node& one) { out.trims.push_back(trim_loop(one)); });
      if (const auto within = optional_field(node, "trims_within")) {
        out.trims_within = number(*within);
        if (!failed() && !(out.trims_within >= 0.0)) refuse(*within, "a distance is not negative");
      }
    }
    if (failed()) return out;
    if (auto good = check(out); !good) refuse(node, good.error().what);
    return out;
  }

  void units_source(const Node& node) {
    const auto source = unit_source_of(word(node));
    if (!source) return refuse(node, "a unit is from the file, given or assumed");
    model_.units.source = *source;
  }

  SurfaceModel model_;
  bool has_trims_ = false;
};

}  // namespace

std::string surface_json(const SurfaceModel& model) {
  std::string out;
  format_into(out,
              "{{\"format\": \"{}\", \"version\": {},\n \"name\": {}, \"units\": {}, "
              "\"units_source\": \"{}\",\n \"patches\": [",
              kFormat, is_trimmed(model) ? kVersionOfTrims : kVersion, quoted(model.name),
              quoted(model.units.name), to_string(model.units.source));
  for (std::size_t i = 0; i < model.patches.size(); ++i) {
    format_into(out, "{}", i == 0 ? "\n" : ",\n");
    write_patch(out, model.patches[i]);
  }
  format_into(out, "]}}\n");
  return out;
}

Result<SurfaceModel> surface_from_json(std::string_view text, std::string_view name, Watch* watch) {
  const auto document = parse_json(text, name, watch);
  OBVID_TRY(document);
  return SurfaceReader(name, watch).read(*document);
}

}  // namespace obvid
