// SPDX-License-Identifier: Apache-2.0
// Trials of measured points: errors of known size about a known curve, some points far off it, in
// order or in none. Judges what `--drop-outliers`, `--unordered` and `--noise auto` say and do.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <optional>
#include <regex>

#include "checks.h"
#include "process.h"
#include "program_runs.h"
#include "series.h"

namespace judge {
namespace {

/// A curve of size 1 or so by its parameter.
struct ScannedCurve {
  std::string family;
  std::function<Vec(Real)> at;
  Real from = 0.0L, to = 1.0L;
  bool closed = false;
};

ScannedCurve scanned_curve(Dice& dice) {
  const Real from = dice.between(0.0, 6.28), a = dice.between(0.1, 0.35);
  const Real turn = 2.0L * std::numbers::pi_v<Real>;
  switch (dice.whole(0, 5)) {
    case 0:
      return {"arc", unit_at, from, from + Real{dice.between(0.5, 5.0)}};
    case 1:
      return {"spiral", [a](Real t) { return std::exp(a * t) * unit_at(t); }, from,
              from + Real{dice.between(0.8, 5.0)}};
    case 2:
      return {"ellipse",
              [](Real t) {
                return Vec{std::cos(t), 0.6L * std::sin(t)};
              },
              from, from + turn, true};
    case 3:
      return {"part of an ellipse",
              [](Real t) {
                return Vec{std::cos(t), 0.7L * std::sin(t)};
              },
              from, from + Real{dice.between(1.0, 4.5)}};
    case 4:
      return {"parabola",
              [a](Real t) {
                return Vec{t, a * t * t};
              },
              -1.0L, Real{dice.between(0.0, 1.5)}};
    default:
      return {"wave",
              [a](Real t) {
                return Vec{t, a * std::sin(2.0L * t)};
              },
              0.0L, Real{dice.between(1.0, 4.0)}};
  }
}

constexpr Real kReach = 8.0L;  // deviations: what errors of a point and of its neighbours' curve do

class ScanTrial : public ProgramRuns {
 public:
  ScanTrial(const TrialOptions& options, std::uint64_t index)
      : ProgramRuns(options, index), dice_(options.seed * 57 + index * 29 + 5) {}

  Trial run() {
    make();
    std::vector<std::string> words{"fit", kPoints};
    words.insert(words.end(), given_.begin(), given_.end());
    words.insert(words.end(), {"-o", "c.json"});
    const Run fit = program("fit", words);
    if (stopped_) return std::move(out_);
    const double start = own_seconds();
    judge(fit);
    out_.judge_seconds = own_seconds() - start;
    if (out_.sheet.wrong() > 0) out_.outcome = Trial::Outcome::kFalse;
    return std::move(out_);
  }

 private:
  void make() {
    curve_ = scanned_curve(dice_);
    scale_ = dice_.chance(0.5) ? dice_.logarithmic(1.0, 1000.0) : dice_.logarithmic(1e-6, 1e6);
    if (dice_.chance(0.2)) offset_ = {scale_ * dice_.normal() * 100.0, scale_ * dice_.normal()};
    const int n = dice_.whole(60, 240);
    unordered_ = dice_.chance(0.35);
    const Real step = (curve_.to - curve_.from) / n;
    const Real uneven = dice_.chance(0.5) ? 0.0L : Real{dice_.between(0.0, 0.25)};
    for (int i = 0; i < n; ++i) {
      const Real t =
          curve_.from + step * (i + uneven * static_cast<Real>(2.0 * dice_.unit() - 1.0));
      parameters_.push_back(t);
    }
    Real chord = 0.0L;
    for (std::size_t i = 1; i < parameters_.size(); ++i) {
      chord += norm(truth(parameters_[i]) - truth(parameters_[i - 1]));
    }
    chord /= static_cast<Real>(n - 1);
    deviation_ = chord * static_cast<Real>(dice_.logarithmic(0.003, 0.06));
    for (const Real t : parameters_) {
      points_.push_back(truth(t) + Vec{deviation_ * static_cast<Real>(dice_.normal()),
                                       deviation_ * static_cast<Real>(dice_.normal())});
    }
    stray(chord);
    out_.family = curve_.family + (unordered_ ? ", in no order" : "");
    out_.points = points_.size();
    list_.resize(points_.size());
    std::iota(list_.begin(), list_.end(), std::size_t{0});
    if (unordered_) {
      for (std::size_t i = list_.size() - 1; i > 0; --i) {
        std::swap(list_[i], list_[static_cast<std::size_t>(dice_.whole(0, static_cast<int>(i)))]);
      }
      given_.emplace_back("--unordered");
    }
    std::string text = "x,y\n";
    for (const std::size_t i : list_) text += line_of(points_[i]);
    write_file(path(kPoints), text);
    given_.emplace_back("--drop-outliers");
    given_.insert(given_.end(), {"--noise", "auto"});
    if (curve_.closed) given_.emplace_back("--closed");
  }

