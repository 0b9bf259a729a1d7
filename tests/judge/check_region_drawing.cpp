// SPDX-License-Identifier: Apache-2.0
// The worksheet of `region` in LaTeX, and its drawings, against its JSON.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "drawing.h"
#include "region_checks.h"
#include "sentences.h"

namespace judge {
namespace {

constexpr double kDegreesOfRadian = 180.0 / std::numbers::pi;
/// Lengths in drawings are told apart beyond this part of the size.
constexpr Real kDrawnTo = 1e-9L;

Real length_of(const Span& arc) { return norm(arc.at(0.0L).d); }

// LaTeX

/// A cell of LaTeX is the figure to the decimals printed.
bool prints_decimals(const std::string& cell, std::optional<double> value) {
  if (!value || std::isnan(*value)) return cell == "--";
  if (std::isinf(*value)) return cell == "$\\infty$";
  const std::size_t point = cell.find('.');
  const auto decimals = point == std::string::npos ? 0 : static_cast<int>(cell.size() - point) - 1;
  char* end = nullptr;
  const double stated = std::strtod(cell.c_str(), &end);
  const double half = 0.5 * std::pow(10.0, -decimals);
  return *end == '\0' && !cell.empty() &&
         std::abs(stated - *value) <= half * (1.0 + 1e-9) + 1e-14 * std::abs(*value);
}

std::vector<std::string> tex_cells(std::string line) {
  const std::size_t end = line.find(" \\\\");
  if (end == std::string::npos) return {};
  line.resize(end);
  std::vector<std::string> out;
  std::size_t from = 0;
  for (std::size_t at = line.find(" & "); at != std::string::npos; at = line.find(" & ", from)) {
    out.push_back(line.substr(from, at - from));
    from = at + 3;
  }
  out.push_back(line.substr(from));
  return out;
}

class TexCheck {
 public:
  TexCheck(const SheetPart& part, Sheet& sheet) : part_(part), sheet_(sheet) {
    for (const SheetRow& row : part.rows) {
      largest_ = std::max(largest_, figure(*row.figures, "chord").value.value_or(0.0));
    }
  }

  void point(std::vector<std::string> cells) {
    if (points_ >= part_.points.size() || cells.size() != 9) {
      return sheet_.fails("LaTeX: points", fmt::format("{} cells", cells.size()), "another table",
                          "");
    }
    const SheetPoint& p = part_.points[points_++];
    const std::string plus = p.inserted > 0 ? "$^+$" : "";
    say("point", cells[0] == p.name() + plus, cells[0], p.name() + plus, p);
    number("x", cells[1], p.stored.x, p);
    number("y", cells[2], p.stored.y, p);
    number("adjacent radius", cells[3], inverse(p.adjacent_kappa), p);
    angle("heading", cells[4], p, p.heading);
    angle("range", cells[5], p, p.headings ? std::optional(p.headings->low) : std::nullopt);
    angle("range", cells[6], p, p.headings ? std::optional(p.headings->high) : std::nullopt);
    radii(cells, p);
  }

  void segment(const std::vector<std::string>& cells) {
    if (rows_ >= part_.rows.size() || cells.size() != 12) {
      return sheet_.fails("LaTeX: segments", fmt::format("{} cells", cells.size()), "another table",
                          "");
    }
    const SheetRow& row = part_.rows[rows_++];
    static const char* kNames[] = {"chord", "points_only_error", "to_apex", "from_apex",
                                   "lower_height", "width", "chord_apex_height",
                                   "tangent_apex_height", "chord_apex_gap", "tangent_apex_gap",
                                   "spline_distance"};
    sheet_.expect(cells[0] == part_.name(row), "LaTeX: segment", cells[0], part_.name(row), "");
    for (std::size_t k = 0; k < std::size(kNames); ++k) {
      const std::optional<double> value = figure(*row.figures, kNames[k]).value;
      // parallel tangents meet nowhere: infinite in text, which JSON does not know
      const bool nowhere = (k == 2 || k == 3) && !value && cells[k + 1] == "$\\infty$";
      sheet_.expect(nowhere || prints_decimals(cells[k + 1], value),
                    fmt::format("LaTeX: {}", kNames[k]), cells[k + 1],
                    value ? shown(*value) : std::string("--"), part_.name(row));
    }
    fine_enough(cells[5]);
  }

