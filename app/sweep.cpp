#include "app/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "app/option_values.hpp"
#include "app/text.hpp"
#include "base/error.hpp"

namespace coordreq {
namespace {

constexpr std::size_t kMostCombinations = 10'000;

/// The text cut at commas that are neither in brackets of any kind nor in double quotes.
std::vector<std::string> split_at_outer_commas(std::string_view text) {
  std::vector<std::string> items(1);
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') quoted = !quoted;
    if (!quoted && std::string_view("([{").find(c) != std::string_view::npos) ++depth;
    if (!quoted && std::string_view(")]}").find(c) != std::string_view::npos) --depth;
    if (c == ',' && !quoted && depth == 0) {
      items.emplace_back();
      continue;
    }
    items.back() += c;
    if (quoted && c == '\\' && i + 1 < text.size()) items.back() += text[++i];
  }
  return items;
}

}  // namespace

SpecSetting parse_setting(const std::string& text, const std::string& option) {
  const std::size_t equals = text.find('=');
  if (equals != 0 && equals != std::string::npos) return {text.substr(0, equals), text.substr(equals + 1)};
  fail_value("PATH=VALUE, e.g. constants.R=0.7", text, option);
}

Sweep parse_sweep(const std::string& text, const std::string& option) {
  const std::size_t equals = text.find('=');
  if (equals != 0 && equals != std::string::npos) {
    Sweep sweep{text.substr(0, equals), split_at_outer_commas(std::string_view(text).substr(equals + 1))};
    if (std::find(sweep.values.begin(), sweep.values.end(), "") == sweep.values.end()) return sweep;
  }
  fail_value("PATH=VALUE,VALUE, e.g. states.0.step=0.02,0.01", text, option);
}

std::vector<std::vector<SpecSetting>> combinations(const std::vector<Sweep>& sweeps) {
  std::vector<std::vector<SpecSetting>> result(1);
  for (std::size_t i = 0; i < sweeps.size(); ++i) {
    const Sweep& sweep = sweeps[i];
    const auto is_this = [&sweep](const Sweep& other) { return other.path == sweep.path; };
    if (std::find_if(sweeps.begin(), sweeps.end(), is_this) - sweeps.begin() <
        static_cast<std::ptrdiff_t>(i)) {
      throw UsageError(echoed(sweep.path) + " is swept twice", "--sweep");
    }
    if (result.size() > kMostCombinations / sweep.values.size()) {
      throw UsageError(fmt::format("expected at most {} combinations, found more", kMostCombinations),
                       "--sweep");
    }
    std::vector<std::vector<SpecSetting>> longer;
    for (const std::vector<SpecSetting>& start : result) {
      for (const std::string& value : sweep.values) {
        longer.push_back(start);
        longer.back().push_back({sweep.path, value});
      }
    }
    result = std::move(longer);
  }
  return result;
}

}  // namespace coordreq
