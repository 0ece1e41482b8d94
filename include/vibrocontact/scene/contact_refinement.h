#pragma once

#include <vibrocontact/base/entries_read.h>
#include <vibrocontact/scene/body_mesh.h>
#include <vibrocontact/scene/body_use.h>
#include <vibrocontact/scene/contact_grid.h>

#include <deal.II/base/parameter_handler.h>

namespace vibrocontact
{
  /// How a mesh is refined where the scene has a contact grid.
  ///
  ///      |<-margin->|<----- contact grid ----->|<-margin->|
  ///   ---+----------+--------------------------+----------+---   surface
  ///      |                                     ^          |
  ///      |        cells of `cell_size`         | depth    |
  ///      +-------------------------------------v----------+
  ///
  /// One ring of cells of twice that size lies around the box, and so on outwards: hanging nodes stay off the
  /// contact points' cells.
  struct ContactRefinement
  {
    /// edge of a cell at the contact [m]; a contact spacing needs cells up to degree times its size; 0: no
    /// refinement
    double cell_size = 0.002;
    /// how far the fine cells reach beyond the contact grid, at least one fine cell, and below the surface
    /// [m]
    double margin = 0.002, depth = 0.004;

    void declare_parameters(dealii::ParameterHandler &prm);
    void check(const std::string &section) const;
    void add_entries(EntriesRead &entries, const std::string &section, const BodyUse &use) const;
  };

  /// Halve the cells under @p grid until those of the contact surface are at most cell_size (5 % tolerance).
  template <int dim>
  void refine_at_contact(BodyMesh<dim> &mesh, const ContactGrid &grid, const ContactRefinement &parameters,
                         unsigned int degree);

  /// Lengths of the cells on one side of the contact: `fine` up to `fine_length`, then growing by at most
  /// @p ratio to @p coarse, scaled so that they add up to @p total [m].
  std::vector<double> graded_divisions(const double total, const double fine, const double fine_length,
                                       const double coarse, const double ratio);
} // namespace vibrocontact
