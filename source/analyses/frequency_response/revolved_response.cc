#include <vibrocontact/analyses/frequency_response/revolved_response.h>
#include <vibrocontact/base/collective.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/reduction/compute_modes.h>
#include <vibrocontact/reduction/projected_matrix.h>
#include <vibrocontact/reduction/wave_mode.h>
#include <vibrocontact/reduction/wheel_labels.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace MPI = dealii::Utilities::MPI;
  using Complex = std::complex<double>;

  RevolvedResponse::RevolvedResponse(const RevolvedSection &section, const std::vector<RevolvedPoint> &points,
                                     const ModeParameters &parameters, const unsigned int n_waves,
                                     const MPI_Comm communicator, const double rotation,
                                     const WheelAttachments &dampers)
      : section(section), dampers(dampers), n_asked(points.size()), points(points), parameters(parameters),
        n_waves(n_waves), communicator(communicator), rotation(rotation), rows(dampers.ring_rows)
  {
    AssertThrow(!turns() || !dampers.has_masses(), dealii::ExcInternalError());
    this->points.insert(this->points.end(), dampers.places.begin(), dampers.places.end());
    for (const RevolvedPoint &point : this->points)
    {
      std::array<unsigned int, 3> own{};
      for (unsigned int c = 0; c < 3; ++c)
        if (point.has(c))
        {
          const auto same = std::find(rows.begin(), rows.end(), point.rows[c]);
          own[c] = same - rows.begin();
          if (same == rows.end())
            rows.push_back(point.rows[c]);
        }
      row_of.push_back(own);
    }
    if (turns())
      on_all_ranks(
          [&]
          {
            const LoneWave alone;
            stretched.emplace(centrifugal_displacement(section));
          },
          communicator);
  }

  std::unique_ptr<SecondOrderSystem> RevolvedResponse::damped_system(const unsigned int n) const
  {
    auto system = section.system(n, dampers.layers);
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

  std::unique_ptr<RevolvedRotation> RevolvedResponse::rotation_of(const unsigned int n) const
  {
    return turns() ? section.rotation(n, *stretched) : nullptr;
  }

  void RevolvedResponse::add_rotation(const RevolvedRotation &terms, SecondOrderSystem &system) const
  {
    system.stiffness.add(rotation * rotation, terms.geometric);
    system.stiffness.add(-rotation * rotation, terms.centripetal);
    SymmetricFactorization::Options options;
    options.name = system.body + ": waves that stand still";
    options.definite = false;
    options.keep_factors = false;
    // a wave that stands still has no frequency there: beyond, it grows without any force
    if (SymmetricFactorization(system.stiffness, nullptr, 0., options).n_negative() > 0)
      throw InputError(
          "Frequency response: " + system.body + " turns at " + number_text(std::abs(rotation)) +
          " rad/s, faster than one of its waves runs around it, where no motion is steady: lower "
          "Rolling/Speed.");
  }

  void RevolvedResponse::for_each_wave(const std::string &progress_text,
                                       const std::function<void(unsigned int, SecondOrderSystem &)> &f) const
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

  const std::vector<RevolvedResponse::Wave> &RevolvedResponse::waves()
  {
    if (is_reduced)
      return reduced;
    is_reduced = true;
    for_each_wave("response by harmonics",
                  [&](const unsigned int n, SecondOrderSystem &system)
                  {
                    Flexibility flexibility(system);
                    const Modes modes = compute_modes(system, flexibility, parameters);
                    std::vector<Vector> basis;
                    Wave wave;
                    wave.vectors = reduce_response(system, flexibility, modes,
                                                   strain_energy_damping(system, modes), false, rows, &basis);
                    wave.rotation.n_waves = n;
                    wave.rotation.speed = rotation;
                    if (const auto terms = rotation_of(n))
                    {
                      wave.rotation.coriolis = projected_matrix(terms->coriolis, basis);
                      wave.rotation.of_square = projected_matrix(terms->geometric, basis);
                      wave.rotation.of_square.add(-1., projected_matrix(terms->centripetal, basis));
                      add_rotation(*terms, system);
                    }
                    reduced.push_back(std::move(wave));
                  });
    return reduced;
  }

  void RevolvedResponse::add_wave(const unsigned int n, const int sense, const Receptance &answer,
                                  Receptance &sum) const
  {
    const unsigned int m = points.size(), n_rows = rows.size();
    std::vector<std::array<Complex, 3>> amplitudes(m);
    for (unsigned int i = 0; i < m; ++i)
    {
      const std::array<double, 3> even = points[i].weights(n, false), odd = points[i].weights(n, true);
      for (unsigned int c = 0; c < 3; ++c)
        amplitudes[i][c] = Complex(even[c], sense * odd[c]);
    }
    for (unsigned int i = 0; i < m; ++i)
      for (unsigned int j = 0; j < m; ++j)
        for (unsigned int c = 0; c < 3; ++c)
          for (unsigned int d = 0; d < 3; ++d)
            if (points[i].has(c) && points[j].has(d))
              sum[i * m + j] += 0.5 * std::conj(amplitudes[i][c]) *
                                answer[row_of[i][c] * n_rows + row_of[j][d]] * amplitudes[j][d];
  }

  std::vector<Receptance> RevolvedResponse::summed(
      const std::vector<double> &frequency,
      const std::function<void(const std::vector<double> &, std::vector<Receptance> &)> &add) const
  {
    constexpr std::size_t most_entries = 4000000;
    const std::size_t m = points.size(), at_once = std::max<std::size_t>(1, most_entries / (m * m));
    std::vector<Attachment> absorbers = dampers.absorbers;
    for (Attachment &one : absorbers)
      one.row += n_asked;
    std::vector<Receptance> result;
    for (std::size_t first = 0; first < frequency.size(); first += at_once)
    {
      const std::vector<double> part(frequency.begin() + first,
                                     frequency.begin() + std::min(first + at_once, frequency.size()));
      std::vector<Receptance> whole(part.size(), Receptance(m * m));
      add(part, whole);
      for (std::size_t k = 0; k < part.size(); ++k)
      {
        MPI::sum(whole[k], communicator, whole[k]);
        attach(absorbers, 1., 2 * dealii::numbers::PI * part[k], whole[k]);
        Receptance asked(n_asked * n_asked);
        for (unsigned int i = 0; i < n_asked; ++i)
          std::copy_n(whole[k].begin() + i * m, n_asked, asked.begin() + i * n_asked);
        result.push_back(asked);
      }
    }
    return result;
  }

  std::vector<Receptance> RevolvedResponse::modal(const bool hysteretic, const double highest,
                                                  const std::vector<double> &frequency)
  {
    const std::vector<Wave> &all = waves();
    if (!hysteretic && dampers.has_masses())
      return damped_in_time(highest, frequency);
    const auto add = [&](const std::vector<double> &part, std::vector<Receptance> &sum)
    {
      for (const Wave &wave : all)
      {
        const ResponseReduction &own = wave.vectors;
        const unsigned int n = wave.rotation.n_waves, n_kept = modes_below(own, highest);
        std::vector<Receptance> at_rest;
        if (!turns())
          at_rest =
              hysteretic ? hysteretic_response(own, n_kept, part) : time_domain_response(own, n_kept, part);
        for (std::size_t k = 0; k < at_rest.size(); ++k)
          attach(dampers.rings, n == 0 ? 1. : 0.5, 2 * dealii::numbers::PI * part[k], at_rest[k]);
        for (const int sense : {-1, 1})
        {
          const std::vector<Receptance> answer =
              turns() ? wave_response(own, wave.rotation, sense, hysteretic, n_kept, part) : at_rest;
          for (std::size_t k = 0; k < part.size(); ++k)
            add_wave(n, sense, answer[k], sum[k]);
        }
      }
    };
    return summed(frequency, add);
  }

  unsigned int RevolvedResponse::n_modes(const double highest)
  {
    unsigned int own = 0;
    for (const Wave &wave : waves())
      own += (wave.rotation.n_waves == 0 ? 1 : 2) * modes_below(wave.vectors, highest);
    return MPI::sum(own, communicator);
  }

  std::vector<Receptance> RevolvedResponse::direct(const std::vector<double> &frequency)
  {
    const auto add = [&](const std::vector<double> &part, std::vector<Receptance> &sum)
    {
      for_each_wave("direct solutions by harmonics",
                    [&](const unsigned int n, SecondOrderSystem &system)
                    {
                      const auto terms = rotation_of(n);
                      if (terms)
                        add_rotation(*terms, system);
                      HarmonicSolver solver(system, HarmonicSolver::Ranks::together,
                                            terms ? &terms->coriolis : nullptr);
                      for (std::size_t k = 0; k < part.size(); ++k)
                      {
                        const double omega = 2 * dealii::numbers::PI * part[k];
                        Receptance answer;
                        for (const int sense : {-1, 1})
                        {
                          // what the material sees
                          const double seen = omega - sense * double(n) * rotation;
                          if (terms || answer.empty())
                          {
                            answer =
                                solver.receptance(omega, rows, 2 * sense * rotation, seen < 0 ? -1. : 1.);
                            attach(dampers.rings, n == 0 ? 1. : 0.5, omega, answer);
                          }
                          add_wave(n, sense, answer, sum[k]);
                        }
                      }
                    });
    };
    return summed(frequency, add);
  }
} // namespace vibrocontact
