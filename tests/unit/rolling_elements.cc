// Rings by elements that roll, in the modes of the ring at rest, against the analytic ring, whose equations stand in the frame
// that turns with it: poles, receptances, stretch of the material, powers.
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/bodies/ring_poles.h>
#include <vibrocontact/bodies/rolling_modes.h>
#include <vibrocontact/contact/creep.h>
#include <vibrocontact/fe/material_flow.h>
#include <vibrocontact/fe/ring_elements.h>
#include <vibrocontact/reduction/flow_reduction.h>
#include <vibrocontact/reduction/reduction_parts.h>

#include "at_rest.h"
#include "pi.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace vibrocontact;

namespace
{
  using Complex = std::complex<double>;

  RingParameters rolling_ring(const std::string &model, const unsigned int divisions)
  {
    RingParameters ring;
    ring.model = model;
    ring.divisions = divisions;
    ring.rolling = true;
    return ring;
  }

  ReducedBody reduced(const RingParameters &ring, const double upper_frequency)
  {
    const ContactGrid grid = ring.grid();
    const auto system = assemble_ring(ring, "ring", &grid, MPI_COMM_WORLD);
    Flexibility flexibility(*system);
    ModeParameters parameters;
    parameters.upper_frequency = upper_frequency;
    Modes modes;
    const ModalReduction modal = reduce_modally(*system, flexibility, parameters, {}, &modes);
    ReducedBody body = combine(reduce_statically(*system, flexibility), &modal);
    body.flow = std::make_shared<const FlowReduction>(reduce_flow(*system, flexibility, modes));
    return body;
  }

  const std::vector<double> upwind = find_creep_scheme("second-order upwind").coefficients;

  BodyInContact analytic(const RingParameters &ring, const double speed)
  {
    BodyInContact body = ring_poles(ring, ring_rows(ring, true), ring.rotation(speed));
    add_gradient(body, ring, ring.rotation(speed), upwind);
    return body;
  }

  /// Largest distance of a pole of `exact` up to an order, over its modulus, to the nearest one of `found` or its conjugate.
  double distance(const BodyInContact &found, const BodyInContact &exact)
  {
    double result = 0;
    for (const Complex &pole : exact.poles)
    {
      double nearest = 1e300;
      for (const Complex &one : found.poles)
        nearest = std::min({nearest, std::abs(one - pole), std::abs(std::conj(one) - pole)});
      result = std::max(result, nearest / std::abs(pole));
    }
    return result;
  }

  double difference(const DenseMatrix &found, const DenseMatrix &exact)
  {
    double error = 0, size = 0;
    for (unsigned int i = 0; i < exact.m(); ++i)
      for (unsigned int j = 0; j < exact.n(); ++j)
      {
        error = std::max(error, std::abs(found(i, j) - exact(i, j)));
        size = std::max(size, std::abs(exact(i, j)));
      }
    return error / size;
  }
} // namespace

// All terms of second order in Omega cancel: the poles are those of the ring in its own frame, where they do not.
TEST(RollingElements, BeamPoles)
{
  const RingParameters ring = rolling_ring("beam elements", 400);
  RingParameters exact = ring;
  exact.highest_order = 8;
  exact.residual = false;
  const ReducedBody body = reduced(ring, 1300);
  for (const double speed : {1e-3, 10., 30., 80., -30.})
  {
    const BodyInContact found = ring.on_road(body, true, speed, upwind);
    const double error = distance(found, ring_poles(exact, ring_rows(exact, true), exact.rotation(speed)));
    RecordProperty("error at " + std::to_string(speed) + " m/s", std::to_string(1e6 * error) + "e-6");
    EXPECT_LT(error, 1e-6) << speed;
    EXPECT_EQ(found.n_poles(), body.omega.size());
  }
}

