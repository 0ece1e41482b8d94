// A wheel that turns past its contact, in the modes of the same wheel at rest: axes that stand still against axes that turn,
// the power of a force that stands still, solid elements in axes that stand still.
#include "pi.h"

#include <vibrocontact/base/log.h>
#include <vibrocontact/reduction/revolved_reduction.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

using namespace vibrocontact;

namespace
{
  using Complex = std::complex<double>;
  /// A soft disc, held at its bore, touched off its middle on a piece of the rim.
  constexpr double bore = 0.04, rim = 0.1, width = 0.01, Omega = 20 / rim;
  constexpr unsigned int n_around = 12, degree = 4;
  ElasticMaterial soft()
  {
    ElasticMaterial material;
    material.young_modulus = 1e9;
    material.poisson_ratio = 0.3;
    material.density = 1000;
    return material;
  }

  struct Disc
  {
    ReducedBody at_rest;
    FlowReduction flow;
  };

  /// @param points along the rolling line, spacing of them [m] @param mass_damping alpha of C = alpha M [1/s]
  Disc disc(const unsigned int points, const double spacing, const double mass_damping)
  {
    run_log().set_screen(false);
    const auto section = std::make_shared<dealii::Triangulation<2>>();
    dealii::GridGenerator::subdivided_hyper_rectangle(*section, {1u, 1u}, {-width / 2, bore},
                                                      {width / 2, rim}, true);
    ElasticModel<3> model;
    model.material = soft();
    model.held = {2};
    RevolvedReduction::Contact contact;
    ContactGrid &grid = contact.grid;
    grid.n_x = points;
    grid.n_y = 1;
    grid.spacing_x = spacing;
    grid.x_first = -0.5 * (points - 1) * spacing;
    grid.spacing_y = width / 2;
    grid.y_first = width / 4;
    contact.tread = 3;
    contact.material = {soft().young_modulus, soft().poisson_ratio};
    contact.n_harmonics = 24;
    contact.surface_height.assign(points, 0.);
    const RevolvedReduction waves(std::make_unique<RevolvedSection>("disc", section, model, degree), "disc",
                                  rim, 0., contact, MPI_COMM_SELF);
    ModeParameters parameters;
    parameters.upper_frequency = 8000;
    Disc result;
    SurfaceShapes shapes;
    RevolvedShapes on_section;
    const ModalReduction modes = waves.modes(parameters, {rim, 0.08}, shapes, on_section, &result.flow);
    result.at_rest = combine(waves.statics(), &modes);
    for (unsigned int k = 0; k < modes.omega.size(); ++k)
      result.at_rest.damping_ratio[k] = mass_damping / (2 * modes.omega[k]);
    return result;
  }

  /// The same disc by hexahedra, axle along z, flow towards growing phi:
  ///
  ///   M u'' + (2 Omega G + alpha M) u' + (K + Omega^2 (K_g - C) + alpha Omega (G - R)) u = f,     R = int rho N_i . (e_z x N_j)
  class SolidDisc
  {
  public:
    explicit SolidDisc(const double mass_damping);
    /// The eigenvalue next to a value near to it, with a dashpot c on the patch and mu times its force across.
    Complex eigenvalue(Complex near, double c, double mu) const;

  private:
    bool is_held(const unsigned int node) const
    {
      return std::hypot(places[node][0], places[node][1]) < 1.001 * bore;
    }
    void set(dealii::SparseMatrix<double> &matrix, unsigned int i, unsigned int j, double value) const
    {
      if (value != 0 && !is_held(i / 3) && !is_held(j / 3))
        matrix.add(i, j, value);
    }

    dealii::Triangulation<3> triangulation;
    const dealii::FE_Q<3> element{degree};
    const dealii::MappingQ<3> mapping{degree};
    dealii::DoFHandler<3> dof_handler;
    dealii::SparsityPattern pattern;
    dealii::SparseMatrix<double> of_square, of_lambda, constant;
    std::vector<dealii::Point<3>> places;
    /// mean motion of the patch upwards and across
    std::map<unsigned int, double> up, across;
  };

