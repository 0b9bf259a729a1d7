// SPDX-License-Identifier: Apache-2.0
// B-spline curves in space of a STEP file (ISO 10303-21), by its text alone.
#include <cctype>
#include <cstdlib>
#include <map>

#include "command_checks.h"

namespace judge {
namespace {

/// What stands between the parenthesis at `open` and the one that closes it, parted at its commas.
std::vector<std::string> step_arguments(const std::string& text, std::size_t open) {
  std::vector<std::string> out(1);
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = open; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\'') quoted = !quoted;
    if (!quoted && c == ')' && --depth == 0) return out;
    if (!quoted && c == '(' && ++depth == 1) continue;
    if (!quoted && c == ',' && depth == 1) {
      out.emplace_back();
    } else {
      out.back() += c;
    }
  }
  return out;
}

std::vector<Real> step_numbers(const std::string& list) {
  std::vector<Real> out;
  for (const std::string& one : step_arguments(list, 0)) {
    out.push_back(std::strtold(one.c_str(), nullptr));
  }
  return out;
}

/// Arguments of a record with this name, of a simple or a complex instance; empty: it has none.
std::vector<std::string> step_record(const std::string& body, const std::string& name) {
  for (std::size_t at = body.find(name + "("); at != std::string::npos;
       at = body.find(name + "(", at + 1)) {
    const bool begins = at == 0 || body[at - 1] == '(' || body[at - 1] == ')';
    if (begins) return step_arguments(body, at + name.size());
  }
  return {};
}

}  // namespace

std::vector<SpaceNurbs> step_curves(const std::string& text) {
  std::string flat;
  for (const char c : text) {
    if (std::isspace(static_cast<unsigned char>(c)) == 0) flat += c;
  }
  std::map<long, std::string> bodies;
  for (std::size_t at = flat.find("DATA;"); at != std::string::npos;) {
    const std::size_t end = flat.find(';', at + 1);
    if (end == std::string::npos) break;
    if (flat[at + 1] == '#') {
      const std::size_t equals = flat.find('=', at);
      bodies[std::strtol(flat.c_str() + at + 2, nullptr, 10)] =
          flat.substr(equals + 1, end - equals - 1);
    }
    at = flat[at] == 'D' ? flat.find(';', at) : end;
  }
  std::vector<SpaceNurbs> out;
  for (const auto& [id, body] : bodies) {
    auto curve = step_record(body, "B_SPLINE_CURVE");
    auto knots = step_record(body, "B_SPLINE_CURVE_WITH_KNOTS");
    if (knots.empty()) continue;
    if (curve.empty()) {  // one record with all of them, behind a name
      curve = {knots.at(1), knots.at(2)};
      knots.erase(knots.begin(), knots.begin() + 6);
    }
    SpaceNurbs one;
    one.degree = std::atoi(curve.at(0).c_str());
    for (const std::string& point : step_arguments(curve.at(1), 0)) {
      const std::string& place = bodies[std::strtol(point.c_str() + 1, nullptr, 10)];
      const std::vector<Real> c = step_numbers(step_record(place, "CARTESIAN_POINT").at(1));
      one.points.push_back({c.at(0), c.at(1), c.at(2)});
    }
    const std::vector<Real> times = step_numbers(knots.at(0)), values = step_numbers(knots.at(1));
    for (std::size_t k = 0; k < values.size(); ++k) {
      one.knots.insert(one.knots.end(), static_cast<std::size_t>(times.at(k)), values[k]);
    }
    const auto weights = step_record(body, "RATIONAL_B_SPLINE_CURVE");
    one.weights =
        weights.empty() ? std::vector<Real>(one.points.size(), 1.0L) : step_numbers(weights.at(0));
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace judge
