// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "obvid/core/internal/parallel.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace obvid::toolpath {

inline constexpr std::size_t kLargePage = std::size_t{1} << 21;  // bytes

/// Memory on large pages where the system has them and as much is wanted: lists of many megabytes
/// are first used, and read to and fro, in a fraction of the time. Elsewhere as always.
/// Elements that are given no value have none: threads that share the work give it to them.
template <class T>
class LargePages {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  using value_type = T;

  LargePages() = default;
  template <class Other>
  LargePages(const LargePages<Other>&) noexcept {}  // NOLINT: implicit, as allocators are

  [[nodiscard]] T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (!is_large(bytes)) return static_cast<T*>(::operator new(bytes));
    const std::size_t pages = (bytes + kLargePage - 1) / kLargePage;
    void* found = std::aligned_alloc(kLargePage, pages * kLargePage);
    if (found == nullptr) throw std::bad_alloc();
#ifdef __linux__
    static_cast<void>(madvise(found, pages * kLargePage, MADV_HUGEPAGE));  // no harm where refused
#endif
    return static_cast<T*>(found);
  }
  void deallocate(T* list, std::size_t count) noexcept {
    is_large(count * sizeof(T)) ? std::free(list) : ::operator delete(list);
  }

  template <class Element>
  void construct(Element*) noexcept {}
  template <class Element, class... Arguments>
  void construct(Element* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) Element(std::forward<Arguments>(arguments)...);
  }

  friend bool operator==(const LargePages&, const LargePages&) { return true; }

 private:
  static bool is_large(std::size_t bytes) { return bytes >= kLargePage; }
};

template <class T>
using LargeList = std::vector<T, LargePages<T>>;

template <class T>
LargeList<T> large_list(std::size_t count, const T& value, std::size_t threads) {
  constexpr std::size_t kTogether = std::size_t{1} << 14;
  LargeList<T> out(count);
  in_lots(count, kTogether, threads, [&](std::size_t from, std::size_t to) {
    std::fill_n(out.begin() + static_cast<std::ptrdiff_t>(from), to - from, value);
  });
  return out;
}

}  // namespace obvid::toolpath
