/// Times of the propagators with contact, histories stored, profile tabulated; medians in nanoseconds.
///
///   propagator_benchmark [repetitions, default 7]
///
/// Oscillator of the tyre paper at its four rows (step, memory); many modes at one and three points; a patch of 100 points
/// with tread and 404 rolling poles; the event-located oscillator on the sine.

#include <vibrocontact/analyses/modal_convolution/modal_convolution.h>
#include <vibrocontact/analyses/modal_convolution/road_contact.h>
#include <vibrocontact/base/processor_clock.h>
#include <vibrocontact/contact/active_set.h>
#include <vibrocontact/numerics/wide_loops.h>
#include <vibrocontact/propagators/propagator_types.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace vibrocontact;

namespace
{
  unsigned int repetitions = 7;

  /// Nanoseconds per step, median over the repetitions.
  double time_steps(Propagator &response, const unsigned int n_steps, const double h, const double depth)
  {
    const unsigned int n = response.n_rows();
    ContactProblem problem = road_contact_problem(response.compliance(), n, {}, h);
    ActiveSetSolver contact;
    contact.prepare(problem);
    ContactSolution solution;
    std::vector<double> road(n_steps * n), u(n_steps * n), q(n_steps * n), times;
    for (unsigned int k = 0; k < n_steps; ++k)
      for (unsigned int i = 0; i < n; ++i)
        road[k * n + i] = depth * (std::sin(25 * k * h + 0.01 * i) - 1e-4 * std::pow(i - 0.5 * n, 2));
    const double *const free = response.free_displacement();
    double *const b = problem.b.data();
    for (unsigned int repetition = 0; repetition < repetitions; ++repetition)
    {
      const double begin = processor_seconds();
      if (n == 1)
        response.advance_in_contact(n_steps, road.data(), u.data(), q.data());
      for (unsigned int k = 0; k < n_steps && n > 1; ++k)
      {
        for (unsigned int i = 0; i < n; ++i)
          b[i] = free[i] - road[k * n + i];
        contact.solve(problem, solution);
        const double *const y = solution.y.data(), *const R = solution.R.data();
        for (unsigned int i = 0; i < n; ++i)
        {
          u[k * n + i] = y[i] + road[k * n + i];
          q[k * n + i] = R[i];
        }
        response.advance(R);
      }
      times.push_back((processor_seconds() - begin) / n_steps);
    }
    std::sort(times.begin(), times.end());
    return 1e9 * times[times.size() / 2];
  }

  BodyInContact modes(const unsigned int n_rows, const unsigned int n_modes, const double tread)
  {
    std::vector<double> omega, zeta;
    DenseMatrix trace(n_rows, n_modes), residual(n_rows, n_rows);
    for (unsigned int k = 0; k < n_modes; ++k)
    {
      omega.push_back(600 + 60 * k);
      zeta.push_back(0.05);
      for (unsigned int i = 0; i < n_rows; ++i)
        trace(i, k) = std::cos(0.05 * k * (i + 0.3) + k);
    }
    for (unsigned int i = 0; i < n_rows; ++i)
      residual(i, i) = tread;
    return by_poles({omega, zeta, trace, {}, residual, {}});
  }
} // namespace

int main(int argc, char *argv[])
{
  if (argc > 1)
    repetitions = std::atoi(argv[1]);
  std::printf("registers: %s\n", wide_loops_name());
  DenseMatrix trace(1, 1);
  trace(0, 0) = 1;
  const BodyInContact oscillator = by_poles({{std::sqrt(4e5)}, {0.02}, trace, {-9.81}, DenseMatrix(), {}});
  struct Row
  {
    double h;
    unsigned int n_steps, memory;
  };
  for (const Row &row :
       {Row{1e-4, 2000, 1900}, {1e-4, 20000, 1900}, {1e-5, 20000, 19000}, {1e-5, 200000, 19000}})
  {
    PropagatorSettings settings;
    settings.time_step = row.h;
    settings.n_steps = row.n_steps;
    settings.memory = row.memory;
    double ns[3];
    for (unsigned int k = 0; k < 3; ++k)
    {
      const auto response = propagator_types()[k].create(oscillator, state_at_rest(oscillator), settings);
      ns[k] = time_steps(*response, row.n_steps, row.h, 5e-3);
    }
    std::printf("h %g s, %u steps, memory %u: modal %.2f, direct %.1f (%.3f per stored force), block %.1f ns "
                "per step; "
                "direct / modal %.1f\n",
                row.h, row.n_steps, row.memory, ns[0], ns[1], ns[1] / row.memory, ns[2], ns[1] / ns[0]);
  }
  for (const unsigned int n_modes : {128u, 256u, 512u})
    for (const unsigned int n_rows : {1u, 3u})
    {
      PropagatorSettings settings;
      settings.time_step = 2e-5;
      const BodyInContact model = modes(n_rows, n_modes, 1e-7);
      settings.interpolation = ForceInterpolation::constant;
      const auto response = create_propagator("modal recursion", model, state_at_rest(model), settings);
      const double ns = time_steps(*response, 20000, 2e-5, 1e-4);
      std::printf("%u modes, %u points: %.1f ns per step, %.3f per mode\n", n_modes, n_rows, ns,
                  ns / n_modes);
    }
  {
    PropagatorSettings settings;
    settings.time_step = 1 / 51200.;
    settings.interpolation = ForceInterpolation::linear;
    BodyInContact model = modes(100, 202, 1 / 40320.);
    for (unsigned int k = 0; k < model.n_poles(); ++k)
      for (unsigned int i = 0; i < 100; ++i)
        model.right(i, k) *= std::polar(1., 0.01 * k * i);
    const auto response = create_propagator("modal recursion", model, state_at_rest(model), settings);
    std::printf("100 points, 202 complex shapes: %.2f us per step\n",
                1e-3 * time_steps(*response, 5000, settings.time_step, 3e-3));
  }
  for (const double speed : {0.1, 1., 2., 3.})
  {
    RoadParameters sine;
    sine.profile = "expression";
    sine.expression = "5e-3*sin(2*pi*s/0.025)";
    sine.speed = speed;
    ModalConvolutionParameters parameters;
    parameters.method = "event located";
    parameters.time_step = 1e-4;
    parameters.end_time = 10;
    const Road road(sine, {0.}, {0.}, parameters.end_time);
    std::vector<double> times;
    for (unsigned int repetition = 0; repetition < repetitions; ++repetition)
    {
      ModalConvolution motion(parameters, {}, oscillator, road);
      while (motion.advance(4096, [](const ModalConvolutionLines &) {}))
        ;
      times.push_back(motion.result().seconds / parameters.end_time);
    }
    std::sort(times.begin(), times.end());
    std::printf("event located, %g m/s: %.3f ms per simulated second, least %.3f\n", speed,
                1e3 * times[times.size() / 2], 1e3 * times[0]);
  }
}
