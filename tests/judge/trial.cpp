// SPDX-License-Identifier: Apache-2.0
#include "trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <regex>

#include "checks.h"
#include "process.h"
#include "program_runs.h"
#include "sentences.h"
#include "series.h"
#include "texts.h"

namespace judge {
namespace {

/// The accuracy of lengths that STEP files state, m.
constexpr Real kStepAccuracy = 1e-10L;

class Work : public ProgramRuns {
 public:
  Work(const TrialOptions& options, std::uint64_t index)
      : ProgramRuns(options, index),
        series_(make_series(options.seed, index)),
        dice_(options.seed * 31 + index * 7 + 1),
        page_dice_(options.seed * 31 + index * 7 + 2) {
    out_.family = series_.family;
    out_.points = series_.points;
  }

  Trial run() {
    write_file(path(kPoints), series_.text);
    Input input = read_input(series_.text, series_.options);
    input.truth = series_.truth;
    const Run fit = program("fit", fit_words());
    fit_code_ = fit.code;
    if (stopped_) return std::move(out_);
    const double start = own_seconds();
    check_named_points(fit, series_.points, out_.sheet);
    const std::string stored = text_of_file(path("c.json"));
    if (stored.empty()) {
      refusal(fit, input);
    } else {
      contour(stored, fit, input);
    }
    if (!stopped_ && dice_.chance(0.2)) analyse(input);
    out_.judge_seconds = own_seconds() - start;
    if (!stopped_) classify(stored.empty());
    return std::move(out_);
  }

 private:
  std::vector<std::string> fit_words() {
    std::vector<std::string> words{"fit", kPoints};
    words.insert(words.end(), series_.options.begin(), series_.options.end());
    words.insert(words.end(), {"-o", "c.json"});
    for (const char* other : {"c.step", "c.nc", "c.dxf"}) {
      if (!dice_.chance(0.1)) continue;
      words.insert(words.end(), {"-o", other});
      exports_.emplace_back(other);
    }
    for (const char* page : {"c.html", "c.svg"}) {
      if (!page_dice_.chance(0.1)) continue;
      words.insert(words.end(), {"-o", page});
      exports_.emplace_back(page);
    }
    return words;
  }

  void contour(const std::string& stored, const Run& fit, const Input& input) {
    const ReadContour read = read_contour(stored);
    if (!read.fault.empty()) {
      out_.sheet.fails("file", "a contour file", read.fault, "c.json");
      return;
    }
    const Course course(read.contour);
    Sheet& sheet = out_.sheet;
    judge_course(course, sheet);
    check_input(course, input, sheet);
    check_truth(course, input, sheet);
    told_options(course, fit, input);
    check_fit_text(course, fit, sheet);
    check_exit(&course, fit, sheet);
    exports(course, fit);
    others(course);
  }

  /// A contour that stays G2 although G3 was asked for says why; the scatter is told as it is used.
  void told_options(const Course& course, const Run& fit, const Input& input) {
    if (input.continuity == "G3" && course.file.continuity != "G3") {
      const bool said =
          fit.out.find("G2 because") != std::string::npos ||
          fit.err.find("not proved, so this one is G2") != std::string::npos ||
          std::regex_search(fit.err, std::regex(R"(was found at (\d+) of \1 joints)"));
      out_.sheet.expect(said, "continuity", course.file.continuity,
                        std::string("G3 was asked for, and nothing says why not"), "");
    }
    std::smatch found;
    const std::regex scatter(R"(points may move (\S+) \S+, (\S+) times their scatter of (\S+) )");
    if (!input.automatic) return;
    if (!std::regex_search(fit.err, found, scatter)) {
      return out_.sheet.fails("noise auto", "a contour", "nothing is told of the scatter", "");
    }
    const double told = std::stod(found[1].str());
    const double product = std::stod(found[2].str()) * std::stod(found[3].str());
    constexpr double kPrinted = 0.01;  // three digits of the factor
    out_.sheet.expect(std::abs(told - product) <= kPrinted * told, "noise auto", told, product,
                      "times the scatter");
    const double reach = input.noise.value_or(0.0);
    std::vector<Vec> points;
    for (const GivenPoint& p : input.points) points.push_back(seen(p.point, course.origin));
    const auto own = reach_of_scatter(points, rounding_of_places(input));
    constexpr double kDigits = 1e-3;  // four are printed
    out_.sheet.expect(
        own && told >= own->least * (1.0 - kDigits) && told <= reach * (1.0 + kDigits),
        "noise auto", told, reach, "by the residuals of the points");
  }

