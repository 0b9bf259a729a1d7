// SPDX-License-Identifier: Apache-2.0
// The texts of `fit` and `verify`.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <regex>
#include <string>

#include "sentences.h"
#include "texts.h"

namespace judge {
namespace {

/// What is printed without being a claim, or is history that nobody can check.
bool is_idle(const Fact& fact) { return fact.label == "time" || fact.label == "written"; }

bool has_figure(const Sentence& sentence) {
  return std::any_of(sentence.figures.begin(), sentence.figures.end(),
                     [](const std::string& f) { return f != "-"; });
}

class TextCheck {
 public:
  TextCheck(const Course& course, const Run& run, Sheet& sheet)
      : course_(course),
        file_(course.file),
        run_(run),
        sheet_(sheet),
        report_(course.file.report),
        certificate_(course.file.certificate),
        orders_(orders_of(course.file, course.joints)) {}

  void fit() {
    enum class At { kSegments, kLinesAndArcs, kSentences } at = At::kSegments;
    LinesAndArcsTable shapes(course_, sheet_);
    for (const std::string& line : lines_of(run_.out)) {
      if (line == run_.input_name) continue;
      if (line.empty()) {
        if (!header_.empty()) at = At::kSentences;
        continue;
      }
      const std::vector<std::string> words = row_words(line);
      const bool row = is_row_name(words[0]) || words[0] == "...";
      if (line.starts_with("line or arc ")) at = At::kLinesAndArcs;
      if (at == At::kLinesAndArcs && line.starts_with("shown: ")) {
        shapes.count(sentence_of(line, file_.printed_unit()));
      } else if (at == At::kLinesAndArcs) {
        row ? shapes.row(words) : shapes.header(line);
      } else if (at == At::kSegments && row) {
        if (words[0] != "...") segment_row(words);
      } else if (at == At::kSegments && (line[0] == ' ' || words[0] == "points")) {
        header(words);
      } else {
        sentence(line, "fit");
      }
    }
    shapes.end();
    verdict_must_name_gaps();
    const double crossings = figure(certificate_, "self_intersections").value.value_or(0.0);
    say(tells_crossings_ == (crossings > 0.0), "self-intersections are told", "", crossings);
  }

  void verify() {
    for (const std::string& line : lines_of(run_.out)) {
      if (line.empty() || line == run_.input_name) continue;
      const std::vector<std::string> words = words_of(line);
      if (line[0] == ' ' || words[0] == "piece" || words[0] == "...") {
        piece_row(words);
      } else {
        sentence(line, "verify");
      }
    }
  }

 private:
  /// "all, from 5" of a whole circle is one word.
  static std::vector<std::string> row_words(const std::string& line) {
    std::vector<std::string> words = words_of(line);
    if (words.size() > 2 && words[0] == "all," && words[1] == "from") {
      words[2] = "all, from " + words[2];
      words.erase(words.begin(), words.begin() + 2);
    }
    return words;
  }

  static bool is_row_name(const std::string& word) {
    if (word.starts_with("all, from ")) return true;
    const std::size_t dash = word.find('-');
    return dash != std::string::npos && dash > 0 && dash + 1 < word.size() &&
           word.find_first_not_of("0123456789-") == std::string::npos;
  }

  void say(bool ok, const std::string& what, const std::string& printed,
           std::optional<double> value) {
    sheet_.expect(ok, "text: " + what, printed, value ? shown(*value) : std::string("-"), "");
  }
  void figure_is(const std::string& what, const std::string& printed, std::optional<double> value) {
    say(prints(printed, value), what, printed, value);
  }
  void count_is(const std::string& what, const Sentence& s, std::size_t i, double value) {
    say(s.number(i) == value, what, i < s.figures.size() ? s.figures[i] : "", value);
  }

  void header(const std::vector<std::string>& words) {
    for (const std::string& word : words) header_ += word + " ";
  }

