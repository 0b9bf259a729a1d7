// SPDX-License-Identifier: Apache-2.0
#include "job_options.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

namespace obvid::batch {
namespace {

using Json = nlohmann::json;

/// Shapes of values that are neither a number nor a text.
bool is_at_points(const TypedOption& option) {
  const std::string_view name = option.name;
  return name.ends_with("-at") ? name != "corner-at" : option.of_points;
}
bool is_list(std::string_view name) { return name == "corner-at" || name == "insert"; }

/// A number where all of the text is one, else the text.
Json value_of(const std::string& text) {
  char* end = nullptr;
  const long long whole = std::strtoll(text.c_str(), &end, 10);
  if (!text.empty() && *end == '\0') return whole;
  const double number = std::strtod(text.c_str(), &end);
  if (!text.empty() && *end == '\0' && std::isfinite(number)) return number;
  return text;
}

Json json_of(const TypedOption& option) {
  if (option.is_flag) return true;
  if (is_at_points(option)) {
    Json out = Json::object();
    for (const std::string& one : option.values) {
      const std::size_t equals = one.find('=');
      out[one.substr(0, equals)] =
          value_of(equals == std::string::npos ? "" : one.substr(equals + 1));
    }
    return out;
  }
  if (is_list(option.name)) {
    Json out = Json::array();
    for (const std::string& one : option.values) out.push_back(value_of(one));
    return out;
  }
  return value_of(option.values.back());
}

void add_all(CLI::App& app, std::vector<TypedOption>& options, const std::string& group) {
  for (TypedOption& option : options) {
    if (option.is_flag) {
      app.add_flag("--" + option.name, option.flag)->group(group);
    } else {
      app.add_option("--" + option.name, option.values)
          ->allow_extra_args(false)
          ->option_text("V")
          ->group(group);
    }
  }
}

}  // namespace

JobOptions known_options(const std::string& job) {
  JobOptions out;
  const std::vector<TypedOption> drawn{{"units"},   {"curve"},           {"chord-tolerance"},
                                       {"drawing"}, {"columns"},         {"skip"},
                                       {"scale"},   {"rotate"},          {"move"},
                                       {"mirror"},  {"unordered", true}, {"drop-outliers", true}};
  if (job == "spline") {
    out.job = {{"curve", true}, {"compare", true}, {"degree"},
               {"smooth"},      {"tolerance"},     {"samples"}};
    return out;
  }
  if (job == "nurbs") {
    out.job = {{"degree"},  {"degree-v"},  {"knots"},
               {"knots-v"}, {"weight-at"}, {.name = "move", .of_points = true},
               {"units"},   {"samples"}};
    return out;
  }
  if (job == "cut") {
    out.job = drawn;
    for (const char* name :
         {"diameter",    "side",         "direction",  "spindle",     "laser",
          "plasma",      "depth",        "pass-depth", "passes",      "ramp",
          "safe-z",      "tabs",         "tab-width",  "tab-height",  "lead-in",
          "start",       "tolerance",    "feed",       "plunge-feed", "rapid-feed",
          "centripetal", "acceleration", "controller", "motion",      "decimals"}) {
      out.job.push_back({name});
    }
    return out;
  }
  if (job == "alignment") {
    out.job = drawn;
    for (const char* name :
         {"noise", "min-length", "min-radius", "station", "lateral-acceleration", "joints",
          "transitions", "profile-noise", "profile-curves", "min-vertical-length"}) {
      out.job.push_back({name});
    }
    out.job.push_back({"closed", true});
  } else {
    out.job = drawn;
    for (const char* name :
         {"carrier",      "continuity",    "prefer",      "tolerance",    "noise",
          "corner-angle", "start-heading", "end-heading", "start-radius", "end-radius",
          "heading-at",   "radius-at",     "kappa-at",    "corner-at",    "construction",
          "fixation",     "insert",        "along",       "align",        "enlarge"}) {
      out.job.push_back({name});
    }
    for (const char* name : {"convex", "primitives", "closed", "open", "no-corners"}) {
      out.job.push_back({name, true});
    }
  }
  for (const char* name : {"output-tolerance",
                           "for",
                           "controller",
                           "motion",
                           "feed",
                           "decimals",
                           "samples",
                           "sample-step",
                           "airfoil",
                           "spacing",
                           "trailing-edge",
                           "trailing-edge-form",
                           "thickness",
                           "camber",
                           "svg",
                           "plot",
                           "curvature-range",
                           "step",
                           "dxf",
                           "face"}) {
    out.files.push_back({name});
  }
  out.files.push_back({"unit-chord", true});
  if (!job.empty()) return out;
  for (const char* more : {"alignment", "cut", "spline", "nurbs"}) {
    for (const TypedOption& one : known_options(more).job) {
      const auto same = [&](const TypedOption& other) { return other.name == one.name; };
      if (std::any_of(out.job.begin(), out.job.end(), same)) continue;
      if (std::any_of(out.files.begin(), out.files.end(), same)) continue;
      out.job.push_back(one);
    }
  }
  return out;
}

std::string typed_job(int argc, char** argv) {
  std::string out;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--job" && i + 1 < argc) out = argv[i + 1];
    if (word.starts_with("--job=")) out = word.substr(std::string_view("--job=").size());
  }
  return out;
}

void add_job_options(CLI::App& app, JobOptions& options) {
  add_all(app, options.job,
          "Options of the job (`obvid fit --help` and the others say what each is)");
  add_all(app, options.files, "Options of the files of --each (`obvid convert --help`)");
}

std::string options_json(const std::vector<TypedOption>& options) {
  Json out = Json::object();
  for (const TypedOption& option : options) {
    if (option.is_flag ? option.flag : !option.values.empty()) out[option.name] = json_of(option);
  }
  return out.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace obvid::batch
