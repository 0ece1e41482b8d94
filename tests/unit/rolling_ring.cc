// Gradients of a rolling ring, along which its material flows through the contact points: the closed form against
// differences, the balance of powers and the sums of more orders.
#include <vibrocontact/bodies/ring_poles.h>
#include <vibrocontact/contact/creep.h>

#include "at_rest.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace vibrocontact;

namespace
{
  using Complex = std::complex<double>;
  const double Omega = -77.9727;

  BodyInContact rolling(const RingParameters &ring, const double rotation = Omega,
                        const std::string &scheme = "second-order upwind")
  {
    BodyInContact body = ring_poles(ring, ring_rows(ring, true), rotation);
    add_gradient(body, ring, rotation, find_creep_scheme(scheme).coefficients);
    return body;
  }
} // namespace

// The vector of neighbouring points in fixed axes, differenced: second order in their distance.
TEST(RollingRing, GradientEqualsDifferencesInFixedAxes)
{
  RingParameters ring;
  ring.residual = false;
  ring.highest_order = 12;
  ring.n_points = 3;
  double last = 0;
  for (const double spacing : {4e-3, 2e-3, 1e-3})
  {
    ring.spacing = spacing;
    const BodyInContact body = rolling(ring);
    const double turn = spacing / ring.radius;
    double error = 0, size = 0;
    for (unsigned int k = 0; k < body.n_poles(); ++k)
    {
      // forward at the middle point; inward at a point in front is up and backward
      const auto forward = [&](const unsigned int i, const double angle)
      { return std::cos(angle) * body.right(3 + i, k) - std::sin(angle) * body.right(i, k); };
      const Complex slope = (forward(2, turn) - forward(0, -turn)) / (2 * spacing);
      error = std::max(error, std::abs(slope - body.gradient(4, k)));
      size = std::max(size, std::abs(body.gradient(4, k)));
      for (unsigned int i = 0; i < 3; ++i)
        EXPECT_EQ(body.gradient(i, k), 0.);
    }
    if (last > 0)
      EXPECT_NEAR(last / error, 4, 0.2);
    EXPECT_LT(error, 0.05 * size);
    last = error;
  }
}

// A ring that the foundation does not deform moves as a whole: it is not stretched, whatever the directions.
TEST(RollingRing, MotionAsAWholeStretchesNothing)
{
  RingParameters ring;
  ring.young_modulus = 1e13;
  ring.highest_order = 1;
  ring.residual = false;
  const BodyInContact body = rolling(ring, -1e-3);
  const DenseMatrix u = at_rest(body, false), du = at_rest(body, true);
  // of the band under a unit force, far below its displacement over the radius
  const double strain = 1 / (ring.young_modulus * ring.thickness * ring.width);
  EXPECT_LT(strain, 1e-4 * u(0, 0) / ring.radius);
  for (unsigned int j = 0; j < 6; ++j)
    for (unsigned int i = 3; i < 6; ++i)
      EXPECT_LT(std::abs(du(i, j)), strain) << i << " " << j;
}

