#pragma once

#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/fe/second_order_system.h>
#include <vibrocontact/scene/contact_grid.h>

#include <memory>

namespace vibrocontact
{
  /// Matrices, loads, rigid motions, places of the dofs and surface of a meshed body; with the trace on @p grid unless
  /// that is null. Collective.
  template <int dim>
  std::unique_ptr<SecondOrderSystem> assemble_body(const ElasticBody<dim> &body,
                                                   const ContactGrid *grid = nullptr);
} // namespace vibrocontact
