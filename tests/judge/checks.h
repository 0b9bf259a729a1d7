// SPDX-License-Identifier: Apache-2.0
// One function per group of claims; docs/methods/judge.md says how each is judged.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "course.h"
#include "input.h"
#include "sheet.h"

namespace judge {

// measures that several checks need
/// Whom rounding of the coordinates helps: who claims that something holds, or who doubts it.
enum class Doubt { kHelpsTheClaim, kHindersTheClaim };
/// What is wrong with how the points are met; empty: nothing.
std::string missed_point(const Course& course, Doubt doubt = Doubt::kHelpsTheClaim);
/// Runs that do not cover the pieces in order, or that pieces or jumps go against.
struct RunFault {
  std::string stated, found, where;
};
/// `monotone`: of contours that claim no proof too.
std::optional<RunFault> run_fault(const Course& course, bool monotone);
/// How far the contour between two orders leaves the region of its elements there.
Real outside_region(const Course& course, Real a, Real b);
struct ElementGap {
  double position = 0.0, heading = 0.0, curvature = 0.0;
  std::size_t at = 0;
};
ElementGap worst_element_gap(const Course& course);
std::optional<int> count_crossings(const Course& course);

void check_form(const Course& course, Sheet& sheet);
void check_certificate(const Course& course, Sheet& sheet);
void check_report(const Course& course, Sheet& sheet);
void check_given_list(const Course& course, Sheet& sheet);
/// All claims of a contour file itself.
void judge_course(const Course& course, Sheet& sheet);
/// Against what the user gave.
void check_input(const Course& course, const Input& input, Sheet& sheet);
/// Both, of a contour of `fit --construction`.
void judge_constructed(const Course& course, Input input, Sheet& sheet);
/// Against the curve that the points were taken from.
void check_truth(const Course& course, const Input& input, Sheet& sheet);

}  // namespace judge