  void exports(const Course& course, const Run& fit) {
    for (const std::string& file : exports_) {
      const std::string text = text_of_file(path(file));
      if (text.empty()) {
        out_.sheet.fails("export", file, "not written", fit.err.substr(0, 200));
        continue;
      }
      check_export(course, file, text, notes_of(fit.out, file), out_.sheet);
    }
  }

  void others(const Course& course) {
    if (dice_.chance(0.5)) {
      const Run verify = program("verify", {"verify", "c.json"});
      if (stopped_) return;
      check_verify_text(course, verify, out_.sheet, fit_code_);
    }
    if (dice_.chance(0.2)) {
      std::vector<std::string> words{"fit", kPoints, "--json"};
      words.insert(words.end(), series_.options.begin(), series_.options.end());
      const Run json = program("fit --json", words);
      if (stopped_) return;
      check_fit_json(course, json, out_.sheet);
    }
    // it forms all carriers again and again, to time them
    if (dice_.chance(0.02) && series_.points < 60) compare(course);
    if (!stopped_ && dice_.chance(0.1)) convert(course);
  }

  void compare(const Course& course) {
    std::vector<std::string> words{"compare", kPoints};
    for (std::size_t i = 0; i < series_.options.size(); ++i) {
      if (series_.options[i] == "--carrier") {
        ++i;
      } else if (series_.options[i] != "--primitives") {
        words.push_back(series_.options[i]);
      } else {
        return;  // compare has no such option
      }
    }
    const Run text = program("compare", words);
    if (stopped_) return;
    words.emplace_back("--json");
    const Run json = program("compare --json", words);
    if (stopped_ || json.code != 0) return;
    check_compare(json, text, course, out_.sheet);
  }

  /// To another format, and back to a contour.
  void convert(const Course& course) {
    static const char* kOthers[] = {"d.step", "d.dxf", "d.nc", "d.json"};
    const std::string other = kOthers[dice_.whole(0, 3)];
    const Run there = program("convert", {"convert", "c.json", "-o", other});
    if (stopped_) return;
    if (there.code != 0) {
      out_.sheet.unjudged("convert", fmt::format("exit {}", there.code), there.err.substr(0, 160));
      return;
    }
    const std::string text = text_of_file(path(other));
    if (other == "d.json") return back(course, text, 0.0, true);
    check_export(course, other, text, notes_of(there.out, other), out_.sheet);
    if (other == "d.nc") return;
    const bool approximate = there.out.find("follows them") != std::string::npos ||
                             there.out.find("at most") != std::string::npos;
    const Run again = program("convert", {"convert", other, "-o", "e.json"});
    if (stopped_ || approximate) return;
    if (again.code != 0) {
      out_.sheet.fails("convert back", other, fmt::format("exit {}", again.code),
                       again.err.substr(0, 200));
      return;
    }
    // an entity as short as drawings are exact is not told from a gap: then another one is named
    const std::string told = again.out + again.err;
    const bool left = told.find(" was taken") != std::string::npos &&
                      told.find(" of 1 was taken") == std::string::npos;
    if (told.find(" on others and w") != std::string::npos) {
      return out_.sheet.unjudged("convert back", "a piece that lies on another one was taken once");
    }
    // farther from the origin than STEP is exact edges are apart, which is told
    const double unit = metres_of(course.file.units).value_or(1.0);
    const Real rounding = 0x1p-52L * course.ends.coordinate * static_cast<Real>(unit);
    if (left && told.find("an edge apart") != std::string::npos && rounding > kStepAccuracy) {
      return out_.sheet.unjudged("convert back", "edges far from the origin came back apart");
    }
    // STEP must have a unit, assumed or not; DXF states none that nobody said
    back(course, text_of_file(path("e.json")), left ? 1e-6 : 1e-9, other == "d.dxf");
  }

