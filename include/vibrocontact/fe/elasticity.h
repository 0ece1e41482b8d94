#pragma once

#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/fe/second_order_system.h>

namespace vibrocontact
{
  /// Matrices and loads of a linear elastic body (2d: plane strain, per metre of width).
  ///
  ///   K_{(a,i)(b,j)} = int lambda N_a,i N_b,j + mu N_a,j N_b,i + mu delta_ij N_a,k N_b,k dV + springs
  ///   M_{(a,i)(b,j)} = delta_ij int rho N_a N_b dV
  ///   F_{(a,i)}      = int rho (g_i + Omega^2 r_i) N_a dV + int (t_i - p n_i) N_a dS
  ///
  /// of the body before its loads; what their stress changes comes later (fe/prestress.h).
  ///
  /// For an isotropic material all of K follows from the products G = int N_a,i N_b,j dV, one dense rank-k
  /// update per cell. Hanging nodes are condensed and held dofs eliminated symmetrically; constrained rows
  /// keep a positive diagonal in K and none in M.
  template <int dim>
  std::unique_ptr<SecondOrderSystem> assemble_elasticity(const ElasticBody<dim> &body);
} // namespace vibrocontact
