#include "expression/truth_table.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "support/condition_helpers.hpp"
#include "support/random_condition.hpp"

namespace coordreq {
namespace {

using Join = ConditionAtoms::Join;

/// Of the atoms of `text`, or of its negation; 0 if it has none of its own.
std::size_t atom_count(const char* text, bool negated = false) {
  const auto atoms = find_atoms(test::condition(text), negated);
  return atoms ? atoms->atoms.size() : 0;
}

bool is_proven(const ConditionAtoms& atoms, const test::Box& box) {
  std::vector<bool> proven;
  for (const ConditionAtoms::Node& node : atoms.nodes) {
    switch (node.join) {
      case Join::atom:
        proven.push_back(test::decide_naturally(atoms.atoms[node.a], box) == Truth::yes);
        break;
      case Join::always:
      case Join::never:
        proven.push_back(node.join == Join::always);
        break;
      case Join::both:
        proven.push_back(proven[node.a] && proven[node.b]);
        break;
      case Join::either:
        proven.push_back(proven[node.a] || proven[node.b]);
    }
  }
  return proven.back();
}

TEST(ConditionAtoms, JoinedComparisonsAreTakenApart) {
  EXPECT_EQ(atom_count("x >= 1 and y >= 1"), 2U);
  EXPECT_EQ(atom_count("x >= 1 or y >= 1 or not z < 3"), 3U);
  EXPECT_EQ(atom_count("1 <= x < y"), 2U);
  EXPECT_EQ(atom_count("max(x, y) >= 1"), 2U);
  EXPECT_EQ(atom_count("1 > min(x, max(y, z))"), 3U);
  EXPECT_EQ(atom_count("max(x, y) < min(y, z)"), 4U);
}

TEST(ConditionAtoms, WhatIsOneComparisonStaysWhole) {
  EXPECT_EQ(atom_count("x + y >= 1"), 0U);
  EXPECT_EQ(atom_count("not x + y >= 1"), 0U);
  EXPECT_EQ(atom_count("max(x, y) == 1"), 0U);
  EXPECT_EQ(atom_count("max(x, y) != 1"), 0U);
  EXPECT_EQ(atom_count("true"), 0U);
  EXPECT_EQ(atom_count("x >= 1 or x >= 1"), 0U);
}

/// Where the other part is not defined neither is the whole, and then it is not true.
TEST(ConditionAtoms, PartsThatMayBeUndefinedAreNotTakenApart) {
  for (const char* term : {"1 / x", "sqrt(x)", "log(x)", "x^y", "y + 1 / x"}) {
    const std::string text = "max(" + std::string(term) + ", y) >= 1";
    EXPECT_EQ(atom_count(text.c_str()), 0U) << text;
    const std::string other = "y >= min(z, " + std::string(term) + ")";
    EXPECT_EQ(atom_count(other.c_str()), 0U) << other;
  }
  EXPECT_EQ(atom_count("max(1 / x, y) >= 1 and z > 0"), 2U);
}

TEST(ConditionAtoms, VeryManyAreGivenUp) {
  std::string text = "x > 0";
  for (int k = 1; k < 100; ++k) text += " and x != " + std::to_string(k);
  EXPECT_EQ(atom_count(text.c_str()), 0U);
}

TEST(ConditionAtoms, LiteralsAreKept) {
  const auto atoms = find_atoms(test::condition("(x >= 1 and y >= 1) or 1 < 0"), false);
  ASSERT_TRUE(atoms);
  EXPECT_TRUE(is_proven(*atoms, {test::between(1, 2), test::between(1, 2)}));
  EXPECT_FALSE(is_proven(*atoms, {test::between(0, 2), test::between(1, 2)}));
}

/// What the atoms prove on a box is true at all its points; at a point they leave nothing open that is
/// defined.
TEST(ConditionAtoms, WhatTheyProveIsTrue) {
  EXPECT_TRUE(rc::check("atoms against the whole condition", [] {
    const std::string text = test::random_condition(3);
    const Program condition = test::condition(text);
    const auto atoms = find_atoms(condition, false);
    const auto negated = find_atoms(condition, true);
    RC_ASSERT(atoms.has_value() == negated.has_value());
    RC_CLASSIFY(atoms.has_value());
    if (!atoms) return;
    test::Box box;
    for (int i = 0; i < 3; ++i) {
      const Rational first = Rational(test::draw(-4, 8)) / 2;
      box.push_back(test::between(first, first + Rational(test::draw(0, 3)) / 2));
    }
    const bool yes = is_proven(*atoms, box);
    const bool no = is_proven(*negated, box);
    RC_CLASSIFY(yes || no, "settled on the box");
    for (int k = 0; k < 8; ++k) {
      test::Box point;
      for (const RationalInterval& range : box) {
        const Rational value = range.lower + (range.upper - range.lower) * test::draw(0, 4) / 4;
        point.push_back(test::between(value, value));
      }
      const Truth truth = test::decide_naturally(condition, point);
      RC_ASSERT(!yes || truth == Truth::yes);
      RC_ASSERT(!no || truth == Truth::no);
      RC_ASSERT(is_proven(*atoms, point) == (truth == Truth::yes));
      RC_ASSERT(is_proven(*negated, point) == (truth == Truth::no));
    }
  }));
}

}  // namespace
}  // namespace coordreq
