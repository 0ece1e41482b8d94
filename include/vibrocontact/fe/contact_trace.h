#pragma once

#include <vibrocontact/fe/trace_row.h>
#include <vibrocontact/scene/contact_grid.h>

#include <vector>

namespace vibrocontact
{
  /// The operator P_c of a meshed body: mean displacement of each contact cell, in the contact directions.
  ///
  ///   (P_c U)_{c,i} = 1/A_i  int tau_i u_c dS,   c = z (normal), x, y   [m]
  ///
  /// with tau_i one on the cell (TractionShape::constant) or the hat function of the point (bilinear); int
  /// tau_i dS = A_i.
  ///
  /// Its transpose spreads a force R_{c,i} = A_i r_{c,i} as the traction tau_i r_{c,i}, so that a uniform
  /// pressure is transmitted exactly whatever the nodes do (patch test), and P_c K^-1 P_c^T is symmetric.
  /// The directions are those of the contact's frame (usually z up, x along the rail, y lateral) for either body: a
  /// body never knows whether it is the first or the second. Replicated on all ranks.
  struct ContactTrace
  {
    /// of several contacts the first
    ContactGrid grid;
    /// rows[contact_row(n, c, i)]: dofs sorted, no constrained dof; 3 n rows
    std::vector<TraceRow> rows;
    /// mean height z of the undeformed surface over each cell, relative to the nominal contact point [m]; n
    std::vector<double> surface_height;
    /// whether the outward normal of the surface under the grid points up, as that of a body below does
    bool faces_up = true;
    /// displacement of the rows where the body moves as a whole by one along z; 3 n, empty: one on normal rows
    std::vector<double> lifting;
  };

  /// The traces of a body in several contacts as one: rows by contact_row() over the points of all.
  ContactTrace joined(const std::vector<ContactTrace> &traces);
} // namespace vibrocontact
