#include <vibrocontact/base/named_table.h>
#include <vibrocontact/base/wall_clock.h>
#include <vibrocontact/contact/contact_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  void ContactSolverParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter(
        "Method", method,
        "How the discrete contact problem is solved; automatic chooses by its size and laws. Units: none.",
        Selection(selection(names_of(*methods))));
    prm.add_parameter("Tolerance", tolerance,
                      "Relative residual of the projections to be reached. Units: none.",
                      Double(1e-15, 1e-2));
    prm.add_parameter("Max Newton iterations", max_newton_iterations,
                      "Newton steps after which a solve counts as not converged. Units: none.", Integer(1));
    prm.add_parameter("Max fixed point iterations", max_fixed_point_iterations,
                      "Fixed-point steps after which a solve counts as not converged. Units: none.",
                      Integer(1));
    prm.add_parameter(
        "Force change", force_change,
        "The fixed point stops when its forces change by less than this, relatively. Units: none.",
        Double(1e-16, 1e-2));
  }

  ContactSolution ContactSolver::solved(const ContactProblem &problem, ContactSolution start)
  {
    const auto begin = WallClock::now();
    solve(problem, start);
    start.seconds = seconds_since(begin);
    return start;
  }

  void frictionless_start(const ContactProblem &problem, const double tolerance, ContactSolution &state)
  {
    const unsigned int n = problem.n_points(), n_rows = problem.n_rows();
    state.R.reinit(n_rows);
    DenseVector &p = state.R;
    DenseVector direction(n_rows), image(n_rows), response;

    // Begin with the half ellipsoid over the points whose gap is below a quarter of the largest one (or that
    // are pressed in).
    std::vector<double> gaps(problem.b.begin(), problem.b.begin() + n);
    for (unsigned int i = 0; i < n && !problem.force_given(); ++i)
      gaps[i] += problem.approach * (1 - problem.approach_of(i)[0]);
    const double closest = *std::min_element(gaps.begin(), gaps.end());
    const double farthest = *std::max_element(gaps.begin(), gaps.end());
    const double level = problem.force_given() ? closest + 0.25 * (farthest - closest) : problem.approach;
    // points under the hub are brought to the given force
    const auto share = [&](const unsigned int i) { return problem.share_of(i)[0]; };
    const auto load = [&](const double factor)
    {
      for (unsigned int i = 0; i < n; ++i)
        if (share(i) != 0)
          p[i] *= factor;
    };
    double total = 0;
    for (unsigned int i = 0; i < n; ++i)
    {
      const double depth =
          level > closest ? (level - gaps[i]) / (level - closest) : (problem.force_given() ? 1 : 0);
      p[i] = depth > 0 ? std::sqrt(depth) : 0;
      total += problem.force_given() ? share(i) * p[i] : p[i];
    }
    if (!(total > 0))
    {
      p = 0;
      return;
    }
    if (problem.force_given())
      load(problem.normal_force / total);
    else
      p *= (problem.approach - closest) / problem.A->mean_diagonal(0) / std::sqrt(total);

    double previous_norm = 1, keep = 0;
    for (unsigned int iteration = 0; iteration < 200; ++iteration)
    {
      contact_response(problem, p, 0., response);
      std::vector<unsigned int> loaded;
      double mean = 0, weight = 0;
      for (unsigned int i = 0; i < n; ++i)
        if (p[i] > 0)
        {
          loaded.push_back(i);
          mean += share(i) * response[i];
          weight += share(i) * share(i);
        }
      if (loaded.empty() || (problem.force_given() && !(weight > 0)))
        break;
      state.approach = problem.force_given() ? mean / weight : problem.approach;
      const auto gap = [&](const unsigned int i)
      { return response[i] - state.approach * problem.approach_of(i)[0]; };
      double norm = 0;
      for (const unsigned int i : loaded)
        norm += std::pow(gap(i), 2);
      for (unsigned int i = 0; i < n; ++i)
        direction[i] = p[i] > 0 ? gap(i) + keep * norm / previous_norm * direction[i] : 0;
      previous_norm = norm;
      problem.A->vmult(image, direction, loaded);
      double numerator = 0, denominator = 0, image_mean = 0;
      for (const unsigned int i : loaded)
        image_mean += share(i) * image[i] / weight;
      for (const unsigned int i : loaded)
      {
        numerator += gap(i) * direction[i];
        denominator += (image[i] - (problem.force_given() ? share(i) * image_mean : 0)) * direction[i];
      }
      if (!(denominator > 0))
        break;
      const double step = numerator / denominator;
      keep = 1;
      double change = 0, sum = 0, pressed = 0;
      for (const unsigned int i : loaded)
      {
        const double next = std::max(p[i] - step * direction[i], 0.);
        change += std::abs(next - p[i]);
        p[i] = next;
      }
      for (unsigned int i = 0; i < n; ++i)
      {
        if (p[i] == 0 && gap(i) < 0 && step > 0)
        {
          // an unloaded point that overlaps joins the contact, and the conjugate direction starts afresh
          bool was_loaded = std::binary_search(loaded.begin(), loaded.end(), i);
          if (!was_loaded)
          {
            p[i] = -step * gap(i);
            keep = 0;
          }
        }
        sum += p[i];
        pressed += share(i) * p[i];
      }
      if (sum == 0 || (problem.force_given() && !(pressed > 0)))
        break;
      if (problem.force_given())
        load(problem.normal_force / pressed);
      if (keep == 1 && change < tolerance * sum)
        break;
    }
  }
} // namespace vibrocontact
