// SPDX-License-Identifier: Apache-2.0
// Any bytes from the helper for STEP, IGES and BREP give a drawing, surfaces or a text that can be
// worked with, or an error; any bytes sent to it give a job or none.
#include "cad/client/helper_message.h"

#include <cstdint>
#include <cstdlib>

namespace {

using obvid::Error;
using obvid::ErrorCode;
using obvid::Result;

const Error kOtherwise = {ErrorCode::kNotText, "not whole", "", "", -1, 0.0};

/// What was understood is sent as the bytes that came.
template <class Value>
void expect_same(const Value& value, std::string_view bytes) {
  if (obvid::cad::packed(value) != bytes) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0] % 4) {
    case 0: {
      const auto drawing = obvid::cad::unpacked_drawing(bytes, kOtherwise);
      if (drawing) {
        expect_same(drawing, bytes);
        for (const auto& curve : drawing->curves) {
          for (const auto& piece : curve.pieces) (void)evaluate(piece, 0.5);
        }
      }
      break;
    }
    case 1: {
      const auto surfaces = obvid::cad::unpacked_surfaces(bytes, kOtherwise);
      if (!surfaces) break;
      expect_same(surfaces, bytes);
      for (const auto& patch : surfaces->model.patches) {
        const auto u = domain_u(patch.surface), v = domain_v(patch.surface);
        (void)evaluate(patch.surface, u.from, v.to);
      }
      break;
    }
    case 2: {
      const auto text = obvid::cad::unpacked_text(bytes, kOtherwise);
      if (text) expect_same(text, bytes);
      break;
    }
    default: {
      const auto job = obvid::cad::unpacked_job(bytes);
      if (job) expect_same(*job, bytes);
    }
  }
  return 0;
}
