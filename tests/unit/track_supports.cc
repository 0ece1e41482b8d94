// Supports of a track beyond equal masses: sleepers that bend against the modes of an Euler beam, supports laid one by one
// against equal ones, ends of a finite track, waves from span to span, decay rates of a decaying wave.

#include "span_about.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/scene/rail.h>
#include <vibrocontact/waveguide/decay_rate.h>
#include <vibrocontact/waveguide/periodic_track.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

using namespace vibrocontact;
using dealii::numbers::PI;
using Complex = std::complex<double>;

namespace
{
  /// 60E1 as a Timoshenko beam on its foot: w, and the rotation t with u_x = z t.
  struct BeamRail
  {
    const double E = 205e9, A = 76.71e-4, I = 3038.8e-8, shear = 0.4 * 205e9 / 2.6 * A, rho = 7800;

    explicit BeamRail(const double loss = 0.02)
    {
      TrackSection &section = track.section;
      for (auto *set : {&section.matrices.stiffness, &section.matrices.loss_stiffness, &section.foot_springs})
        for (auto &matrix : *set)
          matrix.reinit(2, 2);
      section.matrices.mass.reinit(2, 2);
      auto &stiffness = section.matrices.stiffness;
      stiffness[0](1, 1) = stiffness[1](1, 0) = stiffness[2](0, 0) = shear;
      stiffness[2](1, 1) = E * I;
      for (unsigned int j = 0; j < 3; ++j)
        section.matrices.loss_stiffness[j].add(loss, stiffness[j]);
      section.matrices.mass(0, 0) = rho * A;
      section.matrices.mass(1, 1) = rho * I;
      section.matrices.axial = {false, true};
      section.foot_width = 0.15;
      for (auto &load : section.foot_loads)
        load.reinit(2);
      section.foot_lever.reinit(2);
      section.foot_springs[2](0, 0) = section.foot_loads[2](0) = section.foot_width;
      track.support.pad_stiffness = {{1, 1, 180e6}};
      track.support.pad_loss = 0.25;
    }

    static AxialLoad force_at(const double x)
    {
      AxialLoad load;
      load.centre = x;
      load.constant.reinit(2);
      load.linear.reinit(2);
      load.constant(0) = 1;
      return load;
    }

    PeriodicTrack track;
  };

  Sleeper concrete_sleeper()
  {
    Sleeper sleeper;
    sleeper.mass = 150;
    sleeper.ballast_stiffness = {{30e6, 30e6, 50e6}};
    sleeper.ballast_loss = 1;
    sleeper.beam = SleeperBeam();
    return sleeper;
  }

  Complex vertical(const PeriodicTrack &track, const double frequency, const double x)
  {
    return track.receptance(track.at(2 * PI * frequency), {BeamRail::force_at(x)})(0, 0);
  }
} // namespace

