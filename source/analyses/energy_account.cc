#include <vibrocontact/analyses/energy_account.h>

namespace vibrocontact
{
  namespace
  {
    double modal_energy(const ContactPair &pair, const DynamicState &state)
    {
      double energy = 0;
      for (unsigned int k = 0; k < pair.n_modes(); ++k)
        energy += 0.5 * (state.v[k] * state.v[k] + pair.omega[k] * pair.omega[k] * state.q[k] * state.q[k]);
      return energy;
    }
  } // namespace

  double stored_energy(const ContactPair &pair, const NormalLaw &law, const DynamicState &state)
  {
    double energy = modal_energy(pair, state) + 0.5 * (state.R * state.residual_displacement);
    if (!state.contact.empty())
      for (unsigned int i = 0; i < pair.n_points(); ++i)
        energy += law.potential(state.contact.y[i]);
    return energy;
  }

  void add_step(EnergyAccount &account, const ContactPair &pair, const NormalLaw &law,
                const DynamicState &before, const Drive &drive_before, const DynamicState &after,
                const Drive &drive_after)
  {
    const unsigned int n = pair.n_points();
    const double h = after.time - before.time;
    double work = 0, damping = 0, loads = 0;
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
    {
      const double dq = after.q[k] - before.q[k], v = (after.v[k] + before.v[k]) / 2;
      const double force = (before.normal_modal_force[k] + before.tangential_modal_force[k] +
                            after.normal_modal_force[k] + after.tangential_modal_force[k]) /
                           2;
      work += force * dq;
      loads += pair.modal_load[k] * dq;
      damping += 2 * pair.damping_ratio[k] * pair.omega[k] * v * v * h;
    }
    account.loads += loads;
    account.damping += damping;
    account.numerical += work + loads - damping - modal_energy(pair, after) + modal_energy(pair, before);
    account.stored = stored_energy(pair, law, after);

    account.friction += h * (before.friction_power + after.friction_power) / 2;
    account.creepage += h * (before.creepage_power + after.creepage_power) / 2;
    account.transport += h * (before.transport_power + after.transport_power) / 2;
    const double approach = after.contact.approach - before.contact.approach;
    for (unsigned int i = 0; i < n; ++i)
    {
      const double roughness = (drive_after.gap.empty() ? 0 : drive_after.gap[i]) -
                               (drive_before.gap.empty() ? 0 : drive_before.gap[i]);
      account.hub += (before.R[i] + after.R[i]) / 2 * (approach - roughness);
    }
  }
} // namespace vibrocontact
