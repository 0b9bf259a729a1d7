// SPDX-License-Identifier: Apache-2.0
#include "sheet.h"

#include <fmt/format.h>

#include <utility>

namespace judge {

std::string shown(long double value) { return fmt::format("{:.12g}", value); }

void Sheet::fails(const std::string& claim, std::string stated, std::string found,
                  std::string where) {
  Counts& counts = counts_[claim];
  ++counts.judged;
  ++counts.wrong;
  findings_.push_back(
      {Finding::Kind::kFalse, claim, std::move(stated), std::move(found), std::move(where)});
}

void Sheet::unjudged(const std::string& claim, std::string why, std::string where) {
  ++counts_[claim].unjudged;
  findings_.push_back({Finding::Kind::kUnjudged, claim, "", std::move(why), std::move(where)});
}

void Sheet::missing(const std::string& claim, std::string where) {
  ++counts_[claim].missing;
  findings_.push_back({Finding::Kind::kMissing, claim, "", "", std::move(where)});
}

bool Sheet::expect(bool ok, const std::string& claim, long double stated, long double found,
                   const std::string& where) {
  if (ok) {
    holds(claim);
  } else {
    fails(claim, shown(stated), shown(found), where);
  }
  return ok;
}

bool Sheet::expect(bool ok, const std::string& claim, const std::string& stated,
                   const std::string& found, const std::string& where) {
  if (ok) {
    holds(claim);
  } else {
    fails(claim, stated, found, where);
  }
  return ok;
}

long Sheet::wrong() const {
  long sum = 0;
  for (const auto& [claim, counts] : counts_) sum += counts.wrong;
  return sum;
}

bool Sheet::has(const std::string& claim) const {
  const auto found = counts_.find(claim);
  return found != counts_.end() && found->second.wrong > 0;
}

void Sheet::add(const Sheet& other) {
  for (const auto& [claim, counts] : other.counts_) {
    Counts& mine = counts_[claim];
    mine.judged += counts.judged;
    mine.wrong += counts.wrong;
    mine.unjudged += counts.unjudged;
    mine.missing += counts.missing;
  }
  findings_.insert(findings_.end(), other.findings_.begin(), other.findings_.end());
}

}  // namespace judge
