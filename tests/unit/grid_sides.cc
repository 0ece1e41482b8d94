// Which points of contact grids lie at sides beyond which the surface goes on, and that a contact must not reach them.

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/interface.h>

#include <gtest/gtest.h>

using namespace vibrocontact;

namespace
{
  ContactGrid grid_of(const unsigned int n_x, const unsigned int n_y)
  {
    ContactGrid grid;
    grid.n_x = n_x;
    grid.n_y = n_y;
    grid.spacing_x = grid.spacing_y = 1;
    return grid;
  }

  /// Three contacts: 4 x 3 points that end with a face upstream, a whole surface of 5, a row of 4; and a point.
  PlacedContacts four_contacts(ContactSections &sections)
  {
    PlacedContacts contacts(grid_of(4, 3));
    contacts.all.resize(4);
    contacts.all[1].grid = grid_of(5, 1);
    contacts.all[1].grid.whole_surface = true;
    contacts.all[2].grid = grid_of(4, 1);
    contacts.all[3].grid = single_point(1);
    sections.all.resize(4, sections.first());
    FlatFace face;
    face.x_low = -0.5;
    face.x_high = 100;
    face.y_low = -100;
    face.y_high = 100;
    sections.all[0].flat_faces = {face};
    return contacts;
  }

  /// What a contact at these points is refused with; empty: it is not.
  std::string refusal(const PlacedContacts &contacts, const ContactSections &sections, const double speed,
                      const std::vector<unsigned int> &closed)
  {
    std::vector<ContactStatus> status(contacts.n_points(), ContactStatus::open);
    for (const unsigned int point : closed)
      status[point] = ContactStatus::slip;
    try
    {
      check_contact_in_grid(contacts, sections, speed, status);
    }
    catch (const InputError &error)
    {
      return error.what();
    }
    return "";
  }
} // namespace

TEST(GridSides, PointsWhereTheSurfaceGoesOn)
{
  ContactSections sections;
  const PlacedContacts contacts = four_contacts(sections);
  // all of the first but the two inner points and the middle one upstream, none of the second, both ends of the third
  EXPECT_EQ(points_at_open_sides(contacts, sections),
            (std::vector<unsigned int>{0, 1, 2, 3, 7, 8, 9, 10, 11, 17, 20}));
}

TEST(GridSides, AContactThatReachesThemIsRefused)
{
  ContactSections sections;
  const PlacedContacts contacts = four_contacts(sections);
  EXPECT_EQ(refusal(contacts, sections, 0, {4, 5, 6, 12, 16, 18, 19, 21}), "");
  EXPECT_NE(refusal(contacts, sections, 0, {7}).find("downstream"), std::string::npos);
  EXPECT_NE(refusal(contacts, sections, 0, {2}).find("lateral"), std::string::npos);
  EXPECT_NE(refusal(contacts, sections, 0, {17}).find("upstream"), std::string::npos);
  // two columns stay free upstream of what rolls
  EXPECT_EQ(refusal(contacts, sections, 10, {6, 19}), "");
  EXPECT_NE(refusal(contacts, sections, 10, {18}).find("two columns"), std::string::npos);
}