  /// Row i-j: points, chord, points-only error, width, inserted, pieces, radii at both ends.
  void segment_row(const std::vector<std::string>& words) {
    static const std::string kHead =
        "points-only region inserted radius radius points chord error width elements pieces "
        "at start at end ";
    std::string head;
    for (const std::string& word : words_of(header_)) {
      if (word != "...") head += word + " ";
    }
    if (words.size() != 8 || !same_words(head, kHead)) {
      return sheet_.unjudged("text: table", "columns: " + head);
    }
    const Json& rows = member(report_, "segments");
    if (rows.size() != course_.parts.size()) {
      return sheet_.unjudged("text: table", "rows do not lead from point to point");
    }
    const std::size_t k = row_of(words[0]);
    if (k == course_.parts.size()) {
      return sheet_.fails("text: table", words[0], "no such row", "");
    }
    figure_is("table chord", words[1], figure(rows[k], "chord").value);
    figure_is("table points-only error", words[2], figure(rows[k], "points_only_error").value);
    figure_is("table width", words[3], figure(rows[k], "width").value);
    figure_is("table inserted", words[4], figure(rows[k], "inserted").value);
    const Part& part = course_.parts[k];
    const bool joints = part.from == std::floor(part.from) && part.to == std::floor(part.to);
    if (words[5] != "-") {
      say(joints &&
              std::strtod(words[5].c_str(), nullptr) == static_cast<double>(part.to - part.from),
          "table pieces", words[5], static_cast<double>(part.to - part.from));
    }
    const double chord = figure(rows[k], "chord").value.value_or(0.0);
    radius(words[6], part.from, part.from_point, chord, true);
    radius(words[7], part.to, part.to_point, chord, false);
  }
  /// The part that leads between the points of a row's name.
  [[nodiscard]] std::size_t row_of(const std::string& name) const {
    for (std::size_t k = 0; k < course_.parts.size(); ++k) {
      const Part& part = course_.parts[k];
      if (name == fmt::format("{}-{}", part.from_point + 1, part.to_point + 1)) return k;
    }
    for (std::size_t k = 0; k < course_.parts.size(); ++k) {
      const Part& part = course_.parts[k];
      // the last chord of a closed series goes on counting
      if (part.to_point == 0 &&
          name == fmt::format("{}-{}", part.from_point + 1, part.from_point + 2)) {
        return k;
      }
    }
    return course_.parts.size();
  }
  static bool same_words(const std::string& a, const std::string& b) {
    std::vector<std::string> x = words_of(a), y = words_of(b);
    std::sort(x.begin(), x.end());
    std::sort(y.begin(), y.end());
    return x == y;
  }
  /// A radius is printed as "straight" where a line as long as the chord would be within a
  /// hundredth of the least tolerance of all points, or 1e-9 of the size (docs/formats.md).
  void radius(const std::string& printed, Real order, std::size_t point, double chord,
              bool leaving) {
    if (printed == "-") return;
    // no line leads from a point around to itself
    const double flat = chord > 0.0 ? 8.0 * straight_within() / (chord * chord) : 0.0;
    const FileElement* e =
        order == std::floor(order) ? file_.joint(static_cast<std::size_t>(order)) : nullptr;
    if (e == nullptr || !(e->source || e->parted())) {
      return radius_beside(printed, order, point, flat);
    }
    const double kappa = leaving && e->parted() ? e->kappa_out : e->kappa;
    say(radius_of(printed, kappa, flat), "table radius", printed, kappa == 0.0 ? 0.0 : 1.0 / kappa);
  }
  /// At the limit, to the last digits, either is right.
  static bool radius_of(const std::string& printed, double kappa, double flat) {
    constexpr double kDigits = 1e-9;
    if (printed == "straight") return std::abs(kappa) <= flat * (1.0 + kDigits);
    return std::abs(kappa) >= flat * (1.0 - kDigits) && prints(printed, 1.0 / kappa);
  }
  [[nodiscard]] double straight_within() const {
    double tolerance = file_.tolerance.empty() ? 0.0 : HUGE_VAL;
    for (const double one : file_.tolerance) tolerance = std::min(tolerance, one);
    Vec low{HUGE_VALL, HUGE_VALL}, high{-HUGE_VALL, -HUGE_VALL};
    for (const Point p : file_.points) {
      const Vec q = seen(p, course_.origin);
      low = {std::min(low.x, q.x), std::min(low.y, q.y)};
      high = {std::max(high.x, q.x), std::max(high.y, q.y)};
    }
    return std::max(1e-2 * tolerance, static_cast<double>(1e-9L * norm(high - low)));
  }
  /// At a point that is no joint: of a place that rounding of the coordinates does not tell from
  /// the nearest one (docs/claims.md), as doubles evaluate it.
  void radius_beside(const std::string& printed, Real order, std::size_t point, double limit) {
    // distances from a point at D differ by s^2 / (2 D): doubles do not tell them apart below
    constexpr Real kRoundings = 4.0L * 0x1p-52L;
    const Real away = norm(course_.path.at(order) - seen(file_.points[point], course_.origin));
    const Real flat = std::sqrt(2.0L * away * kRoundings * course_.ends.coordinate);
    auto [least, most] = course_.curvatures_near(order, std::max(course_.resolution(), flat));
    const Real blur = course_.curvature_rounding(order);
    least -= blur;
    most += blur;
    if (printed == "straight") {
      return say(least <= limit && most >= -limit, "table radius", printed,
                 static_cast<double>(1.0L / least));
    }
    const double kappa = 1.0 / std::strtod(printed.c_str(), nullptr);
    const bool may_bend = least < -limit || most > limit;
    say(may_bend && ((kappa >= least && kappa <= most) ||
                     prints(printed, static_cast<double>(1.0L / least)) ||
                     prints(printed, static_cast<double>(1.0L / most))),
        "table radius", printed, static_cast<double>(1.0L / least));
  }

