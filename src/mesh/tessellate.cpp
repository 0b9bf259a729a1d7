// SPDX-License-Identifier: Apache-2.0
// The work in rounds: cells, borders that agree, triangles, a look at each triangle; cells whose
// triangles fail become fans or are cut.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "borders.h"
#include "cell_tree.h"
#include "measure.h"
#include "obvid/core/internal/parallel.h"
#include "obvid/mesh/mesh.h"
#include "patch_mesher.h"
#include "too_many_triangles.h"
#include "trimmed.h"

namespace obvid {
namespace {

using mesh::Borders;
using mesh::CellTree;
using mesh::PatchMesher;
using mesh::PatchSampler;

/// Borders that are farther apart than this part of the chord tolerance are not the same.
constexpr double kSameOfTolerance = 0.1;
/// Digits that rounding leaves of a coordinate, in units of its last place: no chord tolerance
/// below, and what is nearer is always the same.
constexpr double kRounding = 16.0;
/// Rounds of improving cells whose triangles turned out too far off: a fan, then halves, ...
constexpr int kRounds = 40;

struct Patches {
  std::vector<const NurbsSurface*> surfaces;
  std::vector<std::string> names;
};

double largest_coordinate(const Patches& patches) {
  double largest = 0.0;
  for (const NurbsSurface* s : patches.surfaces) {
    for (const Vec3& p : s->points) {
      largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    }
  }
  return largest;
}

Result<void> check_options(const TessellationOptions& options, double rounding) {
  const auto bad = [](const char* what, double value) {
    return error(ErrorCode::kBadOption, fmt::format("{} {} is not greater than 0", what, value))
        .hint("give a number greater than 0")
        .value(value);
  };
  if (!(options.chord_tolerance > 0.0) || !std::isfinite(options.chord_tolerance)) {
    return bad("the chord tolerance", options.chord_tolerance);
  }
  if (!(options.angle > 0.0) || !std::isfinite(options.angle)) {
    return bad("the angle", options.angle);
  }
  if (options.chord_tolerance < rounding) {
    return error(ErrorCode::kBadOption,
                 fmt::format("the chord tolerance {} is lost in the rounding of the coordinates",
                             options.chord_tolerance))
        .hint(fmt::format("at least {:.3g}, or move the surface to the origin", rounding))
        .value(options.chord_tolerance);
  }
  return {};
}

class Tessellator {
 public:
  Tessellator(const Patches& patches, const TessellationOptions& options, const RunContext& run)
      : patches_(patches), options_(options), run_(run) {}

  Result<std::vector<Mesh>> run() {
    for (std::size_t p = 0; p < count(); ++p) {
      if (auto good = check(*patches_.surfaces[p]); !good) return named(good.error(), p);
    }
    const double rounding =
        kRounding * std::numeric_limits<double>::epsilon() * largest_coordinate(patches_);
    OBVID_TRY(check_options(options_, rounding));
    OBVID_TRY(build_trees());
    const double same = std::max(rounding, std::min(kSameBorder * size_of(patches_.surfaces),
                                                    kSameOfTolerance * options_.chord_tolerance));
    return rounds(same);
  }

 private:
  [[nodiscard]] std::size_t count() const { return patches_.surfaces.size(); }

  /// That the work was cancelled is not about the patch.
  [[nodiscard]] tl::unexpected<Error> named(Error error, std::size_t p) const {
    if (error.code == ErrorCode::kCancelled) return fail(std::move(error));
    if (!patches_.names[p].empty()) error.where = fmt::format("patch {}", patches_.names[p]);
    error.index = static_cast<std::ptrdiff_t>(p);
    return fail(std::move(error));
  }

  Result<void> build_trees() {
    samplers_.reserve(count());
    trees_.reserve(count());
    seen_.resize(count());
    for (const NurbsSurface* surface : patches_.surfaces) samplers_.emplace_back(*surface);
    for (std::size_t p = 0; p < count(); ++p) {
      trees_.emplace_back(samplers_[p], options_);
      if (auto done = trees_[p].build(run_); !done) return named(done.error(), p);
      const double part = 0.5 * static_cast<double>(p + 1) / static_cast<double>(count());
      OBVID_TRY(tell(run_, "triangles", part));
    }
    return {};
  }