  SolidDisc::SolidDisc(const double mass_damping)
  {
    using namespace dealii;
    GridGenerator::cylinder_shell(triangulation, width, bore, rim, n_around, 1);
    dof_handler.reinit(triangulation);
    dof_handler.distribute_dofs(element);
    const unsigned int n_nodes = dof_handler.n_dofs(), n_local = element.n_dofs_per_cell();
    places.resize(n_nodes);
    DoFTools::map_dofs_to_support_points(mapping, dof_handler, places);
    DynamicSparsityPattern nodes(n_nodes), all(3 * n_nodes);
    DoFTools::make_sparsity_pattern(dof_handler, nodes);
    for (const auto &entry : nodes)
      for (unsigned int c = 0; c < 9; ++c)
        all.add(3 * entry.row() + c % 3, 3 * entry.column() + c / 3);
    pattern.copy_from(all);
    SparseMatrix<double> stiffness(pattern);
    for (auto *const matrix : {&of_square, &of_lambda, &constant})
      matrix->reinit(pattern);

    const ElasticMaterial material = soft();
    const double lambda = material.lambda(), mu = material.mu(), rho = material.density;
    FEValues<3> values(mapping, element, QGauss<3>(degree + 1),
                       update_values | update_gradients | update_JxW_values | update_quadrature_points);
    std::vector<types::global_dof_index> dofs(n_local);
    std::vector<double> theta(n_local);
    Vector<double> force(3 * n_nodes), stretched(3 * n_nodes);
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      cell->get_dof_indices(dofs);
      FullMatrix<double> M(n_local, n_local), G(n_local, n_local), C(n_local, n_local),
          K(3 * n_local, 3 * n_local);
      for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
      {
        const Point<3> &p = values.quadrature_point(q);
        for (unsigned int a = 0; a < n_local; ++a)
          theta[a] = p[0] * values.shape_grad(a, q)[1] - p[1] * values.shape_grad(a, q)[0];
        const double dV = values.JxW(q);
        for (unsigned int a = 0; a < n_local; ++a)
        {
          const double N = values.shape_value(a, q);
          for (unsigned int c = 0; c < 2; ++c)
            if (!is_held(dofs[a]))
              force(3 * dofs[a] + c) += rho * N * p[c] * dV;
          const Tensor<1, 3> u = values.shape_grad(a, q);
          for (unsigned int b = 0; b < n_local; ++b)
          {
            const Tensor<1, 3> v = values.shape_grad(b, q);
            M(a, b) += rho * N * values.shape_value(b, q) * dV;
            G(a, b) += rho * N * theta[b] * dV;
            C(a, b) += rho * theta[a] * theta[b] * dV;
            for (unsigned int c = 0; c < 3; ++c)
              for (unsigned int d = 0; d < 3; ++d)
                K(3 * a + c, 3 * b + d) +=
                    (lambda * u[c] * v[d] + mu * u[d] * v[c] + (c == d ? mu * (u * v) : 0.)) * dV;
          }
        }
      }
      for (unsigned int a = 0; a < n_local; ++a)
        for (unsigned int b = 0; b < n_local; ++b)
        {
          const unsigned int i = 3 * dofs[a], j = 3 * dofs[b];
          for (unsigned int c = 0; c < 3; ++c)
          {
            for (unsigned int d = 0; d < 3; ++d)
              set(stiffness, i + c, j + d, K(3 * a + c, 3 * b + d));
            set(of_square, i + c, j + c, M(a, b));
            set(of_lambda, i + c, j + c, 2 * Omega * G(a, b) + mass_damping * M(a, b));
            set(constant, i + c, j + c, mass_damping * Omega * G(a, b) - Omega * Omega * C(a, b));
          }
          // e_z x u = (-u_y, u_x, 0)
          set(constant, i, j + 1, mass_damping * Omega * M(a, b));
          set(constant, i + 1, j, -mass_damping * Omega * M(a, b));
        }
    }
    for (unsigned int i = 0; i < 3 * n_nodes; ++i)
      if (is_held(i / 3))
        stiffness.set(i, i, 1.);
    constant.add(1., stiffness);
    stretched = force;
    SparseDirectUMFPACK inverse;
    inverse.initialize(stiffness);
    inverse.solve(stretched);
    stretched *= Omega * Omega;
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      values.reinit(cell);
      cell->get_dof_indices(dofs);
      FullMatrix<double> K_g(n_local, n_local);
      for (unsigned int q = 0; q < values.n_quadrature_points; ++q)
      {
        Tensor<2, 3> gradient;
        for (unsigned int a = 0; a < n_local; ++a)
          for (unsigned int c = 0; c < 3; ++c)
            gradient[c] += stretched(3 * dofs[a] + c) * values.shape_grad(a, q);
        Tensor<2, 3> stress = mu * (gradient + transpose(gradient));
        for (unsigned int c = 0; c < 3; ++c)
          stress[c][c] += lambda * trace(gradient);
        for (unsigned int b = 0; b < n_local; ++b)
        {
          const Tensor<1, 3> pulled = stress * values.shape_grad(b, q);
          for (unsigned int a = 0; a < n_local; ++a)
            K_g(a, b) += pulled * values.shape_grad(a, q) * values.JxW(q);
        }
      }
      for (unsigned int a = 0; a < n_local; ++a)
        for (unsigned int b = 0; b < n_local; ++b)
          for (unsigned int c = 0; c < 3; ++c)
            set(constant, 3 * dofs[a] + c, 3 * dofs[b] + c, K_g(a, b));
    }

    // the patch: the rim of one cell, of half its width; y of the wheel is -z here
    const auto first = dof_handler.begin_active();
    const Point<3> centre = first->center();
    const double radius = std::hypot(centre[0], centre[1]);
    first->get_dof_indices(dofs);
    double area = 0;
    for (const unsigned int f : first->face_indices())
    {
      const Point<3> middle = first->face(f)->center();
      if (!first->face(f)->at_boundary() || std::hypot(middle[0], middle[1]) < radius * 1.1)
        continue;
      FEFaceValues<3> rows(mapping, element, QIterated<2>(QGauss<1>(8), 2),
                           update_values | update_JxW_values | update_quadrature_points);
      rows.reinit(first, f);
      for (unsigned int q = 0; q < rows.n_quadrature_points; ++q)
      {
        if (rows.quadrature_point(q)[2] > width / 2)
          continue;
        area += rows.JxW(q);
        for (unsigned int a = 0; a < n_local; ++a)
        {
          const double share = rows.shape_value(a, q) * rows.JxW(q);
          if (std::abs(share) < 1e-16)
            continue;
          up[3 * dofs[a]] -= share * centre[0] / radius;
          up[3 * dofs[a] + 1] -= share * centre[1] / radius;
          across[3 * dofs[a] + 2] -= share;
        }
      }
    }
    for (auto *const row : {&up, &across})
      for (auto &entry : *row)
        entry.second /= area;
  }

  Complex SolidDisc::eigenvalue(const Complex near, const double c, const double mu) const
  {
    using namespace dealii;
    const unsigned int n = of_square.m();
    SparseMatrix<double> of_rate(pattern);
    of_rate.copy_from(of_lambda);
    for (const auto &force : {std::make_pair(&up, 1.), std::make_pair(&across, mu)})
      for (const auto &[i, there] : *force.first)
        for (const auto &[j, here] : up)
          of_rate.add(i, j, c * force.second * there * here);
    Vector<Complex> x(n);
    for (unsigned int i = 0; i < n; ++i)
      x(i) = is_held(i / 3) ? 0. : Complex(std::sin(1. + i), std::cos(2. * i));
    SparseMatrix<Complex> P(pattern);
    auto entry = P.begin();
    for (auto at_square = std::as_const(of_square).begin(), at_rate = std::as_const(of_rate).begin(),
              at_constant = std::as_const(constant).begin();
         at_square != std::as_const(of_square).end(); ++at_square, ++at_rate, ++at_constant, ++entry)
      entry->value() = near * near * at_square->value() + near * at_rate->value() + at_constant->value();
    SparseDirectUMFPACK inverse;
    inverse.factorize(P);
    // P(near) x = (near - lambda) P'(near) x up to the square of the difference
    Complex change = 0;
    for (unsigned int pass = 0; pass < 6; ++pass)
    {
      Vector<Complex> y(n), product(n);
      of_square.vmult(y, x);
      y *= 2. * near;
      of_rate.vmult(product, x);
      y += product;
      inverse.solve(y);
      change = -(x * x) / (y * x);
      x = y;
      x /= Complex(x.l2_norm());
    }
    EXPECT_LT(std::abs(change), 1e-3 * std::abs(near)) << "no eigenvalue is near";
    return near + change;
  }

  /// Upward motion of the point under a force 1 upwards and mu across, and its derivative.
  std::pair<Complex, Complex> motion(const BodyInContact &body, const Complex s, const double mu)
  {
    Complex u = body.residual(0, 0) + mu * body.residual(0, 2), rate = 0;
    for (unsigned int k = 0; k < body.n_poles(); ++k)
    {
      const Complex residue = body.right(0, k) * (body.left(0, k) + mu * body.left(2, k));
      for (const auto &[r, pole] : {std::make_pair(residue, body.poles[k]),
                                    std::make_pair(std::conj(residue), std::conj(body.poles[k]))})
      {
        u += r / (s - pole);
        rate -= r / ((s - pole) * (s - pole));
      }
    }
    return {u, rate};
  }

  /// Root of 1 + c s u(s) that a pole becomes.
  Complex root(const BodyInContact &body, const unsigned int pole, const double c, const double mu)
  {
    constexpr unsigned int steps = 20;
    Complex s = body.poles[pole];
    for (unsigned int step = 1; step <= steps; ++step)
    {
      const double part = c * step / steps;
      if (step == 1)
        s -= part * s * body.right(0, pole) * (body.left(0, pole) + mu * body.left(2, pole));
      for (unsigned int pass = 0; pass < 20; ++pass)
      {
        const auto [u, rate] = motion(body, s, mu);
        // 1 / u is linear near a pole
        s -= (1. / u + part * s) / (part - rate / (u * u));
      }
    }
    return s;
  }
} // namespace

