// SPDX-License-Identifier: Apache-2.0
// What travels between the program and its helper, and what must not pass for it.
#include "helper_message.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <variant>

namespace obvid::cad {
namespace {

const Error kOtherwise = {ErrorCode::kNotText, "not whole", "file", "", -1, 0.0};

RationalBezier parabola() {
  RationalBezier out;
  out.origin = {5.0, -7.0};
  out.degree = 2;
  out.offset[1] = {1.0, 2.0};
  out.offset[2] = {3.0, 0.5};
  out.weight = {1.0, 0.7, 1.0};
  return out;
}

Drawing drawing() {
  Drawing out;
  out.name = "part.step";
  out.units = "mm";
  out.warnings = {"one", ""};
  out.curves.push_back({"wire 1",
                        {LinePiece{{0, 1}, {2, 3}}, ArcPiece{{2, 3}, {4, 5}, 0.1, -0.2, 0.3},
                         parabola(), ClothoidPiece{{1, 1}, {2, 2}, 0.4, 0.5, 0.6, 0.7}},
                        true});
  out.curves.push_back({"empty", {}, false});
  return out;
}

NurbsSurface plane() {
  return {1, 1, {0, 0, 1, 1}, {0, 0, 1, 1}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 2}}, {}};
}

/// The n-th number in the bytes replaced.
template <class T>
std::string with_word(std::string bytes, std::size_t n, T value) {
  static_assert(sizeof(T) == 8);
  std::memcpy(bytes.data() + 8 * n, &value, 8);
  return bytes;
}

std::string refusal(const std::string& bytes) {
  const auto found = unpacked_drawing(bytes, kOtherwise);
  return found ? "" : found.error().what;
}

TEST(CadMessage, ADrawingComesBackAsItWas) {
  const auto back = unpacked_drawing(packed(Result<Drawing>(drawing())), kOtherwise);
  ASSERT_TRUE(back);
  EXPECT_EQ(packed(back), packed(Result<Drawing>(drawing())));
  EXPECT_EQ(back->warnings, drawing().warnings);
  ASSERT_EQ(back->curves.size(), 2U);
  EXPECT_TRUE(back->curves[0].closed);
  const auto& curve = std::get<RationalBezier>(back->curves[0].pieces[2]);
  EXPECT_EQ(curve.origin, parabola().origin);
  EXPECT_EQ(curve.offset, parabola().offset);
  EXPECT_EQ(curve.weight, parabola().weight);
  EXPECT_EQ(std::get<ClothoidPiece>(back->curves[0].pieces[3]).kappa1, 0.6);
}

TEST(CadMessage, AnErrorComesBackWithAllThatItSays) {
  const Error error = {ErrorCode::kTooFewPoints, "what", "where", "hint", 7, 0.25};
  const auto back = unpacked_drawing(packed(Result<Drawing>(fail(error))), kOtherwise);
  ASSERT_FALSE(back);
  EXPECT_EQ(back.error().code, error.code);
  EXPECT_EQ(back.error().what, "what");
  EXPECT_EQ(back.error().where, "where");
  EXPECT_EQ(back.error().hint, "hint");
  EXPECT_EQ(back.error().index, 7);
  EXPECT_EQ(back.error().value, 0.25);
}

TEST(CadMessage, JobsComeBackAsTheyWere) {
  const NurbsCurve line{1, {0, 0, 1, 1}, {{0, 0}, {1, 2}}, {1, 1}};
  const CadWriteOptions options{CadFormat::kIges, "in", 2.5};
  const Job jobs[] = {ReadCurves{"/dev/stdin"}, ReadFaces{std::string("\xFF\n ", 3)},
                      WriteCurves{{{"a", line}, {"b", std::vector<Piece>{parabola()}}}, options},
                      WriteFaces{{"model", "km", {{"face", plane()}}}, options}};
  for (const Job& job : jobs) {
    const auto back = unpacked_job(packed(job));
    ASSERT_TRUE(back) << job.index();
    EXPECT_EQ(back->index(), job.index());
    EXPECT_EQ(packed(*back), packed(job));
  }
  const auto faces = std::get<WriteFaces>(*unpacked_job(packed(jobs[3])));
  EXPECT_EQ(faces.model.patches[0].surface, plane());
  EXPECT_EQ(faces.options.format, CadFormat::kIges);
  EXPECT_EQ(faces.options.face_width, 2.5);
}

