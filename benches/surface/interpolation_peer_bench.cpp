// SPDX-License-Identifier: Apache-2.0
// Open CASCADE beside this engine, in one run on the same data: a grid of 300 x 300 points
// interpolated, a raster of 1000 x 1000 points with both partial derivatives, the face as STEP.
#include <benchmark/benchmark.h>

#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <cmath>
#include <utility>
#include <vector>

#include "obvid/cad/internal/cad.h"
#include "obvid/surface_builders/internal/grid.h"

namespace obvid {
namespace {

constexpr std::size_t kPeerSide = 300;
constexpr std::size_t kRaster = 1000;

PointGrid peer_grid() {
  PointGrid grid{kPeerSide, kPeerSide, {}, "wavy"};
  for (std::size_t j = 0; j < kPeerSide; ++j) {
    for (std::size_t i = 0; i < kPeerSide; ++i) {
      const double x = static_cast<double>(i) / (kPeerSide - 1);
      const double y = static_cast<double>(j) / (kPeerSide - 1);
      grid.points.push_back({x, y, 0.1 * std::sin(7.0 * x) * std::cos(5.0 * y)});
    }
  }
  return grid;
}

TColgp_Array2OfPnt kernel_grid() {
  const PointGrid grid = peer_grid();
  TColgp_Array2OfPnt out(1, kPeerSide, 1, kPeerSide);
  for (std::size_t j = 0; j < kPeerSide; ++j) {
    for (std::size_t i = 0; i < kPeerSide; ++i) {
      const Vec3 p = grid.at(i, j);
      out(static_cast<int>(i) + 1, static_cast<int>(j) + 1) = gp_Pnt(p.x, p.y, p.z);
    }
  }
  return out;
}

/// Our surface as the kernel's: both evaluate the same control points over the same knots.
Handle(Geom_BSplineSurface) in_kernel(const NurbsSurface& surface) {
  const auto knots = [](const std::vector<double>& all, int degree) {
    const int inner = static_cast<int>(all.size()) - 2 * degree;  // clamped, inner ones single
    std::pair<TColStd_Array1OfReal, TColStd_Array1OfInteger> out{TColStd_Array1OfReal(1, inner),
                                                                 TColStd_Array1OfInteger(1, inner)};
    out.second.Init(1);
    out.second(1) = out.second(inner) = degree + 1;
    for (int k = 1; k <= inner; ++k) out.first(k) = all[static_cast<std::size_t>(degree + k - 1)];
    return out;
  };
  const int n = static_cast<int>(surface.count_u()), m = static_cast<int>(surface.count_v());
  TColgp_Array2OfPnt poles(1, n, 1, m);
  std::size_t at = 0;
  for (int j = 1; j <= m; ++j) {
    for (int i = 1; i <= n; ++i, ++at) {
      const Vec3 p = surface.points[at];
      poles(i, j) = gp_Pnt(p.x, p.y, p.z);
    }
  }
  const auto u = knots(surface.knots_u, 3), v = knots(surface.knots_v, 3);
  return new Geom_BSplineSurface(poles, u.first, v.first, u.second, v.second, 3, 3);
}

void interpolation_obvid(benchmark::State& state) {
  const PointGrid grid = peer_grid();
  for (auto _ : state) {
    const Result<NurbsSurface> surface = interpolated(grid);
    benchmark::DoNotOptimize(surface->points.data());
  }
}
BENCHMARK(interpolation_obvid)->Unit(benchmark::kMillisecond);

void interpolation_open_cascade(benchmark::State& state) {
  const TColgp_Array2OfPnt grid = kernel_grid();
  for (auto _ : state) {
    GeomAPI_PointsToBSplineSurface made;
    made.Interpolate(grid);
    benchmark::DoNotOptimize(made.Surface()->NbUPoles());
  }
}
BENCHMARK(interpolation_open_cascade)->Unit(benchmark::kMillisecond);

std::vector<double> peer_steps() {
  std::vector<double> at(kRaster);
  for (std::size_t i = 0; i < kRaster; ++i) at[i] = static_cast<double>(i) / (kRaster - 1.0);
  return at;
}

void count_points(benchmark::State& state) {
  state.counters["per_point"] = benchmark::Counter(
      static_cast<double>(kRaster * kRaster),
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void raster_obvid(benchmark::State& state) {
  const NurbsSurface surface = *interpolated(peer_grid());
  const std::vector<double> at = peer_steps();
  std::vector<SurfacePoint> out(at.size() * at.size());
  for (auto _ : state) {
    evaluate_raster(surface, at, at, out);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  count_points(state);
}
BENCHMARK(raster_obvid)->Unit(benchmark::kMillisecond);

/// Calls `at(u, v)` over the raster, in rows of u.
template <class At>
void raster_of_kernel(benchmark::State& state, At at) {
  const std::vector<double> parameters = peer_steps();
  for (auto _ : state) {
    for (const double v : parameters) {
      for (const double u : parameters) at(u, v);
    }
  }
  count_points(state);
}

void raster_open_cascade_d1(benchmark::State& state) {
  const Handle(Geom_BSplineSurface) surface = in_kernel(*interpolated(peer_grid()));
  raster_of_kernel(state, [&](double u, double v) {
    gp_Pnt p;
    gp_Vec du, dv;
    surface->D1(u, v, p, du, dv);
    benchmark::DoNotOptimize(p);
    benchmark::DoNotOptimize(du);
    benchmark::DoNotOptimize(dv);
  });
}
BENCHMARK(raster_open_cascade_d1)->Unit(benchmark::kMillisecond);

void raster_open_cascade_cached_d1(benchmark::State& state) {
  const GeomAdaptor_Surface surface(in_kernel(*interpolated(peer_grid())));
  raster_of_kernel(state, [&](double u, double v) {
    gp_Pnt p;
    gp_Vec du, dv;
    surface.D1(u, v, p, du, dv);
    benchmark::DoNotOptimize(p);
    benchmark::DoNotOptimize(du);
    benchmark::DoNotOptimize(dv);
  });
}
BENCHMARK(raster_open_cascade_cached_d1)->Unit(benchmark::kMillisecond);

void raster_open_cascade_cached_position(benchmark::State& state) {
  const GeomAdaptor_Surface surface(in_kernel(*interpolated(peer_grid())));
  raster_of_kernel(state, [&](double u, double v) {
    gp_Pnt p;
    surface.D0(u, v, p);
    benchmark::DoNotOptimize(p);
  });
}
BENCHMARK(raster_open_cascade_cached_position)->Unit(benchmark::kMillisecond);

/// Text of the file of one bicubic face on 300 x 300 points.
void cad_text_of_face(benchmark::State& state, CadFormat format) {
  SurfaceModel model;
  model.patches = {{"wavy", *interpolated(peer_grid())}};
  CadWriteOptions options;
  options.format = format;
  std::size_t bytes = 0;
  for (auto _ : state) {
    const Result<std::string> text = cad_surface_text(model, options);
    if (!text) return state.SkipWithError(text.error().what.c_str());
    bytes = text->size();
  }
  state.counters["bytes"] = static_cast<double>(bytes);
}
void face_as_step(benchmark::State& state) { cad_text_of_face(state, CadFormat::kStepAp214); }
void face_as_iges(benchmark::State& state) { cad_text_of_face(state, CadFormat::kIges); }
void face_as_brep(benchmark::State& state) { cad_text_of_face(state, CadFormat::kBrep); }
BENCHMARK(face_as_step)->Unit(benchmark::kMillisecond);
BENCHMARK(face_as_iges)->Unit(benchmark::kMillisecond);
BENCHMARK(face_as_brep)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace obvid
