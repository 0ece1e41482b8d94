#include <vibrocontact/base/dense_operations.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/log.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/shared_cases.h>
#include <vibrocontact/numerics/frequency_refinement.h>
#include <vibrocontact/run/track_body.h>
#include <vibrocontact/waveguide/track_loads.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  namespace
  {
    constexpr double two_pi = 2 * dealii::numbers::PI;
    /// frequencies at first, evenly over their logarithm, and in all, where curves bend most
    constexpr unsigned int first_frequencies = 32;
    /// the poles follow from here on [Hz]
    constexpr double lowest_frequency = 50;
    constexpr unsigned int lines_of_band = 9;

    /// B (R - R_bed) B^T
    void add_smooth(const TrackReduction &track, DenseMatrix R, DenseMatrix &compliance)
    {
      R.add(-1., track.on_bed);
      const DenseMatrix BR = product(track.motions, R);
      BR.mTmult(compliance, track.motions, true);
    }

    ReceptanceLines receptance_lines(const TrackReduction &track)
    {
      ReceptanceLines lines;
      for (unsigned int k = 0; k < track.frequency.size(); ++k)
      {
        lines.omega.push_back(two_pi * track.frequency[k]);
        lines.values.emplace_back(6, 6);
        for (unsigned int i = 0; i < 36; ++i)
          lines.values.back()(i / 6, i % 6) = {track.real(k, i), track.imaginary(k, i)};
      }
      return lines;
    }

    /// Where they stand in the order of frequencies.
    void add_lines(const DirectResponse &lines, TrackReduction &into)
    {
      std::vector<double> all = into.frequency;
      all.insert(all.end(), lines.frequency.begin(), lines.frequency.end());
      std::sort(all.begin(), all.end());
      DenseMatrix real(all.size(), 36), imaginary(real);
      const auto put = [&](const auto &from)
      {
        for (unsigned int k = 0; k < from.frequency.size(); ++k)
        {
          const unsigned int place =
              std::lower_bound(all.begin(), all.end(), from.frequency[k]) - all.begin();
          for (unsigned int i = 0; i < 36; ++i)
          {
            real(place, i) = from.real(k, i);
            imaginary(place, i) = from.imaginary(k, i);
          }
        }
      };
      put(into);
      put(lines);
      into.frequency = all;
      into.real = real;
      into.imaginary = imaginary;
    }

    Table table_of(const TrackReduction &track, const ReceptanceFit &fit, const std::string &title)
    {
      Table table({"frequency_Hz", "lateral_real_m_N", "lateral_imaginary_m_N", "vertical_real_m_N",
                   "vertical_imaginary_m_N", "fitted_lateral_real_m_N", "fitted_lateral_imaginary_m_N",
                   "fitted_vertical_real_m_N", "fitted_vertical_imaginary_m_N", "error"},
                  {title, "error: the largest of all six motions, over their size"});
      for (unsigned int k = 0; k < track.frequency.size(); ++k)
      {
        const ComplexMatrix G = receptance(fit.body, two_pi * track.frequency[k]);
        table.add_row({track.frequency[k], track.real(k, 7), track.imaginary(k, 7), track.real(k, 14),
                       track.imaginary(k, 14), G(1, 1).real(), G(1, 1).imag(), G(2, 2).real(), G(2, 2).imag(),
                       fit.error[k]});
      }
      return table;
    }

    ComplexMatrix at_points(const DenseMatrix &motions, const ComplexMatrix &shapes)
    {
      ComplexMatrix result(motions.m(), shapes.n());
      for (unsigned int k = 0; k < shapes.n(); ++k)
        for (unsigned int i = 0; i < motions.m(); ++i)
          for (unsigned int j = 0; j < motions.n(); ++j)
            result(i, k) += motions(i, j) * shapes(j, k);
      return result;
    }
  } // namespace

  TrackBody::TrackBody(const BodyParameters &body, const ContactGrid &grid, const std::string &key,
                       const std::string &cache_directory, const MPI_Comm communicator)
      : parameters(body), grid(grid), own_key(key), cache(cache_directory, communicator),
        communicator(communicator)
  {
  }

  void TrackBody::check() const
  {
    const RailSection section(parameters, rail());
    check_patch(section.elements,
                rail().lateral_position + grid.y_first + (grid.n_y - 1) * grid.spacing_y / 2,
                grid.n_y * grid.spacing_y);
    check_on_track(supports_of_track(rail()), grid.x_first - grid.spacing_x / 2,
                   grid.x_first + (grid.n_x - 0.5) * grid.spacing_x);
    for (const auto &group : parameters.materials)
      if (group.second.young_modulus != parameters.materials.front().second.young_modulus ||
          group.second.poisson_ratio != parameters.materials.front().second.poisson_ratio)
        throw InputError(parameters.name + "/Rail/Model is periodic, which takes the groups " +
                         parameters.materials.front().first + " and " + group.first +
                         " in a contact with equal Young modulus and Poisson ratio only: give them the same, "
                         "or set Model to solid.");
  }

  const TrackInContact &TrackBody::track()
  {
    if (!made)
    {
      TrackInContact::Settings settings;
      settings.up_to = 1.2 * rail().fitted_up_to;
      made = std::make_unique<const TrackInContact>(parameters, rail(), grid, settings,
                                                    reduced ? &reduced->section : nullptr);
    }
    return *made;
  }

  DirectResponse TrackBody::solved(const std::vector<double> &frequency)
  {
    dealii::Timer timer;
    const TrackInContact &track = this->track();
    DirectResponse result;
    result.frequency = frequency;
    result.real.reinit(frequency.size(), 36);
    result.imaginary.reinit(frequency.size(), 36);
    const auto solve = [&](const unsigned int k)
    {
      const ComplexMatrix R = track.receptance(two_pi * frequency[k]);
      std::vector<double> outcome;
      for (unsigned int i = 0; i < 6; ++i)
        for (unsigned int j = 0; j < 6; ++j)
        {
          outcome.push_back(R(i, j).real());
          outcome.push_back(R(i, j).imag());
        }
      return outcome;
    };
    Progress progress(parameters.name + ": frequencies of the track", frequency.size());
    share_cases<std::vector<double>>(
        frequency.size(), 1, [&] { return std::function<std::vector<double>(unsigned int)>(solve); },
        [&](const unsigned int k, const std::function<std::vector<double>()> &outcome)
        {
          const std::vector<double> numbers = outcome();
          for (unsigned int i = 0; i < 36; ++i)
          {
            result.real(k, i) = numbers[2 * i];
            result.imaginary(k, i) = numbers[2 * i + 1];
          }
          progress.advance();
        },
        communicator);
    result.seconds = timer.wall_time();
    return result;
  }

  const DirectResponse &TrackBody::lines_in_bands(const std::vector<double> &frequency)
  {
    if (in_bands && in_bands->frequency == frequency)
      return *in_bands;
    const std::string lines_key = key_at(own_key, frequency);
    in_bands = cache.load_direct(parameters.name, lines_key);
    if (in_bands)
      run_log().line(parameters.name + ": receptance in " + std::to_string(frequency.size() / lines_of_band) +
                     " bands found in the cache");
    else
    {
      in_bands = solved(frequency);
      cache.save(parameters.name, lines_key, *in_bands);
    }
    return *in_bands;
  }

  const TrackReduction &TrackBody::reduction(const bool with_lines)
  {
    if (!reduced)
      reduced = cache.load_track(parameters.name, own_key);
    if (reduced && (!with_lines || !reduced->frequency.empty()))
      return *reduced;
    dealii::Timer timer;
    const Log::Part part("Periodic track " + parameters.name);
    const TrackInContact &track = this->track();
    if (!reduced)
    {
      TrackReduction &result = reduced.emplace();
      result.n_dofs = track.n_section_dofs();
      result.section = track.shapes();
      result.radius = track.radius();
      result.motions = track.motions;
      result.at_rest = track.at_rest();
      result.at_once = track.at_once();
      result.on_bed = track.on_bed();
      result.bed = track.bed_compliance();
      result.surface_height = track.surface_height();
      run_log().value("dofs of the section", result.n_dofs);
      run_log().value("shapes of the section", result.section.n());
      run_log().line("compliance of " + std::to_string(result.bed.m()) +
                     " rows: " + time_text(timer.wall_time()));
    }
    if (with_lines)
    {
      const double before = timer.wall_time();
      solve_all_frequencies(*reduced);
      run_log().line("receptance at " + std::to_string(reduced->frequency.size()) +
                     " frequencies: " + time_text(timer.wall_time() - before));
    }
    reduced->seconds += timer.wall_time();
    cache.save(parameters.name, own_key, *reduced);
    return *reduced;
  }

  void TrackBody::solve_all_frequencies(TrackReduction &into)
  {
    std::vector<double> first;
    for (unsigned int k = 0; k < first_frequencies; ++k)
      first.push_back(lowest_frequency *
                      std::pow(rail().fitted_up_to / lowest_frequency, k / (first_frequencies - 1.)));
    add_lines(solved(first), into);
    while (into.frequency.size() < n_frequencies)
    {
      std::vector<std::vector<std::complex<double>>> values;
      for (unsigned int k = 0; k < into.frequency.size(); ++k)
      {
        values.emplace_back();
        for (unsigned int i = 0; i < 36; ++i)
          values.back().emplace_back(into.real(k, i), into.imaginary(k, i));
      }
      const unsigned int left = n_frequencies - into.frequency.size();
      const std::vector<double> more =
          frequencies_between(into.frequency, values, std::max(left / 3, std::min(left, 8u)));
      if (more.empty())
        return;
      add_lines(solved(more), into);
    }
  }

  const ReceptanceFit &TrackBody::fit()
  {
    if (fitted)
      return *fitted;
    dealii::Timer timer;
    const TrackReduction &track = reduction(true);
    fitted = fit_receptance(receptance_lines(track), track.at_rest, track.at_once, rail().n_pole_pairs);
    run_log().line(parameters.name + ": " + std::to_string(rail().n_pole_pairs) +
                   " pole pairs follow its receptance within " + percent_text(fitted->worst_error(), 2) +
                   " (worst at " + number_text(track.frequency[fitted->worst_line()]) +
                   " Hz): " + time_text(timer.wall_time()));
    return *fitted;
  }

  ReducedBody TrackBody::at_rest()
  {
    const TrackReduction &track = reduction(false);
    ReducedBody body;
    body.name = parameters.name;
    body.grid = grid;
    body.n_dofs = track.n_dofs;
    body.residual = track.bed;
    add_smooth(track, track.at_rest, body.residual);
    body.trace.reinit(3 * grid.n_points(), 0);
    body.residual_load.assign(3 * grid.n_points(), 0.);
    body.surface_height = track.surface_height;
    // the ground does not move
    body.lifting.assign(3 * grid.n_points(), 0.);
    return body;
  }

  ReducedBody TrackBody::by(const ReceptanceFit &fit)
  {
    const BodyInContact &poles = fit.body;
    const TrackReduction &track = reduction(false);
    ReducedBody body = at_rest();
    body.residual = track.bed;
    add_smooth(track, poles.residual, body.residual);
    body.poles = poles.poles;
    body.pole_load = poles.pole_load;
    body.right = at_points(track.motions, poles.right);
    body.left = at_points(track.motions, poles.left);
    for (unsigned int k = 0; k < body.n_poles(); ++k)
      body.labels.push_back("pole " + std::to_string(k + 1));
    return body;
  }

  ReducedBody TrackBody::moving()
  {
    return by(fit());
  }

  ReducedBody TrackBody::in_time(const std::vector<FrequencyBand> &bands)
  {
    if (timed && timed->bands == bands)
      return by(timed->fit);
    dealii::Timer timer;
    InTime next;
    next.bands = bands;
    next.lines = reduction(true);
    std::vector<double> more;
    for (const FrequencyBand &band : bands)
      for (unsigned int k = 0; k < lines_of_band; ++k)
      {
        // the ends are in the band in spite of rounding
        const double beside = (1 - 1e-12) * (2. * k / (lines_of_band - 1) - 1);
        more.push_back((band.middle() + beside * (band.to - band.from) / 2) / two_pi);
      }
    std::sort(more.begin(), more.end());
    more.erase(std::unique(more.begin(), more.end()), more.end());
    add_lines(lines_in_bands(more), next.lines);
    next.fit = passive_receptance_fit(receptance_lines(next.lines), next.bands, next.lines.at_rest,
                                      next.lines.at_once, rail().n_pole_pairs);
    if (!next.fit.passive)
      throw InputError(parameters.name + ": " + std::to_string(rail().n_pole_pairs) +
                       " pairs of poles near its receptance cannot be made to take energy from every force, "
                       "so that it cannot "
                       "move in time: change " +
                       parameters.name + "/Rail/Pole pairs.");
    timed = std::move(next);
    run_log().line(parameters.name + " in time: " + std::to_string(rail().n_pole_pairs) +
                   " pole pairs follow its receptance within " +
                   percent_text(timed->worst_error_in_bands(), 2) + " in " + std::to_string(bands.size()) +
                   " bands, " + percent_text(timed->fit.worst_error(), 2) +
                   " elsewhere, and take energy at all frequencies: " + time_text(timer.wall_time()));
    return by(timed->fit);
  }

  double TrackBody::InTime::worst_error_in_bands() const
  {
    const std::vector<double> worst = errors_in_bands(fit, receptance_lines(lines), bands);
    return worst.empty() ? 0. : *std::max_element(worst.begin(), worst.end());
  }

  std::function<ComplexMatrix(const std::complex<double> &)> TrackBody::receptance()
  {
    const TrackInContact &track = this->track();
    return [&track](const std::complex<double> &s)
    { return track.receptance(std::complex<double>(0, -1) * s); };
  }

  LocalPolynomials &TrackBody::nearby()
  {
    if (!local)
      local = std::make_unique<LocalPolynomials>(receptance());
    return *local;
  }

  std::function<ComplexMatrix(const std::complex<double> &)> TrackBody::by_poles()
  {
    const BodyInContact &poles = fit().body;
    return [&poles](const std::complex<double> &s)
    {
      ComplexMatrix X(6, 6);
      for (unsigned int k = 0; k < poles.n_poles(); ++k)
        for (unsigned int i = 0; i < 6; ++i)
          for (unsigned int j = 0; j < 6; ++j)
          {
            const std::complex<double> residue = poles.right(i, k) * poles.left(j, k);
            X(i, j) += residue / (s - poles.poles[k]) + std::conj(residue) / (s - std::conj(poles.poles[k]));
          }
      return X;
    };
  }

  std::map<std::string, Table> TrackBody::fit_tables() const
  {
    std::map<std::string, Table> tables;
    const std::string title =
        "Receptance of the contact patch of " + parameters.name + " as a whole, and its ";
    if (fitted)
      tables.insert({"receptance_fit_" + parameters.name, table_of(*reduced, *fitted, title + "poles")});
    if (timed)
      tables.insert(
          {"receptance_in_time_" + parameters.name,
           table_of(timed->lines, timed->fit, title + "passive poles, with which it moves in time")});
    return tables;
  }

  nlohmann::ordered_json TrackBody::fit_json() const
  {
    if (!fitted)
      return nullptr;
    nlohmann::ordered_json json = {{"pole_pairs", rail().n_pole_pairs},
                                   {"states", fitted->body.n_poles()},
                                   {"up_to_Hz", rail().fitted_up_to},
                                   {"worst_error", fitted->worst_error()},
                                   {"worst_error_at_Hz", reduced->frequency[fitted->worst_line()]},
                                   {"converged", fitted->converged}};
    if (timed)
    {
      nlohmann::ordered_json bands = nlohmann::ordered_json::array();
      for (const FrequencyBand &band : timed->bands)
        bands.push_back({{"from_Hz", band.from / two_pi},
                         {"to_Hz", band.to / two_pi},
                         {"aimed_error", band.aimed_error}});
      json["in_time"] = {{"states", timed->fit.body.n_poles()},
                         {"bands", bands},
                         {"worst_error_in_bands", timed->worst_error_in_bands()},
                         {"worst_error", timed->fit.worst_error()},
                         {"worst_error_at_Hz", timed->lines.frequency[timed->fit.worst_line()]},
                         {"change_to_be_passive", timed->fit.change},
                         {"passive", timed->fit.passive},
                         {"converged", timed->fit.converged}};
    }
    return json;
  }
} // namespace vibrocontact