TEST(CadMessage, WhatIsCutOffOrGoesOnIsNotWhole) {
  const std::string bytes = packed(Result<Drawing>(drawing()));
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    EXPECT_EQ(refusal(bytes.substr(0, n)), "not whole") << n;
  }
  EXPECT_EQ(refusal(bytes + '\0'), "not whole");
  EXPECT_FALSE(unpacked_text(packed(Result<std::string>("abc")).substr(0, 18), kOtherwise));
  EXPECT_FALSE(unpacked_job(""));
}

TEST(CadMessage, FalseCountsAskForNothing) {
  // whether there is a value, size of the name, ...
  const std::string bytes = packed(Result<Drawing>(drawing()));
  for (const std::uint64_t count : {std::uint64_t{1} << 40, ~std::uint64_t{0}, bytes.size() + 1}) {
    EXPECT_EQ(refusal(with_word(bytes, 1, count)), "not whole");
  }
  EXPECT_EQ(refusal(with_word(bytes, 0, std::uint64_t{2})), "not whole");  // no truth value
}

TEST(CadMessage, DegreesKindsAndCodesOutsideTheirRangeAreRefused) {
  Drawing one;
  one.units.name.clear();
  one.curves.push_back({"", {parabola()}, false});
  const std::string bytes = packed(Result<Drawing>(one));
  ASSERT_EQ(refusal(bytes), "");
  // made, size of name, of units, their source, number of curves, size of label, number of pieces,
  // kind, origin, degree
  constexpr std::size_t kKind = 7, kDegree = 10;
  EXPECT_EQ(refusal(with_word(bytes, kKind, std::uint64_t{4})), "not whole");
  for (const std::int64_t degree : {0LL, -1LL, 8LL, 1LL << 32}) {
    EXPECT_EQ(refusal(with_word(bytes, kDegree, degree)), "not whole") << degree;
  }
  const std::string error = packed(Result<Drawing>(fail(kOtherwise)));
  ASSERT_EQ(unpacked_drawing(error, {}).error().code, kOtherwise.code);
  EXPECT_EQ(unpacked_drawing(with_word(error, 1, std::int64_t{999}), {}).error().code,
            Error().code);
}

TEST(CadMessage, NumbersThatAreNotFiniteAreRefused) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    Drawing one;
    RationalBezier curve = parabola();
    curve.weight[1] = bad;
    one.curves.push_back({"", {curve}, false});
    EXPECT_EQ(refusal(packed(Result<Drawing>(one))), "not whole");
    one.curves[0].pieces = {ArcPiece{{0, 0}, {1, 0}, 0.0, bad, 1.0}};
    EXPECT_EQ(refusal(packed(Result<Drawing>(one))), "not whole");
  }
  // what a piece has no use for may be anything
  Drawing one;
  RationalBezier curve = parabola();
  curve.weight[3] = HUGE_VAL;
  one.curves.push_back({"", {curve}, false});
  EXPECT_EQ(refusal(packed(Result<Drawing>(one))), "");
}

TEST(CadMessage, SurfacesThatAreNoneAreRefused) {
  CadSurfaces surfaces;
  surfaces.model.patches.push_back({"good", plane()});
  EXPECT_TRUE(unpacked_surfaces(packed(Result<CadSurfaces>(surfaces)), kOtherwise));
  surfaces.model.patches.push_back({"bad", plane()});
  surfaces.model.patches[1].surface.points.pop_back();
  EXPECT_FALSE(unpacked_surfaces(packed(Result<CadSurfaces>(surfaces)), kOtherwise));
  surfaces.model.patches[1].surface = plane();
  surfaces.model.patches[1].surface.degree_u = std::numeric_limits<int>::max();
  EXPECT_FALSE(unpacked_surfaces(packed(Result<CadSurfaces>(surfaces)), kOtherwise));
}

}  // namespace
}  // namespace obvid::cad
