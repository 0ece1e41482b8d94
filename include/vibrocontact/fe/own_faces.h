#pragma once

#include <deal.II/dofs/dof_handler.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// Faces of this rank's cells on some of the boundaries: each by its cell and its number there.
  /// @param boundaries their ids, a vector or a set
  template <int dim, typename Boundaries>
  std::vector<std::pair<typename dealii::DoFHandler<dim>::active_cell_iterator, unsigned int>>
  own_faces(const dealii::DoFHandler<dim> &dof_handler, const Boundaries &boundaries)
  {
    std::vector<std::pair<typename dealii::DoFHandler<dim>::active_cell_iterator, unsigned int>> faces;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && cell->at_boundary())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() &&
              std::count(boundaries.begin(), boundaries.end(), cell->face(f)->boundary_id()) > 0)
            faces.emplace_back(cell, f);
    return faces;
  }
} // namespace vibrocontact