  Result<std::vector<Mesh>> rounds(double same) {
    const Topology topology = topology_of(patches_.surfaces, same);
    Borders borders(samplers_, topology);
    std::vector<Mesh> meshes(count());
    std::vector<bool> changed(count(), true);
    for (int round = 0;; ++round) {
      borders.update(trees_, changed);
      bool again = false;
      for (std::size_t p = 0; p < count(); ++p) {
        if (!changed[p]) continue;
        auto cut = draw(borders, p, round < kRounds, meshes[p]);
        if (!cut) return named(cut.error(), p);
        changed[p] = *cut;
        again = again || *cut;
        const double part = static_cast<double>(p + 1) / static_cast<double>(count());
        const auto done = round == 0 ? tell(run_, "triangles", 0.5 + 0.5 * part) : may_go_on(run_);
        OBVID_TRY(done);
      }
      if (!again) return meshes;
    }
  }

  /// Triangles of one patch; true: cells were cut, it has to be drawn again.
  Result<bool> draw(const Borders& borders, std::size_t p, bool may_cut, Mesh& mesh) {
    const RunContext run = with_threads(run_, options_.threads);
    PatchMesher mesher(samplers_[p], trees_[p], borders, p);
    OBVID_TRY(mesher.run(run));
    mesh = mesher.take();
    const std::vector<mesh::CellTriangles>& cells = mesher.triangles_of_cells();
    auto measured = mesh::measure(samplers_[p], mesh, cells, seen_[p], options_.chord_tolerance,
                                  mesh::Look::kMiddles, run);
    OBVID_TRY(measured);
    const double at_middles = measured->deviation;
    if (!measured->any_bad) {  // worth looking closer
      std::vector<mesh::CellSeen> nothing;
      auto closer = mesh::measure(samplers_[p], mesh, cells, nothing, options_.chord_tolerance,
                                  mesh::Look::kQuarters, run);
      OBVID_TRY(closer);
      closer->deviation = std::max(closer->deviation, at_middles);
      measured = std::move(closer);
    }
    mesh.deviation = measured->deviation;
    if (mesh.triangles.size() > options_.most_triangles) {
      return fail(mesh::too_many_triangles(options_.most_triangles));
    }
    if (measured->any_bad && may_cut) {
      auto cut = trees_[p].improve(measured->bad, seen_[p]);
      if (!cut || *cut) return cut;
    }
    if (at_middles > options_.chord_tolerance) {
      return error(ErrorCode::kToleranceNotReached,
                   fmt::format("triangles are {:.3g} off the surface however small they are",
                               at_middles))
          .hint("the surface folds or has a cusp there; allow a larger chord tolerance")
          .value(at_middles);
    }
    return false;
  }

  const Patches& patches_;
  const TessellationOptions& options_;
  const RunContext& run_;
  std::vector<PatchSampler> samplers_;
  std::vector<CellTree> trees_;
  std::vector<std::vector<mesh::CellSeen>> seen_;  ///< per patch and cell
};

}  // namespace

Result<Mesh> tessellate(const NurbsSurface& surface, const TessellationOptions& options) {
  auto meshes = Tessellator({{&surface}, {""}}, options, {}).run();
  OBVID_TRY(meshes);
  return std::move(meshes->front());
}

Result<std::vector<Mesh>> tessellate(const SurfaceModel& model, const TessellationOptions& options,
                                     const RunContext& run) {
  Patches patches;
  for (const SurfacePatch& patch : model.patches) {
    if (!patch.trims.empty()) continue;
    patches.surfaces.push_back(&patch.surface);
    patches.names.push_back(patch.name);
  }
  auto whole = patches.surfaces.empty() ? Result<std::vector<Mesh>>(std::vector<Mesh>{})
                                        : Tessellator(patches, options, run).run();
  if (!whole || patches.surfaces.size() == model.patches.size()) return whole;
  std::vector<Mesh> meshes;
  auto next = whole->begin();
  for (std::size_t i = 0; i < model.patches.size(); ++i) {
    const SurfacePatch& patch = model.patches[i];
    if (patch.trims.empty()) {
      meshes.push_back(std::move(*next++));
      continue;
    }
    auto mesh = mesh::tessellate_trimmed(patch, options, run);
    if (!mesh) {
      Error error = mesh.error();
      error.index = static_cast<std::ptrdiff_t>(i);
      if (error.where.empty()) error.where = patch.name;
      return fail(std::move(error));
    }
    meshes.push_back(std::move(*mesh));
  }
  return meshes;
}

}  // namespace obvid
