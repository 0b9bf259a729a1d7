// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace obvid::cad {

// Values as bytes for a pipe between two programs of one machine. What a struct consists of is
// written once, as `fields(io, struct)`, for both directions.

/// T, const or not.
template <class T, class Kind>
concept IsA = std::same_as<std::remove_const_t<T>, Kind>;

/// Numbers travel as 8 bytes each, so that no padding and no width of a type is sent.
template <class T>
requires std::is_arithmetic_v<T> std::uint64_t to_word(T value) {
  if constexpr (std::is_floating_point_v<T>) {
    return std::bit_cast<std::uint64_t>(static_cast<double>(value));
  } else {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
  }
}

class WireOut {
 public:
  template <class... T>
  void operator()(const T&... all) {
    (put(all), ...);
  }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  template <class T>
  void put(const T& one) {
    if constexpr (std::is_arithmetic_v<T>) {
      const std::uint64_t word = to_word(one);
      bytes_.append(reinterpret_cast<const char*>(&word), sizeof word);
    } else {
      fields(*this, one);
    }
  }
  void put(const std::string& text) {
    put(text.size());
    bytes_ += text;
  }
  template <class T>
  void put(const std::vector<T>& all) {
    put(all.size());
    for (const T& one : all) put(one);
  }
  template <class... T>
  void put(const std::variant<T...>& one) {
    put(one.index());
    std::visit([this](const auto& kind) { this->put(kind); }, one);
  }

  std::string bytes_;
};

/// Takes apart what may be any bytes: whatever does not fit makes it not whole, and from then on
/// nothing more is read.
class WireIn {
 public:
  explicit WireIn(std::string_view bytes) : left_(bytes) {}

  template <class... T>
  void operator()(T&... all) {
    (get(all), ...);
  }
  void refuse() { whole_ = false; }
  /// Everything so far was there.
  [[nodiscard]] bool whole() const { return whole_; }
  /// And nothing is left over.
  [[nodiscard]] bool done() const { return whole_ && left_.empty(); }

 private:
  std::uint64_t word() {
    std::uint64_t out = 0;
    if (left_.size() < sizeof out) refuse();
    if (!whole_) return 0;
    std::memcpy(&out, left_.data(), sizeof out);
    left_.remove_prefix(sizeof out);
    return out;
  }
  /// Every item of a list takes at least one byte: a false count cannot ask for more memory.
  std::size_t count() {
    const std::uint64_t n = word();
    if (n > left_.size()) refuse();
    return whole_ ? static_cast<std::size_t>(n) : 0;
  }

  template <class T>
  void get(T& one) {
    if constexpr (std::is_floating_point_v<T>) {
      one = std::bit_cast<double>(word());
    } else if constexpr (std::is_integral_v<T>) {
      const std::uint64_t value = word();
      one = static_cast<T>(value);
      if (to_word(one) != value) refuse();
    } else {
      fields(*this, one);
    }
  }
  void get(std::string& text) {
    const std::size_t size = count();
    text = left_.substr(0, size);
    left_.remove_prefix(size);
  }
  template <class T>
  void get(std::vector<T>& all) {
    all.clear();
    for (std::size_t n = count(); n > 0 && whole_; --n) get(all.emplace_back());
  }
  template <class... T>
  void get(std::variant<T...>& one) {
    const std::uint64_t index = word();
    if (index >= sizeof...(T)) refuse();
    if (whole_) get_alternative(one, static_cast<std::size_t>(index));
  }
  template <std::size_t I = 0, class... T>
  void get_alternative(std::variant<T...>& one, std::size_t index) {
    if constexpr (I < sizeof...(T)) {
      if (index == I) return get(one.template emplace<I>());
      get_alternative<I + 1>(one, index);
    }
  }

  std::string_view left_;
  bool whole_ = true;
};

/// An enumerator; `is_known` decides which numbers are one.
template <class Io, class Enum, class Known>
void enum_field(Io& io, Enum& one, Known is_known) {
  int number = static_cast<int>(one);
  io(number);
  if constexpr (!std::is_const_v<Enum>) {
    one = static_cast<Enum>(number);
    if (!is_known(one)) io.refuse();
  }
}

}  // namespace obvid::cad
