// SPDX-License-Identifier: Apache-2.0
#include "svg/style_sheet.h"

#include <algorithm>
#include <cctype>
#include <optional>
#include <tuple>

#include "xml_text.h"

namespace obvid::exchange {
namespace {

using std::string_view;

constexpr std::array<string_view, kSvgProperties> kPropertyNames = {
    "display", "visibility", "opacity", "fill", "stroke", "clip-path", "mask", "transform"};
constexpr std::size_t kMostNotUnderstood = 8;  // that are named
constexpr std::size_t kMostCompounds = 16;     // of a selector

std::string in_small_letters(string_view text) {
  std::string out(text);
  for (char& c : out) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return out;
}

std::optional<SvgProperty> property_called(string_view name) {
  const auto* found = std::find(kPropertyNames.begin(), kPropertyNames.end(), name);
  if (found == kPropertyNames.end()) return std::nullopt;
  return static_cast<SvgProperty>(found - kPropertyNames.begin());
}

bool hides(SvgProperty one) {
  return one == SvgProperty::kDisplay || one == SvgProperty::kVisibility ||
         one == SvgProperty::kOpacity;
}

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

bool is_of_name(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' ||
         static_cast<unsigned char>(c) >= 0x80U;
}

/// Whether a property that hides elements is set somewhere in it.
bool may_hide(string_view text) {
  const std::string small = in_small_letters(text);
  for (std::size_t i = 0; i < small.size();) {
    const std::size_t begin = i;
    while (i < small.size() && is_of_name(small[i])) ++i;
    const std::size_t end = i;
    while (i < small.size() && is_blank(small[i])) ++i;
    const auto property = property_called(string_view(small).substr(begin, end - begin));
    if (property && hides(*property) && i < small.size() && small[i] == ':') return true;
    if (i == begin) ++i;
  }
  return false;
}

/// Comments are blanks.
std::string without_comments(string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t begin = text.find("/*");
    out += text.substr(0, begin);
    if (begin == string_view::npos) break;
    out += ' ';
    const std::size_t end = text.find("*/", begin + 2);
    text.remove_prefix(end == string_view::npos ? text.size() : end + 2);
  }
  return out;
}

/// Where one of `ends` stands outside of quotes and brackets; the size of the text: nowhere.
std::size_t end_of(string_view text, string_view ends) {
  int depth = 0;
  char quote = '\0';
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\\') {
      ++i;
    } else if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (depth == 0 && ends.find(c) != string_view::npos) {
      return i;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '(' || c == '[' || c == '{') {
      ++depth;
    } else if ((c == ')' || c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return text.size();
}

/// Words of a class attribute.
std::vector<std::string> words_of(string_view text) {
  std::vector<std::string> out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t begin = i;
    while (i < text.size() && !is_blank(text[i])) ++i;
    if (i > begin) out.emplace_back(text.substr(begin, i - begin));
    while (i < text.size() && is_blank(text[i])) ++i;
  }
  return out;
}

}  // namespace

void SvgStyleSheet::add(string_view css) {
  const std::string plain = without_comments(css);
  string_view rest = plain;
  while (!(rest = trimmed(rest)).empty()) {
    bool mark = false;
    for (const string_view one : {"<!--", "-->"}) {
      if (!rest.starts_with(one)) continue;
      rest.remove_prefix(one.size());
      mark = true;
    }
    if (mark) continue;
    const bool at_rule = rest.front() == '@';
    const std::size_t open = end_of(rest, at_rule ? "{;" : "{");
    const string_view head = rest.substr(0, open);
    if (open == rest.size() || rest[open] == ';') {
      if (in_small_letters(head).starts_with("@import") || may_hide(head)) pass_by(head);
      rest.remove_prefix(std::min(rest.size(), open + 1));
      continue;
    }
    rest.remove_prefix(open + 1);
    const std::size_t close = end_of(rest, "}");
    const string_view body = rest.substr(0, close);
    rest.remove_prefix(std::min(rest.size(), close + 1));
    if (!at_rule && body.find('{') == string_view::npos) {
      add_rule(head, body);
    } else if (may_hide(body)) {
      pass_by(head);
    }
  }
}

std::vector<SvgStyleSheet::Declaration> SvgStyleSheet::declarations_of(string_view body) {
  std::vector<Declaration> out;
  while (!body.empty()) {
    const std::size_t end = end_of(body, ";");
    const string_view one = body.substr(0, end);
    body.remove_prefix(std::min(body.size(), end + 1));
    const std::size_t colon = one.find(':');
    if (colon == string_view::npos) continue;
    const auto property = property_called(in_small_letters(trimmed(one.substr(0, colon))));
    if (!property) continue;
    std::string value = in_small_letters(trimmed(one.substr(colon + 1)));
    const std::size_t mark = value.rfind('!');
    const bool important =
        mark != std::string::npos && trimmed(string_view(value).substr(mark + 1)) == "important";
    if (important) value = trimmed(string_view(value).substr(0, mark));
    if (!value.empty()) out.push_back({*property, std::move(value), important});
  }
  return out;
}