  void piece_row(const std::vector<std::string>& words) {
    if (words[0] == "piece" || words[0] == "...") return;
    const std::size_t i = std::strtoul(words[0].c_str(), nullptr, 10) - 1;
    const Json& list = member(certificate_, "monotone");
    if (words.size() < 3 || i >= file_.pieces.size() || i >= list.size()) {
      return sheet_.unjudged("text: verify table", "columns");
    }
    sheet_.expect(words[1] == type_name(file_.pieces[i]), "text: verify type", words[1],
                  std::string(type_name(file_.pieces[i])), "piece " + words[0]);
    sheet_.expect(words[2] == text_of(list[i], "verdict"), "text: verify curvature", words[2],
                  text_of(list[i], "verdict"), "piece " + words[0]);
  }

  void sentence(const std::string& line, const std::string& command) {
    const auto fact = fact_of(line);
    if (!fact) return plain(line, command);
    if (is_idle(*fact) || fact->label == "note") return;
    if (fact->label == "given data") return given(*fact);
    if (fact->label == "at an end") return at_an_end(*fact);
    for (const std::string& part : split(fact->value, "; ")) {
      judge(fact->label, sentence_of(part, file_.printed_unit()), command);
    }
  }

  void plain(const std::string& line, const std::string& command) {
    const Sentence s = sentence_of(line, file_.printed_unit());
    if (line.starts_with("lengths in ")) {
      const std::string unit = line.substr(11, line.find_first_of(";,", 11) - 11);
      sheet_.expect(unit == file_.printed_unit(), "text: unit", unit, file_.printed_unit(), "");
    } else if (line.starts_with("shown: ")) {
      const Json& rows = member(report_, command == "fit" ? "segments" : "none");
      if (rows.is_array()) count_is("rows", s, s.figures.size() - 1, double(rows.size()));
    } else if (line.starts_with("proved") || line.starts_with("NOT")) {
      verdict(line);
    } else if (has_figure(s)) {
      sheet_.unjudged("text: " + command, s.shape);
    }
  }

  void verdict(const std::string& line) {
    verdict_ = line;
    const bool proved = flag(certificate_, "proved").value_or(false);
    sheet_.expect(line.starts_with("proved") == proved, "text: verdict", line,
                  proved ? "proved" : "not proved", "");
    // behind them comes what the reason says
    if (!line.starts_with("NOT proved")) joints_said(line.substr(0, line.find("): ")));
    if (!line.starts_with("proved")) {
      const std::string reason = text_of(certificate_, "reason");
      const bool named = line.find(reason) != std::string::npos;
      if (!named) sheet_.unjudged("text: verdict", sentence_of(line, file_.printed_unit()).shape);
      return;
    }
    slope_step(line, figure(member(certificate_, "joint_gaps"), "slope"));
  }

  /// "G3 joints between 4 corners but for 2 that are G2 and 1 that is G1 with a step", "corners
  /// alone", "no joints": the most continuous joints that there are, and how many are less so.
  void joints_said(const std::string& line) {
    static const std::regex kJoints(R"(G([123]) joints|no joints|(corners|a corner) alone)");
    const char* claim = "text: joints";
    std::smatch found;
    if (!std::regex_search(line, found, kJoints)) {
      return sheet_.unjudged(claim, sentence_of(line, file_.printed_unit()).shape);
    }
    const JointOrders& own = orders_;
    const int said = found[1].matched ? std::stoi(found[1].str()) : 0;
    const std::string tally = fmt::format("{} corners, {} steps, {} G1, {} G2, {} G3", own.corners,
                                          own.steps, own.g1, own.g2, own.g3);
    const bool alone = own.all() > 0 ? found[2].matched : found[0].str() == "no joints";
    sheet_.expect(said == own.highest() && (said > 0 || alone), claim, line, tally, "");
    if (said == 0) return;
    says_count(line, claim, " between ", R"(joints.* between (\d+) corner)", own.corners);
    says_count(line, claim, " G1 with a ", R"((\d+) that (?:is|are) G1 with)",
               own.highest() > 1 ? own.steps : 0);
    says_count(line, claim, " G2", R"((\d+) that (?:is|are) G2)", said == 3 ? own.g2 : 0,
               said == 2 ? "G2 joints" : "");
  }

