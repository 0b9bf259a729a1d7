// SPDX-License-Identifier: Apache-2.0
#include "surface/align_sections.h"

#include <fmt/format.h>

#include <algorithm>

namespace obvid {
namespace {

constexpr std::size_t kSectionSamples = 16;

/// Points at equal shares of the length of a section's chords, seen from their middle.
std::vector<Vec3> section_samples(const SpaceSeries& section) {
  std::vector<double> at(section.points.size(), 0.0);
  for (std::size_t i = 1; i < at.size(); ++i) {
    at[i] = at[i - 1] + norm(section.points[i] - section.points[i - 1]);
  }
  std::vector<Vec3> samples;
  for (std::size_t k = 0; k <= kSectionSamples; ++k) {
    const double s = at.back() * static_cast<double>(k) / kSectionSamples;
    const auto above = std::upper_bound(at.begin() + 1, at.end() - 1, s);
    const auto i = static_cast<std::size_t>(above - at.begin()) - 1;
    const double chord = at[i + 1] - at[i];
    const double part = chord > 0.0 ? (s - at[i]) / chord : 0.0;
    samples.push_back((1.0 - part) * section.points[i] + part * section.points[i + 1]);
  }
  return samples;
}

Vec3 middle_of(const SpaceSeries& section) {
  Vec3 sum;
  for (const Vec3& p : section.points) sum = sum + p / static_cast<double>(section.points.size());
  return sum;
}

/// Sum of squared distances when the second list is read forwards or backwards, from a place on.
double distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b, Vec3 step, bool backwards,
                std::size_t shift) {
  double sum = 0.0;
  for (std::size_t k = 0; k < kSectionSamples; ++k) {
    const std::size_t there = (k + shift) % kSectionSamples;
    const Vec3 d = b[backwards ? kSectionSamples - there : there] - step - a[k];
    sum += dot(d, d);
  }
  return sum;
}

bool is_closed(const SpaceSeries& section) {
  return section.points.size() > 3 && section.points.front() == section.points.back();
}

void turn_round(SpaceSeries& section) {
  std::reverse(section.points.begin(), section.points.end());
  std::reverse(section.corners.begin(), section.corners.end());
  for (std::size_t& corner : section.corners) corner = section.points.size() - 1 - corner;
}

void align(const SpaceSeries& before, SpaceSeries& here, std::size_t number,
           std::vector<std::string>& warnings) {
  constexpr double kClearly = 0.25;  // of the sum as it is: neither noise nor twist of a blade
  const Vec3 step = middle_of(here) - middle_of(before);
  const std::vector<Vec3> a = section_samples(before), b = section_samples(here);
  const bool closed = is_closed(before) && is_closed(here);
  double best = distance(a, b, step, false, 0), as_given = best;
  bool backwards = false;
  std::size_t shift = 0;
  for (const bool way : {false, true}) {
    for (std::size_t k = 0; k < (closed ? kSectionSamples : 1); ++k) {
      const double sum = distance(a, b, step, way, k);
      if (sum < best * kClearly || (sum < best && best < as_given)) {
        best = sum;
        backwards = way;
        shift = k;
      }
    }
  }
  if (!(best < kClearly * as_given)) return;
  if (backwards) {
    turn_round(here);
    warnings.push_back(fmt::format("section {} ({}) runs against the one before: turned round",
                                   number, here.name));
  }
  if (shift != 0) {
    warnings.push_back(fmt::format(
        "section {} ({}) begins elsewhere than the one before: the surface twists; let all closed "
        "sections begin at the same place",
        number, here.name));
  }
}

}  // namespace

void align_sections(std::vector<SpaceSeries>& sections, std::vector<std::string>& warnings) {
  Vec3 last_step;
  for (std::size_t k = 1; k < sections.size(); ++k) {
    const bool lines = sections[k].points.size() > 1 && sections[k - 1].points.size() > 1;
    if (lines) align(sections[k - 1], sections[k], k + 1, warnings);
    const Vec3 step = middle_of(sections[k]) - middle_of(sections[k - 1]);
    constexpr double kBack = -0.87;  // cosine of 150 degrees
    if (dot(step, last_step) < kBack * norm(step) * norm(last_step)) {
      warnings.push_back(
          fmt::format("section {} ({}) runs backwards along the body: are the sections in order?",
                      k + 1, sections[k].name));
    }
    last_step = step;
  }
}

}  // namespace obvid
