// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <optional>
#include <string>
#include <vector>

#include "obvid/certify/certificate.h"
#include "obvid/curve/contour.h"
#include "obvid/report/fit_report.h"

namespace obvid {

/// A stored contour with the claims that stand beside it in the file.
struct StoredContour {
  Contour contour;
  std::optional<FitReport> report;
  std::optional<Certificate> certificate;
  std::vector<std::string> unread{};  ///< fields of the file that mean nothing to this program,
                                      ///< each once: "/pieces/*/colour"
};

}  // namespace obvid