  /// Words with a count are there when there is one to tell, and not otherwise. `besides`: where
  /// the words stand for something else.
  void says_count(std::string line, const char* claim, const char* words, const char* counted,
                  int count, const std::string& besides = "") {
    const std::string whole = line;
    const std::size_t other = besides.empty() ? std::string::npos : line.find(besides);
    if (other != std::string::npos) line.erase(0, other + besides.size());
    std::smatch found;
    const bool told = std::regex_search(line, found, std::regex(counted));
    const bool right = count > 0 ? told && std::stoi(found[1].str()) == count
                                 : line.find(words) == std::string::npos;
    sheet_.expect(right, claim, whole, fmt::format("{}:{}", count, words), "");
  }

  /// Corners that stand on no point, with the points on both sides.
  void corners_between(const Sentence& s) {
    constexpr std::size_t kMostNamed = 8;
    std::vector<double> due;
    for (const FileElement& e : file_.elements) {
      if (!e.between) continue;
      due.push_back(static_cast<double>(e.between->first + 1));
      due.push_back(static_cast<double>(e.between->second + 1));
    }
    const std::size_t count = due.size() / 2, named = std::min(count, kMostNamed);
    count_is("corners between points", s, 0, static_cast<double>(count));
    say(s.figures.size() == 1 + 2 * named + (count > named ? 1U : 0U), "corners between points",
        "places", static_cast<double>(count));
    for (std::size_t k = 0; k < 2 * named; ++k) {
      count_is("corners between points", s, k + 1, due[k]);
    }
  }

  /// The points at or before joints that are said to step.
  void slope_steps_beside(const Sentence& s) {
    constexpr std::size_t kMostNamed = 8;
    std::vector<std::size_t> beside;
    std::optional<std::size_t> last;
    for (std::size_t i = 0; i < file_.pieces.size() + (file_.closed ? 0U : 1U); ++i) {
      const FileElement* e = file_.joint(i);
      if (e == nullptr) continue;
      if (e->source) last = static_cast<std::size_t>(*e->source);
      if (e->between) last = e->between->first;
      if (!e->slope_step || !last) continue;
      if (beside.empty() || beside.back() != *last) beside.push_back(*last);
    }
    const bool more = beside.size() > kMostNamed;
    const std::size_t named = std::min(beside.size(), kMostNamed);
    say(s.figures.size() == named + (more ? 1U : 0U), "slope steps", "places",
        static_cast<double>(beside.size()));
    for (std::size_t k = 0; k < named; ++k) {
      count_is("slope steps", s, k, static_cast<double>(beside[k] + 1));
    }
    if (more) count_is("slope steps", s, named, static_cast<double>(beside.size() - named));
  }

  /// The largest step of the slope is told.
  void slope_step(const std::string& line, const Figure& stated) {
    const char* claim = "text: verdict of slopes";
    const std::string told = " (the slope of curvature steps by ";
    const std::size_t at = line.find(told);
    const bool steps = stated.value.value_or(0.0) > 0.0;
    if ((at != std::string::npos) != steps) {
      return sheet_.fails(claim, line, steps ? "the step of the slope" : "no step of the slope",
                          "");
    }
    if (!steps) return;
    const std::size_t from = at + told.size();
    const std::string printed = line.substr(from, line.find(' ', from) - from);
    sheet_.expect(prints(printed, stated.value), claim, printed, shown(*stated.value), "");
  }

  /// docs/claims.md: the verdict names the gaps when either exceeds 1e-9.
  void verdict_must_name_gaps() {
    if (verdict_.empty() || !verdict_.starts_with("proved")) return;
    constexpr double kNamed = 1e-9;
    const Json& gaps = member(certificate_, "joint_gaps");
    const double heading = figure(gaps, "heading").value.value_or(0.0);
    const double curvature =
        file_.carrier == "arcs" ? 0.0 : figure(gaps, "curvature").value.value_or(0.0);
    if (heading <= kNamed && curvature <= kNamed) return;
    const Sentence s = sentence_of(verdict_, file_.printed_unit());
    const bool named = file_.continuity == "G3"  // which has a figure of its own
                           ? verdict_.find(" rad of heading") != std::string::npos
                           : has_figure(s);
    sheet_.expect(named, "text: verdict names gaps", verdict_,
                  fmt::format("heading {:.3g}, curvature {:.3g}", heading, curvature), "");
  }

