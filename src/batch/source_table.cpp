// SPDX-License-Identifier: Apache-2.0
// A table of many series: rows with the same id belong together.
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "source.h"

namespace obvid::batch {
namespace {

/// How the cells of a table are parted: one character, or blanks.
enum class Parted : char { kComma = ',', kSemicolon = ';', kTab = '\t', kBlanks = ' ' };

struct Cell {
  std::size_t begin = 0, end = 0;  ///< of its text in the line
};

std::string_view without_end(std::string_view line) {
  while (!line.empty() && (line.back() == '\n' || line.back() == '\r')) line.remove_suffix(1);
  return line;
}

/// The cell from `at` on; `at` goes behind the character that parts it from the next.
Cell next_cell(std::string_view line, Parted parted, std::size_t& at) {
  const auto parts = [&](char c) {
    return parted == Parted::kBlanks ? c == ' ' || c == '\t' : c == static_cast<char>(parted);
  };
  while (parted == Parted::kBlanks && at < line.size() && parts(line[at])) ++at;
  Cell cell{at, at};
  bool quoted = false;
  for (; cell.end < line.size(); ++cell.end) {
    if (line[cell.end] == '"') quoted = !quoted;
    if (!quoted && parts(line[cell.end])) break;
  }
  at = cell.end < line.size() ? cell.end + 1 : line.size() + 1;
  return cell;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kAround = " \t\"";
  const std::size_t first = text.find_first_not_of(kAround);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kAround) - first + 1);
}

bool equal_names(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) {
           return std::tolower(static_cast<unsigned char>(x)) ==
                  std::tolower(static_cast<unsigned char>(y));
         });
}

bool is_comment(std::string_view line) {
  const std::string_view text = trimmed(without_end(line));
  return text.empty() || text.front() == '#' || text.front() == '%' || text.starts_with("//");
}

Parted parted_of(std::string_view header) {
  for (const Parted one : {Parted::kSemicolon, Parted::kTab, Parted::kComma}) {
    if (header.find(static_cast<char>(one)) != std::string_view::npos) return one;
  }
  return Parted::kBlanks;
}

std::string_view next_line(std::string_view text, std::size_t at) {
  const std::size_t end = text.find('\n', at);
  return text.substr(at, end == std::string_view::npos ? std::string_view::npos : end + 1 - at);
}

/// The header of a table, and what stands before it.
struct TableHead {
  std::size_t header = 0, rows = 0;  ///< bytes: where the header and the first row begin
  Parted parted = Parted::kComma;
  std::size_t column = 0;  ///< of the id
  bool found = false;
};

TableHead head_of(std::string_view text, std::string_view id_column) {
  TableHead out;
  constexpr std::string_view kMark = "\xef\xbb\xbf";  // of UTF-8
  std::size_t at = text.starts_with(kMark) ? kMark.size() : 0;
  while (at < text.size() && is_comment(next_line(text, at))) at += next_line(text, at).size();
  if (at >= text.size()) return out;
  const std::string_view whole = next_line(text, at), line = without_end(whole);
  out.header = at;
  out.rows = at + whole.size();
  out.parted = parted_of(line);
  for (std::size_t place = 0; place <= line.size(); ++out.column) {
    const Cell cell = next_cell(line, out.parted, place);
    if (equal_names(trimmed(line.substr(cell.begin, cell.end - cell.begin)), id_column)) {
      out.found = true;
      return out;
    }
  }
  return out;
}

/// A file as memory, which the system reads as it is needed.
class MappedFile {
 public:
  MappedFile(const char* data, std::size_t size) : text_(data, size) {}
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;
  ~MappedFile() {
    if (!text_.empty()) ::munmap(const_cast<char*>(text_.data()), text_.size());
  }
  [[nodiscard]] std::string_view text() const { return text_; }
  /// What was read may leave the memory again.
  void let_go(std::size_t from, std::size_t to) const {
    constexpr std::size_t kPage = 4096;
    from = (from + kPage - 1) / kPage * kPage;
    to = to / kPage * kPage;
    if (to > from) ::madvise(const_cast<char*>(text_.data()) + from, to - from, MADV_DONTNEED);
  }

 private:
  std::string_view text_;
};

