#pragma once

#include <vibrocontact/contact/contact_solver.h>
#include <vibrocontact/scene/contact_grid.h>

#include <string>
#include <vector>

namespace vibrocontact
{
  /// gap_m, pressure_Pa, traction_x_Pa, traction_y_Pa (on body 1), slip_x_m_s, slip_y_m_s (body 1 minus body
  /// 2), status (0 open, 1 stick, 2 slip).
  const std::vector<std::string> &contact_patch_columns();
  std::vector<double> contact_patch_values(const ContactSolution &contact, const ContactGrid &grid,
                                           unsigned int point);

  /// The contact patch as cells of the grid with these columns: a VTU file, written by the calling rank.
  /// @param only_closed cells in contact alone (none: the one of the first point, so that the file is valid)
  void write_contact_patch(const ContactSolution &contact, const ContactGrid &grid, bool only_closed,
                           const std::string &file_name);
} // namespace vibrocontact
