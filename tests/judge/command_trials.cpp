// SPDX-License-Identifier: Apache-2.0
// Trials of points in space, of control points, and of functions of two variables.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "checks.h"
#include "command_checks.h"
#include "process.h"
#include "program_runs.h"
#include "series.h"

namespace judge {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// As `digits` significant digits print it.
double printed(Real value, int digits) {
  return std::strtod(fmt::format("{:.{}g}", static_cast<double>(value), digits).c_str(), nullptr);
}

/// A turned, moved and scaled frame.
struct SpaceMotion {
  Real scale = 1.0L;
  Vec3 x, y, z, offset;

  SpaceMotion(Dice& dice, bool turned) {
    scale = dice.chance(0.6) ? dice.logarithmic(1.0, 1000.0) : dice.logarithmic(1e-6, 1e6);
    x = {1.0L, 0.0L, 0.0L};
    y = {0.0L, 1.0L, 0.0L};
    if (turned) {
      const Vec3 a{dice.normal(), dice.normal(), dice.normal()},
          b{dice.normal(), dice.normal(), dice.normal()};
      x = (1.0L / norm(a)) * a;
      const Vec3 c = cross(x, b);
      y = (1.0L / norm(c)) * c;
    }
    z = cross(x, y);
    const Real far = scale * (dice.chance(0.3) ? dice.logarithmic(1.0, 1e5) : 1.0L);
    offset = {far * dice.normal(), far * dice.normal(), far * dice.normal()};
  }
  [[nodiscard]] Vec3 of(Vec3 p) const { return offset + scale * (p.x * x + p.y * y + p.z * z); }
};

struct SpaceShape {
  std::string family;
  std::function<Vec3(Real)> at;
  Real from = 0.0L, to = 1.0L;
};

SpaceShape space_shape(Dice& dice) {
  const Real a = dice.between(0.3, 2.0), b = dice.between(0.05, 1.5), c = dice.between(-1.0, 1.0);
  const Real from = dice.between(0.0, kTurn);
  const auto whole = dice.whole(0, 8);
  switch (whole) {
    case 0:
      return {"helix",
              [=](Real t) {
                return Vec3{a * std::cos(t), a * std::sin(t), b * t};
              },
              from, from + static_cast<Real>(dice.between(0.5, 9.0))};
    case 1:
      return {"cone spiral",
              [=](Real t) {
                const Real r = std::exp(0.15L * c * t);
                return Vec3{r * std::cos(t), r * std::sin(t), b * r};
              },
              from, from + static_cast<Real>(dice.between(0.5, 6.0))};
    case 2:
      return {"twisted cubic",
              [=](Real t) {
                return Vec3{t, a * t * t, b * t * t * t};
              },
              static_cast<Real>(dice.between(-1.0, 0.3)), 1.0L};
    case 3:
      return {"ellipse and wave",
              [=](Real t) {
                return Vec3{2.0L * std::cos(t), a * std::sin(t), 0.3L * b * std::sin(2.0L * t + c)};
              },
              from, from + static_cast<Real>(dice.between(0.5, 5.0))};
    case 4:
      return {"closed wave",
              [=](Real t) {
                return Vec3{2.0L * std::cos(t), a * std::sin(t), 0.3L * b * std::sin(2.0L * t + c)};
              },
              0.0L, kTurn};
    case 5:
      return {"curve on a sphere",
              [=](Real t) {
                const Real up = 0.8L * std::sin(a * t + c);
                return Vec3{std::cos(up) * std::cos(t), std::cos(up) * std::sin(t), std::sin(up)};
              },
              from, from + static_cast<Real>(dice.between(0.5, 4.0))};
    case 8:
      return {"arcs with a corner",
              [=](Real t) {  // a circle, and a helix that leaves it upright
                if (t <= 1.0L)
                  return Vec3{2.0L * std::sin(t - 1.0L), 2.0L - 2.0L * std::cos(t - 1.0L), 0.0L};
                const Real u = t - 1.0L;
                return Vec3{0.4L * b * u, a * (1.0L - std::cos(u)), a * std::sin(u)};
              },
              0.0L, 2.0L};
    case 6:
      return {"plane spiral",
              [=](Real t) {
                const Real r = std::exp(0.2L * c * t);
                return Vec3{r * std::cos(t), r * std::sin(t), 0.0L};
              },
              from, from + static_cast<Real>(dice.between(0.5, 5.0))};
    default:
      return {"plane parabola",
              [=](Real t) {
                return Vec3{t, a * t * t, 0.0L};
              },
              static_cast<Real>(dice.between(-1.0, 0.5)), 1.0L};
  }
}

class SpaceTrial : public ProgramRuns {
 public:
  SpaceTrial(const TrialOptions& options, std::uint64_t index)
      : ProgramRuns(options, index), dice_(options.seed * 77 + index * 13 + 3) {}

