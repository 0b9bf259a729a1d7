// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "obvid/cad/internal/cad.h"

namespace obvid::cad {

// What the program asks of its helper.
struct ReadCurves {
  std::string path;
};
struct ReadFaces {
  std::string path;
};
struct WriteCurves {
  std::vector<CadCurve> curves;
  CadWriteOptions options;
};
struct WriteFaces {
  SurfaceModel model;
  CadWriteOptions options;
};
using Job = std::variant<ReadCurves, ReadFaces, WriteCurves, WriteFaces>;

[[nodiscard]] std::string packed(const Job& job);
/// Nothing when the bytes are no job.
[[nodiscard]] std::optional<Job> unpacked_job(std::string_view bytes);

// What the helper answers: a value or an error.
[[nodiscard]] std::string packed(const Result<Drawing>& drawing);
[[nodiscard]] std::string packed(const Result<CadSurfaces>& surfaces);
[[nodiscard]] std::string packed(const Result<std::string>& text);

/// Back again, from bytes that need not be right, because the kernel may have been led astray by
/// the file. A value has finite numbers and degrees within their limits, surfaces pass `check`;
/// bytes that are not whole or not sound give `otherwise`.
[[nodiscard]] Result<Drawing> unpacked_drawing(std::string_view bytes, const Error& otherwise);
[[nodiscard]] Result<CadSurfaces> unpacked_surfaces(std::string_view bytes, const Error& otherwise);
[[nodiscard]] Result<std::string> unpacked_text(std::string_view bytes, const Error& otherwise);

}  // namespace obvid::cad
