// Slices of a waveguide: an infinite Timoshenko beam on continuous and on discrete supports against closed forms.

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/waveguide/decay_rate.h>
#include <vibrocontact/waveguide/periodic_track.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <utility>

using namespace vibrocontact;
using dealii::numbers::PI;
using Complex = std::complex<double>;

namespace
{
  /// 60E1 as a Timoshenko beam, vertical: w, and the axial displacement per height, the rotation t with u_x = z t.
  struct Beam
  {
    const double E = 205e9, G = 205e9 / 2.6, A = 76.71e-4, I = 3038.8e-8, kappa = 0.4, rho = 7800,
                 loss = 0.02;

    /// 2 E_pot = int E I t'^2 + kappa G A (w' + t)^2 dx
    SectionMatrices section() const
    {
      SectionMatrices result;
      for (auto *set : {&result.stiffness, &result.loss_stiffness})
        for (auto &matrix : *set)
          matrix.reinit(2, 2);
      result.mass.reinit(2, 2);
      const double shear = kappa * G * A;
      result.stiffness[0](1, 1) = shear;
      result.stiffness[1](1, 0) = shear;
      result.stiffness[2](0, 0) = shear;
      result.stiffness[2](1, 1) = E * I;
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int c = 0; c < 2; ++c)
          for (unsigned int r = 0; r < 2; ++r)
            result.loss_stiffness[j](r, c) = loss * result.stiffness[j](r, c);
      result.mass(0, 0) = rho * A;
      result.mass(1, 1) = rho * I;
      result.axial = {false, true};
      return result;
    }

    /// w alone rests on the foot
    TrackSection on_foot() const
    {
      TrackSection result;
      result.matrices = section();
      result.foot_width = 0.15;
      for (unsigned int d = 0; d < 3; ++d)
      {
        result.foot_springs[d].reinit(2, 2);
        result.foot_loads[d].reinit(2);
      }
      result.foot_springs[2](0, 0) = result.foot_loads[2](0) = result.foot_width;
      return result;
    }

    /// w at x under a unit force at 0, infinite beam on springs s per length, roots of its characteristic equation
    /// (shear (k^2 + s / shear) - rho A w^2)(E I k^2 + shear - rho I w^2) - shear^2 k^2 = 0 with Im k > 0:
    /// w(x) = 1 / (2 pi) int e^{ikx} (E I k^2 + shear - rho I w^2) / D(k) dk = i sum of residues.
    Complex line_response(const double omega, const Complex s, const double x) const
    {
      Complex sum = 0;
      for (const auto &[k, amplitude] : waves(omega, s))
        sum += amplitude * std::exp(Complex(0, 1) * k * std::abs(x));
      return sum;
    }

    /// its two waves: wavenumber and amplitude
    std::array<std::pair<Complex, Complex>, 2> waves(const double omega, const Complex s) const
    {
      const Complex shear = Complex(1, loss) * kappa * G * A, EI = Complex(1, loss) * E * I;
      const Complex a = s - rho * A * omega * omega, b = shear - rho * I * omega * omega;
      // shear EI k^4 + (shear b + a EI - shear^2) k^2 + a b
      const Complex p2 = shear * EI, p1 = shear * b + a * EI - shear * shear, p0 = a * b;
      const Complex root = std::sqrt(p1 * p1 - 4. * p2 * p0);
      std::array<std::pair<Complex, Complex>, 2> result;
      unsigned int n = 0;
      for (const Complex square : {(-p1 + root) / (2. * p2), (-p1 - root) / (2. * p2)})
      {
        Complex k = std::sqrt(square);
        if (k.imag() < 0)
          k = -k;
        result[n++] = {k, Complex(0, 1) * (EI * square + b) / (4. * p2 * k * square + 2. * p1 * k)};
      }
      return result;
    }
  };

  AxialLoad force_at(const double x)
  {
    AxialLoad load;
    load.centre = x;
    load.constant.reinit(2);
    load.linear.reinit(2);
    load.constant(0) = 1;
    return load;
  }

  /// Complex stiffness of pad, sleeper and ballast in a row.
  Complex support(const double omega)
  {
    const Complex pad = 180e6 * Complex(1, 0.25), ballast = 50e6 * Complex(1, 1);
    return 1. / (1. / pad + 1. / (ballast - 150 * omega * omega));
  }
} // namespace

