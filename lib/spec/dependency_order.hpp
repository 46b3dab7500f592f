#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace coordreq {

/// The vertices 0, ..., n - 1 ordered so that each stands after all it depends on.
/// @param dependencies for each vertex those it depends on
/// @param names what to call the vertices in the error
/// @param kind "definitions", for the error
/// @param pointers JSON pointers of the vertices, for the error
/// @throws SpecError naming a cycle, "a -> b -> a"
/// Iterative, so that a chain may be as long as memory allows. Cost: linear.
[[nodiscard]] std::vector<std::size_t> dependency_order(
    const std::vector<std::vector<std::size_t>>& dependencies, const std::vector<std::string>& names,
    const std::string& kind, const std::vector<std::string>& pointers);

}  // namespace coordreq