  void end() {
    sheet_.expect(points_ == part_.points.size(), "LaTeX: points", static_cast<Real>(points_),
                  static_cast<Real>(part_.points.size()), "");
    sheet_.expect(rows_ == part_.rows.size(), "LaTeX: segments", static_cast<Real>(rows_),
                  static_cast<Real>(part_.rows.size()), "");
  }

 private:
  static std::optional<double> inverse(std::optional<double> kappa) {
    if (!kappa) return std::nullopt;
    return 1.0 / *kappa;
  }
  void say(const char* name, bool ok, const std::string& stated, const std::string& found,
           const SheetPoint& p) {
    sheet_.expect(ok, fmt::format("LaTeX: {}", name), stated, found, "point " + p.name());
  }
  void number(const char* name, const std::string& cell, std::optional<double> value,
              const SheetPoint& p) {
    say(name, prints_decimals(cell, value), cell, value ? shown(*value) : "--", p);
  }
  void angle(const char* name, std::string cell, const SheetPoint& p, std::optional<Real> heading) {
    const std::size_t circle = cell.find("$^\\circ$");
    if (circle != std::string::npos) cell.resize(circle);
    std::optional<double> degrees;
    if (heading) {
      const auto own = static_cast<double>(p.heading);
      const double shift = std::remainder(own, 2.0 * std::numbers::pi) - own;
      degrees = (static_cast<double>(*heading) + shift) * kDegreesOfRadian;
    }
    number(name, cell, degrees, p);
  }
  void radii(const std::vector<std::string>& cells, const SheetPoint& p) {
    // JSON has null for an end that is open: without both anything goes, or nothing is known
    if (!p.kappas) {
      const bool ok = (cells[7] == "--" && cells[8] == "--") ||
                      (std::strtod(cells[7].c_str(), nullptr) == 0.0 && cells[8] == "$\\infty$");
      return say("radii", ok, cells[7] + " " + cells[8], "--", p);
    }
    const double a = static_cast<double>(1.0L / p.kappas->low),
                 b = static_cast<double>(1.0L / p.kappas->high);
    const bool straight = p.kappas->low <= 0.0L && p.kappas->high >= 0.0L;
    const bool a_is_less = std::abs(a) <= std::abs(b);
    constexpr double kAsSharp = 1e-12;
    const bool either = std::abs(std::abs(a) - std::abs(b)) <= kAsSharp * std::abs(a);
    const double least = a_is_less ? a : b, other = a_is_less ? b : a;
    const bool least_ok = prints_decimals(cells[7], least) ||
                          (either && prints_decimals(cells[7], other));
    say("least radius", least_ok, cells[7], shown(least), p);
    number("greatest radius", cells[8], straight ? HUGE_VAL : other, p);
  }

  /// Decimals tell a hundred-thousandth of the longest chord.
  void fine_enough(const std::string& cell) {
    constexpr double kTold = 1e-5;
    const std::size_t point = cell.find('.');
    if (cell == "--") return;
    const auto decimals = point == std::string::npos ? 0 : static_cast<int>(cell.size() - point) - 1;
    sheet_.expect(largest_ * kTold >= 1.0 || std::pow(10.0, -decimals) <= kTold * largest_,
                  "LaTeX: decimals", std::string(cell), shown(kTold * largest_), "");
  }

  const SheetPart& part_;
  Sheet& sheet_;
  double largest_ = 0.0;
  std::size_t points_ = 0, rows_ = 0;
};

// drawings

class DrawingCheck {
 public:
  DrawingCheck(const SheetPart& part, const Input& input, const Drawing& drawing, Real factor,
               Sheet& sheet)
      : p_(part), input_(input), d_(drawing), factor_(factor), sheet_(sheet) {
    Vec low = part.points.front().point, high = low;
    for (const SheetPoint& p : part.points) {
      low = {std::min(low.x, p.point.x), std::min(low.y, p.point.y)};
      high = {std::max(high.x, p.point.x), std::max(high.y, p.point.y)};
    }
    near_ = kDrawnTo * norm(high - low) + 32.0L * 0x1p-53L * part.coordinate;
  }

