// Twisted blade: its geometry, thin plates of the literature, and its tip on a rigid casing against integration in time.

#include "time_stepping.h"

#include <vibrocontact/analyses/periodic/periodic_motion.h>
#include <vibrocontact/contact/laws/normal_laws.h>
#include <vibrocontact/fe/assemble_body.h>
#include <vibrocontact/fe/elastic_body.h>
#include <vibrocontact/fe/nearest_dof.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/modes.h>
#include <vibrocontact/reduction/point_reduction.h>
#include <vibrocontact/scene/blade.h>

#include <deal.II/base/numbers.h>
#include <deal.II/grid/grid_tools.h>

#include <gtest/gtest.h>

using namespace vibrocontact;
using dealii::numbers::PI;

namespace
{
  constexpr double damping = 0.002;

  BladeParameters coarse(const double tip_angle)
  {
    BladeParameters parameters;
    parameters.tip_angle = tip_angle;
    parameters.length_divisions = 8;
    parameters.chord_divisions = 4;
    parameters.element_degree = 2;
    return parameters;
  }

  struct Blade
  {
    Blade(const BladeParameters &parameters, const ElasticMaterial &material, const unsigned int n_modes,
          const MPI_Comm communicator)
        : parameters(parameters)
    {
      BodyMesh<3> mesh = make_blade(parameters, "blade", communicator);
      ElasticModel<3> model;
      model.material = material;
      model.held = {mesh.boundary_id("root")};
      elastic = std::make_unique<ElasticBody<3>>(std::move(mesh), model, parameters.element_degree);
      system = assemble_body(*elastic);
      flexibility = std::make_unique<Flexibility>(*system);
      ModeParameters asked;
      asked.count = n_modes;
      modes = compute_modes(*system, *flexibility, asked);
    }

    /// f L^2 sqrt(rho h / D) 2 pi, D the plate's bending stiffness
    double plate_number(const unsigned int mode, const ElasticMaterial &material) const
    {
      const double h = parameters.thickness, nu = material.poisson_ratio,
                   D = material.young_modulus * h * h * h / (12 * (1 - nu * nu));
      return modes.omega[mode] * parameters.length * parameters.length * std::sqrt(material.density * h / D);
    }

    /// A corner of the tip, by the signs along chord and thickness.
    dealii::Point<3> corner(const int a, const int b) const
    {
      const double angle = parameters.tip_angle * PI / 180, x = a * parameters.chord / 2,
                   y = b * parameters.thickness / 2;
      return {x * std::cos(angle) - y * std::sin(angle), x * std::sin(angle) + y * std::cos(angle),
              parameters.length};
    }

    /// Under a force along the tip's normal at mid-chord, before a stop above one or all corners.
    ForcedBody before_casing(const unsigned int n_corners, const bool friction) const
    {
      std::vector<TraceRow> rows;
      const int signs[4][2] = {{1, 1}, {1, -1}, {-1, 1}, {-1, -1}};
      for (unsigned int k = 0; k < n_corners; ++k)
        for (unsigned int a = 0; a < (friction ? 3u : 1u); ++a)
          rows.push_back(nearest_dof(*system, corner(signs[k][0], signs[k][1]), (2 + a) % 3, "corner"));
      const double angle = parameters.tip_angle * PI / 180;
      TraceRow force = nearest_dof(*system, {0, 0, parameters.length}, 0, "force");
      force[0].second = -std::sin(angle);
      const TraceRow y = nearest_dof(*system, {0, 0, parameters.length}, 1, "force");
      force.emplace_back(y[0].first, std::cos(angle));
      rows.push_back(force);
      ForcedBody body{reduce_to_points(*system, *flexibility, modes,
                                       std::vector<double>(modes.omega.size(), damping), rows)};
      body.force_row = rows.size() - 1;
      body.rows_per_point = friction ? 3 : 1;
      body.gap.assign(n_corners, 0.);
      return body;
    }

    BladeParameters parameters;
    std::unique_ptr<ElasticBody<3>> elastic;
    std::unique_ptr<SecondOrderSystem> system;
    std::unique_ptr<Flexibility> flexibility;
    Modes modes;
  };

