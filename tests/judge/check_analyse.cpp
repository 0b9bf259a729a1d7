// SPDX-License-Identifier: Apache-2.0
// `analyse`: adjacent circles, turning, runs and counts, recomputed from the points.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "region.h"
#include "sentences.h"
#include "texts.h"

namespace judge {
namespace {

constexpr Real kSameFigure = 1e-9L;

class AnalyseCheck {
 public:
  AnalyseCheck(const Input& input, Sheet& sheet) : sheet_(sheet), unit_(input.printed_unit()) {
    const Point origin = input.points.front().point;
    for (const GivenPoint& p : input.points) {
      p_.push_back(seen(p.point, origin));
      coordinate_ = std::max({coordinate_, std::abs(static_cast<Real>(p.point.x)),
                              std::abs(static_cast<Real>(p.point.y))});
    }
    // the analysis looks at an open series; a repeated first point stays
    for (std::size_t i = 1; i + 1 < p_.size(); ++i) {
      // neighbours may be 1e8 times nearer to each other than to the first point
      const Point before = input.points[i - 1].point, here = input.points[i].point;
      const Point behind = input.points[i + 1].point;
      const Vec a = seen(here, before), b = seen(behind, here), c = seen(behind, before);
      const Real shortest = std::min({norm(a), norm(b), norm(c)});
      kappa_.push_back(2.0L * cross(a, b) / (norm(a) * norm(b) * norm(c)));
      rounding_.push_back(32.0L * 0x1p-53L * coordinate_ / (shortest * shortest) +
                          kSameFigure * std::abs(kappa_.back()));
      turning_.push_back(std::atan2(cross(a, b), dot(a, b)));
    }
    Vec least = p_.front(), most = p_.front();
    for (const Vec& p : p_) {
      least = {std::min(least.x, p.x), std::min(least.y, p.y)};
      most = {std::max(most.x, p.x), std::max(most.y, p.y)};
    }
    const Real size = norm(most - least);
    constexpr Real kNothing = 1e-9L;
    // each coordinate has digits of its own
    std::vector<GivenPoint> along = input.points, up = input.points;
    for (GivenPoint& p : along) p.point.y = 0.0;
    for (GivenPoint& p : up) p.point.x = 0.0;
    constexpr int kAll = 18;  // of doubles near 1 some are printed with sixteen
    const Real digit = std::max(rounding_of(along, kAll), rounding_of(up, kAll));
    straight_ = input.placed
                    ? HUGE_VALL
                    : std::max(kNothing * size, 2.0L * std::numbers::sqrt2_v<Real> * digit);
  }

  void json(const Json& json) {
    const Json& points = member(json, "points");
    const Json& segments = member(json, "segments");
    if (!points.is_array() || points.size() != p_.size()) {
      return sheet_.fails("analyse points", std::to_string(points.size()),
                          std::to_string(p_.size()), "");
    }
    for (std::size_t i = 0; i < kappa_.size(); ++i) {
      const std::string where = fmt::format("point {}", i + 2);
      near("analyse kappa", figure(points[i + 1], "kappa"), kappa_[i], rounding_[i], where);
      const Real blur = 16.0L * 0x1p-53L * coordinate_ /
                            std::min(norm(p_[i + 1] - p_[i]), norm(p_[i + 2] - p_[i + 1])) +
                        1e-12L;
      near("analyse turning", figure(points[i + 1], "turning"), turning_[i], blur, where);
    }
    if (!segments.is_array() || segments.size() + 1 != p_.size()) {
      return sheet_.fails("analyse segments", std::to_string(segments.size()),
                          std::to_string(p_.size() - 1), "");
    }
    for (std::size_t i = 0; i < segments.size(); ++i) segment(segments[i], i);
    counts(json, segments);
  }

  void text(const Json& json, const std::string& out, const std::string& name) {
    const Json& points = member(json, "points");
    for (const std::string& line : lines_of(out)) {
      if (line.empty() || line == name) continue;
      const std::vector<std::string> words = words_of(line);
      if (line[0] == ' ' || words[0] == "point" || words[0] == "...") {
        row(words, points, member(json, "segments"));
      } else {
        fact(line, json);
      }
    }
  }

