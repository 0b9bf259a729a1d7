// SPDX-License-Identifier: Apache-2.0
// STEP, DXF, G-code, pages and pictures against the contour they were written from.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sentences.h"
#include "texts.h"

namespace judge {
namespace {

constexpr Real kExact = 1e-9L;            // of the size (formats: STEP)
constexpr Real kPrintedDigits = 4e-15L;   // of the coordinate: 15 digits and more are printed
constexpr double kRadiusMismatch = 5e-4;  // mm (formats: G-code)
constexpr Real kPlacesPerPiece = 6.0L;

struct Farthest {
  Real distance = 0.0L, order = 0.0L;
};

/// Largest distance of places of one path from the other.
Farthest farthest(const Path& from, const Path& to) {
  Farthest out;
  constexpr Real kMostPlaces = 3000.0L, kMostSearches = 1e7L;  // each looks at every piece
  const Real most = std::min(kMostPlaces, kMostSearches / to.end());
  const Real per = std::min(kPlacesPerPiece, most / from.end());
  const auto count = static_cast<long>(std::ceil(from.end() * per));
  for (long k = 0; k <= count; ++k) {
    const Real order = from.end() * static_cast<Real>(k) / static_cast<Real>(count);
    const Real away = to.nearest(from.at(order)).distance;
    if (away > out.distance) out = {away, order};
  }
  return out;
}

class ExportCheck {
 public:
  ExportCheck(const Course& course, const std::string& name, Sheet& sheet)
      : course_(course), name_(name), sheet_(sheet), kind_(name.substr(name.rfind('.') + 1)) {}

  void run(const std::string& text, const std::vector<std::string>& notes) {
    for (const std::string& note : notes) read_note(note);
    const Point origin = course_.origin;
    const std::string& unit = course_.file.units;
    if (kind_ == "html" || kind_ == "svg") {
      check_page(course_, text, sheet_);
    } else if (kind_ == "step" || kind_ == "stp") {
      compare(read_step(text, origin, unit));
    } else if (kind_ == "dxf") {
      compare(read_dxf(text, origin, unit));
    } else {
      const Drawing drawing = read_gcode(text, origin, unit);
      compare(drawing);
      program(drawing);
    }
  }

 private:
  void read_note(const std::string& text) {
    const Sentence s = sentence_of(text, course_.file.printed_unit());
    if (s.shape == "# block, # of them arcs, at most # U from the contour") {
      blocks_ = s.number(0);
      arcs_ = s.number(1);
      allowed(s.figures[2]);
    } else if (s.shape == "# entity, at most # U from the contour") {
      allowed(s.figures[1]);
    } else if (s.shape.ends_with("follows them within # U")) {
      allowed(s.figures.back());
    } else if (s.shape.starts_with("no unit is stated")) {
      sheet_.expect(!has_unit(), "export " + kind_ + " unit note", text, course_.file.units, name_);
    } else if (s.shape == "# entity, exact" || s.shape.starts_with("one NURBS curve of degree")) {
      return;
    } else if (!s.figures.empty()) {
      sheet_.unjudged("text: note", s.shape);
    }
  }
  /// The figure as printed, and half of its last digit.
  void allowed(const std::string& printed) {
    const Real value = std::strtold(printed.c_str(), nullptr);
    Real half = 0.0L;
    if (value > 0.0L) half = 0.5L * std::pow(10.0L, std::floor(std::log10(value)) - 2.0L);
    allowed_ = value + half;
  }

  /// Somebody said it, and it is one of length: "px" and "chord" are none.
  [[nodiscard]] bool has_unit() const {
    return course_.file.unit_known() && metres_of(course_.file.units).has_value();
  }

  void compare(const Drawing& drawing) {
    const std::string claim = "export " + kind_;
    if (!drawing.fault.empty()) {
      return sheet_.fails(claim, "a readable file", drawing.fault, name_);
    }
    if (kind_ != "nc") {
      // STEP needs one and converts; DXF states none that nobody said (docs/formats.md). Another
      // unit is no fault as long as coordinates are converted
      const bool stated = kind_ != "dxf" || has_unit();
      sheet_.expect(drawing.metres.has_value() == stated, claim + " unit",
                    drawing.metres ? fmt::format("{} m", *drawing.metres) : std::string("none"),
                    stated ? course_.file.units : "none: nobody said the unit", name_);
    }
    const Path path(drawing.spans);
    const Real scale = course_.ends.coordinate;
    const Real slack = kExact * course_.ends.size + kPrintedDigits * scale;
    const Real limit = std::max(allowed_.value_or(0.0L), 0.0L) + slack;
    const Farthest there = farthest(course_.path, path), back = farthest(path, course_.path);
    sheet_.expect(there.distance <= limit, claim, limit, there.distance,
                  fmt::format("{}: contour at order {:.6Lg} from the file", name_, there.order));
    sheet_.expect(back.distance <= limit, claim, limit, back.distance,
                  fmt::format("{}: file at order {:.6Lg} from the contour", name_, back.order));
  }

  void program(const Drawing& drawing) {
    if (!drawing.fault.empty()) return;
    if (blocks_) {
      sheet_.expect(*blocks_ == static_cast<double>(drawing.blocks), "G-code blocks", *blocks_,
                    static_cast<long double>(drawing.blocks), name_);
      sheet_.expect(*arcs_ == static_cast<double>(drawing.arc_blocks), "G-code arcs", *arcs_,
                    static_cast<long double>(drawing.arc_blocks), name_);
    }
    const double mismatch = drawing.worst_radius_mismatch * *drawing.metres * 1e3;
    sheet_.expect(mismatch < kRadiusMismatch, "G-code radii", kRadiusMismatch, mismatch,
                  name_ + ": radii at both ends of an arc differ, mm");
  }

  const Course& course_;
  std::string name_;
  Sheet& sheet_;
  std::string kind_;
  std::optional<Real> allowed_;
  std::optional<double> blocks_, arcs_;
};

}  // namespace

void check_export(const Course& course, const std::string& file, const std::string& text,
                  const std::vector<std::string>& notes, Sheet& sheet) {
  ExportCheck(course, file, sheet).run(text, notes);
}

}  // namespace judge
