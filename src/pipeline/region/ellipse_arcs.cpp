// SPDX-License-Identifier: Apache-2.0
// Conics of [003] at fixed tangents: docs/methods/conics.md, section 3.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "obvid/contour/conics.h"
#include "obvid/curve/internal/end_curvatures.h"
#include "obvid/pipeline/internal/region_files.h"
#include "obvid/region/internal/boundary_distance.h"
#include "obvid/region/internal/convex_triangle.h"
#include "region/construction_section.h"

namespace obvid::pipeline_detail {
namespace {

/// Curvatures that differ by less are equal, relative.
constexpr double kSameConicCurvature = 1e-9;

/// One conic: over a segment, or over the part of one up to an inflection.
struct ConicArc {
  std::size_t row = 0;
  Element start, end;   ///< with the curvatures that bound its region
  bool begins = false;  ///< behind an inflection, or at an end: nothing is carried on
  std::optional<RationalBezier> made;
  double weight = 0.0;
};

bool turns_left(const ConicArc& arc) {
  return cross(unit_at(arc.start.theta), arc.end.point - arc.start.point) > 0.0;
}

class EllipseArcs {
 public:
  EllipseArcs() {
    out_.construction = Construction::kEllipses;
    out_.columns = {"w", "R", "R'", "f", "outside"};
  }

  Result<void> add(const ConstructionSection& section) {
    section_ = &section;
    arcs_.clear();
    if (auto done = collect(); !done) return done;
    const std::size_t first = section.loop ? best_start() : 0;
    std::rotate(arcs_.begin(), arcs_.begin() + static_cast<std::ptrdiff_t>(first), arcs_.end());
    if (section.loop && turns_left(arcs_.back()) != turns_left(arcs_.front())) inflection_ = true;
    for (std::size_t from = 0; from < arcs_.size();) {
      std::size_t to = from + 1;
      while (to < arcs_.size() && !arcs_[to].begins) ++to;
      if (auto done = form_convex(from, to); !done) return done;
      from = to;
    }
    if (section.loop) note_step(arcs_.back(), arcs_.front());
    std::rotate(arcs_.begin(), arcs_.end() - static_cast<std::ptrdiff_t>(first), arcs_.end());
    put_all();
    return {};
  }

  ConstructionTable told() {
    out_.remarks.emplace_back(
        "the first arc passes K, in the middle of what the region cuts out of the median; equal "
        "curvature decides all others");
    if (moved_k_) {
      out_.remarks.emplace_back(
          "K was moved inside the region where arcs would not have been ellipses");
    }
    if (!steps_.empty()) {
      out_.remarks.push_back(fmt::format(
          "the curvature steps (G1) at {} {}: with these tangents no ellipses carry it on there, "
          "and the next part begins with a K of its own",
          steps_.size() == 1 ? "point" : "points", fmt::join(steps_, ", ")));
    }
    if (inflection_) {
      out_.remarks.emplace_back(
          "no ellipse has curvature 0: at an inflection the curvature steps (G1), and the next "
          "part "
          "begins with a K of its own");
    }
    return std::move(out_);
  }

 private:
  Result<void> collect() {
    std::optional<std::vector<double>> kappa;
    for (std::size_t k = section_->first; k < section_->last; ++k) {
      if (!section_->row(k).region) return fail(section_->no_region(k));
      const auto [start, end] = section_->bounded(k);
      const bool convex =
          tangent_triangle(start.point, unit_at(start.theta), end.point, unit_at(end.theta))
              .has_value();
      if (convex) {
        append({k, start, end, false, {}, 0.0});
        continue;
      }
      if (!kappa) {
        auto found = common_curvatures(*section_);
        if (!found) return fail(found.error());
        kappa = std::move(*found);
      }
      if (auto done = append_halves(k, start, end, *kappa); !done) return done;
    }
    return {};
  }

  void append(ConicArc arc) {
    const bool turns = !arcs_.empty() && turns_left(arc) != turns_left(arcs_.back());
    arc.begins = arc.begins || turns;
    inflection_ = inflection_ || arc.begins;
    arcs_.push_back(std::move(arc));
  }