 private:
  void near(const std::string& claim, const Figure& stated, Real found, Real slack,
            const std::string& where) {
    if (!stated.known()) return sheet_.unjudged(claim, "null", where);
    sheet_.expect(std::abs(*stated.value - found) <= slack, claim, *stated.value, found, where);
  }

  void segment(const Json& segment, std::size_t i) {
    const std::string where = fmt::format("points {}-{}", i + 1, i + 2);
    const Real h = norm(p_[i + 1] - p_[i]);
    near("analyse chord", figure(segment, "chord"), h,
         4.0L * 0x1p-53L * coordinate_ + kSameFigure * h, where);
    const Figure error = figure(segment, "points_only_error");
    if (error.value == 0.0 && on_circle(i)) return sheet_.holds("analyse circular");
    const bool inner = i >= 1 && i + 2 < p_.size();
    if (!inner) {
      sheet_.expect(error.null() || p_.size() < 3, "analyse points_only_error null",
                    shown(error.value.value_or(0.0)), std::string("null: no neighbour"), where);
      return;
    }
    if (error.known()) points_only(i, *error.value, where);
    direction(segment, i, where);
  }

  void points_only(std::size_t i, double stated, const std::string& where) {
    const char* claim = "analyse points_only_error";
    const Lens lens = Lens::of(p_[i - 1], p_[i], p_[i + 1], p_[i + 2]);
    if (!lens.holds() && lens.turning > kStraightAngle + kRoundedDirection) {
      return sheet_.fails(claim, shown(stated), "null: the points turn by half a turn", where);
    }
    const Real found = lens.height(), slack = lens.growth() * kRoundedDirection;
    const Real afar = lens.growth() * 0x1p-60L * coordinate_ / lens.shortest;
    sheet_.expect(stated >= found * (1.0L - kSameFigure) - afar &&
                      stated <= found * (1.0L + kSameFigure) + slack + afar,
                  claim, stated, found, where);
  }

  /// A direction is that of the adjacent circles, whatever is left open beside; none, or 0 on a
  /// circle, is claimed only within rounding.
  void direction(const Json& segment, std::size_t i, const std::string& where) {
    const Real change = kappa_[i] - kappa_[i - 1];
    const double found = change > 0.0L ? 1.0 : change < 0.0L ? -1.0 : 0.0;
    const Figure stated = figure(segment, "direction");
    if (std::abs(change) > 2.0L * (rounding_[i - 1] + rounding_[i]) ||
        (stated.known() && *stated.value != 0.0)) {
      sheet_.expect(stated.value == found, "analyse direction", stated.value.value_or(9.0), found,
                    where);
    } else if (stated.known()) {
      sheet_.expect(on_circle(i), "analyse direction", shown(*stated.value),
                    std::string("no four points around here lie on one circle"), where);
    } else {
      sheet_.expect(stated.null(), "analyse direction", std::string("missing"),
                    std::string("null: rounding decides"), where);
    }
  }

  /// Whether four neighbouring points around chord i lie on one circle, within rounding.
  [[nodiscard]] bool on_circle(std::size_t i) const {
    for (std::size_t k = i >= 2 ? i - 2 : 0; k <= i && k + 1 < kappa_.size(); ++k) {
      if (std::abs(kappa_[k + 1] - kappa_[k]) <= 4.0L * (rounding_[k] + rounding_[k + 1])) {
        return true;
      }
    }
    return false;
  }

  static int changes(const std::vector<int>& signs) {
    int count = 0, last = 0;
    for (const int sign : signs) {
      if (sign == 0) continue;
      if (last != 0 && sign != last) ++count;
      last = sign;
    }
    return count;
  }