  void back(const Course& course, const std::string& text, double part, bool unit_kept) {
    const ReadContour read = read_contour(text);
    if (!read.fault.empty()) {
      out_.sheet.fails("convert back", "a contour", read.fault, "");
      return;
    }
    if (unit_kept && metres_of(course.file.units)) {  // others are no unit of a drawing
      out_.sheet.expect(read.contour.unit_known() == course.file.unit_known(), "convert back unit",
                        read.contour.units_source, course.file.units_source, "");
    }
    const auto mine = metres_of(course.file.units), other = metres_of(read.contour.units);
    if ((mine.has_value() != other.has_value()) && part > 0.0) {
      out_.sheet.unjudged("convert back", "comes back in " + read.contour.units);
      return;
    }
    // in another unit it is the same curve, larger or smaller
    const double factor = mine && other ? *other / *mine : 1.0;
    std::vector<Span> spans;
    for (const Piece& piece : read.contour.pieces) {
      spans.emplace_back(factor == 1.0 ? piece : scaled(piece, factor), course.origin);
    }
    if (spans.empty()) return out_.sheet.fails("convert back", "a curve", "no pieces", "");
    const Path path(std::move(spans));
    // STEP says how exact it is: kernels leave shorter edges out
    const bool step = !unit_kept && mine;
    const Real edge = step ? kStepAccuracy / static_cast<Real>(*mine) : 0.0L;
    const auto shorter =
        std::count_if(course.path.spans().begin(), course.path.spans().end(),
                      [&](const Span& s) { return norm(s.point(1.0L) - s.point(0.0L)) < edge; });
    const Real accuracy = edge * std::max<Real>(1.0L, static_cast<Real>(shorter));
    const Real limit = std::max(static_cast<Real>(part) * course.ends.size, accuracy) +
                       4e-15L * course.ends.coordinate + course.resolution() * 1e-3L;
    Real most = 0.0L;
    const int count = 200;
    for (int k = 0; k <= count; ++k) {
      const Vec p = course.path.at(course.path.end() * k / count);
      most = std::max(most, path.nearest(p).distance);
    }
    out_.sheet.expect(most <= limit, "convert back", limit, most, "farthest place");
  }

  void analyse(const Input& input) {
    const Input plain = read_input(series_.text, without_placement(series_.options));
    std::vector<std::string> words{"analyse", kPoints};
    if (input.units_given) words.insert(words.end(), {"--units", input.units});
    const Run text = program("analyse", words);
    if (stopped_ || text.code != 0) return;
    const Run json = program("analyse --json", {"analyse", kPoints, "--json"});
    if (stopped_ || json.code != 0) return;
    check_analyse(plain, json, text, out_.sheet);
  }

  void refusal(const Run& fit, const Input& input) {
    check_exit(nullptr, fit, out_.sheet);
    for (const std::string& file : exports_) {
      const bool untouched = text_of_file(path(file)).empty();
      out_.sheet.expect(untouched, "refusal leaves files untouched", file,
                        untouched ? "nothing" : "written", "");
    }
    range_of_a_datum(fit.err, input);
    if (dice_.chance(0.25)) advised_tolerance(fit, input);
  }

  /// What `--scale` makes of lengths of the file.
  [[nodiscard]] double scale() const {
    const auto& words = series_.options;
    const auto option = std::find(words.begin(), words.end(), "--scale");
    return option == words.end() ? 1.0 : std::strtod(std::next(option)->c_str(), nullptr);
  }

  /// The same job within another tolerance; "rounding" too.
  Run within(const std::string& tolerance, bool open, bool widened, const std::string& output) {
    std::string points = kPoints;
    if (widened) {
      points = "widened.csv";
      write_file(
          path(points),
          with_tolerances_from(series_.text, std::strtod(tolerance.c_str(), nullptr) / scale()));
    }
    std::vector<std::string> words{"fit", points, "--quiet"};
    for (std::size_t i = 0; i < series_.options.size(); ++i) {
      if (series_.options[i] == "--noise") {
        ++i;
      } else {
        words.push_back(series_.options[i]);
      }
    }
    words.insert(words.end(), {"--noise", tolerance});
    if (open) words.emplace_back("--open");
    if (!output.empty()) words.insert(words.end(), {"-o", output});
    return program("fit", words);
  }

  /// "within ... there is one: OPTION", "with 2 vertices and 1 inflection there is one ...: OPTION
  /// allows them": there must be, with these counts and the moves of the table; and none where none
  /// was found.
  void advised_tolerance(const Run& fit, const Input& input) {
    std::smatch found;
    const std::regex advice(
        "there is one(?:, with [^:]*)?: --noise ([^\\s,;]+)( --open)?(?: allows them)?"
        "( and no smaller tolerance of a point)?");
    if (!std::regex_search(fit.err, found, advice)) {
      const std::regex nowhere("none was found either within a tolerance of (\\S+) ");
      if (std::regex_search(fit.err, found, nowhere)) {
        const Point first = input.points.front().point, last = input.points.back().point;
        const double size = diagonal_of(input);
        const double apart = std::hypot(last.x - first.x, last.y - first.y);
        // ends that meet, or nearly, are left to the series: whether it is closed is its own matter
        if (apart < 0.3 * size) {
          return out_.sheet.unjudged("refusal: none was found within a tolerance",
                                     "ends nearly meet");
        }
        refuses_within(found[1], false, input);
      }
      return;
    }
    const std::string tolerance = found[1];
    const bool open = found[2].matched;
    const Run again = within(tolerance, open, found[3].matched, "advised.json");
    if (stopped_) return;
    if (!out_.sheet.expect(again.code == 0, "refusal: within a tolerance there is one", tolerance,
                           fmt::format("exit {}: {}", again.code, again.err.substr(0, 200)), "")) {
      return;
    }
    const ReadContour read = read_contour(text_of_file(path("advised.json")));
    if (!read.fault.empty()) return out_.sheet.fails("file", "a contour", read.fault, "advised");
    check_advised(fit, read.contour, out_.sheet);
    const std::regex none("Within (\\S+) \\S+ none was found");
    if (std::regex_search(fit.out, found, none)) {
      refuses_within(found[1], open, input);
    }
  }