  ElasticMaterial titanium()
  {
    ElasticMaterial material;
    material.young_modulus = 114e9;
    material.poisson_ratio = 0.33;
    material.density = 4430;
    return material;
  }
} // namespace

// A turn of every section keeps the volume.
TEST(BladeMpi, TwistKeepsTheVolume)
{
  const Blade blade(coarse(40), titanium(), 1, MPI_COMM_WORLD);
  EXPECT_NEAR(dealii::GridTools::volume(*blade.elastic->mesh.triangulation, blade.elastic->mapping) /
                  (0.2 * 0.08 * 0.006),
              1, 1e-6);
  double farthest = 0;
  for (const int a : {-1, 1})
    for (const int b : {-1, 1})
      for (unsigned int d = 0; d < 3; ++d)
      {
        const TraceRow row = nearest_dof(*blade.system, blade.corner(a, b), d, "corner");
        if (blade.system->locally_owned.is_element(row[0].first))
          farthest = std::max(
              farthest,
              blade.system->dof_position[blade.system->locally_owned.index_within_set(row[0].first)].distance(
                  blade.corner(a, b)));
      }
  EXPECT_LT(farthest, 1e-12);
}

// Square cantilever plate, nu = 0.3: w L^2 sqrt(rho h / D) of the thin plate, converged Ritz values (Bardell 1991; those of
// Leissa 1973 are up to 0.6 % higher).
TEST(Blade, WithoutTwistIsAPlate)
{
  ElasticMaterial material = titanium();
  material.poisson_ratio = 0.3;
  BladeParameters square = coarse(0);
  square.chord = square.length;
  square.chord_divisions = 8;
  square.thickness = 0.002;
  square.element_degree = 3;
  const Blade blade(square, material, 5, MPI_COMM_SELF);
  const double thin[] = {3.4711, 8.5067, 21.285, 27.199, 30.956};
  for (unsigned int k = 0; k < 5; ++k)
    EXPECT_NEAR(blade.plate_number(k, material) / thin[k], 1, 0.003) << blade.plate_number(k, material);
}

// Exact law at one and at four corners, without friction and with Coulomb's: balance against many steps in time.
TEST(Blade, RubsItsCasingAsInTime)
{
  const Blade blade(coarse(40), titanium(), 8, MPI_COMM_SELF);
  const unsigned int n_steps = 2048;
  for (const unsigned int n_corners : {1u, 4u})
    for (const double mu : {0., 0.3})
    {
      SCOPED_TRACE(std::to_string(n_corners) + " corners, friction " + std::to_string(mu));
      ForcedBody body = blade.before_casing(n_corners, mu > 0);
      const HarmonicForce force{20., body.omega[0] / (2 * PI)};
      BalanceSettings settings;
      settings.n_functions = mu > 0 ? 101 : 81;
      settings.n_samples = mu > 0 ? 4096 : 1024;
      settings.friction = mu;
      double peak = 0;
      {
        ForcedBody free = body;
        free.gap.assign(n_corners, 1.);
        PeriodicBalance balance(free, create_normal_law("signorini"), settings);
        balance.set_force(force);
        peak = sample_motion(balance, balance.solve(), n_steps).tip_max;
      }
      body.gap.assign(n_corners, peak / 2);
      PeriodicBalance balance(body, create_normal_law("signorini"), settings);
      balance.set_force(force);
      const PeriodicSolution solution = balance.solve();
      ASSERT_TRUE(solution.converged);
      const PeriodicMotion motion = sample_motion(balance, solution, n_steps);
      TimeStepping stepping(body, mu, force, n_steps);
      stepping.start(balance, solution);
      for (unsigned int period = 0; period < 40; ++period)
        stepping.advance();
      for (unsigned int p = 0; p < n_corners; ++p)
      {
        const double error = relative_error(motion.points[p].displacement, stepping.displacement(p));
        std::printf("%u corners, mu %g, corner %u: peak %g, error %.3g, %u iterations, %u gap steps\n",
                    n_corners, mu, p, peak, error, solution.iterations, solution.homotopy_steps);
        EXPECT_LT(error, mu > 0 ? 2e-3 : 5e-4);
      }
    }
}