  void run() {
    points();
    tangents();
    circles();
    triangles();
    boundaries("LIMIT_FROM_START", 0);
    boundaries("LIMIT_TO_END", 1);
    strips();
  }

 private:
  [[nodiscard]] std::vector<std::vector<Span>> entities(const std::string& layer) const {
    std::vector<std::vector<Span>> out;
    std::size_t last = 0;
    for (std::size_t i = 0; i < d_.spans.size(); ++i) {
      if (d_.owners[i].layer != layer) continue;
      if (out.empty() || d_.owners[i].entity != last) out.emplace_back();
      out.back().push_back(d_.spans[i]);
      last = d_.owners[i].entity;
    }
    return out;
  }
  [[nodiscard]] bool same(Vec a, Vec b) const { return norm(a - b) <= near_; }

  void points() {
    std::map<bool, std::size_t> count;
    std::vector<Vec> drawn[2], named;
    std::vector<std::string> names;
    for (const Drawing::Mark& mark : d_.marks) {
      if (mark.layer == "POINTS") drawn[0].push_back(mark.at);
      if (mark.layer == "INSERTED") drawn[1].push_back(mark.at);
      if (mark.text.empty()) continue;
      names.push_back(mark.text);
      named.push_back(mark.at);
    }
    std::size_t at[2] = {0, 0};
    for (std::size_t i = 0; i < p_.points.size(); ++i) {
      const SheetPoint& p = p_.points[i];
      const int which = p.inserted > 0 ? 1 : 0;
      const bool stands = at[which] < drawn[which].size() && same(drawn[which][at[which]], p.point);
      ++at[which];
      sheet_.expect(stands, "drawing: points", std::string("elsewhere"), p.name(), p.name());
      const bool told = i < names.size() && names[i] == p.name() && same(named[i], p.point);
      sheet_.expect(told, "drawing: numbers", i < names.size() ? names[i] : "", p.name(), "");
    }
  }

  void tangents() {
    const auto lines = entities("TANGENTS");
    if (!count("tangents", lines.size(), p_.points.size())) return;
    for (std::size_t i = 0; i < p_.points.size(); ++i) {
      const Vec a = lines[i][0].point(0.0L), b = lines[i][0].point(1.0L);
      const Vec off = 0.5L * (a + b) - p_.points[i].point;
      const Real aside = std::abs(cross(unit_at(p_.points[i].heading), b - a));
      sheet_.expect(norm(off) <= near_ && aside <= 2.0L * near_, "drawing: tangents", aside, 0.0L,
                    p_.points[i].name());
    }
  }

  bool count(const char* what, std::size_t drawn, std::size_t wanted) {
    return sheet_.expect(drawn == wanted, fmt::format("drawing: {}", what),
                         static_cast<Real>(drawn), static_cast<Real>(wanted), "");
  }

  /// From the point before to the point after, through the point.
  void circles() {
    const auto arcs = entities("ADJACENT_CIRCLES");
    std::vector<std::size_t> inner;
    for (std::size_t i = 1; i + 1 < p_.points.size(); ++i) {
      if (p_.points[i].adjacent_kappa) inner.push_back(i);
    }
    if (!count("adjacent circles", arcs.size(), inner.size())) return;
    for (std::size_t k = 0; k < inner.size(); ++k) {
      const Vec a = p_.points[inner[k] - 1].point, m = p_.points[inner[k]].point,
                b = p_.points[inner[k] + 1].point;
      const Span& arc = arcs[k][0];
      const Vec from = arc.point(0.0L), to = arc.point(1.0L);
      const bool ends = (same(from, a) && same(to, b)) || (same(from, b) && same(to, a));
      const Vec u = m - a, v = b - m;
      const Real turn = 2.0L * std::abs(std::atan2(cross(u, v), dot(u, v)));
      const Real kappa = std::abs(Real{*p_.points[inner[k]].adjacent_kappa});
      const Real length = kappa > 0.0L && turn > 1e-6L ? turn / kappa : norm(b - a);
      const Real off = Path({arc}).nearest(m).distance;
      const bool ok = ends && off <= near_ &&
                      std::abs(length_of(arc) - length) <= 1e-6L * length + 4.0L * near_;
      sheet_.expect(ok, "drawing: adjacent circle",
                    fmt::format("{:.9Lg} long, {:.3Lg} from the point", length_of(arc), off),
                    fmt::format("{:.9Lg} long", length), p_.points[inner[k]].name());
    }
  }

