#pragma once

#include <vibrocontact/base/dense.h>
#include <vibrocontact/contact/half_space.h>
#include <vibrocontact/scene/contact_grid.h>
#include <vibrocontact/waveguide/section_elements.h>

#include <array>

namespace vibrocontact
{
  /// Which waves along the axis the section's elements answer for.
  struct CrownWaves
  {
    /// K: longer waves are the section's, shorter ones a half-space's [rad/m]
    double shortest = 80;
    /// Gauss points in each octave of wave numbers
    unsigned int points_per_octave = 6;
  };

  /// Static compliance between the cells of a contact grid on the crown of an infinite rail that lies on a continuous elastic
  /// bed: mean displacement of a cell under the mean traction of another one,
  ///
  ///   C = 1/(2 pi) int_-K^K  e^{i k X} sinc^2(k dx/2)  r^T (K(k) + bed)^-1 r  dk  +  the half-space's waves beyond K
  ///
  /// (contact/short_waves.h), r the mean over a cell's width of the section's crown. The integral is real: axial motions are
  /// odd in k. The bed keeps it finite at k = 0.
  /// @param bed springs under the foot in x, y, z [N/m^3]; @param lateral_position of the contact [m]
  /// @return 3 n square, rows as contact_row(), forces and displacements of this body [m/N]. Collective: ranks share the waves.
  DenseMatrix crown_compliance(const SectionElements &elements, const std::array<double, 3> &bed,
                               double lateral_position, const ContactGrid &grid,
                               const HalfSpaceMaterial &material, const CrownWaves &waves = {});
} // namespace vibrocontact
