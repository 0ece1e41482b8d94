#include <vibrocontact/analyses/frequency_response/revolved_response.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/wave_mode.h>
#include <vibrocontact/reduction/wheel_labels.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace vibrocontact
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    void add(const std::vector<Receptance> &part, std::vector<Receptance> &sum)
    {
      for (std::size_t k = 0; k < part.size(); ++k)
        for (std::size_t i = 0; i < part[k].size(); ++i)
          sum[k][i] += part[k][i];
    }
  } // namespace

  RevolvedResponse::RevolvedResponse(const RevolvedSection &section, const std::vector<RevolvedPoint> &points,
                                     const ModeParameters &parameters, const unsigned int n_waves,
                                     const MPI_Comm communicator)
      : section(section), points(points), parameters(parameters), n_waves(n_waves), communicator(communicator)
  {
  }

  std::vector<TraceRow> RevolvedResponse::rows(const unsigned int n, const bool odd) const
  {
    std::vector<TraceRow> result;
    for (const RevolvedPoint &point : points)
      result.push_back(point.row(n, odd));
    return result;
  }

  std::unique_ptr<SecondOrderSystem> RevolvedResponse::damped_system(const unsigned int n) const
  {
    auto system = section.system(n);
    const double loss_factor = 2 * wheel_damping({{"", 0, n}}, parameters)[0];
    if (loss_factor == 0)
      return system;
    if (!system->has_loss)
    {
      system->loss_stiffness.reinit(system->stiffness);
      system->loss_stiffness = 0;
    }
    system->loss_stiffness.add(loss_factor, system->stiffness);
    system->has_loss = true;
    return system;
  }

  void
  RevolvedResponse::for_each_wave(const std::string &progress_text,
                                  const std::function<void(unsigned int, const SecondOrderSystem &)> &f) const
  {
    const unsigned int n_ranks = MPI::n_mpi_processes(communicator);
    on_all_ranks(
        [&]
        {
          Progress progress(progress_text, n_waves / n_ranks + 1.);
          for (unsigned int n = MPI::this_mpi_process(communicator); n <= n_waves; n += n_ranks)
          {
            const LoneWave alone;
            f(n, *damped_system(n));
            progress.advance();
          }
        },
        communicator);
  }

  const std::vector<ResponseReduction> &RevolvedResponse::reductions()
  {
    if (is_reduced)
      return reduced;
    is_reduced = true;
    for_each_wave("response by harmonics",
                  [&](const unsigned int n, const SecondOrderSystem &system)
                  {
                    Flexibility flexibility(system);
                    const Modes modes = compute_modes(system, flexibility, parameters);
                    const std::vector<double> damping = strain_energy_damping(system, modes);
                    for (const bool odd : {false, true})
                      if (!(odd && n == 0))
                        reduced.push_back(
                            reduce_response(system, flexibility, modes, damping, false, rows(n, odd)));
                  });
    return reduced;
  }

  std::vector<Receptance> RevolvedResponse::summed(std::vector<Receptance> own) const
  {
    for (Receptance &one : own)
      MPI::sum(one, communicator, one);
    return own;
  }

  std::vector<Receptance> RevolvedResponse::modal(const bool hysteretic, const double highest,
                                                  const std::vector<double> &frequency)
  {
    std::vector<Receptance> result(frequency.size(), Receptance(points.size() * points.size()));
    for (const ResponseReduction &one : reductions())
    {
      const auto begin = one.omega.begin(), end = begin + one.damping_ratio.size();
      const unsigned int n =
          (highest > 0 ? std::lower_bound(begin, end, 2 * dealii::numbers::PI * highest) : end) - begin;
      add(hysteretic ? hysteretic_response(one, n, frequency) : time_domain_response(one, n, frequency),
          result);
    }
    return summed(std::move(result));
  }

  unsigned int RevolvedResponse::n_modes(const double highest)
  {
    unsigned int own = 0;
    for (const ResponseReduction &one : reductions())
      for (unsigned int k = 0; k < one.damping_ratio.size(); ++k)
        own += highest == 0 || one.omega[k] < 2 * dealii::numbers::PI * highest;
    return MPI::sum(own, communicator);
  }

  std::vector<Receptance> RevolvedResponse::direct(const std::vector<double> &frequency)
  {
    const unsigned int m = points.size();
    std::vector<Receptance> result(frequency.size(), Receptance(m * m));
    for_each_wave("direct solutions by harmonics",
                  [&](const unsigned int n, const SecondOrderSystem &system)
                  {
                    HarmonicSolver solver(system);
                    // both families at once, of which the sum has what each answers to itself
                    std::vector<TraceRow> both = rows(n, false);
                    for (const TraceRow &row : n == 0 ? std::vector<TraceRow>() : rows(n, true))
                      both.push_back(row);
                    for (unsigned int k = 0; k < frequency.size(); ++k)
                    {
                      const auto found = solver.receptance(2 * dealii::numbers::PI * frequency[k], both);
                      for (unsigned int first = 0; first < both.size(); first += m)
                        for (unsigned int i = 0; i < m; ++i)
                          for (unsigned int j = 0; j < m; ++j)
                            result[k][i * m + j] += found[(first + i) * both.size() + first + j];
                    }
                  });
    return summed(std::move(result));
  }
} // namespace vibrocontact
