// Rings of beam and of plane solid elements against closed forms and against polynomials through the thickness.
#include "pi.h"

#include <vibrocontact/bodies/ring_poles.h>
#include <vibrocontact/fe/ring_elements.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/reduction_parts.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

using namespace vibrocontact;

namespace
{
  /// Frequencies of orders 0 to 60, those of n > 0 twice [rad/s].
  std::vector<double> sorted(const std::function<std::vector<double>(unsigned int)> &of_order)
  {
    std::vector<double> all;
    for (unsigned int n = 0; n <= 60; ++n)
      for (const double omega : of_order(n))
        all.insert(all.end(), n == 0 ? 1 : 2, omega);
    std::sort(all.begin(), all.end());
    return all;
  }

  std::vector<double> beam_frequencies(const RingParameters &ring)
  {
    return sorted(
        [&](const unsigned int n)
        {
          const auto [low, high] = ring.frequencies(n);
          return std::vector<double>{low, high};
        });
  }

  /// The plane solid ring in order n: u_r = U(r) cos n theta, u_theta = V(r) sin n theta, Legendre polynomials
  /// of degree 9 in r; all frequencies [rad/s].
  struct SolidModes
  {
    std::vector<double> omega;
    /// mean of U over the thickness, modal mass 1 once multiplied by 1 / pi (2 pi for n = 0) [1/sqrt(kg)]
    std::vector<double> mean;
  };

  SolidModes solid_modes(const RingParameters &ring, const unsigned int order)
  {
    const unsigned int degree = 9, m = degree + 1;
    const double n = order, E = ring.young_modulus, b = ring.width, R = ring.radius, h = ring.thickness;
    const auto basis = dealii::Polynomials::Legendre::generate_complete_basis(degree);
    DenseMatrix K(2 * m), M(2 * m);
    const auto add = [&](DenseMatrix &matrix, const double factor, const std::vector<double> &row)
    {
      for (unsigned int i = 0; i < 2 * m; ++i)
        for (unsigned int k = 0; k < 2 * m; ++k)
          matrix(i, k) += factor * row[i] * row[k];
    };
    // a U + b U' + c V + d V' at a place of the thickness
    const auto row = [&](const double s, const double a, const double da, const double c, const double dc)
    {
      std::vector<double> result(2 * m), value(2);
      for (unsigned int k = 0; k < m; ++k)
      {
        basis[k].value(s, value);
        result[k] = a * value[0] + da * value[1] / h;
        result[m + k] = c * value[0] + dc * value[1] / h;
      }
      return result;
    };
    const dealii::QGauss<1> gauss(degree + 4);
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double s = gauss.point(q)[0], r = R - h / 2 + h * s, weight = gauss.weight(q) * b * h * r;
      const double hoop = ring.pressure * R / h;
      add(K, weight * hoop, row(s, n / r, 0, 1 / r, 0));
      add(K, weight * hoop, row(s, 1 / r, 0, n / r, 0));
      add(K, weight * E, row(s, 0, 1, 0, 0));
      add(K, weight * E, row(s, 1 / r, 0, n / r, 0));
      add(K, weight * E / 2, row(s, -n / r, 0, -1 / r, 1));
      add(M, weight * ring.density, row(s, 1, 0, 0, 0));
      add(M, weight * ring.density, row(s, 0, 0, 1, 0));
    }
    const double inside = ring.pressure_law == "follower" ? R * ring.tension() : 0;
    add(K, R * ring.radial_stiffness, row(0.5, 1, 0, 0, 0));
    add(K, R * ring.circumferential_stiffness, row(0.5, 0, 0, 1, 0));
    // U^2 + V^2 + 2 n U V = (U + n V)^2 + (1 - n^2) V^2
    add(K, -inside, row(0.5, 1, 0, n, 0));
    add(K, -inside * (1 - n * n), row(0.5, 0, 0, 1, 0));
    dealii::Vector<double> eigenvalues;
    std::vector<dealii::Vector<double>> vectors;
    K.compute_generalized_eigenvalues_symmetric(M, 0., 1e30, 0., eigenvalues, vectors);
    SolidModes modes;
    for (unsigned int k = 0; k < eigenvalues.size(); ++k)
    {
      modes.omega.push_back(std::sqrt(eigenvalues(k)));
      modes.mean.push_back(0);
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const std::vector<double> at = row(gauss.point(q)[0], 1, 0, 0, 0);
        for (unsigned int i = 0; i < 2 * m; ++i)
          modes.mean[k] += gauss.weight(q) * at[i] * vectors[k](i);
      }
    }
    return modes;
  }

  std::vector<double> solid_frequencies(const RingParameters &ring, const unsigned int order)
  {
    const SolidModes modes = solid_modes(ring, order);
    return {modes.omega[0], modes.omega[1]};
  }

  Modes modes_of(const SecondOrderSystem &system, const unsigned int count)
  {
    Flexibility flexibility(system);
    ModeParameters parameters;
    parameters.count = count;
    return compute_modes(system, flexibility, parameters);
  }

  /// Largest relative error of the frequencies that make up the first 30 distinct ones.
  double largest_error(const std::vector<double> &found, const std::vector<double> &exact)
  {
    double result = 0;
    unsigned int distinct = 0, k = 0;
    for (; k < found.size() && distinct <= 30; ++k)
    {
      if (k == 0 || exact[k] > exact[k - 1] * (1 + 1e-9))
        ++distinct;
      if (distinct <= 30)
        result = std::max(result, std::abs(found[k] / exact[k] - 1));
    }
    EXPECT_EQ(distinct, 31u) << "too few modes";
    return result;
  }

  std::unique_ptr<SecondOrderSystem> assemble(const RingParameters &ring, const ContactGrid *grid = nullptr)
  {
    return assemble_ring(ring, "tyre", grid, MPI_COMM_WORLD);
  }
} // namespace

