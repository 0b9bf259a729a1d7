// SPDX-License-Identifier: Apache-2.0
// The page of a report and the picture in it: every figure against the contour file.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "sentences.h"
#include "texts.h"

namespace judge {
namespace {

std::string unescaped(std::string text) {
  const std::pair<const char*, const char*> kEntities[] = {{"&lt;", "<"},    {"&gt;", ">"},
                                                           {"&quot;", "\""}, {"&#39;", "'"},
                                                           {"&apos;", "'"},  {"&amp;", "&"}};
  for (const auto& [entity, character] : kEntities) {
    for (std::size_t at = 0; (at = text.find(entity, at)) != std::string::npos; ++at) {
      text.replace(at, std::string(entity).size(), character);
    }
  }
  return text;
}

/// "2.5·10⁻³" as "2.5e-3", "10⁻³" as "1e-3".
std::string without_powers(std::string text) {
  static const std::regex kAlone(" 10(⁻|⁰|¹|²|³|⁴|⁵|⁶|⁷|⁸|⁹)");
  text = std::regex_replace(text, kAlone, " 1e$1");
  const std::pair<const char*, const char*> kSigns[] = {
      {"·10", "e"}, {"⁻", "-"}, {"⁰", "0"}, {"¹", "1"}, {"²", "2"}, {"³", "3"},
      {"⁴", "4"},   {"⁵", "5"}, {"⁶", "6"}, {"⁷", "7"}, {"⁸", "8"}, {"⁹", "9"}};
  for (const auto& [sign, plain] : kSigns) {
    for (std::size_t at = 0; (at = text.find(sign)) != std::string::npos;) {
      text.replace(at, std::string(sign).size(), plain);
    }
  }
  return text;
}

/// What stands between two marks; empty without them.
std::string text_between(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t a = text.find(from);
  if (a == std::string::npos) return {};
  const std::size_t b = text.find(to, a + from.size());
  if (b == std::string::npos) return {};
  return text.substr(a + from.size(), b - a - from.size());
}

/// Cells of the rows of a table, headings among them.
std::vector<std::vector<std::string>> table_of(const std::string& page, const std::string& id) {
  static const std::regex kCell(R"(<t[hd][^>]*>([^<]*)</t[hd]>)");
  std::vector<std::vector<std::string>> rows;
  for (const std::string& row :
       split(text_between(page, "<table id=\"" + id + "\"", "</table>"), "<tr>")) {
    std::vector<std::string> cells;
    for (std::sregex_iterator it(row.begin(), row.end(), kCell), end; it != end; ++it) {
      cells.push_back(unescaped((*it)[1].str()));
    }
    if (!cells.empty()) rows.push_back(std::move(cells));
  }
  return rows;
}

class PageCheck {
 public:
  PageCheck(const Course& course, const std::string& page, Sheet& sheet)
      : course_(course),
        file_(course.file),
        report_(course.file.report),
        certificate_(course.file.certificate),
        page_(page),
        sheet_(sheet) {}

  void run() {
    if (!page_.starts_with("<svg")) tables();
    picture();
  }

 private:
  void tables() {
    std::string told = "points\n\nlengths in " + file_.printed_unit() + "\n\npoints\n\n";
    const auto figures = table_of(page_, "figures");
    if (figures.empty()) return sheet_.fails("page", "no table of figures", "one", "");
    for (const auto& row : figures) {
      if (row.size() != 2 || !own(row[0], row[1])) told += row[0] + "  " + row.back() + "\n";
    }
    told +=
        unescaped(text_between(text_between(page_, "<p id=\"verdict\"", "/p>"), ">", "<")) + "\n";
    Run text;
    text.out = told;
    text.input_name = "points";
    check_fit_text(course_, text, sheet_);
    lines_and_arcs();
    segments();
  }

