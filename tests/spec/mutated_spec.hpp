#pragma once

#include <rapidcheck.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "maximal_spec.hpp"

/// Specs with a few things wrong in them. For use inside of rc::check().
namespace coordreq::test::mutation {

inline void collect(const SortedJson& value, const SortedJson::json_pointer& pointer,
                    std::vector<SortedJson::json_pointer>& all) {
  if (!pointer.empty()) all.push_back(pointer);
  if (value.is_object()) {
    for (const auto& [key, member] : value.items()) collect(member, pointer / key, all);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) collect(value[i], pointer / i, all);
  }
}

inline void remove(SortedJson& document, const SortedJson::json_pointer& pointer) {
  SortedJson& parent = document.at(pointer.parent_pointer());
  if (parent.is_array()) {
    parent.erase(std::stoul(pointer.back()));
  } else {
    parent.erase(pointer.back());
  }
}

inline void rename(SortedJson& document, const SortedJson::json_pointer& pointer) {
  SortedJson& parent = document.at(pointer.parent_pointer());
  if (!parent.is_object()) return;
  SortedJson value = parent[pointer.back()];
  parent.erase(pointer.back());
  std::string name = pointer.back();
  name[*rc::gen::inRange<std::size_t>(0, name.size())] = *rc::gen::inRange('!', '~');
  parent[name] = std::move(value);
}

/// What a slip of the hand or a wrong idea of the format could put there.
inline SortedJson other_value(const SortedJson& document,
                              const std::vector<SortedJson::json_pointer>& nodes) {
  const std::vector<std::string> values{"null",
                                        "true",
                                        "false",
                                        "0",
                                        "-1",
                                        "1",
                                        "2.5",
                                        "1e-320",
                                        "123456789012345678901234567890",
                                        "1e300",
                                        "[]",
                                        "{}",
                                        "\"\"",
                                        "\"x1\"",
                                        "\"all\"",
                                        "\"1/0\"",
                                        "\"x1 <\"",
                                        "\"r2 < 1\"",
                                        "\"u1\"",
                                        "\"stop\"",
                                        "[[]]",
                                        "[\"\"]",
                                        "\"a|b+c\"",
                                        "[{}]",
                                        "{\"a\": 1}",
                                        "\"\\u00e9\\n\"",
                                        "\"2^(2^70)\""};
  if (*rc::gen::inRange(0, 4) == 0) return document.at(*rc::gen::elementOf(nodes));
  return SortedJson::parse(*rc::gen::elementOf(values));
}

/// Changes, drops or renames one thing.
inline void mutate(SortedJson& document) {
  std::vector<SortedJson::json_pointer> nodes;
  collect(document, SortedJson::json_pointer(), nodes);
  const SortedJson::json_pointer pointer = *rc::gen::elementOf(nodes);
  switch (*rc::gen::inRange(0, 4)) {
    case 0:
      return remove(document, pointer);
    case 1:
      return rename(document, pointer);
    default: {
      const SortedJson value = other_value(document, nodes);
      document.at(pointer) = value;
    }
  }
}

}  // namespace coordreq::test::mutation

namespace coordreq::test {

/// The spec that has every key, changed in one or two places.
inline nlohmann::json mutated_spec() {
  nlohmann::json document = nlohmann::json::parse(kMaximalSpec, nullptr, true, true);
  const int changes = *rc::gen::inRange(1, 3);
  for (int i = 0; i < changes; ++i) mutation::mutate(document);
  return document;
}

}  // namespace coordreq::test
