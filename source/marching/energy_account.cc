#include <vibrocontact/marching/energy_account.h>

#include <algorithm>
#include <cmath>

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

    /// What poles store nobody knows: there was what they have taken at least, and more than what rounding leaves of the
    /// work of the forces on them.
    double least_energy_of_poles(const ContactPair &pair, const DynamicState &state, const double taken)
    {
      constexpr double rounding = 1e-10;
      double work = 0;
      for (unsigned int k = 0; k < pair.n_poles(); ++k)
        work += 2 * std::abs(state.pole_reaction[k] * state.z[k]);
      return pair.n_poles() > 0 ? std::max(std::abs(taken), rounding * work) : 0;
    }
  } // namespace

  namespace
  {
    /// W s of rest k at the rows of its body
    DenseVector displacement_of_rest(const ContactPair &pair, const unsigned int k, const DenseVector &s)
    {
      const DenseMatrix &W = pair.relaxing[k].flexibility;
      DenseVector result(s.size());
      for (unsigned int j = 0; j < s.size(); ++j)
        for (unsigned int i = 0; i < s.size() && s[j] != 0; ++i)
          result[i] += W(i, j) * s[j];
      return result;
    }

    /// What rests that relax store in place of the energy under the forces at once, R^T W~ R / 2.
    double energy_of_relaxing(const ContactPair &pair, const DynamicState &state)
    {
      double energy = 0;
      for (unsigned int k = 0; k < pair.relaxing.size(); ++k)
      {
        const DenseVector &s = state.relaxed[k], forces = forces_on_rest(pair, k, state);
        DenseVector behind = s, sum = s;
        behind -= forces;
        sum += forces;
        // s W s - f W f, less what the residual displacements, W (s - f) among them, have as R W (s - f)
        sum -= state.R;
        energy += 0.5 * (sum * displacement_of_rest(pair, k, behind));
      }
      return energy;
    }

    /// What rests that relax take from the forces on them over a step.
    void add_relaxing(EnergyAccount &account, const ContactPair &pair, const DynamicState &before,
                      const DynamicState &after)
    {
      const double h = after.time - before.time, mean_given = (before.force + after.force) / 2;
      for (unsigned int k = 0; k < pair.relaxing.size(); ++k)
      {
        DenseVector ds = after.relaxed[k], mean_s = after.relaxed[k], df = forces_on_rest(pair, k, after),
                    mean_f = df;
        ds -= before.relaxed[k];
        mean_s.sadd(0.5, 0.5, before.relaxed[k]);
        const DenseVector forces_before = forces_on_rest(pair, k, before);
        df -= forces_before;
        mean_f.sadd(0.5, 0.5, forces_before);
        const DenseVector moved = displacement_of_rest(pair, k, ds);
        const double lost = pair.relaxing[k].relaxation / h * (ds * moved);
        account.damping += lost;
        account.numerical_rate += mean_f * moved - mean_s * moved - lost;
        // the given force's own share, that the force at once has been taken for
        if (mean_given != 0 && pair.relaxing[k].body == 1)
          account.loads += mean_given * (moved[0] - displacement_of_rest(pair, k, df)[0]);
      }
    }
  } // namespace

  double stored_energy(const ContactPair &pair, const PointLaws<NormalLaw> &law, const DynamicState &state)
  {
    double energy = modal_energy(pair, state) + 0.5 * (state.R * state.residual_displacement) +
                    energy_of_relaxing(pair, state);
    if (state.force != 0)
    {
      energy += 0.5 * pair.force_response(0) * state.force * state.force;
      for (unsigned int i = 0; i < state.R.size(); ++i)
        energy += state.force * pair.force_response(i) * state.R[i];
    }
    if (!state.contact.empty())
      for (unsigned int i = 0; i < pair.n_points(); ++i)
        energy += law[i].potential(state.contact.y[i]);
    return energy;
  }

  double upwind_power(const PlacedContacts &contacts, const CreepScheme &scheme, const double speed,
                      const DenseVector &R, const DenseVector &residual_displacement)
  {
    const unsigned int n = contacts.n_points();
    const double *const u = residual_displacement.begin();
    double power = 0;
    unsigned int first = n;
    for (const PlacedContact &contact : contacts.all)
    {
      const ContactGrid &grid = contact.grid;
      double sum = 0;
      for (const unsigned int begin : {first, first + n})
        for (unsigned int point = 0; point < grid.n_points(); ++point)
        {
          const unsigned int row = begin + point, i = point % grid.n_x;
          if (R[row] == 0 || i < scheme.reach() || i + 1 >= grid.n_x)
            continue;
          double difference = -(u[row + 1] - u[row - 1]) / 2;
          for (unsigned int k = 0; k < scheme.coefficients.size(); ++k)
            difference += scheme.coefficients[k] * u[row - k];
          sum += R[row] * difference;
        }
      power += speed * contact.share_of_speed() / grid.spacing_x * sum;
      first += grid.n_points();
    }
    return power;
  }

  void add_step(EnergyAccount &account, const ContactPair &pair, const PointLaws<NormalLaw> &law,
                const CreepScheme &scheme, const DynamicState &before, const Drive &drive_before,
                const DynamicState &after, const Drive &drive_after)
  {
    const unsigned int n = pair.n_points();
    const double h = after.time - before.time;
    double work = 0, damping = 0, loads = 0, hub = 0, exciting = 0;
    const double mean_force = (before.force + after.force) / 2;
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
    {
      const double dq = after.q[k] - before.q[k], v = (after.v[k] + before.v[k]) / 2;
      const double force = (before.modal_force[k] + after.modal_force[k]) / 2;
      work += force * dq;
      loads += pair.modal_load[k] * dq;
      exciting += mean_force * pair.force_participation(k) * dq;
      hub += pair.hub_participation(k) * (before.hub_acceleration + after.hub_acceleration) / 2 * dq;
      damping += 2 * pair.damping_ratio[k] * pair.omega[k] * v * v * h;
    }
    for (unsigned int k = 0; k < pair.n_poles(); ++k)
    {
      const std::complex<double> dz = 2. * (after.z[k] - before.z[k]);
      account.damping += ((before.pole_reaction[k] + after.pole_reaction[k]) / 2. * dz).real();
      if (mean_force != 0 && pair.body_of_pole[k] == 1)
      {
        const double taken = mean_force * (pair.right(0, k) * dz).real();
        account.loads += taken;
        account.damping += taken;
      }
    }
    if (pair.hub)
    {
      std::vector<double> mean(pair.n_modes());
      for (unsigned int k = 0; k < pair.n_modes(); ++k)
        mean[k] = (before.v[k] + after.v[k]) / 2;
      const std::vector<double> force = pair.hub->damping_force(mean);
      for (unsigned int k = 0; k < pair.n_modes(); ++k)
        damping += pair.hub->modal_force(force, k) * mean[k] * h;
    }
    account.loads += loads + exciting;
    if (mean_force != 0)
    {
      double moved = pair.force_response(0) * (after.force - before.force);
      for (unsigned int i = 0; i < 3 * n; ++i)
        moved += pair.force_response(i) * (after.R[i] - before.R[i]);
      account.loads += mean_force * moved;
    }
    account.hub += hub;
    account.damping += damping;
    account.numerical_modes +=
        work + loads + exciting + hub - damping - modal_energy(pair, after) + modal_energy(pair, before);
    account.stored = stored_energy(pair, law, after);

    account.friction += h * (before.friction_power + after.friction_power) / 2;
    account.creepage += h * (before.creepage_power + after.creepage_power) / 2;
    const PlacedContacts &contacts = pair.interface.contacts;
    const double upwind =
        h / 2 *
        (upwind_power(contacts, scheme, drive_before.creepage.speed, before.R, before.residual_displacement) +
         upwind_power(contacts, scheme, drive_after.creepage.speed, after.R, after.residual_displacement));
    account.numerical_upwind += upwind;
    account.transport += h * (before.transport_power + after.transport_power) / 2 + upwind;
    for (unsigned int i = n; i < 3 * n; ++i)
      account.numerical_rate +=
          h * (before.R[i] * before.residual_rate[i] + after.R[i] * after.residual_rate[i]) / 2 -
          (before.R[i] + after.R[i]) / 2 * (after.residual_displacement[i] - before.residual_displacement[i]);
    add_relaxing(account, pair, before, after);
    const double approach = after.contact.approach - before.contact.approach;
    if (approach != 0)
    {
      const auto force = [&](const DynamicState &state) { return contacts.resultants(state.R); };
      std::vector<std::array<double, 3>> mean = force(before);
      const std::vector<std::array<double, 3>> last = force(after);
      double all = 0, along = 0;
      for (unsigned int k = 0; k < mean.size(); ++k)
        for (unsigned int c = 0; c < 3; ++c)
          mean[k][c] = (mean[k][c] + last[k][c]) / 2;
      all = contacts.force_on(0, mean)[2] * approach;
      for (std::array<double, 3> &one : mean)
        one[0] = 0;
      along = contacts.force_on(0, mean)[2] * approach;
      account.hub += all;
      // what the slip of inclined contacts has taken it for
      account.transport -= along;
    }
    for (unsigned int i = 0; i < n && !(drive_after.gap.empty() && drive_before.gap.empty()); ++i)
    {
      const double roughness = (drive_after.gap.empty() ? 0 : drive_after.gap[i]) -
                               (drive_before.gap.empty() ? 0 : drive_before.gap[i]);
      account.hub -= (before.R[i] + after.R[i]) / 2 * roughness;
    }
    account.available = std::max({account.available, account.initial + account.input(),
                                  least_energy_of_poles(pair, after, account.damping)});
  }
} // namespace vibrocontact
