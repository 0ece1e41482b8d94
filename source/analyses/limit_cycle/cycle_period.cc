#include <vibrocontact/analyses/limit_cycle/cycle_period.h>
#include <vibrocontact/numerics/cycle_measure.h>

#include <fftw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <stdexcept>

namespace vibrocontact
{
  double CycleSignal::mean() const
  {
    double sum = 0;
    for (const double value : values)
      sum += value;
    return sum / values.size();
  }

  double CycleSignal::amplitude() const
  {
    const std::size_t n = values.size();
    const auto extreme = [&](const std::size_t i)
    {
      return is_smooth ? extreme_between_samples(values[(i + n - 1) % n], values[i], values[(i + 1) % n])
                       : values[i];
    };
    const auto [least, largest] = std::minmax_element(values.begin(), values.end());
    return (extreme(largest - values.begin()) - extreme(least - values.begin())) / 2;
  }

  double CycleSignal::rms() const
  {
    const double about = mean();
    double sum = 0;
    for (const double value : values)
      sum += (value - about) * (value - about);
    return std::sqrt(sum / values.size());
  }

  std::vector<double> CycleSignal::harmonics() const
  {
    const unsigned int n = values.size();
    std::vector<double> in_turn = values;
    std::vector<std::complex<double>> lines(n / 2 + 1);
    const fftw_plan plan = fftw_plan_dft_r2c_1d(
        n, in_turn.data(), reinterpret_cast<fftw_complex *>(lines.data()), FFTW_ESTIMATE);
    fftw_execute(plan);
    fftw_destroy_plan(plan);
    std::vector<double> amplitudes;
    for (unsigned int k = 0; k < lines.size(); ++k)
      amplitudes.push_back(std::abs(lines[k]) * (k == 0 || 2 * k == n ? 1. : 2.) / n);
    return amplitudes;
  }

  const CycleSignal *CyclePeriod::main_velocity() const
  {
    const std::string axial = "rim_axial_velocity_m_s";
    for (const CycleSignal &probe : probes)
      if (probe.name.size() >= axial.size() &&
          probe.name.compare(probe.name.size() - axial.size(), axial.size(), axial) == 0)
        return &probe;
    return probes.empty() ? nullptr : &probes.front();
  }

  const CycleSignal &CyclePeriod::main_signal() const
  {
    // of the mean speed at which the contact slides: the rest is rounding
    constexpr double least_velocity = 1e-6;
    double normal_force = 0;
    for (std::size_t k = 0; k < forces.size(); k += 3)
      normal_force += forces[k].mean();
    if (const CycleSignal *const velocity = main_velocity();
        velocity && velocity->amplitude() * normal_force > least_velocity * friction_power.mean())
      return *velocity;
    return *std::max_element(forces.begin(), forces.end(),
                             [](const CycleSignal &a, const CycleSignal &b)
                             { return a.amplitude() < b.amplitude(); });
  }

  const CycleSignal &CyclePeriod::signal(const std::string &name) const
  {
    for (const std::vector<CycleSignal> *const list : {&forces, &probes})
      for (const CycleSignal &one : *list)
        if (one.name == name)
          return one;
    throw std::logic_error("no signal " + name);
  }

  bool CyclePeriod::is_same(const CyclePeriod &other) const
  {
    constexpr double same_length = 1e-3, same_size = 1e-2;
    if (std::abs(other.time.back() - time.back()) > same_length * time.back())
      return false;
    for (const auto list : {&CyclePeriod::forces, &CyclePeriod::probes})
    {
      double largest = 0, difference = 0;
      for (std::size_t k = 0; k < (this->*list).size(); ++k)
      {
        const CycleSignal &here = (this->*list)[k], &there = (other.*list)[k];
        largest = std::max(largest, here.amplitude());
        difference = std::max({difference, std::abs(there.amplitude() - here.amplitude()),
                               std::abs(there.rms() - here.rms()), std::abs(there.mean() - here.mean())});
      }
      if (difference > same_size * largest)
        return false;
    }
    return true;
  }

  CyclePeriod silent_period(const PlacedContacts &contacts, const std::vector<Probe> &probes)
  {
    CyclePeriod period;
    for (const PlacedContact &one : contacts.all)
      for (const char *const name : {"normal_force_N", "tangential_force_x_N", "tangential_force_y_N"})
        period.forces.push_back({(one.name.empty() ? "" : one.name + "_") + name, {}});
    period.stick_points.name = "stick_points";
    period.contact_points.name = "contact_points";
    period.friction_power.name = "friction_power_W";
    period.creepage_power.name = "creepage_power_W";
    period.power_into_body_1.name = "power_into_body_1_W";
    for (const Probe &probe : probes)
      period.probes.push_back({probe.name + "_velocity_m_s", {}, true});
    return period;
  }

  void hear(const DynamicState &state, const double time, const ContactPair &pair,
            const std::vector<Probe> &probes, CyclePeriod &period)
  {
    period.time.push_back(time);
    const std::vector<ContactStatus> &status = state.contact.status;
    const auto n_stick = std::count(status.begin(), status.end(), ContactStatus::stick),
               n_open = std::count(status.begin(), status.end(), ContactStatus::open);
    const std::vector<std::array<double, 3>> sums = pair.interface.contacts.resultants(state.R);
    for (unsigned int k = 0; k < period.forces.size(); ++k)
      period.forces[k].values.push_back(sums[k / 3][k % 3]);
    period.stick_points.values.push_back(n_stick);
    period.contact_points.values.push_back(status.size() - n_open);
    period.friction_power.values.push_back(state.friction_power);
    period.creepage_power.values.push_back(state.creepage_power);
    double power = 0;
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
      power += pair.body[k] == 1 ? state.modal_force[k] * state.v[k] : 0.;
    for (unsigned int k = 0; k < pair.n_poles(); ++k)
      if (pair.body_of_pole[k] == 1)
      {
        const std::complex<double> feed =
            pair.pole_load[k] + pair.force_into_pole(k) * state.force + state.pole_force[k];
        power += 2 * (state.pole_reaction[k] * (pair.poles[k] * state.z[k] + feed)).real();
      }
    period.power_into_body_1.values.push_back(power);
    for (unsigned int p = 0; p < probes.size(); ++p)
      period.probes[p].values.push_back(probes[p].velocity(state));
  }

  CyclePeriod listen_to_cycle(CycleMap &map, const LimitCycle &cycle, const ContactPair &pair,
                              const ContactSections &sections, const std::vector<Probe> &probes)
  {
    const PlacedContacts &contacts = pair.interface.contacts;
    CyclePeriod period = silent_period(contacts, probes);
    map.march(cycle.state, cycle.period, false,
              [&](const DynamicState &state)
              {
                check_contact_in_grid(contacts, sections, map.speed(), state.contact.status);
                hear(state, (period.time.size() + 1) * cycle.period / cycle.n_steps, pair, probes, period);
              });
    return period;
  }
} // namespace vibrocontact
