// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "columns.h"
#include "obvid/core/result.h"

struct sqlite3;
struct sqlite3_stmt;

namespace obvid::batch {

struct CloseSqlite {
  void operator()(sqlite3* base) const;
  void operator()(sqlite3_stmt* statement) const;
};

/// All columns as the table `items` of an SQLite file, with the place of each item in the HDF5 file
/// as `number`; what is not known is NULL. Written whole or not at all.
class IndexWriter {
 public:
  /// `manifest`: kept in the table `batch`. Error: E102.
  static Result<IndexWriter> create(const std::string& path, const Columns& like,
                                    const std::string& manifest);
  Result<void> append(const Columns& rows);
  /// Makes the indices and gives the file its name.
  Result<void> finish();
  /// An id that several items have; empty: none. After `finish`.
  [[nodiscard]] const std::string& twice() const { return twice_; }

  IndexWriter(IndexWriter&& other) noexcept;
  IndexWriter(const IndexWriter&) = delete;
  IndexWriter& operator=(const IndexWriter&) = delete;
  ~IndexWriter();

 private:
  IndexWriter() = default;
  [[nodiscard]] bool run(const std::string& sql);
  [[nodiscard]] Error failed() const;

  std::string path_, temporary_, twice_;
  std::unique_ptr<sqlite3, CloseSqlite> base_;
  std::unique_ptr<sqlite3_stmt, CloseSqlite> insert_;
  std::size_t rows_ = 0;
};

/// Empty where there is none.
[[nodiscard]] std::string manifest_in_index(const std::string& path);

struct Query {
  std::string where;                 ///< of SQL: "vertices > bound"; empty: all
  std::vector<std::string> columns;  ///< empty: number, id, status, code, vertices, bound, ...
  std::string order;                 ///< of SQL: "vertices - bound DESC"; empty: by number
  std::size_t most = 0;              ///< rows; 0: all
};

/// Names and rows as texts, NULL as "".
struct Answer {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;
};

/// Asks an index, which is not changed by any question. Errors: E301; E203 SQL that is wrong or no
/// single condition.
[[nodiscard]] Result<Answer> ask_index(const std::string& path, const Query& query);

}  // namespace obvid::batch
