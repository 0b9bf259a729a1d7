// SPDX-License-Identifier: Apache-2.0
#include "text_kind.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>

#include "obvid/io/internal/file_kind.h"
#include "text_lines.h"

namespace obvid::text {
namespace {

using std::string_view;

// How much of a file names its format, in bytes.
constexpr std::size_t kHeadLength = 4096;

// Control characters that text files do hold: tab, LF, VT, FF, CR, and the end mark of DOS.
constexpr bool is_binary(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x20U && (byte < 0x09U || byte > 0x0DU) && byte != 0x1AU;
}

bool has(string_view head, string_view what) { return head.find(what) != string_view::npos; }
bool starts(string_view head, string_view what) { return head.substr(0, what.size()) == what; }

string_view skip_space(string_view head) {
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  return first == string_view::npos ? string_view{} : head.substr(first);
}

// A DXF file is pairs of a group code line and a value line and opens with 0/SECTION or a 999
// comment.
bool is_dxf(string_view head) {
  LineCursor cursor(head);
  for (int pair = 0; pair < 8 && !cursor.at_end(); ++pair) {
    const string_view code = cursor.peek();
    cursor.skip(code);
    const string_view value = cursor.peek();
    cursor.skip(value);
    if (trim(code) == "0" && trim(value) == "SECTION") return true;
    if (trim(code) != "999") return false;
  }
  return false;
}

// Fixed 80-column lines with the section letter S in column 73 and the sequence number 1, padded
// with blanks or zeros.
bool is_iges(string_view head) {
  const string_view line = LineCursor(head).peek();
  if (line.size() != 80 || line[72] != 'S') return false;
  const string_view sequence = line.substr(73);
  return sequence.substr(std::min(sequence.find_first_not_of(" 0"), sequence.size())) == "1";
}

std::optional<string_view> xml_kind(string_view head) {
  static constexpr std::array<std::array<string_view, 2>, 7> kRoots{{{"<gpx", "GPX"},
                                                                     {"<svg", "SVG"},
                                                                     {"<kml", "KML"},
                                                                     {"<LandXML", "LandXML"},
                                                                     {"<OpenDRIVE", "OpenDRIVE"},
                                                                     {"<html", "HTML"},
                                                                     {"<HTML", "HTML"}}};
  if (!starts(head, "<")) return std::nullopt;
  for (const auto& [root, kind] : kRoots) {
    if (has(head, root)) return kind;
  }
  const bool xml = starts(head, "<?xml") || starts(head, "<!");
  return xml ? std::optional<string_view>("XML") : std::nullopt;
}

std::optional<string_view> json_kind(string_view head) {
  if (!starts(head, "{") && !starts(head, "[")) return std::nullopt;
  if (has(head, "\"obvid-contour\"")) return "a contour file";
  if (has(head, "\"FeatureCollection\"") || has(head, "\"coordinates\"")) return "GeoJSON";
  // "[" alone may open a line of column names.
  const string_view inside = skip_space(head.substr(1));
  const bool json = !inside.empty() && has("\"{[}]-0123456789", inside.substr(0, 1));
  return json ? std::optional<string_view>("JSON") : std::nullopt;
}

std::optional<string_view> foreign_kind(string_view head) {
  if (starts(head, "AutoCAD Binary DXF")) return "binary DXF";
  if (is_iges(head)) return "IGES";
  head = skip_space(head);
  if (starts(head, "ISO-10303-21")) return "STEP";
  // Laser surveys of NASA: tables of one scan after the other, each with its own head.
  if (has(head, "CONF. LEVEL") && has(head, "WINDOW")) return "a survey of several scans";
  if (starts(head, "DBRep_DrawableShape") || starts(head, "CASCADE Topology")) return "BREP";
  if (is_dxf(head)) return "DXF";
  if (const auto kind = json_kind(head)) return kind;
  return xml_kind(head);
}

Error not_text(string_view name, string_view what, string_view hint) {
  Error error;
  error.code = ErrorCode::kNotText;
  error.what = std::string(what);
  error.where = std::string(name);
  error.hint = std::string(hint);
  return error;
}

Error unsupported(string_view name, string_view kind) {
  Error error;
  error.code = ErrorCode::kUnsupported;
  error.where = position(name, 1, 1);
  if (kind == "a contour file") {
    error.what = "this is a contour file, not a list of points";
    error.hint = "use `obvid verify` or `obvid convert` on it";
  } else {
    error.what = std::string(kind) + " is not read yet";
    error.hint = kind == "a survey of several scans"
                     ? "save one scan as text with columns x,y,u95"
                     : "save the points as text with two columns x,y";
  }
  return error;
}

}  // namespace

Result<void> check_text_kind(string_view text, string_view name) {
  constexpr string_view kHint = "save the points as UTF-8 text with two columns x,y";
  if (const auto kind = foreign_kind(text.substr(0, kHeadLength))) {
    return fail(unsupported(name, *kind));
  }
  if (starts(text, "\xFF\xFE") || starts(text, "\xFE\xFF")) {
    return fail(not_text(name, "the file is UTF-16, not UTF-8", kHint));
  }
  // Counted, not searched: a loop without an exit runs over many bytes at a time.
  const auto binary = std::count_if(text.begin(), text.end(), is_binary);
  if (binary == 0) return {};
  const auto first = std::find_if(text.begin(), text.end(), is_binary) - text.begin();
  Error error = not_text(name, "the file holds binary data, not text", kHint);
  error.what += " (first at byte " + std::to_string(first + 1) + ")";
  return fail(std::move(error));
}

}  // namespace obvid::text

namespace obvid {

FileKind file_kind(std::string_view text) {
  static constexpr std::array<std::pair<std::string_view, FileKind>, 12> kKinds = {
      {{"a contour file", FileKind::kContour},
       {"binary DXF", FileKind::kDxf},
       {"DXF", FileKind::kDxf},
       {"STEP", FileKind::kStep},
       {"IGES", FileKind::kIges},
       {"BREP", FileKind::kBrep},
       {"SVG", FileKind::kSvg},
       {"GPX", FileKind::kGpx},
       {"GeoJSON", FileKind::kGeoJson},
       {"LandXML", FileKind::kLandXml},
       {"OpenDRIVE", FileKind::kOpenDrive},
       {"KML", FileKind::kOther}}};
  const auto kind = text::foreign_kind(text.substr(0, text::kHeadLength));
  if (!kind) return FileKind::kPoints;
  for (const auto& [name, one] : kKinds) {
    if (*kind == name) return one;
  }
  return FileKind::kOther;
}

bool is_json_text(std::string_view text) { return text::starts(text::skip_space(text), "{"); }

}  // namespace obvid
