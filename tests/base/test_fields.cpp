// Fields and values: every number of a structure is seen, in the order of its declaration, and what does not fit is
// not taken.
#include "base/fields.h"

#include <gtest/gtest.h>

#include "base/values.h"

namespace hl::test_fields {
namespace {

enum class Kind : std::uint8_t { kOne, kTwo, kThree };

struct Inner {
  double a = 1;
  Vec3 v{2, 3, 4};
};
struct Base {
  bool flag = true;
};
struct Own {
  std::array<Inner, 2> inner{};
  std::optional<double> number;
  std::uint32_t count = 7;
  std::int64_t time = -9;
  std::uint64_t key = ~0ULL;
  Kind kind = Kind::kTwo;
};
struct Whole : Base, Own {};

template <typename Visit>
void visitFields(Whole& whole, Visit& visit) {
  visitBases<Base, Own>(whole, visit);
}

TEST(Fields, AreSeenInTheOrderOfTheirDeclaration) {
  Whole whole;
  whole.number = 5;
  whole.inner[1].a = -1;
  const Values values = valuesOf(whole);
  EXPECT_EQ(values.numbers, (std::vector<double>{1, 2, 3, 4, -1, 2, 3, 4, 5}));
  EXPECT_EQ(values.integers, (std::vector<std::int64_t>{1, 1, 7, -9, -1, 1}));
  Whole back;
  EXPECT_EQ(setFrom(values, back), Fit::kFits);
  EXPECT_EQ(valuesOf(back), values);
}

TEST(Fields, AnEnumerationKnowsItsNames) {
  EXPECT_TRUE(isNamed(Kind::kOne));
  EXPECT_TRUE(isNamed(Kind::kThree));
  EXPECT_FALSE(isNamed(static_cast<Kind>(3)));
  EXPECT_FALSE(isNamed(static_cast<Kind>(255)));
}

TEST(Values, ThatAFieldCanNotHoldAreNotTaken) {
  const Values good = valuesOf(Whole{});
  const std::size_t flag = 0, count = 2, kind = 5;
  for (const auto& [at, value] : {std::pair<std::size_t, std::int64_t>{flag, 2},
                                  {count, -1},
                                  {count, 1LL << 32},
                                  {kind, 3},
                                  {kind, 256},
                                  {kind, -1}}) {
    Values bad = good;
    bad.integers[at] = value;
    Whole whole;
    EXPECT_EQ(setFrom(bad, whole), Fit::kImpossible) << at << " " << value;
    EXPECT_EQ(valuesOf(whole), good);
  }
}

TEST(Values, OfAnotherFormAreReported) {
  for (const bool more : {true, false}) {
    Values values = valuesOf(Whole{});
    more ? values.numbers.push_back(1) : values.numbers.pop_back();
    Whole whole;
    EXPECT_EQ(setFrom(values, whole), Fit::kOtherForm);
    values = valuesOf(Whole{});
    more ? values.integers.push_back(1) : values.integers.pop_back();
    EXPECT_EQ(setFrom(values, whole), Fit::kOtherForm);
  }
}

}  // namespace
}  // namespace hl::test_fields
