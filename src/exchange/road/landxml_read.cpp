// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>
#include <vector>

#include "geo/projection_series.h"
#include "obvid/exchange/internal/road/landxml.h"
#include "road/landxml_elements.h"
#include "road/landxml_units.h"
#include "road/profile_read.h"
#include "xml_text.h"

namespace obvid {
namespace {

using exchange::child_of;
using exchange::local_name;
using exchange::number_of;
using exchange::PlacedPiece;
using exchange::XmlFile;
using exchange::XmlWarnings;
using std::string_view;

// Ends that differ by more from what is stated, as part of the length, are worth a warning.
constexpr double kMisplacedEnd = 1e-6;

// Of the length of a transition: how near the clothoids that stand for it keep to it.
constexpr double kNearTransition = 1e-7;

// Fields of one point of a list.
constexpr std::size_t kMostCoordinates = 3;

/// The next node in the order of the file, without recursion.
pugi::xml_node next_of(pugi::xml_node node, pugi::xml_node top) {
  if (node.first_child()) return node.first_child();
  while (node != top && !node.next_sibling()) node = node.parent();
  return node == top ? pugi::xml_node{} : node.next_sibling();
}

/// Northing and easting, with or without height.
std::optional<Vec2> point_of(string_view text) {
  const auto numbers = exchange::numbers_of(text, kMostCoordinates);
  if (!numbers || numbers->size() < 2) return std::nullopt;
  return Vec2{(*numbers)[1], (*numbers)[0]};
}

class LandXmlReader {
 public:
  explicit LandXmlReader(const XmlFile& file) : file_(file), warnings_(file) {}

  Result<Drawing> run() {
    drawing_.name = file_.name();
    drawing_.units = units();
    std::vector<pugi::xml_node> geometries;
    for (pugi::xml_node node = file_.root(); node; node = next_of(node, file_.root())) {
      if (local_name(node) == "CoordGeom") geometries.push_back(node);
      if (local_name(node) == "CgPoint") named_.try_emplace(node.attribute("name").value(), node);
    }
    for (const pugi::xml_node node : geometries) geometry(node);
    drawing_.warnings = warnings_.take();
    drawing_.left_out = warnings_.left_out();
    if (off_end_ > 0.0) {
      drawing_.warnings.push_back(
          fmt::format("curves and spirals end up to {:.2g} {} from their stated ends", off_end_,
                      drawing_.units.text()));
    }
    if (drawing_.curves.empty()) {
      const std::vector<std::string>& told = drawing_.warnings;
      return error(ErrorCode::kNothingThere,
                   "the file has no CoordGeom with a curve that can be read")
          .where(file_.name())
          .hint(told.empty() ? "" : "it has " + told.front());
    }
    return std::move(drawing_);
  }

 private:
  Units units() {
    const pugi::xml_node all = child_of(file_.root(), "Units");
    const pugi::xml_node metric = child_of(all, "Metric");
    const pugi::xml_node one = metric ? metric : child_of(all, "Imperial");
    const string_view name = one.attribute("linearUnit").value();
    for (const exchange::LandXmlUnit& unit : exchange::kLandXmlUnits) {
      if (name == unit.theirs) return std::string(unit.name);
    }
    warnings_.add("the file names no unit of length that is known; metres are assumed",
                  file_.root());
    return Units("m", UnitSource::kAssumed);
  }

  void geometry(pugi::xml_node node) {
    const pugi::xml_node owner = node.parent();
    const std::string name = shortened(owner.attribute("name").value());
    label_ = fmt::format("{} {}", shortened(local_name(owner)), name);
    name_ = name;
    part_ = 0;
    const std::size_t first_curve = drawing_.curves.size();
    station_.reset();  // parcels and plan features have none
    if (local_name(owner) == "Alignment") {
      station_ = number_of(owner.attribute("staStart").value()).value_or(0.0);
    }
    for (const pugi::xml_node child : node.children()) {
      if (child.type() != pugi::node_element) continue;
      if (curve_.pieces.empty()) curve_.station = station_;
      element(child);
    }
    finish();
    if (local_name(owner) != "Alignment") return;
    for (const pugi::xml_node equation : owner.children()) {
      if (local_name(equation) != "StaEquation") continue;
      warnings_.add(fmt::format("a station equation (behind {} comes {}) is not used: stations go "
                                "on, and it is not written",
                                shortened(equation.attribute("staBack").value()),
                                shortened(equation.attribute("staAhead").value())),
                    equation);
    }
    if (child_of(owner, "Cant")) warnings_.add("cant is not used", child_of(owner, "Cant"));
    auto profile = exchange::landxml_profile(owner, warnings_);
    if (!profile || first_curve == drawing_.curves.size()) return;
    DrawnCurve& first = drawing_.curves[first_curve];
    if (drawing_.curves.size() - first_curve > 1) {
      warnings_.add("the profile of an alignment in several parts is not used", owner);
    } else if (!first.station) {
      warnings_.add("the profile of an alignment whose station is not known is not used", owner);
    } else {
      first.profile = std::move(profile);
    }
  }

