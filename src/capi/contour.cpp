// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "door.h"
#include "handles.h"
#include "obvid/core/version.h"
#include "obvid/exchange/internal/points/samples.h"
#include "options.h"

namespace obvid::capi {
namespace {

constexpr Known kFiles{.formats = true};

Result<std::unique_ptr<obvid_files>> files_of(const obvid_contour& contour, const char* ending,
                                              const char* options, const obvid_run* run) {
  Result<Request> request = request_of(options, kFiles);
  OBVID_TRY(request);
  const auto format = format_of_ending(ending);
  OBVID_TRY(format);
  ExportOptions& formats = request->formats;
  set_titles(contour, request->profile, formats);
  const StoredContour* stored = &contour.stored;
  StoredContour other;
  if (request->units) {
    other = contour.stored;
    (void)take_units(other.contour.units, *request->units);
    stored = &other;
  }
  Result<Exported> made = export_contour(*stored, *format, formats, context_of(run));
  OBVID_TRY(made);
  auto out = std::make_unique<obvid_files>();
  out->files = std::move(made->files);
  if (!request->profile.empty()) out->remarks.push_back(request->profile);
  for (auto* more : {&made->remarks, &made->warnings}) {
    for (std::string& one : *more) out->remarks.push_back(std::move(one));
  }
  return out;
}

}  // namespace
}  // namespace obvid::capi

using namespace obvid;
using namespace obvid::capi;

extern "C" {

int obvid_abi(void) { return OBVID_ABI; }

const char* obvid_version(void) { return kVersion; }

size_t obvid_contour_pieces(const obvid_contour* contour) {
  return contour->stored.contour.pieces.size();
}

int obvid_contour_closed(const obvid_contour* contour) {
  return contour->stored.contour.closed ? 1 : 0;
}

double obvid_contour_length(const obvid_contour* contour) {
  const auto& pieces = contour->stored.contour.pieces;
  const auto end = static_cast<double>(pieces.size());
  double length = 0.0;
  (void)guarded(nullptr, [&]() -> Result<void> {
    const auto last = sample_at_parameters(pieces, {&end, 1});
    if (last) length = last->front().s;
    return {};
  });
  return length;
}

const char* obvid_contour_warning(const obvid_contour* contour, size_t warning) {
  return warning < contour->warnings.size() ? contour->warnings[warning].c_str() : nullptr;
}

void obvid_contour_free(obvid_contour* contour) { delete contour; }

int obvid_evaluate(const obvid_contour* contour, obvid_place by, const double* at, size_t n,
                   double* xy, double* heading, double* curvature, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const auto& pieces = contour->stored.contour.pieces;
    const std::span<const double> places(at, n);
    const auto found = by == OBVID_BY_PARAMETER ? sample_at_parameters(pieces, places)
                                                : sample_at_lengths(pieces, places);
    OBVID_TRY(found);
    for (std::size_t i = 0; i < n; ++i) {
      const CurveSample& one = (*found)[i];
      if (xy != nullptr) {
        xy[2 * i] = one.point.x;
        xy[2 * i + 1] = one.point.y;
      }
      if (heading != nullptr) heading[i] = one.theta;
      if (curvature != nullptr) curvature[i] = one.kappa;
    }
    return {};
  });
}

int obvid_derivatives(const obvid_contour* contour, const double* at, size_t n, int order,
                      double* xy, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    const auto& pieces = contour->stored.contour.pieces;
    if (order < 1 || order > 3) {
      return obvid::error(ErrorCode::kBadOption, "derivatives are of order 1, 2 or 3")
          .where("order")
          .value(static_cast<double>(order));
    }
    const auto last = static_cast<double>(pieces.size());
    for (std::size_t i = 0; i < n; ++i) {
      if (!(at[i] >= 0.0 && at[i] <= last)) {
        return obvid::error(ErrorCode::kBadOption, "a place is beyond the contour")
            .where("place " + std::to_string(i + 1))
            .value(at[i]);
      }
      const std::size_t piece = std::min(static_cast<std::size_t>(at[i]), pieces.size() - 1);
      const Jet jet = evaluate(pieces[piece], at[i] - static_cast<double>(piece));
      const Vec2 d = order == 1 ? jet.d1 : order == 2 ? jet.d2 : jet.d3;
      xy[2 * i] = d.x;
      xy[2 * i + 1] = d.y;
    }
    return {};
  });
}

int obvid_export(const obvid_contour* contour, const char* ending, const char* options,
                 const obvid_run* run, obvid_files** files, obvid_error** error) {
  return guarded(error, [&]() -> Result<void> {
    auto out = files_of(*contour, ending, options, run);
    OBVID_TRY(out);
    *files = out->release();
    return {};
  });
}

size_t obvid_files_count(const obvid_files* files) { return files->files.size(); }

const char* obvid_files_suffix(const obvid_files* files, size_t file) {
  return file < files->files.size() ? files->files[file].suffix.c_str() : nullptr;
}

const char* obvid_files_data(const obvid_files* files, size_t file, size_t* size) {
  if (file >= files->files.size()) return nullptr;
  if (size != nullptr) *size = files->files[file].text.size();
  return files->files[file].text.c_str();
}

const char* obvid_files_remark(const obvid_files* files, size_t remark) {
  return remark < files->remarks.size() ? files->remarks[remark].c_str() : nullptr;
}

void obvid_files_free(obvid_files* files) { delete files; }
}
