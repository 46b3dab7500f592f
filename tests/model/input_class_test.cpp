#include "model/input_class.hpp"

#include <gtest/gtest.h>

namespace coordreq {
namespace {

InputSpace three_inputs() {
  return InputSpace({{"a", {0, 1}}, {"b", {0, 1, 2}}, {"c", {0, 1}}});
}

TEST(InputClass, NumbersActionsRowMajorOverItsInputs) {
  InputClass ends(three_inputs(), {2, 0});
  EXPECT_EQ(ends.inputs(), (std::vector<std::int32_t>{0, 2}));
  EXPECT_TRUE(ends.contains(2));
  EXPECT_FALSE(ends.contains(1));
  EXPECT_EQ(ends.actions(), 4);
  EXPECT_EQ(ends.bytes(), 1);
  const std::int64_t u = 1 * 6 + 2 * 2 + 1;  // (1, 2, 1)
  EXPECT_EQ(ends.action(u), 3);
  EXPECT_EQ(ends.strides(), (std::vector<std::int64_t>{2, 0, 1}));
  EXPECT_EQ(ends.offsets(), (std::vector<std::int64_t>{0, 1, 6, 7}));
  EXPECT_EQ(ends.offsets({100, 10, 1}), (std::vector<std::int64_t>{0, 1, 100, 101}));
  EXPECT_EQ(ends.project({0, 2, 4, u}), (std::vector<std::int64_t>{0, 3}));
}

TEST(InputClass, SaysTheSameFromATable) {
  const InputSpace space = three_inputs();
  const InputClass plain(space, {1, 2});
  InputClass tabulated = plain;
  tabulated.tabulate();
  for (std::int64_t u = 0; u < space.count(); ++u) EXPECT_EQ(tabulated.action(u), plain.action(u));
}

TEST(InputClass, OfAllInputsHasJointInputsForActions) {
  const InputSpace space = three_inputs();
  const InputClass all = whole_class(space);
  EXPECT_EQ(all.actions(), space.count());
  for (std::int64_t u = 0; u < space.count(); ++u) EXPECT_EQ(all.action(u), u);
  EXPECT_EQ(single_classes(space)[1].inputs(), std::vector<std::int32_t>{1});
}

TEST(InputClass, MayBeEmpty) {
  const InputClass none(three_inputs(), {});
  EXPECT_EQ(none.actions(), 1);
  EXPECT_EQ(none.action(5), 0);
  EXPECT_EQ(none.offsets(), std::vector<std::int64_t>{0});
}

}  // namespace
}  // namespace coordreq
