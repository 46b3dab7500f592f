#include "spec/set_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "spec/json_document.hpp"
#include "spec/json_span.hpp"
#include "spec/json_text.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

using Json = nlohmann::json;

[[noreturn]] void fail(const std::string& what, const std::string& path) {
  throw UsageError(what, one_line(path));
}

std::vector<std::string> split_at_dots(std::string_view text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('.', begin), text.size());
    parts.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// The tokens of a JSON pointer, RFC 6901.
std::vector<std::string> tokens_of(const std::string& path) {
  std::vector<std::string> tokens;
  try {
    for (Json::json_pointer pointer(path); !pointer.empty(); pointer.pop_back())
      tokens.insert(tokens.begin(), pointer.back());
  } catch (const Json::parse_error&) {
    throw UsageError("expected '~0' or '~1' where a '~' stands in a JSON pointer, found " + quote_text(path));
  }
  return tokens;
}

std::vector<std::string> steps_of(const std::string& path) {
  if (path.rfind('/', 0) == 0) return tokens_of(path);
  std::vector<std::string> steps = split_at_dots(path);
  if (std::find(steps.begin(), steps.end(), "") == steps.end()) return steps;
  throw UsageError("expected keys with dots between, as states.0.step, found " + quote_text(path));
}

/// The value as JSON text.
std::string json_of(const SpecSetting& setting) {
  const std::string& value = setting.value;
  if (Json::accept(value)) return value;
  if (value.find_first_of("{[\"") == 0) {
    fail("expected JSON, since it starts like it, found " + quote_text(value), setting.path);
  }
  try {
    return Json(value).dump();
  } catch (const Json::type_error&) {
    fail("expected UTF-8 text as the value", setting.path);
  }
}

/// Walks down the text of a spec.
class Walk {
 public:
  Walk(const std::string& text, const std::string& path) : text_(text), path_(path), at_(root_span(text)) {}

  [[nodiscard]] JsonSpan at() const { return at_; }
  [[nodiscard]] bool in_object() const { return text_[at_.begin] == '{'; }

  /// Goes to a member or an element. @returns false for a key that the object does not have
  bool enter(const std::string& step) {
    if (in_object()) {
      if (!enter_member(step)) return false;
    } else if (text_[at_.begin] == '[') {
      enter_element(step);
    } else {
      fail(fmt::format("no {} in {}: it is {}", quote_text(step), place(),
                       quote_text(std::string_view(text_).substr(at_.begin, at_.end - at_.begin))),
           path_);
    }
    steps_.push_back(step);
    return true;
  }

  /// REQUIRES: in_object().
  void check_may_add(const std::string& key) const {
    if (steps_ != std::vector<std::string>{"constants"} && steps_ != std::vector<std::string>{"definitions"})
      return;
    std::vector<std::string> known;
    for (const JsonMember& member : member_spans(text_, at_)) known.push_back(member.key);
    if (known.empty()) fail(fmt::format("{} is not one of the {}", quote_text(key), steps_[0]), path_);
    const std::string similar = suggestion(key, known);
    fail(fmt::format("{} is not one of the {}{}", quote_text(key), steps_[0],
                     similar.empty() ? ", expected " + quote_list(known, "or") : similar),
         path_);
  }

 private:
  bool enter_member(const std::string& key) {
    const std::vector<JsonMember> members = member_spans(text_, at_);
    const auto found = std::find_if(members.begin(), members.end(),
                                    [&key](const JsonMember& member) { return member.key == key; });
    if (found == members.end()) return false;
    at_ = found->value;
    return true;
  }

  void enter_element(const std::string& step) {
    const std::vector<JsonSpan> elements = element_spans(text_, at_);
    if (elements.empty()) fail(fmt::format("no {} in {}: it is empty", quote_text(step), place()), path_);
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(step.data(), step.data() + step.size(), index);
    if (error == std::errc() && end == step.data() + step.size() && index < elements.size()) {
      at_ = elements[index];
      return;
    }
    std::vector<std::string> names;
    for (const JsonSpan& element : elements) {
      const std::optional<std::string> name = name_of(element);
      if (name == step) {
        at_ = element;
        return;
      }
      if (name) names.push_back(*name);
    }
    fail(fmt::format("no {} in {}, expected {}a number from 0 to {}", quote_text(step), place(),
                     names.empty() ? "" : quote_list(names, "or") + ", or ", elements.size() - 1),
         path_);
  }

  /// What the element calls itself.
  [[nodiscard]] std::optional<std::string> name_of(JsonSpan element) const {
    if (text_[element.begin] != '{') return std::nullopt;
    for (const JsonMember& member : member_spans(text_, element)) {
      if (member.key != "name" || text_[member.value.begin] != '"') continue;
      const std::string_view text(text_);
      return Json::parse(text.substr(member.value.begin, member.value.end - member.value.begin))
          .get<std::string>();
    }
    return std::nullopt;
  }

  [[nodiscard]] std::string place() const {
    return steps_.empty() ? "the spec" : one_line(fmt::format("{}", fmt::join(steps_, ".")));
  }

  const std::string& text_;
  const std::string& path_;
  JsonSpan at_;
  std::vector<std::string> steps_;  ///< that led here
};

/// `text` with a member more at the end of an object.
std::string with_member(const std::string& text, JsonSpan object, const std::string& member) {
  const std::vector<JsonMember> members = member_spans(text, object);
  const std::size_t place = members.empty() ? object.begin + 1 : members.back().value.end;
  return text.substr(0, place) + (members.empty() ? "" : ", ") + member + text.substr(place);
}

}  // namespace

std::string with_setting(const std::string& text, const std::string& source, const SpecSetting& setting) {
  static_cast<void>(JsonDocument::parse(text, source));  // from here on it is well-formed
  const std::vector<std::string> steps = steps_of(setting.path);
  std::string value = json_of(setting);
  Walk walk(text, setting.path);
  auto step = steps.begin();
  while (step != steps.end() && walk.enter(*step)) ++step;
  if (step == steps.end()) return text.substr(0, walk.at().begin) + value + text.substr(walk.at().end);
  walk.check_may_add(*step);
  for (auto missing = steps.end(); --missing != step;)
    value = fmt::format("{{{}: {}}}", Json(*missing).dump(), value);
  return with_member(text, walk.at(), fmt::format("{}: {}", Json(*step).dump(), value));
}

}  // namespace coordreq
