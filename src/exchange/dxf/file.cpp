// SPDX-License-Identifier: Apache-2.0
#include "dxf/file.h"

#include "dxf/units.h"

namespace obvid::exchange {
namespace {

constexpr const char* kHead = R"(  0
SECTION
  2
HEADER
  9
$ACADVER
  1
AC1015
  9
$HANDSEED
  5
{seed}
  9
$INSUNITS
 70
{units}
  9
$MEASUREMENT
 70
{metric}
  9
$EXTMIN
 10
{low_x}
 20
{low_y}
 30
0.0
  9
$EXTMAX
 10
{high_x}
 20
{high_y}
 30
0.0
  0
ENDSEC
  0
SECTION
  2
CLASSES
  0
ENDSEC
)";

constexpr unsigned kFirstHandle = 0x80;  // free among those of the tables, up to 0xFF

/// One table: head, entries, end.
class Tables {
 public:
  explicit Tables(DxfWriter& out) : out_(out) {}

  void begin(const char* name, const char* handle, int entries) {
    table_ = handle;
    out_.pair(0, "TABLE");
    out_.pair(2, name);
    out_.pair(5, handle);
    out_.pair(330, "0");
    out_.pair(100, "AcDbSymbolTable");
    out_.pair(70, entries);
  }
  void entry(const char* kind, const char* handle, const char* subclass, std::string_view name,
             int handle_code = 5) {
    out_.pair(0, kind);
    out_.pair(handle_code, handle);
    out_.pair(330, table_);
    out_.pair(100, "AcDbSymbolTableRecord");
    out_.pair(100, subclass);
    out_.pair(2, name);
  }
  void end() { out_.pair(0, "ENDTAB"); }

 private:
  DxfWriter& out_;
  std::string table_;
};

void add_vport(DxfWriter& out, Tables& tables, Vec2 low, Vec2 high) {
  tables.begin("VPORT", "8", 1);
  tables.entry("VPORT", "29", "AcDbViewportTableRecord", "*Active");
  out.pair(70, 0);
  out.point(10, {0.0, 0.0});
  out.point(11, {1.0, 1.0});
  out.point(12, 0.5 * (low + high));
  out.point(13, {0.0, 0.0});
  out.point(14, {10.0, 10.0});
  out.point(15, {10.0, 10.0});
  out.point3(16, {0.0, 0.0});
  out.point3(17, {0.0, 0.0});
  const double height = high.y - low.y;
  out.pair(40, height > 0.0 ? 1.1 * height : 1.0);
  out.pair(41, 1.5);
  out.pair(42, 50.0);
  tables.end();
}

void add_linetypes(DxfWriter& out, Tables& tables) {
  tables.begin("LTYPE", "5", 3);
  const char* const names[][2] = {{"14", "ByBlock"}, {"15", "ByLayer"}, {"16", "Continuous"}};
  for (const auto& [handle, name] : names) {
    tables.entry("LTYPE", handle, "AcDbLinetypeTableRecord", name);
    out.pair(70, 0);
    out.pair(3, "");
    out.pair(72, 65);
    out.pair(73, 0);
    out.pair(40, 0.0);
  }
  tables.end();
}

void add_layers(DxfWriter& out, Tables& tables, const std::vector<DxfLayer>& more) {
  std::vector<std::pair<std::string, DxfLayer>> layers{{"10", {"0", kWhiteOrBlack}}};
  for (const DxfLayer& layer : more) {
    if (layer.name == "0") continue;
    const auto number = static_cast<unsigned>(layers.size()) - 1;
    const std::string own = number == 0 ? "11" : fmt::format("{:X}", kFirstHandle + number);
    layers.emplace_back(layer.handle.empty() ? own : layer.handle, layer);
  }
  tables.begin("LAYER", "2", static_cast<int>(std::max<std::size_t>(layers.size(), 2)));
  for (const auto& [handle, layer] : layers) {
    tables.entry("LAYER", handle.c_str(), "AcDbLayerTableRecord", layer.name);
    out.pair(70, 0);
    out.pair(62, layer.color);
    out.pair(6, "Continuous");
    out.pair(390, "F");
  }
  tables.end();
}

void add_small_tables(DxfWriter& out, Tables& tables) {
  tables.begin("STYLE", "3", 1);
  tables.entry("STYLE", "17", "AcDbTextStyleTableRecord", "Standard");
  out.pair(70, 0);
  out.pair(40, 0.0);
  out.pair(41, 1.0);
  out.pair(50, 0.0);
  out.pair(71, 0);
  out.pair(42, 2.5);
  out.pair(3, "txt");
  out.pair(4, "");
  tables.end();
  tables.begin("VIEW", "6", 0);
  tables.end();
  tables.begin("UCS", "7", 0);
  tables.end();
  tables.begin("APPID", "9", 1);
  tables.entry("APPID", "12", "AcDbRegAppTableRecord", "ACAD");
  out.pair(70, 0);
  tables.end();
  tables.begin("DIMSTYLE", "A", 1);
  out.pair(100, "AcDbDimStyleTable");
  tables.entry("DIMSTYLE", "27", "AcDbDimStyleTableRecord", "Standard", 105);
  out.pair(70, 0);
  tables.end();
}

void add_blocks(DxfWriter& out) {
  const char* const blocks[][4] = {{kModelSpace, "*Model_Space", "20", "21"},
                                   {"1B", "*Paper_Space", "1C", "1D"}};
  for (const auto& [record, name, begin, end] : blocks) {
    out.pair(0, "BLOCK");
    out.pair(5, begin);
    out.pair(330, record);
    out.pair(100, "AcDbEntity");
    out.pair(8, "0");
    out.pair(100, "AcDbBlockBegin");
    out.pair(2, name);
    out.pair(70, 0);
    out.point3(10, {0.0, 0.0});
    out.pair(3, name);
    out.pair(1, "");
    out.pair(0, "ENDBLK");
    out.pair(5, end);
    out.pair(330, record);
    out.pair(100, "AcDbEntity");
    out.pair(8, "0");
    out.pair(100, "AcDbBlockEnd");
  }
}

void begin_section(DxfWriter& out, const char* name) {
  out.pair(0, "SECTION");
  out.pair(2, name);
}

void end_section(DxfWriter& out) { out.pair(0, "ENDSEC"); }

}  // namespace

