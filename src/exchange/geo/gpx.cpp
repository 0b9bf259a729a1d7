// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/geo/gpx.h"

#include <fmt/format.h>

#include <utility>

#include "geo/projection_series.h"
#include "xml_text.h"

namespace obvid {
namespace {

using exchange::attribute_of;
using exchange::GeoSeries;
using exchange::local_name;
using exchange::number_of;
using exchange::XmlFile;
using exchange::XmlWarnings;

class GpxReader {
 public:
  explicit GpxReader(const XmlFile& file) : file_(file), warnings_(file) {}

  Result<Drawing> run() {
    GeoSeries waypoints{"waypoints", {}, {}, SeriesKind::kWaypoints};
    for (const pugi::xml_node node : file_.root().children()) {
      const auto kind = local_name(node);
      if (kind == "trk") track(node);
      if (kind == "rte") {
        add(title(node, "route", ++routes_), node, "rtept", SeriesKind::kRoute);
      }
      if (kind == "wpt") place(node, waypoints);
    }
    waypoints.heights.clear();
    if (!waypoints.places.empty()) all_.push_back(std::move(waypoints));
    Drawing out;
    out.name = file_.name();
    out.warnings = warnings_.take();
    OBVID_TRY(exchange::project_series(std::move(all_), file_.name(), out));
    return out;
  }

 private:
  static std::string title(pugi::xml_node node, const char* kind, int number) {
    const std::string_view name = exchange::trimmed(exchange::child_of(node, "name").child_value());
    return name.empty() ? fmt::format("{} {}", kind, number)
                        : fmt::format("{} {}", kind, shortened(name));
  }

  void track(pugi::xml_node node) {
    const std::string name = title(node, "track", ++tracks_);
    int segment = 0;
    for (const pugi::xml_node child : node.children()) {
      if (local_name(child) != "trkseg") continue;
      ++segment;
      add(segment == 1 ? name : fmt::format("{}, segment {}", name, segment), child, "trkpt",
          SeriesKind::kLine);
    }
  }

  void add(std::string name, pugi::xml_node node, std::string_view kind, SeriesKind what) {
    GeoSeries series{std::move(name), {}, {}, what};
    for (const pugi::xml_node child : node.children()) {
      if (local_name(child) == kind) place(child, series);
    }
    drop_some_heights(series, node);
    if (series.places.empty()) {
      warnings_.add("a track segment or route without points left out", node);
    } else {
      all_.push_back(std::move(series));
    }
  }

  void place(pugi::xml_node node, GeoSeries& series) {
    const auto latitude = number_of(attribute_of(node, "lat").value());
    const auto longitude = number_of(attribute_of(node, "lon").value());
    const bool good = latitude && longitude && *latitude >= -90.0 && *latitude <= 90.0 &&
                      *longitude >= -180.0 && *longitude < 360.0;
    if (!good) {
      warnings_.add("a point without a latitude in [-90, 90] and a longitude left out", node);
      return;
    }
    series.places.push_back({*longitude, *latitude});
    const auto height = number_of(exchange::trimmed(exchange::child_of(node, "ele").child_value()));
    if (height) series.heights.push_back(*height);
  }

  /// Heights of some places alone make no profile.
  void drop_some_heights(GeoSeries& series, pugi::xml_node node) {
    if (series.heights.size() == series.places.size()) return;
    if (!series.heights.empty()) {
      warnings_.add("a track segment or route some places of which have no height: none is used",
                    node);
    }
    series.heights.clear();
  }

  const XmlFile& file_;
  XmlWarnings warnings_;
  std::vector<GeoSeries> all_;
  int tracks_ = 0, routes_ = 0;
};

}  // namespace

Result<Drawing> parse_gpx(std::string_view text, std::string_view name) {
  XmlFile file(text, name);
  OBVID_TRY(file.parse("gpx"));
  return GpxReader(file).run();
}

}  // namespace obvid
