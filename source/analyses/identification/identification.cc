#include <vibrocontact/analyses/identification/identification.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/base/parameter_text.h>
#include <vibrocontact/base/wall_clock.h>
#include <vibrocontact/numerics/eigenvalues.h>
#include <vibrocontact/numerics/lsce.h>
#include <vibrocontact/numerics/vector_fitting.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  using Complex = std::complex<double>;

  namespace
  {
    PoleFit fit_by_relocation(const Spectra &data, const unsigned int n_pairs, const ResidueRules &rules,
                              const unsigned int n_iterations)
    {
      VectorFittingOptions options;
      options.n_iterations = n_iterations;
      options.rules = rules;
      return vector_fit(data, n_pairs, options);
    }

    PoleFit fit_by_lsce(const Spectra &data, const unsigned int n_pairs, const ResidueRules &rules,
                        const unsigned int)
    {
      return lsce_fit(data, n_pairs, rules);
    }
  } // namespace

  const std::vector<FitMethod> &fit_methods()
  {
    static const std::vector<FitMethod> rows = {
        {"vector fitting", true, false, nullptr, false, fit_by_relocation},
        {"lsce", false, true, most_lsce_pairs, false, fit_by_lsce},
        {"lsce with real amplitudes", false, true, most_lsce_pairs, true, fit_by_lsce}};
    return rows;
  }

  void IdentificationParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter(
        "Data file", data_file,
        "Frequency responses between all points: a table (CSV) with frequency_Hz and "
        "<response>_<force>_real_m_N, ..._imag_m_N, or a universal file (.uff, .unv) with datasets 58 or "
        "58b; impulse responses over time as well. Units: none.",
        FileName());
    prm.add_parameter(
        "Rolling data", rolling,
        "The body turns: the response of i to a force at j is not that of j to i. Units: none.");
    prm.add_parameter("Lower frequency", lower_frequency, "Lines of the data below are left out. Units: Hz.",
                      Double(0, 1e9));
    prm.add_parameter("Upper frequency", upper_frequency,
                      "Lines of the data above are left out; 0: none. Units: Hz.", Double(0, 1e9));
    prm.add_parameter("Delay", delay,
                      "By which the responses of the data lag behind the forces (of the measuring chain): "
                      "taken out of them. "
                      "Units: s.",
                      Double(-10, 10));
    prm.add_parameter("Passive data", passive_data,
                      "Data that give energy to a force are refused, with what is likely wrong: a delay, "
                      "another quantity, a "
                      "sign; false: a warning only. Units: none.");
    prm.add_parameter(
        "Enforce passivity", enforce_passivity,
        "The model of a body at rest takes energy from every force at every frequency: its residues are "
        "changed by the least that is needed, by 5 % of the rms receptance at most. Units: none.");
    prm.add_parameter(
        "Method", methods,
        "vector fitting, lsce, lsce with real amplitudes (as in the paper), or several, separated by "
        "commas. Units: none.",
        Anything());
    prm.add_parameter("Numbers of pole pairs", pairs, "One fit for each. Units: none.",
                      List(Integer(1, 500), 1, 100, ","));
    prm.add_parameter(
        "Target error", target_error,
        "Error E of the worst entry (paper, Eq. 9) that the smallest number of pole pairs has to reach, in "
        "place of Numbers of pole pairs; 0: none. Units: none.",
        Double(0, 1));
    prm.add_parameter("Largest number of pole pairs", largest,
                      "At most so many for Target error. Units: none.", Integer(1, 500));
    prm.add_parameter("Direct term", direct,
                      "A constant beside the poles; it may spoil the use in contact. Units: none.");
    prm.add_parameter(
        "Impose zero initial value", zero_initial_value,
        "The impulse response begins at zero, as that of every body with mass: needed by rigid contact with "
        "impacts. Units: none.");
    prm.add_parameter("Iterations", n_iterations,
                      "Relocations of the poles in vector fitting at most. Units: none.", Integer(1, 1000));
    prm.add_parameter(
        "Contact time step", contact_step,
        "Step of the contact runs to come: compliance over it, its half and tenth and a vanishing step has "
        "to be positive definite; 0: not judged. Units: s.",
        Double(0, 1));
    prm.add_parameter("Repair for contact", repair,
                      "Fit again with what contact needs if a fit has it not. Units: none.");
    prm.add_parameter(
        "Residue tolerance", tolerance,
        "Share of the receptance that may be left out of the residue matrices to save states. Units: none.",
        Double(0, 0.1));
    prm.add_parameter("Stabilisation chart", chart,
                      "Poles over their number, as table and figure. Units: none.");
  }

  std::vector<FitMethod> IdentificationParameters::method_list() const
  {
    std::vector<FitMethod> rows;
    for (const std::string &name : split_list(methods))
      rows.push_back(find_named(fit_methods(), name, "method of Identification/Method"));
    return rows;
  }

  void IdentificationParameters::check() const
  {
    if (data_file.empty())
      throw InputError("Identification/Data file is empty: name the file with the frequency responses.");
    if (method_list().empty())
      throw InputError("Identification/Method is empty: choose " + quoted_list(names_of(fit_methods())) +
                       ".");
    if (upper_frequency > 0 && upper_frequency <= lower_frequency)
      throw InputError("Identification/Upper frequency = " + number_text(upper_frequency) +
                       " Hz is not above Lower frequency = " + number_text(lower_frequency) +
                       " Hz: exchange them, or set it to 0 for all lines.");
  }

  double Identification::worst() const
  {
    return *std::max_element(errors.begin(), errors.end());
  }

  bool Identification::passivity_refused() const
  {
    return passivity_looked_at && (passivity.change > 0.05 || !passivity.is_passive());
  }

  Spectra spectra(const FrequencyData &data)
  {
    Spectra result;
    for (const double frequency : data.frequency)
      result.omega.push_back(2 * M_PI * frequency);
    for (const FrequencyData::Entry &entry : data.entries)
      result.values.push_back(entry.values);
    return result;
  }

  EntryMap entry_map(const FrequencyData &data)
  {
    EntryMap map;
    map.n_rows = data.labels.size();
    for (unsigned int i = 0; i < map.n_rows; ++i)
      for (unsigned int j = 0; j < map.n_rows; ++j)
      {
        const FrequencyData::Entry *entry = data.find(i, j);
        map.entry.push_back((entry ? entry : data.find(j, i)) - data.entries.data());
      }
    return map;
  }

  namespace
  {
    ResidueRules rules_of(const IdentificationParameters &parameters, const FitMethod &method)
    {
      ResidueRules rules;
      rules.direct = parameters.direct;
      rules.zero_initial_value = parameters.zero_initial_value;
      rules.real_amplitudes = method.real_amplitudes;
      return rules;
    }

    /// No more than some number, and than the data determine.
    unsigned int at_most(const unsigned int n_pairs, const FitMethod &method, const Spectra &data)
    {
      return method.most_pairs ? std::min(n_pairs, std::max(1u, method.most_pairs(data))) : n_pairs;
    }

    /// Slopes g'(0+) of the entries with the eigenvalues of their symmetric part raised.
    std::vector<double> raised_slopes(const PoleFit &fit, const EntryMap &map)
    {
      const unsigned int n = map.n_rows;
      DenseMatrix slope(n, n), vectors;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          slope(i, j) = fit.initial(map.entry[i * n + j], 1);
      std::vector<double> values = symmetric_eigenvalues(slope, vectors);
      std::vector<double> slopes(fit.residues.size());
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
        {
          double value = (slope(i, j) - slope(j, i)) / 2;
          for (unsigned int k = 0; k < n; ++k)
            value += std::max(values[k], 1e-3 * values.back()) * vectors(i, k) * vectors(j, k);
          slopes[map.entry[i * n + j]] = value;
        }
      return slopes;
    }

    Identification identify_once(const IdentificationParameters &parameters, const Spectra &data,
                                 const EntryMap &map, const FitMethod &method, const unsigned int n_pairs)
    {
      const auto begin = WallClock::now();
      Identification result;
      result.method = method.name;
      result.n_asked = n_pairs;
      ResidueRules rules = rules_of(parameters, method);
      const double entries = data.values.size(), numbers = 2 * entries * data.omega.size(),
                   fitted = n_pairs * (2 + entries * (rules.real_amplitudes ? 1 : 2));
      result.error_of_noise = std::sqrt(std::max(0., 1 - fitted / numbers));
      result.passivity_looked_at = parameters.enforce_passivity && !parameters.rolling;
      const auto take = [&](const PoleFit &fit)
      {
        result.fit = fit;
        if (result.passivity_looked_at)
        {
          result.passivity = nearest_passive_fit(data, fit, map, rules);
          if (!result.passivity_refused())
            result.fit = result.passivity.fit;
        }
        result.errors = fit_errors(data, result.fit);
        result.identified = identified_model(result.fit, map, parameters.tolerance);
        result.checked = parameters.contact_step > 0;
        if (result.checked)
          result.well_posedness = well_posedness_of_contact(result.identified.model, parameters.contact_step);
      };
      take(method.fit(data, n_pairs, rules, parameters.n_iterations));
      if (result.checked && parameters.repair && !result.well_posedness.usable())
      {
        const Identification before = result;
        if (rules.direct || (!rules.zero_initial_value && !rules.real_amplitudes))
        {
          rules.direct = false;
          rules.zero_initial_value = true;
          take(method.fit(data, n_pairs, rules, parameters.n_iterations));
        }
        if (!result.well_posedness.usable())
        {
          rules.initial_slope = raised_slopes(result.fit, map);
          PoleFit again = fit_residues(data, result.fit.poles, rules);
          again.converged = result.fit.converged;
          take(again);
        }
        result.repaired = result.well_posedness.usable();
        if (!result.repaired)
        {
          result = before;
          result.repair_failed = true;
        }
        else
          result.errors_before_repair = before.errors;
      }
      result.seconds = seconds_since(begin);
      return result;
    }
  } // namespace

  std::vector<Identification> identify(const IdentificationParameters &parameters, const FrequencyData &data,
                                       const std::function<void(const Identification &)> &finished)
  {
    const Spectra lines = spectra(data);
    const EntryMap map = entry_map(data);
    std::vector<Identification> results;
    const auto keep = [&](const Identification &one)
    {
      results.push_back(one);
      finished(one);
    };
    for (const FitMethod &method : parameters.method_list())
    {
      if (parameters.target_error <= 0)
      {
        for (const unsigned int n_pairs : parameters.pairs)
          keep(identify_once(parameters, lines, map, method, n_pairs));
        continue;
      }
      Identification best;
      const unsigned int largest = at_most(parameters.largest, method, lines);
      for (unsigned int n_pairs = 1; n_pairs <= largest; ++n_pairs)
      {
        const Identification one = identify_once(parameters, lines, map, method, n_pairs);
        if (best.errors.empty() || one.worst() < best.worst())
          best = one;
        if (best.worst() <= parameters.target_error)
          break;
      }
      best.target_reached = best.worst() <= parameters.target_error;
      best.most_tried = largest;
      keep(best);
    }
    return results;
  }

  std::vector<ChartPole> stabilisation_chart(const IdentificationParameters &parameters,
                                             const FrequencyData &data,
                                             const std::function<void(unsigned int)> &advance)
  {
    const Spectra lines = spectra(data);
    unsigned int last = parameters.target_error > 0 ? parameters.largest : 0;
    if (last == 0)
      last = *std::max_element(parameters.pairs.begin(), parameters.pairs.end());
    const FitMethod method = parameters.method_list().front();
    last = at_most(last, method, lines);
    const ResidueRules rules = rules_of(parameters, method);
    std::vector<ChartPole> chart, before;
    for (unsigned int n_pairs = 2; n_pairs <= last; n_pairs += 2)
    {
      const PoleFit fit = method.fit(lines, n_pairs, rules, parameters.n_iterations);
      std::vector<ChartPole> now;
      for (const Complex &pole : fit.poles)
      {
        ChartPole one{n_pairs, std::abs(pole) / (2 * M_PI), -pole.real() / std::abs(pole), 0};
        for (const ChartPole &other : before)
          if (std::abs(other.frequency - one.frequency) < 0.01 * one.frequency)
          {
            // without damping there is nothing but round-off to compare
            const double tolerance = std::max(0.05 * one.damping_ratio, 1e-6);
            const bool damped_alike = std::abs(other.damping_ratio - one.damping_ratio) < tolerance;
            one.status = std::max(one.status, damped_alike ? 2u : 1u);
          }
        now.push_back(one);
      }
      chart.insert(chart.end(), now.begin(), now.end());
      before = now;
      advance(n_pairs);
    }
    return chart;
  }
} // namespace vibrocontact