// A frequency in axes that stand still is that in axes that turn plus n Omega. There all of n (both families) obey
// w^2 - 2 Omega (G - n) w - (diag(omega^2) + Omega^2 (S - n^2 + 2 n G)) = 0.
TEST(RollingWheel, TwoFrames)
{
  const Disc wheel = disc(1, 0.01, 0);
  const BodyInContact rolling = rolling_modes(wheel.at_rest, wheel.flow, Omega);
  const FlowReduction &flow = wheel.flow;
  EXPECT_EQ(rolling.n_poles(), flow.omega.size());
  std::vector<double> found, expected;
  for (const Complex &pole : rolling.poles)
  {
    found.push_back(pole.imag());
    EXPECT_LT(std::abs(pole.real()), 1e-10 * std::abs(pole));
  }
  std::map<unsigned int, std::vector<unsigned int>> even;
  for (unsigned int k = 0; k < flow.omega.size(); ++k)
  {
    bool is_odd = false;
    for (unsigned int l = 0; l < k; ++l)
      is_odd = is_odd || flow.turning(k, l) != 0;
    const double n = k + 1 < flow.omega.size() ? flow.turning(k, k + 1) : 0;
    if (!is_odd && n > 0)
      even[n].push_back(k);
  }
  EXPECT_GT(even.size(), 4u);
  for (const auto &[n, modes] : even)
  {
    const unsigned int m = modes.size();
    const double s = flow.omega.back();
    dealii::LAPACKFullMatrix<double> companion(2 * m, 2 * m);
    for (unsigned int i = 0; i < m; ++i)
    {
      companion(i, m + i) = 1;
      for (unsigned int j = 0; j < m; ++j)
      {
        const double G = flow.fixed(modes[i], modes[j] + 1), unit = i == j;
        companion(m + i, j) =
            (unit * std::pow(flow.omega[modes[i]], 2) +
             Omega * Omega * (flow.of_square(modes[i], modes[j]) - unit * n * n + 2 * n * G)) /
            (s * s);
        companion(m + i, m + j) = 2 * Omega * (G - unit * n) / s;
      }
    }
    companion.compute_eigenvalues();
    for (unsigned int k = 0; k < 2 * m; ++k)
    {
      EXPECT_LT(std::abs(companion.eigenvalue(k).imag()), 1e-9);
      expected.push_back(std::abs(s * companion.eigenvalue(k).real() + n * Omega));
    }
  }
  std::sort(expected.begin(), expected.end());
  for (const double frequency : expected)
  {
    const auto nearest = std::min_element(found.begin(), found.end(),
                                          [&](const double a, const double b)
                                          { return std::abs(a - frequency) < std::abs(b - frequency); });
    EXPECT_NEAR(*nearest, frequency, 1e-10 * flow.omega.back());
    found.erase(nearest);
  }
  // what is left does not run around the axle
  EXPECT_LT(found.size(), 8u);
  // a wave with the rotation is the faster one of two
  const auto pole_of = [&](const std::string &label)
  {
    const auto at = std::find(rolling.labels.begin(), rolling.labels.end(), label);
    return at == rolling.labels.end() ? 0. : rolling.poles[at - rolling.labels.begin()].imag();
  };
  for (const std::string name : {"axial(0,2)", "axial(0,3)"})
  {
    const double backward = pole_of(name + " backward"), forward = pole_of(name + " forward");
    EXPECT_GT(backward, 0) << name;
    EXPECT_GT(forward, backward + 2 * Omega) << name;
  }
}