  /// "at point 5 the greatest heading, at point 10 the least curvature"
  void at_an_end(const Fact& fact) {
    const Json& active = member(member(report_, "given"), "active");
    std::string expected;
    for (const Json& one : active) {
      expected += fmt::format("{}at point {:.0f} the {} {}", expected.empty() ? "" : ", ",
                              figure(one, "point").value.value_or(-1.0) + 1.0, text_of(one, "end"),
                              text_of(one, "datum"));
    }
    if (expected.empty()) expected = "none: the contour lies inside all ranges";
    sheet_.expect(fact.value == expected, "text: at an end", fact.value, expected, "");
  }

  /// "2 headings and 1 radius met; largest miss 1e-12 rad and 2e-11 of the curvature"
  void given(const Fact& fact) {
    const Json& report = member(report_, "given");
    for (const std::string& part : split(fact.value, "; ")) {
      const Sentence s = sentence_of(part, file_.printed_unit());
      const bool misses = s.shape.starts_with("largest miss");
      std::size_t at = 0;
      for (std::size_t i = 0; i < s.figures.size(); ++i, ++at) {
        at = s.shape.find('#', at);
        const std::string behind = s.shape.substr(at);
        const auto is = [&](const char* words) { return behind.starts_with(words); };
        const char* name = misses            ? (is("# rad") ? "heading_miss" : "curvature_miss")
                           : is("# heading") ? "headings"
                           : is("# radius") || is("# curvature") ? "curvatures"
                           : is("# corner")                      ? "corners"
                                                                 : "";
        const Figure value = figure(report, name);
        if (!misses && is("# range")) {
          figure_is("given ranges", s.figures[i],
                    figure(report, "heading_ranges").value.value_or(0.0) +
                        figure(report, "curvature_ranges").value.value_or(0.0));
        } else if (!value.present) {
          sheet_.unjudged("text: given data", s.shape);
        } else {
          figure_is(std::string("given ") + name, s.figures[i], value.value);
        }
      }
    }
  }

  struct Largest {
    std::optional<double> value;
    std::vector<std::size_t> rows;
  };
  [[nodiscard]] static std::size_t unknown_rows(const Json& rows, const char* name) {
    std::size_t count = 0;
    for (std::size_t k = 0; rows.is_array() && k < rows.size(); ++k) {
      count += figure(rows[k], name).known() ? 0 : 1;
    }
    return count;
  }
  [[nodiscard]] Largest largest(const char* name) const {
    Largest out;
    const Json& rows = member(report_, "segments");
    for (std::size_t k = 0; rows.is_array() && k < rows.size(); ++k) {
      const Figure f = figure(rows[k], name);
      if (!f.known()) continue;
      if (!out.value || *f.value > *out.value) out = {f.value, {}};
      if (*f.value == *out.value) out.rows.push_back(k);
    }
    if (name == std::string_view("points_only_error") && out.value == 0.0 &&
        unknown_rows(rows, name) > 0) {
      return {};  // lines and circles alone say nothing of what lies between them
    }
    return out;
  }

  void error(const Sentence& s, const char* name, const char* what) {
    const Largest most = largest(name);
    figure_is(std::string("largest error ") + what, s.figures.at(0), most.value);
    if (s.figures.size() < 3 || !most.value) return;
    const bool named = std::any_of(most.rows.begin(), most.rows.end(), [&](std::size_t k) {
      return k < course_.parts.size() &&
             s.number(1) == static_cast<double>(course_.parts[k].from_point + 1);
    });
    if (course_.parts.size() != member(report_, "segments").size()) return;
    say(named, std::string("largest error place ") + what, s.figures[1],
        static_cast<double>(most.rows.front() + 1));
  }

  /// Of a largest error that is one of some segments the number of the others is told.
  void open_rows(const Sentence& s, std::size_t unknown) {
    const bool told = s.shape.find("unknown over # segment") != std::string::npos;
    if (s.figures.size() < 3) return;  // 0 everywhere: no segment is named
    say(told ? s.number(3) == static_cast<double>(unknown) : unknown == 0,
        "largest error unknown over", told ? s.figures[3] : "none", static_cast<double>(unknown));
  }

  void gaps(const Sentence& s, std::size_t count) {
    const Json& gaps = member(certificate_, "joint_gaps");
    const char* names[] = {"position", "heading", "curvature", "slope"};
    for (std::size_t i = 0; i < count; ++i) {
      figure_is(std::string("joint gaps ") + names[i], s.figures.at(i),
                figure(gaps, names[i]).value);
    }
    // a figure of slopes where there is a joint that has one
    say((count == 4) == (orders_.g3 > 0), "joint gaps slope", count == 4 ? s.figures[3] : "none",
        orders_.g3);
  }

