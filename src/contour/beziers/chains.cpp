// SPDX-License-Identifier: Apache-2.0
// Condensation of whole pieces, and curvatures from triangles: docs/methods/beziers.md, sections 3
// and 4.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>

#include "obvid/contour/beziers.h"
#include "obvid/region/internal/convex_triangle.h"
#include "obvid/region/internal/refine.h"
#include "obvid/region/internal/segment_region.h"

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

  Result<ParabolaChain> run(const Element& start, const Element& end) {
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

/// Geometric mean; nothing where the curvature would change its sign.
std::optional<double> mean_curvature(double before, double behind) {
  if (!(before * behind > 0.0)) return std::nullopt;
  return std::copysign(std::sqrt(before * behind), before);
}

}  // namespace

Result<ParabolaChain> condense_piece(const Piece& piece, int direction, double tolerance) {
  return condense_piece(piece, element_at(piece, 0.0), element_at(piece, 1.0), direction,
                        tolerance);
}

Result<ParabolaChain> condense_piece(const Piece& piece, const Element& start, const Element& end,
                                     int direction, double tolerance) {
  return PieceCondenser(piece, direction, tolerance).run(start, end);
}

std::vector<std::optional<double>> curvatures_of_triangles(const std::vector<Vec2>& points,
                                                           const std::vector<double>& headings,
                                                           bool closed) {
  const std::size_t n = points.size();
  assert(n >= 2 && headings.size() == n);
  std::vector<std::optional<EndCurvatures>> own;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    own.push_back(parabola_curvatures(points[i], headings[i], points[i + 1], headings[i + 1]));
  }
  const auto mean_at = [&own](std::size_t before, std::size_t behind) {
    if (!own[before] || !own[behind]) return std::optional<double>{};
    return mean_curvature(own[before]->end, own[behind]->start);
  };
  std::vector<std::optional<double>> out(n);
  for (std::size_t i = 1; i + 1 < n; ++i) out[i] = mean_at(i - 1, i);
  if (closed) {
    out.front() = out.back() = mean_at(n - 2, 0);
    return out;
  }
  // the ends lie beyond their triangle's by as much as their neighbours do
  if (own.front()) {
    const double ratio = out[1] && n > 2 ? own.front()->end / *out[1] : 1.0;
    out.front() = own.front()->start * ratio;
  }
  if (own.back()) {
    const double ratio = out[n - 2] && n > 2 ? own.back()->start / *out[n - 2] : 1.0;
    out.back() = own.back()->end * ratio;
  }
  return out;
}

}  // namespace obvid
