#include "spec/scope.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "base/error.hpp"
#include "spec/wording.hpp"

namespace coordreq {
namespace {

enum class Mark : std::uint8_t { unseen, open, done };

/// A vertex on the current path and the next of its dependencies to follow.
struct Visit {
  std::size_t vertex;
  std::size_t next = 0;
};

[[noreturn]] void fail_cycle(const std::vector<Visit>& path, std::size_t repeated,
                             const std::vector<std::string>& names, const std::string& kind,
                             const std::vector<std::string>& pointers) {
  constexpr std::ptrdiff_t kMostListed = 8;
  const auto start =
      std::find_if(path.begin(), path.end(), [&](const Visit& visit) { return visit.vertex == repeated; });
  std::string cycle;
  for (auto visit = start; visit != path.end(); ++visit) {
    if (visit - start == kMostListed) {
      cycle += "... -> ";
      break;
    }
    cycle += names[visit->vertex] + " -> ";
  }
  throw SpecError(fmt::format("cycle of {}: {}{}", kind, cycle, names[repeated]), pointers[repeated]);
}

}  // namespace

std::vector<std::size_t> dependency_order(const std::vector<std::vector<std::size_t>>& dependencies,
                                          const std::vector<std::string>& names, const std::string& kind,
                                          const std::vector<std::string>& pointers) {
  std::vector<std::size_t> order;
  std::vector<Mark> marks(dependencies.size(), Mark::unseen);
  std::vector<Visit> path;
  for (std::size_t root = 0; root < dependencies.size(); ++root) {
    if (marks[root] == Mark::unseen) path.push_back({root});
    while (!path.empty()) {
      const std::size_t vertex = path.back().vertex;
      marks[vertex] = Mark::open;
      if (path.back().next == dependencies[vertex].size()) {
        marks[vertex] = Mark::done;
        order.push_back(vertex);
        path.pop_back();
        continue;
      }
      const std::size_t next = dependencies[vertex][path.back().next++];
      if (marks[next] == Mark::open) fail_cycle(path, next, names, kind, pointers);
      if (marks[next] == Mark::unseen) path.push_back({next});
    }
  }
  return order;
}

}  // namespace coordreq
