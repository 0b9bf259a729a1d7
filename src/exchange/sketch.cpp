// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/sketch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "dxf/file.h"
#include "dxf/units.h"
#include "exact_conics.h"
#include "obvid/core/internal/format_into.h"
#include "obvid/core/internal/picture_mark.h"
#include "obvid/core/internal/questions.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/geom/internal/box.h"
#include "xml_text.h"

namespace obvid {
namespace {

using exchange::DxfLayer;
using exchange::DxfWriter;

/// Lines in which an arc of a picture is drawn.
constexpr int kLinesOfArc = 48;

Box2 box_of(const Sketch& sketch) {
  Box2 box;
  for (const SketchLayer& layer : sketch.layers) {
    for (const Piece& piece : layer.pieces) {
      for (int k = 0; k <= kLinesOfArc; ++k) {
        box.add(evaluate(piece, static_cast<double>(k) / kLinesOfArc).point);
      }
    }
    for (const auto& line : layer.polylines) {
      for (const Vec2 p : line) box.add(p);
    }
    for (const Vec2 p : layer.points) box.add(p);
  }
  for (const SketchWord& word : sketch.words) box.add(word.at);
  if (box.low.x > box.high.x) box.low = box.high = {};
  return box;
}

class SketchDxf {
 public:
  SketchDxf(const Sketch& sketch, Watch* watch)
      : sketch_(sketch), box_(box_of(sketch)), questions_(watch) {}

  std::string run() {
    constexpr double kLetters = 0.012;  // of the drawing's diagonal
    const double height = kLetters * norm(box_.high - box_.low);
    std::vector<DxfLayer> layers;
    for (const SketchLayer& layer : sketch_.layers) {
      layers.push_back({layer.name, layer.dxf_color});
      draw(layer);
    }
    layers.push_back({kWords});
    for (const SketchWord& word : sketch_.words) text(word, height);
    const int units = sketch_.units.known() ? dxf::insunits_of(sketch_.units.name) : 0;
    const std::string seed = out_.next_handle();
    return exchange::r2000_head(layers, units, seed, box_.low, box_.high) + out_.take() +
           exchange::r2000_tail();
  }

 private:
  static constexpr const char* kWords = "NUMBERS";

  void begin(const char* kind, const char* subclass, const std::string& layer) {
    out_.pair(0, kind);
    out_.pair(5, out_.handle());
    out_.pair(330, exchange::kModelSpace);
    out_.pair(100, "AcDbEntity");
    out_.pair(8, layer);
    out_.pair(100, subclass);
  }

  void draw(const SketchLayer& layer) {
    for (const Vec2 p : layer.points) {
      if (questions_.end()) return;
      begin("POINT", "AcDbPoint", layer.name);
      out_.point3(10, p);
    }
    for (const Piece& piece : layer.pieces) {
      if (questions_.end()) return;
      const auto* arc = std::get_if<ArcPiece>(&piece);
      if (arc != nullptr) {
        draw(*arc, layer.name);
        continue;
      }
      begin("LINE", "AcDbLine", layer.name);
      out_.point3(10, evaluate(piece, 0.0).point);
      out_.point3(11, evaluate(piece, 1.0).point);
    }
    for (const auto& line : layer.polylines) {
      begin("LWPOLYLINE", "AcDbPolyline", layer.name);
      out_.pair(90, static_cast<int>(line.size()));
      out_.pair(70, layer.filled ? 1 : 0);
      for (const Vec2 p : line) {
        if (questions_.end()) return;
        out_.point(10, p);
      }
    }
  }

  /// DXF arcs run counter-clockwise. They lose digits where the centre lies far away, and readers
  /// take those whose two angles print alike for whole circles; bulges and lines do neither.
  void draw(const ArcPiece& arc, const std::string& layer) {
    constexpr double kToldAngle = 1e-14;  ///< rad
    if (std::abs(arc.kappa * arc.length) < kToldAngle) {
      begin("LINE", "AcDbLine", layer);
      out_.point3(10, arc.start);
      out_.point3(11, arc.end);
      return;
    }
    if (!exchange::centre_is_near(arc, norm(box_.high - box_.low))) {
      begin("LWPOLYLINE", "AcDbPolyline", layer);
      out_.pair(90, 2);
      out_.pair(70, 0);
      out_.point(10, arc.start);
      out_.pair(42, std::tan(0.25 * arc.kappa * arc.length));
      out_.point(10, arc.end);
      return;
    }
    const Vec2 centre = arc.start + left_normal(unit_at(arc.theta0)) / arc.kappa;
    const double turn = arc.kappa * arc.length;
    const double from = arc.theta0 - std::copysign(0.5 * std::numbers::pi, arc.kappa);
    const auto degrees = [](double angle) { return positive_angle(angle / kOneDegree, 360.0); };
    const bool whole = arc.start == arc.end;
    begin(whole ? "CIRCLE" : "ARC", "AcDbCircle", layer);
    out_.point3(10, centre);
    out_.pair(40, 1.0 / std::abs(arc.kappa));
    if (whole) return;
    out_.pair(100, "AcDbArc");
    out_.pair(50, degrees(std::min(from, from + turn)));
    out_.pair(51, degrees(std::max(from, from + turn)));
  }