  void triangles() {
    const auto drawn = entities("TRIANGLES");
    std::size_t at = 0;
    for (const SheetRow& row : p_.rows) {
      const SheetPoint &a = p_.points[row.from], &b = p_.points[row.to];
      const Vec u = unit_at(a.heading), v = unit_at(b.heading), chord = b.point - a.point;
      const Real turn = cross(u, v), to = cross(chord, v) / turn, from = cross(u, chord) / turn;
      const bool there = at < drawn.size() && drawn[at].size() == 3 &&
                         same(drawn[at][0].point(0.0L), a.point) &&
                         same(drawn[at][2].point(0.0L), b.point);
      constexpr Real kClear = 1e-9L;
      // an apex beside an end: rounding of the headings, 1e-15 rad, decides on which side
      const Real blur = (kClear + 8e-15L / std::abs(turn)) * norm(chord);
      if (std::min({std::abs(to), std::abs(from)}) <= blur || std::abs(turn) <= kClear) {
        at += there ? 1U : 0U;
        continue;
      }
      const bool wanted = to > 0.0L && from > 0.0L;
      // a drawing of a large series does not tell a short chord from the next one
      if (!wanted && norm(chord) <= 4.0L * near_) continue;
      if (!wanted || !there) {
        sheet_.expect(wanted == there, "drawing: triangles", std::string(there ? "there" : "none"),
                      std::string(wanted ? "there" : "none"), p_.name(row));
        continue;
      }
      const Vec apex = a.point + to * u;
      const Real off = norm(drawn[at++][1].point(0.0L) - apex);
      sheet_.expect(off <= near_ + 1e-15L * 64.0L * to / std::abs(turn) + 1e-12L * to,
                    "drawing: triangles", off, 0.0L, p_.name(row));
    }
    count("triangles", drawn.size(), at);
  }

  /// Where rounding decides whether there is a region.
  [[nodiscard]] bool undecided(const SheetRow& row) const {
    return p_.direction(row).value_or(0) != 0 &&
           std::abs(p_.bending(row)) <= 1e-9L + std::abs(near_) / chord(row);
  }
  [[nodiscard]] Real chord(const SheetRow& row) const {
    return norm(p_.points[row.to].point - p_.points[row.from].point);
  }

  void boundaries(const std::string& layer, std::size_t which) {
    const std::string claim = "drawing: " + layer;
    std::vector<Span> drawn;
    for (const auto& entity : entities(layer)) drawn.insert(drawn.end(), entity.begin(), entity.end());
    std::size_t at = 0;
    bool open = false;
    for (const SheetRow& row : p_.rows) {
      const auto region = p_.region(row, input_);
      if (!region || undecided(row)) {
        open = open || undecided(row) || figure(*row.figures, "width").known();
        continue;
      }
      Real wanted = 0.0L, found = 0.0L;
      for (const Span& arc : region->arcs(which)) wanted += length_of(arc);
      const auto on = [&](const Span& arc) {
        for (int k = 0; k <= 8; ++k) {
          const Vec p = arc.point(k / 8.0L);
          if (!(region->distance(p, which) <= near_)) return false;
        }
        return true;
      };
      const Real slack = 8.0L * near_ + 1e-9L * wanted;
      // arcs of segments that rounding decides about may stand in between
      for (std::size_t k = at; open && k < drawn.size() && found < wanted - slack; ++k) {
        if (!on(drawn[k])) continue;
        found += length_of(drawn[k]);
        at = k + 1;
      }
      while (at < drawn.size() && on(drawn[at])) found += length_of(drawn[at++]);
      open = !sheet_.expect(std::abs(found - wanted) <= slack, claim, found, wanted, p_.name(row));
    }
    if (at < drawn.size() && !open) {
      sheet_.fails(claim, fmt::format("{} arcs more", drawn.size() - at), "none", "");
    }
  }