// A force across that stands still is carried by the material that passes, which loses sum 2 zeta w (n Omega q)^2. It does the
// work F Omega du/dtheta, u its own displacement.
TEST(RollingWheel, PowerOfAForceThatStands)
{
  const double h = 1e-4, alpha = 300, F = 1;
  const Disc wheel = disc(3, h, alpha);
  const BodyInContact rolling = rolling_modes(wheel.at_rest, wheel.flow, Omega);
  const unsigned int across = 2 * 3 + 1, m = wheel.flow.omega.size();
  const DenseMatrix u = sum_over_poles(rolling, static_weights(rolling));
  const double stretch = (u(across + 1, across) - u(across - 1, across)) / (2 * h),
               power = F * rim * Omega * stretch * F;
  // the modes under the force, from the equations themselves
  DenseMatrix K(m);
  DenseVector q(m);
  for (unsigned int i = 0; i < m; ++i)
  {
    q(i) = F * wheel.at_rest.trace(across, i);
    for (unsigned int j = 0; j < m; ++j)
      K(i, j) = (i == j ? std::pow(wheel.flow.omega[i], 2) : 0.) +
                Omega * Omega * wheel.flow.of_square(i, j) + alpha * Omega * wheel.flow.turning(i, j);
  }
  K.compute_lu_factorization();
  K.solve(q);
  double lost = 0;
  for (unsigned int i = 0; i < m; ++i)
  {
    double flow = 0;
    for (unsigned int j = 0; j < m; ++j)
      flow += Omega * wheel.flow.turning(i, j) * q(j);
    lost += alpha * flow * flow;
  }
  EXPECT_GT(lost, 0);
  EXPECT_NEAR(power, lost, 1e-4 * lost);
}

