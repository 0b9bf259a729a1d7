// SPDX-License-Identifier: Apache-2.0
#include "program_check.h"

#include <algorithm>
#include <utility>

#include "level_passes.h"
#include "obvid/exchange/internal/gcode/nc_program.h"
#include "roughing.h"
#include "steps.h"

namespace obvid::toolpath {
namespace {

/// Depth of the chords that stand for the program's arcs, the lesser of: of the tolerance, and of
/// how near the bounds of what is left come to what was found.
constexpr double kChordDepth = 0.005, kChordOfWithin = 0.05;
constexpr double kWithin = 0.1;  // of the tolerance, where no scallop is asked for

std::vector<Sweep> sweeps_of(const exchange::NcProgram& program, double scale, double top) {
  std::vector<Sweep> out;
  for (const exchange::NcMotion& motion : program.motions) {
    for (std::size_t i = 1; i < motion.points.size(); ++i) {
      const Sweep sweep{motion.points[i - 1] / scale, motion.points[i] / scale};
      const bool over_all = motion.rapid && std::min(sweep.from.z, sweep.to.z) > top;
      if (!over_all) out.push_back(sweep);
    }
  }
  return out;
}

}  // namespace

Result<SimulationReport> check_program(const Part& part, const SurfaceCells& cells,
                                       LargeList<Nearest>& reach, const Leftover* left,
                                       const std::string& text, double scale,
                                       const ToolpathOptions& options, const RunContext& run) {
  const double within =
      options.scallop ? kScallopWithin * *options.scallop : kWithin * options.tolerance;
  const double chord = std::min(kChordDepth * options.tolerance, kChordOfWithin * within);
  const auto program = exchange::read_program(text, chord * scale);
  OBVID_TRY(program);
  OBVID_TRY(tell(run, "checking", 0.0));
  Simulation simulation(part, cells, reach, options.threads, chord);
  simulation.judge_only(left);
  OBVID_TRY(simulation.cut(sweeps_of(*program, scale, part.field().high().z), run));
  if (options.strategy == ToolpathStrategy::kZLevel) {
    simulation.judge_flat_apart(*flat_from(options), options.scallop.value_or(options.tolerance));
  }
  if (options.strategy == ToolpathStrategy::kRough) {
    return simulation.rough_report(options.tolerance, stock_of(part, options), run);
  }
  return simulation.report(options.tolerance, within, run);
}

}  // namespace obvid::toolpath
