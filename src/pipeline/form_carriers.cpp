// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "fit/parts.h"
#include "form.h"
#include "obvid/certify/certify.h"
#include "obvid/contour/beziers.h"
#include "obvid/contour/bsplines.h"
#include "obvid/contour/bsplines/cubic_along.h"
#include "obvid/contour/bsplines/monotone.h"
#include "obvid/contour/conics.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/region/internal/refine.h"
#include "verify/report.h"

namespace obvid::pipeline_detail {
namespace {

Contour like(const Contour& spirals, Carrier carrier) {
  Contour out;
  out.units = spirals.units;
  out.carrier = carrier;
  out.points = spirals.points;
  return out;
}

/// Element of a piece, its heading unwrapped to be near another one.
Element element_near(const Piece& piece, double t, double theta) {
  Element e = element_at(piece, t);
  e.theta = nearest_angle(e.theta, theta);
  return e;
}

/// An error about joint `index` of a section, told in points of the series.
tl::unexpected<Error> at_point(Error error, const Contour& spirals, std::ptrdiff_t index,
                               const char* hint) {
  std::size_t joint = index < 0 ? 0 : static_cast<std::size_t>(index);
  while (joint > 0 && (joint >= spirals.joints.size() || !spirals.joints[joint].source)) --joint;
  error.hint = hint;
  error.index = -1;
  if (index >= 0 && joint < spirals.joints.size() && spirals.joints[joint].source) {
    error.index = static_cast<std::ptrdiff_t>(*spirals.joints[joint].source);
    error.where = "after point " + std::to_string(error.index + 1);
  }
  return fail(std::move(error));
}

/// What was given at the point on which a joint stands, if anything.
const GivenDatum* given_at(const Joint& joint, const std::vector<GivenDatum>& given) {
  if (!joint.source) return nullptr;
  const auto found =
      std::lower_bound(given.begin(), given.end(), *joint.source,
                       [](const GivenDatum& one, std::size_t point) { return one.point < point; });
  return found != given.end() && found->point == *joint.source ? &*found : nullptr;
}

/// Conics to a link: headings alone leave too little freedom where neighbouring links differ much.
constexpr int kMostParts = 8;

std::vector<Element> elements_of(const std::vector<Joint>& joints) {
  std::vector<Element> out;
  for (const Joint& joint : joints) out.push_back(joint.element);
  return out;
}

/// The joints of the spirals and, on every piece, those that cut it in `parts`.
std::vector<Joint> joints_on(const Contour& spirals, int parts) {
  std::vector<Joint> out;
  for (std::size_t i = 0; i < spirals.pieces.size(); ++i) {
    out.push_back(spirals.joints[i]);
    for (int k = 1; k < parts; ++k) {
      const double t = static_cast<double>(k) / parts;
      out.push_back(
          {element_near(spirals.pieces[i], t, out.back().element.theta), std::nullopt, {}});
    }
  }
  out.push_back(spirals.joints.back());
  return out;
}

constexpr const char* kOtherCarriers = "use --carrier spiral, arcs or clothoids";

/// Runs of pieces as they are proved, one by one: the builder of these curves does not know them.
std::vector<Run> proved_runs(const std::vector<Piece>& pieces) {
  std::vector<int> direction;
  for (const Piece& piece : pieces) {
    direction.push_back(direction_of(prove_piece(piece).verdict));
  }
  return collect_runs(direction);
}

/// The joint after which the curvature changes its sign first.
std::optional<std::size_t> inflection(const Contour& spirals) {
  double sign = 0.0;
  std::size_t last = 0;
  for (std::size_t j = 0; j < spirals.joints.size(); ++j) {
    const double kappa = spirals.joints[j].element.kappa;
    if (kappa == 0.0) continue;
    if (sign * kappa < 0.0) return last;
    sign = kappa;
    last = j;
  }
  return std::nullopt;
}

/// Lines and arcs only: every carrier of lines has the lines, ellipse arcs are circle arcs too. A
/// conic or polynomial of the same shape would have vertices by its rounding.
template <class... Kinds>
bool only(const Contour& spirals) {
  return std::all_of(spirals.pieces.begin(), spirals.pieces.end(), [](const Piece& piece) {
    return (std::holds_alternative<Kinds>(piece) || ...);
  });
}

Carried as_they_are(const Contour& spirals, Carrier carrier) {
  Carried out{spirals, {}};
  out.contour.carrier = carrier;
  return out;
}

/// Points on one line, as far as their coordinates tell, each ahead of the one before.
bool straight(const std::vector<Vec2>& points) {
  constexpr double kRounding = 0x1p-50;  // of the largest coordinate: its last digits
  double largest = 0.0;
  for (const Vec2 p : points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  const Vec2 chord = points.back() - points.front();
  const Vec2 along = chord / norm(chord);
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!(dot(along, points[i] - points[i - 1]) > 0.0)) return false;
    if (std::abs(cross(along, points[i] - points.front())) > kRounding * largest) return false;
  }
  return true;
}

/// The spline through points of one line: that line.
Carried baseline_of_lines(const std::vector<Vec2>& points, const std::vector<std::size_t>& source) {
  Carried out;
  out.contour.carrier = Carrier::kBaseline;
  const double theta = heading(points.back() - points.front());
  for (std::size_t i = 0; i < points.size(); ++i) {
    out.contour.joints.push_back({{points[i], theta, 0.0}, source[i], {}});
    if (i > 0) out.contour.pieces.emplace_back(LinePiece{points[i - 1], points[i]});
  }
  out.contour.runs = collect_runs(std::vector<int>(out.contour.pieces.size(), 0));
  return out;
}

/// A section that goes on where it began, in the same direction.
bool smooth_loop(const Contour& spirals) {
  const Element &first = spirals.joints.front().element, &last = spirals.joints.back().element;
  constexpr double kSameHeading = 1e-9;  // rad: the bound of gaps in certificates
  return first.point == last.point &&
         std::abs(std::remainder(last.theta - first.theta, 2.0 * std::numbers::pi)) < kSameHeading;
}

/// Pieces of one smooth curve; the joints between them are no points of the series.
void add_free_pieces(const std::vector<RationalBezier>& pieces, Contour& contour) {
  double theta = contour.joints.empty() ? 0.0 : contour.joints.back().element.theta;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    contour.pieces.emplace_back(pieces[i]);
    if (i + 1 == pieces.size()) break;
    const Element e = element_near(contour.pieces.back(), 1.0, theta);
    theta = e.theta;
    contour.joints.push_back({e, std::nullopt, {}});
  }
}

