// SPDX-License-Identifier: Apache-2.0
// The curves of a STEP file (ISO 10303-21): splines, circles, lines, ellipses, with units.
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>

#include "drawing.h"

namespace judge {
namespace {

/// A parameter: text, or a list.
struct Value {
  std::string text;
  std::vector<Value> list;
  bool is_list = false;

  [[nodiscard]] Real real() const { return std::strtold(text.c_str(), nullptr); }
  [[nodiscard]] long id() const {
    return text.starts_with("#") ? std::strtol(text.c_str() + 1, nullptr, 10) : -1;
  }
};
/// An instance: one record, or several of a complex one.
using Instance = std::map<std::string, std::vector<Value>>;

class Part21 {
 public:
  explicit Part21(const std::string& text) {
    const std::size_t data = text.find("DATA;");
    if (data == std::string::npos) throw std::runtime_error("no DATA section");
    at_ = text.c_str() + data + 5;
    while (blank(), *at_ == '#') instance();
  }
  std::map<long, Instance> all;

 private:
  void blank() {
    while (*at_ == ' ' || *at_ == '\n' || *at_ == '\r' || *at_ == '\t') ++at_;
    if (at_[0] == '/' && at_[1] == '*') {
      while (*at_ != '\0' && !(at_[0] == '*' && at_[1] == '/')) ++at_;
      at_ += *at_ == '\0' ? 0 : 2;
      blank();
    }
  }
  void expect(char c) {
    blank();
    if (*at_ != c) throw std::runtime_error(std::string("expected ") + c);
    ++at_;
  }
  std::string word() {
    blank();
    std::string out;
    while (std::isalnum(static_cast<unsigned char>(*at_)) != 0 || *at_ == '_') out += *at_++;
    return out;
  }
  void instance() {
    char* end = nullptr;
    const long id = std::strtol(at_ + 1, &end, 10);
    at_ = end;
    expect('=');
    blank();
    Instance out;
    if (*at_ == '(') {
      ++at_;
      while (blank(), *at_ != ')') {
        const std::string name = word();
        if (name.empty()) throw std::runtime_error("no record name");
        out[name] = list();
      }
      ++at_;
    } else {
      const std::string name = word();
      out[name] = list();
    }
    expect(';');
    all[id] = std::move(out);
  }
  std::vector<Value> list() {
    expect('(');
    std::vector<Value> out;
    blank();
    while (*at_ != ')') {
      out.push_back(value());
      blank();
      if (*at_ == ',') ++at_;
      blank();
      if (*at_ == '\0') throw std::runtime_error("list not closed");
    }
    ++at_;
    return out;
  }
  Value value() {
    blank();
    Value out;
    if (*at_ == '(') {
      out.is_list = true;
      out.list = list();
    } else if (*at_ == '\'') {
      do out.text += *at_++;
      while (*at_ != '\0' && *at_ != '\'');
      ++at_;
    } else {
      while (*at_ != ',' && *at_ != ')' && *at_ != '(' && *at_ != '\0') {
        if (std::isspace(static_cast<unsigned char>(*at_)) == 0) out.text += *at_;
        ++at_;
      }
      if (*at_ == '(') out.list = list();  // a typed value: PARAMETER_VALUE(1.)
    }
    return out;
  }
  const char* at_;
};

class StepReader {
 public:
  StepReader(const std::string& text, Point origin, const std::string& unit)
      : file_(text), origin_(origin), unit_(unit) {}

  Drawing run() {
    read_units();
    if (out_.metres && metres_of(unit_)) scale_ = *out_.metres / *metres_of(unit_);
    for (const auto& [id, instance] : file_.all) {
      if (const auto* edge = record(id, "EDGE_CURVE")) edge_curve(*edge);
    }
    if (out_.spans.empty()) {
      for (const auto& [id, instance] : file_.all) {
        if (const auto* set = record(id, "GEOMETRIC_CURVE_SET")) {
          for (const Value& one : set->at(1).list) curve(one.id());
        }
      }
    }
    if (out_.spans.empty()) out_.fault = "no curve found";
    return std::move(out_);
  }

 private:
  const std::vector<Value>* record(long id, const std::string& name) const {
    const auto found = file_.all.find(id);
    if (found == file_.all.end()) return nullptr;
    const auto one = found->second.find(name);
    return one == found->second.end() ? nullptr : &one->second;
  }

