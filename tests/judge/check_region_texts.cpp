// SPDX-License-Identifier: Apache-2.0
// The printed worksheet and its `.csv` against its JSON.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "region_checks.h"
#include "sentences.h"

namespace judge {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

/// Radii of a range of curvatures: the least and the greatest, infinite where it holds 0. Both ends
/// of a range around the straight line may be as sharp but for the last bits: then the least radius
/// is told with either sign.
std::array<std::optional<double>, 2> radii_of(const std::optional<Limits>& range,
                                              const std::string& told) {
  if (!range) return {};
  constexpr Real kAsSharp = 1e-12L;
  const bool around = range->low < 0.0L && std::isfinite(range->low) && range->high > 0.0L;
  if (around && std::abs(range->low + range->high) <= kAsSharp * range->high) {
    const Real sharp = told.starts_with("-") ? range->low : range->high;
    return {static_cast<double>(1.0L / sharp), HUGE_VAL};
  }
  const bool low_is_sharper = std::abs(range->low) > std::abs(range->high);
  const Real sharp = low_is_sharper ? range->low : range->high,
             blunt = low_is_sharper ? range->high : range->low;
  const bool straight = range->low <= 0.0L && range->high >= 0.0L;
  return {static_cast<double>(1.0L / sharp),
          straight ? HUGE_VAL : static_cast<double>(1.0L / blunt)};
}

/// Headings of a point by the turn in which its own is the nearest to 0.
struct Turned {
  double shift;

  explicit Turned(const SheetPoint& p)
      : shift(std::remainder(static_cast<double>(p.heading), 2.0 * std::numbers::pi) -
              static_cast<double>(p.heading)) {}
  [[nodiscard]] double degrees(Real heading) const {
    return (static_cast<double>(heading) + shift) * kDegrees;
  }
};

class Printed {
 public:
  Printed(const SheetPart& part, std::string claim, Sheet& sheet)
      : part_(part), claim_(std::move(claim)), sheet_(sheet) {}

  void number(const char* name, const std::string& text, std::optional<double> value,
              const std::string& where) {
    sheet_.expect(prints(text, value), fmt::format("{}: {}", claim_, name), text,
                  value ? shown(*value) : std::string("-"), where);
  }
  void radius(const char* name, const std::string& text, std::optional<double> value,
              const std::string& where) {
    const bool straight = value && std::isinf(*value), point = value && *value == 0.0;
    if (straight || point) {
      sheet_.expect(straight ? text == "straight" : text == "0",
                    fmt::format("{}: {}", claim_, name), text,
                    std::string(straight ? "straight" : "0"), where);
      return;
    }
    number(name, text, value, where);
  }

  /// To a millionth of the size; so a small one may be 0.
  void coordinate(const char* name, const std::string& text, double value,
                  const std::string& where) {
    if (std::strtod(text.c_str(), nullptr) != 0.0) return number(name, text, value, where);
    constexpr Real kTold = 1e-5L;
    Real size = 0.0L;
    for (const SheetPoint& p : part_.points) size = std::max(size, norm(p.point));
    sheet_.expect(std::abs(value) <= kTold * size, fmt::format("{}: {}", claim_, name), text,
                  shown(value), where);
  }

  /// Headings are told to 1e-5 degrees, in eight digits.
  void heading(const char* name, std::string text, std::optional<double> value, bool open,
               const std::string& where) {
    const bool marked = !text.empty() && text.back() == '*';
    if (marked) text.pop_back();
    const bool known = value.has_value() && text != "-";
    const double off = known ? std::abs(std::strtod(text.c_str(), nullptr) - *value) : 0.0;
    const bool ok = known ? off <= 0.51e-5 : !value && text == "-";
    sheet_.expect(ok && marked == open, fmt::format("{}: {}", claim_, name), text,
                  value ? shown(*value) : std::string("-"), where);
  }

  void point(const std::vector<std::string>& words) {
    const SheetPoint* p = find_point(words[0], words[4]);
    if (p == nullptr) return;
    const std::string where = "point " + words[0];
    const Turned turned(*p);
    coordinate("x", words[1], p->stored.x, where);
    coordinate("y", words[2], p->stored.y, where);
    std::optional<double> adjacent;
    if (p->adjacent_kappa) adjacent = 1.0 / *p->adjacent_kappa;
    radius("adjacent radius", words[3], adjacent, where);
    heading("heading", words[4], turned.degrees(p->heading), false, where);
    std::optional<double> low, high;
    if (p->headings) {
      low = turned.degrees(p->headings->low);
      high = turned.degrees(p->headings->high);
    }
    heading("range of headings", words[5], low, p->low_is_open, where);
    heading("range of headings", words[6], high, p->high_is_open, where);
    const auto [least, greatest] = radii_of(p->kappas, words[7]);
    // JSON has null for an end that is open: without both anything goes, or nothing is known
    const bool all = !p->kappas && words[7] == "0" && words[8] == "straight";
    if (!all) radius("least radius", words[7], least, where);
    if (!all) radius("greatest radius", words[8], greatest, where);
    const std::string how = p->inserted > 0 ? "inserted" : p->heading_given ? "given" : "chosen";
    sheet_.expect(words[9] == how || words[9] == how + ",", claim_ + ": heading is", words[9], how,
                  where);
  }

