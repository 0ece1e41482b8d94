#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/scene/axle.h>

namespace vibrocontact
{
  /// Mass and stiffness of an axle between two hubs, square: six motions of the hub of body 1, six of the other, dofs in between.
  struct AxleMatrices
  {
    DenseMatrix mass, stiffness;
  };

  /// Finite elements of an axle as a Timoshenko beam of round section (FE_Q<1> in six fields, consistent mass, full
  /// integration). With s from the hub of body 1 to the other (along -y), its displacements u along x, y, z, its
  /// rotations w about them,
  ///
  ///   2 E_pot = int E A u_y'^2 + 2 G I w_y'^2 + E I (w_x'^2 + w_z'^2) + k G A [(u_x' - w_z)^2 + (u_z' + w_x)^2] ds
  ///   2 E_kin = int rho [A (u_x.^2 + u_y.^2 + u_z.^2) + 2 I w_y.^2 + I (w_x.^2 + w_z.^2)] ds
  ///
  /// A hub's motions are its translations along x, y, z [m] and rotations about them [-], with which the end of the beam moves.
  /// @param n_elements, degree of the elements: the default has bending to 20 kHz within 1e-6 for 1.5 m of steel
  AxleMatrices axle_matrices(const AxleParameters &axle, unsigned int n_elements = 4,
                             unsigned int degree = 8);
} // namespace vibrocontact