  Trial run() {
    make();
    std::vector<std::string> words = fit_words();
    words.insert(words.end(), {"-o", "c.json", "-o", "c.csv", "-o", "c.sldcrv", "-o", "c.dxf"});
    words.insert(words.end(), {"-o", "c.step"});
    words.insert(words.end(), {"--samples", std::to_string(samples_)});
    const Run fit = program("fit", words);
    if (stopped_) return std::move(out_);
    const double start = own_seconds();
    const std::string stored = text_of_file(path("c.json"));
    if (stored.empty()) {
      check_exit(nullptr, fit, out_.sheet);
      out_.outcome = Trial::Outcome::kRefused;
    } else {
      curve(stored, fit);
    }
    out_.judge_seconds = own_seconds() - start;
    if (out_.sheet.wrong() > 0 && !stopped_) out_.outcome = Trial::Outcome::kFalse;
    return std::move(out_);
  }

 private:
  void make() {
    const SpaceShape shape = space_shape(dice_);
    const bool turned = dice_.chance(0.5);
    const SpaceMotion motion(dice_, turned);
    const int n = dice_.whole(3, dice_.chance(0.2) ? 60 : 16);
    const int digits = dice_.chance(0.4) ? dice_.whole(4, 7) : 17;
    const bool even = dice_.chance(0.5);
    out_.family = shape.family;
    std::vector<Real> at;
    Real sum = 0.0L;
    for (int i = 0; i < n; ++i) {
      at.push_back(sum);
      sum += even ? 1.0L : static_cast<Real>(dice_.between(0.4, 1.6));
    }
    text_ = "x,y,z\n";
    for (const Real t : at) {
      const Vec3 p = motion.of(shape.at(shape.from + (shape.to - shape.from) * t / at.back()));
      const Vec3 q{printed(p.x, digits), printed(p.y, digits), printed(p.z, digits)};
      text_ += fmt::format("{},{},{}\n", static_cast<double>(q.x), static_cast<double>(q.y),
                           static_cast<double>(q.z));
      if (points_.empty() || norm(points_.back() - q) > 0.0L) points_.push_back(q);
    }
    out_.points = points_.size();
    write_file(path(kPoints), text_);
    const Real size = extent_of(points_);
    if (dice_.chance(0.35)) {
      static const std::vector<std::pair<std::string, Vec3>> kAxes = {
          {"X", {1.0L, 0.0L, 0.0L}}, {"Y", {0.0L, 1.0L, 0.0L}}, {"Z", {0.0L, 0.0L, 1.0L}}};
      const auto& [name, axis] = kAxes[static_cast<std::size_t>(dice_.whole(0, 2))];
      along_ = axis;
      std::string words = name;
      if (dice_.chance(0.4)) {
        along_ = Vec3{dice_.between(-1.0, 1.0), dice_.between(-1.0, 1.0), dice_.between(0.1, 1.0)};
        words = fmt::format("{},{},{}", static_cast<double>(along_->x),
                            static_cast<double>(along_->y), static_cast<double>(along_->z));
      }
      options_given_.push_back("--along=" + words);
    }
    if (dice_.chance(0.7)) {
      const char* smooth = dice_.chance(0.5) ? "G2" : "G3";
      options_given_.insert(options_given_.end(), {"--continuity", smooth});
    }
    if (dice_.chance(0.25)) {
      const double noise = static_cast<double>(size) * dice_.logarithmic(1e-6, 1e-2);
      options_given_.insert(options_given_.end(), {"--noise", fmt::format("{:.3g}", noise)});
    }
    if (dice_.chance(0.2)) options_given_.insert(options_given_.end(), {"--units", "m"});
    if (dice_.chance(0.3)) {
      const double near = static_cast<double>(size) * dice_.logarithmic(1e-7, 1e-3);
      options_given_.insert(options_given_.end(),
                            {"--output-tolerance", fmt::format("{:.3g}", near)});
    }
    samples_ = static_cast<std::size_t>(dice_.whole(2, 80));
  }