  void finish() {
    last_name_.clear();
    if (curve_.pieces.empty()) return;
    ++part_;
    curve_.label = part_ == 1 ? label_ : fmt::format("{}, part {}", label_, part_);
    curve_.name = part_ == 1 ? name_ : fmt::format("{}, part {}", name_, part_);
    curve_.closed = exchange::closed_up(curve_.pieces);
    drawing_.curves.push_back(std::exchange(curve_, {}));
  }

  void leave_out(const std::string& what, pugi::xml_node node,
                 std::optional<double> length = std::nullopt) {
    warnings_.leave_out(what + " left out", node);
    finish();
    if (!length) length = number_of(node.attribute("length").value());
    if (station_ && length) {
      *station_ += *length;
    } else {
      station_.reset();
    }
  }

  /// A piece of the curve that is read.
  void add(const Piece& piece, const std::string& name = {}) {
    if (station_) *station_ += arc_length(piece, 1.0);
    // parts of an element that this program had to cut have one name
    const auto whole = !name.empty() && name == last_name_ && !curve_.pieces.empty()
                           ? exchange::joined(curve_.pieces.back(), piece)
                           : std::nullopt;
    last_name_ = name;
    if (whole) {
      curve_.pieces.back() = *whole;
    } else {
      curve_.pieces.push_back(piece);
    }
  }

  /// A transition of another law: clothoids in its place, and what they stand for.
  void add(const ClothoidPiece& ends, Transition law, pugi::xml_node node) {
    auto pieces = clothoids_along(law, {ends.start, ends.theta0, ends.kappa0}, ends.kappa1,
                                  ends.length, kNearTransition * ends.length);
    if (!pieces) return leave_out("a Spiral along which " + pieces.error().what + ",", node);
    pieces->back().end = ends.end;
    curve_.transitions.push_back(
        {curve_.pieces.size(), pieces->size(), law, ends.kappa0, ends.kappa1, ends.length});
    curve_.pieces.insert(curve_.pieces.end(), pieces->begin(), pieces->end());
    if (station_) *station_ += ends.length;
    last_name_.clear();
  }

  void element(pugi::xml_node node) {
    const string_view kind = local_name(node);
    if (kind == "Feature") return;
    if (kind == "Line") return line(node);
    if (kind == "Curve") return curve(node);
    if (kind == "Spiral") return spiral(node);
    if (kind == "IrregularLine") return irregular(node);
    leave_out(fmt::format("an element '{}'", shortened(kind)), node);
  }

  /// Coordinates of a child, or of the point that it refers to.
  std::optional<Vec2> point(pugi::xml_node node, const char* kind) {
    const pugi::xml_node child = child_of(node, kind);
    if (const auto reference = child.attribute("pntRef")) {
      const auto found = named_.find(reference.value());
      return found == named_.end() ? std::nullopt : point_of(found->second.child_value());
    }
    return point_of(child.child_value());
  }

  void line(pugi::xml_node node) {
    const auto start = point(node, "Start"), end = point(node, "End");
    if (!start || !end) return leave_out("a Line without readable start and end", node);
    if (*start == *end) return leave_out("a Line of no length", node, 0.0);
    add(LinePiece{*start, *end});
  }

  /// The sense of rotation; without one it cannot be drawn.
  std::optional<bool> is_left(pugi::xml_node node) {
    const string_view rotation = node.attribute("rot").value();
    if (rotation == "ccw") return true;
    if (rotation == "cw") return false;
    return std::nullopt;
  }

  void add(const std::optional<PlacedPiece>& placed, const std::string& why, double length,
           pugi::xml_node node, Transition law = Transition::kClothoid) {
    if (!placed) return leave_out(why, node);
    if (!placed->doubt.empty()) warnings_.add(placed->doubt, node);
    if (placed->off_end > kMisplacedEnd * length) off_end_ = std::max(off_end_, placed->off_end);
    const auto* clothoid = std::get_if<ClothoidPiece>(&placed->piece);
    if (law != Transition::kClothoid && clothoid != nullptr) return add(*clothoid, law, node);
    add(placed->piece, node.attribute("name").value());
  }