  void judge(const std::string& label, const Sentence& s, const std::string& command) {
    const std::string key = label + ": " + s.shape;
    const auto count = [](std::size_t n) { return static_cast<double>(n); };
    if (key == "contour: # piece through # point in # run" ||
        key == "contour: # piece through # point, # joint free between them in # run") {
      count_is("contour pieces", s, 0, count(file_.pieces.size()));
      count_is("contour points", s, 1, count(file_.points.size()));
      count_is("contour runs", s, s.figures.size() - 1, count(file_.runs.size()));
      if (s.figures.size() == 4) {
        count_is("contour free joints", s, 2,
                 figure(member(report_, "chain"), "free_elements").value.value_or(0.0));
      }
    } else if (key ==
               "fairness: # vertex (curvature extrema, at least # unless a curve winds between the "
               "point), # "
               "inflection") {
      figure_is("fairness vertices", s.figures[0], figure(report_, "vertices").value);
      figure_is("fairness bound", s.figures[1], figure(report_, "vertices_lower_bound").value);
      figure_is("fairness inflections", s.figures[2], figure(report_, "inflections").value);
    } else if (key == "largest error: unknown from the point alone") {
      say(!largest("points_only_error").value, "largest error from the points", "unknown",
          largest("points_only_error").value);
    } else if (key.starts_with("largest error: # U from the point alone")) {
      error(s, "points_only_error", "from the points");
      open_rows(s, unknown_rows(member(report_, "segments"), "points_only_error"));
    } else if (key == "largest error: unknown with these tangents and curvature") {
      say(!largest("deviation").value, "largest error with tangents", "unknown",
          largest("deviation").value);
    } else if (key.starts_with("largest error: # U with these tangents and curvature")) {
      error(s, "deviation", "with tangents");
    } else if (key == "largest width: unknown (tolerance #)") {
      say(figure(report_, "largest_width").null(), "largest width", "unknown",
          figure(report_, "largest_width").value);
      figure_is("tolerance", s.figures[0], figure(report_, "tolerance").value);
    } else if (key == "largest width: # U (tolerance #)") {
      figure_is("largest width", s.figures[0], figure(report_, "largest_width").value);
      figure_is("tolerance", s.figures[1], figure(report_, "tolerance").value);
    } else if (key == "bound needed: # inserted element") {
      figure_is("inserted", s.figures[0], figure(report_, "inserted_points").value);
    } else if (key.starts_with("from the spirals: at most # U (measured), tolerance #")) {
      figure_is("from the spirals", s.figures[0], figure(report_, "carrier_deviation").value);
      figure_is("tolerance", s.figures[1], figure(report_, "tolerance").value);
    } else if (key == "from the spirals: # U as measured, # outside their region" ||
               key == "from the spirals: # U as measured, inside their region") {
      figure_is("from the spirals", s.figures[0], figure(report_, "carrier_deviation").value);
      const Figure outside = figure(report_, "outside_spirals_region");
      if (s.figures.size() == 2) {
        figure_is("outside their region", s.figures[1], outside.value);
      } else {
        say(outside.value == 0.0, "outside their region", "inside", outside.value);
      }
    } else if (key == "waviness: # hills of the slope of curvature on a run") {
      figure_is("waviness", s.figures[0], figure(report_, "waviness").value);
    } else if (key.starts_with("as G2 contour: the slope of curvature would step by #")) {
      const Json& chain = member(report_, "chain");
      figure_is("as G2 contour step", s.figures[0], figure(chain, "slope_step_g2").value);
      if (s.figures.size() == 2) {
        figure_is("as G2 contour waviness", s.figures[1], figure(chain, "waviness_g2").value);
      }
    } else if (key.starts_with("G2 because: ")) {
      say(file_.continuity == "G2", "G2 because", file_.continuity, std::nullopt);
    } else if (key.starts_with("slope steps: beside point")) {
      slope_steps_beside(s);
    } else if (key == "largest move: # U") {
      figure_is("largest move", s.figures[0], figure(report_, "largest_move").value);
    } else if (key ==
               "joint gaps: position # of the size, heading # rad, curvature # of the larger") {
      gaps(s, 3);
    } else if (key ==
               "joint gaps: position # of the size, heading # rad, curvature # of the larger, "
               "slope "
               "of curvature #") {
      gaps(s, 4);
    } else if (key == "joint gaps: position # of the size, heading # rad, curvature unknown") {
      gaps(s, 2);
      say(figure(member(certificate_, "joint_gaps"), "curvature").null(), "joint gaps curvature",
          "unknown", figure(member(certificate_, "joint_gaps"), "curvature").value);
    } else if (key == "joint gaps: position # of the size, heading # rad") {
      gaps(s, 2);
    } else if (key == "joint gaps: curvature steps up to # (arcs)") {
      figure_is("joint gaps curvature", s.figures[0],
                figure(member(certificate_, "joint_gaps"), "curvature").value);
    } else if (key == "report claims: # vertex, # inflection, largest width unknown") {
      figure_is("report claims", s.figures[0], figure(report_, "vertices").value);
      figure_is("report claims", s.figures[1], figure(report_, "inflections").value);
      say(figure(report_, "largest_width").null(), "report claims", "unknown",
          figure(report_, "largest_width").value);
    } else if (key == "report claims: # vertex, # inflection, largest width # U") {
      figure_is("report claims", s.figures[0], figure(report_, "vertices").value);
      figure_is("report claims", s.figures[1], figure(report_, "inflections").value);
      figure_is("report claims", s.figures[2], figure(report_, "largest_width").value);
    } else if (label == "file claims") {
      return;  // words of the file, judged with `fit`
    } else if (label == "curvature") {
      verdict_counts(s);
    } else if (label == "vertices" || label == "inflections" || label == "corners") {
      figure_is("verify " + label, s.figures.empty() ? "" : s.figures[0],
                figure(certificate_, label.c_str()).value);
    } else if (label == "corners between") {
      corners_between(s);
    } else if (label == "self-intersections") {
      tells_crossings_ = true;
      figure_is(command + " " + label, s.figures.empty() ? "" : s.figures[0],
                figure(certificate_, "self_intersections").value);
    } else if (s.shape == "yes" || s.shape == "no") {
      yes_no(label, s.shape == "yes");
    } else if (has_figure(s)) {
      sheet_.unjudged("text: " + command, key);
    }
  }

