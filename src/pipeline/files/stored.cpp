// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/stored.h"

#include <utility>

#include "obvid/io/contour_json.h"
#include "obvid/io/read_points.h"
#include "obvid/io/space_json.h"

namespace obvid {

Result<Stored> parse_stored(const std::string& text, const std::string& name,
                            const RunContext& run) {
  Watch watch(without_progress(run));
  if (is_space_json(text)) {
    auto chain = space_chain_from_json(text, name, &watch);
    OBVID_TRY(chain);
    return Stored(std::move(*chain));
  }
  auto contour = contour_from_json(text, name, &watch);
  if (!contour && !watch.was_cancelled() && parse_points(text, name, {.two = TwoPoints::kDo})) {
    return error(contour.error().code, "this is a list of points, not a contour")
        .where(name)
        .hint("`obvid fit` forms a contour through them, and writes all formats");
  }
  OBVID_TRY(contour);
  return Stored(std::move(*contour));
}

}  // namespace obvid
