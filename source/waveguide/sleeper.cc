#include <vibrocontact/waveguide/sleeper.h>

#include <cmath>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    /// w and slope t of the sleeper, strain energy kappa G A (w' - t)^2 + E I t'^2.
    SectionMatrices sleeper_section(const SleeperBeam &beam, const double mass_per_length)
    {
      SectionMatrices section;
      for (auto *set : {&section.stiffness, &section.loss_stiffness})
        for (DenseMatrix &matrix : *set)
          matrix.reinit(2, 2);
      section.stiffness[0](1, 1) = beam.shear_stiffness;
      section.stiffness[1](1, 0) = -beam.shear_stiffness;
      section.stiffness[2](0, 0) = beam.shear_stiffness;
      section.stiffness[2](1, 1) = beam.bending_stiffness;
      for (unsigned int j = 0; j < 3; ++j)
        section.loss_stiffness[j].add(beam.loss_factor, section.stiffness[j]);
      section.mass.reinit(2, 2);
      section.mass(0, 0) = mass_per_length;
      section.mass(1, 1) = mass_per_length * std::pow(beam.gyration_radius, 2);
      section.axial = {false, true};
      return section;
    }

    /// w and t at one seat under force and moment there and, mirrored, at the other one.
    ComplexMatrix bending_receptance(const Sleeper &sleeper, const Complex omega, const RailPair pair)
    {
      const SleeperBeam &beam = *sleeper.beam;
      ComplexMatrix ballast(2, 2);
      ballast(0, 0) = 2 * sleeper.ballast_stiffness[2] / beam.length * Complex(1, sleeper.ballast_loss);
      const SectionAtFrequency section(sleeper_section(beam, 2 * sleeper.mass / beam.length), omega, ballast);
      const double overhang = (beam.length - beam.rail_distance) / 2, one_element = beam.length / 16;
      const auto piece = [&](const double length)
      { return with_loads(uniform_slice(section, length, one_element, 4), 4); };
      Slice before = piece(overhang), between = piece(beam.rail_distance);
      for (unsigned int k = 0; k < 2; ++k)
      {
        DenseVector unit(2);
        unit(k) = 1;
        add_section_load(before, 2 + k, unit);
        add_section_load(between, k, unit);
      }
      const ComplexMatrix both =
          receptance(join(join(before, between), piece(overhang)), ComplexMatrix(), ComplexMatrix());
      ComplexMatrix result(2, 2);
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 2; ++j)
        {
          // the mirror image of a moment turns the other way
          const bool plus = (pair == RailPair::symmetric) == (j == 0);
          result(i, j) = both(i, j) + (plus ? 1. : -1.) * both(i, 2 + j);
        }
      return result;
    }
  } // namespace

  ComplexMatrix seat_receptance(const Sleeper &sleeper, const Complex omega, const RailPair pair)
  {
    ComplexMatrix A(sleeper.n_motions(), sleeper.n_motions());
    const auto stiffness = [&](const unsigned int d) {
      return sleeper.ballast_stiffness[d] * Complex(1, sleeper.ballast_loss) - omega * omega * sleeper.mass;
    };
    for (unsigned int d = 0; d < 3; ++d)
      A(d, d) = 1. / stiffness(d);
    if (!sleeper.beam)
      return A;
    const SleeperBeam &beam = *sleeper.beam;
    const double arm = beam.rail_distance / 2, square = std::pow(beam.length, 2) / 12;
    const bool symmetric = pair == RailPair::symmetric;
    if (symmetric)
      A(1, 1) = 0;
    else
      A(0, 0) *= arm * arm / square;
    if (beam.bends)
    {
      const ComplexMatrix bending = bending_receptance(sleeper, omega, pair);
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          A(2 + i, 2 + j) = bending(i, j);
    }
    else if (!symmetric)
    {
      const Complex roll =
          stiffness(2) * square - omega * omega * sleeper.mass * std::pow(beam.gyration_radius, 2);
      A(2, 2) = arm * arm / roll;
      A(2, 3) = A(3, 2) = arm / roll;
      A(3, 3) = 1. / roll;
    }
    return A;
  }
} // namespace vibrocontact
