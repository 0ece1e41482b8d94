#pragma once

#include <vibrocontact/analyses/periodic/balance.h>
#include <vibrocontact/analyses/periodic/branch.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// `subsection Periodic`: periodic motions of bodies under a harmonic force on body 1 against rigid stops, springs or each
  /// other (Jones & Legrand 2014; doc/periodic.md).
  struct PeriodicParameters
  {
    std::string trial = "fourier", weighting = "fourier";
    unsigned int n_functions = 127;
    std::string form = "distributional";
    /// short name of a normal law; empty: that of section Contact
    std::string law;
    /// f [Hz], F [N], gap of the undeformed body [m]
    double frequency = 100, force = 1, gap = 0;
    /// "x, y, z, direction" or "x, y, z, dx, dy, dz"; empty: at the first contact point, into the stop
    std::string force_point;
    /// "name: x, y, z; ..." empty: the contact point of the body's own grid
    std::string contact_points;
    /// where they meet a body 2 that vibrates; empty: at the same places
    std::string contact_points_below;
    /// direction in which the stop lies: +x, -x, ..., -z
    std::string stop_direction = "-z";
    /// what moves: "reduced", "finite elements": all their modes
    std::string model = "reduced";
    bool is_reduced() const { return model == "reduced"; }
    unsigned int n_samples = 4096, quadrature_points = 0;
    /// whether the distance to the reference in time is computed
    bool reference = false;
    /// further solutions: pairs trial:weighting, numbers of functions, positions of the force within one cell (1 / N)
    std::string pairs;
    std::vector<unsigned int> numbers;
    unsigned int n_phases = 1;
    /// samples of the tables
    unsigned int n_output = 4096;
    BranchParameters continuation;
    /// that the entries choose from; never null
    std::shared_ptr<const TimeBases> bases = std::make_shared<const TimeBases>(time_bases());

    struct Place
    {
      std::string name;
      dealii::Point<3> point;
    };

    void declare_parameters(dealii::ParameterHandler &prm);
    /// @throws InputError
    void check() const;
    /// @param number of the body, from 0; those of the second have the names of those of the first, one for one
    std::vector<Place> contact_points_on(unsigned int number) const;
    /// direction 0 x, 1 y, 2 z and sign
    std::pair<unsigned int, double> stop_axis() const;
    /// place and direction (of length 1) of the force, nothing: at the first contact point
    std::optional<std::pair<dealii::Point<3>, dealii::Tensor<1, 3>>> parsed_force() const;
    /// trial and weighting of the main solution and of the further ones
    std::vector<std::pair<std::string, std::string>> parsed_pairs() const;
    /// @param friction coefficient of all points, or of each; empty: none [-]
    BalanceSettings settings(const std::string &trial_basis, const std::string &weighting_basis,
                             unsigned int number, const std::vector<double> &friction) const;
    /// all that is to be solved, the main solution first
    std::vector<BalanceSettings> solutions(const std::vector<double> &friction) const;
    /// of the response curves, the main one first; none if there is no continuation
    std::vector<BalanceSettings> curves(const std::vector<double> &friction) const;
    /// Name of the normal law in the table of laws; empty: that of section Contact.
    std::string own_law() const;
    /// What results call the laws of the contacts: by their short names if they have one.
    std::string law_in_results(const std::vector<std::string> &normal_laws) const;
  };
} // namespace vibrocontact
