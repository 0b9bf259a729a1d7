// SPDX-License-Identifier: Apache-2.0
// Sections of a DXF file: docs/methods/dxf.md, section 2.
#include "dxf/document.h"

#include <fmt/format.h>

#include <utility>

#include "dxf/file.h"

namespace obvid::dxf {
namespace {

enum class Section { kNone, kHeader, kTables, kBlocks, kEntities, kOther };

constexpr int kComment = 999;

class DocumentReader {
 public:
  DocumentReader(std::string_view bytes, std::string_view name) : name_(name), tags_(bytes, name) {}

  Result<Document> run() {
    OBVID_TRY(open());
    while (true) {
      auto tag = tags_.next();
      OBVID_TRY(tag);
      if (!*tag) break;
      if (is_comment(**tag)) continue;
      if ((*tag)->code != 0) {
        current_.push_back(**tag);
        continue;
      }
      flush();
      if ((*tag)->text == "EOF") return finished();
      current_.push_back(**tag);
    }
    flush();
    document_.warnings.push_back(fmt::format("the file ends {}, without EOF: it may be cut off",
                                             tags_.cut()               ? "inside an entry"
                                             : open_ == Section::kNone ? "after a section"
                                                                       : "early"));
    return finished();
  }

 private:
  Result<Document> finished() {
    if (second_block_ != 0) {
      document_.warnings.push_back(fmt::format("blocks of the same name were drawn as one ({})",
                                               tags_.place(second_block_)));
    }
    return std::move(document_);
  }

  bool is_comment(const Tag& tag) {
    const std::string_view prefix = exchange::kUnitsComment;
    if (tag.code == kComment && tag.text.starts_with(prefix)) {
      document_.units_remark = tag.text.substr(prefix.size());
    }
    return tag.code == kComment;
  }

  /// The first tag of any DXF file.
  Result<void> open() {
    auto first = tags_.next();
    while (first && *first && is_comment(**first)) first = tags_.next();
    if (first && *first && (*first)->code == 0 && (*first)->text == "SECTION") {
      current_.push_back(**first);
      return {};
    }
    return error(ErrorCode::kDamaged, "this is no DXF file: it does not open with 0, SECTION")
        .where(std::string(name_))
        .hint("write it as ASCII or binary DXF");
  }

  /// What was collected since the last 0 tag.
  void flush() {
    if (current_.empty()) return;
    const std::string_view type = current_.front().text;
    if (type == "SECTION") {
      begin_section();
    } else if (type == "ENDSEC") {
      end_lists();
      open_ = Section::kNone;
    } else if (open_ == Section::kBlocks || open_ == Section::kEntities) {
      entity(type);
    } else if (open_ == Section::kTables && type == "LAYER") {
      layer();
    }
    current_.clear();
  }

  void begin_section() {
    end_lists();
    open_ = Section::kOther;
    std::string_view name;
    for (const Tag& tag : current_) {
      if (tag.code == 2 && name.empty()) name = tag.text;
    }
    if (name == "TABLES") open_ = Section::kTables;
    if (name == "BLOCKS") open_ = Section::kBlocks;
    if (name == "ENTITIES") open_ = Section::kEntities;
    if (name == "HEADER") header();
  }

  /// All variables stand between SECTION and ENDSEC: no 0 tag parts them.
  void header() {
    std::string_view variable;
    for (const Tag& tag : current_) {
      if (tag.code == 9) variable = tag.text;
      if (tag.code != 70) continue;
      if (variable == "$INSUNITS") document_.units = integer(tag).value_or(0);
      if (variable == "$MEASUREMENT") document_.measurement = integer(tag);
    }
  }

  /// A frozen layer has bit 1 of its flags, one that is off a negative colour.
  void layer() {
    constexpr int kFrozenFlag = 1;
    std::string_view name;
    bool frozen = false, off = false;
    for (const Tag& tag : current_) {
      if (tag.code == 2) name = tag.text;
      if (tag.code == 70) frozen = (integer(tag).value_or(0) & kFrozenFlag) != 0;
      if (tag.code == 62) off = integer(tag).value_or(0) < 0;
    }
    if (frozen || off) {
      document_.hidden_layers[name] = frozen ? LayerState::kFrozen : LayerState::kOff;
    }
  }

  void end_lists() {
    block_ = nullptr;
    in_polyline_ = false;
  }

  void entity(std::string_view type) {
    if (open_ == Section::kBlocks && type == "BLOCK") return begin_block();
    if (open_ == Section::kBlocks && type == "ENDBLK") return end_lists();
    std::vector<Entity>* list = block_ != nullptr ? &block_->entities : nullptr;
    if (open_ == Section::kEntities) list = &document_.entities;
    if (list == nullptr) return;
    Entity one = entity_of(current_);
    if (one.kind == Kind::kVertex && in_polyline_) return add_vertex(list->back(), one);
    if (one.kind == Kind::kEnd) {
      in_polyline_ = false;
      return;
    }
    if (one.kind == Kind::kVertex) {  // lost its polyline
      one.kind = Kind::kOther;
    }
    in_polyline_ = one.type == "POLYLINE";
    list->push_back(std::move(one));
  }

  void begin_block() {
    end_lists();
    Block block;
    std::string_view name;
    for (const Tag& tag : current_) {
      if (tag.code == 2 && name.empty()) name = tag.text;
      if (tag.code == 10) block.base.x = number(tag).value_or(0.0);
      if (tag.code == 20) block.base.y = number(tag).value_or(0.0);
      if (tag.code == 30) block.base.z = number(tag).value_or(0.0);
    }
    const auto [place, added] = document_.blocks.try_emplace(name, std::move(block));
    if (!added && second_block_ == 0) second_block_ = current_.front().line;
    block_ = &place->second;
  }

  std::string_view name_;
  TagReader tags_;
  Document document_;
  std::vector<Tag> current_;
  Section open_ = Section::kNone;
  Block* block_ = nullptr;
  bool in_polyline_ = false;
  std::size_t second_block_ = 0;  ///< line of the first one
};

}  // namespace

Result<Document> read_document(std::string_view bytes, std::string_view name) {
  return DocumentReader(bytes, name).run();
}

}  // namespace obvid::dxf
