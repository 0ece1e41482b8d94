#pragma once

#include <vibrocontact/base/named_table.h>
#include <vibrocontact/bodies/identified_model.h>
#include <vibrocontact/bodies/passive_fit.h>
#include <vibrocontact/propagators/well_posedness.h>
#include <vibrocontact/receptances/frequency_file.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// E of a fit that follows nothing, over what it would leave of noise [-]
  constexpr double misses_most = 0.5;

  /// A row of the table of methods.
  struct FitMethod
  {
    std::string name;
    /// reads `Iterations`
    bool relocates_poles;
    /// in which lines from 0 Hz on are needed
    bool reads_impulse_responses;
    /// pole pairs that the data determine; null: any number
    unsigned int (*most_pairs)(const Spectra &data);
    /// A_k of the paper
    bool real_amplitudes;
    PoleFit (*fit)(const Spectra &data, unsigned int n_pairs, const ResidueRules &rules,
                   unsigned int n_iterations);
  };
  const std::vector<FitMethod> &fit_methods();

  /// `subsection Identification`: a body known by measured or computed Green's functions becomes poles.
  struct IdentificationParameters
  {
    std::string data_file;
    /// the body turns: G_ij and G_ji differ
    bool rolling = false;
    /// of the data, upper 0: all above [Hz]
    double lower_frequency = 0, upper_frequency = 0;
    /// by which the responses of the data lag behind their forces, taken out [s]
    double delay = 0;
    /// data that create energy are refused
    bool passive_data = true;
    /// the model of a body at rest becomes passive
    bool enforce_passivity = true;
    /// names of the table of methods, separated by commas
    std::string methods = "vector fitting";
    /// one fit for each, unless a target is set: then the smallest number that reaches it, up to `largest`
    std::vector<unsigned int> pairs = {25};
    double target_error = 0;
    unsigned int largest = 40;
    bool direct = false, zero_initial_value = false;
    unsigned int n_iterations = 30;
    /// of the contact runs to come [s]; 0: well-posedness of the contact is not looked at
    double contact_step = 20e-6;
    bool repair = true;
    /// share of |G| that may be left out of the residue matrices to save states
    double tolerance = 1e-12;
    bool chart = true;

    void declare_parameters(dealii::ParameterHandler &prm);
    /// @throws InputError
    void check() const;
    /// @throws InputError for a name that the table has not
    std::vector<FitMethod> method_list() const;
    DataRules data_rules() const { return {rolling, lower_frequency, upper_frequency, delay}; }
  };

  /// One fit.
  struct Identification
  {
    std::string method;
    /// what was asked for; LSCE drops unstable poles
    unsigned int n_asked = 0;
    PoleFit fit;
    /// E per entry (Eq. 9) of what is returned; before the repair if there was one
    std::vector<double> errors, errors_before_repair;
    IdentifiedModel identified;
    WellPosedness well_posedness;
    bool checked = false, repaired = false, repair_failed = false;
    /// of a body at rest: whether the model takes energy at every frequency, what it took, as seen by the last fit;
    /// `fit` is the passive one unless that is refused
    PassiveFit passivity;
    bool passivity_looked_at = false;
    /// whether E is within Target error, if there is one, and by how many pairs that was tried at most
    bool target_reached = true;
    unsigned int most_tried = 0;
    /// E that a fit of so many pairs leaves of noise alone, sqrt(1 - p / N): p = 2 n (1 + entries) numbers of the poles and
    /// residues, N = 2 lines entries of the data
    double error_of_noise = 1;
    double seconds = 0;

    double worst() const;
    bool follows_data() const { return worst() < misses_most * error_of_noise; }
    /// The passive model would differ by more than 5 % (rms receptance), or there is none.
    bool passivity_refused() const;
  };

  /// A pole of the stabilisation chart.
  struct ChartPole
  {
    unsigned int n_pairs;
    double frequency, damping_ratio;
    /// 0 new, 1 as frequent as one of the order before (1 %), 2 as damped, too (5 %)
    unsigned int status;
  };

  Spectra spectra(const FrequencyData &data);
  EntryMap entry_map(const FrequencyData &data);

  /// All fits that are asked for, in the order of methods and numbers.
  ///
  /// The model of a body at rest is made passive (bodies/passive_fit.h) if wanted, whenever it is fitted.
  /// A model whose one-step compliance is not positive definite at the contact step, its half and tenth and in the limit is
  /// repaired if wanted: the fit is made again without direct term and with g(0+) = 0; if that is not
  /// enough, the residues again with g'(0+) as well, whose eigenvalues are raised to 1e-3 of the largest at least.
  /// What it costs in E is shown. If that fails, too, the fit before it is kept with repair_failed, well_posedness says why
  /// and contact refuses the model. A Target error that no number of pairs reaches leaves the best fit, marked.
  std::vector<Identification> identify(const IdentificationParameters &parameters, const FrequencyData &data,
                                       const std::function<void(const Identification &)> &finished);

  /// Poles of the first method over the number of pairs.
  std::vector<ChartPole> stabilisation_chart(const IdentificationParameters &parameters,
                                             const FrequencyData &data,
                                             const std::function<void(unsigned int)> &advance);
} // namespace vibrocontact
