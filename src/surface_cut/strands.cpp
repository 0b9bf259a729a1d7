// SPDX-License-Identifier: Apache-2.0
#include "strands.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace obvid {
namespace {

/// Lines of cells' sides: which family, and where, exactly.
using LineKey = std::tuple<bool, std::size_t, double>;
struct EndsOnLine {
  std::array<std::vector<std::pair<double, EndNumber>>, 2> side;  ///< above, below: where, which
};

class StrandFinder {
 public:
  StrandFinder(const CutPatch& patch, std::size_t number) : patch_(patch), number_(number) {}

  void take(const SectionCell& cell, CellKind kind) {
    if (kind == CellKind::kUndecided) out_.undecided.push_back(cell);
    if (cell.halvings == kNearlyTouching + 1) out_.near.push_back(cell);
    if (kind != CellKind::kOverU && kind != CellKind::kOverV) return;
    const bool over_u = kind == CellKind::kOverU;
    // sides at the ends of the parameter that the branch is a function of, and the two others
    const std::size_t first = over_u ? 0 : 2, low = over_u ? 2 : 0;
    std::vector<StrandEnd> ends = ends_on(cell, first);
    std::vector<StrandEnd> inner = ends_on(cell, low), more = ends_on(cell, low + 1);
    inner.insert(inner.end(), more.begin(), more.end());
    std::sort(inner.begin(), inner.end(),
              [](const StrandEnd& a, const StrandEnd& b) { return a.along < b.along; });
    ends.insert(ends.end(), inner.begin(), inner.end());
    more = ends_on(cell, first + 1);
    ends.insert(ends.end(), more.begin(), more.end());
    if (ends.size() % 2 != 0) {
      out_.undecided.push_back(cell);  // only where roots lie closer than they can be told apart
      return;
    }
    const Range across = over_u ? cell.shares_v() : cell.shares_u();
    const BezierRows& other = over_u ? patch_.v : patch_.u;
    const std::size_t span = over_u ? cell.span_v : cell.span_u;
    for (std::size_t i = 0; i < ends.size(); i += 2) {
      Strand strand;
      strand.patch = number_;
      strand.over_u = over_u;
      strand.end = {ends[i], ends[i + 1]};
      strand.least = other.at(span, across.from);
      strand.most = other.at(span, across.to);
      out_.strands.push_back(strand);
    }
  }

  PatchStrands joined() {
    out_.mate.assign(2 * out_.strands.size(), kNoEnd);
    std::map<LineKey, EndsOnLine> lines;
    for (std::size_t i = 0; i < out_.strands.size(); ++i) {
      for (std::size_t k = 0; k < 2; ++k) {
        const StrandEnd& end = out_.strands[i].end[k];
        lines[{end.on_u_line, end.span, end.share}].side[end.low ? 1 : 0].push_back(
            {end.along, 2 * i + k});
      }
    }
    for (auto& [key, ends] : lines) join(ends);
    return std::move(out_);
  }

 private:
  [[nodiscard]] std::vector<StrandEnd> ends_on(const SectionCell& cell, std::size_t side) const {
    std::vector<StrandEnd> out;
    const bool on_u_line = side < 2, far = side % 2 == 1;
    const Range along = on_u_line ? cell.shares_v() : cell.shares_u();
    const Range across = on_u_line ? cell.shares_u() : cell.shares_v();
    const std::size_t span = on_u_line ? cell.span_u : cell.span_v;
    const std::size_t other = on_u_line ? cell.span_v : cell.span_u;
    const double share = far ? across.to : across.from;
    for (const double t : sign_changes(side_of(cell, patch_.u.degree, patch_.v.degree, side))) {
      StrandEnd end;
      end.on_u_line = on_u_line;
      end.low = far;
      end.span = share < 1.0 ? span : span + 1;
      end.share = share < 1.0 ? share : 0.0;
      end.along = static_cast<double>(other) + along.at(t);
      const double here = (on_u_line ? patch_.u : patch_.v).at(span, share);
      const double there = (on_u_line ? patch_.v : patch_.u).at(other, along.at(t));
      end.u = on_u_line ? here : there;
      end.v = on_u_line ? there : here;
      out.push_back(end);
    }
    return out;
  }

  /// Cells on both sides of a line have the same roots in the same order; where a cell between was
  /// given up, those that are no farther apart than rounding.
  void join(EndsOnLine& ends) {
    constexpr double kSameRoot = 1e-9;  // spans
    for (auto& side : ends.side) std::sort(side.begin(), side.end());
    const bool all = ends.side[0].size() == ends.side[1].size();
    std::size_t i = 0, j = 0;
    while (i < ends.side[0].size() && j < ends.side[1].size()) {
      const auto [a, first] = ends.side[0][i];
      const auto [b, second] = ends.side[1][j];
      if (all || std::abs(a - b) <= kSameRoot) {
        out_.mate[first] = second;
        out_.mate[second] = first;
        ++i;
        ++j;
      } else {
        ++(a < b ? i : j);
      }
    }
  }

  const CutPatch& patch_;
  std::size_t number_;
  PatchStrands out_;
};

}  // namespace

StrandOfCell strand_of_cell(const SectionCell& cell, int degree_u, int degree_v, bool over_u,
                            Range across) {
  StrandOfCell out;
  out.strand.over_u = over_u;
  out.strand.least = across.from;
  out.strand.most = across.to;
  out.cuts = {0.0, 1.0};
  for (const std::size_t side :
       over_u ? std::array<std::size_t, 2>{2, 3} : std::array<std::size_t, 2>{0, 1}) {
    for (const double t : sign_changes(side_of(cell, degree_u, degree_v, side))) {
      out.cuts.push_back(t);
    }
  }
  std::sort(out.cuts.begin(), out.cuts.end());
  return out;
}

Result<PatchStrands> strands_of(const CutPatch& patch, std::size_t number, const CutPlane& plane,
                                double noise, const RunContext& run) {
  StrandFinder finder(patch, number);
  const std::vector<double> heights = heights_of(*patch.surface, plane);
  OBVID_TRY(divide(patch, heights, noise, run,
                   [&](const SectionCell& cell, CellKind kind) { finder.take(cell, kind); }));
  return finder.joined();
}

}  // namespace obvid