  /// `open`: larger tolerances do not close a series that is open without them.
  void refuses_within(const std::string& tolerance, bool open, const Input& input) {
    const double t = std::strtod(tolerance.c_str(), nullptr);
    const bool own =
        std::any_of(input.points.begin(), input.points.end(),
                    [t](const GivenPoint& p) { return p.tolerance && *p.tolerance < t; });
    const Run again = within(tolerance, open, own, "");
    if (stopped_) return;
    out_.sheet.expect(again.code != 0, "refusal: none was found within a tolerance", tolerance,
                      std::string("there is one"), "");
  }

  static double diagonal_of(const Input& input) {
    double lx = HUGE_VAL, ly = HUGE_VAL, hx = -HUGE_VAL, hy = -HUGE_VAL;
    for (const GivenPoint& p : input.points) {
      lx = std::min(lx, p.point.x);
      ly = std::min(ly, p.point.y);
      hx = std::max(hx, p.point.x);
      hy = std::max(hy, p.point.y);
    }
    return std::hypot(hx - lx, hy - ly);
  }

  /// "with a heading of A or B deg at point I there is one": with both there must be. "between A
  /// and B": with what lies in the middle, too.
  void range_of_a_datum(const std::string& said, const Input& input) {
    std::smatch found;
    const std::regex sentence(
        "with a (heading|curvature) (of|between) (\\S+) (?:or|and) (\\S+) \\S+ at point (\\d+)");
    if (stopped_ || !std::regex_search(said, found, sentence)) return;
    const std::string at = found[1] == "heading" ? "--heading-at" : "--kappa-at";
    std::vector<std::string> values{found[3].str(), found[4].str()};
    if (found[2] == "between") {
      values.push_back(fmt::format("{}", 0.5 * (std::stod(values[0]) + std::stod(values[1]))));
    }
    for (const std::string& value : values) {
      std::vector<std::string> words{"fit", kPoints, "--quiet"};
      for (const std::string& word :
           without_datum(series_.options, found[1] == "heading", std::stoul(found[5].str()),
                         input.points.size())) {
        words.push_back(word);
      }
      words.push_back(fmt::format("{}={}={}", at, found[5].str(), value));
      const Run again = program("fit", words);
      if (stopped_) return;
      out_.sheet.expect(again.code == 0, "refusal: with another datum there is one", words.back(),
                        fmt::format("exit {}: {}", again.code, again.err.substr(0, 200)), "");
    }
  }

  void classify(bool refused) {
    if (out_.sheet.wrong() > 0) {
      out_.outcome = refused && out_.sheet.has("exit code") ? Trial::Outcome::kBadRefusal
                                                            : Trial::Outcome::kFalse;
    } else if (refused) {
      out_.outcome = Trial::Outcome::kRefused;
    }
  }

  Series series_;
  Dice dice_;
  Dice page_dice_;  ///< of its own: what is drawn for a seed stays the same
  std::vector<std::string> exports_;
  int fit_code_ = 0;
};

}  // namespace

const char* name_of(Trial::Outcome outcome) {
  constexpr const char* kNames[] = {"fine",    "false sentence", "crash",
                                    "timeout", "refused",        "refused without reason"};
  return kNames[static_cast<int>(outcome)];
}

Trial run_trial(const TrialOptions& options, std::uint64_t index) {
  if (options.of == "space") return run_space_trial(options, index);
  if (options.of == "nurbs") return run_nurbs_trial(options, index);
  if (options.of == "spline") return run_grid_trial(options, index);
  if (options.of == "region") return run_region_trial(options, index);
  if (options.of == "scan") return run_scan_trial(options, index);
  return Work(options, index).run();
}

void judge_contour(const std::string& text, Sheet& sheet) {
  const ReadContour read = read_contour(text);
  if (!read.fault.empty()) return sheet.fails("file", "a contour file", read.fault, "");
  judge_course(Course(read.contour), sheet);
}

void judge_course(const Course& course, Sheet& sheet) {
  check_form(course, sheet);
  check_certificate(course, sheet);
  check_report(course, sheet);
  check_given_list(course, sheet);
}

}  // namespace judge