  void read_units() {
    std::set<long> bases;  // units that others are told in
    for (const auto& [id, instance] : file_.all) {
      if (const auto* c = record(id, "CONVERSION_BASED_UNIT")) {
        if (!instance.contains("LENGTH_UNIT")) continue;
        const auto* measure = record(c->at(1).id(), "LENGTH_MEASURE_WITH_UNIT");
        if (measure == nullptr) measure = record(c->at(1).id(), "MEASURE_WITH_UNIT");
        if (measure == nullptr) throw std::runtime_error("unit without measure");
        const Value& factor = measure->at(0);
        const Real value = factor.list.empty() ? factor.real() : factor.list[0].real();
        const long base = measure->at(1).id();
        bases.insert(base);
        out_.metres = static_cast<double>(value * si(base));
      }
    }
    if (out_.metres) return;
    for (const auto& [id, instance] : file_.all) {
      if (instance.contains("LENGTH_UNIT") && instance.contains("SI_UNIT")) {
        out_.metres = static_cast<double>(si(id));
      }
    }
  }
  [[nodiscard]] Real si(long id) const {
    static const std::map<std::string, Real> kPrefix = {
        {"$", 1.0L},       {".MICRO.", 1e-6L}, {".MILLI.", 1e-3L}, {".CENTI.", 1e-2L},
        {".DECI.", 1e-1L}, {".KILO.", 1e3L},   {".NANO.", 1e-9L}};
    const auto* unit = record(id, "SI_UNIT");
    if (unit == nullptr || !kPrefix.contains(unit->at(0).text)) {
      throw std::runtime_error("unit not understood");
    }
    return kPrefix.at(unit->at(0).text);
  }

  [[nodiscard]] Vec raw(long id) const {
    const auto* p = record(id, "CARTESIAN_POINT");
    if (p == nullptr) p = record(id, "DIRECTION");
    if (p == nullptr) throw std::runtime_error("no point");
    return {p->at(1).list.at(0).real(), p->at(1).list.at(1).real()};
  }
  [[nodiscard]] Vec point(long id) const {
    const Vec p = raw(id);
    return {p.x * scale_ - origin_.x, p.y * scale_ - origin_.y};
  }

  void edge_curve(const std::vector<Value>& edge) {
    const auto* start = record(edge.at(1).id(), "VERTEX_POINT");
    const auto* end = record(edge.at(2).id(), "VERTEX_POINT");
    if (start == nullptr || end == nullptr) throw std::runtime_error("edge without vertices");
    const long basis = edge.at(3).id();
    const Vec a = point(start->at(1).id()), b = point(end->at(1).id());
    if (const auto* circle = record(basis, "CIRCLE")) {
      const Placement at = placement(circle->at(1).id());
      const Vec from = a - at.centre, to = b - at.centre;
      Real turn = at.sense * std::atan2(cross(from, to), dot(from, to));
      if (turn <= 0.0L) turn += 2.0L * std::numbers::pi_v<Real>;
      out_.spans.push_back(arc_span(at.centre, circle->at(2).real() * scale_,
                                    std::atan2(from.y, from.x), at.sense * turn));
    } else if (record(basis, "LINE") != nullptr) {
      line(a, b);
    } else {
      curve(basis);
    }
  }

  void line(Vec a, Vec b) {
    const Vec chord = b - a;
    out_.spans.emplace_back(a, std::atan2(chord.y, chord.x), 0.0L, norm(chord));
  }

  struct Placement {
    Vec centre;
    Real angle = 0.0L, sense = 1.0L;
  };
  [[nodiscard]] Placement placement(long id) const {
    const auto* axis = record(id, "AXIS2_PLACEMENT_3D");
    if (axis == nullptr) throw std::runtime_error("no placement");
    Placement out;
    out.centre = point(axis->at(1).id());
    if (const auto* z = record(axis->at(2).id(), "DIRECTION")) {
      out.sense = z->at(1).list.at(2).real() < 0.0L ? -1.0L : 1.0L;
    }
    if (record(axis->at(3).id(), "DIRECTION") != nullptr) {
      const Vec x = raw(axis->at(3).id());
      out.angle = std::atan2(x.y, x.x);
    }
    return out;
  }

