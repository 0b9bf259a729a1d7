// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fit/prepare.h"
#include "obvid/chain/internal/series_chain.h"
#include "obvid/core/internal/watch.h"

namespace obvid::pipeline_detail {

/// A line or arc that the points mean and the contour does not have.
struct MissingPiece {
  std::string name;        ///< "a line (points 3-9)"
  std::size_t points = 0;  ///< how many mean it
  std::string because;
};

/// Elements of one section; `chain.source` counts the points of the whole series. A smooth loop
/// ends with its first element again.
struct SectionChain {
  SeriesChain chain;
  NodeData seam{};  ///< what was given where a smooth loop begins; the chain holds that element
  std::vector<std::string> warnings;
  bool at_the_edge = false;  ///< of `edge_chain`: what is given leaves no fairer one that was found
  std::vector<MissingPiece> missing{};
  std::size_t given_up = 0;  ///< lines and arcs that the points mean and that are not kept
  std::string strays{};      ///< what is said of points that break them
  bool lacks_some = false;   ///< lines and arcs that were asked for, where points may mean them
  bool is_bare = false;      ///< one of several sections, without a line or arc that were asked for
};

/// Headings and curvatures for a section: through its points, or within their tolerances with few
/// vertices. Errors: E401, E402, E403, E404, E405, naming points of the whole series.
[[nodiscard]] Result<SectionChain> chain_section(const Prepared& series, const Section& section,
                                                 Watch& watch);

/// What is said where no line and no arc is found: of all points, or between some of them.
[[nodiscard]] std::string no_primitives_text(const std::string& where = {});

/// Chains of sections that were found already, and refusals: one search serves all that is made of
/// its result, the G2 and the G3 contour, and carriers of one comparison. Not for two threads.
class FoundChains {
 public:
  /// `chain_section`, unless the same was asked before.
  [[nodiscard]] Result<SectionChain> chain(const Prepared& series, const Section& section,
                                           Watch& watch);

  /// From now on another contour is formed: what was found is at hand for it.
  void begin_another();
  /// What the searches took that it would have made by itself.
  [[nodiscard]] double spared_seconds() const { return spared_; }

 private:
  struct Asked {
    std::size_t first, last;
    bool loop, thin, convex, primitives;
    Prefer prefer;
    std::vector<Vec2> points;
    std::vector<double> reach;
    std::vector<FixedData> fixed;
    std::optional<WholePiece> whole;
    std::vector<std::size_t> loose;

    bool operator==(const Asked&) const = default;
  };
  struct Found {
    Asked asked;
    Result<SectionChain> chain;
    double seconds;
    bool counts;  ///< its time, when it is used
  };

  std::vector<Found> found_;
  double spared_ = 0.0;
};

/// `fit`, with chains that were found before and those that will be of use later.
[[nodiscard]] Result<Fit> fit_with(const PointSeries& series, const FitJob& job,
                                   FoundChains& chains, Watch& watch);

}  // namespace obvid::pipeline_detail
