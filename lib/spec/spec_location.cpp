#include "spec/spec_location.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/json.hpp"
#include "spec/json_document.hpp"
#include "spec/json_text.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {
namespace {

using Pointer = Json::json_pointer;

/// Goes through the tokens of a text.
class ValueWalk {
 public:
  explicit ValueWalk(std::string_view text) : json_{text, ""} { go_to(0); }

  [[nodiscard]] std::size_t offset() const { return offset_; }

  /// From an object or a list to one of its values. @returns whether there is one
  bool enter(const std::string& key) {
    const char open = sign();
    if (open != '{' && open != '[') return false;
    step();
    for (std::size_t index = 0; sign() != '}' && sign() != ']'; ++index) {
      std::string name = std::to_string(index);
      if (open == '{') {
        name = parse_json(token()).get<std::string>();
        step();
        step();  // the colon
      }
      if (name == key) return true;
      pass_value();
      if (sign() == ',') step();
    }
    return false;
  }

 private:
  [[nodiscard]] char sign() const { return offset_ < json_.text.size() ? json_.text[offset_] : '}'; }
  [[nodiscard]] std::string_view token() const { return json_.token(offset_); }
  void go_to(std::size_t offset) { offset_ = json_.token_from(offset); }
  void step() { go_to(offset_ + token().size()); }

  void pass_value() {
    int depth = 0;
    do {
      if (sign() == '{' || sign() == '[') ++depth;
      if (sign() == '}' || sign() == ']') --depth;
      step();
    } while (depth > 0 && offset_ < json_.text.size());
  }

  JsonText json_;
  std::size_t offset_ = 0;
};

std::vector<std::string> keys_of(std::string_view pointer) {
  std::vector<std::string> keys;
  for (Pointer rest{std::string(pointer)}; !rest.empty(); rest.pop_back()) keys.push_back(rest.back());
  std::reverse(keys.begin(), keys.end());
  return keys;
}

/// The JSON pointer that WHERE begins with; a place in an expression may follow.
std::string pointer_in(std::string_view where) {
  if (where.empty() || where.front() != '/') return {};
  const std::size_t end = std::min(where.find(", column "), where.find(", line "));
  return std::string(where.substr(0, end));
}

/// The last setting that has made the value what it is, or null.
const SpecSetting* setting_of(const WrittenSpec& written, const std::string& pointer) {
  for (auto setting = written.settings.rbegin(); setting != written.settings.rend(); ++setting) {
    const std::optional<std::string> set = pointer_of_setting(written.text, *setting);
    if (set && (pointer == *set || pointer.rfind(*set + "/", 0) == 0)) return &*setting;
  }
  return nullptr;
}

}  // namespace

WrittenSpec written_spec(const ProblemSpec& spec) {
  return spec.written ? *spec.written : WrittenSpec{spec.text, {}};
}

std::optional<std::size_t> offset_of_value(std::string_view text, std::string_view pointer) {
  ValueWalk walk(text);
  try {
    for (const std::string& key : keys_of(pointer)) {
      if (!walk.enter(key)) return std::nullopt;
    }
  } catch (const Json::exception&) {  // a pointer that was shortened for its message
    return std::nullopt;
  }
  return walk.offset();
}

std::string with_location(const std::string& error, const WrittenSpec& written) {
  const std::size_t begin = error.rfind(" (");
  if (written.text.empty() || begin == std::string::npos || error.back() != ')') return error;
  const std::string_view where = std::string_view(error).substr(begin + 2, error.size() - begin - 3);
  const std::string pointer = pointer_in(where);
  // A text that is no JSON has no pointers, but its path may look like one.
  if (pointer.empty() || !is_json(written.text, JsonComments::skipped)) return error;
  const std::string before = error.substr(0, error.size() - 1);
  if (const SpecSetting* const setting = setting_of(written, pointer); setting != nullptr)
    return fmt::format("{}; set by {}={})", before, setting->path, setting->value);
  const std::string_view text = without_byte_order_mark(written.text);
  const std::optional<std::size_t> offset = offset_of_value(text, pointer);
  return offset ? fmt::format("{}; {})", before, JsonText{text, ""}.position(*offset)) : error;
}

}  // namespace coordreq
