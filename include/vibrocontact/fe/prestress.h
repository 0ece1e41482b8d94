#pragma once

#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/fe/material_flow.h>
#include <vibrocontact/fe/second_order_system.h>

#include <memory>

namespace vibrocontact
{
  /// What the static answer to the loads was like.
  struct PrestressNumbers
  {
    /// largest equivalent stress of von Mises at a quadrature point [Pa]
    double largest_stress = 0;
    /// largest derivative of the displacement there: the stiffness is of first order in it [-]
    double largest_gradient = 0;
  };

  /// First-order (linear) prestress of a body under its loads. With the stress sigma of their static answer u_0 on the
  /// undeformed body, small motions v about it feel
  ///
  ///   M v'' + 2 Omega G v' + (K + K_sigma - K_Omega + K_p) v = f
  ///
  ///   K_sigma (a,i)(b,j) = delta_ij int N_a,k sigma_kl N_b,l dV                  geometric stiffness
  ///   K_Omega (a,i)(b,j) = Omega^2 int rho N_a N_b (delta_ij - e_i e_j) dV       softening: v moves off the axis e
  ///   K_p     (a,i)(b,j) = p int N_a (n_i N_b,j - n_j N_b,i) dS                  the pressure turns with its surface
  ///
  /// K_p is taken by its symmetric part, which is all of it if the edge of the pressed surface is held, is closed or moves in
  /// its own plane (Bathe, Finite Element Procedures, 6.2.3; Nelson & Prime 1978 for the whole of it). The deformed
  /// shape enters nothing else, as in every linear prestress: a blade's untwist is not in its frequencies.
  ///
  /// Adds the three terms to the stiffness of @p system. @param displacement u_0, owned values. Collective.
  template <int dim>
  PrestressNumbers add_prestress(const ElasticBody<dim> &body,
                                 const dealii::PETScWrappers::MPI::Vector &displacement,
                                 SecondOrderSystem &system);

  /// G_{(a,i)(b,j)} = int rho N_a e_i . (e x e_j) N_b dV of Coriolis forces 2 Omega G v', antisymmetric, as the part of a
  /// MaterialFlow that is felt by inertia. @param system of the body, with its stiffness. Collective.
  std::shared_ptr<const MaterialFlow> coriolis_of(const ElasticBody<3> &body,
                                                  const SecondOrderSystem &system);
} // namespace vibrocontact