  void counts(const Json& json, const Json& segments) {
    std::vector<int> directions, exact;
    for (std::size_t i = 0; i + 1 < kappa_.size(); ++i) {
      const Real change = kappa_[i + 1] - kappa_[i];
      exact.push_back(change > 0.0L ? 1 : change < 0.0L ? -1 : 0);
    }
    for (const Json& one : segments) {
      directions.push_back(static_cast<int>(figure(one, "direction").value.value_or(0.0)));
    }
    const Figure vertices = figure(json, "vertices"), bound = figure(json, "vertices_lower_bound");
    const double counted = std::max<double>(changes(directions), bound.value.value_or(0.0));
    sheet_.expect(vertices.value == counted, "analyse vertices", vertices.value.value_or(-1.0),
                  counted, "changes of direction, or what is forced");
    // fewer of the points never show more
    sheet_.expect(bound.value.value_or(0.0) <= changes(exact), "analyse bound",
                  bound.value.value_or(0.0), changes(exact), "changes of the adjacent circles");
    std::vector<int> certain, all;
    for (std::size_t i = 0; i < kappa_.size(); ++i) {
      const int sign = kappa_[i] > 0.0L ? 1 : (kappa_[i] < 0.0L ? -1 : 0);
      all.push_back(sign);
      if (std::abs(kappa_[i]) > 2.0L * rounding_[i]) certain.push_back(sign);
    }
    const Figure inflections = figure(json, "inflections");
    const double stated = inflections.value.value_or(-1.0);
    sheet_.expect(stated >= changes(certain) && stated <= changes(all), "analyse inflections",
                  stated, changes(certain), "changes of sign of the adjacent circles");
    Real most = 0.0L;
    for (const Real t : turning_) most = std::max(most, std::abs(t));
    near("analyse largest turning", figure(json, "largest_turning"), most, 1e-6L * most + 1e-9L,
         "");
  }

  /// Of an arc of that curvature as long as both chords at a point.
  [[nodiscard]] Real height_over_chord(std::size_t i, Real kappa) const {
    const Real length = norm(p_[i] - p_[i - 1]) + norm(p_[i + 1] - p_[i]);
    return kappa * length * length / 8.0L;
  }

  void printed(const std::string& what, const std::string& text, std::optional<double> value) {
    sheet_.expect(prints(text, value), "text: analyse " + what, text,
                  value ? shown(*value) : std::string("-"), "");
  }
  static std::optional<double> degrees(const Figure& f) {
    if (!f.known()) return std::nullopt;
    return *f.value * 180.0 / std::numbers::pi;
  }

  /// point, adjacent radius, turning, chord, curvature, points-only error
  void row(const std::vector<std::string>& words, const Json& points, const Json& segments) {
    if (words[0].find_first_not_of("0123456789") != std::string::npos) return;
    const std::size_t i = std::strtoul(words[0].c_str(), nullptr, 10) - 1;
    if (i >= points.size() || words.size() < 3) return sheet_.unjudged("text: analyse", "row");
    if (i > 0 && i + 1 < points.size()) {
      const double kappa = figure(points[i], "kappa").value.value_or(0.0);
      const bool straight = words[1] == "straight";
      if (kappa == 0.0 || straight) {
        const Real height = std::abs(height_over_chord(i, kappa));
        sheet_.expect(straight && height <= straight_ * (1.0L + 1e-6L), "text: analyse radius",
                      words[1], straight ? shown(static_cast<double>(height)) : "straight", "");
      } else {
        printed("radius", words[1], 1.0 / kappa);
      }
      printed("turning", words[2], degrees(figure(points[i], "turning")));
    }
    if (i < segments.size() && words.size() == 6) {
      printed("chord", words[3], figure(segments[i], "chord").value);
      printed("points-only error", words[5], figure(segments[i], "points_only_error").value);
    }
  }

  void fact(const std::string& line, const Json& json) {
    const auto fact = fact_of(line);
    if (!fact) {
      const Sentence s = sentence_of(line, unit_);
      if (!s.figures.empty() && !line.starts_with("shown: ")) {
        sheet_.unjudged("text: analyse", s.shape);
      }
      return;
    }
    const Sentence s = sentence_of(fact->value, unit_);
    const std::string key = fact->label + ": " + s.shape;
    if (key == "size: # U") {
      printed("size", s.figures[0], figure(json, "size").value);
    } else if (key ==
               "vertices: # (curvature extrema, at least # unless a curve winds between the "
               "point)") {
      printed("vertices", s.figures[0], figure(json, "vertices").value);
      printed("vertices bound", s.figures[1], figure(json, "vertices_lower_bound").value);
    } else if (key == "inflections: # (at least # unless a curve winds between the point)") {
      printed("inflections", s.figures[0], figure(json, "inflections").value);
      printed("inflections bound", s.figures[1], figure(json, "inflections_lower_bound").value);
    } else if (key == "largest turning: # degrees") {
      printed("largest turning", s.figures[0], degrees(figure(json, "largest_turning")));
    } else if (fact->label == "curvature") {
      printed("runs", s.figures.at(0), static_cast<double>(member(json, "runs").size()));
    } else if (fact->label == "straight" || fact->label == "circular") {
      stretch(s, json);
    } else if (!s.figures.empty()) {
      sheet_.unjudged("text: analyse", key);
    }
  }

