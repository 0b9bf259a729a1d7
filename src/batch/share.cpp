// SPDX-License-Identifier: Apache-2.0
#include "share.h"

#include <cstdlib>
#include <optional>

namespace obvid::batch {
namespace {

std::optional<std::size_t> whole_number(const std::string& text) {
  constexpr std::size_t kMostDigits = 9;
  if (text.empty() || text.size() > kMostDigits ||
      text.find_first_not_of("0123456789") != std::string::npos) {
    return std::nullopt;
  }
  return std::stoul(text);
}

std::optional<std::size_t> number_in_environment(const char* name) {
  const char* const text = std::getenv(name);
  return text == nullptr ? std::nullopt : whole_number(text);
}

Error wrong_share(const std::string& text, const std::string& where) {
  return {ErrorCode::kBadOption, "'" + text + "' is no part of the work", where,
          "write --shard 3/8 for the third part of eight"};
}

}  // namespace

Result<Share> share_of(const std::string& text) {
  if (!text.empty()) {
    const std::size_t slash = text.find('/');
    const auto part = whole_number(text.substr(0, slash));
    const auto parts =
        slash == std::string::npos ? std::nullopt : whole_number(text.substr(slash + 1));
    if (!part || !parts || *part < 1 || *part > *parts) return fail(wrong_share(text, "--shard"));
    return Share{{*part - 1, *parts}, "--shard"};
  }
  if (const auto task = number_in_environment("SLURM_ARRAY_TASK_ID")) {
    const std::size_t first = number_in_environment("SLURM_ARRAY_TASK_MIN").value_or(0);
    const std::size_t last = number_in_environment("SLURM_ARRAY_TASK_MAX").value_or(*task);
    const std::size_t step = number_in_environment("SLURM_ARRAY_TASK_STEP").value_or(1);
    if (step == 0 || *task < first || *task > last) {
      return fail(wrong_share(std::to_string(*task), "SLURM_ARRAY_TASK_ID"));
    }
    return Share{{(*task - first) / step, (last - first) / step + 1}, "SLURM_ARRAY_TASK_ID"};
  }
  const auto rank = number_in_environment("OMPI_COMM_WORLD_RANK");
  const auto size = number_in_environment("OMPI_COMM_WORLD_SIZE");
  if (rank && size && *rank < *size) return Share{{*rank, *size}, "OMPI_COMM_WORLD_RANK"};
  return Share{};
}

}  // namespace obvid::batch