  void segment(const std::vector<std::string>& words) {
    const SheetRow* row = find_row(words[0]);
    if (row == nullptr) return;
    const char* names[] = {"chord",
                           "points_only_error",
                           "to_apex",
                           "from_apex",
                           "lower_height",
                           "width",
                           "chord_apex_height",
                           "tangent_apex_height",
                           "chord_apex_gap",
                           "tangent_apex_gap",
                           "spline_distance"};
    for (std::size_t k = 0; k < std::size(names); ++k) {
      // parallel tangents meet nowhere: infinite in text, which JSON does not know
      const bool apex = k == 2 || k == 3;
      if (apex && words[k + 1].ends_with("inf") && figure(*row->figures, names[k]).null()) continue;
      number(names[k], words[k + 1], figure(*row->figures, names[k]).value, "points " + words[0]);
    }
    ++rows_;
  }

  [[nodiscard]] std::size_t rows() const { return rows_; }

 private:
  /// A corner stands twice: rows go on from the one before. A table that leaves rows out may have
  /// the second one alone.
  const SheetPoint* find_point(const std::string& name, const std::string& heading) {
    constexpr double kToldTo = 1e-4;  // degrees
    const auto off = [&](const SheetPoint& p) {
      return std::abs(Turned(p).degrees(p.heading) - std::strtod(heading.c_str(), nullptr));
    };
    for (; at_ < part_.points.size(); ++at_) {
      const SheetPoint& here = part_.points[at_];
      if (here.name() != name) continue;
      const bool twice = at_ + 1 < part_.points.size() && part_.points[at_ + 1].name() == name;
      if (twice && off(part_.points[at_ + 1]) + kToldTo < off(here)) ++at_;
      return &part_.points[at_++];
    }
    sheet_.fails(claim_ + ": point", name, "no such point", "");
    return nullptr;
  }
  const SheetRow* find_row(const std::string& name) {
    for (const SheetRow& row : part_.rows) {
      if (part_.name(row) == name) return &row;
    }
    sheet_.fails(claim_ + ": segment", name, "no such segment", "");
    return nullptr;
  }

  const SheetPart& part_;
  std::string claim_;
  Sheet& sheet_;
  std::size_t rows_ = 0, at_ = 0;
};

bool is_name(const std::string& word) {
  return word.find_first_of("0123456789") != std::string::npos &&
         word.find_first_not_of("0123456789.-") == std::string::npos;
}

std::vector<std::string> cells_of_line(const std::string& line) { return split(line, ","); }

/// Every digit stands there.
bool same_number(const std::string& cell, std::optional<double> value) {
  if (cell.empty()) return !value;
  if (!value) return false;
  const double stated = std::strtod(cell.c_str(), nullptr);
  if (std::isinf(*value) || std::isinf(stated)) return std::isinf(*value) && std::isinf(stated);
  return std::abs(stated - *value) <= 1e-14 * std::abs(*value);
}

}  // namespace

void check_region_text(const Worksheet& worksheet, const std::string& text, Sheet& sheet) {
  enum class Table { kNone, kPoints, kSegments, kOther } table = Table::kNone;
  Printed user(worksheet.user, "text: region", sheet);
  Printed finer(worksheet.last(), "text: region refined", sheet);
  Printed* now = &user;
  Real largest = 0.0L;
  for (const std::string& line : lines_of(text)) {
    const std::vector<std::string> words = words_of(line);
    if (words.empty()) continue;
    if (line.starts_with("with ") && line.ends_with("inserted")) {
      const std::size_t more =
          worksheet.refined ? worksheet.refined->points.size() - worksheet.user.points.size() : 0;
      sheet.expect(std::strtoul(words[1].c_str(), nullptr, 10) == more, "text: region inserted",
                   words[1], std::to_string(more), "");
      now = &finer;
    } else if (words[0] == "point") {
      table = Table::kPoints;
    } else if (words[0] == "points" && words.size() > 1) {
      table = words[1] == "chord" ? Table::kSegments : Table::kOther;
    } else if (line.starts_with("largest delta")) {
      const SheetPart& part = now == &user ? worksheet.user : worksheet.last();
      largest = 0.0L;
      bool known = false;
      for (const SheetRow& row : part.rows) {
        largest = std::max<Real>(largest, figure(*row.figures, "width").value.value_or(0.0));
        known = known || figure(*row.figures, "width").known();
      }
      if (!known) {
        sheet.expect(words[2] == "-", "text: largest delta", words[2], std::string("-"), "");
        continue;
      }
      now->number("largest delta", words[2], static_cast<double>(largest), "");
    } else if (line.starts_with("unknown ")) {
      const SheetPart& part = now == &user ? worksheet.user : worksheet.last();
      const auto unknown = std::count_if(part.rows.begin(), part.rows.end(), [](const SheetRow& r) {
        return figure(*r.figures, "width").null();
      });
      sheet.expect(std::atol(words[2].c_str()) == unknown, "text: region unknown", words[2],
                   std::to_string(unknown), "");
    } else if (is_name(words[0]) && table == Table::kPoints && words.size() >= 10) {
      now->point(words);
    } else if (is_name(words[0]) && table == Table::kSegments && words.size() == 12) {
      now->segment(words);
    }
  }
  sheet.expect(user.rows() > 0, "text: region rows", static_cast<Real>(user.rows()), 1.0L, "");
}

