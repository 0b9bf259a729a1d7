// SPDX-License-Identifier: Apache-2.0
#include "obvid/io/space_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "contour_json_names.h"
#include "contour_json_values.h"
#include "obvid/io/contour_json.h"
#include "text_lines.h"

namespace obvid {
namespace {

constexpr std::string_view kSpaceFormat = "obvid-space-curve";
constexpr std::string_view kChainFormat = "obvid-space-chain";
constexpr std::size_t kPlacesOfFormat = 4096;  // bytes within which a file names its format

class SpaceReader : private JsonValues {
 public:
  SpaceReader(std::string_view name, Watch* watch) : JsonValues(name, watch), file_(name) {}

  Result<StoredSpace> read(const nlohmann::json& document) {
    const Node root{&document, nullptr, {}, 0};
    head(root);
    frame(root);
    each(field(root, "points"), [&](const Node& one) { out_.points.push_back(vector(one)); });
    if (!failed() && out_.points.size() < 2) refuse(root, "a curve needs at least two points");
    if (planar_) {
      out_.plan = contour(root, "contour");
    } else {
      out_.plan = contour(root, "projection");
      out_.heights = contour(root, "heights");
      figures(root);
      if (!failed() && out_.plan.contour.closed) seam(field(root, "seam"));
    }
    curve(root);
    if (error_) return fail(std::move(*error_));
    for (std::string& one : unread_fields(document)) {
      if (!is_of_contour(one)) out_.unread.push_back(std::move(one));
    }
    if (has_ended(watch_)) return fail(cancelled_error());
    if (auto good = check(out_.curve); !good) {
      Error error = good.error();
      error.code = ErrorCode::kBadJson;
      error.where = file_ + ": /curve";
      return fail(std::move(error));
    }
    return std::move(out_);
  }

 private:
  void head(const Node& root) {
    const Node format = field(root, "format");
    if (!failed() && word(format) != kSpaceFormat) refuse(format, "this is no curve in space");
    const Node version = field(root, "version");
    if (!failed() && integer(version, 1, kMaxInteger) != 1) {
      refuse(version, ErrorCode::kUnsupported, "this version of the format is not known");
    }
    if (const auto name = optional_field(root, "name")) out_.name = word(*name);
    out_.units.name = word(field(root, "units"));
    unit_source(root, out_.units);
    planar_ = flag(field(root, "planar"));
    out_.flatness = number(field(root, "flatness"));
    out_.largest_move = number(field(root, "largest_move"));
  }

  void frame(const Node& root) {
    const Node node = field(root, "frame");
    out_.frame.origin = vector(field(node, "origin"));
    out_.frame.x = vector(field(node, "x"));
    out_.frame.y = vector(field(node, "y"));
    out_.normal = vector(field(node, "normal"));
  }

  void figures(const Node& root) {
    SpaceFigures& f = out_.figures;
    f.least_curvature = number(field(root, "least_curvature"));
    f.largest_curvature = number(field(root, "largest_curvature"));
    const Node places = field(root, "torsion_places");
    if (!failed()) f.torsion_places = static_cast<std::size_t>(integer(places, 0, kMaxInteger));
    f.least_torsion = number(field(root, "least_torsion"));
    f.largest_torsion = number(field(root, "largest_torsion"));
    f.torsion_step = number(field(root, "torsion_step"));
  }

  void seam(const Node& node) {
    SpaceSeam one;
    one.position = number(field(node, "position"));
    one.heading = number(field(node, "heading"));
    one.curvature = number(field(node, "curvature"));
    out_.seam = one;
  }

  void curve(const Node& root) {
    const Node node = field(root, "curve");
    const Node degree = field(node, "degree");
    if (!failed()) out_.curve.degree = static_cast<int>(integer(degree, 1, kMaxNurbsDegree));
    out_.deviation = number(field(node, "deviation"));
    each(field(node, "knots"), [&](const Node& one) { out_.curve.knots.push_back(number(one)); });
    each(field(node, "points"), [&](const Node& one) { out_.curve.points.push_back(vector(one)); });
    each(field(node, "weights"),
         [&](const Node& one) { out_.curve.weights.push_back(number(one)); });
  }

  Vec3 vector(const Node& node) {
    std::vector<double> values;
    each(node, [&](const Node& one) { values.push_back(number(one)); });
    if (!failed() && values.size() != 3) refuse(node, "a point has three coordinates");
    return failed() ? Vec3{} : Vec3{values[0], values[1], values[2]};
  }

  /// Contours are whole files.
  StoredContour contour(const Node& root, std::string_view key) {
    const Node node = field(root, key);
    if (failed()) return {};
    auto stored = contour_from_json(node.value->dump(), fmt::format("{}: /{}", file_, key), watch_);
    if (!stored) {
      error_ = stored.error();
      return {};
    }
    return std::move(*stored);
  }

  static bool is_of_contour(const std::string& path) {
    return std::any_of(kParts.begin(), kParts.end(), [&](std::string_view part) {
      return path == part || path.starts_with(std::string(part) + "/");
    });
  }

