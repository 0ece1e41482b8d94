#include <vibrocontact/marching/dynamic_state.h>

#include <algorithm>

namespace vibrocontact
{
  namespace
  {
    // of rests that relax: W of each times what it is behind its forces by
    void add_relaxing_displacement(const ContactPair &pair, DynamicState &state)
    {
      for (unsigned int k = 0; k < pair.relaxing.size(); ++k)
      {
        DenseVector behind = state.relaxed[k];
        behind -= forces_on_rest(pair, k, state);
        add_residual_displacement(pair.relaxing[k].flexibility, nullptr, behind, state.residual_displacement);
      }
    }
  } // namespace

  void set_residual_displacement(const ContactPair &pair, DynamicState &state)
  {
    state.residual_displacement.reinit(state.R.size());
    add_residual_displacement(pair.residual, pair.half_spaces.get(), state.R, state.residual_displacement);
    add_relaxing_displacement(pair, state);
  }

  void set_residual_displacement_and_changes(const ContactPair &pair, DynamicState &state)
  {
    for (DenseVector *const displacement :
         {&state.residual_displacement, &state.residual_change, &state.residual_change_before})
      displacement->reinit(state.R.size());
    add_residual_displacements(
        pair.residual, pair.half_spaces.get(), {&state.R, &state.force_change, &state.force_change_before},
        {&state.residual_displacement, &state.residual_change, &state.residual_change_before});
    add_relaxing_displacement(pair, state);
  }

  void set_powers(const DenseVector &R, const DenseVector &slip, const DenseVector &rigid_slip,
                  const unsigned int n, const double rate, DynamicState &state)
  {
    state.friction_power = state.creepage_power = 0;
    for (unsigned int i = n; i < 3 * n; ++i)
    {
      state.friction_power -= R[i] * slip[i];
      state.creepage_power -= R[i] * rigid_slip[i];
    }
    state.transport_power = state.friction_power - state.creepage_power + rate;
  }

  DenseVector forces_on_rest(const ContactPair &pair, const unsigned int k, const DynamicState &state)
  {
    DenseVector forces = state.R;
    if (pair.relaxing[k].body == 1)
      forces[0] += state.force;
    return forces;
  }

  void complete(const ContactPair &pair, const DenseVector &rigid_slip, DynamicState &state)
  {
    const unsigned int n = pair.n_points(), n_modes = pair.n_modes();
    for (unsigned int k = state.relaxed.size(); k < pair.relaxing.size(); ++k)
      state.relaxed.push_back(forces_on_rest(pair, k, state));
    set_residual_displacement(pair, state);
    state.residual_rate.reinit(3 * n);
    state.force_change.reinit(3 * n);
    state.residual_change.reinit(3 * n);
    state.force_change_before.reinit(3 * n);
    state.residual_change_before.reinit(3 * n);
    state.modal_force.reinit(n_modes);
    state.pole_force.assign(pair.n_poles(), 0.);
    state.pole_reaction.assign(pair.n_poles(), 0.);
    for (unsigned int k = 0; k < pair.n_poles(); ++k)
      for (unsigned int i = 0; i < 3 * n; ++i)
      {
        state.pole_force[k] += pair.left(i, k) * state.R[i];
        state.pole_reaction[k] += pair.right(i, k) * state.R[i];
      }
    DenseVector tangential(n_modes), forces(state.R);
    if (n_modes > 0)
    {
      pair.trace.Tvmult(state.modal_force, forces);
      std::fill(forces.begin(), forces.begin() + n, 0.);
      pair.trace.Tvmult(tangential, forces);
    }
    double rate = 0;
    for (unsigned int k = 0; k < n_modes; ++k)
      rate += tangential[k] * state.v[k];
    if (!state.contact.empty())
      set_powers(state.R, state.contact.y, rigid_slip, n, rate, state);
  }
} // namespace vibrocontact
