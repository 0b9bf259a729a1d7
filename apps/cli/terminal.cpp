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

constexpr std::chrono::milliseconds kFirstDraw{500};
constexpr std::chrono::milliseconds kRedraw{100};
constexpr int kBarWidth = 30;

void draw_bar(const std::string& stage, double part) {
  const auto full = static_cast<std::size_t>(std::lround(part * kBarWidth));
  const std::string line = fmt::format("\r\033[K[{}{}] {:3.0f} %  {}", std::string(full, '#'),
                                       std::string(kBarWidth - full, '.'), 100.0 * part, stage);
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

bool colours(int descriptor) {
  const char* no_color = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  const bool refused = no_color != nullptr && *no_color != '\0';
  return !refused && term != nullptr && std::strcmp(term, "dumb") != 0 && isatty(descriptor) == 1;
}

std::string painted(std::string_view text, const char* code, int descriptor = STDOUT_FILENO) {
  if (!colours(descriptor)) return std::string(text);
  return fmt::format("\033[{}m{}\033[0m", code, text);
}

}  // namespace

std::string good(std::string_view text) { return painted(text, "32"); }
std::string bad(std::string_view text) { return painted(text, "31"); }
std::string bold(std::string_view text) { return painted(text, "1"); }

Result<void> put(std::string_view text) {
  const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if (whole && std::fflush(stdout) == 0) return {};
  return error(ErrorCode::kWriteFailed, fmt::format("cannot write: {}", std::strerror(errno)))
      .where("standard output");
}

int report(const Error& error) {
  const std::string line = to_line(error) + "\n";
  // "obvid: error E401:" is what the eye looks for
  const std::size_t head = std::min(line.find(": ", line.find(" error ")), line.size() - 1) + 1;
  const std::string shown = painted(line.substr(0, head), "1;31", STDERR_FILENO);
  std::fputs((shown + line.substr(head)).c_str(), stderr);
  return exit_code(error.code);
}

void warn(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    std::string line = " " + warning;
    std::replace(line.begin(), line.end(), '\n', ' ');
    const std::string head = painted("obvid: warning:", "1;33", STDERR_FILENO);
    std::fputs((head + line + "\n").c_str(), stderr);
  }
}

ProgressBar::ProgressBar(bool wanted) {
  if (wanted && isatty(STDERR_FILENO) == 1) thread_ = std::thread([this] { watch(); });
}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::tell(std::string_view stage, double fraction) {
  if (!thread_.joinable()) return;
  const std::lock_guard lock(mutex_);
  stage_ = stage;
  fraction_ = std::isfinite(fraction) ? std::clamp(fraction, 0.0, 1.0) : 0.0;
}

Progress ProgressBar::progress() {
  if (!thread_.joinable()) return {};
  return [this](std::string_view stage, double fraction) { tell(stage, fraction); };
}

void ProgressBar::watch() {
  std::unique_lock lock(mutex_);
  const auto ended = [this] { return ended_; };
  bool drawn = false;
  for (auto wait = kFirstDraw; !changed_.wait_for(lock, wait, ended); wait = kRedraw) {
    draw_bar(stage_, fraction_);
    drawn = true;
  }
  if (drawn) std::fputs("\r\033[K", stderr);
}

void ProgressBar::clear() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

}  // namespace obvid
