#include <vibrocontact/analyses/modal_convolution/static_load.h>
#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/number_text.h>
#include <vibrocontact/contact/active_set.h>
#include <vibrocontact/contact/contact_solvers.h>

#include <algorithm>
#include <cmath>

namespace vibrocontact
{
  double indentation_of_load(const BodyInContact &model, const std::vector<double> &shapes,
                             const double force, const RoadLaws &laws)
  {
    const unsigned int n = shapes.size();
    if (std::any_of(model.poles.begin(), model.poles.end(), is_rigid_motion))
      throw InputError("Rolling/Normal force is given, but the body is free, nothing presses it: hold it, or "
                       "give Road/Indentation (negative above the road) in its place.");
    const std::vector<std::complex<double>> weights = static_weights(model);
    const DenseMatrix whole = sum_over_poles(model, weights);
    DenseMatrix compliance(n, n);
    std::vector<double> unloaded(n, 0.);
    for (unsigned int i = 0; i < n; ++i)
    {
      for (unsigned int j = 0; j < n; ++j)
        compliance(i, j) = whole(i, j) + (model.residual.m() > 0 ? model.residual(i, j) : 0.);
      for (unsigned int k = 0; k < model.pole_load.size(); ++k)
        unloaded[i] += 2 * (model.right(i, k) * weights[k] * model.pole_load[k]).real();
      if (!std::isfinite(compliance(i, i)) || !(compliance(i, i) > 0))
        throw InputError("Rolling/Normal force is given, but the body has no static response to a force at "
                         "contact point " +
                         std::to_string(i) + ": give Road/Indentation in its place.");
    }
    check_unique_forces(compliance, "at rest");
    ContactProblem problem = road_contact_problem(compliance, n, {laws.normal}, 1.);
    for (unsigned int i = 0; i < n; ++i)
      problem.b[i] = unloaded[i] + shapes[i];
    problem.normal_force = force;
    problem.approach = *std::min_element(problem.b.begin(), problem.b.begin() + n);
    ContactSolverParameters parameters;
    parameters.tolerance = 1e-12;
    const ContactSolution solution = create_contact_solver(parameters)->solved(problem);
    if (!(solution.residual <= 1e-10))
      throw InputError("Rolling/Normal force of " + number_text(force) +
                       " N is not reached however far the road is pushed towards the body: give less.");
    return solution.approach;
  }
} // namespace vibrocontact
