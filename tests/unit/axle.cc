// An axle with its second wheel: beam and wheelset against closed forms, symmetry and limits; inertia of a wheel about its hub.

#include "held_bar.h"
#include "pi.h"
#include "random_structure.h"
#include "root_distance.h"

#include <vibrocontact/analyses/stability/stability.h>
#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/coupled_bodies/contact_receptance.h>
#include <vibrocontact/coupled_bodies/suspended_pair.h>
#include <vibrocontact/fe/revolved_section.h>
#include <vibrocontact/numerics/complex_singular_values.h>
#include <vibrocontact/reduction/compute_modes.h>

#include <deal.II/grid/grid_generator.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace vibrocontact;

namespace
{
  using State = std::array<double, 4>;

  AxleParameters axle()
  {
    AxleParameters axle;
    axle.length = 1.5;
    axle.radius = 0.09;
    axle.inner_radius = 0.03;
    axle.upper_frequency = 1e5;
    return axle;
  }

  /// A rigid wheel whose mass centre is beside its hub.
  struct Wheel
  {
    double mass = 350, moment = 4, polar = 40, diametral = 22;
  };

  ContactPair wheel_in_contact(const Wheel &wheel)
  {
    ContactPair pair = held_bar(0, 1e-9);
    HubInertia hub{{{0, 0.02, 0.46}}, DenseMatrix(6, 6)};
    for (unsigned int d = 0; d < 3; ++d)
    {
      hub.mass(d, d) = wheel.mass;
      hub.mass(3 + d, 3 + d) = d == 1 ? wheel.polar : wheel.diametral;
    }
    hub.mass(0, 5) = hub.mass(5, 0) = -wheel.moment;
    hub.mass(2, 3) = hub.mass(3, 2) = wheel.moment;
    pair.hub_inertia = hub;
    return pair;
  }

  /// Two modes that move the hub in each of its motions.
  ContactPair elastic_wheel_in_contact()
  {
    ContactPair pair = held_bar(12, 1e-9);
    pair.hub_inertia = wheel_in_contact(Wheel()).hub_inertia;
    pair.participation.reinit(12, 6);
    for (unsigned int k = 0; k < 12; ++k)
    {
      // n = 1 even, odd; n = 0
      const unsigned int first = k % 4;
      pair.omega[k] = 2 * pi * (150. + 300 * k);
      if (first == 0)
      {
        pair.participation(k, 2) = 8;
        pair.participation(k, 3) = 1.5;
      }
      if (first == 1)
      {
        pair.participation(k, 0) = 8;
        pair.participation(k, 5) = -1.5;
      }
      if (first == 2)
        pair.participation(k, 1) = 9;
      if (first == 3)
        pair.participation(k, 4) = 2;
    }
    return pair;
  }

  std::vector<double> frequencies(const ContactPair &pair, const std::string &name)
  {
    std::vector<double> result;
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
      if (pair.labels[k].rfind(name + "(", 0) == 0)
        result.push_back(pair.omega[k] / (2 * pi));
    std::sort(result.begin(), result.end());
    return result;
  }

  /// Roots of a function between two places, by its signs.
  template <typename Function>
  std::vector<double> zeros(const Function &f, const double from, const double to, const double step)
  {
    std::vector<double> roots;
    for (double low = from; low < to; low += step)
    {
      double a = low, b = low + step;
      if (!(f(a) * f(b) < 0))
        continue;
      for (unsigned int i = 0; i < 100; ++i)
      {
        const double middle = (a + b) / 2;
        (f(a) * f(middle) <= 0 ? b : a) = middle;
      }
      roots.push_back(a);
    }
    return roots;
  }

  /// Timoshenko beam, y' = A y of deflection, rotation, shear force, bending moment; y(L) of y(0) by Taylor series over pieces.
  State at_end(const AxleParameters &axle, const double omega, State y)
  {
    const double A = axle.material.density * axle.area() * omega * omega,
                 I = axle.material.density * axle.moment() * omega * omega,
                 shear = axle.shear_coefficient() * axle.material.mu() * axle.area(),
                 bending = axle.material.young_modulus * axle.moment();
    const auto slope = [&](const State &v) {
      return State{{v[1] + v[2] / shear, v[3] / bending, -A * v[0], -v[2] - I * v[1]}};
    };
    constexpr unsigned int pieces = 64;
    const double h = axle.length / pieces;
    for (unsigned int piece = 0; piece < pieces; ++piece)
    {
      State term = y;
      for (unsigned int order = 1; order < 12; ++order)
      {
        term = slope(term);
        for (unsigned int i = 0; i < 4; ++i)
        {
          term[i] *= h / order;
          y[i] += term[i];
        }
      }
    }
    return y;
  }