TEST(Slices, infinite_beam_on_a_continuous_bed)
{
  const Beam beam;
  for (const double f : {50., 300., 1000., 2000.})
  {
    const double omega = 2 * PI * f;
    const Complex bed = support(omega) / 0.6;
    ComplexMatrix springs(2, 2);
    springs(0, 0) = bed;
    const SectionAtFrequency section(beam.section(), omega, springs);
    const Slice piece = with_loads(uniform_slice(section, 0.7, 0.05, 5), 2);
    const InfiniteEnds ends = infinite_ends(piece);
    Slice left = piece;
    add_section_load(left, 0, force_at(0).constant);
    Slice right = piece;
    add_section_load(right, 1, force_at(0).constant);
    const ComplexMatrix H = receptance(join(left, right), ends.left, ends.right);
    const Complex own = beam.line_response(omega, bed, 0), across = beam.line_response(omega, bed, 0.7);
    EXPECT_LT(std::abs(H(0, 0) / own - 1.), 1e-6) << f;
    EXPECT_LT(std::abs(H(1, 1) / own - 1.), 1e-6) << f;
    EXPECT_LT(std::abs(H(0, 1) / across - 1.), 1e-6) << f;
    EXPECT_LT(std::abs(H(0, 1) / H(1, 0) - 1.), 1e-10) << f;
    std::cout << f << " Hz: " << std::abs(H(0, 0)) << " m/N, off by " << std::abs(H(0, 0) / own - 1.)
              << std::endl;
  }
}

// Discrete supports, by their forces on the free infinite beam: in a field e^{ij mu} from support to support the sums of
// its four waves over all supports are geometric; a force at x0 is the mean of such fields over mu.
TEST(Slices, infinite_beam_on_pads_sleepers_and_ballast)
{
  const Beam beam;
  const unsigned int n = 8192;
  const double d = 0.6;
  for (const double f : {50., 200., 520., 1055., 2000.})
    for (const double x0 : {0., 0.3, 0.41})
    {
      const double omega = 2 * PI * f;
      const Complex stiffness = support(omega), i(0, 1);
      // sum over j of G(j d - x) e^{-ij mu}
      const auto lattice_sum = [&](const double x, const double mu)
      {
        Complex sum = 0;
        for (const auto &[k, amplitude] : beam.waves(omega, 0))
        {
          const Complex z = std::exp(i * k * d), turn = std::exp(i * mu);
          sum += amplitude * (std::exp(-i * k * x) * (z / turn) / (1. - z / turn) +
                              std::exp(i * k * x) / (1. - z * turn));
        }
        return sum;
      };
      Complex closed = beam.line_response(omega, 0, 0);
      for (unsigned int j = 0; j < n; ++j)
      {
        const double mu = 2 * PI * j / n;
        closed -=
            lattice_sum(x0, mu) * lattice_sum(x0, -mu) / (1. / stiffness + lattice_sum(0, mu)) / double(n);
      }

      // a span from support to support, half of each support's stiffness at its ends
      const SectionAtFrequency section(beam.section(), omega);
      const auto held = [&](Slice slice)
      {
        slice.stiffness(0, 0) += stiffness / 2.;
        slice.stiffness(2, 2) += stiffness / 2.;
        return slice;
      };
      const InfiniteEnds ends = infinite_ends(held(uniform_slice(section, d, 0.05, 5)));
      Slice span = with_loads(uniform_slice(section, d, 0.05, 5), 1);
      if (x0 > 0)
      {
        span = with_loads(uniform_slice(section, x0, 0.05, 5), 1);
        add_section_load(span, 0, force_at(x0).constant);
        span = join(span, with_loads(uniform_slice(section, d - x0, 0.05, 5), 1));
      }
      else
        add_section_load(span, 0, force_at(d).constant);
      const Complex H = receptance(held(span), ends.left, ends.right)(0, 0);
      EXPECT_LT(std::abs(H / closed - 1.), 1e-6) << f << " Hz, x " << x0;

      // the same as a track: pads of a micrometre (the beam shears, so that their length enters linearly)
      PeriodicTrack track;
      track.section = beam.on_foot();
      track.support.pad_stiffness = {{1, 1, 180e6}};
      track.support.pad_loss = 0.25;
      track.support.pad_length = 1e-6;
      track.support.sleeper.mass = 150;
      track.support.sleeper.ballast_stiffness = {{1, 1, 50e6}};
      track.support.sleeper.ballast_loss = 1;
      track.first_support = 0;
      const Complex on_track = track.receptance(track.at(omega), {force_at(x0)})(0, 0);
      EXPECT_LT(std::abs(on_track / closed - 1.), 1e-6) << f << " Hz, x " << x0;
      std::cout << f << " Hz, x " << x0 << ": off by " << std::abs(H / closed - 1.) << " and "
                << std::abs(on_track / closed - 1.) << std::endl;
    }
}

