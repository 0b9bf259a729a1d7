// SPDX-License-Identifier: Apache-2.0
#include "dxf_units.h"

#include <array>

namespace obvid::dxf {
namespace {

struct Row {
  int code;
  Unit unit;
};

constexpr double kSurveyFoot = 1200.0 / 3937.0;  // m

constexpr std::array kUnits = {
    Row{1, {"in", 1.0, true}},
    Row{2, {"ft", 1.0, true}},
    Row{3, {"km", 1.609344, true}},  // mile
    Row{4, {"mm", 1.0, true}},
    Row{5, {"cm", 1.0, true}},
    Row{6, {"m", 1.0, true}},
    Row{7, {"km", 1.0, true}},
    Row{8, {"um", 0.0254, true}},  // microinch
    Row{9, {"mm", 0.0254, true}},  // mil
    Row{10, {"m", 0.9144, true}},  // yard
    Row{11, {"um", 1e-4, true}},   // angstrom
    Row{12, {"um", 1e-3, true}},   // nanometre
    Row{13, {"um", 1.0, true}},
    Row{14, {"m", 0.1, true}},    // decimetre
    Row{15, {"m", 10.0, true}},   // decametre
    Row{16, {"m", 100.0, true}},  // hectometre
    Row{17, {"km", 1e6, true}},   // gigametre
    Row{21, {"m", kSurveyFoot, true}},
    Row{22, {"m", kSurveyFoot / 12.0, true}},
    Row{23, {"m", kSurveyFoot * 3.0, true}},
    Row{24, {"m", kSurveyFoot * 5280.0, true}},
};

}  // namespace

Unit unit_of(int insunits) {
  for (const Row& row : kUnits) {
    if (row.code == insunits) return row.unit;
  }
  return {};
}

Unit unit_of(std::string_view name) {
  for (const Row& row : kUnits) {
    if (row.unit.factor == 1.0 && name == row.unit.name) return row.unit;
  }
  return {};
}

}  // namespace obvid::dxf
