#include <vibrocontact/analyses/contact_stepper.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  namespace
  {
    // Psi diag(gain) Psi^T
    DenseMatrix modal_compliance(const DenseMatrix &trace, const std::vector<ModalStep> &steps,
                                 const unsigned int component)
    {
      DenseMatrix result(trace.m());
      DenseMatrix scaled(trace.m(), trace.n());
      for (unsigned int k = 0; k < trace.n(); ++k)
        for (unsigned int i = 0; i < trace.m(); ++i)
          scaled(i, k) = trace(i, k) * steps[k].g1[component];
      scaled.mTmult(result, trace);
      return result;
    }
  } // namespace

  ContactStepper::ContactStepper(const ContactPair &pair, const CreepScheme &scheme,
                                 const ContactParameters &contact, const std::vector<ModalStep> &steps,
                                 const double h, const double speed)
      : pair(pair), scheme(scheme), steps(steps), h(h), speed(speed), response_to_q(pair.modal_trace),
        response_to_v(pair.modal_trace)
  {
    const ContactInterface &interface = pair.interface;
    const ContactGrid &grid = interface.grid;
    const unsigned int n = grid.n_points();
    convert_to_slip_rows(grid, scheme, speed, response_to_q);
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
      std::fill_n(&response_to_v(0, k), n, 0.);

    DenseMatrix matrix = pair.residual_flexibility, velocity(3 * n);
    if (pair.n_modes() > 0)
    {
      matrix.add(1., modal_compliance(pair.modal_trace, steps, 0));
      velocity = modal_compliance(pair.modal_trace, steps, 1);
    }
    convert_to_slip_rows(grid, scheme, speed, matrix);
    for (unsigned int j = 0; j < 3 * n; ++j)
      for (unsigned int i = n; i < 3 * n; ++i)
        matrix(i, j) += velocity(i, j) + pair.residual_flexibility(i, j) / h;

    Creepage none;
    none.speed = speed;
    problem = rolling_problem(std::make_shared<DenseContactOperator>(std::move(matrix)), interface, scheme,
                              none, contact);
    constant_response = problem.b;
  }

  void complete(const ContactPair &pair, DynamicState &state)
  {
    const unsigned int n = pair.n_points(), n_modes = pair.n_modes();
    state.normal_modal_force.reinit(n_modes);
    state.tangential_modal_force.reinit(n_modes);
    // only loaded columns count
    state.residual_displacement.reinit(3 * n);
    for (unsigned int j = 0; j < 3 * n; ++j)
      if (state.R[j] != 0)
      {
        const double *const column = &pair.residual_flexibility(0, j);
        for (unsigned int i = 0; i < 3 * n; ++i)
          state.residual_displacement[i] += column[i] * state.R[j];
      }
    if (n_modes == 0)
      return;
    DenseVector normal(state.R), tangential(state.R);
    std::fill(normal.begin() + n, normal.end(), 0.);
    std::fill(tangential.begin(), tangential.begin() + n, 0.);
    pair.modal_trace.Tvmult(state.normal_modal_force, normal);
    pair.modal_trace.Tvmult(state.tangential_modal_force, tangential);
  }

  void set_powers(const ContactPair &pair, const DenseVector &rigid_slip, const DenseVector &residual_rate,
                  DynamicState &state)
  {
    const unsigned int n = pair.n_points();
    state.friction_power = state.creepage_power = 0;
    double rate = 0;
    for (unsigned int i = n; i < 3 * n; ++i)
    {
      state.friction_power -= state.R[i] * state.contact.y[i];
      state.creepage_power -= state.R[i] * rigid_slip[i];
      rate += state.R[i] * residual_rate[i];
    }
    for (unsigned int k = 0; k < pair.n_modes(); ++k)
      rate += state.tangential_modal_force[k] * state.v[k];
    state.transport_power = state.friction_power - state.creepage_power + rate;
  }

  double longest_quiet_step(const ContactPair &pair)
  {
    double longest = std::numeric_limits<double>::infinity();
    for (unsigned int i = 0; i < pair.n_points(); ++i)
    {
      double mobility = 0;
      for (unsigned int k = 0; k < pair.n_modes(); ++k)
        mobility += pair.modal_trace(i, k) * pair.modal_trace(i, k);
      if (mobility > 0)
        longest =
            std::min(longest, 2.7 * std::sqrt(std::max(0., pair.residual_flexibility(i, i)) / mobility));
    }
    return longest;
  }

  const ContactSolution &ContactStepper::advance(DynamicState &state, const Drive &drive,
                                                 ContactSolver &solver)
  {
    const unsigned int n = pair.n_points(), n_modes = pair.n_modes();
    // modes under the forces of the beginning of the step and the constant loads
    DenseVector q(n_modes), v(n_modes);
    for (unsigned int k = 0; k < n_modes; ++k)
    {
      const ModalStep &s = steps[k];
      const double p1 = pair.modal_load[k],
                   p0 = p1 + state.normal_modal_force[k] + state.tangential_modal_force[k];
      q[k] = s.T[0][0] * state.q[k] + s.T[0][1] * state.v[k] + s.g0[0] * p0 + s.g1[0] * p1;
      v[k] = s.T[1][0] * state.q[k] + s.T[1][1] * state.v[k] + s.g0[1] * p0 + s.g1[1] * p1;
    }

    const DenseVector rigid = rigid_slip(pair.interface.grid, scheme, drive.creepage);
    problem.b = rigid;
    problem.b += constant_response;
    if (n_modes > 0)
    {
      response_to_q.vmult(problem.b, q, true);
      response_to_v.vmult(problem.b, v, true);
    }
    for (unsigned int i = n; i < 3 * n; ++i)
      problem.b[i] -= state.residual_displacement[i] / h;
    for (unsigned int i = 0; i < drive.gap.size(); ++i)
      problem.b[i] += drive.gap[i];
    problem.normal_force = drive.normal_force;
    problem.approach = drive.normal_force > 0 ? state.contact.approach : drive.approach;
    state.contact = solver.solve(problem, state.contact);

    state.R = state.contact.R;
    const DenseVector previous = state.residual_displacement;
    complete(pair, state);
    for (unsigned int k = 0; k < n_modes; ++k)
    {
      const double force = state.normal_modal_force[k] + state.tangential_modal_force[k];
      state.q[k] = q[k] + steps[k].g1[0] * force;
      state.v[k] = v[k] + steps[k].g1[1] * force;
    }
    state.time += h;

    DenseVector rate = state.residual_displacement;
    rate -= previous;
    rate /= h;
    set_powers(pair, rigid, rate, state);
    return state.contact;
  }
} // namespace vibrocontact
