// SPDX-License-Identifier: Apache-2.0
// Whatever is changed in a contour file, `verify` notices it or says that it does not look at it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "../common/long_runs.h"
#include "obvid/curve/internal/clothoid.h"
#include "obvid/io/contour_json.h"
#include "obvid/pipeline/fit.h"

namespace obvid {
namespace {

using nlohmann::json;

/// A sine over somewhat more than a period: vertices and inflections.
std::vector<Vec2> a_wave() {
  std::vector<Vec2> points;
  for (int i = 0; i <= 14; ++i) points.push_back({0.5 * i, std::sin(0.5 * i)});
  return points;
}

/// Part of the spiral r = exp(0.3 phi): no vertex, no inflection.
std::vector<Vec2> a_spiral() {
  std::vector<Vec2> points;
  for (int i = 0; i < 7; ++i) points.push_back(std::exp(0.12 * i) * unit_at(0.4 * i));
  return points;
}

std::vector<Vec2> an_oval() {
  std::vector<Vec2> points;
  for (int i = 0; i < 14; ++i) {
    const double a = 0.3 + 6.283185307179586 * i / 14.0;
    points.push_back({3.0 * std::cos(a), 2.0 * std::sin(a)});
  }
  return points;
}

std::vector<Vec2> a_corner() {
  std::vector<Vec2> points;
  for (int i = 0; i < 6; ++i) points.push_back({1.0 * i, 0.04 * i * (5 - i)});
  for (int i = 1; i < 6; ++i) points.push_back({5.0 + 0.05 * i * (5 - i), 1.0 * i});
  return points;
}

struct LeafCase {
  const char* name;
  Carrier carrier;
  std::vector<Vec2> points;
  double noise = 0.0;
  double tolerance = 0.0;  ///< 0: the default
  Closing closing = Closing::kAutomatic;
  std::vector<FixedData> fixed{};
  std::vector<KeptPiece> kept{};
};

/// The heading and the curvature of the spiral at one of its points, by its closed form.
std::vector<FixedData> given_on_the_spiral() {
  std::vector<FixedData> out(7);
  out[3].theta = 0.4 * 3 + std::atan2(1.0, 0.3);
  out[5].kappa = 1.0 / (std::exp(0.12 * 5) * std::hypot(1.0, 0.3));
  return out;
}

/// A line, a quarter of a circle, a clothoid, a quarter of an ellipse, a corner, and points behind
/// it.
LeafCase a_drawing() {
  LeafCase out{"drawn", Carrier::kSpiral, {{0, 0}, {3, 0}, {4, 1}}};
  const double pi = 3.141592653589793;
  const ClothoidPiece bend{{4, 1}, {}, 0.5 * pi, 0.0, 0.5, 2.0};
  const Vec2 end = bend.start + clothoid_step(bend.theta0, bend.kappa0, bend.kappa1, bend.length);
  // the ellipse (cos t, 2 sin t) between its vertices, from t = 0.2 to 1.2
  const auto on_ellipse = [](double t) { return Vec2{std::cos(t), 2.0 * std::sin(t)}; };
  const double half = std::cos(0.5);
  RationalBezier ellipse;
  ellipse.degree = 2;
  ellipse.origin = end;
  ellipse.offset = {Vec2{}, on_ellipse(0.7) / half - on_ellipse(0.2),
                    on_ellipse(1.2) - on_ellipse(0.2)};
  ellipse.weight = {1.0, half, 1.0};
  const Vec2 tip = end + ellipse.offset[2];
  out.kept = {{0, LinePiece{{0, 0}, {3, 0}}},
              {1, ArcPiece{{3, 0}, {4, 1}, 0.0, 1.0, 0.5 * pi}},
              {2, ClothoidPiece{bend.start, end, bend.theta0, bend.kappa0, bend.kappa1, 2.0}},
              {3, ellipse}};
  out.points.push_back(end);
  out.points.push_back(tip);
  for (int i = 1; i < 6; ++i) {
    out.points.push_back(tip + Vec2{-0.05 * i * (5 - i) - 0.3 * i, -1.0 * i});
  }
  out.fixed.resize(out.points.size());
  out.fixed[3].corner = out.fixed[4].corner = true;
  return out;
}

std::vector<LeafCase> leaf_cases() {
  return {
      {"spirals", Carrier::kSpiral, a_wave()},
      {"arcs", Carrier::kArcs, a_spiral(), 0.0, 0.01},
      {"conics", Carrier::kConics, a_spiral()},
      {"parabolas", Carrier::kBeziers, a_spiral(), 0.0, 0.01},
      {"clothoids", Carrier::kClothoids, a_wave()},
      {"one B-spline", Carrier::kBspline, a_spiral(), 0.0, 0.01},
      {"one cubic", Carrier::kCubic, a_spiral(), 0.0, 0.01},
      {"baseline", Carrier::kBaseline, a_wave()},
      {"closed", Carrier::kSpiral, an_oval(), 0.0, 0.0, Closing::kClosed},
      {"closed arcs", Carrier::kArcs, an_oval(), 0.0, 0.03, Closing::kClosed},
      {"corner", Carrier::kSpiral, a_corner()},
      {"within tolerances", Carrier::kSpiral, a_wave(), 0.01},
      {"given", Carrier::kSpiral, a_spiral(), 0.0, 0.0, Closing::kAutomatic, given_on_the_spiral()},
      a_drawing()};
}

std::string file_of(const LeafCase& c) {
  PointSeries series;
  series.points = c.points;
  series.fixed = c.fixed;
  series.kept = c.kept;
  FitJob job;
  job.carrier = c.carrier;
  job.closing = c.closing;
  if (c.noise > 0.0) job.noise = c.noise;
  if (c.tolerance > 0.0) job.tolerance = c.tolerance;
  const auto made = fit(series, job);
  if (!made) {
    ADD_FAILURE() << c.name << ": " << to_line(made.error());
    return "{}";
  }
  return contour_to_json({made->contour, made->report, made->certificate, {}});
}

struct Judged {
  std::string refusal;  ///< empty: accepted
  std::vector<std::string> not_checked;
};

Judged judged(const std::string& text) {
  const auto stored = contour_from_json(text, "file");
  if (!stored) return {to_line(stored.error()), {}};
  const Verification v = verify(*stored);
  Judged out{"", v.not_checked};
  if (v.false_claim) {
    out.refusal = v.false_claim->what;
  } else if (promises_monotone(stored->contour.carrier) && !v.certificate.proved) {
    out.refusal = v.certificate.reason;
  } else if (!v.certificate.gaps_within_bounds || !v.certificate.through_points) {
    out.refusal = v.certificate.reason;
  }
  return out;
}

void leaves(const json& value, const std::string& path, std::vector<std::string>& out) {
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items()) leaves(inner, path + "/" + key, out);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      leaves(value[i], path + "/" + std::to_string(i), out);
    }
  } else {
    out.push_back(path);
  }
}

