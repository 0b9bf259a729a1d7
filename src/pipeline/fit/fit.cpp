// SPDX-License-Identifier: Apache-2.0
#include "obvid/pipeline/fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "fit/assemble.h"
#include "fit/corners_between.h"
#include "fit/edge_chain.h"
#include "fit/excursion.h"
#include "fit/form.h"
#include "fit/given.h"
#include "fit/keep_joints.h"
#include "fit/parabola_room.h"
#include "fit/parts.h"
#include "fit/pass_points.h"
#include "fit/prepare.h"
#include "fit/section_chain.h"
#include "fit/slope_step.h"
#include "fit/taken_back.h"
#include "fit/waviness.h"
#include "fit/whole_sections.h"
#include "obvid/certify/certify.h"
#include "obvid/chain/internal/smooth_chain.h"
#include "obvid/contour/common/internal/carry.h"
#include "obvid/core/internal/figures.h"
#include "obvid/curve/internal/runs.h"
#include "obvid/pipeline/internal/lines_and_arcs.h"
#include "obvid/region/internal/refine.h"
#include "obvid/series/internal/order.h"
#include "obvid/series/internal/scatter.h"
#include "verify/against_spirals.h"
#include "verify/report.h"

namespace obvid {
namespace {

using namespace contour_detail;
using namespace pipeline_detail;

/// Rounds in which the tolerance of points that the finished contour misses is narrowed: between
/// nodes the search knows the contour only to first order.
constexpr int kNarrowings = 6;
constexpr double kNarrowed = 0.95;  ///< of what would just do
/// Of the reach, where within the whole of it points change places or the contour swings out: one
/// that passes them nearer passes them near enough.
constexpr int kReachHalvings = 4;
/// No further round begins when so many steps on every point (and some more where there are few)
/// were spent: a hundred times what a contour takes as a rule.
constexpr double kMostFitSteps = 1e4, kSpareWork = 1e6;
/// The same, of halving the reach a second time and more often.
constexpr double kMostHalvingSteps = 500.0;
/// Parts of the tolerances that are tried where none within the whole of them is found, and the
/// work for that.
constexpr double kPartsOfReach[] = {0.3, 0.1, 0.03, 0.01, 0.001};
constexpr double kMostNearerSteps = 2500.0, kSpareNearer = 5e5;
/// The same, of looking for one through the points as they are.
constexpr double kMostExactSteps = 1e4, kSpareExact = 5e5;
constexpr double kFormedAt = 0.7;  ///< part of the bar when all sections are formed
/// Arcs whose regions came out wider than asked, by the rounding of their ends, are formed again.
constexpr int kArcTrials = 2;
constexpr double kNarrowedArcs = 0.99;  ///< of what would just do

/// How often runs are given back their G2 spirals where the smooth ones are not proved.
constexpr int kKeptRounds = 4;
/// How often a smooth contour is led nearer to points that it passes too far.
constexpr int kMostPassings = 16;

/// Spirals whose stored numbers have the curvatures of their joints.
Result<Contour> exact_spirals(const Prepared& series, const SeriesChain& chain, Watch& watch) {
  auto out = carry_spiral(
      {}, {.points = series.points, .chain = chain, .given = series.given, .watch = watch});
  OBVID_TRY(out);
  return std::move(out->contour);
}

/// A section in its carrier; `spirals` as `Carry` has them. Carriers that promise nothing do not
/// know their runs.
Result<Carried> form(const Contour& spirals, const CarryOptions& options, Carrier carrier) {
  auto out = builder_of(carrier)(spirals, options);
  OBVID_TRY(out);
  if (promises_monotone(carrier)) return out;
  const auto direction = proved_directions(out->contour.pieces, options.watch);
  OBVID_TRY(direction);
  out->contour.runs = collect_runs(*direction);
  return out;
}

/// A curve of points alone asks for no headings and curvatures; those given at its ends it keeps.
Result<Carried> form_of_points(const Prepared& series, const Section& section, Carrier carrier,
                               Watch& watch) {
  const bool loop = series.split.smooth_loop;
  const std::size_t last = loop ? series.points.size() : section.last;
  Contour joints;
  for (std::size_t k = section.first; k <= last; ++k) {
    const std::size_t point = series.split.point_at(k) % series.points.size();
    joints.joints.push_back({{series.points[point], 0.0, 0.0}, point});
  }
  const auto heading_at = [&](const Joint& end) {
    return series.fixed.empty() ? std::nullopt : series.fixed[*end.source].theta;
  };
  const SeriesChain none;
  return form(joints,
              {.points = series.points,
               .chain = none,
               .given = series.given,
               .loop = loop,
               .start_heading = heading_at(joints.joints.front()),
               .end_heading = heading_at(joints.joints.back()),
               .watch = watch},
              carrier);
}

/// One attempt at the whole contour, with how it was found.
struct Formed {
  Contour contour;
  std::optional<Contour> spirals;  ///< that another carrier stands for
  ChainReport chain;
  std::vector<std::string> warnings;
  bool lacks_primitives = false;  ///< points may mean lines and arcs that it does not have

  void add(Carried section, Assembly& assembly) {
    warnings.insert(warnings.end(), section.warnings.begin(), section.warnings.end());
    assembly.append(std::move(section.contour));
  }
};

/// How far the contour may pass each point: a carrier that follows the spirals needs its tolerance.
std::vector<double> point_tolerance(const Prepared& series, Carrier carrier, double tolerance) {
  std::vector<double> out = series.tolerance;
  if (!out.empty()) out.resize(series.measured());
  if (!info_of(carrier).between_joints) return out;
  out.resize(series.measured(), 0.0);
  for (double& one : out) one = std::max(one, tolerance);
  return out;
}

void add_section(const SectionChain& section, Formed& formed) {
  ChainReport& sum = formed.chain;
  const SeriesChain& one = section.chain;
  sum.smallest_margin = sum.newton_steps == 0 ? one.smallest_margin
                                              : std::min(sum.smallest_margin, one.smallest_margin);
  sum.newton_steps += one.newton_steps;
  sum.free_elements += one.free_elements;
  for (const std::string& text :
       section.warnings) {  // sections between corners say the same things
    const auto said = std::find(formed.warnings.begin(), formed.warnings.end(), text);
    if (said == formed.warnings.end()) formed.warnings.push_back(text);
  }
}

/// Where G3 could not be had, for the user.
std::string slope_steps_text(const Prepared& series, const SeriesChain& chain,
                             const SmoothedSlopes& slopes) {
  std::size_t point = 0;  // at the first of them, or before it
  for (std::size_t i = 0; i <= slopes.stepped.front(); ++i) point = chain.source[i].value_or(point);
  return fmt::format(
      "no common slope of curvature was found at {} of {} joints, first beside point {}: G2 there",
      slopes.stepped.size(), slopes.joints, series.named(point) + 1);
}

/// Parts of a series whose runs stay G2 where slopes are made continuous.
struct KeptParts {
  std::vector<bool> around;   ///< points that the runs pass between their elements
  std::vector<bool> leaving;  ///< points at which a part between two elements begins

