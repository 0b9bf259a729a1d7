// SPDX-License-Identifier: Apache-2.0
// Any points give a contour or an error with its reason; a contour that was formed and proved is
// accepted again from its own file.
#include "obvid/pipeline/fit.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "obvid/io/contour_json.h"
#include "promise.h"

namespace {

constexpr std::size_t kMostPoints = 64;

/// Takes numbers off the front of the bytes.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  template <class T>
  bool take(T& value) {
    if (size_ < sizeof(T)) return false;
    std::memcpy(&value, data_, sizeof(T));
    data_ += sizeof(T);
    size_ -= sizeof(T);
    return true;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

/// Small steps on a grid (collinear, circular and repeated points come up often) or raw doubles.
std::vector<obvid::Vec2> points_from(Bytes& bytes, bool raw) {
  std::vector<obvid::Vec2> points;
  obvid::Vec2 at{};
  while (points.size() < kMostPoints) {
    if (raw) {
      if (!bytes.take(at.x) || !bytes.take(at.y)) break;
    } else {
      std::int8_t dx = 0, dy = 0;
      if (!bytes.take(dx) || !bytes.take(dy)) break;
      at = at + obvid::Vec2{static_cast<double>(dx), static_cast<double>(dy)};
    }
    points.push_back(at);
  }
  return points;
}

}  // namespace

using obvid::require;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  std::uint8_t options = 0;
  if (!bytes.take(options)) return 0;
  obvid::FitJob job;
  job.carrier = (options & 1U) != 0 ? obvid::Carrier::kArcs : obvid::Carrier::kSpiral;
  job.convex = (options & 2U) != 0;
  std::int8_t angle = 0;
  if ((options & 4U) != 0 && bytes.take(angle)) job.start_heading = 0.05 * angle;
  if ((options & 8U) != 0 && bytes.take(angle)) job.end_kappa = 0.01 * angle;
  job.tolerance = (options & 16U) != 0 ? std::optional(1e-2) : std::nullopt;
  if ((options & 128U) != 0) job.continuity = obvid::Continuity::kG3;
  std::uint8_t measured = 0, reach = 0;
  if ((options & 64U) != 0 && bytes.take(measured) && bytes.take(reach)) {
    job.noise = 0.05 * (reach + 1);
    job.primitives = (measured & 1U) != 0;
    job.closing = (measured & 2U) != 0 ? obvid::Closing::kClosed : obvid::Closing::kAutomatic;
    job.find_corners = (measured & 4U) == 0;
    if ((measured & 8U) != 0) job.carrier = obvid::Carrier::kClothoids;
  }
  obvid::PointSeries series;
  series.points = points_from(bytes, (options & 32U) != 0);

  const auto f = obvid::fit(series, job);
  if (!f) {
    require(f.error().code != obvid::ErrorCode::kInternal);
    require(!f.error().what.empty());
    return 0;
  }
  require(f->certificate.proved != !f->certificate.reason.empty());
  const auto text = obvid::contour_to_json({f->contour, f->report, f->certificate});
  const auto stored = obvid::contour_from_json(text, "fuzz");
  require(stored.has_value());
  const obvid::Verification v = obvid::verify(*stored);
  require(v.certificate.proved == f->certificate.proved);
  const bool reached = f->report.largest_width <= f->report.tolerance;
  require(!f->certificate.proved || !reached || !v.false_claim);
  return 0;
}
