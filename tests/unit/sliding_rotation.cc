#include <vibrocontact/contact/creep.h>

#include <gtest/gtest.h>

using namespace vibrocontact;

namespace
{
  ContactGrid small_grid()
  {
    ContactGrid grid;
    grid.n_x = 3;
    grid.n_y = 2;
    grid.spacing_x = 0.01;
    grid.spacing_y = 0.02;
    grid.x_first = -0.01;
    grid.y_first = -0.01;
    return grid;
  }

  DenseVector slip_of(const PlacedContact &contact, const Creepage &creepage)
  {
    PlacedContacts contacts;
    contacts.all = {contact};
    return rigid_slip(contacts, creep_schemes().front(), creepage);
  }
} // namespace

// a pad on a disc: every point slides with omega x r about the axis of the disc
TEST(SlidingRotation, IsOmegaTimesTheRadius)
{
  const double omega = -7;
  PlacedContact contact;
  contact.grid = small_grid();
  contact.frame = contact_frame({{0.1, 0.05, 0.006}}, {{0, 0, 1}});
  Creepage scene;
  scene.speed = 0;
  scene.sliding_rotation = omega;
  const DenseVector slip = slip_of(contact, scene);
  const unsigned int n = contact.grid.n_points();
  for (unsigned int i = 0; i < n; ++i)
  {
    EXPECT_NEAR(slip[contact_row(n, 1, i)], -omega * (0.05 + contact.grid.y(i)), 1e-15);
    EXPECT_NEAR(slip[contact_row(n, 2, i)], omega * (0.1 + contact.grid.x(i)), 1e-15);
  }
}

// told in the contact's own section, about its own origin, it needs the velocity of that origin beside it
TEST(SlidingRotation, OfAContactIsAboutItsOrigin)
{
  const double omega = 3;
  PlacedContact by_scene, by_contact;
  by_scene.grid = by_contact.grid = small_grid();
  by_scene.frame = by_contact.frame = contact_frame({{0.1, -0.02, 0}}, {{0, 0, -1}});
  Creepage turning, at_rest;
  turning.speed = at_rest.speed = 0;
  turning.sliding_rotation = omega;
  // the normal points down: y is turned, and so is the sense of the rotation
  by_contact.own.sliding_x = omega * 0.02;
  by_contact.own.sliding_y = -omega * 0.1;
  by_contact.own.sliding_rotation = -omega;
  const DenseVector one = slip_of(by_scene, turning), other = slip_of(by_contact, at_rest);
  for (unsigned int k = 0; k < one.size(); ++k)
    EXPECT_NEAR(one[k], other[k], 1e-15);
}

// a rotation alone makes a pad slide
TEST(SlidingRotation, Slides)
{
  Creepage creepage;
  EXPECT_FALSE(creepage.slides());
  creepage.sliding_rotation = 1;
  EXPECT_TRUE(creepage.slides());
}
