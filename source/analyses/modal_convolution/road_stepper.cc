#include <vibrocontact/analyses/modal_convolution/road_contact.h>
#include <vibrocontact/analyses/modal_convolution/road_stepper.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/friction_of_speed.h>
#include <vibrocontact/propagators/response_methods.h>
#include <vibrocontact/propagators/step_weights.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    DenseMatrix normal_block(const DenseMatrix &matrix, const unsigned int n_points)
    {
      DenseMatrix block(n_points, n_points);
      for (unsigned int i = 0; i < n_points; ++i)
        for (unsigned int j = 0; j < n_points; ++j)
          block(i, j) = matrix(i, j);
      return block;
    }

    std::string at_step(const double time_step)
    {
      std::ostringstream text;
      text << "at Modal convolution/Time step " << time_step << " s";
      return text.str();
    }

    std::unique_ptr<Response> make_response(const ModalConvolutionParameters &parameters,
                                            const BodyInContact &model, const unsigned long n_steps)
    {
      ResponseSettings settings;
      settings.time_step = parameters.time_step;
      settings.interpolation = force_interpolation(parameters.force_shape);
      settings.n_steps = n_steps;
      settings.theta = parameters.theta;
      settings.memory = std::lround(parameters.memory / parameters.time_step);
      if (settings.memory > 0 && std::any_of(model.poles.begin(), model.poles.end(), is_rigid_motion))
        throw InputError(
            "Modal convolution/Memory is given, but the body is free and forgets no force that has moved "
            "it: leave it out.");
      const double kept =
          double(settings.memory > 0 ? settings.memory : n_steps) * model.n_rows() * model.n_rows();
      if (parameters.is_convolution() && kept > 2e8)
        throw InputError(
            "Modal convolution/Memory asks for more than 200 million samples of the Green's functions: "
            "give a shorter one or take the modal recursion.");
      return create_response(parameters.method, model,
                             parameters.initial_state == "at rest" ? state_at_rest(model)
                                                                   : state_in_equilibrium(model),
                             settings, *parameters.methods);
    }

    /// S with what the normal law yields on its diagonal: its one compliance if it is linear. Constant forces only need some, so
    /// that of the touch will do; for linear ones a law that stiffens counts as rigid.
    DenseMatrix least_compliance(const BodyInContact &model, const unsigned int n_points,
                                 const NormalLaw &law, const ForceInterpolation interpolation)
    {
      DenseMatrix S = model.residual;
      if (S.m() == 0)
        S.reinit(model.n_rows(), model.n_rows());
      if (law.is_linear() || interpolation == ForceInterpolation::constant)
        for (unsigned int i = 0; i < n_points; ++i)
          S(i, i) += law.compression(0).compliance;
      return S;
    }

    void check_force_interpolation(const ModalConvolutionParameters &parameters, const BodyInContact &model,
                                   const unsigned int n_points, const NormalLaw &law)
    {
      const ForceInterpolation interpolation = force_interpolation(parameters.force_shape);
      const DenseMatrix S = least_compliance(model, n_points, law, interpolation);
      const double longest = parameters.takes_theta()
                                 ? longest_theta_step(S, interpolation, parameters.theta)
                                 : longest_step(S, initial_derivative(model, 1), interpolation);
      if (parameters.time_step <= longest)
        return;
      std::ostringstream text;
      text << "Modal convolution/Force shape is " << parameters.force_shape
           << ", with which the contact forces ring ";
      if (longest > 0)
        text << "at steps above " << longest << " s: take a shorter Time step or Force shape = impulse.";
      else
      {
        unsigned int rigid = 0;
        while (rigid + 1 < S.m() && S(rigid, rigid) > 0)
          ++rigid;
        text << "as contact point " << rigid % n_points << " is rigid"
             << (rigid < n_points ? "" : " along the road") << ": take Force shape = impulse, or give a "
             << (rigid < n_points ? "" : "tangential ") << "tread stiffness.";
      }
      throw InputError(text.str());
    }
  } // namespace

  RoadStepper::RoadStepper(const ModalConvolutionParameters &parameters,
                           const ContactSolverParameters &solver_parameters, const BodyInContact &model,
                           const unsigned int n_points, const unsigned long n_steps, const RoadLaws &laws,
                           const double sliding_speed)
      : response(make_response(parameters, model, n_steps)),
        contact(normal_block(response->compliance(), n_points), at_step(parameters.time_step)),
        is_common(parameters.contact_solver == "common" || model.n_rows() > n_points ||
                  !laws.normal->is_rigid()),
        n(n_points), step(parameters.time_step), sliding_speed(sliding_speed),
        solver_parameters(solver_parameters),
        problem(road_contact_problem(response->compliance(), n_points, laws, parameters.time_step)),
        is_linear(force_interpolation(parameters.force_shape) == ForceInterpolation::linear),
        residual_flexibility(model.residual)
  {
    check_force_interpolation(parameters, model, n_points, *laws.normal);
  }

  void RoadStepper::run(const unsigned int n_steps, const double *heights, double *displacements,
                        double *forces)
  {
    if (is_common)
      run_common(n_steps, heights, displacements, forces, nullptr, nullptr);
    else if (n == 1)
      run_one(n_steps, heights, displacements, forces);
    else
      run_many(n_steps, heights, displacements, forces);
  }

  void RoadStepper::run_common(const unsigned int n_steps, const double *heights, double *displacements,
                               double *forces, double *tangential_displacements, double *tangential_forces)
  {
    // nothing is left of the steps before: a resumed run, which begins with a block, has the same solver
    if (problem.friction_law)
      problem.mu.assign(n, problem.friction_law->at_rest());
    const std::unique_ptr<ContactSolver> solver = create_contact_solver(solver_parameters);
    ContactSolution solution;
    std::vector<double> q(response->n_rows());
    const double *const free = response->free_displacement();
    const bool has_friction = tangential_forces != nullptr;
    for (unsigned int i = 0; has_friction && i < n; ++i)
    {
      q[i] = (forces - n)[i];
      q[n + i] = (tangential_forces - n)[i];
    }
    // until it has been solved q holds the forces of the step before
    const std::function<std::vector<double>(const ContactSolution &)> speed =
        [&](const ContactSolution &found) { return law_speed(found, q); };
    for (unsigned int k = 0; k < n_steps; ++k, heights += n, displacements += n, forces += n)
    {
      const double *const before = tangential_displacements - (has_friction ? n : 0);
      for (unsigned int i = 0; i < n; ++i)
        problem.b[i] = free[i] - heights[i];
      for (unsigned int i = 0; has_friction && i < n; ++i)
        problem.b[n + i] = (free[n + i] - before[i]) / step + sliding_speed;
      solution = solve_with_friction_of_speed(problem, *solver, solution, speed);
      if (!solution.converged)
        throw ConvergenceError("The contact of a step did not converge, relative residual " +
                               std::to_string(solution.residual) + ".");
      for (unsigned int i = 0; i < n; ++i)
      {
        forces[i] = q[i] = solution.R[i];
        displacements[i] = solution.y[i] + heights[i];
        closed_points += forces[i] > 0;
      }
      for (unsigned int i = 0; has_friction && i < n; ++i)
      {
        const double slip = solution.y[n + i];
        tangential_forces[i] = q[n + i] = solution.R[n + i];
        tangential_displacements[i] = before[i] + step * (slip - sliding_speed);
        // of linear forces the mean
        const double force = is_linear ? 0.5 * (q[n + i] + (tangential_forces - n)[i]) : q[n + i];
        dissipation -= step * force * slip;
        sticking_points += solution.status[i] == ContactStatus::stick;
      }
      if (has_friction)
      {
        tangential_displacements += n;
        tangential_forces += n;
      }
      response->advance(q.data());
      iterations += solution.iterations;
      residual = std::max(residual, solution.residual);
    }
  }

  /// The slip speed that counts in the coefficient of friction: without the rate of what has no inertia
  /// (contact/friction_of_speed.h).
  std::vector<double> RoadStepper::law_speed(const ContactSolution &solution,
                                             const std::vector<double> &forces_before) const
  {
    std::vector<double> speed(n);
    for (unsigned int i = 0; i < n; ++i)
    {
      double slip = solution.y[n + i];
      for (unsigned int j = 0; j < forces_before.size() && residual_flexibility.m() > 0; ++j)
        slip -= residual_flexibility(n + i, j) * (solution.R[j] - forces_before[j]) / step;
      speed[i] = std::abs(slip);
    }
    return speed;
  }

  void RoadStepper::run_one(const unsigned int n_steps, const double *heights, double *displacements,
                            double *forces)
  {
    closed_points += response->advance_in_contact(n_steps, heights, displacements, forces);
    if (!std::isfinite(response->free_displacement()[0]))
      throw ConvergenceError(
          "The motion is no longer finite: take a shorter Time step or another Force shape.");
  }

  void RoadStepper::run_many(const unsigned int n_steps, const double *heights, double *displacements,
                             double *forces)
  {
    const double *const free = response->free_displacement();
    for (unsigned int k = 0; k < n_steps; ++k, heights += n, displacements += n, forces += n)
    {
      for (unsigned int i = 0; i < n; ++i)
        displacements[i] = free[i] - heights[i];
      contact.solve(displacements, forces);
      for (unsigned int i = 0; i < n; ++i)
        displacements[i] += heights[i];
      response->advance(forces);
      closed_points += contact.n_closed();
      residual = std::max(residual, contact.residual());
    }
    iterations = contact.corrections();
  }
} // namespace vibrocontact
