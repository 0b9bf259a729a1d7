// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "families.h"
#include "stock.h"

namespace obvid::toolpath {

/// Looks over the whole stock that a family of passes leaves, and adds passes half way between
/// those on whose two sides the cutter would have to be to take off what is too high. Finds what
/// lies between no two contacts: where these leap from one side of the cutter to the other.
class ScallopSurvey {
 public:
  ScallopSurvey(const Part& part, const ToolpathOptions& options, const StepRule& rule,
                Walker& walker);

  /// Adds passes to the family where a scallop is asked for; their number. `added`: called for
  /// each.
  template <class Added>
  Result<std::size_t> complete(Family& family, const Progress& progress, const Added& added) {
    for (const Pass& pass : family) stock_.cut(pass);
    std::size_t count = 0;
    for (int round = 0; limit_ > 0.0 && round < kMostRounds; ++round) {
      auto extra = wanted(family);
      for (std::size_t k = extra.size(); k-- > 0;) {  // from the end: numbers before stay
        auto pass = walker_.walk(extra[k].rail);
        if (!pass) return fail(pass.error());
        if (progress) progress("scallops", static_cast<double>(round) / kMostRounds);
        if (pass->empty()) continue;
        stock_.cut(*pass);
        added(*pass);
        ++count;
        family.insert(family.begin() + static_cast<std::ptrdiff_t>(extra[k].behind + 1),
                      std::move(*pass));
      }
      if (extra.empty()) break;
    }
    return count;
  }

  [[nodiscard]] HighSpot highest() { return stock_.highest(); }
  [[nodiscard]] double raster() const { return stock_.spacing(); }

 private:
  static constexpr int kMostRounds = 10;

  struct Wanted {
    std::size_t behind = 0;  ///< pass of the family
    Rail rail;
  };
  /// Where on a family's rails the cutter touches a place: t along them, and across.
  struct Across {
    double t = 0.0, across = 0.0;
  };
  struct Sides {
    std::size_t low = 0, high = 0;
    friend bool operator<(const Sides& a, const Sides& b) {
      return a.low != b.low ? a.low < b.low : a.high < b.high;
    }
  };

  [[nodiscard]] std::vector<Wanted> wanted(const Family& family);
  [[nodiscard]] Across across(const Place& place) const;
  [[nodiscard]] std::optional<double> across(const Rail& rail, const Place& place, double t) const;
  [[nodiscard]] std::optional<Sides> sides(const Family& family, const Place& place) const;
  [[nodiscard]] Vec2 outside(const Rail& rail, const std::vector<Place>& places) const;
  [[nodiscard]] double length(const Rail& rail) const;

  const Part& part_;
  Walker& walker_;
  bool of_parameters_, along_v_;
  PassFrame frame_;
  double level_, limit_ = 0.0;
  Stock stock_;
};

}  // namespace obvid::toolpath