/// Pieces [first, end) of a contour as a contour of their own.
Contour stretch_of(const Contour& spirals, const std::vector<int>& directions, std::size_t first,
                   std::size_t end) {
  Contour out = like(spirals, Carrier::kSpiral);
  const auto at = [](std::size_t k) { return static_cast<std::ptrdiff_t>(k); };
  out.pieces.assign(spirals.pieces.begin() + at(first), spirals.pieces.begin() + at(end));
  out.joints.assign(spirals.joints.begin() + at(first), spirals.joints.begin() + at(end) + 1);
  out.runs = collect_runs({directions.begin() + at(first), directions.begin() + at(end)});
  return out;
}

/// The monotone B-spline along a stretch, all but its last joint.
Result<void> add_spline(const Contour& stretch, double tolerance, Carried& out,
                        std::vector<int>& direction) {
  if (only<LinePiece>(stretch)) {
    for (std::size_t i = 0; i < stretch.pieces.size(); ++i) {
      out.contour.joints.push_back(stretch.joints[i]);
      out.contour.pieces.push_back(stretch.pieces[i]);
      direction.push_back(0);
    }
    return {};
  }
  const auto spline = monotone_spline(stretch, tolerance);
  if (!spline) return fail(spline.error());
  std::size_t next = 0;  // joint of the spirals that may be the next knot
  for (std::size_t k = 0; k < spline->spans.size(); ++k) {
    const Element& e = spline->elements[k];
    Joint joint{e, std::nullopt, {}};
    for (std::size_t j = next; j < stretch.joints.size(); ++j) {
      if (!(stretch.joints[j].element.point == e.point)) continue;
      joint.source = stretch.joints[j].source;
      next = j + 1;
      break;
    }
    out.contour.joints.push_back(joint);
    if (spline->direction[k] == 0) {  // straight: rounding would bend a quintic
      out.contour.pieces.emplace_back(LinePiece{e.point, spline->elements[k + 1].point});
    } else {
      out.contour.pieces.emplace_back(spline->spans[k]);
    }
    direction.push_back(spline->direction[k]);
  }
  return {};
}

}  // namespace

