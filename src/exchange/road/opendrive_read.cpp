// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "obvid/curve/internal/clothoid.h"
#include "obvid/curve/internal/contour_path.h"
#include "obvid/exchange/internal/road/opendrive.h"
#include "road/landxml_elements.h"
#include "road/profile_read.h"
#include "xml_text.h"

namespace obvid {
namespace {

using exchange::number_of;
using exchange::XmlFile;
using exchange::XmlWarnings;

/// Where an element starts, and how long it is.
struct Base {
  double s = 0.0, x = 0.0, y = 0.0, hdg = 0.0, length = 0.0;

  [[nodiscard]] Vec2 start() const { return {x, y}; }
};

/// Coefficients a + b p + c p^2 + d p^3.
using Cubic = std::array<double, 4>;

bool read_numbers(pugi::xml_node node, std::initializer_list<std::pair<const char*, double*>> all) {
  for (const auto& [name, value] : all) {
    const auto number = number_of(node.attribute(name).value());
    if (!number) return false;
    *value = *number;
  }
  return true;
}

bool has_finite_places(const Piece& piece) {
  const Jet middle = evaluate(piece, 0.5);
  const Vec2 end = end_point(piece);
  return std::isfinite(middle.point.x) && std::isfinite(middle.point.y) && std::isfinite(end.x) &&
         std::isfinite(end.y);
}

Piece spiral(const Base& base, double kappa0, double kappa1) {
  const Vec2 end = base.start() + clothoid_step(base.hdg, kappa0, kappa1, base.length);
  if (kappa0 == 0.0 && kappa1 == 0.0) return LinePiece{base.start(), end};
  if (kappa0 == kappa1) return ArcPiece{base.start(), end, base.hdg, kappa0, base.length};
  return ClothoidPiece{base.start(), end, base.hdg, kappa0, kappa1, base.length};
}

/// Polynomials u(p), v(p) over [0, range] in the frame of the element as a Bezier cubic.
Piece cubic_piece(const Base& base, Cubic u, Cubic v, double range) {
  double power = 1.0;
  for (std::size_t k = 0; k < u.size(); ++k, power *= range) {
    u[k] *= power;
    v[k] *= power;
  }
  const auto control = [](const Cubic& q) {
    return std::array<double, 4>{q[0], q[0] + q[1] / 3.0, q[0] + (2.0 * q[1] + q[2]) / 3.0,
                                 q[0] + q[1] + q[2] + q[3]};
  };
  const auto x = control(u), y = control(v);
  RationalBezier piece;
  piece.origin = base.start();
  piece.degree = 3;
  const Vec2 axis = unit_at(base.hdg);
  for (std::size_t k = 0; k < x.size(); ++k) {
    piece.offset[k] = complex_product(axis, {x[k], y[k]});
    piece.weight[k] = 1.0;
  }
  return piece;
}

/// Where v(u) = a + b u + c u^2 + d u^3 has the given length from u = 0, which is at least u.
double end_of_poly3(const Base& base, const Cubic& u, const Cubic& v) {
  const PieceLength along(cubic_piece(base, u, v, base.length), kFinestLength);
  return base.length * along.parameter(base.length);
}

class OpenDriveReader {
 public:
  explicit OpenDriveReader(const XmlFile& file) : file_(file), warnings_(file) {}

  Result<Drawing> run() {
    const pugi::xml_node offset =
        exchange::child_of(exchange::child_of(file_.root(), "header"), "offset");
    if (offset) warnings_.add("the offset of the header is not applied", offset);
    for (const pugi::xml_node node : file_.root().children()) {
      if (exchange::local_name(node) == "road") road(node);
    }
    drawing_.name = file_.name();
    drawing_.units = "m";
    drawing_.warnings = warnings_.take();
    drawing_.left_out = warnings_.left_out();
    if (drawing_.curves.empty()) {
      return error(ErrorCode::kNothingThere, "no road of the file has a reference line")
          .where(file_.name());
    }
    return std::move(drawing_);
  }