void give_handles(std::vector<DxfLayer>& layers, DxfWriter& out) {
  constexpr std::size_t kFew = 0x7F;
  for (std::size_t i = kFew; i < layers.size(); ++i) layers[i].handle = out.handle();
}

std::string r2000_head(const std::vector<DxfLayer>& layers, int units, const std::string& seed,
                       Vec2 low, Vec2 high) {
  DxfWriter out;
  out.append(fmt::format(fmt::runtime(kHead), fmt::arg("seed", seed), fmt::arg("units", units),
                         fmt::arg("metric", dxf::measurement_of(units)), fmt::arg("low_x", low.x),
                         fmt::arg("low_y", low.y), fmt::arg("high_x", high.x),
                         fmt::arg("high_y", high.y)));
  begin_section(out, "TABLES");
  Tables tables(out);
  add_vport(out, tables, low, high);
  add_linetypes(out, tables);
  add_layers(out, tables, layers);
  add_small_tables(out, tables);
  tables.begin("BLOCK_RECORD", "1", 2);
  tables.entry("BLOCK_RECORD", kModelSpace, "AcDbBlockTableRecord", "*Model_Space");
  tables.entry("BLOCK_RECORD", "1B", "AcDbBlockTableRecord", "*Paper_Space");
  tables.end();
  end_section(out);
  begin_section(out, "BLOCKS");
  add_blocks(out);
  end_section(out);
  begin_section(out, "ENTITIES");
  return out.take();
}

std::string r2000_tail() {
  DxfWriter out;
  end_section(out);
  begin_section(out, "OBJECTS");
  out.pair(0, "DICTIONARY");
  out.pair(5, "C");
  out.pair(330, "0");
  out.pair(100, "AcDbDictionary");
  out.pair(281, 1);
  out.pair(3, "ACAD_GROUP");
  out.pair(350, "D");
  out.pair(3, "ACAD_PLOTSTYLENAME");
  out.pair(350, "E");
  out.pair(0, "DICTIONARY");
  out.pair(5, "D");
  out.pair(330, "C");
  out.pair(100, "AcDbDictionary");
  out.pair(281, 1);
  out.pair(0, "ACDBDICTIONARYWDFLT");
  out.pair(5, "E");
  out.pair(330, "C");
  out.pair(100, "AcDbDictionary");
  out.pair(281, 1);
  out.pair(3, "Normal");
  out.pair(350, "F");
  out.pair(100, "AcDbDictionaryWithDefault");
  out.pair(340, "F");
  out.pair(0, "ACDBPLACEHOLDER");
  out.pair(5, "F");
  out.pair(330, "E");
  end_section(out);
  out.pair(0, "EOF");
  return out.take();
}

std::string r12_head(const std::vector<std::string>& layers, const std::string& units, Vec2 low,
                     Vec2 high) {
  DxfWriter out;
  if (!units.empty()) out.pair(999, kUnitsComment + units);
  begin_section(out, "HEADER");
  out.pair(9, "$ACADVER");
  out.pair(1, "AC1009");
  out.pair(9, "$EXTMIN");
  out.point3(10, low);
  out.pair(9, "$EXTMAX");
  out.point3(10, high);
  end_section(out);
  begin_section(out, "TABLES");
  out.pair(0, "TABLE");
  out.pair(2, "LTYPE");
  out.pair(70, 1);
  out.pair(0, "LTYPE");
  out.pair(2, "CONTINUOUS");
  out.pair(70, 0);
  out.pair(3, "Solid line");
  out.pair(72, 65);
  out.pair(73, 0);
  out.pair(40, 0.0);
  out.pair(0, "ENDTAB");
  out.pair(0, "TABLE");
  out.pair(2, "LAYER");
  out.pair(70, static_cast<int>(layers.size()));
  for (const std::string& layer : layers) {
    out.pair(0, "LAYER");
    out.pair(2, layer);
    out.pair(70, 0);
    out.pair(62, 7);
    out.pair(6, "CONTINUOUS");
  }
  out.pair(0, "ENDTAB");
  end_section(out);
  begin_section(out, "ENTITIES");
  return out.take();
}

}  // namespace obvid::exchange