void check_region_csv(const Worksheet& worksheet, const std::string& csv, Sheet& sheet) {
  const std::vector<std::string> lines = lines_of(csv);
  if (lines.empty()) return sheet.fails("region CSV", "a table", "nothing", "");
  const std::vector<std::string> names = cells_of_line(lines[0]);
  std::size_t user = 0, finer = 0;
  for (std::size_t l = 1; l < lines.size(); ++l) {
    const std::vector<std::string> cells = cells_of_line(lines[l]);
    if (cells.size() != names.size()) {
      sheet.fails("region CSV", lines[l], fmt::format("{} cells", cells.size()), "");
      continue;
    }
    const bool first = cells[0] == "points";
    const SheetPart& part = first ? worksheet.user : worksheet.last();
    std::size_t& at = first ? user : finer;
    if (at >= part.points.size()) {
      sheet.fails("region CSV", "a point more", std::to_string(part.points.size()), lines[l]);
      continue;
    }
    const std::size_t i = at++;
    const SheetPoint& p = part.points[i];
    const auto row = std::find_if(part.rows.begin(), part.rows.end(),
                                  [i](const SheetRow& r) { return r.from == i; });
    std::map<std::string, std::optional<double>> wanted;
    wanted["x"] = p.stored.x;
    wanted["y"] = p.stored.y;
    if (p.adjacent_kappa) wanted["adjacent_radius"] = 1.0 / *p.adjacent_kappa;
    const Turned turned(p);
    wanted["heading_deg"] = turned.degrees(p.heading);
    if (p.headings) {
      wanted["heading_min_deg"] = turned.degrees(p.headings->low);
      wanted["heading_max_deg"] = turned.degrees(p.headings->high);
    }
    const auto at_least = std::find(names.begin(), names.end(), "least_radius");
    const auto place = static_cast<std::size_t>(at_least - names.begin());
    const auto [least, greatest] = radii_of(p.kappas, place < cells.size() ? cells[place] : "");
    wanted["least_radius"] = least;
    wanted["greatest_radius"] = greatest;
    if (row != part.rows.end()) {
      const std::pair<const char*, const char*> all[] = {{"chord", "chord"},
                                                         {"points_only_error", "points_only_error"},
                                                         {"to_apex", "to_apex"},
                                                         {"from_apex", "from_apex"},
                                                         {"h", "lower_height"},
                                                         {"delta", "width"},
                                                         {"H", "chord_apex_height"},
                                                         {"Ht", "tangent_apex_height"},
                                                         {"Delta", "chord_apex_gap"},
                                                         {"Delta_t", "tangent_apex_gap"},
                                                         {"Delta_t_bound", "tangent_convex_bound"},
                                                         {"f", "spline_distance"}};
      for (const auto& [column, name] : all) wanted[column] = figure(*row->figures, name).value;
    }
    for (std::size_t k = 0; k < names.size(); ++k) {
      const std::string& name = names[k];
      if (name == "series" || name == "row") continue;
      if (name == "point") {
        sheet.expect(cells[k] == p.name(), "region CSV: point", cells[k], p.name(), "");
      } else if (name == "segment") {
        const std::string segment = row == part.rows.end() ? "" : part.name(*row);
        sheet.expect(cells[k] == segment, "region CSV: segment", cells[k], segment, "");
      } else if (name == "heading") {
        const std::string how = p.heading_given ? "given" : "chosen";
        sheet.expect(cells[k] == how, "region CSV: heading is", cells[k], how, p.name());
      } else {
        // a heading near 0 is a difference of turns
        const bool angle = name.ends_with("_deg");
        const bool any = !p.kappas && ((name == "least_radius" && cells[k] == "0") ||
                                       (name == "greatest_radius" && cells[k].ends_with("inf")));
        const bool nowhere =
            any || (name.ends_with("_apex") && cells[k].ends_with("inf") && !wanted[name]);
        const bool ok = same_number(cells[k], wanted[name]) || nowhere ||
                        (angle && wanted[name] && !cells[k].empty() &&
                         std::abs(std::strtod(cells[k].c_str(), nullptr) - *wanted[name]) < 1e-11);
        sheet.expect(ok, "region CSV: " + name, cells[k],
                     wanted[name] ? shown(*wanted[name]) : std::string("empty"), p.name());
      }
    }
  }
  sheet.expect(user == worksheet.user.points.size(), "region CSV: rows", static_cast<Real>(user),
               static_cast<Real>(worksheet.user.points.size()), "");
  const std::size_t more = worksheet.refined ? worksheet.refined->points.size() : 0;
  sheet.expect(finer == more, "region CSV: rows", static_cast<Real>(finer), static_cast<Real>(more),
               "refined");
}

}  // namespace judge
