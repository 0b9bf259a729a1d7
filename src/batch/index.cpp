// SPDX-License-Identifier: Apache-2.0
#include "index.h"

#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cmath>
#include <utility>

#include "whole_file.h"

namespace obvid::batch {
namespace {

using Base = std::unique_ptr<sqlite3, CloseSqlite>;
using Statement = std::unique_ptr<sqlite3_stmt, CloseSqlite>;

const char* sql_type(Column::Type type) {
  switch (type) {
    case Column::Type::kText:
      return "TEXT";
    case Column::Type::kNumber:
      return "REAL";
    default:
      return "INTEGER";
  }
}

/// Counts and verdicts below zero are not known; status and code are always known.
bool is_unknown(const Column& column, double value) {
  return column.type == Column::Type::kNumber ? std::isnan(value) : value < 0.0;
}

void bind(sqlite3_stmt* statement, int place, const Column& column, std::size_t row) {
  if (column.type == Column::Type::kText) {
    const std::string& text = column.texts[row];
    sqlite3_bind_text(statement, place, text.data(), static_cast<int>(text.size()),
                      SQLITE_TRANSIENT);
    return;
  }
  const double value = column.numbers[row];
  if (is_unknown(column, value)) {
    sqlite3_bind_null(statement, place);
  } else if (column.type == Column::Type::kNumber) {
    sqlite3_bind_double(statement, place, value);
  } else {
    sqlite3_bind_int64(statement, place, static_cast<sqlite3_int64>(value));
  }
}

std::string text_at(sqlite3_stmt* statement, int column) {
  if (sqlite3_column_type(statement, column) == SQLITE_FLOAT) {
    return fmt::format("{}", sqlite3_column_double(statement, column));  // all digits it has
  }
  const auto* const text = sqlite3_column_text(statement, column);
  if (text == nullptr) return {};
  return {reinterpret_cast<const char*>(text),
          static_cast<std::size_t>(sqlite3_column_bytes(statement, column))};
}

Result<Base> opened(const std::string& path) {
  sqlite3* base = nullptr;
  const int code = sqlite3_open_v2(path.c_str(), &base, SQLITE_OPEN_READONLY, nullptr);
  Base out(base);
  if (code == SQLITE_OK) return out;
  return fail({ErrorCode::kCannotOpen, "cannot read the index of the batch", path,
               "it is made beside the table when a batch ends"});
}

Statement prepared(sqlite3* base, const std::string& sql, bool* whole = nullptr) {
  sqlite3_stmt* statement = nullptr;
  const char* rest = nullptr;
  sqlite3_prepare_v2(base, sql.c_str(), static_cast<int>(sql.size()), &statement, &rest);
  if (whole != nullptr) *whole = rest == sql.c_str() + sql.size();
  return Statement(statement);
}

std::string select_of(const Query& query) {
  std::string columns;
  for (const std::string& one : query.columns) columns += (columns.empty() ? "" : ", ") + one;
  if (columns.empty()) {
    columns =
        "number, id, status, code, vertices, bound, inflections, pieces, proved, error, "
        "seconds, message";
  }
  // in parentheses and on lines of their own, so that a comment or a second condition stays inside
  std::string sql = "SELECT " + columns + " FROM items";
  if (!query.where.empty()) sql += " WHERE (" + query.where + "\n)";
  sql += " ORDER BY " + (query.order.empty() ? std::string("number") : query.order);
  if (query.most > 0) sql += "\nLIMIT " + std::to_string(query.most);
  return sql;
}

}  // namespace

void CloseSqlite::operator()(sqlite3* base) const { sqlite3_close_v2(base); }
void CloseSqlite::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Result<IndexWriter> IndexWriter::create(const std::string& path, const Columns& like,
                                        const std::string& manifest) {
  IndexWriter out;
  out.path_ = path;
  out.temporary_ = temporary_name(path);
  ::unlink(out.temporary_.c_str());
  sqlite3* base = nullptr;
  const int code =
      sqlite3_open_v2(out.temporary_.c_str(), &base,
                      SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX, nullptr);
  out.base_.reset(base);
  std::string columns = "number INTEGER PRIMARY KEY", places = "?";
  for (const Column& column : like.all) {
    columns += ", " + column.name + " " + sql_type(column.type);
    places += ", ?";
  }
  // the file is brought down to the disk as a whole, at the end
  if (code != SQLITE_OK || !out.run("PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF; BEGIN;"
                                    "CREATE TABLE batch (manifest TEXT);"
                                    "CREATE TABLE items (" +
                                    columns + ")")) {
    return fail(out.failed());
  }
  const Statement keep = prepared(base, "INSERT INTO batch VALUES (?)");
  sqlite3_bind_text(keep.get(), 1, manifest.data(), static_cast<int>(manifest.size()),
                    SQLITE_TRANSIENT);
  out.insert_ = prepared(base, "INSERT INTO items VALUES (" + places + ")");
  if (sqlite3_step(keep.get()) != SQLITE_DONE || out.insert_ == nullptr) return fail(out.failed());
  return out;
}

Result<void> IndexWriter::append(const Columns& rows) {
  for (std::size_t i = 0; i < rows.rows(); ++i) {
    sqlite3_bind_int64(insert_.get(), 1, static_cast<sqlite3_int64>(rows_++));
    for (std::size_t k = 0; k < rows.all.size(); ++k) {
      bind(insert_.get(), static_cast<int>(k) + 2, rows.all[k], i);
    }
    if (sqlite3_step(insert_.get()) != SQLITE_DONE) return fail(failed());
    sqlite3_reset(insert_.get());
  }
  return {};
}

Result<void> IndexWriter::finish() {
  insert_.reset();
  // the questions that are asked most: an item by its name, failures, contours above their bound
  if (!run("CREATE INDEX items_id ON items (id);"
           "CREATE INDEX items_code ON items (code) WHERE code <> 0;"
           "CREATE INDEX items_above ON items (number) WHERE vertices > bound;"
           "COMMIT; ANALYZE")) {
    return fail(failed());
  }
  Statement twice =
      prepared(base_.get(), "SELECT id FROM items GROUP BY id HAVING count(*) > 1 LIMIT 1");
  if (sqlite3_step(twice.get()) == SQLITE_ROW) twice_ = text_at(twice.get(), 0);
  twice.reset();
  base_.reset();
  if (!put_in_place(temporary_, path_)) return fail(failed());
  temporary_.clear();
  return {};
}

IndexWriter::IndexWriter(IndexWriter&& other) noexcept
    : path_(std::move(other.path_)),
      temporary_(std::exchange(other.temporary_, {})),
      twice_(std::move(other.twice_)),
      base_(std::move(other.base_)),
      insert_(std::move(other.insert_)),
      rows_(other.rows_) {}

IndexWriter::~IndexWriter() {
  insert_.reset();
  base_.reset();
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

bool IndexWriter::run(const std::string& sql) {
  return sqlite3_exec(base_.get(), sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK;
}

Error IndexWriter::failed() const {
  return {ErrorCode::kWriteFailed,
          std::string("cannot write the index: ") +
              (base_ == nullptr ? "no room or no permission" : sqlite3_errmsg(base_.get())),
          path_, ""};
}

std::string manifest_in_index(const std::string& path) {
  const auto base = opened(path);
  if (!base) return {};
  const Statement ask = prepared(base->get(), "SELECT manifest FROM batch");
  return ask != nullptr && sqlite3_step(ask.get()) == SQLITE_ROW ? text_at(ask.get(), 0) : "";
}

Result<Answer> ask_index(const std::string& path, const Query& query) {
  const auto base = opened(path);
  OBVID_TRY(base);
  bool whole = false;
  const Statement ask = prepared(base->get(), select_of(query), &whole);
  if (ask == nullptr || !whole || sqlite3_stmt_readonly(ask.get()) == 0) {
    return fail({ErrorCode::kBadOption,
                 ask == nullptr ? sqlite3_errmsg(base->get()) : "this is no single condition",
                 query.where, "write a condition of SQL: \"vertices > bound\""});
  }
  Answer out;
  const int columns = sqlite3_column_count(ask.get());
  for (int k = 0; k < columns; ++k) out.names.emplace_back(sqlite3_column_name(ask.get(), k));
  int code = SQLITE_ROW;
  while ((code = sqlite3_step(ask.get())) == SQLITE_ROW) {
    std::vector<std::string> row;
    for (int k = 0; k < columns; ++k) row.push_back(text_at(ask.get(), k));
    out.rows.push_back(std::move(row));
  }
  if (code != SQLITE_DONE) {
    return fail({ErrorCode::kCannotOpen, sqlite3_errmsg(base->get()), path, ""});
  }
  return out;
}

}  // namespace obvid::batch