// They are named by their number of waves.
TEST(RollingElements, Labels)
{
  const RingParameters ring = rolling_ring("beam elements", 200);
  const BodyInContact found = ring.on_road(reduced(ring, 1300), false, 30, {});
  RingParameters exact = ring;
  exact.residual = false;
  exact.highest_order = 8;
  const BodyInContact orders = ring_poles(exact, ring_rows(exact, false), exact.rotation(30));
  unsigned int named = 0;
  for (unsigned int k = 0; k < found.n_poles(); ++k)
  {
    const std::string number = found.labels[k].substr(0, found.labels[k].find(',') + 1);
    if (std::stoi(number.substr(2)) > 8)
      continue;
    ++named;
    double nearest = 1e300;
    for (unsigned int i = 0; i < orders.n_poles(); ++i)
      if (orders.labels[i].rfind(number, 0) == 0)
        nearest = std::min({nearest, std::abs(orders.poles[i] - found.poles[k]),
                            std::abs(std::conj(orders.poles[i]) - found.poles[k])});
    EXPECT_LT(nearest, 1e-5 * std::abs(found.poles[k])) << found.labels[k];
  }
  EXPECT_EQ(named, orders.n_poles());
}

// Between the contact points, in the frame of the road, where G(theta) is not G(-theta).
TEST(RollingElements, BeamReceptance)
{
  RingParameters ring = rolling_ring("beam elements", 400);
  ring.spacing = 2 * pi * ring.radius / 100; // to nodes
  RingParameters exact = ring;
  exact.highest_order = 1000;
  const ReducedBody body = reduced(ring, 8000);
  for (const double speed : {30., 80.})
  {
    const BodyInContact found = ring.on_road(body, true, speed, upwind);
    for (const double f : {0., 100., 400., 1000.})
    {
      const ComplexMatrix A = receptance(found, 2 * pi * f),
                          B = ring_receptance(exact, ring_rows(exact, true), exact.rotation(speed),
                                              RingFrame::road, 2 * pi * f);
      double radial = 0, all = 0, skew = 0;
      for (unsigned int i = 0; i < A.m(); ++i)
        for (unsigned int k = 0; k < A.n(); ++k)
        {
          const double size = std::sqrt(std::abs(B(i, i) * B(k, k))), error = std::abs(A(i, k) - B(i, k));
          all = std::max(all, error / size);
          if (i < 3 && k < 3)
          {
            radial = std::max(radial, error / size);
            skew = std::max(skew, std::abs(B(i, k) - B(k, i)) / size);
          }
        }
      const std::string at = std::to_string(int(f)) + " Hz, " + std::to_string(int(speed)) + " m/s";
      RecordProperty("radial error at " + at, std::to_string(radial));
      RecordProperty("error at " + at, std::to_string(all));
      EXPECT_GT(skew, 0.01) << at;
      EXPECT_LT(radial, 1e-3) << at;
      EXPECT_LT(all, 0.02) << at;
    }
  }
}

// The stretch of the shapes is the derivative of their vector in axes that do not turn: differences of neighbouring points are
// of second order in their distance.
TEST(RollingElements, GradientEqualsDifferencesInFixedAxes)
{
  for (const char *model : {"beam elements", "solid elements"})
  {
    RingParameters ring = rolling_ring(model, 200);
    double last = 0;
    for (const double spacing : {16e-3, 8e-3})
    {
      ring.spacing = spacing;
      const BodyInContact body = ring.on_road(reduced(ring, 300), true, 20, upwind);
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
        EXPECT_NEAR(last / error, 4, 0.5) << model;
      EXPECT_LT(error, 0.05 * size) << model;
      last = error;
    }
  }
}

