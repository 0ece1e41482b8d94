#include <vibrocontact/output/transient_output.h>

#include <algorithm>
#include <numeric>

namespace vibrocontact
{
  TransientHistory::TransientHistory(const ContactPair &pair, const NormalLaw &law, const double interval,
                                     const std::string &folder)
      : pair(pair), law(law), interval(interval),
        rows(folder + "/histories",
             {"time_s", "normal_force_N", "tangential_force_x_N", "tangential_force_y_N", "approach_m",
              "smallest_gap_m", "contact_points", "stick_points", "slip_points", "stored_energy_J"})
  {
  }

  void TransientHistory::add(const DynamicState &state)
  {
    if (state.time < next * (1 - 1e-12))
      return;
    next += interval;
    const unsigned int n = pair.n_points();
    double force[3] = {0, 0, 0};
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int i = 0; i < n; ++i)
        force[c] += state.R[c * n + i];
    const ContactSolution &contact = state.contact;
    const auto count = [&](const ContactStatus status)
    { return double(std::count(contact.status.begin(), contact.status.end(), status)); };
    const double stick = count(ContactStatus::stick), slip = count(ContactStatus::slip);
    const double gap =
        contact.y.size() == 0 ? 0 : *std::min_element(contact.y.begin(), contact.y.begin() + n);
    rows.add({state.time, force[0], force[1], force[2], contact.approach, gap, stick + slip, stick, slip,
              stored_energy(pair, law, state)});
  }

  void TransientHistory::exchange(CheckpointFile &file)
  {
    unsigned long n = rows.size();
    file("histories/next", next);
    file("histories/lines", n);
    file.reading() ? rows.resume(n) : rows.flush();
  }

  nlohmann::ordered_json transient_json(const TransientResult &result, const DynamicState &last)
  {
    const unsigned int n = last.R.size() / 3;
    const auto sum = [&](const unsigned int c)
    { return std::accumulate(last.R.begin() + c * n, last.R.begin() + (c + 1) * n, 0.); };
    const EnergyAccount &energy = result.energy;
    const double steps = std::max<double>(1, result.steps);
    return {{"steps", result.steps},
            {"time_s", result.time},
            {"seconds_per_step", result.seconds / steps},
            {"iterations_per_step", result.iterations / steps},
            {"factorisations_per_step", result.factorisations / steps},
            {"fallbacks", result.fallbacks},
            {"impulse_Ns", result.impulse},
            {"smallest_gap_m", result.smallest_gap},
            {"energy",
             {{"initial_J", energy.initial},
              {"input_J", energy.input()},
              {"stored_J", energy.stored},
              {"friction_J", energy.friction},
              {"damping_J", energy.damping},
              {"numerical_J", energy.numerical()},
              {"imbalance_J", energy.imbalance()},
              {"numerical_modes_J", energy.numerical_modes},
              {"numerical_upwind_J", energy.numerical_upwind},
              {"numerical_rate_J", energy.numerical_rate},
              {"creepage_J", energy.creepage},
              {"transport_J", energy.transport},
              {"hub_J", energy.hub},
              {"loads_J", energy.loads}}},
            {"last",
             {{"normal_force_N", sum(0)},
              {"tangential_force_N", {sum(1), sum(2)}},
              {"approach_m", last.contact.approach}}},
            {"histories", "histories.h5"}};
  }
} // namespace vibrocontact
