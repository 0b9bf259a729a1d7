// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "dxf/chains.h"
#include "dxf/document.h"
#include "dxf/entity_shape.h"
#include "dxf/units.h"
#include "obvid/exchange/drawing.h"

namespace obvid::dxf {

/// Sentences about what was left out, the same reason once.
class Remarks {
 public:
  /// `first` names the entity, when it is the first with this reason.
  void add(const Fault& fault, const std::string& first);
  [[nodiscard]] bool knows(const char* reason) const { return seen_.count(reason) > 0; }
  void count(const char* reason) { ++seen_.at(reason).more; }
  /// "`first` `what`: `reason` (`detail`); and 3 more".
  void tell(const char* what, std::vector<std::string>& warnings) const;

 private:
  struct Row {
    std::string first, detail;
    std::size_t more = 0;
  };
  std::map<std::string_view, Row> seen_;
};

/// Draws the entities of a document.
class DrawingBuilder {
 public:
  DrawingBuilder(const Document& document, Drawing& drawing, bool binary)
      : document_(document), drawing_(drawing), binary_(binary) {}

  void run(const Affine& map);

 private:
  /// Where an entity came from.
  struct Source {
    const Entity* entity = nullptr;
    std::string_view layer;
    std::string_view block;  ///< of the innermost insert; empty: none
  };
  struct Place {
    std::string_view layer, block;
    int depth = 0;
  };

  void draw(const std::vector<Entity>& entities, const Affine& map, const Place& place);
  void draw(const Entity& entity, const Affine& map, const Place& place);
  void insert(const Entity& entity, const Affine& map, const Place& place);
  void insert_array(const Entity& entity, const Block& block, const Affine& map,
                    const Place& place);
  void add(Shape shape, const Source& source);
  void add_fit_points(const Shape& shape, const Source& source);
  void see_heights(const Shape& shape, const Source& source);
  void leave_out(const Fault& fault, const Source& source);
  /// Whether the drawing does not show it; then it is counted.
  bool is_hidden(const Entity& entity, std::string_view layer);
  void take_chains();
  void take_series(const Link& link, const Source& source, bool closed);
  void take_points();
  void tell();
  [[nodiscard]] static std::string id_of(const Source& source);
  [[nodiscard]] std::string label(const Source& source) const;
  [[nodiscard]] std::string place_of(const Entity& entity) const;
  [[nodiscard]] std::string label(const Chain& chain) const;

  const Document& document_;
  Drawing& drawing_;
  bool binary_;
  std::vector<Link> links_;
  std::vector<Source> sources_;  ///< of the links
  std::vector<bool> polygon_;    ///< likewise
  std::vector<Vec2> points_;
  std::map<std::string_view, std::size_t> layers_;
  std::map<std::string_view, std::size_t> others_;  ///< kinds that are not drawn, how many
  std::map<std::string_view, std::size_t> hidden_;  ///< by layer; invisible ones: ""
  std::size_t paper_ = 0;
  std::size_t work_ = 0;  ///< entities, points and knots that inserts brought about
  double low_ = 0.0, high_ = 0.0;
  bool heights_ = false;
  Remarks left_out_, dropped_;
};

}  // namespace obvid::dxf
