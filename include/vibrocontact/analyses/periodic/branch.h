#pragma once

#include <vibrocontact/analyses/periodic/response_curve.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <utility>
#include <vector>

namespace vibrocontact
{
  /// "trial:weighting, ..." as pairs of bases in time. @param entry named in messages
  /// @throws InputError for a member without colon
  std::vector<std::pair<std::string, std::string>> basis_pairs(const std::string &text,
                                                               const std::string &entry);

  /// `subsection Periodic / subsection Continuation`: the branch of periodic motions over one parameter of the scene
  /// (doc/periodic.md, "Response curves").
  struct BranchParameters
  {
    /// none, frequency, force or gap; units of the next four are its unit
    std::string parameter = "none";
    double first = 0, last = 0, scale = 0, tolerance = 1e-6;
    /// inside of the range: from there both ways; empty: from the first value
    std::string start;
    double largest_step = 0.1, smallest_step = 1e-10;
    unsigned int max_points = 5000;
    std::string stability = "monodromy";
    double mode_limit = 20;
    unsigned int hill_harmonics = 31;
    /// further curves, trial:weighting, and their numbers of functions (that of section Periodic if empty)
    std::string pairs;
    std::vector<unsigned int> numbers;

    bool is_wanted() const { return parameter != "none"; }
    /// whether the stability of its solutions is told
    bool tells_stability() const { return is_wanted() && stability != "none"; }
    void declare_parameters(dealii::ParameterHandler &prm);
    /// @throws InputError
    void check() const;
    std::vector<std::pair<std::string, std::string>> parsed_pairs() const;
    /// from the begin of the branch; two of them, backwards first, if it begins inside of its range
    std::vector<BranchSettings> settings() const;
  };
} // namespace vibrocontact
