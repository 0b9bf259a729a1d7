// SPDX-License-Identifier: Apache-2.0
#include "helper_message.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wire.h"

namespace obvid::cad {

// What travels, field by field. Not in an unnamed namespace: they are found by argument.

void fields(auto& io, IsA<ErrorCode> auto& code) {
  enum_field(io, code, [](ErrorCode one) {
    const auto texts = error_texts();
    return std::any_of(texts.begin(), texts.end(),
                       [one](const ErrorText& text) { return text.code == one; });
  });
}
void fields(auto& io, IsA<CadFormat> auto& format) {
  enum_field(io, format, [](CadFormat one) {
    return one == CadFormat::kStepAp214 || one == CadFormat::kStepAp242 ||
           one == CadFormat::kIges || one == CadFormat::kBrep;
  });
}
void fields(auto& io, IsA<UnitSource> auto& source) {
  enum_field(io, source, [](UnitSource one) {
    return one == UnitSource::kAssumed || one == UnitSource::kFile || one == UnitSource::kGiven;
  });
}
void fields(auto& io, IsA<Units> auto& units) { io(units.name, units.source); }
void fields(auto& io, IsA<Vec2> auto& v) { io(v.x, v.y); }
void fields(auto& io, IsA<Vec3> auto& v) { io(v.x, v.y, v.z); }
void fields(auto& io, IsA<LinePiece> auto& p) { io(p.start, p.end); }
void fields(auto& io, IsA<ArcPiece> auto& p) { io(p.start, p.end, p.theta0, p.kappa, p.length); }
void fields(auto& io, IsA<ClothoidPiece> auto& p) {
  io(p.start, p.end, p.theta0, p.kappa0, p.kappa1, p.length);
}
void fields(auto& io, IsA<RationalBezier> auto& p) {
  io(p.origin, p.degree);
  for (auto& offset : p.offset) io(offset);
  for (auto& weight : p.weight) io(weight);
}
void fields(auto& io, IsA<DrawnCurve> auto& c) { io(c.label, c.pieces, c.closed); }
void fields(auto& io, IsA<NurbsCurve> auto& c) { io(c.degree, c.knots, c.points, c.weights); }
void fields(auto& io, IsA<SpaceCurve> auto& c) { io(c.degree, c.knots, c.points, c.weights); }
void fields(auto& io, IsA<CadCurve> auto& c) { io(c.name, c.geometry); }
void fields(auto& io, IsA<NurbsSurface> auto& s) {
  io(s.degree_u, s.degree_v, s.knots_u, s.knots_v, s.points, s.weights);
}
void fields(auto& io, IsA<TrimLoop> auto& loop) { io(loop.curves); }
void fields(auto& io, IsA<SurfacePatch> auto& p) { io(p.name, p.surface, p.trims, p.trims_within); }
void fields(auto& io, IsA<SurfaceModel> auto& m) { io(m.name, m.units, m.patches); }
void fields(auto& io, IsA<CadWriteOptions> auto& o) { io(o.format, o.units, o.face_width); }
void fields(auto& io, IsA<CadSurfaces> auto& s) { io(s.model, s.warnings); }
/// Series of points do not come out of these files.
void fields(auto& io, IsA<Drawing> auto& d) {
  io(d.name, d.units, d.curves, d.warnings, d.left_out);
}
void fields(auto& io, IsA<Error> auto& e) { io(e.code, e.what, e.where, e.hint, e.index, e.value); }

void fields(auto& io, IsA<ReadCurves> auto& job) { io(job.path); }
void fields(auto& io, IsA<ReadFaces> auto& job) { io(job.path); }
void fields(auto& io, IsA<WriteCurves> auto& job) { io(job.curves, job.options); }
void fields(auto& io, IsA<WriteFaces> auto& job) { io(job.model, job.options); }

namespace {

template <class Value>
std::string packed_result(const Result<Value>& result) {
  WireOut out;
  out(result.has_value());
  result ? out(*result) : out(result.error());
  return out.take();
}

/// The value or error in the bytes; nothing when they are not whole.
template <class Value>
std::optional<Result<Value>> result_in(std::string_view bytes) {
  WireIn in(bytes);
  bool made = false;
  Value value;
  Error error;
  in(made);
  made ? in(value) : in(error);
  if (!in.done()) return std::nullopt;
  if (made) return Result<Value>(std::move(value));
  return Result<Value>(fail(std::move(error)));
}

bool finite_number(double x) { return std::isfinite(x); }
bool finite_number(Vec2 v) { return is_finite(v); }
template <class... T>
bool all_finite(const T&... all) {
  return (finite_number(all) && ...);
}

bool is_sound(const LinePiece& p) { return all_finite(p.start, p.end); }
bool is_sound(const ArcPiece& p) { return all_finite(p.start, p.end, p.theta0, p.kappa, p.length); }
bool is_sound(const ClothoidPiece& p) {
  return all_finite(p.start, p.end, p.theta0, p.kappa0, p.kappa1, p.length);
}
bool is_sound(const RationalBezier& p) {
  if (p.degree < 1 || p.degree > kMaxBezierDegree || !is_finite(p.origin)) return false;
  for (std::size_t j = 0; j <= static_cast<std::size_t>(p.degree); ++j) {
    if (!all_finite(p.offset[j], p.weight[j])) return false;
  }
  return true;
}

bool is_sound(const Drawing& drawing) {
  for (const DrawnCurve& curve : drawing.curves) {
    for (const Piece& piece : curve.pieces) {
      if (!std::visit([](const auto& one) { return is_sound(one); }, piece)) return false;
    }
  }
  return true;
}

}  // namespace

std::string packed(const Job& job) {
  WireOut out;
  out(job);
  return out.take();
}

std::optional<Job> unpacked_job(std::string_view bytes) {
  WireIn in(bytes);
  Job job;
  in(job);
  if (!in.done()) return std::nullopt;
  return job;
}

std::string packed(const Result<Drawing>& drawing) { return packed_result(drawing); }
std::string packed(const Result<CadSurfaces>& surfaces) { return packed_result(surfaces); }
std::string packed(const Result<std::string>& text) { return packed_result(text); }

Result<Drawing> unpacked_drawing(std::string_view bytes, const Error& otherwise) {
  auto result = result_in<Drawing>(bytes);
  if (!result || (*result && !is_sound(**result))) return fail(otherwise);
  return *std::move(result);
}

Result<CadSurfaces> unpacked_surfaces(std::string_view bytes, const Error& otherwise) {
  auto result = result_in<CadSurfaces>(bytes);
  if (!result) return fail(otherwise);
  if (!*result) return *std::move(result);
  for (const SurfacePatch& patch : (*result)->model.patches) {
    OBVID_TRY(check(patch));
  }
  return *std::move(result);
}

Result<std::string> unpacked_text(std::string_view bytes, const Error& otherwise) {
  auto result = result_in<std::string>(bytes);
  return result ? *std::move(result) : fail(otherwise);
}

}  // namespace obvid::cad
