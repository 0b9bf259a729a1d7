// SPDX-License-Identifier: Apache-2.0
// Curves in space from corner to corner (format obvid-space-chain): docs/methods/judge.md.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "command_checks.h"

namespace judge {
namespace {

constexpr Real kSameTurnRad = 1e-9L;

/// Tangent of a part at one of its ends, of length 1; and the place.
SpaceJet end_jet(const SpaceCourse& part, bool last) {
  SpaceJet out;
  if (part.planar) {
    const Course& plan = part.plan->course;
    const Span& span = last ? plan.path.spans().back() : plan.path.spans().front();
    const Jet jet = span.at(last ? 1.0L : 0.0L);
    out.p = part.frame.at(jet.p + Vec{plan.origin.x, plan.origin.y});
    out.d = jet.d.x * part.frame.x + jet.d.y * part.frame.y;
  } else {
    out = part.at(last ? part.heights->course.path.end() : 0.0L, last);
  }
  out.d = (1.0L / norm(out.d)) * out.d;
  return out;
}

class ChainCheck {
 public:
  ChainCheck(const SpaceChainFile& chain, const Json& json, Sheet& sheet)
      : c_(chain), json_(json), sheet_(sheet) {}

  void run() {
    const std::size_t wanted = c_.corners.size() + (c_.closed ? 0 : 1);
    if (c_.parts.size() != wanted || c_.corners.empty()) {
      return sheet_.fails("chain.parts", std::to_string(wanted), std::to_string(c_.parts.size()),
                          "");
    }
    Real move = 0.0L;
    for (std::size_t k = 0; k < c_.parts.size(); ++k) {
      const Json& part = member(json_, "parts").items[k];
      check_space(*c_.parts[k], part, sheet_, true);
      points(k);
      move = std::max(move, static_cast<Real>(figure(part, "largest_move").value.value_or(1e300)));
    }
    const Real stated = figure(json_, "largest_move").value.value_or(-1.0);
    sheet_.expect(stated >= move, "chain.largest_move", stated, move, "");
    for (std::size_t k = 0; k < c_.corners.size(); ++k) corner(k);
  }

 private:
  /// Walks the points once, cutting at corners.
  void points(std::size_t k) {
    const std::size_t n = c_.points.size();
    std::size_t i = c_.closed ? c_.corners[k].point : k == 0 ? 0 : c_.corners[k - 1].point;
    const std::vector<Vec3>& own = c_.parts[k]->points;
    for (std::size_t j = 0; j < own.size(); ++j, ++i) {
      const Real off = norm(own[j] - c_.points[i % n]);
      sheet_.expect(off == 0.0L && (c_.closed || i < n), "chain.points", 0.0L, off,
                    fmt::format("part {}, point {}", k + 1, j + 1));
    }
    const std::size_t end = (i - 1) % n;
    const std::size_t due = c_.closed               ? c_.corners[(k + 1) % c_.corners.size()].point
                            : k < c_.corners.size() ? c_.corners[k].point
                                                    : n - 1;
    sheet_.expect(end == due, "chain.points", static_cast<Real>(due), static_cast<Real>(end),
                  fmt::format("end of part {}", k + 1));
  }

  void corner(std::size_t k) {
    const std::size_t count = c_.corners.size();
    const SpaceCourse& before = *c_.parts[c_.closed ? (k + count - 1) % count : k];
    const SpaceCourse& behind = *c_.parts[c_.closed ? k : k + 1];
    const SpaceJet in = end_jet(before, true), out = end_jet(behind, false);
    const Vec3 place = c_.points[c_.corners[k].point];
    const Real near = before.resolution() + behind.resolution();
    const std::string where = fmt::format("corner {}", k + 1);
    for (const Real off : {norm(in.p - place), norm(out.p - place),
                           norm(before.nurbs.at(before.nurbs.to()).p - place),
                           norm(behind.nurbs.at(behind.nurbs.from()).p - place)}) {
      sheet_.expect(off <= near, "chain.corner", 0.0L, off, where);
    }
    // by the chord between both unit tangents
    const Real turn = 2.0L * std::asin(std::min(1.0L, 0.5L * norm(out.d - in.d)));
    const Real stated = c_.corners[k].turn;
    // a chord of two unit vectors says little of angles near half a turn
    const Real blur = 4e-9L * (1.0L / std::max(1e-6L, std::abs(std::cos(0.5L * turn))));
    sheet_.expect(std::abs(turn - stated) <= kSameTurnRad + blur, "chain.turn", stated, turn,
                  where);
  }

  const SpaceChainFile& c_;
  const Json& json_;
  Sheet& sheet_;
};

}  // namespace

ReadChain read_chain(const Json& json) {
  ReadChain out;
  out.chain = std::make_unique<SpaceChainFile>();
  try {
    out.chain->closed = json.at("closed").truth();
    for (const Json& p : json.at("points").items) {
      out.chain->points.push_back(
          {p.items.at(0).real(), p.items.at(1).real(), p.items.at(2).real()});
    }
    for (const Json& one : json.at("corners").items) {
      const auto point = static_cast<std::size_t>(one.at("point").real());
      if (point >= out.chain->points.size()) throw std::runtime_error("no such point at a corner");
      out.chain->corners.push_back({point, one.at("turn").real()});
    }
    for (const Json& one : json.at("parts").items) {
      ReadSpace part = read_space(one);
      if (!part.fault.empty()) throw std::runtime_error(part.fault);
      out.chain->parts.push_back(std::move(part.curve));
    }
  } catch (const std::exception& error) {
    out.fault = error.what();
  }
  return out;
}

void check_chain(const SpaceChainFile& chain, const Json& json, Sheet& sheet) {
  ChainCheck(chain, json, sheet).run();
}

void check_chain_input(const SpaceChainFile& chain, const std::vector<Vec3>& points, Sheet& sheet) {
  const std::size_t n = chain.points.size();
  const bool again = chain.closed && points.size() == n + 1;
  sheet.expect(points.size() == n || again, "chain.points as read",
               static_cast<Real>(points.size()), static_cast<Real>(n), "");
  for (std::size_t i = 0; i < std::min(points.size(), n); ++i) {
    const Real off = norm(points[i] - chain.points[i]);
    sheet.expect(off == 0.0L, "chain.points as read", 0.0L, off, fmt::format("point {}", i + 1));
  }
}

}  // namespace judge
