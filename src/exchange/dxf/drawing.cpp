// SPDX-License-Identifier: Apache-2.0
#include "dxf/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "dxf/text.h"
#include "obvid/series/internal/straight_rows.h"

namespace obvid::dxf {
namespace {

constexpr int kDeepest = 32;  // inserts inside blocks that are inserted; CAD systems stay below 10
/// Entities, points and knots that inserts may bring about: a file of a few lines can ask for
/// billions. A piece takes 224 bytes.
constexpr std::size_t kMostWork = 500'000;
constexpr double kLevel = 1e-9;  // of the size: heights that differ by less are equal

constexpr const char* kTooMuch =
    "blocks expand to more than 500,000 entities and points; what goes beyond is missing";

/// Whether the lines of a polyline are chords of a curve, so that its vertices are points of it.
bool is_sampled(const Link& link, bool closed) {
  std::vector<Vec2> points;
  for (const Piece& piece : link.pieces) points.push_back(start_point(piece));
  if (!closed) points.push_back(end_point(link.pieces.back()));
  return chords_of_curve(points, closed);
}

std::size_t work_of(const Entity& e) { return 1 + e.points.size() + e.fit.size() + e.knots.size(); }

}  // namespace

void Remarks::add(const Fault& fault, const std::string& first) {
  const auto [row, added] = seen_.try_emplace(fault.reason, Row{first, fault.detail, 0});
  if (!added) ++row->second.more;
}

void Remarks::tell(const char* what, std::vector<std::string>& warnings) const {
  for (const auto& [reason, row] : seen_) {
    std::string sentence = fmt::format("{} {}: {}", row.first, what, reason);
    if (!row.detail.empty()) sentence += " (" + row.detail + ")";
    if (row.more > 0) sentence += fmt::format("; and {} more", row.more);
    warnings.push_back(std::move(sentence));
  }
}

void DrawingBuilder::run(const Affine& map) {
  draw(document_.entities, map, {});
  take_chains();
  take_points();
  tell();
}

void DrawingBuilder::draw(const std::vector<Entity>& entities, const Affine& map,
                          const Place& place) {
  for (const Entity& entity : entities) {
    if (place.depth > 0 && work_ > kMostWork) return;
    draw(entity, map, place);
  }
}

void DrawingBuilder::draw(const Entity& entity, const Affine& map, const Place& place) {
  if (place.depth > 0) {
    work_ += work_of(entity);
  } else if (entity.paper) {
    ++paper_;
    return;
  }
  if (entity.kind == Kind::kOther) {
    ++others_[entity.type];
    return;
  }
  // Layer 0 inside a block is the layer of its insert.
  const bool inherits = place.depth > 0 && entity.layer == "0";
  const Source source{&entity, inherits ? place.layer : entity.layer, place.block};
  if (is_hidden(entity, source.layer)) return;
  if (entity.kind == Kind::kInsert) return insert(entity, map, {source.layer, {}, place.depth});
  Shape shape = shape_of(entity, map);
  if (shape.fault.reason != nullptr) return leave_out(shape.fault, source);
  see_heights(shape, source);
  add(std::move(shape), source);
}

void DrawingBuilder::insert(const Entity& entity, const Affine& map, const Place& place) {
  const Source source{&entity, place.layer, {}};
  if (entity.fault.reason != nullptr) return leave_out(entity.fault, source);
  const auto block = document_.blocks.find(entity.block);
  if (block == document_.blocks.end()) {
    return leave_out({"there is no such block", to_label(entity.block)}, source);
  }
  if (place.depth >= kDeepest)
    return leave_out({"blocks contain each other, or too many", {}}, source);
  if (entity.scale.x == 0.0 || entity.scale.y == 0.0)
    return leave_out({"its scale is 0", {}}, source);
  insert_array(entity, block->second, map, {place.layer, entity.block, place.depth + 1});
  if (work_ > kMostWork) leave_out({kTooMuch, {}}, source);
}

void DrawingBuilder::insert_array(const Entity& e, const Block& block, const Affine& map,
                                  const Place& place) {
  const Point3 back{-block.base.x, -block.base.y, -block.base.z};
  const Affine frame = map * plane_to_space(e.normal) * translation(e.at) * rotation(e.from);
  const Affine inner = scaling(e.scale) * translation(back);
  for (int row = 0; row < std::max(1, e.rows); ++row) {
    for (int column = 0; column < std::max(1, e.columns); ++column) {
      if (++work_ > kMostWork) return;
      const Affine step = translation({column * e.column_step, row * e.row_step, 0.0});
      draw(block.entities, frame * step * inner, place);
    }
  }
}

void DrawingBuilder::leave_out(const Fault& fault, const Source& source) {
  ++drawing_.left_out;
  if (left_out_.knows(fault.reason)) {
    left_out_.count(fault.reason);
  } else {
    left_out_.add(fault, label(source) + place_of(*source.entity));
  }
}

bool DrawingBuilder::is_hidden(const Entity& entity, std::string_view layer) {
  const auto state = document_.hidden_layers.find(layer);
  const bool layer_hides = state != document_.hidden_layers.end() &&
                           (entity.kind != Kind::kInsert || state->second == LayerState::kFrozen);
  if (layer_hides) {
    ++hidden_[layer];
  } else if (entity.invisible) {
    ++hidden_[{}];
  }
  return layer_hides || entity.invisible;
}

void DrawingBuilder::see_heights(const Shape& shape, const Source& source) {
  low_ = heights_ ? std::min(low_, shape.low) : shape.low;
  high_ = heights_ ? std::max(high_, shape.high) : shape.high;
  heights_ = true;
  constexpr const char* kClimbs = "its height z is not constant, and dropped";
  double size = 0.0;
  for (const Piece& piece : shape.pieces) {
    size = std::max(size, norm(end_point(piece) - start_point(shape.pieces.front())));
  }
  for (const Vec2 p : shape.points) size = std::max(size, norm(p - shape.points.front()));
  if (shape.high - shape.low <= kLevel * size) return;
  if (dropped_.knows(kClimbs)) {
    dropped_.count(kClimbs);
  } else {
    dropped_.add({kClimbs, fmt::format("from {:.6g} to {:.6g}", shape.low, shape.high)},
                 label(source) + place_of(*source.entity));
  }
}

void DrawingBuilder::add(Shape shape, const Source& source) {
  if (source.entity->kind == Kind::kPoint) {
    points_.push_back(shape.points.front());
    return;
  }
  if (!shape.points.empty()) return add_fit_points(shape, source);
  const auto layer = layers_.try_emplace(source.layer, layers_.size()).first->second;
  // One line may be a part of a chain; it is no list of points.
  polygon_.push_back(shape.polygon && shape.pieces.size() > 1);
  links_.push_back({std::move(shape.pieces), shape.closed, layer, shape.arcs_more});
  sources_.push_back(source);
}

void DrawingBuilder::add_fit_points(const Shape& shape, const Source& source) {
  PointSeries series;
  series.name = "fit points of " + label(source);
  series.layer = to_label(source.layer, kLongestName);
  series.units = drawing_.units;
  series.points = shape.points;
  if (shape.closed && series.points.back() != series.points.front()) {
    series.points.push_back(series.points.front());
  }
  series.spline = ThroughPoints{label(source), shape.start, shape.end};
  drawing_.series.push_back(std::move(series));
}

void DrawingBuilder::take_chains() {
  const Chains joined = join(links_);
  if (joined.duplicates > 0) {
    drawing_.warnings.push_back(fmt::format("{} on others and {} taken once",
                                            joined.duplicates == 1
                                                ? "1 entity lies"
                                                : fmt::format("{} entities lie", joined.duplicates),
                                            joined.duplicates == 1 ? "was" : "were"));
  }
  for (const Chain& chain : joined.chains) {
    const std::size_t first = chain.members.front().link;
    if (chain.members.size() == 1 && polygon_[first] && is_sampled(links_[first], chain.closed)) {
      take_series(links_[first], sources_[first], chain.closed);
      continue;
    }
    DrawnCurve curve{label(chain), {}, chain.closed, to_label(sources_[first].layer, kLongestName)};
    curve.id = id_of(sources_[first]);
    for (const Chain::Member& member : chain.members) {
      std::vector<Piece>& pieces = links_[member.link].pieces;
      if (member.reversed) {
        std::reverse(pieces.begin(), pieces.end());
        for (Piece& piece : pieces) piece = reversed(piece);
      }
      curve.pieces.insert(curve.pieces.end(), pieces.begin(), pieces.end());
      std::vector<Piece>().swap(pieces);
      curve.arcs_more += links_[member.link].arcs_more;
    }
    drawing_.curves.push_back(std::move(curve));
  }
}

void DrawingBuilder::take_series(const Link& link, const Source& source, bool closed) {
  PointSeries series;
  series.name = label(source);
  series.id = id_of(source);
  series.layer = to_label(source.layer, kLongestName);
  series.units = drawing_.units;
  series.points.push_back(start_point(link.pieces.front()));
  for (const Piece& piece : link.pieces) series.points.push_back(end_point(piece));
  if (closed) series.points.back() = series.points.front();
  drawing_.series.push_back(std::move(series));
}

void DrawingBuilder::take_points() {
  if (points_.empty()) return;
  PointSeries series;
  series.name =
      fmt::format("{} POINT {}", points_.size(), points_.size() == 1 ? "entity" : "entities");
  series.kind = SeriesKind::kLoose;
  series.units = drawing_.units;
  series.points = std::move(points_);
  drawing_.series.push_back(std::move(series));
}

void DrawingBuilder::tell() {
  constexpr std::size_t kMostKinds = 12;  // that one sentence names
  left_out_.tell("was left out", drawing_.warnings);
  dropped_.tell("is drawn flat", drawing_.warnings);
  double size = 0.0;
  const auto see = [&](Vec2 p) { size = std::max({size, std::abs(p.x), std::abs(p.y)}); };
  for (const DrawnCurve& curve : drawing_.curves) {
    for (const Piece& piece : curve.pieces) see(end_point(piece));
  }
  for (const PointSeries& series : drawing_.series) {
    for (const Vec2 p : series.points) see(p);
  }
  if (heights_ && high_ - low_ > kLevel * size) {
    drawing_.warnings.push_back(
        fmt::format("heights z from {:.6g} to {:.6g} were dropped", low_, high_));
  }
  if (paper_ > 0) {
    drawing_.warnings.push_back(fmt::format("{} {} of the paper space not drawn", paper_,
                                            paper_ == 1 ? "entity was" : "entities were"));
  }
  for (const auto& [layer, count] : hidden_) {
    const std::string which =
        layer.empty()
            ? "invisible"
            : fmt::format(
                  "on layer {}, which is {}", to_label(layer),
                  document_.hidden_layers.at(layer) == LayerState::kFrozen ? "frozen" : "off");
    drawing_.warnings.push_back(
        fmt::format("{} {}: left out",
                    count == 1 ? "1 entity is" : fmt::format("{} entities are", count), which));
  }
  if (others_.empty()) return;
  std::vector<std::pair<std::size_t, std::string_view>> kinds;
  for (const auto& [kind, count] : others_) kinds.emplace_back(count, kind);
  std::sort(kinds.rbegin(), kinds.rend());
  std::string list;
  for (std::size_t i = 0; i < std::min(kinds.size(), kMostKinds); ++i) {
    list += fmt::format("{}{} {}", i == 0 ? "" : ", ", kinds[i].first, to_label(kinds[i].second));
  }
  if (kinds.size() > kMostKinds)
    list += fmt::format(" and {} other kinds", kinds.size() - kMostKinds);
  const bool text = others_.contains("TEXT") || others_.contains("MTEXT");
  drawing_.warnings.push_back("not drawn, being neither curves nor points: " + list +
                              (text ? ": text is a curve where it is converted to paths" : ""));
}

std::string DrawingBuilder::place_of(const Entity& entity) const {
  if (entity.handle.empty()) return {};  // then the label says it
  return fmt::format(" ({} {})", binary_ ? "byte" : "line", entity.line);
}

std::string DrawingBuilder::id_of(const Source& source) {
  const Entity& e = *source.entity;
  return e.handle.empty() ? "" : to_label(e.type) + "-" + to_label(e.handle);
}

std::string DrawingBuilder::label(const Source& source) const {
  const Entity& e = *source.entity;
  std::string out = to_label(e.type);
  out += e.handle.empty() ? fmt::format(" at {} {}", binary_ ? "byte" : "line", e.line)
                          : " " + to_label(e.handle);
  out += " on layer " + to_label(source.layer);
  if (!source.block.empty()) out += " in block " + to_label(source.block);
  return out;
}

std::string DrawingBuilder::label(const Chain& chain) const {
  const Source& first = sources_[chain.members.front().link];
  if (chain.members.size() == 1) return label(first);
  std::map<std::string_view, std::size_t> kinds;
  for (const Chain::Member& member : chain.members) ++kinds[sources_[member.link].entity->type];
  std::string list;
  for (const auto& [kind, count] : kinds) {
    list += fmt::format("{}{} {}", list.empty() ? "" : " and ", count, to_label(kind));
  }
  return list + ", from " + label(first);
}

}  // namespace obvid::dxf