// Shear and rotary inertia taken out, a seat moves as the modes of a free Euler beam on its ballast say: the roots of
// tan b + tanh b = 0 and tan b - tanh b = 0, b = half of its length times the wavenumber.
TEST(TrackSupports, sleeper_against_modes_of_a_free_beam)
{
  Sleeper sleeper = concrete_sleeper();
  SleeperBeam &beam = *sleeper.beam;
  beam.shear_stiffness = 1e8 * beam.bending_stiffness;
  beam.gyration_radius = 1e-6;
  const double half = beam.length / 2, seat = beam.rail_distance / 2, mass = 2 * sleeper.mass;
  for (const RailPair pair : {RailPair::symmetric, RailPair::antisymmetric})
    for (const double f : {20., 180., 700., 1500.})
    {
      const bool symmetric = pair == RailPair::symmetric;
      const double omega = 2 * PI * f;
      const Complex carried =
          2 * sleeper.ballast_stiffness[2] * Complex(1, sleeper.ballast_loss) - omega * omega * mass;
      // forces of 1 N on both seats; the rigid motion
      Complex w = 2. / carried * (symmetric ? 1. : 3 * seat * seat / (half * half));
      Complex slope = symmetric ? 0. : 2. / carried * 3. * seat / (half * half);
      for (unsigned int n = 1; n < 200; ++n)
      {
        double b = PI * (n + (symmetric ? -0.25 : 0.25));
        for (unsigned int step = 0; step < 20; ++step)
        {
          const double sign = symmetric ? 1 : -1, value = std::tan(b) + sign * std::tanh(b),
                       derivative = 2 + std::pow(std::tan(b), 2) - 1 + sign * (1 - std::pow(std::tanh(b), 2));
          b -= value / derivative;
        }
        // mean square over the length 1
        const double k = b / half, x = k * seat;
        const auto over = [&](const double part)
        {
          return std::exp(part - b) * (1 + (symmetric ? 1 : -1) * std::exp(-2 * part)) /
                 (1 + (symmetric ? 1 : -1) * std::exp(-2 * b));
        };
        const auto over_derivative = [&](const double part)
        {
          return std::exp(part - b) * (1 - (symmetric ? 1 : -1) * std::exp(-2 * part)) /
                 (1 + (symmetric ? 1 : -1) * std::exp(-2 * b));
        };
        const double shape = symmetric ? std::cos(x) / std::cos(b) + over(x)
                                       : std::sin(x) / std::sin(b) + over(x),
                     gradient = k * (symmetric ? -std::sin(x) / std::cos(b) + over_derivative(x)
                                               : std::cos(x) / std::sin(b) + over_derivative(x));
        const Complex modal =
            carried + beam.bending_stiffness * Complex(1, beam.loss_factor) * std::pow(k, 4) * beam.length;
        w += 2 * shape * shape / modal;
        slope += 2 * shape * gradient / modal;
      }
      const ComplexMatrix found = seat_receptance(sleeper, omega, pair);
      std::cout << f << " Hz: off by " << std::abs(found(2, 2) / w - 1.) << ", slope "
                << std::abs(found(3, 2) - slope) / std::abs(w) << " 1/m" << std::endl;
      EXPECT_LT(std::abs(found(2, 2) / w - 1.), 2e-5) << f;
      EXPECT_LT(std::abs(found(3, 2) - slope), 1e-3 * std::abs(w)) << f;
      const ComplexMatrix shears = seat_receptance(concrete_sleeper(), omega, pair);
      EXPECT_LT(std::abs(shears(3, 2) - shears(2, 3)), 1e-8 * std::abs(w)) << f;
    }
}

// A rigid sleeper by hand: it shifts, rolls and yaws on ballast all along it, under one load of each kind on this seat and its mirror
// image, or the opposite of that, on the other one.
TEST(TrackSupports, rigid_sleeper_under_both_rails)
{
  Sleeper sleeper = concrete_sleeper();
  sleeper.ballast_stiffness = {{30e6, 40e6, 60e6}};
  sleeper.beam->bends = false;
  const SleeperBeam &beam = *sleeper.beam;
  const double arm = beam.rail_distance / 2, omega = 2 * PI * 150;
  const unsigned int n_slices = 2000;
  // motions of the sleeper: x, y, z, roll about x, yaw about z; y from the middle of the track
  const auto motion = [](const unsigned int k, const double y)
  {
    const double all[5][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, y}, {-y, 0, 0}};
    return std::array<double, 3>{{all[k][0], all[k][1], all[k][2]}};
  };
  std::array<Complex, 5> stiffness{};
  for (unsigned int k = 0; k < 5; ++k)
  {
    for (unsigned int slice = 0; slice < n_slices; ++slice)
    {
      const std::array<double, 3> u = motion(k, beam.length * ((slice + 0.5) / n_slices - 0.5));
      for (unsigned int d = 0; d < 3; ++d)
        stiffness[k] +=
            2. / n_slices * u[d] * u[d] *
            (sleeper.ballast_stiffness[d] * Complex(1, sleeper.ballast_loss) - omega * omega * sleeper.mass);
    }
    if (k == 3)
      stiffness[k] -= omega * omega * 2 * sleeper.mass * std::pow(beam.gyration_radius, 2);
  }
  // of a seat: its motions by one of the sleeper, the last one the roll
  const auto seat_motion = [&](const unsigned int i, const unsigned int k, const double y) {
    return i < 3 ? motion(k, y)[i] : k == 3 ? 1. : 0.;
  };
  for (const RailPair pair : {RailPair::symmetric, RailPair::antisymmetric})
  {
    const ComplexMatrix found = seat_receptance(sleeper, omega, pair);
    const double mirrored[4] = {1, -1, 1, -1}, sign = pair == RailPair::symmetric ? 1 : -1;
    double largest = 0;
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int j = 0; j < 4; ++j)
        largest = std::max(largest, std::abs(found(i, j)));
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int j = 0; j < 4; ++j)
      {
        Complex sum = 0;
        for (unsigned int k = 0; k < 5; ++k)
          sum += seat_motion(i, k, arm) / stiffness[k] *
                 (seat_motion(j, k, arm) + sign * mirrored[j] * seat_motion(j, k, -arm));
        EXPECT_LT(std::abs(found(i, j) - sum), 1e-6 * largest) << i << j;
      }
  }
}

