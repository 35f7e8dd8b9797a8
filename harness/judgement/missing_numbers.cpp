// SPDX-License-Identifier: MIT
#include "missing_numbers.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace shakedown {

namespace {

using Json = nlohmann::ordered_json;

void look_for(Json& value, const std::string& path, const ReasonOfPath& reason_of, Json& found) {
  if (value.is_object()) {
    for (auto& [key, inner] : value.items()) look_for(inner, path + "/" + key, reason_of, found);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      look_for(value[i], path + "/" + std::to_string(i), reason_of, found);
  } else if (value.is_number_float() && !std::isfinite(value.get<double>())) {
    const std::string reason = reason_of ? reason_of(path) : "";
    found[path] = reason.empty() ? "could not be computed: what it is made of is not finite" : reason;
    value = nullptr;
  }
}

}  // namespace

void explain_missing_numbers(Json& document, const ReasonOfPath& reason_of) {
  Json found = Json::object();
  look_for(document, "", reason_of, found);
  if (!found.empty()) document["not_computed"] = std::move(found);
}

}  // namespace shakedown