  /// 0 at a frequency of the beam with a wheel and a spring at either end.
  double bending_determinant(const AxleParameters &axle, const Wheel &wheel, const double spring,
                             const double omega)
  {
    const double w2 = omega * omega;
    double residual[2][2];
    for (unsigned int k = 0; k < 2; ++k)
    {
      const double u = k == 0, w = k == 1;
      const State end = at_end(axle, omega,
                               {{u, w, spring * u - w2 * (wheel.mass * u - wheel.moment * w),
                                 -w2 * (-wheel.moment * u + wheel.diametral * w)}});
      residual[0][k] = end[2] - w2 * (wheel.mass * end[0] + wheel.moment * end[1]) + spring * end[0];
      residual[1][k] = end[3] - w2 * (wheel.moment * end[0] + wheel.diametral * end[1]);
    }
    return residual[0][0] * residual[1][1] - residual[0][1] * residual[1][0];
  }

  SuspensionParameters springs(const double x, const double y, const double z)
  {
    SuspensionParameters s;
    s.stiffness[0] = x;
    s.stiffness[1] = y;
    s.stiffness[2] = z;
    return s;
  }

  void compare(const std::vector<double> &found, const std::vector<double> &exact, const double tolerance)
  {
    ASSERT_GE(found.size(), exact.size());
    ASSERT_GE(exact.size(), 4u);
    for (unsigned int k = 0; k < exact.size(); ++k)
    {
      std::printf("%.6f Hz, closed form %.6f Hz\n", found[k], exact[k]);
      EXPECT_NEAR(found[k] / exact[k], 1, tolerance);
    }
  }
} // namespace

TEST(Axle, TorsionOfTwoDiscsOnAShaftHasItsClosedForm)
{
  const AxleParameters shaft = axle();
  const Wheel wheel;
  const ContactPair pair = suspended_pair(wheel_in_contact(wheel),
                                          axle_hub(wheel_in_contact(wheel), springs(1e7, 5e6, 1e6), shaft));
  const double rho = shaft.material.density, speed = std::sqrt(shaft.material.mu() / rho);
  // a = J k / (rho Ip), (a^2 - 1) sin k L = 2 a cos k L
  const std::vector<double> exact = zeros(
      [&](const double f)
      {
        const double k = 2 * pi * f / speed, a = wheel.polar * k / (2 * rho * shaft.moment());
        return (a * a - 1) * std::sin(k * shaft.length) - 2 * a * std::cos(k * shaft.length);
      },
      1, 8000, 1);
  std::vector<double> found = frequencies(pair, "axle:torsion");
  // it turns freely
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found[0], 0);
  found.erase(found.begin());
  compare(found, exact, 1e-7);
}

TEST(Axle, BendingOfTwoDiscsOnABeamHasThatOfItsDifferentialEquation)
{
  const AxleParameters beam = axle();
  const Wheel wheel;
  const ContactPair pair = suspended_pair(wheel_in_contact(wheel),
                                          axle_hub(wheel_in_contact(wheel), springs(1e7, 5e6, 1e6), beam));
  for (const auto &[name, spring] : {std::make_pair("axle:x", 1e7), std::make_pair("axle:z", 1e6)})
    compare(frequencies(pair, name),
            zeros([&, k = spring](const double f) { return bending_determinant(beam, wheel, k, 2 * pi * f); },
                  1, 5200, 0.5),
            1e-6);
}

TEST(Axle, FreeWheelsetHasSixRigidMotionsAndItsInertia)
{
  const AxleParameters beam = axle();
  const Wheel wheel;
  const HubCoordinates hub = axle_hub(wheel_in_contact(wheel), SuspensionParameters(), beam);
  const ContactPair pair = suspended_pair(wheel_in_contact(wheel), hub);
  EXPECT_EQ(std::count(pair.omega.begin(), pair.omega.end(), 0.), 6);
  const double L = beam.length, own = beam.material.density * beam.area() * L,
               I = beam.material.density * beam.moment() * L;
  // rigid motions are those of the hub of body 1
  for (unsigned int d = 0; d < 3; ++d)
    EXPECT_NEAR(hub.mass(d, d), 2 * wheel.mass + own, 1e-9 * own);
  EXPECT_NEAR(hub.mass(4, 4), 2 * wheel.polar + 2 * I, 1e-9 * wheel.polar);
  const double far = L + wheel.moment / wheel.mass, centre = wheel.moment / wheel.mass;
  const double about_z = 2 * (wheel.diametral - wheel.mass * centre * centre) +
                         wheel.mass * (centre * centre + far * far) + own * L * L / 3 + I;
  EXPECT_NEAR(hub.mass(5, 5) / about_z, 1, 1e-9);
  EXPECT_NEAR(hub.mass(3, 3) / about_z, 1, 1e-9);
}