  [[nodiscard]] bool empty() const { return around.empty(); }
  void make(std::size_t points) {
    around.resize(points, false);
    leaving.resize(points, false);
  }
};

bool is_made_g3(const FitJob& job) { return wanted_continuity(job) == Continuity::kG3; }

/// Whether the slopes of the spirals' curvature are made continuous.
bool makes_slopes_continuous(const FitJob& job) {
  return is_made_g3(job) || (follows_spirals(job.carrier) && job.followed == Continuity::kG3);
}

/// Sections that are named in a warning.
constexpr std::size_t kMostBareNamed = 4;
/// Lines and arcs that are named where the contour does not have them; of more the longest ones.
constexpr std::size_t kMostMissingNamed = 4;

/// Forms the sections one after the other, and beside them the spirals of the same elements.
class SectionForming {
 public:
  SectionForming(const Prepared& series, const FitJob& job, double tolerance, FoundChains& chains,
                 Watch& watch)
      : series_(with_whole_sections(series)),
        job_(job),
        tolerance_(tolerance),
        chains_(chains),
        watch_(watch),
        place_(places_of(series_.split.order)),
        have_spirals_(job.measure_against_spirals) {}

  static Prepared with_whole_sections(Prepared series) {
    lay_whole_sections(series);
    for (std::size_t i = series.measured(); i < series.placed.size(); ++i) {
      series.points[i] = series.placed[i];
    }
    return series;
  }

  /// Runs of these parts keep their G2 spirals.
  SectionForming& keeping(const KeptParts& parts) {
    kept_ = parts;
    return *this;
  }

  Result<Formed> run() {
    for (std::size_t k = 0; k < series_.split.sections.size() && !watch_.cancelled(); ++k) {
      OBVID_TRY(form_one(k));
    }
    if (watch_.was_cancelled()) return fail(cancelled_error());  // sections are missing
    tell_bare_sections();
    out_.contour = finished(assembly_, job_.carrier);
    tell_missing();
    tell_given_up();
    if (steps_everywhere(out_.contour)) {
      claim_slopes(out_.contour, false);
      out_.chain.slope_step_g2.reset();
    }
    // pieces of a drawing have no part in it
    if (out_.chain.slope_step_g2 && series_.kept.empty()) {
      out_.chain.waviness_g2 = waviness_g2_.value();
    }
    if (have_spirals_ && follows_spirals(job_.carrier)) {
      out_.spirals = finished(spirals_, Carrier::kSpiral);
    }
    return std::move(out_);
  }

 private:
  /// Sections between corners without a line or arc, in one sentence.
  void tell_bare_sections() {
    if (bare_.empty()) return;
    const auto number = [&](std::size_t place, bool begins) {
      const std::size_t i = series_.split.point_at(place) % series_.points.size();
      const std::size_t on = begins && series_.is_between(i) ? 1 : 0;
      return (series_.named(i) + on) % series_.measured() + 1;
    };
    std::string where;
    const std::size_t named = std::min(bare_.size(), kMostBareNamed);
    for (std::size_t k = 0; k < named; ++k) {
      const Section& one = series_.split.sections[bare_[k]];
      where += fmt::format("{} points {} and {}", k == 0 ? " between" : ", between",
                           number(one.first, true), number(one.last, false));
    }
    if (bare_.size() > named) {
      where += " and in " + counted(bare_.size() - named, "section more", "sections more");
    }
    out_.warnings.push_back(no_primitives_text(where));
  }

  /// What the points mean and the contour does not have, of all sections: a sentence for each
  /// reason.
  void tell_missing() {
    std::stable_sort(missing_.begin(), missing_.end(),
                     [](const auto& a, const auto& b) { return a.because < b.because; });
    for (auto begin = missing_.begin(); begin != missing_.end();) {
      const auto end = std::find_if(begin, missing_.end(),
                                    [&](const auto& m) { return m.because != begin->because; });
      out_.warnings.push_back(
          fmt::format("the contour does not keep {}, which the points mean: {}{}",
                      names_of({begin, end}), begin->because, std::exchange(strays_, {})));
      begin = end;
    }
  }

  /// All of few, of many the number and the longest ones.
  static std::string names_of(std::vector<MissingPiece> all) {
    const std::size_t count = all.size();
    if (count > kMostMissingNamed) {
      std::stable_sort(all.begin(), all.end(),
                       [](const auto& a, const auto& b) { return a.points > b.points; });
      all.resize(kMostMissingNamed);
    }
    std::string out;
    for (const MissingPiece& one : all) out += (out.empty() ? "" : ", ") + one.name;
    if (count == all.size()) return out;
    return fmt::format("{} lines and arcs, of which the longest are {}", count, out);
  }

  /// Lines and arcs that are not kept, of all sections, beside those that the table has.
  void tell_given_up() {
    if (given_up_ == 0) return;
    const std::size_t kept = lines_and_arcs(out_.contour).size();
    out_.warnings.push_back(fmt::format(
        "{}the points mean {} that {} not kept: beside {} no transition was found that stays "
        "within the tolerance{}",
        kept == 0
            ? ""
            : "beside the " + counted(kept, "line or arc", "lines and arcs") + " of the contour ",
        counted(given_up_, kept == 0 ? "line or arc" : "more",
                kept == 0 ? "lines and arcs" : "more"),
        given_up_ == 1 ? "is" : "are", given_up_ == 1 ? "it" : "them", strays_));
  }

  Result<void> form_one(std::size_t k) {
    const auto count = static_cast<double>(series_.split.sections.size());
    const ProgressShare share(watch_, static_cast<double>(k) / count,
                              static_cast<double>(k + 1) / count);
    watch_.tell("choosing headings and curvatures", 0.0);
    const Section& section = series_.split.sections[k];
    if (form_drawn(section)) return {};
    const CarrierInfo& carrier = info_of(job_.carrier);
    if (carrier.needs == CarrierNeeds::kPoints) return form_points_alone(section);
    auto chain = chains_.chain(series_, section, watch_);
    OBVID_TRY(chain);
    if (chain->is_bare) bare_.push_back(k);
    given_up_ += chain->given_up;
    missing_.insert(missing_.end(), chain->missing.begin(), chain->missing.end());
    out_.lacks_primitives = out_.lacks_primitives || chain->lacks_some;
    if (strays_.empty()) strays_ = chain->strays;
    auto spirals = spirals_of(*chain);
    if (!spirals && (carrier.needs == CarrierNeeds::kSpirals || !follows_spirals(job_.carrier))) {
      return fail(spirals.error());
    }
    if (!follows_spirals(job_.carrier)) {
      assembly_.append(std::move(*spirals));
      add_section(*chain, out_);
      return {};
    }
    auto carried = form(spirals ? *spirals : Contour{},
                        {.points = series_.points,
                         .chain = chain->chain,
                         .given = series_.given,
                         .tolerance = tolerance_,
                         .loop = series_.split.smooth_loop,
                         .watch = watch_},
                        job_.carrier);
    OBVID_TRY(carried);
    out_.add(std::move(*carried), assembly_);
    add_section(*chain, out_);
    keep(std::move(spirals));
    return {};
  }

  /// The spirals of a section's elements, which become others where slopes are made continuous.
  Result<Contour> spirals_of(SectionChain& section) {
    auto spirals = exact_spirals(series_, section.chain, watch_);
    return spirals && makes_slopes_continuous(job_) ? smoothed(section, *spirals) : spirals;
  }

