// SPDX-License-Identifier: Apache-2.0
#include "merge.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "hdf5_file.h"
#include "index.h"
#include "obvid/core/files.h"

namespace obvid::batch {
namespace {

constexpr const char* kSeconds = "seconds";

/// Columns whose rows are the same whenever and wherever they were made, and those that are not.
std::pair<Columns, Columns> split(Columns rows) {
  std::pair<Columns, Columns> out;
  for (Column& column : rows.all) {
    (column.name == kSeconds ? out.second : out.first).all.push_back(std::move(column));
  }
  return out;
}

std::vector<std::size_t> widest(std::vector<std::size_t> a, const std::vector<std::size_t>& b) {
  if (a.empty()) return b;
  for (std::size_t k = 0; k < a.size(); ++k) a[k] = std::max(a[k], b[k]);
  return a;
}

Error some_missing(const std::vector<std::size_t>& missing, const Store& store) {
  constexpr std::size_t kNamed = 8;
  std::string which;
  for (std::size_t k = 0; k < std::min(kNamed, missing.size()); ++k) {
    which += (k == 0 ? "" : ", ") + std::to_string(missing[k]);
  }
  if (missing.size() > kNamed) which += ", ...";
  return {ErrorCode::kTooFewPoints,
          std::to_string(missing.size()) + " of " + std::to_string(store.manifest().shards()) +
              " shards are missing: " + which,
          store.path_of(missing.front()), "run the parts that are missing again, then merge"};
}

/// Texts of a file are as wide as the widest of all shards.
Result<std::pair<Columns, std::vector<std::size_t>>> shape_of(const Store& store) {
  Columns like;
  std::vector<std::size_t> widths;
  for (std::size_t k = 0; k < store.manifest().shards(); ++k) {
    auto rows = store.get(k);
    OBVID_TRY(rows);
    widths = widest(std::move(widths), split(*rows).first.widths());
    like = rows->empty();
  }
  return std::pair(std::move(like), std::move(widths));
}

Result<void> about(TableWriter& table, const Manifest& m) {
  // not the sources: the same points elsewhere have the same table
  for (const auto& [name, value] : {std::pair<std::string, std::string>{"format", "obvid-batch"},
                                    {"program", m.program},
                                    {"job", m.job},
                                    {"options", m.options}}) {
    if (auto done = table.attribute(name, value); !done) return done;
  }
  return {};
}

Result<Summary> merge_whole(const Names& names, Store& store) {
  const Manifest& m = store.manifest();
  const auto shape = shape_of(store);
  OBVID_TRY(shape);
  const auto [kept, timed] = split(shape->first);
  auto table = TableWriter::create(names.table, kept, shape->second, m.items);
  OBVID_TRY(table);
  auto seconds = TableWriter::create(names.seconds, timed, timed.widths(), m.items);
  OBVID_TRY(seconds);
  auto index = IndexWriter::create(names.index, shape->first, manifest_text(m));
  OBVID_TRY(index);
  OBVID_TRY(about(*table, m));
  Summary summary;
  for (std::size_t k = 0; k < m.shards(); ++k) {
    auto rows = store.get(k);
    OBVID_TRY(rows);
    summary.add(*rows);
    auto parts = split(*rows);
    auto done =
        index->append(*rows).and_then([&] { return table->append(parts.first); }).and_then([&] {
          return seconds->append(parts.second);
        });
    OBVID_TRY(done);
  }
  auto done = index->finish()
                  .and_then([&] { return seconds->finish(); })
                  .and_then([&] { return write_file(names.picture, histogram_svg(summary)); })
                  .and_then([&] { return table->finish(); });
  OBVID_TRY(done);
  summary.twice = index->twice();
  return summary;
}

}  // namespace

Result<Summary> merge(const Names& names, Store& store) {
  const auto missing = store.missing();
  if (!missing.empty()) return fail(some_missing(missing, store));
  auto out = merge_whole(names, store);
  if (out) store.remove();
  return out;
}

bool is_complete(const Names& names, const Manifest& manifest) {
  std::error_code error;
  if (!std::filesystem::exists(names.table, error)) return false;
  if (std::filesystem::exists(names.folder + "/batch.json", error)) return false;
  return manifest_in_index(names.index) == manifest_text(manifest);
}

Result<Summary> summary_of(const Names& names) {
  auto table = read_table(names.table);
  OBVID_TRY(table);
  auto seconds = read_table(names.seconds);
  OBVID_TRY(seconds);
  for (Column& column : seconds->all) table->all.push_back(std::move(column));
  Summary out;
  out.add(*table);
  return out;
}

}  // namespace obvid::batch
