// SPDX-License-Identifier: Apache-2.0
// Trials of `region`: worksheets, constructions, and what its ranges promise.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "checks.h"
#include "course.h"
#include "heading_reach.h"
#include "process.h"
#include "program_runs.h"
#include "region_checks.h"
#include "series.h"

namespace judge {
namespace {


std::string all_digits(Real value) { return fmt::format("{:.17g}", static_cast<double>(value)); }

/// A number as a user writes it, and what it says then.
struct Written {
  std::string text;
  Real value = 0.0L;

  Written(Real wanted, int digits)
      : text(fmt::format("{:.{}g}", static_cast<double>(wanted), digits)),
        value(std::strtod(text.c_str(), nullptr)) {}
};

class RegionTrial : public ProgramRuns {
 public:
  RegionTrial(const TrialOptions& options, std::uint64_t index)
      : ProgramRuns(options, index), dice_(options.seed * 91 + index * 23 + 11) {}

  Trial run() {
    make();
    Input input = read_input(text_, given_);
    share_closing_point(input);
    const Run table = region({}, "t");
    if (stopped_) return std::move(out_);
    const double start = own_seconds();
    const std::string stored = text_of_file(path("t.json"));
    if (stored.empty()) {
      check_exit(nullptr, table, out_.sheet);
      out_.outcome = Trial::Outcome::kRefused;
    } else {
      judge_table(stored, table, input);
    }
    out_.judge_seconds = own_seconds() - start;
    if (out_.sheet.wrong() > 0 && !stopped_) out_.outcome = Trial::Outcome::kFalse;
    return std::move(out_);
  }

 private:
  // the series

  void make() {
    Shape shape = make_shape(dice_);
    const bool known = dice_.chance(0.75);
    while (shape.points.size() > 40 || (known && !shape.truth) || shape.points.size() < 3) {
      shape = make_shape(dice_);
    }
    if (dice_.chance(0.08)) shape = dice_.chance(0.4) ? three_points() : two_points();
    out_.family = shape.family;
    const Real size = size_of(shape.points);
    const double wanted =
        dice_.chance(0.5) ? dice_.logarithmic(1.0, 1000.0) : dice_.logarithmic(1e-9, 1e9);
    scale_ = wanted / size;
    turn_ = dice_.chance(0.3) ? 0.0L : static_cast<Real>(dice_.between(0.0, 6.28));
    if (dice_.chance(0.15)) {
      const double away = wanted * (dice_.chance(0.7) ? 1e3 : 1e6);
      offset_ = {away * dice_.unit(), away * dice_.unit()};
    }
    write(shape);
    choose_options(shape);
  }

