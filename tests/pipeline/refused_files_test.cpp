// SPDX-License-Identifier: Apache-2.0
// Contour files that were made to pass and must not, each refused for its own reason; and the same
// contours without the trick, which pass.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "../common/text.h"
#include "obvid/io/contour_json.h"
#include "obvid/pipeline/fit.h"

namespace obvid {
namespace {

using nlohmann::json;

std::string text_of(const std::string& name) {
  std::string text = text_of_file(OBVID_TEST_DATA "/refuse/" + name);
  EXPECT_FALSE(text.empty()) << name;
  return text;
}

/// Code and words with which the file is refused; empty when it is accepted.
std::string words_of_refusal(const std::string& text) {
  const auto stored = contour_from_json(text, "file");
  if (!stored) {
    return "E" + std::to_string(static_cast<int>(stored.error().code)) + " " + stored.error().what +
           " (" + stored.error().where + ")";
  }
  const Verification v = verify(*stored);
  if (v.false_claim) return "E503 " + v.false_claim->what;
  return v.certificate.proved ? "" : "E501 " + v.certificate.reason;
}

TEST(RefusedFiles, EachIsRefusedForItsOwnReason) {
  const std::vector<std::array<std::string, 3>> expected = {
      {"A_scale_clothoids.json", "E501", "the curvature gap at joint 3 is 0.44"},
      {"A2_scale_arcs.json", "E501", "jumps the other way before piece 4"},
      {"B_theta.json", "E308", "the heading is turns beyond its contour (file: /pieces/0)"},
      {"C_exact_origin.json", "E308", "the origin lies farther from the contour"},
      {"C_exact_kink.json", "E308", "not the rounded sum of origin and offset"},
      {"D_weights_underflow_0.9.json", "E309", "the weights are out of range (file: /pieces/1)"},
      {"D_weights_underflow_1.15.json", "E309", "the weights are out of range (file: /pieces/1)"},
      {"overflow_lines.json", "E309", "a coordinate is out of range (file: /points/1)"},
      {"E_no_points.json", "E501", "does not name the points that it passes"},
      {"E_shuffled_points.json", "E501", "after the points before it"},
      {"dup_keys.json", "E308", "\"points\" stands twice in its object (file:1:"}};
  for (const auto& [name, code, words] : expected) {
    const std::string refusal = words_of_refusal(text_of(name));
    EXPECT_EQ(refusal.substr(0, 4), code) << name << ": " << refusal;
    EXPECT_NE(refusal.find(words), std::string::npos) << name << ": " << refusal;
  }
  std::size_t files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(OBVID_TEST_DATA) + "/refuse")) {
    files += entry.path().extension() == ".json" ? 1 : 0;
  }
  EXPECT_EQ(files, expected.size()) << "every file of the folder is looked at";
}

/// The document of a file, changed.
std::string with(const std::string& name, const std::function<void(json&)>& change) {
  json document = json::parse(text_of(name));
  change(document);
  return document.dump();
}

/// Arcs one after the other, from their own headings: the ends of each and what names them.
void lay_arcs(json& d) {
  double x = 0.0, y = 0.0;
  for (std::size_t i = 0; i < d["pieces"].size(); ++i) {
    json& arc = d["pieces"][i];
    const double theta = arc["theta0"], kappa = arc["kappa"], length = arc["length"];
    arc["start"] = {x, y};
    x += (std::sin(theta + kappa * length) - std::sin(theta)) / kappa;
    y -= (std::cos(theta + kappa * length) - std::cos(theta)) / kappa;
    arc["end"] = {x, y};
    d["points"][i + 1] = d["elements"][i + 1]["point"] = arc["end"];
  }
}

TEST(RefusedFiles, WithoutTheirTrickTheCurvesAreJudgedForThemselves) {
  // headings near 0: the kink that they hid is seen
  const std::string kink = words_of_refusal(with("B_theta.json", [](json& d) {
    const double turn = 2.0 * std::acos(-1.0);
    for (json& piece : d["pieces"]) {
      piece["theta0"] = std::remainder(piece["theta0"].get<double>(), turn);
    }
    for (json& element : d["elements"]) {
      element["heading"] = std::remainder(element["heading"].get<double>(), turn);
    }
    lay_arcs(d);
  }));
  EXPECT_NE(kink.find("E501"), std::string::npos) << kink;
  EXPECT_NE(kink.find("heading"), std::string::npos) << kink;
  // weights of usual size: the jump of curvature is seen
  for (const char* name : {"D_weights_underflow_0.9.json", "D_weights_underflow_1.15.json"}) {
    const std::string jump = words_of_refusal(with(name, [](json& d) {
      d["carrier"] = "baseline";
      d["runs"] = json::array({{{"first_piece", 0}, {"last_piece", 0}, {"direction", 0}},
                               {{"first_piece", 1}, {"last_piece", 1}, {"direction", -1}}});
      for (json& w : d["pieces"][1]["weights"]) w = w.get<double>() * 0x1p537;
    }));
    EXPECT_NE(jump.find("curvature"), std::string::npos) << name << jump;
  }
}