  [[nodiscard]] std::vector<std::string> fit_words() const {
    std::vector<std::string> words{"fit", kPoints};
    words.insert(words.end(), options_given_.begin(), options_given_.end());
    return words;
  }

  void curve(const std::string& stored, const Run& fit) {
    Sheet& sheet = out_.sheet;
    const ReadJson json = read_json(stored);
    if (!json.fault.empty()) return sheet.fails("file", "JSON", json.fault, "c.json");
    if (text_of(json.value, "format") == "obvid-contour") {  // all of one height
      return sheet.unjudged("space", "a contour of the plane");
    }
    if (text_of(json.value, "format") == "obvid-space-chain") return chain(json.value, fit);
    const ReadSpace read = read_space(json.value);
    if (!read.fault.empty()) return sheet.fails("file", "a curve in space", read.fault, "c.json");
    const SpaceCourse& curve = *read.curve;
    check_space(curve, json.value, sheet);
    check_space_input(curve, points_, along_, sheet);
    check_space_text(curve, json.value, fit.out, sheet);
    check_space_samples(curve, text_of_file(path("c.csv")), samples_, false, sheet);
    check_space_samples(curve, text_of_file(path("c.sldcrv")), samples_, true, sheet);
    check_space_spline(curve.nurbs, "c.dxf", text_of_file(path("c.dxf")), "space DXF", sheet);
    check_space_curves({&curve.nurbs}, step_curves(text_of_file(path("c.step"))), "c.step",
                       "space STEP", sheet);
    check_codes(curve, fit);
    std::vector<std::string> words = fit_words();
    words.emplace_back("--json");
    const Run again = program("fit --json", words);
    if (stopped_) return;
    const bool same = without_times(again.out) == without_times(stored);
    sheet.expect(same, "space --json", "the file", same ? "the file" : "another text", "");
    if (dice_.chance(0.5)) verify(curve);
    if (!stopped_ && !along_ && !curve.planar && dice_.chance(0.5)) directions(curve);
  }

  /// Cut at corners.
  void chain(const Json& json, const Run& fit) {
    Sheet& sheet = out_.sheet;
    const ReadChain read = read_chain(json);
    if (!read.fault.empty()) return sheet.fails("file", "curves in space", read.fault, "c.json");
    check_chain(*read.chain, json, sheet);
    check_chain_input(*read.chain, points_, sheet);
    std::vector<const SpaceNurbs*> curves;
    for (const auto& part : read.chain->parts) curves.push_back(&part->nurbs);
    check_space_curves(curves, dxf_curves(text_of_file(path("c.dxf"))), "c.dxf", "space DXF",
                       sheet);
    check_space_curves(curves, step_curves(text_of_file(path("c.step"))), "c.step", "space STEP",
                       sheet);
    for (const auto& part : read.chain->parts) {
      if (along_ && !part->planar) {
        const Real off = norm(cross(*along_, part->frame.normal)) / norm(*along_);
        sheet.expect(off <= 1e-14L, "space.along", 0.0L, off, "");
      }
    }
    const Run verified = program("verify", {"verify", "c.json"});
    if (stopped_) return;
    sheet.expect(verified.code == fit.code, "space verify", fmt::format("exit {}", fit.code),
                 fmt::format("exit {}", verified.code), verified.err.substr(0, 200));
  }

  /// 0 where both contours are proved within their widths, else 5.
  void check_codes(const SpaceCourse& curve, const Run& fit) {
    fit_code_ = fit.code;
    bool kept = true;
    for (const OwnedCourse* part : {curve.plan.get(), curve.heights.get()}) {
      if (part == nullptr) continue;
      const Figure width = figure(part->file.report, "largest_width"),
                   tolerance = figure(part->file.report, "tolerance");
      const bool wide = width.known() && tolerance.known() && *width.value > *tolerance.value;
      kept = kept && flag(part->file.certificate, "proved").value_or(false) && !wide;
    }
    out_.sheet.expect(fit.code == (kept ? 0 : 5), "exit code", std::to_string(fit.code),
                      kept ? "proved" : "not proved", fit.err.substr(0, 200));
  }