// Stiff beams roll as the rigid one does; both rails alike on those are carried by today's mass; one loaded rail is the mean.
TEST(TrackSupports, stiff_sleepers)
{
  BeamRail rail;
  for (const double f : {60., 400., 1300.})
  {
    PeriodicTrack mass = rail.track;
    mass.support.sleeper = concrete_sleeper();
    PeriodicTrack stiff = mass, rigid = mass;
    mass.support.sleeper.beam.reset();
    rigid.support.sleeper.beam->bends = false;
    stiff.support.sleeper.beam->bending_stiffness *= 1e5;
    stiff.support.sleeper.beam->shear_stiffness *= 1e5;
    Complex mean = 0;
    for (const RailPair pair : {RailPair::symmetric, RailPair::antisymmetric})
    {
      stiff.pairs = rigid.pairs = {pair};
      const Complex by_rigid = vertical(rigid, f, 0.1);
      EXPECT_LT(std::abs(vertical(stiff, f, 0.1) / by_rigid - 1.), 1e-4) << f;
      if (pair == RailPair::symmetric)
        EXPECT_LT(std::abs(by_rigid / vertical(mass, f, 0.1) - 1.), 1e-10) << f;
      mean += by_rigid / 2.;
    }
    rigid.pairs = {RailPair::symmetric, RailPair::antisymmetric};
    EXPECT_LT(std::abs(vertical(rigid, f, 0.1) / mean - 1.), 1e-12) << f;
  }
}

// Supports laid one by one that do not scatter, with as many behind them, are the periodic track, wherever the load stands.
TEST(TrackSupports, without_scatter_it_is_the_periodic_track)
{
  BeamRail rail;
  rail.track.support.sleeper = concrete_sleeper();
  for (const bool on_support : {false, true})
  {
    PeriodicTrack laid = rail.track;
    laid.first_support = rail.track.first_support = on_support ? 0 : 0.3;
    laid.own = irregular_supports({7, 0, 0, 5}, 0.6, on_support);
    const double omega = 2 * PI * 730;
    std::vector<AxialLoad> loads;
    for (const double x : {-4.3, 0., 0.41, 1.9, 5.7})
      loads.push_back(BeamRail::force_at(x));
    const ComplexMatrix H = laid.receptance(laid.at(omega), loads),
                        G = rail.track.receptance(rail.track.at(omega), loads);
    for (unsigned int i = 0; i < loads.size(); ++i)
    {
      for (unsigned int j = 0; j < loads.size(); ++j)
        EXPECT_LT(std::abs(H(i, j) - G(i, j)), 1e-10 * std::abs(G(0, 0)));
      // alone: beyond the own ones too
      EXPECT_LT(std::abs(laid.receptance(laid.at(omega), {loads[i]})(0, 0) / G(i, i) - 1.), 1e-10);
    }
    const auto along = [&](const PeriodicTrack &track)
    { return track.along(track.at(omega), {loads[1]}, {loads[1].constant}, 12)[0]; };
    const auto a = along(laid), b = along(rail.track);
    ASSERT_EQ(a.size(), b.size());
    for (unsigned int j = 0; j < a.size(); ++j)
      EXPECT_LT(std::abs(a[j] - b[j]), 1e-9 * std::abs(b[0]));
  }
}

