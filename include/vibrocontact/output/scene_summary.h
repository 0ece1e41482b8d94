#pragma once

#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/scene/body.h>
#include <vibrocontact/scene/contact_grid.h>

namespace vibrocontact
{
  /// Writes a body to the log as --check shows it: type, material, size and mesh.
  /// @param body null for a half-space
  void print_body(const BodyParameters &parameters, const ElasticBody<3> *body);

  /// Writes the contact grid to the log.
  void print_contact_grid(const ContactGrid &grid);
} // namespace vibrocontact
