#pragma once

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// A history of loads on the hub of body 1, step by step, along x, y and against the normal (z, downwards). Along each of
  /// them either the force is given or the displacement, throughout.
  struct LoadHistory
  {
    struct Step
    {
      /// force [N] or displacement [m] along x, y, downwards
      std::array<double, 3> load;
      /// counted from 1
      unsigned int part;
      bool ends_part;
    };
    std::array<bool, 3> force_given = {{false, false, false}};
    std::vector<Step> steps;
  };

  /// `subsection Loading`: what presses and shifts body 1 on body 2, without time.
  ///
  /// The history has parts. Lists hold the values at their ends, between which loads change linearly in equal steps; it
  /// begins without any load. A list of one value has it at all ends, an empty one leaves the direction to its
  /// alternative.
  struct LoadingParameters
  {
    /// along x, y and downwards: of each direction one of the two lists may hold values [N], [m]
    std::array<std::vector<double>, 3> force, displacement;
    /// steps of each part; one number: of every part
    std::vector<unsigned int> steps = {10};
    /// a file with a row per step, in place of the lists
    std::string table;

    void declare_parameters(dealii::ParameterHandler &prm);
    /// Lists against each other. @throws InputError
    void check() const;
    /// Reads the table, if there is one. Collective.
    /// @throws InputError if the table is none of such a history
    LoadHistory history() const;
  };
} // namespace vibrocontact