  void curve(long id) {
    if (const auto* trimmed = record(id, "TRIMMED_CURVE")) return trimmed_curve(*trimmed);
    if (const auto* composite = record(id, "COMPOSITE_CURVE")) return composite_curve(*composite);
    if (const auto* circle = record(id, "CIRCLE")) return whole_circle(*circle);
    const auto found = file_.all.find(id);
    if (found == file_.all.end()) throw std::runtime_error("no curve");
    const Instance& one = found->second;
    if (!one.contains("B_SPLINE_CURVE_WITH_KNOTS")) throw std::runtime_error("unknown curve");
    spline(one);
  }

  void composite_curve(const std::vector<Value>& composite) {
    for (const Value& one : composite.at(1).list) {
      const auto* segment = record(one.id(), "COMPOSITE_CURVE_SEGMENT");
      if (segment == nullptr) throw std::runtime_error("composite curve without segments");
      if (segment->at(1).text != ".T.") throw std::runtime_error("segment against its curve");
      curve(segment->at(2).id());
    }
  }

  void whole_circle(const std::vector<Value>& circle) {
    const Placement at = placement(circle.at(1).id());
    out_.spans.push_back(arc_span(at.centre, circle.at(2).real() * scale_, at.angle,
                                  at.sense * 2.0L * std::numbers::pi_v<Real>));
  }

  static Real trim(const Value& list) {
    for (const Value& one : list.list) {
      if (one.text == "PARAMETER_VALUE") return one.list.at(0).real();
    }
    throw std::runtime_error("trimmed without a parameter");
  }

  void trimmed_curve(const std::vector<Value>& trimmed) {
    const long basis = trimmed.at(1).id();
    const Real from = trim(trimmed.at(2)), to = trim(trimmed.at(3));
    if (const auto* circle = record(basis, "CIRCLE")) {
      const Placement at = placement(circle->at(1).id());
      out_.spans.push_back(arc_span(at.centre, circle->at(2).real() * scale_,
                                    at.angle + at.sense * from, at.sense * (to - from)));
      return;
    }
    if (const auto* straight = record(basis, "LINE")) {
      const auto* vector = record(straight->at(2).id(), "VECTOR");
      if (vector == nullptr) throw std::runtime_error("line without direction");
      const Vec start = point(straight->at(1).id());
      const Vec along = (vector->at(2).real() * scale_) * raw(vector->at(1).id());
      return line(start + from * along, start + to * along);
    }
    curve(basis);  // the whole spline
  }

  void spline(const Instance& one) {
    std::vector<Value> head = one.at("B_SPLINE_CURVE_WITH_KNOTS");
    if (one.contains("B_SPLINE_CURVE")) {  // complex: the general record has degree and points
      const std::vector<Value>& general = one.at("B_SPLINE_CURVE");
      head.insert(head.begin(), general.begin(), general.end());
    } else {
      head.erase(head.begin());  // the name
    }
    const int degree = static_cast<int>(head.at(0).real());
    std::vector<Vec> points;
    for (const Value& p : head.at(1).list) points.push_back(point(p.id()));
    std::vector<Real> knots, weights(points.size(), 1.0L);
    for (std::size_t i = 0; i < head.at(5).list.size(); ++i) {
      const auto times = static_cast<int>(head.at(5).list[i].real());
      knots.insert(knots.end(), static_cast<std::size_t>(times), head.at(6).list.at(i).real());
    }
    if (one.contains("RATIONAL_B_SPLINE_CURVE")) {
      const std::vector<Value>& list = one.at("RATIONAL_B_SPLINE_CURVE").at(0).list;
      for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = list.at(i).real();
    }
    for (Span& span : spans_of_nurbs(degree, knots, points, weights)) {
      out_.spans.push_back(std::move(span));
    }
  }

  Part21 file_;
  Point origin_;
  std::string unit_;
  Real scale_ = 1.0L;
  Drawing out_;
};

}  // namespace

Drawing read_step(const std::string& text, Point origin, const std::string& unit) {
  try {
    return StepReader(text, origin, unit).run();
  } catch (const std::exception& error) {
    Drawing out;
    out.fault = error.what();
    return out;
  }
}

}  // namespace judge
