// SPDX-License-Identifier: Apache-2.0
#include "columns.h"

#include <algorithm>
#include <iterator>

namespace obvid::batch {
namespace {

template <class Value>
std::vector<Value> taken(std::vector<Value>& from, std::size_t count) {
  const auto end = from.begin() + static_cast<std::ptrdiff_t>(std::min(count, from.size()));
  std::vector<Value> out(std::make_move_iterator(from.begin()), std::make_move_iterator(end));
  from.erase(from.begin(), end);
  return out;
}

}  // namespace

const Column* Columns::named(const std::string& name) const {
  const auto at = std::find_if(all.begin(), all.end(),
                               [&](const Column& column) { return column.name == name; });
  return at == all.end() ? nullptr : &*at;
}

Columns Columns::empty() const {
  Columns out;
  for (const Column& column : all) out.all.push_back({column.name, column.type, column.meaning});
  return out;
}

void Columns::append(const Columns& more) {
  for (std::size_t k = 0; k < all.size(); ++k) {
    Column& to = all[k];
    const Column& from = more.all[k];
    to.texts.insert(to.texts.end(), from.texts.begin(), from.texts.end());
    to.numbers.insert(to.numbers.end(), from.numbers.begin(), from.numbers.end());
  }
}

Columns Columns::take_front(std::size_t rows) {
  Columns out = empty();
  for (std::size_t k = 0; k < all.size(); ++k) {
    out.all[k].texts = taken(all[k].texts, rows);
    out.all[k].numbers = taken(all[k].numbers, rows);
  }
  return out;
}

std::vector<std::size_t> Columns::widths() const {
  std::vector<std::size_t> out;
  for (const Column& column : all) {
    std::size_t width = column.type == Column::Type::kText ? 1 : 0;
    for (const std::string& text : column.texts) width = std::max(width, text.size());
    out.push_back(width);
  }
  return out;
}

}  // namespace obvid::batch
