#include <vibrocontact/base/exceptions.h>
#include <vibrocontact/base/nearest_names.h>
#include <vibrocontact/contact/contact_solvers.h>
#include <vibrocontact/contact/fixed_point.h>
#include <vibrocontact/contact/newton.h>

namespace vibrocontact
{
  const std::vector<ContactSolverEntry> &contact_solvers()
  {
    static const std::vector<ContactSolverEntry> table = {
        {"semi-smooth newton", "Newton on the projections, active points only",
         [](const ContactSolverParameters &p) -> std::unique_ptr<ContactSolver>
         { return std::make_unique<NewtonSolver>(p); }},
        {"fixed point", "the paper's fixed point on the forces with constant rho",
         [](const ContactSolverParameters &p) -> std::unique_ptr<ContactSolver>
         { return std::make_unique<FixedPointSolver>(p); }}};
    return table;
  }

  std::vector<std::string> contact_solver_names()
  {
    std::vector<std::string> names;
    for (const ContactSolverEntry &entry : contact_solvers())
      names.push_back(entry.name);
    return names;
  }

  std::unique_ptr<ContactSolver> create_contact_solver(const ContactSolverParameters &parameters)
  {
    for (const ContactSolverEntry &entry : contact_solvers())
      if (entry.name == parameters.method)
        return entry.create(parameters);
    throw InputError("There is no contact solver called \"" + parameters.method + "\"; " +
                     name_suggestion(parameters.method, contact_solver_names()));
  }
} // namespace vibrocontact
