// Where bodies lie beside each other: nominal points of contacts meet, in whichever order they are listed.

#include <vibrocontact/contact/body_places.h>

#include <gtest/gtest.h>

using namespace vibrocontact;

TEST(BodyPlaces, PointsOfContactsMeet)
{
  // 0 on 1 on 3; 2 below 0; 4 touches nothing
  PlacedContacts contacts;
  contacts.all.resize(3);
  const auto join = [&](const unsigned int k, const unsigned int above, const unsigned int below,
                        const std::array<double, 3> &origin, const std::array<double, 3> &origin_below)
  {
    contacts.all[k].above = above;
    contacts.all[k].below = below;
    contacts.all[k].frame.origin = origin;
    contacts.all[k].origin_below = origin_below;
  };
  join(0, 1, 3, {{0, 0, -2}}, {{0, 3, 0}});
  join(1, 0, 2, {{0, 0, 0}}, {{5, 0, 0}});
  join(2, 0, 1, {{1, 0, 0}}, {{0, 0, 0.5}});
  const auto places = places_of_bodies(contacts, 5);
  ASSERT_EQ(places.size(), 5u);
  for (const PlacedContact &contact : contacts.all)
    for (unsigned int d = 0; d < 3; ++d)
      EXPECT_EQ(places[contact.above][d] + contact.frame.origin[d],
                places[contact.below][d] + contact.origin_below[d]);
  EXPECT_EQ(places[0], (std::array<double, 3>{{0, 0, 0}}));
  EXPECT_EQ(places[3], (std::array<double, 3>{{1, -3, -2.5}}));
  EXPECT_EQ(places[4], (std::array<double, 3>{{0, 0, 0}}));
  EXPECT_EQ(places_of_bodies(PlacedContacts()).size(), 2u);
}
