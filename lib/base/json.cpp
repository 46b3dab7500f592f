#include "base/json.hpp"

#include <nlohmann/json.hpp>

namespace coordreq {
namespace {

Json parse(std::string_view text, bool may_throw, JsonComments comments) {
  return Json::parse(text, nullptr, may_throw, comments == JsonComments::skipped);
}

std::string dump(const Json& json, int indent) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

Json parse_json(std::string_view text, JsonComments comments) {
  return parse(text, true, comments);
}

Json parse_json_if_valid(std::string_view text) {
  return parse(text, false, JsonComments::none);
}

bool is_json(std::string_view text, JsonComments comments) {
  return Json::accept(text, comments == JsonComments::skipped);
}

std::int64_t integer_or_zero(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number_integer() ? found->get<std::int64_t>() : 0;
}

std::string compact_json(const Json& json) {
  return dump(json, -1);
}

std::string json_line(const Json& json) {
  return dump(json, -1) + "\n";
}

std::string json_text(const Json& json) {
  return dump(json, 2) + "\n";
}

}  // namespace coordreq
