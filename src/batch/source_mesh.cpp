// SPDX-License-Identifier: Apache-2.0
// Sections of a mesh: each chain of edges is an item.
#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

#include "obvid/core/internal/parallel.h"
#include "obvid/exchange/mesh_read.h"
#include "source.h"

namespace obvid::batch {
namespace {

struct Plane {
  char axis = 'z';
  double at = 0.0;
};

using Sections = std::shared_ptr<const std::vector<MeshSection>>;

class MeshSource : public Source {
 public:
  MeshSource(std::string path, TriangleMesh mesh, std::vector<PlaneRow> cuts, bool name_it)
      : path_(std::move(path)), mesh_(std::move(mesh)), cuts_(std::move(cuts)), name_it_(name_it) {
    for (const PlaneRow& cut : cuts_) {
      for (std::size_t i = 0; i < cut.count(); ++i) planes_.push_back({cut.axis, cut.at(i)});
    }
  }

  /// How many chains each plane has: which item belongs to which. Errors: those of `cut_mesh`.
  Result<void> count(std::size_t threads) {
    std::vector<std::size_t> chains(planes_.size(), 0);
    std::vector<std::optional<Error>> errors(planes_.size());
    in_parallel(planes_.size(), threads, [&](std::size_t i) {
      const auto found = cut_mesh(mesh_, plane_across(planes_[i].axis, planes_[i].at));
      if (found) {
        chains[i] = found->size();
      } else {
        errors[i] = found.error();
      }
    });
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      if (errors[i]) return fail(*errors[i]);
      ends_.push_back((ends_.empty() ? 0 : ends_.back()) + chains[i]);
      empty_ += chains[i] == 0 ? 1 : 0;
    }
    return {};
  }

  std::size_t size() const override { return ends_.empty() ? 0 : ends_.back(); }
  std::string mark() const override {
    std::string out = path_ + " " + mark_of_file(path_) + " planes";
    for (const PlaneRow& cut : cuts_) {
      out += fmt::format(" {}={}:{}:{}", cut.axis, cut.from, cut.step, cut.to);
    }
    return out;
  }
  std::string remark() const override {
    if (empty_ == 0) return {};
    return fmt::format("{} of {} planes do not cut {}", empty_, planes_.size(), path_);
  }

  Result<std::vector<Item>> load(std::size_t first, std::size_t count) const override {
    std::vector<Item> out;
    for (std::size_t i = first; i < first + count; ++i) {
      const auto plane =
          static_cast<std::size_t>(std::upper_bound(ends_.begin(), ends_.end(), i) - ends_.begin());
      const std::size_t begin = plane == 0 ? 0 : ends_[plane - 1];
      const auto sections = sections_of(plane);
      OBVID_TRY(sections);
      out.push_back(item_of(plane, i - begin, **sections));
    }
    return out;
  }

 private:
  Item item_of(std::size_t plane, std::size_t chain, const std::vector<MeshSection>& all) const {
    const MeshSection& section = all[chain];
    Item item;
    item.id = name_it_ ? path_ + ":" : "";
    item.id += plane_name(planes_[plane].axis, planes_[plane].at);
    if (all.size() > 1) item.id += fmt::format("/{}", chain + 1);
    item.name = path_ + "[" + item.id + "]";
    for (const Vec2 p : section.points) {
      item.numbers.push_back(p.x);
      item.numbers.push_back(p.y);
    }
    if (section.closed) {  // it comes back to its first point
      item.numbers.push_back(section.points.front().x);
      item.numbers.push_back(section.points.front().y);
    }
    return item;
  }

  /// Chains of one plane follow each other, so the last few planes are kept.
  Result<Sections> sections_of(std::size_t plane) const {
    constexpr std::size_t kKept = 16;
    {
      const std::scoped_lock lock(mutex_);
      for (const auto& [number, sections] : kept_) {
        if (number == plane) return sections;
      }
    }
    auto found = cut_mesh(mesh_, plane_across(planes_[plane].axis, planes_[plane].at));
    OBVID_TRY(found);
    Sections made = std::make_shared<const std::vector<MeshSection>>(std::move(*found));
    const std::scoped_lock lock(mutex_);
    kept_.emplace_back(plane, made);
    if (kept_.size() > kKept) kept_.pop_front();
    return made;
  }

  std::string path_;
  TriangleMesh mesh_;
  std::vector<PlaneRow> cuts_;
  bool name_it_;
  std::vector<Plane> planes_;
  std::vector<std::size_t> ends_;
  std::size_t empty_ = 0;
  mutable std::mutex mutex_;
  mutable std::deque<std::pair<std::size_t, Sections>> kept_;
};

}  // namespace

Result<std::unique_ptr<Source>> mesh_source(const std::string& path,
                                            const std::vector<PlaneRow>& cuts, bool name_it,
                                            std::size_t threads) {
  auto mesh = read_mesh(path);
  OBVID_TRY(mesh);
  auto out = std::make_unique<MeshSource>(path, std::move(*mesh), cuts, name_it);
  OBVID_TRY(out->count(threads));
  return out;
}

}  // namespace obvid::batch
