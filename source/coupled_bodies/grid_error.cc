#include <vibrocontact/coupled_bodies/grid_error.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  double utilisation(const double Tx, const double Ty, const double bound)
  {
    return bound > 0 ? std::hypot(Tx, Ty) / bound : 0;
  }

  std::string too_few_coarse_points(const unsigned int contact_points)
  {
    constexpr unsigned int fewest = 4;
    return contact_points < fewest
               ? "fewer than " + std::to_string(fewest) + " points are in contact on the coarser grid"
               : "";
  }

  namespace
  {
    /// By where the contact's edge lies in its cells, extrapolated forces scatter over alignments of the grid by this much of mu N, rms,
    /// over the number of points in contact: as the square of the spacing over the size (measured, doc/contact.md "Creep and grid").
    constexpr double alignment_scatter = 0.4;

    /// What the coarse grid says about the resultants of a contact: their error, or what they tend to. The error is that of
    /// force and moment together: either of them alone may happen to be the same on both grids.
    /// @param area of a cell of the own grid [m^2]
    void take_coarse(const RollingGrids &grids, const double area, const ContactResultants &coarse,
                     ContactResultants &own)
    {
      if (!(own.normal_force > 0) || !(coarse.normal_force > 0))
      {
        if (own.normal_force > 0)
          own.error_not_known = "the contact is open on the coarser grid";
        return;
      }
      // of two grids under a given approach the normal forces differ
      const double scale = own.normal_force / coarse.normal_force,
                   x = own.tangential_force[0] - scale * coarse.tangential_force[0],
                   y = own.tangential_force[1] - scale * coarse.tangential_force[1],
                   moment = own.spin_moment - scale * coarse.spin_moment,
                   radius = std::sqrt(own.contact_points * area / dealii::numbers::PI),
                   bound = own.friction * own.normal_force;
      const bool bounded = own.utilisation <= 1 + 1e-9;
      const std::string too_few = too_few_coarse_points(coarse.contact_points);
      if (!too_few.empty())
        own.error_not_known = too_few;
      else
      {
        // That friction limits the force leaves this much of a change that the moment alone shows, or neither of the two where
        // both grids happen to agree.
        const double left = bound * std::max(0., 1 - std::min(own.utilisation, coarse.utilisation)),
                     unseen =
                         std::hypot(grids.error_factor * moment / radius,
                                    grids.extrapolates ? alignment_scatter * bound / own.contact_points : 0.);
        own.normal_force_error = grids.error_factor * std::abs(own.normal_force - coarse.normal_force);
        const double by_normal_force =
            own.normal_force_error / own.normal_force *
            std::hypot(own.tangential_force[0], own.tangential_force[1], own.spin_moment / radius);
        const double difference = grids.error_factor * std::hypot(x, y);
        own.force_error = std::hypot(difference, bounded ? std::min(unseen, left) : unseen, by_normal_force);
        own.moment_error = radius * std::hypot(difference, unseen, by_normal_force);
      }
      if (!grids.extrapolates)
        return;
      own.tangential_force[0] += x;
      own.tangential_force[1] += y;
      own.spin_moment += moment;
      own.utilisation = utilisation(own.tangential_force[0], own.tangential_force[1], bound);
      if (bounded && own.utilisation > 1)
      {
        // what overshoots the bound lies on it
        for (double &force : own.tangential_force)
          force /= own.utilisation;
        own.utilisation = 1;
      }
    }
  } // namespace

  void take_coarse(const RollingGrids &grids, const RollingResult &coarse, RollingResult &own)
  {
    const PlacedContacts &contacts = grids.own.interface.contacts;
    double normal_force_error = 0, force_error = 0, moment_error = 0;
    bool known = true;
    for (unsigned int c = 0; c < own.contacts.size(); ++c)
    {
      ContactResultants &one = own.contacts[c];
      take_coarse(grids, contacts.all[c].grid.cell_area(), coarse.contacts[c], one);
      if (one.contact_points == 0)
        continue;
      if (one.force_error < 0)
      {
        known = false;
        own.error_not_known = one.error_not_known;
      }
      normal_force_error += one.normal_force_error;
      force_error += one.force_error;
      moment_error += one.moment_error;
    }
    if (own.contacts.size() == 1)
      take_coarse(grids, contacts.only().cell_area(), coarse, own);
    else if (known)
    {
      own.normal_force_error = normal_force_error;
      own.force_error = force_error;
      own.moment_error = moment_error + grids.error_factor * std::abs(own.spin_moment - coarse.spin_moment);
    }
    if (own.rolling_case.normal_force > 0 && own.normal_force_error > 0)
      own.normal_force_error = 0; // given, but for rounding
  }

  bool starts_open(const PlacedContacts &contacts, const RollingResult &result)
  {
    for (unsigned int k = 0; k < contacts.all.size() && result.rolling_case.creepage.speed > 0; ++k)
    {
      const ContactGrid &grid = contacts.all[k].grid;
      for (unsigned int j = 0; j < grid.n_y && grid.n_x > 1; ++j)
        if (result.solution.status[contacts.first_point(k) + grid.index(0, j)] != ContactStatus::open)
          return false;
    }
    return true;
  }
} // namespace vibrocontact