TEST(Axle, MotionsAreSymmetricOrAntisymmetric)
{
  AxleParameters beam = axle();
  beam.box_distance = 0.25;
  beam.box_mass = 100;
  const ContactPair held = elastic_wheel_in_contact();
  const ContactPair pair = suspended_pair(held, axle_hub(held, springs(1e7, 5e6, 1e6), beam));
  const SuspendedHub &hub = *pair.hub;
  const unsigned int n_1 = held.n_modes();
  unsigned int symmetric = 0, antisymmetric = 0;
  for (unsigned int j = 0; j < hub.shapes.n(); ++j)
  {
    std::array<double, 6> first, second;
    for (unsigned int d = 0; d < 6; ++d)
    {
      first[d] = hub.motion(d, j);
      second[d] = first[d] + hub.shapes(n_1 + 6 + d, j);
    }
    second[0] += beam.length * first[5];
    second[2] -= beam.length * first[3];
    double largest = 0, as_mirror = 0, against_it = 0;
    for (unsigned int d = 0; d < 6; ++d)
    {
      const double mirrored = (d == 1 || d == 3 || d == 5 ? -1 : 1) * second[d];
      largest = std::max(largest, std::abs(first[d]));
      as_mirror = std::max(as_mirror, std::abs(first[d] - mirrored));
      against_it = std::max(against_it, std::abs(first[d] + mirrored));
    }
    const bool is_symmetric = as_mirror < 1e-6 * largest, is_anti = against_it < 1e-6 * largest;
    EXPECT_TRUE(is_symmetric || is_anti) << pair.labels[j] << " " << as_mirror << " " << against_it;
    symmetric += is_symmetric;
    antisymmetric += is_anti;
  }
  // each mode of the wheel is there twice
  EXPECT_GT(symmetric, 30u);
  EXPECT_GT(antisymmetric, 30u);
}

namespace
{
  std::vector<StabilityRoot> roots_of(const ContactPair &pair, const RollingEquilibrium &about)
  {
    return stability_roots(pair, linearised_contact(pair, creep_schemes().front(), about, {}));
  }

  ContactPair structure_with_hub(const Wheel &wheel)
  {
    ContactPair pair = reduce(structure(90, 5), 30, 2e-3);
    pair.participation.reinit(30, 6);
    for (unsigned int k = 0; k < 30; ++k)
      for (unsigned int d = 0; d < 3; ++d)
        pair.participation(k, d) = 0.3 * std::sin(1. + k + 7 * d);
    pair.hub_inertia = wheel_in_contact(wheel).hub_inertia;
    return pair;
  }
} // namespace

TEST(Axle, LimitsAreHeldAndSuspended)
{
  const RollingEquilibrium about = sliding(5, 0.35, 300, 0.5);
  AxleParameters beam = axle();
  beam.upper_frequency = 0;
  // heavy wheels do not move
  const ContactPair heavy = structure_with_hub({1e12, 0, 1e12, 1e12});
  const std::vector<StabilityRoot> held = roots_of(heavy, about);
  ASSERT_GT(held.size(), 20u);
  EXPECT_LT(
      distance(held, roots_of(suspended_pair(heavy, axle_hub(heavy, springs(1e7, 1e7, 1e7), beam)), about)),
      1e-5);
  // a soft axle without mass between wheels that do not turn
  beam.material.young_modulus = 1e-3;
  beam.material.density = 1e-6;
  const ContactPair pair = structure_with_hub({50, 0, 1e12, 1e12});
  SuspensionParameters alone = springs(1e6, 2e6, 3e6), boxes = alone;
  alone.mass = 50;
  for (unsigned int d = 0; d < 3; ++d)
    alone.damping[d] = boxes.damping[d] = 1e3;
  const std::vector<StabilityRoot> suspended = roots_of(suspended_pair(pair, suspended_hub(alone)), about);
  EXPECT_GT(distance(held, suspended), 1e-3);
  EXPECT_LT(distance(suspended, roots_of(suspended_pair(pair, axle_hub(pair, boxes, beam)), about)), 1e-5);
}