// Moments of the scatter; the same seed is the same track, and a longer one goes on with further supports; stiffer pads on one
// side matter, and do so alike from both sides.
TEST(TrackSupports, scatter)
{
  const auto supports = irregular_supports({400, 0.3, 0.05, 11}, 0.6, false),
             fewer = irregular_supports({40, 0.3, 0.05, 11}, 0.6, false);
  for (unsigned int k = 0; k < 40; ++k)
  {
    EXPECT_EQ(fewer[k].pad_factor, supports[k + 180].pad_factor);
    EXPECT_NEAR(fewer[k].place, supports[k + 180].place, 1e-12);
  }
  EXPECT_NEAR(supports[199].place + supports[200].place, 0, 1e-15);
  double mean = 0, square = 0, step = 0, step_square = 0;
  for (unsigned int k = 0; k < 400; ++k)
  {
    mean += supports[k].pad_factor / 400;
    square += std::pow(supports[k].pad_factor - 1, 2) / 400;
    if (k > 0)
    {
      step += (supports[k].place - supports[k - 1].place) / 399;
      step_square += std::pow((supports[k].place - supports[k - 1].place) / 0.6 - 1, 2) / 399;
    }
  }
  EXPECT_NEAR(mean, 1, 0.05);
  EXPECT_NEAR(std::sqrt(square), 0.3, 0.05);
  EXPECT_NEAR(step, 0.6, 0.005);
  EXPECT_NEAR(std::sqrt(step_square), 0.05, 0.005);

  BeamRail rail;
  PeriodicTrack track = rail.track, mirrored = rail.track;
  track.own = irregular_supports({6, 0.3, 0.05, 11}, 0.6, false);
  for (auto one = track.own.rbegin(); one != track.own.rend(); ++one)
    mirrored.own.push_back({-one->place, one->pad_factor});
  const Complex here = vertical(track, 900, 0.17), there = vertical(mirrored, 900, -0.17);
  EXPECT_LT(std::abs(here / there - 1.), 1e-9);
  EXPECT_GT(std::abs(here / vertical(rail.track, 900, 0.17) - 1.), 1e-2);
}

// A finite track: many spans with losses are the endless track, whatever follows; two spans with free ends are the two slices of
// free ends; a bare rail beyond reflects no wave of a free rail.
TEST(TrackSupports, finite_tracks)
{
  BeamRail rail(0.05);
  const double f = 600, omega = 2 * PI * f;
  const Complex endless = vertical(rail.track, f, 0.05);
  double last[2] = {1, 1};
  for (const unsigned int n : {4u, 40u, 240u})
    for (const TrackEnds beyond : {TrackEnds::free, TrackEnds::rail})
    {
      PeriodicTrack track = rail.track;
      track.own = irregular_supports({n, 0, 0, 1}, 0.6, false);
      track.beyond = beyond;
      const double off = std::abs(vertical(track, f, 0.05) / endless - 1.);
      EXPECT_LT(off, last[beyond == TrackEnds::free]);
      last[beyond == TrackEnds::free] = off;
      std::cout << n << " spans: off by " << off << std::endl;
    }
  EXPECT_LT(std::max(last[0], last[1]), 1e-6);
  PeriodicTrack two = rail.track;
  two.own = irregular_supports({2, 0, 0, 1}, 0.6, false);
  two.beyond = TrackEnds::free;
  const std::vector<AxialLoad> loads = {BeamRail::force_at(0.05)};
  const ComplexMatrix slices =
      receptance(join(span_about(rail.track, omega, -0.3, loads), span_about(rail.track, omega, 0.3, loads)),
                 ComplexMatrix(), ComplexMatrix());
  EXPECT_LT(std::abs(vertical(two, f, 0.05) / slices(0, 0) - 1.), 1e-10);
  EXPECT_EQ(two.reach(), std::make_pair(-0.6, 0.6));
  // pads so soft that all of it is a bare rail
  two.support.pad_stiffness.fill(1e-3);
  two.beyond = TrackEnds::rail;
  PeriodicTrack longer = two;
  longer.own = irregular_supports({8, 0, 0, 1}, 0.6, false);
  EXPECT_LT(std::abs(vertical(two, f, 0.05) / vertical(longer, f, 0.05) - 1.), 1e-9);
  EXPECT_TRUE(std::isfinite(std::abs(two.at(0.).motions[0].left[1](0, 0))));
}

