#include "spec/set_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/json.hpp"
#include "base/requires.hpp"
#include "numeric/rational.hpp"
#include "spec/json_document.hpp"
#include "spec/json_text.hpp"
#include "spec/problem_spec.hpp"
#include "spec/read_spec.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Pointer = Json::json_pointer;

[[noreturn]] void fail(const std::string& what, const std::string& path) {
  throw UsageError(what, one_line(path));
}

Json value_of(const SpecSetting& setting) {
  const std::string& value = setting.value;
  if (!is_utf8(value)) fail("expected UTF-8 text as the value", setting.path);
  if (is_json(value)) return spec_json(value, setting.path);
  if (value.find_first_of("{[\"") == 0)
    fail("expected JSON, since it starts like it, found " + quote_text(value), setting.path);
  return value;
}

std::vector<std::string> split_at_dots(const std::string& path) {
  std::vector<std::string> steps;
  for (std::size_t begin = 0; begin <= path.size(); begin += steps.back().size() + 1)
    steps.push_back(path.substr(begin, path.find('.', begin) - begin));
  if (std::find(steps.begin(), steps.end(), "") == steps.end()) return steps;
  throw UsageError("expected keys with dots between, e.g. states.0.step, found " + quote_text(path));
}

/// The tokens of a JSON pointer, RFC 6901.
std::vector<std::string> tokens_of(const std::string& path) {
  std::vector<std::string> tokens;
  try {
    for (Pointer pointer(path); !pointer.empty(); pointer.pop_back()) tokens.push_back(pointer.back());
  } catch (const Json::parse_error&) {
    throw UsageError("expected '~0' or '~1' where a '~' stands in a JSON pointer, found " + quote_text(path));
  }
  std::reverse(tokens.begin(), tokens.end());
  return tokens;
}

std::vector<std::string> steps_of(const std::string& path) {
  if (!is_utf8(path)) throw UsageError("expected UTF-8 text as the path, found " + quote_text(path));
  return path.rfind('/', 0) == 0 ? tokens_of(path) : split_at_dots(path);
}

/// Finds the place of a setting in a spec.
class PointerFinder {
 public:
  PointerFinder(const Json& spec, const std::string& path) : path_(path), at_(&spec) {}

  /// Goes down the steps; members that are missing are added where the schema allows them.
  /// @returns keys, and indices of elements that are there
  [[nodiscard]] std::vector<std::string> to(const std::vector<std::string>& steps) {
    for (std::size_t i = 0; i < steps.size(); ++i) {
      walked_ = {steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(i)};
      if (at_ == nullptr) {
        steps_.push_back(steps[i]);
      } else if (at_->is_object()) {
        enter_member(steps, i);
      } else if (at_->is_array()) {
        enter_element(steps[i]);
      } else {
        fail(fmt::format("no {} in {}: it is {}", quote_text(steps[i]), location(), quote_text(at_->dump())),
             path_);
      }
    }
    return steps_;
  }

 private:
  void enter_member(const std::vector<std::string>& steps, std::size_t i) {
    const auto found = at_->find(steps[i]);
    if (found == at_->end()) check_may_add(steps, i);
    at_ = found == at_->end() ? nullptr : &*found;
    steps_.push_back(steps[i]);
  }

  /// Refuses to add a constant, a definition or a table, since nothing would refer to it.
  void check_may_add(const std::vector<std::string>& steps, std::size_t missing) const {
    if (missing == 0) check_is_key(steps);
    if (missing > 1 || steps.size() < 2 ||
        (steps[0] != "constants" && steps[0] != "definitions" && steps[0] != "tables"))
      return;
    std::vector<std::string> known;
    if (missing == 1) {
      for (const auto& [key, value] : at_->items()) known.push_back(key);
    }
    std::string expected = suggestion(steps[1], known);
    if (expected.empty())
      expected = known.empty() ? ": there are none" : ", expected " + quote_list(known, "or");
    fail(fmt::format("{} is not one of the {}{}", quote_text(steps[1]), steps[0], expected), path_);
  }

  /// Refuses a name at the top level that is no key there, but the name of something in the spec.
  void check_is_key(const std::vector<std::string>& steps) const {
    if (parse_json(spec_schema()).at("properties").contains(steps[0])) return;
    for (const char* key :
         {"constants", "definitions", "tables", "states", "inputs", "disturbances", "agents"}) {
      const auto found = at_->find(key);
      if (found == at_->end() || !has_name(*found, steps[0])) continue;
      fail(fmt::format("no key {} in the spec, did you mean {}?", quote_text(steps[0]),
                       quote_text(fmt::format("{}.{}", key, fmt::join(steps, ".")))),
           path_);
    }
  }