  /// The region, wider by one factor.
  void strips() {
    constexpr std::size_t kSteps = 40;
    const auto drawn = entities("REGION");
    std::size_t known = 0;
    for (const auto& strip : drawn) {
      if (strip.size() != 2 * (kSteps + 1)) {
        sheet_.fails("drawing: region", fmt::format("{} sides", strip.size()), "82", "");
        continue;
      }
      const Vec from = strip[0].point(0.0L), to = strip[kSteps].point(0.0L);
      // rounding of ordinates is drawn wider too
      const auto row = std::find_if(p_.rows.begin(), p_.rows.end(), [&](const SheetRow& r) {
        const Real wider = near_ + 16.0L * factor_ * 0x1p-53L * (p_.coordinate + chord(r));
        return norm(p_.points[r.from].point - from) <= wider &&
               norm(p_.points[r.to].point - to) <= wider;
      });
      if (row == p_.rows.end()) {
        sheet_.fails("drawing: region", "over no segment", "", "");
        continue;
      }
      ++known;
      const auto region = p_.region(*row, input_);
      const auto y = region ? region->over_middle() : std::nullopt;
      if (!y || undecided(*row)) continue;
      const Vec one = strip[kSteps / 2].point(0.0L),
                other = strip[kSteps + 1 + kSteps / 2].point(0.0L);
      const Real wide = norm(other - one), wanted = factor_ * std::abs((*y)[1] - (*y)[0]);
      const Vec a = p_.points[row->from].point, b = p_.points[row->to].point;
      const Vec along = (1.0L / norm(b - a)) * (b - a);
      const Vec middle = 0.5L * (a + b) + (0.5L * ((*y)[0] + (*y)[1])) * left_of(along);
      sheet_.expect(std::abs(wide - wanted) <= 1e-6L * wanted + (2.0L + factor_) * near_ &&
                        norm(0.5L * (one + other) - middle) <= 4.0L * near_ + 1e-6L * wanted,
                    "drawing: region", wide, wanted, p_.name(*row));
    }
    sheet_.expect(known == drawn.size(), "drawing: regions", static_cast<Real>(known),
                  static_cast<Real>(drawn.size()), "");
  }

  const SheetPart& p_;
  const Input& input_;
  const Drawing& d_;
  Real factor_;
  Sheet& sheet_;
  Real near_ = 0.0L;
};

/// 1, 2 or 5 times a power of ten, so that the widest region takes a quarter of its chord.
Real wanted_factor(const SheetPart& part) {
  Real widest = 0.0L;
  for (const SheetRow& row : part.rows) {
    const auto width = figure(*row.figures, "width").value, chord = figure(*row.figures, "chord").value;
    if (!width || !chord) continue;
    // rounding has no width
    if (*width > 64.0L * 0x1p-53L * (part.coordinate + *chord)) {
      widest = std::max<Real>(widest, *width / *chord);
    }
  }
  const Real most = widest > 0.0L ? 0.25L / widest : 1.0L;
  if (!(most > 1.0L) || !std::isfinite(most)) return 1.0L;
  Real best = 1.0L;
  for (Real power = 1.0L; power <= most; power *= 10.0L) {
    for (const Real digit : {1.0L, 2.0L, 5.0L}) {
      if (digit * power <= most * (1.0L + 1e-12L)) best = digit * power;
    }
  }
  return best;
}

/// The picture: points of the table and curves of the drawing in one scale.
class PictureCheck {
 public:
  PictureCheck(const SheetPart& part, const Drawing& drawing, const std::string& svg, Sheet& sheet)
      : part_(part), drawing_(drawing), svg_(svg), sheet_(sheet) {}

  void run() {
    if (!points()) return;
    for (const char* layer : {"REGION", "ADJACENT_CIRCLES", "TRIANGLES", "LIMIT_FROM_START",
                              "LIMIT_TO_END", "TANGENTS"}) {
      curves(layer);
    }
  }

