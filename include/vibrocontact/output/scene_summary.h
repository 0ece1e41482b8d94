#pragma once

#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/scene/body.h>
#include <vibrocontact/scene/contact_grid.h>

namespace vibrocontact
{
  /// Writes a body to the log as --check shows it: type, material, size, mesh and what its reduction will
  /// cost the first time (later runs find it in the cache).
  /// @param body null for a half-space; @param grid null without contact
  void print_body(const BodyParameters &parameters, const ElasticBody<3> *body, const ContactGrid *grid);

  /// Writes the contact grid to the log.
  void print_contact_grid(const ContactGrid &grid);
} // namespace vibrocontact