/// The path with `*` for numbers of items, as `verify` lists it.
std::string general(const std::string& path) {
  std::string out, part;
  for (std::size_t i = 1; i <= path.size(); ++i) {
    if (i < path.size() && path[i] != '/') {
      part += path[i];
      continue;
    }
    const bool number = part.find_first_not_of("0123456789") == std::string::npos;
    out += "/" + (number ? "*" : part);
    part.clear();
  }
  return out;
}

bool listed(const std::vector<std::string>& not_checked, const std::string& path) {
  for (const std::string& one : not_checked) {
    const std::string field = one.substr(0, one.find(' '));
    const std::string place = general(path);
    if (place == field || place.rfind(field + "/", 0) == 0) return true;
  }
  return false;
}

/// What a leaf may be changed to. Numbers by a thousandth; gaps, which are bounds, and misses of
/// given data, which are rounding, by more than the room that these have.
std::vector<json> changes_of(const json& value, const std::string& path, double size) {
  if (value.is_boolean()) return {!value.get<bool>(), nullptr, "x"};
  if (path == "/units_source") return {"file", "given", "assumed", "other", 1, nullptr};
  if (value.is_string()) return {"other", 1, nullptr};
  if (value.is_null()) return {0, 1.5, "x"};
  std::vector<json> out = {nullptr, "1"};
  const double number = value.get<double>();
  if (path.find("joint_gaps") != std::string::npos) {
    out.insert(out.end(), {3.0 * number + 1e-13, 0.3 * number, 0.0, -number - 1e-13});
  } else if (path.find("_miss") != std::string::npos) {
    out.push_back(3.0 * number + 1e-12);
  } else if (value.is_number_integer() && path.find("/points") != 0) {
    out.insert(out.end(), {value.get<long long>() + 1, value.get<long long>() - 1});
  } else {
    const double step = number == 0.0 ? 1e-3 * size : 1e-3 * std::abs(number);
    out.insert(out.end(), {number + step, number - step});
  }
  return out;
}

