// SPDX-License-Identifier: Apache-2.0
// The entities of a DXF drawing that contours are written as.
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "drawing.h"

namespace judge {
namespace {

struct Tag {
  int code = 0;
  std::string value;

  [[nodiscard]] Real real() const { return std::strtold(value.c_str(), nullptr); }
};

std::vector<Tag> tags_of(const std::string& text) {
  std::vector<Tag> out;
  std::istringstream lines(text);
  std::string code, value;
  while (std::getline(lines, code) && std::getline(lines, value)) {
    if (!value.empty() && value.back() == '\r') value.pop_back();
    const std::size_t from = value.find_first_not_of(' ');
    out.push_back({std::atoi(code.c_str()), from == std::string::npos ? "" : value.substr(from)});
  }
  return out;
}

class DxfReader {
 public:
  DxfReader(Point origin, const std::string& unit, bool sheet)
      : origin_(origin), unit_(unit), sheet_(sheet) {}

  using Tags = std::vector<Tag>;

  Drawing run(const std::string& text) {
    const std::vector<Tag> tags = tags_of(text);
    read_unit(tags);
    bool inside = false;
    for (std::size_t i = 0; i < tags.size();) {
      std::size_t end = i + 1;
      while (end < tags.size() && tags[end].code != 0) ++end;
      if (tags[i].value == "SECTION")
        inside = i + 1 < tags.size() && tags[i + 1].value == "ENTITIES";
      if (tags[i].value == "ENDSEC") inside = false;
      if (inside && tags[i].value != "SECTION") {
        const Tags own{tags.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                       tags.begin() + static_cast<std::ptrdiff_t>(end)};
        if (!mark(tags[i].value, own)) entity(tags[i].value, own);
        out_.owners.resize(out_.spans.size(), {word(own, 8), i});
      }
      i = end;
    }
    if (out_.spans.empty()) out_.fault = "no curve found";
    return std::move(out_);
  }

 private:
  void read_unit(const std::vector<Tag>& tags) {
    static const std::map<int, double> kUnits = {
        {1, 0.0254}, {2, 0.3048}, {3, 1609.344},        {4, 1e-3},    {5, 1e-2},
        {6, 1.0},    {7, 1e3},    {9, 2.54e-5},         {10, 0.9144}, {12, 1e-9},
        {13, 1e-6},  {14, 0.1},   {21, 1200.0 / 3937.0}};
    for (std::size_t i = 0; i + 1 < tags.size(); ++i) {
      if (tags[i].value != "$INSUNITS") continue;
      const auto found = kUnits.find(std::atoi(tags[i + 1].value.c_str()));
      if (found != kUnits.end()) out_.metres = found->second;
    }
    const auto mine = metres_of(unit_);
    if (out_.metres && mine) scale_ = *out_.metres / *mine;
  }

  static Real value(const Tags& tags, int code, Real otherwise) {
    for (const Tag& tag : tags) {
      if (tag.code == code) return tag.real();
    }
    return otherwise;
  }
  static std::vector<Real> values(const Tags& tags, int code) {
    std::vector<Real> out;
    for (const Tag& tag : tags) {
      if (tag.code == code) out.push_back(tag.real());
    }
    return out;
  }
  [[nodiscard]] Vec point(Real x, Real y) const {
    return {x * scale_ - origin_.x, y * scale_ - origin_.y};
  }
  [[nodiscard]] Vec point(const Tags& tags, int x, int y) const {
    return point(value(tags, x, 0.0L), value(tags, y, 0.0L));
  }

  static std::string word(const Tags& tags, int code) {
    for (const Tag& tag : tags) {
      if (tag.code == code) return tag.value;
    }
    return "";
  }

  bool mark(const std::string& name, const Tags& tags) {
    const bool text = name == "TEXT";
    if (!sheet_ || (!text && name != "POINT")) return false;
    out_.marks.push_back({word(tags, 8), text ? word(tags, 1) : "", point(tags, 10, 20)});
    return true;
  }

  void entity(const std::string& name, const Tags& tags) {
    if (name == "LINE") return line(point(tags, 10, 20), point(tags, 11, 21));
    if (name == "ARC" || name == "CIRCLE") return arc(tags, name == "CIRCLE");
    if (name == "LWPOLYLINE") return polyline(tags);
    if (name == "SPLINE") return spline(tags);
    if (name == "ELLIPSE") return ellipse(tags);
    throw std::runtime_error("entity " + name + " is not known");
  }

