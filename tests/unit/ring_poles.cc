// The ring on an elastic foundation by its poles: against direct inversion, and against printed values.
#include "pi.h"

#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/bodies/ring_poles.h>
#include <vibrocontact/scene/oscillator.h>

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  const double speed = -77.9727;
  using Complex = std::complex<double>;

  double largest(const ComplexMatrix &G)
  {
    double result = 0;
    for (unsigned int i = 0; i < G.m(); ++i)
      for (unsigned int k = 0; k < G.n(); ++k)
        result = std::max(result, std::abs(G(i, k)));
    return result;
  }

  ComplexMatrix difference(const ComplexMatrix &A, const ComplexMatrix &B)
  {
    ComplexMatrix result(A.m(), A.n());
    for (unsigned int i = 0; i < A.m(); ++i)
      for (unsigned int k = 0; k < A.n(); ++k)
        result(i, k) = A(i, k) - B(i, k);
    return result;
  }

  Complex driving_point(const RingParameters &ring, const double omega)
  {
    return ring_receptance(ring, {{0., false}}, 0., RingFrame::road, omega)(0, 0);
  }
} // namespace

// Sum over poles and residues = inversion of the 2 x 2 systems, radial and tangential rows.
TEST(RingPoles, EqualDirectInversion)
{
  RingParameters ring;
  ring.residual = false;
  for (const double theta : ring.angles())
    EXPECT_LT(std::abs(theta), pi / 99);
  std::vector<RingRow> rows = ring_rows(ring, true);
  rows.push_back({2.3, false});
  for (const char *law : {"follower", "fixed direction"})
    for (const double rotation : {0., speed, 30.})
      for (const RingFrame frame : {RingFrame::road, RingFrame::co_rotating})
        for (const double damping : {0.05, 0.4, 0.001})
        {
          ring.pressure_law = law;
          ring.damping_ratio = damping;
          const BodyInContact model = ring_poles(ring, rows, rotation, frame);
          EXPECT_EQ(model.n_poles(), 4 * 60 + 2u);
          for (const double f : {0., 17., 75.0706, 100., 403., 999., 5000.})
          {
            const ComplexMatrix exact = ring_receptance(ring, rows, rotation, frame, 2 * pi * f);
            EXPECT_LT(largest(difference(receptance(model, 2 * pi * f), exact)), 1e-10 * largest(exact))
                << law << " " << rotation << " " << f << " Hz, damping " << damping;
          }
          // motion starts from rest with the velocity that a unit impulse gives to its mass
          const DenseMatrix zero = initial_derivative(model, 0), one = initial_derivative(model, 1);
          const double scale = (2 * 60 + 1) / (2 * pi * ring.radius * ring.line_density());
          EXPECT_NEAR(one(0, 0) / scale, 1, 1e-10);
          EXPECT_NEAR(zero(0, 0) * speed / scale, 0, 1e-10);
        }
}

TEST(RingPoles, HighOrdersEqualDirectInversion)
{
  RingParameters ring;
  ring.residual = false;
  ring.highest_order = 400;
  const std::vector<RingRow> rows = ring_rows(ring, true);
  for (const double rotation : {0., speed})
  {
    const BodyInContact model = ring_poles(ring, rows, rotation);
    const ComplexMatrix exact = ring_receptance(ring, rows, rotation, RingFrame::road, 2 * pi * 450);
    EXPECT_LT(largest(difference(receptance(model, 2 * pi * 450), exact)), 1e-10 * largest(exact));
  }
}

// Frequencies and receptances of the corrected ring (doc/theory.md).
TEST(RingPoles, PrintedValues)
{
  RingParameters ring;
  const auto Hz = [&](const unsigned int n) { return ring.frequencies(n).first / (2 * pi); };
  EXPECT_NEAR(Hz(0), 39.00, 5e-3);
  const double printed[] = {75.0706, 104.5396, 126.1488, 148.2907};
  for (unsigned int n = 1; n <= 4; ++n)
    EXPECT_NEAR(Hz(n), printed[n - 1], 5e-5);
  EXPECT_NEAR(ring.frequencies(0).second / (2 * pi), 158.3203, 5e-5);
  EXPECT_NEAR(Hz(5), 172.2780, 5e-5);
  EXPECT_NEAR(ring.frequencies(1).second / (2 * pi), 190.2373, 5e-5);
  EXPECT_NEAR(Hz(22), 844.6858, 5e-5);

  ring.highest_order = 3000;
  EXPECT_NEAR(driving_point(ring, 0).real(), 3.39624e-6, 5e-12);
  const Complex G = driving_point(ring, 200 * pi);
  EXPECT_NEAR(G.real(), 5.91608e-6, 5.1e-12); // 5.916075
  EXPECT_NEAR(G.imag(), -3.58979e-6, 5e-12);

  ring.highest_order = 60;
  const DenseMatrix S = ring_residual(ring, {{0., false}}, 0., RingFrame::road);
  EXPECT_NEAR(S(0, 0), 7.635e-9, 5e-13);
}