// Constant forces along the circle on a rolling ring: what they do on the material that flows past, in axes that turn
// with it, T Omega dv/dtheta, is what the damping of all orders takes.
TEST(RollingRing, ForcesFeedTheDamping)
{
  RingParameters ring;
  ring.residual = false;
  ring.highest_order = 8;
  ring.n_points = 4;
  ring.spacing = 0.05;
  const BodyInContact body = rolling(ring);
  const DenseMatrix u = at_rest(body, false), du = at_rest(body, true);
  const std::vector<double> T = {100, -30, 45, 80}, angles = ring.angles();
  const unsigned int n = ring.n_points;
  double fed = 0;
  for (unsigned int i = 0; i < n; ++i)
  {
    double stretch = 0, w = 0;
    for (unsigned int j = 0; j < n; ++j)
    {
      stretch += du(n + i, n + j) * T[j];
      w -= u(i, n + j) * T[j];
    }
    fed += T[i] * Omega * (ring.radius * stretch - w);
  }
  // q_n = H_n T_n from the 2 x 2 systems, velocities j n Omega q in turning axes, D_n = 2 xi sqrt(m) sqrt(L_n)
  double taken = 0;
  for (int order = -8; order <= 8; ++order)
  {
    const auto row = [&](const bool tangential)
    {
      Complex q = 0;
      for (unsigned int j = 0; j < n; ++j)
      {
        // the amplitude of e^(j order theta) from places around the circle
        const unsigned int n_places = 32;
        for (unsigned int k = 0; k < n_places; ++k)
        {
          const double theta = 2 * dealii::numbers::PI * k / n_places;
          const Complex G = ring_receptance(ring, {{theta, tangential}, {angles[j], true}}, Omega,
                                            RingFrame::road, 0.)(0, 1);
          q += G * T[j] * std::polar(1. / n_places, -order * theta);
        }
      }
      return q;
    };
    const Complex v = row(true), w = -row(false);
    const RingParameters::Order L = ring.order(std::abs(order));
    const double coupling = order < 0 ? -L.coupling : L.coupling, root = std::sqrt(L.determinant()),
                 m = ring.line_density(),
                 factor = 2 * ring.damping_ratio * std::sqrt(m / (L.tangential + L.radial + 2 * root));
    const double form = factor * ((L.tangential + root) * std::norm(v) + (L.radial + root) * std::norm(w) +
                                  2 * (std::conj(v) * Complex(0, -coupling) * w).real());
    taken += 2 * dealii::numbers::PI * ring.radius * std::pow(order * Omega, 2) * form;
  }
  EXPECT_GT(taken, 1e-3);
  EXPECT_NEAR(fed / taken, 1, 1e-9);
}

// Orders by differences from upstream, as the residual has them, become those in closed form with the distance.
TEST(RollingRing, ResidualIsDifferenced)
{
  RingParameters whole, split;
  whole.n_points = split.n_points = 4;
  whole.spacing = split.spacing = 0.02;
  whole.highest_order = 40;
  whole.residual = false;
  split.highest_order = 5;
  split.residual_order = 40;
  const auto stretch = [&](const RingParameters &ring, const double rotation)
  { return at_rest(rolling(ring, rotation), true); };
  for (const double rotation : {Omega, -Omega})
  {
    double last = 0;
    for (const double spacing : {1e-3, 5e-4, 2.5e-4})
    {
      whole.spacing = split.spacing = spacing;
      const DenseMatrix exact = stretch(whole, rotation), found = stretch(split, rotation);
      double error = 0, size = 0;
      for (unsigned int i = 4; i < 8; ++i)
        for (unsigned int j = 0; j < 8; ++j)
        {
          error = std::max(error, std::abs(found(i, j) - exact(i, j)));
          size = std::max(size, std::abs(exact(i, j)));
        }
      if (last > 0)
        EXPECT_NEAR(last / error, 4, 0.5) << spacing;
      EXPECT_LT(error, 0.2 * size);
      last = error;
    }
  }
}

// The tread enters free of shear, whichever way the ring rolls.
TEST(RollingRing, TreadEntersUndeformed)
{
  RingParameters ring;
  ring.residual = false;
  ring.tread_tangential_stiffness = 2e5;
  const double unit = 1 / (ring.tread_tangential_stiffness * ring.spacing);
  const BodyInContact forward = rolling(ring, -10, "first-order upwind"),
                      backward = rolling(ring, 10, "first-order upwind");
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 6; ++j)
    {
      EXPECT_NEAR(forward.residual_gradient(3 + i, j) / unit, (j == i + 3 ? -1 : 0) + (j == i + 4 ? 1 : 0),
                  1e-12);
      EXPECT_NEAR(backward.residual_gradient(3 + i, j) / unit,
                  (j == i + 3 ? 1 : 0) - (j + 1 == i + 3 && i > 0 ? 1 : 0), 1e-12);
    }
}