 private:
  static constexpr Real kPixels = 0.03L;      // of two coordinates with two decimals
  static constexpr Real kStraight = 0.15L;    // pixels, of a chord from its curve
  static constexpr Real kOfPlace = 1e-9L;     // of a coordinate: nobody sees more
  static constexpr int kPlaces = 8;

  bool points() {
    std::vector<Vec> drawn;
    for (const char* color : {"#000000", "#c0392b"}) {
      for (std::size_t at = svg_.find("<circle cx=\""); at != std::string::npos;
           at = svg_.find("<circle cx=\"", at + 1)) {
        double x = 0.0, y = 0.0;
        if (std::sscanf(svg_.c_str() + at, "<circle cx=\"%lf\" cy=\"%lf\"", &x, &y) != 2) continue;
        const std::string tag = svg_.substr(at, svg_.find('>', at) - at);
        if (tag.find(color) != std::string::npos) drawn.push_back({x, -y});
      }
    }
    std::vector<Vec> wanted;
    for (const bool inserted : {false, true}) {
      for (const SheetPoint& p : part_.points) {
        if ((p.inserted > 0) == inserted) wanted.push_back(p.point);
      }
    }
    if (!sheet_.expect(drawn.size() == wanted.size(), "picture: points",
                       static_cast<Real>(drawn.size()), static_cast<Real>(wanted.size()), "")) {
      return false;
    }
    std::size_t far = 0;
    for (std::size_t i = 1; i < wanted.size(); ++i) {
      if (norm(wanted[i] - wanted[0]) > norm(wanted[far] - wanted[0])) far = i;
    }
    const Vec d = drawn[far] - drawn[0], w = wanted[far] - wanted[0];
    scale_ = norm(d) / norm(w);
    drawn_ = drawn[0];
    stands_ = wanted[0];
    // of the two points the scale has what their two decimals leave
    scale_error_ = kPixels / norm(w);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      const Vec off = drawn[i] - in_pixels(wanted[i]);
      sheet_.expect(norm(off) <= kPixels, "picture: points", norm(off), 0.0L, std::to_string(i));
    }
    return true;
  }

  [[nodiscard]] Vec in_pixels(Vec p) const { return drawn_ + scale_ * (p - stands_); }
  [[nodiscard]] Vec in_drawing(Vec pixel) const {
    return stands_ + (1.0L / scale_) * (pixel - drawn_);
  }
  /// How far a place may be off, pixels.
  [[nodiscard]] Real slack(Vec p) const {
    return kPixels + norm(p - stands_) * (scale_error_ + kOfPlace * scale_);
  }

  /// The corners of the paths in a group, closed ones with their first again.
  [[nodiscard]] std::vector<std::vector<Vec>> paths(const std::string& layer) const {
    std::vector<std::vector<Vec>> out;
    const std::size_t begin = svg_.find("<g id=\"" + layer + "\">");
    if (begin == std::string::npos) return out;
    const std::size_t end = svg_.find("</g>", begin);
    for (std::size_t at = svg_.find(" d=\"M", begin); at < end; at = svg_.find(" d=\"M", at + 1)) {
      const std::size_t stop = svg_.find('"', at + 5);
      std::vector<Vec> corners;
      for (const char* c = svg_.c_str() + at + 4; c < svg_.c_str() + stop;) {
        if (*c == 'Z' && !corners.empty()) corners.push_back(corners.front());
        if (*c != 'M' && *c != 'L') {
          ++c;
          continue;
        }
        char* next = nullptr;
        const double x = std::strtod(c + 1, &next);
        char* after = nullptr;
        const double y = std::strtod(next, &after);
        if (after == next) break;
        corners.push_back({x, -y});
        c = after;
      }
      out.push_back(std::move(corners));
    }
    return out;
  }

  [[nodiscard]] std::vector<std::vector<Span>> entities(const std::string& layer) const {
    std::vector<std::vector<Span>> out;
    std::size_t last = 0;
    for (std::size_t i = 0; i < drawing_.spans.size(); ++i) {
      if (drawing_.owners[i].layer != layer) continue;
      if (out.empty() || drawing_.owners[i].entity != last) out.emplace_back();
      out.back().push_back(drawing_.spans[i]);
      last = drawing_.owners[i].entity;
    }
    return out;
  }