// The poles and their residual answer static forces as the whole sum does, tangentially too.
TEST(RingPoles, ResidualCompletesStatics)
{
  RingParameters ring;
  ring.residual_order = 3000;
  const std::vector<RingRow> rows = ring_rows(ring, true);
  RingParameters whole = ring;
  whole.highest_order = 3000;
  for (const double rotation : {0., speed})
    for (const RingFrame frame : {RingFrame::road, RingFrame::co_rotating})
    {
      const ComplexMatrix exact = ring_receptance(whole, rows, rotation, frame, 0.);
      EXPECT_LT(largest(difference(receptance(ring_poles(ring, rows, rotation, frame), 0.), exact)),
                1e-10 * largest(exact));
    }
  // with tread the poles and the inversion beside ring_rest() are the exact statics and the springs, each in its rows
  ring.tread_stiffness = 3e5;
  ring.tread_tangential_stiffness = 1e5;
  for (const double rotation : {0., speed})
  {
    ComplexMatrix exact = ring_receptance(whole, rows, rotation, RingFrame::road, 0.);
    for (unsigned int i = 0; i < rows.size(); ++i)
      exact(i, i) += rows[i].tangential ? 1e-5 : 1 / 3e5;
    ComplexMatrix direct = ring_receptance(ring, rows, rotation, RingFrame::road, 0.);
    const DenseMatrix rest = ring_rest(ring, rows, rotation, RingFrame::road);
    for (unsigned int i = 0; i < rows.size(); ++i)
      for (unsigned int j = 0; j < rows.size(); ++j)
        direct(i, j) += rest(i, j);
    EXPECT_LT(largest(difference(direct, exact)), 1e-10 * largest(exact));
    EXPECT_LT(largest(difference(receptance(ring_poles(ring, rows, rotation), 0.), exact)),
              1e-10 * largest(exact));
  }
}

// Error E of Eq. 9 at the driving point, 0 to 1000 Hz.
TEST(RingPoles, TruncationErrors)
{
  RingParameters ring;
  ring.highest_order = 600;
  std::vector<Complex> exact;
  double size = 0;
  for (unsigned int f = 0; f <= 1000; f += 4)
  {
    exact.push_back(driving_point(ring, 2 * pi * f));
    size += std::abs(exact.back());
  }
  const auto error = [&](const unsigned int highest, const bool with_residual)
  {
    ring.highest_order = highest;
    const double S = with_residual ? ring_residual(ring, {{0., false}}, 0., RingFrame::road)(0, 0) : 0.;
    double sum = 0;
    for (unsigned int k = 0; k < exact.size(); ++k)
      sum += std::abs(exact[k] - driving_point(ring, 8 * pi * k) - S);
    return sum / size;
  };
  // printed: 0.9, 0.13, 1.3 and 0.06 %
  EXPECT_NEAR(error(50, false), 9.10e-3, 1e-4);
  EXPECT_NEAR(error(100, false), 1.245e-3, 2e-5);
  EXPECT_NEAR(error(25, true), 1.24e-2, 2e-4);
  EXPECT_NEAR(error(40, true), 5.67e-4, 1e-5);
}

TEST(RingPoles, BucklingPressure)
{
  RingParameters ring;
  ring.radial_stiffness = ring.circumferential_stiffness = 0;
  ring.thickness = 1e-4; // the formula is that of an inextensible ring
  const double unit = ring.young_modulus * std::pow(ring.thickness / ring.radius, 3) / 12;
  EXPECT_NEAR(ring.buckling_pressure(2) / unit, 3, 1e-6);
  EXPECT_NEAR(ring.buckling_pressure(3) / unit, 8, 1e-5);
  ring.pressure_law = "fixed direction";
  EXPECT_NEAR(ring.buckling_pressure(2) / unit, 4, 1e-6);
  // at the pressure found a shape costs nothing
  ring.pressure = -ring.buckling_pressure(2);
  EXPECT_NEAR(ring.order(2).determinant() / (ring.order(2).tangential * ring.order(2).radial), 0, 1e-12);
}

