// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "obvid/core/internal/shown_text.h"
#include "obvid/core/result.h"

namespace obvid::exchange {

/// An XML file in memory and where its parts stand. Entities that the file defines itself are not
/// expanded, so none of them can grow.
class XmlFile {
 public:
  /// `text` and `name` must outlive this.
  XmlFile(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  /// Parses the text. Errors: E308 where the markup is wrong or cut off, E310 where the outermost
  /// element is not `root`, whatever its prefix.
  Result<void> parse(std::string_view root);

  [[nodiscard]] pugi::xml_node root() const { return document_.document_element(); }
  [[nodiscard]] const std::string& name() const { return name_; }
  /// Line of a node, from 1; 0 where it is not known (files that are not UTF-8).
  [[nodiscard]] std::size_t line_of(pugi::xml_node node) const;
  /// "file.xml:12", or the name alone.
  [[nodiscard]] std::string where(pugi::xml_node node) const;

 private:
  [[nodiscard]] std::size_t line_at(std::ptrdiff_t byte) const;

  std::string_view text_;
  std::string name_;
  pugi::xml_document document_;
  bool bytes_are_places_ = false;
};

/// Warnings about parts of an XML file: each sentence once, with its number and the first line.
class XmlWarnings {
 public:
  explicit XmlWarnings(const XmlFile& file) : file_(file) {}

  void add(const std::string& sentence, pugi::xml_node node);
  /// Of what would be a curve and is not read, or not in full.
  void leave_out(const std::string& sentence, pugi::xml_node node) {
    ++left_out_;
    add(sentence, node);
  }
  [[nodiscard]] std::size_t left_out() const { return left_out_; }
  /// In the order in which they came up first.
  [[nodiscard]] std::vector<std::string> take() const;

 private:
  struct Entry {
    std::size_t order = 0;
    std::size_t count = 0;
    std::size_t line = 0;
  };
  const XmlFile& file_;
  std::map<std::string, Entry> entries_;
  std::size_t unlisted_ = 0, left_out_ = 0;
};

/// Name of an element or attribute without the prefix of its namespace.
[[nodiscard]] std::string_view local_name(std::string_view name);
[[nodiscard]] inline std::string_view local_name(pugi::xml_node node) {
  return local_name(std::string_view(node.name()));
}
/// First child element of this local name.
[[nodiscard]] pugi::xml_node child_of(pugi::xml_node node, std::string_view name);
/// Attribute of this name, with any prefix or none.
[[nodiscard]] pugi::xml_attribute attribute_of(pugi::xml_node node, std::string_view name);

[[nodiscard]] std::string_view trimmed(std::string_view text);
/// The whole text, blanks around it apart, as one finite decimal number.
[[nodiscard]] std::optional<double> number_of(std::string_view text);
/// Numbers separated by blanks; nothing where one of them is none, or more than `most` stand there.
[[nodiscard]] std::optional<std::vector<double>> numbers_of(std::string_view text,
                                                            std::size_t most);

}  // namespace obvid::exchange
