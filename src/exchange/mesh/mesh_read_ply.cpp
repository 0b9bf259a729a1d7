// SPDX-License-Identifier: Apache-2.0
// PLY: a header that describes elements, then their values as text or as bytes.
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "mesh/mesh_builder.h"
#include "mesh/mesh_bytes.h"

namespace obvid::exchange {
namespace {

enum class PlyType { kI8, kU8, kI16, kU16, kI32, kU32, kF32, kF64 };

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kF32;
  std::optional<PlyType> counted_by;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  bool text = true, little = true;
  std::vector<PlyElement> elements;
  std::size_t end = 0;  ///< bytes
};

std::optional<PlyType> ply_type(std::string_view name) {
  using enum PlyType;
  constexpr std::array<std::pair<std::string_view, PlyType>, 16> kNames{{{"char", kI8},
                                                                         {"uchar", kU8},
                                                                         {"short", kI16},
                                                                         {"ushort", kU16},
                                                                         {"int", kI32},
                                                                         {"uint", kU32},
                                                                         {"float", kF32},
                                                                         {"double", kF64},
                                                                         {"int8", kI8},
                                                                         {"uint8", kU8},
                                                                         {"int16", kI16},
                                                                         {"uint16", kU16},
                                                                         {"int32", kI32},
                                                                         {"uint32", kU32},
                                                                         {"float32", kF32},
                                                                         {"float64", kF64}}};
  for (const auto& [known, type] : kNames) {
    if (known == name) return type;
  }
  return std::nullopt;
}

std::size_t ply_size(PlyType type) {
  switch (type) {
    case PlyType::kI8:
    case PlyType::kU8:
      return 1;
    case PlyType::kI16:
    case PlyType::kU16:
      return 2;
    case PlyType::kF64:
      return 8;
    default:
      return 4;
  }
}

std::optional<std::size_t> ply_count(std::string_view word) {
  std::size_t out = 0;
  constexpr std::size_t kMostDigits = 15;
  if (word.empty() || word.size() > kMostDigits) return std::nullopt;
  for (const char c : word) {
    if (c < '0' || c > '9') return std::nullopt;
    out = 10 * out + static_cast<std::size_t>(c - '0');
  }
  return out;
}

/// One line of the header; false when it cannot be understood.
bool take_line(const std::vector<std::string_view>& words, PlyHeader& header) {
  if (words[0] == "format" && words.size() > 1) {
    header.text = words[1] == "ascii";
    header.little = words[1] == "binary_little_endian";
    return header.text || header.little || words[1] == "binary_big_endian";
  }
  if (words[0] == "element" && words.size() == 3) {
    const auto count = ply_count(words[2]);
    if (!count) return false;
    header.elements.push_back({std::string(words[1]), *count, {}});
    return true;
  }
  if (words[0] == "property" && !header.elements.empty()) {
    PlyProperty property;
    const bool list = words.size() == 5 && words[1] == "list";
    if (!list && words.size() != 3) return false;
    const auto type = ply_type(words[list ? 3 : 1]);
    if (list) property.counted_by = ply_type(words[2]);
    if (!type || (list && !property.counted_by)) return false;
    property.type = *type;
    property.name = words.back();
    header.elements.back().properties.push_back(std::move(property));
    return true;
  }
  return words[0] == "comment" || words[0] == "obj_info" || words[0] == "ply";
}

Result<PlyHeader> header_of(std::string_view text, const MeshBuilder& builder) {
  PlyHeader header;
  MeshWords lines(text);
  while (lines.next()) {
    if (lines.words()[0] == "end_header") {
      header.end = lines.position();
      return header;
    }
    if (!take_line(lines.words(), header)) {
      return fail(builder.error(ErrorCode::kUnsupported, "this line of a PLY header is not known",
                                lines.place()));
    }
  }
  return fail(builder.error(ErrorCode::kBadCount, "the header of the PLY file does not end", ""));
}

/// Values one after another, whatever they are written as.
class PlyValues {
 public:
  PlyValues(std::string_view text, const PlyHeader& header)
      : body_(text.substr(header.end)), text_(header.text), little_(header.little) {}

  std::optional<double> next(PlyType type) { return text_ ? word() : bytes(type); }

 private:
  std::optional<double> word() {
    constexpr std::string_view kBlanks = " \t\r\n";
    const std::size_t first = body_.find_first_not_of(kBlanks, at_);
    if (first == std::string_view::npos) return std::nullopt;
    const std::size_t end = std::min(body_.find_first_of(kBlanks, first), body_.size());
    const std::string one(body_.substr(first, end - first));
    at_ = end;
    char* stop = nullptr;
    const double value = std::strtod(one.c_str(), &stop);
    if (*stop != '\0') return std::nullopt;
    return value;
  }

