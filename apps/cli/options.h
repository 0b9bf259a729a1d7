// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "obvid/core/result.h"
#include "obvid/pipeline/compare_curves.h"
#include "obvid/pipeline/export.h"
#include "obvid/pipeline/fit.h"
#include "obvid/pipeline/import.h"
#include "obvid/pipeline/region_table.h"

namespace obvid {

struct FitOptions {
  std::string input;
  std::vector<std::string> inputs;    ///< several, in place of one
  std::optional<std::string> text{};  ///< of standard input, which is read once
  std::vector<std::string> outputs;
  FitJob job;
  ImportOptions import;
  ExportOptions formats;
  std::string profile;            ///< what --for chose, in words; empty without it
  std::vector<std::string> idle;  ///< what is to be said of options that nothing uses
  std::optional<Units> units;
  std::optional<RegionJob> construction;  ///< of the papers, in place of the job
  std::optional<Vec3> along;              ///< of points in space: direction of the projection
  bool flat = false;                      ///< of points in space: heights are not used
  bool suggest = false;                   ///< how many vertices which tolerance would need
  bool csv = false;
  bool json = false;
  bool quiet = false;
  bool progress = true;

  /// Of the input, in messages.
  [[nodiscard]] std::string name() const { return input == "-" ? "standard input" : input; }
};

struct ConvertOptions {
  std::string input;
  std::vector<std::string> inputs;  ///< several, in place of one
  ImportOptions import;
  std::vector<std::string> outputs;
  ExportOptions formats;
  std::string profile;            ///< what --for chose, in words; empty without it
  std::vector<std::string> idle;  ///< what is to be said of options that nothing uses
  std::optional<Units> units;
  bool csv = false;
  bool json = false;
  bool quiet = false;
};

struct AnalyseOptions {
  std::string input;
  std::vector<std::string> inputs;  ///< several, in place of one
  std::vector<std::string> outputs;
  ImportOptions import;
  PicturePlots plots;
  std::string asked;  ///< what was typed, for pages
  std::optional<Units> units;
  bool csv = false;
  bool json = false;
  bool quiet = false;
};

struct RegionOptions {
  std::string input;
  std::vector<std::string> inputs;  ///< several, in place of one
  std::vector<std::string> outputs;
  ImportOptions import;
  RegionJob job;
  std::string asked;  ///< what was typed, for pages
  std::optional<Units> units;
  bool csv = false;
  bool json = false;
  bool quiet = false;
};

struct CompareOptions {
  std::string input;
  std::vector<std::string> inputs;  ///< several: laid over each other
  CurvesJob curves;
  std::optional<double> enlarge;  ///< of their picture
  ShownCurvatures shown;
  ImportOptions import;
  std::vector<std::string> outputs;
  FitJob job;
  std::string asked;  ///< what was typed, for pages
  std::optional<Units> units;
  bool csv = false;
  bool json = false;
  bool quiet = false;
  bool progress = true;
};

struct VerifyOptions {
  std::string input;
  std::vector<std::string> inputs;   ///< several, in place of one
  std::vector<std::string> outputs;  ///< .json, .html, .csv
  std::string asked;                 ///< the command, for pages
  bool json = false;
  bool csv = false;
  bool quiet = false;
};

struct ExplainOptions {
  std::string code;  ///< empty: list all
  bool csv = false;
  bool json = false;
  bool quiet = false;
};

/// Text that was asked for instead of work: help or version.
struct ShowText {
  std::string text;
};

/// What follows `obvid studio`: a program of its own understands it.
struct StudioOptions {
  std::vector<std::string> arguments;
};

/// What follows `obvid batch`, likewise.
struct BatchOptions {
  std::vector<std::string> arguments;
};

/// What was asked for: runs it and returns the exit code.
using Command = std::function<int()>;

/// Understands the command line. Errors: E201 wrong usage, E203 option not possible.
[[nodiscard]] Result<Command> parse_command_line(int argc, const char* const* argv);

/// The same for what follows `obvid`: surface KIND ..., toolpath ...
[[nodiscard]] Result<Command> parse_surface(int argc, const char* const* argv);
[[nodiscard]] Result<Command> parse_spline(int argc, const char* const* argv);
[[nodiscard]] Result<Command> parse_alignment(int argc, const char* const* argv);
[[nodiscard]] Result<Command> parse_nurbs(int argc, const char* const* argv);
[[nodiscard]] Result<Command> parse_toolpath(int argc, const char* const* argv);
[[nodiscard]] Result<Command> parse_cut(int argc, const char* const* argv);

}  // namespace obvid