// Stretch of the material under constant forces, the residual differenced from upstream. A force along the circle lets it jump,
// in which a wave more or less is seen: modes up to 8 kHz have 68 of the fast branch and some more of the slow one.
TEST(RollingElements, StretchUnderConstantForces)
{
  RingParameters ring = rolling_ring("beam elements", 400);
  ring.n_points = 4;
  ring.spacing = 2 * pi * ring.radius / 100;
  const ReducedBody body = reduced(ring, 8000);
  RingParameters exact = ring;
  exact.highest_order = 68;
  for (const double speed : {30., -30.})
  {
    const BodyInContact found = ring.on_road(body, true, speed, upwind), orders = analytic(exact, speed);
    const double stretch = difference(at_rest(found, true), at_rest(orders, true)),
                 motion = difference(at_rest(found, false), at_rest(orders, false));
    RecordProperty("stretch at " + std::to_string(int(speed)) + " m/s", std::to_string(stretch));
    RecordProperty("motion at " + std::to_string(int(speed)) + " m/s", std::to_string(motion));
    EXPECT_LT(stretch, 0.04) << speed;
    EXPECT_LT(motion, 1e-3) << speed;
  }
}

// Constant forces T along the circle feed sum T Omega v' on the material that flows past, and the damping of the modes takes
// it: 2 zeta w (Omega G_turning q)^2.
TEST(RollingElements, ForcesFeedTheDamping)
{
  RingParameters ring = rolling_ring("beam elements", 200);
  ring.n_points = 4;
  ring.spacing = 0.05;
  const ReducedBody body = reduced(ring, 2000);
  const double Omega = ring.rotation(25);
  BodyInContact found = ring.on_road(body, true, 25, upwind);
  // the modes alone
  found.residual.reinit(8, 8);
  found.residual_gradient.reinit(8, 8);
  const DenseMatrix u = at_rest(found, false), du = at_rest(found, true);
  const std::vector<double> T = {100, -30, 45, 80};
  double fed = 0, taken = 0;
  for (unsigned int i = 0; i < 4; ++i)
  {
    double stretch = 0, w = 0;
    for (unsigned int j = 0; j < 4; ++j)
    {
      stretch += du(4 + i, 4 + j) * T[j];
      w -= u(i, 4 + j) * T[j];
    }
    fed += T[i] * Omega * (ring.radius * stretch - w);
  }
  // the amplitudes at rest solve w^2 q + 2 zeta w Omega G_turning q = trace^T T
  const unsigned int n = body.omega.size();
  DenseMatrix K(n, n);
  DenseVector q(n);
  for (unsigned int i = 0; i < n; ++i)
  {
    for (unsigned int j = 0; j < n; ++j)
      K(i, j) = 2 * body.damping_ratio[i] * body.omega[i] * Omega * body.flow->turning(i, j);
    K(i, i) += body.omega[i] * body.omega[i];
    for (unsigned int p = 0; p < 4; ++p)
      q(i) += body.trace(contact_row(4, 1, p), i) * T[p];
  }
  K.compute_lu_factorization();
  K.solve(q);
  for (unsigned int i = 0; i < n; ++i)
  {
    double rate = 0;
    for (unsigned int j = 0; j < n; ++j)
      rate += Omega * body.flow->turning(i, j) * q(j);
    taken += 2 * body.damping_ratio[i] * body.omega[i] * rate * rate;
  }
  EXPECT_GT(taken, 1e-3);
  EXPECT_NEAR(fed / taken, 1, 1e-3);
}

// A motion as a whole has no derivative in axes that do not turn, a rotation none in axes that do; what elements find is how
// far they are from a circle.
TEST(RollingElements, RigidMotions)
{
  std::array<double, 3> last{};
  for (const unsigned int divisions : {30u, 60u})
  {
    const RingParameters ring = rolling_ring("solid elements", divisions);
    const auto system = assemble_ring(ring, "ring", nullptr, MPI_COMM_WORLD);
    dealii::PETScWrappers::MPI::Vector motion(system->locally_owned, system->communicator), flow(motion);
    for (const unsigned int axis : {0u, 1u, 2u})
    {
      motion = 0;
      for (unsigned int i = 0; i < system->dof_direction.size(); ++i)
      {
        const auto &place = system->dof_position[i];
        const double turn = system->dof_direction[i] == 0 ? ring.radius - place[2] : place[0];
        motion(system->locally_owned.nth_index_in_set(i)) =
            axis == 1 ? turn / ring.radius : (system->dof_direction[i] == axis ? 1. : 0.);
      }
      motion.compress(dealii::VectorOperation::insert);
      const MaterialFlow &both = *system->flow;
      (axis == 1 ? both.fixed : both.turning).vmult(flow, motion);
      const double size = flow.linfty_norm();
      (axis == 1 ? both.turning : both.fixed).vmult(flow, motion);
      const double error = flow.linfty_norm() / size;
      EXPECT_LT(error, 2e-3) << axis;
      if (last[axis] > 0)
        EXPECT_LT(error, last[axis] / 6) << axis;
      last[axis] = error;
    }
  }
}