// Turning as a whole costs nothing under a follower pressure; a free ring that spins moves straight on.
TEST(RingPoles, RigidMotions)
{
  RingParameters ring;
  ring.circumferential_stiffness = 0;
  EXPECT_EQ(ring.order(0).tangential, 0);
  EXPECT_EQ(ring.frequencies(0).first, 0);
  EXPECT_THROW(ring_poles(ring, ring_rows(ring, false)), InputError);
  EXPECT_THROW(ring.check("tyre/Ring"), InputError);
  ring.pressure_law = "fixed direction";
  EXPECT_GT(ring.order(0).tangential, 1e5);

  ring.pressure_law = "follower";
  ring.radial_stiffness = 0;
  const double m = ring.line_density();
  for (const double rotation : {0., speed, 200.})
    for (const double omega : {rotation, -rotation})
    {
      // of n = 1 and n = -1: det(-omega^2 m I + j omega C + L_1)
      const RingParameters::Order L = ring.order(1, rotation);
      const double off = -L.coupling + 2 * omega * m * rotation,
                   determinant =
                       (L.tangential - omega * omega * m) * (L.radial - omega * omega * m) - off * off;
      if (omega == rotation)
        EXPECT_NEAR(determinant / (L.tangential * L.radial), 0, 1e-13);
      else if (rotation != 0)
        EXPECT_GT(std::abs(determinant / (L.tangential * L.radial)), 1e-6);
    }
}

// At rest the two sides of a point move alike, on a rolling ring they do not.
TEST(RingPoles, RollingBreaksReciprocity)
{
  RingParameters ring;
  const std::vector<RingRow> rows = {{0., false}, {0.5, false}, {0., true}};
  for (const double rotation : {0., speed})
  {
    const ComplexMatrix G = receptance(ring_poles(ring, rows, rotation), 2 * pi * 200);
    const double asymmetry = std::abs(G(0, 1) - G(1, 0)) / std::abs(G(0, 1));
    if (rotation == 0)
    {
      EXPECT_LT(asymmetry, 1e-12);
      EXPECT_LT(std::abs(G(0, 2)), 1e-12 * std::abs(G(0, 0)));
    }
    else
      EXPECT_GT(asymmetry, 0.1);
  }
  // mirror image: turning the other way
  const ComplexMatrix forward = receptance(ring_poles(ring, rows, speed), 300.),
                      backward = receptance(ring_poles(ring, rows, -speed), 300.);
  EXPECT_LT(std::abs(forward(0, 1) - backward(1, 0)), 1e-12 * std::abs(forward(0, 1)));
}

// A force inward at the bottom pushes the tread there forward of it forward: sign of the mixed entry.
TEST(RingPoles, SignOfMixedEntry)
{
  RingParameters ring;
  ring.highest_order = 400;
  // statics: the belt, hardly extensible, goes around the bulge: v' = -w < ... inward motion at 0 makes v grow
  // along theta there, so that it is positive just after the bottom
  const ComplexMatrix G = receptance(ring_poles(ring, {{0., false}, {0.02, true}}), 0.);
  EXPECT_GT(G(1, 0).real(), 0);
  EXPECT_LT(std::abs(G(1, 0) - G(0, 1)), 1e-10 * std::abs(G(1, 0)));
}

TEST(OscillatorPoles, RestsUnderItsWeight)
{
  const BodyInContact model = by_poles(OscillatorParameters().between_points(false, 0));
  // z = -load / lambda
  double u = 0;
  for (unsigned int k = 0; k < model.n_poles(); ++k)
    u += 2 * (-model.right(0, k) * model.pole_load[k] / model.poles[k]).real();
  EXPECT_NEAR(u * 4e5 / 9.81, -1, 1e-12);
  EXPECT_NEAR(receptance(model, 0.)(0, 0).real() * 4e5, 1, 1e-12);
  EXPECT_NEAR(initial_derivative(model, 1)(0, 0), 1, 1e-12);
}
