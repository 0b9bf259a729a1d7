// SPDX-License-Identifier: Apache-2.0
#include "verify/false_claim.h"

#include <fmt/format.h>

#include "obvid/pipeline/internal/summary.h"

namespace obvid::pipeline_detail {

Error false_claim_in_space(const std::string& name, double claimed, double found) {
  return error(ErrorCode::kFalseClaim,
               fmt::format("the file claims {} = {:.9g}, found {:.9g}", name, claimed, found))
      .where("/" + name)
      .hint("form the curve again")
      .value(found);
}

void add_false_claim(JsonText& json, const Error* claim) {
  json.key("false_claim");
  if (claim == nullptr) {
    json.null();
    return;
  }
  json.begin_object().pair("code", code_text(*claim));
  json.pair("what", claim->what).pair("where", claim->where).end_object();
}

}  // namespace obvid::pipeline_detail