 private:
  void road(pugi::xml_node node) {
    const std::string id = shortened(node.attribute("id").value());
    const std::string name = shortened(node.attribute("name").value());
    const std::string label = name.empty() ? "road " + id : fmt::format("road {} {}", id, name);
    DrawnCurve curve;
    const std::size_t before = drawing_.curves.size();
    const auto finish = [&] {
      if (curve.pieces.empty()) return;
      const std::size_t part = drawing_.curves.size() - before + 1;
      curve.label = part == 1 ? label : fmt::format("{}, part {}", label, part);
      const std::string& own = name.empty() ? id : name;
      curve.name = part == 1 ? own : fmt::format("{}, part {}", own, part);
      curve.closed = exchange::closed_up(curve.pieces);
      drawing_.curves.push_back(std::exchange(curve, {}));
    };
    double station = -1.0;
    for (const pugi::xml_node child : exchange::child_of(node, "planView").children()) {
      if (exchange::local_name(child) != "geometry") continue;
      Base base;
      const auto piece = geometry(child, base);
      if (piece) {
        if (base.s <= station)
          warnings_.add("elements out of order of s are taken as they stand", child);
        station = base.s;
        if (curve.pieces.empty()) curve.station = base.s;
        curve.pieces.push_back(*piece);
      } else {
        finish();
      }
    }
    finish();
    for (const pugi::xml_node one : exchange::child_of(node, "lateralProfile").children()) {
      if (exchange::local_name(one) != "superelevation") continue;
      double a = 0.0, b = 0.0, c = 0.0, d = 0.0;
      const bool read = read_numbers(one, {{"a", &a}, {"b", &b}, {"c", &c}, {"d", &d}});
      if (!read || a != 0.0 || b != 0.0 || c != 0.0 || d != 0.0) {
        warnings_.add("superelevation is not used", one);
      }
    }
    if (drawing_.curves.size() == before) {
      warnings_.add("a road without geometry left out", node);
      return;
    }
    auto profile = exchange::opendrive_profile(node, warnings_);
    if (profile && drawing_.curves.size() - before > 1) {
      warnings_.add("the elevation profile of a road in several parts is not used", node);
    } else {
      drawing_.curves[before].profile = std::move(profile);
    }
  }

  /// The piece of one element; nothing, with a warning, where it is left out.
  std::optional<Piece> geometry(pugi::xml_node node, Base& base) {
    if (!read_numbers(node, {{"s", &base.s},
                             {"x", &base.x},
                             {"y", &base.y},
                             {"hdg", &base.hdg},
                             {"length", &base.length}})) {
      warnings_.leave_out("an element whose s, x, y, hdg or length is no number left out", node);
      return std::nullopt;
    }
    if (!(base.length > 0.0)) {
      warnings_.add("an element without length left out", node);
      return std::nullopt;
    }
    auto piece = shape(node, base);
    if (!piece) return std::nullopt;
    if (!has_finite_places(*piece) || start_point(*piece) == end_point(*piece)) {
      warnings_.leave_out("an element that comes to no point or goes nowhere left out", node);
      return std::nullopt;
    }
    return piece;
  }

  std::optional<Piece> shape(pugi::xml_node node, const Base& base) {
    for (const pugi::xml_node child : node.children()) {
      const auto kind = exchange::local_name(child);
      double k0 = 0.0, k1 = 0.0;
      if (kind == "line") return spiral(base, 0.0, 0.0);
      if (kind == "arc" && read_numbers(child, {{"curvature", &k0}})) return spiral(base, k0, k0);
      if (kind == "spiral" && read_numbers(child, {{"curvStart", &k0}, {"curvEnd", &k1}})) {
        return spiral(base, k0, k1);
      }
      Cubic u{}, v{};
      if (kind == "poly3" &&
          read_numbers(child, {{"a", &v[0]}, {"b", &v[1]}, {"c", &v[2]}, {"d", &v[3]}})) {
        u[1] = 1.0;
        return cubic_piece(base, u, v, end_of_poly3(base, u, v));
      }
      if (kind == "paramPoly3" && read_numbers(child, {{"aU", &u[0]},
                                                       {"bU", &u[1]},
                                                       {"cU", &u[2]},
                                                       {"dU", &u[3]},
                                                       {"aV", &v[0]},
                                                       {"bV", &v[1]},
                                                       {"cV", &v[2]},
                                                       {"dV", &v[3]}})) {
        return cubic_piece(base, u, v, range_of(child, base));
      }
    }
    warnings_.leave_out(
        "an element without line, arc, spiral, poly3 or paramPoly3 that can be read left out",
        node);
    return std::nullopt;
  }

  double range_of(pugi::xml_node node, const Base& base) {
    const std::string_view range = node.attribute("pRange").value();
    if (range != "arcLength" && range != "normalized") {
      warnings_.add("a paramPoly3 without pRange is taken as normalized", node);
    }
    return range == "arcLength" ? base.length : 1.0;
  }

  const XmlFile& file_;
  XmlWarnings warnings_;
  Drawing drawing_;
};

}  // namespace

Result<Drawing> parse_opendrive(std::string_view text, std::string_view name) {
  XmlFile file(text, name);
  OBVID_TRY(file.parse("OpenDRIVE"));
  return OpenDriveReader(file).run();
}

}  // namespace obvid
