// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "obvid/core/internal/watch.h"
#include "obvid/core/result.h"
#include "obvid/core/units.h"
#include "obvid/geom/vec2.h"

namespace obvid {

/// Whole numbers up to here have an exact double.
inline constexpr long long kMaxInteger = 1LL << 53;
inline constexpr int kMaxInt = std::numeric_limits<int>::max();

/// The parsed text. Errors: E308 with line and column, also where an object names a field twice:
/// other programs might take the other one; E103.
[[nodiscard]] Result<nlohmann::json> parse_json(std::string_view text, std::string_view name,
                                                Watch* watch);

/// A value with the way to it, so that errors can name it ("/pieces/3/weights/2").
struct JsonNode {
  const nlohmann::json* value = nullptr;
  const JsonNode* parent = nullptr;
  std::string_view key;  ///< empty inside an array
  std::size_t index = 0;

  [[nodiscard]] std::string path() const;
};

/// Takes single values out of a parsed text. The first error stays and makes all further steps
/// return at once, so that each step reads like the format.
class JsonValues {
 public:
  JsonValues(std::string_view name, Watch* watch) : watch_(watch), name_(name) {}

 protected:
  using Node = JsonNode;

  void refuse(const Node& node, ErrorCode code, std::string what);
  void refuse(const Node& node, std::string what) {
    refuse(node, ErrorCode::kBadJson, std::move(what));
  }
  [[nodiscard]] bool failed() const { return error_.has_value(); }

  Node field(const Node& object, std::string_view key);
  std::optional<Node> optional_field(const Node& object, std::string_view key);
  double number(const Node& node);
  double number_or_nan(const Node& node);
  long long integer(const Node& node, long long least, long long most);
  std::size_t index(const Node& node, std::size_t size, std::string_view what);
  bool flag(const Node& node);
  std::string word(const Node& node);
  /// "units_source", where it is there: how the unit is known.
  void unit_source(const Node& object, Units& units);
  Vec2 point(const Node& node);
  double figure(const Node& object, std::string_view key);
  double optional_figure(const Node& object, std::string_view key, double otherwise);
  int small_count(const Node& object, std::string_view key);
  std::size_t optional_count(const Node& object, std::string_view key);
  bool optional_flag(const Node& object, std::string_view key, bool otherwise);

  /// Fields below `document` that nothing took, the same ones of several items once, with `*` for
  /// the number of the item; none of a document that was cancelled.
  [[nodiscard]] std::vector<std::string> unread_fields(const nlohmann::json& document);

  template <class Read>
  void each(const Node& array, Read read) {
    if (failed()) return;
    if (!array.value->is_array()) return refuse(array, "an array is expected");
    constexpr std::size_t kItemsOfStep = 256;  // between two questions whether the work goes on
    for (std::size_t i = 0; i < array.value->size() && !failed(); ++i) {
      if (i % kItemsOfStep == kItemsOfStep - 1 && is_to_end(watch_)) {
        error_ = cancelled_error();
        return;
      }
      read(Node{&(*array.value)[i], &array, {}, i});
    }
  }

  std::optional<Error> error_;

  Watch* watch_;

 private:
  void sort_taken();

  std::string_view name_;
  std::vector<const nlohmann::json*> taken_;
};

}  // namespace obvid
