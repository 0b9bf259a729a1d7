// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "obvid/core/internal/figures.h"
#include "obvid/picture/internal/carriers_svg.h"
#include "obvid/pipeline/compare.h"

namespace obvid {

std::string continuity_name(const ComparedCarrier& row) {
  return "G" + std::to_string(row.continuity);
}

std::string comparison_svg(const PointSeries& series, const Comparison& compared,
                           const ShownCurvatures& shown) {
  std::vector<NamedContour> contours;
  for (const ComparedCarrier& row : compared.carriers) {
    NamedContour one{to_string(row.carrier), {}, row.fit.contour, row.fit.certificate};
    if (row.refusal) {
      one.remark = row.refusal->what;
    } else {
      one.remark = fmt::format("{}, {}", continuity_name(row),
                               counted(row.fit.contour.pieces.size(), "piece", "pieces"));
      if (const auto away = row.fit.report.carrier_deviation) {
        one.remark +=
            fmt::format(", {} {} from the spirals", significant(*away, 2), series.units.text());
      }
    }
    contours.push_back(std::move(one));
  }
  const std::string name = series.name.empty() ? "" : series.name + " · ";
  return carriers_svg(contours, name + "carriers side by side", shown);
}

}  // namespace obvid
