// SPDX-License-Identifier: Apache-2.0
#include "work.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "obvid/core/internal/parallel.h"

namespace obvid::batch {
namespace {

/// Items that a thread takes at once: few enough to share a short batch, enough to read arrays in
/// stretches.
constexpr std::size_t kBlock = 16;

/// Some items of one shard.
struct Block {
  std::size_t shard = 0;
  std::size_t number = 0;  ///< within the shard
  std::size_t first = 0, count = 0;
};

/// A shard at work: its blocks as they are done.
struct OpenShard {
  std::vector<Columns> blocks;
  std::size_t left = 0;
};

/// Hands out blocks, shard after shard, and puts shards together again.
class Desk {
 public:
  Desk(const Store& store, std::vector<std::size_t> shards)
      : store_(store), shards_(std::move(shards)) {}

  std::optional<Block> next() {
    const std::scoped_lock lock(mutex_);
    if (error_ || at_ >= shards_.size()) return std::nullopt;
    const std::size_t shard = shards_[at_];
    const std::size_t size = store_.manifest().size_of_shard(shard);
    const std::size_t blocks = (size - 1) / kBlock + 1;
    if (block_ == 0) open_[shard] = {std::vector<Columns>(blocks), blocks};
    Block out{shard, block_, store_.manifest().begin_of(shard) + block_ * kBlock, 0};
    out.count = std::min(kBlock, size - block_ * kBlock);
    if (++block_ == blocks) {
      block_ = 0;
      ++at_;
    }
    return out;
  }

  /// The rows of the whole shard when this was its last block.
  std::optional<Columns> done(const Block& block, Columns rows) {
    std::vector<Columns> blocks;
    {
      const std::scoped_lock lock(mutex_);
      OpenShard& shard = open_[block.shard];
      shard.blocks[block.number] = std::move(rows);
      if (--shard.left > 0) return std::nullopt;
      blocks = std::move(shard.blocks);
      open_.erase(block.shard);
    }
    Columns whole = std::move(blocks.front());
    for (std::size_t k = 1; k < blocks.size(); ++k) whole.append(blocks[k]);
    return whole;
  }

  void stop(const Error& error) {
    const std::scoped_lock lock(mutex_);
    if (!error_) error_ = error;
  }
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  const Store& store_;
  std::vector<std::size_t> shards_;
  std::size_t at_ = 0, block_ = 0;
  std::map<std::size_t, OpenShard> open_;
  std::optional<Error> error_;
  std::mutex mutex_;
};

/// The rows of a block; nothing when it was stopped.
Result<std::optional<Columns>> rows_of(const Block& block, const Source& source, const Job& job,
                                       Pace& pace, const std::function<bool()>& stopped) {
  const auto items = source.load(block.first, block.count);
  OBVID_TRY(items);
  Columns rows = job.columns();
  for (std::size_t i = 0; i < items->size(); ++i) {
    const auto done = job.run((*items)[i], block.first + i, rows, stopped);
    OBVID_TRY(done);
    if (!*done) return std::optional<Columns>();
    ++pace.done;
    const Column& status = rows.all[1];
    if (status.numbers.back() == static_cast<double>(Status::kFailed)) ++pace.failed;
  }
  return std::optional(std::move(rows));
}

void take_blocks(Desk& desk, const Source& source, const Job& job, const Store& store, Pace& pace,
                 const std::function<bool()>& stopped) {
  while (const auto block = desk.next()) {
    auto rows = rows_of(*block, source, job, pace, stopped);
    if (!rows) return desk.stop(rows.error());
    if (!*rows) {
      return desk.stop({ErrorCode::kCancelled, "the batch was stopped", "",
                        "the same command goes on where it was"});
    }
    if (const auto whole = desk.done(*block, std::move(**rows))) {
      const auto put = store.put(block->shard, *whole);
      if (!put) return desk.stop(put.error());
    }
  }
}

}  // namespace

Result<void> work(const Source& source, const Job& job, const Store& store, const Part& part,
                  std::size_t threads, Pace& pace, const std::function<bool()>& stopped) {
  std::vector<std::size_t> mine;
  for (const std::size_t shard : store.missing()) {
    if (shard % part.parts != part.part) continue;
    mine.push_back(shard);
    pace.items += store.manifest().size_of_shard(shard);
  }
  if (threads == 0) threads = processors();
  Desk desk(store, std::move(mine));
  in_parallel(threads, threads,
              [&](std::size_t) { take_blocks(desk, source, job, store, pace, stopped); });
  if (desk.error()) return fail(*desk.error());
  return {};
}

}  // namespace obvid::batch
