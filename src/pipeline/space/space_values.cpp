// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/internal/space_values.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "obvid/core/internal/typed_numbers.h"
#include "obvid/io/read_points.h"
#include "obvid/pipeline/internal/job_values.h"

namespace obvid {

Result<std::optional<Vec3>> direction_named(const std::string& typed) {
  if (typed.empty()) return std::nullopt;
  constexpr std::pair<char, Vec3> kAxes[] = {{'x', {1, 0, 0}}, {'y', {0, 1, 0}}, {'z', {0, 0, 1}}};
  for (const auto& [letter, axis] : kAxes) {
    if (typed.size() == 1 && std::tolower(static_cast<unsigned char>(typed[0])) == letter) {
      return std::optional(axis);
    }
  }
  const auto d = typed_numbers(typed);
  const Vec3 made = d && d->size() == 3 ? Vec3{(*d)[0], (*d)[1], (*d)[2]} : Vec3{};
  if (!(norm(made) > 0.0)) {
    return fail(bad_option("'" + typed + "' is no direction", "--along",
                           "X, Y, Z, or three numbers: 1,0,0.5"));
  }
  return std::optional(made);
}

Result<std::vector<FixedData>> fixed_in_space(const SpaceSeries& series, const std::string& text,
                                              const std::optional<Vec3>& along,
                                              const std::string& name,
                                              const ImportOptions& import) {
  PointListOptions list = import.list;
  list.two = TwoPoints::kDo;
  auto plane = parse_points(text, name, list);
  if (!plane || plane->fixed.empty()) return std::vector<FixedData>{};
  if (plane->points.size() != series.points.size()) {
    return fail(bad_option("columns of points that lie above each other have no projection", name,
                           "--flat forms the contour in the plane of x and y"));
  }
  place(import.placement, *plane);
  const bool more = std::any_of(plane->fixed.begin(), plane->fixed.end(),
                                [](const FixedData& f) { return f.says_how() || f.tolerance; });
  const bool plan_view = along && along->x == 0.0 && along->y == 0.0;
  if (!more || plan_view) return plane->fixed;
  return fail(bad_option("the file fixes headings, radii or tolerances of points in space", name,
                         "--along Z takes them as seen in the plane of x and y, --flat forms the "
                         "contour in that plane alone"));
}

}  // namespace obvid