  /// The one figure that differs from run to run.
  static std::string without_times(std::string text) {
    const std::string name = "\"seconds\": ";
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
      const std::size_t from = at + name.size();
      text.erase(from, text.find_first_of(",}\n", from) - from);
    }
    return text;
  }

  /// Proved again; and written again, the same curve.
  void verify(const SpaceCourse& curve) {
    const Run run = program("verify", {"verify", "c.json"});
    if (stopped_) return;
    out_.sheet.expect(run.code == fit_code_, "space verify", fmt::format("exit {}", fit_code_),
                      fmt::format("exit {}", run.code),
                      run.err.substr(0, 200) + run.out.substr(0, 200));
    const Run other = program("convert", {"convert", "c.json", "-o", "d.json", "-o", "d.sldcrv",
                                          "--samples", std::to_string(samples_)});
    if (stopped_) return;
    out_.sheet.expect(other.code == 0, "space convert", "exit 0",
                      fmt::format("exit {}", other.code), other.err.substr(0, 200));
    check_space_samples(curve, text_of_file(path("d.sldcrv")), samples_, true, out_.sheet);
    const ReadJson json = read_json(text_of_file(path("d.json")));
    const ReadSpace again = read_space(json.value);
    if (!again.fault.empty()) {
      return out_.sheet.fails("space convert", "a curve in space", again.fault, "d.json");
    }
    check_space(*again.curve, json.value, out_.sheet);
  }

  /// No axis gives fewer vertices and inflections than the direction that was found.
  void directions(const SpaceCourse& curve) {
    const auto bends = [](const SpaceCourse& one) {
      double sum = 0.0;
      for (const OwnedCourse* part : {one.plan.get(), one.heights.get()}) {
        for (const char* name : {"vertices", "inflections"}) {
          sum += figure(part->file.report, name).value.value_or(0.0);
        }
      }
      return sum;
    };
    for (const char* axis : {"X", "Y", "Z"}) {
      std::vector<std::string> words = fit_words();
      words.insert(words.end(), {"--along", axis, "-o", "other.json", "--quiet"});
      program("fit --along", words);
      if (stopped_) return;
      const ReadJson json = read_json(text_of_file(path("other.json")));
      write_file(path("other.json"), "");
      if (!json.fault.empty()) continue;  // no curve along this one
      const ReadSpace other = read_space(json.value);
      if (!other.fault.empty() || other.curve->planar) continue;
      out_.sheet.expect(bends(curve) <= bends(*other.curve), "space.best direction",
                        static_cast<Real>(bends(curve)), static_cast<Real>(bends(*other.curve)),
                        axis);
    }
  }

  Dice dice_;
  std::string text_;
  std::vector<Vec3> points_;
  std::optional<Vec3> along_;
  std::vector<std::string> options_given_;
  std::size_t samples_ = 200;
  int fit_code_ = 0;
};

class NurbsTrial : public ProgramRuns {
 public:
  NurbsTrial(const TrialOptions& options, std::uint64_t index)
      : ProgramRuns(options, index), dice_(options.seed * 91 + index * 17 + 5) {}

  Trial run() {
    const bool net = dice_.chance(0.3);
    out_.family = net ? "net" : "curve";
    net ? make_net() : make_curve();
    out_.points = in_.points.size();
    std::vector<std::string> words{"nurbs", kPoints};
    words.insert(words.end(), options_given_.begin(), options_given_.end());
    words.emplace_back("--json");
    const auto samples = static_cast<std::size_t>(dice_.whole(2, 60));
    if (!net) {
      words.insert(words.end(), {"-o", "n.csv", "-o", "n.json", "-o", "n.dxf", "-o", "n.step",
                                 "--samples", std::to_string(samples)});
    }
    const Run run = program("nurbs", words);
    if (stopped_) return std::move(out_);
    const double start = own_seconds();
    if (run.code != 0) {
      out_.sheet.fails("nurbs refused", out_.command, run.err.substr(0, 200), "");
    } else {
      judge(run.out, net, samples);
    }
    out_.judge_seconds = own_seconds() - start;
    if (out_.sheet.wrong() > 0) out_.outcome = Trial::Outcome::kFalse;
    return std::move(out_);
  }