  /// The spirals with continuous slopes, as far as there are any. Where they pass points too far
  /// that the G2 spirals pass within their tolerances, they are led through the places of these.
  Result<Contour> smoothed(SectionChain& section, const Contour& spirals) {
    note_slope_step(spirals);
    const std::vector<bool> keep = kept_links(section.chain);
    PassingChain passing(section.chain, spirals, series_.points, series_.split.order);
    SeriesChain chain = section.chain;
    SmoothedSlopes slopes =
        smooth_slopes(chain, series_.split.smooth_loop, watch_, keep, section.seam);
    auto smooth = exact_spirals(series_, chain, watch_);
    for (int k = 0; smooth && !series_.exact() && k < kMostPassings; ++k) {
      if (!passing.pass(excess(*smooth)) || watch_.was_cancelled()) break;
      chain = passing.chain();
      slopes = smooth_slopes(chain, series_.split.smooth_loop, watch_, passing.in_links(keep),
                             section.seam);
      smooth = exact_spirals(series_, chain, watch_);
    }
    if (!smooth) return smooth;
    section.chain = std::move(chain);
    if (!slopes.stepped.empty() && job_.continuity == Continuity::kG3) {
      section.warnings.push_back(slope_steps_text(series_, section.chain, slopes));
    }
    return smooth;
  }

  /// How much too far the points of a section are passed; 0 for all others.
  [[nodiscard]] std::vector<double> excess(const Contour& section) const {
    Contour seen = section;
    seen.points = series_.points;
    seen.point_tolerance = series_.tolerance;
    const std::vector<double> distance = point_distances(seen, watch_);
    std::vector<double> out(distance.size(), 0.0);
    const auto mark = [&](std::size_t i) {
      out[i] = std::max(0.0, distance[i] - series_.tolerance[i]);
    };
    const Joint *first = &section.joints.front(), *last = &section.joints.back();
    if (!first->source || !last->source) return out;
    mark(*first->source);
    for (const std::size_t i : points_between(*first->source, *last->source)) mark(i);
    mark(*last->source);
    return out;
  }

  /// Points of the series between two of it, in order; around a loop where both are the same.
  [[nodiscard]] std::vector<std::size_t> points_between(std::size_t from, std::size_t to) const {
    const std::vector<std::size_t>& order = series_.split.order;
    const std::size_t n = order.size();
    std::vector<std::size_t> out;
    const std::size_t at = place_[from];
    for (std::size_t k = 1; k < n && order[(at + k) % n] != to; ++k) {
      out.push_back(order[(at + k) % n]);
    }
    return out;
  }

  /// Links whose runs stay as they are; empty when there are none.
  [[nodiscard]] std::vector<bool> kept_links(const SeriesChain& chain) const {
    std::vector<bool> out;
    std::size_t begun = 0;  // the first link behind a point
    for (std::size_t k = 1; k < chain.elements.size() && !kept_.empty(); ++k) {
      if (!chain.source[k]) continue;
      const std::size_t from = *chain.source[begun];
      const std::vector<std::size_t> between = points_between(from, *chain.source[k]);
      const bool keep = kept_.leaving[series_.named(from)] ||
                        std::any_of(between.begin(), between.end(), [&](std::size_t i) {
                          return !series_.is_between(i) && kept_.around[i];
                        });
      if (keep) {
        out.resize(chain.links.size(), false);
        std::fill(out.begin() + static_cast<std::ptrdiff_t>(begun),
                  out.begin() + static_cast<std::ptrdiff_t>(k), true);
      }
      begun = k;
    }
    return out;
  }

  /// Remembers how far the slopes of the G2 contour step, and how they wave.
  void note_slope_step(const Contour& spirals) {
    if (!is_made_g3(job_)) return;
    double& largest = out_.chain.slope_step_g2.emplace(out_.chain.slope_step_g2.value_or(0.0));
    largest = std::max(largest, largest_slope_step(spirals.pieces, series_.split.smooth_loop));
    waviness_g2_.add(spirals, series_.split.smooth_loop);
  }

  /// A piece of a drawing stays as it is. False where there is none.
  bool form_drawn(const Section& section) {
    const std::size_t first = series_.split.point_at(section.first);
    if (series_.kept.empty() || !series_.kept[first]) return false;
    const std::size_t last = series_.split.point_at(section.last) % series_.points.size();
    Contour drawn = form_kept(*series_.kept[first], series_.points, first, last);
    out_.add({drawn, {}}, assembly_);
    keep(std::move(drawn));
    return true;
  }

  /// Needs no spirals, and is compared with them where there are any.
  Result<void> form_points_alone(const Section& section) {
    auto carried = form_of_points(series_, section, job_.carrier, watch_);
    OBVID_TRY(carried);
    out_.add(std::move(*carried), assembly_);
    if (!job_.measure_against_spirals) return {};
    auto chain = chains_.chain(series_, section, watch_);
    keep(chain ? spirals_of(*chain) : Result<Contour>(fail(chain.error())));
    return {};
  }

  void keep(Result<Contour> spirals) {
    have_spirals_ = have_spirals_ && spirals.has_value();
    if (have_spirals_) spirals_.append(std::move(*spirals));
  }

  /// No joint between corners has one slope.
  static bool steps_everywhere(const Contour& contour) {
    bool any = false;
    for (std::size_t j = contour.closed ? 0 : 1; j < contour.pieces.size(); ++j) {
      const Joint& joint = contour.joints[j];
      if (!joint.leaving && !joint.slope_step) return false;
      any = any || joint.slope_step;
    }
    return any;
  }

  /// Pieces of drawings go on as they are drawn.
  static void claim_slopes(Contour& contour, bool continuous) {
    contour.continuity = continuous ? Continuity::kG3 : Continuity::kG2;
    if (!continuous) {  // what follows spirals has their joints
      for (Joint& joint : contour.joints) joint.slope_step = false;
      return;
    }
    const std::size_t n = contour.pieces.size();
    for (const std::size_t i : contour.kept) {
      for (const std::size_t j : {i, contour.closed ? (i + 1) % n : i + 1}) {
        const bool end = !contour.closed && (j == 0 || j == n);
        contour.joints[j].slope_step =
            !end && !contour.joints[j].leaving &&
            slope_step_before(contour.pieces, j % n) > kClearlyContinuous;
      }
    }
  }

  [[nodiscard]] Contour finished(Assembly& assembly, Carrier carrier) const {
    if (series_.closed) assembly.close(series_.split.smooth_loop);
    Contour contour = assembly.take();
    contour.points.assign(series_.points.begin(),
                          series_.points.begin() + static_cast<std::ptrdiff_t>(series_.measured()));
    for (Joint& joint : contour.joints) {
      if (!joint.source || !series_.is_between(*joint.source)) continue;
      joint.after = series_.named(*joint.source);
      joint.source.reset();
    }
    contour.point_tolerance = point_tolerance(series_, carrier, tolerance_);
    contour.given = series_.asked;
    contour.carrier = carrier;
    claim_slopes(contour, !follows_spirals(carrier) && makes_slopes_continuous(job_));
    return contour;
  }

