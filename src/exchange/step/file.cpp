// SPDX-License-Identifier: Apache-2.0
#include "step/file.h"

#include <fmt/format.h>

#include <algorithm>

#include "obvid/core/version.h"
#include "obvid/exchange/internal/step/letters.h"

namespace obvid::exchange {

std::string step_value(double value) {
  std::string out = fmt::format("{}", value == 0.0 ? 0.0 : value);  // no -0
  const std::size_t exponent = out.find('e');
  if (exponent != std::string::npos) out[exponent] = 'E';
  if (out.find('.') == std::string::npos) out.insert(std::min(exponent, out.size()), 1, '.');
  return out;
}

std::string step_value(int value) { return std::to_string(value); }
std::string step_value(StepId id) { return fmt::format("#{}", id.number); }

std::string step_string(std::string_view text) {
  std::string doubled;
  for (const char c : on_one_line(std::string(text))) {
    if (c == '\'' || c == '\\') doubled += c;
    doubled += c;
  }
  return "'" + in_step_letters(doubled) + "'";
}

StepId StepFile::add(std::string_view record) {
  constexpr std::size_t kLine = 100;  // columns: for people; the standard has no limit
  const std::string whole = fmt::format("#{}={};\n", ++count_, record);
  std::size_t begin = 0, last = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (whole[i] == '\'') quoted = !quoted;
    if (i - begin >= kLine && last > begin) {
      data_.append(whole, begin, last - begin).append("\n");
      begin = last;
    }
    if (whole[i] == ',' && !quoted) last = i + 1;
  }
  data_.append(whole, begin);
  return {count_};
}

std::string StepFile::text(std::string_view name, std::string_view schema) const {
  // a date would make the same contour another file every time
  return fmt::format(
      "ISO-10303-21;\n"
      "HEADER;\n"
      "FILE_DESCRIPTION((''),'2;1');\n"
      "FILE_NAME({},'1970-01-01T00:00:00',(''),(''),'Obvid {}','Obvid','');\n"
      "FILE_SCHEMA(('{}'));\n"
      "ENDSEC;\n"
      "DATA;\n"
      "{}"
      "ENDSEC;\n"
      "END-ISO-10303-21;\n",
      step_string(name), kVersion, schema, data_);
}

}  // namespace obvid::exchange
