// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/internal/plain_letters.h"

#include <gtest/gtest.h>

namespace obvid {
namespace {

TEST(PlainLetters, AsciiStaysAsItIs) {
  EXPECT_EQ(plain_letters("plate (2) ~v1.dxf"), "plate (2) ~v1.dxf");
}

TEST(PlainLetters, LettersOfEuropeAreWrittenAsTheirOwnersDo) {
  EXPECT_EQ(plain_letters("Platte mit Löchern.dxf"), "Platte mit Loechern.dxf");
  EXPECT_EQ(plain_letters("ÄÖÜäöüßẞ"), "AeOeUeaeoeuessSS");
  EXPECT_EQ(plain_letters("Blåbær på øy"), "Blaabaer paa oey");
  EXPECT_EQ(plain_letters("pièce découpée ñandú Çarşı"), "piece decoupee nandu Carsi");
  EXPECT_EQ(plain_letters("Łódź żółć"), "Lodz zolc");
}

TEST(PlainLetters, MarksBehindTheirLetterAreAsGoodAsOneLetter) {
  EXPECT_EQ(plain_letters("Lo\xCC\x88"
                          "cher a\xCC\x8A e\xCC\x81"),
            "Loecher aa e");
}

TEST(PlainLetters, CyrillicIsWrittenAsItSounds) {
  EXPECT_EQ(plain_letters("Деталь Щит Юла"), "Detal Shchit Yula");
  EXPECT_EQ(plain_letters("Київ"), "Kiyiv");
}

TEST(PlainLetters, WhatHasNoneIsOneLine) {
  EXPECT_EQ(plain_letters("図面 1 – Ø"), "__ 1 - Oe");
  EXPECT_EQ(plain_letters("a\xFF\xC3"), "a__");
}

}  // namespace
}  // namespace obvid