TEST(Axle, DampersOfAHubAreInTheContactsOwnEquations)
{
  const RollingEquilibrium about = sliding(5, 0.35, 300, 0.5);
  const ContactPair pair = structure_with_hub({50, 0, 5, 5});
  SuspensionParameters boxes = springs(1e6, 2e6, 3e6);
  for (unsigned int d = 0; d < 3; ++d)
    boxes.damping[d] = 1e4;
  const ContactPair moving = suspended_pair(pair, axle_hub(pair, boxes, axle()));
  const ContactReceptance F(moving, creep_schemes().front(), about);
  const auto singularity = [&](const std::complex<double> &s)
  { return complex_singular_values(F.value(s)).values.back(); };
  unsigned int n = 0, n_singular = 0;
  for (const StabilityRoot &root : roots_of(moving, about))
  {
    if (root.frequency < 1 || ++n > 30)
      continue;
    // roots may lie next to poles: differences are taken beside them
    const std::complex<double> root_value(root.growth, 2 * pi * root.frequency),
        s = root_value + 0.02 * std::abs(root_value), h = 1e-5 * s;
    n_singular += singularity(root_value) < 1e-6 * singularity(s);
    const ComplexMatrix after = F.value(s + h), before = F.value(s - h), slope = F.derivative(s);
    double largest = 0, error = 0;
    for (unsigned int j = 0; j < slope.n(); ++j)
      for (unsigned int i = 0; i < slope.m(); ++i)
      {
        largest = std::max(largest, std::abs(slope(i, j)));
        error = std::max(error, std::abs(slope(i, j) - (after(i, j) - before(i, j)) / (2. * h)));
      }
    EXPECT_LT(error, 1e-4 * largest) << root.label;
  }
  EXPECT_GT(n, 30u);
  // round-off hides one that is a pole to six digits
  EXPECT_GE(n_singular, 29u);
}

// All modes of a section move what the whole body moves, but for what its held nodes have.
TEST(Axle, ModesOfAWheelHaveItsMomentaAboutTheHub)
{
  run_log().set_screen(false);
  const auto annulus = std::make_shared<dealii::Triangulation<2>>();
  // held at its inner radius, mass centre beside the middle of what is held
  dealii::GridGenerator::subdivided_hyper_rectangle(*annulus, {2, 8}, dealii::Point<2>(-0.03, 0.05),
                                                    dealii::Point<2>(0.03, 0.4));
  for (const auto &cell : annulus->active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
      if (cell->face(f)->at_boundary())
        cell->face(f)->set_boundary_id(
            cell->face(f)->center()[1] < 0.0501 && cell->face(f)->center()[0] < 0 ? 1 : 0);
  ElasticModel<3> model;
  model.held = {1};
  const RevolvedSection section("annulus", annulus, model, 2);
  EXPECT_NEAR(section.hub_place(), -0.015, 1e-12);
  const double rho = model.material.density, a = 0.4, b = 0.05, area = pi * (a * a - b * b),
               mass = rho * area * 0.06;
  using Rigid = RevolvedSection::RigidMotion;
  const auto across = section.rigid_motion(Rigid::across_axle), tilt = section.rigid_motion(Rigid::tilt),
             about = section.rigid_motion(Rigid::about_axle), along = section.rigid_motion(Rigid::along_axle);
  const double polar = mass * (a * a + b * b) / 2,
               diametral = polar / 2 + mass * (0.06 * 0.06 / 12 + 0.015 * 0.015);
  EXPECT_NEAR(section.inertia(1, across, across) / mass, 1, 1e-10);
  EXPECT_NEAR(section.inertia(0, along, along) / mass, 1, 1e-10);
  EXPECT_NEAR(-section.inertia(1, across, tilt) / (mass * 0.015), 1, 1e-9);
  EXPECT_NEAR(section.inertia(0, about, about) / polar, 1, 1e-10);
  EXPECT_NEAR(section.inertia(1, tilt, tilt) / diametral, 1, 1e-10);
  for (const unsigned int n : {0u, 1u})
  {
    const auto system = section.system(n);
    Flexibility flexibility(*system);
    ModeParameters wanted;
    wanted.count = 120;
    const Modes modes = compute_modes(*system, flexibility, wanted);
    const dealii::Vector<double> *const motions[2] = {n == 0 ? &along : &across, n == 0 ? &about : &tilt};
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j <= i; ++j)
      {
        double sum = 0;
        for (const auto &shape : modes.shapes)
          sum += (shape * section.momentum(n, *motions[i])) * (shape * section.momentum(n, *motions[j]));
        const double whole = section.inertia(n, *motions[i], *motions[j]),
                     scale = std::sqrt(section.inertia(n, *motions[i], *motions[i]) *
                                       section.inertia(n, *motions[j], *motions[j]));
        std::printf("n = %u: %.6f of %.6f\n", n, sum, whole);
        EXPECT_NEAR(sum, whole, 3e-3 * scale);
        EXPECT_LE(i == j ? sum : 0., whole * (i == j) + 1e-9);
      }
  }
}
