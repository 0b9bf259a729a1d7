// SPDX-License-Identifier: Apache-2.0
#include "sentences.h"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <sstream>

namespace judge {
namespace {

bool letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool digit(char c) { return c >= '0' && c <= '9'; }

/// End of the number that begins at i, or i.
std::size_t number_end(const std::string& s, std::size_t i) {
  std::size_t p = i;
  if (p < s.size() && s[p] == '-') ++p;
  if (s.compare(p, 3, "inf") == 0 && (p + 3 == s.size() || !letter(s[p + 3]))) return p + 3;
  if (p >= s.size() || !digit(s[p])) return i;
  while (p < s.size() && digit(s[p])) ++p;
  if (p + 1 < s.size() && s[p] == '.' && digit(s[p + 1])) {
    ++p;
    while (p < s.size() && digit(s[p])) ++p;
  }
  if (p + 1 < s.size() && s[p] == 'e') {
    std::size_t q = p + 1;
    if (s[q] == '+' || s[q] == '-') ++q;
    if (q < s.size() && digit(s[q])) {
      while (q < s.size() && digit(s[q])) ++q;
      p = q;
    }
  }
  return p < s.size() && letter(s[p]) ? i : p;
}

const std::string& singular(const std::string& word) {
  static const std::map<std::string, std::string> kForms = {
      {"pieces", "piece"},         {"points", "point"},     {"runs", "run"},
      {"joints", "joint"},         {"vertices", "vertex"},  {"inflections", "inflection"},
      {"elements", "element"},     {"blocks", "block"},     {"entities", "entity"},
      {"segments", "segment"},     {"headings", "heading"}, {"radii", "radius"},
      {"curvatures", "curvature"}, {"corners", "corner"},   {"chords", "chord"}};
  const auto found = kForms.find(word);
  return found == kForms.end() ? word : found->second;
}

}  // namespace

double Sentence::number(std::size_t i) const {
  return i < figures.size() ? std::strtod(figures[i].c_str(), nullptr)
                            : std::numeric_limits<double>::quiet_NaN();
}

Sentence sentence_of(const std::string& text, const std::string& unit) {
  Sentence out;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i], before = i == 0 ? ' ' : text[i - 1];
    const bool fresh =
        before == ' ' || before == '(' || before == '[' || before == '=' || before == ',';
    const bool alone =
        c == '-' && fresh &&
        (i + 1 == text.size() || text[i + 1] == ' ' || text[i + 1] == ';' || text[i + 1] == ',');
    std::size_t end = i;
    if (alone) {
      end = i + 1;
    } else if (fresh || (digit(c) && before == '-')) {
      end = number_end(text, i);
    } else if (digit(c) && before == '.') {
      end = number_end(text, i);
    }
    if (end > i) {
      out.figures.push_back(text.substr(i, end - i));
      out.shape += '#';
      i = end;
    } else if (letter(c)) {
      end = i;
      while (end < text.size() && (letter(text[end]) || digit(text[end]))) ++end;
      const std::string word = text.substr(i, end - i);
      const bool is_unit = word == unit && out.shape.ends_with("# ");
      out.shape += is_unit ? "U" : singular(word);
      i = end;
    } else {
      if (c != ' ' || !out.shape.ends_with(' ')) out.shape += c;
      ++i;
    }
  }
  return out;
}

std::optional<Fact> fact_of(const std::string& line) {
  if (line.empty() || line[0] == ' ') return std::nullopt;
  const std::size_t gap = line.find("  ");
  if (gap == std::string::npos) return std::nullopt;
  const std::size_t value = line.find_first_not_of(' ', gap);
  if (value == std::string::npos) return std::nullopt;
  return Fact{line.substr(0, gap), line.substr(value)};
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

std::vector<std::string> notes_of(const std::string& report, const std::string& file) {
  std::vector<std::string> notes;
  for (const std::string& line : lines_of(report)) {
    std::string value = line;
    if (const auto fact = fact_of(line); fact && fact->label == "note") value = fact->value;
    if (value.starts_with(file + ": ")) notes.push_back(value.substr(file.size() + 2));
  }
  return notes;
}

std::vector<std::string> split(const std::string& text, const std::string& by) {
  std::vector<std::string> out;
  std::size_t from = 0;
  for (std::size_t to = text.find(by); to != std::string::npos; to = text.find(by, from)) {
    out.push_back(text.substr(from, to - from));
    from = to + by.size();
  }
  out.push_back(text.substr(from));
  return out;
}

std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string word; in >> word;) out.push_back(word);
  return out;
}

bool prints(const std::string& printed, std::optional<double> value) {
  if (printed == "-") return !value;
  if (!value) return false;
  if (printed == "inf" || printed == "-inf") return std::isinf(*value);
  const double number = std::strtod(printed.c_str(), nullptr);
  const std::size_t e = printed.find('e'), dot = printed.find('.');
  const std::string mantissa = printed.substr(0, e);
  const double decimals =
      dot == std::string::npos ? 0.0 : static_cast<double>(mantissa.size() - dot - 1);
  const double exponent = e == std::string::npos ? 0.0 : std::atof(printed.c_str() + e + 1);
  if (number == 0.0 && decimals == 0.0) return *value == 0.0;  // a bare 0 is exactly that
  const bool whole = dot == std::string::npos && e == std::string::npos;
  if (whole && *value == std::round(*value)) return number == *value;  // counts are not rounded
  const double step = std::pow(10.0, exponent - decimals);
  const double off = std::abs(number) - std::abs(*value);
  const bool same_side = number == 0.0 || (number > 0.0) == (*value > 0.0);
  // a tie of decimals may fall on either side; both numbers are rounded to doubles here
  const double own_rounding = 1e-6 * step + 0x1p-52 * std::abs(*value);
  return same_side && off >= -0.5 * step - own_rounding && off <= step + own_rounding;
}

bool bounds(const std::string& printed, std::optional<double> value) {
  if (!prints(printed, value) || !value) return false;
  constexpr double kBoundDigits = 1e-12;
  return std::strtod(printed.c_str(), nullptr) >= *value * (1.0 - kBoundDigits);
}

}  // namespace judge