  const Prepared series_;
  const FitJob& job_;
  double tolerance_;
  FoundChains& chains_;
  Watch& watch_;
  Formed out_;
  Assembly assembly_, spirals_;
  Waviness waviness_g2_{watch_};
  KeptParts kept_;
  std::vector<std::size_t> place_;     ///< of each point in the order of the series
  std::size_t given_up_ = 0;           ///< lines and arcs of all sections
  std::vector<MissingPiece> missing_;  ///< likewise
  std::string strays_;                 ///< that break them, of the first section that has such
  std::vector<std::size_t> bare_;      ///< sections without a line or arc that were asked for
  bool have_spirals_;                  // as long as they are asked for, and all sections have them
};

Result<Formed> form_sections(const Prepared& series, const FitJob& job, double tolerance,
                             FoundChains& chains, Watch& watch) {
  return SectionForming(series, job, tolerance, chains, watch).run();
}

/// Part of a point's tolerance that a carrier which follows the spirals takes for itself: what it
/// takes, the spirals lack, and less room means more vertices.
constexpr double kOwnPart = 0.1;

/// A carrier that follows the spirals needs a part of each point's tolerance for itself, a tenth of
/// the least at the most. Returns what it may use.
double share_tolerance(Prepared& series, double tolerance, double least) {
  double own = tolerance;
  for (const double reach : series.reach) {
    if (reach > 0.0) own = std::min(own, kOwnPart * reach);
  }
  own = std::max(own, least);
  for (double& reach : series.reach) reach = std::max(0.0, reach - own);
  return own;
}

bool misses_a_point(const Contour& contour, Watch& watch) {
  if (contour.point_tolerance.empty()) return false;
  const std::vector<double> distance = point_distances(contour, watch);
  for (std::size_t i = 0; i < distance.size(); ++i) {
    if (distance[i] > contour.point_tolerance[i]) return true;
  }
  return false;
}

/// Points that moved so far that they change places, or turn the contour round between them.
bool lost_by_moves(const Result<Formed>& formed, Watch& watch) {
  if (formed) return !points_out_of_order(formed->contour, watch).empty();
  return formed.error().code == ErrorCode::kChordReversal ||
         formed.error().code == ErrorCode::kWanders;
}

/// Halves the reach of points that the contour does not pass after those before them, and of these:
/// nearer to its points it has their order. False when there are none.
bool narrow_disorder(const Contour& contour, Watch& watch, Prepared& series) {
  bool any = false;
  const std::size_t n = series.measured();
  for (const std::size_t i : points_out_of_order(contour, watch)) {
    for (const std::size_t k : {i, i > 0 ? i - 1 : n - 1}) {
      any = any || series.reach[k] > 0.0;
      series.reach[k] *= 0.5;
    }
  }
  return any;
}

/// Narrows the reach of points that the contour passes too far or out of order. False when there
/// are none.
bool narrow(const Contour& contour, Watch& watch, Prepared& series) {
  if (series.exact()) return false;
  const std::vector<double> distance = point_distances(contour, watch);
  bool any = false;
  for (std::size_t i = 0; i < distance.size(); ++i) {
    const double allowed = contour.point_tolerance[i];
    if (!(distance[i] > allowed) || series.reach[i] == 0.0) continue;
    series.reach[i] *= kNarrowed * allowed / distance[i];
    any = true;
  }
  return any || narrow_disorder(contour, watch, series);
}

/// A convex contour turns one way all along; the search within tolerances may have missed that.
Result<void> keeps_convex(const Contour& contour, const Certificate& certificate) {
  if (certificate.inflections == 0) return {};
  Error error =
      obvid::error(ErrorCode::kFixedDataContradict,
                   "a convex contour was asked for, but none was found within the tolerances")
          .hint("do not ask for a convex contour, or allow larger tolerances");
  int turns = 0;
  for (const Joint& joint : contour.joints) {
    turns += joint.element.kappa > 0.0 ? 1 : joint.element.kappa < 0.0 ? -1 : 0;
  }
  for (const Joint& joint : contour.joints) {
    if (!joint.source || turns * joint.element.kappa >= 0.0) continue;
    error.index = static_cast<std::ptrdiff_t>(*joint.source);
    error.where = "point " + std::to_string(*joint.source + 1);
    break;
  }
  return fail(std::move(error));
}

/// The tolerance of the job, or the default; refused where coordinates could not tell it.
Result<double> tolerance_of(const FitJob& job, const std::vector<Vec2>& points, double least) {
  if (!job.tolerance) return std::max(least, default_tolerance(points));
  if (std::isfinite(*job.tolerance) && *job.tolerance >= least) return *job.tolerance;
  return error(
             ErrorCode::kBadOption,
             fmt::format("the tolerance must be finite and at least {:.2g} (1e-12 of the size, or "
                         "the rounding of coordinates)",
                         least))
      .hint("give a larger one, or none for the default")
      .value(*job.tolerance);
}

/// The contour, formed again with narrower reaches as long as it passes points too far.
Result<Formed> form_within(Prepared& series, const FitJob& job, double tolerance,
                           FoundChains& chains, Watch& watch) {
  const auto points = static_cast<double>(series.points.size());
  const double spare = watch.spent() + kSpareWork, most = spare + kMostFitSteps * points;
  int round = 0;
  const auto again = [&] {
    const ProgressShare share = ProgressShare::next_of_many(watch, round++);
    return form_sections(series, job, tolerance, chains, watch);
  };
  auto formed = again();
  while (formed && round <= kNarrowings && watch.spent() < most &&
         narrow(formed->contour, watch, series)) {
    formed = again();
  }
  if (formed && series.thin && misses_a_point(formed->contour, watch)) {
    series.thin = false;  // every point a joint: each is met by construction
    formed = again();
  }
  int halvings = 0;
  while (halvings < kReachHalvings && !series.exact() && !watch.was_cancelled() &&
         watch.spent() < (halvings == 0 ? most : spare + kMostHalvingSteps * points) &&
         lost_by_moves(formed, watch)) {
    ++halvings;
    for (double& reach : series.reach) reach *= 0.5;
    formed = again();
  }
  if (formed && halvings > 0) {
    formed->warnings.push_back(
        fmt::format("within {} of their tolerances points would change places, or the contour "
                    "swing out between them: {:g} of each tolerance was used",
                    series.part < 1.0 ? fmt::format("{}", series.part) : "the whole",
                    series.part / (1 << halvings)));
  }
  return formed;
}

/// Changes of direction and of sign along a contour whose pieces are monotone.
struct Turns {
  int vertices = 0, inflections = 0;

