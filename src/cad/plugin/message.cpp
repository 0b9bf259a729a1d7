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
  template <class T>
  void values(const std::vector<T>& all) {
    static_assert(std::is_trivially_copyable_v<T>);
    value(all.size());
    bytes_.append(reinterpret_cast<const char*>(all.data()), all.size() * sizeof(T));
  }
  void texts(const std::vector<std::string>& all) {
    value(all.size());
    for (const std::string& one : all) text(one);
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
  template <class T>
  std::vector<T> values() {
    const auto n = get<std::size_t>();
    if (!whole_ || n > (bytes_.size() - at_) / sizeof(T)) {
      whole_ = false;
      return {};
    }
    std::vector<T> all(n);
    if (n > 0) std::memcpy(all.data(), bytes_.data() + at_, n * sizeof(T));
    at_ += n * sizeof(T);
    return all;
  }
  std::vector<std::string> texts() {
    std::vector<std::string> all;
    for (std::size_t n = count(); n > 0 && whole_; --n) all.push_back(text());
    return all;
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

Error broke_down(const std::string& path) {
  return {ErrorCode::kNotText,
          "the CAD kernel broke down over this file",
          path,
          "the file may be damaged; export it again",
          -1,
          0.0};
}

void pack_patch(const SurfacePatch& patch, Packer& out) {
  out.text(patch.name);
  out.value(patch.surface.degree_u);
  out.value(patch.surface.degree_v);
  out.values(patch.surface.knots_u);
  out.values(patch.surface.knots_v);
  out.values(patch.surface.points);
  out.values(patch.surface.weights);
}

SurfacePatch unpack_patch(Unpacker& in) {
  SurfacePatch patch;
  patch.name = in.text();
  in.value(patch.surface.degree_u);
  in.value(patch.surface.degree_v);
  patch.surface.knots_u = in.values<double>();
  patch.surface.knots_v = in.values<double>();
  patch.surface.points = in.values<Vec3>();
  patch.surface.weights = in.values<double>();
  return patch;
}

void pack_units(const Units& units, Packer& out) {
  out.text(units.name);
  out.value(units.known());
}

Units unpack_units(Unpacker& in) {
  std::string name = in.text();
  return {std::move(name), in.get<bool>() ? UnitSource::kFile : UnitSource::kAssumed};
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
  pack_units(drawing->units, out);
  out.texts(drawing->warnings);
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
  drawing.units = unpack_units(in);
  drawing.warnings = in.texts();
  for (std::size_t n = in.count(); n > 0 && in.whole(); --n) {
    DrawnCurve curve;
    curve.label = in.text();
    curve.closed = in.get<bool>();
    for (std::size_t m = in.count(); m > 0 && in.whole(); --m) curve.pieces.push_back(in.piece());
    drawing.curves.push_back(std::move(curve));
  }
  if (in.whole()) return drawing;
  return fail(broke_down(path));
}

std::string packed(const Result<CadSurfaces>& surfaces) {
  Packer out;
  out.value(surfaces.has_value());
  if (!surfaces) {
    pack_error(surfaces.error(), out);
    return out.take();
  }
  out.text(surfaces->model.name);
  pack_units(surfaces->model.units, out);
  out.texts(surfaces->warnings);
  out.value(surfaces->model.patches.size());
  for (const SurfacePatch& patch : surfaces->model.patches) pack_patch(patch, out);
  return out.take();
}

Result<CadSurfaces> unpacked_surfaces(const std::string& bytes, const std::string& path) {
  Unpacker in(bytes);
  const bool made = in.get<bool>();
  if (!made && in.whole()) {
    Error error = unpack_error(in);
    if (in.whole()) return fail(std::move(error));
  }
  CadSurfaces surfaces;
  surfaces.model.name = in.text();
  surfaces.model.units = unpack_units(in);
  surfaces.warnings = in.texts();
  for (std::size_t n = in.count(); n > 0 && in.whole(); --n) {
    surfaces.model.patches.push_back(unpack_patch(in));
    const auto fine = check(surfaces.model.patches.back().surface);
    if (in.whole() && !fine) return fail(fine.error());
  }
  if (in.whole()) return surfaces;
  return fail(broke_down(path));
}

}  // namespace obvid::cad