 private:
  void judge(const std::string& text, bool net, std::size_t samples) {
    const ReadJson json = read_json(text);
    if (!json.fault.empty()) return out_.sheet.fails("nurbs", "JSON", json.fault, "");
    check_nurbs(json.value, in_, out_.sheet);
    if (net || out_.sheet.wrong() > 0) return;
    out_.sheet.expect(text_of_file(path("n.json")) == text, "nurbs file", "--json", "the file", "");
    check_nurbs_samples(json.value, text_of_file(path("n.csv")), samples, out_.sheet);
    check_space_spline(nurbs_of(json.value), "n.dxf", text_of_file(path("n.dxf")), "nurbs DXF",
                       out_.sheet);
    const SpaceNurbs curve = nurbs_of(json.value);
    check_space_curves({&curve}, step_curves(text_of_file(path("n.step"))), "n.step", "nurbs STEP",
                       out_.sheet);
  }

  /// Ascending and clamped, inner knots not more often than the degree.
  std::vector<Real> some_knots(std::size_t points, int degree) {
    const auto p = static_cast<std::size_t>(degree);
    const Real first = printed(dice_.between(-2.0, 2.0), 6);
    std::vector<Real> out(p + 1, first);
    Real at = first;
    std::size_t times = p;  // as often as the last one stands, an end at most
    while (out.size() < points) {
      if (at == first || times == p || dice_.chance(0.75)) {
        at = printed(at + dice_.logarithmic(0.05, 5.0), 8);
        times = 0;
      }
      ++times;
      out.push_back(at);
    }
    out.insert(out.end(), p + 1, printed(at + dice_.logarithmic(0.05, 5.0), 8));
    return out;
  }

  void give_knots(const char* option, std::vector<Real>& knots, std::size_t points, int degree) {
    if (!dice_.chance(0.5)) return;
    knots = some_knots(points, degree);
    std::string list;
    for (const Real knot : knots) {
      list += (list.empty() ? "" : ",") + fmt::format("{}", static_cast<double>(knot));
    }
    options_given_.push_back(fmt::format("{}={}", option, list));
  }

  void give_degree(const char* option, int& degree) {
    if (!dice_.chance(0.6)) return;
    degree = dice_.whole(1, 6);
    options_given_.insert(options_given_.end(), {option, std::to_string(degree)});
  }

  void make_curve() {
    const int n = dice_.whole(2, 12);
    const bool spatial = dice_.chance(0.5), weighted = dice_.chance(0.5);
    const double scale = dice_.logarithmic(1e-3, 1e3);
    std::string text = spatial ? "x,y,z" : "x,y";
    text += weighted ? ",w\n" : "\n";
    for (int i = 0; i < n; ++i) {
      const double x = scale * (i + dice_.between(-0.4, 0.4)), y = scale * dice_.normal(),
                   z = spatial ? scale * dice_.normal() : 0.0,
                   w = weighted ? dice_.logarithmic(0.05, 20.0) : 1.0;
      in_.points.push_back({x, y, z});
      in_.weights.push_back(w);
      text += fmt::format("{},{}", x, y);
      if (spatial) text += fmt::format(",{}", z);
      if (weighted) text += fmt::format(",{}", w);
      text += "\n";
    }
    write_file(path(kPoints), text);
    give_degree("--degree", in_.degree);
    const int degree = std::min(in_.degree, n - 1);
    give_knots("--knots", in_.knots, static_cast<std::size_t>(n), degree);
    if (dice_.chance(0.3)) {
      const int i = dice_.whole(0, n - 1);
      const double w = dice_.logarithmic(0.05, 20.0);
      in_.at.emplace_back(i, w);
      options_given_.push_back(fmt::format("--weight-at={}={}", i + 1, w));
    }
    // where all knots inside a support are one, the curve runs through the point
    const auto free = [&](int i) {
      const auto at = static_cast<std::size_t>(i), p = static_cast<std::size_t>(degree);
      return in_.knots.empty() ? degree > 1 : in_.knots[at + 1] < in_.knots[at + p];
    };
    const int i = n > 2 ? dice_.whole(1, n - 2) : 0;
    if (dice_.chance(0.5) && i > 0 && free(i)) {
      const double part = dice_.between(0.02, 0.98);
      in_.move.emplace_back(i, part);
      options_given_.push_back(fmt::format("--move={}={}", i + 1, part));
    }
  }

