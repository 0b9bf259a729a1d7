// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace obvid::exchange {

/// The properties that say what of an element shows and where.
enum class SvgProperty {
  kDisplay,
  kVisibility,
  kOpacity,
  kFill,
  kStroke,
  kClipPath,
  kMask,
  kTransform
};
inline constexpr std::size_t kSvgProperties = 8;

/// Values of an element, trimmed; empty: not given. Those of styles are in small letters.
class SvgStyle {
 public:
  [[nodiscard]] const std::string& operator[](SvgProperty one) const {
    return values_[static_cast<std::size_t>(one)];
  }
  [[nodiscard]] std::string& operator[](SvgProperty one) {
    return values_[static_cast<std::size_t>(one)];
  }

 private:
  std::array<std::string, kSvgProperties> values_;
};

/// Rules of `style` elements [CSS 2.1]: selectors of names, classes, ids and `*`, with descendants
/// and children; of their declarations those of the properties above.
class SvgStyleSheet {
 public:
  /// The text of one `style` element; later ones win.
  void add(std::string_view css);

  /// Style attribute over rules over attributes; !important over all.
  [[nodiscard]] SvgStyle of(pugi::xml_node node);

  /// Rules that hide elements, perhaps, and were not understood: selectors, or at-rules.
  [[nodiscard]] const std::vector<std::string>& not_understood() const { return not_understood_; }
  /// Whether every rule could be looked at for every element: else there are too many for it.
  [[nodiscard]] bool looked_at_all() const { return room_ > 0; }
  [[nodiscard]] bool is_empty() const { return rules_.empty() && not_understood_.empty(); }

 private:
  struct Declaration {
    SvgProperty property;
    std::string value;
    bool important = false;
  };
  /// A name, an id and classes that one element has; empty: any.
  struct Compound {
    std::string name, id;
    std::vector<std::string> classes;
    bool is_child = false;  ///< of what the compound before it means, not only inside of it
  };
  struct Rule {
    std::vector<Compound> selector;
    std::uint64_t specificity = 0;
    std::size_t declarations = 0;
  };

  static std::vector<Declaration> declarations_of(std::string_view body);
  [[nodiscard]] static bool parse_selector(std::string_view text, Rule& rule);
  void add_rule(std::string_view selectors, std::string_view body);
  void pass_by(std::string_view what);
  void keep(Rule rule);
  void collect(const std::unordered_map<std::string, std::vector<std::size_t>>& from,
               const std::string& key, pugi::xml_node node, std::vector<std::size_t>& out);
  [[nodiscard]] bool matches(const Rule& rule, pugi::xml_node node);
  [[nodiscard]] bool matches(const Rule& rule, std::size_t compound, pugi::xml_node node);
  /// Whether elements around it are what the compounds before that one mean.
  [[nodiscard]] bool lies_in(const Rule& rule, std::size_t compound, pugi::xml_node node);

  std::vector<Rule> rules_;
  std::vector<std::vector<Declaration>> declarations_;
  std::unordered_map<std::string, std::vector<std::size_t>> by_id_, by_class_, by_name_;
  std::vector<std::string> not_understood_;
  std::size_t room_ = std::size_t{1} << 24U;  ///< of elements looked at for a rule: seconds
};

}  // namespace obvid::exchange
