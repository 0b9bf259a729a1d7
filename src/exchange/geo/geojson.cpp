// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/geo/geojson.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "geo/projection_series.h"
#include "xml_text.h"

namespace obvid {
namespace {

using exchange::GeoSeries;
using nlohmann::json;
using std::string_view;

// MultiPolygon in a feature in a collection: 8. The rest is room for collections in collections and
// for properties. What walks over the values may recurse this deep.
constexpr int kMaxJsonDepth = 64;
constexpr std::size_t kMaxDetail = 120;  // bytes taken over from the message of the JSON parser

Error malformed(std::string what, std::string where) {
  return error(ErrorCode::kBadJson, std::move(what)).where(std::move(where));
}

std::string place_of(string_view text, string_view name, std::size_t byte) {
  const string_view before = text.substr(0, byte);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  return fmt::format("{}:{}:{}", name, line, before.size() - (before.find_last_of('\n') + 1) + 1);
}

/// First byte where brackets are nested too deep.
std::optional<std::size_t> too_deep(string_view text) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '[' || c == '{') {
      if (++depth > kMaxJsonDepth) return i;
    } else if (c == ']' || c == '}') {
      --depth;
    }
  }
  return std::nullopt;
}

Result<json> parsed(string_view text, string_view name) {
  if (const auto byte = too_deep(text)) {
    return fail(malformed(fmt::format("brackets are nested more than {} deep", kMaxJsonDepth),
                          place_of(text, name, *byte)));
  }
  try {
    return json::parse(text.begin(), text.end());
  } catch (const json::parse_error& error) {
    const std::size_t byte = error.byte > 0 ? error.byte - 1 : 0;
    return fail(malformed("the file is not valid JSON", place_of(text, name, byte)));
  } catch (const json::exception& error) {  // numbers out of range
    return fail(malformed(
        "the file is not valid JSON: " + shortened(string_view(error.what()).substr(0, kMaxDetail)),
        std::string(name)));
  }
}

/// A string member, or nothing.
string_view word(const json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (!object.is_object() || found == object.end() || !found->is_string()) return {};
  return found->get_ref<const std::string&>();
}

