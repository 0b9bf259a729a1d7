// SPDX-License-Identifier: Apache-2.0
#include "terminal.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace obvid {
namespace {

constexpr double kFirstDraw_s = 0.5;
constexpr double kRedraw_s = 0.1;
constexpr int kBarWidth = 30;

double now_s() {
  using Clock = std::chrono::steady_clock;
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

bool colours(int descriptor) {
  const char* no_color = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  const bool refused = no_color != nullptr && *no_color != '\0';
  return !refused && term != nullptr && std::strcmp(term, "dumb") != 0 &&
         isatty(descriptor) == 1;
}

std::string painted(std::string_view text, const char* code) {
  if (!colours(STDOUT_FILENO)) return std::string(text);
  return fmt::format("\033[{}m{}\033[0m", code, text);
}

}  // namespace

std::string good(std::string_view text) { return painted(text, "32"); }
std::string bad(std::string_view text) { return painted(text, "31"); }
std::string bold(std::string_view text) { return painted(text, "1"); }

Result<void> put(std::string_view text) {
  const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (whole && std::fflush(stdout) == 0) return {};
  return fail({ErrorCode::kWriteFailed, fmt::format("cannot write: {}", std::strerror(errno)),
               "standard output", ""});
}

int report(const Error& error) {
  const std::string line = to_line(error) + "\n";
  std::fputs(line.c_str(), stderr);
  return exit_code(error.code);
}

void warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    std::string line = "obvid: warning: " + warning;
    std::replace(line.begin(), line.end(), '\n', ' ');
    std::fputs((line + "\n").c_str(), stderr);
  }
}

ProgressBar::ProgressBar(bool wanted) : wanted_(wanted && isatty(STDERR_FILENO) == 1) {
  next_s_ = now_s() + kFirstDraw_s;
}

ProgressBar::~ProgressBar() { clear(); }

Progress ProgressBar::progress() {
  if (!wanted_) return {};
  return [this](std::string_view stage, double fraction) { draw(stage, fraction); };
}

void ProgressBar::draw(std::string_view stage, double fraction) {
  const double now = now_s();
  if (now < next_s_) return;
  next_s_ = now + kRedraw_s;
  drawn_ = true;
  const double part = std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0.0;
  const auto full = static_cast<std::size_t>(std::lround(part * kBarWidth));
  const std::string line =
      fmt::format("\r\033[K{:<12} [{}{}] {:3.0f} %", stage, std::string(full, '#'),
                  std::string(kBarWidth - full, '.'), 100.0 * part);
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

void ProgressBar::clear() {
  if (drawn_) std::fputs("\r\033[K", stderr);
  drawn_ = false;
}

}  // namespace obvid