  [[nodiscard]] bool more_than(const Turns& other) const {
    return vertices > other.vertices || inflections > other.inflections;
  }
};

/// Between corners: at one, nothing goes on.
Turns turns_of(const Contour& contour) {
  Turns out;
  int direction = 0, sign = 0;
  const auto follow_run = [&](const Run& run) {
    if (contour.joints[run.first_piece].leaving) direction = 0;
    if (run.direction == 0) return;
    if (direction != 0 && run.direction != direction) ++out.vertices;
    direction = run.direction;
  };
  const auto follow_joint = [&](const Joint& joint) {
    const auto sign_of = [](double kappa) { return kappa > 0.0 ? 1 : kappa < 0.0 ? -1 : 0; };
    const int now = sign_of(joint.element.kappa);
    if (now != 0) {
      if (sign != 0 && now != sign) ++out.inflections;
      sign = now;
    }
    if (joint.leaving) sign = sign_of(joint.leaving->kappa);
  };
  for (const Run& run : contour.runs) follow_run(run);
  for (const Joint& joint : contour.joints) follow_joint(joint);
  if (!contour.closed || contour.runs.empty()) return out;
  follow_run(contour.runs.front());
  follow_joint(contour.joints.front());
  return out;
}

/// Points that a contour does not pass within their tolerances.
std::vector<bool> missed_points(const Contour& contour, Watch& watch) {
  const std::vector<double> distance = point_distances(contour, watch);
  std::vector<bool> out(distance.size());
  for (std::size_t i = 0; i < distance.size(); ++i) {
    out[i] = distance[i] > contour.point_tolerance[i];
  }
  for (const std::size_t i : points_out_of_order(contour, watch)) out[i] = true;
  return out;
}

/// What is said of the tolerances that both were formed within.
void take_warnings(const Formed& flat, Formed& smooth) {
  for (const std::string& one : flat.warnings) {
    const auto& said = smooth.warnings;
    if (std::find(said.begin(), said.end(), one) == said.end()) smooth.warnings.push_back(one);
  }
}

/// Continuous slopes within tolerances: those of the G2 contour's elements, so that no vertex and
/// no inflection is added. Runs that miss points whatever was tried keep their G2 spirals.
Result<Formed> smooth_within(Prepared& series, const FitJob& job, double tolerance, KeptParts kept,
                             FoundChains& chains, Watch& watch) {
  const auto form = [&] {
    return SectionForming(series, job, tolerance, chains, watch).keeping(kept).run();
  };
  if (series.exact()) return form();
  FitJob plain = job;
  plain.continuity = Continuity::kG2;
  auto flat = form_within(series, plain, tolerance, chains, watch);
  if (!flat) return flat;
  const Turns most = turns_of(flat->contour);
  auto smooth = form();
  for (int round = 0; smooth && round < kNarrowings && !watch.was_cancelled(); ++round) {
    const std::vector<bool> missed = missed_points(smooth->contour, watch);
    if (std::find(missed.begin(), missed.end(), true) == missed.end()) {
      if (turns_of(smooth->contour).more_than(most)) break;
      take_warnings(*flat, *smooth);
      return smooth;
    }
    kept.make(missed.size());
    for (std::size_t i = 0; i < missed.size(); ++i) kept.around[i] = kept.around[i] || missed[i];
    smooth = form();
  }
  flat->chain.g2_because =
      "within the tolerances no contour with continuous slopes of the curvature was found that has "
      "no more vertices and inflections";
  if (job.continuity) flat->warnings.push_back(flat->chain.g2_because + ": it is G2");
  return flat;
}

/// A contour with the figures that follow from it alone.
struct Measured {
  Formed formed;
  FitReport report;
};

/// What carriers are formed within, and what widths are to keep.
struct Tolerances {
  double formed, asked;
};

/// From now on these are given.
void hold_at_ends(const std::vector<GivenDatum>& ends, Prepared& series) {
  for (const GivenDatum& end : ends) {
    FixedData& fixed = series.fixed[end.point];
    const auto given = std::find_if(series.given.begin(), series.given.end(),
                                    [&](const GivenDatum& one) { return one.point == end.point; });
    if (end.theta) fixed.theta = given->theta = end.theta;
    if (end.kappa) fixed.kappa = given->kappa = end.kappa;
  }
}

Result<Measured> form_and_measure(Prepared& prepared, const FitJob& job, const Units& units,
                                  const Tolerances& within, const KeptParts& kept,
                                  FoundChains& chains, Watch& watch) {
  Result<Formed> formed = [&] {
    const ProgressShare share(watch, 0.0, kFormedAt);
    return is_made_g3(job) ? smooth_within(prepared, job, within.formed, kept, chains, watch)
                           : form_within(prepared, job, within.formed, chains, watch);
  }();
  // a carrier that chooses headings of its own is held at the end of a range that it passes
  std::vector<GivenDatum> passed;
  const std::size_t most_rounds = prepared.asked.empty() ? 0 : 2 * prepared.asked.size() + 1;
  for (std::size_t round = 0; formed && round < most_rounds; ++round) {
    take_piece_ends(formed->contour);
    const auto now = passed_ends(formed->contour);
    if (now.empty()) break;
    passed = now;
    hold_at_ends(passed, prepared);
    formed = form_within(prepared, job, within.formed, chains, watch);
  }
  if (!formed && !passed.empty()) {
    const std::size_t at = passed.front().point;
    return error(ErrorCode::kCarrierCannotKeep,
                 fmt::format("{} cannot keep the range given there", to_string(job.carrier)))
        .where(fmt::format("point {}", at + 1))
        .hint("widen the range there, or use carrier spiral or clothoids")
        .point(at);
  }
  if (!formed) {
    Error error = formed.error();
    const auto measured = static_cast<std::ptrdiff_t>(prepared.measured());
    if (auto hint = no_order_hint({prepared.points.begin(), prepared.points.begin() + measured})) {
      error.hint = std::move(*hint);
    } else if (!prepared.polygon.empty()) {
      error.hint += (error.hint.empty() ? "" : "; ") + prepared.polygon;
    }
    return fail(std::move(error));
  }
  if (watch.cancelled()) return fail(cancelled_error());
  take_piece_ends(formed->contour);
  OBVID_TRY(keeps_given(formed->contour));
  if (watch.cancelled()) return fail(cancelled_error());
  formed->contour.units = units;
  auto report = measure(formed->contour, within.asked, watch);
  OBVID_TRY(report);
  return Measured{std::move(*formed), std::move(*report)};
}

/// Whether the heading or curvature of a point is given.
std::vector<bool> has_given_data(const Prepared& prepared) {
  std::vector<bool> out;
  for (const FixedData& fixed : prepared.fixed) out.push_back(fixed.theta || fixed.kappa);
  return out;
}

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Curves that promise nothing may end so that doubles hold no curvature there.
Result<void> has_curvatures(const Contour& contour) {
  const auto lost = [](const Element& e) {
    return !std::isfinite(e.theta) || !std::isfinite(e.kappa);
  };
  for (const Joint& joint : contour.joints) {
    if (!lost(joint.element) && !(joint.leaving && lost(*joint.leaving))) continue;
    const auto point = static_cast<std::ptrdiff_t>(joint.source.value_or(0));
    return error(ErrorCode::kRoundingDecides,
                 fmt::format("{} has no curvature in doubles there", to_string(contour.carrier)))
        .where(fmt::format("point {}", point + 1))
        .hint("merge points that nearly coincide, or choose another --carrier")
        .point(point);
  }
  return {};
}

/// Part of each point's tolerance that the search may use; 0: the points as they are.
struct Reach {
  double part = 1.0;
};

/// Carriers through points alone know no lines and arcs.
bool looks_between(const FitJob& job) {
  return job.primitives && job.corners_between && job.find_corners &&
         info_of(job.carrier).needs != CarrierNeeds::kPoints;
}

/// Where errors like those of the points put some of them farther off any line or arc than their
/// tolerances, these break up, whatever the search does: no contour may leave a single point.
std::optional<std::string> warn_of_scatter(const Prepared& series, const Units& units) {
  const std::size_t n = series.measured();
  const auto seen =
      scatter_of({series.points.begin(), series.points.begin() + static_cast<std::ptrdiff_t>(n)});
  if (!seen || series.exact() || series.part < 1.0) return std::nullopt;
  double beyond = 0.0, most = 0.0;  // of normal errors, as many as are to be expected
  for (std::size_t i = 0; i < n; ++i) {
    beyond += std::erfc(series.tolerance[i] / (std::numbers::sqrt2 * seen->deviation));
    most = std::max(most, series.tolerance[i]);
  }
  if (!(beyond >= 1.0) || most >= seen->bound) return std::nullopt;
  return fmt::format(
      "the points scatter by {0} {1} across the curve: errors like that put about {2:.0f} of {3} "
      "points farther off their line or arc than the tolerance, which breaks it up; --noise auto "
      "lets them move {4} {1}",
      significant(seen->deviation, 3), units.text(), beyond, n, significant(seen->bound, 3));
}

/// A corner between two points is named by the one before it.
Error named_in(const Prepared& series, Error error) {
  const auto point = static_cast<std::size_t>(std::max<std::ptrdiff_t>(error.index, 0));
  const bool known = point < series.points.size();  // of what a chain has more, there is no name
  if (!known || !series.is_between(point)) return error;
  error.index = static_cast<std::ptrdiff_t>(series.named(point));
  error.where = fmt::format("after point {}", error.index + 1);
  return error;
}

/// What a contour is formed with beyond its job.
struct FormedWith {
  KeptParts kept{};
  Reach reach{};
  TakenBack taken_back{};
};

Result<Fit> formed_once(const PointSeries& series, const FitJob& job, const FormedWith& with,
                        FoundChains& chains, Watch& watch) {
  const auto& [kept, reach, taken_back] = with;
  watch.tell("analysing", 0.0);
  auto prepared = prepare(series, job);
  OBVID_TRY(prepared);
  prepared->taken_back = taken_back;
  if (watch.cancelled()) return fail(cancelled_error());
  if (reach.part == 0.0) {
    prepared->reach.assign(prepared->points.size(), 0.0);
    prepared->tolerance.clear();
  }
  const double least = least_tolerance(prepared->points);
  const auto asked = tolerance_of(job, prepared->points, least);
  OBVID_TRY(asked);
  if (looks_between(job) && reach.part > 0.0) {
    add_corners_between(*prepared, job.corner_angle.value_or(kDefaultCornerAngle));
  }
  const double tolerance =
      info_of(job.carrier).between_joints ? share_tolerance(*prepared, *asked, least) : *asked;
  for (double& one : prepared->reach) one *= reach.part;
  prepared->part = reach.part;
  auto measured =
      form_and_measure(*prepared, job, series.units, {tolerance, *asked}, kept, chains, watch);
  // what rounding makes of arcs shows in their regions only
  for (int k = 0; k < kArcTrials && measured && steps_at_joints(job.carrier) &&
                  measured->report.largest_width > *asked;
       ++k) {
    const double aim = kNarrowedArcs * tolerance * *asked / measured->report.largest_width;
    measured = form_and_measure(*prepared, job, series.units, {aim, *asked}, kept, chains, watch);
  }
  if (!measured) return fail(named_in(*prepared, measured.error()));
  Formed* formed = &measured->formed;
  OBVID_TRY(has_curvatures(formed->contour));
  Fit out;
  out.contour = std::move(formed->contour);
  watch.tell("proving", kFormedAt);
  out.certificate = certify(out.contour, watch);
  if (job.convex) {
    OBVID_TRY(keeps_convex(out.contour, out.certificate));
  }
  out.report = std::move(measured->report);
  settle_with(out.certificate, out.contour, out.report, watch);
  if (watch.cancelled()) return fail(cancelled_error());
  if (formed->spirals) {
    const auto formed_at = std::chrono::steady_clock::now();
    measure_against(*formed->spirals, out.contour, watch, out.report);
    out.report.comparing_seconds = seconds_since(formed_at);
  }
  if (watch.cancelled()) return fail(cancelled_error());
  out.report.chain = formed->chain;
  out.warnings = series.warnings;
  for (const auto* more : {&prepared->warnings, &prepared->taken_back.told, &formed->warnings}) {
    out.warnings.insert(out.warnings.end(), more->begin(), more->end());
  }
  if (formed->lacks_primitives) {
    if (auto warning = warn_of_scatter(*prepared, series.units)) {
      out.warnings.push_back(std::move(*warning));
    }
  }
  if (auto warning = warn_of_excursion(out.contour, has_given_data(*prepared), watch)) {
    out.warnings.push_back(std::move(*warning));
  }
  if (watch.was_cancelled()) return fail(cancelled_error());
  if (auto warning = warn_of_crossings(out.contour, out.certificate)) {
    out.warnings.push_back(std::move(*warning));
  }
  watch.tell("done", 1.0);
  return out;
}

/// Whether another choice of lines and arcs may end otherwise.
bool depends_on_primitives(const Result<Fit>& made, Carrier carrier) {
  if (made) return !keeps_promise(carrier, made->certificate);
  const ErrorCode code = made.error().code;
  return made.error().index >= 0 &&
         (code == ErrorCode::kRoundingDecides || code == ErrorCode::kNoRoomForTransition ||
          code == ErrorCode::kNotProved);
}

/// Of the curve, whatever lines and arcs were chosen: without any there may be one.
bool is_refusal(const Error& error) {
  return error.code == ErrorCode::kNoSpiral || error.code == ErrorCode::kChordReversal;
}

/// Forms a contour with lines and arcs, and takes back what it shows not to hold.
class WithPrimitives {
 public:
  WithPrimitives(const PointSeries& series, const FitJob& job, FormedWith with, FoundChains& chains,
                 Watch& watch)
      : series_(series), job_(job), with_(std::move(with)), chains_(chains), watch_(watch) {}