Result<std::unique_ptr<MappedFile>> mapped(const std::string& path) {
  const Error error{ErrorCode::kCannotOpen, "cannot read the table", path,
                    "check the path and the permissions"};
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return fail(error);
  struct stat found {};
  void* data = MAP_FAILED;
  if (::fstat(file, &found) == 0 && found.st_size > 0) {
    data =
        ::mmap(nullptr, static_cast<std::size_t>(found.st_size), PROT_READ, MAP_PRIVATE, file, 0);
  }
  ::close(file);
  if (data == MAP_FAILED) return fail(error);
  return std::make_unique<MappedFile>(static_cast<const char*>(data),
                                      static_cast<std::size_t>(found.st_size));
}

class TableSource : public Source {
 public:
  TableSource(std::string path, std::unique_ptr<MappedFile> file, TableHead head)
      : path_(std::move(path)), file_(std::move(file)), head_(head) {}

  /// Finds where each series begins. Error: E307 rows of one id in two places.
  Result<void> scan() {
    const std::string_view text = file_->text();
    std::unordered_set<std::string_view> seen;
    std::string_view last;
    constexpr std::size_t kStretch = std::size_t{64} << 20U;  // bytes that stay in memory
    std::size_t kept = 0;
    for (std::size_t at = head_.rows; at < text.size();) {
      const std::string_view line = next_line(text, at);
      if (!is_comment(line)) {
        const std::string_view id = id_of(without_end(line));
        if (begins_.empty() || id != last) {
          if (!seen.insert(id).second) {
            return fail({ErrorCode::kBadCount,
                         "rows of '" + std::string(id.substr(0, 80)) + "' stand in two places",
                         path_, "sort the table by its ids"});
          }
          begins_.push_back(at);
          last = id;
        }
      }
      at += line.size();
      if (at - kept > kStretch) {
        file_->let_go(kept, at);
        kept = at;
      }
    }
    return {};
  }

  std::size_t size() const override { return begins_.size(); }

  Result<std::vector<Item>> load(std::size_t first, std::size_t count) const override {
    const std::string_view text = file_->text();
    std::vector<Item> out;
    for (std::size_t i = first; i < first + count; ++i) {
      const std::size_t end = i + 1 < begins_.size() ? begins_[i + 1] : text.size();
      Item item;
      item.kind = Item::Kind::kText;
      item.id = id_of(without_end(next_line(text, begins_[i])));
      item.name = path_ + "[" + item.id + "]";
      const std::string_view header = text.substr(head_.header, head_.rows - head_.header);
      item.text.reserve(header.size() + end - begins_[i]);
      put_without_id(header, item.text);
      for (std::size_t at = begins_[i]; at < end && item.text.size() <= kMostItemBytes;) {
        const std::string_view line = next_line(text, at);
        if (!is_comment(line)) put_without_id(line, item.text);
        at += line.size();
      }
      out.push_back(std::move(item));
    }
    const std::size_t next = first + count;
    file_->let_go(begins_[first], next < begins_.size() ? begins_[next] : text.size());
    return out;
  }

  std::string mark() const override { return path_ + " " + mark_of_file(path_); }

 private:
  Cell id_cell(std::string_view line) const {
    std::size_t at = 0;
    Cell cell;
    for (std::size_t k = 0; k <= head_.column && at <= line.size(); ++k) {
      cell = next_cell(line, head_.parted, at);
    }
    return cell;
  }

  std::string_view id_of(std::string_view line) const {
    const Cell cell = id_cell(line);
    return trimmed(line.substr(cell.begin, cell.end - cell.begin));
  }

  /// The line as a table of one series has it.
  void put_without_id(std::string_view whole, std::string& out) const {
    const std::string_view line = without_end(whole);
    const Cell cell = id_cell(line);
    if (cell.end < line.size()) {
      out.append(line.substr(0, cell.begin)).append(line.substr(cell.end + 1));
    } else {
      out.append(line.substr(0, cell.begin == 0 ? 0 : cell.begin - 1));
    }
    out += '\n';
  }

  std::string path_;
  std::unique_ptr<MappedFile> file_;
  TableHead head_;
  std::vector<std::size_t> begins_;
};

}  // namespace

bool has_id_column(const std::string& head, const std::string& id_column) {
  return head_of(head, id_column).found;
}

Result<std::unique_ptr<Source>> table_source(const std::string& path,
                                             const std::string& id_column) {
  auto file = mapped(path);
  OBVID_TRY(file);
  const TableHead head = head_of((*file)->text(), id_column);
  auto out = std::make_unique<TableSource>(path, std::move(*file), head);
  OBVID_TRY(out->scan());
  return out;
}

}  // namespace obvid::batch