  static Real from_polyline(Vec p, const std::vector<Vec>& corners) {
    Real best = norm(p - corners.front());
    for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
      const Vec leg = corners[k + 1] - corners[k];
      const Real length2 = dot(leg, leg);
      const Real t =
          length2 > 0.0L ? std::clamp(dot(p - corners[k], leg) / length2, 0.0L, 1.0L) : 0.0L;
      best = std::min(best, norm(p - corners[k] - t * leg));
    }
    return best;
  }

  /// Each path is one curve of the drawing: its corners lie on it and it leaves none of it out.
  void curves(const std::string& layer) {
    const auto drawn = paths(layer);
    const auto wanted = entities(layer);
    const std::string claim = "picture: " + layer;
    if (!sheet_.expect(drawn.size() == wanted.size(), claim, static_cast<Real>(drawn.size()),
                       static_cast<Real>(wanted.size()), "curves")) {
      return;
    }
    for (std::size_t k = 0; k < drawn.size(); ++k) {
      if (drawn[k].empty()) {
        sheet_.fails(claim, "nothing", "a curve", std::to_string(k));
        continue;
      }
      const Path path(wanted[k]);
      Real worst = 0.0L;
      for (const Vec corner : drawn[k]) {
        const Vec p = in_drawing(corner);
        worst = std::max(worst, scale_ * path.nearest(p).distance - slack(p));
      }
      for (const Span& span : wanted[k]) {
        for (int j = 0; j <= kPlaces; ++j) {
          const Vec p = span.point(static_cast<Real>(j) / kPlaces);
          const bool end = j == 0 || j == kPlaces;
          worst = std::max(worst, from_polyline(in_pixels(p), drawn[k]) - slack(p) -
                                      (end ? 0.0L : kStraight));
        }
      }
      sheet_.expect(worst <= 0.0L, claim, fmt::format("{:.3Lg} pixels too far", worst),
                    std::string("on the drawing's curve"), std::to_string(k));
    }
  }

  const SheetPart& part_;
  const Drawing& drawing_;
  const std::string& svg_;
  Sheet& sheet_;
  Real scale_ = 1.0L, scale_error_ = 0.0L;
  Vec drawn_, stands_;
};

}  // namespace

void check_region_tex(const Worksheet& worksheet, const std::string& tex, Sheet& sheet) {
  TexCheck user(worksheet.user, sheet), finer(worksheet.last(), sheet);
  TexCheck* now = &user;
  int table = 0;  // points, segments, of the user and of the finer table, then a construction
  const int tables = worksheet.refined ? 4 : 2;
  for (const std::string& line : lines_of(tex)) {
    if (line.starts_with("\\begin{tabular}")) ++table;
    if (table > tables) break;
    if (table == 3) now = &finer;
    const std::vector<std::string> cells = tex_cells(line);
    if (cells.size() < 2 || cells[0] == "$i$") continue;
    if (table % 2 == 1) {
      now->point(cells);
    } else {
      now->segment(cells);
    }
  }
  user.end();
  if (worksheet.refined) finer.end();
}

void check_region_drawings(const Worksheet& worksheet, const Input& input, const std::string& dxf,
                           const std::string& svg, const std::string& unit, Sheet& sheet) {
  const SheetPart& part = worksheet.last();
  const Drawing drawing = read_dxf_sheet(dxf, part.origin, unit);
  if (!drawing.fault.empty()) return sheet.fails("drawing", "a worksheet", drawing.fault, "");
  double factor = 0.0;
  const std::size_t at = svg.find("the region is drawn ");
  if (at != std::string::npos) std::sscanf(svg.c_str() + at, "the region is drawn %lf", &factor);
  const Real wanted = wanted_factor(part);
  sheet.expect(std::abs(factor - wanted) <= 1e-6L * wanted, "picture: times wider", factor, wanted,
               "");
  DrawingCheck(part, input, drawing, wanted, sheet).run();
  PictureCheck(part, drawing, svg, sheet).run();
}

}  // namespace judge