  Result<Fit> run() {
    const double before = watch_.spent();
    auto made = without_blunt_corners(formed());
    if (!made && is_refusal(made.error()) && !watch_.was_cancelled()) return without_any(made);
    // the plain contour is looked for first where one of G3 is not proved
    if (is_made_g3(job_) || !depends_on_primitives(made, job_.carrier)) return made;
    const Result<Fit> first = made;
    const double most = watch_.spent() + kSpareWork + kTakenBackWork * (watch_.spent() - before);
    for (int k = 0; k < kMostTakenBack && goes_on(most); ++k) {
      if (!take_back_beside(made)) break;
      made = without_blunt_corners(formed());
      if (!depends_on_primitives(made, job_.carrier)) return made;
    }
    if (watch_.was_cancelled()) return fail(cancelled_error());
    return without_any(first);
  }

 private:
  /// Lines and arcs, and rounds of corners, that are taken back before all are.
  static constexpr int kMostTakenBack = 8;
  /// Of the work of the first contour, what the others may take before one without any is formed.
  static constexpr double kTakenBackWork = 4.0;

  [[nodiscard]] bool goes_on(double most) const {
    return watch_.may_go_on() && watch_.spent() < most;
  }

  Result<Fit> formed() { return formed_once(series_, job_, with_, chains_, watch_); }

