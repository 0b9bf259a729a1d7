// SPDX-License-Identifier: Apache-2.0
#include "files/file_units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <variant>

#include "obvid/core/internal/figures.h"
#include "obvid/exchange/internal/cad_curve.h"
#include "obvid/exchange/internal/dxf/write.h"
#include "obvid/exchange/internal/gcode/dialect.h"
#include "obvid/exchange/internal/road/landxml.h"
#include "obvid/pipeline/internal/format_table.h"

namespace obvid::pipeline_detail {
namespace {

constexpr double kKernelPrecision = 1e-7;  // mm: CAD kernels take points that are nearer for one

Error assumed(const Units& units, std::string_view kind) {
  return error(ErrorCode::kBadOption,
               fmt::format("{} have true lengths, and nothing says what a unit is", kind))
      .where("--units")
      .hint(fmt::format("say it with --units m, or another of {}", known_units()))
      .value(metres_in(units.name).value_or(0.0));
}

/// The unit of the numbers in a file, where it is not always the one that we have.
std::string unit_in_file(const Units& units, FileFormat format) {
  switch (format) {
    case FileFormat::kStep:
    case FileFormat::kIges:
      return std::string(cad_unit(units.name));
    case FileFormat::kDxf:
      return dxf_unit(units);
    case FileFormat::kGcode:
      return exchange::machine_unit(units);
    case FileFormat::kLandXml:
      return std::string(landxml_unit(units.name));
    case FileFormat::kOpenDrive:
    case FileFormat::kMacro:
    case FileFormat::kGlb:
      return "m";
    default:
      return units.name;
  }
}

}  // namespace

Result<UnitNotes> unit_notes(const Units& units, FileFormat format) {
  const FormatRow& row = *std::find_if(kFormats.begin(), kFormats.end(),
                                       [&](const FormatRow& one) { return one.format == format; });
  const UnitRule rule = row.rule;
  const std::string_view kind = row.files;
  const std::string written = unit_in_file(units, format);
  UnitNotes notes;
  if (rule == UnitRule::kNone) return notes;
  if (rule == UnitRule::kLost) {
    const Units usual;  // what is assumed where nothing is said
    if (units.known() && units.name != usual.name) {
      notes.remarks.push_back(
          fmt::format("{} have no unit, and are taken for {}: the numbers are in {}", kind,
                      usual.name, units.name));
    }
    return notes;
  }
  if (rule == UnitRule::kStated) {
    if (written.empty()) notes.remarks.push_back(fmt::format("no unit is stated in {}", kind));
    return notes;
  }
  OBVID_TRY(unit_ratio(units, "m", kind));
  if (!units.known() && rule == UnitRule::kRoad) return fail(assumed(units, kind));
  if (!units.known()) {
    notes.warnings.push_back(
        fmt::format("nothing says what a unit is: {} assumed, as {} need one; --units says it",
                    units.name, kind));
  }
  if (written != units.name) {
    notes.remarks.push_back(
        fmt::format("lengths were converted from {} to {}", units.name, written));
  }
  return notes;
}

std::optional<std::string> below_kernels(const std::vector<Piece>& pieces, const Units& units,
                                         bool plain) {
  const double scale = plain ? 1.0 : unit_ratio(units.name, "mm").value_or(1.0);
  const auto length = [](const Piece& piece) {
    const auto* arc = std::get_if<ArcPiece>(&piece);
    return arc != nullptr ? arc->length : norm(end_point(piece) - start_point(piece));
  };
  const auto count = std::count_if(pieces.begin(), pieces.end(), [&](const Piece& piece) {
    return scale * length(piece) < kKernelPrecision;
  });
  if (count == 0) return std::nullopt;
  return fmt::format("{} shorter than {:g} {}: CAD kernels may leave {} out",
                     counted(static_cast<std::size_t>(count), "piece", "pieces"), kKernelPrecision,
                     plain ? "units" : "mm", count == 1 ? "it" : "them");
}

Result<void> kernel_holds(double size, const Units& units, bool plain, std::string_view instead) {
  // a thousand times their precision is the least that keeps its shape, and doubles of 1e8 the
  // largest with steps below it
  constexpr double kLeast = 1e3 * kKernelPrecision, kMost = 1e8;
  const double held = plain ? size : size * unit_ratio(units.name, "mm").value_or(1.0);
  if (held >= kLeast && held <= kMost) return {};
  return error(ErrorCode::kSizeOutOfRange,
               fmt::format("{:.3g} {} across: CAD kernels hold {:g} to {:g}", held,
                           plain ? "units" : "mm", kLeast, kMost))
      .hint(fmt::format("choose another unit, or {}", instead))
      .value(held);
}

}  // namespace obvid::pipeline_detail
