// SPDX-License-Identifier: Apache-2.0
#include "element_table.h"

#include <fmt/format.h>

#include <utility>

#include "table.h"
#include "text.h"

namespace obvid {

std::string elements_text(const std::vector<AlignmentElement>& elements, double size,
                          const std::optional<SpeedLimit>& limit) {
  constexpr int kAzimuthDecimals = 4;
  Table table;
  table.column("element");
  table.column("kind", Table::Align::kLeft);
  for (const char* head : {"station", "length", "radius\nat start", "radius\nat end", "A",
                           "azimuth\ndegrees", "\nx", "\ny"}) {
    table.column(head);
  }
  if (limit) table.column("speed\nkm/h");
  table.column("", Table::Align::kLeft);
  for (std::size_t k = 0; k < elements.size(); ++k) {
    const AlignmentElement& e = elements[k];
    const double parameter = clothoid_parameter(e);
    std::vector<std::string> cells{std::to_string(k + 1), to_string(e.kind), coordinate(e.station, size),
               coordinate(e.length, size), radius_text(e.start.kappa), radius_text(e.kappa1),
                                   parameter > 0.0 ? significant(parameter, 5) : "-",
               fmt::format("{:.{}f}", azimuth_deg(e.start.theta), kAzimuthDecimals),
               coordinate(e.start.point.x, size), coordinate(e.start.point.y, size)};
    if (limit) {
      const auto speed = speed_kmh(e, *limit);
      cells.push_back(speed ? significant(*speed, 4) : "-");
    }
    cells.emplace_back(e.step ? "curvature steps here" : "");
    table.row(std::move(cells));
  }
  return table.text();
}

}  // namespace obvid
