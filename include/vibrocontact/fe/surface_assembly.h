#pragma once

#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/fe/surface_trace.h>

namespace vibrocontact
{
  /// Builds the SurfaceTrace of a meshed body. Collective. A plane body lies in the plane y = 0.
  template <int dim>
  SurfaceTrace make_surface_trace(const ElasticBody<dim> &body);
} // namespace vibrocontact
