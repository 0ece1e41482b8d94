#include <vibrocontact/analyses/limit_cycle/basin_parameters.h>

namespace vibrocontact
{
  void BasinParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Starts", n_starts,
                      "Motions that start between each two of the cycles found, at equal distances on the "
                      "way from one to the other, and are followed until one of the cycles has won; 0: none. "
                      "Units: none.",
                      Integer(0, 1000));
    prm.add_parameter("Size", size,
                      "Of the motions at the start, over those on the way from one cycle to the other: less "
                      "than 1 for motions that have to grow first. Units: none.",
                      Double(1e-6, 100));
    prm.add_parameter("Time step", time_step, "Longest step of these motions. Units: s.", Double(1e-9, 1e3));
    prm.add_parameter("Longest time", longest_time,
                      "Of a motion; where no cycle has won by then, the start is undecided. Units: s.",
                      Double(1e-12, 1e6));
    prm.add_parameter("Border", border,
                      "Between starts that lead to different cycles others follow, halfway, until the "
                      "border lies between two starts as close as this, over the way from one cycle to the "
                      "other; 1: none. Units: none.",
                      Double(1e-6, 1));
  }
} // namespace vibrocontact
