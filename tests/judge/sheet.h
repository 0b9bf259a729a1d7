// SPDX-License-Identifier: Apache-2.0
// What the judge has found: per claim how often it held, and each sentence that did not.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace judge {

struct Counts {
  long judged = 0, wrong = 0, unjudged = 0, missing = 0;
};

struct Finding {
  enum class Kind { kFalse, kUnjudged, kMissing };
  Kind kind = Kind::kFalse;
  std::string claim, stated, found, where;
};

/// Text of a figure in findings.
std::string shown(long double value);

class Sheet {
 public:
  void holds(const std::string& claim) { ++counts_[claim].judged; }
  void fails(const std::string& claim, std::string stated, std::string found, std::string where);
  /// Nothing was decided; `why` says what stands in the way.
  void unjudged(const std::string& claim, std::string why, std::string where = "");
  void missing(const std::string& claim, std::string where = "");
  /// Holds or fails; texts are made from the figures.
  bool expect(bool ok, const std::string& claim, long double stated, long double found,
              const std::string& where);
  bool expect(bool ok, const std::string& claim, const std::string& stated,
              const std::string& found, const std::string& where);

  [[nodiscard]] const std::map<std::string, Counts>& counts() const { return counts_; }
  [[nodiscard]] const std::vector<Finding>& findings() const { return findings_; }
  [[nodiscard]] long wrong() const;
  [[nodiscard]] bool has(const std::string& claim) const;  ///< a false sentence of this claim
  void add(const Sheet& other);

 private:
  std::map<std::string, Counts> counts_;
  std::vector<Finding> findings_;
};

}  // namespace judge
