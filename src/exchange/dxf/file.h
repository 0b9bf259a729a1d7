// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/internal/format_into.h"
#include "obvid/geom/vec2.h"

namespace obvid::exchange {

/// Pairs of group code and value in the making.
class DxfWriter {
 public:
  void pair(int code, std::string_view value) { format_into(text_, "{:3d}\n{}\n", code, value); }
  void pair(int code, int value) { pair(code, std::to_string(value)); }
  /// 17 significant digits: the same double when it is read.
  void pair(int code, double value) { pair(code, fmt::format("{}", value == 0.0 ? 0.0 : value)); }
  void pair(int code, const char* value) { pair(code, std::string_view(value)); }
  /// x and y by `code` and `code + 10`.
  void point(int code, Vec2 p) {
    pair(code, p.x);
    pair(code + 10, p.y);
  }
  void point3(int code, Vec2 p) {
    point(code, p);
    pair(code + 20, 0.0);
  }
  /// A new handle, hexadecimal.
  std::string handle() { return fmt::format("{:X}", next_++); }
  [[nodiscard]] std::string next_handle() const { return fmt::format("{:X}", next_); }
  void append(const std::string& text) { text_ += text; }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_;
  unsigned next_ = 0x100;  // those below are of the tables
};

/// AutoCAD colour index that is black on white and white on black.
inline constexpr int kWhiteOrBlack = 7;

struct DxfLayer {
  std::string name;
  int color = kWhiteOrBlack;
  std::string handle{};  ///< empty: one below those of the entities, of which there are few
};

/// Handles of their own for layers beyond the few.
void give_handles(std::vector<DxfLayer>& layers, DxfWriter& out);

/// What stands around the entities of an R2000 file: header, tables, blocks, objects.
[[nodiscard]] std::string r2000_head(const std::vector<DxfLayer>& layers, int units,
                                     const std::string& seed, Vec2 low, Vec2 high);
[[nodiscard]] std::string r2000_tail();
/// Handle of the model space, owner of all entities.
inline constexpr const char* kModelSpace = "1F";

/// R12 knows no units: a comment names them, which `parse_dxf` understands.
[[nodiscard]] std::string r12_head(const std::vector<std::string>& layers, const std::string& units,
                                   Vec2 low, Vec2 high);
inline constexpr const char* kUnitsComment = "obvid: lengths in ";

}  // namespace obvid::exchange