// Shear and rotary inertia go with the square of the thickness: what remains of the distance to the thin ring is small.
TEST(RollingElements, SolidPolesOfThinRings)
{
  for (const double speed : {30., -60.})
  {
    std::array<std::vector<Complex>, 2> distances;
    for (const unsigned int half : {0u, 1u})
    {
      RingParameters ring = rolling_ring("solid elements", 96);
      ring.thickness = half ? 0.005 : 0.01;
      RingParameters exact = ring;
      exact.highest_order = 4;
      exact.residual = false;
      const BodyInContact found = ring.on_road(reduced(ring, 1000), true, speed, upwind);
      for (const Complex &pole : ring_poles(exact, ring_rows(exact, true), ring.rotation(speed)).poles)
      {
        Complex nearest = 1e300;
        for (const Complex &one : found.poles)
          for (const Complex &candidate : {one, std::conj(one)})
            if (std::abs(candidate - pole) < std::abs(nearest))
              nearest = candidate - pole;
        distances[half].push_back(nearest / std::abs(pole));
      }
    }
    double thick = 0, extrapolated = 0;
    for (unsigned int k = 0; k < distances[0].size(); ++k)
    {
      thick = std::max(thick, std::abs(distances[0][k]));
      extrapolated = std::max(extrapolated, std::abs((4. * distances[1][k] - distances[0][k]) / 3.));
    }
    const std::string at = " at " + std::to_string(int(speed)) + " m/s";
    RecordProperty("10 mm" + at, std::to_string(thick));
    RecordProperty("extrapolated" + at, std::to_string(extrapolated));
    EXPECT_LT(thick, 2e-3) << speed;
    EXPECT_LT(extrapolated, 1e-4) << speed;
  }
}

// Beyond the speed at which waves stand still damping by the material drives them.
TEST(RollingElements, GrowingMotionIsRefused)
{
  RingParameters ring = rolling_ring("beam elements", 104);
  const ReducedBody body = reduced(ring, 1000);
  EXPECT_NO_THROW(ring.on_road(body, false, 30, {}));
  EXPECT_THROW(ring_poles(ring, ring_rows(ring, false), ring.rotation(400)), InputError);
  EXPECT_THROW(ring.on_road(body, false, 400, {}), InputError);
}

TEST(RollingElements, NoModesAreRefused)
{
  EXPECT_THROW(reduced(rolling_ring("beam elements", 24), 20), InputError);
}

// On any number of ranks.
TEST(RollingElementsMpi, Poles)
{
  for (const char *model : {"beam elements", "solid elements"})
  {
    const RingParameters ring = rolling_ring(model, 80);
    RingParameters exact = ring;
    exact.highest_order = 5;
    exact.residual = false;
    const ReducedBody body = reduced(ring, 900);
    const BodyInContact found = ring.on_road(body, true, 40, upwind);
    const double band = ring.model == "beam elements" ? 2e-5 : 2e-3;
    EXPECT_LT(distance(found, ring_poles(exact, ring_rows(exact, true), exact.rotation(40))), band) << model;
    exact.highest_order = 60;
    exact.residual = true;
    EXPECT_LT(difference(at_rest(found, false), at_rest(analytic(exact, 40), false)), 0.03) << model;
  }
}
