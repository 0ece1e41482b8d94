#include <vibrocontact/analyses/modal_convolution/road_contact.h>
#include <vibrocontact/analyses/modal_convolution/road_stepper.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/named_table.h>
#include <vibrocontact/contact/active_set.h>
#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/friction_of_speed.h>
#include <vibrocontact/propagators/propagator_types.h>
#include <vibrocontact/propagators/step_weights.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace vibrocontact
{
  namespace
  {
    DenseMatrix first_block(const DenseMatrix &matrix, const unsigned int size)
    {
      DenseMatrix block(size, size);
      for (unsigned int i = 0; i < size; ++i)
        for (unsigned int j = 0; j < size; ++j)
          block(i, j) = matrix(i, j);
      return block;
    }

    /// The gradients along the road of a body that rolls, as further rows, which no force acts on.
    BodyInContact with_gradient_rows(const BodyInContact &model)
    {
      if (model.gradient.m() == 0)
        return model;
      const unsigned int n_rows = model.n_rows(), n = n_rows / 2, p = model.n_poles();
      BodyInContact result = model;
      result.gradient.reinit(0, 0);
      result.residual_gradient.reinit(0, 0);
      result.residual_load.clear();
      result.right.reinit(n_rows + n, p);
      result.left.reinit(n_rows + n, p);
      result.residual.reinit(n_rows + n, n_rows + n);
      for (unsigned int i = 0; i < n_rows + n; ++i)
      {
        for (unsigned int k = 0; k < p; ++k)
        {
          result.right(i, k) = i < n_rows ? model.right(i, k) : model.gradient(i - n, k);
          result.left(i, k) = i < n_rows ? model.left(i, k) : 0.;
        }
        for (unsigned int j = 0; j < n_rows && model.residual.m() > 0; ++j)
          result.residual(i, j) = i < n_rows ? model.residual(i, j) : model.residual_gradient(i - n, j);
      }
      return result;
    }

    /// s = factor s + now R + later R of the step before, of a rest S s: beta s' + s = R, or R itself.
    StepWeights rest_weights(const BodyInContact &model, const double time_step,
                             const ForceInterpolation interpolation)
    {
      if (!(model.relaxation > 0))
        return {{0.}, {1.}, {0.}};
      BodyInContact alone;
      alone.relaxation = model.relaxation;
      alone.poles = {-1 / model.relaxation};
      StepWeights weights = step_weights(alone, time_step, interpolation);
      weights.now[0] /= model.relaxation;
      weights.later[0] /= model.relaxation;
      return weights;
    }

    std::string title(const double time_step)
    {
      std::ostringstream text;
      text << "contact with the road at Modal convolution/Time step " << time_step << " s";
      return text.str();
    }

    std::unique_ptr<Propagator> make_propagator(const ModalConvolutionParameters &parameters,
                                                const BodyInContact &model, const unsigned long n_steps)
    {
      PropagatorSettings settings;
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
      return create_propagator(parameters.method, model, parameters.first_state(model), settings,
                               *parameters.methods);
    }

    /// S with what the normal law yields on its diagonal: its one compliance if it is linear. Constant forces only need some, so
    /// that of the touch will do; for linear ones a law that stiffens counts as rigid.
    DenseMatrix least_compliance(const BodyInContact &model, const unsigned int n_points,
                                 const PointLaws<NormalLaw> &law, const ForceInterpolation interpolation)
    {
      DenseMatrix S = model.residual;
      if (S.m() == 0)
        S.reinit(model.n_rows(), model.n_rows());
      for (unsigned int i = 0; i < n_points; ++i)
        if (law[i].is_linear() || interpolation == ForceInterpolation::constant)
          S(i, i) += law[i].compression(0).compliance;
      return S;
    }

    void check_force_interpolation(const ModalConvolutionParameters &parameters, const BodyInContact &model,
                                   const unsigned int n_points, const PointLaws<NormalLaw> &law)
    {
      const ForceInterpolation interpolation = force_interpolation(parameters.force_shape);
      DenseMatrix S = least_compliance(model, n_points, law, interpolation);
      // what relaxes holds linear forces less (doc/theory.md, "Time steps")
      if (interpolation == ForceInterpolation::linear && model.residual.m() > 0)
        S.add(parameters.time_step / (parameters.time_step + 2 * model.relaxation) - 1, model.residual);
      const double longest = parameters.takes_theta()
                                 ? critical_theta_step(S, interpolation, parameters.theta)
                                 : critical_time_step(S, initial_derivative(model, 1), interpolation);
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
                           const double sliding_speed, const double speed)
      : propagator(make_propagator(parameters, with_gradient_rows(model), n_steps)),
        compliance(first_block(propagator->compliance(), model.n_rows())),
        is_common(parameters.contact_solver == "common" || model.n_rows() > n_points ||
                  !laws.normal.all(&NormalLaw::is_rigid)),
        n(n_points), step(parameters.time_step), sliding_speed(sliding_speed),
        rolling_speed(model.gradient.m() > 0 ? speed : 0.),
        problem(road_contact_problem(propagator->compliance(), n_points, laws, parameters.time_step,
                                     rolling_speed)),
        is_linear(force_interpolation(parameters.force_shape) == ForceInterpolation::linear),
        residual_flexibility(model.residual),
        rest(rest_weights(model, step, force_interpolation(parameters.force_shape)))
  {
    problem.title = title(step);
    ContactSolverParameters own = solver_parameters;
    if (is_common)
      check_unique_forces(first_block(compliance, n), "in '" + problem.title + "'");
    else
    {
      // section Contact/Solver is not this contact's
      own.method = parameters.contact_solver;
      own.tolerance = ContactSolverParameters().tolerance;
    }
    const unsigned int fewest = find_named(*own.methods, own.method, "contact solver").points_by_products;
    if (fewest > 0 && n >= fewest)
      use_even_line(problem, compliance);
    solver = create_contact_solver(own);
    solver->prepare(problem);
    check_force_interpolation(parameters, model, n_points, laws.normal);
  }

  void RoadStepper::begin_block()
  {
    for (unsigned int i = 0; i < n && problem.friction_law; ++i)
      problem.mu[i] = problem.friction_law[i].at_rest();
    solver->renew();
    solution = ContactSolution();
  }

  void RoadStepper::run(const unsigned int n_steps, const double *heights, double *displacements,
                        double *forces)
  {
    if (is_common || n > 1)
      return run_steps(n_steps, heights, displacements, forces, nullptr, nullptr);
    closed_points += propagator->advance_in_contact(n_steps, heights, displacements, forces);
    if (!std::isfinite(propagator->free_displacement()[0]))
      throw ConvergenceError(
          "The motion is no longer finite: take a shorter Time step or another Force shape.");
  }

  void RoadStepper::run_steps(const unsigned int n_steps, const double *heights, double *displacements,
                              double *forces, double *tangential_displacements, double *tangential_forces)
  {
    const double *const free = propagator->free_displacement();
    double *const b = problem.b.data();
    const bool has_friction = tangential_forces != nullptr, rolls = rolling_speed != 0;
    std::vector<double> all_forces(propagator->n_rows(), 0.);
    std::vector<double> forces_before(has_friction ? 2 * n : 0);
    for (unsigned int i = 0; has_friction && i < n; ++i)
    {
      forces_before[i] = (forces - n)[i];
      forces_before[n + i] = (tangential_forces - n)[i];
    }
    if (rest.factor[0] == 0. || relaxed.empty())
      relaxed = forces_before;
    const std::function<std::vector<double>(const ContactSolution &)> slip_speed =
        [&](const ContactSolution &found) { return law_speed(found, forces_before); };
    for (unsigned int k = 0; k < n_steps; ++k, heights += n, displacements += n, forces += n)
    {
      const double *const before = tangential_displacements - (has_friction ? n : 0);
      for (unsigned int i = 0; i < n; ++i)
        b[i] = free[i] - heights[i];
      for (unsigned int i = 0; has_friction && i < n; ++i)
        b[n + i] =
            (free[n + i] - before[i]) / step + sliding_speed - (rolls ? rolling_speed * free[2 * n + i] : 0.);
      solve_with_friction_of_speed(problem, *solver, solution, slip_speed);
      if (!solution.converged)
        throw ConvergenceError("The contact of a step did not converge, relative residual " +
                               std::to_string(solution.residual) + ".");
      const double *const R = solution.R.data(), *const y = solution.y.data();
      std::copy(R, R + n, forces);
      unsigned long closed = 0;
      for (unsigned int i = 0; i < n; ++i)
      {
        displacements[i] = y[i] + heights[i];
        closed += R[i] > 0;
      }
      closed_points += closed;
      for (unsigned int i = 0; has_friction && i < n; ++i)
      {
        const double slip = y[n + i];
        tangential_forces[i] = R[n + i];
        double flow = rolls ? free[2 * n + i] : 0.;
        for (unsigned int j = 0; rolls && j < 2 * n; ++j)
          flow += propagator->compliance()(2 * n + i, j) * R[j];
        tangential_displacements[i] = before[i] + step * (slip - sliding_speed + rolling_speed * flow);
        // of linear forces the mean
        const double force =
            is_linear ? 0.5 * (tangential_forces[i] + (tangential_forces - n)[i]) : tangential_forces[i];
        dissipation -= step * force * slip;
        sticking_points += solution.status[i] == ContactStatus::stick;
      }
      if (has_friction)
      {
        for (unsigned int i = 0; i < 2 * n; ++i)
          relaxed[i] = relaxed_after(i, R, forces_before);
        forces_before.assign(solution.R.begin(), solution.R.end());
        tangential_displacements += n;
        tangential_forces += n;
      }
      std::copy(R, R + solution.R.size(), all_forces.begin());
      propagator->advance(all_forces.data());
      iterations += solution.iterations;
      residual = std::max(residual, solution.residual);
    }
  }

  double RoadStepper::relaxed_after(const unsigned int row, const double *const forces,
                                    const std::vector<double> &forces_before) const
  {
    return rest.factor[0].real() * relaxed[row] + rest.now[0].real() * forces[row] +
           rest.later[0].real() * forces_before[row];
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
        slip -= residual_flexibility(n + i, j) *
                (relaxed_after(j, solution.R.data(), forces_before) - relaxed[j]) / step;
      speed[i] = std::abs(slip);
    }
    return speed;
  }
} // namespace vibrocontact