namespace {

/// Which elements keep their headings, and one curvature that the first weight can meet.
struct GivenToConics {
  std::vector<bool> headings;
  std::optional<std::size_t> curvature;  ///< its element
};

GivenToConics given_to_conics(const std::vector<Joint>& joints,
                              const std::vector<GivenDatum>& given) {
  GivenToConics out;
  for (std::size_t k = 0; k < joints.size(); ++k) {
    const GivenDatum* one = given_at(joints[k], given);
    out.headings.push_back(one != nullptr && one->theta.has_value());
    if (one != nullptr && one->kappa && !out.curvature) out.curvature = k;
  }
  return out;
}

}  // namespace

Result<Carried> form_conics(const Contour& spirals, const std::vector<GivenDatum>& given) {
  if (only<LinePiece, ArcPiece>(spirals)) return as_they_are(spirals, Carrier::kConics);
  if (smooth_loop(spirals)) {
    return fail({ErrorCode::kNoSpiral,
                 "no chain of conics is made for a closed contour without corners", "",
                 kOtherCarriers, -1, 0.0});
  }
  Carried out{like(spirals, Carrier::kConics), {}};
  std::vector<Joint> joints = spirals.joints;
  GivenToConics kept = given_to_conics(joints, given);
  auto freed = headings_for_conics(elements_of(joints), {kept.headings, kept.curvature});
  int parts = 1;
  while (!freed && freed.error().code == ErrorCode::kNotProved && parts < kMostParts) {
    parts *= 2;
    joints = joints_on(spirals, parts);
    kept = given_to_conics(joints, given);
    freed = headings_for_conics(elements_of(joints), {kept.headings, kept.curvature});
  }
  if (!freed && freed.error().code != ErrorCode::kNotProved) {
    return at_point(freed.error(), spirals, freed.error().index / parts, kOtherCarriers);
  }
  if (!freed) {
    out.warnings.emplace_back(
        "no headings were found for which all conics have monotone curvature; the headings are "
        "those of the spirals");
    parts = 1;
    joints = spirals.joints;
    kept = given_to_conics(joints, given);
    freed = elements_of(joints);
  }
  auto chain = conic_chain(*freed, {std::nullopt, kept.curvature});
  if (!chain) return at_point(chain.error(), spirals, chain.error().index / parts, kOtherCarriers);
  for (std::size_t k = 0; k < chain->elements.size(); ++k) {
    out.contour.joints.push_back({chain->elements[k], joints[k].source, {}});
  }
  for (const RationalBezier& piece : chain->pieces) out.contour.pieces.emplace_back(piece);
  std::vector<int> direction;
  for (const int one : piece_directions(spirals)) {
    direction.insert(direction.end(), static_cast<std::size_t>(parts), one);
  }
  out.contour.runs = collect_runs(direction);
  return out;
}

Result<Carried> form_beziers(const Contour& spirals, double tolerance, Watch& watch) {
  if (const auto joint = inflection(spirals)) {
    return at_point(
        {ErrorCode::kNoSpiral, "the contour has an inflection, which no chain of parabolas has", "",
         "", -1, 0.0},
        spirals, static_cast<std::ptrdiff_t>(*joint), kOtherCarriers);
  }
  Carried out{like(spirals, Carrier::kBeziers), {}};
  const std::vector<int> direction = piece_directions(spirals);
  std::vector<int> directions;
  for (std::size_t i = 0; i < spirals.pieces.size(); ++i) {
    if (watch.cancelled()) return fail(cancelled_error());
    out.contour.joints.push_back(spirals.joints[i]);
    if (std::holds_alternative<LinePiece>(spirals.pieces[i])) {
      out.contour.pieces.push_back(spirals.pieces[i]);
      directions.push_back(0);
      continue;
    }
    if (direction[i] == 0) {
      return at_point(
          {ErrorCode::kNoSpiral, "no chain of parabolas has constant curvature", "", "", -1, 0.0},
          spirals, static_cast<std::ptrdiff_t>(i), kOtherCarriers);
    }
    const auto chain = condense_piece(spirals.pieces[i], direction[i], tolerance);
    if (!chain) {
      return at_point(chain.error(), spirals, static_cast<std::ptrdiff_t>(i), kOtherCarriers);
    }
    add_free_pieces(chain->parabolas, out.contour);
    directions.insert(directions.end(), chain->parabolas.size(), direction[i]);
  }
  out.contour.joints.push_back(spirals.joints.back());
  out.contour.runs = collect_runs(directions);
  return out;
}

