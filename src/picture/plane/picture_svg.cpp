// SPDX-License-Identifier: Apache-2.0
#include "obvid/picture/picture_svg.h"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "obvid/core/internal/figures.h"
#include "obvid/picture/internal/joints_claim.h"
#include "plane/axis.h"
#include "plane/moves.h"
#include "plane/panels.h"
#include "plane/plots.h"
#include "plane/sheet.h"

namespace obvid {
namespace {

/// Verdicts longer than this are cut: the file tells the whole reason.
constexpr std::size_t kLongestReason = 105;
/// Titles longer than this would meet the facts beside them.
constexpr std::size_t kLongestName = 50;

static_assert(std::all_of(kCarriers.begin(), kCarriers.end(),
                          [](const CarrierInfo& info) { return *info.title != '\0'; }));

constexpr const CarrierInfo& kAsDrawn =
    *std::find_if(kCarriers.begin(), kCarriers.end(),
                  [](const CarrierInfo& info) { return is_as_drawn(info.carrier); });

/// What the curve is; `foreign`: another system drew it.
std::string kind_of(const Contour& contour, bool foreign) {
  std::string kind = (foreign ? kAsDrawn : info_of(contour.carrier)).title;
  if (contour.closed)
    kind = "Closed " + std::string(1, static_cast<char>(kind[0] - 'A' + 'a')) + kind.substr(1);
  if (!foreign) kind += " · " + counted(contour.points.size(), "point", "points");
  return kind + " · " + counted(contour.pieces.size(), "piece", "pieces");
}

/// A name that fits beside the facts, in whole characters.
std::string short_name(const std::string& name) {
  if (name.size() <= kLongestName) return name;
  std::size_t cut = kLongestName;
  while (cut > 0 && (static_cast<unsigned char>(name[cut]) & 0xC0U) == 0x80U) --cut;
  return name.substr(0, cut) + " …";
}

struct VerdictLine {
  const char* css = "open";
  std::string text;
};

VerdictLine verdict_of(const StoredContour& stored) {
  if (!stored.certificate) return {"open", "no certificate: nothing is claimed about this contour"};
  if (is_as_drawn(stored.contour.carrier)) return {"open", "as it is drawn: nothing is promised"};
  if (stored.certificate->proved) {
    const Carrier carrier = stored.contour.carrier;
    std::string text =
        steps_at_joints(carrier) ? "✓ proved: monotone radii, " : "✓ proved: monotone curvature, ";
    text += joints_claim(carrier, *stored.certificate);
    // beside the steps of slopes there is no room for it; the line below tells how far points are
    const bool room = !stored.certificate->gaps.slope;
    if (room && !stored.contour.point_tolerance.empty()) {
      text += ", every point within its tolerance";
    }
    return {"good", text};
  }
  std::string reason = stored.certificate->reason;
  if (reason.size() > kLongestReason) {
    std::size_t cut = kLongestReason;
    while (cut > 0 && (static_cast<unsigned char>(reason[cut]) & 0xC0U) == 0x80U) --cut;
    reason = reason.substr(0, cut) + " …";
  }
  const bool kept = keeps_promise(stored.contour.carrier, *stored.certificate);
  return {"bad", std::string(kept ? "✗ not monotone" : "✗ NOT proved") +
                     (reason.empty() ? std::string{} : ": " + reason)};
}

std::size_t corner_count(const Contour& contour) {
  return static_cast<std::size_t>(
      std::count_if(contour.joints.begin(), contour.joints.end(), is_corner));
}

bool is_measured(const StoredContour& stored) {
  return !stored.contour.point_tolerance.empty() || corner_count(stored.contour) > 0 ||
         !stored.contour.kept.empty() ||
         (stored.certificate && stored.certificate->largest_move > 0.0);
}

bool has_region(const StoredContour& stored) {
  return stored.report && promises_monotone(stored.contour.carrier);
}

std::string region_fact(const StoredContour& stored) {
  return "region width " + readable_number(stored.report->largest_width, 2) + " " +
         stored.contour.units.text();
}

std::string facts_of(const StoredContour& stored) {
  if (!stored.report) return {};
  const FitReport& report = *stored.report;
  std::string text =
      counted(static_cast<std::size_t>(std::max(report.vertices, 0)), "vertex", "vertices");
  text += " (" + short_bound_text(report.vertices_lower_bound) + ")";
  text += " · " + counted(static_cast<std::size_t>(std::max(report.inflections, 0)), "inflection",
                          "inflections");
  if (!is_measured(stored) && has_region(stored)) text += " · " + region_fact(stored);
  return text;
}

/// A second line where points are not met exactly or the contour has corners.
std::string measured_facts(const StoredContour& stored) {
  if (!is_measured(stored)) return {};
  std::vector<std::string> facts;
  if (stored.certificate && stored.certificate->largest_move > 0.0) {
    facts.push_back("points at most " + readable_bound(stored.certificate->largest_move, 2) + " " +
                    stored.contour.units.text() + " from the contour");
  }
  if (const std::size_t corners = corner_count(stored.contour)) {
    facts.push_back(counted(corners, "corner", "corners"));
  }
  if (has_region(stored)) facts.push_back(region_fact(stored));
  std::string text;
  for (const std::string& fact : facts) text += (text.empty() ? "" : " · ") + fact;
  return text;
}

}  // namespace

std::string picture_svg(const StoredContour& stored, const PictureTitles& titles,
                        const PicturePlots& plots, Watch* watch) {
  const Contour& contour = stored.contour;
  PictureTrack track = make_track(contour, watch);
  if (has_ended(watch)) return {};
  if (stored.certificate) take_counts(track, *stored.certificate);
  const bool coloured = track.runs_tell && contour.runs.size() <= kMostColouredRuns;
  const VerdictLine verdict =
      titles.verdict.empty() ? verdict_of(stored) : VerdictLine{"open", titles.verdict};
  const std::string kind =
      kind_of(contour, !titles.verdict.empty() || is_as_drawn(contour.carrier));
  const std::string title = titles.name.empty() ? kind : short_name(titles.name);
  PictureCanvas body;
  body.label({kPictureMargin, 40.0}, "start", "title", title);
  body.label({kPictureWidth - kPictureMargin, 40.0}, "end", "fact", facts_of(stored));
  body.verdict({kPictureMargin, 64.0}, verdict.css, verdict.text,
               kPictureWidth - 2.0 * kPictureMargin);
  std::string more = measured_facts(stored);
  if (!titles.name.empty()) more = kind + (more.empty() ? "" : " · " + more);
  if (!more.empty()) body.label({kPictureMargin, 85.0}, "start", "fact", more);
  const double top = more.empty() ? 78.0 : 99.0;
  const PictureMoves moves = make_moves(track, stored, plots.allowed);
  const bool deviations = plots.deviations && !moves.points.empty();
  const std::array<const PictureTrack*, 1> alone{&track};
  const PictureScale scale = curvature_scale(alone, plots.curvatures);
  const double below =
      shape_panel(body, track, stored, scale, deviations ? &moves : nullptr, coloured, top);
  const double height = plot_panels(body, track, scale, {moves, plots.slope, deviations},
                                    contour.units.text(), coloured, below);
  return picture_sheet(title, verdict.text, body.take(), height);
}

}  // namespace obvid
