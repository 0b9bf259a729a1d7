// SPDX-License-Identifier: Apache-2.0
// Condensation of whole pieces, and curvatures from triangles: docs/methods/beziers.md, sections 3
// and 4.
#include <algorithm>
#include <cmath>
#include <string>

#include "obvid/contour/beziers.h"
#include "obvid/region/convex_triangle.h"
#include "obvid/region/refine.h"
#include "obvid/region/segment_region.h"

namespace obvid {
namespace {

/// Halvings of one piece: 65,536 links of it are more than anyone wants, and where they do not do,
/// curvature is constant to rounding.
constexpr int kMostHalvings = 16;

/// What one link of the chain came to.
struct Link {
  std::optional<Condensation> condensed;
  double width = 0.0;
};

class PieceCondenser {
 public:
  PieceCondenser(const Piece& piece, int direction, double tolerance)
      : piece_(piece), direction_(direction), tolerance_(tolerance) {}

  Result<ParabolaChain> run() {
    const Element start = element_at(piece_, 0.0), end = element_at(piece_, 1.0);
    if (!(start.kappa * end.kappa > 0.0)) {
      return fail({ErrorCode::kNoSpiral, "curvature is zero or changes sign on the piece", "",
                   "parabolas have no inflection: choose another carrier for this contour", -1,
                   start.kappa * end.kappa < 0.0 ? 0.0 : std::min(start.kappa, end.kappa)});
    }
    out_.at.push_back(0.0);
    if (!append(0.0, start, 1.0, end, 0)) {
      return fail({ErrorCode::kToleranceNotReached,
                   "no chain of monotone parabolas was found within the tolerance", "",
                   "curvature hardly changes there: an arc or another carrier does it", -1,
                   failed_width_});
    }
    return std::move(out_);
  }

 private:
  Link try_link(const Element& a, const Element& b) const {
    const auto region = segment_region(chord_frame(a, b), direction_);
    if (!region || !(region->width <= tolerance_))
      return {std::nullopt, region ? region->width : 0};
    return {condense(a, b, direction_), region->width};
  }

  // Depth is at most kMostHalvings.
  bool append(double t0, const Element& a, double t1, const Element& b, int halvings) {
    const Link link = try_link(a, b);
    if (link.condensed) {
      out_.parabolas.insert(out_.parabolas.end(), link.condensed->parabolas.begin(),
                            link.condensed->parabolas.end());
      out_.at.push_back(t1);
      out_.width = std::max(out_.width, link.width);
      return true;
    }
    if (halvings == kMostHalvings) {
      failed_width_ = link.width;
      return false;
    }
    const double t = 0.5 * (t0 + t1);
    const Element middle = element_at(piece_, t);
    return append(t0, a, t, middle, halvings + 1) && append(t, middle, t1, b, halvings + 1);
  }

  const Piece& piece_;
  int direction_;
  double tolerance_;
  ParabolaChain out_;
  double failed_width_ = 0.0;
};

/// Curvatures that the parabola of one triangle has at its ends, signed.
struct EndCurvatures {
  double start = 0.0, end = 0.0;
};

std::optional<EndCurvatures> parabola_curvatures(Vec2 p, double theta0, Vec2 q, double theta1) {
  const auto t = tangent_triangle(p, unit_at(theta0), q, unit_at(theta1));
  if (!t) return std::nullopt;
  // twice the area is chord times height; the apex lies on the outer side of the turn
  const double area = -t->side * 0.5 * norm(q - p) * t->height;
  return EndCurvatures{area / (t->to_apex * t->to_apex * t->to_apex),
                       area / (t->from_apex * t->from_apex * t->from_apex)};
}

tl::unexpected<Error> refuse(std::size_t i, const char* what, double value) {
  return fail({ErrorCode::kNoSpiral, what, "point " + std::to_string(i + 1),
               "choose other headings, or another order of fixation", static_cast<std::ptrdiff_t>(i),
               value});
}

}  // namespace

Result<ParabolaChain> condense_piece(const Piece& piece, int direction, double tolerance) {
  return PieceCondenser(piece, direction, tolerance).run();
}

Result<std::vector<Element>> elements_of_triangles(const std::vector<Vec2>& points,
                                                   const std::vector<double>& headings,
                                                   int direction) {
  const std::size_t n = points.size();
  if (headings.size() != n) {
    return fail({ErrorCode::kUsage, "one heading for each point is expected", "", "", -1,
                 static_cast<double>(headings.size())});
  }
  if (n < 3) {
    return fail({ErrorCode::kTooFewPoints, "at least 3 points are needed", "", "add points", -1,
                 static_cast<double>(n)});
  }
  std::vector<EndCurvatures> own(n - 1);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const auto k = parabola_curvatures(points[i], headings[i], points[i + 1], headings[i + 1]);
    if (!k) return refuse(i, "the tangents do not meet between two neighbouring points", 0.0);
    own[i] = *k;
  }
  std::vector<Element> elements(n);
  double first_ratio = 1.0, last_ratio = 1.0;
  for (std::size_t i = 0; i < n; ++i) elements[i] = {points[i], headings[i], 0.0};
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = own[i - 1].end, behind = own[i].start;
    if (before * behind <= 0.0) return refuse(i, "the tangents ask for an inflection", 0.0);
    elements[i].kappa = std::copysign(std::sqrt(before * behind), before);
    last_ratio = std::sqrt(behind / before);
    if (i == 1) first_ratio = std::sqrt(before / behind);
  }
  elements.front().kappa = own.front().start * first_ratio;
  elements.back().kappa = own.back().end * last_ratio;
  for (std::size_t i = 1; i < n; ++i) {
    const double change = elements[i].kappa - elements[i - 1].kappa;
    if (!(direction * change > 0.0)) {
      return refuse(i, "the radii of neighbouring triangles are not in order", change);
    }
  }
  return elements;
}

}  // namespace obvid