  void line(Vec a, Vec b) {
    const Vec chord = b - a;
    out_.spans.emplace_back(a, std::atan2(chord.y, chord.x), 0.0L, norm(chord));
  }

  static constexpr Real kFull = 2.0L * std::numbers::pi_v<Real>;

  void arc(const Tags& tags, bool whole) {
    const Real from = whole ? 0.0L : value(tags, 50, 0.0L) * kDegree;
    Real turn = whole ? kFull : value(tags, 51, 360.0L) * kDegree - from;
    while (turn <= 0.0L) turn += kFull;
    out_.spans.push_back(arc_span(point(tags, 10, 20), value(tags, 40, 0.0L) * scale_, from, turn));
  }

  void bulge_arc(Vec a, Vec b, Real bulge) {
    if (bulge == 0.0L) return line(a, b);
    const Vec chord = b - a;
    const Real turn = 4.0L * std::atan(bulge), h = norm(chord);
    const Real kappa = 2.0L * std::sin(0.5L * turn) / h;
    out_.spans.emplace_back(a, std::atan2(chord.y, chord.x) - 0.5L * turn, kappa, turn / kappa);
  }

  void polyline(const Tags& tags) {
    std::vector<Vec> points;
    std::vector<Real> bulges;
    Real x = 0.0L;
    for (const Tag& tag : tags) {
      if (tag.code == 10) x = tag.real();
      if (tag.code == 20) {
        points.push_back(point(x, tag.real()));
        bulges.push_back(0.0L);
      }
      if (tag.code == 42 && !bulges.empty()) bulges.back() = tag.real();
    }
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      bulge_arc(points[i], points[i + 1], bulges[i]);
    }
    const bool closed = (static_cast<int>(value(tags, 70, 0.0L)) & 1) != 0;
    if (closed && points.size() > 1) bulge_arc(points.back(), points.front(), bulges.back());
  }

  void spline(const Tags& tags) {
    const std::vector<Real> x = values(tags, 10), y = values(tags, 20);
    std::vector<Real> weights = values(tags, 41);
    if (x.size() != y.size()) throw std::runtime_error("spline with unequal lists");
    if (weights.empty()) weights.assign(x.size(), 1.0L);
    std::vector<Vec> points;
    for (std::size_t i = 0; i < x.size(); ++i) points.push_back(point(x[i], y[i]));
    for (Span& span : spans_of_nurbs(static_cast<int>(value(tags, 71, 0.0L)), values(tags, 40),
                                     points, weights)) {
      out_.spans.push_back(std::move(span));
    }
  }

  /// Exact as rational quadratics, one per quarter at the most.
  void ellipse(const Tags& tags) {
    const Vec centre = point(tags, 10, 20);
    const Vec major = scale_ * Vec{value(tags, 11, 0.0L), value(tags, 21, 0.0L)};
    const Real side = value(tags, 230, 1.0L) < 0.0L ? -1.0L : 1.0L;
    const Vec minor = (side * value(tags, 40, 1.0L)) * left_of(major);
    const Real from = value(tags, 41, 0.0L);
    Real turn = value(tags, 42, kFull) - from;
    while (turn <= 0.0L) turn += kFull;
    const auto count = static_cast<int>(std::ceil(turn / (0.25L * kFull)));
    for (int i = 0; i < count; ++i) {
      const Real a = from + turn * i / count, b = from + turn * (i + 1) / count;
      const Real m = 0.5L * (a + b), w = std::cos(0.5L * (b - a));
      const auto at = [&](Real u) { return std::cos(u) * major + std::sin(u) * minor; };
      out_.spans.emplace_back(
          std::vector<Vec>{centre + at(a), centre + (1.0L / w) * at(m), centre + at(b)},
          std::vector<Real>{1.0L, w, 1.0L});
    }
  }

  Point origin_;
  std::string unit_;
  bool sheet_;
  Real scale_ = 1.0L;
  Drawing out_;
};

Drawing read(const std::string& text, Point origin, const std::string& unit, bool sheet) {
  try {
    return DxfReader(origin, unit, sheet).run(text);
  } catch (const std::exception& error) {
    Drawing out;
    out.fault = error.what();
    return out;
  }
}

}  // namespace

Drawing read_dxf(const std::string& text, Point origin, const std::string& unit) {
  return read(text, origin, unit, false);
}

Drawing read_dxf_sheet(const std::string& text, Point origin, const std::string& unit) {
  return read(text, origin, unit, true);
}

}  // namespace judge