  /// Up to three points, mostly alone, anywhere.
  void stray(Real chord) {
    const int count = dice_.chance(0.3) ? 0 : dice_.whole(1, 3);
    for (int k = 0; k < count; ++k) {
      const auto i = static_cast<std::size_t>(dice_.whole(0, static_cast<int>(points_.size()) - 1));
      const Real h = 1e-4L * (curve_.to - curve_.from) / static_cast<Real>(points_.size());
      const Vec along = truth(parameters_[i] + h) - truth(parameters_[i] - h);
      const Real off =
          std::max(30.0L * deviation_, chord * static_cast<Real>(dice_.between(0.2, 4.0)));
      points_[i] = points_[i] + (dice_.chance(0.5) ? off : -off) / norm(along) * left_of(along);
    }
  }

  [[nodiscard]] Vec truth(Real t) const { return scale_ * curve_.at(t) + offset_; }
  static std::string line_of(Vec p) {
    return fmt::format("{:.17g},{:.17g}\n", static_cast<double>(p.x), static_cast<double>(p.y));
  }
  /// How far a point of the row lies off the curve.
  [[nodiscard]] Real off_curve(std::size_t i) const {
    const Real step = (curve_.to - curve_.from) / static_cast<Real>(points_.size());
    Real best = INFINITY, at = parameters_[i];
    Real width = 6.0L * step;
    for (int round = 0; round < 6; ++round) {
      const Real middle = at;
      for (int k = -20; k <= 20; ++k) {
        const Real t = middle + width * k / 20.0L;
        const Real d = norm(truth(t) - points_[i]);
        if (d < best) best = d, at = t;
      }
      width /= 10.0L;
    }
    return best;
  }

  void judge(const Run& fit) {
    Sheet& sheet = out_.sheet;
    const std::string stored = text_of_file(path("c.json"));
    const std::vector<std::size_t> named = what_is_left_out(fit.err);
    if (stored.empty()) {
      check_exit(nullptr, fit, sheet);
      out_.outcome = Trial::Outcome::kRefused;
      return;
    }
    const ReadContour read = read_contour(stored);
    if (!read.fault.empty()) return sheet.fails("file", "a contour file", read.fault, "c.json");
    const std::vector<std::size_t> rows = rows_of(read.contour);
    if (rows.size() != read.contour.points.size()) return;
    own_points(rows, named);
    who_stays(fit.err, rows);
    scatter(fit.err, rows);
    if (unordered_) order(fit.err, rows, named);
    contour(read.contour, rows, fit);
  }

  /// Rows of the points whose numbers are printed, with how far they are said to lie off.
  std::vector<std::size_t> what_is_left_out(const std::string& err) {
    std::vector<std::size_t> rows;
    const std::regex one(R"((\d+)(?: of the list)? \((?:at [^ ]+ [^ ]+ )?(\S+) units[^)]*\))");
    for (const std::string& line : lines_of(err)) {
      const auto from = line.find("--drop-outliers: left out ");
      if (from == std::string::npos) continue;
      const std::string told = line.substr(from);
      for (auto it = std::sregex_iterator(told.begin(), told.end(), one);
           it != std::sregex_iterator(); ++it) {
        const auto number = static_cast<std::size_t>(std::stoul((*it)[1].str()));
        if (number < 1 || number > list_.size()) {
          out_.sheet.fails("outliers", (*it)[1].str(), "no such point", told);
          continue;
        }
        const std::size_t row = list_[number - 1];
        rows.push_back(row);
        const Real stated = std::stold((*it)[2].str()), found = off_curve(row);
        // the curve of the neighbours turns away from where a point lies far beside it
        const bool beyond_end = row < 3 || row + 3 >= points_.size();
        const Real allowance = kReach * deviation_ + (beyond_end ? 0.5L : 0.05L) * found;
        out_.sheet.expect(std::abs(stated - found) <= allowance, "outliers", stated, found,
                          fmt::format("point {} off the curve", number));
      }
    }
    return rows;
  }