  std::optional<double> bytes(PlyType type) {
    const std::size_t size = ply_size(type);
    if (body_.size() - at_ < size) return std::nullopt;
    const std::size_t at = std::exchange(at_, at_ + size);
    switch (type) {
      case PlyType::kI8:
        return bytes_as<std::int8_t>(body_, at, little_);
      case PlyType::kU8:
        return bytes_as<std::uint8_t>(body_, at, little_);
      case PlyType::kI16:
        return bytes_as<std::int16_t>(body_, at, little_);
      case PlyType::kU16:
        return bytes_as<std::uint16_t>(body_, at, little_);
      case PlyType::kI32:
        return bytes_as<std::int32_t>(body_, at, little_);
      case PlyType::kU32:
        return bytes_as<std::uint32_t>(body_, at, little_);
      case PlyType::kF32:
        return static_cast<double>(bytes_as<float>(body_, at, little_));
      case PlyType::kF64:
        return bytes_as<double>(body_, at, little_);
    }
    return std::nullopt;
  }

  std::string_view body_;
  bool text_, little_;
  std::size_t at_ = 0;
};

/// One property of one record: a number, or the numbers of a list.
using PlyRecord = std::vector<std::vector<double>>;

Result<void> read_record(PlyValues& values, const PlyElement& element, std::size_t number,
                         const MeshBuilder& builder, PlyRecord& out) {
  const auto ends = [&] {
    return fail(builder.error(ErrorCode::kBadCount, "the file ends, or is damaged, within a record",
                              element.name + " " + std::to_string(number)));
  };
  constexpr double kLongestList = 1e6;  // corners of one face
  out.resize(element.properties.size());
  for (std::size_t k = 0; k < element.properties.size(); ++k) {
    const PlyProperty& property = element.properties[k];
    double count = 1.0;
    if (property.counted_by) {
      const auto read = values.next(*property.counted_by);
      if (!read || !(*read >= 0.0) || *read > kLongestList) return ends();
      count = *read;
    }
    out[k].clear();
    for (double i = 0.0; i < count; i += 1.0) {
      const auto read = values.next(property.type);
      if (!read) return ends();
      out[k].push_back(*read);
    }
  }
  return {};
}

std::optional<std::size_t> ply_place(const PlyElement& element, std::string_view a,
                                     std::string_view b = "") {
  for (std::size_t k = 0; k < element.properties.size(); ++k) {
    if (element.properties[k].name == a || element.properties[k].name == b) return k;
  }
  return std::nullopt;
}

Result<void> take_points(PlyValues& values, const PlyElement& element, MeshBuilder& builder,
                         std::vector<std::uint32_t>& places) {
  const auto x = ply_place(element, "x"), y = ply_place(element, "y"), z = ply_place(element, "z");
  if (!x || !y || !z) {
    return fail(builder.error(ErrorCode::kUnsupported, "vertices without x, y and z", "header"));
  }
  PlyRecord record;
  for (std::size_t i = 0; i < element.count; ++i) {
    if (auto done = read_record(values, element, i, builder, record); !done) return done;
    Vec3 p;
    for (const auto& [to, from] : {std::pair(&p.x, *x), {&p.y, *y}, {&p.z, *z}}) {
      if (record[from].size() != 1 || !std::isfinite(record[from][0])) {
        return fail(builder.error(ErrorCode::kNotFinite, "a coordinate is not finite",
                                  "vertex " + std::to_string(i)));
      }
      *to = record[from][0];
    }
    places.push_back(builder.point(p));
  }
  return {};
}

Result<void> take_faces(PlyValues& values, const PlyElement& element, MeshBuilder& builder,
                        const std::vector<std::uint32_t>& places) {
  const auto list = ply_place(element, "vertex_indices", "vertex_index");
  if (!list || !element.properties[*list].counted_by) {
    return fail(
        builder.error(ErrorCode::kUnsupported, "faces without a list of vertices", "header"));
  }
  PlyRecord record;
  for (std::size_t i = 0; i < element.count; ++i) {
    if (auto done = read_record(values, element, i, builder, record); !done) return done;
    std::vector<std::uint32_t> corners;
    for (const double index : record[*list]) {
      if (!(index >= 0.0) || index >= static_cast<double>(places.size())) {
        return fail(builder.error(ErrorCode::kBadCount, "a corner without a vertex",
                                  "face " + std::to_string(i)));
      }
      corners.push_back(places[static_cast<std::size_t>(index)]);
    }
    builder.polygon(corners);
  }
  return {};
}

}  // namespace

Result<TriangleMesh> ply_mesh(std::string_view text, MeshBuilder& builder) {
  const auto header = header_of(text, builder);
  OBVID_TRY(header);
  PlyValues values(text, *header);
  std::vector<std::uint32_t> places;
  for (const PlyElement& element : header->elements) {
    Result<void> done;
    if (element.name == "vertex") {
      done = take_points(values, element, builder, places);
    } else if (element.name == "face") {
      done = take_faces(values, element, builder, places);
    } else {
      PlyRecord record;
      if (element.properties.empty()) continue;
      for (std::size_t i = 0; done && i < element.count; ++i) {
        done = read_record(values, element, i, builder, record);
      }
    }
    OBVID_TRY(done);
  }
  return builder.take();
}

}  // namespace obvid::exchange