  void yes_no(const std::string& label, bool yes) {
    const char* name = label == "gaps within bounds"   ? "gaps_within_bounds"
                       : label == "through all points" ? "through_points"
                       : label == "inside the region"  ? "inside_region"
                                                       : "";
    const auto stated = label == "closed" ? std::optional(file_.closed) : flag(certificate_, name);
    if (!stated) return sheet_.unjudged("text: verify", label);
    sheet_.expect(yes == *stated, "text: verify " + label, yes ? "yes" : "no",
                  *stated ? "yes" : "no", "");
  }

  void verdict_counts(const Sentence& s) {
    std::map<std::string, double> counts;
    for (const Json& one : member(certificate_, "monotone")) ++counts[text_of(one, "verdict")];
    const std::vector<std::string> parts = split(s.shape, ", ");
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const std::string verdict = parts[i].substr(std::min<std::size_t>(2, parts[i].size()));
      say(s.number(i) == counts[verdict == "has-vertex" ? verdict : verdict], "verify verdicts",
          i < s.figures.size() ? s.figures[i] : "", counts[verdict]);
    }
  }

  const Course& course_;
  const ContourFile& file_;
  const Run& run_;
  Sheet& sheet_;
  const Json& report_;
  const Json& certificate_;
  JointOrders orders_;
  std::string header_, verdict_;
  bool tells_crossings_ = false;
};

/// Members of `a` that `b` has too must be the same.
void same_json(const Json& a, const Json& b, const std::string& path, Sheet& sheet) {
  const std::string claim = "fit --json equals the file";
  if (a.kind != b.kind || a.size() != b.size() || a.text != b.text || a.boolean != b.boolean) {
    return sheet.fails(claim, a.text.empty() ? "another kind or size" : a.text,
                       b.text.empty() ? "another kind or size" : b.text, path);
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::string name = a.is_object() ? a.names[i] : std::to_string(i);
    if (name == "seconds" || name == "chain") continue;
    if (a.is_object() && !b.contains(name)) {
      sheet.fails(claim, name, "not in the file", path);
      continue;
    }
    same_json(a[i], a.is_object() ? b.at(name) : b[i], path + "/" + name, sheet);
  }
  if (path.empty()) sheet.holds(claim);
}

std::string promise_of(const ContourFile& file) {
  return file.too_wide()        ? "a width beyond the tolerance"
         : file.keeps_promise() ? "a promise that is kept"
                                : "a promise that is broken";
}

}  // namespace

void check_fit_text(const Course& course, const Run& run, Sheet& sheet) {
  TextCheck(course, run, sheet).fit();
}

void check_verify_text(const Course& course, const Run& run, Sheet& sheet, int fit_code) {
  const std::string stated = fmt::format("exit {}: {}", run.code, run.err.substr(0, 200));
  const bool kept = course.file.keeps_promise();
  sheet.expect(run.code == (kept ? 0 : 5), "verify: exit code", stated, promise_of(course.file),
               "");
  sheet.expect(fit_code < 0 || run.code == fit_code, "verify agrees with fit", stated,
               fmt::format("fit ended with {}", fit_code), "");
  TextCheck(course, run, sheet).verify();
}