// Waves from span to span of a Timoshenko rail on springs in points, closed form: with the response G of the free rail to the
// lattice of forces e^{-i j mu}, 1 / k + sum_j G(j d) e^{-i j mu} = 0. A wave that passes has no decay; half of its length is a span at the
// edge of a band.
TEST(TrackSupports, pass_bands)
{
  const double loss = 1e-7, d = 0.6, k = 180e6;
  BeamRail rail(loss);
  PeriodicTrack &track = rail.track;
  track.support.pad_loss = loss;
  track.support.pad_length = 1e-6;
  const auto factors = [&](const double f) { return track.span_factors(track.at(2 * PI * f))[0]; };
  for (const double f : {100., 300., 520., 800., 1040., 1200.})
  {
    // waves of the free rail: determinant of K(q) - w^2 M in q^2
    const double omega = 2 * PI * f, m = rail.rho * rail.A * omega * omega, S = rail.shear,
                 EI = rail.E * rail.I, J = rail.rho * rail.I * omega * omega;
    // (S q2 - m)(EI q2 + S - J) - S^2 q2 = 0
    const double a = S * EI, b = S * (S - J) - m * EI - S * S, c = -m * (S - J);
    const double root = std::sqrt(b * b - 4 * a * c);
    const Complex q[2] = {std::sqrt(Complex((-b + root) / (2 * a))),
                          std::sqrt(Complex((-b - root) / (2 * a)))};
    // G(x) = sum A_j e^{i q_j |x|}, residues of (EI q2 + S - J) / determinant; lattice sum with cos mu:
    // sum_j e^{iq|j|d} e^{-ij mu} = i sin(q d) / (cos mu - cos q d)
    const double EI_pole = a;
    const auto condition = [&](const Complex &cos_mu)
    {
      Complex sum = 1. / k;
      for (unsigned int j = 0; j < 2; ++j)
      {
        const Complex numerator = EI * q[j] * q[j] + S - J,
                      residue = numerator / (EI_pole * 2. * q[j] * (q[j] * q[j] - q[1 - j] * q[1 - j]));
        sum -= residue * std::sin(q[j] * d) / (cos_mu - std::cos(q[j] * d));
      }
      return std::abs(sum) * k;
    };
    const auto found = factors(f);
    ASSERT_EQ(found.size(), 2u);
    for (const Complex &factor : found)
    {
      const double off = condition((factor + 1. / factor) / 2.);
      std::cout << f << " Hz: factor " << factor << ", off by " << off << std::endl;
      if (std::abs(factor) > 1e-3)
        EXPECT_LT(off, 1e-4) << f;
    }
  }
  // pinned-pinned: where half a wave of the free rail fits the span, bands that stop waves begin
  const double w2 = [&]
  {
    const double q2 = std::pow(PI / d, 2), S = rail.shear, EI = rail.E * rail.I, M = rail.rho * rail.A,
                 J = rail.rho * rail.I;
    // (S q2 - M w2)(EI q2 + S - J w2) = S^2 q2
    const double a = M * J, b = -(M * (EI * q2 + S) + J * S * q2), c = S * EI * q2 * q2;
    return (-b - std::sqrt(b * b - 4 * a * c)) / (2 * a);
  }();
  const double pinned = std::sqrt(w2) / (2 * PI);
  std::cout << "pinned-pinned at " << pinned << " Hz" << std::endl;
  EXPECT_GT(std::abs(factors(pinned - 1)[0]), 0.9999);
  EXPECT_LT(std::abs(factors(pinned + 1)[0]), 0.9999);
}

