// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <variant>

#include "obvid/surface/surface.h"

namespace obvid {

// A kind of surface is known by five functions, told apart by its type: its name, its ranges of u
// and v where they are not [0, 1], point and derivatives straight from the definition, its NURBS
// form within `tolerance` (which exact kinds leave aside) with the checks that it needs. Each kind
// has them in a file of its own; nothing else knows the kinds apart (docs/conventions.md, Recipes).

inline const char* kind_name(const NurbsSurface&) { return "NURBS surface"; }
inline const char* kind_name(const RuledSurface&) { return "ruled surface between two curves"; }
inline const char* kind_name(const DirectedSurface&) { return "ruled surface of a directrix and directions"; }
inline const char* kind_name(const RevolutionSurface&) { return "surface of revolution"; }
inline const char* kind_name(const CoonsPatch&) { return "Coons patch"; }
inline const char* kind_name(const GordonSurface&) { return "Gordon surface"; }
inline const char* kind_name(const OffsetSurface&) { return "offset surface"; }
inline const char* kind_name(const IdSurface&) { return "integro-differential spline surface"; }

template <class Kind>
std::array<Range, 2> ranges_of(const Kind&) {
  return {};
}
inline std::array<Range, 2> ranges_of(const NurbsSurface& s) { return {domain_u(s), domain_v(s)}; }
inline std::array<Range, 2> ranges_of(const DirectedSurface& s) {
  return {Range{}, Range{s.from, s.to}};
}
inline std::array<Range, 2> ranges_of(const OffsetSurface& s) { return ranges_of(s.base); }
[[nodiscard]] std::array<Range, 2> ranges_of(const IdSurface& s);

inline SurfaceJet evaluate_kind(const NurbsSurface& s, double u, double v) {
  return evaluate(s, u, v);
}
[[nodiscard]] SurfaceJet evaluate_kind(const RuledSurface& s, double u, double v);
[[nodiscard]] SurfaceJet evaluate_kind(const DirectedSurface& s, double u, double v);
[[nodiscard]] SurfaceJet evaluate_kind(const RevolutionSurface& s, double u, double v);
[[nodiscard]] SurfaceJet evaluate_kind(const CoonsPatch& s, double u, double v);
[[nodiscard]] SurfaceJet evaluate_kind(const GordonSurface& s, double u, double v);
[[nodiscard]] SurfaceJet evaluate_kind(const OffsetSurface& s, double u, double v);
[[nodiscard]] SurfaceJet evaluate_kind(const IdSurface& s, double u, double v);

[[nodiscard]] Result<NurbsForm> nurbs_of(const NurbsSurface& s, double tolerance);
[[nodiscard]] Result<NurbsForm> nurbs_of(const RuledSurface& s, double tolerance);
[[nodiscard]] Result<NurbsForm> nurbs_of(const DirectedSurface& s, double tolerance);
[[nodiscard]] Result<NurbsForm> nurbs_of(const RevolutionSurface& s, double tolerance);
[[nodiscard]] Result<NurbsForm> nurbs_of(const CoonsPatch& s, double tolerance);
[[nodiscard]] Result<NurbsForm> nurbs_of(const GordonSurface& s, double tolerance);
[[nodiscard]] Result<NurbsForm> nurbs_of(const OffsetSurface& s, double tolerance);
[[nodiscard]] Result<NurbsForm> nurbs_of(const IdSurface& s, double tolerance);

// What `surface.h` promises of any kind, for any list of kinds.

template <class Kinds>
std::array<Range, 2> ranges_of_any(const Kinds& surface) {
  return std::visit([](const auto& s) { return ranges_of(s); }, surface);
}
template <class Kinds>
SurfaceJet evaluate_any(const Kinds& surface, double u, double v) {
  return std::visit([&](const auto& s) { return evaluate_kind(s, u, v); }, surface);
}
template <class Kinds>
Result<NurbsForm> nurbs_of_any(const Kinds& surface, double tolerance) {
  return std::visit([&](const auto& s) { return nurbs_of(s, tolerance); }, surface);
}
template <class Kinds>
std::string name_of_any(const Kinds& surface) {
  return std::visit([](const auto& s) { return std::string(kind_name(s)); }, surface);
}

/// Point and derivatives by the curve's domain scaled to [0, 1].
[[nodiscard]] SpaceJet evaluate_unit(const SpaceCurve& curve, double t);

/// A rational curve as C1 cubic within the tolerance, over [0, 1]; polynomial ones as they are.
/// Error: E502 beyond 2^12 parts of a span.
struct PolynomialForm {
  SpaceCurve curve;
  double deviation = 0.0;
};
[[nodiscard]] Result<PolynomialForm> polynomial_near(const SpaceCurve& curve, double tolerance);

/// The same degrees and knots for all surfaces; polynomial ones over [0, 1]^2.
void make_alike(std::vector<NurbsSurface>& surfaces);

}  // namespace obvid