  void is(const std::string& what, const std::string& printed, std::optional<double> value) {
    sheet_.expect(prints(printed, value), "page: " + what, printed,
                  value ? shown(*value) : std::string("-"), "");
  }
  void is_text(const std::string& what, const std::string& stated, const std::string& value) {
    sheet_.expect(stated == value, "page: " + what, stated, value, "");
  }
  /// "0.12 mm" or "unknown".
  void length(const std::string& what, const std::string& printed, const Figure& value) {
    if (printed.starts_with("unknown")) {
      sheet_.expect(!value.known(), "page: " + what, printed, shown(value.value.value_or(0.0)), "");
      return;
    }
    const std::vector<std::string> words = words_of(printed);
    is(what, words.at(0), value.value);
    is_text(what + " unit", words.size() > 1 ? words[1] : "", file_.printed_unit());
  }
  double count(const Json& of, const char* name) const {
    return figure(of, name).value.value_or(0.0);
  }

  /// Rows whose words are not those of the printed report.
  bool own(const std::string& label, const std::string& value) {
    const Json& given = member(report_, "given");
    const Sentence s = sentence_of(value, file_.printed_unit());
    const auto figure_at = [&](std::size_t i) { return i < s.figures.size() ? s.figures[i] : ""; };
    if (label == "contour") {  // "9 pieces through 10 points, 1 joint free between them in 2 runs"
      is("pieces", figure_at(0), static_cast<double>(file_.pieces.size()));
      is("points", figure_at(1), static_cast<double>(file_.points.size()));
      is("runs", s.figures.empty() ? "" : s.figures.back(), static_cast<double>(file_.runs.size()));
    } else if (label == "carrier") {
      is_text("carrier", value, file_.carrier);
    } else if (label == "lengths in") {
      is_text("unit", value, file_.printed_unit());
    } else if (label == "asked for") {
      sheet_.expect(value.starts_with("obvid fit"), "page: asked for", value, "obvid fit ...", "");
    } else if (label == "vertices") {
      is("vertices", figure_at(0), figure(report_, "vertices").value);
      is("bound", figure_at(1), figure(report_, "vertices_lower_bound").value);
    } else if (label == "inflections") {
      is("inflections", figure_at(0), figure(report_, "inflections").value);
    } else if (label == "largest move of a point") {
      length("largest move", value, figure(report_, "largest_move"));
    } else if (label == "largest width of the region") {
      length("largest width", value.substr(0, value.find(" (")), figure(report_, "largest_width"));
      is("tolerance", s.figures.empty() ? "" : s.figures.back(),
         figure(report_, "tolerance").value);
    } else if (label == "largest error with these tangents and curvatures") {
      length("largest error", value, figure(report_, "largest_deviation"));
    } else if (label == "from the spirals, as measured") {
      length("from the spirals", value, figure(report_, "carrier_deviation"));
    } else if (label == "given headings met") {
      is("given headings", figure_at(0), count(given, "headings") + count(given, "heading_ranges"));
      is("heading miss", figure_at(1), figure(given, "heading_miss").value);
    } else if (label == "given radii met") {
      is("given radii", figure_at(0),
         count(given, "curvatures") + count(given, "curvature_ranges"));
      is("curvature miss", figure_at(1), figure(given, "curvature_miss").value);
    } else if (label == "given corners met") {
      is("given corners", figure_at(0), figure(given, "corners").value);
    } else if (label == "corners") {
      is("corners", figure_at(0), figure(certificate_, "corners").value);
    } else {
      return false;
    }
    return true;
  }

  void lines_and_arcs() {
    LinesAndArcsTable table(course_, sheet_);
    for (auto cells : table_of(page_, "lines")) {
      if (cells.size() == 7 && cells[4].ends_with("°")) {
        cells[4].resize(cells[4].size() - std::string("°").size());
        table.row(cells);
      } else {
        static const std::vector<std::string> kHead = {
            "points",           "radius", "centre x",      "centre y",
            "heading at start", "length", "farthest point"};
        sheet_.expect(cells == kHead, "page: columns of lines and arcs", cells.back(), kHead.back(),
                      "");
      }
    }
    table.end();
  }

