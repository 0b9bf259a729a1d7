// SPDX-License-Identifier: Apache-2.0
#include "dxf/units.h"

#include <array>

namespace obvid::dxf {
namespace {

struct Row {
  int code;
  Unit unit;
  bool metric = true;
};

constexpr std::array kUnits = {
    Row{1, {"in", 1.0, true}, false},
    Row{2, {"ft", 1.0, true}, false},
    Row{3, {"mi", 1.0, true}, false},
    Row{4, {"mm", 1.0, true}},
    Row{5, {"cm", 1.0, true}},
    Row{6, {"m", 1.0, true}},
    Row{7, {"km", 1.0, true}},
    Row{8, {"mil", 1e-3, true}, false},  // microinch
    Row{9, {"mil", 1.0, true}, false},
    Row{10, {"yd", 1.0, true}, false},
    Row{11, {"nm", 0.1, true}},  // angstrom
    Row{12, {"nm", 1.0, true}},
    Row{13, {"um", 1.0, true}},
    Row{14, {"dm", 1.0, true}},
    Row{15, {"m", 10.0, true}},                 // decametre
    Row{16, {"m", 100.0, true}},                // hectometre
    Row{17, {"km", 1e6, true}},                 // gigametre
    Row{18, {"km", 149597870.7, true}},         // astronomical unit
    Row{19, {"km", 9460730472580.8, true}},     // light year
    Row{20, {"km", 30856775814913.673, true}},  // parsec
    Row{21, {"usft", 1.0, true}, false},
    Row{22, {"usft", 1.0 / 12.0, true}, false},  // US survey inch
    Row{23, {"usft", 3.0, true}, false},         // US survey yard
    Row{24, {"usft", 5280.0, true}, false},      // US survey mile
};

}  // namespace

Unit unit_of(int insunits) {
  for (const Row& row : kUnits) {
    if (row.code == insunits) return row.unit;
  }
  return {};
}

int insunits_of(std::string_view name) {
  for (const Row& row : kUnits) {
    if (row.unit.factor == 1.0 && name == row.unit.name) return row.code;
  }
  return 0;
}

int measurement_of(int insunits) {
  for (const Row& row : kUnits) {
    if (row.code == insunits) return row.metric ? 1 : 0;
  }
  return 1;
}

}  // namespace obvid::dxf
