// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "commands.h"
#include "obvid/pipeline/internal/surface_report_json.h"
#include "obvid/pipeline/surface_job.h"
#include "outputs.h"
#include "surface_options.h"
#include "surface_outputs.h"
#include "surface_report.h"
#include "terminal.h"

namespace obvid {
namespace {

/// Exit code 5 for contours that were formed but do not keep their promise.
int judge_surface(const MadeSurface& made, bool files) {
  auto error = not_proved(made);
  if (!error) return 0;
  if (files) error->hint = "the files were written";
  return report(*error);
}

}  // namespace

int run(const SurfaceOptions& options) {
  std::vector<std::string> inputs;
  for (const SurfaceInput& input : options.job.inputs) inputs.push_back(input.name);
  if (const auto* second = second_inputs(options.job)) {
    for (const SurfaceInput& input : *second) inputs.push_back(input.name);
  }
  Result<std::vector<Output>> outputs = surface_outputs_of(options.outputs, inputs);
  if (!outputs) return report(outputs.error());
  ProgressBar bar(options.progress);
  bar.tell("reading", 0.0);
  Result<MadeSurface> made = make_surface(options.job, bar.progress());
  if (!made) {
    bar.clear();
    return report(made.error());
  }
  SurfaceExportOptions formats = options.formats;
  formats.lines = made->lines;
  formats.beside_longitudinals = made->beside_longitudinals;
  const auto written =
      write_surface(made->model, *outputs, formats, bar.progress(), made->warnings);
  bar.clear();
  if (!written) return report(written.error());
  warn(made->warnings);
  std::string text;
  if (options.json) {
    text = surface_report_json(*made, *written);
  } else if (!options.quiet) {
    text = surface_report_text(*made, *written);
  }
  if (auto done = put(text); !done) return report(done.error());
  return judge_surface(*made, !written->files.empty());
}

}  // namespace obvid