/// False: there is more in it than names, classes, ids, blanks and '>'.
bool SvgStyleSheet::parse_selector(string_view text, Rule& rule) {
  std::uint64_t ids = 0, classes = 0, names = 0;
  bool child = false;
  for (std::size_t i = 0; i < text.size();) {
    if (is_blank(text[i])) {
      ++i;
      continue;
    }
    if (text[i] == '>') {
      if (child || rule.selector.empty()) return false;
      child = true;
      ++i;
      continue;
    }
    Compound one;
    one.is_child = child;
    child = false;
    bool first = true;
    for (; i < text.size() && !is_blank(text[i]) && text[i] != '>'; first = false) {
      const char kind = text[i];
      if (kind == '*' && first) {
        ++i;
        continue;
      }
      if (kind == '.' || kind == '#') ++i;
      const std::size_t begin = i;
      while (i < text.size() && is_of_name(text[i])) ++i;
      if (i == begin) return false;
      std::string word(text.substr(begin, i - begin));
      if (kind == '.') {
        one.classes.push_back(std::move(word));
        ++classes;
      } else if (kind == '#') {
        if (!one.id.empty() && one.id != word) return false;
        one.id = std::move(word);
        ++ids;
      } else {
        if (!first) return false;
        one.name = std::move(word);
        ++names;
      }
    }
    rule.selector.push_back(std::move(one));
    if (rule.selector.size() > kMostCompounds) return false;
  }
  constexpr std::uint64_t kMost = 0xFFFFU;
  rule.specificity =
      (std::min(ids, kMost) << 32U) | (std::min(classes, kMost) << 16U) | std::min(names, kMost);
  return !child && !rule.selector.empty();
}

void SvgStyleSheet::add_rule(string_view selectors, string_view body) {
  std::vector<Declaration> all = declarations_of(body);
  if (all.empty()) return;
  const bool hiding = std::any_of(all.begin(), all.end(),
                                  [](const Declaration& one) { return hides(one.property); });
  const std::size_t declarations = declarations_.size();
  declarations_.push_back(std::move(all));
  while (!selectors.empty()) {
    const std::size_t end = end_of(selectors, ",");
    const string_view one = trimmed(selectors.substr(0, end));
    selectors.remove_prefix(std::min(selectors.size(), end + 1));
    Rule rule;
    rule.declarations = declarations;
    if (parse_selector(one, rule)) {
      keep(std::move(rule));
    } else if (hiding) {
      pass_by(one);
    }
  }
}

void SvgStyleSheet::pass_by(string_view what) {
  if (not_understood_.size() < kMostNotUnderstood) not_understood_.emplace_back(trimmed(what));
}

/// Where it is looked for: by the id, a class or the name of the element that it means.
void SvgStyleSheet::keep(Rule rule) {
  const Compound& last = rule.selector.back();
  const std::size_t number = rules_.size();
  if (!last.id.empty()) {
    by_id_[last.id].push_back(number);
  } else if (!last.classes.empty()) {
    by_class_[last.classes.front()].push_back(number);
  } else {
    by_name_[last.name].push_back(number);  // of any: ""
  }
  rules_.push_back(std::move(rule));
}

void SvgStyleSheet::collect(const std::unordered_map<std::string, std::vector<std::size_t>>& from,
                            const std::string& key, pugi::xml_node node,
                            std::vector<std::size_t>& out) {
  const auto found = from.find(key);
  if (found == from.end()) return;
  for (const std::size_t rule : found->second) {
    if (matches(rules_[rule], node)) out.push_back(rule);
  }
}

bool SvgStyleSheet::matches(const Rule& rule, std::size_t compound, pugi::xml_node node) {
  if (room_ == 0) return false;
  --room_;
  const Compound& one = rule.selector[compound];
  if (!one.name.empty() && local_name(node) != one.name) return false;
  if (!one.id.empty() && node.attribute("id").value() != one.id) return false;
  if (one.classes.empty()) return true;
  const string_view all = node.attribute("class").value();
  room_ -= std::min(room_, all.size());
  const std::vector<std::string> classes = words_of(all);
  return std::all_of(one.classes.begin(), one.classes.end(), [&](const std::string& wanted) {
    return std::find(classes.begin(), classes.end(), wanted) != classes.end();
  });
}

bool SvgStyleSheet::matches(const Rule& rule, pugi::xml_node node) {
  const std::size_t last = rule.selector.size() - 1;
  return matches(rule, last, node) && lies_in(rule, last, node);
}

bool SvgStyleSheet::lies_in(const Rule& rule, std::size_t compound, pugi::xml_node node) {
  if (compound == 0) return true;
  for (pugi::xml_node outer = node.parent(); outer.type() == pugi::node_element;
       outer = outer.parent()) {
    if (matches(rule, compound - 1, outer) && lies_in(rule, compound - 1, outer)) return true;
    if (rule.selector[compound].is_child || room_ == 0) return false;
  }
  return false;
}

SvgStyle SvgStyleSheet::of(pugi::xml_node node) {
  SvgStyle out;
  for (std::size_t k = 0; k < kSvgProperties; ++k) {
    out[static_cast<SvgProperty>(k)] = trimmed(node.attribute(kPropertyNames[k].data()).value());
  }
  std::vector<std::size_t> rules;
  if (!rules_.empty()) {
    collect(by_name_, "", node, rules);
    collect(by_name_, std::string(local_name(node)), node, rules);
    for (const std::string& one : words_of(node.attribute("class").value())) {
      collect(by_class_, one, node, rules);
    }
    if (const auto id = node.attribute("id")) collect(by_id_, id.value(), node, rules);
  }
  std::sort(rules.begin(), rules.end(), [this](std::size_t a, std::size_t b) {
    return std::tuple(rules_[a].specificity, a) < std::tuple(rules_[b].specificity, b);
  });
  const string_view style = node.attribute("style").value();
  const std::vector<Declaration> own =
      style.empty() ? std::vector<Declaration>{} : declarations_of(without_comments(style));
  for (const bool important : {false, true}) {
    const auto apply = [&](const std::vector<Declaration>& all) {
      for (const Declaration& one : all) {
        if (one.important == important) out[one.property] = one.value;
      }
    };
    for (const std::size_t rule : rules) apply(declarations_[rules_[rule].declarations]);
    apply(own);
  }
  return out;
}

}  // namespace obvid::exchange