/// Of leaves that differ by their places in lists alone (control points, rows of the report) a few,
/// spread from the first to the last; all of them when OBVID_LONG_TESTS is set.
std::vector<std::string> few_of_each_kind(const std::vector<std::string>& paths) {
  const std::regex place("/[0-9]+");
  std::map<std::string, std::vector<std::string>> kinds;
  for (const std::string& path : paths) {
    kinds[std::regex_replace(path, place, "/*")].push_back(path);
  }
  std::vector<std::string> out;
  for (const auto& [kind, all] : kinds) {
    const auto count = static_cast<int>(all.size());
    const int kept = std::min(count, test::cases_of(count + 5, 6) + 4);
    for (int k = 0; k < kept; ++k) {
      out.push_back(all[static_cast<std::size_t>(k * (count - 1) / std::max(kept - 1, 1))]);
    }
  }
  return out;
}

/// Changes each of `paths` and expects that it is refused, or listed as not checked: how many were
/// refused.
std::size_t noticed_changes(const char* name, const json& document,
                            const std::vector<std::string>& paths) {
  std::size_t noticed = 0, told = 0;
  for (const std::string& path : paths) {
    const json::json_pointer place(path);
    for (const json& other : changes_of(document[place], path, 1.0)) {
      if (other == document[place]) continue;
      json bad = document;
      bad[place] = other;
      const Judged found = judged(bad.dump());
      if (!found.refusal.empty()) {
        ++noticed;
      } else if (listed(found.not_checked, path)) {
        ++told;
      } else {
        ADD_FAILURE() << name << ": " << path << " = " << other << " instead of "
                      << document[place];
      }
    }
  }
  std::printf("%s: %zu leaves, %zu changes noticed, %zu told\n", name, paths.size(), noticed, told);
  return noticed;
}

TEST(EveryLeaf, OfAContourFileIsNoticedWhenItChangesOrListedAsNotChecked) {
  for (const LeafCase& c : leaf_cases()) {
    const json document = json::parse(file_of(c));
    const Judged good = judged(document.dump());
    ASSERT_EQ(good.refusal, "") << c.name;
    std::vector<std::string> paths;
    leaves(document, "", paths);
    paths = few_of_each_kind(paths);
    EXPECT_GT(noticed_changes(c.name, document, paths), paths.size());
  }
}

/// Grades of 2, -1.5 and 1 % at stations and heights from 100 and 50 on, with curves of 60 and
/// 40 between them, by the formulas of textbooks.
json a_profile(bool arcs) {
  json elements = json::array();
  double station = 100.0, height = 50.0;
  const auto grade = [&](double g, double length) {
    elements.push_back({{"kind", "grade"},
                        {"station", station},
                        {"length", length},
                        {"height", height},
                        {"grade_start", g},
                        {"grade_end", g},
                        {"radius", 0}});
    station += length;
    height += g * length;
  };
  const auto curve = [&](double g0, double g1, double length) {
    const double a0 = std::atan(g0), a1 = std::atan(g1);
    const double radius = arcs ? length / (std::sin(a1) - std::sin(a0)) : length / (g1 - g0);
    elements.push_back({{"kind", g1 > g0 ? "sag" : "crest"},
                        {"station", station},
                        {"length", length},
                        {"height", height},
                        {"grade_start", g0},
                        {"grade_end", g1},
                        {"radius", radius}});
    station += length;
    height += arcs ? radius * (std::cos(a0) - std::cos(a1)) : 0.5 * (g0 + g1) * length;
  };
  grade(0.02, 80.0);
  curve(0.02, -0.015, 60.0);
  grade(-0.015, 0.5);
  curve(-0.015, 0.01, 40.0);
  grade(0.01, 120.0);
  return {{"curves", arcs ? "arcs" : "parabolas"},
          {"end_station", station},
          {"end_height", height},
          {"elements", elements}};
}