  Result<void> append_halves(std::size_t k, const Element& start, const Element& end,
                             const std::vector<double>& kappa) {
    Element a = start, b = end;
    a.kappa = kappa[k - section_->first];
    b.kappa = kappa[k - section_->first + 1];
    const double chord = norm(b.point - a.point);
    const bool turns =
        a.kappa * b.kappa < 0.0 && !is_straight(a.kappa, chord) && !is_straight(b.kappa, chord);
    const auto middle = turns ? inflection_between(a, b, *section_->row(k).direction)
                              : fail(section_->no_region(k));
    if (!middle) return fail(middle.error());
    append({k, start, *middle, false, {}, 0.0});
    append({k, *middle, end, true, {}, 0.0});
    return {};
  }

  [[nodiscard]] int direction(const ConicArc& arc) const {
    return section_->row(arc.row).direction.value_or(0);
  }

  /// Of a loop: behind an inflection, else the sharpest vertex, else the first point.
  [[nodiscard]] std::size_t best_start() const {
    const std::size_t n = arcs_.size();
    std::size_t best = 0;
    double sharpest = -1.0;
    for (std::size_t i = 0; i < n; ++i) {
      const ConicArc& before = arcs_[(i + n - 1) % n];
      if (turns_left(before) != turns_left(arcs_[i])) return i;
      const double kappa = std::abs(section_->start_of(arcs_[i].row).kappa);
      if (direction(before) == direction(arcs_[i]) || kappa <= sharpest) continue;
      best = i;
      sharpest = kappa;
    }
    return best;
  }

  /// Arcs that turn one way: from the K of the first as far as they are ellipses, then on with a K
  /// of its own, from a vertex where there is one.
  Result<void> form_convex(std::size_t from, std::size_t to) {
    while (from < to) {
      auto chain = chain_from(from, to, median_weight(arcs_[from].start, arcs_[from].end));
      if (!chain) return fail(chain.error());
      const std::size_t vertex = next_vertex(from, to);
      if (elliptic_until(*chain) < vertex - from) {
        const std::size_t kept = elliptic_until(*chain);
        auto weight = other_weight(from, vertex, *chain);
        if (!weight && kept == 0) weight = other_weight(from, from + 1, *chain);
        if (weight) {
          chain = chain_from(from, to, weight);
          if (!chain) return fail(chain.error());
          moved_k_ = true;
        }
      }
      const std::size_t good = elliptic_until(*chain);
      std::size_t next = good == to - from ? to : last_vertex(from, from + good);
      if (next == from) next = from + std::max(good, std::size_t{1});
      for (std::size_t i = from; i < next; ++i) {
        arcs_[i].weight = chain->weights[i - from];
        arcs_[i].made = unblurred(arcs_[i], chain->pieces[i - from]);
      }
      if (next < to) {
        steps_.push_back(region_point_name(section_->point(section_->row(arcs_[next].row).from)));
      }
      from = next;
    }
    return {};
  }

  /// The conic with its start as origin where the rounding of coordinates would change its radii.
  static RationalBezier unblurred(const ConicArc& arc, const RationalBezier& made) {
    constexpr double kMetRadius = 1e-9;  // of the curvature
    const Element start{{}, arc.start.theta, arc.start.kappa};
    const Element end{arc.end.point - arc.start.point, arc.end.theta, arc.end.kappa};
    const auto near = conic_chain({start, end}, {arc.weight});
    if (!near) return made;
    RationalBezier local = near->pieces.front();
    const auto same = [&](bool at_start) {
      const double kappa = stored_curvature(local, at_start);
      return std::abs(stored_curvature(made, at_start) - kappa) <= kMetRadius * std::abs(kappa);
    };
    if (same(true) && same(false)) return made;
    local.origin = arc.start.point;
    return local;
  }

  [[nodiscard]] Result<ConicChain> chain_from(std::size_t from, std::size_t to,
                                              std::optional<double> weight) const {
    if (!weight) return fail(section_->no_region(arcs_[from].row));
    std::vector<Element> elements{arcs_[from].start};
    for (std::size_t i = from; i < to; ++i) elements.push_back(arcs_[i].end);
    return conic_chain(elements, {weight});
  }

  static std::size_t elliptic_until(const ConicChain& chain) {
    const auto at = std::find_if(chain.weights.begin(), chain.weights.end(),
                                 [](double w) { return !(w < 1.0); });
    return static_cast<std::size_t>(at - chain.weights.begin());
  }