  void make_net() {
    const int rows = dice_.whole(2, 6), cols = dice_.whole(2, 6);
    const bool weighted = dice_.chance(0.5);
    in_.rows = static_cast<std::size_t>(rows);
    std::vector<std::string> lines;
    for (int j = 0; j < rows; ++j) {
      for (int i = 0; i < cols; ++i) {
        const double x = i + dice_.between(-0.3, 0.3), y = j + dice_.between(-0.3, 0.3),
                     z = dice_.normal(), w = weighted ? dice_.logarithmic(0.1, 10.0) : 1.0;
        in_.points.push_back({x, y, z});
        in_.weights.push_back(w);
        lines.push_back(fmt::format("{},{},{},{},{}{}\n", 0.5 * j - 1.0, 10 * i, x, y, z,
                                    weighted ? fmt::format(",{}", w) : ""));
      }
    }
    for (std::size_t k = lines.size(); k > 1; --k) {
      std::swap(lines[k - 1],
                lines[static_cast<std::size_t>(dice_.whole(0, static_cast<int>(k) - 1))]);
    }
    std::string text = weighted ? "row,col,x,y,z,w\n" : "row,col,x,y,z\n";
    for (const std::string& line : lines) text += line;
    write_file(path(kPoints), text);
    give_degree("--degree", in_.degree);
    give_degree("--degree-v", in_.degree_v);
    give_knots("--knots", in_.knots, static_cast<std::size_t>(cols),
               std::min(in_.degree, cols - 1));
    give_knots("--knots-v", in_.knots_v, static_cast<std::size_t>(rows),
               std::min(in_.degree_v, rows - 1));
  }

  Dice dice_;
  NurbsInput in_;
  std::vector<std::string> options_given_;
};

class GridTrial : public ProgramRuns {
 public:
  GridTrial(const TrialOptions& options, std::uint64_t index)
      : ProgramRuns(options, index), dice_(options.seed * 57 + index * 19 + 7) {}

  Trial run() {
    make();
    out_.family = fmt::format("{}{}", in_.cells ? "cells " : "", in_.lines ? "lines" : "");
    out_.points = in_.places.size();
    const auto samples = static_cast<std::size_t>(dice_.whole(4, 300));
    std::vector<std::string> words{
        "spline", kPoints, "--json", "-o", "s.csv", "--samples", std::to_string(samples)};
    if (!in_.finer.empty()) words.insert(words.end(), {"--against", "finer.csv"});
    const Run one = spline(words, in_.smooth);
    if (stopped_) return std::move(out_);
    const double start = own_seconds();
    const ReadJson json = read_json(one.out);
    if (one.code != 0 || !json.fault.empty()) {
      out_.sheet.fails("spline refused", out_.command, json.fault + one.err.substr(0, 200), "");
    } else {
      check_grid_spline(json.value, in_, out_.sheet);
      check_grid_samples(json.value, text_of_file(path("s.csv")), samples, out_.sheet);
      const Run other = spline(words, !in_.smooth);
      if (!stopped_) second_row(json.value, read_json(other.out).value);
    }
    out_.judge_seconds = own_seconds() - start;
    if (out_.sheet.wrong() > 0) out_.outcome = Trial::Outcome::kFalse;
    return std::move(out_);
  }

 private:
  Run spline(std::vector<std::string> words, bool smooth) {
    words.insert(words.end(), {"--smooth", smooth ? "values-free" : "none"});
    return program("spline", words);
  }

  /// The other kind of spline is what it is where it was asked for.
  void second_row(const Json& json, const Json& other) {
    for (const auto& [a, b] : {std::pair{&json, &other}, std::pair{&other, &json}}) {
      const Json &second = member(*a, "rows")[1], &first = member(*b, "rows")[0];
      for (const char* name : {"largest_error", "largest_x", "largest_y", "rms_error",
                               "largest_move", "integral", "integral_error"}) {
        const Figure x = figure(second, name), y = figure(first, name);
        out_.sheet.expect(x.present && x.value == y.value,
                          fmt::format("spline.second row.{}", name), x.value.value_or(0.0),
                          y.value.value_or(0.0), "");
      }
    }
  }

  std::vector<Real> some_nodes(int count) {
    const bool even = dice_.chance(0.4);
    const double step = dice_.logarithmic(0.01, 100.0);
    std::vector<Real> out{printed(dice_.between(-3.0, 3.0) * step, 8)};
    for (int i = 1; i < count; ++i) {
      out.push_back(printed(out.back() + step * (even ? 1.0 : dice_.between(0.3, 1.7)), 12));
    }
    return out;
  }

