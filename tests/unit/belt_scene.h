#pragma once

#include "scratch_folder.h"

#include <vibrocontact/analyses/limit_cycle/limit_cycle.h>
#include <vibrocontact/marching/initial_state.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <string>

namespace vibrocontact
{
  /// 1 kg on a spring and a damper, held down by a constant force, rubs on a belt.
  struct BeltScene
  {
    ContactPair pair;
    Drive drive;
    ContactSections contact;
    TransientParameters transient;
    ContactSolverParameters solver = solver_of_cycles({});
    DynamicState at_rest;
    StabilityRoot root;
    /// decay rate by the damper [1/s]
    double of_damping;

    /// @param friction over the slip speed, at speeds `spacing` apart from 0 on
    BeltScene(const double omega, const double zeta, const double flexibility, const double force,
              const double belt, const std::function<double(double)> &friction, const double spacing,
              const unsigned int n_speeds)
    {
      ContactGrid &grid = pair.interface.contacts.only();
      grid.n_x = grid.n_y = 1;
      grid.spacing_x = grid.spacing_y = 1e-3;
      pair.interface.gap = {0};
      pair.trace.reinit(3, 1);
      pair.trace(1, 0) = 1;
      pair.participation.reinit(1, 3);
      pair.omega = {omega};
      pair.damping_ratio = {zeta};
      pair.labels = {"mass:0"};
      pair.body = {1};
      pair.modal_load = {0};
      // the approach is given and nothing but this yields in normal direction: the normal force is constant
      pair.residual.reinit(3, 3);
      for (unsigned int c = 0; c < 3; ++c)
        pair.residual(c, c) = flexibility;
      drive.approach = force * flexibility;
      contact.first().friction_law = "friction curve";
      const std::string curve = scratch_folder() + "/curve.csv";
      std::ofstream stream(curve);
      stream.precision(17);
      stream << "slip_speed_m_s, friction\n";
      for (unsigned int k = 0; k < n_speeds; ++k)
        stream << k * spacing << ", " << friction(k * spacing) << "\n";
      stream.close();
      contact.first().law_values.set("Friction curve", curve);
      contact.first().read_curves("");
      transient.integrator = "exact propagator";
      of_damping = zeta * omega;
      run_at(belt, (friction(belt + spacing) - friction(belt - spacing)) / (2 * spacing));
    }

    /// @param slope of the friction over the slip speed
    void run_at(const double belt, const double slope)
    {
      drive.creepage.sliding_x = belt;
      at_rest = initial_state(transient, contact, solver, pair, drive);
      const double omega = pair.omega[0];
      root.growth = -drive.approach / pair.residual(0, 0) * slope / 2 - of_damping;
      root.frequency = std::sqrt(omega * omega - root.growth * root.growth) / (2 * dealii::numbers::PI);
      root.shape = {1.};
    }

    CycleMap map(const unsigned int n_steps) const
    {
      return {transient, contact, solver, pair, drive, drive.approach, {0}, n_steps};
    }

    LimitCycle cycle(CycleMap &map) const
    {
      LimitCycleParameters parameters;
      parameters.tolerance = 1e-8;
      return find_limit_cycle(map, pair, at_rest, root, parameters);
    }
  };
} // namespace vibrocontact