  static constexpr std::array<std::string_view, 3> kParts = {"/contour", "/projection", "/heights"};

  std::string file_;
  StoredSpace out_;
  bool planar_ = false;
};

class SpaceChainReader : private JsonValues {
 public:
  SpaceChainReader(std::string_view name, Watch* watch) : JsonValues(name, watch), file_(name) {}

  Result<StoredSpaceChain> read(const nlohmann::json& document) {
    const Node root{&document, nullptr, {}, 0};
    (void)word(field(root, "format"));
    const Node version = field(root, "version");
    if (!failed() && integer(version, 1, kMaxInteger) != 1) {
      refuse(version, ErrorCode::kUnsupported, "this version of the format is not known");
    }
    if (const auto name = optional_field(root, "name")) out_.name = word(*name);
    out_.units.name = word(field(root, "units"));
    unit_source(root, out_.units);
    out_.closed = flag(field(root, "closed"));
    out_.largest_move = number(field(root, "largest_move"));
    each(field(root, "points"), [&](const Node& one) { out_.points.push_back(place(one)); });
    each(field(root, "corners"), [&](const Node& one) { corner(one); });
    const Node parts = field(root, "parts");
    each(parts, [&](const Node& one) { part(one); });
    const std::size_t wanted = out_.corners.size() + (out_.closed ? 0 : 1);
    if (!failed() && (out_.corners.empty() || out_.parts.size() != wanted)) {
      refuse(parts, fmt::format("these corners join {} curves, not {}", wanted, out_.parts.size()));
    }
    if (error_) return fail(std::move(*error_));
    for (std::string& one : unread_fields(document)) {
      if (one != "/parts" && !one.starts_with("/parts/")) out_.unread.push_back(std::move(one));
    }
    if (has_ended(watch_)) return fail(cancelled_error());
    return std::move(out_);
  }

 private:
  void corner(const Node& node) {
    const std::size_t first = out_.closed ? 0 : 1, count = out_.points.size();
    const Node point = field(node, "point");
    if (failed()) return;
    SpaceCorner one;
    one.point = static_cast<std::size_t>(integer(point, 0, kMaxInteger));
    one.turn = number(field(node, "turn"));
    const std::size_t least = out_.corners.empty() ? first : out_.corners.back().point + 1;
    if (!failed() && (one.point < least || one.point + first >= count)) {
      refuse(point, "corners are inner points of the chain, in order");
    }
    out_.corners.push_back(one);
  }

  void part(const Node& node) {
    if (failed()) return;
    auto stored = SpaceReader(fmt::format("{}: /parts/{}", file_, out_.parts.size()), watch_)
                      .read(*node.value);
    if (!stored) {
      error_ = stored.error();
      return;
    }
    out_.parts.push_back(std::move(*stored));
  }

  Vec3 place(const Node& node) {
    std::vector<double> values;
    each(node, [&](const Node& one) { values.push_back(number(one)); });
    if (!failed() && values.size() != 3) refuse(node, "a point has three coordinates");
    return failed() ? Vec3{} : Vec3{values[0], values[1], values[2]};
  }

  std::string file_;
  StoredSpaceChain out_;
};

}  // namespace

std::vector<std::size_t> points_of_part(const std::vector<SpaceCorner>& corners, bool closed,
                                        std::size_t count, std::size_t k) {
  std::size_t from = 0, to = 0;
  if (closed) {
    from = corners[k].point;
    to = k + 1 < corners.size() ? corners[k + 1].point : corners.front().point + count;
  } else {
    from = k > 0 ? corners[k - 1].point : 0;
    to = k < corners.size() ? corners[k].point : count - 1;
  }
  std::vector<std::size_t> out;
  for (std::size_t i = from; i <= to; ++i) out.push_back(i % count);
  return out;
}

bool is_space_json(std::string_view text) {
  const std::string_view head = text.substr(0, kPlacesOfFormat);
  const std::size_t begin = head.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  return begin != std::string_view::npos && head[begin] == '{' &&
         (head.find(fmt::format("\"{}\"", kSpaceFormat)) != std::string_view::npos ||
          head.find(fmt::format("\"{}\"", kChainFormat)) != std::string_view::npos);
}

Result<StoredSpace> space_from_json(std::string_view text, std::string_view name, Watch* watch) {
  const auto document = parse_json(text, name, watch);
  OBVID_TRY(document);
  return SpaceReader(name, watch).read(*document);
}

Result<StoredSpaceChain> space_chain_from_json(std::string_view text, std::string_view name,
                                               Watch* watch) {
  const auto document = parse_json(text, name, watch);
  OBVID_TRY(document);
  const auto format = document->is_object() ? document->find("format") : document->end();
  if (format != document->end() && *format == kChainFormat) {
    return SpaceChainReader(name, watch).read(*document);
  }
  auto one = SpaceReader(name, watch).read(*document);
  OBVID_TRY(one);
  StoredSpaceChain out;
  out.name = one->name;
  out.units = one->units;
  out.largest_move = one->largest_move;
  out.points = one->points;
  out.parts.push_back(std::move(*one));
  return out;
}

}  // namespace obvid
