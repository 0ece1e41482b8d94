#include <vibrocontact/waveguide/track_in_contact.h>
#include <vibrocontact/waveguide/track_loads.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    /// s of at_once() over the highest angular frequency
    constexpr double beyond_band = 3;

    /// The rail on its pads spread evenly over the length, without losses and inertia below the rail.
    PeriodicTrack on_even_bed(const PeriodicTrack &track)
    {
      PeriodicTrack bed = track.regular();
      bed.support.pad_length = track.spacing;
      bed.support.pad_loss = 0;
      bed.support.sleeper.mass = 0;
      bed.slab.reset();
      for (DenseMatrix &loss : bed.section.matrices.loss_stiffness)
        loss = 0;
      return bed;
    }

    PeriodicTrack without_losses(const PeriodicTrack &track)
    {
      PeriodicTrack elastic = track;
      elastic.support.pad_loss = elastic.support.sleeper.ballast_loss = 0;
      if (elastic.support.sleeper.beam)
        elastic.support.sleeper.beam->loss_factor = 0;
      if (elastic.slab)
        elastic.slab->loss_factor = elastic.slab->bed_loss = 0;
      for (DenseMatrix &loss : elastic.section.matrices.loss_stiffness)
        loss = 0;
      return elastic;
    }

    /// free of rounding
    ComplexMatrix symmetric(const ComplexMatrix &R)
    {
      ComplexMatrix result(R.m(), R.n());
      for (unsigned int i = 0; i < R.m(); ++i)
        for (unsigned int j = 0; j < R.n(); ++j)
          result(i, j) = (R(i, j) + R(j, i)) / 2.;
      return result;
    }

    /// rigid motions of a patch at the points, as patch_motions() has them
    DenseMatrix rigid_motions(const ContactGrid &grid, const double x_0, const double y_0, const double arm)
    {
      const unsigned int n = grid.n_points();
      DenseMatrix B(3 * n, 6);
      for (unsigned int i = 0; i < n; ++i)
      {
        const double x = (grid.x(i) - x_0) / arm, y = (grid.y(i) - y_0) / arm;
        const unsigned int on_z = contact_row(n, 0, i), on_x = contact_row(n, 1, i),
                           on_y = contact_row(n, 2, i);
        B(on_x, 0) = B(on_y, 1) = B(on_z, 2) = 1;
        B(on_z, 3) = y;
        B(on_z, 4) = -x;
        B(on_x, 5) = -y;
        B(on_y, 5) = x;
      }
      return B;
    }
  } // namespace

  TrackInContact::TrackInContact(const BodyParameters &body, const RailParameters &rail,
                                 const ContactGrid &grid, const Settings &settings,
                                 const SectionShapes *const known)
      : section(body, rail), grid(grid), waves(settings.waves)
  {
    const ElasticMaterial &steel = body.materials.empty() ? body.material : body.materials.back().second;
    material = {steel.young_modulus, steel.poisson_ratio};
    const SectionElements &elements = section.elements;
    const double length = grid.n_x * grid.spacing_x, width = grid.n_y * grid.spacing_y,
                 x = grid.x_first + (grid.n_x - 1) * grid.spacing_x / 2,
                 y = grid.y_first + (grid.n_y - 1) * grid.spacing_y / 2;
    check_patch(elements, section.lateral_position + y, width);
    track = supports_of_track(rail);
    check_on_track(track, x - length / 2, x + length / 2);
    arm = std::hypot(length, width) / 2;

    SmoothShapesSettings smooth;
    smooth.up_to = settings.up_to;
    smooth.tolerance = settings.tolerance;
    // another version of a library may number a section's dofs in another way
    section_shapes =
        known && known->dofs == elements.mark_of_dofs()
            ? *known
            : track_shapes(elements, track.support, {section.lateral_position + y}, width, {}, smooth);
    track.section = track_section(elements, section_shapes);
    keep_far_shapes(track, section_shapes);
    const auto six = patch_motions(elements, section_shapes, x, section.lateral_position + y, length, width);
    loads.assign(six.begin(), six.end());
    // a moment of 1 N at the arm
    for (unsigned int k = 3; k < 6; ++k)
    {
      loads[k].constant *= arm;
      loads[k].linear *= arm;
    }

    const auto real = [&](const PeriodicTrack &of, const Complex omega)
    {
      const ComplexMatrix R = symmetric(of.receptance(of.at(omega), loads));
      DenseMatrix result(6, 6);
      for (unsigned int i = 0; i < 6; ++i)
        for (unsigned int j = 0; j < 6; ++j)
          result(i, j) = R(i, j).real();
      return result;
    };
    const PeriodicTrack lossless = without_losses(track);
    elastic = real(lossless, 0.);
    fast = real(lossless, Complex(0, -beyond_band * 2 * dealii::numbers::PI * settings.up_to));
    even_bed = real(on_even_bed(track), 0.);
    motions = rigid_motions(grid, x, y, arm);
  }

  DenseMatrix TrackInContact::bed_compliance() const
  {
    std::array<double, 3> springs;
    for (unsigned int d = 0; d < 3; ++d)
      springs[d] = track.support.pad_stiffness[d] / (track.spacing * track.section.foot_width);
    return crown_compliance(section.elements, springs, section.lateral_position, grid, material, waves);
  }

  std::vector<double> TrackInContact::surface_height() const
  {
    const dealii::QGauss<1> gauss(4);
    std::vector<double> result;
    for (unsigned int i = 0; i < grid.n_points(); ++i)
    {
      double mean = 0;
      for (unsigned int q = 0; q < gauss.size(); ++q)
        mean += gauss.weight(q) * section.height(section.lateral_position + grid.y(i) +
                                                 (gauss.point(q)[0] - 0.5) * grid.spacing_y);
      result.push_back(mean - section.crown_height);
    }
    return result;
  }

  ComplexMatrix TrackInContact::receptance(const Complex omega) const
  {
    return symmetric(track.receptance(track.at(omega), loads));
  }
} // namespace vibrocontact