  void text(const SketchWord& word, double height) {
    begin("TEXT", "AcDbText", kWords);
    out_.point3(10, word.at);
    out_.pair(40, height);
    out_.pair(1, word.text);
    out_.pair(100, "AcDbText");
  }

  const Sketch& sketch_;
  Box2 box_;
  Questions questions_;
  DxfWriter out_;
};

class SketchSvg {
 public:
  SketchSvg(const Sketch& sketch, Watch* watch)
      : sketch_(sketch), box_(box_of(sketch)), questions_(watch) {}

  std::string run() {
    const Vec2 size = box_.high - box_.low;
    const double largest = std::max(size.x, size.y);
    scale_ = largest > 0.0 ? kDrawing / largest : 1.0;
    top_ = kMargin + kLine * (1.5 + static_cast<double>(sketch_.remarks.size()));
    const double width = std::max(size.x * scale_, kNarrowest) + 2.0 * kMargin + kLegend;
    const double height = std::max(size.y * scale_ + top_ + kMargin,
                                   top_ + kLine * static_cast<double>(sketch_.layers.size() + 1));
    text_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
        "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"sans-serif\" font-size=\"13\" {2}=\"{3}\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        width, height, kPictureAttribute, kPictureValue);
    word({kMargin, kMargin + 0.3 * kLine}, sketch_.title, "font-size=\"16\"");
    for (std::size_t k = 0; k < sketch_.remarks.size(); ++k) {
      word({kMargin, kMargin + kLine * (static_cast<double>(k) + 1.3)}, sketch_.remarks[k],
           "fill=\"#555\"");
    }
    for (const SketchLayer& layer : sketch_.layers) draw(layer);
    for (const SketchWord& one : sketch_.words) {
      const Vec2 at = on_sheet(one.at);
      word({at.x + 6.0, at.y - 6.0}, one.text, "");
    }
    legend(width - kLegend);
    return text_ + "</svg>\n";
  }

 private:
  static constexpr double kDrawing = 900.0, kMargin = 30.0, kLegend = 350.0, kLine = 18.0;
  static constexpr double kNarrowest = 300.0;

  [[nodiscard]] Vec2 on_sheet(Vec2 p) const {
    return {kMargin + scale_ * (p.x - box_.low.x), top_ + scale_ * (box_.high.y - p.y)};
  }

  void word(Vec2 at, const std::string& text, const char* css) {
    text_ += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" {}>{}</text>\n", at.x, at.y, css,
                         escaped_xml(text));
  }

  [[nodiscard]] std::string style(const SketchLayer& layer) const {
    return fmt::format("fill=\"{}\" fill-opacity=\"0.35\" stroke=\"{}\" stroke-width=\"{}\"{}",
                       layer.filled ? layer.color : "none", layer.color, layer.width,
                       layer.dashed ? " stroke-dasharray=\"5 4\"" : "");
  }

  void path(const std::vector<Vec2>& line, const SketchLayer& layer) {
    std::string data;
    for (const Vec2 p : line) {
      if (questions_.end()) return;
      const Vec2 q = on_sheet(p);
      format_into(data, "{}{:.2f} {:.2f}", data.empty() ? 'M' : 'L', q.x, q.y);
    }
    if (layer.filled) data += 'Z';
    text_ += fmt::format("<path d=\"{}\" {}/>\n", data, style(layer));
  }

  void draw(const SketchLayer& layer) {
    text_ += fmt::format("<g id=\"{}\">\n", escaped_xml(layer.name));
    for (const auto& line : layer.polylines) path(line, layer);
    for (const Piece& piece : layer.pieces) {
      const int lines = std::holds_alternative<ArcPiece>(piece) ? kLinesOfArc : 1;
      std::vector<Vec2> line;
      for (int k = 0; k <= lines; ++k) {
        line.push_back(evaluate(piece, static_cast<double>(k) / lines).point);
      }
      path(line, layer);
    }
    for (const Vec2 p : layer.points) {
      if (questions_.end()) return;
      const Vec2 q = on_sheet(p);
      text_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3.2\" fill=\"{}\"/>\n", q.x,
                           q.y, layer.color);
    }
    text_ += "</g>\n";
  }

  void legend(double x) {
    double y = top_ + kLine;
    for (const SketchLayer& layer : sketch_.layers) {
      if (layer.points.empty() && layer.pieces.empty() && layer.polylines.empty()) continue;
      text_ += fmt::format("<path d=\"M{:.1f} {:.1f}h26\" {}/>\n", x, y - 4.0, style(layer));
      word({x + 34.0, y}, layer.title, "");
      y += kLine;
    }
  }

  const Sketch& sketch_;
  Box2 box_;
  Questions questions_;
  double scale_ = 1.0, top_ = 0.0;
  std::string text_;
};

}  // namespace

std::string sketch_dxf(const Sketch& sketch, Watch* watch) {
  return SketchDxf(sketch, watch).run();
}

SketchLayer sketch_layer(const char* name, const char* title, const char* color, int dxf_color,
                         double width) {
  SketchLayer out;
  out.name = name;
  out.title = title;
  out.color = color;
  out.dxf_color = dxf_color;
  out.width = width;
  return out;
}

std::string sketch_svg(const Sketch& sketch, Watch* watch) {
  return SketchSvg(sketch, watch).run();
}

}  // namespace obvid
