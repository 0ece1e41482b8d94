#include <vibrocontact/base/named_table.h>
#include <vibrocontact/contact/contact_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vibrocontact
{
  void ContactSolverParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Method", method, "How the discrete contact problem is solved. Units: none.",
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

  void frictionless_start(const ContactProblem &problem, const double tolerance, ContactSolution &state)
  {
    const unsigned int n = problem.n_points();
    state.R.reinit(3 * n);
    DenseVector &p = state.R;
    DenseVector direction(3 * n), image(3 * n), response;

    // Begin with the half ellipsoid over the points whose gap is below a quarter of the largest one (or that
    // are pressed in).
    const double closest = *std::min_element(problem.b.begin(), problem.b.begin() + n);
    const double farthest = *std::max_element(problem.b.begin(), problem.b.begin() + n);
    const double level = problem.force_given() ? closest + 0.25 * (farthest - closest) : problem.approach;
    double total = 0;
    for (unsigned int i = 0; i < n; ++i)
    {
      const double depth =
          level > closest ? (level - problem.b[i]) / (level - closest) : (problem.force_given() ? 1 : 0);
      p[i] = depth > 0 ? std::sqrt(depth) : 0;
      total += p[i];
    }
    if (total == 0)
      return;
    if (problem.force_given())
      p *= problem.normal_force / total;
    else
      p *= (problem.approach - closest) / problem.A->mean_diagonal(0) / std::sqrt(total);

    double previous_norm = 1, keep = 0;
    for (unsigned int iteration = 0; iteration < 200; ++iteration)
    {
      contact_response(problem, p, 0., response);
      std::vector<unsigned int> loaded;
      double mean = 0;
      for (unsigned int i = 0; i < n; ++i)
        if (p[i] > 0)
        {
          loaded.push_back(i);
          mean += response[i];
        }
      if (loaded.empty())
        break;
      state.approach = problem.force_given() ? mean / loaded.size() : problem.approach;
      double norm = 0;
      for (const unsigned int i : loaded)
        norm += std::pow(response[i] - state.approach, 2);
      for (unsigned int i = 0; i < n; ++i)
        direction[i] =
            p[i] > 0 ? response[i] - state.approach + keep * norm / previous_norm * direction[i] : 0;
      previous_norm = norm;
      problem.A->vmult(image, direction, loaded);
      double numerator = 0, denominator = 0, image_mean = 0;
      for (const unsigned int i : loaded)
        image_mean += image[i] / loaded.size();
      for (const unsigned int i : loaded)
      {
        numerator += (response[i] - state.approach) * direction[i];
        denominator += (image[i] - (problem.force_given() ? image_mean : 0)) * direction[i];
      }
      if (!(denominator > 0))
        break;
      const double step = numerator / denominator;
      keep = 1;
      double change = 0, sum = 0;
      for (const unsigned int i : loaded)
      {
        const double next = std::max(p[i] - step * direction[i], 0.);
        change += std::abs(next - p[i]);
        p[i] = next;
      }
      for (unsigned int i = 0; i < n; ++i)
      {
        if (p[i] == 0 && response[i] < state.approach && step > 0)
        {
          // an unloaded point that overlaps joins the contact, and the conjugate direction starts afresh
          bool was_loaded = std::binary_search(loaded.begin(), loaded.end(), i);
          if (!was_loaded)
          {
            p[i] = step * (state.approach - response[i]);
            keep = 0;
          }
        }
        sum += p[i];
      }
      if (sum == 0)
        break;
      if (problem.force_given())
        p *= problem.normal_force / sum;
      if (keep == 1 && change < tolerance * sum)
        break;
    }
  }
} // namespace vibrocontact
