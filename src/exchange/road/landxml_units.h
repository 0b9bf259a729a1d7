// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

namespace obvid::exchange {

/// A unit of length of LandXML 1.2.
struct LandXmlUnit {
  std::string_view name;    ///< here
  std::string_view theirs;  ///< linearUnit
  bool metric = true;
};

inline constexpr std::array kLandXmlUnits = {
    LandXmlUnit{"m", "meter"},        LandXmlUnit{"mm", "millimeter"},
    LandXmlUnit{"cm", "centimeter"},  LandXmlUnit{"km", "kilometer"},
    LandXmlUnit{"ft", "foot", false}, LandXmlUnit{"usft", "USSurveyFoot", false},
    LandXmlUnit{"in", "inch", false}, LandXmlUnit{"mi", "mile", false}};

/// What `spiType` calls transitions, in the order of `Transition`. The format calls Helmert's
/// (Schramm's) law biquadratic.
inline constexpr std::array<std::string_view, 6> kLandXmlSpirals = {
    "clothoid", "bloss", "sinusoid", "cosine", "biquadratic", "cubicParabola"};

}  // namespace obvid::exchange
