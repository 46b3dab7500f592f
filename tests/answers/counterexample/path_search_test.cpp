// Ways through a tree of equal choices, some of which the system itself can follow.

#include "answers/counterexample/path_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

namespace coordreq {
namespace {

/// Ways are texts, a letter a step: each letter is the number of an equal choice, 'a' the first. Those that
/// the system itself can go are given, some of them whole.
class Tree {
 public:
  Tree(std::vector<std::string> followed, std::vector<std::string> whole)
      : followed_(std::move(followed)), whole_(std::move(whole)) {}

  [[nodiscard]] std::optional<FollowedState> position() const {
    if (!is_followed(path_)) return std::nullopt;
    const auto joined = joins_.find(path_);
    const std::string name = joined == joins_.end() ? path_ : joined->second;
    FollowedState position{.cell = static_cast<std::int64_t>(std::hash<std::string>()(name) >> 1),
                           .phase = 0,
                           .state = {},
                           .steps = path_.size()};
    paths_[{position.steps, position.cell}] = path_;
    return position;
  }
  void go_to(const FollowedState& position) { path_ = paths_.at({position.steps, position.cell}); }
  std::int64_t step(std::int64_t number) {
    ++steps_;
    path_ += static_cast<char>('a' + number);
    return 1;
  }
  [[nodiscard]] bool has_more() const {
    std::string next = path_;
    return is_followed(next) && is_followed((++next.back(), next));
  }
  [[nodiscard]] bool is_whole() const { return std::ranges::find(whole_, path_) != whole_.end(); }

  /// Ways that lead to the same place as another one.
  void join(const std::string& path, const std::string& other) { joins_[path] = other; }
  [[nodiscard]] int steps() const { return steps_; }

 private:
  [[nodiscard]] bool is_followed(const std::string& path) const {
    return std::ranges::any_of(followed_,
                               [&](const std::string& prefix) { return prefix.starts_with(path); });
  }

  std::vector<std::string> followed_, whole_;
  std::map<std::string, std::string> joins_;
  mutable std::map<std::pair<std::size_t, std::int64_t>, std::string> paths_;
  std::string path_;
  int steps_ = 0;
};

std::string found(Tree& tree, std::int64_t work = 1000) {
  PathSearch search(work);
  std::string path;
  for (const std::int64_t number : search.find(tree)) path += static_cast<char>('a' + number);
  return path;
}

TEST(PathSearch, TakesTheLongestWayEvenIfAnotherOneComesFirst) {
  Tree tree({"aab", "aaa", "aba", "abba", "b"}, {});
  EXPECT_EQ(found(tree), "abba");
}

TEST(PathSearch, TakesTheFirstOfTheLongest) {
  Tree tree({"aa", "ab", "bb", "ba"}, {});
  EXPECT_EQ(found(tree), "aa");
}

TEST(PathSearch, IsContentWithAWayToTheEnd) {
  Tree tree({"aa", "ba", "bbbb"}, {"ba"});
  EXPECT_EQ(found(tree), "ba");
}

TEST(PathSearch, LooksAtAPlaceOnce) {
  Tree once({"aaa", "aab", "baa", "bab"}, {});
  once.join("ba", "aa");
  Tree twice({"aaa", "aab", "baa", "bab"}, {});
  EXPECT_EQ(found(once), found(twice));
  EXPECT_LT(once.steps(), twice.steps());
}

TEST(PathSearch, TakesTheLongestSoFarWhenItsWorkIsDone) {
  Tree tree({"aab", "aaa", "aba", "abba", "b"}, {});
  EXPECT_EQ(found(tree, 4), "aaa");
  EXPECT_EQ(found(tree, 0), "");
}

}  // namespace
}  // namespace coordreq
