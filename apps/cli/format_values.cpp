// SPDX-License-Identifier: Apache-2.0
#include "format_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "option_values.h"

namespace obvid {
namespace {

Result<void> check_length(const std::optional<double>& value, const char* option) {
  if (!value || (*value > 0.0 && std::isfinite(*value))) return {};
  return fail(bad_option("a positive length is expected", option, "for example 0.01"));
}

}  // namespace

Result<void> set_import(const FormatValues& typed, ImportOptions& options) {
  if (typed.curve && *typed.curve < 1) {
    return fail(
        bad_option("curves are counted from 1", "--curve", "`obvid analyse FILE` lists them"));
  }
  if (auto done = check_length(typed.chord_tolerance, "--chord-tolerance"); !done) return done;
  if (typed.curve) options.curve = static_cast<std::size_t>(*typed.curve - 1);
  options.tolerance = typed.chord_tolerance;
  return {};
}

Result<void> set_formats(const FormatValues& typed, ExportOptions& options) {
  if (auto done = check_length(typed.tolerance, "--output-tolerance"); !done) return done;
  if (auto done = check_length(typed.face_width, "--face"); !done) return done;
  options.tolerance = typed.tolerance;
  options.face_width = typed.face_width.value_or(0.0);
  if (typed.step == "ap242") {
    options.step = CadFormat::kStepAp242;
  } else if (typed.step != "ap214") {
    return fail(bad_option("unknown schema '" + typed.step + "'", "--step", "ap214 or ap242"));
  }
  static constexpr std::array kDxf = {
      std::pair{"exact", DxfProfile::kExact}, std::pair{"arcs", DxfProfile::kArcs},
      std::pair{"cubic", DxfProfile::kCubic}, std::pair{"r12", DxfProfile::kArcsR12}};
  const auto* dxf = std::find_if(kDxf.begin(), kDxf.end(),
                                 [&](const auto& one) { return typed.dxf == one.first; });
  if (dxf == kDxf.end()) {
    return fail(bad_option("unknown kind of DXF '" + typed.dxf + "'", "--dxf",
                           "exact, arcs, cubic or r12"));
  }
  options.dxf = dxf->second;
  return {};
}

}  // namespace obvid
