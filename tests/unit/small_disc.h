#pragma once

#include <vibrocontact/fe/revolved_section.h>

#include <deal.II/grid/grid_generator.h>

#include <memory>

namespace vibrocontact
{
  /// A disc of four cells held at its bore.
  inline RevolvedSection small_disc(const double loss_factor)
  {
    const auto section = std::make_shared<dealii::Triangulation<2>>();
    dealii::GridGenerator::subdivided_hyper_rectangle(*section, {1u, 4u}, {-0.02, 0.05}, {0.02, 0.25}, true);
    ElasticModel<3> model;
    model.material.loss_factor = loss_factor;
    model.held = {2};
    return RevolvedSection("disc", section, model, 2);
  }
} // namespace vibrocontact
