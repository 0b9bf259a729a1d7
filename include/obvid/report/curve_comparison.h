// SPDX-License-Identifier: Apache-2.0
#pragma once  // reentrant: docs/threads.md

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "obvid/curve/contour.h"
#include "obvid/geom/vec2.h"
#include "obvid/report/airfoil_figures.h"

namespace obvid {

/// One of several curves that are laid over each other.
struct ComparedCurve {
  std::string name;        ///< of its file
  Contour contour;         ///< formed through points, or as it is drawn
  bool formed = false;     ///< through points
  bool proved = false;     ///< of formed ones: the contour
  std::size_t points = 0;  ///< of the input; 0 where it has none
  double length = 0.0;     ///< units
  int vertices = 0;        ///< as the certificate counts
  bool counted = true;     ///< false where nobody could count them
  std::optional<AirfoilFigures> airfoil{};
  std::string no_airfoil{};  ///< why there are no figures of an airfoil
};

/// How far another curve is from the first one at a place of that.
struct DeviationPlace {
  double s = 0.0;                     ///< arc length along the first curve from its start, units
  Vec2 point;                         ///< of the first curve
  Vec2 normal;                        ///< of it, length 1, in the direction that counts as positive
  double weight = 0.0;                ///< arc length that the place stands for, units
  std::optional<double> deviation{};  ///< units; nothing where its normal meets no such curve
  std::optional<double> along{};      ///< of airfoils: place along the chord of the first, chords
  bool upper = false;                 ///< of airfoils
};

/// All places of the first curve, and what they say of another one.
struct CurveDeviation {
  std::size_t curve = 0;  ///< of the comparison, from 1
  std::vector<DeviationPlace> places{};
  std::optional<DeviationPlace> largest{};  ///< by amount; nothing where nothing was measured
  double root_mean_square = 0.0;            ///< over the arc length that was measured, units
  double measured = 0.0;                    ///< of the arc length of the first curve, 0 to 1
};

/// Several curves over each other; deviations are those from the first one.
struct CurveComparison {
  Units units;
  std::vector<ComparedCurve> curves{};
  bool airfoils = false;  ///< all of them are
  bool outward = false;   ///< positive is outward of the first curve; else to its left
  std::vector<CurveDeviation> as_they_lie{};
  /// After scaling, turning and moving each so that its chord is that of the first curve, in units
  /// of that; empty where it was not asked for.
  std::vector<CurveDeviation> on_one_chord{};
};

}  // namespace obvid
