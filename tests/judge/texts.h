// SPDX-License-Identifier: Apache-2.0
// The printed reports: every sentence that has a figure is compared with the file it speaks of.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "course.h"
#include "drawing.h"
#include "input.h"
#include "sentences.h"
#include "sheet.h"

namespace judge {

/// One run of the program, and what it left.
struct Run {
  std::string command;  ///< "fit", "verify", ...
  int code = 0;
  std::string out, err;
  std::map<std::string, std::string> files;  ///< written, by name
  std::string input_name;
};

/// The table of lines and arcs that several points lie on, row by row.
class LinesAndArcsTable {
 public:
  LinesAndArcsTable(const Course& course, Sheet& sheet) : course_(course), sheet_(sheet) {}
  void header(const std::string& line);
  void row(const std::vector<std::string>& words);
  /// "shown: ... of # lines and arcs".
  void count(const Sentence& shown);
  void end();

 private:
  [[nodiscard]] std::size_t in_all() const;

  const Course& course_;
  Sheet& sheet_;
  std::string head_;
  std::size_t rows_ = 0;
  bool whole_ = true;
};

void check_fit_text(const Course& course, const Run& run, Sheet& sheet);
/// `fit --json` against the file.
void check_fit_json(const Course& course, const Run& run, Sheet& sheet);
/// `fit_code`: what `fit` ended with when it wrote the file; -1: not known.
void check_verify_text(const Course& course, const Run& run, Sheet& sheet, int fit_code = -1);
/// The exit code against the file; without a file the texts of a refusal.
/// Points that messages name, counted from 1, are points of the series.
void check_named_points(const Run& run, std::size_t points, Sheet& sheet);
void check_exit(const Course* course, const Run& run, Sheet& sheet);
/// What a refusal says of the contour that it advises, against that contour: counts, and the table
/// of the points that would have to move.
void check_advised(const Run& refused, const ContourFile& advised, Sheet& sheet);
/// Files of other formats against the contour; `note` is what the report says of the file.
void check_export(const Course& course, const std::string& file, const std::string& text,
                  const std::vector<std::string>& notes, Sheet& sheet);

/// The page of a report (`-o .html`): its tables, its verdict, the texts of its picture.
void check_page(const Course& course, const std::string& page, Sheet& sheet);

void check_analyse(const Input& input, const Run& json, const Run& text, Sheet& sheet);
/// `compare --json` and its table; `fits` are contours that `fit --carrier` made.
void check_compare(const Run& json, const Run& text, const Course& fit, Sheet& sheet);

}  // namespace judge