void check_fit_json(const Course& course, const Run& run, Sheet& sheet) {
  const ReadJson read = read_json(run.out);
  if (!read.fault.empty()) return sheet.fails("fit --json", "JSON", read.fault, "");
  const ContourFile& file = course.file;
  const Json& json = read.value;
  sheet.expect(text_of(json, "units") == file.units, "fit --json units", text_of(json, "units"),
               file.units, "");
  sheet.expect(text_of(json, "units_source") == file.units_source, "fit --json units_source",
               text_of(json, "units_source"), file.units_source, "");
  sheet.expect(figure(json, "points").value == static_cast<double>(file.points.size()),
               "fit --json points", figure(json, "points").value.value_or(-1.0),
               static_cast<double>(file.points.size()), "");
  sheet.expect(figure(json, "pieces").value == static_cast<double>(file.pieces.size()),
               "fit --json pieces", figure(json, "pieces").value.value_or(-1.0),
               static_cast<double>(file.pieces.size()), "");
  same_json(member(json, "report"), file.report, "", sheet);
  same_json(member(json, "certificate"), file.certificate, "", sheet);
}

void check_named_points(const Run& run, std::size_t points, Sheet& sheet) {
  static const std::regex kNamed(R"(\bpoints? (\d+)(?:(?: to | and |-)(\d+))?)");
  for (std::sregex_iterator it(run.err.begin(), run.err.end(), kNamed), end; it != end; ++it) {
    for (const std::size_t group : {1U, 2U}) {
      if (!(*it)[group].matched) continue;
      const std::string number = (*it)[group].str();
      const bool there =
          number.size() < 10 && std::stoul(number) >= 1 && std::stoul(number) <= points;
      sheet.expect(there, "named points", number, fmt::format("1 to {}", points),
                   run.err.substr(0, 200));
    }
  }
}

void check_exit(const Course* course, const Run& run, Sheet& sheet) {
  const std::string claim = "exit code";
  const std::string stated = fmt::format("exit {}", run.code);
  if (course == nullptr) {
    // a tolerance that a carrier or a format cannot keep is 5 (docs/cli.md), and nothing is written
    const bool not_kept = run.code == 5 && run.err.find("error E502: ") != std::string::npos;
    const bool refusal = (run.code >= 2 && run.code <= 4) || not_kept;
    sheet.expect(refusal && !run.err.empty(), claim, stated,
                 std::string("no contour was written, and the code or the message do not say why"),
                 run.err.substr(0, 200));
    return;
  }
  const ContourFile& file = course->file;
  const bool kept = file.keeps_promise();
  sheet.expect(run.code == (kept ? 0 : 5), claim, stated, promise_of(file), "");
}

void check_advised(const Run& refused, const ContourFile& advised, Sheet& sheet) {
  std::smatch found;
  const std::regex counts("with (\\d+) vert\\S+ and (\\d+) inflections? there is one");
  if (std::regex_search(refused.err, found, counts)) {
    for (const auto& [name, printed] :
         {std::pair{"vertices", found[1].str()}, std::pair{"inflections", found[2].str()}}) {
      const Figure count = figure(advised.report, name);
      const double said = std::strtod(printed.c_str(), nullptr);
      sheet.expect(count.value == said, std::string("refusal: ") + name, printed,
                   shown(count.value.value_or(-1.0)), "of the contour that is advised");
    }
  }
  // point, x, y, move: the farthest first
  const Json& moves = member(advised.report, "moves");
  bool table = false;
  double before = std::numeric_limits<double>::infinity();
  for (const std::string& line : lines_of(refused.out)) {
    table = table || line.starts_with("points that would have to move");
    const std::vector<std::string> words = words_of(line);
    const std::size_t i = words.size() == 4 ? std::strtoul(words[0].c_str(), nullptr, 10) : 0;
    if (!table || i == 0) continue;
    if (i > advised.points.size() || i > moves.size()) {
      sheet.fails("refusal: moves", words[0], "no such point", "");
      continue;
    }
    const double move = moves[i - 1].number;
    const Point p = advised.points[i - 1];
    sheet.expect(
        prints(words[1], p.x) && prints(words[2], p.y) && prints(words[3], move) && move <= before,
        "refusal: moves", line, fmt::format("{:.9g}, {:.9g} moves by {:.9g}", p.x, p.y, move),
        "of the contour that is advised");
    before = move;
  }
}

}  // namespace judge
