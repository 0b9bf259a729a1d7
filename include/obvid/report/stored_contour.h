// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>
#include <string>
#include <vector>

#include "obvid/alignment/profile.h"
#include "obvid/alignment/transition.h"
#include "obvid/certify/certificate.h"
#include "obvid/curve/contour.h"
#include "obvid/report/fit_report.h"

namespace obvid {

/// What the file of an alignment says beside its curve.
struct StoredAlignment {
  double first_station = 0.0;                   ///< of the start, units of the contour
  std::vector<PlacedTransition> transitions{};  ///< what clothoids stand for, in order
  std::optional<VerticalProfile> profile{};     ///< of heights, stations as from there
};

/// A stored contour with the claims that stand beside it in the file.
struct StoredContour {
  Contour contour;
  std::optional<FitReport> report;
  std::optional<Certificate> certificate;
  std::string name{};                          ///< of the curve; empty: none
  std::optional<StoredAlignment> alignment{};  ///< of curves that are one
  std::vector<std::string> unread{};  ///< fields of the file that mean nothing to this program,
                                      ///< each once: "/pieces/*/colour"
};

}  // namespace obvid
