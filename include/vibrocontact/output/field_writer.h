#pragma once

#include <vibrocontact/fe/elastic_body.h>

#include <array>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// One state of a body: displacement of its owned dofs, under a name such as a case number, at a time,
  /// frequency or case number that orders the set.
  struct FieldState
  {
    const dealii::PETScWrappers::MPI::Vector *displacement = nullptr;
    double time = 0;
    /// rigid vertical displacement added to it, that of a hub [m]
    double vertical = 0;
  };

  /// fields/<set>_<k>.vtu: the k-th file of a set, relative to the output folder.
  std::string field_name(const std::string &set, unsigned int k);

  /// Write states of a body as <folder>/fields/<set>_<k>.vtu with <folder>/<set>.pvd on top: displacement_m
  /// and von_mises_Pa in the volume. The whole body is written, hanging and held values filled in.
  /// Collective. @param place of the body in the scene (contact/body_places.h) [m] @throws OutputError
  template <int dim>
  void write_fields(const ElasticBody<dim> &body, const std::vector<FieldState> &states,
                    const std::string &folder, const std::string &set,
                    const std::array<double, 3> &place = {{0, 0, 0}});

  /// The same on the surface alone, displacement only: small files for mode shapes.
  template <int dim>
  void write_surface_fields(const ElasticBody<dim> &body, const std::vector<FieldState> &states,
                            const std::string &folder, const std::string &set,
                            const std::array<double, 3> &place = {{0, 0, 0}});
} // namespace vibrocontact