  void make() {
    const std::vector<Real> x = some_nodes(dice_.whole(2, 8)), y = some_nodes(dice_.whole(2, 8));
    in_.cells = dice_.chance(0.5);
    in_.lines = dice_.chance(0.5);
    in_.smooth = dice_.chance(0.5);
    const double a = dice_.normal(), b = dice_.normal(), c = dice_.normal();
    const Real wide = x.back() - x.front(), deep = y.back() - y.front();
    const auto f = [&](Real u, Real v) {
      const Real s = (u - x.front()) / wide, t = (v - y.front()) / deep;
      return a + b * std::sin(2.0L * s + 3.0L * t) + c * std::exp(-s * s - t * t);
    };
    for (std::size_t j = 0; j < y.size(); ++j) {
      for (std::size_t i = 0; i < x.size(); ++i) {
        GridInput::Place p{x[i], y[j], printed(f(x[i], y[j]), 15)};
        // near the true ones, and a little off: they are data like the values
        const Real h = i + 1 < x.size() ? x[i + 1] - x[i] : 0.0L,
                   k = j + 1 < y.size() ? y[j + 1] - y[j] : 0.0L;
        const Real off = 1.0L + 0.02L * static_cast<Real>(dice_.normal());
        p.along_x = printed(h * f(x[i] + h / 2, y[j]) * off, 15);
        p.along_y = printed(k * f(x[i], y[j] + k / 2) * off, 15);
        p.cell = printed(h * k * f(x[i] + h / 2, y[j] + k / 2) * off, 15);
        in_.places.push_back(p);
      }
    }
    for (std::size_t k = in_.places.size(); k > 1; --k) {
      std::swap(in_.places[k - 1],
                in_.places[static_cast<std::size_t>(dice_.whole(0, static_cast<int>(k) - 1))]);
    }
    write_file(path(kPoints), table());
    if (!dice_.chance(0.6)) return;
    std::string finer = "x,y,f\n";
    for (int k = dice_.whole(1, 40); k > 0; --k) {
      const Real u = printed(x.front() + wide * dice_.unit(), 15),
                 v = printed(y.front() + deep * dice_.unit(), 15), value = printed(f(u, v), 15);
      in_.finer.push_back({u, v, value});
      finer += fmt::format("{},{},{}\n", static_cast<double>(u), static_cast<double>(v),
                           static_cast<double>(value));
    }
    write_file(path("finer.csv"), finer);
  }

  [[nodiscard]] std::string table() const {
    std::string out = "x,y,f";
    if (in_.cells) out += ",integral";
    if (in_.lines) out += ",integral_x,integral_y";
    out += "\n";
    for (const GridInput::Place& p : in_.places) {
      out += fmt::format("{},{},{}", static_cast<double>(p.x), static_cast<double>(p.y),
                         static_cast<double>(p.f));
      if (in_.cells) out += fmt::format(",{}", static_cast<double>(p.cell));
      if (in_.lines) {
        out +=
            fmt::format(",{},{}", static_cast<double>(p.along_x), static_cast<double>(p.along_y));
      }
      out += "\n";
    }
    return out;
  }

  Dice dice_;
  GridInput in_;
};

}  // namespace

Trial run_space_trial(const TrialOptions& options, std::uint64_t index) {
  return SpaceTrial(options, index).run();
}

Trial run_nurbs_trial(const TrialOptions& options, std::uint64_t index) {
  return NurbsTrial(options, index).run();
}

Trial run_grid_trial(const TrialOptions& options, std::uint64_t index) {
  return GridTrial(options, index).run();
}

void judge_space(const std::string& stored, const std::string& report, Sheet& sheet) {
  const ReadJson json = read_json(stored);
  if (!json.fault.empty()) return sheet.fails("file", "JSON", json.fault, "");
  if (text_of(json.value, "format") == "obvid-space-chain") {
    const ReadChain chain = read_chain(json.value);
    if (!chain.fault.empty()) return sheet.fails("file", "curves in space", chain.fault, "");
    return check_chain(*chain.chain, json.value, sheet);
  }
  const ReadSpace read = read_space(json.value);
  if (!read.fault.empty()) return sheet.fails("file", "a curve in space", read.fault, "");
  check_space(*read.curve, json.value, sheet);
  if (!report.empty()) check_space_text(*read.curve, json.value, report, sheet);
}

}  // namespace judge
