#include <vibrocontact/base/named_table.h>
#include <vibrocontact/contact/creep.h>

#include <algorithm>

namespace vibrocontact
{
  const std::vector<CreepScheme> &creep_schemes()
  {
    static const std::vector<CreepScheme> table = {
        {"first-order upwind", "difference over one cell, as CONTACT does", {1., -1.}, 1. / 6.},
        {"second-order upwind", "one-sided three-point difference", {1.5, -2., 0.5}, 0.}};
    return table;
  }

  const std::vector<double> &CreepScheme::at_column(const unsigned int i) const
  {
    static const std::vector<double> none = {0.};
    if (i == 0)
      return none;
    return i >= reach() ? coefficients : creep_schemes().front().coefficients;
  }

  std::vector<double> CreepScheme::convection(const double speed, const double spacing) const
  {
    std::vector<double> factors = coefficients;
    for (double &factor : factors)
      factor *= speed / spacing;
    return factors;
  }

  const CreepScheme &find_creep_scheme(const std::string &name)
  {
    return find_named(creep_schemes(), name, "creep scheme");
  }

  DenseVector rigid_slip(const PlacedContacts &contacts, const CreepScheme &scheme, const Creepage &creepage)
  {
    const unsigned int n = contacts.n_points();
    DenseVector slip(3 * n);
    unsigned int first = 0;
    for (const PlacedContact &contact : contacts.all)
    {
      const ContactGrid &grid = contact.grid;
      const Creepage seen = contact.seen(creepage);
      for (unsigned int i = 0; i < grid.n_points(); ++i)
      {
        slip[contact_row(n, 1, first + i)] = seen.sliding_x - seen.sliding_rotation * grid.y(i) +
                                             seen.speed * (seen.longitudinal - seen.spin * grid.y(i));
        slip[contact_row(n, 2, first + i)] =
            seen.sliding_y + seen.sliding_rotation * grid.x(i) +
            seen.speed * (seen.lateral + seen.spin * (grid.x(i) - scheme.spin_shift * grid.spacing_x));
      }
      first += grid.n_points();
    }
    return slip;
  }

  void convert_to_slip_rows(const PlacedContacts &contacts, const CreepScheme &scheme, const double speed,
                            DenseMatrix &matrix)
  {
    const unsigned int n = contacts.n_points();
    std::vector<double> displacement(2 * n);
    for (unsigned int column = 0; column < matrix.n(); ++column)
    {
      double *const tangential = &matrix(n, column);
      std::copy(tangential, tangential + 2 * n, displacement.begin());
      unsigned int first = 0;
      for (const PlacedContact &contact : contacts.all)
      {
        const ContactGrid &grid = contact.grid;
        const double factor = speed * contact.share_of_speed() / grid.spacing_x;
        for (const unsigned int begin : {first, n + first})
          for (unsigned int i = 0; i < grid.n_points(); ++i)
          {
            const std::vector<double> &c = scheme.at_column(i % grid.n_x);
            double derivative = 0;
            for (unsigned int k = 0; k < c.size(); ++k)
              derivative += c[k] * displacement[begin + i - k];
            tangential[begin + i] = factor * derivative;
          }
        first += grid.n_points();
      }
    }
  }
} // namespace vibrocontact