Result<Carried> form_bspline(const Contour& spirals, double tolerance,
                             const std::vector<GivenDatum>& given) {
  Carried out{like(spirals, Carrier::kBspline), {}};
  const std::vector<int> directions = piece_directions(spirals);
  std::vector<int> direction;
  const std::size_t n = spirals.pieces.size();
  for (std::size_t i = 0; i < n;) {
    if (std::holds_alternative<ArcPiece>(spirals.pieces[i])) {  // no polynomial is a circle
      out.contour.joints.push_back(spirals.joints[i]);
      out.contour.pieces.push_back(spirals.pieces[i]);
      direction.push_back(0);
      ++i;
      continue;
    }
    std::size_t end = i + 1;
    // what was given at a point is met where the point is a knot
    while (end < n && !std::holds_alternative<ArcPiece>(spirals.pieces[end]) &&
           given_at(spirals.joints[end], given) == nullptr) {
      ++end;
    }
    if (auto done = add_spline(stretch_of(spirals, directions, i, end), tolerance, out, direction);
        !done) {
      return at_point(done.error(), spirals, static_cast<std::ptrdiff_t>(i) + done.error().index,
                      kOtherCarriers);
    }
    i = end;
  }
  out.contour.joints.push_back(spirals.joints.back());
  out.contour.runs = collect_runs(direction);
  return out;
}

Result<Carried> form_cubic(const Contour& spirals, double tolerance, bool loop) {
  if (only<LinePiece>(spirals)) return as_they_are(spirals, Carrier::kCubic);
  Contour whole = spirals;
  whole.closed = loop;
  const auto along = cubic_along(whole, tolerance);
  if (!along) return at_point(along.error(), spirals, along.error().index, kOtherCarriers);
  Carried out{like(spirals, Carrier::kCubic), {}};
  const std::vector<RationalBezier> pieces = bezier_pieces(along->spline);
  const auto end_joint = [&](const RationalBezier& piece, double t, const Joint& end) {
    return Joint{element_near(Piece{piece}, t, end.element.theta), end.source, {}};
  };
  out.contour.joints.push_back(end_joint(pieces.front(), 0.0, spirals.joints.front()));
  add_free_pieces(pieces, out.contour);
  out.contour.joints.push_back(end_joint(pieces.back(), 1.0, spirals.joints.back()));
  out.contour.runs = proved_runs(out.contour.pieces);
  return out;
}

Result<Carried> form_baseline(const std::vector<Vec2>& points,
                              const std::vector<std::size_t>& source, bool loop,
                              std::optional<double> start_heading,
                              std::optional<double> end_heading) {
  const bool clamped = !loop && (start_heading || end_heading);
  if (!loop && !clamped && straight(points)) return baseline_of_lines(points, source);
  CubicSplineOptions options;
  std::vector<Vec2> through = points;
  if (loop) {
    options.end = SplineEnd::kPeriodic;
    through.pop_back();
  }
  auto spline = cubic_spline(through, options);
  if (spline && clamped) {  // an end without a heading keeps the slope that it has by itself
    options.end = SplineEnd::kTangents;
    options.start_slope = start_heading ? unit_at(*start_heading) : spline->slopes.front();
    options.end_slope = end_heading ? unit_at(*end_heading) : spline->slopes.back();
    spline = cubic_spline(through, options);
  }
  if (!spline) return tl::unexpected(spline.error());
  Carried out;
  out.contour.carrier = Carrier::kBaseline;
  double theta = 0.0;
  const std::vector<RationalBezier> pieces = bezier_pieces(*spline);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Element e = element_near(Piece{pieces[i]}, 0.0, theta);
    theta = e.theta;
    out.contour.joints.push_back({{points[i], e.theta, e.kappa}, source[i], {}});
    out.contour.pieces.emplace_back(pieces[i]);
  }
  const Element end = element_near(out.contour.pieces.back(), 1.0, theta);
  out.contour.joints.push_back({{points.back(), end.theta, end.kappa}, source.back(), {}});
  out.contour.runs = proved_runs(out.contour.pieces);
  return out;
}

}  // namespace obvid::pipeline_detail