  void segments() {
    const Json& rows = member(report_, "segments");
    auto printed = table_of(page_, "segments");
    static const std::vector<std::string> kHead = {
        "points",       "chord",         "points-only error",
        "region width", "largest error", "inserted elements"};
    if (printed.empty() || printed.front() != kHead) {
      return sheet_.unjudged("page: segments", "columns");
    }
    printed.erase(printed.begin());
    std::map<std::string, std::size_t> named;
    if (course_.parts.size() != rows.size()) {
      return sheet_.unjudged("page: segments", "rows do not lead from point to point");
    }
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const Part& part = course_.parts[k];
      named[fmt::format("{}-{}", part.from_point + 1, part.to_point + 1)] = k;
    }
    const std::string whole = text_between(page_, "<caption>Segments", "</caption>");
    if (whole.empty()) {
      is("segments", std::to_string(printed.size()), static_cast<double>(rows.size()));
    } else {  // ", the 1000 widest of 2345"
      const Sentence s = sentence_of(whole, "");
      is("segments", s.figures.empty() ? "" : s.figures.back(), static_cast<double>(rows.size()));
    }
    for (const auto& cells : printed) {
      const auto at = named.find(cells[0]);
      if (at == named.end() || cells.size() != kHead.size()) {
        sheet_.fails("page: segments", cells[0], "no such row", "");
        continue;
      }
      const Json& row = rows[at->second];
      is("chord", cells[1], figure(row, "chord").value);
      is("points-only error", cells[2], figure(row, "points_only_error").value);
      is("width", cells[3], figure(row, "width").value);
      is("deviation", cells[4], figure(row, "deviation").value);
      is("inserted", cells[5], figure(row, "inserted").value);
    }
  }

  void picture() {
    static const std::regex kLabel(
        R"re(<text [^>]*class="(fact|verdict [a-z]+)"[^>]*>([^<]*)</text>)re");
    for (std::sregex_iterator it(page_.begin(), page_.end(), kLabel), end; it != end; ++it) {
      const std::string text = unescaped((*it)[2].str());
      if ((*it)[1].str() != "fact") {
        const bool proved = flag(certificate_, "proved").value_or(false);
        sheet_.expect(text.starts_with("✓") == proved, "picture: verdict", text,
                      proved ? "proved" : "not proved", "");
        continue;
      }
      for (const std::string& fact : split(text, " · ")) pictured(fact);
    }
  }

  void pictured(const std::string& fact) {
    const Sentence s = sentence_of(without_powers(fact), file_.printed_unit());
    const std::string first = s.figures.empty() ? "" : s.figures[0];
    if (s.shape == "# vertex (at least # unless a curve winds)") {
      is("picture vertices", first, figure(report_, "vertices").value);
      is("picture bound", s.figures[1], figure(report_, "vertices_lower_bound").value);
    } else if (s.shape == "# inflection") {
      is("picture inflections", first, figure(report_, "inflections").value);
    } else if (s.shape == "# point") {
      is("picture points", first, static_cast<double>(file_.points.size()));
    } else if (s.shape == "# piece") {
      is("picture pieces", first, static_cast<double>(file_.pieces.size()));
    } else if (s.shape == "# corner") {
      is("picture corners", first, figure(certificate_, "corners").value);
    } else if (s.shape == "point at most # U from the contour") {
      const auto move = figure(certificate_, "largest_move").value;
      sheet_.expect(bounds(first, move), "page: picture largest move", first,
                    move ? shown(*move) : std::string("-"), "");
    } else if (s.shape == "region width # U") {
      is("picture width", first, figure(report_, "largest_width").value);
    } else if (!s.figures.empty()) {
      sheet_.unjudged("picture", s.shape);
    }
  }

  const Course& course_;
  const ContourFile& file_;
  const Json& report_;
  const Json& certificate_;
  const std::string& page_;
  Sheet& sheet_;
};

}  // namespace

void check_page(const Course& course, const std::string& page, Sheet& sheet) {
  PageCheck(course, page, sheet).run();
}

}  // namespace judge