TEST(EveryLeaf, OfAProfileIsNoticedWhenItChanges) {
  for (const bool arcs : {false, true}) {
    json document = json::parse(file_of(leaf_cases().front()));
    document["alignment"] = {{"first_station", 100.0}, {"profile", a_profile(arcs)}};
    const Judged good = judged(document.dump());
    ASSERT_EQ(good.refusal, "");
    // where it lies as a whole, and that it is the ground's, nothing in the file says
    for (const std::string& one : good.not_checked) {
      if (one.find("/alignment/profile") == std::string::npos) continue;
      EXPECT_EQ(one, "/alignment/profile (only that its elements agree with each other)");
    }
    EXPECT_TRUE(listed(good.not_checked, "/alignment/profile"));
    std::vector<std::string> paths;
    leaves(document["alignment"]["profile"], "/alignment/profile", paths);
    EXPECT_EQ(paths.size(), 3U + 5U * 7U);
    EXPECT_GE(noticed_changes("profile", document, paths), paths.size());
    // the other word for what rounds the corners is another curve
    document["alignment"]["profile"]["curves"] = arcs ? "parabolas" : "arcs";
    EXPECT_NE(judged(document.dump()).refusal, "");
  }
}

/// A file whose stations are rounded to a thousandth says within what they meet.
TEST(EveryLeaf, OfAProfileWhoseElementsMeetRoundedIsListed) {
  json document = json::parse(file_of(leaf_cases().front()));
  json profile = a_profile(false);
  profile["elements"][2]["length"] = 0.5002;
  document["alignment"] = {{"first_station", 100.0}, {"profile", profile}};
  const Judged found = judged(document.dump());
  EXPECT_EQ(found.refusal, "");
  for (const char* field :
       {"/alignment/profile/elements/*/station", "/alignment/profile/end_height"}) {
    EXPECT_TRUE(listed(found.not_checked, field)) << field;
  }
}

TEST(EveryLeaf, UnknownFieldsAreListedOnceForAllItems) {
  json document = json::parse(file_of(leaf_cases().front()));
  document["author"] = "somebody";
  document["report"]["mood"] = {{"good", true}};
  for (json& piece : document["pieces"]) piece["colour"] = "red";
  const Judged found = judged(document.dump());
  EXPECT_EQ(found.refusal, "");
  for (const char* field : {"/author", "/report/mood", "/pieces/*/colour"}) {
    EXPECT_EQ(std::count(found.not_checked.begin(), found.not_checked.end(), field), 1) << field;
  }
  const Judged before = judged(file_of(leaf_cases().front()));
  EXPECT_EQ(found.not_checked.size(), before.not_checked.size() + 3);
}

TEST(EveryLeaf, EveryFieldThatStandsTwiceIsRefusedWithItsPlace) {
  const std::string text = file_of(leaf_cases().front());
  std::set<std::string> names;
  std::size_t tried = 0;
  for (std::size_t at = text.find("\":"); at != std::string::npos; at = text.find("\":", at + 1)) {
    const std::size_t from = text.rfind('"', at - 1);
    const std::string name = text.substr(from, at - from + 1);
    if (!names.insert(name).second) continue;
    std::string twice = text;
    twice.insert(from, name + ": 0, ");
    const auto stored = contour_from_json(twice, "file");
    ASSERT_FALSE(stored) << name;
    EXPECT_NE(stored.error().what.find(name + " stands twice"), std::string::npos)
        << name << ": " << stored.error().what;
    EXPECT_EQ(stored.error().where.rfind("file:", 0), 0u) << stored.error().where;
    ++tried;
  }
  EXPECT_GT(tried, 40u);
}

}  // namespace
}  // namespace obvid
