// SPDX-License-Identifier: Apache-2.0
// Boolean sums: what both families of curves give, less what both have in common.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "kinds.h"
#include "obvid/geom/internal/box.h"
#include "obvid/surface/internal/collocation.h"

namespace obvid {
namespace {

/// a + b - c, control point by control point.
NurbsSurface boolean_sum(const NurbsSurface& a, const NurbsSurface& b, const NurbsSurface& c) {
  std::vector<NurbsSurface> all = {a, b, c};
  make_alike(all);
  NurbsSurface sum = all[0];
  for (std::size_t i = 0; i < sum.points.size(); ++i) {
    sum.points[i] = sum.points[i] + all[1].points[i] - all[2].points[i];
  }
  return sum;
}

double extent(const std::vector<SpaceCurve>& curves) {
  Box3 box;
  for (const SpaceCurve& c : curves) box.add_all(c.points);
  return box.diagonal();
}

/// Curves that should meet in a point do so within this share of the size, apart from what the
/// tolerance allows.
constexpr double kMeeting = 1e-9;

Result<void> check_meeting(Vec3 a, Vec3 b, double allowed, const std::string& where) {
  const double gap = norm(a - b);
  if (gap <= allowed) return {};
  return error(ErrorCode::kBadOption,
               fmt::format("curves do not meet {}: the gap is {:.4g}", where, gap))
      .hint("move their ends together, or allow a larger tolerance")
      .value(gap);
}

/// All curves polynomial, with the largest deviation.
Result<double> make_polynomial(std::vector<SpaceCurve>& curves, double tolerance) {
  double deviation = 0.0;
  for (SpaceCurve& curve : curves) {
    OBVID_TRY(check(curve));
    auto form = polynomial_near(curve, tolerance);
    OBVID_TRY(form);
    curve = std::move(form->curve);
    deviation = std::max(deviation, form->deviation);
  }
  return deviation;
}

NurbsSurface ruled(const SpaceCurve& low, const SpaceCurve& high) {
  return nurbs_of(RuledSurface{low, high}, 0.0)->surface;
}

/// The corners of a Coons patch, from the curves along u.
struct Corners {
  Vec3 p00, p10, p01, p11;
};

Corners corners_of(const CoonsPatch& s) {
  return {evaluate_unit(s.u_at_v0, 0.0).point, evaluate_unit(s.u_at_v0, 1.0).point,
          evaluate_unit(s.u_at_v1, 0.0).point, evaluate_unit(s.u_at_v1, 1.0).point};
}

Result<void> check_corners(const CoonsPatch& s, double allowed) {
  const Corners c = corners_of(s);
  return check_meeting(c.p00, evaluate_unit(s.v_at_u0, 0.0).point, allowed, "at u = 0, v = 0")
      .and_then([&] {
        return check_meeting(c.p01, evaluate_unit(s.v_at_u0, 1.0).point, allowed,
                             "at u = 0, v = 1");
      })
      .and_then([&] {
        return check_meeting(c.p10, evaluate_unit(s.v_at_u1, 0.0).point, allowed,
                             "at u = 1, v = 0");
      })
      .and_then([&] {
        return check_meeting(c.p11, evaluate_unit(s.v_at_u1, 1.0).point, allowed,
                             "at u = 1, v = 1");
      });
}

/// The curves across `at` as one surface: exact at each, C2 cubic between them.
Result<NurbsSurface> through_curves(std::vector<SpaceCurve> curves, const std::vector<double>& at) {
  const auto system = cubic_collocation(at);
  OBVID_TRY(system);
  curves = compatible(std::move(curves));
  const std::size_t width = curves.front().points.size();
  NurbsSurface s{
      curves.front().degree, system->degree, curves.front().knots, system->knots, {}, {}};
  s.points.resize(width * curves.size());
  for (std::size_t i = 0; i < width; ++i) {
    std::vector<Vec3> column;
    for (const SpaceCurve& c : curves) column.push_back(c.points[i]);
    column = system->matrix.solve(std::move(column));
    for (std::size_t j = 0; j < column.size(); ++j) s.points[j * width + i] = column[j];
  }
  return s;
}

/// Interpolation of jets at parameters: value and two derivatives of each, by the other parameter.
struct Cross {
  SpaceJet value, first, second;
};

Cross across(const std::vector<SpaceJet>& jets, const std::vector<double>& at, double t) {
  std::vector<Vec3> point, d1, d2;
  for (const SpaceJet& jet : jets) {
    point.push_back(jet.point);
    d1.push_back(jet.d1);
    d2.push_back(jet.d2);
  }
  const auto curve = [&](const std::vector<Vec3>& values) {
    return evaluate(*interpolated(values, at), t);
  };
  return {curve(point), curve(d1), curve(d2)};
}

std::vector<SpaceJet> jets_at(const std::vector<SpaceCurve>& curves, double t) {
  std::vector<SpaceJet> jets;
  for (const SpaceCurve& c : curves) jets.push_back(evaluate_unit(c, t));
  return jets;
}

/// Rows of points where the curves along u cross: [curve along u][curve along v].
std::vector<std::vector<Vec3>> crossings(const GordonSurface& s) {
  std::vector<std::vector<Vec3>> points;
  for (const SpaceCurve& c : s.along_u) {
    points.emplace_back();
    for (const double u : s.u_at) points.back().push_back(evaluate_unit(c, u).point);
  }
  return points;
}

Result<void> check_net(const GordonSurface& s, double allowed) {
  if (s.along_u.size() < 2 || s.along_v.size() < 2) {
    return error(ErrorCode::kTooFewCurves, "a net needs at least two curves of each family")
        .value(static_cast<double>(std::min(s.along_u.size(), s.along_v.size())));
  }
  const bool whole = s.v_at.size() == s.along_u.size() && s.u_at.size() == s.along_v.size() &&
                     s.v_at.front() == 0.0 && s.v_at.back() == 1.0 && s.u_at.front() == 0.0 &&
                     s.u_at.back() == 1.0;
  if (!whole) {
    return error(ErrorCode::kBadOption, "each curve needs its parameter, from 0 to 1");
  }
  for (const auto* at : {&s.v_at, &s.u_at}) {
    for (std::size_t i = 1; i < at->size(); ++i) {
      if ((*at)[i] > (*at)[i - 1]) continue;
      return error(ErrorCode::kBadOption,
                   fmt::format("the parameter of curve {} is not above the one before", i + 1))
          .hint("give curves in the order of their parameters")
          .point(i)
          .value((*at)[i]);
    }
  }
  const auto points = crossings(s);
  for (std::size_t j = 0; j < points.size(); ++j) {
    for (std::size_t i = 0; i < points[j].size(); ++i) {
      auto good = check_meeting(
          points[j][i], evaluate_unit(s.along_v[i], s.v_at[j]).point, allowed,
          fmt::format("where curve {} along u crosses curve {} along v", j + 1, i + 1));
      if (!good) return good;
    }
  }
  return {};
}

}  // namespace

SurfaceJet evaluate_kind(const CoonsPatch& s, double u, double v) {
  const SurfaceJet a = evaluate_kind(RuledSurface{s.u_at_v0, s.u_at_v1}, u, v);
  const SurfaceJet b =
      evaluate_kind(RuledSurface{s.v_at_u0, s.v_at_u1}, v, u);  // u and v exchanged
  const Corners c = corners_of(s);
  const Vec3 low = (1.0 - u) * c.p00 + u * c.p10, high = (1.0 - u) * c.p01 + u * c.p11;
  const Vec3 twist = c.p00 - c.p10 - c.p01 + c.p11;
  const Vec3 by_u = (1.0 - v) * (c.p10 - c.p00) + v * (c.p11 - c.p01);
  return {a.point + b.point - ((1.0 - v) * low + v * high),
          a.du + b.dv - by_u,
          a.dv + b.du - (high - low),
          a.duu,
          a.duv + b.duv - twist,
          b.duu};
}

namespace {

/// Rational curves followed within a third of `tolerance` each, which bounds the deviation of a
/// Coons patch only; gaps between curves up to `gap` are let pass.
Result<NurbsForm> form_within(const CoonsPatch& s, double tolerance, double gap) {
  std::vector<SpaceCurve> curves = {s.u_at_v0, s.u_at_v1, s.v_at_u0, s.v_at_u1};
  const double allowed = kMeeting * extent(curves) + std::max(0.0, gap);
  // four curves deviate together three times at most: two ruled surfaces and the bilinear one
  const auto deviation = make_polynomial(curves, tolerance / 3.0);
  OBVID_TRY(deviation);
  const CoonsPatch patch{curves[0], curves[1], curves[2], curves[3]};
  OBVID_TRY(check_corners(patch, allowed));
  const Corners c = corners_of(patch);
  const NurbsSurface corner = ruled(line_between(c.p00, c.p10), line_between(c.p01, c.p11));
  return NurbsForm{
      boolean_sum(ruled(curves[0], curves[1]), transposed(ruled(curves[2], curves[3])), corner),
      3.0 * *deviation};
}

}  // namespace

SurfaceJet evaluate_kind(const GordonSurface& s, double u, double v) {
  const Cross a = across(jets_at(s.along_u, u), s.v_at, v);
  const Cross b = across(jets_at(s.along_v, v), s.u_at, u);
  std::vector<SpaceJet> rows;  // of the points of crossing, by u
  for (const auto& row : crossings(s)) rows.push_back(evaluate(*interpolated(row, s.u_at), u));
  const Cross c = across(rows, s.v_at, v);
  return {
      a.value.point + b.value.point - c.value.point, a.first.point + b.value.d1 - c.first.point,
      a.value.d1 + b.first.point - c.value.d1,       a.second.point + b.value.d2 - c.second.point,
      a.first.d1 + b.first.d1 - c.first.d1,          a.value.d2 + b.second.point - c.value.d2};
}

namespace {

Result<NurbsForm> form_within(const GordonSurface& given, double tolerance, double gap) {
  GordonSurface s = given;
  std::vector<SpaceCurve> all = s.along_u;
  all.insert(all.end(), s.along_v.begin(), s.along_v.end());
  const double allowed = kMeeting * extent(all) + std::max(0.0, gap);
  const auto along_u = make_polynomial(s.along_u, tolerance / 3.0);
  OBVID_TRY(along_u);
  const auto along_v = make_polynomial(s.along_v, tolerance / 3.0);
  OBVID_TRY(along_v);
  OBVID_TRY(check_net(s, allowed));
  const auto first = through_curves(s.along_u, s.v_at);
  OBVID_TRY(first);
  const auto second = through_curves(s.along_v, s.u_at);
  OBVID_TRY(second);
  std::vector<SpaceCurve> rows;
  for (const auto& row : crossings(s)) rows.push_back(*interpolated(row, s.u_at));
  const auto common = through_curves(rows, s.v_at);
  OBVID_TRY(common);
  return NurbsForm{boolean_sum(*first, transposed(*second), *common),
                   3.0 * std::max(*along_u, *along_v)};
}

/// Places in the spans of knots, thinned where there are very many.
std::vector<double> span_samples(const std::vector<double>& knots) {
  constexpr std::size_t kMost = 120;
  std::vector<double> at;
  for (std::size_t k = 1; k < knots.size(); ++k) {
    const Range span{knots[k - 1], knots[k]};
    if (!(span.length() > 0.0)) continue;
    // half way is where cubics with the right ends and slopes err most
    for (const double part : {0.0, 0.2, 0.5, 0.8}) at.push_back(span.at(part));
  }
  at.push_back(knots.back());
  // odd, so that all places within spans have their turn
  const std::size_t step = (1 + at.size() / kMost) | 1U;
  std::vector<double> thinned;
  for (std::size_t i = 0; i < at.size(); i += step) thinned.push_back(at[i]);
  return thinned;
}

/// Largest distance of the NURBS form from the definition on a raster.
template <class Kind>
double form_error(const Kind& kind, const NurbsSurface& form) {
  const std::vector<double> us = span_samples(form.knots_u), vs = span_samples(form.knots_v);
  double worst = 0.0;
  for (const double v : vs) {
    for (const double u : us) {
      worst = std::max(worst, norm(evaluate_kind(kind, u, v).point - evaluate(form, u, v).point));
    }
  }
  constexpr double kBetween = 1.1;  // what errors rise between samples
  return kBetween * worst;
}

/// Coons and Gordon of rational curves: errors of the curves add, and interpolation across a net
/// makes them larger by some factor that is found by trying.
template <class Kind>
Result<NurbsForm> network_form(const Kind& kind, double tolerance) {
  constexpr int kTries = 5;
  double share = tolerance;
  for (int i = 0; i < kTries; ++i, share /= 4.0) {
    auto form = form_within(kind, share, tolerance);
    if (!form || form->deviation == 0.0) return form;
    form->deviation = std::max(form_error(kind, form->surface), form->deviation / 3.0);
    if (form->deviation <= tolerance) return form;
  }
  return error(ErrorCode::kToleranceNotReached, "rational curves of a net are not followed")
        .hint("allow a larger tolerance")
        .value(tolerance);
}

}  // namespace

Result<NurbsForm> nurbs_of(const CoonsPatch& s, double tolerance) {
  return network_form(s, tolerance);
}
Result<NurbsForm> nurbs_of(const GordonSurface& s, double tolerance) {
  return network_form(s, tolerance);
}

}  // namespace obvid