TEST(RingElements, BeamFrequencies)
{
  RingParameters ring;
  ring.model = "beam elements";
  for (const char *law : {"follower", "fixed direction"})
  {
    ring.pressure_law = law;
    const Modes modes = modes_of(*assemble(ring), 61);
    const double error = largest_error(modes.omega, beam_frequencies(ring));
    RecordProperty(std::string("error ") + law, std::to_string(error));
    EXPECT_LT(error, 1e-3) << law;
    EXPECT_GT(error, 1e-5) << law;
  }
}

// Cubic elements: the error of a frequency falls with the fourth power of their length.
TEST(RingElements, BeamConverges)
{
  RingParameters ring;
  ring.model = "beam elements";
  std::vector<double> errors;
  for (const unsigned int divisions : {104, 208})
  {
    ring.divisions = divisions;
    errors.push_back(largest_error(modes_of(*assemble(ring), 61).omega, beam_frequencies(ring)));
  }
  EXPECT_GT(errors[0] / errors[1], 14);
}

TEST(RingElements, TurningCostsNothing)
{
  RingParameters ring;
  ring.model = "beam elements";
  ring.circumferential_stiffness = 0;
  const auto system = assemble(ring);
  dealii::PETScWrappers::MPI::Vector turn(system->locally_owned, MPI_COMM_WORLD), force(turn);
  for (unsigned int i = 0; i < ring.divisions; ++i)
  {
    turn(4 * i) = std::cos(2 * pi * i / ring.divisions);
    turn(4 * i + 1) = std::sin(2 * pi * i / ring.divisions);
  }
  turn.compress(dealii::VectorOperation::insert);
  system->stiffness.vmult(force, turn);
  EXPECT_LT(force.linfty_norm(), 1e-12 * system->stiffness.linfty_norm());
}