const json* member(const json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

/// Whether the name of a reference system means longitude and latitude on WGS84.
bool is_wgs84(string_view crs) {
  return crs.find("CRS84") != string_view::npos || crs == "EPSG:4326" ||
         crs.find("EPSG::4326") != string_view::npos;
}

class GeoJsonReader {
 public:
  explicit GeoJsonReader(string_view name) : name_(name) {}

  Result<Drawing> run(const json& root) {
    OBVID_TRY(object(root, ""));
    if (!points_.places.empty()) all_.push_back(std::move(points_));
    Drawing out;
    out.name = name_;
    for (const auto& [what, count] : left_out_) {
      out.warnings.push_back(fmt::format("{} left out ({} times)", what, count));
    }
    const std::string crs = reference_system(root);
    if (!crs.empty() || out_of_range_) {
      take_as_plane(crs, out);
      if (!out.series.empty()) return out;
      return error(ErrorCode::kTooFewPoints, "the file holds no line with two different places")
          .where(name_);
    }
    OBVID_TRY(exchange::project_series(std::move(all_), name_, out));
    return out;
  }

 private:
  [[nodiscard]] std::string at(const std::string& path) const { return name_ + ": " + path; }

  /// Name of a system that is not longitude and latitude; empty otherwise.
  static std::string reference_system(const json& root) {
    const json* crs = member(root, "crs");
    const json* properties = crs == nullptr ? nullptr : member(*crs, "properties");
    const string_view name = properties == nullptr ? string_view{} : word(*properties, "name");
    return name.empty() || is_wgs84(name) ? std::string() : shortened(name);
  }

  void take_as_plane(const std::string& crs, Drawing& out) {
    out.units = Units("m", UnitSource::kAssumed);
    const std::string why = crs.empty() ? "some positions are no longitude and latitude"
                                        : "the reference system is " + crs;
    out.warnings.push_back(why + ": coordinates are taken as plane ones; metres are assumed");
    for (const GeoSeries& series : all_) {
      std::vector<Vec2> points;
      for (const GeoPoint& p : series.places) points.push_back({p.longitude, p.latitude});
      PointSeries one = exchange::plane_series(series.name, out.units, points);
      one.kind = series.kind;
      if (one.points.size() < 2) {
        out.warnings.push_back(fmt::format("{} has a single place and is left out", one.name));
      } else {
        out.series.push_back(std::move(one));
      }
    }
  }

  /// Features, collections and geometries.
  Result<void> object(const json& value, const std::string& path) {
    if (!value.is_object()) {
      return fail(malformed("an object is expected", at(path.empty() ? "/" : path)));
    }
    const string_view type = word(value, "type");
    if (type == "FeatureCollection") return all_of(value, "features", path);
    if (type == "GeometryCollection") return all_of(value, "geometries", path);
    if (type == "Feature") return feature(value, path);
    return geometry(value, type, path);
  }

  Result<void> all_of(const json& value, const char* key, const std::string& path) {
    const json* list = member(value, key);
    if (list == nullptr || !list->is_array()) {
      return fail(malformed(fmt::format("a list '{}' is expected", key), at(path + "/" + key)));
    }
    for (std::size_t i = 0; i < list->size(); ++i) {
      OBVID_TRY(object((*list)[i], fmt::format("{}/{}/{}", path, key, i)));
    }
    return {};
  }

  Result<void> feature(const json& value, const std::string& path) {
    const json* inside = member(value, "geometry");
    if (inside == nullptr || inside->is_null()) {
      ++left_out_["features without geometry"];
      return {};
    }
    const json* properties = member(value, "properties");
    const std::string before = std::exchange(title_, title_of(properties));
    auto done = object(*inside, path + "/geometry");
    title_ = before;
    return done;
  }

  static std::string title_of(const json* properties) {
    if (properties == nullptr) return {};
    for (const char* key : {"name", "Name", "title", "id"}) {
      if (const string_view found = word(*properties, key); !found.empty()) {
        return shortened(found);
      }
    }
    return {};
  }

  Result<void> geometry(const json& value, string_view type, const std::string& path) {
    // How deep positions lie in `coordinates`.
    static const std::map<string_view, int> kDepth = {{"Point", 0},      {"MultiPoint", 1},
                                                      {"LineString", 1}, {"MultiLineString", 2},
                                                      {"Polygon", 2},    {"MultiPolygon", 3}};
    const auto found = kDepth.find(type);
    if (found == kDepth.end()) {
      return error(ErrorCode::kUnsupported,
                   type.empty() ? "an object without a type of GeoJSON"
                                : fmt::format("objects of type '{}' are not read", shortened(type)))
          .where(at(path.empty() ? "/" : path));
    }
    const json* coordinates = member(value, "coordinates");
    if (coordinates == nullptr || !coordinates->is_array()) {
      return fail(malformed("a list 'coordinates' is expected", at(path + "/coordinates")));
    }
    if (found->second == 0) return position(*coordinates, points_, path + "/coordinates");
    return lines(*coordinates, found->second, type, path + "/coordinates");
  }

  Result<void> lines(const json& value, int depth, string_view type, const std::string& path) {
    if (!value.is_array()) return fail(malformed("a list of positions is expected", at(path)));
    if (value.empty()) {
      ++left_out_["lines without positions"];
      return {};
    }
    if (depth == 1) return line(value, type, path);
    for (std::size_t i = 0; i < value.size(); ++i) {
      OBVID_TRY(lines(value[i], depth - 1, type, fmt::format("{}/{}", path, i)));
    }
    return {};
  }

  Result<void> line(const json& value, string_view type, const std::string& path) {
    GeoSeries series{fmt::format("{} {}", type, all_.size() + 1), {}, {}};
    if (!title_.empty()) series.name += " " + title_;
    for (std::size_t i = 0; i < value.size(); ++i) {
      OBVID_TRY(position(value[i], series, path, i));
    }
    all_.push_back(std::move(series));
    return {};
  }

  Result<void> position(const json& value, GeoSeries& series, const std::string& path,
                        std::optional<std::size_t> index = std::nullopt) {
    const bool good = value.is_array() && value.size() >= 2 && value[0].is_number() &&
                      value[1].is_number() && std::isfinite(value[0].get<double>()) &&
                      std::isfinite(value[1].get<double>());
    if (!good) {
      return fail(malformed("a position of two numbers is expected",
                            at(index ? fmt::format("{}/{}", path, *index) : path)));
    }
    const double x = value[0].get<double>(), y = value[1].get<double>();
    if (std::abs(x) > 360.0 || std::abs(y) > 90.0) out_of_range_ = true;
    series.places.push_back({x, y});
    return {};
  }

  std::string name_, title_;
  std::vector<GeoSeries> all_;
  GeoSeries points_{"points", {}, {}, SeriesKind::kLoose};
  std::map<std::string, std::size_t> left_out_;
  bool out_of_range_ = false;
};

}  // namespace

Result<Drawing> parse_geojson(string_view text, string_view name) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  const auto root = parsed(text, name);
  OBVID_TRY(root);
  return GeoJsonReader(name).run(*root);
}

}  // namespace obvid
