// Labels find places that no other label covers.
#include <gtest/gtest.h>

#include "viewer/render/label_places.h"

namespace viewer {
namespace {

constexpr LabelBox kWanted = {100, 50, 160, 63};
constexpr float kAnchor = 94;

TEST(LabelPlaces, TheFirstLabelGetsThePlaceItWants) {
  LabelPlaces places(360, 13);
  const auto found = places.find(kWanted, kAnchor);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->x0, kWanted.x0);
  EXPECT_EQ(found->y0, kWanted.y0);
}

TEST(LabelPlaces, TheSecondGoesToTheOtherSideOfItsAnchor) {
  LabelPlaces places(360, 13);
  places.take(kWanted);
  const auto found = places.find(kWanted, kAnchor);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->x1, 2 * kAnchor - kWanted.x0);
  EXPECT_EQ(found->y0, kWanted.y0);
}

TEST(LabelPlaces, NoTwoOverlapAndWhatHasNoRoomIsLeftOut) {
  LabelPlaces places(360, 13);
  std::vector<LabelBox> all;
  while (const auto found = places.find(kWanted, kAnchor)) {
    for (const LabelBox& other : all) EXPECT_FALSE(found->overlaps(other));
    all.push_back(*found);
    ASSERT_LT(all.size(), 100u);
  }
  EXPECT_EQ(all.size(), 30u) << "15 lines, two sides";
}

TEST(LabelPlaces, PlacesOutsideOfThePictureAreNoError) {
  LabelPlaces places(20, 13);
  EXPECT_TRUE(places.find({-80, -300, -10, -287}, -86));
  EXPECT_TRUE(places.find({-80, 900, -10, 913}, -86));
}

}  // namespace
}  // namespace viewer
