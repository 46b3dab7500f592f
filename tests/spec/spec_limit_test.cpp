#include <gtest/gtest.h>

#include <string>

#include "example_spec.hpp"

namespace coordreq {
namespace {

void expect_limit(const nlohmann::json& spec, const std::string& what) {
  try {
    static_cast<void>(test::read(spec));
    ADD_FAILURE() << "read, expected " << what;
  } catch (const LimitError& error) {
    EXPECT_EQ(error.what(), what);
  }
}

TEST(SpecLimit, PointsOfOneDimension) {
  expect_limit(
      test::example_with("/states/0", R"({"name": "x1", "lower": 0, "upper": 2147483646, "step": 1})"),
      "2147483647 grid points, at most 2147483646 are possible (/states/0)");
  expect_limit(
      test::example_with("/states/0", R"({"name": "x1", "lower": 0, "upper": 1, "count": 2147483647})"),
      "2147483647 grid points, at most 2147483646 are possible (/states/0/count)");
  expect_limit(
      test::example_with("/inputs/0", R"({"name": "u1", "lower": 0, "upper": 1e300, "step": 1e-300})"),
      "about 10^600 grid points, at most 2147483646 are possible (/inputs/0)");
  EXPECT_EQ(test::error_of(test::example_with(
                "/states/0", R"({"name": "x1", "lower": 1, "upper": 2147483646, "step": 1})")),
            "");
}

TEST(SpecLimit, Cells) {
  nlohmann::json spec = test::example();
  const auto set_upper = [&](const std::string& upper) {
    for (std::size_t i = 0; i < 2; ++i) {
      spec["states"][i]["lower"] = 1;
      spec["states"][i]["upper"] = upper;
      spec["states"][i]["step"] = 1;
    }
  };
  set_upper("2^31 - 2");
  EXPECT_EQ(test::error_of(spec), "");
  spec["states"].push_back({{"name", "x3"}, {"lower", 0}, {"upper", 1}, {"step", 1}});
  spec["dynamics"]["equations"]["x3"] = "0";
  expect_limit(spec, "9223372019674906632 cells, at most 4611686018427387904 are possible (/states)");
}

TEST(SpecLimit, States) {
  nlohmann::json spec = test::example();
  for (int i = 3; i <= 31; ++i) {
    const std::string name = "x" + std::to_string(i);
    spec["states"].push_back({{"name", name}, {"lower", 0}, {"upper", 0}, {"step", 1}});
    spec["dynamics"]["equations"][name] = "0";
  }
  EXPECT_EQ(test::error_of(spec), "");
  spec["states"].push_back({{"name", "x32"}, {"lower", 0}, {"upper", 0}, {"step", 1}});
  spec["dynamics"]["equations"]["x32"] = "0";
  expect_limit(spec, "32 states, at most 31 are possible (/states)");
}

TEST(SpecLimit, Inputs) {
  nlohmann::json spec = test::example();
  spec["inputs"][0] = {{"name", "u1"}, {"lower", 1}, {"upper", 1'048'577}, {"step", 1}};
  expect_limit(spec, "1048577 values of one input, at most 1048576 are possible (/inputs/0)");
  spec["inputs"][0] = {{"name", "u1"}, {"lower", 1}, {"upper", 1'048'576}, {"step", 1}};
  spec["inputs"][1] = {{"name", "u2"}, {"lower", 1}, {"upper", 2049}, {"step", 1}};
  expect_limit(spec, "2148532224 joint inputs, at most 2147483648 are possible (/inputs)");
  spec["inputs"][1]["upper"] = 2048;
  EXPECT_EQ(test::error_of(spec), "");
}

TEST(SpecLimit, ModesOfANetwork) {
  const auto network = [](const std::string& text) { return test::example_with("/network", text); };
  expect_limit(network(R"({"delay": 4096})"),
               "more than 4096 modes, the most that are possible (/network/delay)");
  expect_limit(network(R"({"burst": {"length": 4000, "gap": 97}})"),
               "more than 4096 modes, the most that are possible (/network/burst)");
  expect_limit(network(R"({"weakly_hard": {"misses": 2, "window": 92}})"),
               "more than 4096 modes, the most that are possible (/network/weakly_hard)");
  expect_limit(network(R"({"weakly_hard": {"misses": 1000000000, "window": 2147483646}})"),
               "more than 4096 modes, the most that are possible (/network/weakly_hard)");
  nlohmann::json modes = nlohmann::json::parse(R"({"modes": [], "transitions": [["0", "0"]]})");
  for (int i = 0; i < 4097; ++i)
    modes["modes"].push_back({{"name", std::to_string(i)}, {"partition", "a|b"}});
  expect_limit(network(modes.dump()), "4097 modes, at most 4096 are possible (/network/modes)");
  EXPECT_EQ(test::read(network(R"({"delay": 4095})")).network->modes.size(), 4096U);
  EXPECT_EQ(test::read(network(R"({"burst": {"length": 4095, "gap": 1}})")).network->modes.size(), 4096U);
  EXPECT_EQ(test::read(network(R"({"weakly_hard": {"misses": 2, "window": 91}})")).network->modes.size(),
            4095U);
  EXPECT_EQ(test::read(network(R"({"weakly_hard": {"misses": 4095, "window": 4096}})")).network->modes.size(),
            4096U);
}

}  // namespace
}  // namespace coordreq
