#pragma once

#include <vibrocontact/analyses/modal_convolution/modal_convolution.h>

#include <map>
#include <string>
#include <vector>

namespace vibrocontact
{
  /// Runs in which every method is timed: time step [s], number of steps, memory of the convolutions in steps.
  struct ComparisonRow
  {
    double time_step;
    unsigned long n_steps, memory;
  };

  /// `subsection Modal convolution / subsection Comparison`
  struct ComparisonParameters
  {
    /// of body 1, e.g. 1e-4:2000:1900, 1e-5:20000:19000
    std::string rows;
    /// each timing is the median of so many runs
    unsigned int repetitions = 5;

    /// A body after the first, in a subsection of its name: rolls over its own road in the comparison only.
    struct FurtherBody
    {
      std::string rows, force_shape = "impulse";
      RoadParameters road;
    };
    /// by name; the names have to be there before the declaration
    std::map<std::string, FurtherBody> further_bodies;

    void declare_parameters(dealii::ParameterHandler &prm);
    /// @throws InputError naming the entry
    void check() const;
    bool any() const;
  };

  /// @param entry said in the message. @throws InputError
  std::vector<ComparisonRow> read_comparison_rows(const std::string &rows, const std::string &entry);

  /// One method of one row.
  struct ComparedMethod
  {
    std::string method;
    double time_step;
    unsigned long n_steps, memory;
    /// against the reference: largest of the displacement [m]; rms of the force without the neighbourhood of events
    /// (three steps), where a stepped force is an impulse over h [N]; of the impulses of the whole run at the worst point,
    /// relative to the largest. Not finite: the method broke down.
    double error_displacement, error_force, error_impulse;
    /// median, the profile tabulated, histories stored [s]
    double seconds_per_step;
  };

  /// The paper's Table 2 redone: every method on one body and road, its error against its cost in one run. The reference
  /// is the event-located motion where the contact is rigid and has at most four points, otherwise the modal recursion in an
  /// eighth of the step, with continuous linear forces, or impulses if the contact is rigid. Rigid contact always has
  /// impulses.
  ///
  /// One point also has the paper's own forms (propagators/paper_methods.h).
  std::vector<ComparedMethod> compare_methods(const std::vector<ComparisonRow> &rows,
                                              unsigned int repetitions,
                                              const ModalConvolutionParameters &parameters,
                                              const BodyInContact &model, const RoadParameters &road,
                                              const std::vector<double> &places,
                                              const std::vector<double> &shapes);
} // namespace vibrocontact