  static Real size_of(const std::vector<Vec>& points) {
    Vec low = points.front(), high = low;
    for (const Vec p : points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    return std::max(norm(high - low), 1e-30L);
  }

  static Shape two_points() {
    Shape out;
    out.family = "two points";
    out.points = {{0.0L, 0.0L}, {1.0L, 0.0L}};
    return out;
  }

  /// On a circle, or on a line, as any three.
  Shape three_points() {
    Shape out;
    out.family = "three points";
    const Real high = dice_.chance(0.2) ? 0.0L : Real{dice_.between(-0.6, 0.6)};
    out.points = {{0.0L, 0.0L}, {Real{dice_.between(0.6, 1.4)}, high}, {2.0L, 0.0L}};
    return out;
  }

  [[nodiscard]] Vec moved(Vec p) const {
    const Vec u = unit_at(turn_);
    return scale_ * Vec{u.x * p.x - u.y * p.y, u.y * p.x + u.x * p.y} + offset_;
  }

  /// Of the known curve, or across the neighbours; rad.
  [[nodiscard]] Real heading_of(const Shape& shape, std::size_t i) {
    const auto& p = shape.points;
    if (p.size() == 2) {
      // either side of the chord, mostly with more turn at one end
      const Real turn = static_cast<Real>(dice_.between(0.05, 1.2)) * (two_sign_ ? 1.0L : -1.0L);
      return turn_ + (i == 0 ? turn : -turn);
    }
    Vec along = p[std::min(i + 1, p.size() - 1)] - p[i > 0 ? i - 1 : 0];
    if (shape.truth) {
      const std::vector<Real>& t = shape.truth->parameters;
      const Real step = 1e-6L * (t.back() - t.front()) / static_cast<Real>(t.size());
      along = shape.truth->at(t[i] + step) - shape.truth->at(t[i] - step);
    }
    return turn_ + std::atan2(along.y, along.x);
  }

  void write(const Shape& shape) {
    const std::size_t n = shape.points.size();
    two_sign_ = dice_.chance(0.5);
    const bool all = n == 2 || dice_.chance(0.12), some = dice_.chance(0.2);
    const int digits = dice_.chance(0.2) ? dice_.whole(6, 9) : 17;
    text_ = all || some ? "x,y,heading_deg\n" : "x,y\n";
    for (std::size_t i = 0; i < n; ++i) {
      const Vec p = moved(shape.points[i]);
      text_ += Written(p.x, digits).text + "," + Written(p.y, digits).text;
      if (all || some) text_ += ",";
      if (all || (some && dice_.chance(0.25))) {
        text_ += Written(heading_of(shape, i) / kDegree, 12).text;
      }
      text_ += "\n";
    }
    out_.points = n;
    write_file(path(kPoints), text_);
  }

  void choose_options(const Shape& shape) {
    if (shape.closed && dice_.chance(0.8)) given_.emplace_back("--closed");
    if (dice_.chance(0.06)) given_.emplace_back("--convex");
    if (dice_.chance(0.2)) {
      unit_ = "in";
      add(given_, "--units", unit_);
    }
    if (dice_.chance(0.5)) {
      static const char* kRules[] = {"fair", "centre", "neighbours", "least-change",
                                     "least-curvature"};
      rule_ = kRules[dice_.whole(0, 4)];
    }
    const auto n = static_cast<int>(shape.points.size());
    const double within = dice_.unit();
    if (within < 0.25) {
      for (int k = dice_.whole(1, 2); k > 0; --k) {
        add(inserts_, "--insert", std::to_string(dice_.whole(1, n - 1)));
      }
    } else if (within < 0.35) {
      const double t = static_cast<double>(scale_ * size_of(shape.points));
      tolerance_ = fmt::format("{:.3g}", t * dice_.logarithmic(1e-5, 1e-2));
      add(given_, "--tolerance", tolerance_);
    }
    static const char* kNames[] = {"arcs", "ellipses", "clothoids", "spline", "parabolas"};
    if (dice_.chance(0.6)) construction_ = kNames[dice_.whole(0, 4)];
  }
  static void add(std::vector<std::string>& to, const std::string& name,
                  const std::string& value) {
    to.push_back(name);
    to.push_back(value);
  }

  // runs

  Run region(const std::vector<std::string>& more, const std::string& name) {
    std::vector<std::string> words{"region", kPoints};
    for (const std::vector<std::string>* list : {&std::as_const(given_), &std::as_const(inserts_), &more}) {
      words.insert(words.end(), list->begin(), list->end());
    }
    if (!rule_.empty()) add(words, "--prefer", rule_);
    add(words, "-o", name + ".json");
    for (const char* ending : {".csv", ".tex", ".dxf", ".svg"}) add(words, "-o", name + ending);
    return program("region", words);
  }

  void judge_table(const std::string& stored, const Run& table, const Input& input) {
    Sheet& sheet = out_.sheet;
    sheet.expect(table.code == 0, "region exit code", table.code, 0.0L, table.err.substr(0, 200));
    Worksheet worksheet;
    read_worksheet(stored, worksheet);
    if (!worksheet.fault.empty()) {
      return sheet.fails("file", "a worksheet", worksheet.fault, "t.json");
    }
    check_worksheet(worksheet, input, rule_ == "neighbours", sheet);
    check_region_text(worksheet, table.out, sheet);
    check_region_csv(worksheet, text_of_file(path("t.csv")), sheet);
    check_region_tex(worksheet, text_of_file(path("t.tex")), sheet);
    check_region_drawings(worksheet, input, text_of_file(path("t.dxf")),
                          text_of_file(path("t.svg")), unit_, sheet);
    if (!construction_.empty()) construct(input);
    if (!stopped_ && dice_.chance(0.6)) probe(worksheet.user, input);
  }

  // constructions

  void construct(const Input& input) {
    Sheet& sheet = out_.sheet;
    const Run made = region({"--construction", construction_}, "k");
    if (stopped_) return;
    const std::string stored = text_of_file(path("k.json"));
    if (stored.empty()) return check_exit(nullptr, made, sheet);
    Worksheet worksheet;
    read_worksheet(stored, worksheet);
    if (!worksheet.fault.empty()) {
      return sheet.fails("file", "a worksheet", worksheet.fault, "k.json");
    }
    check_construction(worksheet, input, construction_, sheet);
    check_construction_text(worksheet, made.out, sheet);
    check_construction_csv(worksheet, text_of_file(path("k.csv")), sheet);
    if (worksheet.refined || rule_ == "neighbours") return;
    std::vector<std::string> words{"fit", kPoints};
    words.insert(words.end(), given_.begin(), given_.end());
    if (!rule_.empty()) add(words, "--prefer", rule_);
    add(words, "--construction", construction_);
    add(words, "-o", "c.json");
    const Run fit = program("fit", words);
    if (stopped_) return;
    const std::string contour = text_of_file(path("c.json"));
    if (contour.empty()) return check_exit(nullptr, fit, sheet);
    const ReadContour read = read_contour(contour);
    if (!read.fault.empty()) return sheet.fails("file", "a contour", read.fault, "c.json");
    const Course course(read.contour);
    judge_constructed(course, read_input(text_, words), sheet);
    check_fit_text(course, fit, sheet);
    check_constructed(worksheet, input, construction_, course, sheet);
  }

  // ranges of headings

  /// Of every chord, how the curvature goes along it; none where that changes inside.
  static std::vector<std::optional<int>> directions(const ContourFile& file) {
    std::vector<std::optional<int>> out;
    std::optional<int> now;
    bool any = false, same = true;
    for (std::size_t k = 0; k < file.pieces.size(); ++k) {
      int direction = 0;
      for (const FileRun& run : file.runs) {
        if (k >= run.first && k <= run.last) direction = run.direction;
      }
      same = same && (!any || now == direction);
      now = direction;
      any = true;
      if (!file.elements[k + 1].source) continue;
      out.push_back(same ? now : std::nullopt);
      any = false;
      same = true;
    }
    return out;
  }

  /// Vertices and inflections between corners, where a range of headings promises no more of them;
  /// how the curvature steps at a corner it leaves open.
  struct Counted {
    double vertices = 0.0, inflections = 0.0;

    [[nodiscard]] bool within(const Counted& other) const {
      return vertices <= other.vertices && inflections <= other.inflections;
    }
  };
  static Counted counted(const ContourFile& file) {
    const bool corners = std::any_of(file.elements.begin(), file.elements.end(),
                                     [](const FileElement& e) { return e.corner; });
    if (!corners) {
      return {figure(file.certificate, "vertices").value.value_or(HUGE_VAL),
              figure(file.certificate, "inflections").value.value_or(HUGE_VAL)};
    }
    Counted out;
    int direction = 0;
    for (const FileRun& run : file.runs) {
      if (file.corner_at(run.first)) direction = 0;
      if (run.direction == 0) continue;
      if (direction != 0 && run.direction != direction) out.vertices += 1.0;
      direction = run.direction;
    }
    double before = 0.0;  // the last curvature that is not 0
    for (const FileElement& e : file.elements) {
      if (e.kappa * before < 0.0) out.inflections += 1.0;
      const double after = e.corner ? e.kappa_out : e.kappa;
      if (e.corner || after != 0.0) before = after;
    }
    return out;
  }

  /// The contour with the heading at a point; none: refused.
  std::optional<ContourFile> with_heading(const std::string& datum, const std::string& name) {
    std::vector<std::string> words{"fit", kPoints, "--quiet", "--continuity", "G2"};
    for (std::size_t i = 0; i < given_.size(); ++i) {
      if (given_[i] == "--tolerance") {
        ++i;
      } else {
        words.push_back(given_[i]);
      }
    }
    if (!datum.empty()) add(words, "--heading-at", datum);
    add(words, "-o", name);
    const Run fit = program("fit", words);
    if (stopped_ || fit.code != 0) return std::nullopt;
    ReadContour read = read_contour(text_of_file(path(name)));
    if (!read.fault.empty()) return std::nullopt;
    return std::move(read.contour);
  }

  /// 1 % inside an end of the range of one point there is a contour of the same runs, 1 % outside
  /// there is none. Around a closed series only the second is said.
  void probe(const SheetPart& part, const Input& input) {
    std::vector<std::size_t> free;
    std::map<std::size_t, int> times;
    for (const SheetPoint& p : part.points) ++times[p.index];
    for (std::size_t i = 0; i < part.points.size(); ++i) {
      const SheetPoint& p = part.points[i];
      const bool corner = times[p.index] > 1 && !part.loop;
      if (!p.headings || corner || input.points.at(p.index).heading) continue;
      if (p.headings->high - p.headings->low < 1e-4L) continue;
      free.push_back(i);
    }
    if (free.empty()) return;
    const auto base = with_heading("", "base.json");
    if (stopped_ || !base) return;
    const auto runs = directions(*base);
    if (runs != table_directions(part)) {
      return out_.sheet.unjudged("region.range of headings", "fit has other runs than the table");
    }
    const SheetPoint& p =
        part.points[free[static_cast<std::size_t>(dice_.whole(0, static_cast<int>(free.size()) - 1))]];
    const Real width = p.headings->high - p.headings->low;
    const bool low = p.low_is_open || (!p.high_is_open && dice_.chance(0.5));
    if (low ? p.low_is_open && p.high_is_open : p.high_is_open) return;
    const bool at_low = p.low_is_open ? false : p.high_is_open ? true : low;
    const Real end = at_low ? p.headings->low : p.headings->high, ahead = at_low ? 1.0L : -1.0L;
    const std::string range =
        fmt::format("range {} to {} deg", all_digits(p.headings->low / kDegree),
                    all_digits(p.headings->high / kDegree));
    const Counted all = counted(*base);
    const auto i = static_cast<std::size_t>(&p - part.points.data());
    const auto exists = [&](Real theta) {
      return !part.loop && found_with_heading(part, input, i, theta);
    };
    if (!part.loop) {
      const Real theta = end + ahead * 0.01L * width;
      const std::string inside = datum(p, theta);
      const auto found = with_heading(inside, "inside.json");
      if (stopped_) return;
      const bool good = found && counted(*found).within(all);
      if (!good && vertex_inside(part) && exists(theta)) {
        // the table leaves everything open over such a segment, and so does the search
        out_.sheet.unjudged("region.range of headings inside", "a vertex inside a segment",
                            inside + ", " + range);
      } else {
        out_.sheet.expect(good, "region.range of headings inside", inside,
                          std::string(found          ? "a vertex or inflection more"
                                      : exists(theta) ? "refused, although spirals exist"
                                                      : "refused"),
                          range);
      }
    }
    const Real theta = end - ahead * 0.01L * width;
    const std::string outside = datum(p, theta);
    const auto found = with_heading(outside, "outside.json");
    if (stopped_) return;
    if (found && bends(*found) != bends(*base)) {  // the signs of the table are kept
      return out_.sheet.unjudged("region.range of headings outside", "bends another way elsewhere");
    }
    const bool same = found && directions(*found) == runs &&
                      counted(*found).inflections <= all.inflections;
    out_.sheet.expect(!same && !exists(theta), "region.range of headings outside", outside,
                      std::string(same ? "a contour of the same runs" : "spirals over every chord"),
                      range);
  }
  static bool vertex_inside(const SheetPart& part) {
    return std::any_of(part.rows.begin(), part.rows.end(),
                       [&](const SheetRow& row) { return !part.direction(row); });
  }
  /// Signs of the curvature at the points.
  static std::vector<int> bends(const ContourFile& file) {
    std::vector<int> out;
    for (const FileElement& e : file.elements) {
      if (e.source) out.push_back(e.kappa > 0.0 ? 1 : e.kappa < 0.0 ? -1 : 0);
    }
    return out;
  }
  static std::string datum(const SheetPoint& p, Real heading) {
    return fmt::format("{}={}", p.index + 1, all_digits(heading / kDegree));
  }
  static std::vector<std::optional<int>> table_directions(const SheetPart& part) {
    std::vector<std::optional<int>> out;
    for (const SheetRow& row : part.rows) out.push_back(part.direction(row));
    return out;
  }

  Dice dice_;
  Real scale_ = 1.0L, turn_ = 0.0L;
  Vec offset_;
  bool two_sign_ = false;
  std::string text_, rule_, tolerance_, construction_, unit_ = "mm";
  std::vector<std::string> given_, inserts_;
};

}  // namespace

Trial run_region_trial(const TrialOptions& options, std::uint64_t index) {
  return RegionTrial(options, index).run();
}

}  // namespace judge