TEST(RefusedFiles, ControlsWithSoundNumbersPass) {
  // three arcs of one circle, as in B_theta, with their true headings
  json d = json::parse(text_of("B_theta.json"));
  for (std::size_t i = 0; i < 3; ++i) d["pieces"][i]["theta0"] = 0.5 * static_cast<double>(i);
  for (std::size_t i = 0; i < 4; ++i) d["elements"][i]["heading"] = 0.5 * static_cast<double>(i);
  lay_arcs(d);
  EXPECT_EQ(words_of_refusal(d.dump()), "");
  // the decreasing arcs of A2_scale_arcs alone
  json arcs = json::parse(text_of("A2_scale_arcs.json"));
  for (const char* list : {"pieces", "elements", "points"}) arcs[list].erase(arcs[list].begin());
  // pieces 0.9, 0.2 remain, then rise: cut there
  while (arcs["pieces"].size() > 2) {
    for (const char* list : {"pieces", "elements", "points"})
      arcs[list].erase(arcs[list].size() - 1);
  }
  for (std::size_t i = 0; i < 3; ++i) arcs["elements"][i]["source"] = i;
  arcs["elements"][2]["kappa"] = 0.2;
  arcs["elements"][0]["kappa"] = 0.9;
  arcs["runs"] = json::array({{{"first_piece", 0}, {"last_piece", 1}, {"direction", -1}}});
  EXPECT_EQ(words_of_refusal(arcs.dump()), "");
}

/// A fit of the ten points of [000], with its report.
json fit_of_ten_points() {
  PointSeries series;
  series.points = {{0, 0},          {0.21, -5.28},   {-5.11, -10.13}, {-20.48, -7.65},
                   {-28.68, 16.23}, {-13.87, 40.95}, {17.95, 55.28},  {54.24, 53.04},
                   {100.94, 36.19}, {230.38, -50.82}};
  const auto made = fit(series, {});
  EXPECT_TRUE(made);
  return json::parse(contour_to_json({made->contour, made->report, made->certificate, {}}));
}

TEST(RefusedFiles, AToleranceThatNoWidthCanKeepIsRefusedAtOnce) {
  const json good = fit_of_ten_points();
  EXPECT_EQ(words_of_refusal(good.dump()), "");
  for (const json& value :
       {json(0), json(1e-300), json(-1), json(nullptr), json(1e-11), json("1")}) {
    json bad = good;
    bad["report"]["tolerance"] = value;
    const auto start = std::chrono::steady_clock::now();
    const std::string refusal = words_of_refusal(bad.dump());
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    EXPECT_NE(refusal.find("/report/tolerance"), std::string::npos) << value << refusal;
    EXPECT_LT(took.count(), 1.0) << value;
  }
}

TEST(RefusedFiles, ALeastToleranceEndsInTime) {
  json bad = fit_of_ten_points();
  bad["report"]["tolerance"] = 4e-10;  // just above 1e-12 of the size
  const auto start = std::chrono::steady_clock::now();
  EXPECT_NE(words_of_refusal(bad.dump()), "") << "the elements that the file names do not do";
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_LT(took.count(), 5.0);
}

TEST(RefusedFiles, ABoundBeyondTheVerticesOfAProvedContourIsRefused) {
  json bad = fit_of_ten_points();
  bad["report"]["vertices_lower_bound"] = bad["report"]["vertices"].get<int>() + 1;
  const std::string refusal = words_of_refusal(bad.dump());
  EXPECT_NE(refusal.find("vertices_lower_bound beyond the vertices"), std::string::npos) << refusal;
}

TEST(RefusedFiles, ACarrierThatThePiecesAreNotIsRefusedByItsPlace) {
  for (const char* name : {"bspline", "conics", "beziers", "clothoids", "arcs", "cubic"}) {
    json bad = fit_of_ten_points();
    bad["carrier"] = name;
    const std::string refusal = words_of_refusal(bad.dump());
    EXPECT_EQ(refusal.substr(0, 4), "E503") << refusal;
    EXPECT_NE(refusal.find(std::string("carrier ") + name + " has"), std::string::npos) << refusal;
  }
}

}  // namespace
}  // namespace obvid
