#pragma once

#include <vibrocontact/scene/contact_grid.h>
#include <vibrocontact/waveguide/crown_compliance.h>
#include <vibrocontact/waveguide/rail_section.h>

#include <complex>
#include <vector>

namespace vibrocontact
{
  /// A periodic track at the points of a contact on its crown,
  ///
  ///   G(s) = W + B (R(s) - R_bed) B^T,
  ///
  /// W the compliance of the rail on an even elastic bed (crown_compliance.h), R receptances of the track for the six motions
  /// of the patch as a whole (track_loads.h), R_bed those of the rail on the bed at rest. What supports, inertia and losses add
  /// to the rail on its bed varies over lengths of waves: over a patch of a few centimetres it is a rigid motion. The indentation
  /// near the points is no rigid motion; it stands in W and cancels in R - R_bed.
  class TrackInContact
  {
  public:
    struct Settings
    {
      /// motions up to this frequency [Hz]
      double up_to = 6000;
      /// see SmoothShapesSettings: no indentation has to be resolved
      double tolerance = 0.3;
      CrownWaves waves = {};
    };

    /// @param known shapes() of another one with the same section, patch and settings; null, or of other dofs: they are found
    /// @throws InputError if the grid leaves the crown
    TrackInContact(const BodyParameters &body, const RailParameters &rail, const ContactGrid &grid,
                   const Settings &settings, const SectionShapes *known = nullptr);

    /// R(s) for translations along x, y, z and rotations about them times radius(); 6 square [m/N].
    /// @param omega [rad/s]; complex: -i s, see PeriodicTrack::AtFrequency
    ComplexMatrix receptance(std::complex<double> omega) const;
    /// R at rest, without losses: what an equilibrium sees.
    const DenseMatrix &at_rest() const { return elastic; }
    /// R of so fast a motion (real s, beyond the band) that indentation is what is left.
    const DenseMatrix &at_once() const { return fast; }
    /// R_bed
    const DenseMatrix &on_bed() const { return even_bed; }
    /// by which rotations are lengths [m]
    double radius() const { return arm; }

    unsigned int n_section_dofs() const { return section.elements.n_dofs(); }
    /// in which the section moves
    const SectionShapes &shapes() const { return section_shapes; }

    /// W; 3 n square [m/N]. Collective.
    DenseMatrix bed_compliance() const;
    /// mean height of the crown over each cell, over the contact [m]
    std::vector<double> surface_height() const;

    /// B; 3 n x 6
    DenseMatrix motions;

  private:
    const RailSection section;
    const ContactGrid grid;
    HalfSpaceMaterial material;
    CrownWaves waves;
    double arm = 0;
    PeriodicTrack track;
    SectionShapes section_shapes;
    std::vector<AxialLoad> loads;
    DenseMatrix elastic, fast, even_bed;
  };
} // namespace vibrocontact
