#pragma once

#include <vibrocontact/scene/contact_refinement.h>
#include <vibrocontact/scene/section_parameters.h>

#include <utility>

namespace vibrocontact
{
  /// A wheel: its half section revolved about the axle.
  ///
  ///      z ^
  ///        |   - - - - - axle - - - - -     the axle lies at z = tread radius above the contact point,
  ///        |        ___________             which is the origin; y = axial position in the section less
  ///        |       |___________|  bore      the lateral position of the contact
  ///        |           | |     hub
  ///        |           | |     web          boundaries: bore, contact (the tread), surface (all else)
  ///        |     |\____| |____
  ///        |     |____________|  rim
  ///      --+-----------*-----------> y      tread, z = 0
  ///           flange
  struct WheelParameters
  {
    SectionParameters section{"wheel"};
    /// gmsh file to write the coarse mesh to; empty: none
    std::string write_mesh;
    /// similar wheels: all lengths times this factor
    double scale = 1;
    /// circumferential lengths of cells on the tread: at the contact, and largest far from it [m]; growth
    double contact_division = 0.008, coarse_division = 0.055, growth = 1.6;
    /// the fine divisions reach this far to either side of the contact [m]
    double fine_length = 0.016;
    ContactRefinement refinement;

    void declare_parameters(dealii::ParameterHandler &prm);
    void check(const std::string &path) const;
  };

  /// @param lateral_position y of the contact in the section [m]
  /// @param grid contact grid to refine for; null: none
  /// @param materials groups of the section with a material each; empty: one material
  /// @throws InputError if the contact does not lie on the tread.
  BodyMesh<3> make_wheel(const WheelParameters &parameters, const double lateral_position,
                         const ContactGrid *grid, const std::string &name, const MPI_Comm communicator,
                         const std::vector<std::string> &materials = {});

  /// Attach the manifolds of a body of revolution to a coarse mesh by geometry: also used for a wheel that
  /// was read from a mesh file. Returns the outline's row of every boundary face, by cell and face number in
  /// mesh order.
  std::vector<unsigned int> attach_wheel_manifolds(dealii::Triangulation<3> &triangulation,
                                                   const SectionOutline &outline, const double axis_height,
                                                   const double shift);

  /// Axial positions between which the tread lies, fillets left out [m].
  std::pair<double, double> tread_limits(const SectionOutline &outline);

  /// Radius of the tread at an axial position [m].
  double tread_radius(const SectionOutline &outline, const double lateral_position);
} // namespace vibrocontact