// Solid elements in axes that stand still, assembled here, with damping and a contact with friction.
TEST(RollingWheel, SolidElements)
{
  const double alpha = 60, c = 1e3, mu = 0.6;
  const Disc wheel = disc(1, 2 * rim * std::sin(pi / n_around), alpha);
  const BodyInContact rolling = rolling_modes(wheel.at_rest, wheel.flow, Omega);
  const SolidDisc solid(alpha);
  for (const std::string label :
       {"axial(0,2) backward", "axial(0,2) forward", "axial(0,3) backward", "axial(0,3) forward"})
  {
    const auto at = std::find(rolling.labels.begin(), rolling.labels.end(), label);
    ASSERT_TRUE(at != rolling.labels.end()) << label;
    const unsigned int pole = at - rolling.labels.begin();
    const Complex here = root(rolling, pole, c, mu), there = solid.eigenvalue(here, c, mu);
    EXPECT_NEAR(here.imag(), there.imag(), 1e-4 * there.imag()) << label;
    EXPECT_NEAR(here.real(), there.real(), 0.02 * std::abs(there.real())) << label;
    // the contact and its friction matter
    EXPECT_GT(std::abs(here - rolling.poles[pole]), 0.1 * std::abs(here.real())) << label;
    EXPECT_GT(std::abs(here - root(rolling, pole, c, 0)), 0.04 * std::abs(here.real())) << label;
  }
}
