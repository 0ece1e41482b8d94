#pragma once

#include <vibrocontact/bodies/rolling_modes.h>
#include <vibrocontact/contact/half_space.h>
#include <vibrocontact/fe/revolved_section.h>
#include <vibrocontact/reduction/reduction_parts.h>
#include <vibrocontact/reduction/revolved_shapes.h>
#include <vibrocontact/reduction/surface_shapes.h>

#include <memory>
#include <optional>
#include <vector>

namespace vibrocontact
{
  struct WaveMode;

  /// The reductions of a body of revolution, one eigenproblem and one static problem for each number n of waves around its
  /// axle (fe/revolved_section.h). The axle is parallel to y at the height of the tread's radius over the contact.
  ///
  /// Contact compliance: the sum over n <= N of what the section answers, and what a half-space adds with shorter waves
  /// along x (contact/short_waves.h), above the wave number (N + 1/2) / r. Both take the mean displacement of a cell under
  /// the mean traction of another one, as solid bodies do (fe/contact_trace.h).
  ///
  /// Every rank reduces its own share of the n. All members are collective. Static answers are in revolved_reduction.cc, modes of
  /// the section for each n in revolved_waves.cc, those of the body in revolved_modes.cc.
  class RevolvedReduction
  {
  public:
    struct Contact
    {
      ContactGrid grid;
      dealii::types::boundary_id tread;
      /// of the tread at the contact
      HalfSpaceMaterial material;
      /// N
      unsigned int n_harmonics;
      /// see StaticReduction; n_points
      std::vector<double> surface_height;
    };

    /// @param section held, so that no motion is rigid; @param radius of the tread at the contact, lateral_position of the contact in the section [m]
    /// @param contact none if no analysis has contact
    RevolvedReduction(std::unique_ptr<const RevolvedSection> section, const std::string &name, double radius,
                      double lateral_position, const std::optional<Contact> &contact, MPI_Comm communicator);

    StaticReduction statics() const;
    /// Every mode of n > 0 is two, even and odd. With shapes on the surface and on the section. Losses of materials are not
    /// in it: they follow from the section (reduction/damped_wheel.h).
    /// @param flow what a rotation does to the modes; null: it is not asked for
    ModalReduction modes(const ModeParameters &parameters, const WheelFrame &frame, SurfaceShapes &shapes,
                         RevolvedShapes &on_section, FlowReduction *flow = nullptr) const;

    const RevolvedSection &elements() const { return *section; }
    unsigned int n_section_dofs() const { return section->n_dofs(); }
    /// of the compliance; 0 without contact
    unsigned int n_waves() const { return contact ? contact->n_harmonics : 0; }
    /// The points of the surface alone.
    SurfaceShapes surface() const;

  private:
    /// Contact rows (3 n_points) by those of the section, component c of row j of cells as [c n_y + j]; n = 0: both families
    DenseMatrix around(unsigned int n, bool odd) const;
    /// From normal and tangent of the tread at each point to z and x.
    void turn_with_tread(DenseMatrix &compliance) const;
    void add_rotation(const RevolvedRotation &rotation, const Modes &modes, WaveMode &mode) const;
    /// @param stretched by centrifugal forces per Omega^2; null: no rotation
    std::vector<WaveMode> modes_of(unsigned int n, const ModeParameters &parameters, const WheelFrame &frame,
                                   const dealii::PETScWrappers::MPI::Vector *stretched) const;
    /// n = 0, 1, ... shared out over the ranks, ascending in frequency
    std::vector<WaveMode> all_modes(const ModeParameters &parameters, const WheelFrame &frame,
                                    bool rotates) const;
    FlowReduction flow_of(const std::vector<WaveMode> &modes) const;
    SurfaceShapes surface_shapes(const std::vector<WaveMode> &modes) const;
    RevolvedShapes revolved_shapes(const std::vector<WaveMode> &modes) const;

    const std::unique_ptr<const RevolvedSection> section;
    const std::string name;
    const double radius, lateral_position;
    const std::optional<Contact> contact;
    /// rows of the section at the contact, see around(); none without contact
    std::vector<TraceRow> tread_rows;
    const MPI_Comm communicator;
  };
} // namespace vibrocontact