  Result<Fit> without_blunt_corners(Result<Fit> made) {
    const double angle = job_.corner_angle.value_or(kDefaultCornerAngle);
    for (int k = 0; k < kMostTakenBack && made && watch_.may_go_on(); ++k) {
      if (!take_back_corners(made->contour, angle, with_.taken_back)) break;
      made = formed();
    }
    return made;
  }

  /// False where nothing is left to take back.
  bool take_back_beside(const Result<Fit>& made) {
    std::size_t point = 0;
    if (made) {
      const auto joint = unproved_joint(made->certificate);
      if (!joint) return false;
      point = point_nearest_to(*joint, made->contour);
    } else {
      point = static_cast<std::size_t>(made.error().index);
    }
    if (made && !follows_spirals(job_.carrier)) {
      return take_back_nearest(lines_and_arcs(made->contour), point, made->contour.points.size(),
                               made->contour.closed, with_.taken_back);
    }
    FitJob spirals = job_;  // other carriers do not tell what is a line
    spirals.carrier = Carrier::kSpiral;
    spirals.continuity = Continuity::kG2;
    const auto followed = formed_once(series_, spirals, with_, chains_, watch_);
    return followed && take_back_nearest(lines_and_arcs(followed->contour), point,
                                         followed->contour.points.size(), followed->contour.closed,
                                         with_.taken_back);
  }

  Result<Fit> without_any(const Result<Fit>& first) {
    FitJob plain = job_;
    plain.primitives = false;
    FormedWith with{with_.kept, with_.reach, {}};
    auto made = formed_once(series_, plain, with, chains_, watch_);
    if (depends_on_primitives(made, job_.carrier) || !made) return first;
    made->warnings.emplace_back(
        first ? "no line and no arc is kept: beside those that were found no transition was proved"
              : "no line and no arc is kept: with those that were found there is no contour");
    return made;
  }

  const PointSeries& series_;
  const FitJob& job_;
  FormedWith with_;
  FoundChains& chains_;
  Watch& watch_;
};

Result<Fit> formed_and_proved(const PointSeries& series, const FitJob& job, FoundChains& chains,
                              Watch& watch, const KeptParts& kept = {}, Reach reach = {}) {
  FormedWith with{kept, reach, {}};
  // exact points lie on none, and drawings keep theirs
  if (!job.primitives || reach.part == 0.0 || !series.kept.empty()) {
    return formed_once(series, job, with, chains, watch);
  }
  return WithPrimitives(series, job, std::move(with), chains, watch).run();
}

/// Parts between two points with a piece that is not proved to be monotone, or not to turn far.
/// False where no more are found.
bool keep_unproved(const Fit& fit, KeptParts& kept) {
  kept.make(fit.contour.points.size());
  bool any = false;
  std::optional<std::size_t> begun;
  for (std::size_t i = 0; i < fit.certificate.pieces.size(); ++i) {
    begun = fit.contour.joints[i].source ? fit.contour.joints[i].source : begun;
    const Verdict verdict = fit.certificate.pieces[i].verdict;
    const bool monotone = verdict != Verdict::kHasVertex && verdict != Verdict::kUndecided;
    const bool sound = monotone && fit.certificate.pieces[i].turns_below_half;
    if (sound || !begun || kept.leaving[*begun]) continue;
    kept.leaving[*begun] = any = true;
  }
  return any;
}

/// The contour with its loose slopes, which rounding may leave, said to step; if it is proved so.
std::optional<Fit> with_told_steps(const Fit& smooth, bool warns, Watch& watch) {
  if (smooth.certificate.loose_slopes.empty()) return std::nullopt;
  Fit out = smooth;
  double largest = 0.0;
  for (const std::size_t i : smooth.certificate.loose_slopes) {
    out.contour.joints[i].slope_step = true;
    const std::vector<Piece>& pieces = out.contour.pieces;
    largest = std::max(largest, slope_step_before(pieces, i % pieces.size()));
  }
  out.certificate = certify(out.contour, watch);
  if (!out.certificate.proved) return std::nullopt;
  auto report = measure(out.contour, smooth.report.tolerance, watch);
  if (!report) return std::nullopt;
  settle_with(out.certificate, out.contour, *report, watch);
  report->chain = smooth.report.chain;
  report->seconds = smooth.report.seconds;
  out.report = std::move(*report);
  if (warns) {
    out.warnings.push_back(fmt::format(
        "the slope of curvature steps at {}, by {} of the largest beside it: G2 there",
        counted(static_cast<std::size_t>(out.certificate.slope_steps), "joint", "joints"),
        significant(largest, 2)));
  }
  return out;
}

/// Runs whose smooth spirals are not proved keep their G2 ones; if that does not help, the whole
/// contour does, if that is proved.
Result<Fit> proved_without_slopes(const PointSeries& series, FitJob job, Fit smooth,
                                  FoundChains& chains, Watch& watch) {
  const bool asked = job.continuity.has_value();
  KeptParts kept;
  std::optional<Fit> now = smooth;
  for (int round = 0; now; ++round) {
    if (auto told = with_told_steps(*now, asked, watch)) return std::move(*told);
    if (round == kKeptRounds || !keep_unproved(*now, kept)) break;
    auto made = formed_and_proved(series, job, chains, watch, kept);
    if (made && made->certificate.proved) return made;
    now.reset();
    if (made) now = std::move(*made);
  }
  job.continuity = Continuity::kG2;
  auto made = formed_and_proved(series, job, chains, watch);
  if (!made) return smooth;
  if (asked) {
    made->warnings.push_back("the G3 contour was not proved, so this one is G2: " +
                             smooth.certificate.reason);
  }
  if (!made->certificate.proved) return made;  // the simpler of two that are not
  made->report.chain.g2_because = "the G3 contour was not proved: " + smooth.certificate.reason;
  return made;
}

bool has_tolerances(const PointSeries& series, const FitJob& job) {
  const auto prepared = prepare(series, job);
  return prepared && !prepared->exact();
}

/// Where none within the whole of the tolerances is proved: contours that pass the points nearer
/// than they must, or as they are. They are within the tolerances too, and only taken where they
/// have no more vertices and inflections than spirals within them.
class NearerContours {
 public:
  NearerContours(const PointSeries& series, const FitJob& job, FoundChains& chains, Watch& watch)
      : series_(series), job_(job), plain_(job), chains_(chains), watch_(watch) {
    plain_.continuity = Continuity::kG2;
    FitJob followed = plain_;
    followed.carrier = Carrier::kSpiral;
    auto spirals = formed_and_proved(series, followed, chains, watch);
    if (spirals) spirals_ = turns_of(spirals->contour);
  }

