#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/contact/placed_contacts.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// Eulerian slip velocity (Lai et al. 2018, Eq. 1), body 1 minus body 2:
  ///
  ///   s_x = V (xi_x - spin y) + V d(du_x)/dx      s_y = V (xi_y + spin x) + V d(du_y)/dx
  ///
  /// Material flows towards +x, so d/dx is differenced upwind, towards smaller x: a central difference would
  /// decouple odd and even points in the stick zone. The displacement upstream of the contact is not zero,
  /// hence the free columns on that side.
  struct CreepScheme
  {
    std::string name, help;
    /// d/dx u(x_i) = sum_k coefficients[k] u(x_i - k h) / h
    std::vector<double> coefficients;
    /// the spin's lateral slip is taken this many spacings upstream of the point; CONTACT's correction of the
    /// first-order scheme is one sixth
    double spin_shift;
    /// columns that the scheme looks upstream
    unsigned int reach() const { return coefficients.size() - 1; }
    /// the coefficients in a column of the grid, counted from the upstream side: lower-order ones where the
    /// stencil would leave the grid, a single zero in the first column
    const std::vector<double> &at_column(unsigned int i) const;
    /// V d/dx away from the upstream side: factors of u(x_i - k spacing) [1/s]
    std::vector<double> convection(double speed, double spacing) const;
  };

  /// first-order upwind (CONTACT's scheme) and second-order upwind.
  const std::vector<CreepScheme> &creep_schemes();

  /// @throws InputError naming the known schemes
  const CreepScheme &find_creep_scheme(const std::string &name);

  /// Rigid part of the slip at all points, y = (0, s_x, s_y) by contact_row(); 3 n [m/s].
  /// @param creepage of the scene, seen in each contact's frame
  DenseVector rigid_slip(const PlacedContacts &contacts, const CreepScheme &scheme, const Creepage &creepage);

  /// Replaces the tangential rows of a displacement compliance (3 n rows, [m/N]) by slip rows V d/dx [m/(s
  /// N)], x and V of each contact's own grid. In the first columns, where the stencil leaves the grid, lower-order differences are used; such
  /// points must stay open (see check_contact_in_grid).
  void convert_to_slip_rows(const PlacedContacts &contacts, const CreepScheme &scheme, double speed,
                            DenseMatrix &matrix);
} // namespace vibrocontact
