#include "spec/names_behind.hpp"

#include <nlohmann/json.hpp>
#include <vector>

#include "expression/token.hpp"
#include "spec/problem_spec.hpp"

namespace coordreq {

std::set<std::string> names_in(const std::string& expression) {
  std::set<std::string> names;
  Token token = read_token(expression, 0);
  for (; token.kind != TokenKind::end; token = read_token(expression, token.offset + token.text.size()))
    if (token.kind == TokenKind::name) names.emplace(token.text);
  return names;
}

std::set<std::string> with_names_behind(const Json& spec, std::set<std::string> names) {
  std::vector<std::string> open(names.begin(), names.end());
  while (!open.empty()) {
    const std::string name = open.back();
    open.pop_back();
    for (const char* const list : {"constants", "definitions", "memory"}) {
      if (!spec.contains(list) || !spec[list].contains(name) || !spec[list][name].is_string()) continue;
      for (const std::string& behind : names_in(spec[list][name].get<std::string>()))
        if (names.insert(behind).second) open.push_back(behind);
    }
  }
  return names;
}

}  // namespace coordreq
