// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "door.h"
#include "handles.h"
#include "obvid/core/files.h"
#include "obvid/pipeline/import.h"

namespace obvid::capi {
namespace {

/// Points of an array, checked as those of files are: finite, no two neighbours equal. Whether
/// two of them do depends on the headings, which are options.
Result<PointSeries> series_of_array(const double* xy, std::size_t n) {
  PointSeries out;
  std::size_t merged = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 p{xy[2 * i], xy[2 * i + 1]};
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) {
      return error(ErrorCode::kNotFinite, "a coordinate is not finite")
          .where("point " + std::to_string(i + 1))
          .point(i);
    }
    if (!out.points.empty() && out.points.back() == p) {
      ++merged;
    } else {
      out.points.push_back(p);
    }
  }
  if (out.points.size() < 2) {
    return fail({ErrorCode::kTooFewPoints, "a contour needs 3 distinct points", "",
                 "two do when both have a heading"});
  }
  if (merged > 0) {
    out.warnings.push_back(std::to_string(merged) +
                           (merged == 1 ? " point that repeats" : " points that repeat") +
                           " the point before merged into it");
  }
  return out;
}

/// Points in space as they are: rows of grids and tips of skins may repeat them.
Result<SpaceSeries> space_series_of_array(const double* xyz, std::size_t n) {
  SpaceSeries out;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 p{xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
    if (!is_finite(p)) {
      return error(ErrorCode::kNotFinite, "a coordinate is not finite")
          .where("point " + std::to_string(i + 1))
          .point(i);
    }
    out.points.push_back(p);
  }
  if (out.points.empty()) return fail({ErrorCode::kTooFewPoints, "there are no points", "", ""});
  return out;
}

}  // namespace
}  // namespace obvid::capi

using obvid::capi::guarded;

extern "C" {

int obvid_points(const double* xy, size_t n, obvid_input** input, obvid_error** error) {
  return guarded(error, [&]() -> obvid::Result<void> {
    auto series = obvid::capi::series_of_array(xy, n);
    if (!series) return obvid::fail(series.error());
    auto out = std::make_unique<obvid_input>();
    out->points = std::move(*series);
    *input = out.release();
    return {};
  });
}

int obvid_space_points(const double* xyz, size_t n, obvid_input** input, obvid_error** error) {
  return guarded(error, [&]() -> obvid::Result<void> {
    auto series = obvid::capi::space_series_of_array(xyz, n);
    if (!series) return obvid::fail(series.error());
    auto out = std::make_unique<obvid_input>();
    out->space = std::move(*series);
    *input = out.release();
    return {};
  });
}

int obvid_read_text(const char* text, size_t size, const char* name, obvid_input** input,
                    obvid_error** error) {
  return guarded(error, [&]() -> obvid::Result<void> {
    auto out = std::make_unique<obvid_input>();
    out->name = name == nullptr ? "text" : name;
    out->text.assign(text, size);
    *input = out.release();
    return {};
  });
}

int obvid_read_file(const char* path, obvid_input** input, obvid_error** error) {
  return guarded(error, [&]() -> obvid::Result<void> {
    auto text = obvid::read_file(path);
    if (!text) return obvid::fail(text.error());
    auto out = std::make_unique<obvid_input>();
    out->name = path;
    out->is_file = true;
    out->text = std::move(*text);
    out->by_path = obvid::needs_cad(out->text);
    *input = out.release();
    return {};
  });
}

void obvid_input_free(obvid_input* input) { delete input; }
}
