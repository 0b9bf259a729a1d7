// SPDX-License-Identifier: Apache-2.0
#include "setters.h"

#include "obvid/core/internal/near_name.h"
#include "obvid/pipeline/internal/job_values.h"

namespace obvid::capi {

Result<Json> options_in(const char* options) {
  if (options == nullptr || *options == '\0') return Json::object();
  Json object = Json::parse(options, nullptr, false);
  if (object.is_object()) return object;
  return fail({ErrorCode::kBadJson, "the options are no JSON object", "options",
               "write {\"noise\": 0.01}"});
}

Result<void> take(const Json& object, const std::map<std::string, Setter>& known) {
  for (const auto& [name, value] : object.items()) {
    const auto at = known.find(name);
    if (at == known.end()) {
      std::vector<std::string> names;
      std::string all;
      for (const auto& [one, setter] : known) {
        names.push_back(one);
        all += (all.empty() ? "available are " : ", ") + one;
      }
      return fail({ErrorCode::kUsage, "unknown option '" + name + "'", "options",
                   did_you_mean(name, names, all)});
    }
    if (!at->second(value)) {
      return fail(bad_option("another type of value is expected", name, "docs/c.md has the types"));
    }
  }
  return {};
}

}  // namespace obvid::capi
