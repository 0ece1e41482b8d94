#pragma once

#include <vibrocontact/bodies/patch_shapes.h>
#include <vibrocontact/contact/creep.h>
#include <vibrocontact/coupled_bodies/contact_pair.h>

#include <vector>

namespace vibrocontact
{
  /// The few shapes in which modes, poles and contact meet, and how they move gaps and slips.
  struct MovingShapes
  {
    /// where poles have gradients, behind these one number per row that has one; its column of the basis is zero
    PatchShapes shapes;
    /// how many stand before them: those that forces act through
    unsigned int n_loaded = 0;
    /// Gap and slip by displacements of the shapes (their normal rows, V d/dx of their tangential rows), and
    /// by velocities (tangential rows); 3 n x rank
    DenseMatrix by_displacement, by_velocity;
    /// right and left shapes of the poles in terms of the shapes; rank x n_poles
    ComplexMatrix right, left;

    unsigned int rank() const { return shapes.rank(); }
  };

  /// Shapes of modes and poles without gradients, the same for all speeds (patch_shapes()).
  PatchShapes shapes_of_steps(const ContactPair &pair);
  /// @param speed V [m/s] @param known shapes_of_steps(); null: they are found
  MovingShapes moving_shapes(const ContactPair &pair, const CreepScheme &scheme, double speed,
                             const PatchShapes *known = nullptr);
  /// The same on some rows, for those shapes that move any of them: gradients of poles have one for each row of the grid.
  MovingShapes on_rows(const MovingShapes &all, const std::vector<unsigned int> &rows);
  /// 2 Re beside -2 Im of complex shapes: 2 Re of shapes z is their product with Re z above Im z.
  DenseMatrix parts_of(const ComplexMatrix &shapes);
} // namespace vibrocontact
