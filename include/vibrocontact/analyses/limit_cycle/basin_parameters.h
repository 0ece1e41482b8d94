#pragma once

#include <deal.II/base/parameter_handler.h>

namespace vibrocontact
{
  /// `subsection Basins` of it: which cycle motions go to that start between two of them.
  struct BasinParameters
  {
    /// between each two cycles; 0: none
    unsigned int n_starts = 0;
    /// of the motions at the start, over those between the cycles
    double size = 1;
    /// [s]
    double time_step = 1e-5;
    double longest_time = 5;
    /// width of what is left between starts that lead to different cycles, over the way from one to the other
    double border = 0.05;

    bool any() const { return n_starts > 0; }
    void declare_parameters(dealii::ParameterHandler &prm);
  };
} // namespace vibrocontact