TEST(Slices, a_track_without_loss_is_refused)
{
  Beam lossless;
  SectionMatrices section = lossless.section();
  for (auto &matrix : section.loss_stiffness)
    matrix = 0.;
  // the second wave of the unsupported beam propagates as well, the first at every frequency
  EXPECT_THROW(infinite_ends(uniform_slice({section, 2 * PI * 500}, 0.6, 0.05, 4)), ConvergenceError);
}

// Loads over a length: an element with a distributed load against the closed form of a point load, integrated.
TEST(Slices, loads_over_a_length)
{
  const Beam beam;
  const double omega = 2 * PI * 900, length = 0.08;
  const Complex bed = support(omega) / 0.6;
  ComplexMatrix springs(2, 2);
  springs(0, 0) = bed;
  const SectionAtFrequency section(beam.section(), omega, springs);
  std::vector<AxialLoad> loads(2, force_at(0));
  for (AxialLoad &load : loads)
    load.length = length;
  loads[0].constant(0) = 1 / length;
  loads[1].constant(0) = 0;
  loads[1].linear(0) = 12 / std::pow(length, 3); // a moment: the mean slope of w
  const Slice outside = with_loads(uniform_slice(section, 0.6, 0.05, 5), 2);
  Slice piece = outside;
  for (unsigned int k = 0; k < 4; ++k)
    piece = join(piece, element_slice(section, -length / 2 + k * length / 4, length / 4, 4, loads));
  piece = join(piece, outside);
  const InfiniteEnds ends = infinite_ends(outside);
  const ComplexMatrix H = receptance(piece, ends.left, ends.right);
  // Gauss-Legendre is slow at the kink of G(x - y): integrate twice over t = x - y, where it is smooth
  Complex mean = 0, slope = 0;
  const unsigned int n = 400;
  for (unsigned int i = 0; i < n; ++i)
  {
    // Simpson of 2 (l - t) G(t) / l^2 and of the second moment's kernel
    for (const auto &[at, weight] : {std::pair<double, double>{0., 1.}, {0.5, 4.}, {1., 1.}})
    {
      const double t = (i + at) * length / n, w = weight / 6 * length / n, l = length;
      const Complex G = beam.line_response(omega, bed, t);
      mean += 2 * w * (l - t) / (l * l) * G;
      // int int x y delta(|x - y| - t) dx dy = 2 [(l - t)^3 / 12 - t^2 (l - t) / 4]
      slope += 2 * w * (std::pow(l - t, 3) / 12 - t * t * (l - t) / 4) * std::pow(12 / (l * l * l), 2) * G;
    }
  }
  EXPECT_LT(std::abs(H(0, 0) / mean - 1.), 1e-6);
  EXPECT_LT(std::abs(H(1, 1) / slope - 1.), 1e-5);
  EXPECT_LT(std::abs(H(0, 1)), 1e-9 * std::sqrt(std::abs(H(0, 0) * H(1, 1))));
}

// Responses along the track and the decay rate on a bed that is continuous (a pad as long as the span) against the closed form.
TEST(Slices, decay_along_a_continuous_bed)
{
  const Beam beam;
  for (const double f : {150., 900., 1800.})
  {
    const double omega = 2 * PI * f;
    PeriodicTrack track;
    track.section = beam.on_foot();
    track.support.pad_stiffness = {{1, 1, 180e6}};
    track.support.pad_loss = 0.25;
    track.support.pad_length = 0.6;
    for (const double x0 : {0., 0.3})
    {
      const unsigned int n_spans = 20;
      const auto motions = track.along(track.at(omega), {force_at(x0)}, {force_at(0).constant}, n_spans)[0];
      double sum = 0;
      for (unsigned int j = 0; j < motions.size(); ++j)
      {
        const Complex closed = beam.line_response(omega, 180e6 / 0.6 * Complex(1, 0.25), 0.15 * j);
        EXPECT_LT(std::abs(motions[j] / closed - 1.), 1e-6) << f << " Hz, place " << j;
        sum += std::norm(closed) * (j == 0 ? 0.075 : 0.15);
      }
      EXPECT_GE(motions.size(), 4 * n_spans);
      const double closed =
          4.343 * std::norm(beam.line_response(omega, 180e6 / 0.6 * Complex(1, 0.25), 0)) / sum;
      std::vector<double> squares;
      for (const Complex &motion : motions)
        squares.push_back(std::norm(motion));
      EXPECT_NEAR(decay_rate_at_quarters(squares, 0.6) / closed, 1, 1e-5);
      std::cout << f << " Hz: " << closed << " dB/m" << std::endl;
    }
  }
}