  /// Whether an object has the key, or a list an element with the name.
  static bool has_name(const Json& node, const std::string& name) {
    if (node.is_object()) return node.contains(name);
    return node.is_array() && std::any_of(node.begin(), node.end(), [&](const Json& element) {
             return element.is_object() && element.value("name", Json()) == name;
           });
  }

  void enter_element(const std::string& step) {
    if (at_->empty()) fail(fmt::format("no {} in {}: it is empty", quote_text(step), location()), path_);
    const std::size_t index = index_of(step);
    at_ = &(*at_)[index];
    steps_.push_back(std::to_string(index));
  }

  [[nodiscard]] std::size_t index_of(const std::string& step) const {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
    if (error == std::errc() && end == step.data() + step.size() && index < at_->size()) return index;
    std::vector<std::string> names;
    for (index = 0; index < at_->size(); ++index) {
      const Json& element = (*at_)[index];
      const auto name = element.is_object() ? element.find("name") : element.end();
      if (!element.is_object() || name == element.end() || !name->is_string()) continue;
      if (*name == step) return index;
      names.push_back(*name);
    }
    fail(fmt::format("no {} in {}, expected {}a number from 0 to {}", quote_text(step), location(),
                     names.empty() ? "" : quote_list(names, "or") + ", or ", at_->size() - 1),
         path_);
  }

  /// Where the walk is, in words.
  [[nodiscard]] std::string location() const {
    return walked_.empty() ? "the spec" : one_line(fmt::format("{}", fmt::join(walked_, ".")));
  }

  const std::string& path_;
  const Json* at_;  ///< nothing where it is not there
  std::vector<std::string> walked_;
  std::vector<std::string> steps_;
};

/// A step as it is written, of which so many make one of the old ones.
Json refined_step(const Json& step, std::int64_t factor) {
  if (step.is_string()) return fmt::format("({})/{}", step.get<std::string>(), factor);
  const std::optional<Rational> value = parse_decimal(compact_json(step));
  if (!value) return step;
  const std::string text = to_text(*value / Rational(mpz_class(static_cast<long>(factor))));
  return text.find('/') == std::string::npos ? spec_json(text, "the step") : Json(text);
}

bool is_ring(const Json& state) {
  const auto outside = state.find("outside");
  if (outside == state.end()) return false;
  return *outside == "periodic" ||
         (outside->is_object() && outside->contains("below") && (*outside)["below"] == "periodic");
}

/// Divides the step of a state. Values that break the schema stay as they are, for read_spec() to name.
void refine(Json& state, std::int64_t factor) {
  if (!state.is_object() || state.value("discrete", Json()) == true) return;
  const auto step = state.find("step");
  if (step != state.end() && (step->is_number() || step->is_string())) *step = refined_step(*step, factor);
  const auto count = state.find("count");
  if (count == state.end() || !count->is_number_integer() || *count < 1 || *count > INT32_MAX) return;
  const std::int64_t ends = is_ring(state) ? 0 : 1;
  *count = (count->get<std::int64_t>() - ends) * factor + ends;
}

}  // namespace

Json spec_json(const std::string& text, const std::string& source) {
  // A copy, since two documents at once take much memory.
  const auto tokens = JsonDocument::parse(text, source).number_tokens();
  Json json = parse_json(without_byte_order_mark(text), JsonComments::skipped);
  for (const auto& [pointer, token] : tokens) {
    Json& number = json[Pointer(pointer)];
    if (parse_decimal(compact_json(number)) != parse_decimal(token)) number = token;
  }
  return json;
}

std::optional<std::string> pointer_of_setting(const std::string& text, const SpecSetting& setting) {
  const Json spec = spec_json(text, "the spec");
  std::string pointer;
  try {
    for (const std::string& step : PointerFinder(spec, setting.path).to(steps_of(setting.path)))
      pointer = member_pointer(pointer, step);
  } catch (const UsageError&) {
    return std::nullopt;
  }
  return pointer;
}

std::string without_comments(const std::string& text) {
  return json_text(spec_json(text, "the spec"));
}

std::string with_refinement(const std::string& text, const std::string& source, std::int64_t factor) {
  REQUIRES(1 <= factor && factor <= INT32_MAX);
  Json spec = spec_json(text, source);
  if (!spec.is_object() || !spec.contains("states") || !spec["states"].is_array()) return text;
  for (Json& state : spec["states"]) refine(state, factor);
  return json_text(spec);
}

std::string with_setting(const std::string& text, const std::string& source, const SpecSetting& setting) {
  Json spec = spec_json(text, source);
  Json* at = &spec;
  // A JSON pointer would make a list of what is not there wherever a step is a number, however large.
  for (const std::string& step : PointerFinder(spec, setting.path).to(steps_of(setting.path)))
    at = at->is_array() ? &(*at)[std::stoul(step)] : &(*at)[step];
  *at = value_of(setting);
  return json_text(spec);
}

}  // namespace coordreq