  void stretch(const Sentence& s, const Json& json) {
    for (const Json& one : member(json, "circular")) {
      if (figure(one, "first_point").value == s.number(0) - 1.0 &&
          figure(one, "last_point").value == s.number(1) - 1.0) {
        return sheet_.holds("text: analyse stretch");
      }
    }
    sheet_.fails("text: analyse stretch", s.shape, "not in the JSON", "");
  }

  Sheet& sheet_;
  std::string unit_;
  std::vector<Vec> p_;
  std::vector<Real> kappa_, rounding_, turning_;
  Real straight_ = 0.0L;  ///< height over a chord that is called straight
  Real coordinate_ = 0.0L;
};

}  // namespace

void check_analyse(const Input& input, const Run& json, const Run& text, Sheet& sheet) {
  if (input.points.size() < 3) return;
  const ReadJson read = read_json(json.out);
  if (!read.fault.empty()) return sheet.fails("analyse --json", "JSON", read.fault, "");
  AnalyseCheck check(input, sheet);
  check.json(read.value);
  check.text(read.value, text.out, text.input_name);
  const Figure bound = figure(read.value, "vertices_lower_bound");
  (void)bound;
}

void check_compare(const Run& json, const Run& text, const Course& fit, Sheet& sheet) {
  const ReadJson read = read_json(json.out);
  if (!read.fault.empty()) return sheet.fails("compare --json", "JSON", read.fault, "");
  const ContourFile& file = fit.file;
  std::map<std::string, const Json*> rows;
  for (const Json& row : member(read.value, "carriers")) rows[text_of(row, "carrier")] = &row;
  const auto found = rows.find(file.carrier);
  if (found == rows.end()) return sheet.missing("compare carriers", file.carrier);
  const Json& row = *found->second;
  if (member(row, "refusal").is_object()) {
    sheet.fails("compare refusal", "refused", "fit --carrier makes it", file.carrier);
  } else {
    const auto same = [&](const char* name, std::optional<double> mine) {
      const Figure stated = figure(row, name);
      const bool ok =
          stated.value == mine ||
          (stated.known() && mine && std::abs(*stated.value - *mine) <= 1e-9 * std::abs(*mine));
      sheet.expect(ok, std::string("compare ") + name, stated.known() ? shown(*stated.value) : "-",
                   mine ? shown(*mine) : "-", file.carrier + ": what fit --carrier says");
    };
    same("pieces", static_cast<double>(file.pieces.size()));
    same("vertices", figure(file.certificate, "vertices").value);
    same("inflections", figure(file.certificate, "inflections").value);
    if (file.promises_monotone()) {
      std::optional<double> most;  // of what is known
      for (const Json& one : member(file.report, "segments")) {
        const Figure deviation = figure(one, "deviation");
        if (deviation.known()) most = std::max(most.value_or(0.0), *deviation.value);
      }
      same("error_bound", most);
    }
    if (figure(file.report, "carrier_deviation").present && file.carrier != "spiral") {
      same("deviation", figure(file.report, "carrier_deviation").value);
    }
    if (figure(file.report, "outside_spirals_region").present && file.carrier != "spiral") {
      same("outside", figure(file.report, "outside_spirals_region").value);
    }
  }
  for (const std::string& line : lines_of(text.out)) {
    const std::vector<std::string> words = words_of(line);
    // sentences below the table begin with a carrier's name too
    if (words.size() < 11 || !rows.contains(words[0]) ||
        words[1].find_first_not_of("0123456789") != std::string::npos) {
      continue;
    }
    const Json& one = *rows[words[0]];
    if (member(one, "refusal").is_object()) continue;
    const char* names[] = {"pieces",      "control_points", "",          "vertices",
                           "inflections", "error_bound",    "deviation", "outside"};
    for (std::size_t k = 0; k < 8; ++k) {
      if (*names[k] == '\0') continue;
      const Figure value = figure(one, names[k]);
      sheet.expect(prints(words[k + 1], value.value), std::string("text: compare ") + names[k],
                   words[k + 1], value.known() ? shown(*value.value) : "-", words[0]);
    }
  }
}

}  // namespace judge