  /// The row of each point of the file.
  std::vector<std::size_t> rows_of(const ContourFile& file) {
    std::vector<std::size_t> rows;
    for (const Point p : file.points) {
      const auto at = std::find_if(points_.begin(), points_.end(), [&](Vec q) {
        return static_cast<double>(q.x) == p.x && static_cast<double>(q.y) == p.y;
      });
      if (at == points_.end()) {
        out_.sheet.fails("points", fmt::format("[{}, {}]", p.x, p.y), "not of the list", "");
        return {};
      }
      rows.push_back(static_cast<std::size_t>(at - points_.begin()));
    }
    return rows;
  }

  /// Exactly those that were named are gone.
  void own_points(const std::vector<std::size_t>& rows, std::vector<std::size_t> named) {
    std::vector<bool> stays(points_.size(), false);
    for (const std::size_t row : rows) stays[row] = true;
    std::vector<std::size_t> gone;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!stays[i]) gone.push_back(i);
    }
    std::sort(named.begin(), named.end());
    out_.sheet.expect(gone == named, "outliers", static_cast<long double>(named.size()),
                      static_cast<long double>(gone.size()), "points left out");
  }

  /// "none lies ... off", "cannot be told": of what stays.
  void who_stays(const std::string& err, const std::vector<std::size_t>& rows) {
    std::smatch found;
    const std::regex none(
        R"(all points stay: none lies (\S+) units \((\S+) deviations of the others\))"
        R"((?:.*\((\d+) points? cannot be told)?)");
    if (!std::regex_search(err, found, none)) return;
    const Real limit = std::stold(found[1].str());
    const std::size_t untold = found[3].matched ? std::stoul(found[3].str()) : 0;
    std::size_t beyond = 0;
    Real farthest = 0.0L;
    for (const std::size_t row : rows) {
      const Real off = off_curve(row);
      if (off <= limit + kReach * deviation_) continue;
      ++beyond;
      farthest = std::max(farthest, off);
    }
    // a point far off spoils what is known of its neighbours; ends have none on one side
    out_.sheet.expect(beyond <= untold, "outliers: none", limit, farthest,
                      fmt::format("{} points beyond, {} cannot be told", beyond, untold));
  }

  /// Residuals from the cubic through four neighbours over their chord, 1.4826 times their median.
  struct Own {
    Real seen = NAN, without_curve = NAN;
  };
  [[nodiscard]] Own own_scatter(const std::vector<std::size_t>& rows) const {
    const auto middle = [&](std::size_t stride) {
      std::vector<Real> sizes;
      for (std::size_t i = 2 * stride; i + 2 * stride < rows.size(); ++i) {
        const auto at = [&](std::size_t k) { return points_[rows[i + k * stride - 2 * stride]]; };
        const Vec from = at(2), along = 1.0L / norm(at(4) - at(0)) * (at(4) - at(0));
        const std::array<Vec, 4> others{at(0) - from, at(1) - from, at(3) - from, at(4) - from};
        std::array<Real, 4> u{};
        for (std::size_t k = 0; k < 4; ++k) u[k] = dot(others[k], along);
        if (!(u[0] < u[1] && u[1] < 0.0L && 0.0L < u[2] && u[2] < u[3])) continue;
        Real off = 0.0L, variance = 1.0L;
        for (std::size_t k = 0; k < 4; ++k) {
          Real weight = 1.0L;
          for (std::size_t j = 0; j < 4; ++j) {
            if (j != k) weight *= -u[j] / (u[k] - u[j]);
          }
          off -= weight * cross(along, others[k]);
          variance += weight * weight;
        }
        sizes.push_back(std::abs(off) / std::sqrt(variance));
      }
      if (sizes.empty()) return Real{NAN};
      std::sort(sizes.begin(), sizes.end());
      const std::size_t n = sizes.size();
      return 1.482602218505602L * sizes[n / 2];  // of an even number the upper one
    };
    const Real near = middle(1), far = middle(2);
    // a miss of the fourth order is 16 times as large with every second point
    return {near, std::sqrt(std::max((256.0L * near * near - far * far) / 255.0L, 0.0L))};
  }

