// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>

#include "engine.h"

extern "C" {

/// The answer to a request (apps/studio/engine.h), a text that the caller frees with `free`; null
/// when memory ran out.
[[gnu::used]] char* obvid_web_answer(const char* kind, const char* request) {
  try {
    const std::string text = obvid::studio::answer(kind, request, nullptr);
    auto* const out = static_cast<char*>(std::malloc(text.size() + 1));
    if (out != nullptr) std::memcpy(out, text.c_str(), text.size() + 1);
    return out;
  } catch (const std::exception&) {
    return nullptr;
  }
}
}
