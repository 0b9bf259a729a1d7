// SPDX-License-Identifier: Apache-2.0
// Sentences of reports: their words with the figures taken out, so that each shape can be judged.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace judge {

struct Sentence {
  std::string shape;                 ///< figures are "#", the unit "U", plurals singular
  std::vector<std::string> figures;  ///< as printed; "-" where nothing is known

  [[nodiscard]] double number(std::size_t i) const;
};
Sentence sentence_of(const std::string& text, const std::string& unit);

/// A line `label  value` of a list of facts.
struct Fact {
  std::string label, value;
};
std::optional<Fact> fact_of(const std::string& line);

std::vector<std::string> lines_of(const std::string& text);
/// What a report says of a file that was written.
std::vector<std::string> notes_of(const std::string& report, const std::string& file);
std::vector<std::string> split(const std::string& text, const std::string& by);
std::vector<std::string> words_of(const std::string& text);

/// Whether a printed figure is this value to the digits shown (bounds may be rounded up).
bool prints(const std::string& printed, std::optional<double> value);
/// The same of what stands behind "at most" and "within": never rounded down.
bool bounds(const std::string& printed, std::optional<double> value);

}  // namespace judge
