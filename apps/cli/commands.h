// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include "options.h"

namespace obvid {

struct AlignmentCommand;
struct CutCommand;
struct NurbsOptions;
struct SplineOptions;
struct SurfaceCheckOptions;
struct SurfaceCutOptions;
struct SurfaceOptions;
struct ToolpathCommand;

/// The whole program: what the arguments ask for; the exit code.
int run_guarded(int argc, const char* const* argv);

/// Called before standard input is read where no argument says so: the launcher's first program
/// keeps it for the whole one.
void keep_standard_input();

/// Each runs one subcommand and returns the exit code.
int run(const FitOptions& options);
int run(const AnalyseOptions& options);
int run(const RegionOptions& options);
int run(const CompareOptions& options);
/// The same of several inputs.
int compare_several(const CompareOptions& options);
int run(const ConvertOptions& options);
int run(const VerifyOptions& options);
int run(const ExplainOptions& options);
int run(const SurfaceOptions& options);
int run(const SurfaceCheckOptions& options);
int run(const SurfaceCutOptions& options);
int run(const SplineOptions& options);
int run(const NurbsOptions& options);
int run(const ToolpathCommand& command);
int run(const CutCommand& command);
int run(const AlignmentCommand& command);
int run(const StudioOptions& options);
int run(const BatchOptions& options);
int run(const ShowText& shown);

/// The command with these options.
template <class Options>
[[nodiscard]] Command command_of(Options options) {
  return [options = std::move(options)] { return run(options); };
}

}  // namespace obvid
