// SPDX-License-Identifier: Apache-2.0
#include "message.h"

#include <cstring>
#include <type_traits>
#include <variant>

namespace obvid::cad {
namespace {

class Packer {
 public:
  template <class T>
  void value(const T& one) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* bytes = reinterpret_cast<const char*>(&one);
    bytes_.append(bytes, sizeof(T));
  }
  void text(const std::string& one) {
    value(one.size());
    bytes_ += one;
  }
  void piece(const Piece& one) {
    value(one.index());
    std::visit([&](const auto& kind) { value(kind); }, one);
  }
  [[nodiscard]] std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

class Unpacker {
 public:
  explicit Unpacker(const std::string& bytes) : bytes_(bytes) {}

  template <class T>
  void value(T& one) {
    static_assert(std::is_trivially_copyable_v<T>);
    if (at_ + sizeof(T) > bytes_.size()) {
      whole_ = false;
      return;
    }
    std::memcpy(&one, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
  }
  template <class T>
  T get() {
    T one{};
    value(one);
    return one;
  }
  std::string text() {
    const auto size = get<std::size_t>();
    if (!whole_ || size > bytes_.size() - at_) {
      whole_ = false;
      return {};
    }
    at_ += size;
    return bytes_.substr(at_ - size, size);
  }
  Piece piece() {
    switch (get<std::size_t>()) {
      case 0:
        return get<LinePiece>();
      case 1:
        return get<ArcPiece>();
      case 2:
        return get<RationalBezier>();
      case 3:
        return get<ClothoidPiece>();
      default:
        whole_ = false;
        return LinePiece{};
    }
  }
  /// How many items follow; never more than there are bytes.
  std::size_t count() {
    const auto n = get<std::size_t>();
    if (n > bytes_.size()) whole_ = false;
    return whole_ ? n : 0;
  }
  [[nodiscard]] bool whole() const { return whole_; }

 private:
  const std::string& bytes_;
  std::size_t at_ = 0;
  bool whole_ = true;
};

void pack_error(const Error& error, Packer& out) {
  out.value(error.code);
  out.text(error.what);
  out.text(error.where);
  out.text(error.hint);
}

Error unpack_error(Unpacker& in) {
  Error error;
  in.value(error.code);
  error.what = in.text();
  error.where = in.text();
  error.hint = in.text();
  return error;
}

}  // namespace

std::string packed(const Result<Drawing>& drawing) {
  Packer out;
  out.value(drawing.has_value());
  if (!drawing) {
    pack_error(drawing.error(), out);
    return out.take();
  }
  out.text(drawing->name);
  out.text(drawing->units);
  out.value(drawing->warnings.size());
  for (const std::string& warning : drawing->warnings) out.text(warning);
  out.value(drawing->curves.size());
  for (const DrawnCurve& curve : drawing->curves) {
    out.text(curve.label);
    out.value(curve.closed);
    out.value(curve.pieces.size());
    for (const Piece& piece : curve.pieces) out.piece(piece);
  }
  return out.take();
}

Result<Drawing> unpacked(const std::string& bytes, const std::string& path) {
  Unpacker in(bytes);
  const bool made = in.get<bool>();
  if (!made && in.whole()) {
    Error error = unpack_error(in);
    if (in.whole()) return fail(std::move(error));
  }
  Drawing drawing;
  drawing.name = in.text();
  drawing.units = in.text();
  for (std::size_t n = in.count(); n > 0; --n) drawing.warnings.push_back(in.text());
  for (std::size_t n = in.count(); n > 0 && in.whole(); --n) {
    DrawnCurve curve;
    curve.label = in.text();
    curve.closed = in.get<bool>();
    for (std::size_t m = in.count(); m > 0 && in.whole(); --m) curve.pieces.push_back(in.piece());
    drawing.curves.push_back(std::move(curve));
  }
  if (in.whole()) return drawing;
  return fail({ErrorCode::kNotText, "the CAD kernel broke down over this file", path,
               "the file may be damaged; export it again", -1, 0.0});
}

}  // namespace obvid::cad
