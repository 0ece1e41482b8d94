#pragma once

#include <vibrocontact/analyses/modal_convolution/modal_convolution_parameters.h>
#include <vibrocontact/analyses/modal_convolution/road_contact.h>
#include <vibrocontact/contact/contact_solver.h>
#include <vibrocontact/propagators/step_weights.h>

#include <memory>

namespace vibrocontact
{
  /// The steps of a modal convolution at any number of points: propagator and contact.
  class RoadStepper
  {
  public:
    /// @param speed that a body with gradients rolls at [m/s]
    /// @throws InputError if the body cannot be in contact in this way, or Contact/Solver/Method does not take its problem
    RoadStepper(const ModalConvolutionParameters &parameters,
                const ContactSolverParameters &solver_parameters, const BodyInContact &model,
                unsigned int n_points, unsigned long n_steps, const RoadLaws &laws, double sliding_speed,
                double speed);

    /// Leaves nothing of the steps before that a resumed run, which begins with a block too, has not.
    void begin_block();
    /// Without friction. @param heights, displacements, forces n_points per step
    void run(unsigned int n_steps, const double *heights, double *displacements, double *forces);
    /// @param tangential_displacements, tangential_forces as the others; null without friction. With it the line that the
    /// first step begins with stands in front of them and of the forces
    void run_steps(unsigned int n_steps, const double *heights, double *displacements, double *forces,
                   double *tangential_displacements, double *tangential_forces);

    /// of the body's rows and, of one that rolls with friction, of its gradients along the road behind them
    std::unique_ptr<Propagator> propagator;
    /// of the body's rows alone
    const DenseMatrix compliance;
    std::unique_ptr<ContactSolver> solver;
    /// whether that of Contact/Solver/Method finds the forces: friction, a law that yields, or asked for; if not, the active set
    const bool is_common;
    unsigned long closed_points = 0, sticking_points = 0, iterations = 0;
    double residual = 0, dissipation = 0;
    /// forces that the body's rest has followed so far, s with r = S s: those of the last step if it does not relax; 2 n with
    /// friction [N]
    std::vector<double> relaxed;

  private:
    double relaxed_after(unsigned int row, const double *forces,
                         const std::vector<double> &forces_before) const;
    std::vector<double> law_speed(const ContactSolution &solution,
                                  const std::vector<double> &forces_before) const;

    const unsigned int n;
    ContactSolution solution;
    /// the last 0 of a body without gradients
    const double step, sliding_speed, rolling_speed;
    ContactProblem problem;
    const bool is_linear;
    /// S, what answers to a force at once or relaxes
    DenseMatrix residual_flexibility;
    /// s after the step = factor s before + now R + later R of the step before; one each
    StepWeights rest;
  };
} // namespace vibrocontact