// The stiffness of elements stops being positive at the pressure at which the ring buckles.
TEST(RingElements, Buckling)
{
  RingParameters ring;
  for (const char *model : {"beam elements", "solid elements"})
    for (const char *law : {"follower", "fixed direction"})
    {
      ring.model = model;
      ring.divisions = ring.model == "beam elements" ? 104 : 52;
      ring.pressure_law = law;
      double pressure = 1e300;
      for (unsigned int n = 0; n < 20; ++n)
        pressure = std::min(pressure, ring.buckling_pressure(n));
      const double band = ring.model == "beam elements" ? 1e-3 : 0.03;
      for (const double share : {1 - band, 1 + band})
      {
        ring.pressure = -share * pressure;
        const auto system = assemble(ring);
        const unsigned int n = system->stiffness.m();
        DenseMatrix K(n);
        for (unsigned int i = 0; i < n; ++i)
          for (auto entry = system->stiffness.begin(i); entry != system->stiffness.end(i); ++entry)
            K(i, entry->column()) = entry->value();
        EXPECT_EQ(factorise_cholesky(K), share < 1) << model << ", " << law;
      }
    }
}

// Reduced by modes and residual responses, beam elements have the analytic ring's Green's functions; forces that do
// not act on nodes, and those along the ring, need more elements.
TEST(RingElements, BeamGreenFunctions)
{
  RingParameters ring;
  ring.model = "beam elements";
  ring.divisions = 200; // every second node a contact point
  ring.spacing = 2 * pi * ring.radius / 100;
  const ContactGrid grid = ring.grid();
  const auto system = assemble(ring, &grid);
  EXPECT_NEAR(system->total_mass, 2 * pi * 0.285 * 3.648, 1e-9);
  Flexibility flexibility(*system);
  ModeParameters parameters;
  parameters.upper_frequency = 8000;
  const ModalReduction modal = reduce_modally(*system, flexibility, parameters, {});
  for (const double ratio : modal.damping_ratio)
    EXPECT_NEAR(ratio, 0.05, 1e-10);
  const BodyInContact elements = by_poles(ring.on_road(
                          combine(reduce_statically(*system, flexibility), &modal), true, 0, {})),
                      exact = ring_poles(ring, ring_rows(ring, true));
  for (const double f : {0., 100., 400., 1000.})
  {
    const ComplexMatrix A = receptance(elements, 2 * pi * f), B = receptance(exact, 2 * pi * f);
    ASSERT_EQ(A.m(), B.m());
    double radial = 0, all = 0;
    for (unsigned int i = 0; i < A.m(); ++i)
      for (unsigned int k = 0; k < A.n(); ++k)
      {
        const double error = std::abs(A(i, k) - B(i, k)) / std::sqrt(std::abs(B(i, i) * B(k, k)));
        all = std::max(all, error);
        if (i < 3 && k < 3)
          radial = std::max(radial, error);
      }
    const std::string at = std::to_string(int(f)) + " Hz";
    RecordProperty("radial error at " + at, std::to_string(radial));
    RecordProperty("error at " + at, std::to_string(all));
    EXPECT_LT(radial, 2e-3) << at;
    EXPECT_LT(all, 0.05) << at;
  }
}

// Static compliance of the contact points on any number of ranks.
TEST(RingElementsMpi, StaticCompliance)
{
  RingParameters ring;
  ring.divisions = 200;
  ring.spacing *= 2; // to nodes
  const ContactGrid grid = ring.grid();
  const ComplexMatrix exact = receptance(ring_poles(ring, ring_rows(ring, true)), 0.);
  for (const char *model : {"beam elements", "solid elements"})
  {
    ring.model = model;
    const auto system = assemble(ring, &grid);
    const DenseMatrix W = Flexibility(*system).contact_compliance();
    const double band = ring.model == "beam elements" ? 1e-3 : 0.03;
    for (unsigned int i = 0; i < 6; ++i)
      for (unsigned int k = 0; k < 6; ++k)
        EXPECT_LT(std::abs(W(i, k) - exact(i, k)), band * std::sqrt(std::abs(exact(i, i) * exact(k, k))))
            << model << " " << i << " " << k;
  }
}

// Against polynomials of degree 9 through the thickness, order by order.
TEST(RingElements, SolidFrequencies)
{
  RingParameters ring;
  ring.model = "solid elements";
  const std::vector<double> exact = sorted([&](const unsigned int n) { return solid_frequencies(ring, n); });
  for (const auto &[divisions, degree] : {std::make_pair(76u, 3u), std::make_pair(48u, 4u)})
  {
    ring.divisions = divisions;
    ring.degree = degree;
    const double error = largest_error(modes_of(*assemble(ring), 61).omega, exact);
    RecordProperty("error degree " + std::to_string(degree), std::to_string(error));
    EXPECT_LT(error, 1e-3) << degree;
  }
}

