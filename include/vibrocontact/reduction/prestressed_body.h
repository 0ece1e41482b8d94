#pragma once

#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/fe/second_order_system.h>
#include <vibrocontact/reduction/stiffness_solver.h>

namespace vibrocontact
{
  /// Takes the stress of a body under its loads into its matrices (fe/prestress.h): one static solution u_0 with the stiffness
  /// of the undeformed body, then the terms of first order. The load becomes what holds u_0 with the new stiffness, so that
  /// every analysis finds the body at rest where the linear answer to its loads has brought it. Of a body with Coriolis
  /// forces SecondOrderSystem::flow gets them. Collective.
  ///
  /// @param system assemble_body() of the same body, without trace
  /// @throws ConvergenceError if the new stiffness is not positive definite: the body buckles or flies apart; the direct
  /// solver counts its negative eigenvalues, with the iterative one its modes or solves find out
  void prestress(const ElasticBody<3> &body, StiffnessSolver solver, SecondOrderSystem &system);
} // namespace vibrocontact
