#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/contact/creepage.h>
#include <vibrocontact/scene/contact_frame.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// One of the contacts of a scene.
  struct PlacedContact
  {
    /// as in the entry Contacts; empty: the only one, of section Contact
    std::string name;
    ContactGrid grid;
    /// on the first body; axes are the same on the second
    ContactFrame frame;
    /// its nominal point in the coordinates of the second body [m]
    std::array<double, 3> origin_below = {{0, 0, 0}};
    /// places in the entry Bodies of the two that it joins, the one above first
    unsigned int above = 0, below = 1;
    /// added to that of the scene, along the contact's own x and y; its speed is not used
    Creepage own;

    /// What a creepage of the scene (along its x and y, about its z) is in this contact.
    Creepage seen(const Creepage &creepage) const;
    /// Speed of the material along the contact's x over the rolling speed [-].
    double share_of_speed() const { return frame.axes[1][0]; }
  };

  /// All contacts of a scene. Their points are numbered one grid after the other; rows go by contact_row() over all points.
  struct PlacedContacts
  {
    std::vector<PlacedContact> all = {PlacedContact()};

    PlacedContacts() = default;
    /// one contact of body 1 on body 2
    PlacedContacts(const ContactGrid &grid) { all.front().grid = grid; }

    unsigned int n_points() const
    {
      unsigned int n = 0;
      for (const PlacedContact &contact : all)
        n += contact.grid.n_points();
      return n;
    }
    /// the grid of a scene of one contact
    ContactGrid &only() { return all.front().grid; }
    const ContactGrid &only() const { return all.front().grid; }
    /// Number of the first point of contact k, and of the contact that a point belongs to.
    unsigned int first_point(unsigned int k) const;
    unsigned int contact_of(unsigned int point) const;

    /// Rows of a body's own contacts, by contact_row() over their points, among all rows.
    struct Rows
    {
      std::vector<unsigned int> rows;
      /// +1 where the body is the first of the contact, -1 where it is the second
      std::vector<double> sign;
    };
    Rows rows_of(unsigned int body) const;
    /// Sums of normal and tangential forces of each contact on its first body [N]. @param R 3 n
    std::vector<std::array<double, 3>> resultants(const DenseVector &R) const;
    /// What these are together for a body, along its x, y, z [N].
    std::array<double, 3> force_on(unsigned int body,
                                   const std::vector<std::array<double, 3>> &resultants) const;
    /// Jump (first body less second) of all rows where a body moves as a whole along its x, y, z; 3 n x 3 [-].
    DenseMatrix translation_of(unsigned int body) const;
    /// The same where a body of revolution turns about x, y, z through a place on its axle, which is parallel to y; 3 n x 3 [m].
    /// About y its surface moves along itself: no gap changes.
    DenseMatrix rotation_of(unsigned int body, const std::array<double, 3> &centre) const;
  };
} // namespace vibrocontact
