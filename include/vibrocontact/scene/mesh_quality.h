#pragma once

#include <deal.II/base/point.h>
#include <deal.II/grid/tria_description.h>

#include <string>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// Looks at the cells of a file before anything is made of them: every cell has to be right-handed at all
  /// corners, no sliver, joined to the others by faces (edges), and no face belongs to more than two.
  ///
  /// A sliver has an edge below 1e-4 of its longest or a corner whose edges span less than 1e-3 of a right
  /// one: its stiffness drowns that of its neighbours in round-off, and modes and contact find no end. Cells
  /// within 1e-2 and 0.05 are announced in the log with their place.
  ///
  /// @param cells vertices in deal.II's order
  /// @param glued lists of faces, by their vertices, that join the cells behind them as well
  /// @param way_out what else joins pieces, end of a sentence; empty: nothing
  /// @throws InputError with the number of bad cells, the first of them and its place [m]
  template <int dim>
  void check_cells(const std::vector<dealii::Point<dim>> &vertices,
                   const std::vector<dealii::CellData<dim>> &cells, const std::string &file,
                   const std::vector<std::vector<std::vector<unsigned int>>> &glued = {},
                   const std::string &way_out = "");

  /// Refuses a mesh that no machine could hold, before it is made: more than 2e7 unknowns (some 500 GB to
  /// factorise).
  /// @param n_cells cells that are about to be made
  /// @param advice what to do, "make Coarse division larger"
  template <int dim>
  void check_number_of_cells(double n_cells, unsigned int degree, const std::string &body,
                             const std::string &advice);
} // namespace vibrocontact