  /// The last vertex between arcs of a range, or its start.
  [[nodiscard]] std::size_t last_vertex(std::size_t from, std::size_t to) const {
    for (std::size_t i = to; i > from; --i) {
      if (i < arcs_.size() && direction(arcs_[i]) != direction(arcs_[i - 1])) return i;
    }
    return from;
  }
  [[nodiscard]] std::size_t next_vertex(std::size_t from, std::size_t to) const {
    for (std::size_t i = from + 1; i < to; ++i) {
      if (direction(arcs_[i]) != direction(arcs_[i - 1])) return i;
    }
    return to;
  }

  /// A first weight inside the region with which all arcs up to the next vertex are ellipses.
  [[nodiscard]] std::optional<double> other_weight(std::size_t from, std::size_t end,
                                                   const ConicChain& chain) const {
    const auto region = region_weights(arcs_[from].start, arcs_[from].end);
    if (!region) return std::nullopt;
    double largest = 0.0;
    for (std::size_t i = 0; i < end - from; ++i) {
      largest = std::max(largest, chain.weights[i] / chain.weights[0]);
    }
    const double high = std::min(region->high, 1.0 / largest);
    if (!(region->low < high)) return std::nullopt;
    const double on_median = 0.5 * (region->low / (1.0 + region->low) + high / (1.0 + high));
    return on_median / (1.0 - on_median);
  }

  void note_step(const ConicArc& before, const ConicArc& behind) {
    if (turns_left(before) != turns_left(behind)) return;
    const double k0 = stored_curvature(*before.made, false);
    const double k1 = stored_curvature(*behind.made, true);
    if (std::abs(k1 - k0) <= kSameConicCurvature * std::max(std::abs(k0), std::abs(k1))) return;
    steps_.push_back(region_point_name(section_->point(section_->row(behind.row).from)));
  }

  void put_all() {
    for (std::size_t i = 0; i < arcs_.size(); ++i) {
      const bool split = i + 1 < arcs_.size() && arcs_[i + 1].row == arcs_[i].row;
      if (!split) {
        put(arcs_[i], false);
        continue;
      }
      const auto first = values_of(arcs_[i]), second = values_of(arcs_[i + 1]);
      add_row(out_, arcs_[i].row,
              {kNoFigure, first[1], second[2], std::max(first[3], second[3]),
               std::max(first[4], second[4])},
              fmt::format("two arcs, inflection at {:.6g}, {:.6g}", arcs_[i].end.point.x,
                          arcs_[i].end.point.y));
      put(arcs_[i], true);
      put(arcs_[++i], true);
    }
  }

  [[nodiscard]] std::vector<double> values_of(const ConicArc& arc) const {
    const Piece piece{*arc.made};
    const auto [start, end] = section_->bounded(arc.row);
    const auto placed = place_in_region(piece, start, end, direction(arc));
    return {arc.weight, 1.0 / stored_curvature(*arc.made, true),
            1.0 / stored_curvature(*arc.made, false), placed ? placed->farther : kNoFigure,
            placed ? placed->outside : kNoFigure};
  }

  void put(const ConicArc& arc, bool part) {
    const bool one_way = conic_direction(*arc.made) != 0;
    const char* kind = arc.weight < 1.0 ? "ellipse" : arc.weight > 1.0 ? "hyperbola" : "parabola";
    std::string remark = fmt::format("{}, {}", kind, one_way ? "monotone" : "vertex inside");
    const auto allowed = monotone_weights(arc.start, arc.end);
    if (!one_way && allowed) {
      remark += fmt::format("; none for w in {:.4g}..{:.4g}", allowed->low, allowed->high);
    } else if (!one_way) {
      remark += "; with these tangents every ellipse arc has one";
    }
    add_row(out_, arc.row, values_of(arc), std::move(remark));
    out_.rows.back().detail = part;
    put_piece(out_, arc.row, *arc.made);
  }

  const ConstructionSection* section_ = nullptr;
  std::vector<ConicArc> arcs_;
  std::vector<std::string> steps_;  // points where the curvature is not carried on
  bool inflection_ = false, moved_k_ = false;
  ConstructionTable out_;
};

}  // namespace

Result<ConstructionTable> ellipse_arcs(const std::vector<ConstructionSection>& sections) {
  EllipseArcs maker;
  for (const ConstructionSection& section : sections) {
    if (auto done = maker.add(section); !done) return fail(done.error());
  }
  return maker.told();
}

}  // namespace obvid::pipeline_detail