  /// By parts of the tolerances. Nothing when there is none, or the work is used up.
  std::optional<Fit> by_parts() {
    const Allowance allowance(
        watch_, kSpareNearer + kMostNearerSteps * static_cast<double>(series_.points.size()));
    for (const double part : kPartsOfReach) {
      if (!watch_.may_go_on()) break;
      FoundChains chains;  // of narrower ranges
      auto made = within(job_, Reach{part}, chains);
      if (!made && is_made_g3(job_) && !job_.continuity) {
        made = within(plain_, Reach{part}, chains);
        if (made) made->report.chain.g2_because = kNoSlopesNearer;
      }
      if (!made) continue;
      made->warnings.push_back(
          fmt::format("no contour was found that makes use of the whole of the tolerances: it was "
                      "looked for within {} of each",
                      part));
      return made;
    }
    return std::nullopt;
  }

  std::optional<Fit> through_points() {
    const Allowance allowance(
        watch_, kSpareExact + kMostExactSteps * static_cast<double>(series_.points.size()));
    auto exact = within(job_, Reach{0.0}, chains_);
    if (!exact && is_made_g3(job_)) {
      exact = within(plain_, Reach{0.0}, chains_);
      if (exact) {
        exact->report.chain.g2_because =
            "through the points as they are none with continuous slopes of the curvature was "
            "proved";
        if (job_.continuity) {
          exact->warnings.push_back(exact->report.chain.g2_because + ": it is G2");
        }
      }
    }
    if (!exact) return std::nullopt;
    exact->warnings.emplace_back(
        "the points are met as they are: no contour of this carrier that moves them within their "
        "tolerances was found and proved");
    return exact;
  }

 private:
  static constexpr const char* kNoSlopesNearer =
      "within that part of the tolerances none with continuous slopes of the curvature was proved";

  std::optional<Fit> within(const FitJob& job, Reach reach, FoundChains& chains) {
    auto made = formed_and_proved(series_, job, chains, watch_, {}, reach);
    if (!made || !made->certificate.proved) return std::nullopt;
    if (spirals_ && turns_of(made->contour).more_than(*spirals_)) return std::nullopt;
    return std::move(*made);
  }

  const PointSeries& series_;
  const FitJob& job_;
  FitJob plain_;  ///< the same with G2 joints
  FoundChains& chains_;
  Watch& watch_;
  std::optional<Turns> spirals_;
};

/// Whether a search among fewer places may end otherwise.
bool depends_on_search(const Error& error) {
  return error.code == ErrorCode::kNoSpiral || error.code == ErrorCode::kNoRoomForTransition;
}

std::optional<Fit> nearer_to_points(const PointSeries& series, const FitJob& job,
                                    const Result<Fit>& made, FoundChains& chains, Watch& watch) {
  if (!has_tolerances(series, job)) return std::nullopt;
  NearerContours nearer(series, job, chains, watch);
  if (!made && depends_on_search(made.error())) {
    if (auto near = nearer.by_parts()) return near;
  }
  return nearer.through_points();
}

}  // namespace

Continuity wanted_continuity(const FitJob& job) {
  // what is preferred holds of the headings of the G2 contour
  const bool smooth = can_be_g3(job.carrier) && job.prefer == Prefer::kFair;
  return smooth ? job.continuity.value_or(Continuity::kG3) : Continuity::kG2;
}

namespace {

/// Why there may be a G2 contour where none of G3 was found, which nobody asked for: equal slopes
/// cost the last digits of what is given, and may bend a convex contour back. Else empty.
std::string lost_with_slopes(const FitJob& job, const Result<Fit>& made) {
  if (made || !is_made_g3(job) || job.continuity) return {};
  const Error& error = made.error();
  if (error.code == ErrorCode::kCarrierCannotKeep) return "with continuous slopes " + error.what;
  if (job.convex && error.code == ErrorCode::kFixedDataContradict) {
    return "no convex contour with continuous slopes of the curvature was found";
  }
  return {};
}

Result<Fit> fit_as_asked(const PointSeries& series, const FitJob& job, FoundChains& chains,
                         Watch& watch) {
  if (watch.cancelled()) return fail(cancelled_error());
  if (is_as_drawn(job.carrier)) {
    return error(ErrorCode::kBadOption,
                 fmt::format("carrier {} is what drawings have", to_string(job.carrier)))
        .where("--carrier")
        .hint("name a carrier that is formed");
  }
  if (job.continuity == Continuity::kG3 && !can_be_g3(job.carrier)) {
    return error(ErrorCode::kBadOption,
                 fmt::format("carrier {} has no continuous slope of curvature",
                             to_string(job.carrier)))
        .where("--continuity")
        .hint("G3 is for --carrier spiral");
  }
  if (job.continuity == Continuity::kG3 && job.prefer != Prefer::kFair) {
    return error(ErrorCode::kBadOption, "continuous slopes move the headings that are preferred")
        .where("--continuity")
        .hint("leave out --continuity G3, or --prefer");
  }
  const auto begin = std::chrono::steady_clock::now();
  auto made = formed_and_proved(series, job, chains, watch);
  if (const std::string because = lost_with_slopes(job, made); !because.empty()) {
    FitJob plain = job;
    plain.continuity = Continuity::kG2;
    made = formed_and_proved(series, plain, chains, watch);
    if (made) made->report.chain.g2_because = because;
  } else if (made && is_made_g3(job) && !made->certificate.proved) {
    made = proved_without_slopes(series, job, std::move(*made), chains, watch);
  }
  if ((!made || !made->certificate.proved) && promises_monotone(job.carrier) &&
      !watch.was_cancelled()) {
    if (auto near = nearer_to_points(series, job, made, chains, watch)) {
      made = std::move(*near);
    }
  }
  if (watch.was_cancelled()) return fail(cancelled_error());  // whatever it made do with
  if (made) made->report.seconds = seconds_since(begin);
  return made;
}

}  // namespace

namespace {

Result<Fit> fit_with_room(const PointSeries& series, const FitJob& job, FoundChains& chains,
                          Watch& watch) {
  const auto begin = std::chrono::steady_clock::now();
  auto made = fit_as_asked(series, job, chains, watch);
  if (made || !info_of(job.carrier).wants_room) return made;
  if (wants_room(job, made.error())) {
    made = with_room(job, "this one is", std::move(made), [&](const FitJob& wider) {
      FoundChains others;
      return fit_as_asked(series, wider, others, watch);
    });
    if (made) made->report.seconds = seconds_since(begin);
  }
  if (!made && made.error().code == ErrorCode::kToleranceNotReached) {
    // no tolerance of the region helps where the carrier has no such curve: moved points do
    Error error = made.error();
    error.code = ErrorCode::kNoSpiral;
    error.value = 0.0;
    return fail(std::move(error));
  }
  return made;
}

}  // namespace

Result<Fit> pipeline_detail::fit_with(const PointSeries& series, const FitJob& job,
                                      FoundChains& chains, Watch& watch) {
  auto made = fit_with_room(series, job, chains, watch);
  if (!made) return made;
  made->report.waviness = waviness(made->contour, watch);
  if (watch.was_cancelled()) return fail(cancelled_error());
  return made;
}

Result<Fit> fit(const PointSeries& series, const FitJob& job, Watch& watch) {
  FoundChains chains;
  return pipeline_detail::fit_with(series, job, chains, watch);
}

Result<Fit> fit(const PointSeries& series, const FitJob& job, const RunContext& run) {
  Watch watch(run);
  return fit(series, job, watch);
}

}  // namespace obvid