  void curve(pugi::xml_node node) {
    const auto start = point(node, "Start"), end = point(node, "End");
    const auto left = is_left(node);
    if (!start || !end || !left) {
      return leave_out("a Curve without readable start, end and rotation", node);
    }
    exchange::StatedCurve stated{*start, *end, point(node, "Center"), std::nullopt, *left};
    if (const auto radius = node.attribute("radius")) {
      stated.radius = number_of(radius.value());
      if (!stated.radius) return leave_out("a Curve whose radius is no number", node);
    }
    std::string why;
    const auto placed = exchange::placed(stated, why);
    add(placed, why, placed ? arc_length(placed->piece, 0.0) : 0.0, node);
  }

  /// Curvature of a stated radius, INF for none; nothing for what is no radius.
  static std::optional<double> curvature_of(string_view radius) {
    radius = exchange::trimmed(radius);
    if (radius == "INF" || radius == "inf" || radius == "Infinity") return 0.0;
    const auto number = number_of(radius);
    if (!number || !(*number > 0.0)) return std::nullopt;
    return 1.0 / *number;
  }

  void spiral(pugi::xml_node node) {
    const string_view kind = node.attribute("spiType").value();
    const auto law =
        std::find(exchange::kLandXmlSpirals.begin(), exchange::kLandXmlSpirals.end(), kind);
    if (law == exchange::kLandXmlSpirals.end()) {
      return leave_out(fmt::format("a Spiral of type '{}'", shortened(kind)), node);
    }
    const auto start = point(node, "Start"), end = point(node, "End");
    const auto left = is_left(node);
    const auto kappa0 = curvature_of(node.attribute("radiusStart").value());
    const auto kappa1 = curvature_of(node.attribute("radiusEnd").value());
    const auto length = number_of(node.attribute("length").value());
    if (!start || !end || !left || !length) {
      return leave_out("a Spiral without readable start, end, length and rotation", node);
    }
    if (!kappa0 || !kappa1) return leave_out("a Spiral whose radii are not INF or > 0", node);
    std::string why;
    const auto transition = static_cast<Transition>(law - exchange::kLandXmlSpirals.begin());
    const auto placed =
        exchange::placed(exchange::StatedSpiral{*start, *end, point(node, "PI"), *kappa0, *kappa1,
                                                *length, *left, transition},
                         why);
    add(placed, why, *length, node, transition);
  }

  /// Start, a list of points, end.
  void irregular(pugi::xml_node node) {
    const pugi::xml_node flat = child_of(node, "PntList2D"), high = child_of(node, "PntList3D");
    const std::size_t stride = flat ? 2 : 3;
    const string_view text = (flat ? flat : high).child_value();
    const auto numbers = exchange::numbers_of(text, text.size());
    if (!numbers || numbers->size() % stride != 0) {
      return leave_out("an IrregularLine whose list of points cannot be read", node);
    }
    std::vector<Vec2> points;
    if (const auto start = point(node, "Start")) points.push_back(*start);
    for (std::size_t i = 0; i < numbers->size(); i += stride) {
      points.push_back({(*numbers)[i + 1], (*numbers)[i]});
    }
    if (const auto end = point(node, "End")) points.push_back(*end);
    PointSeries series =
        exchange::plane_series(fmt::format("IrregularLine of {}", label_), drawing_.units, points);
    if (series.points.size() < 2) return leave_out("an IrregularLine of no length", node, 0.0);
    for (std::size_t i = 1; i < series.points.size(); ++i) {
      add(LinePiece{series.points[i - 1], series.points[i]});
    }
    series.warnings.clear();  // start and end stand in the list too, usually
    drawing_.series.push_back(std::move(series));
  }

  const XmlFile& file_;
  XmlWarnings warnings_;
  std::unordered_map<std::string, pugi::xml_node> named_;  ///< CgPoints
  Drawing drawing_;
  DrawnCurve curve_;               ///< in the making
  std::string label_;              ///< of the CoordGeom
  std::string name_;               ///< of the alignment or whatever has it
  std::string last_name_;          ///< of the last element that was taken
  std::optional<double> station_;  ///< of the next element; unknown behind one without a length
  std::size_t part_ = 0;
  double off_end_ = 0.0;
};

}  // namespace

Result<Drawing> parse_landxml(string_view text, string_view name) {
  XmlFile file(text, name);
  OBVID_TRY(file.parse("LandXML"));
  return LandXmlReader(file).run();
}

}  // namespace obvid