// Shear and thickness: how far the solid ring is from Euler and Bernoulli's.
TEST(RingElements, SolidIsSofterThanBeam)
{
  RingParameters ring;
  const auto distance = [&](const unsigned int n)
  { return solid_frequencies(ring, n)[0] / ring.frequencies(n).first - 1; };
  EXPECT_NEAR(distance(7), -0.0007, 5e-5);
  EXPECT_NEAR(distance(22), -0.033, 5e-4);
}

// Radial Green's functions of sections by the modes of each order through the thickness.
TEST(RingElements, SolidGreenFunctions)
{
  RingParameters ring;
  ring.model = "solid elements";
  ring.divisions = 100;
  ring.degree = 4;
  ring.spacing = 2 * pi * ring.radius / 100;
  const ContactGrid grid = ring.grid();
  const auto system = assemble(ring, &grid);
  EXPECT_NEAR(system->total_mass / (2 * pi * 0.285 * 3.648), 1, 1e-6);
  Flexibility flexibility(*system);
  ModeParameters parameters;
  parameters.upper_frequency = 2000;
  const ModalReduction modal = reduce_modally(*system, flexibility, parameters, {});
  const BodyInContact elements =
      by_poles(ring.on_road(combine(reduce_statically(*system, flexibility), &modal), true, 0, {}));
  std::vector<SolidModes> orders;
  for (unsigned int n = 0; n <= 300; ++n)
    orders.push_back(solid_modes(ring, n));
  for (const double f : {0., 100., 400.})
  {
    const double omega = 2 * pi * f;
    const ComplexMatrix G = receptance(elements, omega);
    std::array<std::complex<double>, 3> exact{};
    for (unsigned int n = 0; n < orders.size(); ++n)
    {
      const SolidModes &modes = orders[n];
      for (unsigned int k = 0; k < modes.omega.size(); ++k)
      {
        const double w = modes.omega[k];
        // above the modes kept elements answer statically
        const bool is_kept = w < 2 * pi * 2000;
        const std::complex<double> one =
            modes.mean[k] * modes.mean[k] / (n == 0 ? 2 * pi : pi) /
            (is_kept ? std::complex<double>(w * w - omega * omega, 2 * ring.damping_ratio * w * omega)
                     : w * w);
        for (unsigned int i = 0; i < 3; ++i)
          exact[i] += one * std::cos(2 * pi * n * i / 100);
      }
    }
    for (unsigned int i = 0; i < 3; ++i)
    {
      const double error = std::abs(G(0, i) - exact[i]) / std::abs(exact[0]);
      RecordProperty("error of entry " + std::to_string(i) + " at " + std::to_string(int(f)) + " Hz",
                     std::to_string(error));
      EXPECT_LT(error, i == 0 ? 5e-3 : 2e-3) << f << " Hz, " << i;
      EXPECT_LT(std::abs(G(0, i) - G(i, 0)), 1e-9 * std::abs(exact[0]));
    }
    EXPECT_LT(std::abs(G(0, 0) - G(2, 2)), 1e-6 * std::abs(exact[0]));
    EXPECT_LT(std::abs(G(0, 0) - G(1, 1)), 1e-6 * std::abs(exact[0]));
    EXPECT_LT(std::abs(G(1, 4)), 1e-6 * std::abs(exact[0]));
  }
  const ComplexMatrix G = receptance(elements, 0.),
                      beam = receptance(ring_poles(ring, ring_rows(ring, true)), 0.);
  for (unsigned int i = 0; i < 6; ++i)
    for (unsigned int k = 0; k < 6; ++k)
      EXPECT_LT(std::abs(G(i, k) - beam(i, k)), 0.03 * std::sqrt(std::abs(beam(i, i) * beam(k, k))))
          << i << " " << k;
}
