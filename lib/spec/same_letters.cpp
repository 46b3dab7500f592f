#include "spec/wording.hpp"

#include <algorithm>

namespace coordreq {
namespace {

/// Of ASCII letters, the same small ones.
std::string in_small_letters(std::string_view text) {
  std::string small(text);
  for (char& c : small) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return small;
}

}  // namespace

std::string same_letters(std::string_view name, const std::vector<std::string>& known) {
  const std::string small = in_small_letters(name);
  const auto found = std::find_if(known.begin(), known.end(), [&](const std::string& candidate) {
    return candidate.size() == small.size() && in_small_letters(candidate) == small;
  });
  return found == known.end() ? std::string() : ", did you mean " + quote_text(*found) + "?";
}

}  // namespace coordreq
