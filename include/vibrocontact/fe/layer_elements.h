#pragma once

#include <vibrocontact/fe/second_order_system.h>
#include <vibrocontact/scene/layer.h>
#include <vibrocontact/scene/material.h>

#include <memory>
#include <string>

namespace vibrocontact
{
  /// Mass, stiffness and contact rows of a layer (scene/layer.h) by ElasticBody<2> or <3>, ready to be
  /// reduced.
  ///
  ///   (P_c U)_{c,i} = U_c at node i of the bottom,   so that R is the nodal force itself
  ///
  /// Rows along y are empty in plane strain. With bilinear elements this is the same constraint as the mean
  /// over hat functions; with quadratic ones a uniform pressure makes nodal forces of 1 : 2 (1 : 2 : 4 in
  /// 3-D) on the bottom's nodes, all of one sign.
  /// @param grid LayerParameters::grid(), null: no contact rows
  std::unique_ptr<SecondOrderSystem> assemble_layer(const LayerParameters &layer,
                                                    const ElasticMaterial &material, const std::string &name,
                                                    const ContactGrid *grid, MPI_Comm communicator);
} // namespace vibrocontact