  void scatter(const std::string& err, const std::vector<std::size_t>& rows) {
    std::smatch found;
    // eight times the scatter 1.2/sqrt(n) of such medians, of n/3 residuals that do not overlap
    const Real factor = 1.0L + 16.0L / std::sqrt(static_cast<Real>(rows.size()));
    const auto near = [&](const std::string& claim, const std::string& stated) {
      const Real told = std::stold(stated);
      out_.sheet.expect(told <= factor * deviation_ && told >= deviation_ / factor, claim, told,
                        deviation_, "errors of the points");
    };
    const Own own = own_scatter(rows);
    const auto tight = [&](const std::string& claim, const std::string& stated, Real value) {
      constexpr Real kPrinted = 6e-4L;  // four digits
      out_.sheet.expect(std::abs(std::stold(stated) - value) <= kPrinted * value, claim,
                        std::stold(stated), value, "1.4826 times the median residual");
    };
    // of the points that are left, none else
    if (std::regex_search(err, found, std::regex(R"(the others scatter by (\S+) units)"))) {
      near("outliers: scatter", found[1].str());
      tight("outliers: scatter of the others", found[1].str(), own.without_curve);
    } else if (std::regex_search(err, found, std::regex(R"(the others lie (\S+) units off)"))) {
      tight("outliers: residual of the others", found[1].str(), own.seen);
    } else if (rows.size() < points_.size() && err.find("left out") != std::string::npos) {
      out_.sheet.missing("outliers: scatter of the others", "left out");
    }
    const std::regex automatic(
        R"(points may move (\S+) units, (\S+) times their scatter of (\S+) )");
    if (!std::regex_search(err, found, automatic)) return;
    near("noise auto: scatter", found[3].str());
    tight("noise auto: scatter of the points", found[3].str(), own.without_curve);
    // only as many as the file has were looked at: P(|z| > k) <= exp(-k^2/2) of each
    const Real k = std::sqrt(2.0L * std::log(static_cast<Real>(rows.size()) / 0.05L));
    out_.sheet.expect(std::abs(std::stold(found[2].str()) - k) <= 0.01L * k, "noise auto: factor",
                      std::stold(found[2].str()), k, "");
  }

  /// Neighbours of the curve are neighbours in the file.
  void order(const std::string& err, const std::vector<std::size_t>& rows,
             const std::vector<std::size_t>& named) {
    std::smatch found;
    const std::regex told(
        R"(--unordered: (\d+) points were put in the order.* at most (\S+) units )"
        R"(apart, the ends ([^ ;]+))");
    if (!std::regex_search(err, found, told)) {
      return out_.sheet.fails("unordered", "a contour", "nothing is told of the order", "");
    }
    const bool all = std::stoul(found[1].str()) == rows.size();  // none left out behind that
    out_.sheet.expect(all || std::stoul(found[1].str()) <= rows.size() + named.size(), "unordered",
                      std::stold(found[1].str()), static_cast<long double>(rows.size()), "points");
    if (!all) return;
    Real largest = 0.0L;
    for (std::size_t k = 1; k < rows.size(); ++k) {
      largest = std::max(largest, norm(points_[rows[k]] - points_[rows[k - 1]]));
    }
    const Real ends = norm(points_[rows.back()] - points_[rows.front()]);
    constexpr Real kPrinted = 1e-3L;  // four digits
    const auto same = [&](const std::string& stated, Real value, const char* what) {
      out_.sheet.expect(std::abs(std::stold(stated) - value) <= kPrinted * value, "unordered",
                        std::stold(stated), value, what);
    };
    same(found[2].str(), largest, "largest step");
    same(found[3].str(), ends, "ends");
    // in steps of one along the curve, one way or the other; around a closed one past its seam once
    std::size_t back = 0, forth = 0;
    for (std::size_t k = 1; k < rows.size(); ++k) ++(rows[k] > rows[k - 1] ? forth : back);
    const std::size_t against = std::min(back, forth);
    if (named.empty()) {
      out_.sheet.expect(against <= (curve_.closed ? 1U : 0U), "unordered", 0.0L,
                        static_cast<long double>(against), "steps back along the curve");
    }
  }

  /// All that is said of the contour itself, through the points that are left.
  void contour(const ContourFile& file, const std::vector<std::size_t>& rows, const Run& fit) {
    const Course course(file);
    judge_course(course, out_.sheet);
    std::string text = "x,y\n";
    for (const std::size_t row : rows) text += line_of(points_[row]);
    std::vector<std::string> options{"--noise", "auto"};
    if (curve_.closed) options.emplace_back("--closed");
    check_input(course, read_input(text, options), out_.sheet);
    check_fit_text(course, fit, out_.sheet);
    check_exit(&course, fit, out_.sheet);
  }

  Dice dice_;
  ScannedCurve curve_;
  Real scale_ = 1.0L, deviation_ = 0.0L;  ///< of each coordinate
  Vec offset_;
  std::vector<Real> parameters_;   ///< along the curve
  std::vector<Vec> points_;        ///< along the curve
  std::vector<std::size_t> list_;  ///< row of each point of the file
  bool unordered_ = false;
  std::vector<std::string> given_;
};

}  // namespace

Trial run_scan_trial(const TrialOptions& options, std::uint64_t index) {
  return ScanTrial(options, index).run();
}

}  // namespace judge
