#pragma once

#include <deal.II/distributed/tria_base.h>

namespace vibrocontact
{
  /// How compact a body is, of which the factors of its stiffness tell: 1 for a cube, less the more slender.
  ///
  /// Nested dissection cuts a body by its cross-sections. With levels l of the cells' graph (neighbours across faces, from
  /// a cell at an end), n_l dofs in a level and w_l on a cut through it, the factors have some sum_l n_l w_l^(1/2) entries:
  /// n^(4/3) of a cube, n times the root of its section for a bar. Returned is that sum over that of a cube of as many cells.
  /// Coarse cells count by the active cells in them. Collective.
  double mesh_compactness(const dealii::parallel::TriangulationBase<3> &triangulation);
} // namespace vibrocontact
