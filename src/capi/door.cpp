// SPDX-License-Identifier: Apache-2.0
#include "door.h"

#include <cctype>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <memory>

namespace obvid::capi {
namespace {

/// Callers are asked at most this often: callbacks of other languages cost microseconds.
constexpr std::chrono::milliseconds kBetweenQuestions{5};

/// An error with the texts that it points to.
struct OwnedError : obvid_error {
  std::string message_text, where_text, advice_text;
  std::vector<std::size_t> indices;
};

/// Options as the command line spells them, as they are named in JSON: "--noise" is "noise".
std::string in_names_of_options(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins = i == 0 || std::strchr(" `'(", text[i - 1]) != nullptr;
    if (begins && text.compare(i, 2, "--") == 0 && i + 2 < text.size() &&
        std::islower(static_cast<unsigned char>(text[i + 2])) != 0) {
      ++i;
      continue;
    }
    out += text[i];
  }
  return out;
}

}  // namespace

char* text_of(const std::string& text) {
  auto* const out = static_cast<char*>(std::malloc(text.size() + 1));
  if (out == nullptr) throw std::bad_alloc();
  std::memcpy(out, text.c_str(), text.size() + 1);
  return out;
}

int hand_out(const Error& error, obvid_error** out, std::vector<std::size_t> points) {
  const int code = static_cast<int>(error.code);
  if (out == nullptr) return code;
  auto owned = std::make_unique<OwnedError>();
  owned->message_text = in_names_of_options(error.what);
  owned->where_text = in_names_of_options(error.where);
  owned->advice_text = in_names_of_options(error.hint);
  owned->indices = std::move(points);
  if (owned->indices.empty() && error.index >= 0) {
    owned->indices.push_back(static_cast<std::size_t>(error.index));
  }
  owned->code = code;
  owned->category = static_cast<obvid_category>(category(error.code));
  owned->message = owned->message_text.c_str();
  owned->where = owned->where_text.c_str();
  owned->advice = owned->advice_text.c_str();
  owned->points = owned->indices.empty() ? nullptr : owned->indices.data();
  owned->point_count = owned->indices.size();
  *out = owned.release();
  return code;
}

RunContext context_of(const obvid_run* run) {
  RunContext out;
  if (run == nullptr) return out;
  out.threads = run->threads;
  if (run->progress != nullptr) {
    out.progress = [run = *run](std::string_view stage, double fraction) {
      run.progress(run.user, std::string(stage).c_str(), fraction);
    };
  }
  if (run->cancelled != nullptr) {
    using Clock = std::chrono::steady_clock;
    out.cancelled = [run = *run, next = Clock::time_point::min()]() mutable {
      const auto now = Clock::now();
      if (now < next) return false;
      next = now + kBetweenQuestions;
      return run.cancelled(run.user) != 0;
    };
  }
  return out;
}

}  // namespace obvid::capi

extern "C" {

void obvid_error_free(obvid_error* error) { delete static_cast<obvid::capi::OwnedError*>(error); }

void obvid_free(char* text) { std::free(text); }
}
