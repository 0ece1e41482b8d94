#pragma once

#include <vibrocontact/contact/contact_solver.h>
#include <vibrocontact/contact/placed_contacts.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// gap_m, pressure_Pa, traction_x_Pa, traction_y_Pa (on body 1), slip_x_m_s, slip_y_m_s (body 1 minus body
  /// 2), status (0 open, 1 stick, 2 slip).
  const std::vector<std::string> &contact_patch_columns();
  /// @param point among those of all contacts
  std::vector<double> contact_patch_values(const ContactSolution &contact, const ContactGrid &grid,
                                           unsigned int point);
  /// Begin of the names of its files: "contact_patch", with the name of one of several contacts behind it.
  std::string with_contact(const std::string &name, const PlacedContact &contact);

  /// The patch of contact k as cells of the grid with these columns: a VTU file, written by the calling rank.
  /// @param only_closed cells in contact alone (none: the one of the first point, so that the file is valid)
  void write_contact_patch(const ContactSolution &solution, const PlacedContacts &contacts, unsigned int k,
                           bool only_closed, const std::string &file_name);
} // namespace vibrocontact
