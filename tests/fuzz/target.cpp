#include "fuzz/target.hpp"

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <fstream>

namespace coordreq::test {
namespace {

/// libFuzzer takes counters in this section for coverage.
constexpr std::size_t kCounters = 4096;
[[gnu::section("__libfuzzer_extra_counters")]] std::array<std::uint8_t, kCounters> counters;

}  // namespace

/// By the words of small letters in it, up to the first quoted one.
void note_answer(std::string_view text) {
  std::size_t hash = 0;
  for (const char c : text.substr(0, text.find('\''))) {
    if (c >= 'a' && c <= 'z') hash = hash * 31 + static_cast<std::size_t>(c);
  }
  counters[hash % kCounters] = 1;
}

std::string InputFile::new_path() {
  return "/dev/shm/coordreq-fuzz-" + std::to_string(getpid());
}

InputFile::InputFile(const std::uint8_t* data, std::size_t size) : path_(new_path()) {
  std::ofstream file(path_, std::ios::binary);
  file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  if (!file.flush()) std::abort();
}

InputFile::~InputFile() {
  unlink(path_.c_str());
}

std::string_view small_spec() {
  return R"({ "coordreq": 1, "name": "small",
    "states": [ { "name": "x1", "lower": -1, "upper": 1, "step": 0.5 },
                { "name": "x2", "lower": -1, "upper": 1, "step": 0.5, "outside": "saturate" } ],
    "inputs": [ { "name": "u1", "values": [-1, 0, 1] }, { "name": "u2", "values": [-1, 0, 1] } ],
    "agents": [ { "name": "a", "inputs": ["u1"] }, { "name": "b", "inputs": ["u2"] } ],
    "dynamics": { "time": "continuous", "period": 0.5, "equations": { "x1": "u1", "x2": "u2 + 0.1*x1" } },
    "safe": "x1^2 + x2^2 <= 1",
    "coordination": { "convention": true },
    "network": { "delay": 2 } })";
}

}  // namespace coordreq::test