// A wave that decays by beta [1/m] in amplitude: 8.686 beta dB/m, on a grid that thins out somewhat less.
TEST(TrackSupports, decay_rates_of_a_decaying_wave)
{
  const double spacing = 0.6;
  DecayingResponses responses;
  const auto wave = [&](const double beta)
  {
    std::vector<double> squares;
    for (unsigned int j = 0; j <= 264; ++j)
      squares.push_back(3 * std::exp(-2 * beta * j * spacing / 4));
    return squares;
  };
  for (const double rate : {0.5, 2., 8.})
  {
    const std::vector<double> squares = wave(rate / 8.686);
    // what is left beyond the last place is missing
    const double ended = 1 - std::exp(-2 * rate / 8.686 * 66.125 * spacing);
    EXPECT_NEAR(decay_rate_at_quarters(squares, spacing) / (rate / ended), 1, 0.01);
    const double on_grid = decay_rate_on_grid(squares, spacing);
    std::cout << rate << " dB/m: " << on_grid << " on the grid" << std::endl;
    EXPECT_NEAR(on_grid / rate, 1, 0.03);
  }
  // a response that stands still decays by what the grid is long: 66 spans and half of the last step beyond
  EXPECT_NEAR(decay_rate_on_grid(std::vector<double>(265, 2.), spacing), 4.343 / (72 * spacing), 1e-12);
  EXPECT_EQ(decay_rate_grid().size(), 29u);
  for (const double f : {400., 450., 500., 560., 600.})
    responses[f] = {{wave(2 / 8.686), wave(f < 500 ? 1 / 8.686 : 4 / 8.686)}};
  const auto bands = band_decay_rates(responses, spacing);
  ASSERT_EQ(bands.size(), 1u);
  EXPECT_EQ(bands[0].nominal, 500);
  EXPECT_EQ(bands[0].n_frequencies, 3u);
  EXPECT_NEAR(bands[0].rates[0], decay_rate_on_grid(wave(2 / 8.686), spacing), 1e-12);
  EXPECT_GT(bands[0].rates[1], 1.1);
  EXPECT_LT(bands[0].rates[1], 3.9);
}

// Pads without gaps on a slab: two beams coupled by a bed, by an integral over wave numbers.
TEST(TrackSupports, slab_below_continuous_pads)
{
  BeamRail rail;
  PeriodicTrack &track = rail.track;
  track.support.pad_length = track.spacing;
  track.slab = TrackSlab();
  const TrackSlab &slab = *track.slab;
  for (const double f : {30., 70., 300., 1200.})
  {
    const double omega = 2 * PI * f;
    const auto beam =
        [&](const double q, const Complex &S, const Complex &EI, const double mass, const double radius)
    {
      return S * q * q - mass * omega * omega -
             S * S * q * q / (EI * q * q + S - mass * radius * radius * omega * omega);
    };
    const Complex pad = 180e6 * Complex(1, 0.25) / 0.6;
    const auto response = [&](const double q)
    {
      const Complex own = beam(q, rail.shear * Complex(1, 0.02), rail.E * rail.I * Complex(1, 0.02),
                               rail.rho * rail.A, std::sqrt(rail.I / rail.A)) +
                          pad,
                    below = beam(q, slab.shear_stiffness * Complex(1, slab.loss_factor),
                                 slab.bending_stiffness * Complex(1, slab.loss_factor), slab.mass,
                                 slab.gyration_radius) +
                            slab.bed_stiffness * Complex(1, slab.bed_loss) + pad;
      return below / (own * below - pad * pad);
    };
    // q = sinh t brings the far waves near; Simpson
    Complex closed = 0;
    const unsigned int n = 200000;
    const double end = std::log(2e5), step = end / n;
    for (unsigned int k = 0; k <= n; ++k)
      closed += (k == 0 || k == n ? 1.
                 : k % 2          ? 4.
                                  : 2.) *
                step / 3 * response(std::sinh(k * step)) * std::cosh(k * step) / PI;
    closed += 1. / (PI * rail.shear * Complex(1, 0.02) * std::sinh(end));
    const Complex found = vertical(track, f, 0.1);
    std::cout << f << " Hz: off by " << std::abs(found / closed - 1.) << std::endl;
    EXPECT_LT(std::abs(found / closed - 1.), 1e-8) << f;
    // it matters, and stands still if its bed is rigid
    PeriodicTrack ground = track, stiff = track;
    ground.slab.reset();
    stiff.slab->bed_stiffness = 1e16;
    if (f < 100)
      EXPECT_GT(std::abs(vertical(ground, f, 0.1) / found - 1.), 1e-2) << f;
    EXPECT_LT(std::abs(vertical(ground, f, 0.1) / vertical(stiff, f, 0.1) - 1.), 1e-5) << f;
  }
}

TEST(TrackSupports, AContactStandsAtTheEndOfWhatTheSupportsCarry)
{
  RailParameters rail;
  rail.model = "periodic";
  rail.track.n_supports = 4;
  rail.contact_offset = 0.9;
  EXPECT_NO_THROW(rail.check("rail/Rail"));
  rail.contact_offset = 0.901;
  EXPECT_THROW(rail.check("rail/Rail"), InputError);
}
